"""A setup written in a file (TOML), for the command line and for machines that several programs share."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import Any, TypeVar

from mnclab.machine.setup import Datum, Probe, Setup
from mnclab.path.limits import Limits
from mnclab.path.tool import Tool
from mnclab.text.alarm import Alarm, Span
from mnclab.text.nearest import hint
from mnclab.workpiece.blank import Blank, Box, cylinder

Result = TypeVar("Result")

#: The format, as the help of the command line shows it.
FORMAT = """\
start = [0, 0, 300]            # machine position of the spindle before the program, mm

[tools.1]                      # the row of the tool table; every key may be left out
radius = 5                     # mm; also length, name, corner, dl, dr, teeth, kind, cutting_length, pitch,
length = 80                    # and in degrees angle (of the point) and plunge_angle; of a lathe tool main_angle and
                               # auxiliary_angle, from the axis to the edges, and width of a blade in mm

[datums]                       # work offsets: machine coordinates of the zero points, mm
1 = [100, 50, -200]
2 = { x = 300, y = 50, z = -200, rotation = 30 }

[stock]                        # the blank, machine coordinates: low and high, two corners; or a cylinder about an axis:
radius = 25                    # mm; also bore (of a tube), axis "X", "Y" or "Z", at (a point on the axis)
low = -60
high = 2

[presets]                      # written like datums, where a control has them
[correctors]                   # offsets along the axes, written like datums, where words D or L name them
[limits]                       # rapid, acceleration, jerk, corner_speed, corner_tolerance, corner_jump, rapid_motion,
                               # spindle, spindle_acceleration, tool_change; a number, or [x, y, z] per axis
[probe]                        # clearance, reach, feed, rapid
[settings]                     # choices of the control: mnclab help settings --control NAME lists them
[files]                        # names that programs call -> files, seen from this one
[variables]                    # values that are there before the program: QR1 = 2.5, QS1 = "text"
"""

ROWS = {"tools": Tool, "datums": Datum, "presets": Datum, "correctors": Datum}
RECORDS = {"limits": Limits, "probe": Probe}
TEXTS = ("name", "kind", "corner_speed", "rapid_motion")  # of a tool; of the limits
KNOWN = ("start", "stock", *ROWS, *RECORDS, "settings", "files", "variables")


class File:
    """The text of a setup file, so that an alarm can show a line of it."""

    def __init__(self, name: str, text: str) -> None:
        self.name, self._lines = name, text.splitlines()

    @property
    def end(self) -> Span:
        """Just behind the last character."""
        return Span(len(self._lines), len(self._lines[-1]) + 1) if self._lines else Span(1, 1)

    def line_text(self, line: int) -> str:
        return self._lines[line - 1] if 0 < line <= len(self._lines) else ""

    def place_of(self, key: str) -> Span | None:
        """Where a key gets its value; None where it stands in a form of TOML that is not looked for."""
        written = re.compile(rf"""(?:^|[\s.{{,])(["']?{re.escape(key)}["']?)\s*=""")
        for number, line in enumerate(self._lines, 1):
            if found := written.search(line.partition("#")[0]):
                return Span(number, found.start(1) + 1, len(found[1]))
        return None


def load(path: str | Path) -> Setup:
    """The setup of a file; an Alarm names what is wrong in it."""

    def build(table: dict[str, Any], file: File) -> Setup:
        return replace(_setup(table, Path(file.name).parent), source=file)

    return parse(Path(path), build, "setup")


def parse(path: Path, build: Callable[[dict[str, Any], File], Result], what: str) -> Result:
    """What ``build`` makes of the table in a TOML file; alarms show the line of the file."""
    try:
        text = path.read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8"
        raise Alarm(f"the {what} cannot be read: {reason}", source=File(str(path), "")) from None
    file = File(str(path), text)
    try:
        return build(tomllib.loads(text), file)
    except tomllib.TOMLDecodeError as error:
        place = re.search(r"line (\d+), column (\d+)", str(error))
        span = Span(int(place[1]), int(place[2])) if place else file.end
        raise Alarm(re.sub(r" \(at .*\)", "", str(error)), span, source=file) from None
    except Alarm as alarm:
        alarm.source = file
        raise


def _setup(table: Mapping[str, Any], folder: Path) -> Setup:
    check_names(table, KNOWN, "a setup")
    found: dict[str, Any] = {}
    if "start" in table:
        found["start"] = _point(table["start"], "start")
    if "stock" in table:
        found["stock"] = _stock(_table(table["stock"], "stock"))
    for name, kind in ROWS.items():
        if name in table:
            rows = _table(table[name], name)
            found[name] = {_row(number, name): record(kind, row, f"{name}.{number}") for number, row in rows.items()}
    for name, kind in RECORDS.items():
        if name in table:
            found[name] = record(kind, table[name], name)
    if "variables" in table:
        found["variables"] = _table(table["variables"], "variables")
    if "settings" in table:
        found["settings"] = _table(table["settings"], "settings")
    if "files" in table:
        found["files"] = {name: folder / str(file) for name, file in _table(table["files"], "files").items()}
    return Setup(**found)


def _stock(table: Mapping[str, Any]) -> Blank:
    """The blank: a cylinder where it has a radius, else a box."""
    if "radius" not in table:
        check_names(table, ("low", "high"), "stock without a radius")
        return Box(_point(table.get("low"), "stock.low"), _point(table.get("high"), "stock.high"))
    check_names(table, ("radius", "low", "high", "bore", "axis", "at"), "stock")
    numbers = {name: _number(table.get(name, 0.0), f"stock.{name}") for name in ("radius", "low", "high", "bore")}
    at = _point(table.get("at", [0.0, 0.0, 0.0]), "stock.at")
    try:
        return cylinder(**numbers, axis=table.get("axis", "Z"), at=at)
    except ValueError as fault:
        raise Alarm(f"stock: {fault}") from None


def record(kind: Any, value: Any, where: str) -> Any:
    """A Tool, Datum, Limits or Probe from a table of its fields, or a datum from a list."""
    if kind is Datum and isinstance(value, list):
        return Datum(*_point(value, where))
    names = kind._fields if hasattr(kind, "_fields") else [field.name for field in fields(kind)]
    check_names(_table(value, where), names, where)
    return kind(**{name: _field(item, f"{where}.{name}", name) for name, item in value.items()})


def _field(value: Any, where: str, name: str) -> Any:
    if name in TEXTS:
        if not isinstance(value, str):
            raise Alarm(f"{where} must be a text, got {value!r}")
        return value
    if isinstance(value, list):
        return tuple(
            _number(item, where) if not isinstance(item, list) else _field(item, where, name) for item in value
        )
    return _number(value, where)


def _number(value: Any, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise Alarm(f"{where} must be a number, got {value!r}")
    return value


def _point(value: Any, where: str) -> tuple[float, float, float]:
    if not isinstance(value, list) or len(value) != 3:
        raise Alarm(f"{where} must be three numbers [x, y, z], got {value!r}")
    x, y, z = (float(_number(item, where)) for item in value)
    return x, y, z


def _row(number: str, where: str) -> int:
    if not number.isdigit():
        raise Alarm(f"a row of {where} must be a whole number, got {number!r}")
    return int(number)


def _table(value: Any, where: str) -> Mapping[str, Any]:
    if not isinstance(value, dict):
        raise Alarm(f"{where} must be a table, got {value!r}", hint=f"write [{where}] on a line of its own")
    return value


def check_names(table: Mapping[str, Any], known: Any, where: str) -> None:
    """An Alarm for the first name that is not known."""
    for name in table:
        if name not in known:
            raise Alarm(f"{where} has no {name!r}", hint=hint(name, known, 1) or f"known: {', '.join(known)}")

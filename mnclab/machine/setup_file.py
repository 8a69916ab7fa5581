"""A setup written in a file (TOML), for the command line and for machines that several programs share."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import fields
from pathlib import Path
from typing import Any, TypeVar

from mnclab.machine.setup import NOT_BUILT, Datum, Probe, Setup
from mnclab.path.limits import Limits
from mnclab.path.tool import Tool
from mnclab.text.alarm import Alarm, Span
from mnclab.text.file import read
from mnclab.text.given import check_number, shown
from mnclab.text.nearest import hint
from mnclab.workpiece.blank import Blank, Box, cylinder

Result = TypeVar("Result")

#: The format, as the help of the command line shows it.
FORMAT = """\
start = [0, 0, 300]            # machine position of the spindle before the program, mm
part = "cut"                   # a probe touches what the program has cut

[tools.1]                      # the row of the tool table; every key may be left out
radius = 5                     # mm; also length, name, corner, dl, dr, teeth, kind, cutting_length, pitch,
length = 80                    # and in degrees angle (of the point) and plunge_angle; of a lathe tool main_angle and
                               # auxiliary_angle, from the axis to the edges, and width of a blade in mm; for
                               # collisions centre_cutting (true, false), hand, shank = [radius, from],
                               # holder = [[radius, from], …], mm above the tip

[datums]                       # work offsets: machine coordinates of the zero points, mm
1 = [100, 50, -200]
2 = { x = 300, y = 50, z = -200, rotation = 30 }

[stock]                        # the blank, machine coordinates: low and high, two corners; or a cylinder about an axis:
radius = 25                    # mm; also bore (of a tube), axis "X", "Y" or "Z", at (a point on the axis)
low = -60
high = 2

[[fixtures]]                   # what holds the blank (on a lathe: the chuck), written like the stock, one table each
low = [-30, 0, -20]
high = [0, 40, 15]

[presets]                      # written like datums, where a control has them
[correctors]                   # offsets along the axes, written like datums, where words D or L name them
[limits]                       # rapid, acceleration, jerk, corner_speed, corner_tolerance, corner_jump, rapid_motion,
                               # spindle, spindle_acceleration, tool_change; a number, or [x, y, z] per axis;
                               # travel = [[0, 400], [0, 300], [-200, 0]]: how far the axes go, machine coordinates
[probe]                        # clearance, reach, feed, rapid
[settings]                     # choices of the control: mnclab help settings --control NAME lists them
[files]                        # names that programs call -> files, seen from this one
[variables]                    # values that are there before the program: QR1 = 2.5, QS1 = "text"
"""

ROWS = {"tools": Tool, "datums": Datum, "presets": Datum, "correctors": Datum}
RECORDS = {"limits": Limits, "probe": Probe}
TEXTS = ("name", "kind", "hand", "corner_speed", "rapid_motion")  # of a tool; of the limits
KNOWN = ("start", "stock", "part", "fixtures", *ROWS, *RECORDS, "settings", "files", "variables")
KEY = r"""(?:[\w-]+|"[^"]*"|'[^']*')"""
PATH = rf"{KEY}(?:[ \t]*\.[ \t]*{KEY})*"
WRITTEN = re.compile(rf"^[ \t]*\[\[?[ \t]*({PATH})[ \t]*\]|(?:^|[{{,])[ \t]*({PATH})[ \t]*=")
DEEPEST = 50  # parts of a dotted key
LARGEST = 1_000_000  # bytes of a setup file


class File:
    """The text of a setup file, so that an alarm can show a line of it."""

    def __init__(self, name: str, text: str) -> None:
        self.name, self._lines = name, text.splitlines()

    @property
    def end(self) -> Span:
        return Span(len(self._lines), len(self._lines[-1]) + 1) if self._lines else Span(1, 1)

    def line_text(self, line: int) -> str:
        return self._lines[line - 1] if 0 < line <= len(self._lines) else ""

    def place_of(self, *keys: str) -> Span | None:
        """Where a value is written that keys lead to, else the table that it is in; None if neither is found."""
        found = [(len(path), span) for path, span in self._written() if path == list(keys[: len(path)])]
        return max(found, key=lambda each: each[0])[1] if found else None

    def _written(self) -> Iterator[tuple[list[str], Span]]:
        """The keys of every table and value, the outer ones before it, and the place of the last of them."""
        table: list[str] = []
        for number, line in enumerate(self._lines, 1):
            outer = table
            for found in WRITTEN.finditer(line):
                header, key = found.groups()
                keys = [*re.finditer(KEY, header or key)]
                path = [each[0].strip("\"'") for each in keys]
                if header:
                    table = path
                else:
                    path = [*outer, *path]
                    outer = path if outer is table else outer  # keys after the first are those of a table in the line
                column = found.start(1 if header else 2) + keys[-1].start() + 1
                yield path, Span(number, column, len(keys[-1][0]))

    @contextmanager
    def at(self, *keys: str) -> Iterator[None]:
        """Alarms raised here show where keys get their value."""
        try:
            yield
        except Alarm as alarm:
            alarm.span = alarm.span or self.place_of(*keys)
            raise


def load(path: str | Path) -> Setup:
    """The setup of a file; an Alarm names what is wrong in it."""
    return parse(path, _setup, "setup")


def parse(path: str | Path, build: Callable[[dict[str, Any], File], Result], what: str) -> Result:
    """What `build` makes of the table in a TOML file; alarms show the line of the file."""
    if not isinstance(path, str | Path) or not str(path):
        raise Alarm(f"the {what} must be the name of a file, got {shown(path)}")
    file = File(str(Path(path)), "")
    try:
        text = read(Path(path), f"the {what}", LARGEST).decode("utf-8-sig")
        file = File(file.name, text)
        return build(_table_of(text), file)
    except UnicodeDecodeError:
        raise Alarm(f"the {what} cannot be read: it is not UTF-8", source=file) from None
    except tomllib.TOMLDecodeError as error:
        place = re.search(r"line (\d+), column (\d+)", str(error))
        span = Span(int(place[1]), int(place[2])) if place else file.end
        raise Alarm(re.sub(r" \(at .*\)", "", str(error)), span, source=file) from None
    except Alarm as alarm:
        alarm.source = file
        raise


def _table_of(text: str) -> dict[str, Any]:
    """The table that a text writes; an Alarm for one that Python would take hours for."""
    for number, line in enumerate(text.splitlines() if text.count(".") > DEEPEST else (), 1):
        deep = 0
        for part in line.split("."):
            deep = deep + 1 if part.strip().replace("-", "").replace("_", "").isalnum() else 0
            if deep > DEEPEST:
                raise Alarm(f"a key has more than {DEEPEST} parts", Span(number, 1))
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise Alarm("tables or lists are nested too deeply") from None
    except tomllib.TOMLDecodeError:
        raise
    except ValueError as error:  # of a number of some thousand digits
        raise Alarm(f"a value cannot be read: {error}") from None


def _setup(table: Mapping[str, Any], file: File) -> Setup:
    check_names(table, (*KNOWN, *NOT_BUILT), "a setup", file)
    found: dict[str, Any] = {}
    for name, value in table.items():
        with file.at(name):
            if name == "start":
                found[name] = _point(value, name)
            elif name == "part":
                found[name] = value
            elif name == "fixtures":
                found[name] = tuple(_stock(_table(each, name), name, file) for each in _list(value, name))
            elif name in RECORDS:
                found[name] = record(RECORDS[name], value, file, name)
            elif name in NOT_BUILT:
                found[name] = value or True
            else:
                found[name] = TABLES[name](_table(value, name), name, file)
            Setup(**{name: found[name]})  # what is wrong with this part alone is shown at its place
    return Setup(**found, source=file)


def _rows(table: Mapping[str, Any], name: str, file: File) -> dict[int, Any]:
    """The rows of a table of tools or datums; an Alarm for one that is written twice, as 1 and as 01."""
    found: dict[int, Any] = {}
    for key, value in table.items():
        with file.at(name, key):
            if not (key.isascii() and key.isdigit() and len(key) < 10):
                raise Alarm(f"a row of {name} must be a whole number, got {shown(key)}")
            row = int(key)
            if row in found:
                raise Alarm(f"{name} has the row {row} twice")
        found[row] = record(ROWS[name], value, file, name, key)
        if isinstance(found[row], Tool) and "number" in value and found[row].number != row:
            with file.at(name, key, "number"):
                told = f"{name}.{key}.number must be {row}, that of its row, got {found[row].number:g}"
                raise Alarm(told, hint="a tool has the number of its row; leave it out")
    return found


def _stock(table: Mapping[str, Any], stock: str, file: File) -> Blank:
    """The blank: a cylinder where it has a radius, else a box."""
    if "radius" not in table:
        check_names(table, ("low", "high"), f"{stock} without a radius", file, stock)
        corners = []
        for name in ("low", "high"):
            with file.at(stock, name):
                if name not in table:
                    needs = "needs low and high, two corners [x, y, z], or a radius"
                    raise Alarm(f"{stock} {needs}: {stock}.{name} is missing")
                corners.append(_point(table[name], f"{stock}.{name}"))
        return Box(*corners)
    check_names(table, ("radius", "low", "high", "bore", "axis", "at"), stock, file, stock)
    numbers = {name: table.get(name, 0.0) for name in ("radius", "low", "high", "bore")}
    for name, number in numbers.items():
        with file.at(stock, name):
            check_number(number, f"{stock}.{name}")
    with file.at(stock, "at"):
        at = _point(table.get("at", [0.0, 0.0, 0.0]), f"{stock}.at")
    try:
        return cylinder(**numbers, axis=table.get("axis", "Z"), at=at)
    except Alarm as fault:
        raise Alarm(f"{stock}: {fault.message}") from None


def record(kind: Any, value: Any, file: File, *keys: str) -> Any:
    """A Tool, Datum, Limits or Probe from a table of its fields, or a datum from a list; `keys` lead to it in the file."""
    where = ".".join(keys)
    with file.at(*keys):
        if kind is Datum and isinstance(value, list):
            return Datum(*_point(value, where))
        names = kind._fields if hasattr(kind, "_fields") else [field.name for field in fields(kind)]
        check_names(_table(value, where), names, where, file, *keys)
        found = {name: _field(item) for name, item in value.items()}
        for name, item in found.items():
            with file.at(*keys, name):
                _check_kind(value[name], f"{where}.{name}", name)
                kind(**{name: item})
        return kind(**found)


def _field(value: Any) -> Any:
    return tuple(map(_field, value)) if isinstance(value, list) else value


def _check_kind(value: Any, where: str, name: str) -> None:
    """An Alarm unless a field is a text where it must be one, else a number or a list of them."""
    if name in TEXTS and not isinstance(value, str):
        raise Alarm(f"{where} must be a text, got {shown(value)}")
    for each in value if isinstance(value, list) else [] if isinstance(value, bool) else [value]:
        if name not in TEXTS and not isinstance(each, list):
            check_number(each, where, endless=True)


def _point(value: Any, where: str) -> tuple[float, float, float]:
    if not isinstance(value, list) or len(value) != 3:
        raise Alarm(f"{where} must be three numbers [x, y, z], got {shown(value)}")
    for item in value:
        check_number(item, where)
    x, y, z = map(float, value)
    return x, y, z


def _files(table: Mapping[str, Any], files: str, file: File) -> dict[str, Path]:
    """Files by name, seen from the one that names them."""
    for key, name in table.items():
        with file.at(files, key):
            if not isinstance(name, str):
                raise Alarm(f"files.{key} must be a text, got {shown(name)}")
    return {key: Path(file.name).parent / name for key, name in table.items()}


#: What reads a part of a setup that is a table in the file.
TABLES: dict[str, Callable[[Mapping[str, Any], str, File], Any]] = {
    **dict.fromkeys(ROWS, _rows), "stock": _stock, "files": _files,
    **dict.fromkeys(("settings", "variables"), lambda table, name, file: table),
}  # fmt: skip


def _table(value: Any, where: str) -> Mapping[str, Any]:
    if not isinstance(value, dict):
        raise Alarm(f"{where} must be a table, got {shown(value)}", hint=f"write [{where}] on a line of its own")
    return value


def _list(value: Any, where: str) -> list[Any]:
    if not isinstance(value, list):
        raise Alarm(f"{where} must be a list of tables, got {shown(value)}", hint=f"write [[{where}]] before each")
    return value


def check_names(table: Mapping[str, Any], known: Any, where: str, file: File, *keys: str) -> None:
    """An Alarm for the first name that is not known; `keys` lead to the table in the file."""
    for name in table:
        if name not in known:
            with file.at(*keys, name):
                near = hint(name[:40], known, 1) or f"known: {', '.join(known)}"
                raise Alarm(f"{where} has no {shown(name)}", hint=near)

"""Machines written in files (TOML): the limits of the axes, and what was assumed to name them.

The named ones lie in `data/machines`. A file has `title`, `assumes` (a list of sentences) and the table
`[limits]`, whose keys are the fields of `Limits`.
"""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any, NamedTuple

from mnclab.path.limits import Limits
from mnclab.path.listing import figure
from mnclab.path.record_file import record
from mnclab.text.alarm import Alarm
from mnclab.text.alarm import hint as near
from mnclab.text.file import File, check_names, parse
from mnclab.text.given import fitting, shown
from mnclab.text.tables import html_table

_PACKAGE = Path(__file__).resolve().parent.parent
PLACES = (_PACKAGE / "data" / "machines", _PACKAGE.parent / "data" / "machines")  # installed; in the sources


class MachineFile(NamedTuple):
    """A machine: its `name`, a `title`, what was assumed, and its limits."""

    name: str
    title: str
    assumes: tuple[str, ...]
    limits: Limits


class Machines(tuple[MachineFile, ...]):
    """The machines that have a name, shown as a table."""

    HEAD = ("name", "title", "rapid, mm/min", "acceleration, mm/s²", "spindle, rev/min", "tool change, s")

    def rows(self) -> list[tuple[str, ...]]:
        """What the table says of each."""
        return [(each.name, each.title, *(_per_axis(getattr(each.limits, one)) for one in SAID)) for each in self]

    def __getitem__(self, which: Any) -> Any:
        """A machine by its name or its number."""
        return load(which) if isinstance(which, str) else super().__getitem__(which)

    def __repr__(self) -> str:
        rows = [self.HEAD, *self.rows()]
        widths = [max(len(row[k]) for row in rows) for k in range(len(self.HEAD))]
        return "\n".join("  ".join(cell.ljust(wide) for cell, wide in zip(row, widths)).rstrip() for row in rows)

    def _repr_html_(self) -> str:
        return html_table(self.HEAD, self.rows(), numbers=range(2, len(self.HEAD)))


SAID = ("rapid", "acceleration", "spindle", "tool_change")


def _per_axis(value: Any) -> str:
    if isinstance(value, tuple):
        return ", ".join(map(_per_axis, value))
    return "no limit" if value == math.inf else figure(float(value))


@fitting
def machines() -> Machines:
    """The machines whose name may stand for limits: `run.profile("small-mill")`, `Setup(limits="small-mill")`."""
    return Machines(map(load, names()))


def limits_of(limits: Limits | str | None, machine: Limits | str | None = None) -> Limits | None:
    """Limits that were given as such, or by the name of a machine, as `limits` or as `machine`; None where neither was."""
    if limits is not None and machine is not None:
        raise Alarm("limits and machine say the same: give one of them")
    given = machine if limits is None else limits
    given = given.limits if isinstance(given, MachineFile) else given
    if isinstance(given, str | Path):
        return load(given).limits
    if not isinstance(given, Limits | None):
        raise Alarm(f"limits must be Limits or the name of a machine, got {shown(given)}", hint='"small-mill"')
    return given


def names() -> list[str]:
    """The machines that have a name."""
    return sorted({file.stem for place in PLACES for file in place.glob("*.toml")})


def load(machine: str | Path) -> MachineFile:
    """A machine by its name or its file; an Alarm names what is wrong."""
    text = str(machine)
    if isinstance(machine, Path) or text.endswith(".toml"):
        return parse(Path(machine), _machine, "machine")
    for place in PLACES:
        if os.path.isfile(place / f"{text}.toml"):
            return parse(place / f"{text}.toml", _machine, "machine")
    hint = near(text[:40], names(), 1) or f"known: {', '.join(names())}; or the name of a .toml file"
    raise Alarm(f"no machine has the name {shown(text)}", hint=hint)


def _machine(table: dict[str, object], file: File) -> MachineFile:
    check_names(table, ("title", "assumes", "limits"), "a machine", file)
    path = Path(file.name)
    title, assumes = table.get("title", path.stem), table.get("assumes", [])
    if not isinstance(title, str):
        raise Alarm(f"title must be a text, got {title!r}")
    if not isinstance(assumes, list) or not all(isinstance(line, str) for line in assumes):
        raise Alarm(f"assumes must be a list of texts, got {assumes!r}")
    return MachineFile(path.stem, title, tuple(assumes), record(Limits, table.get("limits", {}), file, "limits"))

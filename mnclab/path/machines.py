"""Machines written in files (TOML): the limits of the axes, how they turn, and what was assumed to name them.

The named ones lie in `data/machines`. A file has `title`, `assumes` (a list of sentences), the table `[limits]`, whose keys are
the fields of `Limits`, and `[kinematics]` of a machine with rotary axes: `head` and `table`, each a list of tables with the
fields of `Axis`.
"""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, NamedTuple

from mnclab.geometry.kinematics import Axis, Kinematics
from mnclab.path.limits import Limits
from mnclab.path.listing import figure
from mnclab.path.tool import record
from mnclab.text.alarm import Alarm
from mnclab.text.alarm import hint as near
from mnclab.text.file import COURSE, File, as_table, as_tables, check_names, parse
from mnclab.text.given import fitting, shown
from mnclab.text.tables import Listing

FOLDER = COURSE / "data" / "machines"


class MachineFile(NamedTuple):
    """A machine: its `name`, a `title`, what was assumed, its limits, and its rotary axes where it has some."""

    name: str
    title: str
    assumes: tuple[str, ...]
    limits: Limits
    kinematics: Kinematics | None = None


class Machines(Listing, tuple[MachineFile, ...]):
    """The machines that have a name, shown as a table."""

    HEAD = ("name", "title", "rotary axes", "rapid, mm/min", "acceleration, mm/s²", "spindle, rev/min", "tool change, s")
    NUMBERS = range(3, 7)

    def rows(self) -> list[tuple[str, ...]]:
        """What the table says of each."""
        rotary = [each.kinematics.names if each.kinematics else "" for each in self]
        said = [[_per_axis(getattr(each.limits, one)) for one in SAID] for each in self]
        return [(each.name, each.title, axes, *rest) for each, axes, rest in zip(self, rotary, said)]

    texts = rows

    def __getitem__(self, which: Any) -> Any:
        """A machine by its name or its number."""
        return load(which) if isinstance(which, str) else super().__getitem__(which)


SAID = ("rapid", "acceleration", "spindle", "tool_change")


def _per_axis(value: Any) -> str:
    if isinstance(value, tuple):
        return ", ".join(map(_per_axis, value))
    return "no limit" if value == math.inf else figure(float(value))


@fitting
def machines() -> Machines:
    """The machines whose name may stand for limits: `run.profile("small-mill")`, `Setup(limits="small-mill")`.

    >>> mnc.machines()["small-mill"].title
    'Small vertical machining centre'
    """
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


def kinematics_of(given: Any) -> Kinematics | None:
    """A kinematics that was given as such, as a machine that has one, or by its name; an Alarm where it is none."""
    if isinstance(given, str | Path):
        given = load(given)
    found = given.kinematics if isinstance(given, MachineFile) else given
    if not isinstance(found, Kinematics | None) or (found is None and given is not None):
        have = [each.name for each in machines() if each.kinematics]
        what = f"the machine {given.name} has no rotary axes" if found is None else f"kinematics must be one, got {shown(given)}"
        raise Alarm(what, hint=f"a mnclab.Kinematics, or one of {', '.join(have)}")
    return found


def names() -> list[str]:
    """The machines that have a name."""
    return sorted(file.stem for file in FOLDER.glob("*.toml"))


def load(machine: str | Path) -> MachineFile:
    """A machine by its name or its file; an Alarm names what is wrong."""
    text = str(machine)
    if isinstance(machine, Path) or text.endswith(".toml"):
        return parse(Path(machine), _machine, "machine")
    if os.path.isfile(FOLDER / f"{text}.toml"):
        return parse(FOLDER / f"{text}.toml", _machine, "machine")
    hint = near(text[:40], names(), 1) or f"known: {', '.join(names())}; or the name of a .toml file"
    raise Alarm(f"no machine has the name {shown(text)}", hint=hint)


def _machine(table: dict[str, object], file: File) -> MachineFile:
    check_names(table, ("title", "assumes", "limits", "kinematics"), "a machine", file)
    path = Path(file.name)
    title, assumes = table.get("title", path.stem), table.get("assumes", [])
    if not isinstance(title, str):
        raise Alarm(f"title must be a text, got {title!r}")
    if not isinstance(assumes, list) or not all(isinstance(line, str) for line in assumes):
        raise Alarm(f"assumes must be a list of texts, got {assumes!r}")
    limits = record(Limits, table.get("limits", {}), file, "limits")
    kinematics = kinematics_in(table["kinematics"], file, title) if "kinematics" in table else None
    return MachineFile(path.stem, title, tuple(assumes), limits, kinematics)


def kinematics_in(value: Any, file: File, title: str = "", name: str = "kinematics") -> Kinematics:
    """The rotary axes that the table `[kinematics]` of a file writes."""
    with file.at(name):
        table = as_table(value, name)
        check_names(table, [each.name for each in fields(Kinematics)], name, file, name)
        chains = {}
        for side in ("head", "table"):
            each = enumerate(as_tables(table.get(side, []), f"{name}.{side}"))
            chains[side] = tuple(_axis(as_table(one, f"{name}.{side}"), file, name, side, str(k)) for k, one in each)
        return Kinematics(**chains, title=table.get("title", title), shift=table.get("shift", Kinematics.shift))


def _axis(table: Mapping[str, Any], file: File, *keys: str) -> Axis:
    with file.at(*keys):
        check_names(table, [each.name for each in fields(Axis)], ".".join(keys), file, *keys)
        if "name" not in table:
            raise Alarm(f"{'.'.join(keys)} needs the name of the axis", hint='name = "A"')
        return Axis(**table)

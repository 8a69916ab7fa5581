"""Saving, restoring and deleting the kinematics of the machine (TNC 620, 18.3): cycle 450, and the table that it keeps.

DATA450.KD is a text (TOML): of every record its name, the kinematics as setup files write it, and the date where a run has one.
It is read where `Setup(files=…)` has one, and stands in `run.files` once it was written.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from mnclab.controls.tnc_620.cycles.addresses import choice
from mnclab.controls.tnc_620.cycles.planes import ParameterFault
from mnclab.controls.tnc_620.probing.measuring import SCREEN, UNKNOWN
from mnclab.controls.tnc_620.state import memory, time_of_day
from mnclab.geometry.kinematics import Axis, Kinematics
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import NOTHING
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Step, Write
from mnclab.path.machines import kinematics_in
from mnclab.running.interpreter import found
from mnclab.text.alarm import Alarm
from mnclab.text.file import File, as_table, table_of
from mnclab.text.strings import TextFormula

CYCLES = CycleTable(runs="definition")
SETTINGS = (
    Setting("kinematics_opt", True, "software option 48, KinematicsOpt: cycles 450 to 452", "18.2"),
    Setting("delete_confirmed", True, "the operator confirms that cycle 450 deletes records", "18.3"),
)
TABLE, LOG = "DATA450.KD", "TCHPR450.TXT"
SPACES = 16  # records there may be
LONGEST, MOST = 16, 99999  # characters of a name; the greatest number
MODES: dict[float, str] = {
    0: "back up the active kinematics", 1: "restore saved kinematics", 2: "display the current memory status",
    3: "delete a data record",
}  # fmt: skip
SAVE, RESTORE, DISPLAY, _ = MODES
WILD = "?$#*"
MADE = "written by TCH PROBE 450; lengths in mm, angles in degrees, centres in machine coordinates"
Records = Mapping[str, Kinematics]


def no_kinematics(m: Machine) -> Iterator[ParameterFault]:
    """Why no cycle of KinematicsOpt can run."""
    if not m.settings["kinematics_opt"]:
        yield "", "needs the software option KinematicsOpt, which is switched off (setting kinematics_opt)"
    elif m.tables.kinematics is None:
        yield "", "needs the kinematics of the machine: Setup(kinematics=…), a mnclab.Kinematics or the name of a machine"


@CYCLES("TCH PROBE 450", "Save kinematics", source="18.3")
class SaveKinematics(Cycle):
    """Nothing moves. What is restored of several records is their mean; what is equal to the active kinematics stays.

    Wildcards: ? any character, $ a letter, # a digit, * any characters.
    """

    does = NOTHING
    tried_on = "table-ac"
    mode: float = choice("Q410", "mode", MODES, example=0)
    memory_designation: float | str | TextFormula = param(
        ("Q409", "QS409"), "memory designation", "choice", modal=True, type="text", example=5,
        note="a number up to 99999 or a text up to 16 characters; none with Q410=2",
    )  # fmt: skip

    def name(self, m: Machine) -> str:
        """The name of a record, or a pattern of names."""
        given = self.memory_designation
        if isinstance(given, TextFormula):
            return given.evaluate(m.variables)
        return given if isinstance(given, str) else f"{given:.10g}"

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from no_kinematics(m)
        try:
            records = opened(m)
        except Alarm as alarm:
            yield "", f"cannot use {TABLE}: {alarm.message}"
            return
        if self.mode == DISPLAY:
            return
        name, number = self.name(m), self.memory_designation
        if isinstance(number, int | float):
            if not (number == int(number) and 0 <= number <= MOST):
                yield "memory_designation", f"must be a whole number from 0 to {MOST}, got {number:.10g}"
        elif not 0 < len(name) <= LONGEST:
            yield "memory_designation", f"must be a text of 1 to {LONGEST} characters, got {len(name)}"
        if self.mode == SAVE:
            if any(sign in name for sign in WILD):
                yield "memory_designation", f"must be the name of one record: {' '.join(WILD)} are for restoring and deleting"
            if len(records) >= SPACES and name not in records:
                yield "memory_designation", f"would be record {SPACES + 1}: there is room for {SPACES}, delete one with Q410=3"
            return
        if not (chosen := matching(records, name)):
            known = ", ".join(records) or "none"
            yield "memory_designation", f"{name} matches no record (there are: {known})"
        elif self.mode == RESTORE and not any(alike(m.tables.kinematics, each) for each in chosen.values()):
            yield "memory_designation", f"{name} was saved of other kinematics than are active"

    def moves(self, m: Machine) -> Iterator[Step]:
        records, name, active = opened(m), self.name(m), m.tables.kinematics
        assert active is not None
        chosen = matching(records, name)
        told: list[str] = []
        if self.mode == SAVE:
            yield from kept(m, {**records, name: active})
            told = [f"Saved as {name}:", *entries(active)]
        elif self.mode == RESTORE:
            restored = mean(active, [each for each in chosen.values() if alike(active, each)])
            told = ["Before restoring:", *entries(active), "After restoring:", *entries(restored)]
            if restored != active:
                yield Write("kinematics", restored, label="the kinematics is restored")
        elif self.mode == DISPLAY:
            told = [f"Saved records: {len(records)} of {SPACES}", *listed(records)]
        elif m.settings["delete_confirmed"]:
            yield from kept(m, {key: value for key, value in records.items() if key not in chosen})
            told = ["Deleted records:", *listed(chosen)]
        else:
            told = ["Deleted records: none, it was not confirmed"]
        text = "\n".join([*headed(m, self, active), *told, "End of log", ""])
        if self.mode == DISPLAY:
            yield Write("file", text, SCREEN)
        yield Write("file", text, LOG)


def headed(m: Machine, c: Cycle, kinematics: Kinematics) -> Iterator[str]:
    """The first lines of a log of KinematicsOpt."""
    now = time_of_day(m)
    yield f"Log for Probing Cycle {c.code.split()[-1]} {c.title}"
    yield f"Date: {now:%d-%m-%Y}" if now else f"Date: {UNKNOWN}"
    yield f"Time: {now.hour}:{now:%M:%S}" if now else f"Time: {UNKNOWN}"
    yield f"Program: {m.flow.program.title}"
    yield f"Kinematics: {kinematics.title or kinematics}"
    yield f"Tool: {m.tool.number}{f' {m.tool.name}' if m.tool.name else ''}"


def entries(kinematics: Kinematics) -> Iterator[str]:
    """The axes and their transformations, line by line."""
    for where, axes in (("head", kinematics.head), ("table", kinematics.table)):
        for axis in axes:
            centre, direction = (" ".join(f"{value:z.6f}" for value in each) for each in (axis.centre, axis.direction or ()))
            yield f"  {axis.name} in the {where}: centre {centre} direction {direction}"
    yield f"  shift {' '.join(f'{value:z.6f}' for value in kinematics.shift)}"


def listed(records: Records) -> Iterator[str]:
    return (f"  {name}: {each.title or each}" for name, each in records.items())


# Which records a name means.


def matching(records: Records, pattern: str) -> dict[str, Kinematics]:
    """The records whose names a pattern fits."""
    return {name: each for name, each in records.items() if fits(pattern, name)}


def fits(pattern: str, name: str) -> bool:
    """Whether a pattern fits a whole name.

    >>> fits("$-HEAD#", "A-HEAD1"), fits("A*2", "A-HEAD1")
    (True, False)
    """
    ends = {0}  # how much of the name the pattern may have taken so far
    for sign in pattern:
        if sign == "*":
            ends = set(range(min(ends, default=len(name) + 1), len(name) + 1))
        else:
            ends = {k + 1 for k in ends if k < len(name) and _is(name[k], sign)}
    return len(name) in ends


def _is(letter: str, sign: str) -> bool:
    match sign:
        case "?":
            return True
        case "$":
            return letter.isalpha()
        case "#":
            return letter.isdecimal()
    return letter == sign


def alike(one: Kinematics | None, other: Kinematics) -> bool:
    """Whether a record is one of the same machine: its title and the same axes in the same places."""
    if one is None or one.title != other.title:
        return False
    sides = zip((one.head, one.table), (other.head, other.table))
    return all([a.name for a in mine] == [a.name for a in theirs] for mine, theirs in sides)


def mean(active: Kinematics, records: Iterable[Kinematics]) -> Kinematics:
    """The active kinematics with the transformations of the records, of several with their mean."""
    several, restored = list(records), active
    for axis in active.sequence:
        saved = [each.axis(axis.name) for each in several]
        centre, direction = (_mean([getattr(one, name) for one in saved]) for name in ("centre", "direction"))
        restored = restored.with_axis(replace(axis, centre=centre, direction=direction))
    return replace(restored, shift=_mean([each.shift for each in several]))


def _mean(points: list[tuple[float, float, float]]) -> tuple[float, float, float]:
    if len(points) == 1:
        return points[0]
    x, y, z = np.mean(points, axis=0).tolist()
    return x, y, z


# The table of the records.


def opened(m: Machine) -> Records:
    """The records as they stand; an Alarm if the table of the setup is empty or spoilt."""
    records = memory(m).saved_kinematics
    if records is not None:
        return records
    given = next((name for name in m.setup.files if name.replace("\\", "/").rpartition("/")[2].lower() == TABLE.lower()), None)
    if given is None:
        return {}
    text = found(m, given, "TCH PROBE 450", None, "table").text
    file = File(TABLE, text)
    records = {name: kinematics_in(_row(each, name), file, name=name) for name, each in table_of(text).items()}
    if not records:
        raise Alarm("it has no row: delete it, and it is made anew")
    return records


def _row(value: object, name: str) -> dict[str, object]:
    """A record but for its date."""
    return {key: each for key, each in as_table(value, name).items() if key != "date"}


def kept(m: Machine, records: Records) -> Iterator[Write]:
    """Write the records; with the last of them the table is gone."""
    yield Write("memory", dict(records), "saved_kinematics")
    yield Write("file", written(m, records) if records else None, TABLE)


def written(m: Machine, records: Records) -> str:
    """The text of the table."""
    now = time_of_day(m)
    lines = [f"# {TABLE}: {MADE}"]
    for name, each in records.items():
        lines += ["", f"[{json.dumps(name, ensure_ascii=False)}]", f"title = {json.dumps(each.title, ensure_ascii=False)}"]
        lines += [f'date = "{now:%Y-%m-%d %H:%M:%S}"'] if now else []
        for side in ("head", "table"):
            if axes := getattr(each, side):
                lines += [f"{side} = [", *(f"  {_written(axis)}," for axis in axes), "]"]
        lines.append(f"shift = {list(each.shift)}")
    return "\n".join([*lines, ""])


def _written(axis: Axis) -> str:
    direction, limits = list(axis.direction or ()), list(axis.limits)
    return (
        f'{{ name = "{axis.name}", centre = {list(axis.centre)}, direction = {direction}, '
        f"limits = {limits}, home = {axis.home}, backlash = {axis.backlash} }}"
    )

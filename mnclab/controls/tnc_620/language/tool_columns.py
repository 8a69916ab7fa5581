"""The columns of the tool table that programs read and write (FN 18 and FN 17, ID50; of the active tool ID950).

Their numbers are those of "System data" in the conversational manual of the TNC 620 (10/2017): NR1 to NR44.
What a `Tool` has no place for stays where it was written, for the run: nothing acts on it, and it reads as 0 before.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from operator import attrgetter
from typing import Any, NamedTuple

from mnclab.controls.tnc_620.state import memory
from mnclab.machine.machine import Machine
from mnclab.path.tool import Tool

#: R in the column R-OFFS: the offset is the tool radius.
OF_RADIUS = 99999.9999
#: Numbers of the kinds in the column TYPE.
TYPES = {
    "mill": 0, "drill": 1, "tap": 2, "reamer": 3, "countersink": 5, "face mill": 14, "thread mill": 15, "probe": 21,
}  # fmt: skip


class Column(NamedTuple):
    """Its name on the control, where a `Tool` has it ("": nowhere), and how the number and what is there become each other."""

    title: str
    place: str = ""
    number: Callable[[Any], float | None] = float
    meant: Callable[[float], Any] = float


def kind_of(number: float) -> str:
    """The kind of a TYPE; StopIteration where a tool has none of it."""
    return next(kind for kind, each in TYPES.items() if each == number)


COLUMNS = {
    1: Column("L", "length"), 2: Column("R", "radius"), 3: Column("R2", "corner"), 4: Column("DL", "dl"), 5: Column("DR", "dr"),
    6: Column("DR2"), 7: Column("TL", "locked", float, bool), 8: Column("RT"), 9: Column("TIME1"), 10: Column("TIME2"),
    11: Column("CUR.TIME"), 12: Column("PLC"), 13: Column("LCUTS", "cutting_length"), 14: Column("ANGLE", "plunge_angle"),
    15: Column("CUT", "teeth"), 16: Column("LTOL", "wear.length"), 17: Column("RTOL", "wear.radius"),
    18: Column("DIRECT", "hand", lambda hand: -float(hand == "right"), lambda number: "right" if number else "left"),
    19: Column(
        "R-OFFS", "wear.offset_radius", lambda offset: OF_RADIUS if offset is None else float(offset),
        lambda number: None if number == OF_RADIUS else number,
    ),
    20: Column("L-OFFS", "wear.offset_length"), 21: Column("LBREAK", "wear.break_length"),
    22: Column("RBREAK", "wear.break_radius"), 23: Column("PLC-VAL"), 28: Column("NMAX"), 32: Column("T-ANGLE", "angle"),
    33: Column("PITCH", "pitch"), 34: Column("LIFTOFF"), 35: Column("R2TOL", "wear.corner"),
    36: Column("TYPE", "kind", TYPES.get, kind_of), 37: Column("TP_NO"), 38: Column("LAST_USE"), 39: Column("ACC"),
    40: Column("PITCH", "pitch"), 44: Column("OVRTIME"),
}  # fmt: skip


def value(m: Machine, tool: Tool, number: int) -> float | None:
    """What stands in a column in the row of a tool: lengths in mm, angles in degrees, times in minutes."""
    column = COLUMNS[number]
    if column.place:
        return column.number(attrgetter(column.place)(tool))
    return memory(m).tool_fields.get((tool.number, number), 0.0)


def is_empty(m: Machine, tool: Tool, number: int) -> bool:
    """Whether tools here have no such column, and the program wrote nothing into it."""
    return not COLUMNS[number].place and (tool.number, number) not in memory(m).tool_fields


def written(m: Machine, tool: Tool, number: int, value: float) -> Tool:
    """The tool with a value in a column; an Alarm or StopIteration where it cannot stand there."""
    column = COLUMNS[number]
    if not column.place:
        memory(m).tool_fields[tool.number, number] = value
        return tool
    table, _, name = column.place.rpartition(".")
    meant = {name: column.meant(value)}
    return replace(tool, **({table: replace(getattr(tool, table), **meant)} if table else meant))

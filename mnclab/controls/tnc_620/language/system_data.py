"""System data: what FN 18 reads of the control by group (ID), number (NR) and index (IDX), tool columns, texts."""

from __future__ import annotations

import math
from collections.abc import Callable, Container
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np

from mnclab.controls.tnc_620.cycles import chain
from mnclab.controls.tnc_620.cycles.engraving import TIMES
from mnclab.controls.tnc_620.language.auxiliary import above_tip
from mnclab.controls.tnc_620.language.values import PREASSIGNED
from mnclab.controls.tnc_620.state import active_preset, memory, time_of_day
from mnclab.controls.tnc_620.tables import row_of
from mnclab.machine.axes import reference
from mnclab.machine.control import Setting
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.path.tool import Tool
from mnclab.running.cycles import unit_of

# The columns of the tool table that programs read and write (FN 18 and FN 17, ID50; of the active tool ID950).
# Their numbers are those of "System data" in the conversational manual of the TNC 620 (10/2017): NR1 to NR44.
# What a `Tool` has no place for stays where it was written, for the run: nothing acts on it, and it reads as 0 before.

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


def with_column(m: Machine, tool: Tool, number: int, value: float) -> Tool:
    """The tool with a value in a column; an Alarm or StopIteration where it cannot stand there."""
    column = COLUMNS[number]
    if not column.place:
        memory(m).tool_fields[tool.number, number] = value
        return tool
    table, _, name = column.place.rpartition(".")
    meant = {name: column.meant(value)}
    return replace(tool, **({table: replace(getattr(tool, table), **meant)} if table else meant))


# System data: what FN 18 reads of the control by group (ID), number (NR) and index (IDX).
# The rows are those of the lists that public manuals print, as far as the machine here knows them: "System data" of the
# Klartext manuals of TNC 620 and TNC 7; ID10 NR1 and NR2, ID503 and what an index left out means: iTNC 530, technical manual
# 9.5.4. Lengths are mm and feeds mm/min whatever the unit of the program, angles degrees.

SETTINGS = (
    Setting("execution", True, "a program that asks (ID992 NR16) is executed, and not simulated", "System data, ID992"),
)


@dataclass(frozen=True)
class Asked:
    """What a program asks for; `index` is nan where it names none."""

    group: float
    number: float
    index: float

    def __str__(self) -> str:
        index = "" if math.isnan(self.index) else f" IDX{self.index:g}"
        return f"ID{self.group:g} NR{self.number:g}{index}"


class Missing(Exception):
    """Why there is no value."""


Read = Callable[[Machine, Asked], float | None]


class SystemDatum(NamedTuple):
    """One of the system data: what it is, how it is read, its indices (None: any), and the one that is meant without."""

    title: str
    read: Read
    indices: Container[float] | None = ()
    default: float = math.nan


# --- reading ----------------------------------------------------------------------------------------------------------


def named(m: Machine, asked: Asked) -> Tool:
    """The row of the tool table that the index names."""
    for number, tool in m.tables.tools.items():
        if number == asked.index:
            return tool
    raise Missing(f"the tool table has no row {asked.index:g}")


def active(m: Machine, asked: Asked) -> Tool:
    """The row of the tool in the spindle: without the deltas of TOOL CALL."""
    return m.tables.tools.get(m.tool.number, m.tool)


def index_of(tool: Tool) -> float:
    """Of the tool 5.2 it is 2."""
    return float(round(tool.number % 1 * 10))


def column(number: int, tool: Callable[[Machine, Asked], Tool]) -> Read:
    """A column of the tool table; one that tools here do not have is an empty field, which is said."""

    def read(m: Machine, asked: Asked) -> float | None:
        row = tool(m, asked)
        if is_empty(m, row, number):
            title = COLUMNS[number].title
            m.warn(f"FN 18: SYSREAD {asked} reads 0: the tool table here has no {title}", hint="FN 17 may write it before")
        return value(m, row, number)

    return read


def with_deltas(name: str, delta: str) -> Read:
    """1: of the tool table, 2: with its delta, 3: with that of TOOL CALL, too."""

    def read(m: Machine, asked: Asked) -> float:
        tool = m.tool if asked.index == 3 else active(m, asked)
        return float(getattr(tool, name) + (getattr(tool, delta) if delta and asked.index > 1 else 0.0))

    return read


def parameter(name: str) -> Read:
    """A Q parameter of the active machining cycle: lengths in mm, feeds in mm/min."""

    def read(m: Machine, asked: Asked) -> float:
        if m.cycle is None:
            raise Missing("no machining cycle is defined")
        cycle = m.cycle.cycle
        own = next((p for p in cycle.parameters() if name in (p.address, *p.aliases)), None)
        if own is None:
            raise Missing(f"{cycle.code} has no {name}")
        if not isinstance(value := m.variables.get(name), float):
            raise Missing(f"{name} is {value}")
        return value * unit_of(m, own)

    return read


def kept(name: str) -> Read:
    """What the control keeps in a Q parameter, too."""
    return lambda m, asked: PREASSIGNED[name](m)


def number_of_cycle(m: Machine, asked: Asked) -> float:
    if m.cycle is None:
        raise Missing("no machining cycle is defined")
    return float(m.cycle.cycle.code.split()[-1])


def feed(m: Machine, asked: Asked) -> float:
    if m.feed is None:
        raise Missing("no feed rate was programmed")
    return m.feed * m.speed if m.per_rev else m.feed


def scale(m: Machine, asked: Asked) -> float:
    """How much longer the way of the machine is along an axis."""
    return float(np.linalg.norm(m.frames.matrix[:3, int(asked.index) - 1]))


def mirrored(m: Machine, asked: Asked) -> float:
    frame = m.frames[chain.place(m, chain.MIRROR)] @ m.frames[chain.MIRROR + chain.ALSO]
    return float(sum(1 << k for k in range(3) if frame[k, k] < 0))


def kind_of_tilt(m: Machine, asked: Asked) -> float:
    if chain.TILT not in m.frames:
        return 0.0
    return 1.0 if memory(m).tilt_by_axes else 2.0


def shift(m: Machine, asked: Asked) -> float:
    return (*chain.shift_of(m), *memory(m).rotary_shift)[int(asked.index) - 1]


def travel(side: int) -> Read:
    """A limit switch of an axis: 0 the negative one."""

    def read(m: Machine, asked: Asked) -> float:
        limits = m.setup.limits.travel
        value = math.inf if limits is None else limits[int(asked.index) - 1][side]
        if math.isinf(value):
            raise Missing("the travel of the axis is not known: Setup(limits=mnclab.Limits(travel=…)) says it")
        return value

    return read


def along_the_contour(m: Machine) -> None:
    if m.side:
        raise Missing("under radius compensation the tool stands beside the programmed point: write R0 before")


def on_the_machine(m: Machine, asked: Asked) -> float:
    """As M91 counts: the spindle reference, above the tip."""
    along_the_contour(m)
    if m.tables.kinematics is not None:
        return (*reference(m), *map(math.degrees, m.rotary))[int(asked.index) - 1]
    spindle = (tip + above for tip, above in zip(m.tip, above_tip(m), strict=True))
    return (*spindle, *map(math.degrees, m.rotary))[int(asked.index) - 1]


def in_the_program(m: Machine, asked: Asked) -> float:
    along_the_contour(m)
    turned = (chain.to_angle(m, k, math.degrees(angle)) for k, angle in enumerate(m.rotary))
    return (*m.programmed, *turned)[int(asked.index) - 1]


def datum(m: Machine, asked: Asked) -> float | None:
    try:
        row = row_of(m, int(asked.number))
    except LookupError as error:
        raise Missing(f"the row {error.args[0]}") from None
    return row.get("xyzabc"[int(asked.index) - 1])


def preset(m: Machine, asked: Asked) -> float:
    presets = m.tables.presets
    if asked.number and asked.number not in presets:
        raise Missing(f"the preset table has no row {asked.number:g}")
    return presets.get(int(asked.number), Datum())[int(asked.index) - 1]


def clock(m: Machine, asked: Asked) -> float:
    if (now := time_of_day(m)) is None:
        raise Missing("a run has no time of day: the setting clock gives it one")
    return now.timestamp()


def holds(m: Machine, code: str) -> float:
    return -1.0 if code in m.modal.values() else 0.0


def never(m: Machine, asked: Asked) -> float:
    """Of M functions that are refused, and of a block scan, which a run is not."""
    return 0.0


# --- the table --------------------------------------------------------------------------------------------------------

LINEAR, AXES = range(1, 4), range(1, 7)  # X Y Z, and A B C
OVERSIZE = range(1, 4)
ROWS: dict[tuple[float, float], SystemDatum] = {
    (10, 1): SystemDatum("unit of the main program", kept("Q113")),
    (10, 2): SystemDatum("overlap factor of pockets", kept("Q112")),
    (10, 3): SystemDatum("number of the active machining cycle", number_of_cycle),
    (20, 1): SystemDatum("number of the active tool", lambda m, a: float(int(m.tool.number))),
    (20, 3): SystemDatum("active tool axis", kept("Q109")),
    (20, 4): SystemDatum("programmed spindle speed", lambda m, a: m.speed),
    (20, 5): SystemDatum("active spindle status", kept("Q110")),
    (20, 8): SystemDatum("coolant status", kept("Q111")),
    (20, 9): SystemDatum("active feed rate", feed),
    (20, 11): SystemDatum("index of the active tool", lambda m, a: index_of(m.tool)),
    (30, 1): SystemDatum("set-up clearance of the active cycle", parameter("Q200")),
    (30, 2): SystemDatum("depth of the active cycle", parameter("Q201")),
    (30, 3): SystemDatum("plunging depth of the active cycle", parameter("Q202")),
    (30, 4): SystemDatum("feed rate for plunging of the active cycle", parameter("Q206")),
    (30, 10): SystemDatum("feed rate for milling of the active cycle", parameter("Q207")),
    (35, 2): SystemDatum("radius compensation", lambda m, a: float(m.side != 0)),
    (60, 1): SystemDatum("number of the tool of TOOL CALL", lambda m, a: float(int(m.tool.number))),
    (60, 2): SystemDatum("tool axis of TOOL CALL", kept("Q109")),
    (60, 3): SystemDatum("spindle speed of TOOL CALL", lambda m, a: m.speed),
    (60, 4): SystemDatum("delta length of TOOL CALL", lambda m, a: m.tool.dl - active(m, a).dl),
    (60, 5): SystemDatum("delta radius of TOOL CALL", lambda m, a: m.tool.dr - active(m, a).dr),
    (60, 7): SystemDatum("delta corner radius of TOOL CALL", lambda m, a: m.tool.corner - active(m, a).corner),
    (60, 8): SystemDatum("tool index of TOOL CALL", lambda m, a: index_of(m.tool)),
    (200, 1): SystemDatum("active radius", with_deltas("radius", "dr"), OVERSIZE, 3),
    (200, 2): SystemDatum("active length", with_deltas("length", "dl"), OVERSIZE, 3),
    (200, 3): SystemDatum("active corner radius", with_deltas("corner", ""), OVERSIZE, 3),
    (210, 1): SystemDatum("basic rotation", lambda m, a: m.tables.presets.get(active_preset(m), Datum()).rotation),
    (210, 2): SystemDatum("programmed rotation", lambda m, a: chain.angle_of(m)),
    (210, 3): SystemDatum("mirrored axes: 1 X, 2 Y, 4 Z, or their sum", mirrored),
    (210, 4): SystemDatum("active scaling factor", scale, LINEAR, 1),
    (210, 5): SystemDatum("tilt angle A, B, C", lambda m, a: memory(m).tilt_angles.get("abc"[int(a.index) - 1], 0.0), LINEAR),
    (210, 6): SystemDatum("tilted working plane, -1 or 0", lambda m, a: -float(chain.TILT in m.frames)),
    (210, 10): SystemDatum("kind of the tilt: 0 none, 1 axes, 2 spatial angles", kind_of_tilt),
    (220, 2): SystemDatum("active datum shift", shift, AXES),
    (230, 2): SystemDatum("negative limit switch", travel(0), LINEAR),
    (230, 3): SystemDatum("positive limit switch", travel(1), LINEAR),
    (230, 5): SystemDatum("limit switches: 0 on, 1 off", lambda m, a: float(m.setup.limits.travel is None), LINEAR, 1),
    (240, 1): SystemDatum("nominal position in the REF system", on_the_machine, AXES),
    (240, 8): SystemDatum("actual position in the REF system", on_the_machine, AXES),
    (270, 1): SystemDatum("position in the active coordinate system", in_the_program, AXES),
    (280, 1): SystemDatum("M128 or FUNCTION TCPM is active", lambda m, asked: min(holds(m, "M128"), holds(m, "FUNCTION TCPM"))),
    (310, 116): SystemDatum("M116 is active", lambda m, asked: holds(m, "M116")),
    (310, 128): SystemDatum("M128 is active", lambda m, asked: holds(m, "M128")),
    (310, 144): SystemDatum("M144 is active", never),
    (320, 1): SystemDatum("system time, seconds from 1970", clock, (0,), 0),
    (505, 1): SystemDatum("a datum table is selected", lambda m, a: float(bool(memory(m).datum_table or m.tables.datums))),
    (530, 1): SystemDatum("number of the active preset", lambda m, a: float(active_preset(m))),
    (990, 10): SystemDatum("block scan is active", never),
    (992, 10): SystemDatum("block scan is active", never),
    (992, 16): SystemDatum("really executed, 1 or 0", lambda m, a: float(m.settings["execution"])),
}  # fmt: skip
#: Groups whose number is the row of a table.
TABLES: dict[float, SystemDatum] = {
    500: SystemDatum("value of the active datum table", datum, AXES),
    503: SystemDatum("value of the preset table", preset, LINEAR),
    507: SystemDatum("value of the preset table", preset, LINEAR),
}  # fmt: skip

for _number, _column in COLUMNS.items():
    ROWS[50, _number] = SystemDatum(f"{_column.title} of a tool", column(_number, named), None)
    ROWS[950, _number] = SystemDatum(f"{_column.title} of the active tool", column(_number, active))


# System data that are texts, SYSSTR: by the names under which they are asked for (TNC 7, "System data").

def written_time(form: str) -> Callable[[Machine], str]:
    """The time of day, as the form writes it."""

    def read(m: Machine) -> str:
        if (now := time_of_day(m)) is None:
            m.alarm("SYSSTR ID321 asks for the time, which a run does not have", hint="the setting clock gives it one")
        return form.format(t=now)

    return read


TEXTS: dict[str, Callable[[Machine], str]] = {
    **{f"SYSSTR ID321 NR{number}": written_time(form) for number, form in enumerate(TIMES)},
    "SYSSTR ID10950 NR1": lambda m: m.tool.name,
}

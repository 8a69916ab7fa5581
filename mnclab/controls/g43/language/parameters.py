"""What LinuxCNC tells in variables: `#<_x>` and the like, and the numbers in which it keeps offsets, tool and place.

Numbers that it does not name are free up to #5601; `variables` has those of Fanuc and Haas. Lengths of tables are mm there,
whatever the unit of the program; positions and the feed count in its unit.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NoReturn

from mnclab.controls.g43.state import memory
from mnclab.machine.coordinates import AXES as ROTARY
from mnclab.machine.coordinates import angles
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.running.flow import course

Reading = Callable[[Machine], float | None]
VERSION = {"#<_vmajor>": 2.9, "#<_vminor>": 0.0}  # of the interpreter that answers are compared with
SYSTEMS = range(1, 10)  # G54 to G59.3


def here(m: Machine, k: int) -> float:
    """Where the tool is: under radius compensation that is beside the contour, which is not known before its next element."""
    if m.side and m.settings["dialect"] == "linuxcnc":
        hint = "write G40 first, or keep the place in a variable of its own"
        m.alarm("the present position cannot be read under radius compensation", hint=hint)
    return m.programmed[k] / m.variable_unit


def angle(m: Machine, k: int) -> float:
    return angles(m)[k]


def feed(m: Machine) -> float:
    """The last F in its unit; under G93 what it was, or that of the last move."""
    return memory(m).moves_a_minute if m.per_time else (m.feed or 0.0) / m.variable_unit


def depth(m: Machine) -> int:
    """How many subprograms run inside each other; repeats do not count."""
    return sum(not loop.times for loop in course(m).loops.running)


def motion_mode(m: Machine) -> float:
    """Ten times the number of the active code of motion or cycle; 800 where none is."""
    code = m.position_cycle.code if m.position_cycle else m.modal.get("motion") or "G80"
    return 10 * float(code[1:])


def chosen_tool(m: Machine) -> float:
    """The number of the last T."""
    row = memory(m).next_tool
    return float((row or m.tool).number)


def active(group: str, code: str) -> Reading:
    return lambda m: float(m.modal.get(group) == code)


def coolant(code: str) -> Reading:
    return lambda m: float(code in memory(m).coolants)


def override(code: str) -> Reading:
    return lambda m: float(memory(m).overrides[code])


def pocket(m: Machine) -> NoReturn:
    m.alarm("the pockets of a tool changer are known on the machine alone", hint="#<_current_tool> is the number of the tool")


#: Names that LinuxCNC gives to what it knows; those of states are 1 where they are active, else 0.
NAMED: dict[str, Reading] = {
    **{f"#<_{axis}>": partial(here, k=k) for k, axis in enumerate("xyz")},
    **{f"#<_{axis.lower()}>": partial(angle, k=k) for k, axis in enumerate(ROTARY)},
    **dict.fromkeys(("#<_u>", "#<_v>", "#<_w>"), lambda m: 0.0),  # axes that this mill does not have
    "#<_motion_mode>": motion_mode,
    "#<_plane>": lambda m: {"XY": 170.0, "ZX": 180.0, "YZ": 190.0}[m.plane],
    "#<_ccomp>": lambda m: {0: 400.0, 1: 410.0, -1: 420.0}[m.side],
    "#<_metric>": lambda m: float(m.variable_unit == 1), "#<_imperial>": lambda m: float(m.variable_unit != 1),
    "#<_absolute>": active("dimension", "G90"), "#<_incremental>": active("dimension", "G91"),
    "#<_inverse_time>": active("feed mode", "G93"), "#<_units_per_minute>": active("feed mode", "G94"),
    "#<_units_per_rev>": active("feed mode", "G95"), "#<_coord_system>": lambda m: 10 * float((m.modal["datum"] or "G0")[1:]),
    "#<_tool_offset>": lambda m: float(any(memory(m).active_offsets)),
    "#<_retract_r_plane>": active("return", "G99"), "#<_retract_old_z>": active("return", "G98"),
    "#<_spindle_rpm_mode>": lambda m: 1.0, "#<_spindle_css_mode>": lambda m: 0.0,
    "#<_ijk_absolute_mode>": lambda m: float(memory(m).absolute_centres),
    "#<_lathe_diameter_mode>": lambda m: 0.0, "#<_lathe_radius_mode>": lambda m: 1.0,
    "#<_spindle_on>": lambda m: float(m.spindle_speed != 0), "#<_spindle_cw>": lambda m: float(m.spindle_speed > 0),
    "#<_mist>": coolant("M7"), "#<_flood>": coolant("M8"),
    "#<_feed_override>": override("M50"), "#<_speed_override>": override("M51"),
    "#<_adaptive_feed>": override("M52"), "#<_feed_hold>": override("M53"),
    "#<_feed>": feed, "#<_rpm>": lambda m: m.speed,
    "#<_current_tool>": lambda m: float(m.tool.number), "#<_selected_tool>": chosen_tool,
    "#<_current_pocket>": pocket, "#<_selected_pocket>": pocket,
    "#<_value>": lambda m: 0.0, "#<_value_returned>": lambda m: 0.0,  # until a subprogram gives one
    "#<_call_level>": lambda m: float(depth(m)), "#<_remap_level>": lambda m: 0.0,
    "#<_line>": lambda m: float(m.source_line), "#<_task>": lambda m: 0.0,
    **{name: partial(lambda m, value: value, value=value) for name, value in VERSION.items()},
}  # fmt: skip


# The numbers: reference points, the shift of G92, work offsets, tool and place.

OFFSETS = {f"#{5221 + 20 * k + axis}": (row, axis) for k, row in enumerate(SYSTEMS) for axis in range(3)}
ANGLES = {f"#{5230 + 20 * k}": row for k, row in enumerate(SYSTEMS)}
REFERENCES = {f"#{first + k}": (number, k) for first, number in ((5161, 1), (5181, 2)) for k in range(3)}
SHIFT = {f"#{5211 + k}": k for k in range(3)}

PLACE = tuple(f"#{number}" for number in range(5061, 5067))  # of a probe: X Y Z A B C, in the unit of the program
FOUND = "#5070"  # whether it found what it was sent for
PROBED = (*PLACE, FOUND)


def offset(m: Machine, row: int, k: int) -> float:
    """An axis of a work offset, mm."""
    return float(m.tables.datums.get(row, Datum())[k])


def turn(m: Machine, row: int) -> float:
    """The angle of a work offset, degrees."""
    return m.tables.datums.get(row, Datum()).rotation


def reference(m: Machine, number: int, k: int) -> float:
    """An axis of a reference point of G28 or G30, machine coordinates of the spindle, mm."""
    return memory(m).references.get(number, (0.0, 0.0, 0.0))[k]


def shift(m: Machine, k: int) -> float:
    """The shift of G92 and G52 along an axis, mm, also while G92.2 has put it aside."""
    aside = memory(m).set_aside
    return float(m.frames["set"][k, 3]) if aside is None or "set" in m.frames else aside[k]


def length(m: Machine, k: int) -> float:
    """What the tool in the spindle is longer along an axis, mm."""
    return m.tool.effective_length if k == 2 else 0.0


#: Numbers whose value the interpreter keeps; they cannot be written, but for those of tables.
NUMBERED: dict[str, Reading] = (
    {name: partial(reference, number=number, k=k) for name, (number, k) in REFERENCES.items()}
    | {name: partial(shift, k=k) for name, k in SHIFT.items()} | {"#5210": lambda m: float("set" in m.frames)}
    | {name: partial(offset, row=row, k=k) for name, (row, k) in OFFSETS.items()}
    | {name: partial(turn, row=row) for name, row in ANGLES.items()}
    | {"#5220": lambda m: float(memory(m).row), "#5400": lambda m: float(m.tool.number)}
    | {f"#{5401 + k}": partial(length, k=k) for k in range(3)} | {"#5410": lambda m: 2 * m.tool.radius}
    | {f"#{number}": lambda m: 0.0 for number in (*range(5404, 5410), *range(5411, 5414), *range(5426, 5429))}
    | {f"#{5420 + k}": partial(here, k=k) for k in range(3)} | {f"#{5423 + k}": partial(angle, k=k) for k in range(3)}
)  # fmt: skip


def write(m: Machine, name: str, value: float) -> bool:
    """Write a number of a table, mm or degrees; whether it is one. An active work offset counts when it is selected anew."""
    if name in OFFSETS:
        row, k = OFFSETS[name]
        m.write_table("datums", row, m.tables.datums.get(row, Datum())._replace(**{"xyz"[k]: value}))
    elif name in ANGLES:
        m.write_table("datums", ANGLES[name], m.tables.datums.get(ANGLES[name], Datum())._replace(rotation=value))
    elif name in REFERENCES:
        number, k = REFERENCES[name]
        x, y, z = (value if k == axis else reference(m, number, axis) for axis in range(3))
        memory(m).references[number] = x, y, z
    else:
        return False
    return True

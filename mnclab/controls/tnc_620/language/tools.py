"""Tools and their axis: TOOL CALL, TOOL DEF, and the secondary axes U, V and W."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace

from mnclab.controls.tnc_620.cycles.chain import TILT
from mnclab.controls.tnc_620.language.auxiliary import rate, set_feed, with_another_tool
from mnclab.controls.tnc_620.language.values import counted, first, in_units, not_negative
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry import frames
from mnclab.machine.control import FunctionTable, Setting, Words
from mnclab.machine.coordinates import FRAME, LOG, along_z, tool_axis
from mnclab.machine.cycle import Cycle, Definition
from mnclab.machine.machine import Machine
from mnclab.path.tool import Tool
from mnclab.text.program import Word

# The tool axis of TOOL CALL: Z on the working plane XY, X on YZ, Y on ZX; cycles run along it.
# Tool length, radius compensation, corners, arcs, angles and the heights of cycles follow it. What is not built so is refused.

PLANES = {"Z": "XY", "X": "YZ", "Y": "ZX"}  # working plane by tool axis
#: Cycles that work in the plane and along the tool axis alone, whichever these are …
TURNED = frozenset(
    f"CYCL DEF {n}"
    for n in (
        1, 2, 17, 18, 200, 201, 203, 205, 206, 207, 208, 209, *range(210, 216), 220, 221, 225, 232, 233, 240, 241,
        *range(251, 255), *range(256, 259), *range(262, 266), 267,
    )
) | frozenset(f"TCH PROBE {n}" for n in (*range(408, 428), 430, 431))  # fmt: skip
#: … and those that name axes by their letters, or none.
NAMED = frozenset(f"CYCL DEF {n}" for n in (7, 8, 9, 10, 11, 13, 14, 20, 26, 32, 239, 247)) | {"GLOBAL DEF 120"}


def letter(m: Machine) -> str:
    return "XYZ"[tool_axis(m)]


def refuse_other(m: Machine, what: str, word: Word | None = None) -> None:
    """An Alarm unless the tool stands along Z."""
    if (axis := letter(m)) != "Z":
        m.alarm(f"{what} with the tool axis {axis}: not built yet", word, "with the tool axis Z it is")


def check_cycle(m: Machine, cycle: type[Cycle]) -> None:
    """An Alarm at a cycle that is built for the tool axis Z alone."""
    if cycle.code not in TURNED | NAMED:
        refuse_other(m, cycle.code)


def turned(m: Machine, definition: Definition) -> AbstractContextManager[None]:
    """What a cycle runs in."""
    if m.plane == "XY" and FRAME not in m.frames:
        return nullcontext()
    check_cycle(m, definition.cycle)
    return nullcontext() if FRAME in m.frames or definition.cycle.code in NAMED else along_z(m)


def change_axis(m: Machine, words: Words) -> int:
    """Take the tool axis that a TOOL CALL names; the number of the one before."""
    before = tool_axis(m)
    if "axis" not in words or (axis := str(words["axis"].value)) == letter(m):
        return before
    if axis not in PLANES:
        m.alarm(f"TOOL CALL: the tool axis {axis} is not built yet, X, Y and Z are", words["axis"])
    if TILT in m.frames:
        m.alarm(f"TOOL CALL: the tool axis {axis} cannot stand in a tilted working plane", words["axis"], "reset cycle 19")
    m.change("plane", PLANES[axis])
    m.log(LOG, axis)
    return before


# TOOL CALL and TOOL DEF (catalogue: TOOL CALL, TOOL DEF).

FUNCTIONS = FunctionTable()
OTHERWISE = 'with the setting tool_def = "block" the block counts'
SETTINGS = (
    Setting(
        "tool_def", "table", "which dimensions count where TOOL DEF defines a tool that has a row in the tool table", "11.9",
        {"table": "those of the table, with a warning", "block": "those of the block"},
    ),
)  # fmt: skip
LAST = 32767  # number of a tool
DELTAS = {"DL": "dl", "DR": "dr", "DR2": "corner"}  # words and the dimensions that they are added to


@FUNCTIONS("TOOL CALL,", "Tool call", takes="tool text axis S F DL DR DR2", source="4.11, example")
def tool_call(m: Machine, words: Words) -> None:
    """Puts the tool into the spindle with its deltas; without a tool only speed, feed and deltas change."""
    if m.side:
        m.alarm("TOOL CALL cannot change the tool under radius compensation", first(words), "write R0 first")
    speed = not_negative(m, words["S"], "TOOL CALL S (spindle speed)") if "S" in words else None
    feed = rate(m, words["F"], "TOOL CALL F (feed rate)") if "F" in words else None
    deltas = {DELTAS[name]: m.value(words[name]) for name in DELTAS if name in words}
    word = words.get("tool", words.get("text"))
    tool = find(m, word, "TOOL CALL") if word else None
    if tool and tool.locked:
        hint = "it counts as worn or broken: another tool takes its place"
        m.alarm(f"TOOL CALL cannot call T{tool.number}: it is locked in the tool table (TL = L)", word, hint)
    before = change_axis(m, words)
    if tool or deltas or before != tool_axis(m):
        put_in(m, tool, deltas, words, before)
    if speed is not None:
        m.spindle(speed=speed)
    if feed is not None:
        memory(m).auto_feed = feed
        memory(m).feed_per_tooth = None
        set_feed(m, feed)


def put_in(m: Machine, tool: Tool | None, deltas: dict[str, float], words: Words, before: int) -> None:
    """Change to a tool with its deltas, or give the present one other deltas; those not written are 0, or stay.

    `before` is the axis that the tool before lies along.
    """
    base = m.tables.tools.get(m.tool.number, m.tool) if tool is None else tool
    kept = {} if tool else {name: getattr(m.tool, name) - getattr(base, name) for name in DELTAS.values()}
    changed = {name: getattr(base, name) + value for name, value in (kept | deltas).items()}
    if changed.get("corner", 0) < 0:
        corner, found = base.corner / m.variable_unit, in_units(m, words["DR2"], m.value(words["DR2"]))
        least = f"{0 - corner:g}, got {found:g}: the corner radius is {corner:g}"
        m.alarm(f"TOOL CALL DR2 (delta corner radius) must be at least {least}", words["DR2"])
    if tool:
        memory(m).tool_before = m.tool
    m.change_tool(replace(base, **changed), tool_axis(m), before)
    with_another_tool(m)


def find(m: Machine, word: Word, code: str) -> Tool:
    """The tool of a number, of a name, or of the name in a text parameter.

    Where the setup has no tools of its own, a number that is not there is stood in for: a folder can be gone over without them.
    """
    tools, name = m.tables.tools, word.value
    if word.address == "text":
        name = dict(m.variables).get(str(word.value))
        if not isinstance(name, str):
            m.alarm(f"{code}: no text was given to {word.value}", word)
    if isinstance(name, str):
        for tool in tools.values():
            if tool.name.upper() == name.strip().upper():
                return tool
        known = ", ".join(f'"{tool.name}"' for tool in tools.values() if tool.name)
        m.alarm(f'{code} "{name}" has no row in the tool table', word, hint=f"names: {known}")
    number = m.value(word)
    if number not in tools and m.setup.tools == m.control.magazine and number == int(number) and 0 < number <= LAST:
        m.warn(f"{code} {number:g} has no row in the tool table: it counts as a tool without radius and length", word,
               hint="Setup(tools={…}) gives them")  # fmt: skip
        m.write_table("tools", int(number), Tool(number=int(number)))
    elif number not in tools:
        known = ", ".join(map(str, sorted(tools)))
        m.alarm(f"{code} {number:g} has no row in the tool table", word, f"tools: {known}")
    return m.tables.tools[number]  # type: ignore[index]  # an index such as 5.2 is a row of its own


@FUNCTIONS("TOOL DEF,", "Tool definition", takes="tool text L R F", source="11.9")
def tool_def(m: Machine, words: Words) -> None:
    """Without L and R it only names the next tool; else it defines one, as the setting `tool_def` says. Nothing moves."""
    word = words.get("tool", words.get("text"))
    if word is None:
        m.alarm("TOOL DEF needs the number of the tool", hint="for example TOOL DEF 5 L+100 R+4")
    if "F" in words:
        m.warn("TOOL DEF takes no feed: F is passed over", words["F"], "write F in TOOL CALL")
    given = [words[address] for address in ("L", "R") if address in words]
    if not given and m.setup.tools:
        find(m, word, "TOOL DEF")
        return
    number = word.value if isinstance(word.value, str) else m.value(word)
    if isinstance(number, str) or number != int(number) or not 0 < number <= LAST:
        m.alarm(f"TOOL DEF: the tool must be a whole number from 1 to {LAST}", word)
    if table_counts(m, int(number)):
        m.warn(f"TOOL DEF {number:g} is passed over: the row of the tool table counts", given[0], OTHERWISE)
        return
    length = m.value(words["L"]) if "L" in words else 0.0
    radius = not_negative(m, words["R"], "TOOL DEF R (radius)") if "R" in words else 0.0
    m.write_table("tools", int(number), Tool(radius=radius, length=length, number=int(number)))


def table_counts(m: Machine, number: int) -> bool:
    """Whether a tool is that of the table, though a block defines it; the magazine of a setup without tools is no table."""
    return m.settings["tool_def"] == "table" and m.setup.tools != m.control.magazine and number in (m.setup.tools or {})


# The secondary axes U, V and W, which move the tool along X, Y and Z (public manuals: FUNCTION PARAXCOMP).
# They have coordinates of their own, which no datum shifts, and those of X, Y and Z do not change with them: the tool stands at
# the sum of both. That sum is what PARAXCOMP DISPLAY shows as its distance from the workpiece.

SECONDARY = "secondary axes"
AXES = "UVW"
AXES_SETTINGS = (
    Setting(
        "secondary_axes", "sum", "what U, V and W do in a straight line", "Klartext, not described",
        {"sum": "they carry the tool along X, Y, Z, whose coordinates stay", "refuse": "an alarm: there are none"},
    ),
)  # fmt: skip


def move(m: Machine, words: Words) -> bool:
    """Set U, V and W to where a straight line takes them; whether it names one."""
    named = [words[axis] for axis in AXES if axis in words]
    if not named:
        return False
    if m.settings["secondary_axes"] == "refuse":
        m.alarm(f"{named[0]}: the machine has no secondary axis {named[0].address} (setting secondary_axes)", named[0])
    if m.tables.kinematics is not None:
        m.alarm(f"{named[0]}: secondary axes on a machine with rotary axes are not built yet", named[0])
    if memory(m).machine_datum is not None:
        m.alarm(f"{named[0]}: secondary axes under M91 or M92 are not built yet", named[0])
    if m.side:
        m.alarm(f"{named[0]}: secondary axes under radius compensation are not built yet", named[0], "write R0")
    before = memory(m).secondary
    u, v, w = (counted(m, words[axis], at) if axis in words else at for axis, at in zip(AXES, before, strict=True))
    memory(m).secondary = u, v, w
    m.set_frame(SECONDARY, frames.shift(u, v, w), keep="programmed")
    if m.setup.limits.travel is not None:
        m.warn(f"the travel of {named[0].address} is not known: its way counts as one of the axis beside it", named[0])
    return True

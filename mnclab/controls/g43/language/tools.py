"""Tools: their change, the compensation of their length (7.1) and of their radius."""

from __future__ import annotations

from collections.abc import Collection

from mnclab.controls.g43.state import ISO, NONE, Offsets, memory, undescribed, whole, written
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES, COMPENSATION, SIDES, first_word
from mnclab.geometry import frames
from mnclab.machine.axes import leaning, reckon
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.path.tool import Tool
from mnclab.text.program import Word

# Tool length compensation: G43, G44, G49 and the corrector D (7.1), or H as most ISO controls have it.
# What goes to the axes is base = programmed + sign · offset(D), with the sign +1 for G43, -1 for G44 and 0 for G49; the tip
# of a tool of length L is then at base - L. The manual moves nothing in the block of G43: an offset counts along an axis from
# the next word of that axis on. So the offsets that count (`Memory.active_offsets`) follow the wanted ones axis by axis, or
# all at once, still without motion, by the setting length_acts. From the first H on it names the offset, and D the radius
# alone.

FUNCTIONS = FunctionTable()
MOST = 9999  # the greatest number of a row
SIGNS = {"G43": 1, "G44": -1, "G49": 0}
WAYS = {"G43": ", positive", "G44": ", negative", "G49": " off"}
TITLES = {code: f"Tool length compensation{way}" for code, way in WAYS.items()}


def ends_leading(m: Machine) -> None:
    """G43, G44 and G49 end G43.4: coordinates count as they do without it."""
    if m.reckoned is None:
        reckon(m, m.rotary if "tilt" in m.frames else (0.0, 0.0, 0.0))


@FUNCTIONS("G43 G44 G49", TITLES, group="length compensation", phase="length", power_on="G49", source="7.1")
def length_compensation(m: Machine, words: Words) -> None:
    """The offsets of corrector D count from the next motion along each axis on; without D the corrector stays."""
    motion.uncompensated(m, words)
    ends_leading(m)
    memory(m).sign = SIGNS[words.code]
    memory(m).outlived &= words.code != "G49"
    want(m, first_word(words))


@FUNCTIONS("G43.1", "Tool length compensation by the block", group="length compensation", phase="length", takes="X Y Z",
           still=True, source="LinuxCNC")  # fmt: skip
def offsets_of_block(m: Machine, words: Words) -> None:
    """X Y Z are the offsets themselves, and count as those of G43 do; an axis that is not written keeps its own."""
    motion.uncompensated(m, words)
    if m.settings["dialect"] != "linuxcnc":
        m.alarm("G43.1 is refused: outside LinuxCNC it follows a tilted tool axis, which is not built", first_word(words),
                hint="setting dialect: linuxcnc")  # fmt: skip
    kept = memory(m)
    x, y, z = (m.length(words[axis]) if axis in words else kept.wanted_offsets[k] for k, axis in enumerate(AXES))
    set_wanted(m, (x, y, z))


@FUNCTIONS("D", "Corrector", phase="corrector", source="7.1")
def corrector(m: Machine, words: Words) -> None:
    """The radius for G41 and G42 and, without H in the program, the offsets for G43 and G44; no axis moves."""
    number = whole(m, words, "D", 0, MOST)
    motion.refuse_change(m, "corrector", words["D"])
    choose(m, number, words["D"])


@FUNCTIONS("H", "Length corrector", phase="corrector", source="Fanuc, Haas, LinuxCNC")
def length_corrector(m: Machine, words: Words) -> None:
    """The offsets for G43 and G44 from now on; H0 has none. No axis moves."""
    memory(m).length_corrector = number = whole(m, words, "H", 0, MOST)
    memory(m).outlived = False
    m.log("length corrector", number)
    want(m, words["H"])


def choose(m: Machine, number: int, word: Word | None) -> None:
    """Corrector `number` from now on: its offsets, and its radius where the tool table has such a row."""
    kept, row = memory(m), m.tables.tools.get(number)
    kept.corrector, kept.without_radius = number, row is None
    m.log("corrector", number)
    if row is not None:
        m.change("tool", m.tables.tools[m.tool.number].of_radius(row.radius, row.dr))
    want(m, word)


def want(m: Machine, word: Word | None) -> None:
    """Work out the offsets that G43 and H or D ask for."""
    kept = memory(m)
    address, number = ("D", kept.corrector) if kept.length_corrector is None else ("H", kept.length_corrector)
    x, y, z = offsets(m, address, number, word) if kept.sign else NONE
    set_wanted(m, (kept.sign * x, kept.sign * y, kept.sign * z))


def set_wanted(m: Machine, wanted: Offsets) -> None:
    kept = memory(m)
    kept.wanted_offsets = wanted
    if m.settings["length_acts"] == "at_once" and wanted != kept.active_offsets:
        kept.active_offsets = wanted
        place(m, "tip")


def offsets(m: Machine, address: str, number: int, word: Word | None) -> Offsets:
    """The offsets of a corrector: its row, or else the length of the tool of that number; number 0 has none."""
    if number == 0:
        return NONE
    if number in m.tables.correctors:
        return m.tables.correctors[number][:3]
    if number in m.tables.tools:
        return 0.0, 0.0, m.tables.tools[number].effective_length
    if (name := f"{address}{number}") not in (told := memory(m).empty_correctors):
        told.add(name)
        m.warn(f"{name} (corrector) has no offsets: they count as 0", word, hint="Setup(correctors={…}) gives them")
    return NONE


def pending(m: Machine) -> bool:
    """Whether an offset waits for the next motion of its axis."""
    return memory(m).wanted_offsets != memory(m).active_offsets


def activate(m: Machine, to: Collection[str]) -> None:
    """The offsets along axes that move now count (`to` has x, y, z): programmed coordinates stay, and the next motion takes
    them up."""
    kept = memory(m)
    if kept.outlived and "z" in to:
        kept.outlived = False
        m.warn(f"H{kept.length_corrector} is from before the change to T{m.tool.number}: its length still counts",
               hint=f"write G43 H{m.tool.number} after the change")  # fmt: skip
    wanted, active = kept.wanted_offsets, kept.active_offsets
    if wanted == active:
        return
    x, y, z = (wanted[k] if axis in to else active[k] for k, axis in enumerate("xyz"))
    if (x, y, z) != active:
        kept.active_offsets = (x, y, z)
        place(m, "programmed")


def place(m: Machine, keep: str) -> None:
    """The frame from programmed coordinates to the tip: the offsets that count, less the length of the tool."""
    x, y, z = memory(m).active_offsets
    shift = (x, y, z - m.tool.effective_length)
    if m.tables.kinematics is not None and shift[2]:  # along the tool, where coordinates are reckoned with it tilted
        along = m.tables.kinematics.orientation(m.rotary if m.reckoned is None else m.reckoned)[:, 2] * shift[2]
        shift = x + float(along[0]), y + float(along[1]), float(along[2])
    m.set_frame("length", frames.shift(*shift) if any(shift) else None, keep)


# Tools: T and M6, and the radius compensation, whose radius is that of D.

SIDE_TITLES = {"G41": COMPENSATION["G41"], "G42": COMPENSATION["G42"]}
BY_BLOCK = {"G41.1": "Radius compensation left, D is the diameter", "G42.1": "Radius compensation right, D is the diameter"}


@FUNCTIONS("T", "Tool", phase="tool", source="7.1")
def tool(m: Machine, words: Words) -> None:
    """The tool that M6 puts into the spindle. Where the setup has no tools of its own, one that is not there is stood in for."""
    word, known = words["T"], m.tables.tools
    number = whole(m, words, "T", 0, MOST)
    if number not in known:
        if (text := written(m, word)).startswith("0") and len(text) == 4:
            m.alarm(f"T{text} is the way of lathes to write tool and corrector in one", word, hint=f"write T{text[:2]} M6")
        if m.setup.tools != m.control.magazine:
            listed = ", ".join(f"T{n}" for n in sorted(known))
            m.alarm(f"T{number} has no row in the tool table", word, hint=f"tools: {listed}")
        m.warn(f"T{number} has no row in the tool table: it counts as a tool without radius and length", word,
               hint="Setup(tools={…}) gives them")  # fmt: skip
        m.write_table("tools", number, Tool(number=number))
    memory(m).next_tool = known[number]
    m.log("next tool", number)


@FUNCTIONS("M6", "Tool change", phase="change", modal=False, source="7.1")
def tool_change(m: Machine, words: Words) -> None:
    """The tool of T comes into the spindle and D becomes its number; no axis moves."""
    kept, before = memory(m), m.tool.number
    motion.change_tool(m, words)
    kept.outlived |= bool(kept.sign and kept.length_corrector and m.tool.number != before)
    place(m, "tip")
    choose(m, m.tool.number, first_word(words))


@FUNCTIONS("G41 G42", SIDE_TITLES, group="compensation", phase="compensation", source=ISO)
def radius_compensation(m: Machine, words: Words) -> None:
    """Takes effect with the next straight line in the plane: entry, change of side, exit."""
    undescribed(m, words)
    check_plane(m, words)
    if degrees := leaning(m):
        told = f"{words.code} needs the tool square to the working plane, and it leans by {degrees:.4g} degrees"
        m.alarm(told, first_word(words), hint="G53.1 turns it square to a tilted plane")
    check_radius(m, words)
    m.change("side", SIDES[words.code])


def check_plane(m: Machine, words: Words) -> None:
    """LinuxCNC compensates in two planes alone."""
    if m.settings["dialect"] == "linuxcnc" and m.plane == "YZ":
        m.alarm(f"{words.code} cannot stand in the plane YZ on LinuxCNC", first_word(words), hint="write G17 or G18")


def check_radius(m: Machine, words: Words) -> None:
    """Warn of a compensation whose radius is not the one that the program means."""
    kept, head, tool = memory(m), first_word(words), m.tool
    following = kept.next_tool
    if kept.without_radius:
        m.warn(f"D{kept.corrector} has no row in the tool table: the radius of T{tool.number} counts, {tool.radius:g} mm", head)
    elif tool.effective_radius == 0 and kept.corrector == tool.number == 0 and following is not None and following.number:
        m.warn(f"{words.code} compensates nothing: T{following.number} is chosen, but not in the spindle", head, hint="write M6")
    elif tool.effective_radius == 0:
        m.warn(f"{words.code} compensates nothing: the radius of D{kept.corrector} is 0", head)


@FUNCTIONS("G41.1 G42.1", BY_BLOCK, group="compensation", phase="compensation", takes="D", source="LinuxCNC")
def compensation_by_block(m: Machine, words: Words) -> None:
    """D is the diameter of the tool itself, until the next D or tool change."""
    head = first_word(words)
    if m.settings["dialect"] != "linuxcnc":
        hint = "setting dialect: linuxcnc"
        m.alarm(f"{words.code} is refused: outside LinuxCNC it turns the tool normal to the path, which is not built", head, hint)
    motion.uncompensated(m, words)
    check_plane(m, words)
    if "D" not in words:
        m.alarm(f"{words.code} D (diameter) is missing", head)
    radius = m.length(words["D"]) / 2
    m.change("tool", m.tool.of_radius(abs(radius)) if radius else m.tool.of_radius(0.0))
    m.change("side", SIDES[words.code.partition(".")[0]] * (-1 if radius < 0 else 1))

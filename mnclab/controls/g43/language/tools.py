"""Tools: T and M6, and the radius compensation, whose radius is that of D."""

from __future__ import annotations

from mnclab.controls.g43.language.lengths import MOST, choose, place
from mnclab.controls.g43.language.numbers import whole, written
from mnclab.controls.g43.remarks import ISO, undescribed
from mnclab.controls.g43.state import memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.functions import COMPENSATION, SIDES
from mnclab.controls.word_address.motion import first_word
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.path.tool import Tool

FUNCTIONS = FunctionTable()
TITLES = {"G41": COMPENSATION["G41"], "G42": COMPENSATION["G42"]}
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


@FUNCTIONS("G41 G42", TITLES, group="compensation", phase="compensation", source=ISO)
def compensation(m: Machine, words: Words) -> None:
    """Takes effect with the next straight line in the plane: entry, change of side, exit."""
    undescribed(m, words)
    check_radius(m, words)
    m.change("side", SIDES[words.code])


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
    if "D" not in words:
        m.alarm(f"{words.code} D (diameter) is missing", head)
    radius = m.length(words["D"]) / 2
    m.change("tool", m.tool.of_radius(abs(radius)) if radius else m.tool.of_radius(0.0))
    m.change("side", SIDES[words.code.partition(".")[0]] * (-1 if radius < 0 else 1))

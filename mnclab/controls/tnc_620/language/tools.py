"""TOOL CALL and TOOL DEF (catalogue: TOOL CALL, TOOL DEF)."""

from __future__ import annotations

from dataclasses import replace

from mnclab.controls.tnc_620.language.checks import first, not_negative, written
from mnclab.controls.tnc_620.language.feeds import rate, set_feed, with_another_tool
from mnclab.controls.tnc_620.language.tool_axis import change_axis
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Setting, Words
from mnclab.machine.coordinates import tool_axis
from mnclab.machine.machine import Machine
from mnclab.path.tool import Tool
from mnclab.text.program import Word

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
        corner, found = base.corner / m.variable_unit, written(m, words["DR2"], m.value(words["DR2"]))
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

"""TOOL CALL and TOOL DEF (catalogue: TOOL CALL, TOOL DEF)."""

from __future__ import annotations

from dataclasses import replace

from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.path.tool import Tool
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()


@FUNCTIONS("TOOL CALL,", "Tool call", takes="tool axis S F DL DR DR2", source="TOOL CALL")
def tool_call(m: Machine, words: Words) -> None:
    """Puts the tool into the spindle with its deltas; without a tool only speed, feed and deltas change."""
    if m.side:
        m.alarm(
            "TOOL CALL cannot change the tool under radius compensation",
            words.words[0] if len(words) else None,
            "write R0 first",
        )
    if "axis" in words and words["axis"].value != "Z":
        m.alarm(f"TOOL CALL: the tool axis {words['axis'].value} is not built yet, Z is", words["axis"])
    if "DR2" in words:
        m.alarm("TOOL CALL DR2 (delta of the corner radius) is not built yet", words["DR2"])
    speed, feed = numbers(m, words, "S", "spindle speed", 0), numbers(m, words, "F", "feed rate", None)
    deltas = {name.lower(): m.value(words[name]) for name in ("DL", "DR") if name in words}
    if "tool" in words or deltas:
        base = find(m, words["tool"]) if "tool" in words else m.tables.tools.get(m.tool.number, m.tool)
        kept = {} if "tool" in words else {"dl": m.tool.dl - base.dl, "dr": m.tool.dr - base.dr}
        delta = {"dl": 0.0, "dr": 0.0} | kept | deltas
        m.change_tool(replace(base, dl=base.dl + delta["dl"], dr=base.dr + delta["dr"]))
    if speed is not None:
        m.spindle(speed=speed)
    if feed is not None:
        m.memory["auto feed"] = feed
        m.change("feed", feed)


def numbers(m: Machine, words: Words, address: str, meaning: str, least: float | None) -> float | None:
    """The value of S or F; None if it is not written."""
    if address not in words:
        return None
    value = m.value(words[address])
    if value < 0 or (least is None and value == 0):
        allowed = "greater than 0" if least is None else f"at least {least:g}"
        m.alarm(f"TOOL CALL {address} ({meaning}) must be {allowed}, got {value:g}", words[address])
    return value


def find(m: Machine, word: Word) -> Tool:
    """The tool of a number or a name."""
    tools = m.tables.tools
    if isinstance(word.value, str):
        for tool in tools.values():
            if tool.name.upper() == word.value.upper():
                return tool
        known = ", ".join(f'"{tool.name}"' for tool in tools.values() if tool.name)
        m.alarm(f'TOOL CALL "{word.value}" has no row in the tool table', word, hint=f"names: {known}")
    number = m.value(word)
    if number not in tools:
        m.alarm(
            f"TOOL CALL {number:g} has no row in the tool table",
            word,
            hint=f"tools: {', '.join(map(str, sorted(tools)))}",
        )
    return tools[int(number)]


@FUNCTIONS("TOOL DEF,", "Tool definition", takes="tool L R", source="TOOL DEF")
def tool_def(m: Machine, words: Words) -> None:
    """With a tool table it only names the next tool; nothing moves."""
    for address in ("L", "R"):
        if address in words:
            m.alarm(
                f"TOOL DEF {address}: the tool table is active, it holds the dimensions of the tools", words[address]
            )
    if "tool" in words:
        find(m, words["tool"])

"""The feed of a block in all its forms: F, FMAX, FAUTO, FU, FZ, and M103, M109 to M111 (3.1; catalogue: F, TOOL CALL, M103).

In a program in inches F counts tenths of an inch a minute (setting "inch_feed"), as the posts for these controls write it.
FU is a feed per revolution and FZ one per tooth, in inches there; both follow the speed of the spindle. Where a cycle is
defined they become mm/min with the speed and the tool of that moment, as FAUTO does; FMAX stays a word.
"""

from __future__ import annotations

from typing import Any

from mnclab.controls.tnc_620.language.checks import above_zero, one_of, written
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Setting, Words
from mnclab.machine.machine import INF, Machine
from mnclab.path.feeds import FeedRule
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
SETTINGS = (
    Setting(
        "inch_feed", "tenth", "what F counts in where the program is in inches", "HEIDENHAIN: F in 0.1 inch/min",
        {"tenth": "tenths of an inch a minute: F100 is 254 mm/min", "inch": "inches a minute"},
    ),
)  # fmt: skip
FEED_WORDS = "F FMAX FAUTO FU FZ"
MEANINGS = {"F": "feed rate", "FU": "feed per revolution", "FZ": "feed per tooth"}
EDGES = {"M109": "everywhere", "M110": "inside", "M111": ""}
TITLES = {
    "M109": "Constant feed at the cutting edge on arcs", "M110": "Constant feed at the edge, reduction only",
    "M111": "End of M109 and M110",
}  # fmt: skip


def feed(m: Machine, words: Words) -> float | None:
    """Set the feed of this and the following blocks; inf for FMAX, which counts in its block alone."""
    word = one_of(m, words, FEED_WORDS.split(), "one feed")
    if word is None or m.unheard:  # a contour has no feed of its own (10.1)
        return None
    if word.address == "FMAX":
        return INF
    memory(m).feed_per_tooth = None
    if word.address == "FAUTO":
        set_feed(m, auto_feed(m, word))
        return None
    name = f"{word.address} ({MEANINGS[word.address]})"
    value = above_zero(m, word, name) if word.address != "F" else rate(m, word, name)
    if word.address == "FZ":
        memory(m).feed_per_tooth = value
        value *= teeth(m, word)
    set_feed(m, value, per_rev=word.address != "F")
    return None


def rate(m: Machine, word: Word, name: str) -> float:
    """The number of an F, mm/min."""
    return above_zero(m, word, name) * m.feed_unit


def set_feed(m: Machine, value: float | None, per_rev: bool = False) -> None:
    """The feed from now on, mm/min or mm/rev."""
    m.change("per_rev", per_rev)
    m.change("feed", value)


def teeth(m: Machine, word: Word) -> int:
    if m.tool.teeth <= 0:
        found = word if isinstance(word.value, str) else f"{word.address}{written(m, word, m.value(word)):g}"
        m.alarm(f"{found} needs the number of teeth of tool {m.tool.number} (column CUT of the tool table)", word)
    return m.tool.teeth


def with_another_tool(m: Machine) -> None:
    """A feed per tooth goes on with the teeth of the new tool; with none there is no feed until one is written."""
    if (per_tooth := memory(m).feed_per_tooth) is not None:
        set_feed(m, per_tooth * m.tool.teeth if m.tool.teeth > 0 else None, per_rev=True)


def auto_feed(m: Machine, word: Word) -> float:
    value = memory(m).auto_feed
    if value is None:
        m.alarm("FAUTO needs a feed in the TOOL CALL block", word, hint="write TOOL CALL … F500")
    return value


def named(m: Machine, word: Word) -> float | str:
    """A feed written in place of the number of a cycle: mm/min where it is defined (3.1); FMAX stays a word."""
    text = str(word.value)
    if text == "FAUTO":
        return auto_feed(m, word)
    if not text.startswith(("FU", "FZ")):
        return text
    per, value = text[:2], float(text[2:]) * m.variable_unit
    if value <= 0:
        m.alarm(f"{word.address}={per} ({MEANINGS[per]}) must be greater than 0, got {value:g}", word)
    if m.speed <= 0:
        m.alarm(f"{word} needs a spindle speed", word, hint="write S in the TOOL CALL block before the definition")
    return value * m.speed * (teeth(m, word) if per == "FZ" else 1)


def from_here(m: Machine, **changed: Any) -> None:
    """Another rule from this block on, in a new list: a recorded label leaves the old one."""
    last = m.feed_rules[-1] if m.feed_rules else FeedRule(0)
    m.feed_rules = [*m.feed_rules, last._replace(step=m.step, **changed)]


@FUNCTIONS("M103", "Feed factor of plunging moves", takes="M103:F", phase="start", source="3.4")
def plunging(m: Machine, words: Words) -> None:
    """M103 F20: no faster downwards than 20 % of the feed, from this block on; without F the feed is as programmed."""
    share = 100.0
    if (word := words.get("M103:F")) is not None:
        if word.value is None:
            m.alarm("M103 F needs a number", word, hint="for example M103 F20: 20 percent")
        share = above_zero(m, word, "M103 F (percent of the feed downwards)")
    from_here(m, plunging=share / 100)


@FUNCTIONS("M109 M110 M111", TITLES, group="edge feed", phase="start", power_on="M111", source="8.6")
def edge_feed(m: Machine, words: Words) -> None:
    """From this block on the feed of compensated arcs counts at the edge (M110: only where that is slower), or at the centre."""
    from_here(m, edge=EDGES[words.code])

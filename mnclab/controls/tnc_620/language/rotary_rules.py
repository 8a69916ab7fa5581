"""How rotary axes move: M116, M126, M128 and their ends, as far as no rotary axis moves and they change nothing."""

from __future__ import annotations

from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
TITLES = {
    "M116": "Feed of rotary axes in mm/min", "M117": "End of M116", "M126": "Shortest way of rotary axes",
    "M127": "End of M126", "M128": "Tool centre point management", "M129": "End of M128",
}  # fmt: skip
GROUPS = {"rotary feed": "M116", "rotary way": "M126", "tool centre": "M128"}
WORDS = {"M128:F": "feed rate of the compensating moves", "M128:FMAX": "compensating moves at rapid"}
SOURCE = "Klartext, not described"


@FUNCTIONS("M116", TITLES, group="rotary feed", phase="start", source=SOURCE)
@FUNCTIONS("M117", TITLES, group="rotary feed", phase="end", power_on="M117", source=SOURCE)
@FUNCTIONS("M126", TITLES, group="rotary way", phase="start", source=SOURCE)
@FUNCTIONS("M127", TITLES, group="rotary way", phase="start", power_on="M127", source=SOURCE)
@FUNCTIONS("M129", TITLES, group="tool centre", phase="end", power_on="M129", source=SOURCE)
def rule(m: Machine, words: Words) -> None:
    """It waits for a rotary axis that moves."""


@FUNCTIONS("M128", TITLES, group="tool centre", phase="start", takes=" ".join(WORDS), source="9.3")
def tool_centre(m: Machine, words: Words) -> None:
    """The tip stays where it is while rotary axes move; F is for the compensating moves alone."""
    if any(m.rotary):
        m.alarm("M128 is not built yet where rotary axes have turned", words.words[0])


def refuse_rotary(m: Machine, word: Word) -> None:
    """A rotary axis moves under one of the functions."""
    for group, code in GROUPS.items():
        if m.modal.get(group) == code:
            m.alarm(f"{word.address} under {code} ({TITLES[code].lower()}) is not built yet", word)

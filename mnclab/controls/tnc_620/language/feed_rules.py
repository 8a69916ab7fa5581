"""M functions that change the feed along the way: M103 downwards, M109 to M111 at the edge on arcs (catalogue: M103, M110)."""

from __future__ import annotations

from typing import Any

from mnclab.controls.tnc_620.language.checks import above_zero
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.path.feed_rules import FeedRule

FUNCTIONS = FunctionTable()
EDGES = {"M109": "everywhere", "M110": "inside", "M111": ""}
TITLES = {
    "M109": "Constant feed at the cutting edge on arcs", "M110": "Constant feed at the edge, reduction only",
    "M111": "End of M109 and M110",
}  # fmt: skip


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

"""Cutter radius compensation (MNC, chapter 6): side and outside corners. The geometry is `path.compensation`."""

from __future__ import annotations

from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.path.compensation import ACUTE, ROUND, STRAIGHT

FUNCTIONS = FunctionTable()
SIDES = {"G40": 0, "G41": 1, "G42": -1}
TITLES = {"G40": "Radius compensation off", "G41": "Radius compensation left", "G42": "Radius compensation right"}


@FUNCTIONS("G40 G41 G42", TITLES, group="compensation", phase="compensation", power_on="G40", source="6")
def compensation(m: Machine, words: Words) -> None:
    """Takes effect with the next straight line in the plane: entry, change of side, exit."""
    m.change("side", SIDES[words.code])


CORNERS = {"G160": ROUND, "G161": STRAIGHT, "G162": ACUTE}
CORNER_TITLES = {
    "G160": "Outside corners: arc",
    "G161": "Outside corners: straight",
    "G162": "Outside corners: arc at acute corners only",
}


@FUNCTIONS("G160 G161 G162", CORNER_TITLES, group="corners", phase="plane", power_on="G160", source="6.4")
def outside_corners(m: Machine, words: Words) -> None:
    """Round outside corners the tool centre runs on an arc of its radius, or to where both offsets meet.

    The corner before the block follows its rule, so that one in the block of G40 holds for the exit.
    """
    forced = str(m.settings["outside_corners"])
    m.change("corner_rule", CORNERS.get(forced, CORNERS[words.code]))

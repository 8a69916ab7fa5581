"""Cutter radius compensation (MNC, chapter 6): side and outside corners. The geometry is ``path.compensation``."""

from __future__ import annotations

from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.path.compensation import ROUND

FUNCTIONS = FunctionTable()
SIDES = {"G40": 0, "G41": 1, "G42": -1}
TITLES = {"G40": "Radius compensation off", "G41": "Radius compensation left", "G42": "Radius compensation right"}


@FUNCTIONS("G40 G41 G42", TITLES, group="compensation", phase="compensation", power_on="G40", source="6")
def compensation(m: Machine, words: Words) -> None:
    """Takes effect with the next straight line in the plane."""
    m.change("side", SIDES[words.code])


@FUNCTIONS("G160", "Outside corners: arc", group="corners", phase="plane", power_on="G160", source="6.4")
def round_corners(m: Machine, words: Words) -> None:
    """The tool centre runs round an outside corner on an arc of the tool radius."""
    m.change("corner_rule", ROUND)

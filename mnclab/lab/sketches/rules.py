"""How a rule is written: the kinds it holds for, a whole meaning, and the picture.

The kinds are those of section or of figure (`.+`: any that is worked, nothing: what works nothing). The first rule that fits
counts; where none does there is no sketch, since none is better than one that teaches something wrong.
"""

from __future__ import annotations

from collections.abc import Callable

from mnclab.lab.sketches.drawn import drawn
from mnclab.lab.sketches.kinds import Draw
from mnclab.lab.sketches.plan import place

Rule = tuple[str, str, Draw]

TABLE = drawn(
    "thin b:8,8,56,56; thin 8,20 56,20; thin 8,32 56,32; thin 22,8 22,56; measure b:8,32,56,44; at 76,38"
)


def axes(kinds: str, words: str, picture: Callable[[str], Draw]) -> list[Rule]:
    """One rule along each axis: `{X}` stands for its letter, `{ref}` and `{1st}` for what a control calls it."""
    plane = ("x", "reference axis", "first axis"), ("y", "minor axis", "second axis")
    return [
        (kinds, words.replace("{X}", axis.upper()).replace("{ref}", reference).replace("{1st}", first), picture(axis))
        for axis, reference, first in (*plane, ("z", "((touch )?probe|tool) axis", "tool axis"))
    ]


def points(kinds: str, words: str, number: int) -> list[Rule]:
    """The coordinates of one of the points of a figure."""
    return axes(kinds, words, lambda axis: place(axis, number))

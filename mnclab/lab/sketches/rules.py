"""How a rule is written: the kinds it holds for, a whole meaning, and the picture.

The kinds are those of section or of figure (`.+`: any that is worked, nothing: what works nothing). The first rule that fits
counts; where none does there is no sketch, since none is better than one that teaches something wrong.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mnclab.lab.sketches import views
from mnclab.lab.sketches.ink import Piece, Sheet, box, circle
from mnclab.lab.sketches.kinds import Draw, Kind
from mnclab.lab.sketches.views import place

Rule = tuple[str, str, Draw]


# Pictures that are always the same, in words: `edge 5,31 52,31; dim 30,31 30,54`.
# After a style, or `part` (tint and edge), stand pieces: `x,y` a point, `x,y,r,a,b` an arc, `o:x,y,r` a circle,
# `b:left,top,right,bottom` a box; `z` closes a line. `PENS` has the other words; `say ±{}` is how the address is written.

#: word -> what it does with the sheet and the pieces after it, in which a number alone is a piece of one
PENS: dict[str, Callable[..., Any]] = {
    "part": lambda s, kind, *pieces: s.part(*pieces),
    "side": lambda s, kind: views.in_section(s, kind.section),  # the work of the cycle in section
    "figure": lambda s, kind, *pieces: views.from_above(s, kind, *pieces),  # and from above, or another figure in its place
    "stem": lambda s, kind, at: views.probe(s, at),  # a ball with its stem
    "dim": lambda s, kind, *pieces: s.measure(*pieces),  # from one point to another, and from where thin lines lead to them
    "go": lambda s, kind, *pieces: s.move(*pieces),
    "rad": lambda s, kind, centre, *how: s.radius(centre, *(number for number, in how)),
    "ang": lambda s, kind, centre, *how: s.angle(centre, *(number for number, in how)),
    "spin": lambda s, kind, at: s.spin(*at),
    "clock": lambda s, kind, at: s.clock(*at),
    "datum": lambda s, kind, at: s.datum(*at),
    "new": lambda s, kind, at: s.datum(*at, "head"),  # a datum that is set
    "at": lambda s, kind, at: setattr(s, "anchor", at),  # where the address is wanted
}


def pieces_of(words: list[str]) -> list[Piece]:
    """Pieces of a line."""
    found: list[Piece] = []
    for word in words:
        sign, _, numbers = word.rpartition(":")
        values = tuple(float(number) for number in numbers.split(","))
        found += circle(values[:2], values[2]) if sign == "o" else box(*values) if sign == "b" else [values]
    return found


def drawn(text: str) -> Draw:
    """The picture that a text describes."""

    def draw(s: Sheet, kind: Kind) -> None:
        for sentence in text.split(";"):
            verb, *words = sentence.split()
            if verb == "say":
                s.address = words[0].format(s.address)
            elif verb in PENS:
                PENS[verb](s, kind, *pieces_of(words))
            else:
                for line in [[word] for word in words] if words[0][:2] == "o:" else [words]:
                    open_line = [word for word in line if word != "z"]
                    s.draw(verb, *pieces_of(open_line), closed=open_line != line or ":" in line[0])

    return draw


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

"""Pictures that are always the same, in words: `edge 5,31 52,31; dim 30,31 30,54`.

After a style, or `part` (tint and edge), stand pieces: `x,y` a point, `x,y,r,a,b` an arc, `o:x,y,r` a circle,
`b:left,top,right,bottom` a box; `z` closes a line. `PENS` has the other words; `say ±{}` is how the address is written.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mnclab.lab.sketches import plan, sections
from mnclab.lab.sketches.ink import Piece, Sheet, box, circle
from mnclab.lab.sketches.kinds import Draw, Kind

#: word -> what it does with the sheet and the pieces after it, in which a number alone is a piece of one
PENS: dict[str, Callable[..., Any]] = {
    "part": lambda s, kind, *pieces: s.part(*pieces),
    "side": lambda s, kind: sections.work(s, kind.section),  # the work of the cycle in section
    "figure": lambda s, kind, *pieces: plan.work(s, kind, *pieces),  # and from above, or another figure in its place
    "stem": lambda s, kind, at: sections.probe(s, at),  # a ball with its stem
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

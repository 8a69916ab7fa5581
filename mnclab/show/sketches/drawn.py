"""Pictures that are always the same, in words: `edge 5,31 52,31; dim 30,31 30,54`.

After a style, or `part` (tint and edge), stand pieces: `x,y` a point, `x,y,r,a,b` an arc, `o:x,y,r` a circle,
`b:left,top,right,bottom` a box, `z` closes. The other words are those of the pen: `dim a b [feet]`, `rad c r angle`,
`ang c r from to [rays]`, `go pieces`, `ball c r`, `stem c r`, `dot c r`, `datum c`, `new c`, `spin c`, `clock c`; `figure` and
`side` draw the work of the cycle from above and in section, `at c` is where the address is wanted, `say ±{}` how it is written.
"""

from __future__ import annotations

from mnclab.show.sketches import plan, sections
from mnclab.show.sketches.ink import STYLES, Piece, Sheet, box, circle
from mnclab.show.sketches.kinds import Draw, Kind


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
            closed = "z" in words or any(word[:2] in ("o:", "b:") for word in words)
            if verb == "say":
                s.address = words[0].format(s.address)
                continue
            if verb == "figure":
                plan.work(s, kind)
                continue
            if verb == "side":
                sections.work(s, kind.section)
                continue
            pieces = pieces_of([word for word in words if word != "z"])
            at: tuple[float, float] = (pieces[0][0], pieces[0][1])
            rest = [piece[0] for piece in pieces[1:] if len(piece) == 1]
            if verb in STYLES:
                s.draw(verb, *pieces, closed=closed)
            elif verb == "dot":
                s.draw("head", *circle(at, rest[0]), closed=True)
            elif verb == "ball":
                s.draw("tool", *circle(at, rest[0]), closed=True)
            elif verb == "stem":
                sections.probe(s, at, rest[0])
            elif verb == "at":
                s.anchor = at
            elif verb in ("spin", "clock", "datum"):
                getattr(s, verb)(*at)
            elif verb == "new":
                s.datum(*at, "head")
            elif verb in ("rad", "ang"):
                getattr(s, {"rad": "radius", "ang": "angle"}[verb])(at, *rest)
            else:
                getattr(s, {"dim": "measure", "go": "move"}.get(verb, verb))(*pieces)

    return draw

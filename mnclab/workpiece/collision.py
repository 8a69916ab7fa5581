"""A collision: what met what, where in the program and in space, and how deep."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from mnclab.text.records import written
from mnclab.text.tables import html_table

KINDS = {
    "rapid": "rapid motion in material",
    "plunge": "straight down into material with a tool that does not cut at its centre",
    "shank": "the shank, or the tool above its edges, in material",
    "holder": "the holder in material",
    "fixture": "the tool in a fixture",
    "spindle": "cutting with a spindle that stands still or turns the wrong way",
    "travel": "beyond the travel of the machine",
    "insert": "the back of the insert or its holder in material",
    "chuck": "the tool in the chuck",
}
HEAD = ("place", "kind", "depth", "at", "message")


class Collision(NamedTuple):
    """`kind` is one of `KINDS`; `place` (x, y, z) mm in the coordinates of the path, `depth` mm.

    `line` stands in program number `program` of the run, whose name is `file`; `row` of the path.
    """

    kind: str
    message: str
    line: int
    program: int
    row: int
    place: tuple[float, float, float]
    depth: float
    file: str = ""

    def __str__(self) -> str:
        return f"{self.file or 'program'}:{self.line}: collision: {self.message}"

    def __repr__(self) -> str:
        return written(self)

    def as_dict(self) -> dict[str, object]:
        return self._asdict() | {"place": list(self.place)}


class Collisions(tuple[Collision, ...]):
    """Collisions in the order of the rows; shows itself as a table."""

    def __new__(cls, found: Iterable[Collision] = ()) -> Collisions:
        return super().__new__(cls, sorted(found, key=lambda each: (each.row, each.kind)))

    def __repr__(self) -> str:
        return "\n".join(map(str, self)) or "no collisions"

    def _repr_html_(self) -> str:
        rows = [
            (f"{each.file}:{each.line}".lstrip(":"), each.kind, f"{each.depth:.3f} mm",
             " ".join(f"{axis}{value:.3f}" for axis, value in zip("XYZ", each.place)), each.message)
            for each in self
        ]  # fmt: skip
        return html_table(HEAD, rows, numbers=(2,)) if rows else "<p>no collisions</p>"

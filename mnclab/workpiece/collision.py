"""A collision: what met what, where in the program and in space, and how deep."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, NamedTuple, Unpack

from mnclab.path.listing import Unit
from mnclab.path.tool import Tool
from mnclab.text.alarm import SHOWN, Alarm, several
from mnclab.text.given import SectionOptions, fitting
from mnclab.text.tables import Listing, Pictured, html_table, paragraphs, written

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mnclab.workpiece.workpiece import Workpiece

KINDS = {
    "rapid": "rapid motion in material",
    "plunge": "straight down into material with a tool that does not cut at its centre",
    "solid": "a reamer or a tap, which make no hole of their own, where there is none, or too small a one",
    "sideways": "a drill, or what else cuts along its axis alone, fed across it in material",
    "shank": "the shank, or the tool above its edges, in material",
    "holder": "the holder in material",
    "fixture": "the tool in a fixture",
    "spindle": "cutting with a spindle that stands still or turns the wrong way",
    "probe": "a probe in material between the measurements",
    "travel": "beyond the travel of the machine",
    "insert": "the back of the insert, what is beyond its edge, or its holder in material",
    "chuck": "the tool in the chuck",
    "axis": "a drill, or what else turns about its own axis, fed beside the axis of a part that turns",
}


def coordinates(axes: str, place: Iterable[float]) -> str:
    """A place as people read it: X10.000 Z-2.500."""
    return " ".join(f"{axis}{round(value, 3) + 0.0:.3f}" for axis, value in zip(axes, place))  # never -0.000


def deep(depth: float, axes: str, place: Iterable[float], unit: Unit) -> str:
    """How deep and where something was met, lengths in mm, as people read it: in the unit of the program."""
    places = coordinates(axes, (value / unit.length for value in place))
    return f"{depth / unit.length:.3f} {unit.short} deep at {places}"


def solid(tool: Tool, bored: bool, unit: Unit) -> str:
    """What is said of a tool that opens no hole, where there is none, or (`bored`) too small a one for the core of a tap."""
    if bored:
        return f"the tap in a hole narrower than {unit.figure(2 * tool.core)} {unit.short}, the minor diameter of its thread"
    return f"the {tool.kind} in full material, where it needs a hole"


class Collision(NamedTuple):
    """`kind` is one of `KINDS`; `place` (x, y, z) mm in the coordinates of the path, `depth` mm.

    `line` stands in program number `program` of the run, whose name is `file`; `row` of the path.

    >>> run = mnc.run("T1 S800 M3\\nG0 X10 Y10 Z5\\nG0 Z-3\\n", "mnc", stock=(80, 60, 20))
    >>> [(each.kind, each.line, each.depth) for each in run.collisions()]
    [('rapid', 3, 3.0)]
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


class Collisions(Pictured, Listing, tuple[Collision, ...]):
    """Collisions in the order of the rows, each row and kind once.

    Shows itself as a table of the first lines, where those of one kind in one line stand together: the deepest, and how
    many more. A path of ten thousand cuts with a still spindle is one mistake. `notes` say what was not judged.

    `reach` is "up to line 12, where the run stopped" if only a part of the program was judged, empty where all of it was.
    `ok` is whether all of the program was judged and there are none; the truth value is the opposite, so that what stands
    after `if not run.collisions()` is not reached by a run that stopped. `len` counts what was found. JSON has a tuple as a list,
    without `reach` and `notes`: `json.dumps(run.collisions().as_dict())`.
    """

    HEAD = ("place", "kind", "message")
    part: Callable[[], Workpiece] | None = None

    def __new__(
        cls, found: Iterable[Collision] = (), notes: Iterable[str] = (), reach: str = "",
        part: Callable[[], Workpiece] | None = None,
    ) -> Collisions:  # fmt: skip
        made = super().__new__(cls, sorted(found, key=lambda each: (each.row, each.kind)))
        made.notes, made.reach, made.part = tuple(notes), reach, part
        return made

    @fitting
    def plot(self, *, colour: str = "depth", **options: Unpack[SectionOptions]) -> Figure:
        """The part that the run leaves, with a red cross at each; options as in `Workpiece.plot`."""
        if self.part is None:
            raise Alarm("these collisions are of no run that could be drawn", hint="run.collisions().plot()")
        return self.part().plot(collisions=self, colour=colour, **options)

    @property
    def ok(self) -> bool:
        """Whether all of the program was judged and nothing was found."""
        return not (len(self) or self.reach or self.notes)

    def __bool__(self) -> bool:
        return not self.ok

    def as_dict(self) -> dict[str, object]:
        """All that is known as one record for JSON: a list of the collisions alone says nothing of where a run stopped."""
        found = {"ok": self.ok, "reach": self.reach, "sentence": self.sentence, "notes": list(self.notes)}
        return found | {"collisions": [each.as_dict() for each in self]}

    @property
    def sentence(self) -> str:
        """How many, and how far was looked: "no collisions up to line 12, where the run stopped"."""
        count = several(len(self), "collision") if len(self) else "no collisions"
        return " ".join(filter(None, [count, "where judged" if self.notes else "", self.reach]))

    @property
    def by_line(self) -> list[tuple[Collision, int]]:
        """The deepest of each kind in each line, and how many there are, in the order of their first rows."""
        groups: dict[tuple[int, int, str], list[Collision]] = {}
        for each in self:
            groups.setdefault((each.program, each.line, each.kind), []).append(each)
        return [(max(group, key=lambda each: each.depth), len(group)) for group in groups.values()]

    def _shown(self) -> tuple[list[tuple[Collision, str]], str]:
        """What people are shown: the first lines, each with how many more it has, and a sentence about the others."""
        groups = self.by_line
        first = [(each, f"; {n - 1} more like it in this line" if n > 1 else "") for each, n in groups[:SHOWN]]
        rest = sum(n for _, n in groups[SHOWN:])
        more = f"… and {several(rest, 'more collision')}, {len(self)} in all" if rest else ""
        return first, more

    def __repr__(self) -> str:
        first, more = self._shown()
        lines = [*(f"{each}{others}" for each, others in first), *filter(None, [more])]
        lines += [self.sentence] if self.reach or not lines else []
        return "\n".join([*lines, *(f"  note: {note}" for note in self.notes)])

    def texts(self) -> list[tuple[str, ...]]:
        """All collisions, row by row."""
        return [_cells(each) for each in self]

    def _repr_html_(self) -> str:
        first, more = self._shown()
        rows = [_cells(each, others) for each, others in first]
        table = html_table(self.HEAD, rows) if rows else ""
        said = self.sentence if self.reach or not rows else ""
        return table + paragraphs(more, said, *self.notes)


def _cells(each: Collision, others: str = "") -> tuple[str, str, str]:
    return f"{each.file}:{each.line}".lstrip(":"), each.kind, each.message + others

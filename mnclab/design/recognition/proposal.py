"""From a path to a design: the features that a program makes, found in the geometry of its moves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from mnclab.design.model.design import Design
from mnclab.design.model.features import Chamfer
from mnclab.design.recognition.areas import areas_of
from mnclab.design.recognition.figures import chamfers, figures, together
from mnclab.design.recognition.naming import lines, names
from mnclab.design.recognition.sorting import sort
from mnclab.text.alarm import Alarm
from mnclab.workpiece.cutting import Cutting

MOST = 20_000  # moves, beyond which a path is that of a surface


@dataclass(frozen=True, repr=False)
class Proposal(Design):
    """A design found in a path. `notes` say what of it has no name, and is not in the design."""

    notes: tuple[str, ...] = field(default=(), kw_only=True)


def proposed(cutting: Cutting) -> Proposal:
    """The design that the moves of a mill make of their blank, features in the order of cutting, named by their lines."""
    if (many := int(cutting.cuts.sum())) > MOST:
        raise Alarm(f"a design is proposed of at most {MOST} moves, got {many}", hint="run.workpiece() shows what is cut")
    design = Proposal(cutting.stock)
    blank, (low, high) = design.outline_of_blank, design.bounds[:, 2].tolist()
    work = sort(cutting)
    areas, sloping = areas_of(work.levels, work.slopes, blank)
    found = [each for area in areas for each in figures(area, blank, work, high, low)]
    found, threads, points = together(found, work, high, low)
    edges, engraved = chamfers(found, work.cones, blank, high)
    found = sorted(found + edges, key=lambda each: (isinstance(each.feature, Chamfer), each.row))
    notes = (*_notes(cutting, work.cornered, {
        "what is cut aslant has no name": sloping, "what a round tool cuts has no name": work.balls,
        "the point of a tool alone has no name": points, "what a pointed tool cuts has no name": engraved,
    }), *threads)  # fmt: skip
    said = names(cutting, [each.row for each in found])
    return replace(design, features=tuple(replace(each.feature, name=name) for each, name in zip(found, said)), notes=notes)


def _notes(cutting: Cutting, cornered: dict[float, list[int]], left: dict[str, list[int]]) -> Iterator[str]:
    yield from cutting.notes()
    if cutting.tilted is not None and (out := cutting.cuts & cutting.tilted).any():
        yield f"rows of a tool not along Z are left out ({cutting.lines(out)})"
    for corner, rows in sorted(cornered.items()):
        yield f"floors have round corners of {corner:g} mm that the design has not ({lines(cutting, rows)})"
    for what, rows in left.items():
        if rows:
            yield f"{what} ({lines(cutting, rows)})"

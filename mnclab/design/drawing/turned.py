"""The view of a turned part: from the side, its upper half cut where there is something inside, with all its dimensions.

The axis lies level, the front end to the right. Lengths count from the front end.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

from mnclab.design.drawing.dimensions import Point
from mnclab.design.drawing.elevation import SAME, Seen, Step, look
from mnclab.design.drawing.ledger import Draft, Ledger
from mnclab.design.drawing.turned_dimensions import Turning
from mnclab.design.drawing.view import Axis, Kind, Origin
from mnclab.design.model.turned_design import TurnedDesign
from mnclab.design.model.turned_features import Bore, FaceGroove
from mnclab.design.model.turned_threads import Thread
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region

FAR = 1e6  # mm
SKY = np.diag([1.0, -1.0, 1.0])  # depth grows from outside to the axis


def drafts(design: TurnedDesign, ledger: Ledger) -> list[Draft]:
    """The view with all that is written to it; what is solid but for centre holes is not cut."""
    region = Region(tuple(design.section))
    outside, inside = look(_turned(region)), look(region)
    first = design.bodies[0].section
    cut = _hollow(look(first)) or any(isinstance(each, Bore | FaceGroove) for each in design.features)
    draft = Draft("from the side", (0, 0))
    lower = list(_outside(outside))
    draft.draw([line.transformed(np.diag([1.0, -1.0, 1.0])) for line in lower])
    if cut:
        draft.hatches = (region,)
        draft.draw([line for loop in region.loops for line in _off_axis(loop)])
        draft.draw(list(_edges(outside, 0.0)))
        draft.draw(list(_bore_edges(inside)))
    else:
        draft.draw(lower)
        draft.draw(list(_edges(outside, 1.0)))
    for each in design.threads:
        _thread(draft, region, each)
    low, high = design.outline_as_drawn.ends
    draft.axes.append(Axis((low, 0.0), (high, 0.0)))
    if low - SAME <= 0 <= high + SAME:
        draft.axes.append(Origin((0.0, 0.0)))
    Turning(design, draft, ledger).write()
    return [draft]


def _turned(region: Region) -> Region:
    return Region(tuple(loop.transformed(SKY) for loop in region.loops))


def _hollow(inside: Seen) -> bool:
    """Whether something is inside: what one sees from the axis is not the axis alone."""
    return bool(((inside.labels >= 0) & (np.abs(inside.ends()) > SAME).any(axis=1)).any())


def _outside(seen: Seen) -> Iterator[Contour]:
    """The silhouette above the axis, (z, r)."""
    before = 0.0
    ends = -seen.ends()
    for k, (piece, label) in enumerate(zip(seen.pieces, seen.labels.tolist(), strict=True)):
        (u0, u1), (r0, r1) = seen.places[k : k + 2].tolist(), ends[k].tolist()
        if label < 0:
            r0 = r1 = 0.0
        if abs(r0 - before) > SAME:
            yield Contour([(u0, before), (u0, r0)], closed=False)
        if label >= 0 and max(r0, r1) > SAME:
            yield _piece((u0, r0), (u1, r1), -piece[5], -piece[6], piece[4])
        before = r1
    if before > SAME:
        yield Contour([(float(seen.places[-1]), before), (float(seen.places[-1]), 0.0)], closed=False)


def _piece(start: Point, end: Point, r: float, side: float, z: float) -> Contour:
    """A line, or an arc about (z, r) of a radius, above its centre where `side` is positive."""
    if side == 0:
        return Contour([start, end], closed=False)
    a, b = (math.atan2(y - r, x - z) for x, y in (start, end))
    sweep = (b - a) % math.tau
    sweep = sweep - math.tau if side > 0 else sweep  # from left to right: above clockwise
    return Contour([start, end], [math.tan(sweep / 4), 0.0], closed=False)


def _edges(seen: Seen, upper: float) -> Iterator[Contour]:
    """Where the outside steps or bends: upright lines down to its silhouette below, from that above or from the axis."""
    for u, r in _at_edges(seen, -seen.ends(), max):
        if r > SAME and seen.places[0] + SAME < u < seen.places[-1] - SAME:
            yield Contour([(u, upper * r), (u, -r)], closed=False)


def _bore_edges(seen: Seen) -> Iterator[Contour]:
    """Where the inside steps, bends or ends: upright lines from the axis to the narrower side."""
    for u, r in _at_edges(seen, seen.ends(), min):
        if SAME < r < FAR:
            yield Contour([(u, 0.0), (u, r)], closed=False)


def _at_edges(seen: Seen, radii: Floats, chosen: Callable[[list[float]], float]) -> Iterator[Point]:
    """Places of upright lines, with the greater or the smaller radius beside them."""
    for u in seen.edges():
        k = int(np.abs(seen.places - u).argmin())
        beside = [*([float(radii[k - 1, 1])] if k else []), *([float(radii[k, 0])] if k < len(radii) else [])]
        yield u, chosen(beside)


def _off_axis(loop: Contour) -> Iterator[Contour]:
    """The elements of a section that are not its axis."""
    for start, end, bulge in zip(loop.starts, loop.ends, loop.bulge, strict=True):
        if max(abs(start[1]), abs(end[1])) > SAME or bulge:
            yield Contour([start, end], [bulge, 0.0], closed=False)


def _thread(draft: Draft, region: Region, thread: Thread) -> None:
    """The thin lines of a thread, and the line where it ends."""
    r = (thread.major if thread.inside else thread.minor) / 2
    seen = look(region, (Step(-FAR, FAR, r),))
    for a, b in seen.cuts():
        low, high = max(a, thread.end), min(b, thread.start)
        if high - low > SAME:
            for side in (1,) if thread.inside else (1, -1):
                draft.draw([Contour([(low, side * r), (high, side * r)], closed=False)], Kind.THIN)
            if abs(low - thread.end) < SAME and a < thread.end - SAME:
                edge = thread.minor / 2 if thread.inside else thread.major / 2
                line = [(low, edge), (low, r)] if thread.inside else [(low, edge), (low, -edge)]
                draft.draw([Contour(line, closed=False)])

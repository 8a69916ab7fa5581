"""Slots exactly as wide as the tool: one stroke along the middle line, where no way round is left. Lengths in mm.

The area inset by R less a hair h is there a sliver, at most 2·h wide. Wherever two of its elements lie so close, as two lines
or two arcs about one centre do, half way between them is the stroke; strokes that go on from one another are one.
"""

from __future__ import annotations

import numpy as np

from mnclab.geometry.chords import near
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Curves, at, distance, length_of, nearest, share
from mnclab.geometry.cutting import boxes, outlines_of
from mnclab.geometry.regions import Region
from mnclab.machining.milling.clearing import EXACT, begin, end

WIDTH = 2 * EXACT + 1e-9  # mm, of a sliver
LEAST = 1e-3  # mm, the shortest piece of a stroke
MEETS = 1e-6  # mm, by which pieces of one stroke may be apart
INNER = np.array([0.01, 0.5, 0.99])  # of a piece: where it is looked at


def strokes(region: Region, reach: float) -> list[Contour]:
    """The middle lines of what in a region is just 2·`reach` wide, closed ones among them; a point of a round hole."""
    thin = region.inset(reach - EXACT)
    if not thin.loops:
        return []
    spots = [loop.bounds.mean(axis=0) for loop in thin.loops if np.ptp(loop.bounds, axis=0).max() <= 2 * WIDTH]
    lines = _chained(_pieces(outlines_of(thin.loops).curves))
    return [*(Contour([p, p], closed=False) for p in spots), *(_shortened(line, region, reach) for line in lines)]


def _pieces(edges: Curves) -> list[Contour]:
    """What lies half way between two edges that are as close as the sides of a sliver, edge by edge."""
    found = []
    for pair in near(*boxes(edges), WIDTH):
        here, there = (edges.take(each) for each in pair)
        spots = np.stack([here.start, here.end, there.start, there.end])
        off = np.stack([distance(spot, other) for spot, other in zip(spots, (there, there, here, here), strict=True)])
        spots[off > WIDTH] = np.nan  # ends that lie on the other edge, some way apart: neighbours share one
        with np.errstate(invalid="ignore"):
            apart = np.nanmax(length_of(spots[:, None] - spots), axis=(0, 1), initial=0.0)
        for j in np.flatnonzero(apart > LEAST):
            one, other = here.take(np.array([j])), there.take(np.array([j]))
            cuts = np.concatenate([[0.0, 1.0], share(other.start, one), share(other.end, one)])
            cuts = np.unique(cuts[(cuts >= 0) & (cuts <= 1)])
            for first, last in zip(cuts, cuts[1:], strict=False):
                tried = (first + (last - first) * INNER).tolist()
                if max(float(distance(at(one, s), other)[0]) for s in tried) > WIDTH:
                    continue
                ends = np.vstack([at(one, first), at(one, last)])
                across = np.vstack([nearest(spot[None], other) for spot in ends])
                bulge = np.tan(one.sweep[0] * (last - first) / 4)
                found.append(Contour((ends + across) / 2, [bulge, 0.0], closed=False))
    return [piece for piece in found if piece.length > LEAST]


def _chained(pieces: list[Contour]) -> list[Contour]:
    """Pieces that go on from one another as one, in either direction; closed where they come round."""
    chains: list[Contour] = []
    for piece in pieces:
        for other in list(chains):  # a piece may join two chains
            whole = _joined(piece, other)
            if whole is not None:
                chains = [chain for chain in chains if chain is not other]
                piece = whole
        chains.append(piece)
    return [_closed(chain) for chain in chains]


def _joined(a: Contour, b: Contour) -> Contour | None:
    """Two pieces as one, if an end of one is an end of the other."""
    for first, second in ((a, b), (b, a), (a, b.reversed()), (a.reversed(), b)):
        if length_of(begin(second) - end(first)) < MEETS:
            return Contour([*first.points, *second.points[1:]], [*first.bulge[:-1], *second.bulge], closed=False)
    return None


def _closed(chain: Contour) -> Contour:
    comes_round = len(chain.points) > 2 and length_of(end(chain) - begin(chain)) < MEETS
    return Contour(chain.points[:-1], chain.bulge[:-1]) if comes_round else chain


def _shortened(line: Contour, region: Region, reach: float) -> Contour:
    """A stroke that keeps from walls ahead of its ends as far as from those beside it."""
    if line.closed:
        return line
    keep = min(reach, float(region.distance([line.point_at(line.length / 2)[0]])[0]))
    first, last = np.clip(keep - region.distance(line.points[[0, -1]]), 0.0, EXACT)
    return line.between(first, line.length - last)

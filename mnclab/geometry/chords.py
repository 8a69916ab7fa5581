"""Places where the walls of a contour face each other, and which of many boxes lie near each other."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.curves import Curves, Floats, counted, cross, dot, foot, length_of, on, unit_of

# Which of many boxes lie near each other: a grid of cells, so that far ones are never compared.

Index = NDArray[np.int64]
PAIRS = 1 << 18  # pairs handed out at once


def near(low: Floats, high: Floats, gap: float) -> Iterator[tuple[Index, Index]]:
    """Pairs a < b of boxes (n, 2) nearer than `gap` mm along both axes, each pair once, in batches."""
    n = len(low)
    if n < 2:
        return
    low, high = low - gap / 2, high + gap / 2
    size = float(np.maximum(np.median(high - low), 1e-9))
    origin = low.min(axis=0)
    while True:  # every box lies in all the cells that it touches, in about four of them on average
        first = np.floor((low - origin) / size).astype(np.int64)
        count = np.floor((high - origin) / size).astype(np.int64) - first + 1
        cells = count[:, 0] * count[:, 1]
        if cells.sum() <= 8 * n + 64:
            break
        size *= 1.5
    box, nth = counted(cells)
    column = first[box, 0] + nth % count[box, 0]
    row = first[box, 1] + nth // count[box, 0]
    key = row * (int(first[:, 0].max() + count[:, 0].max()) + 1) + column
    order = np.argsort(key, kind="stable")
    box, key, column, row = box[order], key[order], column[order], row[order]
    # each entry is compared with those after it in its cell
    partners = np.searchsorted(key, key, "right") - np.arange(len(key)) - 1
    begin, before = 0, np.append(0, np.cumsum(partners))  # pairs of all entries before each
    while begin < len(key):
        stop = max(begin + 1, int(np.searchsorted(before, before[begin] + PAIRS, "right")) - 1)
        here = np.repeat(np.arange(begin, stop), partners[begin:stop])
        there = here + 1 + np.arange(before[begin], before[stop]) - before[here]
        a, b = box[here], box[there]
        corner = np.maximum(first[a], first[b])  # of all cells that both lie in only the first counts
        meet = (low[a] <= high[b]).all(axis=1) & (low[b] <= high[a]).all(axis=1)
        meet &= (column[here] == corner[:, 0]) & (row[here] == corner[:, 1])
        if meet.any():
            yield np.minimum(a[meet], b[meet]), np.maximum(a[meet], b[meet])
        begin = stop


# Places where the walls of a contour face each other: the shortest ways across from wall to wall.
# A wall is a line or an arc with a free side, where the tool is. A *chord* is a straight way between two points of the walls
# that is shortest among its neighbours: it leaves both walls at a right angle into the free side, or leads from a vertex into
# the wedge between the normals of the two walls that meet there. A tool wider than a chord cannot pass it; growing a tool
# from nothing, it first touches two walls that are no neighbours at the ends of a chord, opposite each other.
# Two walls can face each other only if a normal of one is opposite to a normal of the other. So the walls are taken in
# chunks of neighbours with a box and a cone of normals each, and only chunks near each other with opposite cones are
# looked into: along a smooth contour there are hardly any.

Mask = NDArray[np.bool_]

EXACT = 1e-9  # mm, and rad between a chord and a normal
SLACK = 1e-12  # of a wall: beyond its ends a point is still on it
COARSE, FINE = 64, 8  # walls in a chunk
PIECE = 1 << 14  # walls summed up at once
BATCH = 1 << 16  # pairs of walls worked on at once


class Walls(NamedTuple):
    """n walls in the order of travel: curves, unit normals towards the tool at start and end (n, 2), `joined` (n,):
    whether the wall begins where the one before ends, `s` (n,) the side: +1 left, -1 right; `group` (n,): only walls
    of one group are compared, and they follow each other."""

    curves: Curves
    n_in: Floats
    n_out: Floats
    joined: Mask
    s: Floats
    group: Index


class Chords(NamedTuple):
    """m chords: the walls `i` < `j` (m,), the points `p` on i and `q` on j (m, 2), and the length (m,) mm."""

    i: Index
    j: Index
    p: Floats
    q: Floats
    length: Floats


def facing(walls: Walls, width: Floats, coarse: Chunks) -> Chords:
    """The shortest chord of every pair of walls (`coarse` are their chunks) below `width` (n,) mm, the same in a group."""
    none = np.zeros(0, dtype=np.int64)
    found = [Chords(none, none, np.empty((0, 2)), np.empty((0, 2)), np.empty(0))]
    found += [chords(walls, i, j) for i, j in _pairs(walls, width, coarse)]
    every = Chords._make(map(np.concatenate, zip(*found, strict=True)))
    short = every.length < width[every.i] - EXACT
    return Chords._make(column[short] for column in every)


class Chunks(NamedTuple):
    """Boxes (m, 2) of chunks of walls, and cones of their normals: middle (m, 2) and half angle (m,) rad."""

    low: Floats
    high: Floats
    middle: Floats
    spread: Floats

    def opposed(self, a: Index, b: Index) -> Mask:
        """Whether a normal of chunk a (k,) can be opposite to one of chunk b."""
        most = np.minimum(self.spread[a] + self.spread[b] + 1e-6, np.pi)
        return np.asarray(-dot(self.middle[a], self.middle[b]) >= np.cos(most) - 1e-9)

    def near(self, a: Index, b: Index, gap: float) -> Mask:
        """Whether the boxes of chunks a and b (k,) are nearer than a gap."""
        return np.asarray(((self.low[a] - gap <= self.high[b]) & (self.low[b] - gap <= self.high[a])).all(axis=1))


def chunks(walls: Walls, size: int = COARSE) -> Chunks:
    """Chunks of `size` walls; the last may be shorter."""
    n = len(walls.s)
    step = size * max(1, PIECE // size)  # a piece at a time stays in the cache
    pieces = [_chunks(walls, k, min(k + step, n), size) for k in range(0, n, step)]
    if len(pieces) == 1:
        return pieces[0]
    return Chunks(*(np.concatenate(columns) for columns in zip(*pieces, strict=True)))


def _chunks(walls: Walls, begin: int, end: int, size: int) -> Chunks:
    piece, n = slice(begin, end), len(walls.s)
    c, n_in = walls.curves, walls.n_in[piece]
    arc = c.arc[piece]
    at = np.arange(0, end - begin, size)
    low, high = np.empty((len(at), 2)), np.empty((len(at), 2))
    k = np.flatnonzero(arc)
    bulge = np.zeros(end - begin)
    if len(k):
        turned, r = np.abs(c.sweep[piece][k]), c.r[piece][k]
        bulge[k] = r * np.where(turned < np.pi, 1 - np.cos(np.minimum(turned, np.pi) / 2), 2.0)
    for axis in (0, 1):
        one, two = c.start[piece, axis], c.end[piece, axis]
        least, most = np.minimum(one, two), np.maximum(one, two)
        if len(k):
            least, most = least - bulge, most + bulge
        low[:, axis], high[:, axis] = np.minimum.reduceat(least, at), np.maximum.reduceat(most, at)
    total = np.stack([np.add.reduceat(n_in[:, 0], at), np.add.reduceat(n_in[:, 1], at)], axis=1)
    length, middle = length_of(total), unit_of(total)
    each = np.repeat(middle, np.diff(np.append(at, end - begin)), axis=0)
    least = dot(n_in, each)
    if len(k):
        least = np.minimum(least, dot(walls.n_out[piece], each))
        least[np.abs(c.sweep[piece]) > np.pi / 2] = -1.0
    least = np.minimum.reduceat(least, at)
    # the vertices at both ends belong to the chunk, with the normals beyond them
    least = np.minimum(least, dot(walls.n_out[np.maximum(begin + at - 1, 0)], middle))
    least = np.minimum(least, dot(walls.n_in[np.minimum(begin + at + size, n - 1)], middle))
    spread = np.where((least > 0) & (length > 0), np.arccos(np.clip(least, -1.0, 1.0)), np.pi)
    return Chunks(low, high, middle, spread)


def around(coarse: Chunks, at: Floats, reach: float, n: int) -> Index:
    """The walls of all n in chunks whose boxes are nearer than `reach` to a point (2,)."""
    there = ((coarse.low - reach <= at) & (coarse.high + reach >= at)).all(axis=1)
    k = (np.flatnonzero(there)[:, None] * COARSE + np.arange(COARSE)).ravel()
    return k[k < n]


def _pairs(walls: Walls, width: Floats, coarse: Chunks) -> Iterator[tuple[Index, Index]]:
    """Pairs i < j of walls that may face each other, in batches."""
    n, gap = len(walls.s), float(width.max(initial=0.0))
    fine: Chunks | None = None
    itself = np.flatnonzero(coarse.spread > np.pi / 2 - 1e-3)
    for a, b in chain(near(coarse.low, coarse.high, gap), [(itself, itself)]):
        opposed = coarse.opposed(a, b)
        if not opposed.any():
            continue
        fine = chunks(walls, FINE) if fine is None else fine
        for c, d in _inside(a[opposed], b[opposed], COARSE // FINE, len(fine.spread)):
            keep = fine.near(c, d, gap) & fine.opposed(c, d)
            for i, j in _inside(c[keep], d[keep], FINE, n):
                keep_pair = (i < j) & (walls.group[i] == walls.group[j])
                if keep_pair.any():
                    yield i[keep_pair], j[keep_pair]


def may_cross(walls: Walls, coarse: Chunks) -> Index:
    """The walls that may cross another one (m,). A chunk whose directions keep within half a turn always goes on in one
    direction, so it cannot cross itself, nor the next one while both together keep so."""
    n, begin = len(walls.s), np.arange(len(coarse.spread)) * COARSE
    torn = ~walls.joined
    torn[begin] = False
    looked = (coarse.spread >= np.pi / 2 - 1e-6) | np.logical_or.reduceat(torn, begin)
    for a, b in near(coarse.low, coarse.high, 0.0):
        between = np.arccos(np.clip(dot(coarse.middle[a], coarse.middle[b]), -1.0, 1.0))
        onward = (b == a + 1) & walls.joined[begin[b]] & (between + coarse.spread[a] + coarse.spread[b] < np.pi - 1e-6)
        looked[a[~onward]] = looked[b[~onward]] = True
    return np.flatnonzero(np.repeat(looked, COARSE)[:n])


def _inside(a: Index, b: Index, size: int, n: int) -> Iterator[tuple[Index, Index]]:
    """The parts of chunks a and b (k,), each with each, where a chunk has `size` of them and there are n in all."""
    one, two = np.divmod(np.arange(size * size), size)
    step = max(1, BATCH // (size * size))
    for k in range(0, len(a), step):
        i = (a[k : k + step, None] * size + one).ravel()
        j = (b[k : k + step, None] * size + two).ravel()
        there = (i < n) & (j < n) & (i <= j)
        yield i[there], j[there]


class _Best:
    """The shortest chord found so far for each of m pairs."""

    def __init__(self, m: int) -> None:
        self.length, self.p, self.q = np.full(m, np.inf), np.full((m, 2), np.nan), np.full((m, 2), np.nan)

    def offer(self, k: Index, p: Floats, q: Floats, valid: Mask, turned: bool = False) -> None:
        """Chords from p to q (len(k), 2) of the pairs k, where valid; `turned` from q to p."""
        p, q = (q, p) if turned else (p, q)
        length = length_of(q - p)
        better = valid & (length > EXACT) & (length < self.length[k])
        self.length[k[better]], self.p[k[better]], self.q[k[better]] = length[better], p[better], q[better]


def chords(walls: Walls, i: Index, j: Index) -> Chords:
    """The shortest chord between walls i and j (m,); infinite where there is none."""
    c, best, every = walls.curves, _Best(len(i)), np.arange(len(i))
    one, two = c.take(i), c.take(j)
    ends = []  # walls, points, whether they are the last of the walls, and whether they are theirs
    for k, curve in ((i, one), (j, two)):  # a vertex between two walls is that of the second
        ends += [(k, curve.start, False, np.ones(len(k), dtype=bool)), (k, curve.end, True, ~_after(walls, k)[1])]
    # from vertex to vertex, within the wedges at both
    for a, p, p_last, p_own in ends[:2]:
        for b, q, q_last, q_own in ends[2:]:
            u = unit_of(q - p)
            valid = p_own & q_own & _in_cone(walls, a, p_last, u) & _in_cone(walls, b, q_last, -u)
            best.offer(every, p, q, valid)
    # from a vertex square to the other wall
    for near_ends, b, curve, turned in ((ends[:2], j, two, False), (ends[2:], i, one, True)):
        for a, p, p_last, p_own in near_ends:
            q = foot(p, curve)
            u = unit_of(q - p)
            valid = p_own & on(q, curve, SLACK) & _in_cone(walls, a, p_last, u) & (dot(u, _normal(walls, b, q)) < 0)
            best.offer(every, p, q, valid, turned)
    _between_curves(walls, i, j, best)  # square to both walls
    k = np.flatnonzero(np.isfinite(best.length))
    return Chords(i[k], j[k], best.p[k], best.q[k], best.length[k])


def _between_curves(walls: Walls, i: Index, j: Index, best: _Best) -> None:
    """Chords that end inside both walls; one of them must be an arc that curves away from the tool."""
    c = walls.curves
    away = c.arc & (walls.s * c.sweep < 0)
    for a, b, turned in ((i, j, False), (j, i, True)):
        k = np.flatnonzero(away[a] & ~c.arc[b])  # round wall and straight wall: the perpendicular through the centre
        if len(k):
            arc, line = c.take(a[k]), c.take(b[k])
            q = foot(arc.centre, line)
            p = arc.centre + arc.r[:, None] * unit_of(q - arc.centre)
            clear = length_of(q - arc.centre) > arc.r
            valid = clear & on(p, arc, SLACK) & on(q, line, SLACK) & (dot(p - q, walls.n_in[b[k]]) > 0)
            best.offer(k, p, q, valid, turned)
        k = np.flatnonzero(away[a] & c.arc[b] & (~away[b] | (not turned)))  # the line of the centres
        if len(k):
            arc, other = c.take(a[k]), c.take(b[k])
            between, both = other.centre - arc.centre, away[b[k]]
            apart = length_of(between)
            clear = np.where(both, apart > arc.r + other.r, apart + arc.r < other.r) & (apart > EXACT)
            u = unit_of(between) * np.where(both, 1.0, -1.0)[:, None]
            p = arc.centre + arc.r[:, None] * u
            q = other.centre + np.where(both, -other.r, other.r)[:, None] * u
            best.offer(k, p, q, clear & on(p, arc, SLACK) & on(q, other, SLACK), turned)


def _after(walls: Walls, k: Index) -> tuple[Index, Mask]:
    """The walls after walls k, and which of them begin where those end."""
    after = np.minimum(k + 1, len(walls.s) - 1)
    return after, walls.joined[after] & (after > k)


def _normal(walls: Walls, k: Index, at: Floats) -> Floats:
    """The normals towards the tool of walls k at points (m, 2) on them."""
    c = walls.curves
    inward = (c.centre[k] - at) / c.r[k, None]
    return np.where(c.arc[k, None], (walls.s[k] * np.sign(c.sweep[k]))[:, None] * inward, walls.n_in[k])


def _in_cone(walls: Walls, k: Index, last: bool, u: Floats) -> Mask:
    """Whether directions u (m, 2) lie in the wedge between the normals at the end or the start of walls k.

    At an inside corner there is no wedge, only the normals themselves.
    """
    if last:
        after, follows = _after(walls, k)
        first, second = walls.n_out[k], np.where(follows[:, None], walls.n_in[after], walls.n_out[k])
    else:
        before = np.maximum(k - 1, 0)
        follows = walls.joined[k] & (before < k)
        first, second = np.where(follows[:, None], walls.n_out[before], walls.n_in[k]), walls.n_in[k]
    from_first, to_second, s = cross(first, u), cross(u, second), walls.s[k]
    wedge = (s * from_first <= EXACT) & (s * to_second <= EXACT) & (dot(u, first + second) >= -EXACT)
    along = (np.abs(from_first) <= EXACT) & (dot(first, u) > 0) | (np.abs(to_second) <= EXACT) & (dot(second, u) > 0)
    return np.asarray(wedge | along)

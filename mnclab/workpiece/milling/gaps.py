"""What tools took away that do not stand along Z: gaps in the upright columns of a part.

Seen along its own direction such a tool is upright, and its rows are moves as any other. A straight move takes away a convex
body, all that stands above the tool with it, so that an upright line has one gap of each. Arcs are chords within `CHORD` mm.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.clamped import Placement
from mnclab.workpiece.milling.moves import CHORD, STILL, Moves, cut_up, joined
from mnclab.workpiece.milling.raster import AT_ONCE, NOISE
from mnclab.workpiece.milling.swept import left_by
from mnclab.workpiece.outcome import spend

FEW, NARROWINGS, TURNS = 9, 40, 33  # places of a line under a tool; of its lowest one; of where it leaves the tool
NO_GAP = -2  # no row, not even one before
RIM = 1e-12  # of the way to the rim of a tool, by which the last place is nearer
PAIRS, TOGETHER = 20_000_000, 1000  # points times moves, twice, beyond which fewer columns tell what each row took; points
EFFORT = 20  # times the work of a point under an upright move

Faces = Callable[[Array, Array], tuple[Array, Array]]  # upper and lower side of the blank at points (m,)
Group = tuple[Moves, Placement]  # moves of one direction, along Z of their own frame, and where that stands


@dataclass(frozen=True, eq=False)
class Gaps:
    """What moves of other directions took away, over the box of a part (2, 3); those `before` are gaps of its blank."""

    groups: tuple[Group, ...]
    bounds: Array
    before: Gaps | None = None

    @cached_property
    def _straight(self) -> list[Moves]:
        return [_straight(moves) for moves, _ in self.groups]

    @cached_property
    def moves(self) -> Moves:
        """All of them as straight ones (k,), each in its own frame."""
        return joined(self._straight)

    @cached_property
    def frames(self) -> tuple[Array, Array]:
        """How the frame of each move is turned (k, 3, 3) and shifted (k, 3)."""
        turn, shift = (np.stack([getattr(place, name) for _, place in self.groups]) for name in ("turn", "shift"))
        return turn[self.group], shift[self.group]

    @cached_property
    def group(self) -> Index:
        """The group of each move (k,)."""
        return np.repeat(np.arange(len(self.groups)), [len(each) for each in self._straight])

    @cached_property
    def boxes(self) -> Array:
        """What each move reaches in the plane (k, 4), as far as the box of the part is high."""
        moves, (turn, shift), (low, high) = self.moves, self.frames, self.bounds[:, 2]
        ends = np.stack([np.einsum("kij,kj->ki", turn, end) + shift for end in (moves.start, moves.end)])
        way, wide = turn[:, :, 2], moves.radius[:, None]
        up = way[:, 2] > 0
        room = np.where(up, high - ends[..., 2].min(axis=0), ends[..., 2].max(axis=0) - low) + moves.radius
        away = np.linalg.norm(ends - self.bounds.mean(axis=0), axis=2).max(axis=0) + np.linalg.norm(np.ptp(self.bounds, axis=0))
        long = np.minimum(np.clip(room, 0.0, None) / np.maximum(np.abs(way[:, 2]), STILL), away)
        ends = np.concatenate([ends, ends + long[:, None] * way])[..., :2]
        return np.concatenate([ends.min(axis=0) - wide, ends.max(axis=0) + wide], axis=1)

    @cached_property
    def deepest(self) -> Index:
        """Those moves (k,) that matter where nobody asks which took a place: of plunges of a tool at one place the deepest."""
        moves, ends = self.moves, np.stack([self.moves.start, self.moves.end])
        own = np.where(moves.ways <= STILL, -1, np.arange(len(moves)))  # another move is alone with its number
        key = np.column_stack([own, self.group, ends[0, :, :2].round(9), *moves.shape])
        order = np.argsort(ends[..., 2].min(axis=0), kind="stable")
        return np.sort(order[np.unique(key[order], axis=0, return_index=True)[1]])

    def spans(self, x: Array, y: Array, among: Index | None = None) -> Iterator[tuple[Index, Index, Array, Array]]:
        """Some of the points (m,) after the other (i,): the moves (k,) that may have come over or under them, and from where to
        where each has taken the upright line there (k, i); upside down where it has not. `among` those moves alone."""
        among = np.arange(len(self.moves)) if among is None else among
        boxes, left = self.boxes[among], [np.arange(len(x))] if len(x) else []
        while left:
            some = left.pop()
            px, py = x[some], y[some]
            near = (boxes[:, 0] <= px.max()) & (boxes[:, 2] >= px.min()) & (boxes[:, 1] <= py.max()) & (boxes[:, 3] >= py.min())
            which = among[near]
            if len(some) > 1 and len(which) * len(some) > AT_ONCE:
                order = some[np.argsort(px if np.ptp(px) > np.ptp(py) else py, kind="stable")]
                left += [order[: len(some) // 2], order[len(some) // 2 :]]
            elif len(which):
                spend(EFFORT * len(which) * len(some))
                turn, shift = (each[which] for each in self.frames)
                away = np.stack([px - shift[:, :1], py - shift[:, 1:2], np.broadcast_to(-shift[:, 2:], (len(which), len(px)))])
                yield some, which, *_taken(self.moves[which], np.einsum("ckm,kcj->jkm", away, turn), turn[:, 2])

    def sides(self, x: Array, y: Array, top: Array, floor: Array) -> tuple[Array, Array]:
        """How high material stands at points (m,) where it went up to `top`, and how low; the former floor where none is left."""
        top, floor = top.copy(), floor.copy()
        for some, _, low, high in self.spans(x, y, self.deepest):
            upper = np.maximum(_fallen(top[some], low, high), floor[some])
            lower = np.minimum(-_fallen(-floor[some], -high, -low), upper)
            top[some], floor[some] = upper, np.where(upper > floor[some] + NOISE, lower, floor[some])
        return top, floor

    def left(self, x: Array, y: Array, top: Array, floor: Array) -> Array:
        """How much material (m,), mm, there is between two sides at points."""
        found = top - floor
        for some, _, low, high in self.spans(x, y, self.deepest):
            low, high = np.maximum(low, floor[some]), np.minimum(high, top[some])
            order = np.argsort(low, axis=0)
            low, high = (np.take_along_axis(each, order, axis=0) for each in (low, high))
            before = np.maximum.accumulate(np.concatenate([floor[some][None], high]), axis=0)[:-1]
            found[some] -= np.maximum(high - np.maximum(low, before), 0.0).sum(axis=0)
        return np.asarray(found)

    def taken(self, x: Array, y: Array, top: Array, height: Array, floor: Array) -> Array:
        """How much (m,), mm, of the blank between two sides is gone where upright moves leave a height."""
        whole = self.before.left(x, y, top, floor) if self.before else top - floor
        return np.asarray(whole - self.left(x, y, height, floor))

    def shares(self, moves: Moves, faces: Faces, x: Array, y: Array, rows: int) -> Array:
        """What each of so many rows took (rows,), mm, of the columns at all points together, upright moves among them: of a
        stretch of a column the first row that reaches it."""
        found, seen = np.zeros(rows), np.zeros(len(x), dtype=bool)
        none = np.zeros(0, dtype=np.int64)
        for some, which, low, high in self.spans(x, y):
            seen[some] = True
            found += self._shared(moves, faces, x[some], y[some], self.rows[which], low, high, rows)
        for some in np.array_split(np.flatnonzero(~seen), 1 + len(x) // TOGETHER):
            empty = np.zeros((0, len(some)))
            found += self._shared(moves, faces, x[some], y[some], none, empty, empty, rows)
        return found

    def _shared(
        self, moves: Moves, faces: Faces, x: Array, y: Array, row: Index, low: Array, high: Array, rows: int
    ) -> Array:  # fmt: skip
        few = max(int(len(x) * (len(row) + len(moves)) ** 2 / PAIRS), 1)
        x, y, low, high = x[::few], y[::few], low[:, ::few], high[:, ::few]
        (top, floor), left = faces(x, y), left_by(moves, x, y)
        near = (left < top).any(axis=1)
        row = np.concatenate([row, moves.row[near]])
        low = np.clip(np.concatenate([low, left[near]]), floor, top)
        high = np.clip(np.concatenate([high, np.full(left[near].shape, np.inf)]), floor, top)
        ends = np.sort(np.concatenate([low, high]), axis=0)
        middle, long = (ends[1:] + ends[:-1]) / 2, np.diff(ends, axis=0)
        first = np.full(middle.shape, rows)
        for k in np.argsort(-row, kind="stable").tolist():
            first[(low[k] < middle) & (middle < high[k])] = row[k]
        taken = (first >= 0) & (first < rows) & (long > NOISE)
        return np.asarray(np.bincount(first[taken], long[taken], minlength=rows) * few)

    @cached_property
    def rows(self) -> Index:
        """The row of each move (k,), -1 of those before."""
        own = len(self.moves) - (len(self.before.moves) if self.before else 0)
        return np.where(np.arange(len(self.moves)) < own, self.moves.row, -1)

    def last(self, x: Array, y: Array, top: Array) -> Index:
        """The row (m,) that made the top of the material at points; -1 where it was none of these."""
        found = np.full(len(x), -1)
        for some, which, low, _ in self.spans(x, y):
            found[some] = np.where(np.abs(low - top[some]) < NOISE, self.rows[which, None], -1).max(axis=0)
        return found

    def off(self, x: Array, y: Array, z: Array, top: Array, floor: Array) -> Array:
        """How far up or down material is (m,), mm, from heights z over points where it goes from `floor` to `top`."""
        found = np.maximum(np.maximum(z - top, floor - z), 0.0)
        for some, _, low, high in self.spans(x, y, self.deepest):
            down, up = _fallen(z[some], low, high), -_fallen(-z[some], -high, -low)
            ways = np.where(down < floor[some], np.inf, z[some] - down), np.where(up > top[some], np.inf, up - z[some])
            found[some] = np.where(found[some] > 0, found[some], np.minimum(*ways))
        return found

    def near(self, low: Array, high: Array) -> list[Group]:
        """The groups that reach over a box in the plane."""
        boxes = self.boxes
        reach = (boxes[:, :2] <= high[:2]).all(axis=1) & (boxes[:, 2:] >= low[:2]).all(axis=1)
        return [self.groups[k] for k in np.unique(self.group[reach]).tolist()]

    def empty(self, x: Array, y: Array, z: Array | float) -> Mask:
        """Which points (m,) are in a gap."""
        return self.rows_at(x, y, z) > NO_GAP

    def rows_at(self, x: Array, y: Array, z: Array | float) -> Index:
        """The last row (m,) that took points away, -1 where that was before, `NO_GAP` where they are in none."""
        found, z = np.full(len(x), NO_GAP), np.broadcast_to(z, len(x))
        for some, which, low, high in self.spans(x, y):
            found[some] = np.where((low < z[some]) & (z[some] < high), self.rows[which, None], NO_GAP).max(axis=0)
        return found


def _fallen(top: Array, low: Array, high: Array) -> Array:
    """Where the material ends below `top` (m,), which gaps (k, m) may have taken away."""
    while True:
        lower = np.where((low < top - NOISE) & (high >= top - NOISE), low, np.inf).min(axis=0, initial=np.inf)
        if not (falls := lower < top).any():
            return top
        top = np.where(falls, lower, top)


def _straight(moves: Moves) -> Moves:
    """Arcs as chords."""
    if not moves.arc.any():
        return moves
    spoke = np.hypot(*(moves.start[:, :2] - moves.centre).T)
    step = 2 * np.arccos(1 - np.minimum(CHORD / np.maximum(spoke, CHORD), 1.0))
    pieces = np.where(moves.arc, np.ceil(np.abs(moves.sweep) / step), 1).astype(np.int64)
    found = cut_up(moves, np.maximum(pieces, 1))
    return replace(found, arc=np.zeros(len(found), dtype=bool), sweep=np.zeros(len(found)))


def _taken(moves: Moves, q: Array, e: Array) -> tuple[Array, Array]:
    """From where to where (k, m) lines are in the bodies of moves; q (3, k, m): their points at 0, e (k, 3): their directions."""
    begin, end = _under(moves, q[:2], e)
    there = begin <= end
    low = np.minimum(moves.start[:, 2], moves.end[:, 2])[:, None]
    plain = (moves.flat == moves.radius) & ((np.abs(moves.end[:, 2] - moves.start[:, 2]) < NOISE) | (moves.ways <= STILL))
    with np.errstate(divide="ignore", invalid="ignore"):
        at = (low - q[2]) / e[:, 2:]
    level, rising = np.abs(e[:, 2:]) < STILL, e[:, 2:] > 0
    first = np.where(level, np.where(low <= q[2], begin, np.inf), np.where(rising, np.maximum(begin, at), begin))
    last = np.where(level, end, np.where(rising, end, np.minimum(end, at)))
    k, m = np.nonzero(there & ~plain[:, None])
    if len(k):
        first[k, m], last[k, m] = _searched(moves[k], q[:, k, m], e[k], begin[k, m], end[k, m])
    there &= first < last
    return np.where(there, first, np.inf), np.where(there, last, -np.inf)


def _under(moves: Moves, q: Array, e: Array) -> tuple[Array, Array]:
    """Between which places (k, m) lines are under the tools, seen along these; an upright line is so all along, or nowhere."""
    start, way, radius = moves.start[:, :2, None], (moves.end - moves.start)[:, :2], moves.radius[:, None]
    fast = np.hypot(e[:, 0], e[:, 1])[:, None]
    goes, upright = e[:, :2, None] / np.where(fast > STILL, fast, 1.0)[:, None], fast <= STILL
    off = np.moveaxis(q, 0, 1) - start  # (k, 2, m)
    begin, end = np.full(q.shape[1:], np.inf), np.full(q.shape[1:], -np.inf)

    def add(first: Array, last: Array) -> None:
        some = first <= last
        np.minimum(begin, np.where(some, first, np.inf), out=begin)
        np.maximum(end, np.where(some, last, -np.inf), out=end)

    for disc in (off, off - way[:, :, None]):
        ahead = (disc * goes).sum(axis=1)
        rest = radius**2 - (disc**2).sum(axis=1) + np.where(upright, 0.0, ahead**2)
        half = np.where(upright, np.inf, np.sqrt(np.maximum(rest, 0.0)))
        add(np.where(rest >= 0, -ahead - half, np.inf), np.where(rest >= 0, half - ahead, -np.inf))
    length = np.hypot(way[:, 0], way[:, 1])
    along = way / np.where(length > STILL, length, 1.0)[:, None]
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    sides = []
    for axis, low, high in ((along, 0.0, length[:, None]), (across, -radius, radius)):
        at, rate = (off * axis[:, :, None]).sum(axis=1), (goes * axis[:, :, None]).sum(axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            one, other = (low - at) / rate, (high - at) / rate
        still = (np.abs(rate) < STILL) | upright
        inside = np.where((at >= low) & (at <= high), np.inf, -np.inf)
        sides.append((np.where(still, -inside, np.minimum(one, other)), np.where(still, inside, np.maximum(one, other))))
    (a, b), (c, d) = sides
    moving = (length > STILL)[:, None]
    add(np.where(moving, np.maximum(a, c), np.inf), np.where(moving, np.minimum(b, d), -np.inf))
    return begin / np.where(upright, 1.0, fast), end / np.where(upright, 1.0, fast)


def _above(moves: Moves, q: Array, e: Array, s: Array) -> Array:
    """How high (p,) what moves leave is above places s of lines, one each."""
    x, y, z = q + e.T * s
    return np.asarray(left_by(moves, x[:, None], y[:, None])[:, 0] - z)


def _searched(moves: Moves, q: Array, e: Array, begin: Array, end: Array) -> tuple[Array, Array]:
    """The same of pairs (p,) of a line and a tool that is not flat, or falls: how high its edges are above the line is convex
    along it, so that the lowest place is found by thirds, and then both ends."""
    upright = ~np.isfinite(begin)
    height = np.divide(_above(moves, q, e, np.zeros(len(e))), e[:, 2], out=np.zeros(len(e)), where=upright)
    first, last = np.where(upright & (e[:, 2] > 0), height, -np.inf), np.where(upright & (e[:, 2] < 0), height, np.inf)
    some = np.flatnonzero(~upright)
    first[some], last[some] = np.inf, -np.inf
    moves, q, e, begin, end = moves[some], q[:, some], e[some], begin[some], end[some]
    share = (np.arange(FEW) + 0.5) / FEW
    seen = np.stack([_above(moves, q, e, begin + (end - begin) * each) for each in share])
    middle, step = begin + (end - begin) * share[seen.argmin(axis=0)], (end - begin) / FEW
    if len(k := np.flatnonzero(seen.min(axis=0) > 0)):
        low, high, of = np.maximum(middle - step, begin)[k], np.minimum(middle + step, end)[k], (moves[k], q[:, k], e[k])
        before, behind = np.full(len(k), np.inf), np.full(len(k), np.inf)  # how high at both ends, where that is known
        for _ in range(NARROWINGS):
            one, other = (2 * low + high) / 3, (low + 2 * high) / 3
            a, b = _above(*of, one), _above(*of, other)
            nearer = a < b
            middle[k] = np.where(nearer, one, other)
            between = np.maximum(2 * a - before, 2 * b - behind)  # lines through two places lie below what is convex
            goes = (np.minimum(a, b) > 0) & (np.minimum(np.minimum(2 * a - b, 2 * b - a), between) <= 0)
            low, high = np.where(nearer, low, one), np.where(nearer, other, high)
            before, behind = np.where(nearer, before, a), np.where(nearer, b, behind)
            k, low, high, before, behind = (each[goes] for each in (k, low, high, before, behind))
            of = moves[k], q[:, k], e[k]
            if not len(k):
                break
    k = np.flatnonzero(_above(moves, q, e, middle) <= 0)
    some, middle, of = some[k], middle[k], (moves[k], q[:, k], e[k])
    for ends, found in ((begin[k], first), (end[k], last)):
        found[some] = _left(of, middle, ends + RIM * (middle - ends))
    return first, last


def _left(of: tuple[Moves, Array, Array], inside: Array, outside: Array) -> Array:
    """Where lines leave tools between places (p,): by halves and where the chord of both heights ends (Illinois) in turn."""
    within, beyond = _above(*of, inside), _above(*of, outside)
    found, k = np.where(beyond > 0, inside, outside), np.flatnonzero(beyond > 0)  # the others are in the tool all along
    inside, within, outside, beyond = inside[k], within[k], outside[k], beyond[k]
    for turn in range(TURNS):
        if not len(k):
            break
        halves = turn % 3 == 0
        share = 0.5 if halves else np.clip(within / np.minimum(within - beyond, -RIM), 0.0, 1.0)
        place = inside + share * (outside - inside)
        here = _above(of[0][k], of[1][:, k], of[2][k], place)
        met = here <= 0
        beyond = np.where(met, beyond / (1 if halves else 2), here)
        inside, within, outside = np.where(met, place, inside), np.where(met, here, within), np.where(met, outside, place)
        found[k], goes = inside, within < -RIM
        k, (inside, within, outside, beyond) = k[goes], (each[goes] for each in (inside, within, outside, beyond))
    return found

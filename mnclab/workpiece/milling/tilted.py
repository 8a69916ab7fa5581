"""What tools took away that do not stand along Z: gaps in the upright columns of a part.

Seen along its own direction such a tool is upright, and its rows are moves as any other. A straight move takes away a convex
body, all that stands above the tool with it, so that an upright line has one gap of each. Arcs are chords within `CHORD` mm.
A tool that stays square to an axis about which the part turns cuts piece by piece of the turn, in the direction that it has in
the middle of each, and upright at both ends: so much that the floor is right within `FLOOR` and a wall that winds within `WALL`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from mnclab.geometry.curves import counted
from mnclab.path.toolpath import Array, Index, Kind, Mask
from mnclab.workpiece.clamped import Placement
from mnclab.workpiece.cutting import Cutting, frames_along
from mnclab.workpiece.milling.moves import CHORD, STILL, Cutter, Moves, cut_up, cutter_of, joined, moves_of
from mnclab.workpiece.milling.raster import NOISE
from mnclab.workpiece.milling.swept import left_by
from mnclab.workpiece.outcome import spend

FLOOR, WALL = 1e-3, 4e-3  # mm, of what is cut while the part turns
MOST = 20_000  # pieces of all turns, and moves of all tilted tools
FEW, NARROWINGS, HALVINGS = 9, 40, 40  # places of a line under a tool; of its lowest place, and of where it leaves the tool
PAIRS = 20_000_000  # of points and moves, twice, beyond which fewer columns tell what each row took
SWING, PLACES = 0.03, 200  # of unit vectors, between two looks at a tool that turns; places its axis, where it is looked whether it is clear
EFFORT = 20  # times the work of a point under an upright move

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
        group = np.repeat(np.arange(len(self.groups)), [len(each) for each in self._straight])
        return turn[group], shift[group]

    @cached_property
    def boxes(self) -> Array:
        """What each move reaches in the plane (k, 4), as far as the box of the part is high."""
        moves, (turn, shift), (low, high) = self.moves, self.frames, self.bounds[:, 2]
        ends = np.stack([np.einsum("kij,kj->ki", turn, end) + shift for end in (moves.start, moves.end)])
        way, wide = turn[:, :, 2], moves.radius[:, None]
        up = way[:, 2] > 0
        room = np.where(up, high - ends[..., 2].min(axis=0), ends[..., 2].max(axis=0) - low) + moves.radius
        with np.errstate(divide="ignore"):
            long = np.clip(room, 0.0, None) / np.abs(way[:, 2])
        long = np.minimum(long, np.linalg.norm(np.ptp(self.bounds, axis=0)) + np.linalg.norm(ends - self.bounds.mean(axis=0), axis=2).max(axis=0))
        ends = np.concatenate([ends, ends + long[:, None] * way])[..., :2]
        return np.concatenate([ends.min(axis=0) - wide, ends.max(axis=0) + wide], axis=1)

    def spans(self, x: Array, y: Array) -> tuple[Index, Array, Array]:
        """Of points (m,) close together: the moves (k,) that may have come over or under them, and from where to where each has
        taken the upright line there (k, m); upside down where it has not."""
        boxes = self.boxes
        near = (boxes[:, 0] <= x.max()) & (boxes[:, 2] >= x.min()) & (boxes[:, 1] <= y.max()) & (boxes[:, 3] >= y.min())
        which = np.flatnonzero(near)
        spend(EFFORT * len(which) * len(x))
        turn, shift = (each[which] for each in self.frames)
        away = np.stack([x - shift[:, :1], y - shift[:, 1:2], np.broadcast_to(-shift[:, 2:], (len(which), len(x)))])
        return which, *_taken(self.moves[which], np.einsum("ckm,kcj->jkm", away, turn), turn[:, 2])

    def sunk(self, x: Array, y: Array, top: Array, floor: Array) -> Array:
        """How high material stands (m,) at points close together where it went up to `top`; the floor where none is left."""
        _, low, high = self.spans(x, y)
        return np.maximum(_fallen(top, low, high), floor)

    def sides(self, x: Array, y: Array, top: Array, floor: Array) -> tuple[Array, Array]:
        """The same, and how low it stands; the former floor where none is left."""
        _, low, high = self.spans(x, y)
        top = np.maximum(_fallen(top, low, high), floor)
        return top, np.where(top > floor + NOISE, np.minimum(-_fallen(-floor, -high, -low), top), floor)

    def left(self, x: Array, y: Array, top: Array, floor: Array) -> Array:
        """How much material (m,), mm, there is between two sides at points close together."""
        _, low, high = self.spans(x, y)
        low, high = np.maximum(low, floor), np.minimum(high, top)
        order = np.argsort(low, axis=0)
        low, high = (np.take_along_axis(each, order, axis=0) for each in (low, high))
        before = np.maximum.accumulate(np.concatenate([floor[None], high]), axis=0)[:-1]
        return np.asarray(top - floor - np.maximum(high - np.maximum(low, before), 0.0).sum(axis=0))

    def taken(self, x: Array, y: Array, top: Array, height: Array, floor: Array) -> Array:
        """How much (m,), mm, of the blank between two sides is gone where upright moves leave a height."""
        whole = self.before.left(x, y, top, floor) if self.before else top - floor
        return np.asarray(whole - self.left(x, y, height, floor))

    def shares(self, moves: Moves, faces: Any, x: Array, y: Array, rows: int) -> Array:
        """What each of so many rows took (rows,), mm, of all columns together at points close together, upright moves among
        them: of a stretch of a column the first row that reaches it."""
        which, low, high = self.spans(x, y)
        own = len(self.moves) - (len(self.before.moves) if self.before else 0)
        row = np.where(which < own, self.moves.row[which], -1)
        few = max(int(np.sqrt(len(x) * (len(row) + len(moves)) ** 2 / PAIRS)), 1)
        x, y, low, high = x[::few], y[::few], low[:, ::few], high[:, ::few]
        (top, floor), left = faces(x, y), left_by(moves, x, y)
        near = (left < top).any(axis=1)
        row = np.concatenate([row, moves.row[near]])
        low = np.clip(np.concatenate([low, left[near]]), floor, top)
        high = np.clip(np.concatenate([high, np.full(left[near].shape, np.inf)]), floor, top)
        ends = np.sort(np.concatenate([low, high]), axis=0)
        middle, long = (ends[1:] + ends[:-1]) / 2, np.diff(ends, axis=0)
        first = np.full(middle.shape, rows + 1)
        for k in np.argsort(-row, kind="stable").tolist():
            first[(low[k] < middle) & (middle < high[k])] = row[k]
        taken = (first >= 0) & (first < rows) & (long > NOISE)
        return np.asarray(np.bincount(first[taken], long[taken], minlength=rows) * few)

    def last(self, x: Array, y: Array, top: Array) -> Index:
        """The row (m,) that made the top of the material at points close together; -1 where it was none of these."""
        which, low, _ = self.spans(x, y)
        here = np.abs(low - top) < NOISE
        own = which < len(self.moves) - (len(self.before.moves) if self.before else 0)
        return np.asarray(np.where(here & own[:, None], self.moves.row[which, None], -1).max(axis=0, initial=-1))

    def empty(self, x: Array, y: Array, z: Array | float) -> Mask:
        """Which points (m,) close together are in a gap."""
        _, low, high = self.spans(x, y)
        return np.asarray(((low < z) & (z < high)).any(axis=0))


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
    """From where to where (k, m) lines lie in the bodies of moves; q (3, k, m) are their points at 0, e (k, 3) their directions."""
    begin, end = _under(moves, q[:2], e)
    there = begin <= end
    low = np.minimum(moves.start[:, 2], moves.end[:, 2])[:, None]
    plain = (moves.flat == moves.radius) & ((moves.start[:, 2] == moves.end[:, 2]) | (moves.ways <= STILL))
    with np.errstate(divide="ignore", invalid="ignore"):
        at = (low - q[2]) / e[:, 2:]
    level, rising = np.abs(e[:, 2:]) < STILL, e[:, 2:] > 0
    first = np.where(level, np.where(low <= q[2], begin, np.inf), np.where(rising, np.maximum(begin, at), begin))
    last = np.where(level, end, np.where(rising, end, np.minimum(end, at)))
    k, m = np.nonzero(there & ~plain[:, None])
    if len(k):
        first[k, m], last[k, m] = _searched(moves[k], q[:, k, m], e[k], begin[k, m], end[k, m], at[k, m])
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


def _searched(moves: Moves, q: Array, e: Array, begin: Array, end: Array, at: Array) -> tuple[Array, Array]:
    """The same of pairs (p,) of a line and a tool that is not flat, or falls: what stands above its edges along the line is
    convex, so that its lowest place is found by thirds, and both ends by halves."""

    def above(which: Index, s: Array) -> Array:
        x, y, z = q[:, which] + e[which].T * s
        return np.asarray(left_by(moves[which], x[:, None], y[:, None])[:, 0] - z)

    first, last, every = np.full(len(begin), np.inf), np.full(len(begin), -np.inf), np.arange(len(begin))
    upright = ~np.isfinite(begin)
    if upright.any():
        some = every[upright]
        height = above(some, np.zeros(len(some))) / e[some, 2]
        rises = e[some, 2] > 0
        first[some], last[some] = np.where(rises, height, -np.inf), np.where(rises, np.inf, height)
    some = every[~upright]
    share = (np.arange(FEW) + 0.5) / FEW
    begin, end = begin[some], end[some]
    if not len(some):
        return first, last
    seen = np.stack([above(some, begin + (end - begin) * each) for each in share])
    best = seen.argmin(axis=0)
    middle, step = begin + (end - begin) * share[best], (end - begin) / FEW
    low, high = np.maximum(middle - step, begin), np.minimum(middle + step, end)
    going = np.flatnonzero(seen.min(axis=0) > 0)
    for _ in range(NARROWINGS if len(going) else 0):
        third = (high[going] - low[going]) / 3
        one, other = low[going] + third, high[going] - third
        nearer = above(some[going], one) < above(some[going], other)
        low[going], high[going] = np.where(nearer, low[going], one), np.where(nearer, other, high[going])
        middle[going] = (low[going] + high[going]) / 2
    met = above(some, middle) <= 0
    some, begin, end, middle = some[met], begin[met], end[met], middle[met]
    for ends, found in ((begin, first), (end, last)):
        inside, outside = middle.copy(), ends.copy()
        for _ in range(HALVINGS):
            half = (inside + outside) / 2
            within = above(some, half) <= 0
            inside, outside = np.where(within, half, inside), np.where(within, outside, half)
        found[some] = inside
    return first, last


# The rows of a path as such moves.

def left_out(cutting: Cutting) -> Iterator[tuple[Mask, str]]:
    """Rows (n,) with a tilted tool that are not followed, and what they are."""
    if cutting.tilted is None:
        return
    yield cutting.turning & ~cutting.round_ & meeting(cutting), "on which the tool turns"
    if too_many(cutting):
        yield cutting.cuts & cutting.tilted & (cutting.round_ | ~cutting.turning), f"of tilted tools, more than {MOST:,},"


def too_many(cutting: Cutting) -> bool:
    return cutting.tilted is not None and int((cutting.cuts & cutting.tilted).sum()) > MOST


def error_of(cutting: Cutting) -> float:
    """How far off what tilted tools cut may be, mm."""
    if cutting.tilted is None or too_many(cutting):
        return 0.0
    rows = np.flatnonzero(cutting.round_)
    return max(pieces_of(cutting, rows)[1], CHORD) if len(rows) else CHORD


def tilted_groups(cutting: Cutting) -> tuple[Group, ...]:
    """The moves of rows that cut with a tilted tool, a group for each direction, and those on which a drum turns."""
    if cutting.tilted is None or too_many(cutting):
        return ()
    found = []
    for turn, rows in cutting.by_direction(cutting.cuts & cutting.tilted & ~cutting.turning):
        found.append((moves_of(cutting.seen_along(turn), rows), Placement(turn)))
    return *found, *_turned(cutting)


def _turned(cutting: Cutting) -> Iterator[Group]:
    """Rows of a drum that turns under the tool, piece by piece, and the tool upright at both ends of each row."""
    path, rows = cutting.path, np.flatnonzero(cutting.round_)
    if not len(rows):
        return
    counts, _ = pieces_of(cutting, rows)
    owner, rank = counted(counts)
    row, share = rows[owner], np.stack([rank, rank + 0.5, rank + 1]) / counts[owner]
    axis, centre = path.axis[row], path.centre[row]
    local = []
    for end, side in ((path.start, 0), (path.end, 1)):
        up = cutting.directions[row, side]
        frame = np.stack([np.cross(axis, up), axis, up], axis=1)
        local.append(np.einsum("kij,kj->ki", frame, end[row] - centre))
    first = cutting.directions[row, 0]
    sides = np.cross(axis, first)

    def up_at(part: Array) -> Array:
        angle = (path.sweep[row] * part)[:, None]
        return np.asarray(np.cos(angle) * first + np.sin(angle) * sides)

    def tips(part: Array) -> Array:
        up, (one, other) = up_at(part), local
        here = one + (other - one) * part[:, None]
        return np.asarray(centre + here[:, :1] * np.cross(axis, up) + here[:, 1:2] * axis + here[:, 2:] * up)

    places = [tips(each) for each in (share[0], share[2])]
    standing = [(np.flatnonzero(rank == 0), 0), (np.flatnonzero(rank == counts[owner] - 1), 2)]
    yield from _as_groups(cutting, row, up_at(share[1]), *places)
    for some, end in standing:
        yield from _as_groups(cutting, row[some], up_at(share[end])[some], places[end // 2][some], places[end // 2][some])


def _as_groups(cutting: Cutting, row: Index, up: Array, start: Array, end: Array) -> Iterator[Group]:
    """Straight moves (k,) of the part as groups of one each, with their tools along `up` (k, 3)."""
    turn = frames_along(up)
    start, end = (np.einsum("kji,kj->ki", turn, ends) for ends in (start, end))
    cutters = np.array([cutter_of(tool) for tool in cutting.tools]).reshape(-1, len(Cutter._fields))[cutting.which[row]]
    none = np.zeros(len(row))
    moves = Moves(row, start, end, none > 0, np.zeros((len(row), 2)), none, *cutters.T)
    for k in range(len(row)):
        yield moves[k : k + 1], Placement(turn[k])


def pieces_of(cutting: Cutting, rows: Index) -> tuple[Index, float]:
    """In how many pieces rows turn (k,), and how far off what they cut may be, mm."""
    path = cutting.path
    spoke = path.start[rows] - path.centre[rows]
    out = np.maximum(np.linalg.norm(spoke, axis=1), NOISE)
    across = np.abs(path.axis[rows]).argmin(axis=1)
    wide = np.abs(cutting.stock.bounds[:, across] - path.centre[rows, across]).max(axis=0)
    rise = np.abs(np.einsum("ki,ki->k", path.end[rows] - path.start[rows], path.axis[rows]))
    angle = np.abs(path.sweep[rows])
    leans = np.maximum(wide - out, 0.0) * rise / np.maximum(np.hypot(rise, out * angle), NOISE)
    with np.errstate(divide="ignore"):
        step = np.minimum(np.sqrt(8 * FLOOR / out), 2 * WALL / leans)
    counts = np.maximum(np.ceil(angle / step), 1).astype(np.int64)
    counts = np.maximum(counts * min(1.0, MOST / counts.sum()), 1).astype(np.int64)
    own = angle / counts
    return counts, float(np.maximum(out * own**2 / 8, leans * own / 2).max())


def meeting(cutting: Cutting) -> Mask:
    """Rows (n,) on which a tool that turns may come to the blank: it is not sure to be clear of its box all the way.

    Clear is what has all corners of the box below the tip, or as far from the axis of the tool as this is thick.
    """
    found = np.zeros(len(cutting), dtype=bool)
    rows = np.flatnonzero(cutting.turning)
    if not len(rows):
        return found
    assert cutting.directions is not None
    (low, high), path = cutting.stock.bounds, cutting.path
    corners, middle, far = np.array(np.meshgrid(*zip(low, high))).reshape(3, -1).T, (low + high) / 2, float(np.linalg.norm(high - low))
    wide = np.array([max(tool.effective_radius, *(radius for radius, _ in tool.holder), 0.0) for tool in cutting.tools])
    for some in np.split(rows, np.arange(MOST // PLACES, len(rows), MOST // PLACES)):
        swing = np.linalg.norm(np.diff(cutting.directions[some], axis=1)[:, 0], axis=1)
        way = np.linalg.norm(path.end[some] - path.start[some], axis=1)
        count = int(np.clip(np.ceil(swing.max() / SWING), 1, PLACES))
        for share in (np.arange(count) + 0.5) / count:
            tips = path.start[some] + share * (path.end[some] - path.start[some])
            up = (1 - share) * cutting.directions[some, 0] + share * cutting.directions[some, 1]
            up /= np.maximum(np.linalg.norm(up, axis=1), NOISE)[:, None]
            reach = far + np.linalg.norm(tips - middle, axis=1)
            above = np.einsum("nk,nk->n", tips, up) - np.einsum("ck,nk->nc", corners, up).max(axis=1)
            places = tips[:, None] + (np.linspace(0.0, 1.0, PLACES) * reach[:, None])[..., None] * up[:, None]
            off = np.linalg.norm(np.maximum(np.maximum(low - places, places - high), 0.0), axis=2).min(axis=1)
            room = np.maximum(above, off - wide[cutting.which[some]] - reach / PLACES)
            found[some] |= room <= (way + swing * reach) / count
    return found

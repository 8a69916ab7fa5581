"""What differs in the motion of two programs, by kinds, each at its row of both paths. Lengths in mm, feeds in mm/min."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.comparison.diff import deviation
from mnclab.comparison.motion import Motion, Pairs, apart, paired
from mnclab.path.listing import figure
from mnclab.path.toolpath import Array, Index, Kind
from mnclab.text.alarm import several

RATE = 0.005  # of a feed or a speed: as much goes by rounding in inches
SECONDS = 0.001
LONGEST = 4000  # cuts of a stretch that is looked at as a whole
FLOWS = ("off", "on (M8)", "on (M7)")
SIDES = {0: "none", 1: "left", -1: "right"}


class Found(NamedTuple):
    """One difference: its `kind`, `rows` of both paths (-1: there is none), by how much, what each has, for how many moves."""

    kind: str
    rows: tuple[int, int]
    amount: float
    unit: str
    values: tuple[str, str]
    moves: int = 1


def differences(one: Motion, other: Motion, tolerance: float) -> list[Found]:
    """All that differs, in the order of the motion."""
    pairs = paired(one, other, tolerance)
    found, more, parts = _of_stretches(one, other, pairs, tolerance)
    i, j = np.concatenate([pairs.i, more[:, 0]]), np.concatenate([pairs.j, more[:, 1]])
    found += _of_settings(one, other, i, j)
    links = _links(one, other, i, j, [*pairs.chords, *parts])
    found += _of_links(one, other, *links, tolerance)
    found += _of_dwells(one, other, *links)
    found += _left_over(one, other)
    return sorted(found, key=lambda each: (each.rows[1], each.rows[0]))


# Cuts that are not the same.

def _of_stretches(
    one: Motion, other: Motion, pairs: Pairs, tolerance: float
) -> tuple[list[Found], NDArray[np.int64], list[tuple[int, int, int, int]]]:
    """What differs where cuts are not the same, the pairs (k, 2) of cuts that are still each other's, and stretches that are."""
    chords = [*pairs.chords]
    odd, whole, same = [], [], list[tuple[int, int, int, int]]()
    for stretch in pairs.odd:
        i, to_i, j, to_j = stretch
        whole.append(stretch)
        if _one_way(one, other, *stretch, tolerance):
            bent = [(motion.kind[motion.cuts[a:b]] == Kind.ARC).any() for motion, a, b in ((one, i, to_i), (other, j, to_j))]
            (chords if bent[0] != bent[1] else same).append(stretch)
        else:
            odd.append(stretch)
    found = []
    for i, to_i, j, to_j in chords:
        arcs = "arcs", f"{to_j - j} lines"
        arcs = arcs if (one.kind[one.cuts[i:to_i]] == Kind.ARC).any() else (f"{to_i - i} lines", "arcs")
        found.append(Found("chords", _rows(one, i, other, j), 0.0, "mm", arcs, max(to_i - i, to_j - j)))
    more = [(i, j) for i, _, j, _ in (*chords, *same)]
    left = [np.concatenate([np.arange(s[k], s[k + 1]) for s in odd] or [np.empty(0, np.int64)]) for k in (0, 2)]
    moved = _elsewhere(one, left[0], other, left[1], tolerance)
    found += _grouped("order", one, moved[:, 0], other, moved[:, 1], lambda k: ("here", "at another place in the order"))
    more += [(i, j) for i, j in moved.tolist()]
    for i, to_i, j, to_j in odd:
        a = np.setdiff1d(np.arange(i, to_i), moved[:, 0])
        b = np.setdiff1d(np.arange(j, to_j), moved[:, 1])
        many = min(len(a), len(b))
        found += _not_alike(one, a[:many], other, b[:many], tolerance)
        more += zip(a[:many].tolist(), b[:many].tolist())
        near = (min(to_i - (to_i > i), len(one.cuts) - 1), min(to_j - (to_j > j), len(other.cuts) - 1))
        where = _rows(one, near[0], other, near[1])
        if len(a) > many:
            found.append(_only(one, a[many:], where[1], 0))
        if len(b) > many:
            found.append(_only(other, b[many:], where[0], 1))
    return found, np.array(more, dtype=np.int64).reshape(-1, 2), whole


def _only(motion: Motion, ranks: Index, there: int, k: int) -> Found:
    """Cuts that one of the two has alone; `there` is the row of the other by them, `k` which of the two it is."""
    cuts = motion.cuts[ranks]
    way = float(sum(motion.path.lengths[motion.row[e] : motion.last[e] + 1].sum() for e in cuts[:LONGEST].tolist()))
    here, said = int(motion.row[cuts[0]]), several(len(cuts), "cut")
    if k:
        return Found("geometry", (there, here), way, "mm", ("none", said), len(cuts))
    return Found("geometry", (here, there), way, "mm", (said, "none"), len(cuts))


def _one_way(one: Motion, other: Motion, i: int, to_i: int, j: int, to_j: int, tolerance: float) -> bool:
    """Whether two stretches of cuts are one way divided otherwise: no place of either is off the other by more."""
    if i == to_i or j == to_j or max(to_i - i, to_j - j) > LONGEST or (to_i - i == to_j - j == 1):
        return False
    paths = []
    for motion, a, b in ((one, i, to_i), (other, j, to_j)):
        cuts = motion.cuts[a:b]
        if cuts[-1] - cuts[0] != b - a - 1 or motion.turns:  # there are rapids between
            return False
        paths.append(motion.path[motion.row[cuts[0]] : motion.last[cuts[-1]] + 1].motion)
    p, q = paths
    ends = max(np.abs(p.start[0] - q.start[0]).max(), np.abs(p.end[-1] - q.end[-1]).max())
    if ends > tolerance or abs(p.length - q.length) > 1e-3 * p.length + tolerance or not p.length:
        return False
    return bool(deviation(p, q, step=max(p.length / 2000, tolerance), chord_error=tolerance / 10).largest <= tolerance)


def _not_alike(one: Motion, i: Index, other: Motion, j: Index, tolerance: float) -> list[Found]:
    """What is wrong with cuts that are each other's."""
    p, q = one.cuts[i], other.cuts[j]
    off = apart(one, p, other, q)
    wrong = off > tolerance
    i, j, p, q, off = i[wrong], j[wrong], p[wrong], q[wrong], off[wrong]
    step = np.abs(one.end[p] - other.end[q])
    mill = not (one.path.lathe or other.path.lathe)
    deep = mill & (np.hypot(step[:, 0], step[:, 1]) <= tolerance) & (np.abs(off - step[:, 2]) <= tolerance)
    off = np.where(np.isfinite(off), off, np.linalg.norm(step, axis=1))
    found = []
    for kind, mask in (("geometry", ~deep), ("depth", deep)):
        found += _grouped(kind, one, i[mask], other, j[mask], lambda k: ("", ""), off[mask])
    return found


def _elsewhere(one: Motion, i: Index, other: Motion, j: Index, tolerance: float) -> NDArray[np.int64]:
    """Of cuts that are left, those pairs (k, 2) that are the same, whatever the order."""
    p, q = one.cuts[i], other.cuts[j]
    if not (len(p) and len(q)):
        return np.empty((0, 2), dtype=np.int64)
    places = np.concatenate([np.hstack([m.kind[e, None].astype(float), m.start[e], m.end[e]]) for m, e in ((one, p), (other, q))])
    keys = np.zeros(places.shape, dtype=np.int64)
    for k in range(places.shape[1]):  # numbers with no gap between them are one number
        order = np.argsort(places[:, k], kind="stable")
        keys[order[1:], k] = np.cumsum(np.diff(places[order, k]) > tolerance)
    known: dict[bytes, list[int]] = {}
    for rank, key in enumerate(keys[len(p) :]):
        known.setdefault(key.tobytes(), []).append(rank)
    met = [(a, known[key.tobytes()].pop(0)) for a, key in enumerate(keys[: len(p)]) if known.get(key.tobytes())]
    pair = np.array(met, dtype=np.int64).reshape(-1, 2)
    good = apart(one, p[pair[:, 0]], other, q[pair[:, 1]]) <= tolerance
    return np.stack([i[pair[good, 0]], j[pair[good, 1]]], axis=1)


# How they are cut.

def _of_settings(one: Motion, other: Motion, i: Index, j: Index) -> Iterator[Found]:
    """Feed, speed, coolant, tool and side of cuts that are each other's."""
    order = np.argsort(j, kind="stable")
    i, j = i[order], j[order]
    p, q = one.cuts[i], other.cuts[j]

    def told(kind: str, a: Array, b: Array, unit: str, name: Callable[[Any], str], near: float = 0.0) -> list[Found]:
        with np.errstate(invalid="ignore"):
            wrong = ~((np.abs(a - b) <= near * np.maximum(np.abs(a), np.abs(b))) | (a == b) | (np.isnan(a) & np.isnan(b)))
        at = np.flatnonzero(wrong)
        off = np.abs(a[at] - b[at]).astype(float) if unit else np.zeros(len(at))
        a, b = a[at], b[at]
        return _grouped(kind, one, i[at], other, j[at], lambda k: (name(a[k]), name(b[k])), off, unit, (a, b))

    turns = np.isfinite(one.per_rev[p]) & np.isfinite(other.per_rev[q])
    a, b = (np.where(turns, np.nan, m.feed[e]) for m, e in ((one, p), (other, q)))
    yield from told("feed", a, b, "mm/min", _named("F"), RATE)
    a, b = (np.where(turns, m.per_rev[e], np.nan) for m, e in ((one, p), (other, q)))
    yield from told("feed", a, b, "mm/rev", _named("F", " a turn"), RATE)
    yield from told("spindle", one.spindle[p], other.spindle[q], "rev/min", _turning, RATE)
    yield from told("spindle", one.surface[p], other.surface[q], "m/min", _named("cutting speed "), RATE)
    yield from told("coolant", one.coolant[p], other.coolant[q], "", lambda value: FLOWS[value])
    yield from told("tool", one.tool[p], other.tool[q], "", lambda value: f"tool {value}")
    yield from told("side", one.side[p], other.side[q], "", lambda value: SIDES[int(value)])


def _named(before: str, behind: str = "") -> Callable[[Any], str]:
    return lambda value: f"{before}{figure(float(value), 3)}{behind}"


def _turning(speed: float) -> str:
    return f"S{figure(abs(speed), 1)} {'M3' if speed > 0 else 'M4'}" if speed else "spindle off"


# What is between them.

def _links(one: Motion, other: Motion, i: Index, j: Index, parts: list[tuple[int, int, int, int]]) -> tuple[Index, Index]:
    """Which ways between cuts (k,), by the rank of the cut behind them, are each other's: both their ends are."""
    wide = len(other.cuts) + 1
    stretch = np.array(parts, dtype=np.int64).reshape(-1, 4)
    before = np.concatenate([i * wide + j, stretch[:, 0] * wide + stretch[:, 2], [len(one.cuts) * wide + len(other.cuts)]])
    behind = np.concatenate([[0], (i + 1) * wide + j + 1, stretch[:, 1] * wide + stretch[:, 3]])
    both = np.intersect1d(before, behind)
    return both // wide, both % wide


def _of_links(one: Motion, other: Motion, i: Index, j: Index, tolerance: float) -> list[Found]:
    """Rapids between cuts that do not go the same way: lower than those of the first program, or not."""
    sides = [_Ways(one, tolerance), _Ways(other, tolerance)]
    many = [side.count[k] for side, k in zip(sides, (i, j))]
    odd = many[0] != many[1]
    at = np.flatnonzero(~odd & (many[0] > 0))
    if len(at):
        which = np.repeat(at, many[0][at])
        rank = np.arange(len(which)) - np.repeat(np.cumsum(many[0][at]) - many[0][at], many[0][at])
        ends = [m.end[s.rapids[s.begin[k[which]] + rank]] for m, s, k in ((one, sides[0], i), (other, sides[1], j))]
        off = np.linalg.norm(ends[0] - ends[1], axis=1)
        odd[which[off > tolerance]] = True
    a, b = sides
    found = _beyond(a, b, i, j, tolerance)
    i, j = i[odd], j[odd]
    if not len(i):
        return found
    heights = np.stack([a.low[i], b.low[j], a.last[i], b.last[j]], axis=1)
    lower = np.maximum(_gap(heights[:, 0], heights[:, 1]), _gap(heights[:, 2], heights[:, 3]))
    beside = np.abs(a.box[i] - b.box[j]).max(axis=1)
    near = (lower > tolerance) | ((beside > tolerance) & (b.low[j] < a.high[i] - tolerance)) | one.path.lathe | other.path.lathe
    off = np.maximum(beside, np.abs(_gap(heights[:, ::2], heights[:, 1::2])).max(axis=1))
    new = (np.diff(i) != 1) | (np.diff(j) != 1) | (near[1:] != near[:-1]) | (heights[1:] != heights[:-1]).any(axis=1)
    first = np.flatnonzero(np.append(True, new))
    for k, moves in zip(first.tolist(), np.diff(np.append(first, len(i))).tolist()):
        amount = float(lower[k] if near[k] and lower[k] > 0 else off[k])
        said = a.said(i[k]), b.said(j[k])
        kind, rank = "rapid" if near[k] else "lifts", a.until(i[k], b, j[k], tolerance)
        found.append(Found(kind, (a.row(i[k], rank), b.row(j[k], rank)), amount if np.isfinite(amount) else np.nan, "mm", said, moves))
    return found


def _gap(a: Array, b: Array) -> Array:
    """How much lower b is than a, inf where a has none."""
    with np.errstate(invalid="ignore"):
        return np.where(a == b, 0.0, a - b)


def _beyond(a: _Ways, b: _Ways, i: Index, j: Index, tolerance: float) -> list[Found]:
    """Of ways that are nobody's counterpart: whether those of b go sideways lower than all of a."""
    rest = [np.setdiff1d(np.arange(len(side.count)), k) for side, k in ((a, i), (b, j))]
    if not len(rest[1]):
        return []
    deepest, low = int(rest[1][b.low[rest[1]].argmin()]), a.low[rest[0]].min() if len(rest[0]) else a.low.min()
    lower = float(_gap(low, b.low[deepest]))
    highest = int(a.low.argmin())
    if not lower > tolerance:
        return []
    return [Found("rapid", (a.row(highest), b.row(deepest)), lower if np.isfinite(lower) else np.nan, "mm",
                  (a.said(highest), b.said(deepest)))]  # fmt: skip


class _Ways:
    """The rapids between cuts, by the rank of the cut behind (n + 1,): their `count`, the lowest height at which they go sideways
    (`low`), the highest of all (`high`) and the `last`, and the `box` (n + 1, 4) that they keep in X and Y."""

    def __init__(self, motion: Motion, tolerance: float) -> None:
        self.motion = motion
        self.rapids = np.flatnonzero(motion.kind == Kind.RAPID)
        link, n = motion.link[self.rapids], len(motion.cuts) + 1
        self.count = np.bincount(link, minlength=n)
        self.begin = np.cumsum(self.count) - self.count
        start, end = motion.start[self.rapids], motion.end[self.rapids]
        if len(self.rapids) and self.rapids[0] == 0:  # from where the machine stands
            start[0] = end[0]
        aside = np.hypot(*(end - start)[:, :2].T) > tolerance
        self.low, self.high = np.full(n, np.inf), np.full(n, -np.inf)
        np.minimum.at(self.low, link[aside], np.minimum(start[aside, 2], end[aside, 2]))
        np.maximum.at(self.high, link, np.maximum(start[:, 2], end[:, 2]))
        self.last = np.full(n, np.inf)
        self.last[link] = end[:, 2]
        self.box = np.zeros((n, 4))
        some = np.flatnonzero(self.count)
        if len(some):
            low, high = (ufunc.reduceat(end[:, :2], self.begin[some]) for ufunc in (np.minimum, np.maximum))
            self.box[some] = np.hstack([low, high])

    def said(self, link: int) -> str:
        """What they do, in words."""
        if not self.count[link]:
            return "no rapid"
        low, last = float(self.low[link]), float(self.last[link])
        return f"sideways at Z{figure(low, 3)}, " * bool(np.isfinite(low)) + f"rapid ends at Z{figure(last, 3)}"

    def until(self, link: int, other: _Ways, there: int, tolerance: float) -> int:
        """How many of the rapids before a cut are those before another cut of the other."""
        many = min(self.count[link], other.count[there])
        ends = [ways.motion.end[ways.rapids[ways.begin[k] : ways.begin[k] + many]] for ways, k in ((self, link), (other, there))]
        odd = np.flatnonzero(np.linalg.norm(ends[0] - ends[1], axis=1) > tolerance)
        return int(odd[0]) if len(odd) else int(many)

    def row(self, link: int, rank: int = 0) -> int:
        """The row of the rapids before a cut by their rank, that of the cut where there are no more."""
        if rank < self.count[link]:
            return int(self.motion.row[self.rapids[self.begin[link] + rank]])
        if not len(self.motion.cuts):
            return -1
        return int(self.motion.row[self.motion.cuts[min(link, len(self.motion.cuts) - 1)]])


def _of_dwells(one: Motion, other: Motion, i: Index, j: Index) -> list[Found]:
    """Dwells and stops of the program between cuts, at the end of a cut and elsewhere."""
    found = []
    for at_cut in (True, False):
        times, rows = [], []
        for motion in (one, other):
            slot = np.arange(len(motion) + 1)
            here = np.append(False, motion.kind != Kind.RAPID) == at_cut
            link = np.searchsorted(motion.cuts, slot)
            times.append(np.bincount(link[here], motion.dwell[here], len(motion.cuts) + 1))
            row = np.full(len(motion.cuts) + 1, -1)
            paused = here & (motion.pause >= 0)
            row[link[paused]] = motion.pause[paused]
            rows.append(row)
        a, b = times[0][i], times[1][j]
        with np.errstate(invalid="ignore"):
            wrong = np.flatnonzero(~((np.abs(a - b) <= SECONDS + RATE * np.abs(a)) | (a == b)))
        for k in wrong.tolist():
            ends = (one, rows[0], int(i[k])), (other, rows[1], int(j[k]))
            p, q = (int(row[rank]) if row[rank] >= 0 else _row(m, rank - 1) for m, row, rank in ends)
            found.append(Found("dwell", (p, q), float(abs(a[k] - b[k])), "s", (_waits(a[k]), _waits(b[k]))))
    return found


def _waits(time: float) -> str:
    return "a stop" if np.isinf(time) else f"{figure(float(time), 3)} s" if time else "no dwell"


def _left_over(one: Motion, other: Motion) -> list[Found]:
    """What is still switched on at the end."""
    rows = len(one.path) - 1, len(other.path) - 1
    names = (_turning, lambda value: f"coolant {FLOWS[value]}", lambda value: f"compensation {SIDES[int(value)]}")
    return [
        Found("leftovers", rows, 0.0, "", (name(a), name(b)))
        for name, a, b in zip(names, one.at_end, other.at_end)
        if abs(a - b) > RATE * max(abs(a), abs(b))
    ]


# Rows of both, and those in a row as one.

def _row(motion: Motion, rank: int) -> int:
    """The row of a cut by its rank; -1 where there is none."""
    return int(motion.row[motion.cuts[rank]]) if 0 <= rank < len(motion.cuts) else -1


def _rows(one: Motion, i: int, other: Motion, j: int) -> tuple[int, int]:
    return _row(one, i), _row(other, j)


def _grouped(
    kind: str, one: Motion, i: Index, other: Motion, j: Index, said: Callable[[int], tuple[str, str]], off: Any = None,
    unit: str = "mm", values: tuple[Array, ...] = (),
) -> list[Found]:  # fmt: skip
    """Differences of a kind at cuts by their ranks (k,): those that follow each other, with the same `values`, are one."""
    if not len(i):
        return []
    off = np.zeros(len(i)) if off is None else off
    new = (np.diff(i) != 1) | (np.diff(j) != 1)
    for each in values:
        new |= (each[1:] != each[:-1]) & ~(np.isnan(each[1:]) & np.isnan(each[:-1]))
    first = np.flatnonzero(np.append(True, new))
    most, moves = np.maximum.reduceat(off, first), np.diff(np.append(first, len(i)))
    return [
        Found(kind, _rows(one, int(i[k]), other, int(j[k])), float(much), unit, said(k), many)
        for k, much, many in zip(first.tolist(), most.tolist(), moves.tolist())
    ]

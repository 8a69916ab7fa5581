"""Which cut of one program is which of another, and whether the two are the same. Lengths in mm, angles in rad."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import dist
from typing import Any, cast

import numpy as np

from mnclab.comparison.motion import ARM, Motion
from mnclab.geometry.curves import counted
from mnclab.path.places import Bends
from mnclab.path.toolpath import Array, Index, Kind, Mask

SPREAD = 1.25  # how much more than its ends the quarters of an arc may be off
QUARTERS = (0.25, 0.5, 0.75)  # of an arc: where two are compared beside their ends


def apart(one: Motion, i: Index, other: Motion, j: Index) -> Array:
    """How far (k,) moves i (k,) of one are from moves j (k,) of the other at their ends, and arcs between; mm, inf of two kinds.

    The start is that of the move before, so one wrong end is one difference.
    """
    found = np.maximum(np.linalg.norm(one.end[i] - other.end[j], axis=1), leaning(one, i, other, j))
    kind = one.kind[i]
    found[kind != other.kind[j]] = np.inf
    arcs = np.flatnonzero((kind == Kind.ARC) & np.isfinite(found))
    if len(arcs):
        bends = [Bends(cast(Any, motion), rows[arcs]) for motion, rows in ((one, i), (other, j))]
        sense = np.sign(np.einsum("ij,ij->i", one.axis[i[arcs]], other.axis[j[arcs]]))
        turn = np.abs(bends[0].sweep - sense * bends[1].sweep)
        off = [np.linalg.norm(bends[0].place(share) - bends[1].place(share), axis=1) for share in QUARTERS]
        radius = np.minimum(bends[0].radius, bends[1].radius)
        whole = np.where(turn > 0.5, np.minimum(turn / np.pi, 2) * radius, 0.0)  # another sense, other turns
        found[arcs] = np.maximum.reduce([found[arcs], whole, *(each / SPREAD for each in off)])
    return found


def leaning(one: Motion, i: Index, other: Motion, j: Index) -> Array:
    """How far (k,) the tools of two motions lean from one another, mm at `ARM`, at the ends of moves i (k,) and j (k,)."""
    if not (one.turns or other.turns):
        return np.zeros(len(i))
    if one.tool_along is not None and other.tool_along is not None:  # two machines may turn by other axes
        return np.asarray(np.linalg.norm(one.tool_along[i] - other.tool_along[j], axis=1) * ARM)
    return np.asarray(np.abs(one.rotary[i] - other.rotary[j]).max(axis=1) * ARM)


def one_swing(one: Motion, i: Index, other: Motion, j: Index, tolerance: float) -> bool:
    """Whether moves i (k,) and j (m,) that turn are one way of the same axes, which all run evenly along a row."""
    if one.path.kinematics is None or one.path.kinematics != other.path.kinematics:
        return False
    ways = [each.axes[max(int(each.row[k[0]]) - 1, 0) : int(each.last[k[-1]]) + 1] for each, k in ((one, i), (other, j))]
    behind = [np.append(0.0, np.cumsum(np.linalg.norm(np.diff(way, axis=0), axis=1))) for way in ways]
    if abs(behind[0][-1] - behind[1][-1]) > tolerance or not behind[0][-1]:
        return False
    for k in (0, 1):
        there = [np.interp(behind[k] / behind[k][-1], behind[1 - k] / behind[1 - k][-1], axis) for axis in ways[1 - k].T]
        if np.abs(np.stack(there, axis=1) - ways[k]).max() > tolerance:
            return False
    return True


def as_chords(one: Motion, i: int, other: Motion, j: int, tolerance: float) -> int:
    """How many lines from j on lie on the arc i within the tolerance, chord error included, and end where it ends; else 0."""
    lines = np.append(other.kind[j : j + 4096] == Kind.LINE, False)
    many = int(lines.argmin()) if one.kind[i] == Kind.ARC else 0
    ends = other.end[j : j + many]
    places = np.stack([(other.start[j : j + many] + ends) / 2, ends], axis=1).reshape(-1, 3)  # the middle of each, and its end
    arc = Bends(cast(Any, one), np.full(2 * many, i))
    gone = places - (arc.start - arc.spoke)
    seen = (np.einsum("ij,ij->i", gone, each) for each in (arc.side, arc.spoke))
    share = np.unwrap(np.append(0.0, np.arctan2(*seen)))[1:] / arc.sweep
    fits = np.linalg.norm(arc.place(share) - places, axis=1) <= tolerance
    fits &= (share > -1e-3) & (np.diff(share, prepend=0.0) > -1e-9)
    there = (np.linalg.norm(ends - one.end[i], axis=1) <= tolerance) & (share[1::2] > 0.9)
    upto = np.flatnonzero(there & np.logical_and.accumulate(fits)[1::2])
    return int(upto[0]) + 1 if len(upto) else 0


# Which cut of one program is which of the other.

WINDOWS = (4, 24, 160, 800)  # cuts ahead in which two programs are sought to go on alike
ENOUGH = 3  # cuts in a row
MOST = 2000  # places where they do not
Stretch = tuple[int, int, int, int]  # of cuts by their ranks: i and to of one, j and to of the other


@dataclass(frozen=True, eq=False)
class Pairs:
    """Cuts by their ranks: i (k,) of one are j (k,) of the other; `chords` and `odd` are stretches (i, to, j, to) that are not.

    Those of `chords` are arcs of the one and lines of the other.
    """

    i: Index
    j: Index
    chords: list[Stretch]
    odd: list[Stretch]


def paired(one: Motion, other: Motion, tolerance: float) -> Pairs:
    """The cuts of two motions, as far as they go alike."""
    n, m = len(one.cuts), len(other.cuts)
    i = j = 0
    runs, chords, odd = list[tuple[int, int, int]](), list[Stretch](), list[Stretch]()

    def alike(p: Index, q: Index) -> Mask:
        return np.asarray(apart(one, one.cuts[p], other, other.cuts[q]) <= tolerance)

    while True:
        many, chunk = 0, 64
        while (room := min(n - i, m - j) - many) > 0:
            k = np.arange(many, many + min(chunk, room))
            fits = alike(i + k, j + k)
            many += len(fits) if fits.all() else int(np.argmin(fits))
            if not fits.all():
                break
            chunk = min(4 * chunk, 1 << 16)
        runs.append((i, j, many))
        i, j = i + many, j + many
        if i == n or j == m or len(odd) == MOST:
            break
        bent = _chords(one, i, other, j, tolerance)
        p, q = bent if any(bent) else _ahead(alike, n - i, m - j, i, j)
        (chords if any(bent) else odd).append((i, i + p, j, j + q))
        i, j = i + p, j + q
    if i < n or j < m:
        odd.append((i, n, j, m))
    first, second, counts = np.array(runs).T
    which, rank = counted(counts)
    return Pairs(first[which] + rank, second[which] + rank, chords, odd)


def _chords(one: Motion, i: int, other: Motion, j: int, tolerance: float) -> tuple[int, int]:
    """How many cuts of both are one arc here, said as lines by one of them; none if it is not so."""
    p, q = int(one.cuts[i]), int(other.cuts[j])
    if many := as_chords(one, p, other, q, tolerance):
        return 1, many
    many = as_chords(other, q, one, p, tolerance)
    return many, min(many, 1)


def _ahead(alike: Callable[[Index, Index], Mask], n: int, m: int, i: int, j: int) -> tuple[int, int]:
    """How many cuts of both to pass over until they go alike again; all of them if they never do."""
    for window in WINDOWS:
        p, q = (grid.ravel() for grid in np.meshgrid(np.arange(min(window, n)), np.arange(min(window, m)), indexing="ij"))
        good = np.ones(len(p), dtype=bool)
        for k in range(ENOUGH):
            at = np.flatnonzero(good & (p + k < n) & (q + k < m))
            good[at] = alike(i + p[at] + k, j + q[at] + k)
            if k:  # one that is over has no more to show; the other must be over too
                good &= (p + k < n) == (q + k < m)
        if good.any():
            at = np.flatnonzero(good)
            best = at[np.lexsort((np.abs(p[at] - q[at]), p[at] + q[at]))[0]]
            return int(p[best]), int(q[best])
        if window >= n and window >= m:
            break
    return n, m


# Cuts that are not the same, and still each other's.

LONE, STRANGE = 0.55, 1.0  # what a cut of one program alone costs, and two that have nothing of each other
LIKE = (0.0, 0.1, 0.2, 0.25, 0.3)  # an arc of the same circle; the same end; the same from above, way and end, or one of them
LARGEST = 4_000_000  # pairs


def alongside(one: Motion, i: Index, other: Motion, j: Index, tolerance: float) -> tuple[Index, Index]:
    """Which of the cuts by their ranks i (n,) of one and j (m,) of the other are each other's, as places in i and j (k,).

    Of all ways to put the two in order beside each other that which costs least; of very many cuts one after the other.
    """
    n, m = len(i), len(j)
    if n == 0 or m == 0 or n * m > LARGEST:
        return np.arange(min(n, m)), np.arange(min(n, m))
    p, q = one.cuts[i], other.cuts[j]
    step = np.abs(one.end[p][:, None] - other.end[q]) <= tolerance
    way = np.abs((one.end[p] - one.start[p])[:, None] - (other.end[q] - other.start[q])) <= tolerance
    seen = slice(None) if one.path.lathe else slice(2)  # from above
    flat, same = step[:, :, seen].all(axis=2), way[:, :, seen].all(axis=2)
    kind, sense = (a[:, None] != b for a, b in ((one.kind[p], other.kind[q]), (np.sign(one.sweep[p]), np.sign(other.sweep[q]))))
    about = ~sense & (np.abs(one.centre[p][:, None] - other.centre[q]) <= tolerance).all(axis=2)  # nan of lines
    cost = np.select([about, step.all(axis=2), flat & same, same, flat], LIKE, STRANGE) + LIKE[2] * kind + LIKE[1] / 2 * sense
    lone = LONE * np.arange(m, -1, -1)
    least = np.tile(lone, (n + 1, 1))  # from each two cuts on
    for k in range(n - 1, -1, -1):
        here = np.minimum(np.append(least[k + 1, 1:] + cost[k], np.inf), least[k + 1] + LONE)
        least[k] = np.minimum.accumulate((here - lone)[::-1])[::-1] + lone
    pairs, k, at = [], 0, 0
    while k < n and at < m:
        if least[k, at] >= least[k + 1, at + 1] + cost[k, at] - 1e-9:
            pairs.append((k, at))
            k, at = k + 1, at + 1
        elif least[k, at] >= least[k + 1, at] + LONE - 1e-9:
            k += 1
        else:
            at += 1
    found = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    return found[:, 0], found[:, 1]


MARK = np.int64(1_000_003)


def same_places(one: Array, other: Array, tolerance: float, parts: tuple[slice, ...]) -> Index:
    """Which rows (k, 2) of two tables of numbers are the same, each but once, whatever their order: in each of the parts of a row
    they are no farther apart than the tolerance."""
    both = np.concatenate([one, other])
    order = np.argsort(both, axis=0, kind="stable")
    keys = np.zeros(both.shape, dtype=np.int64)  # numbers with no gap between them have one key
    np.put_along_axis(keys, order[1:], np.cumsum(np.diff(np.take_along_axis(both, order, 0), axis=0) > tolerance, axis=0), 0)
    marks = np.split(keys @ MARK ** np.arange(1, both.shape[1] + 1), [len(one)])  # of equal keys alike, of hardly any others
    here, there = (np.flatnonzero(np.isin(a, b)) for a, b in (marks, marks[::-1]))
    known: dict[tuple[int, ...], list[int]] = {}
    for rank, key in zip(there.tolist(), keys[len(one) + there].tolist()):
        known.setdefault(tuple(key), []).append(rank)
    met = []
    for k, key in zip(here.tolist(), keys[here].tolist()):
        near = known.get(tuple(key), [])
        fit = next((rank for rank in near if all(dist(one[k, part], other[rank, part]) <= tolerance for part in parts)), None)
        if fit is not None:
            near.remove(fit)
            met.append((k, fit))
    return np.array(met, dtype=np.int64).reshape(-1, 2)

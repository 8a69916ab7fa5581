"""What differs in the motion of two programs, by kinds, each at its row of both paths. Lengths in mm, feeds in mm/min."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

from mnclab.comparison.diff import nearest_of, strokes_of
from mnclab.comparison.found import NONE, RATE, Found, from_where, grouped, of_contour, rows_of, tilts
from mnclab.comparison.motion import ARM, NO_WAY, Motion
from mnclab.comparison.pairs import Pairs, Stretch, alongside, apart, leaning, one_swing, paired, same_places
from mnclab.comparison.ways import Around, links, of_dwells, of_links
from mnclab.path.listing import figure
from mnclab.path.places import points_at
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath
from mnclab.text.alarm import several

ROUGH = 0.02  # of a way: how far apart the tool may be on two that are divided otherwise
BENT = 0.01  # rad: as much less of arcs has the one that has chords in their place
CHAIN = 3  # cuts in place of one: fewer are compared one by one
CAUSES, FIRST = ("", "tool", "side", "depth", "geometry", "rapid", "nearer", "aside", "spindle", "feed"), 4  # "": missing
CUTS = ("geometry", "depth", "side")  # kinds
LONGEST, AT_ONCE = 400_000, 4096  # cuts of a stretch that is looked at as a whole, and so many of its strokes at a time
LONGER = 1e-3  # of a way: by how much more than chords may make it
SAME = 1e-9  # shares of a way
LONG, SHORT = 64, 0.1  # cuts of a stretch that is looked at for a part that is apart, and the share of the way that it may have
FLOWS = ("off", "on (M8)", "on (M7)")
SIDES = {0: "none", 1: "left", -1: "right"}


def differences(one: Motion, other: Motion, tolerance: float, around: Around) -> list[Found]:
    """All that differs, in the order of the motion; `around` is what stands on the machine."""
    pairs = paired(one, other, tolerance)
    found, more, parts = _of_stretches(one, other, pairs, tolerance)
    i, j = np.concatenate([pairs.i, more[:, 0]]), np.concatenate([pairs.j, more[:, 1]])
    within = [_side_by_side(one, other, *each) for each in parts]
    a, b = np.unique(np.hstack([(i, j), *within]), axis=1)
    found += _of_settings(one, other, a, b, tolerance)
    between = links(one, other, i, j, parts)
    told = {(each.kind, each.rows[1]) for each in found}  # a cut of the one that the other goes at rapid is not told again
    ways = of_links(one, other, *between, tolerance, around)
    found += [each for each in ways if (each.kind, each.rows[1]) not in told]
    found += of_dwells(one, other, *between, parts)
    found += _left_over(one, other)
    found = [of_contour(each, one, other, tolerance) if each.kind in CUTS else each for each in found]
    return in_order(found, one, other)


def in_order(found: list[Found], one: Motion, other: Motion) -> list[Found]:
    """In the order of the motion; of what differs at one cut, on the way to it or in one block first what causes the rest."""
    lasts = [motion.last[motion.cuts] for motion in (one, other)]

    def place(each: Found) -> tuple[int, bool, int, int]:
        k = int(each.rows[1] >= 0)
        motion, row = (one, other)[k], each.rows[k]
        begins = int(np.searchsorted(motion.path.step, motion.path.step[row])) if row >= 0 else -1
        cause = CAUSES.index("" if each.values[1] == NONE else each.kind) if each.kind in CAUSES else len(CAUSES)
        return int(np.searchsorted(lasts[k], row)), cause >= FIRST, begins, cause

    return sorted(found, key=place)


# Cuts that are not the same.

def _of_stretches(
    one: Motion, other: Motion, pairs: Pairs, tolerance: float
) -> tuple[list[Found], Index, list[Stretch]]:
    """What differs where cuts are not the same, the pairs (k, 2) of cuts that are still each other's, and stretches that are."""
    found, odd, one_way = list[Found](), list[Stretch](), list[Stretch]()
    for stretch in pairs.odd:
        i, to_i, j, to_j = stretch
        longer = (i, min(to_i + 1, len(one.cuts)), j, min(to_j + 1, len(other.cuts)))  # a line that one of them goes in two
        alike = next((each for each in (stretch, longer) if _one_way(one, other, *each, tolerance)), None)
        if alike is None and (apart_between := _apart_between(one, other, stretch, tolerance)):
            found.append(apart_between[0])
            one_way += [each for each in apart_between[1] if each[0] < each[1] and each[2] < each[3]]
        else:
            (one_way if alike else odd).append(alike or stretch)
    for i, to_i, j, to_j in (one_way := pairs.chords + one_way):
        bent = [np.abs(motion.sweep[motion.cuts[a:b]]).sum() for motion, a, b in ((one, i, to_i), (other, j, to_j))]
        if abs(bent[0] - bent[1]) >= BENT:
            arcs = ("arcs", several(to_j - j, "line")) if bent[0] > bent[1] else (several(to_i - i, "line"), "arcs")
            found.append(Found("chords", rows_of(one, i, other, j), 0.0, "mm", arcs, max(to_i - i, to_j - j)))
    more, lone = list[tuple[int, int]](), []
    for i, to_i, j, to_j in odd:
        a, b = np.arange(i, to_i), np.arange(j, to_j)
        p, q = alongside(one, a, other, b, tolerance)
        begun = np.linalg.norm(one.start[one.cuts[a[p]]] - other.start[other.cuts[b[q]]], axis=1)
        fits = np.maximum(apart(one, one.cuts[a[p]], other, other.cuts[b[q]]), begun) <= tolerance
        more += zip(a[p[fits]].tolist(), b[q[fits]].tolist())
        lone.append((np.delete(a, p[fits]), np.delete(b, q[fits]), np.stack([a[p[fits]], b[q[fits]]])))
    left = [np.concatenate([np.empty(0, np.int64), *(each[k] for each in lone)]) for k in (0, 1)]
    moved = _elsewhere(one, left[0], other, left[1], tolerance)
    found += grouped("order", one, moved[:, 0], other, moved[:, 1], lambda k: ("here", "at another place in the order"))
    more += map(tuple, moved.tolist())
    for (a, b, sure), (_, to_i, _, to_j) in zip(lone, odd):
        a, b = np.setdiff1d(a, moved[:, 0]), np.setdiff1d(b, moved[:, 1])
        if min(len(a), len(b)) == 1 and max(len(a), len(b)) > CHAIN:  # an arc, say, and the chords in its place
            rows = rows_of(one, int(a[0]), other, int(b[0]))
            k, many, whole, at = (1, b, one, a) if len(a) == 1 else (0, a, other, b)
            row, off = _leaves((one, other)[k], (one, other)[k].cuts[many], whole, int(at[0]), tolerance)
            rows = (rows[0], row) if k else (row, rows[1])
            found.append(Found("geometry", rows, off, "mm", ("", ""), len(many)))
            more.append((int(a[0]), int(b[0])))
            continue
        p, q = alongside(one, a, other, b, tolerance)
        found += _not_alike(one, a[p], other, b[q], tolerance)
        more += zip(a[p].tolist(), b[q].tolist())
        known = np.hstack([sure, [a[p], b[q]]])
        for k, cuts, here, there, met, beyond in ((0, a, one, other, p, to_j), (1, b, other, one, q, to_i)):
            alone = np.delete(np.arange(len(cuts)), met)
            for ranks in np.split(alone, np.flatnonzero(np.diff(cuts[alone]) > 1) + 1):
                behind = int(known[1 - k, known[k] > cuts[ranks[:1]].sum()].min(initial=beyond))
                moves = here.cuts[cuts[ranks]]
                turns = np.abs(here.rotary[moves] - here.rotary[np.maximum(moves - 1, 0)]).max(axis=1, initial=0.0) * ARM
                long = (here.lengths[moves] + turns).sum()  # what rounding adds to a corner is no cut
                if long > tolerance and not _begins(here, cuts[ranks], there, behind, tolerance):
                    found.append(_only(here, cuts[ranks], there, behind, k, tolerance))
    return found, np.array(more, dtype=np.int64).reshape(-1, 2), one_way


def _only(motion: Motion, ranks: Index, other: Motion, there: int, k: int, tolerance: float) -> Found:
    """Cuts that one of the two has alone, before the cut `there` of the other; `k` is which of the two it is."""
    cuts = motion.cuts[ranks]
    begin = other.cuts[there - 1] + 1 if there else 0
    moves = np.arange(begin, min(other.cuts[there] + 1 if there < len(other.cuts) else len(other), len(other)))
    if there and (deeper := _deeper(motion, cuts, other, there, k, tolerance)):
        return deeper
    way, row, said = float(motion.lengths[cuts].sum()), int(other.row[-1]) if len(other) else -1, NONE
    if len(moves):
        off = np.linalg.norm(other.end[moves] - motion.end[cuts[0]], axis=1)
        near = moves[off.argmin()]
        if off.min() <= tolerance and other.kind[near] == Kind.RAPID:  # the same at rapid
            row, said = int(other.last[near]), "at rapid"
        else:  # where it would stand: behind the move that ends where it begins
            gone = other.start[moves] - motion.start[cuts[0]]
            off, flat = np.linalg.norm(gone, axis=1), np.linalg.norm(gone[:, :2], axis=1)
            last = len(moves) - 1 - int((flat <= flat.min() + tolerance)[::-1].argmax())
            row = int(other.row[moves[off.argmin() if off.min() <= tolerance else last]])
    both = [(_leaves(motion, cuts, other, there, tolerance)[0], several(len(cuts), "cut")), (row, said)]
    (one_row, one_said), (other_row, other_said) = both[::-1] if k else both
    kind = "rapid" if not k and said == "at rapid" else "geometry"  # what one cuts the other goes at rapid
    return Found(kind, (one_row, other_row), way, "mm", (one_said, other_said), len(cuts))


def _deeper(motion: Motion, cuts: Index, other: Motion, there: int, k: int, tolerance: float) -> Found | None:
    """Cuts of the one alone as another depth, where they go on down in a hole that the other has done with."""
    last, behind = other.cuts[there - 1], other.end[other.cuts[there : there + 1]]
    tools = motion.tool_along if motion.turns else None
    along = np.array([0.0, 0.0, 1.0]) if tools is None else tools[cuts[-1]]
    ways = [each - other.end[last] for each in (np.vstack([motion.start[cuts], motion.end[cuts]]), behind)]
    inside, beyond = ((np.linalg.norm(way - np.outer(way @ along, along), axis=1) <= tolerance).all() for way in ways)
    deep = -float((ways[0] @ along).min())
    if motion.path.lathe or not inside or (beyond and len(behind)) or deep <= tolerance:
        return None
    rows = [int(motion.row[cuts[-1]])]
    rows.insert(1 - k, int(other.row[last]))
    return Found("depth", (rows[0], rows[1]), deep, "mm", ("", ""))


def _begins(motion: Motion, ranks: Index, other: Motion, there: int, tolerance: float) -> bool:
    """Whether a cut is where the cut `there` of the other, which goes on straight, begins."""
    if len(ranks) != 1 or there >= len(other.cuts):
        return False
    a, b = motion.cuts[ranks[0]], other.cuts[there]
    begins = bool(np.linalg.norm(motion.start[a] - other.start[b]) <= tolerance)
    begins |= ranks[0] > 0 and bool(motion.cuts[ranks[0] - 1] == a - 1)  # else the cut before it is told
    gone, whole = motion.end[a] - other.start[b], other.end[b] - other.start[b]
    beside = float(np.linalg.norm(np.cross(gone, whole))) <= tolerance * float(np.linalg.norm(whole))
    return begins and beside and bool(0 < gone @ whole < whole @ whole and motion.kind[a] == other.kind[b] == Kind.LINE)


def _leaves(motion: Motion, cuts: Index, other: Motion, there: int, tolerance: float) -> tuple[int, float]:
    """The row of cuts, each of many blocks maybe, that first leaves the way of the cut `there` of the other, else the first, and
    by how much, mm."""
    rows = np.arange(motion.row[cuts[0]], motion.last[cuts[-1]] + 1)
    if there >= len(other.cuts):
        return int(rows[0]), float("nan")
    cut = other.cuts[there]
    begin, end, _ = strokes_of(other.path[other.row[cut] : other.last[cut] + 1], tolerance / 10)
    places = [points_at(motion.path, rows, np.full(len(rows), share)) for share in (0.5, 1.0)]  # of a chord the middle is off
    moves = np.searchsorted(motion.row, rows, "right") - 1
    far = [np.linalg.norm(place - nearest_of(place, begin, end), axis=1) for place in places]
    off = np.max([*far, leaning(motion, moves, other, np.array([cut]))], axis=0)
    first = int(np.argmax(off > tolerance))
    return int(rows[first]), float(off[first]) if off[first] > tolerance else float("nan")


def _side_by_side(one: Motion, other: Motion, i: int, to_i: int, j: int, to_j: int) -> tuple[Index, Index]:
    """Of stretches that are one way divided otherwise, which cuts of both go along each other."""
    cuts = one.cuts[i:to_i], other.cuts[j:to_j]
    ways = [np.cumsum(np.maximum(motion.lengths[some], NO_WAY)) for motion, some in zip((one, other), cuts)]
    places = np.sort(np.concatenate([way / way[-1] for way in ways]))
    middles = (np.append(0.0, places[:-1]) + places)[np.diff(places, prepend=0.0) > 1e-4] / 2
    a, b = (np.minimum(np.searchsorted(way / way[-1], middles), len(way) - 1) for way in ways)
    return i + a, j + b


def _one_way(one: Motion, other: Motion, i: int, to_i: int, j: int, to_j: int, tolerance: float) -> bool:
    """Whether two stretches of cuts are one way divided otherwise: no place of either is off the other by more."""
    if i == to_i or j == to_j or max(to_i - i, to_j - j) > LONGEST:
        return False
    here, there = one.cuts[i:to_i], other.cuts[j:to_j]
    if any(cuts[-1] - cuts[0] != len(cuts) - 1 for cuts in (here, there)):  # there are rapids between
        return False
    if max(leaning(one, here, other, there[:1]).max(), leaning(other, there, one, here[:1]).max()) > tolerance:
        return one_swing(one, here, other, there, tolerance)
    p, q = _path_of(one, here), _path_of(other, there)
    if to_i - i == to_j - j:  # as many: block by block, or not at all
        straight = (p.kind == Kind.LINE).all() and (q.kind == Kind.LINE).all()
        return bool(straight) and len(p) == len(q) > to_i - i and bool((np.linalg.norm(p.end - q.end, axis=1) <= tolerance).all())
    ends = max(np.abs(p.start[0] - q.start[0]).max(), np.abs(p.end[-1] - q.end[-1]).max())
    if ends > tolerance or abs(p.length - q.length) > LONGER * p.length + tolerance or not p.length:
        return False
    halfway = [points_at(each, *_at_shares(each)) for each in (p, q)]  # the same way round
    if np.linalg.norm(halfway[0] - halfway[1], axis=1).max() > tolerance + ROUGH * p.length:
        return False
    return all((off <= tolerance).all() for off, _ in _beside(p, q, tolerance))


def _beside(p: Toolpath, q: Toolpath, tolerance: float) -> Iterator[tuple[Array, Array]]:
    """How far off the other path each stroke of p ends, mm, and what share of the way is behind then, each (k,); the same of q.

    The other is looked at no farther along its way than as much longer as it may be.
    """
    strokes = [strokes_of(path, tolerance / 10)[:2] for path in (p, q)]
    ways = [np.cumsum(np.linalg.norm(end - start, axis=1)) for start, end in strokes]
    shares, slack = [way / way[-1] for way in ways], LONGER + tolerance / ways[0][-1]
    for (_, ends), share, (begins, behind), other in zip(strokes, shares, strokes[::-1], shares[::-1]):
        off = np.empty(len(ends))
        for k in range(0, len(ends), AT_ONCE):
            here = ends[k : k + AT_ONCE]
            first, last = np.searchsorted(other, share[k : k + AT_ONCE][[0, -1]] + (-slack, slack)).tolist()
            near = nearest_of(here, begins[first : last + 1], behind[first : last + 1])
            off[k : k + AT_ONCE] = np.linalg.norm(here - near, axis=1)
        yield off, share


def _apart_between(
    one: Motion, other: Motion, stretch: Stretch, tolerance: float
) -> tuple[Found, tuple[Stretch, Stretch]] | None:
    """Where two long stretches that are one way but for a short part of it are apart, and the stretches before and behind."""
    i, to_i, j, to_j = stretch
    cuts = one.cuts[i:to_i], other.cuts[j:to_j]
    gaps = any(some[-1] - some[0] != len(some) - 1 for some in cuts if len(some))  # rapids
    if not LONG < max(map(len, cuts)) <= LONGEST or min(map(len, cuts)) < 3 or gaps or one.turns or other.turns:
        return None
    p, q = _path_of(one, cuts[0]), _path_of(other, cuts[1])
    if np.abs(p.end[-1] - q.end[-1]).max() > tolerance or abs(p.length - q.length) > LONGER * p.length + tolerance:
        return None
    looks = [*_beside(p, q, tolerance)]
    wrong = np.concatenate([share[off > tolerance] for off, share in looks])
    if not len(wrong) or np.ptp(wrong) > SHORT:
        return None
    ways = [np.cumsum(motion.lengths[some]) for motion, some in zip((one, other), cuts)]
    (a, to_a), (b, to_b) = (np.searchsorted(way / way[-1], (wrong.min() - SAME, wrong.max())).tolist() for way in ways)
    farthest = max(float(off.max()) for off, _ in looks)
    found = Found("geometry", rows_of(one, i + a, other, j + b), farthest, "mm", ("", ""), 1)
    return found, ((i, i + a, j, j + b), (min(i + to_a + 1, to_i), to_i, min(j + to_b + 1, to_j), to_j))


def _path_of(motion: Motion, cuts: Index) -> Toolpath:
    """Of cuts one behind the other the rows that have a way."""
    path = motion.path[motion.row[cuts[0]] : motion.last[cuts[-1]] + 1]
    return path[path.is_motion & (path.lengths > NO_WAY)]


def _at_shares(path: Toolpath) -> tuple[Index, Array]:
    """Rows (k,) and their shares where a tenth, two tenths, … of the way of a path are behind."""
    upto = np.cumsum(path.lengths)
    way = np.arange(0.1, 0.95, 0.1) * upto[-1]
    rows = np.minimum(np.searchsorted(upto, way), len(path) - 1)
    return rows, 1 - (upto[rows] - way) / path.lengths[rows]


def _not_alike(one: Motion, i: Index, other: Motion, j: Index, tolerance: float) -> list[Found]:
    """What is wrong with cuts that are each other's."""
    p, q = one.cuts[i], other.cuts[j]
    off, begins = apart(one, p, other, q), np.linalg.norm(one.start[p] - other.start[q], axis=1)
    follow = np.append(False, (np.diff(i) == 1) & (np.diff(j) == 1))  # the start is the end of a cut that is told
    off = np.where((off <= tolerance) & ~follow[: len(off)], begins, off)
    wrong = off > tolerance
    i, j, p, q, off = i[wrong], j[wrong], p[wrong], q[wrong], off[wrong]
    step = np.abs(one.end[p] - other.end[q])
    mill = not (one.path.lathe or other.path.lathe)
    deep = mill & (np.hypot(step[:, 0], step[:, 1]) <= tolerance) & (np.abs(off - step[:, 2]) <= tolerance)
    off = np.where(np.isfinite(off), off, np.linalg.norm(step, axis=1))
    far = leaning(one, p, other, q)
    leans = (far > tolerance) & (far >= off - SAME)
    lift = [motion.end[e, 2] - motion.path.end[motion.last[e], 2] for motion, e in ((one, p), (other, q))]
    found = []
    for kind, mask in (("geometry", ~deep), ("depth", deep)):
        tips = np.stack(lift, axis=1)[mask]
        said = partial(_off_table, tips, tolerance, partial(_leans, one, p[mask], other, q[mask], leans[mask]))
        for each in grouped(kind, one, i[mask], other, j[mask], said, off[mask]):
            found.append(each._replace(rows=from_where(one, other, each.rows, tolerance)))
    return found


def _leans(one: Motion, i: Index, other: Motion, j: Index, leans: Mask, k: int) -> tuple[str, str] | None:
    return tilts(one, int(i[k]), other, int(j[k])) if leans[k] else None


def _off_table(tips: Array, tolerance: float, leaning_at: Callable[[int], tuple[str, str] | None], k: int) -> tuple[str, str]:
    """How the tools lean, else how much higher than programmed their tips (k, 2) are, in words, where that is not the same."""
    if (leans := leaning_at(k)) is not None:
        return leans
    if abs(tips[k, 0] - tips[k, 1]) <= tolerance:
        return "", ""
    words = (f"tip {figure(abs(much), 3)} mm {'higher' if much > 0 else 'lower'} by a delta length" for much in tips[k].tolist())
    one, other = (word if much else "no delta length" for word, much in zip(words, tips[k]))
    return one, other


def _elsewhere(one: Motion, i: Index, other: Motion, j: Index, tolerance: float) -> Index:
    """Of cuts that are left, those pairs (k, 2) that are the same, whatever the order."""
    p, q = one.cuts[i], other.cuts[j]
    tables = [np.column_stack([m.kind[e], m.start[e], m.end[e]]) for m, e in ((one, p), (other, q))]
    a, b = same_places(tables[0], tables[1], tolerance, (slice(1), slice(1, 4), slice(4, 7))).T
    good = apart(one, p[a], other, q[b]) <= tolerance
    return np.stack([i[a[good]], j[b[good]]], axis=1)


# How they are cut.

def _of_settings(one: Motion, other: Motion, i: Index, j: Index, tolerance: float) -> Iterator[Found]:
    """Feed, speed, coolant, tool and side of cuts that are each other's."""
    p, q = one.cuts[i], other.cuts[j]

    def told(
        kind: str, a: Array, b: Array, unit: str, name: Callable[[Any], str], near: float = 0.0, shown: Any = None
    ) -> list[Found]:
        with np.errstate(invalid="ignore"):
            wrong = ~((np.abs(a - b) <= near * np.maximum(np.abs(a), np.abs(b))) | (a == b) | (np.isnan(a) & np.isnan(b)))
        at = np.flatnonzero(wrong)
        off = np.abs(a[at] - b[at]).astype(float) if unit else np.zeros(len(at))
        a, b = (each[at] for each in shown or (a, b))
        return grouped(kind, one, i[at], other, j[at], lambda k: (name(a[k]), name(b[k])), off, unit, (a, b))

    turns = np.isfinite([one.per_rev[p], other.per_rev[q]]).sum(axis=0)  # how many of both feed by the turn
    for many, name in ((0, _named("F")), (1, _named("", " mm/min"))):
        a, b = (np.where(turns == many, m.feed[e], 0) for m, e in ((one, p), (other, q)))
        yield from told("feed", a, b, "mm/min", name, RATE)
    a, b = (np.where(turns == 2, m.per_rev[e], np.nan) for m, e in ((one, p), (other, q)))
    yield from told("feed", a, b, "mm/rev", _named("F", " a turn"), RATE)
    a, b = one.held[p].astype(float), other.held[q].astype(float)
    yield from told("restart", a, b, "", lambda held: "held through the tool change" if held else "started behind it")
    a, b = one.synchronous[p].astype(float), other.synchronous[q].astype(float)
    yield from told("feed", a, b, "", lambda value: "locked to the spindle" if value else "free of the spindle")
    yield from told("spindle", one.surface[p], other.surface[q], "m/min", _named("cutting speed "), RATE)
    even = np.isnan(one.surface[p]) == np.isnan(other.surface[q])
    a, b = (np.where(even, m.spindle[e], 0) for m, e in ((one, p), (other, q)))
    yield from told("spindle", a, b, "rev/min", _turning, RATE)
    yield from told("coolant", one.coolant[p], other.coolant[q], "", lambda value: FLOWS[value])
    numbers = [m.path.tool[m.row[e]] for m, e in ((one, p), (other, q))]
    yield from told("tool", one.tool[p], other.tool[q], "", lambda value: f"T{value}", shown=numbers)
    a, b = (np.where(one.tool[p] == other.tool[q], each, 0) for each in numbers)
    yield from told("number", a, b, "", lambda value: f"T{value}")
    yield from told("tool", one.radius[p], other.radius[q], "mm", _named("radius "), 1e-4)
    a, b = one.side[p], other.side[q]
    half = (a != b) & (a * b == 0)  # only one compensates: where the way is the same, the other says that of the centre
    which = np.cumsum(half & ~np.append(False, half[:-1]))
    alike = np.bincount(which[half], apart(one, p, other, q)[half] <= tolerance, which.max(initial=0) + 1)[which] > 0
    for kind, here in (("side", ~(half & alike)), ("centre", half & alike)):
        yield from told(kind, np.where(here, a, 0), np.where(here, b, 0), "", lambda value: SIDES[int(value)])


def _named(before: str, behind: str = "") -> Callable[[Any], str]:
    return lambda value: "not given" if np.isnan(value) else f"{before}{figure(float(value), 3)}{behind}"


def _turning(speed: float) -> str:
    return f"S{figure(abs(speed), 1)} {'M3' if speed > 0 else 'M4'}" if speed else "spindle off"


def _left_over(one: Motion, other: Motion) -> list[Found]:
    """What is still switched on at the end."""
    rows = len(one.path) - 1, len(other.path) - 1
    names = (_turning, lambda value: f"coolant {FLOWS[value]}", lambda value: f"compensation {SIDES[int(value)]}")
    found = [
        Found("leftovers", rows, 0.0, "", (name(a), name(b)))
        for name, a, b in zip(names, one.at_end, other.at_end)
        if abs(a - b) > RATE * max(abs(a), abs(b))
    ]
    left = [(name, one.left[name], other.left[name]) for name in one.left if name in other.left]
    return [*found, *(Found("leftovers", rows, 0.0, "", (f"{name} {a}", f"{name} {b}")) for name, a, b in left if a != b)]

"""What a contour says about its ends: where the tool arrives and leaves, and walls that it does not leave standing."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mnclab.geometry.chords import Chunks, Walls, around, near
from mnclab.geometry.curves import Curves, cross, crossings, distance, dot, gap, left, part, share, unit_of
from mnclab.path.compensation import neighbours
from mnclab.path.compensation.elements import (
    CLEAR,
    EXACT,
    Elements,
    Places,
    at_height,
    meet,
    misfit,
    narrowed,
    retracted,
)
from mnclab.path.compensation.equidistant import Equidistant
from mnclab.path.toolpath import Array, Index, Mask, Rule

# What a contour says about walls that it does not leave standing: contours run past their start, several passes at one level.
# A contour that is run past its start crosses its own beginning. Where it does so at an outside corner both tails lie in the
# air beside the part: a tool that cuts across a tail cuts nothing. Where it does so at an inside corner and runs on, it enters
# the part. And a place of a wall does not stand if what is behind it is cut away beside another wall that faces the
# same way, the
# next pass of a roughing, say, which leaves the last one by a loop and comes back through it, or was cut away before.

ENDS = 1e-6  # mm: a crossing so near to an end of an element is its joint
ALONG = 1e-6  # rad: elements that meet at a smaller angle touch
BEHIND = 1e-3  # mm behind a wall: there its material begins
MOST = 400  # places along a wall
ENOUGH = 64  # pairs that cut into what stands: of such a contour the later ones are not asked, they count as well
TAIL = 4  # tool radii from a crossing: a tail stands for nothing there


def cuts(found: Equidistant, i: Index, j: Index, allowed: Array) -> Mask:
    """Whether the tool on its way beside elements i (m,), and about their ends, comes nearer to walls j (m,) than its
    radius less what is `allowed` (m,)."""
    el, result = found.el, np.zeros(len(i), dtype=bool)
    there = np.flatnonzero((found.left_over[i] > 0) & ~found.apart[i])
    result[there] = gap(found.rows(i[there]), el.curves(j[there])) < (el.R[i] - allowed)[there]
    for after in (i, np.minimum(i + 1, len(el.rows) - 1)):  # the arcs about the start and the end of an element
        k = np.flatnonzero(found.insert[after] & ~result)
        result[k] = gap(found.arcs(after[k]), el.curves(j[k])) < el.R[i[k]] - allowed[k]
    return result


def run_past(el: Elements, i: Index, j: Index) -> Mask:
    """Whether elements i and j (m,) cross, or touch with an end, as at an outside corner from the later to the earlier."""
    return np.logical_or.reduce([there for _, there in _outside(el, i, j)])


def standing(el: Elements, i: Index, j: Index) -> tuple[Array, Array]:
    """The shares (m,) at which walls j begin and end to stand, where they cross elements i (m,) as at an outside corner."""
    begin, end = np.zeros(len(j)), np.ones(len(j))
    for p, there in _outside(el, i, j):
        at = share(p, el.curves(j))
        begin, end = np.where(there & (j < i), np.maximum(begin, at), begin), np.where(there & (j > i), np.minimum(end, at), end)
    return begin, end


def _outside(el: Elements, i: Index, j: Index) -> Iterator[tuple[Array, Mask]]:
    """Common points (m, 2) of elements i and j (m,), and where they are outside corners from the later to the earlier."""
    first, last = np.minimum(i, j), np.maximum(i, j)
    one, two = el.curves(first), el.curves(last)
    for p in crossings(one, two):
        turn = cross(_tangent(two, p), _tangent(one, p))
        with np.errstate(invalid="ignore"):
            joint = (last == first + 1) & (np.hypot(*(p - el.end[first]).T) < ENDS)
            yield p, np.isfinite(p[:, 0]) & ~joint & (el.s[first] * turn < -ALONG)


def crossed(el: Elements, contour: Index, k: Index) -> tuple[Index, Index]:
    """Of walls k (m,) those first < last of a contour that cross as at an inside corner from the last to the first and run on.
    Not on a retracted way, with a lift before it and a plunge after it: what it crosses is in the air."""
    k, found = k[~retracted(el, contour)[k]] if len(k) else k, []
    if not len(k):
        return k, k
    for one, two in near(*el.boxes(k, contour), 0.0):
        a, b = np.minimum(k[one], k[two]), np.maximum(k[one], k[two])
        apart = (b > a + 1) & (contour[a] == contour[b])
        a, b = a[apart], b[apart]
        bad = _run_on_inside(el, a, b) & meet(el, a, b)
        found.append((a[bad], b[bad]))
    first, last = (np.concatenate([pair[which] for pair in found] or [k[:0]]) for which in (0, 1))
    return first, last


def _run_on_inside(el: Elements, a: Index, b: Index) -> Mask:
    one, two = el.curves(a), el.curves(b)
    result = np.zeros(len(a), dtype=bool)
    for p in crossings(one, two):
        with np.errstate(invalid="ignore"):
            at_one, at_two = share(p, one), share(p, two)
            to_one, to_two = at_one * el.length(a) > ENDS, at_two * el.length(b) > ENDS
            on_one, on_two = (1 - at_one) * el.length(a) > ENDS, (1 - at_two) * el.length(b) > ENDS
            inside = el.s[a] * cross(_tangent(two, p), _tangent(one, p)) > ALONG
            result |= np.isfinite(p[:, 0]) & inside & to_two & on_one & (to_one | on_two)
    return result


def given_up(found: Equidistant, contour: Index, i: Index, j: Index) -> Mask:
    """Whether the tool beside one of walls i and j (m,) cuts only into places of the other one that do not stand.

    Where the two cross each other, the tail of one of them stands for nothing within `TAIL` radii if the other is
    given up.
    """
    el, result = found.el, np.zeros(len(i), dtype=bool)
    if not len(i):
        return result
    walls = np.flatnonzero(el.wall & np.isin(contour, contour[i]) & (found.left_over > 0))
    if not len(walls):
        return result
    low, high = el.boxes(walls, np.zeros(len(el.rows), dtype=np.int64))
    known: dict[tuple[int, int], bool] = {}
    standing = 0
    for m in np.lexsort((np.minimum(i, j), np.maximum(i, j))).tolist():
        a, b = int(i[m]), int(j[m])
        pair = min(a, b), max(a, b)
        if pair not in known:
            reach = 2 * el.R[a]
            lowest, highest = el.boxes(np.array(pair), np.zeros(len(el.rows), dtype=np.int64))
            there = ((low <= highest.max(axis=0) + reach) & (high >= lowest.min(axis=0) - reach)).all(axis=1)
            k = walls[there & (contour[walls] == contour[a])]
            k = k[(k != a) & (k != b)]
            k = k[meet(el, np.full(len(k), a), k) | meet(el, np.full(len(k), b), k)]
            known[pair] = _given_up(found, k, *pair)
            standing += not known[pair]
        result[m] = known[pair]
        if standing >= ENOUGH:
            break
    return result


def _given_up(found: Equidistant, k: Index, first: int, last: int) -> bool:
    """Whether walls k (n,) cut away what stands behind the places of two walls in which the tool beside the other cuts."""
    el, standing = found.el, []
    for wall, other in ((first, last), (last, first)):
        p, normal = _places(el, wall)
        cut = distance(p, found.rows(np.full(len(p), other))) < el.R[wall] - CLEAR
        p, normal = p[cut], normal[cut]
        standing.append(p[_stands(found, k, k < first, p - BEHIND * normal, normal)])
        if not len(p):
            return False
    if not any(len(p) for p in standing):
        return True
    if all(len(p) for p in standing):
        return False
    still = np.concatenate(standing)
    away = np.full(len(still), np.inf)
    for p in crossings(el.curves(np.array([first])), el.curves(np.array([last]))):
        away = np.fmin(away, np.hypot(*(still - p).T))
    return bool((away < TAIL * el.R[first]).all())


def _places(el: Elements, k: int) -> tuple[Array, Array]:
    """Points (m, 2) along a wall, a quarter of the radius apart if it is not too long, and normals to the tool there."""
    length = float(el.length(np.array([k]))[0])
    m = int(np.clip(4 * length / el.R[k], 8, MOST)) + 1 if el.R[k] > 0 else MOST + 1
    wall = el.curves(np.full(m, k))
    p = part(wall, np.zeros(m), np.linspace(0, 1, m)).end
    return p, normals(el, np.full(m, k), p)


def _stands(found: Equidistant, k: Index, earlier: Mask, p: Array, normal: Array) -> Mask:
    """Which points p (m, 2) no tool beside one of walls k (n,) sweeps that is `earlier` (n,) or faces as `normal` (m, 2)."""
    el, stands = found.el, np.ones(len(p), dtype=bool)
    if not len(p) or not len(k):
        return stands
    size = len(k)
    wall, q = np.repeat(k, len(p)), np.tile(p, (size, 1))
    along = _tangent(el.curves(wall), q)
    faces = np.repeat(earlier, len(p)) | (el.s[wall] * dot(left(along), np.tile(normal, (size, 1))) > 0)
    swept = faces & (distance(q, found.rows(wall)) < el.R[wall])
    return np.asarray(~swept.reshape(size, len(p)).any(axis=0))


def normals(el: Elements, k: Index, p: Array) -> Array:
    """Unit normals (m, 2) to the tool of elements k (m,) beside points p (m, 2)."""
    return np.asarray(el.s[k, None] * left(_tangent(el.curves(k), p)))


def _tangent(curve: Curves, p: Array) -> Array:
    """Unit tangents (n, 2) of curves at points p (n, 2) on them."""
    travel, spoke = curve.end - curve.start, p - curve.centre
    along = np.where(curve.arc[:, None], np.sign(curve.sweep)[:, None] * left(spoke), travel)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(along / np.hypot(along[:, 0], along[:, 1])[:, None])


# The open ends of a contour, where the tool arrives and leaves.
# Where it stands there, and where it rolls onto the contour or off it, all other walls must be clear; and the end
# itself, beyond
# which no wall goes on that could face another one, must be clear of the tool wherever else it cuts.

CLOSED = 1e-3  # mm between the end of an element and a wall to which the contour comes back
SMOOTH = np.cos(np.radians(1))  # of tangents: elements that go on smoothly
ALIKE = np.cos(np.radians(45))  # of normals: such walls face the same way


def arrivals(found: Equidistant, contour: Index, k: Index, walls: Walls, coarse: Chunks) -> list[Places]:
    """Where the tool arrives at the first wall of a contour, and where it leaves the last, other walls must be clear."""
    el = found.el
    slack, places = misfit(el), []
    last = np.append(~walls.joined[1:], True)
    for edge, at_end in ((~walls.joined, False), (last, True)):
        for e in np.flatnonzero(edge):  # two for a contour
            P, normal = (el.end[k[e]], walls.n_out[e]) if at_end else (el.start[k[e]], walls.n_in[e])
            R = el.R[k[e]]
            group = around(coarse, P + R * normal, R, len(k))
            group = group[(walls.group[group] == walls.group[e]) & (group != e)]
            height = el.to_height[k[e]] if at_end else el.from_height[k[e]]
            group = group[at_height(el, float(height), k[group])]
            if not len(group):
                continue
            around_it, allowed = walls.curves.take(group), EXACT + slack[k[e]] + slack[k[group]]

            def clear(
                which: Index, radius: Array, c: Curves = around_it, P: Array = P, normal: Array = normal
            ) -> Array:
                return distance(P + radius[:, None] * normal, c.take(which)) - radius

            bad = np.flatnonzero(clear(np.arange(len(group)), np.full(len(group), R)) < -allowed)
            one, other = np.full(len(bad), k[e]), k[group[bad]]
            bad = bad[~run_past(el, one, other) & ~given_up(found, contour, one, other)]
            if not len(bad):
                continue
            room = -allowed[bad]
            largest = narrowed(lambda m, radius: clear(bad[m], radius) >= room[m], np.full(len(bad), R))  # noqa: B023
            worst = [int(np.argmin(largest))]
            width = R + clear(bad[worst], np.array([R]))
            verb = "leaves" if at_end else "arrives at"
            text = f"where the tool of radius {{R:.4g}} {verb} the contour, the element of line {{other}} is {{r:.6g}} mm away"
            places.append(Places("end", k[[e]], k[group[bad[worst]]], width, R - width, largest[worst], text))
    return places


def cut_off(found: Equidistant, contour: Index, k: Index, walls: Walls, coarse: Chunks) -> list[Places]:
    """Where a contour begins and ends the tool beside its other walls must be clear of the point.

    Not of one that is over the part, or that the next pass of a roughing takes away; nor of an arc that leads smoothly onto the
    wall or off it, and of what lies before the place where a contour closes: these are ways of the tool, no walls.
    """
    el, slack = found.el, misfit(found.el)
    first, last = np.flatnonzero(~walls.joined), np.flatnonzero(np.append(~walls.joined[1:], True))
    onto, off = (el.arc[k[one]] & _smooth(el, k[one] - back) for one, back in ((first, 0), (last, 1)))
    first, last = first[~onto], last[~off]
    e, n = k[np.concatenate([first, last])], len(first)
    P, normal = np.concatenate([el.start[e[:n]], el.end[e[n:]]]), np.concatenate([walls.n_in[first], walls.n_out[last]])
    height = np.concatenate([el.from_height[e[:n]], el.to_height[e[n:]]])
    if not len(e):
        return []
    reach = 2 * el.R[e]
    if (found.rule == Rule.OUTSIDE_STRAIGHT).any():
        reach = el.R[e] + np.hypot(*(found.end[k] - el.end[k]).T).max()
    near = [k[around(coarse, *place, len(k))] for place in zip(P, reach, strict=True)]
    near = [w[(contour[w] == contour[one]) & at_height(el, float(z), w)] for one, z, w in zip(e, height, near, strict=True)]
    at, row = (np.tile(column, 2) for column in (np.repeat(np.arange(len(e)), [len(w) for w in near]), np.concatenate(near)))
    corner = np.repeat([False, True], len(row) // 2)
    there = np.where(corner, np.append(el.wall[1:], False)[row], row != e[at])
    at, own, look = at[there], e[at[there]], neighbours.Pairs(row, corner, e[at], np.full(len(row), np.inf)).take(there)

    def clear(which: Index, radius: Array) -> Array:
        curve, is_there = neighbours.rows(el, look.take(which), radius, found.rules)
        return np.where(is_there, distance(P[at[which]], curve) - radius, np.inf)

    inner = np.concatenate([el.end[e[:n]], el.start[e[n:]]])[at]
    closes = (np.abs(look.k - own) > 1) & (distance(inner, el.curves(look.k)) < CLOSED)
    allowed = CLEAR / 2 + slack[look.k] + slack[own]
    bad = np.flatnonzero((clear(np.arange(len(own)), el.R[own]) < -allowed) & ~closes)
    faces = np.where(look.corner[bad, None], unit_of(P[at[bad]] - el.end[look.k[bad]]), normals(el, look.k[bad], P[at[bad]]))
    away = run_past(el, look.k[bad], own[bad]) | (dot(faces, normal[at[bad]]) > ALIKE)
    bad = bad[~np.isin(at[bad], at[bad[away]])]
    bad = bad[~given_up(found, contour, look.k[bad], own[bad])]
    if not len(bad):
        return []
    R = el.R[own[bad]]
    width = R + clear(bad, R)
    largest = narrowed(lambda m, radius: clear(bad[m], radius) >= -allowed[bad[m]], R, parts=4)
    text = "the tool of radius {R:.4g} beside this element cuts into the end of that of line {other}, {r:.6g} mm from its centre"
    return [Places("end", look.k[bad], own[bad], width, R - width, largest, text)]


def _smooth(el: Elements, k: Index) -> Mask:
    """Whether elements k (m,) go on smoothly into the next ones, walls both."""
    after = np.minimum(k + 1, len(el.rows) - 1)
    return np.asarray(el.wall[k] & el.wall[after] & (dot(el.t_out[k], el.t_in[after]) > SMOOTH))


def rolled(found: Equidistant, contour: Index, k: Index, coarse: Chunks) -> list[Places]:
    """Arcs by which the tool rolls onto the first wall of a contour, or off the last, into walls k of the contour."""
    el, rules, slack, places = found.el, found.rules, misfit(found.el), []
    c = np.flatnonzero(found.insert[1:] & (el.lead[:-1] | el.exit[1:]))
    near = [k[around(coarse, el.end[one], 2 * float(el.R[one]), len(k))] for one in c]
    here = zip(c, near, strict=True)
    near = [w[(contour[w] == contour[one]) & at_height(el, float(el.from_height[one + 1]), w)] for one, w in here]
    if not near:
        return []
    every, wall = np.repeat(c, [len(w) for w in near]), np.concatenate(near)
    for kind, step in (("entry", 1), ("exit", 0)):
        of = el.lead[every] == bool(step)
        at, w = every[of], wall[of]
        own = at + step  # the wall at the lead
        look, R = neighbours.Pairs(at, np.ones(len(at), dtype=bool), w, np.full(len(at), np.inf)), el.R[at]
        begin, end = standing(el, own, w)

        def clear(which: Index, radius: Array, look: neighbours.Pairs = look, begin: Array = begin, end: Array = end) -> Array:
            curve, is_there = neighbours.rows(el, look.take(which), radius, rules)
            wall = part(el.curves(look.wall[which]), begin[which], end[which])
            return np.where(is_there & (begin < end)[which], gap(curve, wall) - radius, np.inf)

        room = -CLEAR / 2 - slack[own] - slack[w]
        bad = np.flatnonzero(clear(np.arange(len(at)), R) < room)
        bad = bad[~given_up(found, contour, own[bad], w[bad]) | (own == w)[bad]]
        if not len(bad):
            continue
        width = R[bad] + clear(bad, R[bad])
        largest = narrowed(lambda m, radius: clear(bad[m], radius) >= room[bad[m]], R[bad], parts=4)  # noqa: B023
        through = "the contour through the element of line {other}, {r:.6g} mm from its centre"
        text = f"the tool of radius {{R:.4g}} rolls {'onto' if step else 'off'} {through}"
        hint = f"let the {kind} {'come from' if step else 'lead to'} the side of the tool"
        places.append(Places(kind, at[bad] + 1 - step, w[bad], width, R[bad] - width, largest, text, hint))
    return places

"""The open ends of a contour, where the tool arrives and leaves.

Where it stands there, and where it rolls onto the contour or off it, all other walls must be clear; and the end itself, beyond
which no wall goes on that could face another one, must be clear of the tool wherever else it cuts.
"""

from __future__ import annotations

import numpy as np

from mnclab.geometry.chords import Chunks, Walls, around
from mnclab.geometry.curves import Curves, distance, gap, part
from mnclab.geometry.vectors import dot, unit_of
from mnclab.path.columns import Array, Index, Mask
from mnclab.path.compensation import neighbours
from mnclab.path.compensation.elements import Elements
from mnclab.path.compensation.equidistant import Equidistant
from mnclab.path.compensation.heights import at_height
from mnclab.path.compensation.passes import given_up, normals, run_past, standing
from mnclab.path.compensation.places import EXACT, Places, misfit, narrowed
from mnclab.path.compensation.rules import CLEAR
from mnclab.path.kinds import Rule

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

"""Whether the tool fits: what it needs, what there is, and the largest radius for the whole contour.

Five things are looked at. An *arc* on the inside must have a greater radius than the tool; an *element* must not be
used up by its inside corners; a *bottleneck* is a pair of walls, any number of blocks apart, that face each other nearer
than the tool is wide; at the *ends* of a contour, where the tool arrives and leaves, and at the points of straight
outside *corners*, it must stand clear of all other walls, and nowhere cut off the ends themselves. An *entry* (and an
*exit*) must begin where the tool does not yet cut into the element it leads to, and where the tool rolls onto the contour
or off it, all walls must be clear. Close by along the contour, and behind a cusp, *neighbours* are measured one by one.
Everywhere a tool cuts only into what is at its `heights` and into walls that the contour leaves standing (`passes`).

Growing the tool from nothing, the first place that fails is one of these; so the largest radius is the least of their
own, each from a closed form or, for elements between two corners, from narrowing an interval on the exact condition.
"""

from __future__ import annotations

import numpy as np

from mnclab.geometry.chords import Chunks, Walls, chunks, facing, may_cross
from mnclab.geometry.curves import Curves, beside, distance, nearest, part
from mnclab.path.compensation import neighbours
from mnclab.path.compensation.elements import (
    CLEAR,
    EXACT,
    HINT,
    Compensation,
    Elements,
    Gouge,
    Places,
    Report,
    meet,
    misfit,
    narrowed,
)
from mnclab.path.compensation.ends import arrivals, crossed, cut_off, cuts, given_up, rolled, run_past
from mnclab.path.compensation.equidistant import Equidistant, ends, remaining
from mnclab.path.compensation.neighbours import near_tips, tip_clearance
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import Array, Index, Mask, PathFault, Rule, Toolpath

NO_TOOL = 0.001  # mm; below, no tool is as small
SPOTS = 101  # of a row, where it is nearest to a wall


def check(found: Equidistant, path: Toolpath, view: PlaneView, gouge: str, report: Report) -> Mask:
    """Which elements (n,) cut into the contour; the whole of it is looked at on every control. PathFault at the first that
    `gouge` refuses: "mark" none, "control" those that the control itself finds, "refuse" all."""
    el = found.el
    marked = np.zeros(len(el.rows), dtype=bool)
    contour = np.cumsum(el.lead | el.exit, dtype=np.int64)  # one number from each entry or change to the next
    own = gouge == "control" and not found.rules.look_ahead
    whole = found if found.rules.look_ahead else found.looking_ahead()
    places = _places(whole, contour)
    if not places:
        return marked
    refused = {"mark": [], "control": _places(found, contour) if own else places}.get(gouge, places)
    least = _least(whole, contour, places)
    for place in places:
        marked[place.k] = True

    def worded(among: list[Places]) -> list[tuple[int, Gouge]]:
        """Of each element the narrowest place, in their order."""
        every = [(int(k), float(one.largest[m]), n, m) for n, one in enumerate(among) for m, k in enumerate(one.k)]
        order = sorted({one[0]: one for one in sorted(every, reverse=True)}.values())
        if among is refused:
            order = order[:1]
        return [(k, _worded(among[n], m, k, found, path, view, float(least[contour[among[n].other[m]]]))) for k, _, n, m in order]

    first = worded(refused)
    if own or not first:
        report.gouges += [gouge for k, gouge in worded(places) if not first or k < first[0][0]]
    if first:
        report.gouges.append(first[0][1])
        raise PathFault(first[0][1].message, first[0][1].step, first[0][1].hint)
    return marked


def _places(found: Equidistant, contour: Index) -> list[Places]:
    places = _local(found)
    places.append(_beside(found, contour, np.concatenate([place.k for place in places])))
    if found.rules.look_ahead:
        places += [*_leads(found.el), *_global(found, contour)]
    return [place for place in places if len(place.k)]


def _least(found: Equidistant, contour: Index, places: list[Places]) -> Array:
    """The largest radius of each contour.

    With arcs at all corners what does not fit a tool does not fit a larger one. A straight corner may become an arc for
    a larger tool (R > AB), so there the radius found is tried, and what fails then counts too.
    """
    least = np.full(int(contour[-1]) + 1, np.inf)
    while places:
        before = least.copy()
        for place in places:
            np.minimum.at(least, contour[place.other], place.largest)
        settled = (np.isinf(before) == np.isinf(least)).all() and (least >= before - EXACT)[np.isfinite(least)].all()
        if settled or not (found.rule == Rule.OUTSIDE_STRAIGHT).any():
            break
        el = found.el
        found = type(found)(el._replace(R=np.minimum(el.R, least[contour])), found.rules)
        places = _places(found, contour)
    return least


def _cut(found: Equidistant, k: int, wall: int) -> Array:
    """The point (2,) of a wall that is cut deepest: nearest to row k of the tool centre, or to the arcs before and behind it.
    Of places along them the best is looked about again and again, each time closer."""
    el, at = found.el, np.arange(k, min(k + 2, len(found.el.rows)))
    at = at[found.insert[at]]  # arcs that lead to these rows
    rows = Curves(*map(np.concatenate, zip(found.arcs(at), found.rows(np.array([k])), strict=True)))
    which, share, gap = np.repeat(np.arange(len(at) + 1), SPOTS), np.tile(np.linspace(0, 1, SPOTS), len(at) + 1), 1 / SPOTS
    for _ in range(4):
        spots = part(rows.take(which), share, share).start
        best = int(np.argmin(distance(spots, el.curves(np.full(len(which), wall)))))
        spot, which, gap = spots[best], np.full(SPOTS, which[best]), 2 * gap / SPOTS
        share = (share[best] + gap * (np.arange(SPOTS) - SPOTS // 2)).clip(0, 1)
    return nearest(spot[None], el.curves(np.array([wall])))[0]


def _worded(
    place: Places, m: int, k: int, found: Equidistant, path: Toolpath, view: PlaneView, largest: float
) -> Gouge:  # fmt: skip
    el = found.el
    row, other, R = int(el.rows[k]), int(el.rows[place.other[m]]), float(el.R[k] or el.R[k - 1])
    width, missing = float(place.width[m]), float(place.missing[m])
    text = place.message.format(R=R, r=width, other=int(path.line[other]))
    fits, hint = f"the largest radius for the whole contour is {largest:.7g} mm", place.hint
    if largest < NO_TOOL:
        fits, hint = "no tool fits here", hint.removeprefix(HINT).removeprefix(", or ")
    lacks = f"{missing:.4g} mm {'is' if f'{missing:.4g}' == '1' else 'are'} missing"
    spot = _cut(found, k, int(place.other[m])) if k != place.other[m] else el.end[k]
    at = view.to_space(np.array([row]), np.array([[*spot, view.end[row, 2]]]))[0].tolist()
    return Gouge(
        place.kind, int(path.line[row]), int(path.step[row]), int(path.line[other]), (at[0], at[1], at[2]), R,
        width, missing, largest, f"{text}: {lacks}, {fits}", hint,
    )  # fmt: skip


def _local(found: Equidistant) -> list[Places]:
    """Arcs that are too small, and elements that their corners use up."""
    el = found.el
    curve = np.where(el.arc & (el.s * el.sweep > 0), el.r, np.inf)
    small = np.flatnonzero(el.wall & (curve - el.R <= EXACT))
    lost = found.apart.copy()
    lost[:-1] |= found.apart[1:]
    used_up = el.wall & (lost | ~(found.left_over > np.where(el.arc, -1e-12, -EXACT)))
    used_up[small] = False
    short, r = np.flatnonzero(used_up), el.r[small]
    text = "the inside arc of radius {r:.4g} is not greater than the tool radius {R:.4g}"
    result = [Places("arc", small, small, r, el.R[small] - r, r, text)]
    if len(short):
        largest = narrowed(lambda at, R: _fits(el, short[at], R, found.rules), el.R[short])
        per_mm = np.where(el.arc[short], el.r[short], 1.0)
        lack = -np.nan_to_num(found.left_over[short], posinf=0.0, neginf=0.0) * per_mm
        missing = np.where(lack > EXACT, lack, el.R[short] - largest)
        text = "the element is too short for the tool radius {R:.4g}: the offsets of its neighbours do not meet on it"
        hint = "take a smaller tool, or lengthen the element"
        result.append(Places("element", short, short, el.length(short), missing, largest, text, hint))
    return result


def _beside(found: Equidistant, contour: Index, lost: Index) -> Places:
    """Rows that come too near to an element close by; what is `lost` has no row."""
    el, rules = found.el, found.rules
    look = neighbours.looked_at(found, contour)
    slack = misfit(el) if len(look.k) else el.R
    room = -CLEAR / 2 - slack[look.k] - slack[look.wall]
    bad = np.flatnonzero(neighbours.clearance(el, look, el.R[look.k], rules) < room)
    bad = bad[~np.isin(look.k[bad], lost) & ~np.isin(look.wall[bad], lost)]
    look, room = look.take(bad), room[bad]
    text = "the tool of radius {R:.4g} beside this element cuts into that of line {other}, {r:.6g} mm from its centre"
    return Places("neighbour", look.k, look.wall, *_measured(el, look, room, rules), text)


def _measured(el: Elements, look: neighbours.Pairs, room: Array, rules: Compensation) -> tuple[Array, Array, Array]:
    """Of pairs that must be `room` (m,) apart the width that is there, what is missing, and the largest radius."""
    R = el.R[look.k]

    def clear(which: Index, radius: Array) -> Mask:
        return neighbours.clearance(el, look.take(which), radius, rules) >= room[which]

    width = R + neighbours.clearance(el, look, R, rules)
    return width, R - width, narrowed(clear, R, parts=4)


def _fits(el: Elements, k: Index, radius: Array, rules: Compensation) -> Mask:
    """Whether the corners of elements k (m,) leave something of them, for a radius each."""
    begin, end, apart = ends(el, k, radius, rules)
    left_over, _ = remaining(el, k, begin, end, radius)
    return ~apart & (left_over >= 0)


def _leads(el: Elements) -> list[Places]:
    """Where the tool stands before it enters and after it left, it must be clear of the end of the contour."""
    n, result = len(el.rows), []
    for kind, leads, step in (("entry", el.entry, 1), ("exit", el.exit, -1)):
        k = np.flatnonzero(leads)
        k = k[(k + step >= 0) & (k + step < n)]
        k = k[el.wall[k + step]]
        R, width = el.R[k + step], np.hypot(*(el.end[k] - el.start[k]).T)
        bad = (width < R - EXACT) & meet(el, k, k + step)
        verb = "begins" if step > 0 else "ends"
        text = (
            f"the {kind} {verb} {{r:.4g}} mm from the contour, where the tool of radius {{R:.4g}} cuts into it already"
        )
        hint = f"take a smaller tool, or let the {kind} {verb[:-1]} farther away"
        where = (k[bad], k[bad] + step, width[bad], (R - width)[bad], width[bad])
        result.append(Places(kind, *where, text, hint))
    return result


def _global(found: Equidistant, contour: Index) -> list[Places]:
    el = found.el
    k = np.flatnonzero(el.wall)
    if not len(k):
        return []
    run = slice(int(k[0]), int(k[-1]) + 1) if k[-1] - k[0] + 1 == len(k) else k  # without a copy where possible
    s, group = el.s[run], contour[run]
    joined = np.concatenate([[False], group[1:] == group[:-1]])
    n_in = beside(np.zeros((1, 2)), el.t_in[run], s)
    n_out = beside(np.zeros((1, 2)), el.t_out[run], s) if el.arc.any() else n_in
    walls = Walls(el.curves(run), n_in, n_out, joined, s, group)
    coarse = chunks(walls)
    facing_and_crossed = [_bottlenecks(found, contour, k, walls, coarse), _crossed(found, contour, k[may_cross(walls, coarse)])]
    leads = [*arrivals(found, contour, k, walls, coarse), *rolled(found, contour, k, coarse)]
    return [*facing_and_crossed, *leads, *cut_off(found, contour, k, walls, coarse), *_tips(found, contour)]


def _bottlenecks(found: Equidistant, contour: Index, k: Index, walls: Walls, coarse: Chunks) -> Places:
    """Walls that face each other nearer than the tool is wide; the largest radius is half of what there is."""
    el = found.el
    chords = facing(walls, 2 * el.R[k], coarse)
    if not len(chords.i):
        return Places("bottleneck", k[:0], k[:0], el.R[:0], el.R[:0], el.R[:0], "")
    i, j, slack = k[chords.i], k[chords.j], misfit(el)
    bad = (chords.length < 2 * el.R[i] - EXACT - slack[i] - slack[j]) & meet(el, i, j)
    bad[bad] = ~run_past(el, i[bad], j[bad])
    allowed = CLEAR + slack[i[bad]] + slack[j[bad]]
    bad[bad] = cuts(found, i[bad], j[bad], allowed) | cuts(found, j[bad], i[bad], allowed)  # and does not only pass by
    bad[bad] = ~given_up(found, contour, i[bad], j[bad])
    i, j, width = i[bad], j[bad], chords.length[bad]
    text = "the tool of radius {R:.4g} does not fit between this element and that of line {other}: they are {r:.6g} mm apart"
    return Places("bottleneck", i, j, width, 2 * el.R[i] - width, width / 2, text)


def _crossed(found: Equidistant, contour: Index, k: Index) -> Places:
    """Of walls k (m,) those that lead the tool through another one that stands."""
    first, last = crossed(found.el, contour, k)
    bad = ~given_up(found, contour, first, last)
    first, last = first[bad], last[bad]
    none, R = np.zeros(len(first)), found.el.R[last]
    text = "beside this element the tool of radius {R:.4g} goes through that of line {other}, which the contour crosses"
    return Places("bottleneck", last, first, none, R, none, text, "end the contour where it meets itself")


def _tips(found: Equidistant, contour: Index) -> list[Places]:
    """Straight corners that reach into another wall."""
    el, rules = found.el, found.rules
    if not (found.rule == Rule.OUTSIDE_STRAIGHT).any():
        return []
    c, w = near_tips(found, contour)
    same = meet(el, c, w)
    c, w = c[same], w[same]
    if not len(c):
        return []
    lack = -tip_clearance(el, c, w, el.R[c], rules)
    bad = lack > EXACT + misfit(el)[w]
    c, w, lack = c[bad], w[bad], lack[bad]
    largest = narrowed(lambda at, R: tip_clearance(el, c[at], w[at], R, rules) >= 0, el.R[c])
    text = "the straight corner after this element leads the tool of radius {R:.4g} into the element of line {other}"
    return [Places("corner", c, w, el.R[c] - lack, lack, largest, text, "take a smaller tool, or G160")]

"""The pass: a programmed contour becomes the path of the tool centre.

Ends of rows are moved to the equidistant, arcs inserted about outside corners.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.geometry.curves import beside, cross, dot
from mnclab.path.compensation.elements import CLEAR, CORNER, SPIKE_TURN, TANGENT, Compensation, Elements, Report
from mnclab.path.compensation.equidistant import Equidistant
from mnclab.path.compensation.fit import check
from mnclab.path.corners import Open
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import Array, Index, Kind, Mask, PathFault, Rule, Toolpath, gathered


def apply(
    path: Toolpath, rules: Compensation | None, unfinished: bool = False, gouge: str = "refuse", report: Report | None = None
) -> Toolpath:  # fmt: skip
    """The path of the tool centre; the path itself where nothing is compensated. Raises PathFault.

    `unfinished`: the program broke off, so the end of the last compensated row is unknown and the row is left out.
    `gouge` says what happens where the tool does not fit: "refuse" raises, "mark" cuts anyway, marks the rows in the
    column `gouge` and adds to `report`, where remarks go as well.
    """
    if rules is None or not (path.side != 0).any():
        return path
    view = PlaneView(path)
    rows = np.flatnonzero(view.moves)
    el = Elements.of(path, view, rows)
    if unfinished and len(rows) and el.on[-1]:
        return apply(path[: rows[-1]], rules, False, gouge, report) if rows[-1] else path[:0]
    if not el.on.any():
        return path
    report = Report() if report is None else report
    _check_leads(path, el, rules)
    _check_first_move(path, el, rules)
    _check_open(path, el)
    found = Equidistant(el, rules)
    _check_entries(path, found)
    _check_stops(path, found)
    marked = check(found, path, view, gouge, report)
    _notice_spikes(path, found, report)
    _notice_again(path, el, report)
    _notice_let_go(path, el, rules, report)
    return _tool_centre_path(path, view, found, marked)


def _check_leads(path: Toolpath, el: Elements, rules: Compensation) -> None:
    """Entry, exit and change of side are straight lines."""
    kind = path.kind[el.rows]
    bent = (kind != Kind.LINE) & ~(rules.rapid & (kind == Kind.RAPID))
    for bad, message, hint in (
        (el.entry & bent & ~(rules.arc_entry & el.arc), "radius compensation begins only in a straight line at feed",
         "write the entry as a linear move, then the contour"),
        (el.entry & el.arc & (el.s * el.sweep > 0) & (el.r <= el.R), "the tool is not smaller than the arc of the entry", ""),
        (el.exit & bent, "radius compensation ends only in a straight line at feed", ""),
        (el.change & (not rules.change), "the side of the compensation cannot change from one element to the next",
         "write a straight line without compensation between them"),
        (el.change & bent, "the side of the compensation changes only in a straight line at feed",
         "write a linear move that leads to the other side"),
    ):  # fmt: skip
        if bad.any():
            raise PathFault(message, int(path.step[el.rows[int(np.argmax(bad))]]), hint)


def _check_entries(path: Toolpath, found: Equidistant) -> None:
    """The line of an entry that ends on the next offset must be long enough for it."""
    el = found.el
    k = np.flatnonzero(el.entry & ~el.arc) if found.rules.straight_exit else np.arange(0)
    back = dot(beside(el.end[k], el.t_out[k], el.R[k] * el.s[k]) - el.start[k], found.end[k] - el.start[k]) < 0
    if back.any():
        message = "the inside corner behind the entry leaves nothing of its line"
        raise PathFault(message, int(path.step[el.rows[k[int(np.argmax(back))]]]), "take a smaller tool or a longer entry")


def _check_first_move(path: Toolpath, el: Elements, rules: Compensation) -> None:
    """Where an entry may end on the next offset its first move leads farther in the plane than the tool's radius."""
    if not rules.straight_exit:
        return
    on = path.is_motion & (path.side != 0)
    begins = on & ~np.concatenate([[False], on[:-1]])
    length = np.zeros(len(path))
    length[el.rows] = el.length(slice(None))
    short = np.flatnonzero(begins & (path.radius != 0) & (length <= np.abs(path.radius)))
    for row in short[np.isin(short, el.rows[el.entry]) | ~np.isin(short, el.rows)]:
        message = "the first move of the compensation is not longer than the tool radius"
        raise PathFault(message, int(path.step[row]), "write a longer entry, in the plane")


def _check_stops(path: Toolpath, found: Equidistant) -> None:
    """LinuxCNC ends an element before a program stop as if no corner followed: at an inside one it would cut into the next."""
    el = found.el
    if not found.rules.straight_exit or not (path.kind == Kind.STOP).any():
        return
    stops = np.concatenate([[0], np.cumsum(path.kind == Kind.STOP)])
    k = np.flatnonzero((found.rule[:-1] == Rule.INSIDE) & el.wall[:-1])
    k = k[stops[el.rows[k + 1]] > stops[el.rows[k]]]
    if len(k):
        message = "the program stops at an inside corner: LinuxCNC leads the tool past it first, into the next element"
        raise PathFault(message, int(path.step[el.rows[k[0]]]), "write the stop where the contour goes straight on or outside")


def _check_open(path: Toolpath, el: Elements) -> None:
    """Behind an open end the contour is over, or goes on without a corner."""
    open_ends = np.array([*(isinstance(joint, Open) for joint in path.joints), False])
    if not open_ends.any():
        return
    k = np.flatnonzero(open_ends[path.joint[el.rows[:-1]]] & el.on[:-1] & el.on[1:])
    t1, t2 = el.t_out[k], el.t_in[k + 1]
    bent = k[(np.abs(cross(t1, t2)) >= np.sin(TANGENT)) | (dot(t1, t2) < 0)]
    if len(bent):
        message = "an open corner is not built where the compensated contour goes on behind it at an angle"
        hint = "no manual says how the tool goes from one element to the next; write R0 in the block after it"
        raise PathFault(message, int(path.step[el.rows[bent[0]]]), hint)


def _notice_spikes(path: Toolpath, found: Equidistant, report: Report) -> None:
    """Straight corners that reach far out."""
    el = found.el
    straight = found.rule[:-1] == Rule.OUTSIDE_STRAIGHT
    for k in np.flatnonzero(straight & (np.abs(found.turn[1:]) > SPIKE_TURN)):
        angle, reach = 180 - np.degrees(abs(found.turn[k + 1])), float(np.hypot(*(found.end[k] - el.end[k])))
        message = f"the straight corner of {angle:.3g} degrees reaches {reach:.4g} mm out"
        report.notices.append(PathFault(message, int(path.step[el.rows[k + 1]]), "G162 makes an arc at acute corners"))


def _notice_again(path: Toolpath, el: Elements, report: Report) -> None:
    """Compensation that was switched off and on again where the tool moves along the normal alone: nothing leads away."""
    off = np.concatenate([[0], np.cumsum(path.side == 0)])
    k = np.flatnonzero(el.on[:-1] & el.on[1:])
    for row in el.rows[k[off[el.rows[k + 1]] > off[el.rows[k] + 1]] + 1]:
        message = "the compensation that was switched off before this move is on again, and no move in the plane led away"
        report.notices.append(PathFault(message, int(path.step[row]), "write a move in the plane behind G40 or R0"))


def _tool_centre_path(path: Toolpath, view: PlaneView, found: Equidistant, marked: Mask) -> Toolpath:
    """The rows of `path` along the equidistant; rows without motion in the plane stand where the one before ends."""
    el = found.el
    rows, n = el.rows, len(path)
    if len(rows) == n:
        flat, keep = found.end, ~el.on
    else:
        at = np.full(n, -1)
        at[rows] = np.arange(len(rows))
        where = np.maximum.accumulate(at)  # the last element up to each row
        flat = found.end.take(where, axis=0, mode="clip")
        keep = (where < 0) | ~el.on[where]
    if found.rules.straight_exit:
        keep |= _let_go(path, rows)
    ends = view.to_space(np.arange(n), _joined(flat, view.end[:, 2]))
    ends[keep] = path.end[keep]  # not compensated: exactly as it was

    columns = path.all_but_ends()
    columns |= {"sweep": path.sweep.copy(), "rule": np.zeros(n, np.uint8), "gouge": np.zeros(n, bool)}
    columns["sweep"][rows], columns["rule"][rows], columns["gouge"][rows] = found.sweep, found.rule, marked
    k = np.flatnonzero(el.entry & el.arc)
    if len(k):
        centre, columns["sweep"][rows[k]] = _entry_arcs(path, el, k, found.end[k])
        columns["centre"] = columns["centre"].copy()
        columns["centre"][rows[k]] = view.to_space(rows[k], _joined(centre, view.start[rows[k], 2]))
    labels = path.labels if CORNER in path.labels else (*path.labels, CORNER)
    k = np.flatnonzero(found.insert)
    if len(k):
        like, before = rows[k], rows[k - 1]
        w = view.start[like, 2]
        made: dict[str, Any] = {
            "kind": Kind.ARC,
            "centre": view.to_space(like, _joined(el.end[k - 1], w)),
            "sweep": found.turn[k],
            "label": labels.index(CORNER),
            "side": path.side[before],
            "radius": path.radius[before],
            "rule": np.where(found.apart[k], Rule.INSIDE, Rule.OUTSIDE_ARC),
            "gouge": found.apart[k],
            "joint": -1,
            "time": np.nan,
        }
        # row i of the path comes from row source[i]; the inserted ones are copies of those that they lead to
        count = np.ones(n, dtype=np.int64)
        count[like] = 2
        source = np.repeat(np.arange(n), count)
        inserted = like + np.arange(len(k))
        for name, column in columns.items():
            columns[name] = gathered(column, source)
            constant = column.strides[0] == 0
            if name in made and not (constant and np.array_equal(column[0], made[name], equal_nan=True)):
                columns[name] = np.array(columns[name], copy=constant or None)
                columns[name][inserted] = made[name]
        ends = ends.take(source, axis=0, mode="clip")
        ends[inserted] = view.to_space(like, _joined(found.begin[k], w))
    return path.through(np.concatenate([path.start[:1], ends]), columns, CORNER)


def _let_go(path: Toolpath, rows: Index) -> Mask:
    """Rows (n,) from the first motion on that follows the end of a compensation, in whatever direction."""
    n = np.arange(len(path))
    element, free = np.full(len(path), -1), np.where(path.is_motion & (path.side == 0), n, -1)
    element[rows] = rows
    return np.asarray(np.maximum.accumulate(free) > np.maximum.accumulate(element))


def _notice_let_go(path: Toolpath, el: Elements, rules: Compensation, report: Report) -> None:
    """An exit along the normal alone: the tool goes to the programmed place at once, into the wall."""
    if not rules.straight_exit:
        return
    let = _let_go(path, el.rows)
    first = np.flatnonzero(let & ~np.concatenate([[False], let[:-1]]))
    last = np.searchsorted(el.rows, first) - 1
    for row in first[(last >= 0) & el.on[last]]:
        message = "this move after the end of the compensation leads the centre of the tool onto the contour, as on LinuxCNC"
        report.notices.append(PathFault(message, int(path.step[row]), "write a move in the plane, off the contour, behind G40"))


def _entry_arcs(path: Toolpath, el: Elements, k: Index, end: Array) -> tuple[Array, Array]:
    """Centres (m, 2) and sweeps (m,) of the arcs of entries k (m,) up to where they end; an inside corner shortens them."""
    arc, sense = el.entry_arc(k, el.R[k], el.s[k]), np.sign(el.sweep[k])
    begin = el.start[k] - arc.c

    def swept(to: Array) -> Array:
        return np.asarray((sense * np.arctan2(cross(begin, to), dot(begin, to))) % (2 * np.pi))

    sweep = swept(end - arc.c)
    bad = (sweep > swept(arc.q - arc.c) + TANGENT) | (arc.r < 0) & (np.hypot(*(end - arc.q).T) > CLEAR)
    if bad.any():
        message = "the inside corner behind the entry leaves nothing of its arc"
        raise PathFault(message, int(path.step[el.rows[k[int(np.argmax(bad))]]]), "take a smaller tool or a longer entry")
    return arc.c, sense * sweep


def _joined(flat: Array, w: Array) -> Array:
    """Points (n, 3) from coordinates in the plane (n, 2) and along its normal (n,)."""
    points = np.empty((len(flat), 3))
    points[:, 0], points[:, 1], points[:, 2] = flat[:, 0], flat[:, 1], w
    return points

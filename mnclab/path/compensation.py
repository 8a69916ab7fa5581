"""The tool-centre path beside a programmed contour.

With R the tool radius, s = +1 to the left of the travel and -1 to the right, t the unit tangent and
n(t) = s (-t_v, t_u) the normal towards the tool, a corner P between two elements turns by tau; s tau < 0 is an outside
corner. The offsets end at A1 = P + R n1 and begin at A2 = P + R n2; an outside corner is closed by an arc about P, an
inside corner is cut where the offsets meet. Everything is done for all corners at once.

Here: lines and arcs, entry and exit by a straight line, outside corners by an arc (MNC: G160). Other corner rules, a
change of side on the way are refused. Every element is looked at with its neighbours; what comes near from farther
along the contour is not seen yet.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.offsets import Element, cross, dot, left, meet
from mnclab.path.fault import PathFault
from mnclab.path.kinds import Kind
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import COLUMNS, Toolpath

TANGENT = np.radians(0.001)  # corners that turn less are none (setting tangent_tolerance of the MNC)
CORNER = "outside corner"
ROUND = 0  # column corner_rule: an arc about the corner


@dataclass(frozen=True)
class Compensation:
    """How a control enters and leaves the equidistant.

    "perpendicular": the entry ends, and the exit begins, square to the contour. "corner": outside, the first and last
    corners are built like any other (MNC tables 7.1 and 7.3). ``rapid``: entry and exit may run at rapid.
    """

    approach: str = "perpendicular"
    rapid: bool = False


def apply(path: Toolpath, rules: Compensation | None, unfinished: bool = False) -> Toolpath:
    """The path of the tool centre; the path itself where nothing is compensated. Raises PathFault.

    ``unfinished``: the program broke off, so the end of the last compensated row is unknown and the row is left out.
    """
    if rules is None or not (path.side != 0).any():
        return path
    view = PlaneView(path)
    rows = np.flatnonzero(view.moves)
    on = (path.side[rows] != 0) & (path.radius[rows] != 0)
    if unfinished and len(rows) and on[-1]:
        return apply(path[: rows[-1]], rules) if rows[-1] else path[:0]
    if not on.any():
        return path
    equidistant = _Equidistant(path, view, rows, on)
    equidistant.check_entries(rules)
    equidistant.close_corners(rules)
    equidistant.check_elements()
    return equidistant.result()


class _Equidistant:
    """All rows that move in the plane, ``rows`` (k,), and which of them are compensated, ``on`` (k,)."""

    def __init__(self, path: Toolpath, view: PlaneView, rows: NDArray[np.int64], on: NDArray[np.bool_]) -> None:
        self.path, self.view, self.rows, self.on = path, view, rows, on
        signed = path.side[rows] * path.radius[rows]  # a negative radius is the other side
        self.s, self.R = np.where(on, np.sign(signed), 0.0), np.where(on, np.abs(signed), 0.0)
        before, after = np.concatenate([[False], on[:-1]]), np.concatenate([on[1:], [False]])
        self.entry, self.exit = on & ~before, before & ~on
        self.last = on & ~after
        self.arc, self.centre, self.sweep = view.arc[rows], view.centre[rows], view.sweep[rows]
        self.t_in, self.t_out = view.tangent_start[rows], view.tangent_end[rows]
        self.P = view.end[rows, :2]
        g = np.sign(self.sweep)
        self.r = view.radius[rows] - self.s * g * self.R
        self.begin, self.end = view.start[rows, :2].copy(), view.end[rows, :2].copy()
        self.insert = np.zeros(len(rows), dtype=bool)  # an arc before this row
        self.turn = np.zeros(len(rows))

    def fault(self, bad: NDArray[np.bool_], message: str, hint: str = "") -> None:
        """Raise for the first bad row, with R filled in."""
        if bad.any():
            k = int(np.flatnonzero(bad)[0])
            raise PathFault(
                message.format(R=self.R[k], r=self.view.radius[self.rows[k]]), int(self.path.step[self.rows[k]]), hint
            )

    def check_entries(self, rules: Compensation) -> None:
        kind = self.path.kind[self.rows]
        straight = (kind == Kind.LINE) | (rules.rapid & (kind == Kind.RAPID))
        self.fault(
            self.entry & ~straight,
            "radius compensation begins only in a straight line at feed",
            "write the entry as a linear move, then the contour",
        )
        self.fault(self.exit & ~straight, "radius compensation ends only in a straight line at feed")
        changed = self.on[1:] & self.on[:-1] & (self.s[1:] != self.s[:-1])
        self.fault(np.concatenate([[False], changed]), "a change of the compensation side on the way is not built yet")

    def close_corners(self, rules: Compensation) -> None:
        if len(self.rows) > 1:
            self.fit_corners(rules)
        # a contour that ends without an exit: the tool stands square to its end
        open_end = self.last & np.concatenate([~self.exit[1:], [True]])
        self.end[open_end] = (self.P + self.R[:, None] * self.s[:, None] * left(self.t_out))[open_end]

    def fit_corners(self, rules: Compensation) -> None:
        """Corner k lies between element k and element k + 1."""
        first, second = slice(None, -1), slice(1, None)
        s = np.where(self.on[first], self.s[first], self.s[second])
        R = np.where(self.on[first], self.R[first], self.R[second])
        P, t1, t2 = self.P[first], self.t_out[first], self.t_in[second]
        A1, A2 = P + (R * s)[:, None] * left(t1), P + (R * s)[:, None] * left(t2)
        turn = np.arctan2(cross(t1, t2), dot(t1, t2))
        reversal = np.abs(np.abs(turn) - np.pi) < TANGENT
        turn = np.where(reversal, -s * np.pi, turn)  # straight back: an outside corner of half a turn
        tangent = np.abs(turn) < TANGENT
        outside = ~tangent & (s * turn < 0)
        entry, exit_, off = self.entry[first], self.exit[second], ~self.on[first]

        rule = self.path.corner_rule[self.rows][second]
        other = outside & ~off & (rule != ROUND)
        self.fault(
            np.concatenate([[False], other]), "outside corners other than arcs are not built yet", "use arcs (G160)"
        )

        rounded = outside & ~off
        if rules.approach == "perpendicular":
            rounded &= ~entry & ~exit_
        inside = ~tangent & ~outside & ~off & ~entry & ~exit_
        E, S = A1.copy(), A2.copy()
        square = entry & ~rounded  # the entry leads straight to A2
        E[square] = A2[square]
        S[exit_ & ~rounded] = A1[exit_ & ~rounded]
        if inside.any():
            k = np.flatnonzero(inside)
            E[k] = S[k] = meet(self.offset(k, True), self.offset(k + 1, False), P[k])
        self.end[first] = np.where(off[:, None], self.end[first], E)
        self.begin[second] = np.where(off[:, None], self.begin[second], S)
        self.insert[second] = rounded
        self.turn[second] = turn

    def offset(self, k: NDArray[np.int64], at_end: bool) -> Element:
        """The offsets of elements k, seen from their end or their start."""
        t = self.t_out[k] if at_end else self.t_in[k]
        p = self.view.end[self.rows[k], :2] if at_end else self.view.start[self.rows[k], :2]
        return Element(p + (self.R * self.s)[k, None] * left(t), t, self.centre[k], self.r[k])

    def check_elements(self) -> None:
        """Every compensated element must keep its direction and its sense."""
        contour = self.on & ~self.entry
        small = contour & self.arc & (self.r <= 1e-9)
        self.fault(
            small,
            "the inside arc of radius {r:.4g} is not greater than the tool radius {R:.4g}",
            "take a smaller tool",
        )
        lost = contour & ~(np.isfinite(self.begin).all(axis=1) & np.isfinite(self.end).all(axis=1))
        along = dot(self.end - self.begin, self.t_out)
        short = contour & ~self.arc & ~(along > -1e-9)
        a, b = self.begin - self.centre, self.end - self.centre
        a0, b0 = self.view.start[self.rows, :2] - self.centre, self.P - self.centre
        trimmed = np.arctan2(cross(a0, a), dot(a0, a)) - np.arctan2(cross(b0, b), dot(b0, b))
        left_over = self.sweep - trimmed
        self.left_over = np.where(contour & self.arc, left_over, self.sweep)
        turned = contour & self.arc & ~(left_over * np.sign(self.sweep) > -1e-12)
        self.fault(
            lost | short | turned,
            "the element is too short for the tool radius {R:.4g}: the offsets of its neighbours do not meet on it",
            "take a smaller tool, or lengthen the element",
        )

    def result(self) -> Toolpath:
        path, view, rows = self.path, self.view, self.rows
        n = len(path)
        flat = np.empty((n, 2))
        place = np.maximum.accumulate(np.where(np.isin(np.arange(n), rows), np.arange(n), -1))
        where = np.searchsorted(rows, place)
        moved = place >= 0
        flat[moved] = self.end[where[moved]]
        flat[~moved] = view.end[~moved, :2]
        ends = view.to_space(np.arange(n), np.column_stack([flat, view.end[:, 2]]))
        keep = ~moved | ~self.on[np.minimum(where, len(rows) - 1)]  # not compensated: exactly as it was
        ends[keep] = path.end[keep]

        sweep = path.sweep.copy()
        sweep[rows] = self.left_over
        columns = {name: np.asarray(getattr(path, name)) for name in COLUMNS if name not in ("start", "end")}
        columns["sweep"] = sweep
        labels = path.labels if CORNER in path.labels else (*path.labels, CORNER)
        k = np.flatnonzero(self.insert)
        like = rows[k]
        if len(k):
            w = view.start[like, 2]
            corner_ends = view.to_space(like, np.column_stack([self.begin[k], w]))
            corner_centres = view.to_space(like, np.column_stack([self.P[k - 1], w]))
            made = {name: column[like] for name, column in columns.items()}
            made |= {
                "kind": np.full(len(k), Kind.ARC),
                "centre": corner_centres,
                "sweep": self.turn[k],
                "label": np.full(len(k), labels.index(CORNER)),
                "side": path.side[rows[k - 1]],
                "radius": path.radius[rows[k - 1]],
                "joint": np.full(len(k), -1),
                "time": np.full(len(k), np.nan),
            }
            columns = {name: np.insert(column, like, made[name], axis=0) for name, column in columns.items()}
            ends = np.insert(ends, like, corner_ends, axis=0)
        vertices = np.concatenate([path.start[:1], ends])
        return Toolpath.chain(
            vertices, columns, labels=labels, joints=path.joints, origin=path.origin, lathe=path.lathe
        )

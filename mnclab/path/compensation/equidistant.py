"""The pass: a programmed contour becomes the path of the tool centre."""

from __future__ import annotations

import numpy as np

from mnclab.geometry.vectors import left
from mnclab.path.compensation.elements import Elements, Mask
from mnclab.path.compensation.joining import corners, remaining
from mnclab.path.compensation.moving_ends import tool_centre_path
from mnclab.path.compensation.rules import SPIKE_TURN, Compensation, Report
from mnclab.path.fault import PathFault
from mnclab.path.kinds import Kind, Rule
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import Toolpath

PIECE = 1 << 14  # corners worked on at once


def apply(
    path: Toolpath,
    rules: Compensation | None,
    unfinished: bool = False,
    gouge: str = "refuse",
    report: Report | None = None,
) -> Toolpath:
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
    equidistant = Equidistant(el, rules)
    marked = equidistant.check(path, view, gouge, report)
    equidistant.notice_spikes(path, report)
    return tool_centre_path(path, view, equidistant, marked)


def _check_leads(path: Toolpath, el: Elements, rules: Compensation) -> None:
    """Entry, exit and change of side are straight lines."""
    kind = path.kind[el.rows]
    straight = (kind == Kind.LINE) | (rules.rapid & (kind == Kind.RAPID))

    def refuse(bad: Mask, message: str, hint: str = "") -> None:
        if bad.any():
            raise PathFault(message, int(path.step[el.rows[int(np.argmax(bad))]]), hint)

    refuse(
        el.entry & ~straight,
        "radius compensation begins only in a straight line at feed",
        "write the entry as a linear move, then the contour",
    )
    refuse(el.exit & ~straight, "radius compensation ends only in a straight line at feed")
    if not rules.change:
        refuse(
            el.change,
            "the side of the compensation cannot change from one element to the next",
            "write a straight line without compensation between them",
        )
    refuse(
        el.change & ~straight,
        "the side of the compensation changes only in a straight line at feed",
        "write a linear move that leads to the other side",
    )


class Equidistant:
    """Elements with the ends of their offsets: `begin`, `end` (n, 2), `sweep` (n,), `rule` (n,); where
    `insert` (n,) an arc about the corner leads to the element, with sweep `turn` (n,)."""

    def __init__(self, el: Elements, rules: Compensation) -> None:
        self.el, self.rules = el, rules
        n = len(el.rows)
        self.begin, self.end = np.empty((n, 2)), np.empty((n, 2))
        self.begin[0], self.end[-1] = el.start[0], el.end[-1]
        self.rule = np.where(el.on, np.uint8(Rule.SIDE), np.uint8(Rule.NONE))
        self.insert, self.apart = np.zeros(n, dtype=bool), np.zeros(n, dtype=bool)  # apart: closed by force
        self.turn, self.left_over, self.sweep = np.zeros(n), np.empty(n), np.empty(n)
        for first in range(0, n - 1, PIECE):  # a piece at a time stays in the cache
            last = min(first + PIECE, n - 1)
            found = corners(el, np.arange(first, last), rules)
            here, after = slice(first, last), slice(first + 1, last + 1)
            self.end[here], self.begin[after], self.rule[here] = found.E, found.S, found.rule
            self.insert[after], self.turn[after], self.apart[after] = found.insert, found.turn, found.apart
            self._remain(here)
        self.rule[el.exit & ~el.on] = Rule.EXIT
        if el.on[-1]:  # a contour that ends without an exit: the tool stands square to its end
            self.end[-1] = el.end[-1] + el.R[-1] * el.s[-1] * left(el.t_out[-1])
            lead = Rule.ENTRY if el.entry[-1] else Rule.CHANGE if el.change[-1] else Rule.SIDE
            self.rule[-1] = lead
        self._remain(slice(n - 1, n))
        free = np.flatnonzero(~el.wall)
        self.sweep[free] = el.sweep[free]

    def _remain(self, k: slice) -> None:
        found = remaining(self.el, k, self.begin[k], self.end[k], self.el.R[k])
        self.left_over[k], self.sweep[k] = found

    def check(self, path: Toolpath, view: PlaneView, gouge: str, report: Report) -> Mask:
        """Which elements (n,) cut into the contour; PathFault at the first of them unless they are to be marked."""
        from mnclab.path.compensation.fit import check

        return check(self, path, view, gouge, report)

    def notice_spikes(self, path: Toolpath, report: Report) -> None:
        """Straight corners that reach far out."""
        el = self.el
        far = np.zeros(len(el.rows), dtype=bool)
        far[:-1] = (self.rule[:-1] == Rule.OUTSIDE_STRAIGHT) & (np.abs(self.turn[1:]) > SPIKE_TURN)
        for k in np.flatnonzero(far):
            angle = 180 - np.degrees(abs(self.turn[k + 1]))
            reach = float(np.hypot(*(self.end[k] - el.end[k])))
            report.notices.append(
                PathFault(
                    f"the straight corner of {angle:.3g} degrees reaches {reach:.4g} mm out",
                    int(path.step[el.rows[k + 1]]),
                    "G162 makes an arc at acute corners",
                )
            )

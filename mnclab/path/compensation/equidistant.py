"""Where the offsets of a contour begin and end, for all of its elements at once."""

from __future__ import annotations

from copy import copy
from dataclasses import replace

import numpy as np

from mnclab.geometry.vectors import left
from mnclab.path.compensation.elements import Elements
from mnclab.path.compensation.joining import corners, remaining
from mnclab.path.compensation.rules import Compensation
from mnclab.path.kinds import Rule

PIECE = 1 << 14  # corners worked on at once


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

    def looking_ahead(self) -> Equidistant:
        """The same for rules that look at the whole contour: what they find to be a gouge is more, the path is the same."""
        twin = copy(self)
        twin.rules = replace(self.rules, look_ahead=True)
        return twin

    def _remain(self, k: slice) -> None:
        found = remaining(self.el, k, self.begin[k], self.end[k], self.el.R[k])
        self.left_over[k], self.sweep[k] = found

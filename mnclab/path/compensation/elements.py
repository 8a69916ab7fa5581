"""The rows of a path that move in the plane, as elements of a contour."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.curves import Curves
from mnclab.geometry.offsets import Element, beside
from mnclab.geometry.vectors import dot, left
from mnclab.path.columns import Array, Index, Mask
from mnclab.path.compensation.rules import STRAIGHT
from mnclab.path.corners import Prolonged
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import Toolpath


class Elements(NamedTuple):
    """n elements in the order of travel, lengths in mm, angles in rad.

    `rows` (n,) are their rows in the path; `start`, `end`, `centre` (n, 2); `t_in`, `t_out` (n, 2) unit
    tangents; `r` (n,) radii of arcs, nan for lines; `sweep` (n,). `on` (n,): compensated; `s`, `R` (n,) side
    and radius there, 0 elsewhere. `entry`, `exit`, `change` (n,): first element, the one after the last, and the
    one that leads to the other side. `corner` (n,) is the rule for the corner before the element; `from_height`,
    `to_height` (n,) mm is where the tip of the tool is at both ends, along the normal of the plane.
    """

    rows: Index
    start: Array
    end: Array
    centre: Array
    t_in: Array
    t_out: Array
    r: Array
    sweep: Array
    arc: Mask
    on: Mask
    s: Array
    R: Array
    entry: Mask
    exit: Mask
    change: Mask
    corner: NDArray[np.uint8]
    from_height: Array
    to_height: Array

    @classmethod
    def of(cls, path: Toolpath, view: PlaneView, rows: Index) -> Elements:
        take = slice(None) if len(rows) == len(path) else rows
        side, radius = path.side[take], path.radius[take]
        on = (side != 0) & (radius != 0)
        s = np.where(on, np.sign(side * radius), 0.0)  # a negative radius is the other side
        before = np.concatenate([[False], on[:-1]])
        turned = np.concatenate([[False], s[1:] != s[:-1]]) & on & before
        return cls(
            rows, view.start[take, :2], view.end[take, :2], view.centre[take], view.tangent_start[take],
            view.tangent_end[take], view.radius[take], view.sweep[take], view.arc[take],
            on, s, np.where(on, np.abs(radius), 0.0), on & ~before, before & ~on, turned, _corner_rules(path, take),
            view.start[take, 2], view.end[take, 2],
        )  # fmt: skip

    @property
    def lead(self) -> Mask:
        """The elements that lead to a contour: no wall is there."""
        return self.entry | self.change

    @property
    def wall(self) -> Mask:
        """The elements beside which the tool cuts."""
        return self.on & ~self.lead

    def offset(self, k: Index, at_end: bool, shift: Array, s: Array) -> Element:
        """Elements k (m,) moved by `shift` mm to the side `s` (m,), seen from their end or their start."""
        t, p = (self.t_out[k], self.end[k]) if at_end else (self.t_in[k], self.start[k])
        radius = self.r[k] - s * np.sign(self.sweep[k]) * shift
        return Element(p + (shift * s)[:, None] * left(t), t, self.centre[k], radius)

    def entry_arc(self, k: Index, shift: Array, s: Array) -> Element:
        """The arcs from where entries k (m,) begin to their offset ends, which run into the contour as the programmed ones do:
        about a point of the line from the end to the programmed centre, as far from both."""
        t = self.t_out[k]
        end = beside(self.end[k], t, shift * s)
        chord, toward = self.start[k] - end, self.centre[k] - end
        toward /= np.hypot(*toward.T)[:, None]
        radius = dot(chord, chord) / (2 * dot(chord, toward))
        return Element(end, t, end + toward * radius[:, None], radius)

    def boxes(self, k: Index, contour: Index) -> tuple[Array, Array]:
        """Low and high corners (m, 2) of boxes round elements k (m,); those of each contour (n,) lie far from all others."""
        sagitta = np.nan_to_num(self.r[k]) * (1 - np.cos(np.minimum(np.abs(self.sweep[k]) / 2, np.pi)))
        bulge = np.where(self.arc[k], sagitta, 0)[:, None]
        low, high = np.minimum(self.start[k], self.end[k]) - bulge, np.maximum(self.start[k], self.end[k]) + bulge
        away = (high.max(axis=0) - low.min(axis=0) + 4 * self.R.max())[0] * (contour[k] - contour[k[0]])
        low[:, 0] += away
        high[:, 0] += away
        return low, high

    def length(self, k: Index | slice) -> Array:
        """How long elements k (m,) are, mm in the plane."""
        straight = np.hypot(*(self.end[k] - self.start[k]).T)
        return np.where(self.arc[k], np.abs(self.sweep[k]) * self.r[k], straight)

    def curves(self, k: Index | slice) -> Curves:
        """Elements k (m,) as they are programmed."""
        return Curves(self.start[k], self.end[k], self.centre[k], self.r[k], self.sweep[k])

    def moved(self, k: Index, shift: Array, s: Array) -> Curves:
        """Elements k (m,) moved by `shift` mm to the side `s` (m,), from end to end."""
        start, end = beside(self.start[k], self.t_in[k], shift * s), beside(self.end[k], self.t_out[k], shift * s)
        radius = np.abs(self.r[k] - s * np.sign(self.sweep[k]) * shift)
        return Curves(start, end, self.centre[k], radius, self.sweep[k])


def _corner_rules(path: Toolpath, take: Index | slice) -> NDArray[np.uint8]:
    """The rule (n,) for the corner before each element: that of its row, or straight behind one that says so."""
    prolonged = [isinstance(joint, Prolonged) for joint in path.joints]
    if not any(prolonged):
        return path.corner_rule[take]
    rule, joint = path.corner_rule[take].copy(), path.joint[take]
    rule[1:][np.array([*prolonged, False])[joint[:-1]]] = STRAIGHT
    return rule

"""Where lines and circles meet: the corners of equidistants and the centres of roundings.

An element is given by a point `q` (n, 2) on it, its unit tangent `t` (n, 2) there, and for a circle its centre
`c` (n, 2) and radius `r` (n,); `r` is nan for a line. Lengths in mm.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.vectors import Floats, cross, dot, left, length_of


class Element(NamedTuple):
    """Lines and circles, n of them."""

    q: Floats
    t: Floats
    c: Floats
    r: Floats

    def only(self, mask: NDArray[np.bool_]) -> Element:
        """Those where `mask` (n,) holds."""
        return Element(self.q[mask], self.t[mask], self.c[mask], self.r[mask])


def beside(p: Floats, t: Floats, shift: Floats) -> Floats:
    """Points p (n, 2), or one (1, 2), moved by `shift` (n,) along the left normals of vectors t (n, 2)."""
    moved = np.empty(t.shape)
    np.subtract(p[:, 0], shift * t[:, 1], out=moved[:, 0])
    np.add(p[:, 1], shift * t[:, 0], out=moved[:, 1])
    return moved


def meet(first: Element, second: Element, near: Floats) -> Floats:
    """The common point (n, 2) of two elements that lies nearer to `near` (n, 2); nan where there is none."""
    p, q = meetings(first, second)
    closer = length_of(p - near) <= length_of(q - near)
    return np.where(closer[:, None], p, q)


def meetings(first: Element, second: Element) -> tuple[Floats, Floats]:
    """Both common points (n, 2) of two elements, twice the same for two lines; nan where there is none."""
    found = np.full((2, *first.q.shape), np.nan)
    circle1, circle2 = ~np.isnan(first.r), ~np.isnan(second.r)
    with np.errstate(divide="ignore", invalid="ignore"):
        for mask, solve in (
            (~circle1 & ~circle2, _lines),
            (~circle1 & circle2, _line_circle),
            (circle1 & ~circle2, lambda a, b: _line_circle(b, a)),
            (circle1 & circle2, _circles),
        ):
            if mask.any():
                found[:, mask] = solve(first.only(mask), second.only(mask))
    return found[0], found[1]


def _lines(a: Element, b: Element) -> tuple[Floats, Floats]:
    point = a.q + (cross(b.q - a.q, b.t) / cross(a.t, b.t))[:, None] * a.t
    return point, point


def _line_circle(line: Element, circle: Element) -> tuple[Floats, Floats]:
    # with h = t x (C - q) and l0 = (C - q) . t the points lie at q + (l0 ± sqrt(r² - h²)) t
    away = circle.c - line.q
    h, l0 = cross(line.t, away), dot(away, line.t)
    reach = np.sqrt((circle.r - h) * (circle.r + h))[:, None]
    foot = line.q + l0[:, None] * line.t
    return foot - reach * line.t, foot + reach * line.t


def _circles(a: Element, b: Element) -> tuple[Floats, Floats]:
    d = b.c - a.c
    distance = length_of(d)
    along = (distance + (a.r - b.r) * (a.r + b.r) / distance) / 2
    unit = d / distance[:, None]
    foot = a.c + along[:, None] * unit
    reach = np.sqrt((a.r - along) * (a.r + along))[:, None]
    return foot - reach * left(unit), foot + reach * left(unit)

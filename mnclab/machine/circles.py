"""What an arc must be before a machine runs it: a radius that reaches, a centre as far from its end as from its start.

Points are pairs in mm in the axes of the plane.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from mnclab.geometry.arcs import centre_of_one
from mnclab.text.program import Word

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

Point = tuple[float, float]


def centre_by_radius(
    m: Machine, s: Point, e: Point, radius: float, sense: int, tolerance: float, word: Word | None
) -> Point:
    """The centre of the arc of a signed radius; an Alarm when the radius does not reach, and by how much."""
    if math.dist(s, e) < 1e-3:
        m.alarm("a full circle cannot be given by its radius", word, hint="write the centre with I J K")
    c, shortage = centre_of_one(s, e, radius, sense)
    if shortage > tolerance:
        chord, address = 2 * (shortage + abs(radius)), word.address if word else "R"
        m.alarm(
            f"{address}{abs(radius):g} is too small for the distance {chord:.7g} mm between start and end: "
            f"at least {chord / 2:.4f} is needed",
            word,
            hint=f"too short by {shortage:.4g} mm",
        )
    return c


def check_radii(m: Machine, s: Point, e: Point, c: Point, tolerance: float, word: Word | None) -> None:
    """An Alarm when the centre lies on the start, or the end not on the circle about it."""
    at_start, at_end = math.dist(s, c), math.dist(e, c)
    if at_start < 1e-9:
        m.alarm("the centre of the arc lies on its start", word)
    if abs(at_start - at_end) > tolerance:
        m.alarm(
            f"the end point is not on the circle: radius {at_start:.4f} at the start, {at_end:.4f} at the end, "
            f"allowed difference {tolerance:g} mm",
            word,
        )

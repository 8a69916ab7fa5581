"""Named shapes. Places are (x, y, z) in mm; of a cavity or a boss z is the height of the face that it opens or stands on."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.contours import slot as slot_about
from mnclab.geometry.frames import Matrix
from mnclab.geometry.regions import Region
from mnclab.geometry.signed import signed
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, check_point, faults_as_alarms
from mnclab.workpiece.part.part import Floats, Part
from mnclab.workpiece.part.prisms import Prism, Prisms

LARGEST = 1e6  # mm, of a size and of a coordinate


def plane(point: ArrayLike, normal: ArrayLike) -> Part:
    """Half of space, bounded by the plane through `point`; the normal points away from the material.

    >>> mnc.part.plane((0, 0, 10), (0, 0, 1)).distance(np.array([[7, 7, 12.0]]))
    array([2.])
    """
    through = _place(point, "a point of a plane")
    out = unit_vector(_place(normal, "the normal of a plane"), "the normal of a plane")
    return Part(partial(_plane, through, out), "plane")


def box(first: ArrayLike, opposite: ArrayLike, corner: float = 0.0) -> Part:
    """A cuboid along the axes, from one corner to the opposite one; `corner`: the radius of its upright edges.

    >>> mnc.part.box((0, 0, -20), (60, 40, 0)).distance(np.array([[30, 20, 5.0]]))
    array([5.])
    """
    a, b = _place(first, "the corner of a box"), _place(opposite, "the opposite corner of a box")
    low, high = np.minimum(a, b), np.maximum(a, b)
    for name, size in zip(("length", "width", "height"), high - low):
        check_number(float(size), f"the {name} of a box", above=0)
    length, width, _ = (high - low).tolist()
    return _prism("box", _rectangle("a box", (low + high) / 2, length, width, corner), float(low[2]), float(high[2]))


def cylinder(bottom: ArrayLike, top: ArrayLike, radius: float) -> Part:
    """A round bar between the centres of its two faces.

    >>> mnc.part.cylinder((0, 0, 0), (0, 0, 10), 5).distance(np.array([[8, 0, 5.0]]))
    array([3.])
    """
    a, b = _place(bottom, "the bottom of a cylinder"), _place(top, "the top of a cylinder")
    _check_size(radius, "the radius of a cylinder")
    along = unit_vector(b - a, "the axis of a cylinder")
    if abs(along[2]) == 1.0:
        return _prism("cylinder", _circle(a, radius), float(min(a[2], b[2])), float(max(a[2], b[2])))
    return _prism("cylinder", _circle(np.zeros(3), radius), 0.0, float(np.linalg.norm(b - a)), _along(a, along))


def cone(bottom: ArrayLike, top: ArrayLike, radius: float, top_radius: float = 0.0) -> Part:
    """A cone between the centres of its two faces, cut off where its upper one has a radius.

    >>> mnc.part.cone((0, 0, 0), (0, 0, 10), 5).distance(np.array([[0, 0, 12.0]]))
    array([2.])
    """
    a, b = _place(bottom, "the bottom of a cone"), _place(top, "the top of a cone")
    _check_size(radius, "the radius of a cone")
    check_number(top_radius, "the upper radius of a cone", at_least=0, at_most=LARGEST)
    along, high = unit_vector(b - a, "the axis of a cone"), float(np.linalg.norm(b - a))
    half = [(0.0, 0.0), (radius, 0.0), (top_radius, high), (0.0, high)]  # and its mirror image beyond the axis
    corners = [*half[1:3], *[(-r, z) for r, z in reversed(half[1:3])]]
    outline = Contour([each for k, each in enumerate(corners) if each != corners[k - 1]])
    rim = np.sqrt(np.maximum(1 - along**2, 0.0))
    bounds = [np.minimum(a - radius * rim, b - top_radius * rim), np.maximum(a + radius * rim, b + top_radius * rim)]
    return Part(partial(_cone, Region((outline,)), a, along), "cone", bounds=np.array(bounds))


def ball(centre: ArrayLike, radius: float) -> Part:
    """A ball about a point; the radius in mm.

    >>> mnc.part.ball((0, 0, 0), 10).distance(np.array([[0, 0, 15.0]]))
    array([5.])
    """
    middle = _place(centre, "the centre of a ball")
    _check_size(radius, "the radius of a ball")
    return Part(partial(_ball, middle, radius), "ball", bounds=np.array([middle - radius, middle + radius]))


def hole(centre: ArrayLike, diameter: float, depth: float) -> Part:
    """What a hole takes out of the face at the height of its centre, to be taken away: `block - hole(…)`. Lengths in mm; an
    infinite depth goes through.

    >>> block = mnc.part.box((0, 0, -20), (60, 40, 0)) - mnc.part.hole((30, 20, 0), 20, 15)
    >>> print(f"{mnc.part.contact(block, (30, 20, -5), (1, 0, 0), 3, 50):.3f}")  # 10 - 3
    7.000
    """
    middle = _place(centre, "the centre of a hole")
    _check_size(diameter, "the diameter of a hole")
    return _cavity("hole", _circle(middle, diameter / 2), middle[2], depth)


def slot(start: ArrayLike, end: ArrayLike, width: float, depth: float) -> Part:
    """What a straight slot with round ends takes out of a face, from the centre of one end to that of the other, mm:
    `block - slot(…)`.

    >>> block = mnc.part.box((0, 0, -20), (60, 40, 0)) - mnc.part.slot((20, 20, 0), (40, 20, 0), 12, 10)
    >>> print(f"{mnc.part.contact(block, (30, 20, -5), (0, 1, 0), 3, 50):.3f}")  # 6 - 3
    3.000
    """
    a, b = _place(start, "the start of a slot"), _place(end, "the end of a slot")
    _check_size(width, "the width of a slot")
    if a[2] != b[2]:
        raise Alarm(f"both ends of a slot lie in one face, got Z {a[2]:g} and Z {b[2]:g}")
    unit_vector(b - a, "a slot")
    return _cavity("slot", Region((slot_about(Contour([a[:2], b[:2]], closed=False), width),)), a[2], depth)


def pocket(
    centre: ArrayLike, length: float, width: float, depth: float, corner: float = 0.0, turned: float = 0.0
) -> Part:
    """What a rectangular pocket takes out of a face: `length` along X, `width` along Y, before it is `turned` by degrees about
    its centre, mm; `corner`: the radius of its corners. To be taken away: `block - pocket(…)`.

    >>> block = mnc.part.box((0, 0, -20), (60, 40, 0)) - mnc.part.pocket((30, 20, 0), 40, 20, 10)
    >>> print(f"{mnc.part.contact(block, (30, 20, -5), (0, 1, 0), 3, 50):.3f}")  # 10 - 3
    7.000
    """
    middle = _place(centre, "the centre of a pocket")
    return _cavity("pocket", _rectangle("a pocket", middle, length, width, corner, turned), middle[2], depth)


def boss(
    centre: ArrayLike, height: float, *, diameter: float | None = None, length: float | None = None,
    width: float | None = None, corner: float = 0.0, turned: float = 0.0,
) -> Part:  # fmt: skip
    """What stands on a face: round with a `diameter`, else rectangular with `length`, `width`, `corner`, `turned` as a pocket.

    >>> table = mnc.part.plane((0, 0, 0), (0, 0, 1))
    >>> print(f"{mnc.part.contact(table | mnc.part.boss((0, 0, 0), 8, diameter=20), (30, 0, 4), (-1, 0, 0), 2, 50):.3f}")
    18.000
    """
    middle = _place(centre, "the centre of a boss")
    _check_size(height, "the height of a boss")
    if (diameter is None) == (length is None and width is None) or (length is None) != (width is None):
        raise Alarm("a boss has a diameter, or a length and a width", hint="boss((20, 30, 0), 8, diameter=12)")
    if diameter is None:
        region = _rectangle("a boss", middle, length, width, corner, turned)
    else:
        _check_size(diameter, "the diameter of a boss")
        if corner or turned:
            raise Alarm("a round boss has neither corners nor an angle")
        region = _circle(middle, diameter / 2)
    return _prism("boss", region, float(middle[2]), float(middle[2]) + height)


# Distances of points p (n, 3).


def _plane(through: Floats, out: Floats, p: Floats) -> Floats:
    return np.asarray((p - through) @ out)


def _ball(middle: Floats, radius: float, p: Floats) -> Floats:
    return np.asarray(np.linalg.norm(p - middle, axis=1) - radius)


def _cone(half: Region, bottom: Floats, along: Floats, p: Floats) -> Floats:
    height = (p - bottom) @ along
    return signed(half, np.stack([np.linalg.norm(p - bottom - height[:, None] * along, axis=1), height], axis=1))


def _prism(name: str, region: Region, low: float, high: float, frame: Matrix | None = None) -> Part:
    (x0, y0), (x1, y1) = region.bounds
    part = Part(Prisms(Prism(region, low, high)), name, bounds=np.array([(x0, y0, low), (x1, y1, high)]))
    return part if frame is None else Part(Prisms(Prism(region, low, high), frame), name, bounds=part.placed(frame).bounds)


def _cavity(name: str, region: Region, top: float, depth: float) -> Part:
    """All of a region from a depth below a face up without end."""
    check_number(depth, f"the depth of a {name}", above=0, at_most=LARGEST, endless=True)
    return _prism(name, region, float(top) - depth, math.inf)


def _circle(centre: Floats, radius: float) -> Region:
    return Region((Contour.circle(centre[:2], radius),))


def _rectangle(
    what: str, centre: Floats, length: float | None, width: float | None, corner: float, turned: float = 0.0
) -> Region:
    _check_size(length, f"the length of {what}")
    _check_size(width, f"the width of {what}")
    check_number(corner, f"the corner radius of {what}", at_least=0)
    check_number(turned, f"the angle of {what} (degrees)")
    with faults_as_alarms():
        return Region((rectangle(length, width, corner, centre=centre[:2], angle=np.radians(turned)),))  # type: ignore[arg-type]


def _along(origin: Floats, z: Floats) -> Matrix:
    """A frame at a point, upright along a unit vector."""
    x = unit_vector(np.cross(np.eye(3)[int(np.abs(z).argmin())], z), "an axis")
    frame = np.eye(4)
    frame[:3] = np.column_stack([x, np.cross(z, x), z, origin])
    return frame


def _check_size(value: object, what: str) -> None:
    check_number(value, what, above=0, at_most=LARGEST)


def _place(point: ArrayLike, what: str) -> Floats:
    check_point(point, what)
    found = np.asarray(point, dtype=float)
    check_number(float(np.abs(found).max()), f"the largest coordinate of {what}", at_most=LARGEST)
    return found


def unit_vector(vector: ArrayLike, name: str) -> Floats:
    """A vector brought to the length 1; an Alarm for one without length."""
    v = np.asarray(vector, dtype=float)
    size = float(np.linalg.norm(v))
    if not size > 0:
        raise Alarm(f"{name} must have a length greater than 0")
    return np.asarray(v / size)

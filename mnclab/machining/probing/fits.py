"""What lies best through measured points: lines, circles, balls, widths, rectangles, corners, planes.

Points are arrays (n, 2) or (n, 3) in mm; what lies in the plane takes x and y alone. Ball centres and surface points are fitted
alike: a result of ball centres is `grown` or moved `towards` the material by the ball's radius afterwards, for a cylinder, a wall
and a plane that is exact, while `off_the_ball` brings a single point along its probing direction only.

Two controls, three circles: the least squares of distances is that of the standards (ISO 12181), TNC 620 cycles take the least
squares of squared distances, MNC cycles the middles of opposite touches. Where the part is round all three agree.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from mnclab.geometry.arcs import round_through
from mnclab.geometry.curves import turned
from mnclab.machining.probing.found import (
    DEGREES,
    FARTHEST,
    SAME,
    Circle,
    Floats,
    Line,
    Plane,
    Point,
    Points,
    ProbingResult,
    Rectangle,
    Sphere,
    Vector,
    Width,
    number,
    numbers,
    points_of,
    unit,
)
from mnclab.text.alarm import Alarm

FLAT = 1e-9  # of their spread: points nearer to a line than this lie on it; rad: directions nearer to each other are one
ROUNDS = 100  # steps of Gauss and Newton
EXACT, SETTLED = 1e-15, 1e-6  # of the radius: a step that is none, and one so short that rounding alone makes the next no shorter
CIRCLES = ("distance", "power", "opposite")


def line(points: Points) -> Line:
    """The line through two points, or with the least squares of distances to more.

    TNC 620: 400, 403, 414, 415, 1410. MNC: G400, G414, G415.

    >>> print(f"{mnc.probing.line([(0, 0), (10, 10), (20, 20)]).angle:.3f}")
    45.000
    """
    p = points_of(points, 2, "a line")
    if len(p) == 2:
        ahead = p[1] - p[0]
    else:
        _, sizes, axes = np.linalg.svd(p - p.mean(axis=0), full_matrices=False)
        if sizes[1] > sizes[0] * (1 - FLAT):
            raise Alarm("the points lie along no line: they spread alike in all directions")
        order = np.arange(len(p)) - (len(p) - 1) / 2
        ahead = axes[0] * (math.copysign(1.0, order @ p @ axes[0]))
    x, y = p.mean(axis=0).tolist()
    found = Line(x, y, reduced(math.degrees(math.atan2(ahead[1], ahead[0])), 360))
    return found if len(p) == 2 else replace(found, straightness=float(np.ptp(found.distance(p))))


def angle(first: Vector, second: Vector) -> float:
    """The direction from one point to another, in degrees above -180 to 180.

    Of two touches of an edge, of two holes or studs. TNC 620: 401, 402, 405, 420, 1411. MNC: G400, G420.

    >>> mnc.probing.angle((0, 0), (0, 10))
    90.0
    """
    return line([first, second]).angle


def reduced(angle: float, turn: float = 180.0) -> float:
    """The same angle in degrees, above -turn/2 to turn/2.

    A line without a direction is the same after 180 degrees. TNC 620: 400, 401, 403, 414, 415. MNC: G420.

    >>> mnc.probing.reduced(170)
    -10.0
    """
    if not number(turn, "a turn") > 0:
        raise Alarm(f"a turn must be greater than 0 degrees, got {turn:g}")
    rest = math.remainder(number(angle, "an angle"), turn)
    return turn / 2 if rest <= -turn / 2 else rest


def circle(points: Points, by: str = "distance") -> Circle:
    """The circle through three points, or near more: touches of the ball, or middles of holes on a circle of holes.

    by="distance": least squares of distances; "power": least squares of (distance² - radius²), as TNC 620 cycles have it (§ 15,
    16); "opposite": of four points, two along one axis and two along another square to it, the middles of both and the mean
    distance from there, as MNC cycles have it (G412, G413, G421, G422, G461, G462).

    >>> print(f"{mnc.probing.circle([(10, 0), (0, 10), (-10, 0), (0, -10)]).radius:.3f}")
    10.000
    """
    if by not in CIRCLES:
        raise Alarm(f"a circle is found by {', '.join(CIRCLES)}, not by {by!r}")
    if by != "opposite":
        centre, radius, roundness = _round(points_of(points, 3, "a circle"), by)
        return Circle(centre[0], centre[1], radius, roundness)
    p = points_of(points, 4, "a circle by opposite points", most=4)
    x, y = rectangle(p).centre
    away = _norms(p - (x, y))
    return Circle(x, y, float(away.mean()), float(np.ptp(away)))


def sphere(points: Points) -> Sphere:
    """The ball through four points (4, 3), or with the least squares of distances to more. TNC 620: 460.

    >>> found = mnc.probing.sphere([(10, 0, 0), (-10, 0, 0), (0, 10, 0), (0, 0, 10)])
    >>> print(f"{found.radius:.3f}")
    10.000
    """
    (x, y, z), radius, roundness = _round(points_of(points, 4, "a ball", wide=3), "distance")
    return Sphere(x, y, z, radius, roundness)


def width(first: Vector, second: Vector, direction: float | None = None) -> Width:
    """A slot or ridge by two touches, along a direction in degrees to X, or as they lie.

    TNC 620: 408, 409, 425, 426. MNC: G408, G409, G425, G426.

    >>> mnc.probing.width((0, 5), (30, 5)).width
    30.0
    """
    p = points_of([first, second], 2, "a width")
    apart = p[1] - p[0]
    if direction is not None:
        apart = turned(apart, -math.radians(number(direction, "a direction")))[:1]
    x, y = p.mean(axis=0).tolist()
    return Width(x, y, math.hypot(*apart))


def rectangle(points: Points, angle: float = 0.0) -> Rectangle:
    """A pocket or stud by four touches: two opposite ones along `angle` in degrees to X, two across.

    TNC 620: 410, 411, 423, 424. MNC: G410, G411, G423, G424.

    >>> found = mnc.probing.rectangle([(0, 10), (40, 10), (20, 0), (20, 20)])
    >>> found.length, found.width
    (40.0, 20.0)
    """
    way = math.radians(number(angle, "an angle"))
    p = turned(points_of(points, 4, "a rectangle", most=4), -way)
    along, across = p[:2, 0], p[2:, 1]
    x, y = turned(np.array([along.mean(), across.mean()]), way).tolist()
    return Rectangle(x, y, float(np.ptp(along)), float(np.ptp(across)), angle)


def corner(first: Line, second: Line) -> Point:
    """Where two lines cross. TNC 620: 414, 415. MNC: G414, G415.

    >>> along, across = mnc.probing.line([(0, 5), (20, 5)]), mnc.probing.line([(3, 10), (3, 30)])
    >>> mnc.probing.corner(along, across)
    Point(x=3.000 mm, y=5.000 mm)
    """
    for given in (first, second):
        if not isinstance(given, Line):
            raise Alarm(f"a corner is that of two lines, got {given!r}", hint="corner(line(p[:2]), line(p[2:]))")
    (ax, ay), (bx, by) = first.direction, second.direction
    cross = ax * by - ay * bx
    if abs(cross) < FLAT:
        raise Alarm(f"the lines do not cross: they lie at {first.angle:.4f}° and {second.angle:.4f}°")
    along = ((second.x - first.x) * by - (second.y - first.y) * bx) / cross
    return Point(first.x + along * ax, first.y + along * ay)


def centre_of_four(points: Points) -> Point:
    """Where the line through points 1 and 3 crosses that through 2 and 4. TNC 620: 418, of four holes.

    >>> mnc.probing.centre_of_four([(0, 0), (20, 0), (20, 10), (0, 10)])
    Point(x=10.000 mm, y=5.000 mm)
    """
    p = points_of(points, 4, "the middle of four points", most=4)
    return corner(line(p[::2]), line(p[1::2]))


def plane(points: Points) -> Plane:
    """The plane through three points (3, 3), or with the least squares of distances to more. TNC 620: 431, 1420.

    >>> print(f"{mnc.probing.plane([(0, 0, 5), (10, 0, 5), (0, 10, 5)]).up[2]:.3f}")
    1.000
    """
    p = points_of(points, 3, "a plane", wide=3)
    _, sizes, axes = np.linalg.svd(p - p.mean(axis=0), full_matrices=False)
    if sizes[1] <= FLAT * sizes[0]:
        raise Alarm("the points lie on one line, so that any plane through it holds them")
    if len(p) > 3 and sizes[2] > sizes[1] * (1 - FLAT):
        raise Alarm("the points lie along no plane: they spread alike across it")
    nx, ny, nz = axes[2].tolist()
    up = math.copysign(1.0, next(n for n in (nz, ny, nx) if abs(n) > FLAT))
    x, y, z = p.mean(axis=0).tolist()
    found = Plane(x, y, z, (up * nx, up * ny, up * nz))
    return found if len(p) == 3 else replace(found, flatness=float(np.ptp(found.distance(p))))


def off_the_ball(balls: Vector | Points, directions: Vector | Points, radius: float) -> Floats:
    """Touched points (…, k) of ball centres (…, k), compensated along the probing directions (…, k), units or not.

    Where the surface is inclined to its direction the point is off it by radius (1 / cos - 1) along that (TNC 620 § 14.2).

    >>> mnc.probing.off_the_ball((57, 20), (1, 0), 3)
    array([60., 20.])
    """
    if (size := number(radius, "the ball radius")) < 0:
        raise Alarm(f"the ball radius must be 0 or more, got {size:g}")
    centres, ways = numbers(balls, "ball centres"), unit(directions, "a probing direction")
    try:
        return np.asarray(centres + size * ways)
    except ValueError:
        raise Alarm(f"ball centres and probing directions must go together, got {centres.shape} and {ways.shape}") from None


def _round(p: Floats, by: str) -> tuple[list[float], float, float]:
    """Centre, radius and roundness of the circle (n, 2) or ball (n, 3) through points, or with the least squares."""
    try:
        centre, radius = round_through(p)
    except ValueError:
        raise Alarm(f"the points lie on one {'line' if p.shape[1] == 2 else 'plane'}, or are too few different ones") from None
    if by == "distance" and len(p) > p.shape[1] + 1:
        centre, radius = _settled(p, centre, radius)
    return centre.tolist(), radius, float(np.ptp(_norms(p - centre)))


def _settled(p: Floats, centre: Floats, radius: float) -> tuple[Floats, float]:
    """Centre and radius with the least squares of distances, by the steps of Gauss and Newton until these get no shorter."""
    last = math.inf
    for _ in range(ROUNDS):
        ways = p - centre
        away = np.maximum(_norms(ways), SAME)
        slopes = np.column_stack([ways / away[:, None], np.ones(len(p))])
        step = np.linalg.lstsq(slopes, away - radius, rcond=None)[0]
        centre, radius = centre + step[:-1], radius + float(step[-1])
        size = float(np.abs(step).max())
        if size <= EXACT * radius or last <= size <= SETTLED * radius:
            return centre, radius
        if not size < FARTHEST:
            break
        last = size
    raise Alarm("no circle settles near the points: they are too few, or too far from round")


def _norms(ways: Floats) -> Floats:
    return np.asarray(np.linalg.norm(ways, axis=1))


# How sure a measured number is: the fit repeated with the probe's noise.
# A probe that touches a point again finds it a little elsewhere; how much is its repeatability, a standard deviation in
# mm (makers
# state twice that). The standard uncertainty of what is made of the points is the standard deviation it has when every point is
# shaken so, many times (propagation of distributions by a Monte Carlo method, JCGM 101). Two thirds of the results lie
# within once,
# 95 of 100 within twice the standard uncertainty.

Result = ProbingResult | Mapping[str, float] | float
MOST = 1_000_000  # repeats


class Uncertainty(dict[str, float]):
    """Standard uncertainties by the names of the numbers, shown with two digits that count: mm, angles in degrees."""

    def __repr__(self) -> str:
        said = (f"{name} ±{value:#.2g}{'°' if name in DEGREES else ' mm'}" for name, value in self.items())
        return f"Uncertainty({', '.join(said)})"


def uncertainty(
    fit: Callable[..., Result], points: Vector | Points, spread: float | Vector | Points, *, seed: int = 0, repeats: int = 1000
) -> Uncertainty:
    """The standard uncertainty of each number of a fit: `uncertainty(circle, points, 0.001)["diameter"]`.

    `fit` takes points like these, any array, and gives a result of this package, numbers by name, or one number ("value"); a
    corner of four touches is `lambda p: corner(line(p[:2]), line(p[2:]))`. `spread` is the probe's standard deviation in mm: one
    number, or numbers that fit the shape of the points, as (0, 0, 0.001) where only Z was probed. Of a touch only the part along
    the surface's normal counts. The same seed shakes alike; a thousand repeats give the uncertainty to some 2 %.

    The width between two touches is off by √2 of what each is:

    >>> off = mnc.probing.uncertainty(lambda both: both[1] - both[0], [0.0, 30.0], 0.001)
    >>> print(f"{off['value']:.4f}")
    0.0014
    """
    if not callable(fit):
        raise Alarm(f"a fit is a function of points, as circle is, got {fit!r}")
    at, wide = numbers(points, "points"), numbers(spread, "spread")
    if (wide < 0).any():
        raise Alarm(f"spread must be a standard deviation in mm, 0 or more, got {spread!r}")
    try:
        wide, chance = np.broadcast_to(wide, at.shape), np.random.default_rng(seed)
    except (TypeError, ValueError):
        raise Alarm(f"spread must go with points {at.shape}, and seed be 0 or more, got {spread!r} and {seed!r}") from None
    if not isinstance(repeats, int) or not 2 <= repeats <= MOST:
        raise Alarm(f"repeats must be a whole number from 2 to {MOST}, got {repeats!r}")
    exact = _numbers(fit(at))
    shaken = np.array([list(_numbers(fit(at + chance.normal(size=at.shape) * wide)).values()) for _ in range(repeats)])
    off = shaken - list(exact.values())
    turns = [k for k, name in enumerate(exact) if name in DEGREES]
    off[:, turns] -= 180 * np.round(off[:, turns] / 180)  # 180 is near -180, and a line has no direction
    return Uncertainty(zip(exact, np.std(off, axis=0, ddof=1).tolist(), strict=True))


def _numbers(result: Result) -> Mapping[str, float]:
    if isinstance(result, ProbingResult):
        return result.numbers
    return result if isinstance(result, Mapping) else {"value": result}

"""The blank as its drawing gives it: a box between two corners, or a body turned about an axis. No mesh.

A blank is for pictures; it stands in the coordinates of whoever gives it (machine coordinates in a Setup).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple, Protocol, TypeGuard

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.text.alarm import Alarm
from mnclab.text.file import File, check_names
from mnclab.text.given import check_number, check_point, either, fitting, refusing_class, shown
from mnclab.text.tables import svg_of, written

CORNERS = 96  # of a circle in a picture
ROUND = 0.01  # mm, by which places taken for those of a round surface may lie below it
FARTHEST = 1e9  # mm, where a blank may stand
Array = NDArray[np.float64]


@refusing_class
class Box(NamedTuple):
    """A box between two opposite corners (3,), mm.

    >>> mnc.blank.Box((0, 0, -20), (80, 60, 0)).volume
    96000.0
    """

    low: tuple[float, ...]
    high: tuple[float, ...]

    def __repr__(self) -> str:
        return written(self)

    def _repr_svg_(self) -> str | None:
        return svg_of(self.outline(0, 1), self.outline(0, 2))

    def moved(self, by: ArrayLike) -> Box:
        low, high = (np.asarray(corner, dtype=np.float64) + np.asarray(by) for corner in self)
        return Box(tuple(low.tolist()), tuple(high.tolist()))

    @property
    def bounds(self) -> Array:
        """The corners with the least and the greatest coordinates (2, 3)."""
        corners = np.array([self.low, self.high], dtype=np.float64)
        return np.stack([corners.min(axis=0), corners.max(axis=0)])

    def edges(self) -> list[Array]:
        """The twelve edges, each (2, 3)."""
        bounds = self.bounds
        corners = [np.array([bounds[i, 0], bounds[j, 1], bounds[k, 2]]) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
        pairs = [(a, a | bit) for bit in (1, 2, 4) for a in range(8) if not a & bit]
        return [np.stack([corners[a], corners[b]]) for a, b in pairs]

    @property
    def volume(self) -> float:
        """mm³."""
        return float(np.prod(self.bounds[1] - self.bounds[0]))

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """How low and how high it reaches at points (m,); nan beside it."""
        low, high = self.bounds
        inside = (x >= low[0]) & (x <= high[0]) & (y >= low[1]) & (y <= high[1])
        return np.where(inside, low[2], np.nan), np.where(inside, high[2], np.nan)

    def outline(self, right: int, up: int) -> list[Array]:
        """What a view along an axis shows: closed lines (k, 2) in the coordinates `right` and `up` (0 to 2)."""
        (x0, y0), (x1, y1) = self.bounds[:, [right, up]]
        return [np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)])]


class Sized(Box):
    """A box by its sizes: its corner at the datum from which a path counts, its top at Z0."""

    __slots__ = ()


@refusing_class
class Revolved(NamedTuple):
    """A body turned about an axis parallel to X, Y or Z. `profile`: pairs of radius and place along the axis, mm, from
    one end to the other; `at`: a point on the axis. `bore`: the radius of a hole all along it, for a tube.

    >>> print(f"{mnc.blank.Revolved(((10, -60), (10, 0))).volume:.1f}")  # pi x 10 x 10 x 60
    18849.6
    """

    profile: tuple[tuple[float, float], ...]
    axis: str = "Z"
    at: tuple[float, ...] = (0.0, 0.0, 0.0)
    bore: float = 0.0

    def __repr__(self) -> str:
        return written(self)

    def _repr_svg_(self) -> str | None:
        body = blank(self)  # None where the profile is none
        return svg_of(body.outline(0, 1), body.outline(0, 2)) if body else None

    @property
    def along(self) -> int:
        return "XYZ".index(self.axis)

    def moved(self, by: ArrayLike) -> Revolved:
        return self._replace(at=tuple((np.asarray(self.at, dtype=np.float64) + np.asarray(by)).tolist()))

    @property
    def bounds(self) -> Array:
        """The corners with the least and the greatest coordinates (2, 3)."""
        profile, centre = np.array(self.profile, dtype=np.float64), np.array(self.at, dtype=np.float64)
        wide = profile[:, 0].max()
        low, high = centre - wide, centre + wide
        k = self.along
        low[k], high[k] = centre[k] + profile[:, 1].min(), centre[k] + profile[:, 1].max()
        return np.stack([low, high])

    @property
    def volume(self) -> float:
        """What lies between the lower and the upper side, mm³: the bore of a lying tube and what its profile lets in from the
        side are filled."""
        profile, at = np.array(self.profile, dtype=np.float64), np.array(self.at, dtype=np.float64)
        if self.axis != "Z":
            (r0, z0), (r1, z1) = profile[:-1].T, profile[1:].T
            return float(np.pi / 3 * np.abs((z1 - z0) * (r0 * r0 + r0 * r1 + r1 * r1)).sum())
        rings = np.unique(np.append(profile[:, 0], [self.bore, 0.0]))
        inner, outer = rings[:-1], rings[1:]
        inner, outer = inner[inner >= self.bore], outer[inner >= self.bore]
        near, far = (2 * inner + outer) / 3, (inner + 2 * outer) / 3  # the sides are straight between two rings
        thick = [np.subtract(*self.faces(at[0] + rho, at[1] + 0 * rho)[::-1]) for rho in (near, far)]
        rise = (thick[1] - thick[0]) / (far - near)
        start = thick[0] - rise * near
        return float(np.pi * (start * (outer**2 - inner**2) + rise * (outer**3 - inner**3) * 2 / 3).sum())

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """How low and how high it reaches at points (m,); nan beside it."""
        profile, at = np.array(self.profile, dtype=np.float64), np.array(self.at, dtype=np.float64)
        if self.axis == "Z":
            rho = np.hypot(x - at[0], y - at[1])
            bottom, top, inside = _stacked(profile, self.bore, rho, at[2])
        else:
            along, beside = (x - at[0], y - at[1]) if self.axis == "X" else (y - at[1], x - at[0])
            radius = _widest(profile, along)
            half = np.sqrt(np.where(np.abs(beside) <= radius, radius * radius - beside * beside, np.nan))
            bottom, top, inside = at[2] - half, at[2] + half, np.isfinite(half)
        return np.where(inside, bottom, np.nan), np.where(inside, top, np.nan)

    def rims(self) -> list[tuple[float, float]]:
        """Radius and place along the axis of every edge that goes round; those of a bore too."""
        bore = [(self.bore, self.profile[0][1]), (self.bore, self.profile[-1][1])]
        return [(radius, place) for radius, place in (*self.profile, *bore) if radius > 0]

    def _points(self, radius: ArrayLike, angle: ArrayLike, place: ArrayLike) -> Array:
        """Points (k, 3) at radii and angles about the axis and places along it."""
        first, second = ((1, 2), (2, 0), (0, 1))[self.along]
        points = np.empty((np.broadcast(radius, angle, place).size, 3))
        points[:, first], points[:, second] = radius * np.cos(angle), radius * np.sin(angle)
        points[:, self.along] = place
        return points + np.array(self.at, dtype=np.float64)

    def edges(self) -> list[Array]:
        """The rims as closed lines (k, 3) and four lines along the surface (k, 3)."""
        angle, profile = np.linspace(0, 2 * np.pi, CORNERS + 1), np.array(self.profile, dtype=np.float64)
        rings = [self._points(radius, angle, place) for radius, place in self.rims()]
        return rings + [self._points(profile[:, 0], quarter, profile[:, 1]) for quarter in np.pi / 2 * np.arange(4)]

    def outline(self, right: int, up: int) -> list[Array]:
        profile, centre = np.array(self.profile, dtype=np.float64), np.array(self.at, dtype=np.float64)[[right, up]]
        if self.along not in (right, up):  # seen along the axis: circles
            angle = np.linspace(0, 2 * np.pi, CORNERS + 1)
            ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
            return [centre + radius * ring for radius in (profile[:, 0].max(), self.bore) if radius > 0]
        lines = [np.concatenate([profile * [1, 1], profile[::-1] * [-1, 1], profile[:1]])]
        if self.bore > 0:
            (a, b), r = profile[[0, -1], 1], self.bore
            lines.append(np.array([(r, a), (r, b), (-r, b), (-r, a), (r, a)]))
        return [centre + (line if self.along == up else line[:, ::-1]) for line in lines]


class Blank(Protocol):
    """What can be cut: a box, a body turned about an axis, a part that was cut before, a design. It does not change.

    It is known by its lower and its upper side; on a lathe, by its half section besides.
    """

    @property
    def bounds(self) -> Array:
        """The corners with the least and the greatest coordinates (2, 3)."""

    @property
    def volume(self) -> float:
        """mm³."""

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """How low and how high it reaches at points (m,); nan beside it."""

    def moved(self, by: ArrayLike) -> Blank:
        """The same elsewhere."""

    def outline(self, right: int, up: int) -> list[Array]:
        """What a view along an axis shows: closed lines (k, 2) in the coordinates `right` and `up` (0 to 2)."""

    def edges(self) -> list[Array]:
        """Lines (k, 3) that show it in space."""


@fitting
def box(length: Any, width: Any, height: float | None = None) -> Box:
    """A box by three sizes in mm, `box(80, 60, 20)`: its corner at the datum of the program, its top at Z0; or by two opposite
    corners in machine coordinates, `box((0, 0, -20), (80, 60, 0))`.

    >>> mnc.box(80, 60, 20).volume
    96000.0
    """
    sizes = (length, width) if height is None else (length, width, height)
    found = blank(sizes)
    if not isinstance(found, Box):
        hint = "box(80, 60, 20), or by two corners: box((0, 0, -20), (80, 60, 0))"
        raise Alarm(f"a box is three sizes greater than 0, or two corners (x, y, z), got {shown(sizes)}", hint=hint)
    return found


@fitting
def cylinder(
    radius: float | None = None, low: float | None = None, high: float = 0.0,
    axis: str = "Z", at: tuple[float, ...] = (0.0, 0.0, 0.0), bore: float = 0.0,
    *, diameter: float | None = None, length: float | None = None,
) -> Revolved:  # fmt: skip
    """A cylinder from `low` to `high` along an axis through `at`, mm; a tube with a `bore` radius.

    A bar by its sizes is `cylinder(diameter=50, length=60)`: from Z-60 to Z0.

    >>> print(f"{mnc.cylinder(diameter=20, length=60).volume:.1f}")  # pi x 10 x 10 x 60
    18849.6
    """
    check_number(high, "the high of a cylinder (mm)")
    radius = either(radius, diameter, "radius", "diameter", lambda given: given / 2)
    low = either(low, length, "low", "length", lambda given: high - given)
    for name, number in (("radius", radius), ("bore", bore), ("low", low)):
        check_number(number, f"the {name} of a cylinder (mm)")
    check_point(at, "the point on the axis of a cylinder (mm)")
    radius, low, high, bore = map(float, (radius, low, high, bore))
    if not radius > bore >= 0 or not high > low or axis not in ("X", "Y", "Z"):
        found = f"radius {radius:g}, bore {bore:g}, {low:g} to {high:g}, axis {axis!r}"
        needed = "a cylinder needs radius > bore >= 0, high > low and axis X, Y or Z"
        raise Alarm(f"{needed}; got {found}", hint="by its sizes: cylinder(diameter=50, length=60)")
    return Revolved(((radius, low), (radius, high)), axis, at, bore)


@fitting
def chuck(radius: float, back: float, grip: float = 20.0, jaws: float = 25.0, body: float = 60.0) -> Revolved:
    """What holds a bar of a radius whose back end is at Z `back`: jaws around it over `grip`, mm, and the body behind.

    `jaws` is how thick they are, `body` how long what is behind them is. For `Setup(fixtures=(…,))`.

    >>> mnc.blank.chuck(20, -60, grip=15).profile[-1]  # the front of the jaws: radius 20 + 25, 15 mm along the bar
    (45.0, -45)
    """
    sizes = {"radius of the bar": radius, "grip": grip, "thickness of the jaws": jaws, "length of the body": body}
    for name, number in sizes.items():
        check_number(number, f"the {name} of a chuck (mm)", above=0)
    check_number(back, "the place of a chuck along Z (mm)")
    wide = radius + 1.5 * jaws
    outside = ((wide, back - body), (wide, back), (radius + jaws, back), (radius + jaws, back + grip))
    return Revolved(outside, bore=radius)


def is_blank(body: Any) -> TypeGuard[Blank]:
    """Whether something is a blank of any kind."""
    return hasattr(type(body), "faces")


def blank(given: Any) -> Blank | None:
    """What a Setup calls its stock: three sizes, two corners (3,), a blank, or what has one, a workpiece or a design
    (`as_blank`).

    None for what is none of it, or stands nowhere.
    """
    try:
        body = given.as_blank() if hasattr(given, "as_blank") else given
        if not is_blank(body):
            if not isinstance(given, tuple | list | np.ndarray) or np.shape(given) not in ((2, 3), (3,)):
                return None
            numbers = np.asarray(given, dtype=np.float64)
            if numbers.ndim == 1:
                if not (numbers > 0).all():
                    return None
                body = Sized((0.0, 0.0, -float(numbers[2])), (*numbers[:2].tolist(), 0.0))
            else:
                body = Box(*map(tuple, numbers.tolist()))
        good = body.bounds.shape == (2, 3) and bool((np.abs(body.bounds) <= FARTHEST).all())
        if isinstance(body, Revolved):
            profile = np.array(body.profile, dtype=np.float64)
            good &= len(profile) > 1 and len(body.at) == 3 and bool(body.bore >= 0) and bool((profile[:, 0] >= 0).all())
    except (TypeError, ValueError, IndexError, OverflowError):  # of numpy, of what is no number
        return None
    return body if good else None


def from_datum(body: Blank, origin: Array) -> Blank:
    """A blank of a setup in the coordinates of a path that counts from `origin` (3,), machine coordinates."""
    return Box(*body) if isinstance(body, Sized) else body.moved(-origin)


def _widest(profile: Array, along: Array) -> Array:
    """The radius of a body at places along its axis (m,), nan beyond its ends."""
    found = np.full(along.shape, -np.inf)
    for (r0, z0), (r1, z1) in zip(profile[:-1], profile[1:]):
        there = (along >= min(z0, z1)) & (along <= max(z0, z1))
        radius = r0 + (r1 - r0) * (along - z0) / (z1 - z0) if z1 != z0 else np.full(along.shape, max(r0, r1))
        found = np.where(there, np.maximum(found, radius), found)
    return np.where(np.isfinite(found), found, np.nan)


def depth_below(stock: Blank, points: Array) -> Array:
    """How deep places (n, 3) lie below the top of a blank, of a body that lies below its round surface, mm."""
    if not isinstance(stock, Revolved) or stock.axis == "Z":
        return np.asarray(stock.bounds[1, 2] - points[:, 2])
    off = points - stock.at
    along, across = off[:, stock.along], np.delete(off, stock.along, axis=1)
    found = _widest(np.array(stock.profile, dtype=np.float64), along) - np.linalg.norm(across, axis=1)
    return np.where(found > ROUND, found, 0.0)  # nan beyond its ends


def _stacked(profile: Array, bore: float, rho: Array, at: float) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Of a body that stands on its end: lowest and highest place where its profile is as wide as `rho`."""
    low, high = np.full(rho.shape, np.inf), np.full(rho.shape, -np.inf)
    for (r0, z0), (r1, z1) in zip(profile[:-1], profile[1:]):
        with np.errstate(divide="ignore", invalid="ignore"):
            crossing = np.where(r1 == r0, z0, z0 + (z1 - z0) * (rho - r0) / (r1 - r0))
        for z, there in ((z0, rho <= r0), (z1, rho <= r1), (crossing, (rho >= min(r0, r1)) & (rho <= max(r0, r1)))):
            low, high = np.where(there, np.minimum(low, z), low), np.where(there, np.maximum(high, z), high)
    return low + at, high + at, (rho >= bore) & np.isfinite(low)


# A blank as people write it in a file: two corners, or a cylinder.

def blank_of(table: Mapping[str, Any], where: str, file: File, *keys: str) -> Blank:
    """The blank that a table writes, a cylinder where it has a radius, else a box; `keys` lead to it in the file."""
    if "radius" not in table:
        check_names(table, ("low", "high"), f"{where} without a radius", file, *keys)
        corners = []
        for name in ("low", "high"):
            with file.at(*keys, name):
                if name not in table:
                    needs = "needs low and high, two corners [x, y, z], or a radius"
                    raise Alarm(f"{where} {needs}: {where}.{name} is missing")
                corners.append(point_of(table[name], f"{where}.{name}"))
        return Box(*corners)
    check_names(table, ("radius", "low", "high", "bore", "axis", "at"), where, file, *keys)
    numbers = {name: table.get(name, 0.0) for name in ("radius", "low", "high", "bore")}
    for name, number in numbers.items():
        with file.at(*keys, name):
            check_number(number, f"{where}.{name}")
    with file.at(*keys, "at"):
        at = point_of(table.get("at", [0.0, 0.0, 0.0]), f"{where}.at")
    try:
        return cylinder(**numbers, axis=table.get("axis", "Z"), at=at)
    except Alarm as fault:
        raise Alarm(f"{where}: {fault.message}") from None


def point_of(value: Any, where: str) -> tuple[float, float, float]:
    """Three numbers of a list."""
    if not isinstance(value, list) or len(value) != 3:
        raise Alarm(f"{where} must be three numbers [x, y, z], got {shown(value)}")
    for item in value:
        check_number(item, where)
    x, y, z = map(float, value)
    return x, y, z


def table_of(blank: Box | Revolved) -> dict[str, Any]:
    """The table of a box, or of a cylinder: a body of one radius."""
    if isinstance(blank, Box):
        return {"low": blank.low, "high": blank.high}
    (radius, low), *_, (_, high) = blank.profile
    table: dict[str, Any] = {"radius": radius, "low": low, "high": high}
    rest = {"bore": (blank.bore, 0.0), "axis": (blank.axis, "Z"), "at": (blank.at, (0.0, 0.0, 0.0))}
    return table | {name: value for name, (value, usual) in rest.items() if value != usual}

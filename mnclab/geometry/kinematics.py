"""Chains of rotary axes: where the tip of the tool is on the part for positions of the axes, and the way back.

X Y Z are those of the spindle reference, from which the tool reaches its length down while the head stands at zero. A point of
the part is named by where it is while all rotary axes stand at zero. An axis turns right-handed about its direction (ISO 841): a
head turns the tool by its angle, a table the part by minus its angle, so that the tool goes round the part by the angle itself.

                                    part = T(-1) (P + H (0, 0, -length)) + shift
    P: X Y Z    H: the turns of the head, about centres that go with P    T(-1): those of the table, from the part's side
    shift: what a drift moves the part by on its table, or another head the tip

Seen from the part both are one sequence of turns, table axes from the part to the machine, then head axes from the machine to
the tool. Angles are in degrees in what people call, in rad (…, 3) for A, B, C inside.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.text.alarm import Alarm
from mnclab.text.given import LARGEST, check_number, check_point, choice, fitting_class, of_python, shown
from mnclab.text.tables import written

Array = NDArray[np.float64]
Triple = tuple[float, float, float]

NAMES = "ABC"
UP = np.array([0.0, 0.0, 1.0])
FREE = 1e-9  # a direction so near to that of an axis does not say where the axis stands
SHORT = 1e-15  # by which the length of a direction is off that has the length 1
WITHIN = 1e-9  # rad, by which a limit may be passed, of numbers alone


@fitting_class
@dataclass(frozen=True)
class Axis:
    """A rotary axis "A", "B" or "C": it turns right-handed about `direction` (3,), by default that of X, Y or Z, through
    `centre` (3,), mm, in machine coordinates with all axes at zero.

    `limits` and `home`, where it stands at the start, in degrees. `backlash`, degrees, of an axis as it truly is: it stays behind
    by half of it, on the side from which it came. An Alarm names what cannot be.

    >>> mnc.Axis("A", centre=(0, 0, -50), limits=(-30, 120)).limits
    (-30.0, 120.0)
    """

    name: str
    centre: Triple = (0.0, 0.0, 0.0)
    direction: Triple | None = None
    limits: tuple[float, float] = (-math.inf, math.inf)
    home: float = 0.0
    backlash: float = 0.0

    __repr__ = written

    def __post_init__(self) -> None:
        what = f"axis {choice(self.name, 'the name of a rotary axis', NAMES)}"
        direction = np.eye(3)[NAMES.index(self.name)].tolist() if self.direction is None else of_python(self.direction)
        centre, limits = of_python(self.centre), of_python(self.limits)
        for each, meant in ((centre, "centre"), (direction, "direction")):
            check_point(each, f"{meant} of {what}")
            for number in each:
                check_number(number, f"a coordinate of the {meant} of {what}", at_least=-LARGEST, at_most=LARGEST)
        if not (length := math.hypot(*direction)) > FREE:
            raise Alarm(f"direction of {what} must have a length, got {shown(self.direction)}")
        if not isinstance(limits, tuple | list) or len(limits) != 2:
            raise Alarm(f"limits of {what} takes two angles, got {shown(limits)}", hint="limits=(-30, 120)")
        for each in limits:
            check_number(each, f"a limit of {what}", endless=True)
        if not limits[0] < limits[1]:
            raise Alarm(f"limits of {what} must go up, got {limits[0]:g} to {limits[1]:g}")
        check_number(self.home, f"home of {what}", at_least=limits[0], at_most=limits[1])
        check_number(self.backlash, f"backlash of {what}", at_least=0, at_most=180)
        length = length if abs(length - 1) > SHORT else 1.0
        x, y, z = (number / length for number in direction)
        found = {"centre": tuple(map(float, centre)), "direction": (x, y, z), "limits": tuple(map(float, limits))}
        for name, value in (found | {"home": float(self.home), "backlash": float(self.backlash)}).items():
            object.__setattr__(self, name, value)

    @property
    def number(self) -> int:
        """0, 1, 2 for A, B, C."""
        return NAMES.index(self.name)

    def turns(self, angles: Array) -> Array:
        """The turns (…, 4, 4) by angles (…) rad about the centre (Rodrigues)."""
        still, across, beside = self._parts
        s, c = np.sin(angles)[..., None, None], np.cos(angles)[..., None, None]
        return np.asarray(still + s * across + c * beside)

    @cached_property
    def _parts(self) -> tuple[Array, Array, Array]:
        """What of a turn stands still, goes with the sine and with the cosine of the angle, each (4, 4)."""
        k = np.asarray(self.direction)
        (x, y, z), along = k.tolist(), np.outer(k, k)
        across, to_centre = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]), np.eye(4)
        to_centre[:3, 3] = np.negative(self.centre)
        still, sine, cosine = (np.pad(part, (0, 1)) @ to_centre for part in (along, across, np.eye(3) - along))
        still[:, 3] += (*self.centre, 1.0)
        return still, sine, cosine


@fitting_class
@dataclass(frozen=True)
class Kinematics:
    """The rotary axes of a machine: `head` from the machine to the tool, `table` from the machine to the part; `shift` (3,), mm,
    by which the tip is elsewhere on the part than they say, in its coordinates.

    >>> machine = mnc.Kinematics(table=(mnc.Axis("A", limits=(-30, 120)), mnc.Axis("C")))
    >>> tip, direction = machine.forward([[0, 0, 80, 90, 0, 0]], length=80)
    >>> direction.round(9).tolist()  # the part lies on its side
    [[0.0, -1.0, 0.0]]
    """

    head: tuple[Axis, ...] = ()
    table: tuple[Axis, ...] = ()
    title: str = ""
    shift: Triple = (0.0, 0.0, 0.0)

    __repr__ = written

    def __post_init__(self) -> None:
        check_point(shift := of_python(self.shift), "shift of a kinematics")
        for number in shift:
            check_number(number, "a coordinate of the shift of a kinematics", at_least=-LARGEST, at_most=LARGEST)
        object.__setattr__(self, "shift", tuple(map(float, shift)))
        for name in ("head", "table"):
            given = getattr(self, name)
            if not isinstance(given, tuple | list) or not all(isinstance(each, Axis) for each in given):
                raise Alarm(f"{name} must be a tuple of mnclab.Axis, got {shown(given)}", hint='table=(mnclab.Axis("C"),)')
            object.__setattr__(self, name, tuple(given))
        names = [axis.name for axis in (*self.head, *self.table)]
        if not names or len(set(names)) < len(names):
            raise Alarm(f"a kinematics needs one to three rotary axes, each of its own name, got {', '.join(names) or 'none'}")
        if not isinstance(self.title, str):
            raise Alarm(f"title must be a text, got {shown(self.title)}")

    def __str__(self) -> str:
        """`A and C in the table, A from -120 to 120°`."""
        sides = [(each, where) for each, where in ((self.head, "head"), (self.table, "table")) if each]
        said = [f"{' and '.join(axis.name for axis in each)} in the {where}" for each, where in sides]
        bounds = [(axis, axis.limits) for axis in self.sequence if axis.limits != (-math.inf, math.inf)]
        return ", ".join(said + [f"{axis.name} from {low:g} to {high:g}°" for axis, (low, high) in bounds])

    @property
    def sequence(self) -> tuple[Axis, ...]:
        """The axes from the part to the tool."""
        return (*reversed(self.table), *self.head)

    @property
    def names(self) -> str:
        return "".join(sorted(axis.name for axis in self.sequence))

    @property
    def home(self) -> Triple:
        """A, B, C at the start, rad."""
        a, b, c = (next((math.radians(axis.home) for axis in self.sequence if axis.name == name), 0.0) for name in NAMES)
        return a, b, c

    def axis(self, name: str) -> Axis:
        """An axis by its name; an Alarm where there is none."""
        return next(axis for axis in self.sequence if axis.name == choice(name, "a rotary axis", self.names))

    def with_axis(self, new: Axis) -> Kinematics:
        """The same with another axis in the place of that of its name; all others stay where they are."""
        self.axis(new.name)
        head, table = (tuple(new if axis.name == new.name else axis for axis in side) for side in (self.head, self.table))
        return replace(self, head=head, table=table)

    # --- from the axes to the part -----------------------------------------------------------------------------------

    def orientation(self, angles: ArrayLike) -> Array:
        """The axes (…, 3, 3), as columns, of the tool in the part at A, B, C (…, 3) rad."""
        angles = np.asarray(angles, dtype=np.float64)
        found = np.broadcast_to(np.eye(3), (*angles.shape[:-1], 3, 3))
        for axis in self.sequence:
            found = found @ axis.turns(angles[..., axis.number])[..., :3, :3]
        return found

    def carried(self, angles: ArrayLike, length: ArrayLike) -> Array:
        """The maps (…, 4, 4) from where the tip would be with all rotary axes at zero to where it is on the part.

        `angles` (…, 3) rad, `length` (…) mm of the tool. With a head it is moved alone, with a table turned about it.
        """
        angles = np.asarray(angles, dtype=np.float64)
        found = np.broadcast_to(np.eye(4), (*angles.shape[:-1], 4, 4)).copy()
        found[..., :3, 3] = self.shift
        for axis in reversed(self.table):
            found = found @ axis.turns(angles[..., axis.number])
        down = np.multiply.outer(np.asarray(length, dtype=np.float64), -UP)
        swung = np.array(np.broadcast_to(np.eye(4), found.shape))
        if self.head:
            swung[..., :3, 3] = self.swung(down, angles) - down
        return np.asarray(found @ swung)

    def axes_on_part(self, angles: Array) -> Iterator[tuple[Axis, Array, Array]]:
        """The axes of the table, a point (n, 3) and the direction (n, 3) of each on the part at A, B, C (n, 3) rad."""
        found = np.broadcast_to(np.eye(4), (len(angles), 4, 4)).copy()
        found[:, :3, 3] = self.shift
        for axis in reversed(self.table):
            yield axis, moved(found, np.asarray(axis.centre)), found[:, :3, :3] @ np.asarray(axis.direction)
            found = found @ axis.turns(angles[:, axis.number])

    def swung(self, hanging: Array, angles: Array) -> Array:
        """Where points of the tool (…, 3), counted from the spindle reference, are behind the head at A, B, C (…, 3) rad."""
        for axis in reversed(self.head):
            hanging = moved(axis.turns(angles[..., axis.number]), hanging)
        return hanging

    def forward(self, axes: ArrayLike, length: ArrayLike = 0.0) -> tuple[Array, Array]:
        """Where the tip is on the part, and the direction from it along the tool, each (n, 3), mm.

        `axes` (n, 6): X Y Z of the spindle reference, mm, and A B C, degrees; `length` of the tool, mm, one or (n,).
        """
        axes = _rows(axes, 6, "axes")
        length = np.broadcast_to(np.asarray(length, dtype=np.float64), len(axes))
        angles = np.radians(axes[:, 3:])
        return self.tips(axes[:, :3], angles, length), self.orientation(angles)[..., 2]

    def tips(self, reference: Array, angles: Array, length: ArrayLike) -> Array:
        """Tips (…, 3) on the part: `reference` (…, 3) is X Y Z, mm, `angles` (…, 3) rad, `length` (…) mm."""
        hanging = reference - np.multiply.outer(np.asarray(length, dtype=np.float64), UP)
        return moved(self.carried(angles, length), hanging)

    # --- from the part to the axes -----------------------------------------------------------------------------------

    def references(self, tip: Array, angles: Array, length: ArrayLike) -> Array:
        """X Y Z (…, 3) of the spindle reference for tips (…, 3) on the part; `angles` (…, 3) rad, `length` (…) mm."""
        found = self.carried(angles, length)
        turned = found[..., :3, :3]
        hanging = np.einsum("...ji,...j->...i", turned, np.asarray(tip) - found[..., :3, 3])  # the transpose is the inverse
        return np.asarray(hanging + np.multiply.outer(np.asarray(length, dtype=np.float64), UP))

    def tilting(self, using: str | None = None) -> tuple[Axis, ...]:
        """The one or two axes that bring the tool into a direction, from the part to the tool: the last two of those named, by
        default of all, without those behind that turn the tool about itself."""
        named = [axis for axis in self.sequence if using is None or axis.name in using]
        while len(named) > 1 and abs(np.asarray(named[-1].direction) @ UP) > 1 - FREE:
            named.pop()
        return tuple(named[-2:])

    def solutions(self, direction: ArrayLike, near: ArrayLike, using: str | None = None) -> Array:
        """Both ways (2, n, 3) to turn the tool into directions (n, 3) on the part: A, B, C, rad; nan where there is none.

        An angle that is free stays as it is in `near` (n, 3) or (3,), so do axes that are not `using`; any other is the one of
        its turns within its limits that is nearest to `near`. First the one with the tilting axis, the last of the two, from 0
        to half a turn ahead of where the tool lies along the other axis.
        """
        d = _rows(direction, 3, "direction")
        d = d / np.linalg.norm(d, axis=1, keepdims=True)
        now = np.broadcast_to(np.asarray(near, dtype=np.float64), d.shape)
        used = self.tilting(using)
        lines, tool = self._lines(used, now)
        first = now[:, used[0].number]
        pairs = _one(lines[0], tool, d, first) if len(used) == 1 else _two(lines[0], lines[1], tool, d, first)
        found = np.stack([now, now])
        for axis, angles in zip(used, pairs):
            found[..., axis.number] = [_nearest(axis, each, now[:, axis.number]) for each in angles]
        found[np.isnan(found).any(axis=2)] = np.nan
        return found

    def free(self, direction: ArrayLike, near: ArrayLike, using: str | None = None) -> Axis | None:
        """The axis that a direction (3,) on the part leaves free, since it lies along it; None where there is none."""
        used, d = self.tilting(using), _rows(direction, 3, "direction")
        lines, _ = self._lines(used, _rows(near, 3, "near"))
        return used[0] if np.linalg.norm(np.cross(lines[0], d)) < FREE * np.linalg.norm(d) else None

    def _lines(self, used: tuple[Axis, ...], now: Array) -> tuple[list[Array], Array]:
        """The directions (n, 3) of the axes `used` and of the tool on the part, with those at zero and all others at `now`."""
        outer = np.broadcast_to(np.eye(3), (len(now), 3, 3))  # what stands still turns what lies beyond it, seen from the part
        lines = []
        for axis in self.sequence:
            if axis in used:
                lines.append(outer @ np.asarray(axis.direction))
            else:
                outer = outer @ axis.turns(now[:, axis.number])[:, :3, :3]
        return lines, outer[:, :, 2]

    def inverse(
        self, tip: ArrayLike, direction: ArrayLike, length: ArrayLike = 0.0, near: ArrayLike | None = None
    ) -> Array:
        """Positions (n, 6) of the axes, X Y Z mm and A B C degrees, that bring the tip (n, 3) there in a direction (n, 3).

        Of the two ways within the limits the shorter one (sum of the angles) from `near` (3,) or (n, 3), degrees, by default
        home; on a tie that with the tilting axis ahead. An Alarm where there is none.
        """
        tip, direction = _rows(tip, 3, "tip"), _rows(direction, 3, "direction")
        now = np.broadcast_to(np.asarray(self.home) if near is None else np.radians(near), direction.shape)
        both = self.solutions(direction, now)
        best = shorter(both, now)
        if (none := np.isnan(best).any(axis=1)).any():
            k = int(np.argmax(none))
            x, y, z = direction[k].tolist()
            raise Alarm(f"no position of {' and '.join(self.names)} within the limits turns the tool to ({x:g}, {y:g}, {z:g})")
        length = np.broadcast_to(np.asarray(length, dtype=np.float64), len(tip))
        return np.concatenate([self.references(tip, best, length), np.degrees(best)], axis=1)

    def beyond(self, angles: Triple) -> Axis | None:
        """The first axis that A, B, C (3,), rad, would lead beyond its limits."""
        for axis in self.sequence:
            low, high = np.radians(axis.limits)
            if not low - WITHIN <= angles[axis.number] <= high + WITHIN:
                return axis
        return None


def moved(maps: Array, points: Array) -> Array:
    """Points (…, 3) behind maps (…, 4, 4)."""
    return np.asarray(np.einsum("...ij,...j->...i", maps[..., :3, :3], points) + maps[..., :3, 3])


def shorter(both: Array, now: Array) -> Array:
    """Of two ways (2, n, 3) that with the smaller sum of angles from `now` (n, 3), rad; the first on a tie."""
    ways = np.abs(both - now).sum(axis=2)
    ways = np.where(np.isnan(ways), np.inf, ways)
    return np.where((ways[1] < ways[0] - FREE)[:, None], both[1], both[0])


def _rows(given: Any, wide: int, what: str) -> Array:
    found = np.atleast_2d(np.asarray(given, dtype=np.float64))
    if found.ndim != 2 or found.shape[1] != wide:
        raise Alarm(f"{what} must be an array of (n, {wide}), got the shape {np.shape(given)}")
    return found


def _nearest(axis: Axis, angles: Array, now: Array) -> Array:
    """The same angles, some whole turns on, nearest to `now` within the limits of an axis, of two as near the greater; nan where
    none is within."""
    turn = 2 * np.pi
    way = np.mod(angles - now + np.pi, turn) - np.pi
    way = np.where(way < FREE - np.pi, way + turn, way)
    found = angles + turn * np.round((now + way - angles) / turn)
    low, high = np.radians(axis.limits)
    found = found + turn * np.ceil(np.maximum(low - WITHIN - found, 0) / turn) if np.isfinite(low) else found
    found = found - turn * np.ceil(np.maximum(found - high - WITHIN, 0) / turn) if np.isfinite(high) else found
    return np.where((found < low - WITHIN) | (found > high + WITHIN), np.nan, found)


def _about(line: Array, start: Array, end: Array) -> tuple[Array, Array]:
    """The angles (n,) rad about lines (n, 3) from directions to others, and whether they are free."""
    a, b = (v - _dot(v, line)[:, None] * line for v in (start, end))
    free = (np.linalg.norm(a, axis=1) < FREE) | (np.linalg.norm(b, axis=1) < FREE)
    return np.arctan2(_dot(np.cross(a, b), line), _dot(a, b)), free


def _one(line: Array, tool: Array, d: Array, now: Array) -> list[tuple[Array, Array]]:
    """One axis: it reaches what lies as far along it as the tool."""
    angle, free = _about(line, tool, d)
    reached = np.abs(_dot(line, d - tool)) < FREE
    return [(np.where(reached, np.where(free, now, angle), np.nan), np.full(len(d), np.nan))]


def _two(first: Array, last: Array, tool: Array, d: Array, now: Array) -> list[tuple[Array, Array]]:
    """Two axes, the `last` next to the tool: d = R(first) w, w = R(last) tool.

    The turn about `first` leaves the angle t between first and w alone. With a between the axes and b between last and tool,
    cos t = cos a cos b + sin a sin b cos h, where h counts from where w is nearest to first: t goes from |a - b| to a + b. By
    halves of angles, which keep their digits beside 0 and a half turn: sin²(h/2) sin a sin b = sin((t+|a-b|)/2) sin((t-|a-b|)/2).
    """
    a, b, t = _between(first, last), _between(last, tool), _between(first, d)
    least, most = np.abs(a - b), np.pi - np.abs(np.pi - a - b)
    near = np.sin((t + least) / 2) * np.sin((t - least) / 2)
    far = np.sin((most + t) / 2) * np.sin((most - t) / 2)
    half = 2 * np.arctan2(np.sqrt(np.maximum(near, 0)), np.sqrt(np.maximum(far, 0)))
    half = np.where((np.minimum(near, far) < -FREE) | (np.sin(a) * np.sin(b) < FREE), np.nan, half)
    straight = tool - _dot(last, tool)[:, None] * last
    towards = np.arctan2(_dot(first, np.cross(last, tool)), _dot(first, straight))
    tilts = towards + half, towards - half
    swings = []
    for tilt in tilts:
        swing, free = _about(first, _spun(last, tool, tilt), d)
        swings.append(np.where(free, now, swing))
    return [(swings[0], swings[1]), tilts]


def _dot(a: Array, b: Array) -> Array:
    return np.asarray(np.einsum("ij,ij->i", a, b))


def _between(a: Array, b: Array) -> Array:
    """The angles (n,) from 0 to pi between directions (n, 3)."""
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), _dot(a, b))


def _spun(line: Array, v: Array, angle: Array) -> Array:
    """Vectors (n, 3) turned about unit lines (n, 3) by angles (n,) rad."""
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    along = _dot(line, v)[:, None] * line
    return np.asarray(along + c * (v - along) + s * np.cross(line, v))


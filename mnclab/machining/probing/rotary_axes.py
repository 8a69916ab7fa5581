"""Where rotary axes are, by a sphere that was measured at several of their angles (TNC 620, chapter 18): KinematicsOpt.

On a table the sphere goes round the axis, seen from a head the ball goes round it in the other sense: either way points p go from
the first one, p(0), by c + R(k, s phi) (p(0) - c). c and k are found by the least squares of what is left, s is 1 for a head and
-1 for a table. Of what lies between the axis and the tool, or the machine, an error would count as one of the axis: these
axes are looked at first, from the tool to the machine and on to the part.

Lengths in mm, angles in degrees where a name says so, else in rad; places of the axis in machine coordinates, all axes at zero.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from mnclab.geometry.kinematics import Axis, Kinematics, moved
from mnclab.machining.probing.found import Floats

SMALLEST = 1.0  # mm, of the measuring circle, to tell a backlash by it (18.4)
SEEN = 1e-9  # mm, by which an axis moves once more
UNSEEN = 1e-9  # of the sum of 2 - 2 cos phi: the axis stood at zero all the time
TURNED = 1e-6  # rad, by which a direction is turned to see what becomes of the points
SAME = 1e-6  # of its effect, that of a turn beyond what a shift does: it cannot be told from one
SETTLED = 1e-14  # rad
ROUNDS = 40


class Reading(NamedTuple):
    """A sphere that was measured: A, B, C (3,), rad, and X Y Z (3,) of the spindle reference with the ball in its middle."""

    angles: Floats
    place: Floats


class AxisReadings(NamedTuple):
    """Of one axis: the reference at zero, the positions, and those once more that were reached from the other side."""

    reference: Reading
    points: Sequence[Reading]
    again: Sequence[Reading] = ()


@dataclass(frozen=True)
class MeasuredAxis:
    """What was found of an axis: as the control had it (`before`), as it fits best (`after`).

    `angles` (n,) of its positions; `deviations` (n, 3) of the sphere as it was measured from where the axis of before leads
    it, `residuals` (n, 3) from where that of after does; `radius` of the measuring circle. `turned` (3,) rad is the turn
    from the direction of before. `backlash` and `positioning`, degrees, are averages; nan where they are not known.
    """

    before: Axis
    after: Axis
    angles: Floats
    deviations: Floats
    residuals: Floats
    radius: float
    turned: Floats
    backlash: float
    positioning: float

    @property
    def compensation(self) -> Floats:
        """By how much the axis is elsewhere, (3,) mm."""
        return np.subtract(self.after.centre, self.before.centre)

    @property
    def scatter(self) -> float:
        """The standard deviation as it was measured, mm; of one position its spatial error."""
        return _rms(self.deviations)

    @property
    def optimized(self) -> float:
        """The standard deviation that is left, mm."""
        return _rms(self.residuals)

    @property
    def worst(self) -> float:
        """The greatest spatial error, mm."""
        return float(np.linalg.norm(self.deviations, axis=1).max())

    @property
    def angular(self) -> float:
        """By how much the axis lies askew, degrees."""
        return math.degrees(float(np.linalg.norm(self.turned)))

    @property
    def uncertainty(self) -> float:
        """The standard uncertainty of the place of the axis by what is left, mm; nan where nothing is left to tell it."""
        free, lever = 3 * len(self.angles) - 2, float((2 - 2 * np.cos(self.angles)).sum())
        return math.sqrt(float((self.residuals**2).sum()) / free / lever) if free > 0 else math.nan


def _rms(errors: Floats) -> float:
    return math.sqrt(float((errors**2).sum()) / len(errors))


def evaluated(
    kinematics: Kinematics, ball: Floats, readings: Mapping[str, AxisReadings], askew: bool = False
) -> tuple[Kinematics, dict[str, MeasuredAxis]]:
    """The kinematics with its measured axes where they fit best, and what was found of each by its name.

    `ball` (3,) is its middle from the spindle reference while the head stands at zero; `askew`: the direction of an axis
    may be another one too. An axis that never left zero is not measured.
    """
    after, found = kinematics, dict[str, MeasuredAxis]()
    for _ in range(ROUNDS):  # a head that lies askew turns what was seen of the axes that it carries
        last = after
        for axis in reversed(kinematics.sequence):
            if (read := readings.get(axis.name)) is None or not read.points:
                continue
            if (one := _measured(kinematics, after.with_axis(axis), axis, ball, read, askew)) is not None:
                found[axis.name] = one
                after = after.with_axis(one.after)
        moves = [np.abs(np.subtract(after.axis(name).centre, last.axis(name).centre)).max() for name in found]
        if not askew or max(moves, default=0.0) < SEEN:
            break
    return after, {name: found[name] for name in sorted(found)}


def _measured(
    before: Kinematics, known: Kinematics, axis: Axis, ball: Floats, read: AxisReadings, askew: bool
) -> MeasuredAxis | None:
    """One axis; `known` has the axes next to the tool, or the machine, as they were found."""
    sense = 1.0 if axis in before.head else -1.0
    angles = np.array([each.angles[axis.number] for each in read.points])
    if (2 - 2 * np.cos(angles)).sum() < UNSEEN * len(angles):
        return None
    again = read.again or read.points
    middles = [Reading(one.angles, (one.place + two.place) / 2) for one, two in zip(read.points, again, strict=True)]
    start, points = _round_the_axis(known, axis, ball, read.reference, middles)
    after, turned = _fitted(axis, start, points, sense * angles, askew)
    first, seen = _round_the_axis(before, axis, ball, read.reference, middles)
    deviations = -sense * (seen - _led(axis, first, sense * angles))
    radius = _distance(after, start)
    backlash = math.nan
    if read.again and radius > SMALLEST - SAME:
        chords = [float(np.linalg.norm(one.place - two.place)) for one, two in zip(read.points, read.again, strict=True)]
        backlash = math.degrees(float(np.mean([2 * math.asin(min(each / 2 / radius, 1.0)) for each in chords])))
    off = sense * _angles(after, _led(axis, start, sense * angles), points) if radius > SAME else np.array([math.nan])
    return MeasuredAxis(
        axis, after, angles, deviations, -sense * (points - _led(after, start, sense * angles)), radius, turned,
        backlash, math.degrees(float(off.mean())),
    )  # fmt: skip


def _round_the_axis(
    kinematics: Kinematics, axis: Axis, ball: Floats, reference: Reading, readings: Sequence[Reading]
) -> tuple[Floats, Floats]:
    """What goes round an axis (3,), where it is at zero, and where it was found to be at the readings (n, 3)."""
    places = np.array([each.place for each in readings])
    angles = np.array([each.angles for each in readings])
    seen = np.array([reference.place, *places]) + kinematics.swung(
        np.broadcast_to(ball, (len(readings) + 1, 3)), np.array([reference.angles, *angles])
    )
    if axis in kinematics.table:
        for each in kinematics.table[: kinematics.table.index(axis)]:
            seen = moved(each.turns(reference.angles[each.number]), seen)
        return seen[0], seen[1:]
    here = kinematics.head.index(axis)
    start, outer = ball, np.eye(3)
    for each in reversed(kinematics.head[here + 1 :]):
        start = moved(each.turns(reference.angles[each.number]), start)
    for each in kinematics.head[:here]:
        outer = outer @ each.turns(reference.angles[each.number])[:3, :3]
    return start, _led(axis, start, angles[:, axis.number]) - (seen[1:] - seen[0]) @ outer


def _led(axis: Axis, start: Floats, angles: Floats) -> Floats:
    """Where an axis brings a point (3,) by angles (n,): (n, 3)."""
    return moved(axis.turns(angles), start)


def _across(k: Floats) -> Floats:
    """Two directions (2, 3) square to a direction and to each other."""
    first = np.cross(k, np.eye(3)[int(np.argmin(np.abs(k)))])
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(k, first)])


def _distance(axis: Axis, point: Floats) -> float:
    """Of a point (3,) from an axis."""
    return float(np.linalg.norm(np.cross(np.array(axis.direction), point - axis.centre)))


def _angles(axis: Axis, one: Floats, other: Floats) -> Floats:
    """From points (n, 3) to others, counter-clockwise about an axis, (n,) rad."""
    u, v = _across(np.array(axis.direction))
    first, second = (np.arctan2((each - axis.centre) @ v, (each - axis.centre) @ u) for each in (one, other))
    return np.asarray((second - first + np.pi) % (2 * np.pi) - np.pi)


def _fitted(axis: Axis, start: Floats, points: Floats, angles: Floats, askew: bool) -> tuple[Axis, Floats]:
    """The axis about which a point (3,) goes to others (n, 3) by angles (n,), and its turn (3,) rad, by Gauss and Newton.

    It is shifted across its direction alone: along it nothing is seen. What a shift explains is no turn.
    """
    k, found = np.array(axis.direction), axis
    for _ in range(ROUNDS):
        here = np.array(found.direction)
        across = _across(here)
        left = (points - _led(found, start, angles)).ravel()
        turns = found.turns(angles)[:, :3, :3]
        shifts = np.array([(each - turns @ each).ravel() for each in across]).T
        shift, turn = np.linalg.lstsq(shifts, left, rcond=None)[0], np.zeros(2)
        if askew:
            ahead, back = (
                np.array([_led(_turned(found, sign * TURNED * each), start, angles).ravel() for each in across]).T
                for sign in (1, -1)
            )
            tilts = (ahead - back) / (2 * TURNED)
            beyond = tilts - shifts @ np.linalg.lstsq(shifts, tilts, rcond=None)[0]
            u, s, v = np.linalg.svd(beyond, full_matrices=False)
            seen = s > SAME * max(float(np.linalg.norm(tilts)), SMALLEST)
            turn = v[seen].T @ ((u.T @ left)[seen] / s[seen])
            shift = np.linalg.lstsq(shifts, left - tilts @ turn, rcond=None)[0]
        found = replace(found, centre=tuple((found.centre + shift @ across).tolist()))
        found = _turned(found, turn @ across) if turn.any() else found
        if np.abs(turn).max() < SETTLED and np.abs(shift).max() < SETTLED * max(1.0, float(np.abs(start).max())):
            break
    direction = np.array(found.direction) / (np.array(found.direction) @ k)
    centre = np.array(found.centre) - direction * (np.subtract(found.centre, axis.centre) @ k)
    return replace(found, centre=tuple(centre.tolist())), np.cross(k, direction)


def _turned(axis: Axis, by: Floats) -> Axis:
    """The axis turned by a small angle about a direction square to it, (3,) rad."""
    k = np.array(axis.direction)
    return replace(axis, direction=tuple((k + np.cross(by, k)).tolist()))

"""Rotary axes by a measured sphere: the constructed cases of the evaluation (TNC 620, chapter 18), and random machines.

The expected numbers of the first tests are those of `tnc620-kinematics.yaml`, rounded there to six decimals.
"""

import math

import numpy as np
import pytest

from mnclab import Axis, Kinematics
from mnclab.machining.probing.rotary_axes import AxisReadings, Reading, evaluated

NEAR = 1.5e-6
RANDOM = np.random.default_rng(451)
BALL = np.array([0.0, 0.0, -120.0])


def angles(name, degrees):
    found = np.zeros(3)
    found["ABC".index(name)] = math.radians(degrees)
    return found


def table(positions, measured, **more):
    """C in the table through (0, 0), measured as a sphere at 0 and at positions."""
    places = [Reading(angles("C", at), np.array(place) - BALL) for at, place in zip((0, *positions), measured, strict=True)]
    machine = Kinematics(table=(Axis("C"),))
    return evaluated(machine, BALL, {"C": AxisReadings(places[0], places[1:])}, **more)[1]["C"]


THREE, START = (90, 180, 270), (150, 0, 50)
FIRST = (START, (0.03, -149.99, 50), (-149.96, -0.02, 50), (0.01, 149.97, 50))


def test_a_rotary_table_off_its_place():
    found = table(THREE, FIRST)
    assert np.allclose(found.deviations, [(0.03, 0.01, 0), (0.04, -0.02, 0), (0.01, -0.03, 0)], atol=NEAR)
    assert found.scatter == pytest.approx(0.036515, abs=NEAR)
    assert found.worst == pytest.approx(0.044721, abs=NEAR)
    assert np.allclose(found.compensation, (0.02, -0.01, 0), atol=1e-12)
    assert found.optimized < 1e-12
    assert found.radius == pytest.approx(math.hypot(149.98, 0.01), abs=1e-9)  # printed 149.98


def test_the_same_with_scatter():
    found = table(THREE, FIRST + np.array([(0, 0, 0), (0.002, 0, 0.001), (-0.001, 0.002, 0), (0, -0.001, -0.002)]))
    assert found.scatter == pytest.approx(0.036674, abs=NEAR)
    assert np.allclose(found.compensation, (0.020125, -0.009875, 0), atol=NEAR)
    residuals = [(0.002, -0.00025, 0.001), (-0.00125, 0.00175, 0), (-0.00025, -0.001, -0.002)]
    assert np.allclose(found.residuals, residuals, atol=NEAR)
    assert found.optimized == pytest.approx(0.002217, abs=NEAR)
    free, lever = 7, 2 + 4 + 2  # numbers less unknowns; the sum of 2 - 2 cos phi
    assert found.uncertainty == pytest.approx(0.002217 * math.sqrt(3 / free / lever), abs=NEAR)


def test_a_swivel_head():
    """The middle of the ball 120 mm below the reference; the true pivot is 0.010, -0.015 off in Y and Z."""
    positions = (-90, -30, 30, 90)
    told = [(0, -0.025, 0.005), (0, -0.00884, -0.00299), (0, 0.00616, 0.00701), (0, 0.005, 0.025)]
    head = Kinematics(head=(Axis("A"),))
    readings = [Reading(angles("A", 0), np.array([10.0, 20, 150]))]
    for at, deviation in zip(positions, told, strict=True):
        a = math.radians(at)
        below = np.array([0, 120 * math.sin(a), -120 * math.cos(a)])  # BALL turned about X
        readings.append(Reading(angles("A", at), np.array([10.0, 20, 150]) + BALL + deviation - below))
    found = evaluated(head, BALL, {"A": AxisReadings(readings[0], readings[1:])})[1]["A"]
    assert np.allclose(found.deviations, told, atol=1e-12)
    assert found.scatter == pytest.approx(0.019197, abs=2e-6)  # told to five decimals
    assert found.worst == pytest.approx(0.025495, abs=NEAR)
    assert np.allclose(found.compensation, (0, 0.01, -0.015), atol=2e-6)
    assert found.optimized < 5e-6
    assert found.radius == pytest.approx(math.hypot(0.01, 119.985), abs=1e-5)


def test_one_position():
    found = table((90,), FIRST[:2])
    assert found.scatter == pytest.approx(0.031623, abs=NEAR)
    assert np.allclose(found.compensation, (0.02, -0.01, 0), atol=1e-12)
    assert found.optimized < 1e-12


ASKEW = (START, (0.055, -150.014981, 49.924993), (-149.96, -0.07, 49.999965), (-0.015, 149.944981, 50.074972))


def test_an_axis_that_lies_askew():
    shifted = table(THREE, ASKEW)
    assert shifted.scatter == pytest.approx(0.089905, abs=NEAR)
    assert np.allclose(shifted.compensation, (0.020005, -0.035, 0), atol=NEAR)
    assert shifted.optimized == pytest.approx(0.061229, abs=NEAR)
    found = table(THREE, ASKEW, askew=True)
    assert np.allclose(found.compensation, (0.02, -0.01, 0), atol=NEAR)
    assert np.allclose(found.turned, (0.0005, 0, 0), atol=1e-8)
    assert found.angular == pytest.approx(0.028648, abs=NEAR)
    assert found.optimized < 1e-6  # the measured places are told to six decimals


def test_an_axis_that_stops_beside_its_angles():
    off = (0.004, -0.002, 0.007)
    turned = [math.radians(-(at + by)) for at, by in zip(THREE, off, strict=True)]
    found = table(THREE, [(150, 0, 0), *[(150 * math.cos(t), 150 * math.sin(t), 0) for t in turned]])
    told = [(-0.010472, 0, 0), (0, -0.005236, 0), (0.018326, -1.0e-06, 0)]
    assert np.allclose(found.deviations, told, atol=NEAR)
    assert found.scatter == pytest.approx(0.012555, abs=NEAR)
    assert found.positioning == pytest.approx(0.003, abs=NEAR)


@pytest.mark.parametrize(("radius", "calculated"), [(0.9, False), (1.0, True), (150, True)])
def test_backlash(radius, calculated):
    """Half of 0.01 degrees behind on either side; below a measuring circle of 1 mm it is not calculated."""
    def at(phi):
        t = math.radians(-phi)
        return np.array([radius * math.cos(t), radius * math.sin(t), 0.0]) - BALL

    one, two = ([Reading(angles("C", phi), at(phi + sign * 0.005)) for phi in THREE] for sign in (-1, 1))
    read = AxisReadings(Reading(angles("C", 0), at(0)), one, two)
    found = evaluated(Kinematics(table=(Axis("C"),)), BALL, {"C": read})[1]["C"]
    assert np.linalg.norm(one[0].place - two[0].place) == pytest.approx(0.026179939 * radius / 150, abs=1e-9)
    assert found.backlash == pytest.approx(0.01, abs=1e-9) if calculated else math.isnan(found.backlash)
    assert found.scatter < 1e-6


def test_an_axis_that_stood_at_zero_is_not_measured():
    assert evaluated(Kinematics(table=(Axis("C"),)), BALL, {"C": AxisReadings(*[r := Reading(np.zeros(3), BALL)], [r])})[1] == {}


# Random machines: the sphere is measured by the true chain in closed form, X Y Z follow from it.

def chain(spread=0.0, askew=0.0, of=None):
    """A machine near another one."""
    def near(axis):
        direction = np.array(axis.direction) + RANDOM.uniform(-askew, askew, 3)
        return Axis(axis.name, tuple((axis.centre + RANDOM.uniform(-spread, spread, 3)).tolist()), tuple(direction.tolist()))

    return Kinematics(tuple(map(near, of.head)), tuple(map(near, of.table)))


def some(name, *direction):
    return Axis(name, tuple(RANDOM.uniform(-200, 200, 3).tolist()), direction or None)


CHAINS = {
    "table AC": lambda: Kinematics(table=(some("A"), some("C"))),
    "table CA": lambda: Kinematics(table=(some("C"), some("A"))),
    "head CB": lambda: Kinematics(head=(some("C"), some("B"))),
    "head AB": lambda: Kinematics(head=(some("A"), some("B"))),
    "head B, table C": lambda: Kinematics(head=(some("B"),), table=(some("C"),)),
    "nutating table": lambda: Kinematics(table=(some("B", 0, 1, 1), some("C"))),
    "nutating head": lambda: Kinematics(head=(some("C"), some("B", 0, 1, 1))),
    "three axes": lambda: Kinematics(head=(some("A"), some("B")), table=(some("C"),)),
}


def read(true, incidence, ball, sphere, name, positions):
    """What a machine reads of a sphere (3,) on the part: the reference, and one reading at each position."""
    found = []
    for at in (0, *positions):
        stands = np.radians([*incidence])
        stands["ABC".index(name)] = math.radians(at)
        place = true.references(sphere, stands, -ball[2])
        found.append(Reading(stands, place))
    return AxisReadings(found[0], found[1:])


def off_line(axis, other):
    """How far the place of an axis is from the line of another."""
    return float(np.linalg.norm(np.cross(other.direction, np.subtract(axis.centre, other.centre))))


@pytest.mark.parametrize("askew", [0.0, 1e-3])
@pytest.mark.parametrize("name", CHAINS)
def test_random_machines(name, askew):
    for _ in range(20):
        before = CHAINS[name]()
        true = chain(0.5, askew, of=before)
        ball, sphere = np.array([0, 0, -RANDOM.uniform(80, 250)]), RANDOM.uniform(-200, 200, 3)
        incidence = dict.fromkeys("ABC", 0.0) | {axis: RANDOM.uniform(20, 70) for axis in before.names}
        positions = (-80, -25, 35, 90)
        readings = {axis: read(true, incidence.values(), ball, sphere, axis, positions) for axis in before.names}
        after, found = evaluated(before, ball, readings, askew=bool(askew))
        assert list(found) == list(before.names)
        for axis in after.sequence:
            assert off_line(axis, true.axis(axis.name)) < (1e-7 if askew else 1e-9)
            assert np.linalg.norm(np.cross(axis.direction, true.axis(axis.name).direction)) < 1e-10
            along = np.subtract(axis.centre, before.axis(axis.name).centre) @ before.axis(axis.name).direction
            assert abs(along) < 1e-9  # what cannot be seen stays
            assert found[axis.name].optimized < 1e-8


def test_a_turn_that_a_shift_explains_is_none():
    """A head C with the ball on its axis: where the axis goes through is seen, not how it lies."""
    before = Kinematics(head=(Axis("C", (0, 0, 150)),))
    true = Kinematics(head=(Axis("C", (0.3, -0.2, 150)),))
    readings = {"C": read(true, (0, 0, 0), BALL, np.array([10.0, 20, 30]), "C", (90, 180, 270))}
    found = evaluated(before, BALL, readings, askew=True)[1]["C"]
    assert np.allclose(found.compensation, (0.3, -0.2, 0), atol=1e-9)
    assert found.angular < 1e-9

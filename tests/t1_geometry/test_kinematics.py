"""Chains of rotary axes: forward and inverse against each other, closed forms, and what a chain cannot do."""

import itertools
import json
import math
from pathlib import Path

import numpy as np
import pytest

from mnclab import Alarm, Axis, Kinematics

RANDOM = np.random.default_rng(39)


def axis(name, **more):
    return Axis(name, centre=tuple(RANDOM.uniform(-200, 200, 3).round(3)), **more)


CHAINS = {
    "table AC": Kinematics(table=(axis("A"), axis("C"))),
    "table BC": Kinematics(table=(axis("B"), axis("C"))),
    "head CB": Kinematics(head=(axis("C"), axis("B"))),
    "head CA": Kinematics(head=(axis("C"), axis("A"))),
    "head AB": Kinematics(head=(axis("A"), axis("B"))),
    "head B, table C": Kinematics(head=(axis("B"),), table=(axis("C"),)),
    "table AB": Kinematics(table=(axis("A"), axis("B"))),
    "nutating table": Kinematics(table=(axis("B", direction=(0, 1, 1)), axis("C"))),
    "nutating head": Kinematics(head=(axis("C"), axis("B", direction=(0, 1, 1)))),
    "three axes": Kinematics(head=(axis("A"), axis("B")), table=(axis("C"),)),
    "one axis": Kinematics(table=(axis("B"),)),
}


def poses(chain: Kinematics, n: int) -> np.ndarray:
    """Random positions of the axes (n, 6)."""
    found = np.zeros((n, 6))
    found[:, :3] = RANDOM.uniform(-500, 500, (n, 3))
    for each in chain.sequence:
        found[:, 3 + each.number] = RANDOM.uniform(-180, 180, n)
    return found


@pytest.mark.parametrize("name", CHAINS)
def test_the_inverse_leads_back(name):
    chain, length = CHAINS[name], RANDOM.uniform(0, 200, 10_000)
    axes = poses(chain, 10_000)
    tip, direction = chain.forward(axes, length)
    back = chain.inverse(tip, direction, length, near=axes[:, 3:])
    assert np.abs(back - axes).max() < 1e-6  # degrees: beside a pole an angle has few digits
    again, same = chain.forward(back, length)
    assert np.abs(again - tip).max() < 1e-9
    assert np.abs(same - direction).max() < 1e-12


@pytest.mark.parametrize("name", [name for name, chain in CHAINS.items() if len(chain.tilting()) == 2])
def test_every_orientation_in_five_degrees(name):
    chain = CHAINS[name]
    one, other = chain.tilting()
    axes = np.zeros((73 * 73, 6))
    grid = np.array([*itertools.product(range(-180, 181, 5), repeat=2)])
    axes[:, 3 + one.number], axes[:, 3 + other.number] = grid.T
    tip, direction = chain.forward(axes, 100)
    again, same = chain.forward(chain.inverse(tip, direction, 100), 100)
    assert np.abs(again - tip).max() < 1e-9
    assert np.abs(same - direction).max() < 1e-12


def test_both_solutions_turn_the_tool_there():
    chain = CHAINS["table AC"]
    directions = RANDOM.normal(size=(1000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    for found in chain.solutions(directions, (0.0, 0.0, 0.0)):
        assert np.abs(chain.orientation(found)[:, :, 2] - directions).max() < 1e-12
        assert np.abs(found).max() <= math.pi + 1e-12
    first, second = chain.solutions(directions, (0.0, 0.0, 0.0))
    assert (first[:, 0] >= 0).all() and np.abs(first[:, 0] + second[:, 0]).max() < 1e-12


@pytest.mark.parametrize("degrees", [0, 15, 45, 90, 120, 180, 270])
def test_a_round_table_turns_the_part_the_other_way(degrees):
    """The tool at (100, 0) over a table that has turned by phi stands over the place at +phi of the part (ISO 841)."""
    chain = Kinematics(table=(Axis("C"),))
    tip, direction = chain.forward([[100, 0, 80, 0, 0, degrees]], length=80)
    phi = math.radians(degrees)
    np.testing.assert_allclose(tip, [[100 * math.cos(phi), 100 * math.sin(phi), 0]], atol=1e-12)
    np.testing.assert_allclose(direction, [[0, 0, 1]], atol=1e-15)


def test_a_head_swings_the_tip_about_its_pivot():
    """A pivot 150 mm above the nose and a tool of 80 mm: at B30 the tip swings by 230 sin 30 to -X and rises."""
    chain = Kinematics(head=(Axis("B", centre=(0, 0, 150)),))
    tip, direction = chain.forward([[10, 20, 300, 0, 30, 0]], length=80)
    swung = 230 * math.sin(math.radians(30))
    np.testing.assert_allclose(tip, [[10 - swung, 20, 300 + 150 - 230 * math.cos(math.radians(30))]], atol=1e-12)
    np.testing.assert_allclose(direction, [[0.5, 0, math.sqrt(0.75)]], atol=1e-15)


def test_a_trunnion_turns_about_its_axis():
    """A through (0, 0, 50): at A90 the part's +Y lies along the machine's -Z, and the tool along the part's -Y."""
    chain = Kinematics(table=(Axis("A", centre=(0, 0, 50)),))
    tip, direction = chain.forward([[0, 0, 50, 90, 0, 0]])
    np.testing.assert_allclose(tip, [[0, 0, 50]], atol=1e-12)  # on the axis nothing moves
    np.testing.assert_allclose(direction, [[0, -1, 0]], atol=1e-15)
    tip, _ = chain.forward([[0, 0, 60, 90, 0, 0]])  # 10 mm above it
    np.testing.assert_allclose(tip, [[0, -10, 50]], atol=1e-12)


def test_the_free_axis_stays_and_ways_are_short():
    chain = CHAINS["table AC"]
    np.testing.assert_allclose(chain.inverse([[0, 0, 0]], [[0, 0, 1]], near=[[30, 0, 77]])[0, 3:], [0, 0, 77], atol=1e-12)
    tilted = [[0, -math.sin(0.5), math.cos(0.5)]]
    np.testing.assert_allclose(chain.inverse([[0, 0, 0]], tilted)[0, 3:], [math.degrees(0.5), 0, 0], atol=1e-9)
    np.testing.assert_allclose(chain.inverse([[0, 0, 0]], tilted, near=[[0, 0, 350]])[0, 3:], [math.degrees(0.5), 0, 360])
    across = [[math.sin(0.5), 0, math.cos(0.5)]]  # both ways are as long: A ahead
    np.testing.assert_allclose(chain.inverse([[0, 0, 0]], across)[0, 3:], [math.degrees(0.5), 0, 90], atol=1e-9)


def test_limits_choose_the_other_way_or_none():
    chain = Kinematics(table=(Axis("A", limits=(-120, 10)), Axis("C")))
    tilted = [[0, -math.sin(0.5), math.cos(0.5)]]
    np.testing.assert_allclose(chain.inverse([[0, 0, 0]], tilted)[0, 3:], [-math.degrees(0.5), 0, 180], atol=1e-9)
    narrow = Kinematics(table=(Axis("A", limits=(-10, 10)), Axis("C")))
    with pytest.raises(Alarm, match="no position of A and C within the limits"):
        narrow.inverse([[0, 0, 0]], tilted)
    with pytest.raises(Alarm, match="no position of B"):
        CHAINS["one axis"].inverse([[0, 0, 0]], tilted)


@pytest.mark.parametrize(
    "wrong, said",
    [
        (lambda: Axis("U"), "rotary axis"),
        (lambda: Axis("A", direction=(0, 0, 0)), "must have a length"),
        (lambda: Axis("A", limits=(10, -10)), "must go up"),
        (lambda: Axis("A", limits=(0, 90), home=-5), "home"),
        (lambda: Kinematics(), "one to three"),
        (lambda: Kinematics(table=(Axis("C"), Axis("C"))), "own name"),
        (lambda: Kinematics(head=("B",)), "tuple of mnclab.Axis"),
        (lambda: CHAINS["table AC"].forward([[1, 2, 3]]), "shape"),
    ],
)
def test_what_is_none(wrong, said):
    with pytest.raises(Alarm, match=said):
        wrong()


RECORDED = json.loads((Path(__file__).parents[1] / "authorities" / "kinematics.json").read_text("utf-8"))


@pytest.mark.parametrize("module, tilting", [("xyzac-trt", "A"), ("xyzbc-trt", "B")])
def test_tables_of_linuxcnc(module, tilting):
    """The tips that LinuxCNC's own modules give (recorded). Version 2.9 turns the other way than ISO 841: so do the axes here.

    C stands at the rotation point, the tilting axis by the offsets beside it; the tip there counts the tool along Z in.
    """
    for case in RECORDED[module]:
        pins, joints = case["pins"], case["joints"]
        centre = np.array([pins[f"{axis}-rot-point"] for axis in "xyz"])
        beside = centre + [pins[f"{axis}-offset"] for axis in "xyz"]
        backwards = tuple(-np.eye(3)["ABC".index(tilting)])
        table = (Axis(tilting, tuple(beside), backwards), Axis("C", tuple(centre), (0, 0, -1)))
        axes = np.zeros(6)
        axes[:3], axes[3 + "ABC".index(tilting)], axes[5] = joints[:3], joints[3], joints[4]
        tip, _ = Kinematics(table=table).forward([axes], pins["tool-offset"])
        np.testing.assert_allclose(tip[0] + [0, 0, pins["tool-offset"]], case["tip"], atol=1e-9)
        as_iso = Kinematics(table=(Axis(tilting, tuple(beside)), Axis("C", tuple(centre))))  # a twin that must not fit
        assert np.abs(as_iso.forward([axes], pins["tool-offset"])[0][0] + [0, 0, pins["tool-offset"]] - case["tip"]).max() > 1


@pytest.mark.parametrize("name", CHAINS)
def test_a_shift_moves_the_part_alone(name):
    """By it the tip is elsewhere on the part at every position; directions, and the way back, go with it."""
    chain = CHAINS[name]
    moved = Kinematics(chain.head, chain.table, shift=(0.3, -0.2, 0.1))
    axes, length = poses(chain, 200), RANDOM.uniform(0, 200, 200)
    (tip, direction), (there, same) = chain.forward(axes, length), moved.forward(axes, length)
    assert np.abs(there - tip - moved.shift).max() < 1e-9 and (direction == same).all()
    back = moved.inverse(there, same, length, near=axes[:, 3:])
    assert np.abs(moved.forward(back, length)[0] - there).max() < 1e-9


def test_an_axis_takes_the_place_of_its_name():
    chain = CHAINS["head B, table C"]
    new = Axis("C", centre=(1, 2, 3))
    found = chain.with_axis(new)
    assert found.table == (new,) and found.head == chain.head and found.with_axis(chain.table[0]) == chain
    with pytest.raises(Alarm, match="a rotary axis"):
        chain.with_axis(Axis("A"))


def test_what_is_swung_by_the_head():
    """A point of the tool (…, 3) goes round the pivot: B by 90 degrees brings what hangs below to the back of X."""
    head = Kinematics(head=(Axis("B", centre=(0, 0, 180)),), table=(Axis("C"),))
    assert np.allclose(head.swung(np.array([0.0, 0, -120]), np.radians([0, 90, 45])), (-300, 0, 180))
    points = RANDOM.uniform(-50, 50, (7, 3))
    assert np.allclose(head.swung(points, np.zeros((7, 3))), points)

"""Where a tool meets a tool setter: closed forms worked out here, and bodies of points that move in small steps."""

import math
import random

import numpy as np
import pytest

import mnclab as mnc
from mnclab.machine.setup_file import load
from mnclab.machine.tool_setting import at_setter, way_to
from mnclab.machining.steps import RAPID, Go, Touch
from mnclab.running.interpreter import Interpreter

PLATE = mnc.Setter(x=10, y=20, z=-30, diameter=16)
BEAM = mnc.Setter(x=10, y=20, z=-30, axis="X")


def machine(tool, setter=PLATE, at=(10.0, 20.0, 0.0), true=None, turning=0, angle=0.0):
    """A machine with the tool in the spindle, its tip by the table at a place."""
    setup = mnc.Setup(tools={1: tool}, true_tools={} if true is None else {1: true}, setter=setter)
    control = mnc.controls["mnc"]
    m = Interpreter(control, setup, control.read("", "")).machine
    m.change_tool(m.tables.tools[1])
    m.tip = at
    m.read_position()
    m.spindle_angle, m.turning = angle, turning
    return m


def down(tool, setter=PLATE, at=(10.0, 20.0, 0.0), **more):
    return way_to(machine(tool, setter, at, **more), setter, at, (0.0, 0.0, -1.0))


def along(tool, at, way=(-1.0, 0.0, 0.0), setter=PLATE, **more):
    return way_to(machine(tool, setter, at, **more), setter, at, way)


@pytest.mark.parametrize(
    ("tool", "x", "lower"),
    [
        (mnc.Tool(radius=5), 10, 0), (mnc.Tool(radius=5), 22.9, 0), (mnc.Tool(radius=5), 23.1, None),
        (mnc.Tool(radius=5, corner=5), 18, 0),  # the south pole over the rim
        (mnc.Tool(radius=5, corner=5), 21, 1), (mnc.Tool(radius=5, corner=5), 22, 2),  # 3 beside it: 5 - sqrt(25 - 9) = 1; 4: 2
        (mnc.Tool(radius=5, corner=2), 21, 0), (mnc.Tool(radius=5, corner=2), 23, 2),
        (mnc.Tool(radius=5, angle=90, kind="drill"), 10, 0), (mnc.Tool(radius=5, angle=90, kind="drill"), 20, 2),
    ],
)  # fmt: skip
def test_down_on_a_plate(tool, x, lower):
    """30 mm to the plate, and as much more as the tool is higher over the rim at X18 than at its tip."""
    found = down(tool, at=(float(x), 20.0, 0.0))
    assert found is None if lower is None else found == pytest.approx(30 + lower)


@pytest.mark.parametrize(
    ("tool", "below", "radius"),
    [
        (mnc.Tool(radius=5), 1, 5), (mnc.Tool(radius=5), -1, None), (mnc.Tool(radius=5, corner=5), 2, 4),
        (mnc.Tool(radius=5, corner=5), 7, 5), (mnc.Tool(radius=5, corner=2), 0.8, 4.6),  # 3 + sqrt(4 - 1.44)
        (mnc.Tool(radius=5, angle=90, kind="drill"), 3, 3), (mnc.Tool(radius=5, angle=90, kind="drill"), 6, 5),
    ],
)  # fmt: skip
def test_from_the_side(tool, below, radius):
    """From X60 to the rim at X18, the tip so far below the upper side; 3 mm off the middle the rim is nearer."""
    found = along(tool, (60.0, 20.0, -30.0 - below))
    assert found is None if radius is None else found == pytest.approx(60 - 18 - radius)
    if radius:
        off = along(tool, (60.0, 23.0, -30.0 - below))
        assert off == pytest.approx(50 - math.sqrt((8 + radius) ** 2 - 9))
        assert along(tool, (60.0, 20.0 + 8.1 + radius, -30.0 - below)) is None
        assert along(tool, (60.0, 20.0, -30.0 - below), (1.0, 0.0, 0.0)) is None


def test_the_true_length_counts():
    table, true = mnc.Tool(radius=5, length=100, dl=0.2), mnc.Tool(radius=4, length=101)
    assert down(table, true=true) == pytest.approx(30 - 0.8)
    assert along(table, (60.0, 20.0, -30.5), true=true) == pytest.approx(60 - 18 - 4)
    assert along(table, (60.0, 20.0, -29.0), true=true) is None


def test_single_edges():
    """Of four the first points to -X at 0 degrees, where the second points to +Y: they come by in the order of the angles."""
    edges = ((0.1, -0.5), (-0.2, 0.3), (0.3, 0.1), (0.0, 0.0))
    table = mnc.Tool(radius=10, length=50, teeth=4)
    true = mnc.Tool(radius=10, length=50, edges=edges)
    for k, (longer, wider) in enumerate(edges):
        beside = along(table, (60.0, 20.0, -31.0), true=true, angle=90.0 * k)
        assert beside == pytest.approx(60 - 18 - 10 - wider)
        one = down(table, at=(26.0, 20.0, 0.0), true=true, angle=90.0 * k)  # the others stand beside the plate
        assert one == pytest.approx(30 - longer)
        assert down(table, at=(15.0, 20.0, 0.0), true=true, angle=90.0 * k) == pytest.approx(30 - 0.3)  # all lie on it
    assert along(table, (60.0, 20.0, -31.0), true=true, turning=1) == pytest.approx(60 - 18 - 10.3)
    assert down(table, at=(26.0, 20.0, 0.0), true=true, turning=-1) == pytest.approx(30 - 0.3)
    assert along(table, (60.0, 20.0, -29.8), true=true, turning=1) == pytest.approx(60 - 18 - 10.1)  # the third alone is so long


def test_a_tool_that_runs_out():
    """Its axis stands at (0.3, 0.4) beside that of the spindle; at 90 degrees at (-0.4, 0.3); turning it is 0.5 wider."""
    table, true = mnc.Tool(radius=5), mnc.Tool(radius=5, runout=(0.3, 0.4))
    at = (60.0, 20.0, -31.0)
    assert along(table, at, true=true) == pytest.approx(50.3 - math.sqrt(13**2 - 0.4**2))
    assert along(table, at, true=true, angle=90.0) == pytest.approx(49.6 - math.sqrt(13**2 - 0.3**2))
    assert along(table, at, true=true, turning=1) == pytest.approx(50 - 13.5)


@pytest.mark.parametrize("axis", ["X", "Y"])
def test_a_beam(axis):
    """It has no thickness and no end; a flat tool breaks it anywhere above its end, a ball where it is low enough."""
    beam = mnc.Setter(x=10, y=20, z=-30, axis=axis, slope=0.01)
    k = 1 if axis == "X" else 0  # across
    middle = [10.0, 20.0]
    middle[1 - k] += 40  # along it: it rises by 0.4
    at = (*middle, 0.0)
    assert down(mnc.Tool(radius=5), beam, at) == pytest.approx(30 - 0.4)
    aside = list(middle)
    aside[k] += 3
    assert down(mnc.Tool(radius=5, corner=5), beam, (*aside, 0.0)) == pytest.approx(30 - 0.4 + 1)
    aside[k] += 3
    assert down(mnc.Tool(radius=5), beam, (*aside, 0.0)) is None
    aside[k] = middle[k] + 50
    way = (0.0, -1.0, 0.0) if k else (-1.0, 0.0, 0.0)
    assert along(mnc.Tool(radius=5), (*aside, -30.0), way, beam) == pytest.approx(45)
    assert along(mnc.Tool(radius=5), (*aside, -29.0), way, beam) is None
    assert along(mnc.Tool(radius=5), (*aside, -30.0), (way[1], way[0], 0.0), beam) is None  # beside it, along it
    true = mnc.Tool(radius=5, edges=((0, 0.2), (0.1, 0)))
    assert along(mnc.Tool(radius=5), (*aside, -30.0), way, beam, true=true) == pytest.approx(44.8)  # it counts as turning


def body(tool, dice):
    """Points of a turned tool, as the library draws no tool here: heights by the shape's own words."""
    rho = np.concatenate([np.linspace(0, tool.radius, 400), np.full(1, tool.radius)])
    height = np.zeros_like(rho)
    if tool.corner:
        out = np.maximum(rho - (tool.radius - tool.corner), 0)
        height = tool.corner - np.sqrt(np.maximum(tool.corner**2 - out**2, 0))
    turn = np.linspace(0, math.tau, 721)
    low = np.stack([np.outer(rho, np.cos(turn)), np.outer(rho, np.sin(turn)), np.outer(height, np.ones_like(turn))], -1)
    rim = np.stack(np.broadcast_arrays(tool.radius * np.cos(turn), tool.radius * np.sin(turn), 500.0), -1)
    return np.concatenate([low.reshape(-1, 3), rim])


@pytest.mark.parametrize("seed", range(20))
def test_points_of_the_tool_meet_the_plate_there_and_not_before(seed):
    """Just before the contact no point of the tool is in the plate, just behind one is."""
    dice = random.Random(seed)
    u = dice.uniform
    radius = u(1, 15)
    tool = mnc.Tool(radius=radius, corner=dice.choice([0.0, radius, radius * u(0.1, 0.9)]))
    setter = mnc.Setter(u(-50, 50), u(-50, 50), u(-50, 0), u(5, 40))
    angle = u(0, math.tau)
    if seed % 2:  # from above, somewhere over it
        far = u(0, 0.98) * (setter.diameter / 2 + radius)
        at = (setter.x + far * math.cos(angle), setter.y + far * math.sin(angle), setter.z + 30)
        way = (0.0, 0.0, -1.0)
    else:  # along a line that passes it
        off = u(-0.7, 0.7) * setter.diameter / 2
        c, s = math.cos(angle), math.sin(angle)
        at = (setter.x + 100 * c - off * s, setter.y + 100 * s + off * c, setter.z - u(0.3, 1) * (radius + 1))
        way = (-c, -s, 0.0)
    found = way_to(machine(tool, setter, at), setter, at, way)
    points = body(tool, dice) + at

    def inside(travel):
        moved = points + np.array(way) * travel
        away = np.hypot(moved[:, 0] - setter.x, moved[:, 1] - setter.y)
        upper = moved[:, 2] < setter.z if seed % 2 else np.ones(len(moved), bool)
        sides = (moved[:, 2] <= setter.z) if not seed % 2 else upper
        return bool(((away < setter.diameter / 2) & sides).any())

    assert not inside(found - 1e-6) and inside(found + 0.03)


def test_positioning_must_not_meet_the_plate():
    tool = mnc.Tool(radius=5, length=50)
    m = machine(tool, at=(60.0, 20.0, -31.0))
    with pytest.raises(mnc.Alarm, match="path obstructed: the tool touches the tool setter while positioning"):
        at_setter(m, Go("beside", x=-40.0))
    assert m.tip == pytest.approx((23, 20, -31))
    at_setter(m, Go("away from it", x=60.0))
    at_setter(m, Go("up", 5.0))
    at_setter(m, Go("over it", x=10.0))
    with pytest.raises(mnc.Alarm, match="path obstructed"):
        at_setter(m, Go("down", -31.0))
    assert m.tip[2] == pytest.approx(-30)
    beam = machine(tool, BEAM, at=(10.0, 60.0, -31.0))
    at_setter(beam, Go("through the beam", y=-60.0))  # light does not stop a tool
    assert beam.tip == (10, -60, -31)


def test_a_touch_that_is_too_short_or_too_late():
    tool = mnc.Tool(radius=5, length=50)
    m = machine(tool)
    with pytest.raises(mnc.Alarm, match="the tool setter did not trigger within 20 mm"):
        at_setter(m, Touch("down", 10.0, 20.0, -20.0, 100.0))
    assert m.tip == (10, 20, -20)  # there it stands
    assert not at_setter(machine(tool), Touch("down", 10.0, 20.0, -20.0, 100.0, miss="return")).hit
    found = at_setter(machine(tool), Touch("down", 10.0, 20.0, -60.0, RAPID))
    assert found.hit and found.tip == pytest.approx((10, 20, -30))
    for setter in (PLATE, BEAM):
        with pytest.raises(mnc.Alarm, match="the tool has reached the tool setter before it is measured"):
            at_setter(machine(tool, setter, at=(10.0, 20.0, -30.0)), Touch("down", 10.0, 20.0, -60.0, 100.0))


def test_the_record_of_a_setter(tmp_path):
    file = tmp_path / "setup.toml"
    file.write_text('[setter]\nx = 10\ny = 20\nz = -30\naxis = "Y"\nslope = 0.001\noff = [0.1, 0.2, 0.3]\n')
    setter = load(file).setter
    assert setter == mnc.Setter(10, 20, -30, axis="Y", slope=0.001, off=(0.1, 0.2, 0.3))
    assert setter.place == pytest.approx((10.1, 20.2, -29.7)) and setter.radius == 0 and PLATE.radius == 8
    assert repr(setter) == "Setter(x=10, y=20, z=-30, axis='Y', slope=0.001, off=(0.1, 0.2, 0.3))"
    assert "setter: x 10 mm, y 20 mm, z -30 mm, axis Y, slope 0.001, off 0.1 0.2 0.3 mm" in repr(load(file))


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"axis": "Z"}, 'the axis of a tool setter must be "X", "Y", or "" of a plate, got \'Z\''),
        ({"diameter": 0}, "the diameter of a tool setter must be greater than 0, got 0"),
        ({"x": "1"}, "the x of a tool setter must be a number, got '1'"),
        ({"slope": math.nan}, "the slope of a tool setter must be a finite number, got nan"),
        ({"off": 3}, "the place off of a tool setter must be three numbers (x, y, z), got 3"),
    ],
)
def test_nonsense_of_a_setter_is_an_alarm(wrong, sentence):
    with pytest.raises(mnc.Alarm) as refused:
        mnc.Setter(**wrong)
    assert refused.value.message == sentence


def test_a_setup_takes_nothing_else():
    with pytest.raises(mnc.Alarm, match="setter must be a Setter, got 3"):
        mnc.Setup(setter=3)


def test_a_plate_is_a_body_and_a_beam_is_none():
    """What a picture shows and a collision meets: 1 mm above it nothing, in the middle of its 10 mm material."""
    assert BEAM.part is None
    part = mnc.Setter(x=10, y=20, z=-30, diameter=16, off=(1, 0, 0)).part
    assert part([(11, 20, -29), (11, 20, -35), (20, 20, -35)]).tolist() == pytest.approx([1, -5, 1])

"""A stock: what a tool leaves, sides that are open, no way through air; areas in closed form, sweeps by shapely."""

import math

import numpy as np
import pytest
import shapely

import mnclab
from mnclab import Alarm, area, compare
from mnclab.geometry.sweeps import polygons
from mnclab.strategies import STRATEGIES, rest

BOX = area.Region.of(area.rectangle(60, 40))
RIGHT = area.Region.of(area.rectangle(20, 60, centre=(20, 0)))  # x from 10 to 30: the third of the box on the right
CORNERS = 4 - math.pi  # of a rectangle, of what a tool of radius 1 leaves in its four


@pytest.mark.parametrize("radius", [1.0, 4.0, 7.5])
def test_a_tool_leaves_the_corners(radius):
    left = rest(BOX, radius)
    assert left.area == pytest.approx(CORNERS * radius**2, abs=1e-9) and len(left.parts) == 4
    assert rest(BOX, mnclab.Tool(radius=radius)).area == left.area


def test_one_tool_after_another():
    after = rest(BOX, 3.0, rest(BOX, 8.0))
    assert after.area == pytest.approx(CORNERS * 9, abs=1e-9)
    assert rest(BOX, 8.0, after).area == pytest.approx(after.area, abs=1e-9)
    assert rest(BOX, 3.0, RIGHT).area == pytest.approx(CORNERS * 9 / 2, abs=1e-9)


def test_nothing_or_everything_is_left():
    assert rest(BOX, 25.0).area == pytest.approx(2400)  # it does not fit
    slot = area.Region.of(area.slot(area.Contour([(0, 0), (30, 0)], closed=False), 8))
    assert rest(slot, 4.0).area == pytest.approx(0, abs=1e-6)  # one stroke
    assert rest(area.Region.of(area.Contour.circle((1, 2), 5)), 2.0).area == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("name", STRATEGIES)
def test_open_sides(name):
    """Of the box only the right third stands: it is cleared, and no pass runs farther than a tool diameter from it."""
    trial = compare(BOX, 3.0, name, stepover=2.0, stock=RIGHT)[name]
    stands = polygons(RIGHT.intersection(BOX))
    lines = [shapely.LineString(way.points_within(1e-3)) for way in trial.clearing.passes]
    swept = shapely.union_all([line.buffer(3, quad_segs=64) for line in lines])
    # the four corners of the box are out of reach; two of them stand
    assert stands.difference(swept).area == pytest.approx(CORNERS * 9 / 2, abs=0.08)
    assert trial.covered > 0.9999
    whole = compare(BOX, 3.0, name, stepover=2.0)[name]
    assert trial.length(rapid=False) < 0.75 * whole.length(rapid=False)
    spots = np.vstack([way.points_within(1e-3) for way in trial.clearing.passes])
    assert shapely.distance(stands, shapely.points(spots)).max() < 6
    assert trial.clearing.centres.inset(-1e-6).contains(spots).all()
    # what is cut is what stood: width times way, but for entries
    cut = float(trial.engagement.step @ trial.engagement.width)
    assert cut <= stands.area * 1.06


def test_the_stock_of_a_coarse_tool():
    left = rest(BOX, 8.0)
    found = compare(BOX, 2.0, "adaptive", "rings", stepover=1.0, stock=left)
    for trial in found.trials:
        assert trial.covered > 0.9999
        assert trial.length(rapid=False) < 400  # all of the box takes more than 2000 mm
    assert found["adaptive"].rest.area < 0.05


def test_the_smallest_radius():
    found = compare(BOX, 3.0, "rounded rings", "adaptive", stepover=2.0, smallest=1.0)
    for trial in found.trials:
        inner = [way for way, label in zip(trial.clearing.passes, trial.clearing.labels) if label.startswith("ring")]
        radii = np.concatenate([way.radii[np.abs(way.sweeps) > 1e-6] for way in inner] or [np.array([1.0])])
        assert radii.min() > 1 - 1e-6


@pytest.mark.parametrize(
    "options, said",
    [
        ({"stock": 3}, "must be a Region"),
        ({"stock": area.Region.of(area.rectangle(2, 2, centre=(90, 0)))}, "nothing of the stock"),
        ({"stock": area.Region()}, "nothing of the stock"),
        ({"smallest": 0}, "smallest radius"),
        ({"smallest": 4}, "smallest radius"),
        ({"smallest": 1, "strategies": ["rings"]}, "none of them is compared"),
        ({"stock": RIGHT, "coarse": 8.0, "strategies": ["fine"]}, "coarse"),
    ],
)
def test_faults(options, said):
    with pytest.raises(Alarm, match=said):
        compare(BOX, 3.0, options.pop("strategies", ["adaptive"]), **options)


@pytest.mark.parametrize("given", [("x", 3), (BOX, "x"), (BOX, 0), (BOX, 3, "x"), (BOX, float("nan"))])
def test_faults_of_what_a_tool_leaves(given):
    with pytest.raises(Alarm):
        rest(*given)

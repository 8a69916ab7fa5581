"""Levels one below the other, upright walls and walls with a draft: lengths and volumes by hand, no way into a slope."""

import math

import numpy as np
import pytest
from tools.together import deep_but_one_in

import mnclab
from mnclab import Alarm, Tool, area, compare, tool_sets
from mnclab.machining.milling.clearing import LINKED
from mnclab.strategies import STRATEGIES, Entry

BOX = area.Region.of(area.rectangle(60, 40))
ISLAND = area.Region.of(area.rectangle(60, 40), holes=[area.Contour.circle((3, 2), 6)])
HAND = {"overlap": 0.5, "feed": 600, "plunge_feed": 100, "rapid": 6000}
HELIX = Entry("helix", 3)
SLOPE = math.tan(math.radians(10))
CORNERS = 4 - math.pi  # of a rectangle, of what a tool of radius 1 leaves in its four


def test_two_levels_of_rings_by_hand():
    """370 at each level, as rings of 80, 120 and 160 and two links of 5; down 4 from 2 above, then 6; up again, and over to the
    entry, 15 in either axis from where the last ring ends."""
    trial = compare(BOX, 5.0, "rings", depth=(2, 4), **HAND)["rings"]
    row, over = trial.row, float(np.hypot(*(trial.path.start[0] - trial.path.end[-1])[:2]))
    assert row["length"] == pytest.approx(2 * 370 + 4 + 6)
    assert row["rapid"] == pytest.approx(4 + over + 6) and row["lifts"] == 0
    assert row["time"] == pytest.approx(740 / 600 * 60 + 10 / 100 * 60 + (10 + over) / 6000 * 60)
    assert row["removal_most"] == pytest.approx(10 * 2 * 600 / 1000, abs=0.05)


@pytest.mark.parametrize("name", deep_but_one_in(3, STRATEGIES))
def test_the_same_at_each_level(name):
    """What counts a level is as of one alone; moves and lifts are those of all three."""
    one, all_ = (compare(ISLAND, 4.0, name, stepover=3, depth=depth, entry=HELIX)[name] for depth in (2, (2, 4, 6)))
    for column in ("covered", "rest", "corners", "mean", "p95", "most", "above", "removal", "removal_most"):
        assert all_.row[column] == pytest.approx(one.row[column], abs=1e-9), column
    assert all_.row["lifts"] == 3 * one.row["lifts"]
    assert [level.depth for level in all_.levels] == [2, 4, 6] and len(all_.different) == 1
    floor = [all_.path[(np.abs(np.stack([all_.path.start, all_.path.end])[..., 2] + d) < 1e-9).all(axis=0)] for d in (2, 6)]
    assert floor[0].end[:, :2] == pytest.approx(floor[1].end[:, :2])


def test_removal_goes_with_the_step():
    one = compare(BOX, 5.0, "rings", depth=1, **HAND)["rings"].row
    row = compare(BOX, 5.0, "rings", depth=(1, 4, 5), **HAND)["rings"].row
    assert row["removal_most"] == pytest.approx(3 * one["removal_most"])
    assert row["removal"] == pytest.approx(5 / 3 * one["removal"])


def test_chips_at_every_level():
    """Each level feeds as one alone does, and none has a thicker chip."""
    more = {"stepover": 3, "chip": 0.05, "spindle": 8000, "feed": 3000}
    one, all_ = (compare(ISLAND, Tool(radius=5, teeth=3), "rings", depth=depth, **more)["rings"] for depth in (2, [2, 4]))
    assert all_.row["chip"] == pytest.approx(0.05)
    for level in all_.levels:
        assert level.feed == pytest.approx(one.feed) and level.chip == pytest.approx(one.chip)
    cut = [path.feed[(path.end[:, 2] == z) & (path.start[:, 2] == z)] for path, z in ((one.path, -2), (all_.path, -4))]
    assert cut[0] == pytest.approx(cut[1])


@pytest.mark.parametrize("name", deep_but_one_in(3, STRATEGIES))
def test_lifts_are_those_of_the_path(name):
    """All ways on that are no link at the level, between pieces and within them; from piece to piece of a stock too."""
    stock = area.Region.of(area.rectangle(20, 60, centre=(20, 0)))
    for more in ({}, {"stock": stock}):
        trial = compare(BOX, 3.0, name, stepover=2.0, depth=(1, 2), **more)[name]
        within = sum(linked != LINKED for piece in trial.clearing.pieces for linked in piece.linked)
        assert trial.row["lifts"] == 2 * (len(trial.clearing.pieces) - 1 + within)
    if name == "rings":
        assert trial.row["lifts"] > 0  # stretches of rings are pieces of a stock


# --- draft --------------------------------------------------------------------------------------------------------------


def inset_area(far):
    """Of the rectangle less its island, both walls moved."""
    return (60 - 2 * far) * (40 - 2 * far) - math.pi * (6 + far) ** 2


@pytest.mark.parametrize("name", ["rings", "one way", "rounded zigzag"])
def test_walls_with_a_draft(name):
    """Level by level the area is smaller; wherever the tool is, its rim stays before the slope; all that fits is cut away."""
    depths = (3, 6, 8)
    trial = compare(ISLAND, 4.0, name, stepover=3, depth=depths, draft=10, entry=HELIX)[name]
    areas = [inset_area(depth * SLOPE) for depth in depths]
    assert [level.region.area for level in trial.levels] == pytest.approx(areas)
    assert len(trial.different) == 3 and trial.row["covered"] > 99.99
    assert trial.row["corners"] == pytest.approx(CORNERS * 16, abs=0.05)
    x, y, z = trial.path.points(1e-4)[0].T
    far = 4 + np.maximum(-z, 0) * SLOPE - 1e-6
    assert (np.abs(x) <= 30 - far).all() and (np.abs(y) <= 20 - far).all()
    assert (np.hypot(x - 3, y - 2) >= 6 + far)[z < 0].all()
    setup = mnclab.Setup(tools={1: Tool(radius=4, length=60)}, stock=((-40, -30, -15), (40, 30, 0)))
    run = mnclab.run(trial.program("g43"), "g43", setup=setup)
    assert run.ok and not run.collisions()
    cut = sum(step * (whole - CORNERS * 16) for step, whole in zip((3, 3, 2), areas))
    assert run.workpiece().removed == pytest.approx(cut, rel=1e-3)


def test_a_draft_of_nothing_is_none():
    """By another way: levels planned one by one as with a draft, though the walls are upright."""
    upright, one_by_one = (compare(ISLAND, 4.0, "rings", depth=(1, 2), draft=draft)["rings"] for draft in (0, 1e-9))
    assert len(upright.different) == 1 and len(one_by_one.different) == 2
    numbers = [[value for name, value in trial.row.items() if name != "strategy"] for trial in (upright, one_by_one)]
    assert numbers[0] == pytest.approx(numbers[1], rel=1e-5, abs=1e-3)


def test_a_level_without_stock_is_passed_over():
    """A strip of 0.5 mm along the right wall, which the slope has left behind at the second level."""
    strip = area.Region.of(area.rectangle(0.5, 40, centre=(29.75, 0)))
    trial = compare(BOX, 4.0, "rings", depth=(1, 6), draft=10, stock=strip)["rings"]
    assert trial.path.end[:, 2].min() == pytest.approx(-1) and not trial.levels[1].clearing.pieces
    assert trial.row["covered"] > 99.99 and trial.row["lifts"] >= 0


def test_after_a_coarse_tool_with_a_draft():
    """Each level has its own corners: (4 - π)·(12² - 5²), whatever the depth."""
    trial = compare(BOX, 5.0, "fine", coarse=12.0, depth=(2, 4), draft=5, overlap=0.6)["fine"]
    for level in trial.levels:
        cut = (level.engagement.width * level.engagement.step).sum()
        assert cut == pytest.approx(CORNERS * (144 - 25), rel=0.03)
    assert trial.row["covered"] > 99.9


def test_pictures_and_sets_of_tools():
    one, deep = (compare(ISLAND, 4.0, "rings", "one way", depth=depth) for depth in (1, (1, 2)))
    for kind in ("paths", "engagement", "passes"):
        titles = [[ax.get_title(loc="left") for ax in found.plot(kind).axes] for found in (one, deep)]
        assert titles[0] == titles[1]
    assert mnclab.strategies.plot_times({(8, 4.0): deep}).axes[0].lines[0].get_ydata()[0] == deep["rings"].time
    simple = {"strategies": ["rings"], "overlap": 0.4, "change": 0.0}
    one, two = (tool_sets(BOX, [2.0, 5.0], depth=depth, **simple)["⌀10, ⌀4"] for depth in (1, (1, 2)))
    assert [len(trial.levels) for trial in two.trials] == [2, 2]
    assert 2 * one.length(rapid=False) < two.length(rapid=False) < 2 * one.length(rapid=False) + 100


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"depth": ()}, "one depth of a level"),
        ({"depth": np.ones(2000).cumsum()}, "up to 1000 of them"),
        ({"depth": (1, 1)}, "depth of a level .mm. must be greater than 1, got 1"),
        ({"depth": (2, 1)}, "greater than 2, got 1"),
        ({"depth": (2, 2 + 1e-9)}, "greater than 2, got 2"),
        ({"depth": (0, 1)}, "greater than 0"),
        ({"depth": (1, "2")}, "must be a number, got '2'"),
        ({"depth": ((1, 2), 3)}, "must be a number"),
        ({"depth": {1, 2}}, "must be a number"),
        ({"draft": -1}, "draft of the walls"),
        ({"draft": 90}, "draft of the walls"),
        ({"draft": "steep"}, "draft of the walls"),
        ({"depth": (5, 60), "draft": 20}, "draft of 20 degrees nothing is left of the area at the depth 60 mm"),
        ({"depth": (5, 48), "draft": 20}, "does not fit into the contour, 48 mm deep"),
        ({"strategies": {"own": lambda *_: 3}}, "a strategy makes a Clearing"),
        ({"strategies": {"own": compare(BOX, 4.0, "rings")[0].clearing}, "draft": 5}, "a Clearing is that of one area"),
    ],
)
def test_what_cannot_be(options, said):
    with pytest.raises(Alarm, match=said):
        compare(BOX, 4.0, **{"strategies": ["rings"]} | options)


def test_numbers_of_numpy_and_lists():
    given = ([1, 2], np.array([1, 2]), (np.float32(1), np.int8(2)), np.array([1.0, 2.0]))
    (first, *others) = [repr(compare(BOX, 5.0, "rings", depth=depth, draft=np.float64(3))) for depth in given]
    assert all(other == first for other in others)
    assert repr(compare(BOX, 5.0, "rings", depth=(2,))) == repr(compare(BOX, 5.0, "rings", depth=2))

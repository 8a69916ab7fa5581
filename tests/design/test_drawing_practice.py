"""Drawings as ISO 129-1 wants them: no dimension twice, leaders that do not cross, no number finer than its tolerance."""

from collections import Counter
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from design.random_designs import milled, turned
from shapely import LineString
from tools.together import deep_but_one_in

import mnclab as mnc
from mnclab.design import model as d
from mnclab.design.drawing import drawing
from mnclab.design.drawing.placing import LEADER
from mnclab.design.drawing.view import Linear
from mnclab.workpiece.blank import Box

SAMPLES = sorted((Path(__file__).parents[2] / "data" / "designs").rglob("*.toml"))
EXERCISES = sorted((Path(__file__).parents[2] / "data" / "exercises").rglob("*.toml"))


def laid(drawn):
    return [each for sheet in drawn.sheets for each, _ in sheet.views]


def twice(drawn):
    """Lengths of one view between the same two places, of one value."""
    for view in laid(drawn):
        linear = [each for each in view.view.dimensions if isinstance(each, Linear)]
        for one, other in combinations(linear, 2):
            ends = [sorted(end[0] for end in (each.a, each.b)) for each in (one, other)]
            if one.along == other.along == "x" and np.allclose(*ends, atol=1e-6) and one.value == other.value:
                yield one.value.text


def crossing(drawn):
    """Leaders of one view that cross."""
    for view in laid(drawn):
        leaders = [[LineString(line[1:]) for line in mark.lines if line[0] == LEADER] for mark in view.marks]
        for one, other in combinations([each for each in leaders if each], 2):
            if any(a.crosses(b) for a in one for b in other):
                yield view.view.name


def coordinates(view, axis):
    """The places along an axis that are dimensioned from 0, and those of rows but for their first."""
    k = "xy".index(axis)
    for each in view.dimensions:
        if isinstance(each, Linear) and each.along == axis and "⌀" not in each.value.text:
            a, b = sorted((each.a[k], each.b[k]), key=abs)
            count, row, _ = each.value.text.partition("× ")
            if "(=" in row:
                a, b = sorted((a, b))
                yield from (np.round(place, 6) for place in np.linspace(a, b, int(count) + 1)[1:])
            elif abs(a) < 1e-6:
                yield round(b, 6)


def drawn_of(path):
    """The drawing of a design, or of that of an exercise; None without one."""
    design = d.Design.load(path) if path in SAMPLES else mnc.exercise(path).design
    return drawing(design) if design is not None else None


FOUND = [next(path for path in EXERCISES if path.stem == name) for name in ("tnc-620-05", "tnc-620-24", "g43-05", "mnc-18")]


@pytest.mark.parametrize("path", [*FOUND, *deep_but_one_in(12, [each for each in [*SAMPLES, *EXERCISES] if each not in FOUND])])
def test_no_coordinate_is_dimensioned_twice_on_an_axis(path):
    """Lengths from 0, places and rows of holes each say where something lies along an axis: one of them does, no second."""
    drawn = drawn_of(path)
    if drawn is None:
        return
    assert not [*twice(drawn)]
    for view in laid(drawn):
        if view.view.name == "from above":
            assert all(count == 1 for axis in "xy" for count in Counter(coordinates(view.view, axis)).values())


@pytest.mark.parametrize("path", deep_but_one_in(5, SAMPLES))
def test_samples_say_nothing_twice_and_no_leaders_cross(path):
    drawn = drawing(d.Design.load(path))
    assert not [*twice(drawn)] and not [*crossing(drawn)]


def test_where_leaders_would_cross_the_sheet_is_larger():
    """Sixteen corners 8 mm apart have no room for their names at 1:1 on A4."""
    drawn = drawn_of(next(path for path in EXERCISES if path.stem == "mnc-35"))
    assert drawn.scale > 1 and not [*crossing(drawn)] and not drawn.leaders_cross


@pytest.mark.parametrize(("make", "seed"), deep_but_one_in(12, [(make, seed) for make in (milled, turned) for seed in range(30)]))
def test_nor_do_those_of_random_parts(make, seed):
    drawn = drawing(make(seed))
    assert not [*crossing(drawn)]
    assert make is milled or not [*twice(drawn)]  # two pockets in a row may be of one length


def test_a_taper_has_no_more_than_it_needs():
    """From radius 10 to 15 over 8 mm: arctan(5/8) = 32.005° is the least round, and stands in brackets."""
    cone = d.TurnedDesign([(0, 10), (-8, 15), (-8, 20), (-30, 20)])
    texts = {each.measure: each.text for each in drawing(cone).dimensions}
    assert texts["angle 1"] == "(32.01°)" and texts["diameter 1"] == "⌀20" and texts["diameter 2"] == "⌀30"
    steep = d.TurnedDesign([(0, 10), (-8, 10 + 8 * np.tan(np.radians(30))), (-8, 20), (-30, 20)])
    texts = {each.measure: each.text for each in drawing(steep).dimensions}
    assert texts["angle 1"] == "30°" and texts["diameter 2"] == "(⌀29.24)"


def test_equal_grooves_have_one_note():
    grooves = [d.RingGroove(z=z, width=3, diameter=30) for z in (-10, -20, -30)]
    drawn = drawing(d.TurnedDesign([(0, 20), (-50, 20)], grooves))
    assert {each.text for each in drawn.dimensions if each.measure == "width"} == {"3× 3×⌀30"}
    assert sum("3×⌀30" in box.text for box in drawn.boxes() if box.kind == "text") == 1


def test_a_depth_that_begins_on_a_step_stands_in_the_section():
    """Beside the diameter a depth of 6 would be taken from the upper side; in the section it goes from -5 to -11. The
    floor at -5, which the section has to say then, is said nowhere else."""
    round_ = d.Pocket.circle
    drawn = drawing(d.Design(Box((0, 0, -20), (110, 70, 0)), [round_(40, 35, 44, 5), round_(40, 35, 28, 6, top=-5)]))
    linear = [each for view in laid(drawn) for each in view.view.dimensions if isinstance(each, Linear)]
    heights = [sorted((each.a[1], each.b[1])) for each in linear]
    assert [-11, -5] in heights and [-5, 0] in heights
    assert [each.text for each in drawn.dimensions if each.measure == "depth"] == ["5", "6"]
    assert not any("↧" in each.text for each in drawn.dimensions)


def test_what_goes_from_end_to_end_is_cut_across():
    """A section along a step has no wall of it: the one from the left does, and it is the first one, A. No size is told of what
    is not there."""
    drawn = drawing(mnc.exercise("tnc-620-47").design)
    texts = {each.view.name: {size.value.text for size in each.view.dimensions} for each in laid(drawn)}
    assert texts == {"from the front": {"30"}, "from above": {"80", "50", "10"}, "from the left": {"8"}}
    assert [view.view.title for view in laid(drawn)] == ["", "", "A–A"]

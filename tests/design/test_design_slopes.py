"""Floors that fall: heights, volumes and distances in closed form."""

from math import cos, hypot, pi, radians, sin, sqrt

import numpy as np
import pytest

import mnclab
from mnclab import Alarm, Design
from mnclab.design import Hole, Pocket, Slope

BLANK = ((0, 0, -20), (100, 60, 0))
EXACT = 1e-9


def plate(*features, back=()):
    return Design(BLANK, features, back)


@pytest.mark.parametrize("turned", [0, 30, 90, -125])
@pytest.mark.parametrize(("start", "end"), [(0, 6), (6, 2), (3, 8)])
@pytest.mark.parametrize("lower", [False, True])
def test_heights_and_volume(turned, start, end, lower):
    slope = Slope(50, 30, 30, 12, start, end, turned)
    design = plate(back=[slope]) if lower else plate(slope)
    assert design.volume == pytest.approx(120_000 - 30 * 12 * (start + end) / 2, abs=1e-7)
    assert design.turned_over().volume == pytest.approx(design.volume, abs=1e-7)
    way = np.array([cos(radians(turned)), sin(radians(turned))])
    at = np.linspace(-14, 14, 7)
    x, y = (np.array([50, 30]) + at[:, None] * way).T
    depth = start + (at + 15) / 30 * (end - start)
    seen = design.turned_over() if lower else design
    assert seen.faces(x, y)[1] == pytest.approx(-depth, abs=EXACT)
    u, v = np.meshgrid(np.linspace(20, 80, 61), np.linspace(5, 55, 51))
    over = seen.faces_over(u[0], v[:, 0])[1]
    assert over.ravel() == pytest.approx(seen.faces(u.ravel(), v.ravel())[1], abs=EXACT)
    moved = design.moved((3, -4, 5))
    assert moved.volume == pytest.approx(design.volume, abs=1e-7)


def test_distances_from_a_slope():
    """A floor from 0 at X 20 to -8 at X 60, 20 wide about Y 30: above it, under it, at its walls and past its ends."""
    part = plate(Slope(40, 30, 40, 20, 0, 8)).part
    steep = hypot(40, 8)
    normal = np.array([8, 0, 40]) / steep
    middle = np.array([40.0, 30, -4])
    assert part([middle + 0.7 * normal, middle - 1.3 * normal]) == pytest.approx([0.7, -1.3], abs=EXACT)
    above = np.array([40.0, 30, 3])
    nearest = min(hypot(20, 3), float((above - middle) @ normal), hypot(10, 3))  # the edge, the floor, a rim
    assert part([above]) == pytest.approx([nearest], abs=EXACT)
    assert part([(55, 38.5, -3)]) == pytest.approx([1.5], abs=EXACT)  # a wall across
    assert part([(58.5, 30, -3)]) == pytest.approx([1.5], abs=EXACT)  # the wall at the deep end
    assert part([(55, 41, -6)]) == pytest.approx([-1], abs=EXACT)  # in the material beside the wall
    assert part([(55, 41, -8)]) == pytest.approx([-hypot(1, (-7 + 8) * 40 / steep)], abs=EXACT)  # beneath its lower edge
    assert part([(61, 30, -9)]) == pytest.approx([-sqrt(2)], abs=EXACT)  # from the lowest edge
    assert part([(25, 30, 5)]) == pytest.approx([min(hypot(5, 5), float(np.array([5, 0, 5]) @ normal))], abs=EXACT)
    assert part([(-3, 30, 4)]) == pytest.approx([5], abs=EXACT)


def test_distances_are_not_farther_than_any_place_of_the_surface():
    design = plate(Slope(40, 30, 30, 16, 7, 2, 25), Pocket.circle(70, 30, 14, 5), Hole(20, 20, 8, 9))
    rng = np.random.default_rng(5)
    points = rng.uniform((10, 10, -14), (80, 50, 4), (300, 3))
    x, y = (each.ravel() for each in np.meshgrid(np.arange(5, 90, 0.25), np.arange(5, 55, 0.25)))
    surface = [np.column_stack([x, y, level]) for level in design.faces(x, y)]
    for z in np.arange(-14, 0, 0.25):
        for loop in design.section(z).loops:
            places = loop.point_at(np.arange(0, loop.length, 0.25))[0]
            surface.append(np.column_stack([places, np.full(len(places), z)]))
    spots = np.concatenate(surface)
    nearest = np.array([np.sqrt(((each - spots) ** 2).sum(axis=1).min()) for each in points])
    distance = design.part(points)
    assert (np.abs(distance) <= nearest + EXACT).all()
    assert (nearest <= np.abs(distance) + 0.3).all()
    inside = points[:, 2] < design.faces(points[:, 0], points[:, 1])[1]
    assert ((distance < 0) == inside).all()


def test_sections_and_what_meets_a_slope():
    design = plate(Slope(40, 30, 40, 20, 2, 10))
    for z, out in ((-1, 40), (-4, 30), (-9, 5)):
        assert design.section(z).area == pytest.approx(6000 - 20 * out, abs=1e-9)
    crossed = plate(Slope(40, 30, 40, 20, 2, 10), Pocket.rectangle(30, 30, 20, 8, 4))  # under the slope for X < 30 only
    assert crossed.volume == pytest.approx(design.volume - 8 * 10 * 2 / 2, rel=1e-7)
    deep = plate(Slope(40, 30, 40, 20, 2, 10), Hole(40, 30, 10, 15, 180))  # the mean floor within the circle is -6
    assert deep.volume == pytest.approx(design.volume - pi * 25 * (15 - 6), rel=1e-7)


def test_what_a_slope_says_and_its_file(tmp_path):
    slope = Slope(40, 30, 40, 20, 2, 10, 15, tolerances={"start depth": 0.1}, name="ramp")
    names = {each.name: each.nominal for each in slope.measures()}
    assert names == {"length": 40, "width": 20, "angle": 15, "x": 40, "y": 30, "start depth": 2, "end depth": 10}
    design = plate(slope, back=[Slope(30, 20, 10, 5, 0, 2, top=-1.0)])
    assert Design.load(design.save(tmp_path / "d.toml")) == design
    assert eval(repr(design), {name: getattr(mnclab.design, name) for name in mnclab.design.__all__}) == design
    assert design.turned_over().turned_over() == design
    assert design._repr_html_().count("<tr>") == 1 + 7 + 7


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"start_depth": 3, "end_depth": 3}, "the depths of a slope must differ, got 3"),
        ({"start_depth": -1}, r"the start_depth of a slope \(mm\) must be at least 0"),
        ({"length": 0}, r"the length of a slope \(mm\) must be at least 0.001"),
        ({"width": None}, r"the width of a slope \(mm\) must be a number"),
        ({"turned": "a"}, "the turned of a rectangle"),
    ],
)
def test_what_is_no_slope(given, said):
    with pytest.raises(Alarm, match=said):
        Slope(**{"x": 40, "y": 30, "length": 40, "width": 20, "start_depth": 2, "end_depth": 10} | given)

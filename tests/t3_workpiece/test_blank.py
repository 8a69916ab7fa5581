"""Blanks: a box and bodies turned about an axis, their outlines in views and their bodies in space."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Alarm
from mnclab.show.solids import body_of
from mnclab.workpiece.blank import CORNERS, Box, Revolved, blank, cylinder

sizes = st.floats(0.5, 100)
places = st.tuples(*[st.floats(-50, 50)] * 3)


def test_two_corners_are_a_box_and_other_things_are_none():
    assert blank(((0, 0, -5), (10, 20, 0))) == Box((0, 0, -5), (10, 20, 0))
    assert blank(None) is None and blank("steel") is None and blank((1, 2)) is None
    rod = cylinder(10, -30, 2)
    assert blank(rod) is rod


@pytest.mark.parametrize("wrong", [(0, 0, 1), (5, 1, 1), (-5, 0, 1)])
def test_a_cylinder_without_size_is_refused(wrong):
    with pytest.raises(Alarm, match="a cylinder needs"):
        cylinder(*wrong)


@given(sizes, sizes, sizes, places)
def test_a_box_has_its_volume_and_twelve_edges(x, y, z, at):
    box = Box((0, 0, 0), (x, y, z)).moved(at)
    assert body_of(box).volume == pytest.approx(x * y * z)
    assert len(box.edges()) == 12
    length = sum(float(np.linalg.norm(b - a)) for a, b in box.edges())
    assert length == pytest.approx(4 * (x + y + z))
    assert np.allclose(box.bounds, [at, np.add(at, (x, y, z))])


@given(sizes, sizes, st.floats(0, 0.9), st.sampled_from("XYZ"), places)
def test_a_tube_has_its_volume_along_every_axis(radius, length, share, axis, at):
    tube = cylinder(radius, -length, 0, axis, at, radius * share)
    body = body_of(tube)
    prism = CORNERS / 2 * np.sin(2 * np.pi / CORNERS)  # area of the polygon that stands for a circle of radius 1
    assert body.volume == pytest.approx(prism * length * radius**2 * (1 - share**2), rel=1e-9)
    assert np.allclose([body.points.min(axis=0), body.points.max(axis=0)], tube.bounds)
    along = "XYZ".index(axis)
    low, high = np.array(at) - radius, np.array(at) + radius
    low[along], high[along] = at[along] - length, at[along]
    assert np.allclose(tube.bounds, [low, high])
    for right, up in ((0, 1), (0, 2), (1, 2), (2, 0)):
        points = np.concatenate(tube.outline(right, up))
        assert np.allclose([points.min(axis=0), points.max(axis=0)], tube.bounds[:, [right, up]])
    edges = np.concatenate(tube.edges())
    assert np.allclose([edges.min(axis=0), edges.max(axis=0)], tube.bounds)


@pytest.mark.parametrize("given", [
    (("a", 0, 0), (1, 1, 1)), ((None, 0, 0), (1, 1, 1)), ((0, 0, 0), (1, 1, float("inf"))), ((0, 0, 0), (1, 1, 1e300)),
    Box(("a", 0, 0), (1, 1, 1)), Box((0, 0), (1, 1)), Box((0, 0, 0), (1, float("nan"), 1)),
    Revolved(()), Revolved(((5, 0),)), Revolved(((5, 0), (-5, 9))), Revolved(((5, 0), (5, 9)), "Q"),
    Revolved(((5, 0), (5, 9)), at=(0, 0)), Revolved(((5, 0), (5, 9)), bore=-1), Revolved(((5, 0), (5, 9)), bore=float("nan")),
], ids=str)  # fmt: skip
def test_what_stands_nowhere_is_no_blank(given):
    assert blank(given) is None
    with pytest.raises(Alarm, match="stock must be three sizes, two corners"):
        mnclab.Setup(stock=given)
    with pytest.raises(Alarm, match="stock must be three sizes, two corners"):
        mnclab.run("G0 X1\n", "mnc").workpiece(stock=given)


@pytest.mark.parametrize("given", [((0, 0, 0), (40, 20, 0)), ((0, 0, 0), (0, 0, 0)), Revolved(((5, 0), (5, 9)), bore=5)])
def test_what_holds_nothing_cannot_be_cut(given):
    run = mnclab.run("G0 X1\n", "mnc", mnclab.Setup(stock=given))
    for ask in (run.workpiece, run.collisions):
        with pytest.raises(Alarm, match="there is nothing to cut"):
            ask()


@pytest.mark.parametrize("axis", "XY")
def test_a_lying_blank_reads_its_profile_from_either_end(axis):
    rod = Revolved(((6, 0), (8, 20), (10, 20), (10, 30), (4, 25)), axis)
    along, zero = np.array([-1.0, 0.0, 10.0, 20.0, 22.0, 29.0, 31.0]), np.zeros(7)
    at = (along, zero) if axis == "X" else (zero, along)
    expected = [np.nan, 6, 7, 10, 10, 10, np.nan]
    for body in (rod, rod._replace(profile=rod.profile[::-1])):
        floor, top = body.faces(*at)
        assert np.allclose(top, expected, equal_nan=True)
        assert np.allclose(floor, np.negative(expected), equal_nan=True)


def test_a_cone_is_a_third_of_its_cylinder():
    cone = Revolved(((0.0, 0.0), (3.0, 5.0)))
    prism = CORNERS / 2 * np.sin(2 * np.pi / CORNERS)
    assert body_of(cone).volume == pytest.approx(prism * 9 * 5 / 3)
    assert body_of(cone._replace(profile=cone.profile[::-1])).volume == pytest.approx(prism * 9 * 5 / 3)
    assert np.allclose(cone.outline(0, 2)[0], [(0, 0), (3, 5), (-3, 5), (0, 0), (0, 0)])


def test_the_blank_of_a_run_stands_in_the_coordinates_of_its_path():
    setup = mnclab.Setup(stock=cylinder(5, 90, 100), datums={1: mnclab.Datum(10, 20, 100)})
    run = mnclab.run("G90 G54\nG0 X1\n", "mnc", setup)
    assert np.allclose(run.stock.bounds, [(-15, -25, -10), (-5, -15, 0)])
    assert mnclab.run("G90 G54\nG0 X1\n", "mnc").stock is None


def test_the_program_gives_one_where_the_setup_has_none():
    text = "BEGIN PGM A MM\nBLK FORM 0.1 Z X-1 Y-2 Z-3\nBLK FORM 0.2 X4 Y5 Z0\nL Z5 FMAX\nEND PGM A MM\n"
    assert mnclab.run(text, "tnc-620").stock == Box((-1, -2, -3), (4, 5, 0))
    own = mnclab.Setup(stock=((0, 0, 0), (1, 1, 1)))
    assert mnclab.run(text, "tnc-620", own).stock == Box((0, 0, 0), (1, 1, 1))

"""Sections and surfaces of parts: areas and volumes in closed form."""

from math import inf, nan, pi

import numpy as np
import pytest

import mnclab
from mnclab import Setup
from mnclab.text.alarm import Alarm
from mnclab.workpiece.part import ball, boss, box, cylinder, hole, mesh, plane, pocket
from mnclab.workpiece.part.part import Part

PART = box((0, 0, -20), (100, 60, 0)) - hole((50, 30, 0), 24, 10) | boss((20, 30, 0), 8, diameter=12)


def area(contours):
    return sum(each.area for each in contours)


def volume(points, triangles):
    """By the divergence theorem: right only of a closed surface seen counter-clockwise from outside."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6


def test_sections_of_prisms_are_exact():
    assert area(PART.section(-5)) == pytest.approx(6000 - pi * 144, abs=1e-9)
    assert area(PART.section(4)) == pytest.approx(pi * 36, abs=1e-9)
    assert PART.section(8.1) == PART.section(-20.1) == []
    assert area(PART.section(0)) == pytest.approx(6000 - pi * 144, abs=1e-9)  # at a step what is below it
    turned = PART.turned(30).shifted(5, 6, 7)
    assert area(turned.section(2)) == pytest.approx(6000 - pi * 144, abs=1e-9)
    over = PART.placed(np.diag([1.0, -1.0, -1.0, 1.0]))  # turned over: what was at -5 is at 5
    assert area(over.section(5)) == pytest.approx(6000 - pi * 144, abs=1e-9)
    hole_of = min(over.section(5), key=lambda each: each.area)
    assert np.allclose(hole_of.bounds, [(38, -42), (62, -18)])


def test_sections_over_a_grid():
    """A ball cut at the height h: a circle of the radius sqrt(r² - h²); a bar that lies: its length times its width."""
    (circle,) = ball((3, 4, 0), 10).section(6)
    assert circle.area == pytest.approx(pi * 64, rel=1e-3) and np.allclose(circle.bounds.mean(axis=0), (3, 4), atol=1e-6)
    bar = cylinder((0, 0, 0), (40, 0, 0), 5)
    assert area(bar.section(3)) == pytest.approx(40 * 2 * 4, rel=5e-3)
    bowl = box((-20, -20, -10), (20, 20, 0)) - ball((0, 0, 0), 8)
    outer, inner = sorted(bowl.section(-1, step=0.2), key=lambda each: -each.area)
    assert outer.area == pytest.approx(1600, rel=1e-3) and inner.area == pytest.approx(-pi * 63, rel=1e-3)
    assert ball((0, 0, 0), 5).section(5.5) == []
    (piece,) = plane((0, 0, 5), (0, 0, 1)).section(0, step=1, within=((0, 0), (10, 20)))
    assert piece.area == pytest.approx(200, rel=2e-2)


def test_sections_of_others_are_their_own():
    design = mnclab.Design(((0, 0, -20), (100, 60, 0)), [mnclab.design.Pocket.circle(50, 30, 24, 10)])
    assert area(design.part.section(-5)) == pytest.approx(6000 - pi * 144, abs=1e-9)
    pyvista = pytest.importorskip("pyvista")
    assert area(mesh(pyvista.Box((0, 10, 0, 20, 0, 30))).section(15)) == pytest.approx(200, abs=1e-6)


@pytest.mark.parametrize("part", [PART, PART.turned(30).shifted(500, 60, 7), PART.placed(np.eye(4)[[2, 0, 1, 3]])])
def test_surfaces_of_prisms(part):
    """Closed but for chords: those of a circle within 0.01 mm of it."""
    expected = 100 * 60 * 20 - pi * 144 * 10 + pi * 36 * 8
    assert volume(*part.surface()) == pytest.approx(expected, rel=2e-4)
    points, _ = part.surface()
    assert (np.abs(part(points)) < 0.011).all()
    low, high = part.bounds
    assert np.allclose(points.min(axis=0), low) and np.allclose(points.max(axis=0), high)


def test_surfaces_of_pockets_that_meet():
    part = box((0, 0, -20), (100, 60, 0)) - pocket((30, 30, 0), 40, 20, 5) - pocket((50, 30, 0), 40, 20, 8)
    points, triangles = part.surface()
    assert volume(points, triangles) == pytest.approx(120_000 - 20 * 20 * 5 - 40 * 20 * 8, rel=1e-9)


def test_surfaces_over_a_grid():
    points, triangles = ball((5, 5, 5), 10).surface(step=0.5)
    assert volume(points, triangles) == pytest.approx(4 / 3 * pi * 1000, rel=5e-3)
    assert np.linalg.norm(points - 5, axis=1) == pytest.approx(10, abs=0.02)
    rough = PART.with_errors(taper=1)
    assert volume(*rough.surface()) > 115_000


def test_surfaces_of_triangles_are_theirs():
    pyvista = pytest.importorskip("pyvista")
    points, triangles = mesh(pyvista.Box((0, 10, 0, 20, 0, 30))).surface()
    assert len(triangles) == 12 and volume(points, triangles) == pytest.approx(6000)


@pytest.mark.parametrize(
    ("look", "said"),
    [
        (lambda: ball((0, 0, 0), 5).section(nan), "height of a section"),
        (lambda: plane((0, 0, 0), (0, 0, 1)).section(-1), "plane has no end: say where to look"),
        (lambda: plane((0, 0, 0), (0, 0, 1)).surface(), "plane has no end"),
        (lambda: hole((0, 0, 0), 5, 5).surface(), "hole has no end"),
        (lambda: ball((0, 0, 0), 5).section(0, step=0), "step of a grid"),
        (lambda: ball((0, 0, 0), 5).section(0, step=1e-9), "too many places"),
        (lambda: ball((0, 0, 0), 5).section(0, within=((0, 0),)), "two corners"),
        (lambda: ball((0, 0, 0), 5).section(0, within=5), "two corners"),
        (lambda: ball((0, 0, 0), 5).surface(within=((0, 0, 0), (1, inf, 1))), "no end"),
    ],
)
def test_nonsense_is_an_alarm(look, said):
    with pytest.raises(Alarm, match=said):
        look()


def test_a_part_by_its_distance_alone():
    """What has nothing but a distance can be drawn where one says."""
    part = Part(lambda p: np.linalg.norm(p, axis=1) - 5, "by hand")
    (circle,) = part.section(0, within=((-6, -6), (6, 6)))
    assert circle.area == pytest.approx(25 * pi, rel=1e-3)


def test_bounds_of_others():
    """A design has those of its blank, a turned part those of its largest radius, what was cut those of the blank."""
    low_high = [[0, 0, -20], [100, 60, 0]]
    design = mnclab.Design(((0, 0, -20), (100, 60, 0)), [mnclab.design.Pocket.circle(50, 30, 24, 10)])
    assert design.part.bounds.tolist() == low_high
    bar = mnclab.design.TurnedDesign([(0, 10), (-20, 10), (-20, 15), (-50, 15)])
    assert bar.part.bounds == pytest.approx(np.array([[-15, -15, -50], [15, 15, 0]]))
    run = mnclab.run("T1 M6\nS1000 M3\nG0 X50 Y30 Z5\nG1 Z-4 F100\nG0 Z50\n", "g43", Setup(stock=low_high))
    assert run.workpiece().part.bounds.tolist() == low_high

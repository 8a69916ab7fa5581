"""Volumes of designs: of 120 random ones what manifold3d says, of features that stand apart closed forms."""

import json
import random
from math import pi, radians, tan
from pathlib import Path

import pytest
from tools.chance import seeds

from mnclab import Design
from mnclab.design import Chamfer, Circle, Face, Groove, Hole, Pocket, Rectangle, Slot, Stud
from mnclab.design.model.design_file import design_of, text_of
from mnclab.text.file import File, table_of
from mnclab.workpiece.blank import cylinder

RECORDS = json.loads((Path(__file__).parents[1] / "authorities" / "designs.json").read_text())["designs"]
FEW = 8  # that are always weighed
HIGH = 20.0
CELL = 20.0


@pytest.mark.parametrize(
    "record", [pytest.param(r, marks=[pytest.mark.deep] * (k >= FEW), id=r["name"]) for k, r in enumerate(RECORDS)]
)
def test_manifold_weighs_the_same(record):
    """A third of what half as many corners change is the error of its facets; 1e-7 is that of slants that meet others."""
    design = design_of(table_of(record["text"]), File("design.toml", record["text"]))
    facets = abs(record["volume"] - record["coarse"])
    assert design.volume == pytest.approx(record["volume"], rel=1e-7, abs=0.6 * facets + 1e-4)
    text = text_of(design)
    assert design_of(table_of(text), File("design.toml", text)) == design
    assert design.turned_over().volume == pytest.approx(design.volume, rel=1e-8)
    assert design.moved((7.3, -2.1, 11.7)).volume == pytest.approx(design.volume, rel=1e-8)


def rounded(a, b, r):
    """The area of a rectangle with round corners."""
    return a * b - (4 - pi) * r * r


def frustum(r1, r2, h):
    return pi * h / 3 * (r1 * r1 + r1 * r2 + r2 * r2)


def cells(rng, x, y):
    """What makes a feature, or two, within a cell about (x, y), and what it takes away, mm³, in closed form."""
    r, depth = rng.uniform(1.5, 4), rng.uniform(2, 8)
    a, b, c = rng.uniform(9, 13), rng.uniform(9, 13), rng.uniform(0.5, 3)
    turned, w = rng.uniform(-40, 40), rng.uniform(0.3, 1.2)
    yield lambda: [Pocket.rectangle(x, y, a, b, depth, corner=c, turned=turned)], rounded(a, b, c) * depth
    yield lambda: [Pocket.circle(x, y, a, depth)], pi * a * a / 4 * depth
    yield lambda: [Pocket.rectangle(x, y, a, b, depth, islands=[Circle(x, y, 2 * r)])], (a * b - pi * r * r) * depth
    yield lambda: [Pocket.rectangle(x, y, a, b, depth), Stud.circle(x, y, r, depth)], (a * b - pi * r * r / 4) * depth
    yield lambda: [Pocket.circle(x, y, a, 50.0)], pi * a * a / 4 * HIGH
    yield lambda: [Slot((x - c, y), (x + c, y), r, depth)], (2 * c * r + pi * r * r / 4) * depth
    yield lambda: [Groove(Circle(x, y, a), w, depth)], pi * a * w * depth
    corners = (a + w) * (b + w) - (4 - pi) * w * w / 4 - (a - w) * (b - w)
    yield lambda: [Groove(Rectangle(x, y, a, b), w, depth)], corners * depth
    point = r / tan(radians(59))
    yield lambda: [Hole(x, y, 2 * r, depth)], pi * r * r * (depth + point / 3)
    yield lambda: [Hole(x, y, 2 * r, depth, 180)], pi * r * r * depth
    yield lambda: [Hole(x, y, 2 * r)], pi * r * r * HIGH
    big, deep = r + c, depth / 2
    bore = pi * r * r * (HIGH - deep) + pi * big * big * deep
    yield lambda: [Hole(x, y, 2 * r, counterbore=(2 * big, deep))], bore
    sunk = c / tan(radians(45))
    yield lambda: [Hole(x, y, 2 * r, countersink=(2 * big, 90))], pi * r * r * (HIGH - sunk) + frustum(r, big, sunk)
    yield lambda: [Hole(x, y, None, thread="M6", depth=depth)], pi * 2.5**2 * (depth + 2.5 / tan(radians(59)) / 3)
    rim = (2 * (a + b) - (8 - 2 * pi) * c) * w * w / 2 + pi * w**3 / 3  # bands along the edge, quarter cones at the corners
    both = lambda shape: [Pocket(shape, depth), Chamfer(shape, w)]  # noqa: E731
    yield lambda: both(Rectangle(x, y, a, b, c)), rounded(a, b, c) * depth + rim
    round_ = frustum(a / 2, a / 2 + w, w) - pi * a * a / 4 * w
    yield lambda: both(Circle(x, y, a)), pi * a * a / 4 * depth + round_


@pytest.mark.parametrize("seed", seeds(5, deep=25))
def test_features_that_stand_apart_add_up(seed):
    """On a plate of 5 by 3 cells, on both sides."""
    rng = random.Random(seed)
    features, back, gone = [], [], 0.0
    for k in range(15):
        lower, x, y = k % 4 == 3, (k % 5 + 0.5) * CELL, (k // 5 + 0.5) * CELL
        known = list(cells(rng, x, 60 - y if lower else y))
        found, volume = known[(seed * 15 + k) % len(known)]
        gone += volume
        (back if lower else features).extend(found())
    design = Design(((0, 0, -HIGH), (100, 60, 0)), features, back)
    assert design.volume == pytest.approx(120_000 - gone, abs=1e-5)


def test_chamfers_of_outside_edges():
    """A frustum of a pyramid on a box: A h + P h²/2 less corners, which are mitred: (1/3) 4 w³ each way."""
    w = 1.5
    box = Design(((0, 0, -HIGH), (100, 60, 0)), Chamfer(Rectangle(50, 30, 100, 60), w))
    prismatoid = w / 6 * (100 * 60 + 4 * (100 - w) * (60 - w) + (100 - 2 * w) * (60 - 2 * w))
    assert box.volume == pytest.approx(100 * 60 * (HIGH - w) + prismatoid, abs=1e-6)
    bar = Design(cylinder(30, -HIGH, 0, bore=8), Chamfer(Circle(0, 0, 60), w))
    assert bar.volume == pytest.approx(pi * 30 * 30 * (HIGH - w) + frustum(30, 30 - w, w) - pi * 64 * HIGH, abs=1e-6)
    stud = Design(((0, 0, -HIGH), (100, 60, 0)), [Stud.circle(40, 30, 30, 6), Chamfer(Circle(40, 30, 30), w)])
    assert stud.volume == pytest.approx(6000 * 14 + pi * 225 * (6 - w) + frustum(15, 15 - w, w), abs=1e-6)


@pytest.mark.parametrize("place", [(1, 30), (99, 30), (50, 1), (50, 59)])
def test_what_sticks_out_of_the_blank_takes_what_is_in_it(place):
    square = Rectangle(*place, 10, 10)
    assert Design(((0, 0, -HIGH), (100, 60, 0)), Pocket(square, 5)).volume == pytest.approx(120_000 - 6 * 10 * 5, abs=1e-6)


def test_facing_and_studs_of_one_depth():
    studs = [Stud.circle(25, 30, 20, 7), Stud.rectangle(70, 30, 30, 20, 7, corner=4)]
    design = Design(((0, 0, -HIGH), (100, 60, 0)), [Face(2), *studs])
    assert design.volume == pytest.approx(6000 * 13 + 5 * (pi * 100 + rounded(30, 20, 4)), abs=1e-6)


def test_patterns():
    blank = ((0, 0, -HIGH), (100, 60, 0))
    ring = Hole.circle(50, 30, 6, 40, 6.6)
    assert [(round(each.x, 6), round(each.y, 6)) for each in ring[:3]] == [(70, 30), (60, 47.320508), (40, 47.320508)]
    assert [(each.x, each.y) for each in Hole.row(10, 10, 3, 15, 5, 8, turned=90)] == [(10, 10), (10, 25), (10, 40)]
    grid = Hole.grid(10, 10, 3, 2, 20, 30, 5, thread="M6", name="tapped")
    assert [(each.x, each.y) for each in grid] == [(10, 10), (30, 10), (50, 10), (10, 40), (30, 40), (50, 40)]
    assert {each.name for each in grid} == {"tapped"}
    assert Design(blank, (ring, Hole(50, 30, 20))).volume == pytest.approx(120_000 - HIGH * pi * (6 * 3.3**2 + 100), abs=1e-5)

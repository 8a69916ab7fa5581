"""What cycles 256 to 258 and 233 take away, swept level by level (shapely); the figures are drawn from their own numbers.

A stud stands untouched within a micrometre, all of the blank about it goes; a wall keeps its allowance and the surface is
cleared up to it. No infeed is deeper than it may be, nothing is cut below the floor, no rapid meets what stands.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Point, Polygon, affinity, box, union_all
from tools.running import labelled, run

from mnclab import Kind, Tool

pytestmark = pytest.mark.deep

MICRON = 1e-3
PLACE = (12.0, -7.0)


def without_corners(figure, corner):
    """A figure of straight sides with rounded corners, or with bevels that cut as much off each side."""
    if corner >= 0:
        return figure.buffer(-corner).buffer(corner, quad_segs=200)
    points = np.array(figure.exterior.coords)[:-1]
    ways = zip(np.roll(points, 1, axis=0), points, np.roll(points, -1, axis=0), strict=True)
    return Polygon([here - corner * (p - here) / np.hypot(*(p - here)) for a, here, b in ways for p in (a, b)])


def rectangle(v):
    """256: stud and blank."""
    a, b = v["Q218"], v["Q219"]
    x, y = [(0, 0), (a / 2, b / 2), (-a / 2, b / 2), (-a / 2, -b / 2), (a / 2, -b / 2)][int(v["Q367"])]
    areas = (
        without_corners(box(x - a / 2, y - b / 2, x + a / 2, y + b / 2), v["Q220"]),
        box(x - v["Q424"] / 2, y - v["Q425"] / 2, x + v["Q424"] / 2, y + v["Q425"] / 2),
    )
    return [affinity.translate(affinity.rotate(area, v["Q224"], origin=(0, 0)), *PLACE) for area in areas]


def circle(v):
    """257."""
    return [Point(PLACE).buffer(v[address] / 2, quad_segs=500) for address in ("Q223", "Q222")]


def polygon(v):
    """258."""
    n = int(v["Q572"])
    radius = v["Q571"] / 2 / (1 if v["Q573"] else math.cos(math.pi / n))
    way = np.radians(v["Q224"]) + 2 * np.pi * np.arange(n) / n
    sharp = Polygon(radius * np.stack([np.cos(way), np.sin(way)], axis=1) + PLACE)
    return [without_corners(sharp, v["Q220"]), Point(PLACE).buffer(v["Q222"] / 2, quad_segs=500)]


FIGURES = {
    256: (rectangle, {
        "Q218": st.floats(20, 40), "Q219": st.floats(20, 40), "Q424": st.floats(42, 70), "Q425": st.floats(42, 70),
        "Q220": st.sampled_from([0, 4, 9.9, -4]), "Q224": st.floats(-180, 180), "Q367": st.integers(0, 4),
        "Q437": st.integers(0, 4), "Q370": st.floats(0.4, 1.9999),
    }),
    257: (circle, {
        "Q223": st.floats(10, 40), "Q222": st.floats(42, 70), "Q376": st.sampled_from([-1, 0, 77]),
        "Q370": st.floats(0.4, 1.9999),
    }),
    258: (polygon, {
        "Q573": st.sampled_from([0, 1]), "Q571": st.floats(25, 40), "Q222": st.floats(42, 70), "Q572": st.integers(3, 9),
        "Q224": st.floats(-180, 180), "Q220": st.sampled_from([0, 3, -2]), "Q370": st.floats(0.4, 1.9999),
    }),
}  # fmt: skip
COMMON = {
    "Q215": st.just(0), "Q368": st.sampled_from([0.25, 0.6]), "Q207": st.just(400), "Q351": st.sampled_from([1, -1, 0]),
    "Q201": st.floats(-9, -3), "Q202": st.floats(2, 6), "Q369": st.sampled_from([0.2, 0.7]), "Q206": st.just(90),
    "Q338": st.sampled_from([0, 2.5]), "Q200": st.floats(0.5, 4), "Q203": st.just(0), "Q204": st.sampled_from([1, 30]),
    "Q385": st.just(900),
}  # fmt: skip


def milled(number, v, radius, edges):
    """Pairs of a motion and its label."""
    definition = "\n".join([f"CYCL DEF {number} A", *(f"{address}={v[address]:.9f}" for address in sorted(v))])
    tools = {1: Tool(radius=radius, cutting_length=edges)}
    program = f"TOOL CALL 1 Z S1000\n{definition}\nCYCL CALL M3"
    return labelled(run(program, "tnc-620", tools=tools, start=(*PLACE, 40.0)).toolpath)


def part(rows, name):
    return [(row, label) for row, label in rows if name in label]


def no_rapid_cuts(rows, radius, material, sweeps):
    """Below the surface a rapid keeps out of all that has not been taken at its level or deeper."""
    taken, news = {}, {}
    for row, label in rows:
        low = min(row.start[2], row.end[2])
        if row.kind != Kind.RAPID:
            news.setdefault(round(row.end[2], 6), []).append((row.start[2] == row.end[2], row))
        elif low < 0:
            for level, cuts in news.items():
                areas = [sweeps.disc(sweeps.line_of(row) if flat else Point(row.end[:2]), radius) for flat, row in cuts]
                taken[level] = union_all([*areas, taken.get(level, Point())])
            news = {}
            free = union_all([area for level, area in taken.items() if level <= low + 1e-6])
            stands = material.difference(free)
            assert sweeps.disc(sweeps.line_of(row), radius - 2 * MICRON).intersection(stands).area < 1e-6, label


@pytest.mark.parametrize("number", FIGURES)
@settings(max_examples=5)
@given(data=st.data(), radius=st.floats(2, 6), edges=st.sampled_from([0, 1.5]))
def test_a_stud_stands_and_its_blank_is_cleared(number, data, radius, edges, sweeps):
    draw, shape = FIGURES[number]
    v = data.draw(st.fixed_dictionaries(shape | COMMON))
    stud, blank = draw(v)
    rows = milled(number, v, radius, edges)
    floor, rest, join = v["Q201"], v["Q201"] + v["Q369"], "mitre" if v.get("Q220", 0) < 0 else "round"

    def around(allowance):
        return stud.buffer(allowance, quad_segs=200, join_style=join)

    roughing = sweeps.by_level(part(rows, "layer"), radius)
    infeed = min(v["Q202"], edges or 99)
    steps = -np.diff([0, *sorted(roughing, reverse=True)])
    full = len(steps) - 1
    assert steps == pytest.approx([infeed] * full + [-rest - infeed * full], abs=1e-5) and steps[-1] <= infeed + 1e-5
    for area in roughing.values():
        assert blank.difference(area).difference(around(v["Q368"] + 2 * MICRON)).area < 1e-4
        assert area.intersection(stud.buffer(v["Q368"] - MICRON, quad_segs=200)).area < 1e-6
    sides = sweeps.by_level(part(rows, "side finishing"), radius)
    assert min(sides) == pytest.approx(rest, abs=1e-5)
    for area in sides.values():
        assert area.intersection(stud.buffer(-MICRON)).area < 1e-6
        assert around(2 * v["Q368"]).difference(area).difference(around(2 * MICRON)).area < 1e-4
    bottom = sweeps.by_level(part(rows, "floor finishing"), radius)[round(floor, 6)]
    assert blank.difference(bottom).difference(around(2 * MICRON)).area < 1e-4
    assert bottom.intersection(stud.buffer(-MICRON)).area < 1e-6
    heights = [row.end[2] for row, _ in rows]
    assert min(heights) == pytest.approx(floor, abs=1e-9)
    assert heights[-1] == pytest.approx(max(v["Q200"], v["Q204"]))
    no_rapid_cuts(rows, radius, blank.union(stud), sweeps)


SURFACES = {
    "Q215": st.just(0), "Q389": st.integers(0, 3), "Q350": st.sampled_from([1, 2]), "Q218": st.floats(30, 60),
    "Q219": st.floats(30, 60), "Q227": st.just(0), "Q386": st.floats(-7, -2), "Q369": st.sampled_from([0.2, 0.5]),
    "Q202": st.floats(1, 4), "Q370": st.floats(0.4, 1.9999), "Q207": st.just(400), "Q385": st.just(600),
    "Q253": st.sampled_from([2000]), "Q357": st.floats(0, 3), "Q200": st.floats(0.5, 4), "Q204": st.sampled_from([1, 30]),
    "Q220": st.sampled_from([0, 8, 14]), "Q368": st.sampled_from([0.3, 1]), "Q338": st.sampled_from([0, 1.5]),
}  # fmt: skip
LIMITS = st.lists(st.sampled_from([-2, -1, 0, 1, 2]), min_size=3, max_size=3)


def between(v, walls, inset, radius):
    """The surface, far beyond its open sides, less an inset at its walls; corners of walls as round as they shall be."""
    x, y, far = v["Q218"] / 2, v["Q219"] / 2, 300
    low = -(x - inset if -1 in walls else far), -(y - inset if -2 in walls else far)
    area = box(*low, x - inset if 1 in walls else far, y - inset if 2 in walls else far)
    corner = max(v["Q220"] - inset, radius)
    return area.buffer(-corner).buffer(corner, quad_segs=200)


@settings(max_examples=12)
@given(v=st.fixed_dictionaries(SURFACES), limits=LIMITS, signs=st.tuples(*[st.sampled_from([-1, 1])] * 2),
       radius=st.floats(2, 6), place=st.integers(-1, 4), edges=st.sampled_from([0, 1.5]))  # fmt: skip
def test_a_surface_is_cleared_and_its_walls_are_kept(v, limits, signs, radius, place, edges, sweeps):
    a, b = v["Q218"], v["Q219"]
    words = v | dict(zip(("Q347", "Q348", "Q349"), limits, strict=True))
    words |= {"Q218": signs[0] * a, "Q219": signs[1] * b, "Q367": place}
    rows = [(row, label) for row, label in milled(233, words, radius, edges) if "CYCL DEF" in label]
    x, y = [(0, 0), (1, 1), (-1, 1), (-1, -1), (1, -1), signs][place]
    centre = PLACE[0] + x * a / 2, PLACE[1] + y * b / 2
    walls = set(limits) - {0}
    surface = affinity.translate(box(-a / 2, -b / 2, a / 2, b / 2), *centre)
    kept, wall = (affinity.translate(between(v, walls, inset, radius), *centre) for inset in (v["Q368"], 0.0))

    levels = sweeps.by_level(part(rows, "level"), radius)
    rest, deepest = v["Q386"] + v["Q369"], min(v["Q202"], edges or 99)
    steps = -np.diff([0, *sorted(levels, reverse=True)])
    assert steps == pytest.approx(np.full(len(steps), -rest / len(steps)), abs=1e-5) and steps[0] <= deepest + 1e-5
    last = sweeps.by_level(part(rows, "floor finishing"), radius)
    assert min(last) == pytest.approx(v["Q386"], abs=1e-6) and max(last) - min(last) < v["Q369"]
    for area in (*levels.values(), *last.values()):
        assert surface.intersection(kept.buffer(-2 * MICRON)).difference(area).area < 1e-4
        assert area.difference(kept.buffer(MICRON)).area < 1e-6
    sides = sweeps.by_level(part(rows, "side finishing"), radius)
    assert bool(sides) == bool(walls) and (not sides or min(sides) == pytest.approx(v["Q386"], abs=1e-6))
    for area in sides.values():
        assert area.difference(wall.buffer(MICRON)).area < 1e-6
        stays = surface.intersection(wall.buffer(-2 * MICRON)).difference(kept).difference(area)
        assert stays.area < 1e-4
    if v["Q200"] < steps[0]:  # the way back that the manual says is not above the next line: a warning says so
        rows = [(row, label) for row, label in rows if not label.endswith(", back")]
    no_rapid_cuts(rows, radius, surface.union(box(-400, -400, 400, 400).difference(wall)), sweeps)
    assert rows[-1][0].end[2] == pytest.approx(max(v["Q200"], v["Q204"]))
    assert min(row.end[2] for row, _ in rows) == pytest.approx(v["Q386"])


@settings(max_examples=6)
@given(v=st.fixed_dictionaries(SURFACES), signs=st.tuples(*[st.sampled_from([-1, 1])] * 2), radius=st.floats(2, 6))
def test_a_spiral_clears_the_surface(v, signs, radius, sweeps):
    a, b = signs[0] * v["Q218"], signs[1] * v["Q219"]
    words = v | {"Q389": 4, "Q218": a, "Q219": b, "Q347": 0, "Q348": 0, "Q349": 0}
    rows = [(row, label) for row, label in milled(233, words, radius, 0) if "CYCL DEF" in label]
    (x, x1), (y, y1) = sorted((PLACE[0], PLACE[0] + a)), sorted((PLACE[1], PLACE[1] + b))
    surface = box(x, y, x1, y1)
    for area in sweeps.by_level(rows, radius).values():
        assert surface.buffer(-MICRON).difference(area).area < 1e-4
    way = np.array([row.end[:2] for row, label in rows if "spiral" in label and "finishing" not in label])[:5]
    way = way - np.mean([(x, y), (x1, y1)], axis=0)
    assert (way[:-1, 0] * way[1:, 1] - way[:-1, 1] * way[1:, 0] < 0).all()  # clockwise
    no_rapid_cuts(rows, radius, surface, sweeps)

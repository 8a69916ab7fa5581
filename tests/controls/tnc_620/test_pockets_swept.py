"""What cycles 251 to 254 take away, swept level by level (shapely); the figures are drawn from their own numbers.

A figure is cleared as far as a round tool reaches, its walls are kept within a micrometre, allowances are what stays, no
infeed is deeper than it may be, and below the surface no rapid touches what stands.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Point, affinity, box, union_all
from tools.running import labelled, run

import mnclab
from mnclab import Kind, Setup, Tool

pytestmark = pytest.mark.deep

MICRON = 1e-3
PLACE = (12.0, -7.0)


def rectangle(v, radius):
    """251: about the tool at the centre or at a corner, turned about the tool."""
    a, b, corner = v["Q218"], v["Q219"], max(v["Q220"], radius)
    x, y = [(0, 0), (a / 2, b / 2), (-a / 2, b / 2), (-a / 2, -b / 2), (a / 2, -b / 2)][int(v["Q367"])]
    inner = box(x - a / 2 + corner, y - b / 2 + corner, x + a / 2 - corner, y + b / 2 - corner)
    pocket = inner.buffer(corner, quad_segs=500)
    return affinity.translate(affinity.rotate(pocket, v["Q224"], origin=(0, 0)), *PLACE)


def circle(v, radius):
    """252: about the tool."""
    return Point(PLACE).buffer(v["Q223"] / 2, quad_segs=500)


def slot(v, radius):
    """253: along X from the tool, turned about it."""
    length, half = v["Q218"], (v["Q218"] - v["Q219"]) / 2
    x = (0, length / 2, half, -half, -length / 2)[int(v["Q367"])]
    line = affinity.rotate(LineString([(x - half, 0), (x + half, 0)]), v["Q374"], origin=(0, 0))
    return affinity.translate(line.buffer(v["Q219"] / 2, quad_segs=500), *PLACE)


def bent_slot(v, radius):
    """254: on the pitch circle about (Q216, Q217), once."""
    way = np.radians(v["Q376"] + np.linspace(0, v["Q248"], 2001))
    points = np.stack([np.cos(way), np.sin(way)], axis=1) * v["Q375"] / 2 + (v["Q216"], v["Q217"])
    return LineString(points).buffer(v["Q219"] / 2, quad_segs=500)


POSITION = st.integers(0, 4)
TURN = st.floats(-180, 180)
FIGURES = {
    251: (rectangle, {
        "Q218": st.floats(31.5, 60), "Q219": st.floats(22, 60), "Q220": st.sampled_from([0, 5.5, 9]), "Q224": TURN,
        "Q367": POSITION, "Q370": st.floats(0.4, 1.9999), "Q366": st.sampled_from([0, 1, 2]),
    }),
    252: (circle, {"Q223": st.floats(24, 60), "Q370": st.floats(0.4, 1.9999), "Q366": st.just(1)}),
    253: (slot, {
        "Q219": st.floats(11.5, 30), "Q218": st.floats(31, 70), "Q374": TURN, "Q367": POSITION,
        "Q366": st.sampled_from([0, 1, 2]),
    }),
    254: (bent_slot, {
        "Q219": st.floats(11.5, 30), "Q375": st.floats(35, 80), "Q367": st.just(0), "Q216": st.just(3), "Q217": st.just(4),
        "Q376": TURN, "Q248": st.floats(20, 330), "Q378": st.just(0), "Q377": st.just(1),
        "Q366": st.sampled_from([0, 1, 2]),
    }),
}  # fmt: skip
COMMON = {
    "Q215": st.just(0), "Q368": st.sampled_from([0.25, 0.6]), "Q207": st.just(400), "Q351": st.sampled_from([1, -1, 0]),
    "Q201": st.floats(-9, -3), "Q202": st.floats(2, 6), "Q369": st.sampled_from([0.2, 0.7]), "Q206": st.just(90),
    "Q338": st.sampled_from([0, 2.5]), "Q200": st.floats(0.5, 4), "Q203": st.just(0), "Q204": st.sampled_from([1, 30]),
    "Q385": st.just(900), "Q439": st.sampled_from([0, 3]),
}  # fmt: skip


def milled(number, v, radius, edges):
    """Pairs of a motion and its label."""
    definition = "\n".join([f"CYCL DEF {number} A", *(f"{address}={v[address]:.9f}" for address in sorted(v))])
    tools = {1: Tool(radius=radius, plunge_angle=4, cutting_length=edges)}
    program = f"TOOL CALL 1 Z S1000\n{definition}\nCYCL CALL M3"
    return labelled(run(program, "tnc-620", tools=tools, start=(*PLACE, 40.0)).toolpath)


def reach(area, radius):
    """What a round tool reaches of an area."""
    return area.buffer(-radius, quad_segs=100).buffer(radius, quad_segs=100)


@pytest.mark.parametrize("number", FIGURES)
@settings(max_examples=8)
@given(data=st.data(), radius=st.floats(2, 5), edges=st.sampled_from([0, 1.5]))
def test_a_figure_is_cleared_and_nothing_beyond_it(number, data, radius, edges, sweeps):
    figure, shape = FIGURES[number]
    v = data.draw(st.fixed_dictionaries(shape | COMMON))
    rows, wall = milled(number, v, radius, edges), figure(v, radius)
    floor, rest = v["Q201"], v["Q201"] + v["Q369"]

    def part(name):
        return [(row, label) for row, label in rows if name in label]

    roughing = sweeps.by_level(part("layer"), radius)
    kept = wall.buffer(-v["Q368"], quad_segs=100)
    whole = reach(kept, radius)
    infeed = min(v["Q202"], edges or 99)
    levels = {round(row.end[2], 6) for row, label in part("layer") if "ring" in label or "circle" in label}
    levels = sorted(levels, reverse=True)
    steps, full = -np.diff([0, *levels]), len(levels) - 1
    assert steps == pytest.approx([infeed] * full + [-rest - infeed * full], abs=1e-5) and steps[-1] <= infeed + 1e-5
    for level in levels:
        area = roughing[level]
        assert area.intersection(whole).area >= 0.999 * whole.area
        assert area.difference(kept.buffer(MICRON)).area < 1e-6
    for area in roughing.values():  # the ways down too
        assert area.difference(kept.buffer(MICRON)).area < 1e-6
    centres = union_all([sweeps.line_of(row) for row, _ in part("layer") if row.kind != Kind.RAPID])
    assert wall.exterior.distance(centres) - radius == pytest.approx(v["Q368"], abs=MICRON)

    sides = sweeps.by_level(part("side finishing"), radius)
    assert min(sides) == pytest.approx(rest, abs=1e-5)
    for area in sides.values():
        assert area.difference(wall.buffer(MICRON)).area < 1e-6
        around = wall.buffer(-radius, quad_segs=100).exterior
        assert around.difference(area.buffer(MICRON)).length < 1e-6  # the centre goes once round
    bottom = sweeps.by_level(part("floor finishing"), radius)
    whole, area = reach(wall, radius), bottom[round(floor, 6)]
    assert area.intersection(whole).area >= 0.999 * whole.area
    assert area.difference(wall.buffer(MICRON)).area < 1e-6

    heights = [row.end[2] for row, _ in rows]
    assert min(heights) == pytest.approx(floor, abs=1e-9)
    assert heights[-1] == pytest.approx(max(v["Q200"], v["Q204"]))
    sweeps.no_rapid_cuts(rows, radius)


@settings(max_examples=6)
@given(angle=st.floats(1, 80), width=st.floats(8, 20), opening=st.floats(5, 360), vertical=st.booleans())
def test_a_ramp_never_sinks_steeper_than_the_tool_may(angle, width, opening, vertical):
    """In 254, where it is bent: dz over the length of the way is at most the tangent of ANGLE."""
    words = f"Q215=0 Q219={width:.6f} Q368=.2 Q375=60 Q367=0 Q216=0 Q217=0 Q376=0 Q248={opening:.6f} Q378=0 Q377=1 Q207=400 "
    words += "Q351=1 Q201=-9 Q202=4 Q369=.2 Q206=90 Q338=0 Q200=2 Q203=0 Q204=9 Q385=300 Q366=2"
    setup = Setup(tools={1: Tool(radius=3, plunge_angle=angle)}, start=(0, 0, 30))
    text = "TOOL CALL 1 Z S1000\n" + "\n".join(["CYCL DEF 254 A", *words.split()]) + "\nCYCL CALL M3\n"
    found = mnclab.run(text, "tnc-620", setup)
    assert found.ok, found.alarms
    path = found.toolpath
    ramp = path[np.array(["entry ramp" in path.labels[k] for k in path.label])]
    assert len(ramp)
    drop = ramp.start[:, 2] - ramp.end[:, 2]
    assert (drop / (30 * abs(ramp.sweep)) <= math.tan(math.radians(angle)) + 1e-9).all()


@pytest.mark.parametrize("mode", [1, -1])
def test_a_ring_slot_is_cleared(mode, sweeps):
    """Q248 = 360: all between the radii 34 - and 46; the wall is kept on both sides."""
    words = {"Q215": 0, "Q219": 12, "Q368": 0.2, "Q375": 80, "Q367": 0, "Q216": 0, "Q217": 0, "Q376": 30, "Q248": 360,
             "Q378": 0, "Q377": 1, "Q207": 400, "Q351": mode, "Q201": -4, "Q202": 4, "Q369": 0.1, "Q206": 90, "Q338": 0,
             "Q200": 2, "Q203": 0, "Q204": 9, "Q385": 300, "Q366": 1, "Q439": 0}  # fmt: skip
    rows = milled(254, words, 5, 0)
    ring = Point(0, 0).buffer(46, quad_segs=2000).difference(Point(0, 0).buffer(34, quad_segs=2000))
    area = sweeps.by_level([(row, label) for row, label in rows if "floor" in label], 5)[-4]
    assert area.symmetric_difference(ring).area < 0.001 * ring.area
    assert area.difference(ring.buffer(MICRON)).area < 1e-6
    sweeps.no_rapid_cuts(rows, 5)

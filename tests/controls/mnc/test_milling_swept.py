"""What the milling cycles take away: discs of the tool swept along the path (shapely), level by level.

The outline of a pocket is built from its own numbers, by shapely alone. A pocket is cleared as far as a round tool reaches,
is never left by more than a micrometre, and the allowances are what stays.
"""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Point, affinity, box, union_all
from tools.running import labelled, run

import mnclab
from mnclab import Kind, Setup, Tool

pytestmark = pytest.mark.deep

MICRON = 1e-3


def milled(text, radius, start=(12.0, -7.0, 30.0)):
    tool = Tool(radius=radius, plunge_angle=4)
    return labelled(run(text, before="T1\n", tools={1: tool}, start=start).toolpath)


def outline(code, v, radius, place):
    """The pocket as the drawing shows it."""
    if code == "G344":
        return Point(place).buffer(v["D"] / 2, quad_segs=500)
    corner = max(v["R"], radius)
    a, b = v["A"] / 2 - corner, v["B"] / 2 - corner
    inner = box(-a, -b, a, b) if min(a, b) > 0 else LineString([(-a, -b), (a, b)])
    pocket = affinity.rotate(inner.buffer(corner, quad_segs=500), v["E"], origin=(0, 0))
    return affinity.translate(pocket, *place)


SHAPES = {
    "G343": {
        "A": st.floats(22, 60),
        "B": st.floats(22, 60),
        "R": st.sampled_from([0, 4, 9]),
        "E": st.floats(-180, 180),
    },
    "G344": {"D": st.floats(20, 60)},
}
COMMON = {
    "H": st.floats(-9, -3), "P": st.floats(2, 6), "Q": st.floats(0.5, 4), "U": st.sampled_from([0.25, 0.6]),
    "W": st.sampled_from([0.2, 0.7]), "I": st.sampled_from([0, 2.5]), "K": st.floats(0.4, 1.4), "J": st.sampled_from([0, 1]),
    "L": st.sampled_from([1, -1]), "V": st.just(90), "F": st.just(400), "T": st.just(900), "Z": st.just(0),
}  # fmt: skip


@pytest.mark.parametrize("code", ["G343", "G344"])
@settings(max_examples=6)
@given(data=st.data(), radius=st.floats(2, 5))
def test_a_pocket_is_cleared_and_nothing_beyond_it(code, data, radius, sweeps):
    v = data.draw(st.fixed_dictionaries(SHAPES[code] | COMMON))
    text = " ".join([code, *(f"{address}{value:.9f}" for address, value in v.items())])
    rows, place = milled(text, radius), (12.0, -7.0)
    wall = outline(code, v, radius, place)
    floor, rest = v["H"], v["H"] + v["W"]

    def part(*names):
        return [(row, label) for row, label in rows if any(name in label for name in names)]

    roughing = sweeps.by_level(part("layer"), radius)
    kept = wall.buffer(-v["U"], quad_segs=100)
    reach = kept.buffer(-radius, quad_segs=100).buffer(radius, quad_segs=100)
    for level, area in roughing.items():
        if level < 0:  # on the surface the tool goes to the start of its helix
            assert area.intersection(reach).area >= 0.999 * reach.area
            assert area.difference(kept.buffer(MICRON)).area < 1e-6
    deepest = min(roughing)
    assert deepest == pytest.approx(rest, abs=MICRON)
    centres = union_all([sweeps.line_of(row) for row, _ in part("layer") if row.kind != Kind.RAPID])
    assert wall.exterior.distance(centres) - radius == pytest.approx(v["U"], abs=MICRON)

    walls = sweeps.by_level(part("side finishing"), radius)
    assert min(walls) == pytest.approx(rest, abs=MICRON)
    for area in walls.values():
        assert area.difference(wall.buffer(MICRON)).area < 1e-6
        sides = wall.buffer(-radius, quad_segs=100).exterior
        assert sides.difference(area.buffer(MICRON)).length < 1e-6  # the centre goes once round
    bottom = sweeps.by_level(part("floor finishing"), radius)
    assert min(bottom) == pytest.approx(floor, abs=MICRON)
    reach = wall.buffer(-radius, quad_segs=100).buffer(radius, quad_segs=100)
    area = bottom[round(floor, 6)]
    assert area.intersection(reach).area >= 0.999 * reach.area
    assert area.difference(wall.buffer(MICRON)).area < 1e-6
    sweeps.no_rapid_cuts(rows, radius)


def test_a_ramp_clears_its_slope(sweeps):
    """After a reciprocating plunge nothing of the slope stands at the level: level moves alone cover the pocket."""
    for block in ("G343 A60 B30", "G343 A30 B60 E20", "G343 A50 B50 R12"):
        rows = milled(f"{block} Z0 H-6 P3 Q2 K1.2 J2 F400 V90", 4.0)
        sweeps.no_rapid_cuts(rows, 4.0)
        sloping = [
            row for row, _ in rows if row.kind == Kind.LINE and row.start[2] > row.end[2] and row.end[0] != row.start[0]
        ]
        assert sloping
        for level, area in sweeps.by_level(rows, 4.0).items():
            for row in sloping:
                if level in (-3, -6) and level + 3 >= row.start[2]:
                    assert sweeps.disc(sweeps.line_of(row), 4.0 - MICRON).difference(area).area < 1e-6


@settings(max_examples=25)
@given(
    strategy=st.sampled_from([0, 1, 2]), a=st.floats(5, 90), b=st.floats(5, 60), overlap=st.floats(0.5, 1.999),
    radius=st.floats(3, 10), allowance=st.sampled_from([0, 0.4]),
)  # fmt: skip
def test_face_milling_covers_the_surface(strategy, a, b, overlap, radius, allowance, sweeps):
    """All of it on every level; with L1 all between the places where it turns, beyond which it leaves scallops."""
    rows = milled(
        f"G321 L{strategy} X3 Y4 Z0 W-3 A{a:.6f} B{b:.6f} Q2 P2 K{overlap:.6f} F400 V900 I1 U{allowance}", radius
    )
    surface = box(3, 4, 3 + a, 4 + b)
    cutting = [(row, label) for row, label in rows if "over" not in label and "lift" not in label]
    levels = sweeps.by_level(cutting, radius)
    assert min(levels) == pytest.approx(-3) and len(levels) == 2 + (allowance > 0)
    turn = min(radius, a / 2)
    reach = surface if strategy != 1 else box(3 + turn, 4, 3 + a - turn, 4 + b)
    for area in levels.values():
        rest = reach.difference(area.buffer(MICRON))
        assert rest.area <= 0.001 * reach.area and (reach.area > 1 or rest.length < 0.01)
    if strategy == 1:  # beside the surface only at the first start
        later = [row for row, label in cutting if row.start[2] < 0 and "layer 1" not in label]
        for row in later:
            assert Point(row.end[:2]).distance(surface) < 1e-9 and Point(row.start[:2]).distance(surface) < 1e-9


@settings(max_examples=20)
@given(a=st.floats(0, 90), b=st.floats(5, 60), radius=st.floats(3, 10), count=st.integers(1, 30))
def test_lines_cover_the_surface_or_the_notice_says_that_they_do_not(a, b, radius, count, sweeps):
    tool = Setup(tools={1: Tool(radius=radius)}, start=(0, 0, 30))
    found = mnclab.run(f"T1\nG320 X3 Y4 Z0 A{a:.6f} B{b:.6f} K{count} V90 F400 Q2\n", "mnc", tool)
    rows = [(row, "") for row in found.toolpath[found.toolpath.is_motion]]
    area = sweeps.by_level(rows, radius)[0]
    left = box(3, 4, 3 + a, 4 + b).difference(area.buffer(MICRON)).area
    assert (left > 1e-3 * a) == (any("strips uncut" in alarm.message for alarm in found.alarms) and a > 0) or a < 1

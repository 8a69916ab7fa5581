"""Cycles 27, 28, 29 and 39 (chapter 9): the manual's programs C27 and C28, closed forms of paths, feeds and walls."""

from __future__ import annotations

import math

import numpy as np
import pytest

import mnclab as mnc
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import cross

TOOLS = {1: mnc.Tool(number=1, radius=3.5), 2: mnc.Tool(number=2, radius=4.0), 3: mnc.Tool(number=3, radius=5.0)}
C27 = """0 BEGIN PGM C27 MM
1 TOOL CALL 1 Z S2000
2 L Z+250 R0 FMAX
3 L X+50 Y0 R0 FMAX
4 PLANE SPATIAL SPA+0 SPB+90 SPC+0 TURN MBMAX FMAX
5 CYCL DEF 14.0 CONTOUR GEOMETRY
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 27 CYLINDER SURFACE
  Q1=-7
  Q3=+0
  Q6=2
  Q10=4
  Q11=100
  Q12=250
  Q16=25
  Q17=1
8 L C+0 R0 FMAX M13 M99
9 L Z+250 R0 FMAX
10 PLANE RESET TURN FMAX
11 M2
12 LBL 1
13 L X+40 Y+20 RL
14 L X+50
15 RND R7.5
16 L Y+60
17 RND R7.5
18 L IX-20
19 RND R7.5
20 L Y+20
21 RND R7.5
22 L X+40 Y+20
23 LBL 0
24 END PGM C27 MM
"""
S_SHAPE = "L X+60 Y+0 RL\nL Y-35\nL X+40 Y-52.5\nL Y-70"
C28 = (
    C27[: C27.index("7 CYCL")].replace("MBMAX ", "").replace("C27", "C28")
    + "7 CYCL DEF 28 CYLINDER SURFACE\n Q1=-7\n Q3=+0\n Q6=2\n Q10=-4\n Q11=100\n Q12=250\n Q16=25\n Q17=1\n Q20=10\n Q21=0.02\n"
    + "8 L C+0 R0 FMAX M3 M99\n9 L Z+250 R0 FMAX\n10 PLANE RESET TURN FMAX\n11 M2\n12 LBL 1\n"
    + S_SHAPE
    + "\nLBL 0\n18 END PGM C28 MM\n"
)


def setup(**settings) -> mnc.Setup:
    return mnc.Setup(tools=TOOLS, settings=settings)


def program(cycle: int, contour: str = S_SHAPE, tool: int = 1, before: str = "", call: str = "M3 M99", unit: str = "MM", **q):
    """A program with the tool along Z and the cylinder about A; the contour stands in label 1."""
    values = {"Q1": -7, "Q3": 0, "Q6": 5, "Q10": 4, "Q11": 100, "Q12": 250, "Q16": 25, "Q17": 1, **q}
    words = "\n".join(f"  {name}={value}" for name, value in values.items())
    return (
        f"0 BEGIN PGM A {unit}\nTOOL CALL {tool} Z S2000\nL X+0 Y+0 Z+100 R0 FMAX\n{before}\n"
        f"CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 1\nCYCL DEF {cycle} CYLINDER\n{words}\nL X+0 R0 FMAX {call}\nM2\n"
        f"LBL 1\n{contour}\nLBL 0\nEND PGM A {unit}\n"
    )


def run(text: str, ok: bool = True, **settings) -> mnc.Run:
    found = mnc.run(text, "tnc-620", setup(**settings))
    assert found.ok is ok, found.alarms
    return found


def flat(found: mnc.Run, label: str) -> np.ndarray:
    """The ends (n, 3) on the developed surface of the rows with a label."""
    return found.toolpath.labelled(label).unrolled().end


def holds(points: np.ndarray, *expected: tuple[float, ...]) -> bool:
    """Whether all expected points are among others, within a micrometre, in this order."""
    places = [int(np.argmin(np.linalg.norm(points - one, axis=1))) for one in expected]
    return places == sorted(places) and max(np.linalg.norm(points[k] - e) for k, e in zip(places, expected, strict=True)) < 1e-3


# --- the manual's programs ---------------------------------------------------------------------------------------------


def test_c27():
    """9.6: centre path, infeed point, levels and angles; the rotary axis is the table C, whose axis is Z of the machine."""
    found = run(C27, rotary_axes="CB")
    first, second = (flat(found, f"level {k} of 2, contour") for k in (1, 2))
    corners = [(42.5, 23.5), (46.5, 27.5), (46.5, 52.5), (42.5, 56.5), (37.5, 56.5), (33.5, 52.5), (33.5, 27.5), (37.5, 23.5)]
    assert holds(first, *((u, y, -4) for u, y in corners)) and holds(second, *((u, y, -7) for u, y in corners))
    assert found.toolpath.unrolled().labelled("level 1 of 2, contour").length == pytest.approx(85.133, abs=1e-3)
    rows = found.toolpath.labelled("CYCL DEF 27")
    assert rows.end[1].tolist() == pytest.approx([27, 0, 23.5]) and rows.end[2].tolist() == pytest.approx([21, 0, 23.5])
    angles = np.degrees(rows.labelled("contour").rotary[:, 2])
    assert (angles.min(), angles.max()) == (pytest.approx(76.776, abs=1e-3), pytest.approx(106.570, abs=1e-3))
    assert np.degrees(rows.rotary[0]).tolist() == pytest.approx([0, 90, 91.673], abs=1e-3)
    assert abs(rows.end[:, 1]).max() < 1e-9  # the tool always points to the axis


def test_c27_on_the_workpiece():
    """The tool tips in the cylinder frame as the catalogue has them."""
    path = run(C27, rotary_axes="CB").toolpath
    points, rows = path.on_workpiece().points()
    for expected in ((-0.613, 20.991, 23.5), (-0.526, 17.992, 23.5), (-5.133, 17.252, 27.5), (4.118, 17.523, 52.5)):
        assert np.linalg.norm(points - expected, axis=1).min() < 2e-3
    assert points[-1] == pytest.approx([250 * math.cos(1.6), 250 * math.sin(1.6), 23.5])  # as C stands at the end
    assert (np.diff(rows) >= 0).all()


def test_c28():
    """9.6: midpoint, displaced by 1.5 mm; forward on the right, back on the left, both levels; no remachining is needed."""
    found = run(C28, rotary_axes="CB")
    for k, depth in ((1, -4.0), (2, -7.0)):
        right, left = (flat(found, f"level {k} of 2, {which} wall") for which in ("first", "second"))
        assert holds(right, (58.5, -34.319, depth), (38.5, -70, depth)) and right[0, 0] == pytest.approx(58.5)
        assert holds(left, (41.5, -53.181, depth), (61.5, -35.681 + 0.681, depth), (61.5, 0, depth))
    rows = found.toolpath.labelled("wall")
    angles = np.degrees(rows.rotary[:, 2])
    assert (angles.min(), angles.max()) == (pytest.approx(91.673, abs=1e-3), pytest.approx(137.510, abs=1e-3))
    assert set(np.round(rows.end[:, 0], 9)) == {21.0, 18.0}
    straight = rows[np.abs(angles - 137.50987) < 1e-4]  # along the axis the displacement is across it
    assert set(np.round(np.abs(straight.end[straight.end[:, 2] > -34, 1]), 9)) >= {1.5}
    assert not len(found.toolpath.labelled("remachining"))


@pytest.mark.parametrize("cycle", [27, 28, 29, 39])
def test_the_definitions(cycle):
    """Definitions of 9.2 to 9.5: levels 22, 19 and 17 mm from the axis; 90 degrees are 39.270 mm."""
    more = {28: {"Q20": 12, "Q21": 0}, 29: {"Q20": 12}}.get(cycle, {})
    contour = "L X+0 Y+10 RL\nL X+90"
    found = run(program(cycle, contour, 2, Q1=-8, Q6=0, Q10=3, Q12=350, Q17=0, **more))
    z = found.toolpath.labelled("level").end[:, 2]
    assert list(dict.fromkeys(z[np.isin(np.round(z, 9), (22, 19, 17))].round(9))) == [22, 19, 17]
    assert np.degrees(found.toolpath.rotary[:, 0]).max() == pytest.approx(90)
    if cycle == 27:
        assert flat(found, "contour")[-1] == pytest.approx([39.270, 14, -8], abs=1e-3)
    if cycle == 39:
        assert found.toolpath.labelled("level 3 of 3, wall").end[-1] == pytest.approx([14, 0, 17])


# --- the contour -------------------------------------------------------------------------------------------------------

ELEMENTS = "L X{0} Y+0 R{s}\nL X{1}\nRND R6\nL Y+30\nCHF 4\nL X{0}\nCT X{2} Y+40\nCR X{0} Y+60 R12 DR+"


@pytest.mark.parametrize("side", ["L", "R"])
def test_degrees_and_mm_are_the_same_contour(side):
    """Roundings, chamfers, radii and tangents count in mm, whatever X is written in; also as increments."""
    u = (10.0, 45.0, 2.0)
    both = [ELEMENTS.format(*(f"{x * unit:+.12f}" for x in u), s=side) for unit in (1.0, 180 / math.pi / 25)]
    one, other = (run(program(27, c, Q17=k)).toolpath for c, k in zip(both, (1, 0), strict=True))
    assert len(one) == len(other) and abs(one.rotary - other.rotary).max() < 1e-9 and abs(one.end - other.end).max() < 1e-9
    stepwise = "L X+10 Y+0 RL\nL IX+{:.12f}\nRND R6\nL IY+30"
    pair = [run(program(27, stepwise.format(35 * k), Q17=t)).toolpath for k, t in ((1, 1),)]
    degrees = stepwise.replace("X+10", f"X+{math.degrees(10 / 25):.12f}").format(math.degrees(35 / 25))
    pair.append(run(program(27, degrees, Q17=0)).toolpath)
    assert abs(pair[0].rotary - pair[1].rotary).max() < 1e-9


@pytest.mark.parametrize("side", ["L", "R"])
def test_the_unrolled_path_is_that_of_the_plane(side):
    """The same contour with radius compensation in the plane: the same ends of elements, the same arcs, to 1e-9 mm."""
    contour = ELEMENTS.format("+10", "+45", "+2", s=side)
    aside = "+20" if side == "L" else "-20"
    plane = run(f"0 BEGIN PGM B MM\nTOOL CALL 1 Z S2000 F250\nL X+10 Y{aside} R0 FMAX\n{contour}\nEND PGM B MM\n").toolpath.motion
    plane = plane[2:]  # without the way to the contour
    points = flat(run(program(27, contour)), "level 1 of 2, contour")[:, :2]
    for end in plane.end[:, :2]:
        assert np.hypot(*(points - end).T).min() < 1e-9
    assert outline_of(plane).distance(points).max() < 1e-9


def outline_of(path: mnc.Toolpath) -> Contour:
    bulge = np.append(np.tan(np.where(path.kind == mnc.Kind.ARC, path.sweep, 0) / 4), 0)
    return Contour(np.vstack([path.start[:1, :2], path.end[:, :2]]), bulge, closed=False)


def test_chords_are_within_a_tenth_of_a_micrometre():
    points = flat(run(C27, rotary_axes="CB"), "level 1 of 2, contour")[:, :2]
    arc = points[(points[:, 0] > 42.5) & (points[:, 1] < 27.5)]
    assert np.hypot(*(arc - (42.5, 27.5)).T) == pytest.approx(4, abs=1e-9)
    assert 4 - np.hypot(*((arc[1:] + arc[:-1]) / 2 - (42.5, 27.5)).T).min() < 1e-4


def test_an_inch_program():
    """X in inches with Q17 = 1, in degrees with 0; Q16 is in inches, too."""
    contour = "L X+{} Y+0 RL\nL X+{}"
    lengths = {"Q1": -0.2, "Q6": 0.2, "Q10": 0.1, "Q11": 4, "Q12": 10, "Q16": 1}
    mm = run(program(27, contour.format(0, 1), unit="INCH", Q17=1, **lengths))
    degrees = run(program(27, contour.format(0, f"{math.degrees(1):.12f}"), unit="INCH", Q17=0, **lengths))
    for found in (mm, degrees):
        assert flat(found, "level 2 of 2, contour")[-1] == pytest.approx([25.4, 3.5, -5.08], abs=1e-6)


def test_the_allowance_and_no_side():
    """27: r + Q3 beside the contour; on it with R0."""
    assert flat(run(program(27, Q3=0.5)), "contour")[0] == pytest.approx([64, -35, -4])
    assert flat(run(program(27, S_SHAPE.replace("RL", "R0"))), "contour")[0] == pytest.approx([60, -35, -4])


# --- feeds, levels, positions ------------------------------------------------------------------------------------------


def test_the_feed_is_that_along_the_developed_surface():
    """Q12 = 250 everywhere on the wall, Q11 = 100 down; 39.270 mm round at 250 mm/min take 9.425 s."""
    found = run(program(27, "L X+0 Y+0 R0\nL X+90", Q17=0, Q1=-4))
    row = found.toolpath.labelled("contour")
    assert row.lengths.tolist() == [0] and row.time.tolist() == pytest.approx([60 * 25 * math.pi / 2 / 250])
    assert row.feed.tolist() == pytest.approx([250 / 25])  # rad/min
    wrapped = row.on_workpiece()
    assert wrapped.lengths.tolist() == pytest.approx([21 * math.pi / 2])
    assert wrapped.feed.tolist() == pytest.approx([250 * 21 / 25])
    slot = run(program(28, Q20=10)).toolpath.labelled("wall").unrolled()
    assert slot.feed[slot.lengths > 1e-6] == pytest.approx(250)
    assert run(program(28, Q20=10)).toolpath.labelled("plunge").feed.tolist() == [100, 100]


def test_the_way_of_27_level_by_level():
    """Over the begin, down to Q6, plunge, contour, up to Q6, back; at the end to the height from before."""
    found = run(program(27, "L X+0 Y+0 R0\nL X+50"))
    rows = found.toolpath.labelled("CYCL DEF 27").unrolled()
    levels = [[[0, z], [50, z], [50, 5]] for z in (-4, -7)]
    assert np.round(rows.end[:, [0, 2]], 9).tolist() == [[0, 5], *levels[0], [0, 5], *levels[1], [50, 75]]


def test_a_tool_below_the_set_up_clearance_goes_up_first():
    found = run(program(27, before="L Z+28 R0 FMAX"))
    rows = found.toolpath[found.toolpath.is_motion & (found.toolpath.label > 0)]
    assert rows.end[0, 2] == 30 and rows.end[-1, 2] == 30 and (rows.kind[:1] == mnc.Kind.RAPID).all()


@pytest.mark.parametrize("q10", [4, -4])
def test_the_sign_of_the_infeed_does_not_count(q10):
    assert flat(run(program(27, Q10=q10)), "plunge")[:, 2].tolist() == [-4, -7]


def test_a_depth_of_nothing_is_said():
    found = run(program(27, Q1=0))
    assert not len(found.toolpath.labelled("level")) and "not executed" in found.alarms[0].message


# --- slot, ridge, wall -------------------------------------------------------------------------------------------------


def test_the_walls_of_a_slot_are_as_far_apart_at_every_depth():
    """28: the tool reaches e + r beside the plane of the axis and the midpoint, on both sides, at each level; so the walls of
    a slot along the axis or round the cylinder are Q20 - 2 Q3 apart at every depth, to 1e-6 mm."""
    for contour, across in (("L X+20 Y+0 RL\nL Y-50", 1), ("L X+0 Y+0 RL\nL X+60", 0)):
        path = run(program(28, contour, Q20=10, Q3=0.25)).toolpath
        for k in (1, 2):
            one, other = (path.labelled(f"level {k} of 2, {which} wall").end[:, across] for which in ("first", "second"))
            assert np.ptp(one) < 1e-12 and np.ptp(other) < 1e-12
            assert abs(one[0] - other[0]) + 2 * 3.5 == pytest.approx(10 - 2 * 0.25, abs=1e-6)


def test_27_narrows_with_depth_and_28_does_not():
    """The same wall line: 27 turns the offset into an angle, so that it shrinks by rho / Q16 (9.1)."""
    line = "L X+20 Y+0 RL\nL Y-50"
    paths = (run(program(n, line, **q)).toolpath.labelled("level 2 of 2") for n, q in ((27, {}), (28, {"Q20": 14})))
    points27, points28 = (path.on_workpiece().points()[0] for path in paths)
    at = np.array([math.sin(20 / 25), math.cos(20 / 25)])  # e_r at the midpoint, in -y and z
    def offset(points):
        low = points[np.hypot(points[:, 1], points[:, 2]) < 19]
        return np.abs(-low[:, 1] * at[1] - low[:, 2] * at[0]).max()
    assert offset(points27) == pytest.approx(18 * math.sin(3.5 / 25), abs=1e-6)
    assert offset(points28) == pytest.approx(3.5, abs=1e-6)


@pytest.mark.parametrize("side", ["L", "R"])
def test_the_side_says_which_wall_comes_first(side):
    """RL is climb milling: forward on the right wall, here at smaller u; RR the other way round."""
    first = flat(run(program(28, S_SHAPE.replace("RL", f"R{side}"), Q20=10)), "level 1 of 2, first wall")
    assert first[0, 0] == pytest.approx(58.5 if side == "L" else 61.5)


@pytest.mark.parametrize("approach", ["CircleTangential", "LineNormal"])
def test_the_approach_in_a_slot(approach):
    """From the midpoint to the wall, e = 1.5: a half circle of that diameter, or straight."""
    rows = run(program(28, Q20=10), cylinder_approach=approach).toolpath.labelled("level 1 of 2, approach").unrolled()
    assert rows.length == pytest.approx(1.5 * math.pi / 2 if approach == "CircleTangential" else 1.5, abs=1e-3)
    assert rows.start[0, :2].tolist() == pytest.approx([60, 0]) and rows.end[-1, :2].tolist() == pytest.approx([58.5, 0])


def test_a_tool_as_wide_as_the_slot_runs_in_its_middle():
    found = run(program(28, Q20=7))
    assert holds(flat(found, "level 2 of 2, slot"), (60, -35, -7), (40, -52.5, -7), (40, -70, -7))
    assert abs(found.toolpath.labelled("slot").end[:, 1]).max() < 1e-9


def test_remachining_brings_the_slot_within_the_tolerance():
    """The oblique piece of C28 at the floor: the right wall misses the ideal one by 1.5 (1 - cos bend); with Q21 by at most
    that. The distance is that of the swept cylinder from the line of midpoints, both at the radius of the floor."""
    for tolerance, passes in ((0, 0), (0.005, 1), (0.001, 2)):
        found = run(program(28, Q20=10, Q21=tolerance))
        labels = {found.toolpath.labels[k] for k in found.toolpath.labelled("remachining").label}
        assert len({label.split(",")[0] for label in labels}) == passes
        bent = math.atan(0.875 * 25 / 18) - math.atan(0.875)
        widest = reach(found)
        assert widest <= 5 + 1e-6
        assert 5 - widest == pytest.approx(1.5 * (1 - math.cos(bent)), abs=1e-5) if not passes else 5 - widest < tolerance + 1e-6


def reach(found: mnc.Run) -> float:
    """How far the tool reaches beside the midpoints of the oblique piece, at the floor (rho 18): its centre lines there are
    (18 theta + s, y) with s across, straight in the plane of that radius as long as s stays."""
    path = found.toolpath[np.abs(found.toolpath.end[:, 2] - 18) < 1e-9]
    along = np.array([-20 * 18 / 25, -17.5]) / math.hypot(20 * 18 / 25, 17.5)
    middle = np.array([60 * 18 / 25, -35])
    far = 0.0
    for row in path.labelled("wall"):
        if abs(row.rotary[0] - row.from_angle) > 0.5 and abs(row.end[2] - row.start[2]) < 1e-9:
            s, y = -row.end[1], row.end[0]
            far = max(far, abs(float(cross(along, np.array([18 * row.rotary[0] + s, y]) - middle))) + 3.5)
    return far


def test_a_ridge():
    """9.4 with a tool of diameter 8: from 14 mm beside the first point, wall path at 10, half circles of 10 about the ends, a
    loop of 2 L + 2 pi 10 on each level; the approach is a quarter circle of r - Q3 = 4."""
    found = run(program(29, "L X+0 Y+0 RL\nL X+60", 2, Q20=12))
    start, wall = flat(found, "level 1 of 2, plunge")[-1], found.toolpath.labelled("level 1 of 2, wall").unrolled()
    assert start[:2].tolist() == pytest.approx([0, 14])
    assert wall.length == pytest.approx(2 * 60 + 2 * math.pi * 10, abs=1e-2)
    assert wall.start[0, :2].tolist() == pytest.approx([0, 10]) == wall.end[-1, :2].tolist()
    assert wall.end[:, 0].max() == pytest.approx(70, abs=1e-4) and wall.end[:, 1].min() == pytest.approx(-10, abs=1e-4)
    approach = found.toolpath.labelled("level 1 of 2, approach").unrolled()
    assert approach.length == pytest.approx(4 + 4 * math.pi / 2, abs=1e-3)
    assert flat(run(program(29, "L X+0 Y+0 RR\nL X+60", 2, Q20=12)), "plunge")[0, 1] == pytest.approx(-14)
    assert flat(run(program(29, "L X+0 Y+0 RL\nL X+60", 2, Q20=12, Q3=1)), "wall")[0, 1] == pytest.approx(11)


@pytest.mark.parametrize("approach", ["CircleTangential", "LineNormal"])
def test_a_wall(approach):
    """39: from 2 r beside the first point over r - Q3 to the wall path at r + Q3, and off it the same way."""
    found = run(program(39, "L X+0 Y+0 RL\nL X+60", 2, Q3=0.5), cylinder_approach=approach)
    assert flat(found, "level 1 of 2, plunge")[-1, :2].tolist() == pytest.approx([0, 8])
    assert flat(found, "level 1 of 2, wall")[-1, :2].tolist() == pytest.approx([60, 4.5])
    assert flat(found, "level 1 of 2, departure")[-1, :2].tolist() == pytest.approx([60, 8])
    lead = found.toolpath.labelled("level 1 of 2, approach").unrolled()
    assert lead.length == pytest.approx(3.5 + 3.5 * math.pi / 2 if approach == "CircleTangential" else 3.5, abs=1e-3)
    rows = found.toolpath.labelled("level 2 of 2, approach")
    assert (rows.rotary == rows.rotary[0]).all()  # the axis stands over the first point


# --- frames and axes ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("settings", "axis", "across"), [({}, 0, 1), ({"rotary_axes": "CB"}, 1, 0), ({"cylinder_axis": "B"}, 1, 0)]
)
def test_which_axis_carries_the_cylinder(settings, axis, across):
    """About A the circumference runs to -Y at the tool, about B to +X; Y of the contour lies along the axis."""
    found = run(program(39, "L X+0 Y+0 RL\nL Y+40", **{"Q17": 1}), **settings)
    assert np.flatnonzero(np.ptp(found.toolpath.rotary, axis=0)).tolist() in ([], [axis])
    wall = found.toolpath.labelled("level 1 of 2, wall").end[-1]
    assert wall[1 - across] == pytest.approx(40) and wall[across] == pytest.approx(3.5 if axis == 0 else -3.5)
    assert found.toolpath.cylinders[0].rotary == axis


def test_with_the_head_tilted_about_a():
    """PLANE SPATIAL SPA+90: the tool along -Y, the table C; the same path on the developed surface."""
    one = flat(run(C27, rotary_axes="CB"), "contour")
    other = run(C27.replace("SPA+0 SPB+90", "SPA+90 SPB+0").replace("L X+50 Y0", "L X+0 Y-50"))
    assert other.toolpath.cylinders[0].rotary == 2 and flat(other, "contour") == pytest.approx(one, abs=1e-9)
    assert other.toolpath.labelled("plunge").end[0].tolist() == pytest.approx([0, -21, 23.5], abs=1e-9)


def mirrored(words: str, **q) -> np.ndarray:
    return flat(run(program(39, before=f"CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 {words}", **q)), "wall")


def test_mirror_images():
    """Along the axis the contour is mirrored in y; with A in u; with A, Y and X in both: every wall is the mirror image."""
    plain = flat(run(program(39)), "wall")
    for words, u, y in (("X", 1, -1), ("A", -1, 1), ("Y A", -1, 1), ("X Y A", -1, -1)):
        assert mirrored(words) == pytest.approx(plain * (u, y, 1), abs=1e-9), words


def test_shifts():
    """Along the axis the contour moves, and with the rotary axis it turns."""
    plain, shifted = run(program(27)), run(program(27, before="CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+10\nCYCL DEF 7.2 A+30"))
    one, other = plain.toolpath.labelled("contour"), shifted.toolpath.labelled("contour")
    assert other.end == pytest.approx(one.end + (10, 0, 0), abs=1e-9)
    assert np.degrees(other.rotary - one.rotary) == pytest.approx(np.tile([30, 0, 0], (len(one), 1)))


def test_a_scale_keeps_the_tool():
    """Twice as large: angles stay, Q16 and the contour double, the tool does not."""
    found = run(program(28, before="CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 2", Q20=10))
    assert found.toolpath.cylinders[0].radius == pytest.approx(50)
    e = 2 * 5 - 3.5  # mm
    y = -70 + e * math.tan(math.radians(48.8141 / 2))  # where the offsets meet
    assert flat(found, "level 1 of 2, first wall")[0] == pytest.approx([120 - e, y, -8], abs=1e-3)
    assert found.toolpath.labelled("wall").unrolled().feed[0] == pytest.approx(250)


def test_called_twice_and_at_once():
    """The second call makes the same rows; after it the rotary axis is known."""
    found = run(program(27, call="M3 M99\nCYCL CALL\nL A+0 R0 FMAX"))
    rows = found.toolpath.labelled("level 1 of 2, contour")
    assert len(rows) % 2 == 0 and np.array_equal(rows.end[: len(rows) // 2], rows.end[len(rows) // 2 :])
    assert found.toolpath.rotary[-1].tolist() == [0, 0, 0]


@pytest.mark.parametrize(("made", "depths"), [(C27, (21, 18)), (C28, (21, 18))])
def test_on_a_machine_whose_axes_are_known(made: str, depths: tuple[int, ...]) -> None:
    """The head lies along X, the table turns: on the part the tip goes round Z at the radius of each level, the tool always
    points to the axis, and a way of 25 angle by Z is the contour of the same program without a kinematics."""
    tools = {number: mnc.Tool(number=number, radius=tool.radius, length=70) for number, tool in TOOLS.items()}
    found = mnc.run(made, "tnc-620", mnc.Setup(tools=tools, kinematics="head-b-table-c"))
    assert found.ok, found.alarms
    plain, path = run(made).toolpath, found.toolpath
    for label, depth in zip(("level 1 of 2, contour", "level 2 of 2, contour"), depths, strict=True):
        rows, before = ([k for k, n in enumerate(each.label) if label in each.labels[n]] for each in (path, plain))
        if not rows:
            continue
        x, y, z = path.end[rows].T
        assert np.hypot(x, y) == pytest.approx(depth, abs=0.011)
        assert path.directions[rows] == pytest.approx(np.stack([x, y, 0 * z], axis=1) / np.hypot(x, y)[:, None], abs=1e-9)
        ways = np.stack([25 * np.arctan2(y, x), z], axis=1)
        known = np.stack([25 * plain.rotary[before, 2], plain.end[before, 2]], axis=1)
        for point in known:
            assert np.linalg.norm(ways - point, axis=1).min() < 1e-9


@pytest.mark.parametrize(("kinematics", "before", "message"), [
    ("head-bc", "PLANE SPATIAL SPA+0 SPB+90 SPC+0 TURN FMAX",
     "needs a rotary table that turns the cylinder: the machine has "
     "C and B in the head, C from -540 to 540°, B from -110 to 110°"),
    ("table-ac", "L A+90 C+0 FMAX", "needs the plane tilted as the rotary axes stand, A90 C0: "
     "write PLANE SPATIAL before, or turn them back"),
    ("head-b-table-c", "L C+0 FMAX",
     "needs a tool square to the rotary axis C: the spindle axis is not perpendicular to the axis of the rotary table"),
])  # fmt: skip
@pytest.mark.parametrize("cycle", [27, 39])
def test_a_machine_whose_table_cannot_turn_the_cylinder(kinematics: str, before: str, message: str, cycle: int) -> None:
    """9.1: the cylinder stands on the rotary table, square to the spindle. C of a head swings the tool."""
    text = program(cycle, "L X+0 Y+0 RL\nL X+20", before=before)
    (alarm,) = mnc.run(text, "tnc-620", mnc.Setup(tools=TOOLS, kinematics=kinematics)).alarms
    assert alarm.severity == "alarm" and alarm.message == f"CYCL DEF {cycle} {message}"


def test_many_plain_blocks_in_degrees():
    """What is obeyed in bulk elsewhere counts in degrees here, too."""
    contour = "\n".join(f"L X+{k} Y+{k}" for k in range(60))
    found = run(program(27, f"L X+0 Y+0 R0\n{contour[len('L X+0 Y+0') + 1:]}", Q17=0))
    assert np.degrees(found.toolpath.labelled("contour").rotary[:, 0]).max() == pytest.approx(59)


# --- what is made of the path ------------------------------------------------------------------------------------------


def test_a_cylinder_goes_with_its_rows():
    """Slices, copies and single rows know it."""
    import pickle

    path = run(C27, rotary_axes="CB").toolpath
    rows = path[path.cylinder >= 0]
    assert rows.cylinders == path.cylinders and pickle.loads(pickle.dumps(rows)).cylinders == path.cylinders
    assert np.array_equal(rows[5:9].unrolled().end, path.unrolled()[5:9].end)
    assert path[path.cylinder < 0].unrolled().cylinders == () and len(path[path.cylinder < 0].unrolled()) == 0


def test_the_export_turns_the_axis():
    from mnclab.show.export_gcode import lines

    blocks = list(lines(run(program(27, "L X+0 Y+0 R0\nL X+90", Q17=0))))
    assert any("A90" in block for block in blocks)


DRUM = mnc.cylinder(25, -20, 20, axis="X")


def slot_on_a_drum(contour: str, **q) -> mnc.Run:
    """In the middle of the drum, 7 deep, by the mill of radius 3.5 along a contour on the surface."""
    return run(program(27, contour, Q17=0, **q))


def test_a_slot_round_a_drum_is_cut():
    """A quarter of a turn: a sector of a ring from radius 18 to 25 and 7 wide, and half the tool at both ends."""
    part = slot_on_a_drum("L X+0 Y+0 R0\nL X+90").workpiece(stock=DRUM, step=0.5)
    angle = (np.arange(20_000) + 0.5) * math.pi / 20_000  # u = -r cos: half the tool under the surface, twice
    ends = float((2 * (3.5 * np.sin(angle)) ** 2 * (np.sqrt(625 - (3.5 * np.cos(angle)) ** 2) - 18)).sum() * math.pi / 20_000)
    assert part.removed == pytest.approx(7 * (625 - 324) / 2 * math.pi / 2 + ends, rel=1e-3)
    assert part.error <= 4e-3 and part.notes == ()
    y = np.array([0.0, -5.0, -10.0])
    assert np.abs(part.at(0 * y, y) - np.sqrt(324 - y * y)).max() < 1.5e-3  # the floor, round the axis
    assert np.abs(part.at(0 * y + 3.501, y) - np.sqrt(625 - y * y)).max() < 1e-9  # what stands beside it
    (section,) = part.cut("XZ", -10.0)
    places = np.array(section.points)
    floor = places[np.abs(places[:, 1] - math.sqrt(324 - 100)) < 0.01]
    assert floor[:, 0].min() == pytest.approx(-3.5, abs=1e-3) and floor[:, 0].max() == pytest.approx(3.5, abs=1e-3)


def test_a_slot_that_winds_has_its_width():
    """Points of the drum against the tool at 4000 places of its way: cut where one of them has it within its radius."""
    found = slot_on_a_drum("L X-30 Y-10 R0\nL X+50 Y+12")
    part = found.workpiece(stock=DRUM, step=0.5)
    assert part.error <= 4.1e-3
    angles, places = np.radians(np.linspace(-30, 50, 4000)), np.linspace(-10, 12, 4000)
    rho, phi, x = np.random.default_rng(4).uniform((18.1, -1.0, -16), (24.9, 1.4, 18), (400, 3)).T
    points = np.stack([x, -rho * np.sin(phi), rho * np.cos(phi)], axis=1)  # the tool stands over -Y where A is 90
    aside, high = rho[:, None] * np.sin(phi[:, None] - angles), rho[:, None] * np.cos(phi[:, None] - angles)
    off = np.where(high > 18, np.hypot(aside, x[:, None] - places), np.inf).min(axis=1) - 3.5
    sure = np.abs(off) > 0.006
    top, floor = part.blank_at(points[:, 0], points[:, 1])
    assert ((floor < points[:, 2]) & (points[:, 2] < top)).all()
    gone = part.sweep.gaps.empty(*points.T)
    assert sure.sum() > 380 and (off < 0).sum() > 60 and (gone == (off < 0))[sure].all()


def test_a_whole_turn_is_no_standstill():
    """A groove all round: the ring from radius 18 to 25, 7 wide."""
    part = slot_on_a_drum("L X+0 Y+0 R0\nL X+360").workpiece(stock=DRUM, step=0.5)
    assert part.removed == pytest.approx(math.pi * (625 - 324) * 7, rel=1e-3) and part.removed_by("tool").keys() == {1}


IN_TABLE = mnc.Kinematics(table=(mnc.Axis("A"), mnc.Axis("C")))


def on_machine(text: str, kinematics: mnc.Kinematics | str = IN_TABLE, up: float = 0.0, tool: mnc.Tool = TOOLS[1]) -> mnc.Run:
    """The drum on the axis A of a machine, which lies `up` mm over its zero."""
    made = mnc.Setup(tools={1: tool}, stock=DRUM.moved((0, 0, up)), presets={0: (0, 0, up)}, kinematics=kinematics)
    found = mnc.run(text, "tnc-620", made)
    assert found.ok, found.alarms
    return found


@pytest.mark.parametrize(("kinematics", "up"), [(IN_TABLE, 0.0), ("table-ac", 50.0)])
def test_a_drum_by_the_kinematics_of_a_machine_is_cut(kinematics, up):
    """The quarter of a turn above: the sector of a ring and half the tool at both ends, whichever way the rows are parted."""
    text = program(27, "L X+0 Y+0 R0\nL X+90", Q17=0)
    part = on_machine(text, kinematics, up).workpiece(step=0.5)
    plain = run(text).workpiece(stock=DRUM, step=0.5)
    assert part.notes == () and part.removed == pytest.approx(plain.removed, rel=1e-4)
    assert np.abs(part.heights - plain.heights).max() < 2e-3  # both floors are right within a micrometre
    y = np.array([0.0, -5.0, -10.0])
    assert np.abs(part.at(0 * y, y) - np.sqrt(324 - y * y)).max() < 1.5e-3


@pytest.mark.deep
@pytest.mark.parametrize(("cycle", "contour", "q"), [
    (27, "L X-30 Y-10 R0\nL X+50 Y+12", {}), (28, "L X+0 Y+0 RL\nL X+60 Y+5", {"Q20": 10}),
    (29, "L X+0 Y+0 RL\nL X+60", {"Q20": 4}), (39, "L X+0 Y+0 RL\nL X+60", {}),
])  # fmt: skip
def test_a_machine_cuts_the_same_drum_as_none(cycle, contour, q):
    text = program(cycle, contour, Q17=0, Q1=-4, **q)
    plain, known = run(text).workpiece(stock=DRUM, step=1.0), on_machine(text).workpiece(step=1.0)
    rho, phi, x = np.random.default_rng(4).uniform((21.1, -math.pi, -16), (24.9, math.pi, 18), (3000, 3)).T
    gone, also = (
        part.sweep.gaps.empty(x, -rho * np.sin(phi), rho * np.cos(phi)) for part in (plain, known)
    )
    assert "left out" not in " ".join(known.notes) and gone.sum() > 100 and (gone != also).sum() <= 3
    assert known.removed == pytest.approx(plain.removed, rel=1e-3)


@pytest.mark.parametrize("known", [False, True])
def test_a_holder_over_a_drum_that_turns_is_judged(known):
    """It begins 5 over a tip that goes 7 deep: 2 mm of it are in the drum. 8 over the tip it is free."""
    text = program(27, "L X+0 Y+0 R0\nL X+30", Q17=0, Q10=7)
    for begin, depth in ((5.0, 2.0), (8.0, None)):
        tool = mnc.Tool(number=1, radius=3.5, holder=((20, begin),))
        made = mnc.Setup(tools={1: tool}, stock=DRUM, **{"kinematics": IN_TABLE} if known else {})
        run = mnc.run(text, "tnc-620", made)
        found = run.collisions()
        assert found.notes == () and {each.kind for each in found} == ({"holder"} if depth else set())
        turned = [each for each in found if run.toolpath.rotary[each.row, 0] > 0]
        assert bool(turned) == bool(depth) and all(each.depth == pytest.approx(depth, abs=2e-3) for each in turned)


def test_each_axis_has_its_own_farthest_place():
    """A bar of 120 × 20 × 20 along X is at most 14.2 mm from A, and 60.8 from C, about which a tip 30 away winds: the holder
    begins 20 mm above it, and meets the corner of the end of the bar."""
    table = mnc.Kinematics(table=(mnc.Axis("A"), mnc.Axis("C")))
    tool = mnc.Tool(number=1, radius=3, holder=((8, 20.0),))
    setup = mnc.Setup(tools={1: tool}, stock=((-60, -10, -10), (60, 10, 10)), kinematics=table)
    way = "L X+0 Y+0 Z+9 F500\nL A+40\nL Z+90 FMAX\nL A+90 FMAX\nL Z+30 F500\nL C+90\nL Z+90\nM2"
    run = mnc.run(f"BEGIN PGM A MM\nTOOL CALL 1 Z S2000\nL X+0 Y+0 Z+90 R0 FMAX M3\n{way}\nEND PGM A MM\n", "tnc-620", setup)
    found = run.collisions(step=1.0)
    deepest = max((each for each in found if each.kind == "holder"), key=lambda each: each.depth)
    assert found.notes == () and deepest.line in (9, 10) and deepest.depth == pytest.approx(math.hypot(60, 10) - 50, abs=0.02)


def test_of_very_many_turns_that_meet_the_drum_the_rest_is_named():
    """60 there and back and 60 back, round the drum and along it: 120 rows, 100 of which are judged."""
    way = "".join(f"\nL Y+{1 + k / 10} \nL X+{k % 2}" for k in range(120))
    run = mnc.run(program(27, f"L X+0 Y+0 R0{way}", Q17=0, Q10=7), "tnc-620",
                  stock=DRUM, tools={1: mnc.Tool(radius=3.5, holder=((20, 5),))})
    found = run.collisions(step=2.0)
    assert len({each.row for each in found if run.toolpath.rotary[each.row, 0] > 0}) >= 100
    assert "rows on which the tool turns not judged" in " ".join(found.notes)


def test_what_turns_in_a_drum_at_rapid_or_with_a_spindle_that_stands_is_told():
    head = "0 BEGIN PGM A MM\nTOOL CALL 1 Z S2000\nL X+0 Y+0 Z+40 R0 FMAX M3\nL Z+18 F100\n"
    for block, kind in (("L A+40 FMAX", "rapid"), ("M5\nL A+40 F500", "spindle"), ("L A+40 F500", None)):
        found = on_machine(f"{head}{block}\nL Z+40 FMAX\nM2\nEND PGM A MM\n")
        told = found.collisions()
        assert told.notes == () and {each.kind for each in told} == ({kind} if kind else set())
        assert all(each.line in (5, 6) and each.depth == pytest.approx(7, abs=2e-3) for each in told)
        part = found.workpiece(step=1.0)
        ring = 7 * (625 - 324) / 2 * math.radians(40)
        plain = on_machine(f"{head}L Z+40 FMAX\nM2\nEND PGM A MM\n").workpiece(step=1.0)
        assert part.removed - plain.removed == pytest.approx(ring, rel=2e-3)  # half the tool at both ends


def test_rapids_below_the_edges_of_a_box_go_where_it_was_cut():
    """Its edges come higher than the rapids between, which go back through the slot; without one they meet it."""
    text, box = program(27, "L X+0 Y+0 R0\nL X+90", Q17=0), ((-20, -30, -30), (20, 30, 30))
    found = run(text)
    assert "left out" not in " ".join(found.workpiece(stock=box, step=1.0).notes)
    assert found.collisions(stock=box).ok and found.collisions(stock=box).notes == ()
    first = "L A+90 FMAX\nL Z+35 FMAX\nL A+45 FMAX\nL A+0 FMAX\n"  # of the edge, 42 from the axis
    swung = on_machine(f"0 BEGIN PGM A MM\nTOOL CALL 1 Z S2000\nL X+0 Y+0 Z+100 R0 FMAX M3\n{first}M2\nEND PGM A MM\n")
    told = swung.collisions(stock=box)
    assert told.notes == () and {(each.kind, each.line) for each in told} == {("rapid", 6), ("rapid", 7)}
    assert max(each.depth for each in told) == pytest.approx(math.hypot(30, 30) - 35, abs=0.05)

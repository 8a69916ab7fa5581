"""The turned part against closed forms: rings, cones, grooves, arcs by Pappus, bores, what is parted off."""

import math

import numpy as np
import pytest
from t3_workpiece.lathe import BAR, NOSED, SHARP, cutting, turned

from mnclab import Alarm, Setup, run
from mnclab.path.tool import Tool
from mnclab.workpiece.blank import Box, Revolved, cylinder
from mnclab.workpiece.turning.turned import Turned

WHOLE = math.pi * 30**2 * 60


def frustum(a, b, height):
    return math.pi * height / 3 * (a * a + a * b + b * b)


def ring(outer, inner, length):
    return math.pi * (outer**2 - inner**2) * length


def test_an_untouched_bar():
    part = turned(SHARP, (5, 40), (-10, 40))
    assert part.removed == 0 and part.volume == pytest.approx(WHOLE, rel=1e-14)
    assert part.at([-5, -60, -70, 1]).tolist() == [30, 0, 0, 0] and part.bore_at(-5) == 0


def test_a_ring_and_its_shoulder():
    part = turned(SHARP, (2, 20), (-20, 20), (-20, 32))
    assert part.removed == pytest.approx(ring(30, 20, 20), rel=1e-12)
    assert (part.at(-10), part.at(-20), part.at(-19.999)) == (20, 30, 20)
    (loop,) = part.section
    assert sorted(map(tuple, loop.points.round(9).tolist())) == [
        (-60, 0), (-60, 30), (-20, 20), (-20, 30), (0, 0), (0, 20),
    ]  # fmt: skip


def test_the_nose_leaves_a_fillet():
    """A quarter of a circle of 0.8 in the corner of the shoulder, by Pappus."""
    part = turned(NOSED, (2, 20), (-20, 20), (-20, 32))
    c = 0.8
    fillet = (1 - math.pi / 4) * c * c
    square, quarter = c * c * (20 + c / 2), math.pi / 4 * c * c * (20 + c - 4 * c / 3 / math.pi)
    assert part.removed == pytest.approx(ring(30, 20, 20) - 2 * math.pi * (square - quarter), rel=1e-12)
    (bent,) = [loop for loop in part.section if loop.bulge.any()]
    k = int(np.flatnonzero(bent.bulge)[0])
    assert bent.radii[k] == pytest.approx(c, abs=1e-12) and bent.sweeps[k] == pytest.approx(-math.pi / 2)
    assert bent.area == pytest.approx(30 * 60 - 10 * 20 + fillet, rel=1e-12)


def test_a_cone():
    part = turned(SHARP, (0, 20), (-20, 30), (-20, 32))
    assert part.removed == pytest.approx(ring(30, 0, 20) - frustum(20, 30, 20), rel=1e-12)
    assert part.at(-8) == pytest.approx(24)


def test_a_groove_as_wide_as_its_blade_and_its_corners():
    blade = Tool(number=3, kind="grooving", width=3)
    part = turned(blade, (-20, 35), (-20, 22), (-20, 35))
    assert part.removed == pytest.approx(ring(30, 22, 3), rel=1e-12)
    assert part.at([-20.01, -19.9, -17.1, -16.9]).tolist() == [30, 22, 22, 30]
    soft = turned(Tool(number=3, kind="grooving", width=3, corner=0.5), (-20, 35), (-20, 22))
    corners = (0.25 * (22 + 0.25) - math.pi / 16 * (22.5 - 4 * 0.5 / 3 / math.pi)) * 2
    assert soft.removed == pytest.approx(ring(30, 22, 3) - 2 * math.pi * corners, rel=1e-12)


def test_a_groove_in_the_face():
    """The corner nearer to the axis is the tip: from radius 12 to 15."""
    part = turned(Tool(number=7, kind="face grooving", width=3), (2, 12), (-9, 12), (2, 12))
    assert part.removed == pytest.approx(ring(15, 12, 9), rel=1e-12)
    assert sum(loop.area for loop in part.cut("XY", -5)) == pytest.approx(math.pi * (900 - 225 + 144))


def test_a_ball_by_a_sharp_tip():
    """Half a circle about the axis: half a ball of radius 15 at the end of the bar, by a blade without width."""
    tip = Tool(number=1, kind="turning", main_angle=90, auxiliary_angle=90)
    part = turned(tip, (0, 0), (-15, 15, math.pi / 2), (-15, 31))
    assert part.volume == pytest.approx(WHOLE - ring(30, 0, 15) + 2 / 3 * math.pi * 15**3, rel=1e-12)
    assert part.at(-7.5) == pytest.approx(math.sqrt(15**2 - 7.5**2), abs=1e-12)


@pytest.mark.parametrize("sense", (1, -1))
def test_a_nose_around_an_arc_is_its_equidistant(sense):
    """The tip of a nose of 2 on a quarter of radius 10: convex the part has 8, concave 12, about one centre."""
    tool = Tool(number=1, kind="turning", main_angle=90, auxiliary_angle=90, corner=2)
    way = [(-10, 18), (-20, 28, math.pi / 2)] if sense > 0 else [(-10, 18), (-20, 28, -math.pi / 2)]
    part = turned(tool, *way, (-20, 33))
    radii = [r for loop in part.section for r in loop.radii if 5 < r < np.inf]
    assert radii == pytest.approx([8 if sense > 0 else 12], abs=1e-9)


def test_an_arc_tighter_than_the_nose():
    """A nose of 2 whose tip runs on a concave arc of 1 leaves a fillet of 3; on a convex one a ridge, its own circles."""
    tool = Tool(number=1, kind="turning", main_angle=90, auxiliary_angle=90, corner=2)
    part = turned(tool, (2, 20), (-19, 20), (-20, 21, -math.pi / 2), (-20, 33))
    assert part.at([-19.0, -18.0]) == pytest.approx([23 - math.sqrt(9 - 4), 23 - math.sqrt(9 - 1)], abs=1e-9)
    convex = turned(tool, (-19, 31), (-19, 21), (-20, 22, math.pi / 2), (-30, 22))
    assert convex.at(-18.0) == pytest.approx(23 - math.sqrt(3), abs=1e-9)


def test_a_bore_by_drill_and_bar():
    drill = Tool(number=6, radius=5, angle=118, kind="drill")
    point = 5 / math.tan(math.radians(59))
    part = turned(drill, (2, 0), (-20, 0), (2, 0))
    assert part.removed == pytest.approx(math.pi * 25 * (20 - point) + math.pi * 25 * point / 3, rel=1e-12)
    assert part.bore_at(-1) == 5 and part.bore_at(-20 + point / 2) == pytest.approx(2.5) and part.bore_at(-25) == 0
    tube = cylinder(30, -60, 0, bore=10)
    bar = Tool(number=5, kind="boring", main_angle=95, auxiliary_angle=30)
    inside = turned(bar, (2, 15), (-20, 15), (-20, 9), (2, 9), stock=tube)
    assert inside.removed == pytest.approx(ring(15, 10, 20), rel=1e-12)
    assert inside.bore_at([-10.0, -30.0]).tolist() == [15, 10] and inside.at(-10) == 30


def test_inside_a_bore_and_with_the_left_hand():
    """A groove 3 wide inside, its left corner at -20; a left-hand tool that turns from the chuck to the face."""
    tube = cylinder(30, -60, 0, bore=10)
    part = turned(Tool(number=5, kind="boring", width=3), (-20, 9), (-20, 14), (-20, 9), stock=tube)
    assert part.removed == pytest.approx(ring(14, 10, 3), rel=1e-12)
    assert part.bore_at([-20.1, -18.0, -16.9]).tolist() == [10, 14, 10]
    left = Tool(number=1, kind="turning", main_angle=90, auxiliary_angle=60, hand="left")
    back = turned(left, (-40, 35), (-40, 25), (-10, 25), (-10, 35))
    lean = 5 * math.tan(math.pi / 6)  # the auxiliary edge, now on the left
    assert back.removed == pytest.approx(ring(30, 25, 30) + ring(30, 0, lean) - frustum(30, 25, lean), rel=1e-12)


def test_facing_past_the_centre_leaves_nothing_there():
    part = turned(NOSED, (-1, 32), (-1, -2), (2, -2))
    assert part.removed == pytest.approx(ring(30, 0, 1), rel=1e-12)
    short = turned(SHARP, (-1, 32), (-1, 0.5))
    stub = turned(SHARP, (-1, 32), (-1, -0.5))
    assert short.volume > stub.volume == pytest.approx(math.pi * 900 * 59, rel=1e-12)


def test_what_is_parted_off_falls():
    blade = Tool(number=3, kind="grooving", width=3)
    part = turned(blade, (-30, 35), (-30, -0.1), (-30, 35), (5, 20), (-10, 20))
    assert part.volume == pytest.approx(ring(30, 0, 30), rel=1e-12)
    assert part.removed == pytest.approx(ring(30, 0, 3), rel=1e-12)
    assert part.notes == ("1 piece fell off",) and part.parted[0].area == pytest.approx(27 * 30)
    rows = part.removed_by_row()
    assert rows[0] == pytest.approx(part.removed) and rows[1:].sum() == 0


def test_what_fell_is_not_cut_any_more():
    """The end of the bar falls; later rows sweep all of the place where it was."""
    blade, wide = Tool(number=3, kind="grooving", width=3), Tool(number=8, kind="grooving", width=40)
    part = Turned(cutting([blade, wide], [[(-30, 35), (-30, -0.1), (-30, 35)], [(-27, 35), (-27, -1)]]))
    assert part.removed == pytest.approx(ring(30, 0, 3), rel=1e-12)
    assert [loop.area for loop in part.parted] == [pytest.approx(27 * 30)]
    assert part.removed_by_row().sum() == pytest.approx(part.removed)


def test_every_row_takes_its_share():
    part = turned(SHARP, (2, 25), (-40, 25), (-40, 32), (2, 32), (2, 20), (-20, 20), (-20, 32))
    rows = part.removed_by_row()
    assert rows[0] == pytest.approx(ring(30, 25, 40)) and rows[4] == pytest.approx(ring(25, 20, 20))
    assert rows[[1, 2, 3]].sum() == 0 and rows.sum() == pytest.approx(part.removed, rel=1e-14)
    assert sum(part.removed_by("line").values()) == pytest.approx(part.removed)
    (cut_by,) = part.rows
    assert set(cut_by.tolist()) == {-1, 0, 1, 4, 5}


def test_scallops_of_a_nose():
    """Plunges f apart leave ridges of f²/8r, to second order: exactly r - √(r² - f²/4)."""
    f, r = 1.0, 0.8
    tool = Tool(number=1, kind="grooving", width=2 * r, corner=r)
    way = [place for k in range(6) for place in ((-10 - k * f, 31), (-10 - k * f, 25), (-10 - k * f, 31))]
    part = turned(tool, *way)
    valley, ridge = part.at(-10 - f + r), part.at(-10 - 1.5 * f + r)
    assert valley == pytest.approx(25, abs=1e-9)
    assert ridge - valley == pytest.approx(r - math.sqrt(r * r - f * f / 4), abs=1e-9)
    assert ridge - valley == pytest.approx(f * f / 8 / r, rel=0.15)


def test_sections_and_solid():
    tube = cylinder(30, -60, 0, bore=10)
    part = turned(NOSED, (2, 20), (-20, 20), (-20, 32), stock=tube)
    along = part.cut("ZX")
    assert sum(loop.area for loop in along) == pytest.approx(2 * part.section[0].area)
    assert len(along) == 2 and len(turned(NOSED, (2, 20), (-20, 20)).cut("ZX")) == 1
    assert sum(loop.area for loop in part.cut("XZ")) == pytest.approx(sum(loop.area for loop in along))
    assert sum(loop.area for loop in part.cut("XY", -10)) == pytest.approx(math.pi * (400 - 100))
    body = part.solid()
    edges = np.sort(body.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()  # closed
    assert body.volume == pytest.approx(part.volume, rel=5e-4) and set(body.row.tolist()) == {-1, 0, 1}


def test_a_probe_touches_it():
    part = turned(SHARP, (2, 20), (-20, 20), (-20, 32)).part
    far = part([(40, 0, -10), (0, 25, -10), (0, 0, 5), (0, 19, -10), (31, 0, -40)])
    assert far == pytest.approx([math.hypot(10, 10), 5, 5, -1, 1])


def test_an_axis_off_zero():
    """Blank and path stand 100 aside: the same part there."""
    here, there = turned(SHARP, (2, 20), (-20, 20)), BAR.moved((100, 0, 0))
    aside = turned(SHARP, (2, 120), (-20, 120), stock=there)
    assert aside.volume == pytest.approx(here.volume, rel=1e-12)
    assert aside.part([(125, 0, -10)]) == pytest.approx([5])
    assert np.array(aside.cut("ZX")[0].bounds)[:, 1] == pytest.approx([70, 130])


def test_the_blank_of_a_lathe():
    box = turned(SHARP, (2, 20), (-20, 20), stock=Box((-30, -30, -60), (30, 30, 0)))
    assert box.removed == pytest.approx(ring(30, 20, 20)) and "counts as a bar of radius 30" in box.notes[0]
    cone = turned(SHARP, (5, 40), (4, 40), stock=Revolved(((30, -60), (10, 0))))
    assert cone.volume == pytest.approx(frustum(30, 10, 60)) and cone.at(-30) == pytest.approx(20)
    with pytest.raises(Alarm, match="boxes or bodies about Z"):
        turned(SHARP, (5, 40), (4, 40), stock=cylinder(30, 0, 60, axis="X"))
    with pytest.raises(Alarm, match="a tool are 180 degrees at most"):
        assert turned(Tool(number=1, kind="turning", main_angle=170, auxiliary_angle=60), (2, 20), (-20, 20)).volume
    with pytest.raises(Alarm, match="through the axis"):
        box.cut("ZX", 3)
    with pytest.raises(Alarm, match="plane of a section"):
        box.cut("AB")


def test_two_tools():
    blade = Tool(number=3, kind="grooving", width=4)
    part = Turned(cutting([SHARP, blade], [[(2, 20), (-20, 20), (-20, 35)], [(-12, 35), (-12, 15), (-12, 35)]]))
    assert part.removed == pytest.approx(ring(30, 20, 20) + ring(20, 15, 4), rel=1e-12)


def test_a_plane_may_be_written_in_small_letters():
    """A ring of radius 30 at the bar's middle, not its two halves."""
    whole = run("G00 X40 Z5\n", "jnc-t01", Setup(stock=cylinder(30, -50, 0))).workpiece()
    (ring,) = whole.cut("xy", -25)
    assert ring.area == pytest.approx(math.pi * 30**2, rel=1e-9)


def test_a_sharp_boring_bar_beyond_the_axis_takes_nothing_there_and_is_a_collision():
    """A bar of 40 x 60 bored to R8 10 deep; at its bottom the tip goes on to X-3, a point that leaves the metal as it is."""
    bar = Tool(kind="boring", main_angle=90, auxiliary_angle=30)
    head, blank = "T1\nG97 S500 G95 F0.1 M3\n", cylinder(diameter=40, length=60)
    for way in ("G00 X8 Z2\nG01 Z-10\nX-3\n", "G00 X-3 Z2\nG01 Z-10\nX0\n", "G00 X-3 Z2\nG32 Z-10 F2\nG00 X0\n"):
        made = run(f"{head}{way}G00 Z5\n", "jnc-t01", tools={1: bar}, stock=blank)
        left = blank.volume - made.workpiece().volume
        assert len(made.collisions()) and left == pytest.approx(math.pi * 8**2 * 10 if "X8" in way else 0.0, rel=1e-9)

"""Turned designs: volumes by hand, exact sections, what a probe touches, files, both ends."""

import functools
import math

import numpy as np
import pytest
from design.turned_designs import frustum, ring, rounded, shaft
from tools.chance import seeds

import mnclab as mnc
from mnclab.design.model import Bore, CentreHole, FaceGroove, RingGroove, Thread, TurnedDesign, Undercut
from mnclab.geometry.contours import Contour
from mnclab.workpiece.part import contact

QUARTER = math.tan(math.pi / 8)
FEW = range(6)
MANY = seeds(len(FEW), deep=90)
shaft = functools.cache(shaft)


@pytest.mark.parametrize("seed", MANY)
def test_a_random_shaft(seed, tmp_path):
    """Its volume by hand; its file reads back equal; end for end twice it is the same."""
    design, volume, _ = shaft(seed)
    assert design.volume == pytest.approx(volume, rel=1e-9)
    assert design.workpiece().volume == pytest.approx(volume, rel=1e-9)
    again = TurnedDesign.load(design.save(tmp_path / "design.toml"))
    assert again == design and again.volume == design.volume
    over = design.turned_over()
    assert over.volume == pytest.approx(volume, rel=1e-9)
    assert over.bounds == pytest.approx(design.bounds, abs=1e-9)
    for one, other in zip(design.section, over.turned_over().section, strict=True):
        assert other.points == pytest.approx(one.points, abs=1e-9) and other.bulge == pytest.approx(one.bulge, abs=1e-9)
    middle = float(design.bounds[:, 2].sum())
    z = np.linspace(*design.bounds[:, 2], 23)[1:-1] + 1e-3 * math.pi
    assert over.workpiece().at(middle - z) == pytest.approx(design.workpiece().at(z), abs=1e-9)


def test_sides_of_random_shafts_by_quadrature():
    """Shells 2πr·h of the sides that a mill would see, and by hand what is undercut: grooves count as full there."""
    for design, _, _ in map(shaft, FEW):
        full = mnc.TurnedDesign(
            design.profile, [each for each in design.features if not isinstance(each, RingGroove)],
            roundings=design.roundings, chamfers=design.chamfers,
        )  # fmt: skip
        edges = np.linspace(0, design.bounds[1, 0], 40_001)
        r = (edges[1:] + edges[:-1]) / 2
        low, high = design.faces(r, 0 * r)
        shells = 2 * math.pi * np.nansum(r * (high - low)) * (edges[1] - edges[0])
        assert shells == pytest.approx(full.volume, rel=2e-5), design.title


def test_a_ball_and_a_torus():
    """A ball end of 10 before a cylinder; a ring of circular section, radius 3 about 20, by Pappus 2π·20·9π."""
    ball = TurnedDesign(Contour([(0, 0), (-10, 10), (-30, 10)], [QUARTER, 0, 0], closed=False))
    assert ball.volume == pytest.approx(2 / 3 * math.pi * 1000 + math.pi * 100 * 20, rel=1e-12)
    torus = TurnedDesign(Contour.circle((0, 20), 3))
    assert torus.volume == pytest.approx(2 * math.pi * 20 * 9 * math.pi, rel=1e-12)
    cap = TurnedDesign(Contour([(0, 0), (-2, 6)], [math.sqrt(10) - 3, 0], closed=False))
    assert cap.volume == pytest.approx(math.pi * 4 * (3 * 10 - 2) / 3, rel=1e-12)  # 2 of a ball of 10
    assert ball.volume == pytest.approx(TurnedDesign(ball.section[0]).volume, rel=1e-12)


def test_points_in_either_order_and_a_section_of_its_own():
    front = TurnedDesign([(0, 10), (-20, 10), (-20, 15), (-40, 15)])
    back = TurnedDesign([(-40, 15), (-20, 15), (-20, 10), (0, 10)])
    assert front.volume == back.volume == pytest.approx(math.pi * (100 + 225) * 20)
    tube = TurnedDesign(Contour([(0, 5), (0, 10), (-20, 10), (-20, 5)]))
    assert tube.volume == pytest.approx(ring(10, 5, 20))
    assert tube.volume == pytest.approx(TurnedDesign([(0, 10), (-20, 10)], Bore(10)).volume, rel=1e-12)
    assert tube.axis_x == 0 and tube.bounds.tolist() == [[-10, -10, -20], [10, 10, 0]]


def test_arcs_are_arcs():
    design = TurnedDesign(
        [(0, 12), (-30, 12), (-30, 20), (-50, 20)],
        (RingGroove(-38, 4, depth=2, corner=0.5), Undercut("M24x1.5", -30), Bore(10, 15, point=180, corner=1)),
        roundings={2: 1.5},
    )
    (contour,) = design.section
    radii = sorted(contour.radii[np.isfinite(contour.radii)])
    assert radii == pytest.approx([0.5, 0.5, 0.8, 0.8, 1.0, 1.5], abs=1e-9)
    assert len(contour.points) == 20  # no chords


def test_an_undercut_by_hand():
    """M24x1.5 of DIN 76-1: bottom 21.7, 3.2 wide, 0.8 in its corners, up at 30 degrees to the cylinder."""
    design = TurnedDesign([(0, 12), (-30, 12), (-30, 20), (-50, 20)], Undercut("M24x1.5", -30))
    high, back = 12 - 10.85, 0.8 * math.tan(math.radians(15))
    slope = high / math.tan(math.radians(30))
    gone = ring(12, 10.85, 3.2) + ring(12, 0, slope) - frustum(10.85, 12, slope)
    # the rounding into the slope: two triangles about its centre less its sector, 30 degrees, by Pappus
    kite, sector = 0.8 * back, 0.8**2 * math.radians(30) / 2
    corner = np.array([10.85, 10.85 + 0.8, 10.85 + back * math.sin(math.radians(30))])  # foot, centre, foot
    kite_middle = ((corner[0] + 10.85 + corner[1]) + (corner[2] + 10.85 + corner[1])) / 6
    arm = 2 * 0.8 * math.sin(math.radians(15)) / (3 * math.radians(15))
    sector_middle = 10.85 + 0.8 - arm * math.cos(math.radians(15))
    gone -= rounded(10.85, 0.8, True) + 2 * math.pi * (kite * kite_middle - sector * sector_middle)
    assert math.pi * (144 * 30 + 400 * 20) - design.volume == pytest.approx(gone, rel=1e-9)


def test_threads_are_weighed_without_teeth():
    """Outside the cylinder stays; inside M20x1.5 opens a bore of 18 to D1 = 20 - 1.0825·1.5 over its length."""
    plain = TurnedDesign([(0, 12), (-30, 12)], Bore(18))
    both = TurnedDesign([(0, 12), (-30, 12)], (Bore(18), Thread("M20x1.5", 0, -10, inside=True), Thread("M24x1", 0, -20)))
    core = 10 - 5 / 8 * math.sqrt(3) / 2 * 1.5
    assert plain.volume - both.volume == pytest.approx(ring(core, 9, 10), rel=1e-9)
    inner, outer = both.threads
    assert 2 * core == pytest.approx(20 - 1.0825 * 1.5, abs=1e-4) and inner.minor == pytest.approx(2 * core)
    assert outer.minor == pytest.approx(24 - 1.2269, abs=1e-4) and outer.flanks == pytest.approx(24 - 0.6495, abs=1e-4)
    assert outer.band == pytest.approx((outer.minor / 2, 12)) and (outer.major, outer.pitch) == (24, 1)
    assert Thread("M30", 0, -20).pitch == 3.5


@pytest.mark.parametrize("seed", MANY)
def test_a_probe_touches_a_shaft(seed):
    """A ball of 1.5 from the side, onto the front, into the bore: plain arithmetic."""
    design, _, bottom = shaft(seed)
    (z, _), (low, wide) = design.profile.points[0], design.profile.points[-1]
    middle, turn = (low + design.profile.points[-2][0]) / 2, math.radians(37)
    ahead = (-math.cos(turn), -math.sin(turn), 0)
    start = (-60 * ahead[0], -60 * ahead[1], middle)
    assert contact(design.part, start, ahead, 1.5, 100) == pytest.approx(60 - wide - 1.5, abs=1e-9)
    bore = next((each for each in design.features if isinstance(each, Bore)), None)
    if bore is None:
        assert contact(design.part, (3, 0, z + 20), (0, 0, -1), 1.5, 50) == pytest.approx(18.5, abs=1e-9)
        return
    deep = z - (bore.depth + 6.5) / 2  # beyond the groove in it
    assert contact(design.part, (0, 0, deep), (0, 1, 0), 0.2, 50) == pytest.approx(bore.diameter / 2 - 0.2, abs=1e-9)
    rest = bottom + 1
    if bore.point < 180:  # in the point: the ball lies in the cone, 1 / sin of half its angle above the tip
        rest = bottom - bore.tip + 1 / math.sin(math.radians(bore.point / 2))
    assert contact(design.part, (0, 0, z + 5), (0, 0, -1), 1.0, 80) == pytest.approx(z + 5 - rest, abs=1e-9)


def test_a_file_of_arcs_and_odd_texts(tmp_path):
    line = Contour([(0, 0), (-10, 10), (-25, 10), (-30, 1 / 3)], [QUARTER, 0, -0.1, 0], closed=False)
    design = TurnedDesign(
        line, [RingGroove(-12, 2, depth=0.1, name='a "b"\n\\c', tolerances={"width": (0, 0.1), "depth": "H7"})],
        title="Привіт\x7f\t", tolerances={"length": 0.2},
    )  # fmt: skip
    path = tmp_path / "d.toml"
    assert TurnedDesign.load(design.save(path)) == design
    path.write_text("profile = [[0, 0, ], { z = 0.0, r = 0 }, [-5, 5]]\n")
    with pytest.raises(mnc.Alarm, match="the same place"):
        mnc.Design.load(path)
    rows = "{ z = 0, r = 0, arc = 10 },\n  { z = -10, r = 10, chamfer = [1, 30] },\n  [-10, 20],\n  [-20, 20],\n"
    path.write_text(f"profile = [\n  {rows}]\n")
    with pytest.raises(mnc.Alarm, match="one of its neighbours is an arc"):
        mnc.Design.load(path)
    path.write_text("profile = [\n  { z = 0, r = 0, arc = 10 },\n  [-10, 10],\n  [-20, 10],\n]\n")
    assert mnc.Design.load(path).volume == pytest.approx(2 / 3 * math.pi * 1000 + math.pi * 1000, rel=1e-12)


def test_tolerances_go_with_the_part_that_is_turned_over():
    """The front diameter becomes the last one; a length from the front is none from the other end."""
    given = {"diameter 1": "h6", "diameter 2": 0.1, "length": (0, 0.2), "length 1": 0.3, "radius 1": 0.05}
    design = TurnedDesign([(0, 10), (-20, 10), (-20, 15), (-50, 15)], roundings={1: 2}, tolerances=given)
    over = design.turned_over()
    assert over.tolerances == {"diameter 2": "h6", "diameter 1": 0.1, "length": (0, 0.2), "radius 1": 0.05}
    assert [each.nominal for each in over.measures()] == [50, 30, 20, 30, 2]
    assert "length 1" not in over.turned_over().tolerances and over.turned_over().profile == design.profile


def test_moved_along_the_axis():
    design, volume, _ = shaft(3)
    there = design.moved((0, 0, 12.5))
    assert there.volume == pytest.approx(volume, rel=1e-9)
    assert there.bounds == pytest.approx(design.bounds + (0, 0, 12.5))
    with pytest.raises(mnc.Alarm, match="along Z alone"):
        design.moved((1, 0, 0))


def test_what_a_drawing_says():
    design = TurnedDesign(
        [(0, 10), (-20, 10), (-20, 15), (-40, 20), (-60, 20)], (Bore(8, 12), Thread("M20x1.5", -2, -15)),
        roundings={1: 2}, chamfers={0: 1, 4: (2, 30)}, tolerances={"diameter 1": "h6"},
    )  # fmt: skip
    found = {each.name: each for each in design.measures()}
    assert {name: each.text or round(each.nominal, 9) for name, each in found.items()} == {
        "length": 60, "diameter 1": 20, "diameter 2": 30, "diameter 3": 40, "length 1": 20, "length 2": 40,
        "angle 1": round(math.degrees(math.atan2(5, 20)), 9), "radius 1": 2, "chamfer 1": "1×45°", "chamfer 2": "2×30°",
    }  # fmt: skip
    assert found["diameter 1"].limits == pytest.approx((-0.013, 0)) and found["diameter 1"].fit == "h6"
    places = {each.measure.name: each for each in design.dimensions()}
    assert places["radius 1"].centre == pytest.approx((-18, 12)) and places["length 2"].end == (-40, 20)
    bore, thread = (each.measures() for each in design.features)
    assert [(each.name, each.nominal) for each in bore] == [("diameter", 8), ("depth", 12)]
    assert thread[0].text == "M20×1.5" and thread[1].nominal == 13
    table = design._repr_html_()
    assert "⌀20" in table and "M20×1.5" in table and "h6" in table and "chamfer 2" in table
    assert repr(design).startswith("TurnedDesign(profile=Outline(points=((0, 10), (-20, 10)")


def test_the_finished_part_is_a_workpiece_and_a_blank():
    bar = mnc.blank.cylinder(20, -50, 0)
    design = mnc.TurnedDesign([(0, 12), (-30, 12), (-30, 20), (-50, 20)], CentreHole(2.5), blank=bar)
    part = design.workpiece()
    assert part.removed == pytest.approx(bar.volume - design.volume) and part.notes == () and part.error == 0
    assert part.at([-10.0, -40.0]).tolist() == [12, 20] and part.removed_by("line") == {}
    assert part.solid().volume == pytest.approx(design.volume, rel=2e-3)
    blank = design.as_blank()
    assert blank.volume == design.volume and blank.axis_x == 0
    low, high = blank.faces(np.array([0.0, 10.0, 15.0]), np.zeros(3))
    tip = 4.6 + 1.25 / math.tan(math.radians(59))
    assert high == pytest.approx([-tip, 0, -30]) and (low == -50).all()


def test_a_face_groove_and_stepped_bores():
    """Bores 20 deep 10 and through 8; a groove of 24 to 30, 3 deep, in the face, whose sides stay."""
    design = TurnedDesign([(0, 20), (-40, 20)], (Bore(20, 10, 180), Bore(8), FaceGroove(24, 30, 3)))
    volume = math.pi * (400 * 40 - 100 * 10 - 16 * 30 - (225 - 144) * 3)
    assert design.volume == pytest.approx(volume, rel=1e-12)
    assert design.workpiece().bore_at([-5.0, -20.0]).tolist() == [10, 4]

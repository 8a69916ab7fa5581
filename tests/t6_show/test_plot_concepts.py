"""What pictures show of the ideas behind the words: numbers from the program texts and from arithmetic beside them."""

import itertools
import math
from pathlib import Path

import numpy as np
import pytest
from tools.together import deep_but_one_in

import mnclab as mnc
from mnclab.geometry.contours import Contour
from mnclab.show.plot.face import faces, spiral
from mnclab.show.plot.holes import holes_of
from mnclab.show.plot.original import original_of
from mnclab.show.plot.overlay import centres_of, polar_of
from mnclab.show.plot.set_up import heights_of

PROGRAMS = Path(__file__).parents[2] / "data" / "programs"
HEAD = "G17 G90 G54 T4 S800 M3\nG0 X0 Y0\n"


def run(text, control="mnc", **setup):
    return mnc.run(text, control, mnc.Setup(**setup)) if setup else mnc.run(text, control)


def sample(name, **setup):
    return mnc.run(PROGRAMS / name, setup=mnc.Setup(**setup)) if setup else mnc.run(PROGRAMS / name)


def said(picture):
    return {text.get_text(): text for ax in picture.axes for text in ax.texts if text.get_text()}


def legend(picture):
    return [text.get_text() for text in picture.legends[0].get_texts()]


# --- centres of arcs --------------------------------------------------------------------------------------------------


def test_the_legs_lead_from_the_start_by_i_and_j_to_the_centre():
    (arc,) = centres_of(sample("mnc/arc_by_centre.mnc")).arcs  # X20.5 Y13.7, I21.5 J18.3
    assert arc.centre[:2] == pytest.approx((20.5 + 21.5, 13.7 + 18.3))
    (begin, bend, one), (also, end, other) = arc.legs
    assert (one, other) == ("I21.5", "J18.3")
    assert begin[:2] == pytest.approx((20.5, 13.7)) and end[:2] == pytest.approx((42, 32))
    assert bend[:2] == pytest.approx((42, 13.7)) and also[:2] == pytest.approx((42, 13.7))


def test_legs_lie_along_the_axes_of_a_turned_program_and_are_not_drawn_where_a_word_means_something_else():
    (arc,) = centres_of(run(HEAD + "G39 A90\nG0 X10 Y0\nG3 X10 Y20 I0 J10 F200\n")).arcs
    assert arc.start[:2] == pytest.approx((0, 10)) and arc.centre[:2] == pytest.approx((-10, 10))  # J points to -X now
    assert [leg[2] for leg in arc.legs] == ["J10"]
    text = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X0 Y0 Z0 R0 F100 M3\nCC X20 Y10\nC X+40 Y+0 DR+\nEND PGM A MM"
    (arc,) = centres_of(run(text, "tnc-620")).arcs
    assert not arc.legs and arc.centre[:2] == pytest.approx((20, 10)) and arc.radius == "radius 22.361"  # of 20 and 10


def test_a_radius_is_called_as_the_program_writes_it():
    found = centres_of(sample("mnc/four_arcs.mnc")).arcs  # two circles, each with R25 and R-25
    assert [sorted(arc.radius.split(", ")) for arc in found] == [["R-25", "R25"]] * 2
    assert sorted(arc.centre[1] for arc in found) == pytest.approx([-15, 15])
    (arc,) = centres_of(sample("mnc/scaled.mnc")).arcs  # twice as large as written
    assert arc.radius == "R5, scaled to 10"
    assert "R14.142" in [arc.radius for arc in centres_of(sample("jnc-t01/recess.jnc")).arcs]  # written R14.142136


def test_many_arcs_and_those_of_cycles_have_no_centres_unasked():
    wave = HEAD + "G91 F200\n" + "G2 X4 R5\n" * 5
    assert centres_of(run(wave)) is None and len(centres_of(run(wave), True).arcs) == 5
    assert centres_of(run(wave), False) is None
    assert "arc centre" in legend(run(wave).plot(centres=True)) and "arc centre" not in legend(run(wave).plot())
    with pytest.raises(mnc.Alarm, match="centres must be True or False"):
        run(wave).plot(centres="all")


def test_inches_are_said_in_inches():
    inch = "G20 G90 G54 S500 M3\nG0 X0 Y0\nG3 X2 Y0 I1 J0 F10\n"
    (arc,) = centres_of(run(inch, "iso")).arcs
    assert [leg[2] for leg in arc.legs] == ["I1"] and arc.centre[0] == pytest.approx(25.4)


# --- turned, mirrored, scaled; poles -----------------------------------------------------------------------------------


def test_the_original_of_a_mirrored_contour_is_its_reflection_and_the_line_lies_between():
    mirrored = sample("mnc/mirrored.mnc")  # G51 X25
    found = original_of(mirrored)
    path = mirrored.toolpath
    ends = path.end[np.isfinite(path.feed)][:, :2] * [-1, 1] + [50, 0]  # X becomes 2 * 25 - X
    drawn = found.points[np.isfinite(found.points[:, 0])][:, :2]
    assert all(np.hypot(*(drawn - end).T).min() < 1e-9 for end in ends)
    ((point, way, name),) = [(m.point, m.arms, m.name) for m in found.mirrors]
    assert point[0] == pytest.approx(25) and name == "mirror X25" and np.abs(way[:, 0]).max() == 0


def test_a_mirror_line_beside_a_shifted_zero_has_no_number_that_the_scale_contradicts():
    """The line X0 of the shifted program stands at 90 on the scale."""
    text = "0 BEGIN PGM A MM|1 TOOL CALL 1 Z S1000|2 CYCL DEF 7.0 DATUM SHIFT|3 CYCL DEF 7.1 X+90|4 CYCL DEF 8.0 MIRRORING"
    text += "|5 CYCL DEF 8.1 X|6 L X+10 Y+5 R0 F500 M3|7 L X+30|8 END PGM A MM"
    (line,) = original_of(mnc.run(text.replace("|", "\n") + "\n", "tnc-620")).mirrors
    assert line.point[0] == pytest.approx(90) and line.name == "mirror X"


def test_the_pole_and_the_angle_of_a_turn_and_the_rectangle_as_written():
    found = original_of(sample("mnc/turned.mnc"))  # G39 X10 Y10 A35 of X30 Y20, X50, Y10, X30
    (turn,) = found.turns
    assert turn.pole[:2] == pytest.approx((10, 10)) and math.degrees(turn.angle) == pytest.approx(35)
    drawn = found.points[np.isfinite(found.points[:, 0])][:, :2]
    for corner in ((30, 10), (30, 20), (50, 20), (50, 10)):
        assert np.hypot(*(drawn - corner).T).min() < 1e-9
    assert np.hypot(*(drawn - (10, 10)).T).min() >= 20 - 1e-9  # nothing else
    assert "35°" in said(sample("mnc/turned.mnc").plot())


def test_the_original_of_a_scaled_contour_is_half_as_large():
    found = original_of(sample("mnc/scaled.mnc"))  # X2 Y2 of X10 Y0, X15 Y5
    drawn = found.points[np.isfinite(found.points[:, 0])][:, :2]
    assert drawn.max(axis=0) == pytest.approx((15, 5)) and np.allclose(drawn[-1], (15, 5))


def test_a_program_that_turns_nothing_has_no_original():
    assert original_of(sample("mnc/square.mnc")) is None
    assert "as written" not in legend(sample("mnc/turned.mnc").plot(original=False))


def test_rays_say_radius_and_angle():
    rays = polar_of(sample("mnc/hexagon.mnc")).rays  # pole X20 Y20, R15, A180 120 60 0 -60 -120 -180
    assert [round(ray.angle, 6) for ray in rays] == [180, 120, 60, 0, -60, -120]
    for ray in rays:
        assert ray.pole[:2] == pytest.approx((20, 20)) and ray.radius == pytest.approx(15)
        way = 15 * np.array([math.cos(math.radians(ray.angle)), math.sin(math.radians(ray.angle))])
        assert ray.point[:2] == pytest.approx(20 + way)
    assert {"R15, 180°", "60°"} <= said(sample("mnc/hexagon.mnc").plot()).keys()


# --- holes and what holds the blank ------------------------------------------------------------------------------------


def test_an_angle_that_is_nearly_nothing_is_nothing():
    """The first corner of the hexagon lies on the X axis of its pole: 0 degrees, whatever the arithmetic leaves."""
    texts = said(sample("tnc-620/hexagon_and_bore.h").plot())
    assert "0°" in texts
    assert not [text for text in texts if "e" in text.removeprefix("pole").removeprefix("preset")]


def test_every_hole_is_a_circle_of_the_tool():
    found = holes_of(sample("mnc/row_of_holes.mnc")).holes  # drill 8, X10 30 70 90, Z-18
    assert [(hole.x, hole.y, hole.radius, hole.tip) for hole in found] == [(x, 10, 4, -18) for x in (10, 30, 70, 90)]
    assert all(hole.wall == pytest.approx(-18 + 4 / math.tan(math.radians(59))) for hole in found)
    above = sample("mnc/row_of_holes.mnc").plot().axes[0]
    (circles,) = [each for each in above.collections if each.get_label() == "_holes"]
    assert np.allclose(circles.get_offsets(), [(x, 10) for x in (10, 30, 70, 90)])
    assert len(holes_of(sample("tnc-620/flange.h")).holes) == 8 + 2 * 3 + 4 + 1


def test_bores_and_threads_are_as_wide_as_they_become_and_a_centre_as_its_cone():
    stock = ((0, 0, -25), (105, 20, 0))
    found = {(h.x, round(2 * h.radius, 6)) for h in holes_of(sample("mnc/prepared_holes.mnc", stock=stock)).holes}
    assert found == {(15, 6), (40, 8), (65, 14), (90, 14), (90, 16)}  # D-6, the drill, D14 twice, M16
    without = holes_of(sample("mnc/prepared_holes.mnc")).holes
    assert 15 not in {hole.x for hole in without}  # how wide the cone is depends on the top of the blank


def test_a_mill_that_plunges_makes_no_hole():
    assert holes_of(run("T4 S800 M3\nG0 X5 Y5 Z2\nG1 Z-3 F100\nX20\nG0 Z5\n")) is None
    picture = sample("tnc-620/flange.h").plot(view="XY")
    assert "dwell" not in legend(picture) and "plunge" not in legend(picture)  # the circles say it


def test_a_thread_on_a_helix_is_no_hole_of_its_tool():
    """The form of 267 goes round a stud with the drill of the trial; that of 264 pecks its core hole first."""
    assert holes_of(mnc.form("CYCL DEF 267", "tnc-620").run) is None
    (core,) = holes_of(mnc.form("CYCL DEF 264", "tnc-620").run).holes
    assert (core.x, core.y, core.tip) == (20, 10, -20)


def test_clamps_are_drawn_in_every_view():
    clamp = ((45, 0, 0), (55, 20, 15))
    picture = sample("mnc/row_of_holes.mnc", fixtures=(clamp,), stock=((0, 0, -22), (100, 20, 0))).plot()
    assert "fixture" in legend(picture)
    for ax, up in zip(picture.axes, ((0, 20), (0, 15))):
        boxes = [patch.get_xy() for patch in ax.patches if patch.get_hatch()]
        assert [(box.min(axis=0).tolist(), box.max(axis=0).tolist()) for box in boxes] == [([45, up[0]], [55, up[1]])]


# --- pictures of their own ---------------------------------------------------------------------------------------------


def test_pecks_over_time_end_at_their_depths():
    picture = sample("mnc/row_of_holes.mnc").plot_depth(line=5)  # R2, K6 down to Z-18
    assert [text for text in said(picture)] == ["−4", "−10", "−16", "−18"]
    (feed,) = [line for line in picture.axes[0].lines if line.get_label() == "feed"]
    assert np.nanmin(feed.get_ydata()) == -18
    (dwell,) = [line for line in picture.axes[0].lines if line.get_label() == "dwell"]
    assert np.ptp(dwell.get_xdata()[:-1]) == pytest.approx(0.5)  # P0.5
    with pytest.raises(mnc.Alarm, match="line 2 moves nothing"):
        sample("mnc/row_of_holes.mnc").plot_depth(line=2)


def test_vectors_from_machine_zero_end_at_the_zero_points():
    near = {1: (100, 50, 20), 2: (160, 70, 20)}
    picture = sample("mnc/two_parts.mnc", datums=near, start=(100, 50, 60)).plot_datums()
    assert {"machine zero", "G54  X100 Y50 Z20", "G55  X160 Y70 Z20"} == said(picture).keys()
    (ax,) = picture.axes
    marks = {line.get_label(): line.get_xydata().tolist() for line in ax.lines}
    assert marks["machine zero"] == [[0, 0]] and marks["zero point"] == [[100, 50], [160, 70]]
    far = {1: (4000, 3000, 20), 2: (4060, 3020, 20)}
    broken = sample("mnc/two_parts.mnc", datums=far, start=(4000, 3000, 60)).plot_datums()
    assert "machine zero, not to scale" in said(broken) and "//" in said(broken)
    assert np.ptp(broken.axes[0].get_xlim()) < 400


def test_a_rapid_bends_beside_the_zero_points_as_it_does_in_the_plot():
    """From X110 Y60 to X0 Y0 both axes set out together at one speed: Y is there first, 50 mm before X."""
    there = sample("mnc/machine_coordinates.mnc", datums={1: (100, 50, 20)}, start=(100, 50, 60))
    (line,) = [line for line in there.plot_datums().axes[0].lines if line.get_label() == "cuts and rapids"]
    bent = line.get_xydata()
    assert abs(bent - (50, 0)).sum(axis=1).min() < 5


def test_a_zero_point_does_not_move_with_the_length_of_a_tool():
    tools = {2: mnc.Tool(radius=4, length=120), 5: mnc.Tool(radius=5, length=85)}
    picture = sample("g43/two_lengths.g43", tools=tools, start=(0, 0, 200)).plot(view="XZ")
    assert said(picture)["G54"].xy == (0, 0)
    assert [text.get_text() for text in picture.axes[0].texts].count("G54") == 1


def test_spindle_tool_offset_and_program_add_up():
    tools = {2: mnc.Tool(radius=4, length=120), 5: mnc.Tool(radius=5, length=85)}
    right = heights_of(sample("g43/two_lengths.g43", tools=tools, start=(0, 0, 200)), 5)  # D2, Z-15
    assert (right.tip, right.nose, right.offset, right.length) == pytest.approx((-15, 105, 120, 120))
    mixed = run("T5 M6 S1000 M3\nG43 D2 Z30\nG1 Z0 F100\n", "g43", tools=tools, start=(0, 0, 200))
    wrong = heights_of(mixed, 3)  # tool 5 with the corrector of tool 2: 120 - 85 too high
    assert (wrong.wanted, wrong.tip, wrong.nose) == pytest.approx((0, 35, 120))
    picture = mixed.plot_lengths(3)
    assert "the tip is 35 mm too high" in picture.alt and {"offset 120 mm", "tool T5 85 mm"} <= said(picture).keys()


def test_zones_are_numbered_and_coloured():
    points = [(0, 15), (-10, 18), (-20, 18), (-25, 12), (-30, 12), (-32, 18), (-40, 18), (-40, 24), (-60, 24)]
    picture = mnc.schemes.plot_zones(Contour(points, closed=False), 30)
    assert legend(picture) == ["part", "open", "semi-open", "closed"]
    assert {"1", "2", "3"} == said(picture).keys()
    assert f"main angle from {math.degrees(math.atan(6 / 2)):.1f}°" in picture.alt  # 6 up in 2
    with pytest.raises(mnc.Alarm, match="leaves nothing to cut"):
        mnc.schemes.plot_zones(Contour([(0, 20), (-40, 20)], closed=False), 10)


def test_runs_stand_side_by_side_at_one_scale():
    text = "TOOL CALL 1 Z S3000\nL X-30 Y-10 R0 FMAX M3\nAPPR {} RL F500\nL Y+40\nDEP LT LEN12\n"
    ways = {"LT": "LT X+0 Y+10 LEN12", "LN": "LN X+0 Y+10 LEN12", "CT": "CT X+0 Y+10 CCA90 R+8"}
    picture = mnc.plot_runs({name: run(text.format(way), "tnc-620") for name, way in ways.items()}, marks=False)
    assert [ax.get_title(loc="left") for ax in picture.axes] == list(ways)
    assert len({(*ax.get_xlim(), *ax.get_ylim()) for ax in picture.axes}) == 1
    assert legend(picture) == ["feed", "rapid", "approach", "departure"]
    leads = [next(line for line in ax.lines if line.get_label() == "approach").get_xydata() for ax in picture.axes]
    assert all(np.allclose(lead[-1], (-5, 10)) for lead in leads)  # radius 5 to the left of X0 Y10
    for wrong in ({}, {"a": 1}, [1]):
        with pytest.raises(mnc.Alarm):
            mnc.plot_runs(wrong)


def test_runs_are_named_as_profiles_are():
    """One after the other, as a list, by a dict or by names; those that are called alike have their number."""
    one, other = run("G0 X0\nG1 X10 F100\n"), run("G0 X0\nG1 X20 F100\n")
    called = one.program.title
    for draw, said in (
        (mnc.plot_runs, lambda picture: [ax.get_title(loc="left") for ax in picture.axes]),
        (mnc.plot_profiles, lambda picture: [ax.texts[0].get_text().rpartition(": ")[0] for ax in picture.axes]),
    ):
        for picture in (draw(one, other), draw([one, other])):
            assert said(picture) == [f"{called} (1)", f"{called} (2)"]
        for picture in (draw(one, other, names=["a", "b"]), draw({"a": one, "b": other})):
            assert said(picture) == ["a", "b"]
        for given, names in (((one,), ["a", "b"]), (([],), ()), (({"a": 1},), ()), ((one, 5), ())):
            with pytest.raises(mnc.Alarm):
                draw(*given, names=names)


def test_a_spiral_in_a_face_comes_in_by_the_feed_in_every_turn():
    path = sample("nc-31/spiral_groove.nc31").toolpath  # from X105 to X4 (diameters) at 2 mm a turn
    row = faces(path)[0]
    points = spiral(path, row)
    radius = np.hypot(points[:, 0], points[:, 1])
    angle = np.abs(np.unwrap(np.arctan2(points[:, 1], points[:, 0])))
    assert radius[[0, -1]] == pytest.approx((52.5, 2)) and angle[-1] == pytest.approx(2 * math.pi * 25.25)
    assert np.allclose(radius, 52.5 - 2 * angle / (2 * math.pi))
    picture = sample("nc-31/spiral_groove.nc31").plot_face()
    assert legend(picture)[:4] == ["Z −0.3 mm", "Z −0.6 mm", "Z −0.8 mm", "Z −1 mm"]


# --- all of them -------------------------------------------------------------------------------------------------------

DRAWN = ["arc_by_centre", "arcs_by_radius", "four_arcs", "full_circle", "hexagon", "hexagon_arc", "scaled", "mirrored", "turned"]


@pytest.mark.parametrize("name, width", deep_but_one_in(3, itertools.product(DRAWN, [3.3, 7.0])))
def test_no_text_of_a_concept_covers_another(name, width):
    picture = sample(f"mnc/{name}.mnc").plot(size=(width, 6.0))
    picture.png()
    for ax in picture.axes:
        boxes = [(text.get_text(), text.get_window_extent()) for text in ax.texts if text.get_text()]
        for (one, a), (other, b) in itertools.combinations(boxes, 2):
            assert not a.overlaps(b), f"{one!r} and {other!r}"
        assert all(ax.bbox.x0 <= box.x0 and box.x1 <= ax.bbox.x1 for _, box in boxes)


@pytest.mark.parametrize("scale", [0.01, 5000])
def test_tiny_and_huge_arcs_have_their_centre(scale):
    text = f"{HEAD}G2 X{2 * scale:g} Y0 I{scale:g} J0 F100\n"
    picture = run(text).plot()
    (mark,) = [line for line in picture.axes[0].lines if line.get_label() == "arc centre"]
    assert mark.get_xydata()[0] == pytest.approx((scale, 0))
    assert f"I{scale:g}" in said(picture)


@pytest.mark.parametrize(("count", "names"), [(5, {f"hole ⌀{d}" for d in range(6, 11)}), (6, {"hole ⌀6 to ⌀11"})])
def test_a_legend_names_up_to_five_diameters_of_holes_each_and_more_from_the_least_to_the_greatest(count, names):
    """Drills of 6, 7, 8 ... mm."""
    tools = {k: mnc.Tool(diameter=5 + k, kind="drill") for k in range(1, count + 1)}
    blocks = [f"T{k} S800 M3\nG0 X{20 * k} Y10 Z5\nG99 G83 X{20 * k} Y10 Z-9 R2 K9 F100\nG80\nG0 Z5\n" for k in tools]
    stock = ((0, 0, -10), (150, 20, 0))
    (legend,) = mnc.run("".join(blocks), "mnc", mnc.Setup(tools=tools, stock=stock)).plot(view="XY").legends
    found = {t.get_text(): h.get_color() for t, h in zip(legend.get_texts(), legend.legend_handles) if "hole" in t.get_text()}
    assert found.keys() == names and len({*found.values()}) == len(names)


def test_diameters_of_holes_are_told_apart_by_colour_and_size():
    text = "T1 S1000 M3\nG0 X0 Y0 Z5\nG99 G83 X10 Y10 Z-20 R2 K20 F100\nG80\n"
    text += "T2 S800\nG99 G83 X40 Y10 Z-20 R2 K20 F100\nG80\nG0 Z5\n"
    tools = {1: mnc.Tool(diameter=6, kind="drill"), 2: mnc.Tool(diameter=16, kind="drill")}
    picture = mnc.run(text, "mnc", mnc.Setup(tools=tools, stock=((0, 0, -30), (50, 20, 0)))).plot(view="XY")
    (legend,) = picture.legends
    samples = {t.get_text(): h for t, h in zip(legend.get_texts(), legend.legend_handles) if t.get_text().startswith("hole")}
    small, large = samples["hole ⌀6"], samples["hole ⌀16"]
    assert small.get_markersize() < large.get_markersize() and small.get_color() != large.get_color()

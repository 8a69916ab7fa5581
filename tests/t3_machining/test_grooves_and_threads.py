"""Groove schemes: strokes as the source counts them, whole grooves, nothing beyond the walls; thread infeed."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mnclab import Tool
from mnclab.comparison.turning_schemes import compare
from mnclab.machining.turning import groove_schemes as grooves
from mnclab.machining.turning import threading as threads
from mnclab.machining.turning.groove_schemes import CONTOUR_TOOL, SHOULDER_TOOL, Groove
from mnclab.machining.turning.strokes import RAPID, THREAD

RING = Groove(right=0, width=5, bottom=25, rim=30)


def cut(groove, plan, *tools):
    """What becomes of a plan on the profile of its groove."""
    return compare(groove.profile, groove.rim, tools, {"groove": plan})[0]


@pytest.mark.parametrize(
    ("plan", "strokes"),
    [
        (grooves.scheme_1(RING, 5), 1),
        (grooves.scheme_1(RING, 3), 3),
        (grooves.scheme_2(RING, 3), 2),
        (grooves.scheme_2(RING, 2), 3),
        (grooves.scheme_3(RING, 2), 3),
        (grooves.scheme_4(RING, 2), 3),
        (grooves.scheme_5(RING, 3), 2),
        (grooves.scheme_5(RING, 3, finish=True), 4),
        (grooves.scheme_5(RING, 3, finish=True, bottom=True), 5),
    ],
)
def test_strokes_are_as_many_as_stated_and_the_groove_is_whole(plan, strokes):
    assert plan.passes == strokes
    width = {1: 5 if strokes == 1 else 3, 2: 3 if strokes == 2 else 2, 3: 2, 4: 2, 5: 3}[int(plan.name[-1])]
    trial = cut(RING, plan, Tool(width=width))
    assert trial.removed == pytest.approx(25, abs=1e-6) and trial.gouged == trial.struck == 0


@pytest.mark.parametrize("slope", [0.0, 17.0])
@pytest.mark.parametrize("width", [4.0, 5.0])
def test_every_approach_keeps_its_clearance(width, slope):
    """A rapid ends outside the rim by 1 mm, never on it; what goes down from there is at feed, along the wall's own line."""
    groove = Groove(0, width, 24, 30, slope, slope)
    plans = [grooves.scheme_1(groove, width), grooves.scheme_1(groove, 3), grooves.scheme_4(groove, 3)]
    if not slope:
        plans += [grooves.scheme_2(groove, 3, bottom=True), grooves.scheme_3(groove, 3)]
        plans += [grooves.scheme_5(groove, 3, finish, bottom) for finish in (False, True) for bottom in (False, True)]
    for plan in plans:
        before = plan.start
        for stroke in plan.strokes:
            if stroke.role == RAPID:
                assert stroke.r == 31
            elif before[1] > stroke.r:  # down
                sideways = 7 * math.tan(math.radians(slope))
                assert before[1] == 31 and abs(before[0] - stroke.z) in (0, pytest.approx(sideways))
            before = stroke.z, stroke.r


def test_sloping_walls():
    """A pulley groove: 4 at the bottom, walls of 17 degrees, 6 deep: (4 + 6 tan 17) · 6."""
    pulley = Groove(right=0, width=4, bottom=24, rim=30, slope_right=17, slope_left=17)
    trial = cut(pulley, grooves.scheme_4(pulley, 3), Tool(width=3))
    assert trial.removed == pytest.approx((4 + 6 * math.tan(math.radians(17))) * 6, abs=1e-6)
    assert trial.gouged == pytest.approx(0, abs=1e-9) and trial.struck == pytest.approx(0, abs=1e-9)
    with pytest.raises(ValueError, match="at the rim"):
        grooves.scheme_4(Groove(0, 4, 20, 30, 30, 30), 3)


@pytest.mark.parametrize("finish", [True, False])
def test_wide_grooves_with_two_tools(finish):
    wide = Groove(right=-5, width=30, bottom=24, rim=30)
    six = grooves.scheme_6(wide, 4, depth=2, finish=finish, bottom=finish)
    seven = grooves.scheme_7(wide, 4, depth=2, shoulder_tool=SHOULDER_TOOL)
    for plan, tools in ((six, (CONTOUR_TOOL, Tool(width=4))), (seven, (Tool(width=4), SHOULDER_TOOL))):
        assert [s.tool for s in plan.strokes] == sorted(s.tool for s in plan.strokes)
        trial = cut(wide, plan, *tools)
        assert trial.removed == pytest.approx(180, abs=1e-6)
        assert trial.gouged == pytest.approx(0, abs=1e-9) and trial.struck == pytest.approx(0, abs=1e-6)
    first = [s for s in six.strokes if s.tool == 1 and s.role == "plunge"]
    slope = (30 - first[-1].r) / (first[-1].z + 5 + (0.5 if finish else 0.0))
    assert math.degrees(math.atan(-slope)) == pytest.approx(30, abs=2.1)  # 28, or the edge's own 30
    with pytest.raises(ValueError, match="at least 24 mm, six tool widths"):
        grooves.scheme_6(Groove(0, 20, 24, 30), 4, depth=2)


@settings(max_examples=60, deadline=None)
@given(st.floats(1.5, 8), st.floats(0, 60), st.booleans())
def test_plunges_overlap_by_a_millimetre_and_end_at_the_walls(tool, more, finish):
    width = tool + 1 + more
    places = grooves.plunges(0, width, tool, finish)
    spare = 0.5 if finish else 0.0
    assert len(places) == math.ceil(grooves.side_steps(width, tool, finish) - 1e-9) + 1
    assert places[0] + tool == pytest.approx(-spare) and places[-1] == pytest.approx(spare - width)
    assert all(a - b <= tool - 1 + 1e-9 for a, b in zip(places, places[1:], strict=False))


def test_what_does_not_fit_is_refused():
    for call in (
        lambda: grooves.side_steps(10, 1), lambda: grooves.side_steps(3, 4), lambda: grooves.scheme_3(RING, 1.5),
        lambda: grooves.scheme_2(RING, 6), lambda: Groove(0, 0, 20, 30), lambda: Groove(0, 5, 30, 20),
        lambda: grooves.scheme_7(Groove(0, 8, 20, 30), 4, 2), lambda: threads.factor(30), lambda: threads.shifts((1, 0.5)),
        lambda: threads.shifts((1,), "sideways"), lambda: threads.passes_for(0.8), lambda: threads.methods_for(0),
    ):  # fmt: skip
        with pytest.raises(ValueError, match="."):
            call()


def test_infeeds_by_pitch_and_passes_of_unknown_origin():
    assert threads.methods_for(2) == ("radial",) and threads.methods_for(2.5) == ("flank", "alternate")
    assert threads.passes_for(2.0) == 8


@given(
    st.lists(st.floats(0.05, 0.5), min_size=1, max_size=12), st.sampled_from(threads.METHODS), st.sampled_from([60, 55])
)
def test_the_tool_stays_in_the_finished_gap_and_ends_in_the_middle(steps, method, profile):
    depths = [sum(steps[: k + 1]) for k in range(len(steps))]
    places = threads.shifts(depths, method, profile, nominal_last=True)
    slope = math.tan(math.radians(profile) / 2)
    assert places[-1] == 0
    for depth, place in zip(depths, places, strict=True):
        assert abs(place) + depth * slope <= depths[-1] * slope + 1e-9
    cut = threads.edge_shares(depths, places, profile)
    assert sum(map(sum, cut)) == pytest.approx(depths[-1] ** 2 * slope, rel=2e-3)


def test_edges_share_the_work():
    """Radial: both alike. One-sided: the leading edge does most. Alternate: in turn."""
    depths = threads.even_chips(1.84, 5)
    assert [d * d for d in depths] == pytest.approx([1.84**2 * k / 5 for k in range(1, 6)])
    share = {m: threads.edge_shares(depths, threads.shifts(depths, m, nominal_last=True)) for m in threads.METHODS}
    assert all(behind == pytest.approx(ahead, rel=0.02) for behind, ahead in share["radial"])
    assert all(ahead > 2 * behind for behind, ahead in share["flank"][1:])
    leads = [ahead > behind for behind, ahead in share["alternate"][1:]]
    assert leads == [False, True, False, True]


def test_a_thread_in_passes():
    plan = threads.thread(2, -20, 10, (0.4, 0.8, 1.0), "flank")
    cuts = [s for s in plan.strokes if s.role == THREAD]
    assert [(s.r, s.z) for s in cuts] == [pytest.approx(p) for p in ((9.6, -19.7), (9.2, -19.9), (9, -20))]
    assert plan.length(THREAD) == pytest.approx(3 * 22) and plan.passes == 3
    cone = threads.thread(0, -16, 10, (0.4, 1.0), taper=1.0)
    assert [s.r for s in cone.strokes if s.role == THREAD] == pytest.approx([9.6, 9.0])
    flank = threads.thread(0, -16, 10, (0.4, 1.0), "flank", taper=1.0)  # shifted by 0.3 against the feed, along the cone
    assert [way.points[0].tolist() for s, way in flank.ways if s.role == THREAD] == [
        pytest.approx((0.3, 8.6 - 0.3 / 16)), pytest.approx((0, 8))
    ]  # fmt: skip

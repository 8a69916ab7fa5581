"""Tapping, cycles 206, 207 and 209 (5.2 to 5.4): the printed definitions, the spindle, the factor of the way out."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab as mnc


def spindle(path: mnc.Toolpath) -> list[tuple[float, float]]:
    """Where the spindle changes, and to what speed."""
    events = path[path.kind == mnc.Kind.SPINDLE]
    return [(float(z), float(speed)) for z, speed in zip(events.end[:, 2], events.spindle, strict=True)]


def cuts(path: mnc.Toolpath) -> mnc.Toolpath:
    return path[path.kind == mnc.Kind.LINE]


# --- 206 ---------------------------------------------------------------------------------------------------------------


def test_206_as_printed(called, drilled, rows) -> None:
    """5.2: FMAX to 27, F150 to 5, reversed, 0.25 s, F150 to 27, reversed, FMAX to 75; 44 mm of feed in 17.6 s."""
    run = called(206)
    assert run.alarms == ()
    assert drilled(run)[1:] == ["Z27 FMAX", "Z5 F150", "dwell 0.25 s", "Z27 F150", "Z75 FMAX"]
    path = rows(run)
    assert spindle(path) == [(5, -500), (27, 500)]
    assert not cuts(path).synchronous.any()  # the holder takes up what spindle and feed differ by
    assert cuts(path).length == 44 and float((cuts(path).lengths / cuts(path).feed).sum() * 60) == pytest.approx(17.6)


def test_206_taps_with_the_spindle_as_it_turns(called, rows) -> None:
    """M4 for a left-hand thread: it is reversed to M3 and back."""
    assert spindle(rows(called(206, "M4"))) == [(5, 500), (27, -500)]


@pytest.mark.parametrize("pitch", [0, 0.3, 0.3009])
def test_206_compares_the_pitch_of_the_tap(called, pitch) -> None:
    """F = S times pitch: 150 / 500 = 0.3 mm, which may differ by rounding."""
    assert called(206, pitch=pitch).ok


def test_206_at_the_feed_of_the_tool_call(called, drilled) -> None:
    assert drilled(called(206, Q206="FAUTO"))[2] == "Z5 F333"


# --- 207 ---------------------------------------------------------------------------------------------------------------


def test_207_as_printed(called, drilled, rows) -> None:
    """5.3: synchronized feed 500 * 1 mm/min to 5 and back to 27, stop there, FMAX to 75; 22 revolutions each way."""
    run = called(207)
    assert run.alarms == ()
    assert drilled(run)[1:] == ["Z27 FMAX", "Z5 F500", "Z27 F500", "Z75 FMAX"]
    path = cuts(rows(run))
    assert path.synchronous.all()
    assert (path.lengths / path.feed * abs(path.spindle)).tolist() == pytest.approx([22, 22])


@pytest.mark.parametrize(("before", "after"), [("M3", 500), ("M4", -500), ("M5", 0)])
@pytest.mark.parametrize("hand", [1, -1])
def test_207_the_pitch_is_the_hand_and_the_spindle_goes_on_as_before(called, rows, before, after, hand) -> None:
    path = rows(called(207, before, Q239=hand * 1.25))
    into, out = cuts(path)
    assert (into.spindle, out.spindle) == (hand * 500, -hand * 500)
    assert into.feed == out.feed == 625
    up = path[path.kind == mnc.Kind.RAPID][-1]
    assert up.spindle == 0 and up.start[2] == 27  # stopped at the set-up clearance
    assert path[-1].spindle == after


@pytest.mark.parametrize("number", [207, 209])
def test_rigid_tapping_needs_no_turning_spindle(called, number) -> None:
    """Synchronization begins with the spindle standing too (5.3): nobody is warned."""
    assert called(number, "M5").alarms == ()


@pytest.mark.parametrize("hand", [1, -1])
def test_207_taps_as_its_sibling_of_the_mnc(called, rows, hand) -> None:
    """G309: the same moves, feeds and spindle from the set-up clearance into the thread and back."""
    sibling = mnc.run(f"G17 G90 G54\nT2 S500 M3\nG0 X0 Y0 Z100\nG309 Q2 Z25 H-20 P{hand}\nG0 X0 Y0 M99\n", "mnc")
    theirs = sibling.toolpath[[sibling.toolpath.labels[k].startswith("G309") for k in sibling.toolpath.label]]
    ours = rows(called(207, Q239=hand))[: len(theirs) - 1]
    theirs = theirs[:-1]  # the end of the cycle is each control's own
    assert len(ours) > 4 and ours.kind.tolist() == theirs.kind.tolist()
    for column in ("end", "feed", "spindle", "synchronous"):
        assert np.array_equal(getattr(ours, column), getattr(theirs, column), equal_nan=True), column


# --- 209 ---------------------------------------------------------------------------------------------------------------

PASSES_209 = {
    "1": [27, 20, 21, 15, 16, 10, 11, 5, 27, 75],  # as printed
    "0": [27, 20, 27, 15, 27, 10, 27, 5, 27, 75],  # out of the hole
    "20": [27, 20, 27, 15, 27, 10, 27, 5, 27, 75],  # a longer way back than out of the hole is out of the hole
}


@pytest.mark.parametrize("factor", PASSES_209)
def test_209_as_printed(called, rows, factor) -> None:
    """5.4: oriented at 27; in at S * 1, out at 1.5 * S * 1, speed and feed."""
    run = called(209, Q256=factor)
    path = rows(run)
    assert run.alarms == ()
    assert path.end[path.is_motion, 2].tolist() == PASSES_209[factor]
    assert cuts(path).feed.tolist() == [500, 750] * 4 and cuts(path).spindle.tolist() == [500, -750] * 4
    assert cuts(path).synchronous.all()
    first = path[path.kind == mnc.Kind.SPINDLE][0]
    assert first.label == "CYCL DEF 209 orient the spindle to 50 degrees" and first.end[2] == 27 and first.spindle == 0
    assert [move.label for move in cuts(path)][::2] == [f"CYCL DEF 209 cut the thread {k} of 4" for k in (1, 2, 3, 4)]
    assert path[-1].spindle == 500


def test_209_in_one_pass(called, rows) -> None:
    path = rows(called(209, Q257=0))
    assert path.end[path.is_motion, 2].tolist() == [27, 5, 27, 75]


def test_209_the_way_out_is_no_faster_than_the_spindle_can(called, rows) -> None:
    path = cuts(rows(called(209, limits=mnc.Limits(spindle=600))))
    assert path.spindle.tolist() == [500, -600] * 4 and path.feed.tolist() == [500, 600] * 4


tenths = st.integers(1, 300).map(lambda n: n / 10)


@given(depth=tenths, every=tenths, factor=st.integers(0, 5), pitch=st.sampled_from([0.5, -1, 1.75]), clearance=tenths)
def test_209_breaks_the_chip_every_so_deep(called, rows, depth, every, factor, pitch, clearance) -> None:
    """d_k = min(k * Q257, A); back by the factor times the pitch, or out; and never above the set-up clearance."""
    path = rows(called(209, Q201=-depth, Q257=every, Q256=factor, Q239=pitch, Q200=clearance, Q203=0, Q204=0))
    levels, out = [], clearance
    for k in range(1, math.ceil(round(depth / every, 9)) + 1):
        reached = -min(k * every, depth)
        levels += [reached, min(reached + factor * abs(pitch), out) if factor else out]
    levels[-1] = out
    assert path.end[path.is_motion, 2].tolist() == pytest.approx([out, *levels])
    into = cuts(path)[::2]
    assert (into.feed == 500 * abs(pitch)).all() and (into.spindle == math.copysign(500, pitch)).all()


# --- all ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("number", [206, 207, 209])
class TestAllOfThem:
    def test_depth_zero_is_not_executed(self, called, rows, number) -> None:
        """Whatever else is wrong: no spindle, no pitch."""
        assert len(rows(called(number, "M5", Q201=0))) == 0
        assert number == 206 or len(rows(called(number, Q201=0, Q239=0))) == 0

    @pytest.mark.parametrize(("second", "end"), [(0, 27), (1, 27), (2, 27), (3, 28)])
    def test_second_clearance_counts_where_it_is_greater(self, called, rows, number, second, end) -> None:
        assert rows(called(number, Q204=second)).end[-1, 2] == end

    def test_upwards_where_it_is_allowed(self, called, rows, number) -> None:
        """The set-up plane is 2 below the surface, the end plane above it as always."""
        path = rows(called(number, settings={"depth_error": False}, Q201=10, **{"Q257": 0} if number == 209 else {}))
        assert path.end[path.is_motion, 2].tolist() == [23, 35, 23, 75]

    def test_the_spindle_stands_at_the_bottom(self, called, rows, number) -> None:
        """thrdWaitingTime: it stops at the end of the thread, once, before it turns back."""
        path = rows(called(number, settings={"thread_wait": 0.4}, **{"Q211": 0} if number == 206 else {}))
        (wait,) = path[path.kind == mnc.Kind.DWELL]
        assert (wait.time, wait.end[2], wait.spindle) == (0.4, 5, 0)

    def test_in_inches(self, called, rows, number) -> None:
        """Lengths and pitch are inches, the feed tenths of an inch: 20 threads an inch are 1.27 mm."""
        more = {"Q206": 250} if number == 206 else {"Q239": 0.05}
        path = rows(called(number, unit="INCH", pitch=1.27, Q200=0.1, Q201=-0.8, Q203=0, Q204=0, **more))
        levels = path.end[path.is_motion, 2]
        assert (levels.min(), levels.max()) == pytest.approx((-20.32, 2.54))
        assert cuts(path)[0].feed == pytest.approx(635)

    def test_every_row_is_labelled(self, called, rows, number) -> None:
        assert all(len(move.label) > len("CYCL DEF 206 ") for move in rows(called(number)))

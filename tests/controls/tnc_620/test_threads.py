"""Thread milling, cycles 262 to 265 and 267 (5.5 to 5.10): printed definitions, table of directions."""

from __future__ import annotations

import math

import numpy as np
import pytest

import mnclab as mnc

HOLES = (262, 263, 264, 265)  # inner threads
ALL = (*HOLES, 267)


def steps(path: mnc.Toolpath) -> list[tuple[object, ...]]:
    """Rows as the manual's sequences tell them: target, feed, and turns of arcs; in tenths of a micrometre."""
    found: list[tuple[object, ...]] = []
    for move in path[path.is_motion]:
        turns = (round(move.sweep / math.tau, 6),) if move.kind == mnc.Kind.ARC else ()
        found.append((*(round(float(value), 4) + 0.0 for value in move.end), round(float(move.feed), 4), *turns))
    return found


def helix(path: mnc.Toolpath) -> mnc.Toolpath:
    return path[["helix" in path.labels[k] for k in path.label]]


FMAX = math.inf


# --- 262 ---------------------------------------------------------------------------------------------------------------


def test_262_as_printed(called, rows) -> None:
    """5.6 with a tool of radius 3: r 2, half circles of 1, rise 0.375, feed of the centre 500 * 4 / 10."""
    run = called(262)
    assert run.alarms == ()
    assert steps(rows(run)) == [
        (0, 0, 32, FMAX), (0, 0, 10, 750), (0, 0, 9.625, 750), (2, 0, 10, 200, 0.5), (2, 0, 11.5, 200, 1),
        (0, 0, 11.5, 200, 0.5), (0, 0, 80, FMAX),
    ]  # fmt: skip


RUNS_262 = {
    (0, 1): [(10, 11.5)],
    (0, -1): [(11.5, 10)],
    (1, 1): [(10, 31)],
    (1, -1): [(31, 10)],
    (4, 1): [(10, 11.5), (16, 17.5), (22, 23.5), (28, 29.5)],
    (4, -1): [(29.5, 28), (23.5, 22), (17.5, 16), (11.5, 10)],
}


@pytest.mark.parametrize("number", [262, 267])
@pytest.mark.parametrize(("a_step", "milling"), RUNS_262)
def test_threads_per_step(called, rows, number, a_step, milling) -> None:
    """5.6 and 5.10; outside, climb milling works downwards, so the levels are those of the other way."""
    path = rows(called(number, Q355=a_step, Q351=milling))
    found = helix(path)
    levels = list(zip(found.start[:, 2].tolist(), found.end[:, 2].tolist(), strict=True))
    assert levels == RUNS_262[a_step, milling if number == 262 else -milling]
    sense = milling if number == 262 else -milling
    assert (found.sweep / math.tau).tolist() == pytest.approx([sense * (14 if a_step == 1 else 1)] * len(found))
    for way in ("approach", "departure"):
        assert len([move for move in path if way in move.label and "rise" not in move.label]) == len(found)


def test_262_a_narrow_tool_begins_beside_the_thread(called, rows) -> None:
    """Nominal 30 with R 5: from the start level to X7, half circles of 1.5, rise 0.1125; and back to the centre."""
    assert steps(rows(called(262, radius=5, Q335=30)))[1:] == [
        (0, 0, 10, 750), (7, 0, 10, 750), (7, 0, 9.8875, 750), (10, 0, 10, 333.3333, 0.5), (10, 0, 11.5, 333.3333, 1),
        (7, 0, 11.5, 333.3333, 0.5), (0, 0, 11.5, 750), (0, 0, 80, FMAX),
    ]  # fmt: skip


def test_262_at_the_limit_no_lateral_move(called, rows) -> None:
    """2R = D - 4P: the half circle of radius P begins on the axis."""
    labels = [move.label for move in rows(called(262, radius=3, Q335=12))]
    assert not any("beside" in label for label in labels)
    assert any("beside" in move.label for move in rows(called(262, radius=2.99, Q335=12)))


def test_262_own_feed_of_the_approach(called, rows) -> None:
    """Q512, like Q207, at the cutting edge: 250 * 4 / 10."""
    feeds = [step[3] for step in steps(rows(called(262, Q512=250)))]
    assert feeds == [FMAX, 750, 750, 100, 200, 200, FMAX]


def test_feeds_in_words(called, rows) -> None:
    assert [step[3] for step in steps(rows(called(262, Q253="FMAX", Q207="FAUTO", Q512="FAUTO")))] == [
        FMAX, FMAX, FMAX, 133.2, 133.2, 133.2, FMAX,
    ]  # fmt: skip


# --- the table of 5.5 ----------------------------------------------------------------------------------------------------

DIRECTIONS = [  # inner or outer thread, sign of the pitch, Q351, side of the tool, way along the axis
    (262, 1, 1, "RL", 1), (262, -1, -1, "RR", 1), (262, 1, -1, "RR", -1), (262, -1, 1, "RL", -1),
    (267, 1, 1, "RL", -1), (267, -1, -1, "RR", -1), (267, 1, -1, "RR", 1), (267, -1, 1, "RL", 1),
]  # fmt: skip


@pytest.mark.parametrize(("number", "hand", "milling", "side", "way"), DIRECTIONS)
def test_directions(called, rows, number, hand, milling, side, way) -> None:
    """Inside, a tool on the left of the wall (RL) goes round counter-clockwise; outside clockwise."""
    (move,) = helix(rows(called(number, Q239=hand * 1.5, Q351=milling)))
    left = move.sweep > 0 if number == 262 else move.sweep < 0
    assert ("RL" if left else "RR", np.sign(move.end[2] - move.start[2])) == (side, way)


@pytest.mark.parametrize("number", [262, 263, 264, 267])
def test_milling_type_0_is_climb(called, rows, number) -> None:
    assert steps(rows(called(number, Q351=0))) == steps(rows(called(number, Q351=1)))


@pytest.mark.parametrize("number", ALL)
def test_mirrored_in_one_axis_the_thread_has_the_other_hand(called, rows, number) -> None:
    """The whole path is mirrored: the rotation turns over, the way along the axis does not."""
    starts = ("M3", "M3\n2 CYCL DEF 8.0 M\n2 CYCL DEF 8.1 X")
    plain, mirrored = (helix(rows(called(number, start)))[0] for start in starts)
    assert mirrored.sweep == -plain.sweep
    assert (mirrored.start[2], mirrored.end[2]) == (plain.start[2], plain.end[2])


# --- 263 ---------------------------------------------------------------------------------------------------------------


def test_263_as_printed(called, rows) -> None:
    """5.7 with R 3: straight to 10; a circle of (10 - 1.6238) / 2 - 3 - 0.2 = 0.9881 at F150; the thread 14 to 15.5."""
    run = called(263)
    assert run.alarms == ()
    assert steps(rows(run)) == [
        (0, 0, 32, FMAX), (0, 0, 10, 750), (0.9881, 0, 10, 150, 0.5), (0.9881, 0, 10, 150, 1), (0, 0, 10, 150, 0.5),
        (0, 0, 14, 750), (0, 0, 13.625, 750), (2, 0, 14, 200, 0.5), (2, 0, 15.5, 200, 1), (0, 0, 15.5, 200, 0.5),
        (0, 0, 80, FMAX),
    ]  # fmt: skip


def test_263_without_a_clearance_at_the_side(called, rows) -> None:
    """Q253 to the set-up clearance above the countersink, Q254 from there."""
    assert steps(rows(called(263, Q357=0)))[1:3] == [(0, 0, 12, 750), (0, 0, 10, 150)]


def test_263_a_tool_that_fills_the_hole_makes_no_circle(called, rows) -> None:
    """(10 - 1.6238) / 2 - 4.2 < 0."""
    assert not any("side" in move.label for move in rows(called(263, radius=4.2)))


def test_263_a_narrow_tool_goes_beside_the_core_first(called, rows) -> None:
    """D 30, R 3: 14.1881 - 3 - 0.2 = 10.9881, the half circle of 1.5 begins at 7.9881."""
    found = steps(rows(called(263, Q335=30)))
    assert found[2:7] == [
        (7.9881, 0, 10, 750), (10.9881, 0, 10, 150, 0.5), (10.9881, 0, 10, 150, 1), (7.9881, 0, 10, 150, 0.5), (0, 0, 10, 750),
    ]  # fmt: skip


@pytest.mark.parametrize("number", [263, 264])
def test_countersink_at_front(called, rows, number) -> None:
    """Q356 = 0: only front and thread. 264 has no feed of its own for it: that of milling counts."""
    feed = 150 if number == 263 else 500
    assert steps(rows(called(number, Q356=0, Q358=-1.5, Q359=2.5)))[:6] == [
        (0, 0, 32, FMAX), (0, 0, 28.5, 750), (2.5, 0, 28.5, feed, 0.5), (2.5, 0, 28.5, feed, 1), (0, 0, 28.5, feed, 0.5),
        (0, 0, 14, 750),
    ]  # fmt: skip


@pytest.mark.parametrize("number", [263, 264, 265])
def test_countersink_at_front_where_the_tool_stands(called, rows, number) -> None:
    """Without an offset the tool only goes down."""
    path = rows(called(number, Q358=-1.5, **{"Q356": 0} if number != 265 else {}))
    assert steps(path)[1][:3] == (0, 0, 28.5)
    assert not any("countersink" in move.label for move in path)


@pytest.mark.parametrize("number", [263, 264])
def test_the_thread_ends_above_the_end_of_the_hole(called, number) -> None:
    """A third of the pitch, 0.5 mm; a warning at the word of the depth."""
    assert called(number, Q201=-19.5).alarms == ()
    (alarm,) = called(number, Q201=-19.6).alarms
    assert alarm.severity == "warning" and alarm.span[:2] == (7, 1)
    assert alarm.message == (
        f"CYCL DEF {number} Q201 (thread depth) should be at least a third of the pitch less deep than Q356 = -20, got -19.6"
    )
    assert called(number, Q201=-30, Q356=0).alarms == ()


# --- 264 ---------------------------------------------------------------------------------------------------------------

DRILLED = {
    5: [32, 25, 25.2, 20, 20.2, 15, 15.2, 10],
    0: [32, 25, 32, 25.2, 20, 32, 20.2, 15, 32, 15.2, 10],
    2: [  # within each plunging depth too, counted anew
        *(32, 28, 28.2, 28, 26, 26.2, 26, 25, 25.2, 23, 23.2, 23, 21, 21.2, 21, 20),
        *(20.2, 18, 18.2, 18, 16, 16.2, 16, 15, 15.2, 13, 13.2, 13, 11, 11.2, 11, 10),
    ],
}


@pytest.mark.parametrize("every", DRILLED)
def test_264_drills_as_printed(called, rows, every) -> None:
    """5.8: four infeeds of 5 at F150; then the thread from 14."""
    run = called(264, Q257=every)
    assert run.alarms == ()
    found = steps(rows(run))
    count = len(DRILLED[every])
    assert [step[2] for step in found[:count]] == DRILLED[every]
    assert {step[3] for step in found[:count]} == {150, FMAX}
    assert found[count:] == [
        (0, 0, 14, 750), (0, 0, 13.625, 750), (2, 0, 14, 200, 0.5), (2, 0, 15.5, 200, 1), (0, 0, 15.5, 200, 0.5),
        (0, 0, 80, FMAX),
    ]  # fmt: skip


@pytest.mark.parametrize(("hole", "infeed"), [(-20, 20), (-20, 33)])
def test_264_in_one_movement(called, rows, hole, infeed) -> None:
    assert [step[2] for step in steps(rows(called(264, Q202=infeed, Q257=0)))[:3]] == [32, 10, 14]


def test_264_without_a_hole(called, rows) -> None:
    assert [step[2] for step in steps(rows(called(264, Q356=0, Q202=0)))[:3]] == [32, 14, 13.625]


# --- 265 ---------------------------------------------------------------------------------------------------------------


def test_265_as_printed(called, rows) -> None:
    """5.9 with R 3: eleven turns clockwise from 30.5 to 14, compensation to 30.875."""
    run = called(265)
    assert run.alarms == ()
    assert steps(rows(run)) == [
        (0, 0, 32, FMAX), (0, 0, 30.5, 750), (0, 0, 30.875, 750), (2, 0, 30.5, 200, -0.5), (2, 0, 14, 200, -11),
        (0, 0, 14, 200, -0.5), (0, 0, 80, FMAX),
    ]  # fmt: skip


@pytest.mark.parametrize("turning", ["M3", "M4"])
@pytest.mark.parametrize("hand", [1, -1])
def test_265_always_downwards(called, rows, turning, hand) -> None:
    """Either way the tool turns; the hand alone says which way round."""
    (move,) = helix(rows(called(265, turning, Q239=hand * 1.5)))
    assert move.sweep / math.tau == pytest.approx(-11 * hand) and (move.start[2], move.end[2]) == (30.5, 14)


@pytest.mark.parametrize(("order", "plunge"), [(0, 150), (1, 750)])
def test_265_countersinks_before_or_after(called, rows, order, plunge) -> None:
    """Down to the front at Q254 before the thread, up to it at Q253 after; the circle at Q254."""
    path = rows(called(265, Q358=-1, Q359=2, Q360=order))
    labels = [move.label.removeprefix("CYCL DEF 265 ") for move in path]
    front = labels.index("to the depth at front")
    assert (front < labels.index("helix")) == (order == 0)
    assert steps(path)[front : front + 4] == [
        (0, 0, 29, plunge), (2, 0, 29, 150, -0.5), (2, 0, 29, 150, -1), (0, 0, 29, 150, -0.5),
    ]  # fmt: skip


# --- 267 ---------------------------------------------------------------------------------------------------------------


def test_267_as_printed(called, rows) -> None:
    """5.10 with R 5: r 10, start at 13, half circles of 1.5 the other way round, rise 0.1125, feed 500 * 20 / 10."""
    run = called(267, radius=5)
    assert run.alarms == ()
    assert steps(rows(run)) == [
        (0, 0, 32, FMAX), (13, 0, 32, FMAX), (13, 0, 11.5, 750), (13, 0, 11.6125, 750), (10, 0, 11.5, 1000, 0.5),
        (10, 0, 10, 1000, -1), (13, 0, 10, 1000, 0.5), (13, 0, 80, FMAX),
    ]  # fmt: skip


@pytest.mark.parametrize("offset", [4, 9, 13, 16])
def test_267_countersinks_the_end_of_the_stud(called, rows, offset) -> None:
    """At Q253 down beside the stud; a circle about it at Q254, clockwise as the thread; back to the start point."""
    path = rows(called(267, radius=5, Q358=-1, Q359=offset))
    found = steps(path)
    assert found[:3] == [(0, 0, 32, FMAX), (13, 0, 32, FMAX), (13, 0, 29, 750)]
    circle = next(k for k, move in enumerate(path) if move.label == "CYCL DEF 267 countersink")
    assert found[circle] == (offset, 0, 29, 150, -1)
    assert found[circle + (offset != 13)][:3] == (13, 0, 29)
    assert [step[2] for step in found[circle + 1 + (offset != 13) :][:2]] == [11.5, 11.6125]


# --- all of them ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("number", ALL)
def test_every_row_says_what_it_is(called, rows, number) -> None:
    """In the name of its cycle; of several helices each says which."""
    path = rows(called(number, **{"Q355": 4} if number in (262, 267) else {}))
    labels = [move.label.removeprefix(f"CYCL DEF {number} ") for move in path]
    assert all(labels) and not any(label.startswith("CYCL") for label in labels)
    several = [f"helix {k} of 4" for k in (1, 2, 3, 4)] if number in (262, 267) else ["helix"]
    assert [label for label in labels if "helix" in label] == several


@pytest.mark.parametrize("number", ALL)
@pytest.mark.parametrize(("second", "end"), [(0, 32), (2, 32), (3, 33)])
def test_second_clearance_counts_where_it_is_greater(called, rows, number, second, end) -> None:
    assert rows(called(number, Q204=second)).end[-1, 2] == end


def test_262_depth_zero_is_not_executed(called, rows) -> None:
    assert len(rows(called(262, "M5", Q201=0, Q239=0))) == 0


@pytest.mark.parametrize("number", [263, 264, 265, 267])
def test_depth_zero_leaves_the_thread_out(called, rows, number) -> None:
    path = rows(called(number, Q201=0, Q358=-1, Q359=2, Q207=500))
    assert len(helix(path)) == 0 and any(move.label.endswith("countersink") for move in path)


@pytest.mark.parametrize("number", ALL)
def test_upwards_where_it_is_allowed(called, rows, number) -> None:
    """The set-up plane lies 2 below the surface 30, the thread between the surface and 40; the rotation stays."""
    more = {"Q356": 20} if number in (263, 264) else {}
    path = rows(called(number, settings={"depth_error": False}, Q201=10, **more))
    levels = path.end[:, 2]
    assert levels[0] == 28 and levels[-1] == 80 and levels.min() >= 28
    found = helix(path)
    assert max(found.start[:, 2].max(), found.end[:, 2].max()) == 40
    assert np.sign(found.sweep).tolist() == np.sign(helix(rows(called(number))).sweep).tolist()


def test_in_inches(called, rows) -> None:
    """20 threads an inch: 1.27 mm a turn."""
    path = rows(called(262, unit="INCH", Q335=0.5, Q239=0.05, Q201=-0.6, Q355=1, Q203=0, Q204=0, Q200=0.1))
    (move,) = helix(path)
    assert move.end[2] - move.start[2] == pytest.approx(12 * 1.27) and move.start[2] == pytest.approx(-15.24)
    assert math.hypot(*move.end[:2]) == pytest.approx(6.35 - 3)


@pytest.mark.parametrize("number", ALL)
def test_the_delta_of_the_tool_counts(called, rows, number) -> None:
    """DR of TOOL CALL corrects the profile (5.5)."""
    (move,) = helix(rows(called(number, "M3\n2 TOOL CALL Z DR+0.1")))
    assert math.hypot(*move.end[:2]) == pytest.approx(5 + (3.1 if number == 267 else -3.1))

"""Cycle 275: the example of the manual, open and closed slots, what is finished, frames, and the part that is left."""

import math

import numpy as np
import pytest
from tools.running import run

from mnclab import Kind, Tool
from mnclab.controls.tnc_620.contours.trochoidal_slot import TrochoidalSlot
from mnclab.controls.tnc_620.trial import first_words, trial_program

MILL = Tool(radius=5, number=1, kind="mill", plunge_angle=10, length=80, cutting_length=40)
#: tnc620-contour, cycle 275, "Definition (lines 5882 to 5919)".
EXAMPLE = dict(
    Q215=0, Q219=12, Q368=0.2, Q436=2, Q207=500, Q351=1, Q201=-20, Q202=5, Q206=150, Q338=5, Q385=500, Q200=2, Q203=0,
    Q204=50, Q366=2, Q369=0, Q439=0,
)  # fmt: skip
STRAIGHT = "L X+10 Y+10\nL X+50"
BENT = "L X+10 Y+10\nL X+40\nRND R10\nL Y+40\nCC X+55 Y+40\nC X+70 Y+40 DR-\nL Y+10\nL X+90 Y+0"
CLOSED = "L X+20 Y+10\nL X+60\nRND R12\nL Y+50\nRND R12\nL X+0\nRND R12\nL Y+10\nRND R12\nL X+20"


def slot(contour=STRAIGHT, between="", call="CYCL CALL FMAX M3", unit="MM", tool=MILL, ok=True, changes=None, **given):
    """A slot of the example's numbers but for `changes`."""
    words = "\n".join(f"  {q}={value:+g}" for q, value in (EXAMPLE | (changes or {})).items())
    return run(
        f"BEGIN PGM A {unit}\nBLK FORM 0.1 Z X-20 Y-20 Z-40\nBLK FORM 0.2 X+120 Y+80 Z+0\nTOOL CALL 1 Z S3000 F300\n"
        f"L X-5 Y-5 Z+100 R0 FMAX M3\nCYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 10\n{between}"
        f"CYCL DEF 275 TROCHOIDAL SLOT\n{words}\n{call}\nL Z+100 R0 FMAX M2\nLBL 10\n{contour}\nLBL 0\nEND PGM A {unit}",
        "tnc-620", tools={1: tool}, ok=ok, **given,
    )  # fmt: skip


def rows(found, word):
    path = found.toolpath
    return path[np.array([word in path.labels[k] for k in path.label]) & path.is_motion]


def circles(path):
    """The centres of full circles in halves."""
    half = (path.kind == Kind.ARC) & np.isclose(np.abs(path.sweep), math.pi)
    pair = np.flatnonzero(half[:-1] & half[1:] & (np.abs(path.centre[1:] - path.centre[:-1]).max(axis=1) < 1e-9))
    return path.centre[pair], np.hypot(*(path.start - path.centre)[pair, :2].T), path.sweep[pair]


def test_the_example_of_the_manual():
    """rho = 11.6 / 2 - 5 = 0.8, one loop per 2 mm, levels -5 … -20, walls 1.0 beside the line, heights 2 and 50."""
    found = slot()
    rough, side = rows(found, "trochoid"), rows(found, "side finishing")
    centres, radii, sweeps = circles(rough)
    assert radii == pytest.approx(0.8) and (sweeps > 0).all()  # climb: counter-clockwise
    assert sorted(set(np.round(centres[:, 2], 9))) == [-20, -15, -10, -5]
    assert centres[centres[:, 2] == -5][:, 0] == pytest.approx(np.arange(10, 51, 2)) and centres[:, 1] == pytest.approx(10)
    assert sorted(set(np.round(side.end[:, 2], 9))) == [-20, -15, -10, -5]
    walls = side[(side.kind == Kind.LINE) & (np.abs(side.end[:, 0] - side.start[:, 0]) > 1)]
    assert sorted(set(np.round(walls.start[:, 1], 9))) == [9, 11] and set(walls.feed) == {500}
    rapid = found.toolpath[found.toolpath.kind == Kind.RAPID]
    assert {2.0, 50.0} <= set(rapid.end[:, 2]) and rapid.end[rapid.end[:, 2] < 2].size == 3 * 3  # 2 above what is cut
    slope = rows(found, "entry")
    assert set(slope.feed) == {150} and slope.end[1::2, 0] == pytest.approx(10)  # back at the begin of the contour
    drop = np.abs(slope.end - slope.start)
    assert (np.degrees(np.arctan2(drop[:, 2], drop[:, 0])) <= 10 + 1e-9).all()
    assert not found.alarms and not found.collisions()
    assert found.toolpath.end[-1].tolist() == [-5, -5, 100]  # where the tool stood before (posAfterContPocket)


@pytest.mark.parametrize("contour", [BENT, CLOSED], ids=["bent", "closed"])
@pytest.mark.parametrize("changes", [{}, {"Q351": -1, "Q369": 0.3, "Q366": 0, "Q338": 0, "Q219": 18, "Q436": 1.5}])
def test_curved_slots(contour, changes):
    """No rapid in the material, the path ends whole, and the sense is the one that is asked for."""
    found = slot(contour, changes=changes)
    assert not found.alarms and not found.collisions()
    _, radii, sweeps = circles(rows(found, "trochoid"))
    assert (np.sign(sweeps) == changes.get("Q351", 1)).all()
    rho = changes.get("Q219", 12) / 2 - 5
    floor = rows(found, "floor finishing")
    assert sorted(set(np.round(radii, 6))) == ([round(rho - 0.2, 6), rho] if len(floor) else [round(rho - 0.2, 6)])
    assert (len(floor) > 0) == ("Q369" in changes)
    if len(floor):
        assert floor.end[:, 2].min() == -20 and rows(found, "layer").end[:, 2].min() == pytest.approx(-19.7)
        assert set(floor.feed[floor.kind == Kind.ARC]) == {500}
        assert len(set(np.round(rows(found, "side finishing").end[:, 2], 9)) - {50, 2}) == 1  # Q338=0: one infeed


def test_the_part_is_the_slot():
    """A straight slot 12 wide from X10 to X50, 20 deep: 40 · 12 + 36 pi over 20."""
    gone = slot(changes={"Q369": 0.5}).workpiece()
    assert 140 * 100 * 40 - gone.volume == pytest.approx((480 + 36 * math.pi) * 20, rel=2e-3)


def test_open_slots_begin_where_their_approach_begins():
    """From 15 before the contour: X-5; walls without a round end there, so they end as they began, beside it."""
    for approach, begin in (
        ("APPR LT X+10 Y+10 LEN15 RL F100", (-5, 10)),
        ("APPR LN X+10 Y+10 LEN15 RL F100", (10, 25)),
        ("APPR CT X+10 Y+10 CCA90 R+8 RL F100", (2, 18)),
    ):
        found = slot(f"L X-30 Y+30\n{approach}\nL X+50", changes={"Q366": 0})
        down = rows(found, "layer 1 of 4, entry")
        assert down.end[0, :2] == pytest.approx(begin), approach
        side = rows(found, "side finishing, infeed 1 of 4")
        ends = side[(side.end[:, 2] == -5) & (side.start[:, 2] == -5)]
        assert ends.end[0, :2] + ends.start[-1, :2] == pytest.approx(2 * np.array(begin))
        assert not found.collisions()


def test_a_departure_is_named():
    found = slot("L X-30 Y+30\nAPPR LT X+10 Y+10 LEN15 RL F100\nL X+50\nDEP LT LEN20")
    assert [a.message for a in found.alarms] == [
        "CYCL DEF 275 DEP LT is no part of the slot, which ends where its contour ends"
    ]
    assert found.ok and circles(rows(found, "trochoid"))[0][:, 0].max() == pytest.approx(50)


def test_a_side_of_the_middle_line_is_named():
    found = slot("L X+10 Y+10 RL\nL X+50")
    assert [a.message for a in found.alarms] == [
        "CYCL DEF 275 the contour is the middle of the slot: its RL or RR has no effect"
    ]


def test_what_is_done():
    """Q215, and what Q368 and Q369 leave to be finished."""
    assert not len(rows(slot(changes={"Q215": 1, "Q369": 1}), "finishing"))
    only = slot(changes={"Q215": 2, "Q369": 1})
    assert not len(rows(only, "layer")) and len(rows(only, "side finishing")) and len(rows(only, "floor finishing"))
    assert not len(rows(slot(changes={"Q368": 0}), "finishing"))
    for width, why in ((12, "neither Q368 nor Q369 is given"), (10, "the slot is as wide as the tool")):
        nothing = slot(changes={"Q215": 2, "Q368": 0, "Q219": width})
        assert [a.message for a in nothing.alarms] == [f"CYCL DEF 275 Q215=2 finishes nothing: {why}"]
        assert not len(rows(nothing, "CYCL DEF 275"))


def test_a_slot_as_wide_as_the_tool_is_roughed_on_its_line():
    found = slot(changes={"Q219": 10})
    line = rows(found, "centre line")
    assert len(line) == 4 and line.end[:, 0] == pytest.approx(50) and not len(rows(found, "finishing"))


def test_depth_0_is_not_executed():
    found = slot(changes={"Q201": 0})
    assert [a.message for a in found.alarms] == ["CYCL DEF 275 Q201 makes a depth of 0: the cycle is not executed"]
    assert not len(rows(found, "CYCL DEF 275"))


def test_words_without_a_function_are_named():
    found = slot(changes={"Q12": 300, "Q366": 1})
    assert [a.message for a in found.alarms] == [
        "CYCL DEF 275 Q12 is not used: Q207 is the feed rate for roughing",
        "CYCL DEF 275 Q366=1 has no function: the tool goes straight down",
    ]
    assert 300 not in set(rows(found, "CYCL DEF 275").feed) and set(rows(found, "entry").feed) == {150}


def test_the_plunge_angle():
    none = slot(tool=Tool(radius=5, number=1, plunge_angle=0), ok=False)
    assert none.alarms[0].message.startswith("CYCL DEF 275 Q366 (plunging strategy) 2 needs the plunge angle (ANGLE) of tool 1")
    steep = slot(tool=Tool(radius=5, number=1, plunge_angle=90))
    assert np.ptp(rows(steep, "entry").end[:, :2], axis=0).max() == 0
    flat = slot(tool=Tool(radius=5, number=1, plunge_angle=1e-6), ok=False)
    assert "a ramp 20 long at 1e-06 degrees has more than 10000 strokes" in flat.alarms[0].message


def test_a_mirror_image_keeps_climb():
    mirrored = slot(between="CYCL DEF 8.0 M\nCYCL DEF 8.1 X\n", contour=STRAIGHT)
    assert (circles(rows(mirrored, "trochoid"))[2] > 0).all()
    assert circles(rows(mirrored, "trochoid"))[0][:, 0].min() == pytest.approx(-50)


def test_a_scale_keeps_the_tool():
    """Twice the size: 24 wide for a tool of radius 10, the circles 4 apart with a radius of 11.6 - 10."""
    found = slot(between="CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL 2\n", tool=Tool(radius=10, number=1, plunge_angle=10))
    centres, radii, _ = circles(rows(found, "trochoid"))
    assert radii == pytest.approx(1.6) and np.diff(centres[:21, 0]) == pytest.approx(4)


def test_inches():
    small = {"Q219": 0.5, "Q368": 0.01, "Q436": 0.1, "Q201": -0.5, "Q202": 0.25, "Q338": 0.25, "Q200": 0.1, "Q204": 2}
    found = slot("L X+1 Y+1\nL X+2", unit="INCH", changes=small)
    centres, radii, _ = circles(rows(found, "trochoid"))
    assert radii == pytest.approx(0.48 * 25.4 / 2 - 5) and np.diff(centres[:11, 0]) == pytest.approx(2.54)


def test_feeds_at_the_edge():
    """Of a circle of 0.8 with a tool of 5: 500 · 0.8 / 5.8; the inner wall of a bend of 10, 9 from its centre: 500 · 9 / 4."""
    found = slot(BENT, changes={"Q439": 3})
    rough = rows(found, "trochoid")
    assert set(np.round(rough.feed[np.isclose(np.abs(rough.sweep), math.pi)], 6)) == {round(500 * 0.8 / 5.8, 6)}
    side = rows(found, "side finishing")
    bend = (side.kind == Kind.ARC) & np.isclose(np.hypot(*(side.start - side.centre)[:, :2].T), 9)
    assert side.feed[bend] == pytest.approx(500 * 9 / 4)
    centre = rows(slot(BENT), "CYCL DEF 275")
    assert set(centre.feed[np.isfinite(centre.feed)]) == {500, 150}


@pytest.mark.parametrize(
    "call", ["L X+0 Y+0 FMAX M99", "CYCL CALL POS X+0 Y+0 Z+0 FMAX", "PATTERN DEF POS1 (X+0 Y+0 Z+0)\nCYCL CALL PAT FMAX"]
)
def test_calls(call):
    assert len(rows(slot(call=call), "trochoid")) == len(rows(slot(), "trochoid"))


def test_called_twice():
    assert len(rows(slot(call="CYCL CALL FMAX\nCYCL CALL FMAX"), "trochoid")) == 2 * len(rows(slot(), "trochoid"))


def test_upwards():
    """With a depth error allowed a positive depth works from below: levels 5, 10, …, and the way out leads below first."""
    found = slot(changes={"Q201": 20, "Q366": 0}, depth_error=False)
    assert sorted(set(np.round(circles(rows(found, "trochoid"))[0][:, 2], 9))) == [5, 10, 15, 20]
    lifts = rows(found, "lift")
    assert set(lifts.end[:, 2]) == {-2, 50}


def test_its_form_runs():
    found = run(trial_program(TrochoidalSlot, first_words(TrochoidalSlot)), "tnc-620")
    assert not found.alarms and len(rows(found, "trochoid"))

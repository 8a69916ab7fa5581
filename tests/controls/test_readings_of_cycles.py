"""Readings of cycles whose chapters leave something open; each cites the sentence that decides."""

import json
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup, Tool

CATALOGUE = Path(__file__).parents[1] / "authorities" / "catalogue" / "tnc620-pockets.json"


def said(found):
    assert found.ok, found.alarms
    return [(alarm.message, alarm.span.line) for alarm in found.alarms]


TAP = "T2 S500 {start}\nG0 X0 Y0 Z20\nG309 Q2 H-10 Z0 P{pitch}\nX5 M99\nX15 {between} M99\nX25 {between} M99\n"
STANDS = "G309 turns the spindle itself: the spindle stands since the thread before"


@pytest.mark.parametrize("pitch", [1.25, -1.25])
@pytest.mark.parametrize("start", ["M3", ""])
def test_g309_turns_the_spindle_itself_and_cites_the_note(pitch, start):
    """9.12: P alone says the sense; note 3: M3 or M4 before the next machining. The motion is the same with and without."""
    without = mnclab.run(TAP.format(start=start, pitch=pitch, between=""), "mnc")
    noted = mnclab.run(TAP.format(start=start, pitch=pitch, between="M3" if pitch > 0 else "M4"), "mnc")
    assert said(without) == [(STANDS, 5)] and said(noted) == []
    assert without.toolpath.motion.end.tolist() == noted.toolpath.motion.end.tolist()
    cuts = without.toolpath[without.toolpath.synchronous]
    assert np.sign(cuts.spindle).tolist() == [np.sign(pitch), -np.sign(pitch)] * 3


def test_g307_waits_at_k_and_at_the_bottom():
    """9.10, step 3 and 4: K is on the way to H, T the time of both; without K there is one dwell, without T none."""
    text = "T2 S800 M3\nG0 X0 Y0 Z20 F100\nG307 Q2 H-30 Z0 F90 T{} K{}\nX5 M99\n"
    for seconds, pause, places in ((0.5, 12, [-12, -30]), (0.5, 0, [-30]), (0, 12, [])):
        path = mnclab.run(text.format(seconds, pause), "mnc").toolpath
        waits = path[path.kind == Kind.DWELL]
        assert waits.end[:, 2].tolist() == places and (waits.time == seconds).all()
        assert path.end[:, 2].min() == -30


@pytest.mark.parametrize("height", [250, 30, 4])
def test_rough_out_goes_across_at_its_clearance_height(height):
    """8.4: Q7 is the height for positioning, where nothing can collide: first along the tool axis, from above and below."""
    contour = "LBL 1\nL X+0 Y+0 RL F100\nL X+80 Y+0\nL X+80 Y+60\nL X+0 Y+60\nL X+0 Y+0\nLBL 0\n"
    data = "CYCL DEF 20 C\nQ1=-5\nQ2=1\nQ3=0\nQ4=0\nQ5=0\nQ6=2\nQ7=30\nQ8=0\nQ9=1\n"
    rough = "CYCL DEF 22 R\nQ10=5\nQ11=100\nQ12=200\nQ18=0\nQ19=0\nQ208=FMAX\n"
    head = f"TOOL CALL 1 Z S1000\nL X-9 Y-9 Z{height:+g} FMAX M3\nCYCL DEF 14.0 C\nCYCL DEF 14.1 LBL1\n"
    text = f"{head}{data}{rough}CYCL CALL\nM2\n"
    found = mnclab.run(text + contour, "tnc-620", Setup(tools={1: Tool(radius=5)}, start=(-9, -9, height)))
    rows = found.toolpath.motion
    across = rows[(rows.kind == Kind.RAPID) & (rows.end != rows.start)[:, :2].any(axis=1)]
    assert found.ok and across.start[0].tolist() == [-9, -9, 30] and across.end[0, 2] == 30


def test_the_manual_s_own_c210_names_the_setting():
    """Block 6 has no feed, and FMAX of block 4 holds for its block alone: the alarm says what makes the program run."""
    examples = {e["code"]: e["program"] for e in json.loads(CATALOGUE.read_text(encoding="utf-8"))}
    program = next(text for code, text in examples.items() if "C210" in text)
    (alarm,) = (a for a in mnclab.run(program, "tnc-620").alarms if a.severity == "alarm")
    assert alarm.message == "no feed rate was programmed before this move" and alarm.span[:2] == (25, 1)
    assert "setting feed_needed = False" in alarm.hint
    tools = {1: Tool(radius=10, plunge_angle=3), 2: Tool(radius=3, plunge_angle=3)}
    assert mnclab.run(program, "tnc-620", Setup(tools=tools, settings={"feed_needed": False})).ok

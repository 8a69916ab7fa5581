"""What inspection cycles of the TNC 620 meet: no part within reach, a part in the way, tilted planes, DIN/ISO."""

from __future__ import annotations

import math

import numpy as np
import pytest

import mnclab as mnc
from mnclab import Probe, Setup, Tool, part
from mnclab.machine.setup import Datum

TOP = part.plane((0, 0, 0), (0, 0, 1))
BALL = 2.0
TAIL = "Q281=0 Q309=0 Q330=0"
LIMITS = "Q279=0 Q280=0 " + TAIL
WORDS = {
    420: "Q263=0 Q264=-10 Q265=0 Q266=10 Q272=1 Q267=1 Q261=-5 Q320=0 Q260=20 Q301=0 Q281=0",
    421: f"Q273=0 Q274=0 Q262=40 Q325=0 Q247=90 Q261=-5 Q320=0 Q260=20 Q301=0 Q275=0 Q276=0 {LIMITS}",
    422: f"Q273=0 Q274=0 Q262=40 Q325=0 Q247=90 Q261=-5 Q320=0 Q260=20 Q301=0 Q277=0 Q278=0 {LIMITS}",
    423: f"Q273=0 Q274=0 Q282=60 Q283=40 Q261=-5 Q320=0 Q260=20 Q301=0 Q284=0 Q285=0 Q286=0 Q287=0 {LIMITS}",
    424: f"Q273=0 Q274=0 Q282=60 Q283=40 Q261=-5 Q320=0 Q260=20 Q301=0 Q284=0 Q285=0 Q286=0 Q287=0 {LIMITS}",
    425: f"Q328=0 Q329=0 Q310=0 Q272=1 Q261=-5 Q260=20 Q311=20 Q288=0 Q289=0 {TAIL} Q320=0 Q301=0",
    426: f"Q263=-20 Q264=0 Q265=20 Q266=0 Q272=1 Q261=-5 Q320=0 Q260=20 Q311=40 Q288=0 Q289=0 {TAIL}",
    427: "Q263=0 Q264=0 Q261=0 Q320=0 Q272=3 Q267=-1 Q260=20 Q281=0 Q288=0 Q289=0 Q309=0 Q330=0",
    430: f"Q273=0 Q274=0 Q262=80 Q291=0 Q292=90 Q293=180 Q261=-5 Q260=20 Q288=0 Q289=0 {LIMITS}",
    431: "Q263=0 Q264=0 Q294=0 Q265=30 Q266=0 Q295=0 Q296=0 Q297=30 Q298=0 Q320=0 Q260=20 Q281=0",
}
SIXTY = [(-30, -20, -50), (30, 20, 0)]


def good(code):
    """A part that the cycle finds where it looks."""
    match code:
        case 420:
            return part.plane((0, 0, 0), (-1, 0, 0)) & TOP
        case 421:
            return TOP - part.hole((0, 0, 0), 40, 50)
        case 422:
            return part.cylinder((0, 0, -50), (0, 0, 0), 20)
        case 423:
            return TOP - part.pocket((0, 0, 0), 60, 40, 50)
        case 424:
            return part.box(*SIXTY)
        case 425:
            return TOP - part.pocket((0, 0, 0), 20, 300, 50)
        case 426:
            return part.box((-20, -50, -50), (20, 50, 0))
        case 430:
            return TOP - part.hole((40, 0, 0), 14, 50) - part.hole((0, 40, 0), 14, 50) - part.hole((-40, 0, 0), 14, 50)
    return TOP


def probing(code, made, words="", before="", after="", iso=False, **setup):
    given = dict(word.split("=") for word in f"{WORDS[code]} {words}".split())
    lines = "\n".join(f"{name}={value}" for name, value in given.items())
    text = f"BEGIN PGM P MM\nTOOL CALL 7 Z\n{before}L Z+80 R0 FMAX\nTCH PROBE {code} X\n{lines}\n9 {after}\nEND PGM P MM\n"
    if iso:
        values = " ".join(lines.splitlines())
        text = f"%P G71 *\nN1 T7 G17 *\nN2 G00 G40 G90 Z+80 *\nN3 G{code} {values} *\nN4 M30 *\nN9999 %P G71 *\n"
    kept = {"tools": {7: Tool(radius=BALL, length=50, kind="probe")}, "part": made, "probe": Probe(), "start": (0, 0, 130)}
    return mnc.run(text, "tnc-620", Setup(**(kept | setup)))


@pytest.mark.parametrize("code", WORDS)
def test_it_finds_what_is_there(code):
    run = probing(code, good(code))
    assert run.ok, run.alarms


#: Where nothing is within reach: the same figure, far larger or smaller.
FAR = {
    420: part.plane((40, 0, 0), (-1, 0, 0)) & TOP, 421: TOP - part.hole((0, 0, 0), 100, 50),
    422: part.cylinder((0, 0, -50), (0, 0, 0), 5), 423: TOP - part.pocket((0, 0, 0), 120, 100, 50),
    424: part.box((-10, -5, -50), (10, 5, 0)), 425: TOP - part.pocket((0, 0, 0), 90, 300, 50),
    426: part.box((-3, -50, -50), (3, 50, 0)), 427: part.plane((0, 0, -40), (0, 0, 1)),
    430: TOP - part.pocket((0, 0, 0), 150, 150, 50), 431: part.plane((0, 0, -40), (0, 0, 1)),
}  # fmt: skip


@pytest.mark.parametrize("code", FAR)
def test_nothing_within_dist(code):
    """425 begins half of Q311 = 20 before its wall: it reaches that far, and the clearance 2 more."""
    run, reach = probing(code, FAR[code], after="L X+99 FMAX"), 12 if code == 425 else 10
    (alarm,) = run.alarms
    assert alarm.message == f"touch point inaccessible: the probe did not trigger within {reach} mm"
    assert alarm.span.line == 4 and "Q180" not in run.variables and not (run.toolpath.end[:, 0] == 99).any()
    touch = run.toolpath[-1]
    assert math.dist(touch.start, touch.end) == pytest.approx(reach, abs=1e-9)


@pytest.mark.parametrize("code", WORDS)
def test_a_part_in_the_way(code):
    """A block up to Z50 over the place: positioning stops at it, below the clearance height Q260 = 20."""
    run = probing(code, good(code) | part.box((-99, -99, -60), (99, 99, 50)), start=(0, 0, 200))
    (alarm,) = run.alarms
    assert alarm.message.startswith("path obstructed: the stylus touches the part at") and alarm.span.line == 4


@pytest.mark.parametrize("code", [421, 423, 425, 430])
def test_the_stem_meets_the_edge_of_a_part(code):
    """A stem of radius 1.9 and a ledge at Z10 that sticks out over the wall: the stem is there before the ball."""
    low, high = {421: (18.2, 22), 423: (28.2, 32), 425: (4, 12), 430: (44, 52)}[code]
    made = good(code) | part.box((low, -5, 10), (high, 5, 12))
    run = probing(code, made, probe=Probe(stem=1.9, stem_length=40))
    (alarm,) = run.alarms
    assert "stem of the probe touches the part" in alarm.message


def test_a_clearance_height_within_the_part():
    """The example of the manual (16.13): Q260 = 5 lies below the third point, Z12: the probe would go through the plane."""
    normal = np.cross((30, 60, 10), (70, 15, 22))
    made = part.plane((20, 20, -10), normal * np.sign(normal[2]))
    words = "Q263=20 Q264=20 Q294=-10 Q265=50 Q266=80 Q295=0 Q296=90 Q297=35 Q298=12 Q260=5"
    run = probing(431, made, words, start=(20, 20, 200))
    assert "path obstructed" in run.alarms[0].message
    above = probing(431, made, words.replace("Q260=5", "Q260=50"), start=(20, 20, 200))
    (warning,) = above.alarms
    assert above.ok and warning.severity == "warning" and "tool axis points down" in warning.message


def test_in_a_tilted_plane():
    """A hole square to a plane that is tilted by A = 20, B = 10: results in the tilted system."""
    a, b = math.radians(20), math.radians(10)
    about_x = np.array([(1, 0, 0), (0, math.cos(a), -math.sin(a)), (0, math.sin(a), math.cos(a))])
    about_y = np.array([(math.cos(b), 0, math.sin(b)), (0, 1, 0), (-math.sin(b), 0, math.cos(b))])
    frame = np.eye(4)
    frame[:3, :3] = about_y @ about_x
    made = (TOP - part.hole((0.3, -0.2, 0), 40.5, 50)).placed(frame)
    run = probing(421, made, before="L Z+200 R0 FMAX\nPLANE SPATIAL SPA+20 SPB+10 SPC+0 STAY\n", start=(0, 0, 300))
    assert run.ok, run.alarms
    assert [run.variables[q] for q in ("Q151", "Q152", "Q153")] == pytest.approx([0.3, -0.2, 40.5], abs=1e-6)


@pytest.mark.parametrize("code", WORDS)
def test_din_iso(code):
    """G421 is TCH PROBE 421: the same path and results."""
    one, other = probing(code, good(code)), probing(code, good(code), iso=True)
    assert other.ok, other.alarms
    assert other.toolpath.motion.end == pytest.approx(one.toolpath.motion.end, abs=1e-12)
    assert dict(one.variables) == dict(other.variables)


@pytest.mark.parametrize("letter", "XY")
@pytest.mark.parametrize("code", WORDS)
def test_along_other_tool_axes(code, letter):
    """Tool axis X: reference axis Y, minor axis Z; tool axis Y: Z, X (chapter 16). The part is turned with it, results stay."""
    k = "XYZ".index(letter)
    frame, begin = np.eye(4), np.zeros(3)
    frame[:3, :3], begin[k] = np.roll(np.eye(3), k + 1, axis=0), 130
    text = f"L {letter}+80 R0 FMAX\nTCH PROBE {code} X\n" + "\n".join(WORDS[code].split())
    run = mnc.run(
        f"BEGIN PGM P MM\nTOOL CALL 7 {letter}\n{text}\nEND PGM P MM\n", "tnc-620",
        Setup(tools={7: Tool(radius=BALL, length=50, kind="probe")}, part=good(code).placed(frame), probe=Probe(),
              start=tuple(begin)),
    )  # fmt: skip
    assert run.ok, run.alarms
    upright = probing(code, good(code))
    for name, value in dict(upright.variables).items():
        assert run.variables[name] == pytest.approx(value, abs=1e-9), name
    turned = upright.toolpath.motion.end[1:] @ frame[:3, :3].T
    assert run.toolpath.motion.end[1:] == pytest.approx(turned, abs=1e-9)


def test_a_probe_that_is_not_calibrated_measures_wrong():
    """The ball is 0.01 smaller than the table says, and 0.05 beside the axis: the hole comes out 0.02 wider, its centre aside."""
    true = {7: Tool(radius=BALL - 0.01, length=50, kind="probe")}
    run = probing(421, good(421), true_tools=true, probe=Probe(true_offset=(0.05, 0)))
    assert run.ok and run.variables["Q153"] == pytest.approx(40.02, abs=1e-4)
    assert run.variables["Q151"] == pytest.approx(-0.05, abs=1e-6)


def test_the_active_system_counts():
    """With a preset at (100, 50, 20), turned by 30 degrees, the centre is that of the program."""
    turn = math.radians(30)
    x, y = 100 + 0.2 * math.cos(turn), 50 + 0.2 * math.sin(turn)
    made = part.plane((0, 0, 20), (0, 0, 1)) - part.hole((x, y, 20), 40, 50)
    run = probing(421, made, presets={1: Datum(100, 50, 20, rotation=30)}, settings={"preset": 1}, start=(100, 50, 160))
    assert run.ok and [run.variables[q] for q in ("Q151", "Q152")] == pytest.approx([0.2, 0], abs=1e-6)


def test_a_touch_goes_into_the_record_once():
    run = probing(424, good(424))
    assert [row.touches for row in run.measurements] == [(0, 1, 2, 3)] * 4 and len(run.touches) == 4
    assert [row.what for row in run.measurements] == ["X", "Y", "length", "width"]
    assert {row.cycle for row in run.measurements} == {"TCH PROBE 424"}

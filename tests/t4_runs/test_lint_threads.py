"""Threads and taps that the axes cannot follow, by v = P n along each axis and by the run-in v² / 2a; feeds of another unit.

The old lathe: rapid 5000 along X and 8000 along Z, mm/min, 500 mm/s². Every number here is worked out from that by hand.
"""

import pytest

import mnclab
from mnclab import Limits, Setup, Tool
from mnclab.workpiece.blank import cylinder

pytestmark = pytest.mark.lint

BAR = cylinder(20, -60, 0)
OLD = Limits(rapid=(5000.0, 5000.0, 8000.0), acceleration=500.0)


def warned(text, control, said, limits=OLD, **more):
    run = mnclab.run(text.replace("|", "\n") + "\n", control, Setup(limits=limits, **more))
    assert run.ok, run.alarms
    return [alarm for alarm in run.alarms if said in alarm.message]


def jnc(move, speed, start="G00 X10 Z50"):
    return f"M3|G97 S{speed} T1|{start}|{move}|G00 X40|M5"


FAST, LATE = "the thread needs", "begins with another pitch"
NC = "N8 S{speed}|N9 F20|N10 X2700~|N11 Z{z}00~|N80 G31*|N81 X2400*|N82 Z-{end}00*|N83 F40000*|N84 P92*|N85 P25"
TNC = "BEGIN PGM A MM|TOOL CALL 1 Z S{speed}|L X+10 Y+10 Z+50 R0 FMAX M3|CYCL DEF 207 {words}|CYCL CALL|END PGM A MM"
FLOATS = "Q200=2 Q201=-20 Q211=0 Q203=+0 Q204=50 Q206="
RIGID = "Q200=2 Q201=-20 Q239=+2 Q203=+0 Q204=50"


@pytest.mark.parametrize(
    ("control", "text", "line", "wanted", "limit"),
    [
        ("jnc-t01", jnc("G32 Z-20 F4", 2500), 4, "10000 mm/min along Z", "8000"),  # 4 mm * 2500
        ("jnc-t01", jnc("G32 X-50 F2.5", 2500), 4, "6250 mm/min along X", "5000"),
        ("jnc-t01", jnc("G32 X60 Z-20 F3", 2500), 4, "5357.1 mm/min along X", "5000"),  # 7500 along Z, X goes 50 of its 70
        ("nc-31", NC.format(speed=2500, z=100, end=100), 5, "10000 mm/min along Z", "8000"),
        ("nc-31", "N8 S6500|N10 X0~|N11 Z500~|N90 G33@*|N91 Z-2500*|N92 F12500", 4, "8125 mm/min along Z", "8000"),
        ("g43", "T1 M6|G0 X0 Y0|G43 H1 Z10|S5000 M3|G84 X10 Y10 Z-20 R5 F10000|G80|M30", 5, "10000 mm/min along Z", "8000"),
        ("g43", "G20|T1 M6|G0 X0 Y0|G43 H1 Z1|S4000 M3|G84 X1 Y1 Z-1 R.5 F400|G80|M30", 6, "400 in/min along Z", "315"),
        ("tnc-620", TNC.format(speed=5000, words=RIGID), 5, "10000 mm/min along Z", "8000"),
        ("tnc-620", TNC.replace("207", "206").format(speed=5000, words=FLOATS + "+9000"), 5, "9000 mm/min along Z", "8000"),
        ("mnc", "T1 S5000 M3|G0 X10 Y10 Z5|G84 X10 Z-20 R2 F9000", 3, "9000 mm/min along Z", "8000"),
        ("mnc", "T1 S2500 M3|G0 X10 Y10 Z5|G309 Q2 H-20 P4 Z0|X20 M99", 4, "10000 mm/min along Z", "8000"),
    ],
)  # fmt: skip
def test_an_axis_that_is_too_slow_for_the_thread_is_named(control, text, line, wanted, limit):
    (alarm,) = warned(text, control, FAST)
    assert wanted in alarm.message and f"goes {limit}" in alarm.message
    assert alarm.span.line == line and alarm.severity == "warning"


@pytest.mark.parametrize(
    ("control", "text"),
    [
        ("jnc-t01", jnc("G32 Z-20 F3", 2500)),  # 7500 along Z
        ("jnc-t01", jnc("G32 X-50 F2", 2500)),  # 5000 along X, and no more
        ("nc-31", NC.format(speed=1900, z=100, end=100)),
        ("g43", "T1 M6|G0 X0 Y0|G43 H1 Z10|S1000 M3|G84 X10 Y10 Z-20 R5 F2000|G80|M30"),
        ("tnc-620", TNC.format(speed=4000, words=RIGID)),
    ],
)
def test_a_thread_that_the_axes_follow_is_left_alone(control, text):
    assert not warned(text, control, FAST) and not warned(text, control, LATE)


def test_the_lead_is_told_as_f_says_it():
    """JNC-T01 8.8: the axis with the longer way goes F in a turn, 6 mm along X; along the slope it would be 6.7082."""
    (alarm,) = warned(jnc("G32 X60 Z-20 F6", 1000, "G00 X10 Z5"), "jnc-t01", FAST)
    assert "6000 mm/min along X" in alarm.message and alarm.message.endswith("its lead is never 6 mm")


def test_the_speed_that_the_spindle_has_counts():
    """S2500 on a spindle of 1500 rev/min: 6000 mm/min."""
    slow = Limits(rapid=OLD.rapid, acceleration=500.0, spindle=1500.0)
    assert not warned(jnc("G32 Z-20 F4", 2500), "jnc-t01", FAST, slow)


@pytest.mark.parametrize(
    ("speed", "z", "end", "room"),
    [
        (1800, 5, -50, "are 5 mm"),  # 120 mm/s: 120² / 1000 = 14.4 mm, and the bar begins 5 mm after the start
        (1800, 15, -50, None),
        (1200, 5, -50, "are 5 mm"),  # 80² / 1000 = 6.4 mm
        (1000, 5, -50, None),  # 66.7² / 1000 = 4.44 mm
    ],
)
def test_the_run_in_is_that_before_the_bar(speed, z, end, room):
    text = jnc(f"G32 Z{end} F4", speed, f"G00 X18 Z{z}")
    found = warned(text, "jnc-t01", LATE, stock=BAR, tools={1: Tool(kind="thread", angle=60)}, start=(40, 0, 20))
    assert [f"and there {room}" in alarm.message for alarm in found] == [True] * (room is not None)
    assert all(f"needs {(speed * 4 / 60) ** 2 / 1000:.4g} mm" in alarm.message for alarm in found)


def test_a_journal_in_front_of_the_thread_is_run_in():
    """The end of the bar is turned to 15 mm over 15 mm before: the thread at 18 mm begins at Z-15, 20 mm after its start."""
    text = "M3|G97 S500 T1|G00 X15 Z5|G94 F100|G01 Z-15|G00 X40|Z5|S1800|X18|G32 Z-50 F4|G00 X40"
    shape = Tool(kind="thread", angle=60, cutting_length=8)
    assert not warned(text, "jnc-t01", LATE, stock=BAR, tools={1: shape}, start=(40, 0, 20))


def test_a_way_too_short_for_the_lead():
    """166.7 mm/s need 166.7² / 1000 = 27.8 mm to begin and as much to end; the way has 25."""
    fast = Limits(rapid=12_000.0, acceleration=500.0)
    (alarm,) = warned(jnc("G32 Z-20 F4", 2500, "G00 X10 Z5"), "jnc-t01", LATE, fast)
    assert "needs 27.78 mm of run-in" in alarm.message and "there is none" in alarm.message


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("G96 S100 F0.1", True), ("G97 S500 F0.25", True), ("G96 S100 G95 F0.1", False), ("G97 S500 F80", False),
        ("G97 S500 F0.5", False), ("G97 S500 G93 F0.1", False),
    ],
)  # fmt: skip
def test_a_feed_a_minute_that_looks_like_one_a_turn(words, told):
    """JNC-T01 8.17 to 8.19: without G95 F counts mm/min; 0.5 mm/min at 500 rev/min is a micrometre in a turn."""
    found = warned(f"M3 T1|{words}|G00 X18 Z5|G01 Z-20|G00 X40", "jnc-t01", "the feed counts mm/min")
    assert [alarm.span.line for alarm in found] == [4] * told


CHAIN = "the lead jumps from"
OF_NC = "S500|M3|F20|X2000~*|Z500~|G32@*|Z-2000*|F20000|G32*|{}*|F{}|X6000~"


@pytest.mark.parametrize(
    ("control", "text", "line"),
    [
        ("jnc-t01", jnc("G32 Z20 F2|G32 Z-20 F4", 500), 5),  # 8.8: a pitch a move, and nothing about the next one
        ("jnc-t01", jnc("G32 Z20 F2|G32 X15 Z-20 F4", 500), 5),
        ("jnc-t01", jnc("G32 Z20 F2|G32 X12 Z-20 F2", 500), None),  # one lead along Z
        ("jnc-t01", jnc("G32 Z20 F2|G32 X60 F2", 500), None),  # the run-out, as fast
        ("jnc-t01", jnc("G32 Z20 F2|G00 X20|G32 Z-20 F4", 500), None),
        ("jnc-t01", jnc("G32 Z20 F2|G04 F1|G32 Z-20 F4", 500), None),  # it stands between them
        ("nc-31", OF_NC.format("Z-4000", 40000), 9),
        ("nc-31", OF_NC.format("Z-4000", 20000), None),
        ("nc-31", NC.format(speed=500, z=100, end=100), None),
    ],
)  # fmt: skip
def test_a_lead_that_jumps_between_threads_is_told(control, text, line):
    found = warned(text, control, CHAIN)
    assert [alarm.span.line for alarm in found] == ([line] if line else [])
    assert all("from 2 to 4 mm" in alarm.message for alarm in found)


TAP = {1: Tool(radius=3, number=1, kind="tap", pitch=1.27)}  # 20 threads an inch
MILL = "G54 G17 G90|T1 M6 S1000 M3|G0 X0 Y0 Z5|G84 X1 Y1 Z-10 R2 F{feed}|G80|M30"


@pytest.mark.parametrize(("control", "text", "fed"), [
    ("mnc", MILL.replace(" M6", "").replace("|M30", "").format(feed=1270), ""),
    ("mnc", MILL.replace(" M6", "").replace("|M30", "").format(feed=1000), "1 mm"),
    ("g43", MILL.format(feed=1270), ""),
    ("g43", MILL.format(feed=1500), "1.5 mm"),
    ("g43", MILL.replace("G54", "G54 G20").format(feed=50), ""),  # inches a minute: 0.05 in a turn
    ("g43", MILL.replace("G54", "G54 G20").format(feed=60), "0.06 in"),
    ("jnc-t01", "M3|G97 S200 T1|G00 X0 Z5|G32 Z-20 F1.27|G00 Z5", ""),
    ("jnc-t01", "M3|G97 S200 T1|G00 X0 Z5|G32 Z-20 F2|G00 Z5", "2 mm"),
])  # fmt: skip
def test_a_tap_of_another_pitch(control, text, fed):
    """Pitch = feed / speed, 1000 rev/min on the mills."""
    found = warned(text, control, "the tap of tool 1", tools=TAP)
    own = "0.05 in" if "in" in fed else "1.27 mm"
    said = [f"the tap of tool 1 has a pitch of {own} and is fed {fed} a turn"] if fed else []
    assert [alarm.message for alarm in found] == said


APART = "they do not meet in one groove"
PASS = "G00 X{x} Z5|G32 Z-20 F2|G00 X15"


@pytest.mark.parametrize(
    ("between", "told"),
    [
        ("S500", None), ("S800", "800 rev/min, the one before it at 500 rev/min"), ("G94 F100", None),
        ("M4", "500 rev/min counter-clockwise, the one before it at 500 rev/min"),
        ("S800|T2", None),  # another tool cuts another thread
    ],
)  # fmt: skip
def test_passes_of_one_thread_have_one_speed(between, told):
    """The angle of the spindle at which a pass begins is that of the one before only where the lag of the axis is the same."""
    text = f"M3|G97 S500 T1|{PASS.format(x=9.5)}|{between}|{PASS.format(x=9)}|M5"
    found = warned(text, "jnc-t01", APART)
    assert [alarm.span.line for alarm in found] == [8 + between.count("|")] * (told is not None)
    assert all(told in alarm.message and alarm.severity == "warning" for alarm in found)


@pytest.mark.parametrize(
    ("again", "told"),
    [("G00 X9 Z-25|G32 Z-40 F2", 0), ("G00 X9 Z5|G32 Z-20 F3", 0), ("G00 X9 Z6|G32 Z-20 F2", 1), ("G00 X9 Z5|G01 Z-20", 0)],
)
def test_another_thread_may_have_another_speed(again, told):
    """Behind the first one, or with another lead, or cut by no thread at all; a second start of the same one may not."""
    assert len(warned(f"M3|G97 S500 T1|G94 F100|{PASS.format(x=9)}|S800|{again}|G00 X15|M5", "jnc-t01", APART)) == told


def test_a_constant_cutting_speed_turns_each_pass_faster():
    """G96 S60: at X10 1000 * 60 / (2 pi 10) = 954.9 rev/min, at X9.5 1005.2."""
    text = f"M3|G97 S500 T1|G96 S60|{PASS.format(x=10)}|{PASS.format(x=9.5)}|M5"
    (alarm,) = warned(text, "jnc-t01", APART)
    assert "1005.2 rev/min" in alarm.message and "954.9 rev/min" in alarm.message

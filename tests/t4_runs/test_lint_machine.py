"""Speeds and feeds beyond what somebody has said that the machine can do; numbers by hand."""

import pytest

import mnclab
from mnclab import Limits, Setup, Tool

pytestmark = pytest.mark.lint

TURNS, FEEDS = "the spindle cannot turn at", "the machine cannot feed at"
MILL = Limits(rapid=(10_000.0, 10_000.0, 6_000.0), spindle=8000.0)


def warned(text, said, control="mnc", limits=MILL, **more):
    run = mnclab.run(text.replace("|", "\n") + "\n", control, Setup(limits=limits, tools={1: Tool(radius=5)}, **more))
    assert run.ok, run.alarms
    return [alarm for alarm in run.alarms if said in alarm.message]


@pytest.mark.parametrize(("control", "text", "line", "column"), [
    ("mnc", "G54|T1 S99999999 M3|G0 X0 Y0 Z5|G1 Z-1 F100", 2, 4),
    ("g43", "T1 M6|S99999999 M3|G0 X0 Y0 Z5|G1 Z-1 F100", 2, 1),
    ("jnc-t01", "T1|G97 S99999999 M3|G94 F100|G00 X40 Z20|G01 Z0", 2, 5),
    ("tnc-620", "BEGIN PGM A MM|TOOL CALL 1 Z S99999999|L X+0 Y+0 Z+5 R0 FMAX M3|L Z-1 F100|END PGM A MM", 3, 1),
])  # fmt: skip
def test_a_speed_beyond_the_spindle(control, text, line, column):
    (alarm,) = warned(text, TURNS, control)
    assert "99999999 rev/min: it goes 8000 at most" in alarm.message and alarm.severity == "warning"
    assert alarm.span[:2] == (line, column)
    assert not warned(text.replace("99999999", "8000"), TURNS, control)


@pytest.mark.parametrize(("move", "feed", "held"), [
    ("X100", 10_000, None), ("X100", 10_001, "10000"), ("Z-50", 6_000, None), ("Z-50", 6_001, "6000"),
    ("X100 Y100", 14_142, None), ("X100 Y100", 14_143, "14142.1"),  # sqrt 2 * 10000: each axis goes 1 / sqrt 2 of it
    ("X30 Z-45", 6_997, None), ("X30 Z-45", 6_998, "6997.1"),  # 50 mm down from Z5: sqrt(30² + 50²) / 50 * 6000
])  # fmt: skip
def test_a_feed_beyond_an_axis(move, feed, held):
    """Along a line each axis has its share of the feed."""
    found = warned(f"T1 S1000 M3|G0 X0 Y0 Z5|G1 {move} F{feed}", FEEDS)
    assert [alarm.span.line for alarm in found] == [3] * (held is not None)
    assert all(f"{feed} mm/min: its axes go {held} mm/min at most" in alarm.message for alarm in found)


def test_each_feed_is_counted_once():
    """Blocks under one modal feed are one mistake."""
    (alarm,) = warned("T1 S1000 M3|G0 X0 Y0 Z5|G1 X10 F20000|X20|X30|X40 F100|X50 F20000|X60", FEEDS)
    assert alarm.count == 2 and [place.line for place in alarm.places] == [3, 7]


def test_a_feed_per_revolution_counts_with_the_speed_that_the_spindle_has():
    """2 mm/rev at 8000 rev/min are 16 m/min."""
    (alarm,) = warned("T1|G97 S8000 M3|G95 F2|G00 X40 Z20|G01 Z0", FEEDS, "jnc-t01")
    assert "16000 mm/min: its axes go 6000 mm/min" in alarm.message


def test_inches_are_told_in_inches():
    (alarm,) = warned("G20|T1 M6|S900 M3|G0 X0 Y0 Z1|G1 X4 F500", FEEDS, "g43")
    assert "500 in/min: its axes go 393.7 in/min at most" in alarm.message


def test_of_a_machine_that_nobody_has_described_nothing_is_said():
    text = "T1 S99999999 M3|G0 X0 Y0 Z5|G1 X10 F999999999"
    run = mnclab.run(text.replace("|", "\n"), "mnc", Setup(tools={1: Tool(radius=5)}))
    assert not run.alarms
    assert len(mnclab.run(text.replace("|", "\n"), "mnc", Setup(tools={1: Tool(radius=5)}, limits="small-mill")).alarms) == 2


def test_a_constant_cutting_speed_is_held_on_purpose():
    assert not warned("T1|G96 S200 M3|G95 F0.1|G00 X40 Z20|G01 X0", TURNS, "jnc-t01")

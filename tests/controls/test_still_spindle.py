"""Cutting with the spindle still is told once, at the first block that does it, on every control."""

import pytest

import mnclab

pytestmark = pytest.mark.lint

SENTENCE = "the tool moves at feed while the spindle stands"
HOLE = "G83 Z-10 R2 K5 F100"
KLARTEXT = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z{speed}\n2 L X+0 FMAX{start}\n3 L X+10 R0 F100\n4 L X+20\n5 END PGM A MM\n"


def told(text, control, **setup):
    return [
        (alarm.span.line, alarm.severity)
        for alarm in mnclab.run(text, control, mnclab.Setup(**setup)).alarms
        if alarm.message == SENTENCE
    ]


@pytest.mark.parametrize(
    "control, text, line",
    [
        ("mnc", "G0 X5\nG1 X10 F100\nX20\n", 2),
        ("mnc", "G0 X5\nG2 X10 R5 F100\n", 2),
        ("mnc", "S500\nG1 X10 F100\n", 2),
        ("mnc", "M3\nG1 X10 F100\n", 2),
        ("mnc", f"{HOLE}\nX5\n", 1),
        ("mnc", "S500 M3\nG1 X10 F100 M5\nX20\n", 3),
        ("mnc", "S500 M3\nG1 X10 F100\nM5\n\nG1 X20\nM3\nX30\nM5\nX40\n", 5),
        ("g43", "G0 X5\nG1 X10 F100\n", 2),
        ("g43", "S500 M3\nG1 X10 F100 M5\nX20\n", 3),
        ("jnc-t01", "G94 F100\nG0 X5\nG1 Z-5\nX20\n", 3),
        ("tnc-620", KLARTEXT.format(speed="", start=""), 4),
        ("tnc-620", KLARTEXT.format(speed=" S500", start=""), 4),
    ],
)
def test_it_is_told_at_the_first_block(control, text, line):
    assert told(text, control) == [(line, "warning")]
    assert not told(text, control, settings={"stopped_spindle": "accept"})


@pytest.mark.parametrize(
    "control, text",
    [
        ("mnc", "G0 X5\nX10\n"),
        ("mnc", "S500 M3\nG1 X10 F100 M5\n"),
        ("mnc", f"S500 M4\n{HOLE}\nX5\nG80 M5\nG0 Z50\n"),
        ("mnc", "S500 M3\nF100\nT2\nG0 Z20\nG302 X5 Y0 Z0 H-10 Q2 D1\nM99\n"),
        ("g43", "S500 M3\nG1 X10 F100 M5\n"),
        ("jnc-t01", "G94 F100\nS500 M3\nG1 Z-5\n"),
        ("nc-31", "S500\nF20\nX4000 ~\nZ-200\n"),
        ("tnc-620", KLARTEXT.format(speed=" S500", start=" M3")),
        ("tnc-620", KLARTEXT.format(speed=" S500", start=" M13")),
    ],
)
def test_a_turning_spindle_and_rapids_are_not_remarked(control, text):
    assert not told(text, control)


def test_after_a_cycle_that_stops_the_spindle():
    """MNC 9.9: the tap of G309 ends with the spindle stopped; the next cut is remarked, the tapping is not."""
    text = "T2 S500 M3\nG0 X5 Y5 Z20\nG309 Z0 Q2 H-10 P1\nG0 X5 M99\nG1 X20 F100\n"
    assert told(text, "mnc") == [(5, "warning")]


def test_both_tiers_tell_the_same():
    text = "F100\n" + "".join(f"G1 X{k} Y{k % 7}\n" for k in range(1, 200))
    assert [told(text, "mnc", settings={"bulk": bulk}) for bulk in (True, False)] == [[(2, "warning")]] * 2


def test_a_probe_does_not_turn():
    text = "G0 X5\nG1 X10 F100\n"
    assert not told(text, "mnc", tools={0: mnclab.Tool(radius=2, kind="probe")})


def test_a_run_that_stops_before_the_cut_says_it_where_nothing_in_the_program_starts_the_spindle():
    assert told("G0 X5\nG999\nG1 X10 F100\n", "mnc") == [(3, "warning")]
    assert not told("G0 X5\nG999\nS500 M3\nG1 X10 F100\n", "mnc")


@pytest.mark.parametrize(("control", "text"), [
    ("mnc", "T1 S500 M3\nG1 X10 F100\nM2\n"), ("g43", "T1 M6\nS500 M3\nG1 X10 F100 M30\n"),
    ("tnc-620", "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S500\n2 L X+10 R0 F100 M3\n3 L X+0 R0 FMAX M30\n4 END PGM A MM\n"),
])  # fmt: skip
def test_the_end_of_a_program_stops_it(control, text):
    """ISO 6983: M02 and M30 stop the spindle after the motion of their block."""
    run = mnclab.run(text, control)
    assert run.ok and run.toolpath.spindle[run.toolpath.is_motion][-1] == 500
    assert run.toolpath.spindle[-1] == 0 and run.at(step=len(run.steps.block) - 1).state["spindle"] == "M5"

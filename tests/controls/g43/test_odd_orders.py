"""What stands in an odd order, or as only some makers mean it, is obeyed in one way and named in a warning."""

import pytest
from tools import running

HEAD = "S800 M3\nG0 X10 Y5 Z20\n"
CYCLE = "G81 X5 Y5 Z-5 R2 F100\n"


def warned(text, **settings):
    """The run, and its warnings as (line, message)."""
    run = running.run(HEAD + text, control="g43", settings=settings)
    assert run.ok, run.alarms
    return run, [(alarm.span.line, alarm.message) for alarm in run.alarms]


@pytest.mark.parametrize(
    ("between", "settings", "said"),
    [
        ("G20", {}, "a change of the unit: level R and the bottom stay where they were"),
        ("G52 Z5", {}, "the origin of Z has moved: level R and the bottom count from there, the initial level stays"),
        ("G92 Z0", {}, "the origin of Z has moved"), ("G10 L2 P1 Z-3", {}, "the origin of Z has moved"),
    ],
)  # fmt: skip
def test_a_cycle_that_goes_on_after_a_change_says_what_stays(between, settings, said):
    """Once, in the block of the next hole."""
    _, warnings = warned(f"G98 {CYCLE}{between}\nX1\nX2\nG80\n", **settings)
    assert [line for line, _ in warnings] == [5] and said in warnings[0][1]


@pytest.mark.parametrize("text", [
    f"{CYCLE}G20\nX1 Z-.2 R.1\nG80\n", f"{CYCLE}G91\nX1 L3\nG90\nX50\nG80\n", f"{CYCLE}G52 X5\nX1\nG80\n",
    f"{CYCLE}G68 X0 Y0 R90\nX1 Y2\nG80\n", f"{CYCLE}G80\nG52 Z5\nG0 Z20\n{CYCLE}",
])  # fmt: skip
def test_what_does_not_touch_the_levels_needs_no_word(text):
    assert not warned(text)[1]


def test_a_hole_after_a_rotation_names_the_axis_that_is_not_written():
    """The tip (10, 5) is (5, -10) in coordinates turned by 90 degrees: X20 alone is (20, -10), of the machine (10, 20)."""
    run, warnings = warned("G68 X0 Y0 R90\nG81 X20 Z-5 R2 F100\nG80\n")
    assert warnings == [(4, "Y is not written in the first motion after G68: the tool keeps its place there")]
    assert run.toolpath.end[-1] == pytest.approx([10, 20, 20])


def test_a_scale_of_very_few_thousandths_is_doubted():
    """P2 is 0.002 of Fanuc and 2 of Haas; who writes a point, or a thousand, is believed."""
    run, warnings = warned("G51 X0 Y0 P2\nG0 X5 Y5\n")
    assert warnings == [(3, "G51 P2 counts thousandths: the scale is 0.002")]
    assert run.toolpath.end[-1][:2] == pytest.approx([0.01, 0.01])
    for text, settings in (("P2.", {}), ("P500", {}), ("P2", {"g51_factor": "as_written"})):
        assert not warned(f"G51 X0 Y0 {text}\nG0 X5 Y5\n", **settings)[1]


def test_what_is_printed_is_named_and_nothing_else():
    run, warnings = warned("POPEN\nDPRNT[X#1[53]*Y#2[53]]\nN5 bprnt [A]\nPCLOS\nG0 X7\n")
    assert warnings == [(3 + k, f"{word} prints nothing here") for k, word in enumerate(("POPEN", "DPRNT", "BPRNT", "PCLOS"))]
    assert run.toolpath.end[-1].tolist() == [7, 5, 20]

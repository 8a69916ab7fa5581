"""Spindle, auxiliary functions, conditional moves, repetition, settings (catalogue nc-31)."""

import math

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup

START = Setup(start=(30, 0, 2))


def run_of(*frames, setup=START):
    return mnclab.run("\n".join(frames) + "\n", "nc-31", setup)


def test_s_turns_the_spindle_until_an_m_says_how():
    run = run_of("S300", "S500", "M4", "S700", "M5", "S900", "M3", "S0")
    assert not run.alarms
    assert run.toolpath.spindle[run.toolpath.kind == Kind.SPINDLE].tolist() == [300, 500, -500, -700, 0, 900, 0]


def test_the_feed_follows_the_spindle_not_its_sense():
    run = run_of("M4", "S300", "F50", "X5000", "S600", "Z0")
    assert run.toolpath.feed[run.toolpath.kind == Kind.LINE].tolist() == [150, 300]


@pytest.mark.parametrize(
    ("code", "exact", "label"),
    [
        ("G61", True, "G61"),
        ("G62", False, "G62 Stop key blocked"),
        ("G63", True, "G63 Stop key blocked"),
        ("G64", False, "G64 synchronised start"),
        ("G65", True, "G65 synchronised start"),
        ("G66", False, "G66 Stop key blocked, synchronised start"),
        ("G67", True, "G67 Stop key blocked, synchronised start"),
    ],
)
def test_conditions_are_bits(code, exact, label):
    """1 exact stop check, 2 Stop key blocked, 4 synchronised start; for the one group (catalogue, G61 to G67)."""
    run = run_of("S300", "F20", f"{code}*", "X5000*", "Z@-500", f"{code}@~*", "Z100", "X4000")
    assert not run.alarms
    path = run.toolpath.motion
    assert path.exact.tolist() == [exact, exact, False]
    assert [path.labels[k] for k in path.label] == [
        label, f"{label}, separate in single-block mode".replace(f"{code},", code), "",
    ]  # fmt: skip
    assert path.kind.tolist() == [Kind.LINE, Kind.RAPID, Kind.LINE]
    assert np.allclose(path.end, [(25, 0, -3), (25, 0, 1), (20, 0, 1)])
    assert code in str(mnclab.help(code, "nc-31"))


def test_m_of_a_conditional_move_comes_at_its_end():
    run = run_of("S300", "F20", "G61*", "M5*", "X5000", "G62*", "M0")
    assert not run.alarms
    assert run.toolpath.kind.tolist() == [Kind.SPINDLE, Kind.LINE, Kind.SPINDLE, Kind.STOP]


def test_coolant_is_outside_the_source():
    run = run_of("M8", "M9")
    assert run.ok and [(a.severity, a.span.line) for a in run.alarms] == [("warning", 1), ("warning", 2)]
    assert run.toolpath.kind.tolist() == [Kind.COOLANT] * 2


def test_repetitions_nest():
    """Frames 1 and 2 repeated twice by 3 to 5; frames 1 to 5 repeated once: 3 + 3 times there and back."""
    run = run_of(
        "N0 X5000~", "N1 Z@-100~", "N2 Z@100~", "N3 G25*", "N4 P1002*", "N5 P2", "N6 G25*", "N7 P1005", "N8 X6000~"
    )
    assert not run.alarms
    assert run.toolpath.line.tolist() == [1] + [2, 3] * 6 + [9]
    assert len(run.at(line=2, pass_=6).block.words) == 1


def test_a_range_after_the_repetition():
    """Nothing says that the frames must stand before: they are carried out, then the program goes on and meets them."""
    run = run_of("N1 G25*", "N2 P3004", "N3 X@-100~", "N4 Z@-100~")
    assert not run.alarms and run.toolpath.line.tolist() == [3, 4, 3, 4]


def test_the_feed_of_a_cycle_ends_with_it():
    run = run_of("S300", "F20", "G77*~", "X4000*", "Z-5000*", "F3000*", "P1000", "X3000")
    assert not run.alarms
    assert run.history["feed"][-2:] == [0.2, 0.2] and run.toolpath.per_rev[-1] == 0.2
    assert set(run.toolpath.per_rev[np.isfinite(run.toolpath.per_rev)]) == {0.2, 0.3}


def test_p1_may_count_on_the_radius():
    """Stock 20 on the diameter: two passes of 10 on the diameter, or one of 10 on the radius."""
    frames = ("S300", "F20", "G77*~", "X4000*", "Z-5000*", "P1000")
    for on_radius, passes in ((False, 2), (True, 1)):
        run = run_of(*frames, setup=Setup(start=(30, 0, 2), settings={"p1_on_radius": on_radius}))
        assert len({label.split(",")[0] for label in run.toolpath.labels if "pass" in label}) == passes


@pytest.mark.parametrize(("parameter", "value"), [("parameter_10", -1), ("parameter_11", "much")])
def test_machine_parameters_are_checked(parameter, value):
    with pytest.raises(mnclab.Alarm, match=rf"setting {parameter} \(.*\) must be a number from 0, got {value!r}"):
        run_of("S300", setup=Setup(settings={parameter: value}))


def test_a_machine_parameter_that_is_too_small_is_noticed_by_its_cycle():
    setup = Setup(start=(30, 0, 2), settings={"parameter_10": 0.1})
    run = run_of("S300", "F20", "G77*~", "X4000*", "Z-5000*", "P1000", setup=setup)
    message = "G77 would break the chip 103998 times: machine parameter 10 is too small"
    assert message in run.alarms[0].message and run.alarms[0].span[:2] == (3, 1)


def test_the_control_explains_itself():
    control = mnclab.controls["nc-31"]
    assert {"X", "Z", "F", "S", "P", "M", "G25", *(f"G{n}" for n in range(61, 68))} <= set(control.functions)
    assert set(control.cycles) == {*(f"G{n}" for n in (31, 33, 70, 71, 72, 73, 74, 75, 77, 78))}
    assert "G25" in control._repr_html_() and "G32" in control.functions
    assert {s.name: s.default for s in control.settings if s.name.startswith("parameter")} == {
        "parameter_6": 0, "parameter_7": 0, "parameter_8": 100, "parameter_10": 0, "parameter_11": 50,
    }  # fmt: skip
    assert "stock removed per pass" in str(mnclab.help("G77", "nc-31"))
    assert "100 × 0.01 mm" in str(mnclab.help("settings", "nc-31"))  # not one number after another
    with pytest.raises(mnclab.Alarm, match="G2: arcs stand in a chapter that the source does not have"):
        mnclab.help("G2", "nc-31")


def test_a_block_is_explained_word_by_word():
    """Each P by its place in the group; words of functions by their meaning in discretes."""
    run = run_of(
        "S300",
        "F20",
        "G31*",
        "X5800*",
        "Z-2000*",
        "F15000*",
        "P92*",
        "P46*",
        "P5",
        "G32*",
        "Z0*",
        "F9000",
        "G61*",
        "M9",
    )
    told = [run.explain(step=step).meanings for step in (2, 3, 4)]
    says = [[meaning.says for meaning in meanings if meaning.word not in "*~@"] for meanings in told]
    assert says[0][3:] == [
        "pitch, 0.0001 mm (G31)", "depth of the thread, 0.01 mm on radius (G31)",
        "depth of cut per pass, 0.01 mm on radius (G31)", "taper, 0.01 mm on diameter (G31)",
    ]  # fmt: skip
    assert "coordinate along the axis (0.01 mm)" in says[1][1] and "pitch (0.0001 mm)" in says[1][2]
    assert "auxiliary function at the end of the move" in says[2][1]
    for code, function in run.control.functions.items():
        for address in function.takes:
            assert run.control.meanings.get(f"{code} {address}") or run.control.meanings.get(address.rstrip("*"))


def test_a_groove_is_as_wide_as_the_blade_truly_is_where_the_program_has_no_tool_words():
    """A plunge from radius 20 to 18: a ring of the blade's width, 4 mm though the table says 3."""
    text = "N1 S600\nN2 F15\nN3 X4400~\nN4 Z-2000~\nN5 X3600\nN6 X4400~\n"
    table = {"tools": {1: mnclab.Tool(kind="grooving", width=3)}, "stock": mnclab.cylinder(radius=20, low=-60, high=0)}
    for width, more in ((3, {}), (4, {"true_tools": {1: mnclab.Tool(kind="grooving", width=4)}})):
        removed = mnclab.run(text, "nc-31", **table, **more).workpiece().removed
        assert removed == pytest.approx(math.pi * (20**2 - 18**2) * width, rel=1e-12)

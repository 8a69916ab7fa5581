"""Words and spellings of programs from workshops: what changes nothing, dialogs in other languages, TOOL DEF, presets.

Which functions change nothing say the HEIDENHAIN manuals of the TNC 620, the iTNC 530 and the TNC 407 to 430 (miscellaneous
functions for contouring behaviour, for rotary axes, for laser cutting).
"""

from __future__ import annotations

import math

import pytest

import mnclab as mnc
from mnclab.controls.tnc_620.language import m_functions, rotary

PATH = [(5, 0, 0), (5, 7, 0)]


def ends(run: mnc.Run) -> list[tuple[float, ...]]:
    assert run.ok, run.alarms
    return [tuple(end) for end in run.toolpath.motion.end.round(9).tolist()]


@pytest.mark.parametrize("code", [*m_functions.ENDS, "M117", "M127", "M129"])
def test_the_end_of_what_is_not_on(code: str, inside) -> None:
    """In a block of its own and beside a motion: accepted without a word."""
    for blocks in (f"2 {code}\n3 L X+5 FMAX\n4 L Y+7 FMAX", f"2 L {code}\n3 L X+5 FMAX {code}\n4 L Y+7 FMAX"):
        run = inside(blocks)
        assert ends(run) == PATH and not run.alarms


@pytest.mark.parametrize("text", [
    "M90", "M101", "M101 BT5", "M105", "M106", "M134", "M148", "M200 V3", "M201 V+2.5", "M202 FNR2", "M203 V1 TIME2",
    "M204 V1 TIME 0.5", "M11", "M17", "M601",
])  # fmt: skip
def test_what_tells_the_drives_or_the_machine_is_named_once(text: str, inside) -> None:
    run = inside(f"2 L X+5 FMAX {text}\n3 L Y+7 FMAX {text}\n4 {text}")
    (warning,) = run.alarms
    assert ends(run) == PATH and warning.severity == "warning" and warning.span.line == 3
    assert warning.message.startswith(text.split()[0] + " ")


def test_a_setting_refuses_functions_of_the_machine_tool_builder(inside) -> None:
    (alarm,) = inside("2 L X+5 FMAX M11", machine_functions="refuse").alarms
    assert (alarm.message, alarm.span[:2]) == ("M11 is not a function of this control", (3, 14))


@pytest.mark.parametrize("code", rotary.GROUPS.values())
def test_rules_for_rotary_axes_change_nothing_while_none_moves(code: str, inside) -> None:
    run = inside(f"2 L {code}\n3 L X+5 C+0 FMAX\n4 L Y+7 FMAX")
    assert ends(run) == PATH and not run.alarms
    ended = f"M{int(code[1:]) + 1}"
    assert inside(f"2 {code}\n3 {ended}\n4 L C+30 FMAX").ok
    assert not inside(f"2 {code}\n4 L C+30 FMAX").ok


@pytest.mark.parametrize(("label", "seconds"), [
    ("DWELL 1.5", 1.5), ("V.ZEIT 1.5", 1.5), ("V.ZEIT1.5", 1.5), ("V.IDO5", 5), ("CZAS ZWL.0.5", 0.5), ("T.ESPERA .5", 0.5),
    ("TEMPO+0,25", 0.25), ("V. ZEIT = 2", 2), ("5", 5), ("QUOTA5", 5), ("DWELL Q5", 3), ("TEMP. +Q5", 3), ("DWELL5.", 5),
])  # fmt: skip
def test_a_dwell_in_any_language(label: str, seconds: float, inside) -> None:
    run = inside(f"2 Q5 = 3\n3 CYCL DEF 9.0 X\n4 CYCL DEF 9.1 {label}")
    assert run.ok and run.toolpath.time[run.toolpath.kind == mnc.Kind.DWELL].tolist() == [seconds]


def test_blanks_in_the_number_of_a_sub_block(inside) -> None:
    run = inside("2 CYCL DEF9 .0 VARAKOZASI IDO\n3 CYCL DEF9.1 V.IDO5")
    assert run.ok and run.toolpath.time[-1] == 5


@pytest.mark.parametrize("word", ["ABST50", "DIST 50", "SETUP+50"])
def test_the_distance_of_cycle_19_has_many_names(word: str, inside) -> None:
    """The axis A turns by 90 degrees about a point 50 below the tip, which goes 50 back in Y and 50 down (11.9)."""
    run = inside(f"2 L Z+100 FMAX\n3 CYCL DEF 19.0 X\n4 CYCL DEF 19.1 A+90 B+0 C+0 F1000 {word}")
    assert run.ok and run.toolpath.end[-1].round(9).tolist() == [0, -50, 50]


RAPID = math.inf


@pytest.mark.parametrize(("text", "feed"), [("FMAX", RAPID), ("MAX", RAPID), (" max", RAPID), ("AUTO", 321), ("FAUTO", 321)])
def test_feeds_of_a_cycle_without_their_letter(text: str, feed: float, tnc) -> None:
    """The retraction of cycle 202 from -9 to the set-up clearance 2."""
    values = "Q200=2\nQ201=-9\nQ206=50\nQ211=0\nQ203=0\nQ204=2\nQ214=0\nQ336=0"
    run = tnc(f"1 TOOL CALL 2 Z S9 F321\n2 L Z+9 FMAX M3\n3 CYCL DEF 202 X\n{values}\nQ208= {text}\n4 CYCL CALL\n")
    assert run.ok, run.alarms
    back = [move for move in run.toolpath.motion if move.start[2] == -9]
    assert [move.end[2] for move in back][:1] == [2] and back[0].feed == feed


def test_tool_def_defines_a_tool_that_the_table_lacks(tnc) -> None:
    """Tip 80 - 10 = 70 lower than with no tool; the path is R 7 to the left of the contour."""
    setup = mnc.Setup(tools={1: mnc.Tool(radius=5)}, start=(0, 0, 80))
    run = tnc("1 TOOL DEF 9 L+10 R+7\n2 TOOL CALL 9 Z S1 F9\n3 L Y-20 FMAX M3\n4 L Y+0 RL\n5 L X+9\n6 L Y-9 R0\n", setup)
    assert run.toolpath.end[0].tolist() == [0, 0, 70] and [9, 7, 70] in run.toolpath.end.tolist() and not run.alarms


def test_the_table_counts_unless_a_setting_says_otherwise(tnc) -> None:
    text = "1 TOOL DEF 1 L+0 R+7\n2 TOOL CALL 1 Z S1 F9\n"
    for settings, radius in (({}, 5), ({"tool_def": "block"}, 7)):
        run = tnc(text, mnc.Setup(tools={1: mnc.Tool(radius=5)}, settings=settings))
        assert run.ok and run.toolpath.radius[-1] == radius
        told = [(a.severity, a.message, a.span[:2]) for a in run.alarms]
        passed_over = ("warning", "TOOL DEF 1 is passed over: the row of the tool table counts", (1, 14))
        assert told == ([] if settings else [passed_over])


def test_without_a_table_the_block_counts(tnc) -> None:
    """The magazine of a setup without tools is no table of anybody's."""
    run = tnc("1 TOOL DEF 1 L+3 R+7\n2 TOOL CALL 1 Z S1 F9\n3 TOOL DEF 0\n")
    assert run.ok and run.toolpath.radius[-1] == 7 and run.toolpath.end[-1, 2] == -3 and not run.alarms


def test_presets_are_zero_where_nobody_gave_any(inside) -> None:
    assert ends(inside("2 CYCL DEF 247 INIT. REF.PKT ~\n    Q339=+4 ;X\n3 L X+5 FMAX")) == [(5, 0, 0)]
    given = inside("2 CYCL DEF 247 X\nQ339=+4\n3 L X+5 FMAX", mnc.Setup(presets={1: (1, 2, 3)}))
    assert "names row 4, which the preset table does not have (rows: 1)" in given.alarms[0].message


def test_a_departure_may_say_r0(inside) -> None:
    """Tangent, 10 on: from (50, 5) to (60, 5); the compensation is off behind it."""
    run = inside("2 L X+0 Y-20 FMAX M3\n3 L X+10 Y+0 RL\n4 L X+50\n5 DEP LT LEN10 R0 F9\n6 L X+70")
    assert ends(run)[-2:] == [(60, 5, 0), (70, 5, 0)] and run.toolpath.side[-1] == 0


def test_the_share_of_m103_may_be_a_parameter(inside) -> None:
    """M103 FQ1 with Q1 = 20: down at a fifth of the feed, which F keeps."""
    run = inside("2 Q1 = 20\n3 L Z-5 F500 M103 FQ1\n4 L X+5", stopped_spindle="accept")
    assert run.toolpath.motion.feed.tolist() == [100, 500]

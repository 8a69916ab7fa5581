"""Presets (TNC 620, chapter 15) that are refused, each at its place, and what a refused one leaves alone."""

import re

import pytest
from controls.tnc_620.presetting import CASES, example, part_of, probing
from tools.together import together

import mnclab as mnc
from mnclab.workpiece.part import box, cylinder, hole

EXAMPLES = {case["code"]: case for case in reversed(CASES)}
NUMBERS = range(408, 420)


def case_of(number):
    return EXAMPLES[f"TCH PROBE {number}"]


def refused(number, message, at=None, part=None, before="", text=None, **setup):
    """The run of an example, which ends with one alarm at a word of it, or at its head."""
    case = case_of(number)
    text = example(case) if text is None else text
    made = part_of(case) if part is None else part
    run = probing(f"TOOL CALL 69 Z\nL Z+100 R0 FMAX\n{before}{text}\n" if before else text + "\n", made, **setup)
    assert not run.ok
    alarm = next(each for each in run.alarms if each.severity == "alarm")
    assert message in alarm.message, alarm.message
    line = run.program.text.splitlines()[alarm.span.line - 1]
    assert line.startswith(at or f"5 TCH PROBE {number}"), (line, alarm)
    assert alarm.span.column == (1 if at is None else line.index("=") + 2 if alarm.span.column > 1 else 1)
    assert {0, 10, 12, 15, 7} & run.tables.presets.keys() == set() and not run.tables.datums
    return run


BEYOND = [  # a value beyond its range or choices, by cycles that have the parameter
    *((number, "Q261", 100000, "must be at least -99999.9999 and at most 99999.9999") for number in NUMBERS if number != 417),
    *((number, "Q260", -100000, "must be at least -99999.9999 and at most 99999.9999") for number in NUMBERS),
    *((number, "Q320", -1, "must be at least 0 and at most 99999.9999") for number in NUMBERS if number != 418),
    *((number, "Q305", 10000, "must be a whole number and at least 0 and at most 9999") for number in NUMBERS),
    *((number, "Q303", 2, "must be one of") for number in NUMBERS),
    *((number, "Q381", 2, "must be one of 0, 1") for number in NUMBERS if number not in (417, 419)),
    *((number, "Q301", 2, "must be one of 0, 1") for number in (408, 410, 411, 412, 413, 414, 415)),
    *((number, "Q311", -1, "must be at least 0") for number in (408, 409)),
    *((number, "Q272", 3, "must be one of 1, 2, got 3") for number in (408, 409)),
    *((number, "Q323", -1, "must be at least 0") for number in (410, 411)),
    *((number, "Q324", -1, "must be at least 0") for number in (410, 411)),
    *((number, "Q262", -1, "must be at least 0") for number in (412, 413, 416)),
    *((number, "Q325", 361, "must be at least -360 and at most 360") for number in (412, 413)),
    *((number, "Q247", 121, "must be at least -120 and at most 120") for number in (412, 413)),
    *((number, "Q247", 4.9, "must be at least 5 or at most -5, got 4.9") for number in (412, 413)),
    *((number, "Q423", 5, "must be one of 4, 3") for number in (412, 413)),
    *((number, "Q365", 2, "must be one of 0, 1") for number in (412, 413)),
    *((number, "Q304", 2, "must be one of 0, 1") for number in (414, 415)),
    *((number, "Q326", 0, "must be greater than 0 for a line through both points") for number in (414, 415)),
    *((number, "Q327", 0, "must be greater than 0 for a line through both points") for number in (414, 415)),
    (414, "Q296", 37, "must not be that of the first point, 37: which corner it is would not be known"),
    (414, "Q297", 7, "must not be that of the first point, 7"),
    (415, "Q308", 5, "must be one of 1, 2, 3, 4, got 5"),
    (416, "Q291", 361, "must be at least -360 and at most 360"),
    *((number, "Q303", -1, "-1 does not say where row Q305 is") for number in (410, 412, 413, 414, 415, 416, 418)),
    *((number, "Q303", -1, "must be one of 0, 1, got -1") for number in (408, 409)),
]


@together("number name value message", BEYOND, lambda number, *_: f"TCH PROBE {number}")
def test_a_value_beyond_its_range(number, name, value, message):
    refused(number, message, name, text=example(case_of(number), **{name: value}))


@pytest.mark.parametrize("number", [414, 415])
def test_a_basic_rotation_has_no_place_in_the_datum_table(number):
    refused(number, "needs the preset table (Q303=1)", "Q304", text=example(case_of(number), Q304=1, Q303=0))


WITHOUT = {"Q405", "Q331", "Q332", "Q333", "Q423", "Q365"}  # which have defaults


@pytest.mark.parametrize("number", NUMBERS)
def test_every_other_parameter_must_be_there(number):
    text = example(case_of(number))
    for name in set(re.findall(r"(?m)^(Q\d+)=", text)) - WITHOUT:
        lines = "\n".join(line for line in text.splitlines() if not line.startswith(f"{name}="))
        run = refused(number, "is missing", text=lines)
        assert run.alarms[0].message.startswith(f"TCH PROBE {number} {name} ")


@pytest.mark.parametrize("number", NUMBERS)
def test_what_stands_in_its_way(number):
    """No tool call, another tool, a ball without radius, radius compensation, each transformation, no part."""
    text = example(case_of(number))
    run = mnc.run(text + "\n", "tnc-620")
    assert "needs a tool call before it, which names the probe and its axis" in run.alarms[0].message
    drill = {"tools": {69: mnc.Tool(radius=4, kind="drill")}}
    refused(number, f"TCH PROBE {number} needs a touch probe in the spindle, T69 is a drill", **drill)
    refused(number, "T69 has a ball of radius 0", tools={69: mnc.Tool(radius=0, kind="probe")})
    refused(number, "cannot run under radius compensation", before="L X+1 RL F100\n")
    for name, blocks in {
        "shift": "CYCL DEF 7.0 D\nCYCL DEF 7.1 X+5\n", "mirror": "CYCL DEF 8.0 M\nCYCL DEF 8.1 X\n",
        "rotation": "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+5\n", "scale": "CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL 0.9\n",
        "tilt": "PLANE SPATIAL SPA+10 SPB+0 SPC+0 STAY\n",
    }.items():  # fmt: skip
        refused(number, f"cannot run while a {name} is active", before=blocks)
    refused(number, "cannot run while a scale of an axis is active", before="CYCL DEF 26.0 S\nCYCL DEF 26.1 X0.9 Y1.1\n")
    run = mnc.run("TOOL CALL 6 Z\nL Z+100 R0 FMAX\n" + text + "\n", "tnc-620")
    assert "there is no part to touch" in run.alarms[0].message


@pytest.mark.parametrize("number", NUMBERS)
def test_nothing_to_touch_within_the_reach(number):
    """A part that is nowhere near: the first touch ends after DIST."""
    far = box((900, 900, -900), (901, 901, -899))
    run = refused(number, "touch point inaccessible: the probe did not trigger within 10 mm", part=far)
    touch = run.toolpath[-1]
    assert ((touch.end - touch.start) ** 2).sum() == pytest.approx(100, abs=1e-9) and not run.touches


@pytest.mark.parametrize("number", NUMBERS)
def test_a_part_in_the_way(number):
    """Material where the probe goes down: it stops on it, whose surface is at Z 60."""
    high = box((-200, -200, -50), (300, 300, 60))
    run = refused(number, "path obstructed: the stylus touches the part", part=high)
    assert run.toolpath.end[-1][2] == pytest.approx(60, abs=1e-5)


def test_a_figure_that_is_too_small():
    """A hole of the ball's diameter less 0.2; in one of that diameter the ball touches where it stands."""
    hole_there = box((-60, -60, -30), (220, 220, 0)) - hole((50, 50, 0), 3.8, 20)
    small = {"Q262": 3.8, "Q260": 20}
    refused(412, "path obstructed", part=hole_there, text=example(case_of(412), **small))
    tight = box((-60, -60, -30), (220, 220, 0)) - hole((50, 50, 0), 4, 20)
    run = probing(example(case_of(412), Q262=4) + "\n", tight)
    assert run.ok and run.measured["diameter"] == pytest.approx(4, abs=1e-5)


def test_a_stem_that_is_too_thick():
    """The stem, 5 mm thick, touches a step at Z -1 before the ball, 2 mm thick, touches the stud below."""
    stud = cylinder((50, 50, -30), (50, 50, -1), 37.5)
    cap = cylinder((50, 50, -1), (50, 50, 1), 39.5)
    probe = mnc.Probe(clearance=2, reach=10, stem=1.8, stem_length=30)
    refused(413, "the stem of the probe touches the part before the ball does", part=stud | cap, probe=probe)


def test_lines_that_do_not_cross():
    """Both sides of a thin wedge touched as if they were a corner; three holes on a line; four whose lines are parallel."""
    places = dict(Q268=0, Q269=0, Q270=0, Q271=20, Q316=50, Q317=0, Q318=50, Q319=20)
    refused(418, "the lines do not cross", text=example(case_of(418), **places))
    part = box((-60, -60, -30), (220, 220, 0.03))
    for angle in (0, 180):
        x = 50 + 45 * (1 if angle == 0 else -1)
        part = part - hole((x, 50, 0.03), 12, 20)
    twice = example(case_of(416), Q291=0, Q292=180, Q293=0)
    refused(416, "TCH PROBE 416: the points lie on one line, or are too few different ones", part=part, text=twice)


def test_a_clearance_height_below_the_measuring_height():
    """A warning (example 15.15 as it is printed), and then the collision that it warns of."""
    case = next(case for case in CASES if case["code"] == "example 15.15")
    run = probing(case["printed"].replace("POBE", "PROBE"), part_of(case), 4)
    said = {alarm.severity: alarm.message for alarm in run.alarms}
    assert len(run.alarms) == 2 and "path obstructed" in said["alarm"]
    assert said["warning"] == "TCH PROBE 416 has a clearance height below the measuring height"


def test_upwards_it_would_come_through_the_part():
    part = box((-50, -50, 25), (90, 90, 40))
    refused(419, "path obstructed", part=part, text=example(case_of(419), Q272=3, Q267=1, Q261=25))

"""What KinematicsOpt refuses, each at its place: values, the machine, the sphere, and the table of saved kinematics."""

import re
from dataclasses import replace

import pytest
from controls.tnc_620.spheres import SPHERE, TOOL, cycle, definition, measured, sphere_setup
from tools.together import together

import mnclab as mnc
from mnclab import Alarm, Axis, Kinematics
from mnclab.path.machines import kinematics_of

TABLE = kinematics_of("table-ac")
BOTH = {"A": (-60, 60, 30, 3), "C": (90, 270, 45, 3)}
TILT, COUNT = "must be at least -359.999 and at most 359.999", "must be a whole number and at least 0 and at most 12"
HEIGHT = "must be at least 0 and at most 99999.9999"

#: Cycle, other words, positions, settings; the address in the alarm and what it says.
VALUES = [
    *((n, {"Q407": 0}, BOTH, {}, "Q407", "must be at least 0.0001 and at most 99.9999, got 0") for n in (451, 452)),
    *((n, {"Q320": -1}, BOTH, {}, "Q320", HEIGHT) for n in (451, 452)),
    *((n, {"Q408": -1}, BOTH, {}, "Q408", HEIGHT) for n in (451, 452)),
    *((n, {"Q253": 0}, BOTH, {}, "Q253", "must be at least 0.0001") for n in (451, 452)),
    *((n, {"Q380": -1}, BOTH, {}, "Q380", "must be at least 0 and at most 360, got -1") for n in (451, 452)),
    *((n, {f"Q{q}": 360}, {}, {}, f"Q{q}", TILT) for n in (451, 452) for q in (411, 412, 413, 415, 416, 417, 419, 420, 421)),
    *((n, {f"Q{q}": 13}, {}, {}, f"Q{q}", COUNT) for n in (451, 452) for q in (414, 418, 422)),
    *((n, {"Q414": 1.5}, {}, {}, "Q414", COUNT) for n in (451, 452)),
    *((n, {"Q423": 2}, BOTH, {}, "Q423", "must be a whole number and at least 3 and at most 8") for n in (451, 452)),
    *((n, {"Q432": 3.1}, BOTH, {}, "Q432", "must be at least -3 and at most 3, got 3.1") for n in (451, 452)),
    (451, {"Q406": 4}, BOTH, {}, "Q406", "must be one of 0, 1, 2, 3, got 4"),
    (451, {"Q431": 4}, BOTH, {}, "Q431", "must be one of 0, 1, 2, 3, got 4"),
    (451, {}, {"A": (-130, 60, 0, 3)}, {}, "Q411", "leads to -130: the axis goes from -120 to 120"),
    (451, {}, {"A": (-60, 121, 0, 3)}, {}, "Q412", "leads to 121: the axis goes from -120 to 120"),
    (451, {"Q432": 1}, {"A": (-60, 119.5, 0, 3)}, {}, "Q412", "goes from -120 to 120, and the backlash needs 1"),
    (451, {}, {"A": (-60, 60, -125, 3), "C": (90, 270, 0, 3)}, {}, "Q413", "leads to -125: the axis goes from -120 to 120"),
    *((n, {}, BOTH, {"hirth_c": 1}, "Q408", "must be greater than 0 for the axis C with a Hirth coupling") for n in (451, 452)),
    (451, {}, BOTH, {"software_option_2": False}, "Q408", "must be greater than 0 without the software option 2"),
    *((451, {"Q406": mode}, BOTH, {"kinematics_comp": False}, "Q406", f"{mode} needs the software option KinematicsComp")
      for mode in (2, 3)),
    (451, {"Q406": 3}, {"C": (90, 270, 0, 3)}, {}, "Q406", "3 needs two axes that are measured, one upon the other"),
]  # fmt: skip


@together("number words positions settings address says", VALUES, lambda number, *_: f"{number}",
          lambda number, words, positions, settings, address, says: f"{address} {says}"[:40])
def test_a_value_is_refused_at_its_word(number, words, positions, settings, address, says):
    text = cycle(number, positions, **words)
    run = measured(text, sphere_setup(TABLE, settings=settings), ok=False)
    alarm = run.alarms[0]
    assert alarm.message.startswith(f"TCH PROBE {number} {address} (") and says in alarm.message
    lines = text.splitlines()
    assert (alarm.span.line, alarm.span.column) == (2 + next(k for k, line in enumerate(lines) if line.startswith(address)), 1)
    assert not run.touches and not run.toolpath.is_motion.any()


#: What stands before the cycle, the setup, what the alarm of the block says.
MACHINES = [
    ("", {"kinematics": None}, "needs the kinematics of the machine: Setup(kinematics=…)"),
    ("", {"settings": {"kinematics_opt": False}}, "needs the software option KinematicsOpt"),
    ("TOOL CALL 5 X\n", {}, "the tool must lie along Z on a machine with rotary axes"),
    ("L C+10 FMAX\n", {"settings": {"m_strobe_rot_ax_pos": 120}}, "needs all rotary axes at 0: an M function positions them"),
    ("CYCL DEF 7.0 D\nCYCL DEF 7.1 X+5\n", {}, "cannot run while a shift is active"),
    ("CYCL DEF 7.0 D\nCYCL DEF 7.1 A+5\n", {}, "cannot run while a rotary axis is shifted or mirrored"),
    ("CYCL DEF 8.0 M\nCYCL DEF 8.1 X\n", {}, "cannot run while a mirror is active"),
    ("CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+5\n", {}, "cannot run while a rotation is active"),
    ("CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL 0.5\n", {}, "cannot run while a scale is active"),
    ("CYCL DEF 26.0 S\nCYCL DEF 26.1 X 0.5 Y 0.5\n", {}, "cannot run while a scale of an axis is active"),
    ("", {"tools": {TOOL: mnc.Tool(kind="probe", length=100)}}, "needs a touch probe in the spindle, T5 has a ball of radius 0"),
    ("", {"tools": {TOOL: mnc.Tool(kind="mill", radius=2)}}, "needs a touch probe in the spindle, T5 is a mill"),
    ("", {"part": None}, "there is no part to touch"),
    ("", {"part": mnc.part.ball((SPHERE[0] + 30, 0, 50), 12.5)}, "touch point inaccessible"),
]


@pytest.mark.parametrize("number", [451, 452])
@pytest.mark.parametrize(("before", "setup", "says"), MACHINES)
def test_a_machine_is_refused_at_the_block(before, setup, says, number):
    run = measured(f"TOOL CALL 5 Z\n{before}{cycle(number, BOTH)}", sphere_setup(**{"kinematics": TABLE} | setup), ok=False)
    alarm = next(alarm for alarm in run.alarms if alarm.severity == "alarm")
    assert says in alarm.message
    line = 2 if before.startswith("TOOL") else 2 + before.count("\n")
    assert (alarm.span.line, alarm.span.column) == (line, 1)


def test_a_sphere_that_swings_into_the_way_is_met():
    """A retraction height that is too low: the probe leaves the sphere downwards, which A-90 has swung up."""
    run = measured(cycle(451, {"A": (-90, 90, 0, 3)}, Q408=30), sphere_setup(TABLE, at=(0.0, 150.0, 50.0)), ok=False)
    assert "path obstructed" in run.alarms[-1].message and len(run.touches) == 10


def test_true_kinematics_has_the_axes_of_the_kinematics():
    for given in ({"kinematics": TABLE, "true_kinematics": Kinematics(table=(Axis("C"),))}, {"true_kinematics": TABLE}):
        with pytest.raises(Alarm, match="true_kinematics has the axes"):
            mnc.run("L X+0 FMAX\n", "tnc-620", mnc.Setup(**given))


# Cycle 450.

SPOILT = [
    ("", "it has no row: delete it"),
    ("what = \n", "Invalid value"),
    ("[A]\ntable = 5\n", "table"),
    ('["A"]\ntable = [{ name = "D" }]\n', "D"),
    ('["A"]\nwhere = 5\n', "where"),
    ("A = 5\n", "A"),
]


@pytest.mark.parametrize(("text", "says"), SPOILT)
def test_a_spoilt_table_is_refused(text, says):
    run = measured(definition(450, Q410=2, Q409=1), sphere_setup(TABLE, files={"DATA450.KD": text}), ok=False)
    assert run.alarms[0].message.startswith("TCH PROBE 450 cannot use DATA450.KD: ") and says in run.alarms[0].message
    assert run.alarms[0].span[:2] == (2, 1)


NAMES = [
    (0, "Q409=100000", "must be a whole number from 0 to 99999, got 100000"),
    (0, "Q409=-1", "must be a whole number from 0 to 99999, got -1"),
    (0, "Q409=1.5", "must be a whole number from 0 to 99999, got 1.5"),
    (0, 'QS409="ABCDEFGHIJKLMNOPQ"', "must be a text of 1 to 16 characters, got 17"),
    (0, 'QS409=""', "must be a text of 1 to 16 characters, got 0"),
    (0, 'QS409="HEAD?"', "must be the name of one record"),
    (1, "Q409=7", "7 matches no record (there are: none)"),
    (3, 'QS409="*"', "* matches no record (there are: none)"),
]


@pytest.mark.parametrize(("mode", "name", "says"), NAMES)
def test_a_name_is_refused(mode, name, says):
    run = measured(f"TCH PROBE 450 X\nQ410={mode}\n{name}\n", sphere_setup(TABLE), ok=False)
    assert says in run.alarms[0].message and run.alarms[0].span[:2] == (4, 1)


def test_a_mode_is_refused():
    run = measured(definition(450, Q410=4, Q409=1), sphere_setup(TABLE), ok=False)
    assert "Q410 (mode) must be one of 0, 1, 2, 3, got 4" in run.alarms[0].message and run.alarms[0].span[:2] == (3, 1)


def test_a_machine_without_rotary_axes_has_nothing_to_save():
    run = measured(definition(450, Q410=0, Q409=1), sphere_setup(None), ok=False)
    assert "needs the kinematics of the machine" in run.alarms[0].message


def test_other_kinematics_are_not_restored():
    saved = measured(definition(450, Q410=0, Q409=1), sphere_setup(TABLE)).files["DATA450.KD"]
    for other in (kinematics_of("head-bc"), replace(TABLE, title="another")):
        run = measured(definition(450, Q410=1, Q409=1), sphere_setup(other, files={"DATA450.KD": saved}), ok=False)
        assert "1 was saved of other kinematics than are active" in run.alarms[0].message


@pytest.mark.parametrize("wrong", [{"backlash": -1}, {"backlash": 181}, {"backlash": "much"}])
def test_a_backlash_that_cannot_be(wrong):
    with pytest.raises(Alarm, match="backlash of axis A"):
        Axis("A", **wrong)


@pytest.mark.parametrize("wrong", [(1, 2), (1, 2, "x"), 5, (1, 2, float("nan"))])
def test_a_shift_that_cannot_be(wrong):
    with pytest.raises(Alarm, match=re.escape("shift of a kinematics")):
        Kinematics(table=(Axis("C"),), shift=wrong)

"""The front door takes what it is made for; anything else is a sentence that says what that is."""

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Alarm, Limits, Setup
from mnclab.machine.setup_file import load

pytest.importorskip("ipywidgets")
WRONG = [5, None, b"G0 X5\n", 1.5, [1], {}, ("mnc",), object(), True]

PROGRAM = "G0 X5\nG1 X9 F100\n"


@pytest.mark.parametrize("wrong", WRONG, ids=lambda value: type(value).__name__)
def test_a_wrong_type_is_an_alarm(run, wrong):
    doors = [
        lambda: mnclab.run(wrong, "mnc"),
        lambda: mnclab.run(run, "mnc"),
        lambda: mnclab.read(wrong, "mnc"),
        lambda: mnclab.modern(wrong),
        lambda: mnclab.help(wrong, "mnc"),
        lambda: mnclab.help("G83", wrong),
        lambda: mnclab.form(wrong, "mnc"),
        lambda: mnclab.form("G83", wrong),
        lambda: mnclab.panel(wrong, "mnc"),
        lambda: mnclab.editor(wrong),
        lambda: mnclab.diff(wrong, run),
        lambda: mnclab.diff(run, wrong),
        lambda: run.save(wrong),
        lambda: run.report(wrong),
    ]
    if wrong is not None:
        doors += [
            lambda: mnclab.run("G0 X5\n", wrong),
            lambda: mnclab.run("G0 X5\n", "mnc", wrong),
            lambda: run.profile(wrong),
            lambda: run.player(wrong),
        ]
    if not isinstance(wrong, int | float):
        doors += [
            lambda: mnclab.panel("G0 X{x}\n", "mnc", x=wrong),
            lambda: run.profile(override=wrong),
            lambda: run.player(speed=wrong),
            lambda: run.player(height=wrong),
        ]
    for door in doors:
        with pytest.raises(Alarm) as caught:
            door()
        assert len(caught.value.message) < 300


LONG = "é" * 5000
DOORS = {
    "a text for a line": lambda run: run.at("5"),
    "nothing for a pass": lambda run: run.at(1, None),
    "a dict for a line": lambda run: run.at({}),
    "an array for a pass": lambda run: run.at(1, np.zeros(3)),
    "half a line": lambda run: run.at(1.5),
    "an endless step": lambda run: run.at(step=10**400),
    "a text for a program": lambda run: run.at(1, program="0"),
    "a text to explain": lambda run: run.explain("5"),
    "a long name for limits": lambda run: run.profile(LONG),
    "a long name for a player": lambda run: run.player(LONG),
    "a long name for an editor": lambda run: mnclab.editor(LONG),
    "a folder that is a file": lambda run: mnclab.editor(f"{__file__}/a.mnc"),
    "a long sum": lambda run: run.when("x+" * 20_000 + "x>1"),
    "a sum of some length": lambda run: run.when("x+" * 250 + "x>1"),
    "a long product": lambda run: run.when("x>" + "1*" * 20_000 + "1"),
    "a number for a title": lambda run: run.report("r.html", title=5),
    "an array for a corner": lambda run: Limits(corner_speed=np.array([1])),
    "an array for rapids": lambda run: Limits(rapid_motion=np.array([1, 2])),
    "arrays of axes": lambda run: Setup(kinematics=np.array([1, 2])),
    "no kinematics": lambda run: Setup(kinematics=False),
    "an array of tools": lambda run: Setup(true_tools=np.array([1, 2])),
    "a number for a place": lambda run: Setup(start=np.array(5)),
    "nothing for a file": lambda run: load(None),
    "a name without a letter": lambda run: load(""),
}


@pytest.mark.parametrize("door", DOORS)
def test_what_a_door_is_not_made_for_is_an_alarm(run, door, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(Alarm) as caught:
        DOORS[door](run)
    assert len(caught.value.message) < 400 and not list(tmp_path.iterdir())


def test_whole_numbers_of_every_kind_name_a_line(run):
    assert run.at(2).line == run.at(np.int64(2)).line == run.at(2.0).line == run.at(step=np.uint8(1)).line == 2


def test_a_condition_may_have_some_operators(run):
    assert len(run.when("0*x+" * 99 + "x > 6")) == 1


def test_one_thing_is_one():
    run = mnclab.run("G0 X1\n", "mnc")
    assert ": 1 block, 1 move, " in repr(run) and "1 block, 0 alarms" in repr(run.program)
    assert "1 row, 1 move, " in repr(run.toolpath) and "1 move, " in repr(run.player())


@pytest.mark.parametrize("notebook", ["help", "settings", "control", "controls", "explain", "program"])
def test_words_of_a_table_stand_to_the_left(notebook):
    """Notebooks set every cell to the right that does not say otherwise."""
    run = mnclab.run("G90 G54\nG1 X1 F100\n", "mnc")
    shown = {
        "help": lambda: mnclab.help("G83", "mnc"),
        "settings": lambda: mnclab.help("settings", "mnc"),
        "control": lambda: mnclab.help("mnc"),
        "controls": lambda: mnclab.controls,
        "explain": lambda: run.explain(line=2),
        "program": lambda: run.program,
    }[notebook]()._repr_html_()
    cells = re.findall(r'<td style="text-align:(left|right)">(.*?)</td>', shown)
    assert len(cells) == shown.count("<td") > 4
    for side, text in cells:
        assert side == "left" or re.fullmatch(r"-?[0-9.]+", text), text


@pytest.mark.parametrize(
    "number", [(1, 2), (1, 5, 2), (1, 2, 3, 4), float("nan"), (1, 0, float("inf")), "5", True, [1, 0, 2]]
)
def test_a_number_of_a_panel_has_a_value_and_limits(number):
    with pytest.raises(Alarm, match="x "):
        mnclab.panel("G0 X{x}\n", "mnc", x=number)


ANYTHING = st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=9), st.binary(max_size=9),
                     st.lists(st.integers(), max_size=3), st.just(Path("no-such-file")), st.just(Setup()))  # fmt: skip


@given(source=ANYTHING, control=ANYTHING, setup=ANYTHING)
def test_run_and_help_of_anything_give_a_result_or_an_alarm(source, control, setup):
    for door in (lambda: mnclab.run(source, control, setup), lambda: mnclab.help(source, control)):
        try:
            assert str(door()) is not None
        except Alarm as alarm:
            assert alarm.message

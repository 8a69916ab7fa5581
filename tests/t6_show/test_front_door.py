"""The front door takes what it is made for; anything else is a sentence that says what that is."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Alarm, Setup

pytest.importorskip("ipywidgets")
WRONG = [5, None, b"G0 X5\n", 1.5, [1], {}, ("mnc",), object(), True]


@pytest.fixture(scope="module")
def run():
    return mnclab.run("G0 X5\nG1 X9 F100\n", "mnc")


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

"""The card of a run tells what went and what collided; it stays quick, and says when it did not look."""

import pytest

import mnclab
from mnclab import Setup, Tool
from mnclab.runs import card
from mnclab.runs.card import MOST as CARD
from mnclab.runs.material import KEPT
from mnclab.workpiece.removal import volume

BLANK = ((0, 0, -20), (60, 40, 0))
TOOLS = {1: Tool(radius=5, kind="mill")}
SLOT = "T1 M6\nS1000 M3\nG43 G0 X-10 Y20 Z5\nG0 Z-4\nG1 X70 F300\nG0 Z50\n"  # 60 x 10 x 4 mm³ in 16 s, 10 x 4 x 300 a minute
CRASH = SLOT.replace("G1 X70 F300", "G0 X30\nG1 X70 F300")


def run(text, **setup):
    return mnclab.run(text, "g43", Setup(tools=TOOLS, **setup))


def test_the_card_tells_what_was_removed_and_how_fast():
    card = run(SLOT, stock=BLANK)._repr_html_()
    assert "removed: 2.4 cm³; removal rate: 9 cm³/min, at most 12 cm³/min in line 5; no collisions" in card
    assert "collision</span>" not in card


def test_the_card_shows_collisions_in_red():
    card = run(CRASH, stock=BLANK)._repr_html_()
    assert card.count('<span style="color:#b3261e;font-weight:600">collision</span> program:5: rapid motion in material') == 1
    assert "no collisions" not in card


def test_without_a_blank_the_card_says_nothing_of_it():
    card = run(SLOT)._repr_html_()
    assert "removed" not in card and "collision" not in card


def test_a_long_program_is_not_worked_out():
    text = SLOT.replace("G1 X70 F300", "F300\n" + "G1 X20\nG1 X30\n" * (CARD // 2))
    long = run(text, stock=BLANK)
    told = long._repr_html_()
    assert "removed: not worked out for 1003 moves: see run.workpiece(), run.collisions()" in told
    assert long.made == {}
    assert long.outcome().collisions == ()


@pytest.mark.parametrize("effort", [0, 500, 5000, 50_000])
def test_a_part_that_is_much_work_is_not_waited_for(effort, monkeypatch):
    """Wherever it is broken off, nothing half done is kept: asked for, the part is what it is."""
    usual, first = run(CRASH, stock=BLANK), run(CRASH, stock=BLANK)
    monkeypatch.setattr(card, "EFFORT", effort)
    told = first._repr_html_()
    assert "removed: not worked out, which would take long: see run.removal(), run.collisions()" in told
    assert repr(first.removal()) == repr(usual.removal()) and first.collisions() == usual.collisions()
    assert first.removal().volume == pytest.approx(2400, rel=1e-3)


def test_the_parts_of_a_run_are_kept():
    cut = run(SLOT, stock=BLANK)
    assert cut.workpiece() is cut.workpiece() and cut.collisions() is cut.collisions()
    assert cut.workpiece(row=-1) is cut.workpiece(row=len(cut.toolpath) - 1) is not cut.workpiece(row=0)
    assert cut.workpiece(stock=BLANK) is not cut.workpiece(stock=BLANK)
    for step in range(2, KEPT + 4):
        cut.workpiece(step=step)
    assert len(cut.made) == KEPT and cut.workpiece(step=step) is cut.workpiece(step=step)


@pytest.mark.parametrize(
    "value, text",
    [(0.1234, "0.123 mm³"), (999.4, "999 mm³"), (1234.5, "1.23 cm³"), (45678, "45.7 cm³"), (1234567, "1235 cm³")],
)
def test_volumes_have_three_figures(value, text):
    assert volume(value) == text


def test_a_volume_is_said_in_the_unit_of_one_like_it():
    assert volume(644, like=49_600) == "0.644 cm³"


@pytest.mark.parametrize("step", [0, -1, [1], "1"])
def test_a_step_that_is_none(step):
    for ask in (run(SLOT, stock=BLANK).workpiece, run(SLOT, stock=BLANK).collisions):
        with pytest.raises(mnclab.Alarm, match="the step of a workpiece"):
            ask(step=step)

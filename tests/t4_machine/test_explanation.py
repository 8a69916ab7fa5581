"""A block in plain words; the way from the program to the tool in closed form."""

import math
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab.machine.explanation import _meaning
from mnclab.text.program import Word, place_of

SETUP = mnclab.Setup(datums={1: (100, 200, -50)}, tools={1: mnclab.Tool(radius=5, length=80)}, start=(100, 200, 200))
PROGRAM = """G90 G54 T1
G0 X0 Y0 Z10 S100 M3
G39 X5 Y5 A30
G1 X10 Z-10 F100
G38
G41 X20 Y20
X30 Y20
G40 X40 Y0
G83 X20 Y10 Z-30 R2 K5 F120
X30
"""


@pytest.fixture(scope="module")
def run():
    return mnclab.run(PROGRAM, "mnc", SETUP)


def test_each_word_has_its_function_its_section_and_what_it_changed(run):
    words = {m.word: m for m in run.explain(line=2).meanings}
    assert list(words) == ["G0", "X0", "Y0", "Z10", "S100", "M3"]
    assert (words["G0"].says, words["G0"].source) == ("Rapid positioning", "3.1")
    assert words["X0"].says == "coordinate X of G0 (Rapid positioning)"
    assert words["S100"].changed == "speed: none -> 100" and words["M3"].changed == "spindle: M5 -> M3"


def test_what_is_active_from_before_is_said(run):
    first = run.explain(line=7).meanings[0]
    assert (first.word, first.says) == ("(G1)", "Linear interpolation, active from before")
    cycle, position = run.explain(line=10).meanings
    assert cycle.says == "cycle: Deep-hole drilling, active from before" and position.code == "G83"


def test_parameters_of_a_cycle_have_their_meaning_and_unit(run):
    words = {m.word: m.says for m in run.explain(line=9).meanings}
    assert words["K5"] == "depth of one peck, mm (G83)"
    assert words["G83"] == "cycle: Deep-hole drilling"


def test_the_chain_turns_shifts_and_compensates(run):
    stages = {stage.name: stage for stage in run.explain(line=4).stages}
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
    turned = (5 + 5 * c + 5 * s, 5 + 5 * s - 5 * c, -10)  # (10, 0) about (5, 5): 5 to the right, 5 below
    assert stages["after rotation"].point == pytest.approx(turned) and stages["after rotation"].note == "turn by 30°"
    assert stages["after datum"].point == pytest.approx(np.add(turned, (100, 200, -50)))
    assert stages["tool tip"].point == pytest.approx(turned)
    spindle = stages["spindle, machine coordinates"]
    assert spindle.point == pytest.approx(np.add(turned, (100, 200, -50 + 80)))
    tip = {stage.name: stage for stage in run.explain(line=7).stages}["tool tip"]
    assert tip.point == pytest.approx((30, 25, -10)) and tip.note == "tool radius 5 to the left: 5 mm away"


def test_loops_expressions_and_changes_of_variables():
    text = "BEGIN PGM A MM\nFN 0: Q5 = +1\nLBL 1\nFN 1: Q5 = +Q5 + +1\nL IX+Q5 FMAX\nCALL LBL 1 REP 2\nEND PGM A MM\n"
    run = mnclab.run(text, "tnc-620")
    second = run.explain(line=4, pass_=2)
    assert second.title == "line 4 (execution 2): FN 1: Q5 = +Q5 + +1"
    assert second.changed == [("Q5", "2", "3")]
    assert "= 3" in {m.word: m.says for m in second.meanings}["+Q5 + +1"]


def test_a_refused_block_shows_its_alarm():
    run = mnclab.run("G90\nG1 X5 Q7 F100\n", "mnc")
    explanation = run.explain(line=2)
    assert "alarm: " in str(explanation) and all("refused" in m.says for m in explanation.meanings)
    assert 'role="alert"' in explanation._repr_html_()


ROOT = Path(__file__).parent.parent.parent


@pytest.mark.parametrize("file", sorted((ROOT / "data" / "programs").rglob("*.*")), ids=lambda file: file.name)
def test_every_block_of_the_samples_can_be_explained(file):
    run = mnclab.run(file)
    for step in range(min(len(run.steps.block), 60)):
        explanation = run.explain(step=step)
        written = [str(word) for word in explanation.moment.block.words]
        said = [m.word for m in explanation.meanings]
        assert [word for word in written if word not in said] == []
        assert explanation._repr_html_()
        row = explanation.moment.rows.stop - 1
        if row >= 0:
            tip = next(stage for stage in explanation.stages if stage.name == "tool tip")
            assert tip.point == pytest.approx(run.toolpath.end[row])


def test_every_word_that_a_function_takes_says_what_it_is():
    unknown = []
    for control in mnclab.controls.values():
        for function in control.functions.values():
            for address in (taken.rstrip("*") for taken in function.takes):
                word = Word(address, 1.0, int(place_of(1, 1, 1)))
                if _meaning(control, function, word).startswith(("word ", "part")):
                    if _meaning(control, function, word) != "part of a circle":  # of a pattern
                        unknown.append((control.name, function.code, address))
    assert unknown == []


def test_a_block_of_a_called_program_is_explained():
    main = "BEGIN PGM A MM\nTOOL CALL 1 Z S100\nL X+5 A+30 C-90 FMAX\nCALL PGM B\nEND PGM A MM\n"
    other = "BEGIN PGM B MM\nQ1 = 3\nL IC+45 X+Q1 F100\nEND PGM B MM\n"
    run = mnclab.run(main, "tnc-620", mnclab.Setup(files={"B.H": other}))
    explained = run.explain(line=3, program=1)
    assert explained.title == "line 3: L IC+45 X+Q1 F100"
    assert ("X+Q1", "coordinate X of L (Straight line) = 3") in [(m.word, m.says) for m in explained.meanings]
    assert "angle of the rotary axis C, incremental of L (Straight line)" in str(explained)
    assert ("rotary", "A30 B0 C-90", "A30 B0 C-45") in explained.changed
    assert run.at(line=3, program=1).point == (3, 0, 0) and run.at(line=3).point == (5, 0, 0)


@pytest.mark.parametrize(
    ("control", "text", "line", "says"),
    [
        ("mnc", "G17 G90 G54 F200\nG2 X10 Y0 I5 J0", 2, ["centre along X", "centre along Y"]),
        ("mnc", "G17 G90 G54 F200\nG0 X0 Y0\nG4 P2", 3, ["seconds"]),
        ("mnc", "G17 G90 G54\nG39 A30 X5 Y7", 2, ["angle in degrees", "rotation centre's X"]),
        ("tnc-620", "1 TOOL CALL 1 Z S1000 DR+0.1", 1, ["tool axis", "spindle speed", "delta radius"]),
        (
            "tnc-620",
            "1 BLK FORM 0.1 Z X-1 Y-2 Z-3\n2 BLK FORM 0.2 X4 Y5 Z0",
            2,
            ["X-1 Y-2 Z-3 -> X-1 Y-2 Z-3 to X4 Y5 Z0"],
        ),
        ("jnc-t01", "G96 S120 F0.2", 1, ["cutting speed, m/min"]),
        ("tnc-620", "1 TOOL CALL 1 Z S1000\n2 L X+1 R0 FMAX M3", 2, ["no radius compensation", "rapid traverse"]),
    ],
)
def test_words_are_called_what_they_are(control, text, line, says):
    explained = str(mnclab.run(text + "\n", control).explain(line=line))
    assert all(meaning in explained for meaning in says)


def test_many_moves_are_cut_short_but_never_by_one():
    """Holes of one to eight infeeds: all moves are shown, or twelve of them and how many more there are."""
    hidden = set()
    for depth in range(5, 41, 5):
        run = mnclab.run(f"G90 G54 T2 F100\nG0 X20 Z10\nG83 X20 Z-{depth} R0 K5\n", "mnc")
        told = run.explain(line=3)
        assert len(told.moves) + told.more_moves == len(run.toolpath[run.toolpath.line == 3])
        assert (f"… {told.more_moves} more" in str(told)) == (told.more_moves > 0)
        hidden.add(told.more_moves)
    assert 1 not in hidden and 0 in hidden and max(hidden) > 1

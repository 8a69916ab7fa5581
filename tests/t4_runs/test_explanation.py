"""A block in plain words; the way from the program to the tool in closed form."""

import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from tools.together import deep_but_one_in

import mnclab
from mnclab.runs.explanation import _meaning
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


OLD_CYCLE = """0 BEGIN PGM A MM
1 TOOL CALL 1 Z S900
2 CYCL DEF 1.0 PECKING
3 CYCL DEF 1.1 SET UP -2
4 CYCL DEF 1.2 DEPTH -15
5 CYCL DEF 1.3 PECKG -5
6 CYCL DEF 1.4 DWELL 0
7 CYCL DEF 1.5 F150
8 CYCL DEF 200 DRILLING ~
  Q200=2 ~
  Q201=-15 ~
  Q206=150 ~
  Q202=5 ~
  Q210=0 ~
  Q203=0 ~
  Q204=20 ~
  Q211=0
9 L X+5 FMAX
10 END PGM A MM
"""


def test_the_block_that_is_asked_for_is_the_one_that_is_told():
    """Block N of a Klartext program from 0 stands in line N + 1; six blocks of an old cycle are obeyed as one."""
    run = mnclab.run(OLD_CYCLE, "tnc-620")
    for number in range(2, 8):
        asked, by_line = run.explain(block=number), run.explain(line=number + 1)
        assert str(asked) == str(by_line) and asked._repr_html_() == by_line._repr_html_()
        assert asked.title.startswith(f"line {number + 1}, block {number}") and OLD_CYCLE.splitlines()[number] in asked.title
    assert [m.word for m in run.explain(block=4).meanings] == ["CYCL DEF 1", "DEPTH -15"]
    assert len(run.explain(block=2).meanings) == 6
    assert run.explain(line=11).title == "line 9, block 8: 8 CYCL DEF 200 DRILLING ~"  # a line without a number means its block
    assert run.at(block=9).line == 18 and run.explain(step=0).title.startswith("line 1, block 0")


def test_a_block_is_named_by_its_number_in_any_writing():
    run = mnclab.run("N10 G90\nN020 G1 X5 F100\nG0 Z3\n", "mnc")
    assert {run.at(block=number).line for number in (20, "20", "N20", " n020 ")} == {2}
    assert run.explain(line=3).title == "line 3: G0 Z3"
    for number in (2, "", "N", None, "X20", [20], 20.5):
        with pytest.raises(mnclab.Alarm, match="no block has the number|needs a line"):
            run.at(block=number)
    with pytest.raises(mnclab.Alarm, match="no program number 3"):
        run.explain(block=20, program=3)


def test_a_warning_that_is_told_once_is_told_at_each_of_its_places():
    run = mnclab.run("G17 G90 G54 T4 F200 S800 M3\nG3 Z-1 I10\nG3 Z-2 I10\nG0 Z5\n", "mnc")
    first, second = (run.explain(line=line).alarms[0] for line in (2, 3))
    assert first.message == second.message and (first.span.line, second.span.line) == (2, 3)
    assert "(line 3)" in str(run.explain(line=2)) and "(line 2)" in str(run.explain(line=3))
    assert not run.explain(line=4).alarms


def test_a_refused_block_shows_its_alarm():
    run = mnclab.run("G90\nG1 X5 Q7 F100\n", "mnc")
    explanation = run.explain(line=2)
    assert "alarm: " in str(explanation) and all("refused" in m.says for m in explanation.meanings)
    assert 'role="alert"' in explanation._repr_html_()


ROOT = Path(__file__).parent.parent.parent
SAMPLES = sorted((ROOT / "data" / "programs").rglob("*.*"))


@pytest.mark.parametrize("file", deep_but_one_in(3, SAMPLES), ids=lambda file: file.name)
def test_every_block_of_the_samples_can_be_explained(file):
    run = mnclab.run(file)
    for step in range(min(len(run.steps.block), 60)):
        explanation = run.explain(step=step)
        text = "".join("".join(run.programs[run.steps.program[step]]._lines_of(run.steps.block[step])).split())
        said = ["".join(m.word.split()) for m in explanation.meanings]
        assert [word for word in said if not word.startswith("(") and word not in text] == []  # as the program writes it
        assert len(said) >= len(explanation.moment.block.words)
        assert explanation._repr_html_()
        row = explanation.moment.rows.stop - 1
        if row >= 0:
            tip = next(stage for stage in explanation.stages if stage.name == "tool tip")
            assert tip.point == pytest.approx(run.toolpath.end[row])


def test_every_word_that_a_function_takes_says_what_it_is():
    unknown = []
    for control in mnclab.controls.values():
        run = mnclab.run("\n", control.name)
        here = SimpleNamespace(control=control, settings=run.settings, active=lambda name: None, incremental=False)
        for function in control.functions.values():
            for address in (taken.rstrip("*") for taken in function.takes):
                word = Word(address, 1.0, int(place_of(1, 1, 1)))
                says = _meaning(here, function, word)
                if says.startswith(("word ", "part")):
                    if says != "part of a circle":  # of a pattern
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
        ("jnc-t01", "G96 S120 F0.2", 1, ["cutting speed (m/min) of G96"]),
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


def told(run, **where):
    return {m.word: m.says for m in run.explain(**where).meanings}


def test_the_marks_of_the_nc_31_are_told_in_words():
    run = mnclab.run("N1 S600\nN2 F15\nN3 X@-200~\nN10 G77*~\nN11 X@-400*\nN12 Z-2000*\nN13 F2000*\nN14 P80\n", "nc-31")
    move = told(run, line=3)
    assert list(move) == ["X@-200", "@", "~"] and move["X@-200"] == "Straight move: increment on the diameter, 0.01 mm"
    assert "X is an increment" in move["@"] and "at rapid" in move["~"]
    cycle = told(run, line=4)
    assert list(cycle)[:3] == ["G77", "~", "*"] and "rapid" in cycle["~"] and "next frame belongs" in cycle["*"]
    assert cycle["X@-400"].startswith("increment on the diameter of") and "increment" not in cycle["Z-2000"]
    assert "IX" not in str(run.explain(line=3)) + str(run.explain(line=4)) and "IG" not in str(run.explain(line=4))


def test_a_switch_of_the_nc_31_is_no_increment():
    run = mnclab.run("N1 S600\nN2 F15\nN3 Z200~\nN4 G66@*\nN5 Z-100\nN6 G32@*\nN7 Z-500*\nN8 F10000\n", "nc-31")
    assert "single-block" in told(run, line=4)["@"] and "zero mark" in told(run, line=6)["@"]


@pytest.mark.parametrize(
    ("control", "text", "said"),
    [
        ("mnc", "G91 G1 X5 F100", {"X5": "increment along X", "F100": "Feed, mm/min"}),
        ("mnc", "G90 G1 X5 F100", {"X5": "coordinate X"}),
        ("mnc", "G91 G53 G0 X5", {"X5": "coordinate X"}),
        ("mnc", "G95 G1 X5 F0.1 S100 M3", {"F0.1": "Feed, mm/rev", "S100": "Spindle speed, rev/min"}),
        ("mnc", "G91 G92 X5", {"X5": "new value of X"}),
        ("mnc", "F100\nG91 G2 X5 I2.5", {"X5": "increment along X", "I2.5": "centre along X from the start"}),
        ("mnc", "G91\nG16 X0 Y0\nG10 R5 A30", {"R5": "polar radius, incremental", "A30": "polar angle in degrees, incr"}),
        ("mnc", "G0 Z9\nG91 G83 X5 Z-5 R-2 K1 F9", {"X5": "hole position along X, from the present point", "Z-5": "bottom"}),
        ("g43", "G91 G0 X5 Y2", {"X5": "increment along X", "Y2": "increment along Y"}),
        ("g43", "G91 G52 X5", {"X5": "origin's X"}),
        ("jnc-t01", "G96 S100 M3\nG91 G0 X5. Z2.", {"X5.": "increment along X, radius", "Z2.": "increment along Z"}),
        ("jnc-t01", "G96 M3\nS100", {"S100": "cutting speed, m/min"}),
        ("jnc-t01", "G0 X9.\nG93 G1 X5. F2.", {"F2.": "Feed: time of the move, s"}),
        ("jnc-t01", "G91 G92 X5.", {"X5.": "origin along X, incremental"}),
        ("tnc-620", "TOOL CALL 1 Z S100\nL IX+5 Y+2 FMAX", {"IX+5": "increment along X", "Y+2": "coordinate Y"}),
    ],
)  # fmt: skip
def test_words_are_told_as_this_block_reads_them(control, text, said):
    run = mnclab.run(text + "\n", control)
    found = told(run, step=len(run.steps.block) - 1)
    for word, meaning in said.items():
        assert meaning in next(says for shown, says in found.items() if shown == word), (word, found)


@pytest.mark.parametrize(("diameter", "word"), [(True, "diameter"), (False, "radius")])
def test_x_of_a_lathe_is_a_diameter_or_a_radius(diameter, word):
    run = mnclab.run("G0 X10.\n", "jnc-t01", mnclab.Setup(settings={"diameter": diameter}))
    assert f"coordinate X, {word}" in told(run, line=1)["X10."]


ENDS = ("G0", "G1", "G2", "G3", "L", "C", "CR", "CT")  # functions whose X Y Z are the end of the block


@pytest.mark.parametrize("file", deep_but_one_in(3, SAMPLES), ids=lambda file: file.name)
def test_explanations_of_the_samples_fit_what_the_block_did(file):
    """An axis word that is called a coordinate is where the block ended; an increment is how far it went."""
    run = mnclab.run(file)
    lathe = {"nc-31": (1 / 200, 1 / 100), "jnc-t01": (0.5 if run.settings.get("diameter") else 1.0, 1.0)}
    units = lathe.get(run.control.name, (1.0, 1.0))
    before = np.array(run.history.value("position", 0))
    for step in range(1, min(len(run.steps.block), 60)):
        explained = run.explain(step=step)
        after, words = np.array(explained.moment.position), explained.moment.block.words
        for meaning in explained.meanings:
            word = next((w for w in words if str(w) == meaning.word and w.address in ("X", "Y", "Z")), None)
            if word is None or not isinstance(word.value, float) or meaning.code not in ENDS or "M99" in explained.title:
                continue  # M99 calls a cycle after the motion
            k, says = "XYZ".index(word.address), meaning.says
            value = word.value * units[0 if k == 0 else 1]
            if says.startswith("coordinate"):
                assert after[k] == pytest.approx(value, abs=1e-9), explained
            elif says.startswith("increment"):
                assert after[k] - before[k] == pytest.approx(value, abs=1e-9), explained
            assert not (says.startswith("coordinate") and run.history.value("dimension", step) == "G91")
        before = after

"""Grades: what passes, what earns a part, what earns nothing; what costs nothing; hints by tries."""

import re

import numpy as np
import pytest

import mnclab
from mnclab import Alarm
from mnclab.learning.answers import answers_of
from mnclab.learning.asked import executed, first_line
from mnclab.learning.exercise import Question
from mnclab.learning.exercise_file import load
from mnclab.learning.predicting import value_of
from mnclab.runs.causes import of_row
from mnclab.runs.material import depths_of_passes

SQUARE = """
title = "A step"
control = "{control}"
level = {level}
lesson = "05"
kind = "write"
task = "Mill the step."
tolerance = 0.02
{more}
[setup.tools.1]
radius = 5
kind = "mill"
cutting_length = 20
[setup.tools.2]
radius = 4
kind = "drill"
angle = 118
[design.blank]
low = [0, 0, -20]
high = [60, 40, 0]
[[design.features]]
kind = "slot"
name = "slot"
start = [15, 20]
end = [45, 20]
width = 10
depth = 4
[[design.features]]
kind = "hole"
name = "hole"
x = 30
y = 33
diameter = 8
depth = 6
"""
RIGHT = "G17 G90 G54 T1 S1000 M3\nG0 X15 Y20 Z5\nG1 Z-4 F100\nX45 F300\nG0 Z5\nT2 S800 M3\nG0 X30 Y33\nG1 Z-6 F80\nG0 Z50\nM30\n"
HOLE_DEPTH = 4 / np.tan(np.radians(59))  # of the point of 118 degrees below its shoulder
RIGHT = RIGHT.replace("Z-6", f"Z-{6 + HOLE_DEPTH:.4f}")


@pytest.fixture
def made(tmp_path):
    def make(more="", level=2, control="mnc", name="t-01"):
        path = tmp_path / f"{name}.toml"
        path.write_text(SQUARE.format(more=more, level=level, control=control), "utf-8")
        return load(path)

    return make


def test_a_right_answer_passes_with_all_marks(made):
    grade = made().check(RIGHT)
    assert (grade.passed, grade.score, dict(grade.points)) == (True, 1.0, {"part": 1.0, "safety": 1.0})
    assert grade.hints == () and grade.faults == () and grade.run.ok


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.lower(),
        lambda text: text.replace(" ", "   "),
        lambda text: text.replace(" ", ""),
        lambda text: text.replace("\n", "\r\n") + "\x1a\0\0",
        lambda text: text.replace("X45 F300", "X45 F300 // along"),
        lambda text: "\n".join(f"N{10 * k} {line}" if line else line for k, line in enumerate(text.split("\n"), 1)),
        lambda text: text.replace("X45", "X45.000"),
        lambda text: text.replace("X45 F300", "X30 F300\nX45"),
        lambda text: text.replace("G0 X15 Y20 Z5", "G0 Z40\nG0 X15 Y20\nG0 Z3"),
        lambda text: text.replace("X45 F300", "G91 X30 F300\nG90"),
        lambda text: "G17 G90 G54 T2 S800 M3\nG0 X30 Y33 Z5\n" + text.split("Y33\n")[1].replace("M30", text.split("T2")[0]),
    ],
    ids=["lower", "spaces", "none", "ends", "comment", "numbers", "zeros", "split", "approach", "incremental", "order"],
)
def test_what_makes_the_same_part_costs_nothing(made, change):
    grade = made().check(change(RIGHT))
    assert (grade.passed, grade.score) == (True, 1.0), grade


def test_a_feature_that_is_right_earns_its_part(made):
    only_slot = RIGHT.split("T2")[0] + "M30\n"
    grade = made().check(only_slot)
    assert not grade.passed and grade.points["part"] == 0.5 and grade.points["safety"] == 1.0
    assert grade.hints[0].text == "hole: nothing is cut there" and grade.hints[0].place is not None


@pytest.mark.parametrize(
    ("answer", "says"),
    [
        ("", "empty"),
        ("G17 G90 T1 S1000 M3\nM30\n", "moves nothing"),
        ("G17 G90 T1 S1000 M3\nG0 X15 Y20 Z5\nM30\n", "nothing is cut"),
        (RIGHT.replace("G1 Z-4", "G1 Z-4 J3"), "stops"),
        (RIGHT.replace(" M3", ""), "spindle"),
        (RIGHT.replace("X45 F300", "G0 X45"), "rapid"),
        (RIGHT.replace("T1", "T2"), "fed across it"),
        (RIGHT.replace("G1 Z-4 F100", "G41 G1 X16 Z-4 F100"), "compensation"),
    ],
)
def test_what_stops_moves_nothing_or_is_not_safe_earns_nothing(made, answer, says):
    grade = made().check(answer)
    assert (grade.passed, grade.score) == (False, 0.0)
    assert says in " ".join(map(str, grade.hints)).lower()


def test_what_is_cut_elsewhere_costs(made):
    grade = made().check(RIGHT.replace("M30\n", "G0 X5 Y5\nG0 Z2\nG1 Z-3 F50\nG0 Z50\nM30\n"))
    assert not grade.passed and grade.points["part"] == 0.5  # two features, one fault
    assert "too much is cut" in grade.hints[0].text and grade.hints[0].line in (12, 13)


def test_the_third_try_of_a_fault_says_more_and_other_faults_do_not(made):
    wrong = RIGHT.replace("Z-4", "Z-3")
    said = [made().check(wrong, tried={"slot depth": k}).hints[0].text for k in range(4)]
    assert said[0] == said[1] == "slot: its depth is not as drawn"
    assert said[2] == "slot: its depth is 1.000 mm too shallow" and said[3].startswith(said[2] + ";")
    assert made().check(wrong, tried={"hole depth": 9}).hints[0].text == said[0]
    assert made().check(wrong).hints[0].line == 3


def test_at_most_three_hints_danger_before_the_part(made):
    wrong = RIGHT.replace("X45 F300", "G0 X45").replace("Z-4", "Z-3").replace("X30 Y33", "X31 Y33")
    hints = made("[asked]\nmust = ['G91', 'G83']").check(wrong).hints
    assert len(hints) == 3 and hints[0].text.startswith("rapid motion in material") and "hole" in " ".join(h.text for h in hints)


@pytest.mark.parametrize(
    ("code", "found"),
    [("G1", True), ("G01", True), ("g1", True), ("G10", False), ("M3", True), ("G91", False), ("T1", True), ("G4", False)],
)
def test_what_must_be_used_is_found_as_a_word(made, code, found):
    grade = made(f"[asked]\nmust = ['{code}']").check(RIGHT.replace("\n", " // G91 G4 G10\n"))
    assert grade.passed is found and grade.points["asked"] == float(found)
    assert made(f"[asked]\nmust_not = ['{code}']").check(RIGHT).passed is not found


def test_a_cycle_that_is_written_in_parts_is_found_by_its_number():
    lines = [(4, "CYCL DEF 10.0 ROTATION"), (5, "CYCL DEF 10.1 ROT+30"), (6, "L Z-9.64")]
    assert first_line("CYCL DEF 10", lines) == 4 and first_line("CYCL DEF 10.1", lines) == 5
    assert first_line("CYCL DEF 1", lines) is None and first_line("Z-9", lines) is None


def test_a_prediction_of_the_tip_knows_how_long_the_tool_truly_is():
    """80 mm in the table and 80.3 in truth: the tip is 0.3 lower than the control counts."""
    tools, true = {1: mnclab.Tool(radius=5, length=80)}, {1: mnclab.Tool(radius=5, length=80.3)}
    text = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+0 Y+0 Z+10 R0 FMAX M3\nL Z-9.64 F100\nEND PGM A MM\n"
    run = mnclab.run(text, "tnc-620", mnclab.Setup(tools=tools, true_tools=true))
    counted, truly = (value_of(Question("where?", what), run) for what in ("z", "tip z"))
    assert (counted, round(truly, 9)) == (-9.64, -9.94)


def test_blocks_values_and_weights(made):
    assert made("[asked]\nblocks = 10").check(RIGHT).passed
    few = made("[asked]\nblocks = 9").check(RIGHT)
    assert not few.passed and few.score == pytest.approx(0.7 / 0.9) and "10 blocks, 9 are allowed" in few.hints[0].text
    assert made("[asked]\nblocks = 9\n[weights]\npart = 1").check(RIGHT).score == 0.99


def test_economy_never_below_a_pass_and_only_from_level_three(made):
    time = made().check(RIGHT).run.profile().time
    slow = made(f"[asked]\ntime = {time / 1.5}", level=3).check(RIGHT)
    assert slow.passed and slow.points["economy"] == pytest.approx(0.5) and slow.score == pytest.approx((0.7 + 0.05) / 0.8)
    assert "quicker" in slow.hints[0].text
    assert made(f"[asked]\ntime = {time / 1.5}", level=2).check(RIGHT).score == 1.0
    assert made(f"[asked]\ntime = {time * 1.01}", level=3).check(RIGHT).score == 1.0


def test_a_tool_that_cannot_cut_is_not_safe(made):
    """Tool 3 has neither radius nor edge: nothing can be judged of its rows."""
    grade = made("[setup.tools.3]\nlength = 40\n").check(RIGHT.replace("T2 S800", "T3 S800"))
    assert (grade.passed, grade.score) == (False, 0.0)
    assert (grade.hints[0].line, grade.hints[0].text.split(":")[0]) == (8, "T3 has no radius")


@pytest.mark.parametrize("change", [("S1000", "S1"), ("F300", "F6000"), ("F80", "F4000")])
def test_a_feed_at_which_any_tool_breaks_earns_nothing(made, change):
    """More than its radius a turn: a mill of 10 at 300, at 6 mm; a drill of 8 at 5."""
    grade = made().check(RIGHT.replace(*change, 1))
    assert (grade.passed, grade.score) == (False, 0.0) and "breaks at this feed" in grade.hints[0].text
    assert made().check(RIGHT.replace("F300", "F4900")).passed


@pytest.mark.parametrize(("of", "at"), [("1", (7, 0, 0)), ("2", (0, 0, 0))])
def test_a_zero_point_that_is_elsewhere_is_told_first_and_alone(made, of, at):
    """The blank stands on the machine; a path that counts from 7 mm beside it has it 7 mm further back."""
    exercise = made(f"[setup]\nstock = {{low = [0, 0, -20], high = [60, 40, 0]}}\n[setup.datums]\n{of} = [{at[0]}, 0, 0]")
    grade = exercise.check(RIGHT, {"zero point": 2})
    if any(at):
        assert grade.faults[0] == "zero point" and "7.000 mm along X" in exercise.check(RIGHT, {"zero point": 9}).hints[0].text
        assert grade.hints[0].text == "the zero point is not where the drawing has it: it is off along X"
    else:
        assert grade.passed


@pytest.mark.parametrize(("limits", "right"), [("ap = [3.9, 4.1]", True), ("ap = [0, 3]", False), ("ae = [9.9, 10.1]", True)])
def test_depth_and_width_of_cut_can_be_asked_for(made, limits, right):
    """The slot is as wide as the tool, 10 mm, and 4 deep."""
    grade = made(f"[asked]\ncutting = [{{tool = 1, {limits}}}]").check(RIGHT)
    assert grade.passed is right and (grade.points["asked"] == 1) is right, grade


@pytest.mark.parametrize(
    ("wanted", "right"),
    [("1, n = [1000, 1000]", True), ("1, n = [0, 999]", False), ("1, vf = [299, 301]", True), ("1, vf = [0, 290]", False),
     (f"2, ap = [0, {6 + HOLE_DEPTH / 3 + 0.01}]", True), (f"2, ap = [0, {6 + HOLE_DEPTH / 3 - 0.01}]", False)],
)  # fmt: skip
def test_speed_feed_and_pecks_can_be_asked_for(made, wanted, right):
    """The slot is milled with S1000 F300; a peck of 6 mm and a cone below it takes as much as a cylinder 6 + cone / 3 deep."""
    assert made(f"[asked]\ncutting = [{{tool = {wanted}}}]").check(RIGHT).passed is right


@pytest.mark.parametrize(("most", "share"), [((999, 299, 3.9), 0), ((1000, 299, 3.9), 1 / 3), ((1000, 301, 3.9), 2 / 3)])
def test_each_quantity_of_a_tool_counts_alike(made, most, share):
    """S1000 F300, 4 mm deep: of speed, feed and depth none, one and two are right; none is worth less than nothing."""
    n, vf, ap = most
    grade = made(f"[asked]\ncutting = [{{tool = 1, n = [0, {n}], vf = [0, {vf}], ap = [0, {ap}]}}]").check(RIGHT)
    assert grade.points["asked"] == pytest.approx(share)


def test_a_pass_on_a_lathe_is_as_deep_as_its_way_not_as_the_shoulder_at_its_end():
    """From 20 to 17 mm along 24.8 mm; then from 17.2 mm, 0.2 along 25 mm of 27, and 3 mm of the shoulder along 0.2."""
    text = "T1\nG97 S500 G95 F0.2 M3\nG00 X17.2 Z2\nG01 Z-24.8\nX22\nG00 Z2\nX17\nG01 Z-25\nX22\n"
    tool = mnclab.Tool(kind="turning", main_angle=90, auxiliary_angle=30)
    run = mnclab.run(text, "jnc-t01", tools={1: tool}, stock=mnclab.cylinder(diameter=40, length=60))
    last = 17**2 + (24.8 * (17.2**2 - 17**2) + 0.2 * (20**2 - 17**2)) / 27
    first = 17.2**2 + 24.8 * (20**2 - 17.2**2) / 26.8
    deep = depths_of_passes(run, 1)
    assert (min(deep), max(deep)) == pytest.approx((last**0.5 - 17, first**0.5 - 17.2), abs=1e-3)
    assert run.cutting_data()[0].depth[1] == pytest.approx(3.0)  # that of the shoulder


def named(exercise, text, *edits):
    """The lines that the hints name when lines of an answer are replaced or (None) left out."""
    rows = text.split("\n")
    for line, new in edits:
        rows[line - 1 : line] = [] if new is None else [new]
    return [int(line) for hint in exercise.check("\n".join(rows)).hints for line in re.findall(r"line (\d+)", str(hint))]


def test_a_facing_that_was_forgotten_is_told_where_the_tool_stands_at_the_face_and_leaves():
    exercise = mnclab.exercise("jnc-t01-10")
    text = exercise.solution()
    assert text.split("\n")[1:4] == ["G00 X22 Z0", "S600 G97 G95 F0.25 M3", "G01 X-1"]
    assert 2 in named(exercise, text, (4, None))


def test_a_pass_that_is_too_deep_is_told_and_of_threads_the_pass_that_begins_elsewhere():
    exercise = mnclab.exercise("jnc-t01-09")
    text = exercise.solution()
    rows = text.split("\n")
    assert (rows[4], rows[38]) == ("G00 X12.5 Z2", "Z4")
    assert 6 in named(exercise, text, (5, "G00 X11.5 Z2"))  # its pass
    assert 39 in named(exercise, text, (39, "Z5"))


def test_a_form_that_is_far_off_is_told_before_a_measure_that_is_hardly_beside_its_limits():
    """The last side of the second hook ends a millimetre early; where its middle is moves by hundredths."""
    exercise = mnclab.exercise("mnc-03")
    rows = exercise.solution().split("\n")
    assert rows[13] == "N140 X18"
    rows[13] = "N140 X19"
    hint = exercise.check("\n".join(rows)).hints[0]
    assert hint.line == 14 and "its y is" not in hint.text


def test_where_a_pattern_is_drilled_its_definition_is_a_cause():
    text = """BEGIN PGM A MM
TOOL CALL 2 Z S1000
PATTERN DEF POS1 (X+25 Y+33.5 Z+0)
CYCL DEF 200 DRILLING Q200=2 Q201=-20 Q206=150 Q202=5 Q210=0 Q203=+0 Q204=20 Q211=0 Q395=0
L Z+100 R0 FMAX M3
CYCL CALL PAT FMAX
END PGM A MM
"""
    run = mnclab.run(text, "tnc-620", tools={2: mnclab.Tool(radius=3)})
    deepest = int(run.toolpath.end[:, 2].argmin())
    assert {3, 4, 6} <= {each.line for each in of_row(run, deepest, [])}


def test_a_number_that_variables_bring_is_told_where_it_was_typed():
    exercise = mnclab.exercise("g43-06")
    text = exercise.solution()
    rows = text.split("\n")
    assert (rows[5][:8], rows[14], rows[16]) == ("#104=1.5", "#3=#104+#1*#105", "Z-#3")
    assert {5, 6, 7} & {*named(exercise, text, (6, "#104=1.8"))}  # it or its neighbour


def test_a_groove_too_wide_costs_itself_and_what_was_not_measured_nothing():
    """Of profile, groove and thread; on the bar nothing could be measured where the groove is to be."""
    exercise = mnclab.exercise("jnc-t01-09")
    grade = exercise.check(exercise.solution().replace("Z-29\n", "Z-28.5\n"))
    assert grade.points["part"] == pytest.approx(2 / 3) and grade.faults == ("groove width",)


def test_what_is_spoilt_costs_its_share():
    """Two of four measures of the groove are right, and one of three of the profile, which was there, is spoilt."""
    exercise = mnclab.exercise("nc-31-22")
    assert exercise.check(exercise.solution().replace("Z-4200*", "Z-4250*")).points["part"] == pytest.approx(1 / 2 - 1 / 3)


def test_a_thread_that_is_cut_too_deep_is_told_as_one():
    exercise = mnclab.exercise("jnc-t01-09")
    text = exercise.solution().replace("X9.08\n", "X8.9\n")
    hint, *_ = exercise.check(text, tried={"thread depth": 2}).hints
    assert text.split("\n")[hint.line - 2] == "X8.9" and hint.text == "thread: its depth is 0.180 mm too deep"


@pytest.mark.parametrize(
    ("code", "change"),
    [("G41", ("G1 Z-4", "G41 G1 X16 Y21 F300\nG40 X15 Y20\nG1 Z-4")), ("G41", ("M30", "G41 G1 X16 F300\nG40 X15\nM30"))],
)
def test_compensation_in_the_air_is_none(made, code, change):
    grade = made(f"[asked]\nmust = ['{code}']").check(RIGHT.replace(*change))
    assert not grade.passed and grade.hints[0].text == f"the task asks for {code}, and it is not on where the tool cuts"


def test_an_alarm_has_the_place_where_the_program_stopped(made):
    """Line 6 is refused, line 5 went to X45 Y20 Z5; nothing moved before line 1."""
    assert made().check(RIGHT.replace("G0 Z5\nT2", "G0 Z5\nG0 X1 Q4\nT2")).hints[0].place == (45, 20, 5)
    assert made().check("G0 X5 Q3\n" + RIGHT).hints[0].place is None


def test_names_are_no_codes():
    text = 'BEGIN PGM RL MM\nTOOL CALL 1 Z S1600\nLBL "CHF"\nCALL PGM RND\nL X+5 R0 F100 M3\nEND PGM RL MM\n'
    lines = list(executed(mnclab.run(text, "tnc-620", files={"RND.h": "BEGIN PGM RND MM\nL Y+5\nEND PGM RND MM\n"})))
    assert [first_line(code, lines) for code in ("RL", "CHF", "RND", "CALL PGM")] == [None, None, None, 4]


@pytest.mark.parametrize("name", ["jnc-t01-02", "jnc-t01-04", "jnc-t01-05"])
def test_diameters_where_radii_are_meant_are_told_first(name):
    exercise = mnclab.exercise(name)
    right = answers_of(exercise.file).model
    grade = exercise.check(re.sub(r"\b([XU])(-?[\d.]+)", lambda word: f"{word[1]}{2 * float(word[2]):g}", right))
    assert not grade.passed and str(grade.hints[0]) == "X is a radius here, and this program writes diameters"
    assert "diameters" not in exercise.check(right.replace("Z-", "Z-1")).faults


def test_a_hole_that_a_lathe_drills_too_shallow_is_told_at_its_block():
    """Its wall ends in the point of the drill, which is no smaller diameter."""
    exercise = mnclab.exercise("jnc-t01-05")
    text = exercise.solution()
    hint = exercise.check(text.replace("G73 Z-27.004", "G73 Z-24")).hints[0]
    assert text.split("\n")[hint.line - 1].startswith("G73") and hint.text == "core hole: it is not as deep as drawn"


def test_a_hole_that_is_too_shallow_by_the_point_of_the_drill_is_told_so(made):
    text = RIGHT.replace(f"Z-{6 + HOLE_DEPTH:.4f}", "Z-6")
    (hint, *_), line = made().check(text, tried={"hole depth": 9}).hints, text.split("\n").index("G1 Z-6 F80") + 1
    assert hint.line == line and hint.text.endswith("too shallow; that is the height of the point: how far down does the full "
                                                    "diameter go?")  # fmt: skip


def test_where_an_arc_begins_and_what_only_a_rapid_passes_over_are_named(made):
    """An arc of R3 in line 5 begins at X of line 4, Y of line 2; the drill that is never fed comes to its hole in line 7."""
    hints = made().check(RIGHT.replace("F300\n", "F300\nG3 Y30 R3\n")).hints
    assert {hint.line: hint.text[-20:-14] for hint in hints[1:]} == {4: " the X", 2: " the Y"} and hints[0].line == 5
    hint, *_ = made().check(re.sub(r"G1 Z-\S+ F80\n", "", RIGHT)).hints
    assert hint.line == 7 and "hole: nothing is cut there" in hint.text


def test_a_card_has_blank_jaws_start_and_numbered_lines():
    shown = mnclab.exercise("jnc-t01-08")._repr_html_()
    assert "Blank ⌀60, Z-80 to 0; held by ⌀100, bore 60, Z-95 to -65; the machine stands at X60 Z40" in shown
    lines = re.sub("<[^>]*>", "", shown[shown.index("<pre>") : shown.index("</pre>")]).split("\n")
    assert [line[:3].strip() for line in lines] == [str(k) for k in range(1, len(lines) + 1)]
    assert "Blank" not in mnclab.exercise("tnc-620-05")._repr_html_()  # where it stands is to be found


def test_no_axis_goes_to_where_no_machine_reaches(made):
    grade = made().check(RIGHT.replace("M30", "G0 X99999\nM30"))
    assert not grade.passed and "leaves the travel of the machine" in grade.hints[0].text and grade.hints[0].line == 10


def test_loops_and_masses_of_blocks_are_refused(made):
    assert "blocks" in made().check("G1 X1 F1\n" * 30_000).hints[0].text
    assert "1 MB" in made().check("G0 X1\n" * 300_000).hints[0].text


@pytest.mark.parametrize("answer", [None, 5, [], object()])
def test_what_is_no_text_is_an_alarm(made, answer):
    with pytest.raises(Alarm, match="an answer is a text, a path or a run"):
        made().check(answer)


def test_a_run_and_a_file_are_graded_on_the_machine_of_the_exercise(made, tmp_path):
    file = tmp_path / "t-01.mnc"
    file.write_bytes("// Плита\n".encode("koi8-r") + RIGHT.replace("\n", "\r\n").encode())
    assert made().check(file).passed
    other = mnclab.run(RIGHT, "mnc", tools={1: mnclab.Tool(radius=1), 2: mnclab.Tool(radius=1)})
    assert made().check(other).passed


def test_nothing_of_the_model_is_in_the_exercise_or_its_grade(made, tmp_path):
    path = tmp_path / "t-02.toml"
    path.write_text(SQUARE.format(more="", level=2, control="mnc") + f'\n[model]\nanswer = """\n{RIGHT}"""\n')
    exercise = load(path)
    assert exercise.solution() == RIGHT
    grade = exercise.check("")
    shown = repr(exercise) + exercise._repr_html_() + repr(grade) + grade._repr_html_() + repr(vars(exercise))
    blocks = [line for line in RIGHT.split("\n") if len(line) > 5]
    assert not [line for line in blocks if line in re.sub(r"base64,[^\"]*", "", shown)]
    with pytest.raises(Alarm, match="has no solution"):
        made().solution()

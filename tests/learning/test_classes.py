"""Classes, pupils' folders, neighbours, progress; predictions, tables, going on, strategies; and the shell."""

import json
import math
import os
import re
import subprocess
import sys
import tomllib
import unicodedata
from html import unescape
from pathlib import Path

import pytest

import mnclab
import mnclab.learning
from mnclab import Alarm
from mnclab import __main__ as shell
from mnclab.learning.answers import answers_of, pupils_copy
from mnclab.learning.authoring import missing
from mnclab.learning.exercise_file import load
from mnclab.learning.giving import chosen, give
from mnclab.learning.marking import Mark, Marks, class_page, mark
from mnclab.learning.progress import Progress

NAME = "mnc-07"
MODEL = answers_of(mnclab.exercise(NAME).file).model


def test_a_class_is_graded_and_hostile_answers_are_refused_one_by_one(tmp_path, capsys):
    answers = {
        "ivanov/mnc-07.mnc": MODEL.replace("\n", "\r\n").encode("cp1251"),
        "petrov/MNC-07.txt": MODEL.replace("Z-5", "Z-4").encode(),
        "endless/mnc-07.mnc": b"G17 G90 T1 S500 M3\n" + b"G1 X40 Y30 Z-1 F1000\nX70\nX10\nY50\n" * 4900,
        "huge/mnc-07.mnc": b"N1 G0 X1\n" * 200_000,
        "bytes/mnc-07.mnc": bytes(range(256)) * 20,
        "ivanov/notes.txt": b"not an answer",
    }
    for name, content in answers.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(content)
    found = mark(tmp_path)
    odd = [(each.pupil, each.exercise) for each in found if "not that of an exercise" in each.refused]
    assert odd == [("ivanov", "notes.txt")]
    marks = {each.pupil: each for each in found if each.exercise == NAME}
    assert list(marks) == ["bytes", "endless", "huge", "ivanov", "petrov"]
    assert [name for name, each in marks.items() if each.passed] == ["ivanov"]
    assert 0 < marks["petrov"].score < 1 and "depth" in marks["petrov"].hints[0]
    assert "not graded within" in marks["endless"].refused and "more than 1 MB" in marks["huge"].refused
    assert marks["bytes"].score == 0
    page = class_page(mnclab.mark(tmp_path / "petrov"), "9 b")
    assert "To explain again" in page and "pocket depth" in page and "<h1>9 b</h1>" in page
    assert shell.main(["grade", str(tmp_path / "ivanov"), "--csv"]) == 0
    assert capsys.readouterr().out.splitlines()[1].startswith("ivanov,mnc-07,100%,yes")


def test_links_folders_and_names_of_any_code_page_are_told(tmp_path, capsys):
    """A pupil who handed in nothing has a row too, and of two answers the page shows the better one."""
    folder = tmp_path / "class"
    for name in ("anna/mnc-07.mnc", "anna/mnc-07.txt", "boris/week/mnc-07.mnc", "mnc-07.mnc", "empty/progress.json"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("G0 X5\n" if name.endswith("txt") else MODEL)
    (folder / "link").mkdir()
    (folder / "link" / "mnc-07.mnc").symlink_to("../anna/mnc-07.mnc")
    (folder / "linked").symlink_to("anna")
    pupil = os.path.join(os.fsencode(folder), "Ольга".encode("cp1251"))
    os.mkdir(pupil)
    Path(os.fsdecode(pupil), "mnc-07.mnc").write_text(MODEL)
    marks = mark(folder, jobs=1)
    wrong = {(each.pupil, each.exercise): each.refused[:6] for each in marks if each.refused}
    assert wrong == {("", "mnc-07.mnc"): "not gr", ("boris", "week"): "not gr", ("empty", ""): "nothin",
                     ("link", NAME): "a link", ("linked", NAME): "a link"}  # fmt: skip
    assert [each.pupil for each in marks if each.passed] == ["anna", "Ольга"]
    assert shell.main(["grade", str(folder), "--html", str(tmp_path / "class.html"), "--csv"]) == 1
    page = (tmp_path / "class.html").read_text("utf-8")
    rows = dict(re.findall(r"<td[^>]*>([^<]*)</td><td[^>]*>([^<]*)</td></tr>", page.split("<h2>")[0]))
    assert rows == {"anna": "✓", "boris": "–", "empty": "–", "link": "0", "linked": "0", "Ольга": "✓"}
    assert "Ольга,mnc-07,100%,yes" in capsys.readouterr().out


def test_files_as_they_were_given_are_not_handed_in(tmp_path):
    """mnc-02 gives a program with two faults, which earns something where it is handed in; nothing is said of it here."""
    give(["mnc-02", NAME], tmp_path / "class" / "anna")
    (tmp_path / "class" / "anna" / "mnc-07.mnc").write_text(MODEL.replace("Z-5", "Z-4"))
    give(["mnc-02", NAME], tmp_path / "class" / "boris")
    given = tmp_path / "class" / "boris" / "mnc-02.mnc"
    given.write_bytes(given.read_bytes().replace(b"\n", b"\r\n"))
    (tmp_path / "class" / "boris" / "mnc-07.mnc").write_text("")
    done = []
    marks = mark(tmp_path / "class", told=lambda *counts: done.append(counts))
    assert done == [(1, 4), (2, 4), (3, 4), (4, 4)]
    assert [(each.pupil, each.exercise) for each in marks if each.handed_in] == [("anna", NAME)]
    assert marks.csv().splitlines()[-1].startswith("boris,mnc-07,–,–,not handed in")
    page = class_page(marks, "9 b")
    assert "mnc-02" not in page and "empty" not in page and "Not graded" not in page and "0 of 1" in page
    assert re.search("boris</td><td[^>]*>–</td></tr>", page)


def test_what_nobody_passed_is_explained_first():
    tried = [("mnc-03", 1), ("mnc-03", 0), ("mnc-03", 0), ("mnc-05", 0), ("mnc-05", 0), ("mnc-06", 1), ("mnc-07", 0)]
    page = class_page(Marks(Mark(f"p{k}", name, passed * 1.0, passed == 1) for k, (name, passed) in enumerate(tried)), "9 b")
    again = re.findall(r"(mnc-\d\d): .*?(\d of \d)", page.split("To explain again")[1])
    assert again == [("mnc-05", "0 of 2"), ("mnc-07", "0 of 1"), ("mnc-03", "1 of 3")]


def test_a_script_that_grades_is_not_run_again_by_its_processes(tmp_path):
    (tmp_path / "anna").mkdir()
    (tmp_path / "anna" / "mnc-07.mnc").write_text(MODEL)
    script = f"import mnclab; print('begun', mnclab.mark({str(tmp_path)!r})[0].passed)"
    for said in (["-c", script], ["-"]):
        found = subprocess.run([sys.executable, *said], input=script, capture_output=True, text=True)
        assert found.stdout == "begun True\n" and found.stderr == "", found.stderr


def test_a_class_is_marked_by_the_house_not_by_copies_that_lie_about(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "class" / "anna").mkdir(parents=True)
    (tmp_path / "class" / "anna" / "mnc-07.mnc").write_text(MODEL)
    (copy,) = [path for path in give([NAME]) if path.suffix == ".toml"]
    copy.write_text(copy.read_text("utf-8").replace("depth = 5", "depth = 4"), "utf-8")
    assert not mnclab.exercise(NAME).check(MODEL).passed and mark("class")[0].passed


def test_a_copy_of_tables_hides_the_tools_as_they_are_and_grades_alike(tmp_path):
    for each in mnclab.exercises("tnc-620"):
        if each.kind == "set up":
            copy = tmp_path / each.file.name
            copy.write_text(text := pupils_copy(each.file), "utf-8")
            assert "true_tools" not in text and "stock = {" not in text
            assert load(copy).check(each.solution()).passed
    copy.write_text(text.replace('sealed = "', 'sealed = "AAAA'), "utf-8")
    with pytest.raises(Alarm, match="what is sealed was changed"):
        load(copy)


def test_a_call_of_another_pupils_file_is_refused(tmp_path):
    (tmp_path / "other.h").write_text("BEGIN PGM OTHER MM\nEND PGM OTHER MM\n")
    path = tmp_path / "tnc-620-99.toml"
    path.write_text(PREDICT.replace("mnc", "tnc-620").replace("predict", "write") + DESIGN)
    said = str(load(path).check(f"BEGIN PGM A MM\nCALL PGM {tmp_path / 'other.h'}\nEND PGM A MM\n").hints[0])
    assert "stops" in said


def test_a_folder_for_pupils_has_no_answers_and_keeps_what_they_began(tmp_path):
    (tmp_path / "mnc-06.mnc").write_text("begun")
    paths = give(["mnc-06..mnc-06"], tmp_path, "Anna-Maria Ș.")
    assert {path.name for path in paths} == {"mnc-06.toml", "mnc-06.html"}
    assert (tmp_path / "mnc-06.mnc").read_text() == "begun"
    text, model = (tmp_path / "mnc-06.toml").read_text("utf-8"), answers_of(mnclab.exercise("mnc-06").file).model
    assert "[model]" not in text and not any(line in text for line in model.split("\n") if len(line) > 5)
    assert load(tmp_path / "mnc-06.toml").check(model).passed
    with pytest.raises(Alarm, match="there is no exercise 'mnc-77'"):
        give(["mnc-77"], tmp_path)


def test_a_pupil_grades_his_own_drawing_from_the_shell(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = ("Anna", "Boris", "Vera", "Georgi", "Dina")
    found = set()
    for name in names:
        give([NAME], tmp_path / name, name)
        size = load(tmp_path / name / f"{NAME}.toml").design.features[0].contour
        model = (tmp_path / name / f"{NAME}.mnc")
        found.add(str(size))
        model.write_text(MODEL)
        own = load(tmp_path / name / f"{NAME}.toml").check(MODEL).passed
        assert shell.main(["grade", str(model)]) == (0 if own else 1)
        assert f"graded by {model.with_suffix('.toml')}, which lies beside the answer" in capsys.readouterr().err
    assert len(found) > 1


@pytest.mark.parametrize("pupil", ["x\x7fy", 'q"w\\e', "t\tb\nz", "Анна\xa0Иванова 😀"])
def test_the_name_of_a_pupil_is_read_as_it_was_given(tmp_path, pupil):
    copy = next(path for path in give(["mnc-03"], tmp_path, pupil) if path.suffix == ".toml")
    assert tomllib.loads(copy.read_text("utf-8"))["pupil"] == pupil


def test_a_name_that_no_file_can_hold_is_refused(tmp_path):
    with pytest.raises(Alarm, match="byte that is no letter"):
        give(["mnc-03"], tmp_path, "a\udcffb")


def test_a_teachers_own_file_is_given_and_graded(tmp_path, monkeypatch):
    """His answers stay with him, and his folder is no place for the copies."""
    monkeypatch.chdir(tmp_path)
    text = mnclab.exercise(NAME).file.read_text("utf-8").replace("A ", "My ", 1)
    (tmp_path / "mine.toml").write_text(text, "utf-8")
    assert shell.main(["exercise", "give", "mine.toml", "-o", "pupils"]) == 0
    copy = (tmp_path / "pupils" / "mine.toml").read_text("utf-8")
    assert "[model]" not in copy and "[[faults]]" not in copy and (tmp_path / "pupils" / "mine.mnc").exists()
    with pytest.raises(Alarm, match="has the answers"):
        give(["mine.toml"], ".")
    assert (tmp_path / "mine.toml").read_text("utf-8") == text
    (tmp_path / "class" / "anna").mkdir(parents=True)
    (tmp_path / "class" / "anna" / "mine.mnc").write_text(MODEL.replace("Z-5", "Z-4"))
    (tmp_path / "class" / "anna" / "mnc-07.mnc").write_text(MODEL)
    for own in ("mine.toml", "."):
        assert [each.passed for each in mark("class", exercises=own)] == [False, True]
    assert "mine: " in class_page(mark("class", exercises="mine.toml"), "9 b", "mine.toml")
    with pytest.raises(Alarm, match="there is no exercise in"):
        mark("class", exercises="yours.toml")


HIDDEN = """
title = "Rows"
control = "mnc"
level = 2
lesson = "10"
KIND = 'set up'
task = "Write the row."
[given]
program = "G0 X1"
"""


@pytest.mark.parametrize(
    "hidden",
    ["[setup]\nstock = {low = [0, 0, -9], high = [9, 9, 0]}\n", "[setup]\nstock={low = [0, 0, -9], high = [9, 9, 0]} # here\n",
     "[ setup . stock ]\nlow = [0, 0, -9]\nhigh = [9, 9, 0]\n", "[setup]\n[setup.'true_tools'.1]\nradius = 4.96\n"],
)  # fmt: skip
@pytest.mark.parametrize("kind", ["kind = 'set up'", 'kind="set up"', '"kind"  =  "set up"  # tables'])
def test_what_is_sealed_is_found_however_it_is_written(tmp_path, hidden, kind):
    path = tmp_path / "rows.toml"
    path.write_text(HIDDEN.replace("KIND = 'set up'", kind) + hidden + "[design]\ntitle = 'a'\n[model]\nanswer = '[tools.1]'\n")
    copy = tomllib.loads(pupils_copy(path))
    assert set(copy) == {"sealed", "title", "control", "level", "lesson", "kind", "task", "given", "design", *(
        ["setup"] if hidden.startswith("[setup]") else [])}  # fmt: skip
    assert copy.get("setup", {}) == {}


@pytest.mark.parametrize("hidden", ["setup.stock = {low = [0, 0, -9], high = [9, 9, 0]}\n", "[ model ]\nanswer = '[tools.1]'\n",
                                    "[setup]\nstock = { high = [9, 9, 0], low = [\n0, 0, -9] }\n"])  # fmt: skip
def test_a_copy_that_would_show_an_answer_is_refused(tmp_path, hidden):
    path = tmp_path / "rows.toml"
    first, last = ("", hidden) if hidden[0] == "[" else (hidden, "")
    path.write_text(first + HIDDEN.replace("KIND", "kind") + last)
    with pytest.raises(Alarm, match=r"kept from pupils|must stand last"):
        pupils_copy(path)


def test_lessons_and_controls_name_exercises():
    assert set(chosen(["05"])) == {each.id for each in mnclab.exercises(lesson="05")} >= {NAME}
    assert {mnclab.exercise(each).lesson for each in chosen(["12-14"])} == {"12", "13", "14"}
    assert len(set(chosen(["g43"]))) == len(mnclab.exercises("g43"))
    with pytest.raises(Alarm, match="there is no exercise '98'"):
        list(chosen(["98"]))


def test_the_cell_for_nbgrader_gives_part_of_the_marks():
    """nbgrader takes the number that the last line of a cell of tests shows as its marks."""
    *told, last = [line.strip() for line in mnclab.learning.__doc__.split(":\n")[-1].strip().split("\n")]
    for text, marks in ((MODEL, 10), (MODEL.replace("Z-5", "Z-4"), 8), ("", 0)):  # five of seven measures: 7/9 of all
        names = {"mnclab": mnclab, "answer": text}
        exec("\n".join(told), names)
        assert eval(last, names) == marks


PREDICT = """
title = "Where to"
control = "mnc"
level = 1
lesson = "02"
kind = "predict"
task = "Say where."
[given]
program = '''
G90 T1 S500 M3
G0 X10 Y5 Z2
G91 G1 X7 Z-3 F120
G90 Y20
M30
'''
[[questions]]
text = "X after line 3"
what = "x"
line = 3
hints = ["Is line 3 absolute?", "It counts from X10."]
[[questions]]
text = "The feed at the end"
what = "feed"
[[questions]]
text = "The whole way"
what = "length"
line = 1
tolerance = 0.01
"""
DESIGN = "[design.blank]\nlow = [0, 0, -5]\nhigh = [9, 9, 0]\n[[design.features]]\nkind = 'face'\ndepth = 1\n"


def test_predictions_are_looked_up_in_the_run(tmp_path):
    path = tmp_path / "mnc-98.toml"
    path.write_text(PREDICT)
    exercise = load(path)
    way = math.hypot(10, 5, 2) + math.hypot(7, 3) + 15  # from where the machine stands, X0 Y0 Z0
    right = f"1 = 17\n2: 120 mm/min\n3 = {way:.2f} # mm\n"
    assert exercise.check(right).passed and exercise.check(right.replace("17", "17,000")).score == 1
    wrong = exercise.check(right.replace("17", "7"), tried={"question 1": 0})
    assert wrong.score == pytest.approx(2 / 3) and wrong.hints[0].text == "question 1: Is line 3 absolute?"
    assert wrong.hints[0].line == 1
    assert exercise.check(right.replace("17", "7"), tried={"question 1": 2}).hints[0].text.endswith("It counts from X10.")
    assert "not answered" in exercise.check("1 = 17\n").hints[0].text
    for begun in ("1 = 17\n2 =\n3 = \n", "1 = 17 мм\n", "1 = 17\n2 = -120\n".replace("-120", "−120")):
        assert exercise.check(begun).score == pytest.approx(1 / 3)
    for odd in ("X17\n", "1 = 17 kg\n", "1 = 17 cm\n"):
        assert "written as 1 = 12.5" in exercise.check(odd).hints[0].text


RESTART = """
title = "Going on"
control = "mnc"
level = 3
lesson = "10"
kind = "restart"
task = "The tool broke at line 6."
[asked]
time = 1000
[given]
until = 6
program = '''
G17 G90 G54 T1 S1000 M3
G0 X15 Y10 Z5
G1 Z-4 F100
X45 F300
G0 Z5
G0 X15 Y30
G1 Z-4 F100
X45 F300
G0 Z50
M30
'''
[setup.tools.1]
radius = 4
kind = "mill"
cutting_length = 20
[design.blank]
low = [0, 0, -20]
high = [60, 40, 0]
[[design.features]]
kind = "slot"
name = "first"
start = [15, 10]
end = [45, 10]
width = 8
depth = 4
[[design.features]]
kind = "slot"
name = "second"
start = [15, 30]
end = [45, 30]
width = 8
depth = 4
"""


def test_going_on_is_graded_with_what_was_cut_before(tmp_path):
    path = tmp_path / "mnc-97.toml"
    path.write_text(RESTART)
    exercise = load(path)
    rest = "G17 G90 G54 T1 S1000 M3\nG0 X15 Y30 Z5\nG1 Z-4 F100\nX45 F300\nG0 Z50\nM30\n"
    assert exercise.check(rest).passed
    slow = tmp_path / "mnc-93.toml"
    slow.write_text(RESTART.replace("time = 1000", "time = 20"))
    again = rest.replace("G0 X15 Y30 Z5", "G0 X15 Y10 Z5\nG1 Z-4\nX45\nZ5\nG0 X15 Y30")
    assert load(slow).check(rest).passed and not load(slow).check(again).passed  # what is there already is cut again
    assert not exercise.check(rest.replace("S1000 M3", "")).passed  # what the first program had started does not go on by itself
    through = exercise.check(rest.replace("G0 X15 Y30 Z5", "G0 X15 Y10 Z-4\nG0 X45\nZ5\nX15 Y30"))
    assert through.passed  # a rapid through the slot that is there already meets nothing
    assert not exercise.check(rest.replace("G0 X15 Y30 Z5", "G0 X15 Y20 Z-4\nG0 X15 Y30 Z5")).passed
    path.write_text(RESTART.replace("[design.blank]", "[setup.tools.2]\nlength = 40\n[design.blank]"))
    nothing = rest.replace("T1 S1000 M3\n", "T2 S1000 M3\nG0 X15 Y10 Z5\nG1 Z-4 F100\nX45\nG0 Z5\nT1\n")
    assert "T2 has no radius: it cuts nothing" in " ".join(map(str, load(path).check(nothing).hints))
    idle = exercise.check("G17 G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5\nM30\n")
    assert idle.score == 0 and idle.hints[0].text == "nothing is cut that was not cut before"
    slow.write_text(RESTART.replace("depth = 4", "depth = 5", 1))
    deep = load(slow).check(rest)
    (wrong,) = {row.where for row in deep.measures if not row.ok}
    assert wrong.startswith("the given program:") and [hint.line for hint in deep.hints] == [0]


SETUP = RESTART.replace('"restart"', '"set up"').replace("until = 6\n", "").replace("radius = 4", "radius = 3")


def test_tables_are_answers(tmp_path):
    path = tmp_path / "mnc-96.toml"
    path.write_text(SETUP)
    exercise = load(path)
    assert exercise.check("[tools.1]\nradius = 4\nkind = 'mill'\ncutting_length = 20\n").passed
    assert not exercise.check("[tools.1]\nradius = 3\nkind = 'mill'\n").passed
    assert "no table 'stock'" in exercise.check("[stock]\nradius = 4\n").hints[0].text
    assert exercise.check("[tools.1\n").hints[0].line == 1
    opened = exercise.check("[datums]\n1 = [10, 20, 0\n2 = [1, 2, 3]\n[tools.1]\nradius = 4\n")
    assert str(opened.hints[0]) == "line 2: the bracket is not closed"
    assert exercise.check("radius = ").score == 0


STRATEGY = RESTART.replace('"restart"', '"strategy"').replace("until = 6\n", "").split("[design.blank]")[0] + """
[asked.strategy]
engagement = 95
[design.blank]
low = [0, 0, -20]
high = [60, 40, 0]
[[design.features]]
kind = "pocket"
name = "pocket"
x = 30
y = 20
length = 40
width = 26
corner = 5
depth = 4
"""


def test_a_strategy_is_tried_on_the_pocket(tmp_path):
    path = tmp_path / "mnc-95.toml"
    path.write_text(STRATEGY.replace("[asked]\ntime = 1000\n", ""))
    exercise = load(path)
    assert exercise.check('strategy = "adaptive"\nstepover = 2.5\n').passed
    zigzag = exercise.check('strategy = "zigzag"\nstepover = 4\n')
    assert not zigzag.passed and zigzag.points["part"] == 1 and zigzag.score == pytest.approx(0.2)
    told = zigzag.hints[0].text
    found = re.fullmatch(r"on 95 % of the way the tool is engaged by up to (\S+) degrees, 95 at most are allowed", told)
    assert float(found[1]) > 95
    assert str(exercise.check('strategy = "rings"\nstepover = 1,5\n').hints[0]) == "line 2: a number has a point: write 1.5"
    assert all(name in exercise._repr_html_() for name in ("adaptive", "morphed spiral", "rounded zigzag"))
    rings = 'strategy = "rings"\n'
    for wrong in ('strategy = "zag"', "strategy = 5", "stepover = 2", f"{rings}stepover = -1", f"{rings}tool = 9"):
        assert exercise.check(wrong).score == 0


VARY = '[vary]\n"first.depth" = [3, 6, 1]\n"second.width" = [8, 12, 2]\n'


def test_neighbours_have_other_dimensions_and_the_name_alone_tells_them(tmp_path):
    path = tmp_path / "mnc-94.toml"
    path.write_text(RESTART.split("[design.blank]")[0] + VARY + "[design.blank]" + RESTART.split("[design.blank]")[1])

    def sizes(pupil):
        first, second = load(path, pupil).design.features
        return first.depth, second.width

    drawn = {name: sizes(name) for name in "anna boris clara dmitri elena florin galina horia".split()}
    assert len(set(drawn.values())) > 3 and all(3 <= a <= 6 and b in (8, 10, 12) for a, b in drawn.values())
    assert sizes("Андрей") == sizes(unicodedata.normalize("NFD", "Андрей"))
    assert sizes("anna") == sizes(" ANNA ") == drawn["anna"] and sizes("") == (4, 8)
    path.write_text(path.read_text().replace("first.depth", "third.depth"))
    with pytest.raises(Alarm, match="the design has no 'third.depth'"):
        load(path)


def test_progress_keeps_the_best_and_counts_faults(tmp_path):
    path = tmp_path / "progress.json"
    done, exercise = Progress(path), mnclab.exercise(NAME)
    for text in (MODEL.replace("Z-5", "Z-4"), MODEL, MODEL.replace("Z-5", "Z-4")):
        done.record(exercise.check(text))
    again = Progress(path)
    assert again.done[NAME]["passed"] and again.done[NAME]["score"] == 1 and again.done[NAME]["tries"] == 3
    assert again.tried(NAME) == {"pocket depth": 2}
    shown = again._repr_html_()
    assert f"{NAME} ✓" in shown and ">Radius compensation</td>" in shown and "○ not tried" in shown
    assert shown.count("<td") == shown.count("text-align:left") == 3 * (1 + len({each.lesson for each in mnclab.exercises()}))
    record = '{"mnc-07": {"score": %s, "passed": false, "tries": %s, "faults": {"stopped": %s}}}'
    damaged = [record % each for each in ((0.5, 1, '"x"'), ("NaN", 1, 1), (0.5, -5, 1), (2, 1, 1), (0.5, 1, "Infinity"))]
    for spoilt in (*damaged, "", "[]", '{"mnc-07": 5}', "\x00", "[" * 100_000):
        path.write_text(spoilt)
        assert Progress(path).done == {}


def test_the_help_of_an_exercise_is_one_that_is_ready(tmp_path):
    (tmp_path / "mine.toml").write_text(str(mnclab.help("exercise")))
    assert missing(tmp_path / "mine.toml") == []
    assert "[[features]]" in mnclab.help("design")._repr_html_()


def test_the_shell_grades_exercises_of_ones_own_and_keeps_tables_apart(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "mine.toml").write_text(mnclab.exercise(NAME).file.read_text("utf-8"), "utf-8")
    (tmp_path / "class" / "anna").mkdir(parents=True)
    for path in ("mine.mnc", "class/anna/mine.mnc"):
        (tmp_path / path).write_text(MODEL)
    assert shell.main(["grade", "mine.mnc", "--exercises", "own"]) == 0 and "passed" in capsys.readouterr().out
    assert shell.main(["grade", "class"]) == 1 and "--exercises mine.toml" in capsys.readouterr().err
    with pytest.raises(SystemExit, match="2"):
        shell.main(["grade", "class", "--exercises", "own", "--json", "--csv"])
    assert "only one of --csv and --json goes to stdout" in capsys.readouterr().err
    assert shell.main(["grade", "class", "--exercises", "own", "--json", "--csv", "marks.csv"]) == 0
    assert json.loads(capsys.readouterr().out)[0]["passed"] and "anna,mine,100%" in (tmp_path / "marks.csv").read_text("utf-8")


def test_the_shell_lists_shows_checks_and_grades(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert shell.main(["exercise", "list", "--control", "mnc"]) == 0 and NAME in capsys.readouterr().out
    assert shell.main(["exercise", "show", NAME]) == 0 and "Mill the pocket" in capsys.readouterr().out
    assert shell.main(["exercise", "show", NAME, "--answers"]) == 0
    assert MODEL in (told := capsys.readouterr().out) and "touches two walls" in told
    assert shell.main(["help", "exercise"]) == 0 and "[[faults]]" in capsys.readouterr().out
    (tmp_path / "mnc-07.mnc").write_text(MODEL.replace("G40 ", ""))
    assert shell.main(["grade", "mnc-07.mnc"]) == 1 and "compensation on" in capsys.readouterr().out
    (tmp_path / "a.mnc").write_text(MODEL)
    assert shell.main(["grade", "a.mnc", "--exercise", NAME, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found == {"exercise": NAME, "score": 1.0, "passed": True, "points": dict.fromkeys(("part", "safety", "asked"), 1.0),
                     "hints": [], "faults": []}  # fmt: skip
    (tmp_path / "bad.toml").write_text(RESTART.replace('lesson = "10"\n', ""))
    assert shell.main(["exercise", "check", "bad.toml"]) == 1 and "needs lesson" in capsys.readouterr().err
    (tmp_path / "half.toml").write_text(RESTART + "\n[model]\nanswer = 'G0 X1'\n")
    assert shell.main(["exercise", "check", "half.toml"]) == 1
    told = capsys.readouterr().out
    assert "the model gets" in told and "0 faults, 3 are needed" in told and "no right answer of another make" in told


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("level = 3", "level = 6"), "level must be 1 to 5"),
        (('kind = "restart"', 'kind = "sing"'), "kind must be write"),
        (("until = 6", "until = 'x'"), "until must be a number"),
        (("until = 6", ""), "until, the line at which the tool broke"),
        (("time = 1000", "time = 0"), "time must be greater than 0"),
        (("time = 1000", "thyme = 1"), "asked has no 'thyme'"),
        (("time = 1000", "must = 'G41'"), "must must be a list of codes"),
        (("time = 1000", "values = { Q5 = 3 }"), r"Q5 must be \[least, greatest\]"),
        (("radius = 4", "radius = -4"), "radius"),
        (('kind = "slot"', 'kind = "slit"'), "slit"),
    ],
)
def test_a_teachers_slip_is_named_at_its_line(tmp_path, change, says):
    path = tmp_path / "mnc-93.toml"
    path.write_text(RESTART.replace(*change, 1))
    with pytest.raises(Alarm, match=says) as found:
        load(path)
    assert found.value.span is not None and found.value.source.name == str(path)


def test_a_plan_shows_its_weeks_and_what_comes_next(tmp_path):
    done = Progress(tmp_path / "progress.json", "mnc_mill")
    assert "next: week 1, lesson 00, mnc-17" in repr(done) and len(done.plan) == 36
    for name in ("mnc-17", "mnc-01", "mnc-18"):
        done.done[name] = {"score": 1.0, "passed": True, "tries": 1, "faults": {}}
    page = unescape(done._repr_html_())
    assert page.count("<tr>") == 1 + 36 and "mnc-18 ✓" in page and "next: week 2, lesson 01, mnc-02" in page
    assert not re.search(r"\]\(|`|\*\*", page)
    for row in done.plan:
        done.done |= {name: {"score": 1.0, "passed": True, "tries": 1, "faults": {}} for name in row.exercises}
    assert "the plan is done" in repr(done) and "next" not in repr(Progress(tmp_path / "progress.json"))
    for unknown in ("mill", "marks", ""):
        with pytest.raises(Alarm, match="plan must be jnc_lathe, mnc_mill, nc31_lathe or tnc_mill"):
            mnclab.progress(plan=unknown)


def test_the_map_has_the_order_of_the_course(tmp_path):
    lessons = re.findall(r"<tr><td[^>]*>(\d\d)<", Progress(tmp_path / "progress.json")._repr_html_())
    assert sorted(lessons) == sorted({each.lesson for each in mnclab.exercises()})
    assert lessons.index("33") == lessons.index("08") + 1 and lessons.index("21") < lessons.index("12") < lessons.index("09")


def test_a_class_gets_a_folder_a_name_and_is_graded_by_it(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "names.txt").write_text("Anna\n\nBoris Ș.\r\n".replace(" Ș.", "ka Ș"), "utf-8")
    assert shell.main(["exercise", "give", NAME, "mnc-02", "-o", "class", "--pupils", "names.txt"]) == 0
    assert {each.name for each in (tmp_path / "class").iterdir()} == {"Anna", "Boriska Ș"}
    assert len({(path / f"{NAME}.html").read_text("utf-8") for path in (tmp_path / "class").iterdir()}) == 2
    for bad in ("../Anna", "a:b", "Anna\nBoris\nanna"):
        (tmp_path / "names.txt").write_text(bad, "utf-8")
        with pytest.raises(SystemExit):
            shell.main(["exercise", "give", NAME, "-o", "other", "--pupils", "names.txt"])
        assert "name" in capsys.readouterr().err and not (tmp_path / "other").exists()


# --- the teacher's pages ---------------------------------------------------------------------------------------------


def test_the_teachers_pages_have_answers_and_usual_faults_of_a_lessons_exercises(tmp_path):
    from mnclab.shell.handout import answers, teachers

    page = unescape(teachers("05"))
    for each in mnclab.exercises(lesson="05"):
        found = answers_of(each.file)
        assert found.model.strip() in page and found.why in page
        assert all(f"the hint says: {fault.hint}" in page for fault in found.faults)
    assert page.index("Aim.") < page.index("minutes") < page.index(mnclab.exercises(lesson="05")[0].title)
    copy = tmp_path / "mnc-07.toml"
    copy.write_text(pupils_copy(mnclab.exercise("mnc-07").file), "utf-8")
    with pytest.raises(Alarm, match="no solution"):
        answers(load(copy))


def test_the_teachers_page_begins_with_aim_time_and_what_to_show():
    from mnclab.shell.handout import plan

    head = "**What you will do.** Turn a pin.\n\n**What you will learn.** `G96`.\n\n**What you need.** *Arcs*; 40 minutes."
    cells = [{"source": ["# Pins\n", "\n", "Why?"]}, {"source": ["import mnclab"]}, {"source": head.splitlines(keepends=True)}]
    aim, time, *rest = plan({"cells": cells, "metadata": {}})
    assert aim == "**Aim.** Turn a pin.\n\n**They learn.** `G96`." and "40 minutes" in time and "45 minutes" in time and not rest
    *_, show = plan({"cells": cells, "metadata": {"teacher": ["Stop at cell 3.", "Ask why."]}})
    assert show == "**What to show.**\n\n- Stop at cell 3.\n- Ask why."

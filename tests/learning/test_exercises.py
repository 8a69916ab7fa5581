"""Every exercise of the house: ready, its mutants rejected, its answers apart."""

import re
from collections import Counter
from pathlib import Path

import pytest
from learning.mutants import judged
from tools.together import deep_but_one_in

import mnclab
from mnclab.learning.answers import answers_of, pupils_copy
from mnclab.learning.authoring import missing
from mnclab.learning.exercise import files

ROOT = Path(__file__).parents[2]
FILES = files()
SOME = 3  # mutants an exercise in everyday runs


@pytest.mark.parametrize("name", deep_but_one_in(8, list(FILES)))
def test_an_exercise_is_ready(name):
    assert missing(FILES[name]) == []


@pytest.mark.deep
@pytest.mark.parametrize("name", list(FILES))
def test_seeded_mutants_are_rejected(name):
    exercise = mnclab.exercise(name)
    if exercise.answer != "program":
        pytest.skip("its answers are no programs")
    changed, passed, _ = judged(exercise, answers_of(exercise.file).model, SOME)
    assert len(passed) <= 1, passed


def test_ids_controls_and_lessons_are_those_of_the_course():
    for name, path in FILES.items():
        exercise = mnclab.exercise(name)
        assert name.startswith(f"{exercise.control}-") and path.parent.name == exercise.control
        assert exercise.lesson.isdigit() and len(exercise.lesson) == 2
    assert "mnc-07" in repr(mnclab.exercises("mnc", level=2, lesson="05"))


def test_the_set_is_that_of_the_course():
    """Three at the end of every lesson, which names them, and six of each kind."""
    found = mnclab.exercises()
    assert all(count >= 6 for count in Counter(each.kind for each in found).values())
    for lesson in sorted((ROOT / "notebooks").glob("*.ipynb")):
        own, text = [each.id for each in found if each.lesson == lesson.name[:2]], lesson.read_text("utf-8")
        assert len(own) >= 3 and all(f"`{id}`" in text for id in own), lesson.name


def test_no_copy_for_pupils_has_a_block_of_an_answer():
    for path in FILES.values():
        copy, answers = pupils_copy(path), answers_of(path)
        given = mnclab.exercise(path)
        if given.answer != "program":  # a table of tools repeats what the task says that was measured
            continue
        shown = given.template + given.program
        for text in (answers.model, answers.other, *(each for fault in answers.faults for each in fault.edits.values())):
            lines = [line.strip() for line in text.split("\n") if len(line.strip()) > 10]
            assert not [line for line in lines if line in copy and line not in shown], path
        assert answers.why == "" or answers.why not in copy


def test_dimensions_that_make_no_part_for_some_pupils_are_missed(tmp_path):
    """A chamfer stands on the edge of a stud of 100 x 70; beside another one it has material on both sides, or on none."""
    text = FILES["mnc-14"].read_text("utf-8")
    file = tmp_path / "mnc-14.toml"
    ranges = '[vary]\n"shoulder.length" = [94, 102, 2]\n"shoulder.width" = [64, 72, 2]\n'
    file.write_text(text.replace("[vary]\n", ranges, 1), "utf-8")
    assert [each for each in missing(file) if each.startswith("[vary]: ") and "chamfer" in each]


def test_a_lesson_that_is_none_and_a_dimension_of_one_pupil_in_the_task_are_missed(tmp_path):
    text, file = FILES["nc-31-03"].read_text("utf-8"), tmp_path / "nc-31-03.toml"
    text = re.sub('lesson = "[0-9]+"', 'lesson = "77"', text).replace('task = """', 'task = """The step is 22 mm long.')
    file.write_text(text, "utf-8")
    said = missing(file)
    assert said == ["there is no lesson 77", "[vary]: z -22 is a pupil's own, and the task names 22"]


def test_tools_that_the_cabinet_does_not_have_are_refused():
    """An insert with more room behind comes down the slope as well, and there is none."""
    exercise = mnclab.exercise("nc-31-21")
    text = exercise.solution()
    grade = exercise.check(text.replace("auxiliary_angle = 52", "auxiliary_angle = 60"))
    assert not grade.passed and grade.points["part"] == 1.0 and grade.hints[0].line == text.split("\n").index("[tools.1]") + 1
    assert "tool 1 is none of those in the cabinet" in grade.hints[0].text

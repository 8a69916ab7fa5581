"""What a teacher's file still needs: the model passes, another answer does, the faults do not and get their hints."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from mnclab.learning.answers import Answers, answers_of, pupils_copy
from mnclab.learning.asked import length
from mnclab.learning.exercise import LESSONS, Exercise
from mnclab.learning.exercise_file import load
from mnclab.learning.grading import ECONOMY_FROM
from mnclab.learning.neighbours import told
from mnclab.text.alarm import Alarm
from mnclab.text.file import parse

FAULTS = 3
LAST = 9  # tries: the whole help is told
SLACK = 1.02  # what is stated for economy, at least, against the model's own
PUPILS = "abcdefghijklmnop"  # names from which dimensions are drawn, to see that all of them fit
SHORT = 6  # letters of a line that many answers share


def missing(path: str | Path) -> list[str]:
    """What an exercise lacks, in sentences; an empty list where it is ready. An Alarm where its file cannot be read."""
    exercise = load(path)
    return [*_of(exercise, answers_of(Path(path)), Path(path))]


def _of(exercise: Exercise, answers: Answers, path: Path) -> Iterator[str]:
    if exercise.design is not None:
        try:
            exercise.drawing()
        except Alarm as alarm:
            yield f"the drawing cannot be made: {alarm.message}"
    if LESSONS.is_dir() and not any(LESSONS.glob(f"{exercise.lesson}*.ipynb")):
        yield f"there is no lesson {exercise.lesson}"
    yield from parse(path, lambda table, _: dict.fromkeys(told(table)), "exercise")
    for pupil in PUPILS:
        try:
            load(path, pupil)
        except Alarm as alarm:
            yield f"[vary]: the dimensions of some pupils make no part: {alarm.message}"
            break
    yield from _right("the model", exercise, answers.model)
    if not answers.other.strip():
        yield "there is no right answer of another make: [other] answer"
    else:
        yield from _right("the other answer", exercise, answers.other)
        if _lines(answers.other) == _lines(answers.model):
            yield "the other answer is the model"
    if exercise.template.strip() and exercise.check(exercise.template).passed:
        yield "the template passes as it is"
    if len(answers.faults) < FAULTS:
        yield f"there are {len(answers.faults)} faults, {FAULTS} are needed: [[faults]]"
    for number, fault in enumerate(answers.faults, 1):
        wrong = fault.of(answers.model)
        grade = exercise.check(wrong, tried=dict.fromkeys(exercise.check(wrong).faults, LAST))
        said = " | ".join(hint.text for hint in grade.hints)
        if grade.passed:
            yield f"fault {number} passes"
        elif fault.hint.lower() not in said.lower():
            yield f"fault {number}: no hint says {fault.hint!r}, but: {said}"
    if bool(exercise.why) != bool(answers.why):
        yield "a question why needs its answer, [model] why, and the other way round"
    yield from _economy(exercise, answers)
    copy = pupils_copy(path)
    shared = [line for line in _lines(answers.model) if len(line) > SHORT and line in _lines(copy.replace(exercise.template, ""))]
    if shared and exercise.kind not in ("predict",) and not exercise.program:
        yield f"the pupil's copy shows a line of the model: {shared[0]}"


def _right(what: str, exercise: Exercise, text: str) -> Iterator[str]:
    grade = exercise.check(text)
    if not grade.passed or grade.score < 1:
        said = " | ".join(map(str, grade.hints))
        yield f"{what} gets {grade.score:.0%}{'' if grade.passed else ' and does not pass'}: {said}"


def _economy(exercise: Exercise, answers: Answers) -> Iterator[str]:
    """Limits of time and length are needed from level 3 on, of programs, and the model is within them with some slack."""
    if exercise.answer != "program" or exercise.level < ECONOMY_FROM or exercise.design is None:
        return
    if exercise.asked.time is None and exercise.asked.length is None:
        yield f"from level {ECONOMY_FROM} on economy counts: [asked] time or length"
        return
    run = exercise.check(answers.model).run
    have = {"time": run.profile().time, "length": length(run)} if run is not None else {}
    for name, value in have.items():
        stated = getattr(exercise.asked, name)
        if stated is not None and stated < SLACK * value:
            yield f"{name} is {stated:g}, the model needs {value:.1f}: leave some slack"


def _lines(text: str) -> list[str]:
    """The lines of a text without block numbers and spaces."""
    return [re.sub(r"^N\d+|\s", "", line) for line in text.split("\n") if line.strip()]

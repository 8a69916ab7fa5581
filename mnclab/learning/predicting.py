"""Predictions: numbers that are said before a program runs, and then looked up in its run."""

from __future__ import annotations

import re
from collections.abc import Mapping

from mnclab.learning.answered import given_run
from mnclab.learning.asked import length
from mnclab.learning.exercise import Exercise, Question
from mnclab.learning.findings import ASKED, STOPPED, Finding, hints_of
from mnclab.learning.grade import Grade
from mnclab.runs.material import truly_higher
from mnclab.runs.run import Run
from mnclab.text.given import shown

ANSWER = re.compile(r"^[ \t]*(\d{1,3})[ \t]*[=:][ \t]*([+-]?\d{1,12}(?:[.,]\d{0,12})?)[ \t]*([^\s#;]{0,9})[ \t]*(?:[#;].*)?$")
EMPTY = re.compile(r"^[ \t]*\d{1,3}[ \t]*[=:][ \t]*$")
UNITS = "mm мм mm/min мм/мин mm/rev rev/min об/мин s с ° deg".split()


def numbers_of(text: str) -> tuple[dict[int, tuple[float, int]], list[Finding]]:
    """Numbers and their lines by questions, a line each: `1 = 12.5`, and what is wrong with lines that are none of these;
    comments (#, ;) are left out."""
    found, wrong = {}, []
    for number, line in enumerate(text.split("\n"), 1):
        if not line.strip() or line.strip()[0] in "#;" or EMPTY.match(line):
            continue
        said = ANSWER.match(line.replace("−", "-"))  # the sign that print has
        if said is None or (said[3] and said[3].lower() not in UNITS):
            told = f"an answer is written as 1 = 12.5, in digits and a point, got {shown(line.strip()[:40])}"
            wrong.append(Finding(STOPPED, f"line {number}", number, (told,)))
        else:
            found[int(said[1])] = float(said[2].replace(",", ".")), number
    return found, wrong


def value_of(question: Question, run: Run) -> float:
    """What is right: mm in the coordinates of the program, as the control counts or ("tip z") where the tip truly is;
    the feed as it is programmed, mm/min or mm a revolution; rev/min, s."""
    if question.what == "length":
        return length(run)
    if question.what == "time":
        profile = run.profile()
        return float(profile.time if question.line is None else profile.time_by("line").get(question.line, 0.0))
    moment = run.at(question.line) if question.line is not None else run.at(step=len(run.steps.block) - 1)
    if question.what[-1] in "xyz":
        tip, axis = question.what.startswith("tip"), "xyz".index(question.what[-1])
        place = moment.point if tip else moment.position
        return float(place[axis]) + (truly_higher(run, moment.step) if tip and axis == 2 else 0.0)
    value = moment.state.get(question.what, 0.0)
    return float(getattr(value, "number", value))


def predicted(exercise: Exercise, text: str, tried: Mapping[str, int]) -> Grade:
    """The grade of predictions: the share that is right."""
    (said, findings), run = numbers_of(text), given_run(exercise)
    for number, question in enumerate(exercise.questions, 1):
        if number in said and abs(said[number][0] - value_of(question, run)) <= question.tolerance:
            continue
        told = f"question {number} is not answered" if number not in said else f"question {number}: another number"
        steps = (told, *(f"question {number}: {each}" for each in question.hints))
        steps = steps if number not in said else steps[1:] or steps
        line = max((said[k][1] for k in said if k == number or (k < number and number not in said)), default=0)
        findings.append(Finding(ASKED, f"question {number}", line, steps))
    share = 1 - sum(each.rank == ASKED for each in findings) / len(exercise.questions)
    hints, faults = hints_of(findings, tried)
    return Grade(exercise.id, share, not findings, {"asked": share}, hints, faults, run=run)

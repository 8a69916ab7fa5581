"""Mutants of a right answer: one word changed, one block left out. Which of them change the part or its safety, and which pass?

    python tests/learning/mutants.py FILE [FILE ...]     all mutants of exercises, and those that pass though they should not

Whether a mutant changes anything is judged without the grade: by the heights or the section of what is left, its volume,
alarms and collisions, against those of the model. A strategy cuts no part: one that meets all numbers of its task is right.
"""

import random
import re
import sys
from pathlib import Path

import numpy as np

import mnclab
from mnclab.learning.answered import run_of
from mnclab.learning.answers import answers_of
from mnclab.learning.exercise_file import load
from mnclab.learning.restarting import collisions_of, part_of

UNIT = {"nc-31": 100}  # what 1 mm is in the numbers of a program
NUMBER = r"([-+]?\d*\.?\d+)"
SWAPS = [
    ("G2", "G3"), ("G02", "G03"), ("DR+", "DR-"), ("G41", "G42"), ("RL", "RR"), ("G1", "G0"), ("G01", "G00"), ("M3", "M4"),
    ("M03", "M04"),
]  # fmt: skip


def mutants(text, control, tolerance=0.05):
    """(what was done, line, text) for every mutant of an answer."""
    lines, unit = text.split("\n"), UNIT.get(control, 1)

    def with_line(k, new):
        return "\n".join([*lines[:k], *([] if new is None else [new]), *lines[k + 1 :]])

    for k, line in enumerate(lines):
        if not line.strip():
            continue
        yield "block left out", k + 1, with_line(k, None)
        words = r"=|\[|," if re.match(r"\w+ *= ", line) else r"(?<![A-Z])(?:[XYZUWIJKR]|CC X|Q20[1-9]=|Q2[12]\d=)"  # or a table
        for found in re.finditer(rf"({words})\s*{NUMBER}", line):
            for off in (1, -1, 1.5 * tolerance):
                value = float(found[2]) + off * unit
                said = f"{value:+.4f}".rstrip("0").rstrip(".") if found[2][0] in "+-" else f"{value:.4f}".rstrip("0").rstrip(".")
                new = line[: found.start(2)] + said + line[found.end(2) :]
                yield f"{found[0]} by {off:g}", k + 1, with_line(k, new)
        for one, other in [*SWAPS, *((b, a) for a, b in SWAPS)]:
            if re.search(rf"(?<![A-Z]){re.escape(one)}(?![\d.])", line):
                new = re.sub(rf"(?<![A-Z]){re.escape(one)}(?![\d.])", other, line, count=1)
                yield f"{other} for {one}", k + 1, with_line(k, new)
        for word in (r"S\d+", r"M0?3(?!\d)", r"G4[12]", r"\bR[LR]\b", r"FMAX", r"(?<![A-Z])G0?0(?!\d)"):
            if re.search(word, line):
                yield f"without {word}", k + 1, with_line(k, re.sub(word, "", line, count=1))
        for tool in re.finditer(r"(?:TOOL CALL |(?<![A-Z])T)(\d+)", line):
            new = line[: tool.start(1)] + str(int(tool[1]) + 1) + line[tool.end(1) :]
            yield "another tool", k + 1, with_line(k, new)


def state_of(exercise, text):
    """(the run stops, collisions, what is left as numbers, volume) of an answer; None for the last two where it has no part."""
    try:
        run = run_of(exercise, text)
    except Exception:
        return True, 0, None, None
    if not run.ok or run.reach or not run.toolpath.is_motion.any() or run.stock is None:
        return True, 0, None, None
    part = part_of(exercise, run)
    shape = part.heights if hasattr(part, "heights") else None
    return False, len(collisions_of(exercise, run)), shape, part.volume


def changes(exercise, model, mutant):
    """Whether part or safety are other than the model's by more than the tolerance."""
    stops, collisions, shape, volume = state_of(exercise, mutant)
    if stops:
        return True
    if collisions != model[1] or abs(volume - model[3]) > 1e-6 * model[3]:
        return True
    if shape is not None:
        return bool(shape.shape != model[2].shape or np.abs(shape - model[2]).max() > 1e-6)
    return False


def commands_of(exercise, text):
    """Line -> first and last line of its command, where one command stands in several lines; of tables, of its table."""
    if exercise.answer == "setup":
        rows = text.split("\n")
        heads = [k for k, row in enumerate(rows, 1) if row.startswith("[")] + [len(rows) + 1]
        return {k: (first, after - 1) for first, after in zip(heads, heads[1:]) for k in range(first, after)}
    if exercise.answer != "program":
        return {}
    lines = [[word.span.line for word in block.words] for block in mnclab.read(text, exercise.control)]
    return {k: (min(each), max(each)) for each in lines for k in each}


def judged(exercise, text, some=None, seed=0):
    """(mutants that change something, those of them that pass, those whose hints name neither the line nor a neighbour)."""
    model = state_of(exercise, text)
    every = list(mutants(text, exercise.control, exercise.tolerance))
    if some is not None:
        every = random.Random(seed).sample(every, min(some, len(every)))
    changed, passed, unnamed = [], [], []
    commands = commands_of(exercise, text)
    for what, line, mutant in every:
        grade = exercise.check(mutant)
        if grade.passed:
            if exercise.answer != "strategy" and changes(exercise, model, mutant):
                changed.append((what, line))
                passed.append((what, line))
            continue
        changed.append((what, line))
        first, last = commands.get(line, (line, line))
        named = [int(line) for hint in grade.hints for line in re.findall(r"line (\d+)", str(hint))]
        if not any(first - 1 <= each <= last + 1 for each in named):
            unnamed.append((what, line, grade.hints))
    return changed, passed, unnamed


if __name__ == "__main__":
    for name in sys.argv[1:]:
        exercise = load(Path(name))
        changed, passed, unnamed = judged(exercise, answers_of(Path(name)).model)
        rejected, named = (1 - len(some) / max(1, len(changed)) for some in (passed, unnamed))
        counted = f"{len(changed)} mutants change something"
        print(f"{exercise.id}: {counted}, {rejected:.1%} are rejected, the line of {named:.0%} is named")
        for what, line in passed:
            print(f"  passes: line {line}, {what}")
        for what, line, hints in unnamed:
            print(f"  not named: line {line}, {what}: {' | '.join(map(str, hints))}")

"""Going on after a broken tool: the rows of an answer cut what the program before them had left.

Lines of that program are told apart: it is the first of the `programs` beyond those of the answer.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from mnclab.learning.answered import given_run
from mnclab.learning.exercise import Exercise
from mnclab.path.toolpath import COLUMNS
from mnclab.runs.material import cutting_of
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm
from mnclab.workpiece.collision import Collisions
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.collisions import collisions_of as collisions_of_mill
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.turning.collisions import collisions_of as collisions_of_lathe
from mnclab.workpiece.turning.turned import Turned
from mnclab.workpiece.workpiece import Workpiece

NOTHING = 1e-6  # mm³


@cache
def before_of(exercise: Exercise) -> Cutting:
    """What the program that is given had cut, up to the line at which its tool broke."""
    run = given_run(exercise)
    return cutting_of(run).until(run.at(exercise.until).rows.stop - 1)


def cutting_after(exercise: Exercise, run: Run) -> Cutting:
    """The rows before and those of the answer, each with its tools; the answer's tool comes from where the machine stands."""
    first, then = before_of(exercise), cutting_of(run)
    early, late, programs = first.path, then.path, len(run.programs)

    def place(line: int, program: int) -> str:
        return f"the given program:{line}" if program >= programs else run.place_of_line(line, program)

    def both(name: str, column: Any) -> Any:
        ahead = getattr(early, name) + programs * (name == "program")
        return np.concatenate([ahead * (name != "label"), column])  # labels are those of the answer

    path = late.replace(**{name: both(name, getattr(late, name)) for name in COLUMNS})
    rows = len(early)
    which = np.concatenate([first.which, then.which + len(first.tools)])
    directions = np.concatenate([_directions(first), _directions(then)])
    arrived, known = rows + then.arrived, rows + then.known
    tools = [*first.tools, *then.tools]
    return replace(then, path=path, tools=tools, which=which, directions=directions, arrived=arrived, known=known,
                   name=place)  # fmt: skip


def _directions(cutting: Cutting) -> Any:
    up = np.broadcast_to([0.0, 0.0, 1.0], (len(cutting), 2, 3))
    return up if cutting.directions is None else cutting.directions


def part_of(exercise: Exercise, run: Run) -> Workpiece:
    """What is left of the blank; of an answer that goes on, of what the program before it had left, an Alarm where it is all
    still there."""
    if exercise.until is None:
        return run.workpiece()
    cutting, before = cutting_after(exercise, run), before_of(exercise)
    kind: Any = Turned if cutting.lathe else Milled
    part: Workpiece = kind(cutting, None, None)
    if part.volume > kind(before, None, None).volume - NOTHING:
        raise Alarm("nothing is cut that was not cut before")
    return part


def collisions_of(exercise: Exercise, run: Run) -> Collisions:
    """What an answer meets; in a part that another program has begun, what its own rows meet."""
    if run.stock is None:
        return Collisions()
    if exercise.until is None:
        return run.collisions()
    cutting, before = cutting_after(exercise, run), len(before_of(exercise))
    found = collisions_of_lathe(cutting, None) if cutting.lathe else collisions_of_mill(cutting, None)
    return Collisions((each for each in found if each.row >= before), (*found.notes, *cutting_of(run).bare_told()))

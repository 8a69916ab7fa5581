"""Going on after a broken tool: the rows of an answer cut what the program before them had left."""

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
from mnclab.workpiece.collision import Collisions
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.collisions import collisions_of as collisions_of_mill
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.turning.collisions import collisions_of as collisions_of_lathe
from mnclab.workpiece.turning.turned import Turned
from mnclab.workpiece.workpiece import Workpiece


@cache
def before_of(exercise: Exercise) -> Cutting:
    """What the program that is given had cut, up to the line at which its tool broke."""
    run = given_run(exercise)
    return cutting_of(run).until(run.at(exercise.until).rows.stop - 1)


def cutting_after(exercise: Exercise, run: Run) -> Cutting:
    """The rows before and those of the answer, each with its tools; the answer's tool comes from where the machine stands."""
    first, then = before_of(exercise), cutting_of(run)
    early, late = first.path, then.path

    def both(name: str, column: Any) -> Any:
        ahead = np.zeros_like(getattr(early, name)) if name == "label" else getattr(early, name)  # labels are those of the answer
        return np.concatenate([ahead, column])

    path = late.replace(**{name: both(name, getattr(late, name)) for name in COLUMNS})
    rows = len(early)
    which = np.concatenate([first.which, then.which + len(first.tools)])
    tilted = np.concatenate([_mask(first), _mask(then)])
    arrived, known = rows + then.arrived, rows + then.known
    tools = [*first.tools, *then.tools]
    return replace(then, path=path, tools=tools, which=which, tilted=tilted, arrived=arrived, known=known)


def _mask(cutting: Cutting) -> Any:
    return np.zeros(len(cutting), dtype=bool) if cutting.tilted is None else cutting.tilted


def part_of(exercise: Exercise, run: Run) -> Workpiece:
    """What is left of the blank; of an answer that goes on, of what the program before it had left."""
    if exercise.until is None:
        return run.workpiece()
    cutting = cutting_after(exercise, run)
    return Turned(cutting, None, None) if cutting.lathe else Milled(cutting, None, None)


def collisions_of(exercise: Exercise, run: Run) -> Collisions:
    """What an answer meets; in a part that another program has begun, what its own rows meet."""
    if run.stock is None:
        return Collisions()
    if exercise.until is None:
        return run.collisions()
    cutting, before = cutting_after(exercise, run), len(before_of(exercise))
    found = collisions_of_lathe(cutting, None) if cutting.lathe else collisions_of_mill(cutting, None)
    return Collisions((each for each in found if each.row >= before), (*found.notes, *cutting_of(run).bare_told()))

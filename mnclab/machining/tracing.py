"""Steps as a tool path, without a machine: what strategies are compared by, and a path without a program.

A contour gives as many rows as it has elements; a move that leads nowhere gives none, nor does a step that moves no axis.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from mnclab.geometry.curves import Floats
from mnclab.machining.steps import Along, Dip, Go, Step, Turn
from mnclab.path.toolpath import Kind, Toolpath

SAME = 1e-9  # mm


def traced(steps: Iterable[Step], start: Sequence[float], radius: float) -> Toolpath:
    """The path of a tool of a `radius` from a place (x, y, z) on; rows are labelled as their steps."""
    ends, centres, sweeps, axes = [np.array(start, dtype=float)[None]], [], [], []
    feeds: list[Floats] = []
    marks: list[np.ndarray] = []
    labels = {"": 0}
    for step in steps:
        if not isinstance(step, Go | Along | Turn | Dip):
            continue
        here = ends[-1][-1]
        axis = np.array([0.0, 1.0, 0.0] if isinstance(step, Dip) else [0.0, 0.0, 1.0])
        if isinstance(step, Dip):
            to, sweep, middle = _dip(step, here)
        else:
            to, sweep, middle = _along(step, here) if isinstance(step, Along) else _straight_or_round(step, here)
        if not len(to):
            continue
        heights = np.vstack([here, to[:-1]])[:, 2:]
        centres.append(np.where(sweep[:, None] != 0, np.hstack([middle, heights]), np.nan))
        axes.append(np.broadcast_to(axis, to.shape))
        ends.append(to)
        sweeps.append(sweep)
        feeds.append(np.full(len(to), np.nan if step.feed is None else step.feed))
        marks.append(np.full(len(to), labels.setdefault(step.label, len(labels)), np.int16))
    sweep, feed = np.concatenate(sweeps), np.concatenate(feeds)
    straight = np.where(np.isinf(feed), np.uint8(Kind.RAPID), np.uint8(Kind.LINE))
    columns: dict[str, Any] = {
        "kind": np.where(sweep != 0, np.uint8(Kind.ARC), straight),
        "centre": np.vstack(centres),
        "axis": np.vstack(axes),
        "sweep": sweep,
        "feed": feed,
        "label": np.concatenate(marks),
        "radius": np.broadcast_to(radius, (len(sweep),)),
    }
    return Toolpath.chain(np.vstack(ends), columns, labels=tuple(labels))


def _straight_or_round(step: Go | Turn, here: Floats) -> tuple[Floats, Floats, Floats]:
    """Ends `(n, 3)`, sweeps `(n,)` and centres `(n, 2)` of the one row that the step makes, or of none."""
    goal, sweep, middle = here.copy(), 0.0, np.full(2, np.nan)
    if isinstance(step, Turn):
        middle, sweep = np.array(step.centre), step.angle
        (c, s), (x, y) = (math.cos(sweep), math.sin(sweep)), here[:2] - middle
        goal[:2] = middle + (c * x - s * y, s * x + c * y)
    else:
        goal[:2] = [old if new is None else new for old, new in zip(here[:2], (step.x, step.y), strict=True)]
    goal[2] = here[2] if step.z is None else step.z
    some = slice(bool(sweep) or bool(np.abs(goal - here).max() > SAME))
    return goal[None][some], np.array([sweep])[some], middle[None][some]


def _dip(step: Dip, here: Floats) -> tuple[Floats, Floats, Floats]:
    """The same of the quarter circle in ZX, whose centre lies beside its start and above its end."""
    sense = 1.0 if (here[0] - step.x) * (here[2] - step.z) > 0 else -1.0
    return np.array([[step.x, here[1], step.z]]), np.array([sense * math.pi / 2]), np.array([[step.x, here[1]]])


def _along(step: Along, here: Floats) -> tuple[Floats, Floats, Floats]:
    """The same of the elements of a contour that lead anywhere."""
    contour = step.contour
    levels = np.full(len(contour.points), here[2]) if step.heights is None else np.asarray(step.heights, dtype=float)
    levels = np.roll(levels, -1)[: len(contour.starts)]
    some = (contour.lengths > SAME) | (np.abs(np.diff(np.append(here[2], levels))) > SAME)
    ends = np.column_stack([contour.ends + step.at, levels])
    return ends[some], contour.sweeps[some], contour.centres[some] + step.at

"""A part for a cycle that probes, where nobody gave one: a small pad at each nominal point, so that a form can show the cycle."""

from __future__ import annotations

import operator
from collections.abc import Iterator
from functools import reduce

import numpy as np

from mnclab.controls.cycle_steps import CycleSteps
from mnclab.machining.steps import Touch
from mnclab.workpiece.part import Part, box

BALL = 2.0  # mm, the radius where a touch does not say it


def touched_part(found: CycleSteps, clearance: float) -> Part | None:
    """The pads before the touches of a cycle; `clearance` (mm) of the probe table, to which an own one of the cycle is added."""
    if found.part is not None:
        return found.part
    gap = clearance + (found.values.get("clearance") or 0.0)
    pads = list(_pads(found, gap))
    return reduce(operator.or_, pads) if pads else None


def _pads(found: CycleSteps, gap: float) -> Iterator[Part]:
    place = np.array(found.start)
    for row in found.rows:
        end = place if row.end is None else np.array(row.end)
        if isinstance(row.step, Touch) and (way := float(np.linalg.norm(end - place))) > 0:
            ball = row.step.ball or BALL
            ahead = (end - place) / way
            side = np.cross((0.0, 0.0, 1.0), ahead) if abs(ahead[2]) < 0.9 else np.cross(ahead, (1.0, 0.0, 0.0))
            side /= np.linalg.norm(side)
            frame = np.eye(4)
            frame[:3, :3] = np.column_stack([ahead, side, np.cross(ahead, side)])
            frame[:3, 3] = place + (0.0, 0.0, ball) + ahead * (ball + gap)
            yield box((0.0, -ball, -ball), (ball, ball, ball)).placed(frame)
        place = end

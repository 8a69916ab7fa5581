"""CYCL CALL PAT: the defined cycle at every point of a pattern (3.1, 3.3, 3.4).

At a point with surface Z the cycle works from S = Q203 + Z. Between the points the tool is at its clearance height H:
where it stood at the call, or the second set-up clearance, whichever is greater; from a lower point to a higher one it
goes up first, and from a higher one to a lower one it goes down last. The second set-up clearance is one level, for the
way between the points and for the cycle, which retracts to it; where it does not count, for neither.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.language.calls import PLACED_BY_DATUM, call_at, planes, ready
from mnclab.controls.tnc_620.language.feeds import FORMS, feed
from mnclab.controls.tnc_620.language.pattern_definitions import Pattern
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.cycle import Definition
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Each, Go, Step
from mnclab.running.performing import perform

FUNCTIONS = FunctionTable()
CODE = "CYCL CALL PAT"
Floats = NDArray[np.float64]


@FUNCTIONS(f"{CODE},", "Cycle call at a pattern", group="call", modal=False, phase="call", takes=FORMS, source="3.1")
def cycle_call_pattern(m: Machine, words: Words) -> None:
    """Runs the cycle defined last at every point of the pattern; F is the feed from point to point."""
    definition = ready(m, CODE)
    pattern = memory(m).pattern
    if pattern is None:
        m.alarm(f"{CODE} has no pattern", hint="write PATTERN DEF or SEL PATTERN before it")
    if m.plane != "XY":
        m.alarm(f"{CODE}: the points of a pattern lie in X and Y, the tool axis must be Z")
    perform(m, CODE, at_points(m, definition, pattern, feed(m, words)), about=(0.0, 0.0))


def at_points(m: Machine, definition: Definition, pattern: Pattern, f: float | None) -> Iterator[Step]:
    """Visits, told together for points that differ in their place alone."""
    heights, second = clearance_heights(m, definition, pattern)
    surface = pattern.points[:, 2]
    last = np.flatnonzero((np.diff(surface) != 0) | (np.diff(heights) != 0)) + 1
    for run in np.split(np.arange(len(surface)), last):
        if len(run):
            one = (float(column[run[0]]) for column in (surface, heights, second))
            yield Each(pattern.points[run, :2], partial(visit, m, definition, f, *one))


def visit(
    m: Machine, definition: Definition, f: float | None, z: float, height: float, second: float, x: float, y: float
) -> Iterator[Step]:
    """What happens at a point: up if need be, over it, the cycle with its second set-up clearance, up."""
    if m.programmed[2] < height:
        yield Go("to the point", height)
    yield Go("to the point", x=x, y=y, feed=f)
    yield from call_at(definition, x, y, z, second_clearance=second)
    yield Go("to the clearance height", height)


def clearance_heights(m: Machine, definition: Definition, pattern: Pattern) -> tuple[Floats, Floats]:
    """Of each point the clearance height (n,), never below its set-up clearance, and the Q204 of the cycle there (n,).

    In a PATTERN DEF above the surface of the cycle, Q204 counts from the surface of the pattern alone. Where a point
    table holds clearance heights, Q204 does not count, unless GLOBAL DEF 125 asks for it.
    """
    own, first, second = planes(m, definition)
    at_call, choice = m.programmed[2], memory(m).defaults.get("Q345")
    z = pattern.points[:, 2]
    surface = own + z
    whole = pattern.table or definition.cycle.code in PLACED_BY_DATUM
    above = second + (surface if whole else np.where(z > own, z, surface))
    end = surface  # where the second set-up clearance does not count
    if choice == 1:
        heights, end = np.fmax(above, pattern.clearance), above
    elif not np.isnan(pattern.clearance).all():
        heights = np.where(np.isnan(pattern.clearance), at_call, pattern.clearance)
    elif choice == 0:
        heights = np.full(len(z), at_call)
    else:
        heights, end = np.maximum(at_call, above), above
    return np.maximum(heights, surface + first), np.maximum(end - surface, 0.0)

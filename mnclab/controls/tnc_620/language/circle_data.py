"""FN 23 and FN 24: centre and radius of the circle through points that stand in Q parameters (iTNC 530, 9.5)."""

from __future__ import annotations

import numpy as np

from mnclab.controls.tnc_620.language.parameters import give
from mnclab.controls.tnc_620.reading.formulas import GREATEST
from mnclab.geometry.arcs import circle_through
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
POINTS = {"FN 23": 3, "FN 24": 4}
TITLES = {"FN 23": "Circle through three points", "FN 24": "Circle through four points"}
APART = 1e-3  # mm; four points that are not nearer to one circle are measured ones


def following(m: Machine, word: Word, count: int) -> list[str]:
    """A parameter and those after it."""
    name = str(word.value)
    kind = name.rstrip("0123456789")
    first = int(name[len(kind) :])
    if first + count - 1 > GREATEST[kind[1:]]:
        m.alarm(f"{count} parameters from {name} on do not exist: the last is {kind}{GREATEST[kind[1:]]}", word)
    return [f"{kind}{first + k}" for k in range(count)]


@FUNCTIONS(", ".join(TITLES), TITLES, takes="target points", source="Klartext, not described")
def circle_data(m: Machine, words: Words) -> None:
    """The points stand in six or eight parameters, x and y in turn; centre and radius come into the target and the two after it.

    Four points that lie on no common circle are evened out by least squares, with a warning: how the control does it nobody says.
    """
    count, source = POINTS[words.code], words["points"]
    found = []
    for name in following(m, source, 2 * count):
        if not isinstance(value := m.variables.get(name), float):
            m.alarm(f"{words.code}: no value was given to {name}", source, f"{count} points stand in {2 * count} parameters")
        found.append(value)
    points = np.array(found).reshape(count, 2)
    try:
        x, y, radius = circle_through(points)
    except ValueError:
        m.alarm(f"{words.code}: the points lie on a line, no circle goes through them", source)
    off = float(np.abs(np.hypot(*(points - (x, y)).T) - radius).max())
    if off * m.variable_unit > APART:
        m.warn(f"{words.code}: the points lie up to {off:.3g} beside one circle, which is that of least squares", source)
    for name, value in zip(following(m, words["target"], 3), (x, y, radius), strict=True):
        give(m, words["target"]._replace(value=name), value)

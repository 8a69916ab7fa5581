"""A probe moves until its ball touches the part, and stops there."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mnclab.machine.cut_so_far import CUT, part_before
from mnclab.text.program import Word
from mnclab.workpiece.part import contact

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

DEEP = 1e-6  # mm, by which a ball may stand in the material where its touch begins: it only rests on it
Point = tuple[float, float, float]


class Contact(NamedTuple):
    """Where the centre of the ball stood at the contact, in program and in machine coordinates, mm."""

    point: Point
    machine_point: Point
    hit: bool


def touch(m: Machine, target: Point, f: float, ball: float, word: Word | None, miss: str) -> Contact:
    """Move the tip (the south pole of the ball) towards a point in program coordinates at feed `f`.

    No contact is an alarm, or with `miss="return"` an answer that is no `hit`. Radius compensation is refused,
    and a ball that stands in the material already.
    """
    if m.side:
        m.alarm("a probe cannot move under radius compensation", word)
    if m.setup.part is None:
        m.alarm("there is no part to touch", word, hint='give one: Setup(part=…); "cut" is what the program has cut')
    m.settle()
    part = part_before(m, word) if m.setup.part == CUT else m.setup.part
    m.variables.state_read = m.step
    start, goal = np.array(m.tip), np.array(m.to_machine(target))
    reach = float(np.linalg.norm(goal - start))
    if reach == 0:
        m.alarm("a touch needs a direction", word)
    direction, up = (goal - start) / reach, np.array([0.0, 0.0, ball])
    if float(part(start + up)[0]) - ball < -DEEP:
        m.alarm("the stylus is in contact before it touches", word, hint="the touch begins where the ball is free")
    travel = contact(part, start + up, direction, ball, reach)
    if travel is None and miss == "alarm":
        m.alarm(f"touch point inaccessible: no contact within {reach:g} mm", word)
    end = start + direction * (reach if travel is None else travel)
    m.probe_to(_point(end), f)
    return Contact(m.to_program(_point(end + up)), _point(end + up), travel is not None)


def _point(xyz: np.ndarray) -> Point:
    x, y, z = xyz.tolist()
    return x, y, z

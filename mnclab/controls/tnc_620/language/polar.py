"""Lines and arcs in polar coordinates: LP, CP with helices, CTP (catalogue: LP, CP, CTP)."""

from __future__ import annotations

import math

from mnclab.controls.tnc_620.language.motion import coordinates, feed, refuse_rapid, sense, side, tangent_arc
from mnclab.controls.tnc_620.language.pole import angle_here, polar_point, pole
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()
SAME = 1e-9  # rad: an end at the angle of the start is a whole turn


@FUNCTIONS("LP", "Straight line, polar", takes="PR PA R0 RL RR F FMAX FAUTO", source="10.1, example")
def polar_line(m: Machine, words: Words) -> None:
    """To a point given by its distance and angle from the pole CC."""
    f = feed(m, words)
    side(m, words, begins=True)
    m.line(*polar_point(m, words), f=f)


@FUNCTIONS("CP", "Circular path, polar; helix", takes="PA Z DR R0 RL RR F FMAX FAUTO", source="10.1, example")
def polar_circle(m: Machine, words: Words) -> None:
    """Around the pole CC on the present radius: to the angle PA, or by the angle IPA of any number of turns."""
    f = feed(m, words)
    side(m, words, begins=False)
    turning, (u, v) = sense(m, words), pole(m, words)
    refuse_rapid(m, words)
    if "PA" not in words:
        m.alarm("CP needs PA (polar angle of the end) or IPA (angle travelled)")
    word, here = words["PA"], angle_here(m, words)
    value, level = m.value(word), coordinates(m, words, "Z").get("z")
    if not word.incremental:
        away = turning * (math.radians(value) - here) % math.tau
        travel = away if SAME < away < math.tau - SAME else math.tau
        m.turn((u, v), turning * travel, level, f)
        return
    if value == 0:
        m.alarm("CP IPA (angle travelled) must not be 0", word)
    if (value > 0) != (turning > 0):
        m.alarm(f"CP IPA{value:+g} and DR{'+' if turning > 0 else '-'} turn in opposite senses", word)
    m.turn((u, v), math.radians(value), level, f)


@FUNCTIONS("CTP", "Tangential arc, polar", takes="PR PA R0 RL RR F FMAX FAUTO", source="Klartext, not described")
def polar_tangent_arc(m: Machine, words: Words) -> None:
    """An arc that goes on where the element before it points, to a polar point."""
    f = feed(m, words)
    side(m, words, begins=False)
    refuse_rapid(m, words)
    tangent_arc(m, words, polar_point(m, words), f)

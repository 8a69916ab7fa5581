"""Rotary axes A, B and C: positions of their own beside X Y Z, for the kinematics of the machine are not known."""

from __future__ import annotations

import math

from mnclab.machine.control import Words
from mnclab.machine.coordinates import AXES, Angles, angles, set_angles, turn_axes
from mnclab.machine.machine import Machine
from mnclab.text.program import Word


def angles_of(m: Machine, words: Words) -> Angles | None:
    """Where the rotary axes go that are written, degrees; None where none is. Under G91 from where they stand."""
    if not any(axis in words for axis in AXES):
        return None
    found = list(angles(m))
    for k, axis in enumerate(AXES):
        if axis in words:
            found[k] = m.value(words[axis]) + (found[k] if m.modal["dimension"] == "G91" else 0.0)
    return found[0], found[1], found[2]


def at_zero(m: Machine, words: Words) -> Angles | None:
    """The rotary axes that are written at zero; None where none is."""
    if not any(axis in words for axis in AXES):
        return None
    a, b, c = (0.0 if axis in words else angle for axis, angle in zip(AXES, angles(m), strict=True))
    return a, b, c


def go(m: Machine, to: dict[str, float], turned: Angles | None, rapid: bool, word: Word | None = None) -> None:
    """A straight move, at rapid or at the modal feed, with which the rotary axes arrive; they may also turn alone."""
    f = math.inf if rapid else None
    if turned is not None and turned != angles(m):
        if math.dist(m.to_machine(m.target(to.get("x"), to.get("y"), to.get("z"))), m.tip) <= 1e-9:  # a frame rounds
            turn_axes(m, turned, f)
            return
        set_angles(m, turned)
    if to:
        m.line(**to, f=f, word=word)

"""Radius compensation that is still on when the program ends: the next program begins with it, or leaves the contour askew."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from mnclab.runs.lint.once import once
from mnclab.text.alarm import Alarm

if TYPE_CHECKING:
    from mnclab.runs.run import Run

WORDS = ("G41", "G42", "RL", "RR")


def remarks(run: Run) -> Iterator[Alarm]:
    """A warning at the block that switched the compensation on, if the program came to its end under it."""
    if not run.ok or "side" not in run.history:
        return
    at, sides = run.history.log("side")
    if sides[-1] and at[-1] >= 0:
        hint = "write G40 with a move away from the contour" if "G40" in run.control.functions else "write R0, or DEP"
        yield once(run, [int(at[-1])], "radius compensation is still on where the program ends", hint, *WORDS)

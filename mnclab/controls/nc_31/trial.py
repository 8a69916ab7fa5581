"""A cycle of the NC-31 in a program of its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mnclab.machine.cycle import Cycle
from mnclab.machine.trial import number


def trial_program(cycle: type[Cycle], words: Sequence[tuple[str, Any]]) -> str:
    """The code in a frame with its marks, each word in one of its own."""
    marks = [address for address, value in words if address in "~@" and value]
    frames = [" ".join([cycle.code, *marks]), *(a + number(value) for a, value in words if a not in "~@")]
    return "\n".join(["S800", "M3", "F20", "X4000 ~ *", "Z200 ~", " *\n".join(frames), ""])

"""A cycle of the control with G43 in a program of its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mnclab.machine.cycle import Cycle
from mnclab.machine.trial import number


def trial_program(cycle: type[Cycle], words: Sequence[tuple[str, Any]]) -> str:
    """The cycle in one block, and its end."""
    block = " ".join([cycle.code, *(address + number(value) for address, value in words)])
    return f"T2 M6\nG43 G0 X0 Y0 Z20 S1000 M3\n{block}\nG80\n"

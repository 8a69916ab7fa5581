"""A cycle of the JNC-T01 in a program of its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mnclab.machine.cycle import Cycle
from mnclab.machine.trial import number


def trial_program(cycle: type[Cycle], words: Sequence[tuple[str, Any]]) -> str:
    """The cycle in one block, before the face of the part."""
    block = " ".join([cycle.code, *(address + number(value) for address, value in words)])
    x = 0 if cycle.code == "G73" else 40
    return f"G90 G94 F100\nT1 S800 M3\nG0 X{x} Z5\n{block}\n"

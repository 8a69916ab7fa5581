"""A cycle of the MNC in a program of its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mnclab.machine.cycle import Cycle
from mnclab.machine.trial import number


def trial_program(cycle: type[Cycle], words: Sequence[tuple[str, Any]]) -> str:
    """A milling cycle runs where it stands, a prepared one by M99, a fixed one at a position."""
    block = " ".join([cycle.code, *(address + number(value) for address, value in words)])
    if cycle.runs == "definition":  # milling
        return f"G17 G90 G54\nT1 S1000 M3\nG0 X20 Y10 Z20 F100\n{block}\n"
    call = "G80" if cycle.runs == "position" else "G0 X20 Y10 M99"
    return f"G17 G90 G54\nT2 S1000 M3\nG0 X0 Y0 Z20 F100\n{block}\n{call}\n"

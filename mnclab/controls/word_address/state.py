"""What milling controls of G words keep beside the common state of a machine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from mnclab.machine.machine import Machine
from mnclab.path.tool import Tool


@dataclass
class Memory:
    """Of such a control; each adds its own."""

    machine_coordinates: bool = False  # in a block with G53: no offset counts
    next_tool: Tool | None = None  # of T, which M6 puts into the spindle

    @classmethod
    def of(cls, m: Machine) -> Self:
        """What is kept beside a machine."""
        kept: Self = m.memory
        return kept


memory = Memory.of

"""What the NC-31 keeps beside the common state of a machine."""

from __future__ import annotations

from dataclasses import dataclass, field

from mnclab.machine.machine import Machine


@dataclass
class Memory:
    """Of the NC-31."""

    frames: dict[int, list[int]] = field(default_factory=dict)  # numbers of the frames of each block, once worked out


def memory(m: Machine) -> Memory:
    """What the NC-31 keeps."""
    kept: Memory = m.memory
    return kept

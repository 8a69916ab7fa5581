"""What the JNC-T01 keeps beside the common state of a machine."""

from __future__ import annotations

from dataclasses import dataclass, field

from mnclab.machine.machine import Machine
from mnclab.text.program import Word


@dataclass
class Memory:
    """Of the JNC-T01. A corrector that is chosen becomes active with the next motion."""

    corrector: int = 0
    active_corrector: int = 0
    empty_correctors: set[int] = field(default_factory=set)  # already warned of
    cutting_speed: float = 0.0  # the last S under G96, m/min
    cutting_speed_word: Word | None = None  # the G96 that is active
    feed_ended_by: str = ""  # the code that gave F another unit
    foreign_words: set[str] = field(default_factory=set)  # already warned of


def memory(m: Machine) -> Memory:
    """What the JNC-T01 keeps."""
    kept: Memory = m.memory
    return kept

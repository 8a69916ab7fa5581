"""What the ISO control with G43, G44 and G49 keeps beside the common state of a machine."""

from __future__ import annotations

from dataclasses import dataclass, field

from mnclab.controls.word_address import state
from mnclab.text.program import Word

Offsets = tuple[float, float, float]
NONE: Offsets = (0.0, 0.0, 0.0)


@dataclass
class Memory(state.Memory):
    """Of this control. An offset that is wanted counts from the next motion along its axis on."""

    sign: int = 0  # of G43, G44, G49
    corrector: int = 0
    wanted_offsets: Offsets = NONE
    active_offsets: Offsets = NONE
    empty_correctors: set[int] = field(default_factory=set)  # already warned of
    undescribed: set[str] = field(default_factory=set)  # codes already warned of
    sections: dict[int, list[tuple[int, str]]] = field(default_factory=dict)  # the programs of each file that runs
    return_to: Word | None = None  # the block after a subprogram, where M99 names one
    macro: object = None  # that G66 calls


memory = Memory.of

"""What the ISO mill keeps beside the common state of a machine."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from mnclab.controls.word_address import state
from mnclab.text.program import Word

Offsets = tuple[float, float, float]
NONE: Offsets = (0.0, 0.0, 0.0)


class Polar(NamedTuple):
    """Polar coordinates of G16: about which point of the plane, mm, and the last radius, mm, and angle, degrees."""

    centre: tuple[float, float]
    radius: float
    angle: float


class Doubt(NamedTuple):
    """Coordinates that a change of frame has turned over: of which axes, by which code, where the tip stood then."""

    axes: str
    code: str
    tip: tuple[float, float, float]


@dataclass
class Memory(state.Memory):
    """Of this control. An offset that is wanted counts from the next motion along its axis on."""

    sign: int = 0  # of G43, G44, G49
    corrector: int = 0  # of D, or of M6
    length_corrector: int | None = None  # of H; None: the length is that of D
    outlived: bool = False  # H, by the tool for which it was written
    without_radius: bool = False  # D names a row that the tool table does not have
    wanted_offsets: Offsets = NONE
    active_offsets: Offsets = NONE
    empty_correctors: set[str] = field(default_factory=set)  # already warned of
    undescribed: set[str] = field(default_factory=set)  # codes already warned of
    sections: dict[int, list[tuple[int, str]]] = field(default_factory=dict)  # the programs of each file that runs
    return_to: Word | None = None  # the block after a subprogram, where M99 names one
    macro: object = None  # that G66 calls
    returned: float | None = None  # by the last subprogram of O words
    known: set[tuple[int, str]] = field(default_factory=set)  # subprograms of O words that were called or passed: file, label

    row: int = 1  # of the table of datums: G54
    set_aside: Offsets | None = None  # the shift that G92.2 has put aside
    angle: float = 0.0  # of G68, degrees
    mirrored: dict[int, float] = field(default_factory=dict)  # axis -> the line of G51.1, mm
    polar: Polar | None = None
    doubt: Doubt | None = None
    absolute_centres: bool = False  # of arcs: G90.1
    references: dict[int, Offsets] = field(default_factory=dict)  # G28.1, G30.1, machine coordinates of the spindle, mm
    intermediate: dict[str, float] = field(default_factory=dict)  # of the last G28 or G30


memory = Memory.of

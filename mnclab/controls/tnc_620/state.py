"""What the TNC 620 keeps beside the common state of a machine."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import TYPE_CHECKING, NamedTuple

from mnclab.machine.machine import Machine
from mnclab.text.program import Word

if TYPE_CHECKING:
    from mnclab.controls.tnc_620.contours.area import ContourData, Labels
    from mnclab.controls.tnc_620.contours.formulas import Definitions
    from mnclab.controls.tnc_620.contours.train import TrainData
    from mnclab.controls.tnc_620.free_contours.free_contour import Pair
    from mnclab.controls.tnc_620.language.free_contours import Earlier
    from mnclab.controls.tnc_620.language.functions import FreeTable
    from mnclab.controls.tnc_620.language.pattern_definitions import Pattern
    from mnclab.controls.tnc_620.language.program import Blank
    from mnclab.controls.tnc_620.probing.cycle import FastProbing
    from mnclab.controls.tnc_620.probing.tool_setter import Calibrated
    from mnclab.controls.tnc_620.tables import DatumTable
    from mnclab.geometry.kinematics import Kinematics
    from mnclab.geometry.regions import Region
    from mnclab.machining.milling.terraces import Formula
    from mnclab.path.tool import Tool
    from mnclab.workpiece.blank import Blank as Body

Place = tuple[float, float, float]


class Led(NamedTuple):
    """How the tip is led where rotary axes turn: by M128, or by FUNCTION TCPM."""

    most: float = math.inf  # feed of the linear axes, mm/min
    of_all: bool = False  # the feed counts along all axes of a block, not along the way of the tip
    spatial: Place | None = None  # A, B, C are spatial angles, degrees, these at last; None: positions of the axes
    in_plane: bool = False  # the tool turns in the plane of its directions at both ends


@dataclass
class Memory:
    """Of the TNC 620; None stands for what the program has not said."""

    # the program
    name: str | None = None  # as BEGIN PGM of the running program has it
    unit: str | None = None  # "MM" or "INCH", of the running program
    main_unit: str | None = None
    selected_program: str | None = None
    stock: Blank | Body | None = None
    free_tables: dict[str, FreeTable] = field(default_factory=dict)  # by name in small letters, as they were opened
    free_table: str | None = None  # the open one
    tool_fields: dict[tuple[float, int], float] = field(default_factory=dict)  # of columns without a place in a Tool, by number
    table_fields: dict[str, dict[tuple[int, str], str]] = field(default_factory=dict)  # written to: by table, row and column
    told: frozenset[str] = frozenset()  # warnings that are given once a program
    closed_files: frozenset[str] = frozenset()  # in small letters: what is written to them next begins anew

    # feed, spindle, probe
    auto_feed: float | None = None  # of TOOL CALL, mm/min
    feed_per_tooth: float | None = None  # mm, beside the feed per revolution that it makes with the tool in the spindle
    orientation: float | None = None  # where M19 and M20 stop the spindle, degrees
    probe_input: float | None = None
    fast_probing: FastProbing | None = None  # cycle 441
    tool_setter: Calibrated | None = None  # as the last calibration found the TT
    saved_kinematics: Mapping[str, Kinematics] | None = None  # cycle 450: records by name, once DATA450.KD was opened

    # datums, transformations, planes
    pole_plane: str = "XY"  # of CC, whose axes `Machine.pole` counts along
    secondary: Place = (0.0, 0.0, 0.0)  # where U, V and W stand
    machine_datum: tuple[Word, Place] | None = None  # M91 or M92 of the block, and the machine coordinates it counts from
    preset: int | None = None  # the active row
    datum_table: DatumTable | None = None
    rotation_angles: dict[str, float] = field(default_factory=dict)  # by frame, degrees
    rotary_shift: Place = (0.0, 0.0, 0.0)  # of A, B and C, degrees
    rotary_mirror: str = ""  # which of A, B and C are mirrored
    tilt_angles: Mapping[str, float] = field(default_factory=dict)  # a, b and c of the active tilt, degrees
    tilt_by_axes: bool = False  # they are positions of the rotary axes
    tilt_axes: Place | None = None  # where A, B and C must stand for it, rad
    tilting: str | None = None  # the axes of M138; None: those of the machine
    led: Led | None = None  # how the tip is led, while it is

    # cycles
    defaults: dict[str, float | str] = field(default_factory=dict)  # of GLOBAL DEF, by Q parameter
    pattern: Pattern | None = None
    contour: Labels | Formula | None = None  # which one the next cycle machines
    contour_area: tuple[object, Region] | None = None  # that labels described last, and their outlines
    contour_data: ContourData | None = None
    train_data: TrainData | None = None
    rough_out_tool: Tool | None = None  # with which cycle 22 was called last, its deltas included
    tool_before: Tool | None = None  # that was in the spindle before the last TOOL CALL of a tool
    developed: float | None = None  # mm that 1 of X is, while the contour of a cylinder is read
    defining: Definitions | None = None  # while the program of SEL CONTOUR runs

    # free contours
    free_pole: tuple[float, float] | None = None
    free_start: Pair | None = None  # where a contour began with CLSD+
    free_elements: dict[str, Earlier] = field(default_factory=dict)  # by block number


def memory(m: Machine) -> Memory:
    """What the TNC 620 keeps."""
    kept: Memory = m.memory
    return kept


def count_in(m: Machine, length: float) -> None:
    """What the running program counts in from here on: mm of a length of 1."""
    m.variable_unit = length
    own = "" if length == 1 or m.feed_unit != length else ", F in inches"
    m.log("unit", f"{memory(m).unit}{own}")


def active_preset(m: Machine) -> int:
    """The active row of the preset table."""
    row = memory(m).preset
    return int(m.settings["preset"]) if row is None else row


def time_of_day(m: Machine) -> datetime | None:
    """The time in UTC, which a run has only where the setting `clock` gives it one; an Alarm if the setting is no time."""
    clock = float(m.settings["clock"])
    try:
        return datetime.fromtimestamp(clock, UTC) if clock else None
    except (ValueError, OverflowError, OSError):
        m.alarm(f"setting clock: {clock:g} seconds from 1970 are no time that can be written")

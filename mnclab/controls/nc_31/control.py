"""The control itself: what it reads, obeys, and needs to be told."""

from __future__ import annotations

from pathlib import Path

from mnclab.controls.nc_31 import SIGNS, SUFFIXES, cycles, functions, notation, threads
from mnclab.controls.nc_31.functions import Memory
from mnclab.controls.nc_31.reader import numbers, read
from mnclab.machine.control import Control, Setting, one_of
from mnclab.machine.cycle import Cycle
from mnclab.machine.setup import LATHES
from mnclab.machine.trial import TrialWords, number

SETTINGS = (
    Setting("parameter_6", 0, "G31: infeed angle of the thread", "group P, adopted 0", {}, "deg"),
    Setting("parameter_7", 0, "G31: run-out at the end of the thread", "group P, adopted 0", {}, "tenths of the pitch", 0),
    Setting("parameter_8", 100, "G72, G73: gap left when the drill returns", "group P, adopted 1 mm", {}, "0.01 mm", 0),
    Setting("parameter_10", 0, "G77, G78: length of cut until the chip is broken; 0: not broken", "group P", {}, "0.01 mm", 0),
    Setting("parameter_11", 50, "G77, G78: rapid retract that breaks the chip", "group P, adopted 0.5 mm", {}, "0.01 mm", 0),
    Setting("p1_on_radius", False, "G77 P1, G72 P: on the radius, not on the diameter", "not stated"),
    one_of("g78_bevel", "G78: which way its bevel P2 counts", "3.20.6, its figure is lost",
           along_z="along Z, as its table says: a conical face", along_x="along X: G77 with the axes exchanged"),
)  # fmt: skip

#: Known from elsewhere to be part of this control, but not described in the source: refused by name.
_OTHER_CHAPTERS = {"G2": "arcs", "G3": "arcs", "G12": "quarter arcs", "G13": "quarter arcs", "T": "tool words"}
REFUSED = {code: f"{what} stand in a chapter that the source does not have" for code, what in _OTHER_CHAPTERS.items()}

MEANINGS = {
    "X": "diameter, 0.01 mm", "Z": "coordinate along the axis, 0.01 mm", "F": "feed, 0.01 mm/rev",
    "M": "auxiliary function", "P": "parameter",
    "G25 P": "frames (first * 1000 + last), or how often", "G32 F": "pitch, 0.0001 mm",
    **{f"G{n} M": "auxiliary function at the end of the move" for n in range(61, 68)},
}  # fmt: skip


def trial_program(cycle: type[Cycle], words: TrialWords) -> str:
    """The code of a cycle in a frame with its marks, each word in one of its own; holes in the face lie on the axis."""
    marks = [address for address, value in words if address in "~@" and value]
    frames = [" ".join([cycle.code, *marks]), *(a + number(value) for a, value in words if a not in "~@")]
    x, z = 0 if cycle.code in ("G73", "G33") else 4000, -600 if cycle.code == "G75" else 200  # grooves in the bar
    return "\n".join(["S800", "M3", "F20", f"X{x} ~ *", f"Z{z} ~", " *\n".join(frames), ""])


#: The source has no tool words: the operator put the tool of a cycle in.
CYCLE_TOOLS = {
    "": 1, "G70": 2, "G71": 2, "G77": 1, "G78": 1, "inside G70": 5, "inside G77": 5, "G73": 6, "G74": 7, "G75": 3,
    "G31": 4, "G32": 4, "G33": 8, "G72": 0,  # what it drills from the side is no body of revolution
}  # fmt: skip

CYCLES = cycles.CYCLES | threads.CYCLES

CONTROL = Control(
    name="nc-31",
    title="Elektronika NC-31 (lathe)",
    suffixes=SUFFIXES,
    terms=Path(__file__).with_name("terms.toml"),
    axes="XZ",
    codes=("G",),
    read=read,
    functions=functions.FUNCTIONS | threads.FUNCTIONS,
    cycles=CYCLES,
    phases=("motion",),
    memory=Memory,
    settings=SETTINGS,
    start=functions.power_on,
    signs=SIGNS,
    numbers=numbers,
    refused=REFUSED,
    meanings=MEANINGS,
    told=notation.told,
    marks=notation.marks,
    one_command=True,
    lathe=True,
    magazine=LATHES,
    cycle_tools=CYCLE_TOOLS,
    to_turn="write S before the move, and M3 or M4 where M5 was written",
    modern=lambda program: notation.modern(program, CYCLES),
    trial=trial_program,
)

"""The lathe control Elektronika NC-31: frames of one word, integers in discretes, marks.

``reader`` makes frames into blocks, ``discretes`` is the scale of the integers, ``functions`` holds moves, repetition
and words, ``turning`` the cycles. X is a diameter in programs and a radius everywhere else. Still to come are the
single-pass, facing, grooving, drilling and thread cycles; their codes are refused by name.
"""

from __future__ import annotations

from mnclab.controls.nc_31 import functions, turning
from mnclab.controls.nc_31.reader import looks_like, read
from mnclab.machine.control import Control
from mnclab.machine.settings import Setting

SETTINGS = (
    Setting("parameter_6", 0, "G31: infeed angle of the thread", "group P, adopted 0", unit="deg"),
    Setting("parameter_7", 0, "G31: run-out at the end of the thread, 0.1 of the pitch", "group P, adopted 0"),
    Setting(
        "parameter_8",
        100,
        "G72, G73: gap left when the drill returns",
        "group P, adopted 1 mm",
        unit="0.01 mm",
        at_least=0,
    ),
    Setting(
        "parameter_10",
        0,
        "G77, G78: length of cut until the chip is broken; 0: not broken",
        "group P",
        unit="0.01 mm",
        at_least=0,
    ),
    Setting(
        "parameter_11",
        50,
        "G77, G78: rapid retract that breaks the chip",
        "group P, adopted 0.5 mm",
        unit="0.01 mm",
        at_least=0,
    ),
    Setting("p1_on_radius", False, "G77: P1 counts on the radius, not on the diameter", "not stated"),
)

_LATER = "it is part of this control but not built yet"
_OUTSIDE = "the source does not describe it, and it is not built yet"
REFUSED = (
    {f"G{n}": _LATER for n in (70, 71, 72, 73, 74, 75, 78, 31, 32, 33)}
    | {f"G{n}": _OUTSIDE for n in (2, 3, 12, 13)}
    | {"T": "the source does not describe a tool word"}
)

CONTROL = Control(
    name="nc-31",
    title="Elektronika NC-31 (lathe)",
    suffixes=(".nc31",),
    axes="XZ",
    codes=("G",),
    read=read,
    functions=functions.FUNCTIONS,
    meanings={"M": "auxiliary function", "G25 P": "first * 1000 + last frame, then how often"},
    cycles=turning.CYCLES,
    phases=("motion",),
    settings=SETTINGS,
    start=functions.power_on,
    looks_like=looks_like,
    refused=REFUSED,
    one_command=True,
    lathe=True,
)

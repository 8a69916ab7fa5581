"""The secondary axes U, V and W, which move the tool along X, Y and Z (public manuals: FUNCTION PARAXCOMP).

They have coordinates of their own, which no datum shifts, and those of X, Y and Z do not change with them: the tool stands at
the sum of both. That sum is what PARAXCOMP DISPLAY shows as its distance from the workpiece.
"""

from __future__ import annotations

from mnclab.controls.tnc_620.language.checks import counted
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry import frames
from mnclab.machine.control import Setting, Words
from mnclab.machine.machine import Machine

FRAME = "secondary axes"
AXES = "UVW"
SETTINGS = (
    Setting(
        "secondary_axes", "sum", "what U, V and W do in a straight line", "Klartext, not described",
        {"sum": "they carry the tool along X, Y, Z, whose coordinates stay", "refuse": "an alarm: there are none"},
    ),
)  # fmt: skip


def move(m: Machine, words: Words) -> bool:
    """Set U, V and W to where a straight line takes them; whether it names one."""
    named = [words[axis] for axis in AXES if axis in words]
    if not named:
        return False
    if m.settings["secondary_axes"] == "refuse":
        m.alarm(f"{named[0]}: the machine has no secondary axis {named[0].address} (setting secondary_axes)", named[0])
    if memory(m).machine_datum is not None:
        m.alarm(f"{named[0]}: secondary axes under M91 or M92 are not built yet", named[0])
    if m.side:
        m.alarm(f"{named[0]}: secondary axes under radius compensation are not built yet", named[0], "write R0")
    before = memory(m).secondary
    u, v, w = (counted(m, words[axis], at) if axis in words else at for axis, at in zip(AXES, before, strict=True))
    memory(m).secondary = u, v, w
    m.set_frame(FRAME, frames.shift(u, v, w), keep="programmed")
    if m.setup.limits.travel is not None:
        m.warn(f"the travel of {named[0].address} is not known: its way counts as one of the axis beside it", named[0])
    return True

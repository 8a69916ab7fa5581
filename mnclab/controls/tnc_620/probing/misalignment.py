"""What becomes of a measured misalignment (TNC 620, chapter 14): a basic rotation, or a rotary axis that turns by it.

The basic rotation stands in the column SPC of a preset row, the angle that a rotary axis counts from in A_OFFS, B_OFFS or
C_OFFS (`Datum.rotation`, `.a`, `.b`, `.c`). An angle is positive where the workpiece is turned counter-clockwise; the axis
turns by the same angle, so that the table takes the workpiece back.
"""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles.chain import offset, to_angle
from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.controls.tnc_620.language.rotary_rules import GROUPS, TITLES
from mnclab.controls.tnc_620.probing.transfer import store
from mnclab.controls.tnc_620.state import active_preset, memory
from mnclab.machine.coordinates import AXES, angles
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.machining.steps import RAPID, Say, Step, Swivel

STANDS = "a part of the setup does not turn with the table: the blocks that follow meet it as it stood"
C = AXES.index("C")


def tilted(m: Machine) -> Iterator[Fault]:
    """A workpiece that does not lie level (SPA, SPB of the active preset): a basic rotation alone cannot say how it is turned."""
    preset = m.tables.presets.get(active_preset(m), Datum())
    if preset.tilt_x or preset.tilt_y:
        yield "", "cannot set a basic rotation where the active preset is tilted (SPA, SPB): the cycles 1410 and 1411 can"


def reset(m: Machine) -> Iterator[Step]:
    """The active basic rotation is over, where there is one (400, 401, 402)."""
    if m.tables.presets.get(active_preset(m), Datum()).rotation:
        yield from store(m, active_preset(m), rotation=0.0)


def align(m: Machine, axis: int, by: float) -> Iterator[Step]:
    """Turn a rotary axis by an angle, degrees."""
    a, b, c = (angle + by * (k == axis) for k, angle in enumerate(angles(m)))
    if by:
        yield Say(f"turns {AXES[axis]} by {by:.4f} degrees", STANDS)
        yield Swivel("align the workpiece", (a, b, c), RAPID)


def zeroed(m: Machine, axis: int) -> dict[str, float]:
    """The column of a preset row with which a rotary axis shows 0 where it stands now, degrees."""
    angle = angles(m)[axis]
    return {"abc"[axis]: offset(m, axis) + to_angle(m, axis, angle)}


def cannot_turn(m: Machine, axis: int, name: str) -> Iterator[Fault]:
    """Why a rotary axis cannot turn; `name` of the parameter that asks for it."""
    there = m.settings["rotary_axes"]
    if AXES[axis] not in there:
        yield name, f"needs the rotary axis {AXES[axis]}: the machine has {' and '.join(sorted(there))} (setting rotary_axes)"
    for group, code in GROUPS.items():
        if m.modal.get(group) == code:
            yield name, f"turns a rotary axis, which is not built yet under {code} ({TITLES[code].lower()})"
    if any(memory(m).rotary_shift) or memory(m).rotary_mirror:
        yield name, "turns a rotary axis, which must not be shifted or mirrored"

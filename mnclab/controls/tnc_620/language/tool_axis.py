"""The tool axis of TOOL CALL: Z on the working plane XY, X on YZ, Y on ZX; cycles run along it.

Tool length, radius compensation, corners, arcs, angles and the heights of cycles follow it. What is not built so is refused.
"""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext

from mnclab.controls.tnc_620.cycles.chain import TILT
from mnclab.machine.control import Words
from mnclab.machine.coordinates import FRAME, LOG, along_z, tool_axis
from mnclab.machine.cycle import Cycle, Definition
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

PLANES = {"Z": "XY", "X": "YZ", "Y": "ZX"}  # working plane by tool axis
#: Cycles that work in the plane and along the tool axis alone, whichever these are …
TURNED = frozenset(
    f"CYCL DEF {n}"
    for n in (
        1, 2, 17, 18, 200, 201, 203, 205, 206, 207, 208, 209, *range(210, 216), 220, 221, 225, 232, 233, 240, 241,
        *range(251, 255), *range(256, 259), *range(262, 266), 267,
    )
) | frozenset(f"TCH PROBE {n}" for n in (*range(408, 428), 430, 431))  # fmt: skip
#: … and those that name axes by their letters, or none.
NAMED = frozenset(f"CYCL DEF {n}" for n in (7, 8, 9, 10, 11, 13, 14, 20, 26, 32, 239, 247)) | {"GLOBAL DEF 120"}


def letter(m: Machine) -> str:
    return "XYZ"[tool_axis(m)]


def refuse_other(m: Machine, what: str, word: Word | None = None) -> None:
    """An Alarm unless the tool stands along Z."""
    if (axis := letter(m)) != "Z":
        m.alarm(f"{what} with the tool axis {axis}: not built yet", word, "with the tool axis Z it is")


def check_cycle(m: Machine, cycle: type[Cycle]) -> None:
    """An Alarm at a cycle that is built for the tool axis Z alone."""
    if cycle.code not in TURNED | NAMED:
        refuse_other(m, cycle.code)


def turned(m: Machine, definition: Definition) -> AbstractContextManager[None]:
    """What a cycle runs in."""
    if m.plane == "XY" and FRAME not in m.frames:
        return nullcontext()
    check_cycle(m, definition.cycle)
    return nullcontext() if FRAME in m.frames or definition.cycle.code in NAMED else along_z(m)


def change_axis(m: Machine, words: Words) -> int:
    """Take the tool axis that a TOOL CALL names; the number of the one before."""
    before = tool_axis(m)
    if "axis" not in words or (axis := str(words["axis"].value)) == letter(m):
        return before
    if axis not in PLANES:
        m.alarm(f"TOOL CALL: the tool axis {axis} is not built yet, X, Y and Z are", words["axis"])
    if TILT in m.frames:
        m.alarm(f"TOOL CALL: the tool axis {axis} cannot stand in a tilted working plane", words["axis"], "reset cycle 19")
    m.change("plane", PLANES[axis])
    m.log(LOG, axis)
    return before

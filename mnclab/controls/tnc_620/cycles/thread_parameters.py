"""Q parameters that the cycles for threads share (chapter 5), each declared once."""

from __future__ import annotations

from typing import Any

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.machine.cycle import param


def pitch() -> Any:
    """Q239: its sign is the hand of the thread."""
    return param(
        "Q239", "thread pitch", "mm/rev", at_least=-99.9999, at_most=99.9999, modal=True, note="+ right-hand, - left-hand",
        example=1.5,
    )  # fmt: skip


def thread_depth(**more: Any) -> Any:
    """Q201: from the surface to the end of the thread, negative downwards."""
    note = "from the surface; negative is down"
    return addresses.coordinate("Q201", "thread depth", **{"incremental": True, "note": note} | more)


def nominal_diameter() -> Any:
    """Q335."""
    return addresses.length("Q335", "nominal diameter", example=10)


def prepositioning_feed() -> Any:
    """Q253: into the workpiece and out of it."""
    return addresses.feed(
        "Q253", "feed rate for pre-positioning", ("FMAX", "FAUTO"), at_most=addresses.FAR, example=750
    )


def countersinking_feed() -> Any:
    """Q254."""
    return addresses.feed(
        "Q254", "feed rate for countersinking", ("FAUTO", "FU"), at_most=addresses.FAR, example=150
    )  # fmt: skip


def milling_feed() -> Any:
    """Q207, at the cutting edge."""
    return addresses.milling_feed(("FAUTO",), note="of the cutting edge", example=500)


def approach_feed() -> Any:
    """Q512."""
    return addresses.feed("Q512", "feed rate for approaching", ("FAUTO",), default=0, note="0: as Q207", example=0)


def threads_per_step() -> Any:
    """Q355."""
    return param(
        "Q355", "threads per step", "count", type="integer", at_least=0, at_most=99999, modal=True, example=1,
        note="0: one turn; 1: a continuous helix; more: single turns, so many pitches apart",
    )  # fmt: skip


def front_depth() -> Any:
    """Q358."""
    return addresses.coordinate("Q358", "depth at front", incremental=True, note="0: no countersink", example=0)


def front_offset(meaning: str = "offset at front") -> Any:
    """Q359."""
    return addresses.length("Q359", meaning, incremental=True, example=0)

"""Kinds of addresses of the cycles of chapters 9 and 10, and those that many share, each declared once.

No parameter of these cycles is kept for a later block. Feeds are in mm/min whatever G94 or G95 says, and do not become
the modal feed.
"""

from __future__ import annotations

from functools import partial
from typing import Any

from mnclab.machine.cycle import param


def distance(address: str, meaning: str, example: float, **more: Any) -> Any:
    """A length that is there."""
    return param(address, meaning, above=0, incremental=True, example=example, **more)


def allowance(address: str, meaning: str, example: float, note: str = "") -> Any:
    """A length that may be 0, and is if it is not written."""
    return param(address, meaning, default=0, at_least=0, incremental=True, note=note, example=example)


def side(address: str, meaning: str, example: float) -> Any:
    """A length of a figure, from 0."""
    return param(address, meaning, at_least=0, incremental=True, example=example)


def coordinate(address: str, meaning: str, example: float) -> Any:
    """Absolute under G90 and G91 (MNC-MILL-ABS)."""
    return param(address, meaning, note="absolute", example=example)


def choice(address: str, meaning: str, choices: dict[float, str], example: float, **more: Any) -> Any:
    """One of a few numbers."""
    return param(address, meaning, "choice", choices=choices, example=example, **more)


def speed(address: str, meaning: str, example: float, **more: Any) -> Any:
    """Of the spindle; another one where it is not written."""
    return param(address, meaning, "rev/min", default=None, example=example, **more)


def dwell(address: str, meaning: str, example: float) -> Any:
    """Seconds."""
    return param(address, meaning, "s", default=0, at_least=0, example=example)


def own_feed(address: str, meaning: str, example: float) -> Any:
    """A feed that must be written."""
    return param(address, meaning, "mm/min", above=0, example=example)


def other_feed(address: str, meaning: str, example: float) -> Any:
    """A feed that is F where it is not written, or 0."""
    return param(
        address, meaning, "mm/min", default=None, default_means="F", at_least=0, note="0: the same as F", example=example
    )  # fmt: skip


def angle(address: str, meaning: str, example: float) -> Any:
    """Within one turn either way, degrees."""
    return param(address, meaning, "deg", default=0, at_least=-360, at_most=360, example=example)


# --- one address ---------------------------------------------------------------------------------------------------------


def feed(meaning: str, example: float = 150) -> Any:
    """F: into the material."""
    return param("F", meaning, "mm/min", default=None, default_means="the modal feed", above=0, example=example)


def clearance(meaning: str = "clearance above the surface") -> Any:
    """Q: how far above the material the tool moves at rapid."""
    return distance("Q", meaning, 2)


def depth(meaning: str = "depth from the surface to the bottom", example: float = -15) -> Any:
    """H: how far the bottom lies from the surface, negative."""
    return param("H", meaning, below=0, incremental=True, example=example)


def overlap(most: float, example: float) -> Any:
    """K: the stepover as a share of the tool radius."""
    note = "stepover at most K times R"
    return param("K", "path overlap factor", "ratio", at_least=0.1, at_most=most, example=example, note=note)


surface = partial(param, "Z", "workpiece surface", note="always absolute", example=0)
dwell_top = partial(dwell, "E", "dwell at the clearance level", 0.1)
dwell_bottom = partial(dwell, "T", "dwell at the bottom", 0.25)

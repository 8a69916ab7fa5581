"""Kinds of addresses of the cycles of chapters 9 and 10, and those that many share, each declared once.

No parameter of these cycles is kept for a later block. Feeds are in mm/min whatever G94 or G95 says, and do not become
the modal feed.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from mnclab.machine.cycle import param

ONE_PASS = {"default": None, "default_means": "one pass"}


def kind(unit: str = "mm", **alike: Any) -> Callable[..., Any]:
    """Declares addresses of one kind by their letter, meaning and example; more may be said of each."""

    def declare(address: str, meaning: str, example: float, **more: Any) -> Any:
        return param(address, meaning, unit, example=example, **alike, **more)

    return declare


length = kind(incremental=True)
distance = kind(above=0, incremental=True)
allowance = kind(default=0, at_least=0, incremental=True)
side = kind(at_least=0, incremental=True)  # of a figure
coordinate = kind(note="absolute")  # under G90 and G91 (MNC-MILL-ABS)
count = kind("count", type="integer", at_least=0)
speed = kind("rev/min", default=None)
dwell = kind("s", default=0, at_least=0)
own_feed = kind("mm/min", above=0)
other_feed = kind("mm/min", default=None, default_means="F", at_least=0, note="0: the same as F")
angle = kind("deg", default=0, at_least=-360, at_most=360)  # within one turn either way

feed = partial(kind("mm/min", default=None, default_means="the modal feed", above=0), "F", example=150)
clearance = partial(distance, "Q", meaning="clearance above the surface", example=2)
depth = partial(kind(below=0, incremental=True), "H", meaning="depth from the surface to the bottom", example=-15)
surface = partial(kind(note="always absolute"), "Z", "workpiece surface", 0)
dwell_top = partial(dwell, "E", "dwell at the clearance level", 0.1)
dwell_bottom = partial(dwell, "T", "dwell at the bottom", 0.25)


def choice(address: str, meaning: str, choices: dict[float, str], example: float, **more: Any) -> Any:
    """One of a few numbers."""
    return param(address, meaning, "choice", choices=choices, example=example, **more)


def overlap(most: float, example: float) -> Any:
    """K: the stepover as a share of the tool radius."""
    note = "stepover at most K times R"
    return param("K", "path overlap factor", "ratio", at_least=0.1, at_most=most, example=example, note=note)

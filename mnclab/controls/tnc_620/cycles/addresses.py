"""Q parameters that many cycles share, each declared once; a cycle that differs says in what.

Every Q parameter is modal: it holds its value until a program writes it again, whatever cycle reads it.
"""

from __future__ import annotations

from typing import Any

from mnclab.machine.cycle import param

FAR = 99999.9999  # mm, the largest length that a cycle takes
FAST = 99999.999  # mm/min
LONG = 3600.0  # s

CLIMB: dict[float, str] = {1: "climb", -1: "conventional", 0: "climb"}
TIP: dict[float, str] = {0: "depth refers to the tool tip", 1: "depth refers to the cylindrical part of the tool"}
OPERATION: dict[float, str] = {0: "roughing and finishing", 1: "only roughing", 2: "only finishing"}
EDGE: dict[float, str] = {
    0: "at the tool centre",
    1: "at the cutting edge when finishing the side",
    2: "at the cutting edge when finishing side and floor",
    3: "always at the cutting edge",
}


def _declare(address: str, meaning: str, unit: str, usual: dict[str, Any], more: dict[str, Any]) -> Any:
    return param(address, meaning, unit, **{"modal": True, **usual, **more})


def coordinate(address: str, meaning: str, **more: Any) -> Any:
    """A coordinate or a signed length, mm."""
    return _declare(address, meaning, "mm", {"at_least": -FAR, "at_most": FAR}, more)


def length(address: str, meaning: str, **more: Any) -> Any:
    """A length from 0, mm."""
    return _declare(address, meaning, "mm", {"at_least": 0, "at_most": FAR}, more)


def angle(address: str, meaning: str, **more: Any) -> Any:
    """An angle within one turn either way, degrees."""
    return _declare(address, meaning, "deg", {"at_least": -360, "at_most": 360}, more)


def feed(address: str, meaning: str, also: tuple[str, ...] = (), **more: Any) -> Any:
    """A feed rate, mm/min, or one of the words that stand for one."""
    return _declare(address, meaning, "mm/min", {"at_least": 0, "at_most": FAST, "also": also}, more)


def seconds(address: str, meaning: str, **more: Any) -> Any:
    """A dwell."""
    return _declare(address, meaning, "s", {"at_least": 0, "at_most": LONG}, more)


def count(address: str, meaning: str, **more: Any) -> Any:
    """How many of something."""
    return _declare(address, meaning, "count", {"type": "integer"}, more)


def choice(address: str, meaning: str, choices: dict[float, str], **more: Any) -> Any:
    """One of a few numbers."""
    return _declare(address, meaning, "choice", {"choices": choices}, more)


def clearance(**more: Any) -> Any:
    """Q200: from the tool tip to the surface before the tool goes in at its feed."""
    return length("Q200", "set-up clearance", **{"incremental": True} | more)


def depth(**more: Any) -> Any:
    """Q201: from the surface, negative downwards."""
    return coordinate("Q201", "depth", **{"incremental": True, "note": "from the surface; negative is down"} | more)


def infeed(**more: Any) -> Any:
    """Q202: how deep the tool goes at once."""
    return length("Q202", "infeed depth", **{"incremental": True, "note": "0: in one pass"} | more)


def surface(**more: Any) -> Any:
    """Q203: where the workpiece begins."""
    return coordinate("Q203", "coordinate of the workpiece surface", **more)


def second_clearance(**more: Any) -> Any:
    """Q204: how high above the surface nothing is in the way."""
    return length("Q204", "second set-up clearance", **{"incremental": True, "note": "if greater than Q200"} | more)


def plunge_feed(also: tuple[str, ...] = ("FAUTO", "FU"), **more: Any) -> Any:
    """Q206: along the tool axis."""
    return feed("Q206", "feed rate for plunging", also, **more)


def milling_feed(also: tuple[str, ...] = ("FAUTO", "FU", "FZ"), **more: Any) -> Any:
    """Q207: in the plane."""
    return feed("Q207", "feed rate for milling", also, **more)


def dwell_bottom(**more: Any) -> Any:
    """Q211: at the bottom."""
    return seconds("Q211", "dwell at the bottom", **more)


def climb(**more: Any) -> Any:
    """Q351: which way the tool goes round with the spindle at M3."""
    return choice("Q351", "climb or conventional milling", CLIMB, **more)


def operation(**more: Any) -> Any:
    """Q215: what of a cycle is done."""
    return choice("Q215", "machining operation", OPERATION, **more)


def finishing_infeed(**more: Any) -> Any:
    """Q338: how deep the tool goes at once along a wall."""
    return length("Q338", "infeed for finishing", **{"incremental": True, "note": "0: in one infeed"} | more)


def side_allowance(**more: Any) -> Any:
    """Q368: what roughing leaves at the walls."""
    return length("Q368", "finishing allowance for side", **{"incremental": True} | more)


def floor_allowance(**more: Any) -> Any:
    """Q369: what roughing leaves on the floor."""
    return length("Q369", "finishing allowance for floor", **{"incremental": True} | more)


def overlap(least: float, **more: Any) -> Any:
    """Q370: the stepover as a share of the tool radius."""
    return param(
        "Q370",
        "path overlap factor",
        "ratio",
        **{"at_least": least, "at_most": 1.9999, "modal": True, "predef": True} | more,
    )


def finishing_feed(also: tuple[str, ...] = ("FAUTO", "FU", "FZ"), **more: Any) -> Any:
    """Q385: along walls and floor."""
    return feed("Q385", "finishing feed rate", also, **more)


def feed_reference(**more: Any) -> Any:
    """Q439: what a feed refers to."""
    return choice("Q439", "feed rate reference", EDGE, **{"default": 0} | more)


def reference(**more: Any) -> Any:
    """Q395: what of the drill reaches the depth."""
    return choice("Q395", "depth reference", TIP, **{"default": 0} | more)

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
DISENGAGE: dict[float, str] = {0: "not at all", 1: "in -X", 2: "in -Y", 3: "in +X", 4: "in +Y"}
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


def number(address: str, meaning: str, **more: Any) -> Any:
    """How many, from 1."""
    return _declare(address, meaning, "count", {"type": "integer", "at_least": 1, "at_most": 99999}, more)


def choice(address: str, meaning: str, choices: dict[float, str], **more: Any) -> Any:
    """One of a few numbers."""
    return _declare(address, meaning, "choice", {"choices": choices}, more)


def count(address: str, meaning: str, most: float, unit: str = "count", **more: Any) -> Any:
    """A whole number from 0."""
    return _declare(address, meaning, unit, {"at_least": 0, "at_most": most, "type": "integer"}, more)


def clearance(**more: Any) -> Any:
    """Q200: from the tool tip to the surface before the tool goes in at its feed."""
    return length("Q200", "set-up clearance", **{"incremental": True, "example": 2} | more)


def depth(**more: Any) -> Any:
    """Q201: from the surface, negative downwards."""
    note = "from the surface; negative is down"
    return coordinate("Q201", "depth", **{"incremental": True, "note": note, "example": -20} | more)


def infeed(**more: Any) -> Any:
    """Q202: how deep the tool goes at once."""
    return length("Q202", "infeed depth", **{"incremental": True, "note": "0: in one pass", "example": 5} | more)


def decrement(**more: Any) -> Any:
    """Q212: how much smaller each infeed is than the one before."""
    return length("Q212", "decrement of the infeed", **{"incremental": True, "example": 1} | more)


def min_infeed(**more: Any) -> Any:
    """Q205: what the decrement leaves of an infeed."""
    return length("Q205", "least infeed", **{"incremental": True, "note": "where Q212 is not 0", "example": 3} | more)


def break_retract(**more: Any) -> Any:
    """Q256: how far the tool goes back to break the chip."""
    return length(
        "Q256", "distance back to break the chip", **{"incremental": True, "at_most": FAST, "example": 0.2} | more
    )


def start_depth(**more: Any) -> Any:
    """Q379: how deep the hole is already."""
    note = "the tool moves at Q253 to a level above it"
    return length("Q379", "depth of the starting point", **{"incremental": True, "note": note, "example": 5} | more)


def surface(**more: Any) -> Any:
    """Q203: where the workpiece begins."""
    return coordinate("Q203", "coordinate of the workpiece surface", **{"example": 0} | more)


def second_clearance(**more: Any) -> Any:
    """Q204: how high above the surface nothing is in the way."""
    return length(
        "Q204", "second set-up clearance", **{"incremental": True, "note": "if greater than Q200", "example": 20} | more
    )


def plunge_feed(also: tuple[str, ...] = ("FAUTO", "FU"), **more: Any) -> Any:
    """Q206: along the tool axis."""
    return feed("Q206", "feed rate for plunging", also, **{"example": 150} | more)


def milling_feed(also: tuple[str, ...] = ("FAUTO", "FU", "FZ"), **more: Any) -> Any:
    """Q207: in the plane."""
    return feed("Q207", "feed rate for milling", also, **more)


def retract_feed(also: tuple[str, ...] = ("FMAX", "FAUTO"), **more: Any) -> Any:
    """Q208: out of the hole."""
    return feed("Q208", "retraction feed rate", also, **{"note": "0: as Q206", "example": 500} | more)


def positioning_feed(also: tuple[str, ...] = ("FMAX", "FAUTO"), **more: Any) -> Any:
    """Q253: where the tool moves inside the hole without cutting."""
    return feed("Q253", "feed rate for pre-positioning", also, **{"at_most": FAR, "example": 750} | more)


def dwell_top(**more: Any) -> Any:
    """Q210: over the hole, for the chips."""
    return seconds("Q210", "dwell at the set-up clearance", **{"example": 0.1} | more)


def dwell_bottom(**more: Any) -> Any:
    """Q211: at the bottom."""
    return seconds("Q211", "dwell at the bottom", **{"example": 0.25} | more)


def disengage(shift: bool = False, **more: Any) -> Any:
    """Q214: where a tool goes before it leaves a bore; a `shift` must have a direction."""
    choices = {key: where for key, where in DISENGAGE.items() if key or not shift}
    return choice("Q214", "direction in which the tool leaves the wall", choices, **{"example": 1} | more)


def spindle_angle(**more: Any) -> Any:
    """Q336: where the spindle stops before that."""
    return angle("Q336", "angle of the spindle stop", **{"example": 30} | more)


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
    return choice("Q395", "depth reference", TIP, **{"default": 0, "example": 0} | more)

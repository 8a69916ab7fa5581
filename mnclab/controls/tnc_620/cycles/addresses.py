"""Q parameters that many cycles share, each declared once; a cycle that differs says in what: `depth(example=-3)`.

Every Q parameter is modal: it holds its value until a program writes it again, whatever cycle reads it.
"""

from __future__ import annotations

from functools import partial
from typing import Any

from mnclab.machine.cycle import param

PLANE = ("FAUTO", "FU", "FZ")  # words in place of a feed rate of milling
POSITIONING = ("FMAX", "FAUTO")
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


# --- surface and planes ----------------------------------------------------------------------------------------------

surface = partial(coordinate, "Q203", "coordinate of the workpiece surface", example=0)
clearance = partial(length, "Q200", "set-up clearance", incremental=True, example=2)
second_clearance = partial(
    length, "Q204", "second set-up clearance", incremental=True, note="if greater than Q200", example=20
)
side_clearance = partial(length, "Q357", "clearance to the side", incremental=True, example=2)

# --- depths ----------------------------------------------------------------------------------------------------------

DOWN = "from the surface; negative is down"
depth = partial(coordinate, "Q201", "depth", incremental=True, note=DOWN, example=-20)
start_depth = partial(
    length, "Q379", "depth of the starting point", incremental=True, note="the tool moves at Q253 to a level above it",
    example=5,
)  # fmt: skip
reference = partial(choice, "Q395", "depth reference", TIP, default=0, example=0)

# --- infeeds of a hole -----------------------------------------------------------------------------------------------

infeed = partial(length, "Q202", "infeed depth", incremental=True, note="0: in one pass", example=5)
decrement = partial(length, "Q212", "decrement of the infeed", incremental=True, example=1)
min_infeed = partial(length, "Q205", "least infeed", incremental=True, note="where Q212 is not 0", example=3)
break_retract = partial(length, "Q256", "distance back to break the chip", incremental=True, at_most=FAST, example=0.2)
dwell_top = partial(seconds, "Q210", "dwell at the set-up clearance", example=0.1)
dwell_bottom = partial(seconds, "Q211", "dwell at the bottom", example=0.25)
spindle_angle = partial(angle, "Q336", "angle of the spindle stop", example=30)


def disengage(shift: bool = False, **more: Any) -> Any:
    """Q214: where a tool goes before it leaves a bore; a `shift` must have a direction."""
    choices = {key: where for key, where in DISENGAGE.items() if key or not shift}
    return choice("Q214", "direction in which the tool leaves the wall", choices, **{"example": 1} | more)


# --- feeds -----------------------------------------------------------------------------------------------------------

plunge_feed = partial(feed, "Q206", "feed rate for plunging", also=("FAUTO", "FU"), example=150)
milling_feed = partial(feed, "Q207", "feed rate for milling", also=PLANE, example=500)
finishing_feed = partial(feed, "Q385", "finishing feed rate", also=PLANE)
retract_feed = partial(feed, "Q208", "retraction feed rate", also=POSITIONING, note="0: as Q206", example=500)
positioning_feed = partial(feed, "Q253", "feed rate for pre-positioning", also=POSITIONING, at_most=FAR, example=750)
feed_reference = partial(choice, "Q439", "feed rate reference", EDGE, default=0, example=0)

# --- pockets, slots, studs and faces ---------------------------------------------------------------------------------

operation = partial(choice, "Q215", "machining operation", OPERATION, example=0)
climb = partial(choice, "Q351", "climb or conventional milling", CLIMB, example=1)
layer = partial(
    infeed, note="greater than 0; at most the length of the edges, LCUTS"
)  # one of roughing, unlike a peck never 0
finishing_infeed = partial(length, "Q338", "infeed for finishing", incremental=True, note="0: in one infeed", example=5)
side_allowance = partial(length, "Q368", "finishing allowance for side", incremental=True, example=0.2)
floor_allowance = partial(length, "Q369", "finishing allowance for floor", incremental=True, example=0.1)
side = partial(coordinate, incremental=True)  # of a surface: its sign points into it
corner = partial(coordinate, "Q220", "rounding (+) or bevel (-) of the corners", note="a bevel counts on each side")
slot_width = partial(length, "Q219", "slot width", note="equal to the tool: only roughing", example=12)
rotation = partial(angle, meaning="angle of rotation", note="about the tool position", example=15)
overlap = partial(
    param, "Q370", meaning="path overlap factor", unit="ratio", at_most=1.9999, modal=True, predef=True, example=1,
    note="stepover at most Q370 times R",
)  # fmt: skip


def plunging(choices: dict[float, str]) -> Any:
    """Q366: how the tool goes down."""
    return choice("Q366", "plunging strategy", choices, predef=True, example=1)


# --- threads ---------------------------------------------------------------------------------------------------------

pitch = partial(
    param, "Q239", "thread pitch", "mm/rev", at_least=-99.9999, at_most=99.9999, modal=True,
    note="+ right-hand, - left-hand", example=1.5,
)  # fmt: skip
thread_depth = partial(coordinate, "Q201", "thread depth", incremental=True, note=DOWN)
nominal_diameter = partial(length, "Q335", "nominal diameter", example=10)
threads_per_step = partial(
    param, "Q355", "threads per step", "count", type="integer", at_least=0, at_most=99999, modal=True, example=1,
    note="0: one turn; 1: a continuous helix; more: single turns, so many pitches apart",
)  # fmt: skip
edge_feed = partial(milling_feed, also=("FAUTO",), note="of the cutting edge")
approach_feed = partial(feed, "Q512", "feed rate for approaching", ("FAUTO",), default=0, note="0: as Q207", example=0)
countersinking_feed = partial(feed, "Q254", "feed rate for countersinking", ("FAUTO", "FU"), at_most=FAR, example=150)
front_depth = partial(coordinate, "Q358", "depth at front", incremental=True, note="0: no countersink", example=0)
front_offset = partial(length, "Q359", meaning="offset at front", incremental=True, example=0)

"""Q parameters that many cycles share, each declared once; a cycle that differs says in what: `depth(example=-3)`.

Every Q parameter is modal: it holds its value until a program writes it again, whatever cycle reads it.
"""

from __future__ import annotations

from functools import partial
from types import SimpleNamespace
from typing import Any

from mnclab.machine.cycle import param

PLANE = ("FAUTO", "FU", "FZ")  # words in place of a feed rate of milling
POSITIONING = ("FMAX", "FAUTO")
FAR = 99999.9999  # mm, the largest length that a cycle takes
FAST = 99999.999  # mm/min
LONG = 3600.0  # s

CLIMB: dict[float, str] = {1: "climb", -1: "conventional", 0: "as 1"}
TIP: dict[float, str] = {0: "depth refers to the tool tip", 1: "depth refers to the cylindrical part of the tool"}
DISENGAGE: dict[float, str] = {0: "not at all", 1: "in -X", 2: "in -Y", 3: "in +X", 4: "in +Y"}
OPERATION: dict[float, str] = {0: "roughing and finishing", 1: "only roughing", 2: "only finishing"}
EDGE: dict[float, str] = {
    0: "at the tool centre", 1: "at the cutting edge when finishing the side",
    2: "at the cutting edge when finishing side and floor", 3: "always at the cutting edge",
}  # fmt: skip
CORNERS: dict[float, str] = {
    1: "at the lower left corner", 2: "at the lower right corner",
    3: "at the upper right corner", 4: "at the upper left corner",
}  # fmt: skip
MEANDER: dict[float, str] = {0: "meander, stepover outside the surface", 1: "meander, stepover at its edge"}
PLUNGE: dict[float, str] = {0: "vertical", 1: "helical", 2: "reciprocating"}

# --- kinds: address, meaning, and what differs -----------------------------------------------------------------------
coordinate = partial(param, unit="mm", modal=True, at_least=-FAR, at_most=FAR)  # or a length with a sign
increment = partial(coordinate, incremental=True)
length = partial(param, unit="mm", modal=True, at_least=0, at_most=FAR)
distance = partial(length, incremental=True)
angle = partial(param, unit="deg", modal=True, at_least=-360, at_most=360)
feed = partial(param, unit="mm/min", modal=True, at_least=0, at_most=FAST)
seconds = partial(param, unit="s", modal=True, at_least=0, at_most=LONG)
ratio = partial(param, unit="ratio", modal=True, at_least=0.0001)
percent = partial(ratio, unit="%")
count = partial(param, unit="count", modal=True, at_least=0, at_most=99999, type="integer")
number = partial(count, at_least=1)


def choice(address: str | tuple[str, ...], meaning: str, choices: dict[float, str], **more: Any) -> Any:
    """One of a few numbers."""
    return param(address, meaning, "choice", **{"modal": True, "choices": choices, **more})


# --- surface and planes ----------------------------------------------------------------------------------------------
surface = partial(coordinate, "Q203", "coordinate of the workpiece surface", example=0)
clearance = partial(distance, "Q200", "set-up clearance", example=2)
second_clearance = partial(distance, "Q204", "second set-up clearance", note="if greater than Q200", example=20)
side_clearance = partial(distance, "Q357", meaning="clearance to the side", example=2)

# --- depths ----------------------------------------------------------------------------------------------------------
DOWN = "from the surface; negative is down"
depth = partial(increment, "Q201", "depth", note=DOWN, example=-20)
start_depth = partial(
    distance, "Q379", "depth of the starting point", note="the tool moves at Q253 to a level above it", example=5
)
reference = partial(choice, "Q395", "depth reference", TIP, default=0, example=0)

# --- infeeds of a hole -----------------------------------------------------------------------------------------------
infeed = partial(distance, "Q202", "infeed depth", note="0: in one pass", example=5)
decrement = partial(distance, "Q212", "decrement of the infeed", example=1)
min_infeed = partial(distance, "Q205", "least infeed", note="where Q212 is not 0", example=3)
break_retract = partial(distance, "Q256", meaning="distance back to break the chip", at_most=FAST, example=0.2)
first_stop = partial(distance, "Q258", "upper advanced stop distance")
break_every = partial(distance, "Q257", meaning="infeed depth for chip breaking", example=5)
dwell_top = partial(seconds, "Q210", "dwell at the set-up clearance", example=0.1)
dwell_bottom = partial(seconds, "Q211", "dwell at the bottom", example=0.25)
spindle_angle = partial(angle, "Q336", meaning="angle of the spindle stop", example=30)


def disengage(shift: bool = False) -> Any:
    """Q214: where a tool goes before it leaves a bore; a `shift` must have a direction."""
    choices = {key: where for key, where in DISENGAGE.items() if key or not shift}
    return choice("Q214", "direction in which the tool leaves the wall", choices, example=1)


# --- feeds -----------------------------------------------------------------------------------------------------------
plunge_feed = partial(feed, "Q206", "feed rate for plunging", also=("FAUTO", "FU"), example=150)
milling_feed = partial(feed, "Q207", "feed rate for milling", also=PLANE, example=500)
finishing_feed = partial(feed, "Q385", "finishing feed rate", also=PLANE)
retract_feed = partial(feed, "Q208", "retraction feed rate", also=POSITIONING, note="0: as Q206", example=500)
positioning_feed = partial(feed, "Q253", "feed rate for pre-positioning", also=POSITIONING, at_most=FAR, example=750)
feed_reference = partial(choice, "Q439", "feed rate reference", EDGE, default=0, example=0)

# --- pockets, slots, studs and faces ---------------------------------------------------------------------------------
machining_operation = partial(choice, "Q215", "machining operation", OPERATION, example=0)
milling_type = partial(choice, "Q351", "climb or conventional milling", CLIMB, example=1)
layer = partial(infeed, note="greater than 0; at most the length of the edges, LCUTS")  # of roughing, never 0
greatest_infeed = partial(distance, "Q202", "greatest infeed")
finishing_infeed = partial(distance, "Q338", "infeed for finishing", note="0: in one infeed", example=5)
side_allowance = partial(distance, "Q368", "finishing allowance for side", example=0.2)
floor_allowance = partial(distance, "Q369", "finishing allowance for floor", example=0.1)
corner = partial(coordinate, "Q220", "rounding (+) or bevel (-) of the corners", note="a bevel counts on each side")
slot_width = partial(length, "Q219", "slot width", note="equal to the tool: only roughing", example=12)
rotation = partial(angle, meaning="angle of rotation", note="about the tool position", example=15)
overlap = partial(
    ratio, "Q370", meaning="path overlap factor", at_most=1.9999, predef=True, example=1,
    note="stepover at most Q370 times R",
)  # fmt: skip
plunging = partial(choice, "Q366", "plunging strategy", predef=True, example=1)

# --- threads ---------------------------------------------------------------------------------------------------------
pitch = partial(
    param, "Q239", "thread pitch", "mm/rev", at_least=-99.9999, at_most=99.9999, modal=True,
    note="+ right-hand, - left-hand", example=1.5,
)  # fmt: skip
thread_depth = partial(increment, "Q201", "thread depth", note=DOWN)
nominal_diameter = partial(length, "Q335", "nominal diameter", example=10)
threads_per_step = partial(
    count, "Q355", "threads per step", example=1,
    note="0: one turn; 1: a continuous helix; more: single turns, so many pitches apart",
)  # fmt: skip
edge_feed = partial(milling_feed, also=("FAUTO",), note="of the cutting edge")
approach_feed = partial(feed, "Q512", "feed rate for approaching", also=("FAUTO",), default=0, note="0: as Q207", example=0)
countersinking_feed = partial(
    feed, "Q254", meaning="feed rate for countersinking", also=("FAUTO", "FU"), at_most=FAR, example=150
)
depth_at_front = partial(increment, "Q358", "depth at front", note="0: no countersink", example=0)
offset_at_front = partial(distance, "Q359", meaning="offset at front", example=0)


def shared(**own: Any) -> SimpleNamespace:
    """All of these for the cycles of one chapter, with those that differ there or stand there under another name."""
    return SimpleNamespace(**{**globals(), **own})

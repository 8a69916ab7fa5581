"""How rotary axes move: A, B and C of a straight line, M116, M126, M128, M138, FUNCTION TCPM and their ends.

A machine whose kinematics is not known has A, B and C as positions of their own beside those of the tip: there these functions
stay as long as no rotary axis moves, and one that moves under them is refused.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from mnclab.controls.tnc_620.cycles.chain import carry, to_angle, to_rotary
from mnclab.controls.tnc_620.cycles.tilting import rotary_axes
from mnclab.controls.tnc_620.language.auxiliary import rate
from mnclab.controls.tnc_620.language.values import counted, first, one_of
from mnclab.controls.tnc_620.state import Led, memory
from mnclab.geometry import frames
from mnclab.geometry.kinematics import Axis, shorter
from mnclab.machine.axes import chain, reckon, swing, travel, turn_axes, turning_feed
from mnclab.machine.control import FunctionTable, Setting, Words
from mnclab.machine.coordinates import AXES, STILL, Angles, angles, set_angles
from mnclab.machine.machine import Machine
from mnclab.running.cycles import perform
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
SOURCE = "Klartext, not described"
TITLES = {
    "M116": "Feed of rotary axes in mm/min", "M117": "End of M116", "M126": "Shortest way of rotary axes",
    "M127": "End of M126", "M128": "Tool centre point management", "M129": "End of M128",
}  # fmt: skip
GROUPS = {"rotary feed": "M116", "rotary way": "M126", "tool centre": "M128"}
KINEMATICS = 'Setup(kinematics="table-ac"), or one of its own, says where the rotary axes are'
SETTINGS = (
    Setting(
        "tcpm_tolerance", 0.01, "how far the tip may leave its way where rotary axes turn, without T of cycle 32", SOURCE,
        unit="mm", at_least=0.0001,
    ),
)  # fmt: skip
LEADS = {"F": ("TCP", "CONT"), "AXIS": ("POS", "SPAT"), "PATHCTRL": ("AXIS", "VECTOR"), "REFPNT": ("TIP-TIP",)}
WORDS = {
    "M128:F": "feed rate of the compensating moves", "M128:FMAX": "compensating moves at rapid",
    **{f"M138:{axis}": f"the rotary axis {axis} tilts" for axis in AXES},
    "TCPM:F": "what the feed counts along", "TCPM:AXIS": "what A, B and C are", "TCPM:PATHCTRL": "how the tool turns",
    "TCPM:REFPNT": "the point that is led, and the one that it turns about",
}  # fmt: skip


# --- A, B and C of a straight line ------------------------------------------------------------------------------------

def turned(m: Machine, words: Words, to: dict[str, Any], f: float | None) -> bool:
    """Turn the rotary axes that L names, together with its coordinates `to`; False where only these are left to be gone to."""
    named = [words[axis] for axis in AXES if axis in words]
    if not named:
        return False
    led = memory(m).led
    goal = by_direction(m, words, led) if led is not None and led.spatial is not None else positions(m, words)
    if goal == angles(m):
        return False
    refuse_turn(m, named[0])
    if m.tables.kinematics is None:
        target = m.to_machine(m.target(to.get("x"), to.get("y"), to.get("z")))
        if alone := math.dist(target, m.tip) <= STILL:  # a frame rounds
            turn_axes(m, goal, f)
        else:
            set_angles(m, goal)
        return alone
    point = m.target(to.get("x"), to.get("y"), to.get("z")) if to else None
    alone = point is None or math.dist(point, m.programmed) <= STILL
    if alone and m.modal.get("rotary feed") == "M116" and f is None:
        swing(m, goal, None, minutes(m, goal), named[0], most=led.most if led else math.inf)
    elif led is not None:
        travel(m, goal, point, f, named[0], led.most, led.of_all, led.in_plane)
    else:
        travel(m, goal, point, f, named[0])
    return True


def refuse_turn(m: Machine, word: Word) -> None:
    """An Alarm where no rotary axis may move."""
    refuse_rotary(m, word)
    if memory(m).developed is not None:
        m.alarm(f"{word}: the contour of a cylinder has X and Y alone, X for the rotary axis", word)
    if m.tables.kinematics is None:
        return
    if m.side:
        m.alarm(f"{word}: rotary axes cannot turn under radius compensation", word, "write R0")
    if memory(m).machine_datum is not None and memory(m).led is not None:
        m.alarm(f"{word}: rotary axes cannot turn in machine coordinates while the tip is led", word, "write M129 before")


def positions(m: Machine, words: Words) -> Angles:
    """Where the rotary axes go, degrees, behind their shift and mirror image; IA counts from where it stands."""
    found, of_machine = list(angles(m)), m.tables.kinematics is not None and memory(m).machine_datum is not None
    for k, axis in enumerate(AXES):
        if (word := words.get(axis)) is None:
            continue
        if of_machine:
            found[k] = counted(m, word, found[k])
        else:
            goal = to_rotary(m, k, counted(m, word, to_angle(m, k, found[k])))
            found[k] = goal if word.incremental else shortest(m, axis, found[k], goal)
    return found[0], found[1], found[2]


def shortest(m: Machine, name: str, here: float, goal: float) -> float:
    """The position, degrees, that shows the same and is nearest (M126), where the limits of the axis allow it."""
    kinematics = m.tables.kinematics
    if m.modal.get("rotary way") != "M126" or kinematics is None or name not in kinematics.names:
        return goal
    way = math.remainder(goal - here, 360)
    near = here + (180 if way == -180 else way)
    low, high = kinematics.axis(name).limits
    return near if low <= near <= high else goal


def by_direction(m: Machine, words: Words, led: Led) -> Angles:
    """Where the rotary axes go for spatial angles of the tool in the active system (AXIS SPAT); one left out stays."""
    assert led.spatial is not None
    a, b, c = (counted(m, words[axis], old) if axis in words else old for axis, old in zip(AXES, led.spatial, strict=True))
    memory(m).led = led._replace(spatial=(a, b, c))
    tool = m.matrix[:3, :3] @ frames.spatial(*map(math.radians, (a, b, c)))[:3, 2]
    now = np.array([m.rotary])
    found = np.degrees(shorter(chain(m).solutions(tool, now, memory(m).tilting), now)[0]).tolist()
    if math.isnan(found[0]):
        word = next(words[axis] for axis in AXES if axis in words)
        what = f"no position of {' and '.join(chain(m).names)} turns the tool to the spatial angles A{a:g} B{b:g} C{c:g}"
        m.alarm(what, word, f"the machine: {chain(m)}")
    return found[0], found[1], found[2]


def minutes(m: Machine, goal: Angles) -> float:
    """How long a turn takes under M116: a table turns the tip past the part at the feed, mm/min; other axes, and one that goes
    through the tip, have degrees a minute."""
    feed, kinematics = m.feed_of(None), chain(m)
    place, longest = np.array([*m.tip, 1.0]), 0.0
    way = {axis: abs(new - old) for axis, new, old in zip(AXES, goal, angles(m), strict=True)}
    for axis in kinematics.sequence:
        far = 0.0
        if axis in kinematics.table:
            far = distance(axis, place[:3])
            place = axis.turns(np.array(-m.rotary[axis.number])) @ place
        takes = math.radians(way[axis.name]) * far / feed if far > STILL else way[axis.name] / turning_feed(m)
        longest = max(longest, takes)
    return longest


def distance(axis: Axis, place: Any) -> float:
    """From a place (3,) to an axis, mm."""
    return float(np.linalg.norm(np.cross(place - np.array(axis.centre), np.array(axis.direction))))


# --- M functions ------------------------------------------------------------------------------------------------------

@FUNCTIONS("M116", TITLES, group="rotary feed", phase="start", source=SOURCE)
@FUNCTIONS("M117", TITLES, group="rotary feed", phase="end", power_on="M117", source=SOURCE)
@FUNCTIONS("M126", TITLES, group="rotary way", phase="start", source=SOURCE)
@FUNCTIONS("M127", TITLES, group="rotary way", phase="start", power_on="M127", source=SOURCE)
def rule(m: Machine, words: Words) -> None:
    """It waits for a rotary axis that moves."""


@FUNCTIONS("M128", TITLES, group="tool centre", phase="start", takes="M128:F M128:FMAX", source="9.3")
def tool_centre(m: Machine, words: Words) -> None:
    """The tip stays where it is while rotary axes move; F is for the compensating moves alone."""
    word = one_of(m, words, ("M128:F", "M128:FMAX"), "one feed")
    if m.tables.kinematics is None:
        if any(m.rotary):
            m.alarm("M128 is not built yet where rotary axes have turned", words.words[0], KINEMATICS)
        return
    if word is not None and word.address == "M128:F" and word.value is None:
        m.alarm("M128 F needs a number", word, "for example M128 F1000")
    slow = word is not None and word.address == "M128:F"
    lead(m, words, Led(rate(m, word, "M128 F (feed rate of the compensating moves)") if slow and word else math.inf))


@FUNCTIONS("FUNCTION RESET TCPM,", "End of TCPM", group="tool centre", source=SOURCE)
@FUNCTIONS("M129", TITLES, group="tool centre", phase="end", power_on="M129", source=SOURCE)
def let_go(m: Machine, words: Words) -> None:
    """The tip is led no more: coordinates count again as they did before, no axis moves."""
    if memory(m).led is None:
        return
    refuse_side(m, words)
    memory(m).led = None
    perform(m, words.code, carry(m))
    reckon(m, memory(m).tilt_axes or (0.0, 0.0, 0.0))


@FUNCTIONS(
    "FUNCTION TCPM,", "Leading the tip", group="tool centre", takes=" ".join(f"TCPM:{word}" for word in LEADS), source=SOURCE,
)  # fmt: skip
def tcpm(m: Machine, words: Words) -> None:
    """The tip follows its way on the part while rotary axes turn. F TCP: the feed is that of the tip, F CONT along all axes of
    the block, mm and degrees; AXIS POS: A, B, C are positions, AXIS SPAT spatial angles of the tool; PATHCTRL AXIS: the rotary
    axes run evenly, PATHCTRL VECTOR: the tool turns in the plane of its directions. What is left out is the first of each."""
    chosen = {name: str(words[f"TCPM:{name}"].value) if f"TCPM:{name}" in words else LEADS[name][0] for name in LEADS}
    if (word := words.get("TCPM:REFPNT")) is not None and chosen["REFPNT"] not in LEADS["REFPNT"]:
        m.alarm(f"FUNCTION TCPM REFPNT {word.value} is not built yet", word, "REFPNT TIP-TIP is")
    if m.tables.kinematics is None:
        m.alarm("FUNCTION TCPM needs the kinematics of the machine", first(words), KINEMATICS)
    spatial = (0.0, 0.0, 0.0) if chosen["AXIS"] == "SPAT" else None
    lead(m, words, Led(math.inf, chosen["F"] == "CONT", spatial, chosen["PATHCTRL"] == "VECTOR"))


def lead(m: Machine, words: Words, how: Led) -> None:
    refuse_side(m, words)
    memory(m).led = how
    perform(m, words.code, carry(m))
    reckon(m, None)


def refuse_side(m: Machine, words: Words) -> None:
    if m.side:
        m.alarm(f"{words.code} cannot stand under radius compensation", first(words), "write R0 before")


@FUNCTIONS("M138", "Choice of tilting axes", takes=" ".join(f"M138:{axis}" for axis in AXES), phase="start", source=SOURCE)
def choice_of_axes(m: Machine, words: Words) -> None:
    """The named axes tilt the plane from now on, the others stay where they are; without a name those of the machine do."""
    if m.tables.kinematics is None:
        m.alarm("M138 needs the kinematics of the machine", words.words[0], KINEMATICS)
    named = [word for word in words.words if word.address.startswith("M138:")]
    for word in named:
        axis = word.address[5:]
        if word.value is not None:
            m.alarm(f"M138 names an axis without a number, got {axis}{m.value(word):g}", word)
        if axis not in rotary_axes(m).names:
            m.alarm(f"M138 {axis}: the machine has no such rotary axis: {rotary_axes(m)}", word)
    memory(m).tilting = "".join(word.address[5:] for word in named) or None
    m.log("tilting axes", memory(m).tilting)


def refuse_rotary(m: Machine, word: Word) -> None:
    """A rotary axis moves under one of the functions, and where it is nobody knows."""
    for group, code in GROUPS.items() if m.tables.kinematics is None else ():
        if m.modal.get(group) == code:
            m.alarm(f"{word.address} under {code} ({TITLES[code].lower()}) is not built yet", word, KINEMATICS)

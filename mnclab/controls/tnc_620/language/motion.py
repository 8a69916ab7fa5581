"""Straight lines and arcs: L, CC, C, CR, RND, with feed and radius compensation (catalogue: axis words, F, R0 RL RR)."""

from __future__ import annotations

from typing import Any

from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import INF, Machine
from mnclab.path.corners import Rounding
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
AXES = "XYZ"
FEEDS = ("F", "FMAX", "FAUTO")
SIDES = {"R0": 0, "RL": 1, "RR": -1}
NAMES = {0: "R0", 1: "RL", -1: "RR"}
TOLERANCE = 0.016  # mm between the radii at start and end of an arc (catalogue: C)


def coordinates(m: Machine, words: Words, axes: str = AXES) -> dict[str, Any]:
    """Targets of the axes that are written, as arguments of a verb (``x=``, …); IX counts from the register."""
    found: dict[str, Any] = {}
    for k, axis in enumerate(AXES):
        if axis in axes and axis in words:
            value = m.value(words[axis])
            found[axis.lower()] = m.programmed[k] + value if words[axis].incremental else value
    return found


def feed(m: Machine, words: Words) -> float | None:
    """Set the feed of this and the following blocks; inf for FMAX, which counts in its block alone."""
    given = [words[name] for name in FEEDS if name in words]
    if len(given) > 1:
        m.alarm(f"{given[0]} and {given[1]} stand in one block: one feed is allowed", given[1])
    if "FMAX" in words:
        return INF
    if "FAUTO" in words:
        m.change("feed", auto_feed(m, words["FAUTO"]))
    if "F" in words:
        value = m.value(words["F"])
        if value <= 0:
            m.alarm(f"F (feed rate) must be greater than 0, got {value:g}", words["F"])
        m.change("feed", value)
    return None


def auto_feed(m: Machine, word: Word) -> float:
    """The feed of the TOOL CALL block, mm/min."""
    value: float | None = m.memory.get("auto feed")
    if value is None:
        m.alarm("FAUTO needs a feed in the TOOL CALL block", word, hint="write TOOL CALL … F500")
    return value


def named(m: Machine, word: Word) -> float | str:
    """FAUTO in a cycle: bound when the cycle is defined (3.1); FMAX stays a word."""
    if word.value == "FAUTO":
        return auto_feed(m, word)
    if word.value in ("FMAX", "PREDEF"):
        return str(word.value)
    m.alarm(f"{word}: a feed per revolution or per tooth is not built yet", word, hint="write the feed in mm/min")


def side(m: Machine, words: Words, begins: bool) -> None:
    """R0 RL RR: only a straight line or an approach begins or ends the compensation; others may repeat it."""
    given = [words[name] for name in SIDES if name in words]
    if len(given) > 1:
        m.alarm(f"{given[0]} and {given[1]} stand in one block: one of R0, RL, RR is allowed", given[1])
    for word in given:
        wanted = SIDES[word.address]
        if wanted != m.side and not begins:
            verb = "end" if wanted == 0 else "begin"
            m.alarm(
                f"{word} cannot {verb} the radius compensation in {words.code}",
                word,
                hint="write it in a straight line L",
            )
        m.change("side", wanted)


@FUNCTIONS("L", "Straight line", takes="X Y Z R0 RL RR F FMAX FAUTO", source="2 L")
def line(m: Machine, words: Words) -> None:
    """From the present position to the programmed point at feed, or with FMAX at rapid; axes not written keep their value."""
    f = feed(m, words)
    side(m, words, begins=True)
    if to := coordinates(m, words):
        m.line(**to, f=f)


@FUNCTIONS("CC", "Circle centre, pole", takes="X Y", source="CC")
def centre(m: Machine, words: Words) -> None:
    """No motion; without coordinates the last programmed position."""
    to = coordinates(m, words)
    if len(to) == 1:
        m.alarm("CC needs both coordinates of the plane, or none for the last programmed position", words.words[0])
    m.pole = (to.get("x", m.programmed[0]), to.get("y", m.programmed[1]))
    m.log("pole", m.pole)


def sense(m: Machine, words: Words) -> int:
    """DR+ counter-clockwise (1), DR- clockwise (-1)."""
    if "DR" not in words:
        m.alarm(
            f"{words.code} needs the sense of rotation", None, hint="write DR+ (counter-clockwise) or DR- (clockwise)"
        )
    word = words["DR"]
    if word.value not in ("+", "-"):
        m.alarm(f"{words.code} DR (sense of rotation) must be DR+ or DR-, got {word}", word)
    return 1 if word.value == "+" else -1


@FUNCTIONS("C", "Circular path around CC", takes="X Y DR R0 RL RR F FMAX FAUTO", source="C")
def circle(m: Machine, words: Words) -> None:
    """An arc around the centre CC; an end equal to the start is a full circle."""
    f = feed(m, words)
    side(m, words, begins=False)
    if m.pole is None:
        m.alarm("C needs a circle centre: no CC was programmed", None, hint="write CC X… Y… before it")
    turning = sense(m, words)
    refuse_rapid(m, words)
    m.arc(**coordinates(m, words, "XY"), sense=turning, centre=dict(enumerate(m.pole)), f=f, tolerance=TOLERANCE)


@FUNCTIONS("CR", "Circular path with radius", takes="X Y R DR R0 RL RR F FMAX FAUTO", source="CR")
def circle_by_radius(m: Machine, words: Words) -> None:
    """An arc of a radius: up to half a turn, with a negative radius more."""
    f = feed(m, words)
    side(m, words, begins=False)
    turning, to = sense(m, words), coordinates(m, words, "XY")
    refuse_rapid(m, words)
    if "R" not in words:
        m.alarm("CR needs the radius R", None)
    radius = m.value(words["R"])
    if radius == 0:
        m.alarm("CR R (radius) must not be 0", words["R"])
    x, y, _ = m.target(to.get("x"), to.get("y"), None)
    if abs(x - m.programmed[0]) < 1e-3 and abs(y - m.programmed[1]) < 1e-3:
        m.alarm("CR needs an end other than its start", words["R"], hint="a full circle is written with CC and C")
    m.arc(**to, sense=turning, radius=radius, f=f, word=words["R"])


def refuse_rapid(m: Machine, words: Words) -> None:
    """Arcs run at feed."""
    if "FMAX" in words:
        m.alarm(f"{words.code} runs at feed: FMAX is for straight lines", words["FMAX"])


@FUNCTIONS("RND", "Corner rounding", takes="R F", collects=True, source="RND")
def rounding(m: Machine, words: Words) -> None:
    """A tangent arc between the element before and the one after; F counts for the rounding alone."""
    if "R" not in words:
        m.alarm("RND needs the radius R", None)
    radius = m.value(words["R"])
    if radius <= 0:
        m.alarm(f"RND R (rounding radius) must be greater than 0, got {radius:g}", words["R"])
    own = m.value(words["F"]) if "F" in words else float("nan")
    if own <= 0:
        m.alarm(f"RND F (feed rate) must be greater than 0, got {own:g}", words["F"])
    if not m.mark_joint(Rounding(radius, m.step, own)):
        m.alarm("RND needs a path element directly before it", words["R"])

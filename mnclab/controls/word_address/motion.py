"""Motion, planes, feed, spindle and tool: what G-word controls mean by the same words."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, Self

from mnclab.machine.control import FunctionTable, Obey, Words
from mnclab.machine.coordinates import PLANES
from mnclab.machine.machine import Machine
from mnclab.path.tool import Tool
from mnclab.text.alarm import PLACES, Alarm
from mnclab.text.program import Word

# What milling controls of G words keep beside the common state of a machine.

@dataclass
class Memory:
    """Of such a control; each adds its own."""

    machine_coordinates: bool = False  # in a block with G53: no offset counts
    next_tool: Tool | None = None  # of T, which M6 puts into the spindle

    @classmethod
    def of(cls, m: Machine) -> Self:
        """What is kept beside a machine."""
        kept: Self = m.memory
        return kept


memory = Memory.of


# Straight and circular motion, planes, feed, spindle and tool: what G-word controls mean by the same words.

AXES = "XYZ"
CENTRE = "IJK"
ARGUMENTS = (("X", "x"), ("Y", "y"), ("Z", "z"))


def coordinates(m: Machine, words: Words, absolute: bool) -> dict[str, Any]:
    """Targets of the axes that are written, as arguments of a verb (`x=`, …); increments count from the register."""
    found = {
        name: value if type(value := words[axis][1]) is float and m.variable_unit == 1 else m.length(words[axis])
        for axis, name in ARGUMENTS
        if axis in words
    }
    if not absolute:
        for k, (_, name) in enumerate(ARGUMENTS):
            if name in found:
                found[name] += m.programmed[k]
    return found


def first_word(words: Words) -> Word | None:
    """The word that called a function, or else the first one it took; where alarms about the whole block point."""
    return words.words[0] if words.words else None


def arc(m: Machine, words: Words, sense: int, absolute: bool, line_without_centre: bool = False) -> None:
    """A circular block by R or by I J K, with a third axis a helix.

    `line_without_centre`: neither R nor I J K gives a straight line (MNC 3.4, note 1), else an alarm.
    """
    arc_to(m, words, coordinates(m, words, absolute), sense, line_without_centre)


def arc_to(
    m: Machine, words: Words, to: dict[str, Any], sense: int, line_without_centre: bool = False,
    absolute_centre: bool = False, turns: int = 1,
) -> None:  # fmt: skip
    """The same to a place that is known; the centre may count from the origin, and the arc go round several times."""
    offsets = {k: words[c] for k, c in enumerate(CENTRE) if c in words}
    if not offsets and "R" not in words:
        if to and not line_without_centre:
            m.alarm("an arc needs R or I J K", first_word(words))
        if to:
            as_a_line(m, words, "R and without I J K")
            m.line(**to, word=first_word(words))
        return
    first, second, normal = PLANES[m.plane]
    if normal in offsets:
        plane = f"plane {m.plane} has no {CENTRE[normal]}: its centre is given by {CENTRE[first]} and {CENTRE[second]}"
        m.alarm(f"{CENTRE[normal]} stands along the axis of the arc, {plane}", offsets[normal])
    third = AXES[normal].lower()
    if third in to and to[third] != m.programmed[normal]:
        helix(m, words)
    by_radius = "R" in words and not (offsets and m.settings.get("arc_by_both") == "centre")
    if "R" in words and offsets:
        both = "R and I J K stand in one block"
        if m.settings.get("arc_by_both") == "refuse":
            m.alarm(both, words["R"], hint="keep one of them")
        m.warn(f"{both}: {'R counts' if by_radius else 'I J K count'}", words["R"])
    head = words["R"] if by_radius else next(iter(offsets.values()))
    radius = m.length(head) if by_radius else None
    if radius == 0:
        m.alarm("R must not be 0", head)
    if absolute_centre and not by_radius and (missing := [CENTRE[k] for k in (first, second) if k not in offsets]):
        m.alarm(f"the centre of the arc lacks {missing[0]}", head, hint="G90.1 is active: it counts from the origin")
    start = (0.0, 0.0, 0.0) if absolute_centre else m.programmed
    centre = None if by_radius else {k: start[k] + m.length(word) for k, word in offsets.items()}
    middle = [(centre or {}).get(k, m.programmed[k]) for k in (first, second)]
    end = [to.get(ARGUMENTS[k][1], m.programmed[k]) for k in (first, second)]
    tolerance = arc_tolerance(m, max(math.dist(end, middle), math.dist((m.programmed[first], m.programmed[second]), middle)))
    if by_radius:
        tolerance = float(m.settings.get("arc_reach", tolerance))
    try:
        m.arc(**to, sense=sense, centre=centre, radius=radius, word=head, tolerance=tolerance, turns=turns)
    except Alarm as alarm:
        if centre and "arc_centres" in m.settings and not alarm.hint:
            alarm.hint = other_centre(m, to, centre, start, tolerance)
        raise


def other_centre(m: Machine, to: dict[str, Any], centre: dict[int, float], start: Iterable[float], tolerance: float) -> str:
    """The hint that I J K fit where they count from the origin instead of the start of the arc, or the other way round."""
    first, second, _ = PLANES[m.plane]
    begun, here, absolute = m.programmed, list(start), not any(start)
    middle = [centre.get(k, here[k]) - here[k] + (begun[k] if absolute else 0.0) for k in (first, second)]
    end = [to.get(ARGUMENTS[k][1], begun[k]) for k in (first, second)]
    radius = math.dist((begun[first], begun[second]), middle)
    if radius < tolerance or abs(radius - math.dist(end, middle)) > tolerance:
        return ""
    choice = 'G91.1, or the setting arc_centres="start"' if absolute else 'G90.1, or the setting arc_centres="origin"'
    return f"counted from the {'start of the arc' if absolute else 'origin'} they fit, radius {radius:.4g}: {choice}"


def arc_tolerance(m: Machine, radius: float = 0.0) -> float:
    """By how much the radii at both ends of an arc may differ, mm; of LinuxCNC a part of the larger one, too."""
    allowed, share = m.settings.get("arc_tolerance", 0.01), m.settings.get("arc_tolerance_share", 0.0)
    if share:
        allowed *= 2.54 if m.variable_unit > 1 else 1.0
        return float(min(max(allowed, share * radius), 100 * allowed))
    return float(allowed)


def as_a_line(m: Machine, words: Words, lacks: str) -> None:
    """Say that an arc that nothing gives a shape is a straight line, which its manual allows and few mean."""
    if m.settings["lint"] != "off":
        hint = "an arc needs its radius or its centre in every block; for a line write G1"
        m.warn(f"{words.code} without {lacks} is obeyed as a straight line", first_word(words), hint)


def helix(m: Machine, words: Words) -> None:
    """Say that an arc with a word of the third axis is a helix."""
    remark(m, "helix", _helix(m), words[AXES[PLANES[m.plane][2]]])


def _helix(m: Machine) -> str:
    third = AXES[PLANES[m.plane][2]]
    return f"{third} in an arc of the plane {m.plane} makes a helix, which the manual does not describe"


def more_helices(m: Machine, count: int) -> bool:
    """Whether helices need no word of their own, being allowed, or named often enough: then `count` more are counted."""
    choice, told = m.settings.get("helix", "warn"), m.alarms.warned(_helix(m), m.program)
    if choice == "warn" and told and len(told.places) >= PLACES:
        told.count += count
        m.alarms.total += count
        return True
    return choice not in ("warn", "refuse")


def remark(m: Machine, setting: str, sentence: str, word: Word | None) -> None:
    """What a manual does not describe: a warning, an alarm, or nothing, as a setting wants it."""
    choice = m.settings.get(setting, "warn")
    if choice == "refuse":
        m.alarm(sentence, word, hint=f"setting {setting}")
    if choice == "warn":
        m.warn(sentence, word)


def feed(m: Machine, words: Words) -> None:
    """F: the feed along the path, kept until a new one."""
    if (value := m.value(words["F"])) <= 0:
        m.alarm(f"F (feed rate) must be greater than 0, got {value:g}", words["F"])
    m.change("feed", value * m.variable_unit)


def spindle_speed(m: Machine, words: Words) -> None:
    """S: the spindle speed."""
    if (value := m.value(words["S"])) < 0:
        m.alarm(f"S (spindle speed) must be at least 0, got {value:g}", words["S"])
    m.spindle(speed=value)


def spindle(m: Machine, words: Words) -> None:
    """M3 and M4 before the motion of the block, M5 after it."""
    if words.code == "M5":
        m.at_block_end(lambda: m.spindle(turning=0))
    else:
        m.spindle(turning=1 if words.code == "M3" else -1)


def tool(m: Machine, words: Words) -> None:
    """T: the tool from the table is active at once; no axis moves."""
    row = tool_row(m, words["T"], "tool")
    refuse_change(m, "tool", words["T"])
    m.change_tool(row)


def choose_tool(m: Machine, words: Words) -> None:
    """T: the tool that M6 puts into the spindle."""
    memory(m).next_tool = row = tool_row(m, words["T"], "tool")
    m.log("next tool", row.number)


def change_tool(m: Machine, words: Words) -> None:
    """M6: the tool of T comes into the spindle."""
    row = memory(m).next_tool
    if row is None:
        m.alarm("M6 has no tool to put into the spindle", first_word(words), hint="write T before it")
    refuse_change(m, "tool", first_word(words))
    m.change_tool(row)


def corrector(m: Machine, words: Words) -> None:
    """D: until the next T, corrections and radius come from another row of the tool table; no axis moves.

    By the setting corrector_length the length too.
    """
    row = tool_row(m, words["D"], "corrector")
    refuse_change(m, "corrector", words["D"])
    other = replace(m.tables.tools[m.tool.number].of_radius(row.radius, row.dr), dl=row.dl)
    if m.settings.get("corrector_length"):
        other = replace(other, length=row.length)
    if other.effective_length != m.tool.effective_length:
        m.change_tool(other)
    else:
        m.change("tool", other)


def tool_row(m: Machine, word: Word, name: str) -> Tool:
    """The row of the tool table that a word T or D names."""
    number, letter = m.value(word), word.address
    if number != int(number) or not 0 <= number <= 99:
        m.alarm(f"{letter} ({name} number) must be a whole number from 0 to 99, got {number:g}", word)
    if int(number) not in m.tables.tools:
        known = ", ".join(f"{letter}{n}" for n in sorted(m.tables.tools))
        m.alarm(f"{letter}{int(number)} has no row in the tool table", word, hint=f"tools: {known}")
    return m.tables.tools[int(number)]


def uncompensated(m: Machine, words: Words) -> None:
    """An Alarm under radius compensation."""
    if m.side:
        m.alarm(f"{words.code} cannot stand under radius compensation", first_word(words), hint="write G40 first")


def leave_frames(m: Machine, names: Iterable[str]) -> None:
    """Coordinates are those of the machine in this block: these frames count for nothing, and are back after it."""
    kept = {name: m.frames[name] for name in names}

    def restore() -> None:
        for name, frame in kept.items():
            m.set_frame(name, frame)
        memory(m).machine_coordinates = False

    memory(m).machine_coordinates = True
    for name in kept:
        m.set_frame(name, None)
    m.at_block_end(restore)


def refuse_change(m: Machine, name: str, word: Word | None) -> None:
    """An Alarm under radius compensation: an equidistant has one radius."""
    if m.side:
        m.alarm(f"the {name} cannot change while radius compensation is active", word, hint="write G40 first")


# What milling controls of G words have alike: planes, dimensions, feed, blending, compensation, end of cycles, M functions.

ARCS = {"G2": "Circular interpolation clockwise", "G3": "Circular interpolation counter-clockwise"}
SPINDLE = {"M3": "Spindle on clockwise", "M4": "Spindle on counter-clockwise", "M5": "Spindle stop"}
PLANE_CODES = {"G17": "Plane XY", "G18": "Plane ZX", "G19": "Plane YZ"}
DIMENSIONS = {"G90": "Absolute dimensions", "G91": "Incremental dimensions"}
FEEDS = {"G94": "Feed per minute", "G95": "Feed per revolution"}
STOPS = {"G61": "Exact stop between blocks", "G64": "Block blending"}
SIDES = {"G40": 0, "G41": 1, "G42": -1}
COMPENSATION = {"G40": "Radius compensation off", "G41": "Radius compensation left", "G42": "Radius compensation right"}
PAUSES = {"M0": "Program stop", "M1": "Optional stop"}
RETURN = {"G98": "Return to the initial level", "G99": "Return to level R"}
COOLANT = {"M7": "Coolant 2 on", "M8": "Coolant on", "M9": "Coolant off"}


def functions(remark: Obey, source: str, **sources: str) -> FunctionTable:
    """Their table for a control, which may `remark` on each of them first; `sources` of groups, and one of the others."""
    table = FunctionTable()
    of = defaultdict(lambda: source, sources)

    @table("G17 G18 G19", PLANE_CODES, group="plane", phase="plane", power_on="G17", source=of["plane"])
    def plane(m: Machine, words: Words) -> None:
        """The plane of arcs, radius compensation, polar coordinates and rotation; holes lie along Z in all of them."""
        remark(m, words)
        head = first_word(words)
        plane = {"G17": "XY", "G19": "YZ"}.get(words.code) or m.settings.get("g18_axes", "ZX")
        if m.pole is not None and plane != m.plane:
            m.alarm("the plane cannot change while polar coordinates are on", head, hint="write G15 first")
        if plane != m.plane:
            refuse_change(m, "plane", head)
        m.change("plane", plane)

    @table("G90 G91", DIMENSIONS, group="dimension", phase="plane", power_on="G90", source=of["dimension"])
    def dimension(m: Machine, words: Words) -> None:
        """Coordinates of the selected system, or distances from the last programmed point."""
        remark(m, words)

    @table("G94 G95", FEEDS, group="feed mode", phase="plane", power_on="G94", source=of["feed_mode"])
    def feed_mode(m: Machine, words: Words) -> None:
        """What F means, mm/min or mm/rev; a new F must follow, unless the setting feed_mode_switch says otherwise."""
        remark(m, words)
        per_rev, speed, switch = words.code == "G95", abs(m.spindle_speed), m.settings.get("feed_mode_switch")
        if per_rev != m.per_rev and m.feed is not None and switch != "kept":
            converted = switch == "converted" and speed > 0
            m.change("feed", (m.feed / speed if per_rev else m.feed * speed) if converted else None)
        m.change("per_rev", per_rev)

    @table("G61 G64", STOPS, group="blending", phase="plane", power_on="G64", source=of["blending"])
    def exact_stop(m: Machine, words: Words) -> None:
        """Whether every motion ends with exact positioning; the path is the same."""
        remark(m, words)
        m.change("exact", words.code == "G61")

    side = of["compensation"]

    @table("G40 G41 G42", COMPENSATION, group="compensation", phase="compensation", power_on="G40", source=side)
    def compensation(m: Machine, words: Words) -> None:
        """Takes effect with the next straight line in the plane: entry, change of side, exit."""
        remark(m, words)
        m.change("side", SIDES[words.code])

    @table("G80", "Fixed cycle off", group="cycle", phase="plane", power_on="G80", ends_cycle=True, source=of["cycle"])
    def cycle_off(m: Machine, words: Words) -> None:
        """Ends the fixed cycle, and forgets a prepared one."""
        m.position_cycle = m.cycle = None

    @table("G98 G99", RETURN, group="return", phase="plane", power_on="G98", source=of["cycle"])
    def return_level(m: Machine, words: Words) -> None:
        """Where a fixed cycle leaves the tool; a prepared one always ends at its start point."""

    @table("M0 M1", PAUSES, phase="end", modal=False, source=source)
    def program_stop(m: Machine, words: Words) -> None:
        """Wait for the operator, after the motion of the block."""
        remark(m, words)
        m.stop()

    @table("M2 M30", "Program end", phase="end", modal=False, leads_away=True, source=source)
    def program_end(m: Machine, words: Words) -> None:
        """The program ends here, after the motion of the block, and the spindle stops; without it, at the end of the text."""
        remark(m, words)
        m.spindle(turning=0)
        m.set_modal("spindle", "M5")
        m.ended = True

    @table("M9", COOLANT, group="coolant", phase="end", power_on="M9", source=source)
    @table("M7 M8", COOLANT, group="coolant", phase="auxiliary", source=source)
    def coolant(m: Machine, words: Words) -> None:
        """On before the motion of the block, off after it."""
        remark(m, words)
        m.coolant()

    return table

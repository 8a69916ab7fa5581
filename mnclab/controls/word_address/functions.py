"""What milling controls of G words have alike: planes, dimensions, feed, blending, compensation, end of cycles, M functions."""

from __future__ import annotations

from collections import defaultdict

from mnclab.controls.word_address.motion import first_word, refuse_change
from mnclab.machine.control import FunctionTable, Obey, Words
from mnclab.machine.machine import Machine

ARCS = {"G2": "Circular interpolation clockwise", "G3": "Circular interpolation counter-clockwise"}
SPINDLE = {"M3": "Spindle on clockwise", "M4": "Spindle on counter-clockwise", "M5": "Spindle stop"}
PLANES = {"G17": "Plane XY", "G18": "Plane ZX", "G19": "Plane YZ"}
DIMENSIONS = {"G90": "Absolute dimensions", "G91": "Incremental dimensions"}
FEEDS = {"G94": "Feed per minute", "G95": "Feed per revolution"}
STOPS = {"G61": "Exact stop between blocks", "G64": "Block blending"}
SIDES = {"G40": 0, "G41": 1, "G42": -1}
COMPENSATION = {"G40": "Radius compensation off", "G41": "Radius compensation left", "G42": "Radius compensation right"}
RETURN = {"G98": "Return to the initial level", "G99": "Return to level R"}
PAUSES = {"M0": "Program stop", "M1": "Optional stop"}
COOLANT = {"M7": "Coolant 2 on", "M8": "Coolant on", "M9": "Coolant off"}


def functions(remark: Obey, source: str, **sources: str) -> FunctionTable:
    """Their table for a control, which may `remark` on each of them first; `sources` of groups, and one of the others."""
    table = FunctionTable()
    of = defaultdict(lambda: source, sources)

    @table("G17 G18 G19", PLANES, group="plane", phase="plane", power_on="G17", source=of["plane"])
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
        """The program ends here, after the motion of the block; without it, at the end of the text."""
        remark(m, words)
        m.ended = True

    @table("M9", COOLANT, group="coolant", phase="end", power_on="M9", source=source)
    @table("M7 M8", COOLANT, group="coolant", phase="auxiliary", source=source)
    def coolant(m: Machine, words: Words) -> None:
        """On before the motion of the block, off after it."""
        remark(m, words)
        m.coolant()

    return table

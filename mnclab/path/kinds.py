"""The kinds of rows in a toolpath, and the rules of radius compensation that made them."""

from __future__ import annotations

from enum import IntEnum


class Kind(IntEnum):
    """What a row of a toolpath is. Motion rows are RAPID, LINE, ARC and PROBE; the others are events."""

    RAPID = 0
    LINE = 1
    ARC = 2
    PROBE = 3
    DWELL = 4
    TOOL = 5
    SPINDLE = 6
    COOLANT = 7
    STOP = 8


MOTION_KINDS = (Kind.RAPID, Kind.LINE, Kind.ARC, Kind.PROBE)


class Rule(IntEnum):
    """Which rule of radius compensation made a row of the tool-centre path; column `rule`.

    A row along the contour is called after the way its end was found: where the next offset begins (SIDE), where both
    offsets are prolonged to (OUTSIDE_STRAIGHT) or cut off (INSIDE). OUTSIDE_ARC rows are inserted about a corner.
    """

    NONE = 0
    SIDE = 1
    OUTSIDE_ARC = 2
    OUTSIDE_STRAIGHT = 3
    INSIDE = 4
    ENTRY = 5
    EXIT = 6
    CHANGE = 7


#: What each rule is called in pictures, lists and legends.
RULE_NAMES: dict[Rule, str] = {
    Rule.NONE: "not compensated",
    Rule.SIDE: "along the side",
    Rule.OUTSIDE_ARC: "outside corner, arc",
    Rule.OUTSIDE_STRAIGHT: "outside corner, straight",
    Rule.INSIDE: "inside corner",
    Rule.ENTRY: "entry",
    Rule.EXIT: "exit",
    Rule.CHANGE: "change of side",
}

"""What kind of work a cycle does, by what its declaration says of itself: which pictures its parameters need."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

from mnclab.lab.sketches.ink import Sheet


class Kind(NamedTuple):
    """What a cycle works: in section, from above, and whether material is around it; or what it touches, or turns."""

    section: str
    figure: str
    inside: bool = True


Draw = Callable[[Sheet, Kind], None]

#: words in the title of a cycle -> its kind; the first that fits
MILLED = (
    ("outside thread", Kind("outside thread", "circle", False)),
    ("thread|tapping", Kind("thread", "circle")),
    ("back bor", Kind("back boring", "circle")),
    ("cent(er|r)ing", Kind("centring", "point")),
    ("bore milling", Kind("bore", "circle")),
    ("pilot drilling", Kind("hole", "contour")),
    ("cartesian pattern", Kind("hole", "grid")),
    ("polar pattern", Kind("hole", "pattern")),
    ("drill|peck|fixed cycles|chip breaking", Kind("hole", "point")),
    ("ream|bor(e|ing)", Kind("bore", "point")),
    ("cylinder surface ridge", Kind("cylinder ridge", "ridge", False)),
    ("cylinder surface slot", Kind("cylinder", "slot")),
    ("cylinder surface", Kind("cylinder", "contour")),
    ("circular slot", Kind("pocket", "ring")),
    ("slot", Kind("pocket", "slot")),
    ("circular pocket", Kind("pocket", "circle")),
    ("circular stud", Kind("stud", "circle", False)),
    ("polygon stud", Kind("stud", "polygon", False)),
    ("stud", Kind("stud", "rectangle", False)),
    ("pocket", Kind("pocket", "rectangle")),
    ("line-by-line|multipass", Kind("level face", "face", False)),
    ("face milling", Kind("face", "face", False)),
    ("ruled surface", Kind("level face", "ruled", False)),
    ("contour|rough-out|(floor|side) finishing", Kind("pocket", "contour")),
    ("engraving", Kind("engraving", "letters")),
)
TOUCHED = (
    ("single|guarded|reference plane|polar preset|^measuring( in three dimensions)?$", Kind("touch", "point", False)),
    (r"straight side|\bangle\b", Kind("touch", "edge", False)),
    ("bolt hole", Kind("touch", "pattern")),
    ("four holes", Kind("touch", "four")),
    ("two (holes|circles)", Kind("touch", "two")),
    ("two studs", Kind("touch", "two", False)),
    ("(out|in)side( of a)? corner|side a corner", Kind("touch", "corner", False)),
    ("sphere", Kind("touch", "sphere", False)),
    ("slot", Kind("touch", "slot")),
    ("ridge", Kind("touch", "slot", False)),
    ("inside a rectangle|pocket", Kind("touch", "rectangle")),
    ("island|rectang", Kind("touch", "rectangle", False)),
    ("outside a circle|boss|stud", Kind("touch", "circle", False)),
    (r"circle|bore|hole|\bring\b|misalignment", Kind("touch", "circle")),
    ("plane", Kind("touch", "plane", False)),
    ("touch probe axis|along z|length", Kind("touch", "top", False)),
    ("basic rotation|rotary axis|edge", Kind("touch", "edge", False)),
    ("", Kind("touch", "point", False)),
)
TURNED = (
    ("drilling along x", Kind("lathe", "radial hole")),
    ("drilling", Kind("lathe", "hole")),
    ("tapping", Kind("lathe", "tap")),
    ("thread", Kind("lathe", "thread")),
    ("face groov", Kind("lathe", "face groove")),
    ("cylindrical groov", Kind("lathe", "groove")),
    ("transverse|facing", Kind("lathe", "across")),
    ("longitudinal", Kind("lathe", "along")),
)
OF_TOOLS, OTHER = Kind("tool", "tool"), Kind("", "")


@cache
def kind_of(cycle: Any) -> Kind:
    """The kind of a cycle (its class)."""
    if cycle.does == "sets tools":
        return OF_TOOLS
    title = cycle.title.lower()
    turning = hasattr(cycle, "across_along")
    table = TURNED if turning else TOUCHED if cycle.does in ("probes", "feels") or "probing" in title else MILLED
    return next((kind for words, kind in table if re.search(words, title)), OTHER)

"""What a row of a path does in its cycle, in a word or two, for `colour="step"`: roughing, finishing, entry, a peck.

The names come out of the labels of the rows ("CYCL DEF 251 layer 1 of 3, ring 2"), whatever the control.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from mnclab.path.toolpath import Toolpath

BLOCKS, OTHERS, ROUGHING, FINISHING, ENTRY = "blocks of the program", "other steps", "roughing", "finishing", "entry"
CODE = re.compile(r"(?:CYCL (?:DEF|CALL)(?: PAT| POS)?|G)\s?\d*\s*")
NUMBERS = re.compile(r" ?(?<!\d)\d++ of \d++| \d++(?=,|$)")
COARSE = ("layer", "level", "pass", "line", "opening")
FINE = ("contour", "clean-up", "finishing")
MOST = 6  # names; what makes the shortest way goes together beyond


def step_name(label: str) -> str:
    """The step of a label; what no cycle made is `BLOCKS`."""
    code = CODE.match(label)
    if code is None:
        return BLOCKS
    head, *tail = NUMBERS.sub("", label[code.end() :]).split(", ")
    if any(piece.startswith(("entry", "plunge")) for piece in (head, *tail)):
        return ENTRY
    if head in FINE or (tail and tail[0] in FINE):
        return FINISHING
    return ROUGHING if head in COARSE else head or BLOCKS


def steps_of(path: Toolpath) -> tuple[NDArray[np.int64], list[str]]:
    """A number for each row (n,) of a path, and the names of the numbers, in the order of the program."""
    names = [step_name(label) for label in path.labels]
    known = list(dict.fromkeys(names[label] for label in dict.fromkeys(path.label.tolist())))
    way = {name: 0.0 for name in known}
    for label, length in enumerate(np.bincount(path.label, path.lengths * np.isfinite(path.feed), len(names)).tolist()):
        if names[label] in way:
            way[names[label]] += length
    if len([name for name in known if way[name]]) > MOST:
        kept = sorted(known, key=lambda name: -way[name])[: MOST - 1]
        names = [name if name in kept else OTHERS for name in names]
        known = [*(name for name in known if name in kept), OTHERS]
    number = np.array([known.index(name) if name in known else 0 for name in names], dtype=np.int64)
    return number[path.label], known

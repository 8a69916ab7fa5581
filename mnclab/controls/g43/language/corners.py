"""Corners: `,R5` rounds the corner at the end of a line or an arc, `,C2` cuts it off, two millimetres along each line."""

from __future__ import annotations

import math

from mnclab.machine.control import Function, FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.path.corners import Chamfer, Rounding
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
TITLES = {",R": "Corner rounding", ",C": "Chamfer"}
MAKE = {",R": Rounding, ",C": Chamfer}


def corner(m: Machine, words: Words) -> None:
    """Between the motion of this block and the next one."""
    word, made = words.words[0], m.recorder.made
    size = m.length(word)
    if size <= 0:
        m.alarm(f"{word.address} ({TITLES[word.address].lower()}) must be greater than 0, got {m.value(word):g}", word)
    m.at_block_end(lambda: mark(m, word, size, made))


def mark(m: Machine, word: Word, size: float, made: int) -> None:
    moved = m.recorder.made > made and m.modal.get("motion") in ("G1", "G2", "G3")
    if not moved or not m.mark_joint(MAKE[word.address](size, m.step, math.nan)):
        m.alarm(f"{word.address} stands in a block with a line or an arc", word)


for code, title in TITLES.items():
    FUNCTIONS[code] = Function(code, title, corner, phase="compensation", source="Fanuc", doc=corner.__doc__ or "")

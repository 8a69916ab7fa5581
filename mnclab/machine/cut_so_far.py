"""The part that a probe touches where the setup says `part="cut"`: what the program has cut up to that block.

It grows from touch to touch: only the rows made since the last one are looked at.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from mnclab.machine.cutting_rows import TILT, lifted, start_known, stock_of, tilted_rows, tools_of_rows
from mnclab.machine.tool_axis import LOG
from mnclab.path.recorder import join
from mnclab.path.toolpath import concatenate
from mnclab.text.program import Word
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.moves import Moves, moves_of
from mnclab.workpiece.milling.touched import Touched
from mnclab.workpiece.part import Part

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

CUT = "cut"


@dataclass(frozen=True, eq=False)
class CutSoFar:
    """The moves of the first `pieces` of the settled path, machine coordinates, their rows counted from touch to touch.

    `known`: every row from there on has a start that somebody said.
    """

    pieces: int
    moves: Moves
    known: bool


def part_before(m: Machine, word: Word | None) -> Part:
    """What the settled rows leave of the blank; an Alarm without a blank."""
    if m.control.lathe:
        m.alarm("what a lathe has cut cannot be touched", word, hint="give the part: Setup(part=…)")
    origin = np.array(m.origin or (0.0, 0.0, 0.0))
    stock = stock_of(m.setup.stock, m.logs.changed("stock", m.step), origin)
    if stock is None:
        hint = "the blank is two corners: Setup(stock=((0, 0, -20), (60, 40, 0))), or BLK FORM in the program"
        m.alarm("there is no blank of which the program could have cut the part to touch", word, hint=hint)
    stock = stock.moved(origin)
    before = m.cut_so_far
    m.cut_so_far = _grown(m, before if before and before.known else None, stock)
    return Touched(stock, m.cut_so_far.moves).part


def _grown(m: Machine, before: CutSoFar | None, stock: Blank) -> CutSoFar:
    """The same with the rows that were settled since."""
    pieces = m.settled[before.pieces if before else 0 :]
    if before and not pieces:
        return before
    path = concatenate(pieces) if pieces else join([], m.recorder)
    tools, which, lift = tools_of_rows(path.step, m.logs.changed("tool", m.step), m.setup.tools, m.logs.value, m.setup.true_tools)
    arrived, known = (0, 0) if before else start_known(path, m.setup.start)
    tilts, axes = (m.logs.changed(name, m.step) for name in (TILT, LOG))
    tilted = tilted_rows(path.step, tilts, axes, path.cylinder)
    more = moves_of(Cutting(lifted(path, lift), tools, which, stock, arrived, known, tilted))
    both = [before.moves, more] if before else [more]
    moves = Moves(**{name: np.concatenate([getattr(each, name) for each in both]) for name in vars(more)})
    return CutSoFar(len(m.settled), moves, known < len(path) or before is not None)

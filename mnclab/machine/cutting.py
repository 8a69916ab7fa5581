"""What rows of a path cut with, and from where: the same for a run that is over and for a machine that is still running.

A row is cut by the tool as it truly is where the setup says so (`Setup.true_tools`), else as the table has it at that row, not
as the program corrects it: DL and DR of a call lift the path and widen the contour, the mill stays as it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mnclab.machine.coordinates import LOG
from mnclab.machine.setup import Magazine
from mnclab.path.recorder import join
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath, concatenate
from mnclab.text.program import Word
from mnclab.workpiece.blank import Blank, Box, blank, from_datum, is_blank
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.moves import Moves, moves_of
from mnclab.workpiece.milling.touched import Touched
from mnclab.workpiece.part import Part

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


UPRIGHT = 1 - 1e-12  # the cosine between the axes of a tool and of the machine from which on it is not tilted
TILT = "frame tilt"  # the frame of a tilted working plane: the tool stands along its Z

Steps = NDArray[np.integer[Any]]  # the step of each row (n,)
Changes = Sequence[tuple[int, Any]]  # the steps at which something changed, and its value from there on
Lookup = Callable[[str, int], Any]  # the value of a name of the history after a step


def tools_of_rows(
    step: Steps, changes: Changes, magazine: Magazine | None, value: Lookup, true_tools: Mapping[int, Tool] = MappingProxyType({})
) -> tuple[list[Tool], Index, Array]:
    """The tools, which of them rows of some steps have (n,), and how much higher than the path its tip really is (n,), mm.

    `changes` are those of the tool in the spindle, `magazine` the tools before the program wrote into their table,
    `true_tools` those that are not as their table says.
    """
    tools, lifts = [Tool()], [0.0]
    at = []
    for when, held in changes:
        written = value(f"tools {held.number}", when)
        found = written if isinstance(written, Tool) else (magazine or {}).get(held.number, held)
        true = true_tools.get(held.number, found)
        at.append(when)
        tools.append(true if true.number else replace(true, number=held.number))
        known = held.number in true_tools or held.length == true.length
        lifts.append(held.effective_length - true.effective_length if known else 0.0)
    which = np.searchsorted(np.array(at, dtype=np.int64), step, "right") if at else np.zeros(len(step), dtype=np.int64)
    return tools, which, np.array(lifts)[which]


def lifted(path: Toolpath, lift: Array) -> Toolpath:
    """A path whose rows stand higher."""
    if not lift.any():
        return path
    up = np.zeros((len(path), 3))
    up[:, 2] = lift
    columns = {name: getattr(path, name) for name in path.all_but_ends()}
    return path.replace(**columns, start=path.start + up, end=path.end + up)


def tilted_rows(step: Steps, tilts: Changes, axes: Changes = (), cylinder: NDArray[np.int16] | None = None) -> Mask | None:
    """Rows of some steps that are made with a tool that does not stand along Z of the workpiece (n,).

    `tilts` are the changes of the frame `TILT`, `axes` those of the tool axis. `cylinder` (n,) names
    the cylinders on which rows lie, which turn the workpiece; -1 none.
    """
    found = np.asarray(cylinder >= 0) if cylinder is not None and (cylinder >= 0).any() else None
    leaning = [(when, frame is not None and not np.asarray(frame)[2, 2] > UPRIGHT) for when, frame in tilts]
    for turned in (leaning, [(when, axis != "Z") for when, axis in axes]):
        if any(on for _, on in turned):
            at, on = zip(*turned, strict=True)
            rows = np.asarray(np.array([False, *on])[np.searchsorted(np.array(at), step, "right")])
            found = rows if found is None else found | rows
    return found


def start_known(
    path: Toolpath, start: tuple[float, float, float], named: Mask | None = None, earlier: Mask | None = None
) -> tuple[int, int]:
    """From which row on the tool's height is known at the end of a row, and from which on every row's start is.

    A setup that says where the spindle starts says all of it. Else the tool comes from home: its height is known when Z (on
    a lathe X and Z) has moved, the whole place when every axis has, or when something was moved at feed. `named` (n, 3) are
    the axes whose words stand in the block of a row, `earlier` in one before it: they are where the program says, whether
    they moved or not.
    """
    if any(start):
        return 0, 0
    rows, n = np.flatnonzero(path.is_motion), len(path)
    axes = [0, 2] if path.lathe else [0, 1, 2]
    before = np.zeros((n, 3), dtype=bool) if earlier is None else earlier
    own = before if named is None else before | named
    moved = np.logical_or.accumulate((path.start != path.end)[rows] | own[rows], axis=0)[:, axes]
    high = moved.all(axis=1) if path.lathe else moved[:, -1]
    known = moved.all(axis=1) | (path.kind[rows] != Kind.RAPID)
    arrived = int(rows[high.argmax()]) if high.any() else n
    all_before = before[rows][:, axes].all(axis=1)
    firsts = [rows[said.argmax()] + late for said, late in ((known, 1), (all_before, 0)) if said.any()]
    return arrived, int(min(firsts, default=n))


def stock_of(given: Any, changes: Changes, origin: Array) -> Blank | None:
    """The blank in the coordinates of a path that counts from `origin`: that of the setup, else the last of the program.

    `changes` are those of the blank that the program gives.
    """
    if given is not None:
        found = blank(given)
        return found and from_datum(found, origin)
    last = changes[-1][1] if len(changes) else None
    if last is None or is_blank(last):
        found = last
    else:
        found = None if last.maximum is None else Box(last.minimum, last.maximum)
    return found


# The part that a probe touches where the setup says `part="cut"`: what the program has cut up to that block.
# It grows from touch to touch: only the rows made since the last one are looked at.

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

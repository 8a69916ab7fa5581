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

from mnclab.machine.axes import CHAIN, lengths_of_rows, references
from mnclab.machine.coordinates import LOG
from mnclab.machine.setup import Magazine, Setup
from mnclab.path.cylinder import SHARE, STILL, on_drum
from mnclab.path.recorder import join
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath, concatenate
from mnclab.text.program import Word
from mnclab.workpiece.blank import Blank, Box, blank, from_datum, is_blank
from mnclab.workpiece.cutting import TURNED, UPRIGHT, Cutting
from mnclab.workpiece.milling.gaps import Group
from mnclab.workpiece.milling.moves import Moves, joined, moves_of
from mnclab.workpiece.milling.tilted import screwed, tilted_groups
from mnclab.workpiece.milling.touched import Touched
from mnclab.workpiece.part import Part

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


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


def lifted(path: Toolpath, lift: Array, directions: Array | None = None) -> Toolpath:
    """A path whose rows stand higher by a lift (n,), along the tool where that has `directions` (n, 3, 3)."""
    if not lift.any():
        return path
    up = lift[:, None, None] * (np.array([[[0.0, 0.0, 1.0]]]) if directions is None else directions)
    columns = {name: getattr(path, name) for name in path.all_but_ends()}
    return path.replace(**columns, start=path.start + up[:, 0], end=path.end + up[:, -1])


def directions_of_rows(path: Toolpath, tilts: Changes, axes: Changes = ()) -> Array | None:
    """The directions of the tool on the part at the start of each row, on its way and at the end (n, 3, 3); None where it always
    stands along Z.

    Where the kinematics of the machine are not known, the tool stands along Z of the frame `TILT`, whose changes are `tilts`;
    `axes` are those of the tool axis. Rows on a cylinder turn the part under it.
    """
    n = len(path)
    frames = [np.eye(3), *(np.eye(3) if frame is None else np.asarray(frame, dtype=np.float64)[:3, :3] for _, frame in tilts)]
    along = np.eye(3)[["XYZ".index(axis) for _, axis in ((0, "Z"), *axes)]]
    own = along[np.searchsorted(np.array([when for when, _ in axes]), path.step, "right")]
    if path.kinematics is not None:
        turns = path.kinematics.orientation(np.where((path.cylinder >= 0)[:, None], 0.0, path.rotary))
    else:
        turns = np.stack(frames)[np.searchsorted(np.array([when for when, _ in tilts]), path.step, "right")]
    end = np.einsum("nij,nj->ni", turns, own)
    end[end[:, 2] > UPRIGHT] = 0.0, 0.0, 1.0
    turned = np.append(False, (np.diff(path.rotary, axis=0) != 0).any(axis=1))[:n]
    start = np.where((turned & (path.cylinder < 0))[:, None], np.concatenate([end[:1], end[:-1]]), end)
    found = np.stack([start, screwed(start, end, 0 * start, 0 * end, SHARE)[1], end], axis=1)
    if path.cylinders:
        found = on_drum(path, found)
    return found if (found[..., 2] < UPRIGHT).any() else None


def true_path(path: Toolpath, setup: Setup, tools: Changes, first: float, chains: Changes = ()) -> Toolpath:
    """A path where the tips truly are, by `Setup.true_kinematics` and the backlash of its axes, while X Y Z stand where the
    control leads them. `tools` and `chains` are changes of the tool and of its kinematics, `first` the length before."""
    true, known, n = setup.true_kinematics or setup.kinematics, path.kinematics, len(path)
    if known is None or true is None or not n:
        return path
    if true == known and not chains and not any(axis.backlash for axis in true.sequence):
        return path
    rows, stands, lengths = np.arange(n), path.rotary.copy(), lengths_of_rows(path.step, tools, first)
    for axis in true.sequence:  # an axis stays behind by half of its backlash, on the side from which it came last
        way = np.diff(path.rotary[:, axis.number], prepend=known.home[axis.number])
        last = np.maximum.accumulate(np.where(np.abs(way) > STILL, rows, -1))
        stands[:, axis.number] -= np.radians(axis.backlash) / 2 * np.where(last < 0, 0.0, np.sign(way[last]))

    def there(points: Array) -> Array:
        return true.tips(references(path, points, rows, lengths, chains), stands, lengths) - path.origin

    end, columns = there(path.end), {name: getattr(path, name) for name in path.all_but_ends()}
    columns |= {"rotary": stands, "centre": there(path.centre), "axis": there(path.end + path.axis) - end}
    start = np.concatenate([there(np.broadcast_to(path.start[0], (n, 3)))[:1], end[:-1]])
    return path.replace(**columns, start=start, end=end).annotated(kinematics=true)


def round_tables(path: Toolpath, directions: Array | None) -> Toolpath:
    """A path whose rows go round the axis of a table that alone turns, where the tool is square to it: the linear axes go evenly,
    and seen from the part the tool winds about that axis as over a drum."""
    if path.kinematics is None or directions is None:
        return path
    before = np.concatenate([path.rotary[:1], path.rotary[:-1]])
    turned, lines = np.abs(path.rotary - before) > STILL, path.kinematics.axes_on_part(before)
    kind, sweep, centre, axis = (getattr(path, name).copy() for name in ("kind", "sweep", "centre", "axis"))
    for one, points, along in lines:
        square = np.abs(np.einsum("nek,nk->ne", directions, along)).max(axis=1) < TURNED
        alone = turned[:, one.number] & (turned.sum(axis=1) == 1)
        rows = np.flatnonzero(np.isin(path.kind, (Kind.LINE, Kind.RAPID)) & alone & square)
        points, along = points[rows] - path.origin, along[rows]
        axis[rows], sweep[rows] = along, (path.rotary - before)[rows, one.number]
        kind[rows[kind[rows] == Kind.LINE]] = Kind.ARC
        centre[rows] = points + np.einsum("ni,ni->n", path.start[rows] - points, along)[:, None] * along
    columns = {name: getattr(path, name) for name in path.all_but_ends()}
    columns |= {"kind": kind, "sweep": sweep, "centre": centre, "axis": axis}
    return path.replace(**columns, start=path.start, end=path.end)


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
    """The moves of the first `pieces` of the settled path, machine coordinates, their rows counted from touch to touch; those of
    `tilted` tools by their directions.

    `known`: every row from there on has a start that somebody said.
    """

    pieces: int
    moves: Moves
    tilted: tuple[Group, ...]
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
    return Touched(stock, m.cut_so_far.moves, m.cut_so_far.tilted).part


def _grown(m: Machine, before: CutSoFar | None, stock: Blank) -> CutSoFar:
    """The same with the rows that were settled since."""
    pieces = m.settled[before.pieces if before else 0 :]
    if before and not pieces:
        return before
    path = (concatenate(pieces) if pieces else join([], m.recorder)).annotated(kinematics=m.setup.kinematics)
    changes = m.logs.changed("tool", m.step)
    tools, which, lift = tools_of_rows(path.step, changes, m.setup.tools, m.logs.value, m.setup.true_tools)
    path = true_path(path, m.setup, changes, m.tables.tools[0].effective_length, m.logs.changed(CHAIN, m.step))
    arrived, known = (0, 0) if before else start_known(path, m.setup.start)
    tilts, axes = (m.logs.changed(name, m.step) for name in (TILT, LOG))
    directions = directions_of_rows(path, tilts, axes)
    path = lifted(round_tables(path.on_workpiece(), directions), lift, directions)
    cutting = Cutting(path, tools, which, stock, arrived, known, directions)
    more, tilted = moves_of(cutting), tilted_groups(cutting)
    moves = joined([before.moves, more]) if before else more
    groups = before.tilted + tilted if before else tilted
    return CutSoFar(len(m.settled), moves, groups, known < len(path) or before is not None)

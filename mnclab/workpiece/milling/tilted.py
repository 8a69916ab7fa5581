"""Rows of a tool that does not stand along Z, as moves along Z of frames of their own; and where it turns.

A tool that stays square to an axis about which the part turns cuts piece by piece of the turn, in the direction that it has in
the middle of each, and in its own at both ends: so many that the floor is right within `FLOOR`, a wall that winds within `WALL`.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mnclab.geometry.curves import counted
from mnclab.path.cylinder import SHARE
from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.blank import Box, Revolved
from mnclab.workpiece.clamped import Placement
from mnclab.workpiece.cutting import TURNED, Cutting, frames_along
from mnclab.workpiece.milling.gaps import Group
from mnclab.workpiece.milling.moves import CHORD, STILL, Cutter, Moves, cutter_of, moves_of
from mnclab.workpiece.milling.raster import AT_ONCE, NOISE

FLOOR, WALL = 1e-3, 4e-3  # mm, of what is cut while the part turns
MOST = 20_000  # pieces of all turns, and rows of tilted tools
SWING, PLACES = 0.03, 200  # of unit vectors, between two looks at a tool that turns; places along its axis that are looked at


def left_out(cutting: Cutting) -> Iterator[tuple[Mask, str]]:
    """Rows (n,) with a tilted tool that are not followed, and what they are."""
    if cutting.tilted is None:
        return
    yield cutting.turning & ~cutting.round_ & meeting(cutting), "on which the tool turns"
    if too_many(cutting):
        yield cutting.cuts & cutting.tilted & (cutting.round_ | ~cutting.turning), f"of tilted tools, more than {MOST:,},"


def too_many(cutting: Cutting) -> bool:
    """Whether so many rows cut with a tilted tool that they are left out."""
    return cutting.tilted is not None and int((cutting.cuts & cutting.tilted).sum()) > MOST


def error_of(cutting: Cutting) -> float:
    """How far off what tilted tools cut may be, mm."""
    if cutting.tilted is None or too_many(cutting):
        return 0.0
    return max(pieces_of(cutting, rows_round(cutting))[1], CHORD)


def tilted_groups(cutting: Cutting) -> tuple[Group, ...]:
    """The moves of rows that cut with a tilted tool, a group for each direction, and those on which a drum turns."""
    if cutting.tilted is None or too_many(cutting):
        return ()
    found = []
    for turn, rows in cutting.by_direction(cutting.cuts & cutting.tilted & ~cutting.turning):
        found.append((moves_of(cutting.seen_along(turn), rows), Placement(turn)))
    return *found, *_turned(cutting)


def _turned(cutting: Cutting) -> Iterator[Group]:
    """Rows of a drum that turns under the tool, piece by piece, and the tool upright where it begins and ends to turn one way."""
    (row, up, tips), path = wound(cutting, rows_round(cutting)), cutting.path
    yield from _as_groups(cutting, row, up[1], *tips)
    along = path.axis[row] * np.sign(path.sweep[row])[:, None]
    breaks = (np.diff(row) > 1) | (np.einsum("ki,ki->k", along[1:], along[:-1]) < 1 - TURNED)
    for k, some in enumerate((np.append(True, breaks)[: len(row)], np.append(breaks, True)[: len(row)])):
        yield from _as_groups(cutting, row[some], up[2 * k][some], tips[k][some], tips[k][some])


def rows_round(cutting: Cutting) -> Index:
    """Rows on which a drum turns under the tool that are not sure to be clear of it."""
    return np.flatnonzero(cutting.round_ & meeting(cutting) if cutting.round_.any() else cutting.round_)


def wound(cutting: Cutting, rows: Index) -> tuple[Index, list[Array], list[Array]]:
    """Pieces (k,) of rows on which a drum turns under the tool: the row of each, the directions (k, 3) of the tool where it
    begins, in its middle and where it ends, and the tips (k, 3) at both ends."""
    path = cutting.path
    counts, _ = pieces_of(cutting, rows)
    owner, rank = counted(counts)
    row, share = rows[owner], np.stack([rank, rank + 0.5, rank + 1]) / counts[owner]
    if not len(row) or cutting.directions is None:
        return row, [np.zeros((0, 3))] * 3, [np.zeros((0, 3))] * 2
    axis, centre = path.axis[row], path.centre[row]
    local = []
    for end, side in ((path.start, 0), (path.end, 1)):
        up = cutting.directions[row, 2 * side]
        frame = np.stack([np.cross(axis, up), axis, up], axis=1)
        local.append(np.einsum("kij,kj->ki", frame, end[row] - centre))
    first = cutting.directions[row, 0]
    angle = (path.sweep[row] * share)[..., None]
    ups = [np.cos(turned) * first + np.sin(turned) * np.cross(axis, first) for turned in angle]
    tips = []
    for up, part in ((ups[0], share[0]), (ups[2], share[2])):
        here = local[0] + (local[1] - local[0]) * part[:, None]
        tips.append(centre + here[:, :1] * np.cross(axis, up) + here[:, 1:2] * axis + here[:, 2:] * up)
    return row, ups, tips


def _as_groups(cutting: Cutting, row: Index, up: Array, start: Array, end: Array) -> Iterator[Group]:
    """Straight moves (k,) of the part as groups of one each, with their tools along `up` (k, 3)."""
    turn = frames_along(up)
    start, end = (np.einsum("kji,kj->ki", turn, ends) for ends in (start, end))
    cutters = np.array([cutter_of(tool) for tool in cutting.tools]).reshape(-1, len(Cutter._fields))[cutting.which[row]]
    none = np.zeros(len(row))
    moves = Moves(row, start, end, none > 0, np.zeros((len(row), 2)), none, *cutters.T)
    for k in range(len(row)):
        yield moves[k : k + 1], Placement(turn[k])


def pieces_of(cutting: Cutting, rows: Index) -> tuple[Index, float]:
    """In how many pieces rows turn (k,), and how far off what they cut may be, mm."""
    path = cutting.path
    if not len(rows):
        return np.zeros(0, dtype=np.int64), 0.0
    spoke = path.start[rows] - path.centre[rows]
    out = np.maximum(np.linalg.norm(spoke, axis=1), NOISE)
    across = np.abs(path.axis[rows]).argmin(axis=1)
    wide = np.abs(cutting.stock.bounds[:, across] - path.centre[rows, across]).max(axis=0)
    rise = np.abs(np.einsum("ki,ki->k", path.end[rows] - path.start[rows], path.axis[rows]))
    angle = np.abs(path.sweep[rows])
    leans = np.maximum(wide - out, 0.0) * rise / np.maximum(np.hypot(rise, out * angle), NOISE)
    with np.errstate(divide="ignore"):
        step = np.minimum(np.sqrt(8 * FLOOR / out), 2 * WALL / leans)
    counts = np.maximum(np.ceil(angle / step), 1).astype(np.int64)
    counts = np.maximum(counts * min(1.0, MOST / counts.sum()), 1).astype(np.int64)
    own = angle / counts
    return counts, float(np.maximum(out * own**2 / 8, leans * own / 2).max())


def meeting(cutting: Cutting) -> Mask:
    """Rows (n,) on which, or before which, a tool that turns may come to the blank: it is not sure to be clear of it.

    Clear is what has all of the blank below the tip, or as far from the axis of the tool as this is thick.
    """
    found = np.zeros(len(cutting), dtype=bool)
    if cutting.directions is None:
        return found
    (first, _, last), path = np.moveaxis(cutting.directions, 1, 0), cutting.path
    before = np.concatenate([first[:1], last[:-1]])
    before[: cutting.arrived + 1] = first[: cutting.arrived + 1]  # nobody has said where the tool was
    turns = cutting.turning
    swings = path.is_motion & ~turns & (np.abs(before - first) > TURNED).any(axis=1)
    for some, end, ways in ((turns, path.end, (first, last)), (swings, path.start, (before, first))):
        for rows in np.array_split(np.flatnonzero(some), 1 + int(some.sum()) * PLACES // AT_ONCE):
            found[rows] = _meets(cutting, rows, end[rows], *(way[rows] for way in ways))
    rows = np.flatnonzero(turns)  # those that turn by more than the shorter way come anywhere
    _, short = screwed(first[rows], last[rows], path.start[rows], path.end[rows], SHARE)
    found[rows] |= np.linalg.norm(short - cutting.directions[rows, 1], axis=1) > SWING
    return found


def screwed(first: Array, last: Array, start: Array, end: Array, share: float) -> tuple[Array, Array]:
    """Tip and direction (k, 3) when a share of the shorter way between two places and directions is behind, turned evenly about
    an axis square to both directions."""
    axis, cosine = np.cross(first, last), np.einsum("ki,ki->k", first, last)
    sine = np.linalg.norm(axis, axis=1)
    angle, axis = np.arctan2(sine, cosine), axis / np.maximum(sine, STILL)[:, None]
    way = end - start
    rise = np.einsum("ki,ki->k", way, axis)[:, None] * axis
    half = np.where(sine > TURNED, np.tan(np.clip(angle, TURNED, np.pi - TURNED) / 2), np.inf)
    spoke = (rise - way) / 2 + np.cross(way, axis) / (2 * half)[:, None]
    c, s = np.cos(share * angle)[:, None], np.sin(share * angle)[:, None]
    tips = start - spoke + c * spoke + s * np.cross(axis, spoke) + share * rise
    tips = np.where((sine > TURNED)[:, None], tips, start + share * way)
    return tips, c * first + s * np.cross(axis, first)


def _meets(cutting: Cutting, rows: Index, end: Array, before: Array, after: Array) -> Mask:
    """Which of some rows (k,) are not sure to be clear on the way to `end` (k, 3), from one direction (k, 3) to the other."""
    found, start, stock = np.zeros(len(rows), dtype=bool), cutting.path.start[rows], cutting.stock
    if not len(rows):
        return found
    low, high = stock.bounds
    box = [np.array(np.meshgrid(*zip(low, high))).reshape(3, -1).T]
    hull = np.concatenate(stock.edges() if isinstance(stock, Box | Revolved) else box)
    middle, far = (low + high) / 2, float(np.linalg.norm(high - low))
    widest = [max(tool.effective_radius, *(radius for radius, _ in tool.holder), 0.0) for tool in cutting.tools]
    wide = np.array(widest)[cutting.which[rows]]
    swing, way = np.linalg.norm(after - before, axis=1), np.linalg.norm(end - start, axis=1)
    count = int(np.clip(np.ceil(swing.max() / SWING), 1, PLACES))
    for share in (np.arange(count) + 0.5) / count:
        tips, up = screwed(before, after, start, end, share)
        reach = far + np.linalg.norm(tips - middle, axis=1)
        above = np.einsum("ki,ki->k", tips, up) - np.einsum("ci,ki->kc", hull, up).max(axis=1)
        places = tips[:, None] + (np.linspace(0.0, 1.0, PLACES) * reach[:, None])[..., None] * up[:, None]
        off = np.linalg.norm(np.maximum(np.maximum(low - places, places - high), 0.0), axis=2).min(axis=1)
        found |= np.maximum(above, off - wide - reach / PLACES) <= (way + swing * reach) / (2 * count)
    return found

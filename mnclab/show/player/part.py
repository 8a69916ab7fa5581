"""Values as the page has them, in few bytes.

Numbers are whole parts of a unit, columns are logs of their changes, objects are JSON. Columns are packed as differences,
zigzag, seven bits a byte, then deflate and base64: neighbours in a column differ little, so their differences are small, most
take one to three bytes. `data.js` undoes every step: a byte with its high bit set is followed by another one, an odd number z
stands for -(z + 1) / 2.
"""

from __future__ import annotations

import base64
import json
import zlib
from bisect import bisect
from collections.abc import Mapping, Sequence
from dataclasses import asdict, is_dataclass
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour, steps_within
from mnclab.path.inserts import as_drawn, cutting_part, holder, insert, lead_of
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Mask, Toolpath
from mnclab.show.probed import Felt
from mnclab.text.alarm import several
from mnclab.text.file import printable
from mnclab.workpiece.blank import Revolved
from mnclab.workpiece.cutting import Cutting, tool_exists
from mnclab.workpiece.milling.moves import cutter_of
from mnclab.workpiece.milling.raster import Raster
from mnclab.workpiece.milling.tilted import meeting, too_many
from mnclab.workpiece.turning.section import SectionDrawing, cuts, held, left_of
from mnclab.workpiece.turning.strokes import Strokes, strokes_of
from mnclab.workpiece.turning.turned import half_section, room_of

LARGEST = 2**53 // 4  # what a number of a browser holds without loss, as a zigzag difference
ROOM = LARGEST // 4  # of what the page holds: places are sent as differences
HUGE = 1 << 23  # bytes, from which on a page is pressed in an eighth of the time: it is a fourteenth larger

Array = NDArray[np.float64]


def plain(value: Any) -> Any:
    """A value of the history as JSON has it: a tool as its fields, points and frames as lists, a datum in words."""
    if isinstance(value, tuple) and "__str__" in type(value).__dict__ and all(isinstance(each, int | float) for each in value):
        return str(value)
    if is_dataclass(value) and not isinstance(value, type):
        return {name: plain(each) for name, each in asdict(value).items()}
    if isinstance(value, Mapping):
        return {str(name): plain(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not np.isfinite(value):
        return None if np.isnan(value) else "inf" if value > 0 else "-inf"
    return value if value is None or isinstance(value, str | int | float | bool) else str(value)


def parted(values: ArrayLike, scale: float) -> NDArray[np.int64]:
    """Whole numbers of the parts of a unit; what has no end is as large as can be."""
    found = np.asarray(values, dtype=np.float64) * scale
    np.nan_to_num(np.round(found, out=found), copy=False, posinf=ROOM, neginf=-ROOM)
    return found.clip(-ROOM, ROOM, out=found).astype(np.int64)


def columns(pack: Packer, values: NDArray[np.int64]) -> list[int]:
    """The columns of whole numbers (n, k), as their indices."""
    return [pack.add(values[:, k]) for k in range(values.shape[1])]


def log(pack: Packer, column: Any) -> dict[str, Any]:
    """A column (n,) or (n, 3) as its changes."""
    column = np.asarray(column)
    if not len(column):
        return {"at": pack.add([]), "of": pack.add([]), "values": []}
    if column.dtype.kind == "f":
        same = (column[1:] == column[:-1]) | (np.isnan(column[1:]) & np.isnan(column[:-1]))
    else:
        same = column[1:] == column[:-1]
    at = np.flatnonzero(np.append(True, ~(same.all(axis=1) if column.ndim == 2 else same)))
    return changes(pack, at, column[at].tolist())


def changes(pack: Packer, at: ArrayLike, values: list[Any]) -> dict[str, Any]:
    """Changes at some places; equal values are sent once."""
    index: dict[str, int] = {}
    kept: list[Any] = []
    of = []
    for value in map(plain, values):
        of.append(index.setdefault(repr(value), len(kept)))
        if of[-1] == len(kept):
            kept.append(value)
    return {"at": pack.add(at), "of": pack.add(of), "values": kept}


def parts_of(finest: float, *columns: Array) -> float:
    """How many parts a unit is counted in: `finest`, or the power of ten at which no value is too large for the page."""
    most = 0.0
    for column in columns:
        known = column if np.isfinite(column.min(initial=0.0) - column.max(initial=0.0)) else column[np.isfinite(column)]
        most = max(most, float(known.max(initial=0.0)), -float(known.min(initial=0.0)))
    return finest if most * finest <= ROOM else 10.0 ** np.floor(np.log10(ROOM / most))


def varints(values: NDArray[np.int64]) -> bytes:
    """Whole numbers (n,) of either sign as bytes."""
    rest = ((values << 1) ^ (values >> 63)).astype(np.uint64)
    size = np.ones(len(rest), dtype=np.int64)
    for k in range(1, -(-int(rest.max(initial=0)).bit_length() // 7)):
        size += rest >= np.uint64(1 << 7 * k)
    at = np.cumsum(size) - size
    found = np.zeros(int(size.sum()), dtype=np.uint8)
    for k in range(int(size.max(initial=0))):
        some = np.flatnonzero(size > k)
        more = (size[some] > k + 1).astype(np.uint8) << 7
        found[at[some] + k] = (rest[some] >> np.uint64(7 * k)).astype(np.uint8) & 127 | more
    return found.tobytes()


def size(values: NDArray[np.int64]) -> int:
    """Bytes of a column (n,) once it is packed."""
    data = varints(np.diff(values, prepend=0))
    return len(zlib.compress(data, 6 if len(data) < HUGE // 8 else 1))


class Packer:
    """Columns that are added one by one, and then a text of them and of a header."""

    def __init__(self) -> None:
        self.sizes: list[int] = []
        self._parts: list[bytes] = []

    def add(self, values: ArrayLike) -> int:
        """A column of whole numbers (n,); returns its index."""
        column = np.asarray(values, dtype=np.int64)
        if len(column) and not -LARGEST <= int(column.min()) <= int(column.max()) <= LARGEST:
            raise ValueError("a number is too large for the page")
        self._parts.append(varints(np.diff(column, prepend=0)))
        self.sizes.append(len(column))
        return len(self.sizes) - 1

    def text(self, header: dict[str, Any]) -> str:
        """Header and columns as base64: length of the header (4 bytes, low first), header as JSON, columns."""
        start = printable(json.dumps({**header, "columns": self.sizes}, ensure_ascii=False, allow_nan=False)).encode()
        pressed = zlib.compressobj(9 if len(start) + sum(map(len, self._parts)) < HUGE else 4)
        content = [*map(pressed.compress, (len(start).to_bytes(4, "little"), start, *self._parts)), pressed.flush()]
        return base64.b64encode(b"".join(content)).decode("ascii")


# What the page needs of the part: to cut it while it plays, to turn it, and to show what a probe meets.

# To cut it: the blank as two maps, and of each row its cutter and whether it cuts. The page sweeps the cutters itself
# (`swept.js`), by the formulas of `workpiece/milling`; nothing is computed beforehand.

CELLS = 300  # along the longer side of the blank
PARTS = 1e4  # of a millimetre, of the blank's heights
#: What a row does to the part: nothing, cuts all along its way, or only where it arrives.
NOTHING, CUTS, ARRIVES = range(3)


def part(pack: Packer, cutting: Cutting, path: Toolpath) -> dict[str, Any]:
    """The part of a mill; `path` is the one that the page plays, which may stand lower than what is cut."""
    stock, bounds = cutting.stock, cutting.stock.bounds
    raster = Raster.over(bounds, float((bounds[1] - bounds[0])[:2].max()) / CELLS)
    y, x = (each.ravel() for each in np.meshgrid(raster.y, raster.x, indexing="ij"))
    floor, top = (np.nan_to_num(side, nan=float(bounds[0, 2])) for side in stock.faces(x, y))  # beside the blank nothing is left
    tilted = np.zeros(len(path), dtype=bool) if cutting.tilted is None else cutting.tilted
    turns = cutting.turning & meeting(cutting)
    wound = 0 if too_many(cutting) else int((turns & cutting.round_).sum())
    also = f"; run.workpiece() cuts {wound} of them" if wound else ""
    does = np.where(cutting.cuts & ~cutting.turning, np.where(cutting.from_home, ARRIVES, CUTS), NOTHING)
    return {
        "low": list(raster.low),
        "high": bounds[1, :2].tolist(),
        "step": raster.step,
        "shape": list(raster.shape),
        "round": [*stock.at[:2], stock.bounds[1, 0] - stock.at[0], stock.bore] if _turns(stock) else None,
        "parts": PARTS,
        "top": pack.add(parted(top, PARTS)),
        "floor": pack.add(parted(floor, PARTS)),
        "cutters": [list(cutter_of(tool)) for tool in cutting.tools],
        "which": log(pack, cutting.which),
        "does": log(pack, does),
        "lift": log(pack, cutting.path.start[:, 2] - path.start[:, 2]),
        "along": _leaning(pack, cutting, tilted & ~cutting.turning),
        "note": f"{several(int(turns.sum()), 'move')} on which the tool turns: not cut here{also}" if turns.any() else "",
    }


def _leaning(pack: Packer, cutting: Cutting, rows: Mask) -> dict[str, Any] | None:
    """The direction of the tool on the rows (n,) on which it stands tilted, None on others; None where it never does."""
    if cutting.directions is None or not rows.any():
        return None
    at = np.flatnonzero(np.append(True, (np.diff(cutting.directions[:, -1], axis=0) != 0).any(axis=1) | (np.diff(rows) != 0)))
    return changes(pack, at, [cutting.directions[row, -1].tolist() if rows[row] else None for row in at.tolist()])


# To turn it: the bar, what each row takes away in the plane of z and r, the inserts. The areas are those of the kernel, as
# lines within `OFF` mm; the page only takes them away one after the other. Between two rows it moves the convex cutting part
# of the tool itself.

OFF = 0.01  # mm
BEHIND, JAWS = 0.3, 1.55  # of the radius of the bar: how long and how high a chuck is that nobody gave, behind the bar
LONG, FINE = 0.09, 0.01  # edges of an insert, of the greatest side of what is shown; chords of its nose, of its edges
MOST = 200_000  # corners of all areas; the page of more would be too large



def section(pack: Packer, cutting: Cutting) -> dict[str, Any]:
    """The section of a lathe's part; corners are (z, r), mm."""
    bar, axis, notes = half_section(cutting.stock)
    low, high, radius = room_of(bar)
    strokes = strokes_of(cutting, low, high, radius, axis)
    rows, areas, fallen = _areas(strokes, bar, low)
    told = [*notes, *strokes.notes]
    count = np.array([len(area) for area in areas], dtype=np.int64)
    kept = int(np.searchsorted(np.cumsum(count), MOST, "right"))
    if kept < len(areas):
        told.append(f"the section is shown up to row {rows[kept]} only")
    corners = np.concatenate(areas[:kept]) if kept else np.empty((0, 2))
    leads = [lead_of(cutting.path, cutting.which == k) for k in range(len(cutting.tools))]
    shaped = [as_drawn(tool, lead) for tool, lead in zip(cutting.tools, leads, strict=True)]
    return {
        "bar": [_corners(loop.points_within(OFF)) for loop in bar],
        "axis": axis,
        "parts": PARTS,
        "rows": pack.add(rows[:kept]),
        "count": pack.add(count[:kept]),
        "fallen": fallen,
        "corners": columns(pack, parted(corners, PARTS)),
        "which": log(pack, cutting.which),
        "cuts": log(pack, cutting.cuts & ~cutting.from_home),
        "blades": [_corners(cutting_part(tool, high - low + radius).points_within(OFF)) for tool in shaped],
        "chuck": [_corners(loop.points) for each in cutting.fixtures if _turns(each) for loop in half_section(each)[0]]
        or [[[low - BEHIND * radius, 0.0], [low, 0.0], [low, JAWS * radius], [low - BEHIND * radius, JAWS * radius]]],
        "note": "; ".join(told),
    }


def _areas(strokes: Strokes, bar: Sequence[Contour], low: float) -> tuple[list[int], list[Array], list[int]]:
    """Rows and outlines of what goes, in order: of all strokes of a row, then of the pieces that fall; and which these are."""
    rows, areas = list(strokes.rows), _outlines(strokes.contours)
    drawing = SectionDrawing.of(bar, strokes.contours, rows)
    fallen: list[int] = []
    if not areas or not held(left_of(drawing), low)[1]:
        return rows, areas, fallen
    for row, _, off in cuts(drawing, low):
        for piece in off:
            fallen.append(bisect(rows, row))
            areas.insert(fallen[-1], shapely.get_coordinates(shapely.simplify(piece.exterior, OFF / 2))[:-1])
            rows.insert(fallen[-1], row)
    return rows, areas, fallen


def _outlines(contours: Sequence[Contour]) -> list[Array]:
    """The corners of closed contours (m, 2): all at once, as one line."""
    if not contours:
        return []
    points = np.concatenate([part for each in contours for part in (each.points, each.points[:1])])
    bulge = np.concatenate([part for each in contours for part in (each.bulge, [0.0])])
    line = Contour(points, bulge, closed=False)
    steps = np.append(steps_within(line.radii, line.sweeps, OFF), 1)
    size = np.array([len(each.points) + 1 for each in contours])
    return np.split(line.points_within(OFF), np.add.reduceat(steps, np.cumsum(size) - size).cumsum()[:-1])


def _turns(body: Any) -> TypeGuard[Revolved]:
    return isinstance(body, Revolved) and body.axis == "Z"


def inserts(pack: Packer, run: Any) -> dict[str, Any]:
    """The insert and the holder of each row about its tip, as long as those of the figures of the run."""
    path, (table, numbers) = run.toolpath, run.tools_that_cut
    ends = [path.bounds] if len(path.motion) else []
    ends += [run.stock.bounds] if run.stock else []
    size = (LONG * float(np.ptp(np.concatenate(ends), axis=0).max()) if ends else 0.0) or 1.0
    known, tools = np.unique(numbers).tolist(), []
    for number in known:
        tool = table.get(number, Tool())
        name = tool.name or tool.kind or "insert of the setup" if tool_exists(tool) else "default insert"
        shape = as_drawn(tool, lead_of(path, numbers == number))
        edges = insert(shape, size).points_within(FINE * size)
        tools.append({"name": name, "insert": _corners(edges), "holder": _corners(holder(shape, size))})
    return {"which": log(pack, np.searchsorted(known, numbers)), "tools": tools}


def _corners(points: Array | Sequence[Any]) -> list[list[float]]:
    return [[float(z), float(r)] for z, r in np.round(np.asarray(points, dtype=np.float64), 4)]


# To show what a probe meets: the map of its heights, and the touches with their numbers.

PROBED_CELLS = 200  # along the longer side of the part
BEFORE = 1.0  # mm
WALL = 1.0  # of a cell that two neighbours differ in height where there is a wall
SHARES = 2**9  # parts of the way from one to the other
DIGITS = 4


def felt_part(pack: Packer, found: Felt, path: Toolpath) -> dict[str, Any]:
    """The part as `player.part` has a blank, which no row cuts."""
    ends = _ends(found, path)
    step = float((ends[1] - ends[0])[:2].max()) / PROBED_CELLS
    ends[0, :2], ends[1, :2] = ends[0, :2] - step, ends[1, :2] + step  # all its sides are walls of the map
    raster = Raster.over(ends, step)
    y, x = (each.ravel() for each in np.meshgrid(raster.y, raster.x, indexing="ij"))
    low, high = ends[:, 2].tolist()
    top = np.nan_to_num(found.heights(x, y, low, high, raster.step), nan=low)
    walls, shares = _walls(found, raster, np.column_stack([x, y, top]))
    nothing = np.zeros(len(path))
    return {
        "low": list(raster.low),
        "high": ends[1, :2].tolist(),
        "step": raster.step,
        "shape": list(raster.shape),
        "parts": PARTS,
        "top": pack.add(parted(top, PARTS)),
        "floor": pack.add(parted(np.full(len(top), low), PARTS)),
        "walls": pack.add(walls),
        "shares": pack.add(shares),
        "cutters": [],
        "which": log(pack, nothing),
        "does": log(pack, np.full(len(path), NOTHING)),
        "lift": log(pack, nothing),
        "note": "",
    }


def _walls(found: Felt, raster: Raster, tops: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Where walls stand between the cells of a map `tops` (n, 3): twice the number of a cell, and one more along Y, and the parts
    of the way to its neighbour."""
    assert found.part is not None
    heights, n = tops[:, 2].reshape(raster.shape), np.arange(len(tops)).reshape(raster.shape)
    along = np.concatenate([2 * n[:, :-1].ravel(), 2 * n[:-1].ravel() + 1])
    rise = np.concatenate([np.diff(heights, axis=0 if up else 1).ravel() for up in (False, True)])
    walls, rise = (each[np.abs(rise) > WALL * raster.step] for each in (along, rise))
    places = tops[walls // 2] + found.origin + rise[:, None] * [0.0, 0.0, 0.5]
    low, high = np.zeros(len(walls)), np.ones(len(walls))
    for _ in range(SHARES.bit_length() - 1):
        middle = (low + high) / 2
        before = (found.part(places + (raster.step * middle)[:, None] * np.eye(3)[walls % 2]) <= 0) == (rise < 0)
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return walls, np.round((low + high) / 2 * SHARES).astype(np.int64)


def felt_touches(found: Felt | None, path: Toolpath) -> dict[str, Any]:
    """The corners of what is to be seen, the ends of a beam, and of each touch its row, its place and what is written there."""
    if found is None:
        return {"corners": [], "touches": [], "beam": []}
    before = found.places - BEFORE * found.ways  # where the ball came from: what hides it hides the touch
    touches = zip(found.rows, found.places.round(DIGITS).tolist(), before.round(DIGITS).tolist(), found.texts)
    corners = _ends(found, path).round(DIGITS).tolist() if found.part is not None or found.beam is not None else []
    beam = [] if found.beam is None else found.beam.round(DIGITS).tolist()
    told = [{"row": row, "at": at, "from": off, "text": text} for row, at, off, (text, _) in touches]
    return {"corners": corners, "touches": told, "beam": beam}


def _ends(found: Felt, path: Toolpath) -> Any:
    return found.ends(path.bounds if len(path) else np.zeros((2, 3)))

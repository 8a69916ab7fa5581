"""Whether two programs leave the same part of one blank: by heights beside all walls and all over it, or by the section."""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.comparison.diff import strokes_of
from mnclab.comparison.found import Found
from mnclab.comparison.motion import Motion
from mnclab.comparison.ways import Around
from mnclab.geometry.curves import at_angle, counted
from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array, Kind, Mask
from mnclab.workpiece.blank import Box, blank
from mnclab.workpiece.milling.milled import THREADS
from mnclab.workpiece.milling.tilted import left_out
from mnclab.workpiece.part.part import Part

GEOMETRIC = ("geometry", "depth", "order", "chords", "lifts", "aside", "nearer", "rapid")
PLACES = 20_000  # of each path: beside so many the walls are looked at; of more nothing is proven
CLOSE, ABOUT = 4, 64  # places a tool radius along a cut, and about each of its ends
BESIDE = 1.3  # of the tolerance
GAP = 0.1  # mm, between places along a cut, no less
FEW = 2000  # places at which parts are compared first
GRID = 50  # places of the longer side
NOTHING = 1e6  # mm: the height of no material
MOST = 20_000  # cuts: a part of more takes too long
ROUND = np.array([(0, 0), (1, 0), (0, 1), (-1, 0), (0, -1), (0.7, 0.7), (-0.7, 0.7), (0.7, -0.7), (-0.7, -0.7)])


def not_comparable(runs: tuple[Any, Any], motions: tuple[Motion, Motion]) -> str:
    """Why the parts of two runs are not compared, in words; empty if they can be."""
    stocks = [run.stock for run in runs]
    if stocks == [None, None]:
        return "there is no blank in either"
    if max(len(motion.cuts) for motion in motions) > MOST:
        return f"there are more than {MOST:,} cuts"
    if None in stocks:
        return ""
    if any(isinstance(stock, Box) for stock in stocks) and np.abs(stocks[0].bounds - stocks[1].bounds).max() > 1e-6:
        return "they have two blanks"
    return ""


def one_blank(runs: tuple[Any, Any]) -> Any:
    """The blank of the only one of two runs that has one, in the frame of the path; None if both have."""
    one, other = (run.stock for run in runs)
    return None if (one is None) == (other is None) else other if one is None else one


def _placed(run: Any, stock: Any) -> Any:
    """The blank in machine coordinates where a run has none of its own."""
    return stock.moved(run.toolpath.origin) if run.stock is None and stock is not None else None


def around(runs: tuple[Any, Any], stock: Any) -> Around:
    """What stands on the machine about the tool: the blank, which may be that of one for both, and fixtures."""
    run = runs[not runs[0].setup.fixtures and bool(runs[1].setup.fixtures)]
    origin, lathe = run.toolpath.origin, run.toolpath.lathe
    held = [each if isinstance(each, Part) else blank(each) for each in run.setup.fixtures]
    bodies = {"the blank": stock if run.stock is None else run.stock}
    bodies |= {f"fixture {k}" if len(held) > 1 else "the fixture": each for k, each in enumerate(held, 1)}
    bounds = {name: body.bounds - (0.0 if name == "the blank" else origin) for name, body in bodies.items() if body is not None}
    return Around(tuple(bounds), np.array([*bounds.values()]).reshape(-1, 2, 3), bool(held), lathe)


def part_apart(runs: tuple[Any, Any], motions: tuple[Motion, Motion], tolerance: float, found: list[Found], stock: Any) -> str:
    """Where the parts of two runs differ by more than the tolerance, in words; empty if they do not.

    Cuts that are the same take the same away, so what is looked at is beside those that are not, and in a grid all over. A place
    of the one part has the height of the other, or what lies within the tolerance about it has.
    """
    if not any(each.kind in (*GEOMETRIC, "tool") for each in found):
        return ""
    parts = [run.workpiece(stock=_placed(run, stock)) for run in runs]
    if (error := max(part.error for part in parts)) > tolerance:
        return f"the parts are known to {error:g} mm alone"
    sections = [part.half_section() for part in parts]
    if sections[0] is not None and sections[1] is not None:
        one, other = (Region.of(*section[0]) for section in sections)
        for over, under in ((one, other), (other, one)):
            more = over.difference(under).inset(tolerance / 2)
            if more.loops:
                z, r = more.bounds.mean(axis=0)
                return f"the turned parts differ at Z{z:.3f}, diameter {2 * r:.3f}"
        return ""
    rows = [_rows_that_differ(motion, found, k) for k, motion in enumerate(motions)]
    beside = [_beside(motion, each, float(parts[0].bounds[1, 2]), tolerance) for motion, each in zip(motions, rows)]
    if any(each is None for each in beside):
        return f"the parts are not proven to agree: the cuts that differ have more than {PLACES:,} places"
    points = np.concatenate([*beside, _all_over(parts[0].bounds)])
    for thin in dict.fromkeys((len(points) // FEW + 1, 1)):  # a few of them are often enough
        some, worst = points[::thin], (0.0, 0)
        heights = [_heights(part, some) for part in parts]
        at = np.flatnonzero((np.abs(heights[0] - heights[1]) > tolerance).any(axis=0))
        for part, here in zip(parts[::-1], heights):  # beside a wall that is within the tolerance heights may be far apart
            about = _heights(part, (some[at, None] + tolerance * ROUND).reshape(-1, 2)).reshape(2, -1, len(ROUND))
            off = np.maximum(about.min(axis=2) - here[:, at], here[:, at] - about.max(axis=2)).max(axis=0, initial=0.0)
            worst = max(worst, (float(off.max()), int(at[off.argmax()]))) if len(at) else worst
        if worst[0] > tolerance:
            x, y = some[worst[1]].tolist()
            by = f"by {worst[0]:.3f} mm in height" if worst[0] < NOTHING / 2 else "in where there is material"
            return f"the parts differ {by} at X{x:.3f} Y{y:.3f}"
    for part, motion, k in zip(parts, motions, (0, 1)):
        if (out := _left_out(part.cutting) & _rows_that_differ(motion, found, k, 0)).any():
            return f"the parts are not proven to agree: what differs is left out of them ({part.cutting.lines(out)})"
    uncut = _heights(stock if runs[0].stock is None else runs[0].stock, points)
    if not any((each != uncut).any() for each in heights) and not any(part.removed > 0 for part in parts):
        return "neither of them cuts anything of its blank, so the parts prove nothing"
    return ""


def _left_out(cutting: Any) -> Mask:
    """Rows (n,) that are not in a milled part, or not as they cut: the tool turns, it has no body, it cuts a thread."""
    threads = np.array([tool.kind in THREADS for tool in cutting.tools] or [False])
    return np.any([cutting.bare, threads[cutting.which] & cutting.cuts, *(rows for rows, _ in left_out(cutting))], axis=0)


def _rows_that_differ(motion: Motion, found: list[Found], k: int, more: int = 1) -> Mask:
    """The rows (n,) of the one or the other path where cuts or ways between them are not the same, and so many `more` cuts."""
    mask = np.zeros(len(motion.path), dtype=bool)
    bounds = np.append(motion.row[motion.cuts], len(mask))
    for each in found:
        if each.kind == "tool":
            mask[:] = True
        elif each.kind in GEOMETRIC and (each.kind != "order" or not more) and each.rows[k] >= 0:
            rank = int(np.searchsorted(bounds, each.rows[k], "right"))
            begin = bounds[max(rank - 2, 0)] if more else each.rows[k]
            mask[begin : bounds[min(rank + each.moves - 1 + more, len(bounds) - 1)]] = True
    return mask


def _heights(part: Any, points: Array) -> Array:
    """The upper and the lower face (2, m); where there is no material, far below and far above."""
    low, high = part.faces(points[:, 0], points[:, 1])
    return np.stack([np.where(np.isnan(high), -NOTHING, high), np.where(np.isnan(low), NOTHING, low)])


def _beside(motion: Motion, rows: Mask, top: float, tolerance: float) -> Array | None:
    """Points (m, 2) at the middle of the tool and just within and without its walls, along some rows that go below the top of
    the blank, and all round their ends; None if they would be too many."""
    path = motion.path
    cuts = path[rows & path.is_motion & ((np.minimum(path.start, path.end)[:, 2] < top) | (path.kind == Kind.ARC))]
    start, end, row = strokes_of(cuts, max(tolerance, 1e-3))
    if not len(row):
        return np.empty((0, 2))
    way = (end - start)[:, :2]
    long, radius = np.linalg.norm(way, axis=1), np.abs(cuts.radius[row])[:, None]
    many = np.ceil(CLOSE * long / np.maximum(radius[:, 0], CLOSE * GAP)).clip(1).astype(np.int64)
    discs = np.column_stack([np.vstack([cuts.start, cuts.end])[:, :2], np.tile(np.abs(cuts.radius), 2)])
    ends = np.unique(np.round(discs, 6), axis=0)
    if many.sum() + len(ends) * ABOUT // 4 > PLACES:
        return None
    of, rank = counted(many)
    middle = start[of, :2] + ((rank + 0.5) / many[of])[:, None] * way[of]
    normal = np.where(long[:, None] > 0, way[:, ::-1] * [-1, 1] / np.maximum(long, 1e-12)[:, None], [1.0, 0.0])[of]
    round_ = at_angle(np.arange(ABOUT) * 2 * np.pi / ABOUT)
    found = [middle, ends[:, :2]]
    for off in (-BESIDE * tolerance, BESIDE * tolerance):
        found += [middle + sign * (radius[of] + off) * normal for sign in (1, -1)]
        found.append((ends[:, None, :2] + (ends[:, 2] + off)[:, None, None] * round_).reshape(-1, 2))
    return np.concatenate(found)


def _all_over(bounds: Array) -> Array:
    low, high = bounds[:, :2]
    step = (high - low).max() / GRID
    grid = np.meshgrid(*(np.arange(a + step / 3, b, step) for a, b in zip(low, high)))
    return np.stack([each.ravel() for each in grid], axis=1)


def collided(runs: tuple[Any, Any], stock: Any) -> list[Found]:
    """Collisions of a kind that only one of two runs has."""
    both = [run.collisions(_placed(run, stock)) for run in runs]
    found = []
    for kind in dict.fromkeys(each.kind for each in (*both[0], *both[1])):
        first = [next((each for each in one if each.kind == kind), None) for one in both]
        if None in first:
            rows = tuple(-1 if each is None else each.row for each in first)
            said = tuple("none" if each is None else each.message for each in first)
            depth = max(each.depth for each in first if each is not None)
            found.append(Found("collision", rows, depth, "mm", said))  # type: ignore[arg-type]
    return found

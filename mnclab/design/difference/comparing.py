"""A milled part against a design: everything is looked at, the worst places are followed, their rows are named.

Turned parts go from here to `turned_comparing`.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from mnclab.design.difference.columns import columns, off
from mnclab.design.difference.deviations import Seen, seen, volumes
from mnclab.design.difference.difference import Difference, Features, Row, Worst, judged, made_by
from mnclab.design.difference.drawn_target import DrawnTarget
from mnclab.design.difference.half_target import HalfTarget
from mnclab.design.difference.rays import PAIRS, about, sides, ways
from mnclab.design.difference.target import NONE, MeshTarget, PartTarget, Reading, Target
from mnclab.design.difference.threads import before_threads
from mnclab.design.difference.turned_comparing import compare_turned
from mnclab.design.model.design import Design, Drawn
from mnclab.design.model.turned_design import DrawnTurned, TurnedDesign
from mnclab.geometry.contours import Contour
from mnclab.path.toolpath import Array, Index
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.milling.raster import NOISE, near
from mnclab.workpiece.milling.sweep import grouped
from mnclab.workpiece.milling.swept import left_by
from mnclab.workpiece.part.mesh import Mesh, is_mesh, mesh_of, read_mesh
from mnclab.workpiece.turning.turned import Turned
from mnclab.workpiece.workpiece import Workpiece

CANDIDATES = 4  # places from which the worst is followed
MOST = 24  # places that are as bad, whose rows are looked for
ALIKE = 1e-7  # mm, by which they may differ


def compare(workpiece: Workpiece, target: Any, tolerance: float = 0.05) -> Difference:
    """A workpiece against whatever `targets` knows; `tolerance` mm.

    An Alarm for anything else, and for a tolerance that is not greater than 0.
    """
    check_number(tolerance, "the tolerance of a comparison (mm)", above=0)
    if isinstance(workpiece, Milled):
        wanted = target_of(target, workpiece, float(tolerance))
        if isinstance(wanted, DrawnTarget):
            workpiece = before_threads(workpiece, wanted.design.features)
        return difference_of(workpiece, wanted, float(tolerance))
    if isinstance(workpiece, Turned):
        return compare_turned(workpiece, half_target_of(target, workpiece), float(tolerance))
    raise Alarm(f"what is compared is a workpiece, got {shown(workpiece)}", hint="run.workpiece()")


def difference_of(workpiece: Milled, target: Target, tolerance: float) -> Difference:
    """A milled part against a target."""
    found = _followed(seen(workpiece, target))
    signed = np.where(np.isfinite(found.grid.top) | (workpiece.heights > workpiece.floor), 0.0, np.nan)
    cells = found.cells
    signed[cells.row, cells.column] = found.off[found.of_cells]
    readings = list(target.readings(found))
    worst = [_worst_of(found, reading.among) for reading in readings]
    *first, gouge, rest = _first(found, [*worst, _farthest(found, -1.0), _farthest(found, 1.0)])
    rows = Features([_row(found, reading, *each) for reading, each in zip(readings, first)])
    gone, left = volumes(found)
    return Difference(
        target.name, tolerance, found.error, _worst(found, -1.0, *gouge), _worst(found, 1.0, *rest), gone, left, workpiece.x,
        workpiece.y, signed, rows, tuple(_notes(workpiece, target, rows, tolerance)), workpiece, target, found,
    )  # fmt: skip


def _farthest(found: Seen, sign: float) -> Index:
    """The places that are farthest off with one sign, none where nothing is."""
    off = sign * found.off
    return np.flatnonzero(off >= off.max() - ALIKE) if len(off) and off.max() > 0 else NONE


def _worst(found: Seen, sign: float, k: int, row: int) -> Worst:
    """The worst place of one sign, `k` of those that were looked at, -1 for none."""
    if k < 0:
        return Worst()
    name = found.target.owner(int(found.owner[k])).name
    return Worst(float((sign * found.off).max()), feature=name, **_made(found, k, row))


def _made(found: Seen, k: int, row: int) -> dict[str, Any]:
    """What is said of the place `k` of those that were looked at, -1 for none, and of the row that made it."""
    if k < 0:
        return {}
    x, y, z = found.place[k].tolist()
    return made_by(found.workpiece.cutting, (x, y, z), row, float(found.off[k]))


def _followed(found: Seen) -> Seen:
    """With the places at which it is worst, if they lie between those that were looked at."""
    places, values = [], []
    for sign in (-1.0, 1.0):
        order = np.argsort(-sign * found.off, kind="stable")[: CANDIDATES**2 : CANDIDATES]
        order = order[sign * found.off[order] > 0]
        if len(order):
            place, value = followed(found.workpiece, found.target, found.place[order], found.off[order])
            if abs(value) - abs(found.off[order[0]]) > max(found.least, ALIKE):
                places.append(place)
                values.append(value)
    if not places:
        return found
    at, off = np.array(places), np.array(values)
    return found.with_places(at, off, found.target.owners(at, np.abs(off)))


def _first(found: Seen, groups: list[Index]) -> list[tuple[int, int]]:
    """Of the places of each group, all as bad, the one that was made first, as far as they are looked at, and the row that
    made it; -1 and -1 for an empty group."""
    groups = [among[:: len(among) // MOST + 1] for among in groups]
    some, where = np.unique(np.concatenate(groups), return_inverse=True)
    rows = rows_that_made(found.workpiece, found.target, found.place[some], found.void[some], found.off[some])[where.reshape(-1)]
    first, begin = [], 0
    for among in groups:
        mine = rows[begin : begin + len(among)]
        made = [(int(row), int(k)) for row, k in zip(mine, among) if row >= 0]
        row, k = min(made, default=(-1, int(among[0]) if len(among) else -1))
        first.append((k, row))
        begin += len(among)
    return first


def _row(found: Seen, each: Reading, k: int, row: int) -> Row:
    """A reading as a row of the table; `k` is the worst of its places, -1 for none, which a row made."""
    said = each.side, each.feature, each.measure, each.actual, each.allowed
    return judged(*said, NOISE, found.least, each.said, _made(found, k, row))


def _worst_of(found: Seen, among: Index) -> Index:
    """The places that are worst off among some, none where nothing is off."""
    off = np.abs(found.off[among])
    return among[(off > 0) & (off >= off.max(initial=0.0) - ALIKE)]


def _box(bounds: Array) -> str:
    return " ".join(f"{axis}{low:g}..{high:g}" for axis, low, high in zip("XYZ", *bounds.tolist()))


def _notes(workpiece: Milled, target: Target, rows: Features, tolerance: float) -> Iterator[str]:
    """What was not judged."""
    yield from workpiece.notes
    box, drawn = (np.asarray(each, dtype=np.float64) for each in (workpiece.cutting.stock.bounds, target.bounds))
    if isinstance(target, DrawnTarget) and np.abs(box - drawn).max() > tolerance:
        yield f"the part was cut from a blank of {_box(box)}, the design has one of {_box(drawn)}"
    unread = (row.feature for row in rows if row.measure.startswith("thread") and np.isnan(row.actual))
    if threads := list(dict.fromkeys(unread)):
        yield f"threads were not measured ({', '.join(threads)})"
    if workpiece.hollow:
        yield "what overhangs is not compared: of it the highest and the lowest places alone"
    if workpiece.many:
        yield f"of so many moves the map stands within {workpiece.error:.3g} mm"


# What a part may be compared with: a design or its file, another workpiece, a run, a body from a file or a mesh.

HINT = "workpiece.compare(design), another workpiece or run, or the path of a .toml, .stl or .glb file"
NAMES = {True: "turned", False: "milled"}


def target_of(given: Any, workpiece: Milled, tolerance: float) -> Target:
    """What a milled part is compared with."""
    found = _found(given)
    if isinstance(found, Design):
        return DrawnTarget(found, tolerance, workpiece.cutting)
    if isinstance(found, Milled):
        return PartTarget(found, _shift(found, workpiece), workpiece.step, tolerance)
    if isinstance(found, Mesh):
        return MeshTarget(found, tolerance)
    raise _other(found, lathe=False)


def half_target_of(given: Any, workpiece: Turned) -> HalfTarget:
    """What a turned part is compared with."""
    found = _found(given)
    if isinstance(found, TurnedDesign):
        return HalfTarget(found.title or "design", found.section, design=found)
    if isinstance(found, Turned):
        dz = float(_shift(found, workpiece)[2])
        section = [Contour(loop.points + (dz, 0.0), loop.bulge) for loop in found.section]
        return HalfTarget("the other workpiece", section, found.error)
    if isinstance(found, Mesh):
        return HalfTarget(found.name, found.half_section(workpiece.axis), found.error)
    raise _other(found, lathe=True)


def _found(given: Any) -> Any:
    """A design, a workpiece or a mesh, of whatever was given."""
    if isinstance(given, str | Path):
        if Path(given).suffix.lower() == ".toml":
            return Design.load(given)
        return read_mesh(Path(given))
    if isinstance(given, Drawn | DrawnTurned):
        return given.design
    if isinstance(given, Design | TurnedDesign | Workpiece):
        return given
    if is_mesh(given):
        return mesh_of(given)
    if hasattr(given, "toolpath") and hasattr(given, "workpiece"):  # a run, of whom this room knows nothing else
        return given.workpiece()
    raise Alarm(f"a part is compared with a design, another workpiece, a run or a mesh, got {shown(given)}", hint=HINT)


def _shift(other: Workpiece, workpiece: Workpiece) -> Array:
    """By how much (3,) another workpiece is moved into the coordinates of this one: both stand on one machine.

    What nothing cut, and stands at the zero of the machine, is taken to be in the coordinates of this one.
    """
    if not len(other.cutting) and not np.any(other.cutting.origin):
        return np.zeros(3)
    return np.asarray(np.subtract(other.cutting.origin, workpiece.cutting.origin), dtype=np.float64)


def _other(found: Any, lathe: bool) -> Alarm:
    return Alarm(f"a {NAMES[lathe]} part is compared with one that is {NAMES[lathe]}, got {shown(found)}", hint=HINT)


# Which row of a path made a place of a surface: the first one that cut the void just before it.

BEFORE = 1e-6  # mm, before the surface
SLANT = 1e-4  # mm, over which a direction is felt
GROUP = 2.0  # mm, the side of a square whose places are looked at together
BESIDE = 2.0  # times as far as a place is off, and a mm: where a row that stopped short is looked for


def first_cuts(workpiece: Milled, places: Array) -> Index:
    """The first rows that took the material at places (m, 3) away (m,), -1 for none."""
    moves, found = workpiece.moves, np.full(len(places), -1, dtype=np.int64)
    if not len(moves) or not len(places):
        return found
    x, y, z = places.T
    for some in grouped(x, y, GROUP):
        below = float(z[some].max()) + 2 * BEFORE
        which = about(moves, workpiece.sweep.boxes, x[some], y[some], below)
        if len(which) * len(some) > PAIRS:
            which = near(moves, workpiece.sweep.boxes, x[some], y[some], below)
        if not len(which):
            continue
        cut = left_by(moves[which], x[some], y[some]) <= z[some]
        hit = cut.any(axis=0)
        found[some[hit]] = moves.row[which[cut[:, hit].argmax(axis=0)]]
    return found


def rows_that_made(workpiece: Milled, target: Target, place: Array, void: Array, value: Array) -> Index:
    """The rows (m,) that made the surface at places (m, 3), off by `value` (m,), in whose void `void` (m, 3) lies; -1 where
    nothing was cut there.

    Material that stands where no row came is the fault of the one that cut beside it, if one did within its feature.
    """
    rows = first_cuts(workpiece, void)
    some = np.flatnonzero((rows < 0) & (value > 0))
    if not len(some) or not len(workpiece.moves):
        return rows
    around = SLANT * np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)])
    right, left, ahead, behind = target.distance((place[some] + around[:, None]).reshape(-1, 3)).reshape(4, -1)
    aside = np.stack([right - left, ahead - behind], axis=1)
    size = np.hypot(*aside.T)
    some, aside = some[size >= SLANT * 0.1], (aside / np.maximum(size, BEFORE * SLANT)[:, None])[size >= SLANT * 0.1]
    if not len(some):
        return rows
    start = place[some].copy()
    start[:, 2] -= np.minimum(value[some], 1.0) / 2
    reach = BESIDE * (value[some] + 1.0)
    way, _ = ways(workpiece, start[:, :2], aside, start[:, 2], np.ones(len(some), dtype=bool), float(reach.max()))
    met = way <= reach
    some = some[met]
    beside = start[met] + np.pad((way[met, None] + BEFORE) * aside[met], ((0, 0), (0, 1)))
    if len(some):
        its = target.distance(beside) > 0
        rows[some[its]] = first_cuts(workpiece, beside[its])
    return rows


# The worst places found, followed to where they are worst: steps about them that get smaller, over the exact heights.

FINEST = 1e-7  # mm, of a step
LEAST = 1e-10  # mm: less is no gain
STEPS = 100  # at most
RING = np.array([(np.cos(angle), np.sin(angle)) for angle in np.arange(12) * np.pi / 6])
ABOUT = np.concatenate([RING, 0.3 * RING])  # of a step


def followed(workpiece: Milled, target: Target, places: Array, values: Array) -> tuple[Array, float]:
    """From places (n, 3) that are off by `values` (n,) mm, all + or all -, to the worst one near one of them."""
    sign, best, at = float(np.sign(values[0])), np.abs(values), places.copy()
    step = np.full(len(at), workpiece.step)
    every = np.arange(len(at))
    for _ in range(STEPS):
        x, y = (at[:, None, :2] + step[:, None, None] * ABOUT).reshape(-1, 2).T
        found, heights = off(target, columns(sides(workpiece, x, y), target.faces(x, y), x, y))
        found, spots = sign * found.reshape(len(at), -1), np.stack([x, y, heights], axis=1).reshape(len(at), -1, 3)
        k = found.argmax(axis=1)
        better = found[every, k] > best + LEAST
        best[better], at[better] = found[every, k][better], spots[every, k][better]
        step[~better] /= 3
        if step.max() < FINEST:
            break
    worst = int(best.argmax())
    return at[worst], sign * float(best[worst])

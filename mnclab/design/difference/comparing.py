"""A milled part against a design: everything is looked at, the worst places are followed, their rows are named."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from mnclab.design.difference.deviations import Seen, seen
from mnclab.design.difference.difference import Difference, Worst, uncut
from mnclab.design.difference.drawn_target import DrawnTarget
from mnclab.design.difference.guilt import guilty
from mnclab.design.difference.reading import NONE, Reading
from mnclab.design.difference.refining import followed
from mnclab.design.difference.table import OK, OUT, Features, Row
from mnclab.design.difference.target import Target
from mnclab.design.difference.targets import half_target_of, target_of
from mnclab.design.difference.turned_comparing import compare_turned
from mnclab.design.difference.volumes import volumes
from mnclab.path.toolpath import Array, Index
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.milling.raster import NOISE
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
        return difference_of(workpiece, target_of(target, workpiece, float(tolerance)), float(tolerance))
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
    x, y, z = found.place[k].tolist()
    name = found.target.owner(int(found.owner[k])).name
    return Worst(float((sign * found.off).max()), (x, y, z), *_line(found, row), name, _where(found, row, k))


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
    rows = guilty(found.workpiece, found.target, found.place[some], found.void[some], found.off[some])[where.reshape(-1)]
    first, begin = [], 0
    for among in groups:
        mine = rows[begin : begin + len(among)]
        made = [(int(row), int(k)) for row, k in zip(mine, among) if row >= 0]
        row, k = min(made, default=(-1, int(among[0]) if len(among) else -1))
        first.append((k, row))
        begin += len(among)
    return first


def _line(found: Seen, row: int) -> tuple[int, int, int]:
    """Line, row and program of a row; line 0 of none."""
    path = found.workpiece.cutting.path
    return (int(path.line[row]), row, int(path.program[row])) if row >= 0 else (0, -1, 0)


def _where(found: Seen, row: int, k: int) -> str:
    """"FILE:LINE" of the row that made a place, or that none did; nothing of no place."""
    line, _, program = _line(found, row)
    if row >= 0:
        return str(found.workpiece.cutting.name(line, program))
    return uncut(float(found.off[k])) if k >= 0 else ""


def _row(found: Seen, reading: Reading, k: int, row: int) -> Row:
    """A reading as a row of the table; `k` is the worst of its places, -1 for none, which a row made."""
    measure, actual = reading.measure, reading.actual
    deviation = actual - measure.nominal
    deviation = 0.0 if abs(deviation) <= NOISE else deviation
    lower, upper = measure.limits or (-reading.allowed, reading.allowed)
    if reading.said:
        verdict = reading.said
    else:
        verdict = OK if lower - found.least <= deviation <= upper + found.least else OUT
    place = None
    if k >= 0:
        x, y, z = found.place[k].tolist()
        place = x, y, z
    line, row, program = _line(found, row)
    return Row(
        reading.side, reading.feature, measure.name, measure.nominal, measure.nominal + deviation, deviation, lower, upper,
        verdict, line, row, place, program, _where(found, row, k),
    )  # fmt: skip


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
    if threads := list(dict.fromkeys(row.feature for row in rows if row.measure.startswith("thread"))):
        yield f"threads were not measured ({', '.join(threads)})"
    if workpiece.many:
        yield f"of so many moves the map stands within {workpiece.error:.3g} mm"

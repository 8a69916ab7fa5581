"""Saving a measured point as preset or datum (TNC 620, 15.1): Q305 says which row, Q303 which table.

Q305 = 0 is row 0 of the preset table, a copy of the active row, which becomes active. Row n is written in the columns that
were measured; it counts at once if it is the active one. In the datum table (Q303 = 0) stands the shift from the preset.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, measured
from mnclab.controls.tnc_620.state import active_preset
from mnclab.machine.coordinates import FRAME
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.machining.probing.sequences import Approach, from_above
from mnclab.machining.steps import Step, Write

AXES = ("x", "y", "z")
SAME = 1e-12


def finish(c: ProbingCycle, m: Machine, a: Approach, found: dict[int, tuple[float, float]], turned: float = 0.0) -> Moves:
    """Touch from above too, if the cycle asks for it (Q381), in the system that it began with; then save the preset."""
    if c.probe_z:
        contact = yield from from_above(a, c.top_x, c.top_y, c.top_z, a.height, leave="higher")
        found[2] = contact.point[2] - a.ball, c.datum_z
        yield from measured([contact], Z=(found[2][0], c.top_z))
    yield from save(m, found, c.row, c.transfer, turned)


def save(
    m: Machine, found: Mapping[int, tuple[float, float]], row: float, transfer: float, turned: float = 0.0,
) -> Iterator[Step]:  # fmt: skip
    """Write what was measured: by axis (0, 1, 2 of the cycle) its measured coordinate and the one that it gets.

    `turned` (degrees) is added to the basic rotation of the row: the point keeps its new coordinates in the turned system.
    """
    number = int(row)
    measured, new = np.zeros(3), np.zeros(3)
    for k, (is_, gets) in found.items():
        measured[k], new[k] = is_, gets
    if transfer == 0 and number:
        shift, sets = _along(m.frames[FRAME][:3, :3], measured - new, found)
        before = m.tables.datums.get(number, Datum())
        yield Write("datums", before._replace(**{AXES[k]: float(shift[k]) for k in sets}), number)
        return
    linear = m.matrix[:3, :3]
    angle = np.radians(turned)
    turn = np.array([[np.cos(angle), -np.sin(angle), 0.0], [np.sin(angle), np.cos(angle), 0.0], [0.0, 0.0, 1.0]])
    shift, sets = _along(linear, measured - turn @ new, found)
    before = m.tables.presets.get(active_preset(m), Datum())
    columns = {AXES[k]: float(before[k] + shift[k]) for k in sets}
    if turned:
        columns["rotation"] = before.rotation + turned
    yield from store(m, number, **columns)


def store(m: Machine, row: float, **columns: float) -> Iterator[Step]:
    """Write columns of a preset row: row 0 is a copy of the active row that becomes active; the active row counts at once."""
    number, active = int(row), active_preset(m)
    copied = number in (0, active)
    preset = m.tables.presets.get(active if copied else number, Datum())._replace(**columns)
    yield Write("presets", preset, number)
    if copied:
        yield Write("memory", number, "preset")
        yield Write("datum", preset, "preset")


def _along(linear: np.ndarray, by: np.ndarray, found: Mapping[int, tuple[float, float]]) -> tuple[np.ndarray, list[int]]:
    """A shift of the axes of the cycle in those behind a frame, and which of these it can change."""
    mask = np.zeros(3)
    mask[list(found)] = 1.0
    changed = [k for k in range(3) if np.abs(linear[k] * mask).max() > SAME]
    return linear @ (by * mask), changed

"""The way from the programmed point through datum, transformations and compensation to the tool tip."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.machine.coordinates import LOG
from mnclab.path.listing import point
from mnclab.runs.values import Matrix, described, unit_of

if TYPE_CHECKING:
    from mnclab.runs.moment import Moment
    from mnclab.runs.run import Run


class Stage(NamedTuple):
    """A step on the way from the programmed point to the tool: its name and the point (3,) mm there."""

    name: str
    point: tuple[float, float, float]
    note: str = ""


def stages(run: Run, moment: Moment) -> list[Stage]:
    """The programmed point, after every frame from the innermost to the outermost, after compensation."""
    found, unit = [Stage("programmed point", moment.position)], unit_of(moment.state)
    chain = [(name, matrix) for name, matrix in _frames(run, moment) if not np.array_equal(matrix, frames.IDENTITY)]
    here = np.array(moment.position)
    for name, matrix in reversed(chain):
        here = frames.apply(matrix, here)
        found.append(Stage(f"after {name}", _tuple(here), described(matrix, unit)))
    path, last, tip, note = run.toolpath, moment.rows.stop - 1, np.array(moment.point), ""
    if not chain:
        found.append(Stage("machine coordinates", _tuple(here), "no frame is active"))
    if path.origin.any():
        found.append(
            Stage("from the first work offset", _tuple(here - path.origin), f"at machine {point(path.origin, unit)}")
        )
    away = float(np.linalg.norm(tip - (here - path.origin)))
    if last >= 0 and path.side[last] and away > 1e-9:
        side = "left" if path.side[last] > 0 else "right"
        note = f"tool radius {unit.figure(float(path.radius[last]))} to the {side}: {unit.figure(away)} {unit.short} away"
    elif away > 1e-6:
        note = f"{unit.figure(away)} {unit.short} away: a frame was changed since, or corners were rounded"
    found.append(Stage("tool tip", _tuple(tip), note))
    tool = run.tables.tools.get(int(path.tool[last])) if last >= 0 else None
    if tool is not None and not path.lathe:
        spindle = tip + path.origin
        spindle["XYZ".index(run.history.value(LOG, moment.step) or "Z")] += tool.effective_length
        note = f"tool length {unit.figure(tool.effective_length)}"
        found.append(Stage("spindle, machine coordinates", _tuple(spindle), note))
    return found


def _frames(run: Run, moment: Moment) -> list[tuple[str, Matrix]]:
    """The frames after the block, the outermost first."""
    names = list(dict.fromkeys([*run.control.frames, *(name for name, _ in run.frames)]))
    values = ((name, run.history.value(f"frame {name}", moment.step)) for name in names)
    return [(name, np.array(value)) for name, value in values if value is not None]


def _tuple(xyz: NDArray[np.float64]) -> tuple[float, float, float]:
    x, y, z = np.asarray(xyz, dtype=np.float64).tolist()
    return x, y, z

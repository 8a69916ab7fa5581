"""From a run to its part: which tool stood in the spindle at every row, where the blank and what holds it stand.

A row is cut by the tool as the table has it at that row, not as the program corrects it: DL and DR of a call lift the
path and widen the contour, the mill stays as it is.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from mnclab.path.columns import Array, Index, Mask
from mnclab.path.kinds import Kind
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Toolpath
from mnclab.runs.cycle_tools import cycle_tools
from mnclab.text.alarm import Alarm, Span
from mnclab.text.given import shown, whole
from mnclab.workpiece.blank import blank
from mnclab.workpiece.collision import Collision, Collisions
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.part import Part
from mnclab.workpiece.workpiece import Workpiece, no_blank

if TYPE_CHECKING:
    from mnclab.runs.run import Run

JUDGED = 3000  # rows up to which a player asks for collisions
TILT = "frame tilt"  # the frame of a tilted working plane: the tool stands along its Z


def cutting_of(run: Run, stock: Any = None) -> Cutting:
    """What a run cuts; `stock` in machine coordinates instead of its own blank. An Alarm without any."""
    path, origin = run.toolpath, run.toolpath.origin
    body = run.stock if stock is None else blank(stock)
    if body is None:
        raise no_blank() if stock is None else Alarm(f"stock must be two corners or a blank, got {shown(stock)}")
    body = body if stock is None else body.moved(-origin)
    tools, which, lift = tools_of_rows(run)
    tools, which = cycle_tools(run, tools, which)
    if lift.any():
        path = lifted(path, lift)
    return Cutting(
        path, tools, which, body, *start_known(run), tilted_rows(run), tuple(_placed(run, each) for each in run.setup.fixtures),
        name=run.place_of_line,
    )  # fmt: skip


def _placed(run: Run, fixture: Any) -> Any:
    """A fixture in the coordinates of the path."""
    if isinstance(fixture, Part):
        frame = np.eye(4)
        frame[:3, 3] = -run.toolpath.origin
        return fixture.placed(frame)
    body = blank(fixture)
    return body.moved(-run.toolpath.origin) if body else body


def tools_of_rows(run: Run) -> tuple[list[Tool], Index, Array]:
    """The tools, which of them each row has (n,), and how much higher than the path its tip really is (n,), mm."""
    path, changes = run.toolpath, run.history.changed("tool")
    tools, lifts = [Tool()], [0.0]
    at = []
    for step, held in changes:
        true = _as_tabled(run, held, step)
        at.append(step)
        tools.append(true)
        lifts.append(held.dl - true.dl if held.length == true.length else 0.0)
    which = np.searchsorted(np.array(at, dtype=np.int64), path.step, "right") if at else np.zeros(len(path), dtype=np.int64)
    return tools, which, np.array(lifts)[which]


def _as_tabled(run: Run, held: Tool, step: int) -> Tool:
    """The tool of a table's row as it stood at a step; the tool itself where no table has it."""
    written = run.history.value(f"tools {held.number}", step)
    found = written if isinstance(written, Tool) else (run.setup.tools or {}).get(held.number)
    if found is None:
        return held
    return found if found.number else replace(found, number=held.number)


def lifted(path: Toolpath, lift: Array) -> Toolpath:
    """A path whose rows stand higher."""
    up = np.zeros((len(path), 3))
    up[:, 2] = lift
    columns = {name: getattr(path, name) for name in path.all_but_ends()}
    return path.replace(**columns, start=path.start + up, end=path.end + up)


def tilted_rows(run: Run) -> Mask | None:
    """Rows that are made with a tilted tool (n,)."""
    changes = run.history.changed(TILT)
    if not any(frame is not None for _, frame in changes):
        return None
    at, on = zip(*((step, frame is not None) for step, frame in changes))
    index = np.searchsorted(np.array(at), run.toolpath.step, "right")
    return np.asarray(np.array([False, *on])[index])


def start_known(run: Run) -> tuple[int, int]:
    """From which row on the tool's height is known at the end of a row, and from which on every row's start is.

    A setup that says where the spindle starts says all of it. Else the tool comes from home: its height is known when Z (on
    a lathe X and Z) has moved, the whole place when every axis has, or when something was moved at feed.
    """
    path = run.toolpath
    if any(run.setup.start):
        return 0, 0
    rows = np.flatnonzero(path.is_motion)
    axes = [0, 2] if path.lathe else [0, 1, 2]
    moved = np.logical_or.accumulate(path.start[rows] != path.end[rows], axis=0)[:, axes]
    high = moved.all(axis=1) if path.lathe else moved[:, -1]
    known = moved.all(axis=1) | (path.kind[rows] != Kind.RAPID)
    n = len(path)
    return (int(rows[high.argmax()]) if high.any() else n), (int(rows[known.argmax()]) + 1 if known.any() else n)


def workpiece(
    run: Run, line: int | None = None, pass_: int = 1, row: int | None = None, step: float | None = None, stock: Any = None
) -> Workpiece:
    """What is left after a run, a pass of a line, or a row."""
    cutting = cutting_of(run, stock)
    if row is not None:
        row = whole(row, "the row")
        if not -len(cutting) <= row < len(cutting):
            raise Alarm(f"row must be 0 … {len(cutting) - 1}, got {row}")
        cutting = cutting.until(range(len(cutting))[row])
    elif line is not None:
        cutting = cutting.until(run.at(line, pass_).rows.stop - 1)
    if cutting.lathe:
        from mnclab.workpiece.turning.turned import Turned

        return Turned(cutting, step)
    from mnclab.workpiece.milling.milled import Milled

    return Milled(cutting, step)


def collisions(run: Run, stock: Any = None, step: float | None = None) -> Collisions:
    """What a run meets that it must not; the cut that would have left the travel of the machine among it."""
    cutting = cutting_of(run, stock)
    if cutting.lathe:
        from mnclab.workpiece.turning.collisions import collisions_of as of_lathe

        found = of_lathe(cutting, step)
    else:
        from mnclab.workpiece.milling.collisions import collisions_of as of_mill

        found = of_mill(cutting, step)
    if run.settings["stopped_spindle"] == "accept":
        found = Collisions(each for each in found if each.kind != "spindle" or run.toolpath.spindle[each.row])
    return Collisions([*found, *_beyond_travel(run)])


def _beyond_travel(run: Run) -> Iterator[Collision]:
    """The block at which the run was stopped; its `row` is the last one before it."""
    if run.stopped is None:
        return
    place, depth, alarm = run.stopped
    x, y, z = np.subtract(place, run.toolpath.origin).tolist()
    span = alarm.span or Span(0, 0)
    file = run.programs[span.program].name
    message = f"{alarm.message}, {depth:.3f} mm beyond"
    yield Collision("travel", message, span.line, span.program, len(run.toolpath) - 1, (x, y, z), depth, file)


def played(run: Run) -> tuple[Cutting | None, Collisions]:
    """What a player cuts and marks: nothing without a blank, no collisions where finding them takes long."""
    if run.stock is None:
        return None, Collisions()
    return cutting_of(run), Collisions()

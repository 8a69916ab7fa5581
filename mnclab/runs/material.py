"""From a run to its part: what its rows cut with, where the blank and what holds it stand."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from mnclab.machine.cutting_rows import TILT, lifted, start_known, tilted_rows, tools_of_rows
from mnclab.text.alarm import Alarm, several
from mnclab.text.given import shown, whole
from mnclab.workpiece.blank import blank
from mnclab.workpiece.collision import Collisions
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.outcome import Outcome
from mnclab.workpiece.part import Part
from mnclab.workpiece.workpiece import Workpiece, no_blank

if TYPE_CHECKING:
    from mnclab.runs.run import Run

CARD, REPORT = 1000, 20_000  # moves, beyond which a card and a report do not work out what became of the blank
CELLS = 80  # along the longer side of the blank, for a card
Made = TypeVar("Made")
KEPT = 6  # parts and lists of collisions that a run keeps
JUDGED = 3000  # rows up to which a player asks for collisions


def cutting_of(run: Run, stock: Any = None) -> Cutting:
    """What a run cuts; `stock` in machine coordinates instead of its own blank. An Alarm without any."""
    path, origin = run.toolpath, run.toolpath.origin
    body = run.stock if stock is None else blank(stock)
    if body is None:
        raise no_blank() if stock is None else Alarm(f"stock must be two corners or a blank, got {shown(stock)}")
    body = body if stock is None else body.moved(-origin)
    changed = run.history.changed
    tools, which, lift = tools_of_rows(path.step, changed("tool"), run.setup.tools, run.history.value)
    known, tilted = start_known(path, run.setup.start), tilted_rows(path.step, changed(TILT))
    fixtures = tuple(_placed(run, each) for each in run.setup.fixtures)
    travel = run.setup.limits.travel
    return Cutting(lifted(path, lift), tools, which, body, *known, tilted, fixtures, travel, name=run.place_of_line)


def _placed(run: Run, fixture: Any) -> Any:
    """A fixture in the coordinates of the path."""
    if isinstance(fixture, Part):
        frame = np.eye(4)
        frame[:3, 3] = -run.toolpath.origin
        return fixture.placed(frame)
    body = blank(fixture)
    return body.moved(-run.toolpath.origin) if body else body


def workpiece(
    run: Run, line: int | None = None, pass_: int = 1, row: int | None = None, step: float | None = None, stock: Any = None
) -> Workpiece:
    """What is left after a run, a pass of a line, or a row."""
    last = None
    if row is not None:
        last, n = whole(row, "the row"), len(run.toolpath)
        if not -n <= last < n:
            raise Alarm(f"row must be 0 … {n - 1}, got {row}")
        last %= n
    elif line is not None:
        last = run.at(line, pass_).rows.stop - 1
    return _kept(run, ("workpiece", last, step), stock, lambda: _workpiece(run, last, step, stock))


def _workpiece(run: Run, last: int | None, step: float | None, stock: Any) -> Workpiece:
    cutting = cutting_of(run, stock)
    if last is not None:
        cutting = cutting.until(last)
    if cutting.lathe:
        from mnclab.workpiece.turning.turned import Turned

        return Turned(cutting, step)
    from mnclab.workpiece.milling.milled import Milled

    return Milled(cutting, step)


def collisions(run: Run, stock: Any = None, step: float | None = None) -> Collisions:
    """What a run meets that it must not."""
    return _kept(run, ("collisions", step), stock, lambda: _collisions(run, stock, step))


def _collisions(run: Run, stock: Any, step: float | None) -> Collisions:
    cutting = cutting_of(run, stock)
    if cutting.lathe:
        from mnclab.workpiece.turning.collisions import collisions_of as of_lathe

        return of_lathe(cutting, step)
    from mnclab.workpiece.milling.collisions import collisions_of as of_mill

    return of_mill(cutting, step)


def _kept(run: Run, key: Hashable, stock: Any, make: Callable[[], Made]) -> Made:
    """What a run was asked for, made once as long as it is one of the last few; of another blank every time."""
    if stock is not None:
        return make()
    found: Made = run.made.pop(key) if key in run.made else make()
    run.made[key] = found
    if len(run.made) > KEPT:
        del run.made[next(iter(run.made))]
    return found


def outcome(run: Run, most: int, cells: int | None = None) -> Outcome | None:
    """What became of the blank of a run; None without one.

    Of a path of more than `most` moves only why it was not worked out. `cells` along the longer side of the blank.
    """
    if run.stock is None:
        return None
    moves = int(run.toolpath.is_motion.sum())
    if moves > most:
        return Outcome(None, None, f"not worked out for {several(moves, 'move')}: see run.workpiece(), run.collisions()")
    sides = run.stock.bounds[1] - run.stock.bounds[0]
    step = float(sides[:2].max()) / cells if cells and not run.toolpath.lathe else None
    try:
        return Outcome(run.removal(step=step), run.collisions())
    except Alarm as alarm:
        return Outcome(None, None, f"not worked out: {alarm.message}")


def card(run: Run) -> str:
    """The lines of the card of a run about its part; nothing without a blank."""
    found = outcome(run, CARD, CELLS)
    return found.html() if found else ""


def played(run: Run) -> tuple[Cutting | None, Collisions]:
    """What a player cuts and marks: nothing without a blank, no collisions where finding them takes long."""
    if run.stock is None:
        return None, Collisions()
    return cutting_of(run), Collisions()

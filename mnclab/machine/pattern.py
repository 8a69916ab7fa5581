"""Holes at many places, repeated as columns.

A program of a hundred thousand holes says the same hole a hundred thousand times: blocks of X and Y under a cycle that
runs at each position. The first hole of such a run is made one by one, by the cycle itself. If it leaves the machine as
it found it but for its place, every other hole is the same rows elsewhere, and only places are worked out here: rows,
steps and history of all holes are the first one's, moved. The last hole goes one by one again, so that what the machine
remembers of its last block is right without any bookkeeping here.

:func:`at_each` does the same for the points of a pattern in one block.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.path.kinds import Kind
from mnclab.path.recorder import ROW

if TYPE_CHECKING:
    from mnclab.machine.bulk import Bulk
    from mnclab.machine.machine import Machine

Array = NDArray[np.float64]
FEWEST = 8  # points worth repeating as columns


def repeat_hole(bulk: Bulk, first: int, end: int, least: int) -> int:
    """Obey the plain blocks [first, end) that say the same hole at other places; how many were, one
    fewer than belong to them, and 0 if fewer than ``least`` do.

    A block belongs to them if it moves in the plane and all its other words are those of the first block.
    """
    machine = bulk.machine
    places, alike = _places(bulk, first, end)
    good = len(alike) if alike.all() else int(np.argmin(alike))
    if good < least or machine.pole is not None:
        bulk.not_before = first + max(good, 1)
        return 0
    before, recorder, flow = _lasting(machine), machine.recorder, machine.flow
    recorder.room(0)  # the rows of the first hole will stand alone
    flow.current = first
    flow.obey(first)
    rows = np.array(recorder.rows).reshape(-1, len(ROW))
    hole = machine.to_machine((*machine.programmed[:2], before[0]))
    if _lasting(machine) != before or not _begins_at(rows, hole):
        bulk.not_before = first + least  # another hole each time: the other tier makes them
        return 1
    count = good - 2
    recorder.expect(len(rows) * (bulk.next_break - first) + bulk.next_break - first)
    changed = {
        name: log.values[-1]
        for name, log in machine.logs.by_name.items()
        if log.steps and log.steps[-1] == machine.step and name != "position"
    }
    step = flow.begin_many(first + 1, count)
    steps = np.arange(step, step + count, dtype=np.int32)
    points = np.column_stack([places[1:-1][:count], np.full(count, machine.programmed[2])])
    machine.logs.extend("position", steps, points)
    for name, value in changed.items():
        machine.logs.extend(name, steps, [value] * count)
    tips = bulk.to_machine(np.column_stack([points[:, :2], np.full(count, before[0])]))
    _moved(machine, rows, hole, tips, steps, np.asarray(bulk.program.line_of(slice(first + 1, first + 1 + count))))
    x, y, z = points[-1].tolist()
    machine.step = step + count - 1
    machine.programmed, machine.tip = (x, y, z), machine.to_machine((x, y, z))
    return count + 1


def at_each(m: Machine, points: Array, visit: Callable[[float, float], None]) -> None:
    """Call ``visit`` with x and y at each of the points (n, 2), in their order; what it does must depend on them alone.

    The first two and the last point are visited one by one. If the second visit leaves the machine as it found it but for
    its place, the rows of those between are its rows, moved.
    """
    places = points.tolist()
    several = len(points) >= FEWEST and not (np.diff(points, axis=0) == 0).all(axis=1).any()
    for x, y in places[: 1 if several else len(places)]:
        visit(x, y)
    if not several:
        return
    before = _state(m)
    m.recorder.room(0)  # the rows of the second visit will stand alone
    waiting = m.recorder._count
    visit(*places[1])
    rows = np.array(m.recorder.rows).reshape(-1, len(ROW))
    done = 2
    if _state(m) == before and m.recorder._count == waiting and len(rows) and (rows[:, ROW.index("joint")] < 0).all():
        level = m.programmed[2]
        hole = m.to_machine((*places[1], level))
        tips = frames.apply(m.frames.matrix, np.column_stack([points[2:-1], np.full(len(points) - 3, level)]))
        n = len(tips)
        m.recorder.expect(n * len(rows))
        _moved(m, rows, hole, tips, np.full(n, m.step, dtype=np.int32), np.full(n, m.source_line))
        (x, y), m.tip = places[-2], tuple(tips[-1].tolist())
        m.programmed = (x, y, level)
        done = len(places) - 1
    for x, y in places[done:]:
        visit(x, y)


def _state(m: Machine) -> tuple[Any, ...]:
    """What a visit must leave as it found it, so that the next one is the same."""
    return (
        m.programmed[2], m.cycle, dict(m.modal), dict(m.variables), m.feed, m.per_rev, m.speed, m.turning, m.tool, m.side,
        m.plane, m.synchronous, m.alarms.total, m.ended, len(m.settled),
    )  # fmt: skip


def _places(bulk: Bulk, first: int, end: int) -> tuple[Array, NDArray[np.bool_]]:
    """The places (n, 2) of the blocks in the plane, and which of them belong to one run with the first (n,)."""
    assert bulk.rule is not None
    n, words = end - first, bulk.columns(first, end)
    places = np.empty((n + 1, 2))
    alike = np.zeros(n, dtype=bool)
    absolute = bulk.rule.absolute(bulk.machine)
    for k, axis in enumerate("XY"):
        start, column = bulk.machine.programmed[k], words.pop(axis, None)
        places[:, k] = start
        if column is None:
            continue
        if absolute:
            written = np.concatenate([[start], column])
            index = np.maximum.accumulate(np.where(np.isnan(written), 0, np.arange(n + 1)))
            places[:, k] = written[index]
        else:
            places[:, k] = np.cumsum(np.concatenate([[start], np.nan_to_num(column)]))
        alike |= places[1:, k] != places[:-1, k]
    for column in words.values():
        alike &= (column == column[0]) | (np.isnan(column) & np.isnan(column[0]))
    return places[1:], alike


def _lasting(m: Machine) -> tuple[Any, ...]:
    """What a hole must leave as it found it, so that the next one is the same; first the level."""
    definition = m.position_cycle
    assert definition is not None
    modal = {p.name: definition.values.get(p.name) for p in definition.cycle.parameters() if p.modal}
    return (
        m.programmed[2], definition.cycle, modal, dict(definition.extra), dict(m.modal), m.feed, m.per_rev, m.speed, m.turning,
        m.tool, m.side, m.plane, m.synchronous, m.alarms.total, m.ended,
    )  # fmt: skip


def _begins_at(rows: Array, hole: tuple[float, float, float]) -> bool:
    """Whether the rows of a hole begin with a rapid to its place."""
    return bool(len(rows) > 1 and rows[0, 0] == Kind.RAPID and tuple(rows[0, 4:7]) == hole)


def _moved(
    m: Machine, rows: Array, hole: tuple[float, float, float], tips: Array, steps: NDArray[np.int32],
    lines: NDArray[np.integer[Any]],
) -> None:  # fmt: skip
    """Hand the rows (r, ...) of one hole, moved to the ``tips`` (n, 3), to the recorder."""
    n, r = len(tips), len(rows)
    column = {name: rows[:, k] for k, name in enumerate(ROW)}
    place = np.array(hole)
    room = m.recorder.room(n * r)[1:]
    ends = room.reshape(n, r, 3)
    np.add(tips[:, None, :], rows[:, 4:7] - place, out=ends)
    if m._shift is not None:
        ends[:, :, 2] = column["z"]  # exactly the levels of the first hole
    columns: dict[str, NDArray[Any]] = {
        "kind": np.tile(column["kind"].astype(np.uint8), n),
        "line": np.broadcast_to(lines.astype(np.int32)[:, None], (n, r)),
        "step": np.broadcast_to(steps[:, None], (n, r)),
        **{name: np.broadcast_to(column[name], (n, r)) for name in ("label", "feed", "state")},
    }
    if (column["state"] == column["state"][0]).all():
        columns["state"] = column["state"][0]
    if (column["kind"] == Kind.DWELL).any():
        columns["time"] = np.broadcast_to(column["time"], (n, r))
    if (column["kind"] == Kind.ARC).any():
        columns["centre"] = (tips[:, None, :] + (rows[:, 7:10] - place)).reshape(-1, 3)
        columns["sweep"] = np.broadcast_to(column["sweep"], (n, r))
    m.recorder.bulk(columns, room)

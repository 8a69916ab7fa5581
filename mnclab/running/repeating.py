"""Holes at many places, repeated as columns.

A program of a hundred thousand holes says the same hole a hundred thousand times: blocks of X and Y under a cycle that
runs at each position. The first two holes of such a run are made one by one, by the cycle itself. If they leave the machine
as they found it but for its place, and the second is the first one moved, every other hole is the same rows elsewhere, and
only places are worked out here: rows, steps and history of all holes are the second one's, moved. The last hole goes one by
one again, so that what the machine remembers of its last block is right without any bookkeeping here.

`at_each` does the same for the points of a pattern in one block.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.machine.rows import refuse_large
from mnclab.machine.state import COMPARED, HOLES, PATTERN, Snapshot
from mnclab.path.recorder import PLACES, ROW
from mnclab.path.toolpath import Kind
from mnclab.running.flow import Course, course
from mnclab.text.given import LARGEST

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine
    from mnclab.running.bulk import Bulk

Array = NDArray[np.float64]
FEWEST = 8  # points worth repeating as columns
SAME = 1e-7  # mm; places nearer than this are one
_END, _CENTRE = PLACES["end"], PLACES["centre"]
_ELSE = [ROW.index(name) for name in ("kind", "label", "sweep", "feed", "time", "state")]


class Visit(NamedTuple):
    """What was done at one place: rows (r, ...) as recorded, and their ends and centres (r, 3) from the place on the
    machine; the first `lead` of them were made before the tool came there, and count from where it came from.
    `left` is where it was left, from the place, on the machine (3,) and in the program (2,)."""

    rows: Array
    ends: Array
    centres: Array
    lead: int
    left: tuple[Array, Array]


def repeat_hole(bulk: Bulk, first: int, end: int, last: int, least: int) -> int:
    """Obey the plain blocks [first, end) that say the same hole at other places, in a run up to `last`; how many were, one
    fewer than belong to them, and 0 if fewer than `least` do.

    A block belongs to them if it moves in the plane and all its other words are those of the first block.
    """
    machine = bulk.machine
    places, alike = _places(bulk, first, end)
    good = len(alike) if alike.all() else int(np.argmin(alike))
    if good < least or machine.pole is not None or not _anywhere(machine) or not _position_alone(bulk, first):
        bulk.not_before = first + max(good, 1)
        return 0
    visits: list[Visit | None] = []
    before = Snapshot(lasting_over_blocks(machine))
    for block in (first, first + 1):
        step = machine.step
        visits.append(visit(machine, places[block - first], partial(_obey, bulk.flow, block), before, lasting_over_blocks))
        if visits[-1] is None or machine.step != step + 1:  # the other tier makes them
            bulk.once_more = block == first and not bulk.once_more  # the first of many may only have to come to their height
            bulk.not_before = first + (1 if bulk.once_more else least)
            return block - first + 1
    bulk.once_more = False
    model = _model(visits, places[:good])
    if model is None or model.rows[0, 0] != Kind.RAPID:
        bulk.not_before = first + least
        return 2
    count = good - 3
    machine.recorder.expect((len(model.rows) + 1) * (last - first))
    changed = {
        name: log.values[-1]
        for name, log in machine.logs.by_name.items()
        if log.steps and log.steps[-1] == machine.step and name != "position"
    }
    begun = bulk.flow.begin_many(machine, first + 2, count)
    steps = np.arange(begun, begun + count, dtype=np.int32)
    ends = places[2:][:count] + model.left[1]
    machine.logs.extend("position", steps, np.column_stack([ends, np.full(count, machine.programmed[2])]))
    for name, value in changed.items():
        machine.logs.extend(name, steps, [value] * count)
    lines = np.asarray(bulk.program.line_of(slice(first + 2, first + 2 + count)))
    _moved(machine, model, places[2:][:count], steps, lines)
    machine.step = begun + count - 1
    return count + 2


def _position_alone(bulk: Bulk, block: int) -> bool:
    """Whether a block says one hole: another motion, or a count of holes, is for the other tier."""
    program, definition = bulk.program, bulk.machine.position_cycle
    if definition is None:  # the block calls the cycle itself
        return True
    counts = {a for p in definition.cycle.parameters() if p.name == "repeats" for a in (p.address, *p.aliases)}
    words = program.address[program.first[block] : program.first[block + 1]]
    return all(program.addresses[k] != "G" and program.addresses[k] not in counts for k in words)


def _obey(flow: Course, block: int) -> None:
    flow.current = block
    flow.obey(block)


def lasting(m: Machine) -> dict[str, Any]:
    """Everything that stays from one visit to the next within a block: equal where the machine is as it was."""
    return _of(m, PATTERN) | {"where": course(m).standing()}


def lasting_over_blocks(m: Machine) -> dict[str, Any]:
    """The same where each visit is a plain block under the same cycle, of which only what is modal stays."""
    definition = m.position_cycle
    if definition is None:
        return _of(m, HOLES)
    modal = {p.name: definition.values.get(p.name) for p in definition.cycle.parameters() if p.modal}
    return _of(m, HOLES) | {"called": definition.cycle, "modal values": modal, "extra": definition.extra}


def _of(m: Machine, kind: str) -> dict[str, Any]:
    here = {"level": m.programmed[2], "joints": len(m.recorder.joints)}
    return here | {name: getattr(m, name) for name in COMPARED[kind]}


def at_each(m: Machine, points: Array, make: Callable[[float, float], None]) -> None:
    """Call `make` with x and y at each of the points (n, 2), in their order.

    The first three and the last point are visited one by one. If the second and the third visit leave the machine as they
    found it but for its place, and are the same but for it, the rows of those between are the same rows, moved.
    """
    places, done = points.tolist(), 0
    if len(points) >= FEWEST and _anywhere(m):
        make(*places[0])
        before = Snapshot(lasting(m))
        visits = [visit(m, points[k], partial(make, *places[k]), before, lasting) for k in (1, 2)]
        model, done = _model(visits, points[1:-1]), 3
        if model is not None:
            between = len(points) - 4
            _moved(m, model, points[3:-1], np.full(between, m.step, np.int32), np.full(between, m.source_line))
            done += between
    for x, y in places[done:]:
        make(x, y)


def _anywhere(m: Machine) -> bool:
    """Whether feed and speed of a move depend neither on its place nor on its length."""
    return m.surface is None and not m.per_time


def visit(
    m: Machine, place: Array, make: Callable[[], None], before: Snapshot, state: Callable[[Machine], dict[str, Any]]
) -> Visit | None:  # fmt: skip
    """Make a visit to a place (2,) of the program; None if it left the machine with another `state` than `before`, has rows
    that are gone or wait for later ones, or does not come over the place."""
    came, tip = m.programmed[:2], m.tip
    m.recorder.room(0)  # its rows will stand alone
    waiting = m.recorder.count
    make()
    rows = np.array(m.recorder.rows).reshape(-1, len(ROW))
    if m.recorder.count != waiting or not len(rows) or before.differences(state(m)):
        return None
    inside = frames.apply(frames.inverse(m.matrix), rows[:, _END])[:, :2]
    there = np.asarray((np.abs(inside - place) < SAME).all(axis=1))
    lead = int(np.argmax(there))
    if not there[lead] or not (np.abs(inside[:lead] - came) < SAME).all():
        return None
    hole = np.array(m.to_machine((place[0], place[1], m.programmed[2])))
    base = np.where(np.arange(len(rows))[:, None] < lead, np.array(tip), hole)
    left = np.subtract(m.tip, hole), np.subtract(m.programmed[:2], place)
    return Visit(rows, rows[:, _END] - base, rows[:, _CENTRE] - base, lead, left)


def _model(visits: list[Visit | None], places: Array) -> Visit | None:
    """The second of two visits, if both are the same and so is every way to its place and those after it: of places (n, 2),
    the first is that of the first visit. On each way something moves, or on none."""
    one, two = visits
    if one is None or two is None or one.lead != two.lead or len(one.rows) != len(two.rows):
        return None
    pairs = ((one.ends, two.ends), (one.centres, two.centres), (one.left[0], two.left[0]))
    alike = all(np.allclose(a, b, rtol=0, atol=SAME, equal_nan=True) for a, b in pairs)
    alike = alike and np.array_equal(one.rows[:, _ELSE], two.rows[:, _ELSE], equal_nan=True)
    moves: NDArray[np.bool_] = np.any(np.abs(places[1:] - (places[:-1] + two.left[1])) > SAME, axis=1)
    return two if alike and (moves == moves[0]).all() else None


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
    alike &= (np.abs(places[1:]) < LARGEST).all(axis=1)
    for column in words.values():
        alike &= (column == column[0]) | (np.isnan(column) & np.isnan(column[0]))
    program = bulk.program
    seen = np.unique(program.address[program.first[first] : program.first[end]])
    for address in seen[~np.isin(seen, list(bulk.index.values()))].tolist():
        there = np.zeros(n, dtype=bool)  # a word without a letter of its own, such as FMAX
        there[bulk.having(first, end, address)] = True
        alike &= there == there[0]
    return places[1:], alike


def _moved(
    m: Machine, model: Visit, places: Array, steps: NDArray[np.int32], lines: NDArray[np.integer[Any]]
) -> None:  # fmt: skip
    """Hand the rows of a visit, repeated at the places (n, 2) of the program, to the recorder; the tool is at the last."""
    level = m.programmed[2]
    tips = frames.apply(m.matrix, np.column_stack([places, np.full(len(places), level)]))
    base = np.broadcast_to(tips[:, None, :], (len(tips), len(model.rows), 3))
    if model.lead:
        base = base.copy()
        base[:, : model.lead] = np.concatenate([[m.tip], tips[:-1] + model.left[0]])[:, None, :]
    n, r = base.shape[:2]
    column = {name: model.rows[:, k] for k, name in enumerate(ROW)}
    room = m.recorder.room(n * r)[1:]
    ends = room.reshape(n, r, 3)
    np.add(base, model.ends, out=ends)
    if not (room.max() < LARGEST and room.min() > -LARGEST):
        refuse_large(m, room[np.argmax((np.abs(room) >= LARGEST).any(axis=1))].tolist())
    if m.shift is not None:
        ends[:, :, 2] = column["end_z"]  # exactly the levels of the first hole
    columns: dict[str, NDArray[Any]] = {
        "kind": np.tile(column["kind"].astype(np.uint8), n),
        "line": np.broadcast_to(lines.astype(np.int32)[:, None], (n, r)),
        "step": np.broadcast_to(steps[:, None], (n, r)),
        **{name: np.broadcast_to(column[name], (n, r)) for name in ("label", "feed", "state")},
    }
    if (column["state"] == column["state"][0]).all():
        columns["state"] = column["state"][0]
    if not np.isnan(column["time"]).all():
        columns["time"] = np.broadcast_to(column["time"], (n, r))
    if (column["kind"] == Kind.ARC).any():
        columns["centre"] = (base + model.centres).reshape(-1, 3)
        columns["sweep"] = np.broadcast_to(column["sweep"], (n, r))
    m.recorder.bulk(columns, room)
    (x, y), (u, v, w) = (places[-1] + model.left[1]).tolist(), (tips[-1] + model.left[0]).tolist()
    m.programmed, m.tip = (x, y, level), (u, v, w)

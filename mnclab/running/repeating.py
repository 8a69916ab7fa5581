"""What is done at one place, repeated as columns at many.

A visit to a place is made by the blocks or the cycle themselves. Where the next one is known to do the same, moved, only
places are worked out here: rows of all visits are those of the first, moved. `at_each` does so for the points of a pattern,
`running.drilling` for blocks.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.machine.rows import refuse_large
from mnclab.machine.state import COMPARED, PATTERN, Snapshot
from mnclab.path.recorder import PLACES, ROW, columns_of
from mnclab.running.flow import course
from mnclab.text.given import LARGEST

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

Array = NDArray[np.float64]
Index = NDArray[np.intp]
FEWEST = 8  # points worth repeating as columns
SAME = 1e-7  # mm; places nearer than this are one
_END, _CENTRE = PLACES["end"], PLACES["centre"]
_REPEATED = ("kind", "label", "sweep", "feed", "time", "state")
_ELSE = [ROW.index(name) for name in _REPEATED]


class Visit(NamedTuple):
    """What was done at one place: rows (r, ...) as recorded, and their ends and centres (r, 3) from the place on the
    machine; the first `lead` of them were made before the tool came there, and count from where it came from.
    `left` is where it was left, from the place, on the machine (3,) and in the program (2,)."""

    rows: Array
    ends: Array
    centres: Array
    lead: int
    left: tuple[Array, Array]


def lasting(m: Machine) -> dict[str, Any]:
    """Everything that stays from one visit to the next within a block: equal where the machine is as it was."""
    flow = course(m)
    return remembered(m, PATTERN) | {"where": (*flow.standing(), flow.limit, flow.begun, flow.in_bulk, flow.current)}


def remembered(m: Machine, kind: str) -> dict[str, Any]:
    """What visits of a kind must leave as it was."""
    here = {"level": m.programmed[2], "joints": len(m.recorder.joints)}
    return here | {name: getattr(m, name) for name in COMPARED[kind]}


def at_each(m: Machine, points: Array, make: Callable[[float, float], None]) -> None:
    """Call `make` with x and y at each of the points (n, 2), in their order.

    The first three and the last point are visited one by one. If the second and the third visit leave the machine as they
    found it but for its place, and are the same but for it, the rows of those between are the same rows, moved.
    """
    places, done = points.tolist(), 0
    if len(points) >= FEWEST and anywhere(m):
        make(*places[0])
        before, visits = Snapshot(lasting(m)), []
        for k in (1, 2):
            made = visit(m, points[k], partial(make, *places[k]))
            visits.append(None if before.differences(lasting(m)) else made)
        model, done = _model(visits, points[1:-1]), 3
        if model is not None:
            between = points[3:-1]
            which, level = np.zeros(len(between), np.intp), np.full(len(between), m.programmed[2])
            moved(m, [model], which, np.column_stack([between, level]), np.int32(m.step), np.int32(m.source_line))
            done += len(between)
    for x, y in places[done:]:
        make(x, y)


def anywhere(m: Machine) -> bool:
    """Whether feed and speed of a move depend neither on its place nor on its length."""
    return m.surface is None and not m.per_time


def visit(m: Machine, place: Array, make: Callable[[], None]) -> Visit | None:
    """Make a visit to a place (2,) of the program; None if it has rows that are gone or wait for later ones, or does not come
    over the place."""
    came, tip = m.programmed[:2], m.tip
    m.recorder.room(0)  # its rows will stand alone
    waiting = m.recorder.count
    make()
    rows = np.array(m.recorder.rows).reshape(-1, len(ROW))
    if m.recorder.count != waiting:
        return None
    inside = rows[:, _END] - m.shift if m.shift is not None else frames.apply(frames.inverse(m.matrix), rows[:, _END])
    inside = inside[:, :2]
    there = np.asarray((np.abs(inside - place) < SAME).all(axis=1))
    lead = int(np.argmax(there)) if len(rows) else 0
    if len(rows) and not there[lead] or not (np.abs(inside[:lead] - came) < SAME).all():
        return None
    over = np.array(m.to_machine((place[0], place[1], m.programmed[2])))
    base = np.where(np.arange(len(rows))[:, None] < lead, np.array(tip), over)
    left = np.subtract(m.tip, over), np.subtract(m.programmed[:2], place)
    return Visit(rows, rows[:, _END] - base, rows[:, _CENTRE] - base, lead, left)


def alike(one: Visit, two: Visit) -> bool:
    """Whether two visits are the same, moved."""
    if one.lead != two.lead or len(one.rows) != len(two.rows):
        return False
    pairs = ((one.ends, two.ends), (one.centres, two.centres), (one.left[0], two.left[0]))
    near = not any((np.abs(a - b) > SAME).any() for a, b in pairs)  # nan is the centre of no arc
    return near and np.array_equal(one.rows[:, _ELSE], two.rows[:, _ELSE], equal_nan=True)


def _model(visits: list[Visit | None], places: Array) -> Visit | None:
    """The second of two visits, if both are the same and so is every way to its place and those after it: of places (n, 2),
    the first is that of the first visit. On each way something moves, or on none."""
    one, two = visits
    if one is None or two is None or not alike(one, two):
        return None
    moves: NDArray[np.bool_] = np.any(np.abs(places[1:] - (places[:-1] + two.left[1])) > SAME, axis=1)
    return two if (moves == moves[0]).all() else None


def moved(m: Machine, visits: list[Visit], which: Index, places: Array, steps: Any, lines: Any) -> None:
    """Hand the rows of visits to the recorder, of each place (n, 3) of the program those of `which` (n,) visit; the tool is at
    the last. `steps` and `lines` are (n,), or one for all."""
    tips = frames.apply(m.matrix, places)
    left = tips + np.array([one.left[0] for one in visits])[which]
    if any(len(one.rows) for one in visits):
        _repeated(m, visits, which, tips, np.concatenate([[m.tip], left[:-1]]), steps, lines)
    m.programmed = (*(places[-1, :2] + visits[which[-1]].left[1]).tolist(), float(places[-1, 2]))
    m.tip = tuple(left[-1].tolist())


def _repeated(
    m: Machine, visits: list[Visit], which: Index, tips: Array, came: Array, steps: Any, lines: Any
) -> None:  # fmt: skip
    """The rows over places whose `tips` (n, 3) the tool `came` to from (n, 3)."""
    size, lead = (np.array(of, np.intp) for of in ([len(one.rows) for one in visits], [one.lead for one in visits]))
    rows, ends, centres = (np.concatenate([one[k] for one in visits]) for k in range(3))
    count, first = size[which], np.cumsum(size) - size  # rows of each visit, and where they are among `rows`
    visited = np.arange(len(which)).repeat(count)
    source = np.arange(len(visited)) + (first[which] - np.cumsum(count) + count).repeat(count)
    columns = {name: one.repeat(count) if np.ndim(one) else one for name, one in (("step", steps), ("line", lines))}
    columns |= {name: one.take(source) if np.ndim(one) else one for name, one in columns_of(rows, _REPEATED).items()}
    room = m.recorder.room(len(source))[1:]
    tips.take(visited, axis=0, out=room, mode="clip")
    if lead.any():
        early = np.flatnonzero(source < (first + lead)[which][visited])
        room[early] = came[visited[early]]
    if np.isfinite(centres).any():
        columns["centre"] = room + centres.take(source, axis=0)
    if m.shift is None or ends[:, :2].any():
        room += ends.take(source, axis=0)
    if m.shift is not None:
        room[:, 2] = rows[:, _END][:, 2].take(source)  # exactly the levels of the visit
    if np.abs(tips).max() + np.abs(ends).max() >= LARGEST:
        _refuse_far(m, room)
    m.recorder.bulk(columns, room)


def _refuse_far(m: Machine, ends: Array) -> None:
    """An Alarm at the first of the ends (n, 3) that is too far away, if one is."""
    far = (np.abs(ends) >= LARGEST).any(axis=1)
    if far.any():
        refuse_large(m, ends[np.argmax(far)].tolist())

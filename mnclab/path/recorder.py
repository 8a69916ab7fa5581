"""Rows as they come from a machine, one by one or in bulk, and the toolpath they make.

What changes seldom (tool, spindle, side, …) is kept once per *state* and rows point to it, so that a row is a short
tuple. Rows made in bulk arrive as columns.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterable
from copy import copy
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from mnclab.path.cylinder import Cylinder
from mnclab.path.toolpath import COLUMNS, Array, Column, Kind, Toolpath, concatenate, fields

NAN, INF = np.nan, np.inf
#: The columns, and which state (an index) a row has.
KEPT = COLUMNS | {"state": Column(np.int64, 0, "index of the State", per="row")}
SHARED = {name: each for name, each in KEPT.items() if each.per == "state"}
SINGLE = {name: each for name, each in KEPT.items() if each.per == "row"}
ROW = [part for name, each in SINGLE.items() for part in each.flat(name)]  # the order of `Recorder.add`
#: Where each column of single rows stands in `ROW`.
PLACES = {name: slice(ROW.index(each.flat(name)[0]), ROW.index(each.flat(name)[-1]) + 1) for name, each in SINGLE.items()}
ALWAYS = ("kind", "line", "step", "end")  # said in every chunk of rows
#: What the other columns are where a chunk does not say.
PLAIN: dict[str, Any] = {
    name: np.full(each.shape, each.default) if each.parts else each.default
    for name, each in SINGLE.items()
    if name not in ALWAYS
}
TOGETHER = 1 << 16  # single rows that are made columns at once: they take less room then


class State(fields("State", SHARED)):  # type: ignore[misc]
    """What a row shares with its neighbours: a value for each column per state."""

    __slots__ = ()


class Recorder:
    """Collects rows; `take` hands over what has come since the last time."""

    def __init__(self, start: tuple[float, float, float]) -> None:
        self.rows = array("d")  # one after the other; a list of tuples would be slower to make columns of
        self.states: list[State] = []
        self._state_index: dict[State, int] = {}
        self.labels: dict[str, int] = {"": 0}
        self.joints: list[Any] = []
        self.cylinders: list[Cylinder] = []
        self._done: list[dict[str, NDArray[Any]]] = []  # column chunks not yet taken
        self.taken = 0  # rows handed over
        self._count = 0
        self.most = INF
        self.refuse: Callable[[int], NoReturn] = _refuse
        self.expected = 0  # rows, roughly: room that is never used costs nothing, room made anew costs much
        self.start = start

    @property
    def start(self) -> Array:
        """Where (3,) the next path begins. Set it between two paths only."""
        return self._vertices[0]

    @start.setter
    def start(self, point: Iterable[float]) -> None:
        self._vertices = np.array([tuple(point)], dtype=np.float64)  # (room + 1, 3), of which the first are filled
        self._count = 0  # rows that have their vertices there

    @property
    def count(self) -> int:
        """Rows not yet taken that are columns already; `rows` come on top."""
        return self._count

    @property
    def most(self) -> float:
        """How many rows there may be; `refuse` is called before there are more."""
        return self._most

    @most.setter
    def most(self, most: float) -> None:
        self._most = most
        self._look_out()

    def _look_out(self) -> None:
        """Set how many single rows may come before something is to be done about them."""
        self._full = int(min(TOGETHER, max(self._most - self.taken - self._count, 0) + 1)) * len(ROW)

    @property
    def made(self) -> int:
        return self.taken + self._count + len(self.rows) // len(ROW)

    def copy(self) -> Recorder:
        """The same rows, apart from those to come."""
        self._flush()
        twin = copy(self)
        twin.rows, twin._vertices = array("d"), self._vertices[: self._count + 1]
        twin.states, twin._state_index = self.states.copy(), self._state_index.copy()
        twin.labels, twin.joints, twin.cylinders = self.labels.copy(), self.joints.copy(), self.cylinders.copy()
        twin._done = [chunk.copy() for chunk in self._done]
        return twin

    def another(self, start: tuple[float, float, float]) -> Recorder:
        """An empty one, for a path apart from this one, with what room is left here."""
        other = Recorder(start)
        other.most, other.refuse = self.most - self.made, self.refuse
        return other

    def expect(self, count: int) -> None:
        """So many rows are to come; room made once is not made anew."""
        self.expected = max(self.expected, self._count + len(self.rows) // len(ROW) + count)

    def room(self, count: int) -> Array:
        """Where the vertices (count + 1, 3) of the next rows will lie; the first one is the end of the last row."""
        self._flush()
        return self._room(count)

    def _room(self, count: int) -> Array:
        needed = self._count + count + 1
        if self.taken + needed - 1 > self.most:
            self.refuse(self.taken + needed - 1)
        if needed > len(self._vertices):
            most = max(needed, int(min(self.most, 1 << 60)) + 1 - self.taken)
            more = np.empty((min(most, max(needed, 2 * len(self._vertices), self.expected + 1)), 3))
            more[: self._count + 1] = self._vertices[: self._count + 1]
            self._vertices = more
        return self._vertices[self._count : needed]

    def state(self, state: State) -> int:
        index = self._state_index.get(state)
        if index is None:
            index = self._state_index[state] = len(self.states)
            self.states.append(state)
        return index

    def label(self, text: str) -> int:
        return self.labels.setdefault(text, len(self.labels))

    def cylinder(self, one: Cylinder) -> int:
        """The index of a cylinder, which rows carry."""
        if one not in self.cylinders:
            self.cylinders.append(one)
        return self.cylinders.index(one)

    def add(self, row: tuple[Any, ...]) -> None:
        """One row, the values in the order of `ROW`."""
        self.rows.extend(row)
        if len(self.rows) >= self._full:
            if self.made > self.most:
                del self.rows[-len(ROW) :]
                self.refuse(self.made + 1)
            self._flush()

    def bulk(self, columns: dict[str, NDArray[Any]], ends: Array) -> None:
        """Rows (n,) as columns: `kind` and what differs from `PLAIN`; one value stands for all.

        A column but `kind` may also be (k, n / k), which is read row by row: what repeats need not be written out.
        `ends` (n, 3) may lie in `room` already.
        """
        self._flush()
        self._append(columns, ends)

    def _append(self, columns: dict[str, NDArray[Any]], ends: Array) -> None:
        room = self._room(len(ends))[1:]
        if room.__array_interface__["data"] != ends.__array_interface__["data"]:
            room[:] = ends
        self._done.append({**columns, "end": room})
        self._count += len(ends)
        self._look_out()

    @property
    def moved(self) -> bool:
        """Whether a row has moved, as far as rows have not been handed over."""
        self._flush()
        return self.taken > 0 or any((chunk["kind"] <= Kind.PROBE).any() for chunk in self._done)

    def _last_motion(self) -> tuple[dict[str, NDArray[Any]], int, Array] | None:
        """The columns, the row in them and the joints of the last line, arc or rapid not yet taken."""
        self._flush()
        for chunk in reversed(self._done):
            if len(moves := np.flatnonzero(chunk["kind"] <= Kind.PROBE)):
                joints = np.broadcast_to(chunk.get("joint", PLAIN["joint"]), chunk["kind"].shape)
                return None if chunk["kind"][moves[-1]] == Kind.PROBE else (chunk, int(moves[-1]), joints)
        return None

    def mark(self, joint: Any) -> bool:
        """Put a joint on the last motion; False if there is none, or if it has one already."""
        last = self._last_motion()
        if last is None or last[2][last[1]] >= 0:
            return False
        chunk, row, joints = last
        chunk["joint"] = joints.copy()
        chunk["joint"][row] = len(self.joints)
        self.joints.append(joint)
        return True

    def last(self) -> tuple[Kind, Any] | None:
        """The kind and the joint of the last motion; None if it has none."""
        found = self._last_motion()
        if found is None:
            return None
        chunk, row, joints = found
        number = int(joints[row])
        return Kind(int(chunk["kind"][row])), self.joints[number] if number >= 0 else None

    def heading(self) -> Array | None:
        """The unit tangent (3,) at the end of the last motion; None if it has none."""
        last = self._last_motion()
        if last is None:
            return None
        chunk, row, _ = last
        end = chunk["end"][row]
        if chunk["kind"][row] == Kind.ARC:
            state, turn = (_column(name, [chunk[name]], [len(chunk["kind"])])[row] for name in ("state", "sweep"))
            axis = np.array(self.states[int(state)].axis)
            spoke = end - chunk["centre"][row]
            travel = np.cross(axis, spoke) * np.sign(turn)
        else:
            index = next(i for i, each in enumerate(self._done) if each is chunk)
            before = self._done[index - 1]["end"][-1] if index else self.start
            travel = end - (chunk["end"][row - 1] if row else before)
        length = float(np.linalg.norm(travel))
        return travel / length if length > 0 else None

    def _flush(self) -> None:
        if not self.rows:
            return
        table = np.frombuffer(self.rows).reshape(-1, len(ROW))
        self.rows = array("d")
        chunk = columns_of(table)
        self._append(chunk, chunk.pop("end"))

    def take(self) -> Toolpath:
        """The rows since the last call as a path that begins at `start`, which moves on to its end."""
        self._flush()
        chunks, self._done = self._done, []
        if not chunks:
            return self._path({}, self.start[None])
        sizes = [len(chunk["kind"]) for chunk in chunks]
        self.taken += sum(sizes)
        columns = {  # each part is let go when its column is made
            name: _column(name, [chunk.pop(name, PLAIN.get(name)) for chunk in chunks], sizes)
            for name in list(dict.fromkeys(name for chunk in chunks for name in chunk))
            if name != "end"
        }
        vertices = self._vertices[: self._count + 1]
        self._vertices, self._count = self._vertices[self._count :], 0  # the next path begins where this one ends
        return self._path(columns, vertices)

    def _path(self, columns: dict[str, NDArray[Any]], vertices: Array) -> Toolpath:
        if columns:
            which = columns.pop("state")
            used = self.states if which.strides[0] else [self.states[int(which[0])]]
            for name in State._fields:
                values = np.array([getattr(state, name) for state in used], dtype=COLUMNS[name].dtype)
                same = bool((values == values[:1]).all() or (values != values).all())  # equal, or nothing but nan
                columns[name] = COLUMNS[name].of(len(which), values[0]) if same else values[which]
            if not np.isnan(columns["per_rev"]).all():  # what does not cut at a feed has none per revolution
                columns["per_rev"] = np.where(np.isfinite(columns["feed"]), columns["per_rev"], NAN)
        else:
            columns = {"kind": np.empty(0, dtype=np.uint8)}
        lists = {"labels": tuple(self.labels), "joints": tuple(self.joints), "cylinders": tuple(self.cylinders)}
        return Toolpath.chain(vertices, columns, **lists)


def _refuse(count: int) -> NoReturn:
    raise ValueError(f"there would be {count} rows")


def columns_of(rows: Array, names: Iterable[str] = PLACES) -> dict[str, NDArray[Any]]:
    """Columns of single rows (n, k) in the order of `ROW`; one value where it serves for all of them."""
    return {name: _plain(name, rows[:, PLACES[name]]) for name in names}


def _plain(name: str, part: Array) -> NDArray[Any]:
    """A column of single rows (n, k); where one value serves for all of them it is that value, which costs nothing."""
    vector, dtype = bool(SINGLE[name].parts), SINGLE[name].dtype
    usual = PLAIN.get(name) if name != "state" else part[0]
    if usual is not None and ((part == usual) | (usual != usual) & np.isnan(part)).all():
        return usual if vector else np.asarray(usual, dtype).reshape(())
    return part.copy() if vector else part[:, 0].astype(dtype)


def _column(name: str, parts: list[Any], sizes: list[int]) -> NDArray[Any]:
    """One column from parts, some of which are a single value for all their rows; a constant column costs nothing."""
    each, rows = KEPT[name], sum(sizes)
    if each.parts:
        constant = all(part is PLAIN.get(name) for part in parts)
    else:
        constant = all(np.ndim(part) == 0 for part in parts) and len({repr(float(part)) for part in parts}) == 1
    if constant:
        return each.of(rows, parts[0])
    result, at = np.empty((rows, *each.shape), dtype=each.dtype), 0
    for part, size in zip(parts, sizes, strict=True):
        to = result[at : at + size]
        if np.ndim(part) == 2 and not each.parts:
            to = to.reshape(np.shape(part))
        to[...] = part
        at += size
    return result


def join(pieces: list[Toolpath], recorder: Recorder) -> Toolpath:
    """One path from settled pieces, with the labels and joints known at the end."""
    whole = concatenate(pieces) if pieces else recorder.take()
    lists = {"joints": tuple(recorder.joints), "cylinders": tuple(recorder.cylinders)}
    return whole.annotated(labels=tuple(recorder.labels), **lists)

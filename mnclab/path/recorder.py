"""Rows as they come from a machine, one by one or in bulk, and the toolpath they make.

What changes seldom (tool, spindle, side, …) is kept once per *state* and rows point to it, so that a row is a short
tuple. Rows made in bulk arrive as columns.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.path.kinds import Kind
from mnclab.path.toolpath import Toolpath, concatenate

NAN = float("nan")


class State(NamedTuple):
    """What a row shares with its neighbours; the fields are columns of the toolpath."""

    program: int = 0
    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    rotary: tuple[float, float, float] = (0.0, 0.0, 0.0)
    per_rev: float = NAN
    surface: float = NAN
    spindle: float = 0.0
    tool: int = 0
    radius: float = 0.0
    side: int = 0
    corner_rule: int = 0
    exact: bool = False
    synchronous: bool = False


ROW = ("kind", "line", "step", "label", "x", "y", "z", "cx", "cy", "cz", "sweep", "feed", "time", "joint", "state")


class Recorder:
    """Collects rows; :meth:`take` hands over what has come since the last time."""

    def __init__(self, start: tuple[float, float, float]) -> None:
        self.rows: list[tuple[Any, ...]] = []
        self.states: list[State] = []
        self._state_index: dict[State, int] = {}
        self.labels: dict[str, int] = {"": 0}
        self.joints: list[Any] = []
        self._done: list[dict[str, NDArray[Any]]] = []  # column chunks not yet taken
        self.start = np.array(start, dtype=np.float64)
        self.count = 0

    def state(self, state: State) -> int:
        """The index of a state."""
        index = self._state_index.get(state)
        if index is None:
            index = self._state_index[state] = len(self.states)
            self.states.append(state)
        return index

    def label(self, text: str) -> int:
        """The index of a label."""
        return self.labels.setdefault(text, len(self.labels))

    def bulk(self, columns: dict[str, NDArray[Any]]) -> None:
        """Rows (n,) as columns: ``end`` (n, 3), ``kind``, ``line``, ``step`` … and ``state`` (index or array)."""
        self._flush()
        n = len(columns["kind"])
        defaults = {"label": 0, "sweep": 0.0, "feed": NAN, "time": NAN, "joint": -1}
        whole = {name: np.broadcast_to(np.asarray(value), (n,)) for name, value in defaults.items()}
        whole["centre"] = np.broadcast_to(np.array([NAN] * 3), (n, 3))
        whole |= {name: np.broadcast_to(np.asarray(c), (n,)) if np.ndim(c) == 0 else c for name, c in columns.items()}
        self._done.append(whole)

    def _last_motion(self) -> tuple[dict[str, NDArray[Any]], int] | None:
        """The columns and the row in them of the last line, arc or rapid not yet taken."""
        self._flush()
        for chunk in reversed(self._done):
            moves = np.flatnonzero(chunk["kind"] <= Kind.PROBE)
            if len(moves):
                row = int(moves[-1])
                return None if chunk["kind"][row] == Kind.PROBE else (chunk, row)
        return None

    def mark(self, joint: Any) -> bool:
        """Put a joint on the last motion; False if there is none, or if it has one already."""
        last = self._last_motion()
        if last is None or last[0]["joint"][last[1]] >= 0:
            return False
        chunk, row = last
        chunk["joint"] = np.array(chunk["joint"])  # may be a broadcast constant
        chunk["joint"][row] = len(self.joints)
        self.joints.append(joint)
        return True

    def heading(self) -> NDArray[np.float64] | None:
        """The unit tangent (3,) at the end of the last motion; None if it has none."""
        last = self._last_motion()
        if last is None:
            return None
        chunk, row = last
        end = chunk["end"][row]
        if chunk["kind"][row] == Kind.ARC:
            axis = np.array(self.states[int(chunk["state"][row])].axis)
            spoke = end - chunk["centre"][row]
            travel = np.cross(axis, spoke) * np.sign(chunk["sweep"][row])
        else:
            before = [np.array(self.start), *(c["end"][-1] for c in self._done)]
            index = next(i for i, c in enumerate(self._done) if c is chunk)
            travel = end - (chunk["end"][row - 1] if row else before[index])
        length = float(np.linalg.norm(travel))
        return travel / length if length > 0 else None

    def _flush(self) -> None:
        if not self.rows:
            return
        table = np.array(self.rows, dtype=np.float64)
        named = {name: table[:, i] for i, name in enumerate(ROW) if len(name) > 2}
        self._done.append({**named, "end": table[:, 4:7], "centre": table[:, 7:10]})
        self.rows = []

    def take(self) -> Toolpath:
        """The rows since the last call as a path that begins at :attr:`start`, which moves on to its end."""
        self._flush()
        chunks, self._done = self._done, []
        if not chunks:
            return self._path({}, self.start[None])
        columns = {name: np.concatenate([chunk[name] for chunk in chunks]) for name in chunks[0]}
        vertices = np.concatenate([self.start[None], columns.pop("end")])
        self.start = vertices[-1]
        return self._path(columns, vertices)

    def _path(self, columns: dict[str, NDArray[Any]], vertices: NDArray[np.float64]) -> Toolpath:
        if columns:
            which = columns.pop("state").astype(np.int64)
            states = self.states
            for name in State._fields:
                values = np.array([getattr(state, name) for state in states])
                same = bool((values == values[:1]).all()) or bool(np.isnan(values.astype(float)).all())
                columns[name] = np.broadcast_to(values[0], (len(which), *values.shape[1:])) if same else values[which]
        else:
            columns = {"kind": np.empty(0, dtype=np.uint8)}
        return Toolpath.chain(vertices, columns, labels=tuple(self.labels), joints=tuple(self.joints))


def join(pieces: list[Toolpath], recorder: Recorder) -> Toolpath:
    """One path from settled pieces, with the labels and joints known at the end."""
    whole = concatenate(pieces) if pieces else recorder.take()
    return whole.annotated(labels=tuple(recorder.labels), joints=tuple(recorder.joints))

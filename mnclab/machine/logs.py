"""Writing down what changes: a log per name, of the steps at which it changed and the values from there on.

A *step* is one execution of a block; `runs.history` reads the logs after the run.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Values = list[Any] | NDArray[Any]


class Log:
    """Changes of one name: steps (k,) in rising order, and the values from there on."""

    __slots__ = ("_chunks", "steps", "values")

    def __init__(self) -> None:
        self.steps: list[int] = []
        self.values: list[Any] = []
        self._chunks: list[tuple[NDArray[np.integer[Any]], Values]] = []

    def copy(self) -> Log:
        """The same changes, apart from those to come."""
        twin = Log()
        twin.steps, twin.values, twin._chunks = self.steps.copy(), self.values.copy(), self._chunks.copy()
        return twin

    def extend(self, steps: NDArray[np.integer[Any]], values: Values) -> None:
        if len(steps):
            self._chunks += [(np.array(self.steps, dtype=np.int64), self.values), (steps, values)]
            self.steps, self.values = [], []

    @property
    def first(self) -> int:
        chunks = [steps for steps, _ in self._chunks if len(steps)]
        return int(chunks[0][0]) if chunks else self.steps[0]

    def close(self, last: int) -> tuple[NDArray[np.integer[Any]], Values]:
        """All changes up to step `last`."""
        own = np.array(self.steps, dtype=np.int64), self.values
        chunks = [chunk for chunk in (*self._chunks, own) if len(chunk[0])] or [own]
        pieces = [values for _, values in chunks]
        steps = np.concatenate([steps for steps, _ in chunks])
        keep = int(np.searchsorted(steps, last, "right"))
        if len(pieces) == 1:
            return steps[:keep], pieces[0][:keep]
        if any(isinstance(values, np.ndarray) for values in pieces):
            return steps[:keep], np.concatenate([np.asarray(values) for values in pieces])[:keep]
        return steps[:keep], [value for values in pieces for value in values][:keep]


class Logs:
    """The logs while a program runs."""

    def __init__(self) -> None:
        self.by_name: dict[str, Log] = {}

    def add(self, name: str, step: int, value: Any) -> None:
        log = self.by_name.get(name) or self.by_name.setdefault(name, Log())
        steps = log.steps
        if steps and steps[-1] >= step:  # of a block that goes on after others that it has obeyed
            log.values[-1] = value
        else:
            steps.append(step)
            log.values.append(value)

    def extend(self, name: str, steps: NDArray[np.integer[Any]], values: Values) -> None:
        self.by_name.setdefault(name, Log()).extend(steps, values)

    def changed(self, name: str, last: int) -> list[tuple[int, Any]]:
        """The steps up to `last` at which a name changed, and its value from there on."""
        log = self.by_name.get(name)
        return [(int(step), value) for step, value in zip(*log.close(last))] if log else []

    def value(self, name: str, step: int) -> Any:
        """What a name was after a step; None if it had no value yet."""
        changes = self.changed(name, step)
        return changes[-1][1] if changes else None

"""What changed at each step: a log per name, looked up by `searchsorted`.

A *step* is one execution of a block; a loop runs a block many times, each a step of its own. Names are modal groups
("motion", "plane"), values ("feed", "speed", "spindle", "tool"), "position" (the programmed point), frames ("frame
datum", 4x4), "pole" (both coordinates in the plane, mm), variables ("Q5"), measured values and table rows.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.machine.state import Logs, Values


class History(Mapping[str, Any]):
    """What was active at each step of a run. `history["feed"]` is one value per step, `history.at(step)` a dict."""

    def __init__(self, logs: Logs, steps: int) -> None:
        self.steps = steps
        self._open = {name: log for name, log in logs.by_name.items() if log.first < max(steps, 1)}
        self._closed: dict[str, tuple[NDArray[np.integer[Any]], Values]] = {}

    def log(self, name: str) -> tuple[NDArray[np.integer[Any]], Values]:
        """Steps and values of a name; put together when first asked for, since a million positions take time."""
        if name not in self._closed:
            self._closed[name] = self._open[name].close(max(self.steps - 1, 0))
        return self._closed[name]

    def __getitem__(self, name: str) -> Values:
        """One value per step; None before the first."""
        at, values = self.log(name)
        index = np.searchsorted(at, np.arange(self.steps), "right") - 1
        if isinstance(values, np.ndarray) and (index >= 0).all():
            return values[index]
        return [values[i] if i >= 0 else None for i in index]

    def __contains__(self, name: object) -> bool:
        return name in self._open  # a Mapping would make all its values to know

    def __iter__(self) -> Iterator[str]:
        return iter(self._open)

    def __len__(self) -> int:
        return len(self._open)

    def value(self, name: str, step: int) -> Any:
        """What `name` was after a step; None if it had no value yet."""
        if name not in self._open:
            return None
        at, values = self.log(name)
        index = int(np.searchsorted(at, step, "right")) - 1
        return _plain(values[index]) if index >= 0 else None

    def changed(self, name: str) -> list[tuple[int, Any]]:
        """The steps at which a name changed, and its value from there on; empty for a name without a log."""
        if name not in self._open:
            return []
        at, values = self.log(name)
        return [(int(step), _plain(value)) for step, value in zip(at, values)]

    def at(self, step: int) -> dict[str, Any]:
        """Everything that had a value after a step."""
        return {name: value for name in self._open if (value := self.value(name, step)) is not None}

    def changes(self, step: int) -> dict[str, Any]:
        """What this step changed; a value that was written again as it was is no change."""
        found = {}
        for name in self._open:
            at, values = self.log(name)
            index = int(np.searchsorted(at, step, "right")) - 1
            if index >= 0 and at[index] == step:
                value = _plain(values[index])
                if index == 0 or value != _plain(values[index - 1]):
                    found[name] = value
        return found

    def __repr__(self) -> str:
        return f"<History: {self.steps} steps, {len(self._open)} names>"


def _plain(value: Any) -> Any:
    """A numpy value as a plain one; a point as a tuple."""
    if isinstance(value, np.ndarray):
        return tuple(value.tolist())
    return value.item() if isinstance(value, np.generic) else value

"""The frames of a run, put together again out of its history: which chain was in force after each step.

Frames of the tool's length are left out: they move the tip, not the coordinates that a program counts in.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from itertools import groupby
from typing import Any

import numpy as np

from mnclab.geometry import frames
from mnclab.geometry.frames import FrameChain, Matrix

#: Frames that set a zero point; a control that keeps the shifts of G52 and G92 apart has `local` and `set`.
ORIGINS = {"datum": "", "preset": "preset", "local": "G92", "set": "G92", "shift": "datum shift"}
LENGTH = "length"
PREFIX = "frame "


def replayed(run: Any, *more: str) -> Iterator[tuple[int, list[str], list[tuple[str, Any]], FrameChain]]:
    """Each step that changes frames or one of the names `more`: the step, the frames that it sets, the other changes, and the
    chain after it, which is one object that goes on changing."""
    history, chain = run.history, FrameChain(run.frames.slots)
    names = [name for name in history if name.startswith(PREFIX) and name != PREFIX + LENGTH]
    log = [(step, name not in names, name, value) for name in (*names, *more) for step, value in history.changed(name)]
    nested = run.settings.get("transformation_order") == "nested"
    for step, changes in groupby(sorted(log, key=lambda each: each[:2]), key=lambda each: each[0]):
        set_here: list[str] = []
        others: list[tuple[str, Any]] = []
        for _, other, name, value in changes:
            if other:
                others.append((name, value))
                continue
            frame, matrix = name.removeprefix(PREFIX), np.array(value)
            if nested and frame not in ORIGINS and not np.array_equal(matrix, chain[frame]):
                chain.innermost(frame)
            chain.set(frame, None if np.array_equal(matrix, frames.IDENTITY) else matrix)
            set_here.append(frame)
        yield step, set_here, others, chain


class Chains:
    """The chains of a run by step."""

    def __init__(self, run: Any) -> None:
        self.steps, self.chains = [-1], [FrameChain(run.frames.slots)]
        for step, _, _, chain in replayed(run):
            self.steps.append(step)
            self.chains.append(chain.copy())

    def __len__(self) -> int:
        return len(self.chains)

    def at(self, step: int) -> FrameChain:
        """The chain after a step."""
        return self.chains[bisect_right(self.steps, step) - 1]


def without(chain: FrameChain, names: tuple[str, ...]) -> Matrix:
    """The product of a chain as if some of its frames were neutral."""
    found = chain.copy()
    for name in names:
        found.set(name, None)
    return found.matrix


UPRIGHT = 1e-9


def tilted_planes(run: Any) -> tuple[list[int], list[Matrix | None]]:
    """The steps from which on the coordinates of a program lie tilted on the part, and how: the frame (4, 4) of each, in
    coordinates of the path; None from where they lie level again."""
    steps, planes = [0], list[Matrix | None]([None])
    for step, _, _, chain in replayed(run):
        frame = chain.matrix.copy()
        frame[:3, 3] -= run.toolpath.origin
        level = np.abs(frame[:2, 2]).max() < UPRIGHT and frame[2, 2] > 0
        if (now := None if level else frame) is not planes[-1]:
            steps.append(step)
            planes.append(now)
    return steps, planes

"""Passes as a whole tool path: down, along, up again, level by level. Lengths in mm, feeds in mm/min.

A cycle has its own steps and runs passes with the machine's verbs; this is the plain way, for comparing strategies and for
a path without a program. Labels name every row: "entry helix", "ring 3 of 7", "link", "lift".
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from mnclab.geometry.contours import Contour, Floats
from mnclab.machining.milling.clearing import Clearing, Piece, begin
from mnclab.machining.milling.entries import VERTICAL, Entry, descent
from mnclab.path.kinds import Kind
from mnclab.path.toolpath import Toolpath

SAME = 1e-9


class _Rows:
    """Rows of a path as they come; a contour gives as many as it has elements."""

    def __init__(self, start: Floats) -> None:
        self.ends: list[Floats] = [start[None]]
        self.centres: list[Floats] = []
        self.sweeps: list[Floats] = []
        self.kinds: list[np.ndarray] = []
        self.feeds: list[Floats] = []
        self.marks: list[np.ndarray] = []
        self.labels: dict[str, int] = {"": 0}

    @property
    def here(self) -> Floats:
        return self.ends[-1][-1]

    def add(
        self, ends: Floats, label: str, feed: float, sweeps: Floats | None = None, at: Floats | None = None
    ) -> None:
        n = len(ends)
        sweeps = np.zeros(n) if sweeps is None else sweeps
        centres = np.full((n, 3), np.nan)
        if at is not None:
            centres[:, :2] = at
            centres[:, 2] = np.vstack([self.here, ends[:-1]])[:, 2]
        centres[sweeps == 0] = np.nan
        straight = Kind.RAPID if np.isinf(feed) else Kind.LINE
        self.ends.append(ends)
        self.centres.append(centres)
        self.sweeps.append(sweeps)
        self.kinds.append(np.where(sweeps != 0, np.uint8(Kind.ARC), np.uint8(straight)))
        self.feeds.append(np.full(n, feed))
        self.marks.append(np.full(n, self.labels.setdefault(label, len(self.labels)), np.int16))

    def to(self, spot: Floats, height: float, label: str, feed: float) -> None:
        """A straight move to a place in the plane and a height, if there is any."""
        goal = np.append(spot, height)
        if np.abs(goal - self.here).max() > SAME:
            self.add(goal[None], label, feed)

    def along(self, contour: Contour, heights: Floats, label: str, feed: float) -> None:
        """A contour from where the tool stands; heights `(m,)` of the ends of its m elements."""
        some = (contour.lengths > SAME) | (np.abs(np.diff(np.append(self.here[2], heights))) > SAME)
        if some.any():
            ends = np.column_stack([contour.ends, heights])[some]
            self.add(ends, label, feed, contour.sweeps[some], contour.centres[some])

    def path(self, radius: float) -> Toolpath:
        columns: dict[str, Any] = {
            "kind": np.concatenate(self.kinds),
            "centre": np.vstack(self.centres),
            "sweep": np.concatenate(self.sweeps),
            "feed": np.concatenate(self.feeds),
            "label": np.concatenate(self.marks),
            "radius": np.broadcast_to(radius, (sum(map(len, self.kinds)),)),
        }
        return Toolpath.chain(np.vstack(self.ends), columns, labels=tuple(self.labels))


def toolpath(
    clearing: Clearing, levels: Sequence[float] = (-1.0,), *, surface: float = 0.0, clearance: float = 2.0,
    entry: Entry = VERTICAL, feed: float = 500.0, plunge_feed: float = 150.0, climb: bool = True,
) -> Toolpath:  # fmt: skip
    """Every pass on every level, from `surface` down: lifts go to `clearance` above the surface, rapid.

    The tool goes down by `entry` wherever it may not come straight from the pass before.
    """
    pieces = [piece for piece in clearing.pieces if piece.passes or piece.place is not None]
    if not pieces or not levels:
        raise ValueError("there is nothing to clear")
    above = surface + clearance
    rows = _Rows(np.array([*pieces[0].entry, above]))
    top = surface
    for level in levels:
        for piece in pieces:
            _piece(rows, piece, clearing.radius, (above, top, level), entry, (feed, plunge_feed), climb)
        top = level
    return rows.path(clearing.radius)


def _piece(
    rows: _Rows, piece: Piece, radius: float, heights: tuple[float, float, float], entry: Entry,
    feeds: tuple[float, float], climb: bool,
) -> None:  # fmt: skip
    above, top, level = heights
    feed, plunge = feeds
    for k in range(max(1, len(piece.passes))):
        if k and piece.linked[k - 1]:
            rows.to(begin(piece.passes[k]), level, "link", feed)
        else:
            down = descent(piece, entry, radius, top, level, climb, k)
            rows.to(rows.here[:2], above, "lift", np.inf)
            rows.to(begin(down.contour), above, "to the entry", np.inf)
            rows.to(begin(down.contour), top, down.label, plunge)
            rows.along(down.contour, down.heights[1:], down.label, plunge)
            if piece.passes:
                rows.to(begin(piece.passes[k]), level, "link", feed)
        if piece.passes:
            contour = piece.passes[k]
            rows.along(contour, np.full(len(contour.starts), level), piece.labels[k], feed)
    rows.to(rows.here[:2], above, "lift", np.inf)

"""Where a tool cuts tilted: strokes from the tip along the tool, a few on a path."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from mnclab.path.toolpath import Array, Kind, Toolpath
from mnclab.show.plot import colours
from mnclab.show.plot.overlay import grown, line
from mnclab.show.plot.picture import View
from mnclab.show.solids import strokes

MOST = 24  # strokes of a path
CHORD = 0.01  # mm
LONG = 0.16  # of the greatest side of what is cut
UPRIGHT = 1e-9  # of a direction: what it has across Z


class TiltedTool(NamedTuple):
    """Tips and where the strokes end (k, 3), mm."""

    tips: Array
    ends: Array

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        return grown(low, high, self.ends)

    def names(self, views: Sequence[View]) -> list[str]:
        return [colours.TILTED.name]

    def draw(self, ax: Axes, view: View) -> list[Any]:
        gaps = np.full_like(self.tips, np.nan)
        strokes = np.stack([self.tips, self.ends, gaps], axis=1).reshape(-1, 3)
        return [line(ax, view, strokes, colours.TILTED)]

    def write(self, ax: Axes, view: View, lines: Sequence[Array]) -> None:
        """Nothing: the legend says it."""


def tilts(path: Toolpath) -> bool:
    """Whether the tool stands tilted on the part anywhere."""
    return path.kinematics is not None and bool((np.abs(path.directions[:, :2]) > UPRIGHT).any())


def tilted_tool_of(path: Toolpath) -> TiltedTool | None:
    """Strokes where a path cuts with a tilted tool, spread evenly over its way; None if it never does."""
    if not tilts(path):
        return None
    cuts = np.isin(path.kind, (Kind.LINE, Kind.ARC, Kind.PROBE))
    tilted = cuts & (np.abs(path.directions[:, :2]).max(axis=1) > UPRIGHT)
    if not tilted.any():
        return None
    pieces, row = strokes(path, CHORD)
    size = float(np.ptp(pieces[cuts[row]].reshape(-1, 3), axis=0).max())
    pieces, row = pieces[tilted[row]], row[tilted[row]]
    way = np.append(0.0, np.cumsum(np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1)))
    at = np.linspace(0, way[-1], MOST + 1)[1:] if way[-1] > 0 else way[-1:]
    some = np.clip(np.searchsorted(way, at) - 1, 0, len(row) - 1)
    share = np.divide(at - way[some], np.diff(way)[some], out=np.ones(len(at)), where=np.diff(way)[some] > 0)[:, None]
    tips = pieces[some, 0] + share * (pieces[some, 1] - pieces[some, 0])
    return TiltedTool(tips, tips + LONG * size * path.directions[row[some]])

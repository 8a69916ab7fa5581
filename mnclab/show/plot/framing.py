"""What a picture of a tool path shows of it: the box, the views that it needs, and how it is told in words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mnclab.path.toolpath import Kind, Toolpath
from mnclab.show.plot import colours
from mnclab.show.plot.colours import Line
from mnclab.show.plot.picture import VIEWS, Foot, View
from mnclab.show.plot.strokes import Array, corners
from mnclab.text.alarm import Alarm, several
from mnclab.text.given import choice

MOSTLY = 0.9  # the cosine between two directions from which on they are taken for the same
FAR = 5  # a box of all moves this many times that of the cuts is not shown whole


def box_of(path: Toolpath, pieces: Sequence[tuple[Line, Array]], frame: str) -> tuple[Array, Array, bool]:
    """The corners (3,) of the box that is shown, and whether rapids go beyond it; a lathe's holds the centre line."""
    frame = choice(frame, "frame", ("auto", "all", "cuts"))
    cuts = corners([points for line, points in pieces if line is not colours.RAPID], path.lathe)
    rest = [points for line, points in pieces if line is colours.RAPID] + [path.start[:1], path.end[-1:]]
    everything = corners([*rest, np.array(cuts).reshape(-1, 3)] if cuts else rest, path.lathe)
    if everything is None:
        return np.zeros(3), np.zeros(3), False
    if cuts is None or frame == "all":
        return *everything, False
    spans = [float((high - low).max()) for low, high in (everything, cuts)]
    if frame == "cuts" or spans[0] > FAR * spans[1] > 0:
        return *cuts, spans[0] > spans[1]
    return *everything, False


def foot_of(stop: Alarm | None, beyond: bool) -> Foot | None:
    """What is written below: the alarm that stopped the program, or that rapids are cut off."""
    if stop:
        return Foot.of(stop)
    return Foot('rapids from far away are cut off; frame="all" shows them') if beyond else None


def views_of(view: str, path: Toolpath, low: Array, high: Array, single: bool) -> list[View]:
    """The views of a picture, a `single` one at most, that count in the unit of the path."""
    view = choice(view, "view", ("auto", *VIEWS))
    names = [view] if view != "auto" else ["ZX"] if path.lathe else _needed(path, high - low)
    return [VIEWS[name]._replace(unit=path.unit) for name in names[: 1 if single else None]]


def _needed(path: Toolpath, span: Array) -> list[str]:
    """The views of a mill's path: along the tool, from the side, and on each plane that has arcs."""
    cuts = np.flatnonzero((path.kind == Kind.LINE) | (path.kind == Kind.ARC))
    arcs = cuts[path.kind[cuts] == Kind.ARC]
    on_x, on_y = (bool((np.abs(path.axis[arcs][:, k]) > MOSTLY).any()) for k in (0, 1))
    if len(cuts) and abs(path.axis[cuts[0], 2]) < 1 - MOSTLY:
        for k, names in ((0, ["YZ", "XZ"]), (1, ["XZ", "XY"])):
            if (np.abs(path.axis[cuts][:, k]) > MOSTLY).all():
                return names if span[k] > 0 else names[:1]
    if not span[2] > 0:
        return ["XY"]
    if on_x != on_y:
        return ["XY", "YZ" if on_x else "XZ"]
    return ["XY", "XZ", "YZ"] if on_x else ["XY", "YZ" if span[0] == 0 and span[1] > 0 else "XZ"]


def in_words(path: Toolpath, low: Array, high: Array, stop: Alarm | None) -> str:
    """What a person who cannot see the picture is told."""
    moves, factors = int(path.is_motion.sum()), (2 if path.lathe else 1, 1, 1)
    said = several(moves, "move") if moves else "no moves"
    ends = zip("XYZ", factors, low / path.unit.length, high / path.unit.length)
    ranges = [f"{axis} {f * a:.4g} to {f * b:.4g}" for axis, f, a, b in ends if b > a]
    said += f", {', '.join(ranges)} {path.unit.short}" if ranges and moves else ""
    return f"tool path: {said}{f'; stopped in line {stop.span.line}' if stop and stop.span else ''}"

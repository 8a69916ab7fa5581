"""Zero points that a program selects and poles that it names, as small crosses with their names.

The places come out of the history of a run: its frames are put together again step by step.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.text import Annotation, Text

from mnclab.geometry import frames
from mnclab.geometry.frames import FrameChain
from mnclab.show.chains import ORIGINS, replayed
from mnclab.show.plot import colours
from mnclab.show.plot.colours import Mark
from mnclab.show.plot.picture import SMALL, View, figure_of
from mnclab.show.plot.strokes import Array

SHIFTS = ("local", "set", "shift")
NEAR = 1.5  # places that would make the box longer than this many times are not shown
MANY = 8  # places beyond which only zero points have names
LOOKED_AT = 20_000  # strokes that a name avoids
OFF = (8.0, 13.0, 20.0)  # points from a cross to its name, tried one after the other
BESIDE = 1.0  # points from a name to the middle of a line: half of its width
SIDES = ((1, 1), (-1, 1), (1, -1), (-1, -1), (1, 0), (-1, 0), (0, 1), (0, -1), (0.1, 1), (-0.1, 1), (0.1, -1), (-0.1, -1))
SPOTS = [(side, off * np.array(side) * (0.8 if all(side) else 1.0)) for off, side in product(OFF, SIDES)]  # points


class DatumCross(NamedTuple):
    """A cross with a name at a point (3,), mm relative to the path's origin; nan where the height is not known."""

    mark: Mark
    name: str
    xyz: tuple[float, float, float]


def places_of(run: Any) -> list[DatumCross]:
    """The zero points and poles of a run, in the order of the program; what lies at one place shares a cross.

    A zero point that a cycle shifts has a second one, which says from which line on it counts.
    """
    history, path = run.history, run.toolpath
    found: dict[tuple[Mark, tuple[float | None, ...]], list[str]] = {}
    apart, seen = "set" in run.frames.slots, dict[str, tuple[float | None, ...]]()

    def add(mark: Mark, name: str, xyz: Array, step: int) -> None:
        # nan is no key: it equals nothing
        place = tuple(None if np.isnan(v) else round(v, 6) + 0.0 for v in xyz.tolist())
        if mark is colours.DATUM and seen.setdefault(name, place) != place:
            if any(each.startswith(f"{name}, line") or each == name for each in found.get((mark, place), [])):
                return
            name = f"{name}, line {run.at(step=step).line}"
        names = found.setdefault((mark, place), [])
        if name not in names:
            names.append(name)

    for step, set_here, poles, chain in replayed(run, "pole"):
        for _, value in poles:
            plane = history.value("pole plane", step)
            if value is not None and (pole := _pole(path, chain, step, value, plane)) is not None:
                add(colours.POLE, "pole", pole, step)
        selected = [frame for frame in set_here if frame in ORIGINS and not (frame not in chain and frame in SHIFTS)]
        for frame in selected:
            inner = "local" if frame == "set" else frame  # G52 counts inside G92, which may end a part of it
            said = "G52" if frame == "local" and apart else ORIGINS[frame] or _code(history, step)
            if frame != "local" or "set" not in selected:
                add(colours.DATUM, said, (chain.before(inner) @ chain[inner])[:3, 3] - path.origin, step)
    return [
        DatumCross(mark, ", ".join(names), tuple(np.nan if v is None else v for v in place))  # type: ignore[arg-type]
        for (mark, place), names in found.items()
    ]


def _code(history: Any, step: int) -> str:
    """How the program called a work offset: its code, and its row where the code does not say which."""
    code, row = str(history.value("datum", step)), history.value("datum row", step)
    return f"{code} Q{row}" if row is not None and code in ("G147", "G247") else code


def _pole(path: Any, chain: FrameChain, step: int, pole: tuple[float, float], plane: str | None) -> Array | None:
    """A pole in its plane, else in that of the next move, nan along the normal; None if no move follows."""
    row = int(np.searchsorted(path.step, step))
    if row >= len(path):
        return None
    if plane is not None:
        first, second = ("XYZ".index(axis) for axis in plane)
        normal = 3 - first - second
    else:
        normal = int(np.argmax(np.abs(path.axis[row])))
        upright = np.linalg.solve(chain.matrix[:3, :3], path.axis[row])[normal] > 0  # else the axes are named in turn: XZ
        first, second = ((normal + 1) % 3, (normal + 2) % 3)[:: 1 if upright else -1]
    point = np.zeros(3)
    point[[first, second]] = pole
    point = frames.apply(chain.matrix, point) - path.origin
    point[normal] = np.nan
    return point


def near(places: Sequence[DatumCross], low: Array, high: Array) -> list[DatumCross]:
    """Those places that are seen without the box `low` to `high` (3,), mm becoming much larger."""
    size = high - low
    spans = [np.fmax(high, place.xyz) - np.fmin(low, place.xyz) for place in places]
    return [p for p, span in zip(places, spans) if span.max() <= NEAR * size.max() or (span == size).all()]


def crosses(places: Sequence[DatumCross], view: View) -> list[Line2D]:
    """The crosses of one view, one line for each kind of place."""
    found = []
    for mark in (colours.DATUM, colours.POLE):
        xyz = np.array([place.xyz for place in places if place.mark is mark]).reshape(-1, 3)[:, [view.right, view.up]]
        xyz = xyz[np.isfinite(xyz).all(axis=1)]
        if len(xyz):
            label = mark.name if mark is colours.POLE and len(places) > MANY else f"_{mark.name}"
            found.append(Line2D(xyz[:, 0], xyz[:, 1], **{**mark.style(), "label": label}))
    return found


# --- names -----------------------------------------------------------------------------------------------------------


def write_names(ax: Axes, view: View, places: Sequence[DatumCross], occupied: Array, drawn: Sequence[Array]) -> None:
    """The names of the places in a view, where they cover no mark (`occupied` (n, 2), mm) and least of the lines.

    The limits of the axes must be final. A name without a free place is left out. Texts that stand there are not covered.
    """
    spots = [(p, np.array(p.xyz)[[view.right, view.up]]) for p in places if len(places) <= MANY or p.mark is colours.DATUM]
    spots = [(p, at) for p, at in spots if np.isfinite(at).all()]
    if not spots:
        return
    unit = figure_of(ax).dpi / 72
    begin, end = segments(ax, view, drawn)
    crowd = ax.transData.transform(np.concatenate([occupied, [at for _, at in spots]]))
    marks = crowd[len(occupied) :]
    taken = [*np.hstack([crowd - 6 * unit, crowd + 6 * unit]), *map(_extent, ax.texts)]
    inner = np.array(ax.bbox.extents) + np.array([2, 2, -2, -2]) * unit
    for k, (place, at) in enumerate(spots):
        text = ax.annotate(
            place.name, (float(at[0]), float(at[1])), (0, 0), textcoords="offset points", fontsize=SMALL,
            color=place.mark.colour, zorder=4.5,
            parse_math=False, bbox={"boxstyle": "square,pad=0.1", "fc": colours.PAPER, "ec": "none", "alpha": 0.75},
        )  # fmt: skip
        best, size = None, np.ptp(_extent(text).reshape(2, 2), axis=0)  # asked once: a text is slow to measure
        for side, away in SPOTS:
            low = marks[k] + away * unit - size * (1 - np.sign(side)) / 2
            box = np.concatenate([low, low + size])
            if (box[:2] < inner[:2]).any() or (box[2:] > inner[2:]).any() or any(_overlap(box, t) for t in taken):
                continue
            gap = np.linalg.norm(marks - np.clip(marks, box[:2], box[2:]), axis=1)
            if (gap[np.linalg.norm(marks - marks[k], axis=1) > 6 * unit] <= gap[k]).any():
                continue  # it would be read as the name of another one
            covered = crossing(box + BESIDE * unit * np.array([-1, -1, 1, 1]), begin, end)
            if best is None or covered < best[0]:
                best = covered, side, away, box
        if best is None:
            text.remove()
            continue
        _put(text, best[1], best[2])
        taken.append(best[3])


def _extent(text: Text) -> Array:
    """The box of a text (left, bottom, right, top) in pixels."""
    return np.asarray(text.get_window_extent().extents)


def _put(text: Annotation, side: tuple[float, float], away: Array) -> None:
    right, up = side
    text.set_horizontalalignment("left" if right > 0 else "right" if right else "center")
    text.set_verticalalignment("bottom" if up > 0 else "top" if up else "center")
    text.set_position(tuple(away))


def _overlap(one: Array, other: Array) -> bool:
    return bool((one[:2] < other[2:]).all() and (other[:2] < one[2:]).all())


def segments(ax: Axes, view: View, drawn: Sequence[Array]) -> tuple[Array, Array]:
    """Begin and end (n, 2) of the drawn strokes in pixels; none if they are too many to look at."""
    if not drawn or sum(map(len, drawn)) > LOOKED_AT:
        return np.empty((0, 2)), np.empty((0, 2))
    lines = [ax.transData.transform(xyz[:, [view.right, view.up]]) for xyz in drawn]
    begin, end = np.concatenate([line[:-1] for line in lines]), np.concatenate([line[1:] for line in lines])
    seen = np.isfinite(begin).all(axis=1) & np.isfinite(end).all(axis=1)
    return begin[seen], end[seen]


def crossing(box: Array, begin: Array, end: Array) -> int:
    """How many strokes run through a box (left, bottom, right, top)."""
    beside = (np.minimum(begin, end) > box[2:]) | (np.maximum(begin, end) < box[:2])
    near = ~(beside[:, 0] | beside[:, 1])
    begin, end = begin[near], end[near]
    way = end - begin
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (box[:2] - begin) / way, (box[2:] - begin) / way
    outside = ((way == 0) & ((begin < box[:2]) | (begin > box[2:]))).any(axis=1)
    enter = np.fmax.reduce(np.where(way == 0, 0.0, np.fmin(one, other)), axis=1)
    leave = np.fmin.reduce(np.where(way == 0, 1.0, np.fmax(one, other)), axis=1)
    return int(((np.fmax(enter, 0) <= np.fmin(leave, 1)) & ~outside).sum())

"""What a probe meets, behind a path: the part as a section at the height of the touches, and the touches with their numbers."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from mnclab.geometry.frames import shift
from mnclab.path.columns import Array
from mnclab.path.kinds import Kind
from mnclab.show.plot import colours
from mnclab.show.plot.material import draw_material, part_of
from mnclab.show.plot.picture import View
from mnclab.show.plot.placing import write_beside
from mnclab.workpiece.part import Part

MOST = 60  # touches that have a number in a view
FAR = 4.0  # times as large as the path a part may be to be shown whole
UNDER = 0.1  # mm below its highest place is a part cut that nothing has touched
SAME = 6  # decimals of mm: touches that are one in a view


class Felt(NamedTuple):
    """The part (None: not known), where its zero point lies in coordinates of the path, and of each touch the place (n, 3),
    in them too, and what is written there: with its value, or the number alone."""

    part: Part | None
    origin: Array
    places: Array
    texts: list[tuple[str, str]]

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        """A box (3,), (3,) around the path, widened by the touches, and by the part unless it is much larger."""
        for corner in self.places:
            low, high = np.fmin(low, corner), np.fmax(high, corner)
        if self.part is None or not np.isfinite(self.part.bounds).all():
            return low, high
        ends = self.part.bounds - self.origin
        if (ends[1] - ends[0]).max() > FAR * max(float((high - low).max()), 1e-9):
            return low, high
        return np.fmin(low, ends[0]), np.fmax(high, ends[1])

    def level(self, view: View) -> float:
        """Where the section lies along the line of sight."""
        axis = 3 - view.right - view.up
        if len(self.places):
            found = float(np.median(self.places[:, axis]))
            return found - UNDER if axis == 2 else found
        ends = np.zeros((2, 3)) if self.part is None else self.part.bounds - self.origin
        low, high = ends[:, axis].tolist()
        if axis == 2:
            return high - UNDER if math.isfinite(high) else 0.0
        return (low + high) / 2 if math.isfinite(high - low) else 0.0


def felt(run: Any) -> Felt | None:
    """What the probe of a run meets, or the tool setter where tools are measured; None where nothing is to be touched."""
    part = part_of(run) if isinstance(run.setup.part, Part) else None
    if run.setup.part is None:
        part = run.setup.setter and (run.toolpath.kind == Kind.PROBE).any() and run.setup.setter.part
        if not part:
            return None
    origin = np.array(run.toolpath.origin, dtype=float)
    places = np.array([touch.surface for touch in run.touches], dtype=float).reshape(-1, 3) - origin
    return Felt(part, origin, places, _texts(run))


def _texts(run: Any) -> list[tuple[str, str]]:
    found = []
    for k, touch in enumerate(run.touches, 1):
        way = np.abs(np.array(touch.found) - touch.programmed)
        axis = int(way.argmax())
        value = f"{'XYZ'[axis]} {touch.found[axis]:z.3f}".replace("-", "\N{MINUS SIGN}")
        found.append((f"{k}   {value}", str(k)) if way[axis] > 0.999 * np.linalg.norm(way) else (str(k), str(k)))
    return found


def draw_felt(ax: Axes, view: View, found: Felt, lines: list[Array], marks: list[Array]) -> None:
    """The section of the part, and the numbers of the touches where there is room; `lines` and `marks` (n, 3) of the path."""
    axes = [view.right, view.up]
    if found.part is not None and not view.diameter:
        draw_material(ax, found.part, view, shift(*found.origin), found.level(view))
    if not len(found.places):
        return
    spots, texts = found.places[:, axes], dict[tuple[float, float], tuple[str, str]]()
    for (x, y), text in zip(spots.round(SAME).tolist(), found.texts):  # the first of those that are one in this view
        flat = view.up == 2 and "Z" not in text[0]  # its value stands in the view from above
        texts.setdefault((x, y), (text[1], text[1]) if flat else text)
    if len(texts) <= MOST:
        none, beside = np.zeros((len(texts), 2)), [line[:, axes] for line in lines]
        others = np.vstack([each[:, axes] for each in marks])
        write_beside(ax, [*texts.values()], np.array([*texts]), [0.0] * len(texts), none, beside, colours.TOUCH.colour, others)

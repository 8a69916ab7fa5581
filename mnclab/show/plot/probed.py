"""What a probe meets, behind a path: the part as a section at the height of the touches, and the touches with their numbers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from mnclab.geometry.contours import Contour
from mnclab.geometry.frames import Matrix, apply, inverse, shift, turn
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import scan
from mnclab.path.toolpath import Array
from mnclab.show import looks, probed
from mnclab.show.plot import colours
from mnclab.show.plot.picture import View
from mnclab.show.plot.placing import write_beside
from mnclab.show.plot.sections import outline_of
from mnclab.show.probed import Felt, Sections
from mnclab.workpiece.part import Part
from mnclab.workpiece.part.pictures import UPRIGHT
from mnclab.workpiece.part.prisms import Prism, Prisms

BEAM = colours.LineStyle(probed.BEAM, looks.BEAM, (0, (6, 1.5, 1.5, 1.5)), 1.6, 2.4)
MOST = 60  # touches that have a number in a view
SAME = 6  # decimals of mm: touches that are one in a view


def names_of(found: Felt) -> list[Any]:
    """What a legend says of it: the part or the plate, and the beam."""
    bodies: list[Any] = [Patch(**FACE, label=found.name)] if found.part is not None else []
    return bodies + ([Line2D([], [], **BEAM.style())] if found.beam is not None else [])


def draw_felt(ax: Axes, view: View, found: Felt, lines: list[Array], marks: list[Array]) -> None:
    """The section of the part, and the numbers of the touches where there is room; `lines` and `marks` (n, 3) of the path."""
    axes = [view.right, view.up]
    if found.part is not None and not view.diameter:
        draw_material(ax, found.part, view, shift(*found.origin), found.level(3 - view.right - view.up))
    if found.beam is not None:
        x, y = found.beam[:, axes].T
        end = {"marker": "o", "markersize": 4, "markevery": [0]} if np.ptp([x, y], axis=1).max() < 1e-6 else {}  # seen along it
        ax.add_line(Line2D(x, y, **BEAM.style() | end))
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


# The part as a section behind a picture: pale, so that what is measured stays what one looks at.

CELLS = 160  # along the longer side of a section
FACE: dict[str, Any] = {"facecolor": "#e9e5da", "edgecolor": "#8c8778", "linewidth": 0.7}


def draw_material(ax: Axes, part: Part, view: View, frame: Array, level: float) -> None:
    """What the plane of a view cuts of a part, within the limits of the axes: exact of upright prisms.

    What a program has cut is shown from above only. The view lies in coordinates that a `frame` (4, 4) leads to those of the
    part, at a `level` mm along the line of sight.
    """
    if isinstance(part.distance, Sections):
        if (view.right, view.up) == (0, 1) and np.abs(frame[2] - (0, 0, 1, frame[2, 3])).max() < UPRIGHT:
            cut = part.section(level + float(frame[2, 3]))
            _draw_loops(ax, [loop.transformed(inverse(frame)) for loop in cut])
        return
    if view.right < 2 and _upright(part, frame):
        here = part.placed(inverse(frame))
        if view.up == 2:
            _draw_side(ax, here, view, level)
        else:
            _draw_loops(ax, here.section(level))
        return
    (left, right), (below, above) = ax.get_xlim(), ax.get_ylim()
    step = max(right - left, above - below) / CELLS
    across, up = (np.linspace(a, b, max(2, round((b - a) / step) + 1)) for a, b in ((left, right), (below, above)))
    places = np.full((len(up), len(across), 3), float(level))
    places[..., view.right], places[..., view.up] = across, up[:, None]
    off = part(apply(frame, places).reshape(-1, 3)).reshape(places.shape[:2])
    if not (off < 0).any():
        return
    ax.contourf(across, up, off, [-np.inf, 0.0], colors=[FACE["facecolor"]], zorder=0.6)
    if (off > 0).any():
        ax.contour(across, up, off, [0.0], colors=[FACE["edgecolor"]], linewidths=FACE["linewidth"], zorder=0.7)


def _draw_loops(ax: Axes, loops: Sequence[Contour]) -> None:
    """Closed contours from above."""
    if not loops:
        return
    look: dict[str, Any] = {"facecolor": "none", "edgecolor": "none", "linewidth": FACE["linewidth"]}
    for name, order in (("facecolor", 0.6), ("edgecolor", 0.7)):
        ax.add_collection(PathCollection([outline_of(loops)], **look | {name: FACE[name]}, zorder=order), autolim=False)


def _draw_side(ax: Axes, part: Part, view: View, level: float) -> None:
    """Upright prisms from the side: of each slab the stretches that it has there, and lines where neighbours differ."""
    body = part.distance
    assert isinstance(body, Prisms)
    sight = body.placing if view.right == 0 else turn(-np.pi / 2) @ body.placing  # the line of sight is y, or -y
    rows = [_stretches(slab.region, sight, level if view.right == 0 else -level) for slab in body.slabs]
    heights = np.array([(slab.low, slab.high) for slab in body.slabs]) + body.placing[2, 3]
    heights = heights.clip(*sorted(ax.get_ylim()))
    faces, lines = [], []
    for row, (low, high) in zip(rows, heights):
        for left, right in row:
            faces.append([(left, low), (right, low), (right, high), (left, high)])
            lines += [[(x, low), (x, high)] for x in (left, right)]
    for below, above, (_, z) in zip(rows, rows[1:], heights):
        places = np.unique(np.concatenate([below.ravel(), above.ravel()]))
        lines += [
            [(left, z), (right, z)]
            for left, right in zip(places, places[1:])
            if _holds(below, (left + right) / 2) != _holds(above, (left + right) / 2)
        ]
    ax.add_collection(PolyCollection(faces, facecolor=FACE["facecolor"], edgecolor="none", zorder=0.6), autolim=False)
    look = {"color": FACE["edgecolor"], "linewidth": FACE["linewidth"], "zorder": 0.7}
    ax.add_collection(LineCollection(lines, **look), autolim=False)


def _stretches(region: Region, frame: Matrix, y: float) -> Array:
    """From where to where (k, 2) a region under a frame has material along a line."""
    return scan(Prism(region, 0, 0).moved(frame).region, np.array([y]))[0] if region.loops else np.zeros((0, 2))


def _holds(stretches: Array, x: float) -> bool:
    return bool(((stretches[:, 0] < x) & (x < stretches[:, 1])).any())


def _upright(part: Part, frame: Array) -> bool:
    """Whether a part is of prisms that stand along Z of a frame which turns and shifts, so that its sections are known."""
    body = part.distance
    if not isinstance(body, Prisms) or body.taper:
        return False
    turn, along = frame[:3, :3], (inverse(frame) @ body.placing)[2, 2]
    rigid = np.allclose(turn.T @ turn, np.eye(3), rtol=0, atol=UPRIGHT) and np.linalg.det(turn) > 0
    return bool(rigid and abs(along - 1) < UPRIGHT)

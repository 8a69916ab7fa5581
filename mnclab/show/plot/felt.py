"""What a probe meets, behind a path: the part as a section at the height of the touches, and the touches with their numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from mnclab.geometry.frames import shift
from mnclab.path.toolpath import Array
from mnclab.show import felt
from mnclab.show.felt import Felt
from mnclab.show.plot import colours
from mnclab.show.plot.material import FACE, draw_material
from mnclab.show.plot.picture import View
from mnclab.show.plot.placing import write_beside

BEAM = colours.Line(felt.BEAM, "#2e7d32", (0, (6, 1.5, 1.5, 1.5)), 1.6, 2.4)
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

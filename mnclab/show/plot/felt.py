"""What a probe meets, behind a path: the part as a section at the height of the touches, and the touches with their numbers."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from mnclab.geometry.frames import shift
from mnclab.path.columns import Array
from mnclab.show.felt import Felt
from mnclab.show.plot import colours
from mnclab.show.plot.material import draw_material
from mnclab.show.plot.picture import View
from mnclab.show.plot.placing import write_beside

MOST = 60  # touches that have a number in a view
SAME = 6  # decimals of mm: touches that are one in a view


def draw_felt(ax: Axes, view: View, found: Felt, lines: list[Array], marks: list[Array]) -> None:
    """The section of the part, and the numbers of the touches where there is room; `lines` and `marks` (n, 3) of the path."""
    axes = [view.right, view.up]
    if found.part is not None and not view.diameter:
        draw_material(ax, found.part, view, shift(*found.origin), found.level(3 - view.right - view.up))
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

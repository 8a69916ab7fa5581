"""Two paths in one picture, the second over the first, and where they are farthest apart."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.lines import Line2D

from mnclab.path.toolpath import Kind
from mnclab.show.plot.colours import RAPID, Line, Mark
from mnclab.show.plot.picture import SIZE, VIEWS, Foot, Picture, arrange, write_legend
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strokes import corners, line_of
from mnclab.text.given import choice

FIRST = Line("first", "#8c8c8c", "-", 3.2, 2.2)
SECOND = Line("second", "#1259a8", "-", 1.1, 2.8)
APART = Mark("largest deviation", "#b3261e", "o", 9, False, 4.2)
CUTTING = tuple(kind for kind in Kind if kind != Kind.RAPID)
RAPID_WIDTH = 0.6  # of the width of cuts
SHOWN = 1e-6  # mm: less is called the same


@sized()
def plot_deviation(found: Any, view: str = "auto", size: tuple[float, float] = SIZE) -> Picture:
    """The first path wide and grey, the second thin and blue over it, rapids dashed; a ring and a line where they are farthest
    apart."""
    one, other = found.paths
    lathe = one.lathe or other.lathe
    looks = [look._replace(name=name) for look, name in zip((FIRST, SECOND), found.names)]
    lines = [(look, line_of(path, CUTTING)) for look, path in zip(looks, found.paths)]
    for look, path in zip(looks, found.paths):
        dashed = look._replace(name="_" + look.name, dashes=RAPID.dashes, width=RAPID_WIDTH * look.width)
        lines += [(dashed, line)] if len(line := line_of(path, (Kind.RAPID,))) else []
    lines[2:3] = [(look._replace(name=RAPID.name), line) for look, line in lines[2:3]]
    low, high = corners([xyz for _, xyz in lines], lathe) or (np.zeros(3), np.zeros(3))
    view = choice(view, "view", ("auto", *VIEWS))
    views = [VIEWS["ZX"]] if lathe else [VIEWS["XY"]] if high[2] <= low[2] else [VIEWS["XY"], VIEWS["XZ"]]
    views = views if view == "auto" else [VIEWS[view]]
    where = found.where if found.largest > SHOWN else None
    names = [line.name for line, _ in lines if not line.name.startswith("_")] + ([APART.name] if where else [])
    picture, axes = arrange(views, low, high, names, Foot(found.sentence), f"two paths: {found.sentence}", size)
    artists: list[Line2D] = []
    for ax, each in zip(axes, views):
        drawn = [Line2D(xyz[:, each.right], xyz[:, each.up], **line.style()) for line, xyz in lines]
        if where:
            ends = np.stack(where[:2])[:, [each.right, each.up]]
            drawn.append(Line2D(*ends[:1].T, **APART.style()))
            ax.add_line(Line2D(*ends.T, color=APART.colour, linewidth=1.2, zorder=APART.order))
        for artist in drawn:
            ax.add_line(artist)
        artists = artists or [each for each in drawn if not str(each.get_label()).startswith("_")]
    write_legend(picture, artists)
    return picture

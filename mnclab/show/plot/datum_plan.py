"""Where the parts lie on the machine: machine zero, and from it a vector to every zero point that a program selects.

Numbers at the axes are machine coordinates. Where machine zero is so far away that the picture would be empty, the vectors are
broken: it stands at the border then, and that is said.
"""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch

from mnclab.path.listing import Unit
from mnclab.path.toolpath import Array
from mnclab.show.plot import colours
from mnclab.show.plot.chains import LENGTH, ORIGINS
from mnclab.show.plot.datums import Place, places_of
from mnclab.show.plot.overlay import line, texts
from mnclab.show.plot.picture import SIZE, VIEWS, View, arrange, dress, roomy, write_legend
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strokes import corners, line_of
from mnclab.show.rapids import rapids_of
from mnclab.text.given import choice

FAR = 3.0  # times the size of what lies on the table: a machine zero beyond that is drawn at the border
GAP = 0.35  # of that size: how far from it the border is
ZERO_POINT = colours.DATUM._replace(name="zero point")
ARROW: dict[str, Any] = {"arrowstyle": "-|>", "mutation_scale": 11, "shrinkA": 6, "shrinkB": 6, "linewidth": 1.3}


@sized()
def plot_datums(run: Any, ax: Axes | None = None, *, view: str = "XY", size: tuple[float, float] = SIZE) -> Figure:
    """Machine zero, the zero points of a run and the cuts, in machine coordinates.

    Work offsets and presets are vectors from machine zero, what G92, G52 or a datum shift moves is a vector from the zero
    point before it; each says its name and its coordinates. `view` is "XY", "XZ" or "YZ"; on a lathe "ZX" (diameters).
    """
    path = run.toolpath
    looked = VIEWS["ZX" if path.lathe and view == "XY" else choice(view, "view", VIEWS)]._replace(unit=path.unit)
    origin = np.asarray(path.origin)
    places = [place for place in places_of(run) if place.mark is colours.DATUM and np.isfinite(place.xyz).all()]
    spots = np.array([place.xyz for place in places]).reshape(-1, 3) + origin
    cuts = line_of(path, rapids=rapids_of(run)) + origin
    around = corners([each for each in (cuts, spots) if len(each)], False) or (np.zeros(3), np.ones(3))
    zero, broken = np.zeros(3), False
    axes = [looked.right, looked.up]
    reach, (low, high) = float((around[1] - around[0])[axes].max()), around
    away = np.fmax(np.fmax(low, 0.0) - np.fmin(high, 0.0) - (high - low), 0.0)[axes]
    if away.max() > FAR * max(reach, 1e-6):
        broken = True
        zero = np.clip(zero, low - GAP * reach, high + GAP * reach)
    low, high = np.fmin(low, zero), np.fmax(high, zero)
    said = f"zero points in machine coordinates: {'; '.join(_told(place, spot, path.unit) for place, spot in zip(places, spots))}"
    handles: list[Any] = []
    picture = None
    if ax is None:
        picture, (ax,) = arrange([looked], low, high, ["machine zero", "zero point", "cuts and rapids"], None, said, size)
    else:
        dress(ax, looked)
        wide = roomy(low, high, [looked])
        for limits, k in ((ax.set_xlim, looked.right), (ax.set_ylim, looked.up)):
            limits(wide[0][k], wide[1][k])
        ax.apply_aspect()
    if len(cuts):
        handles.append(line(ax, looked, cuts, colours.PROGRAMMED, label="cuts and rapids"))
    vectors = []
    for place, spot in zip(places, spots):
        begin = _parent(place, places, spots, zero)
        vectors.append(np.array([begin, spot]))
        _vector(ax, looked, begin, spot, broken and begin is zero)
    handles += [line(ax, looked, each, look) for each, look in ((zero[None], colours.MACHINE_ZERO), (spots, ZERO_POINT))]
    names = ["machine zero, not to scale" if broken else "machine zero"]
    middle = (low + high) / 2
    wishes = np.array([(0.7, -0.7), *(_way(spot, middle, looked) for spot in spots)])
    labels = [_told(place, spot, path.unit) for place, spot in zip(places, spots)]
    texts(ax, looked, [*names, *labels], np.vstack([zero[None], spots]), wishes, [cuts, *vectors], mark=7.0)
    if picture is None:
        return cast(Figure, ax.get_figure(root=True))
    write_legend(picture, handles)
    return picture


def _way(spot: Array, middle: Array, view: View) -> tuple[float, float]:
    """Away from the middle of the picture."""
    way = (spot - middle)[[view.right, view.up]]
    size = float(np.hypot(*way))
    return (float(way[0] / size), float(way[1] / size)) if size > 1e-9 else (0.7, 0.7)


def _told(place: Place, spot: Array, unit: Unit) -> str:
    """`G54 X100 Y50 Z20`, in machine coordinates."""
    return f"{place.name}  " + " ".join(f"{axis}{unit.figure(value, 1)}" for axis, value in zip("XYZ", spot))


def _parent(place: Place, places: list[Place], spots: Array, zero: Array) -> Array:
    """From where a zero point is shifted: the work offset before it, machine zero for a work offset itself."""
    shifts = {name for name in ORIGINS.values() if name not in ("", "preset")} | {"G52", LENGTH}
    if set(place.name.split(", ")) <= shifts:
        for k in range(places.index(place) - 1, -1, -1):
            if not set(places[k].name.split(", ")) <= shifts:
                return np.asarray(spots[k])
    return zero


def _vector(ax: Axes, view: View, begin: Array, end: Array, broken: bool) -> None:
    a, b = begin[[view.right, view.up]], end[[view.right, view.up]]
    if np.allclose(a, b):
        return
    ax.add_patch(FancyArrowPatch(tuple(a), tuple(b), color=colours.MACHINE_ZERO.colour, zorder=3.4, **ARROW))
    if broken:  # two strokes across its middle, a gap between them
        way = np.diff(ax.transData.transform([a, b]), axis=0)[0]
        way /= np.hypot(*way)
        look: dict[str, Any] = {"textcoords": "offset points", "xytext": (0, 0), "ha": "center", "va": "center", "zorder": 3.5}
        angle = float(np.degrees(np.arctan2(way[1], way[0])))
        box = {"boxstyle": "square,pad=0.02", "facecolor": colours.PAPER, "edgecolor": "none"}
        middle = a + 0.45 * (b - a)
        ax.annotate("//", tuple(middle), fontsize=9, rotation=angle, color=colours.MACHINE_ZERO.colour, bbox=box, **look)


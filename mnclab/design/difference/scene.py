"""A part in three dimensions in the colours of its deviation: dark what is gone, pale what is right, orange what is left."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from mnclab.design.difference.columns import distances
from mnclab.design.difference.difference import Difference
from mnclab.design.difference.plot import GONE, LEFT, SHADES, limit_of
from mnclab.path.toolpath import Array
from mnclab.show import scene as scenes
from mnclab.show.rulers import frame
from mnclab.show.scene import ANGLE, BALL, EDGE, LOOK, PIN
from mnclab.text.given import fitting
from mnclab.workpiece.workpiece import Solid

if TYPE_CHECKING:
    import pyvista

TITLE = "deviation, mm"


@fitting
def scene(
    difference: Difference, *, limit: float | None = None, axes: bool = True, size: tuple[int, int] = scenes.SIZE
) -> pyvista.Plotter:
    """The part as a body, coloured by how far its surface is off, with pins at the worst gouge and the worst rest.

    `limit`: the ends of the scale, mm; by default as in the picture. `size` in pixels.
    """
    import pyvista

    most = limit_of(difference, limit)
    scenes.check_drawing()
    lathe = difference.workpiece.cutting.lathe
    plotter = scenes.new_plotter(repr(difference).splitlines()[0], size)
    solid = difference.workpiece.solid()
    mesh = pyvista.PolyData.from_regular_faces(solid.points, solid.triangles)
    mesh.cell_data[TITLE] = deviations_of(difference, solid.points[solid.triangles])
    bar = scenes.BAR | {"title": TITLE + "\n", "fmt": "%.3g"}
    plotter.add_mesh(mesh, scalars=TITLE, cmap=SHADES, clim=(-most, most), nan_color="#dddddd", scalar_bar_args=bar, **LOOK)
    edges = mesh.extract_feature_edges(feature_angle=ANGLE, boundary_edges=False, non_manifold_edges=False, manifold_edges=False)
    if edges.n_cells:
        plotter.add_mesh(edges, color=EDGE, line_width=1.3, name="edges of the part")
    _pins(plotter, difference, solid, 0 if lathe else 2)
    towards = (0.35, 1.0, 0.6) if lathe else (-0.5, -1.0, 1.0)
    frame(plotter, solid.points, towards, lathe, unit=difference.workpiece.cutting.path.unit, axes=axes)
    return plotter


def deviations_of(difference: Difference, corners: Array) -> Array:
    """How far the middles of triangles (m, 3, 3) of the part are off its target, mm; nan where that is not judged."""
    if not difference.workpiece.cutting.lathe:
        found = distances(difference.compared, *corners.mean(axis=1).T)
        return np.where(np.abs(found) <= difference.error, 0.0, found)
    target = difference.compared
    radius = np.hypot(corners[..., 0] - difference.workpiece.axis, corners[..., 1])  # corners lie on circles, middles do not
    half = np.stack([corners[..., 2], radius], axis=2).mean(axis=1)
    found = target.surface.distance(half)
    found = np.where((np.abs(found) <= difference.error) | target.toothed(half), 0.0, found)
    behind = difference.workpiece.low < target.ends[0] - difference.error  # the bar goes on in the chuck
    return np.where(half[:, 0] <= target.ends[0] + difference.error if behind else False, np.nan, found)


def _pins(plotter: Any, difference: Difference, solid: Solid, out: int) -> None:
    """Balls at the worst places and pins from them out of the part, each with its value."""
    import pyvista

    side = float(np.ptp(solid.points, axis=0).max())
    for name, worst, shade, sign in (("gouge", difference.worst_gouge, GONE, "-"), ("rest", difference.worst_rest, LEFT, "+")):
        if worst.place is None:
            continue
        place, head = np.array(worst.place), np.array(worst.place)
        head[out] = max(head[out], float(solid.points[:, out].max())) + PIN * side
        plotter.add_mesh(pyvista.Sphere(radius=BALL * side, center=place), color=shade, name=name)
        plotter.add_mesh(pyvista.Line(place, head), color=shade, line_width=3, name=f"pin of the {name}")
        plotter.add_point_labels(
            head[None], [f"{name} {sign}{worst.value:.3f}"], font_size=13, text_color=shade, shape=None, show_points=False,
            always_visible=True, name=f"value of the {name}",
        )  # fmt: skip

"""A part in three dimensions: the body that is left, shaded, with crisp edges; the part that a probe meets.

See `show.scene` for how it shows itself.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from mnclab.path.toolpath import Array, Mask
from mnclab.show import scene as scenes
from mnclab.show.export_mesh import PROBING, RAPID, STOCK
from mnclab.show.probed import felt
from mnclab.show.rulers import frame
from mnclab.text.alarm import Alarm
from mnclab.text.given import choice, fitting, shown
from mnclab.workpiece.collision import Collision
from mnclab.workpiece.workpiece import Solid, Workpiece

if TYPE_CHECKING:
    import pyvista

COLOURS = ("depth", "tool", "line", "none")
DEPTHS = "YlGnBu"  # pale above, dark below, in grey print too
EDGE, ANGLE = "#33312b", 25.0  # degrees between two faces from which their edge is drawn
BALL, PIN = 0.012, 0.1  # where something collides: radius, and how far its pin stands out, of the greatest side of the part
LOOK: dict[str, Any] = {
    "smooth_shading": True, "split_sharp_edges": True, "feature_angle": ANGLE, "ambient": 0.22, "diffuse": 0.82,
    "specular": 0.1, "name": "part",
}  # fmt: skip


@fitting
def scene(
    workpiece: Workpiece,
    colour: str = "depth",
    *,
    collisions: Iterable[Collision] = (),
    axes: bool = True,
    size: tuple[int, int] = scenes.SIZE,
) -> pyvista.Plotter:
    """The part as a body, seen from the front, right and above.

    `colour`: "depth" (mm below the highest place; on a lathe the diameter), the "tool" or the "line" that cut a face, or
    "none"; what nothing cut has the colour of the blank. `collisions` are red balls at their places, with pins that stand out
    of the part. `size` in pixels.
    """
    choice(colour, "colour", COLOURS)
    scenes.check_drawing()
    lathe = workpiece.cutting.lathe
    plotter = scenes.new_plotter(repr(workpiece).splitlines()[0], size)
    solid = workpiece.solid()
    add_part(plotter, workpiece, solid, colour)
    add_collisions(plotter, collisions, solid.points, lathe)
    towards = (0.35, 1.0, 0.6) if lathe else (-0.5, -1.0, 1.0)
    frame(plotter, solid.points, towards, lathe, unit=workpiece.cutting.path.unit, axes=axes)
    return plotter


def add_part(plotter: Any, workpiece: Workpiece, solid: Solid, colour: str) -> None:
    """Add a body and its edges, and the scale of its colours."""
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(solid.points, solid.triangles)
    edges = mesh.extract_feature_edges(feature_angle=ANGLE, boundary_edges=False, non_manifold_edges=False, manifold_edges=False)
    plain = tuple(STOCK)
    if colour == "none" or not (solid.row >= 0).any():
        plotter.add_mesh(mesh, color=plain, **LOOK)
    elif colour == "depth":
        mesh, uncut = _apart(solid)
        title, values = _depths(workpiece, mesh.points)
        mesh.point_data[title] = np.where(uncut, np.nan, values)
        cut = values[~uncut]
        deep = not workpiece.cutting.lathe and cut.size and cut.max() > 0
        bar, limits = scenes.bar_of(title, np.array([0.0, float(cut.max() if deep else values.max())]))
        plotter.add_mesh(mesh, scalars=title, cmap=DEPTHS, clim=limits, nan_color=plain, scalar_bar_args=bar, **LOOK)
    else:
        values = workpiece.cutting.of_rows(getattr(workpiece.cutting.path, colour), solid.row).astype(np.float64)
        mesh.cell_data[colour] = np.where(solid.row >= 0, values, np.nan)
        bar, limits = scenes.bar_of(colour, values[solid.row >= 0], whole=True)
        plotter.add_mesh(mesh, scalars=colour, cmap=scenes.MAP, clim=limits, nan_color=plain, scalar_bar_args=bar, **LOOK)
    if edges.n_cells:
        plotter.add_mesh(edges, color=EDGE, line_width=1.3, name="edges of the part")


def _apart(solid: Solid) -> tuple[Any, Mask]:
    """The mesh of a body where what nothing cut has points of its own, and which points (n,) these are."""
    import pyvista

    doubled = solid.triangles + np.where(solid.row < 0, len(solid.points), 0)[:, None]
    used, index = np.unique(doubled, return_inverse=True)
    points = solid.points[used % len(solid.points)]
    return pyvista.PolyData.from_regular_faces(points, index.reshape(doubled.shape)), used >= len(solid.points)


def _depths(workpiece: Workpiece, points: Array) -> tuple[str, Array]:
    """What "depth" shows, with its unit, and its values (n,)."""
    if workpiece.cutting.lathe:
        return "diameter, mm", 2 * np.hypot(points[:, 0], points[:, 1])
    return "depth, mm", float(workpiece.cutting.stock.bounds[1, 2]) - points[:, 2]


def add_collisions(plotter: Any, collisions: Iterable[Collision], points: Array, lathe: bool) -> None:
    """Red balls where something collides, and pins from them up, on a lathe along X: most are deep in the part."""
    import pyvista

    try:
        places = np.array([each.place for each in collisions], dtype=np.float64).reshape(-1, 3)
    except (TypeError, AttributeError):
        raise Alarm(f"collisions must be those of a run, got {shown(collisions)}", hint="run.collisions()") from None
    if len(places):
        side, out = float(np.ptp(points, axis=0).max()), 0 if lathe else 2
        ball = pyvista.Sphere(radius=BALL * side)
        balls = pyvista.PolyData(places).glyph(geom=ball, scale=False, orient=False)
        plotter.add_mesh(balls, color=RAPID, name="collisions")
        heads = places.copy()
        heads[:, out] = np.maximum(places[:, out], points[:, out].max()) + PIN * side
        pins = pyvista.line_segments_from_points(np.stack([places, heads], axis=1).reshape(-1, 3))
        plotter.add_mesh(pins, color=RAPID, line_width=3, name="pins")


# The part that a probe meets, and its touches: a ball at each touched place with its number.

FACE, PROBED_EDGE, PROBED_ANGLE, BEAM = "#d9d5c8", "#7d7664", 25.0, "#2e7d32"
TOUCH_BALL = 0.011  # radius of a mark, of the greatest side of the scene
MOST, FEW = 60, 8  # touches with numbers, with values too
PROBED_LOOK: dict[str, Any] = {
    "color": FACE, "opacity": 0.6, "ambient": 0.3, "smooth_shading": True, "split_sharp_edges": True,
    "feature_angle": PROBED_ANGLE,
}  # fmt: skip


def add_probed(plotter: Any, run: Any) -> Array | None:
    """Add what the probe of a run meets; the corners (2, 3) of it in the coordinates of the path, None where there is none."""
    import pyvista

    found = felt(run)
    if found is None:
        return None
    ends = found.ends(run.toolpath.bounds if len(run.toolpath) else np.zeros((2, 3)))
    if found.part is not None:
        points, triangles = found.part.surface(within=ends + found.origin)
        if len(triangles):
            mesh = pyvista.PolyData.from_regular_faces(points - found.origin, triangles).clean()
            plotter.add_mesh(mesh, name="part to touch", **PROBED_LOOK)
            edges = mesh.extract_feature_edges(feature_angle=PROBED_ANGLE, boundary_edges=False, non_manifold_edges=False)
            if edges.n_cells:
                plotter.add_mesh(edges, color=PROBED_EDGE, line_width=1.2, name="edges of the part to touch")
    if found.beam is not None:
        plotter.add_mesh(pyvista.Line(*found.beam), color=BEAM, line_width=3, name="beam")
    if len(found.places):
        ball = pyvista.Sphere(radius=TOUCH_BALL * float((ends[1] - ends[0]).max()))
        balls = pyvista.PolyData(found.places).glyph(geom=ball, scale=False, orient=False)
        plotter.add_mesh(balls, color=PROBING, name="touches")
    if 0 < len(found.places) <= MOST:
        plotter.add_point_labels(
            found.places, [text[len(found.texts) > FEW] for text in found.texts], font_size=12, text_color="#4a148c",
            shape_opacity=0.75, shape_color="white", show_points=False, always_visible=True, name="numbers of the touches",
        )  # fmt: skip
    return ends

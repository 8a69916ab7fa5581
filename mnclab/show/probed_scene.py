"""The part that a probe meets in three dimensions, and its touches: a ball at each touched place with its number."""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.path.toolpath import Array
from mnclab.show.export_mesh import PROBING
from mnclab.show.felt import felt

FACE, EDGE, ANGLE, BEAM = "#d9d5c8", "#7d7664", 25.0, "#2e7d32"
BALL = 0.011  # radius of a mark, of the greatest side of the scene
MOST, FEW = 60, 8  # touches with numbers, with values too
LOOK: dict[str, Any] = {
    "color": FACE, "opacity": 0.6, "ambient": 0.3, "smooth_shading": True, "split_sharp_edges": True, "feature_angle": ANGLE,
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
            plotter.add_mesh(mesh, name="part to touch", **LOOK)
            edges = mesh.extract_feature_edges(feature_angle=ANGLE, boundary_edges=False, non_manifold_edges=False)
            if edges.n_cells:
                plotter.add_mesh(edges, color=EDGE, line_width=1.2, name="edges of the part to touch")
    if found.beam is not None:
        plotter.add_mesh(pyvista.Line(*found.beam), color=BEAM, line_width=3, name="beam")
    if len(found.places):
        ball = pyvista.Sphere(radius=BALL * float((ends[1] - ends[0]).max()))
        balls = pyvista.PolyData(found.places).glyph(geom=ball, scale=False, orient=False)
        plotter.add_mesh(balls, color=PROBING, name="touches")
    if 0 < len(found.places) <= MOST:
        plotter.add_point_labels(
            found.places, [text[len(found.texts) > FEW] for text in found.texts], font_size=12, text_color="#4a148c",
            shape_opacity=0.75, shape_color="white", show_points=False, always_visible=True, name="numbers of the touches",
        )  # fmt: skip
    return ends

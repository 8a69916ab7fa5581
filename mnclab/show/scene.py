"""A run in three dimensions: path, tool, blank or part in a pyvista `Plotter`; pyvista is known here, in `part_scene` and
in `probed_scene`.

The scene shows itself in Jupyter as a still picture, which works everywhere and needs no server. `scene.show()` does
the same; `scene.show(jupyter_backend="html")` turns in the browser and needs `mnclab[html]`. VTK without OpenGL ends
the whole process without a word, so what it needs is looked for first. A plotter belongs to the thread that made it.
"""

from __future__ import annotations

import base64
import ctypes.util
import os
import sys
from functools import cache
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from mnclab.path.cylinder import divided
from mnclab.path.kinds import Kind
from mnclab.path.toolpath import Toolpath
from mnclab.show import solids
from mnclab.show.export_mesh import CHORD, FEED, PROBING, RAPID, STOCK, TOOL
from mnclab.text.alarm import Alarm
from mnclab.text.extras import require
from mnclab.text.given import shown
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.blank import blank as as_blank

if TYPE_CHECKING:
    import pyvista

COLOURS = ("kind", "feed", "tool", "z", "line")
TITLES = {"feed": "feed, mm/min", "tool": "tool", "z": "Z, mm", "line": "line"}
WINDOW = "VTK_DEFAULT_OPENGL_WINDOW"
#: Library of the system -> window class of VTK that draws with it, without a screen.
OFF_SCREEN = {"EGL": "vtkEGLRenderWindow", "OSMesa": "vtkOSOpenGLRenderWindow"}
SIZE = (800, 600)
MAP = "viridis"
BAR: dict[str, Any] = {
    "color": "black", "fmt": "%.6g", "title_font_size": 16, "label_font_size": 14,
    "vertical": True, "position_x": 0.86, "position_y": 0.25, "height": 0.5, "width": 0.07,
}  # fmt: skip
TURN = 0.05  # rad, of rapids over a cylinder
NARROWED, ASIDE = 0.88, 0.13  # how much smaller and how far to the left (of half the width) a body stands beside a scale


def scene(
    run: Any,
    colour: str = "kind",
    *,
    row: int = -1,
    tool: bool = True,
    stock: bool | Blank | tuple[ArrayLike, ArrayLike] = True,
    part: bool = False,
    probed: bool = True,
    axes: bool = True,
    size: tuple[int, int] = SIZE,
) -> pyvista.Plotter:
    """The path of a run with its tool and blank, seen from the front, right and above.

    `colour` of the cuts: "kind", "feed" (mm/min), "tool", "z" (mm) or "line"; rapids are thin and red in all of them.
    Beside a blank the first approach, from a place that nobody has said, is left out. `row`: where the tool stands, by
    default at the end. `stock`: whether the blank of the setup or the program is shown, or another one, mm in the
    coordinates of the path: two opposite corners (3,) or a body of
    `workpiece.blank`. `part` shows what is left of the blank after `row` in place of it, `probed` the part that a probe
    meets, and its touches with their numbers. `size` in pixels. What
    lies on a cylinder is shown on it as it lies on the workpiece, without the tool.

    An Alarm says in a sentence what is missing: pyvista, or something for VTK to draw with.
    """
    if not isinstance(colour, str) or colour not in COLOURS:
        raise Alarm(f"colour must be one of {', '.join(COLOURS)}, got {shown(colour)}")
    check_drawing()
    path, towards = run.toolpath, (-0.5, -1.0, 0.7)
    plotter = new_plotter(f"scene of {path!r}", size)
    turning = bool(path.cylinders)
    if turning:
        add_cylinders(plotter, path)
        path, towards = _on_cylinders(path)
        _add_path(plotter, path, colour)
    else:
        _add_path(plotter, path[run.rows_from_home :], colour)
    if tool and not turning and (body := solids.tool_of(run, row)):
        look: dict[str, Any] = {"specular": 0.4, "smooth_shading": True, "split_sharp_edges": True}
        plotter.add_mesh(_surface(body), color=TOOL, name="tool", **look)
    given = run.stock if stock is True else as_blank(stock) if stock is not False else None
    if stock is not True and stock is not False and given is None:
        raise Alarm(f"stock must be True, False, two corners (3,) or a body of workpiece.blank, got {shown(stock)}")
    blank = solids.body_of(given) if given else None
    corners = blank.points if blank else None
    if turning and blank is None:
        corners = np.concatenate([solids.cylinder_body(run.toolpath, k).points for k in range(len(run.toolpath.cylinders))])
    if part:
        from mnclab.show.part_scene import add_part

        left = run.workpiece(row=row) if len(path) else run.workpiece()
        solid = left.solid()
        corners = solid.points
        add_part(plotter, left, solid, "none")
    elif blank:
        plotter.add_mesh(_surface(blank), color=STOCK, opacity=0.25, name="blank")
        edges = _surface(blank).extract_feature_edges()
        plotter.add_mesh(edges, color="#7d7664", line_width=1, name="edges of the blank")
    if probed and (run.setup.part is not None or run.setup.setter is not None):
        from mnclab.show.probed_scene import add_probed

        ends = add_probed(plotter, run)
        corners = ends if corners is None or ends is None else np.concatenate([corners, ends])
    if axes:
        plotter.add_axes(line_width=3, color="black")
        if len(path):
            add_rulers(plotter, path.bounds if corners is None else np.concatenate([path.bounds, corners]))
    view_from(plotter, (0.0, 1.0, 0.0) if path.lathe else towards, path.lathe)
    return plotter


def add_cylinders(plotter: Any, path: Toolpath) -> None:
    """The cylinders that a path lies on, with their edges."""
    for number in range(len(path.cylinders)):
        body = _surface(solids.cylinder_body(path, number))
        plotter.add_mesh(body, color=STOCK, opacity=0.35, name=f"cylinder {number}")
        edges = body.extract_feature_edges(feature_angle=45)
        plotter.add_mesh(edges, color="#7d7664", line_width=1, name=f"edges of cylinder {number}")


def _on_cylinders(path: Toolpath) -> tuple[Toolpath, tuple[float, float, float]]:
    """What lies on cylinders as it lies on the workpiece, without the way from anywhere, and a direction to look from."""
    parted, one = divided(path, TURN), path.cylinders[0]
    rows = np.flatnonzero(parted.cylinder >= 0)
    rows = rows[np.cumsum(parted.kind[rows] != Kind.RAPID) > 0]
    found = parted.on_workpiece()[rows]
    out = (found.end - one.point).mean(axis=0)
    out -= out @ one.direction * np.array(one.direction)
    size = float(np.linalg.norm(out))
    out = out / size if size > one.radius / 10 else np.array(one.zero)
    side = np.cross(one.direction, out)
    x, y, z = (out - 0.5 * side + 0.45 * np.array(one.direction)).tolist()
    return found, (x, y, z)


def new_plotter(alt: str, size: tuple[int, int]) -> Any:
    """An empty scene on white; `alt` says in words what it shows."""
    plotter: Any = _class()(off_screen=True, window_size=list(size))
    plotter.alt = alt
    plotter.set_background("white")
    return plotter


def view_from(plotter: Any, towards: tuple[float, float, float], lathe: bool, zoom: float = 0.85) -> None:
    """Look from a side without perspective; on a lathe X stands upright."""
    plotter.view_vector(towards, (1, 0, 0) if lathe else (0, 0, 1))
    plotter.enable_parallel_projection()
    bars = len(plotter.scalar_bars) > 0
    plotter.camera.zoom(zoom * (NARROWED if bars else 1.0))
    plotter.camera.SetWindowCenter(ASIDE if bars else 0.0, 0.0)


def check_drawing() -> None:
    """Choose what VTK draws with; an Alarm where it would find nothing, since VTK itself would end the process."""
    require("pyvista", "3D scenes", instead="run.plot() and run.player() do without")
    if not sys.platform.startswith("linux") or os.environ.get("DISPLAY") or os.environ.get(WINDOW):
        return
    for library, window in OFF_SCREEN.items():
        if ctypes.util.find_library(library):
            os.environ[WINDOW] = window
            return
    raise Alarm(
        "3D scenes need OpenGL, and this machine has neither a screen nor libEGL nor libOSMesa",
        hint="on Debian, root installs it: apt-get install libegl1 libgl1-mesa-dri",
    )


@cache
def _class() -> Any:
    """A plotter that shows itself in Jupyter; made here because pyvista is loaded only when a scene is wanted."""
    import pyvista

    class Scene(pyvista.Plotter):
        """A `pyvista.Plotter` whose picture is shown by Jupyter; `alt` says in words what it shows."""

        alt = "scene"

        def show(self, *arguments: Any, **options: Any) -> Any:
            """Show the scene; in Jupyter as a still picture unless `jupyter_backend` says otherwise."""
            if options.setdefault("jupyter_backend", "static") in ("html", "client", "server", "trame"):
                require("trame_pyvista", "scenes that turn", "html", 'jupyter_backend="static" does without')
            return super().show(*arguments, **options)

        def png(self) -> bytes:
            data = BytesIO()
            self.screenshot(data)
            return data.getvalue()

        def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, Any]:
            picture = base64.b64encode(self.png()).decode()
            image = f'<img alt="{escape(self.alt)}" style="max-width:100%" src="data:image/png;base64,{picture}">'
            return {"text/html": image, "image/png": picture, "text/plain": repr(self)}

        def __repr__(self) -> str:
            return f"<Scene: {self.alt}>"

    return Scene


def _surface(body: solids.Body) -> Any:
    import pyvista

    return pyvista.PolyData.from_regular_faces(body.points, body.triangles)


def _add_path(plotter: Any, path: Toolpath, colour: str) -> None:
    strokes, row = solids.strokes(path, CHORD)
    kind = path.kind[row]
    cuts = np.isin(kind, (Kind.LINE, Kind.ARC))
    for name, one, look, width in (("rapids", Kind.RAPID, RAPID, 1.0), ("probing", Kind.PROBE, PROBING, 2.0)):
        if (kind == one).any():
            plotter.add_mesh(_lines(strokes[kind == one]), color=look, line_width=width, name=name)
    if not cuts.any():
        return
    mesh = _lines(strokes[cuts])
    if colour == "kind":
        plotter.add_mesh(mesh, color=FEED, line_width=2.5, name="cuts")
        return
    values = strokes[cuts][:, :, 2].ravel() if colour == "z" else getattr(path, colour)[row[cuts]]
    bar = bar_of(colour, values)
    (mesh.point_data if colour == "z" else mesh.cell_data)[colour] = values.astype(np.float64)
    plotter.add_mesh(mesh, scalars=colour, cmap=MAP, line_width=2.5, scalar_bar_args=bar, name="cuts")


def bar_of(colour: str, values: np.ndarray) -> dict[str, Any]:
    """How the scale of a colour looks."""
    bar = BAR | {"title": TITLES[colour] + "\n"}  # clear of the highest number
    spread = float(np.ptp(values)) if len(values) else 0.0
    if colour in ("tool", "line"):  # whole numbers alone
        bar |= {"fmt": "%.0f", "n_labels": int(spread) + 1 if spread < 6 else 5}
    return bar


def add_rulers(plotter: Any, corners: np.ndarray) -> None:
    """Rulers around points (n, 3), from one round number to another."""
    low, high = corners.min(axis=0), corners.max(axis=0)
    if not np.isfinite(low).all():
        return
    coarse = max(float((high - low).max()), 1e-3) / 4
    power = 10.0 ** np.floor(np.log10(coarse))
    step = power * next(factor for factor in (1, 2, 5, 10) if factor * power >= coarse * (1 - 1e-9))
    low, high = np.floor(low / step + 1e-9) * step, np.ceil(high / step - 1e-9) * step
    high = np.where(high > low, high, low + step)
    x, y, z = (np.round((high - low) / step).astype(int) + 1).tolist()
    ranges = np.stack([low, high], axis=1).ravel().tolist()
    plotter.show_bounds(
        bounds=ranges, axes_ranges=ranges,
        xtitle="X, mm", ytitle="Y, mm", ztitle="Z, mm", grid="back", location="outer", ticks="outside",
        color="#555555", font_size=9, fmt="%.6g", bold=False, use_3d_text=False, n_xlabels=x, n_ylabels=y, n_zlabels=z,
    )  # fmt: skip


def _lines(strokes: np.ndarray) -> Any:
    import pyvista

    count = len(strokes)
    pairs = np.arange(2 * count).reshape(-1, 2)
    return pyvista.PolyData(strokes.reshape(-1, 3), lines=np.insert(pairs, 0, 2, axis=1).ravel())

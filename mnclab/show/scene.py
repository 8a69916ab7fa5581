"""A run in three dimensions: path, tool, blank or part in a pyvista `Plotter`; pyvista is known here alone.

The scene shows itself in Jupyter as a still picture, which works everywhere and needs no server. `scene.show()` does
the same; `scene.show(jupyter_backend="html")` turns in the browser and needs `mnclab[html]`. VTK without OpenGL ends
the whole process without a word, so what it needs is looked for first. A plotter belongs to the thread that made it.
"""

from __future__ import annotations

import base64
import ctypes.util
import os
import sys
from collections.abc import Iterable
from functools import cache
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from mnclab.path.cylinder import divided
from mnclab.path.limits import Limits
from mnclab.path.profile.ramps import courses
from mnclab.path.toolpath import Array, Kind, Mask, Toolpath
from mnclab.show import looks, solids
from mnclab.show.export_mesh import CHORD
from mnclab.show.probed import felt
from mnclab.show.rulers import frame, rounded, turning_rulers
from mnclab.text.alarm import Alarm
from mnclab.text.given import choice, fitting, shown
from mnclab.text.opening import require
from mnclab.workpiece.blank import Blank, depth_below
from mnclab.workpiece.blank import blank as as_blank
from mnclab.workpiece.collision import Collision
from mnclab.workpiece.workpiece import Solid, Workpiece

if TYPE_CHECKING:
    import pyvista


COLOURS = ("kind", "feed", "tool", "z", "line")
TITLES = {"feed": "feed, {unit}/min", "tool": "tool", "z": "Z, {unit}", "line": "line"}
LENGTHS = ("feed", "z")  # what counts in the unit of the program
WINDOW = "VTK_DEFAULT_OPENGL_WINDOW"
#: Library of the system -> window class of VTK that draws with it, without a screen.
OFF_SCREEN = {"EGL": "vtkEGLRenderWindow", "OSMesa": "vtkOSOpenGLRenderWindow"}
SIZE = (800, 600)
MAP = "viridis"
BAR: dict[str, Any] = {
    "color": "black", "fmt": "%.6g", "title_font_size": 16, "label_font_size": 14,
    "vertical": True, "position_x": 0.88, "position_y": 0.25, "height": 0.5, "width": 0.07,
}  # fmt: skip
LABELS = 6  # of a scale, at most
TURN = 0.05  # rad, of rapids over a cylinder
FAR = 5.0  # what is so many times larger than the rest is cut off (rapids) or left out (a tool)
FOOT = 0.5  # of the size of the rest: how much of a tool above its tip is always in sight
BENT, SHORT = 1 / 2000, 1 / 200  # of the size of a path: rapids that leave their line by less, or are shorter, are straight


@fitting
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
    """The path of a run with its tool and blank, seen from the front, left and above; of a lathe from the side, with its chuck.

    `colour` of the cuts: "kind", "feed" (mm/min), "tool", "z" (mm) or "line"; rapids are thin and red in all of them.
    Beside a blank the first approach, from a place that nobody has said, is left out. `row`: where the tool stands, by
    default at the end. `stock`: whether the blank of the setup or the program is shown, or another one, mm in the
    coordinates of the path: two opposite corners (3,) or a body of
    `workpiece.blank`. `part` shows what is left of the blank after `row` in place of it, `probed` the part that a probe
    meets, and its touches with their numbers. `size` in pixels. What
    lies on a cylinder is shown on it as it lies on the workpiece, without the tool. Rapids from far away go beyond the
    picture; a tool many times larger than all else is left out. Rulers count in the unit of the program, on a lathe diameters.

    An Alarm says in a sentence what is missing: pyvista, or something for VTK to draw with.
    """
    if not isinstance(colour, str) or colour not in COLOURS:
        raise Alarm(f"colour must be one of {', '.join(COLOURS)}, got {shown(colour)}")
    check_drawing()
    path, towards = run.toolpath, (-0.5, -1.0, 0.7)
    plotter = new_plotter(f"scene of {path!r}", size)
    turning = bool(path.cylinders)
    if turning:
        drums = add_cylinders(plotter, path)
        path, towards = _on_cylinders(path)
        drawn = _add_path(plotter, path, colour, None)
    else:
        drawn = _add_path(plotter, path[run.rows_from_home :], colour, run.rapids)
    given = run.stock if stock is True else as_blank(stock) if stock is not False else None
    if stock is not True and stock is not False and given is None:
        raise Alarm(f"stock must be True, False, two corners (3,) or a body of workpiece.blank, got {shown(stock)}")
    blank = solids.body_of(given) if given else None
    bodies = [blank.points] if blank else []
    if turning and blank is None:
        bodies = drums
    if part:
        left = run.workpiece(row=row) if len(path) else run.workpiece()
        solid = left.solid()
        bodies = [solid.points]
        add_part(plotter, left, solid, "none")
    elif blank:
        _add_glass(plotter, blank, "blank", looks.BLANK_BODY, 0.25)
    if probed and (run.setup.part is not None or run.setup.setter is not None):
        bodies += [ends for ends in [add_probed(plotter, run)] if ends is not None]
    if given:
        held = enumerate(solids.fixtures_of(run))
        bodies += [_add_glass(plotter, body, f"fixture {k}", looks.FIXTURE, 0.45, looks.FIXTURE_EDGE) for k, body in held]
    ruled = np.concatenate([*_fitted(drawn), *bodies, np.empty((0, 3))])
    seen = ruled
    if tool and not turning and len(path) and len(ruled):
        seen = np.concatenate([ruled, _add_tool(plotter, run, row, float(np.ptp(ruled, axis=0).max()))])
    frame(plotter, seen, (0, 1, 0) if path.lathe else towards, path.lathe, unit=run.toolpath.unit, axes=axes, ruled=ruled)
    return plotter


def _fitted(drawn: dict[str, np.ndarray]) -> list[np.ndarray]:
    """The points (n, 3) of a path that the picture shows whole: all of them, unless its rapids come from far away."""
    cuts = [points for name, points in drawn.items() if name != "rapids"]
    every = np.concatenate([*drawn.values(), np.empty((0, 3))])
    if "rapids" not in drawn or not cuts:
        return [every]
    near = np.concatenate(cuts)
    whole, size = (float(np.ptp(points, axis=0).max()) for points in (every, near))
    return [near] if whole > FAR * size > 0 else [every]


def _add_tool(plotter: Any, run: Any, row: int, size: float) -> np.ndarray:
    """Add the tool after a row beside something of a `size`, mm; what of it (n, 3) the picture holds."""
    found: dict[str, solids.Body | None] = {"tool": solids.tool_of(run, row), "holder": solids.holder_of(run, row)}
    if run.toolpath.lathe:
        found = {**solids.turning_tool_of(run, row, size)}
    shades = {"tool": looks.CARBIDE if run.toolpath.lathe else looks.TOOL_BODY, "holder": looks.STEEL}
    tip, held = run.toolpath.end[row], [np.empty((0, 3))]
    for name, body in found.items():
        if body is None or np.ptp(body.points, axis=0).max() > 2 * FAR * max(size, 1e-9):
            continue
        look: dict[str, Any] = {"specular": 0.4, "smooth_shading": True, "split_sharp_edges": True}
        plotter.add_mesh(_surface(body), color=shades[name], name=name, **look)
        held.append(body.points[np.linalg.norm(body.points - tip, axis=1) < max(FOOT, 1.5 * run.toolpath.lathe) * size])
    return np.concatenate(held)


def _add_glass(plotter: Any, body: solids.Body, name: str, shade: str, strength: float, edge: str = looks.METAL_EDGE) -> Array:
    """Add a body that is seen through, with its edges; its points (n, 3)."""
    mesh = _surface(body)
    plotter.add_mesh(mesh, color=shade, opacity=strength, name=name)
    plotter.add_mesh(mesh.extract_feature_edges(ANGLE), color=edge, line_width=1, name=f"edges of {name}")
    return body.points


def add_cylinders(plotter: Any, path: Toolpath) -> list[Array]:
    """Add the cylinders that a path lies on; the points (n, 3) of each."""
    found = enumerate(solids.cylinder_body(path, number) for number in range(len(path.cylinders)))
    return [_add_glass(plotter, body, f"cylinder {number}", looks.BLANK_BODY, 0.35) for number, body in found]


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
        """A `pyvista.Plotter` whose picture is shown by Jupyter; `alt` says in words what it shows, `titles` are its rulers'."""

        alt = "scene"
        titles: tuple[str, ...] = ()

        def show(self, *arguments: Any, **options: Any) -> Any:
            """Show the scene; in Jupyter as a still picture unless `jupyter_backend` says otherwise."""
            if options.setdefault("jupyter_backend", "static") in ("html", "client", "server", "trame"):
                require("trame_pyvista", "scenes that turn", "html", 'jupyter_backend="static" does without')
                turning_rulers(self)
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


def _add_path(plotter: Any, path: Toolpath, colour: str, rapids: Limits | None) -> dict[str, np.ndarray]:
    """Add the moves of a path; their points (n, 3) by "rapids", "probing" and "cuts"."""
    size = solids.size_of(path)
    strokes, row = solids.strokes(path, min(CHORD, size / 2000))
    if rapids is not None:
        strokes, row = solids.bent(strokes, row, *courses(path, rapids, BENT * size, SHORT * size))
    kind = path.kind[row]
    cuts, drawn = np.isin(kind, (Kind.LINE, Kind.ARC)), dict[str, np.ndarray]()
    for name, one, look, width in (("rapids", Kind.RAPID, looks.RAPID, 1.0), ("probing", Kind.PROBE, looks.PROBING, 2.0)):
        if (kind == one).any():
            plotter.add_mesh(_lines(strokes[kind == one]), color=look.colour, line_width=width, name=name)
            drawn[name] = strokes[kind == one].reshape(-1, 3)
    if not cuts.any():
        return drawn
    drawn["cuts"] = strokes[cuts].reshape(-1, 3)
    mesh = _lines(strokes[cuts])
    if colour == "kind":
        plotter.add_mesh(mesh, color=looks.FEED.colour, line_width=2.5, name="cuts")
        return drawn
    values = strokes[cuts][:, :, 2].ravel() if colour == "z" else getattr(path, colour)[row[cuts]]
    if colour in LENGTHS and path.inches:
        values = values / path.unit.length
    bar, limits = bar_of(TITLES[colour].format(unit=path.unit.short), values, colour in ("tool", "line"))
    (mesh.point_data if colour == "z" else mesh.cell_data)[colour] = values.astype(np.float64)
    plotter.add_mesh(mesh, scalars=colour, cmap=MAP, clim=limits, line_width=2.5, scalar_bar_args=bar, name="cuts")
    return drawn


def bar_of(title: str, values: np.ndarray, whole: bool = False) -> tuple[dict[str, Any], tuple[float, float]]:
    """How a scale looks, and its ends: it has round numbers; `whole` ones alone where it counts."""
    bar = BAR | {"title": title + "\n"}  # clear of the highest number
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
    if not high > low:
        return bar | {"n_labels": 1}, (low, high)
    step = rounded(max((high - low) / (LABELS - 1), 1.0 if whole else 0.0))
    low, high = step * np.floor(low / step + 1e-9), step * np.ceil(high / step - 1e-9)
    digits = max(0, -int(np.floor(np.log10(step) + 1e-9)))
    return bar | {"fmt": f"%.{digits}f", "n_labels": round((high - low) / step) + 1}, (float(low), float(high))


def _lines(strokes: np.ndarray) -> Any:
    import pyvista

    count = len(strokes)
    pairs = np.arange(2 * count).reshape(-1, 2)
    return pyvista.PolyData(strokes.reshape(-1, 3), lines=np.insert(pairs, 0, 2, axis=1).ravel())


# A part in three dimensions: the body that is left, shaded, with crisp edges; the part that a probe meets.

PART_COLOURS = ("depth", "tool", "line", "none")
DEPTHS = "YlGnBu"  # pale above, dark below, in grey print too
EDGE, ANGLE = "#33312b", 25.0  # degrees between two faces from which their edge is drawn
BALL, PIN = 0.012, 0.1  # where something collides: radius, and how far its pin stands out, of the greatest side of the part
LOOK: dict[str, Any] = {
    "smooth_shading": True, "split_sharp_edges": True, "feature_angle": ANGLE, "ambient": 0.22, "diffuse": 0.82,
    "specular": 0.1, "name": "part",
}  # fmt: skip


@fitting
def part_body(
    workpiece: Workpiece,
    colour: str = "depth",
    *,
    collisions: Iterable[Collision] = (),
    axes: bool = True,
    size: tuple[int, int] = SIZE,
) -> pyvista.Plotter:
    """The part as a body, seen from the front, right and above.

    `colour`: "depth" (mm below the top of the blank, or the round side of one that lies; on a lathe the diameter), the "tool"
    or the "line" that cut a face, or "none"; what nothing cut has the colour of the blank. `collisions` are red balls at their
    places, with pins that stand out of the part. `size` in pixels.
    """
    choice(colour, "colour", PART_COLOURS)
    check_drawing()
    lathe = workpiece.cutting.lathe
    plotter = new_plotter(repr(workpiece).splitlines()[0], size)
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
    plain = looks.BLANK_BODY
    if colour == "none" or not (solid.row >= 0).any():
        plotter.add_mesh(mesh, color=plain, **LOOK)
    elif colour == "depth":
        mesh, uncut = _apart(solid)
        title, values = _depths(workpiece, mesh.points)
        mesh.point_data[title] = np.where(uncut, np.nan, values)
        cut = values[~uncut]
        deep = not workpiece.cutting.lathe and cut.size and cut.max() > 0
        bar, limits = bar_of(title, np.array([0.0, float(cut.max() if deep else values.max())]))
        plotter.add_mesh(mesh, scalars=title, cmap=DEPTHS, clim=limits, nan_color=plain, scalar_bar_args=bar, **LOOK)
    else:
        values = workpiece.cutting.of_rows(getattr(workpiece.cutting.path, colour), solid.row).astype(np.float64)
        mesh.cell_data[colour] = np.where(solid.row >= 0, values, np.nan)
        bar, limits = bar_of(colour, values[solid.row >= 0], whole=True)
        plotter.add_mesh(mesh, scalars=colour, cmap=MAP, clim=limits, nan_color=plain, scalar_bar_args=bar, **LOOK)
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
    return "depth, mm", depth_below(workpiece.cutting.stock, points)


def add_collisions(plotter: Any, collisions: Iterable[Collision], points: Array, lathe: bool) -> None:
    """Red balls where something collides, and pins from them up, on a lathe along X: most are deep in the part."""
    import pyvista

    if len(places := looks.places_of(collisions)):
        side, out = float(np.ptp(points, axis=0).max()), 0 if lathe else 2
        ball = pyvista.Sphere(radius=BALL * side)
        balls = pyvista.PolyData(places).glyph(geom=ball, scale=False, orient=False)
        plotter.add_mesh(balls, color=looks.RED, name="collisions")
        heads = places.copy()
        heads[:, out] = np.maximum(places[:, out], points[:, out].max()) + PIN * side
        pins = pyvista.line_segments_from_points(np.stack([places, heads], axis=1).reshape(-1, 3))
        plotter.add_mesh(pins, color=looks.RED, line_width=3, name="pins")


# The part that a probe meets, and its touches: a ball at each touched place with its number.

TOUCH_BALL = 0.011  # radius of a mark, of the greatest side of the part_body
MOST, FEW = 60, 8  # touches with numbers, with values too
PROBED_LOOK: dict[str, Any] = {
    "color": looks.METAL, "opacity": 0.6, "ambient": 0.3, "smooth_shading": True, "split_sharp_edges": True,
    "feature_angle": ANGLE,
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
            edges = mesh.extract_feature_edges(feature_angle=ANGLE, boundary_edges=False, non_manifold_edges=False)
            if edges.n_cells:
                plotter.add_mesh(edges, color=looks.METAL_EDGE, line_width=1.2, name="edges of the part to touch")
    if found.beam is not None:
        plotter.add_mesh(pyvista.Line(*found.beam), color=looks.BEAM, line_width=3, name="beam")
    if len(found.places):
        ball = pyvista.Sphere(radius=TOUCH_BALL * float((ends[1] - ends[0]).max()))
        balls = pyvista.PolyData(found.places).glyph(geom=ball, scale=False, orient=False)
        plotter.add_mesh(balls, color=looks.VIOLET, name="touches")
    if 0 < len(found.places) <= MOST:
        plotter.add_point_labels(
            found.places, [text[len(found.texts) > FEW] for text in found.texts], font_size=12, text_color="#4a148c",
            shape_opacity=0.75, shape_color="white", show_points=False, always_visible=True, name="numbers of the touches",
        )  # fmt: skip
    return ends

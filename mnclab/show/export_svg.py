"""A path as an SVG drawing in true size: one millimetre of the path is one millimetre on paper, arcs stay arcs.

`run.save("part.svg", true_size=True)` is this drawing, for a plotter, a laser or an overlay. Seen from above (XY); on a
lathe Z goes to the right and the radius X up. Because SVG counts downwards, vertical coordinates are negative.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

import numpy as np

from mnclab.path.toolpath import Kind, Toolpath
from mnclab.show.export_gcode import number
from mnclab.text.given import choice

MARGIN = 2.0  # mm
VIEWS = {"XY": (0, 1), "XZ": (0, 2), "YZ": (1, 2), "ZX": (2, 0)}
CLASSES = {Kind.RAPID: "rapid", Kind.LINE: "feed", Kind.ARC: "feed", Kind.PROBE: "probing"}
STYLE = (
    "path{fill:none;stroke-width:.25;stroke-linejoin:round}.feed{stroke:#1259a8}"
    ".rapid{stroke:#c62828;stroke-width:.15;stroke-dasharray:2 1.2}.probing{stroke:#7b1fa2;stroke-dasharray:.4 .6}"
)


def write_true_size(run: Any, path: Path, view: str = "auto") -> None:
    """Write the toolpath of a run as a drawing in true size."""
    with path.open("w", encoding="utf-8", errors="replace", newline="\n") as file:
        file.writelines(line + "\n" for line in lines(run.toolpath, view, run.program.title))


def lines(path: Toolpath, view: str = "auto", title: str = "tool path") -> Iterator[str]:
    """The lines of the file: one path element for each run of moves of a class."""
    view = choice(view, "view", ("auto", *VIEWS))
    view = ("ZX" if path.lathe else "XY") if view == "auto" else view
    right, up = VIEWS[view]
    low, high = np.nan_to_num(path.bounds)
    width, height = (float(high[k] - low[k]) + 2 * MARGIN for k in (right, up))
    box = f"{number(low[right] - MARGIN)} {number(-high[up] - MARGIN)} {number(width)} {number(height)}"
    size = f'width="{number(width)}mm" height="{number(height)}mm"'
    yield f'<svg xmlns="http://www.w3.org/2000/svg" {size} viewBox="{box}">'
    yield f"<title>{escape(title)}</title>"
    yield f"<style>{STYLE}</style>"
    for kind, commands in groups(path, right, up):
        yield f'<path class="{kind}" d="{" ".join(commands)}"/>'
    yield "</svg>"


def groups(path: Toolpath, right: int, up: int) -> Iterator[tuple[str, list[str]]]:
    """Runs of moves of one class, as commands of a path."""
    current, commands = "", [""]
    here: tuple[float, float] | None = None
    for row in np.flatnonzero(path.is_motion).tolist():
        kind = CLASSES[Kind(int(path.kind[row]))]
        start = float(path.start[row, right]), float(path.start[row, up])
        if kind != current or start != here:
            if current and len(commands) > 1:
                yield current, commands
            current, commands = kind, [f"M{number(start[0])} {number(-start[1])}"]
        commands += strokes(path, row, right, up)
        here = float(path.end[row, right]), float(path.end[row, up])
    if current and len(commands) > 1:
        yield current, commands


def strokes(path: Toolpath, row: int, right: int, up: int) -> Iterator[str]:
    """The commands of one move: arcs seen along their axis are arcs, of at most half a turn each."""
    if path.kind[row] == Kind.ARC:
        along = 3 - right - up
        if abs(path.axis[row, along]) > 1 - 1e-12:
            yield from turns(path, row, right, up, along)
            return
        for point in path[row : row + 1].points(0.001)[0][1:].tolist():
            yield f"L{number(point[right])} {number(-point[up])}"
    elif (path.start[row, [right, up]] != path.end[row, [right, up]]).any():
        yield f"L{number(path.end[row, right])} {number(-path.end[row, up])}"


def turns(path: Toolpath, row: int, right: int, up: int, along: int) -> Iterator[str]:
    """An arc as commands A."""
    sense = 1.0 if np.linalg.det(np.eye(3)[[right, up, along]]) * path.axis[row, along] > 0 else -1.0
    sweep = float(path.sweep[row]) * sense
    centre, start = path.centre[row, [right, up]], path.start[row, [right, up]]
    spoke = start - centre
    radius = float(np.hypot(*spoke))
    parts = int(np.ceil(abs(sweep) / np.pi - 1e-9))
    for k in range(1, parts + 1):
        angle = sweep * k / parts
        c, s = np.cos(angle), np.sin(angle)
        to = centre + [c * spoke[0] - s * spoke[1], s * spoke[0] + c * spoke[1]]
        if k == parts:
            to = path.end[row, [right, up]]
        # a flag of 0 turns counter-clockwise on paper, where the vertical axis is turned over
        yield f"A{number(radius)} {number(radius)} 0 0 {0 if sweep > 0 else 1} {number(to[0])} {number(-to[1])}"

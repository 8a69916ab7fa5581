"""A path as a drawing in true size: SVG for a plotter, a laser or an overlay, DXF for CAD; arcs stay arcs.

`run.save("part.svg", true_size=True)` is the SVG: one millimetre of the path is one on paper. It is seen from above (XY); on a
lathe Z goes to the right and the radius X up. Because SVG counts downwards, vertical coordinates are negative.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

import numpy as np
from numpy.typing import NDArray

from mnclab.path.profile.ramps import bent
from mnclab.path.toolpath import MOTION_KINDS, Kind, Toolpath
from mnclab.show.export_gcode import number, numbers
from mnclab.show.looks import MOVES, OF_KIND, RAPID
from mnclab.text.columns import filled, parts, spelled
from mnclab.text.given import choice

MARGIN = 2.0  # mm
BENT = 0.01  # mm that a rapid may be beside its line
VIEWS = {"XY": (0, 1), "XZ": (0, 2), "YZ": (1, 2), "ZX": (2, 0)}
STYLE = "path{fill:none;stroke-linejoin:round}" + "".join(move.css for move in MOVES)


def write_true_size(run: Any, path: Path, view: str = "auto") -> None:
    """Write the toolpath of a run as a drawing in true size."""
    with path.open("w", encoding="utf-8", errors="replace", newline="\n") as file:
        file.writelines(drawing(_as_it_goes(run), view, run.program.title))


def _as_it_goes(run: Any) -> Toolpath:
    """The toolpath of a run with rapids as its control has them, where no axis waits for another."""
    return bent(run.toolpath, run.rapids, BENT)


def drawing(path: Toolpath, view: str = "auto", title: str = "tool path") -> Iterator[str]:
    """The file, piece by piece: one path element for each run of moves of a class."""
    view = choice(view, "view", ("auto", *VIEWS))
    view = ("ZX" if path.lathe else "XY") if view == "auto" else view
    right, up = VIEWS[view]
    low, high = np.nan_to_num(path.bounds)
    width, height = (float(high[k] - low[k]) + 2 * MARGIN for k in (right, up))
    box = f"{number(low[right] - MARGIN)} {number(-high[up] - MARGIN)} {number(width)} {number(height)}"
    size = f'width="{number(width)}mm" height="{number(height)}mm"'
    yield f'<svg xmlns="http://www.w3.org/2000/svg" {size} viewBox="{box}">\n'
    yield f"<title>{escape(title)}</title>\n<style>{STYLE}</style>\n"
    yield from elements(path, right, up)
    yield "</svg>\n"


def elements(path: Toolpath, right: int, up: int) -> Iterator[str]:
    """The elements, many moves at a time; a run that draws nothing is left out."""
    moves, along = np.flatnonzero(path.is_motion), 3 - right - up
    kind, start, end = path.kind[moves], path.start[moves][:, [right, up]], path.end[moves][:, [right, up]]
    arc, round_ = kind == Kind.ARC, np.abs(path.axis[moves, along]) > 1 - 1e-12  # seen along its axis
    draws = np.where(arc, ~round_ | (np.abs(path.sweep[moves]) > 1e-9 * np.pi), (start != end).any(axis=1))
    classes = np.array([OF_KIND[kind].name for kind in MOTION_KINDS], dtype=object)[kind]
    begins = np.append(True, (classes[1:] != classes[:-1]) | (start[1:] != end[:-1]).any(axis=1))[: len(moves)]
    ends = np.append(begins[1:], True)[: len(moves)]
    run = np.cumsum(begins) - 1
    shown = (np.bincount(run, draws) > 0)[run]
    for some in parts(len(moves)):
        to = " L" + numbers(end[some, 0]) + " " + numbers(-end[some, 1])
        for k in np.flatnonzero(arc[some]).tolist():
            at = some.start + k
            bent = turns(path, moves[at], right, up, along) if round_[at] else chords(path, moves[at], right, up)
            to[k] = "".join(f" {command}" for command in bent)
        first = '<path class="' + classes[some] + '" d="M' + numbers(start[some, 0]) + " " + numbers(-start[some, 1])
        said = np.where(begins[some], first, "") + np.where(draws[some], to, "") + np.where(ends[some], '"/>\n', "")
        yield "".join(said[shown[some]])


def chords(path: Toolpath, row: Any, right: int, up: int) -> Iterator[str]:
    """An arc that is not seen along its axis as short lines."""
    for point in path[row : row + 1].points(0.001)[0][1:].tolist():
        yield f"L{number(point[right])} {number(-point[up])}"


def turns(path: Toolpath, row: Any, right: int, up: int, along: int) -> Iterator[str]:
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


# DXF: lines as LINE, arcs as ARC and CIRCLE, helices as 3D polylines, one layer a kind of move.
# AutoCAD's release 12, ASCII: the oldest form that keeps arcs, and the one that every reader reads. Millimetres, three
# dimensions, positions of the tool tip; an arc stands in the coordinates of its plane (the *extrusion* of the format).

CHORD = 0.001  # mm, of helices
Tag = tuple[int, Any]


def write_dxf(run: Any, path: Path) -> None:
    """Write the toolpath of a run as a drawing."""
    drawn = _as_it_goes(run)
    with path.open("w", encoding="ascii", newline="\n") as file:
        file.write(_written(head(drawn)))
        file.writelines(entities(drawn))
        file.write(_written([(0, "ENDSEC"), (0, "EOF")]))


def _written(tags: Iterable[Tag]) -> str:
    return "".join(f"{code:3d}\n{repr(value + 0.0) if isinstance(value, float) else value}\n" for code, value in tags)


def head(path: Toolpath) -> Iterator[Tag]:
    """What stands before the moves, as pairs of a group code and a value."""
    low, high = np.nan_to_num(path.bounds)
    yield 999, "tool path in millimetres"
    yield from [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009")]
    yield from [(9, "$EXTMIN"), *_point(low), (9, "$EXTMAX"), *_point(high)]
    yield from [(0, "ENDSEC"), (0, "SECTION"), (2, "TABLES")]
    yield from [(0, "TABLE"), (2, "LTYPE"), (70, 2)]
    yield from [(0, "LTYPE"), (2, "CONTINUOUS"), (70, 0), (3, "Solid line"), (72, 65), (73, 0), (40, 0.0)]
    yield from [(0, "LTYPE"), (2, "DASHED"), (70, 0), (3, "Rapids"), (72, 65), (73, 2), (40, 5.0)]
    yield from [(49, 3.0), (49, -2.0)]
    yield from [(0, "ENDTAB"), (0, "TABLE"), (2, "LAYER"), (70, 3)]
    for move in MOVES:
        dashes = "DASHED" if move.line is RAPID else "CONTINUOUS"
        yield from [(0, "LAYER"), (2, move.name.upper()), (70, 0), (62, move.number), (6, dashes)]
    yield from [(0, "ENDTAB"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]


LINE = _written([(0, "LINE"), (8, "%s"), *((10 + 10 * k + end, "%s") for end in (0, 1) for k in range(3))])
LAYERS = {kind: OF_KIND[kind].name.upper() for kind in MOTION_KINDS}


def entities(path: Toolpath) -> Iterator[str]:
    """The moves of a path, in their order; those that are straight many at a time."""
    moves = np.flatnonzero(path.is_motion)
    for some in parts(len(moves)):
        rows = moves[some]
        for these in np.split(rows, np.flatnonzero(np.diff(path.kind[rows] == Kind.ARC)) + 1):
            if path.kind[these[0]] != Kind.ARC:
                ends = np.hstack([path.start[these], path.end[these]]) + 0.0  # no negative zero
                yield filled(LINE, [spelled(LAYERS.values(), path.kind[these]), *ends.T])
                continue
            for row in these.tolist():
                rise = float((path.end[row] - path.start[row]) @ path.axis[row])
                helix = abs(rise) > 1e-9
                yield _written(polyline(path[row : row + 1].points(CHORD)[0].tolist()) if helix else arc(path, row))


def arc(path: Toolpath, row: int) -> Iterable[Tag]:
    """An arc in the coordinates of its plane, always counter-clockwise about the extrusion; whole turns are a circle."""
    axis, centre, sweep = path.axis[row], path.centre[row], float(path.sweep[row])
    basis = plane(axis)
    spoke = basis @ (path.start[row] - centre)
    middle = basis @ centre
    middle[2] = float(axis @ path.start[row])
    begin = [(8, LAYERS[Kind.ARC]), *_point(middle), (40, float(np.hypot(spoke[0], spoke[1])))]
    extrusion = list(_point(axis, 210)) if axis[2] != 1.0 else []
    if abs(sweep) >= 2 * np.pi - 1e-12:
        return [(0, "CIRCLE"), *begin, *extrusion]
    angle = np.arctan2(spoke[1], spoke[0])
    ends = np.degrees([angle, angle + sweep] if sweep > 0 else [angle + sweep, angle]) % 360.0
    return [(0, "ARC"), *begin, (50, float(ends[0])), (51, float(ends[1])), *extrusion]


def plane(axis: NDArray[np.float64]) -> NDArray[np.float64]:
    """Unit vectors (3, 3) of the coordinates that DXF gives a plane by its normal (the format's arbitrary axis)."""
    near_z = abs(axis[0]) < 1 / 64 and abs(axis[1]) < 1 / 64
    first = np.cross([0.0, 1.0, 0.0] if near_z else [0.0, 0.0, 1.0], axis)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(axis, first), axis])


def polyline(points: list[list[float]]) -> Iterator[Tag]:
    """A line through points in space."""
    layer = LAYERS[Kind.ARC]
    yield from [(0, "POLYLINE"), (8, layer), (66, 1), *_point((0.0, 0.0, 0.0)), (70, 8)]
    for point in points:
        yield from [(0, "VERTEX"), (8, layer), *_point(point), (70, 32)]
    yield from [(0, "SEQEND"), (8, layer)]


def _point(xyz: Iterable[float], code: int = 10) -> Iterator[Tag]:
    yield from ((code + 10 * k, float(value)) for k, value in enumerate(xyz))

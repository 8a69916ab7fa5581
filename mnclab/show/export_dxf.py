"""A path as a drawing in DXF: lines as LINE, arcs as ARC and CIRCLE, helices as 3D polylines, one layer a kind of move.

AutoCAD's release 12, ASCII: the oldest form that keeps arcs, and the one that every reader reads. Millimetres, three
dimensions, positions of the tool tip; an arc stands in the coordinates of its plane (the *extrusion* of the format).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.path.toolpath import Kind, Toolpath

CHORD = 0.001  # mm, of helices
#: Layer, colour number of AutoCAD, line type.
RAPID, FEED, PROBING = ("RAPID", 1, "DASHED"), ("FEED", 5, "CONTINUOUS"), ("PROBING", 6, "CONTINUOUS")
LAYERS = {Kind.RAPID: RAPID, Kind.LINE: FEED, Kind.ARC: FEED, Kind.PROBE: PROBING}
Tag = tuple[int, Any]


def write_dxf(run: Any, path: Path) -> None:
    """Write the toolpath of a run as a drawing."""
    with path.open("w", encoding="ascii", newline="\n") as file:
        file.writelines(f"{code:3d}\n{_text(value)}\n" for code, value in tags(run.toolpath))


def _text(value: Any) -> str:
    return repr(float(value) + 0.0) if isinstance(value, float) else str(value)


def tags(path: Toolpath) -> Iterator[Tag]:
    """The drawing as pairs of a group code and a value."""
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
    for name, colour, dashes in dict.fromkeys(LAYERS.values()):
        yield from [(0, "LAYER"), (2, name), (70, 0), (62, colour), (6, dashes)]
    yield from [(0, "ENDTAB"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]
    yield from entities(path)
    yield from [(0, "ENDSEC"), (0, "EOF")]


def entities(path: Toolpath) -> Iterator[Tag]:
    """The moves of a path, in their order."""
    climb = np.einsum("ij,ij->i", path.end - path.start, path.axis)
    columns = (path.kind, path.start, path.end, climb, path.is_motion)
    for row, (kind, start, end, rise, moves) in enumerate(zip(*(column.tolist() for column in columns))):
        if not moves:
            continue
        layer = LAYERS[Kind(kind)][0]
        if kind != Kind.ARC:
            yield from [(0, "LINE"), (8, layer), *_point(start), *_point(end, 11)]
        elif abs(rise) > 1e-9:
            yield from polyline(path[row : row + 1].points(CHORD)[0].tolist(), layer)
        else:
            yield from arc(path, row, layer)


def arc(path: Toolpath, row: int, layer: str) -> Iterable[Tag]:
    """An arc in the coordinates of its plane, always counter-clockwise about the extrusion; whole turns are a circle."""
    axis, centre, sweep = path.axis[row], path.centre[row], float(path.sweep[row])
    basis = plane(axis)
    spoke = basis @ (path.start[row] - centre)
    middle = basis @ centre
    middle[2] = float(axis @ path.start[row])
    head = [(8, layer), *_point(middle), (40, float(np.hypot(spoke[0], spoke[1])))]
    extrusion = list(_point(axis, 210)) if axis[2] != 1.0 else []
    if abs(sweep) >= 2 * np.pi - 1e-12:
        return [(0, "CIRCLE"), *head, *extrusion]
    angle = np.arctan2(spoke[1], spoke[0])
    ends = np.degrees([angle, angle + sweep] if sweep > 0 else [angle + sweep, angle]) % 360.0
    return [(0, "ARC"), *head, (50, float(ends[0])), (51, float(ends[1])), *extrusion]


def plane(axis: NDArray[np.float64]) -> NDArray[np.float64]:
    """Unit vectors (3, 3) of the coordinates that DXF gives a plane by its normal (the format's arbitrary axis)."""
    near_z = abs(axis[0]) < 1 / 64 and abs(axis[1]) < 1 / 64
    first = np.cross([0.0, 1.0, 0.0] if near_z else [0.0, 0.0, 1.0], axis)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(axis, first), axis])


def polyline(points: list[list[float]], layer: str) -> Iterator[Tag]:
    """A line through points in space."""
    yield from [(0, "POLYLINE"), (8, layer), (66, 1), *_point((0.0, 0.0, 0.0)), (70, 8)]
    for point in points:
        yield from [(0, "VERTEX"), (8, layer), *_point(point), (70, 32)]
    yield from [(0, "SEQEND"), (8, layer)]


def _point(xyz: Iterable[float], code: int = 10) -> Iterator[Tag]:
    yield from ((code + 10 * k, float(value)) for k, value in enumerate(xyz))

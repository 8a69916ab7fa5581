"""Contours out of a DXF drawing (needs ezdxf: the extra `dxf`). Lengths in mm.

Lines, arcs, circles and polylines with bulges come exactly; splines and ellipses as chords within a tolerance. Where the
file says in which unit it is drawn it is brought to mm.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.vectors import at_angle
from mnclab.text.alarm import Alarm
from mnclab.text.extras import require
from mnclab.text.file import read
from mnclab.text.given import check_number, shown

TO_MM = {1: 25.4, 2: 304.8, 4: 1.0, 5: 10.0, 6: 1000.0, 8: 2.54e-5, 9: 0.0254, 10: 914.4, 13: 1e-3, 14: 100.0}


def contours(source: str | Path, tolerance: float = 0.01, layer: str | None = None) -> list[Contour]:
    """All contours of the model space of a file, or of one layer; pieces are not yet joined (`drawings.joined`).

    Raises ValueError where the file is no DXF, Alarm where there is none and without ezdxf.
    """
    require("ezdxf", "DXF drawings", "dxf")
    import ezdxf

    if not isinstance(source, str | Path):
        raise Alarm(f"a DXF drawing is the path of a file, got {shown(source)}")
    check_number(tolerance, "the tolerance (mm)")
    if not tolerance > 0:
        raise ValueError(f"the tolerance must be greater than 0, got {tolerance:g}")
    read(source, source)  # refuses what is no file, which would be waited for
    try:
        drawing = ezdxf.readfile(str(source))
    except (ezdxf.DXFError, UnicodeDecodeError, OSError) as error:
        raise ValueError(f"{source} is no DXF: {error}") from None
    scale = TO_MM.get(int(drawing.header.get("$INSUNITS", 0)), 1.0)
    entities = [entity for entity in drawing.modelspace() if layer is None or entity.dxf.layer == layer]
    found = [contour for entity in entities for contour in _contours(entity, tolerance / scale)]
    return [Contour(contour.points * scale, contour.bulge, contour.closed) for contour in found]


def _contours(entity: Any, tolerance: float) -> Iterator[Contour]:
    kind = entity.dxftype()
    if kind == "LINE":
        yield Contour([_flat(entity.dxf.start), _flat(entity.dxf.end)], closed=False)
    elif kind == "CIRCLE":
        yield Contour.circle(_flat(entity.ocs().to_wcs(entity.dxf.center)), entity.dxf.radius)
    elif kind == "ARC":
        first, last = np.radians([entity.dxf.start_angle, entity.dxf.end_angle])
        sweep = np.mod(last - first, 2 * np.pi) or 2 * np.pi
        bulge = float(np.tan(sweep / 8)) * _side(entity)
        arms = entity.dxf.radius * at_angle(first + sweep * np.array([0, 0.5, 1]))
        spots = [entity.ocs().to_wcs(entity.dxf.center + (x, y, 0.0)) for x, y in arms.tolist()]
        yield Contour([_flat(spot) for spot in spots], [bulge, bulge, 0.0], closed=False)
    elif kind == "LWPOLYLINE":
        rows = np.array(entity.get_points("xyb"), dtype=float).reshape(-1, 3)
        if len(rows) > 1:
            yield Contour(rows[:, :2] * (_side(entity), 1.0), _side(entity) * rows[:, 2], closed=bool(entity.closed))
    elif kind == "POLYLINE" and entity.is_2d_polyline:
        rows = np.array([(*_flat(v.dxf.location), v.dxf.bulge) for v in entity.vertices], dtype=float).reshape(-1, 3)
        if len(rows) > 1:
            yield Contour(rows[:, :2], rows[:, 2], closed=bool(entity.is_closed))
    elif kind in ("SPLINE", "ELLIPSE"):
        points = np.array([_flat(point) for point in entity.flattening(tolerance)])
        closed = bool(np.hypot(*(points[-1] - points[0])) < 1e-9 * (1 + np.abs(points).max()))
        yield Contour(points[:-1] if closed else points, closed=closed)


def _side(entity: Any) -> float:
    """-1 for what is seen from behind."""
    return -1.0 if entity.dxf.extrusion.z < 0 else 1.0


def _flat(point: Any) -> tuple[float, float]:
    return float(point[0]), float(point[1])

"""Cut faces are hatched: thin lines at 45°, interrupted where a text stands."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mnclab.design.drawing.ink import corners_of
from mnclab.geometry import shapely
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region

CHORD = 0.02  # mm on paper
WIDE, CLOSE = 3.0, 1.2  # mm between the lines of a large face, of a small one
AIR = 0.8  # mm around a text


def hatching(faces: Sequence[Region], scale: float, boxes: Floats) -> Floats:
    """Straight lines `(n, 2, 2)` on paper; they keep away from the boxes `(k, 6)` of texts."""
    rings = [loop.points_within(CHORD / scale) * scale for face in faces for loop in face.loops]
    if not rings:
        return np.zeros((0, 2, 2))
    area = shapely.Polygon()
    for ring in rings:  # a point within an odd number of loops is cut
        area = shapely.symmetric_difference(area, shapely.make_valid(shapely.Polygon(ring)))
    size = math.sqrt(abs(area.area))
    step = min(WIDE, max(CLOSE, size / 8))
    if len(boxes):
        texts = shapely.union_all([shapely.Polygon(corners) for corners in corners_of(boxes)])
        area = shapely.difference(area, shapely.buffer(texts, AIR, join_style="mitre"))
    if area.is_empty:
        return np.zeros((0, 2, 2))
    x0, y0, x1, y1 = area.bounds
    # a line x - y = c for every multiple of the step: those of all views of a part fit each other
    pitch = step * math.sqrt(2)
    offsets = np.arange(math.ceil((x0 - y1) / pitch), math.floor((x1 - y0) / pitch) + 1) * pitch
    ends = np.stack([np.stack([offsets + y, np.full_like(offsets, y)], axis=-1) for y in (y0, y1)], axis=1)
    lines = shapely.intersection(shapely.linestrings(ends), area)
    parts = shapely.get_parts(shapely.get_parts(lines))
    parts = parts[shapely.get_type_id(parts) == 1]
    found = shapely.get_coordinates(parts).reshape(-1, 2, 2)
    return np.asarray(found[np.hypot(*(found[:, 1] - found[:, 0]).T) > 0.2])

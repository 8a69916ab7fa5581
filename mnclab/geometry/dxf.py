"""Contours out of a DXF drawing (needs ezdxf: the extra `dxf`). Lengths in mm.

Lines, arcs, circles and polylines with bulges come exactly; splines and ellipses as chords within a tolerance. Blocks are
placed as their INSERT says: within each other, scaled, mirrored, turned, in rows and columns; what is scaled unequally
becomes ellipses. Where the file says in which unit it is drawn ($INSUNITS) it is brought to mm, else its numbers are mm. Many
programs write a unit that nobody chose: a warning names it where that makes more than `LONG` of the drawing.

What bounds no area (`WRITTEN`: text, dimensions, …) is left out, and a warning names it; another entity is an Alarm.
"""

from __future__ import annotations

import logging
import warnings
from collections import Counter
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, at_angle
from mnclab.geometry.drawings import FARTHEST, MOST
from mnclab.text.alarm import Alarm
from mnclab.text.file import read
from mnclab.text.given import check_number, shown
from mnclab.text.opening import require

TO_MM = {0: 1.0, 1: 25.4, 2: 304.8, 4: 1.0, 5: 10.0, 6: 1000.0, 8: 2.54e-5, 9: 0.0254, 10: 914.4, 13: 1e-3, 14: 100.0}
LONG = 10_000  # mm, longer than parts are
FLAT = ("CIRCLE", "ARC", "LWPOLYLINE", "POLYLINE")  # drawn in a plane of their own
READ = (*FLAT, "LINE", "SPLINE", "ELLIPSE")
WRITTEN = {
    "TEXT", "MTEXT", "ATTDEF", "ATTRIB", "DIMENSION", "ARC_DIMENSION", "LARGE_RADIAL_DIMENSION", "LEADER", "MULTILEADER",
    "TOLERANCE", "POINT", "HATCH", "MPOLYGON", "VIEWPORT", "IMAGE", "WIPEOUT", "ACAD_TABLE", "OLE2FRAME", "LIGHT", "SUN",
    "PDFUNDERLAY", "DWFUNDERLAY", "DGNUNDERLAY", "GEOPOSITIONMARKER", "ACAD_PROXY_ENTITY",
}  # fmt: skip
FRAME = 16  # flag of a vertex that only steers a fitted curve
DEGREE = 15  # of a spline
DEEPEST = 50  # blocks within blocks
ENTITIES, VALUES = 10_000, 200_000  # of a drawing: more would be waited for
PER_LINE = 12  # values that a line has
FEWER = "save the part or the layer that is meant in a file of its own, with its short lines joined to polylines"


def contours(source: str | Path, tolerance: float = 0.01, layer: str | None = None) -> list[Contour]:
    """All contours of the model space of a file, or of one layer; pieces are not yet joined (`drawings.joined`).

    What a block draws on layer 0 is on the layer of its INSERT. An Alarm where the file is no DXF or there is none, for
    an entity that is not read, and without ezdxf.
    """
    require("ezdxf", "DXF drawings", "dxf")
    import ezdxf

    if not isinstance(source, str | Path):
        raise Alarm(f"a DXF drawing is the path of a file, got {shown(source)}")
    check_number(tolerance, "the tolerance (mm)", above=0)
    values = read(source, source).count(b"\n") // 2  # which also refuses what is no file, and would be waited for
    if values > VALUES:
        raise Alarm(f"{source} has {values} values, as {values // PER_LINE} lines have; at most {VALUES} are read", hint=FEWER)
    said, named = _Said(logging.WARNING), ""
    logger = logging.getLogger("ezdxf")
    logger.addHandler(said)  # which also keeps it off stderr
    try:
        drawing = ezdxf.readfile(str(source))
        unit = int(drawing.header.get("$INSUNITS", 0))
        if unit not in TO_MM:
            raise Alarm(f"its unit, $INSUNITS {unit}, is not read", hint="save it in mm")
        scale, named = TO_MM[unit], f", drawn in {ezdxf.units.unit_name(unit)} ($INSUNITS {unit})" if TO_MM[unit] != 1 else ""
        _entities(drawing.modelspace(), {}, 0)
        reading = _Reading(layer, tolerance / scale, FARTHEST / scale)
        if layer is None:
            reading.frozen = {each.dxf.name.lower() for each in drawing.layers if each.is_frozen()}
            reading.off = {each.dxf.name.lower() for each in drawing.layers if each.is_off()}
        found = [contour for entity in drawing.modelspace() for contour in reading.contours(entity, None, 0)]
    except Alarm as alarm:
        raise Alarm(f"{source}{named}: {alarm.message}", hint=alarm.hint) from None
    except Exception as error:  # whatever a reader of files trips over
        raise Alarm(f"{source} is no DXF: {error or type(error).__name__}") from None
    finally:
        logger.removeHandler(said)
    if said.texts:
        warnings.warn(f"{source} is damaged: {'; '.join(said.texts[:3])}", stacklevel=2)
    if reading.left:
        names = ", ".join(f"{count} {kind}" for kind, count in sorted(reading.left.items()))
        warnings.warn(f"{source}: {names} left out, which bound no area", stacklevel=2)
    if reading.unseen:
        names = ", ".join(f"{count} on {name!r}" for name, count in sorted(reading.unseen.items()))
        told = f"{names} left out, which the drawing does not show (off, frozen or invisible; layer= reads a layer all the same)"
        warnings.warn(f"{source}: {told}", stacklevel=2)
    found = [Contour(contour.points * scale, contour.bulge, contour.closed) for contour in found]
    if named and found and (size := np.ptp([contour.bounds for contour in found], axis=(0, 1)).max()) > LONG:
        warnings.warn(f"{source}{named}: {size / 1000:g} m long", stacklevel=2)
    return found


def _entities(space: Any, known: dict[str, int], depth: int) -> int:
    """How many entities there are, those of blocks as often as they are inserted: an Alarm where they are too many to read."""
    count = len(space)
    for insert in space.query("INSERT"):
        block, name = insert.block(), insert.dxf.name.lower()
        if insert.mcount > ENTITIES:
            raise Alarm(f"{_named(insert)} places its block {insert.mcount} times, at most {ENTITIES} are read")
        if depth == DEEPEST:
            raise Alarm(f"{_named(insert)} lies in {DEEPEST} blocks within each other")
        if block is not None and name not in known:
            known[name] = _entities(block, known, depth + 1)
        count += insert.mcount * known.get(name, 0)
    if count > ENTITIES:
        counted = f"{count} entities or more, blocks counted as often as they are inserted"
        raise Alarm(f"the drawing has {counted}; at most {ENTITIES} are read", hint=FEWER)
    return count


class _Said(logging.Handler):
    """What ezdxf says of a file that it mends, or reads in part."""

    def __init__(self, level: int) -> None:
        super().__init__(level)
        self.texts: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.texts.append(record.getMessage())


class _Reading:
    """What is read of a drawing, within a tolerance and up to a distance in its own unit; `left` counts what is not."""

    def __init__(self, layer: str | None, tolerance: float, farthest: float) -> None:
        self.layer, self.tolerance, self.farthest = layer, tolerance, farthest
        self.left: Counter[str] = Counter()
        self.frozen, self.off = set[str](), set[str]()
        self.unseen: Counter[str] = Counter()  # by layer

    def contours(self, entity: Any, within: str | None, depth: int) -> Iterator[Contour]:
        """The contours of an entity on its layer, or on that of the block it is `within`."""
        kind, layer = entity.dxftype(), entity.dxf.layer
        layer = within if within is not None and layer == "0" else layer
        if self._hidden(entity, kind, layer.lower()):
            self.unseen[layer] += 1
        elif kind == "INSERT":
            yield from self._block(entity, layer, depth)
        elif self.layer is not None and layer != self.layer:
            return
        elif kind in WRITTEN:
            self.left[kind] += 1
        elif kind not in READ or (kind == "POLYLINE" and not (entity.is_2d_polyline or entity.is_3d_polyline)):
            raise Alarm(f"{_named(entity)} is not read", hint="explode it, or choose the layer of the contours: layer=…")
        else:
            for contour in _contours(entity, self.tolerance, self.farthest):
                if not np.abs(contour.bounds).max() <= self.farthest:
                    raise Alarm(f"{_named(entity)} reaches farther than {FARTHEST / 1000:g} m")
                yield contour

    def _hidden(self, entity: Any, kind: str, layer: str) -> bool:
        """Whether the drawing does not show it; of a block whose layer is off the other layers are seen."""
        return self.layer is None and (entity.dxf.invisible or layer in self.frozen or (kind != "INSERT" and layer in self.off))

    def _block(self, insert: Any, layer: str, depth: int) -> Iterator[Contour]:
        if insert.block() is None:
            raise Alarm(f"{_named(insert)} places the block {insert.dxf.name!r}, which the file does not have")
        if not (insert.dxf.xscale and insert.dxf.yscale):  # else placed at full size
            raise Alarm(f"{_named(insert)} places the block {insert.dxf.name!r} at a scale of 0")
        if depth == DEEPEST:
            raise Alarm(f"{_named(insert)} lies in {DEEPEST} blocks within each other")
        for each in insert.multi_insert() if insert.mcount > 1 else (insert,):
            for entity in each.virtual_entities(skipped_entity_callback=_skipped):
                yield from self.contours(entity, layer, depth + 1)


def _skipped(entity: Any, reason: str) -> None:
    if entity.dxftype() not in WRITTEN:
        raise Alarm(f"{_named(entity)} of a block cannot be placed: {reason}")


def _named(entity: Any) -> str:
    return f"{entity.dxftype()} on layer {entity.dxf.layer!r}"


def _contours(entity: Any, tolerance: float, farthest: float) -> Iterator[Contour]:
    kind = entity.dxftype()
    if kind in FLAT and not (kind == "POLYLINE" and entity.is_3d_polyline):
        tilt = entity.dxf.extrusion
        if np.hypot(tilt.x, tilt.y) > 1e-9 * abs(tilt.z):
            raise Alarm(f"{_named(entity)} is tilted out of the XY plane (extrusion {tilt.x:g}, {tilt.y:g}, {tilt.z:g})")
    if kind in ("CIRCLE", "ARC") and not entity.dxf.radius > 0:
        raise Alarm(f"{_named(entity)} has the radius {entity.dxf.radius:g}")
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
    elif kind == "POLYLINE":
        corners = [v for v in entity.vertices if not v.dxf.flags & FRAME]
        rows = np.array([(*_flat(v.dxf.location), v.dxf.bulge) for v in corners], dtype=float).reshape(-1, 3)
        if len(rows) > 1:
            side = 1.0 if entity.is_3d_polyline else _side(entity)
            yield Contour(rows[:, :2] * (side, 1.0), side * rows[:, 2], closed=bool(entity.is_closed))
    else:
        points = _ellipse(entity, tolerance, farthest) if kind == "ELLIPSE" else _spline(entity, tolerance, farthest)
        closed = bool(np.hypot(*(points[-1] - points[0])) < 1e-9 * (1 + np.abs(points).max()))
        yield Contour(points[:-1] if closed else points, closed=closed)


def _ellipse(entity: Any, tolerance: float, farthest: float) -> Floats:
    """Chords (n, 2): over an angle d the curve rises by at most R d² / 8 above one, R its longer half axis."""
    middle, long, short = (np.array(_flat(each)) for each in (entity.dxf.center, entity.dxf.major_axis, entity.minor_axis))
    size = max(float(entity.dxf.major_axis.magnitude), float(entity.minor_axis.magnitude))
    first, last = float(entity.dxf.start_param), float(entity.dxf.end_param)
    if not np.abs(middle).max() + size <= farthest:
        raise Alarm(f"{_named(entity)} reaches farther than {FARTHEST / 1000:g} m")
    sweep = np.mod(last - first, 2 * np.pi) or 2 * np.pi
    count = _count(entity, sweep * np.sqrt(size / (8 * tolerance)))
    angle = (first + sweep * np.arange(count + 1) / count)[:, None]
    return np.asarray(middle + np.cos(angle) * long + np.sin(angle) * short)


def _spline(entity: Any, tolerance: float, farthest: float) -> Floats:
    """Chords (n, 2), which ezdxf finds between knots that go up."""
    knots, weights = np.array(entity.knots, dtype=float), np.array(entity.weights, dtype=float)
    spots = np.array([tuple(point) for point in (*entity.control_points, *entity.fit_points)], dtype=float)
    if not len(spots) or not np.abs(spots).max() <= farthest:
        raise Alarm(f"{_named(entity)} " + (f"reaches farther than {FARTHEST / 1000:g} m" if len(spots) else "has no points"))
    steps = np.diff(knots)
    if len(knots) and not ((steps >= 0).all() and 1e-9 < steps.max(initial=0.0) < 1e9 and steps[steps > 0].min() > 1e-9):
        raise Alarm(f"{_named(entity)} has knots that do not go up")
    if not ((weights > 1e-6) & (weights < 1e6)).all() or not 1 <= entity.dxf.degree <= DEGREE:
        raise Alarm(f"{_named(entity)} has weights or a degree that no curve has")
    _count(entity, len(spots) * np.sqrt(np.ptp(spots, axis=0).max() / tolerance))
    return np.array([_flat(point) for point in islice(entity.flattening(tolerance), MOST)])


def _count(entity: Any, pieces: float) -> int:
    if not pieces <= MOST:
        raise Alarm(f"{_named(entity)} would be more than {MOST} chords at this tolerance", hint="a greater tolerance")
    return max(2, int(np.ceil(pieces)))


def _side(entity: Any) -> float:
    """-1 for what is seen from behind."""
    return -1.0 if entity.dxf.extrusion.z < 0 else 1.0


def _flat(point: Any) -> tuple[float, float]:
    return float(point[0]), float(point[1])

"""Infeed points: the largest disc in an area, beside shapely on fine arcs, in few tries."""

from __future__ import annotations

import pytest
from shapely import maximum_inscribed_circle

from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import polygons
from mnclab.machining.milling.terraces import roomiest


def test_the_way_to_the_top_is_short(monkeypatch):
    """A rounded rectangle with a round island: the ridge between them and the right side is flat, the way along it long."""
    outside = rectangle(79.6, 49.6, 4.8, centre=(45, 30))
    piece = Region.of(outside, holes=[Contour.circle((30, 30), 15.2)])
    exact, tries = piece.distance, []
    monkeypatch.setattr(Region, "distance", lambda self, points: tries.append(len(points)) or exact(points))
    room = float(exact([roomiest(piece)])[0])
    assert room == pytest.approx(maximum_inscribed_circle(polygons(piece), 1e-5).length, abs=2e-4)
    assert len(tries) < 200

"""Which of several readings of a free contour is meant: closed, inside the blank, not crossing itself."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mnclab.controls.tnc_620.free_contours.free_contour import Piece
from mnclab.geometry.arcs import sweep_of_one
from mnclab.geometry.curves import Curves, Floats, cross, distance, length_of, turned

CLOSED = 1e-3  # mm between the end and the start of a closed contour
STEPS = 48  # chords of an element
ALONG = 1e-6  # mm: a point inside one element as near to another lies on it


def outline(pieces: Sequence[Piece]) -> Floats:
    """Points (n, STEPS + 1, 2) along n elements, from start to end."""
    shares = np.linspace(0, 1, STEPS + 1)[:, None]
    found = []
    for piece in pieces:
        start, end = np.array(piece.start), np.array(piece.end)
        if piece.centre is None:
            found.append(start + shares * (end - start))
            continue
        angle = sweep_of_one(piece.start, piece.end, piece.centre, piece.sense) * shares[:, 0]
        found.append(piece.centre + turned(start - piece.centre, angle))
    return np.array(found)


def is_closed(pieces: Sequence[Piece], start: tuple[float, float]) -> bool:
    """Whether the last element ends at a point."""
    return bool(np.hypot(*np.subtract(pieces[-1].end, start)) < CLOSED)


def is_within(pieces: Sequence[Piece], low: Sequence[float], high: Sequence[float]) -> bool:
    """Whether the elements stay in a rectangle."""
    points = outline(pieces).reshape(-1, 2)
    return bool((points >= np.array(low) - CLOSED).all() and (points <= np.array(high) + CLOSED).all())


def crosses_itself(pieces: Sequence[Piece]) -> bool:
    """Whether the path runs through itself or along itself; touching at a point is neither."""
    points = outline(pieces)
    apart = (1e-9 * max(1.0, float(np.ptp(points))) ** 2) ** 2
    low, high = points.min(axis=1) - ALONG, points.max(axis=1) + ALONG
    near = (low[:, None] <= high).all(axis=2) & (low <= high[:, None]).all(axis=2)  # boxes around the elements
    curves = _curves(pieces)
    for k, other in np.argwhere(near & ~np.eye(len(points), dtype=bool)):
        a, b = points[k, :-1, None], points[k, 1:, None]
        c, d = points[other, :-1], points[other, 1:]
        across = cross(b - a, c - a) * cross(b - a, d - a) < -apart  # c and d on two sides of a -> b
        across &= cross(d - c, a - c) * cross(d - c, b - c) < -apart
        if across.any() or (distance(points[k, 1:-1], curves.take(np.full(STEPS - 1, other))) < ALONG).any():
            return True
    return False


def _curves(pieces: Sequence[Piece]) -> Curves:
    start, end = (np.array([getattr(piece, name) for piece in pieces]) for name in ("start", "end"))
    centre = np.array([piece.centre or (np.nan, np.nan) for piece in pieces])
    sweep = [sweep_of_one(p.start, p.end, p.centre, p.sense) if p.centre else 0.0 for p in pieces]
    return Curves(start, end, centre, length_of(start - centre), np.array(sweep))

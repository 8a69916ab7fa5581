"""A cell of a lattice divided by the walls that cross it: a table of triangles for every case.

          e2              corners c0 … c3 and edges e0 … e3 run counter-clockwise, edge k from corner k on;
      c3 ---- c2          a wall on edge k has two local vertices: 4 + 2k on the side of corner k,
    e3 |      | e1        5 + 2k on the side of the next corner.
      c0 ---- c1
          e0

Two walls divide a cell in two, and between the two stands the wall itself; four cut off two opposite corners. A
wall that does not divide its cell is an upright edge of its outline, so that neighbouring cells always meet.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Triangles(NamedTuple):
    """Local vertices (t, 3), and two corners for each (t, 2): where both are one, that of the piece, else those on both
    sides of the wall that the triangle is a piece of."""

    corners: NDArray[np.int64]
    beside: NDArray[np.int64]


@cache
def divided(walls: int, dividing: int, diagonal: int) -> Triangles:
    """The triangles of a cell: `walls` and `dividing` have a bit for each edge; `diagonal` 0 or 1 is the corner that stays
    joined to the opposite one where all four edges divide."""
    parts = [k for k in range(4) if dividing >> k & 1]
    pieces: list[tuple[list[int], int, int]] = []
    if not parts:
        pieces.append((_outline(walls, 0, 3), 0, 0))
    elif len(parts) == 2:
        p, q = parts
        pieces.append(([5 + 2 * p, *_inside(walls, p + 1, q), 4 + 2 * q], p + 1, p + 1))
        pieces.append(([5 + 2 * q, *_inside(walls, q + 1, p + 4), 4 + 2 * p], p, p))
        pieces.append(([4 + 2 * p, 5 + 2 * p, 4 + 2 * q, 5 + 2 * q], p, p + 1))
    else:
        d = diagonal
        pieces.append(([d, 4 + 2 * d, 7 + 2 * d, d + 2, 8 + 2 * d, 5 + 2 * ((d + 3) % 4)], d, d))
        for c in (d + 1, (d + 3) % 4):
            before = (c - 1) % 4
            pieces.append(([5 + 2 * before, c, 4 + 2 * c], c, c))
            pieces.append(([4 + 2 * before, 5 + 2 * before, 4 + 2 * c, 5 + 2 * c], before, c))
    fans = [((poly[0], a, b), one, other) for poly, one, other in pieces for a, b in zip(poly[1:], poly[2:])]
    beside = [(one % 4, other % 4) for _, one, other in fans]
    return Triangles(np.array([fan for fan, _, _ in fans]), np.array(beside))


def _outline(walls: int, first: int, last: int) -> list[int]:
    """Corners from one to another, each with the wall on the edge behind it."""
    found = []
    for corner in range(first, last + 1):
        k = corner % 4
        found += [k, 4 + 2 * k, 5 + 2 * k] if walls >> k & 1 else [k]
    return found


def _inside(walls: int, first: int, last: int) -> list[int]:
    """The same without what is on the edge behind the last one."""
    return [*_outline(walls, first, last - 1), last % 4]

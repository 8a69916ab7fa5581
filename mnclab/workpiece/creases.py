"""The edges of a body: lines where two of its faces meet at an angle."""

from __future__ import annotations

import numpy as np

from mnclab.path.toolpath import Array, Index
from mnclab.workpiece.workpiece import Solid

SHARP = np.cos(np.radians(25.0))  # of the angle between two faces from which on their edge is one
STRAIGHT = 0.02  # mm, within which a line is straight


def creases(solid: Solid) -> list[Array]:
    """Lines (k, 3), mm; those that go round end where they begin."""
    a, b, c = solid.points[solid.triangles].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    sides = np.concatenate([solid.triangles[:, [i, j]] for i, j in ((0, 1), (1, 2), (2, 0))])
    face = np.tile(np.arange(len(solid.triangles)), 3)
    order = np.lexsort(np.sort(sides, axis=1).T)
    one, other = face[order[::2]], face[order[1::2]]  # every edge is one of two triangles
    sharp = (normal[one] * normal[other]).sum(axis=1) < SHARP
    return [_straightened(solid.points[line]) for line in _lines(np.sort(sides[order[::2]][sharp], axis=1))]


def _lines(edges: Index) -> list[list[int]]:
    """Edges (e, 2) as lines of vertices, from one where more or fewer than two meet to the next."""
    beside: dict[int, list[int]] = {}
    for p, q in edges.tolist():
        beside.setdefault(p, []).append(q)
        beside.setdefault(q, []).append(p)
    found, left = [], set(map(tuple, edges.tolist()))
    ends = sorted(beside, key=lambda vertex: len(beside[vertex]) == 2)  # what goes round has no end: it is left to the last
    for first in ends:
        for following in beside[first]:
            line, here = [first], following
            while (edge := (min(line[-1], here), max(line[-1], here))) in left:
                left.remove(edge)
                line.append(here)
                if len(beside[here]) != 2:
                    break
                here = next((each for each in beside[here] if each != line[-2]), here)
            if len(line) > 1:
                found.append(line)
    return found


def _straightened(line: Array) -> Array:
    """A line (k, 3) without the points that lie on a straight stretch."""
    keep = np.zeros(len(line), dtype=bool)
    keep[[0, -1]] = True
    stack = [(0, len(line) - 1)]
    while stack:
        a, b = stack.pop()
        if b - a < 2:
            continue
        way, off = line[b] - line[a], line[a + 1 : b] - line[a]
        length = float(np.linalg.norm(way))
        far = np.linalg.norm(np.cross(off, way / length), axis=1) if length > STRAIGHT else np.linalg.norm(off, axis=1)
        if far.max() > STRAIGHT:
            k = a + 1 + int(far.argmax())
            keep[k] = True
            stack += [(a, k), (k, b)]
    return line[keep]

"""What a tool sweeps and where it may go, by shapely alone, as polygons within a `hair` (mm) of the truth.

GEOS simplifies what it buffers by a hundredth of the distance, so areas grow and shrink here piece by piece: the hull of two
equal discs about the ends of every straight piece. Discs are polygons inside the truth where they stand for the tool,
outside it where they stand for a wall. Pieces are `(k, 2, 2)`: begin and end of each. Lengths in mm.
"""

import numpy as np
import shapely


def capsules(pieces, distance, outside, hair):
    """What lies within a distance of straight pieces, a hair too much or too little."""
    if not len(pieces):
        return shapely.Polygon()
    half = max(8, int(np.ceil(np.pi / np.arccos(1 - hair / distance) / 2)))
    angle = np.pi * np.arange(half + 1) / half - np.pi / 2
    begin, end = pieces[:, 0], pieces[:, 1]
    way = np.arctan2(*(end - begin).T[::-1])[:, None]
    reach = distance / np.cos(np.pi / half / 2) if outside else distance
    caps = [place[:, None] + reach * np.stack([np.cos(a), np.sin(a)], axis=2)
            for place, a in ((end, way + angle), (begin, way + angle + np.pi))]  # fmt: skip
    return shapely.union_all(shapely.polygons(np.concatenate(caps, axis=1)))


def ring_pieces(ring):
    """The pieces of a ring of corners `(n, 2)`."""
    return np.stack([ring, np.roll(ring, -1, axis=0)], axis=1)


def edges(area):
    """The pieces of all rings of a shapely area."""
    points, ring = shapely.get_coordinates(shapely.get_rings(shapely.get_parts(area)), return_index=True)
    return np.stack([points[:-1], points[1:]], axis=1)[ring[1:] == ring[:-1]]


def polygonal(area):
    """A shapely area without loose lines and points."""
    parts = shapely.get_parts(shapely.get_parts(area))
    return shapely.union_all(parts[shapely.area(parts) > 0])


def shrunk(area, distance, hair, surely):
    """What of an area is farther than a distance from its edge; `surely` without what may only seem so."""
    gone = capsules(edges(area), distance + hair * surely, surely, hair)
    return shapely.simplify(polygonal(shapely.difference(area, gone)), hair / 4)


def within_reach(area, centres, reach):
    """How many pieces of the edge of an area are nearer than `reach` to some centres; those within it count as well."""
    tree = shapely.STRtree(shapely.linestrings(edges(centres)))
    near = np.unique(tree.query(shapely.linestrings(edges(area)), predicate="dwithin", distance=reach)[0])
    inside = shapely.contains_properly(area, shapely.get_parts(centres)) if len(near) == 0 else []
    return len(near) + int(np.sum(inside))


def grown(area, distance, hair):
    """What is nearer than a distance to an area, a hair too little."""
    return shapely.union(area, capsules(edges(area), distance, False, hair))

"""What stands before a mill, at places of its way: how deep and how wide it is in the material, and the cross-section.

At a place the front half of the rim is looked at, degree by degree: what stands higher there than the edge, before the row
began, is cut. Where the depth jumps between two of them, at a wall, its angle is found by halving. With θ from the heading
and the radius R the width of cut is ae = R ∫ cos θ dθ over the engaged part, and the cross-section R ∫ a cos θ dθ of the
depths a. The lower side adds its faces that go ahead into the material, ring by ring:
those of round corners and cones, and of discs that go down. Exact but for slopes within a degree, and the rings.

ap is how far the tip, the lowest point of a tool, lies below the highest material that the front meets. Of a ball and of a
round corner ae is the width of cut at that material's top, where the tool is as wide as the cap or the ring that is ap deep:
of a slot with a ball 2 √(ap (D - ap)), the effective diameter of the tool makers' catalogues, of a pass beside one the way
between them; ISO 3002-3 measures ae across the feed. Their chip has no one thickness: it thins with sin κ along the edge.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np

from mnclab.path.places import along
from mnclab.path.toolpath import Array, Index, Kind
from mnclab.workpiece.ahead import Ahead
from mnclab.workpiece.milling.moves import Moves, edge_height, moves_of
from mnclab.workpiece.milling.sweep import Points, depths
from mnclab.workpiece.workpiece import Workpiece

BETWEEN = np.radians(np.arange(-90.0, 91.0))
RIM, AROUND = np.radians(np.arange(-89.5, 90.0, 1.0)), np.radians(np.arange(-172.5, 180.0, 15.0))
TURN = np.radians(15.0)
JUMP, HALVINGS = 0.02, 12  # of the depth between two degrees, at a wall; of the degree until its angle is known, to 0.0003
INSIDE, LEAST, UPRIGHT = 1 - 1e-6, 1e-3, 1e-6
SPOTS = np.array([0.15, 0.5, 0.85, INSIDE])  # of the radius, where it is seen how high material stands
FLAT, BENT = 4, 12  # rings of the flat and of the rising part of the lower side
WIDE = 2.0  # radii that the rim is wide
SAME = 1e-8  # mm, by which the ends of ways differ that are one


class Engaged(Workpiece):
    """A part that a mill cuts by its `moves`."""

    moves: Moves

    @cached_property
    def boxes(self) -> Array:
        """What each of the moves, arcs in quarters, reaches in the plane (k, 4)."""
        return self.quarters[0].boxes

    def reach(self, rows: Index) -> Array:
        """The shares (2, k) of rows between which their tools may meet the blank; arcs may everywhere."""
        path, (low, high) = self.cutting.path, self.bounds
        radius = np.array([tool.effective_radius for tool in self.cutting.tools])[self.cutting.which[rows]]
        wide, start = radius[:, None] * (1.0, 1.0, 0.0), path.start[rows]
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = np.stack([(low - (0, 0, np.inf)) - wide - start, high + wide - start]) / (path.end[rows] - start)
        ends.sort(axis=0)
        found = np.stack([np.fmax.reduce(ends[0], axis=1), np.fmin.reduce(ends[1], axis=1)]).clip(0.0, 1.0)
        found[:, path.kind[rows] == Kind.ARC] = [[0.0], [1.0]]
        return np.maximum.accumulate(found)

    @cached_property
    def quarters(self) -> tuple[Moves, Index, Index]:
        """The moves, arcs that come round to where they have cut in quarters; the first part of each row and how many it has."""
        path = self.cutting.path
        round_ = (path.kind == Kind.ARC) & (np.abs(path.sweep) > np.pi + 1e-9)
        counts = np.where(round_, np.ceil(np.abs(path.sweep) / (np.pi / 2)), 1).astype(np.int64)
        moves = moves_of(self.cutting.divided(counts)) if round_.any() else self.moves
        return moves, np.cumsum(counts) - counts, counts

    def ahead(self, rows: Index, share: Array) -> Ahead:
        """What stands before the tools of rows (k,) when a share (k,) of their way is behind."""
        (moves, first, counts), found = self.quarters, Ahead.none(len(rows))
        own = first[rows] + np.minimum(share * counts[rows], counts[rows] - 1).astype(np.int64)
        move = np.searchsorted(moves.row, own)
        known = np.flatnonzero(np.append(moves.row, -1)[move] == own)  # a tilted tool has no move
        place, way = along(self.cutting.path, rows[known], share[known])
        move, across = move[known], np.hypot(way[:, 0], way[:, 1])
        flat, radius = moves.flat[move], moves.radius[move]

        def deep(some: Index, rho: Array, angle: Array, low: Array) -> tuple[Array, Array]:
            """How deep points about the axis are in the material, and whether the blank begins above them."""
            turned = np.arctan2(way[some, 1], way[some, 0])[:, None, None] + angle
            x, y = (place[some, k, None, None] + rho[:, :, None] * f(turned) for k, f in enumerate((np.cos, np.sin)))
            z = np.broadcast_to(low[:, :, None], x.shape).ravel()
            floor, top = self.cutting.stock.faces(x.ravel(), y.ravel())
            count = np.ones(x.shape, dtype=np.int64)
            at = Points(x.ravel(), y.ravel(), np.fmax(z, floor), (move[some, None, None] * count).ravel(), count.ravel())
            met = depths(moves, self.boxes, at, np.where(np.isnan(top), -np.inf, top))
            return np.where(met > LEAST, met, 0.0).reshape(x.shape), (floor > z).reshape(x.shape)

        def height(some: Index, rho: Array) -> Array:
            return edge_height(rho, *(column[move[some], None] for column in (moves.flat, moves.corner, moves.slope)))

        def front(which: Index, angle: Array, rho: Array, low: Array) -> Array:
            """How deep rings rho (k, 1) are in front, at angles (r,) or one of its own each (k,)."""
            angle = angle if angle is RIM else angle[:, None, None]
            return deep(which, rho * INSIDE, angle, low)[0][:, 0]

        # 1. the rim: how deep it is at each degree of its front, and where walls part one degree from the next
        some, rim = np.flatnonzero(across > UPRIGHT), np.zeros((len(known), len(RIM)))
        rho, low = radius[some, None], place[some, 2:] + height(some, radius[some, None])
        rim[some] = front(some, RIM, rho, low)
        begin, end = np.tile(BETWEEN[:-1], (len(known), 1)), np.tile(BETWEEN[1:], (len(known), 1))
        begin[some], end[some] = _walls(rim[some], lambda k, angle: front(some[k], angle, rho[k], low[k])[:, 0])
        cosines = np.sin(end) - np.sin(begin)  # of each part of the rim the integral
        found.area[known] = across * radius * (rim * cosines).sum(axis=1)
        plain, cuts, ap = (flat == radius) & (across > UPRIGHT), rim > 0, rim.max(axis=1)
        wide, angles = (cuts * cosines).sum(axis=1), (cuts * (end - begin)).sum(axis=1)
        chip = np.divide(wide, angles, out=np.zeros_like(wide), where=angles > 0)
        for column, values in zip(found[1:], (ap, radius * wide, chip)):
            column[known] = np.where(plain, values, 0.0)

        # 2. the lower side: of each of its rings what goes ahead into the material, and what goes down
        some = np.flatnonzero((flat < radius) | (way[:, 2] < -UPRIGHT))
        stands = deep(some, radius[some, None] * SPOTS, AROUND[::3], place[some, 2:])[0].max(axis=(1, 2), initial=0.0)
        edges = _rings(moves[move[some]], stands)
        low, middle, high = (height(some, edges)[:, k::2] for k in (0, 1, 2))
        inner, at, outer = (edges[:, k::2] for k in (0, 1, 2))
        low, inner = low[:, :-1], inner[:, :-1]
        met, off = deep(some, at, AROUND, place[some, 2:] + middle)
        rising = ((inner + at) * (middle - low) + (at + outer) * (high - middle))[:, :, None] / 2
        full = np.divide(met + (middle - low)[:, :, None], (high - low)[:, :, None], out=np.ones_like(met), where=rising > 0)
        rising = rising * full.clip(0.0, 1.0) * np.cos(AROUND) * 2 * np.sin(TURN / 2) * across[some, None, None]
        faces = rising - (way[some, 2, None] * (outer**2 - inner**2) / 2 * TURN)[:, :, None]
        found.area[known[some]] += np.where((met > 0) & (off == 0), faces, 0.0).clip(0.0).sum(axis=(1, 2))

        # 3. round edges: ap up to the highest material, and the width of cut there, on the ring that is as high
        round_ = (flat < radius) & (moves.slope[move] == 0) & (across > UPRIGHT)
        highest = np.where((met > 0) & (np.cos(AROUND) > 0), met + middle[:, :, None], 0.0).max(axis=(1, 2))
        ap[some] = np.maximum(highest, np.where(ap[some] > 0, ap[some] + height(some, radius[some, None])[:, 0], 0.0))
        some = np.flatnonzero(round_ & (ap > 2 * LEAST))
        cap = _rings(moves[move[some]], ap[some] - 2 * LEAST)[:, -1:]
        low = place[some, 2:] + height(some, cap)
        top = np.sign(front(some, RIM, cap, low))  # 1 where there is material
        begin, end = _walls(top, lambda k, angle: np.sign(front(some[k], angle, cap[k], low[k])[:, 0]))
        found.depth[known[some]] = ap[some]
        found.width[known[some]] = cap[:, 0] * (top * (np.sin(end) - np.sin(begin))).sum(axis=1)
        return found

    def at_most(self, rows: Index) -> Ahead:
        """No less than `ahead` finds anywhere on rows (k,).

        No depth is more than from the lowest place of the tip to the ceiling of the row. Across the way the front of the rim is
        `WIDE` radii wide, and so, below it, are the rings at most: both together make no more than depth times width. What goes
        down adds at most its whole disc. Cosines have a mean of at most 1.
        """
        path, moves = self.cutting.path, self.moves
        found, deep, radius = Ahead.none(len(rows)), *np.zeros((2, len(path)))
        np.maximum.at(deep, moves.row, self.ceilings - moves.low)
        np.maximum.at(radius, moves.row, moves.radius)
        plain, round_ = np.zeros((2, len(path)), dtype=bool)
        plain[moves.row], round_[moves.row] = moves.flat == moves.radius, moves.slope == 0
        down = (path.start - path.end)[rows, 2].clip(0.0) / path.lengths[rows]
        bent = path.kind[rows] == Kind.ARC
        down[bent & (np.abs(path.axis[rows, 2]) < 1 - 1e-12)] = 1.0
        across = np.where(bent, 1.0, np.sqrt(1 - down**2))
        deep, radius, met = deep[rows], radius[rows], deep[rows] > LEAST
        found.area[:] = np.where(met, across * WIDE * radius * deep + down * np.pi * radius**2, 0.0)
        for column, value, known in zip(found[1:], (deep, WIDE * radius, np.ones_like(deep)), (round_, round_, plain)):
            column[:] = np.where(met & known[rows], value, 0.0)
        return found

    @cached_property
    def ceilings(self) -> Array:
        """No less than how high material stands (k,) wherever moves reach, just before each.

        It is the top of the blank; where the same cutter went the same way before, forwards or backwards, the highest place of
        its rim then: so of a pocket in layers each has the one above it as its ceiling.
        """
        moves, highest, seen = self.moves, float(self.bounds[1, 2]), dict[bytes, float]()
        columns = [moves.start[:, :2], moves.end[:, :2], moves.centre, np.stack([moves.sweep, *moves.shape], axis=1)]
        way = np.rint(np.concatenate(columns, axis=1) / SAME).astype(np.int64)
        back = (way[:, 0] > way[:, 2]) | ((way[:, 0] == way[:, 2]) & (way[:, 1] > way[:, 3]))
        way[back, :4], way[back, 6] = way[back][:, [2, 3, 0, 1]], -way[back, 6]
        found = np.full(len(moves), highest)
        rim = np.maximum(moves.start[:, 2], moves.end[:, 2]) + edge_height(*moves.shape)
        for k, key in enumerate(map(bytes, way)):
            found[k] = seen.get(key, highest)
            seen[key] = min(found[k], rim[k])
        return found


def _walls(rim: Array, front: Callable[[Index, Array], Array]) -> tuple[Array, Array]:
    """Where the parts of the rim begin and end (k, r), rad: in the middle between two of its degrees, or at a wall between
    them, beyond which the depth (k, r) is another one. `front` gives the depth of places (m,) at an angle each (m,)."""
    begin, end = np.tile(BETWEEN[:-1], (len(rim), 1)), np.tile(BETWEEN[1:], (len(rim), 1))
    k, i = np.nonzero(np.abs(np.diff(rim, axis=1)) > JUMP * rim.max(axis=1, keepdims=True))
    here, there = RIM[i], RIM[i + 1]
    for _ in range(HALVINGS if len(k) else 0):
        middle = (here + there) / 2
        met = front(k, middle)
        before = np.abs(met - rim[k, i]) < np.abs(met - rim[k, i + 1])
        here, there = np.where(before, middle, here), np.where(before, there, middle)
    end[k, i] = begin[k, i + 1] = (here + there) / 2
    return begin, end


def _rings(moves: Moves, stands: Array) -> Array:
    """Where rings of the lower sides begin, have their middles, and end (k, 2 m + 1), as far as material stands above tips."""
    bent = np.sqrt(np.maximum(moves.corner**2 - np.maximum(moves.corner - stands, 0.0) ** 2, 0.0))
    out = np.where(moves.slope > 0, stands / np.where(moves.slope > 0, moves.slope, 1.0), bent)
    wide = np.minimum(out, moves.radius - moves.flat)[:, None]
    inner, outer = np.arange(2 * FLAT) / (2 * FLAT), np.arange(2 * BENT + 1) / (2 * BENT)
    return np.concatenate([moves.flat[:, None] * inner, moves.flat[:, None] + wide * outer], axis=1)

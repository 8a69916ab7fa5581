"""Whole SL programs over random areas: what roughing, floor and side sweep, judged by shapely on fine arcs.

Areas and programs are made from one seed (`sl_programs`, `random_regions`). Where a sharp corner makes polygons of one hair
too coarse a judge, finer ones decide. All lengths are turned back to those of the program before they are judged.
"""

from functools import cached_property
from itertools import pairwise

import numpy as np
import pytest
import shapely
from controls.tnc_620.cuts import Cuts
from controls.tnc_620.sl_programs import random_job
from controls.tnc_620.swept_areas import capsules, edges, grown, shrunk, within_reach

HAIRS = 1e-3, 1e-4  # mm, by which polygons may be off: the finer ones decide where the coarse ones find a fault
CROOKED = 5  # hairs by which the corner of two shallow arcs may be off
LEAST = 1e-3  # mm², area that counts as left
NEAR = 1e-6
WAYS = 0.15  # of what roughing runs along the walls: ways at depth to the next pass, in either sense
QUICK, ALL, BLOCK = (19, 28, 37), 60, 5


class Judge:
    """All that is wrong with a run of a job, as sentences."""

    def __init__(self, job, run, hair):
        self.job, self.run, self.hair = job, run, hair
        self.found, self.areas, self.centres = [], {}, {}
        first = job.coarse or job.radius
        self.rough = Cuts(job, run.toolpath, "22", 1)
        self.fine = Cuts(job, run.toolpath, "22", 2)
        self.floor, self.side = Cuts(job, run.toolpath, "23"), Cuts(job, run.toolpath, "24")
        cleared = self.roughing(self.rough, first, {})
        if job.coarse and len(self.fine.depths):
            self.roughing(self.fine, job.radius, {depth: (pieces, first) for depth, pieces in cleared.items()})
        self.finishing()
        for cuts in (self.rough, self.fine, self.floor, self.side):
            self.rapids(cuts)

    def area(self, depth):
        """What is cut at a depth."""
        floor = next(each for each in self.job.floors if each >= depth - NEAR)
        if floor not in self.areas:
            self.areas[floor] = self.job.area(self.hair, floor - NEAR)
        return self.areas[floor]

    def surely(self, room, reach):
        """Where a place surely is `reach` away from the walls of a room."""
        if (id(room), reach) not in self.centres:
            self.centres[id(room), reach] = shrunk(room, reach, self.hair, surely=True)
        return self.centres[id(room), reach]

    @cached_property
    def told(self):
        """The area of each level that cycle 22 says it leaves."""
        warned = [float(each.message.split("leaves ")[1].split()[0]) for each in self.run.alarms if " uncut, " in each.message]
        return max(warned, default=0.0) / self.job.frame.scale**2

    def roughing(self, cuts, radius, before):
        """The pieces of each level; `before` is what another tool has run there, with its radius."""
        self.levels(cuts, self.job.floor, "roughing")
        keep, pieces, known = radius + self.job.side, {}, {}
        for depth in cuts.depths.tolist():
            room, here = self.area(depth + self.job.floor), cuts.at(depth)
            key = np.round(cuts.end[here], 7).tobytes(), id(room)
            if key not in known:
                known[key] = self.inside(cuts, depth, keep, room, "roughing")
                gone = [capsules(*each, True, self.hair) for each in [before[depth]] if depth in before] if before else []
                self.covers(known[key], keep, radius, room, f"roughing at {depth:g}", gone)
                wrong, along = self.senses(cuts, here, keep, room)
                if wrong > WAYS * along and not before:
                    self.found.append(f"roughing at {depth:g}: {wrong:.2f} of {along:.2f} mm along walls in the wrong sense")
            pieces[depth] = known[key]
        return pieces

    def finishing(self):
        """Floors are covered by cycle 23 and 24 together, walls run by 24 alone."""
        job, radius = self.job, self.job.radius
        if not job.depths and self.floor.depths.tolist() != [job.depth]:
            self.found.append(f"floors at {self.floor.depths.tolist()}")
        floors = {}
        for depth, deeper in pairwise([*job.floors, None]):
            room, below = self.area(depth), [] if deeper is None else [self.area(deeper)]
            floors[depth] = self.inside(self.floor, depth, radius + job.side, room, "floor"), below
            self.covers(floors[depth][0], radius + job.side, radius, room, f"floor at {depth:g}", below)
        if job.side <= job.left:
            return
        self.levels(self.side, 0.0, "side")
        keep, passes = radius + job.left, np.array([name.count(",") == 1 for name in self.side.names])
        for depth in self.side.depths.tolist():
            room = self.area(depth)
            pieces = self.inside(self.side, depth, keep, room, "side")
            wrong, along = self.senses(self.side, self.side.at(depth) & passes, keep, room)
            if wrong > 1e-3 * along or not along:
                self.found.append(f"side at {depth:g}: {wrong:.2f} of {along:.2f} mm in the wrong sense")
            if depth in floors:
                both, below = np.concatenate([floors[depth][0], pieces]), floors[depth][1]
                self.covers(both, keep, radius, room, f"side and floor at {depth:g}", below)

    def inside(self, cuts, depth, keep, room, what):
        """The pieces at a depth; none may come nearer than `keep` to the edge of the room."""
        pieces, _ = cuts.pieces(cuts.at(depth), self.hair)
        border = shapely.STRtree(shapely.linestrings(edges(room)))
        close = border.query(shapely.linestrings(pieces), predicate="dwithin", distance=keep - CROOKED * self.hair)[0]
        if len(close) or not shapely.contains_xy(room, pieces[:, 0]).all():
            self.found.append(f"{what} at {depth:g}: {len(np.unique(close))} pieces nearer to the walls than {keep:g}")
        return pieces

    def covers(self, pieces, keep, radius, room, what, without):
        """Nothing that the tool reaches stands beside what it swept, but in corners that the passes round."""
        corner = self.job.corner
        left = shapely.difference(room, shapely.union_all([capsules(pieces, radius, True, self.hair), *without]))
        centres = self.surely(room, keep + corner)
        if self.job.overlap <= 1:
            stands = within_reach(left, centres, radius + corner - 2 * self.hair)
            if stands:
                self.found.append(f"{what}: {stands} pieces of the edge of what is left are in reach")
        elif not corner:  # what stands in sharp corners is told by the cycle
            area = shapely.intersection(left, grown(centres, radius, self.hair)).area
            if area > 1.1 * self.told + LEAST:
                self.found.append(f"{what}: {area:.3f} mm² left, {self.told:g} are told")

    def senses(self, cuts, some, keep, room):
        """Lengths of passes beside walls: in the wrong sense, in all. In climb milling the wall lies on the right."""
        pieces, _ = cuts.pieces(some, self.hair)
        way, middle = pieces[:, 1] - pieces[:, 0], pieces.mean(axis=1)
        walls, spots = shapely.linestrings(edges(room)), shapely.points(middle)
        (index, near), away = shapely.STRtree(walls).query_nearest(spots, return_distance=True, all_matches=False)
        feet = shapely.line_interpolate_point(walls[near], shapely.line_locate_point(walls[near], spots[index]))
        arm = shapely.get_coordinates(feet) - middle[index]
        right = way[index, 0] * arm[:, 1] < way[index, 1] * arm[:, 0]
        beside = abs(away - keep) < 4 * self.hair
        wrong = beside & ((right != self.job.frame.mirrored) != self.job.climb)
        long = np.hypot(*way[index].T)
        return float(long[wrong].sum()), float(long[beside].sum())

    def levels(self, cuts, allowance, what):
        want = self.job.levels(allowance)
        if len(want) != len(cuts.depths) or not np.allclose(cuts.depths, want):
            self.found.append(f"{what}: levels {cuts.depths.tolist()}, not {want}")

    def rapids(self, cuts):
        """Below the surface rapids go up, or down to where the tool has been."""
        low = cuts.rapid & (np.maximum(cuts.top, cuts.bottom) > NEAR)
        if (low & (np.hypot(*(cuts.end - cuts.start).T) > NEAR)).any():
            self.found.append("a rapid across below the surface")
        for k in np.flatnonzero(low & (cuts.bottom > cuts.top)):
            earlier = (np.arange(len(low)) < k) & cuts.flat & (cuts.bottom >= cuts.bottom[k] - NEAR)
            been = shapely.multilinestrings(shapely.linestrings(cuts.pieces(earlier, self.hair)[0]))
            if not shapely.dwithin(been, shapely.Point(cuts.end[k]), 2 * self.hair):
                self.found.append(f"a rapid down to {cuts.bottom[k]:g} where nothing was cleared")


def verdict(job, run, hair):
    """What is wrong; an alarm is right where the tool does not fit."""
    errors = [each.message for each in run.alarms if each.severity == "alarm"]
    keep = (job.coarse or job.radius) + job.side
    if errors and "does not fit" in errors[0] and shrunk(job.area(hair), keep, hair, surely=True).is_empty:
        return []
    return errors or Judge(job, run, hair).found


def judge(seed):
    job = random_job(seed)
    run = job.run()
    wrong = []
    for hair in HAIRS:
        wrong = verdict(job, run, hair)
        if not wrong:
            return
    raise AssertionError((seed, *wrong))


@pytest.mark.parametrize("seed", QUICK)
def test_some_random_programs(seed):
    judge(seed)


@pytest.mark.deep
@pytest.mark.parametrize("first", range(0, ALL, BLOCK))
def test_random_programs(first):
    for seed in range(first, first + BLOCK):
        judge(seed)

"""Adaptive clearing: engagement within that of a straight cut, by another algorithm; no gouge; nothing left; open sides.

The rim is laid over what a disc has swept, by shapely: the front half of it outside is the engagement. It is first tried on
cuts whose engagement is known in closed form.
"""

import functools
import math

import numpy as np
import pytest
import shapely
from tools.random_regions import random_task

import mnclab
from mnclab.comparison.levels import level_moves
from mnclab.geometry.contours import Contour, rectangle, slot
from mnclab.geometry.regions import Region
from mnclab.machining.milling.adaptive import adaptive, peeling
from mnclab.machining.milling.clearing import HOPPED, LIFTED, begin, end
from mnclab.machining.milling.engagement import engagement
from mnclab.machining.milling.entries import VERTICAL
from mnclab.machining.milling.rings import rings

R, STEPOVER = 3.0, 2.4
LIMIT = math.degrees(math.acos(1 - STEPOVER / R))  # 78.463°
SQUARE = Region.of(rectangle(60, 60))
POCKETS = {
    "square": SQUARE,
    "L": Region.of(Contour([(0, 0), (60, 0), (60, 25), (25, 25), (25, 60), (0, 60)])),
    "island": Region.of(rectangle(70, 60), holes=[Contour.circle((0, 0), 10)]),
    "neck": Region.of(rectangle(40, 40, centre=(20, 20))).union(Region.of(rectangle(40, 40, centre=(80, 20)))).union(
        Region.of(rectangle(30, 8, centre=(50, 20)))
    ),
}


@functools.cache
def cleared(name):
    """How the adaptive strategy clears a pocket."""
    return adaptive(POCKETS[name], R, STEPOVER)


def line_of(contour, chord_error=1e-3):
    return shapely.LineString(contour.points_within(chord_error))


def rims(ways, radius, step):
    """The engagement (degrees) in steps along polylines cut one after the other, and the polyline of each."""
    gone, angles, which = shapely.Polygon(), [], []
    half = np.radians(np.linspace(-90, 90, 721))
    for k, way in enumerate(ways):
        line = line_of(way)
        corners = shapely.get_coordinates(line)
        come = np.append(0.0, np.hypot(*np.diff(corners, axis=0).T).cumsum())
        for upto in np.arange(step, line.length, step):
            a, b = shapely.get_coordinates(shapely.line_interpolate_point(line, [upto - 1e-4, upto]))
            behind = shapely.LineString([*corners[come < upto - 1e-4], a])
            beside = shapely.clip_by_rect(behind, *(b - 2.1 * radius), *(b + 2.1 * radius))  # what is farther away is not met
            swept = beside.buffer(radius, quad_segs=90)
            ahead = math.atan2(*(b - a)[::-1])
            rim = b + radius * np.stack([np.cos(ahead + half), np.sin(ahead + half)], axis=1)
            free = ~shapely.contains_xy(gone, *rim.T) & ~shapely.contains_xy(swept, *rim.T)
            angles.append(180 * free.mean())
            which.append(k)
        gone = gone.union(line.buffer(radius, quad_segs=90))
    return np.array(angles), np.array(which)


def test_the_other_algorithm_knows_cuts_of_known_engagement():
    """A slot, a straight cut with the stepover, the corner of a ring; and that a cut a tenth deeper is told apart."""
    slot, beside = Contour([(0, 0), (40, 0)], closed=False), Contour([(0, STEPOVER), (40, STEPOVER)], closed=False)
    angles, which = rims([slot, beside], R, 2.0)
    assert angles[which == 0][2:] == pytest.approx(180, abs=2)
    assert angles[which == 1][2:-2] == pytest.approx(LIMIT, abs=0.5)
    deeper = Contour([(0, 1.1 * STEPOVER), (40, 1.1 * STEPOVER)], closed=False)
    angles, which = rims([slot, deeper], R, 2.0)
    assert (angles[which == 1][2:] > LIMIT + 4).all()
    inner = Contour([(-10, -10), (10, -10), (10, 10), (-10, 10)])
    outer = Contour(1.24 * inner.points)
    angles, which = rims([inner, outer], R, 0.05)
    assert angles[which == 1].max() == pytest.approx(90 + LIMIT, abs=1.5)


def engaged(clearing, spacing=40, climb=True, stock=None):
    """What `engagement` says of passes, links and walls; and the label of each place."""
    moves, _ = level_moves(clearing, VERTICAL, 1.0, climb)
    names = {id(way): label for way, label in zip(clearing.passes, clearing.labels)}
    found = engagement(moves, clearing.radius, spacing=clearing.radius / spacing, stock=stock)
    return found, np.array([names.get(id(moves[k]), "link").split()[0] for k in found.move])


def share(found, mask, above):
    return found.step[mask & (np.degrees(found.angle) > above)].sum() / found.step[mask].sum()


@pytest.mark.parametrize("name", POCKETS)
def test_engagement_stays_within_the_limit(name):
    """Outside the entries, and beside corners of the pass along the wall: a degree above on a hundredth of the way at most."""
    clearing = cleared(name)
    found, label = engaged(clearing)
    cutting = np.isin(label, ["spiral", "pass"])
    assert share(found, cutting, LIMIT + 1) < 0.003
    assert share(found, cutting, LIMIT + 5) < 0.001
    assert found.step[cutting] @ found.width[cutting] / found.step[cutting].sum() > 0.8 * STEPOVER
    walls = np.isin(label, ["wall", "island"])
    corners = shapely.MultiPoint([p for loop in clearing.centres.loops for p in loop.points[np.abs(loop.turns()) > 0.1]])
    away = shapely.distance(shapely.points(found.points), corners) if not corners.is_empty else np.inf
    # a corner of the inset of 90° takes 0.3 mm of its own: smallest / tan(α / 2)
    assert np.degrees(found.angle[walls & (away > 0.3 + R / 20)]).max() < LIMIT + 5


@pytest.mark.parametrize("name", ["square", "neck"])
def test_another_algorithm_says_the_same(name):
    clearing = cleared(name)
    chosen = [k for k, label in enumerate(clearing.labels) if label.startswith(("spiral", "pass"))][:12]
    gone = [way for k, way in enumerate(clearing.passes) if k <= chosen[-1]]
    angles, which = rims(gone, R, 0.7)
    assert (angles[np.isin(which, chosen)] > LIMIT + 1.5).mean() < 0.004


@pytest.mark.parametrize("name", POCKETS)
def test_all_is_cleared_and_no_more(name):
    clearing = cleared(name)
    room = shapely.union_all([shapely.Polygon(part.loops[0].points_within(1e-5), [h.points_within(1e-5) for h in part.loops[1:]])
                              for part in clearing.centres.parts])  # fmt: skip
    assert shapely.covers(room.buffer(2e-5), [line_of(way, 1e-6) for way in clearing.passes]).all()
    cover = shapely.union_all(shapely.buffer([line_of(way, 5e-5) for way in clearing.passes], R + 1e-4, quad_segs=90))
    reach = room.buffer(R, quad_segs=90)
    assert reach.difference(cover).area < 1e-4 * reach.area
    walls = [way for way, label in zip(clearing.passes, clearing.labels) if label in ("wall", "island")]
    for loop in clearing.centres.loops:  # walls to 1e-6: a pass runs along all of every loop
        spots = loop.point_at(np.linspace(0, loop.length, 200))[0]
        assert min(way.distance(spots).max() for way in walls) < 1e-9
    assert sum(way.length for way in clearing.passes) < reach.area / STEPOVER / 0.73


@pytest.mark.parametrize("name", POCKETS)
def test_passes_are_arcs_that_go_on_without_a_corner(name):
    clearing = cleared(name)
    for way, label in zip(clearing.passes, clearing.labels):
        if label.startswith(("spiral", "pass")):
            assert np.abs(way.turns()).max(initial=0.0) < 1e-6
            assert len(way.points) < 12 + 4 * way.length  # arcs, not chords


@pytest.mark.parametrize("name", POCKETS)
def test_hops_meet_no_material(name):
    """Where the tool goes on rapid, a little above the level, its rim stays within what is cleared."""
    clearing = cleared(name)
    (piece,) = clearing.pieces
    lines = [line_of(way) for way in piece.passes]
    hopped = [k for k, how in enumerate(piece.linked) if how == HOPPED]
    assert len(hopped) >= len(piece.linked) // 3
    gone, done = shapely.Polygon(), 0
    for k in hopped:
        gone, done = shapely.union_all([gone, *shapely.buffer(lines[done : k + 1], R + 0.02, quad_segs=32)]), k + 1
        way = shapely.LineString([end(piece.passes[k]), begin(piece.passes[k + 1])])
        assert way.buffer(R, quad_segs=32).difference(gone).area < 0.02


def test_entries_are_said():
    clearing = cleared("square")
    assert clearing.labels[0] == "entry spiral"
    assert np.hypot(*(clearing.passes[0].points - clearing.passes[0].points[0]).T).max() <= R + 1e-9


def test_conventional_is_climb_in_a_mirror():
    turn = np.array([[-1.0, 0, 0], [0, 1, 0]])
    region = Region.of(Contour([(0, 0), (50, -5), (70, 30), (30, 45), (-5, 25)]))  # one greatest circle
    mirrored = Region(tuple(loop.transformed(turn).reversed() for loop in region.loops))
    one, other = adaptive(region, R, STEPOVER, climb=False), adaptive(mirrored, R, STEPOVER)
    assert one.labels == other.labels
    for a, b in zip(one.passes, other.passes):
        assert a.points == pytest.approx(b.points * [-1, 1], abs=1e-9)
    walls = [way for way, label in zip(one.passes, one.labels) if label == "wall"]
    assert walls[-1].area < 0


def test_the_tool_comes_in_from_an_open_side():
    """Material in the left half alone: no entry, nothing far from it, and the limit holds against the stock."""
    stock = Region.of(rectangle(40, 80, centre=(-20, 0)))
    clearing = adaptive(SQUARE, R, STEPOVER, stock=stock)
    (piece,) = clearing.pieces
    assert piece.from_side and not any(label.startswith("entry") for label in piece.labels)
    lines = shapely.union_all([line_of(way) for way in piece.passes])
    assert lines.bounds[2] < 0 + R + 2 * R
    cover = shapely.union_all(shapely.buffer([line_of(way) for way in piece.passes], R, quad_segs=64))
    reach = shapely.box(-30, -30, 0, 30).intersection(shapely.box(-27, -27, 27, 27).buffer(R, quad_segs=64))
    assert reach.difference(cover).area < 1e-4 * reach.area
    found, label = engaged(clearing, stock=stock)
    assert share(found, label == "pass", LIMIT + 2) < 0.003
    assert piece.linked.count(LIFTED) < len(piece.linked) * 2 / 3


def test_a_whole_comparison_and_its_path():
    found = mnclab.compare(SQUARE, mnclab.Tool(diameter=6), "adaptive", "rings", stepover=STEPOVER)
    trial = found["adaptive"]
    assert trial.covered > 0.9999 and trial.row["above"] < 2
    heights = trial.path.end[trial.path.kind == mnclab.Kind.RAPID][:, 2]
    assert np.isclose(heights, -0.7).any()  # small lifts of 0.3 mm above a level of -1


@pytest.mark.parametrize("smallest", [4.0, 0.0])
def test_what_cannot_be_is_refused(smallest):
    with pytest.raises(ValueError, match="smallest radius"):
        adaptive(SQUARE, R, STEPOVER, smallest=smallest)
    with pytest.raises(ValueError, match="stepover"):
        adaptive(SQUARE, R, 2.1 * R)


def test_a_stepover_that_bounds_nothing_clears_all_the_same():
    assert mnclab.compare(SQUARE, mnclab.Tool(diameter=6), "adaptive", stepover=6.0)["adaptive"].covered > 0.9999


def test_rings_are_told_apart():
    """What the measure is for: rings are far above the limit in their corners."""
    found, label = engaged(rings(SQUARE, R, STEPOVER))
    assert np.degrees(found.angle[label == "ring"]).max() > 160


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(12))
def test_random_regions(seed):
    task = random_task(seed)
    region, radius = task.region, task.radius
    stepover = min(task.stepover, 0.9 * radius)
    clearing = adaptive(region, radius, stepover, allowance=task.allowance)
    limit = math.degrees(math.acos(1 - stepover / radius))
    found, label = engaged(clearing, 24)
    cutting = np.isin(label, ["spiral", "pass"])
    assert share(found, cutting, limit + 5) < 0.01
    room = shapely.union_all([shapely.Polygon(part.loops[0].points_within(1e-5), [h.points_within(1e-5) for h in part.loops[1:]])
                              for part in clearing.centres.parts])  # fmt: skip
    lines = [shapely.LineString(way.points_within(1e-6)) for way in clearing.passes]
    assert all(room.buffer(2e-5).covers(line) for line in lines)
    cover = shapely.union_all(shapely.buffer(lines, radius, quad_segs=64))
    reach = room.buffer(radius, quad_segs=64)
    assert reach.difference(cover).area < 3e-4 * reach.area


@pytest.mark.parametrize("climb", [True, False])
def test_a_slot_is_peeled_from_one_end_to_the_other(climb):
    """Bow after bow goes on along the slot, within the limit, and nothing is left."""
    region, stepover = Region.of(slot(Contour([(0, 0), (60, 0)], closed=False), 14)), 1.2
    clearing = peeling(region, R, stepover, climb=climb)
    found, label = engaged(clearing, climb=climb)
    limit = math.degrees(math.acos(1 - stepover / R))
    assert share(found, np.isin(label, ["spiral", "pass"]), limit + 1) < 0.001
    assert np.degrees(found.angle[np.isin(label, ["wall", "pass"])]).max() < limit + 5
    bows = [way.point_at([way.length / 2])[0][0] for way, k in zip(clearing.passes, clearing.labels) if k.startswith("pass")]
    ahead = np.diff([x for x, y in bows if 10 < x < 50 and abs(y) < 3])
    assert len(ahead) > 20 and (np.all(ahead > 0) or np.all(ahead < 0))
    cleared = shapely.union_all([line_of(way).buffer(R, quad_segs=64) for way in clearing.passes])
    assert slot_area(60, 14) - cleared.area == pytest.approx(0, abs=1e-4 * slot_area(60, 14))


def slot_area(length, width):
    return length * width + math.pi * width**2 / 4


@pytest.mark.parametrize("name", ["adaptive", "peeling"])
def test_a_stepover_too_small_to_keep_the_limit_is_refused(name):
    """A twentieth of the radius is the least; whoever asks for all strategies learns which of them it is."""
    least = f"{name} keeps its engagement from a stepover of 0.15 mm on, a twentieth of the tool radius, got 0.149"
    small = Region.of(rectangle(8, 8))
    with pytest.raises(mnclab.Alarm, match=least) as raised:
        getattr(mnclab.strategies, name)(small, R, 0.149)
    with pytest.raises(mnclab.Alarm, match=least):
        mnclab.compare(small, R, name, stepover=0.149, stock=small, draft=1)
    assert "another strategy" in raised.value.hint
    with pytest.raises(mnclab.Alarm, match="adaptive keeps"):
        mnclab.compare(small, R, stepover=0.149)
    assert getattr(mnclab.strategies, name)(small, R, 0.15).passes

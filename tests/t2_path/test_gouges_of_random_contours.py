"""What compensation names is what is cut: random contours of lines and arcs, measured by shapely along chords.

The walls are those that the program was written from, the way of the tool is that of the run without its entry and exit; both
in chords that miss their arcs by 0.0001 mm at most. A tool nearer to the walls than its radius cuts them. Contours that cross
themselves are left out: what stands behind a crossing is not told by distances.
"""

import math

import numpy as np
import pytest
from shapely import LineString, Point
from shapely.ops import nearest_points

import mnclab
from mnclab import Setup, Tool

CHORD = 1e-4  # mm between an arc and its chords
SURE = 3e-4  # mm: what two chords and programmed micrometres may hide
DEEP = 0.01  # mm: a deeper cut must be named

# An element is its end, and for arcs its centre and sense, +1 anticlockwise.
CUT_OFF = (4, -1, (0.484957582, 14.992158488), (0, 0), [
    ((-0.579850768, -17.925721611),),
    ((-0.844847016, -26.117913875),),
    ((-11.827790361, -25.498812169), (-5.697705457, -14.479282739), -1),
    ((-24.308063976, -15.182450473),),
    ((-18.944792255, -5.337977530), (-20.669996098, -10.781278442), -1),
    ((-5.619987058, -9.561151208),),
], (8.679017956, -14.093088501))  # fmt: skip


def swept(start, end, centre, sense):
    """Radius and sweep of an arc; one that ends where it starts is a whole turn."""
    a, b = np.subtract(start, centre), np.subtract(end, centre)
    angle = sense * math.atan2(a[0] * b[1] - a[1] * b[0], a @ b) % math.tau
    return math.hypot(*a), sense * (angle or math.tau)


def chords(start, centre, r, sweep, end):
    """Points (n, 2) behind the start of an arc, with the end itself."""
    n = max(2, math.ceil(abs(sweep) / (2 * math.acos(1 - min(1.0, CHORD / r))))) if r > CHORD else 2
    at = math.atan2(start[1] - centre[1], start[0] - centre[0]) + sweep * np.arange(1, n)[:, None] / n
    return np.concatenate([centre + r * np.hstack([np.cos(at), np.sin(at)]), [end]])


def walls(start, elements):
    """One line of chords for each element."""
    lines, before = [], np.array(start)
    for end, *arc in elements:
        points = chords(before, np.array(arc[0]), *swept(before, end, *arc), end) if arc else np.array([end])
        lines.append(LineString(np.concatenate([[before], points])))
        before = np.array(end)
    return lines


def rows(run):
    """The way of the tool centre behind the entry and before the exit, a line for each row."""
    path, lines = run.toolpath, []
    for k in np.flatnonzero(path.side != 0)[1:].tolist():
        start, end, centre = path.start[k, :2], path.end[k, :2], path.centre[k, :2]
        arc = np.isfinite(centre).all()
        points = chords(start, centre, math.hypot(*(start - centre)), float(path.sweep[k]), end) if arc else [end]
        lines.append(LineString(np.concatenate([[start], points])))
    return [line for line in lines if line.length > 1e-9]


def normal(line, p, side):
    """The unit normal to the side of the tool, of the chord of a line nearest to a point on it."""
    points = np.array(line.coords)
    travel = np.diff(points, axis=0)
    share = np.clip(((p - points[:-1]) * travel).sum(axis=1) / np.maximum((travel**2).sum(axis=1), 1e-30), 0, 1)
    k = int(np.argmin(np.hypot(*(points[:-1] + share[:, None] * travel - p).T)))
    return side * np.array([-travel[k, 1], travel[k, 0]]) / np.hypot(*travel[k])


def cut(run, contour, passes=True):
    """How deep the tool cuts into the walls, mm, below zero what is clear; not with `passes` beside walls that face the way
    of the one that is cut: so the next pass of a roughing does, or the one before."""
    radius, side, _, start, elements, _ = contour
    deepest, of_walls = -math.inf, walls(start, elements)
    first, last = (of_walls[k].coords[k] for k in (0, -1))
    for row in rows(run):
        for wall in of_walls:
            depth = radius - row.distance(wall)
            if depth > deepest and passes:
                p, q = (np.array(each.coords[0]) for each in nearest_points(row, wall))
                alike = normal(row, p, side) @ normal(wall, q, side)
                if alike > (0.7 if min(math.dist(q, first), math.dist(q, last)) < CHORD else 0.0):
                    continue
            deepest = max(deepest, depth)
    return deepest


def milled(control, contour, **settings):
    radius, side, approach, start, elements, leave = contour

    def xy(p, x="X", y="Y", shift=(0.0, 0.0)):
        return f"{x}{p[0] - shift[0]:+.9f} {y}{p[1] - shift[1]:+.9f}"

    blocks, before = [], start
    for end, *arc in elements:
        if not arc:
            blocks.append(f"{'L' if control == 'tnc-620' else 'G1'} {xy(end)}")
        elif control == "tnc-620":
            blocks += [f"CC {xy(arc[0])}", f"C {xy(end)} DR{'+' if arc[1] > 0 else '-'}"]
        else:
            blocks.append(f"G{3 if arc[1] > 0 else 2} {xy(end)} {xy(arc[0], 'I', 'J', before)}")
        before = end
    body = "\n".join(blocks)
    if control == "tnc-620":
        text = (
            f"BEGIN PGM T MM\nTOOL CALL 1 Z S1000\nL {xy(approach)} R0 FMAX M3\nL Z-2 R0 F200\n"
            f"L {xy(start)} R{'L' if side > 0 else 'R'}\n{body}\nL {xy(leave)} R0\nEND PGM T MM\n"
        )
    else:
        text = (
            f"G54 G17 G90 G40 G160 T1\nS1000 M3\nG0 {xy(approach)} Z-2\nG{41 if side > 0 else 42} G1 {xy(start)} F200\n"
            f"{body}\nG40 G1 {xy(leave)}\n"
        )
    setup = Setup(tools={1: Tool(radius=radius, number=1, cutting_length=100)}, start=(0, 0, 100), settings=settings)
    return mnclab.run(text, control, setup)


def random_contour(rng):
    """A contour that does not cross itself, or None. A third of them is closed."""
    at, heading, elements = np.zeros(2), float(rng.uniform(-math.pi, math.pi)), []
    first, scale = heading, float(rng.choice([1.0, 3.0]))
    closed = rng.random() < 0.35
    for _ in range(rng.integers(3, 9)):
        if rng.random() < 0.6:
            end = np.round(at + rng.uniform(2, 12) * scale * np.array([math.cos(heading), math.sin(heading)]), 6)
            elements.append((tuple(end),))
        else:
            sense, r, turn = int(rng.choice([-1, 1])), rng.uniform(2, 7) * scale, rng.uniform(0.3, 4.2)
            centre = np.round(at + sense * r * np.array([-math.sin(heading), math.cos(heading)]), 6)
            r, to = math.hypot(*(at - centre)), math.atan2(*(at - centre)[::-1]) + sense * turn
            end = np.round(centre + r * np.array([math.cos(to), math.sin(to)]), 9)
            elements.append((tuple(end), tuple(centre), sense))
            heading += sense * turn
        at = end
        if rng.random() < 0.75:
            heading += rng.uniform(-2.4, 2.4)
    last = math.atan2(*(np.array(at) - [0, 0])[::-1]) + math.pi if closed else heading
    if closed:
        elements.append(((0.0, 0.0),))
        at = np.zeros(2)
    elif len(elements[-1]) == 1:
        before = np.array(elements[-2][0])
        last = math.atan2(*(at - before)[::-1])
    line = LineString(np.concatenate([np.array(wall.coords)[:-1] for wall in walls((0.0, 0.0), elements)] + [[at]]))
    if not (line.is_ring if closed else line.is_simple):
        return None
    away, ways = 12 * scale, (first + math.pi + rng.uniform(-1, 1), last + rng.uniform(-1, 1))
    approach, leave = (tuple(np.round(p + away * np.array([math.cos(w), math.sin(w)]), 6)) for p, w in zip((0, at), ways))
    radius, side = float(rng.choice([1.0, 2.5, 4.0])) * scale / 2, int(rng.choice([-1, 1]))
    return radius, side, approach, (0.0, 0.0), elements, leave


def wrong(contour, controls=("mnc", "tnc-620")):
    """What is said of a contour and not true, or not said though it is true."""
    for control in controls:
        marked, own = milled(control, contour, gouge="mark"), milled(control, contour)
        if cut(marked, contour) > DEEP and not own.gouges:
            yield control, "cut and not named", cut(marked, contour)
        if own.gouges and cut(marked, contour, passes=False) < min(max(g.missing for g in own.gouges), DEEP) - SURE:
            yield control, "named and not cut", own.gouges
        if bool(marked.gouges) != bool(own.gouges) or (control == "mnc" and own.ok == bool(own.gouges)):
            yield control, "two verdicts", own.alarms


def misplaced(contour, control):
    """Marks that do not stand on a wall within the reach of the tool."""
    run = milled(control, contour, gouge="mark")
    ways, of_walls = rows(run), walls(*contour[3:5])
    for gouge in run.gouges:
        spot = Point(gouge.place[:2])
        off = min(wall.distance(spot) for wall in of_walls)
        met = gouge.kind not in ("bottleneck", "neighbour", "end", "corner") or min(map(spot.distance, ways)) < contour[0] - SURE
        if off > SURE or not met:
            yield gouge.kind, gouge.place, off


def slot(radius):
    """A slot of 10 mm with a round end, which the tool goes round on the left."""
    return radius, 1, (-20, 0), (0, 0), [((40, 0),), ((40, 10), (40, 5), 1), ((-10, 10),)], (-30, 10)


@pytest.mark.parametrize("control", ["mnc", "tnc-620"])
def test_the_measure_knows_a_twin(control):
    for radius, depth in ((4.99, -0.02), (4.999, -0.002), (5.001, 0.002), (5.2, 0.4)):
        run = milled(control, slot(radius), gouge="mark")
        assert cut(run, slot(radius)) == pytest.approx(depth, abs=SURE) or depth > 0 and cut(run, slot(radius)) > depth
        assert bool(run.gouges) == (depth > 0)


@pytest.mark.parametrize("control", ["mnc", "tnc-620"])
def test_the_end_of_a_wall_is_cut_off_beside_another_one(control):
    """The end lies d = 5.308 mm in front of the first wall: a tool beside that wall is clear of it up to R = d / 2."""
    (x, y), (u, v) = CUT_OFF[4][0][0], CUT_OFF[4][-1][0]
    largest = abs(x * v - y * u) / math.hypot(x, y) / 2
    for radius, fits in ((largest - 0.001, True), (largest + 0.001, False), (4, False)):
        contour = radius, *CUT_OFF[1:]
        run, marked = milled(control, contour), milled(control, contour, gouge="mark")
        assert cut(marked, contour) == pytest.approx(2 * (radius - largest), abs=SURE)
        assert bool(run.gouges) != fits and (run.ok or control == "mnc" and not fits)
        if not fits:
            (gouge,) = run.gouges
            assert gouge.kind == "end" and gouge.largest == pytest.approx(largest, abs=1e-6)
            assert gouge.missing == pytest.approx(2 * (radius - largest), abs=1e-6)
    assert not list(wrong(CUT_OFF))


@pytest.mark.parametrize("control", ["mnc", "tnc-620"])
@pytest.mark.parametrize("radius", [2, 4])
@pytest.mark.parametrize("step", [1, 3])
def test_the_next_pass_may_cut_off_the_start(control, radius, step):
    way = [((50, 0),), ((60, 0),), ((60, 40),), ((-25, 40),), ((-25, -step),), ((100, -step),)]
    run = milled(control, (radius, 1, (-12, 6), (0, 0), way, (130, -step)))
    assert run.ok and not run.gouges


def test_rolling_onto_a_closed_contour_through_its_last_wall_is_refused():
    """About an outside corner; from the other side of the last wall the tool comes through it."""
    way = [((0, 30),), ((-30, 30),), ((-30, -20),), ((0, 0),)]
    for approach, fits in (((20, -5), True), ((-10, -30), True), ((-20, -5), False)):
        contour = 4, -1, approach, (0, 0), way, (20, 12)
        run = milled("mnc", contour)
        assert run.ok == fits and [g.kind for g in run.gouges] == ([] if fits else ["entry"]), run.gouges
        assert (cut(milled("mnc", contour, gouge="mark"), contour, passes=False) > DEEP) != fits


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(100))  # 300 and more by hand
def test_random_contours(seed):
    contour = random_contour(np.random.default_rng([seed, 77]))
    if contour is None:
        pytest.skip("a contour that crosses itself")
    assert not list(wrong(contour))
    assert not list(misplaced(contour, "tnc-620"))

"""1,000 random contours with cusps, spikes and hooks on three controls, against LinuxCNC and against plain geometry.

LinuxCNC looks at the next element only: of what it accepts some cuts into the contour, and it refuses some that has a path.
Where its path is clear of the contour (the records know by samples) it is ours. Beside that every path that is accepted is
sampled, and no place of the tool centre is nearer to any element than the radius. And what is refused has no path: none of
the ways round the joints, rolling about them or going to where the offsets meet, keeps clear. See tests/authorities/README.md.
"""

import gzip
import itertools
import json
import math
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup, Tool

pytestmark = pytest.mark.deep

FILE = Path(__file__).parents[1] / "authorities" / "cusps.json.gz"
RECORDS = json.loads(gzip.decompress(FILE.read_bytes()))["records"]
RADII = sorted({record["radius"] for record in RECORDS})
TOOLS = {n: Tool(radius=radius) for n, radius in enumerate(RADII, 1)}
EXACT = 1e-9  # mm: LinuxCNC hands doubles over in inches
CLEAR = 1e-6  # mm


# --- plain geometry: an element is start, end, and for arcs centre and turn -------------------------------------------


def sweep(e):
    if len(e) == 4:
        return 0.0
    angle = math.atan2(e[3] - e[5], e[2] - e[4]) - math.atan2(e[1] - e[5], e[0] - e[4])
    return e[6] * (e[6] * angle % math.tau)


def points(e, t):
    """Points (m, 2) after the shares t (m,) of an element, and the unit tangents there."""
    t = np.asarray(t, dtype=float)[:, None]
    start, end = np.array(e[:2]), np.array(e[2:4])
    if len(e) == 4:
        travel = end - start
        return start + travel * t, np.broadcast_to(travel / np.hypot(*travel), (len(t), 2))
    angle, centre = (t * sweep(e))[:, 0], np.array(e[4:6])
    x, y = start - centre
    spoke = np.stack([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)], axis=1)
    return centre + spoke, e[6] * np.stack([-spoke[:, 1], spoke[:, 0]], axis=1) / math.hypot(x, y)


def beside(e, t, shift):
    """Where a tool stands that touches the element after the shares t, `shift` mm to the left of it."""
    at, along = points(e, t)
    return at + shift * np.stack([-along[:, 1], along[:, 0]], axis=1)


def distance(p, e):
    """Distances of points p (m, 2) from an element."""
    start, end = np.array(e[:2]), np.array(e[2:4])
    least = np.minimum(np.hypot(*(p - start).T), np.hypot(*(p - end).T))
    if len(e) == 4:
        travel = end - start
        t = (p - start) @ travel / (travel @ travel)
        return np.where((t > 0) & (t < 1), np.abs((p - start) @ [-travel[1], travel[0]]) / np.hypot(*travel), least)
    v, w = p - np.array(e[4:6]), start - np.array(e[4:6])
    angle = e[6] * (np.arctan2(v[:, 1], v[:, 0]) - math.atan2(w[1], w[0])) % math.tau
    return np.where(angle < abs(sweep(e)), np.abs(np.hypot(*v.T) - np.hypot(*w)), least)


def clearance(p, elements):
    return min(float(distance(p, e).min()) for e in elements)


def around(centre, start, end, side, m):
    """Places on the arc about a corner, by which a tool on that side rolls over it."""
    a, b = np.asarray(start) - centre, np.asarray(end) - centre
    first = math.atan2(a[1], a[0])
    angle = first - side * np.linspace(0, 1, m) * (-side * (math.atan2(b[1], b[0]) - first) % math.tau)
    return centre + np.hypot(*a) * np.stack([np.cos(angle), np.sin(angle)], axis=1)


# --- programs: all contours in one, in three languages ----------------------------------------------------------------


def leads(record):
    """Where the entry begins and the exit ends, on the tangents."""
    away = 2 * record["radius"] + 5
    (first, t), (last, u) = (points(e, [k]) for e, k in ((record["elements"][0], 0), (record["elements"][-1], 1)))
    return (first - away * t)[0], (last + away * u)[0]


def iso(record, tool, call):
    begin, end = leads(record)
    yield call.format(tool)
    yield f"G90 G0 X{begin[0]:.7f} Y{begin[1]:.7f}"
    x, y = record["elements"][0][:2]
    yield f"G4{1 if record['side'] > 0 else 2} G1 X{x} Y{y} F100"
    for e in record["elements"]:
        arc = f" I{e[4] - e[0]:.4f} J{e[5] - e[1]:.4f}" if len(e) > 4 else ""
        yield f"G{(1, 3, 2)[e[6]] if arc else 1} X{e[2]} Y{e[3]}{arc}"
    yield f"G40 G1 X{end[0]:.7f} Y{end[1]:.7f}"


def klartext(record, tool, _):
    begin, end = leads(record)
    yield f"TOOL CALL {tool} Z S1000"
    yield f"L X{begin[0]:.7f} Y{begin[1]:.7f} R0 FMAX"
    yield "L X{} Y{} R{} F100".format(*record["elements"][0][:2], "L" if record["side"] > 0 else "R")
    for e in record["elements"]:
        if len(e) > 4:
            yield f"CC X{e[4]} Y{e[5]}"
        yield f"C X{e[2]} Y{e[3]} DR{'+' if e[6] > 0 else '-'}" if len(e) > 4 else f"L X{e[2]} Y{e[3]}"
    yield f"L X{end[0]:.7f} Y{end[1]:.7f} R0"


CONTROLS = {"mnc": (iso, "T{0}"), "g43": (iso, "T{0} M6 D{0}"), "tnc-620": (klartext, "")}


@pytest.fixture(scope="module", params=CONTROLS)
def found(request):
    """Of every record the rows from the end of the entry to the start of the exit, and the kinds of its gouges."""
    write, call = CONTROLS[request.param]
    text, first = [], [1]
    for record in RECORDS:
        text += write(record, RADII.index(record["radius"]) + 1, call)
        first.append(len(text) + 1)
    run = mnclab.run("\n".join(text) + "\n", request.param, Setup(tools=TOOLS, settings={"gouge": "mark"}))
    assert run.ok, run.alarms
    kinds = [[] for _ in RECORDS]
    for gouge in run.gouges:
        kinds[int(np.searchsorted(first, gouge.line, "right")) - 1].append(gouge.kind)
    path = run.toolpath[(run.toolpath.side != 0) & run.toolpath.is_motion]
    at = np.searchsorted(path.line, first)
    return request.param, [path[a + 1 : b] for a, b in itertools.pairwise(at.tolist())], kinds


def test_the_same_path_where_that_of_linuxcnc_is_clear(found):
    control, paths, kinds = found
    same = 0
    for record, path, gouges in zip(RECORDS, paths, kinds, strict=True):
        if record.get("clear"):
            assert not gouges, record["mnc"]
            rows = record["rows"][1:-1]
            assert len(path) == len(rows), record["mnc"]
            assert np.abs(path.end[:, :2] - np.array([row[1:3] for row in rows])).max() <= 1e-8, record["mnc"]
            arcs = [k for k, row in enumerate(rows) if len(row) > 3]
            assert np.flatnonzero(path.kind == Kind.ARC).tolist() == arcs
            assert np.allclose(path.sweep[arcs], [rows[k][5] for k in arcs], rtol=0, atol=1e-8)
            same += 1
    assert same >= 500


def test_no_path_that_is_accepted_comes_nearer_than_the_radius(found):
    """The TNC does not look at the whole contour: one begins where its own second element ends, and cuts into it."""
    control, paths, kinds = found
    accepted, bad = 0, []
    for record, path, gouges in zip(RECORDS, paths, kinds, strict=True):
        if gouges:
            continue
        t, where = np.linspace(0, 1, 61), []
        for row in path:
            arc = [*row.centre[:2], np.sign(row.sweep)] if row.kind == Kind.ARC else []
            one = [*row.start[:2], *row.end[:2], *arc]
            where.append(points(one, t)[0])
        least = clearance(np.concatenate(where), record["elements"])
        if least > record["radius"] - CLEAR:
            accepted += 1
        else:
            bad.append(record["mnc"])
    assert accepted > 550 and len(bad) <= (control == "tnc-620"), bad


def has_a_path(record):
    """Whether some way round the joints keeps the tool clear of every element and leaves a piece of each to cut."""
    elements, radius, side = record["elements"], record["radius"], record["side"]
    shift, grid = side * radius, np.linspace(0, 1, 201)
    ways = []
    for a, b in itertools.pairwise(elements):
        there = [(1.0, 0.0)]  # straight on, or rolling about the joint
        one, other = beside(a, grid, shift), beside(b, grid, shift)
        apart = np.hypot(*(one[:, None] - other[None]).transpose(2, 0, 1))
        step = 2 * max(np.hypot(*np.diff(line, axis=0).T).max() for line in (one, other))
        for x, y in np.argwhere(apart < step):  # where the offsets meet, by Newton's method
            if apart[x, y] == apart[max(x - 1, 0) : x + 2, max(y - 1, 0) : y + 2].min():
                there += meeting(a, b, grid[x], grid[y], shift)
        ways.append(sorted({(round(x, 9), round(y, 9)) for x, y in there}))
    for way in itertools.product(*ways):
        begin, end = [0.0, *(y for _, y in way)], [*(x for x, _ in way), 1.0]
        if all(x - y > 1e-9 for x, y in zip(end, begin, strict=True)):
            rows = [beside(e, np.linspace(y, x, 101), shift) for e, x, y in zip(elements, end, begin, strict=True)]
            joints = [
                around(np.array(e[2:4]), before[-1], after[0], side, 61)
                for e, before, after in zip(elements, rows, rows[1:], strict=False)
                if np.hypot(*(before[-1] - after[0])) > CLEAR
            ]
            if clearance(np.concatenate(rows + joints), elements) > radius - CLEAR:
                return True
    return False


def meeting(a, b, x, y, shift):
    """The shares of two elements whose offsets meet near x and y: one pair or none."""
    for _ in range(20):
        (p,), (q,) = beside(a, [x], shift), beside(b, [y], shift)
        along = [(beside(e, [t + 1e-6], shift)[0] - at) / 1e-6 for e, t, at in ((a, x, p), (b, y, q))]
        matrix = np.stack([along[0], -along[1]], axis=1)
        if abs(np.linalg.det(matrix)) < 1e-12:
            return []
        dx, dy = np.linalg.solve(matrix, q - p)
        x, y = float(np.clip(x + dx, -0.5, 1.5)), float(np.clip(y + dy, -0.5, 1.5))
    (p,), (q,) = beside(a, [x], shift), beside(b, [y], shift)
    return [(x, y)] if np.hypot(*(p - q)) < 1e-8 and 0 <= x <= 1 and 0 <= y <= 1 else []


def test_what_is_refused_has_no_path(found):
    control, _, kinds = found
    refused = 0
    for record, gouges in zip(RECORDS, kinds, strict=True):
        if gouges:
            refused += 1
            assert control != "mnc" or not has_a_path(record), record["mnc"]
    assert refused > 300


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize(
    "second, meets",
    [
        ([20, 0, 40, 0, 30, 0, -1], (20, math.sqrt(12**2 - 10**2))),  # circles of radius 12 about X10 and X30
        ([20, 0, 20, 40], (18, math.sqrt(12**2 - 8**2))),  # the parallel to the wall
    ],
)
def test_a_bump_and_what_touches_it_is_an_inside_corner(control, second, meets):
    """A half circle of radius 10, then another one or a wall, whose tangents are opposite; tool radius 2 to the left."""
    write, call = CONTROLS[control]
    record = {"elements": [[0, 0, 20, 0, 10, 0, -1], second], "radius": 2, "side": 1}
    run = mnclab.run("\n".join(write(record, 1, call)) + "\n", control, Setup(tools={1: Tool(radius=2)}))
    assert run.ok, run.alarms
    path = run.toolpath[(run.toolpath.side != 0) & run.toolpath.is_motion]
    assert path.end[1, :2].tolist() == pytest.approx(meets)

"""What compensation refuses is what would be cut: the way of the tool centre measured densely against every element."""

import math

import numpy as np
import pytest
from shapely import LineString

import mnclab
from mnclab import Setup, Tool

WALL_59 = (
    4,
    """G42 G1 X6.373155017794 Y-1.477807725268 F200
G3 X-3.321987068526 Y25.637165524099 I-8.345185906153 J12.306890773156
G1 X17.689365853961 Y27.552633361502
G1 X5.054350951208 Y46.789475517362
G3 X-20.834013629191 Y52.820873229388 I-16.112318744864 J-10.582786187558
G1 X-5.071717458766 Y62.095654992169
G3 X-18.209886919055 Y59.186664971413 I-6.126251094371 J-3.454509898018
G3 X-36.329197182563 Y81.938000643341 I-21.265981380165 J1.654470994521
G1 X-50.114805327221 Y83.994172289586
G40 G1 X-58.027276021165 Y85.174344953854
""",
    (-0.248130319096, -5.967638511331),
)
WALL_136 = (
    1.5,
    """G42 G1 X-0.426374346999 Y18.285449441992 F200
G3 X-8.835370407658 Y28.125551348129 I-4.778529582093 J4.429504299841
G1 X14.001829464698 Y43.449124571246
G3 X-8.704255221831 Y27.613277882397 I-11.07175548028 J-8.321243953523
G3 X-18.401412434637 Y28.174754034029 I-5.053838487214 J-3.264269718233
G1 X-9.092903392063 Y20.918298779661
G40 G1 X-4.755195852072 Y17.536835590818
""",
    (-4.165362979414, 14.251845097653),
)
BUMPS_210 = (
    5,
    """G41 G1 X-2.172647967317 Y-12.31621548394 F200
G1 X-16.362982363719 Y-2.734332235036
G2 X-20.802191891934 Y11.409855969889 I6.656431663214 J9.857873315103
G2 X-30.684658654129 Y12.703654232707 I-4.780083337899 J1.877817421689
G2 X-47.303996265734 Y-6.123161499915 I-16.795683044847 J-1.92239411133
G1 X-61.52819648187 Y-6.27145403984
G40 G1 X-70.527707424275 Y-6.365277264728
""",
    (5.286159438118, -17.35270156936),
)


def milled(body, radius, start=(0.0, 0.0), **settings):
    head = f"G54 G17 G90 G40 G160 T1\nS1000 M3\nG0 X{start[0]} Y{start[1]} Z-2\n"
    setup = Setup(tools={1: Tool(radius=radius, number=1, cutting_length=100)}, start=(0, 0, 100), settings=settings)
    return mnclab.run(head + body, "mnc", setup)


def klartext(points, radius, **settings):
    """RL along points, with a lead before the first and after the last of them."""
    a, *way, z = [f"X{x:+.6f} Y{y:+.6f}" for x, y in points]
    body = "".join(f"L {p}\n" for p in way[1:])
    setup = Setup(tools={1: Tool(radius=radius, number=1, cutting_length=100)}, start=(0, 0, 100), settings=settings)
    head = f"BEGIN PGM T MM\nTOOL CALL 1 Z S1000\nL Z+50 R0 FMAX M3\nL {a} R0 FMAX\nL Z-5 F300\n"
    text = f"{head}L {way[0]} RL\n{body}L {z} R0\nL Z+50 R0 FMAX M30\nEND PGM T MM\n"
    return mnclab.run(text, "tnc-620", setup)


def iso(points, radius, **settings):
    a, *way, z = [f"X{x:.6f} Y{y:.6f}" for x, y in points]
    body = "".join(f"{p}\n" for p in way[1:])
    setup = Setup(tools={1: Tool(radius=radius, number=1, cutting_length=100)}, start=(0, 0, 100), settings=settings)
    text = f"G54 G17 G90 G40 G160 T1\nS1000 M3\nG0 {a} Z50\nG1 Z-5 F300\nG41 G1 {way[0]} F300\n{body}G40 G1 {z}\n"
    return mnclab.run(text, "mnc", setup)


def nearest(run):
    """How near the tool centre comes to the contour between entry and exit, mm, less the radius: dense points of both."""

    def points(path, step):
        return path.points(step)[0][:, :2]

    made, given = run.toolpath, run.programmed
    tool, wall = made[made.side != 0][1:], given[given.side != 0][1:]
    a, b = points(tool, 1e-4), points(wall, 1e-4)
    fine = [np.linspace(p, q, max(2, int(np.hypot(*(q - p)) / 0.02))) for p, q in zip(b[:-1], b[1:])]
    wall_points = np.concatenate(fine)
    fine = [np.linspace(p, q, max(2, int(np.hypot(*(q - p)) / 0.05))) for p, q in zip(a[:-1], a[1:])]
    least = np.inf
    for piece in np.array_split(np.concatenate(fine), 40):
        least = min(least, float(np.sqrt(((piece[:, None] - wall_points[None]) ** 2).sum(axis=2)).min()))
    return least - float(np.abs(tool.radius).max())


def test_the_measure_knows_a_twin():
    """A slot of 10 mm, cut all round: a tool of 4.9 has room, one of 5.1 has not."""
    slot = "G41 G1 X0 Y0 F200\nX40\nY10\nX-10\nG40 X-30\n"
    good = milled(slot, 4.9, (-20, 0), gouge="mark")
    bad = milled(slot, 5.1, (-20, 0), gouge="mark")
    assert -0.25 < nearest(bad) < -0.1 and nearest(good) > -0.03
    assert not milled(slot, 5.1, (-20, 0)).ok and good.ok and not good.gouges


@pytest.mark.parametrize(("radius", "body", "start"), [WALL_59, WALL_136, BUMPS_210])
def test_walls_that_the_tool_passes_are_no_fault(radius, body, start):
    """The walls face each other nearer than the tool is wide, but its way beside them keeps clear of all."""
    run = milled(body, radius, start)
    assert run.ok and not run.gouges, run.alarms
    assert nearest(run) > -0.03  # of points 0.02 and 0.05 mm apart


CROSSING = [(-20, -5), (0, 0), (40, 0), (40, 20), (20, 20), (20, -20), (20, -40)]
NARROW = [(-10, 0), (0, 0), (30, 0), (30, 20), (26, 20), (26, 5), (0, 5), (-10, 5)]


@pytest.mark.parametrize(("points", "radius"), [(CROSSING, 2), (NARROW, 2.2), (NARROW, 2.6)])
def test_one_verdict_for_one_contour(points, radius):
    """The MNC refuses it; the TNC 620 goes on where its neighbours alone have room, and says each place; both mark the same."""
    mnc, tnc = iso(points, radius), klartext(points, radius)
    assert not mnc.ok and mnc.gouges
    assert tnc.gouges, tnc.alarms
    both = [
        {(g.kind, round(g.width, 6), round(g.missing, 6)) for g in run(points, radius, gouge="mark").gouges}
        for run in (iso, klartext)
    ]
    assert both[0] == both[1]
    refused = klartext(points, radius, gouge="refuse")
    assert not refused.ok and [a.severity for a in refused.alarms if "tool of radius" in a.message] == ["alarm"]
    if tnc.ok:
        told = [a for a in tnc.alarms if a.severity == "warning" and "tool of radius" in a.message]
        assert len(told) == len(tnc.gouges) and tnc.toolpath.gouge.any()


def test_what_fits_has_no_warning():
    """The same outlines with a tool that has room everywhere: 1.9 mm in a gap of 4."""
    wide = [(-10, 0), (0, 0), (30, 0), (30, 20), (26, 20), (26, 9), (0, 9), (-10, 9)]
    for points, radius in ((wide, 1.9), (NARROW, 1.9)):
        run = klartext(points, radius)
        assert run.ok and not run.gouges and not run.toolpath.gouge.any()


@pytest.mark.parametrize("control", ["mnc", "tnc-620"])
def test_off_and_on_again_without_a_way_between_is_said(control):
    """What LinuxCNC obeys as an exit along Z has no rule in the manuals: the contour goes on, and a warning says so."""
    text = {
        "mnc": "G54 G17 G90 T1\nS1000 M3\nG0 X-20 Y0 Z0\nG41 G1 X0 Y0 F100\nX50\nG40\n{}G0 Z5\nG41 G1 X50 Y30\nG40 G1 X50 Y60\n",
        "tnc-620": "BEGIN PGM T MM\nTOOL CALL 1 Z S1000\nL X-20 Y+0 Z+0 R0 FMAX M3\nL X+0 Y+0 RL F100\nL X+50\n"
                   "{}L Z+5 R0 FMAX\nL X+50 Y+30 RL F100\nL X+50 Y+60 R0\nEND PGM T MM\n",
    }[control]  # fmt: skip
    away = {"mnc": "G1 X80\n", "tnc-620": "L X+80 R0\n"}[control]
    setup = Setup(tools={1: Tool(radius=5, number=1)})
    for between, count in (("", 1), (away, 0)):
        told = [a for a in mnclab.run(text.format(between), control, setup).alarms if "on again" in a.message]
        assert [a.severity for a in told] == ["warning"] * count


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(60))
def test_random_contours(seed):
    """Every verdict of "fits" is true of the way as it was measured, on both controls; what is marked comes too near."""
    rng = np.random.default_rng(seed)
    heading, at, points = 0.0, np.zeros(2), [np.array([-15.0, 0.0]), np.zeros(2)]
    for _ in range(6):
        heading += rng.uniform(-2.2, 2.2)
        at = at + rng.uniform(6, 20) * np.array([math.cos(heading), math.sin(heading)])
        points.append(at)
    points.append(at + 15 * np.array([math.cos(heading), math.sin(heading)]))
    if not LineString(points[1:-1]).is_simple:
        pytest.skip("a contour that crosses itself: what lies behind a crossing need not stand")
    for make in (iso, klartext):
        run = make(points, 2.0, gouge="mark")
        if not run.ok:
            continue
        if not run.gouges:
            assert nearest(run) > -0.03, make
        elif nearest(run) > 0.02:
            raise AssertionError(run.gouges)

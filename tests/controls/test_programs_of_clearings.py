"""The path of a clearing, written as a program, run on its control: the same path again, and the pocket in the part."""

import functools

import numpy as np
import pytest
import shapely
from tools.together import deep_but_one_in

import mnclab
from mnclab.comparison.strategies import compare
from mnclab.design import Pocket
from mnclab.geometry.arcs import FULL
from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import polygons
from mnclab.machining.milling.entries import VERTICAL, Entry
from mnclab.path.toolpath import Kind
from mnclab.strategies import STRATEGIES, rest

CONTROLS = ("g43", "mnc", "tnc-620")
SETUP = mnclab.Setup(tools={1: mnclab.Tool(radius=4, length=60, teeth=3)}, stock=((-50, -50, -10), (70, 70, 0)))
REGIONS = {
    "square": Region.of(rectangle(60, 60)),
    "L": Region.of(Contour([(0, 0), (60, 0), (60, 25), (25, 25), (25, 60), (0, 60)])),
    "island": Region.of(rectangle(70, 60), holes=[Contour.circle((5, 3), 8)]),
}
HELIX = Entry("helix", 3)


@functools.cache
def trials(name, entry=VERTICAL, *strategies):
    return compare(REGIONS[name], 4.0, *strategies, overlap=0.6, entry=entry)


def obeyed(trial, control, **options):
    """The run of a program, and its rows from where the path begins to where it ends."""
    run = mnclab.run(trial.program(control, **options), control, setup=SETUP)
    assert run.ok and not run.alarms, run.alarms[:3]
    rows = run.toolpath.motion
    begin = int(np.flatnonzero(np.abs(rows.end - trial.path.start[0]).max(axis=1) < 1e-3)[0]) + 1
    return run, rows[begin : len(rows) - 1]


def check_same(path, rows, unit):
    """Every row of the path is the next one that was run, or has no length that is written."""
    at, last = -1, path.start[0]
    for k in range(len(path)):
        if at + 1 < len(rows) and np.abs(rows.end[at + 1] - path.end[k]).max() < 3 * unit:
            at += 1
        else:
            assert np.abs(last - path.end[k]).max() < 3 * unit
            continue
        last = rows.end[at]
        assert rows.feed[at] == pytest.approx(path.feed[k], abs=5e-4)
        if path.kind[k] == Kind.ARC == rows.kind[at]:
            assert np.abs(rows.centre[at] - path.centre[k])[:2].max() < unit
            assert (rows.sweep[at] > 0) == (path.sweep[k] > 0)
        elif path.kind[k] != rows.kind[at]:  # an arc that is a line
            chord, half = np.linalg.norm(path.end[k] - path.start[k]), abs(path.sweep[k]) / 2
            assert path.kind[k] == Kind.ARC and (chord < FULL + 2 * unit or chord / 2 * np.tan(half / 2) < 2 * unit)
    assert at == len(rows) - 1


@pytest.mark.parametrize("name", deep_but_one_in(3, REGIONS))
def test_the_run_is_the_path(name):
    """With nine decimals, 1e-9 mm."""
    for trial in trials(name):
        for control in CONTROLS:
            check_same(trial.path, obeyed(trial, control, decimals=9)[1], 1e-9)


@pytest.mark.parametrize("decimals", [3, 6])
def test_with_fewer_decimals_it_is_that_near(decimals):
    for trial in trials("L", HELIX):
        for control in ("g43", "tnc-620"):
            check_same(trial.path, obeyed(trial, control, decimals=decimals)[1], 10.0**-decimals)


def test_a_helix_of_the_mnc_is_chords_within_it():
    """Their ends lie on the circle about its centre, their middles less than 0.001 mm inside."""
    trial = trials("square", HELIX, "rings")["rings"]
    rows = obeyed(trial, "mnc", decimals=9)[1]
    helix = (trial.path.kind == Kind.ARC) & (trial.path.end[:, 2] < trial.path.start[:, 2])
    centre, radius = trial.path.centre[helix][0, :2], np.hypot(*(trial.path.end - trial.path.centre)[helix][0, :2])
    chords = rows[(rows.start[:, 2] > rows.end[:, 2]) & (rows.start[:, 2] <= 0)]
    assert (chords.kind == Kind.LINE).all() and len(chords) > 20
    assert np.hypot(*(chords.end[:, :2] - centre).T) == pytest.approx(radius, abs=2e-9)
    middle = np.hypot(*((chords.start + chords.end)[:, :2] / 2 - centre).T)
    assert (middle < radius).all() and (middle > radius - 0.00101).all()
    assert chords.end[-1, 2] == -1


@pytest.mark.parametrize("name", REGIONS)
@pytest.mark.parametrize("control", CONTROLS)
def test_the_part_has_the_pocket(name, control):
    """1 deep wherever a disc of radius 4 within the region reaches, as it was elsewhere; nothing is hit."""
    trial = trials(name, HELIX, "rounded rings")["rounded rings"]
    run, _ = obeyed(trial, control)
    assert not len(run.collisions())
    reach = polygons(REGIONS[name]).buffer(-4, quad_segs=400).buffer(4, quad_segs=400)
    spots = np.random.default_rng(5).uniform(-45, 65, (3000, 2))
    sure = shapely.distance(reach.boundary, shapely.points(spots)) > 0.01
    inside = shapely.contains_xy(reach, *spots.T)
    heights = run.workpiece().at(*spots.T)
    assert heights[sure] == pytest.approx(-1.0 * inside[sure], abs=1e-6)
    assert -0.01 < run.workpiece().removed / reach.area - 1 < 0.001


BOX = Region.of(rectangle(60, 40))
#: What stands of the box, what is air 2 deep, and how large the area is that a tool of radius 3 takes away.
STOCKS = {
    "a third": (Region.of(rectangle(20, 60, centre=(20, 0))), Pocket.rectangle(-10, 0, 40, 40, 2), 800 - (4 - np.pi) * 9 / 2),
    "corners": (rest(BOX, 8.0), Pocket.rectangle(0, 0, 60, 40, 2, corner=8), (4 - np.pi) * (64 - 9)),
}


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize(
    ("name", "stock"), deep_but_one_in(5, [(name, stock) for name in STRATEGIES for stock in STOCKS]), ids=str
)
def test_a_stock_is_met_from_its_open_side(name, stock, control):
    """On a blank with that air in it nothing is hit, on either of two levels, and all that can be reached is gone."""
    stands, air, cut = STOCKS[stock]
    trial = compare(BOX, 3.0, name, stepover=1.8, stock=stands, depth=(1, 2), entry=HELIX)[name]
    blank = mnclab.Design(((-50, -50, -9), (50, 50, 0)), air)
    setup = mnclab.Setup(tools={1: mnclab.Tool(radius=3, length=60, teeth=3)}, stock=blank)
    run = mnclab.run(trial.program(control), control, setup=setup)
    assert run.ok and not run.alarms and not run.collisions()
    assert run.workpiece().removed == pytest.approx(2 * cut, rel=3e-3)


def test_where_there_is_no_air_it_is_hit():
    """That blank without its air: the small lifts of adaptive clearing go through material."""
    trial = compare(BOX, 3.0, "adaptive", stepover=1.8, stock=STOCKS["a third"][0])["adaptive"]
    run = mnclab.run(trial.program("g43"), "g43", setup=SETUP)
    assert any(hit.kind == "rapid" for hit in run.collisions())


def test_what_it_takes():
    trial = compare(REGIONS["square"], mnclab.Tool(radius=4, teeth=3), "rings", spindle=6000)[0]
    assert "S6000 M3" in trial.program("g43") and "TOOL CALL 7 Z S6000" in trial.program("TNC-620", tool=7)
    assert "S900 M3" in trials("square")["rings"].program("mnc", spindle=900)
    wrong = {"decimals": 2}, {"decimals": 10}, {"tool": 0}, {"tool": 1.5}, {"spindle": 0}, {"spindle": "x"}, {"speed": 3}
    for options in wrong:
        with pytest.raises(mnclab.Alarm):
            trial.program("g43", **options)
    for control in ("linuxcnc", None, 3):
        with pytest.raises(mnclab.Alarm):
            trial.program(control)

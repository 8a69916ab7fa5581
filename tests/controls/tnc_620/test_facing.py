"""Cycle 233: the manual's example with the numbers worked out for it, strategies, limits, order, feeds.

Tool radii are not printed; each test says which it takes. What the cycle takes away: test_studs_swept.
"""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from tools.running import changed, of_cycles, run

import mnclab
from mnclab import Kind, Setup, Tool
from mnclab.machine import trial

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-pockets.json"
EXAMPLES = {example["code"]: example["program"] for example in json.loads(FILE.read_text(encoding="utf-8"))}
PROGRAM = EXAMPLES["CYCL DEF 233"]
CYCLE = mnclab.controls["tnc-620"].cycles["CYCL DEF 233"]


def near(value):
    return pytest.approx(value, abs=1e-6)


def milled(radius=10.0, edges=0.0, settings=None, **change):
    """The motion of the cycle in the example; Q parameters may be changed."""
    tools = {1: Tool(radius=radius, cutting_length=edges)}
    program = f"1 TOOL CALL 1 Z S1000\n{changed(PROGRAM, **change)}"
    return of_cycles(run(program, "tnc-620", tools=tools, start=(0, 0, 100), settings=settings or {}).toolpath)


def said(rows, *parts):
    return rows[np.array([all(part in rows.labels[k] for part in parts) for k in rows.label], dtype=bool)]


def lines(rows, level="level 1 of 2"):
    """From and to of the lines of a level, in X and Y."""
    found = said(rows, f"{level}, line")
    return [(a[0], a[1], b[0], b[1]) for a, b in zip(found.start.tolist(), found.end.tolist(), strict=True)]


@pytest.mark.parametrize(
    ("radius", "factor", "places"),
    [(10, 1, range(0, 71, 10)), (20, 1, range(0, 61, 20)), (10, 1.5, range(5, 71, 13))],
)
def test_example_6_9(radius, factor, places):
    """Lines along X from R + 2 outside to R + 2 outside, from Y0 to the far edge; equal infeeds of 2.9, then -6."""
    rows = milled(radius, Q370=factor)
    out = radius + 2
    assert lines(rows) == [near((-out, y, 120 + out, y)) for y in places]
    assert sorted(set(said(rows, ", line").end[:, 2].round(6)), reverse=True) == [-2.9, -5.8, -6]
    assert said(rows, "floor finishing, line").feed[0] == 500 and rows[-1].end.tolist() == near([-out, min(places), 50])
    lift, back, down = (said(rows, f"level 1 of 2, {what}")[0] for what in ("lift", "back", "down"))
    assert lift.end[2] == near(-0.9) and back.end.tolist() == near([-out, places[1], -0.9])
    assert {lift.kind, back.kind} == {Kind.RAPID}
    assert (down.feed, said(rows, "level 1 of 2, down")[1].feed, said(rows, "level 2 of 2, down")[0].feed) == (
        500,
        750,
        750,
    )


@pytest.mark.parametrize(
    ("strategy", "first", "second"),
    [
        (0, (-12, 0, 132, 0), (132, 10, -12, 10)), (1, (-12, 0, 122, 0), (122, 10, -2, 10)),
        (2, (-12, 0, 132, 0), (-12, 10, 132, 10)), (3, (-12, 0, 122, 0), (-12, 10, 122, 10)),
    ],
)  # fmt: skip
def test_strategies(strategy, first, second):
    """R = 10, Q357 = 2: where the first two lines begin and end; the step of a meander outside at Q253, at the edge at Q207."""
    rows = milled(Q389=strategy)
    assert lines(rows)[:2] == [near(first), near(second)]
    links = said(rows, "level 1 of 2, link")
    assert (links.feed == (750 if strategy == 0 else 500)).all() and len(links) == (7 if strategy < 2 else 0)


@pytest.mark.parametrize("strategy", [2, 3])
@pytest.mark.parametrize("change", [{}, {"Q350": 2}, {"Q347": -1, "Q348": 1}, {"Q218": -120, "Q219": -80}], ids=str)
def test_the_way_back_is_one_straight_rapid_to_the_next_line(strategy, change):
    """Up, one rapid to where the next line begins, down: nothing else lies between two lines of a level."""
    rows = milled(Q389=strategy, Q200=3, **change)
    each = lines(rows)
    backs = said(rows, "level 1 of 2, back")[:-1]  # the last one leads to the start of the level
    assert len(backs) == len(each) - 1 > 3
    assert (backs.kind == Kind.RAPID).all() and (backs.start[:, 2] == backs.end[:, 2]).all()
    assert backs.start[:, :2].tolist() == [near(line[2:]) for line in each[:-1]]
    assert backs.end[:, :2].tolist() == [near(line[:2]) for line in each[1:]]


@pytest.mark.parametrize(("clearance", "scraped"), [(2, 0.9), (2.8, 0.1), (2.9, 0), (5, 0)])
def test_a_way_back_below_what_still_stands_is_named(clearance, scraped):
    """Infeeds of 2.9: Q200 above the depth is not above the next line unless Q200 is at least that."""
    program = PROGRAM.replace("Q200=2", f"Q200={clearance}")
    found = mnclab.run(f"TOOL CALL 1 Z S1000\n{program}\n", "tnc-620", Setup(tools={1: Tool(radius=10)}))
    warnings = [alarm.message for alarm in found.alarms]
    passes = f"CYCL DEF 233 Q200={clearance:g}: the rapid way back to the next line passes {scraped:g} mm below what "
    assert found.ok and warnings == ([f"{passes}that line has still to take away"] if scraped else [])


def test_the_spiral():
    """From 12 mm beside the corner on an arc onto the left edge, upwards: clockwise, and each round 10 mm farther in."""
    rows = milled(Q389=4)
    approach, way = said(rows, "level 1 of 2, approach")[0], said(rows, "level 1 of 2, spiral")
    assert approach.start[:2].tolist() == near([-12, 0]) and approach.kind == Kind.ARC and approach.feed == 500
    corners = [(0, 80), (120, 80), (120, 0), (10, 0), (10, 70), (110, 70), (110, 10), (20, 10)]
    assert way.end[: len(corners), :2].tolist() == [near(list(corner)) for corner in corners]
    up = said(milled(Q389=4, Q350=2), "over the start")
    assert up.end[0, :2].tolist() == near([0, -12])
    back = milled(Q389=4, Q218=-120, Q219=-80)
    assert said(back, "level 1 of 2, spiral").end[0, :2].tolist() == near([0, -80])  # clockwise too


@pytest.mark.parametrize(
    ("position", "low"), [(-1, (0, 0)), (0, (-60, -40)), (1, (0, 0)), (2, (-120, 0)), (3, (-120, -80)), (4, (0, -80))]
)
@pytest.mark.parametrize("signs", [(1, 1), (-1, 1), (1, -1), (-1, -1)])
def test_positions_and_signs(position, low, signs):
    """Where the surface lies about the tool at X0 Y0; the signs say from which corner it is milled."""
    rows = milled(Q367=position, Q218=120 * signs[0], Q219=80 * signs[1])
    if position < 0:
        low = min(0, 120 * signs[0]), min(0, 80 * signs[1])
    found = np.array(lines(rows))
    xs, ys = found[:, [0, 2]], found[:, [1, 3]]
    assert (xs.min() + 12, xs.max() - 12) == near((low[0], low[0] + 120))
    assert (found[0, 2] - found[0, 0]) * signs[0] > 0 and (ys[-1, 0] - ys[0, 0]) * signs[1] > 0
    assert ys[0, 0] == near(low[1] if signs[1] > 0 else low[1] + 80)


def test_lines_along_the_minor_axis():
    """Q350 = 2: along Y, the step along X out of 120 - 10 mm: 11 of 10."""
    rows = milled(Q350=2)
    assert lines(rows) == [near((x, -12, x, 92)) for x in range(0, 111, 10)]


# --- limits ----------------------------------------------------------------------------------------------------------


def test_a_wall_at_the_end_of_the_lines():
    """R = 10, Q368 = 1: lines end at X109; what they leave before the wall goes along it, with the wall on the right."""
    rows = milled(Q347=1, Q368=1)
    assert lines(rows)[0] == near((-12, 0, 109, 0))
    along = said(rows, "level 1 of 2, along the walls")
    assert along.start[0, :2].tolist() == near([109, -10]) and along.end[-1, :2].tolist() == near([109, 90])
    side = said(rows, "side finishing")
    cut = side[(side.start[:, 2] == side.end[:, 2]) & (side.kind != Kind.RAPID)]
    assert cut.end.tolist() == [near([110, 90, -6])] and cut.feed[0] == 500


def test_lines_begin_on_the_open_side():
    """A wall in -X: lines run in -X from the open end, X132, to X11."""
    assert lines(milled(Q347=-1, Q368=1))[0] == near((132, 0, 11, 0))


def test_lines_between_two_walls():
    """Walls in -X and +X: the tool goes down inside at the milling feed, and lifts above all that stands."""
    rows = milled(Q347=-1, Q348=1)
    assert lines(rows)[0] == near((10, 0, 110, 0))
    assert said(rows, "level 2 of 2, lift").end[0, 2] == near(-0.9) and (said(rows, "level", "down").feed == 500).all()


def test_walls_beside_the_lines():
    """Walls in -Y and +Y: from Y11 to Y69 in steps of at most 10."""
    found = np.array(lines(milled(Q347=-2, Q348=2, Q368=1)))
    assert found[:, 1] == near(np.linspace(11, 69, 7))


def test_corners_between_walls():
    """Q220 = 15: the centre goes round on 15 - 10 - 1 in roughing, on 5 in finishing; three walls are one way."""
    rows = milled(Q347=-2, Q348=2, Q349=1, Q220=15, Q368=1)
    for part, radius in (("level 1 of 2, along", 4), ("side finishing", 5)):
        arcs = said(rows, part)
        arcs = arcs[arcs.kind == Kind.ARC]
        assert np.hypot(*(arcs.end - arcs.centre)[:, :2].T) == near(radius) and arcs.sweep == near(math.pi / 2)
        assert len(arcs) == 2
    assert lines(rows)[0] == near((-12, 11, 105, 11))


def test_a_corner_narrower_than_the_tool_gets_its_radius_and_a_warning():
    program = PROGRAM.replace("Q347=0", "Q347=1").replace("Q348=0", "Q348=2").replace("Q200=2", "Q200=3")
    found = mnclab.run(f"TOOL CALL 1 Z S1000\n{program}\n", "tnc-620", Setup(tools={1: Tool(radius=10)}))
    assert found.ok and [alarm.message for alarm in found.alarms] == [
        "CYCL DEF 233 Q220=2: the corners get the radius of the tool, 10"
    ]


# --- what is done ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("operation", "side", "floor", "wall", "parts"),
    [
        (0, 0.2, 0.1, 1, ["level", "floor finishing", "side finishing"]), (0, 0.2, 0, 1, ["level", "side finishing"]),
        (0, 0.2, 0.1, 0, ["level", "floor finishing"]), (0, 0, 0, 1, ["level"]), (1, 0.2, 0.1, 1, ["level"]),
        (2, 0.2, 0.1, 1, ["floor finishing", "side finishing"]), (2, 0.2, 0, 1, ["side finishing"]),
    ],
)  # fmt: skip
def test_what_is_done(operation, side, floor, wall, parts):
    rows = milled(Q215=operation, Q368=side, Q369=floor, Q347=wall)
    found = [part for k in rows.label for part in ("level", "floor finishing", "side finishing")
             if f"{part}" in rows.labels[k].replace("clearance level", "")]  # fmt: skip
    assert list(dict.fromkeys(found)) == parts
    assert rows.end[:, 2].min() == near(-6 if operation != 1 else -6 + floor)


def test_finishing_nothing_says_so():
    program = PROGRAM.replace("Q215=0", "Q215=2").replace("Q369=0,2", "Q369=0")
    found = mnclab.run(f"TOOL CALL 1 Z S1000\n{program}\n", "tnc-620")
    assert found.ok and "finishes nothing" in found.alarms[-1].message
    assert not any(label.startswith("CYCL DEF") for label in found.toolpath.labels)


def test_infeeds_are_never_deeper_than_the_edges():
    """LCUTS = 1.5: four infeeds of 1.45; walls and the last allowance of 2 are divided too."""
    assert set(said(milled(edges=1.5), "level", ", line").end[:, 2].round(6)) == {-1.45, -2.9, -4.35, -5.8}
    rows = milled(edges=1.5, Q369=2, Q368=0.5, Q347=1, Q338=4)
    assert set(said(rows, "floor finishing", ", line").end[:, 2].round(6)) == {-5, -6}
    side = said(rows, "side finishing")
    assert set(side.end[:, 2].round(6)) & {-1.5, -3, -4.5, -6} == {-1.5, -3, -4.5, -6}


def test_equal_coordinates_are_not_executed():
    assert len(milled(Q386=0, Q202=0)) == 0


def test_an_end_above_the_surface_works_upwards_where_that_is_allowed():
    rows = milled(Q386=6, settings={"depth_error": False})
    assert sorted(set(said(rows, ", line").end[:, 2].round(6))) == [2.9, 5.8, 6]
    assert said(rows, "to the set-up clearance").end[0, 2] == -2 and rows[-1].end[2] == 50


FEEDS = {"milling_feed", "finishing_feed", "prepositioning_feed"}
OTHER = {"corner_radius": 15, "limit_3": -2, "limit_1": -2, "limit_2": -1, "surface_position": 0}


@pytest.mark.parametrize("parameter", CYCLE.parameters(), ids=lambda parameter: parameter.name)
def test_a_parameter_acts(parameter):
    def tried(values):
        found = mnclab.run(trial.program(mnclab.controls["tnc-620"], CYCLE, values), "tnc-620")
        assert found.ok, found.alarms
        path = found.toolpath[found.toolpath.is_motion]
        return (path.end.round(9).tolist(), path.sweep.round(9).tolist()), path.feed.tolist()

    values, name = {p.name: p.example for p in CYCLE.parameters()}, parameter.name
    other = OTHER.get(name)
    if other is None and parameter.choices:
        other = next(choice for choice in parameter.choices if choice != parameter.example)
    if other is None:
        other = values[name] * 0.8 if values[name] else 3.5
    shape, feeds = tried(values)
    new_shape, new_feeds = tried(values | {name: other})
    assert (new_shape == shape) == (name in FEEDS) and (name not in FEEDS or feeds != new_feeds)

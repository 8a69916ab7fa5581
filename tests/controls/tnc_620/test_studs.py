"""Cycles 256 to 258: the manual's examples with the numbers worked out for them, positions, order, ways, feeds.

Tool radii are not printed; each test says which it takes. What the cycles take away: test_studs_swept.
"""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from tools.running import changed, of_cycles, run

import mnclab
from mnclab import Kind, Tool
from mnclab.machine import trial

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-pockets.json"
PROGRAMS = {example["code"][-3:]: example["program"] for example in json.loads(FILE.read_text(encoding="utf-8"))}
NUMBERS = ("256", "257", "258")
CYCLES = {f"CYCL DEF {n}": mnclab.controls["tnc-620"].cycles[f"CYCL DEF {n}"] for n in NUMBERS}


def near(value):
    return pytest.approx(value, abs=1e-4)


def milled(number, radius, settings=None, height=100.0, edges=0.0, **change):
    """The motion of the example of a cycle; Q parameters may be changed, or left out with None."""
    tools = {1: Tool(radius=radius, cutting_length=edges)}
    program = f"1 TOOL CALL 1 Z S1000\n{changed(PROGRAMS[number], **change)}"
    return of_cycles(run(program, "tnc-620", tools=tools, start=(0, 0, height), settings=settings or {}).toolpath)


def names(rows):
    return [rows.labels[k] for k in rows.label]


def said(rows, *parts):
    """The rows whose label has all these parts."""
    return rows[np.array([all(part in name for part in parts) for name in names(rows)], dtype=bool)]


def levels(rows, part=""):
    """Heights where passes are cut, each once, in order."""
    found = said(rows, part)
    level = found[(found.kind != Kind.RAPID) & (found.start[:, 2] == found.end[:, 2])]
    return list(dict.fromkeys(level.end[:, 2].round(6).tolist()))


def flats(rows):
    """How far the straight moves run from (50, 50)."""
    sides = rows[rows.kind == Kind.LINE]
    way = (sides.end - sides.start)[:, :2]
    return abs(way[:, 0] * (50 - sides.start[:, 1]) - way[:, 1] * (50 - sides.start[:, 0])) / np.hypot(*way.T)


# --- the examples of the manual --------------------------------------------------------------------------------------


def test_example_6_6():
    """R = 10: one round with half sides 40.2 and 30.2 and corners of 15.2, clockwise, from (99, 50); back to there."""
    rows = milled("256", 10)
    assert levels(rows) == [-5, -10, -15, -20]
    round_it = said(rows, "layer 1 of 4, ring")
    assert np.abs(round_it.end[:, :2] - 50).max(axis=0).tolist() == near([40.2, 30.2])
    arcs = round_it[round_it.kind == Kind.ARC]
    assert arcs.sweep.tolist() == near([-math.pi / 2] * 4)
    assert np.hypot(*(arcs.end - arcs.centre)[:, :2].T) == near(15.2)
    approach, departure = (said(rows, "layer 1 of 4", part)[0] for part in ("approach", "departure"))
    assert approach.start.tolist() == departure.end.tolist() == near([99, 50, -5])
    assert approach.sweep == departure.sweep == near(math.pi)
    assert said(rows, "down").feed.tolist() == [150] * 4 and (round_it.feed == 500).all()
    assert rows[-1].end.tolist() == near([99, 50, 50]) and not len(said(rows, "finishing"))


def test_two_rounds_with_a_smaller_tool():
    """R = 6: rounds of 39.6 x 31.1 and 36.2 x 26.2."""
    rows = milled("256", 6)
    for k, sides in ((1, [39.6, 31.1]), (2, [36.2, 26.2])):
        assert np.abs(said(rows, f"layer 1 of 4, ring {k} of 2").end[:, :2] - 50).max(axis=0).tolist() == near(sides)


def test_example_6_7():
    """R = 10: nothing of the blank to take; a circle of 40.2 about (50, 50) from (92, 50), back over the centre."""
    rows = milled("257", 10)
    assert levels(rows) == [-5, -10, -15, -20]
    circles = said(rows, "last circle")
    assert circles.sweep.tolist() == near([-math.tau] * 4) and circles.end[:, 0] == near(90.2)
    assert said(rows, "over the start").end[0, :2].tolist() == near([92, 50])
    assert rows[-1].end.tolist() == rows[-1].end.tolist() == near([50, 50, 50])


def test_a_spiral_from_a_larger_blank():
    """Q222 = 80: one turn from a radius of 50 to 40.2 and the circle, from (102, 50); off the stud by 2 mm."""
    rows = milled("257", 10, Q222=80)
    spiral = said(rows, "layer 1 of 4, spiral")
    assert spiral.start[0, :2].tolist() == near([100, 50]) and spiral.sweep.sum() == near(-math.tau)
    assert spiral.end[-1, :2].tolist() == near([90.2, 50])
    assert said(rows, "over the start").end[0, :2].tolist() == near([102, 50])
    assert said(rows, "layer 1 of 4, departure").end[0, :2].tolist() == near([92.2, 50])
    turned = milled("257", 10, Q222=80, Q376=90)
    assert said(turned, "over the start").end[0, :2].tolist() == near([50, 102])
    assert said(milled("257", 10, Q376=-1), "over the start").end[0, :2].tolist() == near([92, 50])


def test_example_6_8():
    """R = 10: a decagon; four turns of 9.0559 from 70 to 33.7764, from (105.1552, 96.2807), -10 and -18."""
    rows = milled("258", 10)
    assert levels(rows) == [-10, -18] and not len(said(rows, "finishing"))
    assert said(rows, "over the start").end[0, :2].tolist() == near([105.1552, 96.2807])
    ring = said(rows, "layer 1 of 2, last ring")
    sides = ring[ring.kind == Kind.LINE]
    assert flats(ring) == near(33.7764) and len(sides) == 10
    arcs = ring[ring.kind == Kind.ARC]
    assert np.hypot(*(arcs.end - arcs.centre)[:, :2].T) == near(12) and arcs.sweep == near(-math.radians(36))
    spiral = said(rows, "layer 1 of 2, spiral")
    assert spiral.sweep.sum() == near(-math.tau * 4 - math.radians(18))
    # the corner at 40 degrees: the arc about it begins and ends as far from the ray through it
    corner = np.array([math.cos(math.radians(40)), math.sin(math.radians(40))]) * (25 - 2 / math.cos(math.pi / 10)) + 50
    assert np.hypot(*(arcs.centre[:, :2] - corner).T).min() == near(0)
    assert rows[-1].end.tolist() == near([105.1552, 96.2807, 50])


def test_a_polygon_by_its_inscribed_circle():
    rows = milled("258", 10, Q573=0, Q572=4, Q224=45, Q220=0)
    ring = said(rows, "layer 1 of 2, last ring")
    assert np.abs(ring.end[:, :2] - 50).max() == near(35)


# --- where it lies ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("position", "centre"), [(0, (50, 50)), (1, (80, 70)), (2, (20, 70)), (3, (20, 30)), (4, (80, 30))]
)
def test_positions_of_a_rectangular_stud(position, centre):
    """The tool at the centre or at a corner of the finished stud; all turns about the tool."""
    rows = said(milled("256", 10, Q367=position), "layer 1 of 4, ring").end
    assert ((rows.max(axis=0) + rows.min(axis=0)) / 2)[:2].tolist() == near(centre)
    turned = said(milled("256", 10, Q367=position, Q224=90), "layer 1 of 4, ring").end
    x, y = centre[0] - 50, centre[1] - 50
    assert ((turned.max(axis=0) + turned.min(axis=0)) / 2)[:2].tolist() == near([50 - y, 50 + x])


@pytest.mark.parametrize(("place", "start"), [(0, (99, 50)), (1, (1, 8)), (2, (99, 8)), (3, (99, 92)), (4, (1, 92))])
@pytest.mark.parametrize("mode", [1, -1])
def test_approach_positions(place, start, mode):
    """R = 10: 37 + 2 + 10 and 30 + 2 + 10 from the centre; each arc touches the pass that it leads to."""
    rows = milled("256", 10, Q437=place, Q351=mode)
    assert said(rows, "over the start").end[0, :2].tolist() == near(start)
    assert [row.end[:2].tolist() for row in rows[[n.endswith("down") for n in names(rows)]]] == [near(start)] * 4
    spiral = said(rows, "layer 1 of 4, spiral" if place else "layer 1 of 4, ring")
    approach = said(rows, "layer 1 of 4, approach")[0]
    arm = approach.end - approach.centre
    ahead = np.sign(approach.sweep) * np.array([-arm[1], arm[0]]) / np.hypot(*arm[:2])
    way = (spiral[0].end - spiral[0].start)[:2]
    assert ahead.tolist() == near((way / np.hypot(*way)).tolist())
    assert (np.sign(spiral.sweep[spiral.sweep != 0]) == -mode).all()
    assert rows[-1].end.tolist() == near([*start, 50])


# --- what is done, and in which order --------------------------------------------------------------------------------


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize(
    ("operation", "side", "floor", "parts"),
    [
        (0, 0.2, 0.1, ["layer", "side finishing", "floor finishing"]), (0, 0, 0, ["layer"]),
        (0, 0.2, 0, ["layer", "side finishing"]), (0, 0, 0.1, ["layer", "floor finishing"]),
        (1, 0.2, 0.1, ["layer"]), (2, 0.2, 0.1, ["side finishing", "floor finishing"]),
        (2, 0.2, 0, ["side finishing"]), (2, 0, 0.1, ["floor finishing"]),
    ],
)  # fmt: skip
def test_what_is_done(number, operation, side, floor, parts):
    """Side and floor are finished where an allowance was left for it; always in this order."""
    rows = milled(number, 5, Q215=operation, Q368=side, Q369=floor)
    found = [part for name in names(rows) for part in ("layer", "side finishing", "floor finishing") if part in name]
    assert list(dict.fromkeys(found)) == parts
    depth = 18 if number == "258" else 20
    assert rows.end[:, 2].min() == near(-depth if "floor finishing" in parts or not floor else -depth + floor)


@pytest.mark.parametrize("number", NUMBERS)
def test_only_finishing_without_allowances_does_nothing_and_says_so(number):
    program = PROGRAMS[number].replace("Q368=0.2", "Q368=0")
    for old in ("Q215=1", "Q215=+1", "Q215=0"):
        program = program.replace(old, "Q215=2")
    found = mnclab.run(f"TOOL CALL 1 Z S1000\n{program}\n", "tnc-620")
    assert found.ok and "finishes nothing" in found.alarms[-1].message
    assert not any(name.startswith("CYCL DEF") for name in found.toolpath.labels)


@pytest.mark.parametrize("number", NUMBERS)
def test_depth_zero_is_not_executed_whatever_else_is_wrong(number):
    assert len(milled(number, 5, Q201=0, Q202=0, Q207=0)) == 0


@pytest.mark.parametrize("number", ["256", "257"])
def test_what_may_be_left_out(number):
    """Roughing alone, and no allowance below; a finishing feed that is missing or 0 is the milling feed."""
    rows = milled(number, 5, Q215=None, Q369=None, Q338=None, Q385=None)
    assert levels(rows) == [-5, -10, -15, -20] and not len(said(rows, "finishing"))
    assert (
        said(milled(number, 5, Q215=0, Q385=0), "side finishing", "last" if number == "257" else "ring").feed == 500
    ).all()


def test_infeeds_and_feeds_of_finishing():
    """Q338 = 6 down to -19.5, at 700; the floor once at -20; LCUTS = 2 makes ten infeeds of roughing."""
    rows = milled("256", 5, Q215=0, Q338=6, Q369=0.5, Q385=700)
    assert levels(rows, "side finishing") == near([-6, -12, -18, -19.5]) and levels(rows, "floor") == [-20]
    wall = said(rows, "side finishing", "ring")
    assert np.abs(wall.end[:, :2] - 50).max(axis=0).tolist() == near([35, 25]) and (wall.feed == 700).all()
    assert levels(milled("256", 5, edges=2.0)) == near([*np.arange(-2, -21, -2.0)])


def test_plunging_at_rapid():
    down = said(milled("257", 5, Q206="FMAX"), "layer 1 of 4, down")
    assert (down.kind == Kind.RAPID).all() and len(down) == 1


def test_a_polygon_is_left_in_the_second_set_up_plane_after_every_level():
    rows = milled("258", 10)
    up = rows[(rows.kind == Kind.RAPID) & (rows.end[:, 2] > rows.start[:, 2])]
    assert up.end[:, 2].tolist() == [50, 50]
    assert said(rows, "layer 2 of 2, to the clearance level").end[0].tolist() == near([105.1552, 96.2807, 2])


def test_a_negative_allowance_makes_the_polygon_smaller():
    """Q368 = -1: the last round 1 mm closer; no side finishing; the tool ends outside the blank."""
    rows, less = milled("258", 10), milled("258", 10, Q368=-1, Q369=0.5)
    for found, away in ((rows, 33.7764), (less, 32.7764)):
        last = said(found, "layer 2 of 2, last ring")
        assert flats(last) == near(away)
    assert not len(said(less, "side")) and levels(less, "floor") == [-18]
    assert np.hypot(*(less[-1].end[:2] - 50)) == near(72)


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize(("height", "ways"), [(100.0, [(100, 2)]), (10.0, [(10, 50), (50, 2)])])
def test_the_way_to_the_stud(number, height, ways):
    rows = milled(number, 5, height=height)
    rapid = [row for row in rows[:4] if row.kind == Kind.RAPID and row.start[2] != row.end[2]]
    assert [(row.start[2], row.end[2]) for row in rapid] == ways


@pytest.mark.parametrize("number", NUMBERS)
def test_a_positive_depth_works_upwards_where_that_is_allowed(number):
    """displayDepthErr off: rapid to 2 mm below the surface, up in infeeds, out downwards."""
    rows = milled(number, 5, {"depth_error": False}, Q201=12, Q202=5)
    assert levels(rows) == [5, 10, 12]
    assert said(rows, "to the set-up clearance").end[0, 2] == -2
    assert rows[-1].end[2] == 50


# --- every parameter acts ---------------------------------------------------------------------------------------------

FEEDS = {"milling_feed", "plunging_feed", "finishing_feed"}
OTHER = {
    "milling_type": -1, "corner_radius_or_chamfer": -4, "corners": 5, "rotation_angle": 40, "starting_angle": 40,
    "approach_position": 3,
}  # fmt: skip
CASES = [(code, parameter) for code, cycle in CYCLES.items() for parameter in cycle.parameters()]


def examples(code):
    return {parameter.name: parameter.example for parameter in CYCLES[code].parameters()} | {"side_allowance": 0.3}


def tried(code, values):
    found = mnclab.run(trial.program(mnclab.controls["tnc-620"], CYCLES[code], values), "tnc-620")
    assert found.ok, found.alarms
    path = found.toolpath[found.toolpath.is_motion]
    return (path.end.round(9).tolist(), path.sweep.round(9).tolist()), path.feed.tolist()


@pytest.mark.deep
@pytest.mark.parametrize(("code", "parameter"), CASES, ids=lambda case: getattr(case, "name", case))
def test_a_parameter_acts(code, parameter):
    values, name = examples(code), parameter.name
    assert parameter.example is not None
    other = OTHER.get(name)
    if other is None and parameter.choices:
        other = next(choice for choice in parameter.choices if choice != parameter.example)
    if other is None:
        step = 1.1 if name.startswith(("blank", "finished")) else 0.9
        other = values[name] * step if values[name] else 3.5
    shape, feeds = tried(code, values)
    new_shape, new_feeds = tried(code, values | {name: other})
    assert (new_shape == shape) == (name in FEEDS) and (name not in FEEDS or feeds != new_feeds)


@pytest.mark.parametrize("code", CYCLES)
def test_every_row_of_a_cycle_says_what_happens(code):
    found = mnclab.run(trial.program(mnclab.controls["tnc-620"], CYCLES[code], examples(code)), "tnc-620")
    path = found.toolpath
    call = path[(path.line == path.line[path.is_motion].max()) & path.is_motion]
    said_ = names(call)[1:]
    assert said_ and all(name.startswith(code + " ") and len(name) > len(code) + 3 for name in said_)
    for part in ("layer 1 of 4, ", "side finishing 2 of 4", "floor finishing, "):
        assert any(part in name for name in said_)

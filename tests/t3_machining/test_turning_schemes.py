"""Roughing schemes stroke by stroke against the examples of the catalogue, and their promises on any profile."""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mnclab import Alarm, Tool
from mnclab.comparison.turning_schemes import TURNER, compare
from mnclab.geometry.contours import Contour
from mnclab.machining.turning import schemes as schemes
from mnclab.machining.turning.groove_schemes import Groove, plunges, scheme_5, side_steps
from mnclab.machining.turning.passes import without_drop
from mnclab.machining.turning.profiles import reachable, zone_of, zones
from mnclab.machining.turning.strokes import CLEANUP, PICK_UP, PLUNGE, RAPID
from mnclab.machining.turning.threading import added, shifts
from mnclab.path.inserts import angles_of

CATALOGUE = Path(__file__).parent.parent / "authorities" / "catalogue" / "turning-technology.json"
OPEN = Contour([(0, 20), (-50, 20)], closed=False)
SEMI_OPEN = Contour([(0, 20), (-40, 20), (-50, 30)], closed=False)
CLOSED = Contour([(-10, 30), (-20, 20), (-40, 20), (-50, 30)], closed=False)
STEPPED = Contour(
    [(0, 15), (-10, 18), (-20, 18), (-25, 12), (-30, 12), (-32, 18), (-40, 18), (-40, 24), (-60, 24)], closed=False
)
SQUARE = Tool(main_angle=90, auxiliary_angle=60)

#: What draws each example of the catalogue, by its title.
DRAWN = {
    "loop: Open": lambda: schemes.loop(OPEN, 30, 4),
    "loop: Semi-open": lambda: schemes.loop(SEMI_OPEN, 30, 4),
    "zigzag: Test": lambda: schemes.zigzag(SEMI_OPEN, 30, 4),
    "descent: Test": lambda: schemes.descent(CLOSED, 30, 5),
    "pick-up: Test": lambda: schemes.pick_up(SEMI_OPEN, 30, 4),
    "semi-finish pass: After the last": lambda: schemes.semi_finish(SEMI_OPEN, 30, 4),
    "semi-finish pass: After the penultimate": lambda: schemes.semi_finish(SEMI_OPEN, 30, 4, after="penultimate"),
    "equidistant: Test": lambda: schemes.equidistant(SEMI_OPEN, 30, 4),
    "contour scheme: Test": lambda: schemes.contour(SEMI_OPEN, 30, 4, shift=(8, 2), passes=3),
    "closed zone strokes: With pick-up": lambda: schemes.pick_up(CLOSED, 30, 4),
    "closed zone strokes: With clean-up": lambda: schemes.semi_finish(CLOSED, 30, 4),
    "groove scheme 5: b = 10": lambda: scheme_5(Groove(0, 10, 25, 30), 4, finish=True),
}
EXAMPLES = {f"{e['code']}: {e['title']}": e for e in json.loads(CATALOGUE.read_text("utf-8"))}
FEEDS = {"main feed": "rough", "roughing feed": "rough", "pick-up feed": PICK_UP, "semi-finish feed": CLEANUP}


def listed(text):
    """The strokes of an expected listing: (rapid or not, r, z), with the start first; and the words behind a #."""
    found = re.findall(r"(start|rapid|feed) R(\S+) Z(\S+)(?: *# *(.*))?", text)
    return [(kind, float(r), float(z), note) for kind, r, z, note in found]


@pytest.mark.parametrize("name", DRAWN)
def test_examples_of_the_catalogue(name):
    (example,) = [e for title, e in EXAMPLES.items() if title.startswith(name)]
    plan = DRAWN[name]()
    start, *strokes = listed(example["expected"])
    assert len(strokes) > 4
    assert plan.start == pytest.approx((start[2], start[1]))
    assert [s.role == RAPID for s in plan.strokes] == [kind == "rapid" for kind, *_ in strokes]
    assert [(s.r, s.z) for s in plan.strokes] == [pytest.approx((r, z), abs=5e-5) for _, r, z, _ in strokes]
    for stroke, (*_, note) in zip(plan.strokes, strokes, strict=True):
        assert note not in FEEDS or stroke.role == FEEDS[note]
        assert not note.startswith("plunge feed") or stroke.role == PLUNGE


def test_every_example_is_looked_at():
    formulas = [title for title, e in EXAMPLES.items() if "(formula)" in e["program"]]
    assert len(formulas) == 6
    assert all(any(title.startswith(name) for name in DRAWN) for title in EXAMPLES if title not in formulas)


def numbers(text, after):
    """The numbers on the line of an expected text behind some words."""
    (line,) = [line for line in text.splitlines() if line.startswith(after)]
    return [float(each) for each in re.findall(r"-?\d+(?:\.\d+)?", line[len(after) :])]


def test_formulas_of_the_catalogue():
    depths = (0.4, 0.8, 1.2, 1.5, 1.84)
    sixty, fifty_five = (EXAMPLES[f"one-sided flank infeed: {t}"]["expected"] for t in (
        "60 degrees, depths 0.4 0.8 1.2 1.5 1.84", "55 degrees, same depths"))  # fmt: skip
    assert added(shifts(depths, "flank")) == pytest.approx(numbers(sixty, "shift added before each pass:"))
    assert shifts(depths, "flank") == pytest.approx(numbers(sixty, "position s_i:"))
    last = [-s for s in shifts(depths, "flank", nominal_last=True)]
    assert last == pytest.approx(numbers(sixty, "nominal at the last pass:"))
    assert added(shifts(depths, "flank", 55)) == pytest.approx(numbers(fifty_five, "shift added:"))
    assert shifts(depths, "flank", 55) == pytest.approx(numbers(fifty_five, "position s_i:"))
    (alternate,) = [e["expected"] for e in EXAMPLES.values() if e["code"] == "alternate flank infeed"]
    assert shifts(depths, "alternate") == pytest.approx(numbers(alternate, "s_i:"))
    assert plunges(0, 10, 4) == pytest.approx((-4, -7, -10)) and side_steps(10, 4) == 2
    assert plunges(0, 10, 4, finish=True) == pytest.approx((-4.5, -7, -9.5))
    assert side_steps(10, 4, finish=True) == pytest.approx(5 / 3)
    assert plunges(0, 20, 4) == pytest.approx((-4, -6.6667, -9.3333, -12, -14.6667, -17.3333, -20), abs=5e-5)


@pytest.mark.parametrize(
    ("profile", "kind", "passes"),
    [(OPEN, "open", 3), (SEMI_OPEN, "semi-open", 3), (CLOSED, "closed", 3), (STEPPED, "combined", None)],
)
def test_zones(profile, kind, passes):
    assert zone_of(profile) == kind
    if passes:
        assert schemes.loop(profile, 30, 4).passes == schemes.zigzag(profile, 30, 4).passes == passes


def test_a_combined_zone_is_parted():
    """A shaft with a step and a groove: what stays dry grows to 24 and goes on level; the groove is closed."""
    found = zones(STEPPED, 30)
    assert [zone.kind for zone in found] == ["semi-open", "open", "closed"]
    assert found[0].main == pytest.approx(90) and found[1].profile.points.tolist() == [[-40, 24], [-60, 24]]
    assert found[2].auxiliary == pytest.approx(math.degrees(math.atan2(6, 5)))
    ribbed = Contour([(0, 20), (-4, 10), (-6, 15), (-8, 12), (-12, 20)], closed=False)
    assert [float(zone.profile.points[0, 1]) for zone in zones(ribbed)] == pytest.approx([20, 15, 15])


def test_an_edge_leaves_a_line_behind_a_corner():
    """30 degrees behind the rim: 10 deep, 10 / tan 30 = 17.3205 long; a main angle of 40 likewise in front of a wall."""
    found = reachable(CLOSED, Tool(main_angle=40, auxiliary_angle=30)).points
    long, short = 10 / math.tan(math.radians(30)), 10 / math.tan(math.radians(40))
    assert found == pytest.approx(np.array([(-10, 30), (-10 - long, 20), (short - 50, 20), (-50, 30)]))
    ball = Contour([(0, 20), (-20, 20), (-20, 25)], [1, 0, 0], closed=False)  # half a circle of radius 10
    cut = reachable(ball, Tool(auxiliary_angle=45))
    touch = (-10 - 10 * math.sin(math.pi / 4), 20 + 10 * math.cos(math.pi / 4))
    assert np.hypot(*(cut.points - touch).T).min() < 1e-6  # a tangent: the root of rounding


@pytest.mark.parametrize("profile", [OPEN, SEMI_OPEN, CLOSED])
@pytest.mark.parametrize("name", ["pick-up", "semi-finish", "equidistant", "contour"])
def test_the_area_removed_is_that_between_blank_and_contour(profile, name):
    trial = compare(profile, 30, SQUARE, [name], depth=4)[0]
    corners = np.vstack([profile.points, [(profile.points[-1, 0], 30), (profile.points[0, 0], 30)]])
    assert trial.removed == pytest.approx(abs(Contour(corners).area), abs=1e-6)
    assert trial.rest.area == trial.ridge == 0


@pytest.mark.parametrize(("name", "ridges"), [("loop", [4, 4, 2]), ("zigzag", [4, 0, 2])])
def test_loop_and_zigzag_leave_ridges_on_a_shoulder(name, ridges):
    """A triangle of half the square of each level's depth on the flank of 45 degrees, but where the zigzag goes down it."""
    trial = compare(SEMI_OPEN, 30, SQUARE, [name], depth=4)[0]
    assert trial.rest.area == pytest.approx(sum(a * a / 2 for a in ridges), abs=1e-6)
    assert trial.gouged == trial.struck == 0


@pytest.mark.parametrize("profile", [OPEN, SEMI_OPEN, CLOSED])
def test_the_ranking_of_the_source(profile):
    """Loop, semi-finish, pick-up: equal cuts, longer idle strokes, where the clean-up takes the place of the last pass."""
    tool = Tool(main_angle=95, auxiliary_angle=50)
    ways = ["loop", "semi-finish after penultimate", "pick-up", "semi-finish"]
    loop, clean, pick, last = (trial.row for trial in compare(profile, 30, tool, ways, depth=4).trials)
    assert loop["time"] <= clean["time"] <= pick["time"] + 1e-9
    assert clean["length"] == pytest.approx(pick["length"]) and clean["rapid"] <= pick["rapid"] + 0.7
    assert loop["ridge"] > 1 or profile is OPEN  # only there the loop leaves an even allowance
    if profile is SEMI_OPEN:  # cut by hand: three passes of 48, 44 and 42, and a flank of 14.142 in all
        assert pick["length"] == pytest.approx(48 + 44 + 42 + 10 * math.sqrt(2))
        assert last["length"] == pytest.approx(48 + 44 + 42 + 42 + 10 * math.sqrt(2)) and last["time"] > pick["time"]


def test_both_forms_of_the_clean_up_are_compared_by_default():
    """The source has it after the last or the penultimate pass, and its ranking holds for the latter.

    By hand at 0.3 mm/rev, 800 rev/min and 10 m/min: passes of 48, 44 and 42 and a flank of 14.142; ways back at rapid."""
    found = compare(SEMI_OPEN, 30, Tool(main_angle=95, auxiliary_angle=50), depth=4)
    loop, after, pick, last = (found[name].row for name in ("loop", "semi-finish after penultimate", "pick-up", "semi-finish"))
    assert [round(row["time"], 1) for row in (loop, after, pick, last)] == [34.4, 38.0, 38.1, 48.7]
    assert after["length"] == pytest.approx(48 + 44 + 42 + 10 * math.sqrt(2)) == last["length"] - 42
    assert "semi-finish after penultimate" in [trial.name for trial in compare(OPEN, 30, depth=4).trials]
    assert "semi-finish after penultimate" not in [trial.name for trial in compare(CLOSED, 30, depth=4).trials]
    ways = [compare(CLOSED, 30, schemes=[name])[0].path.end.tolist() for name in ("semi-finish", "semi-finish after penultimate")]
    assert ways[0] == ways[1]  # in a closed zone both are one


def test_time_at_the_feeds():
    """0.3 mm/rev at 800 rev/min is 240 mm/min; at 180 m/min and radius 26 the spindle turns 1101.8 times a minute."""
    row = compare(SEMI_OPEN, 30, SQUARE, ["loop"], depth=4, feed=0.3, spindle=800, rapid=6000)["loop"].row
    assert row["time"] == pytest.approx((48 + 44 + 42) / 240 * 60 + row["rapid"] / 6000 * 60)
    path = compare(SEMI_OPEN, 30, SQUARE, ["loop"], depth=4, surface=180, spindle=1200)["loop"].path
    assert path.spindle[1] == pytest.approx(1000 * 180 / (2 * math.pi * 26)) and path.spindle.max() == 1200


@st.composite
def profiles(draw, arcs):
    """Steps, cones and arcs up and down under a blank of 30; some end with a wall, some are closed by one at the face."""
    z, r = 0.0, draw(st.sampled_from([30, 6, 12, 17, 23, 28]))
    points, bulges = [(z, r)], []
    for k in range(draw(st.integers(1, 5))):
        to = draw(st.integers(3, 28))
        dz = draw(st.integers(0 if k and to != r else 2, 8))
        bulge = 0.0
        if arcs and dz and to != r:  # up to the sweep where one end is level or upright
            chord = math.atan2(abs(to - r), dz)
            bulge = math.tan(min(chord, math.pi / 2 - chord) / 2) * draw(st.sampled_from([-1, -0.5, 0, 0.5, 1]))
        elif arcs and dz and r > dz:
            bulge = draw(st.sampled_from([-1, -0.3, 0, 0.3, 1]))
        z, r = z - dz, to
        points.append((z, r))
        bulges.append(bulge)
    if draw(st.booleans()):
        points.append((z - 3, 31))
        bulges.append(0.0)
    return Contour(points, [*bulges, 0.0], closed=False)


#: Angles of tools, 0 where the table gives none; blades lean to no side.
TOOLS = st.one_of(
    st.builds(lambda main, other: Tool(main_angle=main, auxiliary_angle=other),
              st.sampled_from([0, 45, 75, 90, 93, 95]), st.sampled_from([0, 15, 30, 52, 60, 85])),
    st.builds(lambda width: Tool(width=width), st.sampled_from([2, 3, 5, 40])),
)  # fmt: skip
#: Schemes that leave nothing.
WHOLE = ("pick-up", "semi-finish", "semi-finish after penultimate", "equidistant", "contour", "combined")


def kept(profile, tool, depth):
    """The trials of a profile, all of which keep the promises of a scheme; none where the tool cannot come in."""
    if without_drop(reachable(profile, tool)).points[:, 1].min() >= 30:
        with pytest.raises(Alarm, match="leaves nothing to cut"):
            compare(profile, 30, tool, depth=depth)
        return ()
    trials = compare(profile, 30, tool, depth=depth, step=min(tool.width or depth, depth)).trials
    for trial in trials:
        assert trial.gouged <= 1e-6 and trial.struck <= 1e-6, trial.name
        assert trial.name not in WHOLE or trial.rest.area <= 1e-6, trial.name
    return trials


@pytest.mark.deep
@settings(max_examples=40, deadline=None, derandomize=True)
@given(profiles(arcs=False), TOOLS, st.sampled_from([2.7, 4.0, 6.0]))
def test_no_stroke_goes_below_and_no_rapid_through_material(profile, tool, depth):
    """And what is cut, left and out of reach is together what lies between blank and profile: trapezia."""
    material = 0.0
    for (z0, r0), (z1, r1) in zip(profile.points, profile.points[1:], strict=False):
        share = 1.0 if r1 <= 30 else (30 - r0) / (r1 - r0)
        material += (z0 - z1) * share * (30 - r0 + 30 - min(r1, 30)) / 2
    for trial in kept(profile, tool, depth):
        assert trial.removed + trial.rest.area + trial.unreachable.area == pytest.approx(material, abs=1e-6)


@pytest.mark.deep
@settings(max_examples=40, deadline=None, derandomize=True)
@given(profiles(arcs=True), TOOLS, st.sampled_from([2.7, 4.0, 6.0]))
def test_the_same_with_arcs(profile, tool, depth):
    kept(profile, tool, depth)


def test_an_angle_that_is_not_given_restricts_nothing_but_leaves_an_insert():
    """A main angle of 95 leaves 85 for the other one."""
    assert np.degrees(angles_of(Tool(main_angle=95))) == pytest.approx((95, 85))
    assert np.degrees(angles_of(Tool(auxiliary_angle=120))) == pytest.approx((60, 120))
    assert np.degrees(angles_of(Tool(main_angle=45))) == pytest.approx((45, 90))
    kept(SEMI_OPEN, Tool(main_angle=95), 4)


def test_two_walls_of_one_groove_and_a_tool_that_cannot_reach_it():
    """(0, 6) (-2, 3) (-5, 31): behind the corner the edge of 30 degrees leaves a triangle, all else is cut."""
    profile = Contour([(0, 6), (-2, 3), (-5, 31)], closed=False)
    (trial,) = kept(profile, TURNER, 4)
    run, fall, rise = math.tan(math.radians(30)), 6.0, 28 / 3  # the line 6 + run z meets 3 - rise (z + 2)
    z = (3 - 2 * rise - fall) / (run + rise)
    # triangle between the corners (0, 6), (-2, 3) and the meeting point
    meeting = (z, fall + run * z)
    assert trial.unreachable.area == pytest.approx(abs(Contour([(0, 6), (-2, 3), meeting]).area), abs=1e-6)


def test_a_shaft_with_a_step_and_a_groove():
    trial = compare(STEPPED, 30, Tool(main_angle=95, auxiliary_angle=52), depth=4)["combined"]
    assert trial.rest.area < 1e-6 and trial.gouged < 1e-6 and trial.struck < 1e-6


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: schemes.loop(SEMI_OPEN, 30, 0), "depth of a pass"),
        (lambda: schemes.loop(SEMI_OPEN, 20, 4), "nothing to cut"),
        (lambda: schemes.loop(SEMI_OPEN, 30, 1e-6), "passes, allowed are"),
        (lambda: schemes.loop(STEPPED, 30, 4), "part it into zones"),
        (lambda: schemes.descent(CLOSED, 30, 5, Tool(width=4)), "at most the tool width 4"),
        (lambda: schemes.loop(SEMI_OPEN.reversed(), 30, 4), "must never grow"),
        (lambda: schemes.semi_finish(SEMI_OPEN, 30, 4, after="first"), "penultimate"),
        (lambda: compare(SEMI_OPEN, 30, schemes=["spiral"]), "a scheme must be loop"),
        (lambda: compare(SEMI_OPEN, 30, feeds={"cut": 1}), "no role 'cut'"),
        (lambda: compare(SEMI_OPEN, 30, Tool(main_angle=95, auxiliary_angle=90)), "180 degrees at most"),
        (lambda: schemes.loop(SEMI_OPEN, 30, 4, Tool(main_angle=-5)), "main angle of a tool .* got -5"),
        (lambda: schemes.loop(SEMI_OPEN, 30, 4, Tool(auxiliary_angle=180)), "auxiliary angle of a tool .* got 180"),
    ],
)
def test_refused(call, message):
    with pytest.raises((ValueError, Alarm), match=message):
        call()


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"kind": "turning", "main_angle": 93, "auxiliary_angle": 100}, "180 degrees at most, .* got 93 and 100"),
        ({"kind": "turning", "main_angle": 180}, "main angle of a tool must be .* less than 180 .* got 180"),
        ({"kind": "thread", "angle": 200}, "angle of a thread insert must be less than 180 .* got 200"),
    ],
)
def test_an_insert_that_cannot_be_is_refused_where_it_is_made(given, message):
    """The edges of an insert and the flanks of a V stand on two sides of it: together less than a straight line."""
    with pytest.raises(Alarm, match=message):
        Tool(**given)

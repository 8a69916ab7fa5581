"""SL cycles 21 and 22: where the tool goes down and how, holes for it, ways at depth, levels; judged by the part that is cut.

Expected numbers are those of the manual's example C21 and C20 (8.13) as the catalogue works them out, or closed forms.
"""

import json
from pathlib import Path

import numpy as np
import pytest
from shapely import LineString, Point, Polygon, union_all

import mnclab
from mnclab import Kind, Setup, Tool

CATALOGUE = Path(__file__).parents[2] / "authorities" / "catalogue" / "programs-tnc-620.json"
PROGRAMS = [entry["program"] for entry in json.loads(CATALOGUE.read_text(encoding="utf-8"))]
(C21,), (C20,) = ([text for text in PROGRAMS if f"BEGIN PGM {name} " in text] for name in ("C21", "C20"))
PLAIN = Tool(radius=5)
DRILL = Tool(radius=6, angle=118, kind="drill")
MILL = Tool(radius=6, plunge_angle=5, cutting_length=25, kind="mill", centre_cutting=False)


def without(text, *blocks):
    """A program without blocks of these numbers and the lines of their parameters."""
    kept, out = [], False
    for line in text.splitlines():
        if line[:1].isdigit():
            out = int(line.split()[0]) in blocks
        if not out:
            kept.append(line)
    return "\n".join(kept).replace("L +250", "L Z+250") + "\n"  # as printed, repaired


def c21(*, plunge=150, mill=MILL, drill=DRILL, pilot=True):
    """Program C21 as far as the rough-out."""
    text = without(C21, *range(14, 18), *(() if pilot else (8, 9)))
    return mnclab.run(text.replace("Q19=150", f"Q19={plunge}"), "tnc-620", Setup(tools={1: drill, 2: mill}))


def of(run, code):
    path = run.toolpath
    at = [label.startswith(code) for label in path.labels]
    return path[np.array(at)[path.label] & path.is_motion]


def at_depth(path, level, radius):
    """What discs of the tool cover at feed at a level."""
    flat = (abs(path.end[:, 2] - level) < 1e-9) & (abs(path.start[:, 2] - level) < 1e-9) & (path.kind != Kind.RAPID)
    flat = np.flatnonzero(flat)
    return union_all([LineString(path[k : k + 1].points(2e-5)[0][:, :2]).buffer(radius, 256) for k in flat])


# --- the example of the manual ----------------------------------------------------------------------------------------


def test_pilot_drilling_of_the_example():
    holes = of(c21(), "CYCL DEF 21")
    heights = [(round(float(z), 9), feed) for z, feed in zip(holes.end[:, 2], holes.feed, strict=True)]
    fast = np.inf
    assert heights == [
        (250, fast), (2, fast), (-5, 250), (2, fast), (-4.4, fast), (-10, 250), (2, fast), (-9.4, fast), (-15, 250), (2, fast),
        (-14.4, fast), (-19.5, 250), (100, fast), (250, fast), (250, fast),
    ]  # fmt: skip
    assert holes.end[0] == pytest.approx([53.73, 59.78, 250], abs=5e-3)  # the greatest clearance of the contour


def test_rough_out_of_the_example():
    run = c21()
    path = of(run, "CYCL DEF 22")
    flat = path[path.feed == 350]
    assert sorted(set(flat.end[:, 2].round(9))) == [-19.5, -15, -10, -5]
    for level in (-5, -19.5):
        assert at_depth(path, level, 6).area == pytest.approx(2814.48, abs=0.02)
    low, high = flat.bounds[:, :2]
    assert [low[0], high[0], low[1], high[1]] == pytest.approx([16.5, 83.5, 31.5, 68.5])
    outer = path[(path.kind == Kind.ARC) & (abs(np.hypot(*(path.end - path.centre)[:, :2].T) - 18.5) < 1e-6)]
    assert (outer.sweep < 0).all()  # Q9 = -1: up-cut, round the pocket clockwise
    assert not run.collisions()


def test_the_mill_goes_down_where_the_drill_was():
    """At one place on all levels; a mill that does not cut at its centre may do that after the drill alone."""
    run = c21(plunge=0)
    path = of(run, "CYCL DEF 22")
    down = path[(path.end[:, 2] < path.start[:, 2]) & (path.feed == 100)]
    assert len(down) == 4 and np.ptp(down.end[:, :2], axis=0).max() == 0
    drilled = of(run, "CYCL DEF 21")
    assert down.end[0, :2] == pytest.approx(drilled.end[1, :2], abs=1e-9)
    assert not run.collisions()
    solid = c21(plunge=0, pilot=False).collisions()
    assert {each.kind for each in solid} == {"plunge"} and len(solid) == 4


def test_a_delta_of_tool_call_moves_no_hole():
    text = without(C21, *range(14, 18)).replace("TOOL CALL 2 Z S3000", "TOOL CALL 2 Z S3000 DR+0.3").replace("Q19=150", "Q19=0")
    for given in (text, text.replace("TOOL CALL 1 Z S2500", "TOOL CALL 1 Z S2500 DR-1").replace("Q13=2", "Q13=0")):
        run = mnclab.run(given, "tnc-620", Setup(tools={1: DRILL, 2: MILL}))
        hole, mill = of(run, "CYCL DEF 21").end[1, :2], of(run, "CYCL DEF 22").end[1, :2]
        assert hole == pytest.approx([53.73, 59.78], abs=5e-3) and mill == pytest.approx(hole, abs=1e-2)


@pytest.mark.parametrize("name", ['QS13="rough"', "Q13=+2"])
def test_the_rough_out_tool_by_number_or_name(name):
    text = without(C21, *range(10, 18)).replace("Q13=2", name)
    run = mnclab.run(text, "tnc-620", Setup(tools={1: DRILL, 2: Tool(radius=5.5, name="Rough")}))
    assert run.ok and not run.alarms
    assert len(of(run, "CYCL DEF 21")) == 15


def test_coarse_roughing_of_the_example():
    """The neck of the two circles is too narrow: two ways down on each of four levels; Q8 = 0, as the area is told."""
    text = without(C20, 10, 11, 12, 13).replace("Q8=0.1", "Q8=0")
    run = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=15, plunge_angle=90)}))
    path = of(run, "CYCL DEF 22")
    down = path[(path.end[:, 2] < path.start[:, 2]) & (path.feed == 150)]
    assert sorted(set(down.end[:, 2].round(9))) == [-20, -15, -10, -5] and len(down) == 8
    assert not run.collisions()
    whole = Point(30, 30).buffer(30, 4096).union(Point(57.5, 77.631397).buffer(20, 4096))
    along = np.array([np.cos(np.pi / 3), np.sin(np.pi / 3)])
    across = 10 * np.array([-along[1], along[0]])
    ends = [np.array([30, 30]) + t * along for t in (20, 45)]
    neck = Polygon([ends[0] - across, ends[1] - across, ends[1] + across, ends[0] + across])
    whole = whole.union(neck)
    assert whole.area == pytest.approx(4212.730, abs=0.01)
    assert whole.difference(at_depth(path, -5, 15)).area == pytest.approx(83.134, abs=0.02)


# --- the way down -------------------------------------------------------------------------------------------------------


def polygon_program(corners, islands=(), blank=None, **given):
    """Cycles 14, 20 and 22 over a pocket with corners in order, counter-clockwise; islands too."""
    values = dict(Q1=-10, Q2=1, Q3=0, Q4=0, Q5=0, Q6=2, Q7=50, Q8=0, Q9=1, Q10=5, Q11=100, Q12=400, Q18=0, Q19=0) | given
    shapes = [(corners, "RL"), *((island, "RR") for island in islands)]
    low, high = np.min([c for s, _ in shapes for c in s], axis=0) - 10, np.max([c for s, _ in shapes for c in s], axis=0) + 10
    labels = ""
    for number, (points, side) in enumerate(shapes, 1):
        (x, y), *others = [*points, points[0]]
        labels += f"LBL {number}\nL X{x:+.9g} Y{y:+.9g} {side}\n"
        labels += "".join(f"L X{u:+.9g} Y{v:+.9g}\n" for u, v in others) + "LBL 0\n"
    names = "/".join(str(number) for number in range(1, len(shapes) + 1))
    rows = {k: f"{k}={v:+.9g}" if not isinstance(v, str) else f"{k}={v}" for k, v in values.items()}
    data = "\n".join(rows[f"Q{k}"] for k in range(1, 10))
    rough = "\n".join(row for key, row in rows.items() if key.strip("QS") not in map(str, range(1, 10)))
    return (
        f"BEGIN PGM A MM\nBLK FORM 0.1 Z X{low[0]:+g} Y{low[1]:+g} Z-40\nBLK FORM 0.2 X{high[0]:+g} Y{high[1]:+g} Z+0\n"
        f"TOOL CALL 1 Z S2000 F300\nL Z+100 R0 FMAX M3\nCYCL DEF 14.0 C\nCYCL DEF 14.1 LABEL {names}\n"
        f"CYCL DEF 20 D\n{data}\nCYCL DEF 22 R\n{rough}\nCYCL CALL\nL Z+100 R0 FMAX M2\n{labels}END PGM A MM\n"
    )


def rough(corners, tool=PLAIN, islands=(), **given):
    run = mnclab.run(polygon_program(corners, islands, **given), "tnc-620", Setup(tools={1: tool}))
    return run, of(run, "CYCL DEF 22")


BOX = [(0, 0), (60, 0), (60, 60), (0, 60)]
FLUTE = [(0, 0), (80, 0), (80, 10.2), (0, 10.2)]  # 0.1 of room on both sides of a tool of radius 5


@pytest.mark.parametrize(("angle", "plunge", "feed"), [(0, 0, 100), (4, 0, 100), (90, 70, 70)])
def test_straight_down_without_q19_and_at_an_angle_of_90(angle, plunge, feed):
    run, path = rough(BOX, Tool(radius=5, plunge_angle=angle), Q19=plunge)
    down = path[(path.end[:, 2] < path.start[:, 2]) & (path.kind != Kind.RAPID)]
    assert run.ok and down.end.tolist() == [[30, 30, -5], [30, 30, -10]] and set(down.feed) == {feed}


@pytest.mark.parametrize("sense", [1, -1])
def test_a_helix_as_wide_as_the_tool(sense):
    """At the plunge angle or flatter, from what is cut down to the level, in the sense of the milling."""
    run, path = rough(BOX, Tool(radius=5, plunge_angle=4, centre_cutting=False), Q19=80, Q9=sense)
    turns = path[(path.kind == Kind.ARC) & (path.start[:, 2] != path.end[:, 2])]
    assert len(turns) == 2 and turns.start[:, 2].tolist() == [0, -5] and set(turns.feed) == {80}
    assert np.hypot(*(turns.end - turns.centre)[:, :2].T) == pytest.approx([5, 5])
    slope = 5 / (5 * np.abs(turns.sweep))
    assert slope == pytest.approx(np.tan(np.radians(4))) and (np.sign(turns.sweep) == sense).all()
    assert not run.collisions()


def test_a_narrow_helix_and_none():
    """As wide as the room; where not even a tenth of the radius fits, to and fro, at most LCUTS / tan(ANGLE) in one stroke."""
    wide = [(0, 0), (80, 0), (80, 12), (0, 12)]
    tool = Tool(radius=5, plunge_angle=5, cutting_length=2, centre_cutting=False)
    run, path = rough(wide, tool, Q19=80, Q10=2)
    turns = path[(path.kind == Kind.ARC) & (path.start[:, 2] != path.end[:, 2])]
    assert np.hypot(*(turns.end - turns.centre)[:, :2].T) == pytest.approx([1] * 5) and not run.collisions()
    run, path = rough(FLUTE, tool, Q19=80, Q10=2)
    slopes = path[(path.start[:, 2] > path.end[:, 2]) & (np.hypot(*(path.end - path.start)[:, :2].T) > 0)]
    lengths, drops = np.hypot(*(slopes.end - slopes.start)[:, :2].T), (slopes.start - slopes.end)[:, 2]
    assert drops.sum() == pytest.approx(10) and (drops <= lengths * np.tan(np.radians(5)) + 1e-9).all()
    assert lengths.max() == pytest.approx(2 / np.tan(np.radians(5))) and set(slopes.feed) == {80}
    assert not run.collisions()


def test_a_slot_needs_the_length_of_the_edges():
    run, _ = rough(FLUTE, Tool(radius=5, plunge_angle=5), Q19=80)
    (alarm,) = run.alarms
    assert alarm.message == (
        "CYCL DEF 22: where a helix has no room the tool goes to and fro, for which it needs the length of its edges"
    )
    assert "LCUTS" in alarm.hint


# --- at depth ---------------------------------------------------------------------------------------------------------

#: Three chambers side by side, joined by necks 13 wide: rings of a tool of radius 5 go round each chamber first.
CHAMBERS = [
    (0, 0), (40, 0), (40, 14), (50, 14), (50, 0), (90, 0), (90, 14), (100, 14), (100, 0), (140, 0),
    (140, 40), (100, 40), (100, 27), (90, 27), (90, 40), (50, 40), (50, 27), (40, 27), (40, 40), (0, 40),
]  # fmt: skip


@pytest.mark.parametrize("islands", [(), ([(64, 14), (76, 14), (76, 26), (64, 26)],)])
@pytest.mark.parametrize("angle", [90, 6])
def test_one_way_down_for_what_is_connected(islands, angle):
    """The tool stays at depth from chamber to chamber and goes round islands, not over them (8.1)."""
    run, path = rough(CHAMBERS, Tool(radius=5, plunge_angle=angle, centre_cutting=None), islands, Q19=90)
    assert run.ok and not run.collisions()
    lifts = path[(path.end[:, 2] > path.start[:, 2]) & (path.start[:, 2] < 0)]
    assert len(lifts) == 2  # one level each
    contour = Polygon(CHAMBERS).difference(union_all([Polygon(island) for island in islands]))
    for level in (-5, -10):
        cut = at_depth(path, level, 5)
        assert cut.difference(contour.buffer(1e-3)).area < 1e-6
        assert contour.buffer(-5, 128).buffer(5, 128).difference(cut.buffer(1e-3)).area < 1e-3


def test_rapid_goes_down_only_to_where_the_tool_was():
    """To Q6 above the surface, then to Q6 above the level before."""
    _, path = rough(BOX, Q10=3, Q6=1.5)
    rapids = path[(path.kind == Kind.RAPID) & (path.end[:, 2] < path.start[:, 2])]
    assert rapids.end[:, 2].tolist() == [50, 1.5, -1.5, -4.5, -7.5]


@pytest.mark.parametrize(("given", "feed"), [(700, 700), (0, 400), ("FMAX", np.inf), (99999, 99999)])
def test_the_feed_out(given, feed):
    _, path = rough(BOX, Q208=given)
    (out,) = path[(path.start[:, 2] == -10) & (path.end[:, 2] == 50)]
    assert out.feed == feed


@pytest.mark.parametrize(("setting", "last"), [("before", [0, 0, 100]), ("height", None)])
def test_where_it_ends(setting, last):
    setup = Setup(tools={1: PLAIN}, settings={"position_after_contour": setting})
    run = mnclab.run(polygon_program(BOX), "tnc-620", setup)
    end = of(run, "CYCL DEF 22").end
    assert end[-1].tolist() == (last or [*end[-2, :2], 50])


def test_a_depth_of_0_is_executed_at_the_surface():
    run, path = rough(BOX, Q1=0)
    assert run.ok and path.end[:, 2].min() == 0
    assert at_depth(path, 0, 5).area == pytest.approx(3600 - (4 - np.pi) * 25, abs=0.05)


def test_the_depth_levels_of_the_catalogue():
    for given, levels in (
        (dict(Q1=-20, Q5=30, Q4=0.1, Q10=5, Q7=80), [10.1, 15, 20, 25]),
        (dict(Q1=-20, Q5=0, Q4=0.5, Q10=-6), [-19.5, -18, -12, -6]),
    ):
        _, path = rough(BOX, **given)
        assert sorted(set(path[path.feed == 400].end[:, 2].round(9))) == levels


def test_q401_slows_down_in_full_slots():
    """The first ring and the ways through necks; a ring beside what is cut keeps the feed."""
    _, path = rough(CHAMBERS, Q401=40, Q1=-5)
    level = path[(path.start[:, 2] == -5) & (path.end[:, 2] == -5)]
    assert set(level.feed) == {160, 400}
    slow, done = level[level.feed == 160], Point(*level.start[0, :2]).buffer(5, 128)
    for row in range(len(level)):
        way = LineString(level[row : row + 1].points(1e-3)[0][:, :2])
        if way.length > 2 and level.feed[row] == 160:  # ahead of its middle nothing is cut
            spot, ahead = way.interpolate(0.5, normalized=True), way.interpolate(way.length / 2 + 1e-3)
            side = np.array([ahead.x - spot.x, ahead.y - spot.y]) * 1e3
            for turn in (-1.4, 0, 1.4):
                c, s = np.cos(turn), np.sin(turn)
                place = Point(spot.x + 4.99 * (c * side[0] - s * side[1]), spot.y + 4.99 * (s * side[0] + c * side[1]))
                assert not done.contains(place)
        done = done.union(way.buffer(5, 128))
    assert 60 < slow.length < 0.6 * level.length
    _, plain = rough(CHAMBERS, Q401=100, Q1=-5)
    assert plain[plain.feed == 400].length == pytest.approx(level.length, rel=1e-9)


# --- fine roughing ------------------------------------------------------------------------------------------------------


def test_fine_roughing_of_the_example():
    """It clears the neck, 83.134 mm² that the coarse tool left, and nothing else; then all 84254.6 mm³ are gone."""
    tools = {1: Tool(radius=15, plunge_angle=5, cutting_length=25), 2: Tool(radius=7.5, plunge_angle=5, cutting_length=25)}
    run = mnclab.run(C20.replace("Q8=0.1", "Q8=0"), "tnc-620", Setup(tools=tools))
    assert run.ok and not run.alarms and not run.collisions()
    path = of(run, "CYCL DEF 22")
    coarse, fine = path[path.radius == 15], path[path.radius == 7.5]
    before, after = at_depth(coarse, -20, 15), at_depth(fine, -20, 7.5)
    assert after.difference(before).area == pytest.approx(83.134, abs=0.03)
    assert 20 * before.union(after).area == pytest.approx(84254.6, abs=1)
    assert fine[fine.feed == 350].length < 4 * 100
    assert run.workpiece(step=0.25).removed == pytest.approx(84254.6, rel=1e-3)


#: A large chamber, and a small one behind a neck of 16 that a tool of radius 10 cannot pass; corners left of both kinds.
BEHIND = [(0, 0), (60, 0), (60, 12), (70, 12), (70, 8), (86, 8), (86, 36), (70, 36), (70, 28), (60, 28), (60, 40), (0, 40)]
APART = [(0, 0), (60, 0), (60, 40), (0, 40)], [(80, 0), (96, 0), (96, 40), (80, 40)]  # the second is too narrow for it


def fine(corners, tool, coarse=10.0, **given):
    text = polygon_program(corners, **{"Q18": 2, "Q19": 90} | given)
    run = mnclab.run(text, "tnc-620", Setup(tools={1: tool, 2: Tool(radius=coarse, name="COARSE", dr=0.5)}))
    return run, of(run, "CYCL DEF 22")


SMALL = Tool(radius=4, plunge_angle=5, cutting_length=10)


def test_fine_roughing_cuts_what_the_coarse_tool_left():
    """Its wear, dr, does not count: what it reached is that of the radius 10."""
    run, path = fine(BEHIND, SMALL, Q404=0)
    assert run.ok and not run.alarms
    contour = Polygon(BEHIND)
    reached = contour.buffer(-10, 256).buffer(10, 256)
    rest = contour.buffer(-4, 256).buffer(4, 256).difference(reached)
    cut = at_depth(path, -10, 4)
    assert rest.difference(cut.buffer(1e-3)).area < 1e-3 and cut.difference(contour.buffer(1e-3)).area < 1e-6
    assert cut.area < 0.75 * contour.area


@pytest.mark.parametrize(("coarse", "strategy", "lifts"), [(8, 0, 1), (8, 1, 4), (8.5, 0, 4)])
def test_between_the_areas_of_fine_roughing(coarse, strategy, lifts):
    """Along the contour at depth if R is at least half that of the coarse tool, else by way of the set-up clearance."""
    run, path = fine(BOX, SMALL, coarse, Q404=strategy)
    assert run.ok, run.alarms
    up = path[(path.end[:, 2] > path.start[:, 2]) & (path.start[:, 2] < 0)]
    assert len(up) == 2 * lifts  # two levels, four corners
    assert set(up.end[:, 2]) == ({2, 50} if lifts > 1 or len(up) > 1 else {50})


def two(first, second, tool, **given):
    """Two pockets as one contour."""
    text = polygon_program(first, (second,), **{"Q18": 2, "Q19": 90} | given)
    labels = text[text.index("LBL 2") :].replace(" RR", " RL")
    run = mnclab.run(text[: text.index("LBL 2")] + labels, "tnc-620", Setup(tools={1: tool, 2: Tool(radius=10)}))
    return run, of(run, "CYCL DEF 22")


def test_fine_roughing_from_above_goes_to_and_fro():
    """Into the second pocket, where the coarse tool has not been; no helix (8.6)."""
    run, path = two(*APART, Tool(radius=4, plunge_angle=5, cutting_length=3), Q10=3)
    assert run.ok and not run.alarms
    inside = path[path.end[:, 0] > 80]
    slopes = inside[(inside.start[:, 2] > inside.end[:, 2]) & (np.hypot(*(inside.end - inside.start)[:, :2].T) > 0)]
    lengths, drops = np.hypot(*(slopes.end - slopes.start)[:, :2].T), (slopes.start - slopes.end)[:, 2]
    assert drops.sum() == pytest.approx(10) and (slopes.kind == Kind.LINE).all()
    assert (drops <= lengths * np.tan(np.radians(5)) + 1e-9).all() and lengths.max() <= 3 / np.tan(np.radians(5)) + 1e-9
    assert Polygon(APART[1]).buffer(-4, 128).buffer(4, 128).difference(at_depth(inside, -10, 4).buffer(1e-3)).area < 1e-3


def test_fine_roughing_from_above_needs_the_tool_table():
    run, _ = two(*APART, Tool(radius=4, plunge_angle=5))
    assert [alarm.message.startswith("CYCL DEF 22: where a helix has no room") for alarm in run.alarms] == [True]
    run, _ = two(*APART, Tool(radius=4, cutting_length=20))
    assert "Q19 (feed rate for reciprocation) needs the plunge angle (ANGLE)" in run.alarms[0].message
    run, path = two(*APART, Tool(radius=4), Q19=0)
    down = path[(path.end[:, 0] > 80) & (path.end[:, 2] < path.start[:, 2]) & (path.kind == Kind.LINE)]
    assert run.ok and set(down.feed) == {100} and (down.start[:, :2] == down.end[:, :2]).all()  # Q19 = 0: always straight


@pytest.mark.parametrize("coarse", [4, 3])
def test_a_coarse_tool_that_left_nothing(coarse):
    run, path = fine(BOX, SMALL, coarse)
    (warning,) = run.alarms
    assert run.ok and not len(path)
    assert warning.message == (
        "CYCL DEF 22 has nothing to cut: the coarse tool of Q18 has reached all that this one reaches"
    )


def test_the_coarse_tool_by_name():
    text = polygon_program(BEHIND, Q18=2, Q19=90).replace("Q18=+2", 'QS18="coarse"')
    run = mnclab.run(text, "tnc-620", Setup(tools={1: SMALL, 2: Tool(radius=10, name="Coarse")}))
    by_name, by_number = of(run, "CYCL DEF 22"), fine(BEHIND, SMALL)[1]
    assert run.ok and len(by_number) == len(by_name) and np.array_equal(by_number.end, by_name.end)


# --- frames -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("frame", "matrix"),
    [
        ("CYCL DEF 7.0 D\nCYCL DEF 7.1 X+200\n", [[1, 0, 200], [0, 1, 0]]),
        ("CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+90\n", [[0, -1, 0], [1, 0, 0]]),
        ("CYCL DEF 8.0 M\nCYCL DEF 8.1 X\n", [[-1, 0, 0], [0, 1, 0]]),
        ("CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL 0.5\n", [[0.5, 0, 0], [0, 0.5, 0]]),
    ],
)
def test_in_any_frame_the_area_is_cleared(frame, matrix):
    """A mirror keeps the climb, a scale the tool."""
    text = polygon_program(CHAMBERS, Q19=90).replace("CYCL CALL\n", f"{frame}CYCL CALL\n")
    run = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=3, plunge_angle=6, cutting_length=20)}))
    assert run.ok, run.alarms
    corners = np.column_stack([CHAMBERS, np.ones(len(CHAMBERS))]) @ np.array(matrix).T
    path, contour = of(run, "CYCL DEF 22"), Polygon(corners)
    deepest = path.end[:, 2].min()
    cut = at_depth(path, deepest, 3)
    assert deepest == (-5 if "SCL" in frame else -10)
    assert cut.difference(contour.buffer(1e-3)).area < 1e-6
    assert contour.buffer(-3, 128).buffer(3, 128).difference(cut.buffer(1e-3)).area < 1e-3
    low = corners.min(axis=0)[0] + 3  # along the left wall it goes down: climb milling, the spindle turning clockwise
    left = path[(abs(path.start[:, 0] - low) < 1e-6) & (abs(path.end[:, 0] - low) < 1e-6) & (path.end[:, 2] == deepest)]
    assert len(left) and (left.end[:, 1] < left.start[:, 1]).all()


# --- holes ----------------------------------------------------------------------------------------------------------


def pilot(corners, drill=DRILL, **given):
    text = polygon_program(corners, **given)
    first, last = text.index("CYCL DEF 22"), text.index("CYCL CALL")
    cycle = f"CYCL DEF 21 P\nQ10={given.get('Q10', 5):+g}\nQ11=+90\nQ13=+2\n"
    run = mnclab.run(text[:first] + cycle + text[last:], "tnc-620", Setup(tools={1: drill, 2: Tool(radius=5)}))
    return run, of(run, "CYCL DEF 21")


@pytest.mark.parametrize(
    ("depth", "stop"), [(20, 0.6), (30, 0.6), (30.001, 0.60002), (50, 1.0), (350, 7.0), (400, 7.0)]
)
def test_the_advanced_stop(depth, stop):
    _, path = pilot(BOX, Q1=-depth, Q10=depth / 2)
    back = path[(path.kind == Kind.RAPID) & (path.end[:, 2] < 0)]
    assert back.end[:, 2] == pytest.approx([-depth / 2 + stop])


def test_one_hole_in_each_part():
    """Two boxes with a neck of 8: too narrow for the tool."""
    boxes = [(0, 0), (40, 0), (40, 16), (60, 16), (60, 0), (100, 0), (100, 40), (60, 40), (60, 24), (40, 24), (40, 40), (0, 40)]
    run, path = pilot(boxes, Q4=0.5, Q10=20)
    assert run.ok
    down = path[path.feed == 90]
    assert sorted(down.end[:, 0] > 50) == [False, True] and set(down.end[:, 2]) == {-9.5}
    assert [Polygon(boxes).exterior.distance(Point(*place)) for place in down.end[:, :2]] == pytest.approx([20, 20], abs=1e-3)
    assert path.end[-1].tolist() == [0, 0, 100]


def test_a_drill_that_has_no_room_is_refused():
    run, _ = pilot(FLUTE)
    (alarm,) = run.alarms
    assert alarm.message == (
        "CYCL DEF 21: the drill has at (40.000, 5.100) only 5.100 of room: with the allowance for side it needs 6"
    )

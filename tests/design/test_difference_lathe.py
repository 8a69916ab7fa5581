"""A turned part against its design: faults whose numbers are plain arithmetic, found within 1e-6 mm, with their rows."""

import math

import numpy as np
import pytest
from design.turned_designs import shaft
from t3_workpiece.lathe import BAR, NOSED, SHARP, cutting, turned
from tools.together import deep_but_one_in

from mnclab.design.model import Bore, Design, Face, RingGroove, Thread, TurnedDesign
from mnclab.path.tool import Tool
from mnclab.text.alarm import Alarm
from mnclab.workpiece.blank import cylinder
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.turning.turned import Turned

WITHIN = 1e-6
QUARTER = -math.pi / 2
DESIGN = TurnedDesign([(0, 20), (-30, 20), (-30, 25), (-50, 25)], roundings={1: 2.0}, chamfers={0: 1}, title="bolt")


def way(dr=0.0, dz=0.0, hollow=2.0):
    """Along the bolt with a sharp tool: rows 0 chamfer (from the air on), 1 cylinder, 2 hollow, 3 shoulder, 4 cylinder."""
    start = [(1 + dz, 18 + dr), (-1 + dz, 20 + dr), (-30 + hollow + dz, 20 + dr)]
    return [*start, (-30 + dz, 20 + hollow + dr, QUARTER), (-30 + dz, 25 + dr), (-50, 25 + dr), (-50, 31)]


def cut(*args, tool=SHARP, **more):
    return turned(tool, *way(*args, **more))


def row_of(difference, measure, feature="profile"):
    (found,) = [row for row in difference.features.of(feature) if row.measure == measure]
    return found


def test_a_perfect_program_has_no_deviation():
    found = cut().compare(DESIGN)
    assert found.ok and found.worst_gouge.value == found.worst_rest.value == 0
    assert found.gouge_volume == found.rest_volume == 0 and not np.nan_to_num(found.map).any()
    assert all(row.deviation == 0 for row in found.features if row.verdict == "ok")
    assert row_of(found, "length").verdict == "in the chuck" and "in the chuck" in " ".join(found.notes)


@pytest.mark.parametrize("off", [0.1, -0.1, 0.003])
def test_an_offset_in_x(off):
    found = cut(off).compare(DESIGN)
    worst, none = (found.worst_rest, found.worst_gouge) if off > 0 else (found.worst_gouge, found.worst_rest)
    assert worst.value == pytest.approx(abs(off), abs=WITHIN) and none.value == 0 and worst.feature == "profile"
    assert found.ok == (abs(off) < 0.05)
    for measure, nominal, line in (("diameter 1", 40, 1), ("diameter 2", 50, 4)):
        row = row_of(found, measure)
        assert row.actual == pytest.approx(nominal + 2 * off, abs=WITHIN) and row.line == line
    # rings beside both cylinders, the chamfer and the hollow moved outwards: the profile shifted by `off` in r
    bolt = [(0, 19), (-1, 20), (-28, 20), (-30, 22), (-30, 25), (-50, 25)]
    share = sum(math.pi * ((r + off + (s + off)) * off - off * off) * (a - b) for (a, r), (b, s) in zip(bolt, bolt[1:]) if a != b)
    bow = 2 * math.pi * off * 2 * 2 * (1 - math.pi / 4)  # the hollow lies that much farther out than its chord's triangle
    chord = 2 * math.pi * off * 2 * 2 / 2
    volume = found.rest_volume if off > 0 else found.gouge_volume
    assert volume == pytest.approx(abs(share + bow - chord), rel=1e-6)


@pytest.mark.parametrize("off", [0.1, -0.1])
def test_an_offset_in_z(off):
    """The shoulder is off by all of it, the chamfer by the cosine of 45°."""
    found = cut(0.0, off).compare(DESIGN)
    worst = found.worst_rest if off > 0 else found.worst_gouge
    assert worst.value == pytest.approx(0.1, abs=WITHIN) and worst.line == 3
    assert row_of(found, "length 1").actual == pytest.approx(30 - off, abs=WITHIN)
    assert row_of(found, "chamfer 1").actual == pytest.approx(1 - off, abs=WITHIN)


def test_a_nose_that_is_too_large_leaves_a_fillet():
    """A square corner at a shoulder cut with a nose of 0.8: r·(1 - 1/√2) is left before either face."""
    square = TurnedDesign([(0, 20), (-30, 20), (-30, 25), (-50, 25)])
    found = turned(NOSED, (2, 20), (-30, 20), (-30, 25), (-53, 25), (-53, 31)).compare(square)
    worst = found.worst_rest
    middle = 0.8 * (1 - 1 / math.sqrt(2))
    assert worst.value == pytest.approx(middle, abs=WITHIN)
    assert (worst.place[2], worst.place[0]) == pytest.approx((-30 + middle, 20 + middle), abs=1e-5)
    assert found.worst_gouge.value == 0 and worst.line in (0, 1)
    assert row_of(found, "diameter 1").deviation == 0 and row_of(found, "length 1").deviation == 0


def test_a_radius_that_is_too_small_or_large():
    """A hollow of 3 instead of 2: (√2 - 1)·1 more is left in the corner; of 1.5: (√2 - 1)·0.5 is gone."""
    more, less = cut(hollow=3.0).compare(DESIGN), cut(hollow=1.5).compare(DESIGN)
    assert more.worst_rest.value == pytest.approx(math.sqrt(2) - 1, abs=WITHIN) and more.worst_rest.line == 2
    assert less.worst_gouge.value == pytest.approx((math.sqrt(2) - 1) * 0.5, abs=WITHIN) and less.worst_gouge.line == 2
    assert row_of(more, "radius 1").actual == pytest.approx(3, abs=1e-5)
    assert more.rest_volume == pytest.approx(2 * math.pi * sum(_spandrel(r, k) for r, k in ((3, 1), (2, -1))), rel=1e-9)


def _spandrel(size, sign):
    """Area times radius of what a hollow fills of a corner at radius 20."""
    off = size * (10 - 3 * math.pi) / (3 * (4 - math.pi))
    return sign * size**2 * (1 - math.pi / 4) * (20 + off)


def test_a_missing_pass_is_rest_that_nothing_cut():
    found = turned(SHARP, *way()[:4]).compare(DESIGN)
    worst = found.worst_rest
    assert worst.value == pytest.approx(5, abs=WITHIN) and (worst.line, worst.row) == (0, -1)
    assert worst.where == "nothing cut here"
    assert row_of(found, "diameter 2").where == "nothing cut here"


def test_a_corner_that_was_not_cut_has_no_number():
    """Along a cylinder both faces of a shoulder between a cone and a cylinder are found on one line."""
    design = TurnedDesign([(0, 10), (-20, 10), (-30, 15), (-40, 15), (-40, 20), (-60, 20)])
    found = turned(SHARP, (5, 40), (4, 40), stock=cylinder(20, -60, 0)).compare(design)
    for name in ("length 1", "length 2"):
        assert row_of(found, name).verdict == "not cut" and math.isnan(row_of(found, name).actual)


def test_features_that_were_forgotten():
    """A groove 2 deep and 4 wide, a bore of 16: at the axis 8 is left, over the groove the way to its edge or bottom, 2."""
    design = TurnedDesign(DESIGN.profile, [RingGroove(-12, 4, depth=2), Bore(16, 20)], roundings={1: 2.0}, chamfers={0: 1})
    found = cut().compare(design)
    assert found.worst_rest.value == pytest.approx(8, abs=WITHIN) and found.worst_rest.feature == "bore"
    assert row_of(found, "form", "ring groove").actual == pytest.approx(2, abs=1e-5)
    assert {row.verdict for row in found.features.of("bore")} == {"not cut", "out"} and not found.ok
    tip = 8 / math.tan(math.radians(59))
    hole = math.pi * 64 * (20 + tip / 3)
    assert found.rest_volume == pytest.approx(hole + math.pi * (400 - 324) * 4, rel=1e-9)


def test_a_taper():
    """5° instead of 4°: k = (tan 5° - tan 4°)·cos 4° more for each mm; most where the shoulder is as near, s = (20 - s)·k."""
    flat = TurnedDesign([(0, 15), (-20, 15 + 20 * math.tan(math.radians(4))), (-20, 25), (-50, 25)])
    end = 15 + 20 * math.tan(math.radians(5))
    found = turned(SHARP, (0, 15), (-20, end), (-20, 25), (-50, 25), (-50, 31)).compare(flat)
    k = (math.tan(math.radians(5)) - math.tan(math.radians(4))) * math.cos(math.radians(4))
    assert found.worst_rest.value == pytest.approx(20 * k / (1 + k), abs=WITHIN) and found.worst_rest.line == 0
    assert row_of(found, "angle 1").actual == pytest.approx(5, abs=1e-6)


def test_a_bore_and_its_point():
    """Drilled with 12.04 for 12, and 0.05 too deep."""
    design = TurnedDesign([(0, 30), (-60, 30)], [Bore(12, 20, name="A", tolerances={"diameter": "H7", "depth": 0.1})])
    drill = Tool(number=1, kind="drill", radius=6.02, angle=118)
    tip = 6.02 / math.tan(math.radians(59))
    found = turned(drill, (2, 0), (-20.05 - tip, 0)).compare(design)
    diameter, depth = row_of(found, "diameter", "A"), row_of(found, "depth", "A")
    assert diameter.actual == pytest.approx(12.04, abs=WITHIN) and (diameter.verdict, diameter.upper) == ("out", 0.018)
    assert depth.actual == pytest.approx(20.05, abs=WITHIN) and depth.verdict == "ok"
    apart = 0.05 + tip - 6 / math.tan(math.radians(59))  # from tip to tip
    assert found.worst_gouge.value == pytest.approx(apart, abs=WITHIN) and found.worst_gouge.feature == "A"


def test_the_front_end():
    """Not faced: 0.3 is left before it; faced too far: the same is gone."""
    bar = TurnedDesign([(0, 30), (-60, 30)])
    for extra in (0.3, -0.3):
        blank = cylinder(30, -60, extra)
        found = Turned(Cutting.of_nothing(blank, lathe=True)).compare(bar)
        worst = found.worst_rest if extra > 0 else found.worst_gouge
        assert worst.value == pytest.approx(0.3, abs=WITHIN)
        assert row_of(found, "length").actual == pytest.approx(60 + extra, abs=WITHIN)
        volume = found.rest_volume if extra > 0 else found.gouge_volume
        assert volume == pytest.approx(math.pi * 900 * 0.3, rel=1e-9)


def test_a_part_that_was_cut_off_is_what_fell():
    """A blade of 3 whose left corner ends at Z -20.2: the piece that fell is 17.2 long... its design has 17."""
    blade = Tool(number=1, kind="grooving", width=3.0)
    part = turned(blade, (-20.2, 32), (-20.2, -0.5))
    found = part.compare(TurnedDesign([(0, 30), (-17, 30)]))
    assert found.worst_rest.value == pytest.approx(0.2, abs=WITHIN) and found.worst_rest.line == 0
    assert row_of(found, "length").actual == pytest.approx(17.2, abs=WITHIN)
    assert any("cut off" in note for note in found.notes)


STUD = [(0, 12), (-24, 12), (-24, 15), (-50, 15)]
THREADED = TurnedDesign(STUD, [RingGroove(-20, 4, diameter=20.5), Thread("M24x1.5", 0, -20)])


def threaded(deep, turns=True, groove=10.25):
    insert = Tool(number=2, kind="thread", main_angle=60, auxiliary_angle=60)
    blade = Tool(number=3, kind="grooving", width=4.0)
    ways = [[(2, 12), (-24, 12), (-24, 15), (-50, 15), (-50, 18)], [(-24, 18), (-24, groove), (-24, 18)]]
    ways += [[(3, 12 - deep), (-21, 12 - deep)]] if turns else []
    tools = [SHARP, blade, insert][: len(ways)]
    bar = cylinder(18, -60, 0)
    return Turned(cutting(tools, ways, bar, threads=(2,), pitch=1.5))


def test_a_thread_is_judged_by_its_band():
    """Cut 0.9 deep, less than 17/24·√3·1.5 = 1.84/2 = 0.92, it is right; not cut at all it is not; 1.0 deep it gouges by 0.08."""
    right, none, deep = (threaded(*args).compare(THREADED) for args in ((0.9,), (0.9, False), (1.0,)))
    assert right.ok and row_of(right, "thread", "thread").actual == pytest.approx(24)
    assert row_of(none, "thread", "thread").verdict == "not cut" and not none.ok
    core = 17 / 24 * math.sqrt(3) / 2 * 1.5
    assert deep.worst_gouge.value == pytest.approx(1.0 - core, abs=1e-5) and deep.worst_gouge.line == deep.worst_gouge.row
    assert any("thread" in note for note in right.notes)


@pytest.mark.parametrize("seed", deep_but_one_in(4, range(12)))
def test_random_designs_against_themselves_and_grown(seed):
    """Drawn parts are as drawn; moved along the axis by 0.02 every face across is off by as much."""
    design, *_ = shaft(seed)
    part = design.workpiece()
    found = part.compare(design)
    assert found.ok and found.worst_gouge.value == found.worst_rest.value == 0
    assert {row.verdict for row in found.features} <= {"ok", "not measured"}
    moved = part.compare(design.moved((0, 0, 0.02)))
    assert moved.worst_gouge.value == pytest.approx(0.02, abs=WITHIN)
    assert moved.worst_rest.value <= 0.02 + WITHIN and moved.gouge_volume > 0


def test_wrong_arguments_are_alarms(tmp_path):
    part = cut()
    milled = Design(((0, 0, -20), (60, 40, 0)), [Face(1)])
    for wrong in (milled, 3, "nothing.toml", tmp_path / "nothing.stl", tmp_path / "x.txt", None):
        with pytest.raises(Alarm):
            part.compare(wrong)
    with pytest.raises(Alarm):
        part.compare(DESIGN, tolerance=0)
    assert BAR.bounds[1, 2] == 0


def test_a_thread_and_the_groove_beside_it_are_measured():
    found = threaded(0.9).compare(THREADED)
    for name, value in (("length", 20), ("z", 0), ("pitch", 1.5)):
        assert row_of(found, name, "thread").actual == pytest.approx(value)
    for name, value in (("width", 4), ("diameter", 20.5), ("z", -20)):
        assert row_of(found, name, "ring groove").actual == pytest.approx(value, abs=WITHIN)
    other = TurnedDesign(STUD, [RingGroove(-20, 4, diameter=20.5), Thread("M24x2", 0, -20)])
    assert row_of(threaded(0.9).compare(other), "pitch", "thread").verdict == "out"

"""Finished contours in whole programs: the example C21 (8.13), the definitions of 8.7 and 8.8, and values at their limits.

Expected numbers are those that the catalogue works out of the manual's examples.
"""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup, Tool

CATALOGUE = Path(__file__).parents[2] / "authorities" / "catalogue" / "programs-tnc-620.json"
PROGRAMS = [entry["program"] for entry in json.loads(CATALOGUE.read_text(encoding="utf-8"))]
(C21,) = (text for text in PROGRAMS if "BEGIN PGM C21 " in text)
TOOLS = {
    1: Tool(radius=6, angle=118, kind="drill"),
    2: Tool(radius=6, plunge_angle=5, cutting_length=25, kind="mill"),
    3: Tool(radius=5),
}
DATA = dict(Q1=-20, Q2=1, Q3=0.2, Q4=0.1, Q5=30, Q6=2, Q7=80, Q8=0.5, Q9=1)  # of 8.4
SQUARE = "LBL 1\nL X+0 Y+0 RL\nL X+60\nL Y+60\nL X+0\nL Y+0\nLBL 0\n"
FLOOR = "CYCL DEF 23 F\nQ11=100\nQ12=350\nQ208=9999\nCYCL CALL\n"
SIDE = "CYCL DEF 24 S\nQ9=+1\nQ10=+5\nQ11=100\nQ12=350\nQ14=+0\nQ438={}\nCYCL CALL\n"


def program(cycles, data=DATA, labels=SQUARE):
    written = "".join(f"{address}={value:+.10g}\n" for address, value in data.items())
    contour = f"CYCL DEF 14.0 C\nCYCL DEF 14.1 CONTOUR LABEL 1\nCYCL DEF 20 D\n{written}"
    return f"TOOL CALL 3 Z S2000 F500\nL X+0 Y+0 Z+200 R0 FMAX M3\n{contour}{cycles}M2\n{labels}"


def run(text):
    return mnclab.run(text, "tnc-620", Setup(tools=TOOLS))


def of(run, code):
    path = run.toolpath
    at = [label.startswith(code) for label in path.labels]
    return path[np.array(at)[path.label] & path.is_motion]


def near(value):
    return pytest.approx(value, abs=1e-6)


def test_the_floor_finishing_of_the_example():
    """Plunge at 100, one level at z = 10, milling at 350, retraction at 9999 to z = 80."""
    path = of(run(program(FLOOR)), "CYCL DEF 23")
    assert set(path[path.feed == 350].end[:, 2]) == {10} and path.end[:, 2].min() == 10
    assert path[path.feed == 100].end[:, 2] == near([11.1, 10])  # the arc begins Q4 + 1 above
    assert path[path.feed == 9999].end[:, 2].tolist() == [80]


def test_the_side_finishing_of_the_example():
    """Levels z = 25, 20, 15, 10; helix height min(2/25, 5) = 0.08 mm."""
    path = of(run(program(SIDE.format(2))), "CYCL DEF 24")
    downs = path[(path.kind == Kind.LINE) & (path.feed == 100)]
    assert downs.end[:, 2] == near([25, 20, 15, 10.08]) and path.end[:, 2].min() == 10


@pytest.fixture(scope="module")
def whole():
    return run(C21)


def test_c21_floor_and_sides(whole):
    """Floor at z = -20; 3 boundaries on z = -5, -10, -15, -20, the helix from 0.08 above the last; Q9 = +1: climb."""
    assert whole.ok, whole.alarms
    floor, side = of(whole, "CYCL DEF 23"), of(whole, "CYCL DEF 24")
    assert set(floor[floor.feed == 200].end[:, 2]) == {-20}
    downs = side[(side.kind == Kind.LINE) & (side.feed == 100)]
    assert downs.end[:, 2] == near([-5, -10, -15, -19.92] * 3)
    names = [side.labels[k] for k in side.label]
    for number, length, sense in ((1, 4 * 16 + 12 * math.pi, -1), (2, 16 + 2 * math.hypot(8, 16) + 12 * math.pi, -1)):
        rows = side[np.array([name == f"CYCL DEF 24 wall {number} of 3, infeed 4 of 4" for name in names])]
        assert rows.length == near(length) and set(np.sign(rows.sweep[rows.sweep != 0])) == {sense}
    rows = side[np.array([name == "CYCL DEF 24 wall 3 of 3, infeed 4 of 4" for name in names])]
    corner = math.acos(15 / 25)  # circles of 25 - 6 about (35, 50) and (65, 50), arcs of 6 about where they cross
    assert rows.length == near(2 * 19 * 2 * (math.pi - corner) + 2 * 6 * (math.pi - 2 * corner))


@pytest.mark.deep
def test_c21_leaves_the_pocket_of_the_example(whole):
    """20 x 2983.872 = 59677.4 mm³ are cut; nothing collides; the walls stand where they are drawn."""
    assert not whole.collisions()
    part = whole.workpiece()
    assert part.removed == pytest.approx(59677.4, rel=1e-3)
    outline, wall, *islands = sorted(part.cut("XY", -19.9), key=lambda each: -abs(each.area))
    assert abs(wall.area) == pytest.approx(3367.872, rel=1e-3)
    assert [each.area for each in islands] == pytest.approx([256, 128], rel=5e-3)


@pytest.fixture(scope="module")
def formula():
    """The example of chapter 10: as C21, with a formula, another triangle and two tools."""
    examples = json.loads((CATALOGUE.parent / "tnc620-contour-formula.json").read_text(encoding="utf-8"))
    (text,) = (entry["program"] for entry in examples if "CYCL DEF 24" in entry["program"] and "QC10" in entry["program"])
    main, *others = re.findall(r"0 BEGIN PGM \w+ MM.*?END PGM \w+ MM\n?", text, re.DOTALL)
    files = {f"{other.split()[3]}.H": other for other in others}
    mill = dict(plunge_angle=90, kind="mill")
    tools = {1: Tool(radius=6, **mill), 2: Tool(radius=5, **mill)}
    return mnclab.run(main, "tnc-620", Setup(tools=tools, files=files))


def test_the_example_of_chapter_10(formula):
    """Cycle 23 at z = -20; cycle 24 on z = -5, -10, -15, -20 with 0.08 before the last; R = 5 < Q3 + 6."""
    assert formula.ok, formula.alarms
    floor, side = of(formula, "CYCL DEF 23"), of(formula, "CYCL DEF 24")
    assert set(floor[floor.feed == 200].end[:, 2]) == {-20}
    assert side[(side.kind == Kind.LINE) & (side.feed == 100)].end[:, 2] == near([-5, -10, -15, -19.92] * 3)


@pytest.mark.deep
def test_the_example_of_chapter_10_leaves_its_pocket(formula):
    """The final volume of the catalogue, 20 x 2991.872 mm³."""
    assert not formula.collisions()
    assert formula.workpiece().removed == pytest.approx(59837.4, rel=1e-3)


# --- floors at several depths --------------------------------------------------------------------------------------------

BOXES = "".join(
    f"LBL {n}\nL X{x:+d} Y{y:+d}\nL IX{w:+d}\nL IY{h:+d}\nL IX{-w:+d}\nL IY{-h:+d}\nLBL 0\n"
    for n, x, y, w, h in ((1, 10, 10, 80, 60), (2, 30, 30, 30, 20))
)
BLANK = "BLK FORM 0.1 Z X+0 Y+0 Z-30\nBLK FORM 0.2 X+100 Y+80 Z+0\n"
STEPPED = {
    "deeper pocket": ("P1 = LBL 1 DEPTH8 P2 = LBL 2 DEPTH20", [8, 20], 8 * 80 * 60 + 12 * 30 * 20, (-8, -20)),
    "low island": ("P1 = LBL 1 I2 = LBL 2 DEPTH8", [8, 20], 20 * 80 * 60 - 12 * 30 * 20, (-20, -8)),
}


def stepped(formula):
    written = "".join(f"{a}={v:+g}\n" for a, v in (DATA | dict(Q1=-20, Q3=0.5, Q4=0.3, Q5=0, Q7=50, Q8=0)).items())
    rough = "CYCL DEF 22 R\nQ10=+6\nQ11=100\nQ12=350\nQ19=0\nCYCL CALL\n"
    head = f"BEGIN PGM A MM\n{BLANK}TOOL CALL 3 Z S2000 F500\nL X+0 Y+0 Z+100 R0 FMAX M3\nCONTOUR DEF {formula}\n"
    return run(f"{head}CYCL DEF 20 D\n{written}{rough}{FLOOR}{SIDE.format(-1)}M2\n{BOXES}END PGM A MM\n")


@pytest.mark.parametrize("name", STEPPED)
def test_floors_at_several_depths_are_finished_each_with_its_walls(name):
    """Walls in infeeds of 5 from the surface on, and at each floor with a helix of min(2/25, last infeed)."""
    formula, depths, _, _ = STEPPED[name]
    found = stepped(formula)
    assert found.ok, found.alarms
    floor, side = of(found, "CYCL DEF 23"), of(found, "CYCL DEF 24")
    assert sorted(set(floor[floor.feed == 350].end[:, 2])) == [-depth for depth in reversed(depths)]
    names = np.array([side.labels[k].split(", ")[-1] for k in side.label])
    approaches = side[names == "approach"]
    assert set(np.round(approaches.end[:, 2], 9)) == {-5, -8, -10, -15, -20}
    deepened = (approaches.start - approaches.end)[:, 2]
    assert deepened == near(np.where(np.isin(np.round(approaches.end[:, 2], 9), [-8, -20]), 0.08, 0))


@pytest.mark.deep
@pytest.mark.parametrize("name", STEPPED)
def test_the_part_with_floors_at_several_depths(name):
    """Its volume but for the corners of R = 5, one floor outside the smaller box and the other inside; nothing collides."""
    formula, _, volume, (outside, inside) = STEPPED[name]
    found = stepped(formula)
    assert not found.collisions()
    part = found.workpiece()
    assert part.removed == pytest.approx(volume - (4 - math.pi) * 25 * 20, rel=2e-3)
    x, y = np.meshgrid(np.arange(16, 85, 2.0), np.arange(16, 65, 2.0))
    within = (x > 30.3) & (x < 59.7) & (y > 30.3) & (y < 49.7)
    beside = (x < 29.7) | (x > 60.3) | (y < 29.7) | (y > 50.3)
    corner = (abs(abs(x - 45) - 15) < 5) & (abs(abs(y - 40) - 10) < 5)  # round inside, as the tool leaves it
    assert part.at(x[within & ~corner], y[within & ~corner]) == near(np.full((within & ~corner).sum(), inside))
    assert part.at(x[beside & ~corner], y[beside & ~corner]) == near(np.full((beside & ~corner).sum(), outside))


#: What is written otherwise -> the cycles run; nothing is refused and nothing is cut beyond the square.
EXTREMES = [
    dict(Q1=10, Q4=0.1), dict(Q1=0, Q4=0), dict(Q2=0.05), dict(Q3=0.0001), dict(Q4=-0.5), dict(Q6=0), dict(Q7=99999),
    dict(Q8=99999), dict(Q8=0), dict(Q9=-1),
]  # fmt: skip


@pytest.mark.parametrize("changed", EXTREMES, ids=str)
def test_data_at_their_limits(changed):
    found = run(program(FLOOR + SIDE.format(2), DATA | changed))
    assert found.ok, found.alarms
    for code in ("CYCL DEF 23", "CYCL DEF 24"):
        rows = of(found, code)
        cut = rows[np.isfinite(rows.feed) & (rows.feed != 9999)]
        assert len(cut) and cut.bounds[:, :2].min() >= 5 - 1e-9 and cut.bounds[:, :2].max() <= 55 + 1e-9


def test_called_twice_and_at_points():
    """A second call does the same again; a pattern moves all of it, the walls of 50 x 50 too."""
    first, second = np.split(of(run(program(FLOOR + "CYCL CALL\n")), "CYCL DEF 23").end, 2)
    assert first.tolist() == second.tolist()
    called = SIDE.format(2).replace("CYCL CALL", "PATTERN DEF POS1 (X+0 Y+0 Z+0) POS2 (X+200 Y+30 Z+0)\nCYCL CALL PAT FMAX")
    there = of(run(program(called)), "CYCL DEF 24")
    walls = there[there.feed == 350]
    assert walls.bounds[:, :2] == near(np.array([[5, 5], [255, 85]]))
    assert not ((walls.end[:, 0] > 55) & (walls.end[:, 0] < 205)).any()


def test_inches():
    """Lengths of the data count in inches, the fixed ones of the arcs do not: 0.02 inch + 1 mm above the floor."""
    data = dict(Q1=-0.5, Q2=1, Q3=0.01, Q4=0.02, Q5=0, Q6=0.1, Q7=2, Q8=0, Q9=1)
    text = program(FLOOR.replace("9999", "999") + SIDE.format(2).replace("+5", "+1"), data)
    labels = text.replace("+60", "+3")
    found = run(f"BEGIN PGM A INCH\n{labels}END PGM A INCH\n")
    assert found.ok, found.alarms
    arc = of(found, "CYCL DEF 23")
    arc = arc[arc.kind == Kind.ARC]
    assert (arc.end - arc.start)[0, 2] == near(-(0.02 * 25.4 + 1))
    wall = of(found, "CYCL DEF 24")
    assert wall[wall.feed == 350 * 2.54].bounds[:, :2] == near(np.array([[5, 5], [3 * 25.4 - 5] * 2]))


def test_a_tool_axis_other_than_z_is_refused():
    for cycle, code in ((FLOOR, "CYCL DEF 23"), (SIDE.format(2), "CYCL DEF 24")):
        found = run(program(cycle).replace("TOOL CALL 3 Z", "TOOL CALL 3 Y"))
        assert found.alarms[0].message == f"{code} with the tool axis Y: not built yet"

"""TCH PROBE 420 to 431 against parts of known sizes (TNC 620, chapter 16): touches, moves and results of the catalogue.

The parts are those that the titles of the examples name; the probe is that of all checks: ball radius 2, SET_UP 2, DIST 10,
length 50, its south pole at Z100 before the cycle. Numbers there are rounded to 0.0005.
"""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from tools.probed import gaps

import mnclab as mnc
from mnclab import Kind, Probe, Setup, Tool, part

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-probing-inspection.json"
EXAMPLES = json.loads(FILE.read_text(encoding="utf-8"))
BALL = 2.0
INFINITE = 1000.0


def turned(degrees, about=(0.0, 0.0)):
    """A function that turns a direction or place of the plane."""
    turn = math.radians(degrees)
    cos, sin = math.cos(turn), math.sin(turn)
    return lambda x, y: (about[0] + cos * x - sin * y, about[1] + sin * x + cos * y)


def wall(point, normal):
    return part.plane((*point, 0), (*normal, 0))


def block(x, y, length, width, degrees=0.0, top=0.0):
    """A box about a middle, turned about it, its top at a height."""
    turn = turned(degrees)
    sides = [wall((x + turn(*n)[0] * h, y + turn(*n)[1] * h), turn(*n))
             for n, h in (((1, 0), length / 2), ((-1, 0), length / 2), ((0, 1), width / 2), ((0, -1), width / 2))]  # fmt: skip
    found = part.plane((0, 0, top), (0, 0, 1))
    for side in sides:
        found = found & side
    return found


def pocket(x, y, length, width, degrees=0.0):
    return slab() - part.pocket((x, y, 0), length, width, 50, turned=degrees)


def slab(top=0.0):
    return part.plane((0, 0, top), (0, 0, 1))


def stud(x, y, diameter):
    return part.cylinder((x, y, -50), (x, y, 0), diameter / 2)


def hole(x, y, diameter):
    return slab() - part.hole((x, y, 0), diameter, 50)


def slot(low, high, axis=0):
    """A slot across the whole plane."""
    first, second = np.zeros(2), np.zeros(2)
    first[axis], second[axis] = low, high
    direction = np.eye(2)[axis]
    return (wall(first, direction) | wall(second, -direction)) & slab()


def ridge(low, high, axis=0):
    first, second = np.zeros(2), np.zeros(2)
    first[axis], second[axis] = low, high
    direction = np.eye(2)[axis]
    return wall(first, -direction) & wall(second, direction) & slab()


def sloped(a, b, c):
    """The plane z = a x + b y + c."""
    return part.plane((0, 0, c), (-a, -b, 1))


def spatial(a, b, c, point):
    """A plane of spatial angles: its normal is Z turned about X by A, then about Y by B, then about Z by C."""
    a, b = math.radians(a), math.radians(b)
    return part.plane(point, (*turned(c)(math.sin(b) * math.cos(a), -math.sin(a)), math.cos(b) * math.cos(a)))


def through(first, second, third):
    normal = np.cross(np.subtract(second, first), np.subtract(third, first))
    return part.plane(first, normal * np.sign(normal[2]))


TAN = {degrees: math.tan(math.radians(degrees)) for degrees in (0.6, 0.8)}
TURNED_SLOT = turned(1.5)
HOLES = slab()
for angle in (0.05, 90, 179.96):
    HOLES = HOLES - part.hole(
        (50.02 + 40.03 * math.cos(math.radians(angle)), 49.97 + 40.03 * math.sin(math.radians(angle)), 0), 12.02, 50
    )
#: By the code and the number of the example.
PARTS = {
    ("TCH PROBE 420", 0): wall((10.02, 10), turned(86.7)(0, -1)) & slab(), ("TCH PROBE 420", 1): block(50, 30, 100, 60, 1.5),
    ("TCH PROBE 420", 2): sloped(0, TAN[0.8], 0.5), ("TCH PROBE 420", 3): sloped(-TAN[0.6], 0, 0.5),
    ("TCH PROBE 421", 0): hole(50.03, 49.98, 75.04), ("TCH PROBE 421", 1): hole(10.02, -4.97, 30.04),
    ("TCH PROBE 421", 2): hole(10.02, -4.97, 30.04), ("TCH PROBE 421", 3): hole(0.01, 0, 7.02),
    ("TCH PROBE 422", 0): stud(50.02, 49.99, 75.03), ("TCH PROBE 422", 1): stud(50.01, 49.96, 35),
    ("TCH PROBE 422", 2): stud(-20.015, 12.01, 39.97),
    ("TCH PROBE 423", 0): pocket(50.01, 49.98, 80.06, 59.97), ("TCH PROBE 423", 1): pocket(0, 0, 100, 60, 1.5),
    ("TCH PROBE 423", 2): pocket(0.02, 0, 7.04, 20),
    ("TCH PROBE 424", 0): block(50.03, 49.95, 75.06, 34.97), ("TCH PROBE 424", 1): block(0, 0, 100, 60, 1.5),
    ("TCH PROBE 425", 0): slot(62.48, 87.51), ("TCH PROBE 425", 1): slot(9.97, 30, 1),
    ("TCH PROBE 425", 2): (wall(TURNED_SLOT(5, 0), TURNED_SLOT(-1, 0)) | wall(TURNED_SLOT(-5, 0), TURNED_SLOT(1, 0))) & slab(),
    ("TCH PROBE 426", 0): ridge(25.02, 69.98, 1), ("TCH PROBE 426", 1): ridge(9.99, 30.03),
    ("TCH PROBE 427", 0): slab(5.045), ("TCH PROBE 427", 1): wall((50.04, 0), (1, 0)) & slab(),
    ("TCH PROBE 427", 2): wall((0, -0.03), (0, -1)) & slab(),
    ("TCH PROBE 430", 0): HOLES,
    ("TCH PROBE 431", 0): through((20, 20, -10), (50, 80, 0), (90, 35, 12)), ("TCH PROBE 431", 1): sloped(0.02, -0.01, 1),
    ("TCH PROBE 431", 2): spatial(5, -3, 1.5, (50, 30, 0)),
}  # fmt: skip
TOOLS = {7: Tool(radius=BALL, length=50, kind="probe"), **{n: Tool(radius=5, dr=0.1, dl=0.2) for n in (3, 4, 5)}}


def probing(text, made, reach=10.0, before="", after="", tools=None, unit="MM", **setup):
    """Run the definition of a cycle from Z100."""
    up = f"Z+{100 / (25.4 if unit == 'INCH' else 1)!r}"
    call = f"0 BEGIN PGM P {unit}\n1 TOOL CALL 99 Z\n{before}2 L X-1.5 Y-2.5 {up} R0 FMAX\n"
    tools = {99: TOOLS[7], **TOOLS, 7: Tool(radius=5, dr=0.1)} | (tools or {})
    given = {"part": made, "probe": Probe(clearance=2, reach=reach, feed=300, rapid=2000), "tools": tools} | setup
    return mnc.run(f"{call}{text}\n{after}9 END PGM P {unit}\n", "tnc-620", Setup(**given))


def expected_moves(lines):
    """The moves of the catalogue in the same form; `back to start` names both coordinates of the plane."""
    for line in lines:
        kind = "PROBE" if line.startswith("probe") else "ARC" if line.startswith("arc") else "RAPID"
        yield kind, {m[0][0]: float(m[0][1:]) for m in re.finditer(r"[XYZ]-?\d+(?:\.\d+)?", line)}


def numbered():
    counts: dict[str, int] = {}
    for example in EXAMPLES:
        code, number = example["code"], counts.get(example["code"], 0)
        counts[code] = number + 1
        if (code, number) in PARTS:
            yield pytest.param(code, number, example, id=f"{code} {number}")


def program_of(code, number):
    return [e for e in EXAMPLES if e["code"] == code][number]["program"]


def height(text, code, number):
    """The example of 431 has a clearance height in the part; the catalogue tests its moves 50 mm up."""
    return text.replace("Q260=+5 ", "Q260=+50 ") if (code, number) == ("TCH PROBE 431", 0) else text


#: Examples whose part is not what their parameters say, with the way that it takes: the stud of 16.5 has 35 for its 75.
ELSEWHERE = {("TCH PROBE 422", 1)}


@pytest.mark.parametrize(("code", "number", "example"), [each for each in numbered() if each.values[:2] not in ELSEWHERE])
def test_an_example_measures_with_the_probe_that_every_setup_has(code, number, example):
    """16.9 begins 12.5 before its wall, 10.5 more than the ball and 0.5 more than DIST = 10: the wall is in reach there, too."""
    text = height(example["program"] or program_of(code, 0), code, number)
    run = probing(text, PARTS[code, number], probe=Probe())
    assert run.touches and not any("did not trigger" in alarm.message for alarm in run.alarms)
    for name, value in example["check"]["results"].items():
        assert run.variables[name] == pytest.approx(value, abs=5.01e-5), name


@pytest.mark.parametrize("axis", [1, 2])
@pytest.mark.parametrize("clearance", [0, 1.5])
def test_how_far_the_first_touch_of_a_slot_reaches(axis, clearance):
    """Half of Q311 = 60 and the clearance Q320 + SET_UP = 2 beyond DIST: 32 and 33.5 mm from the start, as MNC 12.18 has it."""
    places, rest = f"Q328=0 Q329=0 Q310=0 Q272={axis} Q261=-5 Q260=20", f"Q288=0 Q289=0 Q281=0 Q309=0 Q330=0 Q320={clearance}"
    text = f"TCH PROBE 425\n{places} Q311=60 {rest} Q301=0"
    limit = 30 + clearance + 2 + BALL
    near = probing(text, slot(-30, limit - 0.01, axis - 1), probe=Probe())
    assert near.ok and near.variables["Q156"] == pytest.approx(30 + limit - 0.01, abs=1e-9)
    (alarm,) = probing(text, slot(-30, limit + 0.01, axis - 1), probe=Probe()).alarms
    assert alarm.message == f"touch point inaccessible: the probe did not trigger within {30 + clearance + 2:g} mm"


@pytest.mark.parametrize(("code", "number", "example"), [*numbered()])
def test_an_example(code, number, example):
    check = example["check"]
    text = height(example["program"] or program_of(code, 0), code, number)
    run = probing(text, PARTS[code, number], check.get("DIST", 10))
    stops = "Q309=1" in text and check["results"]["Q180"] == 0
    assert [a.message.partition(":")[0] for a in run.alarms if a.severity == "alarm"] == [code] * stops, run.alarms
    rows = run.toolpath.motion
    touched = [row for row in rows if row.kind == Kind.PROBE]
    for row, touch in zip(touched, check["touches"], strict=True):
        lift = (0, 0, BALL)
        assert row.start + lift == pytest.approx(np.array(touch["start"], float), abs=6e-5), touch
        assert row.end + lift == pytest.approx(np.array(touch["ball_center"], float), abs=6e-5), touch
        assert np.linalg.norm(row.end - row.start) == pytest.approx(touch["travel"], abs=6e-5)
    for name, value in check["results"].items():
        assert run.variables[name] == pytest.approx(value, abs=5.01e-5), name
    if lines := check.get("moves") or check.get("moves_with_Q260_50"):
        found = list(rows)[1:]
        assert len(found) == len(lines)
        for row, (kind, place) in zip(found, expected_moves(lines), strict=True):
            assert kind == ("PROBE" if row.kind == Kind.PROBE else "ARC" if row.kind == Kind.ARC else "RAPID"), lines
            for axis, value in place.items():
                assert row.end["XYZ".index(axis)] == pytest.approx(value, abs=6e-5)
    assert (gaps(run, PARTS[code, number], BALL)[1:] >= -1e-6).all()  # the first row comes from where the machine stands
    if change := check.get("DR_change"):
        tool = int(re.search(r"Q330=(\d+)", text)[1])
        assert run.tables.tools[tool].dr == pytest.approx(0.1 + change, abs=1e-9)
    elif "Q330=0" in text:
        assert {tool.dr for number, tool in run.tables.tools.items() if number in (3, 4, 5, 7)} == {0.1}

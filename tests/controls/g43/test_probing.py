"""G31 and G38.2 to G38.5 on a part: closed forms beside each test, and the same touches as TCH PROBE 3 of the TNC.

The probe T9 has a ball of radius 3; what is programmed is its lowest point, so the centre stands 3 above.
"""

import math
import random
from pathlib import Path

import numpy as np
import pytest

import mnclab as mnc
from mnclab import Kind, Probe, Setup, Tool, part

BALL, LONG = 3.0, 50.0
TOOLS = {9: Tool(radius=BALL, length=LONG, kind="probe")}
BLOCK = part.box((0, 0, -20), (60, 40, 0))
BORED = BLOCK - part.hole((30, 20, 0), 24, 15)
LEAN = math.radians(15)
FAR = part.box((900, 900, 900), (901, 901, 901))
SILENT = {"lint": "off", "stopped_spindle": "accept"}


def run(text, made=BLOCK, dialect="linuxcnc", tools=TOOLS, settings=None, **setup):
    """A program of the probe, whose length counts."""
    given = Setup(tools=tools, part=made, settings=SILENT | {"dialect": dialect} | (settings or {}), **setup)
    return mnc.run(f"G21 G17 G90 T9 M6\nG43 H9 F200\n{text}\nM30\n", "g43", given)


def places(found, count=3):
    return [found.variables[f"#{5061 + k}"] for k in range(count)]


# --- where the probe stops --------------------------------------------------------------------------------------------

#: Part, start (tip), end of the way, where the tip stops.
CONTACTS = {
    "wall of a box": (BLOCK, (-20, 20, -8), (10, 20, -8), (-3, 20, -8)),
    "wall, aslant": (BLOCK, (-20, 5, -8), (10, 20, -8), (-3, 5 + 17 / 2, -8)),
    "top": (BLOCK, (10, 10, 8), (10, 10, -5), (10, 10, 0)),
    # the edge X0 Z0, met below the middle of the ball: its centre at height 2 is 5 ** 0.5 beside it
    "edge": (BLOCK, (-20, 20, -1), (10, 20, -1), (-math.sqrt(BALL**2 - 4), 20, -1)),
    # in a bore of radius 12 the centre of the ball goes to radius 9
    "bore": (BORED, (30, 20, -8), (30, 50, -8), (30, 29, -8)),
    "bore, beside its middle": (BORED, (33, 22, -8), (50, 22, -8), (30 + math.sqrt(9**2 - 2**2), 22, -8)),
    # a boss of radius 10 is met at radius 13
    "boss": (part.cylinder((0, 0, -30), (0, 0, 0), 10), (-40, 5, -8), (40, 5, -8), (-math.sqrt(13**2 - 5**2), 5, -8)),
    # a slope through X0 Z0 that leans by 15 degrees: the ball stands 3 off it, so above X = -10 by its lowest point
    "slope": (
        part.plane((0, 0, 0), (math.sin(LEAN), 0, math.cos(LEAN))), (-10, 0, 40), (-10, 0, -10),
        (-10, 0, 10 * math.tan(LEAN) + BALL / math.cos(LEAN) - BALL),
    ),
}  # fmt: skip


def point(xyz):
    return " ".join(f"{axis}{value:.10g}" for axis, value in zip("XYZ", xyz, strict=True))


@pytest.mark.parametrize("name", CONTACTS)
@pytest.mark.parametrize(("code", "dialect"), [("G31", "fanuc"), ("G31", "haas"), ("G38.2", "linuxcnc"), ("G38.3", "linuxcnc")])
def test_contacts(name, code, dialect):
    made, start, end, expected = CONTACTS[name]
    found = run(f"G0 {point(start)}\n{code} {point(end)} F80", made, dialect, settings={"skip_position": "tip"})
    assert found.ok and not found.alarms, found.alarms
    row = found.toolpath.motion[-1]
    assert (row.kind, row.feed) == (Kind.PROBE, 80)
    assert row.end == pytest.approx(expected, abs=1e-9) and places(found) == pytest.approx(expected, abs=1e-9)
    assert found.variables.get("#5070") == (None if code == "G31" else 1)
    (touch,) = found.touches
    assert touch.centre == pytest.approx(np.array(expected) + (0, 0, BALL), abs=1e-9)


#: Where the ball stands in the material at first, which way it goes, and where it comes free: tip.
RELEASES = {
    "wall of a box": (BLOCK, (-1, 20, -8), (-10, 20, -8), (-3, 20, -8)),
    "top, aslant": (BLOCK, (10, 10, -2), (22, 10, 10), (12, 10, 0)),
    "bore": (BORED, (30, 31, -8), (30, 10, -8), (30, 29, -8)),
    "bore, beside its middle": (BORED, (41, 22, -8), (20, 22, -8), (30 + math.sqrt(9**2 - 2**2), 22, -8)),
    "slope": (
        part.plane((0, 0, 0), (math.sin(LEAN), 0, math.cos(LEAN))), (-10, 0, 1), (-10, 0, 20),
        (-10, 0, 10 * math.tan(LEAN) + BALL / math.cos(LEAN) - BALL),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", RELEASES)
@pytest.mark.parametrize("code", ["G38.4", "G38.5"])
def test_releases(name, code):
    """A tool that is not said to be a probe may be led into the part: it stands there, and comes out."""
    made, start, end, expected = RELEASES[name]
    found = run(f"G0 {point(start)}\n{code} {point(end)}", made, tools={9: Tool(radius=BALL, length=LONG)})
    assert found.ok and not found.alarms, found.alarms
    assert found.toolpath.end[-1] == pytest.approx(expected, abs=1e-9)
    assert places(found) == pytest.approx(expected, abs=1e-9) and found.variables["#5070"] == 1


def test_along_a_face_it_touches_to_the_edge():
    """A ball of radius 3 that is 2e-6 beside the edge is not yet 1e-12 off it: numbers tell no more."""
    along = run("G0 X10 Y10 Z5\nG38.2 Z-5\nG38.4 X-20")
    assert along.ok and places(along) == pytest.approx((0, 10, 0), abs=1e-5)
    aslant = run("G0 X10 Y10 Z5\nG38.2 Z-5\nG38.4 X-20 Z1")
    assert aslant.ok and places(aslant) == pytest.approx((10, 10, 0), abs=1e-8)


def test_the_way_of_a_trigger():
    """A probe that goes on by 0.02 in X until it triggers stops there, and is free after as much."""
    found = run("G0 X-20 Y20 Z-8\nG38.2 X5\n#1=#5061\nG38.4 X-5\n#2=#5061\nG0 X-20", probe=Probe(deflection=(0.02, 0.03, 0.04)))
    assert found.ok and not found.alarms, found.alarms
    assert [found.variables[f"#{k}"] for k in (1, 2)] == pytest.approx([-2.98, -3], abs=1e-9)


def test_again_and_again():
    """Towards it fast, away slowly, towards it once more without a way between: one place."""
    found = run("G0 X-20 Y20 Z-8\n" + "\n".join(
        f"G38.{code} X{end} F{feed}\n#{k + 1}=#5061" for k, (code, end, feed) in
        enumerate([(2, 5, 300), (4, -10, 20), (2, 5, 20), (5, -10, 20), (3, 5, 20)])
    ))  # fmt: skip
    assert found.ok and not found.alarms, found.alarms
    assert [found.variables[f"#{k}"] for k in range(1, 6)] == pytest.approx([-3] * 5, abs=1e-8)
    assert len(found.touches) == 5 and [touch.direction for touch in found.touches] == [(1, 0, 0)] * 5


# --- without a contact, or with one from the start --------------------------------------------------------------------

LEAVES = "G0 X-20 Y20 Z-8\n"
AT_THE_WALL = f"{LEAVES}G38.2 X5\n"


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        (f"{LEAVES}G38.2 X-10", 4, "G38.2: the probe touched nothing within 10 mm"),
        (f"{LEAVES}G20 G38.2 X-.5", 4, "G38.2: the probe touched nothing within 0.2874016 in"),  # 20 - 12.7 = 7.3 mm
        (f"{AT_THE_WALL}G38.4 Y30", 5, "G38.4: the probe still touches after 10 mm"),
        (f"{AT_THE_WALL}G38.2 X5", 5, "G38.2: the probe touches already where it starts"),
        (f"{AT_THE_WALL}G38.4 X-9\nG38.4 X-15", 6, "G38.4: the probe touches nothing where it starts"),
        (f"{LEAVES}G38.4 X-25", 4, "G38.4: the probe touches nothing where it starts"),
        (f"{LEAVES}G38.2 X-20", 4, "G38.2 leads to where the probe stands: it needs a way"),
        (f"{LEAVES}G93 G38.2 X5 F1", 4, "G38.2 cannot stand under G93: how long its way is, the part says"),
        (f"{LEAVES}G38.2 X5 B3", 4, "G38.2 B would turn a rotary axis while the probe moves, which is not built"),
        (f"{LEAVES}G38.2 A3", 4, "G38.2 A would turn a rotary axis while the probe moves, which is not built"),
    ],
)
def test_alarms(text, line, message):
    (alarm,) = run(text).alarms
    assert (alarm.span.line, alarm.message) == (line, message) and alarm.severity == "alarm"


def test_without_a_contact():
    missed = run(f"{LEAVES}G38.3 X-10 Y25\n#1=#5070")
    assert missed.ok and not missed.alarms and missed.variables["#1"] == 0 and not missed.touches
    assert places(missed) == [-10, 25, -8] and tuple(missed.toolpath.end[-1]) == (-10, 25, -8)
    missed = run(f"{AT_THE_WALL}G38.5 Y30\n#1=#5070")
    assert missed.ok and missed.variables["#1"] == 0 and places(missed) == pytest.approx([-3, 30, -8], abs=1e-9)
    missed = run(f"{LEAVES}G31 X-10 Y25", dialect="haas")
    assert missed.ok is False  # a Haas wants F in the block
    missed = run(f"{LEAVES}G31 X-10 Y25 F50", dialect="haas")
    assert missed.ok and not missed.alarms and places(missed) == [-10, 25, -8]


@pytest.mark.parametrize(
    ("text", "dialect", "said"),
    [
        (f"{AT_THE_WALL}G38.3 X5", "linuxcnc", "the probe touches already: G38.3 ends where it stands"),
        (f"{AT_THE_WALL}G38.3 Y30", "linuxcnc", "the probe touches already: G38.3 ends where it stands"),
        (f"{AT_THE_WALL}G38.4 X-9\nG38.5 X-15", "linuxcnc", "the probe touches nothing: G38.5 ends where it stands"),
        (f"{LEAVES}G31 X5\nG31 X10", "fanuc", "the probe touches already: G31 ends where it stands"),
    ],
)
def test_what_is_waited_for_is_there_already(text, dialect, said):
    found = run(text, dialect=dialect)
    assert found.ok and [alarm.message for alarm in found.alarms] == [said]
    assert found.toolpath.end[-1] == pytest.approx((-3, 20, -8), abs=1e-9)
    assert places(found, 2) == pytest.approx((-3, 20), abs=1e-9)


# --- where coordinates count from -------------------------------------------------------------------------------------


def test_in_inches_and_increments():
    """The wall of a part at X25.4 is met at 22.4 mm; the place stays as it was written when the unit changes."""
    made = BLOCK.shifted(25.4)
    found = run("G20\nG0 X-1 Y.5 Z-.25\nG91 G38.2 X3 Y1 F4\n#1=#5061\nG21\n#2=#5061\n#3=#5062", made)
    assert found.ok and not found.alarms and found.toolpath.feed[-1] == pytest.approx(4 * 25.4), found.alarms
    way = (22.4 + 25.4) / (3 * 25.4)
    expected = [22.4 / 25.4, 22.4 / 25.4, 0.5 + way]
    assert [found.variables[f"#{k}"] for k in (1, 2, 3)] == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("code", ["G31", "G38.2"])
def test_offsets(code):
    """G55 at (100, 50, -30), shifted by G92 so that X-20 is X80: the wall at machine X110 is met at 107, which is X107."""
    dialect = "linuxcnc" if code == "G38.2" else "haas"
    found = run(f"G55\nG0 X-20 Y20 Z-8\nG92 X80\n{code} X130 F100\n#101=#5061\nG92.1\n#102=#5061", BLOCK.shifted(110, 50, -30),
                dialect, datums={2: (100, 50, -30)})  # fmt: skip
    assert found.ok, found.alarms
    assert [found.variables[f"#{k}"] for k in (101, 102)] == pytest.approx([107, 107], abs=1e-9)
    assert found.toolpath.end[-1] + found.toolpath.origin == pytest.approx((107, 70, -38), abs=1e-9)


def test_turned_systems():
    """Along X of a system turned by 30 degrees about its origin: the machine's wall X = 20 is met at X 17 / cos 30."""
    made = part.box((20, -100, -20), (60, 100, 0))
    turned = run("G10 L2 P1 R30\nG0 X0 Y0 Z-8\nG38.2 X60", made)
    by_code = run("G68 X0 Y0 R30\nG0 X0 Y0 Z-8\nG31 X60 Y0 F50", made, "haas", settings={"undescribed": "accept"})
    for found in (turned, by_code):
        assert found.ok and not found.alarms, found.alarms
        assert places(found) == pytest.approx((17 / math.cos(math.pi / 6), 0, -8), abs=1e-9)
        assert found.toolpath.end[-1] == pytest.approx((17, 17 * math.tan(math.pi / 6), -8), abs=1e-9)


@pytest.mark.parametrize(("text", "end", "place"), [
    ("G51.1 X0\nG0 X-80 Y20 Z-8\nG31 X-50 Y20", (63, 20, -8), (-63, 20, -8)),  # seen in a mirror
    ("G51 X0 Y0 Z0 P2.\nG0 X-10 Y10 Z-4\nG31 X5 Y10", (-3, 20, -8), (-1.5, 10, -4)),  # the ball keeps its size
    ("G16\nG0 X50 Y180 Z-8\nG31 X-5", (-3, 0, -8), (-3, 0, -8)),  # polar: the radius 50 at 180 degrees goes to -5
])  # fmt: skip
def test_transformed(text, end, place):
    made = BLOCK | part.box((0, -20, -20), (60, 0, 0))
    found = run(text, made, "fanuc", settings={"undescribed": "accept", "skip_position": "tip"})
    assert found.ok, found.alarms
    assert found.toolpath.end[-1] == pytest.approx(end, abs=1e-9) and places(found) == pytest.approx(place, abs=1e-9)


def test_the_length_of_the_probe():
    """On Fanuc positions of the tool count with the offset of G43, #5063 like #5043; on a Haas as they are programmed."""
    text = "G0 X10 Y10 Z5\nG31 Z-5 F50\n#101=#5063\n#102=#5043\n#103=#5063-#5083"
    fanuc, haas = run(text, dialect="fanuc").variables, run(text, dialect="haas").variables
    assert (fanuc["#101"], fanuc["#102"], fanuc["#103"], haas["#101"]) == pytest.approx((LONG, LONG, 0, 0), abs=1e-9)
    assert run("G49\nG0 X10 Y10 Z60\nG31 Z40", dialect="fanuc").variables["#5063"] == pytest.approx(LONG, abs=1e-9)


def test_one_block_or_until_another_motion():
    once = run("G0 X-20 Y20 Z-8\nG1 X-19\nG31 X5\nX-10\nG1 G31 X5\nX-15", dialect="fanuc", settings={"undescribed": "accept"})
    kinds = [Kind.LINE, Kind.PROBE, Kind.LINE, Kind.PROBE, Kind.LINE]
    assert once.ok and [row.kind for row in once.toolpath.motion[-5:]] == kinds
    stays = run("G0 X-20 Y20 Z-8\nG38.3 X-10\nX5\nG0 X-9")
    assert stays.ok and [row.kind for row in stays.toolpath.motion[-3:]] == [Kind.PROBE, Kind.PROBE, Kind.RAPID]
    blocks = "\n".join(f"X{-19 + k / 10:g}" for k in range(120))
    many = run(f"G0 X-20 Y20 Z-8\nG38.3 Y21\n{blocks}", FAR)
    assert many.ok and many.toolpath.motion.kind.tolist() == [Kind.RAPID, *[Kind.PROBE] * 121]


def test_in_a_loop():
    """Twelve walls of a staircase, each found by the same block."""
    steps = [part.box((5 * k, 10 * k, -20), (200, 10 * k + 10, 0)) for k in range(12)]
    stairs = steps[0]
    for step in steps[1:]:
        stairs |= step
    text = ("#101=0\nWHILE [#101 LT 12] DO1\nG0 X-20 Y[10*#101+5]\nZ-8\nG31 X100 F200\n#[120+#101]=#5061\nG0 X-20\n"
            "#101=#101+1\nEND1")  # fmt: skip
    found = run(text, stairs, "fanuc")
    assert found.ok, found.alarms
    expected = [5 * k - BALL for k in range(12)]  # the ball, 5 mm beside the corner of the step before, passes it
    assert [found.variables[f"#{120 + k}"] for k in range(12)] == pytest.approx(expected, abs=1e-9)


def test_300_touches_of_a_loop():
    """Down on a slope of 15 degrees: its height, and what the ball stands higher than its lowest point."""
    made = part.plane((0, 0, 0), (math.sin(LEAN), 0, math.cos(LEAN)))
    text = ("#1=0\nWHILE [#1 LT 300] DO1\nG0 X[-#1]\nZ[#1*.4+10]\nG31 Z-10\n#[200+#1]=#5063-#5083\nG0 Z400\n#1=#1+1\nEND1")
    found = run(f"G0 Z400\n{text}", made, "fanuc")
    assert found.ok and len(found.touches) == 300, found.alarms
    heights = [k * math.tan(LEAN) + BALL / math.cos(LEAN) - BALL for k in range(300)]
    assert [found.variables[f"#{200 + k}"] for k in range(300)] == pytest.approx(heights, abs=1e-9)


def test_what_the_program_has_cut():
    """A slot of 10 mm along X at Y20 is cut 5 deep; the probe finds its walls 2 mm beside its middle."""
    tools = TOOLS | {1: Tool(radius=5, length=40, kind="mill", number=1)}
    text = ("T1 M6\nG43 H1 S1000 M3\nG0 X-10 Y20 Z5\nG1 Z-5\nX70\nG0 Z50\nM5\nT9 M6\nG43 H9\nG0 X30 Y20\nG38.2 Z-4\n"
            "G38.2 Y40\n#1=#5062\nG0 Y20\nG38.2 Y0\n#2=#5062")  # fmt: skip
    found = run(text, "cut", tools=tools, stock=((0, 0, -20), (60, 40, 0)))
    assert not found.ok  # nothing within Z-4: the floor is at -5
    found = run(text.replace("G38.2 Z-4", "G1 Z-4"), "cut", tools=tools, stock=((0, 0, -20), (60, 40, 0)))
    assert found.ok, found.alarms
    assert [found.variables[f"#{k}"] for k in (1, 2)] == pytest.approx([22, 18], abs=1e-6)


def test_a_spindle_that_turns():
    """No control minds it, and it is said."""
    found = run(f"{LEAVES}S100 M3\nG38.2 X5")
    assert found.ok and [alarm.message for alarm in found.alarms] == ["the spindle turns with a touch probe in it"]


def test_the_stem():
    """Below an overhang the stem meets the part before the ball does."""
    shelf = BLOCK | part.box((-10, 0, 5), (0, 40, 10))
    (alarm,) = run("G0 X-30 Y20 Z-8\nG38.2 X5", shelf, probe=Probe(stem=1.0, stem_length=40)).alarms
    assert alarm.message == "the stem of the probe touches the part before the ball does"


# --- programs ---------------------------------------------------------------------------------------------------------

FOUR = """G0 X{x} Y{y}
Z-6
{code} X{right} F200
#101=#5061
G0 X{x}
{code} X{left} F200
#102=#5061
G0 X[[#101+#102]/2]
{code} Y{back} F200
#103=#5062
G0 Y{y}
{code} Y{front} F200
#104=#5062
"""


def four_touches(code, reach=30):
    x, y = 1.5, -2.25
    return FOUR.format(code=code, x=x, y=y, right=x + reach, left=x - reach, back=y + reach, front=y - reach)


@pytest.mark.parametrize("turned", [0.0, 30.0])
@pytest.mark.parametrize(("code", "dialect", "write"), [
    ("G31", "fanuc", "#105=[#101+#102]/2\n#106=[#103+#104]/2\nG10 L2 P1 X[#5221+#105] Y[#5222+#106]"),
    ("G38.2", "linuxcnc", "G0 X[[#101+#102]/2] Y[[#103+#104]/2]\nG10 L20 P1 X0 Y0"),
])  # fmt: skip
def test_the_middle_of_a_bore(code, dialect, write, turned):
    """The bore was thought to be at (300, 200) and is at (302.75, 198.5): the datum is there to 1e-9."""
    if turned:
        write = write.replace("+#105", "+#105*COS[30]-#106*SIN[30]").replace("+#106]", "+#105*SIN[30]+#106*COS[30]]")
    made = part.box((250, 150, -420), (350, 250, -400)) - part.hole((302.75, 198.5, -400), 40, 20)
    found = run(four_touches(code) + write + "\nG54 G0 Z20\nX0 Y0", made, dialect, datums={1: (300, 200, -400, 0, 0, 0, turned)},
                start=(300, 200, 0))  # fmt: skip
    assert found.ok, found.alarms
    assert found.tables.datums[1][:2] == pytest.approx((302.75, 198.5), abs=1e-9)
    assert (found.toolpath.end[-1] + found.toolpath.origin)[:2] == pytest.approx((302.75, 198.5), abs=1e-9)


def test_the_bore_of_the_lesson():
    """The plate of the lesson, turned by 2 degrees: the datum is the middle of its bore."""
    design = mnc.Design(((0, 0, -20), (80, 60, 0)), [mnc.design.Hole(40, 30, 30, 12, point=180)])
    setup = Setup(tools={20: Tool(3, 150, kind="probe")}, datums={1: (300, 200, -400)}, start=(280, 180, -300),
                  part=design.part.turned(2).shifted(303, 198.5, -400))  # fmt: skip
    found = mnc.run(Path(__file__).parents[3] / "data" / "lessons" / "bore_middle.nc", "g43", setup)
    assert found.ok and not found.alarms and [touch.label for touch in found.touches] == ["G31"] * 4
    cos, sin = math.cos(math.radians(2)), math.sin(math.radians(2))
    assert found.tables.datums[1][:2] == pytest.approx((303 + 40 * cos - 30 * sin, 198.5 + 40 * sin + 30 * cos), abs=1e-9)


def bodies(rng):
    """A block with a bore and a boss on it, somewhere, turned."""
    x, y, size = rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(30, 50)
    made = part.box((-size, -size, -25), (size, size, 0)) - part.hole((x, y, 0), rng.uniform(20, 40), 15)
    if rng.random() < 0.5:
        made |= part.boss((x, y, -15), 12, diameter=rng.uniform(4, 9))
    return made.turned(rng.uniform(0, 90))


def test_200_touches_are_those_of_tch_probe_3():
    """The same start, direction and part: the same touches on the TNC, hit or not."""
    rng = random.Random(383)
    kinds, tried = set(), 0
    while tried < 200:
        made, ball = bodies(rng), rng.choice((0.5, 1.0, 2.5))
        tools = {9: Tool(radius=ball, length=LONG, kind="probe")}
        start = [rng.uniform(-60, 60), rng.uniform(-60, 60), rng.uniform(-14, 4)]
        if float(made(np.array(start) + (0, 0, ball))[0]) <= ball + 0.1:
            continue
        tried += 1
        angle, reach, axis = rng.uniform(-180, 180), rng.uniform(5, 60), rng.choice("XYZ")
        way = np.zeros(3)
        k = "XYZ".index(axis)
        way[k], way[(k + 1) % 3] = reach * math.cos(math.radians(angle)), reach * math.sin(math.radians(angle))
        place = " ".join(f"{name}{value:.17g}" for name, value in zip("XYZ", start, strict=True))
        signed = " ".join(f"{name}{value:+.17g}" for name, value in zip("XYZ", start, strict=True))
        iso = run(f"G0 {place}\nG91 G38.3 {' '.join(f'{name}{value:.12f}' for name, value in zip('XYZ', way, strict=True))}",
                  made, tools=tools)  # fmt: skip
        text = (f"BEGIN PGM P MM\nTOOL CALL 9 Z\nL {signed} R0 FMAX\nTCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q1\n"
                f"TCH PROBE 3.2 {axis} ANGLE: {angle:+.17g}\nTCH PROBE 3.3 ABST {reach:+.17g} F100 MB0 REFERENCE SYSTEM: 0\n"
                "TCH PROBE 3.4 ERRORMODE0\nEND PGM P MM\n")  # fmt: skip
        tnc = mnc.run(text, "tnc-620", Setup(tools=tools, part=made, settings={"lint": "off"}))
        if not (iso.ok and tnc.ok):  # led through the part before, on both
            assert iso.ok == tnc.ok, (iso.alarms, tnc.alarms)
            tried -= 1
            continue
        hits = int(iso.variables["#5070"])
        assert len(iso.touches) == len(tnc.touches) == hits and tnc.variables["Q4"] == (1 if hits else -1)
        kinds.add((axis, hits))
        place = np.array(places(iso)) + (0, 0, ball)
        assert place == pytest.approx([tnc.variables[f"Q{n}"] for n in (1, 2, 3)], abs=1e-9)
        for ours, theirs in zip(iso.touches, tnc.touches, strict=True):
            assert ours.surface == pytest.approx(theirs.surface, abs=1e-9)
            assert ours.centre == pytest.approx(theirs.centre, abs=1e-9)
    assert len(kinds) == 6

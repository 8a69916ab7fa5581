"""TCH PROBE 0, 1, 3 and 4 (TNC 620, 16.2, 16.3, 17.2, 17.3): the examples of the catalogue, random walls, inches, DIN/ISO.

The probe has a ball of radius 2 and a length of 50; what is expected is worked out beside each test.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import mnclab as mnc
from mnclab import Kind, Probe, Setup, Tool, part

BALL, LONG = 2.0, 50.0
TOOLS = {7: Tool(radius=BALL, length=LONG, kind="probe")}


def probing(text, made, unit="MM", reach=10.0, **setup):
    given = {"part": made, "tools": TOOLS, "probe": Probe(reach=reach, feed=300, rapid=2000)} | setup
    return mnc.run(f"BEGIN PGM P {unit}\nTOOL CALL 7 Z\n{text}END PGM P {unit}\n", "tnc-620", Setup(**given))


def at(x, y, z):
    return f"L X{x:+.10g} Y{y:+.10g} Z{z:+.10g} R0 FMAX\n"


def zero(q, axis, *place):
    return f"67 TCH PROBE 0.0 PLAN DE REFERINTA Q{q} {axis}\n68 TCH PROBE 0.1 {' '.join(place)}\n"


def polar(axis, angle, *place, word="ANGLE:"):
    return f"TCH PROBE 1.0 DECAL.ORIG.POL.\nTCH PROBE 1.1 {axis} {word} {angle:+.10g}\nTCH PROBE 1.2 {' '.join(place)}\n"


def three(q, axis, angle, way, back=1, system=0, mode=1, feed=100):
    return (
        f"4 TCH PROBE 3.0 MASURARE\n5 TCH PROBE 3.1 Q{q}\n6 TCH PROBE 3.2 {axis} UNGHI: {angle:+.10g}\n"
        f"7 TCH PROBE 3.3 ABST {way:+g} F{feed} MB{back:g} SISTEM DE REFERINTA: {system}\n8 TCH PROBE 3.4 MOD EROARE{mode}\n"
    )


def four(q, direction, way, back=50, system=0):
    said = " ".join(f"I{axis}{value:+.10g}" for axis, value in zip("XYZ", direction, strict=True))
    return (
        f"4 TCH PROBE 4.0 MASURARE 3D\n5 TCH PROBE 4.1 Q{q}\n6 TCH PROBE 4.2 {said}\n"
        f"7 TCH PROBE 4.3 ABST{way:+g} F100 MB{back:g} SISTEM DE REFERINTA:{system}\n"
    )


def four_values(run, first):
    return [run.variables[f"Q{first + k}"] for k in range(4)]


def touch_of(run):
    return next(row for row in run.toolpath if row.kind == Kind.PROBE)


def test_reference_plane_as_printed():
    """16.2: a face at X 0.012 facing +X; from X5 along -X; the ball touches at 2.012, Q117 = -5 + 50."""
    run = probing("L Z+100 R0 FMAX\n" + zero(5, "X-", "X+5", "Y+0", "Z-5"), part.plane((0.012, 0, 0), (1, 0, 0)),
                  start=(40, 0, 0))  # fmt: skip
    assert run.ok, run.alarms
    touch = touch_of(run)
    assert tuple(touch.start) == (5, 0, -5) and touch.end == pytest.approx((2.012, 0, -5), abs=1e-9)
    assert [run.variables[q] for q in ("Q5", "Q115", "Q116", "Q117")] == pytest.approx([0.012, 2.012, 0, 45], abs=1e-9)
    moves = run.toolpath.motion[-3:]
    assert tuple(moves.end[0]) == (5, 0, -5) and tuple(moves.end[2]) == (5, 0, -5)
    assert run.measured["X"] == pytest.approx(0.012) and run.measurements[0].cycle == "TCH PROBE 0"


def test_polar_as_printed():
    """16.3: a wall at X 12.05; along 30 degrees from X5 Y0 the ball touches at X 10.05, Y 5.05 tan 30."""
    run = probing(polar("X", 30, "X+5", "Y+0", "Z-5"), part.plane((12.05, 0, 0), (-1, 0, 0)))
    assert run.ok, run.alarms
    expected = [10.05, 5.05 * math.tan(math.pi / 6), 45]
    assert [run.variables[q] for q in ("Q115", "Q116", "Q117")] == pytest.approx(expected, abs=1e-9)
    assert run.toolpath.end[-1] == pytest.approx((5, 0, -5), abs=1e-9)


def test_measuring_as_printed():
    """17.2: the wall at X 6.02; the ball's centre touches at 4.02, 4.02 tan 15, then 1 mm back."""
    run = probing(at(0, 0, -5) + three(1, "X", 15, 10), part.plane((6.02, 0, 0), (-1, 0, 0)))
    assert run.ok, run.alarms
    turn = math.radians(15)
    assert four_values(run, 1) == pytest.approx([4.02, 4.02 * math.tan(turn), -3, 1], abs=1e-9)
    way = 4.02 / math.cos(turn) - 1
    assert run.toolpath.end[-1] == pytest.approx((way * math.cos(turn), way * math.sin(turn), -5), abs=1e-9)
    assert touch_of(run).feed == 100


def test_measuring_out_of_reach_goes_on():
    """No contact within 10 mm: no alarm, the fourth result is -1; 1 mm back."""
    run = probing(at(0, 0, -5) + three(1, "X", 15, 10), part.plane((30, 0, 0), (-1, 0, 0)))
    assert run.ok, run.alarms
    turn = math.radians(15)
    assert four_values(run, 1) == pytest.approx([10 * math.cos(turn), 10 * math.sin(turn), -3, -1], abs=1e-9)
    assert run.toolpath.end[-1] == pytest.approx((9 * math.cos(turn), 9 * math.sin(turn), -5), abs=1e-9)
    assert not run.measurements


@pytest.mark.parametrize(("system", "expected"), [(0, (8.5, 7, 2)), (1, (108.5, 207, -298))])
def test_measuring_in_space_as_printed(system, expected):
    """17.3: from (20, 30, 25) along (-1, -2, -2)/3 to the top at Z0: 34.5 mm; in the machine the preset is added."""
    setup = {"presets": {1: (100, 200, -300)}, "settings": {"preset": 1}, "start": (0, 0, 0)}
    run = probing(at(20, 30, 23) + four(1, (-0.5, -1, -1), 45, system=system), part.plane((0, 0, -300), (0, 0, 1)), **setup)
    assert run.ok, run.alarms
    assert four_values(run, 1) == pytest.approx([*expected, 1], abs=1e-9)
    touch = touch_of(run)
    assert np.linalg.norm(touch.end - touch.start) == pytest.approx(34.5, abs=1e-9)
    assert run.toolpath.end[-1] == pytest.approx((20, 30, 23), abs=1e-9)


def test_measuring_in_space_out_of_reach():
    run = probing(at(20, 30, 43) + four(1, (-0.5, -1, -1), 45), part.plane((0, 0, 0), (0, 0, 1)))
    assert run.ok and run.variables["Q4"] == -1
    assert run.toolpath.end[-1] == pytest.approx((20, 30, 43), abs=1e-9)


@pytest.mark.parametrize(("mode", "deflected"), [(0, True), (1, True), (1, False), (0, False)])
def test_a_stylus_that_is_deflected_at_the_start(mode, deflected):
    """ERRORMODE 0: an alarm; 1: -1 in the fourth result, and nothing moves."""
    wall = part.plane((1.0 if deflected else 6.02, 0, 0), (-1, 0, 0))
    run = probing(at(0, 0, -5) + three(1, "X", 0, 10, mode=mode), wall, start=(0, 0, 45) if deflected else (-50, 0, 0))
    if mode == 0 and deflected:
        assert "in contact before it touches" in run.alarms[0].message
    elif deflected:
        assert run.ok and run.variables["Q4"] == -1 and not [r for r in run.toolpath if r.kind == Kind.PROBE]
    else:
        assert run.ok and run.variables["Q4"] == 1


@pytest.mark.parametrize(("axis", "expected"), [("X", (0.6, 0.8, 0)), ("Y", (0, 0.6, 0.8)), ("Z", (0.8, 0, 0.6))])
def test_the_angle_counts_towards_the_next_axis(axis, expected):
    """From X towards Y, from Y towards Z, from Z towards X; a negative way goes the other way."""
    angle = math.degrees(math.atan2(0.8, 0.6))
    for way in (8, -8):
        run = probing(at(0, 0, 60) + three(1, axis, angle, way, back=0), part.plane((0, 0, -99), (0, 0, 1)))
        centre = np.array((0, 0, 62)) + np.array(expected) * way
        assert four_values(run, 1) == pytest.approx([*centre, -1], abs=1e-9)


@pytest.mark.parametrize("seed", range(24))
def test_random_walls(seed):
    """A wall square to an axis, at a random place, in a shifted and turned system: the plane in it is where it was put.

    The wall is given in the program's system; the part is the same in that of the machine.
    """
    chance = np.random.default_rng(seed)
    axis, sense, place = int(chance.integers(3)), float(chance.choice([-1, 1])), float(chance.uniform(-40, 40))
    if axis == 2:
        sense = -1.0
    ball, turn, shift = float(chance.uniform(0.5, 4)), float(chance.uniform(-170, 170)), chance.uniform(-30, 30, 3)
    angle = math.radians(turn)
    linear = np.array([(math.cos(angle), -math.sin(angle), 0), (math.sin(angle), math.cos(angle), 0), (0, 0, 1)])
    normal, point = np.zeros(3), np.zeros(3)
    normal[axis], point[axis] = -sense, place
    wall = part.plane(tuple(linear @ point + shift), tuple(linear @ normal))
    begin = chance.uniform(-5, 5, 3)
    begin[axis] = place - sense * (ball + 3)
    pole = begin - (0, 0, ball)
    shifts = "".join(f"CYCL DEF 7.{k + 1} {a}{v:+.12g}\n" for k, (a, v) in enumerate(zip("XYZ", shift)))
    before = f"CYCL DEF 7.0 NULLPUNKT\n{shifts}CYCL DEF 10.0 DREHUNG\nCYCL DEF 10.1 ROT{turn:+.12g}\n"
    places = [f"{a}{v:+.12g}" for a, v in zip("XYZ", pole)]
    far = linear @ pole + shift
    run = probing(
        before + zero(20, "XYZ"[axis] + "-+"[sense > 0], *places) + three(30, "XYZ"[axis], 0, sense * 20, back=2), wall,
        tools={7: Tool(radius=ball, length=LONG, kind="probe")}, start=tuple(far + (0, 0, LONG)),
    )  # fmt: skip
    assert run.ok, run.alarms
    assert run.variables["Q20"] == pytest.approx(place, abs=1e-6)
    centre = begin.copy()
    centre[axis] = place - sense * ball
    assert four_values(run, 30) == pytest.approx([*centre, 1], abs=1e-6)
    assert [run.variables[f"Q{115 + k}"] for k in range(3)] == pytest.approx([*centre[:2], centre[2] - ball + LONG], abs=1e-6)
    back = centre - (0, 0, ball)
    back[axis] -= sense * 2
    assert run.toolpath.end[-1] - run.toolpath.end[-2] == pytest.approx(-2 * sense * linear[:, axis], abs=1e-6)


def test_inches():
    """A wall at 1 inch: the results are inches, MB and ABST too."""
    wall = part.plane((25.4, 0, 0), (-1, 0, 0))
    text = "L X+0 Y+0 Z+0 R0 FMAX\n" + zero(5, "X+", "X+0.7", "Y+0", "Z-0.2") + three(1, "X", 0, 0.4, back=0.1, feed=4)
    run = probing(text, wall, "INCH", start=(-50, 0, 0))
    assert run.ok, run.alarms
    assert run.variables["Q5"] == pytest.approx(1, abs=1e-9)
    ball = BALL / 25.4
    assert four_values(run, 1) == pytest.approx([1 - ball, 0, -0.2 + ball, 1], abs=1e-9)
    assert run.variables["Q117"] == pytest.approx(-0.2 + LONG / 25.4, abs=1e-9)
    assert run.toolpath.end[-1][0] == pytest.approx(25.4 - BALL - 2.54, abs=1e-9)


def test_din_iso():
    wall = part.plane((0.012, 0, 0), (1, 0, 0))
    text = "%P G71 *\nN10 T7 G17 *\nN20 G55 P01 5 P02 X P03 0 X+5 Y+0 Z-5 *\nN99999999 %P G71 *\n"
    setup = Setup(part=wall, tools=TOOLS, probe=Probe(), start=(40, 0, 0))
    run = mnc.run(text, "tnc-620", setup)
    assert run.ok, run.alarms
    assert run.variables["Q5"] == pytest.approx(0.012, abs=1e-9)
    for wrong, said in (
        ("G55 P01 5 X+5", "G55 axis (probing axis and direction) is missing"),
        ("G91 G55 P01 5 P02 X P03 0 X+5", "takes absolute coordinates"),
        ("G55 P01 5 P02 A P03 0", "G55 takes P01, P02 with P03, X, Y and Z"),
    ):  # fmt: skip
        other = mnc.run(f"%P G71 *\nN10 T7 G17 *\nN20 {wrong} *\nN99999999 %P G71 *\n", "tnc-620", setup)
        assert said in other.alarms[0].message, other.alarms
        assert other.alarms[0].span.line == 3


def test_an_offset_of_the_ball_is_corrected():
    """CAL_OF1 = 0.3: the ball touches where it must, the spindle stands 0.3 beside it."""
    wall = part.plane((20, 0, 0), (-1, 0, 0))
    run = probing(zero(5, "X+", "X+12", "Y+1", "Z-5"), wall, probe=Probe(offset=(0.3, -0.1)), start=(-50, 0, 0))
    assert run.ok, run.alarms
    assert [run.variables[q] for q in ("Q5", "Q115", "Q116")] == pytest.approx([20, 17.7, 1.1], abs=1e-9)
    assert run.toolpath.end[-1] == pytest.approx((11.7, 1.1, -5), abs=1e-9)


REFUSED = [
    ("TCH PROBE 0.0 X\nTCH PROBE 0.1 X+1\n", 3, "Q and the number of the result parameter"),
    ("TCH PROBE 0.0 X Q5\nTCH PROBE 0.1 X+1\n", 3, "the probing axis and its sense stand here"),
    ("TCH PROBE 0.0 X Q5 A+\nTCH PROBE 0.1 X+1\n", 3, "the probing axis and its sense stand here"),
    ("TCH PROBE 0.0 X Q5 X+\nTCH PROBE 0.1 IX+1\n", 4, "only X, Y and Z of the pre-position"),
    ("TCH PROBE 0.0 X Q2000 X+\nTCH PROBE 0.1 X+1\n", 3, "TCH PROBE 0 Q (Q parameter of the result) must be a whole number and"),
    ("TCH PROBE 1.0 X\nTCH PROBE 1.1 A ANGLE: 5\nTCH PROBE 1.2 X+1\n", 4, "the probing axis stands here"),
    ("TCH PROBE 1.0 X\nTCH PROBE 1.1 X ANGLE: 181\nTCH PROBE 1.2 X+1\n", 4, "must be at least -180 and at most 180, got 181"),
    ("TCH PROBE 1.0 X\nTCH PROBE 1.1 X\nTCH PROBE 1.2 X+1\n", 4, "a number is missing: the probing angle"),
    ("TCH PROBE 1.0 X\nTCH PROBE 1.2 X+1\n", 3, "TCH PROBE 1 axis (probing axis) is missing"),
    (three(1997, "X", 0, 5), 4, "TCH PROBE 3 Q (first Q parameter of the results) must be at most 1996, got 1997"),
    (three(105, "X", 0, 5), 4, "cannot be Q108: radius of the active tool with its deltas, kept by the control"),
    (zero(108, "X+", "X+5"), 3, "TCH PROBE 0 Q (Q parameter of the result) cannot be Q108"),
    (three(1, "X", 0, 0), 6, "TCH PROBE 3 ABST (farthest way) must not be 0"),
    (three(1, "X", 0, 5, feed=0), 6, "TCH PROBE 3 F (feed of the touch) must be greater than 0"),
    (three(1, "X", 0, 5, feed=3001), 6, "must be at least 0 and at most 3000, got 3001"),
    (three(1, "X", 0, 5, system=2), 6, "must be one of 0, 1, got 2"),
    (three(1, "X", 0, 5, mode=2), 7, "must be one of 0, 1, got 2"),
    (four(1, (0, 0, 0), 5), 5, "TCH PROBE 4 IX (direction, X) must not be 0 with IY and IZ"),
    ("CYCL DEF 11.0 X\nCYCL DEF 11.1 SCL 2\n" + four(1, (0, 0, -1), 5), 5, "TCH PROBE 4 cannot run under a scale"),
    (zero(5, "X+", "X+5"), 3, "touch point inaccessible: the probe did not trigger within 10 mm"),
    ("TOOL CALL 1 Z\n" + zero(5, "X+", "X+5"), 4, "TCH PROBE 0 needs a touch probe in the spindle, T1 is a mill"),
]


@pytest.mark.parametrize(("text", "line", "said"), REFUSED)
def test_refused(text, line, said):
    run = probing(text, part.plane((200, 0, 0), (-1, 0, 0)), tools={**TOOLS, 1: Tool(radius=3, kind="mill")})
    alarm = run.alarms[0]
    assert said in alarm.message and alarm.span.line == line and alarm.severity == "alarm", run.alarms


def test_a_name_in_front_is_free_and_words_in_it_are_told():
    text = "TCH PROBE 3.0 MESURE X+5\n" + "".join(three(1, "Z", 0, -5).splitlines(True)[1:])
    run = probing(text, part.plane((0, 0, -3), (0, 0, 1)))
    assert [a.message for a in run.alarms] == ["X+5 is read as part of the cycle's name and not obeyed"]

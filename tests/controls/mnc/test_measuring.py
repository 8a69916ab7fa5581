"""Measuring cycles and single touches of the MNC (12.13 to 12.23): the catalogue's checks, and random parts in closed form.

Checks: tests/authorities/catalogue/mnc-probing.json; x and y are those of the ball's centre, z of its lowest point.
"""

import math
import re

import numpy as np
import pytest
from controls.mnc.probing_mnc import (
    DATUM,
    PROBE,
    at,
    box,
    disc,
    examples,
    feature,
    measured,
    near,
    probes,
    to_round,
    to_wall,
    walls,
)
from tools.probed import gaps

import mnclab
from mnclab import Kind, Probe, Setup, Tool
from mnclab.workpiece import part as parts

HERE = (*(f"G{n}" for n in range(420, 427)), "G490", "G491", "G492", "G499")
EXAMPLES = [each for each in examples(*HERE) if "error" not in each["check"]]
WAYS = {"+X": (1, 0, 0), "-X": (-1, 0, 0), "+Y": (0, 1, 0), "-Y": (0, -1, 0), "-Z": (0, 0, -1)}
KINDS = {"position": Kind.LINE, "measure": Kind.PROBE, "rapid": Kind.RAPID}
BALL = 3
#: The words of a status in the stop's message, and of its feature.
STATUS = {"too_large": "is too large", "too_small": "is too small", "center": "is off"}


def status(run):
    """What the values and limits of the record say, in the words of the catalogue."""
    found = []
    for row in run.measurements.outside:
        axis = f"_{row.what[-1].lower()}" if row.what[-1] in "XY" else ""
        size = "too_large" if row.actual > row.upper else "too_small"
        found.append(("center" if row.what.startswith("centre") else size) + axis)
    return found or ["ok"]


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda each: f"{each['code']} {each['title']}")
def test_an_example_of_the_catalogue(example):
    check, text = dict(example["check"]), example["program"]
    part = feature(check.pop("workpiece")[0])
    run = measured(text, part, before="")
    rows = run.toolpath.motion[1:]
    moves = check.pop("moves", [])
    assert not moves or len(rows) == len(moves)
    for row, move in zip(rows, moves):
        assert row.kind == KINDS[move["move"]]
        assert row.end == near([move[axis] for axis in "xyz"])
        assert row.feed == move.get("feed", {"position": 2000, "measure": 200, "rapid": math.inf}[move["move"]])
    touches = check.pop("touches", [])
    assert not touches or len(run.touches) == len(touches)
    for row, touch, expected in zip(probes(run), run.touches, touches):
        assert row.start[:2] == near([*expected["from"].values()])
        assert (row.end - row.start) / np.linalg.norm(row.end - row.start) == pytest.approx(WAYS[expected["dir"]], abs=1e-12)
        assert np.linalg.norm(row.end - row.start) == near(expected["travel"])
        assert touch.programmed[:2] == near([*expected["ball"].values()])
    results = check.pop("results", {})
    for each in results if isinstance(results, list) else [results]:  # of a block, or of the last one
        step = next((n for n, block in enumerate(text.splitlines()) if block.startswith(each.get("block", "?"))), -1)
        for name in each.keys() - {"block"}:
            assert run.history[name][step] == near(each[name])
    message = check.pop("message", None)
    if message:
        assert not run.ok and message in run.alarms[0].message and check.pop("stop")
        return
    assert run.ok
    if "status" in check:
        assert status(run) == check.pop("status")
    stop = check.pop("stop", False)
    assert stop == any(run.toolpath.kind == Kind.STOP) == bool(run.alarms)
    assert bool(run.files) == check.pop("protocol", "M1" in text)
    assert not check
    assert gaps(run, part.placed(at(DATUM)), BALL).min() > -1e-6


@pytest.mark.parametrize("example", [e for e in EXAMPLES if "workpiece" in e["check"]], ids=lambda e: f"{e['code']} {e['title']}")
def test_an_example_measures_with_the_probe_that_every_setup_has(example):
    """Whose longest way is half of the 20 that the checks adopt: each touch meets what it met with that."""
    part = feature(example["check"]["workpiece"][0])
    one, other = (measured(example["program"], part, before="", probe=probe) for probe in (Probe(), PROBE))
    assert len(one.touches) == len(other.touches)
    for mine, expected in zip(one.touches, other.touches):
        assert np.array(mine.programmed) == near(np.array(expected.programmed))
    assert [str(alarm) for alarm in one.alarms] == [str(alarm) for alarm in other.alarms]


def test_a_ridge_between_points_that_are_farther_apart_than_it_is_wide():
    """60 apart about a ridge of 45, all of the difference on one side: 15 + clearance 2 to the wall, more than the 10 of the
    default probe. The like of TNC 620 16.10."""
    text = "G426 X40 Y85 U40 V25 L2 D45 Z-5 H20\n"
    run = measured(text, box((40, 47.5), (200, 45)), probe=Probe())
    assert run.ok and (run.variables["Q312"], run.variables["Q313"]) == pytest.approx((47.5, 45), abs=1e-9)


def test_two_directions_are_refused():
    """The second example of G499."""
    (example,) = (each for each in examples("G499") if "error" in each["check"])
    alarm = measured(example["program"], None, before="").alarms[0]
    assert alarm.message == "G499 Z (direction along Z) must be 0: G499 measures along one axis, and X has a direction"
    assert alarm.span[:2] == (3, 13)


def test_the_protocol_of_a_bore():
    """The first example of G421: its numbers, line by line; four decimals (MNC-PROT-FORMAT)."""
    example = next(each for each in EXAMPLES if each["code"] == "G421")
    run = measured(example["program"], feature(example["check"]["workpiece"][0]), before="")
    expected = """cycle = G421
program = program
block = N30
tool = 20
centre X nominal = 10.0000
centre X measured = 10.0200
centre X deviation = 0.0200
centre X least = 9.9500
centre X greatest = 10.0500
centre Y nominal = -5.0000
centre Y measured = -4.9700
centre Y deviation = 0.0300
centre Y least = -5.0500
centre Y greatest = -4.9500
diameter nominal = 30.0000
diameter measured = 30.0400
diameter deviation = 0.0400
diameter least = 29.9800
diameter greatest = 30.0300
status = too_large
"""
    assert run.files == {"meas_prot/G421_0001.txt": expected}
    assert run.alarms[0].message == "G421 diameter 30.0400 is too large, the limit is 30.0300: the program stops"


def test_files_have_running_numbers():
    """One number for the whole folder; a slot without D has no nominal width, and no Q239."""
    slot = "G425 X50 Y20 L1 Z-8 H20 M1\n"
    run = measured(slot * 2 + slot.replace("M1", "D20 M1"), box((50, 20), (20.5, 90), inside=False))
    assert [*run.files] == [f"meas_prot/G425_000{n}.txt" for n in (1, 2, 3)]
    assert "width nominal" not in run.files["meas_prot/G425_0001.txt"]
    assert "width nominal = 20.0000\nwidth measured = 20.5000\n" in run.files["meas_prot/G425_0003.txt"]
    assert run.history["Q239"][3] is None and run.variables["Q239"] == pytest.approx(0.5, abs=1e-9)


# --- random parts -----------------------------------------------------------------------------------------------------


class Draw:
    """Random numbers with three decimals, and a machine of its own: ball, clearance, heights, datum, base rotation."""

    def __init__(self, seed):
        self.random = np.random.default_rng(seed)
        self.ball, self.clearance, self.extra = self(1, 3), self(1, 3), self(0, 3)
        self.level, self.height, self.over = self(-20, -8), self(5, 30), int(self.random.integers(2))
        self.datum, self.turned = (self(-50, 50), self(-50, 50), self(-450, -350)), self(-40, 40) if seed % 3 else 0.0
        self.centre = np.array((self(-40, 40), self(-40, 40)))

    def __call__(self, least, greatest):
        return round(float(self.random.uniform(least, greatest)), 3)

    @property
    def away(self):
        return self.ball + self.clearance + self.extra

    def run(self, block, part, then=(7, -3), **more):
        """The cycle, then a move; `part` in program coordinates. The base rotation turns the machine's axes."""
        place, probe = at(self.datum, self.turned), Probe(clearance=self.clearance, reach=20, feed=200, rapid=2000)
        start = tuple((place @ (*self.centre, 60 + 150, 1))[:3])  # of the spindle; the probe is 150 mm long
        before = f"N10 T20\nG54\nG404 E{self.turned}\nG90 G0 X{self.centre[0]} Y{self.centre[1]} Z60\n"
        text = f"{before}{block}\nG0 X{then[0]} Y{then[1]}\n"
        run = measured(text, part, self.ball, "", place, datums={1: self.datum}, probe=probe, start=start, **more)
        assert run.ok, run.alarms
        self.part = part.placed(place)
        self.inverse = np.linalg.inv(place)
        ends = (run.toolpath.motion.end + run.toolpath.origin) @ self.inverse[:3, :3].T + self.inverse[:3, 3]
        assert ends[-1] == pytest.approx((*then, ends[-2][2]), abs=1e-9)
        assert gaps(run, self.part, self.ball).min() > -1e-6
        return run, ends

    @property
    def words(self):
        return f"Q{self.extra} Z{self.level} H{self.height}"


def found(run, **expected):
    for name, value in expected.items():
        assert run.variables[name] == pytest.approx(value, abs=1e-7 if name == "Q319" else 1e-6), name


SEEDS = range(24)


@pytest.mark.parametrize("seed", SEEDS)
def test_an_angle(seed):
    """t = ((s - q) n - r) / (-d n) at both points; the angle of the line through both ball centres."""
    draw = Draw(seed)
    k, sense = seed % 2, (-1, 1)[seed // 2 % 2]
    angle = math.degrees(math.atan((draw.clearance + draw.extra) / 36)) * draw(-0.9, 0.9)
    way = np.array((sense, 0) if k == 0 else (0, sense))
    wall = walls(draw.centre, (120, 100), angle)[("-" if sense > 0 else "+") + "XY"[k]]
    half = 60 if k == 0 else 50
    base, along = draw.centre - half * way, np.array((0, 1) if k == 0 else (1, 0))
    points = [base + share * along for share in (draw(-35, -15), draw(15, 35))][:: 1 if seed % 5 else -1]
    (x, y), (u, v) = points
    text = f"G420 X{x:.6f} Y{y:.6f} U{u:.6f} V{v:.6f} L{k + 1} K{sense} {draw.words} P{draw.over}"
    run, ends = draw.run(text, box(draw.centre, (120, 100), angle))
    balls = [to_wall(point - draw.away * way, way, wall, draw.ball) for point in np.round(points, 6)]
    dx, dy = balls[1] - balls[0]
    expected = math.degrees(math.atan(dy / dx)) if k else 90 - math.degrees(math.atan(dx / dy))
    found(run, Q319=expected)
    assert ends[-2] == pytest.approx((*(np.round(points[1], 6) - draw.away * way), draw.height), abs=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("code", ["G421", "G422"])
def test_bores_and_bosses(code, seed):
    """A true circle: centre and diameter are its own; each ball stands where |s + t d - c| = D/2 -+ r."""
    draw = Draw(seed)
    inside, size = code == "G421", draw(8, 60)
    (x, y), dx, dy = draw.centre, draw(-0.5, 0.5), draw(-0.5, 0.5)
    actual = size + draw(-0.4, 0.4)
    run, ends = draw.run(f"{code} X{x} Y{y} D{size} {draw.words} P{draw.over}", disc((x + dx, y + dy), actual, 0, not inside))
    found(run, Q314=x + dx, Q315=y + dy, Q318=actual, Q234=dx, Q235=dy, Q236=actual - size)
    room = size / 2 - draw.away if inside else size / 2 + draw.away
    for touch, way in zip(run.touches, ((1, 0), (-1, 0), (0, 1), (0, -1)), strict=True):
        start = (x + max(room, 0) * way[0], y + max(room, 0) * way[1])
        way = way if inside else (-way[0], -way[1])
        expected = to_round(start, way, (x + dx, y + dy), actual / 2, draw.ball, not inside)
        assert touch.programmed == pytest.approx((*expected, draw.level), abs=1e-6)
    assert ends[-2] == pytest.approx((x, y - max(room, 0), draw.height), abs=1e-6)
    (figure,) = run.figures
    assert figure.actual.area == pytest.approx(math.pi * actual**2 / 4, rel=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("code", ["G423", "G424"])
def test_rectangles(code, seed):
    """Turned by up to a degree: each ball by the formula of a wall, lengths and middles between opposite ones."""
    draw = Draw(seed)
    inside, a, b = code == "G423", draw(9, 70), draw(9, 70)
    (x, y), off = draw.centre, np.array((draw(-0.3, 0.3), draw(-0.3, 0.3)))
    size, angle = (a + draw(-0.2, 0.2), b + draw(-0.2, 0.2)), draw(-0.3, 0.3) if seed % 2 else 0.0
    run, ends = draw.run(
        f"{code} X{x} Y{y} A{a} B{b} {draw.words} P{draw.over}", box((x, y) + off, size, angle, 0, not inside)
    )  # fmt: skip
    sides, balls = walls((x, y) + off, size, angle), []
    from_centre = inside and min(a, b) / 2 <= draw.away
    for way in WAYS:
        if way == "-Z":
            continue
        outward, half = np.array(WAYS[way][:2]), (a if "X" in way else b) / 2
        room = 0 if from_centre else half - draw.away if inside else half + draw.away
        point, normal = sides[way]
        direction = outward if inside else -outward
        balls.append(to_wall((x, y) + room * outward, direction, (point, -normal if inside else normal), draw.ball))
    more = 2 * draw.ball if inside else -2 * draw.ball
    cx, cy = (balls[0][0] + balls[1][0]) / 2, (balls[2][1] + balls[3][1]) / 2
    length, width = balls[0][0] - balls[1][0] + more, balls[2][1] - balls[3][1] + more
    found(run, Q314=cx, Q315=cy, Q316=length, Q317=width, Q234=cx - x, Q235=cy - y, Q237=length - a, Q238=width - b)
    assert [row.what for row in run.measurements] == ["centre X", "centre Y", "length X", "length Y"]


@pytest.mark.parametrize("seed", SEEDS)
def test_slots(seed):
    """Without room, or without D, both touches begin in the starting point; W shifts the second one along the slot."""
    draw = Draw(seed)
    k, size, angle = seed % 2, draw(9, 50), draw(-1, 1)
    (x, y), off, shift, actual = draw.centre, draw(-0.3, 0.3), draw(-10, 10), size + draw(-0.3, 0.3)
    along, across = (np.array((1, 0)), np.array((0, 1)))[:: 1 if k == 0 else -1]
    centre = (x, y) + off * along
    given = "" if seed % 4 == 3 and size < 30 else f"D{size} "
    lengths = (actual, 200) if k == 0 else (200, actual)
    text = f"G425 X{x} Y{y} W{shift} L{k + 1} {given}{draw.words} P{draw.over}"
    run, ends = draw.run(text, box(centre, lengths, angle, 0, False))
    room = max(size / 2 - draw.away, 0) if given else 0
    sides, balls = walls(centre, lengths, angle), []
    for sense, more in ((1, 0), (-1, shift)):
        point, normal = sides["+-"[sense < 0] + "XY"[k]]
        balls.append(to_wall((x, y) + sense * room * along + more * across, sense * along, (point, -normal), draw.ball)[k])
    middle, width = (balls[0] + balls[1]) / 2, balls[0] - balls[1] + 2 * draw.ball
    found(run, Q312=middle, Q313=width, **({"Q239": width - size} if given else {}))
    assert given or "Q239" not in run.variables
    assert ends[-2] == pytest.approx((*((x, y) - room * along + shift * across), draw.height), abs=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
def test_ridges(seed):
    """The first touch is on the positive side; between both the probe goes over the safe height."""
    draw = Draw(seed)
    k, size, angle = seed % 2, draw(5, 50), draw(-1, 1)
    centre, actual = draw.centre + (draw(-0.3, 0.3), draw(-0.3, 0.3)), size + draw(-0.3, 0.3)
    along, across = (np.array((1, 0)), np.array((0, 1)))[:: 1 if k == 0 else -1]
    first, second = (draw.centre + sense * size / 2 * along + draw(-15, 15) * across for sense in (1, -1))
    lengths = (actual, 200) if k == 0 else (200, actual)
    text = f"G426 X{first[0]:.6f} Y{first[1]:.6f} U{second[0]:.6f} V{second[1]:.6f} L{k + 1} D{size} {draw.words}"
    run, ends = draw.run(text, box(centre, lengths, angle))
    sides, balls = walls(centre, lengths, angle), []
    for sense, point in ((1, np.round(first, 6)), (-1, np.round(second, 6))):
        wall = sides["+-"[sense < 0] + "XY"[k]]
        balls.append(to_wall(point + sense * draw.away * along, -sense * along, wall, draw.ball)[k])
    middle, width = (balls[0] + balls[1]) / 2, balls[0] - balls[1] - 2 * draw.ball
    found(run, Q312=middle, Q313=width, Q239=width - size)
    starts = np.array([each.start for each in probes(run)])
    highest = [row for row in run.toolpath.motion if row.kind == Kind.LINE and math.dist(row.start[:2], row.end[:2]) > size]
    assert len(starts) == 2 and all(row.start[2] == row.end[2] for row in highest)


@pytest.mark.parametrize("seed", SEEDS)
def test_single_touches_of_a_plane(seed):
    """A plane through q with the normal n: the ball stops at t = ((s - q) n - r) / (-u n) along the unit vector u."""
    draw = Draw(seed)
    code = ("G499", "G491", "G492")[seed % 3]
    axis, sense = seed // 3 % 3, (-1, 1)[seed // 9 % 2]
    if code == "G499":
        way = sense * np.eye(3)[axis]
        text, reach = f"G499 X{way[0]:g} Y{way[1]:g} Z{way[2]:g}", 20
    elif code == "G491":
        angle, reach = draw(-180, 180), draw(12, 30)
        cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        way = sense * np.array([(cos, sin, 0), (0, cos, sin), (sin, 0, cos)][axis])
        text = f"G491 L{axis + 1} E{angle} P{sense * reach} Q{draw.extra + 0.5} F123"
    else:
        vector, reach = np.array([draw(-5, 5) for _ in range(3)]), draw(12, 30)
        way = sense * vector / np.linalg.norm(vector)
        text = f"G492 X{vector[0]} Y{vector[1]} Z{vector[2]} P{sense * reach} Q{draw.extra + 0.5} F123"
    tilt = draw.random.normal(size=3) * 0.3
    normal = -way + tilt
    normal /= np.linalg.norm(normal)
    start = np.array((*draw.centre, 60.0))
    ball = start + (0, 0, draw.ball)
    travel = draw(2, 11)
    point = ball + travel * way - draw.ball * normal  # where the ball then touches
    home = f"\nG0 X{draw.centre[0]} Y{draw.centre[1]} Z60"
    run, ends = draw.run(text + home, parts.plane(point, normal), draw.centre + (1, 0))
    touch = probes(run)[0]
    assert np.linalg.norm(touch.end - touch.start) == pytest.approx(travel, abs=1e-6)
    tip, back = start + travel * way, int(np.flatnonzero(run.toolpath.motion.kind == Kind.PROBE)[0]) + 1
    if code == "G499":
        found(run, Q312=(tip + (0, 0, draw.ball))[axis] + sense * draw.ball)
        assert ends[back] == pytest.approx(start, abs=1e-6) and touch.feed == 200
    else:
        found(run, Q314=tip[0], Q315=tip[1], Q312=tip[2])
        assert ends[back] == pytest.approx(tip - min(draw.extra + 0.5, travel) * way, abs=1e-6)
        assert touch.feed == 123 and run.toolpath.motion[back].kind == Kind.RAPID


@pytest.mark.parametrize("seed", range(20))
def test_guarded_positioning(seed):
    """Free under G90 and G91; against a wall the ball stops r before it, and the program ends there."""
    draw = Draw(seed)
    x, y, z = draw(-30, 30), draw(-30, 30), draw(-30, 30)
    wall = parts.plane((200, 0, 0), (-1, 0, 0))
    run, ends = draw.run(f"G91\nG490 X{x} Y{y} Z{z}\nG90", wall)
    assert ends[-2] == pytest.approx((*(draw.centre + (x, y)), 60 + z), abs=1e-9)
    run = measured(f"G490 X{150 + x} Y{y} Z{z}\nG1 X0 F100\n", parts.plane((100, 0, 0), (-1, 0, 0)), draw.ball)
    share = (100 - draw.ball) / (150 + x)
    assert not run.ok and "path obstructed: the stylus touches the part" in run.alarms[0].message
    assert run.alarms[0].span.line == 3
    assert run.toolpath.end[-1] == pytest.approx((100 - draw.ball, y * share, 50 + (z - 50) * share), abs=1e-4)


# --- limits -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(20))
def test_limits_are_compared_as_they_are_written(seed):
    """A size on its limit is within; R and T of 0 are not checked. The stop is a row, a warning names feature, value, limit."""
    draw = Draw(seed)
    actual, most, least = 30 + draw(-0.05, 0.05), 30 + draw(-0.04, 0.05), 30 - draw(-0.04, 0.05)
    least, most = sorted((least, most))
    limits = {"R": most, "T": least, "U": draw(0, 0.05), "V": draw(0, 0.05)}
    for letter in "RTUV":
        if draw(0, 1) < 0.2:
            limits[letter] = (0, actual)[letter in "RT" and draw(0, 1) < 0.5]
    if limits["R"] and limits["T"] > limits["R"]:
        limits["T"] = 0
    dx, dy = draw(-0.05, 0.05), draw(-0.05, 0.05)
    words = " ".join(f"{letter}{value:.9f}" for letter, value in limits.items())
    run = measured(f"G421 X10 Y-5 D30 Z-8 H20 {words} L1 E{seed % 2}\n", disc((10 + dx, -5 + dy), actual, inside=False))
    beyond = {
        "center_x": limits["U"] and abs(dx) > limits["U"] + 1e-6, "center_y": limits["V"] and abs(dy) > limits["V"] + 1e-6,
        "too_large": limits["R"] and actual > limits["R"] + 1e-6, "too_small": limits["T"] and actual < limits["T"] - 1e-6,
    }  # fmt: skip
    expected = [name for name in beyond if beyond[name]]
    text = run.files["meas_prot/G421_0001.txt"]
    assert re.search(r"^status = (.*)$", text, re.M)[1] == (" ".join(expected) or "ok")
    assert status(run) == (expected or ["ok"])
    stops = bool(expected) and seed % 2 == 1
    assert (Kind.STOP in run.toolpath.kind) == stops == bool(run.alarms) and run.ok
    if stops:
        message = run.alarms[0].message
        for name in expected:
            assert next(words for key, words in STATUS.items() if name.startswith(key)) in message


# --- settings ---------------------------------------------------------------------------------------------------------

BLOCK = parts.box((0.21, -50, -60), (100, 110, 0))


def test_measurements_per_point():
    """Three touches from X -10, and back after each; with a probe that spreads the mean of the three."""
    program = "G490 X-10 Y30\nG490 Z-11\nG499 X1\n"
    settings = {"measurements_per_point": 3}
    run = measured(program, BLOCK, settings=settings)
    assert [row.end[0] for row in run.toolpath.motion[-6:]] == pytest.approx([-2.79, -10] * 3, abs=1e-9)
    assert run.variables["Q312"] == pytest.approx(0.21, abs=1e-9)
    run = measured(program, BLOCK, settings=settings, probe=Probe(clearance=2, reach=20, spread=0.01, seed=4))
    stops = probes(run).end[:, 0]
    assert np.ptp(stops) > 0.001 and run.variables["Q312"] == pytest.approx(stops.mean() + 3, abs=1e-9)


@pytest.mark.parametrize(("value", "way"), [("YZ", (0, 0.6, 0.8)), ("XY", (-0.8, 0.6, 0))])
def test_the_plane_of_an_angle_to_y(value, way):
    """cos E = 0.6, sin E = 0.8: towards +Z, or counter-clockwise in XY (MNC-G491-PLANE)."""
    angle = math.degrees(math.atan2(0.8, 0.6))
    point = np.array((0, 0, 53)) + 8 * np.array(way)  # the ball stops 3 before it
    run = measured(f"G491 L2 E{angle:.9f} P20 Q1\n", parts.plane(point, -np.array(way)), settings={"g491_l2_plane": value})
    touch = probes(run)[0]
    assert touch.end - touch.start == pytest.approx(5 * np.array(way), abs=1e-6)


@pytest.mark.parametrize(("value", "z"), [("tip", 0.137 + 0.2), ("reference", 0.137 + 150 + 0.2)])
def test_raw_z(value, z):
    """A probe of 150 with a correction of 0.2: the length counts and the correction not, or neither (MNC-G492-RAW)."""
    tools = {20: Tool(radius=3, length=150, dl=0.2, kind="probe")}
    run = measured("G0 Z5\nG492 Z-1 P20 Q2 W0\n", parts.plane((0, 0, 0.137), (0, 0, 1)), tools=tools, settings={"raw_z": value})
    assert run.variables["Q312"] == pytest.approx(z, abs=1e-9)


def test_an_offset_of_the_table_does_not_count_in_a_raw_touch():
    """G499 finds the wall with the offset, G492 gives the spindle axis (MNC-PROBE-OFFPOS, MNC-G492-RAW)."""
    probe = Probe(clearance=2, reach=20, feed=200, rapid=2000, offset=(0.5, 0.25))
    program = "G490 X-10 Y30\nG490 Z-11\nG499 X1\nG492 X1 P20 Q2\n"
    run = measured(program, BLOCK, probe=probe)
    assert run.variables["Q312"] == -11 and run.history["Q312"][-2] == pytest.approx(0.21, abs=1e-9)
    assert (run.variables["Q314"], run.variables["Q315"]) == pytest.approx((-2.79 - 0.5, 30), abs=1e-9)


# --- what the machine refuses -----------------------------------------------------------------------------------------

BORE = "G421 X10 Y-5 D30 Z-8 H20\n"
REFUSED = {
    "no part": (BORE, None, {}, "there is no part to touch"),
    "no contact": (BORE, box((10, -5), (90, 90), inside=False), {}, "inaccessible: the probe did not trigger within 20 mm"),
    "in the way": (BORE, disc((13, -5), 30, inside=False), {}, "path obstructed: the stylus touches the part"),
    "stem": (BORE, disc((10, -5), 30, inside=False) | parts.box((5, -20, 5), (26, 10, 6)),
             {"probe": Probe(clearance=2, reach=20, stem=2.0, stem_length=60)}, "path obstructed"),
    "a single touch in the air": ("G492 X1 P7 Q2\n", parts.plane((60, 0, 0), (-1, 0, 0)), {}, "did not trigger within 7 mm"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_the_machine_refuses(name):
    program, part, more, message = REFUSED[name]
    run = measured(program, part, **more)
    assert not run.ok and message in run.alarms[0].message
    assert run.alarms[0].span[:2] == (len(program.splitlines()) + 2, 1)


def test_a_scale_does_not_change_the_ball():
    """G490 under G37 X2: the ball of 3 stops at X 97 of the machine's axes, which is X 48.5 of the program."""
    run = measured("G37 X2 Y2 Z1\nG490 X60\n", parts.plane((100, 0, 0), (-1, 0, 0)), before="T20\nG54 G0 X0 Y0 Z50\n")
    assert "path obstructed" in run.alarms[0].message and run.toolpath.end[-1][0] == pytest.approx(97, abs=1e-4)


@pytest.mark.parametrize("code", ["G421", "G423"])
def test_measuring_under_a_rotation(code):
    """G39 turns the program by 30 degrees: the figure that lies along its axes has its own place and sizes there."""
    centre = 12.03, 4.98
    words, figure = ("D30", disc(centre, 30.02, inside=False))
    if code == "G423":
        words, figure = ("A40 B30", box(centre, (40.02, 29.97), inside=False))
    part = figure.placed(at((0, 0, 0), 30))
    run = measured(f"G39 A30\nG0 X12 Y5\n{code} X12 Y5 {words} Z-8 H20 P1\n", part)
    assert run.ok, run.alarms
    expected = {"Q314": 12.03, "Q315": 4.98} | ({"Q318": 30.02} if code == "G421" else {"Q316": 40.02, "Q317": 29.97})
    found(run, **expected)


def test_what_was_cut_is_measured():
    """A pocket of diameter 30 that the program has milled: exactly that."""
    mill = Tool(radius=5, length=100, kind="mill", plunge_angle=3, centre_cutting=True)
    setup = Setup(
        tools={1: mill, 20: Tool(radius=3, length=150, kind="probe")}, datums={1: DATUM}, part="cut",
        stock=((270, 170, -430), (330, 230, -400)), probe=Probe(clearance=2, reach=20),
    )  # fmt: skip
    text = "T1 S2000 M3\nG54 G90 G0 X0 Y0 Z50\nG344 M0 D30 Z0 H-12 P6 Q2 I5 K1 J0 F500 V150 L1 T500\nG0 Z50 M5\nT20\n"
    run = mnclab.run(f"{text}G421 X0 Y0 D30 Z-5 H20\n", "mnc", setup)
    assert run.ok, run.alarms
    found(run, Q314=0, Q315=0, Q318=30)

"""The misalignment cycles against random parts: place, turn, size, ball, approach; what they find is plain arithmetic.

All coordinates are those of the program; a ball that moves along a unit vector d from S touches a line (or plane) through E with
the outward normal n where (S + s d - E) n = r, its center then stands in S + s d.
"""

import math

import numpy as np
import pytest
from controls.tnc_620.alignment import PRESET, cycle, run, studs
from controls.tnc_620.alignment import bored as drilled
from tools.probed import gaps

from mnclab import Datum
from mnclab.geometry import frames
from mnclab.workpiece.part import box, plane

SEEDS = range(20)
ANGLE = 1e-7
LENGTH = 1e-6
WAYS = {1: (1.0, 0.0), -1: (-1.0, 0.0), 2: (0.0, 1.0), -2: (0.0, -1.0)}


def turned(degrees):
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array([[cos, -sin], [sin, cos]])


def reduced(angle, whole=360):
    rest = math.remainder(angle, whole)
    return whole / 2 if rest <= -whole / 2 else rest


def clear(found, part, ball, after=0):
    """No row of the cycle that positions goes through the part; `after` rows behind it are not the cycle's."""
    rows = gaps(found, part, ball)
    assert (rows[: len(rows) - after] > -1e-6).all()


class Edge:
    """A side of a random box: two nominal places near it, the way to them, and where the ball is stopped."""

    def __init__(self, seed, most=8.0):
        draw = np.random.default_rng(seed).uniform
        self.number = (1, -1, 2, -2)[seed % 4]
        self.way = np.array(WAYS[self.number])
        self.turn, self.ball, self.clearance = draw(-most, most), draw(0.5, 3), draw(0, 1.5)
        long, wide = draw(60, 120), draw(60, 90)
        self.corner = draw(-40, 40, 2)
        there = frames.shift(*self.corner) @ frames.turn(math.radians(self.turn))
        self.part = box((0, 0, -40), (long, wide, 0)).placed(there)
        on, along = {
            1: ((0, 0), (0, 1)), -1: ((long, 0), (0, 1)), 2: ((0, 0), (1, 0)), -2: ((0, wide), (1, 0)),
        }[self.number]  # fmt: skip
        self.through = self.corner + turned(self.turn) @ on
        self.along = turned(self.turn) @ along
        self.normal = turned(self.turn) @ -self.way
        distances = sorted(draw(8, 50, 2)) if seed % 3 else sorted(draw(8, 50, 2), reverse=True)
        shares = [distances[0], distances[1] + (6 if distances[1] > distances[0] else -6)]
        self.places = np.array([self.through + self.along * s + self.way * draw(-1, 1) for s in shares])
        self.line = math.degrees(math.atan2(*(self.along * math.copysign(1, shares[1] - shares[0]))[::-1]))
        self.nominal = math.degrees(math.atan2(*(self.places[1] - self.places[0])[::-1]))

    def touched(self, k):
        """The point of place k as the cycles take it: the ball's center and its radius along the way."""
        start = self.places[k] - self.way * (self.ball + 2 + self.clearance)
        s = (self.ball - (start - self.through) @ self.normal) / (self.way @ self.normal)
        return start + self.way * (s + self.ball)

    def run(self, number, values, after="", rotation=0.0, **more):
        preset = Datum(*PRESET, rotation=rotation)
        there = frames.shift(*PRESET) @ frames.turn(math.radians(rotation))
        placed = self.part.placed(there)
        found = run(cycle(number, values) + after, placed, presets={1: preset}, ball=self.ball, reach=12, **more)
        assert not [a for a in found.alarms if a.severity == "alarm"], found.alarms
        clear(found, placed, self.ball, after.count("\n"))
        return found

    def two_points(self):
        (x, y), (x2, y2) = self.places.tolist()
        return {
            "Q263": x, "Q264": y, "Q265": x2, "Q266": y2, "Q272": abs(self.number), "Q267": int(math.copysign(1, self.number)),
            "Q261": -12, "Q320": self.clearance, "Q260": 15,
        }  # fmt: skip


@pytest.mark.parametrize("seed", SEEDS)
def test_400(seed):
    edge = Edge(seed)
    reference = [0, 90, 33.3, -120][seed % 4]
    values = edge.two_points() | {"Q301": seed % 2, "Q307": reference, "Q305": (0, 1)[seed // 2 % 2]}
    found = edge.run(400, values, "\nL X+30 Y-20 Z+70 R0 FMAX")
    expected = reduced(edge.line - reference, 180)
    assert found.tables.presets[1].rotation == pytest.approx(expected, abs=ANGLE)
    assert found.toolpath.end[-1][:2] == pytest.approx(turned(expected) @ (30, -20), abs=LENGTH)


@pytest.mark.parametrize("seed", SEEDS)
def test_403(seed):
    edge = Edge(seed)
    reference, automatic = [0, 90, 33.3, -120][seed % 4], seed % 2
    rest = {"Q301": seed % 2, "Q312": 0 if automatic else 6, "Q337": 1, "Q305": 2, "Q303": seed // 2 % 2, "Q380": reference}
    found = edge.run(403, edge.two_points() | rest)
    expected = reduced(edge.line - reference, 360 if automatic else 180)
    assert math.degrees(found.toolpath.rotary[-1][2]) == pytest.approx(expected, abs=ANGLE)
    tables = found.tables
    row = tables.datums[2] if not rest["Q303"] else tables.presets[2 if automatic else 1]
    assert row.c == pytest.approx(expected, abs=ANGLE)


@pytest.mark.parametrize("seed", SEEDS)
def test_404(seed):
    draw = np.random.default_rng(seed).uniform
    old, angle = draw(-170, 170), draw(-360, 360)
    blocks = cycle(404, {"Q307": angle, "Q305": seed % 2 - 1}) + "\nL X+30 Y-20 R0 FMAX"
    found = run(blocks, presets={1: Datum(*PRESET, rotation=old)})
    assert found.tables.presets[1 - seed % 2].rotation == angle
    assert found.toolpath.end[-1][:2] == pytest.approx(turned(angle) @ (30, -20), abs=LENGTH)


class Rounds:
    """Two random holes or studs, and nominal ones near them."""

    def __init__(self, seed, holes):
        draw = np.random.default_rng(seed).uniform
        self.ball, self.turn = draw(0.5, 2.5), draw(-180, 180)
        self.first = draw(-50, 50, 2)
        self.centres = np.array([self.first, self.first + turned(self.turn) @ (draw(60, 90), 0)])
        self.sizes = draw(16, 30, 2)
        self.nominal = self.centres + draw(-1, 1, (2, 2))
        self.nominal_sizes = self.sizes + draw(-0.5, 0.5, 2)
        each = [(*centre, size) for centre, size in zip(self.centres.tolist(), self.sizes.tolist(), strict=True)]
        if holes == (True, True):
            self.part = drilled(*each)
        elif holes == (False, False):
            self.part = studs(*each)
        else:  # a hole in a pad that stands beside the stud
            k, j = holes.index(True), holes.index(False)
            x, y, size = each[k]
            pad = drilled((x, y, size), low=(x - 22, y - 22), high=(x + 22, y + 22))
            self.part = studs(each[j]) | pad
        self.line = math.degrees(math.atan2(*(self.centres[1] - self.centres[0])[::-1]))
        self.nominal_line = math.degrees(math.atan2(*(self.nominal[1] - self.nominal[0])[::-1]))

    def run(self, number, values, after="", **more):
        found = run(cycle(number, values) + after, self.part, ball=self.ball, **more)
        assert not [a for a in found.alarms if a.severity == "alarm"], found.alarms
        clear(found, self.part, self.ball, after.count("\n"))
        return found


@pytest.mark.parametrize("number", [401, 402])
@pytest.mark.parametrize("seed", SEEDS)
def test_401_and_402(seed, number):
    two = Rounds(seed, (number == 401,) * 2)
    (x, y), (x2, y2) = two.nominal.tolist()
    reference, table = [0, 45, -100][seed % 3], seed % 2
    values = {"Q268": x, "Q269": y, "Q270": x2, "Q271": y2, "Q261": -8, "Q260": 12, "Q307": reference, "Q305": 0, "Q402": table}
    if number == 402:
        sizes = {"Q313": two.sizes[0] + 0.7, "Q314": two.sizes[1] + 0.2, "Q315": -10, "Q320": 0.6, "Q301": seed // 2 % 2}
        values |= sizes
    found = two.run(number, values | {"Q337": table}, "\nL X+30 Y-20 Z+70 C+0 R0 FMAX", reach=20)
    expected = reduced(two.line - reference)
    row = found.tables.presets[0]
    assert (row.rotation, row.c) == pytest.approx((0, expected) if table else (expected, 0), abs=ANGLE)
    assert found.toolpath.end[-1][:2] == pytest.approx(turned(row.rotation) @ (30, -20), abs=LENGTH)
    assert math.degrees(found.toolpath.rotary[-1][2]) == pytest.approx(row.c, abs=ANGLE)


@pytest.mark.parametrize("seed", SEEDS)
def test_405(seed):
    draw = np.random.default_rng(seed).uniform
    ball, size, nominal = draw(0.5, 2.5), draw(10, 30), draw(20, 90, 2) * (1, -1)[seed % 2]
    centre = nominal + draw(-0.8, 0.8, 2)
    if seed % 5 == 0:
        nominal = np.array([nominal[0], 0.0])
        centre = nominal + draw(-0.8, 0.8, 2)
    step = draw(30, 120) * (1, -1)[seed // 2 % 2]
    part = drilled((*centre, size))
    values = {
        "Q321": nominal[0], "Q322": nominal[1], "Q262": size - 0.5, "Q325": draw(-180, 180), "Q247": step, "Q261": -7,
        "Q320": 0.3, "Q260": 12, "Q301": seed // 4 % 2, "Q337": seed % 3,
    }  # fmt: skip
    found = run(cycle(405, values) + "\nL X+0 Y+0 Z+50 C+0 R0 FMAX", part, ball=ball, reach=20)
    assert not [a for a in found.alarms if a.severity == "alarm"], found.alarms
    clear(found, part, ball, 1)
    before = 90 if nominal[1] == 0 else math.degrees(math.atan2(nominal[1], nominal[0]))
    expected = reduced(math.degrees(math.atan2(centre[1], centre[0])) - before)
    assert found.variables["Q150"] == pytest.approx(expected, abs=ANGLE)
    written = found.tables.datums[seed % 3] if seed % 3 else found.tables.presets[1]
    assert written.c == pytest.approx(expected, abs=ANGLE)
    stands = expected if seed % 3 == 0 else 0  # where C+0 is
    assert math.degrees(found.toolpath.rotary[-1][2]) == pytest.approx(stands, abs=ANGLE)


@pytest.mark.parametrize("seed", SEEDS)
def test_1410(seed):
    """With a basic rotation that is active; the block after it stands on the measured point, its axes along the edge."""
    edge = Edge(seed)
    old = [0.0, 20.0, -130.0][seed % 3]
    (x, y), (x2, y2) = edge.places.tolist()
    which = 1 + seed % 3
    values = {
        "Q1100": x, "Q1101": y, "Q1102": -6, "Q1103": x2, "Q1104": y2, "Q1105": -6 - seed % 4, "Q372": edge.number,
        "Q320": edge.clearance, "Q260": 15, "Q1125": (2, 0, 1)[seed % 3], "Q309": 0, "Q1126": 0, "Q1120": which, "Q1121": 1,
    }  # fmt: skip
    points = np.array([edge.touched(0), edge.touched(1)])
    by = reduced(edge.line - edge.nominal)
    should = [*edge.places, edge.places.mean(axis=0)][which - 1]
    is_ = [*points, points.mean(axis=0)][which - 1]
    target = should + (30, -20)
    after = f"\nL Z+70 R0 FMAX\nL X{target[0]:+.9f} Y{target[1]:+.9f} FMAX"
    found = edge.run(1410, values, after, rotation=old)
    results = {"Q964": edge.line, "Q965": edge.line + old, "Q994": by, "Q995": by}
    assert {q: found.variables[q] for q in results} == pytest.approx(results, abs=ANGLE)
    measured = {"Q950": points[0][0], "Q951": points[0][1], "Q953": points[1][0], "Q954": points[1][1]}
    errors = {"Q980": points[0][0] - x, "Q981": points[0][1] - y, "Q983": points[1][0] - x2, "Q984": points[1][1] - y2}
    measured |= errors | {"Q952": -6, "Q982": 0}
    assert {q: found.variables[q] for q in measured} == pytest.approx(measured, abs=LENGTH)
    assert found.tables.presets[1].rotation == pytest.approx(old + by, abs=ANGLE)
    there = turned(old) @ (is_ + turned(by) @ (30, -20))  # on the machine, from the old origin
    assert found.toolpath.end[-1][:2] == pytest.approx(there, abs=LENGTH)


@pytest.mark.parametrize("seed", SEEDS)
def test_1411(seed):
    kind = seed % 4
    two = Rounds(seed, ((True, True), (False, False), (True, False), (False, True))[kind])
    (x, y), (x2, y2) = two.nominal.tolist()
    count, over = 3 + seed % 6, [360, -340, 200, -270][seed // 2 % 4]
    values = {
        "Q1100": x, "Q1101": y, "Q1102": -6, "Q1116": two.nominal_sizes[0], "Q1103": x2, "Q1104": y2, "Q1105": -8,
        "Q1117": two.nominal_sizes[1], "Q1115": kind, "Q423": count, "Q325": seed * 17 % 360, "Q1119": over, "Q320": 0.5,
        "Q260": 14, "Q1125": 1 + seed // 3 % 2, "Q309": 0, "Q1126": 0, "Q1120": 1, "Q1121": 1,
    }  # fmt: skip
    target = two.nominal[0] + (30, -20)
    after = f"\nL Z+70 R0 FMAX\nL X{target[0]:+.9f} Y{target[1]:+.9f} FMAX"
    found = two.run(1411, values, after, reach=15)
    by = reduced(two.line - two.nominal_line)
    angles = {"Q964": two.line, "Q965": two.line, "Q994": by}
    assert {q: found.variables[q] for q in angles} == pytest.approx(angles, abs=ANGLE)
    lengths = {"Q966": two.sizes[0], "Q967": two.sizes[1], "Q996": (two.sizes - two.nominal_sizes)[0]}
    lengths |= {"Q950": two.centres[0][0], "Q951": two.centres[0][1], "Q953": two.centres[1][0], "Q954": two.centres[1][1]}
    assert {q: found.variables[q] for q in lengths} == pytest.approx(lengths, abs=LENGTH)
    assert found.toolpath.end[-1][:2] == pytest.approx(two.centres[0] + turned(by) @ (30, -20), abs=LENGTH)


@pytest.mark.parametrize("seed", SEEDS)
def test_1420(seed):
    """Planes that are nearly level, and walls: spatial angles by the turns about the fixed axes X, then Y; where the rotation is
    taken over, a block after it along the normal that the plane should have runs along that of the plane."""
    draw = np.random.default_rng(seed).uniform
    number = (-3, -3, -3, 1, -1, 2, -2)[seed % 7]
    axis, sense = abs(number) - 1, math.copysign(1, number)
    way = np.eye(3)[axis] * sense
    ball, clearance = draw(0.5, 3), draw(0, 1)
    normal = -way + np.where(np.eye(3)[axis], 0, draw(-0.05, 0.05, 3))
    normal /= np.linalg.norm(normal)
    others = [k for k in range(3) if k != axis]
    through = draw(-20, 20, 3) - (0, 0, 30)
    places = np.tile(through, (3, 1))
    for place, (u, v) in zip(places, ((0, 0), (25, draw(-6, 6)), (draw(-6, 6), 22)), strict=True):
        place[others] += (u, v)
        if number != -3:  # a level plane stays level
            place[axis] -= (place - through) @ normal / normal[axis] + draw(-0.5, 0.5)
    part = plane(np.add(PRESET, through), normal)
    q = {f"Q{1100 + k}": value for k, value in enumerate(places.ravel().tolist())}
    rest = {"Q372": number, "Q320": clearance, "Q260": 60, "Q1125": 2, "Q309": 0, "Q1126": 0, "Q1120": 1}
    rest["Q1121"] = int(seed % 2 or number == -3)
    level = np.cross(places[1] - places[0], places[2] - places[0])
    level *= -math.copysign(1 / np.linalg.norm(level), level @ way)  # the normal that the plane should have
    away = level * (90 if number == -3 else 30)
    after = "\nL " + " ".join(f"{a}{v:+.9f}" for a, v in zip("XYZ", places[0] + away, strict=True)) + " R0 FMAX"
    start = np.add(PRESET, through + (-way * 60 if axis < 2 else (0, 0, 80)))
    before = "" if axis < 2 else "L Z+100 R0 FMAX"
    values = q | rest | ({"Q1125": -1} if axis < 2 else {})
    found = run(cycle(1420, values) + after, part, before, ball=ball, reach=12, start=tuple(start.tolist()))
    assert not [a for a in found.alarms if a.severity == "alarm"], found.alarms
    clear(found, part, ball, 1)
    touched = []
    for place in places:
        s = (ball - (place - way * (ball + 2 + clearance) - through) @ normal) / (way @ normal)
        touched.append(place + way * (s - 2 - clearance))
    assert [found.variables[f"Q{950 + k}"] for k in range(9)] == pytest.approx(np.ravel(touched), abs=LENGTH)
    up = normal * math.copysign(1, normal[2])
    spatial = (math.degrees(math.asin(-up[1])), math.degrees(math.atan2(up[0], up[2])), 0)
    assert [found.variables[f"Q{961 + k}"] for k in range(3)] == pytest.approx(spatial, abs=ANGLE)
    ahead = normal * np.linalg.norm(away) if rest["Q1121"] else away
    assert found.toolpath.end[-1] == pytest.approx(touched[0] + ahead, abs=LENGTH)

"""TCH PROBE 420 to 431 on random parts: place, turn, size, ball, approach; values within 1e-6 mm and 1e-7 degrees.

Each part is built in the program's system from numbers that the expected values follow from by plain arithmetic; it stands on
the machine behind a random preset with a basic rotation. The block after the cycle goes where the results say.
"""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from tools.probed import gaps
from tools.together import together

import mnclab as mnc
from mnclab import Kind, Probe, Setup, Tool, part
from mnclab.machine.setup import Datum

TINY = 1e-6
TOP = part.plane((0, 0, 0), (0, 0, 1))
SEEDS = range(22)


class Case:
    """The words of a cycle, the part, the results that it must give, and where the next block must stand (x, y)."""

    def __init__(self, code, words, made, expected, then=None):
        self.code, self.words, self.made, self.expected, self.then = code, words, made, expected, then


def wall(x, y, degrees):
    """Material behind a wall through a point, whose normal points out at an angle."""
    turn = math.radians(degrees)
    return part.plane((x, y, 0), (math.cos(turn), math.sin(turn), 0))


def common(chance, level=-5.0):
    return {"Q261": level, "Q320": float(chance.uniform(0, 1.5)), "Q260": float(chance.uniform(5, 40))}


def judged(chance, **limits):
    """Limits that are not watched, a log or none."""
    return {**limits, "Q281": int(chance.integers(2)), "Q309": 0, "Q330": 0}


def angle_case(chance):
    axis, sense, off = int(chance.integers(1, 4)), int(chance.choice([-1, 1])), float(chance.uniform(-4, 4))
    x, y, apart = chance.uniform(-50, 50), chance.uniform(-50, 50), float(chance.uniform(20, 60))
    along = np.array([[0, 1], [1, 0]][axis - 1] if axis < 3 else [[0, 1], [1, 0]][int(chance.integers(2))]) * apart
    words = {
        "Q263": x - along[0] / 2, "Q264": y - along[1] / 2, "Q265": x + along[0] / 2, "Q266": y + along[1] / 2,
        "Q272": axis, "Q267": -1 if axis == 3 else sense, **common(chance), "Q301": int(chance.integers(2)), "Q281": 0,
    }  # fmt: skip
    if axis == 3:  # about X where the points lie along Y; about Y a surface that falls with X is positive
        slope = math.tan(math.radians(off))
        normal = (0, -slope, 1) if along[0] == 0 else (slope, 0, 1)
        return Case("420", words, part.plane((x, y, -5), normal), {"Q150": off})
    facing = {1: 180 if sense > 0 else 0, 2: 270 if sense > 0 else 90}[axis] + off
    found = math.remainder(facing + 90, 180)
    expected = found + 180 if found <= -90 else found
    return Case("420", words, wall(x, y, facing) & TOP, {"Q150": expected})


def round_case(chance, inside):
    x, y, wide = chance.uniform(-50, 50), chance.uniform(-50, 50), float(chance.uniform(30, 80))
    dx, dy, dd = chance.uniform(-0.8, 0.8, 3)
    points, step = int(chance.choice([3, 4])), float(chance.uniform(40, 119) * chance.choice([-1, 1]))
    upper, lower = ("Q275", "Q276") if inside else ("Q277", "Q278")
    words = {
        "Q273": x, "Q274": y, "Q262": wide, "Q325": float(chance.uniform(-360, 360)), "Q247": step, **common(chance),
        "Q301": int(chance.integers(2)), **judged(chance, **{upper: 0, lower: 0, "Q279": 0, "Q280": 0}), "Q423": points,
        "Q365": int(chance.integers(2)),
    }  # fmt: skip
    actual = wide + dd
    made = TOP - part.hole((x + dx, y + dy, 0), actual, 60) if inside else part.cylinder(
        (x + dx, y + dy, -60), (x + dx, y + dy, 0), actual / 2)  # fmt: skip
    if not inside:  # a straight way at the clearance height, an arc at the measuring height
        words["Q301"], words["Q365"] = (1, words["Q365"]) if words["Q301"] else (0, 1)
    expected = {"Q151": x + dx, "Q152": y + dy, "Q153": actual, "Q161": dx, "Q162": dy, "Q163": dd}
    return Case("421" if inside else "422", words, made, expected, ("Q151", "Q152"))


def rectangle_case(chance, inside):
    x, y, a, b = *chance.uniform(-50, 50, 2), *chance.uniform(20, 90, 2)
    dx, dy, da, db = chance.uniform(-0.8, 0.8, 4)
    words = {
        "Q273": x, "Q274": y, "Q282": a, "Q283": b, **common(chance), "Q301": int(chance.integers(2)),
        **judged(chance, Q284=0, Q285=0, Q286=0, Q287=0, Q279=0, Q280=0),
    }  # fmt: skip
    low, high = (x + dx - (a + da) / 2, y + dy - (b + db) / 2, -60), (x + dx + (a + da) / 2, y + dy + (b + db) / 2, 0)
    made = TOP - part.pocket((x + dx, y + dy, 0), a + da, b + db, 60) if inside else part.box(low, high)
    expected = {
        "Q151": x + dx, "Q152": y + dy, "Q154": a + da, "Q155": b + db, "Q161": dx, "Q162": dy, "Q164": da, "Q165": db,
    }  # fmt: skip
    return Case("423" if inside else "424", words, made, expected, ("Q151", "Q152"))


def width_case(chance, inside):
    k, place, other, wide = int(chance.integers(2)), *chance.uniform(-50, 50, 2), float(chance.uniform(14, 16 if inside else 60))
    d, dw = chance.uniform(-0.8, 0.8, 2)
    low, high = place + d - (wide + dw) / 2, place + d + (wide + dw) / 2
    out = (0, 90)[k]
    if inside:
        made = (wall(*((high, 0) if k == 0 else (0, high)), out + 180) | wall(*((low, 0) if k == 0 else (0, low)), out)) & TOP
        start = (place, other) if k == 0 else (other, place)
        words = {
            "Q328": start[0], "Q329": start[1], "Q310": float(chance.choice([0, 12, -7])), "Q272": k + 1, **common(chance),
            "Q311": wide, **judged(chance, Q288=0, Q289=0), "Q301": int(chance.integers(2)),
        }  # fmt: skip
    else:
        made = wall(*((high, 0) if k == 0 else (0, high)), out) & wall(*((low, 0) if k == 0 else (0, low)), out + 180) & TOP
        ends = [(place + s * wide / 2, other) if k == 0 else (other, place + s * wide / 2) for s in chance.permutation([-1, 1])]
        words = {
            "Q263": ends[0][0], "Q264": ends[0][1], "Q265": ends[1][0], "Q266": ends[1][1], "Q272": k + 1, **common(chance),
            "Q311": wide, **judged(chance, Q288=0, Q289=0),
        }  # fmt: skip
    expected = {"Q156": wide + dw, "Q157": place + d, "Q166": dw}
    return Case("425" if inside else "426", words, made, expected, ("Q157", None) if k == 0 else (None, "Q157"))


def coordinate_case(chance):
    axis, sense = int(chance.integers(1, 4)), int(chance.choice([-1, 1]))
    x, y, off = *chance.uniform(-50, 50, 2), float(chance.uniform(-1, 1))
    words = {
        "Q263": x, "Q264": y, **common(chance), "Q272": axis, "Q267": -1 if axis == 3 else sense, "Q281": 0, "Q288": 0, "Q289": 0,
        "Q309": 0, "Q330": 0,
    }  # fmt: skip
    nominal = (x, y, -5)[axis - 1]
    facing = (180 if sense > 0 else 0) + 90 * (axis - 1)
    made = part.plane((0, 0, -5 + off), (0, 0, 1)) if axis == 3 else wall(
        *((x + off, y) if axis == 1 else (x, y + off)), facing) & TOP  # fmt: skip
    return Case("427", words, made, {"Q160": nominal + off}, {1: ("Q160", None), 2: (None, "Q160"), 3: None}[axis])


def bolt_circle_case(chance):
    x, y, wide = *chance.uniform(-50, 50, 2), float(chance.uniform(60, 120))
    dx, dy, dd = chance.uniform(-0.5, 0.5, 3)
    angles = np.cumsum(chance.uniform(50, 130, 3)) + chance.uniform(-360, -100)
    made, size = TOP, float(chance.uniform(10, 14))
    for angle in angles + chance.uniform(-0.3, 0.3, 3):
        turn = math.radians(angle)
        centre = x + dx + (wide + dd) / 2 * math.cos(turn), y + dy + (wide + dd) / 2 * math.sin(turn), 0
        made = made - part.hole(centre, size, 60)
    words = {"Q273": x, "Q274": y, "Q262": wide, "Q291": angles[0], "Q292": angles[1], "Q293": angles[2], "Q261": -5,
             "Q260": float(chance.uniform(5, 40)), **judged(chance, Q288=0, Q289=0, Q279=0, Q280=0)}  # fmt: skip
    expected = {"Q151": x + dx, "Q152": y + dy, "Q153": wide + dd, "Q161": dx, "Q162": dy, "Q163": dd}
    return Case("430", words, made, expected, ("Q151", "Q152"))


def plane_case(chance):
    """z = a x + b y + c; the normal is (-a, -b, 1), the ball touches beside its pole by r (1 / n3 - 1) too high."""
    a, b, c = *chance.uniform(-0.15, 0.15, 2), float(chance.uniform(-20, 20))
    first = chance.uniform(-40, 40, 2)
    turn = float(chance.uniform(0, math.tau))
    second = first + chance.uniform(20, 60) * np.array((math.cos(turn), math.sin(turn)))
    third = first + chance.uniform(20, 60) * np.array((math.cos(turn + 1), math.sin(turn + 1)))
    flat = [first, second, third]
    heights = [a * x + b * y + c for x, y in flat]
    words = {}
    for (x, y), z, names in zip(flat, heights, (("Q263", "Q264", "Q294"), ("Q265", "Q266", "Q295"), ("Q296", "Q297", "Q298"))):
        words |= dict(zip(names, (x, y, z + chance.uniform(-0.5, 0.5))))
    words |= {"Q320": float(chance.uniform(0, 1.5)), "Q260": 60.0, "Q281": 0}
    n = np.array((-a, -b, 1)) / math.sqrt(a * a + b * b + 1)
    ahead = np.array((*(second - first), heights[1] - heights[0]))
    ahead /= np.linalg.norm(ahead)
    aside = np.cross(n, ahead)
    angles = {  # of Rz(C) Ry(B) Rx(A), whose columns are ahead, aside and n
        "Q170": math.atan2(aside[2], n[2]), "Q171": math.atan2(-ahead[2], math.hypot(ahead[0], ahead[1])),
        "Q172": math.atan2(ahead[1], ahead[0]), "Q158": math.atan(b), "Q159": -math.atan(a),
    }  # fmt: skip
    found = Case("431", words, part.plane((0, 0, c), (-a, -b, 1)), {name: math.degrees(v) for name, v in angles.items()})
    found.lifted = {f"Q{173 + k}": (z, n[2]) for k, z in enumerate(heights)}
    return found


MAKERS = {
    "420": angle_case, "421": lambda chance: round_case(chance, True), "422": lambda chance: round_case(chance, False),
    "423": lambda chance: rectangle_case(chance, True), "424": lambda chance: rectangle_case(chance, False),
    "425": lambda chance: width_case(chance, True), "426": lambda chance: width_case(chance, False),
    "427": coordinate_case, "430": bolt_circle_case, "431": plane_case,
}  # fmt: skip
ANGLES = {"Q150", "Q158", "Q159", "Q170", "Q171", "Q172"}


@together("code seed", product(MAKERS, SEEDS), lambda code, seed: f"TCH PROBE {code}")
def test_a_random_part(code, seed):
    chance = np.random.default_rng([int(code), seed])
    case, ball = MAKERS[code](chance), float(chance.uniform(0.5, 3))
    turn, shift = math.radians(turned := float(chance.uniform(-60, 60))), chance.uniform(-100, 100, 3)
    frame = np.eye(4)
    frame[:2, :2] = (math.cos(turn), -math.sin(turn)), (math.sin(turn), math.cos(turn))
    frame[:3, 3] = shift
    made = case.made.placed(frame)
    lines = "\n".join(f"{name}={value:+.12g}" for name, value in case.words.items())
    x, y = case.then or (None, None)
    after = f"L{f' X+{x}' if x else ''}{f' Y+{y}' if y else ''} R0 FMAX\n" if case.then else ""
    setup = Setup(
        tools={7: Tool(radius=ball, length=50, kind="probe")}, part=made, probe=Probe(clearance=2, reach=12, feed=300),
        presets={1: Datum(*shift.tolist(), rotation=turned)}, settings={"preset": 1}, start=(*shift[:2].tolist(), shift[2] + 150),
    )  # fmt: skip
    run = mnc.run(f"BEGIN PGM P MM\nTOOL CALL 7 Z\nL Z+90 R0 FMAX\nTCH PROBE {code} X\n{lines}\n9 {after}END PGM P MM\n",
                  "tnc-620", setup)  # fmt: skip
    assert run.ok, run.alarms
    for name, value in case.expected.items():
        assert run.variables[name] == pytest.approx(value, abs=1e-7 if name in ANGLES else TINY), name
    for name, (z, steep) in getattr(case, "lifted", {}).items():
        assert run.variables[name] == pytest.approx(z + ball * (1 / steep - 1), abs=TINY)
    if "Q309" in case.words:
        assert [run.variables[q] for q in ("Q180", "Q181", "Q182")] == [1, 0, 0]
    assert (gaps(run, made, ball) >= -1e-6).all()
    if case.then:
        end = np.linalg.inv(frame) @ (*(run.toolpath.end[-1] + run.toolpath.origin), 1)
        for k, q in enumerate(case.then):
            assert q is None or end[k] == pytest.approx(case.expected[q], abs=TINY)
    touches = [row for row in run.toolpath if row.kind == Kind.PROBE]
    assert len(touches) == len(run.touches) and all(len(row.touches) == len(touches) for row in run.measurements)

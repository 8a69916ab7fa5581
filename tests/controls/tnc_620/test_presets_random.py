"""Presets (TNC 620, chapter 15) of random parts: place, turn, size, ball, approach, tables; expected by the arithmetic here.

A ball of radius r on a wall that is turned by w against the axis stands r / cos w before it, and the control takes r off again:
so a width of w0 becomes (w0 - 2 r) / cos w + 2 r from within, (w0 + 2 r) / cos w - 2 r from outside. Circles and corners are
exact. A preset becomes P + R(t) (M - N): P and t are origin and basic rotation of the active one, M what was measured, N what it
gets (15.1).
"""

import math
from dataclasses import dataclass, field
from itertools import product

import numpy as np
import pytest
from tools.probed import gaps
from tools.together import together

import mnclab as mnc
from mnclab.workpiece.part import Part, box, cylinder, hole

SEEDS = range(20)
BIG = 150  # mm, half of a block
TIGHT = 1e-6
TURN = 40.0  # degrees, of the basic rotation that is active before


@dataclass
class Task:
    """A cycle's words, the part in coordinates of the program, and what must be found: Q parameters, axes, an angle."""

    part: Part
    words: dict
    results: dict
    measured: dict
    gets: dict
    top: tuple  # a place on the part and its height
    angle: float = 0.0
    turned: bool = False
    codes: dict = field(default_factory=dict)


@dataclass
class Draw:
    """Random numbers, and the probe that they make."""

    rng: np.random.Generator
    ball: float
    gap: float

    def between(self, low, high):
        return float(self.rng.uniform(low, high))

    def one(self, *values):
        return values[self.rng.integers(len(values))]

    def error(self):
        """A small error of place, safe for positioning."""
        return self.between(-0.3, 0.3) * self.gap


def block(top):
    return box((-BIG, -BIG, -40), (BIG, BIG, top))


def at_centre(d):
    """A true centre, a nominal one, the height of the surface."""
    x, y = d.between(-30, 30), d.between(-30, 30)
    return (x, y), {"Q321": x + d.error(), "Q322": y + d.error()}, d.between(-3, 3)


def new(d, *names):
    return {name: d.between(-20, 20) for name in names}


def slot_or_ridge(d, inside):
    (x, y), centre, top = at_centre(d)
    size, w, k = d.between(2 * d.ball + 4, 60), math.radians(d.between(-3, 3)), d.one(0, 1)
    body = box((x - size / 2, y - 400, -30), (x + size / 2, y + 400, 60 if inside else top))
    body = body.turned(math.degrees(w) - 90 * k, (x, y))
    part = box((-400, -400, -40), (400, 400, top)) - body if inside else body
    across = (centre["Q322"] - y) if k == 0 else (centre["Q321"] - x)
    sign = -1 if k == 0 else 1  # the line leans to -X for a turn w, seen along +Y
    middle = (x if k == 0 else y) + sign * across * math.tan(w)
    r = -d.ball if inside else d.ball
    width = (size + 2 * r) / math.cos(w) - 2 * r
    gets = new(d, "Q405")
    words = centre | {"Q311": size + 0.3 * d.error(), "Q272": k + 1} | gets
    place = (x + 80 * (k == 0), y + 80 * (k == 1)) if inside else (x, y)
    return Task(part, words, {"Q157": middle, "Q166": width}, {k: middle}, {k: gets["Q405"]}, (*place, top))


def rectangle(d, inside):
    (x, y), centre, top = at_centre(d)
    sizes, w = (d.between(2 * d.ball + 4, 70), d.between(2 * d.ball + 4, 70)), math.radians(d.between(-2, 2))
    body = box((x - sizes[0] / 2, y - sizes[1] / 2, -30), (x + sizes[0] / 2, y + sizes[1] / 2, 60 if inside else top))
    body = body.turned(math.degrees(w), (x, y))
    found = x - (centre["Q322"] - y) * math.tan(w), y + (centre["Q321"] - x) * math.tan(w)
    r = -d.ball if inside else d.ball
    length, width = ((size + 2 * r) / math.cos(w) - 2 * r for size in sizes)
    gets = new(d, "Q331", "Q332")
    words = centre | {"Q323": sizes[0] + 0.3 * d.error(), "Q324": sizes[1] + 0.3 * d.error()} | gets
    results = {"Q151": found[0], "Q152": found[1], "Q154": length, "Q155": width}
    place = (x + 80, y) if inside else (x, y)
    return Task(block(top) - body if inside else body, words, results, dict(enumerate(found)),
                {0: gets["Q331"], 1: gets["Q332"]}, (*place, top))  # fmt: skip


def circle(d, inside):
    (x, y), centre, top = at_centre(d)
    size = d.between(2 * d.ball + 4, 80)
    part = block(top) - hole((x, y, top), size, 30) if inside else cylinder((x, y, -40), (x, y, top), size / 2)
    gets, count = new(d, "Q331", "Q332"), d.one(3, 4)
    words = centre | gets | {
        "Q262": size + 0.3 * d.error(), "Q325": d.between(-360, 360), "Q247": d.one(-1, 1) * d.between(40, 120),
        "Q423": count, "Q365": d.one(0, 1),
    }  # fmt: skip
    results = {"Q151": x, "Q152": y, "Q153": size}
    return Task(part, words, results, {0: x, 1: y}, {0: gets["Q331"], 1: gets["Q332"]},
                (x + 80 * inside, y, top))  # fmt: skip


def corner_from_outside(d):
    (x, y), _, top = at_centre(d)
    w, sx, sy = d.between(-1, 1), d.one(-1, 1), d.one(-1, 1)  # where the material lies from the corner
    part = box((min(x, x + sx * 200), min(y, y + sy * 200), -40), (max(x, x + sx * 200), max(y, y + sy * 200), top))
    first, second = (sorted((s * d.between(8, 15), s * d.between(25, 45))) for s in (sx, sy))
    gets = new(d, "Q331", "Q332")
    words = gets | {
        "Q263": x + first[0], "Q264": y + d.error() / 2, "Q326": first[1] - first[0],
        "Q296": x + d.error() / 2, "Q297": y + second[0], "Q327": second[1] - second[0],
    }  # fmt: skip
    return cornered(d, part.turned(w, (x, y)), words, gets, (x, y), w, (x + sx * 100, y + sy * 100, top))


def corner_from_inside(d):
    (x, y), _, top = at_centre(d)
    w, number = d.between(-1, 1), d.one(1, 2, 3, 4)
    sx, sy = {1: (1, 1), 2: (-1, 1), 3: (-1, -1), 4: (1, -1)}[number]
    free = box((min(x, x + sx * 100), min(y, y + sy * 100), -30), (max(x, x + sx * 100), max(y, y + sy * 100), 60))
    gets = new(d, "Q331", "Q332")
    words = gets | {
        "Q263": x + d.error() / 2, "Q264": y + d.error() / 2, "Q326": d.between(15, 30), "Q327": d.between(15, 30),
        "Q308": number,
    }  # fmt: skip
    return cornered(d, block(top) - free.turned(w, (x, y)), words, gets, (x, y), w, (x - sx * 40, y - sy * 40, top))


def cornered(d, part, words, gets, corner, w, top):
    turned = d.one(0, 1)
    results = {"Q151": corner[0], "Q152": corner[1]}
    return Task(part, words | {"Q304": turned}, results, dict(enumerate(corner)),
                {0: gets["Q331"], 1: gets["Q332"]}, top, w, bool(turned))  # fmt: skip


def holes(d, places, top, size):
    part = block(top)
    for x, y in places:
        part = part - hole((x, y, top), size, 30)
    return part


def bolt_circle(d):
    (x, y), _, top = at_centre(d)
    radius, first, size = d.between(25, 50), d.between(-180, 100), d.between(2 * d.ball + 3, 2 * d.ball + 9)
    angles = [first, first + d.between(50, 110), first + d.between(170, 250)]
    places = [(x + radius * math.cos(math.radians(a)), y + radius * math.sin(math.radians(a))) for a in angles]
    gets = new(d, "Q331", "Q332")
    words = gets | {"Q273": x + d.between(-0.3, 0.3), "Q274": y + d.between(-0.3, 0.3), "Q262": 2 * radius + d.between(-0.3, 0.3)}
    words |= {name: angle + d.between(-0.3, 0.3) for name, angle in zip(("Q291", "Q292", "Q293"), angles)}
    return Task(holes(d, places, top, size), words, {"Q151": x, "Q152": y, "Q153": 2 * radius}, {0: x, 1: y},
                {0: gets["Q331"], 1: gets["Q332"]}, (x, y, top))  # fmt: skip


def four_holes(d):
    top, size = d.between(-3, 3), d.between(2 * d.ball + 3, 2 * d.ball + 9)
    places = [(sx * d.between(25, 50), sy * d.between(25, 50)) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    gets = new(d, "Q331", "Q332")
    names = [("Q268", "Q269"), ("Q270", "Q271"), ("Q316", "Q317"), ("Q318", "Q319")]
    words = gets | {q: value + d.between(-0.5, 0.5) for pair, place in zip(names, places) for q, value in zip(pair, place)}
    (x1, y1), (x2, y2), (x3, y3), (x4, y4) = places
    u, v = (x3 - x1, y3 - y1), (x4 - x2, y4 - y2)  # 1 + s u = 2 + t v
    s = ((x2 - x1) * v[1] - (y2 - y1) * v[0]) / (u[0] * v[1] - u[1] * v[0])
    x, y = x1 + s * u[0], y1 + s * u[1]
    return Task(holes(d, places, top, size), words, {"Q151": x, "Q152": y}, {0: x, 1: y},
                {0: gets["Q331"], 1: gets["Q332"]}, (0, 0, top))  # fmt: skip


def from_above(d):
    top, gets = d.between(-3, 30), new(d, "Q333")
    words = {"Q263": d.between(-40, 40), "Q264": d.between(-40, 40), "Q294": top + d.error()} | gets
    return Task(block(top), words, {"Q160": top}, {2: top}, {2: gets["Q333"]}, ())


def one_axis(d):
    k, gets = d.one(0, 1, 2), new(d, "Q333")
    sense = d.one(-1, 1) if k < 2 else -1  # upwards it would come through what it touches
    x, y, w = d.between(-30, 30), d.between(-30, 30), d.between(-3, 3)
    words = {"Q272": k + 1, "Q267": sense} | gets
    if k == 2:
        top = d.between(-3, 3)
        words |= {"Q263": x, "Q264": y, "Q261": top + d.error()}
        return Task(block(top), words, {}, {2: top}, {2: gets["Q333"]}, ())
    ends = ((x, y - 200, -40), (x + sense * 200, y + 200, 10)) if k == 0 else ((x - 200, y, -40), (x + 200, y + sense * 200, 10))
    low, high = np.minimum(*ends), np.maximum(*ends)
    words |= {"Q263": x + (d.error() if k == 0 else d.between(-9, 9)), "Q264": y + (d.error() if k == 1 else d.between(-9, 9))}
    across = words["Q264"] - y if k == 0 else words["Q263"] - x
    wall = (x if k == 0 else y) + (-1 if k == 0 else 1) * across * math.tan(math.radians(w))
    found = wall - sense * d.ball * (1 / math.cos(math.radians(w)) - 1)
    return Task(box(low, high).turned(w, (x, y)), words, {}, {k: found}, {k: gets["Q333"]}, ())


CYCLES = {
    408: lambda d: slot_or_ridge(d, True), 409: lambda d: slot_or_ridge(d, False),
    410: lambda d: rectangle(d, True), 411: lambda d: rectangle(d, False),
    412: lambda d: circle(d, True), 413: lambda d: circle(d, False),
    414: corner_from_outside, 415: corner_from_inside, 416: bolt_circle, 417: from_above, 418: four_holes, 419: one_axis,
}  # fmt: skip
WITHOUT = {"Q320": (418,), "Q301": (409, 416, 417, 418, 419), "Q381": (417, 419), "Q261": (417,)}


@together("cycle seed", product(CYCLES, SEEDS), lambda cycle, seed: f"TCH PROBE {cycle}")
def test_a_random_part(cycle, seed):
    rng = np.random.default_rng((cycle, seed))
    ball, setup, extra = float(rng.uniform(0.5, 3.5)), float(rng.uniform(2.0, 4.0)), float(rng.uniform(0, 2))
    d = Draw(rng, ball, setup + (0 if cycle == 418 else extra))
    preset, rotation = rng.uniform(-200, 200, 3), d.one(0.0, d.between(-TURN, TURN))
    task = CYCLES[cycle](d)
    words = {"Q320": extra, "Q260": 40, "Q261": -8 - d.between(0, 5), "Q301": d.one(0, 1)} | task.words
    above = d.one(0, 1)
    if cycle not in WITHOUT["Q381"]:
        x, y, z = task.top
        words |= {"Q381": above, "Q382": x, "Q383": y, "Q384": z + d.error()} | (new(d, "Q333") if above else {})
        if above:
            task.measured[2], task.gets[2] = z, words["Q333"]
    row, transfer = d.one((0, 1), (1, 1), (7, 1), (7, 0))
    transfer = 1 if task.turned else transfer
    words |= {"Q305": row, "Q303": transfer}
    words = {name: value for name, value in words.items() if cycle not in WITHOUT.get(name, ()) or name in task.words}
    after = "9 L X+0 Y+0 R0 FMAX\n10 L X+10 FMAX\n"
    lines = "".join(f"{name}={value:+.9f}\n" for name, value in words.items())
    text = f"1 TOOL CALL 7 Z\n2 L Z+100 R0 FMAX\n3 TCH PROBE {cycle} X\n{lines}{after}"
    part = task.part.turned(rotation).shifted(*preset)
    datum = (*preset, 0, 0, 0, rotation)
    run = mnc.run(text, "tnc-620", mnc.Setup(
        tools={7: mnc.Tool(radius=ball, kind="probe")}, presets={1: datum, 7: (1, 2, 3, 0, 0, 0, 5)}, settings={"preset": 1},
        part=part, probe=mnc.Probe(clearance=setup, reach=60),
    ))  # fmt: skip
    assert run.ok, (run.alarms, text)
    for name, value in task.results.items():
        assert run.variables[name] == pytest.approx(value, abs=TIGHT), name
    assert gaps(run, part, ball)[1:].min() >= -1e-6
    judge_tables(run, task, preset, rotation, row, transfer)


def judge_tables(run, task, preset, rotation, row, transfer):
    turn = matrix(rotation)
    measured, new = np.zeros(3), np.zeros(3)
    for k in task.measured:
        measured[k], new[k] = task.measured[k], task.gets[k]
    delta = task.angle if task.turned else 0.0
    shift = measured - matrix(delta) @ new
    set_ = [k for k in range(3) if np.abs(turn[k, list(task.measured)]).max() > 1e-12]
    ends = run.toolpath.end[-2:] + np.array(run.toolpath.origin)
    stands, angle = preset, rotation
    if transfer == 0 and row:
        expected = np.where([k in task.measured for k in range(3)], shift, 0.0)
        assert np.array(run.tables.datums[row][:3]) == pytest.approx(expected, abs=TIGHT)
    else:
        origin = preset + turn @ np.where([k in task.measured for k in range(3)], shift, 0.0)
        found = run.tables.presets[row]
        for k in range(3):
            kept = (1, 2, 3)[k] if row == 7 else preset[k]
            assert found[k] == pytest.approx(origin[k] if k in set_ else kept, abs=TIGHT)
        tilted = rotation + delta if task.turned else 5 if row == 7 else rotation
        assert found.rotation == pytest.approx(tilted, abs=1e-7)
        if row in (0, 1):
            stands, angle = np.array(found[:3]), tilted
    assert ends[0][:2] == pytest.approx(stands[:2], abs=TIGHT)
    assert ends[1][:2] - ends[0][:2] == pytest.approx(matrix(angle)[:2, 0] * 10, abs=TIGHT)


def matrix(degrees):
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])

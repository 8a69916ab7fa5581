"""Base rotation and datums from random parts against plain arithmetic (MNC 12.1 to 12.12, formulas of the catalogue).

Place, turn and size of the part, the ball, the approach, an earlier base rotation B and a shift s of G92 are random. D is the
datum in the machine, p a place of the program: machine = D + Rot_B(p + s).
"""

import math
from typing import NamedTuple

import numpy as np
import pytest
from tools.probed import gaps

from controls.mnc.probing_mnc import (  # isort: skip
    BEFORE, DATUM, at, base_of, box, disc, measured, rows_of, to_round, to_wall, turn, walls, working,
)  # fmt: skip

from mnclab import Datum

PARTS = 20  # of each cycle
EXACT = {"abs": 1e-6, "rel": 0}  # mm
ANGLE = {"abs": 1e-7, "rel": 0}  # degrees
ROW = Datum(11, 12, 13)  # what row 7 holds before
AHEAD = {"+X": (1.0, 0.0), "-X": (-1.0, 0.0), "+Y": (0.0, 1.0), "-Y": (0.0, -1.0)}
SIDES = ("+X", "-X", "+Y", "-Y")
BACK = {"+X": "-X", "-X": "+X", "+Y": "-Y", "-Y": "+Y"}


class Case(NamedTuple):
    """A block, its part in program coordinates, what the record must say, what was found by axis with what it gets, the turn."""

    words: dict
    part: object
    says: dict
    found: dict
    turned: float | None = None


class Scene:
    """What is random beside the part."""

    def __init__(self, seed):
        rng = self.rng = np.random.default_rng(seed)
        self.ball = self.some(1, 4)
        self.extra = self.some(0, 2)
        self.away = self.ball + 2 + self.extra
        self.base = self.some(-170, 170) if rng.random() < 0.6 else 0.0
        self.shift = np.array([self.some(-9, 9) for _ in range(3)]) if rng.random() < 0.5 else np.zeros(3)
        self.row, self.apply, self.over = (int(rng.integers(2)) for _ in range(3))
        self.new = [self.some(-30, 30) for _ in range(3)]
        self.top = self.some(-0.6, 0.6)

    def some(self, low, high):
        """A number as a program writes it."""
        return round(float(self.rng.uniform(low, high)), 3)

    def place(self, size=40):
        return self.some(-size, size), self.some(-size, size)

    def near(self, point, by=0.4):
        return tuple(round(c + self.some(-by, by), 4) for c in point)

    @property
    def before(self):
        x, y, z = -self.shift
        return f"{BEFORE}G404 E{self.base}\nG92 X{x:.3f} Y{y:.3f} Z{50 + z:.3f}\n"

    @property
    def frame(self):
        return at(DATUM, self.base) @ at(self.shift)

    def common(self, **more):
        return {"Q": self.extra, "Z": -8, "H": 20, "P": self.over, "W": 7 * self.row, "S": self.apply} | more

    def above(self, x, y):
        """The touch from above: words, and the Z that is found."""
        if self.rng.random() < 0.5:
            return {}, {}, {}
        words = {"F": 1, "I": round(x, 3), "J": round(y, 3), "K": 0, "R": self.new[2]}
        return words, {"Z": self.top}, {2: (self.top, self.new[2])}


def aside(centre, start, which):
    """Where the touch of a side starts: that far from the middle of the figure."""
    return np.array(centre) + np.array(AHEAD[which]) * start


def slot_or_ridge(scene, inside):
    k, narrow = int(scene.rng.integers(2)), inside and scene.rng.random() < 0.4
    width = round(2 * scene.ball + scene.some(1, 3), 3) if narrow else round(2 * scene.away + scene.some(1, 40), 3)
    nominal, real = scene.place(), width + scene.some(-0.2, 0.2)
    centre = scene.near(nominal, 0.2)
    size, angle = [(real, 300.0), (300.0, real)][k], scene.some(-0.3, 0.3)
    start = max(width / 2 - scene.away, 0.0) if inside else width / 2 + scene.away
    out, hit = walls(centre, size, angle), []
    for which in SIDES[2 * k : 2 * k + 2]:
        point, normal = out[which]
        way = AHEAD[which] if inside else AHEAD[BACK[which]]
        hit.append(to_wall(aside(nominal, start, which), way, (point, -normal if inside else normal), scene.ball)[k])
    middle, wide = (hit[0] + hit[1]) / 2, hit[0] - hit[1] + (2 if inside else -2) * scene.ball
    top = (centre[0] + 60 * (k == 0 or not inside) * inside, centre[1] + 60 * (k == 1) * inside)
    more, says, found = scene.above(*top)
    words = scene.common(X=nominal[0], Y=nominal[1], D=width, L=k + 1, U=scene.new[0], **more)
    if not inside:
        words.pop("P")
    says |= {"width": wide, f"centre {'XY'[k]}": middle}
    return Case(words, box(centre, size, angle, scene.top, not inside), says, {k: (middle, scene.new[0])} | found)


def box_figure(scene, inside):
    narrow = inside and scene.rng.random() < 0.3
    lengths = [round(2 * scene.away + scene.some(20, 60), 3) for _ in range(2)]
    if narrow:
        lengths[int(scene.rng.integers(2))] = round(2 * scene.ball + scene.some(1, 3), 3)
    nominal, size = scene.place(), [each + scene.some(-0.2, 0.2) for each in lengths]
    centre, angle = scene.near(nominal, 0.2), scene.some(-0.3, 0.3) if narrow else scene.some(-1, 1)
    from_centre = inside and min(lengths) / 2 <= scene.away
    out, hit = walls(centre, size, angle), {}
    for which in SIDES:
        half = lengths[which in ("+Y", "-Y")] / 2
        start = 0.0 if from_centre else half - scene.away if inside else half + scene.away
        point, normal = out[which]
        way = AHEAD[which] if inside else AHEAD[BACK[which]]
        hit[which] = to_wall(aside(nominal, start, which), way, (point, -normal if inside else normal), scene.ball)
    more = (2 if inside else -2) * scene.ball
    x, y = (hit["+X"][0] + hit["-X"][0]) / 2, (hit["+Y"][1] + hit["-Y"][1]) / 2
    says = {"length X": hit["+X"][0] - hit["-X"][0] + more, "length Y": hit["+Y"][1] - hit["-Y"][1] + more}
    words, higher, found = scene.above(centre[0] + inside * lengths[0], centre[1])
    words = scene.common(X=nominal[0], Y=nominal[1], A=lengths[0], B=lengths[1], U=scene.new[0], V=scene.new[1], **words)
    says |= {"centre X": x, "centre Y": y} | higher
    found |= {0: (x, scene.new[0]), 1: (y, scene.new[1])}
    return Case(words, box(centre, size, angle, scene.top, not inside), says, found)


def round_figure(scene, inside):
    narrow = inside and scene.rng.random() < 0.4
    diameter = round(2 * scene.ball + scene.some(1, 3) if narrow else 2 * scene.away + scene.some(1, 50), 3)
    nominal, real = scene.place(), diameter + scene.some(-0.2, 0.2)
    centre = np.array(scene.near(nominal, 0.2))
    start = max(diameter / 2 - scene.away, 0.0) if inside else diameter / 2 + scene.away
    hit = []
    for which in SIDES:
        way = AHEAD[which] if inside else AHEAD[BACK[which]]
        hit.append(to_round(aside(nominal, start, which), way, centre, real / 2, scene.ball, not inside))
    x, y = (hit[0][0] + hit[1][0]) / 2, (hit[2][1] + hit[3][1]) / 2
    rho = sum(math.dist(each, (x, y)) for each in hit) / 4
    words, higher, found = scene.above(centre[0] + inside * diameter, centre[1])
    words = scene.common(X=nominal[0], Y=nominal[1], D=diameter, U=scene.new[0], V=scene.new[1], **words)
    says = {"diameter": 2 * (rho + scene.ball if inside else rho - scene.ball), "centre X": x, "centre Y": y} | higher
    found |= {0: (x, scene.new[0]), 1: (y, scene.new[1])}
    return Case(words, disc(centre, real, scene.top, not inside), says, found)


def corner_of(hits, ways, ball):
    """Where two lines cross, each through two ball centres and moved by the ball to the material; the angle of the first."""
    normals, sums = [], []
    for (one, other), way in zip(hits, ways):
        along = other - one
        normal = np.array([-along[1], along[0]]) / np.linalg.norm(along)
        normal *= np.sign(normal @ way)
        normals.append(normal)
        sums.append(normal @ one + ball)
    (ax, ay), (bx, by) = normals
    c, d = sums
    det = ax * by - ay * bx
    run, rise = hits[0][1] - hits[0][0]
    return ((c * by - ay * d) / det, (ax * d - c * bx) / det), math.degrees(math.atan(rise / run))


SIZE = (100.0, 70.0)


def corner_case(scene, starts, ways, sides, inside, centre, angle, words):
    """The corner from four starts; `sides` name the walls of points 1, 2 and of points 3, 4."""
    out = walls(centre, SIZE, angle)
    hit = []
    for pair, way, which in zip(starts, ways, sides):
        point, normal = out[which]
        hit.append([to_wall(start, way, (point, -normal if inside else normal), scene.ball) for start in pair])
    (x, y), phi = corner_of(hit, np.array(ways), scene.ball)
    rotate = int(scene.rng.integers(2))
    more, says, found = scene.above(*((centre[0] + 90, centre[1]) if inside else centre))
    words = scene.common(E=rotate, U=scene.new[0], V=scene.new[1], **words, **more)
    says |= {"corner X": x, "corner Y": y, "angle": phi}
    found |= {0: (x, scene.new[0]), 1: (y, scene.new[1])}
    return Case(words, box(centre, SIZE, angle, scene.top, not inside), says, found, phi if rotate and scene.apply else None)


def outside_corner(scene):
    x0, y0 = scene.place()
    sx, sy = scene.rng.choice([-1, 1], 2).tolist()
    middle = scene.near((x0 + 50, y0 + 35), 0.3)
    one, two = (x0 + 20, y0 + (0 if sy > 0 else 70)), (x0 + (0 if sx > 0 else 100), y0 + 15)
    words = {"X": one[0], "Y": one[1], "A": 50, "C": two[0], "D": two[1], "B": 35}
    a = scene.away
    first = [np.array((one[0] + d, one[1] - sy * a)) for d in (0, 50)]
    second = [np.array((two[0] - sx * a, two[1] + d)) for d in (0, 35)]
    sides = "-Y" if sy > 0 else "+Y", "-X" if sx > 0 else "+X"
    return corner_case(scene, (first, second), ((0.0, sy), (sx, 0.0)), sides, False, middle, scene.some(-1.5, 1.5), words)


def inside_corner(scene):
    x0, y0 = scene.place()
    number = int(scene.rng.integers(1, 5))
    ux, uy = {1: (1, 1), 2: (-1, 1), 3: (-1, -1), 4: (1, -1)}[number]
    middle = scene.near((x0, y0), 0.3)
    x, y = round(x0 - ux * (50 - 13), 3), y0 - uy * 35
    words = {"X": x, "Y": y, "A": 50, "B": 40, "C": number}
    a = scene.away
    first = [np.array((x + d, y + uy * a)) for d in (0, ux * 50)]
    second = [np.array((x, y + uy * a)), np.array((x, y + uy * 40))]
    sides = "-Y" if uy > 0 else "+Y", "-X" if ux > 0 else "+X"
    return corner_case(scene, (first, second), ((0.0, -uy), (-ux, 0.0)), sides, True, middle, scene.some(-1.2, 1.2), words)


def surface(scene):
    x, y = scene.place()
    words = scene.common(X=x, Y=y, Z=0, R=scene.new[2])
    words.pop("P")
    part = box((x, y), (80, 80), scene.some(-40, 40), scene.top)
    return Case(words, part, {"Z": scene.top}, {2: (scene.top, scene.new[2])})


def side(scene):
    k, sense = int(scene.rng.integers(2)), int(scene.rng.choice([-1, 1]))
    point, angle = np.array(scene.place()), scene.some(-20, 20)
    way = np.array([(sense, 0.0), (0.0, sense)][k])
    wall = walls((0, 0), (120, 120), angle)[{v: n for n, v in AHEAD.items()}[tuple(-way + 0.0)]]
    centre = tuple(np.array(scene.near(point)) - wall[0])
    found = to_wall(point - scene.away * way, way, (wall[0] + centre, wall[1]), scene.ball)[k] + sense * scene.ball
    words = scene.common(X=point[0], Y=point[1], L=k + 1, K=sense, U=scene.new[0])
    words.pop("P")
    return Case(words, box(centre, (120, 120), angle, scene.top), {"XY"[k]: found}, {k: (found, scene.new[0])})


CYCLES = {
    "G408": lambda scene: slot_or_ridge(scene, True),
    "G409": lambda scene: slot_or_ridge(scene, False),
    "G410": lambda scene: box_figure(scene, True),
    "G411": lambda scene: box_figure(scene, False),
    "G412": lambda scene: round_figure(scene, True),
    "G413": lambda scene: round_figure(scene, False),
    "G414": outside_corner,
    "G415": inside_corner,
    "G417": surface,
    "G419": side,
}


def block(code, words):
    return " ".join([code, *(f"{letter}{value:.4f}" for letter, value in words.items())])


def stands(scene, found, turned):
    """The datum, the shift and the base rotation that the cycle makes of what it found: "datum from measurement"."""
    base, shift, datum = scene.base, scene.shift, np.array(DATUM)
    after, flat, new = base + (turned or 0.0), datum.copy(), scene.new
    if 0 in found and 1 in found:
        c = np.array([found[0][0], found[1][0]])
        flat[:2] += turn(base) @ (c + shift[:2]) - turn(after) @ (new[0], new[1])
    else:
        for k in found.keys() & {0, 1}:
            e = np.eye(2)[k]
            flat[:2] += turn(base) @ ((found[k][0] + shift[k] - found[k][1]) * e)
    if 2 in found:
        flat[2] += found[2][0] + shift[2] - found[2][1]
    return flat, np.where([k in found for k in range(3)], 0.0, shift), after


@pytest.mark.parametrize("code", CYCLES)
def test_a_datum_of_random_parts(code):
    for seed in range(PARTS):
        scene = Scene(1000 * int(code[1:]) + seed)
        case = CYCLES[code](scene)
        text = f"{block(code, case.words)}\nG0 X1 Y2 Z30\n"
        run = measured(text, case.part, scene.ball, scene.before, scene.frame, datums={1: DATUM, 7: ROW})
        assert run.ok, (seed, run.alarms, text)
        for what, value in case.says.items():
            assert run.measured[what] == pytest.approx(value, **EXACT), (seed, what)
        if "angle" in case.says:
            assert run.measured["angle"] == pytest.approx(case.says["angle"], **ANGLE), seed

        datum, shift, base = stands(scene, case.found, case.turned)
        columns = set(case.found) if len({0, 1} & set(case.found)) != 1 or not scene.base else {0, 1} | set(case.found)
        expected = [datum[k] if k in columns else ROW[k] for k in range(3)]
        assert run.tables.datums[7][:3] == pytest.approx(expected if scene.row else ROW[:3], **EXACT), seed
        turned = case.turned is not None and scene.row
        assert run.tables.datums[7].rotation == pytest.approx(base if turned else 0, **ANGLE), seed

        if not scene.apply:
            datum, shift, base = np.array(DATUM), scene.shift, scene.base
        assert working(run) == pytest.approx(datum, **EXACT), seed
        assert base_of(run) == pytest.approx(math.remainder(base, 360), **ANGLE), seed
        place = datum + at((0, 0, 0), base)[:3, :3] @ ((1, 2, 30) + shift)
        assert run.toolpath.end[-1] + run.toolpath.origin == pytest.approx(place, **EXACT), seed
        assert run.at(line=6).position == pytest.approx((1, 2, 30), **EXACT), seed
        part = case.part.placed(scene.frame)
        assert gaps(run, part, scene.ball)[: len(rows_of(run, 5)) - len(run.touches) + 1].min() > -1e-6, seed


def test_an_alignment_of_random_parts():
    """Both centres stand r off one straight side, so that its angle is theirs; it counts without the earlier base rotation."""
    for seed in range(PARTS):
        scene = Scene(seed)
        k, sense, angle = int(scene.rng.integers(2)), int(scene.rng.choice([-1, 1])), scene.some(-25, 25)
        way = np.array([(sense, 0.0), (0.0, sense)][k])
        centre = scene.place()
        out = walls(centre, (120, 90), angle)
        point, normal = out[{v: n for n, v in AHEAD.items()}[tuple(-way + 0.0)]]
        along = np.array((-normal[1], normal[0]))
        apart = scene.some(-38, -10), scene.some(5, 38)
        points = [np.round(point + along * far + way * scene.some(-0.4, 0.4), 3) for far in apart]
        reference = scene.some(-360, 360)
        words = scene.common(X=points[0][0], Y=points[0][1], U=points[1][0], V=points[1][1], L=k + 1, K=sense, E=reference)
        words.pop("S")
        part, text = box(centre, (120, 90), angle, scene.top), f"{block('G400', words)}\nG0 X1 Y2 Z30\n"
        frame = at(DATUM) @ at(scene.shift)
        run = measured(text, part, scene.ball, scene.before, frame, datums={1: DATUM, 7: ROW})
        assert run.ok, (seed, run.alarms, text)
        measured_angle = angle if k else angle + 90
        base = (measured_angle - reference) % 180
        base -= 180 * (base > 90)
        assert run.measured["angle"] == pytest.approx(measured_angle, **ANGLE), seed
        assert run.measured["base rotation"] == pytest.approx(base, **ANGLE), seed
        assert base_of(run) == pytest.approx(base, **ANGLE), seed
        assert run.tables.datums[7] == pytest.approx(ROW._replace(rotation=base if scene.row else 0), **ANGLE), seed
        assert working(run) == pytest.approx(DATUM, **EXACT)
        place = DATUM + at((0, 0, 0), base)[:3, :3] @ ((1, 2, 30) + scene.shift)
        assert run.toolpath.end[-1] + run.toolpath.origin == pytest.approx(place, **EXACT), seed
        askew = [alarm for alarm in run.alarms if "turns the plane" in alarm.message]
        assert len(askew) == (abs(base) > 45), seed
        assert gaps(run, part.placed(frame), scene.ball)[: len(rows_of(run, 5)) - len(run.touches) + 1].min() > -1e-6, seed


def test_a_given_base_rotation():
    """G404 replaces an earlier one, whatever it was, and stands in the row: machine = D + Rot_E(p + s)."""
    for seed in range(PARTS):
        scene = Scene(seed)
        angle = scene.some(-360, 360)
        run = measured(f"G404 E{angle} W{7 * scene.row}\nG0 X1 Y2 Z30\n", None, 3, scene.before, datums={1: DATUM, 7: ROW})
        assert run.ok, run.alarms
        assert base_of(run) == pytest.approx(math.remainder(angle, 360), **ANGLE)
        assert run.tables.datums[7] == pytest.approx(ROW._replace(rotation=angle if scene.row else 0), **ANGLE)
        place = DATUM + at((0, 0, 0), angle)[:3, :3] @ ((1, 2, 30) + scene.shift)
        assert run.toolpath.end[-1] + run.toolpath.origin == pytest.approx(place, **EXACT)
        assert run.at(line=6).position == pytest.approx((1, 2, 30), **EXACT)

"""Random programs with rotation, polar coordinates, G92 by increments and the datum function: writes motion_more.json.

    python3 tests/authorities/generate_more.py

Built on generate_motion.py. RS-274 says by other means what MNC says: G39 becomes `G10 L2 .. R` with the offset that
keeps the pole in place, G16 becomes `G52` with `@` radius and `^` angle, or the Cartesian words of a polar point are
expressions; U V W of G92 and a turned point for G53 are expressions too, so that LinuxCNC does the arithmetic.
After a switch of G38/G39 MNC keeps the programmed coordinates and RS-274 reads the place anew: the next motion writes
both axes absolutely, and then they mean the same.
"""

import math

from generate_motion import ARCS, LINES, PLANE_CODE, Program, generate
from recording import AXES, TICKS, decimal

SEED = 20151207
EACH = 16  # programs of each family

TURNS = {"rotate": 3, "unrotate": 1}
POLAR = {"polar": 5, "line": 1, "rapid": 1}
FAMILIES = {
    "shifts": LINES | {"radius": 2, "centre": 2, "local_system": 5, "machine": 2, "choose_plane": 1},
    "table": ARCS | {"work_offset": 6, "local_system": 2, "machine": 1},
    "turned": ARCS | TURNS,
    "turned_offsets": LINES | TURNS | {"radius": 2, "centre": 2, "work_offset": 3, "local_system": 3, "machine": 2},
    "turned_planes": ARCS | TURNS | {"choose_plane": 5, "helix": 3, "machine": 1},
    "polar_xy": POLAR,
    "polar_zx": POLAR,
    "polar_yz": POLAR,
    "polar_turned": POLAR | TURNS | {"work_offset": 2},
    "everything": ARCS | TURNS | POLAR | {"choose_plane": 3, "work_offset": 3, "local_system": 3, "machine": 2},
}
PLANE_OF = {"polar_zx": "ZX", "polar_yz": "YZ"}
NOT_KNOWN = float("nan")


def turned(point, turn, back=False):
    """A point turned about the pole of G39, or turned back; `turn` is pole and angle, or None."""
    if turn is None:
        return list(point)
    (first, second), angle = turn[0], math.radians(turn[1] / TICKS) * (-1 if back else 1)
    x, y, c, s = point[0] - first, point[1] - second, math.cos(angle), math.sin(angle)
    return [first + x * c - y * s, second + x * s + y * c, point[2]]


class More(Program):
    """A program whose account `at` is in the coordinates of the program; `placing` takes it to the machine."""

    families = FAMILIES

    def begin(self):
        self.plane = PLANE_OF.get(self.family, "XY")
        self.local = [0, 0, 0]  # shift of G92
        self.g92 = False  # whether RS-274 has it in its own G92; else in the offset of G10
        self.turn = None  # pole and angle (ticks, degrees in ticks) of G39
        self.rs274 += ["%", "G21 G17 G90 G94 G40 G49 G80 G64"]
        self.datums = {row: [self.somewhere(200) for _ in range(3)] for row in sorted(self.rng.sample(range(1, 7), 3))}
        self.row = self.rng.choice(list(self.datums))
        self.rs274.append(self.offset(self.row))
        self.write([("G", PLANE_CODE[self.plane]), ("G", 90), ("G", 53 + self.row)])
        self.at = [NOT_KNOWN] * 3
        self.position(range(3))

    # Where a point of the program stands.

    def zero(self):
        return [a + b for a, b in zip(self.datums[self.row], self.local, strict=True)]

    def placing(self, machine=False):
        turn, zero = self.turn, [0] * 3 if machine else self.zero()
        return lambda point: [(a + b) / TICKS for a, b in zip(turned(point, turn), zero, strict=True)]

    def reread(self, tip):
        """The program's coordinates of a place on the machine (mm): an axis that is not written stays."""
        local = [v * TICKS - b for v, b in zip(tip, self.zero(), strict=True)]
        self.at = turned(local, self.turn, back=True)

    def offset(self, row):
        """The RS-274 block that gives a work offset its place, its shift if G92 has none, and its turn."""
        local = [0] * 3 if self.g92 or row != self.row else self.local
        x, y, z = (f"[{decimal(a + b)}]" for a, b in zip(self.datums[row], local, strict=True))
        angle = "0"
        if self.turn is not None:
            (u, v), angle = [f"[{decimal(k)}]" for k in self.turn[0]], decimal(self.turn[1])
            c, s = f"COS[{angle}]", f"SIN[{angle}]"
            x, y = f"[{x}+{u}-[{u}*{c}-{v}*{s}]]", f"[{y}+{v}-[{u}*{s}+{v}*{c}]]"
        return f"G10 L2 P{row} X{x} Y{y} Z{z} R{angle}"

    # Blocks of the families.

    def move(self, code, target, arc=(), first=()):
        """Words are whole ticks also where the account is not; a circle ends exactly where it begins."""
        zero = [0 if self.absolute else v for v in self.at]
        target = {axis: zero[axis] + round(v - zero[axis]) for axis, v in target.items()}
        target = {axis: v for axis, v in target.items() if not arc or not 0 < abs(v - self.at[axis]) < 1}
        super().move(code, target, arc, first)

    def position(self, axes=(0, 1)):
        """A move to an absolute point in these axes."""
        if not self.absolute:
            self.absolute = True
            self.write([("G", 90)])
        self.move(self.rng.choice([0, 1]), {axis: self.somewhere(80) for axis in axes})

    def settle(self):
        """G words that wait for a motion get a block of their own."""
        for word in self.waiting:
            self.write([word])
        self.waiting = []

    def rotate(self):
        """G39 in XY, about a pole or the origin."""
        pole = self.rng.choice([(0, 0), (self.somewhere(40), 0), (self.somewhere(40), self.somewhere(40))])
        angle = self.rng.choice([self.rng.randint(-270, 270) * TICKS, self.rng.randint(-180 * TICKS, 180 * TICKS)])
        words = [(a, v) for a, v in zip("XY", pole, strict=True) if v or self.rng.random() < 0.4]
        self.switch((pole, angle), [("G", 39), *words, ("A", angle)])

    def unrotate(self):
        if self.turn is not None:
            self.switch(None, [("G", 38)])

    def switch(self, turn, words):
        """Another turn: RS-274 takes a shift of G92 into the offset, so it must be a decimal number."""
        self.settle()
        if not all(v == int(v) for v in self.local):
            self.work_offset()
        plane = self.plane
        if turn is not None and plane != "XY":
            self.plane = "XY"
            self.write([("G", 17)])
        if self.g92:
            self.rs274.append("G92.1")
            self.g92 = False
        self.turn = turn
        self.write(words, self.offset(self.row))
        self.at = [NOT_KNOWN, NOT_KNOWN, self.at[2]]
        if plane != self.plane:
            self.plane = plane
            self.write([("G", PLANE_CODE[plane])])
        self.position()

    def work_offset(self):
        """G54 to G59 or G147; RS-274 ends G92 and turns the new system like the old one."""
        self.settle()
        tip = self.placing()(self.at)
        row = self.rng.choice(list(self.datums))
        if self.g92:
            self.rs274.append("G92.1")
        self.g92, self.local, self.row = False, [0, 0, 0], row
        self.rs274.append(self.offset(row))
        words = [("G", 147), ("Q", row * TICKS)] if self.rng.random() < 0.5 else [("G", 53 + row)]
        self.write(words, f"G{53 + row}")
        self.reread(tip)

    def local_system(self):
        """G92 by coordinates and by increments, turned in both axes."""
        self.settle()
        tip, point = self.placing()(self.at), list(self.at)
        axes = self.some_axes()
        if self.turn is not None:
            axes = sorted({0, 1, *axes})
        words, other = [], []
        for axis in axes:
            value = self.somewhere(100)
            if self.rng.random() < 0.5:
                words.append(("UVW"[axis], value))
                other.append(f"{'XYZ'[axis]}[#{5420 + axis}-[{decimal(value)}]]")
                point[axis] -= value
            else:
                words.append(("XYZ"[axis], value))
                other.append("XYZ"[axis] + decimal(value))
                point[axis] = value
        self.write([("G", 92), *words], "G92 " + " ".join(other))
        self.g92 = True
        inner, datum = turned(point, self.turn), self.datums[self.row]
        for axis in axes:
            shift = tip[axis] * TICKS - inner[axis] - datum[axis]
            self.local[axis] = round(shift) if abs(shift - round(shift)) < 1e-5 else shift
        self.at = point

    def machine(self):
        """G53, also under G91; a turned point is an expression of RS-274."""
        self.settle()
        axes = range(3) if self.turn is not None else sorted(self.some_axes())
        tip = [v * TICKS for v in self.placing()(self.at)]
        point, code = turned(tip, self.turn, back=True), self.rng.choice([0, 1])
        for axis in axes:
            point[axis] = self.somewhere(100)
        words = [("XYZ"[axis], point[axis]) for axis in axes]
        values = {axis: decimal(round(point[axis])) for axis in axes}
        if self.turn is not None:
            (x, y), angle = [decimal(v) for v in self.turn[0]], decimal(self.turn[1])
            u, v = f"[[{values[0]}]-[{x}]]", f"[[{values[1]}]-[{y}]]"
            values[0] = f"[[{x}]+{u}*COS[{angle}]-{v}*SIN[{angle}]]"
            values[1] = f"[[{y}]+{u}*SIN[{angle}]+{v}*COS[{angle}]]"
        feed = self.new_feed(code)
        other = [f"G53 G{code}", *("XYZ"[axis] + values[axis] for axis in axes), *(f"F{decimal(v)}" for _, v in feed)]
        if not self.absolute:
            self.rs274.append("G90")
        self.write([("G", 53), ("G", code), *words, *feed], " ".join(other))
        if not self.absolute:
            self.rs274.append("G91")
        self.modal = code
        place = self.placing(machine=True)
        self.plan(code, (), point, place)
        self.reread(place(point))

    def choose_plane(self):
        self.settle()
        super().choose_plane()

    # Polar coordinates.

    def polar(self):
        """G16, some polar and other moves, G15."""
        self.settle()
        first, second, normal = AXES[self.plane]
        self.pole = [0 if axis == normal else self.rng.choice([0, 1, 1]) * self.somewhere(40) for axis in range(3)]
        self.radial = self.plane == "XY" and not self.g92 and self.rng.random() < 0.8  # whether RS-274 has G52 @ ^
        words = [("XYZ"[k], self.pole[k]) for k in sorted((first, second)) if self.pole[k] or self.rng.random() < 0.5]
        x, y = decimal(self.pole[0]), decimal(self.pole[1])
        self.write([("G", 16), *words], f"G52 X{x} Y{y}" if self.radial else "(pole)")
        self.cartesian_modal, self.place = True, None
        for _ in range(self.rng.randint(2, 5)):
            known = self.place is not None
            if not known and not self.absolute and not (self.radial and self.rng.random() < 0.7):
                self.toggle()
            kinds = {self.straight: 4, self.about_pole: 2 * known, self.by_radius: 2, self.cartesian: 1, self.toggle: 1}
            self.rng.choices(list(kinds), list(kinds.values()))[0]()
        self.write([("G", 15)], "G52 X0 Y0" if self.radial else "(no pole)")

    def toggle(self):
        self.absolute = not self.absolute
        self.write([("G", 90 if self.absolute else 91)])

    def now(self):
        """Radius and angle (ticks) of the present point, and whether they are decimal numbers."""
        if self.place is not None:
            return self.place
        first, second, _ = AXES[self.plane]
        u, v = self.at[first] - self.pole[first], self.at[second] - self.pole[second]
        return math.hypot(u, v), math.degrees(math.atan2(v, u)) * TICKS

    def goal(self):
        """Another radius and angle, and the words that lead there."""
        (radius, angle), grid = self.now(), self.grid
        letters = {"RA"} if self.place is None and self.absolute else {"R", "A", "RA"}
        letters = self.rng.choice(sorted(letters))
        new_radius = self.rng.randint(5 * TICKS // grid, 60 * TICKS // grid) * grid
        new_angle = self.rng.choice([self.rng.randint(-12, 24) * 15 * TICKS, self.somewhere(300)])
        if not self.absolute:
            new_radius, new_angle = radius + round(new_radius - radius), angle + round(new_angle - angle)
        radius, angle = (new_radius if "R" in letters else radius), (new_angle if "A" in letters else angle)
        return (radius, angle), letters

    def straight(self):
        """G10 and G11, now and then with the third axis."""
        goal, letters = self.goal()
        self.polar_block(self.rng.choice([0, 1, 1]), goal, letters)

    def about_pole(self):
        """G12 and G13 with K equal to the radius; the whole circle without R and A."""
        (radius, angle), (_, new_angle) = self.now(), self.goal()[0]
        letters = self.rng.choice(["A", "RA"]) if self.absolute else "A"
        if radius < TICKS or not 5 < (new_angle - angle) / TICKS % 360 < 355:
            letters, new_angle = "", angle
        first, second, _ = AXES[self.plane]
        vector = {"IJK"[axis]: self.pole[axis] - self.at[axis] for axis in (first, second)}
        size, at = f"[{decimal(radius)}]", f"[{decimal(angle)}]"
        other = [f"{'IJK'[axis]}[0-{size}*{f}{at}]" for axis, f in zip((first, second), ("COS", "SIN"), strict=True)]
        if radius >= TICKS:
            self.polar_block(self.rng.choice([2, 3]), (radius, new_angle), letters, vector, radius, other)

    def by_radius(self):
        """G12 and G13 about another centre than the pole."""
        goal, letters = self.goal()
        chord = math.dist(self.at, self.point(goal))
        size = self.on_grid(chord / TICKS / self.rng.uniform(0.15, 1.85))
        if 0.1 * size < chord < 1.9 * size and max(abs(size - self.now()[0]), abs(size - goal[0])) > TICKS:
            size *= self.rng.choice([1, 1, -1])
            self.polar_block(self.rng.choice([2, 3]), goal, letters, {"R": size}, size, ["R" + decimal(size)])

    def point(self, place):
        """The point of a radius and an angle."""
        first, second, _ = AXES[self.plane]
        end, turn = list(self.at), math.radians(place[1] / TICKS)
        end[first] = self.pole[first] + place[0] * math.cos(turn)
        end[second] = self.pole[second] + place[0] * math.sin(turn)
        return end

    def polar_block(self, code, goal, letters, arc=(), size=None, other=()):
        """One polar block: in RS-274 radius and angle, or the point as expressions."""
        if not self.radial and not self.absolute and self.place is None:
            return  # nothing decimal to write
        first, second, normal = AXES[self.plane]
        radius, angle = goal
        zero = (0, 0) if self.absolute else self.now()
        values = {"R": round(radius - zero[0]), "A": round(angle - zero[1])}
        end = self.point(goal) if letters else list(self.at)
        third = []
        if self.rng.random() < 0.15:
            value = self.somewhere(40)
            end[normal] = value if self.absolute else self.at[normal] + value
            third = ["XYZ"[normal] + decimal(value)]
        feed = self.new_feed(code)
        tail = [*other, *(f"F{decimal(v)}" for _, v in feed)]
        words = [("G", 10 + code)] if code != self.modal or self.cartesian_modal or self.rng.random() < 0.3 else []
        words += [(letter, values[letter]) for letter in letters]
        words += [(third[0][0], value)] if third else []
        words += [("K", size * self.rng.choice([1, -1] if "R" not in arc else [1]))] if size else []
        if self.radial:
            written = letters if not self.absolute or not letters else "RA"
            place = ["@^"["RA".index(letter)] + decimal(values[letter]) for letter in written]
            self.write([*words, *feed], " ".join([f"G{code}", *place, *third, *tail]))
        else:
            size, at = f"[{decimal(round(radius))}]", f"[{decimal(round(angle))}]"
            place = [
                f"{'XYZ'[axis]}[[{decimal(self.pole[axis])}]+{size}*{f}{at}]"
                for axis, f in zip((first, second), ("COS", "SIN"), strict=True)
            ]
            third = [f"{'XYZ'[normal]}{end[normal] / TICKS:.13f}"] if third else []  # it may be no decimal number
            self.rs274 += [] if self.absolute else ["G90"]
            self.write([*words, *feed], " ".join([f"G{code}", *(place if letters else []), *third, *tail]))
            self.rs274 += [] if self.absolute else ["G91"]
        self.modal, self.cartesian_modal = code, False
        self.place = (round(radius), round(angle)) if self.absolute or self.place is not None else None
        self.plan(code, arc, end)

    def cartesian(self):
        """G0 and G1 between polar blocks; G52 has moved the origin of RS-274."""
        code, words, other, end = self.rng.choice([0, 1]), [], [], list(self.at)
        for axis in sorted(self.some_axes()):
            value = self.somewhere(60)
            end[axis] = value if self.absolute else self.at[axis] + value
            words.append(("XYZ"[axis], value))
            other.append("XYZ"[axis] + decimal(value - self.pole[axis] if self.radial and self.absolute else value))
        feed = self.new_feed(code)
        self.write([("G", code), *words, *feed], " ".join([f"G{code}", *other, *(f"F{decimal(v)}" for _, v in feed)]))
        self.modal, self.cartesian_modal, self.place = code, True, None
        self.plan(code, (), end)


if __name__ == "__main__":
    generate("motion_more.json", SEED, More, EACH)

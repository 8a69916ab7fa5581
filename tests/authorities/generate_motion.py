"""Random programs in what MNC and RS-274 have in common, with LinuxCNC's motion: writes motion.json.

generate_more.py builds on it.

    python3 tests/authorities/generate_motion.py

Every program is written twice, in MNC and in RS-274. The generator keeps its own account of where each block
must lead and stops when LinuxCNC disagrees: then the two texts do not mean the same thing.
"""

import math
import random

from recording import AXES, TICKS, ask, decimal, motion, save

SEED = 20151201
EACH = 20  # programs of each family

# The blocks of a family (methods of Program), by weight.
LINES = {"rapid": 2, "line": 5, "dimensions": 2}
ARCS = {"rapid": 1, "line": 2, "radius": 6, "centre": 6, "circle": 2, "dimensions": 2}
FAMILIES = {
    "lines": LINES,
    "arcs_xy": ARCS,
    "arcs_zx": ARCS,
    "arcs_yz": ARCS,
    "helices": {"rapid": 1, "line": 1, "helix": 8, "choose_plane": 2, "dimensions": 2},
    "planes": ARCS | {"choose_plane": 7},
    "local": LINES | {"radius": 2, "centre": 2, "local_system": 4},
    "datums": LINES | {"radius": 2, "centre": 2, "work_offset": 4, "machine": 2},
    "mixed": ARCS | {"helix": 4, "choose_plane": 3, "local_system": 4, "work_offset": 4, "machine": 3},
}
PLANE_OF = {"arcs_zx": "ZX", "arcs_yz": "YZ"}
PLANE_CODE = {"XY": 17, "ZX": 18, "YZ": 19}


class Spelling:
    """How one program writes its words: case, blanks, zeros, signs, order."""

    def __init__(self, rng):
        self.rng = rng
        self.lower = rng.random() < 0.25
        self.blank = rng.choice(["", " ", " ", "  "])
        self.plain = rng.random() < 0.3
        self.two_digits = rng.random() < 0.5
        self.shuffled = rng.random() < 0.25
        self.numbered = rng.random() < 0.5

    def value(self, address, value):
        if address in "GM":
            two_digits = self.two_digits and self.rng.random() < 0.8
            return f"{value:02d}" if two_digits else str(value)
        text = self.number(value)
        if address not in "FS" and value >= 0 and not self.plain and self.rng.random() < 0.15:
            text = "+" + text  # MNC allows a sign only where the word describes motion
        return text

    def number(self, ticks):
        text = decimal(ticks)
        if self.plain:
            return text
        sign, digits = ("-", text[1:]) if ticks < 0 else ("", text)
        chance = self.rng.random
        if digits.startswith("0.") and chance() < 0.4:
            digits = digits[1:]
        elif chance() < 0.1:
            digits = self.rng.choice(["0", "00"]) + digits
        if "." not in digits and chance() < 0.3:
            digits += self.rng.choice([".", ".0"])
        elif "." in digits and len(digits.partition(".")[2]) < 4 and chance() < 0.1:
            digits += "0"
        return sign + digits

    def block(self, words):
        """The text of a block from pairs of address and value (of G and M the number, else ticks)."""
        words = list(words)
        if self.shuffled:
            self.rng.shuffle(words)
        text = self.blank.join(address + self.value(address, value) for address, value in words)
        return text.lower() if self.lower else text


class Program:
    """One program growing in both languages, and the account of the motion that it must make."""

    families = FAMILIES

    def __init__(self, rng, family):
        self.rng, self.family = rng, family
        self.spelling = Spelling(rng)
        self.grid = rng.choice([1, 1, 10, 100])  # 4, 3 or 2 decimals
        self.mnc, self.rs274, self.line_of = [], [], {}
        self.planned = []
        self.datums = {}
        self.at = [0, 0, 0]  # machine coordinates, ticks
        self.datum, self.shift = [0, 0, 0], [0, 0, 0]
        self.absolute, self.plane = True, PLANE_OF.get(family, "XY")
        self.modal, self.feed = None, None
        self.waiting = []  # G words to be written with the next motion
        self.begin()
        for _ in range(rng.randint(10, 24)):
            self.step()
        self.rs274 += ["M2", "%"]

    # Writing.

    def write(self, words, rs274=None):
        """One block in both texts; `rs274` where the other language writes it differently."""
        text = self.spelling.block(words)
        if self.spelling.numbered:
            label = "N" + str(5 * len(self.mnc) + 5)
            text = (label.lower() if self.spelling.lower else label) + self.spelling.blank + text
        self.mnc.append(text)
        self.rs274.append(rs274 or text)
        self.line_of[len(self.rs274)] = len(self.mnc)
        if self.rng.random() < 0.05:
            self.mnc[-1] += " // a remark"

    def begin(self):
        self.rs274 += ["%", "G21 G17 G90 G94 G40 G49 G80 G64"]
        head = []
        if self.plane != "XY" or self.rng.random() < 0.8:
            head.append(("G", PLANE_CODE[self.plane]))
        if self.rng.random() < 0.8:
            head.append(("G", 90))
        if "work_offset" in self.families[self.family]:
            for row in sorted(self.rng.sample(range(1, 7), 3)):
                self.datums[row] = [self.somewhere(300) for _ in range(3)]
                words = " ".join(a + decimal(v) for a, v in zip("XYZ", self.datums[row], strict=True))
                self.rs274.append(f"G10 L2 P{row} {words}")
            row = self.rng.choice(list(self.datums))
            self.datum = self.datums[row]
            head.append(("G", 53 + row))
        elif self.rng.random() < 0.7:
            head.append(("G", 54))
        if head:
            self.write(head)
        if self.rng.random() < 0.3:
            self.write([("S", 1200 * TICKS), ("M", 3)])
        self.move(0, {axis: self.somewhere(80) for axis in range(3)})

    def step(self):
        """One more block of the family's kinds."""
        does = self.families[self.family]
        getattr(self, self.rng.choices(list(does), list(does.values()))[0])()

    # Random values.

    def somewhere(self, reach):
        """A random coordinate or distance on the program's grid, `reach` in mm."""
        return self.rng.randint(-reach * TICKS // self.grid, reach * TICKS // self.grid) * self.grid

    def nudge(self):
        """A random distance that is no zero."""
        return self.somewhere(60) or 7 * self.grid

    def on_grid(self, mm):
        return round(mm * TICKS / self.grid) * self.grid

    def some_axes(self):
        return self.rng.sample(range(3), self.rng.choice([1, 2, 2, 3]))

    # Blocks without motion.

    def now_or_then(self, code):
        """A modal G word in a block of its own, or together with the next motion."""
        if self.rng.random() < 0.5:
            self.write([("G", code)])
        else:
            self.waiting.append(("G", code))

    def dimensions(self):
        if not any(value in (90, 91) for _, value in self.waiting):
            self.absolute = not self.absolute
            self.now_or_then(90 if self.absolute else 91)

    def choose_plane(self):
        if not any(value in (17, 18, 19) for _, value in self.waiting):
            self.plane = self.rng.choice([p for p in AXES if p != self.plane])
            self.now_or_then(PLANE_CODE[self.plane])

    def local_system(self):
        """G92: this point gets new coordinates."""
        words = []
        for axis in sorted(self.some_axes()):
            value = self.somewhere(100)
            self.shift[axis] = self.at[axis] - self.datum[axis] - value
            words.append(("XYZ"[axis], value))
        self.write([("G", 92), *words])

    def work_offset(self):
        """G54 to G59. In MNC it ends G92, in RS-274 `G92.1` must do so."""
        row = self.rng.choice(list(self.datums))
        if any(self.shift):
            self.rs274.append("G92.1")
        self.datum, self.shift = self.datums[row], [0, 0, 0]
        if self.rng.random() < 0.5:
            self.write([("G", 53 + row)])
        else:
            self.waiting.append(("G", 53 + row))
            self.rng.choice([self.rapid, self.line])()

    # Blocks with motion.

    def rapid(self):
        self.move(0, {axis: self.at[axis] + self.nudge() for axis in self.some_axes()})

    def line(self):
        self.move(1, {axis: self.at[axis] + self.nudge() for axis in self.some_axes()})

    def machine(self):
        """G53: a point of the machine, in one block. RS-274 wants G0 or G1 with it, and G90."""
        if self.absolute:
            target = {axis: self.somewhere(100) for axis in self.some_axes()}
            self.datum, datum, self.shift, shift = [0, 0, 0], self.datum, [0, 0, 0], self.shift
            self.move(self.rng.choice([0, 1]), target, first=[("G", 53)])
            self.datum, self.shift = datum, shift

    def radius(self, normal=None):
        """An arc by R: the chord from 0.1 to 1.9 R, where the centre is well determined."""
        first, second, _ = AXES[self.plane]
        chord = self.rng.choice([(self.nudge(), self.somewhere(60)), (self.nudge(), 0), (0, self.nudge())])
        length = math.hypot(*chord)
        radius = self.on_grid(length / TICKS / self.rng.uniform(0.15, 1.85))
        if not 0.1 * radius < length < 1.9 * radius:
            return
        target = {first: self.at[first] + chord[0], second: self.at[second] + chord[1]} | (normal or {})
        radius *= self.rng.choice([1, 1, -1])
        self.move(self.rng.choice([2, 3]), target, arc=[("R", radius)])

    def centre(self, normal=None):
        """An arc by I J K; the end is rounded to the grid and must stay near the circle."""
        first, second, _ = AXES[self.plane]
        i, j = self.somewhere(40), self.somewhere(40)
        if self.rng.random() < 0.2:
            j = 0
        radius, angle = math.hypot(i, j), math.atan2(-j, -i) + self.rng.uniform(0.1, math.tau - 0.1)
        if radius < 2 * TICKS:
            return
        to = [self.on_grid((c + radius * d) / TICKS) for c, d in ((i, math.cos(angle)), (j, math.sin(angle)))]
        if abs(math.hypot(to[0] - i, to[1] - j) - radius) > 0.004 * TICKS:
            return
        target = {first: self.at[first] + to[0], second: self.at[second] + to[1]} | (normal or {})
        self.move(self.rng.choice([2, 3]), target, arc=self.vector(i, j))

    def circle(self, normal=None):
        """A full circle, its end point left out or written."""
        first, second, _ = AXES[self.plane]
        i, j = self.rng.choice([(self.nudge(), 0), (0, self.nudge()), (self.nudge(), self.nudge())])
        target = dict(normal or {})
        if self.rng.random() < 0.4:
            target |= {first: self.at[first], second: self.at[second]}
        self.move(self.rng.choice([2, 3]), target, arc=self.vector(i, j))

    def helix(self):
        normal = AXES[self.plane][2]
        arc = self.rng.choice([self.radius, self.centre, self.centre, self.circle])
        arc({normal: self.at[normal] + self.nudge()})

    def vector(self, i, j):
        """The words I J K of the plane; a zero is mostly left out."""
        words = [("IJK"[axis], value) for axis, value in zip(AXES[self.plane][:2], (i, j), strict=True)]
        return [word for word in words if word[1] or self.rng.random() < 0.3]

    def move(self, code, target, arc=(), first=()):
        """Write a motion block to `target` (axis: machine ticks) and note what it must do."""
        words = [*self.waiting, *first]
        self.waiting = []
        if code != self.modal or self.rng.random() < 0.3:
            words.append(("G", code))
        self.modal = code
        for axis in sorted(target):
            if target[axis] == self.at[axis] and self.rng.random() < 0.5:
                continue  # a coordinate that stays may be left out
            zero = self.datum[axis] + self.shift[axis] if self.absolute else self.at[axis]
            words.append(("XYZ"[axis], round(target[axis] - zero)))
        self.write([*words, *arc, *self.new_feed(code)])
        self.plan(code, arc, [target.get(axis, self.at[axis]) for axis in range(3)])

    def new_feed(self, code):
        """The word F where a block needs it, and now and then."""
        if code and (self.feed is None or self.rng.random() < 0.2):
            self.feed = self.rng.choice([60, 100, 250, 400, 1000, 80.5, 312.25])
            return [("F", round(self.feed * TICKS))]
        return []

    def plan(self, code, arc, end, place=None):
        """Note what the block just written must do: it leads to `end`."""
        row = (len(self.mnc), code, dict(arc), self.at, end, self.plane, self.feed, place or self.placing())
        self.planned.append(row)
        self.at = end

    def placing(self):
        """How a point of the account (ticks) stands on the machine (mm)."""
        return lambda point: [v / TICKS for v in point]

    def check(self, rows):
        """Stop unless the recorded motion is the planned one."""
        for row, (line, code, arc, start, end, plane, feed, place) in zip(rows, self.planned, strict=True):
            assert row["line"] == line
            assert row["kind"] == ("rapid", "line", "arc", "arc")[code]
            assert math.dist(row["to"], place(end)) < 1e-9
            assert code == 0 or math.isclose(row["feed"], feed)
            if code < 2:
                continue
            assert (row["sweep"] > 0) == (code == 3)
            normal = AXES[plane][2]
            above = [v + TICKS * (axis == normal) for axis, v in enumerate(start)]
            assert math.dist(row["axis"], [a - b for a, b in zip(place(above), place(start), strict=True)]) < 1e-9
            if "R" in arc:
                level = [start[axis] if axis == normal else v for axis, v in enumerate(end)]
                for point in (start, level):
                    assert abs(math.dist(place(point), row["centre"]) - abs(arc["R"]) / TICKS) < 1e-9
                assert (abs(row["sweep"]) < math.pi) == (arc["R"] > 0)
            else:
                centre = [v + arc.get(address, 0) for v, address in zip(start, "IJK", strict=True)]
                assert math.dist(row["centre"], place(centre)) < 1e-9


def generate(name, seed, kind, each):
    """Write a file of `each` programs of every family of a kind of Program."""
    rng = random.Random(seed)
    records = []
    for family in kind.families:
        for number in range(1, each + 1):
            program = kind(rng, family)
            rs274 = "\n".join(program.rs274) + "\n"
            answer = ask(rs274)
            assert answer["ok"], (answer, rs274)
            rows = motion(answer, program.line_of)
            program.check(rows)
            record = {"name": f"{family}_{number:02d}", "mnc": "\n".join(program.mnc) + "\n", "rs274": rs274}
            if program.datums:
                record["datums"] = {row: [v / TICKS for v in at] for row, at in program.datums.items()}
            records.append(record | {"motion": rows})
    save(name, seed, records)


if __name__ == "__main__":
    generate("motion.json", SEED, Program, EACH)

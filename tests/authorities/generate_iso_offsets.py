"""Random programs of offsets, rotations and reference points of ISO mills, with LinuxCNC's motion: iso_offsets.json.

    python3 tests/authorities/generate_iso_offsets.py

The programs named `shifted` and `compensated` are the same for both. LinuxCNC has no G68: of those named `turned` it got
one whose work offset is turned by G10 L2 R so that the same point stays where it is, `asked` in the record. Rows of no
length, which LinuxCNC makes where the tool is already, are left out, and so are tool changes (see linuxcnc_oracle.py): the
length of a tool is that of G43.1.
"""

import math
import random

from recording import ask, motion, save

SEED = 54
SYSTEMS = ["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"]


class Writer:
    """Blocks of one random program."""

    def __init__(self, rng, inches=False):
        self.rng, self.unit, self.lines = rng, 25.4 if inches else 1.0, []
        self.metric = not inches and rng.random() < 0.6  # throughout: the module errs in G43.1 where units change
        self.still = "G92.1\n"  # LinuxCNC loses its place where the angle changes under a shift of G92 or G52
        self.lines += [f"G{20 if inches else 21}", f"G17 G90 G94 G40 G49 G80 G54 F{20 if inches else 500}"]

    def number(self, reach=60.0):
        return f"{self.rng.uniform(-reach, reach) / self.unit:.4f}"

    def axes(self, least=1, letters="XYZ"):
        chosen = [axis for axis in letters if self.rng.random() < 0.6]
        if len(chosen) < least:
            chosen = self.rng.sample(letters, least)
        return " ".join(f"{axis}{self.number()}" for axis in chosen)

    def write(self, line):
        self.lines.append(line)

    def move(self):
        self.write(f"{self.rng.choice(('G0', 'G1'))} {self.axes()}")

    def circle(self):
        """A whole circle, in one turn or several, by its centre from the start."""
        first, second = {"G17": "IJ", "G18": "IK", "G19": "JK"}[(plane := self.rng.choice(("G17", "G17", "G18", "G19")))]
        turns = self.rng.choice(("", "", f" P{self.rng.randint(1, 4)}"))
        rise = {"G17": "Z", "G18": "Y", "G19": "X"}[plane]
        helix = f" {rise}{self.number(9)}" if self.rng.random() < 0.4 else ""
        centre = f"{first}{self.rng.choice('-+')}{self.rng.uniform(1, 20) / self.unit:.4f} {second}{self.number(20)}"
        self.write(f"{plane} G{self.rng.choice((2, 3))}{helix} {centre}{turns}")
        self.write("G17")

    def half_circle(self):
        """Half a circle from its start and centre in increments, the numbers of the end twice those of the centre."""
        i, j = (self.rng.randint(10, 300) * self.rng.choice((-1, 1)) / 50 for _ in range(2))
        by_radius = self.rng.random() < 0.4
        shape = f"R{math.hypot(i, j) + 0.5:.4f}" if by_radius else f"I{i} J{j}"
        self.write(f"G91 G{self.rng.choice((2, 3))} X{2 * i:g} Y{2 * j:g} {shape}")
        self.write("G90")

    def absolute_centre(self):
        x, y, r = (self.rng.randint(1, 200) / 10 for _ in range(3))
        self.write(f"G1 X{x} Y{y}")
        self.write(f"G90.1 G{self.rng.choice((2, 3))} X{x + 2 * r:.1f} Y{y} I{x + r:.1f} J{y}")
        self.write("G91.1")

    def offset(self):
        """A change of where coordinates count from."""
        rng = self.rng
        turn = f" R{rng.uniform(-180, 180):.3f}" if rng.random() < 0.4 else ""
        choices = (
            lambda: rng.choice(SYSTEMS),
            lambda: f"{turn and self.still}G10 L2 P{rng.randint(0, 9)} {self.axes(0)}{turn}",
            lambda: f"G10 L20 P{rng.randint(0, 9)} {self.axes()}",
            lambda: f"G92 {self.axes()}",
            lambda: f"G52 {self.axes()}",
            lambda: rng.choice(("G92.1", "G92.2", "G92.3")),
            lambda: f"G43.1 {self.axes()}" if self.metric else "G54",
            lambda: "G49",
            lambda: f"G91\n{rng.choice(('G92', 'G52', 'G10 L2 P0'))} {self.axes()}\nG90",
        )
        for line in rng.choice(choices)().splitlines():
            self.write(line)

    def reference(self):
        """A move in coordinates of the machine, or over a reference point."""
        rng = self.rng
        choices = (
            f"G53 {rng.choice(('G0', 'G1'))} {self.axes()}",
            f"G28 {self.axes(3)}",
            f"G30 {self.axes(3)}",
            "G28",
            f"G91\nG28 Z{self.number(5)}\nG90",
            rng.choice(("G28.1", "G30.1")),
        )
        for line in rng.choice(choices).splitlines():
            self.write(line)

    def increments(self):
        self.write("G91")
        for _ in range(self.rng.randint(1, 3)):
            self.move()
        self.write("G90")

    def inverse_time(self):
        self.write("G93")
        self.write(f"G1 {self.axes()} F{self.rng.randint(1, 50)}")
        self.write("G94 F100")

    def units(self):
        if self.metric:
            return
        inches = self.unit == 1.0
        self.unit = 25.4 if inches else 1.0
        self.write(f"G{20 if inches else 21}")


def shifted(rng):
    """Everything that moves where coordinates count from."""
    w = Writer(rng, inches=rng.random() < 0.4)
    parts = [w.move, w.circle, w.half_circle, w.absolute_centre, w.offset, w.reference, w.increments, w.inverse_time, w.units]
    weights = [6, 2, 2, 1, 8, 2, 2, 1, 1]
    for part in rng.choices(parts, weights, k=18):
        part()
    return w.lines


def compensated(rng):
    """A contour beside a tool, its ends tangent, under a turned work offset."""
    w, side, r = Writer(rng), rng.choice((41, 42)), rng.randint(1, 6)
    w.write(f"G10 L2 P1 {w.axes(2, 'XY')} R{rng.uniform(-180, 180):.3f}")
    w.write(f"G92 {w.axes(1, 'XY')}")
    w.write("G0 X-40 Y0")
    w.write(f"G{side}.1 D{2 * r}")
    x = rng.randint(30, 60)
    w.write("G1 X-20 Y0")
    w.write(f"X{x}")
    y = rng.choice((-1, 1)) * rng.randint(20, 40)
    w.write(f"Y{y}")
    w.write(f"X{x + rng.randint(20, 40)}")
    w.write("G40")
    w.write(f"G0 X{x + 90} Y{y}")
    return w.lines


def turned(rng):
    """G68 about a point under a work offset, and the turned work offset that is the same."""
    w = Writer(rng)
    c = [rng.randint(-500, 500) / 10 for _ in range(2)]
    about, angle = [rng.randint(-300, 300) / 10 for _ in range(2)], rng.randint(-1800, 1800) / 10
    cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    origin = c[0] + about[0] - cos * about[0] + sin * about[1], c[1] + about[1] - sin * about[0] - cos * about[1]
    w.write(f"G10 L2 P1 X{c[0]} Y{c[1]}")
    w.move()
    before = len(w.lines)
    w.write("")
    w.write(f"G0 {w.axes(2, 'XY')}")
    for part in rng.choices([w.move, w.half_circle, w.increments, w.units, w.absolute_centre], k=8):
        part()
    w.write("G21")
    w.unit = 1.0
    end = len(w.lines)
    w.write("")
    w.write(f"G0 {w.axes(2, 'XY')}")
    ours, asked = list(w.lines), list(w.lines)
    ours[before], ours[end] = f"G68 X{about[0]} Y{about[1]} R{angle}", "G69"
    asked[before] = f"G10 L2 P1 X{origin[0]:.13f} Y{origin[1]:.13f} R{angle}"
    asked[end] = f"G10 L2 P1 X{c[0]} Y{c[1]} R0"
    return ours, asked


def rows(answer, count):
    """LinuxCNC's rows, without straight ones of no length."""
    found, at = [], [0.0, 0.0, 0.0]
    for row in motion(answer, list(range(count + 2))):
        if row["kind"] == "arc" or max(abs(a - b) for a, b in zip(row["to"], at, strict=True)) > 1e-9:
            found.append(row)
        at = row["to"]
    return found


def main():
    rng, records = random.Random(SEED), []
    families = {"shifted": (160, shifted), "compensated": (25, compensated), "turned": (60, turned)}
    for name, (count, make) in families.items():
        number = refused = 0
        while number < count:
            made = make(rng)
            ours, asked = made if isinstance(made, tuple) else (made, made)
            answer = ask("\n".join([*asked, "M2", ""]))
            if not answer["ok"]:
                refused += 1
                continue
            record = {"name": f"{name}-{number}", "text": "\n".join([*ours, ""]), "motion": rows(answer, len(asked))}
            records.append(record | ({"asked": "\n".join([*asked, ""])} if asked is not ours and asked != ours else {}))
            number += 1
        print(name, count, "refused", refused)
    save("iso_offsets.json", SEED, records)


if __name__ == "__main__":
    main()

"""Random contours under G41 and G42 with LinuxCNC's tool-centre path: writes compensation.json.

    python3 tests/authorities/generate_compensation.py

Entry and exit are lines that run tangentially into and out of the contour, where all controls agree. Of every
recorded path plain geometry shows that the tool touches each element and cuts into none; of every refused
program, that there is an element which the tool cannot touch anywhere without cutting into another, or an
inside corner where it cannot touch both elements at once.
"""

import math
import random
from collections import Counter
from itertools import pairwise

from contours import apart, clearance, corner, direction, moved, shares, unreachable
from recording import TICKS, ask, decimal, mm, motion, save
from shapes import FAMILIES, NARROW

SEED = 20151206
EACH = 30  # programs of each family
REFUSED_EACH = 6
LEAST_CORNER = math.radians(6)  # LinuxCNC takes an outside corner below 0.05 rad for a tangential one
MOST_CORNER = math.radians(150)


class Program:
    """A contour with entry and exit, written in both languages."""

    def __init__(self, rng, contour, radius, side):
        self.rng, self.contour, self.radius, self.side = rng, contour, radius, side
        self.mnc, self.rs274, self.line_of = [], ["%", "G21 G17 G90 G94 G40 G49 G54 G64"], {}
        self.lines = []  # MNC line of each element
        self.start = self.beyond(contour[0], 0)
        self.exit = self.beyond(contour[-1], 1)
        self.write("T1", "")
        self.write("G17 G90 G54")
        self.write("G00" + self.point(self.start) + " Z5")
        self.write("G01 Z-2 F100")
        entry = " G01" + self.point(contour[0].start) + " F200"
        code = 41 if side > 0 else 42
        self.write(f"G{code}{entry}", f"G{code}.1 D{decimal(2 * mm(radius))}{entry}")
        incremental = rng.random() < 0.25
        if incremental:
            self.write("G91")
        modal = 1
        for element in contour:
            modal = self.element(element, modal, incremental)
        if incremental:
            self.write("G90")
        self.write("G40 G01" + self.point(self.exit))
        self.write("G00 Z5")
        self.rs274 += ["M2", "%"]

    def write(self, mnc, rs274=None):
        self.mnc.append(mnc)
        self.rs274.append(mnc if rs274 is None else rs274)
        self.line_of[len(self.rs274)] = len(self.mnc)

    def beyond(self, element, share):
        """A point on the tangent before the start or behind the end, farther away than the tool's radius."""
        if element.turn:
            step = direction(element, share)
        else:
            step = element.end[0] - element.start[0], element.end[1] - element.start[1]
        divisor = math.gcd(*step)
        step = step[0] // divisor, step[1] // divisor
        times = math.ceil(mm(self.radius + self.rng.uniform(2, 8)) / math.hypot(*step))
        return moved(element.end if share else element.start, step, times if share else -times)

    def point(self, to, origin=(0, 0)):
        return "".join(f" {axis}{decimal(a - b)}" for axis, a, b in zip("XY", to, origin, strict=True))

    def element(self, element, modal, incremental):
        """Write the block of an element; returns its G function."""
        code = {0: 1, 1: 3, -1: 2}[element.turn]
        words = self.point(element.end, element.start if incremental else (0, 0))
        if element.turn:
            chord = math.dist(element.start, element.end) / TICKS
            if 0.1 * element.radius < chord < 1.9 * element.radius and self.rng.random() < 0.4:
                words += f" R{decimal(mm(element.radius) * (1 if element.sweep < math.pi else -1))}"
            else:
                i, j = (c - s for c, s in zip(element.centre, element.start, strict=True))
                words += f" I{decimal(i)} J{decimal(j)}"
        if self.rng.random() < 0.15:
            words += f" F{self.rng.choice([80, 150, 320.5])}"
        self.write((words if code == modal else f"G{code:02d}{words}").strip())
        self.lines.append(len(self.mnc))
        return code

    def texts(self):
        return {"mnc": "\n".join(self.mnc) + "\n", "rs274": "\n".join(self.rs274) + "\n"}

    # Plain geometry.

    def outside(self, before, after):
        return self.side * corner(before, after) < 0

    def check(self, rows):
        """Stop unless every row is at its place beside its own element."""
        first, last = self.contour[0], self.contour[-1]
        rapid, plunge, entry, *path, leave, retract = rows
        near(rapid["to"][:2], [v / TICKS for v in self.start])
        near(plunge["to"][:2], rapid["to"][:2])
        near(entry["to"][:2], first.offset(0, self.radius, self.side))
        near(leave["to"][:2], [v / TICKS for v in self.exit])
        near(retract["to"][:2], leave["to"][:2])
        here = entry["to"]
        for number, element in enumerate(self.contour):
            if number and self.outside(self.contour[number - 1], element):
                here = self.check_corner(here, path.pop(0), number)
            here = self.check_element(here, path.pop(0), number)
        near(here[:2], last.offset(1, self.radius, self.side))
        assert not path

    def check_corner(self, start, row, number):
        """An outside corner: an arc of the tool's radius about the corner."""
        element = self.contour[number]
        assert row["kind"] == "arc" and row["line"] == self.lines[number]
        near(row["centre"][:2], element.point(0))
        near(start[:2], self.contour[number - 1].offset(1, self.radius, self.side))
        near(row["to"][:2], element.offset(0, self.radius, self.side))
        assert abs(row["sweep"] - corner(self.contour[number - 1], element)) < 1e-6
        return row["to"]

    def check_element(self, start, row, number):
        """The equidistant of an element: parallel, or about the same centre; it does not run backwards."""
        element = self.contour[number]
        assert row["line"] == self.lines[number] and row["kind"] == ("arc" if element.turn else "line")
        if element.turn:
            near(row["centre"][:2], [v / TICKS for v in element.centre])
            distance = element.radius - self.side * element.turn * self.radius
            for point in (start, row["to"]):
                assert abs(math.dist(point[:2], row["centre"][:2]) - distance) < 1e-8
            assert 0 < element.turn * row["sweep"] < element.sweep + 1e-8
        else:
            (x, y), (tx, ty) = element.offset(0, self.radius, self.side), element.tangent(0)
            for point in (start, row["to"]):
                assert abs((point[1] - y) * tx - (point[0] - x) * ty) < 1e-8
            assert (row["to"][0] - start[0]) * tx + (row["to"][1] - start[1]) * ty > 0
        return row["to"]

    def clear(self, rows):
        """Whether the tool-centre path keeps the distance from the whole contour, as far as samples tell."""
        path = rows[2:-2]  # from the end of the entry to the start of the exit
        return all(
            clearance(point, self.contour) > self.radius - 1e-6
            for before, row in pairwise(path)
            for point in samples(before["to"], row)
        )


def near(point, wanted):
    assert math.dist(point, wanted) < 1e-8, (point, wanted)


def samples(start, row):
    """Points in mm along a recorded row."""
    if row["kind"] == "line":
        return [[a + (b - a) * t for a, b in zip(start[:2], row["to"][:2], strict=True)] for t in shares()]
    cx, cy = row["centre"][:2]
    x, y = start[0] - cx, start[1] - cy
    angles = [row["sweep"] * t for t in shares()]
    return [(cx + x * math.cos(a) - y * math.sin(a), cy + x * math.sin(a) + y * math.cos(a)) for a in angles]


def plausible(contour, radius, side):
    """Whether no element is a speck, no inside arc too small, no corner nearly tangential or a reversal."""
    for element in contour:
        too_small = element.turn == side and element.radius < 1.05 * radius
        if too_small or math.dist(element.start, element.end) < TICKS:
            return False
    corners = [abs(corner(a, b)) for a, b in pairwise(contour)]
    return all(turn == 0 or LEAST_CORNER < turn < MOST_CORNER for turn in corners)


def corner_kinds(program):
    """Names of the corners in a contour: "inside line arc" ..."""
    for a, b in pairwise(program.contour):
        turn = program.side * corner(a, b)
        place = "inside" if turn > 0 else "outside" if turn < 0 else "tangential"
        yield " ".join([place, *("arc" if element.turn else "line" for element in (a, b))])


def accepted(rng, tally):
    """Records of programs that LinuxCNC accepts."""
    for family, contour_of in FAMILIES.items():
        number = 0
        while number < EACH:
            side, radius = rng.choice([1, -1]), rng.choice([1, 2, 3, 4, 5, 6, 2.5, 3.175, 4.0125])
            contour = contour_of(rng, side)
            if not plausible(contour, radius, side):
                continue
            program = Program(rng, contour, radius, side)
            answer = ask(program.texts()["rs274"])
            if not answer["ok"]:  # no place for the tool in a corner
                tally["passed over: " + answer["error"]] += 1
                continue
            rows = motion(answer, program.line_of)
            program.check(rows)
            if not program.clear(rows):  # controls look at neighbours only
                tally["passed over: the tool meets an element farther on"] += 1
                continue
            number += 1
            tally.update(corner_kinds(program))
            yield {"name": f"{family}_{number:02d}", **program.texts(), "radius": radius, "motion": rows}


def refused(rng):
    """Records of programs that LinuxCNC refuses."""
    for family, contour_of in NARROW.items():
        number = 0
        while number < REFUSED_EACH:
            side, radius = rng.choice([1, -1]), rng.choice([3, 4, 5, 6, 3.175])
            contour = contour_of(rng, side, radius)
            too_short = any(unreachable(element, contour, radius, side) for element in contour)
            if not too_short and not apart(contour[0], contour[1], radius, side):
                continue
            program = Program(rng, contour, radius, side)
            answer = ask(program.texts()["rs274"])
            assert not answer["ok"]
            number += 1
            name, line = f"refused_{family}_{number:02d}", program.line_of[answer["line"]]
            yield {
                "name": name,
                **program.texts(),
                "radius": radius,
                "refused": answer["error"],
                "line": line,
            }


def main():
    rng, tally = random.Random(SEED), Counter()
    records = [*accepted(rng, tally), *refused(rng)]
    for text, count in sorted(tally.items()):
        print(f"{count:5} {text}")
    save("compensation.json", SEED, records)


if __name__ == "__main__":
    main()

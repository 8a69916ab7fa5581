"""Milling programs for a comparison of solids: random within their families, plain moves only.

A program is written twice, as text for the control G43 and as moves for whoever sweeps it: (tool, points (n, 3)) for
straight moves and (tool, start, centre, turn, rise, plane) for arcs. Both come from the same numbers, rounded to 0.001 mm.
"""

import math
import random

SEED = 20261122
SAFE = 5.0  # mm above the blank
STOCK = ((0.0, 0.0, -20.0), (60.0, 50.0, 0.0))


class Program:
    """Text and moves, side by side."""

    def __init__(self, name):
        self.name, self.tools, self.text, self.moves = name, {}, ["G17 G0 Z50"], []
        self.at, self.number = (0.0, 0.0, 50.0), 0

    def tool(self, **sizes):
        """Another tool: radius, corner, kind, angle."""
        self.to(z=50.0)
        self.number += 1
        self.tools[str(self.number)] = sizes
        self.text += [f"T{self.number} M6", "S1000 M3"]
        return self

    def to(self, x=None, y=None, z=None, feed=True):
        """A straight move."""
        there = tuple(old if new is None else round(new, 3) for old, new in zip(self.at, (x, y, z)))
        words = " ".join(f"{axis}{value:g}" for axis, value in zip("XYZ", there))
        if self.number:
            self.text.append(f"G1 {words} F500" if feed else f"G0 {words}")
            self.moves.append({"tool": str(self.number), "line": [self.at, there]})
        self.at = there
        return self

    def down(self, x, y, z):
        """Over a place, then straight down."""
        return self.to(z=SAFE, feed=False).to(x, y, feed=False).to(z=z)

    def arc(self, dx, dy, turn, rise=0.0, plane="G17"):
        """About a centre that lies `dx` and `dy` away in the plane, by `turn` rad (a full one at most), and up along its axis."""
        dx, dy, rise = round(dx, 3), round(dy, 3), round(rise, 3)
        first, second, third = {"G17": (0, 1, 2), "G18": (2, 0, 1), "G19": (1, 2, 0)}[plane]
        centre = list(self.at)
        centre[first] += dx
        centre[second] += dy
        there = list(self.at)
        cos, sin = round(math.cos(turn)), round(math.sin(turn))  # quarters of a turn keep every number a short one
        there[first] = round(centre[first] - dx * cos + dy * sin, 3)
        there[second] = round(centre[second] - dx * sin - dy * cos, 3)
        there[third] = round(there[third] + rise, 3)
        code = "G3" if turn > 0 else "G2"
        places = " ".join(f"{axis}{value:g}" for axis, value in zip("XYZ", there))
        self.text.append(f"{plane} {code} {places} {'IJK'[first]}{dx:g} {'IJK'[second]}{dy:g} F500")
        if plane != "G17":
            self.text.append("G17")
        arc = {"start": self.at, "centre": centre, "turn": turn, "rise": rise, "axes": (first, second, third)}
        self.moves.append({"tool": str(self.number), "arc": arc})
        self.at = tuple(there)
        return self


def record_of(program):
    text = "\n".join([*program.text, "G0 Z50", "M30", ""])
    return {"name": program.name, "tools": program.tools, "stock": STOCK, "text": text}


QUARTER = math.pi / 2
FLAT = {"radius": 4.0, "kind": "mill"}
BALL = {"radius": 4.0, "corner": 4.0, "kind": "mill"}
BULL = {"radius": 5.0, "corner": 1.5, "kind": "mill"}


def any_mill(rng):
    radius = rng.choice([2.0, 3.0, 4.0, 5.0, 6.0])
    corner = rng.choice([0.0, radius, round(radius * rng.uniform(0.2, 0.8), 2)])
    return {"radius": radius, "corner": corner, "kind": "mill"}


def place(rng, edge=0.0):
    return rng.uniform(edge, 60 - edge), rng.uniform(edge, 50 - edge)


def slots(rng, program):
    """Straight level slots of any mill, some out of the blank."""
    program.tool(**any_mill(rng))
    for _ in range(rng.randint(1, 3)):
        program.down(*place(rng, -5), rng.uniform(-9, -1)).to(*place(rng, -5))


def ramps(rng, program):
    program.tool(**any_mill(rng))
    for _ in range(rng.randint(1, 2)):
        program.down(*place(rng), rng.uniform(-1, 1)).to(*place(rng), rng.uniform(-10, -3)).to(*place(rng), rng.uniform(-6, 0))


def arcs(rng, program):
    program.tool(**any_mill(rng))
    for _ in range(rng.randint(1, 2)):
        program.down(*place(rng, 8), rng.uniform(-8, -1))
        program.arc(rng.uniform(-12, 12), rng.uniform(-12, 12), rng.choice([-4, -2, -1, 1, 2, 3, 4]) * QUARTER)


def pockets(rng, program):
    """A rectangle in rings, at one or more depths."""
    radius = rng.choice([3.0, 4.0, 5.0])
    corner = rng.choice([0.0, 0.5, 1.0])
    program.tool(radius=radius, corner=corner, kind="mill")
    (cx, cy), step = place(rng, 22), (radius - corner) * rng.uniform(0.8, 1.6)
    for level in range(1, rng.randint(1, 3) + 1):
        program.down(cx, cy, -2.5 * level)
        for ring in range(1, rng.randint(2, 4) + 1):
            a, b = 1.3 * step * ring, step * ring
            program.to(cx + a, cy - b).to(cx + a, cy + b).to(cx - a, cy + b).to(cx - a, cy - b).to(cx + a, cy - b)


def holes(rng, program):
    program.tool(radius=rng.choice([1.5, 2.5, 4.0, 6.0]), kind="drill", angle=rng.choice([90, 118, 140, 180]))
    for _ in range(rng.randint(2, 6)):
        program.down(*place(rng), rng.uniform(-25, -1))


def grooves(rng, program):
    """A ball or a bull-nosed mill along a way in space."""
    program.tool(**rng.choice([BALL, {**BALL, "radius": 3.0, "corner": 3.0}, BULL]))
    program.down(*place(rng), -1)
    for _ in range(rng.randint(2, 5)):
        program.to(*place(rng), rng.uniform(-9, 0))


def bores(rng, program):
    """Down on a helix, once round at its end."""
    program.tool(**rng.choice([FLAT, {**FLAT, "corner": 1.0}, BALL]))
    (x, y), out, pitch = place(rng, 15), rng.uniform(2, 9), rng.uniform(0.8, 3.0)
    turn = rng.choice([-1, 1]) * 4 * QUARTER
    program.down(x, y, 0.0)
    for _ in range(rng.randint(2, 5)):
        program.arc(out, 0.0, turn, -pitch)
    program.arc(out, 0.0, turn)


def crossings(rng, program):
    program.tool(**any_mill(rng))
    for _ in range(3):
        x, y = place(rng, 5)
        program.down(x, -8, rng.uniform(-7, -1)).to(y=58).to(z=SAFE).down(-8, y, rng.uniform(-7, -1)).to(x=68)


def edges(rng, program):
    """A contour on the outside, then its chamfer."""
    radius, depth = rng.choice([4.0, 5.0]), rng.uniform(-12, -3)
    a = rng.uniform(3, 8)
    program.tool(radius=radius, kind="mill")
    program.down(-10, a - radius, depth).to(x=60 - a + radius).to(y=50 - a + radius).to(x=a - radius).to(y=-10)
    program.tool(radius=5.0, kind="chamfer", angle=rng.choice([60, 90, 120]))
    deep = rng.uniform(-3, -1)
    program.down(-12, a - 1, deep).to(x=60 - a + 1).to(y=50 - a + 1).to(x=a - 1).to(y=-12)


def waves(rng, program):
    """Passes of a ball over a wavy surface."""
    program.tool(**{**BALL, "radius": 5.0, "corner": 5.0})
    phase, apart = rng.uniform(0, 6), rng.uniform(2.0, 4.0)
    for number in range(rng.randint(4, 7)):
        y = 8 + apart * number
        program.down(4, y, -2.0)
        for k in range(1, 12):
            program.to(4 + 4.5 * k, y, -3 + 1.5 * math.sin(phase + k))


def upright_arcs(rng, program):
    """Arcs in the planes of Z: the tool swings down and up again."""
    program.tool(**rng.choice([BALL, FLAT, BULL]))
    for plane in ("G18", "G19"):
        out = rng.uniform(4, 8)
        program.down(*place(rng, 16), rng.uniform(-1, 1))
        if plane == "G18":  # in Z and X: the centre lies along X, the way leads below it
            program.arc(0.0, -out, 2 * QUARTER * 1, plane=plane)
        else:
            program.arc(out, 0.0, 2 * QUARTER, plane=plane)


def many_tools(rng, program):
    """A pocket, holes in its floor with their countersinks, a groove round it."""
    (cx, cy), deep = place(rng, 20), rng.uniform(-6, -2)
    program.tool(**FLAT).down(cx - 8, cy, deep).to(x=cx + 8).to(y=cy + 5).to(x=cx - 8).to(y=cy - 5).to(x=cx + 8).to(y=cy)
    program.tool(radius=2.1, kind="drill", angle=118).down(cx - 6, cy, deep - 9).down(cx + 6, cy, deep - 9)
    program.tool(radius=5.0, kind="countersink", angle=90)
    program.down(cx - 6, cy, deep - 3).to(z=SAFE).down(cx + 6, cy, deep - 3)
    program.tool(**{**BALL, "radius": 2.0, "corner": 2.0}).down(cx + 15, cy, -1.0).arc(-15, 0, 4 * QUARTER)


FAMILIES = {
    slots: 8, ramps: 8, arcs: 6, pockets: 6, holes: 6, grooves: 6, bores: 6, crossings: 5, edges: 5, waves: 3,
    upright_arcs: 5, many_tools: 6,
}  # fmt: skip


def programs():
    """All of them, the same each time."""
    rng = random.Random(SEED)
    for family, count in FAMILIES.items():
        for number in range(count):
            program = Program(f"{family.__name__} {number + 1}")
            family(rng, program)
            yield program

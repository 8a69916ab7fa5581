"""Random designs, and the programs of the MNC that make them: cycles and plain moves, in layers, in any order.

A part of 200 by 150 by 30 has twelve places of 50 by 50, each with a feature or two; its top is faced or not.
"""

import math
import random

import mnclab
from mnclab import Setup, Tool
from mnclab.design.model import Chamfer, Design, Face, Groove, Hole, Pocket, Slot, Stud
from mnclab.design.model.shapes import Outline, Rectangle
from mnclab.geometry.contours import Contour

TOOLS = {
    1: Tool(radius=5, kind="mill", plunge_angle=3), 2: Tool(radius=3, kind="mill", plunge_angle=3),
    3: Tool(radius=4, kind="drill", angle=118), 4: Tool(radius=2.5, kind="drill", angle=140),
    5: Tool(radius=8, kind="countersink", angle=90), 6: Tool(radius=3, kind="tap", pitch=1),
    7: Tool(radius=4, kind="chamfer", angle=90),
}  # fmt: skip
TIP3, TIP4 = 4 / math.tan(math.radians(59)), 2.5 / math.tan(math.radians(70))


class Program:
    """Blocks of the MNC, with the tool that is in the spindle."""

    def __init__(self):
        self.blocks, self.tool = ["G17 G90 G54", "G0 Z50"], 0

    def take(self, tool):
        if tool != self.tool:
            self.blocks += [f"T{tool}", "S2000 M3"]
            self.tool = tool

    def add(self, *blocks):
        self.blocks += blocks

    def at(self, x, y):
        self.add("G0 Z20", f"G0 X{x:.9f} Y{y:.9f}")

    def plunge(self, tool, x, y, z):
        self.take(tool)
        self.at(x, y)
        self.add(f"G1 Z{z:.9f} F200", "G0 Z20")

    def along(self, tool, contour, z):
        """Along a contour at a height."""
        self.take(tool)
        self.at(*contour.starts[0])
        self.add(f"G1 Z{z:.9f} F200")
        for (x, y), sweep, (u, v), start in zip(contour.ends, contour.sweeps, contour.centres, contour.starts):
            if sweep:
                self.add(f"{'G3' if sweep > 0 else 'G2'} X{x:.9f} Y{y:.9f} I{u - start[0]:.9f} J{v - start[1]:.9f} F400")
            else:
                self.add(f"G1 X{x:.9f} Y{y:.9f} F400")
        self.add("G0 Z20")

    def __str__(self):
        return "\n".join(f"N{10 * (k + 1)} {block}" for k, block in enumerate(self.blocks)) + "\n"


def rectangle(x, y, length, width, corner=0.0):
    return Rectangle(x, y, length, width, corner).contour


def layers(depth, most):
    n = math.ceil(depth / most)
    return [depth * (k + 1) / n for k in range(n)]


def size(rng, low, high):
    return round(rng.uniform(low, high), 2)


# --- a feature at a place: what it is on a drawing, and its blocks; `z0` is the surface, `more` its top on the drawing ----------


def drilled(rng, p, x, y, z0, more):
    depth = size(rng, 5, 20)
    p.plunge(3, x, y, z0 - depth - TIP3)
    return [Hole(x, y, 8, depth, **more)]


def through(rng, p, x, y, z0, more):
    p.take(3)
    p.add("G0 Z20", f"G83 X{x} Y{y} Z-36 R{z0 + 2} K6 F100", "G80")
    return [Hole(x, y, 8, **more)]


def counterbored(rng, p, x, y, z0, more):
    wide, deep = size(rng, 8, 12), size(rng, 2, 6)
    depth = rng.choice([None, size(rng, 10, 20)])
    made = [lambda: p.plunge(4, x, y, -36 if depth is None else z0 - depth - TIP4), lambda: circular(p, x, y, wide, deep, z0)]
    rng.shuffle(made)
    for each in made:
        each()
    point = {} if depth is None else {"point": 140}
    return [Hole(x, y, 5, depth, counterbore=(wide, deep), **point, **more)]


def countersunk(rng, p, x, y, z0, more):
    depth, wide = size(rng, 8, 20), size(rng, 9, 15)
    p.plunge(3, x, y, z0 - depth - TIP3)
    p.plunge(5, x, y, z0 - wide / 2)
    return [Hole(x, y, 8, depth, countersink=(wide, 90), **more)]


def tapped(rng, p, x, y, z0, more):
    depth = size(rng, 14, 20)
    deep = size(rng, 8, 12)
    p.plunge(4, x, y, z0 - depth - TIP4)
    p.take(6)
    p.at(x, y)
    p.add("S200 M3", f"G309 Q2 H{-deep:.9f} P1 Z{z0:.9f}", f"G0 X{x} Y{y} M99")
    return [Hole(x, y, 5, depth, 140, thread="M6", thread_depth=deep, **more)]


def rectangular(rng, p, x, y, z0, more):
    length, width, depth = size(rng, 20, 36), size(rng, 16, 30), size(rng, 3, 14)
    corner, turned = size(rng, 5, 7.5), rng.choice([0, size(rng, -15, 15)])
    p.take(1)
    p.at(x, y)
    walls = rng.choice(["U0.3 W0.2", "U0 W0"])
    p.add(f"G343 M0 A{length} B{width} R{corner} E{turned} Z{z0} H{-depth} P4 Q2 {walls} K1 J1 F600 V150 T400")
    return [Pocket.rectangle(x, y, length, width, depth, corner, turned, **more)]


def circular(p, x, y, wide, depth, z0, tool=2):
    p.take(tool)
    p.at(x, y)
    p.add(f"G344 M0 D{wide} Z{z0} H{-depth} P4 Q2 U0.3 K1 J0 F600 V150 T400")


def round_pocket(rng, p, x, y, z0, more):
    wide, depth = size(rng, 24, 40), size(rng, 3, 14)
    circular(p, x, y, wide, depth, z0, 1)
    return [Pocket.circle(x, y, wide, depth, **more)]


def drilled_in_a_pocket(rng, p, x, y, z0, more):
    wide, depth, deep = size(rng, 30, 40), size(rng, 3, 6), size(rng, 5, 10)
    floor = z0 - depth
    p.plunge(3, x, y, floor - deep - TIP3)
    circular(p, x, y, wide, depth, z0, 1)
    return [Pocket.circle(x, y, wide, depth, **more), Hole(x, y, 8, deep, top=floor)]


def slot(rng, p, x, y, z0, more):
    angle, half, depth = math.radians(rng.uniform(0, 180)), size(rng, 5, 14), size(rng, 2, 12)
    dx, dy = half * math.cos(angle), half * math.sin(angle)
    line = Contour([(x - dx, y - dy), (x + dx, y + dy)], closed=False)
    for z in layers(depth, 4):
        p.along(1, line, z0 - z)
    return [Slot((x - dx, y - dy), (x + dx, y + dy), 10, depth, **more)]


def open_groove(rng, p, x, y, z0, more):
    bulge, depth = round(rng.uniform(0.3, 0.9), 3), size(rng, 1, 5)
    points = [(x - 16, y - 12), (x - 2, y - 14), (x + 6, y + 2), (x + 16, y + 10)]
    line = Outline(tuple(points), (0.0, bulge, 0.0, 0.0), closed=False)
    p.along(2, line.contour, z0 - depth)
    return [Groove(line, 6, depth, **more)]


def closed_groove(rng, p, x, y, z0, more):
    ring, depth = Rectangle(x, y, size(rng, 20, 34), size(rng, 20, 34), size(rng, 4, 8)), size(rng, 1, 5)
    p.along(2, ring.contour, z0 - depth)
    return [Groove(ring, 6, depth, **more)]


def with_an_island(rng, p, x, y, z0, more):
    length, width, depth = size(rng, 8, 14), size(rng, 8, 14), size(rng, 2, 9)
    wide = 2 * (2 * 3 + size(rng, 1, 3.8))
    for z in layers(depth, 3):
        p.along(2, rectangle(x, y, length + 6, width + 6), z0 - z)
        p.along(2, rectangle(x, y, length + wide - 6, width + wide - 6), z0 - z)
    island = Rectangle(x, y, length, width)
    return [Pocket.rectangle(x, y, length + wide, width + wide, depth, 3, islands=(island,), **more)]


def with_a_chamfer(rng, p, x, y, z0, more):
    found = rectangular(rng, p, x, y, z0, more)
    shape, width, off = found[0].contour, size(rng, 0.5, 1.5), 1.0
    inner = Rectangle(x, y, shape.length - 2 * off, shape.width - 2 * off, shape.corner - off, shape.turned)
    p.along(7, inner.contour, z0 - off - width)
    return [*found, Chamfer(shape, width, **more)]


PLACES = [
    drilled, through, counterbored, countersunk, tapped, rectangular, round_pocket, drilled_in_a_pocket, slot, open_groove,
    closed_groove, with_an_island, with_a_chamfer,
]  # fmt: skip


def plate(seed):
    """A plate: its design, and its program."""
    rng, p = random.Random(seed), Program()
    faced = rng.random() < 0.5
    high, found, more = (size(rng, 0.5, 3) if faced else 0.0), [], {}
    if faced:
        for k in range(20):
            p.along(1, Contour([(-10, 4 + 8 * k), (210, 4 + 8 * k)], closed=False), 0.0)
        found, more = [Face(high)], {"top": 0.0}
    places = [(25 + 50 * i, 25 + 50 * j) for i in range(4) for j in range(3)]
    rng.shuffle(places)
    for x, y in places[: rng.randint(4, 12)]:
        found += rng.choice(PLACES)(rng, p, x, y, 0.0, more)
    return Design(((0, 0, -30), (200, 150, high)), tuple(found)), str(p)


def studs(seed):
    """A plate of 80 by 60 with a stud, round or rectangular, and all about it cleared."""
    rng, p = random.Random(seed), Program()
    x, y, depth = size(rng, 35, 45), size(rng, 27, 33), size(rng, 2, 9)
    if rng.random() < 0.5:
        wide = size(rng, 20, 34)
        stud = Stud.circle(x, y, wide, depth)
        rings = [Contour.circle((x, y), wide / 2 + 5 + 8 * k) for k in range(6)]
    else:
        length, width = size(rng, 20, 40), size(rng, 16, 30)
        stud = Stud.rectangle(x, y, length, width, depth)
        rings = [rectangle(x, y, length + 10 + 12 * k, width + 10 + 12 * k) for k in range(7)]
    for z in layers(depth, 4):
        for ring in reversed(rings):
            p.along(1, ring, -z)
    return Design(((0, 0, -20), (80, 60, 0)), (stud,)), str(p)


def run_of(design, text):
    return mnclab.run(text, control="mnc", setup=Setup(tools=TOOLS, stock=tuple(map(tuple, design.bounds.tolist()))))

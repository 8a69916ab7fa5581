"""Programs written from a drawing: every feature cut along its contour, with what was meant and what the machine does apart."""

from __future__ import annotations

import math
import random

from tools.running import run

from mnclab import Tool
from mnclab.design.model import Chamfer, Design, Face, Hole, Pocket, Slot, Stud
from mnclab.workpiece.milling.milled import Milled

MILL, DRILL, BEVEL = 1, 2, 3
R = 3.0  # of the mill that programs think of


class Writer:
    """Blocks of an MNC program; `dx` and `dz` shift and lower all that cuts."""

    def __init__(self, dx: float = 0.0, dz: float = 0.0) -> None:
        self.lines = ["G17 G90 G54"]
        self.dx, self.dz = dx, dz
        self.lines_of: dict[str, set[int]] = {}
        self.name, self.tool = "", 0

    def feature(self, name: str, tool: int) -> None:
        self.name = name
        if tool != self.tool:
            self.add("G0 Z50")
            self.add(f"T{tool}")
            self.add("S1000 M3 F500")
            self.add("G0 Z50")
            self.tool = tool

    def add(self, text: str) -> None:
        self.lines.append(text)
        self.lines_of.setdefault(self.name, set()).add(len(self.lines))

    def over(self, x: float, y: float) -> None:
        self.add(f"G0 X{x + self.dx:.9f} Y{y:.9f}")

    def down(self, z: float) -> None:
        self.add("G0 Z2")
        self.add(f"G1 Z{z + self.dz:.9f}")

    def to(self, x: float, y: float) -> None:
        self.add(f"G1 X{x + self.dx:.9f} Y{y:.9f}")

    def round(self, x: float, y: float, i: float, j: float, code: int = 3) -> None:
        self.add(f"G{code} X{x + self.dx:.9f} Y{y:.9f} I{i:.9f} J{j:.9f}")

    def up(self) -> None:
        self.add("G0 Z5")

    # --- features: nested contours from inside outwards ---------------------------------------------------------------

    def circle(self, x: float, y: float, radius: float, z: float, first: float = 0.0) -> None:
        """Rings about a place, the last with its outer side at `radius`."""
        last = radius - R
        rings = [first + k * (last - first) / 8 for k in range(1, 9)] if last - first > R else [last]
        self.over(x + rings[0], y)
        self.down(z)
        for q in rings:
            self.to(x + q, y)
            self.round(x + q, y, -q, 0)
        self.up()

    def rectangle(self, x: float, y: float, length: float, width: float, corner: float, z: float) -> None:
        a, b = length / 2 - R, width / 2 - R
        rings = [k * 0.8 * R for k in range(int(min(a, b) / (0.8 * R)) + 1)][::-1]
        self.over(x, y)
        self.down(z)
        for o in rings:
            p, q, c = a - o, b - o, max(corner - R - o, 0.0)
            self.to(x + p, y)
            for sx, sy in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
                if sx == sy:
                    self.to(x + sx * p, y + sy * (q - c))
                    if c:
                        self.round(x + sx * (p - c), y + sy * q, -sx * c, 0)
                else:
                    self.to(x + sx * (p - c), y + sy * q)
                    if c:
                        self.round(x + sx * p, y + sy * (q - c), 0, -sy * c)
            self.to(x + p, y)
        self.up()

    def slot(self, start, end, width: float, z: float) -> None:
        (x0, y0), (x1, y1) = start, end
        long, q = math.dist(start, end), width / 2 - R
        ux, uy = (x1 - x0) / long, (y1 - y0) / long
        self.over(x0, y0)
        self.down(z)
        self.to(x1, y1)
        if q > 0:
            self.to(x1 - uy * q, y1 + ux * q)
            self.to(x0 - uy * q, y0 + ux * q)
            self.round(x0 + uy * q, y0 - ux * q, uy * q, -ux * q)
            self.to(x1 + uy * q, y1 - ux * q)
            self.round(x1 - uy * q, y1 + ux * q, -uy * q, ux * q)
        self.up()

    def around(self, x: float, y: float, radius: float, far: float, z: float) -> None:
        """All around a round stud, from outside inwards."""
        rings = [far - k * 1.5 * R for k in range(200) if far - k * 1.5 * R > radius + R] + [radius + R]
        self.over(x + rings[0], y)
        self.down(z)
        for q in rings:
            self.to(x + q, y)
            self.round(x + q, y, -q, 0)
        self.up()

    def hole(self, hole: Hole, top: float) -> None:
        self.over(hole.x, hole.y)
        self.down(top - hole.depth - hole.tip)
        self.up()

    def face(self, length: float, width: float, z: float) -> None:
        y, side = -R, 1
        self.over(-2 * R, y)
        self.down(z)
        while y < width + R:
            self.to(length + 2 * R if side > 0 else -2 * R, y)
            y, side = y + 1.5 * R, -side
            self.to(length + 2 * R if side < 0 else -2 * R, y)
        self.up()

    def bevel(self, x: float, y: float, radius: float, width: float, z: float) -> None:
        """A chamfer about a round edge: the tip goes along the edge itself, `width` below it."""
        self.over(x + radius, y)
        self.down(z - width)
        self.round(x + radius, y, -radius, 0)
        self.up()


LENGTH, WIDTH, THICK = 110.0, 74.0, 20.0
PLACES = [(20 + 35 * i, 19 + 36 * j) for i in range(3) for j in range(2)]  # of features, 32 mm apart or more


def cut(writer: Writer, tools: dict[int, Tool] | None = None, stock=None, **given) -> Milled:
    """What a program leaves of the blank."""
    known = {MILL: Tool(radius=R, number=MILL, kind="mill"), BEVEL: Tool(radius=6, number=BEVEL, kind="chamfer", angle=90)}
    setup = {"tools": known | (tools or {}), "stock": stock or ((0, 0, -THICK), (LENGTH, WIDTH, 0))}
    return run("\n".join(writer.lines) + "\nG0 Z50", **setup).workpiece(**given)


def random_design(seed: int) -> Design:
    """Six features of random kinds and sizes at fixed places, of three decimals."""
    chance = random.Random(seed)

    def size(low: float, high: float) -> float:
        return round(chance.uniform(low, high), 3)

    top = -size(0.5, 1.5) if chance.random() < 0.4 else 0.0
    features = [Face(-top, name="face")] if top else []
    for k, (x, y) in enumerate(PLACES):
        x, y, depth, name = x + size(-1, 1), y + size(-1, 1), size(2, 12), f"feature {k}"
        kind = chance.choice(("circle", "rectangle", "slot", "hole", "bevelled"))
        more = {"name": name, "top": top}
        if kind == "circle":
            features.append(Pocket.circle(x, y, size(8, 28), depth, **more))
        elif kind == "rectangle":
            features.append(Pocket.rectangle(x, y, size(18, 28), size(14, 28), depth, corner=size(R + 0.5, 6), **more))
        elif kind == "slot":
            angle, half = chance.uniform(0, math.pi), size(4, 8)
            dx, dy = round(half * math.cos(angle), 3), round(half * math.sin(angle), 3)
            features.append(Slot((x - dx, y - dy), (x + dx, y + dy), size(6.5, 10), depth, **more))
        elif kind == "hole":
            features.append(Hole(x, y, 7.0, depth, **more))
        else:
            pocket = Pocket.circle(x, y, size(12, 26), depth, **more)
            features += [pocket, Chamfer(pocket.contour, size(0.5, 1.5), name=f"bevel {k}", top=top)]
    return Design(((0, 0, -THICK), (LENGTH, WIDTH, 0)), tuple(features))


def written(design: Design, dx: float = 0.0, dz: float = 0.0) -> Writer:
    """The program of a design."""
    writer = Writer(dx, dz)
    for each in design.features:
        top = each.top or 0.0
        if isinstance(each, Face):
            writer.feature(each.name, MILL)
            writer.face(LENGTH, WIDTH, -each.depth)
        elif isinstance(each, Slot):
            writer.feature(each.name, MILL)
            writer.slot(each.start, each.end, each.width, top - each.depth)
        elif isinstance(each, Hole):
            writer.feature(each.name, DRILL)
            writer.hole(each, top)
        elif isinstance(each, Chamfer):
            writer.feature(each.name, BEVEL)
            writer.bevel(each.contour.x, each.contour.y, each.contour.diameter / 2, each.width, top)
        elif isinstance(each, Stud):
            writer.feature(each.name, MILL)
            writer.around(each.contour.x, each.contour.y, each.contour.diameter / 2, LENGTH, top - each.depth)
        elif hasattr(each.contour, "diameter"):
            writer.feature(each.name, MILL)
            writer.circle(each.contour.x, each.contour.y, each.contour.diameter / 2, top - each.depth)
        else:
            shape = each.contour
            writer.feature(each.name, MILL)
            writer.rectangle(shape.x, shape.y, shape.length, shape.width, shape.corner, top - each.depth)
    return writer

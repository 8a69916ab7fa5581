"""A control for tests of pictures: a cycle for each kind of figure that a probe touches, as short as it can be."""

import math

import mnclab
from mnclab import probing
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.reader import reader
from mnclab.geometry.contours import Contour
from mnclab.machine.control import Control, FunctionTable
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.touching import PROBES
from mnclab.machining.probing.sequences import (
    OPPOSITE,
    Aim,
    Approach,
    from_above,
    in_plane,
    on_circle,
    side,
    ways_round,
)
from mnclab.machining.steps import Measure, Sketch

FUNCTIONS, CYCLES = FunctionTable(), CycleTable()


@FUNCTIONS("G0", "Rapid", group="motion", takes="X Y Z", power_on="G0", moves=True)
def rapid(m, words):
    m.rapid(**{axis.lower(): m.value(word) for axis, word in words.items() if axis in "XYZ"})


FUNCTIONS("T", "Tool", phase="tool")(motion.tool)


class Probing(Cycle):
    does = PROBES

    def about(self, m):
        return 0.0, 0.0

    def approach(self, m, gap=3.0):
        return Approach(m.radius, gap, self.level, 20.0, 12.0, 100.0)


def rectangle(x, y, length, width, angle=0.0):
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    corners = [(u * length / 2, v * width / 2) for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return Contour([(x + u * c - v * s, y + u * s + v * c) for u, v in corners])


@CYCLES("M1", "Circle", runs="definition", source="here")
class Circle(Probing):
    x: float = param("X", "middle", example=50)
    y: float = param("Y", "middle", example=30)
    diameter: float = param("D", "diameter", above=0, example=24)
    level: float = param("Z", "height", example=-5)
    count: float = param("C", "touches", default=4)
    first: float = param("A", "first angle", default=0)
    tolerance: float = param("T", "tolerance", default=0.05)

    def moves(self, m):
        a = self.approach(m)
        aims = on_circle((self.x, self.y), self.diameter / 2, self.first, 360 / self.count, int(self.count), True, None)
        hits = yield from in_plane(a, aims, m.programmed[2])
        found = probing.circle([hit.point[:2] for hit in hits]).grown(a.ball)
        numbers = tuple(hit.number for hit in hits)
        low, high = self.diameter - self.tolerance, self.diameter + self.tolerance
        yield Measure("centre X", found.x, self.x, touches=numbers)
        yield Measure("centre Y", found.y, self.y, touches=numbers)
        yield Measure("diameter", found.diameter, self.diameter, low, high, touches=numbers)
        nominal, actual = Contour.circle((self.x, self.y), self.diameter / 2), Contour.circle(found.centre, found.radius)
        yield Sketch(nominal, actual, self.level, numbers)


@CYCLES("M2", "Pocket", runs="definition", source="here")
class Pocket(Probing):
    x: float = param("X", "middle", example=50)
    y: float = param("Y", "middle", example=30)
    length: float = param("U", "length", above=0, example=40)
    width: float = param("V", "width", above=0, example=24)
    level: float = param("Z", "height", example=-5)

    def moves(self, m):
        a = self.approach(m)
        half = self.length / 2, self.width / 2
        aims = [side((self.x, self.y), half, which, True) for which in OPPOSITE]
        reach = half[0] - a.away, half[1] - a.away
        hits = yield from in_plane(a, aims, m.programmed[2], ways_round((self.x, self.y), reach, OPPOSITE, True))
        (right, left, above, below), numbers = hits, tuple(hit.number for hit in hits)
        long, wide = (one.point[k] - other.point[k] + 2 * a.ball for one, other, k in ((right, left, 0), (above, below, 1)))
        x, y = (right.point[0] + left.point[0]) / 2, (above.point[1] + below.point[1]) / 2
        yield Measure("length", long, self.length, self.length - 0.1, self.length + 0.1, touches=numbers[:2])
        yield Measure("width", wide, self.width, self.width - 0.1, self.width + 0.1, touches=numbers[2:])
        yield Measure("centre X", x, self.x)
        yield Measure("centre Y", y, self.y)
        yield Sketch(rectangle(self.x, self.y, self.length, self.width), rectangle(x, y, long, wide), self.level, numbers)


@CYCLES("M3", "Corner", runs="definition", source="here")
class Corner(Probing):
    x: float = param("X", "corner", example=0)
    y: float = param("Y", "corner", example=0)
    way: float = param("U", "from touch to touch", above=0, example=40)
    level: float = param("Z", "height", example=-5)

    def moves(self, m):
        a, far = self.approach(m), self.way
        aims = [Aim(self.x, self.y + 10, (1, 0)), Aim(self.x, self.y + 10 + far, (1, 0))]
        one = yield from in_plane(a, aims, m.programmed[2])
        aims = [Aim(self.x + 10, self.y, (0, 1)), Aim(self.x + 10 + far, self.y, (0, 1))]
        other = yield from in_plane(a, aims, 20.0)
        edges = []
        for hits, way in ((one, (1, 0)), (other, (0, 1))):
            edges.append(probing.line([hit.point[:2] for hit in hits]).towards(way, a.ball))
        x, y = probing.corner(*edges).centre
        yield Measure("X", x, self.x)
        yield Measure("Y", y, self.y)
        yield Measure("angle", edges[1].angle, 0, unit="degrees")
        for hits, edge, nominal in ((one, edges[0], (0, 1)), (other, edges[1], (1, 0))):
            size = far + 10
            turn = math.radians(edge.angle)
            ways = math.cos(turn), math.sin(turn)
            if ways[0] * nominal[0] + ways[1] * nominal[1] < 0:
                ways = -ways[0], -ways[1]
            lines = [
                Contour([(px, py), (px + size * u, py + size * v)], closed=False)
                for (px, py), (u, v) in (((self.x, self.y), nominal), ((x, y), ways))
            ]
            yield Sketch(*lines, self.level, tuple(hit.number for hit in hits))


@CYCLES("M4", "Edge", runs="definition", source="here")
class Edge(Probing):
    x: float = param("X", "place", example=0)
    y: float = param("Y", "place", example=30)
    level: float = param("Z", "height", example=-5)

    def moves(self, m):
        a = self.approach(m)
        (hit,) = yield from in_plane(a, [Aim(self.x, self.y, (1, 0))], m.programmed[2])
        yield Measure("X", hit.point[0] + a.ball, self.x, touches=(hit.number,))


@CYCLES("M5", "Top", runs="definition", source="here")
class Top(Probing):
    x: float = param("X", "place", example=20)
    y: float = param("Y", "place", example=10)
    level: float = param("Z", "nominal height", example=0)
    count: float = param("C", "touches", default=1)

    def moves(self, m):
        a = self.approach(m)
        for k in range(int(self.count)):
            hit = yield from from_above(a, self.x + 20 * k, self.y + 15 * (k % 2), self.level, m.programmed[2])
            yield Measure(f"Z {k + 1}", hit.point[2] - a.ball, self.level, -0.02, 0.02, touches=(hit.number,))


TOY = Control("toy", "Toy", reader("toy", comment=";"), FUNCTIONS, CYCLES, ("tool", "motion"), (".toy",))


def toy_run(text, part, ball=2.0, **setup):
    """What a program on the toy control measures."""
    mnclab.controls.add(TOY)
    try:
        tools = {1: mnclab.Tool(radius=ball, kind="probe", name="probe")}
        return mnclab.run(f"T1\nG0 X50 Y30 Z30\n{text}\n", "toy", mnclab.Setup(tools=tools, part=part, **setup))
    finally:
        mnclab.controls.remove("toy")

"""SL programs of random areas: labels of lines and arcs, cycles 14 and 20 to 24, frames, inches; all from a seed. Lengths in mm.

A pocket after another one is joined with it, or cut to what both have in common, as the first that overlaps it begins (8.3).
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely
from tools.random_regions import Figure, random_task

import mnclab
from mnclab import Tool

MOST_LABELS, MOST_PARTS = 12, 9  # of cycle 14, of CONTOUR DEF
MIRRORED = "CYCL DEF 8.0 M\nCYCL DEF 8.1 X\n"
TURNED = "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT{:+g}\n"
SCALED = "CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL {:g}\n"


class Frame(NamedTuple):
    """Lengths of the program times `scale`, turned by `angle` (degrees), X mirrored."""

    mirrored: bool = False
    angle: float = 0.0
    scale: float = 1.0

    @property
    def text(self):
        turned = TURNED.format(self.angle) if self.angle else ""
        return MIRRORED * self.mirrored + turned + (SCALED.format(self.scale) if self.scale != 1 else "")

    def in_program(self, places):
        """Places `(…, 2)` of the machine in coordinates of the program."""
        a = np.radians(self.angle)
        back = np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]]) / self.scale
        return (places @ back.T) * [-1 if self.mirrored else 1, 1]


@dataclass(frozen=True)
class Job:
    """A program and what it should cut, all in lengths of the program; `depths` are those of pockets and islands, if any."""

    pockets: list[Figure]
    islands: list[Figure]
    radius: float
    coarse: float
    overlap: float
    side: float
    floor: float
    corner: float
    left: float
    climb: bool
    depth: float
    infeed: float
    frame: Frame
    inch: bool
    pilot: bool
    depths: tuple[float, ...]

    def area(self, hair, depth=0.0):
        """What is to be cut at a depth, as a shapely area; None where the pockets have nothing in common."""
        pockets = [figure.polygon(hair) for figure in self.pockets]
        islands = [figure.polygon(hair) for figure in self.islands]
        if self.depths:
            own, tops = np.split(np.array(self.depths), [len(pockets)])
            pockets = [each for each, deep in zip(pockets, own, strict=True) if depth <= (deep or self.depth)]
            islands = [each for each, deep in zip(islands, tops, strict=True) if depth > deep]
            return shapely.difference(shapely.union_all(pockets), shapely.union_all(islands))
        area = pockets[0]
        for k, pocket in enumerate(pockets[1:], 1):
            met = next((i for i in range(k) if pockets[i].intersection(pocket).area > 1e-6), None)
            inside = met is not None and shapely.contains_xy(pocket, *self.pockets[met].points[0])
            area = area.intersection(pocket) if inside else area.union(pocket)
        return shapely.difference(area, shapely.union_all(islands))

    @cached_property
    def floors(self):
        """Depths at which the area changes, and the last."""
        changes = sorted({min(deep or self.depth, self.depth) for deep in self.depths if deep} | {self.depth})
        areas = [self.area(1e-3, deep - 1e-6).area for deep in changes]
        return [deep for deep, here, below in zip(changes, areas, [*areas[1:], 0.0], strict=True) if here - below > 1e-3]

    def levels(self, allowance):
        """Depths of the levels, one on each floor above its allowance."""
        found = []
        for floor in self.floors:
            last = max(floor - allowance, 0.0)
            steps = np.append(np.arange(1, int(np.ceil(last / self.infeed - 1e-9))) * self.infeed, last)
            found += [float(deep) for deep in steps if not found or deep > found[-1] + 1e-9]
        return found

    @property
    def text(self):
        unit = 25.4 if self.inch else 1.0
        labels = "".join(_label(k, *each, unit) for k, each in enumerate(self._shapes, 1))
        sense = (1 if self.climb else -1,)
        data = _block(
            "20 D", unit, Q1=-self.depth, Q2=(self.overlap,), Q3=self.side, Q4=self.floor, Q5=0, Q6=2, Q7=50, Q8=self.corner,
            Q9=sense,
        )  # fmt: skip
        plunge, feeds = dict(Q10=-self.infeed, Q11=(100,)), dict(Q11=(100,), Q12=(300,))
        rough = plunge | feeds | dict(Q19=(0,))
        cycles = [_tool(3) + _block("21 P", unit, **plunge, Q13=(1,))] if self.pilot else []
        cycles.append(_tool(1) + _block("22 R", unit, **rough))
        if self.coarse:
            cycles.append(_tool(2) + _block("22 R", unit, **rough, Q18=(1,)))
        cycles.append(_block("23 F", unit, **feeds))
        if self.side > self.left:
            cycles.append(_block("24 S", unit, Q9=sense, **(plunge | feeds), Q14=self.left))
        called = "".join(f"{cycle}CYCL CALL\n" for cycle in cycles)
        name = "INCH" if self.inch else "MM"
        return f"BEGIN PGM A {name}\n{self.frame.text}{self._contour(unit)}{data}{called}M2\n{labels}END PGM A {name}\n"

    def _contour(self, unit):
        count = len(self._shapes)
        if not self.depths:
            return "CYCL DEF 14.0 C\nCYCL DEF 14.1 CONTOUR LABEL " + "/".join(map(str, range(1, count + 1))) + "\n"
        kinds = "P" * len(self.pockets) + "I" * len(self.islands)
        deep = [f" DEPTH{each / unit:.9f}" if each else "" for each in self.depths]
        return f"CONTOUR DEF {' '.join(f'{kinds[k]}{k + 1} = LBL {k + 1}{deep[k]}' for k in range(count))}\n"

    @property
    def _shapes(self):
        return [(each, True) for each in self.pockets] + [(each, False) for each in self.islands]

    def run(self):
        size, first = self.frame.scale, self.coarse or self.radius
        tools = {1: Tool(radius=first * size), 2: Tool(radius=self.radius * size), 3: Tool(radius=0.05, kind="drill", angle=118)}
        return mnclab.run(self.text, "tnc-620", mnclab.Setup(tools=tools))


def random_job(seed):
    """The program of a seed, without another one's luck."""
    task, random = random_task(seed), np.random.default_rng([seed, 620])
    many = random.random() < 0.1
    walls, islands = task.walls[: MOST_PARTS - 1 if many else 2], task.islands[: MOST_LABELS if many else random.integers(6)]
    depth, infeed = float(random.choice([4.0, 6.0, 9.5])), float(random.choice([4.0, 3.0, 20.0]))
    pockets = []
    for k, wall in enumerate(walls):  # begun outside the others, so that they are joined, or anywhere
        others = shapely.union_all([other.polygon(1e-3) for other in walls[:k] + walls[k + 1 :]])
        free = np.flatnonzero(~shapely.contains_xy(shapely.buffer(others, 1e-3), wall.points))
        first = int(free[0]) if len(free) and random.random() < 0.9 else 0
        pockets.append(Figure(np.roll(wall.points, -first, axis=0), np.roll(wall.bulge, -first)))
    deep = random.random() < 0.2
    islands = islands[: (MOST_PARTS if deep else MOST_LABELS) - len(pockets)]
    side = task.allowance or float(random.choice([0.0, 0.1, 0.3]))
    depths = ()
    if deep:
        own = random.choice([0.0, 2.5, depth - 1], len(pockets) - 1)
        depths = (0.0, *own.tolist(), *random.choice([0.0, 2.5, 3.0], len(islands)).tolist())
    frames = [Frame(), Frame(), Frame(True), Frame(False, 30), Frame(False, 0, 2), Frame(True, 0, 0.5), Frame(False, -110, 1.5)]
    overlap = task.stepover / task.radius
    return Job(
        pockets, islands, task.radius, task.radius * random.uniform(1.2, 3) if random.random() < 0.3 else 0.0,
        float(random.uniform(1, 1.5)) if random.random() < 0.1 else overlap, side, float(random.choice([0.0, 0.3])),
        float(random.choice([0.0, 0.0, 0.5, 3.0])), side / 2 * (random.random() < 0.3), bool(random.random() < 0.5),
        depth, infeed, frames[random.integers(len(frames))], bool(random.random() < 0.1), bool(random.random() < 0.2), depths,
    )  # fmt: skip


def _tool(number):
    return f"TOOL CALL {number} Z S2000 F500\nL Z+50 R0 FMAX M3\n"


def _block(name, unit, **values):
    """A definition: lengths, and in tuples what is none."""
    written = (v[0] if isinstance(v, tuple) else v / unit for v in values.values())
    return f"CYCL DEF {name}\n" + "".join(f"{a}={v:+.10f}\n" for a, v in zip(values, written, strict=True))


def _label(number, figure, pocket, unit):
    """A contour in the sense and on the side that say pocket or island; arcs by radius or by centre."""
    points, bulge = figure.points, figure.bulge
    if number % 3 == 0:  # the other way round
        points, bulge = np.roll(points[::-1], 1, axis=0), -bulge[::-1]
    twice = np.sum(points[:, 0] * np.roll(points[:, 1], -1) - points[:, 1] * np.roll(points[:, 0], -1))
    chords = np.roll(points, -1, axis=0) - points
    angle = 4 * np.arctan(bulge)
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = np.hypot(*chords.T) * (1 + bulge**2) / (4 * np.abs(bulge))
        twice += np.where(bulge == 0, 0.0, radius**2 * (angle - np.sin(angle))).sum()
    side = "RL" if (twice > 0) == pocket else "RR"
    lines = [f"LBL {number}", f"L X{points[0, 0] / unit:+.9f} Y{points[0, 1] / unit:+.9f} {side}"]
    for start, way, b, r in zip(points, chords, bulge, radius, strict=True):
        to = "X{:+.9f} Y{:+.9f}".format(*(start + way) / unit)
        sense = "DR+" if b > 0 else "DR-"
        if b == 0:
            lines.append(f"L {to}")
        elif abs(b) < 0.8 and number % 2:
            lines.append(f"CR {to} R{r / unit:+.9f} {sense}")
        else:
            centre = start + way / 2 + np.array([-way[1], way[0]]) * (1 - b * b) / (4 * b)
            lines += ["CC X{:+.9f} Y{:+.9f}".format(*centre / unit), f"C {to} {sense}"]
    return "\n".join([*lines, "LBL 0\n"])

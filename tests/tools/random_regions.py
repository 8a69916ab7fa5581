"""Random areas to be cleared, and the same areas made by shapely from the same numbers.

A figure is a closed outline: corners and bulges tan(sweep / 4), as in DXF. The area is the union of the walls less the
islands. Some walls and gaps are exactly as wide as the tool, some necks narrower, some corners cusps. Lengths in mm.
"""

from typing import NamedTuple

import numpy as np
import shapely

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region

HALF = 1.0  # the bulge of half a circle


class Figure(NamedTuple):
    """Corners `(n, 2)`, and the bulge `(n,)` of the element after each."""

    points: np.ndarray
    bulge: np.ndarray

    @property
    def contour(self):
        return Contour(self.points, self.bulge)

    def ring(self, chord_error):
        """The outline as a polyline, by angles about the centres of its arcs."""
        z = self.points @ np.array([1, 1j])
        places = []
        for a, b, bulge in zip(z, np.roll(z, -1), self.bulge, strict=True):
            places.append(a)
            if bulge:
                sweep = 4 * np.arctan(bulge)
                centre = (a + b) / 2 + 1j * (b - a) * (1 - bulge**2) / (4 * bulge)
                largest = 2 * np.arccos(max(1 - chord_error / abs(a - centre), 0.5))
                steps = int(np.ceil(abs(sweep) / largest))
                places += list(centre + (a - centre) * np.exp(1j * sweep * np.arange(1, steps) / steps))
        return np.array([(p.real, p.imag) for p in places])

    def polygon(self, chord_error):
        """What it encloses."""
        return shapely.Polygon(self.ring(chord_error))


class Task(NamedTuple):
    """What is cleared: walls and islands, with which tool radius, stepover (at most the radius) and allowance."""

    walls: list[Figure]
    islands: list[Figure]
    radius: float
    stepover: float
    allowance: float

    @property
    def region(self):
        return Region.union_of(*(wall.contour for wall in self.walls), holes=[island.contour for island in self.islands])

    def polygon(self, chord_error):
        """The same area as straight pieces, by shapely alone."""
        walls = shapely.union_all([wall.polygon(chord_error) for wall in self.walls])
        return shapely.difference(walls, shapely.union_all([island.polygon(chord_error) for island in self.islands]))


def disc(centre, radius):
    return Figure(np.array([centre + np.array([radius, 0]), centre - np.array([radius, 0])]), np.array([HALF, HALF]))


def box(centre, sides, angle, corner=0.0):
    """A rectangle with rounded corners, turned about its centre."""
    a, b = sides[0] / 2, sides[1] / 2
    corner = min(corner, 0.99 * min(a, b))
    if corner:
        points = [(a - corner, -b), (a, corner - b), (a, b - corner), (a - corner, b)]
        points += [(-x, -y) for x, y in points]
        bulge = [np.tan(np.pi / 8), 0] * 4
    else:
        points, bulge = [(a, -b), (a, b), (-a, b), (-a, -b)], [0, 0, 0, 0]
    return Figure(_placed(points, centre, angle), np.array(bulge, dtype=float))


def slot(centre, length, width, angle):
    """A straight slot with round ends."""
    a, h = length / 2, width / 2
    return Figure(_placed([(-a, -h), (a, -h), (a, h), (-a, h)], centre, angle), np.array([0, HALF, 0, HALF]))


def bow(centre, radius, width, begin, sweep):
    """A slot along an arc, with round ends."""
    inner, outer, half = radius - width / 2, radius + width / 2, np.tan(sweep / 4)
    at = np.array([(np.cos(a), np.sin(a)) for a in (begin, begin + sweep)])
    points = [outer * at[0], outer * at[1], inner * at[1], inner * at[0]]
    return Figure(centre + np.array(points), np.array([half, HALF, -half, HALF]))


def lens(centre, length, bulge, angle):
    """Two arcs that meet in two sharp corners."""
    return Figure(_placed([(-length / 2, 0), (length / 2, 0)], centre, angle), np.array([bulge, bulge]))


def star(random, centre, corners, least, most, bent):
    """Corners at random distances about a centre, joined by lines and, with the share `bent`, by arcs."""
    angle = 2 * np.pi * (np.arange(corners) + random.uniform(-0.3, 0.3, corners)) / corners
    reach = random.uniform(least, most, corners)
    points = centre + reach[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    bulge = np.where(random.random(corners) < bent, random.uniform(-0.5, 0.5, corners), 0.0)
    for _ in range(6):  # flatter, until no arc crosses another element
        figure = Figure(points, bulge)
        if figure.polygon(1e-5).is_valid:
            return figure
        bulge = bulge / 2
    return Figure(points, np.zeros(corners))


def comb(centre, teeth, gap, depth, angle, rounded):
    """A rack: `teeth` notches as wide as the webs between them, their grounds round or straight."""
    points, bulge, wide = [(0.0, -depth), (2 * teeth * gap, -depth)], [0.0, 0.0], HALF if rounded else 0.0
    for k in range(teeth, 0, -1):
        x = 2 * k * gap
        points += [(x, depth), (x - gap, depth), (x - gap, 0.0), (x - 2 * gap, 0.0)]
        bulge += [wide, 0.0, -wide, 0.0]
    return Figure(_placed(np.array(points) - [teeth * gap, 0], centre, angle), np.array(bulge, dtype=float))


def random_task(seed):
    """Walls, islands and tool of a seed."""
    random = np.random.default_rng(seed)
    radius = float(random.choice([1.5, 2.0, 3.0, 5.0, random.uniform(1, 6)]))
    wide = 2 * radius  # what the tool just passes
    widths = [wide, wide + 1e-3, wide - 1e-3, 0.8 * wide, 1.3 * wide, 2.5 * wide]
    walls = [_wall(random, np.array([60.0, 45.0]), 1.0, radius)]
    for _ in range(random.integers(0, 4)):
        at = random.uniform([5, 5], [115, 85])
        walls.append(_wall(random, at, 0.4, radius))
    for _ in range(random.integers(0, 3)):  # ways from one place to another
        a, b = random.uniform([0, 0], [120, 90], (2, 2))
        way = b - a
        walls.append(slot((a + b) / 2, np.hypot(*way), float(random.choice(widths)), np.arctan2(way[1], way[0])))
    if random.random() < 0.3:
        sweep = random.uniform(0.5, 4.5)
        width = float(random.choice(widths))
        middle = random.uniform([30, 30], [90, 60])
        walls.append(bow(middle, width + random.uniform(5, 40), width, random.uniform(0, 6), sweep))
    islands = [_island(random, radius) for _ in range(random.integers(0, 11))]
    if islands and random.random() < 0.4:  # a second one beside a disc, as far off as the tool is wide
        at, size = random.uniform([30, 20], [90, 70]), random.uniform(2, 8, 2)
        step = (size.sum() + float(random.choice(widths))) * np.array([0.6, 0.8])
        islands += [disc(at, size[0]), disc(at + step, size[1])]
    stepover = float(random.choice([1.0, 0.9, 0.5, random.uniform(0.3, 1)])) * radius
    allowance = float(random.choice([0.0, 0.0, 0.2, random.uniform(0, 0.5)]))
    return Task(walls, islands, radius, stepover, allowance)


def random_region(seed):
    """The area of a seed, and `chord_error -> the same area by shapely`."""
    task = random_task(seed)
    return task.region, task.polygon


def large_task(elements, islands=10, radius=3.0):
    """A pocket with islands, lines and arcs in turn, of about so many elements in all."""
    random = np.random.default_rng(elements)
    each = elements // (2 * islands + islands)
    walls = [_waved(np.array([110.0, 75.0]), np.array([105.0, 70.0]), elements - islands * each, 0.35)]
    places = [(x, y) for x in np.linspace(45, 175, (islands + 1) // 2) for y in (50, 100)][:islands]
    isles = [_waved(np.array(at), random.uniform(7, 11, 2), each, 0.3) for at in places]
    return Task(walls, isles, radius, 0.8 * radius, 0.0)


def _waved(centre, half_axes, elements, bent):
    """An ellipse of lines and of arcs that bulge outwards and inwards."""
    angle = 2 * np.pi * np.arange(elements) / elements
    points = centre + half_axes * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return Figure(points, np.resize([0.0, bent, 0.0, -bent], elements))


def _wall(random, at, size, radius):
    kind = random.integers(0, 6)
    angle = float(random.choice([0.0, np.pi / 6, random.uniform(0, np.pi)]))
    if kind == 0:
        return disc(at, size * random.uniform(25, 45))
    if kind == 1:
        corner = float(random.choice([0.0, radius, random.uniform(0, 12)]))
        return box(at, size * random.uniform([60, 40], [110, 80]), angle, corner)
    if kind == 2:
        return lens(at, size * random.uniform(60, 100), random.uniform(0.4, 0.9), angle)
    if kind == 3:
        gap = float(random.choice([2 * radius, 1.7 * radius, 3 * radius]))
        return comb(at, int(random.integers(2, 5)), gap, size * 20.0, angle, random.random() < 0.5)
    return star(random, at, int(random.integers(3, 25)), size * 18, size * 50, random.choice([0.0, 0.5, 1.0]))


def _island(random, radius):
    at = random.uniform([10, 10], [110, 80])
    kind, angle = random.integers(0, 5), random.uniform(0, np.pi)
    if kind == 0:
        return disc(at, random.uniform(0.5, 9))
    if kind == 1:
        return box(at, random.uniform(2, 18, 2), angle, float(random.choice([0.0, random.uniform(0, 5)])))
    if kind == 2:
        return slot(at, random.uniform(2, 20), random.uniform(1, 6), angle)
    if kind == 3:
        return lens(at, random.uniform(5, 20), random.uniform(0.2, 0.9), angle)
    return star(random, at, int(random.integers(3, 12)), 2.0, 9.0, 0.5)


def _placed(points, centre, angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(points, dtype=float) @ np.array([[c, s], [-s, c]]) + centre

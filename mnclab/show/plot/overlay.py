"""What is drawn over a path to show the idea behind its words: the centre of an arc, the pole of an angle.

A mirror line is in `original`, a hole at its diameter in `holes`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch

from mnclab.geometry import frames
from mnclab.path.listing import Unit, figure
from mnclab.path.toolpath import Array, Kind
from mnclab.show.chains import Chains
from mnclab.show.plot import colours
from mnclab.show.plot.colours import LineStyle, Mark
from mnclab.show.plot.picture import View
from mnclab.show.plot.placing import write_beside

# Each overlay is a value that knows the room it needs, its lines and its texts; `plot_path` asks them in this order.

ROOM = 2.5  # what would make the greatest side of a picture longer than so many times is left out
SAMPLES = 16  # points of a stroke that a text keeps off


class Overlay(Protocol):
    """Drawn over the path in every view."""

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        """The box (3,) and (3,) mm of the picture with what is drawn in it."""

    def names(self, views: Sequence[View]) -> list[str]:
        """What the legend names."""

    def draw(self, ax: Axes, view: View) -> list[Any]:
        """Add lines; those whose label the legend names are returned."""

    def write(self, ax: Axes, view: View, lines: Sequence[Array]) -> None:
        """Add texts, off the `lines` (m, 3); the limits of the axes are final."""


def across(view: View) -> int:
    """The coordinate along the line of sight."""
    return 3 - view.right - view.up


def grown(low: Array, high: Array, points: Array) -> tuple[Array, Array]:
    """A box with points (m, 3) in it, nan passed over."""
    for point in points:
        low, high = np.fmin(low, point), np.fmax(high, point)
    return low, high


def fits(low: Array, high: Array, points: Array) -> bool:
    """Whether points (m, 3) may be drawn without the picture becoming mostly empty."""
    wide_low, wide_high = grown(low, high, points)
    return bool((wide_high - wide_low).max() <= ROOM * max((high - low).max(), 1e-9))


def line(ax: Axes, view: View, points: Array, look: LineStyle | Mark, **more: Any) -> Line2D:
    """Points (m, 3) as a line of one view."""
    found = Line2D(points[:, view.right], points[:, view.up], **{**look.style(), **more})
    ax.add_line(found)
    return found


def texts(
    ax: Axes, view: View, told: Iterable[tuple[str | Sequence[str], Any, Any]], lines: Sequence[Array],
    colour: str = colours.INK, mark: float = 0.0,
) -> int:  # fmt: skip
    """Write texts, each beside its place (3,) and best in a direction (2,), off a mark of a radius in points; how many had no
    room is returned."""
    if not (found := [*told]):
        return 0
    said, places, wishes = zip(*found)
    axes = [view.right, view.up]
    choices = [(one,) if isinstance(one, str) else tuple(one) for one in said]
    drawn = [_dense(each[:, axes]) for each in lines if 1 < len(each) < 2000]
    figure = ax.get_figure(root=True)
    pixels = float(np.ptp(ax.transData.transform([(0.0, 0.0), (1.0, 0.0)])[:, 0]))  # of a mm
    radius = mark * (figure.dpi if figure else 72.0) / 72 / pixels
    return write_beside(ax, choices, np.array(places)[:, axes], [radius] * len(places), np.array(wishes), drawn, colour)


def _dense(points: Array) -> Array:
    share = np.linspace(0, 1, SAMPLES, endpoint=False)[:, None, None]
    between = (points[:-1] + (points[1:] - points[:-1]) * share).reshape(-1, 2)
    return between[np.isfinite(between).all(axis=1)]


# Where arcs have their centres, and how the program says so: I and J from the start, or R.
# A leg is drawn only where the word of the block, in the frame of the block, truly leads to the centre: of controls that write
# the centre itself the centre is named.

FEW, MOST = 4, 40  # arcs of a program whose centres are shown unasked, and at most
SAME = 2e-3  # mm between what a word says and where the centre is
HEAD: dict[str, Any] = {"arrowstyle": "-|>", "color": colours.LEG.colour, "linewidth": 0.0, "mutation_scale": 9}
HEAD |= {"shrinkA": 0, "shrinkB": 0, "zorder": colours.LEG.order}
PLAIN = 0.999  # the cosine from which on a plane is that of the view


class Arc(NamedTuple):
    """Start and centre (3,), the legs from one to the other (from, to, text), what the radius is called, its normal (3,)."""

    start: Array
    centre: Array
    legs: tuple[tuple[Array, Array, str], ...]
    radius: str
    normal: Array


class Centres(NamedTuple):
    """The arcs whose centres are shown."""

    arcs: list[Arc]

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        self.arcs[:] = [arc for arc in self.arcs if fits(low, high, arc.centre[None])]
        return grown(low, high, np.array([arc.centre for arc in self.arcs]).reshape(-1, 3))

    def names(self, views: Sequence[View]) -> list[str]:
        return [colours.CENTRE.name] if any(self._seen(view) for view in views) else []

    def _seen(self, view: View) -> list[Arc]:
        return [arc for arc in self.arcs if abs(arc.normal[across(view)]) > PLAIN]

    def draw(self, ax: Axes, view: View) -> list[Any]:
        seen = self._seen(view)
        for arc in seen:
            line(ax, view, np.array([arc.start, arc.centre]), colours.SPOKE)
            for begin, end, _ in arc.legs:
                flat = (tuple(each[[view.right, view.up]]) for each in (begin, end))
                ax.add_patch(FancyArrowPatch(*flat, **HEAD))
                line(ax, view, np.array([begin, end]), colours.LEG)
        places = np.array([arc.centre for arc in seen]).reshape(-1, 3)
        return [line(ax, view, places, colours.CENTRE)] if seen else []

    def write(self, ax: Axes, view: View, lines: Sequence[Array]) -> None:
        told, axes = [], [view.right, view.up]
        for arc in self._seen(view):
            middle = (arc.start + arc.centre) / 2
            for begin, end, text in arc.legs:
                away = (begin + end) / 2 - middle
                told.append((text, (begin + end) / 2, _unit(away[axes], (0.0, -1.0))))
            if arc.radius:
                along = _unit((arc.centre - arc.start)[axes], (1.0, 0.0))
                told.append((arc.radius, middle, (-along[1], along[0])))
        own = [np.array([arc.start, arc.centre]) for arc in self._seen(view)]
        own += [np.array(leg[:2]) for arc in self._seen(view) for leg in arc.legs]
        texts(ax, view, told, [*lines, *own], colours.CENTRE.colour)


def _unit(way: Array, otherwise: tuple[float, float]) -> tuple[float, float]:
    size = float(np.hypot(*way))
    return (float(way[0] / size), float(way[1] / size)) if size > 1e-9 else otherwise


def centres_of(run: Any, wanted: bool | None = None) -> Centres | None:
    """The arcs that blocks of a run say themselves (not those of cycles); None where there are none, or unasked too many."""
    path = run.programmed
    plain = [number for number, label in enumerate(path.labels) if not label]
    rows = np.flatnonzero((path.kind == Kind.ARC) & np.isin(path.label, plain)).tolist()
    if wanted is False or not 0 < len(rows) <= (MOST if wanted else FEW) or (wanted is None and path.side.any()):
        return None
    chains, arcs = Chains(run), []
    for row in rows:
        step = int(path.step[row])
        block = run.programs[run.steps.program[step]][int(run.steps.block[step])]
        words = {word.address: word for word in block.words if isinstance(word.value, float)}
        arcs.append(_arc(path, row, words, chains.at(step).matrix[:3, :3], path.unit))
    return Centres(_merged(arcs))


def _merged(arcs: list[Arc]) -> list[Arc]:
    """Arcs with one start and one centre share their spoke and its names."""
    found: dict[tuple[float, ...], Arc] = {}
    for arc in arcs:
        key = tuple(np.round([*arc.start, *arc.centre], 6).tolist())
        if (known := found.get(key)) and not arc.legs and arc.radius not in known.radius.split(", "):
            arc = known._replace(radius=", ".join(filter(None, (known.radius, arc.radius))))
        found[key] = arc
    return list(found.values())


def _short(word: Any) -> str:
    """A word as the program has it, but of a number with many decimals three: R14.142."""
    written = str(word)
    return written if len(written.partition(".")[2]) <= 3 else f"{word.address}{word.value:.3f}"


def _arc(path: Any, row: int, words: dict[str, Any], linear: Array, unit: Unit) -> Arc:
    start, centre, normal = path.start[row], path.centre[row].copy(), path.axis[row]
    centre += normal * float(normal @ (start - centre))  # of a helix: at the height of its start
    told = np.array([words[letter].value if letter in words else 0.0 for letter in "IJK"]) * unit.length
    way = np.linalg.solve(linear, centre - start)  # as the program counts
    legs, here = [], start
    if told.any() and np.abs(told - way).max() < SAME:
        for letter, part in zip("IJK", np.diag(told)):
            if part.any():
                there = here + linear @ part
                legs.append((here, there, _short(words[letter])))
                here = there
    size = float(np.linalg.norm(way))
    by_radius = [w for a, w in words.items() if a in ("R", "K") and abs(abs(w.value) * unit.length - size) < SAME]
    true = unit.figure(float(np.linalg.norm(centre - start)), 1)
    called = _short(by_radius[0]) if by_radius else f"radius {true}"
    if by_radius and unit.figure(size, 1) != true:  # scaled
        called += f", scaled to {true}"
    return Arc(start, centre, tuple(legs), "" if legs else called, normal)


# Points told by a radius and an angle about a pole: the rays to them, the angle of the first.

WORDS = ("G10", "G11", "G12", "G13", "LP", "CP", "CTP")  # motion to a point in polar coordinates
MOST_RAYS = 12  # rays of a picture
PLACE, BOW = 0.6, 0.3  # of a ray: where its angle is written, the radius of the arc of the first


class Ray(NamedTuple):
    """From the pole (3,) to a point (3,): radius, mm, and angle, degrees, as the program counts; the direction of angle 0."""

    pole: Array
    point: Array
    radius: float
    angle: float
    zero: Array


class PolarRays(NamedTuple):
    """The rays, all in planes that lie as XY, and in which unit their radii are told."""

    rays: list[Ray]
    unit: Unit

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        self.rays[:] = [ray for ray in self.rays if fits(low, high, ray.pole[None])]
        return grown(low, high, np.array([ray.pole for ray in self.rays]).reshape(-1, 3))

    def names(self, views: Sequence[View]) -> list[str]:
        return []

    def draw(self, ax: Axes, view: View) -> list[Any]:
        for ray in self.rays if across(view) == 2 else ():
            line(ax, view, np.array([ray.pole, ray.point]), colours.SPOKE)
        if (first := self._first(view)) is not None:
            long = float(np.hypot(*(first.point - first.pole)[:2]))
            line(ax, view, np.array([first.pole, first.pole + long * first.zero]), colours.SPOKE)
            line(ax, view, _bow(first, BOW * long), colours.LEG)
        return []

    def _first(self, view: View) -> Ray | None:
        turned = (ray for ray in self.rays if abs(math.remainder(ray.angle, 360)) > 1)
        return next(turned, None) if across(view) == 2 else None

    def write(self, ax: Axes, view: View, lines: Sequence[Array]) -> None:
        told, before = [], None
        for ray in self.rays if across(view) == 2 else ():
            radius = f"R{self.unit.figure(ray.radius, 1)}"
            angle = f"{figure(ray.angle, 3)}°".replace("-", "\N{MINUS SIGN}")
            x, y, _ = way = ray.point - ray.pole
            said = angle if radius == before else f"{radius}, {angle}"
            told.append((said, ray.pole + PLACE * way, (-y / np.hypot(x, y), x / np.hypot(x, y))))
            before = radius
        own = [np.array([ray.pole, ray.point]) for ray in self.rays]
        texts(ax, view, told, [*lines, *own], colours.CENTRE.colour)


def _bow(ray: Ray, radius: float) -> Array:
    """Points (n, 3) of the arc from angle 0 to the ray, the way that its sign says."""
    way = ray.point[:2] - ray.pole[:2]
    begin = math.atan2(ray.zero[1], ray.zero[0])
    sweep = math.remainder(math.atan2(way[1], way[0]) - begin, 2 * math.pi)
    if sweep * ray.angle < 0 and abs(abs(ray.angle) - math.degrees(abs(sweep))) > 1:
        sweep -= math.copysign(2 * math.pi, sweep)
    angle = begin + np.linspace(0.0, sweep, 33)
    return ray.pole + radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)


def polar_of(run: Any) -> PolarRays | None:
    """The points that a run goes to by radius and angle; None where there are none, or too many."""
    if "pole" not in run.history:
        return None
    path, history, chains = run.programmed, run.history, Chains(run)
    found: dict[tuple[float, ...], Ray] = {}
    for row in np.flatnonzero(path.is_motion & (np.append(np.diff(path.step), 1) > 0)).tolist():
        step = int(path.step[row])
        block = run.programs[run.steps.program[step]][int(run.steps.block[step])]
        pole = history.value("pole", step)
        code = block.keyword or history.value("motion", step)
        if pole is None or code not in WORDS or history.value("pole plane", step) not in (None, "XY"):
            continue
        matrix, here = chains.at(step).matrix, np.array(history.value("position", step))
        way = here[:2] - pole
        level = abs(matrix[2, 2]) > 1 - 1e-9 and abs(path.axis[row, 2]) > 1 - 1e-9
        if not level or np.hypot(*way) < 1e-6:
            continue
        ends = frames.apply(matrix, np.array([(*pole, here[2]), here])) - path.origin
        zero = matrix[:3, 0] / np.linalg.norm(matrix[:3, 0])
        key = tuple(np.round(ends[:, :2].ravel(), 6).tolist())
        angle = math.degrees(math.atan2(way[1], way[0]))
        found.setdefault(key, Ray(ends[0], ends[1], float(np.hypot(*way)), angle + 0.0, zero))
        if len(found) > MOST_RAYS:
            return None
    return PolarRays(list(found.values()), path.unit) if found else None

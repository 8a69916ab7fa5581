"""Points told by a radius and an angle about a pole: the rays to them, the angle of the first."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from mnclab.geometry import frames
from mnclab.path.listing import Unit, figure
from mnclab.path.toolpath import Array
from mnclab.show.plot import colours
from mnclab.show.plot.chains import Chains
from mnclab.show.plot.overlay import across, fits, grown, line, texts
from mnclab.show.plot.picture import View

WORDS = ("G10", "G11", "G12", "G13", "LP", "CP", "CTP")  # motion to a point in polar coordinates
MOST = 12  # rays of a picture
PLACE, BOW = 0.6, 0.3  # of a ray: where its angle is written, the radius of the arc of the first


class Ray(NamedTuple):
    """From the pole (3,) to a point (3,): radius, mm, and angle, degrees, as the program counts; the direction of angle 0."""

    pole: Array
    point: Array
    radius: float
    angle: float
    zero: Array


class Polar(NamedTuple):
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
        said, places, wishes, told = [], [], [], None
        for ray in self.rays if across(view) == 2 else ():
            radius = f"R{self.unit.figure(ray.radius, 1)}"
            angle = f"{figure(ray.angle, 3)}°".replace("-", "\N{MINUS SIGN}")
            said.append(angle if radius == told else f"{radius}, {angle}")
            told = radius
            places.append(ray.pole + PLACE * (ray.point - ray.pole))
            way = (ray.point - ray.pole)[:2]
            wishes.append((-way[1] / np.hypot(*way), way[0] / np.hypot(*way)))
        own = [np.array([ray.pole, ray.point]) for ray in self.rays]
        texts(ax, view, said, np.array(places).reshape(-1, 3), np.array(wishes), [*lines, *own], colours.CENTRE.colour)


def _bow(ray: Ray, radius: float) -> Array:
    """Points (n, 3) of the arc from angle 0 to the ray, the way that its sign says."""
    way = ray.point[:2] - ray.pole[:2]
    begin = math.atan2(ray.zero[1], ray.zero[0])
    sweep = math.remainder(math.atan2(way[1], way[0]) - begin, 2 * math.pi)
    if sweep * ray.angle < 0 and abs(abs(ray.angle) - math.degrees(abs(sweep))) > 1:
        sweep -= math.copysign(2 * math.pi, sweep)
    angle = begin + np.linspace(0.0, sweep, 33)
    return ray.pole + radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)


def polar_of(run: Any) -> Polar | None:
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
        if len(found) > MOST:
            return None
    return Polar(list(found.values()), path.unit) if found else None

"""Where arcs have their centres, and how the program says so: I and J from the start, or R.

A leg is drawn only where the word of the block, in the frame of the block, truly leads to the centre: of controls that write
the centre itself the centre is named.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import FancyArrowPatch

from mnclab.path.listing import Unit
from mnclab.path.toolpath import Array, Kind
from mnclab.show.plot import colours
from mnclab.show.plot.chains import Chains
from mnclab.show.plot.overlay import across, fits, grown, line, texts
from mnclab.show.plot.picture import View

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
        said, places, wishes = [], [], []
        axes = [view.right, view.up]
        for arc in self._seen(view):
            middle = (arc.start + arc.centre) / 2
            for begin, end, text in arc.legs:
                away = (begin + end) / 2 - middle
                said.append(text)
                places.append((begin + end) / 2)
                wishes.append(_unit(away[axes], (0.0, -1.0)))
            if arc.radius:
                said.append(arc.radius)
                places.append(middle)
                along = _unit((arc.centre - arc.start)[axes], (1.0, 0.0))
                wishes.append((-along[1], along[0]))
        own = [np.array([arc.start, arc.centre]) for arc in self._seen(view)]
        own += [np.array(leg[:2]) for arc in self._seen(view) for leg in arc.legs]
        texts(ax, view, said, np.array(places).reshape(-1, 3), np.array(wishes), [*lines, *own], colours.CENTRE.colour)


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

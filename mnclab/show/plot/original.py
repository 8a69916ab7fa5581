"""What turns, mirrors or scales a contour: the contour as written, the mirror line, the pole and the angle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from mnclab.geometry import frames
from mnclab.geometry.frames import FrameChain
from mnclab.path.listing import Unit, figure
from mnclab.path.toolpath import Array, Kind
from mnclab.show.chains import Chains, without
from mnclab.show.plot import colours
from mnclab.show.plot.overlay import across, fits, grown, line, texts
from mnclab.show.plot.picture import View
from mnclab.show.plot.strokes import parted, strokes

MIRROR, TURN = "mirror", "rotation"
CHANGING = (TURN, MIRROR, "scaling", "scale", "axis scales")
MOST, ROWS = 300, 20_000  # chains of frames, and rows of a path, beyond which nothing is drawn
SAME = 1e-6
REACH = 0.24  # of the greatest side of the box: the arms of an angle
WAY = 0.62  # of an arm: where its arc lies


class Mirror(NamedTuple):
    """A point (3,) of a mirror line, the coordinate that it mirrors, the directions of the others (2, 3), its name."""

    point: Array
    arms: Array
    name: str


class Turn(NamedTuple):
    """The pole (3,) of a rotation in XY, the directions (3,) of angle 0 before and after it, and the angle, rad."""

    pole: Array
    before: Array
    after: Array
    angle: float


class Original(NamedTuple):
    """Strokes (m, 3) of the contour as written, broken by nan; mirror lines; turns; `size` of the box in a list."""

    points: Array
    mirrors: list[Mirror]
    turns: list[Turn]
    size: list[float]

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        if len(self.points) and fits(low, high, self.points):
            low, high = grown(low, high, np.array([np.nanmin(self.points, axis=0), np.nanmax(self.points, axis=0)]))
        self.mirrors[:] = [each for each in self.mirrors if fits(low, high, each.point[None])]
        self.turns[:] = [each for each in self.turns if fits(low, high, each.pole[None])]
        marks = [each.point for each in self.mirrors] + [each.pole for each in self.turns]
        low, high = grown(low, high, np.array(marks).reshape(-1, 3))
        self.size.append(float((high - low).max()))
        return low, high

    def names(self, views: Sequence[View]) -> list[str]:
        seen = any(self._lines(view) for view in views)
        turned = any(self._turns(view) for view in views)
        found = [colours.ORIGINAL.name] if len(self.points) else []
        return found + [colours.MIRROR.name] * seen + [colours.TURN_POLE.name] * turned

    def draw(self, ax: Axes, view: View) -> list[Any]:
        found = [line(ax, view, self.points, colours.ORIGINAL)] if len(self.points) else []
        for point, way, _ in self._lines(view):
            look = {key: value for key, value in colours.MIRROR.style().items() if key != "solid_capstyle"}
            found.append(ax.axline(tuple(point), tuple(point + way), **look))
        for each in self._turns(view):
            reach = REACH * self.size[-1]
            for arm in (each.before, each.after):
                line(ax, view, np.array([each.pole, each.pole + reach * arm]), colours.SPOKE)
            line(ax, view, _arc(each, WAY * reach), colours.LEG)
            found.append(line(ax, view, each.pole[None], colours.TURN_POLE))
        return found

    def write(self, ax: Axes, view: View, lines: Sequence[Array]) -> None:
        axes, told = [view.right, view.up], []
        limits = np.array([ax.get_xlim(), ax.get_ylim()])
        for point, way, name in self._lines(view):
            for share in (0.94, 0.06):  # near an end of the line, where it is seen
                steps = (limits[0, 0] + share * np.ptp(limits[0]) - point[0], limits[1, 0] + share * np.ptp(limits[1]) - point[1])
                k = int(np.argmax(np.abs(way)))
                place = point + way * steps[k] / way[k]
                if ((limits[:, 0] <= place) & (place <= limits[:, 1])).all():
                    break
            xyz = np.full(3, np.nan)
            xyz[axes] = place
            told.append((name, xyz, (abs(way[1]), -abs(way[0]))))
        for each in self._turns(view):
            middle = _arc(each, WAY * REACH * self.size[-1])[8]
            away = (middle - each.pole)[axes]
            said = f"{figure(math.degrees(each.angle), 3)}°".replace("-", "\N{MINUS SIGN}")
            told.append((said, middle, away / np.hypot(*away)))
        texts(ax, view, told, [*lines, self.points], colours.CENTRE.colour)

    def _turns(self, view: View) -> list[Turn]:
        return self.turns if across(view) == 2 else []

    def _lines(self, view: View) -> list[tuple[Array, Array, str]]:
        """Mirror lines as this view has them: a point (2,), a direction (2,), a name; none that is seen as a face."""
        axes = [view.right, view.up]
        found = []
        for each in self.mirrors:
            flat = each.arms[:, axes]
            sizes = np.hypot(*flat.T)
            seen = flat[int(np.argmax(sizes))]
            if sizes.max() > 0.5 and sizes.min() < SAME:  # its plane is looked along
                found.append((each.point[axes], seen / sizes.max(), each.name))
        return found


def _arc(turn: Turn, radius: float) -> Array:
    """The arc of an angle, 17 points (17, 3)."""
    angle = np.linspace(0.0, turn.angle, 17)[:, None]
    square = np.cross((0.0, 0.0, 1.0), turn.before)
    return np.asarray(turn.pole + radius * (np.cos(angle) * turn.before + np.sin(angle) * square))


def original_of(run: Any) -> Original | None:
    """What a run turns, mirrors and scales; None where it does not, or too often for a picture."""
    path = run.programmed
    if not any(f"frame {name}" in run.history for name in CHANGING) or len(path) > ROWS:
        return None
    chains = Chains(run)
    changing = [any(name in chain for name in CHANGING) for chain in chains.chains]
    if len(chains) > MOST or not any(changing):
        return None
    mirrors: dict[Any, Mirror] = {}
    turns: dict[Any, Turn] = {}
    for chain, changes in zip(chains.chains, changing):
        if changes:
            mirrors |= {_key(each.point, each.arms): each for each in _mirrors(chain, path.origin, path.unit)}
            turns |= {_key(each.pole, each.angle): each for each in _turned(chain, path.origin)}
    return Original(_as_written(path, chains, changing), list(mirrors.values()), list(turns.values()), [])


def _key(*values: Any) -> tuple[float, ...]:
    return tuple(float(v) + 0.0 for value in values for v in np.round(np.ravel(value), 6))


def _as_written(path: Any, chains: Chains, changing: list[bool]) -> Array:
    """The cuts that a frame changes, without it: each point goes back through the frames in force where it is reached."""
    drawn = strokes(path)
    which = np.searchsorted(chains.steps, path.step, "right") - 1
    state = np.where(drawn.row >= 0, which[drawn.row], -1)
    begins = np.flatnonzero(state < 0)
    at = np.append(drawn.row, -1)[np.minimum(begins + 1, len(drawn.row))]
    state[begins] = np.where(at > 0, which[np.maximum(at - 1, 0)], 0)  # a stroke begins where the block before has left it
    xyz = drawn.xyz.copy()
    for k in np.unique(state).tolist():
        if changing[k]:
            chain = chains.chains[k]
            back = without(chain, CHANGING) @ frames.inverse(chain.matrix)
            mine = state == k
            xyz[mine] = frames.apply(back, drawn.xyz[mine] + path.origin) - path.origin
    cut = (drawn.row >= 0) & np.isin(path.kind[drawn.row], (Kind.LINE, Kind.ARC))
    moved = np.abs(xyz - drawn.xyz).max(axis=1, initial=0.0) > SAME
    moved[1:] |= moved[:-1]
    joint = (path.kind == Kind.ARC) & (np.append(which[:1], which[:-1]) != which)  # half of such an arc is in each frame
    return parted(xyz, np.where(cut & moved & ~joint[drawn.row], 0, -1), 1)[0]


def _mirrors(chain: FrameChain, origin: Array, unit: Unit) -> list[Mirror]:
    matrix = chain[MIRROR]
    outer = chain.before(MIRROR)
    if not np.array_equal(np.abs(matrix[:3, :3]), np.eye(3)):
        return []
    found = []
    for k in np.flatnonzero(matrix.diagonal()[:3] < 0).tolist():
        point = np.zeros(3)
        point[k] = matrix[k, 3] / 2
        arms, place = np.delete(outer[:3, :3], k, axis=1).T, frames.apply(outer, point) - origin
        scale = abs(place[k] - point[k]) < SAME  # that of the picture; under a shift the number would be another
        found.append(Mirror(place, arms, f"mirror {'XYZ'[k]}{unit.figure(point[k], 1) if scale else ''}"))
    return found


def _turned(chain: FrameChain, origin: Array) -> list[Turn]:
    """The turn of a plane XY that lies as that of the machine; none of another plane, whose angle would not be seen."""
    matrix, outer = chain[TURN], chain.before(TURN)
    level = abs(outer[2, 2]) > 1 - SAME and matrix[2, 2] == 1
    angle = math.atan2(matrix[1, 0], matrix[0, 0])
    if not level or abs(angle) < SAME:
        return []
    pole = np.zeros(3)
    pole[:2] = np.linalg.solve(np.eye(2) - matrix[:2, :2], matrix[:2, 3])
    before, after = outer[:3, 0], outer[:3, :3] @ matrix[:3, 0]
    place = frames.apply(outer, pole) - origin
    place[2] = np.nan
    turned = angle if np.linalg.det(outer[:3, :3]) > 0 else -angle
    return [Turn(place, before / np.linalg.norm(before), after / np.linalg.norm(after), turned)]

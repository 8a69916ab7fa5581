"""The rows of a path that move in the plane, as elements of a contour; and the rules that all parts of the pass share."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.curves import Curves, Element, beside, dot, left
from mnclab.geometry.cutting import boxes, lengths
from mnclab.path.corners import Prolonged
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import Array, Index, Mask, PathFault, Toolpath, gathered

# What controls differ in when they compensate the radius, and the words that all parts of the pass share.

TANGENT = np.radians(0.001)  # corners that turn less are none (setting tangent_tolerance of the MNC)
CUSP = np.radians(170)  # where arcs turn back by more, not the turn but what the elements do beside it counts
CLEAR = 1e-6  # mm: nearer to its neighbours than its radius less this the tool cuts into them
ACUTE_TURN = np.pi / 2 + TANGENT  # a corner that turns more is acute
SPIKE_TURN = np.radians(170)  # straight corners that turn more are worth a notice (MNC-G161-SPIKE)
CORNER = "outside corner"  # label of inserted arcs

#: Values of the column `corner_rule`: how outside corners are joined (MNC: G160, G161, G162).
ROUND, STRAIGHT, ACUTE = 0, 1, 2


@dataclass(frozen=True)
class Compensation:
    """How a control enters, leaves and changes the equidistant.

    `approach` "perpendicular": the entry ends, and the exit begins, square to the contour; "corner": outside, the
    first and last corners are built like any other (MNC tables 7.1 and 7.3). `rapid`: entry and exit may run at
    rapid. `change`: the side may change on the way, by a straight line that leads over like an entry. `arc_entry`: it
    may begin with an arc, which becomes one about another centre that ends square to the contour. `straight_exit`: the exit
    begins where the offset of the last element ends, whatever the corner. `look_ahead`: the whole contour is looked at, else
    each element with its neighbours only (and always what a cusp leads back to). A joint counts as tangent below `TANGENT`,
    0.001 degrees; any greater turn is a corner and is built exactly.
    """

    approach: str = "perpendicular"
    rapid: bool = False
    change: bool = False
    look_ahead: bool = False
    arc_entry: bool = False
    straight_exit: bool = False

    def chosen(self, settings: Mapping[str, Any]) -> Compensation:
        """These rules as the settings of a control have them."""
        own = settings.get("compensation_leads") == "linuxcnc"
        return replace(self, arc_entry=True, straight_exit=True) if own else self


class Gouge(NamedTuple):
    """A place where the tool does not fit.

    `kind` is "arc", "element", "neighbour", "bottleneck", "end", "corner", "entry" or "exit"; `line` and `step` are
    those of the block in which the tool would cut into the contour, `other` is the line that it would cut into.
    `place` (x, y, z) is the point of the contour, mm; `width` mm is what there is and `missing` mm what it lacks;
    `largest` is the largest radius for the whole contour, from its entry to its exit or change of side.
    """

    kind: str
    line: int
    step: int
    other: int
    place: tuple[float, float, float]
    radius: float
    width: float
    missing: float
    largest: float
    message: str
    hint: str = ""

    def __repr__(self) -> str:
        return f"<Gouge line {self.line}: {self.message}>"


@dataclass
class Report:
    """What the pass has to say: places that do not fit, and remarks at a step."""

    gouges: list[Gouge] = field(default_factory=list)
    notices: list[PathFault] = field(default_factory=list)

    def remarks(self) -> list[tuple[str, int, str]]:
        return [(g.message, g.step, g.hint) for g in self.gouges] + [(n.message, n.step, n.hint) for n in self.notices]


# The rows of a path that move in the plane, as elements of a contour.

class Elements(NamedTuple):
    """n elements in the order of travel, lengths in mm, angles in rad.

    `rows` (n,) are their rows in the path; `start`, `end`, `centre` (n, 2); `t_in`, `t_out` (n, 2) unit
    tangents; `r` (n,) radii of arcs, nan for lines; `sweep` (n,). `on` (n,): compensated; `s`, `R` (n,) side
    and radius there, 0 elsewhere. `entry`, `exit`, `change` (n,): first element, the one after the last, and the
    one that leads to the other side. `corner` (n,) is the rule for the corner before the element; `from_height`,
    `to_height` (n,) mm is where the tip of the tool is at both ends, along the normal of the plane.
    """

    rows: Index
    start: Array
    end: Array
    centre: Array
    t_in: Array
    t_out: Array
    r: Array
    sweep: Array
    arc: Mask
    on: Mask
    s: Array
    R: Array
    entry: Mask
    exit: Mask
    change: Mask
    corner: NDArray[np.uint8]
    from_height: Array
    to_height: Array

    @classmethod
    def of(cls, path: Toolpath, view: PlaneView, rows: Index) -> Elements:
        of_rows = (lambda column: column) if len(rows) == len(path) else partial(gathered, source=rows)
        start, end, side, radius = (of_rows(column) for column in (view.start, view.end, path.side, path.radius))
        on = (side != 0) & (radius != 0)
        s = np.where(on, np.sign(side * radius), 0.0)  # a negative radius is the other side
        before = np.concatenate([[False], on[:-1]])
        turned = np.concatenate([[False], s[1:] != s[:-1]]) & on & before
        return cls(
            rows, start[:, :2], end[:, :2], of_rows(view.centre), of_rows(view.tangent_start),
            of_rows(view.tangent_end), of_rows(view.radius), of_rows(view.sweep), of_rows(view.arc),
            on, s, np.where(on, np.abs(radius), 0.0), on & ~before, before & ~on, turned, _corner_rules(path, rows),
            start[:, 2], end[:, 2],
        )  # fmt: skip

    @property
    def lead(self) -> Mask:
        """The elements that lead to a contour: no wall is there."""
        return self.entry | self.change

    @property
    def wall(self) -> Mask:
        """The elements beside which the tool cuts."""
        return self.on & ~self.lead

    def offset(self, k: Index, at_end: bool, shift: Array, s: Array) -> Element:
        """Elements k (m,) moved by `shift` mm to the side `s` (m,), seen from their end or their start."""
        t, p = (self.t_out[k], self.end[k]) if at_end else (self.t_in[k], self.start[k])
        radius = self.r[k] - s * np.sign(self.sweep[k]) * shift
        return Element(p + (shift * s)[:, None] * left(t), t, self.centre[k], radius)

    def entry_arc(self, k: Index, shift: Array, s: Array) -> Element:
        """The arcs from where entries k (m,) begin to their offset ends, which run into the contour as the programmed ones do:
        about a point of the line from the end to the programmed centre, as far from both."""
        t = self.t_out[k]
        end = beside(self.end[k], t, shift * s)
        chord, toward = self.start[k] - end, self.centre[k] - end
        toward /= np.hypot(*toward.T)[:, None]
        radius = dot(chord, chord) / (2 * dot(chord, toward))
        return Element(end, t, end + toward * radius[:, None], radius)

    def boxes(self, k: Index, contour: Index) -> tuple[Array, Array]:
        """Low and high corners (m, 2) of boxes round elements k (m,); those of each contour (n,) lie far from all others."""
        low, high = boxes(self.curves(k))
        away = (high.max(axis=0) - low.min(axis=0) + 4 * self.R.max())[0] * (contour[k] - contour[k[0]])
        low[:, 0] += away
        high[:, 0] += away
        return low, high

    def length(self, k: Index | slice) -> Array:
        """How long elements k (m,) are, mm in the plane."""
        return lengths(self.curves(k))

    def curves(self, k: Index | slice) -> Curves:
        """Elements k (m,) as they are programmed."""
        return Curves(self.start[k], self.end[k], self.centre[k], self.r[k], self.sweep[k])

    def moved(self, k: Index, shift: Array, s: Array) -> Curves:
        """Elements k (m,) moved by `shift` mm to the side `s` (m,), from end to end."""
        start, end = beside(self.start[k], self.t_in[k], shift * s), beside(self.end[k], self.t_out[k], shift * s)
        radius = np.abs(self.r[k] - s * np.sign(self.sweep[k]) * shift)
        return Curves(start, end, self.centre[k], radius, self.sweep[k])


def _corner_rules(path: Toolpath, rows: Index) -> NDArray[np.uint8]:
    """The rule (n,) for the corner before each element: that of its row, or straight behind one that says so."""
    prolonged = [isinstance(joint, Prolonged) for joint in path.joints]
    if not any(prolonged):
        return gathered(path.corner_rule, rows)
    rule, joint = path.corner_rule[rows], path.joint[rows]
    rule[1:][np.array([*prolonged, False])[joint[:-1]]] = STRAIGHT
    return rule


# Heights of the tool: a tool cuts into an element only where it goes as deep.
# Two elements *meet* if there is a height, along the normal of the plane, that the tip of the tool has in both. What is
# done at other heights is another pass, a way in the air or a step of the part: a pass below another one takes away what
# the program tells it to, and a retracted tool crosses above everything. On a ramp the tool works all the way down, so an
# element that descends also meets what follows it without a lift or a plunge, however much deeper.

SAME = 1e-6  # mm


def meet(el: Elements, i: Index, j: Index) -> Mask:
    """Whether elements i and j (m,) meet."""
    first, last = np.minimum(i, j), np.maximum(i, j)
    result = _overlap(*_range(el, first), *_range(el, last))
    k = np.flatnonzero(~result & (el.to_height[first] < el.from_height[first] - SAME))
    if len(k):
        result[k] = _way_down(el)[first[k]] == _way_down(el)[last[k]]
    return result


def at_height(el: Elements, height: float, k: Index) -> Mask:
    """Which of the elements k (m,) have a height."""
    return _overlap(np.full(len(k), height), np.full(len(k), height), *_range(el, k))


def retracted(el: Elements, contour: Index) -> Mask:
    """Which elements (n,) run higher than their contour does both before and after them."""
    n, low = len(el.rows), np.minimum(el.from_height, el.to_height)
    result = np.zeros(n, dtype=bool)
    changes = np.flatnonzero(np.diff(low))  # a contour at one height has no such way
    for k in np.unique(contour[changes]):
        a = int(np.searchsorted(contour, k))
        z = low[a : int(np.searchsorted(contour, k, "right"))]
        before, after = np.minimum.accumulate(z), np.minimum.accumulate(z[::-1])[::-1]
        result[a : a + len(z)] = (z > before + SAME) & (z > after + SAME)
    return result


def _range(el: Elements, k: Index) -> tuple[Array, Array]:
    return np.minimum(el.from_height[k], el.to_height[k]), np.maximum(el.from_height[k], el.to_height[k])


def _overlap(low: Array, high: Array, other_low: Array, other_high: Array) -> Mask:
    return np.asarray((low <= other_high + SAME) & (other_low <= high + SAME))


def _way_down(el: Elements) -> Index:
    """Numbers (n,) that are the same along every way that goes on without rising and without a move along the normal."""
    new = el.to_height > el.from_height + SAME
    new[1:] |= np.abs(el.from_height[1:] - el.to_height[:-1]) > SAME
    return np.cumsum(new, dtype=np.int64)


# Places where the tool does not fit, and how large a tool would.

EXACT = 1e-9  # mm
HINT = "take a smaller tool"


class Places(NamedTuple):
    """m places of one kind that do not fit: the elements concerned, the ones they cut into, the width that is there,
    what is missing (mm), and the largest radius for the place alone (all (m,)), with the words for them."""

    kind: str
    k: Index
    other: Index
    width: Array
    missing: Array
    largest: Array
    message: str
    hint: str = HINT


def narrowed(fits: Callable[[Index, Array], Mask], radius: Array, parts: int = 16) -> Array:
    """The largest radii (m,) below the given ones for which something fits, by dividing the interval again and again.
    `fits(which, radius)` tells for the things `which` (n,) of the m whether they fit (n,); all fit at zero."""
    m = len(radius)
    low, high, which = np.zeros(m), radius.copy(), np.repeat(np.arange(m), parts - 1)
    steps = np.arange(1, parts) / parts
    for _ in range(14):
        width = high - low
        tried = low[:, None] + width[:, None] * steps
        good = fits(which, tried.ravel()).reshape(m, parts - 1)
        first = np.where(good.all(axis=1), parts - 1, np.argmin(good, axis=1))  # the first that does not fit
        low, high = low + width * first / parts, np.where(first < parts - 1, low + width * (first + 1) / parts, high)
        if (high - low <= 1e-13 * radius).all():
            break
    return low


def misfit(el: Elements) -> Array:
    """By how much the end of each arc misses its circle (n,), mm: the tolerance of programmed centres."""
    slack = np.zeros(len(el.rows))
    k = np.flatnonzero(el.arc)
    slack[k] = np.abs(np.hypot(*(el.end[k] - el.centre[k]).T) - el.r[k])
    return slack

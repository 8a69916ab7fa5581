"""When something becomes true in a run: the moments of a condition, found along the moves and not only at their ends.

A run is a row of places: the moves of each step, and for a step that moves nothing the place where the tool stands. On a
move a condition can change only where one of its comparisons changes sign; such a place is found by halving, to the last
digit, and between two of them one look is enough. Comparisons that are linear in the coordinates (`z < -5`, `x + 2 y >
Q5`, and any `and`, `or`, `not` of such) are exact on lines and arcs, since the arcs are divided where they turn back;
others (`x^2 + y^2 > 900`, `abs(x) > 3`) are looked at in `LOOKS` places of each line and quarter of a turn, and
the result says so (`.exact`). So are spindle and feed at constant cutting speed, which follow the radius.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.path.feeds import spindle_speed
from mnclab.path.listing import point
from mnclab.path.places import points_at, spokes, turning_points, turns_of_sum
from mnclab.path.toolpath import Kind
from mnclab.runs.conditions import Condition, Node, parse
from mnclab.runs.history import unit_of
from mnclab.text.columns import parts
from mnclab.text.tables import Listing

if TYPE_CHECKING:
    from mnclab.runs.history import Moment
    from mnclab.runs.run import Run

LOOKS = 16
HALVINGS = 60
Array = NDArray[np.float64]
Rows = NDArray[np.int64]

#: Names that a condition may use beside the variables of the program.
PLACE = {
    "x": "tool tip along X, mm, as in the toolpath (a lathe's radius)",
    "y": "tool tip along Y, mm",
    "z": "tool tip along Z, mm",
    "d": "twice X: the diameter on a lathe, mm",
    "a": "rotary axis A, degrees",
    "b": "rotary axis B, degrees",
    "c": "rotary axis C, degrees",
}
COLUMN = {
    "feed": "feed of the move, mm/min; infinite for rapids, not known at events",
    "spindle": "spindle speed, rev/min, negative for counter-clockwise",
    "tool": "number of the tool in the spindle",
    "radius": "effective tool radius, mm",
    "side": "+1 compensated to the left, -1 to the right, 0 not",
    "line": "line of the program; one within a block of several lines means the block",
}
FOLLOW_RADIUS = {"spindle", "feed"}


class Looks(NamedTuple):
    """Places at which a condition is looked at (m,): row of the path or -1, share of the row, step."""

    row: Rows
    share: Array
    step: Rows

    def take(self, index: NDArray[Any] | slice) -> Looks:
        return Looks(self.row[index], self.share[index], self.step[index])


class Moments(Listing, Sequence["Moment"]):
    """The moments at which a condition becomes true, in order, each made when it is asked for; `exact`: whether nothing can lie
    between two looks. `reach` is "up to line 12, where the run stopped" of a run that stopped before its end, else empty."""

    HEAD, NUMBERS, CODE, MOST = ("line", "block", "tool tip", "of the move"), (0, 3), (1,), 50

    def __init__(self, run: Run, looks: Looks, points: Array, condition: str, exact: bool) -> None:
        self.condition, self.exact, self.reach = condition, exact, run.reach
        self._run, self._looks, self._points = run, looks, points

    def __len__(self) -> int:
        return len(self._looks.row)

    def __getitem__(self, which: Any) -> Any:
        if isinstance(which, slice):
            return Moments(self._run, self._looks.take(which), self._points[which], self.condition, self.exact)
        k = range(len(self))[which]
        row, share, step = (column[k].item() for column in self._looks)
        x, y, z = self._points[k].tolist()
        return self._run.at(step=step)._replace(row=row, share=share, point=(x, y, z))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and tuple(self) == tuple(other)

    def rows(self) -> list[tuple[str, ...]]:
        """Line, block, place of the tool tip, and how much of the move was done."""
        return [
            (str(m.line), str(m.block), point(m.point, unit_of(m.state), m.lathe), f"{100 * m.share:.4g} %" if m.row >= 0 else "")
            for m in self
        ]

    texts = rows

    @property
    def counts(self) -> str:
        """What is said where a program counts inches: a condition does not."""
        inches = any(unit_of(moment.state).short == "in" for moment in self)
        return "the condition counts mm, the places count inches" if inches else ""

    def __str__(self) -> str:
        if not self:
            return f"{self.condition}: never {self.reach}".rstrip()
        told = [f"line {line}: {place}  {share:8s}  {block}" for line, block, place, share in self.rows()]
        return "\n".join([*told, *filter(None, [self.counts])])

    __repr__ = __str__

    def _repr_html_(self) -> str:
        if not self:
            return f"<p><code>{escape(self.condition)}</code>: never {escape(self.reach)}".rstrip() + "</p>"
        first = self[: self.MOST]
        told = f"<br>{first.counts}" if first.counts else ""
        told += "" if self.exact else f"<br>looked at in {LOOKS} places of each line and quarter of a turn"
        more = f"… {len(self) - len(first)} more" if len(self) > len(first) else ""
        first.notes, first.reach = (more, self.reach), ""
        return f"<p><code>{escape(self.condition)}</code>{told}</p>{super(Moments, first)._repr_html_()}"


def when(run: Run, text: str) -> Moments:
    """Every moment at which a condition becomes true, also at the very start; see `PLACE` and `COLUMN`."""
    numeric = [name for name in run.history if name not in COLUMN and _is_number(run, name)]
    condition = parse(text, [*PLACE, *COLUMN, *numeric])
    if "line" in condition.names:
        condition = replace(condition, tree=_of_block(condition.tree, *run.program.lines()))
    search = _Search(run, condition)
    looks, place = search.looks()
    true, known = np.zeros((2, len(looks.row)), dtype=bool)
    for some in parts(len(looks.row)):
        truth = condition.truth(search.values(looks.take(some)))
        true[some], known[some] = truth.true, truth.true | truth.false
    seen = np.flatnonzero(known)
    begins = seen[true[seen] & ~np.concatenate([[False], true[seen[:-1]]])]
    found = looks.take(place[begins])
    return Moments(run, found, search.points(found), text, not any(map(_mixed, condition.comparisons)))


def _of_block(node: Node, first: NDArray[np.integer[Any]], last: NDArray[np.integer[Any]]) -> Node:
    """A condition in which a line within a block of several lines, compared with the line, is the first of the block."""
    sides = node.parts
    if node.what == "comparison" and any(side.name == "line" and side.what == "name" for side in sides):
        blocks = [np.flatnonzero((first <= side.number) & (side.number <= last)) for side in sides]
        parts = (
            replace(side, number=float(first[found[0]])) if side.what == "number" and len(found) else side
            for side, found in zip(sides, blocks, strict=True)
        )
        return replace(node, parts=tuple(parts))
    return replace(node, parts=tuple(_of_block(part, first, last) for part in sides))


def _is_number(run: Run, name: str) -> bool:
    values = run.history.log(name)[1]
    if isinstance(values, np.ndarray) and (values.ndim > 1 or values.dtype.kind in "biuf"):
        return values.ndim == 1 and len(values) > 0
    known = [value for value in values if value is not None]
    return bool(known) and all(isinstance(value, int | float | np.number | np.bool_) for value in known)


class _Search:
    """Where to look, and the values of the names there."""

    def __init__(self, run: Run, condition: Condition) -> None:
        self.run, self.path, self.condition = run, run.toolpath, condition
        self.step = np.maximum.accumulate(self.path.step.astype(np.int64)) if len(self.path) else np.empty(0, np.int64)
        follows = bool(np.isfinite(self.path.surface).any())
        self.along = PLACE.keys() | (FOLLOW_RADIUS if follows else set())  # the names that change on a move
        self.state = {name: self._state(name) for name in condition.names - PLACE.keys() - COLUMN.keys()}

    @cached_property
    def lines(self) -> NDArray[np.integer[Any]]:
        return self.run.lines()

    def _state(self, name: str) -> Array:
        values = self.run.history[name]
        return np.array([np.nan if value is None else value for value in values], dtype=np.float64)

    def looks(self) -> tuple[Looks, NDArray[np.int64]]:
        """Where to look, in order; and for each place the one at which what is seen there begins."""
        row, share = self.divided()
        between = np.flatnonzero((row[1:] == row[:-1]) & (share[1:] > share[:-1]))
        count = len(self.run.steps.block)
        still = np.flatnonzero(np.bincount(self.step, minlength=count)[:count] == 0)
        every, none, count = np.arange(len(row)), np.full(len(still), -1), len(row) + len(between)
        rows = np.concatenate([row, row[between], none])
        shares = np.concatenate([share, (share[between] + share[between + 1]) / 2, np.ones(len(still))])
        steps = np.concatenate([self.step[rows[:count]], still])
        begin = np.concatenate([every, between, np.arange(count, len(rows))])
        order = np.concatenate([every, between + 0.5, none])  # a middle comes after the place it begins at
        by_time = np.lexsort((order, steps))
        where = np.empty(len(rows), dtype=np.int64)
        where[by_time] = np.arange(len(rows))
        return Looks(rows, shares, steps).take(by_time), where[begin[by_time]]

    def divided(self) -> tuple[Rows, Array]:
        """Rows and shares (k,), in order, between which no comparison changes."""
        count = len(self.path)
        spatial = [node for node in self.condition.comparisons if _names(node) & self.along]
        if not spatial or not count:
            return np.arange(count), np.zeros(count)
        mixed, arc = any(map(_mixed, spatial)), self.path.kind == Kind.ARC
        straight, still, bent = map(np.flatnonzero, (self.path.is_motion & ~arc, ~self.path.is_motion, arc))
        cuts = np.linspace(0, 1, LOOKS + 1 if mixed else 2)
        rows = [np.repeat(straight, len(cuts)), still]
        shares = [np.tile(cuts, len(straight)), np.ones(len(still))]
        if len(bent):
            quarters = np.abs(self.path.sweep[bent]).max() / (np.pi / 2)
            cuts = np.linspace(0, 1, int(np.ceil(quarters * (LOOKS if mixed else 1))) + 1)
            turns = [self.turns(node, bent) for node in spatial if not _single(node) and not _mixed(node)]
            inside = np.concatenate([turning_points(self.path, bent), *turns, np.tile(cuts, (len(bent), 1))], axis=1)
            rows.append(np.repeat(bent, inside.shape[1]))
            shares.append(inside.ravel())
        row, share = _sorted(np.concatenate(rows), np.concatenate(shares))
        found = zip((row, share), *(self.roots(node, row, share) for node in spatial), strict=True)
        return _sorted(*map(np.concatenate, found))

    def turns(self, node: Node, row: Rows) -> Array:
        """Shares (n, k) of arcs at which the sides of a linear comparison, one less the other, turn back."""
        values = self.values(Looks(row, np.zeros(len(row)), self.step[row]))
        first = self.gap(node, row, np.zeros(len(row)))
        slope = np.zeros((len(row), 3))
        with np.errstate(all="ignore"):
            for k, axis in enumerate("xyz"):
                if axis not in values:
                    continue
                beside = values | {axis: values[axis] + 1} | ({"d": values["d"] + 2} if axis == "x" else {})
                slope[:, k] = node.gap(beside) - first
        u, v = spokes(self.path, row)
        sweep = self.path.sweep[row]
        cosine, sine = np.einsum("ij,ij->i", slope, u), np.einsum("ij,ij->i", slope, v)
        whole = self.gap(node, row, np.ones(len(row))) - first
        return turns_of_sum(cosine, sine, whole - cosine * (np.cos(sweep) - 1) - sine * np.sin(sweep), sweep)

    def roots(self, node: Node, row: Rows, share: Array) -> tuple[Rows, Array]:
        """Where the two sides of a comparison become equal between neighbouring shares of a row, by halving."""
        gap = self.gap(node, row, share)
        signs = np.sign(gap)
        crosses = signs[1:] * signs[:-1] < 0
        if _names(node) & (self.along - PLACE.keys()):  # it may arrive at a limit and stay there
            crosses |= signs[1:] != signs[:-1]
        change = np.flatnonzero((row[1:] == row[:-1]) & crosses)
        which, low, high, sign = row[change], share[change], share[change + 1], signs[change]
        for _ in range(HALVINGS if len(change) else 0):
            middle = (low + high) / 2
            same = np.sign(self.gap(node, which, middle)) == sign
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        return which, high

    def gap(self, node: Node, row: Rows, share: Array) -> Array:
        found = np.empty(len(row))
        for some in parts(len(row)):
            with np.errstate(all="ignore"):
                found[some] = node.gap(self.values(Looks(row[some], share[some], self.step[row[some]])))
        return found

    def values(self, looks: Looks) -> dict[str, Array]:
        """The value of every name of the condition at some places."""
        found = {name: state[looks.step] for name, state in self.state.items()}
        names = self.condition.names
        if names & PLACE.keys():
            xyz = self.points(looks)
            found |= {"x": xyz[:, 0], "y": xyz[:, 1], "z": xyz[:, 2], "d": 2 * xyz[:, 0]}
            if names & set("abc"):
                found |= dict(zip("abc", np.degrees(self.angles(looks)).T, strict=True))
        row = self.standing(looks)
        for name in names & COLUMN.keys():
            if name == "line":
                found[name] = self.lines[looks.step].astype(np.float64)
                continue
            column = getattr(self.path, name)
            before = column[row] if len(column) else np.zeros(len(row))
            if name in self.along:
                before = np.where(np.isfinite(self.path.surface[row]), self.turning(looks, row)[name], before)
            found[name] = np.where(row >= 0, before, np.nan if name == "feed" else 0.0).astype(np.float64)
            if name == "feed":
                found[name][looks.row < 0] = np.nan
        return found

    def turning(self, looks: Looks, row: Rows) -> dict[str, Array]:
        """Spindle speed and feed at some places of moves at constant cutting speed."""
        path = self.path
        radius = self.points(looks)[:, 0] - path.spindle_x[row]
        speed = spindle_speed(path.surface[row], radius, path.speed_limit[row])
        feed = np.where(np.isfinite(path.per_rev[row]), path.per_rev[row] * speed, path.feed[row])
        return {"spindle": np.where(path.spindle[row] < 0, -speed, speed), "feed": feed}

    def standing(self, looks: Looks) -> Rows:
        """The row of each place, or the last one before it; -1 before the first."""
        last = np.searchsorted(self.step, looks.step, "right") - 1
        return np.where(looks.row >= 0, looks.row, last)

    def points(self, looks: Looks) -> Array:
        if not len(self.path):
            return np.zeros((len(looks.row), 3)) + self.run.setup.start
        row = self.standing(looks)
        share = np.where(looks.row >= 0, looks.share, np.where(row >= 0, 1.0, 0.0))
        return points_at(self.path, np.maximum(row, 0), share)

    def angles(self, looks: Looks) -> Array:
        if not len(self.path):
            return np.zeros((len(looks.row), 3))
        row = self.standing(looks)
        there = np.where(row[:, None] >= 0, self.path.rotary[np.maximum(row, 0)], 0.0)
        before = np.where(row[:, None] > 0, self.path.rotary[np.maximum(row - 1, 0)], 0.0)
        share = np.where(looks.row >= 0, looks.share, 1.0)[:, None]
        return before + share * (there - before)


def _sorted(row: Rows, share: Array) -> tuple[Rows, Array]:
    """Rows and shares in order, each once."""
    order = np.lexsort((share, row))
    row, share = row[order], share[order]
    fresh = np.concatenate([[True], (row[1:] != row[:-1]) | (share[1:] != share[:-1])]) if len(row) else row == row
    return row[fresh], share[fresh]


def _names(node: Node) -> set[str]:
    return {part.name for part in node.walk() if part.what == "name"}


def _mixed(node: Node) -> bool:
    """Whether a comparison is not linear in the coordinates."""
    return node.degree(PLACE.keys()) > 1


def _single(node: Node) -> bool:
    """Whether a comparison sets one coordinate against a plain number or a value of the state."""
    sides = [part for part in node.parts if _names(part) & PLACE.keys()]
    return len(sides) == 1 and sides[0].what == "name"

"""Corners replaced by geometry: roundings and chamfers, before the radius is compensated.

A joint stands on the row before the corner and needs the row after it. With the offsets of both elements by the
rounding radius to the inside of the corner, the centre of the rounding is where they meet; its ends are the feet of that
centre on the two elements. A chamfer takes its length off both lines.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from mnclab.geometry.curves import Curves, cross, dot, length_of, rounded
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import Array, Index, Kind, Mask, PathFault, Toolpath


class Rounding(NamedTuple):
    """A corner replaced by a tangent arc; `step` is that of the block that asks for it, nan keeps the feed."""

    radius: float
    step: int
    feed: float = float("nan")

    @property
    def label(self) -> str:
        return "rounding"

    def __str__(self) -> str:
        return f"a rounding of R{self.radius:g}"


class Chamfer(NamedTuple):
    """A corner between two lines cut off `length` mm before and after it; `step` and `feed` as in a rounding."""

    length: float
    step: int
    feed: float = float("nan")

    @property
    def label(self) -> str:
        return "chamfer"

    def __str__(self) -> str:
        return f"a chamfer of {self.length:g} mm"


class Prolonged(NamedTuple):
    """An outside corner without an arc: the compensation leads over the point where both offsets meet."""

    step: int

    @property
    def label(self) -> str:
        return ""


class Open(NamedTuple):
    """The end of an element where the compensation ends too: the tool stands square to it, and no corner is cut off."""

    step: int

    @property
    def label(self) -> str:
        return ""


Corner = Rounding | Chamfer
NOTHING = 1e-9  # mm
TOUCHES = 1e-6  # mm, by which a rounding may miss its elements


def apply(path: Toolpath, unfinished: bool = False) -> Toolpath:
    """The path with its corners replaced; itself when it has none. Raises PathFault. `unfinished`: the program broke
    off, so the end of a last row that waits for its joint is unknown and the row is left out."""
    which = [isinstance(joint, Corner) for joint in path.joints]
    rows = np.flatnonzero((path.joint >= 0) & np.array([*which, False])[path.joint])
    if not len(rows):
        return path
    work = _Work(path, rows)
    waiting = unfinished and not path.is_motion[rows[-1] + 1 :].any()
    for row in rows[:-1] if waiting else rows:
        work.replace(int(row), path.joints[path.joint[row]])
    return work.result(rows[-1] if waiting else len(path))


class _Work:
    """Ends and sweeps of rows as they are trimmed, and the rows to insert."""

    def __init__(self, path: Toolpath, rows: Index) -> None:
        self.path, self.rows, self.view = path, rows, PlaneView(path)
        self.begin, self.end, self.sweep = self.view.start.copy(), self.view.end.copy(), path.sweep.copy()
        self.inserted: list[tuple[int, dict[str, Any]]] = []  # before which row, and what differs from it, in (u, v, w)
        self.trimmed: set[int] = set()

    def next_of(self, row: int, step: int, what: str) -> int:
        after = np.flatnonzero(self.view.moves[row + 1 :])
        if not len(after):
            raise PathFault(f"{what} needs a path element after it", step)
        return row + 1 + int(after[0])

    def curve(self, row: int) -> Curves:
        """A row in its plane, as it was programmed."""
        view, k = self.view, slice(row, row + 1)
        return Curves(view.start[k, :2], view.end[k, :2], view.centre[k], view.radius[k], view.sweep[k])

    def replace(self, row: int, joint: Corner) -> None:
        """Cut off the corner after a row and fill the gap."""
        if not self.view.moves[row]:
            raise PathFault(f"{joint} needs a path element before it", joint.step)
        follow = self.next_of(row, joint.step, str(joint))
        for k in range(row, follow + 1):
            if abs(self.view.end[k, 2] - self.view.start[k, 2]) > 1e-9:
                raise PathFault(f"{joint} needs both its elements in the working plane", joint.step)
        if isinstance(joint, Chamfer) and self.view.arc[[row, follow]].any():
            raise PathFault(f"{joint} needs a straight line before and after it", joint.step, "round a corner with RND")
        turn = cross(self.view.tangent_end[row], self.view.tangent_start[follow])
        if abs(turn) < 1e-9:
            if dot(self.view.tangent_end[row], self.view.tangent_start[follow]) > 0:
                return  # the elements are tangent already
            raise PathFault(f"{joint} has no place where the path runs straight back", joint.step)
        feed = self.feed(row, follow, joint)
        if isinstance(joint, Chamfer):
            begin = self.view.end[row, :2] - joint.length * self.view.tangent_end[row]
            end = self.view.end[row, :2] + joint.length * self.view.tangent_start[follow]
            fits, changes = self.trim(row, follow, begin, end), dict[str, Any](kind=Kind.LINE, sweep=0.0)
        else:
            fits, end, changes = self.round(row, follow, joint.radius * float(np.sign(turn)))
        if not fits:
            raise PathFault(f"{joint} does not fit between its elements, which are too short for it", joint.step)
        changes |= {"end": (*end, self.view.end[row, 2]), "feed": feed, "joint": -1, "label": joint.label}
        self.inserted.append((follow, changes))
        self.trimmed |= {row, follow}

    def feed(self, row: int, follow: int, joint: Corner) -> float:
        """The corner's own feed, else that of the element after it, or before it where that is a rapid."""
        for feed in (joint.feed, float(self.path.feed[follow]), float(self.path.feed[row])):
            if np.isfinite(feed):
                return feed
        raise PathFault(f"{joint} stands between two rapid moves and needs a feed", joint.step, "write F in its block")

    def round(self, row: int, follow: int, offset: float) -> tuple[bool, Array, dict[str, Any]]:
        """Trim two elements for the arc between them: whether it fits, its end (2,), and its columns."""
        before, after = self.curve(row), self.curve(follow)
        found = rounded(before, after, np.array([offset]), self.view.end[row : row + 1, :2])
        centre, begin, end, sweep = (column[0] for column in found)
        shrunk = (each.r - np.sign(each.sweep) * offset for each in (before, after))  # nan for lines
        off = max(abs(length_of(foot - centre) - abs(offset)) for foot in (begin, end))
        if not off <= TOUCHES or any((radius <= 0).any() for radius in shrunk):
            return False, centre, {}
        arc = {"kind": Kind.ARC, "centre": (*centre, self.view.end[row, 2]), "sweep": sweep}
        return self.trim(row, follow, begin, end), end, arc

    def trim(self, row: int, follow: int, begin: Array, end: Array) -> bool:
        """End one element earlier and begin the next later; False if nothing would be left of one of them."""
        self.end[row, :2], self.begin[follow, :2] = begin, end
        return self.remains(row) and self.remains(follow)

    def remains(self, row: int) -> bool:
        """Whether something is left of a trimmed row, whose sweep is set to that."""
        left_over = self.left_over(row)
        if not self.view.arc[row]:
            return left_over > -1e-9
        self.sweep[row] = left_over
        return abs(left_over) < abs(self.path.sweep[row]) + 1e-9

    def left_over(self, row: int) -> float:
        """What remains of a row: length of a line, sweep of an arc."""
        begin, end = self.begin[row, :2], self.end[row, :2]
        if not self.view.arc[row]:
            return float(dot(end - begin, self.view.tangent_end[row]))
        a, b = begin - self.view.centre[row], end - self.view.centre[row]
        angle, sense = np.arctan2(cross(a, b), dot(a, b)), np.sign(self.view.sweep[row])
        return float(angle + sense * 2 * np.pi if angle * sense < 0 else angle)

    def used_up(self) -> Mask:
        """Rows (n,) of which the corners at both their ends have left nothing: a stop there would be no one's wish."""
        nothing = np.abs(self.end - self.begin).max(axis=1, initial=0.0) < NOTHING
        return np.isin(np.arange(len(self.path)), list(self.trimmed)) & nothing & (np.abs(self.sweep) < np.pi)

    def result(self, count: int) -> Toolpath:
        """The first `count` rows of the path, with their corners."""
        order = sorted(self.inserted, key=lambda item: item[0])
        path, view, everything = self.path, self.view, np.arange(len(self.path))
        where = np.array([row for row, _ in order], dtype=np.int64)
        known = list(dict.fromkeys([*path.labels, *(changes["label"] for _, changes in order)]))
        columns = path.all_but_ends() | {"sweep": self.sweep, "joint": path.joint.copy()}
        columns["joint"][self.rows] = -1
        made: dict[str, Any] = {name: column[where].copy() for name, column in columns.items()}
        new_ends = np.empty((len(order), 3))
        for k, (row, changes) in enumerate(order):
            places = np.array([changes.pop("end"), changes.pop("centre", (np.nan,) * 3)])
            new_ends[k], made["centre"][k] = view.to_space(np.array([row, row]), places)
            for name, value in changes.items():
                made[name][k] = known.index(value) if name == "label" else value
        columns = {name: np.insert(column, where, made[name], axis=0) for name, column in columns.items()}
        keep = np.insert(~self.used_up() & (everything < count), where, True)
        ends = np.insert(view.to_space(everything, self.end), where, new_ends, axis=0)
        vertices = np.concatenate([path.start[:1], ends[keep]])
        return path.through(vertices, {name: column[keep] for name, column in columns.items()}, *known)

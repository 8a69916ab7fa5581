"""Corners replaced by geometry: roundings and chamfers, before the radius is compensated.

A joint stands on the row before the corner and needs the row after it. With the offsets of both elements by the
rounding radius to the inside of the corner, the centre of the rounding is where they meet; its ends are the feet of that
centre on the two elements. A chamfer takes its length off both lines.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.offsets import Element, meet
from mnclab.geometry.vectors import cross, dot, left
from mnclab.path.columns import COLUMNS
from mnclab.path.fault import PathFault
from mnclab.path.kinds import Kind
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import Toolpath


class Rounding(NamedTuple):
    """A corner replaced by a tangent arc; `step` is that of the block that asks for it, nan keeps the feed."""

    radius: float
    step: int
    feed: float = float("nan")

    @property
    def label(self) -> str:
        """What its row is called."""
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
        """What its row is called."""
        return "chamfer"

    def __str__(self) -> str:
        return f"a chamfer of {self.length:g} mm"


Corner = Rounding | Chamfer
NOTHING = 1e-9  # mm
CHAMFER: dict[str, Any] = {"kind": Kind.LINE, "sweep": 0.0}


def apply(path: Toolpath, unfinished: bool = False) -> Toolpath:
    """The path with its corners replaced; itself when it has none. Raises PathFault.

    `unfinished`: the program broke off, so the end of a last row that waits for its joint is unknown and the row is
    left out.
    """
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

    def __init__(self, path: Toolpath, rows: NDArray[np.int64]) -> None:
        self.path, self.rows, self.view = path, rows, PlaneView(path)
        self.begin, self.end, self.sweep = self.view.start.copy(), self.view.end.copy(), path.sweep.copy()
        self.inserted: list[tuple[int, int, dict[str, Any]]] = []  # before row, like row, changed columns in (u, v, w)
        self.trimmed: set[int] = set()

    def next_of(self, row: int, step: int, what: str) -> int:
        """The next row that moves in the plane."""
        after = np.flatnonzero(self.view.moves[row + 1 :])
        if not len(after):
            raise PathFault(f"{what} needs a path element after it", step)
        return row + 1 + int(after[0])

    def element(self, row: int, at_end: bool, offset: float) -> Element:
        """A row shifted to its left by `offset`, seen from its end or its start."""
        view = self.view
        q = (self.end if at_end else self.begin)[row : row + 1, :2]
        t = (view.tangent_end if at_end else view.tangent_start)[row : row + 1]
        r = view.radius[row : row + 1] - np.sign(view.sweep[row]) * offset
        return Element(q + offset * left(t), t, view.centre[row : row + 1], r)

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
            begin, end = (self.view.end[row, :2] + joint.length * t for t in self.along(row, follow))
            fits, changes = self.trim(row, follow, begin, end), CHAMFER.copy()
        else:
            fits, end, changes = self.round(row, follow, joint.radius * float(np.sign(turn)))
        if not fits:
            raise PathFault(f"{joint} does not fit between its elements, which are too short for it", joint.step)
        changes |= {"end": (*end, self.view.end[row, 2]), "feed": feed, "joint": -1, "label": joint.label}
        self.inserted.append((follow, follow, changes))
        self.trimmed |= {row, follow}

    def feed(self, row: int, follow: int, joint: Corner) -> float:
        """The corner's own feed, else that of the element after it, or before it where that is a rapid."""
        for feed in (joint.feed, float(self.path.feed[follow]), float(self.path.feed[row])):
            if np.isfinite(feed):
                return feed
        raise PathFault(f"{joint} stands between two rapid moves and needs a feed", joint.step, "write F in its block")

    def along(self, row: int, follow: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """From the corner back along the element before it, and on along the one after it: unit vectors (2,)."""
        return -self.view.tangent_end[row], self.view.tangent_start[follow]

    def round(self, row: int, follow: int, offset: float) -> tuple[bool, NDArray[np.float64], dict[str, Any]]:
        """Trim two elements for the arc between them: whether it fits, its end (2,), and its columns."""
        first, second = self.element(row, True, offset), self.element(follow, False, offset)
        centre = meet(first, second, self.view.end[row : row + 1, :2])[0]
        if not np.isfinite(centre).all() or (first.r <= 0).any() or (second.r <= 0).any():
            return False, centre, {}
        begin, end = self.foot(row, centre), self.foot(follow, centre)
        sweep = np.arctan2(cross(begin - centre, end - centre), dot(begin - centre, end - centre))
        arc = {"kind": Kind.ARC, "centre": (*centre, self.view.end[row, 2]), "sweep": sweep}
        return self.trim(row, follow, begin, end), end, arc

    def trim(self, row: int, follow: int, begin: NDArray[np.float64], end: NDArray[np.float64]) -> bool:
        """End one element earlier and begin the next later; False if nothing would be left of one of them."""
        return self.trim_end(row, begin) and self.trim_start(follow, end)

    def foot(self, row: int, centre: NDArray[np.float64]) -> NDArray[np.float64]:
        """The point of an element nearest to a centre."""
        if self.view.arc[row]:
            spoke = centre - self.view.centre[row]
            return self.view.centre[row] + self.view.radius[row] * spoke / np.hypot(*spoke)
        t = self.view.tangent_end[row]
        return self.begin[row, :2] + dot(centre - self.begin[row, :2], t) * t

    def trim_end(self, row: int, to: NDArray[np.float64]) -> bool:
        """Shorten a row at its end; False if nothing would be left."""
        left_over = self.left_over(row, self.begin[row, :2], to)
        self.end[row, :2] = to
        if self.view.arc[row]:
            self.sweep[row] = left_over
        return left_over > -1e-9 if not self.view.arc[row] else abs(left_over) < abs(self.path.sweep[row]) + 1e-9

    def trim_start(self, row: int, to: NDArray[np.float64]) -> bool:
        """Shorten a row at its start; False if nothing would be left."""
        left_over = self.left_over(row, to, self.end[row, :2])
        self.begin[row, :2] = to
        if self.view.arc[row]:
            self.sweep[row] = left_over
        return left_over > -1e-9 if not self.view.arc[row] else abs(left_over) < abs(self.path.sweep[row]) + 1e-9

    def left_over(self, row: int, begin: NDArray[np.float64], end: NDArray[np.float64]) -> float:
        """What remains of a row: length of a line, sweep of an arc."""
        if not self.view.arc[row]:
            return float(dot(end - begin, self.view.tangent_end[row]))
        a, b = begin - self.view.centre[row], end - self.view.centre[row]
        angle, sense = np.arctan2(cross(a, b), dot(a, b)), np.sign(self.view.sweep[row])
        return float(angle + sense * 2 * np.pi if angle * sense < 0 else angle)

    def used_up(self) -> NDArray[np.bool_]:
        """Rows (n,) of which the corners at both their ends have left nothing: a stop there would be no one's wish."""
        used = np.zeros(len(self.path), dtype=bool)
        rows = np.array(sorted(self.trimmed), dtype=np.int64)
        rest = np.abs(self.end[rows] - self.begin[rows]).max(axis=1, initial=0.0) < NOTHING
        used[rows[rest & (np.abs(self.sweep[rows]) < np.pi)]] = True
        return used

    def result(self, count: int) -> Toolpath:
        """The first `count` rows of the path, with their corners."""
        order = sorted(self.inserted, key=lambda item: item[0])
        path, view = self.path, self.view
        like = np.array([item[1] for item in order], dtype=np.int64)
        where = np.array([item[0] for item in order], dtype=np.int64)
        labels = list(dict.fromkeys([*path.labels, *(item[2]["label"] for item in order)]))
        everything = np.arange(len(path))
        ends = view.to_space(everything, self.end)
        columns = {name: np.asarray(getattr(path, name)) for name in COLUMNS if name not in ("start", "end")}
        columns["sweep"], columns["joint"] = self.sweep, path.joint.copy()
        columns["joint"][self.rows] = -1
        made: dict[str, Any] = {name: column[like].copy() for name, column in columns.items()}
        for k, (_, _, changes) in enumerate(order):
            for name, value in changes.items():
                if name == "label":
                    made["label"][k] = labels.index(value)
                elif name == "centre":
                    made["centre"][k] = view.to_space(like[k : k + 1], np.array([value]))[0]
                elif name != "end":
                    made[name][k] = value
            if changes["kind"] == Kind.LINE:
                made["centre"][k] = np.nan
        new_ends = view.to_space(like, np.array([item[2]["end"] for item in order]).reshape(-1, 3))
        columns = {name: np.insert(column, where, made[name], axis=0) for name, column in columns.items()}
        keep = np.insert(~self.used_up() & (everything < count), where, True)
        vertices = np.concatenate([path.start[:1], np.insert(ends, where, new_ends, axis=0)[keep]])
        columns = {name: column[keep] for name, column in columns.items()}
        return Toolpath.chain(
            vertices, columns, labels=labels, joints=path.joints, origin=path.origin, lathe=path.lathe
        )

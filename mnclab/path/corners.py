"""Joints replaced by geometry: roundings and tangential approaches, before the radius is compensated.

A joint stands on the row before the corner and needs the row after it. With the offsets of both elements by the
rounding radius to the inside of the corner, the centre of the rounding is where they meet; its ends are the feet of that
centre on the two elements.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.offsets import Element, cross, dot, left, meet
from mnclab.path.fault import PathFault
from mnclab.path.kinds import Kind
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import COLUMNS, Toolpath


class Rounding(NamedTuple):
    """A corner replaced by a tangent arc; ``step`` is that of the block that asks for it, nan keeps the feed."""

    radius: float
    step: int
    feed: float = float("nan")


class Approach(NamedTuple):
    """A line of ``length`` mm tangent to the first element, added before the contour begins."""

    length: float
    step: int


def apply(path: Toolpath, unfinished: bool = False) -> Toolpath:
    """The path with its joints replaced; itself when it has none. Raises PathFault.

    ``unfinished``: the program broke off, so the end of a last row that waits for its joint is unknown and the row is
    left out.
    """
    rows = np.flatnonzero(path.joint >= 0)
    if not len(rows):
        return path
    work = _Work(path)
    waiting = unfinished and not path.is_motion[rows[-1] + 1 :].any()
    for row in rows[:-1] if waiting else rows:
        joint = path.joints[path.joint[row]]
        if isinstance(joint, Rounding):
            work.round(int(row), joint)
        elif isinstance(joint, Approach):
            work.approach(int(row), joint)
    return work.result()[: rows[-1] + len(work.inserted)] if waiting else work.result()


class _Work:
    """Ends and sweeps of rows as they are trimmed, and the rows to insert."""

    def __init__(self, path: Toolpath) -> None:
        self.path, self.view = path, PlaneView(path)
        self.begin, self.end, self.sweep = self.view.start.copy(), self.view.end.copy(), path.sweep.copy()
        self.inserted: list[tuple[int, int, dict[str, Any]]] = []  # before row, like row, changed columns in (u, v, w)

    def next_of(self, row: int, step: int, what: str) -> int:
        """The next row that moves in the plane."""
        after = np.flatnonzero(self.view.moves[row + 1 :])
        if not len(after):
            raise PathFault(f"{what} needs a path element after it", step)
        return row + 1 + int(after[0])

    def element(self, row: int, at_end: bool, offset: float) -> Element:
        """A row shifted to its left by ``offset``, seen from its end or its start."""
        view = self.view
        q = (self.end if at_end else self.begin)[row : row + 1, :2]
        t = (view.tangent_end if at_end else view.tangent_start)[row : row + 1]
        r = view.radius[row : row + 1] - np.sign(view.sweep[row]) * offset
        return Element(q + offset * left(t), t, view.centre[row : row + 1], r)

    def round(self, row: int, joint: Rounding) -> None:
        what = f"a rounding of R{joint.radius:g}"
        if not self.view.moves[row]:
            raise PathFault(f"{what} needs a path element before it", joint.step)
        follow = self.next_of(row, joint.step, what)
        for k in range(row, follow + 1):
            if abs(self.view.end[k, 2] - self.view.start[k, 2]) > 1e-9:
                raise PathFault(f"{what} needs both its elements in the working plane", joint.step)
        turn = cross(self.view.tangent_end[row], self.view.tangent_start[follow])
        if abs(turn) < 1e-9:
            if dot(self.view.tangent_end[row], self.view.tangent_start[follow]) > 0:
                return  # the elements are tangent already
            raise PathFault(f"{what} has no place where the path runs straight back", joint.step)
        offset = float(np.sign(turn)) * joint.radius
        first, second = self.element(row, True, offset), self.element(follow, False, offset)
        centre = meet(first, second, self.view.end[row : row + 1, :2])[0]
        fits = bool(np.isfinite(centre).all()) and not (first.r <= 0).any() and not (second.r <= 0).any()
        if fits:
            begin, end = self.foot(row, centre), self.foot(follow, centre)
            fits = self.trim_end(row, begin) and self.trim_start(follow, end)
        if not fits:
            raise PathFault(f"{what} does not fit between its elements, which are too short for it", joint.step)
        w = self.view.end[row, 2]
        sweep = np.arctan2(cross(begin - centre, end - centre), dot(begin - centre, end - centre))
        feed = joint.feed if np.isfinite(joint.feed) else self.path.feed[follow]
        arc = {"kind": Kind.ARC, "end": (*end, w), "centre": (*centre, w), "sweep": sweep, "feed": feed, "joint": -1}
        self.inserted.append((follow, follow, {**arc, "label": "rounding"}))

    def approach(self, row: int, joint: Approach) -> None:
        follow = self.next_of(row, joint.step, "a tangential approach")
        before = self.end[row].copy()
        self.end[row, :2] -= joint.length * self.view.tangent_start[follow]
        straight = {"kind": Kind.LINE, "end": tuple(before), "sweep": 0.0, "joint": -1, "label": "approach"}
        self.inserted.append((row + 1, row, straight))

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

    def result(self) -> Toolpath:
        order = sorted(self.inserted, key=lambda item: item[0])
        path, view = self.path, self.view
        like = np.array([item[1] for item in order], dtype=np.int64)
        where = np.array([item[0] for item in order], dtype=np.int64)
        labels = list(dict.fromkeys([*path.labels, *(item[2]["label"] for item in order)]))
        everything = np.arange(len(path))
        ends = view.to_space(everything, self.end)
        columns = {name: np.asarray(getattr(path, name)) for name in COLUMNS if name not in ("start", "end")}
        columns["sweep"], columns["joint"] = self.sweep, np.full(len(path), -1)
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
        vertices = np.concatenate([path.start[:1], np.insert(ends, where, new_ends, axis=0)])
        return Toolpath.chain(
            vertices, columns, labels=labels, joints=path.joints, origin=path.origin, lathe=path.lathe
        )

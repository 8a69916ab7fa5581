"""Approaches and departures: the straight lead of a compensated contour replaced by lines and arcs of the tool centre.

The compensation makes the lead a line between the tool's start S and the place Q square to the first contour point, with
the unit tangent t and the normal n towards the tool there. An approach goes by an auxiliary point H:

        S                S                 S ____            S
         \\                 \\                   H \\             \\
          H ----> Q          H            centre   |             H
             LT              | LN          CT     Q             \\_> Q   LCT
                             Q                                 (tangent to S H and to t)

A departure is an approach run backwards. Lengths and radii belong to the path of the tool centre.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from mnclab.geometry.curves import cross, dot, left, turned
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import Array, Kind, PathFault, Toolpath, gathered

NEAR = 1e-9  # mm
CHANGED = ("kind", "centre", "sweep", "feed", "label", "joint")  # columns that a lead gives its rows
MISFIT = 0.1  # mm: more than arcs may miss their ends by


class Lead(NamedTuple):
    """How a contour is approached or left.

    `form` is "LT" (a tangent line of `length` mm), "LN" (a line square to the contour), "CT" (an arc of `radius` mm
    and `angle` rad) or "LCT" (a line and a tangent arc). A negative radius turns away from the tool's side `side`
    (+1 left, -1 right, 0 none). `departs`: from the contour. `feed` is that of the line to H, or from
    the arc of a departure LCT; infinite at rapid.
    """

    form: str
    step: int
    side: int
    length: float = 0.0
    radius: float = 0.0
    angle: float = 0.0
    departs: bool = False
    feed: float = math.nan

    @property
    def label(self) -> str:
        return "departure" if self.departs else "approach"

    @property
    def name(self) -> str:
        return f"{'DEP' if self.departs else 'APPR'} {self.form}"


class LeadWay(NamedTuple):
    """The auxiliary point H (2,), and the arc from there to Q: its centre (2,) or None for a line, and its sweep."""

    by: Array
    centre: Array | None = None
    sweep: float = 0.0

    def centre_at(self, height: float) -> Array | None:
        return None if self.centre is None else np.append(self.centre, height)


def way(lead: Lead, start: Array, to: Array, t: Array) -> LeadWay:
    """The way from `start` to the place `to` where the contour begins with the tangent `t` (all (2,)). A departure is
    asked for backwards: the side, the tangent and the sweep turn over. Raises PathFault."""
    normal = lead.side * left(t)
    match lead.form:
        case "LT":
            return LeadWay(to - lead.length * t)
        case "LN":
            return LeadWay(to + lead.length * normal)
        case "CT":
            centre = to + lead.radius * normal
            sense = lead.side * math.copysign(1, lead.radius)
            return LeadWay(centre + turned(to - centre, -sense * lead.angle), centre, sense * lead.angle)
    return _line_and_arc(lead, start, to, t)


def _line_and_arc(lead: Lead, start: Array, to: Array, t: Array) -> LeadWay:
    """LCT: the arc bends towards the side of the tangent on which the start lies, and the line touches it."""
    beside, along = float(cross(t, start - to)), float(dot(start - to, t))
    if abs(beside) < NEAR:
        if along < 0:
            return LeadWay(to)  # straight ahead: no arc is needed
        beside = float(lead.side or 1)
    sense = math.copysign(1, beside)
    centre = to + lead.radius * sense * left(t)
    away = centre - start
    distance = float(np.hypot(*away))
    if distance < lead.radius - NEAR:
        outside = "ends" if lead.departs else "begins"
        message = f"{lead.name} {outside} inside of its arc of R{lead.radius:g}: no line touches the arc from there"
        raise PathFault(message, lead.step, "take a smaller radius, or a point farther away")
    # the line has the centre at the distance R beside it
    heading = turned(away / distance, -sense * math.asin(min(1.0, lead.radius / distance)))
    by = start + math.sqrt(max(0.0, (distance - lead.radius) * (distance + lead.radius))) * heading
    angle = sense * math.atan2(cross(heading, t), dot(heading, t)) % math.tau
    return LeadWay(by, centre, sense * angle) if NEAR < angle < math.tau - NEAR else LeadWay(to)


def apply(path: Toolpath, contour: Toolpath, unfinished: bool = False) -> Toolpath:
    """The tool-centre `path` with its leads; itself when it has none. Raises PathFault.

    `contour` is the same before the compensation: its elements give the tangents. `unfinished`: the program broke
    off, so an approach may still wait for its contour and is left out.
    """
    rows = [row for row in np.flatnonzero(path.joint >= 0).tolist() if isinstance(_joint(path, row), Lead)]
    if not rows:
        return path
    view, before = PlaneView(path), PlaneView(contour)
    at = {int(contour.joint[row]): int(row) for row in np.flatnonzero(contour.joint >= 0)}
    elements = np.flatnonzero(before.moves)
    made: dict[int, list[_Part]] = {}
    for row in rows:
        lead, here = _joint(path, row), at[int(path.joint[row])]
        next_to = int(np.searchsorted(elements, here, "left" if lead.departs else "right")) - lead.departs
        lonely = not 0 <= next_to < len(elements)
        if lonely and unfinished:
            return _expanded(path[:row], made, view)
        if not before.moves[here]:
            where = "end" if lead.departs else "start"
            raise PathFault(f"{lead.name} needs its {where} at another place than the contour point", lead.step)
        if lonely or isinstance(_joint(contour, int(elements[next_to])), Lead):
            raise _alone(lead)
        if lead.departs:
            t, leaves = before.tangent_end[elements[next_to]], before.start[here, :2]
            touching = path.radius[max(row - 1, 0)] * lead.side * left(t)
            if np.abs(view.start[row, :2] - leaves - touching).max() > MISFIT:
                raise _alone(lead)
            made[row] = _departure(view, row, lead, t)
        else:
            t, contact = before.tangent_start[elements[next_to]], before.end[here].copy()
            contact[:2] += lead.side * float(path.radius[row]) * left(t)
            made[row] = _approach(view, row, lead, t, contact)
    return _expanded(path, made, view)


def _joint(path: Toolpath, row: int) -> Any:
    return path.joints[path.joint[row]] if path.joint[row] >= 0 else None


def _alone(lead: Lead) -> PathFault:
    side = "before" if lead.departs else "after"
    return PathFault(f"{lead.name} needs a path element of the contour {side} it", lead.step)


class _Part(NamedTuple):
    """A row of a lead in the coordinates of its plane: end (3,), and centre (3,) and sweep of an arc."""

    end: Array
    centre: Array | None = None
    sweep: float = 0.0
    feed: float = math.nan  # nan: that of the block


def _approach(view: PlaneView, row: int, lead: Lead, t: Array, contact: Array) -> list[_Part]:
    """To H, with the depth, and on to the contact Q with the contour."""
    start = view.start[row]
    found = way(lead, start[:2], contact[:2], t)
    by = np.append(found.by, contact[2])
    return _moving(start, _Part(by, feed=lead.feed), _Part(contact, found.centre_at(contact[2]), found.sweep))


def _departure(view: PlaneView, row: int, lead: Lead, t: Array) -> list[_Part]:
    """From the contact with the contour to the end; the height is reached along the last row."""
    start, end = view.start[row], view.end[row]
    found = way(lead._replace(side=-lead.side), end[:2], start[:2], -t)
    if lead.form != "LCT":
        return [_Part(end, found.centre_at(start[2]), -found.sweep)]
    arc = _Part(np.append(found.by, start[2]), found.centre_at(start[2]), -found.sweep)
    return _moving(start, arc, _Part(end, feed=lead.feed))


def _moving(start: Array, first: _Part, last: _Part) -> list[_Part]:
    """Those of two rows that move; the last one if none does."""
    both = ((start, first), (first.end, last))
    return [part for begin, part in both if part.sweep or float(np.abs(part.end - begin).max()) > NEAR] or [last]


def _expanded(path: Toolpath, made: dict[int, list[_Part]], view: PlaneView) -> Toolpath:
    """The path with other rows in place of its leads."""
    count = np.ones(len(path), dtype=np.int64)
    for row, parts in made.items():
        count[row] = len(parts)
    source = np.repeat(np.arange(len(path)), count)
    columns = {name: gathered(column, source) for name, column in path.all_but_ends().items()}
    columns |= {name: np.array(columns[name]) for name in CHANGED}
    ends, first = path.end[source], np.cumsum(count) - count
    labels = list(dict.fromkeys([*path.labels, *(_joint(path, row).label for row in made)]))
    for row, parts in made.items():
        for k, part in enumerate(parts, int(first[row])):
            feed = path.feed[row] if math.isnan(part.feed) else part.feed
            straight = Kind.LINE if math.isfinite(feed) else Kind.RAPID
            centre = np.full(3, np.nan) if part.centre is None else part.centre
            ends[k], columns["centre"][k] = view.to_space(np.array([row, row]), np.stack([part.end, centre]))
            columns["kind"][k] = straight if part.centre is None else Kind.ARC
            columns["sweep"][k], columns["feed"][k] = part.sweep, feed
            columns["label"][k], columns["joint"][k] = labels.index(_joint(path, row).label), -1
    return path.through(np.concatenate([path.start[:1], ends]), columns, *labels)

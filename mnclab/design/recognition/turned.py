"""From the path of a lathe to a design: the profile that it leaves, exact, with its bores and threads."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from mnclab.design.model.turned_design import TurnedDesign
from mnclab.design.model.turned_features import Bore
from mnclab.design.model.turned_threads import Thread
from mnclab.design.recognition.naming import DIGITS, designation, lines, merged, names, number
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Mask
from mnclab.text.alarm import Alarm
from mnclab.workpiece.blank import Revolved
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.turning.turned import Turned

SAME = 1e-6  # mm, within which two places are one
TURNED_DOWN = 0.2  # of the pitch, by which a cylinder is less than the thread that it is turned for


@dataclass(frozen=True, repr=False)
class TurnedProposal(TurnedDesign):
    """A turned design found in a path. `notes` say what of it has no name, and is not in the design."""

    notes: tuple[str, ...] = field(default=(), kw_only=True)


def proposed(cutting: Cutting) -> TurnedProposal:
    """The design that the moves of a lathe make of their bar: its half section as it is, bores and threads as features."""
    locked = _locked(cutting)
    none = len(cutting.tools)  # threads are features: here nothing cuts them
    bare = replace(cutting, tools=(*cutting.tools, Tool(kind="probe")), which=np.where(locked, none, cutting.which))
    part = Turned(bare)
    if not part.section:
        raise Alarm("nothing is left of the bar: there is no design of it")
    if abs(part.axis) > SAME:
        raise Alarm(f"a turned design stands about X 0, the bar about X {part.axis:g}")
    section = Region(tuple(part.section))
    loop = merged(max(part.section, key=lambda each: each.area))
    loop = Contour(loop.points.round(DIGITS) + 0.0, loop.bulge)
    notes = [*part.notes]
    if len(section.loops) > 1:
        notes.append(f"{len(section.loops) - 1} more contours of the section are not in the design")
    profile, bores = _with_bores(loop)
    found = list[Thread]()
    for row in np.flatnonzero(locked).tolist():
        thread = _thread(cutting, row, loop)
        if isinstance(thread, str):
            notes.append(thread)
        elif not any(replace(thread, name=each.name) == each for each in found):
            try:
                TurnedDesign(profile, (*bores, thread))
                found.append(thread)
            except Alarm as fault:  # it does not fit what stands there
                notes.append(f"{fault.message} ({lines(cutting, [row])})")
    stock = cutting.stock
    straight = isinstance(stock, Revolved) and len({radius for radius, _ in stock.profile}) == 1
    return TurnedProposal(profile, (*bores, *found), blank=stock if straight else None, notes=tuple(dict.fromkeys(notes)))


def _locked(cutting: Cutting) -> Mask:
    """Rows that cut a thread along the axis: locked to the spindle."""
    path = cutting.path
    along = np.abs(path.end[:, 2] - path.start[:, 2]) > SAME
    return np.asarray(cutting.cuts & np.asarray(path.synchronous, dtype=bool) & along)


def _thread(cutting: Cutting, row: int, loop: Contour) -> Thread | str:
    """The thread of a stroke on the cylinder that it goes along most of; in words if it has none."""
    path = cutting.path
    (x0, _, z0), (x1, _, z1) = path.start[row].tolist(), path.end[row].tolist()
    pitch = float(np.nan_to_num(path.per_rev[row])) or abs(float(path.feed[row] / path.spindle[row] if path.spindle[row] else 0))
    where = lines(cutting, [row])
    if abs(x1 - x0) > SAME:
        return f"a thread on a taper has no name ({where})"
    best, least = None, 0.0
    for (za, ra), (zb, rb), bulge in zip(loop.starts.tolist(), loop.ends.tolist(), loop.bulge.tolist()):
        high, low = min(max(za, zb), max(z0, z1)), max(min(za, zb), min(z0, z1))
        inside = zb > za  # a contour goes back along the outside, and forwards along a bore
        if abs(ra - rb) > SAME or bulge or ra < SAME or high - low <= least or (abs(x0) > ra) != inside:
            continue
        best, least = (ra, high, low, inside), high - low
    if best is None:
        return f"a thread has no cylinder ({where})"
    radius, high, low, inside = best
    wide = 2 * abs(x0) if inside else 2 * radius
    if not inside and math.ceil(wide - SAME) - wide <= TURNED_DOWN * pitch:
        wide = float(math.ceil(wide - SAME))
    name = designation(wide, pitch)
    if not name:
        return f"a thread {wide:g} has no pitch that is known ({where})"
    return Thread(name, number(high), number(low), inside, name=next(names(cutting, [row])))


def _with_bores(loop: Contour) -> tuple[Contour, tuple[Bore, ...]]:
    """A half section as its outside and bores from the front, if these are all that is within; else as it is."""
    found = _bored(loop)
    if found is None:
        return loop, ()
    outside, bores = found
    again, whole = Region(tuple(TurnedDesign(outside, bores).section)), Region.of(loop)
    off = whole.difference(again).area + again.difference(whole).area
    return (outside, bores) if off < SAME * loop.length else (loop, ())


def _bored(loop: Contour) -> tuple[Contour, tuple[Bore, ...]] | None:
    """The outside of a half section and the steps of its bore, if it has one, the deepest first; None where these are not
    cylinders alone."""
    points = loop.points
    (low, least), (high, _) = loop.bounds.tolist()
    after = np.roll(points, -1, axis=0)
    if least > SAME:
        begins = (np.abs(points[:, 0] - low) < SAME) & (after[:, 0] > low + SAME)
    else:
        begins = (points[:, 1] < SAME) & (after[:, 1] > SAME)
    if begins.sum() != 1:
        return None
    first = int(np.flatnonzero(begins)[0])
    points, bulge = np.roll(points, -first, axis=0), np.roll(loop.bulge, -first)
    last = int(np.argmax(points[:, 0] > high - SAME))
    if bulge[:last].any():
        return None
    bores = list[Bore]()
    before: tuple[float, float] | None = None if least > SAME else (float(points[0, 0]), 0.0)
    for (za, ra), (_, rb) in pairwise(points[: last + 1].tolist()):
        if abs(ra - rb) > SAME:  # the bottom of a step
            before = (za, ra)
        elif before is None:
            bores.append(Bore(number(2 * ra)))
        else:
            point = 2 * math.degrees(math.atan2(ra - before[1], za - before[0]))
            bores.append(Bore(number(2 * ra), number(high - za), number(point)))
    outside, bent = points[last:], bulge[last:]
    if abs(outside[1, 0] - high) < SAME and not bent[0]:  # the front face
        outside, bent = outside[1:], bent[1:]
    while len(outside) > 2 and outside[-1, 1] < SAME:  # on the axis
        outside, bent = outside[:-1], bent[:-1]
    steps = all(one.diameter < other.diameter for one, other in pairwise(bores))
    if not steps or any(each.depth is not None and not 0 < each.depth < high - low for each in bores):
        return None
    return Contour(outside, np.append(bent[:-1], 0.0), closed=False), tuple(bores)

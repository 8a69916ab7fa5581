"""The view of a turned part: from the side, its upper half cut where there is something inside, with all its dimensions.

The axis lies level, the front end to the right. Lengths count from the front end.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from mnclab.design.drawing.ledger import (
    BLANK,
    DEPTH,
    DIAMETER,
    TIMES,
    Claim,
    Draft,
    Ledger,
    claims_of,
    times,
    valued,
    written,
)
from mnclab.design.drawing.projection import SAME, Seen, Step, look
from mnclab.design.drawing.view import Angle, Axis, Kind, Linear, Note, Origin, Point, Radius, Value, ViewLine
from mnclab.design.model.measures import Measure
from mnclab.design.model.turned_design import TurnedDesign
from mnclab.design.model.turned_feature import TurnedFeature
from mnclab.design.model.turned_features import CENTRES, Bore, CentreHole, FaceGroove, RingGroove
from mnclab.design.model.turned_profile import Dimension
from mnclab.design.model.turned_threads import Thread, Undercut
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.workpiece.turning import revolved

FAR = 1e6  # mm
FROM_OUTSIDE = np.diag([1.0, -1.0, 1.0])  # depth grows from outside to the axis


def drafts(design: TurnedDesign, ledger: Ledger) -> list[Draft]:
    """The view with all that is written to it; what is solid but for centre holes is not cut."""
    region = Region(tuple(design.section))
    outside, inside = look(_turned(region)), look(region)
    first = design.bodies[0].section
    cut = _hollow(look(first)) or any(isinstance(each, Bore | FaceGroove) for each in design.features)
    draft = Draft("from the side", (0, 0))
    lower = list(_outside(outside))
    draft.draw([line.transformed(FROM_OUTSIDE) for line in lower])
    if cut:
        draft.hatches = (region,)
        draft.draw([line for loop in region.loops for line in _off_axis(loop)])
        draft.draw(list(_edges(outside, 0.0)))
        draft.draw(list(_bore_edges(inside)))
    else:
        draft.draw(lower)
        draft.draw(list(_edges(outside, 1.0)))
    for each in design.threads:
        _thread(draft, region, each)
    low, high = design.outline_as_drawn.ends
    draft.axes.append(Axis((low, 0.0), (high, 0.0)))
    if low - SAME <= 0 <= high + SAME:
        draft.axes.append(Origin((0.0, 0.0)))
    Turning(design, draft, ledger).write()
    return [draft]


def _turned(region: Region) -> Region:
    return Region(tuple(loop.transformed(FROM_OUTSIDE) for loop in region.loops))


def _hollow(inside: Seen) -> bool:
    """Whether something is inside: what one sees from the axis is not the axis alone."""
    return bool(((inside.labels >= 0) & (np.abs(inside.ends()) > SAME).any(axis=1)).any())


def _outside(seen: Seen) -> Iterator[Contour]:
    """The silhouette above the axis, (z, r)."""
    before = 0.0
    ends = -seen.ends()
    for k, (piece, label) in enumerate(zip(seen.pieces, seen.labels.tolist(), strict=True)):
        (u0, u1), (r0, r1) = seen.places[k : k + 2].tolist(), ends[k].tolist()
        if label < 0:
            r0 = r1 = 0.0
        if abs(r0 - before) > SAME:
            yield Contour([(u0, before), (u0, r0)], closed=False)
        if label >= 0 and max(r0, r1) > SAME:
            yield _piece((u0, r0), (u1, r1), -piece[5], -piece[6], piece[4])
        before = r1
    if before > SAME:
        yield Contour([(float(seen.places[-1]), before), (float(seen.places[-1]), 0.0)], closed=False)


def _piece(start: Point, end: Point, r: float, side: float, z: float) -> Contour:
    """A line, or an arc about (z, r) of a radius, above its centre where `side` is positive."""
    if side == 0:
        return Contour([start, end], closed=False)
    a, b = (math.atan2(y - r, x - z) for x, y in (start, end))
    sweep = (b - a) % math.tau
    sweep = sweep - math.tau if side > 0 else sweep  # from left to right: above clockwise
    return Contour([start, end], [math.tan(sweep / 4), 0.0], closed=False)


def _edges(seen: Seen, upper: float) -> Iterator[Contour]:
    """Where the outside steps or bends: upright lines down to its silhouette below, from that above or from the axis."""
    for u, r in _at_edges(seen, -seen.ends(), max):
        if r > SAME and seen.places[0] + SAME < u < seen.places[-1] - SAME:
            yield Contour([(u, upper * r), (u, -r)], closed=False)


def _bore_edges(seen: Seen) -> Iterator[Contour]:
    """Where the inside steps, bends or ends: upright lines from the axis to the narrower side."""
    for u, r in _at_edges(seen, seen.ends(), min):
        if SAME < r < FAR:
            yield Contour([(u, 0.0), (u, r)], closed=False)


def _at_edges(seen: Seen, radii: Floats, chosen: Callable[[list[float]], float]) -> Iterator[Point]:
    """Places of upright lines, with the greater or the smaller radius beside them."""
    for u in seen.edges():
        k = int(np.abs(seen.places - u).argmin())
        beside = [*([float(radii[k - 1, 1])] if k else []), *([float(radii[k, 0])] if k < len(radii) else [])]
        yield u, chosen(beside)


def _off_axis(loop: Contour) -> Iterator[Contour]:
    """The elements of a section that are not its axis."""
    for start, end, bulge in zip(loop.starts, loop.ends, loop.bulge, strict=True):
        if max(abs(start[1]), abs(end[1])) > SAME or bulge:
            yield Contour([start, end], [bulge, 0.0], closed=False)


def _thread(draft: Draft, region: Region, thread: Thread) -> None:
    """The thin lines of a thread, and the line where it ends."""
    r = (thread.major if thread.inside else thread.minor) / 2
    seen = look(region, (Step(-FAR, FAR, r),))
    for a, b in seen.cuts():
        low, high = max(a, thread.end), min(b, thread.start)
        if high - low > SAME:
            for side in (1,) if thread.inside else (1, -1):
                draft.draw([Contour([(low, side * r), (high, side * r)], closed=False)], Kind.THIN)
            if abs(low - thread.end) < SAME and a < thread.end - SAME:
                edge = thread.minor / 2 if thread.inside else thread.major / 2
                line = [(low, edge), (low, r)] if thread.inside else [(low, edge), (low, -edge)]
                draft.draw([Contour(line, closed=False)])


# Its dimensions: diameters across, lengths from the front end, notes of its features.


@dataclass
class Turning:
    """Writes the dimensions of a turned part to its view; the profile stands in the record as the blank does."""

    design: TurnedDesign
    draft: Draft
    ledger: Ledger
    lengths: list[tuple[float, float, Measure, Claim]] = field(default_factory=list)
    notes: dict[tuple[Any, tuple[str, ...]], tuple[Point, list[int]]] = field(default_factory=dict)  # equal grooves have one

    def write(self) -> None:
        """All of it."""
        self.region = Region(tuple(self.design.section))
        self.low, self.high = self.design.outline_as_drawn.ends
        threaded = list(self._threads())
        for place, each in enumerate(self.design.dimensions()):
            self._of_profile(each, Claim(False, BLANK, place, each.measure.name), threaded)
        for k, feature in enumerate(self.design.features):
            self._of_feature(feature, k)
        for (_, lines), (at, numbers) in self.notes.items():
            said = (times(len(numbers)) + lines[0], *lines[1:])
            self.ledger.say(self.draft, Note(at, said), claims_of(self.design.features, numbers, ()))
        self._lengths()

    # ---- the profile ----

    def _of_profile(self, each: Dimension, claim: Claim, threaded: Sequence[tuple[Thread, list[Claim]]]) -> None:
        measure, (z0, r0), (z1, r1) = each.measure, each.start, each.end
        z, r = (z0 + z1) / 2, (r0 + r1) / 2
        if claim.measure == "length":
            told = Linear((self.low, -self._outer(self.low)), (self.high, -self._outer(self.high)), valued(measure), "x", "below")
            self.ledger.say(self.draft, told, [claim])
        elif measure.kind == "length":
            self.lengths.append((z1, r1, measure, claim))
        elif measure.kind == "diameter":
            mine = [claims for thread, claims in threaded if self._is_thread(thread, each)]
            if mine and measure.limits is None:
                mine[0].append(claim)
            elif self._inside(z, r):
                self.ledger.say(self.draft, Note((z, r), (self._bracketed(measure, written(measure)),)), [claim])
            else:
                self._across(z, r, valued(measure, DIAMETER)._replace(reference=measure.name in self.spare), [claim])
        elif measure.kind == "radius":
            assert each.centre is not None
            (cz, cr), radius = each.centre, measure.nominal
            start, end = (math.atan2(y - cr, x - cz) for x, y in (each.start, each.end))
            sweep = (end - start + math.pi) % math.tau - math.pi
            self.ledger.say(self.draft, Radius((cz, cr), radius, start, sweep, valued(measure, "R")), [claim])
        elif measure.kind == "angle":
            self._taper(each, claim)
        else:
            self.ledger.say(self.draft, Note((z, r), (written(measure, ""),)), [claim])

    def _across(self, z: float, r: float, said: Value, claims: list[Claim]) -> None:
        """A diameter across the part, at the end to which its extension lines have a free way."""
        free = [side for side, a, b in (("right", z, self.high), ("left", self.low, z)) if self._greatest(a, b) <= r + SAME]
        self.ledger.say(self.draft, Linear((z, -r), (z, r), said, "y", free[0] if free else ""), claims)

    def _taper(self, each: Dimension, claim: Claim) -> None:
        """The angle of a taper against a line along the axis through its narrow end."""
        narrow, wide = sorted((each.start, each.end), key=lambda point: point[1])
        if self._inside((narrow[0] + wide[0]) / 2, (narrow[1] + wide[1]) / 2):
            middle = (narrow[0] + wide[0]) / 2, (narrow[1] + wide[1]) / 2
            note = Note(middle, (self._bracketed(each.measure, f"∠{written(each.measure, '')}"),))
            self.ledger.say(self.draft, note, [claim])
            return
        level = wide[0], narrow[1]
        self.draft.lines.append(ViewLine(Contour([narrow, level], closed=False), Kind.THIN))
        legs = (level, wide) if wide[0] > narrow[0] else (wide, level)
        said = valued(each.measure)._replace(reference=each.measure.name in self.spare)
        self.ledger.say(self.draft, Angle(narrow, *legs, said), [claim])

    def _bracketed(self, measure: Measure, text: str) -> str:
        return f"({text})" if measure.name in self.spare else text

    @cached_property
    def spare(self) -> set[str]:
        """Measures of the profile that follow from others and stand in brackets (ISO 129-1).

        A taper has a length and two diameters, or one and its angle: what is the rounder number.
        """
        every, found = self.design.dimensions(), set[str]()
        corners = [each for each in every if each.measure.kind == "diameter" and each.start == each.end]
        for taper in (each for each in every if each.measure.kind == "angle"):
            free = [taper, *(each for each in corners if each.start in (taper.start, taper.end))]
            measures = [each.measure for each in free if each.measure.limits is None and each.measure.name not in found]
            if measures:
                found.add(max(reversed(measures), key=lambda one: len(valued(one).text.strip("°"))).name)
        return found

    def _is_thread(self, thread: Thread, each: Dimension) -> bool:
        same = abs(2 * each.start[1] - thread.major) < SAME and not thread.inside
        low, high = sorted((each.start[0], each.end[0]))
        return same and low < thread.start - SAME and thread.end < high - SAME

    # ---- features ----

    def _threads(self) -> Iterator[tuple[Thread, list[Claim]]]:
        """Threads outside are dimensioned across their cylinder, which then needs no diameter."""
        for k, each in enumerate(self.design.features):
            if isinstance(each, Thread):
                measure = each.measures()[0]
                z, claims = (max(each.end, self.low) + min(each.start, self.high)) / 2, self._claims(k, "thread")
                if each.inside:
                    note = Note((z, each.minor / 2), (written(measure, ""),))
                    self.ledger.say(self.draft, note, claims)
                else:
                    self._across(z, each.major / 2, Value(written(measure, "")), claims)
                    claims = self.ledger.said[-1][1]
                yield each, claims

    def _of_feature(self, feature: TurnedFeature, k: int) -> None:
        known = {each.name: each for each in feature.measures()}
        front = getattr(feature, "from_end", "front") == "front"
        if isinstance(feature, Thread):
            r = (feature.minor if feature.inside else feature.major) / 2
            told = Linear((feature.end, r), (feature.start, r), valued(known["length"]), "x", "above")
            self.ledger.say_once(self.draft, told, self._claims(k, "length"))
            self._from_front(k, feature.start, r)
            return
        if isinstance(feature, Bore):
            at, lines = self._bore(feature, front), list(_bore_lines(known))
        elif isinstance(feature, CentreHole):
            at = (self.high if front else self.low), feature.sizes[0] / 2
            lines = [f"ISO 6411–A{feature.pilot:g}/{feature.sizes[0]:g}"]
            if CENTRES.get(float(feature.pilot)) != feature.sizes or any(each.limits for each in known.values()):
                lines.append(f"{written(known['pilot diameter'])} {written(known['depth'])}")
        elif isinstance(feature, RingGroove | Undercut):
            at, lines = self._groove(feature), list(_groove_lines(known))
            self._from_front(k, feature.z, at[1])
        else:
            assert isinstance(feature, FaceGroove)
            at = self._face_groove(feature, front)
            across = f"{written(known['inner diameter'])} / {written(known['outer diameter'])}"
            lines = [f"{across} {written(known['depth'])}"]
            lines += [written(known["corner radius"])] if "corner radius" in known else []
        alike = (type(feature), self._inside(*at)) if isinstance(feature, RingGroove) else k
        self.notes.setdefault((alike, tuple(lines)), (at, []))[1].append(k)

    def _bore(self, bore: Bore, front: bool) -> Point:
        """A point on its wall."""
        r, spots = bore.diameter / 2, np.linspace(0.02, 0.98, 97)
        deep = self.high - self.low if bore.depth is None else bore.depth
        z = self.high - spots * deep if front else self.low + spots * deep
        on = self.region.distance(np.stack([z, np.full(len(z), r)], axis=1)) < 1e-6
        return float(z[np.flatnonzero(on)[on.sum() // 2]] if on.any() else z[48]), r

    def _groove(self, groove: RingGroove | Undercut) -> Point:
        """The middle of its bottom."""
        if isinstance(groove, Undercut):
            diameter, width, _ = groove.sizes
            return groove.z + width / 2 * (1 if groove.thread_at == "front" else -1), diameter / 2
        z = groove.z - groove.width / 2
        if groove.diameter is not None:
            return z, groove.diameter / 2
        return z, self._inner(z) if groove.inside else self._outer(z)

    def _face_groove(self, groove: FaceGroove, front: bool) -> Point:
        r = (groove.inner + groove.outer) / 4
        back, face = revolved.ends_at(self.region.loops, np.array([r]))
        return float((face if front else back)[0]), r

    def _from_front(self, k: int, z: float, r: float) -> None:
        place, measure = next((p, m) for p, m in enumerate(self.design.features[k].measures()) if m.name == "z")
        self.lengths.append((z, r, measure, Claim(False, k, place, "z")))

    def _lengths(self) -> None:
        """One dimension for each distance from the front end."""
        same: dict[Any, list[tuple[float, float, Measure, Claim]]] = {}
        for each in self.lengths:
            same.setdefault((round(each[0], 6), each[2].limits, each[2].fit), []).append(each)
        front = self._outer(self.high)
        for found in same.values():
            z, _, measure, _ = found[0]
            claims = [each[3] for each in found]
            if abs(z - self.high) < SAME:
                self.ledger.at_zero(self.draft, (self.high, 0.0), claims)
                continue
            inner = [each[1] for each in found if self._inside(z, each[1])]
            said = valued(measure, "", self.high - z)
            if len(inner) == len(found):
                told = Linear((z, max(inner)), (self.high, front), said, "x", "above")
            else:
                told = Linear((z, -self._outer(z)), (self.high, -front), said, "x", "below")
            self.ledger.say_once(self.draft, told, claims)

    def _claims(self, k: int, *names: str) -> list[Claim]:
        return claims_of(self.design.features, [k], names)

    # ---- the section ----

    def _outer(self, z: float) -> float:
        """The greatest radius at z, or beside it where it steps."""
        return max((float(r) for off in (-1e-7, 1e-7) for r in self._radii(z + off)), default=0.0)

    def _inner(self, z: float) -> float:
        return min(self._radii(z), default=0.0)

    def _radii(self, z: float) -> list[float]:
        return revolved.radii_at(self.region.loops, np.array([z]))[0].tolist()

    def _greatest(self, a: float, b: float) -> float:
        """The greatest radius between two places."""
        points = np.concatenate([loop.points_within(0.01) for loop in self.region.loops])
        within = (points[:, 0] > a - SAME) & (points[:, 0] < b + SAME)
        return float(points[within, 1].max(initial=0.0))

    def _inside(self, z: float, r: float) -> bool:
        """Whether a place on the section is one of the inside: there is material outside of it."""
        return r < self._outer(z) - 1e-5


def _bore_lines(known: dict[str, Measure]) -> Iterator[str]:
    yield " ".join(written(known[name]) for name in ("diameter", "depth") if name in known)
    if "point angle" in known:
        yield f"point {written(known['point angle'])}"
    if "chamfer" in known:
        yield written(known["chamfer"], "")
    if "corner radius" in known:
        yield written(known["corner radius"])


def _groove_lines(known: dict[str, Measure]) -> Iterator[str]:
    """"3×⌀26", or the width and how deep it is."""
    deep = written(known["diameter"], DIAMETER) if "diameter" in known else written(known["depth"], "")
    yield f"{written(known['width'])}{TIMES}{deep}" if "diameter" in known else f"{written(known['width'])} {DEPTH}{deep}"
    if "corner radius" in known:
        yield written(known["corner radius"])
    if "angle" in known:
        yield written(known["angle"])

"""Data told one by one, and what they leave open: the *readings*, each a set of values for what is settled so far.

Data are equations of the second degree between numbered unknowns (`.quadratics`), conditions that something is positive,
and choices between several lists of equations. After each datum `Readings.follow` settles whatever a few neighbouring
unknowns settle among themselves; several solutions make several readings, a contradiction takes a reading away.

The search is bounded: every system that is tried costs some of the `Effort` of the contour, which grows with what is settled.
What a reading has tried in vain is not tried again while nothing new is known of it. Before systems of many unknowns are
looked into, one look at the whole tells which unknowns are free to move, and those are left alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from mnclab.controls.tnc_620.free_contours.quadratics import NEAR, SAME, Array, Effort, Exhausted, Form, System

Label = Any
Choice = tuple[int, int]  # an unknown that tells alternatives apart, and the number of one of them
Spans = dict[int, list[tuple[int, int, frozenset[int]]]]
MOST_READINGS = 256
WIDEST = 8  # unknowns in a row that are tried together before all of them are
SHORTEST = 1e-6  # mm: a line has a length, an arc a radius
MOST_WORK, WORK_OF_UNKNOWN = 1_200_000, 4_000  # for a contour, and more for each unknown when it is settled
LOOKED_AT = 64  # unknowns that hang together and are looked at as a whole: 12 elements of which nothing is known


class Reading(NamedTuple):
    """The unknowns (nan where not settled), and which of several solutions was taken at which unknown.

    Of the first `told` equations and conditions those are kept, by number, that wait for unknowns. `vain`: windows
    that settle nothing by their equations, as both stand now.
    """

    values: Array
    choices: tuple[tuple[float, int], ...]
    told: tuple[int, int] = (0, 0)
    equations: tuple[int, ...] = ()
    limits: tuple[int, ...] = ()
    vain: frozenset[tuple[Any, ...]] = frozenset()

    def settled(self, unknowns: Sequence[int], values: Any, choices: Sequence[tuple[float, int]] = ()) -> Reading:
        """The reading with values for some unknowns more, and the choices made for them."""
        own = self.values.copy()
        own[list(unknowns)] = values
        return self._replace(values=own, choices=(*self.choices, *choices))


class Contradiction(Exception):
    """Data that no contour fulfils; `label` is that of the datum, `gap` by how much it is missed (mm, or nan)."""

    def __init__(self, label: Label, gap: float) -> None:
        super().__init__(f"{label} contradicts what is known")
        self.label, self.gap = label, gap


class TooManyReadings(Exception):
    """More readings than can be followed."""


class Readings:
    """What has been told, and the readings that agree with all of it. `places` orders the unknowns: neighbours are near."""

    def __init__(self) -> None:
        self.dims: list[int] = []
        self.places: list[float] = []
        self.equations: list[tuple[Form, frozenset[int], Label, Choice | None]] = []
        self.limits: list[tuple[Form, frozenset[int], Label]] = []
        self.readings = [Reading(np.empty(0), ())]
        self.size = 1.0
        self.conflict: tuple[Label, float] | None = None
        self.work = Effort(MOST_WORK)
        self.paid: set[int] = set()  # unknowns that have brought some work

    def rank(self, values: Array, before: Array, window: Sequence[int]) -> list[float]:
        """What solutions for the unknowns of a window are sorted by; `before` is what was settled without them."""
        return [round(float(values[i]), 6) for i in window]

    def order_of(self, place: float) -> float:
        """Where a choice at a place comes in the order of the readings."""
        return place

    def unknown(self, place: float, dim: int = 1) -> Form:
        """A new unknown, a length or (`dim` 0) a component of a unit vector."""
        self.dims.append(dim)
        self.places.append(place)
        self.readings = [r._replace(values=np.append(r.values, np.nan)) for r in self.readings]
        return Form(0.0, {len(self.dims) - 1: 1.0})

    def equal(self, form: Form, label: Label, choice: Choice | None = None) -> None:
        """An equation form = 0; with a `choice` only in the readings that have taken it."""
        self.equations.append((form, frozenset(form.variables), label, choice))
        if form.power(self.dims) == 1:
            self.size = max(self.size, abs(form.const))

    def positive(self, form: Form, label: Label) -> None:
        """A condition form > 0."""
        self.limits.append((form, frozenset(form.variables), label))

    def either(self, alternatives: Sequence[Iterable[Form]], place: float, label: Label) -> None:
        """One of several lists of equations holds; the readings are followed for each."""
        (flag,) = self.unknown(place).linear
        count = len(alternatives)
        self.readings = [
            reading.settled([flag], k, [(place, k)] if count > 1 else [])
            for reading in self.readings
            for k in range(count)
        ]
        for k, forms in enumerate(alternatives):
            for form in forms:
                self.equal(form, label, (flag, k))

    def follow(self, thoroughly: bool = False) -> None:
        """Settle in every reading what can be settled; raises Contradiction when none is left.

        `thoroughly`: unknowns that hang together in large numbers are solved too, until a reading turns out that the
        data leave open, which comes first then; Exhausted where the search ends before.
        """
        self.conflict = None
        waiting, done = self.readings[::-1], list[Reading]()
        while waiting:
            reading = waiting.pop()
            try:
                self.work.spend(3 * (len(reading.equations) + len(self.equations) - reading.told[0]))
                if (looked_at := self._looked_at(reading)) is None:
                    continue
                reading = looked_at
                following = self._further(reading, thoroughly)
            except Exhausted:
                if thoroughly:
                    self.readings = [reading, *waiting, *done]
                    raise
                if waiting or done:
                    raise TooManyReadings from None
                following = None, reading.vain
            if isinstance(following, list):
                waiting += following[::-1]
            elif thoroughly and self.open_unknowns(reading):
                self.readings = [reading, *waiting, *done]
                return
            else:
                done.append(reading._replace(vain=following[1]))
            if len(waiting) + len(done) > MOST_READINGS:
                raise TooManyReadings
        if not done:
            raise Contradiction(*(self.conflict or (None, np.nan)))
        done.sort(key=lambda reading: sorted(reading.choices))
        self.readings = [done[k] for k in _different([reading.values for reading in done], SAME * self.size)]

    def open_unknowns(self, reading: Reading) -> list[int]:
        """The unknowns that a reading has not settled, along the chain."""
        return sorted(np.flatnonzero(np.isnan(reading.values)).tolist(), key=lambda i: (self.places[i], i))

    def _looked_at(self, reading: Reading) -> Reading | None:
        """The reading with the equations and conditions that still wait for unknowns; None if it misses one that does not."""
        values, (equations, limits), open_ = reading.values, reading.told, np.isnan(reading.values)
        waiting, waiting_limits = [], []
        for number in (*reading.equations, *range(equations, len(self.equations))):
            form, variables, _, choice = self.equations[number]
            if choice and values[choice[0]] != choice[1]:
                continue
            if any(open_[i] for i in variables):
                waiting.append(number)
            elif (gap := form.gap(values, self.dims)) > NEAR:
                self._blame(number, gap)
                return None
        for number in (*reading.limits, *range(limits, len(self.limits))):
            form, variables, label = self.limits[number]
            if any(open_[i] for i in variables):
                waiting_limits.append(number)
            elif form.at(values) < SHORTEST:
                self.conflict = self.conflict or (label, np.nan)
                return None
        told = len(self.equations), len(self.limits)
        return reading._replace(told=told, equations=tuple(waiting), limits=tuple(waiting_limits))

    def _further(self, reading: Reading, thoroughly: bool) -> list[Reading] | tuple[None, frozenset[tuple[Any, ...]]]:
        """The readings that one becomes by settling some unknowns more; None and what was tried when there is nothing more."""
        unknowns, vain = self.open_unknowns(reading), set(reading.vain)
        carriers = [i for i in unknowns if self.places[i] % 2 == 1]
        following = self._windows(reading, [unknowns, carriers], WIDEST, vain, newton=False)
        if following is not None:
            return following
        if thoroughly:
            for part in self._parts(reading):
                still = self._system(reading, part).settled(self.work) if len(part) <= LOOKED_AT else part
                rows = [[i for i in row if i in still] for row in (unknowns, carriers)]
                following = self._windows(reading, rows, min(len(part), LOOKED_AT), vain, newton=True)
                if following is not None:
                    return following
        return None, frozenset(vain)

    def _windows(
        self, reading: Reading, rows: list[list[int]], widest: int, vain: set[tuple[Any, ...]], newton: bool
    ) -> list[Reading] | None:
        """The readings that follow from the narrowest window that can be solved: unknowns next to each other in a row."""
        rows = rows if len(rows[1]) < len(rows[0]) else rows[:1]
        spans = [self._spans(reading, row) for row in rows]
        full = [_full(len(row), ends, min(widest, len(rows[0]))) for row, ends in zip(rows, spans, strict=True)]
        for width, which, first in sorted((w, k, begin) for k, found in enumerate(full) for w, begin in found):
            window = rows[which][first : first + width]
            mine = [item for at in range(first, first + width) for item in spans[which].get(at, ())]
            mine = [item for item in mine if item[0] < first + width]
            if {i for _, _, rest in mine for i in rest} != set(window):
                continue
            numbers = sorted(number for _, number, _ in mine)
            key = newton, *window, -1, *numbers
            if key in vain:
                continue
            forms = [self.equations[number][0] for number in numbers]
            found = System(forms, window, reading.values, self.dims, self.size).solve(self.work, newton)
            if found is None:
                vain.add(key)
                continue
            if not found:
                self._blame(numbers[-1], np.nan)
            return self._fork(reading._replace(vain=frozenset(vain)), window, found)
        return None

    def _spans(self, reading: Reading, row: Sequence[int]) -> Spans:
        """Waiting equations whose open unknowns all stand in a row, by the first of their places in it: last place,
        number, unknowns."""
        self.work.spend(4 * len(reading.equations))
        place, open_ = {variable: k for k, variable in enumerate(row)}, np.isnan(reading.values)
        found: Spans = {}
        for number in reading.equations:
            rest = frozenset(i for i in self.equations[number][1] if open_[i])
            if all(i in place for i in rest):
                places = [place[i] for i in rest]
                found.setdefault(min(places), []).append((max(places), number, rest))
        return found

    def _fork(self, reading: Reading, window: Sequence[int], found: Sequence[Array]) -> list[Reading]:
        """A reading for each solution of a window, in the order that the module states."""
        self.work.left += WORK_OF_UNKNOWN * len(set(window) - self.paid)
        self.paid.update(window)
        readings = [reading.settled(window, solution) for solution in found]
        if len(readings) == 1:
            return readings
        place = self.order_of(self.places[window[0]])
        readings.sort(key=lambda each: self.rank(each.values, reading.values, window))
        return [each._replace(choices=(*reading.choices, (place, k))) for k, each in enumerate(readings)]

    def _blame(self, number: int, gap: float) -> None:
        """Remember what took a reading away: the datum that is missed least."""
        if self.conflict is None or np.isnan(self.conflict[1]) or gap < self.conflict[1]:
            self.conflict = (self.equations[number][2], gap)

    def missing(self, reading: Reading) -> int | None:
        """How many data a reading lacks; 0 also where no solution is found, None where too much is open to count it."""
        looked_at = self._looked_at(reading)
        if looked_at is None:
            return 0
        parts = self._parts(looked_at)
        if max(map(len, parts), default=0) > LOOKED_AT:
            return None
        return sum(self._system(looked_at, part).freedom() for part in parts)

    def _parts(self, reading: Reading) -> list[set[int]]:
        """The open unknowns in sets that no equation connects, along the chain."""
        parts, open_ = list[set[int]](), np.isnan(reading.values)
        for number in reading.equations:
            rest = {i for i in self.equations[number][1] if open_[i]}
            touched = [part for part in parts if part & rest]
            parts = [part for part in parts if not part & rest] + [rest.union(*touched)]
        alone = set(self.open_unknowns(reading)).difference(*parts)
        return sorted([*parts, *({i} for i in alone)], key=lambda part: min((self.places[i], i) for i in part))

    def _system(self, reading: Reading, unknowns: set[int]) -> System:
        """What is told of some open unknowns."""
        forms = [form for form, told, *_ in map(self.equations.__getitem__, reading.equations) if told & unknowns]
        return System(forms, sorted(unknowns), reading.values, self.dims, self.size)


def _full(size: int, spans: Spans, widest: int) -> list[tuple[int, int]]:
    """Width and first place of the windows in a row of `size` that hold at least as many equations as unknowns."""
    upto = np.zeros((size + widest, widest + 1), dtype=np.int32)  # equations from a place on, by their width
    for first, items in spans.items():
        for last, _, _ in items:
            if last - first < widest:
                upto[first, last - first + 1] += 1
    upto = np.cumsum(upto, axis=1, dtype=np.int32)
    found = []
    for width in range(1, widest + 1):
        count = sum(upto[shift : shift + max(0, size - width + 1), width - shift] for shift in range(width))
        found += [(width, int(first)) for first in np.flatnonzero(count >= width)]
    return found


def _different(readings: Sequence[Array], tolerance: float) -> list[int]:
    """The first of all readings that have settled the same unknowns with the same values."""
    values, kept = np.array(readings), list[int]()
    nothing = np.isnan(values)
    values[nothing] = 0.0
    for k in range(len(values)):
        same = (nothing[kept] == nothing[k]) & (np.abs(values[kept] - values[k]) <= tolerance)
        if not same.all(axis=1).any():
            kept.append(k)
    return kept

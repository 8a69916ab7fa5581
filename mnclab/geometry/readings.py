"""Data told one by one, and what they leave open: the *readings*, each a set of values for what is settled so far.

Data are equations of the second degree between numbered unknowns (:mod:`.quadratics`), conditions that something is positive,
and choices between several lists of equations. After each datum :meth:`Readings.follow` settles whatever a few neighbouring
unknowns settle among themselves; several solutions make several readings, a contradiction takes a reading away.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from mnclab.geometry.quadratics import NEAR, SAME, Array, Form, System

Label = Any
MOST_READINGS = 256
WIDEST = 8  # unknowns in a row that are tried together before all of them are
SHORTEST = 1e-6  # mm: a line has a length, an arc a radius


class Reading(NamedTuple):
    """The unknowns (nan where not settled), and which of several solutions was taken at which unknown."""

    values: Array
    choices: tuple[tuple[float, int], ...]


class Contradiction(Exception):
    """Data that no contour fulfils; ``label`` is that of the datum, ``gap`` by how much it is missed (mm, or nan)."""

    def __init__(self, label: Label, gap: float) -> None:
        super().__init__(f"{label} contradicts what is known")
        self.label, self.gap = label, gap


class TooManyReadings(Exception):
    """More readings than can be followed."""


class Readings:
    """What has been told, and the readings that agree with all of it. ``places`` orders the unknowns: neighbours are near."""

    def __init__(self) -> None:
        self.dims: list[int] = []
        self.places: list[float] = []
        self.equations: list[tuple[Form, frozenset[int], Label]] = []
        self.limits: list[tuple[Form, frozenset[int], Label]] = []
        self.readings = [Reading(np.empty(0), ())]
        self.size = 1.0
        self.conflict: tuple[Label, float] | None = None

    def rank(self, values: Array, before: Array, window: Sequence[int]) -> list[float]:
        """What solutions for the unknowns of a window are sorted by; ``before`` is what was settled without them."""
        return [round(float(values[i]), 6) for i in window]

    def order_of(self, place: float) -> float:
        """Where a choice at a place comes in the order of the readings."""
        return place

    # --- telling --------------------------------------------------------------------------------------------------------

    def unknown(self, place: float, dim: int = 1) -> Form:
        """A new unknown, a length or (``dim`` 0) a component of a unit vector."""
        self.dims.append(dim)
        self.places.append(place)
        self.readings = [Reading(np.append(r.values, np.nan), r.choices) for r in self.readings]
        return Form(0.0, {len(self.dims) - 1: 1.0})

    def equal(self, form: Form, label: Label) -> None:
        """An equation form = 0."""
        self.equations.append((form, frozenset(form.variables), label))
        if form.power(self.dims) == 1:
            self.size = max(self.size, abs(form.const))

    def positive(self, form: Form, label: Label) -> None:
        """A condition form > 0."""
        self.limits.append((form, frozenset(form.variables), label))

    def either(self, alternatives: Sequence[Iterable[Form]], place: float, label: Label) -> None:
        """One of several lists of equations holds; the readings are followed for each."""
        flag = self.unknown(place)
        (variable,) = flag.linear
        count = len(alternatives)
        readings = []
        for reading in self.readings:
            for k in range(count):
                values = reading.values.copy()
                values[variable] = k
                readings.append(Reading(values, (*reading.choices, (place, k)) if count > 1 else reading.choices))
        self.readings = readings
        for k, forms in enumerate(alternatives):
            for form in forms:  # counts only in the readings that have taken it
                self.equations.append((form, frozenset(form.variables) | {-1 - variable, -1_000_000 - k}, label))
                if form.power(self.dims) == 1:
                    self.size = max(self.size, abs(form.const))

    # --- solving --------------------------------------------------------------------------------------------------------

    def follow(self, thoroughly: bool = False) -> None:
        """Settle in every reading what can be settled; raises Contradiction when none is left.

        ``thoroughly``: unknowns that hang together in large numbers are solved too.
        """
        self.conflict = None
        waiting, done = self.readings[::-1], []
        while waiting:
            reading = waiting.pop()
            following = self._further(reading, thoroughly)
            if following is None:
                done.append(reading)
            else:
                waiting += following[::-1]
            if len(waiting) + len(done) > MOST_READINGS:
                raise TooManyReadings
        done.sort(key=lambda reading: sorted(reading.choices))
        self.readings = []
        for reading in done:
            if not any(_alike(reading.values, other.values, SAME * self.size) for other in self.readings):
                self.readings.append(reading)
        if not self.readings:
            raise Contradiction(*(self.conflict or (None, np.nan)))

    def open_unknowns(self, reading: Reading) -> list[int]:
        """The unknowns that a reading has not settled, along the chain."""
        return sorted(np.flatnonzero(np.isnan(reading.values)).tolist(), key=lambda i: (self.places[i], i))

    def _holding(self, values: Array) -> list[tuple[int, Form, frozenset[int]]]:
        """Equations that hold in a reading: number, form, and those of its unknowns that are not settled."""
        found = []
        for number, (form, variables, _) in enumerate(self.equations):
            if any(i < 0 for i in variables):
                flag = next(-1 - i for i in variables if -1_000_000 < i < 0)
                if values[flag] != next(-1_000_000 - i for i in variables if i <= -1_000_000):
                    continue
            found.append((number, form, frozenset(i for i in variables if i >= 0 and np.isnan(values[i]))))
        return found

    def _further(self, reading: Reading, thoroughly: bool) -> list[Reading] | None:
        """The readings that a reading becomes by settling some unknowns more; None when nothing more can be settled."""
        values = reading.values
        holding = self._holding(values)
        if not self._consistent(values, holding):
            return []
        unknowns = self.open_unknowns(reading)
        widths = [*range(1, min(WIDEST, len(unknowns)) + 1)]
        if thoroughly:
            widths = [*range(1, len(unknowns) + 1)]
        carriers = [i for i in unknowns if self.places[i] % 2 == 1]
        for width in widths:
            for row in (unknowns, carriers) if len(carriers) < len(unknowns) else (unknowns,):
                for first in range(len(row) - width + 1):
                    window = row[first : first + width]
                    inside = frozenset(window)
                    mine = [item for item in holding if item[2] and item[2] <= inside]
                    if len(mine) < width or {i for item in mine for i in item[2]} != inside:
                        continue
                    system = System([form for _, form, _ in mine], window, values, self.dims, self.size)
                    found = system.solve(thoroughly)
                    if found is None:
                        continue
                    if not found:
                        self._blame(max(number for number, _, _ in mine), np.nan)
                    return self._fork(reading, window, found)
        return None

    def _fork(self, reading: Reading, window: Sequence[int], found: Sequence[Array]) -> list[Reading]:
        """A reading for each solution of a window, in the order that the module states."""
        readings = []
        for solution in found:
            values = reading.values.copy()
            values[list(window)] = solution
            readings.append(values)
        if len(readings) == 1:
            return [Reading(readings[0], reading.choices)]
        place = self.order_of(self.places[window[0]])
        readings.sort(key=lambda values: self.rank(values, reading.values, window))
        return [Reading(values, (*reading.choices, (place, k))) for k, values in enumerate(readings)]

    def _consistent(self, values: Array, holding: Sequence[tuple[int, Form, frozenset[int]]]) -> bool:
        """Whether a reading fulfils every condition on what it has settled."""
        for number, form, rest in holding:
            if not rest and (gap := form.gap(values, self.dims)) > NEAR:
                self._blame(number, gap)
                return False
        for form, variables, label in self.limits:
            if not any(np.isnan(values[i]) for i in variables) and form.at(values) < SHORTEST:
                self.conflict = self.conflict or (label, np.nan)
                return False
        return True

    def _blame(self, number: int, gap: float) -> None:
        """Remember what took a reading away: the datum that is missed least."""
        if self.conflict is None or np.isnan(self.conflict[1]) or gap < self.conflict[1]:
            self.conflict = (self.equations[number][2], gap)

    def missing(self, reading: Reading) -> int:
        """How many data a reading lacks; 0 also where no solution is found."""
        forms = [form for _, form, rest in self._holding(reading.values) if rest]
        return System(forms, self.open_unknowns(reading), reading.values, self.dims, self.size).freedom()


def _alike(a: Array, b: Array, tolerance: float) -> bool:
    """Whether two readings have settled the same unknowns with the same values."""
    nothing = np.isnan(a)
    return bool((nothing == np.isnan(b)).all() and (np.abs(a - b)[~nothing] <= tolerance).all())

"""A polynomial of the second degree in numbered unknowns: one equation about points, lines and circles."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from itertools import product
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Key = TypeVar("Key", bound=Hashable)


class Form:
    """A polynomial of degree two at most: `const`, `linear` {i: a}, `square` {(i, j): a} with i <= j."""

    __slots__ = ("const", "linear", "square")

    def __init__(self, const: float = 0.0, linear: dict[int, float] | None = None,
                 square: dict[tuple[int, int], float] | None = None) -> None:  # fmt: skip
        self.const = float(const)
        self.linear = {i: a for i, a in (linear or {}).items() if a}
        self.square = {ij: a for ij, a in (square or {}).items() if a}

    def __add__(self, other: Form | float) -> Form:
        if not isinstance(other, Form):
            return Form(self.const + other, self.linear, self.square)
        linear, square = _added(self.linear, other.linear.items()), _added(self.square, other.square.items())
        return Form(self.const + other.const, linear, square)

    __radd__ = __add__

    def __neg__(self) -> Form:
        return self * -1.0

    def __sub__(self, other: Form | float) -> Form:
        return self + (-other)

    def __rsub__(self, other: float) -> Form:
        return -self + other

    def __mul__(self, other: Form | float) -> Form:
        """The product; both factors must be linear unless one is a number."""
        if not isinstance(other, Form):
            square = {ij: a * other for ij, a in self.square.items()}
            return Form(self.const * other, {i: a * other for i, a in self.linear.items()}, square)
        assert not (self.square or other.square), "a product of degree three"
        linear = {i: a * other.const for i, a in self.linear.items()}
        linear = _added(linear, ((i, a * self.const) for i, a in other.linear.items()))
        products = product(self.linear.items(), other.linear.items())
        square = _added({}, (((min(i, j), max(i, j)), a * b) for (i, a), (j, b) in products))
        return Form(self.const * other.const, linear, square)

    __rmul__ = __mul__

    @property
    def variables(self) -> set[int]:
        return set(self.linear) | {i for ij in self.square for i in ij}

    def at(self, values: Array) -> float:
        total = self.const
        for i, a in self.linear.items():
            total += a * values[i]
        for (i, j), a in self.square.items():
            total += a * values[i] * values[j]
        return float(total)

    def power(self, dims: Sequence[int]) -> int:
        """The dimension of its value: mm to this power."""
        return max([dims[i] for i in self.linear] + [dims[i] + dims[j] for i, j in self.square], default=1)

    def gap(self, values: Array, dims: Sequence[int]) -> float:
        """By how much the equation form = 0 is missed, mm; an angle counts as on an arm of 10 mm."""
        value, power = abs(self.at(values)), self.power(dims)
        if power == 0:
            return 10 * value
        if power == 1:
            return value
        sides = (term for (i, j), a in self.square.items() for term in ((i, a * values[j]), (j, a * values[i])))
        slope = _added(self.linear, sides)
        steep = np.sqrt(sum(a * a for i, a in slope.items() if dims[i]))
        return float(value / max(steep, 1e-3))


def _added(terms: Mapping[Key, float], more: Iterable[tuple[Key, float]]) -> dict[Key, float]:
    total = dict(terms)
    for key, a in more:
        total[key] = total.get(key, 0.0) + a
    return total

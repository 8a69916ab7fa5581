"""A polynomial of the second degree in numbered unknowns: one equation about points, lines and circles."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


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
        linear, square = dict(self.linear), dict(self.square)
        for i, a in other.linear.items():
            linear[i] = linear.get(i, 0.0) + a
        for ij, a in other.square.items():
            square[ij] = square.get(ij, 0.0) + a
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
            return Form(
                self.const * other,
                {i: a * other for i, a in self.linear.items()},
                {ij: a * other for ij, a in self.square.items()},
            )
        assert not (self.square or other.square), "a product of degree three"
        linear: dict[int, float] = {i: a * other.const for i, a in self.linear.items()}
        for i, a in other.linear.items():
            linear[i] = linear.get(i, 0.0) + a * self.const
        square: dict[tuple[int, int], float] = {}
        for i, a in self.linear.items():
            for j, b in other.linear.items():
                ij = (min(i, j), max(i, j))
                square[ij] = square.get(ij, 0.0) + a * b
        return Form(self.const * other.const, linear, square)

    __rmul__ = __mul__

    @property
    def variables(self) -> set[int]:
        """The unknowns that occur."""
        return set(self.linear) | {i for ij in self.square for i in ij}

    def at(self, values: Array) -> float:
        """Its value."""
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
        slope: dict[int, float] = dict(self.linear)
        for (i, j), a in self.square.items():
            slope[i] = slope.get(i, 0.0) + a * values[j]
            slope[j] = slope.get(j, 0.0) + a * values[i]
        steep = np.sqrt(sum(a * a for i, a in slope.items() if dims[i]))
        return float(value / max(steep, 1e-3))

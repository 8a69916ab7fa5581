"""Small systems of quadratic equations, with all their real solutions."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from itertools import product
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

# A polynomial of the second degree in numbered unknowns: one equation about points, lines and circles.

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


# Newton's method for many starts at once, and where two conics meet; what a search may cost is counted.

AT_ONCE = 100_000  # products in one multiplication of matrices: with more BLAS would wake its threads, which costs more


class Exhausted(Exception):
    """The search for solutions has cost as much as it may."""


class Effort:
    """What a search may still cost: about a microsecond each, counted and not measured, so that it always ends alike."""

    def __init__(self, left: float = 0.0) -> None:
        self.left = left

    def spend(self, amount: float) -> None:
        """Count some work; Exhausted when none is left, until more is granted."""
        self.left -= amount
        if self.left < 0:
            raise Exhausted


Conic = tuple[Array, Array, float]
_TURN = np.array([[np.cos(0.7), -np.sin(0.7)], [np.sin(0.7), np.cos(0.7)]])


def conics(first: Conic, second: Conic) -> list[Array] | None:
    """Where two conics xᵀAx + bx + c = 0 meet, points (2,): roots of the resultant of degree four, polished.

    A point may come more than once. None when they have a curve in common. The axes are turned so that two of the points
    hardly ever lie above each other.
    """
    (a1, b1, c1), (a2, b2, c2) = ((_TURN.T @ a @ _TURN, b @ _TURN, c) for a, b, c in (first, second))
    p1, p2 = (np.array([a[1, 1]]) for a in (a1, a2))  # p y² + q(x) y + r(x), highest powers of x first
    q1, q2 = (np.array([2 * a[0, 1], b[1]]) for a, b in ((a1, b1), (a2, b2)))
    r1, r2 = (np.array([a[0, 0], b[0], c]) for a, b, c in ((a1, b1, c1), (a2, b2, c2)))
    pr, pq, qr = _cross(p1, r1, p2, r2), _cross(p1, q1, p2, q2), _cross(q1, r1, q2, r2)
    resultant = np.convolve(pr, pr) - np.convolve(pq, qr)
    resultant[np.abs(resultant) < 1e-14 * np.abs(resultant).max()] = 0
    if not resultant.any():
        return None
    nearly_real = [x.real for x in np.roots(resultant) if abs(x.imag) <= 1e-3 * (1 + abs(x))]
    found = [
        [x, y.real]
        for x in nearly_real
        for p, q, r in ((p1, q1, r1), (p2, q2, r2))
        for y in np.roots([p[0], np.polyval(q, x), np.polyval(r, x)])
    ]
    if not found:
        return []
    a, b, c = np.array([a1, a2]), np.array([b1, b2]), np.array([c1, c2])
    ends, _ = newton_from(a, b, c, np.array(found), rounds=60)
    return [_TURN @ end for end in ends]


def _cross(s: Array, t: Array, u: Array, v: Array) -> Array:
    """The polynomial s v - u t."""
    return np.asarray(np.convolve(s, v) - np.convolve(u, t))


def newton_from(
    a: Array, b: Array, c: Array, starts: Array, rounds: int = 80, work: Effort | None = None
) -> tuple[Array, NDArray[np.bool_]]:
    """Solutions (m, v) of xᵀAx + bx + c = 0 (k equations) reached from starts (n, v), and which of them are single (m,).

    Levenberg's damping fades with the residual, so that the last steps are Newton's. Of many starts, for which `work` is
    counted, those that have arrived rest; at a solution that is not single steps stay long, and only many show what it is.
    """
    x, (k, v) = starts.copy(), b.shape
    eye = np.eye(v)
    scale = np.maximum(np.sqrt((a**2).sum(axis=(1, 2)) + (b**2).sum(axis=1)), 1e-300)
    a, b, c = a / scale[:, None, None], b / scale[:, None], c / scale
    flat = a.reshape(k * v, v).T
    piece = max(1, AT_ONCE // max(1, k * v * v))

    def value_and_slope(x: Array) -> tuple[Array, Array]:
        if piece > 1:
            parts = [x[i : i + piece] @ flat for i in range(0, max(1, len(x)), piece)]
            ax = np.concatenate(parts).reshape(len(x), k, v)
        else:
            ax = (a @ x[:, None, :, None])[..., 0]
        return (ax * x[:, None]).sum(axis=2) + x @ b.T + c, 2 * ax + b

    going, last = np.arange(len(x)), np.full(len(x), np.inf)
    for _ in range(rounds):
        f, slope = value_and_slope(x[going])
        arrived = np.abs(f).max(axis=1, initial=0) < 1e-14
        if arrived.all():
            break
        if work is not None:
            work.spend(50 + len(going) * (2 + k * v * v / 600))
            on = ~arrived | (last[going] > 1e-10)
            going, f, slope = going[on], f[on], slope[on]
        damping = np.minimum((f**2).sum(axis=1), 1.0)[:, None, None] * 0.1 + 1e-13
        matrix = slope.transpose(0, 2, 1) @ slope + damping * eye
        step = np.linalg.solve(matrix, (f[:, None] @ slope)[:, 0, :, None])[:, :, 0]
        length = np.linalg.norm(step, axis=1, keepdims=True)
        x[going] -= step * np.minimum(1.0, 3.0 / np.maximum(length, 1e-300))
        last[going] = length[:, 0]
    f, slope = value_and_slope(x)
    good = (np.abs(f).max(axis=1) < 1e-11) & (np.abs(x).max(axis=1) < 1e4)
    steepness = np.linalg.svd(slope[good], compute_uv=False)[:, -1] if good.any() else np.empty(0)
    return x[good], steepness > 1e-7


# Incidence, tangency, distance and angle between points, oriented lines and oriented circles are equations of the second
# degree at most, when a line is (n, c) with n·p = c and |n| = 1, and a circle is its centre and its signed radius. So a
# system of them is solved in four steps: linear equations are eliminated; quadratic ones with proportional quadratic parts
# are subtracted, which leaves linear ones (the circles of Apollonius become a line and one quadric that way); what is left
# in one unknown is a quadratic equation, in two unknowns two conics, whose resultant has degree four. Three unknowns and
# more are found by Newton's method from many starts.
# Unknowns are numbered; the dimension of each is 1 (mm) or 0 (a component of a unit vector).

NEAR = 1e-3  # mm: data that are rounded as drawings are may contradict each other by as much
SAME = 1e-7  # solutions closer than this, in units of the size of the contour, are one
FIRST_STARTS, STARTS = 60, 300  # starts of Newton's method in the first round, and in each that follows
MOST_UNKNOWNS = 16
MOST_OPEN = 2 * MOST_UNKNOWNS  # after the linear equations: half of them may follow from quadratic ones
MOST_SOLUTIONS = 64
SMALL = 24  # rows or columns of a matrix that is decomposed; larger ones would wake the threads of BLAS


class System:
    """Equations in some unknowns as arrays, lengths in units of `size` mm, the other unknowns taken from `values`."""

    def __init__(
        self, forms: Sequence[Form], unknowns: Sequence[int], values: Array, dims: Sequence[int], size: float
    ) -> None:
        self.forms, self.unknowns, self.values, self.dims = forms, list(unknowns), values, dims
        k, v = len(forms), len(self.unknowns)
        index = {variable: column for column, variable in enumerate(self.unknowns)}
        self.unit = np.array([size if dims[i] else 1.0 for i in self.unknowns])
        self.near, self.size = NEAR / size, size
        a, b, c = np.zeros((k, v, v)), np.zeros((k, v)), np.zeros(k)
        for row, form in enumerate(forms):
            c[row], linear = form.const, list(form.linear.items())
            for (i, j), factor in form.square.items():
                if i in index and j in index:
                    a[row, index[i], index[j]] += factor / 2
                    a[row, index[j], index[i]] += factor / 2
                else:
                    linear.append((i, factor * values[j]) if i in index else (j, factor * values[i]))
            for i, factor in linear:
                if i in index:
                    b[row, index[i]] += factor
                else:
                    c[row] += factor * values[i]
            scale = size ** form.power(dims)
            a[row] *= self.unit[:, None] * self.unit / scale
            b[row] *= self.unit / scale
            c[row] /= scale
        self.a, self.b, self.c = a, b, c

    def solve(self, work: Effort | None = None, newton: bool = False) -> list[Array] | None:
        """All real solutions (v,), in mm; None if there are infinitely many, or without `newton` if they would need it.

        `work` is what the search may cost; nothing bounds it without.
        """
        self.work = work or Effort(np.inf)
        a, b, c = self.a, self.b, self.c
        begin, basis = np.zeros(len(self.unknowns)), np.eye(len(self.unknowns))
        while True:
            flat = np.abs(a).max(axis=(1, 2), initial=0) < 1e-10
            rows, rest = _linear_rows(a, b, c, flat)
            if not len(rows):
                break
            steep = np.linalg.norm(rows, axis=1)
            rows, rest = rows / steep[:, None], rest / steep
            self.work.spend(250 + a.size * a.shape[1] / 500)
            step, null = _solved(rows, rest)
            if np.abs(rows @ step + rest).max() > self.near:
                return []
            if null.shape[1] > MOST_OPEN:
                return None
            c = c + b @ step + np.einsum("kij,i,j->k", a, step, step)
            b = (b + 2 * a @ step) @ null
            a = null.T @ a @ null
            begin, basis = begin + basis @ step, basis @ null
            if not basis.shape[1]:
                break
        found = self._nonlinear(a, b, c, begin, basis, newton)
        return None if found is None else self._distinct(begin + basis @ t for t in found)

    def _nonlinear(self, a: Array, b: Array, c: Array, begin: Array, basis: Array, newton: bool) -> list[Array] | None:
        """What is left after all linear equations, in coordinates of the basis; None if too little is left."""
        count = basis.shape[1]
        if count == 0:
            return [np.zeros(0)]
        curved = [k for k in range(len(c)) if np.abs(a[k]).max() > 1e-10]
        if count == 1 and curved:
            k = curved[0]
            return self._roots(k, a[k, 0, 0], b[k, 0], c[k], begin, basis)
        if len(curved) < count:
            return None
        if count == 2:
            parts = a[curved].reshape(len(curved), -1)
            parts = parts / np.linalg.norm(parts, axis=1)[:, None]
            other = next((k for k, part in zip(curved, parts, strict=True) if 1 - abs(part @ parts[0]) > 1e-9), None)
            if other is None:
                return None
            self.work.spend(3000)
            return conics((a[curved[0]], b[curved[0]], c[curved[0]]), (a[other], b[other], c[other]))
        if not newton or count > MOST_UNKNOWNS:
            return None
        return self._from_starts(a[curved], b[curved], c[curved], begin, basis)

    def _roots(self, k: int, a: float, b: float, c: float, begin: Array, basis: Array) -> list[Array]:
        """A quadratic equation; where it is missed by less than drawings are exact, or hardly met, it has one root."""
        middle, bottom = -b / (2 * a), c - b * b / (4 * a)
        gap = self.gap(k, begin + basis @ np.array([middle]))
        if gap < 1e-10 * self.size or (bottom * a > 0 and gap < NEAR):
            return [np.array([middle])]
        if bottom * a > 0:
            return []
        width = np.sqrt(-bottom / a)
        return [np.array([middle - width]), np.array([middle + width])]

    def _from_starts(self, a: Array, b: Array, c: Array, begin: Array, basis: Array) -> list[Array] | None:
        """Newton's method from random starts, until rounds find nothing new; None where solutions are not single.

        Half of the starts lie near solutions found before: solutions often come in close pairs.
        """
        random = np.random.default_rng(len(self.unknowns))
        found: list[Array] = []
        idle, count = 0, FIRST_STARTS
        while idle < 3 and len(found) < MOST_SOLUTIONS:
            starts = (random.normal(0, 1.0, (count, len(begin))) - begin) @ basis
            if found:
                near = np.array(found)[random.integers(len(found), size=count // 2)]
                apart = random.normal(0, 1, near.shape)
                starts[: len(near)] = near + apart * 10 ** random.uniform(-3, 0, (len(near), 1))
            ends, single = newton_from(a, b, c, starts, work=self.work)
            if len(ends) and not single.any():
                return None
            before = len(found)
            for end in ends[single]:
                if all(np.abs(end - other).max() > SAME for other in found):
                    found.append(end)
            idle, count = 0 if len(found) > before else idle + 1, STARTS
        return found

    def gap(self, k: int, scaled: Array) -> float:
        """By how much equation k is missed, mm."""
        values = self.values.copy()
        values[self.unknowns] = scaled * self.unit
        return self.forms[k].gap(values, self.dims)

    def _distinct(self, found: Iterable[Array]) -> list[Array]:
        """Those that fulfil every equation, each once."""
        kept: list[Array] = []
        for scaled in found:
            if all(self.gap(k, scaled) <= NEAR for k in range(len(self.forms))):
                if all(np.abs(scaled - other).max() > SAME for other in kept):
                    kept.append(scaled)
        return [scaled * self.unit for scaled in kept]

    def freedom(self) -> int:
        """How many data more would settle the unknowns: those less the rank of the equations at one of the solutions.

        At any other place equations that follow from each other would look independent. 0 where no solution is found.
        """
        return min((free.shape[1] for free in self._free(Effort(np.inf))), default=0)

    def settled(self, work: Effort) -> set[int]:
        """The unknowns that cannot move at some solution; all of them where no solution is found."""
        moving = [np.abs(directions).max(axis=1, initial=0) > 1e-6 for directions in self._free(work)]
        return {i for k, i in enumerate(self.unknowns) if not moving or not all(moves[k] for moves in moving)}

    def _free(self, work: Effort) -> list[Array]:
        """The directions (v, d) in which the unknowns can move at each of some solutions."""
        random = np.random.default_rng(len(self.unknowns))
        starts = random.normal(0, 1.0, (20, len(self.unknowns)))
        if not len(self.c):
            return [np.eye(len(self.unknowns))]
        ends, _ = newton_from(self.a, self.b, self.c, starts, rounds=40, work=work)
        work.spend(len(ends) * len(self.unknowns) * 30)
        return [_directions(2 * self.a @ end + self.b, 1e-7) for end in ends]


def _solved(rows: Array, rest: Array) -> tuple[Array, Array]:
    """The shortest x (v,) with rows x + rest = 0, as nearly as it can be had, and orthonormal directions (v, d) left open."""
    v = rows.shape[1]
    if max(rows.shape) <= SMALL:
        u, s, vt = np.linalg.svd(rows, full_matrices=True)
        rank = int((s > 1e-8 * s[0]).sum())
        return -(vt[:rank].T / s[:rank]) @ (u.T[:rank] @ rest), vt[rank:].T
    step = np.zeros(v)
    reduced, pivots, columns = _reduced(np.column_stack([rows, rest]), v, 1e-8)
    step[columns] = -reduced[pivots, v]
    null, _ = np.linalg.qr(_directions(rows, 1e-8))
    return step - null @ (null.T @ step), null


def _reduced(matrix: Array, v: int, tolerance: float) -> tuple[Array, list[int], list[int]]:
    """Gauss and Jordan's elimination of the first `v` columns, with rows and columns of the pivots."""
    matrix, left = matrix.copy(), np.abs(matrix[:, :v])
    rows: list[int] = []
    columns: list[int] = []
    while len(rows) < min(left.shape):
        i, j = divmod(int(left.argmax()), v)
        if left[i, j] <= tolerance:
            break
        rows.append(i)
        columns.append(j)
        matrix[i] /= matrix[i, j]
        factors = matrix[:, j].copy()
        factors[i] = 0
        matrix -= factors[:, None] * matrix[i]
        left = np.abs(matrix[:, :v])
        left[rows] = 0
    return matrix, rows, columns


def _directions(matrix: Array, tolerance: float) -> Array:
    """Directions (v, d) that a matrix (k, v) takes to nothing, independent of each other."""
    v = matrix.shape[1]
    reduced, rows, columns = _reduced(matrix, v, tolerance)
    open_ = np.setdiff1d(np.arange(v), columns)
    found = np.zeros((v, len(open_)))
    found[open_, np.arange(len(open_))] = 1
    found[columns] = -reduced[rows][:, open_]
    return found


def _linear_rows(a: Array, b: Array, c: Array, flat: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Equations without a quadratic part, and those that appear where quadratic parts are proportional: (m, v), (m,)."""
    linear = flat & (np.abs(b).max(axis=1, initial=0) > 1e-9)
    if linear.any() or a.shape[1] < 2:
        return b[linear], c[linear]
    curved = np.flatnonzero(~flat)
    if len(curved) < 2:
        return b[:0], c[:0]
    parts = a[curved].reshape(len(curved), -1)
    norm = np.linalg.norm(parts, axis=1)
    parts = parts / norm[:, None]
    if len(curved) <= SMALL and a.shape[1] ** 2 <= SMALL**2 / 2:
        u, s, _ = np.linalg.svd(parts, full_matrices=len(parts) > parts.shape[1])  # all of u, not of v
        mix = u.T[int((s > 1e-9 * s[0]).sum()) :] / norm
    else:
        mix = _directions(parts.T, 1e-9).T
        mix = mix / np.linalg.norm(mix, axis=1, keepdims=True) / norm
    rows, rest = mix @ b[curved], mix @ c[curved]
    real = np.linalg.norm(rows, axis=1) > 1e-7
    return rows[real], rest[real]

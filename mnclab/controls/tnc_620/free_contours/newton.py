"""Newton's method for many starts at once, and where two conics meet; what a search may cost is counted."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
AT_ONCE = 100_000  # products in one multiplication of matrices: with more BLAS would wake its threads, which costs more


class Exhausted(Exception):
    """The search for solutions has cost as much as it may."""


class Work:
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
    a: Array, b: Array, c: Array, starts: Array, rounds: int = 80, work: Work | None = None
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

"""Depths: a way down cut into steps, all of one size or each smaller than the one before. Lengths in mm."""

from __future__ import annotations

import math

DRIFT = 1e-9  # mm; a rest below this is a rounding error and no level of its own
MOST = 10_000  # levels of one hole


class TooMany(ValueError):
    """A way that would need more than `MOST` levels."""


def infeeds(
    surface: float, bottom: float, step: float | None, decrement: float = 0.0, least: float = 0.0
) -> tuple[float, ...]:
    """The levels from `surface` down (or up) at which to cut, one `step` apart; the last one is `bottom`.

    No step, or a step of 0, is one pass at `bottom`. With a `decrement` each infeed is smaller than the one before by
    that much, but not below `least` (and never above `step`). Holes are pecked by the same rule.

    >>> infeeds(30, 10.1, 5)
    (25.0, 20.0, 15.0, 10.1)
    >>> infeeds(0, -18, 5, decrement=1, least=3)
    (-5.0, -9.0, -12.0, -15.0, -18.0)
    """
    if step is not None and not step >= 0:
        raise ValueError(f"the infeed must not be negative, got {step:g}")
    total = abs(bottom - surface)
    if not step or not math.isfinite(step):
        return (float(bottom),)
    sign = math.copysign(1.0, bottom - surface)
    if decrement:
        return (*(surface + sign * depth for depth in _decreasing(total, step, decrement, least)), float(bottom))
    if total > (MOST + 0.5) * step:
        raise TooMany(f"{step:.10g} divides {total:.10g} into more than {MOST} infeeds")
    whole = math.ceil((total - DRIFT) / step) - 1  # steps that end clearly before the bottom
    return (*(surface + sign * k * step for k in range(1, whole + 1)), float(bottom))


def _decreasing(total: float, step: float, decrement: float, least: float) -> list[float]:
    """The depths above `total` that infeeds reach which shrink down to `least`."""
    depths: list[float] = []
    depth = 0.0
    while (depth := depth + max(step - len(depths) * decrement, min(least, step), 0.0)) < total - DRIFT:
        depths.append(depth)
        if len(depths) >= MOST:
            raise TooMany(f"{step:g} less {decrement:g} each time divides {total:g} into more than {MOST} infeeds")
    return depths


def advanced_stops(first: float, last: float, count: int) -> tuple[float, ...]:
    """How far above the last depth to stop the rapid of each of `count` re-entries: evenly from `first` to `last`.

    >>> advanced_stops(0.5, 1.1, 4)
    (0.5, 0.7, 0.9, 1.1)
    """
    return tuple(round(first + (last - first) * k / max(count - 1, 1), 9) for k in range(count))

"""Depths: a way down cut into steps of one size, the last one being what is left. Lengths in mm."""

from __future__ import annotations

import math

DRIFT = 1e-9  # mm; a rest below this is a rounding error and no level of its own


def infeeds(surface: float, bottom: float, step: float | None) -> tuple[float, ...]:
    """The levels from `surface` down (or up) at which to cut, one `step` apart; the last one is `bottom`.

    No step, or a step of 0, is one pass at `bottom`. Holes are pecked by the same rule.

    >>> infeeds(30, 10.1, 5)
    (25.0, 20.0, 15.0, 10.1)
    """
    if step is not None and not step >= 0:
        raise ValueError(f"the infeed must not be negative, got {step:g}")
    total = abs(bottom - surface)
    if not step or not math.isfinite(step):
        return (float(bottom),)
    sign = math.copysign(1.0, bottom - surface)
    whole = math.ceil((total - DRIFT) / step) - 1  # steps that end clearly before the bottom
    return (*(surface + sign * k * step for k in range(1, whole + 1)), float(bottom))

"""Places where the tool does not fit, and how large a tool would."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mnclab.path.columns import Array, Index, Mask
from mnclab.path.compensation.elements import Elements

EXACT = 1e-9  # mm
HINT = "take a smaller tool"


class Places(NamedTuple):
    """m places of one kind that do not fit: the elements concerned, the ones they cut into, the width that is there,
    what is missing (mm), and the largest radius for the place alone (all (m,)), with the words for them."""

    kind: str
    k: Index
    other: Index
    width: Array
    missing: Array
    largest: Array
    message: str
    hint: str = HINT


def narrowed(fits: Callable[[Index, Array], Mask], radius: Array, parts: int = 16) -> Array:
    """The largest radii (m,) below the given ones for which something fits, by dividing the interval again and again.
    `fits(which, radius)` tells for the things `which` (n,) of the m whether they fit (n,); all fit at zero."""
    m = len(radius)
    low, high, which = np.zeros(m), radius.copy(), np.repeat(np.arange(m), parts - 1)
    steps = np.arange(1, parts) / parts
    for _ in range(14):
        width = high - low
        tried = low[:, None] + width[:, None] * steps
        good = fits(which, tried.ravel()).reshape(m, parts - 1)
        first = np.where(good.all(axis=1), parts - 1, np.argmin(good, axis=1))  # the first that does not fit
        low, high = low + width * first / parts, np.where(first < parts - 1, low + width * (first + 1) / parts, high)
        if (high - low <= 1e-13 * radius).all():
            break
    return low


def misfit(el: Elements) -> Array:
    """By how much the end of each arc misses its circle (n,), mm: the tolerance of programmed centres."""
    slack = np.zeros(len(el.rows))
    k = np.flatnonzero(el.arc)
    slack[k] = np.abs(np.hypot(*(el.end[k] - el.centre[k]).T) - el.r[k])
    return slack

"""One measure of a feature as it was found."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from mnclab.design.model.measures import Measure
from mnclab.path.toolpath import Index

NONE = np.zeros(0, dtype=np.int64)


class Reading(NamedTuple):
    """`side` is "top" or "back". `actual` is nan where nothing could be read, and `said` says why. `allowed` is how far it may
    be off where the drawing gives no limits, mm or degrees. `among` are the places that it was read off: the worst of
    them names the row."""

    side: str
    feature: str
    measure: Measure
    actual: float = math.nan
    allowed: float = 0.0
    among: Index = NONE
    said: str = ""

"""What the axes of a machine can do."""

from __future__ import annotations

from dataclasses import dataclass

PerAxis = float | tuple[float, ...]


@dataclass(frozen=True)
class Limits:
    """Per axis, or one number for all: ``rapid`` mm/min, ``acceleration`` mm/s², ``jerk`` mm/s³ (None: no limit).

    ``corner_tolerance`` mm is how far a corner may be cut; 0 stops wherever an axis would jump. ``travel`` holds the
    lower and upper machine position of each axis, mm, or None. The defaults are those of a small machining centre.
    """

    rapid: PerAxis = 10_000.0
    acceleration: PerAxis = 1_000.0
    jerk: PerAxis | None = None
    corner_tolerance: float = 0.0
    travel: tuple[tuple[float, float], ...] | None = None

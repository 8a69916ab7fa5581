"""Random moves and contours for the profile tests, the same for whoever records answers and for the tests.

Only the standard library draws the numbers, so that they never change. Lengths mm, times s.
"""

import math
import random

MOVES, CONTOURS, GROUPS = 6000, 1000, 10


def _log(rng, low, high):
    return 10 ** rng.uniform(low, high)


def ramp_length(v0, v1, a, j):
    """The length of a ramp between two speeds with no acceleration at its ends."""
    change = abs(v1 - v0)
    time = change / a + a / j if change >= a * a / j else 2 * math.sqrt(change / j)
    return time * (v0 + v1) / 2


def moves():
    """(length, v0, v1, v, a, j): a third from stop to stop, the others between speeds that a ramp can join."""
    rng = random.Random(20260101)
    found = []
    for k in range(MOVES):
        v, a, j = _log(rng, 0, 3), _log(rng, 1, 4), _log(rng, 2, 6)
        v0 = v1 = 0.0
        if k % 3:
            v0, v1 = rng.uniform(0, v), rng.choice([0.0, v, rng.uniform(0, v)])
        least = ramp_length(v0, v1, a, j)
        length = least * (1 + _log(rng, -3, 1)) if least > 0 else _log(rng, -3, 3)
        found.append((length, v0, v1, v, a, j))
    return found


def accelerations():
    """The limits of X and Y, mm/s², one pair for each group of contours."""
    rng = random.Random(7)
    return [(rng.uniform(200, 2000), rng.uniform(200, 2000)) for _ in range(GROUPS)]


def contours():
    """Contours of lines and arcs that join tangentially: lists of (x, y, sweep, centre x, centre y), each from 0 0."""
    rng = random.Random(1)
    found = []
    for k in range(CONTOURS):
        x = y = 0.0
        heading = rng.uniform(0, 2 * math.pi)
        rows = []
        for i in range(rng.randrange(1, 10)):
            if (i + k) % 2 == 0:
                length = _log(rng, -0.5, 1.7)
                x, y = x + length * math.cos(heading), y + length * math.sin(heading)
                rows.append((x, y, 0.0, math.nan, math.nan))
            else:
                radius, sweep = _log(rng, 0, 1.5), rng.choice([-1, 1]) * rng.uniform(0.3, 4)
                side = math.copysign(radius, sweep)
                cx, cy = x - side * math.sin(heading), y + side * math.cos(heading)
                heading += sweep
                x, y = cx + side * math.sin(heading), cy - side * math.cos(heading)
                rows.append((x, y, sweep, cx, cy))
        found.append(rows)
    return found

"""FN 23 and FN 24, circles through points (iTNC 530 user's manual 9.5: centre in Q20 and Q21, radius in Q22)."""

from __future__ import annotations

import math
import random

import pytest


def blocks(number: int, points: list[tuple[float, float]], kind: str = "Q") -> str:
    values = [value for point in points for value in point]
    lines = "".join(f"{kind}{k} = {value!r}\n" for k, value in enumerate(values, 30))
    return f"{lines}90 FN {number}: {kind}20 = CDATA {kind}30"


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize(("number", "count"), [(23, 3), (24, 4)])
def test_points_of_a_circle_give_it_back(number: int, count: int, seed: int, inside) -> None:
    rng = random.Random(seed)
    x, y, radius = rng.uniform(-500, 500), rng.uniform(-500, 500), 10 ** rng.uniform(-1, 3)
    begin = rng.uniform(0, 360)
    angles = [math.radians(begin + 360 / count * k + rng.uniform(-40, 40)) for k in range(count)]
    run = inside(blocks(number, [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]))
    assert run.ok and not run.alarms, run.alarms
    assert [run.variables[f"Q{k}"] for k in (20, 21, 22)] == pytest.approx([x, y, radius], abs=1e-8)


def test_three_points_worked_out_by_hand(inside) -> None:
    """The right angle at (0, 0) sees the diameter from (8, 0) to (0, 6): centre (4, 3), radius 5."""
    run = inside(blocks(23, [(0, 0), (8, 0), (0, 6)], "QL"))
    assert [run.history[f"QL{k}"][-2] for k in (20, 21, 22)] == pytest.approx([4, 3, 5], abs=1e-13)


def test_four_measured_points_are_evened_out_and_named(inside) -> None:
    """Opposite points 0.1 nearer to and farther from the middle: the middle stays, the radius squared is the mean."""
    run = inside(blocks(24, [(10.1, 0), (0, 9.9), (-10.1, 0), (0, -9.9)]))
    (warning,) = run.alarms
    assert warning.severity == "warning" and "least squares" in warning.message
    expected = [0, 0, math.sqrt((10.1**2 + 9.9**2) / 2)]
    assert [run.variables[f"Q{k}"] for k in (20, 21, 22)] == pytest.approx(expected, abs=1e-12)

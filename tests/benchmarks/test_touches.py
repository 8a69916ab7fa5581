"""What a touch costs, and a row of a probe, on a part of twenty solids.

`pytest -m benchmark -s tests/benchmarks/test_touches.py` prints the times; none is asserted.
"""

import time

import numpy as np
import pytest

from mnclab.workpiece.part import box, contact, hole

pytestmark = pytest.mark.benchmark
TOUCHES = 500
PLACES = [(20.0 + 19 * k, 50.0 + 40 * (k % 5)) for k in range(19)]


def plate(**errors):
    part = box((0, 0, -40), (400, 300, 0))
    for k, (x, y) in enumerate(PLACES):
        part = part - hole((x, y, 0), 8 + k / 2, 5 + k)
    return part.with_errors(**errors)


@pytest.mark.parametrize("errors", [{}, {"taper": 0.5, "bow": 0.02, "roughness": 0.003}])
def test_touches_of_a_plate(errors):
    part, rng = plate(**errors), np.random.default_rng(1)
    begin = time.process_time()
    part(np.zeros((1, 3)))
    print(f"\n{errors or 'no errors'}: put together {1000 * (time.process_time() - begin):.0f} ms")
    ways = {
        "in a bore": lambda k, a: contact(part, (*PLACES[k], -2), (np.cos(a), np.sin(a), 0), 1.5, 30),
        "a side, slanting": lambda k, a: contact(part, (-12, 20 + 10 * k, -5), (1, 0.1, 0.02), 1.5, 60),
        "the face": lambda k, a: contact(part, (200, 10 + k, 8), (0, 0, -1), 1.5, 30),
        "a row over it": lambda k, a: part.blocked((-20, 10 * k, 5), (420, 300 - 10 * k, 5), 1.5, 1.0, 50),
        "a row down a bore": lambda k, a: part.blocked((*PLACES[k], 50), (*PLACES[k], -2), 1.5, 1.0, 50),
    }
    for name, way in ways.items():
        begin = time.process_time()
        for k in range(TOUCHES):
            way(k % 19, rng.uniform(0, 2 * np.pi))
        print(f"{name:20} {1000 * (time.process_time() - begin) / TOUCHES:.2f} ms")

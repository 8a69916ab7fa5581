"""A pocket with ten islands, 2,000 lines and arcs in turn: rings beside the bare loop of shapely, which rounds arcs to polylines.

`pytest -m benchmark -s tests/benchmarks/test_rings.py` prints processor times and their ratio; no time is asserted. The loop
buffers the area of the tool centre by -k·step until nothing is left; arcs have 16 or 64 pieces a quadrant, joints as well.
"""

import time

import numpy as np
import pytest
from tools.random_regions import large_task

from mnclab.machining.milling.rings import rings

pytestmark = pytest.mark.benchmark
ARC = 0.3  # mm, about the radius of the arcs


def best(work, rounds=5):
    """The least processor time of some rounds."""
    times = []
    for _ in range(rounds):
        begin = time.process_time()
        work()
        times.append(time.process_time() - begin)
    return min(times)


@pytest.mark.parametrize("quadrant", [16, 64])
def test_ten_islands(told, quadrant):
    task = large_task(2000)
    region, area = task.region, task.polygon(ARC * (1 - np.cos(np.pi / 4 / quadrant)))
    levels = []

    def bare():
        centres = area.buffer(-task.radius, quad_segs=quadrant)
        here = centres
        levels.clear()
        while not here.is_empty:
            levels.append(here)
            here = centres.buffer(-len(levels) * task.stepover, quad_segs=quadrant)

    ours = best(lambda: rings(region, task.radius, task.stepover))
    theirs = best(bare)
    told(f"pocket, ten islands, {quadrant} a quadrant", ours, "shapely ring loop", theirs, 2, times=True)
    found = rings(region, task.radius, task.stepover)
    assert len(levels) <= len(found.passes)
    assert region.distance(np.vstack([ring.points for ring in found.passes])).min() == pytest.approx(3, abs=1e-9)

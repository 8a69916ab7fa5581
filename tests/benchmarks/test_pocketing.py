"""A pocket 100 × 80 with three islands and without, tool of 6 mm, 40 % overlap: our strategies beside two packages from PyPI.

`pytest -m benchmark -s tests/benchmarks/test_pocketing.py` prints way, processor time and covered share; no time is
asserted. The packages live in an environment of their own, whose folder MNCLAB_PEERS names (else `peers-pocket` in the
folder for temporary files); without it only ours are printed.
"""

import json
import os
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
import pytest
import shapely

from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.machining.milling.clearing import begin, end
from mnclab.machining.milling.strategies import STRATEGIES, clear

pytestmark = pytest.mark.benchmark
RADIUS, STEP = 3.0, 3.6
OUTER = rectangle(100, 80, 6, centre=(50, 40))
ISLANDS = [Contour.circle((25, 25), 9), rectangle(20, 20, centre=(70, 25)), Contour.circle((50, 58), 12)]
AREAS = {"three islands": Region.of(OUTER, holes=ISLANDS), "no island": Region.of(OUTER)}
PYTHON = Path(os.environ.get("MNCLAB_PEERS", Path(tempfile.gettempdir()) / "peers-pocket")) / "bin" / "python"


def share(ways, reach):
    return shapely.union_all(shapely.buffer(ways, RADIUS, quad_segs=64)).intersection(reach).area / reach.area


@pytest.mark.parametrize("name", AREAS)
def test_a_pocket(name):
    area = AREAS[name]
    centres = area.inset(RADIUS)
    rings = [loop.points_within(1e-3) for loop in centres.loops]
    reach = shapely.Polygon(rings[0], rings[1:]).buffer(RADIUS, quad_segs=64)
    print(f"\n{name:28s}{'passes, mm':>12s}{'links, mm':>12s}{'lifts':>7s}{'seconds':>9s}{'covered':>10s}")
    for strategy in STRATEGIES:
        start = time.process_time()
        found = clear(strategy, area, RADIUS, STEP)
        seconds = time.process_time() - start
        pairs = [
            (linked, float(np.hypot(*(begin(b) - end(a)))))
            for piece in found.pieces
            for a, b, linked in zip(piece.passes, piece.passes[1:], piece.linked, strict=False)
        ]
        linked, lifts = sum(way for ok, way in pairs if ok), sum(not ok for ok, _ in pairs)
        covered = share([shapely.LineString(contour.points_within(1e-3)) for contour in found.passes], reach)
        print(f"{strategy:28s}{found.length:12.0f}{linked:12.0f}{lifts:7d}{seconds:9.2f}{covered:10.4%}")
        assert covered > 0.999
    if not PYTHON.exists():
        pytest.skip("the peers are not installed")
    task = {"outer": rings[0].tolist(), "holes": [ring.tolist() for ring in rings[1:]], "step": STEP}
    script = Path(__file__).with_name("pocketing_peers.py")
    done = subprocess.run([PYTHON, script], input=json.dumps(task), capture_output=True, text=True, check=True)
    for row in map(json.loads, done.stdout.splitlines()):
        if "error" in row:
            print(f"{row['name']:28s}{row['error'][:80]}")
            continue
        covered = share([shapely.LineString(path) for path in row["paths"] if len(path) > 1], reach)
        print(f"{row['name']:28s}{row['length']:12.0f}{'':12s}{'':7s}{row['seconds']:9.2f}{covered:10.4%}")

"""The erosion of the height raster as a process of its own, for a comparison of processes: prints a line of JSON.

    peers.py solid 100000 --ours-dialect plain --ours 'python tests/benchmarks/material_peers.py {file}'

The program is the peers' own: lines with X, Y and Z, cut by a ball of 6 mm over 1024 x 1024 cells of 0.2 mm. It is read by
the number, as the peers' is, and not counted; what counts is from the rows of a path to the heights.
"""

import json
import re
import sys
import time

import numpy as np

from mnclab import Kind, Tool, Toolpath
from mnclab.workpiece.blank import Box
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.milled import Milled

CELL, CELLS = 0.2, 1024
WORD = re.compile(rb"X(\S+) Y(\S+) Z(\S+)")


def points(file):
    """The places of all blocks that have X, Y and Z (n, 3), moved and squeezed onto the blank as the peers do."""
    count = sum(1 for line in file if WORD.search(line))
    file.seek(0)
    found = np.empty((count, 3))
    for row, line in enumerate(words for words in map(WORD.search, file) if words):
        found[row] = line.groups()
    found[:, :2] += 2
    if found[:, 1].max() > 202:
        found[:, 1] *= 200 / found[:, 1].max()
    return found


if __name__ == "__main__":
    with open(sys.argv[1], "rb") as file:
        vertices = points(file)
    n = len(vertices) - 1
    path = Toolpath.chain(vertices, {"kind": np.full(n, Kind.LINE, np.uint8)})
    ball = Tool(radius=3, corner=3, kind="mill")
    blank = Box((0.0, 0.0, -40.0), (CELL * CELLS, CELL * CELLS, 0.0))
    wall, cpu = time.perf_counter(), time.process_time()
    part = Milled(Cutting(path, [ball], np.broadcast_to(np.int64(0), n), blank), CELL)
    heights = part.heights
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    peak = next(int(line.split()[1]) for line in open("/proc/self/status") if line.startswith("VmHWM")) / 1024
    told = {"MiB": peak, "import": 0.0, "wall": wall, "cpu": cpu, "items": n, "end": [round(float(heights.sum()) * CELL**2, 1)]}
    print("\nPEER" + json.dumps(told))

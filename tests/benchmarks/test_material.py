"""What 100,000 and a million moves leave, beside FreeCAD's simulator and a plain draft in numpy, in one run.

    python3 tests -m benchmark -s tests/benchmarks/test_material.py

A ball of 6 mm finishes a wavy surface over 1024 x 1024 cells of 0.2 mm, 0.5 mm a move. Prints processor seconds (from the
rows of a path, or its commands, to the heights), ratios and peaks; asserts only that the parts agree. FreeCAD is asked where
`freecadcmd` is on the path; without it that line is left out.
"""

import json
import math
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

pytestmark = pytest.mark.benchmark
OURS = Path(__file__).with_name("material_peers.py")
CELL, CELLS, RADIUS = 0.2, 1024, 3.0

FREECAD = """
import json, os, time
import FreeCAD, Part, Path, PathSimulator
from FreeCAD import Vector
path = Path.Path()
path.setFromGCode(open(os.environ["MATERIAL"]).read())
simulator = PathSimulator.PathSim()
simulator.BeginSimulation(Part.makeBox(204.8, 204.8, 40, Vector(-2, -2, -40)), 0.2)
simulator.SetToolShape(Part.makeCylinder(3, 20, Vector(0, 0, 3)).fuse(Part.makeSphere(3, Vector(0, 0, 3))), 0.05)
at = FreeCAD.Placement(Vector(0, 0, 25), FreeCAD.Rotation())
begin = time.process_time()
for command in path.Commands:
    at = simulator.ApplyCommand(at, command)
cpu = time.process_time() - begin
peak = next(int(line.split()[1]) for line in open("/proc/self/status") if line.startswith("VmHWM")) / 1024
print("\\nPEER" + json.dumps({"cpu": cpu, "MiB": peak}), flush=True)
os._exit(0)
"""


def surface(n):
    """Places (n + 1, 3) of passes there and back over a wavy surface, squeezed onto the blank."""
    j, along = np.divmod(np.arange(n + 1), 400)
    i = np.where(j % 2 == 0, along, 399 - along)
    x = 0.5 * i + 0.1 * np.sin(np.arange(n + 1) * 12.9898)
    z = 4 * np.sin(2 * np.pi * i / 137) + 2.5 * np.sin(2 * np.pi * j / 89) - 7
    return np.round(np.stack([x, 0.3 * j * min(1.0, 200 / max(0.3 * j.max(), 1.0)), z], axis=1), 3)


def draft(points):
    """Centres laid on the grid, then the least over the footprint of the tool, place by place."""
    begin = time.process_time()
    way = np.diff(points, axis=0)
    count = np.maximum(np.ceil(np.hypot(way[:, 0], way[:, 1]) / (CELL / 2)), 1).astype(int)
    own = np.repeat(np.arange(len(count)), count)
    share = (np.arange(len(own)) - np.repeat(np.cumsum(count) - count, count)) / count[own]
    at = points[own] + way[own] * share[:, None]
    reach = int(RADIUS / CELL)
    wide = CELLS + 2 * reach
    cell = (np.floor(at[:, 1] / CELL).astype(int) + reach) * wide + np.floor(at[:, 0] / CELL).astype(int) + reach
    centre = np.full((wide, wide), np.inf, np.float32)
    order = np.argsort(-at[:, 2], kind="stable")
    centre.ravel()[cell[order]] = at[order, 2]
    heights, near = np.zeros((CELLS, CELLS), np.float32), np.empty((CELLS, CELLS), np.float32)
    for b in range(-reach, reach + 1):
        for a in range(-reach, reach + 1):
            inside = RADIUS**2 - (a * a + b * b) * CELL**2
            if inside >= 0:
                part = centre[reach + b : reach + b + CELLS, reach + a : reach + a + CELLS]
                np.minimum(heights, np.add(part, np.float32(RADIUS - math.sqrt(inside)), out=near), out=heights)
    return time.process_time() - begin, float(heights.sum()) * CELL**2


def asked(command, **environment):
    """What a process prints about itself."""
    out = subprocess.run(command, check=True, capture_output=True, env={**os.environ, **environment}, text=True).stdout
    return json.loads(next(line for line in out.splitlines() if line.startswith("PEER"))[4:])


@pytest.mark.parametrize("moves", [100_000, 1_000_000])
def test_a_finished_surface(moves, tmp_path, told):
    file = tmp_path / "surface.nc"
    points = surface(moves)
    file.write_text("\n".join("G1 X{} Y{} Z{}".format(*point) for point in points.tolist()) + "\n")
    here = asked([sys.executable, str(OURS), str(file)], PYTHONPATH=str(Path(__file__).parents[2]))
    seconds, volume = draft(points + [2, 2, 0])
    assert here["end"][0] == pytest.approx(volume, rel=0.02)
    rows = {"mnclab": (here["cpu"], here["MiB"]), "draft in numpy": (seconds, None)}
    if freecad := shutil.which("freecadcmd"):
        script = tmp_path / "simulate.py"
        script.write_text(FREECAD)
        simulated = asked([freecad, str(script)], MATERIAL=str(file))
        rows["FreeCAD's simulator"] = simulated["cpu"], simulated["MiB"]
        told(f"removal, {moves // 1000}k moves", here["cpu"], "FreeCAD PathSim", simulated["cpu"], 2)
    print(f"\n{moves} moves{'':24s}cpu s     moves/s   to mnclab   peak MiB")
    for name, (cpu, most) in rows.items():
        memory = f"{most:11.0f}" if most else ""
        print(f"{name:30s}{cpu:9.3f}{moves / cpu:12.0f}{cpu / rows['mnclab'][0]:11.2f}x{memory}")

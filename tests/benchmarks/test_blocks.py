"""Long programs: the bulk tier beside the one-by-one tier, rs274 and a bare loop over words, in one run.

    python3 tests -m benchmark -s

Prints processor seconds and ratios, and the memory of a block; asserts only that every row was made. Three kinds of work: a
finishing pass (G1 and three axes on every block), arcs by centre, and a modal mixture (G words and axes left out where
they repeat, arcs by radius between lines, feeds).
"""

import re
import resource
import shutil
import subprocess
import time
import tracemalloc

import numpy as np
import pytest

import mnclab
from mnclab import Setup

pytestmark = pytest.mark.benchmark
ROUNDS = 5
HEAD = "G17 G90 G54\nG0 Z5\n"


def surface(n):
    """Blocks of a finishing pass: a wavy surface in lines along X."""
    k = np.arange(n)
    row, along = divmod(k, 1000)
    x = np.where(row % 2 == 0, along, 999 - along) * 0.1
    y = row * 0.2
    z = 3 * np.sin(x / 7) * np.cos(y / 11)
    lines = [f"G1 X{a:.3f} Y{b:.3f} Z{c:.3f}" for a, b, c in zip(x.tolist(), y.tolist(), z.tolist(), strict=True)]
    for i in range(0, n, 50):
        lines[i] += f" F{800 + i % 7 * 100}"
    return lines


def arcs(n):
    """Half circles of radius 5 there and back by I J, on rows 1 mm apart."""
    lines = ["G1 X0 Y0 Z-1 F500"]
    for k in range(1, n):
        side, row = k % 2, k // 1000
        along = 10.0 if side else 0.0
        if k % 1000 == 0:
            lines.append(f"G1 X{along:.3f} Y{row:.3f}")
        else:
            lines.append(f"G2 X{along:.3f} Y{row:.3f} I{5 if side else -5} J0")
    return lines


def mixture(n):
    """Lines with what repeats left out, every tenth block an arc by radius."""
    lines = ["G1 X0 Y0 Z-1 F500"]
    for k in range(1, n):
        x, y = k % 1000 * 0.25, k // 1000 * 0.5
        if k % 10 == 0 and k % 1000:
            lines.append(f"G2 X{x:.3f} Y{y:.3f} R{4 + k % 3}")
        elif k % 10 == 1 or k % 1000 == 0:
            lines.append(f"G1 X{x:.3f} Y{y:.3f}" + (f" F{500 + k % 300}" if k % 50 == 1 else ""))
        else:
            lines.append(f"X{x:.3f}" if k % 3 else f"X{x:.3f} Z{-1 - k % 7 / 10:.1f}")
    return lines


WORK = {"surface": (surface, 1_000_000), "arcs": (arcs, 200_000), "mixture": (mixture, 500_000)}


def seconds(work):
    """Processor seconds of this process and its children, wall seconds, and the result."""

    def used():
        own, children = resource.getrusage(resource.RUSAGE_SELF), resource.getrusage(resource.RUSAGE_CHILDREN)
        return own.ru_utime + own.ru_stime + children.ru_utime + children.ru_stime

    before, clock = used(), time.perf_counter()
    result = work()
    return used() - before, time.perf_counter() - clock, result


def ours(text, bulk=True):
    program = mnclab.read(text, "mnc")
    return mnclab.run(program, setup=Setup(settings={"bulk": bulk}))


def words(text):
    """What reading costs at least in plain Python: every word found and its number made."""
    position = {}
    for line in text.splitlines():
        for letter, number in re.findall(r"([A-Z])([-+.\d]+)", line):
            position[letter] = float(number)


@pytest.mark.parametrize("kind", WORK)
def test_blocks(kind, tmp_path):
    make, blocks = WORK[kind]
    text = HEAD + "\n".join(make(blocks)) + "\n"
    work = {"bulk tier": lambda: ours(text), "bare regular expressions": lambda: words(text)}
    if shutil.which("rs274"):
        file = tmp_path / "blocks.ngc"
        file.write_text("%\nG21\n" + text + "M2\n%\n")
        call = ["rs274", "-g", str(file), "/dev/null"]
        work["rs274"] = lambda: subprocess.run(call, check=True, capture_output=True, cwd=tmp_path)
    ours(text)  # numpy warm, as in a notebook
    rounds = {name: [seconds(do)[:2] for _ in range(ROUNDS)] for name, do in work.items()}
    one_by_one = seconds(lambda: ours(text, bulk=False))
    rounds["one by one"] = [one_by_one[:2]]
    tracemalloc.start()
    run = ours(text)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    for found in (run, one_by_one[2]):
        assert found.ok, found.alarms[:1]
        assert len(found.toolpath) >= blocks - 1

    middle = {name: np.median(times, axis=0) for name, times in rounds.items()}
    print(
        f"\n{kind}: {blocks} blocks, {len(text) / 1e6:.0f} MB, median of {ROUNDS} rounds; {peak / blocks:.0f} bytes a block"
    )
    print(f"{'':26s}{'cpu s':>8s}{'wall s':>8s}{'blocks/s':>12s}{'bulk is':>9s}")
    for name, (cpu, wall) in middle.items():
        print(f"{name:26s}{cpu:8.2f}{wall:8.2f}{blocks / cpu:12.0f}{cpu / middle['bulk tier'][0]:8.1f}x")

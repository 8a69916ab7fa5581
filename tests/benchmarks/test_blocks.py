"""A million plain blocks: the bulk tier beside the one-by-one tier, rs274 and a bare loop over words, in one run.

    python3 tests -m benchmark -s

Prints processor seconds and ratios; asserts only that every row was made. The part is a raster of a curved surface, an axis
word for each axis on every block and a feed now and then, as CAM systems write finishing passes.
"""

import re
import resource
import shutil
import subprocess
import time

import numpy as np
import pytest

import mnclab
from mnclab import Setup

pytestmark = pytest.mark.benchmark
BLOCKS, ROUNDS = 1_000_000, 3


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


def seconds(work):
    """Processor seconds of this process and its children, wall seconds, and the result."""

    def used():
        own, children = resource.getrusage(resource.RUSAGE_SELF), resource.getrusage(resource.RUSAGE_CHILDREN)
        return own.ru_utime + own.ru_stime + children.ru_utime + children.ru_stime

    before, clock = used(), time.perf_counter()
    result = work()
    return used() - before, time.perf_counter() - clock, result


def test_a_million_blocks(tmp_path):
    lines = surface(BLOCKS)
    text = "\n".join(["G17 G90 G54", "G0 Z5", *lines]) + "\n"

    def ours(bulk):
        program = mnclab.read(text, "mnc")
        return mnclab.run(program, setup=Setup(settings={"bulk": bulk}))

    def words():
        position = {}
        for line in text.splitlines():
            for letter, number in re.findall(r"([A-Z])([-+.\d]+)", line):
                position[letter] = float(number)

    work = {"bulk tier": lambda: ours(True), "bare regular expressions": words}
    if shutil.which("rs274"):
        file = tmp_path / "surface.ngc"
        file.write_text("%\nG21\n" + text + "M2\n%\n")
        call = ["rs274", "-g", str(file), "/dev/null"]
        work["rs274"] = lambda: subprocess.run(call, check=True, capture_output=True, cwd=tmp_path)
    ours(True)  # numpy warm, as in a notebook
    rounds = {name: [seconds(do)[:2] for _ in range(ROUNDS)] for name, do in work.items()}
    one_by_one = seconds(lambda: ours(False))
    rounds["one by one"] = [one_by_one[:2]]
    for run in (ours(True), one_by_one[2]):
        assert run.ok and len(run.toolpath) == BLOCKS + 1

    middle = {name: np.median(times, axis=0) for name, times in rounds.items()}
    print(f"\n{BLOCKS} blocks, {len(text) / 1e6:.0f} MB, median of {ROUNDS} rounds")
    print(f"{'':26s}{'cpu s':>8s}{'wall s':>8s}{'blocks/s':>12s}{'bulk is':>9s}")
    for name, (cpu, wall) in middle.items():
        print(f"{name:26s}{cpu:8.2f}{wall:8.2f}{BLOCKS / cpu:12.0f}{cpu / middle['bulk tier'][0]:8.1f}x")

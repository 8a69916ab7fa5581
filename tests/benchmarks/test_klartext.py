"""A million straight lines of a conversational program beside the same lines of an MNC program, in one run.

    python3 tests -m benchmark -s

Prints processor seconds and the ratio of the rates; asserts only that every row was made.
"""

import time

import numpy as np
import pytest

import mnclab

pytestmark = pytest.mark.benchmark
LINES, ROUNDS = 1_000_000, 5


def surface():
    """Words of a finishing pass: a wavy surface in lines along X, now and then a feed."""
    row, along = divmod(np.arange(LINES), 1000)
    x = np.where(row % 2 == 0, along, 999 - along) * 0.1
    y = row * 0.2
    z = 3 * np.sin(x / 7) * np.cos(y / 11)
    words = [f"X{a:.3f} Y{b:.3f} Z{c:.3f}" for a, b, c in zip(x.tolist(), y.tolist(), z.tolist(), strict=True)]
    words[::50] = [f"{line} F{800 + k % 7 * 100}" for k, line in enumerate(words[::50])]
    return words


def test_klartext():
    words = surface()
    blocks = ["BEGIN PGM A MM", "TOOL CALL 1 Z S1000 F800", *(f"L {line}" for line in words), "END PGM A MM"]
    texts = {
        "MNC": ("G17 G90 G54\nG0 Z5\n" + "".join(f"G1 {line}\n" for line in words), "mnc"),
        "Klartext": ("".join(f"{block}\n" for block in blocks), "tnc-620"),
        "Klartext, numbered": ("".join(f"{k} {block}\n" for k, block in enumerate(blocks)), "tnc-620"),
    }
    used = {name: [] for name in texts}
    for _ in range(ROUNDS + 1):  # the first one warms up
        for name, (text, control) in texts.items():
            begin = time.process_time()
            run = mnclab.run(mnclab.read(text, control))
            used[name].append(time.process_time() - begin)
            assert run.ok and len(run.toolpath.motion) >= LINES - 1, run.alarms[:1]
            del run
    middle = {name: np.median(times[1:]) for name, times in used.items()}
    print(f"\n{LINES} lines, median of {ROUNDS} rounds")
    for name, cpu in middle.items():
        print(f"{name:20s}{cpu:8.2f} s{LINES / cpu:12.0f} blocks/s{middle['MNC'] / cpu:8.0%} of the rate of MNC")

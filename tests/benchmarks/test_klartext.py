"""A million straight lines of a conversational program beside the same lines of an MNC program, in one run, and look-ahead.

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


def test_look_ahead():
    """The same contour with RL, for which the whole of it is looked at, and with R0: a wavy line, 0.4 mm from point to point."""
    count, used = 20_000, {"R0": [], "RL": []}
    x = 0.4 * np.arange(count)
    way = [f"L X{a:+.3f} Y{b:+.3f}" for a, b in zip(x.tolist(), (6 * np.sin(x / 30)).tolist(), strict=True)]
    head = ["BEGIN PGM A MM", "TOOL CALL 1 Z S1000 F800", "L X-20 Y+0 Z-2 R0 FMAX M3"]
    setup = mnclab.Setup(tools={1: mnclab.Tool(radius=3, number=1)})
    for _ in range(ROUNDS + 1):
        for side, times in used.items():
            text = "".join(f"{block}\n" for block in [*head, f"{way[0]} {side}", *way[1:], "L Y+40 R0", "END PGM A MM"])
            begin = time.process_time()
            run = mnclab.run(mnclab.read(text, "tnc-620"), setup=setup)
            times.append(time.process_time() - begin)
            assert run.ok and not run.gouges and len(run.toolpath.motion) > count, run.alarms[:1]
    plain, ahead = (float(np.median(times[1:])) for times in used.values())
    print(f"\n{count} lines, median of {ROUNDS} rounds: R0 {plain:.2f} s, RL {ahead:.2f} s, {ahead / plain:.1f} times as long")

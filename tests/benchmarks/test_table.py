"""The table of what is to be held: ratios to other programs in one run.

    python3 tests -m benchmark -k table

Each row does the same work here and there, in turn, and asserts that it was done; no time is asserted. A peer that is not
installed leaves its row out.
"""

import subprocess
import sys

import numpy as np
import pytest
from tools.measuring import in_turn

import mnclab
from mnclab import Setup, Tool

pytestmark = pytest.mark.benchmark
HEAD = "G21 G17 G90 G94 G54\nS12000 M3\nG0 Z20\nG0 X0 Y0\n"
CYCLES = "G81", "G82 P0.2", "G83 Q1.5"
DRILLING = "CYCL DEF 200 D\nQ200=2\nQ201=-15\nQ206=250\nQ202=5\nQ210=0\nQ203=0\nQ204=20\nQ211=0.1\n"
TOOLS = {1: Tool(radius=3, number=1), 2: Tool(radius=3, number=2)}


def surface(count):
    """Words X Y Z of a finished surface, row by row."""
    u, v = np.arange(count) % 1000, np.arange(count) // 1000
    x, y = 0.2 * np.where(v % 2, 999 - u, u), 0.3 * v
    z = 4 * np.sin(x / 17) * np.cos(y / 23)
    return [f"X{a:.3f} Y{b:.3f} Z{c:.3f}" for a, b, c in zip(x.tolist(), y.tolist(), z.tolist(), strict=True)]


def wave(count):
    """Words X Y of a wave of 0.4 mm from point to point, gentle enough for a tool of 6 mm."""
    x = 0.4 * np.arange(count)
    return [f"X{a:.3f} Y{b:.3f}" for a, b in zip(x.tolist(), (6 * np.sin(x / 30)).tolist(), strict=True)]


def places(count):
    return [(4 * (k % 250), 4 * (k // 250)) for k in range(count)]


def mixture(count):
    """Lines with what repeats left out, every tenth block an arc by radius."""
    x, y = (np.arange(count) % 1000 * 0.25).tolist(), (np.arange(count) // 1000 * 0.5).tolist()
    lines = [f"X{x[k]:.3f}" if k % 3 else f"X{x[k]:.3f} Z{-1 - k % 7 / 10:.1f}" for k in range(count)]
    for k in range(0, count, 10):
        lines[k] = f"G2 X{x[k]:.3f} Y{y[k]:.3f} R{4 + k % 3}" if k % 1000 else f"G1 X0 Y{y[k]:.3f}"
        lines[k + 1] = f"G1 X{x[k + 1]:.3f} Y{y[k]:.3f}" + (f" F{500 + k % 300}" if k % 50 == 0 else "")
    return lines


def iso(text, moves, control="g43", **settings):
    """Reads and runs a text on a mill."""

    def work():
        run = mnclab.run(text, control, Setup(tools=TOOLS, settings=settings))
        assert run.ok and len(run.toolpath) >= moves, run.alarms[:1]

    return work


def klartext(blocks, moves, **settings):
    text = "\n".join(["BEGIN PGM A MM", "TOOL CALL 2 Z S1000 F800", "L Z+20 R0 FMAX M3", *blocks, "END PGM A MM"])

    def work():
        run = mnclab.run(text, "tnc-620", Setup(tools=TOOLS, settings={"most_rows": 20_000_000, **settings}))
        assert run.ok and len(run.toolpath) >= moves, run.alarms[:1]

    return work


def test_a_million_plain_blocks(rs274, told):
    words = surface(1_000_000)
    text = HEAD + "G1 F800 X0 Y0\n" + "".join(f"G1 {line}\n" for line in words)
    ours, lines, peer = in_turn(
        iso(text, 999_000), klartext([f"L {line}" for line in words], 999_000), rs274("plain", text + "M2\n"), rounds=3
    )
    told("1M plain blocks, ISO mill", ours, "rs274", peer, 9)
    told("1M L, Klartext", lines, "ISO mill, G1", ours, 0.85)


def test_mixed_blocks(rs274, told):
    text = "G17 G90 G54\nG0 Z5\n" + "G1 X0 Y0 Z-1 F500\n" + "\n".join(mixture(500_000)) + "\n"
    ours, peer = in_turn(iso(text, 499_000, "mnc"), rs274("mixed", "G21\n" + text + "M2\n"), rounds=3)
    told("500k mixed blocks, MNC", ours, "rs274", peer, 8)


def test_one_by_one(rs274, told):
    words = surface(100_000)
    text = "G17 G90 G54\nG0 Z5\nG1 X0 Y0 Z-1 F500\n" + "".join(f"G1 {line}\n" for line in words)
    works = [iso(text, 99_000, name, bulk=False) for name in ("g43", "mnc")]
    works.append(klartext([f"L {line}" for line in words], 99_000, bulk=False))
    *ours, peer = in_turn(*works, rs274("single", "G21\n" + text + "M2\n"), rounds=3)
    for name, time in zip(("ISO mill", "MNC", "Klartext"), ours, strict=True):
        told(f"100k blocks one by one, {name}", time, "rs274", peer, 0.6)


@pytest.mark.parametrize(("count", "held"), [(10_000, 2), (100_000, 0.5)])
def test_edit_to_picture(rs274, told, count, held):
    """A new number somewhere in a program that is there already: the new picture."""
    text, edits = HEAD + "G1 F800 X0 Y0\n" + "".join(f"G1 {line}\n" for line in surface(count)), iter(range(1, 100))

    def edited():
        run = mnclab.run(text.replace("F800", f"F{800 + next(edits)}"), "g43", Setup(tools=TOOLS))
        assert len(run.plot().png()) > 10_000

    ours, peer = in_turn(edited, rs274("edited", text + "M2\n"))
    told(f"edit to new picture, {count // 1000}k blocks", ours, "rs274", peer, held, times=True)


def test_arcs(rs274, told):
    turns = [f"G2 X{x} Y0 I5" if x % 20 else f"G3 X{x} Y0 I5" for x in range(10, 1_000_010, 10)]
    text = HEAD + "G1 Z-1 F500\n" + "\n".join(turns) + "\n"
    ours, peer = in_turn(iso(text, 100_000), rs274("arcs", text + "M2\n"))
    told("100k arcs", ours, "rs274", peer, 6)


def test_holes(rs274, told):
    lines = [f"X{x} Y{y}" for x, y in places(100_000)]
    for k in range(0, len(lines), 100):
        cycle = f"G99 {CYCLES[k // 100 % 3]} {lines[k]} Z{-3 - k // 100 % 12 / 2} R2 F150"
        lines[k] = f"G80\n{cycle}" if k else cycle
    text = HEAD + "\n".join(lines) + "\nG80\n"
    one_by_one = klartext([DRILLING, *(f"L X{x:+d} Y{y:+d} FMAX M99" for x, y in places(100_000))], 1_000_000)
    grid = "PATTERN DEF PAT1 (X+0 Y+0 DX+4 DY+4 NUMX250 NUMY400 ROT+0 ROTX+0 ROTY+0 Z+0)\nCYCL CALL PAT FMAX"
    pattern = klartext([DRILLING, grid], 1_000_000)
    ours, called, repeated, peer = in_turn(iso(text, 400_000), one_by_one, pattern, rs274("holes", text + "M2\n"))
    told("100k holes in groups of 100, ISO mill", ours, "rs274", peer, 8)
    told("100k holes by L … M99", called, "rs274", peer, 4)
    told("100k holes by PATTERN DEF", repeated, "rs274", peer, 10)


def test_compensated_blocks(rs274, told):
    first, *others = wave(100_000)
    text = HEAD + f"G0 X-20\nG1 Z-2 F500\nG41 D1 {first}\n" + "".join(f"G1 {line}\n" for line in others) + "G40 Y40\n"
    blocks = ["L X-20 Y+0 Z-2 FMAX", f"L {first} RL", *(f"L {line}" for line in others), "L Y+40 R0"]
    ours, lines, peer = in_turn(iso(text, 100_000), klartext(blocks, 100_000), rs274("side", text + "M2\n"))
    told("100k blocks under G41", ours, "rs274", peer, 4)
    told("100k blocks under RL", lines, "rs274", peer, 3)


def test_import(told):
    def opened(name):
        return lambda: subprocess.run([sys.executable, "-c", f"import {name}"], check=True)

    ours, peer = in_turn(opened("mnclab"), opened("numpy"), rounds=9)
    told("import mnclab", ours, "numpy", peer, 1.3, times=True)


def test_start_to_the_first_picture(rs274, told, tmp_path):
    text = HEAD + "G1 F800 X0 Y0\n" + "".join(f"G1 {line}\n" for line in surface(100_000))
    interpret, (path, picture) = rs274("first", text + "M2\n"), (tmp_path / name for name in ("first.nc", "first.png"))
    path.write_text(text)
    code = f"import mnclab; mnclab.run({str(path)!r}, 'g43').plot().save({str(picture)!r})"
    ours, peer = in_turn(lambda: subprocess.run([sys.executable, "-c", code], check=True), interpret)
    assert picture.stat().st_size > 10_000
    told("start to the first picture, 100k blocks", ours, "rs274", peer, 1, times=True)

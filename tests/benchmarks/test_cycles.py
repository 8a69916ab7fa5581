"""Holes under a modal cycle, expanded to moves: the pattern tier beside the one-by-one tier and rs274, in one run.

    python3 tests -m benchmark -s -k cycles

Prints processor seconds and ratios; asserts only that every hole was made. The same holes in both languages: G83 of MNC
without K is G81 of rs274, with K it is G83 with Q; rs274 returns to R (G99) and writes its moves to nothing.
"""

import shutil
import subprocess

import numpy as np
import pytest
from tools.measuring import seconds

import mnclab
from mnclab import Kind, Setup

pytestmark = pytest.mark.benchmark
HOLES, ROUNDS = 100_000, 5

#: Name: the cycle in MNC, what each later hole adds there, the cycle in rs274.
WORK = {
    "drilling, one pass": ("G99 G83 X0 Y0 Z-10 R2 F100", "", "G99 G81 X0 Y0 Z-10 R2 F100"),
    "four pecks": ("G99 G83 X0 Y0 Z-10 R2 K3 F100", " K3", "G99 G83 X0 Y0 Z-10 R2 Q3 F100"),
    "boring": ("G99 G85 X0 Y0 Z-10 R2 F100", "", "G99 G85 X0 Y0 Z-10 R2 F100"),
}


def places(n, tail):
    return "".join(f"X{k % 300 * 2} Y{k // 300 * 2}{tail}\n" for k in range(1, n))


def ours(text, bulk=True):
    """Reading and running, from the text to the moves."""
    return mnclab.run(mnclab.read(text, "mnc"), setup=Setup(settings={"bulk": bulk}))


@pytest.mark.parametrize("kind", WORK)
def test_cycles(kind, tmp_path):
    cycle, tail, theirs = WORK[kind]
    head = "G17 G90 G54\nT2 S1000 M3\nG0 X5 Y5 Z20\n"
    text = f"{head}{cycle}\n{places(HOLES, tail)}G80\n"
    tenth = f"{head}{cycle}\n{places(HOLES // 10, tail)}G80\n"
    work = {"pattern": lambda: ours(text)}
    if shutil.which("rs274"):
        file = tmp_path / "holes.ngc"
        file.write_text(f"%\nG21 G17 G90\nS1000 M3\nG0 X5 Y5 Z20\n{theirs}\n{places(HOLES, '')}G80\nM2\n%\n")
        work["rs274"] = lambda: subprocess.run(
            ["rs274", "-g", str(file), "/dev/null"], check=True, capture_output=True, cwd=tmp_path
        )
    ours(text)  # numpy warm, as in a notebook
    rounds = {name: [seconds(do)[:2] for _ in range(ROUNDS)] for name, do in work.items()}
    cpu, wall, run = seconds(lambda: ours(tenth, bulk=False))
    rounds["one by one, a tenth times ten"] = [(10 * cpu, 10 * wall)]
    found = ours(text)
    for result, holes in ((found, HOLES), (run, HOLES // 10)):
        assert result.ok, result.alarms[:1]
        assert (result.toolpath.end[result.toolpath.kind == Kind.LINE, 2] == -10).sum() == holes

    middle = {name: np.median(times, axis=0) for name, times in rounds.items()}
    print(f"\n{kind}: {HOLES} holes, {len(found.toolpath)} rows, median of {ROUNDS} rounds")
    print(f"{'':32s}{'cpu s':>8s}{'wall s':>8s}{'holes/s':>12s}{'pattern is':>12s}")
    for name, (cpu, wall) in middle.items():
        print(f"{name:32s}{cpu:8.2f}{wall:8.2f}{HOLES / cpu:12.0f}{cpu / middle['pattern'][0]:11.1f}x")


def test_pattern_of_points(monkeypatch):
    """CYCL CALL PAT of the TNC 620 over a grid of holes: rows repeated as columns, and each hole one by one."""
    cycle = "CYCL DEF 200 D\nQ200=2\nQ201=-15\nQ206=250\nQ202=5\nQ210=0\nQ203=0\nQ204=20\nQ211=0.1\n"
    grid = "PATTERN DEF PAT1 (X+0 Y+0 DX+1 DY+1 NUMX{} NUMY100 ROT+0 ROTX+0 ROTY+0 Z+0)\nCYCL CALL PAT FMAX M3\n"
    text = f"BEGIN PGM P MM\nTOOL CALL 2 Z S1000\n{cycle}{grid.format(HOLES // 100)}END PGM P MM\n"
    tenth = text.replace(f"NUMX{HOLES // 100}", f"NUMX{HOLES // 1000}")
    many = mnclab.Setup(settings={"most_rows": 20 * HOLES})
    columns, _, run = seconds(lambda: mnclab.run(text, "tnc-620", setup=many))
    assert run.ok and (run.toolpath.kind == Kind.LINE).sum() == 3 * HOLES
    monkeypatch.setattr("mnclab.running.repeating.FEWEST", HOLES)
    single, _, run = seconds(lambda: mnclab.run(tenth, "tnc-620"))
    assert (run.toolpath.kind == Kind.LINE).sum() == 3 * HOLES // 10
    print(f"\n{HOLES} holes of a pattern: {columns:.2f} s; one by one {10 * single / columns:.0f} times as long")

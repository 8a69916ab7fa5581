"""Plain lines obeyed at once and one by one: the same rows, alarms, history and final state."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mnclab as mnc
from mnclab.path.toolpath import COLUMNS

pytestmark = pytest.mark.deep

NUMBERS = st.sampled_from(["+0", "-1", "2.5", "+10.125", "-.5", "7.", "+3.1415926535"])
WORDS = st.tuples(
    st.sampled_from(["", "X"]), NUMBERS, st.sampled_from(["", "Y"]), NUMBERS, st.sampled_from(["", "Z"]), NUMBERS,
    st.sampled_from([""] * 8 + ["F100", "F250", "R0"]),
)  # fmt: skip
RARE = st.sampled_from([
    "RND R0.1", "L X+3 FMAX", "L X-4 F0", "L IX+1 RL", "L X-3 RR F80", "L IX+1 R0", "CALL LBL 1", "Q1 = 3", "L Y-Q1 R0",
    "; remark", "L",
])  # fmt: skip
HEADS = ("", "CYCL DEF 7.0 S\nCYCL DEF 7.1 X+12.5\nCYCL DEF 7.2 IY-3\n", "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+33\n")


def line(words: tuple[str, ...]) -> str:
    pairs = [a + n for a, n in zip(words[0:6:2], words[1:6:2], strict=True) if a]
    return "7 L " + " ".join([*pairs, words[6]])


@settings(max_examples=60, deadline=None)
@given(
    head=st.sampled_from(HEADS),
    runs=st.lists(st.tuples(st.lists(WORDS, min_size=35, max_size=80), RARE), min_size=1, max_size=4),
    unit=st.sampled_from(["MM", "INCH"]),
)
def test_both_tiers_agree(head: str, runs: list[tuple[list[tuple[str, ...]], str]], unit: str) -> None:
    blocks = "\n".join("\n".join([*map(line, plain), rare]) for plain, rare in runs)
    text = f"0 BEGIN PGM A {unit}\nTOOL CALL 1 Z S1000 F500\n{head}{blocks}\nM2\nLBL 1\nL IX+1 F40\nLBL 0\n"
    assert_same(text)


def assert_same(text: str) -> mnc.Run:
    fast, slow = (mnc.run(text, "tnc-620", mnc.Setup(settings={"bulk": bulk})) for bulk in (True, False))
    assert list(map(str, fast.alarms)) == list(map(str, slow.alarms))
    for name in COLUMNS:
        one, other = getattr(fast.toolpath, name), getattr(slow.toolpath, name)
        assert one.shape == other.shape, name
        assert np.array_equal(one, other, equal_nan=one.dtype.kind == "f"), name
    assert set(fast.history) == set(slow.history)
    for name in fast.history:
        assert list(map(str, map(np.asarray, fast.history[name]))) == list(
            map(str, map(np.asarray, slow.history[name]))
        ), name
    assert fast.variables == slow.variables and np.array_equal(fast.steps.block, slow.steps.block)
    return fast


@pytest.mark.parametrize("side", ["RL", "RR"])
def test_a_contour_along_plain_lines_ends_at_its_r0(side: str) -> None:
    """A wave, whose second half says R0 in each block: those are beside no contour."""
    x = np.arange(200) * 0.5
    ways = [f"L X{a:+.3f} Y{b:+.3f}" for a, b in zip(x, 20 * np.sin(x / 25), strict=True)]
    blocks = [f"{ways[0]} {side} F200", *ways[1:100], *(f"{way} R0" for way in ways[100:150]), *ways[150:]]
    run = assert_same("\n".join(["BEGIN PGM A MM", "TOOL CALL 1 Z S1000 F500", "L X-10 Y+0 R0 F100", *blocks]))
    moved = run.toolpath.motion
    assert run.ok and (moved.side != 0).sum() >= 100
    assert np.array_equal(moved.end[-100:, 0], x[100:].round(3)), "beside no contour the tool is on the programmed place"


def test_plain_lines_are_obeyed_in_bulk() -> None:
    text = "TOOL CALL 1 Z F100\n" + "\n".join(f"{k} L X+{k}.5 Y-{k} R0" for k in range(1, 500)) + "\n"
    program = mnc.read(text, "tnc-620")
    assert program.plain.sum() == 499
    run = mnc.run(program)
    assert run.ok and run.toolpath.end[-1].tolist() == [499.5, -499, 0]

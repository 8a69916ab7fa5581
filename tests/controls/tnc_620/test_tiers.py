"""Plain lines obeyed at once and one by one: the same rows, alarms, history and final state."""

from __future__ import annotations

from typing import Any

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
    st.sampled_from([""] * 8 + ["F100", "F250", "R0", "FMAX", "FMAX"]),
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


def assert_same(text: str, within: float = 0, **given: Any) -> mnc.Run:
    fast, slow = (mnc.run(text, "tnc-620", mnc.Setup(settings={"bulk": bulk}, **given)) for bulk in (True, False))
    assert list(map(str, fast.alarms)) == list(map(str, slow.alarms))
    for name in COLUMNS:
        one, other = getattr(fast.toolpath, name), getattr(slow.toolpath, name)
        assert one.shape == other.shape, name
        assert np.allclose(one, other, rtol=0, atol=within, equal_nan=one.dtype.kind == "f"), name
    assert set(fast.history) == set(slow.history)
    for name in fast.history:
        for one, other in zip(map(np.asarray, fast.history[name]), map(np.asarray, slow.history[name]), strict=True):
            if one.dtype.kind == "f":
                assert one.shape == other.shape and np.allclose(one, other, rtol=0, atol=within, equal_nan=True), name
            else:
                assert str(one.tolist()) == str(other.tolist()), name
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


HEAD = "BEGIN PGM A MM\nTOOL CALL 2 Z S1000 F300\n{frame}{cycle}\nL Z+100 R0 FMAX M3\n"
CYCLES = {  # each leaves the tool at Q204 over the surface
    "drilling": "CYCL DEF 200 D\nQ200=2\nQ201=-15\nQ206=250\nQ202=5\nQ210=0.1\nQ203=0\nQ204=20\nQ211=0.2",
    "reaming": "CYCL DEF 201 R\nQ200=2\nQ201=-15\nQ206=100\nQ211=0.5\nQ208=250\nQ203=0\nQ204=20",
    "boring": "CYCL DEF 202 B\nQ200=2\nQ201=-15\nQ206=100\nQ211=0.5\nQ208=250\nQ203=0\nQ204=20\nQ214=1\nQ336=0",
    "universal": "CYCL DEF 203 U\nQ200=2\nQ201=-15\nQ206=150\nQ202=5\nQ210=0\nQ203=0\nQ204=20\nQ212=0.5\nQ213=2\n"
    "Q205=1\nQ211=0.1\nQ208=500\nQ256=0.2",
    "tapping": "CYCL DEF 207 T\nQ200=2\nQ201=-15\nQ239=1\nQ203=0\nQ204=20",
    "bore milling": "CYCL DEF 208 B\nQ200=2\nQ201=-15\nQ206=150\nQ334=1\nQ203=0\nQ204=20\nQ335=20\nQ342=0\nQ351=1",
    "pocket": "CYCL DEF 252 P\nQ215=0\nQ223=12\nQ368=0\nQ207=500\nQ351=1\nQ201=-4\nQ202=2\nQ369=0\nQ206=150\n"
    "Q338=0\nQ200=2\nQ203=0\nQ204=20\nQ370=1\nQ366=0\nQ385=500",
    "program": "Q5 = 0\nCYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM SUB",
}
ENDS = {
    "the same": "{x} {y} R0 FMAX M99", "without R0": "{x} {y} FMAX M99", "one axis": "{x} FMAX M99", "a feed": "{x} {y} F400 M99",
    "a height": "{x} {y} Z+20 FMAX M99", "modal feed": "{x} {y} R0 M99",
}  # fmt: skip


@pytest.mark.parametrize("cycle", CYCLES)
@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("frame", HEADS)
def test_a_cycle_called_at_many_places(cycle: str, end: str, frame: str) -> None:
    """Forty places, one that is said twice, one without a call, a block of another kind, a faulty one at the end."""
    places = [(3.25 * (k % 7) - 2, 4.5 * (k // 7)) for k in range(80)]
    blocks = ["L " + ENDS[end].format(x=f"X{x:+.3f}", y=f"Y{y:+.3f}") for x, y in places]
    blocks[40:40] = [blocks[39], "L X+1 Y+2 FMAX", "Q1 = 7", "L Y+Q1 FMAX M99"]
    text = HEAD.format(frame=frame, cycle=CYCLES[cycle]) + "\n".join([*blocks, "L X+1 Y+1 FMAX M99 M99"])
    files = {"SUB.h": "BEGIN PGM SUB MM\nQ5 = Q5 + 1\nL IZ-20 F200\nL IZ+20 FMAX\nEND PGM SUB MM\n"}
    run = assert_same(text, within=1e-12, files=files, tools={2: mnc.Tool(radius=5, number=2, length=100)})
    assert len(run.toolpath) > 2 * len(places) and [alarm.severity for alarm in run.alarms][-1:] == ["alarm"]


@pytest.mark.parametrize("line", [
    "L X5FMAX", "L X5 FMAXM99", "L FMAX X5", "L X5 R0FMAX", "L X5 F100FMAX", "L X5 FMAX F100", "L X5 M99 R0", "L M99", "L FMAX",
    "L R0 FMAX M99", "L X1 K000", "L X1 FMAX5", "L X1 FMAX 5", "L X1 M099", "L X1 M+99", "L X1 M99.0", "L X1 M98", "L X1 fmax",
    "L X1 FMAXA", "L X1 FMAX,", "L X1 FMAX\tM99", "L M99 M99", "L FMAX FMAX", "L Y-3.5 FMAX M99 ", "12 L Y-3.5 FMAX M99",
])  # fmt: skip
def test_a_line_with_fmax_or_m99_is_read_as_any_other(line: str) -> None:
    """The slash of a skipped block leads to the other reader."""
    for unit in ("MM", "INCH"):
        found = []
        for mark in ("", "/"):
            program = mnc.read(f"BEGIN PGM A {unit}\n{mark}{line}", "tnc-620")
            a, b = program.first[1:3]
            words = [(program.addresses[program.address[k]], program.value[k], program.form[k]) for k in range(a, b)]
            found.append((words, [(alarm.message, alarm.hint) for alarm in program.alarms]))
        assert found[0] == found[1]


def test_plain_lines_are_obeyed_in_bulk() -> None:
    text = "TOOL CALL 1 Z F100\n" + "\n".join(f"{k} L X+{k}.5 Y-{k} R0" for k in range(1, 500)) + "\n"
    program = mnc.read(text, "tnc-620")
    assert program.plain.sum() == 499
    run = mnc.run(program)
    assert run.ok and run.toolpath.end[-1].tolist() == [499.5, -499, 0]

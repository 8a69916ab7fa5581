"""The bulk tier against the one-by-one tier, which is the definition: rows, alarms, history and final state."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Setup
from mnclab.machine.bulk import SHORTEST
from mnclab.path.toolpath import COLUMNS

HEAD = "G17 G90 G54 T1\nG92 X3 Y-2.5\nG1 X0 Y0 Z0 F100\n"


def both(text, control="mnc", **settings):
    """The same program through both tiers."""
    datums = {1: (10.5, -20.25, 3)}
    return [
        mnclab.run(text, control, Setup(datums=datums, settings={**settings, "bulk": bulk})) for bulk in (True, False)
    ]


def assert_equal(bulk, single):
    assert [str(a) for a in bulk.alarms] == [str(a) for a in single.alarms]
    assert len(bulk.toolpath) == len(single.toolpath)
    for name in COLUMNS:
        left, right = getattr(bulk.toolpath, name), getattr(single.toolpath, name)
        assert np.allclose(left, right, rtol=0, atol=1e-12, equal_nan=True), name
    assert np.array_equal(bulk.steps.block, single.steps.block)
    assert set(bulk.history) == set(single.history)
    for name in single.history:
        for step in range(len(single.steps.block)):
            left, right = bulk.history.value(name, step), single.history.value(name, step)
            assert left == right or np.allclose(left, right, rtol=0, atol=1e-12), (name, step)
            assert (name in bulk.history.changes(step)) == (name in single.history.changes(step)), (name, step)


number = st.integers(-20_000, 20_000).map(lambda n: f"{n / 1000:g}")
axis_words = st.lists(st.tuples(st.sampled_from("XYZ"), number), max_size=3, unique_by=lambda w: w[0])
feed = st.sampled_from(["", "", "", "", " F200", " F75.5", " F0"])
motion = st.sampled_from(["", "", "G0 ", "G1 ", "G01 "])
plain = st.tuples(motion, axis_words, feed).map(lambda t: t[0] + " ".join(a + v for a, v in t[1]) + t[2])
arc = st.tuples(st.sampled_from(["G2", "G3"]), number, number, st.sampled_from(["R25", "R-40", "I5", "I3 J4", "R2", "J1 K1", ""])).map(
    lambda t: f"{t[0]} X{t[1]} Y{t[2]} {t[3]}"
)
full = st.sampled_from(["G3 I5", "G2 J-4", "G2 I3 J-4 F150"])
odd = st.sampled_from(["G91", "G90", "G54", "G92 X1", "M3 S100", "X1 X2", "G1 I5", "U3", "(", "X1,5", "", "// remark", "N5"])


@given(st.lists(st.one_of(plain, plain, plain, arc, full), min_size=2 * SHORTEST, max_size=90), st.booleans())
def test_runs_of_plain_blocks(blocks, incremental):
    text = HEAD + ("G91\n" if incremental else "") + "\n".join(blocks) + "\n"
    assert_equal(*both(text))


@given(st.lists(st.one_of(*[plain] * 12, arc, odd), min_size=2 * SHORTEST, max_size=120))
def test_runs_with_other_blocks_between(blocks):
    assert_equal(*both(HEAD + "\n".join(blocks) + "\n"))


def test_a_long_run_is_really_obeyed_in_bulk():
    """10 000 blocks of a helix of lines; the flow counts what went one by one."""
    angle = np.arange(10_000) / 50
    lines = [f"X{20 * np.cos(a):.3f} Y{20 * np.sin(a):.3f} Z{-a / 10:.4f}" for a in angle]
    program = mnclab.read(HEAD + "\n".join(lines) + "\n", "mnc")
    from mnclab.machine.interpreter import Interpreter
    from mnclab.machine.machine import Machine

    machine = Machine(mnclab.controls["mnc"], Setup())
    Interpreter(mnclab.controls["mnc"], machine, program).run()
    assert machine.flow.executed < 100
    assert_equal(*both(HEAD + "\n".join(lines[:500]) + "\n"))


@pytest.mark.parametrize("fault", ["G2 X1 Y1 R0.1", "X1 F-1", "G1 R5", "X1 W2", "G5"])
def test_a_fault_in_a_run_is_worded_by_the_other_tier(fault):
    blocks = [f"X{k}" for k in range(100)]
    blocks[70] = fault
    bulk, single = both(HEAD + "\n".join(blocks) + "\n")
    assert_equal(bulk, single)
    assert not bulk.ok and bulk.alarms[0].span.line == 74
    assert bulk.toolpath.line.max() == 73

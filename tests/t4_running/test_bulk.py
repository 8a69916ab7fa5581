"""The bulk tier against the one-by-one tier, which is the definition: rows, alarms, history and final state."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab.running.bulk import SHORTEST
from mnclab.running.interpreter import Interpreter

HEAD = "G17 G90 G54 T1\nG92 X3 Y-2.5\nG1 X0 Y0 Z0 F100\n"


number = st.integers(-20_000, 20_000).map(lambda n: f"{n / 1000:g}")
axis_words = st.lists(st.tuples(st.sampled_from("XYZ"), number), max_size=3, unique_by=lambda w: w[0])
feed = st.sampled_from(["", "", "", "", " F200", " F75.5", " F0"])
motion = st.sampled_from(["", "", "G0 ", "G1 ", "G01 "])
plain = st.tuples(motion, axis_words, feed).map(lambda t: t[0] + " ".join(a + v for a, v in t[1]) + t[2])
arc = st.tuples(
    st.sampled_from(["G2", "G3"]), number, number, st.sampled_from(["R25", "R-40", "I5", "I3 J4", "R2", "J1 K1", ""])
).map(lambda t: f"{t[0]} X{t[1]} Y{t[2]} {t[3]}")
full = st.sampled_from(["G3 I5", "G2 J-4", "G2 I3 J-4 F150"])
odd = st.sampled_from(
    ["G91", "G90", "G54", "G92 X1", "M3 S100", "X1 X2", "G1 I5", "U3", "(", "X1,5", "", "// remark", "N5"]
)


@pytest.mark.deep
@given(st.lists(st.one_of(plain, plain, plain, arc, full), min_size=2 * SHORTEST, max_size=90), st.booleans())
def test_runs_of_plain_blocks(both, assert_equal, blocks, incremental):
    text = HEAD + ("G91\n" if incremental else "") + "\n".join(blocks) + "\n"
    assert_equal(*both(text))


@pytest.mark.deep
@given(st.lists(st.one_of(*[plain] * 12, arc, odd), min_size=2 * SHORTEST, max_size=120))
def test_runs_with_other_blocks_between(both, assert_equal, blocks):
    assert_equal(*both(HEAD + "\n".join(blocks) + "\n"))


TURNED = [
    *("G39 X3 Y-2 A35", "G51 X4", "G51 Z1", "G37 X2 Y2 Z0.5"),
    *("G37 X2 Y2\nG51 X1 Y2\nG39 A-110", "G51 Y0\nG39 X5 A20"),
]
switch = st.sampled_from(["G39 A20", "G38", "G51 X3", "G50", "G37 X0.5 Y0.5", "G36", "G53 X4", "G55"])
near = st.tuples(
    st.sampled_from(["G2", "G3"]), st.sampled_from(["X{} R-30", "Y{} R30", "I{} J4", "X{} Y3 R40"])
).flatmap(lambda t: st.integers(1, 20).map(lambda n: f"{t[0]} {t[1].format(n)}"))


@pytest.mark.deep
@given(
    st.sampled_from([*TURNED, "G37 X2 Y3"]), st.booleans(),
    st.lists(st.one_of(plain, plain, near, arc, full), min_size=2 * SHORTEST, max_size=90),
)  # fmt: skip
def test_runs_under_a_transformation(both, assert_equal, head, incremental, blocks):
    """Points, arcs and whole circles; the run begins while the tool still stands where it was before the switch."""
    assert_equal(*both(HEAD + head + ("\nG91\n" if incremental else "\n") + "\n".join(blocks) + "\n"))


@pytest.mark.deep
@given(st.lists(st.one_of(*[plain] * 15, near, switch), min_size=2 * SHORTEST, max_size=120))
def test_runs_with_switches_between(both, assert_equal, blocks):
    assert_equal(*both(HEAD + "\n".join(blocks) + "\n"))


@pytest.mark.deep
@pytest.mark.parametrize("head", [*TURNED, "G18 G39 Z1 X2 A50", "G19 G51 Y3"])
@pytest.mark.parametrize("first", ["G1 X1 Y2 Z3", "", "F150", "a whole circle"])
def test_circles_stay_circles_in_bulk(both, assert_equal, executed, head, first):
    """Only a few blocks go one by one; an arc that would not begin at the tool stops both tiers alike."""
    u, v = {"G18": "ZX", "G19": "YZ"}.get(head[:3], "XY")
    first = first.replace("a whole circle", f"G2 {'IJK'['XYZ'.index(u)]}5")
    turns = [f"G{2 + k % 2} {u}{k % 7}.5 R20\n{v}{k % 5} R30" for k in range(200)]
    text = HEAD + f"X20 Y10 Z5\n{head}\n{first}\n" + "\n".join(turns) + "\n"
    bulk, single = both(text)
    assert_equal(bulk, single)
    if first.startswith("G1"):
        assert bulk.ok and (bulk.toolpath.kind == mnclab.Kind.ARC).sum() > 300
        assert executed(text) < 60
    else:
        stops = [alarm.message for alarm in bulk.alarms if alarm.severity == "alarm"]
        assert not bulk.ok and stops[0].startswith("the arc begins")


@pytest.mark.parametrize("still", ["", "F150\nF160"])
def test_the_tool_stands_where_it_was_until_a_block_moves(both, assert_equal, still):
    """A switch keeps the programmed point: the first block moves although its coordinates are the old ones.

    The machine starts at 0, which G92 calls X3 Y-2.5, so that X0 Y0 lies at -3, 2.5; X10 turned by 90 degrees is Y10.
    """
    text = HEAD + "X10\nG39 A90\n" + still + "\nX10\n" + "X10\n" * 40 + "F100\n" * 10
    bulk, single = both(text)
    assert_equal(bulk, single)
    assert (bulk.toolpath.end[-1] + bulk.toolpath.origin).tolist() == pytest.approx([-3, 2.5 + 10, 3])
    assert bulk.toolpath.kind[-2:].tolist() == [mnclab.Kind.LINE] * 2


def round_blocks(first, second, third):
    """Arcs of all kinds in a plane, some without a centre, some with a third coordinate, and words that may not be there."""
    i, k = {"X": "I", "Y": "J", "Z": "K"}[first], {"X": "I", "Y": "J", "Z": "K"}[second]
    ends = st.sampled_from([f"{first}20", f"{first}0 {second}0", f"{first}10 {second}10", ""])
    centre = st.sampled_from(["R10", "R-40", f"{i}10", f"{i}-10", f"{i}3 {k}4", "", "R2"])
    rise = st.sampled_from(["", f" {third}1", f" {third}-2.5"] if third else [""])
    arc = st.tuples(st.sampled_from(["G2", "G3", ""]), ends, rise, centre).map(lambda t: f"{t[0]} {t[1]}{t[2]} {t[3]}")
    odd = st.sampled_from(["Y3", "J4", "K1", f"{i}5", "F0"])
    back = st.sampled_from([f"G1 {first}0 {second}0", f"G0 {first}20", f"G1 {first}3 {second}4 F90"])
    return st.one_of(arc, arc, arc, back, back, odd)


@pytest.mark.deep
@given(
    st.sampled_from([("mnc", "XYZ"), ("g43", "XYZ"), ("jnc-t01", "XZ")]).flatmap(
        lambda t: st.tuples(st.just(t[0]), st.lists(round_blocks(*t[1], *[""] * (3 - len(t[1]))), min_size=30, max_size=45))
    ),
    st.sampled_from(["warn", "accept", "refuse"]),
)  # fmt: skip
def test_arcs_of_three_controls(both, assert_equal, program, choice):
    """Without a centre MNC goes straight, the others refuse; JNC wants an end, and has no Y and no J."""
    control, blocks = program
    still = "\n".join(f"G1 X{k % 5}" for k in range(SHORTEST))
    text = f"G1 X0 Z0 F100\n{still}\n" + "\n".join(blocks) + "\n"
    assert_equal(*both(text, control, **({"helix": choice} if control == "mnc" else {})))


@pytest.mark.parametrize(("control", "before"), [("mnc", ""), ("g43", "G2 I5\nG3 I5\n")])
def test_helices_go_on_in_bulk_and_are_one_warning(both, assert_equal, control, before):
    """Threads turned by the hundred, each of half a turn between X0 and X20: radius 10, pitch 1."""
    turns = [f"G{2 + k % 2} X{20 * (1 - k % 2)} Y0 Z{-(k + 1) / 2} R10" for k in range(2000)]
    text = HEAD.replace("G92 X3 Y-2.5\n", "") + before + "\n".join(turns) + "\n"
    bulk, single = both(text, control, helix="warn")
    assert [str(a) for a in bulk.alarms] == [str(a) for a in single.alarms] and bulk.ok
    told = [alarm for alarm in bulk.alarms if "helix" in alarm.message]
    first = 3 + before.count("\n")
    assert [alarm.count for alarm in told] == [2000] and bulk.summary()["warnings"] >= 2000
    assert [place.line for place in told[0].places] == [first + k for k in range(5)]
    assert f"1999 more like it (lines {first + 1}, {first + 2}" in str(told[0])
    assert np.array_equal(bulk.toolpath.end, single.toolpath.end) and len(bulk.toolpath) >= 2000
    program = mnclab.read(text, control)
    interpreter = Interpreter(mnclab.controls[control], mnclab.Setup(settings={"helix": "warn"}), program)
    interpreter.run()
    assert len(interpreter.flow.steps().block) - interpreter.flow.in_bulk < 300


def test_a_long_run_is_really_obeyed_in_bulk(both, assert_equal, executed):
    """10 000 blocks of a helix of lines; the flow counts what went one by one."""
    angle = np.arange(10_000) / 50
    lines = [f"X{20 * np.cos(a):.3f} Y{20 * np.sin(a):.3f} Z{-a / 10:.4f}" for a in angle]
    assert executed(HEAD + "\n".join(lines) + "\n") < 100
    assert_equal(*both(HEAD + "\n".join(lines[:500]) + "\n"))


@pytest.mark.parametrize("fault", ["G2 X1 Y1 R0.1", "X1 F-1", "G1 R5", "X1 W2", "G5"])
def test_a_fault_in_a_run_is_worded_by_the_other_tier(both, assert_equal, fault):
    blocks = [f"X{k}" for k in range(100)]
    blocks[70] = fault
    bulk, single = both(HEAD + "\n".join(blocks) + "\n")
    assert_equal(bulk, single)
    assert not bulk.ok and bulk.alarms[0].span.line == 74
    assert bulk.toolpath.line.max() == 73

"""Groups of holes as columns against the one-by-one tier, which is the definition: cycles, what stands between groups,
subprograms with places, and whatever breaks the rule."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Setup, Tool
from mnclab.running.interpreter import Interpreter

HEAD = "G21 G17 G90 G94 G54\nT1 M6\nG43 H1\nS1200 M3 F100\nG0 Z20\nG0 X0 Y0"
TOOLS = {n: Tool(radius=3, length=40 + n, number=n) for n in (1, 2)}
DATUMS = {1: (10.5, -20.25, 3), 2: (3, 4, 5)}

hundredths = st.integers(-2000, 2000).map(lambda n: f"{n / 100:g}")
few = st.sampled_from(["1", "2.5", "-3", "40"])
place = st.one_of(
    st.tuples(st.just("X"), hundredths, st.just(" Y"), hundredths), st.tuples(st.just("X"), hundredths),
    st.tuples(st.just("Y"), few),
).map("".join)  # fmt: skip
cycle = st.sampled_from(
    ["G99 G81 X1 Y2 Z-3 R2 F150", "G98 G81 X1 Y2 Z-3 R2 F150", "G82 X5 Y5 Z-4 R2 P200", "G99 G82 X5 Z-4 R2 P0.2",
     "G99 G83 X4 Z-9 R2 Q2.5", "G73 Y4 Z-9 R2 Q2", "G98 G85 X1 Y1 Z-5 R3 F90", "G89 X2 Y1 Z-5 R3 P100", "G84 X3 Z-8 R4 F600",
     "G76 X3 Z-8 R4 Q0.2", "G81 X3 Z-8 R4 K2", "G91 G81 X3 Y1 Z-5 R-17 F100", "G86 X3 Z-6 R4", "G88 X3 Z-6 R4", "G81 Z-3 R2"]
)  # fmt: skip
between = st.sampled_from(
    ["G80", "G80", "G80\nG0 Z20", "G80\nG90\nG0 Z20", "G0 Z20", "M8", "M9", "(next)", "G80\nM5\nG0 Z50\nT2 M6\nG43 H2\nS900 M3",
     "G98", "G99", "F200", "S800", "G91", "G90", "G55", "G54", "G1 X5 F300", "G0 X5 Y5", "G4 P1", "G80\nG4 X1.5", "G80\nT1 M6",
     "G68 X1 Y1 R30", "G69", "G52 X3", "G92 X4", "G80 G28 Z0", "G94", "G20", "G21", "N100", "#1=5", "M98 P20 L2", "M98 P20",
     "M98 P21"]
)  # fmt: skip
odd = st.sampled_from(
    ["R4", "Z-5", "K2", "X4 K3", "X5 Z-6", "X5 F70", "X5 P300", "Q1", "G95 F0.1", "N7 X7", "/X7", "X#1", "X9 X9", "X5 Q0",
     "G41 D1 X5", "X5 F0", "G16 X9 Y3", "G15", "X1e", "G81 Z5", "X3 Z-4 R", "G80", "M30", "X2000000000", "X999999999", "Y3 G0"]
)  # fmt: skip
#: Of a group the places, and how they are said besides.
tails = st.sampled_from(["", "", "", "", " Z-5", " F80", " R3", " G99"])
group = st.tuples(st.lists(place, min_size=8, max_size=16), tails).map(lambda t: "\n".join(p + t[1] for p in t[0]))
SUBPROGRAM = "M30\nO20\n" + "".join(f"X{3 * k} Y{k % 4}\n" for k in range(1, 14)) + "M99\nO21\nX1\nX2\nM99\n"


def both_of(both, text):
    """Runs of the ISO mill in both tiers."""
    return [
        mnclab.run(text, "g43", Setup(tools=TOOLS, datums=DATUMS, settings={"undescribed": "accept", "bulk": on}))
        for on in (True, False)
    ]


def one_by_one(text):
    """How many blocks of the ISO mill went one by one."""
    interpreter = Interpreter(mnclab.controls["g43"], Setup(tools=TOOLS), mnclab.read(text, "g43"))
    interpreter.run()
    return len(interpreter.flow.steps().block) - interpreter.flow.in_bulk


groups = st.lists(
    st.tuples(cycle, group, st.lists(between, max_size=2)).map(lambda three: "\n".join([*three[:2], *three[2]])),
    min_size=1, max_size=3,
)  # fmt: skip


@st.composite
def programs(draw):
    """The same few groups several times: what stood before each is another thing only the first time. And what breaks them."""
    lines = "\n".join(draw(groups) * draw(st.integers(2, 4))).split("\n")
    for each in draw(st.lists(odd, max_size=2)):
        lines.insert(draw(st.integers(len(lines) // 2, len(lines))), each)
    return "\n".join([HEAD, *lines, "G80", "G90 G0 X1", SUBPROGRAM])


@pytest.mark.deep
@given(programs())
def test_groups_said_again_and_again(both, assert_equal, text):
    assert_equal(*both_of(both, text))


HEADS = ["G99 G81 X0 Y0 Z-3 R2", "G99 G82 X0 Y0 Z-4 R2 P0.2", "G98 G83 X0 Y0 Z-9 R3 Q2.5"]
BETWEEN = ["G80", "G80\nG0 Z20", "G80\nM9\nG0 Z30\nM8",
           "G80\nM5\nG0 Z50\nT2 M6\nG43 H2\nS900 M3\nG0 Z20\nT1 M6\nG43 H1\nS1200 M3\nG0 Z20"]


def told(count, holes=30, between="G80"):
    """A program of groups, each of so many holes; group g lies at Y = 3 g."""
    text = [HEAD]
    for g in range(count):
        head = HEADS[g % 3].replace("Y0", f"Y{3 * g}")
        text += [head, *(f"X{2 * k}" for k in range(1, holes)), between]
    return "\n".join([*text, "G80", "M30\n"])


@pytest.mark.parametrize("between", BETWEEN)
def test_groups_are_few_blocks_one_by_one(both, assert_equal, between):
    """Each cycle, its holes and what stands between are obeyed twice; then 15 groups more take one block each, or those of a
    change of tools, under which other frames hold."""
    text = told(24, between=between)
    assert_equal(*both_of(both, text))
    assert one_by_one(text) <= one_by_one(told(9, between=between)) + 15 * (between.count("\n") if "M6" in between else 1)


def test_every_hole_is_where_its_block_says(both):
    """Cuts end at the bottom of each group, at X = 0, 2, … and Y = 3 g, plus the datum (10.5, -20.25, 3)."""
    path = both_of(both, told(24))[0].toolpath
    cuts = path[(path.kind == mnclab.Kind.LINE)]
    last = cuts.end[:, 2] == np.array([-3.0, -4.0, -9.0])[(np.round(cuts.end[:, 1]) // 3 % 3).astype(int)]
    expected = [(2 * k, 3 * g) for g in range(24) for k in range(30)]
    assert np.array_equal(cuts.end[last, :2], expected)


def test_every_block_has_its_warning(both, assert_equal):
    """P0.2 is 0.2 ms, which is told of each group with G82: of the second one in line 7 + 31, then every 93 lines."""
    bulk, single = both_of(both, told(24))
    assert_equal(bulk, single)
    (found,) = [alarm for alarm in bulk.alarms if "milliseconds" in alarm.message]
    assert str(found) == str(next(alarm for alarm in single.alarms if "milliseconds" in alarm.message))
    assert found.span.line == 7 + 31 and "7 more like it (lines 131, 224, " in str(found)


def test_places_of_a_subprogram_are_known_in_every_call(both, assert_equal):
    calls = "\n".join(f"{head}\nM98 P20\nG80" for head in HEADS * 6)
    text = f"{HEAD}\n{calls}\n{SUBPROGRAM}"
    assert_equal(*both_of(both, text))
    assert one_by_one(text) < 18 * 5 + 3 * 4 + 12  # the blocks of the calls, and the first holes


@pytest.mark.parametrize("fault", ["X7 Q0", "X9 X9", "X7 P-1", "G41 D1 X7", "X7 U3", "X7 R-50"])
def test_a_fault_in_a_late_group_stands_at_its_block(both, assert_equal, fault):
    lines = told(24).split("\n")
    lines[-20] = fault
    bulk, single = both_of(both, "\n".join(lines))
    assert_equal(bulk, single)
    assert not bulk.ok and bulk.alarms[-1].span.line == len(lines) - 19


@pytest.mark.parametrize("most", [1000, 1400, 1999])
def test_too_many_rows_are_told_at_their_block(both, assert_equal, most):
    calls = "\n".join(f"{HEADS[0]}\nM98 P20 L9\nG80" for _ in range(60))
    text = f"{HEAD}\n{calls}\n{SUBPROGRAM}"
    bulk, single = (
        mnclab.run(text, "g43", Setup(tools=TOOLS, settings={"undescribed": "accept", "most_rows": most, "bulk": on}))
        for on in (True, False)
    )
    assert_equal(bulk, single)
    assert not bulk.ok and "rows" in bulk.alarms[-1].message


@pytest.mark.parametrize("change", ["G55", "G52 X3", "G68 X0 Y0 R30", "G91", "G20", "S500", "G95 F0.1", "F77", "G51 X0 Y0 P2"])
def test_what_is_learned_holds_for_its_state_alone(both, assert_equal, change):
    """The same groups before and after something that changes what they do."""
    assert_equal(*both_of(both, told(9, 12).replace("G80\nM30\n", f"{change}\n") + told(9, 12)[len(HEAD) :]))

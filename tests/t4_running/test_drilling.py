"""Groups of holes as columns against the one-by-one tier, which is the definition: cycles, what stands between groups,
subprograms with places, and whatever breaks the rule."""

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
     "G68 X1 Y1 R30", "G69", "G52 X3", "G92 X4", "G80 G28 Z0", "G94", "G20", "G21", "N100", "#1=5", "M98 P20 L2", "M98 P20"]
)  # fmt: skip
odd = st.sampled_from(
    ["R4", "Z-5", "K2", "X4 K3", "X5 Z-6", "X5 F70", "X5 P300", "Q1", "G95 F0.1", "N7 X7", "/X7", "X#1", "X9 X9", "X5 Q0",
     "G41 D1 X5", "X5 F0", "G16 X9 Y3", "G15", "X1e", "G81 Z5", "X3 Z-4 R", "G80", "M30", "X2000000000", "X999999999", "Y3 G0"]
)  # fmt: skip
#: Of a group the places, and how they are said besides.
tails = st.sampled_from(["", "", "", "", " Z-5", " F80", " R3", " G99"])
group = st.tuples(st.lists(place, min_size=8, max_size=16), tails).map(lambda t: "\n".join(p + t[1] for p in t[0]))
SUBPROGRAM = "M30\nO20\n" + "".join(f"X{3 * k} Y{k % 4}\n" for k in range(1, 14)) + "M99\n"


def both_of(both, text):
    """Runs of the ISO mill in both tiers."""
    return [
        mnclab.run(text, "g43", Setup(tools=TOOLS, datums=DATUMS, settings={"undescribed": "accept", "bulk": on}))
        for on in (True, False)
    ]


def one_by_one(text, control="g43", **setup):
    """How many blocks went one by one."""
    interpreter = Interpreter(mnclab.controls[control], Setup(**setup), mnclab.read(text, control))
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

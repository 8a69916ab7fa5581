"""Holes under a modal cycle as columns against the one-by-one tier, which is the definition; and that they are columns."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mnclab.running.bulk import SHORTEST

HEAD = "G17 G90 G54 T2 S800 M3\nG0 X0 Y0 Z20\n"
CYCLES = [
    *("G99 G83 X1 Y1 Z-9 R2 F100", "G98 G83 X1 Y1 Z-9 R2 F100", "G99 G83 Z-9.3 R2.1 K2.3 F100", "G98 G85 W8 R1.7 F80"),
    *("G99 G84 X3 Z-5 R2 F500", "G98 G84 X3 Z-5 R2 F500 P1", "G91 G98 G83 R-17.9 Z-4.1 F90"),
]
number = st.integers(-2000, 2000).map(lambda n: f"{n / 100:g}")
place = st.one_of(
    st.tuples(st.just("X"), number),
    st.tuples(st.just("Y"), number),
    st.tuples(st.just("X"), number, st.just(" Y"), number),
).map("".join)
odd = st.sampled_from(
    ["G91", "G90", "G98", "G99", "G39 A30", "G51 X0", "G37 X2 Y2 Z2", "G92 X5", "G55", "G1 X3", "U4", "X3 Z-6", "X3 W5",
     "Z-7", "R3", "X9 K1", "X9 K0", "X5 P1", "X5 F60", "F70", "K3", "S900", "M4", "M5", "G95", "N5", "// remark", "G80",
     "G83 X1 Z-4 R1", "G85 X1 Z-4 R1", "(", "X1 X2", "T1", "G18", "G41"]
)  # fmt: skip
tail = st.sampled_from(["", "", " K2.5", " Z-8", " Z-8 R2", " F100", " R2.5 K3"])
holes = st.tuples(tail, st.lists(place, min_size=SHORTEST + 4, max_size=60)).map(lambda t: [p + t[0] for p in t[1]])


@pytest.mark.deep
@settings(max_examples=15)
@given(st.sampled_from(CYCLES), st.sampled_from(["", "G39 A33", "G51 Y0", "G37 X2 Y0.5 Z3", "G91"]), holes)
def test_rows_of_holes(both, assert_equal, cycle, switch, places):
    assert_equal(*both(f"{HEAD}{switch}\n{cycle}\n" + "\n".join(places) + "\nG80 G0 X1\n"))


@pytest.mark.deep
@given(
    st.sampled_from(CYCLES), st.lists(st.one_of(holes, st.lists(odd, min_size=1, max_size=2)), min_size=2, max_size=5)
)
def test_rows_of_holes_with_other_blocks_between(both, assert_equal, cycle, pieces):
    assert_equal(*both(f"{HEAD}{cycle}\n" + "\n".join(sum(pieces, [])) + "\nX7\nG80 G0 X1\n"))


def rows_of_holes(n, tail=""):
    return [f"X{k % 300 * 2} Y{k // 300 * 2}{tail}" for k in range(1, n + 1)]


@pytest.mark.deep
@pytest.mark.parametrize("cycle", CYCLES)
@pytest.mark.parametrize("tail", ["", " K3", " Z-8 R3"])
def test_a_thousand_holes_are_few_blocks_one_by_one(both, assert_equal, executed, cycle, tail):
    """Pieces of 32 blocks, then twice as many each time, with two one by one; the first 32 where they change the cycle."""
    tail = tail if "K" not in tail or "G83" in cycle else ""
    text = f"{HEAD}{cycle}\n" + "\n".join(rows_of_holes(1000, tail)) + "\nG80\n"
    assert executed(text) < 50
    assert_equal(*both(text))


@pytest.mark.parametrize("fault", ["X5 K0", "X5 R-50", "X5 F0", "G41 X5", "X5 Q3"])
def test_a_fault_between_holes_is_worded_by_the_other_tier(both, assert_equal, fault):
    places = rows_of_holes(200)
    places[120] = fault
    bulk, single = both(f"{HEAD}G99 G83 X0 Y5 Z-5 R2 F100\n" + "\n".join(places) + "\n")
    assert_equal(bulk, single)
    assert not bulk.ok and bulk.alarms[-1].span.line == 124


def test_the_same_place_twice_is_a_hole_without_a_way_to_it(both, assert_equal):
    places = rows_of_holes(100)
    places[50] = places[49]
    bulk, single = both(f"{HEAD}G99 G83 X0 Y5 Z-5 R2 F100\n" + "\n".join(places) + "\n")
    assert_equal(bulk, single)
    line = np.flatnonzero(bulk.toolpath.line == 4 + 50)
    assert len(line) == 2  # down and up


def test_levels_are_exactly_those_of_the_first_hole(both):
    """Not only near: a level that is added and taken away again must not drift."""
    bulk, single = both(f"{HEAD}G99 G83 X0 Y5 Z-7.7 R0.3 K1.1 F100\n" + "\n".join(rows_of_holes(500, " K1.1")) + "\n")
    assert np.array_equal(bulk.toolpath.end, single.toolpath.end)
    assert set(np.unique(bulk.toolpath.end[:, 2])) == set(np.unique(single.toolpath.end[:, 2]))

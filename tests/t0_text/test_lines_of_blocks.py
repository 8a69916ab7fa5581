"""Lines of many blocks at once: the quick way for one block a line against the lookup of each block."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import mnclab

LINES = st.sampled_from(["X1", "", "// note", "N{} Y2", "  ", "/ Z3", "X1,5"])


@given(st.lists(LINES, max_size=30), st.integers(0, 30), st.integers(0, 30), st.sampled_from(["\n", "\r\n"]))
def test_lines_of_a_slice(lines, a, b, end):
    text = end.join(line.format(k + 1) for k, line in enumerate(lines)) + "\n"
    program = mnclab.read(text, "mnc")
    one_by_one = [int(program.line_of(i)) for i in range(len(program))]
    assert np.asarray(program.line_of(slice(a, b))).tolist() == one_by_one[a:b]
    filled = [k + 1 for k, line in enumerate(lines) if line.strip()]
    assert one_by_one == filled

"""A program with some characters changed raises nothing but alarms."""

import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tools.refusals import programs

import mnclab

sys.path.insert(0, str(Path(__file__).parents[2] / "authorities"))
import iso_programs

pytestmark = pytest.mark.deep

SAMPLES = Path(__file__).parents[3] / "data" / "programs" / "g43"
MACROS = [iso_programs.program(seed)[0] for seed in range(40)]
PROGRAMS = MACROS + programs("g43") + [file.read_text("utf-8") for file in sorted(SAMPLES.iterdir())]


@given(
    st.sampled_from(PROGRAMS),
    st.lists(
        st.tuples(st.floats(0, 1), st.sampled_from("GXYZDTMFSRQPIJNOHL 0123459-+.;/\nХ\r\0ї#[]=%(),:")), min_size=1, max_size=6
    ),
    st.booleans(),
)
def test_a_changed_program_raises_nothing_but_alarms(program, changes, insert):
    for where, character in changes:
        at = int(where * len(program))
        program = program[:at] + character + program[at + (not insert) :]
    for alarm in mnclab.run(program + "\n", "g43").alarms:
        assert alarm.span is not None and str(alarm)

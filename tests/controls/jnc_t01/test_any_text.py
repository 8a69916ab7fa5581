"""A program with some characters changed raises nothing but alarms."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tools.refusals import programs

import mnclab

pytestmark = pytest.mark.deep

SAMPLES = Path(__file__).parents[3] / "data" / "programs" / "jnc-t01"
PROGRAMS = programs("jnc-t01") + [file.read_text("utf-8") for file in sorted(SAMPLES.iterdir())]


@given(
    st.sampled_from(PROGRAMS),
    st.lists(
        st.tuples(st.floats(0, 1), st.sampled_from("GXZUWDTLMFSRIK 01234579-+.%'/\nХ\r\0ї")), min_size=1, max_size=6
    ),
    st.booleans(),
)
def test_a_changed_program_raises_nothing_but_alarms(program, changes, insert):
    for where, character in changes:
        at = int(where * len(program))
        program = program[:at] + character + program[at + (not insert) :]
    for alarm in mnclab.run(program + "\n", "jnc-t01").alarms:
        assert alarm.span is not None and str(alarm)

"""Programs that must be refused, each with its alarm and its place; and any text raises nothing but alarms."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab

HERE = Path(__file__).parent
SECTIONS = [part.partition("\n") for part in (HERE / "refused.txt").read_text("utf-8").strip().split("\n\n")[1:]]
PROGRAMS = [program for _, _, program in SECTIONS] + [
    file.read_text("utf-8") for file in sorted((HERE.parents[2] / "data" / "programs" / "jnc-t01").iterdir())
]


@pytest.mark.parametrize(("headline", "program"), [(head, program) for head, _, program in SECTIONS])
def test_refused(headline, program):
    alarms = [alarm for alarm in mnclab.run(program + "\n", "jnc-t01").alarms if alarm.severity == "alarm"]
    hint = f" ({alarms[0].hint})" if alarms[0].hint else ""
    assert f"{alarms[0].span.line}:{alarms[0].span.column}: {alarms[0].message}{hint}" == headline


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

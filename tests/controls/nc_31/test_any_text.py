"""Any text raises nothing but alarms, and the path ends where the alarm stands."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Setup

pytestmark = pytest.mark.deep

HERE = Path(__file__).parent
PROGRAMS = [
    "".join(line for line in file.read_text("utf-8").partition("---")[0].splitlines(keepends=True) if line[0] != "#")
    for file in sorted((HERE / "examples").glob("*.txt"))
]
CATALOGUE = HERE.parents[1] / "authorities" / "catalogue" / "nc-31.json"
PROGRAMS += [example["program"] for example in json.loads(CATALOGUE.read_text("utf-8"))]
START = Setup(start=(30, 0, 2))


def test_the_path_ends_where_the_alarm_stands():
    run = mnclab.run("X5000~\nZ100~\nX1O\nX1000~\n", "nc-31", START)
    assert not run.ok and len(run.toolpath) == 2


@given(
    st.sampled_from(PROGRAMS),
    st.lists(st.tuples(st.floats(0, 1), st.sampled_from("GXZFSPMNT*~@ 0159-+.;\nХр\r\0ї")), min_size=1, max_size=6),
    st.booleans(),
)
def test_a_changed_program_raises_nothing_but_alarms(program, changes, insert):
    program = "S500\nF20\n" + program
    for place, character in changes:
        at = int(place * (len(program) - 1))
        program = program[:at] + character + program[at + (not insert) :]
    run = mnclab.run(program, "nc-31", START)
    assert run.toolpath.is_motion.sum() < 1_000_000
    assert str(run.program) and all(str(alarm) for alarm in run.alarms)
    assert len(str(mnclab.modern(run)).splitlines()) >= 3


@given(st.text(max_size=200) | st.text(alphabet="GXZFSPN0123456789*~@-\n ", max_size=200))
def test_any_text_raises_nothing_but_alarms(text):
    run = mnclab.run(text + "\n", "nc-31", START)
    assert len(run.program) == len(list(run.program))
    assert mnclab.modern(run)._repr_html_().startswith("<table>")


@pytest.mark.parametrize("text", ["", "\n", "\ufeff", "; nothing but a remark\n", "X" + "9" * 1_000_000, "N" * 10_000])
def test_odd_texts(text):
    run = mnclab.run(text + "\n", "nc-31", START)
    assert run.ok == (len(text) < 100)

"""Programs of all controls that must be refused, each a file whose first comment is its alarm; see `refusals.py`."""

import re

import numpy as np
import pytest
from refusals import FILES, expected, setup_of

import mnclab
from mnclab import Alarm

#: Here a block is a line: the lines before the fault are a program of their own, but for a loop without its end.
LOOPS = ("do-", "end-", "loop-")
LINES = [f for f in FILES if f.parent.name in ("g43", "jnc-t01", "mnc") and not f.stem.startswith(LOOPS)]


def each(files):
    return pytest.mark.parametrize("file", files, ids=lambda file: f"{file.parent.name}-{file.stem}")


@each(FILES)
def test_it_is_refused_there_and_so(file):
    control, setup, (line, column, text) = file.parent.name, setup_of(file), expected(file)
    run = mnclab.run(file, control, setup)
    assert not run.ok
    first, *more = (alarm for alarm in run.alarms if alarm.severity == "alarm")
    assert not more
    assert first.headline == f"{file}:{line}:{column}: alarm: {text}"
    source, caret = first.lines()
    assert source and caret.endswith("^")
    with pytest.raises(Alarm) as raised:
        mnclab.run(file, control, setup, strict=True)
    assert str(raised.value) == str(first)


@pytest.mark.deep
@each(LINES)
def test_the_path_is_kept_up_to_there(file):
    """What the blocks before the fault do is done, and nothing after it."""
    control, setup, (line, _, _) = file.parent.name, setup_of(file), expected(file)
    text = file.read_text(encoding="utf-8").splitlines(keepends=True)
    kept = mnclab.run(file, control, setup)
    before = mnclab.run("".join(text[: line - 1]), control, setup)
    assert before.ok
    n = len(before.programmed)
    assert np.array_equal(kept.programmed.end[:n], before.programmed.end)
    assert np.array_equal(kept.programmed.kind[:n], before.programmed.kind)
    assert set(kept.programmed.line[n:].tolist()) <= {line}
    assert kept.toolpath.line.max(initial=0) <= line


@pytest.mark.deep
def test_a_fault_ends_the_program_before_later_blocks():
    """The same programs with a move after the fault end where they ended."""
    for file in (file for file in FILES if file.parent.name == "mnc"):
        longer = mnclab.run(file.read_text(encoding="utf-8") + "G0 X999 Y999\n", "mnc")
        assert not len(longer.toolpath) or longer.toolpath.end.max() < 999, file.stem


def test_those_of_the_mnc_say_their_authority():
    """The second comment names the section of the manual, or what is adopted where it is silent."""
    for file in (file for file in FILES if file.parent.name == "mnc"):
        assert re.match(r"// \S.{8,}", file.read_text(encoding="utf-8").splitlines()[1]), file.stem

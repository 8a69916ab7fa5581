"""Programs that must be refused; the first comment of each says where and how: `// LINE:COLUMN alarm: text`."""

import re
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Alarm

FILES = sorted((Path(__file__).parents[2] / "refused" / "mnc").glob("*.mnc"))


def expected(file):
    """Line, column and a part of the alarm."""
    first = file.read_text(encoding="utf-8").splitlines()[0]
    line, column, text = re.fullmatch(r"// (\d+):(\d+) alarm: (.+)", first).groups()
    return int(line), int(column), text


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_it_is_refused_there_and_so(file):
    line, column, text = expected(file)
    run = mnclab.run(file, "mnc")
    assert not run.ok
    first = next(alarm for alarm in run.alarms if alarm.severity == "alarm")
    assert text in first.headline
    assert first.span[:2] == (line, column)
    assert first.headline.startswith(f"{file}:{line}:{column}: alarm: ")
    with pytest.raises(Alarm) as raised:
        mnclab.run(file, "mnc", strict=True)
    assert str(raised.value) == str(first)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_the_path_is_kept_up_to_there(file):
    """What the blocks before the fault do is done, and nothing after it."""
    line, _, _ = expected(file)
    text = file.read_text(encoding="utf-8").splitlines(keepends=True)
    kept = mnclab.run(file, "mnc")
    before = mnclab.run("".join(text[: line - 1]), "mnc")
    assert before.ok
    n = len(before.programmed)
    assert np.array_equal(kept.programmed.end[:n], before.programmed.end)
    assert np.array_equal(kept.programmed.kind[:n], before.programmed.kind)
    assert set(kept.programmed.line[n:].tolist()) <= {line}
    assert kept.toolpath.line.max(initial=0) <= line


def test_a_fault_ends_the_program_before_later_blocks():
    """The same programs with a move after the fault end where they ended."""
    for file in FILES:
        longer = mnclab.run(file.read_text(encoding="utf-8") + "G0 X999 Y999\n", "mnc")
        assert not len(longer.toolpath) or longer.toolpath.end.max() < 999, file.stem


def test_each_says_its_authority():
    """The second comment names the section of the manual, or what is adopted where it is silent."""
    for file in FILES:
        assert re.match(r"// \S.{8,}", file.read_text(encoding="utf-8").splitlines()[1]), file.stem

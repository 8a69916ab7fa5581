"""Programs of all controls that must be refused, each with its alarm as its first comment; see `tools/refusals.py`.

`python3 tests tests/controls/test_refused.py --rewrite` writes the alarms anew: read every change before it is kept.
"""

import re

import numpy as np
import pytest
from tools.refusals import FILES, changed, refusals, written
from tools.together import together

import mnclab
from mnclab import Alarm

REFUSALS = [refusal for file in FILES for refusal in refusals(file)]
#: Here a block is a line: the lines before the fault are a program of their own, but for a loop without its end.
LINES = [r for r in REFUSALS if r.control in ("g43", "jnc-t01", "mnc") and r.file.stem != "loops"]


def each(cases, **more):
    group = lambda refusal: f"{refusal.control}-{refusal.file.stem}"  # noqa: E731
    return together("refusal", cases, group, lambda refusal: refusal.name, **more)


@each(REFUSALS)
def test_it_is_refused_there_and_so(refusal, rewrite):
    program = refusal.program
    run = mnclab.run(program, setup=refusal.setup)
    assert not run.ok
    first, *more = (alarm for alarm in run.alarms if alarm.severity == "alarm")
    assert not more
    if rewrite:
        refusal.rewrite(first.headline.removeprefix(f"{refusal.path}:"))
        return
    line, column, text = refusal.expected
    assert first.headline == f"{refusal.path}:{line}:{column}: alarm: {text}"
    source, caret = first.lines()
    assert source and caret.endswith("^")


@each(REFUSALS, deep_but_one_in=6)
def test_it_is_raised_where_that_is_asked_for(refusal):
    program = refusal.program
    first = next(alarm for alarm in mnclab.run(program, setup=refusal.setup).alarms if alarm.severity == "alarm")
    with pytest.raises(Alarm) as raised:
        mnclab.run(program, setup=refusal.setup, strict=True)
    assert str(raised.value) == str(first)


def test_each_has_a_name_of_its_own():
    assert len({(refusal.file, refusal.name) for refusal in REFUSALS}) == len(REFUSALS)


def test_an_alarm_is_written_anew_in_its_place(tmp_path):
    file = tmp_path / "two.g43"
    file.write_text("; == one\n; 2:1 alarm: old\nG0\n\n; == two\n; 2:1 alarm: old\nG1\n", encoding="utf-8")
    one, two = refusals(file)
    assert (one.text, two.text) == ("; 2:1 alarm: old\nG0\n", "; 2:1 alarm: old\nG1\n")
    two.rewrite("2:4: alarm: new: as \\1 says (a hint)")
    assert file.read_text("utf-8") == f"; == one\n{one.text}\n; == two\n; 2:4 alarm: new: as \\1 says (a hint)\nG1\n"


def test_one_like_a_sample_is_written_anew_in_its_place(tmp_path):
    file = tmp_path / "two.g43"
    sample, change = "; -- both\nG0\nG1\n\n", "@@ 3\n-G1\n+G2\n+G3\n"
    file.write_text(f"{sample}; == one like both\n; 2:1 alarm: old\n{change}", encoding="utf-8")
    (one,) = refusals(file)
    assert one.text == "; 2:1 alarm: old\nG0\nG2\nG3\n"
    one.rewrite("2:4: alarm: new")
    assert file.read_text("utf-8") == f"{sample}; == one like both\n; 2:4 alarm: new\n{change}"


def test_changes_of_a_sample_name_the_lines_of_the_new_program():
    """The same as `patch` makes of them, with comments of its own in front."""
    sample = "a\nb\nc\nd\n"
    assert changed(sample, "; 1\n@@ 3\n-b\n@@ 4\n+e\n@@ 6\n+f\n", "") == "; 1\na\nc\ne\nd\nf\n"
    assert changed(sample, "; 1\n; 2\n@@ 3\n-a\n+A\n", "") == "; 1\n; 2\nA\nb\nc\nd\n"
    for wrong in ("; 1\n@@ 3\n-c\n", "; 1\n@@ 1\n-a\n", "; 1\n@@ 9\n+e\n", "; 1\n@@ 2\na\n"):
        with pytest.raises(AssertionError, match="here: "):
            changed(sample, wrong, "here")


def test_a_sample_has_no_fault_of_its_own():
    """What is refused is what a program changes in it: alone it runs, or lacks nothing but a part to touch."""
    for file in FILES:
        for name, text in written(file).samples.items():
            wrong = [alarm.headline for alarm in mnclab.run(text, file.parent.name).alarms if alarm.severity == "alarm"]
            assert not wrong or "there is no part to touch" in wrong[0], (file.stem, name, wrong)


@pytest.mark.deep
@each(LINES)
def test_the_path_is_kept_up_to_there(refusal):
    """What the blocks before the fault do is done, and nothing after it."""
    line, _, _ = refusal.expected
    kept = mnclab.run(refusal.program, setup=refusal.setup)
    before = mnclab.run("".join(refusal.text.splitlines(keepends=True)[: line - 1]), refusal.control, refusal.setup)
    assert before.ok
    n = len(before.programmed)
    assert np.array_equal(kept.programmed.end[:n], before.programmed.end)
    assert np.array_equal(kept.programmed.kind[:n], before.programmed.kind)
    assert set(kept.programmed.line[n:].tolist()) <= {line}
    assert kept.toolpath.line.max(initial=0) <= line


@pytest.mark.deep
def test_a_fault_ends_the_program_before_later_blocks():
    """The same programs with a move after the fault end where they ended."""
    for refusal in (refusal for refusal in REFUSALS if refusal.control == "mnc"):
        longer = mnclab.run(refusal.text + "G0 X999 Y999\n", "mnc")
        assert not len(longer.toolpath) or longer.toolpath.end.max() < 999, refusal.name


def test_those_of_the_mnc_say_their_authority():
    """The second comment names the section of the manual, or what is adopted where it is silent."""
    for refusal in (refusal for refusal in REFUSALS if refusal.control == "mnc"):
        assert re.match(r"// \S.{8,}", refusal.text.splitlines()[1]), (refusal.file.stem, refusal.name)

"""Long lines and long words: bounded in memory and time, and said in one alarm."""

import time
import tracemalloc

import pytest

import mnclab
from mnclab.text.alarm import nearest
from mnclab.text.program import MOST_FAULTS

pytestmark = pytest.mark.deep

CONTROLS = ["mnc", "jnc-t01", "g43", "tnc-620"]


@pytest.mark.parametrize("end", ["", " ;", " //", " A", " \u0425"])
@pytest.mark.parametrize("word", ["X1", "X1 ", "G1X2Y-3. "])
@pytest.mark.parametrize("control", CONTROLS)
def test_a_line_of_very_many_words_is_no_block(control, word, end):
    size = 300_000
    begin = "L " if control == "tnc-620" else ""
    tracemalloc.start()
    run = mnclab.run(begin + word * (size // len(word)) + end + "\nM2\n", control)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert not run.ok and len(run.alarms) < 4 and len(run.program.value) < 1100
    assert most < 150 * size  # bytes
    if control != "tnc-620":
        assert any("at most 1000 words" in alarm.message for alarm in run.alarms)


def test_a_word_that_is_far_too_long_is_near_nothing():
    begin = time.thread_time()
    assert nearest("z" * 100_000, ["feed", "tool", "x" * 30]) == []
    run = mnclab.run("G0 X1\n", "mnc")
    with pytest.raises(mnclab.Alarm):
        run.when("z" * 100_000)
    with pytest.raises(mnclab.Alarm):
        run.when("1 " * 50_000)
    assert time.thread_time() - begin < 2
    assert nearest("feeed", ["feed", "tool"]) == ["feed"]


def test_a_block_is_found_without_a_copy_of_the_rest():
    text = "N1 G0 X1\n" * 3 + "/ N4 X1 // four\n" + "N5 X2 (\n" * 2 + "X1\n" * 400_000
    program = mnclab.read(text, "mnc")
    assert [program[k].number for k in (0, 3, 4)] == ["N1", "N4", "N5"]
    begin = time.thread_time()
    for index in range(2000):
        program[index]
    assert time.thread_time() - begin < 20  # 0.05 s; guards against a copy of the text for each


@pytest.mark.parametrize("control", ["mnc", "g43", "jnc-t01"])
def test_lines_with_comments_are_read_in_proportion_to_their_number(control):
    mark = {"mnc": "//", "g43": ";", "jnc-t01": "'"}[control]
    text = f"X1 {mark} a\n" * 20_000
    tail = text + "G0 X1\n" * 400_000
    begin = time.thread_time()
    mnclab.read(text, control)
    alone = time.thread_time() - begin
    begin = time.thread_time()
    mnclab.read(tail, control)
    assert time.thread_time() - begin < 4 * alone + 4  # each line looked for a carriage return to the end of the text


FAULTY = {"mnc": "N10 G1 X?\n", "jnc-t01": "G1 X 5\n", "nc-31": "G1 ?\n", "g43": "G1 X[\n", "tnc-620": "L X?\n"}


@pytest.mark.parametrize("control", FAULTY)
def test_a_text_is_read_no_further_than_it_has_faults_that_anybody_mends(control):
    """The alarm that says so stands in the first line that was not read; the text is kept whole."""
    text = "\n" + FAULTY[control] * (MOST_FAULTS + 100)
    program = mnclab.read(text, control)
    *told, last = sorted(program.alarms, key=lambda alarm: alarm.span.line)
    assert f"more than {MOST_FAULTS} faults" in last.message
    assert MOST_FAULTS / 4 < len(program) < last.span.line <= MOST_FAULTS + 2
    assert program.text == text and program.line_text(last.span.line) == FAULTY[control].rstrip()
    assert [alarm.span.line for alarm in told][0] == 2 and mnclab.run(program).alarms
    fewer = mnclab.read(FAULTY[control] * 100, control)
    assert not any("is not read" in alarm.message for alarm in fewer.alarms)


def test_the_largest_file_is_a_setting(tmp_path):
    """A file of 1.2 MB, below the limit of every program, is beyond one of 1 MB and within one of 2."""
    path = tmp_path / "long.nc"
    path.write_text("G21 G90 G94 G17 G54 S1000 M3\n" + "G1 X1.000 Y1.000 F100\nG1 X2.000 Y1.000 F100\n" * 27_300)
    assert 1e6 < path.stat().st_size < 2e6
    refused = "cannot be read: it has more than 1 MB"
    with pytest.raises(mnclab.Alarm, match=refused):
        mnclab.run(path, "g43", settings={"most_megabytes": 1})
    with pytest.raises(mnclab.Alarm, match=refused):
        mnclab.read(path, "g43", most_megabytes=1)
    setup = mnclab.Setup(settings={"most_megabytes": 2})
    assert len(mnclab.run(path, "g43", setup).toolpath) == len(mnclab.run(path, "g43").toolpath) > 54_000
    for value in (0, 2001, "much", True):
        with pytest.raises(mnclab.Alarm, match="most_megabytes"):
            mnclab.run(path, "g43", settings={"most_megabytes": value})

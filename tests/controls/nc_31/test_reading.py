"""Frames, marks, numbers, groups, letters: what the reader makes of a text (catalogue nc-31, "frame" to "N")."""

import pytest

import mnclab
from mnclab.controls.recognition import looks_like
from mnclab.text.program import AT_MARK, GROUP_MARK, RAPID_MARK

PARSING = "N92 X10500 ~\nN96 G66 *\nN97 X400\nN98 Z@-1000~\n"  # catalogue, "frame": frames of the source and an @


def words(text):
    return [[(word.address, word.value, word.flag & ~AT_MARK) for word in block.words] for block in mnclab.read(text, "nc-31")]


def test_parsing():
    program = mnclab.read(PARSING, "nc-31")
    assert words(PARSING) == [
        [("X", 10500, RAPID_MARK)],
        [("G", 66, GROUP_MARK), ("X", 400, 0)],
        [("Z", -1000, RAPID_MARK | 1)],
    ]
    assert program[2].words[0].incremental
    assert program.labels == {"92": 0, "96": 1, "97": 1, "98": 2}
    assert [block.number for block in program] == ["N92", "N96", "N98"]
    assert [word.span[:2] for word in program[1].words] == [(2, 5), (3, 5)]


@pytest.mark.parametrize(("text", "meant"), [("XO5", True), ("G O1", True), ("TOOL CALL", False)])
def test_a_letter_stands_for_a_digit_only_among_digits(text, meant):
    (alarm, *_) = mnclab.read(text + "\n", "nc-31").alarms
    assert ("the digit 0 was meant" in alarm.hint) == meant


@pytest.mark.parametrize("frame", ["G77@*~", "G77 @ * ~", "G77~*@", "G@77*~", "g77\t~ @ *"])
def test_marks_stand_in_any_order(frame):
    assert words(frame + "\nX1\n")[0][0] == ("G", 77, 7)


def test_scale():
    """Frames of the source: 300 rev/min, 2.00 mm/rev, diameter 105.00, Z -0.30 (catalogue, "discretes")."""
    run = mnclab.run("N90 S300\nN91 F200\nN92 X10500~\nN95 Z-30\n", "nc-31")
    assert not run.alarms
    assert run.toolpath.spindle[-1] == 300 and run.toolpath.per_rev[-1] == 2.0 and run.toolpath.feed[-1] == 600.0
    assert tuple(run.toolpath.end[-1]) == (52.5, 0, -0.3)
    assert run.toolpath.lathe and tuple(run.toolpath.axis[-1]) == (0, 1, 0)


def test_frames_without_numbers_count_on():
    program = mnclab.read("S300\n\n; a remark\nX5~\nN10 Z5*\nX7\nN20 S1\nS2\n", "nc-31")
    assert program.labels == {"0": 0, "1": 1, "10": 2, "11": 2, "20": 3, "21": 4}


def test_a_written_number_wins_over_a_counted_one():
    program = mnclab.read("S300\nX5~*\nZ5~\nN1 X6~\nZ7~\n", "nc-31")
    assert program.labels == {"0": 0, "1": 2, "2": 3}  # the group of frames 1 and 2 cannot be named any more


def test_comments():
    program = mnclab.read("G61* ; first\n; between\nX5 ; second\nS3\n", "nc-31")
    assert len(program) == 2 and program[0].comment == "first between second" and not program.alarms


def test_line_ends_and_byte_order_mark():
    assert words("\ufeffX5*\r\nZ6\r\n") == words("X5*\rZ6") == words("X5*\nZ6") == [[("X", 5, GROUP_MARK), ("Z", 6, 0)]]


def test_cyrillic_letters_are_read_and_reported(tmp_path):
    text = "S300\nF20\nN5 Х500~ ; Х\nр7\nМ3\n"
    program = mnclab.read(text, "nc-31")
    assert [a.span[:2] for a in program.alarms] == [(3, 4), (4, 1), (5, 1)]
    assert {a.severity for a in program.alarms} == {"warning"}
    assert "'Х' is a Cyrillic letter, read as X" in str(program.alarms[0])
    assert words(text)[2:] == [[("X", 500, RAPID_MARK)], [("P", 7, 0)], [("M", 3, 0)]]
    for page in ("utf-8", "cp1251", "koi8-r", "utf-16"):
        file = tmp_path / f"{page}.nc31"
        file.write_bytes(text.encode(page))
        assert words(file) == words(text)


def test_the_text_says_which_control():
    for text in (PARSING, "N1 G77@*~\n X5 ; diameter\n"):
        assert looks_like(text, mnclab.controls) == "a program of nc-31"
    for text in ("N10 G0 X5 Z7\n", "X5\nZ7\n", ""):
        assert looks_like(text, mnclab.controls) != "a program of nc-31"

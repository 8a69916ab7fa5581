"""A program as rows for people, and texts from the bytes of a file."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab.text.alarm import Span
from mnclab.text.file import decode

TEXT = """\
%
N10 G0 X1.5  // to the start
// a line of its own
  / n 20 g1 y-2
\tX3 / / typeset so

X4Y5
N+30 Z1
"""


def blocks():
    return {block.span.line: block for block in mnclab.read(TEXT, "mnc")}


def test_number_comment_skip():
    found = blocks()
    assert list(found) == [1, 2, 3, 4, 5, 7, 8]
    assert {line: block.number for line, block in found.items() if block.number} == {2: "N10", 4: "N20", 8: "N30"}
    assert {line: block.comment for line, block in found.items() if block.comment} == {
        2: "to the start",
        3: "a line of its own",
        5: "typeset so",
    }
    assert [line for line, block in found.items() if block.skip] == [4]


def test_words_with_their_places():
    found = blocks()
    assert [(w.address, w.value, w.span) for w in found[2].words] == [
        ("G", 0, Span(2, 5, 2)),
        ("X", 1.5, Span(2, 8, 4)),
    ]
    assert [(w.address, w.value, w.span) for w in found[4].words] == [
        ("G", 1, Span(4, 10, 2)),
        ("Y", -2, Span(4, 13, 3)),
    ]
    assert [w.span for w in found[5].words] == [Span(5, 2, 2)]
    assert [w.span for w in found[7].words] == [Span(7, 1, 2), Span(7, 3, 2)]


def test_the_span_of_a_block_ends_before_its_comment():
    spans = {line: block.span for line, block in blocks().items()}
    assert spans == {
        1: Span(1, 1, 1),
        2: Span(2, 1, 11),
        3: Span(3, 1, 1),
        4: Span(4, 3, 13),
        5: Span(5, 2, 2),
        7: Span(7, 1, 4),
        8: Span(8, 1, 7),
    }


def test_it_is_a_sequence():
    program = mnclab.read(TEXT, "mnc")
    assert len(program) == 7 and [str(b) for b in program] == [str(program[i]) for i in range(7)]
    assert program[-1] == program[6]
    with pytest.raises(IndexError):
        program[7]
    assert program.line_of(np.arange(7)).tolist() == [1, 2, 3, 4, 5, 7, 8]
    assert [program.line_text(n) for n in (0, 1, 6, 9, 10)] == ["", "%", "", "", ""]


def test_columns_and_rows_agree():
    program = mnclab.read(TEXT, "mnc")
    rows = [word for block in program for word in block.words]
    assert [program.addresses[k] for k in program.address] == [word.address for word in rows]
    assert program.value.tolist() == [word.value for word in rows]
    assert np.diff(program.first).tolist() == [len(block.words) for block in program]
    for word, offset, length in zip(rows, program.offset, program.length):
        piece = program.text[offset : offset + length]
        assert piece[0].upper() == word.address and float(piece[1:]) == word.value


number = st.floats(-1e8, 1e8).map(lambda value: np.format_float_positional(value, trim="-"))
words = st.lists(st.tuples(st.sampled_from("GMXYZUVWIJKRPQHETFSD"), number).map("".join), min_size=1, max_size=6)
block = st.tuples(st.sampled_from(["", "/", "N7", "N12 ", "/N9 "]), words.map(" ".join)).map("".join)


@given(st.lists(block, min_size=1, max_size=6))
def test_a_printed_program_reads_as_the_same_blocks(lines):
    program = mnclab.read("\n".join(lines) + "\n", "mnc")
    printed = mnclab.read("\n".join(map(str, program)) + "\n", "mnc")
    for one, other in zip(program, printed, strict=True):
        assert (one.number, one.skip) == (other.number, other.skip)
        assert [w[:2] for w in one.words] == [w[:2] for w in other.words]


def test_a_table_for_notebooks_shows_blocks_and_alarms():
    shown = mnclab.read(TEXT.replace("to the start", "<to> & fro"), "mnc")._repr_html_()
    row = "<td>N10</td><td><code>G0 X1.5</code></td><td>&lt;to&gt; &amp; fro</td>"
    assert row in shown.replace(' style="text-align:left"', "")
    assert "has no meaning here" in shown
    long = mnclab.read("X1\n" * 50, "mnc")._repr_html_()
    assert long.count("<tr><td") == 40 and "10 more blocks" in long


# --- bytes ------------------------------------------------------------------------------------------------------------

PHRASES = [
    "Черновая обработка кармана, фреза 10 мм",
    "выход на эквидистантный контур",
    "ЦИКЛ ГЛУБОКОГО СВЕРЛЕНИЯ",
    "Нулевая точка - угол заготовки",
    "Инструмент 5: сверло, ёмкость магазина 20",
]


@pytest.mark.parametrize("phrase", PHRASES, ids=range(len(PHRASES)))
@pytest.mark.parametrize("page", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1251", "koi8-r"])
def test_cyrillic_comments_in_their_code_page(page, phrase, tmp_path):
    data = f"N10 G0 X5 // {phrase}\r\nN20 Y3\r\n".encode(page)
    mark = {"utf-16-le": b"\xff\xfe", "utf-16-be": b"\xfe\xff"}.get(page, b"")
    file = tmp_path / "part.mnc"
    file.write_bytes(mark + data)
    program = mnclab.read(file, "mnc")
    assert program[0].comment == phrase
    assert program.encoding == {"utf-8-sig": "utf-8"}.get(page, page.removesuffix("-le").removesuffix("-be"))
    assert [(w.address, w.value, w.span) for w in program[0].words] == [
        ("G", 0, Span(1, 5, 2)),
        ("X", 5, Span(1, 8, 2)),
    ]
    assert not program.alarms


@pytest.mark.parametrize("page", ["cp1251", "koi8-r"])
def test_plain_text_has_no_code_page(page):
    assert decode("N10 X5\n".encode(page)) == ("N10 X5\n", "utf-8")


def test_single_letters_are_those_of_windows(tmp_path):
    """A Cyrillic letter typed for a Latin one: the alarm must show that letter."""
    file = tmp_path / "part.mnc"
    file.write_bytes("G0 \u042510\n".encode("cp1251"))
    alarm = mnclab.read(file, "mnc").alarms[0]
    assert (alarm.message, alarm.hint) == ("'\u0425' is a Cyrillic letter", "write the Latin letter X")


@given(st.binary(max_size=200))
def test_no_bytes_break_it(data):
    text, page = decode(data)
    assert isinstance(text, str) and page in ("utf-8", "utf-16", "cp1251", "koi8-r")

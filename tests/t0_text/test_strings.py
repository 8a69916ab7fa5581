"""Texts joined, cut and counted; the first character has the number 0. Expected values are Python's own."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab import Alarm
from mnclab.text.alarm import Span
from mnclab.text.strings import is_number, parse_number, parse_text

VARIABLES = {"QS1": "DRILL 8", "QS2": "8", "QS13": "", "Q1": 2.5, "Q2": -4.0}


def text(formula):
    return parse_text(formula, Span(1, 1)).evaluate(VARIABLES)


def number(formula):
    assert is_number(formula)
    return parse_number(formula, Span(1, 1)).evaluate(VARIABLES)


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        ('"A"', "A"),
        ('""', ""),
        ('"a || b"', "a || b"),
        ("QS1", "DRILL 8"),
        ('QS1 || " mm" ||QS13|| "."', "DRILL 8 mm."),
        ("TOCHAR ( DAT+Q1 DECIMALS4 )", "2.5000"),
        ("tochar(dat Q2 decimals0)", "-4"),
        ("TOCHAR(DAT-1,25)", "-1.25"),
        ("TOCHAR(DAT+50)", "50"),
        ("SUBSTR ( SRC_QS1 BEG0 LEN5 )", "DRILL"),
        ("SUBSTR(SRC_QS1 BEG6 LEN1)", "8"),
        ('SUBSTR(SRC_"12345" BEG+Q1 LEN0)', ""),
        ('"T" || TOCHAR(DAT+Q1 DECIMALS1) || SUBSTR(SRC_QS1 BEG5 LEN2)', "T2.5 8"),
    ],
)
def test_texts(formula, expected):
    if "BEG+Q1" in formula:
        with pytest.raises(Alarm, match="BEG must be a whole number from 0 to 255, got 2.5"):
            text(formula)
    else:
        assert text(formula) == expected


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        ("TONUMB ( SRC_QS2 )", 8),
        ('TONUMB(SRC_" -1,5 ")', -1.5),
        ("STRLEN ( SRC_QS1 )", 7),
        ("STRLEN(SRC_QS13)", 0),
        ("STRLEN(SRC_QS99)", -1),  # no text was given
        ('INSTR ( SRC_QS1 SEA_"L" BEG0 )', 3),
        ('INSTR ( SRC_QS1 SEA_"L" BEG4 )', 4),
        ('INSTR(SRC_QS1 SEA_"L" BEG5)', 7),  # found nowhere: the length
        ("INSTR(SRC_QS1 SEA_QS2)", 6),
        ("STRCOMP ( SRC_QS1 SEA_QS1 )", 0),
        ('STRCOMP(SRC_"ABC" SEA_"ABD")', -1),
        ('STRCOMP(SRC_"B" SEA_"AZ")', 1),
    ],
)
def test_numbers(formula, expected):
    assert number(formula) == expected


letters = st.text("ABCab 129", max_size=12)


@given(letters, letters, st.data())
def test_they_are_those_of_python(one, other, data):
    begin = data.draw(st.integers(0, len(one)))
    length = data.draw(st.integers(0, len(one) - begin))
    assert text(f'"{one}" || "{other}"') == one + other
    assert text(f'SUBSTR(SRC_"{one}" BEG{begin} LEN{length})') == one[begin : begin + length]
    assert number(f'STRLEN(SRC_"{one}")') == len(one)
    at = number(f'INSTR(SRC_"{one}" SEA_"{other}" BEG{begin})')
    assert at == (one.index(other, begin) if other in one[begin:] else len(one))
    assert number(f'STRCOMP(SRC_"{one}" SEA_"{other}")') == (one > other) - (one < other)


@given(st.floats(-1e6, 1e6), st.integers(0, 6))
def test_a_number_comes_back_from_its_text(value, decimals):
    value = round(value, 6)
    shown = text(f"TOCHAR(DAT{value:f} DECIMALS{decimals})")
    assert len(shown.partition(".")[2]) == decimals
    assert number(f'TONUMB(SRC_"{shown}")') == pytest.approx(value, abs=0.5000001 * 10**-decimals)


@pytest.mark.parametrize(
    ("formula", "column", "length", "sentence"),
    [
        ("5", 1, 1, "a text in quotes or a QS parameter was expected, found '5'"),
        ('"A" "B"', 5, 1, "|| was expected between two texts"),
        ('"A" ||', 7, 1, "a text in quotes or a QS parameter was expected"),
        ('"A', 1, 1, "a text in quotes or a QS parameter was expected, found '\"'"),
        ("STRLEN(SRC_QS1)", 1, 6, "STRLEN gives a number, a text is wanted here"),
        ("SUBSTR(SRC_QS1 BEG2)", 1, 6, "SUBSTR needs LEN"),
        ("SUBSTR(SRC_QS1 BEG2 LEN", 21, 3, "LEN needs a number or a Q parameter"),
        ("SUBSTR(SRC_QS1 BEG2 LEN4", 1, 6, "SUBSTR has no closing bracket"),
        ("SUBSTR(SRC_QS1 BEG2 BEG3 LEN4)", 21, 3, "BEG is written twice in SUBSTR"),
        ("SUBSTR(SEA_QS1 BEG2 LEN4)", 8, 3, "SEA is no part of SUBSTR"),
        ("TOCHAR(5)", 8, 1, "5 is no part of TOCHAR"),
        ("SUBSTR(SRC_SUBSTR(SRC_QS1 BEG2 LEN4) BEG0 LEN1)", 12, 1, "a text in quotes or a QS parameter was expected"),
        ("CFGREAD ( KEY_QS1", 1, 7, "CFGREAD has no closing bracket"),
    ],
)
def test_faults_of_writing(formula, column, length, sentence):
    with pytest.raises(Alarm) as caught:
        parse_text(formula, Span(3, 11))
    assert sentence in caught.value.message
    assert caught.value.span == Span(3, 10 + column, length)


@pytest.mark.parametrize(
    ("formula", "column", "sentence"),
    [
        ("QS5", 1, "no text was given to QS5"),
        ("SUBSTR(SRC_QS1 BEG5 LEN3)", 1, "SUBSTR cannot take characters 5 to 7 of a text of 7"),
        ("TOCHAR(DAT+Q9)", 12, "no value was given to Q9"),
        ("TOCHAR(DAT+Q1 DECIMALS16)", 1, "TOCHAR DECIMALS must be a whole number from 0 to 15, got 16"),
        ("CFGREAD(KEY_QS1 TAG_QS2 ATR_QS3)", 1, "CFGREAD is refused: machine parameters are not built yet"),
        ('"A" || SYSSTR(ID321 NR8)', 8, "SYSSTR ID321 NR8 is not built yet"),
        ('"' + "x" * 200 + '" || "' + "y" * 56 + '"', 1, "a text has at most 255 characters, this one 256"),
    ],
)
def test_faults_of_values(formula, column, sentence):
    with pytest.raises(Alarm) as caught:
        parse_text(formula, Span(3, 11)).evaluate(VARIABLES)
    assert caught.value.message == sentence
    assert caught.value.span[:2] == (3, 10 + column)


@given(st.text('QS12 ||"(SUBSTR_CLEN)TOHAD+-.', max_size=40))
def test_no_text_raises_anything_but_an_alarm(formula):
    for read in (parse_text, parse_number):
        try:
            read(formula, Span(1, 1)).evaluate(VARIABLES)
        except Alarm as alarm:
            assert alarm.span is not None and alarm.span.column >= 1

"""Arithmetic inside words against Python's own, and its faults at their columns."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab import Alarm
from mnclab.text.alarm import Span
from mnclab.text.expression import parse

VARIABLES = {"Q1": 2.5, "Q2": -4.0, "Q15": 0.0, "QL3": 7.0, "QR4": 1e-3}


def value(text, column=1):
    return parse(text, Span(1, column)).evaluate(VARIABLES)


def tree(leaf):
    """(text, value) of a part made of smaller parts; whole numbers, so that every result is exact."""
    pairs = st.tuples(leaf, leaf)
    return st.one_of(
        pairs.map(lambda p: (f"({p[0][0]} + {p[1][0]})", p[0][1] + p[1][1])),
        pairs.map(lambda p: (f"({p[0][0]}-{p[1][0]})", p[0][1] - p[1][1])),
        pairs.map(lambda p: (f"{p[0][0]}*{p[1][0]}", p[0][1] * p[1][1])),
        leaf.map(lambda p: (f"(-{p[0]})", -p[1])),
        leaf.map(lambda p: (f"abs({p[0]})", abs(p[1]))),
        leaf.map(lambda p: (f" ( {p[0]} ) ", p[1])),
    )


number = st.integers(0, 9).map(lambda n: (str(n), n))
variable = st.sampled_from([("Q2", -4), ("q15", 0), ("QL3", 7)])


@given(st.recursive(st.one_of(number, variable), tree, max_leaves=12))
def test_values_are_those_of_python(pair):
    text, expected = pair
    assert value(text) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 + 2 * 3", 7),
        ("8 - 3 - 2", 3),  # from the left
        ("16 / 4 / 2", 2),
        ("16 DIV 4 * 2", 8),
        ("2 ^ 3 ^ 2", 512),  # from the right
        ("2 * 3 ^ 2", 18),
        ("2 ^ -1", 0.5),
        ("-Q1", -2.5),
        ("- -Q1", 2.5),
        ("+Q1", 2.5),
        ("2*-3", -6),
        ("1,5 + .5", 2),
        ("SQRT 16 + 9", 13),  # a function takes the next part only
        ("SQRT (16 + 9)", 5),
        ("SIN 30", 0.5),
        ("cos 60", 0.5),
        ("TAN 45", 1),
        ("INT -2.7", -2),
        ("ABS Q2", 4),
        ("QR4 * 1000", 1),
        ("Q1/Q2", -0.625),
        ("0 ^ (Q1 - 2)", 0),  # with another Q1 it would have no value
    ],
)
def test_precedence_and_functions(text, expected):
    assert value(text) == pytest.approx(expected, abs=1e-15)


@given(st.floats(-720, 720))
def test_angles_are_degrees(angle):
    text = f"{angle:.6f}"
    for name, function in (("SIN", math.sin), ("COS", math.cos)):
        assert value(f"{name}({text})") == pytest.approx(function(float(text) * math.pi / 180), abs=1e-12)


@pytest.mark.parametrize(
    ("text", "column", "length", "sentence"),
    [
        ("1 + ?", 5, 1, "'?' is no part of an expression"),
        ("Q1 Q2", 4, 2, "an operator was expected before Q2"),
        ("1 2", 3, 1, "an operator was expected before 2"),
        ("(1 + 2", 6, 1, "the expression ends where"),
        ("1 +", 3, 1, "the expression ends where"),
        ("1 + )", 5, 1, "a number or a variable was expected, found )"),
        ("1)", 2, 1, "an operator was expected before )"),
        ("(1 2)", 4, 1, "')' was expected before 2"),
        ("2 * FOO", 5, 3, "a number or a variable was expected, found FOO"),
        ("* 2", 1, 1, "a number or a variable was expected, found *"),
        ("1.2.3", 4, 2, "an operator was expected before .3"),
    ],
)
def test_faults_of_writing_are_found_when_it_is_read(text, column, length, sentence):
    with pytest.raises(Alarm) as caught:
        parse(text, Span(7, 11))
    assert sentence in caught.value.message
    assert caught.value.span == Span(7, 10 + column, length)


@pytest.mark.parametrize(
    ("text", "column", "length", "sentence"),
    [
        ("Q1 + Q99", 6, 3, "no value was given to Q99"),
        ("1 / Q15", 3, 1, "division by zero at /"),
        ("2 DIV (Q1 - 2.5)", 3, 3, "division by zero at DIV"),
        ("SQRT Q2", 1, 4, "SQRT of -4 has no real value"),
        ("Q2 ^ 0.5", 4, 1, "no real power at ^"),
        ("Q15 ^ -1", 5, 1, "no real power at ^"),
        ("10 ^ 400", 4, 1, "no real power at ^"),
        ("1" + "0" * 308 + " * 100", 311, 1, "out of range at *"),
    ],
)
def test_faults_of_values_are_found_when_it_runs(text, column, length, sentence):
    expression = parse(text, Span(7, 11))
    with pytest.raises(Alarm) as caught:
        expression.evaluate(VARIABLES)
    assert sentence in caught.value.message
    assert caught.value.span == Span(7, 10 + column, length)


@given(st.text("Q12R.,+-*/^() SINDV", max_size=30))
def test_no_text_raises_anything_but_an_alarm(text):
    try:
        result = value(text)
    except Alarm as alarm:
        assert alarm.span is None or 1 <= alarm.span.column <= len(text) + 1
    else:
        assert math.isfinite(result)


DEEP = ["(" * 5000 + "1" + ")" * 5000, "-" * 5000 + "1", "1" + "+1" * 5000, "1" + "^1" * 5000]


@pytest.mark.parametrize("text", DEEP, ids=["brackets", "signs", "sums", "powers"])
def test_depth_does_not_break_it(text):
    try:
        assert value(text) in (1, 5001)
    except Alarm as alarm:
        assert "nested deeper" in alarm.message


def test_an_expression_keeps_how_it_was_written():
    expression = parse(" 3 * ( q5+1,5 ) ", Span(1, 4))
    assert expression.text == "3 * ( q5+1,5 )"
    assert [(token.text, token.span.column) for token in expression.tokens] == [
        ("3", 5), ("*", 7), ("(", 9), ("Q5", 11), ("+", 13), ("1.5", 14), (")", 18),
    ]  # fmt: skip

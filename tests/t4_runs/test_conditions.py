"""Conditions: what is read, what it means at many places, and that nothing but an Alarm comes of any text."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab.runs.conditions import FUNCTIONS, parse
from mnclab.text.alarm import Alarm

VALUES = {"x": np.array([-3.0, 0.0, 2.0, 5.0]), "z": np.array([1.0, -6.0, np.nan, 2.0]), "Q5": np.array([4.0, 3, 2, 1])}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("z < -5", [0, 1, 0, 0]),
        ("not z < -5", [1, 0, 0, 1]),  # where z is not known, neither holds
        ("q5 >= 3", [1, 1, 0, 0]),
        ("x = 2 or z > 1", [0, 0, 1, 1]),
        ("x == 2 and Q5 == 2", [0, 0, 1, 0]),
        ("-1 < x <= 2", [0, 1, 1, 0]),
        ("x^2 + 1 > 5", [1, 0, 0, 1]),
        ("-x^2 < 0", [1, 0, 1, 1]),  # minus binds less than a power
        ("2 * (x + 1) / 3 > 1", [0, 0, 1, 1]),
        ("abs(x) > 2.5", [1, 0, 0, 1]),
        ("sin(30 * Q5 / Q5) == 0.5", [1, 1, 1, 1]),
        ("(x < 0 or x > 4) and not Q5 > 3", [0, 0, 0, 1]),
        ("x != 0", [1, 0, 1, 1]),
        ("1 / x > 0", [0, 0, 1, 1]),
        ("x < 1 and x < 1 or z > 0", [1, 1, 0, 1]),
    ],
)
def test_meaning(text, expected):
    assert parse(text, VALUES).truth(VALUES).true.astype(int).tolist() == expected


@pytest.mark.parametrize(
    ("text", "column", "sentence"),
    [
        ("z <", 3, "expected"),
        ("z", 1, "compares something"),
        ("z < y", 5, "nothing of the name 'y'"),
        ("z << 3", 4, "expected"),
        ("z < 'a'", 5, "no part of a condition"),
        ("(z < 3) + 1 > 2", 1, "not a comparison"),
        ("z < 3 and 4", 1, "a comparison was expected"),
        ("sin z > 3", 5, "needs a bracket"),
        ("(z > 3", 6, "'.' was expected"),
        ("z > 3 z", 7, "an operator was expected"),
        ("(" * 200 + "z > 3", 52, "nested deeper"),
        ("x.real > 1", 2, "expected|no part"),
    ],
)
def test_what_is_refused_is_refused_at_its_place(text, column, sentence):
    with pytest.raises(Alarm, match=sentence) as caught:
        parse(text, VALUES)
    assert caught.value.span.column == column or "expected" in sentence
    assert "^" in str(caught.value)


PARTS = ["x", "z", "Q5", "3", "1.5", "+", "-", "*", "/", "^", "(", ")", "<", ">=", "==", "and", "or", "not", *FUNCTIONS]


@given(st.lists(st.sampled_from(PARTS), max_size=10).map(" ".join) | st.text("xzQ5 <>=()._'é", max_size=12))
def test_any_text_is_a_condition_or_an_alarm(text):
    try:
        condition = parse(text, VALUES)
    except Alarm:
        return
    truth = condition.truth(VALUES)
    assert not np.any(truth.true & truth.false)


NUMBERS = st.integers(0, 9).map(str) | st.sampled_from(["x", "Q5"])
SUMS = st.recursive(
    NUMBERS, lambda s: st.tuples(s, st.sampled_from("+-*"), s).map(lambda p: f"({''.join(p)})"), max_leaves=6
)


@given(SUMS, st.sampled_from(["<", "<=", ">", ">=", "==", "!="]), SUMS)
def test_arithmetic_is_that_of_python(left, sign, right):
    truth = parse(f"{left} {sign} {right}", VALUES).truth(VALUES)
    for k in range(4):
        names = {"x": float(VALUES["x"][k]), "Q5": float(VALUES["Q5"][k])}
        expected = eval(f"{left} {sign} {right}", {}, names)  # the test may: it made the text itself
        assert bool(np.broadcast_to(truth.true, 4)[k]) == expected

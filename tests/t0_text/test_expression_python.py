"""Formulas against Python's own arithmetic: 400 of them, made from a seed, written as programs and as Python."""

import math
import random

import pytest

from mnclab import Alarm
from mnclab.text.alarm import Span
from mnclab.text.expression import parse

VARIABLES = {"Q1": 2.5, "Q2": -4.0, "Q15": 0.75, "Q1999": 12.0, "QL3": 7.0, "QR4": 0.125}

#: Functions of the catalogue by their name, and what each is in Python.
FUNCTIONS = {
    "SQ": "(lambda a: a**2)",
    "SQRT": "math.sqrt",
    "SIN": "(lambda a: math.sin(math.radians(a)))",
    "COS": "(lambda a: math.cos(math.radians(a)))",
    "TAN": "(lambda a: math.tan(math.radians(a)))",
    "ASIN": "(lambda a: math.degrees(math.asin(a)))",
    "ACOS": "(lambda a: math.degrees(math.acos(a)))",
    "ATAN": "(lambda a: math.degrees(math.atan(a)))",
    "LN": "math.log",
    "LOG": "math.log10",
    "EXP": "math.exp",
    "NEG": "(lambda a: -a)",
    "INT": "math.trunc",
    "ABS": "abs",
    "FRAC": "(lambda a: a - math.trunc(a))",
    "SGN": "(lambda a: (a > 0) - (a < 0))",
}
OPERATORS = {"+": "+", "-": "-", "*": "*", "/": "/", "DIV": "/", "^": "**"}


def formula(rng, depth):
    """(as a program writes it, as Python does): precedence is left to each of them, brackets stand in both alike."""
    kind = rng.random()
    if depth == 0 or kind < 0.2:
        if rng.random() < 0.4:
            name = rng.choice(list(VARIABLES))
            return rng.choice([name, name.lower()]), name
        number = rng.choice([f"{rng.randint(0, 9)}", f"{rng.uniform(0, 20):.3f}", f".{rng.randint(1, 9)}"])
        return rng.choice([number, number.replace(".", ",")]), number
    if kind < 0.3:
        ours, theirs = formula(rng, depth - 1)
        return f"-{ours}", f"-{theirs}"
    if kind < 0.45:
        ours, theirs = formula(rng, depth - 1)
        return f"( {ours} )", f"({theirs})"
    if kind < 0.6:
        ours, theirs = formula(rng, depth - 1)
        name = rng.choice(list(FUNCTIONS))
        return f"{name}({ours})", f"{FUNCTIONS[name]}({theirs})"
    (left, one), (right, other) = formula(rng, depth - 1), formula(rng, depth - 1)
    if kind < 0.7:  # Python's own % takes the sign of the divisor
        return f"(({left}) % ({right}))", f"math.fmod({one}, {other})"
    mark = rng.choice(list(OPERATORS))
    blank = " " if mark.isalpha() or right[0] in "-" else rng.choice(["", " "])
    return f"{left}{blank or (' ' if mark == 'DIV' else '')}{mark}{blank}{right}", f"{one} {OPERATORS[mark]} {other}"


def cases():
    """Formulas whose value is a real number of moderate size."""
    rng, found = random.Random(620), []
    while len(found) < 400:
        ours, theirs = formula(rng, 4)
        try:
            value = float(eval(theirs, {"math": math, **VARIABLES}))
        except (ValueError, ZeroDivisionError, OverflowError, TypeError):  # a TypeError: the root of a negative number
            continue
        if abs(value) <= 1e9 and len(ours) > 4:
            found.append((ours, value))
    return found


def test_formulas_are_those_of_python():
    found = cases()
    assert len(set(found)) > 390
    used = " ".join(text for text, _ in found).upper()
    assert all(name in used for name in (*FUNCTIONS, *OPERATORS, "%"))
    for text, expected in found:
        value = parse(text, Span(1, 1)).evaluate(VARIABLES)
        assert value == pytest.approx(expected, rel=1e-12, abs=1e-12), text


@pytest.mark.parametrize("a", [-7.5, -3.0, 0.0, 2.25, 400.0])
@pytest.mark.parametrize("b", [-4.0, 0.5, 360.0])
def test_a_remainder_has_the_sign_of_what_is_divided(a, b):
    assert parse("QL1 % QL2", Span(1, 1)).evaluate({"QL1": a, "QL2": b}) == pytest.approx(a - b * math.trunc(a / b))


def test_the_example_of_a_remainder():
    assert parse("400 % 360", Span(1, 1)).evaluate({}) == 40


@pytest.mark.parametrize("seed", range(50))
def test_what_has_no_value_in_python_is_an_alarm(seed):
    rng = random.Random(seed)
    outside = {
        "SQRT": -rng.uniform(0.1, 9), "LN": -rng.uniform(0, 9), "LOG": 0.0, "ASIN": 1 + rng.uniform(0.01, 9),
        "ACOS": -1 - rng.uniform(0.01, 9), "EXP": 1000.0,
    }  # fmt: skip
    name = rng.choice(list(outside))
    with pytest.raises(Alarm) as caught:
        parse(f"3 + {name} Q7", Span(4, 10)).evaluate({"Q7": outside[name]})
    assert caught.value.span == Span(4, 14, len(name))

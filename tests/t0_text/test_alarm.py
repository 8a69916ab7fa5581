"""An alarm as people, editors, notebooks and programs see it."""

import html
import json
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab.text.alarm import ALARM, WARNING, Alarm, Span, by_place


class Text:
    """A program that is nothing but lines."""

    name = "demo.mnc"

    def __init__(self, *lines):
        self.lines = lines

    def line_text(self, line):
        return self.lines[line - 1]


def test_the_text_form_is_that_of_a_compiler():
    """The example of an alarm in the README of the wording: place, sentence, line, carets under the word."""
    alarm = Alarm("G83 K (depth of one peck) must be greater than 0, got 0", Span(2, 16, 2))
    alarm.source = Text("T1", "N40 G83 Z-30 R2 K0 F120")
    alarm.span = alarm.span._replace(column=17)
    assert str(alarm).split("\n") == [
        "demo.mnc:2:17: alarm: G83 K (depth of one peck) must be greater than 0, got 0",
        "    N40 G83 Z-30 R2 K0 F120",
        "                    ^^",
    ]
    assert alarm._render_traceback_() == str(alarm).split("\n")


def test_hint_and_severity():
    alarm = Alarm("no feed", Span(1, 1), WARNING, "write F", Text("G1 X1"))
    assert alarm.headline == "demo.mnc:1:1: warning: no feed (write F)"
    assert repr(alarm) == "Alarm('demo.mnc:1:1: warning: no feed (write F)')"


def test_without_a_place_there_is_no_caret():
    assert str(Alarm("there is no part")) == "alarm: there is no part"
    assert str(Alarm("there is no part", source=Text("X"))) == "demo.mnc: alarm: there is no part"
    assert str(Alarm("somewhere", Span(3, 4))) == "program:3:4: alarm: somewhere"


@given(st.text("XY \tЖ/0", max_size=12), st.integers(1, 14), st.integers(0, 20))
def test_carets_stand_under_the_word_and_end_with_the_line(line, column, length):
    """Tabs before the word are kept, so that carets stand right whatever the width of a tab."""
    text, carets = Alarm("", Span(1, column, length), source=Text(line)).lines()
    assert text == line
    assert carets.strip(" \t") == "^" * carets.count("^") and "^" in carets
    assert carets.index("^") == column - 1
    assert [c == "\t" for c in carets[: column - 1]] == [c == "\t" for c in line[: column - 1].ljust(column - 1)]
    assert carets.count("^") == max(1, min(length, len(line) - column + 1))


@given(st.text("<&>'\"xЖ\n", max_size=8), st.text("<&>x", max_size=8))
def test_html_shows_the_same_and_lets_no_markup_through(message, hint):
    alarm = Alarm(message, Span(1, 2, 3), ALARM, hint, Text("X<b>1</b>&"))
    shown = alarm._repr_html_()
    allowed = r"</?(?:div|span|pre|br|em)(?: (?:role|style)=\"[^\"<>]*\")*>"
    plain = re.sub(allowed, "", shown)
    assert "<" not in plain and ">" not in plain
    assert message in html.unescape(plain) and hint in html.unescape(plain)
    assert "X<b>1</b>&\n ^^^" in html.unescape(plain)


def test_as_json():
    alarm = Alarm("no feed", Span(3, 5, 2), WARNING, "write F", Text())
    assert json.loads(json.dumps(alarm.as_dict())) == {
        "file": "demo.mnc",
        "line": 3,
        "column": 5,
        "length": 2,
        "severity": "warning",
        "message": "no feed",
        "hint": "write F",
        "count": 1,
        "lines": [3],
    }
    nowhere = Alarm("x").as_dict()
    assert nowhere.pop("lines") == [] and set(nowhere.values()) == {None, "alarm", "x", "", 1}


def test_order_is_that_of_programs_and_lines():
    spans = [None, Span(2, 1, 1, 1), Span(9, 1), Span(2, 7), Span(2, 3)]
    ordered = by_place([Alarm(str(span), span) for span in spans])
    assert [alarm.span for alarm in ordered] == [Span(2, 3), Span(2, 7), Span(9, 1), Span(2, 1, 1, 1), None]


@pytest.mark.parametrize("program", ["X1\nY2 K5\n", "\tX1\n\tK5 \n", "\ufeffX1\r\nX3 K5"])
def test_an_alarm_of_a_run_shows_its_line(program):
    alarm = mnclab.run(program, "mnc").alarms[0]
    text, carets = alarm.lines()
    assert text == program.splitlines()[1]
    assert text[carets.index("^") : carets.index("^") + 2] == "K5" and carets.count("^") == 2


def test_strict_raises_the_first_alarm_and_says_where():
    with pytest.raises(Alarm, match=r"^program:2:4: alarm: K5 has no meaning"):
        mnclab.run("M8\nX1 K5\nX1 K5\n", "mnc", strict=True)

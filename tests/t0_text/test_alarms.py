"""Many alarms: those of a kind are counted, a card shows the first, a long line is quoted around its caret."""

import re
import tracemalloc

import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab.text.alarm import ALARM, KEPT, KINDS, PLACES, SHOWN, WARNING, WIDTH, Alarm, Alarms, Span, first_of, quoted

WRONG = {
    "words": "hello world foo\n", "letters": "X\n", "points": "1.2.3\n", "klartext": "1 L X+10 Y+20 R0 FMAX M3\n",
    "frames": "N1 Z@-200\n", "blocks": "N10 G1 X10.5 Y20 F100\n", "cyrillic": "Ж\n",
}  # fmt: skip


@given(st.lists(st.tuples(st.sampled_from([ALARM, WARNING]), st.sampled_from("abc"), st.integers(1, 30))))
def test_warnings_of_the_same_words_are_one(given):
    alarms = Alarms(Alarm(text, Span(line, 1), severity) for severity, text, line in given)
    assert alarms.total == len(given) == sum(alarm.count for alarm in alarms)
    for text in "abc":
        lines = [line for severity, which, line in given if severity == WARNING and which == text]
        kept = [alarm for alarm in alarms if alarm.severity == WARNING and alarm.message == text]
        assert [alarm.count for alarm in kept] == [len(lines)][: len(kept)] and len(kept) == bool(lines)
        for alarm in kept:
            assert [place.line for place in alarm.places] == list(dict.fromkeys(lines))[:PLACES]
    assert [a.span.line for a in alarms if a.severity == ALARM] == [line for severity, _, line in given if severity == ALARM]


def test_what_a_collected_warning_says():
    alarms = Alarms(Alarm("a helix", Span(line, 3), WARNING, "why") for line in range(4, 2777))
    assert str(alarms[0]) == "program:4:3: warning: a helix; 2772 more like it (lines 5, 6, 7, 8, …) (why)"
    assert "2772 more like it" in alarms[0]._repr_html_() and alarms[0].as_dict()["lines"] == [4, 5, 6, 7, 8]
    assert "; 1 more like it (line 9)" in str(Alarms([Alarm("a", Span(4, 1), WARNING), Alarm("a", Span(9, 1), WARNING)])[0])
    assert "; 2 more like it in this line" in str(Alarms(Alarm("a", Span(4, 1), WARNING) for _ in range(3))[0])


def test_alarms_of_a_kind_are_counted_after_the_first_thousand():
    """A kind is a sentence without its names and numbers."""
    alarms = Alarms(Alarm(f"X{k}.5 has no meaning, found 'x{k}'", Span(k, 2)) for k in range(1, 5001))
    assert len(alarms) == KEPT and alarms[-1].count == 4001 and len(alarms.untold) == 4000
    assert [place >> 32 for place in alarms.untold] == list(range(1001, 5001))
    alarms.append(Alarm("another", Span(1, 1)))
    assert alarms[-1].message == "another"
    many = Alarms(Alarm("".join("abcdefghij"[int(c)] for c in str(k)), Span(1, 1)) for k in range(5000))
    assert len(many) <= KEPT + KINDS and sum(alarm.count for alarm in many) == 5000


@pytest.mark.deep
@pytest.mark.parametrize("control", mnclab.controls)
@pytest.mark.parametrize("wrong", WRONG)
def test_thousands_of_wrong_lines(control, wrong):
    """Every line has its alarm or is counted; a card is short; the run stops at the first faulty line."""
    lines = 2000
    program = mnclab.read(WRONG[wrong] * lines, control)
    faults = sum(alarm.count for alarm in program.alarms)
    if not faults or (control, wrong) == ("nc-31", "blocks"):
        return  # this control reads such lines
    assert faults >= lines - 1 and len(program.alarms) <= 3 * KEPT
    run = mnclab.run(program)
    assert run.summary()["alarms"] + run.summary()["warnings"] >= faults and not run.ok
    assert len(run._repr_html_()) < 20_000 > len(repr(run)) and run._repr_html_().count('role="alert"') <= SHOWN
    assert re.search(r"… and (\d+ more (alarm|warning)s?( and )?)+, \d+ in all$", repr(run))
    assert len(program.faulty_blocks()) >= lines - 1 or control == "nc-31"


def test_a_fault_that_is_only_counted_still_stops_the_run():
    """The first thousand faulty blocks are passed over, the next is not."""
    text = "/X,1\n" * (KEPT + 5) + "G0 X1\nX,1\nX2\n"
    run = mnclab.run(text, "mnc", mnclab.Setup(settings={"block_skip": True}))
    assert not run.ok and run.toolpath.end[-1, 0] == 1
    stopped = [alarm for alarm in run.alarms if alarm.severity == ALARM]
    assert [alarm.span.line for alarm in stopped] == [KEPT + 7] and "only counted" in stopped[0].message
    assert "only counted" in str(run.explain(line=KEPT + 7))


@pytest.mark.parametrize("width", [84, WIDTH])
@given(st.text("abcX ", max_size=400), st.integers(0, 399), st.integers(1, 400))
def test_a_quote_is_as_wide_as_it_may_be_and_the_caret_under_its_word(width, text, at, length):
    at = min(at, len(text))
    program = mnclab.read(f"{text}|\n", "mnc")
    line, caret = Alarm("wrong", Span(1, at + 1, length), source=program).lines(width)
    assert max(len(line), len(caret)) <= width + 4
    assert caret.strip(" ").strip("^") == "" and f"{text}|"[at] == line[caret.index("^")]


def test_a_rest_of_one_is_one_and_names_what_there_is():
    def rest(alarms, warnings):
        return first_of([Alarm("a", Span(k, 1)) for k in range(alarms)] + [Alarm("w", severity=WARNING)] * warnings)[1]

    assert rest(21, 0) == "… and 1 more alarm, 21 in all" and rest(20, 1) == "… and 1 more warning, 21 in all"
    assert rest(22, 1) == "… and 2 more alarms and 1 more warning, 23 in all"


@pytest.mark.deep
def test_memory_of_many_alarms_is_bounded():
    tracemalloc.start()
    alarms = Alarms(Alarm(f"X{k} has no meaning in this block", Span(k, 2)) for k in range(30_000))
    size = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    assert size < 1_500_000 and alarms.total == 30_000


def test_a_card_shows_what_stopped_the_run_among_many_warnings():
    alarms = [Alarm(f"w{k}", Span(k, 1), WARNING) for k in range(100)]
    alarms.insert(70, Alarm("stopped", Span(70, 1)))
    shown, more = first_of(alarms)
    assert len(shown) == SHOWN and shown[-1].message == "stopped" and more == "… and 81 more warnings, 101 in all"
    assert first_of(alarms[:SHOWN]) == (alarms[:SHOWN], "")


@given(st.integers(0, 600), st.integers(0, 700))
def test_a_long_line_is_quoted_around_its_caret(length, at):
    line = "".join(chr(0x4E00 + k) for k in range(length))
    shown, place = quoted(line, at)
    assert len(shown) <= WIDTH + 4 and (length > WIDTH or shown == line)
    if at < length:
        assert shown[place] == line[at]
    else:
        assert place >= len(shown.removesuffix(" …"))


@pytest.mark.parametrize("control", mnclab.controls)
@pytest.mark.parametrize("piece", ["X", "X1 ", "Ж"])
def test_a_long_line_of_a_program_is_not_quoted_whole(control, piece):
    run = mnclab.run(piece * (5_000 // len(piece)) + "?\n", control)
    assert run.alarms
    first = run.alarms[:3]
    for text in (repr(run), run._repr_html_(), *map(str, first), *("".join(a._render_traceback_()) for a in first)):
        assert len(text) < 4000 + 12 * 600
    assert all(len(alarm.headline) < 2000 for alarm in run.alarms)

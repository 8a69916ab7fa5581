"""One meaning, many spellings (1.2, 1.4, 1.5); and nothing written is lost without a word."""

import re
import string
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tools import running

import mnclab
from mnclab import Alarm
from mnclab.path.toolpath import COLUMNS

CONTOUR = """\
G17 G90 G54 T1
S1200 M3
G0 X-20 Y-20 Z5
G1 Z-0.5 F100
G41 X0 Y0 F250
Y40
G2 X10 Y50 R12
G1 X40
G3 X50 Y40 I10 J0
G91 G1 Y-30.5
G90 X0 Y0
G40 X-20 Y-20
G0 Z5
M5
"""
HOLES = """\
G90 G55 G0 X0 Y0 Z50
G56 G92 X5 Y5
T2 S800 M3
G99 G83 X20 Y30 Z-25 R3 K10 P0.5 F120
X40
G98 X60 W14 K7
G80
G300 Q2 H-15 P5 Z0 F90 E0.2 T0.3
G0 X30 Y20 M99
G53 X0 Y0
"""
PLANES = """\
G18 G90 G0 X0 Z10
G3 X10 Z0 I0 K-10 F100
G19 G0 Y10 Z0
G2 Y0 Z-10 J-10 K0
G17 G1 X0.25 Y5
"""
FRAMES = """\
G55 G0 X5 Y5
G37 X2 Y2
G51 X25
G39 X10 Y10 A35
G1 X20 Y-7 F300
G3 X15 Y-2.5 R6
G36
G38
G50
G16 X20 Y20
G10 R15 A180
G13 A-60 K15
G91
G11 R-2 A10
G15
G90
S400 M3
G95 F0.25
G9 G1 X1 Y2
G4 P0.75
G61 G94 F120
G147 Q3
X0
"""
PROGRAMS = {"contour": CONTOUR, "holes": HOLES, "planes": PLANES, "frames": FRAMES}

WORD = re.compile(r"([A-Z])(-?)(\d+)(?:\.(\d+))?")


def each_word(text, spell):
    """Every word of a text spelled anew from its address, sign, digits and decimals."""
    return WORD.sub(lambda m: spell(m[1], m[2], m[3], m[4] or ""), text)


def number(sign, digits, decimals):
    return f"{sign}{digits}{'.' if decimals else ''}{decimals}"


def trailing(address, sign, digits, decimals):
    """X5 as X5. and X0.5 as X0.50."""
    return f"{address}{sign}{digits}.{decimals}{'0' if decimals else ''}"


def short(address, sign, digits, decimals):
    """X0.5 as X.5, X-2.5 stays."""
    return f"{address}{number(sign, '' if decimals and digits == '0' else digits, decimals)}"


def signed(address, sign, digits, decimals):
    """Words that describe motion may carry a plus."""
    return f"{address}{number(sign or '+' * (address in 'XYZIJKRUVW'), digits, decimals)}"


def by_lines(change):
    return lambda text: "".join(change(n, line) for n, line in enumerate(text.splitlines(keepends=True), 1))


SPELLINGS = {
    "without blanks": lambda text: text.replace(" ", ""),
    "many blanks": lambda text: text.replace(" ", "   "),
    "blank before the number": lambda text: each_word(text, lambda a, *n: f"{a} {number(*n)}"),
    "tabs": lambda text: text.replace(" ", "\t"),
    "indented": by_lines(lambda n, line: " \t" * (n % 3) + line),
    "blanks at the end": lambda text: text.replace("\n", "  \t\n"),
    "lower case": str.lower,
    "leading zeros": lambda text: each_word(text, lambda a, s, d, f: f"{a}{number(s, '00' + d, f)}"),
    "two digits": lambda text: each_word(text, lambda a, s, d, f: f"{a}{number(s, d.zfill(2), f)}"),
    "trailing zeros and points": lambda text: each_word(text, trailing),
    "no zero before the point": lambda text: each_word(text, short),
    "plus signs": lambda text: each_word(text, signed),
    "many digits": lambda text: each_word(text, lambda a, s, d, f: f"{a}{s}{d}.{f}{'0' * 30}"),
    "CR LF": lambda text: text.replace("\n", "\r\n"),
    "CR": lambda text: text.replace("\n", "\r"),
    "no end of the last line": lambda text: text.rstrip("\n"),
    "byte order mark": lambda text: "\ufeff" + text,
    "comments": by_lines(lambda n, line: line.replace("\n", f" // block {n}, X1 \u00d8 1,5 (\n")),
    "comments with a blank in their mark": lambda text: text.replace("\n", "/ / G1 X999\n"),
    "numbered": by_lines(lambda n, line: f"N{10 * n} {line}"),
    "numbered backwards": by_lines(lambda n, line: f"n{1000 - n}{line}"),
    "block skip, which is off": by_lines(lambda n, line: f"{('/', '/ ', '/N7 ')[n % 3] if n < 4 else '/'}{line}"),
    "words in reverse": by_lines(lambda n, line: " ".join(reversed(line.split())) + "\n"),
    "all at once": lambda text: "\ufeff" + by_lines(lambda n, line: f"\tn{n}{line.replace(' ', '')}")(
        each_word(text.lower().upper(), lambda a, s, d, f: signed(a.lower(), s, "0" + d, f))
    ).replace("\n", "// \r\n"),
}  # fmt: skip

run = partial(running.run, ok=None)


def same_path(one, other, exact=True):
    """Every column, the lines as well."""
    assert len(one) == len(other)
    for name in COLUMNS:
        assert np.array_equal(getattr(one, name), getattr(other, name), equal_nan=True), name


@pytest.mark.parametrize("spelling", SPELLINGS)
@pytest.mark.parametrize("name", PROGRAMS)
def test_a_spelling_changes_nothing(name, spelling):
    plain = run(PROGRAMS[name])
    text = SPELLINGS[spelling](PROGRAMS[name])
    assert text != PROGRAMS[name]
    other = run(text)
    assert plain.ok and len(plain.toolpath) > 4
    assert [a.message for a in other.alarms] == [a.message for a in plain.alarms]
    same_path(plain.toolpath, other.toolpath)
    same_path(plain.programmed, other.programmed)


@pytest.mark.parametrize("name", PROGRAMS)
def test_empty_lines_and_lines_of_comment_only_move_the_lines(name):
    plain = run(PROGRAMS[name]).toolpath
    other = run("// title\n\n" + PROGRAMS[name].replace("\n", "\n\n// between\n")).toolpath
    assert ((plain.line - 1) * 3 + 3 == other.line).all()
    assert np.array_equal(plain.end, other.end) and np.array_equal(plain.sweep, other.sweep)


def test_block_skip_when_it_is_on():
    text = "G0 X1\n/X2\n/N20 X3\nX4 /\n"
    skipping = mnclab.run(text.replace(" /", ""), "mnc", mnclab.Setup(settings={"block_skip": True}))
    assert skipping.toolpath.end[:, 0].tolist() == [1, 4]
    assert run(text.replace(" /", "")).toolpath.end[:, 0].tolist() == [1, 2, 3, 4]
    assert run(text).alarms[0].span[:2] == (4, 4)


@pytest.mark.parametrize("block", ["/X2,5", "/ N5 X1 X2", "/N1 X2", "/G1 X\u041610", "/G77 X5", "/L1", "/X"])
def test_a_fault_in_a_block_that_is_passed_over_is_no_alarm(block):
    """1.5: the block is not obeyed, so the program runs; what the reader saw in it is a warning. Without skip it stops."""
    text = f"N1 G0 X1\n{block}\nN10 X4\n"
    passed = mnclab.run(text, "mnc", mnclab.Setup(settings={"block_skip": True}), strict=True)
    assert passed.ok and all(alarm.span.line == 2 for alarm in passed.alarms)
    assert passed.toolpath.end[:, 0].tolist() == [1, 4]
    stopped = run(text)
    assert not stopped.ok and {alarm.severity for alarm in stopped.alarms} == {"alarm"}
    assert len(passed.alarms) <= len(stopped.alarms) and not mnclab.run(text.replace("/", ""), "mnc").ok


# --- nothing is lost --------------------------------------------------------------------------------------------------


def told(run):
    """All that a run shows: its rows, what was on after each step, and what it says."""
    rows = [np.asarray(getattr(run.toolpath, name), dtype=float).tobytes() for name in COLUMNS]
    state = [run.history.at(step) for step in range(len(run.steps.block))]
    return rows, state, [str(alarm) for alarm in run.alarms]


@pytest.mark.deep
@pytest.mark.parametrize("name", PROGRAMS)
def test_every_word_counts_under_any_other_address(name):
    """Another letter in place of an address is noticed: the path, the state or the alarms are others.

    Only words that say what holds anyway (G90 at the start) are left out: without them all stays the same. A word
    meets every third letter, three words meet them all.
    """
    text, checked = PROGRAMS[name], 0
    plain = told(run(text))
    for match in re.finditer(r"([A-Z])-?[\d.]+", text):
        if told(run(text[: match.start()] + text[match.end() :])) == plain:
            continue
        for letter in set(string.ascii_uppercase[checked % 3 :: 3]) - {match[1]}:
            changed = text[: match.start()] + letter + text[match.start() + 1 :]
            assert told(run(changed)) != plain, changed
        checked += 1
    assert checked > 12


UNUSED = "BLO"  # letters that no function and no cycle built so far takes


@pytest.mark.parametrize("name", PROGRAMS)
def test_an_unknown_word_is_an_alarm_at_its_place(name):
    lines = PROGRAMS[name].splitlines()
    for number_of_line, line in enumerate(lines, 1):
        for letter in UNUSED:
            text = "\n".join([*lines[: number_of_line - 1], f"{line} {letter}1", *lines[number_of_line:]])
            first = next(alarm for alarm in run(text).alarms if alarm.severity == "alarm")
            assert first.message.startswith(f"{letter}1 has no meaning in this block"), text
            assert first.span == (number_of_line, len(line) + 2, 2, 0)


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_word_written_again_is_an_alarm(name):
    """Every word of a program once more at the end of its block, with another value."""
    lines = PROGRAMS[name].splitlines()
    for k, line in enumerate(lines):
        for word in line.split():
            again = f"{word[0]}{float(word[1:]) + 1:g}"
            if word[0] in "GM":
                again = word
            text = "\n".join([*lines[:k], f"{line} {again}", *lines[k + 1 :]])
            first = next((alarm for alarm in run(text).alarms if alarm.severity == "alarm"), None)
            assert first is not None, text
            assert first.span[0] == k + 1 and "twice" in first.message, text


# --- nothing but alarms -----------------------------------------------------------------------------------------------

ALPHABET = "NGMXYZUVWIJKRQHPETFSDABO0123456789.,-+/ \t\r\n%(;#=[]*\u0425\u041e\u2028\xa0\0\ufeff\U0001f6e0"
mutation = st.tuples(st.integers(0, 600), st.integers(0, 6), st.text(ALPHABET, max_size=6))


def mutated(text, mutations):
    """A text with pieces cut out and others put in."""
    for at, cut, piece in mutations:
        at %= len(text) + 1
        text = text[:at] + piece + text[at + cut :]
    return text


def survives(source):
    """A run says what it has to say in alarms whose places exist."""
    found = mnclab.run(source, "mnc")
    for alarm in found.alarms:
        assert isinstance(alarm, Alarm) and str(alarm)
        assert 1 <= alarm.span.line <= len(found.program.line_starts)
        assert 1 <= alarm.span.column <= len(found.program.line_text(alarm.span.line)) + 1
    assert found.ok == all(alarm.severity != "alarm" for alarm in found.alarms)
    assert np.isfinite(found.toolpath.end).all()
    assert np.array_equal(found.toolpath.start[1:], found.toolpath.end[:-1])
    assert str(found.toolpath) or not len(found.toolpath)
    return found


@pytest.mark.deep
@settings(max_examples=300)
@given(st.sampled_from([*PROGRAMS.values()]), st.lists(mutation, max_size=5))
def test_mutated_programs_raise_nothing_but_alarms(text, mutations):
    survives(mutated(text, mutations) + "\n")


@settings(max_examples=100)
@given(st.lists(st.sampled_from(" ".join(PROGRAMS.values()).split()), max_size=60), st.data())
def test_words_in_any_order_raise_nothing_but_alarms(words, data):
    ends = data.draw(st.lists(st.sampled_from(" \n"), min_size=len(words), max_size=len(words)))
    survives("".join(word + end for word, end in zip(words, ends)) + "\n")


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.sampled_from([*PROGRAMS.values()]),
    st.lists(mutation, max_size=3),
    st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "cp1251", "koi8-r", "cp866", "latin-1", "utf-32", "ascii"]),
    st.lists(st.tuples(st.integers(0, 600), st.integers(0, 255)), max_size=5),
)
def test_files_of_any_bytes_raise_nothing_but_alarms(tmp_path, text, mutations, page, patches):
    data = bytearray(mutated(text, mutations).encode(page, errors="replace"))
    for at, byte in patches:
        data[at % max(len(data), 1) : at % max(len(data), 1) + 1] = bytes([byte])
    file = Path(tmp_path) / "part.mnc"
    file.write_bytes(bytes(data))
    survives(file)


ODD = ["", "\n", "\r", " ", "\ufeff", "\0", "N", "/", "//", "/ /", "G", "X1.5e308", "G1e9", "X" * 100_000, "/" * 10_000]
ODD += ["9" * 1_000_000, "X" + "9" * 1_000_000, "X1 " * 50_000, "G1" * 20_000, "X1\n" * 2_000 + "X", "\n" * 100_000]


@pytest.mark.parametrize("text", ODD, ids=lambda text: repr(text[:8]) + str(len(text)))
def test_odd_texts_raise_nothing_but_alarms(text):
    survives(text + "\n")

"""Programs of all controls, spoilt at random: nothing but alarms comes of them.

A small share runs with the tests. Any number by hand, in one process: seeds, and what raised, took more than two seconds
of processor or wanted more than a gigabyte, is printed as it is found::

    python tests/t5_controls/test_mutations.py 40000                # the seeds 0 to 39999 of every control
    python tests/t5_controls/test_mutations.py 500 7000 tnc-620     # the seeds 7000 to 7499 of one control
    python tests/t5_controls/test_mutations.py 1 7123 tnc-620 show  # prints the program of a seed before it runs
"""

import json
import random
import re
import resource
import signal
import sys
import time
import traceback
from functools import cache
from itertools import islice
from pathlib import Path

import pytest

import mnclab
from mnclab import Alarm

sys.path.insert(0, str(Path(__file__).parents[1] / "authorities"))
import iso_programs

pytestmark = pytest.mark.deep

TESTS = Path(__file__).resolve().parents[1]
SAMPLES = TESTS.parent / "data" / "programs"
CATALOGUE = TESTS / "authorities" / "catalogue"
CONTROL_OF = {"jnc-t01": "jnc-t01", "nc-31": "nc-31", "turning": "jnc-t01", "tnc620": "tnc-620", "programs-tnc-620": "tnc-620"}
CONTROLS = ["mnc", "jnc-t01", "nc-31", "g43", "tnc-620"]
LONGEST_TIME, MOST_MEMORY = 2.0, 1 << 30  # s of processor, bytes; told by hand only
PATIENCE = 20  # s after which a run by hand is given up

NUMBERS = [
    "0", "-0", "1", "-1", "0.001", "-0.001", "0.0000001", "999999", "-99999.999", "99999999", "1e9", "1e308", "nan", "inf",
    "9" * 40, "9" * 400, "." + "0" * 60 + "1", "4294967296", "2147483648", "32768", "65535", "360", "-360.0001", "1.2.3",
    "+-5", "--5", "5,5", ".", "-", "1/2", "0x10", "\u0661", "\u00b2",
]  # fmt: skip
PIECES = [
    "\ufeff", "\0", "\ud800", "\udfff", "\u0425", "\u041e", "\u2028", "\x85", "\xa0", "\x1c", "\U0001f6e0", "\t", " ", "\r",
    "\r\n", "\n", "\n\n", ";", "~", "/", "//", "%", "'", '"', "(", ")", "[", "]", "=", "#", "*", "@", "^", "+", "-", ".", ",",
    "\\", "Q1", "QS1", "QL1", "Q0", "Q1999", "{x}", "a" * 300, " " * 300, "(" * 60, "X", "Z", "G", "M", "N", "L ", "I",
    "#1", "#[#1]", "#[#[#1]]", "#0", "[#1 EQ 1]", "\nWHILE[#1 LT 9]DO1\n", "\nEND1\n", "\nIF[#1 GT 2]GOTO 10\n", "\nM98 P1\n",
    "\nG65 P1 A#1\n", "\nM99\n", "\nO1\n", "\nG66 P1\n", "SIN[", "**", "\nG68 X0 Y0 R30\n", "\nG51 P2.\n", "\nG92 X0\n",
    "*\nG98 L1*\n", "*\nL1,3*\n", "*\nD00 Q1 P01 +Q1*\n", "*\nG79*\n", "G91 ", "I+5 J+5 ", "*",
]  # fmt: skip
WORD = re.compile(r"[^\s]+")
NUMBER = re.compile(r"[+-]?\d+(?:[.,]\d+)?")


@cache
def programs(control):
    """Samples, examples of the manuals, and programs of the tests."""
    found = [file.read_text("utf-8") for file in sorted((SAMPLES / control).iterdir())]
    for file in sorted(CATALOGUE.glob("*.json")):
        of = next((name for start, name in CONTROL_OF.items() if file.name.startswith(start)), "mnc")
        entries = json.loads(file.read_text("utf-8"))
        if of == control or (of == "mnc" and control == "g43"):
            found += [entry["program"] for entry in entries if isinstance(entry, dict) and entry.get("program")]
    for folder in (TESTS / "programs", TESTS / "refused", TESTS / "recognition"):
        files = [file for file in sorted(folder.glob(f"{control}/*")) if file.suffix != ".expected"]
        found += [text_of(file) for file in files]
    if control == "g43":  # variables, loops and sub-programs
        found += [iso_programs.program(seed)[0] for seed in range(60)]
    return found


def text_of(file):
    """What stands in a file, whatever code page."""
    return mnclab.read(file, file.parent.name).text


@cache
def setup(control):
    """Programs that others call are there."""
    files = {file.name: file.read_text("utf-8") for file in sorted((SAMPLES / control).iterdir())}
    return mnclab.Setup(files={**files, "OTHER": programs(control)[0]})


def lines_moved(rng, text, control):
    """A line deleted, doubled, swapped with another, or joined with the next."""
    lines = text.split("\n")
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    way = rng.randrange(4)
    if way == 0:
        del lines[i]
    elif way == 1:
        lines.insert(j, lines[i])
    elif way == 2:
        lines[i], lines[j] = lines[j], lines[i]
    else:
        lines[i : i + 2] = [rng.choice(["", " "]).join(lines[i : i + 2])]
    return "\n".join(lines)


def words_moved(rng, text, control):
    """A word deleted, doubled, or put in another's place."""
    words = list(WORD.finditer(text))
    if not words:
        return text
    one, other = rng.choice(words), rng.choice(words)
    put = rng.choice(["", one.group() + " " + one.group(), one.group() * 2, other.group()])
    return text[: one.start()] + put + text[one.end() :]


def number_changed(rng, text, control):
    """An absurd number, one with another sign, or one digit more, less or different."""
    numbers = list(NUMBER.finditer(text))
    if not numbers:
        return text
    found = rng.choice(numbers)
    old, at = found.group(), rng.randrange(len(found.group()))
    put = rng.choice([
        rng.choice(NUMBERS), rng.choice(NUMBERS), "-" + old.lstrip("+-"), old + rng.choice("0123456789."),
        old[:at] + rng.choice("0123456789") + old[at + 1 :], old[:at] + old[at + 1 :],
    ])  # fmt: skip
    return text[: found.start()] + put + text[found.end() :]


def piece_put_in(rng, text, control):
    """A foreign piece, or some character, in place of up to three others."""
    at = rng.randrange(len(text) + 1)
    put = rng.choice([rng.choice(PIECES), chr(rng.randrange(128)), chr(rng.randrange(0x3000))])
    return text[:at] + put + text[at + rng.randrange(4) :]


def word_put_in(rng, text, control):
    """A word of another program, of this control or another."""
    other = rng.choice(programs(rng.choice([control, control, *CONTROLS]))).split()
    at = rng.choice([found.end() for found in WORD.finditer(text)] or [0])
    return text[:at] + " " + (rng.choice(other) if other else "X") + text[at:]


def lines_put_in(rng, text, control):
    """Some lines of another program of this control, more seldom of another control."""
    other = rng.choice(programs(rng.choice([control] * 9 + CONTROLS))).split("\n")
    begin, lines = rng.randrange(len(other)), text.split("\n")
    at = rng.randrange(len(lines) + 1)
    return "\n".join(lines[:at] + other[begin : begin + rng.randint(1, 12)] + lines[at:])


def cut_off(rng, text, control):
    """Half typed: the text ends somewhere, or a line does."""
    at = rng.randrange(len(text) + 1)
    end = text.find("\n", at)
    return text[:at] + (text[end:] if end >= 0 and rng.random() < 0.6 else "")


def repeated(rng, text, control):
    """A stretch many times over."""
    at = rng.randrange(len(text) + 1)
    return text[:at] + text[at : at + rng.randint(1, 40)] * rng.choice([2, 5, 50]) + text[at:]


def other_ends(rng, text, control):
    """Other line ends."""
    return text.replace("\n", rng.choice(["\r\n", "\r", "\n\r", "\x0b"]))


WAYS = [lines_moved, words_moved, number_changed, piece_put_in, word_put_in, lines_put_in, cut_off, repeated, other_ends]
OFTEN = [4, 4, 8, 4, 4, 3, 2, 1, 0.4]


def mutated(control, seed):
    """The program of a seed."""
    rng = random.Random(f"{control} {seed}")
    text = rng.choice(programs(control))
    for way in rng.choices(WAYS, OFTEN, k=rng.choice([1, 1, 2, 3, 5, 9])):
        text = way(rng, text, control)
    return text if rng.random() < 0.1 else text + "\n"


def survives(control, seed):
    """Reading, running and looking at the program of a seed raises nothing, and its alarms stand in the text."""
    text, rng = mutated(control, seed), random.Random(seed)
    if len(text) < 200 and "\n" not in text and "\r" not in text:
        text += "\n"  # what might be the name of a file is none
    program = mnclab.read(text, control)
    run = mnclab.run(program, setup=setup(control))
    for alarm in run.alarms:
        assert isinstance(alarm, Alarm) and str(alarm)
        assert alarm.span is None or (alarm.span.line >= 1 and alarm.span.column >= 1)
    assert str(run) and run._repr_html_()
    if len(run.toolpath) < 20_000:
        assert str(run.toolpath) or not len(run.toolpath)
    assert all(str(block) is not None for block in islice(program, 300))
    main = run.steps.program[:10_000] == 0  # run.at asks for lines of the main program
    lines = sorted({int(line) for line in run.lines()[:10_000][main]}) if len(run.steps.block) else []
    for line in rng.sample(lines, min(3, len(lines))):
        assert run.at(line).line == line
        assert str(run.explain(line))
    try:
        run.profile()
    except Alarm as alarm:
        assert str(alarm)
    return run


@pytest.mark.parametrize("hundred", range(2))
@pytest.mark.parametrize("control", CONTROLS)
def test_spoilt_programs_raise_nothing_but_alarms(control, hundred):
    for seed in range(100 * hundred, 100 * hundred + 60):
        survives(control, seed)


# --- by hand ----------------------------------------------------------------------------------------------------------


class TooLong(BaseException):
    """A program that takes longer than PATIENCE."""


def give_up(signal_number, frame):
    raise TooLong


def memory():
    """Bytes of address space of this process."""
    return int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()


def by_hand(count, first=0, control="", show=""):
    """Run the programs of many seeds and print what is wrong with them."""
    signal.signal(signal.SIGALRM, give_up)
    for name in [control] if control else CONTROLS:
        begin, bad = time.perf_counter(), 0
        for seed in range(first, first + count):
            if show:
                print(mutated(name, seed), flush=True)
            setup(name)
            most = memory() + MOST_MEMORY
            resource.setrlimit(resource.RLIMIT_AS, (most, resource.RLIM_INFINITY))
            clock = time.process_time()
            signal.alarm(PATIENCE)
            told = ""
            try:
                survives(name, seed)
            except BaseException as error:
                signal.alarm(0)
                if isinstance(error, KeyboardInterrupt):
                    raise
                frames = [frame for frame in traceback.extract_tb(error.__traceback__) if "mnclab" in frame.filename]
                told = f"{type(error).__name__}: {str(error)[:200]!r} at " + " < ".join(
                    f"{Path(frame.filename).name}:{frame.lineno}" for frame in frames[::-1][:6]
                )
            signal.alarm(0)
            took = time.process_time() - clock
            if told or took > LONGEST_TIME:
                bad += 1
                print(f"{name} {seed}: {took:.1f} s {told}", flush=True)
            if (seed + 1) % 2000 == 0:
                print(f"# {name}: {seed + 1} seeds, {time.perf_counter() - begin:.0f} s, {bad} to look at", flush=True)
        print(f"# {name}: {count} programs, {time.perf_counter() - begin:.0f} s, {bad} to look at", flush=True)


if __name__ == "__main__":
    sys.stdout.reconfigure(errors="backslashreplace")
    by_hand(*(int(word) if word.isdigit() else word for word in sys.argv[1:]))

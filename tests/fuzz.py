"""Programs of all controls, spoilt at random, and every parameter of every cycle with absurd values.

Nothing but alarms comes of them, no call takes more than two seconds of processor or a gigabyte, and what is not finite is
in no path. A small share runs with the tests. Any number by hand, in one process; what is wrong is printed as it is found,
and kept as a file with what happened at its head::

    python tests/fuzz.py --programs 40000 --seed 0             # of every control in turn: the seeds from 0 on
    python tests/fuzz.py --programs 1 --seed 7123 --control tnc-620 --show
    python tests/fuzz.py --cycles                              # of every control, by a program and by mnclab.steps
    python tests/fuzz.py --cycles --only "CYCL DEF 25" --control tnc-620
"""

import argparse
import gzip
import json
import random
import re
import resource
import signal
import sys
import tempfile
import time
import traceback
from functools import cache
from itertools import islice
from pathlib import Path

import numpy as np

import mnclab
from mnclab import Alarm
from mnclab.machine import trial

sys.path.insert(0, str(Path(__file__).parent / "authorities"))
import iso_programs
from tools import refusals

TESTS = Path(__file__).resolve().parent
SAMPLES = TESTS.parent / "data" / "programs"
CATALOGUE = TESTS / "authorities" / "catalogue"
CONTROL_OF = {"jnc-t01": "jnc-t01", "nc-31": "nc-31", "turning": "jnc-t01", "tnc620": "tnc-620", "programs-tnc-620": "tnc-620"}
CONTROLS = ["mnc", "jnc-t01", "nc-31", "g43", "tnc-620"]
LONGEST_TIME, MOST_MEMORY = 2.0, 1 << 30  # s of processor, bytes
LONGEST_TEXT = 20_000  # characters: a fault in a long program is one in a short one, and of those more run in an hour

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
    for folder in (TESTS / "programs", TESTS / "recognition"):
        files = [file for file in sorted(folder.glob(f"{control}/*")) if file.suffix != ".expected"]
        found += [text_of(file) for file in files]
    found += [refusal.text for refusal in refusals.of(control)]
    if control == "g43":  # variables, loops and sub-programs
        found += [iso_programs.program(seed)[0] for seed in range(60)]
        for name in ("iso_flow.json.gz", "iso_calls.json", "iso_words.json"):  # O words
            data = (TESTS / "authorities" / name).read_bytes()
            records = json.loads(gzip.decompress(data) if name.endswith("gz") else data)["records"]
            found += [record["text"] for record in records]
    return [text for text in found if len(text) < LONGEST_TEXT]


def text_of(file):
    """What stands in a file, whatever code page."""
    return mnclab.read(file, file.parent.name).text


@cache
def setup(control, dialect=""):
    """Programs that others call are there; perhaps another dialect."""
    files = {file.name: file.read_text("utf-8") for file in sorted((SAMPLES / control).iterdir())}
    settings = {"dialect": dialect} if dialect else {}
    return mnclab.Setup(files={**files, "OTHER": programs(control)[0]}, settings=settings)


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
    text = min(rng.choices(programs(control), k=2), key=len)  # short ones more often: more of them run in an hour
    for way in rng.choices(WAYS, OFTEN, k=rng.choice([1, 1, 2, 3, 5, 9])):
        text = way(rng, text, control)
    return text if rng.random() < 0.1 else text + "\n"


def survives(control, seed, runs=()):
    """Reading, running and looking at the program of a seed raises nothing, and its alarms stand in the text."""
    text, rng = mutated(control, seed), random.Random(seed)
    if len(text) < 200 and "\n" not in text and "\r" not in text:
        text += "\n"  # what might be the name of a file is none
    program = mnclab.read(text, control)
    dialect = "linuxcnc" if control == "g43" and seed % 2 else ""  # O words are obeyed there
    run = mnclab.run(program, setup=setup(control, dialect))
    for alarm in run.alarms:
        assert isinstance(alarm, Alarm) and str(alarm)
        assert alarm.span is None or (alarm.span.line >= 1 and alarm.span.column >= 1)
    finite(run)
    assert str(run)
    if len(run.toolpath) < 20_000:
        assert str(run.toolpath) or not len(run.toolpath)
    assert all(str(block) is not None for block in islice(program, 300))
    main = run.steps.program[:10_000] == 0  # run.at asks for lines of the main program
    lines = sorted({int(line) for line in run.lines()[:10_000][main]}) if len(run.steps.block) else []
    for line in rng.sample(lines, min(1, len(lines))):
        assert run.at(line).line == line
        assert str(run.explain(line))
    if runs == []:
        runs.append(run)
    return run


def finite(run):
    """What must be numbers in a path and a profile are."""
    path = run.toolpath
    for column in (path.start, path.end, path.sweep, path.rotary, path.spindle):
        assert np.isfinite(column).all()
    assert not np.isinf(path.centre).any() and not np.isinf(path.time).any()
    try:
        assert np.isfinite(run.profile().time)
    except Alarm as alarm:
        assert str(alarm)


SHOWN = {
    "card": lambda run, folder: run._repr_html_(),
    "collisions": lambda run, folder: run.collisions(),
    "player": lambda run, folder: run.save(folder / "player.html"),
    "picture": lambda run, folder: run.save(folder / "picture.svg"),
    "report": lambda run, folder: run.report(folder / "report.html"),
}


def shown(run, how):
    """A run is shown in one of these ways, or an alarm says why not."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            SHOWN[how](run, Path(folder))
        except Alarm as alarm:
            assert str(alarm)


# --- cycles -----------------------------------------------------------------------------------------------------------

ABSURD = [
    0, -0.0, 1e-320, 1e-9, 0.001, 0.5, 1.5, 1, 2, -1, 1000, 9999, 65535, 99999, 99999.9999, -99999.9999, 1e6, 999999999.0, 1e9,
    -1e9, 1e15, 1e308, float("nan"), float("inf"), "", "abc", "X Y", None, True, (1, 2), 10**400,
]  # fmt: skip


def cases(control, only=""):
    """Every cycle of a control, each of its parameters, each absurd value: (code, name, value)."""
    for code, cycle in mnclab.controls[control].cycles.items():
        if only in ("", code) and code == cycle.code:
            for parameter in cycle.parameters():
                for value in ABSURD:
                    yield code, parameter.name, value


def steps_survive(control, code, name, value):
    """The steps of a cycle are a table of numbers, or an alarm says why not."""
    try:
        steps = mnclab.steps(code, control, **{name: value})
        assert str(steps) and steps._repr_html_()
    except Alarm as alarm:
        assert str(alarm)


def program_survives(control, code, name, value):
    """The same cycle in a program: as the form of the cycle would write it."""
    if not isinstance(value, int | float) or value != value or abs(value) >= 1e16:
        return
    of, cycle = mnclab.controls[control], mnclab.controls[control].cycles[code]
    given = {p.name: trial.first_value(p) for p in cycle.parameters() if p.required or p.name == name or trial.written_first(p)}
    text = trial.program(of, cycle, given | {name: float(value)})
    if text is not None:
        run = mnclab.run(text + "\n", control, setup=of.trial_setup)
        finite(run)
        assert str(run) and run._repr_html_()


# --- by hand ----------------------------------------------------------------------------------------------------------


class TooLong(BaseException):
    """A call that takes longer than it may."""


def give_up(signal_number, frame):
    raise TooLong


def memory():
    """Bytes of address space of this process."""
    return int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()


def guarded(call, *given):
    """What a call raised, in a few words and as a traceback; nothing if nothing. It gets two seconds and a gigabyte."""
    resource.setrlimit(resource.RLIMIT_AS, (memory() + MOST_MEMORY, resource.RLIM_INFINITY))
    try:
        signal.setitimer(signal.ITIMER_PROF, LONGEST_TIME)
        call(*given)
        return "", ""
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        signal.setitimer(signal.ITIMER_PROF, 0)
        frames = [frame for frame in traceback.extract_tb(error.__traceback__) if "mnclab" in frame.filename]
        where = " < ".join(f"{Path(frame.filename).name}:{frame.lineno}" for frame in frames[::-1][:6])
        return f"{type(error).__name__}: {str(error)[:200]!r} at {where}", traceback.format_exc()
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        resource.setrlimit(resource.RLIMIT_AS, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))


class Found:
    """What was wrong: printed, and kept as files."""

    def __init__(self, folder):
        self.folder, self.calls, self.bad, self.begin = Path(folder), 0, 0, time.perf_counter()
        self.folder.mkdir(parents=True, exist_ok=True)
        signal.signal(signal.SIGPROF, give_up)

    def of(self, name, text, call, *given):
        """Make a call; `text` is what to keep of it beside its name."""
        self.calls += 1
        told, trace = guarded(call, *given)
        if told:
            self.bad += 1
            print(f"{name}: {told}", flush=True)
            file = self.folder / (re.sub(r"[^\w.=-]+", "_", name)[:120] + ".txt")
            file.write_text(f"{name}\n{trace}\n{text}", "utf-8", errors="backslashreplace")

    def say(self, what):
        print(f"# {what}: {self.calls} calls, {time.perf_counter() - self.begin:.0f} s, {self.bad} to look at", flush=True)


def fuzz_programs(found, names, count, first, show, often):
    for seed in range(first, first + count):
        for control in names:
            if show:
                print(mutated(control, seed), flush=True)
            text, runs = mutated(control, seed), []
            found.of(f"{control} {seed}", text, survives, control, seed, runs)
            if runs and seed % often == 0 and len(runs[0].toolpath) < 2000:
                for how in SHOWN:
                    found.of(f"{control} {seed} {how}", text, shown, runs[0], how)
        if (seed + 1 - first) % 1000 == 0:
            found.say(f"seeds {first} to {seed}")
    found.say(f"{count} seeds")


def fuzz_cycles(found, names, seed, only):
    """All cases, in an order that is a fair sample wherever it is broken off."""
    every = [(control, *case) for control in names for case in cases(control, only)]
    random.Random(seed).shuffle(every)
    for number, (control, code, name, value) in enumerate(every, 1):
        said = f"{control} {code} {name}={str(value)[:20]!r}"
        found.of(f"steps {said}", "", steps_survive, control, code, name, value)
        found.of(f"program {said}", "", program_survives, control, code, name, value)
        if number % 1000 == 0 or number == len(every):
            found.say(f"{number} of {len(every)} values")


def by_hand():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--programs", type=int, default=0)
    options.add_argument("--seed", type=int, default=0)
    options.add_argument("--shown", type=int, default=20, help="of so many programs one is shown in all ways")
    options.add_argument("--cycles", action="store_true")
    options.add_argument("--control", choices=CONTROLS)
    options.add_argument("--only", default="", help="the code of one cycle")
    options.add_argument("--show", action="store_true", help="print each program before it runs")
    options.add_argument("--found", default=Path(tempfile.gettempdir()) / "mnclab-fuzz", help="folder of what is wrong")
    given = options.parse_args()
    sys.stdout.reconfigure(errors="backslashreplace")
    names = [given.control] if given.control else CONTROLS
    for control in names:  # so that no call pays for what is read and imported once
        setup(control)
        for show in SHOWN:
            shown(mnclab.run(mnclab.read(programs(control)[0], control)), show)
    found = Found(given.found)
    if given.programs:
        fuzz_programs(found, names, given.programs, given.seed, given.show, given.shown)
    if given.cycles:
        fuzz_cycles(found, names, given.seed, given.only)


if __name__ == "__main__":
    by_hand()

"""The command `send`: a program as the control takes it, and beside it the sheets that the first run needs.

What the manuals leave open is adopted: CR LF at the end of each line, ASCII, and letters of the code page 1251 in comments of the
Russian controls of milling and turning. An NC-31 is keyed in: its listing has five frames a line, and says how many there are.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mnclab.controls.choice import renumber, run
from mnclab.machine.setup_file import load
from mnclab.path.listing import point
from mnclab.path.toolpath import Kind
from mnclab.runs.run import Run
from mnclab.shell.saying import ALARMS, CLEAN, program, say, sensible
from mnclab.text.alarm import Alarm, Span
from mnclab.text.file import replaced
from mnclab.text.given import shown
from mnclab.text.opening import opened

NAME = re.compile(r"[A-Za-z][\w-]{0,23}", re.ASCII)
FRAME = re.compile(r"^([ \t]*+(?:\d++[ \t]++)?(?:BEGIN|END)[ \t]++PGM)[ \t]++\S++", re.M | re.I)
DIN = re.compile(r"^([ \t]*+(?:N\d++[ \t]*+)?)%[^ \t\n*]++(?=[ \t]++G7[01]\b)", re.M | re.I)  # the head of a DIN/ISO program
FRAMES = 5  # of an NC-31 in a line of its listing


def klartext(text: str, name: str) -> str:
    """With the name of its file at its beginning and its end, unit and comments as they are, and numbered from 0."""
    if DIN.search(text):
        return DIN.sub(rf"\1%{name}", text)
    if not FRAME.search(text):
        text = f"BEGIN PGM {name} MM\n{text.strip()}\nEND PGM {name} MM\n"
    return renumber(FRAME.sub(rf"\1 {name}", text), "tnc-620")


def listing(text: str, name: str) -> str:
    """Frames in columns, to be keyed in and ticked off."""
    frames = [frame for line in text.splitlines() if (frame := line.partition(";")[0].strip())]
    rows = [frames[k : k + FRAMES] for k in range(0, len(frames), FRAMES)]
    lines = [f"[ ] {''.join(f'{frame:<14}' for frame in row).rstrip()}" for row in rows]
    return "\n".join([f"{name}: {len(frames)} frames", *lines])


class Form(NamedTuple):
    """How a control takes a program: the suffix of the file, its code page, and what is done to the text."""

    suffix: str
    page: str = "ascii"
    written: Callable[[str, str], str] = lambda text, _: text


FORMS = {
    "mnc": Form(".mnc", "cp1251"),
    "jnc-t01": Form(".jnc", "cp1251"),
    "nc-31": Form(".txt", "ascii", listing),
    "g43": Form(".nc", "ascii", lambda text, _: "\n".join(["%", *(x for x in text.splitlines() if x.strip() != "%"), "%"])),
    "tnc-620": Form(".H", "ascii", klartext),
}


def send(chosen: argparse.Namespace) -> int:
    """Write the program, set-up sheet, tool sheet and the list for the first run; nothing of a program that has an alarm."""
    setup = None if chosen.setup is None else sensible(load, chosen.setup)
    if chosen.exercise:
        setup = sensible(opened("mnclab.learning.exercise", "exercise"), chosen.exercise).setup
    result = run(program(chosen.file), chosen.control, setup)
    for alarm in result.alarms:
        say(alarm)
    crashes = result.collisions() if result.ok and result.stock is not None else ()
    for crash in crashes:
        print(f"mnclab: {crash}", file=sys.stderr)
    if not result.ok or len(crashes):
        print("mnclab: not sent: mend this first", file=sys.stderr)
        return ALARMS
    if called := ", ".join(Path(each.name).name for each in result.programs[1:]):
        print(f"mnclab: it calls programs that are files of their own, send them too: {called}", file=sys.stderr)
    folder, name = Path(chosen.output or "."), sensible(_name, chosen.name or Path(chosen.file).stem)
    form = FORMS.get(result.control.name, Form(Path(chosen.file).suffix))
    suffix = ".I" if result.control.name == "tnc-620" and DIN.search(result.program.text) else form.suffix
    content = _encoded(form.written(result.program.text, name), form.page)
    first = "\n".join(first_run(result))
    sensible(lambda: folder.mkdir(parents=True, exist_ok=True))
    for path, data in ((folder / f"{name}{suffix}", content), (folder / f"{name}_first_run.txt", first.encode())):
        with replaced(path) as beside:
            beside.write_bytes(data)
        print(path)
    print(sensible(result.setup_sheet, folder / f"{name}_setup.html"))
    print(sensible(result.tool_sheet, folder / f"{name}_tools.html"))
    return CLEAN


def _name(name: str) -> str:
    if not NAME.fullmatch(name):
        hint = "--name PLATE_1: a letter, then up to 23 letters, digits, _ or -"
        raise Alarm(f"the control does not take the name {shown(name)}", hint=hint)
    return name.upper()


def _encoded(text: str, page: str) -> bytes:
    """The bytes of a text with CR LF; an Alarm at the first letter that the control does not have."""
    for number, line in enumerate(text.splitlines(), 1):
        try:
            line.encode(page)
        except UnicodeEncodeError as error:
            hint = "write the comment in letters that it has"
            found = shown(line[error.start])
            raise Alarm(f"the control does not have the letter {found}", Span(number, error.start + 1), hint=hint) from None
    return "".join(f"{line}\r\n" for line in text.splitlines()).encode(page)


def first_run(result: Run) -> Iterator[str]:
    """What is done before the first run, and at which blocks the eye is on the tool."""
    path, profile, tools = result.toolpath, result.profile(), result.tools_that_cut[1]
    yield f"First run of {result.program.title}, {result.control.title}; {profile.time / 60:.1f} min at 100 %."
    yield ""
    blank = "; the blank is clamped as drawn" if result.stock is not None else ""
    yield f"[ ] zero points, tools and correctors are those of the sheets{blank}"
    yield "[ ] in the air first: zero point raised by more than the part is high, guard closed, hand at the stop"
    yield "[ ] single block on, rapid and feed override at the least; single block off when the first cut is seen"
    yield ""
    yield "Watch at these blocks; the place is that of the read-out when the block is done:"
    for row, why in watched(result):
        line, tool = int(path.line[row]), f", T{tools[row]}" if tools[row] else ""
        yield f"[ ] line {line}{tool}: {why}; {point(result.at(line=line).position, lathe=result.control.lathe)}"


def watched(result: Run) -> Iterator[tuple[int, str]]:
    """Rows of the path to look at, and why: of each tool the first rapid and the first cut; stops."""
    path, tools = result.toolpath, result.tools_that_cut[1]  # of a lathe without T, what each cycle takes
    change = np.flatnonzero(np.diff(tools, prepend=tools[:1] - 1))
    stops = np.flatnonzero((path.kind == Kind.STOP) & (path.program == 0))
    found = [(int(row), "the program stops") for row in stops]
    for begin, end in zip(change, [*change[1:], len(path)]):
        for kinds, why in (((Kind.RAPID,), "the tool comes; is the way free?"), ((Kind.LINE, Kind.ARC), "the first cut")):
            rows = begin + np.flatnonzero(np.isin(path.kind[begin:end], kinds) & (path.program[begin:end] == 0))
            found += [(int(row), why) for row in rows[:1]]
    yield from sorted(found)

"""Exercises from a shell: `mnclab exercise check FILE`, `mnclab exercise list`, `give`, and `mnclab grade`."""

from __future__ import annotations

import argparse
import json
import re
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Any

from mnclab.shell.saying import ALARMS, CLEAN, program, sensible, write_table
from mnclab.text.alarm import Alarm
from mnclab.text.file import decode, read, replaced
from mnclab.text.given import shown
from mnclab.text.opening import opened

FORBIDDEN = re.compile(r'[\\/:*?"<>|]')  # in the name of a folder
SAYING = 5.0  # s between two lines that say how far it is


def exercise(chosen: argparse.Namespace) -> int:
    """List exercises, show one, check a teacher's files, or write the folder for pupils."""
    return {"list": _list, "show": _show, "check": _check, "give": _give}[chosen.what](chosen)


def _list(chosen: argparse.Namespace) -> int:
    found = sensible(opened("mnclab.learning.exercise", "exercises"), chosen.control)
    if chosen.csv is None:
        print(found)
    else:
        sensible(write_table, chosen.csv, found.csv())
    return CLEAN


def _show(chosen: argparse.Namespace) -> int:
    for each in _named(chosen):
        print(f"{each!r}\n\n{each.task}\n")
        if each.program:
            print("\n".join(f"{k:4d}  {row}" for k, row in enumerate(each.program.rstrip().split("\n"), 1)), end="\n\n")
        for k, question in enumerate(each.questions, 1):
            print(f"{k}. {question.text}")
        wanted = sensible(opened("mnclab.learning.card", "wanted"), each)
        print("\n".join(f"- {sentence}" for sentence in wanted), end="\n\n" if wanted else "")
        if each.why:
            print(f"{each.why}\n")
        if chosen.answers:
            answers = sensible(opened("mnclab.learning.answers", "answers_of"), each.file)
            own = "\n[vary]" in each.file.read_text("utf-8")
            head = "answer, of the drawing before a name draws its dimensions:" if own else "answer:"
            print("\n".join([head, answers.model, *filter(None, [answers.why])]))
    return CLEAN


def _named(chosen: argparse.Namespace) -> list[Any]:
    if not chosen.names:
        raise Alarm("no exercise is named", hint=f"mnclab exercise {chosen.what} mnc-03")
    return [sensible(opened("mnclab.learning.exercise", "exercise"), name) for name in chosen.names]


def _check(chosen: argparse.Namespace) -> int:
    """Say what the files of exercises lack; status 1 where they lack anything."""
    missing, bad = opened("mnclab.learning.authoring", "missing"), False
    if not chosen.names:
        raise Alarm("no file is named", hint="mnclab exercise check mnc-03.toml")
    files = opened("mnclab.learning.exercise", "files")()
    for name in chosen.names:
        lacks = missing(files.get(name, Path(name)))
        bad |= bool(lacks)
        print(f"{name}: {'ready' if not lacks else 'not ready'}")
        for sentence in lacks:
            print(f"  {sentence}")
    return ALARMS if bad else CLEAN


def _give(chosen: argparse.Namespace) -> int:
    """Write the folder for pupils, or for a list of names a folder each."""
    give, folder = opened("mnclab.learning.giving", "give"), Path(chosen.output or "exercises")
    pupils = {folder: chosen.pupil}
    if chosen.pupils:
        listed = decode(read(chosen.pupils, chosen.pupils))[0].splitlines()
        names = [name for each in listed if (name := sensible(_folder, each.strip(" .")))]
        sensible(_apart, names)
        pupils = {folder / name: name for name in names}
    for place, pupil in pupils.items():
        for path in sensible(give, chosen.names, place, pupil):
            print(path)
    return CLEAN


def _folder(name: str) -> str:
    """The name of a pupil, as that of a folder, by which the class is graded."""
    if bad := FORBIDDEN.search(name):
        raise Alarm(f"a folder has no {shown(bad[0])} in its name, got {shown(name)}", hint="a name a line, letters and spaces")
    return name


def _apart(names: list[str]) -> None:
    """Two pupils of one name would share a folder, and where large and small letters are the same, Anna and anna too."""
    often = Counter(name.casefold() for name in names)
    for name in (name for name in names if often[name.casefold()] > 1):
        raise Alarm(f"two pupils have the name {shown(name)}", hint="write them apart: Anna B, Anna K")


def grade(chosen: argparse.Namespace) -> int:
    """Grade a program, or the folders of a class; status 1 where one has not passed."""
    path = program(chosen.file)
    if path.is_dir():
        return _class(path, chosen)
    name = chosen.exercise or path.stem
    own = sensible(opened("mnclab.learning.marking", "own"), chosen.exercises)
    given = path.with_name(f"{name}.toml")  # as `give` writes it beside the answer, with the dimensions of a pupil
    file = own.get(name.lower()) or (given if given.is_file() else name)
    if file is given:  # a pupil can change it
        print(f"mnclab: graded by {given}, which lies beside the answer", file=sys.stderr)
    found = sensible(opened("mnclab.learning.exercise", "exercise"), file).check(path)
    print(json.dumps(found.as_dict(), allow_nan=False) if chosen.json else found)
    return CLEAN if found.passed else ALARMS


def _class(folder: Path, chosen: argparse.Namespace) -> int:
    """Grade a class as the command line says; status 1 where an answer has not passed."""
    mark, class_page, named = (opened("mnclab.learning.marking", name) for name in ("mark", "class_page", "named"))
    said = time.monotonic()

    def told(done: int, of: int) -> None:
        nonlocal said
        if time.monotonic() > said + SAYING:
            said = time.monotonic()
            print(f"mnclab: graded {done} of {of}", file=sys.stderr)

    marks = mark(folder, neighbours=chosen.neighbours, exercises=chosen.exercises, told=told)
    if chosen.html:
        with replaced(chosen.html) as beside:
            beside.write_text(class_page(marks, named(folder.resolve()), chosen.exercises), encoding="utf-8")
    if chosen.csv is not None:
        sensible(write_table, chosen.csv, marks.csv())
    if chosen.json:
        print(json.dumps(marks.as_dicts(), ensure_ascii=False))
    elif chosen.csv is None and not chosen.html:
        print(marks)
    return CLEAN if all(each.passed for each in marks if each.handed_in) else ALARMS

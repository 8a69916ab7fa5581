"""Exercises from a shell: `mnclab exercise check FILE`, `mnclab exercise list`, `give`, and `mnclab grade`."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

from mnclab.shell.saying import ALARMS, CLEAN, program, sensible
from mnclab.text.alarm import Alarm
from mnclab.text.opening import opened


def exercise(chosen: argparse.Namespace) -> int:
    """List exercises, show one, check a teacher's files, or write the folder for pupils."""
    return {"list": _list, "show": _show, "check": _check, "give": _give}[chosen.what](chosen)


def _list(chosen: argparse.Namespace) -> int:
    print(sensible(opened("mnclab.learning.exercise", "exercises"), chosen.control))
    return CLEAN


def _show(chosen: argparse.Namespace) -> int:
    for each in _named(chosen):
        print(f"{each!r}\n\n{each.task}\n")
        if each.why:
            print(f"{each.why}\n")
        if chosen.answers:
            answers = sensible(opened("mnclab.learning.answers", "answers_of"), each.file)
            print("\n".join(["answer:", answers.model, *filter(None, [answers.why])]))
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
    give = opened("mnclab.learning.giving", "give")
    for path in sensible(give, chosen.names, chosen.output or "exercises", chosen.pupil):
        print(path)
    return CLEAN


def grade(chosen: argparse.Namespace) -> int:
    """Grade a program, or the folders of a class; status 1 where one has not passed."""
    path = program(chosen.file)
    if path.is_dir():
        return int(opened("mnclab.learning.marking", "mark_from_shell")(path, chosen))
    name = chosen.exercise or path.stem
    own = sensible(opened("mnclab.learning.marking", "own"), chosen.exercises)
    found = sensible(opened("mnclab.learning.exercise", "exercise"), own.get(name.lower(), name)).check(path)
    print(json.dumps(found.as_dict(), allow_nan=False) if chosen.json else found)
    return CLEAN if found.passed else ALARMS

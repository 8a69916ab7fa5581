"""One way to run a program in a test, and what tests read off its path."""

from __future__ import annotations

from dataclasses import fields

import mnclab
from mnclab import Run, Setup, Toolpath

ON_THE_MACHINE = {field.name for field in fields(Setup)}


def run(text: str, control: str = "mnc", *, ok: bool | None = True, before: str = "", after: str = "", **given) -> Run:
    """What a program does, with `before` and `after` written around it.

    `given` are fields of `Setup`; every other name is a setting of the control. `ok` says whether the program must run
    to its end (None: it does not matter).
    """
    setup = {name: given.pop(name) for name in ON_THE_MACHINE & given.keys()}
    setup["settings"] = setup.get("settings", {}) | given
    found = mnclab.run(f"{before}{text}{after}\n", control, Setup(**setup))
    assert ok in (None, found.ok), found.alarms
    return found


def lines(text: str) -> str:
    """A program that was written in one line, `|` between its blocks."""
    return text.replace("|", "\n")


def changed(program: str, **words: object) -> str:
    """A program with other values of Q parameters that stand one a line; None leaves a line out."""
    for address, value in words.items():
        (line,) = (line for line in program.splitlines(keepends=True) if line.strip().startswith(f"{address}="))
        program = program.replace(line, "" if value is None else f"{address}={value}\n")
    return program


def labels(path: Toolpath) -> list[str]:
    """The label of every row."""
    return [path.labels[k] for k in path.label]


def of_cycles(path: Toolpath) -> Toolpath:
    """The motion of the cycles of a TNC 620."""
    return path[path.is_motion & [label.startswith("CYCL DEF") for label in labels(path)]]


def labelled(path: Toolpath) -> list[tuple]:
    """Pairs of a motion and its label."""
    return list(zip(path.motion, labels(path.motion)))

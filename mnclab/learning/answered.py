"""The run of an answer: its program, or the given one with the tables that it writes, on the machine of the exercise."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

from mnclab.controls.choice import read_text
from mnclab.controls.choice import run as run_text
from mnclab.learning.exercise import Exercise
from mnclab.machine.setup import Setup
from mnclab.machine.setup_file import setup_of
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm
from mnclab.text.file import File, table_of
from mnclab.text.given import shown

MOST_BLOCKS = 20_000  # of an answer, text and repetitions: more is an endless loop, or not meant seriously
SUFFIXES = {"mnc": ".mnc", "tnc-620": ".h", "g43": ".nc", "jnc-t01": ".jnc", "nc-31": ".nc31"}


def run_of(exercise: Exercise, text: str) -> Run:
    """The program of an answer, or the given one on the machine of an answer, run on the machine of the exercise."""
    setup, program = exercise.setup, text
    if exercise.answer == "setup":
        setup, program = merged(setup, text, exercise.id), exercise.program
    setup = replace(setup, settings={**setup.settings, "most_blocks": MOST_BLOCKS}, source=None)
    read_one = read_text(program if program.endswith("\n") else program + "\n",
                         exercise.id + SUFFIXES[exercise.control], exercise.control)  # fmt: skip
    if len(read_one) > MOST_BLOCKS:
        raise Alarm(f"the answer has {len(read_one)} blocks, {MOST_BLOCKS} are allowed")
    return run_text(read_one, setup=setup)


@cache
def given_run(exercise: Exercise) -> Run:
    """The run of the program that an exercise gives."""
    return run_of(replace(exercise, kind="write"), exercise.program)


ANSWERED = ("tools", "datums", "presets", "correctors")


def merged(setup: Setup, text: str, name: str) -> Setup:
    """The machine of an exercise with the tables that an answer writes, row by row."""
    file = File(f"{name}.toml", text)
    table = table_of(text)
    for key in table:
        if key not in ANSWERED:
            raise Alarm(f"an answer has no table {shown(key)}", file.place_of(key), hint=f"it has {', '.join(ANSWERED)}")
    given = setup_of(table, file)
    tables: dict[str, Any] = {name: {**(getattr(setup, name) or {}), **getattr(given, name)} for name in table}
    return replace(setup, **tables, source=None)

"""Exercises in files: TOML as a teacher writes it, read with alarms that show the line."""

from __future__ import annotations

import base64
import zlib
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from mnclab.controls import CONTROLS
from mnclab.design.model.design_file import either_of
from mnclab.learning.exercise import KINDS, LEVELS, WEIGHTS, Asked, Cut, Exercise, Question
from mnclab.learning.neighbours import varied
from mnclab.machine.setup import Setup
from mnclab.machine.setup_file import setup_of
from mnclab.path.tool import Tool
from mnclab.text.alarm import Alarm
from mnclab.text.file import File, as_table, as_tables, check_names, parse, table_of
from mnclab.text.given import check_number, choice, shown, whole

#: The format, as help shows it: an exercise that is ready.
FORMAT = Path(__file__).with_name("example.toml").read_text("utf-8")

#: What stands only in the teacher's file.
APART = ("model", "other", "faults")
TOP = ("sealed", "pupil", "title", "control", "level", "lesson", "kind", "task", "tolerance", "why", "design", "setup")
KNOWN = (*TOP, "vary", "asked", "weights", "given", "questions", *APART)
GIVEN = ("template", "program", "until")
MOST_SEALED = 100_000  # bytes
NEEDED = TOP[2:8]
QUANTITIES = ("x", "y", "z", "tip x", "tip y", "tip z", "feed", "speed", "tool", "length", "time")
STRATEGY = ("engagement", "time", "lifts", "feed")
OF_STRATEGY = {"part": 0.2, "asked": 0.8, "economy": 0.0}  # any strategy clears the pocket
TRAVEL = ((-1000.0, 1000.0),) * 3  # mm from the machine's zero, of the machine of an exercise that says nothing of it


def load(path: str | Path, pupil: str = "") -> Exercise:
    """The exercise of a file, with the dimensions of a pupil; an Alarm names what is wrong in it and shows the line."""
    try:
        stamp = Path(path).stat().st_mtime_ns
    except (OSError, ValueError):
        stamp = 0
    return _read(Path(path), stamp, pupil)


@cache
def _read(path: Path, stamp: int, pupil: str) -> Exercise:
    return parse(path, lambda table, file: exercise_of(table, file, path, pupil), "exercise")


def exercise_of(table: Mapping[str, Any], file: File, path: Path, pupil: str = "") -> Exercise:
    """The exercise that a table writes; its id is the name of the file."""
    check_names(table, KNOWN, "an exercise", file)
    if "sealed" in table:
        with file.at("sealed"):
            table = {**table, "setup": {**as_table(table.get("setup", {}), "setup"), **_unsealed(table["sealed"])}}
    table = varied(table, path.stem.lower(), pupil or str(table.get("pupil", "")), file)
    for name in NEEDED:
        if name not in table:
            raise Alarm(f"an exercise needs {name}", hint="mnclab help exercise shows the format")
    found: dict[str, Any] = {"id": path.stem.lower(), "file": path}
    for name in (*NEEDED, "why", "tolerance"):
        if name in table:
            with file.at(name):
                found[name] = _plain(name, table[name])
    found["setup"] = setup_of(as_table(table["setup"], "setup"), file.within("setup")) if "setup" in table else Setup()
    if "design" in table:
        with file.at("design"):
            found["design"] = _design(table["design"], file)
    if "design" in found and found["setup"].stock is None:  # a blank is said once
        found["setup"] = replace(found["setup"], stock=found["design"].blank)
    limits = found["setup"].limits
    found["setup"] = replace(found["setup"], limits=replace(limits, travel=limits.travel or TRAVEL))
    found["asked"] = _asked(as_table(table.get("asked", {}), "asked"), file)
    if "weights" in table:
        found["weights"] = _weights(as_table(table["weights"], "weights"), file)
    elif found["kind"] == "strategy":
        found["weights"] = OF_STRATEGY
    found |= _given(as_table(table.get("given", {}), "given"), file)
    each = enumerate(as_tables(table.get("questions", []), "questions"))
    found["questions"] = tuple(_question(as_table(one, "a question"), file, str(k)) for k, one in each)
    made = Exercise(**found)
    _check_whole(made, file)
    return made


def _unsealed(text: Any) -> dict[str, Any]:
    """What a pupil's copy does not show of its setup (see `answers`)."""
    try:
        packed = base64.b64decode(text, validate=True)
        return dict(table_of(zlib.decompressobj().decompress(packed, MOST_SEALED).decode())["setup"])
    except (Alarm, TypeError, ValueError, KeyError, zlib.error):
        raise Alarm("what is sealed was changed", hint="ask for the file anew") from None


def _plain(name: str, value: Any) -> Any:
    """A value at the top of the file."""
    if name == "level":
        if whole(value, "level") not in LEVELS:
            raise Alarm(f"level must be {LEVELS[0]} to {LEVELS[-1]}, got {value}")
        return int(value)
    if name == "tolerance":
        check_number(value, "tolerance (mm)", above=0)
        return float(value)
    text = _text(value, name)
    if name in ("kind", "control"):
        return choice(text, name, {"kind": KINDS, "control": CONTROLS}[name])
    return text.strip()


def _text(value: Any, name: str) -> str:
    if not isinstance(value, str) or not value.strip():
        raise Alarm(f"{name} must be a text, got {shown(value)}")
    return value


def _design(given: Any, file: File) -> Any:
    """The design of a table, or of a file that is seen from this one."""
    if isinstance(given, str):
        from mnclab.design.model import Design

        return Design.load(Path(file.name).parent / given)
    return either_of(as_table(given, "design"), file.within("design"))


def _given(table: Mapping[str, Any], file: File) -> dict[str, Any]:
    check_names(table, GIVEN, "given", file, "given")
    found: dict[str, Any] = {}
    for name, value in table.items():
        with file.at("given", name):
            found[name] = whole(value, name) if name == "until" else _text(value, name)
    return found


def _asked(table: Mapping[str, Any], file: File) -> Asked:
    names = Asked.__dataclass_fields__
    check_names(table, names, "asked", file, "asked")
    found: dict[str, Any] = {}
    for name, value in table.items():
        with file.at("asked", name):
            if name in ("must", "must_not"):
                if not isinstance(value, list):
                    raise Alarm(f'{name} must be a list of codes, ["G41"], got {shown(value)}')
                found[name] = tuple(_text(each, f"a code of {name}") for each in value)
            elif name == "values":
                found[name] = {key: limits(each, key) for key, each in as_table(value, name).items()}
            elif name == "strategy":
                check_names(as_table(value, name), STRATEGY, name, file, "asked", name)
                for key, each in value.items():
                    check_number(each, key, at_least=0)
                found[name] = dict(value)
            elif name == "cabinet":
                found[name] = tuple(as_table(each, name) for each in as_tables(value, name))
                for each in found[name]:
                    check_names(each, Tool.__dataclass_fields__, name, file, "asked", name)
            elif name == "cutting":
                found[name] = tuple(_cut(as_table(each, name)) for each in as_tables(value, name))
            else:
                check_number(value, name, above=0)
                found[name] = whole(value, name) if name == "blocks" else float(value)
    return Asked(**found)


def _cut(table: Mapping[str, Any]) -> Cut:
    if unknown := [name for name in table if name not in Cut._fields]:
        raise Alarm(f"cutting has no {shown(unknown[0])}", hint=f"known: {', '.join(Cut._fields)}")
    if "tool" not in table:
        raise Alarm("cutting needs the number of a tool")
    return Cut(whole(table["tool"], "tool"), **{name: limits(value, name) for name, value in table.items() if name != "tool"})


def limits(value: Any, name: str) -> tuple[float, float]:
    """Two numbers, the least and the greatest that are right."""
    least, most = value if isinstance(value, list) and len(value) == 2 else (1, 0)
    for each in (least, most):
        check_number(each, name)
    if not least <= most:
        raise Alarm(f"{name} must be [least, greatest], got {shown(value)}")
    return float(least), float(most)


def _weights(table: Mapping[str, Any], file: File) -> dict[str, float]:
    check_names(table, WEIGHTS, "weights", file, "weights")
    for name, value in table.items():
        with file.at("weights", name):
            check_number(value, f"the weight of {name}", at_least=0)
    return {name: float(table.get(name, 0)) for name in WEIGHTS}


def _question(table: Mapping[str, Any], file: File, place: str) -> Question:
    check_names(table, Question._fields, "a question", file, "questions", place)
    with file.at("questions", place):
        for name in ("text", "what"):
            _text(table.get(name), f"{name} of a question")
        given = dict(table)
        given["what"] = choice(table["what"], "what", QUANTITIES)
        if "line" in table:
            given["line"] = whole(table["line"], "line")
        check_number(table.get("tolerance", 0.001), "tolerance", above=0)
        given["hints"] = tuple(_text(each, "a hint") for each in table.get("hints", []))
    return Question(**given)


def _check_whole(made: Exercise, file: File) -> None:
    """An Alarm where parts of an exercise do not go together."""
    cuts = made.answer in ("program", "setup", "strategy")
    if made.design is None and cuts and not (made.asked.values or made.asked.cutting):
        raise Alarm(f"an exercise of kind {made.kind!r} needs a design, or values that are asked for")
    if made.answer == "numbers" and not made.questions:
        raise Alarm("an exercise of kind 'predict' needs questions", file.place_of("kind"))
    if not made.program and (made.answer in ("setup", "numbers") or made.kind == "restart"):
        raise Alarm(f"an exercise of kind {made.kind!r} needs the program that is given: [given] program", file.place_of("kind"))
    if (made.until is None) == (made.kind == "restart"):
        raise Alarm("until, the line at which the tool broke, belongs to kind 'restart' alone", file.place_of("kind"))
    if not sum(made.weights.values()) > 0:
        raise Alarm("weights must not all be 0", file.place_of("weights"))

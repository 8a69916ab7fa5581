"""The folder for pupils: tasks and drawings as pages, files to begin with, exercises without their answers."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from mnclab.learning.answered import SUFFIXES
from mnclab.learning.answers import pupils_copy
from mnclab.learning.card import card, page
from mnclab.learning.exercise import files
from mnclab.learning.exercise_file import load
from mnclab.text.alarm import Alarm
from mnclab.text.file import decode, read, reason, replaced
from mnclab.text.given import fitting, shown

RANGE = re.compile(r"([a-z0-9-]+)-(\d+)\.\.(?:\1-)?(\d+)")
LESSONS = re.compile(r"(\d\d)(?:-(\d\d))?")


def _known(names: Sequence[str]) -> dict[str, Path]:
    """The files of exercises by id, those among the names too."""
    return files() | {Path(name).stem.lower(): Path(name) for name in names if name.lower().endswith(".toml")}


def chosen(names: Sequence[str]) -> Iterator[str]:
    """The ids that names mean: one, a file (mine.toml), a range (mnc-03..mnc-09), lessons (05, 12-19), or a control, all of it;
    an Alarm for what is none."""
    known = _known(names)
    for name in names:
        name = Path(name).stem if name.lower().endswith(".toml") else name
        span, lessons = RANGE.fullmatch(name.lower()), LESSONS.fullmatch(name)
        if lessons:
            wanted = [id for id, path in known.items() if lessons[1] <= load(path).lesson <= (lessons[2] or lessons[1])]
        elif span:
            wanted = [f"{span[1]}-{k:02}" for k in range(int(span[2]), int(span[3]) + 1)]
        else:
            wanted = [name.lower()] if name.lower() in known else [each for each in known if each.startswith(f"{name.lower()}-")]
        if not wanted or not set(wanted) <= set(known):
            told = "mnclab exercise list; mnc-03, mnc-03..mnc-09, lessons 12-19, or mnc"
            raise Alarm(f"there is no exercise {shown(name)}", hint=told)
        yield from wanted


@fitting
def give(names: Sequence[str], folder: str | Path = "exercises", pupil: str | None = None) -> list[Path]:
    """Write the exercises with these ids, or of these files, into a folder: for each a page with task and drawing, the file
    without its answers, and one to begin the answer in, which is not written again. The paths.

    With the name of a `pupil` the dimensions that vary are that pupil's.
    """
    folder, made = Path(folder), []
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Alarm(f"{folder} cannot be made: {reason(error)}") from None
    known = _known(names)
    for name in chosen(names):
        exercise, copy = load(known[name], pupil or ""), folder / f"{name}.toml"
        text = pupils_copy(known[name])
        if "[model]" in decode(read(known[name], name))[0] and copy.exists() and copy.samefile(known[name]):
            raise Alarm(f"{copy} has the answers: the copy without them would take its place", hint="give another folder: -o")
        if pupil:
            if any("\ud800" <= c <= "\udfff" for c in pupil):
                raise Alarm("the name of a pupil has a byte that is no letter", hint="write names in UTF-8")
            text = f"pupil = {json.dumps(pupil, ensure_ascii=False)}\n{text}".replace("\x7f", "\\u007f")  # which TOML has not
        begun = folder / f"{name}{SUFFIXES[exercise.control] if exercise.answer == 'program' else '.txt'}"
        written = {copy: text, folder / f"{name}.html": page(exercise.title, card(exercise))}
        if not begun.exists():
            written[begun] = exercise.begins or "\n"
        for path, content in written.items():
            with replaced(path) as beside:
                beside.write_text(content, encoding="utf-8", newline="\n")
            made.append(path)
    return made

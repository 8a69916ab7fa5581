"""What stands in a teacher's file alone: the model, a right answer of another make, typical faults; and pupils' copies."""

from __future__ import annotations

import base64
import re
import zlib
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

from mnclab.learning.exercise_file import APART
from mnclab.text.alarm import Alarm
from mnclab.text.file import File, as_table, as_tables, check_names, parse, read, table_of
from mnclab.text.given import shown

#: The first line of what is kept from pupils.
MODEL = re.compile(r"^\[model\][ \t]*(?:#.*)?$", re.MULTILINE)


class Fault(NamedTuple):
    """Lines of the model written anew, None where one is taken away, and words that one of the hints must have."""

    edits: Mapping[int, str]
    hint: str

    def of(self, model: str) -> str:
        """The faulty answer."""
        lines = model.split("\n")
        return "\n".join(self.edits.get(k, line) for k, line in enumerate(lines, 1) if self.edits.get(k, line) or not line)


class Answers(NamedTuple):
    """The model, a right answer of another make, the faults, and the answer to the question why."""

    model: str
    other: str = ""
    faults: tuple[Fault, ...] = ()
    why: str = ""


def answers_of(path: Path) -> Answers:
    """The answers in the file of an exercise; an Alarm where there is no model."""
    return parse(path, _answers, "exercise")


def _answers(table: Mapping[str, Any], file: File) -> Answers:
    if "model" not in table:
        raise Alarm("this copy of the exercise has no solution", hint="the file of the teacher has it")
    model = as_table(table["model"], "model")
    check_names(model, ("answer", "why"), "model", file, "model")
    other = as_table(table.get("other", {}), "other")
    check_names(other, ("answer",), "other", file, "other")
    texts = [each.get("answer", "") for each in (model, other)] + [model.get("why", "")]
    for name, text in zip(("model", "other", "model"), texts):
        with file.at(name):
            if not isinstance(text, str):
                raise Alarm(f"an answer must be a text, got {shown(text)}")
    each = enumerate(as_tables(table.get("faults", []), "faults"))
    faults = tuple(_fault(as_table(one, "a fault"), texts[0], file, str(k)) for k, one in each)
    return Answers(texts[0], texts[1], faults, texts[2])


def _fault(table: Mapping[str, Any], model: str, file: File, place: str) -> Fault:
    check_names(table, Fault._fields, "a fault", file, "faults", place)
    lines = len(model.split("\n"))
    with file.at("faults", place):
        edits, hint = as_table(table.get("edits", {}), "edits"), table.get("hint", "")
        if not edits or not isinstance(hint, str) or not hint:
            raise Alarm("a fault needs edits, { line = \"text\" }, and the words of a hint")
        for key, text in edits.items():
            if not (key.isascii() and key.isdigit() and 0 < int(key) <= lines and isinstance(text, str)):
                raise Alarm(f"an edit is a line of the model (1 to {lines}) and its new text, got {shown(key)} = {shown(text)}")
    return Fault({int(key): text for key, text in edits.items()}, hint)


SEALED = ("stock", "true_tools")


def pupils_copy(path: Path) -> str:
    """The text of an exercise without its answers; an Alarm where they are not its end, or where some of them would be left."""
    text = read(path, "the exercise").decode("utf-8-sig")
    found = MODEL.search(text)
    kept = text[: found.start()].rstrip() + "\n" if found else text
    table = _table(kept)
    if table is None or set(table) & set(APART):
        raise Alarm(f"{path}: the answers must stand last, [model] before the others")
    if table.get("kind") != "set up":
        return kept
    kept = _sealed(kept)
    if _left(_table(kept)):
        raise Alarm(f"{path}: stock and true_tools are kept from pupils: write each in one line below [setup], or as a table")
    return kept


def _table(text: str) -> dict[str, Any] | None:
    with suppress(Alarm):
        return table_of(text)
    return None


def _left(table: dict[str, Any] | None) -> bool:
    """Whether a text that is no table of its own, or one of a setup, has what is sealed."""
    return table is None or any(name in table.get("setup", {}) for name in SEALED)


def _sealed(text: str) -> str:
    """A copy that does not show how the tools truly are nor where the blank stands: that is the answer, and grading needs it."""
    open_: list[str] = []
    values: list[str] = []
    tables: list[str] = []
    hidden = inside = False
    for line in text.splitlines(keepends=True):
        table = _table(line) or {}
        if line.lstrip().startswith("[") and table:
            hidden, inside = _left(table), table == {"setup": {}}
        (tables if hidden else values if inside and not table.keys().isdisjoint(SEALED) else open_).append(line)
    if not (values or tables):
        return text
    packed = zlib.compress("".join(["[setup]\n", *values, *tables]).encode(), 9)
    return f'sealed = "{base64.b64encode(packed).decode()}"\n' + "".join(open_)

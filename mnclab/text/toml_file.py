"""Files that people write (TOML): read, and checked so that an alarm shows the line that is wrong."""

from __future__ import annotations

import re
import tomllib
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

from mnclab.text.alarm import Alarm, Span
from mnclab.text.file import read
from mnclab.text.given import shown
from mnclab.text.nearest import hint

Result = TypeVar("Result")

KEY = r"""(?:[\w-]+|"[^"]*"|'[^']*')"""
PATH = rf"{KEY}(?:[ \t]*\.[ \t]*{KEY})*"
WRITTEN = re.compile(rf"^[ \t]*\[\[?[ \t]*({PATH})[ \t]*\]|(?:^|[{{,])[ \t]*({PATH})[ \t]*=")
DEEPEST = 50  # parts of a dotted key
LARGEST = 1_000_000  # bytes of a file


class File:
    """The text of a file, so that an alarm can show a line of it."""

    def __init__(self, name: str, text: str) -> None:
        self.name, self._lines = name, text.splitlines()

    @property
    def end(self) -> Span:
        return Span(len(self._lines), len(self._lines[-1]) + 1) if self._lines else Span(1, 1)

    def line_text(self, line: int) -> str:
        return self._lines[line - 1] if 0 < line <= len(self._lines) else ""

    def place_of(self, *keys: str) -> Span | None:
        """Where a value is written that keys lead to, or something in it, else the table that it is in; None if nowhere."""
        written = list(self._written())
        found = [(len(path), span) for path, span in written if path == list(keys[: len(path)])]
        found += [(len(keys), span) for path, span in written if path[: len(keys)] == list(keys)]
        return max(found, key=lambda each: each[0])[1] if found else None

    def _written(self) -> Iterator[tuple[list[str], Span]]:
        """The keys of every table and value, the outer ones before it, and the place of the last of them.

        A table of a list `[[name]]`, and a row of a list whose brackets stand on lines of their own, has its number in the
        list, from "0", after the name; what is in a table is found with that number and without it.
        """
        count: Counter[str] = Counter()
        table: list[str] = []
        item: tuple[list[str], list[str]] = ([], [])  # the table of a list without and with its number
        rows: list[str] = []  # the list whose rows stand on the next lines
        for number, line in enumerate(self._lines, 1):
            outer = table
            if rows and line.strip().startswith("]"):
                rows = []
            elif rows and line.strip().startswith(("[", "{")):
                outer = [*rows, str(count[str(rows)])]
                count[str(rows)] += 1
                yield outer, Span(number, len(line) - len(line.lstrip()) + 1)
            table_of_line = outer
            for found in WRITTEN.finditer(line):
                header, key = found.groups()
                keys = [*re.finditer(KEY, header or key)]
                path = [each[0].strip("\"'") for each in keys]
                place = Span(number, found.start(1 if header else 2) + keys[-1].start() + 1, len(keys[-1][0]))
                if header:
                    table = path
                    if line.lstrip().startswith("[["):
                        item = path, [*path, str(count[str(path)])]
                        count[str(path)] += 1
                else:
                    path = [*outer, *path]
                    outer = path if outer is table_of_line and not rows else outer  # keys after the first are within it
                yield path, place
                if item[0] and path[: len(item[0])] == item[0]:
                    yield [*item[1], *path[len(item[0]) :]], place
                if not header and not rows and line.split("#")[0].rstrip().endswith("["):
                    rows = path

    @contextmanager
    def at(self, *keys: str) -> Iterator[None]:
        """Alarms raised here show where keys get their value."""
        try:
            yield
        except Alarm as alarm:
            alarm.span = alarm.span or self.place_of(*keys)
            raise


def parse(path: str | Path, build: Callable[[dict[str, Any], File], Result], what: str) -> Result:
    """What `build` makes of the table in a TOML file; alarms show the line of the file."""
    if not isinstance(path, str | Path) or not str(path):
        raise Alarm(f"the {what} must be the name of a file, got {shown(path)}")
    file = File(str(Path(path)), "")
    try:
        text = read(Path(path), f"the {what}", LARGEST).decode("utf-8-sig")
        file = File(file.name, text)
        return build(table_of(text), file)
    except UnicodeDecodeError:
        raise Alarm(f"the {what} cannot be read: it is not UTF-8", source=file) from None
    except tomllib.TOMLDecodeError as error:
        place = re.search(r"line (\d+), column (\d+)", str(error))
        span = Span(int(place[1]), int(place[2])) if place else file.end
        raise Alarm(re.sub(r" \(at .*\)", "", str(error)), span, source=file) from None
    except Alarm as alarm:
        alarm.source = file
        raise


def table_of(text: str) -> dict[str, Any]:
    """The table that a text writes; an Alarm for one that Python would take hours for."""
    for number, line in enumerate(text.splitlines() if text.count(".") > DEEPEST else (), 1):
        deep = 0
        for part in line.split("."):
            deep = deep + 1 if part.strip().replace("-", "").replace("_", "").isalnum() else 0
            if deep > DEEPEST:
                raise Alarm(f"a key has more than {DEEPEST} parts", Span(number, 1))
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise Alarm("tables or lists are nested too deeply") from None
    except tomllib.TOMLDecodeError:
        raise
    except ValueError as error:  # of a number of some thousand digits
        raise Alarm(f"a value cannot be read: {error}") from None


def check_names(table: Mapping[str, Any], known: Any, where: str, file: File, *keys: str) -> None:
    """An Alarm for the first name that is not known; `keys` lead to the table in the file."""
    for name in table:
        if name not in known:
            with file.at(*keys, name):
                near = hint(name[:40], known, 1) or f"known: {', '.join(known)}"
                raise Alarm(f"{where} has no {shown(name)}", hint=near)


def as_table(value: Any, where: str) -> Mapping[str, Any]:
    """A value as a table; an Alarm where it is none."""
    if not isinstance(value, dict):
        raise Alarm(f"{where} must be a table, got {shown(value)}", hint=f"write [{where}] on a line of its own")
    return value


def as_tables(value: Any, where: str) -> list[Any]:
    """A value as a list of tables, which are not looked at; an Alarm where it is none."""
    if not isinstance(value, list):
        raise Alarm(f"{where} must be a list of tables, got {shown(value)}", hint=f"write [[{where}]] before each")
    return value

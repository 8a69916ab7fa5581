"""Files of a user: read whole and within a bound, decoded, checked, and written beside before they take their place."""

from __future__ import annotations

import codecs
import os
import re
import stat
import time
import tomllib
import zlib
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from inspect import signature
from pathlib import Path
from typing import Any, TypeVar

from mnclab.text.alarm import Alarm, Span, hint
from mnclab.text.given import shown

#: The folder of `notebooks` and `data`: in the sources that of the house, in an installed mnclab one within.
COURSE = next((each for each in [Path(__file__).parents[1] / "course"] if each.is_dir()), Path(__file__).parents[2])

# Which code page the bytes of a program are written in.

_BY_FREQUENCY = "ъёфэщцюшжхйчбзгьыяупдмклврстниаео"  # Russian letters, the rarest first
_LIKE_LATIN = "АВЕЗКМНОРСТХУ"


def decode(data: bytes) -> tuple[str, str]:
    """Text of bytes in UTF-8, UTF-16 (with its mark), CP1251 or KOI8-R, and the name of the code page.

    Every byte is a letter in both Cyrillic pages, but a wrong reading has rare letters in place of frequent ones, and
    capitals after small letters. A few letters decide nothing: then it is CP1251, the page of Windows.
    """
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", errors="replace"), "utf-16"
    try:
        return data.decode("utf-8-sig"), "utf-8"
    except UnicodeDecodeError:
        windows, koi = (_russian(data.decode(page, errors="replace")) for page in ("cp1251", "koi8-r"))
        page = "koi8-r" if koi > windows + 20 else "cp1251"
        return data.decode(page, errors="replace"), page


def encode_like(text: str, before: str, data: bytes, page: str) -> bytes:
    """The bytes of a text that was made of `before`, which was read from `data`; an Alarm where that cannot be exact."""
    marks = {codecs.BOM_UTF8: "utf-8", codecs.BOM_UTF16_LE: "utf-16-le", codecs.BOM_UTF16_BE: "utf-16-be"}
    mark = next((mark for mark in marks if data.startswith(mark)), b"")
    page = marks.get(mark, page)
    if mark + before.encode(page, "replace") != data:
        raise Alarm(f"the file holds bytes that are no letters of {page}, and cannot be written back as they are")
    return mark + text.encode(page)


def _russian(text: str) -> int:
    """How much a text looks like Russian; a letter by itself is a slip for a Latin one, and looks like it."""
    words = re.findall("[а-яёА-ЯЁ]+", text)
    letters = sum(sum(map(_BY_FREQUENCY.find, word.lower())) for word in words if len(word) > 1)
    slips = sum(len(word) == 1 and word.upper() in _LIKE_LATIN for word in words)
    return letters + 40 * (slips - len(re.findall("[а-яё][А-ЯЁ]", text)))


# Files of a user: read whole and within a bound, written beside and then put in their place.
# Read are files alone, no device and no pipe, which may never end or never begin. A file that is written is either whole or
# as it was: the new one grows under a name of its own in the same folder and takes the place at the end.

MOST_MEGABYTES = 100  # of a part program
MEGABYTE = 1_000_000
OLD = 3600  # s
NO_FILE = "it is no file, but a folder, a device or a pipe"


def reason(error: OSError | ValueError) -> str:
    """Why a file cannot be opened, in words; a ValueError is that of a name with a NUL in it."""
    return error.strerror or str(error) if isinstance(error, OSError) else "no file has such a name"


def read(path: str | Path, what: str | Path, most: int = MOST_MEGABYTES * MEGABYTE) -> bytes:
    """The bytes of a file; an Alarm that begins with `what` if it cannot be read, is no file, or is too large."""
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):
            raise Alarm(f"{what} cannot be read: {NO_FILE}")
        with open(path, "rb", opener=_without_waiting) as file:
            content = file.read(most + 1)
    except (OSError, ValueError) as error:
        raise Alarm(f"{what} cannot be read: {reason(error)}") from None
    if len(content) > most:
        hint = f"the setting most_megabytes allows more than {most // MEGABYTE}" if most >= MOST_MEGABYTES * MEGABYTE else ""
        raise Alarm(f"{what} cannot be read: it has more than {most // MEGABYTE} MB", hint=hint)
    return content


def _without_waiting(path: str, flags: int) -> int:
    """Open a file, even if it has just become a pipe, without waiting for a writer."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


@contextmanager
def replaced(path: str | Path) -> Iterator[Path]:
    """A new file to write, which takes the place of `path` at the end, or is gone if anything fails.

    The target of a symbolic link is replaced and the link stays; the new file has the mode of the old one and the same
    suffix under another name. An Alarm if it cannot be written.
    """
    try:
        target = Path(os.path.realpath(path))
        mode = os.stat(target).st_mode if target.exists() else None
        if mode is not None and not stat.S_ISREG(mode):
            raise Alarm(f"{path} cannot be written: {NO_FILE}")
        mark = f".{zlib.crc32(os.fsencode(target.name)):08x}-"  # the same for each save of this file
        _swept(target.parent, mark)
        beside = target.with_name(f"{mark}{os.urandom(8).hex()}{target.suffix}")
        os.close(os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666))
    except (OSError, ValueError) as error:
        raise Alarm(f"{path} cannot be written: {reason(error)}") from None
    try:
        yield beside
        with open(beside, "rb+") as file:
            os.fsync(file.fileno())  # what a full disk does not take is known here, not after the old file is gone
        if mode is not None:
            os.chmod(beside, stat.S_IMODE(mode))
        os.replace(beside, target)
    except OSError as error:
        raise Alarm(f"{path} cannot be written: {reason(error)}") from None
    finally:
        beside.unlink(missing_ok=True)


def _swept(folder: Path, mark: str) -> None:
    """Take away what saves of a file left that were killed: it is old, for a save ends soon."""
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.startswith(mark) and time.time() - entry.stat().st_mtime > OLD:
                Path(entry.path).unlink(missing_ok=True)


def named(path: str | Path, known: Collection[str], refused: str) -> tuple[Path, str]:
    """The path of a file and its suffix, which is one of the known ones; an Alarm where it is not, in `refused` words."""
    if not isinstance(path, str | Path):
        raise Alarm(f"a file is written to a path, got {shown(path)}")
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in known:
        what = refused.format(suffix) if suffix else f"{path.name!r} has no suffix to say what to write"
        raise Alarm(what, hint=f"known: {', '.join(known)}")
    return path, suffix


CONTROLS = {code: "\N{REPLACEMENT CHARACTER}" for code in (*range(9), *range(14, 32), *range(127, 160))}
CONTROL_BYTES = bytes(code for code in CONTROLS if code < 128)


def printable(text: str) -> str:
    """A text that can be written: half a pair of surrogates, which is no letter, becomes a question mark, and a control
    character, which no font has, the sign for what cannot be shown."""
    data = text.encode("utf-8", "replace")
    text = data.decode()
    if len(data.translate(None, CONTROL_BYTES)) == len(data) and (text.isascii() or not re.search("[\x80-\x9f]", text)):
        return text  # as most texts, and all long ones
    return text.translate(CONTROLS)


def save_as(what: Any, path: str | Path, writers: Mapping[str, Callable[..., None]], refused: str, **options: Any) -> Path:
    """Write something by the function that writes files of this suffix, `write(what, path, **options)`; the path.

    An Alarm, in `refused` words, where none does, and where one that takes no options is given some.
    """
    path, suffix = named(path, writers, refused)
    writer = writers[suffix]
    if options and len(signature(writer).parameters) == 2:
        raise Alarm(f"{suffix} files have no options, got {', '.join(options)}")
    with replaced(path) as beside:
        writer(what, beside, **options)
    return path


# Files that people write (TOML): read, and checked so that an alarm shows the line that is wrong.

Result = TypeVar("Result")

KEY = r"""(?:[\w-]+|"[^"]*"|'[^']*')"""
PATH = rf"{KEY}(?:[ \t]*\.[ \t]*{KEY})*"
WRITTEN = re.compile(rf"^[ \t]*\[\[?[ \t]*({PATH})[ \t]*\]|(?:^|[{{,])[ \t]*({PATH})[ \t]*=")
DEEPEST = 50  # parts of a dotted key
LARGEST_TOML = 1_000_000  # bytes of a file


class File:
    """The text of a file, so that an alarm can show a line of it."""

    def __init__(self, name: str, text: str, inside: tuple[str, ...] = ()) -> None:
        self.name, self._lines, self._inside = name, text.splitlines(), inside

    def within(self, *keys: str) -> File:
        """The same file, whose keys are those in a table of it."""
        return File(self.name, "\n".join(self._lines), (*self._inside, *keys))

    @property
    def end(self) -> Span:
        return Span(len(self._lines), len(self._lines[-1]) + 1) if self._lines else Span(1, 1)

    def line_text(self, line: int) -> str:
        return self._lines[line - 1] if 0 < line <= len(self._lines) else ""

    def place_of(self, *keys: str) -> Span | None:
        """Where a value is written that keys lead to, or something in it, else the table that it is in; None if nowhere."""
        written, keys = list(self._written()), (*self._inside, *keys)
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
        text = read(Path(path), f"the {what}", LARGEST_TOML).decode("utf-8-sig")
        file = File(file.name, text)
        return build(table_of(text), file)
    except UnicodeDecodeError:
        raise Alarm(f"the {what} cannot be read: it is not UTF-8", source=file) from None
    except Alarm as alarm:
        alarm.source = file
        raise


def table_of(text: str) -> dict[str, Any]:
    """The table that a text writes; an Alarm at its line for what is none, and for one that Python would take hours for."""
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
    except tomllib.TOMLDecodeError as error:
        raise _misread(text, str(error)) from None
    except ValueError as error:  # of a number of some thousand digits
        raise Alarm(f"a value cannot be read: {error}") from None


LONG_STRING = re.compile(r"(\"{3}|'{3}).*?\1", re.DOTALL)
COMMA = re.compile(rf"[ \t]*{PATH}[ \t]*=[ \t]*(([+-]?\d+),(\d+))[ \t]*(?:#.*)?")
BRACKET = re.compile(r"""\"(?:\\.|[^"\\])*+\"?|'[^']*+'?|\#.*|[][{}]""")
BEGINS = re.compile(rf"[ \t]*(?:\[\[?[ \t]*[A-Za-z_]|{PATH}[ \t]*=)")  # a table, or a value of one: nothing in a list does


def _misread(text: str, error: str) -> Alarm:
    """What is wrong in a text that is no table, where it is written: a list without its end is noticed in a later line."""
    lines = LONG_STRING.sub(lambda found: "\n" * found[0].count("\n"), text).split("\n")
    place = re.search(r"line (\d+), column (\d+)", error)
    at = (int(place[1]), int(place[2])) if place else (len(text.splitlines()), len((text.splitlines() or [""])[-1]) + 1)
    if found := COMMA.fullmatch(lines[at[0] - 1].rstrip("\r")):
        return Alarm(f"a number has a point: write {found[2]}.{found[3]}", Span(at[0], found.start(1) + 1, len(found[1])))
    opened: list[Span] = []
    for number, line in enumerate(lines[: at[0]] if "value" in error or "array" in error else (), 1):
        if opened and BEGINS.match(line):
            break
        for sign in BRACKET.finditer(line):
            if sign[0] in "[{":
                opened.append(Span(number, sign.start() + 1))
            elif sign[0] in "]}" and opened:
                opened.pop()
    else:
        opened = [] if place else opened
    return Alarm("the bracket is not closed", opened[-1]) if opened else Alarm(re.sub(r" \(at .*\)", "", error), Span(*at))


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

"""Many programs checked at once: what ran, what was refused and why, as a table of files and one of reasons."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Executor, ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from html import escape
from pathlib import Path
from signal import SIG_IGN, SIGINT, signal
from typing import Any, NamedTuple

from mnclab.controls import CONTROLS
from mnclab.controls.choice import run
from mnclab.machine.setup import Setup
from mnclab.text.alarm import ALARM, WARNING, Alarm, amounts, several
from mnclab.text.given import fitting, shown, whole
from mnclab.text.opening import progress
from mnclab.text.tables import Listing, html_table, text_table

RAN, REFUSED, NOT_READ = "ran", "refused", "not read"
#: Suffixes of part programs that many makers share, beside those of the controls.
SHARED = (
    ".anc .arc .cnc .din .dnc .eia .fan .fnc .gcd .gcode .hnc .iso .min .mpf .nc .ncc .ncd .nci .ngc .out .pgm .pim .pm "
    ".prg .ptp .sbp .spf .tap .txt"
).split()
SHOWN = 200  # rows of a table in a notebook
TOGETHER = 32  # files that a process is given at a time
WIDE = 90  # characters of a sentence in a table
COUNTED = 110  # letters of a row from which on counts have room in it
_VALUES = re.compile(
    r"'[^']{2,}'|\"[^\"]*\"|(?<![\w.])(?<!DEF )(?<!PROBE )(?<!FN )(?:[-+]|\b)\d++(?:\.\d++)?(?!\w)", re.ASCII
)
_WORDS = re.compile(r"\b([XYZABCUVWIJKFRSNPHDO])[-+]?\d++(?:\.\d++)?\b")


class Checked(NamedTuple):
    """What became of a file. `first` is the alarm that stopped it (None: it ran); `control` is empty where none was found."""

    file: str
    status: str
    control: str = ""
    blocks: int = 0
    moves: int = 0
    alarms: int = 0
    warnings: int = 0
    first: Alarm | None = None

    @property
    def line(self) -> int | None:
        """The line of the first alarm, in its program."""
        return self.first.span.line if self.first and self.first.span else None

    @property
    def reason(self) -> str:
        """Why it did not run: the sentence of its first alarm without values; empty where it ran."""
        return reason(self.first.message.replace(self.file, "the file")) if self.first else ""

    def as_dict(self) -> dict[str, Any]:
        """The row for programs that read JSON."""
        return self._asdict() | {"first": self.first.as_dict() if self.first else None, "reason": self.reason}


class Reason(NamedTuple):
    """A reason, how many files were stopped by it, and the first of them with its line."""

    reason: str
    files: int
    example: str


@dataclass(frozen=True, repr=False)
class Survey(Listing):
    """What became of many files; `interrupted` where Ctrl-C ended it before the last.

    It shows itself as a table of reasons and one of files; `rows` and `reasons` are these, `ok` whether all ran.
    """

    HEAD = ("file", "control", "blocks", "alarms", "warnings", "result")
    NUMBERS = (2, 3, 4)
    rows: tuple[Checked, ...]
    folder: str = ""
    interrupted: bool = False

    def texts(self) -> list[tuple[str, ...]]:
        """What became of each file, in short."""
        return [_cells(row) for row in self.rows]

    @property
    def ok(self) -> bool:
        return all(row.status == RAN for row in self.rows) and not self.interrupted

    @property
    def reasons(self) -> tuple[Reason, ...]:
        """Why files did not run, those of most files first."""
        found: dict[str, list[Checked]] = {}
        for row in self.rows:
            if row.first:
                found.setdefault(row.reason, []).append(row)
        told = (Reason(why, len(rows), place_of(rows[0])) for why, rows in found.items())
        return tuple(sorted(told, key=lambda one: -one.files))

    def count(self, status: str) -> int:
        return sum(row.status == status for row in self.rows)

    @property
    def summary(self) -> str:
        """How many ran, were refused, were not read."""
        parts = [f"{self.count(status)} {status}" for status in (RAN, REFUSED, NOT_READ) if self.count(status)]
        by_control = [(name, sum(row.control == name for row in self.rows)) for name in CONTROLS]
        whose = ", ".join(f"{name} {n}" for name, n in by_control if n)
        stop = "; interrupted" if self.interrupted else ""
        return f"{several(len(self.rows), 'file')}: {', '.join(parts) or 'none checked'}{f' ({whose})' if whose else ''}{stop}"

    def __repr__(self) -> str:
        return self.text()

    def text(self, width: int | None = None) -> str:
        """Both tables and the summary; a `width` in letters cuts names and sentences so that no row is longer, and leaves
        out the counts where sentences would have no room beside them."""
        narrow = width is not None and width < COUNTED
        head = ("file", "control", *(() if narrow else ("blocks", "alarms", "warnings")), "result")
        rows = [(name, control, *(() if narrow else counts), _short(said)) for name, control, *counts, said in self.texts()]
        why = [(str(one.files), _short(one.reason), one.example) for one in self.reasons]
        if width is not None:
            free = width - sum(2 + max(map(len, column)) for column in list(zip(head, *rows))[1:-1])
            rows = [(_tail(row[0], free // 3), *row[1:-1], _short(row[-1], free - 2 - free // 3)) for row in rows]
            third = (width - 9) // 3
            why = [(files, _short(said, width - 9 - third), _tail(example, third)) for files, said, example in why]
        reasons = [text_table(("files", "reason", "for example"), why), ""] if why else []
        return "\n".join([text_table(head, rows), "", *reasons, self.summary])

    def _repr_html_(self) -> str:
        title = f"<h4>{escape(self.folder)}</h4>" * bool(self.folder) + f"<p>{escape(self.summary)}</p>"
        why = [(str(one.files), one.reason, one.example) for one in self.reasons[:SHOWN]]
        reasons = "<h5>Why</h5>" + html_table(("files", "reason", "for example"), why, numbers=(0,)) if why else ""
        files = html_table(self.HEAD, self.texts()[:SHOWN], numbers=self.NUMBERS)
        left = len(self.rows) - SHOWN
        return f"{title}{reasons}<h5>Files</h5>{files}{f'<p>… {left} more files</p>' if left > 0 else ''}"

    def as_dict(self) -> dict[str, Any]:
        """Everything for programs that read JSON."""
        return {
            "ran": self.count(RAN), "refused": self.count(REFUSED), "not read": self.count(NOT_READ),
            "interrupted": self.interrupted, "files": [row.as_dict() for row in self.rows],
            "reasons": [one._asdict() for one in self.reasons],
        }  # fmt: skip

    def record(self) -> tuple[Sequence[str], Sequence[Sequence[Any]], Collection[int]]:
        """Columns of the file, with the moves and the reason of each row."""
        head = ("file", "result", "control", "blocks", "moves", "alarms", "warnings", "line", "first alarm", "reason")
        said = (" ".join(row.first.message.split()) if row.first else "" for row in self.rows)
        rows = [(*row[:7], row.line or "", why, row.reason) for row, why in zip(self.rows, said)]
        return head, rows, range(3, 8)


def reason(message: str) -> str:
    """A sentence without its values, so that the same fault in other words of the program is the same: numbers and what
    is quoted become …; the numbers of codes and cycles stay."""
    return " ".join(_VALUES.sub("…", _WORDS.sub(r"\1…", message)).split())


def place_of(row: Checked) -> str:
    return f"{row.file}:{row.line}" if row.line else row.file


def _short(text: str, wide: int = WIDE) -> str:
    text = " ".join(text.split())
    return text if len(text) <= wide else f"{text[: max(wide - 1, 0)]}…"


def _tail(name: str, wide: int) -> str:
    """The end of a long name: there names of one folder differ, and places have their line."""
    return name if len(name) <= wide else f"…{name[len(name) - max(wide - 1, 1) :]}"


def _cells(row: Checked) -> tuple[str, ...]:
    said = f"{row.status}: {f'line {row.line}: ' if row.line else ''}{row.first.message}" if row.first else row.status
    counts = (str(n) if row.control else "" for n in (row.blocks, row.alarms, row.warnings))
    return row.file, row.control, *counts, " ".join(said.split())


@fitting
def check(
    where: str | Path | Iterable[str | Path], control: str | None = None, setup: Setup | None = None,
    *, suffixes: Iterable[str] | None = None, jobs: int = 1, executor: Executor | None = None,
) -> Survey:  # fmt: skip
    """Run all programs of a folder and those below it, and tell what ran, what was refused, and why; nothing is drawn.

    `where`: a folder, a file, or several. `control`, `setup`: as in `mnclab.run`, for all files. `suffixes`: which files
    of a folder are programs (default: those that part programs usually have), `("*",)` all. `jobs`: how many processes
    share them; an `executor` of your own (`concurrent.futures`) takes their place. Ctrl-C ends
    it, and what was checked so far is returned.

    >>> mnc.check("data/programs/mnc").ok
    True
    """
    given = [where] if isinstance(where, str | os.PathLike) or not isinstance(where, Iterable) else list(where)
    if not all(isinstance(place, str | os.PathLike) for place in given):
        raise Alarm(f"programs are checked in a folder or in files, got {shown(where)}", hint='mnclab.check("jobs")')
    if whole(jobs, "jobs") < 1:
        raise Alarm(f"jobs must be at least 1, got {shown(jobs)}")
    places, wanted = [Path(place) for place in given], _suffixes(suffixes)
    files = list(dict.fromkeys(file for place in places for file in _files(place, wanted)))
    below = str(places[0]) if len(places) == 1 and places[0].is_dir() else ""
    names = [str(file.relative_to(below) if below else file) for file in files]
    named = list(zip(files, ("".join(c if c.isprintable() else "?" for c in name) for name in names)))
    rows: list[Checked] = []
    interrupted = False
    try:
        with progress("checking", len(files), "files") as at, _shared(jobs, executor) as share:
            for some in share(partial(_all_checked, control, setup), batched(named, jobs if executor is None else jobs + 1)):
                rows += some
                at(len(rows))
    except KeyboardInterrupt:
        interrupted = True
    except BrokenExecutor:
        found = f"a process ended by itself after {several(len(rows), 'file')}, as it does where memory is short"
        raise Alarm(found, hint="fewer jobs need less; with jobs=1 the file is seen") from None
    return Survey(tuple(rows), below, interrupted)


@fitting
def run_many(
    paths: str | Path | Iterable[str | Path], control: str | None = None, setup: Setup | None = None,
    *, jobs: int | None = None, executor: Executor | None = None,
) -> Survey:  # fmt: skip
    """The same as `check`, on all cores if `jobs` does not say on how many: for an archive of programs.

    On a cluster, with the extra `dask`: `client = distributed.Client(address)`, then `executor=client.get_executor()`.

    >>> mnc.run_many("data/programs/mnc", jobs=1).ok
    True
    """
    return check(paths, control, setup, jobs=os.cpu_count() or 1 if jobs is None else jobs, executor=executor)


Share = Callable[[Callable[[Any], list[Checked]], Iterable[Any]], Iterable[list[Checked]]]


@contextmanager
def _shared(jobs: int, executor: Executor | None) -> Iterator[Share]:
    """What hands work out: to this process, to processes of its own, or to those of an executor."""
    if executor is not None:
        yield executor.map
    elif jobs == 1:
        yield map
    else:
        with ProcessPoolExecutor(jobs, initializer=signal, initargs=(SIGINT, SIG_IGN)) as own:
            try:
                yield own.map
            except KeyboardInterrupt:
                own.shutdown(wait=False, cancel_futures=True)  # what is not begun is left alone
                raise


def batched(named: Sequence[tuple[Path, str]], jobs: int) -> list[Sequence[tuple[Path, str]]]:
    """One by one for one process; for several, so many at a time that handing out costs little and none ends late."""
    size = 1 if jobs == 1 else max(1, min(TOGETHER, len(named) // (4 * jobs)))
    return [named[k : k + size] for k in range(0, len(named), size)]


def _all_checked(control: str | None, setup: Setup | None, named: Iterable[tuple[Path, str]]) -> list[Checked]:
    return [checked(file, name, control, setup) for file, name in named]


def checked(file: Path, name: str, control: str | None = None, setup: Setup | None = None) -> Checked:
    """Run a file; `name` is what it is called in the table."""
    try:
        result = run(file, control, setup)
    except Alarm as alarm:
        return Checked(name, NOT_READ, alarms=1, first=alarm.changed(message=alarm.message.replace(str(file), name)))
    except Exception as fault:  # one program must not end the check of all others
        said = f"mnclab itself failed: {type(fault).__name__}: {fault}"
        return Checked(name, NOT_READ, alarms=1, first=Alarm(said, hint="please report it with the program"))
    first = next((alarm for alarm in result.alarms if alarm.severity == ALARM), None)
    counts = amounts(result.alarms)
    moves, status = int(result.toolpath.is_motion.sum()), RAN if first is None else REFUSED
    blocks, alarms, warnings = len(result.program), counts[ALARM], counts[WARNING]
    return Checked(name, status, result.control.name, blocks, moves, alarms, warnings, first)


def files_of(place: Path) -> list[Path]:
    """The programs of a folder and those below it, by their usual suffixes; of a file itself."""
    return list(_files(place, _suffixes(None)))


def _suffixes(given: Iterable[str] | None) -> frozenset[str] | None:
    """The suffixes of the files that are wanted; None: all."""
    if given is None:
        return frozenset((*SHARED, *(suffix for one in CONTROLS.signed() for suffix in one.suffixes)))
    given = [given] if isinstance(given, str) else list(given)
    return None if "*" in given else frozenset(f".{one.strip().lower().lstrip('*').lstrip('.')}" for one in given)


def _files(place: Path, suffixes: frozenset[str] | None) -> Iterator[Path]:
    """The files of a folder and those below in the order of names, without hidden ones; a file is itself."""
    if not place.is_dir():
        yield place
        return
    for folder, folders, files in os.walk(place):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in sorted(files):
            file = Path(folder, name)
            if not name.startswith(".") and (suffixes is None or file.suffix.lower() in suffixes):
                yield file

"""A class: a folder a pupil, graded in processes of their own, which a hostile answer cannot keep; a table and a page."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from html import escape
from importlib import import_module
from pathlib import Path
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Any, NamedTuple

from mnclab.learning.card import page
from mnclab.learning.exercise import exercise, files, files_of_house
from mnclab.learning.grading import text_of
from mnclab.text.alarm import Alarm
from mnclab.text.file import decode
from mnclab.text.given import check_number, fitting, shown, whole
from mnclab.text.tables import Rows, html_table

SECONDS = 5.0  # of the processor, for one answer
PATIENCE = 60.0  # s on the clock, where the machine is busy, or cannot count the other
MEMORY = 1 << 30  # bytes
START = 60.0  # s for a process to begin
SLOW_TO_OPEN = (
    "mnclab.learning.grading", "mnclab.design.difference.comparing", "mnclab.design.difference.turned_comparing",
    "mnclab.workpiece.milling.milled", "mnclab.workpiece.turning.turned", "mnclab.geometry.shapely",
)  # fmt: skip
UNKNOWN = "its name is not that of an exercise, such as mnc-03.mnc"
UNTOUCHED = "not handed in: it is as it was given"
NOTHING = "nothing was handed in"
NO_FILE = "a link, and no file: an answer is one that the pupil wrote"
ELSEWHERE = "not graded: answers lie in the folder of their pupil, in none below it"
BESIDE = (".toml", ".html", ".json")  # files that are no answers
COMMON = 8  # faults that the page of a class names


class Mark(NamedTuple):
    """The grade of one answer of one pupil; `refused` says why it was not graded, or that it is none."""

    pupil: str
    exercise: str
    score: float = 0.0
    passed: bool = False
    hints: Sequence[str] = ()
    faults: Sequence[str] = ()
    refused: str = ""

    @property
    def handed_in(self) -> bool:
        """Whether it is an answer to an exercise that somebody has worked at."""
        return self.refused not in (UNKNOWN, UNTOUCHED, NOTHING, ELSEWHERE)


class Marks(Rows[Mark]):
    """The marks of a class, pupil by pupil; it prints as a table."""

    HEAD = ("pupil", "exercise", "score", "passed", "first hint")
    NUMBERS = range(2, 3)

    def texts(self) -> list[tuple[str, ...]]:
        """What the table says, row by row."""
        return [(each.pupil, each.exercise, *((f"{each.score:.0%}", "yes" if each.passed else "no") if each.handed_in else "––"),
                 each.refused or next(iter(each.hints), "")) for each in self]  # fmt: skip

    def as_dicts(self) -> list[dict[str, Any]]:
        """For JSON."""
        return [each._asdict() for each in self]


@fitting
def mark(
    folder: str | Path, *, neighbours: bool = False, jobs: int | None = None, exercises: str | Path | None = None,
    told: Callable[[int, int], None] | None = None,
) -> Marks:  # fmt: skip
    """Grade a folder of folders, one a pupil, whose files are called as the exercises they answer: `ivanov/mnc-03.mnc`.

    They are graded by the files of the house, not by copies that lie about; and by those of `exercises`, a file or a folder of
    your own. With `neighbours` each pupil's drawing has the dimensions of the name of the folder. `jobs` processes, default one
    a core; `told` is called with how many are graded, and of how many. A file that is empty, or as `exercise give` writes it,
    was not handed in. An Alarm where there is no answer.

    >>> folder = Path("class/ivanov")
    >>> folder.mkdir(parents=True)
    >>> _ = (folder / "mnc-01.mnc").write_text("G0 X5\\n")
    >>> len(mnc.mark("class", jobs=1))
    1
    """
    if jobs is not None:
        check_number(whole(jobs, "jobs"), "jobs", at_least=1)
    known = files() | files_of_house() | own(exercises)
    answers = list(_answers(Path(folder), known))
    if not any(name in known for _, name, *_ in answers):
        way = "a folder a pupil, files such as ivanov/mnc-03.mnc; exercises of your own are named: --exercises mine.toml"
        raise Alarm(f"there is no answer in {folder}", hint=way)
    idle: SimpleQueue[_Grader] = SimpleQueue()
    graders = [_Grader() for _ in range(min(len(answers), jobs or os.cpu_count() or 1))]
    for each in graders:
        idle.put(each)

    def one(answer: tuple[str, str, Path, str]) -> Mark:
        pupil, name, path, why = answer
        if why:
            return Mark(pupil, name, refused=why)
        grader = idle.get()
        try:
            return Mark(pupil, name, **grader.ask((str(path), str(known[name]), pupil if neighbours else "")))
        finally:
            idle.put(grader)

    try:
        marks: list[Mark] = []
        with ThreadPoolExecutor(len(graders)) as threads:
            for found in threads.map(one, answers):
                marks.append(found)
                if told is not None:
                    told(len(marks), len(answers))
        return Marks(marks)
    finally:
        for each in graders:
            each.end()


def own(exercises: str | Path | None) -> dict[str, Path]:
    """The files of exercises of a teacher, by id."""
    if exercises is None:
        return {}
    path = Path(exercises)
    found = sorted(path.glob("*.toml")) if path.is_dir() else [path]
    if not found or not all(each.is_file() for each in found):
        raise Alarm(f"there is no exercise in {shown(str(exercises))}", hint="a file, mine.toml, or a folder of such")
    return {each.stem.lower(): each.resolve() for each in found}


def _answers(folder: Path, known: Mapping[str, Path]) -> Iterator[tuple[str, str, Path, str]]:
    """(pupil, exercise, file, why it is not graded) of all that lies in a folder of folders, or in that of one pupil."""
    if not folder.is_dir():
        raise Alarm(f"{shown(str(folder))} is no folder")
    folder = Path(os.path.realpath(folder))
    pupils = [each for each in _inside(folder) if os.path.isdir(each)]
    lost = [each for each in _inside(folder) if pupils and each not in pupils and each.stem.lower() in known]
    yield from (("", named(path), path, ELSEWHERE) for path in lost)
    for pupil in pupils or [folder]:
        found = _inside(pupil)
        for path in found:
            name, folded = path.stem.lower(), os.path.isdir(path)
            if folded or name not in known:
                yield named(pupil), named(path), path, ELSEWHERE if folded else UNKNOWN
            else:
                yield named(pupil), name, path, "" if os.path.realpath(path) == str(path) else NO_FILE
        if not found:
            yield named(pupil), "", pupil, NOTHING


def _inside(folder: Path) -> list[Path]:
    """What may be an answer; nothing of a folder that cannot be read."""
    return [each for each in sorted(folder.glob("*")) if each.suffix.lower() not in BESIDE and not each.name.startswith(".")]


def named(path: Path) -> str:
    """The name of a file or folder, in whatever code page it was packed."""
    return decode(os.fsencode(path.name))[0]


class _Grader:
    """A process that grades one answer after the other; one that takes too long is ended, and another takes its place.

    It is begun as a command, so that a script which grades is not run again in it.
    """

    _process: subprocess.Popen[str] | None

    def __init__(self) -> None:
        self._begin()

    def _begin(self) -> None:
        here = os.pathsep.join(filter(None, [str(Path(__file__).parents[2]), os.environ.get("PYTHONPATH")]))
        self._process, self._told, self._ready = None, SimpleQueue[str](), False
        try:
            self._process = subprocess.Popen(
                [sys.executable, "-c", f"import {__name__} as marking; marking.grade_all()"],
                env={**os.environ, "PYTHONPATH": here}, text=True, encoding="utf-8",
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            )  # fmt: skip
            Thread(target=_listen, args=(self._process.stdout, self._told), daemon=True).start()
        except (OSError, RuntimeError) as error:  # Python in a browser
            self.end()
            one = "mnclab.grade(...) grades one answer here"
            raise Alarm(f"answers are marked in processes of their own, and none can be begun: {error}", hint=one) from None

    def ask(self, answer: tuple[str, str, str]) -> dict[str, Any]:
        """The grade of an answer as a record, or why it was refused."""
        why = "the grading of it came to an end by itself"
        try:
            self._ready = self._ready or bool(self._told.get(timeout=START))
            if self._ready and self._process is not None and self._process.stdin is not None:
                self._process.stdin.write(json.dumps(answer) + "\n")
                self._process.stdin.flush()
                if line := self._told.get(timeout=PATIENCE):
                    found: dict[str, Any] = json.loads(line)
                    return found
        except Empty:
            why = f"not graded within {PATIENCE:g} s"
        except OSError:  # it has ended
            self._ready = False
        self.end()
        self._begin()
        return {"refused": why}

    def end(self) -> None:
        """Stop the process."""
        if self._process is None:
            return
        self._process.kill()
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                with suppress(OSError):
                    pipe.close()


def _listen(pipe: Any, told: SimpleQueue[str]) -> None:
    """Hand on the lines of a process, and an empty one at its end."""
    with suppress(OSError, ValueError):
        for line in pipe:
            told.put(line)
    told.put("")


class _TooLongError(BaseException):
    """Raised wherever a grading is when its time is over; nothing on the way holds it back."""


def _stop(*_: Any) -> None:
    raise _TooLongError


def grade_all() -> None:
    """What a process does: read answers, write grades, a line each, until nobody asks."""
    for module in SLOW_TO_OPEN:  # no pupil's time
        import_module(module)
    with suppress(ImportError, ValueError, OSError):  # where the system has such limits
        import resource

        resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))
    if hasattr(signal, "SIGPROF"):
        signal.signal(signal.SIGPROF, _stop)
    out, sys.stdout = sys.stdout, sys.stderr  # nothing else is written between the grades
    print("ready", file=out, flush=True)
    for line in sys.stdin:
        print(json.dumps(_graded(*json.loads(line))), file=out, flush=True)


def _graded(path: str, name: str, pupil: str) -> dict[str, Any]:
    counted = hasattr(signal, "ITIMER_PROF")
    try:
        if counted:
            signal.setitimer(signal.ITIMER_PROF, SECONDS)
        found, text = exercise(Path(name), pupil), text_of(Path(path))
        if text.split() in ([], found.template.split()):
            return {"refused": UNTOUCHED}
        grade = found.check(text)
    except Alarm as alarm:
        return {"refused": alarm.message.replace(path, Path(path).name)}
    except MemoryError:
        return {"refused": f"it needs more than {MEMORY >> 20} MB"}
    except _TooLongError:
        return {"refused": f"not graded within {SECONDS:g} s"}
    finally:
        if counted:
            signal.setitimer(signal.ITIMER_PROF, 0)
    return {"score": grade.score, "passed": grade.passed, "hints": [*map(str, grade.hints)], "faults": list(grade.faults)}


# What a class looks like: pupils across exercises, what is often wrong, what to explain again.


#: Names of exercises stand upright, so that a whole course fits on a screen; a long name of a pupil takes a second line.
ACROSS = """<style>body{max-width:none}.across{overflow-x:auto;font-size:13px}.across th,.across td{padding:.15em .25em}
.across th+th,.across td+td{white-space:nowrap!important}.across th+th{writing-mode:vertical-rl}
.across td:first-child{min-width:13em}</style>"""


def class_page(marks: Marks, title: str, exercises: str | Path | None = None) -> str:
    """The page of a class; `exercises` as of `mark`."""
    answers = [each for each in marks if each.handed_in]
    names = sorted({each.exercise for each in answers})
    by = {(each.pupil, each.exercise): each for each in sorted(answers, key=lambda each: each.score)}  # the best of several
    pupils = dict.fromkeys(each.pupil for each in marks if each.pupil)
    rows = [(pupil, *(_cell(by.get((pupil, name))) for name in names)) for pupil in pupils]
    signs = "Marks of 100; ✓ passed, with all of them where no number stands; – not handed in."
    body = f"{ACROSS}<h1>{escape(title)}</h1><p>{signs}</p>"
    body += f'<div class="across">{html_table(("", *names), rows)}</div>'
    common = Counter((each.exercise, fault) for each in answers for fault in set(each.faults)).most_common(COMMON)
    again = [(found.lesson, f"{name}: {found.title}", f"{passed} of {tried}") for name, passed, tried in _again(answers)
             for found in [exercise(own(exercises).get(name, name))]]  # fmt: skip
    refused = [(each.pupil, each.exercise, each.refused) for each in marks if each.refused not in ("", UNTOUCHED, NOTHING)]
    for head, columns, table in (
        ("Often wrong", ("exercise", "fault", "answers"), [(*what, str(n)) for what, n in common]),
        ("To explain again", ("lesson", "exercise", "passed"), again),
        ("Not graded", ("pupil", "exercise", "why"), refused),
    ):
        if table:
            body += f"<h2>{head}</h2>{html_table(columns, table, numbers=(2,) if table[0][2].isdigit() else ())}"
    return page(title, body)


def _cell(found: Mark | None) -> str:
    if found is None:
        return "–"
    return "✓" if found.passed and found.score == 1 else f"{'✓' if found.passed else ''}{100 * found.score:.0f}"


def _again(answers: Sequence[Mark]) -> list[tuple[str, int, int]]:
    """The exercises that less than half of those who tried have passed, the worst first: name, passed, tried."""
    tried = Counter(each.exercise for each in answers)
    passed = Counter(each.exercise for each in answers if each.passed)
    few = [(name, passed[name], tries) for name, tries in tried.items() if 2 * passed[name] < tries]
    return sorted(few, key=lambda each: (each[1] / each[2], -each[2], each[0]))

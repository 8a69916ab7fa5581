"""An exercise: a task, a drawing, a blank and tools, and what an answer is asked for. Its answers stand apart, see `answers`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Unpack

from mnclab.machine.setup import Setup
from mnclab.text.alarm import Alarm, hint
from mnclab.text.file import COURSE
from mnclab.text.given import DrawingOptions, choice, fitting, shown
from mnclab.text.opening import opened
from mnclab.text.tables import Rows

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mnclab.learning.grade import Grade

#: Where the exercises of the house lie: a folder a control.
FOLDER = COURSE / "data" / "exercises"
LESSONS = COURSE / "notebooks"

#: Kind -> what the learner does, and what the answer is written as.
KINDS = {
    "write": ("write the program from the drawing", "program"),
    "mend": ("mend the faults of a program", "program"),
    "gap": ("fill the gap in a program", "program"),
    "set up": ("set zero point, tools and offsets for a program", "setup"),
    "cutting data": ("work out speed and feed", "program"),
    "measure": ("measure and correct", "program"),
    "restart": ("go on after a broken tool", "program"),
    "quicker": ("make a program quicker without a collision", "program"),
    "strategy": ("choose a strategy for a pocket", "strategy"),
    "predict": ("say where the tool goes before it runs", "numbers"),
}
LEVELS = range(1, 6)


class Cut(NamedTuple):
    """What the cutting data of a tool must be: each from a least to a greatest value; `n` rev/min, `vf` mm/min, `vc` m/min, the
    others mm; `ap` and `ae` are depth and width of cut, `ap` of a drill is a peck."""

    tool: int
    n: tuple[float, float] | None = None
    vf: tuple[float, float] | None = None
    vc: tuple[float, float] | None = None
    fz: tuple[float, float] | None = None
    f: tuple[float, float] | None = None
    ap: tuple[float, float] | None = None
    ae: tuple[float, float] | None = None


class Question(NamedTuple):
    """What is predicted: `what` (x, y, z, tip x, tip y, tip z, feed, speed, tool, length, time) after a `line` of the given
    program, or in all."""

    text: str
    what: str
    line: int | None = None
    tolerance: float = 0.001
    hints: tuple[str, ...] = ()


@dataclass(frozen=True)
class Asked:
    """What an answer is asked for beside the part.

    `must` and `must_not` are codes and keywords of blocks that are run; `blocks` how many there may be; `time` s and `length`
    mm earn full marks for economy; `values` are limits of variables at the end; `cutting` those of cutting data; `cabinet`
    what a tool of an answer may be; `strategy` those of a pocket: engagement (degrees), time (s), lifts, feed (mm/min).
    """

    must: tuple[str, ...] = ()
    must_not: tuple[str, ...] = ()
    blocks: int | None = None
    time: float | None = None
    length: float | None = None
    values: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    cutting: tuple[Cut, ...] = ()
    cabinet: tuple[Mapping[str, Any], ...] = ()
    strategy: Mapping[str, float] = field(default_factory=dict)


WEIGHTS = {"part": 0.7, "asked": 0.2, "economy": 0.1}


@dataclass(frozen=True, eq=False)
class Exercise:
    """One exercise; `mnclab.exercise("mnc-03")` finds it by its `id`.

    `task` is what to do, `design` the part as drawn (None where nothing is cut), `setup` the machine with blank and tools,
    `template` a text that an answer begins as, `program` what is given beside it; of one that goes on after line `until`
    of that program, the part was cut so far. `tolerance` mm holds where the drawing gives none. `weights` by heading.
    The model is not in it: `solution()` reads it from the file when it is called.
    """

    id: str
    title: str
    control: str
    level: int
    lesson: str
    kind: str
    task: str
    setup: Setup
    design: Any = None
    asked: Asked = Asked()
    template: str = ""
    program: str = ""
    until: int | None = None
    questions: tuple[Question, ...] = ()
    why: str = ""
    tolerance: float = 0.05
    weights: Mapping[str, float] = field(default_factory=lambda: dict(WEIGHTS))
    file: Path = Path()

    @property
    def answer(self) -> str:
        """What an answer is written as: "program", "setup", "strategy" or "numbers"."""
        return KINDS[self.kind][1]

    @property
    def begins(self) -> str:
        """The text that an answer begins as: the template, the program to make quicker, or the numbers of the questions."""
        numbers = "".join(f"{k} =\n" for k in range(1, len(self.questions) + 1))
        return self.template or (self.program if self.kind == "quicker" else numbers)

    @property
    def does(self) -> str:
        """What the learner does, in words."""
        return KINDS[self.kind][0]

    @fitting
    def check(self, answer: Any, tried: Mapping[str, int] | None = None) -> Grade:
        """Grade an answer: its text, or a run, whose program is run again on the machine of the exercise.

        `tried` says how often a fault was made before (`grade.faults`): the third time its hint goes one step further.
        Nothing but a Grade comes back, whatever was typed; an Alarm for an answer that is no text.
        """
        from mnclab.learning.grading import graded

        return graded(self, answer, tried or {})

    @fitting
    def drawing(self, **options: Unpack[DrawingOptions]) -> Figure:
        """The drawing of the part; the options are those of `Design.plot`. An Alarm where there is none."""
        if self.design is None:
            raise Alarm(f"{self.id} has no drawing", hint=f"it asks you to {self.does}: see its task")
        found: Figure = self.design.plot(**options)
        return found

    def editor(self, folder: str | Path = ".") -> Any:
        """Task, editor, part and grade in one view (needs ipywidgets); the answer is kept in a file of the folder."""
        return opened("mnclab.lab.exercise_editor", "exercise_editor")(self, folder)

    def solution(self) -> str:
        """The text of the model, read from the file of the exercise; an Alarm where the file has none, as pupils' copies."""
        from mnclab.learning.answers import answers_of

        return answers_of(self.file).model

    def __repr__(self) -> str:
        return f"<Exercise {self.id}, level {self.level}, lesson {self.lesson}: {self.title} ({self.does})>"

    def _repr_html_(self) -> str:
        from mnclab.learning.card import card

        return card(self)


class Exercises(Rows[Exercise]):
    """Exercises by their ids; it prints as a table."""

    HEAD = ("id", "level", "lesson", "title", "what you do")
    NUMBERS = range(1, 2)

    def texts(self) -> list[tuple[str, ...]]:
        """What the table says, row by row."""
        return [(each.id, str(each.level), each.lesson, each.title, each.does) for each in self]


def files_of_house() -> dict[str, Path]:
    """The files of exercises by id, in the order of ids."""
    return {path.stem: path for path in sorted(FOLDER.glob("*/*.toml"))}


def files(folder: Path | None = None) -> dict[str, Path]:
    """Those of the house, and those that lie in a folder (`exercises` in this one), which go before them."""
    return files_of_house() | {path.stem: path for path in sorted((folder or Path("exercises")).glob("*.toml"))}


@fitting
def exercise(id: str | Path, pupil: str = "") -> Exercise:
    """The exercise with an id ("mnc-03"), or that of a file, with the dimensions of a pupil; an Alarm where there is none.

    >>> mnc.exercise("mnc-03").title
    'One hook, three places'
    """
    from mnclab.learning.exercise_file import load

    if isinstance(id, Path) or id.lower().endswith(".toml"):
        return load(id, pupil)
    known = files()
    name = id.strip().lower()
    if name not in known:
        near = hint(name, list(known)) if known else "there are no exercises in data/exercises"
        raise Alarm(f"there is no exercise {shown(id)}", hint=near or "print(mnclab.exercises()) lists them")
    return load(known[name], pupil)


@fitting
def exercises(control: str | None = None, *, level: int | None = None, lesson: str | None = None) -> Exercises:
    """All exercises, or those of a control, a level (1 to 5) or a lesson ("05"), as a table to iterate over.

    >>> {each.level for each in mnc.exercises("mnc", level=1)}
    {1}
    """
    return Exercises(_of(control, level, lesson))


def _of(control: str | None, level: int | None, lesson: str | None) -> Iterator[Exercise]:
    from mnclab.controls import CONTROLS
    from mnclab.learning.exercise_file import load

    if control is not None:
        control = choice(control, "control", CONTROLS)
    for name, path in files().items():
        if (control and not name.startswith(f"{control}-")) or (lesson and f'"{lesson}"' not in path.read_text("utf-8")):
            continue  # without a look at the rest, which takes longer
        each = load(path)
        if control in (None, each.control) and level in (None, each.level) and lesson in (None, each.lesson):
            yield each

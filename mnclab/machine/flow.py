"""What a machine, its functions and its cycles ask of the course of the program that is obeyed; `running.flow` is that course.

Where the program goes on changes the machine, so that the machine is handed over with what is asked.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from mnclab.geometry.frames import FrameChain, Matrix
from mnclab.path.leads import Lead
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import Span, several
from mnclab.text.program import Program
from mnclab.text.tables import Listing

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


class RecordedLead(NamedTuple):
    """An approach or a departure in a recorded contour, in program coordinates: its row in the path, and where the tool comes
    from (None: the contour begins with the approach) or ends."""

    lead: Lead
    row: int
    place: tuple[float, float, float] | None


class Recording(NamedTuple):
    """A contour as a label or a program describes it: `path` in program coordinates from `start` on, and its side (+1
    left, -1 right, 0 none). `frames` and `memory` are the transformations at its end, `step` executed its first block;
    `approach` and `departure` lead to it and away, where the label has them."""

    path: Toolpath
    side: int
    start: tuple[float, float, float]
    frames: FrameChain
    memory: Any
    step: int
    approach: RecordedLead | None = None
    departure: RecordedLead | None = None


class Flow(Protocol):
    """Where the program is, and where it goes on."""

    current: int
    """The block being obeyed, of the running program."""

    @property
    def program(self) -> Program:
        """The running program."""

    @property
    def called(self) -> bool:
        """Whether the running program was called by another."""

    def span_of_step(self, step: int) -> Span | None:
        """The place of the block that a step executed."""

    def index_of(self, label: str, span: Span | None = None) -> int:
        """The block of a label; an Alarm if there is none."""

    def spend(self, work: int) -> None:
        """Count the running block as so many more of those that may be executed."""

    def spend_again(self, work: int) -> None:
        """The same in loops: nothing while no more blocks were executed than the text has."""

    def call(self, m: Machine, label: str, span: Span | None = None) -> None:
        """Run from a label to the end of its subprogram."""

    def call_program(self, m: Machine, index: int, span: Span | None = None) -> None:
        """Run another program."""

    def inside(self, m: Machine, index: int) -> AbstractContextManager[None]:
        """Blocks and labels are those of another program."""

    def jump(self, m: Machine, label: str, span: Span | None = None) -> None:
        """Go on at a label."""

    def repeat(self, m: Machine, first: int, stop: int, times: int, span: Span | None = None) -> None:
        """Run the blocks [first, stop) a number of times more."""

    def record(
        self, m: Machine, name: str, span: Span | None = None, after: Recording | None = None,
        blocks: Callable[[], None] | None = None, within: Matrix | None = None, in_space: bool = False,
    ) -> Recording:  # fmt: skip
        """Obey a label for its contour, or `blocks` for that of what has a name; nothing moves. See `running.recording`."""

    def aside(self, m: Machine, in_space: bool = False) -> AbstractContextManager[None]:
        """Blocks inside move nothing, and what they change does not stay, but for variables."""

    def leave(self) -> None:
        """End the running subprogram."""

    def end_program(self) -> None:
        """Go back to the calling program."""

    def ask(self, *values: Any) -> None:
        """A function is about to decide by these values of words where the program goes on."""

    def ask_whether(self, variable: str) -> None:
        """The same by whether a variable has a value."""

    def compare(self, one: Any, other: Any, difference: float) -> None:
        """The same by two values of words, whose numbers differ by so much."""


# Motion that waits: blocks whose moves can be made only when later blocks have told more.
# They stand in `machine.pending`. The interpreter has them made before it obeys anything that does not belong to them,
# and at the end of a program or of a recorded label.

class Pending(Protocol):
    """Blocks that wait."""

    def mark(self, joint: Any) -> bool:
        """Put a joint on the last of their elements; False if it has one already."""

    def make(self, m: Machine) -> None:
        """Make their moves; an Alarm when not enough is known."""


def determine(m: Machine) -> None:
    """Make the moves that wait, if any."""
    pending, m.pending = m.pending, None
    if pending:
        pending.make(m)


class ReadUnder(NamedTuple):
    """What a block that waits was read under."""

    step: int
    source_line: int
    side: int
    label: str


def reading(m: Machine) -> ReadUnder:
    """What a block is read under now."""
    return ReadUnder(m.step, m.source_line, m.side, m.label)


@contextmanager
def as_of(m: Machine, then: ReadUnder) -> Iterator[None]:
    """Rows made within belong to a block that was read earlier, and the history notes their ends there."""
    with m.within(**then._asdict()):
        yield
        m.log("position", m.programmed)


# Files that a program writes: what it puts out, piece by piece, in the history; whole in `Run.files`.

FILE = "file "  # begins the names of files in the history
CHARACTERS = 250  # that count as a block of the limit: a loop that writes for ever must end


@dataclass(frozen=True)
class PrintedPiece:
    """What was put out in a step; `anew`: the file begins with it; `gone`: it is deleted."""

    text: str
    anew: bool
    gone: bool = False

    def __repr__(self) -> str:
        first, _, more = self.text.rstrip().partition("\n")
        return repr(first) + (f" and {several(more.count(chr(10)) + 1, 'more line')}" if more else "")


def put_out(m: Machine, name: str, text: str | None, anew: bool = False) -> None:
    """Write to a file, behind what it holds or anew, or delete it (None); small and capital letters of its name are the same."""
    gone, text = text is None, text or ""
    m.flow.spend(len(text) // CHARACTERS)
    logs = m.logs.by_name
    key = next((known for known in logs if known.lower() == (FILE + name).lower()), FILE + name)
    log = logs.get(key)
    if log is not None and log.steps and log.steps[-1] == m.step and not anew:
        text, anew = log.values[-1].text + text, log.values[-1].anew
    m.log(key, PrintedPiece(text, anew or log is None or log.values[-1].gone, gone))


class Files(Listing, dict[str, str]):
    """Files by name, each a text."""

    HEAD, CODE, NOTHING = ("file", "size", "begins with"), (0, 2), "no files were written"

    def texts(self) -> list[tuple[str, ...]]:
        """Name, lines and the first of them."""
        return [(name, several(text.count("\n"), "line"), text.partition("\n")[0][:60]) for name, text in self.items()]


def written(names: Iterable[str], changed: Callable[[str], list[tuple[int, Any]]]) -> Files:
    """The files at the end of a run, of the names of its history and their changes."""
    found = Files()
    for name in names:
        if name.startswith(FILE):
            texts, gone = list[str](), False
            for _, piece in changed(name):
                if piece.anew:
                    texts.clear()
                texts.append(piece.text)
                gone = piece.gone
            if not gone:
                found[name.removeprefix(FILE)] = "".join(texts)
    return found

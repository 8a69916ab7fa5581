"""All that a block may change on a machine, in one table: what it is at the start, and what is done with it.

Each line of `State` is an attribute of the machine. From here come its first value, what a snapshot holds, what the
history hears of, what makes another state of the rows, what a recorded contour leaves behind, and what is compared between
two visits that are to be the same. Where the program is, the course keeps (`machine.flow`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from math import inf
from typing import TYPE_CHECKING, Any, NamedTuple

from mnclab.geometry import frames
from mnclab.geometry.frames import FrameChain, Matrix
from mnclab.machine.logs import Logs
from mnclab.machine.measuring import Figure, Measurement, Touched
from mnclab.machine.setup import Setup, Tables
from mnclab.machine.snapshot import Snapshot
from mnclab.machine.variables import Measured, Variables
from mnclab.path.feed_rules import FeedRule
from mnclab.path.recorder import NAN, Recorder
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import Alarms, Span

if TYPE_CHECKING:
    from mnclab.machine.control import Control
    from mnclab.machine.cut_so_far import CutSoFar
    from mnclab.machine.cycle import Definition
    from mnclab.machine.touching import Felt
    from mnclab.machine.waiting import Pending
    from mnclab.path.compensation import Gouge
    from mnclab.path.travel import Stopped

Place = tuple[float, float, float]
PATTERN, HOLES, REPEAT = "points of a pattern", "blocks of a run of holes", "passes of a repeat"
ALWAYS = (PATTERN, HOLES, REPEAT)


class Part(NamedTuple):
    """What is done with an attribute.

    `default`: its first value, or a function that makes it for a machine. `rows`: rows carry it. `history`: a change is
    noted. `outlives`: what a contour does to it while it is recorded stays. `compared`: visits of which kinds must leave it
    as it was to be the same.
    """

    default: Any
    rows: bool
    history: bool
    outlives: bool
    compared: tuple[str, ...]


def part(
    default: Any, *, rows: bool = False, history: bool = False, outlives: bool = False, compared: tuple[str, ...] = ALWAYS
) -> Any:  # fmt: skip
    """A line of the table."""
    return Part(default, rows, history, outlives, compared)


class State:
    """The attributes of a machine that a block may change."""

    # fmt: off
    # where the program is, and what came of it
    step: int = part(-1, outlives=True, compared=(PATTERN,))  # the execution of a block
    source_line: int = part(0, compared=(PATTERN,))
    program: int = part(0, rows=True)  # which of the programs runs
    ended: bool = part(False)
    recorded_only: bool = part(False)  # a contour is recorded: nothing moves
    unheard: str = part("")  # functions whose codes begin so do nothing: where only the contour counts
    block_end: list[Callable[[], None]] = part(lambda m: [])  # to be done when the block is over
    alarms: Alarms = part(lambda m: Alarms(), outlives=True)
    noted: set[tuple[str, Span | None]] = part(lambda m: set(), outlives=True)  # of which a warning was given
    logs: Logs = part(lambda m: Logs(), outlives=True, compared=())

    # where the tool is
    tip: Place = part(lambda m: tuple(map(float, m.setup.start)), compared=())  # in machine coordinates
    programmed: Place = part(lambda m: m.tip, compared=())  # in coordinates of the program, before any compensation
    frames: FrameChain = part(lambda m: FrameChain(m.control.frames), rows=True)  # noted one by one, by `set_frame`
    origin: Place | None = part(None)  # the first datum, from which the path counts
    pole: tuple[float, float] | None = part(None)
    rotary: Place = part((0.0, 0.0, 0.0), rows=True, history=True)  # A, B, C, radians
    cylinder: int = part(-1, rows=True)  # of those of the recorder, on which the rows lie that are made now
    from_angle: float = part(NAN, rows=True)  # where its axis stood before the row, rad
    pending: Pending | None = part(None)  # motion that waits for later blocks

    # what a program has said
    modal: dict[str, str] = part(lambda m: {})  # the active code of each group
    tables: Tables = part(lambda m: Tables(m.setup, m.control.magazine), outlives=True)
    variables: Variables = part(Variables, outlives=True)
    measured: Measured = part(Measured, outlives=True)
    touches: list[Touched] = part(lambda m: [], outlives=True)
    figures: list[Figure] = part(lambda m: [], outlives=True)  # that cycles measured
    measurements: list[Measurement] = part(lambda m: [], outlives=True)
    felt: Felt | None = part(None)  # what a cycle that probes feels, while it runs
    variable_unit: float = part(1.0)  # mm that a length of 1 of the program or a variable stands for: 25.4 for inches
    cycle: Definition | None = part(None)  # the cycle that a call runs
    position_cycle: Definition | None = part(None, compared=(PATTERN, REPEAT))  # the cycle that runs at each position
    memory: Any = part(lambda m: m.control.memory and m.control.memory())  # what a control keeps beside the common state

    # how the tool moves
    plane: str = part("XY", rows=True, history=True)
    feed: float | None = part(None, rows=True, history=True)
    per_rev: bool = part(False, rows=True, history=True)
    per_time: bool = part(False, history=True)  # the feed is the time of each move, s
    speed: float = part(0.0, rows=True, history=True)
    turning: int = part(0, rows=True, history=True)  # +1, -1, 0 for M3, M4, M5
    spindle_angle: float | None = part(None)  # at which it was stopped last, degrees
    surface: float | None = part(None, rows=True, history=True)  # the constant cutting speed, m/min, …
    speed_limit: float = part(inf, rows=True, history=True)  # … and how fast it may turn the spindle
    tool: Tool = part(lambda m: m.tables.tools[0], rows=True, history=True)
    side: int = part(0, rows=True, history=True)
    corner_rule: int = part(0, rows=True, history=True)
    look_ahead: bool = part(False, history=True)  # whole contours are looked at, where the control does not always do it
    exact: bool = part(False, rows=True, history=True)
    exact_here: bool = part(False)  # in this block
    synchronous: bool = part(False, rows=True)
    tolerance: float = part(NAN, rows=True)  # how far corners may be cut, mm; nan: as the limits of the machine have it
    feed_rules: list[FeedRule] = part(lambda m: [])  # how the feed depends on the way
    label: str = part("")

    # the path; a recorded contour has one of its own
    recorder: Recorder = part(lambda m: Recorder(m.tip), outlives=True, compared=())
    programmed_pieces: list[Toolpath] = part(lambda m: [], outlives=True)
    settled: list[Toolpath] = part(lambda m: [], outlives=True)
    cut_so_far: CutSoFar | None = part(None, outlives=True, compared=())  # the part that a probe touches, if that is it
    altered: bool = part(False)  # whether a pass changed anything
    cut: int | None = part(None)  # the step of a fault found in a pass: nothing from there on counts
    gouges: list[Gouge] = part(lambda m: [])  # where the tool does not fit
    stopped: Stopped | None = part(None)  # where an axis would have left its travel
    # fmt: on

    control: Control
    setup: Setup
    matrix: Matrix  # of all frames
    shift: Place | None  # of all frames, where they do nothing but shift
    row_state: int | None  # of the rows made now, once worked out

    def begin(self) -> None:
        for name, one in TABLE.items():
            setattr(self, name, one.default(self) if callable(one.default) else one.default)
        self.compose()

    def compose(self) -> None:
        """The chain of frames has changed."""
        self.matrix = self.frames.matrix
        x, y, z = self.matrix[:3, 3].tolist()
        self.shift = (x, y, z) if frames.is_shift(self.matrix) else None
        self.row_state = None

    def put(self, **values: Any) -> None:
        vars(self).update(values)
        if "frames" in values:
            self.compose()
        elif not ROWS.isdisjoint(values):
            self.row_state = None

    @contextmanager
    def within(self, **values: Any) -> Iterator[None]:
        """Inside, attributes have other values; the history does not hear of it."""
        if not values:
            yield
            return
        before = {name: getattr(self, name) for name in values}
        self.put(**values)
        try:
            yield
        finally:
            self.put(**before)

    def snapshot(self, names: Iterable[str] | None = None) -> Snapshot:
        return Snapshot({name: getattr(self, name) for name in (TABLE if names is None else names)})

    def restore(self, snapshot: Snapshot) -> None:
        """Give the attributes of a snapshot the values that they had."""
        self.put(**snapshot.taken_out())


TABLE: dict[str, Part] = {name: one for name, one in vars(State).items() if isinstance(one, Part)}
for _name in TABLE:  # the values belong to machines
    delattr(State, _name)
ROWS = frozenset(name for name, one in TABLE.items() if one.rows)
HISTORY = frozenset(name for name, one in TABLE.items() if one.history)
PUT_BACK = tuple(name for name, one in TABLE.items() if not one.outlives)  # after a contour was recorded
COMPARED = {kind: tuple(name for name, one in TABLE.items() if kind in one.compared) for kind in ALWAYS}

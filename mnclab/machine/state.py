"""What a machine remembers: all that a block may change on it, in one table (`State`), and what keeps it.

Values that change go to logs, variables log themselves, and a snapshot keeps them as they were.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from copy import copy
from dataclasses import is_dataclass
from math import inf
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.geometry.frames import FrameChain, Matrix
from mnclab.machine.measuring import Measurement, Touched, TouchedFigure
from mnclab.machine.setup import Setup, Tables
from mnclab.path.feeds import FeedRule
from mnclab.path.recorder import NAN, Recorder
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import Alarms, Span

if TYPE_CHECKING:
    from mnclab.machine.control import Control
    from mnclab.machine.cutting import CutSoFar
    from mnclab.machine.cycle import Definition
    from mnclab.machine.flow import Pending
    from mnclab.machine.machine import Machine
    from mnclab.machine.touching import Felt
    from mnclab.path.compensation import Gouge
    from mnclab.path.limits import Stopped


# Writing down what changes: a log per name, of the steps at which it changed and the values from there on.
# A *step* is one execution of a block; `runs.history` reads the logs after the run.

Values = list[Any] | NDArray[Any]


class Log:
    """Changes of one name: steps (k,) in rising order, and the values from there on."""

    __slots__ = ("_chunks", "steps", "values")

    def __init__(self) -> None:
        self.steps: list[int] = []
        self.values: list[Any] = []
        self._chunks: list[tuple[NDArray[np.integer[Any]], Values]] = []

    def copy(self) -> Log:
        """The same changes, apart from those to come."""
        twin = Log()
        twin.steps, twin.values, twin._chunks = self.steps.copy(), self.values.copy(), self._chunks.copy()
        return twin

    def extend(self, steps: NDArray[np.integer[Any]], values: Values) -> None:
        if len(steps):
            self._chunks += [(np.array(self.steps, dtype=np.int64), self.values), (steps, values)]
            self.steps, self.values = [], []

    @property
    def first(self) -> int:
        chunks = [steps for steps, _ in self._chunks if len(steps)]
        return int(chunks[0][0]) if chunks else self.steps[0]

    def close(self, last: int) -> tuple[NDArray[np.integer[Any]], Values]:
        """All changes up to step `last`."""
        own = np.array(self.steps, dtype=np.int64), self.values
        chunks = [chunk for chunk in (*self._chunks, own) if len(chunk[0])] or [own]
        pieces = [values for _, values in chunks]
        steps = np.concatenate([steps for steps, _ in chunks])
        keep = int(np.searchsorted(steps, last, "right"))
        if len(pieces) == 1:
            return steps[:keep], pieces[0][:keep]
        if any(isinstance(values, np.ndarray) for values in pieces):
            return steps[:keep], np.concatenate([np.asarray(values) for values in pieces])[:keep]
        return steps[:keep], [value for values in pieces for value in values][:keep]


class Logs:
    """The logs while a program runs."""

    def __init__(self) -> None:
        self.by_name: dict[str, Log] = {}

    def add(self, name: str, step: int, value: Any) -> None:
        log = self.by_name.get(name) or self.by_name.setdefault(name, Log())
        steps = log.steps
        if steps and steps[-1] >= step:  # of a block that goes on after others that it has obeyed
            log.values[-1] = value
        else:
            steps.append(step)
            log.values.append(value)

    def extend(self, name: str, steps: NDArray[np.integer[Any]], values: Values) -> None:
        self.by_name.setdefault(name, Log()).extend(steps, values)

    def changed(self, name: str, last: int) -> list[tuple[int, Any]]:
        """The steps up to `last` at which a name changed, and its value from there on."""
        log = self.by_name.get(name)
        return [(int(step), value) for step, value in zip(*log.close(last))] if log else []

    def value(self, name: str, step: int) -> Any:
        """What a name was after a step; None if it had no value yet."""
        changes = self.changed(name, step)
        return changes[-1][1] if changes else None


# What a program computes and what probing finds: dictionaries whose changes go to the history.

class Kept(dict[str, Any]):
    """Values by name, of a machine that hears of their changes."""

    def __init__(self, machine: Machine) -> None:
        super().__init__()
        self._machine = machine

    def copy(self) -> Self:
        """The same values, apart from those to come."""
        twin = type(self)(self._machine)
        dict.update(twin, self)
        vars(twin).update(vars(self))
        return twin


class Variables(Kept):
    """Q parameters and the like, numbers and texts; every change is logged.

    What the control itself keeps in a variable (`Control.preassigned`: the radius of the tool, …) is worked out when
    it is asked for.
    """

    def __init__(self, machine: Machine) -> None:
        super().__init__(machine)
        self.state_read = -1
        """The step at which the state of the machine was read last, in a variable that the control keeps or otherwise."""

    def __setitem__(self, name: str, value: Any) -> None:
        super().__setitem__(name, value)
        self._machine.log(name, value)

    def __missing__(self, name: str) -> Any:
        self.state_read = self._machine.step
        preassigned = self._machine.control.preassigned.get(name)
        value = None if preassigned is None else preassigned(self._machine)
        if value is None:
            raise KeyError(name)
        return value

    def forget(self, name: str) -> None:
        if name in self:
            self._machine.log(name, None)
            del self[name]

    @contextmanager
    def own_level(self) -> Iterator[None]:
        """Inside, the variables that are local to a program are others; afterwards those of before."""
        local = self._machine.control.local_variables
        if not local:
            yield
            return
        kept = {name: value for name, value in self.items() if name.startswith(local)}
        for name in kept:
            self.forget(name)
        yield
        for name in [name for name in self if name.startswith(local)]:
            self.forget(name)
        for name, value in kept.items():
            self[name] = value


    @contextmanager
    def own_values(self) -> Iterator[None]:
        """Inside, what is written to variables does not stay: they are a copy. After an alarm they are as they were there."""
        kept = dict(self)
        yield
        for name in [name for name in self if name not in kept]:
            self.forget(name)
        for name, value in kept.items():
            if name not in self or self[name] != value:
                self[name] = value


class Measured(Kept):
    """What probing found; every value is logged."""

    def __setitem__(self, name: str, value: Any) -> None:
        super().__setitem__(name, value)
        self._machine.log(f"measured {name}", value)


# A snapshot of attributes: a value that stays as it is, whatever becomes of what it was taken from.
# `copied` gives what can change objects of its own and leaves what cannot as it is: numbers, texts, frozen dataclasses,
# toolpaths. A class whose objects hold more than that has a method `copy`.

PLAIN = frozenset((str, int, float, bool, type(None)))
FIXED: tuple[type, ...] = (Toolpath, MappingProxyType)


class Snapshot:
    """Attributes by name, as they were; equal where all of them are."""

    __hash__ = None  # type: ignore[assignment]

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = {name: copied(value) for name, value in values.items()}

    def taken_out(self) -> dict[str, Any]:
        """The values once more, in objects that may change."""
        return {name: copied(value) for name, value in self._values.items()}

    def differences(self, other: Snapshot | Mapping[str, Any]) -> list[str]:
        """The names whose values are not the same in another snapshot, or among others as they are now."""
        now = other._values if isinstance(other, Snapshot) else other
        names, both = dict.fromkeys((*self._values, *now)), self._values.keys() & now.keys()
        return [name for name in names if name not in both or not same(self._values[name], now[name])]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Snapshot) and not self.differences(other)

    def __repr__(self) -> str:
        return f"<Snapshot of {', '.join(self._values)}>"


def copied(value: Any) -> Any:
    """The same value, in objects of its own where it could change."""
    kind = type(value)
    if kind in PLAIN or isinstance(value, FIXED) or callable(value):
        return value
    if kind is dict:
        return {key: copied(one) for key, one in value.items()}
    if kind is list:
        return [copied(one) for one in value]
    if kind is set or kind is frozenset:  # what is in a set cannot change
        return kind(value)
    if isinstance(value, tuple):
        if PLAIN.issuperset(map(type, value)):
            return value
        inner = map(copied, value)
        return kind(inner) if kind is tuple else kind(*inner)
    if hasattr(kind, "copy"):
        return value.copy()
    if is_dataclass(value) and kind.__dataclass_params__.frozen:
        return value
    twin = copy(value)
    for name, one in held(value).items():
        object.__setattr__(twin, name, copied(one))
    return twin


def held(value: Any) -> dict[str, Any]:
    """What an object holds by name, in its dictionary or its slots."""
    return {name: getattr(value, name) for name in (*getattr(value, "__dict__", ()), *getattr(value, "__slots__", ()))}


def same(one: Any, other: Any) -> bool:
    """Whether two values are equal down to what they hold; nan is equal to nan."""
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, float):
        return bool(one == other or (one != one and other != other))
    if isinstance(one, np.ndarray):
        return one.shape == other.shape and one.dtype == other.dtype and one.tobytes() == other.tobytes()
    inside = held(one)
    if callable(one) or not (inside or isinstance(one, dict | list | tuple)):
        return bool(one == other)
    if isinstance(one, dict) and not (list(one) == list(other) and all(map(same, one.values(), other.values()))):
        return False
    if isinstance(one, list | tuple) and not (len(one) == len(other) and all(map(same, one, other))):
        return False
    return all(same(value, getattr(other, name)) for name, value in inside.items())


# All that a block may change on a machine, in one table: what it is at the start, and what is done with it.
# Each line of `State` is an attribute of the machine. From here come its first value, what a snapshot holds, what the
# history hears of, what makes another state of the rows, what a recorded contour leaves behind, and what is compared between
# two visits that are to be the same. Where the program is, the course keeps (`machine.flow`).

Place = tuple[float, float, float]
PATTERN, HOLES, REPEAT = "points of a pattern", "blocks of a run of holes", "passes of a repeat"
ALWAYS = (PATTERN, HOLES, REPEAT)


class AttributeUse(NamedTuple):
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
    return AttributeUse(default, rows, history, outlives, compared)


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
    alarms: Alarms = part(lambda m: Alarms(), outlives=True, compared=())  # those of blocks are noted
    noted: set[tuple[str, Span | None]] = part(
        lambda m: set(), outlives=True, compared=(PATTERN, REPEAT)
    )  # of which a warning was given; blocks of holes give theirs again
    logs: Logs = part(lambda m: Logs(), outlives=True, compared=())

    # where the tool is
    tip: Place = part(lambda m: tuple(map(float, m.setup.start)), compared=())  # in machine coordinates
    programmed: Place = part(lambda m: m.tip, compared=())  # in coordinates of the program, before any compensation
    frames: FrameChain = part(lambda m: FrameChain(m.control.frames), rows=True)  # noted one by one, by `set_frame`
    origin: Place | None = part(None)  # the first datum, from which the path counts
    origin_chosen: bool = part(False)  # by a block
    pole: tuple[float, float] | None = part(None)
    rotary: Place = part(lambda m: m.setup.kinematics.home if m.setup.kinematics else (0.0, 0.0, 0.0), rows=True, history=True)
    """A, B, C, radians."""
    arrived: Place = part((0.0, 0.0, 0.0))  # each axis from which side: 1 in positive direction, -1 in negative, 0 never
    reckoned: Place | None = part((0.0, 0.0, 0.0))  # with which coordinates count; None: as they stand, the tip is led
    turned: Matrix | None = part(None)  # what becomes of the part where they stand elsewhere, before all frames
    cylinder: int = part(-1, rows=True)  # of those of the recorder, on which the rows lie that are made now
    from_angle: float = part(NAN, rows=True)  # where its axis stood before the row, rad
    pending: Pending | None = part(None)  # motion that waits for later blocks

    # what a program has said
    modal: dict[str, str] = part(lambda m: {})  # the active code of each group
    tables: Tables = part(lambda m: Tables(m.setup, m.control.magazine), outlives=True)
    variables: Variables = part(Variables, outlives=True)
    measured: Measured = part(Measured, outlives=True)
    touches: list[Touched] = part(lambda m: [], outlives=True)
    figures: list[TouchedFigure] = part(lambda m: [], outlives=True)  # that cycles measured
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
        self.matrix = self.frames.matrix if self.turned is None else self.turned @ self.frames.matrix
        x, y, z = self.matrix[:3, 3].tolist()
        self.shift = (x, y, z) if frames.is_shift(self.matrix) else None
        self.row_state = None

    def put(self, **values: Any) -> None:
        vars(self).update(values)
        if "frames" in values or "turned" in values:
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


TABLE: dict[str, AttributeUse] = {name: one for name, one in vars(State).items() if isinstance(one, AttributeUse)}
for _name in TABLE:  # the values belong to machines
    delattr(State, _name)
ROWS = frozenset(name for name, one in TABLE.items() if one.rows)
HISTORY = frozenset(name for name, one in TABLE.items() if one.history)
PUT_BACK = tuple(name for name, one in TABLE.items() if not one.outlives)  # after a contour was recorded
COMPARED = {kind: tuple(name for name, one in TABLE.items() if kind in one.compared) for kind in ALWAYS}

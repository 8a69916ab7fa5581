"""The machine: the only thing that changes while a program runs.

Functions and cycles speak to it in verbs, in coordinates of the program (mm, mm/min, rev/min, degrees, seconds). It keeps two
points: `Machine.programmed`, the register in program coordinates before any compensation, and `Machine.tip`,
the same point in machine coordinates. A change of frame says which of the two it keeps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from mnclab.geometry import frames
from mnclab.geometry.arcs import sweep_of_one
from mnclab.geometry.frames import FrameChain, Matrix
from mnclab.machine.adding import add_row, spindle_axis
from mnclab.machine.circles import centre_by_radius, check_radii, check_start, normal, turn
from mnclab.machine.flow import Flow, Recording
from mnclab.machine.logs import Logs
from mnclab.machine.settings import chosen
from mnclab.machine.settling import end_of_settled, settle
from mnclab.machine.setup import Datum, Setup, Tables
from mnclab.machine.touching import Contact, touch
from mnclab.machine.variables import Measured, Variables
from mnclab.machine.waiting import Pending
from mnclab.path.compensation import Gouge
from mnclab.path.feed_rules import FeedRule
from mnclab.path.kinds import Kind
from mnclab.path.recorder import NAN, Recorder, State
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import WARNING, Alarm, Alarms, Span
from mnclab.text.expression import Expression
from mnclab.text.program import Word
from mnclab.text.strings import NumberFromText

if TYPE_CHECKING:
    from mnclab.machine.control import Control
    from mnclab.machine.cycle import Definition

INF = math.inf
LONG = 8  # tokens of an expression that take about as long as a block
PLANES = {"XY": (0, 1, 2), "ZX": (2, 0, 1), "YZ": (1, 2, 0), "XZ": (0, 2, 1)}  # first axis, second axis, normal
_AXES = {"XY": (0.0, 0.0, 1.0), "ZX": (0.0, 1.0, 0.0), "YZ": (1.0, 0.0, 0.0), "XZ": (0.0, -1.0, 0.0)}


class Machine:
    """Position, frames, modal state, tool, spindle and feed; verbs that turn them into rows of a path."""

    def __init__(self, control: Control, setup: Setup) -> None:
        self.control, self.setup, self.tables = control, setup, Tables(setup)
        self.settings = chosen(control.settings, setup.settings, control.name, setup.source)
        self.flow: Flow  # set by the interpreter
        self.alarms = Alarms()
        self.logs = Logs()
        self.step, self.source_line, self.program = -1, 0, 0
        self.ended = False
        self.recorded_only = False
        self.block_end: list[Callable[[], None]] = []

        self.tip: tuple[float, float, float] = tuple(map(float, setup.start))  # type: ignore[assignment]
        self.programmed: tuple[float, float, float] = self.tip
        self.frames = FrameChain(control.frames)
        self._matrix: Matrix = frames.IDENTITY
        self._shift: tuple[float, float, float] | None = (0.0, 0.0, 0.0)
        self.origin: tuple[float, float, float] | None = None

        self.modal: dict[str, str] = {}
        self.variables = Variables(self)
        self.variable_unit = 1.0  # mm that a length of 1 in a variable stands for: 25.4 in a program in inches
        self.measured = Measured(self)
        self.plane = "XY"
        self.feed: float | None = None
        self.per_rev = False
        self.per_time = False  # the feed is the time of each move, s
        self.speed, self.turning = 0.0, 0  # S, and +1, -1, 0 for M3, M4, M5
        self.spindle_angle: float | None = None  # at which it was stopped last, degrees
        self.surface: float | None = None  # the constant cutting speed, m/min, …
        self.speed_limit = INF  # … and how fast it may turn the spindle
        self.tool: Tool = self.tables.tools[0]
        self.side, self.corner_rule = 0, 0
        self.exact, self.exact_here, self.synchronous = False, False, False
        self.tolerance = NAN  # how far corners may be cut, mm; nan: as the limits of the machine have it
        self.rotary = (0.0, 0.0, 0.0)
        self.label = ""
        self.cycle: Definition | None = None
        self.position_cycle: Definition | None = None
        self.pole: tuple[float, float] | None = None
        self.memory: Any = control.memory() if control.memory else None  # what it keeps beside the common state
        self.noted: set[tuple[str, Span | None]] = set()  # of which a warning was given
        self.pending: Pending | None = None  # motion that waits for later blocks

        self.recorder = Recorder(self.tip)
        self.programmed_pieces: list[Toolpath] = []
        self.settled: list[Toolpath] = []
        self.altered = False  # whether a pass changed anything
        self.cut: int | None = None  # the step of a fault found in a pass: nothing from there on counts
        self.gouges: list[Gouge] = []  # where the tool does not fit
        self.feed_rules: list[FeedRule] = []  # how the feed depends on the way
        self._state: int | None = None
        self.log("position", self.programmed)

    # --- saying what is wrong ----------------------------------------------------------------------------------------

    def alarm(self, message: str, word: Word | Span | None = None, hint: str = "") -> NoReturn:
        """Stop with an alarm at a word."""
        raise Alarm(message, self._span(word), hint=hint)

    def warn(self, message: str, word: Word | Span | None = None, hint: str = "") -> None:
        """Note something doubtful and go on; the same at the same place is noted once, however often it is obeyed."""
        span = self._span(word)
        if (message, span) not in self.noted:
            self.noted.add((message, span))
            self.alarms.append(Alarm(message, span, WARNING, hint))

    def _span(self, word: Word | Span | None) -> Span | None:
        span = word.span if isinstance(word, Word) else word
        return span._replace(program=self.program) if span else self.flow.span_of_step(self.step)

    def message(self, text: str) -> None:
        """Show a message to the operator: a warning at the block."""
        self.warn(text)

    # --- values and state --------------------------------------------------------------------------------------------

    def value(self, word: Word) -> float:
        """The number of a word; expressions are evaluated with the variables as they stand."""
        value = word.value
        if isinstance(value, float):
            return value
        if isinstance(value, Expression | NumberFromText):
            try:
                if isinstance(value, Expression) and len(value.tokens) > LONG:
                    self.flow.spend(len(value.tokens) // LONG)
                return value.evaluate(self.variables)
            except Alarm as alarm:
                alarm.span = alarm.span and alarm.span._replace(program=self.program)
                raise
        self.alarm(f"{word.address} needs a number", word)

    def log(self, name: str, value: Any) -> None:
        """Note a new value of a name in the history; while a contour is recorded only what outlives it."""
        if self.recorded_only and name not in self.variables:
            return
        self.logs.add(name, self.step if self.step > 0 else 0, value)

    def change(self, name: str, value: Any) -> None:
        """Set an attribute that rows carry (feed, side, plane, …) and note it in the history.

        Where a modal group has the same name (plane), the history holds its codes.
        """
        if getattr(self, name) != value:
            setattr(self, name, value)
            self._state = None
            if name not in self.modal:
                self.log(name, value)

    @contextmanager
    def within(self, **values: Any) -> Iterator[None]:
        """Inside, attributes that rows carry have other values; the history does not see it."""
        if not values:
            yield
            return
        kept = {name: getattr(self, name) for name in values}
        vars(self).update(values)
        self._state = None
        try:
            yield
        finally:
            vars(self).update(kept)
            self._state = None

    def set_modal(self, group: str, code: str) -> None:
        """A function of a group is active from now on."""
        if self.modal.get(group) != code:
            self.modal[group] = code
            self.log(group, code)

    @property
    def spindle_speed(self) -> float:
        """rev/min, positive for M3, negative for M4."""
        return self.speed * self.turning

    @property
    def radius(self) -> float:
        """The effective tool radius, signed, in lengths of the program: a scale does not change the tool."""
        return self.tool.effective_radius / self.scale

    @property
    def scale(self) -> float:
        """How long 1 mm of the program in the plane is on the machine; 1 where that depends on the direction."""
        if self._shift is not None or not self.keeps_circles:
            return 1.0
        return math.hypot(*self._matrix[:3, PLANES[self.plane][0]].tolist())

    def state(self) -> int:
        """The state that rows made now share."""
        if self._state is None:
            axis = _AXES[self.plane]
            if self._shift is None:
                axis = normal(self._matrix, *PLANES[self.plane][:2])
            per_rev = self.feed if self.per_rev and self.feed is not None else NAN
            surface = NAN, INF, 0.0
            if self.surface is not None:
                surface = self.surface, self.speed_limit, spindle_axis(self)
            self._state = self.recorder.state(
                State(
                    self.program, axis, self.rotary, per_rev, surface[0], self.spindle_speed, self.tool.number,
                    self.tool.effective_radius, self.side * self.orientation, self.corner_rule, self.exact,
                    self.synchronous, self.tolerance, *surface[1:],
                )
            )  # fmt: skip
        return self._state

    # --- frames ------------------------------------------------------------------------------------------------------

    def set_frame(self, name: str, matrix: Matrix | None, keep: str = "tip") -> None:
        """Replace one frame of the chain; `keep` "tip" (the program reads the place anew) or "programmed"."""
        self.frames.set(name, matrix)
        self.compose()
        if keep == "tip":
            self.read_position()
        self.log("frame " + name, tuple(map(tuple, (self.frames[name]).tolist())))

    def compose(self) -> None:
        """The chain of frames has changed."""
        self._matrix = self.frames.matrix
        self._shift = tuple(self._matrix[:3, 3].tolist()) if frames.is_shift(self._matrix) else None
        self._state = None

    def select_datum(self, datum: Datum, frame: str = "datum") -> None:
        """Count from a work offset; the first one selected is the origin of the path."""
        if self.origin is None:
            self.origin = (datum.x, datum.y, datum.z)
        self.set_frame(frame, frames.shift(datum.x, datum.y, datum.z))

    def to_machine(self, point: Iterable[float]) -> tuple[float, float, float]:
        """Program coordinates to machine coordinates."""
        x, y, z = point
        if self._shift is not None:
            dx, dy, dz = self._shift
            return x + dx, y + dy, z + dz
        u, v, w = frames.apply(self._matrix, (x, y, z)).tolist()
        return u, v, w

    def to_program(self, point: Iterable[float]) -> tuple[float, float, float]:
        """Machine coordinates to program coordinates."""
        x, y, z = point
        if self._shift is not None:
            dx, dy, dz = self._shift
            return x - dx, y - dy, z - dz
        u, v, w = frames.apply(frames.inverse(self._matrix), (x, y, z)).tolist()
        return u, v, w

    def read_position(self) -> None:
        """Take the register from where the tip stands."""
        self.programmed = self.to_program(self.tip)
        self.log("position", self.programmed)

    def write_table(self, table: str, row: int, value: Any) -> None:
        """Write a row of a table ("tools", "datums", "presets"); the setup stays as it is."""
        getattr(self.tables, table)[row] = value
        self.log(f"{table} {row}", value)

    def set_register(self, point: Iterable[float]) -> None:
        """Give the programmed point exact values; the tip stays where it is."""
        x, y, z = point
        self.programmed = (float(x), float(y), float(z))
        self.log("position", self.programmed)

    # --- verbs: motion -----------------------------------------------------------------------------------------------

    def target(self, x: float | None, y: float | None, z: float | None) -> tuple[float, float, float]:
        """The programmed point with some coordinates replaced."""
        px, py, pz = self.programmed
        return px if x is None else x, py if y is None else y, pz if z is None else z

    def rapid(self, x: float | None = None, y: float | None = None, z: float | None = None) -> None:
        """Rapid traverse to a point."""
        self._go(Kind.RAPID, self.target(x, y, z), INF)

    def line(
        self, x: float | None = None, y: float | None = None, z: float | None = None,
        f: float | None = None, word: Word | None = None, joint: Any = None,
    ) -> None:  # fmt: skip
        """A straight line at feed `f` mm/min, by default the modal feed."""
        if f == INF:
            return self.rapid(x, y, z)
        self._go(Kind.LINE, self.target(x, y, z), self.feed_of(f, word), joint)

    def feed_of(self, f: float | None, word: Word | None = None) -> float:
        """The feed of a move, mm/min, or its time, s, with a minus; an alarm if none was programmed."""
        if f is not None:
            return f
        if self.feed is None:
            self.alarm("no feed rate was programmed before this move", word, hint="write F")
        if self.per_rev:
            if not self.spindle_speed:
                self.alarm("a feed per revolution needs a turning spindle", word, hint=self.control.to_turn)
            return self.feed * abs(self.speed)
        return -self.feed if self.per_time else self.feed

    def _go(self, kind: Kind, point: tuple[float, float, float], feed: float, joint: Any = None) -> None:
        tip = self.to_machine(point)
        if tip != self.tip:
            self._row(kind, tip, feed=feed, joint=joint)
        elif joint is not None:
            self.alarm("an approach or a departure needs a move: the tool stands at its end already")
        self.programmed, self.tip = point, tip

    def arc(
        self, x: float | None = None, y: float | None = None, z: float | None = None, *,
        sense: int, centre: Mapping[int, float] | None = None, radius: float | None = None,
        f: float | None = None, word: Word | None = None, tolerance: float = 0.01,
    ) -> None:  # fmt: skip
        """An arc in the active plane, +1 counter-clockwise, by its centre (axis number -> coordinate) or signed radius.

        A third coordinate makes a helix. Start and end within a micrometre are a full circle by centre; a radius that
        is too small, a centre on the start, ends at unequal distances from the centre are alarms.
        """
        feed = self.feed_of(f, word)
        point = self.target(x, y, z)
        check_start(self, tolerance, word)
        first, second, _ = PLANES[self.plane]
        here = self.programmed
        s, e = (here[first], here[second]), (point[first], point[second])
        if radius is not None:
            c = centre_by_radius(self, s, e, radius, sense, tolerance, word)
        else:
            given = centre or {}
            c = (given.get(first, here[first]), given.get(second, here[second]))
            check_radii(self, s, e, c, tolerance, word)
        angle = sweep_of_one(s, e, c, sense)
        middle = list(here)
        middle[first], middle[second] = c
        if self._shift is None:
            angle *= self._arc_sense(word)
        tip = self.to_machine(point)
        self._row(Kind.ARC, tip, self.to_machine(middle), angle, feed)
        self.programmed, self.tip = point, tip

    def turn(
        self, centre: tuple[float, float], angle: float, level: float | None = None, f: float | None = None
    ) -> None:
        """Round a point of the plane by an angle (rad, any number of turns), to a level along its normal."""
        turn(self, PLANES[self.plane], centre, angle, level, f)

    def _arc_sense(self, word: Word | None = None) -> int:
        """The orientation; an alarm when the frame would turn the circle into an ellipse."""
        if not self.keeps_circles:
            self.alarm("an arc under unequal scales of its plane would be an ellipse", word)
        return self.orientation

    @property
    def keeps_circles(self) -> bool:
        """Whether circles of the plane stay circles on the machine."""
        first, second, _ = PLANES[self.plane]
        u, v = self._matrix[:3, first], self._matrix[:3, second]
        return bool(abs(np.linalg.norm(u) - np.linalg.norm(v)) <= 1e-9 and abs(u @ v) <= 1e-9)

    @property
    def orientation(self) -> int:
        """-1 when the frame mirrors the plane: arcs and the side of the tool turn over; else 1."""
        if self._shift is not None:
            return 1
        first, second, _ = PLANES[self.plane]
        across = np.cross(self._matrix[:3, first], self._matrix[:3, second])
        return 1 if np.dot(across, normal(self._matrix, first, second)) > 0 else -1

    def at_block_end(self, undo: Callable[[], None]) -> None:
        """Do something when the running block is over."""
        self.block_end.append(undo)

    def end_block(self) -> None:
        """What a function asked for the end of its block."""
        self.exact_here = False
        while self.block_end:
            self.block_end.pop()()

    _row = add_row

    def mark_joint(self, joint: Any) -> bool:
        """Put a joint on the last motion not settled yet; False if there is none, or if it has one already."""
        return self.pending.mark(joint) if self.pending else self.recorder.mark(joint)

    def heading(self) -> tuple[float, float, float] | None:
        """The unit tangent at the end of the last motion not settled yet, in machine axes; None if there is none."""
        travel = self.recorder.heading()
        return None if travel is None else tuple(travel.tolist())

    # --- verbs: events -----------------------------------------------------------------------------------------------

    def dwell(self, seconds: float) -> None:
        """Wait; nothing for zero seconds."""
        if seconds > 0:
            self._row(Kind.DWELL, self.tip, time=float(seconds))

    def spindle(self, speed: float | None = None, turning: int | None = None) -> None:
        """Set the speed (rev/min) and the sense (+1 M3, -1 M4, 0 M5); a row when the spindle changes."""
        before = self.spindle_speed
        if speed is not None:
            self.change("speed", float(speed))
        if turning is not None:
            self.change("turning", turning)
        if self.spindle_speed != before:
            self._row(Kind.SPINDLE, self.tip)

    def orient(self, angle: float) -> None:
        """Stop the spindle at an angle, degrees."""
        self.change("turning", 0)
        self.spindle_angle = float(angle)
        self.log("spindle angle", self.spindle_angle)
        self._row(Kind.SPINDLE, self.tip)

    def change_tool(self, tool: Tool, frame_axis: int = 2) -> None:
        """Put a tool into the spindle: the machine stands still, the tip jumps by the difference of the lengths."""
        tip = list(self.tip)
        tip[frame_axis] += self.tool.effective_length - tool.effective_length
        self.change("tool", tool)
        self.tip = tuple(tip)  # type: ignore[assignment]
        self._row(Kind.TOOL, self.tip)
        self.read_position()

    def stop(self) -> None:
        """Wait for the operator."""
        self._row(Kind.STOP, self.tip)

    def coolant(self) -> None:
        """A change of the coolant."""
        self._row(Kind.COOLANT, self.tip)

    def touch(
        self, x: float | None = None, y: float | None = None, z: float | None = None, *,
        f: float, ball: float | None = None, word: Word | None = None, miss: str = "alarm",
    ) -> Contact:  # fmt: skip
        """Move the probe towards a point until its ball touches the part; see `machine.touching`."""
        return touch(self, self.target(x, y, z), f, self.radius if ball is None else ball, word, miss)

    def probe_to(self, tip: tuple[float, float, float], f: float) -> None:
        """A probing move that ended at a tip in machine coordinates."""
        self.tip = tip
        self._row(Kind.PROBE, tip, feed=f)
        self.read_position()

    def record(self, label: str, span: Span | None = None, after: Recording | None = None) -> Recording:
        """Read the contour of a label: nothing moves, variables that it writes stay."""
        return self.flow.record(self, label, span, after)

    # --- settling ----------------------------------------------------------------------------------------------------

    def settle(self, unfinished: bool = False) -> None:
        """Run the passes on the rows not yet settled; see `machine.settling`."""
        settle(self, unfinished)

    def observe(self) -> None:
        """Settle, and take tip and register from the end of the tool-centre path."""
        settle(self)
        end = end_of_settled(self)
        if end is not None:
            self.tip = end
            self.recorder.start = np.array(end)
            self.read_position()

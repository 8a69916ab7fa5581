"""The machine: the only thing that changes while a program runs.

Functions and cycles speak to it in verbs, in coordinates of the program (mm, mm/min, rev/min, degrees, seconds). What it
keeps stands in `machine.state`, how it knows where it is in `machine.coordinates`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from mnclab.machine import rows
from mnclab.machine.axes import begin, change_length, stand, tell_lean
from mnclab.machine.control import chosen
from mnclab.machine.coordinates import Placed
from mnclab.machine.flow import Flow, Recording
from mnclab.machine.rows import add_row, end_of_settled, settle
from mnclab.machine.setup import Setup, check_rows
from mnclab.machine.state import HISTORY, ROWS
from mnclab.machine.touching import Contact, touch
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind
from mnclab.text.alarm import WARNING, Alarm, Span
from mnclab.text.expression import Expression
from mnclab.text.given import LARGEST
from mnclab.text.program import Word
from mnclab.text.strings import NumberFromText

if TYPE_CHECKING:
    from mnclab.machine.control import Control

INF = math.inf
LONG = 8  # tokens of an expression that take about as long as a block


class Machine(Placed):
    """Position, frames, modal state, tool, spindle and feed; verbs that turn them into rows of a path."""

    def __init__(self, control: Control, setup: Setup, flow: Flow) -> None:
        self.control, self.setup, self.flow = control, setup, flow
        self.settings = chosen(control.settings, setup.settings, control.name, setup.source)
        if "G54" in control.functions:
            check_rows(setup)
        self.begin()
        if self.tables.kinematics is not None:
            begin(self)
        self.log("position", self.programmed)

    def __repr__(self) -> str:
        x, y, z = self.programmed
        return f"<Machine {self.control.name}: T{self.tool.number} at X{x:.10g} Y{y:.10g} Z{z:.10g}>"

    # --- saying what is wrong ----------------------------------------------------------------------------------------

    def alarm(self, message: str, word: Word | Span | None = None, hint: str = "") -> NoReturn:
        raise Alarm(message, self.span_of(word), hint=hint)

    def warn(self, message: str, word: Word | Span | None = None, hint: str = "") -> None:
        """Note something doubtful and go on; the same at the same place is noted once, however often it is obeyed."""
        span = self.span_of(word)
        if (message, span) not in self.noted:
            self.noted.add((message, span))
            self.alarms.append(Alarm(message, span, WARNING, hint))

    def span_of(self, word: Word | Span | None) -> Span | None:
        """The place of a word in the running program; without one that of the block."""
        span = word.span if isinstance(word, Word) else word
        return span._replace(program=self.program) if span else self.flow.span_of_step(self.step)

    def message(self, text: str) -> None:
        self.warn(text)

    # --- values and state --------------------------------------------------------------------------------------------

    def value(self, word: Word) -> float:
        """The number of a word; expressions are evaluated with the variables as they stand."""
        value = word.value
        if isinstance(value, float):
            return value
        if not isinstance(value, Expression | NumberFromText):
            self.alarm(f"{word.address} needs a number", word)
        try:
            if isinstance(value, Expression) and len(value.tokens) > LONG:
                self.flow.spend_again(len(value.tokens) // LONG)
            found = value.evaluate(self.variables)
        except Alarm as alarm:
            alarm.span = alarm.span and alarm.span._replace(program=self.program)
            raise
        if not -LARGEST < found < LARGEST and word.address.isupper():  # of an address, no value of a parameter
            self.alarm(f"{word.address} must be smaller than {LARGEST:g}, got {found:.7g}", word)
        return found

    def length(self, word: Word) -> float:
        """The number of a word that is a length or a feed, mm: of a control that says in its program what it counts in."""
        return self.value(word) * self.variable_unit

    @property
    def feed_unit(self) -> float:
        """mm/min that a feed of 1 of the program stands for: 2.54 where F counts tenths of an inch (setting "inch_feed")."""
        tenth = self.variable_unit != 1 and self.settings.get("inch_feed") == "tenth"
        return self.variable_unit / 10 if tenth else self.variable_unit

    def change(self, name: str, value: Any) -> None:
        """Set an attribute (feed, side, plane, …) and note it in the history, where the table of `State` says so.

        Where a modal group has the same name (plane), the history holds its codes.
        """
        if getattr(self, name) != value:
            setattr(self, name, value)
            if name in ROWS and (name != "feed" or self.per_rev):  # a feed per minute stands in the row itself
                self.row_state = None
            if name in HISTORY and name not in self.modal:
                self.log(name, value)

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

    def write_table(self, table: str, row: int, value: Any) -> None:
        """Write a row of a table ("tools", "datums", "presets"); the setup stays as it is."""
        getattr(self.tables, table)[row] = value
        self.log(f"{table} {row}", value)

    # --- verbs: motion -----------------------------------------------------------------------------------------------

    def rapid(self, x: float | None = None, y: float | None = None, z: float | None = None) -> None:
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
            if kind == Kind.LINE:
                tell_lean(self)
            self.add_row(kind, tip, feed=feed, joint=joint)
        elif joint is not None:
            self.alarm("an approach or a departure needs a move: the tool stands at its end already")
        self.programmed, self.tip = point, tip

    def arc(
        self, x: float | None = None, y: float | None = None, z: float | None = None, *,
        sense: int, centre: Mapping[int, float] | None = None, radius: float | None = None,
        f: float | None = None, word: Word | None = None, tolerance: float = 0.01, turns: int = 1,
    ) -> None:  # fmt: skip
        """An arc in the active plane, +1 counter-clockwise, by its centre (axis number -> coordinate) or signed radius.

        A third coordinate makes a helix. Start and end within a micrometre are a full circle by centre. `turns`: of several
        the last one ends there.
        """
        rows.arc(self, self.target(x, y, z), sense, centre, radius, self.feed_of(f, word), word, tolerance, turns)

    turn = rows.turn

    def at_block_end(self, undo: Callable[[], None]) -> None:
        self.block_end.append(undo)

    def end_block(self) -> None:
        """What a function asked for the end of its block."""
        self.exact_here = False
        while self.block_end:
            self.block_end.pop()()

    add_row = add_row

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
            self.add_row(Kind.DWELL, self.tip, time=float(seconds))

    def spindle(self, speed: float | None = None, turning: int | None = None) -> None:
        """Set the speed (rev/min) and the sense (+1 M3, -1 M4, 0 M5); a row when the spindle changes."""
        before = self.spindle_speed
        if speed is not None:
            self.change("speed", float(speed))
        if turning is not None:
            self.change("turning", turning)
        if self.spindle_speed != before:
            self.add_row(Kind.SPINDLE, self.tip)

    def orient(self, angle: float) -> None:
        """Stop the spindle at an angle, degrees."""
        self.change("turning", 0)
        self.spindle_angle = float(angle)
        self.log("spindle angle", self.spindle_angle)
        self.add_row(Kind.SPINDLE, self.tip)

    def change_tool(self, tool: Tool, axis: int = 2, before: int = 2) -> None:
        """Put a tool into the spindle: the machine stands still, the tip jumps by the difference of the lengths.

        The tool lies along an `axis` of the machine, the one that was there along the axis `before`.
        """
        length = self.tool.effective_length
        self.change("tool", tool)
        if self.tables.kinematics is not None:
            if axis != 2:
                self.alarm(f"the tool must lie along Z on a machine with rotary axes, got {'XYZ'[axis]}")
            change_length(self, length)
        else:
            tip = list(self.tip)
            if axis == before:
                tip[axis] += length - tool.effective_length
            else:
                tip[before] += length
                tip[axis] -= tool.effective_length
            self.tip = tuple(tip)  # type: ignore[assignment]
        self.add_row(Kind.TOOL, self.tip)
        stand(self)

    def stop(self) -> None:
        self.add_row(Kind.STOP, self.tip)

    def coolant(self) -> None:
        """A row for a coolant that is switched: which, and whether on or off, is what is active of the group "coolant"."""
        self.add_row(Kind.COOLANT, self.tip)

    def touch(
        self, x: float | None = None, y: float | None = None, z: float | None = None, *,
        f: float, ball: float | None = None, word: Word | None = None, miss: str = "alarm",
    ) -> Contact:  # fmt: skip
        """Move the probe towards a point until its ball touches the part; see `machine.touching`."""
        return touch(self, self.target(x, y, z), f, self.radius if ball is None else ball, word, miss)

    def probe_to(self, tip: tuple[float, float, float], f: float) -> None:
        """A probing move that ended at a tip in machine coordinates."""
        self.tip = tip
        self.add_row(Kind.PROBE, tip, feed=f)
        self.read_position()

    def record(self, name: str, span: Span | None = None, after: Recording | None = None, **of: Any) -> Recording:
        """Read the contour of a label, or of other blocks: nothing moves, variables that they write stay. See `Flow.record`."""
        return self.flow.record(self, name, span, after, **of)

    # --- settling ----------------------------------------------------------------------------------------------------

    def settle(self, unfinished: bool = False) -> None:
        settle(self, unfinished)

    def observe(self) -> None:
        """Settle, and take tip and register from the end of the tool-centre path."""
        settle(self)
        end = end_of_settled(self)
        if end is not None:
            self.tip = end
            self.recorder.start = np.array(end)
            self.read_position()

"""Running a program: text and machine in, path, history and alarms out.

Frames change so seldom that the history holds the matrices themselves, one name for each frame of the chain ("frame
datum"), instead of indices; `run.frames` is the chain at the end.
"""

from __future__ import annotations

import gc
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from numpy.typing import NDArray

from mnclab.machine.control import Control
from mnclab.machine.cutting import stock_of
from mnclab.machine.flow import written
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import record
from mnclab.machine.rows import paths, shifted, stop_at_travel
from mnclab.machine.setup import Setup, Tables
from mnclab.machine.touching import stop_at_part
from mnclab.path.compensation import Gouge
from mnclab.path.holes import Holes, holes
from mnclab.path.limits import Limits, Stopped
from mnclab.path.machines import limits_of
from mnclab.path.profile import Profile
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Index, Kind
from mnclab.running.flow import Steps, course
from mnclab.running.interpreter import Interpreter, Stop
from mnclab.runs import card, lint, material
from mnclab.runs.axes import AxisPositions
from mnclab.runs.explanation import Explanation
from mnclab.runs.faults_ahead import faults_ahead
from mnclab.runs.history import History, Moment, tables_at_end
from mnclab.runs.largest_radius import LargestRadius, largest_radius
from mnclab.runs.material import cutting_data, measuring_sheet, setup_sheet, tool_sheet
from mnclab.runs.moments import Moments, when
from mnclab.runs.start import MissedOnes, start_at
from mnclab.text.alarm import ALARM, Alarm, Span, by_place, quoted
from mnclab.text.given import (
    AxesOptions,
    CompensationOptions,
    FigureOptions,
    MeasuredOptions,
    PlayerOptions,
    RunFileOptions,
    RunOptions,
    SceneOptions,
    fitting_class,
    shown,
    whole,
)
from mnclab.text.program import Program
from mnclab.text.tables import fixed
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.collision import Collisions
from mnclab.workpiece.outcome import Outcome
from mnclab.workpiece.removal import Removal
from mnclab.workpiece.workpiece import Workpiece

if TYPE_CHECKING:
    import pyvista
    from matplotlib.figure import Figure

    from mnclab.design.recognition.proposal import Proposal
    from mnclab.design.recognition.turned import TurnedProposal
    from mnclab.show.player import Player


@fitting_class
class Pictures:
    """What a run shows beside its path."""

    def plot_depth(self, *, line: int | None = None, pass_: int = 1, **options: Unpack[AxesOptions]) -> Figure:
        """Z over time: pecks, dwells and retractions of a hole, by `line`; see `mnclab.show.plot.over_time`."""
        from mnclab.show.plot.over_time import plot_depth

        return plot_depth(self, line=line, pass_=pass_, **options)

    def plot_datums(self, *, view: str = "XY", **options: Unpack[AxesOptions]) -> Figure:
        """Machine zero and the zero points of the program as vectors from it; see `mnclab.show.plot.set_up`."""
        from mnclab.show.plot.set_up import plot_datums

        return plot_datums(self, view=view, **options)

    def plot_face(self, **options: Unpack[AxesOptions]) -> Figure:
        """The spirals that a lathe cuts in a face, seen from the tailstock; see `mnclab.show.plot.face`."""
        from mnclab.show.plot.face import plot_face

        return plot_face(self, **options)

    def plot_lengths(self, line: int, *, pass_: int = 1, **options: Unpack[AxesOptions]) -> Figure:
        """Spindle nose, tool and tip with their heights after a line: a wrong length offset is seen; see
        `mnclab.show.plot.set_up`."""
        from mnclab.show.plot.set_up import plot_lengths

        return plot_lengths(self, line, pass_=pass_, **options)


EXAMPLE = 'a machine is its limits: run(…, limits="small-mill"); a setup: ' "mnclab.Setup(tools={1: mnclab.Tool(radius=5)})"


@fitting_class
class Run(Pictures):
    """The result of running a program: both paths, alarms, history, the `files` it wrote, and where the machine stands.

    `measured` is what probing found, by name, `measurements` the record; `touches`, `figures`: machine coordinates.
    `gouges` are the places where a compensated tool does not fit: the one that was refused, or with the setting
    `gouge = "mark"` all of them. `stopped` is where an axis would have left its travel, machine coordinates; `halt` the block
    at which the run stopped before its end, None of a whole run.

    >>> mnc.run("S800 M3\\nG1 X30 Y40 F100\\n", "mnc")
    <Run program on mnc: 2 blocks, 1 move, cutting 50.000 mm, rapid 0.000 mm, 30.0 s at feed>
    """

    def __init__(
        self, program: Program, setup: Setup, control: Control, machine: Machine, alarms: list[Alarm], halt: Span | None
    ) -> None:
        self.program, self.setup, self.control = program, setup, control
        self.halt = halt
        flow = course(machine)
        self.programs = tuple(flow.programs)
        self.steps = Steps._make(fixed(column) for column in flow.steps())
        self.programmed, self.toolpath = paths(machine)
        if machine.cut is not None:
            self.steps = Steps(self.steps.block[: machine.cut], self.steps.program[: machine.cut])
        self.history = History(machine.logs, len(self.steps.block))
        self.variables: dict[str, Any] = self._as_of_end("", machine.variables)
        self.measured: dict[str, Any] = self._as_of_end("measured ", machine.measured)
        self.touches, self.figures, self.measurements = record(machine, len(self.steps.block), self.place_of_line, self.reach)
        self.files = written(self.history, self.history.changed)
        self.tables: Tables = tables_at_end(machine, self.history, len(self.steps.block))
        self.frames = machine.frames
        self.gouges: tuple[Gouge, ...] = tuple(shifted(machine))
        self.stopped: Stopped | None = machine.stopped
        self.settings = dict(machine.settings)
        self.made: dict[Any, Any] = {}  # the last parts and collisions that were asked for
        self.alarms = by_place(alarms)
        self.alarms = by_place(lint.remarked(self, machine))
        for alarm in self.alarms:
            if alarm.source is None:
                alarm.source = self.programs[alarm.span.program if alarm.span else 0]
        self._nesting, self.missed, self.started = flow.nesting, MissedOnes(), (0, 0, 0)  # see `start_at`: what it skips, where

    def _as_of_end(self, prefix: str, values: dict[str, Any]) -> dict[str, Any]:
        """Values as the history has them after the last step that counts."""
        last = len(self.steps.block) - 1
        found = {name: self.history.value(prefix + name, last) for name in values}
        return {name: value for name, value in found.items() if value is not None}

    def axes(self) -> AxisPositions:
        """Where the axes of the machine stand at the end of every row of `toolpath`; see `AxisPositions`."""
        return AxisPositions(self.toolpath, self.history, self.first_length)

    @property
    def first_length(self) -> float:
        """Of the tool before the first one, mm."""
        first = self.setup.tools[0] if self.setup.tools and 0 in self.setup.tools else self.control.magazine[0]
        return first.effective_length

    @property
    def ok(self) -> bool:
        return not any(alarm.severity == ALARM for alarm in self.alarms)

    @property
    def reach(self) -> str:
        """How far what is judged of a run goes that stopped: "up to line 12, where the run stopped"; empty of a whole one."""
        return card.reach(self.halt, self.place_of_line)

    def at(
        self, line: int | None = None, pass_: int = 1, step: int | None = None, program: int = 0,
        *, block: int | str | None = None,
    ) -> Moment:  # fmt: skip
        """The machine after the `pass_`-th execution of a line (of one of `programs`), or after a step; else an Alarm.

        A line within a block of several lines means the block; `block` is a number as the program has it, 40 or "N40".
        """
        if step is None and block is not None:
            line = self._line_of(block, program)
        if step is None and line is None:
            raise Alarm("at() needs a line, the number of a block or a step", hint="run.at(line=5)")
        if step is None:
            line, pass_ = whole(line, "the line"), whole(pass_, "pass_")
            found = self.executions(line, whole(program, "the number of the program"))
            if not len(found):
                raise Alarm(f"line {line} holds no block that was executed")
            if not 1 <= pass_ <= len(found):
                raise Alarm(f"line {line} was executed {len(found)} times, pass_ {pass_} does not exist")
            step = int(found[pass_ - 1])
        step = whole(step, "the step")
        if not 0 <= step < len(self.steps.block):
            raise Alarm(f"step must be 0 … {len(self.steps.block) - 1}, got {step}")
        which = int(self.steps.program[step])
        found_block = self.programs[which][int(self.steps.block[step])]
        found_block = replace(found_block, span=found_block.span._replace(program=which))
        position, path = self.history.value("position", step), self.toolpath
        a, b = np.searchsorted(path.step, [step, step + 1]).tolist() if len(path) else (0, 0)
        tip = path.end[b - 1] if b else path.start[0] if len(path) else np.array(self.setup.start)
        state, changed, row = self.history.at(step), self.history.changes(step), b - 1 if b > a else -1
        line, point = found_block.span.line, tuple(tip.tolist())
        text = quoted(self.programs[which].line_text(line).strip())[0]
        return Moment(step, line, found_block, position, state, changed, slice(a, b), row, 1.0, point, text, path.lathe)

    def _line_of(self, block: int | str, program: int) -> int:
        """The line of the block that has a number."""
        if not 0 <= (program := whole(program, "the number of the program")) < len(self.programs):
            raise Alarm(f"there is no program number {program}, there are {len(self.programs)}")
        return self.programs[program].line_of_number(block)

    @property
    def stock(self) -> Blank | None:
        """The blank in the coordinates of the toolpath: that of the setup, else the last one that the program gives."""
        return stock_of(self.setup.stock, self.history.changed("stock"), np.array(self.toolpath.origin))

    def executions(self, line: int, program: int) -> NDArray[np.intp]:
        """The steps that executed the block of a line."""
        if not 0 <= program < len(self.programs):
            return np.empty(0, dtype=np.intp)
        first, last = self.programs[program].lines()
        begun = np.flatnonzero(first == line)  # before one that ends in the line in which another begins
        blocks = begun if len(begun) else np.flatnonzero((first <= line) & (line <= last))
        return np.flatnonzero(np.isin(self.steps.block, blocks) & (self.steps.program == program))

    def lines(self) -> NDArray[np.integer[Any]]:
        """The line of each step (s,), in the program that `steps.program` names."""
        found = np.asarray(self.program.line_of(np.minimum(self.steps.block, len(self.program) - 1)))
        for index, program in enumerate(self.programs[1:], 1):
            here = self.steps.program == index
            found = np.where(here, program.line_of(np.where(here, self.steps.block, 0)), found)
        return found

    def when(self, condition: str) -> Moments:
        """The moments at which a condition becomes true: `run.when("z < -5")`, `run.when("Q5 > 3")`.

        Names are those of variables, and x y z d (tool tip, mm), a b c (rotary axes, degrees), feed, spindle, tool,
        radius, side, line. The place is exact, within lines and arcs too, unless coordinates are multiplied or in a
        function; see `runs.moments`, and `.exact` of the result.
        """
        if not isinstance(condition, str):
            raise Alarm(f"a condition is a text, got {shown(condition)}", hint='run.when("z < -5")')
        return when(self, condition)

    def explain(
        self, line: int | None = None, pass_: int = 1, step: int | None = None, program: int = 0,
        *, block: int | str | None = None,
    ) -> Explanation:  # fmt: skip
        """A block (named as for `at`) in plain words: what each word means and changed, and the way to the tool.

        Of blocks that are obeyed as one, as those of CYCL DEF 1.0 to 1.5, it has the words of the one that was asked for.
        """
        if step is None and block is not None:
            line = self._line_of(block, program)
        return Explanation(self, self.at(line, pass_, step, program), line if step is None else None)

    def profile(
        self, limits: Limits | str | None = None, *, machine: Limits | str | None = None, override: float = 1.0
    ) -> Profile:
        """When the tool is where, and how fast, under the limits of the setup, others, or those of a named machine
        ("small-mill"; `mnclab.machines()` lists them), given as `limits` or as `machine`.

        `override` is the feed override, 1 for 100 %, from 0.001 to 100. How a rapid goes is the control's (its setting
        `rapid_motion`) unless the limits say; the program waits for the spindle unless its supervision is off (MNC G25).
        """
        path, spindle = self.toolpath, self.toolpath.kind == Kind.SPINDLE
        waits = np.ones(len(path), dtype=bool)
        if "supervision" in self.history:
            waits[spindle] = [self.history.value("supervision", int(step)) != "G25" for step in path.step[spindle]]
        motion = str(self.settings.get("rapid_motion", "line"))
        on = next((each for each in (limits, machine) if isinstance(each, str)), "")
        limits, name = limits_of(limits, machine) or self.setup.limits, f"{self.program.title}{f' on {Path(on).stem}' * bool(on)}"
        said: dict[str, Any] = {"rapid_motion": motion, "waits": waits, "source": self.program, "name": name, "reach": self.reach}
        return Profile(path, limits, override=override, **said)

    @property
    def rapids(self) -> Limits:
        """The limits of the setup; a rapid goes as the control has it (its setting `rapid_motion`) unless they say how."""
        limits = self.setup.limits
        return replace(limits, rapid_motion=limits.rapid_motion or str(self.settings.get("rapid_motion", "line")))

    def place_of_line(self, line: int, program: int = 0) -> str:
        """`FILE:LINE`, as alarms have it."""
        return f"{self.programs[program].name}:{line}"

    def workpiece(
        self, line: int | None = None, pass_: int = 1, row: int | None = None,
        *, step: float | None = None, stock: Any = None,
    ) -> Workpiece:  # fmt: skip
        """What is left of the blank at the end, after the `pass_`-th execution of a line, or after a row of the path.

        `step` mm is the side of a cell of a milled part (default: a four-hundredth of its longer side), `stock` another
        blank in machine coordinates. An Alarm without a blank.
        """
        return material.workpiece(self, line, pass_, row, step, stock)

    def collisions(self, stock: Any = None, *, step: float | None = None) -> Collisions:
        """What meets what it must not: rapids in material, shank, holder, fixtures, a still spindle, …, by rows.

        The kinds are those of `workpiece.collision.KINDS`; `stock` and `step` as in `workpiece`. A rapid is judged along the
        straight line between its ends, though pictures bend it as its axes go; with the setting `rapid_path="broken"` as it is.
        """
        return material.collisions(self, stock, step)

    def design(self, stock: Any = None) -> Proposal | TurnedProposal:
        """The design that the program makes of its blank: holes, pockets, slots, studs, contours, faces, chamfers, threads in
        the order of cutting, named by cycle and line; of a lathe the profile with its threads.

        They are found in the geometry of the moves, for any control. What has no name (slopes, surfaces, engraving) is not in
        the design but in its `notes`. `stock` as in `workpiece`; an Alarm without a blank, or above 20,000 moves.
        """
        return material.design(self, stock)

    @property
    def tools_that_cut(self) -> tuple[dict[int, Tool], Index]:
        """The tools by their numbers, and the number of each row of the path (n,): where a control has no tool words, of the
        tool that its cycle is cut with."""
        return material.tools_that_cut(self)

    @property
    def tip_lift(self) -> NDArray[np.float64]:
        """How much higher than on its path the tip of each row (n,) really is, mm: of a tool that is called with a delta length,
        or is not as its table says."""
        return material.tip_lift(self)

    @property
    def rows_from_home(self) -> int:
        """How many rows of the path bring the tool from home to a blank, from where nobody has said; pictures leave them out."""
        return material.rows_from_home(self)

    def removal(
        self, limits: Limits | str | None = None, *, machine: Limits | str | None = None, step: float | None = None
    ) -> Removal:
        """How much material goes by row, line and tool, and how fast; `limits` as in `profile`, `step` as in `workpiece`."""
        return material.removal(self, self.profile(limits, machine=machine), step)

    def outcome(self, machine: Limits | str | None = None) -> Outcome | None:
        """What became of the blank, for a report: removal and collisions, or why they are not known; None without one.
        `machine` as in `profile`."""
        return card.outcome(self, card.REPORT, machine=machine)

    def again(self, setup: Setup) -> Run:
        """The same program on the same control, with another setup."""
        if not isinstance(setup, Setup):
            raise Alarm(f"setup must be a Setup, got {shown(setup)}", hint=EXAMPLE)
        run = run_program(self.program, self.control, setup)
        return run.start_at(*self.started) if self.started[0] else run

    def holes(self) -> Holes:
        """The holes (see `path.holes`) as a table: place, heights, diameter, tool and lines, a row for each place and tool."""
        return holes(self.toolpath, *self.tools_that_cut, self.reach, self.stock)

    def largest_radius(self) -> LargestRadius:
        """The largest tool radius, mm, that has room at all compensated contours: "6 mm", or "below 6 mm" where this itself has
        none; with the lines between which it is narrowest."""
        return largest_radius(self)

    start_at, cutting_data = start_at, cutting_data
    setup_sheet, tool_sheet, measuring_sheet = setup_sheet, tool_sheet, measuring_sheet

    # --- doors -------------------------------------------------------------------------------------------------------

    def plot(self, **options: Unpack[RunOptions]) -> Figure:
        """Views of the path: from above and the side for a mill, X and Z for a lathe.

        `colour` "kind", "feed" (mm/min), "speed" (of the spindle, rev/min), "tool", "line" or "z" (mm) says what the
        colour of the cuts shows; `arrows=False`, `marks=False` and `stock=False` leave out arrowheads, crosses at zero
        points and poles, and the outline of the blank; `view` "XY", "XZ", "YZ", "ZX", of a cylinder "unrolled"; `frame`
        "all" or "cuts"; `size` in inches; `ax` axes of one's own; `part=True` draws what is left of the blank under the
        path. All of them are explained in `mnclab.show.plot.path.plot_path`.
        """
        from mnclab.show.plot.path import plot_run

        return plot_run(self, **options)

    def plot_measured(self, **options: Unpack[MeasuredOptions]) -> Figure:
        """What was measured, deviations magnified: `line`, `factor`, `part`, `width`; see `mnclab.show.plot.measured`."""
        from mnclab.show.plot.measured import plot_measured

        return plot_measured(self, **options)

    def plot_speed(self, *, most: float = np.inf, **options: Unpack[FigureOptions]) -> Figure:
        """Spindle speed and diameter over the way of a lathe's tool; `most` is the greatest speed, rev/min."""
        from mnclab.show.plot.lathe import plot_speed_of

        return plot_speed_of(self, most, **options)

    def player(
        self, limits: Limits | str | None = None, *, machine: Limits | str | None = None, **options: Unpack[PlayerOptions]
    ) -> Player:
        """A page to play the run in: forwards and backwards, by block, move or time; orbit, pan and zoom.

        Where there is a blank the page cuts it as it plays; of runs that are not too long it marks the collisions.
        `limits` are those of `profile`. `height` in pixels, `theme` "auto", "light" or "dark", `speed` 1
        for real time. `.save(path)` writes it as a file that needs no network, as `run.save("part.html")` does.
        """
        from mnclab.show.player import player

        return player(self, self.profile(limits, machine=machine), *material.played(self), **options)

    def plot_compensation(self, **options: Unpack[CompensationOptions]) -> Figure:
        """The contour, the tool-centre path beside it, and how its corners were found.

        `rules=("G160", "G161", "G162")` and `radii=(2, 5)` run the program once more for each and show the results
        side by side; `discs=True` draws the tool; more in `mnclab.show.plot.compensation.compensation`.
        """
        from mnclab.show.plot.compensation import compensation

        return compensation(self, **options)

    def scene(self, colour: str = "kind", **options: Unpack[SceneOptions]) -> pyvista.Plotter:
        """Path, tool and blank in three dimensions (needs pyvista); shows itself as a still picture.

        `colour` of the cuts: "kind", "feed", "tool", "z", "line"; `row`: where the tool stands; `stock`:
        another blank, or False; `part=True` what is left of it. All of them are explained in `mnclab.show.scene.scene`.
        """
        from mnclab.show.scene import scene

        return scene(self, colour, **options)

    def save(self, path: str | Path, **options: Unpack[RunFileOptions]) -> Path:
        """Write one file; the suffix says what: svg, pdf, png, csv, json, html (the player), dxf, ngc, stl, gltf, glb, vtk.

        Pictures take the options of `plot`; `true_size=True` makes an svg in true millimetres. The bodies (stl, gltf, glb,
        vtk) are those of the part; `of="path"` writes the path.
        """
        from mnclab.show.export import save

        return save(self, path, **options)

    def report(
        self, path: str | Path, title: str | None = None, *, design: Any = None, tolerance: float = 0.05,
        limits: Limits | str | None = None, machine: Limits | str | None = None, **options: Any,
    ) -> Path:  # fmt: skip
        """Write a report, .html or .pdf: figures, path, tools, time, cutting data, alarms, set-up, programs; `options` of `plot`.

        `design=`, or what else `Workpiece.compare` takes, adds a measuring record; `tolerance=0.05` mm. Times and limits are
        those of `machine=`, "small-mill" or limits; default the ones of the setup.
        """
        from mnclab.show.report.gathering import save_report

        return save_report(self, path, title, design=design, tolerance=tolerance, limits=limits, machine=machine, **options)

    # --- shown -------------------------------------------------------------------------------------------------------

    def summary(self) -> dict[str, Any]:
        """Program, control, counts of blocks, moves, alarms and warnings, lengths in mm, seconds at feed."""
        return card.summary(self)

    def __repr__(self) -> str:
        return card.in_words(self)

    def _repr_html_(self) -> str:
        return card.html(self)


def run_program(program: Program, control: Control, setup: Setup | None = None, *, strict: bool = False) -> Run:
    """Run a program that was read; with `strict` the first alarm is raised instead of collected."""
    if not isinstance(setup, Setup | None):
        raise Alarm(f"setup must be a Setup, got {shown(setup)}", hint=EXAMPLE)
    setup = (setup or Setup()).kept(control.magazine)  # somebody may have written into its tables, and may again
    interpreter = Interpreter(control, setup, program)
    machine, alarms = interpreter.machine, list[Alarm]()
    broken, collecting, halt = False, gc.isenabled(), None
    gc.disable()  # running makes no reference cycles, and the collector would look at every kept row again
    try:
        interpreter.run()
    except (Stop, Alarm) as stop:
        broken, alarms = True, [interpreter.placed(stop)] if isinstance(stop, Alarm) else []
        halt = stop.span or interpreter.flow.span_of_step(interpreter.flow.begun - 1) or Span(1, 1)
    finally:
        if collecting:
            gc.enable()
    for finish in (partial(machine.settle, unfinished=broken), partial(stop_at_travel, machine), partial(stop_at_part, machine)):
        try:
            finish()
        except Alarm as alarm:
            alarms.append(alarm)
            halt = alarm.span or halt
    ahead = faults_ahead(interpreter) if broken else []
    told = [interpreter.flow.said(alarm) for alarm in (*alarms, *machine.alarms, *ahead)]
    result = Run(program, setup, control, machine, interpreter.alarms + told, halt)
    if strict and not result.ok:
        raise next(found for found in result.alarms if found.severity == ALARM)
    return result

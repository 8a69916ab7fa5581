"""The program that a form runs: a cycle alone with some values, the moves of the cycle itself, a blank behind them.

A cycle that probes and was given no part touches a block with its walls at the nominal points.
"""

from __future__ import annotations

import operator
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import reduce
from math import inf
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from mnclab.controls.choice import run as run_text
from mnclab.controls.cycle_steps import DECIMALS, CycleSteps, StepRow, steps
from mnclab.lab.forms.measuring import Measured, measured
from mnclab.machine import trial
from mnclab.machine.control import Control
from mnclab.machine.cycle import Cycle, Parameter
from mnclab.machine.setup import Setup
from mnclab.machine.touching import FEELS, PROBES
from mnclab.machining.steps import Go, Step, Touch, Turn, Wait
from mnclab.path.listing import figure
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array, Kind, Mask, Toolpath
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm
from mnclab.workpiece.blank import Blank, Box, Revolved
from mnclab.workpiece.part import Part, box, cylinder, plane

if TYPE_CHECKING:
    from mnclab.show.plot.picture import Picture

Values = Mapping[str, Any]  # by the name of a parameter; what is left out is not in it
STEP = 1e-4  # by which a value is changed to see what it measures, in its own unit; whole numbers by 1
ROOM = 0.15  # of a blank around what is cut, of its greatest side
BAR, BAR_LONG = 0.35, 1.4  # radius of a bar that is worked on its axis, of its length; least length of a bar, of its radius
WALL = 0.05  # of what is cut: a thinner wall between it and the datum stands on no corner of the blank
NEAR = 2.0  # times its own size: from so far away the datum is a corner of the blank
CUTS = (Kind.LINE, Kind.ARC)


class Example:
    """A cycle of a control on its own."""

    def __init__(self, control: Control, cycle: type[Cycle]) -> None:
        self.control, self.cycle = control, cycle
        self.setup = trial.on_its_machine(cycle, replace(control.trial_setup or Setup(), files=control.trial_files))
        if control.lathe:
            self.setup = replace(self.setup, start=(30, 0, 20))  # clear of the chuck's axis

    def program(self, values: Values) -> str | None:
        """Its text, without what is left at its default; None where no program around the cycle is known."""
        defaults = {p.name: p.default for p in self.cycle.parameters() if not p.required}
        return trial.program(self.control, self.cycle, {n: v for n, v in values.items() if v != defaults.get(n)})

    def steps(self, values: Values) -> CycleSteps:
        """The steps of the cycle without a program."""
        several = {p.name: p for p in self.cycle.parameters() if p.several}
        written = {n: trial.parted(v, several[n]) if n in several else v for n, v in values.items()}
        return steps(self.cycle.code, self.control.name, self.setup, **written)

    def run(self, values: Values) -> Run | None:
        """What its program does; a probe finds something to touch."""
        source, machine = self.program(values), self.setup
        if source is None:
            return None
        if self.cycle.does in (PROBES, FEELS):
            with suppress(Alarm):
                machine = replace(machine, part=touched_part(self.steps(values), machine.probe.clearance))
        return run_text(source, self.control.name, machine)

    def rows(self, path: Toolpath) -> Mask:
        """The moves of the cycle itself, not those of the program around it; all where it has none of its own."""
        for code in (f"{self.cycle.code} ", ""):  # or those of the cycle that it serves
            own = np.array([label.startswith(code) and label != "" for label in path.labels])[path.label]
            if (own & np.isin(path.kind, (*CUTS, Kind.PROBE))).any():
                return np.asarray(own)
        return np.ones(len(path), dtype=bool)

    def own(self, path: Toolpath) -> Toolpath:
        """These moves alone; on a cylinder as they lie on its developed surface."""
        on = path.cylinder == 0
        return path[on].unrolled() if on.any() else path[self.rows(path)]

    def moves(self, path: Toolpath, values: Values) -> CycleSteps:
        """What the cycle does in its program, as steps: it may have none without one."""
        found, rows = self.own(path), []
        for move in found[found.kind <= Kind.DWELL]:
            label, (x, y, z) = move.label.removeprefix(f"{self.cycle.code} "), move.end.tolist()
            feed = move.per_rev if np.isfinite(move.per_rev) else move.feed
            steps_of: dict[int, Step] = {Kind.ARC: Turn(label, move.sweep), Kind.PROBE: Touch(label, x, y, z, feed)}
            said = "rapid" if move.kind == Kind.RAPID else figure(feed, DECIMALS)
            moved = StepRow(steps_of.get(move.kind, Go(label)), (x, y, z), said)
            rows.append(StepRow(Wait(label, move.time)) if move.kind == Kind.DWELL else moved)
        per_rev = bool(np.isfinite(found.per_rev).any())
        return CycleSteps(self.cycle, values, tuple(found.start[0].tolist()), rows, lathe=path.lathe, per_rev=per_rev)

    def blank(self, path: Toolpath, values: Values) -> Blank | None:
        """A blank for what is cut: a bar, or a block with the datum at its corner where it is near."""
        cuts = path[np.isin(path.kind, CUTS)]
        if not len(cuts) or self.cycle.does in (PROBES, FEELS):
            return None
        low, high = cuts.bounds
        size = float((high - low).max())
        if path.lathe:
            radius, end = max(float(path.bounds[1, 0]), BAR * size), float(low[2])  # the cycle begins at its skin
            level = cuts.end[cuts.start[:, 0] == cuts.end[:, 0], 0]
            radius += ROOM * size if len(level) and level.max() > radius - SAME else 0.0  # but grooves of a face within it
            far = min(end - ROOM * size, max(0.0, end) - BAR_LONG * radius)  # it fills the picture, which is wider than high
            return Revolved(((radius, far), (radius, max(0.0, end))))
        tool = float(np.nan_to_num(cuts.radius).max())
        room = max(ROOM * size, 2 * tool, 1.0) * np.array([1.0, 1.0, 0.7])
        top = float(values.get("surface") or 0.0)
        corner = np.where((low - tool > WALL * size) & (low < NEAR * size + 2 * room), 0.0, low - room)
        corner[2], end = low[2] - room[2], high + room
        end[2] = top if top > corner[2] else float(high[2])
        return Box(tuple(corner.tolist()), tuple(end.tolist()))

    def plot(self, run: Run, values: Values, **options: Any) -> Picture:
        """The moves of the cycle with a blank behind them; `options` are those of `plot_path`."""
        from mnclab.show.plot.datums import places_of
        from mnclab.show.plot.path import overlays_of, plot_path
        from mnclab.show.plot.unrolled import plot_unrolled
        from mnclab.show.probed import felt as felt_of

        if (run.toolpath.cylinder >= 0).any():
            return unlinked(plot_unrolled(run.toolpath, size=options["size"], legend=False))
        rows = self.rows(run.toolpath)
        path, close = run.toolpath[rows], near(run.toolpath[rows])
        path = path if path.lathe else close  # the border of a lathe's picture cuts off: its tool stands at no end that is none
        shown: dict[str, Any] = {"stock": run.stock or self.blank(close, values), "places": places_of(run), "felt": felt_of(run)}
        if path.lathe and len(path):
            tools, numbers = run.tools_that_cut
            shown["tools"] = tools | {0: tools.get(int(numbers[rows][-1]), Tool())}
            if shown["stock"] is not None:
                with suppress(Alarm):
                    shown["part"] = run.workpiece(stock=shown["stock"].moved(path.origin))
        shown["overlays"] = overlays_of(run, centres=False, original=True, holes=True, fixtures=True)
        return unlinked(plot_path(path, alarms=run.alarms, rapids=run.rapids, legend=False, **shown, **options))

    def measured(self, run: Run, p: Parameter, values: Values) -> Measured | None:
        """What a parameter measures in the run with these values."""
        value = values.get(p.name)
        if not isinstance(value, int | float) or p.choices or p.mark or p.unit == "count" or value == inf:
            return None
        step = 1.0 if p.type == "integer" or p.unit.startswith("0.") else STEP
        for sign in (1, -1):
            with suppress(Alarm):
                other = self.run({**values, p.name: value + sign * step})
                if other is not None and other.ok:
                    found = measured(self.own(run.toolpath), self.own(other.toolpath), sign * step, value, p.unit)
                    if found is not None:
                        return found
        return None


def unlinked(picture: Any) -> Picture:
    """A picture whose moves, all of one line, cannot be clicked on; its `views` are kept."""
    picture.views, picture.seen = picture.seen, ()
    return cast("Picture", picture)


# Rapids from and to the heights where nothing happens would make what is cut small: they are cut off.

ABOVE, OVER = 0.1, 0.5  # of the greatest side of what is cut, or of how deep it is


def near(path: Toolpath) -> Toolpath:
    """A path without what its rapids do far above the cuts, on a lathe far off the bar, too."""
    cuts = path[np.isin(path.kind, (*CUTS, Kind.PROBE))]
    if not len(cuts):
        return path
    low, high = cuts.bounds
    roof = high + np.maximum(OVER * (high - low), ABOVE * (high - low).max())
    roof[[1] if path.lathe else [0, 1]] = np.inf
    way = path.end - path.start
    over = [(each > roof) & (path.kind == Kind.RAPID)[:, None] for each in (path.start, path.end)]
    share = np.divide(roof - path.start, way, out=np.zeros_like(way), where=over[0] != over[1])
    begin = np.where(over[0], share, 0.0).max(axis=1)
    until = np.where(over[1], share, 1.0).min(axis=1)
    kept = ((path.end <= roof) | (path.start <= roof)).all(axis=1) & (begin < until)
    start, end = (np.where(at[:, None] == whole, each, path.start + at[:, None] * way) for at, whole, each in (
        (begin, 0.0, path.start), (until, 1.0, path.end),
    ))  # fmt: skip
    return path.replace(start=start, end=end)[kept]


# A part for a cycle that probes, where nobody gave one: a block with a wall before each touch. Where every touch lies on the
# block that all walls enclose, the walls are its sides; else what stands around the touches is the material. A probe that goes
# round on arcs meets a stud or a bore, one that touches on several circles meets as many of them.

BALL = 2.0  # mm, the radius where a touch does not say it
BESIDE = 0.3  # of the greatest way between touches: how far the block goes beyond them
SAME = 1e-6  # mm


def touched_part(found: CycleSteps, clearance: float) -> Part | None:
    """What the touches of a cycle meet; `clearance` (mm) of the probe table, to which an own one of the cycle is added."""
    touches = list(_touches(found, clearance + (found.values.get("clearance") or 0.0)))
    if found.part is not None or not touches:
        return found.part
    place, way, ball = (np.array(each) for each in zip(*touches, strict=True))
    return _block(place, way, ball, any(isinstance(row.step, Turn) for row in found.rows))


def _touches(found: CycleSteps, gap: float) -> Iterator[tuple[Array, Array, float]]:
    """Of each touch where its wall is (3,), the way there (3,) of length 1, and the radius of its ball."""
    place = np.array(found.start)
    for row in found.rows:
        end = place if row.end is None else np.array(row.end)
        if isinstance(row.step, Touch) and (way := float(np.linalg.norm(end - place))) > 0:
            ball = row.step.ball or BALL
            ahead = (end - place) / way
            yield place + (0.0, 0.0, ball) + ahead * (ball + gap), ahead, ball
        place = end


def _block(place: Array, way: Array, ball: Array, round_: bool) -> Part:
    """Walls (n, 3) across the ways (n, 3) of their touches, or one round wall, with a top above the touches of walls."""
    wide = BESIDE * float(np.ptp(place, axis=0).max()) + 3 * float(ball.max())
    low, high = place.min(axis=0) - wide, place.max(axis=0) + wide
    high[2] = float((place[:, 2] + ball).max())
    for n in (*[len(way)] * round_, *range(3, len(way) // 2 + 1)):  # touches of a circle
        circles = [_circle(place[k : k + n], way[k : k + n]) for k in range(0, len(way), n)]
        if len(way) % n == 0 and all(off < SAME for *_, off in circles):
            bars = (cylinder((x, y, low[2] - wide), (x, y, high[2] + wide), abs(radius)) for x, y, radius, _ in circles)
            return (operator.sub if circles[0][2] > 0 else operator.and_)(box(low, high), reduce(operator.or_, bars))
    if len(way) == 2 and way[0] @ way[1] > 1 - SAME:  # a line, that may lean
        chord = place[1] - place[0]
        way = way - np.outer(way @ chord, chord) / max(chord @ chord, SAME)
    walls = [plane(*each) for each in zip(place, -way)]
    on_it = bool((np.einsum("jk,ijk->ij", way, place[:, None] - place) > -SAME).all())
    return reduce(operator.and_ if on_it else operator.or_, walls) & box(low, high)


def _circle(place: Array, way: Array) -> list[float]:
    """Middle, radius (below 0 where it is touched from outside) of the circle through places (n, 3), and how far off they are."""
    lines, flat = np.column_stack([np.repeat(np.eye(2), len(way), axis=0), way.T[:2].ravel()]), place.T[:2].ravel()
    found = np.linalg.lstsq(lines, flat, rcond=None)[0]  # centre + radius * way
    return [*found.tolist(), float(np.abs(lines @ found - flat).max())]

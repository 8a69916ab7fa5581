"""Runs of plain blocks, obeyed at once.

Programs from a CAM system are long runs of plain motion: axis words, a feed now and then, arcs. Here such a run becomes
columns: modal words are filled forward, increments summed, one matrix takes all points to the machine, arcs are vector
formulas. The one-by-one tier is the definition; this one must give the same rows, history and final state.

A block that would raise an alarm or a remark ends the run *before* it and goes to the other tier, which words it: one
text for one fault. The pieces grow while all is well and start small again after such a block.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.geometry.arcs import centre_from_radius, sweep
from mnclab.machine.axes import lean_to_tell
from mnclab.machine.coordinates import PLANES
from mnclab.machine.rows import LEAST_FEED, row_state
from mnclab.path.toolpath import Kind
from mnclab.running.drilling import FEWEST, Drilling, filled
from mnclab.text import given
from mnclab.text.program import Program

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine
    from mnclab.running.flow import Course

SHORTEST, LARGEST = 32, 1 << 15  # blocks obeyed at once: below, one by one is faster; above, the cache is lost

LETTERS = "GXYZIJKRF"  # the addresses of plain words
Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
NOTHING: Array = np.empty(0)
NO_MOTION = 99  # the sense of a G word that is none


@dataclass(frozen=True)
class PlainWords:
    """How a control reads its plain blocks.

    `motions` maps the value of a G word to the code of its motion and its sense (0 rapid, 1 line, ±2 arcs, sign as in
    +2 counter-clockwise); a control without such words has one entry, None. `ready` says whether plain words mean
    plain motion now, `absolute` whether positions are absolute. `letters` are those of `LETTERS` that the control has;
    other addresses change nothing in a plain block, but for three: `rapid`, one without a number, makes the motion of
    its block alone rapid, a block with `call` runs a cycle where it ends, and `ends_at` names one that ends a run now
    (R0 of Klartext, beside a contour). `helices` says whether arcs with a third coordinate need no word of their own now,
    and hears how many more were made; `straight_arcs` says whether an arc without R and centre is a straight line
    without a word, `whole_circles`: one without coordinates is a circle; where they are not, that is a fault.
    `zero_along`: a centre may be 0 along the axis of the arc. `unit` is what lengths and feeds are multiplied with, `feed`
    what feeds are besides.
    """

    motions: Mapping[float | None, tuple[str, int]]
    ready: Callable[[Machine], bool]
    absolute: Callable[[Machine], bool] = lambda m: m.modal.get("dimension", "G90") == "G90"
    keyword: str = ""
    tolerance: Callable[[Machine], float] = lambda m: float(m.settings.get("arc_tolerance", 0.01))
    helices: Callable[[Machine, int], bool] = lambda m, count: False
    zero_along: bool = False
    letters: str = LETTERS
    straight_arcs: Callable[[Machine], bool] = lambda m: False
    whole_circles: bool = True
    unit: Callable[[Machine], float] = lambda m: 1.0
    feed: Callable[[Machine], float] = lambda m: 1.0
    rapid: str = ""
    call: str = ""
    ends_at: Callable[[Machine], str] = lambda m: ""


@dataclass
class _Run:
    """A run worked out: what its rows are, and where it must stop."""

    points: Array  # (n + 1, 3) programmed
    tips: Array  # (n + 1, 3) machine
    motion: NDArray[np.int64]  # (n,) sense codes
    feed: Array  # (n,) modal feed after each block
    moves: Mask
    fault: Mask
    arc: Mask
    centre: Array = field(default_factory=lambda: NOTHING)  # (n, 3) and angle (n,) where there is an arc
    angle: Array = field(default_factory=lambda: NOTHING)
    helix: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, dtype=np.int64))  # which blocks are


class Bulk:
    """Finds and obeys the runs of one program."""

    def __init__(self, machine: Machine, flow: Course, program: Program, faulty: set[int]) -> None:
        control = machine.control
        self.rule: PlainWords | None = control.bulk
        self.machine, self.flow = machine, flow
        self.program, self.group = program, control.motion
        self.enabled = self.rule is not None and machine.settings.get("bulk", True)
        self.not_before, self.size, self.last = 0, SHORTEST, 0
        self.next_break = -1
        self.faulty = faulty
        if self.rule is None:
            return
        plain = program.plain.copy()
        plain[list(faulty)] = False
        if self.rule.keyword and self.rule.keyword in program.keywords:
            plain &= program.keyword == program.keywords.index(self.rule.keyword)
        self.index = {name: k for k, name in enumerate(program.addresses) if len(name) == 1 and name in LETTERS}
        strange = [k for name, k in self.index.items() if name not in self.rule.letters]
        if strange and len(of_them := np.flatnonzero(np.isin(program.address, strange))):
            plain[np.searchsorted(program.first, of_them, "right") - 1] = False
        self.calls_end = self._ends_of_calls(plain)
        self.breaks = np.append(np.flatnonzero(~plain), len(program))
        self.enabled = self.enabled and (len(program) - len(self.breaks) + 1 >= FEWEST or len(self.calls_end) > 0)
        self.codes = {value: code for value, (code, _) in self.rule.motions.items()}
        self.senses = {code: sense for code, sense in self.rule.motions.values()}
        self.next_break = int(self.breaks[0])
        self.keyword = program.keywords.index(self.rule.keyword) if self.rule.keyword in program.keywords else -1
        self.drilling = Drilling(self)

    def _ends_of_calls(self, plain: Mask) -> NDArray[np.int64]:
        """Of each block (b + 1,) where the run of plain blocks ends that call a cycle, of others the block itself; nothing
        where no block calls one. Those that do are plain no more."""
        program, rule = self.program, self.rule
        if rule is None or rule.call not in program.addresses:
            return np.empty(0, np.int64)
        words = np.flatnonzero(program.address == program.addresses.index(rule.call))
        called = np.zeros(len(program) + 1, dtype=bool)
        called[np.searchsorted(program.first, words, "right") - 1] = True
        called[:-1] &= plain
        plain &= ~called[:-1]
        ends = np.where(called, len(program), np.arange(len(program) + 1))
        return np.minimum.accumulate(ends[::-1])[::-1] if called.any() else ends[:0]

    def obey(self, first: int, stop: int) -> int:
        """Obey the plain blocks from `first` on; how many were, 0 if that one goes to the other tier."""
        if first < self.last:  # a jump, a call or a repeat has led back: what was found there counts no more
            self.not_before, self.next_break = 0, -1
        self.last = first
        if not self.enabled or first < self.not_before:
            return 0
        if len(self.calls_end) and self.calls_end[first] > first:
            return self.holes(first, stop, int(self.calls_end[first])) if self.may_call() else 0
        if first > self.next_break or self.next_break - first < SHORTEST:
            self.next_break = int(self.breaks[np.searchsorted(self.breaks, first)])
        if self.machine.position_cycle:
            return self.holes(first, stop, self.next_break)
        end = min(self.next_break, stop, first + self.size)
        if end - first < SHORTEST:
            self.not_before = end if self.next_break > first else first + 1
            return 0
        rule = self.rule
        assert rule is not None
        if self.machine.per_rev or self.machine.pending or not rule.ready(self.machine) or lean_to_tell(self.machine):
            return 0
        end = self.before_word(first, end, rule.ends_at(self.machine))
        if end - first < SHORTEST:
            self.not_before = end + 1
            return 0
        run = self.work_out(first, end)
        good = int(np.argmax(run.fault)) if run.fault.any() else end - first
        if good:
            self.commit(run, first, good)
        if good < end - first:
            self.not_before, self.size = first + good + 1, SHORTEST
        else:
            self.size = min(2 * self.size, LARGEST)
        return good

    def may_call(self) -> bool:
        """Whether a block may call the cycle at its place and do nothing else."""
        m, rule = self.machine, self.rule
        return rule is not None and m.cycle is not None and not (m.position_cycle or m.side) and rule.ready(m)

    def holes(self, first: int, stop: int, last: int) -> int:
        """Obey blocks of [first, stop) with holes, if those up to `last` make some; how many were."""
        if last - first < FEWEST:
            self.not_before = max(last, first + 1)
            return 0
        end = min(stop, first + self.size)
        done = self.drilling.obey(first, end)
        self.not_before = first + (done + 1 if done else FEWEST)
        self.size = min(8 * self.size, LARGEST) if done == end - first - 1 else SHORTEST
        return done

    def before_word(self, first: int, end: int, address: str) -> int:
        """Where the blocks [first, end) end that do not have an address."""
        addresses = self.program.addresses
        having = self.having(first, end, addresses.index(address)).tolist() if address in addresses else []
        return first + having[0] if having else end

    def having(self, first: int, end: int, address: int) -> NDArray[np.int64]:
        """Which of the blocks [first, end), from 0, have an address, by its number in the program."""
        starts = self.program.first
        a, b = int(starts[first]), int(starts[end])
        words = a + np.flatnonzero(self.program.address[a:b] == address)
        return np.asarray(np.searchsorted(starts, words, "right") - 1 - first)

    # --- what the run is ---------------------------------------------------------------------------------------------

    def columns(self, first: int, end: int) -> dict[str, Array]:
        """The words of the blocks by address (n,), nan where not written; an address that is never written is left out.

        Lengths and feeds are mm, whatever the program counts in.
        """
        program, n = self.program, end - first
        a, b = int(program.first[first]), int(program.first[end])
        address, value = program.address[a:b], program.value[a:b]
        if (unit := self.rule.unit(self.machine) if self.rule else 1.0) != 1:
            value = np.where(address == self.index.get("G", -1), value, value * unit)
        found: dict[str, Array] = {}
        block: NDArray[np.int64] | None = None
        for name, index in self.index.items():
            words = np.flatnonzero(address == index)
            if len(words) == n:  # a block has it once, so every block has it
                found[name] = value[words]
            elif len(words):
                if block is None:
                    block = np.repeat(np.arange(n), np.diff(program.first[first : end + 1]))
                found[name] = np.full(n, np.nan)
                found[name][block[words]] = value[words]
        if "F" in found and self.rule and (feed := self.rule.feed(self.machine)) != 1:
            found["F"] *= feed
        return found

    def work_out(self, first: int, end: int) -> _Run:
        """Everything about the blocks [first, end), faults included."""
        machine, rule = self.machine, self.rule
        assert rule is not None
        words, n = self.columns(first, end), end - first
        points, moves = machine.recorder.room(n), np.zeros(n, dtype=bool)
        same = machine.shift == (0.0, 0.0, 0.0) and machine.tip == machine.programmed == tuple(points[0].tolist())
        if not same:
            points = np.empty((n + 1, 3))
            points[0] = machine.programmed
        absolute = rule.absolute(machine)
        for k, axis in enumerate("XYZ"):
            start = machine.programmed[k]
            if axis not in words:
                points[1:, k] = start
                continue
            written = ~np.isnan(words[axis])
            moves |= written
            if absolute:
                points[1:, k] = filled(start, words[axis])
            else:
                points[:, k] = np.cumsum(np.concatenate([[start], np.where(written, words[axis], 0.0)]))
        tips = points if same else self.to_machine(points)  # no copy: memory costs more than the work on it

        no_feed = np.nan if machine.feed is None else machine.feed
        feed = filled(no_feed, words["F"]) if "F" in words else np.full(n, no_feed)
        motion, fault = self.motions(words.get("G"), n)
        if rule.rapid in self.program.addresses:
            motion[self.having(first, end, self.program.addresses.index(rule.rapid))] = 0
        arc = shaped = np.zeros(n, dtype=bool)
        for name in "IJKR":
            if name in words:
                shaped = shaped | ~np.isnan(words[name])
        if shaped.any():
            arc = (np.abs(motion) == 2) & shaped
            fault |= shaped & ~arc
            fault |= arc & ~moves & (not rule.whole_circles)
            moves |= arc
        fault |= moves & (np.abs(motion) == 2) & ~shaped & (not rule.straight_arcs(machine))
        go = int(np.argmax(moves)) if moves.any() else n  # until then the tool stands where it stood
        begin = tuple(tips[0].tolist())
        if begin != machine.tip:  # a transformation was switched, or the register was turned there and back
            tips = tips.copy() if tips is points else tips
            tips[: go + 1] = machine.tip

        fault |= moves & (motion != 0) & np.isnan(feed)  # without a feed
        if "F" in words:
            fault |= (words["F"] < LEAST_FEED) | (words["F"] >= given.LARGEST)
        for places in (points, tips)[: 1 if points is tips else 2]:
            if not (places.max() < given.LARGEST and places.min() > -given.LARGEST):
                fault |= ~(np.abs(places[1:]) < given.LARGEST).all(axis=1)
        run = _Run(points, tips, motion, feed, moves, fault, arc)
        if arc.any():
            self.arcs(run, words)
            run.fault[go] |= arc[go] and math.dist(begin, machine.tip) > rule.tolerance(machine)
        run.moves = moves & (_differ(tips[1:], tips[:-1]) | arc)
        return run

    def to_machine(self, points: Array) -> Array:
        shift = self.machine.shift
        return frames.apply(self.machine.matrix, points) if shift is None else points + np.array(shift)

    def motions(self, g: Array | None, n: int) -> tuple[NDArray[np.int64], Mask]:
        """The sense of each block's motion, and which blocks have a G word that is none."""
        if None in self.codes:
            return np.full(n, self.senses[self.codes[None]]), np.zeros(n, dtype=bool) if g is None else ~np.isnan(g)
        active = self.machine.modal.get(self.group, "")
        start = next((value for value, code in self.codes.items() if code == active), None)
        values = np.full(n, start, dtype=float) if g is None else filled(np.nan if start is None else start, g)
        sense = np.full(n, NO_MOTION)
        for value in set(self.codes) if g is not None else {start}:
            if value is not None:
                sense[values == value] = self.senses[self.codes[value]]
        return sense, sense == NO_MOTION

    def arcs(self, run: _Run, words: dict[str, Array]) -> None:
        """Centres and sweeps of the arcs; what is doubtful is a fault."""
        machine, rule = self.machine, self.rule
        assert rule is not None
        first, second, normal = PLANES[machine.plane]
        k: Any = slice(None) if run.arc.all() else np.flatnonzero(run.arc)
        start, end = run.points[:-1][k], run.points[1:][k]
        s, e = start[:, [first, second]], end[:, [first, second]]
        sense = np.sign(run.motion[k])
        tolerance = rule.tolerance(machine)
        to_centre = {axis: words[name][k] for axis, name in enumerate("IJK") if name in words}
        c = s.copy()
        for column, axis in enumerate((first, second)):
            if axis in to_centre:
                c[:, column] += np.where(np.isnan(to_centre[axis]), 0.0, to_centre[axis])
        at_start, at_end = np.hypot(*(s - c).T), np.hypot(*(e - c).T)
        fault = (np.abs(c) >= given.LARGEST).any(axis=1) | (at_start < 1e-9) | (np.abs(at_start - at_end) > tolerance)
        if (along := to_centre.get(normal)) is not None:
            fault |= ~(np.isnan(along) | (along == 0) & rule.zero_along)
        if "R" in words and (by := np.flatnonzero(~np.isnan(words["R"][k]))).size:
            radius, chord = words["R"][k][by], np.hypot(*(e - s)[by].T)
            c[by], shortage = centre_from_radius(s[by], e[by], radius, sense[by])
            reach = machine.settings.get("arc_reach", tolerance)
            fault[by] = (shortage > reach) | (chord < 1e-3) | (radius == 0)
            for offset in to_centre.values():
                fault[by] |= ~np.isnan(offset[by])
        run.fault[k] |= fault
        rises = start[:, normal] != end[:, normal]
        if rises.any() and rule.helices(machine, 0):
            run.helix = np.flatnonzero(run.arc)[rises]
        else:
            run.fault[k] |= rises  # the other tier remarks on it
        angle = sweep(s, e, c, sense)
        centre = np.empty_like(start)
        centre[:, first], centre[:, second], centre[:, normal] = c[:, 0], c[:, 1], start[:, normal]
        if machine.shift is None:
            run.fault[k] |= not machine.keeps_circles
            angle = angle * machine.orientation
        run.centre, run.angle = np.full(run.tips[1:].shape, np.nan), np.zeros(len(run.moves))
        run.centre[k], run.angle[k] = self.to_machine(centre), angle

    # --- doing it ----------------------------------------------------------------------------------------------------

    def commit(self, run: _Run, first: int, count: int) -> None:
        """Make the rows, the history and the state of the first `count` blocks."""
        machine = self.machine
        step = self.flow.begin_many(machine, first, count)
        steps = np.arange(step, step + count, dtype=np.int32)
        machine.step = step + count - 1
        self.log(run, steps, count)
        if helices := int(np.searchsorted(run.helix, count)):
            assert self.rule is not None
            self.rule.helices(machine, helices)
        machine.programmed = tuple(run.points[count].tolist())
        machine.tip = tuple(run.tips[count].tolist())
        machine.source_line = int(self.program.line_of(first + count - 1))
        moved = np.flatnonzero(run.moves[:count])
        if len(moved):  # last: rows closed up may take the room where the points were worked out
            self.rows(run, first, steps, moved if len(moved) < count else slice(0, count))

    def rows(self, run: _Run, first: int, steps: NDArray[np.int32], moved: NDArray[np.int64] | slice) -> None:
        motion, arc = run.motion[moved], run.arc[moved]
        kind = np.where(motion == 0, Kind.RAPID, np.where(arc, Kind.ARC, Kind.LINE)).astype(np.uint8)
        lines = np.asarray(self.program.line_of(slice(first, first + len(run.moves))))
        columns: dict[str, NDArray[Any]] = {
            "kind": kind,
            "line": lines[moved].astype(np.int32, copy=False),
            "step": steps[moved],
            "feed": np.where(motion == 0, np.inf, run.feed[moved]),
            "state": np.asarray(row_state(self.machine)),
        }
        if arc.any():
            columns |= {"centre": run.centre[moved], "sweep": run.angle[moved]}
        self.machine.recorder.bulk(columns, run.tips[1:][moved])

    def log(self, run: _Run, steps: NDArray[np.int32], count: int) -> None:
        """Changes of position, feed and motion, step by step."""
        machine, history = self.machine, self.machine.logs
        changed = np.flatnonzero(_differ(run.points[1 : count + 1], run.points[:count]))
        everywhere = len(changed) == count  # then no copy is needed
        points = run.points[1 : count + 1] if everywhere else run.points[changed + 1]
        history.extend("position", steps if everywhere else steps[changed], points)

        feed = run.feed[:count]
        start = np.nan if machine.feed is None else machine.feed
        changed = np.flatnonzero(~np.isnan(feed) & (feed != np.concatenate([[start], feed[:-1]])))
        if len(changed):
            history.extend("feed", steps[changed], feed[changed])
            machine.put(feed=float(feed[-1]))

        if self.group and None not in self.codes:
            active = self.senses.get(machine.modal.get(self.group, ""), 99)
            motion = run.motion[:count]
            changed = np.flatnonzero(motion != np.concatenate([[active], motion[:-1]]))
            if len(changed):
                names = np.empty(2 * NO_MOTION, dtype=object)  # by the sense, negative ones from the end
                names[list(self.senses.values())] = list(self.senses)
                history.extend(self.group, steps[changed], names[motion[changed]].tolist())
                machine.modal[self.group] = names[motion[-1]]


def _differ(a: Array, b: Array) -> Mask:
    """Which points (n, 3) are not equal; column by column, which is faster than along rows."""
    return (a[:, 0] != b[:, 0]) | (a[:, 1] != b[:, 1]) | (a[:, 2] != b[:, 2])

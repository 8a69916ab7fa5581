"""Blocks of holes, obeyed at once.

A program of a hundred thousand holes says a few things over and over: a cycle with its data, places, G80. What such a block
does follows from its words and from what the machine remembers, but for the place, by which it is moved. So blocks are obeyed
one by one until the same words have twice done the same to a machine that stood the same. From then on what they do is known
(an `Act`), and whole groups of holes become columns: rows, steps and history of what was done, moved to each place.

The last block of a stretch goes one by one again, so that what the machine remembers of its last block is right without any
bookkeeping here.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.machine.state import HOLES, TABLE, Snapshot, copied, same
from mnclab.path.toolpath import Array
from mnclab.running.repeating import SAME, Visit, alike, anywhere, moved, remembered, visit
from mnclab.text.alarm import Alarm, Span
from mnclab.text.given import LARGEST
from mnclab.text.program import NONE, NUMBER

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine
    from mnclab.running.bulk import Bulk

FEWEST = 8  # holes in a row with which blocks begin to be learned, …
MOST_NEW = 8  # … and blocks that are learned before others are repeated
MOST_STANDINGS = 512  # that are kept
FAR = LARGEST / 2  # mm from zero: blocks beyond go one by one
Key = tuple[Any, ...]  # of a block: whether it has a place, then numbers of addresses and values


class Standing:
    """What a machine remembers between two blocks but for its place; and what is known that blocks do to it."""

    def __init__(self, m: Machine, values: dict[str, Any]) -> None:
        self.values, self.level, self.position_cycle = Snapshot(values), m.programmed[2], copied(m.position_cycle)
        self.acts: dict[Key, Act | None] = {}  # None: what is not to be repeated


class Warned(NamedTuple):
    """A warning, and at which word of its block, counted without X and Y; -1 for the block."""

    message: str
    hint: str
    word: int


@dataclass(eq=False)
class Act:
    """What a block does: its rows, what the history hears beside the position, and whether it hears that; the warnings that
    it gives; how the machine stands `then`. It is `sure` once it was seen twice."""

    visit: Visit
    heard: dict[str, Any]
    went: bool
    warned: tuple[Warned, ...]
    then: Standing
    sure: bool = False


class Stretch:
    """Blocks [first, first + n) that say nothing but numbers, each to another place in the plane or to none.

    `places` (n + 1, 2) are where the tool is before and after each; `runs` end at the blocks `ends`, counted from the
    first: the words but X and Y of their blocks are the same.
    """

    def __init__(self, bulk: Bulk, first: int, end: int) -> None:
        program, rule = bulk.program, bulk.rule
        assert rule is not None
        n, starts = end - first, program.first[first : end + 1]
        words = slice(int(starts[0]), int(starts[-1]))
        address, value = program.address[words], program.value[words]
        block = np.repeat(np.arange(n), np.diff(starts))
        fault = (program.skip[first:end] != 0) | (program.keyword[first:end] != bulk.keyword)
        fault[[k - first for k in bulk.faulty if first <= k < end]] = True
        form = program.form[words]
        fault[block[(form != NUMBER) & (form != NONE) | (program.flag[words] != 0)]] = True
        self.places, placed = np.empty((n + 1, 2)), np.zeros(n, dtype=bool)
        absolute, unit = rule.absolute(bulk.machine), rule.unit(bulk.machine)
        of_plane = np.zeros(len(address), dtype=bool)
        for k, axis in enumerate("XY"):
            of_axis = address == bulk.index.get(axis, -1)
            at = block[of_axis]
            fault[at[1:][at[1:] == at[:-1]]] = True
            column = np.full(n + 1, np.nan if absolute else 0.0)
            column[0] = bulk.machine.programmed[k]
            column[1:][at] = value[of_axis] * unit
            if absolute:
                last = np.maximum.accumulate(np.where(np.isnan(column), 0, np.arange(n + 1)))
                self.places[:, k] = column[last]
            else:
                self.places[:, k] = np.cumsum(column)
            placed[at] = True
            of_plane |= of_axis
        moves = (self.places[1:] != self.places[:-1]).any(axis=1)
        level = np.full(n, bulk.machine.programmed[2])
        tips = frames.apply(bulk.machine.matrix, np.column_stack([self.places[1:], level]))
        fault |= (placed & ~moves) | (np.abs(tips) >= FAR).any(axis=1) | (np.abs(self.places[1:]) >= FAR).any(axis=1)
        self.n = int(np.argmax(fault)) if fault.any() else n
        self._placed, others = placed, ~of_plane
        self._first = np.concatenate([[0], np.cumsum(others)])[starts - starts[0]]  # of the other words of each block
        self._address, self._value = address[others], value[others]
        self.ends = self._ends(block[others])

    def _ends(self, block: NDArray[np.int64]) -> list[int]:
        """Where runs end, from the blocks of the words but X and Y."""
        size, placed = np.diff(self._first), self._placed
        same_as_before = np.zeros(len(size), dtype=bool)
        same_as_before[1:] = (size[1:] == size[:-1]) & (placed[1:] == placed[:-1])
        here = np.flatnonzero(same_as_before[block])
        before = here - size[block[here]]
        differs = (self._address[here] != self._address[before]) | (self._value[here] != self._value[before])
        same_as_before[block[here[differs]]] = False
        return [*np.flatnonzero(~same_as_before)[1:].tolist(), len(size)]

    def key(self, block: int) -> Key:
        """What is said there, but for the place."""
        words = slice(*self._first[block : block + 2].tolist())
        return bool(self._placed[block]), *self._address[words].tolist(), *self._value[words].tolist()


class Drilling:
    """Learns what blocks of holes do, and does it."""

    def __init__(self, bulk: Bulk) -> None:
        self.bulk, self.machine, self.flow = bulk, bulk.machine, bulk.flow
        self.recorder = bulk.machine.recorder
        self.known: dict[Key, list[Standing]] = {}
        self.count = 0

    def obey(self, first: int, end: int) -> int:
        """Obey blocks of [first, end), if there are holes; how many were."""
        m = self.machine
        if m.pole is not None or m.pending or not anywhere(m) or np.abs(np.subtract(m.tip, m.to_machine(m.programmed))).max() > SAME:
            return 0
        stretch = Stretch(self.bulk, first, end)
        if min(stretch.n, stretch.ends[0]) < FEWEST:
            return 0
        here, k, run, new = self.standing(), 0, 0, 0
        plan: list[tuple[Act, int]] = []
        begun, start = 0, here
        while k < stretch.n - 1:
            while stretch.ends[run] <= k:
                run += 1
            key = stretch.key(k)
            act = here.acts.get(key)
            if act and act.sure:
                count = min(stretch.ends[run], stretch.n - 1) - k if act.then is here else 1
                plan.append((act, count))
                here, k, new = act.then, k + count, 0 if count >= FEWEST else new
                continue
            self.carry_out(plan, start, first + begun, stretch.places[begun : k + 1])
            plan = []
            if new == MOST_NEW or key in here.acts and act is None:
                return k
            act = self.learn(here, key, first + k, stretch.places[k + 1])
            k, begun, new = k + 1, k + 1, new + 1
            if act is None:
                return k
            here = start = act.then
        self.carry_out(plan, start, first + begun, stretch.places[begun : k + 1])
        return k

    def standing(self) -> Standing:
        """How the machine stands now."""
        m = self.machine
        if m.recorder is not self.recorder or self.count >= MOST_STANDINGS:  # numbers of labels and states are others there
            self.recorder, self.known, self.count = m.recorder, {}, 0
        values, definition = remembered(m, HOLES), m.position_cycle
        if definition is not None:  # the words of its block count no more, but for what is modal
            modal = {p.name: definition.values.get(p.name) for p in definition.cycle.parameters() if p.modal}
            values |= {"called": definition.cycle, "modal values": modal, "extra": definition.extra}
        alike = self.known.setdefault((m.programmed[2], m.feed, *m.modal.values()), [])
        found = next((one for one in alike if not one.values.differences(values)), None)
        if found is None:
            found = Standing(m, values)
            alike.append(found)
            self.count += 1
        return found

    def reads(self) -> tuple[object, ...]:
        """What it depends on where the places of blocks lie."""
        rule, m = self.bulk.rule, self.machine
        assert rule is not None
        return rule.absolute(m), rule.unit(m), m.matrix.tobytes()

    def learn(self, here: Standing, key: Key, block: int, place: Array) -> Act | None:
        """Obey one block that leads to a place (2,), and note what it does; None if that is not to be repeated."""
        m, flow, before = self.machine, self.flow, (self.reads(), self.flow.standing(), self.flow.begun + 1)
        known, here.acts[key] = here.acts.get(key), None
        flow.current, said = block, list[Alarm]()
        try:
            with m.within(noted=set(), alarms=said):  # also those that were given here before
                made = visit(m, place, partial(flow.obey, block))
        finally:
            for alarm in said:
                m.warn(alarm.message, alarm.span, alarm.hint)
        spans = self.spans(block)
        warned = tuple(Warned(one.message, one.hint, spans.index(one.span) - 1) for one in said if one.span in spans)
        if made is None or m.ended or before != (self.reads(), flow.standing(), flow.begun) or len(said) > len(warned):
            return None
        if made.left[1].any() or (np.abs(made.left[0]) > SAME).any() or (np.abs(made.ends) >= FAR).any():
            return None
        heard = {name: log.values[-1] for name, log in m.logs.by_name.items() if log.steps and log.steps[-1] == m.step}
        went = heard.pop("position", None) is not None
        act = Act(made, heard, went, warned, self.standing())
        if known:
            told = known.went == went and known.warned == warned and same(known.heard, heard)
            if not (told and known.then is act.then and alike(known.visit, made)):
                return None
            act.sure = True
        here.acts[key] = act
        return act

    def spans(self, block: int) -> list[Span]:
        """Where a block stands, and its words but X and Y."""
        words = (word.span for word in self.bulk.program[block].words if word.address not in ("X", "Y"))
        return [self.flow.span_of_block(block), *(span._replace(program=self.machine.program) for span in words)]

    def carry_out(self, plan: list[tuple[Act, int]], before: Standing, first: int, places: Array) -> None:
        """Do what so many blocks each do, from block `first` on; `places` (n + 1, 2) begin where the tool is."""
        if not plan:
            return
        m, n = self.machine, len(places) - 1
        acts = list(dict.fromkeys(act for act, _ in plan))
        which = np.repeat([acts.index(act) for act, _ in plan], [count for _, count in plan])
        step = self.flow.begin_many(m, first, n)
        steps = np.arange(step, step + n, dtype=np.int32)
        lines = np.asarray(self.bulk.program.line_of(slice(first, first + n))).astype(np.int32)
        points = np.column_stack([places[1:], np.array([act.then.level for act in acts])[which]])
        went = np.array([act.went for act in acts])[which]
        m.logs.extend("position", steps[went], points[went])
        for name in dict.fromkeys(name for act in acts for name in act.heard):
            of = np.array([name in act.heard for act in acts])[which]
            m.logs.extend(name, steps[of], [acts[k].heard[name] for k in which[of].tolist()])
        moved(m, [act.visit for act in acts], which, points, steps, lines)
        m.step = step + n - 1
        for k in np.flatnonzero(np.array([bool(act.warned) for act in acts])[which]).tolist():
            spans = self.spans(first + k)
            for message, hint, word in acts[which[k]].warned:
                m.warn(message, spans[word + 1], hint)
        then = plan[-1][0].then
        if then is not before:
            changed = set(before.values.differences(then.values)) & TABLE.keys()
            now = then.values.taken_out()
            m.put(position_cycle=copied(then.position_cycle), **{name: now[name] for name in changed})

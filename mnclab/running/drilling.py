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
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.machine.state import HOLES, TABLE, Snapshot, copied, same
from mnclab.path.toolpath import Array, Index, Mask
from mnclab.running.repeating import SAME, Visit, alike, anywhere, moved, remembered, visit
from mnclab.text.alarm import Alarm, Span
from mnclab.text.given import LARGEST
from mnclab.text.program import EXPRESSION, TEXT

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine
    from mnclab.running.bulk import Bulk

FEWEST = 8  # holes in a row with which blocks begin to be learned, …
MOST_NEW = 16  # … and blocks that are learned before others are repeated
MOST_STANDINGS = 512  # that are kept
FAR = LARGEST / 2  # mm from zero: blocks beyond go one by one
Key = tuple[Any, ...]  # of a block: whether it has a place, then numbers of addresses and values


def filled(start: float, column: Array) -> Array:
    """The last value that is not nan, going down a column (n,) that begins after `start`."""
    at = np.flatnonzero(column == column)
    if len(at) == len(column):
        return column
    return np.concatenate([[start], column[at]]).repeat(np.diff(at, prepend=0, append=len(column)))


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
    """Blocks [first, first + n) that say nothing but numbers, each leads to another place in the plane or says none.

    `places` (n + 1, 2) are where the tool is before and after each. `runs` are those that say the same but X and Y: the block
    at which one ends, counted from the first, and what it says.
    """

    def __init__(self, bulk: Bulk, first: int, end: int) -> None:
        m, program, rule = bulk.machine, bulk.program, bulk.rule
        assert rule is not None
        n, starts = end - first, program.first[first : end + 1]
        words = slice(int(starts[0]), int(starts[-1]))
        address, value, block = program.address[words], program.value[words], np.arange(n).repeat(np.diff(starts))
        absolute, unit = rule.absolute(m), rule.unit(m)
        self.places, placed = np.empty((n + 1, 2)), np.zeros(n, dtype=bool)
        others, fault = np.ones(len(address), dtype=bool), np.zeros(n, dtype=bool)
        for k, axis in enumerate("XY"):
            of_axis = np.flatnonzero(address == bulk.index.get(axis, -1))
            at, column, start = block[of_axis], np.full(n, np.nan if absolute else 0.0), m.programmed[k]
            column[at], self.places[0, k] = value[of_axis] * unit, start
            self.places[1:, k] = filled(start, column) if absolute else np.cumsum(np.concatenate([[start], column]))[1:]
            placed[at], others[of_axis] = True, False
            fault[at[1:][at[1:] == at[:-1]]] = True  # twice in a block
        x, y = self.places.T
        fault |= placed != ((x[1:] != x[:-1]) | (y[1:] != y[:-1]))
        self.n = int(np.argmax(fault)) if fault.any() else n
        if max(np.abs(m.matrix).max(), 1) * (np.abs(self.places).max() + np.abs(m.programmed).max()) > FAR:
            self.n = 0
        said = np.flatnonzero(others)
        self.runs = _runs(placed, block[said], address[said], value[said])


def _runs(placed: Mask, block: Index, address: NDArray[np.integer[Any]], value: Array) -> list[tuple[int, Key]]:
    """Runs of blocks (n,) that are all `placed` or not and have the same words (w,), which `block` they stand in."""
    n = len(placed)
    size = np.bincount(block, minlength=n)
    begins = np.ones(n, dtype=bool)
    begins[1:] = (size[1:] != size[:-1]) | (placed[1:] != placed[:-1])
    here = np.flatnonzero(~begins[block])
    before = here - size[block[here]]
    begins[block[here[(address[here] != address[before]) | (value[here] != value[before])]]] = True
    of_runs = begins[block]
    words = list(zip(address[of_runs].tolist(), value[of_runs].tolist(), strict=True))
    stops = np.cumsum(size[begins]).tolist()
    ends = [*np.flatnonzero(begins)[1:].tolist(), n]
    parts = zip(placed[begins].tolist(), [0, *stops], stops)
    return [(end, (where, *words[a:b])) for end, (where, a, b) in zip(ends, parts, strict=True)]


class Drilling:
    """Learns what blocks of holes do, and does it."""

    def __init__(self, bulk: Bulk) -> None:
        self.bulk, self.machine, self.flow = bulk, bulk.machine, bulk.flow
        self.recorder = bulk.machine.recorder
        self.known: dict[Key, list[Standing]] = {}
        self.count = 0

    @cached_property
    def strange(self) -> Index:
        """The blocks (k,) that say other than numbers, and the end of the program."""
        program = self.bulk.program
        other = (program.form == EXPRESSION) | (program.form == TEXT) | (program.flag != 0)
        blocks = (program.skip != 0) | (program.keyword != self.bulk.keyword)
        blocks[np.searchsorted(program.first, np.flatnonzero(other), "right") - 1] = True
        blocks[list(self.bulk.faulty)] = True
        return np.append(np.flatnonzero(blocks), len(program))

    def obey(self, first: int, end: int) -> int:
        """Obey blocks of [first, end), if there are holes; how many were."""
        m = self.machine
        end = min(end, int(self.strange[np.searchsorted(self.strange, first)]))
        aside = np.subtract(m.tip, m.to_machine(m.programmed))  # a frame was switched
        if end - first < FEWEST or m.pole is not None or m.pending or not anywhere(m) or np.abs(aside).max() > SAME:
            return 0
        stretch = Stretch(self.bulk, first, end)
        if min(stretch.n, stretch.runs[0][0]) < FEWEST:
            return 0
        here, made = self.standing(), m.recorder.made
        start = here
        k = begun = new = 0
        most = int(min(m.recorder.most, 1 << 60))  # rows
        plan: list[tuple[Act, int]] = []
        for stop, key in stretch.runs:
            stop = min(stop, stretch.n - 1)
            while k < stop:
                act = here.acts.get(key)
                if act and act.sure:
                    count = stop - k if act.then is here else 1
                    if made + count * len(act.visit.rows) > most:  # the other tier says at which block
                        self.carry_out(plan, start, first + begun, stretch.places[begun : k + 1])
                        return k
                    made += count * len(act.visit.rows)
                    plan.append((act, count))
                    here, k, new = act.then, k + count, 0 if count >= FEWEST else new
                    continue
                self.carry_out(plan, start, first + begun, stretch.places[begun : k + 1])
                plan.clear()
                if new == MOST_NEW or (key in here.acts and act is None):
                    return k
                act = self.learn(here, key, first + k, stretch.places[k + 1])
                k, new = k + 1, new + 1
                if act is None:
                    return k
                here = start = act.then
                begun, made = k, m.recorder.made
        self.carry_out(plan, start, first + begun, stretch.places[begun : k + 1])
        return k

    def standing(self) -> Standing:
        """How the machine stands now."""
        m = self.machine
        if m.recorder is not self.recorder or self.count >= MOST_STANDINGS:  # numbers of labels and states are others there
            self.recorder, self.known, self.count = m.recorder, {}, 0
        values, definition = remembered(m, HOLES), m.position_cycle
        key: Key = (m.programmed[2], m.feed, *m.modal.values())
        if definition is not None:  # the words of its block count no more, but for what is modal
            modal = {p.name: definition.values.get(p.name) for p in definition.cycle.parameters() if p.modal}
            values |= {"called": definition.cycle, "modal values": modal, "extra": definition.extra}
            key += definition.cycle, *(value for value in modal.values() if isinstance(value, float))
        near = self.known.setdefault(key, [])
        found = next((one for one in near if not one.values.differences(values)), None)
        if found is None:
            found = Standing(m, values)
            near.append(found)
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
        flow.current, said, noted = block, list[Alarm](), set[tuple[str, Span | None]]()
        try:
            with m.within(noted=noted, alarms=said):  # also those that were given here before
                made = visit(m, place, partial(flow.obey, block))
        finally:
            for alarm in said:
                if (alarm.message, alarm.span) in noted:
                    m.warn(alarm.message, alarm.span, alarm.hint)
                else:
                    m.alarms.append(alarm)
        spans = self.spans(block) if said else []
        warned = tuple(Warned(one.message, one.hint, spans.index(one.span) - 1) for one in said if one.span in spans)
        if made is None or m.ended or before != (self.reads(), flow.standing(), flow.begun) or len(said) > len(warned):
            return None
        if made.left[1].any() or (np.abs(made.left[0]) > SAME).any() or (np.abs(made.ends) >= FAR).any():
            return None
        heard = {name: log.values[-1] for name, log in m.logs.by_name.items() if log.steps and log.steps[-1] == m.step}
        went = heard.pop("position", None) is not None
        act = Act(made, heard, went, warned, self.standing(), sure=not len(made.rows))  # which the place does not alter
        if known:
            told = known.went == went and known.warned == warned and same(known.heard, heard)
            if not (told and known.then is act.then and alike(known.visit, made)):
                return None
            act.sure = True
        here.acts[key] = act
        return act

    def spans(self, block: int) -> list[Span]:
        """Where a block stands, and its words but X and Y."""
        return [self.flow.span_of_block(block), *(self.span(word) for word in self.words(block))]

    def words(self, block: int) -> list[int]:
        """The words of a block but X and Y, by their numbers in the program."""
        program = self.bulk.program
        a, b = program.first[block : block + 2].tolist()
        return [k for k, address in enumerate(program.address[a:b].tolist(), a) if program.addresses[address] not in ("X", "Y")]

    def span(self, word: int) -> Span:
        return self.bulk.program.word(word).span._replace(program=self.machine.program)

    def carry_out(self, plan: list[tuple[Act, int]], before: Standing, first: int, places: Array) -> None:
        """Do what so many blocks each do, from block `first` on; `places` (n + 1, 2) begin where the tool is."""
        if not plan:
            return
        m, n = self.machine, len(places) - 1
        acts = list(dict.fromkeys(act for act, _ in plan))
        number = {act: k for k, act in enumerate(acts)}
        which = np.repeat([number[act] for act, _ in plan], [count for _, count in plan])
        step = self.flow.begin_many(m, first, n)
        steps = np.arange(step, step + n, dtype=np.int32)
        lines = np.asarray(self.bulk.program.line_of(slice(first, first + n))).astype(np.int32)
        points = np.column_stack([places[1:], np.array([act.then.level for act in acts])[which]])
        went = np.array([act.went for act in acts])[which]
        m.logs.extend("position", *((steps, points) if went.all() else (steps[went], points[went])))
        for name in dict.fromkeys(name for act in acts for name in act.heard):
            of = np.array([name in act.heard for act in acts])[which]
            m.logs.extend(name, steps[of], [acts[k].heard[name] for k in which[of].tolist()])
        rows = sum(count * len(act.visit.rows) for act, count in plan)
        m.recorder.expect(rows * (len(self.bulk.program) - first) // n)
        moved(m, [act.visit for act in acts], which, points, steps, lines)
        m.step = step + n - 1
        for k in np.flatnonzero(np.array([bool(act.warned) for act in acts])[which]).tolist():
            words = self.words(first + k)
            for message, hint, word in acts[which[k]].warned:
                m.warn(message, self.flow.span_of_block(first + k) if word < 0 else self.span(words[word]), hint)
        then = plan[-1][0].then
        if then is not before:
            changed = set(before.values.differences(then.values)) & TABLE.keys()
            now = then.values.taken_out()
            m.put(position_cycle=copied(then.position_cycle), **{name: now[name] for name in changed})

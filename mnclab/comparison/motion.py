"""What a path does, said one way: its moves without what two programs may say otherwise and mean the same.

Rows without a way are left out, moves that go straight on and arcs of one circle are one, and what belongs to a move stands with
it: feed, speed, coolant, tool, side, and the dwell behind it. Lengths in mm, feeds in mm/min, speeds in rev/min, angles in rad.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.path.listing import point
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath, gathered

NO_WAY = 1e-6  # mm: less is no move
STRAIGHT = 1e-8  # mm beside the chord of two moves: they go straight on
ALIKE = 1e-6  # mm between the centres, and mm/rad between the pitches, of two arcs of one circle
ARM = 100.0  # mm from a rotary axis: a place there must agree too
KEPT = (
    "kind", "start", "end", "centre", "axis", "sweep", "rotary", "feed", "per_rev", "surface", "spindle", "radius", "side",
    "synchronous",
)  # fmt: skip
STARTS = (3, 4, 13, 14)  # M functions that start the spindle
MODAL = ("dimension", "plane", "datum")
OF_MACHINE = ("frame datum", "frame preset", "frame secondary", "frame length")
OFF = ("M9", None)  # what stands in the history while there is no coolant


@dataclass(frozen=True, eq=False)
class Motion:
    """Moves (m,), in order; `row` and `last` (m,) are the first and the last row of the path that make each.

    `dwell` (m + 1,) is the time before the first move and behind each, s, inf where the program stops (M0), `pause` the row of
    it. `tool` (m,) are places in one list of tools, of which what cuts alike is one. `cuts` are the moves but rapids, `link` (m,)
    says before which of the cuts a move stands. `held` are the first cuts with a tool for which the spindle was not started: it
    turned before the change. `contour` is the path as it was programmed, before compensation. `at_end` is speed, coolant, side
    as the program leaves them, `left` what else of it is modal, in words.
    """

    path: Toolpath
    contour: Toolpath
    row: Index
    last: Index
    kind: Array
    start: Array
    end: Array
    centre: Array
    axis: Array
    sweep: Array
    rotary: Array
    feed: Array
    per_rev: Array
    surface: Array
    spindle: Array
    radius: Array
    coolant: Array
    tool: Array
    side: Array
    synchronous: Mask
    held: Mask
    dwell: Array
    pause: Index
    cuts: Index
    link: Index
    at_end: tuple[float, int, int]
    left: dict[str, str]
    positions: Any  # those of the axes behind each row, when asked for

    def __len__(self) -> int:
        return len(self.row)

    @cached_property
    def lengths(self) -> Array:
        """The way of each move (m,), mm."""
        return np.add.reduceat(self.path.lengths, self.row) if len(self) else np.empty(0)

    @cached_property
    def tool_along(self) -> Array | None:
        """The direction of the tool on the part at the end of each move (m, 3); None where the machine does not say it."""
        return None if self.path.kinematics is None else self.path.directions[self.last]

    @cached_property
    def axes(self) -> Array:
        """X Y Z of the axes (n, 6) behind the rows, less the length of the tool, and their angles as mm at `ARM`."""
        found = np.array(positions := self.positions())
        found[:, :3] -= np.multiply.outer(positions.lengths, [0.0, 0.0, 1.0]) + self.path.origin
        return np.concatenate([found[:, :3], ARM * np.radians(found[:, 3:])], axis=1)

    @cached_property
    def turns(self) -> bool:
        """Whether a rotary axis stands anywhere but at zero."""
        return bool(self.rotary.any())


def motion_of(run: Any, tools: list[Any]) -> Motion:
    """The moves of a run; its tools are found in `tools`, a list for all runs that are compared, or added."""
    path: Toolpath = run.toolpath
    n = len(path)
    tips = _true_tips(path) + np.where(path.kind == Kind.RAPID, 0.0, run.tip_lift)
    beside = {"coolant": _coolant(run), "tool": _tools(run, tools), "held": _held(run)}
    travel = np.abs(path.end - path.start).max(axis=1)
    turned = np.abs(np.diff(path.rotary, axis=0, prepend=path.rotary[:1])).max(axis=1) * ARM
    rows = np.flatnonzero(path.is_motion & ((np.maximum(travel, turned) > NO_WAY) | (path.kind == Kind.ARC)))
    event = np.isin(path.kind, (Kind.DWELL, Kind.TOOL, Kind.STOP))
    kept = {name: getattr(path, name) for name in KEPT} | beside
    columns: dict[str, Any] = {name: gathered(each, rows) for name, each in kept.items()}
    if tips.any():
        columns |= {name: columns[name] + np.outer(tips[rows], [0.0, 0.0, 1.0]) for name in ("start", "end", "centre")}
    goes_on = _goes_on(columns, np.cumsum(event)[rows])
    first = np.flatnonzero(~goes_on)
    last = np.append(first[1:], len(rows))[: len(first)] - 1
    if len(first) < len(rows):
        ends = {"end": columns["end"][last], "sweep": np.add.reduceat(columns["sweep"], first)}
        columns = {name: gathered(each, first) for name, each in columns.items()} | ends
    dwell, pause = np.zeros(len(first) + 1), np.full(len(first) + 1, -1, dtype=np.int64)
    events = np.flatnonzero(np.isin(path.kind, (Kind.DWELL, Kind.STOP)))
    behind = np.searchsorted(rows[first], events)
    np.add.at(dwell, behind, np.where(path.kind[events] == Kind.STOP, np.inf, np.nan_to_num(path.time[events])))
    pause[behind] = events
    cuts = np.flatnonzero(columns["kind"] != Kind.RAPID)
    at_end = (float(path.spindle[-1]), int(beside["coolant"][-1]), int(path.side[-1])) if n else (0.0, 0, 0)
    link = np.searchsorted(cuts, np.arange(len(first)))
    columns |= {"dwell": dwell, "pause": pause, "cuts": cuts, "link": link}
    return Motion(path, run.programmed, rows[first], rows[last], **columns, at_end=at_end, left=_left(run), positions=run.axes)


def _goes_on(columns: dict[str, Any], event: NDArray[Any]) -> Mask:
    """Which rows (k,) go on with what the one before does: straight on, or about the same circle."""
    kind, k = columns["kind"], len(event)
    found = np.zeros(k, dtype=bool)
    same = (kind[1:] == kind[:-1]) & (event[1:] == event[:-1]) & (columns["rotary"][1:] == columns["rotary"][:-1]).all(axis=1)
    alike = np.ones(len(same), dtype=bool)
    for name in ("feed", "per_rev", "surface", "spindle", "coolant", "side", "tool", "radius", "synchronous"):
        if k and (here := columns[name]).strides[0]:
            alike &= (here[1:] == here[:-1]) | ((here[1:] != here[1:]) & (here[:-1] != here[:-1]))
    same &= alike | (kind[1:] == Kind.RAPID)
    at = np.flatnonzero(same & (kind[1:] != Kind.ARC) & (kind[1:] != Kind.PROBE))
    way = columns["end"] - columns["start"]
    one, other = way[at], way[at + 1]
    chord = np.linalg.norm(one + other, axis=1)
    beside = np.linalg.norm(np.cross(one, other), axis=1) <= STRAIGHT * chord
    found[at[beside & (np.einsum("ij,ij->i", one, other) > 0)] + 1] = True
    at = np.flatnonzero(same & (kind[1:] == Kind.ARC))
    if len(at):
        centre, axis, sweep = (columns[name] for name in ("centre", "axis", "sweep"))
        across = np.einsum("ij,ij->i", way, axis)
        with np.errstate(divide="ignore", invalid="ignore"):
            pitch = across / sweep
        shift = centre[at + 1] - centre[at]
        shift -= np.einsum("ij,ij->i", shift, axis[at])[:, None] * axis[at]
        near = (np.abs(shift).max(axis=1) <= ALIKE) & (np.abs(axis[at + 1] - axis[at]).max(axis=1) <= ALIKE)
        found[at[near & (sweep[at] * sweep[at + 1] > 0) & (np.abs(pitch[at + 1] - pitch[at]) <= ALIKE)] + 1] = True
    return found


def _coolant(run: Any) -> Array:
    """What flows on each row (n,): 0 nothing, 1 what M8 switches on, 2 what M7 does."""
    path, known = run.toolpath, run.history
    rows = np.flatnonzero(path.kind == Kind.COOLANT)
    if not len(rows) or "coolant" not in known:
        return np.broadcast_to(np.int64(0), len(path))
    off = (*OFF, "M8") if run.control.name == "jnc-t01" else OFF  # whose table has M7 for on and M8 for off
    said = [known.value("coolant", step) for step in path.step[rows].tolist()]
    states = np.array([0, *(0 if each in off else 2 if each == "M7" and len(off) == len(OFF) else 1 for each in said)])
    return states[np.searchsorted(rows, np.arange(len(path)), "right")]


def _left(run: Any) -> dict[str, str]:
    """What a program leaves active that the next one may not expect: dimension, plane and datum, and what frames do."""
    known, end = run.history, 1 << 30
    found = {name: str(value) for name in MODAL if (value := known.value(name, end)) is not None}
    frame = np.eye(4)
    for name in known:
        if name.startswith("frame ") and name not in OF_MACHINE and (matrix := known.value(name, end)) is not None:
            frame = frame @ np.array(matrix)
    turned = ", turned or scaled" if np.abs(frame[:3, :3] - np.eye(3)).max() > ALIKE else ""
    moved = np.abs(frame - np.eye(4)).max() > ALIKE
    return found | {"frame": f"shifted by {point(frame[:3, 3])}{turned}" if moved else "none"}


def _tools(run: Any, tools: list[Any]) -> Index:
    """The tool of each row (n,), as its place in `tools`: what cuts alike is the same, whatever its number and name."""
    by_number, numbers = run.tools_that_cut
    used, which = np.unique(numbers, return_inverse=True)
    places = []
    for number in used.tolist():
        tool = by_number.get(number)
        shape = (number,) if tool is None else tuple(
            getattr(tool, name) for name in ("kind", "radius", "effective_radius", "corner", "angle", "teeth", "hand")
        )  # fmt: skip
        if shape not in tools:
            tools.append(shape)
        places.append(tools.index(shape))
    return np.array(places, dtype=np.int64)[which] if len(used) else np.zeros(len(numbers), dtype=np.int64)


def _held(run: Any) -> Mask:
    """The first cut (n,) with each tool, where the spindle turned before it came and was not started behind the change."""
    path = run.toolpath
    found = np.zeros(len(path), dtype=bool)
    turned = np.append(0.0, path.spindle[:-1])
    changes = np.flatnonzero((path.kind == Kind.TOOL) & (turned != 0) & (path.spindle != 0))
    if not len(changes):
        return found
    starts = np.zeros(len(run.steps.block), dtype=bool)  # by steps
    for k, program in enumerate(run.programs):
        if "M" in program.addresses:
            words = (program.address == program.addresses.index("M")) & np.isin(program.value, STARTS)
            blocks = np.repeat(np.arange(len(program)), np.diff(program.first))[words]
            starts |= (run.steps.program == k) & np.isin(run.steps.block, blocks)
    cutting = np.flatnonzero(path.is_motion & (path.kind != Kind.RAPID))
    for row, until in zip(changes.tolist(), np.append(changes[1:], len(path)).tolist()):
        first = int(np.searchsorted(cutting, row))
        if first < len(cutting) and (cut := int(cutting[first])) < until:
            again = starts[path.step[row] : path.step[cut] + 1].any() or (path.kind[row:cut] == Kind.SPINDLE).any()
            found[cut] = not again
    return found


def _true_tips(path: Toolpath) -> Array:
    """How much higher (n,) the tip of each row is written than where it is while the tool cuts, with a minus, mm.

    Of a control with G43 the path has the tip before the length is called where the spindle is: the tool hangs below it all the
    same. So what a tool does before its first cut and after its last one has the length of these cuts.
    """
    higher = np.zeros(len(path))
    jump = np.flatnonzero((path.kind == Kind.TOOL) & (path.end[:, 2] != path.start[:, 2]))
    if not len(jump):
        return higher
    jumped = np.zeros(len(path))
    jumped[jump] = path.end[jump, 2] - path.start[jump, 2]
    length = np.cumsum(jumped)
    bounds = np.flatnonzero(np.append(True, path.tool[1:] != path.tool[:-1]))
    cutting = (path.kind == Kind.LINE) | (path.kind == Kind.ARC) | (path.kind == Kind.PROBE)
    for begin, end in zip(bounds, [*bounds[1:], len(path)]):
        cuts = begin + np.flatnonzero(cutting[begin:end])
        if len(cuts):
            higher[begin : cuts[0]] = length[cuts[0]] - length[begin : cuts[0]]
            higher[cuts[-1] + 1 : end] = length[cuts[-1]] - length[cuts[-1] + 1 : end]
    return higher

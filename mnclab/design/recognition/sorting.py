"""What the moves of a mill do: clear levels, drill, go up or down aslant, go along an edge with a cone, cut threads."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from mnclab.design.recognition.areas import Track
from mnclab.geometry.contours import FULL_TURN
from mnclab.path.toolpath import Mask
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.moves import STILL, Moves, moves_of

LEVEL = 1e-7  # mm, between heights that are one
TOUCH = 1e-7  # mm, by which a move may reach into the blank and cuts nothing
THREADS = ("tap", "thread mill")


@dataclass(frozen=True)
class Plunge:
    """A tool straight down at (x, y): its tip, its radius, how much its point rises for each mm outwards; mm."""

    x: float
    y: float
    tip: float
    radius: float
    slope: float
    row: int

    @property
    def shoulder(self) -> float:
        return self.tip + self.radius * self.slope

    @property
    def angle(self) -> float:
        """The included angle of the point, degrees."""
        return 2 * math.degrees(math.atan2(1.0, self.slope))

    def on(self, x: float, y: float) -> bool:
        return math.hypot(self.x - x, self.y - y) < 1e-6


@dataclass(frozen=True)
class Cone:
    """A pointed tool along a way at one height: the height of its tip, how it widens, mm."""

    tip: float
    radius: float
    slope: float
    tracks: tuple[Track, ...]


@dataclass(frozen=True)
class Threaded:
    """A thread about (x, y) down to `tip`, mm: its nominal diameter and pitch (0: not known); `around`: milled by a tool
    that goes round at `bend` mm from the axis."""

    x: float
    y: float
    tip: float
    diameter: float
    pitch: float
    row: int
    bend: float = 0.0
    radius: float = 0.0


@dataclass
class MillWork:
    """All that a mill does: `levels` by height; `slopes` with the height of their lowest place; rows of `round` cutters."""

    levels: dict[float, list[Track]] = field(default_factory=dict)
    plunges: list[Plunge] = field(default_factory=list)
    slopes: list[tuple[float, Track]] = field(default_factory=list)
    helices: list[tuple[float, float, float]] = field(default_factory=list)  # their axis and how far out they reach
    cones: list[Cone] = field(default_factory=list)
    threads: list[Threaded] = field(default_factory=list)
    balls: list[int] = field(default_factory=list)
    cornered: dict[float, list[int]] = field(default_factory=dict)  # by the corner radius of the tool


def sort(cutting: Cutting) -> MillWork:
    """The moves that reach into the blank, by what they do. What goes through the lower side ends at it."""
    moves, (low, high) = moves_of(cutting), np.asarray(cutting.stock.bounds)
    boxes = moves.boxes
    reaches = (boxes[:, :2] < high[:2] - TOUCH).all(axis=1) & (boxes[:, 2:] > low[:2] + TOUCH).all(axis=1)
    moves = moves[reaches & (moves.low < high[2] - TOUCH) & (moves.radius > 0)]
    work, bottom, top = MillWork(), float(low[2]), float(high[2])
    threads = _threads(cutting, moves)
    work.threads = list(_threaded(cutting, moves, threads))
    moves = moves[~threads]
    travel = np.hypot(*(moves.end - moves.start)[:, :2].T)
    stands = (travel <= STILL) & ~(moves.arc & (np.abs(moves.sweep) > 0))
    level = np.abs(moves.end[:, 2] - moves.start[:, 2]) <= LEVEL
    ball = (moves.flat <= 0) & (moves.corner > 0)
    cone = moves.slope > 0
    work.balls = moves.row[ball].tolist()
    for k in np.flatnonzero((moves.corner > 0) & ~ball).tolist():
        work.cornered.setdefault(float(moves.corner[k]), []).append(int(moves.row[k]))
    levels: dict[float, list[Track]] = defaultdict(list)
    for k in np.flatnonzero(stands & ~ball).tolist():
        (x, y, _), tip = moves.end[k].tolist(), float(moves.low[k])
        found = Plunge(x, y, tip, float(moves.radius[k]), float(moves.slope[k]), int(moves.row[k]))
        if cone[k]:
            work.plunges.append(found)
        if found.shoulder < top - TOUCH:
            levels[max(found.shoulder, bottom)].append(Track((x, y), (x, y), found.radius, found.row))
    for k in np.flatnonzero(~stands & level & ~ball & ~cone).tolist():
        levels[max(float(moves.low[k]), bottom)].append(_track(moves, k))
    slanting = np.flatnonzero(~stands & ~level & ~ball & ~cone).tolist()
    for k in slanting:
        work.slopes.append((max(float(moves.low[k]), bottom), _track(moves, k, top)))
    for z, track in _full_turns(moves, slanting):
        work.helices.append((*track.centre, track.bend + track.radius))
        if z < top - TOUCH:
            levels[max(z, bottom)].append(track)
    ways: dict[tuple[float, float, float], list[Track]] = defaultdict(list)
    for k in np.flatnonzero(~stands & cone & ~ball).tolist():
        ways[float(moves.low[k]), float(moves.radius[k]), float(moves.slope[k])].append(_track(moves, k))
    work.cones = [Cone(*key, tuple(tracks)) for key, tracks in ways.items()]
    work.levels = _together(levels)
    return work


def _track(moves: Moves, k: int, top: float = np.inf) -> Track:
    """A move in the plane, as far as it is below `top`."""
    start, end, sweep = moves.start[k], moves.end[k], float(moves.sweep[k]) if moves.arc[k] else 0.0
    if max(start[2], end[2]) > top:
        share = (top - start[2]) / (end[2] - start[2])
        if sweep:
            angle, arm = share * sweep, start[:2] - moves.centre[k]
            turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
            place = [*(moves.centre[k] + turn @ arm), top]
            sweep *= share if start[2] < top else 1 - share
        else:
            place = start + share * (end - start)
        start, end = (start, np.asarray(place)) if start[2] < top else (np.asarray(place), end)
    (x0, y0), (x1, y1), (u, v) = start[:2].tolist(), end[:2].tolist(), moves.centre[k].tolist()
    return Track((x0, y0), (x1, y1), float(moves.radius[k]), int(moves.row[k]), (u, v) if sweep else (0.0, 0.0), sweep)


def _full_turns(moves: Moves, slanting: list[int]) -> Iterator[tuple[float, Track]]:
    """The full circle that a helix has cleared one turn above its lower end, with its height."""
    groups: dict[tuple[float, ...], list[int]] = defaultdict(list)
    for k in slanting:
        if moves.arc[k]:
            track = _track(moves, k)
            groups[*np.round(track.centre, 6).tolist(), round(track.bend, 6), track.radius].append(k)
    for rows in groups.values():
        if np.abs(moves.sweep[rows]).sum() < FULL_TURN - 1e-9:
            continue
        last = min(rows, key=lambda k: float(moves.low[k]))
        pitch = abs(float(moves.end[last, 2] - moves.start[last, 2]) / moves.sweep[last]) * FULL_TURN
        track = _track(moves, last)
        circle = Track(track.end, track.end, track.radius, track.row, track.centre, FULL_TURN)
        yield float(moves.low[last]) + pitch, circle


def _together(levels: dict[float, list[Track]]) -> dict[float, list[Track]]:
    """Heights that differ by rounding as one, from below."""
    found: dict[float, list[Track]] = {}
    last = -np.inf
    for z in sorted(levels):
        if z - last > 10 * LEVEL:
            last = z
            found[z] = []
        found[last] += levels[z]
    return found


def _threads(cutting: Cutting, moves: Moves) -> Mask:
    """Which moves cut threads: locked to the spindle, of a tap, or round and up or down of a thread mill, and its ways there."""
    kinds = np.array([tool.kind for tool in cutting.tools] or [""])[cutting.which[moves.row]]
    turns_level = moves.arc & (np.abs(moves.sweep) >= FULL_TURN - 1e-9) & (moves.start[:, 2] == moves.end[:, 2])
    locked = np.asarray(cutting.path.synchronous)[moves.row]
    return np.asarray(locked | (kinds == "tap") | ((kinds == "thread mill") & ~turns_level))


def _threaded(cutting: Cutting, moves: Moves, threads: Mask) -> Iterator[Threaded]:
    """Threads, one for each axis and tool, as deep as the deepest stroke."""
    path, found = cutting.path, dict[tuple[float, ...], Threaded]()
    for k in np.flatnonzero(threads).tolist():
        row, tip, r = int(moves.row[k]), float(moves.low[k]), float(moves.radius[k])
        tool, rise = cutting.tool(row), float(abs(moves.end[k, 2] - moves.start[k, 2]))
        if rise <= LEVEL:
            continue
        if moves.arc[k]:
            bend = float(np.hypot(*(moves.start[k, :2] - moves.centre[k])))
            if abs(moves.sweep[k]) < FULL_TURN - 1e-9:
                continue  # its approach
            (x, y), pitch = moves.centre[k].tolist(), rise / abs(float(moves.sweep[k])) * FULL_TURN
            each = Threaded(x, y, tip, 2 * (bend + r), pitch, row, bend, r)
        elif tool.kind != "thread mill":
            x, y = moves.end[k, :2].tolist()
            pitch = tool.pitch or float(np.nan_to_num(path.per_rev[row]))
            if not pitch and path.spindle[row]:
                pitch = abs(float(path.feed[row] / path.spindle[row])) if np.isfinite(path.feed[row]) else 0.0
            each = Threaded(x, y, tip, 2 * r, pitch, row)
        else:
            continue
        key = round(x, 6), round(y, 6), round(each.diameter, 6)
        known = found.get(key)
        found[key] = each if known is None or (each.tip < known.tip and each.pitch) else known
    yield from found.values()

"""How rotary axes move, and what becomes of the tip: as positions of their own, or by the kinematics of the machine.

Positions of the program are places on the part (`tip`), told as they are with all rotary axes at zero. Coordinates are
*reckoned* with rotary axes at some angles: zero at first, in a tilted plane where the axes must stand for it. Where they
stand elsewhere the linear axes go to the same X Y Z all the same, and the tip is somewhere else on the part: that is a frame
before all others (`turned`). A tip that is *led* is reckoned with the axes as they stand.

What the control has as its kinematics (`m.tables.kinematics`) a cycle may correct; where the axes truly are stays as the setup
has it, and a probe that touches the part tells the difference.

Without the kinematics of a machine the tip stays where it is on the part. A move of rotary axes alone is a row without length
that takes the time of the axis with the longest way; beside a move of the linear axes they arrive with the tip.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.geometry.frames import Matrix
from mnclab.geometry.kinematics import NAMES, Kinematics, shorter
from mnclab.machine.coordinates import STILL, Angles, angles, set_angles
from mnclab.machine.state import Place
from mnclab.path.cylinder import Cylinder
from mnclab.path.limits import NOISE, Beyond
from mnclab.path.toolpath import Array, Kind, Toolpath
from mnclab.text.program import Word

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

TOLERANCE = 0.01  # mm, how far the tip may be from the rows of a move with rotary axes, if nothing else is said
MOST = 100_000  # rows of one move
FIRST, FINE = 8, math.radians(2)  # rows that a move is tried with at first; a turn so small is tried as one
SAME = 1e-12  # rad
SQUARE = 2e-4  # rad, by which a tool may lean that stands square to its plane: angles are typed with three decimals
CHAIN = "kinematics"  # in the history


def turning_feed(m: Machine) -> float:
    """The modal feed for axes that turn alone: the number of the program as degrees a minute, a reading in inches too."""
    return m.feed_of(None) / (m.variable_unit if m.per_rev else m.feed_unit)


def reference(m: Machine) -> Place:
    """X Y Z of the spindle reference, machine coordinates, mm."""
    kinematics, length = m.tables.kinematics, m.tool.effective_length
    if kinematics is None:
        x, y, z = m.tip
        return x, y, z + length
    x, y, z = kinematics.references(np.array(m.tip), np.array(m.rotary), length).tolist()
    return x, y, z


def in_machine(m: Machine) -> Array:
    """The map (4, 4) from coordinates of the program to those of the linear axes, while rotary axes stand."""
    kinematics = m.tables.kinematics
    if kinematics is None:
        return m.matrix
    return frames.inverse(kinematics.carried(np.array(m.rotary), m.tool.effective_length)) @ m.matrix


def tip_below(m: Machine, place: Place) -> Place:
    """Where the tip is on the part while the spindle reference stands at X Y Z, machine coordinates."""
    kinematics, length = m.tables.kinematics, m.tool.effective_length
    if kinematics is None:
        return place[0], place[1], place[2] - length
    x, y, z = kinematics.tips(np.array(place), np.array(m.rotary), length).tolist()
    return x, y, z


def begin(m: Machine) -> None:
    """A machine with kinematics stands with its spindle reference at the start of the setup, its rotary axes at home."""
    x, y, z = map(float, m.setup.start)
    m.tip = tip_below(m, (x, y, z))
    m.recorder.start = np.array(m.tip)
    stand(m)


def chain(m: Machine) -> Kinematics:
    """The kinematics of a machine that has one."""
    assert m.tables.kinematics is not None
    return m.tables.kinematics


def orientation(m: Machine) -> Array:
    """The axes (3, 3), as columns, of the tool on the part; those of the machine without a kinematics."""
    kinematics = m.tables.kinematics
    return np.eye(3) if kinematics is None else kinematics.orientation(np.array(m.rotary))


def direction(m: Machine) -> Array:
    """The direction (3,) of the tool on the part, from the tip to the spindle; along Z without a kinematics."""
    return orientation(m)[:, 2]


def leaning(m: Machine) -> float:
    """By how much the tool leans from Z of the active coordinates, degrees, 0 where that is too little to count: as the axes
    lead it, and in a tilted plane as that lies on the part. A machine without a kinematics does not say it.

    A measured axis, off by an angle from where it was built, makes the tool lean by twice that: no program leans it so."""
    if m.tables.kinematics is None:
        return 0.0
    built = {axis.name: axis.direction for axis in m.setup.kinematics.sequence} if m.setup.kinematics is not None else {}
    pairs = [(axis.direction, built.get(axis.name, axis.direction)) for axis in m.tables.kinematics.sequence]
    least = SQUARE + 2 * sum(float(np.linalg.norm(np.asarray(now) - np.asarray(then))) for now, then in pairs)
    tool, found = direction(m), 0.0
    for frame in (m.matrix, m.frames.matrix) if m.reckoned is not None and any(m.reckoned) else (m.matrix,):
        up = frame[:3, 2]
        found = max(found, math.atan2(float(np.linalg.norm(np.cross(up, tool))), float(up @ tool)))
    return math.degrees(found) if found > least else 0.0


def lean_to_tell(m: Machine) -> float:
    """By how much the tool leans in a tilted plane that counts, degrees, until `tell_lean` has said it of this plane; else 0."""
    counts = m.reckoned is not None and "tilt" in m.frames
    return leaning(m) if counts and (m.frames["tilt"].tobytes().hex(), None) not in m.noted else 0.0


def tell_lean(m: Machine) -> None:
    """A warning at the first cut in a tilted plane to which the tool is not square: rotary axes were to turn first."""
    if degrees := lean_to_tell(m):
        m.noted.add((m.frames["tilt"].tobytes().hex(), None))
        hint = "turn the rotary axes as the plane wants them before: to Q120 to Q122, with TURN or MOVE; by G53.1"
        m.warn(f"the tool is not square to the tilted plane, it leans by {degrees:.4g} degrees", None, hint)


def reckon(m: Machine, with_axes: Place | None) -> None:
    """Coordinates count from now on with A, B, C at angles, rad; None: as they stand, the tip is led. No axis moves."""
    m.put(reckoned=with_axes)
    stand(m)


def reckon_here(m: Machine, with_axes: Place) -> None:
    """The same for this block alone; what acts behind it counts as before."""
    before = m.reckoned
    reckon(m, with_axes)
    m.at_block_end(lambda: reckon(m, before))


def stand(m: Machine) -> None:
    """The register reads the place anew: rotary axes, tool or reckoning are others, while no axis moves."""
    m.put(turned=_turned(m))
    m.compose()
    m.read_position()


def _turned(m: Machine) -> Array | None:
    kinematics, reckoned = m.tables.kinematics, m.reckoned
    if kinematics is None or reckoned is None:
        return None
    apart = np.subtract(m.rotary, reckoned)
    if np.abs(apart - math.tau * np.round(apart / math.tau)).max() < SAME:
        return None
    now, then = kinematics.carried(np.array([m.rotary, reckoned]), m.tool.effective_length)
    return np.asarray(now @ frames.inverse(then))


class Truth(NamedTuple):
    """Where the tool truly is on the part: what leads there (4, 4) from where the control has it, and its axes there (3, 3)."""

    moved: Matrix
    orientation: Matrix


def truth(m: Machine) -> Truth | None:
    """What is true of where the tool is; None where the control has it so.

    An axis with backlash stays behind by half of it, on the side from which it came last.
    """
    believed, true = m.tables.kinematics, m.setup.true_kinematics or m.setup.kinematics
    if believed is None or true is None or (believed is true and not any(axis.backlash for axis in true.sequence)):
        return None
    stands = np.array(m.rotary)
    for axis in true.sequence:
        stands[axis.number] -= math.radians(axis.backlash) / 2 * m.arrived[axis.number]
    length = m.tool.effective_length
    there = true.carried(stands, length) @ frames.inverse(believed.carried(m.rotary, length))
    return Truth(there, true.orientation(stands))


def correct(m: Machine, kinematics: Kinematics) -> None:
    """The control has other kinematics from now on: no axis moves, but the tip is known to be elsewhere on the part.

    The row that leads there is the last one of the block.
    """
    x, y, z = kinematics.tips(np.array(reference(m)), np.array(m.rotary), m.tool.effective_length).tolist()
    m.tables.kinematics = kinematics
    m.log(CHAIN, kinematics)
    if math.dist((x, y, z), m.tip) > STILL:
        m.add_row(Kind.STOP, (x, y, z))
        m.tip = x, y, z
    stand(m)


def change_length(m: Machine, length: float) -> None:
    """The tip is where another tool brings it, while all axes stand; `length` is that of the tool before, mm."""
    kinematics = chain(m)
    now = np.array(m.rotary)
    place = kinematics.references(np.array(m.tip), now, length)
    x, y, z = kinematics.tips(place, now, m.tool.effective_length).tolist()
    m.tip = x, y, z


def turn_axes(
    m: Machine, to: Angles, f: float | None, word: Word | None = None, below: float | None = None,
    most: float = math.inf, in_plane: bool = False,
) -> None:  # fmt: skip
    """Turn to angles (degrees) while the linear axes stand, or the tip that is led. `below`, `most` and `in_plane` are those of
    `swing`.

    `f` is in degrees a minute, infinite at rapid, None the modal feed. The time of a rapid turn is not known: no limits of rotary
    axes are.
    """
    rate = turning_feed(m) if f is None else f
    way = max(abs(new - old) for new, old in zip(to, angles(m), strict=True))
    if m.tables.kinematics is not None:
        swing(m, to, None, math.inf if math.isinf(rate) else way / rate, word, below, most=most, in_plane=in_plane)
        return
    set_angles(m, to)
    kind = Kind.LINE if math.isfinite(rate) else Kind.RAPID
    m.add_row(kind, m.tip, feed=math.radians(rate), time=60 * way / rate if kind == Kind.LINE else math.nan)


def travel(
    m: Machine, to: Angles, point: Place | None, f: float | None, word: Word | None = None,
    most: float = math.inf, of_all: bool = False, in_plane: bool = False,
) -> None:  # fmt: skip
    """Go to a point of the program (None: the linear axes stand, or the tip that is led) while the rotary axes turn to angles
    (degrees), by the kinematics of the machine, at `f` mm/min, infinite at rapid, None the modal feed.

    The feed is that of the tip where it is led, else that of the linear axes, as X Y Z go; where neither moves, that of the
    rotary axis with the longest way. `of_all`: it counts along the ways of all axes together, mm and degrees. `most` and
    `in_plane` are those of `swing`.
    """
    rate = m.feed_of(f, word)
    if math.isinf(rate):
        return swing(m, to, point, math.inf, word, most=most, in_plane=in_plane)
    led = m.reckoned is None
    start, end = led_ends(m, point, 0.0) if led else linear_ends(m, chain(m), point)
    way = float(np.linalg.norm(end - start))
    if rate < 0:  # a time for the move
        swing(m, to, point, -rate / 60, word, most=most, in_plane=in_plane)
    elif way <= STILL:
        turn_axes(m, to, f, word, most=most, in_plane=in_plane)
        if point is not None:
            m.set_register(point)
    elif of_all:
        turned = math.dist(to, angles(m))
        swing(m, to, point, math.hypot(way, turned) / rate, word, most=most, in_plane=in_plane)
    elif led:
        swing(m, to, point, None, word, f=rate, most=most, in_plane=in_plane)
    else:
        swing(m, to, point, way / rate, word)


def swing(
    m: Machine, to: Angles, point: Place | None, minutes: float | None, word: Word | None = None, below: float | None = None,
    f: float = math.inf, most: float = math.inf, in_plane: bool = False,
) -> None:  # fmt: skip
    """Turn to angles (degrees) and go to a point of the program (None: stay) together: all axes run evenly, and rows are cut so
    fine that none leaves the way of the tip by more than the tolerance.

    `minutes` the move takes, infinite at rapid; None: as long as the tip needs at `f` mm/min. `below` the tip, mm, is a point
    that stays where it is on the part. The linear axes that lead a tip go no faster than `most` mm/min. `in_plane`: the tool
    turns in the plane of its directions at both ends, while all axes follow; an axis that is free at the start turns before.
    """
    kinematics, own = chain(m), m.tool.effective_length
    check_angles(m, to, word)
    before, after = np.array(m.rotary), np.radians(to)
    free = kinematics.free(direction(m), before) if in_plane else None
    if free is not None and abs(after[free.number] - before[free.number]) > SAME:  # it turns alone first, the tip stands
        a, b, c = (to[k] if k == free.number else math.degrees(old) for k, old in enumerate(before.tolist()))
        turn_axes(m, (a, b, c), math.inf if math.isinf(f if minutes is None else minutes) else None, word, most=most)
        before = np.array(m.rotary)
    led = m.reckoned is None or below is not None
    length = own + (below or 0.0)
    start, end = led_ends(m, point, below or 0.0) if led else linear_ends(m, kinematics, point)
    count = max(1, min(FIRST, math.ceil(float(np.abs(after - before).max()) / FINE)))

    def places(share: Array) -> tuple[Array, Array]:
        """X Y Z (n, 3) of the spindle reference, and the angles."""
        turning = between(kinematics, before, after, share) if in_plane else before + share[:, None] * (after - before)
        even = start + share[:, None] * (end - start)
        return (kinematics.references(even, turning, length) if led else even), turning

    tolerance, worst = allowed(m), math.inf
    while True:
        linear, turning = places(np.linspace(0, 1, count + 1))
        if led:  # between rows all axes run evenly, and the tip leaves its line
            middle, half = (linear[1:] + linear[:-1]) / 2, (turning[1:] + turning[:-1]) / 2
        else:
            middle, half = places((np.arange(count) + 0.5) / count)
        tips = kinematics.tips(linear, turning, own)
        off = kinematics.tips(middle, half, own) - (tips[1:] + tips[:-1]) / 2
        wider, worst = worst, float(np.linalg.norm(off, axis=1).max())
        if worst <= tolerance or count > MOST:
            break
        if in_plane and worst > max(wider / 2, 2 * tolerance):  # smaller rows come no nearer
            what = "the rotary axes would have to jump on the way: it leads through a place where one of them is free"
            m.alarm(what, word, "PATHCTRL AXIS leads them evenly; or turn the free axis before")
        count = int(math.ceil(count * max(math.sqrt(worst / tolerance), 1.01)))
    if count > MOST:
        m.alarm(f"the move turns so far that it needs {count} rows to stay within {tolerance:g} mm, {MOST} are allowed", word)
    label = m.label or (f"tip led within {tolerance:g} mm" if led else "")
    ways = np.linalg.norm(np.diff(tips, axis=0), axis=1)
    takes = minutes if minutes is not None else math.inf if math.isinf(f) else float(ways.sum()) / f
    if led and math.isfinite(most) and (math.isfinite(takes) or point is None):
        slowest = float(np.linalg.norm(np.diff(linear, axis=0), axis=1).sum()) / most
        if slowest > (takes if math.isfinite(takes) else 0.0):
            takes = minutes = slowest
    with m.within(label=label):
        for k in range(count):
            a, b, c = turning[k + 1].tolist()
            m.put(rotary=(a, b, c))
            way = float(ways[k])
            tip = m.tip if way <= STILL else tuple(tips[k + 1].tolist())  # what stands, stands exactly
            if math.isinf(takes):
                m.add_row(Kind.RAPID, tip, feed=math.inf)
            else:
                seconds, turned = 60 * takes / count, float(np.abs(turning[k + 1] - turning[k]).max())
                rate = f if minutes is None else 60 * (way if way > STILL else turned) / seconds
                m.add_row(Kind.LINE, tip, feed=rate, time=seconds)
            m.tip = tip
    m.log("rotary", m.rotary)
    came = np.sign(np.where(np.abs(after - before) > SAME, after - before, m.arrived))
    m.put(arrived=tuple(came.tolist()))
    stand(m)
    if point is not None:
        m.set_register(point)


def roll_over(m: Machine, cylinder: Cylinder, points: Array, angles: Array, ways: Array, f: float | None) -> None:
    """Go over a cylinder that one rotary axis turns, as `coordinates.roll` does, by the kinematics of the machine: through tips
    (n, 3) of the program, for which the linear axes go where they would with the rotary axes as coordinates are reckoned."""
    rate, size = m.feed_of(f), math.hypot(*m.frames.matrix[:3, 0].tolist())
    for point, angle, way in zip(points.tolist(), np.degrees(angles).tolist(), ways.tolist(), strict=True):
        a, b, c = (angle if k == cylinder.rotary else math.degrees(old) for k, old in enumerate(m.rotary))
        if math.dist((a, b, c), map(math.degrees, m.rotary)) > STILL or math.dist(point, m.programmed) > STILL:
            swing(m, (a, b, c), point, math.inf if math.isinf(rate) else way * size / rate)


def between(kinematics: Kinematics, before: Array, after: Array, share: Array) -> Array:
    """A, B, C (n, 3), rad, where the tool turns evenly in the plane of its directions at both ends, at shares (n,) of it."""
    one, other = kinematics.orientation(np.stack([before, after]))[:, :, 2]
    even = before + share[:, None] * (after - before)
    angle = math.atan2(float(np.linalg.norm(np.cross(one, other))), float(one @ other))
    if not SAME < angle < math.pi - SAME:  # in no plane, or in any
        return np.asarray(even)
    turned = share[:, None] * angle
    found = shorter(kinematics.solutions((np.sin(angle - turned) * one + np.sin(turned) * other) / math.sin(angle), even), even)
    return np.where((share == 1)[:, None], after, np.where((share == 0)[:, None] | np.isnan(found), even, found))


def led_ends(m: Machine, point: Place | None, below: float) -> tuple[Array, Array]:
    """Where the point of the tool that is led is on the part before and after a move."""
    down = -below * direction(m)
    start = np.array(m.tip) + down
    return start, start if point is None else np.array(m.to_machine(point)) + down


def linear_ends(m: Machine, kinematics: Kinematics, point: Place | None) -> tuple[Array, Array]:
    """X Y Z (3,) of the spindle reference before and after a move."""
    start = np.array(reference(m))
    if point is None:
        return start, start
    inner = frames.apply(m.frames.matrix, point)
    return start, kinematics.references(inner, np.array(m.reckoned), m.tool.effective_length)


def allowed(m: Machine) -> float:
    """How far the tip may be from the rows, mm: what the program lets corners be cut, else the setting."""
    own = m.tolerance
    return float(own if own > 0 else m.settings.get("tcpm_tolerance", TOLERANCE))


def check_angles(m: Machine, to: Angles, word: Word | Mapping[str, Word] | None = None) -> None:
    """An Alarm where the machine lacks an axis that would turn, or one would leave its limits, and within a contour: at its word
    where all of the block are given."""
    kinematics, words = chain(m), word if isinstance(word, Mapping) else dict.fromkeys(NAMES, word)
    if m.recorded_only or m.side:
        what = "within a contour" if m.recorded_only else "under radius compensation"
        m.alarm(f"rotary axes cannot turn {what}", next((words[name] for name in NAMES if name in words), None))
    for name, new, old in zip(NAMES, to, angles(m), strict=True):
        if name not in kinematics.names and abs(new - old) > math.degrees(STILL):
            m.alarm(f"the machine has no rotary axis {name}: {kinematics}", words.get(name))
    a, b, c = np.radians(to).tolist()
    if (axis := kinematics.beyond((a, b, c))) is not None:
        low, high = axis.limits
        what = f"{axis.name} (rotary axis) must be from {low:g} to {high:g} degrees, and would be {to[axis.number]:g}"
        m.alarm(what, words.get(axis.name))


# The axes behind the rows of a path: X Y Z of the spindle reference and A B C, by which the tip is where a row says.

def lengths_of_rows(step: NDArray[np.integer[Any]], changes: Sequence[tuple[int, Any]], first: float) -> Array:
    """The length of the tool (n,), mm, at rows of some steps; `changes` are those of the tool, `first` is the length before."""
    at, tools = zip(*changes) if changes else ((), ())
    lengths = np.array([first, *(tool.effective_length for tool in tools)])
    return np.asarray(lengths[np.searchsorted(np.array(at, dtype=np.int64), step, "right")])


def references(
    path: Toolpath, points: Array, row: NDArray[np.integer[Any]], lengths: Array, corrected: Sequence[tuple[int, Any]] = ()
) -> Array:
    """X Y Z (m, 3), machine coordinates, for tips (m, 3) of a path on its rows (m,), whose tools are so long (n,).

    `corrected` are the changes of the kinematics: each counts from the last row of its step on.
    """
    tips = points + path.origin
    if path.kinematics is None:
        return np.asarray(tips + np.multiply.outer(lengths[row], [0.0, 0.0, 1.0]))
    found = path.kinematics.references(tips, path.rotary[row], lengths[row])
    for step, kinematics in corrected:
        last = int(np.searchsorted(path.step, step, "right")) - 1
        since = row >= (last if last >= 0 and path.step[last] == step else last + 1)
        found[since] = kinematics.references(tips[since], path.rotary[row[since]], lengths[row[since]])
    return found


def first_beyond(path: Toolpath, lengths: Array, travel: Array, corrected: Sequence[tuple[int, Any]] = ()) -> Beyond | None:
    """The first row on which the axes of a machine with kinematics leave their travel (3, 2), mm; None if none does."""
    points, row = path.points()
    place = references(path, points, row, lengths, corrected)
    over = np.maximum(travel[:, 0] - place, place - travel[:, 1])
    out = np.flatnonzero((over > NOISE).any(axis=1))
    if not len(out):
        return None
    worst = out[row[out] == row[out[0]]]
    k, axis = np.unravel_index(int(np.argmax(over[worst])), over[worst].shape)
    return Beyond(int(row[out[0]]), int(axis), float(place[worst[k], axis]))

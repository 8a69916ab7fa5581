"""What the page needs of a run: both paths, what was active at each step, the feed-rate profile, the texts.

Lengths are whole numbers of 1 / `scale` mm: the coarsest of 1e-3, 1e-4 and 1e-6 mm that loses nothing, so that the
page says the digits that the run says. Times are whole microseconds, speeds whole micrometres per second; where numbers
are too large for that, the parts are coarser by powers of ten. Arcs stay arcs. An axis whose ends are mostly those that the text
says is sent as what differs from them. What lies on a cylinder is told as it lies on
the workpiece. A *log* is a list of places where a value
changes and the values from there on.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.path.cylinder import parted_rapids
from mnclab.path.profile import Profile
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.show.player.machine import machine
from mnclab.show.player.part import (
    ROOM,
    Packer,
    changes,
    columns,
    felt_part,
    felt_touches,
    inserts,
    log,
    part,
    parted,
    parts_of,
    plain,
    section,
    size,
)
from mnclab.show.probed import Felt
from mnclab.show.solids import cylinder_body
from mnclab.text.alarm import Alarm, amounts, several
from mnclab.text.program import Program
from mnclab.text.words import characters, scan
from mnclab.workpiece.collision import Collision
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.part import Part

NUMBERS = [re.compile(axis + "([-+]?[0-9]*[.]?[0-9]+)") for axis in "XYZ"]  # as data.js looks for them; `_said` too
SCALES = (1e3, 1e4, 1e6)  # parts of a millimetre
ANGLES = 1e9  # parts of a radian
DEGREES = 1e6  # parts of a degree, of rotary axes
#: The columns that the page has as logs.
SHOWN = ("feed", "per_rev", "surface", "speed_limit", "spindle_x", "spindle", "side", "tool", "radius")
SECONDS, SPEEDS = 1e6, 1e3  # parts of a second, of a millimetre in a second
TURN = 0.05  # rad between two places of a rapid that turns
OFF = 0.02  # mm that a rapid leaves its straight line before its true course is sent

Array = NDArray[np.float64]


def payload(
    run: Any, profile: Profile, cutting: Cutting | None = None, collisions: Sequence[Collision] = (), probed: Felt | None = None
) -> str:
    """A run with its profile as the text that `data.js` reads; with a cutting also what becomes of its blank, without one the
    part that was `probed`."""
    pack = Packer()
    shown = probed if probed is not None and probed.part is not None and not run.toolpath.lathe else None
    path = run.toolpath.on_workpiece()
    programmed = path if run.programmed is run.toolpath else run.programmed.on_workpiece()
    moved, places = run.history.log("position") if "position" in run.history else ([], [])
    positions = np.asarray(places, dtype=np.float64).reshape(-1, 3)
    scale = _scale([path, programmed], positions, profile.pieces.s)
    rotates = run.toolpath.rotary.any()
    angles, turned = parts_of(ANGLES, path.sweep, programmed.sweep), np.degrees(run.toolpath.rotary[: None if rotates else 0])
    degrees = parts_of(DEGREES, turned)
    lines, lasts = zip(*(_lines(pack, program) for program in run.programs))
    header = {
        "title": run.program.title,
        "control": run.control.title,
        "name": run.control.name,
        "lathe": path.lathe,
        "radii": path.lathe and run.settings.get("diameter") is False,  # what X is in the program
        "unit": {"short": path.unit.short, "length": path.unit.length, "decimals": 3 if path.unit.length == 1 else 4},
        "alarms": [
            alarm.as_dict()
            | {"text": str(alarm), "program": alarm.span.program if alarm.span else 0}
            | {"places": [[place.program, place.line] for place in alarm.places]}
            for alarm in map(Alarm.without_folders, run.alarms)
        ],
        "more": more_than_first(run.alarms),
        "programs": [{"name": program.title, "text": program.text} for program in run.programs],
        "lines": lines,
        "lasts": lasts,
        "steps": {"block": pack.add(run.steps.block), "program": pack.add(run.steps.program)},
        "scale": scale,
        "angles": angles,
        "origin": path.origin.tolist(),
        "path": _geometry(pack, path, scale, angles, _told(run, path, scale)),
        "programmed": None if programmed is path else _geometry(pack, programmed, scale, angles),
        "row": {"step": pack.add(path.step)}
        | {name: log(pack, getattr(path, name)) for name in SHOWN}
        | {"label": log(pack, np.array(path.labels, dtype=object)[path.label] if len(path) else [])},
        "position": {
            "at": pack.add(moved),
            "from": columns(pack, parted(positions, scale) - _tips(path, moved, scale)),
        },
        "rotary": columns(pack, parted(turned, degrees)) if rotates else None,
        "degrees": degrees,
        "stock": _edges([run.stock] if run.stock else []) + _cylinders(run.toolpath),
        "turning": sorted({(*one.direction, one.rotary) for one in run.toolpath.cylinders}) or None,  # the axes of drums
        "machine": machine(pack, run),
        "home": run.rows_from_home if run.toolpath.cylinders else 0,  # rows that nobody has said the beginning of
        "bent": _bent(pack, run.toolpath, scale) if run.toolpath.cylinders else None,
        "fixtures": _edges(cutting.fixtures) if cutting and not path.lathe else [],
        "held": [plain(each) for each in cutting.fixtures if isinstance(each, tuple)] if cutting and not path.lathe else [],
        "history": {name: changes(pack, *_parted(run, name)) for name in run.history if name != "position"},
        "profile": _profile(pack, profile, scale),
        "part": part(pack, cutting, path) if cutting and not path.lathe else felt_part(pack, shown, path) if shown else None,
        "section": section(pack, cutting) if cutting and path.lathe else None,
        "inserts": inserts(pack, run) if path.lathe else None,
        "felt": felt_touches(probed, path),
        "collisions": [
            {name: plain(getattr(each, name)) for name in ("line", "program", "row", "kind", "message", "place")}
            for each in collisions
        ],
    }
    return pack.text(header)


def _edges(bodies: Sequence[Any]) -> list[list[list[float]]]:
    """The lines that show bodies in space; one that only a probe knows has none."""
    return [np.round(edge, 4).tolist() for body in bodies if not isinstance(body, Part) for edge in body.edges()]


def _cylinders(path: Toolpath) -> list[list[list[float]]]:
    """The circles at the ends of the cylinders that a path lies on, and lines between them."""
    found = []
    for number in range(len(path.cylinders)):
        points = cylinder_body(path, number).points[:-2]
        low, high = np.split(points, 2)
        found += [np.vstack([circle, circle[:1]]) for circle in (low, high)]
        found += [np.stack([low[k], high[k]]) for k in range(0, len(low), len(low) // 8)]
    return [np.round(edge, 4).tolist() for edge in found]


def more_than_first(alarms: Sequence[Alarm]) -> str:
    """How many alarms and warnings there are beside the first alarm, or else the first warning: what the page has room for."""
    rest = amounts(alarms)
    first = next((severity for severity, count in rest.items() if count), "")
    rest[first] -= 1
    return " and ".join(several(n, f"more {name}" if name == first else name) for name, n in rest.items() if n > 0)


def _parted(run: Any, name: str) -> tuple[list[int], list[Any]]:
    """The steps at which a value of the history changes, and what it is from there on."""
    changes = run.history.changed(name)
    return [step for step, _ in changes], [value for _, value in changes]


def _scale(paths: list[Toolpath], positions: Array, ways: Array) -> float:
    """Parts of a millimetre that lengths are counted in."""
    ends = [each for path in paths for each in (path.start[:1], path.end, path.centre[path.kind == Kind.ARC])]
    lengths = [column for each in (*ends, positions) for column in each.T]
    most = parts_of(SCALES[-1], *lengths, ways)
    for scale in SCALES[:-1]:
        if scale > most:
            break
        if all(np.abs(np.round(column * scale) / scale - column).max(initial=0.0) < 1e-9 for column in lengths):
            return scale
    return most


def _told(run: Any, path: Toolpath, scale: float) -> NDArray[np.int64]:
    """Where the rows end (n + 1, 3) as far as their blocks say it, else where the row before ends."""
    block, program = run.steps.block[path.step], run.steps.program[path.step]
    said = np.full((len(path), 3), np.nan)
    for which, source in enumerate(run.programs):
        rows = np.flatnonzero(program == which)
        said[rows] = _said(source.text, source.lines()[0][block[rows]] - 1)
    found = np.concatenate([np.zeros((1, 3), dtype=np.int64), parted(_vertices(path), scale)[:-1]])
    for axis in range(3):
        value = said[:, axis] * path.unit.length * scale + 0.5
        known = np.flatnonzero(np.abs(value) < ROOM)
        found[known + 1, axis] = np.floor(value[known])
    return found


def _said(text: str, line: NDArray[np.integer[Any]]) -> Array:
    """The first number after each of X, Y and Z in lines (n, 3), counted from 0; nan where there is none."""
    words, data = scan(text, leading_number=True), characters(text)
    found = np.full((len(words.clean), 3), np.nan)
    for axis, letter in enumerate(b"XYZ"):
        some = np.flatnonzero(words.letter == letter)[::-1]  # of a line the first comes last
        at = words.offset[some]
        meant = (data[at] == letter) & ~np.isin(data[np.minimum(at + 1, len(data) - 1)], (9, 32))  # no x, and no blank after it
        found[np.searchsorted(words.starts, at[meant], "right") - 1, axis] = words.value[some[meant]]
    ends = np.append(words.starts[1:], len(text))
    for odd in np.unique(line[~words.clean[line]]).tolist():
        said = (number.search(text, words.starts[odd], ends[odd]) for number in NUMBERS)
        found[odd] = [float(number[1]) if number else np.nan for number in said]
    return found[line]


def _geometry(pack: Packer, path: Toolpath, scale: float, angles: float, told: NDArray[np.int64] | None = None) -> dict[str, Any]:
    """Kinds and vertices of a path (n + 1), and centre and sweep of its arcs."""
    arc = path.kind == Kind.ARC
    vertices = parted(_vertices(path), scale)
    shorter = [told is not None and size(vertices[:, k] - told[:, k]) < size(vertices[:, k]) for k in range(3)]
    return {
        "kind": pack.add(path.kind),
        "vertex": columns(pack, vertices if told is None else np.where(shorter, vertices - told, vertices)),
        "told": shorter,
        "centre": columns(pack, parted(path.centre[arc], scale)),
        "sweep": pack.add(parted(path.sweep[arc], angles)),
        "axis": log(pack, path.axis[arc]),
    }


def _bent(pack: Packer, path: Toolpath, scale: float) -> dict[str, Any]:
    """The places between the ends of rapids that turn a workpiece, and the row of each: arcs and spirals about its axis."""
    pieces, row = parted_rapids(path, TURN)
    within = np.append(row[1:] == row[:-1], False)
    return {"row": pack.add(row[within]), "at": columns(pack, parted(pieces.on_workpiece().end[within], scale))}


def _tips(path: Toolpath, steps: ArrayLike, scale: float) -> NDArray[np.int64]:
    """Where the tool is when the programmed point changes (k, 3): mostly at the same distance from it."""
    return parted(_vertices(path), scale)[np.searchsorted(path.step, steps, "right")]


def _vertices(path: Toolpath) -> Array:
    """Where the rows of a path begin and end (n + 1, 3)."""
    return np.concatenate([path.start[:1], path.end]) if len(path) else np.zeros((1, 3))


def _lines(pack: Packer, program: Program) -> tuple[int, int]:
    """The first line of each block, and how many come after it."""
    first, last = (column.astype(np.int64) for column in program.lines())
    return pack.add(first), pack.add(last - first)


def _profile(pack: Packer, profile: Profile, scale: float) -> dict[str, Any]:
    """Nodes of the pieces and the row of each; between two nodes the way is the cubic of both speeds."""
    p = profile.pieces
    seconds, speeds = parts_of(SECONDS, p.t), parts_of(SPEEDS, p.v)
    found: dict[str, Any] = {"row": pack.add(p.row), "seconds": seconds, "speeds": speeds}
    time, speed = parted(p.t, seconds), parted(p.v, speeds)
    off = time.copy()
    off[1:] -= np.cumsum(_guessed(profile, time, seconds, speed / speeds, scale))
    found["guessed"] = not p.j.any() and size(off) < size(time)
    found |= {"t": pack.add(off if found["guessed"] else time), "v": pack.add(speed)}
    if p.j.any():  # without jerk the way is the mean of the speeds times the time
        found["s"] = pack.add(parted(p.s, scale))
    loose = _loose_pieces(profile)
    if len(loose):
        found["loose"] = {"piece": pack.add(loose)} | _ends(pack, profile, loose, scale, speeds)
    return found


def _guessed(profile: Profile, time: NDArray[np.int64], seconds: float, v: Array, scale: float) -> NDArray[np.int64]:
    """Durations of the pieces (n,) as straight rows of three let guess them: the first one as in the row before, the last one
    by the same acceleration, between them what is left of the length."""
    row, lasts, path = profile.pieces.row, np.diff(time), profile.path.on_workpiece()
    at = (parted(column, scale) / scale for column in _vertices(path).T)
    straight = np.sqrt(sum(np.diff(column) ** 2 for column in at))
    whole = (np.bincount(row, minlength=1)[row] == 3) & (path.kind[row] != Kind.ARC)
    first = np.flatnonzero(whole & (np.diff(row, prepend=-1) > 0))
    steps = np.abs(np.diff(v))
    found, speed = np.zeros(len(row), dtype=np.int64), (v[1:] + v[:-1]) / 2
    found[first[1:]] = lasts[first[:-1]]
    with np.errstate(divide="ignore", invalid="ignore"):
        found[first + 2] = _whole(lasts[first] * (steps[first + 2] / steps[first]))
        ways = speed[first] * (lasts[first] / seconds) + speed[first + 2] * (lasts[first + 2] / seconds)
        found[first + 1] = _whole((straight[row[first]] - ways) / speed[first + 1] * seconds)
    return found


def _whole(values: Array) -> NDArray[np.int64]:
    return np.where(np.abs(values) < ROOM, np.floor(values + 0.5), 0).astype(np.int64)


def _loose_pieces(profile: Profile) -> NDArray[np.int64]:
    """The pieces of rapids whose axes go by themselves and leave the straight line."""
    rows, p, path = _rapid_rows(profile), profile.pieces, profile.path
    pieces = np.flatnonzero(np.isin(p.row, rows))
    if not len(pieces):
        return pieces
    row = p.row[pieces]
    middle = profile.at((p.t[pieces] + p.t[pieces + 1]) / 2).position - path.start[row]
    straight = path.end[row] - path.start[row]
    along = np.einsum("ij,ij->i", middle, straight) / np.einsum("ij,ij->i", straight, straight)
    off = np.linalg.norm(middle - along[:, None] * straight, axis=1) > OFF
    return pieces[np.isin(row, row[off])]


def _rapid_rows(profile: Profile) -> NDArray[np.int64]:
    rapids, rows = profile.plan.rapids, profile.plan.row
    if rapids is None:
        return np.empty(0, dtype=np.int64)
    return rapids.rows if rows is None else rows[rapids.rows]


def _ends(pack: Packer, profile: Profile, pieces: NDArray[np.int64], scale: float, speeds: float) -> dict[str, Any]:
    """Place and velocity of the tool at both ends of some pieces."""
    rapids, p = profile.plan.rapids, profile.pieces
    assert rapids is not None
    which = np.searchsorted(_rapid_rows(profile), p.row[pieces])
    begin = profile.starts[p.row[pieces]]
    found = {}
    for name, node in (("0", pieces), ("1", pieces + 1)):
        since = np.clip(p.t[node] - begin, 0.0, rapids.seconds[which])
        place, velocity, _, _ = rapids.state(which, since)
        found["p" + name] = columns(pack, parted(place, scale))
        found["v" + name] = columns(pack, parted(velocity, speeds))
    return found

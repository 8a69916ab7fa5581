"""What the page needs of a run: both paths, what was active at each step, the feed-rate profile, the texts.

Lengths are whole numbers of 1 / `scale` mm: the coarsest of 1e-3, 1e-4 and 1e-6 mm that loses nothing, so that the
page says the digits that the run says. Times are whole microseconds, speeds whole micrometres per second; where numbers
are too large for that, the parts are coarser by powers of ten. Arcs stay arcs. A *log* is a list of places where a value
changes and the values from there on.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, is_dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.path.kinds import Kind
from mnclab.path.profile import Profile
from mnclab.path.toolpath import Toolpath
from mnclab.show.given_away import named
from mnclab.show.player.packing import LARGEST, Packer
from mnclab.text.alarm import Alarm, amounts, several
from mnclab.text.program import Program

SCALES = (1e3, 1e4, 1e6)  # parts of a millimetre
ANGLES = 1e9  # parts of a radian
DEGREES = 1e6  # parts of a degree, of rotary axes
ROOM = LARGEST // 4  # of what the page holds: places are sent as differences
#: The columns that the page has as logs.
SHOWN = ("feed", "per_rev", "surface", "speed_limit", "spindle_x", "spindle", "side")
SECONDS, SPEEDS = 1e6, 1e3  # parts of a second, of a millimetre in a second
OFF = 0.02  # mm that a rapid leaves its straight line before its true course is sent

Array = NDArray[np.float64]


def payload(run: Any, profile: Profile) -> str:
    """A run with its profile as the text that `data.js` reads."""
    pack = Packer()
    path, programmed = run.toolpath, run.programmed
    moved, places = _parted(run, "position")
    positions = np.array(places, dtype=np.float64).reshape(-1, 3)
    scale = _scale([path, programmed], positions, profile.pieces.s)
    angles, turned = _parts(ANGLES, path.sweep, programmed.sweep), np.degrees(path.rotary)
    degrees = _parts(DEGREES, turned)
    lines, lasts = zip(*(_lines(pack, program) for program in run.programs))
    header = {
        "title": run.program.title,
        "control": run.control.title,
        "lathe": path.lathe,
        "alarms": [
            alarm.as_dict()
            | {"text": str(alarm), "program": alarm.span.program if alarm.span else 0}
            | {"places": [[place.program, place.line] for place in alarm.places]}
            for alarm in map(named, run.alarms)
        ],
        "more": more_than_first(run.alarms),
        "programs": [{"name": program.title, "text": program.text} for program in run.programs],
        "lines": lines,
        "lasts": lasts,
        "steps": {"block": pack.add(run.steps.block), "program": pack.add(run.steps.program)},
        "scale": scale,
        "angles": angles,
        "origin": path.origin.tolist(),
        "path": _geometry(pack, path, scale, angles),
        "programmed": None if programmed is path else _geometry(pack, programmed, scale, angles),
        "row": {"step": pack.add(path.step)}
        | {name: _log(pack, getattr(path, name)) for name in SHOWN}
        | {"label": _log(pack, np.array(path.labels, dtype=object)[path.label] if len(path) else [])},
        "position": {
            "at": pack.add(moved),
            "from": _columns(pack, _whole(positions, scale) - _tips(path, moved, scale)),
        },
        "rotary": _columns(pack, _whole(turned, degrees)) if path.rotary.any() else None,
        "degrees": degrees,
        "stock": [np.round(edge, 4).tolist() for edge in run.stock.edges()] if run.stock else [],
        "history": {name: _values(pack, *_parted(run, name)) for name in run.history if name != "position"},
        "profile": _profile(pack, profile, scale),
    }
    return pack.text(header)


def more_than_first(alarms: Sequence[Alarm]) -> str:
    """How many alarms and warnings there are beside the first alarm, or else the first warning: what the page has room for."""
    rest = amounts(alarms)
    first = next((severity for severity, count in rest.items() if count), "")
    rest[first] -= 1
    return " and ".join(several(n, f"more {name}" if name == first else name) for name, n in rest.items() if n > 0)


def plain(value: Any) -> Any:
    """A value of the history as JSON has it: a tool as its fields, points and frames as lists."""
    if is_dataclass(value) and not isinstance(value, type):
        return {name: plain(each) for name, each in asdict(value).items()}
    if isinstance(value, Mapping):
        return {str(name): plain(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not np.isfinite(value):
        return None if np.isnan(value) else "inf" if value > 0 else "-inf"
    return value if value is None or isinstance(value, str | int | float | bool) else str(value)


def _parted(run: Any, name: str) -> tuple[list[int], list[Any]]:
    """The steps at which a value of the history changes, and what it is from there on."""
    changes = run.history.changed(name)
    return [step for step, _ in changes], [value for _, value in changes]


def _scale(paths: list[Toolpath], positions: Array, ways: Array) -> float:
    """Parts of a millimetre that lengths are counted in."""
    arcs = [path.centre[path.kind == Kind.ARC] for path in paths]
    lengths = np.concatenate([each for path in paths for each in (path.start[:1], path.end)] + arcs + [positions])
    most = _parts(SCALES[-1], lengths, ways)
    for scale in SCALES[:-1]:
        if scale > most:
            break
        if np.abs(np.round(lengths * scale) / scale - lengths).max(initial=0.0) < 1e-9:
            return scale
    return most


def _parts(finest: float, *columns: Array) -> float:
    """How many parts a unit is counted in: `finest`, or the power of ten at which no value is too large for the page."""
    most = max((float(np.abs(column[np.isfinite(column)]).max(initial=0.0)) for column in columns), default=0.0)
    return finest if most * finest <= ROOM else 10.0 ** np.floor(np.log10(ROOM / most))


def _whole(values: ArrayLike, scale: float) -> NDArray[np.int64]:
    """Whole numbers of the parts of a unit; what has no end is as large as can be."""
    found = np.nan_to_num(np.round(np.asarray(values, dtype=np.float64) * scale), posinf=ROOM, neginf=-ROOM)
    return found.clip(-ROOM, ROOM).astype(np.int64)


def _columns(pack: Packer, values: NDArray[np.int64]) -> list[int]:
    return [pack.add(values[:, k]) for k in range(values.shape[1])]


def _geometry(pack: Packer, path: Toolpath, scale: float, angles: float) -> dict[str, Any]:
    """Kinds and vertices of a path (n + 1), and centre and sweep of its arcs."""
    arc = path.kind == Kind.ARC
    return {
        "kind": pack.add(path.kind),
        "vertex": _columns(pack, _whole(_vertices(path), scale)),
        "centre": _columns(pack, _whole(path.centre[arc], scale)),
        "sweep": pack.add(_whole(path.sweep[arc], angles)),
        "axis": _log(pack, path.axis[arc]),
    }


def _log(pack: Packer, column: Any) -> dict[str, Any]:
    """A column (n,) or (n, 3) as its changes."""
    column = np.asarray(column)
    if not len(column):
        return {"at": pack.add([]), "of": pack.add([]), "values": []}
    if column.dtype.kind == "f":
        same = (column[1:] == column[:-1]) | (np.isnan(column[1:]) & np.isnan(column[:-1]))
    else:
        same = column[1:] == column[:-1]
    at = np.flatnonzero(np.append(True, ~(same.all(axis=1) if column.ndim == 2 else same)))
    return _values(pack, at, column[at].tolist())


def _values(pack: Packer, at: ArrayLike, values: list[Any]) -> dict[str, Any]:
    """Changes at some places; equal values are sent once."""
    index: dict[str, int] = {}
    kept: list[Any] = []
    of = []
    for value in map(plain, values):
        of.append(index.setdefault(repr(value), len(kept)))
        if of[-1] == len(kept):
            kept.append(value)
    return {"at": pack.add(at), "of": pack.add(of), "values": kept}


def _tips(path: Toolpath, steps: list[int], scale: float) -> NDArray[np.int64]:
    """Where the tool is when the programmed point changes (k, 3): mostly at the same distance from it."""
    return _whole(_vertices(path), scale)[np.searchsorted(path.step, steps, "right")]


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
    seconds, speeds = _parts(SECONDS, p.t), _parts(SPEEDS, p.v)
    found: dict[str, Any] = {"row": pack.add(p.row), "seconds": seconds, "speeds": speeds}
    found |= {"t": pack.add(_whole(p.t, seconds)), "v": pack.add(_whole(p.v, speeds))}
    if p.j.any():  # without jerk the way is the mean of the speeds times the time
        found["s"] = pack.add(_whole(p.s, scale))
    loose = _loose_pieces(profile)
    if len(loose):
        found["loose"] = {"piece": pack.add(loose)} | _ends(pack, profile, loose, scale, speeds)
    return found


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
        found["p" + name] = _columns(pack, _whole(place, scale))
        found["v" + name] = _columns(pack, _whole(velocity, speeds))
    return found

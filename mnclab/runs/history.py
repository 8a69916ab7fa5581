"""What changed at each step: a log per name, looked up by `searchsorted`; the machine at one moment, and its values in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from html import escape
from textwrap import wrap
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.machine.axes import CHAIN
from mnclab.machine.machine import Machine
from mnclab.machine.setup import ROWS, Tables
from mnclab.machine.state import Logs, Values
from mnclab.path.listing import INCHES, MM, TENTHS, Unit, figure, point
from mnclab.text.program import Block
from mnclab.text.tables import html_table
from mnclab.workpiece.blank import is_blank

# A *step* is one execution of a block; a loop runs a block many times, each a step of its own. Names are modal groups
# ("motion", "plane"), values ("feed", "speed", "spindle", "tool"), "position" (the programmed point), frames ("frame
# datum", 4x4), "pole" (both coordinates in the plane, mm), variables ("Q5"), measured values and table rows.

class History(Mapping[str, Any]):
    """What was active at each step of a run. `history["feed"]` is one value per step, `history.at(step)` a dict."""

    def __init__(self, logs: Logs, steps: int) -> None:
        self.steps = steps
        self._open = {name: log for name, log in logs.by_name.items() if log.first < max(steps, 1)}
        self._closed: dict[str, tuple[NDArray[np.integer[Any]], Values]] = {}

    def log(self, name: str) -> tuple[NDArray[np.integer[Any]], Values]:
        """Steps and values of a name; put together when first asked for, since a million positions take time."""
        if name not in self._closed:
            self._closed[name] = self._open[name].close(max(self.steps - 1, 0))
        return self._closed[name]

    def __getitem__(self, name: str) -> Values:
        """One value per step; None before the first."""
        at, values = self.log(name)
        index = np.searchsorted(at, np.arange(self.steps), "right") - 1
        if isinstance(values, np.ndarray) and (index >= 0).all():
            return values[index]
        return [values[i] if i >= 0 else None for i in index]

    def __contains__(self, name: object) -> bool:
        return name in self._open  # a Mapping would make all its values to know

    def __iter__(self) -> Iterator[str]:
        return iter(self._open)

    def __len__(self) -> int:
        return len(self._open)

    def value(self, name: str, step: int) -> Any:
        """What `name` was after a step; None if it had no value yet."""
        if name not in self._open:
            return None
        at, values = self.log(name)
        index = int(np.searchsorted(at, step, "right")) - 1
        return _python(values[index]) if index >= 0 else None

    def changed(self, name: str) -> list[tuple[int, Any]]:
        """The steps at which a name changed, and its value from there on; empty for a name without a log."""
        if name not in self._open:
            return []
        at, values = self.log(name)
        if isinstance(values, np.ndarray) and values.ndim == 1 and values.dtype != object:
            return [*zip(at.tolist(), values.tolist())]
        return [*zip(at.tolist(), map(_python, values))]

    def at(self, step: int) -> dict[str, Any]:
        """Everything that had a value after a step."""
        return {name: value for name in self._open if (value := self.value(name, step)) is not None}

    def changes(self, step: int) -> dict[str, Any]:
        """What this step changed; a value that was written again as it was is no change."""
        found = {}
        for name in self._open:
            at, values = self.log(name)
            index = int(np.searchsorted(at, step, "right")) - 1
            if index >= 0 and at[index] == step:
                value = _python(values[index])
                if index == 0 or value != _python(values[index - 1]):
                    found[name] = value
        return found

    def __repr__(self) -> str:
        return f"<History: {self.steps} steps, {len(self._open)} names>"


def _python(value: Any) -> Any:
    """A numpy value as a plain one; a point as a tuple."""
    if isinstance(value, np.ndarray):
        return tuple(value.tolist())
    return value.item() if isinstance(value, np.generic) else value


# Values of the history in words: each alone (`said`), or with its field name and unit (`told`).

Matrix = NDArray[np.float64]

#: How values print whose names in the history are short: the words before the number, its unit.
MEASURED = {
    "speed": ("speed", "rev/min"),
    "surface": ("cutting speed", "m/min"),
    "speed_limit": ("speed limit", "rev/min"),
}
WORDS = {
    "turning": ("spindle", {1: "clockwise", -1: "counter-clockwise", 0: "stopped"}),
    "side": ("compensation", {1: "left", -1: "right", 0: "off"}),
}
#: By what the history holds of the unit of a program.
UNITS = {"G20": INCHES, "G70": INCHES, "INCH": TENTHS, "INCH, F in inches": INCHES}
UNTOLD = ("position", "per_rev", "per_time")  # the place is told anyway, how the feed counts is told by its unit


def unit_of(state: Mapping[str, Any]) -> Unit:
    """What lengths of the program counted in then."""
    return UNITS.get(str(state.get("unit")), MM)


def told(values: Mapping[str, Any], state: Mapping[str, Any]) -> list[str]:
    """Some values of a moment in words with units; `state` holds all that was active then."""
    return [_told(name, value, state) for name, value in values.items() if name not in UNTOLD]


def with_feed(changed: Mapping[str, Any], state: Mapping[str, Any]) -> Mapping[str, Any]:
    """What a step changed, with the feed where the same number now counts in another unit."""
    counts_otherwise = not {"per_rev", "per_time"}.isdisjoint(changed) and "feed" in state
    return {"feed": state["feed"], **changed} if counts_otherwise else changed


def _told(name: str, value: Any, state: Mapping[str, Any]) -> str:
    if name in WORDS:
        title, words = WORDS[name]
        return f"{title} {words[int(value)]}"
    title, unit = MEASURED.get(name, (name, ""))
    if name == "feed":
        own = unit_of(state).for_feed(state.get("per_rev"))
        value = value if value is None or state.get("per_time") else value / own.feed
        unit = "s" if state.get("per_time") else own.rate
    if value is None or does_nothing(name, value):
        return f"{title} none"
    if isinstance(value, int | float):
        return f"{title} {short(value)} {'x ' * unit[:1].isdigit()}{unit}".rstrip()  # such as 40 x 0.1 in/min
    return f"{title} {said(name, value, unit_of(state))}".rstrip()


def does_nothing(name: str, value: Any) -> bool:
    """Whether a value is that of something switched off, which need not be told of a machine at rest."""
    still = name in ("side", "rotation angle") and value == 0 or name == "speed_limit" and value == np.inf
    return still or (name.startswith("frame ") and value is not None and np.array_equal(value, frames.IDENTITY))


def short(value: float) -> str:
    """A number with three decimals at most; one that is smaller with three digits."""
    return figure(value, 3) if abs(value) >= 5e-4 or not value else f"{value:.3g}"


def said(name: str, value: Any, unit: Unit = MM) -> str:
    """A value of the history in words: angles of the rotary axes in degrees."""
    if name == "feed" and value is not None:
        value /= unit.feed
    if name == "rotary" and value is not None:
        return " ".join(f"{axis}{figure(np.degrees(angle), 6)}" for axis, angle in zip("ABC", value, strict=True))
    return _plain(value, unit if name in ("position", "pole", "stock") or name.startswith("frame ") else MM)


def _plain(value: Any, unit: Unit) -> str:
    if value is None:
        return ""
    if isinstance(value, int | float):
        return figure(float(value), 6)
    if isinstance(value, str):
        return value
    if isinstance(value, tuple) and len(value) == 4 and np.shape(value[-1]) == (4,):
        return described(np.array(value), unit) or "none"
    if is_blank(value):
        return " to ".join(point(corner, unit) for corner in value.bounds)
    if hasattr(value, "corners"):  # of a blank of which half may be missing
        return " to ".join(point(corner, unit) for corner in value.corners)
    if isinstance(value, tuple) and type(value).__str__ is not tuple.__str__:  # it says itself what it is
        return str(value)
    if isinstance(value, tuple):
        return " ".join(unit.figure(each) if isinstance(each, int | float) else _plain(each, unit) for each in value)
    number = getattr(value, "number", None)
    return f"T{number} {value.name}".strip() if number is not None else str(value)


def described(matrix: Matrix, unit: Unit = MM) -> str:
    """A frame in words."""
    if frames.is_shift(matrix):
        return f"shift {point(matrix[:3, 3], unit)}"
    linear = matrix[:3, :3]
    scales = np.linalg.norm(linear, axis=0)
    if np.allclose(np.abs(linear), np.diag(scales)):
        signs = "".join(axis for axis, factor in zip("XYZ", np.diag(linear)) if factor < 0)
        said = [f"mirror {signs}"] if signs else []
        said += [f"scale {' '.join(map(figure, scales))}"] if not np.allclose(scales, 1) else []
        return ", ".join(said)
    angle = np.degrees(np.arccos(np.clip((np.trace(linear) - 1) / 2, -1, 1)))
    return f"turn by {figure(angle if linear[1, 0] >= 0 else -angle)}°" if np.allclose(scales, 1) else "turn and scale"


# One moment of a run: the machine after a block, or on the way through it.

WIDTH, SHOWN = 100, 60  # characters of a line; values that are listed


class Moment(NamedTuple):
    """The machine after one step: the block, the programmed point (program coordinates, mm), what was active and what
    the block changed; `rows` are the rows of the toolpath that it made.

    A moment inside a block (`Run.when`) has the row of the toolpath, the share of it (0 to 1) that was done, and
    the tool tip there, mm; -1 for a row where the block moved nothing. `text` is the line as written.
    """

    step: int
    line: int
    block: Block
    position: tuple[float, float, float]
    state: dict[str, Any]
    changed: dict[str, Any]
    rows: slice
    row: int = -1
    share: float = 1.0
    point: tuple[float, float, float] = (0.0, 0.0, 0.0)
    text: str = ""
    lathe: bool = False

    @property
    def title(self) -> str:
        return f"line {self.line}: {self.text or self.block}"

    def page(self) -> list[tuple[str, str]]:
        changed = with_feed(self.changed, self.state)
        active = {
            name: value for name, value in self.state.items() if name not in changed and not does_nothing(name, value)
        }
        first, stop = self.rows.start, self.rows.stop
        rows = "none" if first == stop else f"{first}" if stop == first + 1 else f"{first} to {stop - 1}"
        inside = f", {100 * self.share:.4g} % of row {self.row}" if self.share != 1 else ""
        return [
            ("programmed point", point(self.position, unit_of(self.state), self.lathe)),
            ("tool tip", point(self.point, unit_of(self.state), self.lathe)),
            ("rows of the path", rows + inside),
            ("changed", _listed(told(changed, self.state), "the position" if "position" in self.changed else "nothing")),
            ("active", _listed(told(active, self.state))),
        ]

    def __repr__(self) -> str:
        page = self.page()
        wide = max(len(title) for title, _ in page) + 4
        lines = [self.title]
        for title, value in page:
            lines += wrap(value, WIDTH, initial_indent=f"  {title:{wide - 2}}", subsequent_indent=" " * wide)
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        title = f"line {self.line}: <code>{escape(self.text or str(self.block))}</code>"
        return f"<h4>{title}</h4>{html_table((), self.page())}"


def _listed(words: list[str], none: str = "nothing") -> str:
    more = [f"… {len(words) - SHOWN} more"] if len(words) > SHOWN else []
    return ", ".join(words[:SHOWN] + more) or none


# The tables of the machine as a run leaves them.

def tables_at_end(m: Machine, history: History, steps: int) -> Tables:
    """What the program wrote; of a run that was cut off only what came before the fault."""
    if m.cut is None:
        return m.tables
    tables, last = Tables(m.setup, m.control.magazine), steps - 1
    for name in history:
        table, _, row = name.partition(" ")
        if table in ROWS and row:
            getattr(tables, table)[int(row)] = history.value(name, last)
    for name in ("probe", CHAIN):
        setattr(tables, name, history.value(name, last) or getattr(tables, name))
    return tables

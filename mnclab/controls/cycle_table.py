"""The steps of a cycle as a table for a person: lengths in mm, and in words what a step does beside going to its end."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from html import escape
from typing import Any, NamedTuple

from mnclab.machine.cycle import Cycle
from mnclab.machine.setup import AXES, Datum, tool_line
from mnclab.machining.steps import Call, Coolant, Orient, Pause, Say, Spin, Step, Swivel, Turn, Wait, Write
from mnclab.path.listing import figure, point
from mnclab.runs.values import described, said
from mnclab.text.tables import html_table, text_table
from mnclab.workpiece.part import Part

Point = tuple[float, float, float]
DECIMALS = 3  # of a length and of a feed, as a control shows them
SPINDLE = {1: "clockwise", -1: "counter-clockwise", 0: "stopped"}
SIDES = {1: "left", -1: "right", 0: "off"}


class Row(NamedTuple):
    """A step, where the tool stands after a motion (mm, in the program), and its feed in words."""

    step: Step
    end: Point | None = None
    feed: str = ""


class CycleSteps(Sequence[Step]):
    """The steps of a cycle from a place on, and the values (by parameter name) that they were made with.

    As a table it leaves out what the control keeps for itself, and for a lathe the column y.
    """

    def __init__(
        self, cycle: type[Cycle], values: Mapping[str, Any], start: Point, rows: Sequence[Row], *,
        lathe: bool = False, per_rev: bool = False, part: Part | None = None,
    ) -> None:  # fmt: skip
        self.cycle, self.values, self.start, self.rows = cycle, values, start, tuple(rows)
        self.lathe, self.per_rev, self.part = lathe, per_rev, part

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, index: Any) -> Any:
        return tuple(row.step for row in self.rows[index]) if isinstance(index, slice) else self.rows[index].step

    @property
    def title(self) -> str:
        """The cycle, its values in the order of a program, and where it is called."""
        given = [f"{p.address}={quoted(self.values[p.name])}" for p in self.cycle.parameters() if p.name in self.values]
        name = f"{self.cycle.code} {self.cycle.title}" + (f": {' '.join(given)}" if given else "")
        x, _, z = self.start
        return f"{name}, called at " + (f"X{figure(x)} Z{figure(z)}, X as radius" if self.lathe else point(self.start))

    @property
    def head(self) -> tuple[str, ...]:
        feed = f"feed, {'mm/rev' if self.per_rev else 'mm/min'}"
        return "step", "label", *(("x (radius)", "z") if self.lathe else "xyz"), feed, "detail"

    def cells(self) -> list[tuple[str, ...]]:
        """The table's rows; where nothing but bookkeeping would stand in them, one that names it."""
        found = list(self._told())
        if found or not self.rows:
            return found
        kept = dict.fromkeys(words(row.step.key) for row in self.rows if isinstance(row.step, Write))
        return [("write", *[""] * (len(self.head) - 2), f"kept for later blocks: {', '.join(kept)}")]

    def _told(self) -> Iterator[tuple[str, ...]]:
        names: set[str] = set()
        for step, end, feed in self.rows:
            detail = DETAILS[type(step)](step) if type(step) in DETAILS else ""
            if isinstance(step, Write):
                name = detail.partition(":")[0]
                if not detail or (step.what in ("memory", "history") and name in names):
                    continue  # bookkeeping, or what another row has told
                names.add(name)
            places = [""] * 3 if end is None else [figure(value, DECIMALS) for value in end]
            yield type(step).__name__.lower(), step.label, *places[:: 2 if self.lathe else 1], feed, detail

    def __str__(self) -> str:
        return f"{self.title}\n{text_table(self.head, self.cells())}"

    __repr__ = __str__

    def _repr_html_(self) -> str:
        numbers = range(2, len(self.head) - 1)
        return f"<p>{escape(self.title)}</p>{html_table(self.head, self.cells(), numbers=numbers)}"


def quoted(value: Any) -> str:
    """A value as the title shows it."""
    if isinstance(value, tuple):
        return ",".join(map(quoted, value))
    return figure(value) if isinstance(value, int | float) else str(value)


def words(name: Any) -> str:
    return str(name).replace("_", " ")


def called(step: Call) -> str:
    """What a call calls, and the values that count in place of the defined ones."""
    instead = ", ".join(f"{words(name)} {figure(value)}" for name, value in step.instead.items())
    return "the cycle defined before" + (f", with {instead}" if instead else "")


def zero_point(datum: Datum, *, whole: bool) -> str:
    """A zero point: all of X, Y and Z if `whole`, else only what is not zero."""
    pairs = zip(AXES, datum, strict=True)
    told = [f"{name}{figure(value)}" for k, (name, value) in enumerate(pairs) if value or (whole and k < 3)]
    return " ".join(told) or "all zero"


def written(step: Write) -> str:
    """What stays, in words; nothing for what the control keeps for itself."""
    value, key = step.value, step.key
    match step.what:
        case "kept":
            return ""
        case "memory" | "history":
            return f"{words(key)}: {quoted(value)}" if isinstance(value, int | float | str) and value != "" else ""
        case "modal":
            return f"{key} {value}"
        case "frame":
            told = "" if value is None else described(value).removeprefix(f"{key} ")
            return f"frame {key}: {told or 'none'}"
        case "renamed":
            return f"frame {key}: now called {value}"
        case "datum":
            return f"datum: {zero_point(value, whole=True)}"
        case "tool" | "tools":
            return f"{step.what}{'' if key is None else f' row {key}'}: {tool_line(value)}"
        case "file":
            return f"file {key}"
        case "presets" | "datums":
            row = zero_point(value, whole=False) if isinstance(value, Datum) else str(value)
            return f"{step.what} row {key}: {row}"
        case "variable" | "measured":
            return f"{step.what} {key} = {quoted(value)}"
        case "file" | "appended":
            return f"file {key}"
        case "tolerance":
            return f"tolerance: {'as the limits have it' if math.isnan(value) else figure(value)}"
        case "side":
            return f"radius compensation: {SIDES[value]}"
        case _:
            return f"{step.what}: {said(step.what, value)}"


#: What a step does beside going to its end.
DETAILS: dict[type[Step], Callable[[Any], str]] = {
    Turn: lambda step: f"{figure(math.degrees(step.angle))}°",
    Wait: lambda step: f"{figure(step.seconds)} s",
    Pause: lambda s: "program stop",
    Spin: lambda s: SPINDLE[s.turning] + (f", {figure(s.speed)} rev/min" if s.turning and s.speed else ""),
    Orient: lambda step: f"at {figure(step.angle)}°",
    Coolant: lambda step: "on" if step.on else "off",
    Swivel: lambda step: " ".join(f"{axis}{figure(angle)}°" for axis, angle in zip("ABC", step.angles, strict=True)),
    Call: called,
    Say: lambda step: step.text,
    Write: written,
}

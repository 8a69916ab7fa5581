"""What the cycles have alike: X and Z as coordinates or increments, the feed of a cycle, and the marks of their frames."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mnclab.controls.nc_31 import discretes
from mnclab.controls.nc_31.functions import refuse_rapid
from mnclab.machine.cycle import Cycle, Given, Values, param
from mnclab.machine.machine import Machine
from mnclab.machining.turning.roughing import Crosswise
from mnclab.text.program import INCREMENTAL, RAPID_MARK

SWITCH = {0.0: "no", 1.0: "yes"}
FROM_START = "@: from the start point"


class FromStart(Crosswise, Cycle):
    """A cycle whose X and Z count from the start point where they have the mark @, with a feed of its own."""

    feed: float | None

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        ends = {name: given[name] for name in ("x", "z") if name in given}
        refuse_rapid(m, list(ends.values()), cls.code)
        for name, axis, scale in (("x", 0, discretes.X), ("z", 2, discretes.Z)):
            if name in ends and ends[name].incremental:
                values[name] += round(m.programmed[axis] * scale, 6)
        return values

    def modal_feed(self, m: Machine) -> float | None:
        """F of the cycle, mm/rev or mm."""
        return None if self.feed is None else self.feed / discretes.CYCLE_FEED

    def needs_feed(self, m: Machine) -> Iterator[tuple[str, str]]:
        if self.feed is None and m.feed is None:
            yield "", "needs a feed: F here, or before it"


def start(m: Machine) -> tuple[float, float]:
    """The start point (X, Z) in mm, X on the radius."""
    return m.programmed[0], m.programmed[2]


def here(m: Machine) -> tuple[float, float]:
    """The start point in discretes: X on the diameter, Z."""
    return m.programmed[0] * discretes.X, m.programmed[2] * discretes.Z


def apart(x: float | None, z: float | None, m: Machine) -> Iterator[tuple[str, str]]:
    """Faults of ends that lie at the start."""
    x1, z1 = here(m)
    if x is not None and abs(x - x1) < 1e-6:
        yield "x", f"must differ from the start diameter, got {x:.10g}"
    if z is not None and abs(z - z1) < 1e-6:
        yield "z", f"must differ from the Z of the start, got {z:.10g}"


def aside(axis: str, meaning: str, left_out: str, example: float) -> Any:
    """Where the tool goes afterwards, if it does."""
    unit = "0.01 mm on diameter" if axis == "X" else "0.01 mm"
    return param(axis, meaning, unit, default=None, default_means=left_out, note=FROM_START, example=example)


def feed_word(meaning: str, unit: str = "0.0001 mm/rev", default: str = "the modal feed", example: float = 2000) -> Any:
    """F of a cycle: six digits, and left out what was set before it."""
    digits: dict[str, Any] = {"at_least": 1, "at_most": 999_999, "type": "integer"}
    return param("F", meaning, unit, default=None, default_means=default, example=example, **digits)


def size(meaning: str, unit: str = "0.01 mm", **options: Any) -> Any:
    """A P frame: a length of its own, never a coordinate."""
    return param("P", meaning, unit, incremental=True, type="integer", **options)


def rapid_mark(meaning: str) -> Any:
    """The mark ~ on the G frame."""
    return param("~", meaning, "mark", default=0, choices=SWITCH, mark=RAPID_MARK, example=1)


def own_mark(meaning: str, **options: Any) -> Any:
    """The mark @ on the G frame, where it means something of its own."""
    return param("@", meaning, "mark", default=0, choices=SWITCH, mark=INCREMENTAL, **options)

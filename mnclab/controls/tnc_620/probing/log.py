"""The measuring log (TNC 620, 16.1): a text with the nominal values, the limits, the actual values and the deviations.

Lengths are in the unit of the program. A run has a date and a time where the setting `clock` gives it one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from mnclab.controls.tnc_620.clock import time_of_day
from mnclab.controls.tnc_620.probing.cycle import ProbingCycle
from mnclab.controls.tnc_620.probing.fast_probing import shows_results
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import OK, SCRAP, judged
from mnclab.machining.steps import Pause, Step, Write

UNKNOWN = "not known (setting clock)"
SCREEN = "SCREEN:"  # the window of FN 16


class Value(NamedTuple):
    """A measured value: `what` it is in the record, its `name` in the log, mm or degrees as the `unit` says.

    `q` and `difference` are the Q parameters of the value and of its deviation. `lower` and `upper` are the limits as they are
    given, `limit` is how the log names them; where they are `watched`, what is `below` or `above` is "rework" or "scrap".
    """

    what: str
    name: str
    actual: float
    q: str
    nominal: float = math.nan
    difference: str = ""
    lower: float = math.nan
    upper: float = math.nan
    limit: str = ""
    watched: bool = False
    below: str = SCRAP
    above: str = SCRAP
    unit: str = "mm"

    @property
    def deviation(self) -> float:
        """Actual less nominal."""
        return self.actual - self.nominal

    @property
    def verdict(self) -> str:
        """"ok", "rework" or "scrap"; "" where nothing watches it. On its limit it is within."""
        if not self.watched or judged(self.actual, self.lower, self.upper) == OK:
            return OK if self.watched else ""
        return self.below if self.actual < self.lower else self.above


def logged(m: Machine, c: ProbingCycle, values: Sequence[Value], further: Mapping[str, float]) -> Iterator[Step]:
    """Nothing with 0, a file with 1, and with 2 a window, while the program waits for NC start (Q281); or as cycle 441 says."""
    number, mode = c.code.split()[-1], c.measuring_log
    text = "\n".join([*lines(m, number, c.title, values, further), ""])
    if mode == 1:
        yield Write("file", text, f"TCHPR{number}.TXT")
    if shows_results(m, mode == 2):
        yield Write("file", text, SCREEN)
        yield Pause("the measuring log is shown")


def lines(m: Machine, number: str, title: str, values: Sequence[Value], further: Mapping[str, float]) -> Iterator[str]:
    """The lines of a log."""
    now = time_of_day(m)
    yield f"Measuring log for Probing Cycle {number} {title}"
    yield f"Date: {now:%d-%m-%Y}" if now else f"Date: {UNKNOWN}"
    yield f"Time: {now.hour}:{now:%M:%S}" if now else f"Time: {UNKNOWN}"
    yield f"Measuring program: {m.flow.program.title}"
    blocks: dict[str, list[tuple[str, float, str]]] = {
        "Nominal values": [(each.name, each.nominal, each.unit) for each in values],
        "Given limit values": [
            (f"{which} {each.limit}", value, each.unit)
            for each in values for which, value in (("Maximum", each.upper), ("Minimum", each.lower))
        ],
        "Actual values": [(each.name, each.actual, each.unit) for each in values],
        "Deviations": [(each.name, each.deviation, each.unit) for each in values],
    }  # fmt: skip
    for heading, rows in blocks.items():
        if known := [row for row in rows if not math.isnan(row[1])]:
            yield f"{heading}:"
            for name, value, unit in known:
                yield f"{name}: {figure(m, value, unit)}"
    if further:
        said = (f"{name}: {figure(m, value)}" for name, value in further.items())
        yield f"Further measuring results: {', '.join(said)}"
    yield "End of measuring log"


def figure(m: Machine, value: float, unit: str = "mm") -> str:
    """Four decimals, in the unit of the program."""
    return f"{value / m.variable_unit if unit == 'mm' else value:z.4f}"

"""What cycles that inspect a workpiece share (TNC 620, 16.1): results, classes, and the measuring log."""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from mnclab.controls.tnc_620.clock import time_of_day
from mnclab.controls.tnc_620.contours.line import Named, named_tool
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle
from mnclab.controls.tnc_620.probing.fast_probing import shows_results
from mnclab.machine.coordinates import in_mm
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import OK, REWORK, SCRAP, SLACK, judged
from mnclab.machine.touching import Contact
from mnclab.machining.probing.sequences import numbers, results
from mnclab.machining.steps import Measure, Pause, Step, Write

# The measuring log (TNC 620, 16.1): a text with the nominal values, the limits, the actual values and the deviations.
# Lengths are in the unit of the program. A run has a date and a time where the setting `clock` gives it one.

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


# What cycles that inspect a workpiece share (TNC 620, 16.1): results, classification, tolerance and tool monitoring, the log.
# Too much material is rework, too little is scrap, and so is a wrong place. A limit that is 0, of sizes both, watches nothing.

HEIGHT = "Measuring height"  # in the log
AXES = ("reference axis", "minor axis", "touch probe axis")


def report(
    c: ProbingCycle, m: Machine, values: Sequence[Value], contacts: Sequence[Contact], sizes: Sequence[Value] = (),
    compensation: tuple[float, float] = (0.0, 0.0),
) -> Moves:  # fmt: skip
    """Results, status, tool table and log, in this order; then an alarm where one is due.

    `sizes` are the values that the monitored tool made, `compensation` is what is added to its DR and DL.
    """
    touches, declared = numbers(contacts), {p.name for p in c.parameters()}
    for each in values:
        lower, upper = (each.lower, each.upper) if each.watched else (math.nan, math.nan)
        yield Measure(each.what, each.actual, each.nominal, lower, upper, each.unit, each.verdict, touches)
    unit = {"mm": m.variable_unit, "deg": 1.0}
    yield from results(**{each.q: each.actual / unit[each.unit] for each in values})
    yield from results(**{each.difference: each.deviation / unit[each.unit] for each in values if each.difference})
    out, broken = [each for each in values if each.verdict not in ("", OK)], ""
    if "program_stop" in declared:  # the others judge nothing
        verdict = next((which for which in (SCRAP, REWORK) if which in {each.verdict for each in out}), OK)
        yield from results(**{q: verdict == which for q, which in (("Q180", OK), ("Q181", REWORK), ("Q182", SCRAP))})
    if c.monitored_tool != 0 and sizes:
        broken = yield from monitored(m, c.monitored_tool, max(abs(each.deviation) for each in sizes), *compensation)
    yield from logged(m, c, values, {HEIGHT: c.level} if "level" in declared else {})
    if broken:
        m.alarm(in_mm(f"{c.code}: {broken}", m.variable_unit))
    if c.program_stop and out:
        said = (f"{each.what} {each.actual:.4f}, allowed from {each.lower:.4f} to {each.upper:.4f}" for each in out)
        length = any(each.unit == "mm" for each in out)
        m.alarm(in_mm(f"{c.code}: tolerance exceeded: {'; '.join(said)}", m.variable_unit, length))


def wear(sizes: Sequence[Value], inside: bool) -> tuple[float, float]:
    """What is added to DR and DL of the tool that made a figure: half of the deviation of a size, of two sides their mean."""
    return (1.0 if inside else -1.0) * sum(each.deviation for each in sizes) / len(sizes) / 2, 0.0


def middle(c: ProbingCycle, x: float, y: float) -> list[Value]:
    """The coordinates of the centre of a figure, Q151 and Q152."""
    given = (x, c.middle_x, c.tolerance_x), (y, c.middle_y, c.tolerance_y)
    return [
        Value("XY"[k], f"Center in {AXES[k]}", actual, f"Q15{k + 1}", nominal, f"Q16{k + 1}", nominal - off, nominal + off,
              f"limit for center in {AXES[k]}", off != 0)
        for k, (actual, nominal, off) in enumerate(given)
    ]  # fmt: skip


def size(
    what: str, name: str, q: str, difference: str, actual: float, nominal: float, limits: tuple[float, float], limit: str,
    inside: bool | None,
) -> Value:  # fmt: skip
    """A length, which is watched where one of its limits, the smaller and the larger, is not 0.

    `inside`: of a hollow figure; None: neither too large nor too small can be repaired.
   """
    below, above = {True: (REWORK, SCRAP), False: (SCRAP, REWORK), None: (SCRAP, SCRAP)}[inside]
    return Value(what, name, actual, q, nominal, difference, *limits, limit, limits != (0, 0), below, above)


def monitored(m: Machine, name: Named, deviation: float, radius: float, length: float) -> Generator[Step, Any, str]:
    """Adds `radius` to DR and `length` to DL; returns what an alarm says of a broken tool, which is locked instead.

    `deviation` (mm) is the greatest one of a size, broken is a tool whose RBREAK is smaller. What changed counts from the next
    TOOL CALL on.
    """
    tool = named_tool(m, name)
    assert tool is not None  # `check` has found it
    number = next(number for number, each in m.tables.tools.items() if each is tool)
    if 0 < tool.wear.break_radius < deviation - SLACK:
        yield Write("tools", replace(tool, locked=True), number)
        return f"tool {number:g} is broken: a deviation of {deviation:.4f} is more than its RBREAK {tool.wear.break_radius:g}"
    if radius or length:
        yield Write("tools", replace(tool, dr=tool.dr + radius, dl=tool.dl + length), number)
    return ""

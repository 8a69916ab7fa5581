"""What cycles that inspect a workpiece share (TNC 620, 16.1): results, classification, tolerance and tool monitoring, the log.

Too much material is rework, too little is scrap, and so is a wrong place. A limit that is 0, of sizes both, watches nothing.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Sequence
from dataclasses import replace
from typing import Any

from mnclab.controls.tnc_620.contours.other_tools import Named, named_tool
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle
from mnclab.controls.tnc_620.probing.log import Value, logged
from mnclab.machine.coordinates import in_mm
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import OK, REWORK, SCRAP, SLACK
from mnclab.machine.touching import Contact
from mnclab.machining.probing.sequences import numbers, results
from mnclab.machining.steps import Measure, Step, Write

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

"""Limits and feeds of programs in inches: every parameter with a limit is tried in both units of every control that has two.

The input range of a parameter is that of the number as it is written: cycle 32 of the TNC 620 takes T in mm or in inches from
0 to 10 (11.8). An alarm names the number that was written.
"""

from __future__ import annotations

import re
from typing import Any

import pytest
from tools.together import together

import mnclab as mnc
from mnclab.controls.g43.control import CONTROL as G43
from mnclab.controls.tnc_620.control import CONTROL as TNC
from mnclab.controls.tnc_620.trial import definition, first_words
from mnclab.machine.cycle import Cycle, Parameter
from mnclab.machine.trial import first_value

STEP = 1 / 1024  # exact in binary, and more than the digits that an alarm prints
SUB_BLOCKS = {  # which are not tried out, so that nothing else writes them
    "CYCL DEF 18": "CYCL DEF 18.0 THREAD CUTTING\nCYCL DEF 18.1 DEPTH {DEPTH}\nCYCL DEF 18.2 PITCH {PITCH}\nCYCL CALL M3",
    "CYCL DEF 32": "CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T{T}",
}


def limits(p: Parameter) -> list[tuple[float, float]]:
    """A number at each limit of a parameter, and one just beyond."""
    found = [(limit, limit + sign * STEP) for limit, sign in ((p.at_least, -1), (p.at_most, 1)) if limit is not None]
    return found + [(limit - sign * STEP, limit) for limit, sign in ((p.above, -1), (p.below, 1)) if limit is not None]


def each_limit(control: mnc.machine.control.Control, units: list[str], **share: int) -> Any:
    """A test of a parameter in a unit: a case a cycle and unit, which lists every address that fails."""
    cases = [
        (unit, cycle, p)
        for unit in units for cycle in dict.fromkeys(control.cycles.values()) for p in cycle.parameters()
        if p.in_units and limits(p) and not p.mark
    ]  # fmt: skip
    group = lambda unit, cycle, p: f"{unit} {cycle.code}"  # noqa: E731
    return together("unit cycle p", cases, group, lambda unit, cycle, p: p.address, **share)


def refusals(run: mnc.Run, p: Parameter) -> list[str]:
    """What an alarm found in place of a number that the parameter allows."""
    said = f"{p.address} ({p.meaning}) must be {p.allowed}, got "
    return [alarm.message.partition(said)[2] for alarm in run.alarms if said in alarm.message]


def klartext(cycle: type[Cycle], p: Parameter, number: float, unit: str) -> mnc.Run:
    words = [(address, value) for address, value in first_words(cycle) if address != p.address]
    order = [one.address for one in cycle.parameters()]
    mark = 7654.0  # stands in the text where the number comes
    words = sorted([*words, (p.address, mark)], key=lambda word: order.index(word[0]))
    lines = SUB_BLOCKS.get(cycle.code, "\n".join(definition(cycle, words)))
    lines = re.sub(rf"\+?{mark:g}(\.0)?", f"{number:+.10f}", lines.format(**dict(words)))
    text = f"BEGIN PGM A {unit}\nTOOL CALL 1 Z S1000 F100\n{lines}\nEND PGM A {unit}\n"
    return mnc.run(text, "tnc-620")


def written(number: float) -> str:
    return f"{number:.10g}"


def limits_hold(cycle: type[Cycle], p: Parameter, unit: str) -> None:
    for within, beyond in limits(p):
        assert refusals(klartext(cycle, p, within, unit), p) == []
        assert refusals(klartext(cycle, p, beyond, unit), p) == [written(beyond)]


@each_limit(TNC, ["INCH"], deep_but_one_in=4)
def test_every_limit_of_the_tnc_620(cycle: type[Cycle], p: Parameter, unit: str) -> None:
    limits_hold(cycle, p, unit)


@pytest.mark.deep
@each_limit(TNC, ["MM"])
def test_every_limit_of_the_tnc_620_in_mm(cycle: type[Cycle], p: Parameter, unit: str) -> None:
    """What test_declarations asks of the declaration alone is asked of programs here."""
    limits_hold(cycle, p, unit)


@each_limit(G43, ["G21", "G20"])
def test_every_limit_of_the_iso_mill(cycle: type[Cycle], p: Parameter, unit: str) -> None:
    words = {one.address: first_value(one) for one in cycle.parameters() if one.required or one.address in ("X", "Z", "R", "F")}
    for within, beyond in limits(p):
        for number, found in ((within, []), (beyond, [written(beyond)])):
            given = " ".join(f"{address}{float(value):.10f}" for address, value in (words | {p.address: number}).items())
            run = mnc.run(f"{unit}\nT1 M6\nG0 Z20 S1000 M3\n{cycle.code} {given}\n", "g43")
            assert refusals(run, p) == found

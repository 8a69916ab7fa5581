"""What a measuring cycle says of its measures: the record, the protocol file, and the stop beyond a limit (MNC 12.13 to 12.19).

Nobody says how the file looks; adopted are a running number in the folder and a line `name = value` for each number, with four
decimals, as the table of the record shows them (MNC-PROT-FORMAT). There is no date, so that two equal runs write equal files.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from mnclab.controls.mnc.probing.cycle import MeasuringCycle
from mnclab.machine.flow import FILE
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import DIGITS, OUT, judged
from mnclab.machine.touching import Contact
from mnclab.machining.probing.sequences import numbers
from mnclab.machining.steps import Measure, Pause, Say, Step, Write

FOLDER = "meas_prot"
OK = "ok"
SAID = {"too_large": "is too large, the limit is", "too_small": "is too small, the limit is", "center": "is off, the limit is"}


class Check(NamedTuple):
    """A measure, and the status that it has above and below its limits."""

    measure: Measure
    above: str = ""
    below: str = ""

    @property
    def status(self) -> str:
        """Empty within the limits; a value on its limit is within."""
        found = self.measure
        if judged(found.actual, found.lower, found.upper) != OUT:
            return ""
        return self.above if found.actual > found.upper else self.below

    @property
    def said(self) -> str:
        """The feature, its value and its limit."""
        found = self.measure
        limit = found.upper if found.actual > found.upper else found.lower
        words = next(words for name, words in SAID.items() if self.status.startswith(name))
        return f"{found.what} {found.actual:.{DIGITS}f} {words} {limit:.{DIGITS}f}"


def size(what: str, actual: float, nominal: float, most: float | None, least: float | None, axis: str = "") -> Check:
    """A size with its greatest and least permissible value; left out or 0 means that it is not checked (MNC-TOL-ZERO)."""
    found = Measure(what, actual, nominal, least or math.nan, most or math.nan)
    return Check(found, f"too_large{axis}", f"too_small{axis}")


def centre(axis: str, actual: float, nominal: float, by: float | None) -> Check:
    """A coordinate of a centre, which may deviate both ways."""
    off = by or math.nan
    status = f"center_{axis.lower()}"
    return Check(Measure(f"centre {axis}", actual, nominal, nominal - off, nominal + off), status, status)


def conclude(c: MeasuringCycle, m: Machine, contacts: Sequence[Contact], *checks: Check) -> Iterator[Step]:
    """The record, the protocol, and then the check of the limits: a warning and a stop that needs the operator, as the
    parameters of the cycle say; its datum and base rotation stay."""
    for check in checks:
        yield check.measure._replace(touches=numbers(contacts))
    beyond = [check for check in checks if check.status]
    if c.protocol:
        yield Write("file", text(m, c.code, checks, [check.status for check in beyond]), name(m, c.code))
    if beyond and c.stop_on_error:
        yield Say(f"{'; '.join(check.said for check in beyond)}: the program stops")
        yield Pause("limit exceeded")


def name(m: Machine, code: str) -> str:
    """The next file of the folder."""
    written = sum(each.startswith(f"{FILE}{FOLDER}/") for each in m.logs.by_name)
    return f"{FOLDER}/{code}_{written + 1:04d}.txt"


def head(m: Machine, code: str) -> list[str]:
    """The first lines of every file."""
    program = m.flow.program
    number = program[m.flow.current].number if len(program) else ""
    where = number or f"line {m.source_line}"
    return [f"cycle = {code}", f"program = {program.name}", f"block = {where}", f"tool = {m.tool.number}"]


def text(m: Machine, code: str, checks: Sequence[Check], status: Sequence[str]) -> str:
    """A file, line by line: what has no nominal value or no limit has no line of it."""
    lines = head(m, code)
    for measure, *_ in checks:
        numbers = {
            "nominal": measure.nominal, "measured": measure.actual, "deviation": measure.actual - measure.nominal,
            "least": measure.lower, "greatest": measure.upper,
        }  # fmt: skip
        lines += [f"{measure.what} {key} = {value:.{DIGITS}f}" for key, value in numbers.items() if not math.isnan(value)]
    return "\n".join([*lines, f"status = {' '.join(status) or OK}", ""])

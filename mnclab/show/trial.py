"""A short program around one cycle, so that a form can show what the cycle does on its own.

How a cycle stands in a program is each control's way, so there is one function a control, in `PROGRAMS`. Values
to begin with are the examples of the declaration, or guessed from what a parameter means and allows; they are a start to
play from, not advice.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from mnclab.path.listing import figure

#: A piece of a meaning -> a first value, mm where it is a length; the first that fits and is allowed counts.
FIRST = (
    ("diameter of the finished", 30.0),
    ("end of the passes", -20.0),
    ("stock removed", 2.0),
    ("position along X", 20.0),
    ("position along Y", 10.0),
    ("along X", 20.0),
    ("along Y", 10.0),
    ("second set-up clearance", 20.0),
    ("2nd set-up clearance", 20.0),
    ("clearance", 2.0),
    ("peck", 5.0),
    ("infeed", 5.0),
    ("plunging depth", 5.0),
    ("depth", -20.0),
    ("depth", 20.0),
    ("surface", 0.0),
    ("level", 2.0),
    ("bottom", -20.0),
    ("", 0.0),
    ("", 5.0),
    ("", -5.0),
)
#: What may be left out, but is worth seeing at first.
WRITTEN = ("position along", "peck", "infeed")
BY_UNIT = {"mm/min": 120.0, "s": 0.0, "rev/min": 1000.0, "0.0001 mm/rev": 2000.0}
SCALE = {"0.01 mm": 100.0}


def number(value: float) -> str:
    """A number as programs write it: without exponent and trailing zeros."""
    return figure(value, 6)


def is_text(parameter: Any) -> bool:
    """Whether a parameter holds a text; a tool that may be named, too, is a number to begin with."""
    return parameter.type == "text" and not isinstance(parameter.default, int | float)


def first_value(parameter: Any) -> float | str:
    """A value to begin with: the example, the default, or a likely one that the limits of the parameter allow."""
    if is_text(parameter):
        return str(parameter.default or "ABC")
    if parameter.example is not None:
        return float(parameter.example)
    if parameter.default is not None and parameter.default != math.inf:  # rapid: no number that a box could show
        return float(parameter.default)
    if parameter.choices:
        return float(next(iter(parameter.choices)))
    meaning, scale = parameter.meaning.lower(), SCALE.get(parameter.unit, 1.0)
    likely = [BY_UNIT[parameter.unit]] if parameter.unit in BY_UNIT else []
    likely += [value * scale for piece, value in FIRST if piece.lower() in meaning]
    return next((value for value in likely if not parameter.refuses(value)), 0.0)


def written_first(parameter: Any) -> bool:
    """Whether a word that may be left out is written to begin with."""
    if parameter.example is not None:
        return not parameter.instead
    return any(piece in parameter.meaning.lower() for piece in WRITTEN)


def program(control: str, cycle: Any, values: Mapping[str, float | str]) -> str | None:
    """The text of a program that runs a cycle with some `values` (by parameter name); None if nobody knows how."""
    words = [(p.address, values[p.name]) for p in cycle.parameters() if p.name in values]
    return PROGRAMS[control](cycle, words) if control in PROGRAMS else None


def _mnc(cycle: Any, words: Sequence[tuple[str, Any]]) -> str:
    block = " ".join([cycle.code, *(address + number(value) for address, value in words)])
    if cycle.runs == "definition":  # milling
        return f"G17 G90 G54\nT1 S1000 M3\nG0 X20 Y10 Z20 F100\n{block}\n"
    call = "G80" if cycle.runs == "position" else "G0 X20 Y10 M99"
    return f"G17 G90 G54\nT2 S1000 M3\nG0 X0 Y0 Z20 F100\n{block}\n{call}\n"


def klartext(value: float | str) -> str:
    """A number with its sign, a text in quotes."""
    return f'"{value}"' if isinstance(value, str) else ("" if value < 0 else "+") + number(value)


def _tnc_620(cycle: Any, words: Sequence[tuple[str, Any]]) -> str | None:
    if not words or not all(address.startswith("Q") for address, _ in words):
        return None  # the old cycles stand in blocks of their own kind
    lines = [f"{cycle.code} {cycle.title.upper()}", *(f"  {address}={klartext(value)}" for address, value in words)]
    call = ["L X+20 Y+10 R0 FMAX M99"] if cycle.runs == "call" else []
    written = [address for address, _ in words]
    tool = 1 if "Q207" in written and "Q239" not in written else 2  # an end mill; for holes and their threads the drill
    start = ["BEGIN PGM TRIAL MM", f"TOOL CALL {tool} Z S1000", "L X+0 Y+0 Z+50 R0 FMAX M3"]
    if cycle.code in ("CYCL DEF 220", "CYCL DEF 221"):  # which run the cycle before them
        start += ["CYCL DEF 200 DRILLING", *"Q200=2 Q201=-15 Q206=120 Q202=5 Q210=0 Q203=0 Q204=20 Q211=0".split()]
    return "\n".join([*start, " ~\n".join(lines), *call, "END PGM TRIAL MM", ""])


def _nc_31(cycle: Any, words: Sequence[tuple[str, Any]]) -> str:
    marks = [address for address, value in words if address in "~@" and value]
    frames = [" ".join([cycle.code, *marks]), *(a + number(value) for a, value in words if a not in "~@")]
    return "\n".join(["S800", "M3", "F20", "X4000 ~ *", "Z200 ~", " *\n".join(frames), ""])


def _jnc_t01(cycle: Any, words: Sequence[tuple[str, Any]]) -> str:
    block = " ".join([cycle.code, *(address + number(value) for address, value in words)])
    x = 0 if cycle.code == "G73" else 40
    return f"G90 G94 F100\nT1 S800 M3\nG0 X{x} Z5\n{block}\n"


def _g43(cycle: Any, words: Sequence[tuple[str, Any]]) -> str:
    block = " ".join([cycle.code, *(address + number(value) for address, value in words)])
    return f"T2 M6\nG43 G0 X0 Y0 Z20 S1000 M3\n{block}\nG80\n"


PROGRAMS: dict[str, Callable[[Any, Sequence[tuple[str, Any]]], str | None]] = {
    "mnc": _mnc,
    "tnc-620": _tnc_620,
    "nc-31": _nc_31,
    "jnc-t01": _jnc_t01,
    "g43": _g43,
}

"""A short program around one cycle, so that a form can show what the cycle does on its own.

How a cycle stands in a program is each control's way: its `Control.trial`. Values to begin with are the examples of the
declaration, or guessed from what a parameter means and allows; they are a start to play from, not advice.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from mnclab.machine.control import Control
from mnclab.machine.cycle import Cycle, Parameter
from mnclab.machine.probe import Setter
from mnclab.machine.setup import MILLS, Setup
from mnclab.path.listing import figure
from mnclab.path.tool import Tool

TrialWords = Sequence[tuple[str, Any]]  # address and value

#: A piece of a meaning -> a first value, mm where it is a length; the first that fits and is allowed counts.
FIRST = (
    ("diameter of the finished", 30.0), ("end of the passes", -20.0), ("stock removed", 2.0),
    ("position along x", 20.0), ("position along y", 10.0), ("along x", 20.0), ("along y", 10.0),
    ("second set-up clearance", 20.0), ("2nd set-up clearance", 20.0), ("clearance", 2.0),
    ("peck", 5.0), ("infeed", 5.0), ("plunging depth", 5.0), ("depth", -20.0), ("depth", 20.0),
    ("surface", 0.0), ("level", 2.0), ("bottom", -20.0), ("", 0.0), ("", 5.0), ("", -5.0),
)  # fmt: skip
#: What may be left out, but is worth seeing at first.
WRITTEN = ("position along", "peck", "infeed")
BY_UNIT = {"mm/min": 120.0, "s": 0.0, "rev/min": 1000.0, "0.0001 mm/rev": 2000.0}
SCALE = {"0.01 mm": 100.0}


#: What cycles that set tools measure in a trial.
MEASURED = Tool(radius=8, length=100, number=7, name="cutter 16", teeth=4, kind="mill")


def at_setter(setter: Setter, **settings: Any) -> Setup:
    """The machine of trials: a tool setter on it, and a tool whose length is known."""
    return Setup(tools={**MILLS, MEASURED.number: MEASURED}, setter=setter, settings=settings)


def on_its_machine(cycle: type[Cycle], setup: Setup) -> Setup:
    """The setup with the rotary axes that a cycle needs, where it has none."""
    return replace(setup, kinematics=cycle.tried_on) if cycle.tried_on and setup.kinematics is None else setup


def number(value: float) -> str:
    """A number as programs write it: without exponent and trailing zeros."""
    return figure(value, 6)


def in_block(cycle: type[Cycle], words: TrialWords) -> str:
    """A block of the code of a cycle and its words."""
    return " ".join([cycle.code, *(address + number(value) for address, value in words)])


def is_text(parameter: Parameter) -> bool:
    """Whether a parameter holds a text; a tool that may be named, too, is a number to begin with."""
    first = parameter.default, parameter.example
    return parameter.type == "text" and not any(isinstance(value, int | float) for value in first)


def joined(several: Sequence[float | str]) -> str:
    """Several values in one text, letters with blanks between them, numbers with strokes: `X Y`, `1/2`."""
    numbers = [isinstance(one, int | float) for one in several]
    return ("/" if all(numbers) else " ").join(number(one) if isinstance(one, int | float) else one for one in several)


def parted(text: str, parameter: Parameter) -> tuple[float | str, ...] | str:
    """The several values of such a text; the text itself where it holds none."""
    parts = text.replace("/", " ").replace(",", " ").split()
    if is_text(parameter):
        return tuple(parts)
    return tuple(map(float, parts)) if all(part.isdecimal() for part in parts) else text


def first_value(parameter: Parameter) -> float | str:
    """A value to begin with: the example, the default, or a likely one that the limits of the parameter allow."""
    if isinstance(parameter.example, tuple):
        return joined(parameter.example)
    if is_text(parameter):
        return str(parameter.example or parameter.default or "ABC")
    if parameter.example is not None:
        return float(parameter.example)
    if parameter.default is not None and parameter.default != math.inf:  # rapid: no number that a box could show
        return float(parameter.default)
    if parameter.choices:
        return float(next(iter(parameter.choices)))
    meaning, scale = parameter.meaning.lower(), SCALE.get(parameter.unit, 1.0)
    likely = [BY_UNIT[parameter.unit]] if parameter.unit in BY_UNIT else []
    likely += [value * scale for piece, value in FIRST if piece in meaning]
    return next((value for value in likely if not parameter.refuses(value)), 0.0)


def written_first(parameter: Parameter) -> bool:
    """Whether a word that may be left out is written to begin with."""
    if parameter.example is not None:
        return not parameter.instead
    return any(piece in parameter.meaning.lower() for piece in WRITTEN)


def program(control: Control, cycle: type[Cycle], values: Mapping[str, float | str]) -> str | None:
    """The text of a program that runs a cycle with some `values` (by parameter name); None if nobody knows how."""
    words = [(p.address, values[p.name]) for p in cycle.parameters() if p.name in values]
    return control.trial(cycle, words) if control.trial else None

"""Boxes to type in: of a number, of a parameter of a cycle, and the tick of a word that may be left out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mnclab.machine import trial
from mnclab.machine.cycle import Parameter
from mnclab.machine.parameter_table import left_out
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown

EM = 0.58  # of the height of letters: how wide they are
NO_UNITS = ("choice", "count", "text")

Number = float | tuple[float, float, float]


def check_number_of_place(name: str, number: Any) -> None:
    """An Alarm unless a place has a number, or a number and its limits."""
    parts = number if isinstance(number, tuple) else (number,)
    if len(parts) not in (1, 3):
        raise Alarm(f"{name} takes a number, or (value, least, greatest), got {shown(number)}")
    for part in parts:
        check_number(part, name)
    if len(parts) == 3 and not parts[1] <= parts[0] <= parts[2]:
        raise Alarm(f"{name} must lie between its least and its greatest value, got {shown(number)}")


def looks_of(name: str, width: float, room: float = 8) -> dict[str, Any]:
    """How a box looks: its name `width` em wide, and so much room beside it."""
    widths = f"{width:.1f}em", f"{width + room:.1f}em"
    return {"description": name, "style": {"description_width": widths[0]}, "layout": {"width": widths[1]}}


def number_box(name: str, number: Number, width: float = 8) -> Any:
    """A box for a number or for (value, least, greatest); whole numbers stay whole."""
    value, *limits = number if isinstance(number, tuple) else (number,)
    return box_of(int if isinstance(value, int) else float, value, limits, looks_of(name, width))


def box_of(kind: type, value: Any, limits: Sequence[float], looks: Mapping[str, Any]) -> Any:
    """A box for whole or other numbers, between limits if there are any."""
    import ipywidgets

    whole = ipywidgets.IntText, ipywidgets.BoundedIntText
    free, bounded = whole if kind is int else (ipywidgets.FloatText, ipywidgets.BoundedFloatText)
    if not limits:
        return free(value=kind(value), **looks)
    return bounded(value=kind(value), min=kind(limits[0]), max=kind(limits[1]), **looks)


def name_of(p: Parameter) -> str:
    """What is written beside a box: `K depth of one peck [mm]`."""
    return f"{p.address} {p.meaning}" + (f" [{p.unit}]" if p.unit and p.unit not in NO_UNITS and not p.mark else "")


def parameter_box(p: Parameter, width: float) -> Any:
    """The box that fits the kind and limits of a parameter, its name `width` em wide; the tooltip says the rest."""
    import ipywidgets

    value = trial.first_value(p)
    otherwise = left_out(p)
    facts = [p.meaning, p.allowed, p.note, f"left out: {otherwise}" if otherwise else ""]
    looks = looks_of(name_of(p), width) | {"tooltip": "; ".join(fact for fact in facts if fact)}
    if trial.is_text(p) or p.several:
        return ipywidgets.Text(value=value, **looks)
    if p.choices:
        options = [(f"{choice:g} {meaning}", choice) for choice, meaning in p.choices.items()]
        wide = EM * max(len(name) for name, _ in options) + 3  # and the arrow
        return ipywidgets.Dropdown(options=options, value=value, **looks | looks_of(name_of(p), width, min(max(wide, 8), 14)))
    lowest = [limit for limit in (p.above, p.at_least) if limit is not None]
    highest = [limit for limit in (p.below, p.at_most) if limit is not None]
    limits = (max(lowest, default=-1e9), min(highest, default=1e9)) if lowest or highest else ()
    return box_of(int if p.type == "integer" else float, value, limits, looks)


def tick_of(p: Parameter, box: Any) -> Any:
    """The tick that writes a word which may be left out."""
    import ipywidgets

    written = trial.written_first(p)
    name = f"write {p.address}"
    tick = ipywidgets.Checkbox(written, description=name, indent=False, layout={"width": f"{EM * len(name) + 3:.1f}em"})
    box.disabled = not written
    tick.observe(lambda change: setattr(box, "disabled", not change["new"]), "value")
    return tick

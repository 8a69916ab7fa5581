"""Boxes to type in: of a number, of a parameter of a cycle, and the tick of a word that may be left out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from mnclab.machine import trial
from mnclab.machine.cycle import Parameter, left_out
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown

LONG = 50  # letters of a choice that have no room in a form in letters of the usual size
STEPS = 100  # of a slider that was given none
NO_UNITS = ("choice", "count", "text")
ORDERS = "(value, least, greatest) or (least, greatest, step)"

Number = float | tuple[float, float, float]


class Place(NamedTuple):
    """A number that may be changed: its first value, its limits and the step of its slider, where there are any."""

    value: float
    limits: tuple[float, float] | None = None
    step: float | None = None


def place_of(name: str, number: Any) -> Place:
    """A number, `(value, least, greatest)`, or `(least, greatest, step)`, which begins on a step in the middle.

    Which of the two orders is meant is never in doubt: the first of (40, 10, 60) lies between the others, that of
    (-10, -1, 0.5) does not.
    """
    parts = number if isinstance(number, tuple) else (number,)
    if len(parts) not in (1, 3):
        raise Alarm(f"{name} takes a number, {ORDERS}, got {shown(number)}")
    for part in parts:
        check_number(part, name)
    if len(parts) == 1:
        return Place(parts[0])
    first, second, third = parts
    if second <= first <= third:
        return Place(first, (second, third))
    if first < second and 0 < third <= second - first:
        return Place(on_step(first + (second - first) / 2, first, second, third), (first, second), third)
    hint = f"{name}=(5, 0, 10) is 5 between 0 and 10; {name}=(0, 10, 0.5) is 0 to 10 in steps of 0.5"
    raise Alarm(f"{name} must be {ORDERS}, and the value must lie between its limits, got {shown(number)}", hint=hint)


def on_step(value: float, least: float, greatest: float, step: float) -> float:
    """The nearest value that lies whole steps above the least one, not beyond the greatest, without a rest of digits."""
    steps = min(round((value - least) / step), int((greatest - least) / step + 1e-9))
    found = least + max(steps, 0) * step
    return found if isinstance(found, int) else round(found, 9)


def number_box(name: str, place: Place) -> Any:
    """A box for a number; whole numbers stay whole."""
    whole = all(isinstance(each, int) for each in (place.value, place.step or 0))
    looks = {"description": name} | ({} if place.step is None else {"step": place.step})
    return box_of(int if whole else float, place.value, place.limits or (), looks)


def slider_of(box: Any, place: Place) -> Any:
    """A slider for a box with limits, which follow each other.

    It has no name for a screen reader: the box has, and is the one that the keyboard goes to. A slider says
    10.000000000000002 for 10 when it appears; only another step than that of the box is a change.
    """
    import ipywidgets

    low, high = place.limits or (0.0, 1.0)
    whole = isinstance(box.value, int)
    step = place.step or (1 if whole else (high - low) / STEPS or 1.0)
    kind = ipywidgets.IntSlider if whole else ipywidgets.FloatSlider
    slider = kind(value=box.value, min=low, max=high, step=step, readout=False, tabbable=False)
    slider.add_class("mnclab-slider")

    def slid(change: Any) -> None:
        wanted = on_step(change["new"], low, high, step)
        if wanted != on_step(box.value, low, high, step):
            box.value = wanted

    slider.observe(slid, "value")
    box.observe(lambda change: setattr(slider, "value", change["new"]), "value")
    return slider


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


def parameter_box(p: Parameter) -> Any:
    """The box that fits the kind of a parameter; the tooltip says the rest.

    It takes any number: one outside the limits is not pushed back in silence but refused at its field.
    """
    import ipywidgets

    value = trial.first_value(p)
    otherwise = left_out(p)
    facts = [p.meaning, p.allowed, p.note, f"left out: {otherwise}" if otherwise else ""]
    looks = {"description": name_of(p), "tooltip": "; ".join(fact for fact in facts if fact)}
    if trial.is_text(p) or p.several:
        return ipywidgets.Text(value=value, **looks)
    if p.choices:
        options = [(f"{choice:g} {meaning}", choice) for choice, meaning in p.choices.items()]
        box = ipywidgets.Dropdown(options=options, value=value, **looks)
        if max(len(name) for name, _ in options) > LONG:
            box.add_class("mnclab-long")
        return box
    return box_of(int if p.type == "integer" else float, value, (), looks)


def tick_of(p: Parameter, box: Any) -> Any:
    """The tick that writes a word which may be left out; its name is heard, and seen where the mouse rests."""
    import ipywidgets

    written = trial.written_first(p)
    tick = ipywidgets.Checkbox(written, description=f"write {p.address}", indent=False, tooltip=f"write {p.address}")
    tick.add_class("mnclab-tick")
    box.disabled = not written
    tick.observe(lambda change: setattr(box, "disabled", not change["new"]), "value")
    return tick

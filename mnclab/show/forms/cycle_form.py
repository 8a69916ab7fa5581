"""The form of a cycle, from its declaration."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from html import escape
from math import inf
from typing import Any

from mnclab.controls.choice import help as help_on
from mnclab.controls.cycle_steps import steps
from mnclab.controls.trial_part import touched_part
from mnclab.machine import trial
from mnclab.machine.cycle import Cycle
from mnclab.machine.setup import Setup
from mnclab.machine.touching import FEELS, PROBES
from mnclab.show.forms.boxes import EM, name_of, parameter_box, tick_of
from mnclab.show.forms.following import following_program
from mnclab.text.alarm import Alarm
from mnclab.text.extras import require


def form(code: str, control: str) -> Any:
    """The parameters of a cycle as boxes, in the order of the manual, with a picture of the cycle run alone.

    A parameter that may be left out has a box to tick before its word is written. The result has `boxes` (by name of
    the parameter), `ticks`, `run`, the last run, and `steps()`, the steps of the cycle with these values as a table.
    """
    require("ipywidgets", "forms")
    import ipywidgets

    help_page = help_on(code, control)
    cycle = help_page.entry
    if not (isinstance(cycle, type) and issubclass(cycle, Cycle)):
        known = ", ".join(help_page.control.cycles)
        raise Alarm(f"{code} has no parameters to make a form of", hint=f"cycles of {control}: {known}")
    chosen: type[Cycle] = cycle
    boxes, ticks, rows = {}, {}, []
    longest = max((len(name_of(p)) for p in chosen.parameters()), default=0)
    for parameter in chosen.parameters():
        box = boxes[parameter.name] = parameter_box(parameter, min(32.0, EM * longest))
        if not parameter.required and parameter.default in (None, inf):
            ticks[parameter.name] = tick = tick_of(parameter, box)
            rows.append(ipywidgets.HBox([box, tick]))
        else:
            rows.append(box)

    def values() -> dict[str, Any]:
        return {name: box.value for name, box in boxes.items() if name not in ticks or ticks[name].value}

    def written() -> dict[str, Any]:
        several = {p.name: p for p in chosen.parameters() if p.several}
        return {n: trial.parted(v, several[n]) if n in several else v for n, v in values().items()}

    def text() -> str | None:
        defaults = {p.name: p.default for p in chosen.parameters() if not p.required}
        return trial.program(help_page.control, chosen, {n: v for n, v in values().items() if v != defaults.get(n)})

    title = ipywidgets.HTML(f"<strong><code>{escape(chosen.code)}</code> {escape(chosen.title)}</strong>")
    setup = replace(help_page.control.trial_setup or Setup(), files=help_page.control.trial_files)
    if help_page.control.lathe:
        setup = replace(setup, start=(30, 0, 20))  # clear of the chuck's axis

    def machine() -> Setup:
        """For a cycle that probes with something to touch."""
        with suppress(Alarm):
            if chosen.does in (PROBES, FEELS):
                found = steps(chosen.code, help_page.control.name, setup, **written())
                return replace(setup, part=touched_part(found, setup.probe.clearance))
        return setup

    live = following_program(boxes, [title, *rows], text, help_page.control.name, machine, "auto", ticks)
    live.ticks, live.steps = ticks, lambda: steps(chosen.code, help_page.control.name, setup, **written())
    return live

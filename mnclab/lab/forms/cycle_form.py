"""The form of a cycle, from its declaration: fields in groups that fold, beside them the picture and the steps.

While a field is typed into, a sketch shows what it measures and what is allowed. A cycle that probes and was given no
part touches a small pad at each nominal point.
"""

from __future__ import annotations

import operator
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import reduce
from html import escape
from math import inf
from typing import Any

import numpy as np

from mnclab.controls.choice import help as help_on
from mnclab.controls.choice import run as run_text
from mnclab.controls.cycle_steps import CycleSteps, steps
from mnclab.lab.forms.fields import Field, field_of, folded, grouped, groups, parameter_box, tick_of
from mnclab.lab.forms.live import NewPicture, following, of_run
from mnclab.lab.sketches import sketch
from mnclab.machine import trial
from mnclab.machine.cycle import Cycle, Parameter, left_out
from mnclab.machine.setup import Setup
from mnclab.machine.touching import FEELS, PROBES
from mnclab.machining.steps import Touch
from mnclab.text.alarm import Alarm
from mnclab.text.given import fitting, shown
from mnclab.text.opening import require
from mnclab.text.tables import html_table
from mnclab.workpiece.part import Part, box

SIZE = (4.9, 3.7)  # inches: beside the fields there is so much room in JupyterLab on a small laptop
MOST = 60  # steps of the table


@fitting
def form(code: str, control: str) -> Any:
    """The parameters of a cycle as boxes, in groups, with a picture and the steps of the cycle run alone.

    A parameter that may be left out has a box to tick before its word is written. The result has `boxes` (by name of
    the parameter), `ticks`, `run`, the last run, and `steps()`, the steps of the cycle with these values as a table.
    """
    require("ipywidgets", "forms")
    import ipywidgets

    help_page = help_on(code, control)
    cycle = help_page.entry
    if not (isinstance(cycle, type) and issubclass(cycle, Cycle)):
        known = ", ".join(help_page.control.cycles)
        raise Alarm(f"{shown(code)} has no parameters to make a form of", hint=f"cycles of {control}: {known}")
    chosen: type[Cycle] = cycle
    parameters = chosen.parameters()
    boxes, ticks, fields = {}, {}, {}
    for place, parameter in enumerate(parameters):
        box = boxes[parameter.name] = parameter_box(parameter)
        tick = None
        if not parameter.required and parameter.default in (None, inf):
            tick = ticks[parameter.name] = tick_of(parameter, box)
        fields[parameter.name] = Field(box, tick=tick, number=place, parameter=parameter)

    def values() -> dict[str, Any]:
        return {name: box.value for name, box in boxes.items() if name not in ticks or ticks[name].value}

    def written() -> dict[str, Any]:
        several = {p.name: p for p in parameters if p.several}
        return {n: trial.parted(v, several[n]) if n in several else v for n, v in values().items()}

    def text() -> str | None:
        defaults = {p.name: p.default for p in parameters if not p.required}
        return trial.program(help_page.control, chosen, {n: v for n, v in values().items() if v != defaults.get(n)})

    setup = replace(help_page.control.trial_setup or Setup(), files=help_page.control.trial_files)
    if help_page.control.lathe:
        setup = replace(setup, start=(30, 0, 20))  # clear of the chuck's axis
    name = help_page.control.name

    def found() -> CycleSteps:
        return steps(chosen.code, name, setup, **written())

    table, program = ipywidgets.HTML(), ipywidgets.HTML()
    table.add_class("mnclab-steps")

    def work(live: Any) -> NewPicture | None:
        source = text()
        if source is None:
            live.shown = f"<p>no picture yet: a program around this cycle of {escape(name)} is not built</p>"
            return None
        machine = setup
        if chosen.does in (PROBES, FEELS):  # something to touch
            with suppress(Alarm):
                machine = replace(setup, part=touched_part(found(), setup.probe.clearance))
        live.run = run = run_text(source, name, machine)

        def after() -> None:
            program.value = f"<pre>{escape(source)}</pre>"
            try:
                table.value = steps_html(found())
            except Alarm:
                table.value = "<p>its steps need a program, or other values</p>"

        return of_run(run, lambda **kept: run.plot(size=SIZE, **kept))._replace(after=after)

    card = ipywidgets.HTML(about(chosen, parameters))
    rows = ipywidgets.VBox(grouped(parameters, fields))
    rows.add_class("mnclab-fields")
    title = ipywidgets.HTML(f"<strong><code>{escape(chosen.code)}</code> {escape(chosen.title)}</strong>")
    live = following(
        boxes, fields, ipywidgets.VBox([rows, card]), work, lambda alarm: field_of(alarm, parameters, chosen.code),
        *ticks.values(), title=f"{chosen.code} {chosen.title}", classes="mnclab-form", above=[title],
        below=[*folded("Steps", table, opened=True), *folded("Program", program, opened=False)],
    )  # fmt: skip
    live.ticks, live.steps, live.program, live.steps_view = ticks, found, program, table
    return live


def steps_html(listed: CycleSteps) -> str:
    """The table of the steps of a cycle; of a long one the beginning."""
    cells, numbers = listed.cells(), range(2, len(listed.head) - 1)
    more = f"<p>… and {len(cells) - MOST} more; <code>form.steps()</code> has all of them</p>" if len(cells) > MOST else ""
    return html_table(listed.head, cells[:MOST], numbers=numbers) + more


# What a field is about: all cards are one widget; the style sheet shows the one whose field has the cursor or lies under the
# mouse.

def about(cycle: type[Cycle], parameters: Sequence[Parameter]) -> str:
    """The cards of all parameters and the rules that show one of them, the first where no field is meant."""
    shown = next(iter(groups(parameters).values()), [])[:1]
    cards = ""
    for k, p in enumerate(parameters):
        cards += f'<div class="mnclab-about mnclab-a{k}{" mnclab-shown" * (p in shown)}">{card(cycle, p)}</div>'
    rules = [".mnclab-form:not(:has(.mnclab-row:is(:focus-within, :hover))) .mnclab-shown"]
    for k in range(len(parameters)):
        rules += [
            f".mnclab-form:has(.mnclab-p{k}:focus-within) .mnclab-a{k}",
            f".mnclab-form:not(:has(.mnclab-row:focus-within)):has(.mnclab-p{k}:hover) .mnclab-a{k}",
        ]
    return f"<style>{', '.join(rules)} {{ display: flex }}</style>{cards}" if parameters else ""


def card(cycle: type[Cycle], p: Parameter) -> str:
    """The sketch of a parameter, its meaning, and what is said of it."""
    otherwise = left_out(p)
    facts = [p.allowed if not p.choices else "", p.note, f"left out: {otherwise}" if otherwise else ""]
    said = "<br>".join(escape(fact) for fact in facts if fact)
    return f"{sketch(cycle, p)}<p><strong>{escape(p.address)}</strong> {escape(p.meaning)}<br>{said}</p>"


# A part for a cycle that probes, where nobody gave one.

BALL = 2.0  # mm, the radius where a touch does not say it


def touched_part(found: CycleSteps, clearance: float) -> Part | None:
    """The pads before the touches of a cycle; `clearance` (mm) of the probe table, to which an own one of the cycle is added."""
    if found.part is not None:
        return found.part
    gap = clearance + (found.values.get("clearance") or 0.0)
    pads = list(_pads(found, gap))
    return reduce(operator.or_, pads) if pads else None


def _pads(found: CycleSteps, gap: float) -> Iterator[Part]:
    place = np.array(found.start)
    for row in found.rows:
        end = place if row.end is None else np.array(row.end)
        if isinstance(row.step, Touch) and (way := float(np.linalg.norm(end - place))) > 0:
            ball = row.step.ball or BALL
            ahead = (end - place) / way
            side = np.cross((0.0, 0.0, 1.0), ahead) if abs(ahead[2]) < 0.9 else np.cross(ahead, (1.0, 0.0, 0.0))
            side /= np.linalg.norm(side)
            frame = np.eye(4)
            frame[:3, :3] = np.column_stack([ahead, side, np.cross(ahead, side)])
            frame[:3, 3] = place + (0.0, 0.0, ball) + ahead * (ball + gap)
            yield box((0.0, -ball, -ball), (ball, ball, ball)).placed(frame)
        place = end

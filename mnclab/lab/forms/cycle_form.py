"""The form of a cycle, from its declaration: fields in groups that fold, beside them the picture and the steps.

What the field that is typed into measures lights up in the picture: a dimension with its value, or the moves that the value
acts in. The Lab extension says which field has the cursor; without it, the field that was changed last is meant.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from math import inf
from typing import Any

from mnclab.controls.choice import help as help_on
from mnclab.controls.cycle_steps import CycleSteps
from mnclab.lab.forms.dimension_lines import over, windows
from mnclab.lab.forms.example import Example
from mnclab.lab.forms.fields import Field, field_of, folded, grouped, groups, parameter_box, tick_of
from mnclab.lab.forms.live import DRAWING, NewPicture, following, of_run, value_of, widgets
from mnclab.lab.forms.measuring import Length
from mnclab.machine.cycle import Cycle, Parameter, left_out, limits
from mnclab.machine.terms import beside
from mnclab.machine.trial import number
from mnclab.text.alarm import Alarm
from mnclab.text.given import choice, fitting, shown
from mnclab.text.tables import html_table

SIZE = (4.9, 4.2)  # inches: beside the fields there is so much room in JupyterLab on a small laptop
LONG = 34  # letters of a choice in the picture


@fitting
def form(code: str, control: str) -> Any:
    """The parameters of a cycle as boxes, in groups, with a picture and the steps of the cycle run alone.

    A parameter that may be left out has a box to tick before its word is written. The result has `boxes` (by name of
    the parameter), `ticks`, `run`, the last run, `steps()`, the steps of the cycle with these values as a table, and
    `light(name)`, which shows in the picture what a parameter measures, as the cursor in its box does.

    >>> list(mnc.form("G83", "mnc").boxes)[-3:]
    ['peck_depth', 'dwell', 'feed']
    """
    ipywidgets = widgets("forms")
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

    example = Example(help_page.control, chosen)
    table, program, lit = ipywidgets.HTML(), ipywidgets.HTML(), ipywidgets.HTML()
    asked = ipywidgets.Text()  # the number of the field that has the cursor, or was changed last
    for part, name in ((table, "steps"), (lit, "lit"), (asked, "asked")):
        part.add_class(f"mnclab-{name}")

    def work(live: Any) -> NewPicture | None:
        now = values()
        live.run = run = example.run(now)
        if run is None:
            live.shown = f"<p>no picture yet: a program around this cycle of {escape(example.control.name)} is not built</p>"
            return None

        def after() -> None:
            program.value = f"<pre>{escape(run.program.text)}</pre>"
            try:
                table.value = steps_html(example.steps(now))
            except Alarm:
                told = "its steps need other values"
                if run.ok and len(run.toolpath):
                    told = f"what it does in the program below:</p>{steps_html(example.moves(run.toolpath, now))}"
                table.value = f"<p>{told}"

        drawn = of_run(run, lambda **kept: example.plot(run, now, size=SIZE, **kept))
        return drawn._replace(after=after, made=example.own(run.toolpath))

    card = ipywidgets.HTML(about(parameters))
    rows = ipywidgets.VBox(grouped(parameters, fields))
    rows.add_class("mnclab-fields")
    term = beside(example.control.term(chosen.code))
    title = ipywidgets.HTML(f"<strong><code>{escape(chosen.code)}</code> {escape(chosen.title)}</strong>{term}")
    live = following(
        boxes, fields, ipywidgets.VBox([rows, card]), work, lambda alarm: field_of(alarm, parameters, chosen.code),
        *ticks.values(), title=f"{chosen.code} {chosen.title}", classes="mnclab-form", above=[title], over=[lit, asked],
        below=[*folded("Steps", table, opened=True), *folded("Program", program, opened=False)],
    )  # fmt: skip

    def light(name: str) -> None:
        """Show in the picture what a parameter, by its name, measures."""
        place = [*boxes].index(choice(name, "a parameter", boxes))
        now, run = values(), live.run
        if run is None or not run.ok or name not in now or live.figure is None:
            lit.value = ""
            return
        p, path = parameters[place], example.own(run.toolpath)
        size = tuple(100 * side for side in live.figure.get_size_inches().tolist())
        found, text = example.measured(run, p, now), worth(p, boxes[name])
        if path.lathe and isinstance(found, Length) and abs(found.way[0]) == 1 and "diameter" not in p.unit:
            text += " radius"  # the axis beside it counts diameters
        lit.value = over(found, text, path, windows(live.figure), size)

    def turned_to(place: str) -> None:
        if place == asked.value and place.isdigit() and int(place) < len(parameters):
            light(parameters[int(place)].name)

    meant = ""  # the field that was changed last, where nobody says which one has the cursor

    def changed(place: int) -> None:
        nonlocal meant
        if asked.value == meant != str(place):
            meant = asked.value = str(place)
        else:
            DRAWING.submit(turned_to, asked.value)

    asked.observe(lambda change: DRAWING.submit(turned_to, change["new"]), "value")  # after the picture
    for place, name in enumerate(boxes):
        for each in filter(None, (boxes[name], ticks.get(name))):
            each.observe(lambda _, place=place: changed(place), "value")
    live.ticks, live.steps, live.program, live.steps_view = ticks, lambda: example.steps(values()), program, table
    live.light, live.lit, live.asked = light, lit, asked
    return live


def scheme(code: str, control: str, address: str) -> str:
    """The picture of a form as HTML, and over it what one parameter measures."""
    live = form(code, control)
    live.light(next(name for name, field in live.fields.items() if field.parameter.address == address))
    return f'<div style="position:relative">{live.picture.value}{live.lit.value}</div>'


def worth(p: Parameter, box: Any) -> str:
    """The address and the value of a parameter as a help picture writes them: `Q202 5 mm`."""
    value, unit = box.value, {"deg": "°", "count": "", "choice": "", "mark": ""}.get(p.unit, f" {p.unit}")
    if p.choices or not isinstance(value, int | float):
        said = value_of(box)
        return f"{p.address} {said if len(said) <= LONG else said[: LONG - 1] + '…'}"
    if p.unit[:1].isdigit():  # written in parts of a mm
        parts, name, *of = p.unit.split()
        value, unit = value * float(parts), f" {name}{' ⌀' * ('diameter' in of)}"
    return f"{p.address} {number(value)}{unit}".replace("-", "\N{MINUS SIGN}")


def steps_html(listed: CycleSteps) -> str:
    """The table of the steps of a cycle, all of them."""
    head, rows, numbers = listed.table()
    return html_table(head, rows, numbers=numbers)


# What a field is about: all cards are one widget; the style sheet shows the one whose field has the cursor or lies under the
# mouse.

def about(parameters: Sequence[Parameter]) -> str:
    """The cards of all parameters and the rules that show one of them, the first where no field is meant."""
    shown = next(iter(groups(parameters).values()), [])[:1]
    cards = ""
    for k, p in enumerate(parameters):
        cards += f'<div class="mnclab-about mnclab-a{k}{" mnclab-shown" * (p in shown)}">{card(p)}</div>'
    rules = [".mnclab-form:not(:has(.mnclab-row:is(:focus-within, :hover))) .mnclab-shown"]
    for k in range(len(parameters)):
        rules += [
            f".mnclab-form:has(.mnclab-p{k}:focus-within) .mnclab-a{k}",
            f".mnclab-form:not(:has(.mnclab-row:focus-within)):has(.mnclab-p{k}:hover) .mnclab-a{k}",
        ]
    return f"<style>{', '.join(rules)} {{ display: block }}</style>{cards}" if parameters else ""


def card(p: Parameter) -> str:
    """The meaning of a parameter, and what is said of it."""
    otherwise = left_out(p)
    facts = [limits(p) if not p.choices else "", p.note, f"left out: {otherwise}" if otherwise else ""]
    said = "<br>".join(escape(fact) for fact in facts if fact)
    return f"<p><strong>{escape(p.address)}</strong> {escape(p.meaning.removeprefix(f'{p.address} '))}<br>{said}</p>"

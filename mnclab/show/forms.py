"""Boxes for numbers, with a picture that follows: a form from the declaration of a cycle, a panel from a template.

Number boxes, not sliders: a slider has no name for a screen reader and fires a false change when it appears.
JupyterLab calls widgets from another thread than cells, so figures are drawn in **one** thread, `DRAWING`, and
without pyplot; nobody else starts threads. ipywidgets is imported inside the functions that use it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from difflib import get_close_matches
from html import escape
from math import inf
from typing import Any

import numpy as np

from mnclab.controls.choice import help as help_on
from mnclab.controls.choice import run as run_text
from mnclab.machine import trial
from mnclab.machine.cycle import Cycle, Parameter
from mnclab.machine.parameter_table import left_out
from mnclab.machine.setup import Setup
from mnclab.path.profile import Profile
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm, card_html
from mnclab.text.extras import require
from mnclab.text.given import check_number, shown

DRAWING = ThreadPoolExecutor(1, thread_name_prefix="drawing")
PLACE = re.compile(r"\{(\w+)\}")

Number = float | tuple[float, float, float]


def panel(
    template: str, control: str | None = None, /, *, setup: Setup | None = None, view: str = "auto", **numbers: Number
) -> Any:
    """Number boxes for the places `{name}` of a program, with picture and alarms that follow.

    `numbers` gives each place its first value, or `(value, least, greatest)`; a whole number stays whole. The
    result has `boxes` (by name) and `run`, the last run.
    """
    require("ipywidgets", "forms")
    if not isinstance(template, str):
        raise Alarm(
            f"a panel is made of the text of a program, got {shown(template)}", hint='panel("G0 X{x}\\n", "mnc", x=5)'
        )
    for name, number in numbers.items():
        _check_number(name, number)
    places = list(dict.fromkeys(PLACE.findall(template)))
    for one, other, what in ((places, numbers, "has no number"), (numbers, places, "has no place in the program")):
        for name in one:
            if name not in other:
                near = get_close_matches(name, list(other), 1)
                raise Alarm(f"{{{name}}} {what}", hint=f"near: {near[0]}" if near else f"write {{{name}}} and {name}=…")
    boxes = {name: _number_box(name.replace("_", " "), number) for name, number in numbers.items()}

    def text() -> str:
        return PLACE.sub(lambda place: trial.number(boxes[place[1]].value), template)

    return _live(boxes, list(boxes.values()), text, control, setup, view)


def compensation_panel(run: Run, **options: Any) -> Any:
    """A box for the tool radius and a choice for outside corners, with contour and tool-centre path that follow.

    `options` are those of `show.plot.compensation.compensation`. The result has `boxes` ("radius", and
    "corners" where the control has a choice) and `run`, the last run.
    """
    require("ipywidgets", "forms")
    import ipywidgets

    used = abs(run.programmed.radius[run.programmed.side != 0])
    boxes = {"radius": _number_box("tool radius [mm]", (float(used.max()) if len(used) else 5.0, 0.01, 1e4))}
    corners = next((one for one in run.control.settings if one.name == "outside_corners"), None)
    if corners:
        choices = [(f"{name}: {meaning.split(',')[0]}", name) for name, meaning in corners.choices.items()]
        looks = {"style": {"description_width": "8em"}, "layout": {"width": "26em"}}
        first = run.settings["outside_corners"]
        boxes["corners"] = ipywidgets.Dropdown(options=choices, value=first, description="outside corners", **looks)
    picture, alarms = _html(), _html()
    live: Any = ipywidgets.VBox([_row(*boxes.values()), picture, alarms])

    def redraw(_: Any = None) -> None:
        setup = run.setup.with_radius(boxes["radius"].value)
        if corners:
            setup = setup.with_settings(outside_corners=boxes["corners"].value)
        live.run = run.again(setup)
        picture.value = DRAWING.submit(_compensation, live.run, options).result()
        alarms.value = verdict(live.run)

    live.boxes, live.picture, live.alarms, live.run = boxes, picture, alarms, run
    redraw()
    for box in boxes.values():
        box.observe(redraw, "value")
    return live


def form(code: str, control: str) -> Any:
    """The parameters of a cycle as boxes, in the order of the manual, with a picture of the cycle run alone.

    A parameter that may be left out has a box to tick before its word is written. The result has `boxes` (by name of
    the parameter), `ticks` and `run`, the last run.
    """
    require("ipywidgets", "forms")
    help_page = help_on(code, control)
    cycle = help_page.entry
    if not (isinstance(cycle, type) and issubclass(cycle, Cycle)):
        known = ", ".join(help_page.control.cycles)
        raise Alarm(f"{code} has no parameters to make a form of", hint=f"cycles of {control}: {known}")
    chosen: type[Cycle] = cycle
    boxes, ticks, rows = {}, {}, []
    longest = max((len(_name(p)) for p in chosen.parameters()), default=0)
    for parameter in chosen.parameters():
        box = boxes[parameter.name] = _parameter_box(parameter, min(32.0, 0.58 * longest))
        if not parameter.required and parameter.default in (None, inf):
            ticks[parameter.name] = tick = _tick(parameter, box)
            rows.append(_row(box, tick))
        else:
            rows.append(box)

    def text() -> str | None:
        values = {name: box.value for name, box in boxes.items() if name not in ticks or ticks[name].value}
        defaults = {p.name: p.default for p in chosen.parameters() if not p.required}
        return trial.program(help_page.control, chosen, {n: v for n, v in values.items() if v != defaults.get(n)})

    title = _html(f"<strong><code>{escape(chosen.code)}</code> {escape(chosen.title)}</strong>")
    setup = Setup(start=(30, 0, 20)) if help_page.control.lathe else None  # clear of the chuck's axis
    live = _live(boxes, [title, *rows], text, help_page.control.name, setup, "auto", also=ticks, listed=True)
    live.ticks = ticks
    return live


def profile_panel(profile: Profile, **options: Any) -> Any:
    """Number boxes for the limits of a machine, with the profile and its times following.

    A jerk of 0 means no limit. `options` are those of `show.plot.profile.plot_profile`. The result has
    `boxes` (by name) and `profile`, the last one planned.
    """
    require("ipywidgets", "forms")
    import ipywidgets

    limits = profile.limits
    units = {"acceleration": "mm/s²", "jerk": "mm/s³", "corner_tolerance": "mm", "override": "%"}
    first = {name: float(np.min(getattr(limits, name, None) or 0.0)) for name in units} | {
        "override": 100 * profile.override
    }
    boxes = {name: _number_box(f"{name.replace('_', ' ')} [{units[name]}]", value) for name, value in first.items()}
    for box in boxes.values():
        box.style, box.layout = {"description_width": "13em"}, {"width": "21em"}
    picture, alarms = _html(), _html()
    live: Any = ipywidgets.VBox([ipywidgets.VBox(list(boxes.values())), picture, alarms])

    def redraw(_: Any = None) -> None:
        wanted = {name: box.value for name, box in boxes.items()}
        part = wanted.pop("override") / 100
        try:
            live.profile = profile.again(replace(limits, **wanted | {"jerk": wanted["jerk"] or None}), part)
        except Alarm as alarm:
            alarms.value = alarm._repr_html_()
            return
        picture.value = DRAWING.submit(lambda: live.profile.plot(**options).html()).result()
        alarms.value = f'<div role="status">{live.profile._repr_html_()}</div>'

    live.boxes, live.picture, live.alarms, live.profile = boxes, picture, alarms, profile
    redraw()
    for box in boxes.values():
        box.observe(redraw, "value")
    return live


# --- boxes -----------------------------------------------------------------------------------------------------------


def _check_number(name: str, number: Any) -> None:
    """An Alarm unless a place has a number, or a number and its limits."""
    parts = number if isinstance(number, tuple) else (number,)
    if len(parts) not in (1, 3):
        raise Alarm(f"{name} takes a number, or (value, least, greatest), got {shown(number)}")
    for part in parts:
        check_number(part, name)
    if len(parts) == 3 and not parts[1] <= parts[0] <= parts[2]:
        raise Alarm(f"{name} must lie between its least and its greatest value, got {shown(number)}")


def _number_box(name: str, number: Number) -> Any:
    """A box for a number or for (value, least, greatest); whole numbers stay whole."""
    import ipywidgets

    value, *limits = number if isinstance(number, tuple) else (number,)
    looks: dict[str, Any] = {"description": name, "style": {"description_width": "8em"}, "layout": {"width": "16em"}}
    if isinstance(value, int):
        looks["value"], kinds = int(value), (ipywidgets.IntText, ipywidgets.BoundedIntText)
    else:
        looks["value"], kinds = float(value), (ipywidgets.FloatText, ipywidgets.BoundedFloatText)
    return kinds[1](min=limits[0], max=limits[1], **looks) if limits else kinds[0](**looks)


def _name(p: Parameter) -> str:
    """What is written beside a box: `K depth of one peck [mm]`."""
    return f"{p.address} {p.meaning}" + (f" [{p.unit}]" if p.unit and p.unit != "choice" and not p.mark else "")


def _parameter_box(p: Parameter, width: float) -> Any:
    """The box that fits the kind and limits of a parameter, its name `width` em wide; the tooltip says the rest."""
    import ipywidgets

    value = trial.first_value(p)
    otherwise = left_out(p)
    facts = [p.meaning, p.allowed, p.note, f"left out: {otherwise}" if otherwise else ""]
    looks: dict[str, Any] = {
        "description": _name(p),
        "tooltip": "; ".join(fact for fact in facts if fact),
        "style": {"description_width": f"{width:.1f}em"},
        "layout": {"width": f"{width + 8:.1f}em"},
    }
    if trial.is_text(p):
        return ipywidgets.Text(value=value, **looks)
    if p.choices:
        options = [(f"{choice:g} {meaning}", choice) for choice, meaning in p.choices.items()]
        return ipywidgets.Dropdown(options=options, value=value, **looks)
    lowest = [limit for limit in (p.above, p.at_least) if limit is not None]
    highest = [limit for limit in (p.below, p.at_most) if limit is not None]
    limits = {"min": max(lowest, default=-1e9), "max": min(highest, default=1e9)} if lowest or highest else {}
    if p.type == "integer":
        whole = {name: int(limit) for name, limit in limits.items()}
        kind = ipywidgets.BoundedIntText if limits else ipywidgets.IntText
        return kind(value=int(value), **whole, **looks)
    kind = ipywidgets.BoundedFloatText if limits else ipywidgets.FloatText
    return kind(value=value, **limits, **looks)


def _tick(p: Parameter, box: Any) -> Any:
    """The tick that writes a word which may be left out."""
    import ipywidgets

    written = trial.written_first(p)
    tick = ipywidgets.Checkbox(written, description=f"write {p.address}", indent=False, layout={"width": "6em"})
    box.disabled = not written
    tick.observe(lambda change: setattr(box, "disabled", not change["new"]), "value")
    return tick


def _row(*widgets: Any) -> Any:
    import ipywidgets

    return ipywidgets.HBox(widgets)


def _html(text: str = "") -> Any:
    import ipywidgets

    return ipywidgets.HTML(text)


# --- what follows the boxes ------------------------------------------------------------------------------------------


def _live(
    boxes: Mapping[str, Any],
    rows: list[Any],
    text: Callable[[], str | None],
    control: str | None,
    setup: Setup | None,
    view: str,
    *,
    also: Mapping[str, Any] | None = None,
    listed: bool = False,
) -> Any:
    """Rows of boxes on the left, the picture on the right, the program (if `listed`) and alarms below."""
    import ipywidgets

    picture, program, alarms = _html(), _html(), _html()
    left = ipywidgets.VBox([*rows, program] if listed else rows)
    live: Any = ipywidgets.VBox([ipywidgets.HBox([left, picture], layout={"flex_flow": "row wrap"}), alarms])

    def redraw(_: Any = None) -> None:
        source = text()
        if source is None:
            picture.value = f"<p>no picture yet: a program around this cycle of {escape(str(control))} is not built</p>"
            return
        program.value = f"<pre>{escape(source)}</pre>"
        try:
            live.run = run_text(source, control, setup)
        except Alarm as alarm:
            alarms.value = alarm._repr_html_()
            return
        picture.value = DRAWING.submit(picture_of, live.run, view).result()
        alarms.value = verdict(live.run)

    live.boxes, live.picture, live.alarms, live.run = dict(boxes), picture, alarms, None
    redraw()
    for box in (*boxes.values(), *(also or {}).values()):
        box.observe(redraw, "value")
    return live


def picture_of(run: Run, view: str) -> str:
    """The views of a run as an HTML image with a name; to be drawn in `DRAWING`."""
    from mnclab.show.plot.path import image

    return image(run, view)


def _compensation(run: Run, options: Mapping[str, Any]) -> str:
    from mnclab.show.plot.compensation import image

    return image(run, **options)


def verdict(run: Run) -> str:
    """The alarms of a run, each with its line and caret, and its figures in one line."""
    s = run.summary()
    figures = (
        f"cutting {s['cutting length']:.3f} mm, rapid {s['rapid length']:.3f} mm, {s['time at feed']:.1f} s at feed"
    )
    alarms = card_html(run.alarms)
    return f'<div role="status">{"" if alarms else "no alarms; "}{figures}</div>{alarms}'

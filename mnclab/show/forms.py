"""Boxes for numbers, with a picture that follows: a form from the declaration of a cycle, a panel from a template.

Number boxes, not sliders: a slider has no name for a screen reader and fires a false change when it appears.
JupyterLab calls widgets from another thread than cells, so figures are drawn in **one** thread, `DRAWING`, and
without pyplot; nobody else starts threads. ipywidgets is imported inside the functions that use it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from difflib import get_close_matches
from html import escape
from math import inf
from typing import Any

import numpy as np

from mnclab.controls.choice import help as help_on
from mnclab.controls.choice import run as run_text
from mnclab.controls.cycle_steps import steps
from mnclab.controls.trial_part import touched_part
from mnclab.machine import trial
from mnclab.machine.cycle import Cycle, Parameter
from mnclab.machine.parameter_table import left_out
from mnclab.machine.setup import Setup
from mnclab.machine.touching import FEELS, PROBES
from mnclab.path.profile import Profile
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm, card_html
from mnclab.text.extras import require
from mnclab.text.given import check_number, shown

DRAWING = ThreadPoolExecutor(1, thread_name_prefix="drawing")
PLACE = re.compile(r"\{(\w+)\}")
SIZE = (6.4, 4.4)  # inches, of a picture beside boxes
EM = 0.58  # of the height of letters: how wide they are
NO_UNITS = ("choice", "count", "text")

Number = float | tuple[float, float, float]
Work = tuple[Callable[[], Any], str]  # what draws the picture, and what is said below it


def panel(
    template: str, control: str | None = None, /, *, setup: Setup | None = None, view: str = "auto", **numbers: Number
) -> Any:
    """Number boxes for the places `{name}` of a program, with picture and alarms that follow.

    `numbers` gives each place its first value, or `(value, least, greatest)`; a whole number stays whole. The
    result has `boxes` (by name) and `run`, the last run.
    """
    require("ipywidgets", "forms")
    if not isinstance(template, str):
        hint = 'panel("G0 X{x}\\n", "mnc", x=5)'
        raise Alarm(f"a panel is made of the text of a program, got {shown(template)}", hint=hint)
    for name, number in numbers.items():
        _check_number(name, number)
    places = list(dict.fromkeys(PLACE.findall(template)))
    for one, other, what in ((places, numbers, "has no number"), (numbers, places, "has no place in the program")):
        for name in (name for name in one if name not in other):
            near = get_close_matches(name, list(other), 1)
            raise Alarm(f"{{{name}}} {what}", hint=f"near: {near[0]}" if near else f"write {{{name}}} and {name}=…")
    boxes = {name: _number_box(name.replace("_", " "), number) for name, number in numbers.items()}

    def text() -> str:
        return PLACE.sub(lambda place: trial.number(boxes[place[1]].value), template)

    return _program(boxes, list(boxes.values()), text, control, lambda: setup, view)


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
        first, looks = run.settings["outside_corners"], _looks("outside corners", 8, 18)
        boxes["corners"] = ipywidgets.Dropdown(options=choices, value=first, **looks)

    def work(live: Any) -> Work:
        setup = run.setup.with_radius(boxes["radius"].value)
        if corners:
            setup = setup.with_settings(outside_corners=boxes["corners"].value)
        live.run = again = run.again(setup)
        return lambda: again.plot_compensation(size=(6.4, 5.2), **options), verdict(again)

    return _following(boxes, ipywidgets.HBox([*boxes.values()]), work)


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
    longest = max((len(_name(p)) for p in chosen.parameters()), default=0)
    for parameter in chosen.parameters():
        box = boxes[parameter.name] = _parameter_box(parameter, min(32.0, EM * longest))
        if not parameter.required and parameter.default in (None, inf):
            ticks[parameter.name] = tick = _tick(parameter, box)
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

    live = _program(boxes, [title, *rows], text, help_page.control.name, machine, "auto", ticks)
    live.ticks, live.steps = ticks, lambda: steps(chosen.code, help_page.control.name, setup, **written())
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
    first = {name: float(np.min(getattr(limits, name, None) or 0.0)) for name in units}
    first["override"] = 100 * profile.override
    names = {name: f"{name.replace('_', ' ')} [{unit}]" for name, unit in units.items()}
    boxes = {name: _number_box(names[name], value, 13) for name, value in first.items()}

    def work(live: Any) -> Work:
        wanted = {name: box.value for name, box in boxes.items()}
        part = wanted.pop("override") / 100
        live.profile = again = profile.again(replace(limits, **wanted | {"jerk": wanted["jerk"] or None}), part)
        return lambda: again.plot(**options), f'<div role="status">{again._repr_html_()}</div>'

    return _following(boxes, ipywidgets.VBox([*boxes.values()]), work)


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


def _looks(name: str, width: float, room: float = 8) -> dict[str, Any]:
    """How a box looks: its name `width` em wide, and so much room beside it."""
    widths = f"{width:.1f}em", f"{width + room:.1f}em"
    return {"description": name, "style": {"description_width": widths[0]}, "layout": {"width": widths[1]}}


def _number_box(name: str, number: Number, width: float = 8) -> Any:
    """A box for a number or for (value, least, greatest); whole numbers stay whole."""
    value, *limits = number if isinstance(number, tuple) else (number,)
    return _box_of(int if isinstance(value, int) else float, value, limits, _looks(name, width))


def _box_of(kind: type, value: Any, limits: Sequence[float], looks: Mapping[str, Any]) -> Any:
    """A box for whole or other numbers, between limits if there are any."""
    import ipywidgets

    whole = ipywidgets.IntText, ipywidgets.BoundedIntText
    free, bounded = whole if kind is int else (ipywidgets.FloatText, ipywidgets.BoundedFloatText)
    if not limits:
        return free(value=kind(value), **looks)
    return bounded(value=kind(value), min=kind(limits[0]), max=kind(limits[1]), **looks)


def _name(p: Parameter) -> str:
    """What is written beside a box: `K depth of one peck [mm]`."""
    return f"{p.address} {p.meaning}" + (f" [{p.unit}]" if p.unit and p.unit not in NO_UNITS and not p.mark else "")


def _parameter_box(p: Parameter, width: float) -> Any:
    """The box that fits the kind and limits of a parameter, its name `width` em wide; the tooltip says the rest."""
    import ipywidgets

    value = trial.first_value(p)
    otherwise = left_out(p)
    facts = [p.meaning, p.allowed, p.note, f"left out: {otherwise}" if otherwise else ""]
    looks = _looks(_name(p), width) | {"tooltip": "; ".join(fact for fact in facts if fact)}
    if trial.is_text(p) or p.several:
        return ipywidgets.Text(value=value, **looks)
    if p.choices:
        options = [(f"{choice:g} {meaning}", choice) for choice, meaning in p.choices.items()]
        wide = EM * max(len(name) for name, _ in options) + 3  # and the arrow
        return ipywidgets.Dropdown(options=options, value=value, **looks | _looks(_name(p), width, min(max(wide, 8), 14)))
    lowest = [limit for limit in (p.above, p.at_least) if limit is not None]
    highest = [limit for limit in (p.below, p.at_most) if limit is not None]
    limits = (max(lowest, default=-1e9), min(highest, default=1e9)) if lowest or highest else ()
    return _box_of(int if p.type == "integer" else float, value, limits, looks)


def _tick(p: Parameter, box: Any) -> Any:
    """The tick that writes a word which may be left out."""
    import ipywidgets

    written = trial.written_first(p)
    name = f"write {p.address}"
    tick = ipywidgets.Checkbox(written, description=name, indent=False, layout={"width": f"{EM * len(name) + 3:.1f}em"})
    box.disabled = not written
    tick.observe(lambda change: setattr(box, "disabled", not change["new"]), "value")
    return tick


# --- what follows the boxes ------------------------------------------------------------------------------------------


def _following(
    boxes: dict[str, Any], rows: Any, work: Callable[[Any], Work | None], *also: Any, beside: bool = False
) -> Any:
    """Rows of boxes, with a picture and alarms below or beside them; `work` is done when a box, or one `also`, changes."""
    import ipywidgets

    picture, alarms = ipywidgets.HTML(), ipywidgets.HTML()
    live: Any = ipywidgets.VBox([rows, picture, alarms])
    if beside:
        right = ipywidgets.VBox([picture, alarms], layout={"flex": "1 1 460px"})  # at least so wide, or it goes below
        live = ipywidgets.VBox([ipywidgets.HBox([rows, right], layout={"flex_flow": "row wrap"})])
    live.boxes, live.picture, live.alarms, live.run = boxes, picture, alarms, None

    def changed(_: Any = None) -> None:
        try:
            done = work(live)
        except Alarm as alarm:
            alarms.value = alarm._repr_html_()
            return
        if done is not None:
            draw, said = done
            picture.value = DRAWING.submit(lambda: draw().html()).result()
            alarms.value = said

    changed()
    for box in (*boxes.values(), *also):
        box.observe(changed, "value")
    return live


def _program(
    boxes: dict[str, Any], rows: list[Any], text: Callable[[], str | None], control: str | None,
    setup: Callable[[], Setup | None], view: str, ticks: Mapping[str, Any] | None = None,
) -> Any:  # fmt: skip
    """Boxes with the picture of a program beside them; those of a form have `ticks`, and the program below."""
    import ipywidgets

    program = ipywidgets.HTML()

    def work(live: Any) -> Work | None:
        source = text()
        if source is None:
            what = f"a program around this cycle of {escape(str(control))} is not built"
            live.picture.value = f"<p>no picture yet: {what}</p>"
            return None
        program.value = f"<pre>{escape(source)}</pre>"
        live.run = run = run_text(source, control, setup())
        return lambda: run.plot(view=view, size=SIZE), verdict(run)

    left = ipywidgets.VBox(rows if ticks is None else [*rows, program])
    return _following(boxes, left, work, *(ticks or {}).values(), beside=True)


def verdict(run: Run) -> str:
    """The alarms of a run, each with its line and caret, and its figures in one line."""
    s = run.summary()
    lengths = f"cutting {s['cutting length']:.3f} mm, rapid {s['rapid length']:.3f} mm"
    figures = f"{lengths}, {s['time at feed']:.1f} s at feed"
    alarms = card_html(run.alarms)
    return f'<div role="status">{"" if alarms else "no alarms; "}{figures}</div>{alarms}'

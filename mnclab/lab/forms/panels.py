"""Panels: number boxes for the places of a program, or for what a run was made with, and a picture that follows."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, Unpack

import numpy as np

from mnclab.controls.choice import choose
from mnclab.controls.choice import run as run_text
from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.lab.forms.fields import ORDERS, Field, Number, NumberField, number_box, place_of, slider_of
from mnclab.lab.forms.live import SIZE, NewPicture, cell, following, of_run, widgets
from mnclab.machine import trial
from mnclab.machine.setup import Setup
from mnclab.machining.milling.strategies import STRATEGIES
from mnclab.path.profile import Profile
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm, hint
from mnclab.text.given import CompensationOptions, ProfileOptions, check_number, choice, fitting, shown

PLACE = re.compile(r"\{(\w+)\}")


@fitting
def panel(
    template: str | Callable[..., str], control: str | None = None, /, *, setup: Setup | None = None, view: str = "auto",
    sliders: bool = False, **numbers: Number,
) -> Any:  # fmt: skip
    """Number boxes for the places `{name}` of a program, with picture and alarms that follow.

    `numbers` says for each place what it begins with:

    - `side=40.0`: a number; a whole number (`side=40`) stays whole.
    - `side=(40, 10, 60)`: value, least, greatest.
    - `side=(10, 60)`: least, greatest; it begins in the middle.
    - `depth=(-10, -1, 0.5)`: least, greatest, step; it begins on a step in the middle. This order is taken where the first
      number does not lie between the other two.

    `sliders=True` puts a slider beside each box that has limits. In place of a text with `{name}` a function may be
    given that makes the text from the numbers: `panel(lambda side: f"G0 X{side}", "mnc", side=40)`. The picture keeps
    its axes while a number is changed, and shows in grey where the path went before. `view` and `setup` are those of
    `Run.plot` and `run`. The result has `boxes` (by name) and `run`, the last run.

    >>> mnc.panel("S800 M3\\nG1 X{side} F100\\n", "mnc", side=40).run.toolpath.length
    40.0
    """
    widgets("forms")
    if not (isinstance(template, str) or callable(template)):
        wanted = "a panel is made of the text of a program, or of a function that makes it"
        raise Alarm(f"{wanted}, got {shown(template)}", hint='panel("G0 X{x}\\n", "mnc", x=5)')
    if control is not None:
        choose(control, "", "")
    if not isinstance(sliders, bool):
        raise Alarm(f"sliders must be True or False, got {shown(sliders)}")
    places = {name: place_of(name, number) for name, number in numbers.items()}
    check_names(template, numbers)
    if sliders and places and not any(place.limits for place in places.values()):
        raise Alarm(f"a slider needs limits: write {next(iter(places))}={ORDERS}")
    boxes = {name: number_box(name.replace("_", " "), place) for name, place in places.items()}
    fields = {}
    for name, box in boxes.items():
        beside = [slider_of(box, places[name])] if sliders and places[name].limits else []
        fields[name] = Field(box, *beside)
    written: list[tuple[str, str]] = []  # the text in pieces, and the place that each piece fills

    def work(live: Any) -> NewPicture:
        written[:] = pieces(template, {name: box.value for name, box in boxes.items()})
        live.run = run = run_text("".join(text for text, _ in written), control, setup)
        return of_run(run, lambda **kept: run.plot(view=view, size=SIZE, **kept))

    def field_of(alarm: Alarm) -> str:
        return place_at(alarm, written)

    return following(boxes, fields, None, work, field_of, title="panel", classes="mnclab-panel")


def check_names(template: str | Callable[..., str], numbers: Mapping[str, Any]) -> None:
    """An Alarm unless every place of a template has a number and every number a place."""
    if isinstance(template, str):
        places, needed = dict.fromkeys(PLACE.findall(template)), None
    else:
        try:
            asked = inspect.signature(template).parameters.values()
        except (TypeError, ValueError):  # of a function that is not written in Python
            return
        if any(p.kind is p.VAR_KEYWORD for p in asked):
            return
        places = {p.name: None for p in asked}
        needed = {p.name for p in asked if p.default is p.empty}
    for name in places:
        if name not in numbers and (needed is None or name in needed):
            raise Alarm(f"{{{name}}} has no number", hint=hint(name, numbers) or f"write {name}=…")
    for name in numbers:
        if name not in places:
            raise Alarm(f"{{{name}}} has no place in the program", hint=hint(name, places) or f"write {{{name}}}")


def pieces(template: str | Callable[..., str], values: Mapping[str, float]) -> list[tuple[str, str]]:
    """The text of a program in pieces, each with the name of the place that it fills, empty between places."""
    if isinstance(template, str):
        parts = PLACE.split(template)  # text, name, text, name, … text
        return [(trial.number(values[part]), part) if k % 2 else (part, "") for k, part in enumerate(parts)]
    try:
        text = template(**values)
    except Alarm:
        raise
    except Exception as error:  # of the user's own function
        raise Alarm(f"the function of the panel failed: {type(error).__name__}: {error}") from None
    if not isinstance(text, str):
        raise Alarm(f"the function of a panel must return the text of a program, got {shown(text)}")
    return [(text, "")]


def place_at(alarm: Alarm, written: list[tuple[str, str]]) -> str:
    """The place in the word that an alarm points at; empty where there is none."""
    if alarm.span is None or alarm.span.program:
        return ""
    text = "".join(piece for piece, _ in written)
    lines = text.splitlines(keepends=True)
    begin = sum(map(len, lines[: alarm.span.line - 1])) + alarm.span.column - 1
    end, at = begin + max(alarm.span.length, 1), 0
    for piece, name in written:
        if name and at < end and at + len(piece) > begin:
            return name
        at += len(piece)
    return ""


# Boxes for what a run was made with: the tool radius of a compensated one, the limits of the machine of a profile.

LIMITS = {"acceleration": "mm/s²", "jerk": "mm/s³", "corner_tolerance": "mm"}
SIZE_BELOW = (6.4, 4.9)  # inches, below a row of boxes


@fitting
def compensation_panel(run: Run, **options: Unpack[CompensationOptions]) -> Any:
    """A box for the tool radius and a choice for outside corners, with contour and tool-centre path that follow.

    `options` are those of `show.plot.compensation.compensation`. The result has `boxes` ("radius", and
    "corners" where the control has a choice) and `run`, the last run.

    >>> run = mnc.run("T1 S800 M3\\nG1 G41 X60 F300\\nY30\\n", "mnc")
    >>> list(mnc.compensation_panel(run).boxes)
    ['radius', 'corners']
    """
    if not isinstance(run, Run):
        raise Alarm(f"a run is compensated, got {shown(run)}", hint='compensation_panel(mnclab.run("part.mnc"))')
    ipywidgets = widgets("forms")

    from mnclab.show.plot.compensation import compensation

    refuse_unknown(options, compensation)
    used = abs(run.programmed.radius[run.programmed.side != 0])
    boxes = {"radius": number_box("tool radius [mm]", NumberField(float(used.max()) if len(used) else 5.0, (0.01, 1e4)))}
    corners = next((one for one in run.control.settings if one.name == "outside_corners"), None)
    if corners:
        choices = [(f"{name}: {meaning.split(',')[0]}", name) for name, meaning in corners.choices.items()]
        first = run.settings["outside_corners"]
        boxes["corners"] = ipywidgets.Dropdown(options=choices, value=first, description="outside corners")
    fields = {name: Field(box) for name, box in boxes.items()}

    def work(live: Any) -> NewPicture:
        setup = run.setup.with_radius(boxes["radius"].value)
        if corners:
            setup = setup.with_settings(outside_corners=boxes["corners"].value)
        live.run = again = run.again(setup)
        plot: Callable[..., Any] = again.plot_compensation
        work = of_run(again, lambda **kept: plot(**{"size": SIZE_BELOW, **kept, **options}))
        return work._replace(shows=True)  # hatched, where the tool does not fit

    def field_of(alarm: Alarm) -> str:
        return "radius" if "radius" in alarm.message else ""

    rows = ipywidgets.HBox([field.row for field in fields.values()])
    return following(boxes, fields, rows, work, field_of, title="radius compensation", classes="mnclab-across")


@fitting
def profile_panel(profile: Profile | Run, **options: Unpack[ProfileOptions]) -> Any:
    """Number boxes for the limits of a machine, with the profile (that of a run too) and its times following.

    A box has the least of the limits of all axes and, once it was changed, counts for all of them; a jerk of 0 means no
    limit. `options` are those of `show.plot.profile.plot_profile`. The result has
    `boxes` (by name) and `profile`, the last one planned.

    >>> list(mnc.profile_panel(mnc.run("S800 M3\\nG1 X60 F3600\\n", "mnc")).boxes)
    ['acceleration', 'jerk', 'corner_tolerance', 'override']
    """
    profile = profile.profile() if isinstance(profile, Run) else profile
    if not isinstance(profile, Profile):
        raise Alarm(f"a profile is that of a run, got {shown(profile)}", hint='run.profile("small-mill")')
    widgets("forms")
    from mnclab.show.plot.profile import plot_profile

    refuse_unknown(options, plot_profile)
    limits = profile.limits
    first = {name: round(float(np.min(getattr(limits, name) or 0.0)), 3) for name in LIMITS}
    first["override"] = round(100 * profile.override, 3)
    names = {name: f"{name.replace('_', ' ')} [{unit}]" for name, unit in (LIMITS | {"override": "%"}).items()}
    boxes = {name: number_box(names[name], NumberField(value)) for name, value in first.items()}
    fields = {name: Field(box) for name, box in boxes.items()}

    def work(live: Any) -> NewPicture:
        wanted: dict[str, Any] = {name: boxes[name].value for name in LIMITS if boxes[name].value != first[name]}
        if "jerk" in wanted:
            wanted["jerk"] = wanted["jerk"] or None
        live.profile = again = profile.again(replace(limits, **wanted), boxes["override"].value / 100)
        said = f'<div role="status">{again._repr_html_()}</div>'
        kept = {"size": SIZE_BELOW, "under": live.former, "held": live.box} | options
        return NewPicture(lambda **_: again.plot(**kept), said, made=again)

    def field_of(alarm: Alarm) -> str:
        return next((name for name in boxes if name.replace("_", " ") in alarm.message.replace("_", " ")), "")

    return following(boxes, fields, None, work, field_of, title="feed-rate profile", classes="mnclab-panel")


# One way to clear a pocket, which follows the tool and the stepover.

POCKET_WIDTH = 5.2  # inches, the width of the picture


@fitting
def pocket_panel(
    region: Region | None = None, strategy: str = "rings", *, diameter: float = 8.0, share: float = 0.4, limit: float = 90.0,
    **options: Any,
) -> Any:  # fmt: skip
    """A choice of the strategy and boxes for the tool, with its way on an area and what comes of it following.

    `diameter` of the tool in mm, `share` that the stepover is of it, `limit` of the engagement in degrees; without a `region`
    the area is a pocket of 60 by 40 mm with a round island. `options` are those of `compare`, such as feed and machine.
    The result has `boxes` ("strategy", "diameter", "share", "limit") and `trial`, the last one.

    >>> list(mnc.pocket_panel().boxes)
    ['strategy', 'diameter', 'share', 'limit']
    """
    ipywidgets = widgets("forms")

    from mnclab.comparison.strategies import compare

    for name in ("strategies", "tool", "stepover", "overlap"):
        if name in options:
            raise Alarm(f"a pocket panel has boxes in place of {name}", hint="pocket_panel(diameter=8, share=0.4)")
    pocket = Region.of(rectangle(60, 40, 6), holes=[Contour.circle((12, 2), 7)]) if region is None else region
    first = {"diameter": ("tool diameter [mm]", diameter), "share": ("stepover [share of it]", share)}
    first |= {"limit": ("limit [°]", limit)}
    numbers = {name: number_box(said, place_of(name, value)) for name, (said, value) in first.items()}
    chosen = choice(strategy, "a strategy", STRATEGIES)
    kind = ipywidgets.Dropdown(options=[(name, name) for name in STRATEGIES], value=chosen, description="strategy")
    boxes = {"strategy": kind, **numbers}
    fields = {name: Field(box) for name, box in boxes.items()}
    compare(pocket, 1e-3 + diameter / 2, (), **options)  # what no box can mend is refused at once

    def work(live: Any) -> NewPicture:
        live.alarms.value = '<div role="status">working…</div>'
        for name in numbers:
            check_number(numbers[name].value, name, above=0 if name != "limit" else None)
        wide = numbers["diameter"].value
        step = {"stepover": wide * numbers["share"].value, "limit": numbers["limit"].value}
        found = compare(pocket, wide / 2, kind.value, **step, **options)
        live.trial = found[0]
        lines = "".join(f"<tr>{cell(said)}{cell(text)}</tr>" for said, text in zip(found.head, found.texts()[0], strict=True))
        return NewPicture(lambda **_: found.plot(width=POCKET_WIDTH), f'<table role="status">{lines}</table>')

    def field_of(alarm: Alarm) -> str:
        words = {"stepover": "share", "radius": "diameter", "too large": "diameter"} | {name: name for name in boxes}
        return next((name for said, name in words.items() if said in alarm.message), "")

    return following(boxes, fields, None, work, field_of, title="pocket", classes="mnclab-panel")


def refuse_unknown(options: Mapping[str, Any], plot: Any) -> None:
    """An Alarm for options that a figure does not have: no value in a box would mend them."""
    from mnclab.show.plot.sizes import ADDED, check_options

    check_options({name: value for name, value in options.items() if name not in ADDED}, plot.options)

"""Boxes for what a run was made with: the tool radius of a compensated one, the limits of the machine of a profile."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mnclab.lab.forms.boxes import Place, number_box
from mnclab.lab.forms.fields import Field
from mnclab.lab.forms.following import Work, following, of_run
from mnclab.path.profile import Profile
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm
from mnclab.text.given import fitting, shown
from mnclab.text.opening import require

LIMITS = {"acceleration": "mm/s²", "jerk": "mm/s³", "corner_tolerance": "mm"}
SIZE = (6.4, 4.9)  # inches, below a row of boxes


@fitting
def compensation_panel(run: Run, **options: Any) -> Any:
    """A box for the tool radius and a choice for outside corners, with contour and tool-centre path that follow.

    `options` are those of `show.plot.compensation.compensation`. The result has `boxes` ("radius", and
    "corners" where the control has a choice) and `run`, the last run.
    """
    if not isinstance(run, Run):
        raise Alarm(f"a run is compensated, got {shown(run)}", hint='compensation_panel(mnclab.run("part.mnc"))')
    require("ipywidgets", "forms")
    require("matplotlib", "pictures")
    import ipywidgets

    from mnclab.show.plot.compensation import compensation

    refuse_unknown(options, compensation)
    used = abs(run.programmed.radius[run.programmed.side != 0])
    boxes = {"radius": number_box("tool radius [mm]", Place(float(used.max()) if len(used) else 5.0, (0.01, 1e4)))}
    corners = next((one for one in run.control.settings if one.name == "outside_corners"), None)
    if corners:
        choices = [(f"{name}: {meaning.split(',')[0]}", name) for name, meaning in corners.choices.items()]
        first = run.settings["outside_corners"]
        boxes["corners"] = ipywidgets.Dropdown(options=choices, value=first, description="outside corners")
    fields = {name: Field(box) for name, box in boxes.items()}

    def work(live: Any) -> Work:
        setup = run.setup.with_radius(boxes["radius"].value)
        if corners:
            setup = setup.with_settings(outside_corners=boxes["corners"].value)
        live.run = again = run.again(setup)
        work = of_run(again, lambda **kept: again.plot_compensation(**{"size": SIZE} | kept | options))
        return work._replace(shows=True)  # hatched, where the tool does not fit

    def field_of(alarm: Alarm) -> str:
        return "radius" if "radius" in alarm.message else ""

    rows = ipywidgets.HBox([field.row for field in fields.values()])
    return following(boxes, fields, rows, work, field_of, title="radius compensation", classes="mnclab-across")


@fitting
def profile_panel(profile: Profile | Run, **options: Any) -> Any:
    """Number boxes for the limits of a machine, with the profile (that of a run too) and its times following.

    A box has the least of the limits of all axes and, once it was changed, counts for all of them; a jerk of 0 means no
    limit. `options` are those of `show.plot.profile.plot_profile`. The result has
    `boxes` (by name) and `profile`, the last one planned.
    """
    profile = profile.profile() if isinstance(profile, Run) else profile
    if not isinstance(profile, Profile):
        raise Alarm(f"a profile is that of a run, got {shown(profile)}", hint='run.profile("small-mill")')
    require("ipywidgets", "forms")
    require("matplotlib", "pictures")
    import ipywidgets

    from mnclab.show.plot.profile import plot_profile

    refuse_unknown(options, plot_profile)
    limits = profile.limits
    first = {name: round(float(np.min(getattr(limits, name) or 0.0)), 3) for name in LIMITS}
    first["override"] = round(100 * profile.override, 3)
    names = {name: f"{name.replace('_', ' ')} [{unit}]" for name, unit in (LIMITS | {"override": "%"}).items()}
    boxes = {name: number_box(names[name], Place(value)) for name, value in first.items()}
    fields = {name: Field(box) for name, box in boxes.items()}

    def work(live: Any) -> Work:
        wanted: dict[str, Any] = {name: boxes[name].value for name in LIMITS if boxes[name].value != first[name]}
        if "jerk" in wanted:
            wanted["jerk"] = wanted["jerk"] or None
        live.profile = again = profile.again(replace(limits, **wanted), boxes["override"].value / 100)
        said = f'<div role="status">{again._repr_html_()}</div>'
        kept = {"size": SIZE, "under": live.former, "held": live.box} | options
        return Work(lambda **_: again.plot(**kept), said, made=again)

    def field_of(alarm: Alarm) -> str:
        return next((name for name in boxes if name.replace("_", " ") in alarm.message.replace("_", " ")), "")

    rows = ipywidgets.VBox([field.row for field in fields.values()])
    return following(boxes, fields, rows, work, field_of, title="feed-rate profile", classes="mnclab-panel")


def refuse_unknown(options: dict[str, Any], plot: Any) -> None:
    """An Alarm for options that a figure does not have: no value in a box would mend them."""
    from mnclab.show.plot.options import ADDED, check_options

    check_options({name: value for name, value in options.items() if name not in ADDED}, plot.options)

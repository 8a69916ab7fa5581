"""Boxes for what a run was made with: the tool radius of a compensated one, the limits of the machine of a profile."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mnclab.path.profile import Profile
from mnclab.runs.run import Run
from mnclab.show.forms.boxes import looks_of, number_box
from mnclab.show.forms.following import Work, following, verdict
from mnclab.text.extras import require


def compensation_panel(run: Run, **options: Any) -> Any:
    """A box for the tool radius and a choice for outside corners, with contour and tool-centre path that follow.

    `options` are those of `show.plot.compensation.compensation`. The result has `boxes` ("radius", and
    "corners" where the control has a choice) and `run`, the last run.
    """
    require("ipywidgets", "forms")
    import ipywidgets

    used = abs(run.programmed.radius[run.programmed.side != 0])
    boxes = {"radius": number_box("tool radius [mm]", (float(used.max()) if len(used) else 5.0, 0.01, 1e4))}
    corners = next((one for one in run.control.settings if one.name == "outside_corners"), None)
    if corners:
        choices = [(f"{name}: {meaning.split(',')[0]}", name) for name, meaning in corners.choices.items()]
        first, looks = run.settings["outside_corners"], looks_of("outside corners", 8, 18)
        boxes["corners"] = ipywidgets.Dropdown(options=choices, value=first, **looks)

    def work(live: Any) -> Work:
        setup = run.setup.with_radius(boxes["radius"].value)
        if corners:
            setup = setup.with_settings(outside_corners=boxes["corners"].value)
        live.run = again = run.again(setup)
        return lambda: again.plot_compensation(size=(6.4, 5.2), **options), verdict(again)

    return following(boxes, ipywidgets.HBox([*boxes.values()]), work)


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
    boxes = {name: number_box(names[name], value, 13) for name, value in first.items()}

    def work(live: Any) -> Work:
        wanted = {name: box.value for name, box in boxes.items()}
        part = wanted.pop("override") / 100
        live.profile = again = profile.again(replace(limits, **wanted | {"jerk": wanted["jerk"] or None}), part)
        return lambda: again.plot(**options), f'<div role="status">{again._repr_html_()}</div>'

    return following(boxes, ipywidgets.VBox([*boxes.values()]), work)

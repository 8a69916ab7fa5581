"""Number boxes for the places of a program, with its picture."""

from __future__ import annotations

import re
from difflib import get_close_matches
from typing import Any

from mnclab.machine import trial
from mnclab.machine.setup import Setup
from mnclab.show.forms.boxes import Number, check_number_of_place, number_box
from mnclab.show.forms.following import following_program
from mnclab.text.alarm import Alarm
from mnclab.text.extras import require
from mnclab.text.given import shown

PLACE = re.compile(r"\{(\w+)\}")


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
        check_number_of_place(name, number)
    places = list(dict.fromkeys(PLACE.findall(template)))
    for one, other, what in ((places, numbers, "has no number"), (numbers, places, "has no place in the program")):
        for name in (name for name in one if name not in other):
            near = get_close_matches(name, list(other), 1)
            raise Alarm(f"{{{name}}} {what}", hint=f"near: {near[0]}" if near else f"write {{{name}}} and {name}=…")
    boxes = {name: number_box(name.replace("_", " "), number) for name, number in numbers.items()}

    def text() -> str:
        return PLACE.sub(lambda place: trial.number(boxes[place[1]].value), template)

    return following_program(boxes, list(boxes.values()), text, control, lambda: setup, view)

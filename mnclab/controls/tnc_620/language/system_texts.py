"""System data that are texts, SYSSTR: by the names under which they are asked for (TNC 7, "System data")."""

from __future__ import annotations

from collections.abc import Callable

from mnclab.controls.tnc_620.clock import time_of_day
from mnclab.controls.tnc_620.engraved_text import TIMES
from mnclab.machine.machine import Machine


def written_time(form: str) -> Callable[[Machine], str]:
    """The time of day, as the form writes it."""

    def read(m: Machine) -> str:
        if (now := time_of_day(m)) is None:
            m.alarm("SYSSTR ID321 asks for the time, which a run does not have", hint="the setting clock gives it one")
        return form.format(t=now)

    return read


TEXTS: dict[str, Callable[[Machine], str]] = {
    **{f"SYSSTR ID321 NR{number}": written_time(form) for number, form in enumerate(TIMES)},
    "SYSSTR ID10950 NR1": lambda m: m.tool.name,
}

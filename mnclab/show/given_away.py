"""What a file that is given away says of a program: its name without the folders here, and whole letters alone."""

from __future__ import annotations

from copy import copy
from pathlib import Path
from typing import NamedTuple

from mnclab.text.alarm import Alarm, Source


class Named(NamedTuple):
    """The source of an alarm under its name alone."""

    name: str
    source: Source

    def line_text(self, line: int) -> str:
        return self.source.line_text(line)


CONTROLS = {code: "\N{REPLACEMENT CHARACTER}" for code in (*range(9), *range(14, 32), *range(127, 160))}


def whole(text: str) -> str:
    """A text that can be written: half a pair of surrogates, which is no letter, becomes a question mark, and a control
    character, which no font has, the sign for what cannot be shown."""
    return text.encode("utf-8", "replace").decode().translate(CONTROLS)


def named(alarm: Alarm) -> Alarm:
    """The same alarm, in a file without folders."""
    found = copy(alarm)
    if alarm.source is not None:
        found.source = Named(Path(alarm.source.name).name, alarm.source)
    return found

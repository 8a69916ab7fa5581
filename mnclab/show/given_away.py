"""What is written into a file that is given away names a program, but not the folders that it lies in here."""

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
        """The characters of one line, without its end."""
        return self.source.line_text(line)


def named(alarm: Alarm) -> Alarm:
    """The same alarm, in a file without folders."""
    found = copy(alarm)
    if alarm.source is not None:
        found.source = Named(Path(alarm.source.name).name, alarm.source)
    return found

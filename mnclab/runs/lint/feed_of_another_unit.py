"""A feed in mm/rev that counts mm/min: F0.1 on a lathe whose feed is one per minute (G94), as it is at power on.

A micrometre in a turn of the spindle is no feed that anybody turns with, and such a cut would take hours. Nor is a tap fed by
another pitch than its own: it strips the thread or breaks (the TNC 620 refuses it itself).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.listing import figure
from mnclab.path.toolpath import Kind
from mnclab.runs.lint.once import once
from mnclab.text.alarm import Alarm

if TYPE_CHECKING:
    from mnclab.runs.run import Run

LEAST = 0.001  # mm a turn
MOST = 2.0  # mm/min: greater numbers are no feeds a turn
SAME = 0.01  # of a pitch: inches are written in four places


def remarks(run: Run) -> Iterator[Alarm]:
    """A warning for each of these feeds."""
    yield from _a_minute(run)
    yield from _of_taps(run)


def _of_taps(run: Run) -> Iterator[Alarm]:
    """A warning for the threads that a tap of known pitch cuts with another one."""
    path = run.toolpath
    threads = path.synchronous & np.isin(path.kind, (Kind.LINE, Kind.ARC)) & np.isfinite(path.per_rev)
    if not threads.any():
        return
    tools, which = run.tools_that_cut
    for number, tool in tools.items():
        mine = threads & (which == number) & (abs(path.per_rev - tool.pitch) > SAME * tool.pitch)
        if tool.kind == "tap" and tool.pitch > 0 and mine.any():
            fed, own = (figure(float(each) / path.unit.length, 4) for each in (path.per_rev[mine][0], tool.pitch))
            message = f"the tap of tool {number} has a pitch of {own} {path.unit.short} and is fed {fed} {path.unit.short} a turn"
            yield once(run, path.step[mine].tolist(), message, "the feed is pitch times speed (G94), or the pitch (G95)")


def _a_minute(run: Run) -> Iterator[Alarm]:
    """A warning at the first cut of a lathe that goes less than a micrometre in a turn."""
    path = run.toolpath
    if not path.lathe:
        return
    plain = np.isnan(path.per_rev) & np.isnan(path.time) & ~path.synchronous & np.isin(path.kind, (Kind.LINE, Kind.ARC))
    slow = plain & (path.feed > 0) & (path.feed <= MOST) & (path.feed < LEAST * np.abs(path.spindle)) & (path.lengths > 0)
    if slow.any():
        feed = path.feed[slow.argmax()]
        message = f"the feed counts mm/min (G94): at {feed:g} mm/min the tool goes less than 0.001 mm in a turn of the spindle"
        yield once(run, path.step[slow].tolist(), message, f"G95 F{feed:g} is {feed:g} mm/rev")

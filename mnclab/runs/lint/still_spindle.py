"""Cutting with the spindle still: the path is right and the tool is lost, so a run says it once, where it begins."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.toolpath import Kind, Toolpath
from mnclab.text.alarm import WARNING, Alarm

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

SENTENCE = "the tool moves at feed while the spindle stands"
HINT = "a speed (S) and the sense of turning (M3 or M4) come before the first cut; setting stopped_spindle"


def remarks(m: Machine, path: Toolpath) -> Iterator[Alarm]:
    """A warning at the first block of a path that moves at feed without a turning spindle.

    A probe does not turn, a cycle may stop the spindle for a part of its way, and what a control has already said at
    that block (a call of the TNC 620, G95 of the JNC-T01) is not repeated.
    """
    if m.settings["stopped_spindle"] == "accept" or not len(path):
        return
    still = (path.spindle == 0) & ((path.kind == Kind.LINE) | (path.kind == Kind.ARC))
    still &= ~np.isin(path.tool, [number for number, tool in m.tables.tools.items() if tool.kind == "probe"])
    stopped = (path.kind == Kind.SPINDLE) & (path.label > 0)  # labels are those of cycles
    still &= ~np.isin(path.step, path.step[stopped])
    if not still.any():
        return
    place = m.flow.span_of_step(int(path.step[np.argmax(still)]))
    said = {(alarm.span.line, alarm.span.program) for alarm in m.alarms if alarm.span and "spindle" in alarm.message}
    if place and (place.line, place.program) not in said:
        yield Alarm(SENTENCE, place, WARNING, HINT)

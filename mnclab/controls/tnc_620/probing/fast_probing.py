"""Cycle 441 FAST PROBING: how all touch probe cycles after it position, until the program ends (TNC 620, 17.10)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from mnclab.controls.tnc_620.cycles.addresses import FAR, POSITIONING, choice, feed
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import INF, Machine
from mnclab.machine.probe import Probe
from mnclab.machining.steps import Step, Write

CYCLES = CycleTable(runs="definition")
SWITCH: dict[float, str] = {0: "no", 1: "yes"}
PREPOSITION: dict[float, str] = {0: "at the feed rate of Q396", 1: "at the rapid traverse of the machine"}
TABLE: dict[str, Any] = {"default": None, "default_means": "as the touch probe table has it"}
OWN: dict[str, Any] = {"default": None, "default_means": "as the measuring cycle says"}


@CYCLES("TCH PROBE 441", "Fast probing", source="17.10")
class FastProbing(Cycle):
    """Nothing moves; what is left out stays as the touch probe table has it."""

    positioning: float | str | None = feed("Q396", "positioning feed rate", also=POSITIONING, at_most=FAR, example=3000, **TABLE)
    rapid: float | None = choice("Q397", "pre-positioning", PREPOSITION, example=0, **TABLE)
    track: float | None = choice("Q399", "orienting the probe before each touch", SWITCH, example=1, **TABLE)
    interruption: float | None = choice("Q400", "stop with the results of a measuring cycle", SWITCH, example=1, **OWN)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if self.positioning == 0 and not self.rapid:
            yield "positioning", "must be greater than 0 where Q397 is 0"

    def moves(self, m: Machine) -> Iterator[Step]:
        yield Write("memory", self, "fast_probing")


def probe_in_force(m: Machine) -> Probe:
    """The touch probe table with what cycle 441 put in its place."""
    probe, fast = m.tables.probe, memory(m).fast_probing
    if fast is None:
        return probe
    if fast.rapid is not None:
        probe = replace(probe, positioning="machine" if fast.rapid else "probe")
    if fast.positioning is not None and not fast.rapid:
        probe = replace(probe, rapid=INF if fast.positioning == "FMAX" else float(fast.positioning), positioning="probe")
    return probe if fast.track is None else replace(probe, track=fast.track == 1)


def shows_results(m: Machine, chosen: bool) -> bool:
    """Whether a measuring cycle stops with its results: as it was `chosen` in it (Q281 = 2), or as Q400 says for all of them."""
    fast = memory(m).fast_probing
    return chosen if fast is None or fast.interruption is None else fast.interruption == 1

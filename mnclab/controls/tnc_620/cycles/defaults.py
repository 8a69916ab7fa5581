"""GLOBAL DEF and PREDEF (3.2): values that many cycles share, said once at the beginning of a program.

A cycle takes such a value where its parameter says PREDEF, when it is defined; a number in the cycle is its own. The
values are no Q parameters of the program: GLOBAL DEF 100 with Q200=3 leaves Q200 as it is.
"""

from __future__ import annotations

from collections.abc import Container, Iterator
from typing import ClassVar

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import POSITIONING, choice, coordinate, distance, ratio, seconds
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.cycle import Cycle, CycleTable, Parameter
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Step, Write
from mnclab.text.program import Word

CYCLES = CycleTable()
CLIMB: dict[float, str] = {1: "climb", -1: "conventional"}
MEASURING: dict[float, str] = {0: "at the measuring height", 1: "at the clearance height"}
HEIGHTS: dict[float, str] = {0: "where the tool stood at the call", 1: "the second set-up clearance"}


class Defaults(Cycle):
    """Values for the cycles with the numbers `serves`; they hold until they are defined again or the program ends."""

    serves: ClassVar[Container[int]] = ()
    in_variables: ClassVar[bool] = False

    def moves(self, m: Machine) -> Iterator[Step]:
        values = {parameter.address: getattr(self, parameter.name) for parameter in self.parameters()}
        yield Write("memory", memory(m).defaults | values, "defaults")
        for address, value in values.items():
            yield Write("history", value, f"default {address}")


@CYCLES("GLOBAL DEF 100", "Defaults of all fixed cycles", runs="definition", source="3.2")
class General(Defaults):
    """Clearances and feeds for the cycles 2xx."""

    serves = range(200, 300)
    clearance: float = addresses.clearance()
    second_clearance: float = addresses.second_clearance()
    positioning_feed: float | str = addresses.feed("Q253", "feed rate for positioning", also=POSITIONING, example=750)
    retraction_feed: float | str = addresses.feed("Q208", "feed rate for retraction", also=POSITIONING, example=500)


@CYCLES("GLOBAL DEF 105", "Defaults of drilling cycles", runs="definition", source="3.2")
class Drilling(Defaults):
    """Chip breaking and dwells for drilling, tapping and thread milling."""

    serves = (*range(200, 210), 240, 241, *range(262, 268))
    break_retract: float = distance("Q256", "retraction for chip breaking", example=0.2)
    dwell_bottom: float = addresses.dwell_bottom()
    dwell_top: float = seconds("Q210", "dwell at the set-up clearance", example=0)


@CYCLES("GLOBAL DEF 110", "Defaults of pocket cycles", runs="definition", source="3.2")
class PocketMilling(Defaults):
    """How pockets, slots and studs are milled."""

    serves = range(251, 259)
    overlap: float = ratio("Q370", "path overlap factor", at_most=1.9999, example=1)
    climb: float = choice("Q351", "sense of milling", CLIMB)
    plunging_type: float = choice("Q366", "plunging strategy", addresses.PLUNGE)


@CYCLES("GLOBAL DEF 111", "Defaults of contour cycles", runs="definition", source="3.2")
class ContourMilling(Defaults):
    """How the contours of the SL cycles are milled."""

    serves = range(20, 26)
    clearance: float = distance("Q6", "set-up clearance", example=2)
    height: float = coordinate("Q7", "clearance height", example=50)
    overlap: float = ratio("Q2", "path overlap factor", at_most=1.9999, example=1)
    climb: float = choice("Q9", "sense of milling", CLIMB)


@CYCLES("GLOBAL DEF 120", "Defaults of probing cycles", runs="definition", source="3.2")
class Probing(Defaults):
    """Clearances of the touch probe for the cycles 4xx."""

    serves = range(400, 500)
    clearance: float = distance("Q320", "set-up clearance", example=2)
    height: float = coordinate("Q260", "clearance height", example=20)
    move_to_clearance_height: float = choice("Q301", "height between measuring points", MEASURING)


@CYCLES("GLOBAL DEF 125", "Positioning for CYCL CALL PAT", runs="definition", source="3.2")
class Positioning(Defaults):
    """The height between the points of a pattern; CYCL CALL PAT reads it."""

    select_positioning_height: float = choice(
        ("Q345", "Q352"), "positioning height between points", HEIGHTS, note="without this definition: the greater of the two"
    )


def predefined(m: Machine, code: str, parameter: Parameter, word: Word) -> float | str:
    """What PREDEF stands for in a cycle: the value of the GLOBAL DEF executed last."""
    named = f"{code} {parameter.address} ({parameter.meaning})"
    source = next((c for c in CYCLES.values() if parameter.address in {p.address for p in c.parameters()}), None)
    offered = source is not None and issubclass(source, Defaults) and int(code.split()[-1]) in source.serves
    if source is None or not (parameter.predef or offered):
        m.alarm(f"{named} has no default: PREDEF is not allowed", word, hint="write its value")
    if parameter.address not in memory(m).defaults:
        m.alarm(f"{named} needs {source.code} before it for PREDEF", word)
    value = memory(m).defaults[parameter.address]
    if isinstance(value, str) and value not in parameter.also:
        m.alarm(f"{named} cannot be {value}, which {source.code} gives", word, hint="write its value")
    return value

"""Fixed cycles until G80: what they share, drilling (G73, G81, G82, G83) and tapping (G74, G84); `boring` has the others.

Of this chapter the source has only the title. The cycles are those that ISO controls have under these codes: over the
hole, at rapid to level R, the work down to Z, and back to the initial level (G98) or to level R (G99). Under G91, R counts
from the initial level and Z from level R. Z, R, F, and Q and P where they mean the same, hold from one cycle to the next
until G80, and so does the initial level. K or L is the number of holes, each by X and Y of the block further under G91;
without holes (K0), or in a block without X, Y, Z and R, the data are kept for later blocks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from types import SimpleNamespace
from typing import ClassVar

import numpy as np

from mnclab.controls.g43.language import motion
from mnclab.controls.g43.language.offsets import settle_doubt
from mnclab.controls.g43.language.tools import activate
from mnclab.controls.g43.refused import at_a_place
from mnclab.controls.g43.settings import DIALECT_NAMES
from mnclab.controls.g43.state import ISO, memory, seconds_of_p, undescribed
from mnclab.controls.word_address import holes
from mnclab.machine.control import Words
from mnclab.machine.cycle import Cycle, CycleTable, Given, Values, param
from mnclab.machine.machine import Machine
from mnclab.machining.holes import back_bore, back_to_axis, bore_and_stop, drill, ream, tap
from mnclab.machining.steps import RAPID, Each, Go, Step, moved

MOST_HOLES = 9999  # of one block
SAME = 1e-9  # mm, between two levels that are one

POSITION = "X Y Z R"
LENGTHS = ("bottom", "r_level", "peck", "tapping_peck")  # data that hold, of which other units make other lengths

dwell = partial(param, "P", "dwell at the bottom, milliseconds", "ms", default=0, at_least=0, modal=True, example=500)
peck = partial(param, "Q", "depth of one peck", above=0, incremental=True, modal=True)
CYCLES = CycleTable(addresses=SimpleNamespace(
    x=holes.x, y=holes.y, bottom=holes.bottom, r_level=holes.r_level, feed=holes.feed, dwell=dwell, peck=partial(peck, example=5),
    pause=partial(dwell, note="of Haas; other makers' G73 and G83 have no dwell"),
    repeats=partial(
        param, ("K", "L"), "number of holes", "", default=1, type="integer", at_least=0, at_most=MOST_HOLES, example=1
    ),
    tapping_peck=partial(
        peck, default=None, default_means="the whole thread at once",
        note="rigid tapping; what happens between two: setting peck_tapping",
    ),
    times_out=partial(
        param, "J", "how many times faster the tap comes out", "", default=1, above=0, at_most=9, modal=True,
        note="of Haas", example=1,
    ),
), runs="position")  # fmt: skip
HOLE, ENDS = "x y bottom r_level", "dwell feed repeats"


def along_z(m: Machine, code: str, given: Given) -> None:
    """Refuse what another maker drills elsewhere, or counts otherwise."""
    if m.plane != "XY" and m.settings["hole_axis"] == "normal":
        axis, hint = {"ZX": "Y", "YZ": "X"}[m.plane], "write G17, or choose the setting hole_axis"
        m.alarm(f"{code} drills along {axis} in the plane {m.plane}: not built", given.get("bottom"), hint=hint)
    dialect, count = m.settings["dialect"], given.get("repeats")
    if count and count.address == "K" and dialect != "fanuc":
        maker = DIALECT_NAMES[dialect]
        m.alarm(f"{code} K is not the number of holes as {maker} has it", count, hint="write L for the number of holes")


def written_again(m: Machine, cycle: type[Cycle], given: Given, kept: Values) -> None:
    """On LinuxCNC the data of a hole hold as long as the cycle is the same: of another one they must be written."""
    if m.settings["hole_data"] == "numbers" and kept.get("code") != cycle.code:
        needed = {"bottom", "r_level"} | {"G73": {"peck"}, "G83": {"peck"}}.get(cycle.code, set())
        needed |= {"dwell"} if cycle.code in ("G82", "G86", "G89") else set()
        for parameter in cycle.parameters():
            if parameter.name in needed - given.keys():
                before = f": that of {kept['code']} counts no more" if "code" in kept else ""
                m.alarm(
                    f"{cycle.code} {parameter.address} ({parameter.meaning}) is missing{before}",
                    next(iter(given.values()), None), "write it where the cycle begins (LinuxCNC)",
                )  # fmt: skip
    kept["code"] = cycle.code


def keep_initial_level(m: Machine, kept: Values) -> None:
    """The initial level is where the first hole began, or as `hole_data` may have it the number of that place counted anew."""
    x, y, z = m.programmed
    number = kept.setdefault("initial number", z / m.variable_unit)
    if m.settings["hole_data"] == "numbers":
        kept["initial"] = holes.level_of(m, (x, y, number * m.variable_unit))
    if "initial" not in kept:
        kept["initial"] = holes.level_of(m, m.programmed)


def levels(m: Machine, values: Values, given: Given, kept: Values) -> None:
    """Z and R become coordinates: those of the block, or as `hole_data` may have it the last numbers counted anew."""
    numbers = kept.setdefault("numbers", {})
    numbers |= {name: values[name] / m.variable_unit for name in LENGTHS if name in given}
    if m.settings["hole_data"] == "numbers":
        values |= {name: number * m.variable_unit for name, number in numbers.items() if name in values}
        given = numbers
    if m.modal["dimension"] == "G91":
        if "r_level" in given:
            values["r_level"] += holes.initial_level(m, kept)
        if "bottom" in given:
            kept["depth"] = values["bottom"]
        if values.get("r_level") is not None and "depth" in kept:
            values["bottom"] = values["r_level"] + kept["depth"]
    elif "bottom" in given:
        kept.pop("depth", None)


def warn_of_change(m: Machine, code: str, given: Given, kept: Values) -> None:
    """Say that a cycle goes on after something has changed that its levels hang on: makers differ in what they are then."""
    now = m.variable_unit, m.to_machine((0.0, 0.0, 0.0))[2]
    before = kept.get("read", now)
    kept["read"] = now
    written = {"r_level", "bottom"} <= given.keys()
    word = next(iter(given.values()), None)
    if m.settings["hole_data"] == "numbers":
        if now != before:
            m.warn(f"{code} goes on after a change of the unit or of the origin of Z: the numbers of its levels count anew", word,
                   hint="makers differ: write G80 before it")  # fmt: skip
        return
    if now[0] != before[0] and not written:
        m.warn(f"{code} goes on after a change of the unit: level R and the bottom stay where they were", word,
               hint="makers differ: write Z and R again")  # fmt: skip
    if abs(now[1] - before[1]) > SAME:
        stays = "" if written else "level R and the bottom count from there, "
        m.warn(f"{code} goes on after the origin of Z has moved: {stays}the initial level stays where it was", word,
               hint="makers differ: write G80 before it")  # fmt: skip


class HoleCycle(holes.AtHole, Cycle):
    """A cycle at a hole whose data hold from one cycle to the next."""

    shares = True
    dwell: float = 0.0
    repeats: float = 1
    pause: float
    times_out: float
    hand: ClassVar[int] = 0  # of the thread that it taps: 1 right, -1 left

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        """Increments become coordinates where they are programmed; offsets of the length compensation count from here on."""
        undescribed(m, Words((), cls.code))
        along_z(m, cls.code, given)
        at_a_place(m, cls.code, values, given)
        if not memory(m).machine_coordinates:
            activate(m, "xyz")
            settle_doubt(m, Words(tuple(given.values()), cls.code), given.keys() & {"x", "y"})
        written_again(m, cls, given, kept)
        keep_initial_level(m, kept)
        warn_of_change(m, cls.code, given, kept)
        kept["step"] = (0.0, 0.0)
        kept["points"] = None
        if given.keys().isdisjoint(("x", "y", "bottom", "r_level")):
            values["repeats"] = 0
        for name in {"dwell", "pause"} & given.keys():
            values[name] *= 1000 * seconds_of_p(m, given[name])
        if memory(m).polar is not None:
            motion.holes(m, values, given, kept)
        if m.modal["dimension"] == "G91" and memory(m).polar is None:
            kept["step"] = values.get("x", 0.0), values.get("y", 0.0)
            for k, name in enumerate("xy"):
                if name in given:
                    values[name] += m.programmed[k]
        levels(m, values, given, kept)
        holes.take_feed(m, values, given)
        return values

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        if getattr(self, self.pecks, None) and "scaling" in m.frames:
            yield "", "cannot run under G51: whether Q is scaled is a matter of the maker"

    def about(self, m: Machine) -> tuple[float, float]:
        return super().about(m) if self.repeats == 1 else (0.0, 0.0)

    def moves(self, m: Machine) -> Iterator[Step]:
        if self.repeats == 1:
            return self.hole(m)
        assert m.position_cycle is not None
        first, step = np.array(super().about(m)), np.array(m.position_cycle.extra["step"])
        points = m.position_cycle.extra["points"]
        if points is None:
            points = first + np.arange(self.repeats)[:, None] * step
        return iter([Each(points, lambda x, y: moved(self.hole(m), x, y))])

    def hole(self, m: Machine) -> Iterator[Step]:
        """The way over a hole, the work, and the way up."""
        return super().moves(m)

    def approach(self, m: Machine) -> Iterator[Step]:
        assert m.position_cycle is not None
        way, level = m.settings["below_r"], m.programmed[2]
        straight, initial = way == "straight", holes.initial_level(m, m.position_cycle.extra)
        if straight and initial < self.r_level:
            yield Go("to level R", self.r_level)
            yield self.across()
        elif straight and level < self.r_level + SAME < initial and m.modal["return"] == "G98":  # after holes under G99
            yield self.across()._replace(z=initial)
            yield Go("to level R", self.r_level)
        elif level < self.r_level and way != "up":
            yield self.across()._replace(z=self.r_level if straight else None)
            yield Go("to level R", self.r_level)
        else:
            yield from super().approach(m)

    @property
    def seconds(self) -> float:
        return self.dwell / 1000


@CYCLES("G81", "Drilling", source=ISO, triggers=POSITION, takes=f"{HOLE} feed repeats")
class Drilling(HoleCycle):
    """Drills in one pass."""

    def work(self, m: Machine) -> Iterator[Step]:
        return drill(self.levels(), above=self.r_level, feed=None, reenter=0)


@CYCLES("G82", "Counterboring", source=ISO, triggers=POSITION, takes=f"{HOLE} {ENDS}")
class Counterboring(HoleCycle):
    """Drills in one pass and waits at the bottom."""

    def work(self, m: Machine) -> Iterator[Step]:
        return drill(self.levels(), above=self.r_level, feed=None, reenter=0, dwell_bottom=self.seconds)


@CYCLES("G83", "Deep-hole drilling", source=ISO, triggers=POSITION, takes=f"{HOLE} peck pause feed repeats")
class DeepHoleDrilling(HoleCycle):
    """Drills in pecks with withdrawal to level R."""

    def work(self, m: Machine) -> Iterator[Step]:
        return drill(self.levels(), above=self.r_level, feed=None, reenter=m.settings["peck_clearance"],
                     dwell_bottom=self.pause / 1000)  # fmt: skip


@CYCLES("G73", "Drilling with chip breaking", source=ISO, triggers=POSITION, takes=f"{HOLE} peck pause feed repeats")
class ChipBreaking(HoleCycle):
    """Drills in pecks and lifts a little between them."""

    def work(self, m: Machine) -> Iterator[Step]:
        levels, back = self.levels(), m.settings["peck_clearance"]
        return drill(levels, above=self.r_level, feed=None, reenter=0, breaks=len(levels), back=back,
                     dwell_bottom=self.pause / 1000)  # fmt: skip


def turns(sense: int) -> Callable[[Machine], Iterator[tuple[str, str]]]:
    """A rule of LinuxCNC: the spindle turns as the thread does; on Fanuc and Haas the cycle turns it."""

    def fault(m: Machine) -> Iterator[tuple[str, str]]:
        if m.settings["dialect"] == "linuxcnc" and m.spindle_speed * sense < 0:
            yield "", f"needs M{3 if sense > 0 else 4}, as its thread turns (LinuxCNC)"

    return fault


def thread(cycle: HoleCycle, m: Machine) -> Iterator[Step]:
    """Cut with the spindle turning one way, back with the other."""
    pitch, speed, sense = m.feed_of(None) / m.speed, m.speed, cycle.hand
    back = m.settings["peck_clearance"] if m.settings["peck_tapping"] == "lifts" else 0.0
    return tap(
        cycle.levels(), above=cycle.r_level, pitch=pitch, sense=sense, end=sense, dwell=cycle.seconds, back=back,
        speed=speed, out_speed=cycle.times_out * speed,
    )  # fmt: skip


@CYCLES("G84", "Tapping, right-hand", source=ISO, triggers=POSITION, takes=f"{HOLE} tapping_peck dwell times_out feed repeats")
class RightTapping(HoleCycle):
    """Taps a right-hand thread; the pitch is the feed per revolution, or F over S."""

    hand, pecks, work = 1, "tapping_peck", thread
    needs = (holes.no_pitch, turns(hand))


@CYCLES("G74", "Tapping, left-hand", source=ISO, triggers=POSITION, takes=f"{HOLE} tapping_peck dwell times_out feed repeats")
class LeftTapping(HoleCycle):
    """Taps a left-hand thread; the pitch is the feed per revolution, or F over S."""

    hand, pecks, work = -1, "tapping_peck", thread
    needs = (holes.no_pitch, turns(hand))


# Boring cycles: G76 and G85 to G89, in and out at feed or with the spindle at rest.

def initial_level_alone(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault where a cycle that cannot stay at level R is to do so."""
    if m.modal["return"] == "G99":
        yield "", "always comes back to the initial level: write G98"


def not_of_linuxcnc(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault of a cycle that LinuxCNC's documentation calls unimplemented."""
    if m.settings["dialect"] == "linuxcnc":
        yield "", "is not built as LinuxCNC has it"


def shift_scaled(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault where it is not known whether the shift off the wall is scaled."""
    if "scaling" in m.frames:
        yield "", "cannot run under G51: whether the shift is scaled is a matter of the maker"


@CYCLES("G85", "Boring, feed out", source=ISO, triggers=POSITION, takes=f"{HOLE} feed repeats")
class Reaming(HoleCycle):
    """In and out at feed."""

    def work(self, m: Machine) -> Iterator[Step]:
        return ream(self.bottom, above=self.r_level, feed=None, retract=None)


@CYCLES("G89", "Boring, dwell, feed out", source=ISO, triggers=POSITION, takes=f"{HOLE} {ENDS}")
class DwellReaming(HoleCycle):
    """In at feed, a dwell, out at feed."""

    def work(self, m: Machine) -> Iterator[Step]:
        return ream(self.bottom, above=self.r_level, feed=None, retract=None, dwell=self.seconds)

    def hole(self, m: Machine) -> Iterator[Step]:
        """On LinuxCNC the way out is at feed up to the initial level."""
        up = None if m.settings["dialect"] == "linuxcnc" else RAPID
        for step in super().hole(m):
            yield step._replace(feed=up) if isinstance(step, Go) and step.label == "to the initial level" else step


@CYCLES("G86", "Boring, spindle stop, rapid out", source=ISO, triggers=POSITION, takes=f"{HOLE} {ENDS}")
class StoppedBoring(HoleCycle):
    """In at feed, spindle stop, out at rapid."""

    needs = (holes.spindle_stands,)

    def work(self, m: Machine) -> Iterator[Step]:
        return bore_and_stop(self.bottom, above=self.r_level, dwell=self.seconds, turning=m.turning)


@CYCLES("G76", "Fine boring", source=ISO, triggers=POSITION, takes=f"{HOLE} shift shift_x shift_y {ENDS}")
class FineBoring(HoleCycle):
    """In at feed, oriented spindle stop, away from the wall by Q along -X or by I and J, out at rapid, back to the axis."""

    shift: float | None = param(
        "Q", "shift off the wall", default=None, default_means="by I and J", above=0, incremental=True, modal=True,
        example=0.2,
    )  # fmt: skip
    shift_x: float = param("I", "shift along X", default=0, modal=True, note="of Haas, without Q")
    shift_y: float = param("J", "shift along Y", default=0, modal=True, note="of Haas, without Q")
    needs = (holes.spindle_stands, shift_scaled)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        yield from super().contradictions()
        by_both = self.shift_x or self.shift_y
        if self.shift is None and not by_both:
            yield "shift", "is missing"
        if self.shift is not None and by_both:
            yield "shift", "and I J are two ways to say the shift"

    def work(self, m: Machine) -> Iterator[Step]:
        shift = (self.shift_x, self.shift_y) if self.shift is None else (-self.shift, 0.0)
        return bore_and_stop(self.bottom, above=self.r_level, dwell=self.seconds, turning=m.turning, shift=shift)


@CYCLES("G87", "Back boring", source=f"{ISO}; FANUC", triggers=POSITION, takes=f"{HOLE} shift {ENDS}")
class BackBoring(HoleCycle):
    """Off the axis by Q along -X with the spindle oriented, at rapid through the hole to level R, on the axis again up to Z.

    R lies below Z. The tool always comes back to the initial level, the way it came.
    """

    bottom: float = param("Z", "depth of the counterbore from below", modal=True, example=-10)
    r_level: float = param("R", "level R, below the workpiece", modal=True, example=-25)
    shift: float = param("Q", "shift off the axis", above=0, incremental=True, modal=True, example=0.2)
    needs = (holes.spindle_stands, not_of_linuxcnc, initial_level_alone, shift_scaled)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if not self.bottom > self.r_level:
            yield "bottom", f"must lie above level R, got Z {self.bottom:g} and R {self.r_level:g}"

    def hole(self, m: Machine) -> Iterator[Step]:
        yield Go("to the hole", x=0.0, y=0.0)
        yield from self.work(m)

    def work(self, m: Machine) -> Iterator[Step]:
        above, turning = m.programmed[2], m.turning
        yield from back_bore(
            above=above, below=self.r_level, bottom=self.bottom, eccentricity=self.shift, direction=1, angle=0.0,
            feed=None, travel=RAPID, dwell=self.seconds, turning=turning, leave=False,
        )  # fmt: skip
        yield from back_to_axis(above, turning)


@CYCLES("G88", "Boring, spindle stop, out by hand", source=f"{ISO}; FANUC", triggers=POSITION, takes=f"{HOLE} {ENDS}")
class HandBoring(HoleCycle):
    """In at feed, spindle stop, program stop: the operator draws the tool out, and the program goes on above the hole."""

    needs = (holes.spindle_stands, not_of_linuxcnc)

    def work(self, m: Machine) -> Iterator[Step]:
        return bore_and_stop(self.bottom, above=self.r_level, dwell=self.seconds, turning=m.turning, by_hand=True)

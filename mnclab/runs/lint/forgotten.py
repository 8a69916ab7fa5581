"""What a program forgot: to end compensation, to use what it got ready, the spindle, the unit of its feed, the sign of Z."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.limits import extents
from mnclab.path.listing import figure
from mnclab.path.toolpath import Kind, Mask, Toolpath
from mnclab.runs.lint.once import warn_once
from mnclab.runs.material import cutting_of
from mnclab.text.alarm import WARNING, Alarm
from mnclab.text.program import blocks_with
from mnclab.workpiece.cutting import CUTS

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine
    from mnclab.runs.run import Run


# Radius compensation that is still on when the program ends: the next program begins with it, or leaves the contour askew.

WORDS = ("G41", "G42", "RL", "RR")


def left_on(run: Run) -> Iterator[Alarm]:
    """A warning at the block that switched the compensation on, if the program came to its end under it."""
    if not run.ok or "side" not in run.history:
        return
    at, sides = run.history.log("side")
    if sides[-1] and at[-1] >= 0:
        hint = "write G40 with a move away from the contour" if "G40" in run.control.functions else "write R0, or DEP"
        yield warn_once(run, [int(at[-1])], "radius compensation is still on where the program ends", hint, *WORDS)


# What a program gets ready and never uses: a cycle that nothing calls, a tool that is changed again before it cuts.

WORK = (Kind.LINE, Kind.ARC, Kind.PROBE, Kind.DWELL, Kind.STOP)  # at a stop somebody may measure, or deburr


def unused(run: Run) -> Iterator[Alarm]:
    """A warning for the cycles, and one for the tools, of a program that came to its end; one about the setup."""
    if strange := [f"T{number}" for number in run.setup.true_tools if number not in run.tables.tools]:
        hint = "a true tool says how a tool of the table really is; write it in Setup(tools=…) too"
        message = f"the setup knows {', '.join(strange)} as true tools, which have no row in the tool table"
        yield Alarm(message, None, WARNING, hint)
    yield from _compensation(run)
    yield from _waiting(run)
    if run.ok:
        yield from _cycles(run)
        yield from _tools(run)


def _cycles(run: Run) -> Iterator[Alarm]:
    """Cycles for a call that none came to before the next definition, or the end."""
    control = run.control
    calls = {code for code, function in control.functions.items() if function.phase == "call"}
    waiting = {code for code, cycle in control.cycles.items() if cycle.runs == "call"}
    if "cycle" not in run.history or waiting.isdisjoint(run.history.log("cycle")[1]):
        return
    defines, called = (_executed(run, codes) for codes in (waiting, calls))
    called[run.toolpath.step[run.toolpath.label > 0]] = True  # patterns, and positions under a modal call, run it too
    steps = np.flatnonzero(defines)
    before = np.concatenate([[0], np.cumsum(called)])  # of a step; a call in the block of the definition counts for it
    idle = steps[before[steps] == before[np.append(steps[1:], len(called))]]
    if len(idle):
        how = "M99" if "CYCL CALL" not in calls else "CYCL CALL or M99"
        message = "a cycle is defined here and never called: it does nothing"
        yield warn_once(run, idle.tolist(), message, f"a cycle of this kind works where {how} stands")


def _compensation(run: Run) -> Iterator[Alarm]:
    """Moves beside a contour whose tool has no radius, and lies on it; the ISO mill says it at its word G41 or G42."""
    path, message = run.toolpath, "compensates nothing"
    idle = (path.side != 0) & (path.radius == 0)
    idle = idle & path.is_motion if idle.any() else idle
    if idle.any() and not any(message in alarm.message or "has no row in" in alarm.message for alarm in run.alarms):
        message = f"the radius compensation {message}: the radius of T{int(path.tool[idle][0])} is 0"
        yield warn_once(run, path.step[idle].tolist(), message, "call a tool, or give it its radius")


def _waiting(run: Run) -> Iterator[Alarm]:
    """A first move at feed without a tool, while one that T has chosen waits for its M6."""
    path = run.toolpath
    bare = path.tool == 0
    if "next tool" not in run.history or not bare.any() or not (bare := bare & np.isin(path.kind, (Kind.LINE, Kind.ARC))).any():
        return
    first = int(path.step[bare.argmax()])
    chosen = [number for step, number in run.history.changed("next tool") if step <= first][-1:]
    if chosen and chosen[0] and not any("not in the spindle" in alarm.message for alarm in run.alarms):
        message = f"the program works without a tool: T{chosen[0]} is chosen, but not in the spindle"
        yield warn_once(run, [first], message, "write M6 behind T")


def _executed(run: Run, codes: set[str]) -> Mask:
    """Which steps (s,) executed a block with one of some codes."""
    found = np.zeros(len(run.steps.block), dtype=bool)
    for index, program in enumerate(run.programs):
        blocks, here = blocks_with(program, codes), run.steps.program == index
        found |= here & blocks[np.where(here, run.steps.block, 0)] if len(blocks) else False
    return found


def _tools(run: Run) -> Iterator[Alarm]:
    """Tools that are changed again before anything is done with them; the last one may wait for the next part."""
    changes = [(step, tool.number) for step, tool in run.history.changed("tool")]
    taken = [change for k, change in enumerate(changes) if not k or change[1] != changes[k - 1][1]]
    steps = np.array([step for step, _ in taken], dtype=run.toolpath.step.dtype)  # another type would copy them all
    rows = np.searchsorted(run.toolpath.step, steps)
    pairs = zip(taken, rows[:-1].tolist(), rows[1:].tolist())
    idle = [(step, number) for (step, number), a, b in pairs if number and step >= 0 and not _works(run.toolpath, a, b)]
    if idle:
        numbers = ", ".join(dict.fromkeys(f"T{number}" for _, number in idle))
        hint = "is it the tool that was meant, and is a part of the program missing?"
        message = f"a tool is changed again before it is used ({numbers})"
        yield warn_once(run, [step for step, _ in idle], message, hint, *(f"T{number}" for _, number in idle))


def _works(path: Toolpath, first: int, stop: int) -> bool:
    """Whether rows of a path do something."""
    return bool((np.isin(path.kind[first:stop], WORK) | (path.label[first:stop] > 0)).any())


# Cutting with the spindle still: the path is right and the tool is lost, so a run says it once, where it begins.

SENTENCE = "the tool moves at feed while the spindle stands"
HINT = "a speed (S) and the sense of turning (M3 or M4) come before the first cut; setting stopped_spindle"


def still_spindle(m: Machine, path: Toolpath) -> Iterator[Alarm]:
    """A warning at the first block of a path that moves at feed without a turning spindle.

    A probe does not turn, a cycle may stop the spindle for a part of its way, and what a control has already said at
    that block (a call of the TNC 620, G95 of the JNC-T01) is not repeated.
    """
    if m.settings["stopped_spindle"] == "accept" or not len(path):
        return
    still = (path.spindle == 0) & ((path.kind == Kind.LINE) | (path.kind == Kind.ARC))
    if not still.any():
        return
    still &= ~np.isin(path.tool, [number for number, tool in m.tables.tools.items() if tool.kind == "probe"])
    stopped = (path.kind == Kind.SPINDLE) & (path.label > 0)  # labels are those of cycles
    still &= ~np.isin(path.step, path.step[stopped])
    if not still.any():
        return
    place = m.flow.span_of_step(int(path.step[np.argmax(still)]))
    said = {(alarm.span.line, alarm.span.program) for alarm in m.alarms if alarm.span and "spindle" in alarm.message}
    if place and (place.line, place.program) not in said:
        yield Alarm(SENTENCE, place, WARNING, HINT)


# A feed in mm/rev that counts mm/min: F0.1 on a lathe whose feed is one per minute (G94), as it is at power on.
# A micrometre in a turn of the spindle is no feed that anybody turns with, and such a cut would take hours. Nor is a tap fed by
# another pitch than its own: it strips the thread or breaks (the TNC 620 refuses it itself).

LEAST = 0.001  # mm a turn
MOST = 2.0  # mm/min: greater numbers are no feeds a turn
SAME = 0.01  # of a pitch: inches are written in four places


def feed_of_another_unit(run: Run) -> Iterator[Alarm]:
    """A warning for each of these feeds."""
    yield from _a_minute(run)
    yield from _of_taps(run)


def _of_taps(run: Run) -> Iterator[Alarm]:
    """A warning for the threads that a tap of known pitch cuts with another one."""
    path = run.toolpath
    if not path.synchronous.any():
        return
    threads = path.synchronous & np.isin(path.kind, (Kind.LINE, Kind.ARC)) & np.isfinite(path.per_rev)
    if not threads.any():
        return
    tools, which = run.tools_that_cut
    for number, tool in tools.items():
        mine = threads & (which == number) & (abs(path.per_rev - tool.pitch) > SAME * tool.pitch)
        if tool.kind == "tap" and tool.pitch > 0 and mine.any():
            fed, own = (figure(float(each) / path.unit.length, 4) for each in (path.per_rev[mine][0], tool.pitch))
            message = f"the tap of tool {number} has a pitch of {own} {path.unit.short} and is fed {fed} {path.unit.short} a turn"
            yield warn_once(run, path.step[mine].tolist(), message, "the feed is pitch times speed (G94), or the pitch (G95)")


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
        yield warn_once(run, path.step[slow].tolist(), message, f"G95 F{feed:g} is {feed:g} mm/rev")


# A contour that never goes below the top of the blank: Z without its sign, a datum elsewhere. All is cut in the air.
# On a lathe the same of a bar: no move comes as near to the axis as its surface. What only touches a mill's blank from the
# side may be meant, for many a blank has the sizes of the part.

NOISE = 1e-6  # mm


def above_blank(run: Run) -> Iterator[Alarm]:
    """A warning at the first move at feed, if none of them comes to where material is."""
    stock, path = run.stock, run.toolpath
    axis, least = (0, NOISE) if path.lathe else (2, -NOISE)  # a bar that is only touched is turned to its own size
    if not run.ok or stock is None or not stock.volume > 0 or not (cuts := np.isin(path.kind, CUTS)).any():
        return
    top = stock.bounds[1, axis]
    if path.end[cuts, axis].min() < top - 1:  # the mills of a table are not as much longer as this
        return
    cutting = cutting_of(run)
    cuts &= np.array([tool.kind != "probe" for tool in cutting.tools])[cutting.which]
    if not cuts.any() or cutting.tilted is not None:
        return
    low = np.minimum(extents(cutting.path)[0], cutting.path.start)  # a cut may begin where a rapid has gone down
    above = float(low[cuts, axis].min() - top)
    if above < least:
        return
    first = int(path.step[np.argmax(cuts)])
    if path.lathe:
        message = f"no move at feed comes to the bar: the nearest stays {above:.3f} mm beside it"
        yield warn_once(run, [first], message, "is X a radius or a diameter here, and the datum on the axis?")
    else:
        where = f"stays {above:.3f} mm above it" if above > NOISE else "is at it"
        message = f"no move at feed goes below the top of the blank: the lowest {where}"
        yield warn_once(run, [first], message, "depths below the top are negative, Z-5; or the blank stands too low")

"""Moves until a probe touches: G31 (skip) of Fanuc and Haas, G38.2 to G38.5 of LinuxCNC.

Where the controlled point stood goes into #5061 and the next, the coordinates X Y Z A B C of the program in its unit: the tip
of the probe, the lowest point of its ball, as it is programmed. The radius of the ball is not taken off, that is left to the
program. The part is that of the setup, the ball that of the tool in the spindle.
"""

from __future__ import annotations

import math

import numpy as np

from mnclab.controls.g43.language import parameters
from mnclab.controls.g43.language.motion import angles_of, targets
from mnclab.controls.g43.state import memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import first_word
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import angles
from mnclab.machine.machine import Machine
from mnclab.machine.touching import release, rests, unfit
from mnclab.path.listing import INCHES, MM

FUNCTIONS = FunctionTable()
TITLES = {
    "G38.2": "Probe until it touches, else an alarm", "G38.3": "Probe until it touches",
    "G38.4": "Probe until it touches no more, else an alarm", "G38.5": "Probe until it touches no more",
}  # fmt: skip
AWAY = ("G38.4", "G38.5")
STRICT = ("G38.2", "G38.4")


@FUNCTIONS("G31", "Skip: a line until the probe touches", takes="X Y Z A B C", moves=True, owns=True, modal=False,
           source="Fanuc, Haas")  # fmt: skip
def skip(m: Machine, words: Words) -> None:
    """A straight line at feed F; at the contact the rest of it is left out, without one it goes to its end. #5061 to #5063
    tell where it ended; on Fanuc #5063 with the length offset of G43, which is #5083 (setting skip_position)."""
    target = goal(m, words)
    if touches(m, words):
        m.warn("the probe touches already: G31 ends where it stands", first_word(words), "lead it away from the part before")
    elif target != m.programmed:
        probe_to(m, target, words)
    keep(m, with_length=m.settings["skip_position"] == "with_length")


@FUNCTIONS("G38.2 G38.3 G38.4 G38.5", TITLES, group="motion", takes="X Y Z A B C", moves=True, source="LinuxCNC")
def probe(m: Machine, words: Words) -> None:
    """A straight line at feed F that ends where the contact begins (G38.2, G38.3) or is lost (G38.4, G38.5). #5061 to #5066
    tell the place, #5070 is 1 for a success, else 0. It stays active: axis words alone probe again."""
    code, head = words.code, first_word(words)
    if m.per_rev and m.settings["dialect"] == "linuxcnc":
        m.alarm(f"{code} cannot stand under G95: a probe has a feed per minute (LinuxCNC)", head, hint="write G94 and F")
    target = goal(m, words)
    moves = target != m.programmed
    if not moves and code in STRICT:
        m.alarm(f"{code} leads to where the probe stands: it needs a way", head)
    touching = touches(m, words)
    found = touching != (code in AWAY)
    if found and code in STRICT:
        said = "touches already" if touching else "touches nothing"
        m.alarm(f"{code}: the probe {said} where it starts", head, "G38.4 leads it away from the part" if touching else "")
    if found:
        m.warn(f"the probe {'touches already' if touching else 'touches nothing'}: {code} ends where it stands", head)
    elif moves:
        found = probe_to(m, target, words)
    keep(m)
    m.variables[parameters.FOUND] = float(found)


def touches(m: Machine, words: Words) -> bool:
    """Whether the ball touches the part where it stands; one that has just come free of it does not."""
    return rests(m, m.tool.effective_radius, first_word(words)) and m.tip != memory(m).released


def goal(m: Machine, words: Words) -> tuple[float, float, float]:
    """Where a probe is sent, in program coordinates; an Alarm where it cannot go."""
    code, head = words.code, first_word(words)
    motion.uncompensated(m, words)
    if memory(m).machine_coordinates:
        m.alarm(f"{code} and G53 stand in one block: a probe goes to coordinates of the workpiece", head)
    if m.per_time:
        m.alarm(f"{code} cannot stand under G93: how long its way is, the part says", head, hint="write G94 and F")
    for _, sentence in unfit(m):
        m.alarm(f"{code} {sentence}", head, hint="" if m.tool.number else "write T and M6")
    turned = angles_of(m, words)
    if turned is not None and turned != angles(m):
        axis = next(axis for axis, now, then in zip("ABC", angles(m), turned, strict=True) if now != then)
        sentence = f"{code} {axis} would turn a rotary axis while the probe moves, which is not built"
        m.alarm(sentence, words[axis], hint="turn it in the block before")
    to = targets(m, words)
    if not to:
        m.alarm(f"{code} needs X, Y or Z: where the probe goes", head)
    return m.target(to.get("x"), to.get("y"), to.get("z"))


def probe_to(m: Machine, target: tuple[float, float, float], words: Words) -> bool:
    """The move of a code at the modal feed; whether it ended by what it waited for. An Alarm where the code wants that."""
    code, head, ball = words.code, first_word(words), m.tool.effective_radius
    way = math.dist(m.to_machine(target), m.tip)
    feed = m.feed_of(None, head)
    with m.within(label=code):
        if code in AWAY:
            found = release(m, target, feed, ball, head)
            memory(m).released = m.tip if found else None
        else:
            found = m.touch(*target, f=feed, ball=ball, word=head, miss="return").hit
    if not found and code in STRICT:
        what = "still touches after" if code in AWAY else "touched nothing within"
        unit = MM if m.variable_unit == 1 else INCHES
        hint = f"G38.{int(code[-1]) + 1} goes on and writes 0 into #5070"
        m.alarm(f"{code}: the probe {what} {way / unit.length:.7g} {unit.short}", head, hint)
    return found


def keep(m: Machine, with_length: bool = False) -> None:
    """Write down where the probe stands, in the unit of the program and degrees."""
    place = np.array(m.programmed)
    if with_length:
        x, y, z = memory(m).active_offsets
        if (kinematics := m.tables.kinematics) is None:
            place += np.linalg.solve(m.matrix[:3, :3], (x, y, z))
        else:  # along the tool as coordinates are reckoned with it
            along = kinematics.orientation(m.rotary if m.reckoned is None else m.reckoned)[:, 2]
            place += np.linalg.solve(m.frames.matrix[:3, :3], along * z + (x, y, 0.0))
    for name, value in zip(parameters.PLACE, (*(place / m.variable_unit).tolist(), *angles(m)), strict=True):
        m.variables[name] = value

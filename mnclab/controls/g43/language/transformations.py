"""Rotation, scaling and mirror image: G68, G69, G50, G51, G50.1, G51.1.

A programmed point is scaled, then turned, then mirrored, and then come the shifts and the work offset. So a rotation that is
switched on under a scale turns about the scaled centre, and under a mirror image the other way round, as Fanuc's manual
has both. Switching moves nothing: the tip stays, and the coordinates of the tool are read anew.
"""

from __future__ import annotations

import math
from collections.abc import Collection

from mnclab.controls.g43.language.numbers import has_point
from mnclab.controls.g43.remarks import ISO
from mnclab.controls.g43.state import Doubt, memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES, CENTRE, first_word
from mnclab.geometry import frames
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import PLANES
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
CODES = {"mirror": "G51.1", "rotation": "G68", "scaling": "G51"}
ENDS = {"mirror": "G50.1", "rotation": "G69", "scaling": "G50"}
ROTATION = {"G68": "Rotation on", "G69": "Rotation off"}
SCALING = {"G51": "Scaling on", "G50": "Scaling off"}
MIRROR = {"G51.1": "Mirror image on", "G50.1": "Mirror image off"}
SAME = 1e-9
DOUBTFUL = 0.05  # a scale of fewer thousandths is more likely a factor as other makers have it
MOST = 1e6  # the greatest factor; its inverse is the least


def transformed(m: Machine) -> str:
    """The code of a transformation that is active; none: nothing."""
    return next((code for name, code in CODES.items() if name in m.frames), "")


def refuse_transformed(m: Machine, words: Words, *others: str) -> None:
    """An Alarm while one of some transformations is active, by default any."""
    for name in others or CODES:
        if name in m.frames:
            message = f"{words.code} cannot stand while {CODES[name]} is active"
            m.alarm(message, first_word(words), hint=f"write {ENDS[name]} first")


def switch(m: Machine, name: str, frame: frames.Matrix | None, words: Words) -> None:
    """Replace a transformation. Coordinates that are other ones then are doubted until a motion names them."""
    motion.uncompensated(m, words)
    before = m.programmed
    m.set_frame(name, frame)
    other = "".join(AXES[k] for k in range(3) if abs(before[k] - m.programmed[k]) > SAME)
    memory(m).doubt = Doubt(other, words.code, m.tip) if other else None


def settle_doubt(m: Machine, words: Words, to: Collection[str]) -> None:
    """Warn where the first motion after a switch goes `to` one of the axes concerned and not to others: makers differ there."""
    doubt = memory(m).doubt
    if doubt is None or not to:
        return
    axes = doubt.axes.lower()
    missing = "".join(axis for axis in axes if axis not in to).upper()
    if m.tip == doubt.tip and len(missing) == len(axes):
        return
    memory(m).doubt = None
    if m.tip == doubt.tip and missing and m.modal["dimension"] == "G90":
        sentence = f"{' '.join(missing)} is not written in the first motion after {doubt.code}: the tool keeps its place there"
        m.warn(sentence, first_word(words), hint="makers differ: write all axes of the plane")


def centre(m: Machine, words: Words, name: str) -> list[float]:
    """The fixed point of a transformation, in the system outside it; axes that are not written: where the tool stands."""
    outside = m.frames.before(name)
    found: list[float] = frames.apply(frames.inverse(outside), m.tip).tolist()
    for k, axis in enumerate(AXES):
        if axis in words:
            found[k] = m.length(words[axis])
    return found


@FUNCTIONS("G68", ROTATION, group="rotation", phase="transformation", takes="X Y Z R", still=True, owns=True, source=ISO)
def rotation(m: Machine, words: Words) -> None:
    """Turns the plane by R degrees about a point, by default where the tool stands; R adds under G91 (setting g68_increment)."""
    if "R" not in words:
        m.alarm("G68 R (angle) is missing", first_word(words))
    _, _, normal = PLANES[m.plane]
    if AXES[normal] in words:
        m.alarm(f"{AXES[normal]} is no coordinate of the plane {m.plane}", words[AXES[normal]])
    about, scaling = centre(m, words, "rotation"), m.frames["scaling"]
    for k, axis in enumerate(AXES):
        if axis in words:
            about[k] = float(scaling[k, k] * about[k] + scaling[k, 3])
    angle = m.value(words["R"])
    if m.modal["dimension"] == "G91" and m.settings["g68_increment"] == "adds":
        angle += memory(m).angle
    memory(m).angle = angle
    m.log("rotation angle", angle)
    switch(m, "rotation", frames.turn(math.radians(angle), AXES[normal].lower(), about), words)


@FUNCTIONS("G69", ROTATION, group="rotation", phase="transformation", power_on="G69", source=ISO)
def rotation_off(m: Machine, words: Words) -> None:
    """No motion."""
    memory(m).angle = 0.0
    if "rotation" in m.frames:
        m.log("rotation angle", 0.0)
        switch(m, "rotation", None, words)


def factor(m: Machine, word: Word) -> float:
    """A scale: of Fanuc a whole number counts thousandths."""
    value = m.value(word)
    if m.settings["g51_factor"] == "thousandths" and not has_point(m, word):
        value /= 1000
        if abs(value) < DOUBTFUL:
            m.warn(f"G51 {word} counts thousandths: the scale is {value:g}", word,
                   hint=f"write {word}. for {1000 * value:g}, or choose the setting g51_factor")  # fmt: skip
    if value < 0 and word.address == "P":
        m.alarm(f"G51 P (scale factor) must be greater than 0, got {value:g}", word)
    if not 1 / MOST <= abs(value) <= MOST:
        m.alarm(f"G51 {word.address} (scale factor) must be from {1 / MOST:g} to {MOST:g}, got {value:g}", word)
    return value


@FUNCTIONS("G51", SCALING, group="scaling", phase="transformation", takes="X Y Z P I J K", still=True, owns=True, source=ISO)
def scaling(m: Machine, words: Words) -> None:
    """Scales by P, or by I J K along X Y Z, about a point, by default where the tool stands; a negative factor mirrors."""
    refuse_transformed(m, words, "rotation")
    factors = [1.0, 1.0, 1.0]
    single = [(k, words[address]) for k, address in enumerate(CENTRE) if address in words]
    if "P" in words:
        if single:
            m.alarm("G51 has P and I J K in one block", single[0][1], hint="P is one factor for all axes: keep one of them")
        factors = [factor(m, words["P"])] * 3
    elif not single:
        m.alarm("G51 has no factor", first_word(words), hint="write P for all axes, or I J K for X Y Z")
    for k, word in single:
        factors[k] = factor(m, word)
    x, y, z = factors
    switch(m, "scaling", frames.scale(x, y, z, centre(m, words, "scaling")), words)


@FUNCTIONS("G50", SCALING, group="scaling", phase="transformation", power_on="G50", source=ISO)
def scaling_off(m: Machine, words: Words) -> None:
    """No motion."""
    if "scaling" in m.frames:
        switch(m, "scaling", None, words)


@FUNCTIONS("G51.1", MIRROR, group="mirror", phase="transformation", takes="X Y Z", still=True, source=ISO)
def mirror(m: Machine, words: Words) -> None:
    """X Y Z are the lines to mirror about, beside those that are active already."""
    refuse_transformed(m, words, "rotation", "scaling")
    lines = {k: m.length(words[axis]) for k, axis in enumerate(AXES) if axis in words}
    if not lines:
        m.alarm("G51.1 needs X, Y or Z: the line to mirror about", first_word(words))
    mirror_about(m, memory(m).mirrored | lines, words)


@FUNCTIONS("G50.1", MIRROR, group="mirror", phase="transformation", takes="X Y Z", still=True, power_on="G50.1", source=ISO)
def mirror_off(m: Machine, words: Words) -> None:
    """No more mirror image along the axes that are written, or along any; their values do not matter."""
    gone = [k for k, axis in enumerate(AXES) if axis in words] or [0, 1, 2]
    if "mirror" in m.frames:
        mirror_about(m, {k: line for k, line in memory(m).mirrored.items() if k not in gone}, words)


def mirror_about(m: Machine, lines: dict[int, float], words: Words) -> None:
    memory(m).mirrored = lines
    axes = "".join(AXES[k] for k in lines)
    frame = frames.mirror(axes, [lines.get(k, 0.0) for k in range(3)]) if lines else None
    switch(m, "mirror", frame, words)

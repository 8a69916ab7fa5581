"""Where coordinates count from: work offsets, the set position, rotation, scaling and mirror image."""

from __future__ import annotations

import math
from collections.abc import Collection

from mnclab.controls.g43.state import ISO, NONE, Doubt, has_point, memory, undescribed, whole
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES, CENTRE, first_word
from mnclab.geometry import frames
from mnclab.machine import axes
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import PLANES
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.text.program import Word

# Rotation, scaling and mirror image: G68, G69, G50, G51, G50.1, G51.1.
# A programmed point is scaled, then turned, then mirrored, and then come the shifts and the work offset. So a rotation that is
# switched on under a scale turns about the scaled centre, and under a mirror image the other way round, as Fanuc's manual
# has both. Switching moves nothing: the tip stays, and the coordinates of the tool are read anew.

FUNCTIONS = FunctionTable()
CODES = {"tilt": "G68.2", "mirror": "G51.1", "rotation": "G68", "scaling": "G51"}
ENDS = {"tilt": "G69", "mirror": "G50.1", "rotation": "G69", "scaling": "G50"}
ROTATION = "Rotation on"
SCALING = {"G51": "Scaling on", "G50": "Scaling off"}
MIRROR = {"G51.1": "Mirror image on", "G50.1": "Mirror image off"}
SAME = 1e-9
DOUBTFUL = 0.05  # a scale of fewer thousandths is more likely a factor as other makers have it
MOST_SCALE = 1e6  # the greatest factor; its inverse is the least


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
    refuse_transformed(m, words, "tilt")
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


def rotation_off(m: Machine, words: Words) -> None:
    """The rotation is over; no motion."""
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
    if not 1 / MOST_SCALE <= abs(value) <= MOST_SCALE:
        m.alarm(f"G51 {word.address} (scale factor) must be from {1 / MOST_SCALE:g} to {MOST_SCALE:g}, got {value:g}", word)
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


# Where coordinates count from: work offsets, machine coordinates, the local shift, the set position.
# Rows 1 to 6 of the table of datums are G54 to G59, 7 to 9 G59.1 to G59.3, and 101 on G54.1 P1 and so on. The position set by
# G92 shifts them all; the local shift of G52 counts inside it, except where a setting makes the two one register.

FURTHER, MOST = 100, 300  # G54.1 P1 is row 101; so many of them
HAAS = {f"G{n}": n - 109 for n in range(110, 130)}  # codes of the first twenty of them on a Haas
ROWS = {f"G{n}": n - 53 for n in range(54, 60)} | {f"G59.{n}": 6 + n for n in (1, 2, 3)}


def start(m: Machine) -> None:
    """G54 is active at the start, unless the setting start_datum wants none."""
    if m.settings["start_datum"] == "G54":
        select(m, 1)
    else:
        m.set_modal("datum", "")
        memory(m).row = 0


def select(m: Machine, row: int, chosen: bool = False) -> None:
    """Count from a row of the table of datums; a row that is not there is the machine's zero."""
    memory(m).row = row
    m.log("datum row", row)
    m.select_datum(m.tables.datums.get(row, Datum()), chosen=chosen)


def change(m: Machine, words: Words, row: int) -> None:
    if m.side:
        m.alarm("a work offset cannot change under radius compensation", first_word(words), hint="write G40 first")
    if m.settings["dialect"] == "linuxcnc" and row == memory(m).row:  # it is not read anew
        m.origin_chosen = True
        return
    refuse_transformed(m, words, "tilt")
    if on := transformed(m):
        m.warn(f"the work offset changes while {on} is active, which now counts from the new one", first_word(words))
    if m.settings["g92_lasts"] == "ends":
        set_shift(m, registers(m)[0], NONE)
    select(m, row, chosen=True)


@FUNCTIONS("G54 G55 G56 G57 G58 G59", "Work offset", group="datum", phase="frames", power_on="G54", source="7.1, example")
@FUNCTIONS("G59.1 G59.2 G59.3", "Work offset", group="datum", phase="frames", source="LinuxCNC")
def work_offset(m: Machine, words: Words) -> None:
    """Rows 1 to 6 of the datum table, on LinuxCNC 7 to 9 too; a row that is not there is the machine's zero."""
    change(m, words, ROWS[words.code])


@FUNCTIONS("G54.1 G154", "Further work offset", group="datum", phase="frames", takes="P", source="Fanuc, Haas")
def further_offset(m: Machine, words: Words) -> None:
    """P1 to P300: rows 101 to 400 of the datum table."""
    change(m, words, FURTHER + whole(m, words, "P", 1, MOST))


@FUNCTIONS(" ".join(HAAS), {code: f"Further work offset, G154 P{number}" for code, number in HAAS.items()}, group="datum",
           phase="frames", source="Haas")  # fmt: skip
def numbered_offset(m: Machine, words: Words) -> None:
    """Rows 101 to 120 of the datum table."""
    change(m, words, FURTHER + HAAS[words.code])


@FUNCTIONS("G53", "Machine coordinates", phase="frames", modal=False, source=ISO)
def machine_coordinates(m: Machine, words: Words) -> None:
    """In this block, coordinates are those of the spindle reference: no offset counts."""
    undescribed(m, words)
    motion.uncompensated(m, words)
    if m.modal["dimension"] == "G91" and (choice := m.settings["g53_increment"]) != "absolute":
        if choice == "refuse":
            m.alarm("G53 cannot stand under G91", first_word(words), hint="setting g53_increment")
        m.warn("G53 counts for nothing under G91: the block moves by its increments", first_word(words))
        return
    motion.leave_frames(m, [name for name, _ in m.frames])
    if m.tables.kinematics is not None:
        axes.reckon_here(m, (0.0, 0.0, 0.0))
    m.set_frame("length", frames.shift(z=-m.tool.effective_length))


# --- shifts of all work offsets ---------------------------------------------------------------------------------------


def shift_of(m: Machine, name: str) -> list[float]:
    found: list[float] = m.frames[name][:3, 3].tolist()
    return found


def set_shift(m: Machine, name: str, place: list[float] | tuple[float, ...]) -> None:
    m.set_frame(name, frames.shift(*place) if any(place) else None)


def registers(m: Machine) -> tuple[str, str]:
    """The frames of G92 and of G52."""
    return ("set", "local") if m.settings["g52_g92"] == "apart" else ("set", "set")


@FUNCTIONS("G52", "Local shift", phase="local", takes="X Y Z", still=True, owns=True, modal=False, source=ISO)
def local_shift(m: Machine, words: Words) -> None:
    """The origin moves so far from that of the work offset; an axis that is not written keeps its shift. No motion."""
    undescribed(m, words)
    motion.uncompensated(m, words)
    refuse_transformed(m, words)
    name = registers(m)[1]
    place = shift_of(m, name)
    for k, axis in enumerate(AXES):
        if axis in words:
            place[k] = m.length(words[axis])
    set_shift(m, name, place)


@FUNCTIONS("G92", "Set position", phase="local", takes="X Y Z", still=True, owns=True, modal=False, source=ISO)
def set_position(m: Machine, words: Words) -> None:
    """The present point has these coordinates, in all work offsets; the local shift of these axes is over. No motion."""
    undescribed(m, words)
    motion.uncompensated(m, words)
    refuse_transformed(m, words)
    written = [(k, axis) for k, axis in enumerate(AXES) if axis in words]
    if not written:
        m.alarm("G92 needs X, Y or Z: the coordinates that the present point is to have", first_word(words))
    of_g92, of_g52 = registers(m)
    place, local, here = shift_of(m, of_g92), shift_of(m, of_g52), m.programmed
    for k, axis in written:
        place[k] += here[k] - m.length(words[axis])
        if of_g52 != of_g92:
            place[k] += local[k]
            local[k] = 0.0
    if of_g52 != of_g92:
        set_shift(m, of_g52, local)
    set_shift(m, of_g92, place)
    memory(m).set_aside = None


@FUNCTIONS("G92.1", "Set position off", phase="local", takes="X Y Z", still=True, modal=False, source=ISO)
def set_position_off(m: Machine, words: Words) -> None:
    """The shifts of G92 and G52 are over, of the axes that are written or, without any, of all. No motion."""
    motion.uncompensated(m, words)
    refuse_transformed(m, words)
    axes = [k for k, axis in enumerate(AXES) if axis in words] or [0, 1, 2]
    for k in axes:
        if AXES[k] in words and m.value(words[AXES[k]]) != 0:
            m.alarm(f"G92.1 {AXES[k]} must be 0: it names the axis", words[AXES[k]])
    for name in dict.fromkeys(registers(m)):
        set_shift(m, name, [0.0 if k in axes else value for k, value in enumerate(shift_of(m, name))])
    memory(m).set_aside = None


@FUNCTIONS("G92.2 G92.3", {"G92.2": "Set position aside", "G92.3": "Set position back"}, phase="local", still=True, modal=False,
           source="LinuxCNC")  # fmt: skip
def set_position_aside(m: Machine, words: Words) -> None:
    """G92.2: the shift of G92 counts no more, but is kept; G92.3: it counts again. No motion."""
    motion.uncompensated(m, words)
    refuse_transformed(m, words)
    name, kept = registers(m)[0], memory(m)
    if words.code == "G92.2":
        x, y, z = shift_of(m, name)
        kept.set_aside = (x, y, z) if (x, y, z) != NONE else kept.set_aside
        set_shift(m, name, NONE)
    elif kept.set_aside is not None:
        set_shift(m, name, kept.set_aside)

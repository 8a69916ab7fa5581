"""Tilted working planes and the led tip: G68.2 to G68.4, G53.1, G69, G43.4; as Haas has them G268, G253, G269, G234.

The plane stands still on the part: coordinates are reckoned with the rotary axes as they stand (`machine.axes`), and G53.1 turns
the tool square to it. Under G43.4 the tip is led along the programmed line while rotary axes turn.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from mnclab.controls.g43.language.offsets import refuse_transformed, rotation_off
from mnclab.controls.g43.language.tools import place, want
from mnclab.controls.g43.state import memory, whole
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES, CENTRE, first_word
from mnclab.geometry import frames
from mnclab.geometry.frames import Matrix
from mnclab.geometry.kinematics import shorter
from mnclab.machine import axes
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import INF, Machine

FUNCTIONS = FunctionTable()
TILT = "tilt"
SOURCE = "Fanuc"
LINUXCNC = "LinuxCNC has it as a remap of some machines alone: choose the dialect fanuc or haas"
ORDERS = ("123", "132", "213", "231", "312", "321")
TITLES = {"G68.2": "Tilted working plane", "G268": "Tilted working plane (Haas)", "G68.4": "Tilted working plane on top of one"}
FLAT = 1e-9  # the sine of an angle below which directions are one
ZERO = (0.0, 0.0, 0.0)


def check(m: Machine, words: Words) -> None:
    """An Alarm where nothing tilts: without rotary axes, under compensation, on LinuxCNC."""
    if m.settings["dialect"] == "linuxcnc":
        m.alarm(f"{words.code} is refused: {LINUXCNC}", first_word(words))
    if m.tables.kinematics is None:
        hint = 'Setup(kinematics="table-ac"), or mnclab.Kinematics'
        m.alarm(f"{words.code} needs a machine whose rotary axes are known", first_word(words), hint)
    motion.uncompensated(m, words)


def numbers(m: Machine, words: Words, addresses: Iterable[str], length: bool = False) -> list[float]:
    """The numbers of some addresses; 0 where one is not written."""
    of = m.length if length else m.value
    return [of(words[each]) if each in words else 0.0 for each in addresses]


@FUNCTIONS("G68.2", TITLES, group="rotation", phase="transformation", takes="X Y Z I J K P Q R", still=True, owns=True,
           source=SOURCE)  # fmt: skip
@FUNCTIONS("G68.4", TITLES, group="rotation", phase="transformation", takes="X Y Z I J K P Q R", still=True, owns=True,
           source=SOURCE)  # fmt: skip
def tilted(m: Machine, words: Words) -> None:
    """The plane through X Y Z of the work offset, tilted: P0 by I J K about Z, X', Z'' (Euler), P1 about X, Y, Z in the order Q,
    P2 through the three points Q1 to Q3, P3 by two directions Q1 and Q2, P4 by I and J seen along Y and X, and K within the
    plane. G68.4 counts from the plane that is active. No axis moves."""
    check(m, words)
    further = words.code == "G68.4"
    if further and TILT not in m.frames:
        m.alarm("G68.4 counts from a tilted plane, and none is active", first_word(words), hint="write G68.2")
    if not further and TILT in m.frames and not memory(m).plane_points:
        m.alarm("G68.2 cannot stand while a tilted plane is active", first_word(words), hint="write G69 first, or G68.4")
    refuse_transformed(m, words, "mirror", "rotation", "scaling")
    way = whole(m, words, "P", 0, 4) if "P" in words else 0
    if way in (2, 3):
        if (plane := by_blocks(m, words, way)) is None:
            return
    else:
        if "R" in words:
            m.alarm(f"{words.code} R (angle within the plane) belongs to P2, and to G68.3", words["R"])
        if "Q" in words and way != 1:
            m.alarm(f"{words.code} Q (order of the rotations) belongs to P1, the blocks of P2 and P3", words["Q"])
        plane = frames.shift(*numbers(m, words, AXES, length=True)) @ by_angles(m, words, way)
    set_plane(m, m.frames[TILT] @ plane if further else plane, words)


@FUNCTIONS("G268", TITLES, group="rotation", phase="transformation", takes="X Y Z I J K Q", still=True, owns=True, source="Haas")
def tilted_of_haas(m: Machine, words: Words) -> None:
    """The plane through X Y Z of the work offset, turned by I J K about the fixed axes X, Y, Z in the order Q, else Q321."""
    check(m, words)
    if TILT in m.frames:
        m.alarm("G268 cannot stand while a tilted plane is active", first_word(words), hint="write G269 first")
    refuse_transformed(m, words, "mirror", "rotation", "scaling")
    if "Q" not in words and sum(map(bool, numbers(m, words, CENTRE))) > 1:
        m.warn("G268 without Q turns about Z, then Y, then X", first_word(words), hint="write Q321")
    set_plane(m, frames.shift(*numbers(m, words, AXES, length=True)) @ in_order(m, words, "321"), words)


def by_angles(m: Machine, words: Words, way: int) -> Matrix:
    """The turn of P0, P1 or P4."""
    i, j, k = map(math.radians, numbers(m, words, CENTRE))
    if way == 0:  # Euler: about Z, the new X, the new Z
        return frames.euler(i, j, k)
    if way == 1:
        if "Q" not in words:
            m.alarm(f"{words.code} P1 Q (order of the rotations) is missing", first_word(words), hint="Q123 is X, then Y, then Z")
        return in_order(m, words, "123")
    if abs(math.cos(i)) < FLAT or abs(math.cos(j)) < FLAT:
        m.alarm(f"{words.code} P4 I and J (angles of the plane) must not be a quarter turn", first_word(words))
    # In the plane lie a line over X that falls by I about Y, and one over Y that rises by J about X; X' is the first one.
    return frames.projected(i, j, k)


def in_order(m: Machine, words: Words, usual: str) -> Matrix:
    """Turns by I, J, K about the fixed axes X, Y, Z, one after the other."""
    order = usual
    if "Q" in words:
        order = f"{m.value(words['Q']):g}"
        if order not in ORDERS:
            m.alarm(f"{words.code} Q (order of the rotations) must be one of {', '.join(ORDERS)}, got {order}", words["Q"])
    found, angles = np.eye(4), numbers(m, words, CENTRE)
    for digit in order:
        k = int(digit) - 1
        found = frames.turn(math.radians(angles[k]), "xyz"[k]) @ found
    return found


def by_blocks(m: Machine, words: Words, way: int) -> Matrix | None:
    """P2 and P3 stand in several blocks, Q0 to Q3 or Q1 and Q2; the plane, once its last one is there."""
    number = whole(m, words, "Q", 0 if way == 2 else 1, 3 if way == 2 else 2)
    kept = memory(m)
    if kept.plane_points and kept.plane_points[0] != way:
        m.alarm(f"{words.code} P{way} stands among the blocks of P{kept.plane_points[0]}", words["P"])
    points = dict(kept.plane_points[1]) if kept.plane_points else {}
    directed = way == 3
    addresses = CENTRE if directed else AXES
    if missing := [each for each in addresses if each not in words] if number or directed else []:
        m.alarm(f"{words.code} P{way} Q{number} needs {' '.join(missing)}", first_word(words))
    strange = [each for each in ("R", *(CENTRE if not directed else AXES if number == 2 else ())) if each in words]
    if strange and not (strange == ["R"] and way == 2 and number == 0):
        m.alarm(f"{words.code} P{way} Q{number} takes no {strange[0]}", words[strange[0]])
    points[number] = numbers(m, words, addresses, length=not directed)
    if directed and number == 1:
        points[0] = numbers(m, words, AXES, length=True)
    if not directed and number == 0:
        points[-1] = [math.radians(m.value(words["R"])) if "R" in words else 0.0, 0.0, 0.0]
    kept.plane_points = (way, points)
    last = {1, 2, 3} if way == 2 else {1, 2}
    if not last <= points.keys():
        return None
    kept.plane_points = None
    found = {key: np.array(value) for key, value in points.items()}
    zero = np.zeros(3)
    if directed:
        if abs(found[1] @ found[2]) > 1e-3 * np.linalg.norm(found[1]) * np.linalg.norm(found[2]):
            m.alarm(f"{words.code} P3 directions Q1 (X) and Q2 (Z) must be square to each other", first_word(words))
        turned = checked(m, words, found[1], np.cross(found[2], found[1]))
        return frames.shift(*found[0]) @ turned
    turned = checked(m, words, found[2] - found[1], found[3] - found[1])
    inside = frames.shift(*found.get(0, zero)) @ frames.turn(float(found.get(-1, zero)[0]), "z")
    return frames.shift(*found[1]) @ turned @ inside


def checked(m: Machine, words: Words, along: np.ndarray, beside: np.ndarray) -> Matrix:
    """The basis of two directions; an Alarm where they give none."""
    if not frames.spans(along, beside):
        m.alarm(f"{words.code} describes no plane: its points or directions lie on one line", first_word(words))
    return frames.along_and_normal(along, np.cross(along, beside))


@FUNCTIONS("G68.3", "Tilted working plane square to the tool", group="rotation", phase="transformation", takes="X Y Z R",
           still=True, owns=True, source=SOURCE)  # fmt: skip
def square_to_tool(m: Machine, words: Words) -> None:
    """Z of the plane lies along the tool, X square to it and to Z of the machine, turned by R about it; the origin is X Y Z, all
    of them, else where the tool stands. No axis moves."""
    check(m, words)
    if TILT in m.frames:
        m.alarm("G68.3 cannot stand while a tilted plane is active", first_word(words), hint="write G69 first")
    refuse_transformed(m, words, "mirror", "rotation", "scaling")
    written = [axis for axis in AXES if axis in words]
    if written and len(written) < 3:
        m.alarm("G68.3 needs X, Y and Z, or none of them", words[written[0]])
    whole = m.frames.before(TILT)
    origin = numbers(m, words, AXES, length=True) if written else frames.apply(frames.inverse(whole), m.tip).tolist()
    outside = whole[:3, :3]
    z = np.linalg.solve(outside, axes.direction(m))
    z /= np.linalg.norm(z)
    x = np.cross([0.0, 0.0, 1.0], z)
    turned = frames.along_and_normal(x, z) if np.linalg.norm(x) > FLAT else np.eye(4)
    within = frames.turn(math.radians(m.value(words["R"])) if "R" in words else 0.0, "z")
    set_plane(m, frames.shift(*origin) @ turned @ within, words)


def set_plane(m: Machine, plane: Matrix, words: Words) -> None:
    """From now on coordinates count in a plane that stands still on the part."""
    if m.reckoned is not None:
        count_at(m, m.rotary)
    m.set_frame(TILT, plane)


def count_at(m: Machine, angles: tuple[float, float, float]) -> None:
    """Coordinates are reckoned with the rotary axes at A, B, C, rad, and a tool hangs by what its offset leaves out."""
    axes.reckon(m, angles)
    place(m, "tip")


@FUNCTIONS("G69", "Rotation off", group="rotation", phase="transformation", power_on="G69", source="ISO meaning")
@FUNCTIONS("G269", "Tilted working plane off (Haas)", group="rotation", phase="transformation", source="Haas")
def plane_off(m: Machine, words: Words) -> None:
    """The end of a rotation and of a tilted plane. No axis moves."""
    memory(m).plane_points = None
    if TILT in m.frames:
        motion.uncompensated(m, words)
        m.set_frame(TILT, None)
        if m.reckoned is not None:
            count_at(m, ZERO)
    elif words.code == "G69":
        rotation_off(m, words)


@FUNCTIONS("G53.1", "Tool square to the tilted plane", phase="motion", takes="P", modal=False, source=SOURCE)
@FUNCTIONS("G253", "Tool square to the tilted plane (Haas)", phase="motion", modal=False, source="Haas")
def square(m: Machine, words: Words) -> None:
    """The rotary axes turn at rapid, of two ways the shorter; P1 that with the tilting axis at or above 0, P2 at or below. The
    linear axes stand; under G43.4 the tip does."""
    check(m, words)
    if TILT not in m.frames:
        m.alarm(f"{words.code} needs a tilted plane", first_word(words), hint="write G68.2, on a Haas G268, before it")
    wanted = whole(m, words, "P", 0, 2) if "P" in words else 0
    kinematics, now = axes.chain(m), np.array([m.rotary])
    plane = m.frames.before(TILT) @ m.frames[TILT]
    z = plane[:3, 2] / np.linalg.norm(plane[:3, 2])
    both = kinematics.solutions(z, now)
    tilting = kinematics.tilting()[-1]
    if wanted:
        sign = 1 if wanted == 1 else -1
        both[sign * both[..., tilting.number] < -FLAT] = np.nan
    a, b, c = shorter(both, now)[0].tolist()
    if math.isnan(a):
        x, y, w = z.tolist()
        sense = f" with {tilting.name} {'at or above' if wanted == 1 else 'at or below'} 0" if wanted else ""
        m.alarm(f"{words.code}: no position of {' and '.join(kinematics.names)} within the limits{sense} turns the tool to "
                f"({x:.6g}, {y:.6g}, {w:.6g})", first_word(words))  # fmt: skip
    to = math.degrees(a), math.degrees(b), math.degrees(c)
    led = m.reckoned is None
    if max(abs(new - old) for new, old in zip((a, b, c), m.rotary, strict=True)) > axes.STILL:
        axes.turn_axes(m, to, INF, first_word(words))
    if not led:
        count_at(m, m.rotary)


# The led tip: G43.4, and G234 of Haas.

LED = {"G43.4": "The tip is led", "G234": "The tip is led (Haas)"}


@FUNCTIONS("G43.4", LED, group="length compensation", phase="length", source=SOURCE)
@FUNCTIONS("G234", LED, group="length compensation", phase="length", source="Haas")
def led(m: Machine, words: Words) -> None:
    """The tip follows the programmed line on the part, while rotary axes turn; the length is that of H, and G49 ends it."""
    check(m, words)
    kept = memory(m)
    kept.sign = 1
    want(m, first_word(words))
    kept.active_offsets = kept.wanted_offsets
    x, y, z = kept.active_offsets
    if max(abs(x), abs(y), abs(z - m.tool.effective_length)) > FLAT:
        number = kept.corrector if kept.length_corrector is None else kept.length_corrector
        told = f"{words.code} leads the tip of T{m.tool.number}, {m.tool.effective_length:g} mm long, and H{number} says {z:g}"
        m.alarm(told, first_word(words), hint=f"write H{m.tool.number}; another point than the tip is not led")
    m.set_frame("length", None)
    axes.reckon(m, None)

"""Where coordinates count from: polar ones, scaling, mirror image, rotation, and the datum function G147 (MNC, chapter 2)."""

from __future__ import annotations

import math
from typing import Any

from mnclab.controls.mnc.language import PolarPosition, absolute, memory
from mnclab.controls.word_address.motion import AXES, as_a_line, coordinates, first_word, helix, uncompensated
from mnclab.geometry import frames
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import PLANES
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum

# Polar coordinates (MNC 2.8): G16 sets a pole, G10 to G13 move like G0 to G3 to a radius R and an angle A.
# R and A are kept from block to block; under G91 they are added to those of the last position, which a Cartesian block may
# have made. In the plane of G17, G18 or G19 the angle counts from the first axis to the second: XY from +X, ZX from +Z, YZ
# from +Y.

FUNCTIONS = FunctionTable()
ENDS = set("RAKXYZ")  # words that make a block move
STRAIGHT = {"G10": "Rapid positioning, polar", "G11": "Linear interpolation, polar"}
ARCS = {"G12": "Circular interpolation clockwise, polar", "G13": "Circular interpolation counter-clockwise, polar"}
CARTESIAN = {"G10": "G0", "G11": "G1", "G12": "G2", "G13": "G3"}
ON_CENTRE = 0.01  # mm within which the pole is the centre of an arc (MNC-G12-K)


def polar_of(m: Machine, pole: tuple[float, float]) -> tuple[float, float]:
    """Radius and angle (degrees, in (-180, 180]) of the programmed point about a pole; angle 0 at the pole."""
    first, second, _ = PLANES[m.plane]
    u, v = m.programmed[first] - pole[0], m.programmed[second] - pole[1]
    return math.hypot(u, v), math.degrees(math.atan2(v, u)) if u or v else 0.0


@FUNCTIONS("G16", "Polar coordinates on", group="polar", phase="frames", takes="X Y Z", still=True, source="2.8.5")
def polar_on(m: Machine, words: Words) -> None:
    """X Y Z are the pole, absolute; a coordinate not written is 0. No motion.

    By the setting g16_pole under G91 the pole counts from the last programmed point.
    """
    uncompensated(m, words)
    first, second, normal = PLANES[m.plane]
    if AXES[normal] in words:
        m.alarm(f"{AXES[normal]} is no coordinate of the plane {m.plane}", words[AXES[normal]])
    from_point = m.settings["g16_pole"] == "incremental" and not absolute(m)
    u, v = (
        (m.value(words[AXES[k]]) if AXES[k] in words else 0.0) + (m.programmed[k] if from_point else 0.0)
        for k in (first, second)
    )
    m.pole = (u, v)
    m.log("pole", m.pole)
    memory(m).polar = PolarPosition(*polar_of(m, m.pole), m.programmed)


@FUNCTIONS("G15", "Polar coordinates off", group="polar", phase="frames", power_on="G15", source="2.8.5")
def polar_off(m: Machine, words: Words) -> None:
    """The pole is forgotten; a modal polar motion falls back to the Cartesian one (MNC-POLAR-CART)."""
    if m.pole is not None:
        m.log("pole", None)
    m.pole = memory(m).polar = None
    motion = m.modal["motion"]
    m.set_modal("motion", CARTESIAN.get(motion, motion))


def target(m: Machine, words: Words) -> dict[str, Any]:
    """The end of a polar block as arguments of a verb; an Alarm without a pole."""
    head = first_word(words)
    if m.pole is None:
        m.alarm(f"{m.modal['motion']} needs a pole", head, hint="write G16 first")
    if memory(m).machine_coordinates:
        m.alarm("G53 takes X Y Z, not a radius and an angle", head)
    last = memory(m).polar
    assert last is not None
    radius, angle, place = last
    if not absolute(m) and m.programmed != place:  # the last position was not given by R and A
        radius, angle = polar_of(m, m.pole)
    if "R" in words:
        radius = m.value(words["R"]) + (0.0 if absolute(m) else radius)
        if radius < 0:
            m.alarm(f"R (polar radius) must be at least 0, got {radius:g}", words["R"])
    if "A" in words:
        angle = m.value(words["A"]) + (0.0 if absolute(m) else angle)
    first, second, _ = (AXES[k] for k in PLANES[m.plane])
    to = coordinates(m, words, absolute(m))  # of the third axis
    for axis in (first, second):
        if axis in words:
            m.alarm(f"{m.modal['motion']} does not take {axis}: its end is given by R and A", words[axis])
    turned = math.radians(angle)
    to[first.lower()] = m.pole[0] + radius * math.cos(turned)
    to[second.lower()] = m.pole[1] + radius * math.sin(turned)
    memory(m).polar = PolarPosition(radius, angle, m.target(**{axis: to.get(axis) for axis in "xyz"}))
    return to


@FUNCTIONS("G10 G11", STRAIGHT, group="motion", takes="R A X Y Z", moves=True, source="2.8.5")
def polar_straight(m: Machine, words: Words) -> None:
    """Like G0 and G1, to radius R and angle A about the pole: a straight line, not a spiral."""
    if not words.keys() & ENDS:
        return
    if words.code == "G10":
        m.rapid(**target(m, words))
    else:
        m.line(**target(m, words), word=first_word(words))


@FUNCTIONS("G12 G13", ARCS, group="motion", takes="R A K X Y Z", moves=True, source="2.8.5")
def polar_arc(m: Machine, words: Words) -> None:
    """An arc of radius K: about the pole if that fits, else below 180 degrees for K > 0 and above for K < 0.

    Without K a straight line, as G2 and G3 without a centre (MNC-G12-NOK). Settings polar_arc, polar_arc_without_k.
    """
    if not words.keys() & ENDS:
        return
    begin = polar_of(m, m.pole or (0.0, 0.0))[0]
    to = target(m, words)
    if "K" not in words and m.settings["polar_arc_without_k"] == "line":
        as_a_line(m, words, "K")
        m.line(**to, word=first_word(words))
        return
    last = memory(m).polar
    assert m.pole is not None and last is not None
    word, sense = words.get("K", words.words[0]), -1 if words.code == "G12" else 1
    first, second, normal = PLANES[m.plane]
    radius = m.value(word) if "K" in words else begin
    if radius == 0 and "K" in words:
        m.alarm("K (radius of the arc) must not be 0", word)
    if AXES[normal] in words:
        helix(m, words)
    end, by_sign = last.radius, m.settings["polar_arc"] == "sign" and "K" in words
    fits = max(abs(begin - abs(radius)), abs(end - abs(radius))) <= ON_CENTRE
    if "K" not in words or (fits and not by_sign):
        m.arc(**to, sense=sense, centre={first: m.pole[0], second: m.pole[1]}, word=word, tolerance=2 * ON_CENTRE)
    elif last.place == m.programmed:
        needed = "G2 or G3 with its centre" if by_sign else "K equal to the polar radius"
        m.alarm(f"a full circle needs {needed}", word)
    else:
        m.arc(**to, sense=sense, radius=radius, word=word)


# Scaling, mirror image and rotation (MNC 2.9), and the datum function G147 (2.10).
# A programmed point is scaled about the origin, then mirrored, then turned, whatever the order of programming; then come the
# local shift of G92 and the work offset. Switching moves nothing and keeps the programmed coordinates: the next motion
# takes the whole programmed point through the new transformation, so that an axis which is not written may still move.
# Settings: transformation_order, switch_keeps.

SCALING = {"G36": "Scaling off", "G37": "Scaling on"}
ROTATION = {"G38": "Rotation off", "G39": "Rotation on"}
MIRROR = {"G50": "Mirror image off", "G51": "Mirror image on"}
NORMAL = {"XY": ("z", 1), "ZX": ("y", 1), "XZ": ("y", -1), "YZ": ("x", 1)}  # and the sense from first to second axis


def axis_values(m: Machine, words: Words) -> dict[int, float]:
    """The axis words of a block by axis number; never incremental."""
    return {k: m.value(words[axis]) for k, axis in enumerate(AXES) if axis in words}


def switch(m: Machine, name: str, frame: frames.Matrix | None, words: Words) -> None:
    """Replace a transformation; the radius must not be compensated meanwhile."""
    uncompensated(m, words)
    if m.settings["transformation_order"] == "nested":
        m.frames.innermost(name)
    m.set_frame(name, frame, keep=m.settings["switch_keeps"])


@FUNCTIONS("G37", SCALING, group="scaling", phase="frames", takes="X Y Z", still=True, source="2.9.1")
def scaling(m: Machine, words: Words) -> None:
    """Factors of the axes about the origin, signs ignored; an axis not written has factor 1 (setting g37_omitted)."""
    factors = m.frames["scaling"].diagonal().tolist() if m.settings["g37_omitted"] == "kept" else [1.0, 1.0, 1.0, 1.0]
    for k, factor in axis_values(m, words).items():
        if factor == 0:
            m.alarm(f"G37 {AXES[k]} (scale factor) must not be 0", words[AXES[k]])
        factors[k] = abs(factor)
    switch(m, "scaling", frames.scale(*factors[:3]), words)


@FUNCTIONS("G51", MIRROR, group="mirror", phase="frames", takes="X Y Z", still=True, source="2.9.2")
def mirror(m: Machine, words: Words) -> None:
    """X Y Z are the lines to mirror about; an axis not written is not mirrored."""
    lines = axis_values(m, words)
    if not lines:
        m.warn("G51 without coordinates mirrors nothing", first_word(words))
    axes = "".join("xyz"[k] for k in lines)
    switch(m, "mirror", frames.mirror(axes, [lines.get(k, 0.0) for k in range(3)]), words)


@FUNCTIONS("G39", ROTATION, group="rotation", phase="frames", takes="X Y Z A", still=True, source="2.9.3")
def rotation(m: Machine, words: Words) -> None:
    """Turn the active plane by A degrees about a pole, the origin where it is not written."""
    if "A" not in words:
        m.alarm("G39 A (angle) is missing", first_word(words))
    normal = PLANES[m.plane][2]
    if AXES[normal] in words:
        m.alarm(f"{AXES[normal]} is no coordinate of the plane {m.plane}", words[AXES[normal]])
    pole = axis_values(m, words)
    axis, sense = NORMAL[m.plane]
    angle = sense * math.radians(m.value(words["A"]))
    switch(m, "rotation", frames.turn(angle, axis, [pole.get(k, 0.0) for k in range(3)]), words)


@FUNCTIONS("G50", MIRROR, group="mirror", phase="frames", power_on="G50", source="2.9")
@FUNCTIONS("G38", ROTATION, group="rotation", phase="frames", power_on="G38", source="2.9")
@FUNCTIONS("G36", SCALING, group="scaling", phase="frames", power_on="G36", source="2.9")
def transformation_off(m: Machine, words: Words) -> None:
    """No motion; the programmed coordinates stay."""
    switch(m, str(m.control.functions[words.code].group), None, words)


@FUNCTIONS("G54 G55 G56 G57 G58 G59", "Work offset", group="datum", phase="frames", source="2.7")
def work_offset(m: Machine, words: Words) -> None:
    """Rows 1 to 6 of the datum table; cancels G92. No motion."""
    select_row(m, int(words.code[1:]) - 53)


@FUNCTIONS("G147, G247", "Activate a datum", group="datum", phase="frames", takes="Q", source="2.10")
def activate_datum(m: Machine, words: Words) -> None:
    """Rows 1 to 6 of the datum table are G54 to G59; cancels G92. No motion."""
    if words.code == "G247":
        m.warn("G247 is another name of G147", first_word(words))
    if "Q" not in words:
        m.alarm(f"{words.code} Q (datum number) is missing", first_word(words))
    row = m.value(words["Q"])
    if row != int(row) or row < 1:
        m.alarm(f"{words.code} Q (datum number) must be a whole number from 1, got {row:g}", words["Q"])
    if row > m.settings["datum_rows"] and int(row) not in m.tables.datums:
        rows = ", ".join(map(str, sorted(m.tables.datums))) or "none beyond the six of G54 to G59"
        m.alarm(f"{words.code} Q{int(row)} has no row in the datum table", words["Q"], hint=f"rows: {rows}")
    select_row(m, int(row))


def select_row(m: Machine, row: int) -> None:
    """Count from a row of the datum table; the local shift of G92 is gone."""
    if "local" in m.frames:
        m.set_frame("local", None)
    m.log("datum row", row)
    datum = m.tables.datums.get(row, Datum())
    if datum.rotation or row in memory(m).angled:  # an empty cell keeps the base rotation (MNC-BASEROT-ROW)
        m.set_frame("base rotation", frames.turn(math.radians(datum.rotation)) if datum.rotation else None)
        memory(m).base_rotation = datum.rotation
    m.select_datum(datum._replace(rotation=0.0))

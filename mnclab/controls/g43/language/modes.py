"""Modes that most blocks only stand under: what F means, exact stops, arc centres, the plane, and modes that move nothing."""

from __future__ import annotations

from dataclasses import replace

from mnclab.controls.g43.language.offsets import refuse_transformed
from mnclab.controls.g43.state import ISO, memory, remark, whole
from mnclab.controls.word_address.motion import COOLANT, FEEDS, PLANE_CODES, STOPS, first_word, functions, refuse_change
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.path.recorder import NAN

CENTRES = {"G90.1": "Arc centres from the origin", "G91.1": "Arc centres from the start"}
CONTOURS = {
    "G5": "High-speed machining", "G5.1": "Contour control", "G8": "Look-ahead", "G103": "Look-ahead limited",
    "G187": "Smoothness",
}  # fmt: skip
LINUXCNC = {
    "G5": ("on LinuxCNC it is a cubic spline, which is not built", "write lines or arcs"),
    "G5.1": ("on LinuxCNC it is a quadratic spline, which is not built", "write lines or arcs"),
    "G8": ("on LinuxCNC it makes X a radius, on a lathe", 'choose control="jnc-t01", or leave it out on a mill'),
}

SHARED = functions(remark, ISO, plane="7.1, example")
FUNCTIONS = FunctionTable()
FUNCTIONS |= SHARED
FUNCTIONS["G40"] = replace(SHARED["G40"], phase="uncompensate")  # what may not stand under compensation may stand beside it
FUNCTIONS |= {code: replace(SHARED[code], phase="blending") for code in ("G98", "G99")}
FUNCTIONS |= {code: replace(SHARED[code], group="stop") for code in ("M0", "M1", "M2", "M30")}


@FUNCTIONS("G17 G18 G19", PLANE_CODES, group="plane", phase="plane", power_on="G17", source="7.1, example")
def plane(m: Machine, words: Words) -> None:
    """The plane of arcs, radius compensation, polar coordinates and rotation."""
    if PLANE_CODES[words.code].split()[-1] != m.plane:
        refuse_transformed(m, words, "rotation")
        if memory(m).polar is not None:
            m.alarm("the plane cannot change while polar coordinates are on", first_word(words), hint="write G15 first")
    SHARED[words.code].obey(m, words)


@FUNCTIONS("G93", "Inverse time feed", group="feed mode", phase="plane", source="LinuxCNC, Haas, Fanuc")
def inverse_time(m: Machine, words: Words) -> None:
    """Every move at feed takes 1/F minutes; its block needs F."""
    if not m.per_time:
        memory(m).moves_a_minute = (m.feed or 0.0) / m.variable_unit
    m.change("feed", None)
    m.change("per_rev", False)
    m.change("per_time", True)


@FUNCTIONS("G94 G95", FEEDS, group="feed mode", phase="plane", power_on="G94", source=ISO)
def feed_mode(m: Machine, words: Words) -> None:
    """What F means, mm/min or mm/rev; a new F must follow (LinuxCNC: after each of them, though it changes nothing)."""
    if m.per_time or m.settings["dialect"] == "linuxcnc":
        m.change("feed", None)
        m.change("per_time", False)
    SHARED[words.code].obey(m, words)


@FUNCTIONS("G64", STOPS, group="blending", phase="blending", takes="P Q", power_on="G64", source=ISO)
def blending(m: Machine, words: Words) -> None:
    """No exact stops; P is how far a corner may be cut (LinuxCNC). Short moves are not joined, whatever Q allows."""
    SHARED["G64"].obey(m, words)
    m.change("tolerance", NAN)
    if "P" in words:
        if (reach := m.length(words["P"])) < 0:
            m.alarm(f"G64 P (how far a corner may be cut) must be at least 0, got {m.value(words['P']):g}", words["P"])
        m.change("tolerance", reach)
    if "Q" in words:
        m.warn("G64 Q allows that short moves are joined: they are left as they are", words["Q"])


@FUNCTIONS("G61 G61.1", STOPS | {"G61.1": STOPS["G61"]}, group="blending", phase="blending", source="ISO 6983, LinuxCNC")
def exact_stop(m: Machine, words: Words) -> None:
    """Every motion ends with exact positioning; by the setting g61 only G61.1, while G61 cuts no corner (LinuxCNC)."""
    corners = words.code == "G61" and m.settings["g61"] == "corners"
    m.change("exact", not corners)
    m.change("tolerance", 0.0 if corners else NAN)


@FUNCTIONS("G9", "Exact stop in this block", phase="plane", modal=False, source=ISO)
def exact_here(m: Machine, words: Words) -> None:
    """The motion of this block ends with exact positioning."""
    m.exact_here = True


@FUNCTIONS("G80", "Fixed cycle off", group="cycle", phase="plane", power_on="G80", ends_cycle=True, source="7.1, example")
def cycle_off(m: Machine, words: Words) -> None:
    """Ends the fixed cycle; what axis words mean after it, the setting axis_words says."""
    SHARED["G80"].obey(m, words)
    no_motion(m)


def no_motion(m: Machine) -> None:
    """On LinuxCNC axis words need a motion that is written: there is none at the start and after a cycle."""
    if m.settings["axis_words"] == "refuse":
        m.set_modal("motion", "")


def start(m: Machine) -> None:
    """What a maker has otherwise at the start: the motion, the level that cycles return to, centres from the origin."""
    no_motion(m)
    m.set_modal("return", m.settings["return_at_start"])
    if m.settings["arc_centres"] == "origin":
        m.set_modal("arc centre", "G90.1")
        memory(m).absolute_centres = True


@FUNCTIONS("G90.1 G91.1", CENTRES, group="arc centre", phase="plane", power_on="G91.1", source="LinuxCNC")
def centres(m: Machine, words: Words) -> None:
    """What I J K of arcs count from; also of Mach and other controls for routers."""
    memory(m).absolute_centres = words.code == "G90.1"


@FUNCTIONS("G97", "Spindle speed in rev/min", group="speed mode", phase="plane", power_on="G97", source=ISO)
def revolutions(m: Machine, words: Words) -> None:
    """S is the speed itself, as always on this mill."""


@FUNCTIONS("G40.1", "Normal direction off", phase="plane", modal=False, source="Fanuc")
def normal_direction_off(m: Machine, words: Words) -> None:
    """There is none on this mill; it stands in the first lines of many programs."""


@FUNCTIONS("G5 G5.1 G8 G103 G187", CONTOURS, phase="plane", takes="P Q R E", still=True, modal=False, source="Fanuc, Haas")
def contour_control(m: Machine, words: Words) -> None:
    """How fast and exactly the machine follows the path; the path is the same. On LinuxCNC these are other functions."""
    if m.settings["dialect"] == "linuxcnc":
        what, hint = LINUXCNC.get(words.code, ("no code of LinuxCNC", "leave it out; G64 P says how far a corner may be cut"))
        m.alarm(f"{words.code} is refused: {what}", first_word(words), hint)


# Inches and millimetres: G20 and G21, in older programs G70 and G71.

INCH = 25.4
UNITS = {"G20": INCH, "G70": INCH, "G21": 1.0, "G71": 1.0}
LATHE = {"G70": "finishes", "G71": "roughs"}  # on LinuxCNC
CIRCLE = {"G70": "on a circle", "G71": "on an arc"}  # on Haas


NAMES = {code: "Inches" if factor == INCH else "Millimetres" for code, factor in UNITS.items()}


def start_units(m: Machine) -> None:
    """The unit that is active before the program says one."""
    if m.settings["units"] == "inch":
        m.set_modal("unit", "G20")
        m.variable_unit = INCH


@FUNCTIONS(" ".join(UNITS), NAMES, group="unit", phase="plane", power_on="G21", source=ISO)
def unit(m: Machine, words: Words) -> None:
    """What lengths and feeds of the program count in from this block on; the feed keeps its speed."""
    if words.code in LATHE and m.settings["dialect"] == "linuxcnc":
        hint = f"write G2{int(words.code == 'G71')} for the unit; lathes have the control jnc-t01"
        m.alarm(f"{words.code} is no unit on LinuxCNC but {LATHE[words.code]} a contour on a lathe", first_word(words), hint)
    if words.code in CIRCLE and m.settings["dialect"] == "haas":
        hint = f"write G2{int(words.code == 'G71')} for the unit, or a cycle and the places of its holes"
        m.alarm(f"{words.code} is no unit on Haas but drills holes {CIRCLE[words.code]}: not built", first_word(words), hint)
    factor = UNITS[words.code]
    if factor != m.variable_unit:
        refuse_change(m, "unit", first_word(words))
        m.variable_unit = factor


# M functions: the oriented stop, spindle and coolant together, overrides, and those that only the maker of a machine knows.

BOTH = {"M13": "Spindle on clockwise, coolant on", "M14": "Spindle on counter-clockwise, coolant on"}
OVERRIDES = {
    "M48": "Overrides on", "M49": "Overrides off", "M50": "Feed override", "M51": "Spindle override",
    "M52": "Adaptive feed", "M53": "Feed stop",
}  # fmt: skip
OUTPUTS = {
    "M62": "Digital output on, with the motion", "M63": "Digital output off, with the motion", "M64": "Digital output on",
    "M65": "Digital output off", "M67": "Analog output, with the motion", "M68": "Analog output",
}  # fmt: skip
WAYS = range(5)  # of L of M66: at once, rise, fall, high, low
MOST_OF_LINUXCNC = 199  # the greatest number of a function of the maker


@FUNCTIONS("M7 M8", COOLANT, group="coolant", phase="auxiliary", source=ISO)
def coolant_on(m: Machine, words: Words) -> None:
    """Before the motion of the block; the other one stays on."""
    memory(m).coolants.add(words.code)
    SHARED[words.code].obey(m, words)


@FUNCTIONS("M9", COOLANT, group="coolant", phase="end", power_on="M9", source=ISO)
def coolant_off(m: Machine, words: Words) -> None:
    """After the motion of the block."""
    memory(m).coolants.clear()
    SHARED["M9"].obey(m, words)


@FUNCTIONS("M13 M14", BOTH, group="spindle", phase="auxiliary", source=ISO)
def spindle_and_coolant(m: Machine, words: Words) -> None:
    """Before the motion of the block."""
    m.spindle(turning=1 if words.code == "M13" else -1)
    memory(m).coolants.add("M8")
    m.coolant()


@FUNCTIONS("M19", "Oriented spindle stop", group="spindle", phase="auxiliary", takes="R P Q", source=ISO)
def orient(m: Machine, words: Words) -> None:
    """At an angle of R or P degrees, 0 without; Q is how long the machine waits for it. On LinuxCNC R alone is the angle and P
    the direction: 0 the shorter way, 1 clockwise, 2 counter-clockwise."""
    if m.settings["dialect"] == "linuxcnc":
        angle, way, wait = (m.value(words[letter]) if letter in words else None for letter in "RPQ")
        if angle is not None and not 0 <= angle <= 360:
            m.alarm(f"M19 R (the angle of the spindle) must be 0 to 360, got {angle:g}", words["R"])
        if way is not None and way not in (0, 1, 2):
            m.alarm(f"M19 P (which way the spindle turns) must be 0, 1 or 2, got {way:g}", words["P"])
        if wait is not None and wait <= 0:
            m.alarm(f"M19 Q (how long the machine waits, s) must be greater than 0, got {wait:g}", words["Q"])
        m.orient(angle or 0.0)
        return
    if "R" in words and "P" in words:
        m.alarm("M19 has R and P in one block", words["P"], hint="keep one of them: the angle")
    word = words.get("R") or words.get("P")
    m.orient(m.value(word) if word else 0.0)


@FUNCTIONS("M60", "Pallet change and stop", group="stop", phase="end", modal=False, source=ISO)
def pallet(m: Machine, words: Words) -> None:
    """Waits for the operator, after the motion of the block."""
    m.stop()


@FUNCTIONS("M29", "Rigid tapping, as G84 always is here", phase="auxiliary", modal=False, source="Fanuc, Haas")
def rigid_tapping(m: Machine, words: Words) -> None:
    """How a tap is held changes no path."""


@FUNCTIONS("M48 M49", OVERRIDES, group="override", phase="auxiliary", modal=False, source="Fanuc, Haas, LinuxCNC")
@FUNCTIONS("M50 M51 M52 M53", OVERRIDES, group="override", phase="auxiliary", takes="P", modal=False, source="LinuxCNC")
def overrides(m: Machine, words: Words) -> None:
    """What the operator may turn at; P0 takes it from him. The path is the same."""
    on = words.code != "M49" and not ("P" in words and m.value(words["P"]) == 0)
    for code in ("M50", "M51") if words.code in ("M48", "M49") else (words.code,):
        memory(m).overrides[code] = on


@FUNCTIONS("M62 M63 M64 M65", OUTPUTS, group="signal", phase="auxiliary", takes="P", modal=False, source="LinuxCNC")
@FUNCTIONS("M67 M68", OUTPUTS, group="signal", phase="auxiliary", takes="E Q", modal=False, source="LinuxCNC")
def output(m: Machine, words: Words) -> None:
    """The output of number P or E; it moves nothing here."""
    address = "E" if words.code in ("M67", "M68") else "P"
    if address not in words:
        m.alarm(f"{words.code} {address} (number of the signal) is missing", first_word(words))
    number_of_signal(m, words, address)
    of_the_maker(m, words)


@FUNCTIONS("M66", "Wait for an input", group="signal", phase="auxiliary", takes="P E L Q", modal=False, source="LinuxCNC")
def wait_for_input(m: Machine, words: Words) -> None:
    """The digital input P or the analog input E; L says what to wait for, and Q for how many seconds at most."""
    if ("P" in words) == ("E" in words):
        m.alarm("M66 needs P or E, one of them: the number of the input", first_word(words))
    number_of_signal(m, words, "P" if "P" in words else "E")
    way = whole(m, words, "L", 0, WAYS.stop - 1) if "L" in words else 0
    if way and "E" in words:
        m.alarm(f"M66 L{way} waits for a digital input, and E is an analog one", words["L"], "write L0")
    if way and not ("Q" in words and m.value(words["Q"]) > 0):
        m.alarm(f"M66 L{way} needs Q above 0: for how long it waits", words["L"])
    of_the_maker(m, words)


def number_of_signal(m: Machine, words: Words, address: str) -> None:
    if (number := m.value(words[address])) < 0:
        m.alarm(f"{words.code} {address} (number of the signal) must be at least 0, got {number:g}", words[address])


STATE = {"M70": "Modes kept", "M71": "Kept modes forgotten", "M72": "Kept modes back", "M73": "Modes back after a subprogram"}


@FUNCTIONS("M70 M71 M72 M73", STATE, phase="auxiliary", modal=False, source="LinuxCNC")
def kept_modes(m: Machine, words: Words) -> None:
    """M72 and M73 bring modes back, which is not built; M70 and M71 alone change nothing."""
    if m.settings["dialect"] != "linuxcnc":
        of_the_maker(m, words)
    elif words.code in ("M72", "M73"):
        m.alarm(f"{words.code} is refused: bringing modes back is not built", first_word(words), "write the modes themselves")


@FUNCTIONS("M190", "Change of material", phase="auxiliary", takes="P", modal=False, source="the maker of the machine")
@FUNCTIONS("M", "Function of the maker", phase="auxiliary", modal=False, source="the maker of the machine")
def of_the_maker(m: Machine, words: Words) -> None:
    """What it does, the maker of the machine says; here it moves nothing."""
    if m.settings["dialect"] == "linuxcnc" and float(words.code[1:]) > MOST_OF_LINUXCNC:
        m.alarm(f"{words.code}: LinuxCNC does not know this code", first_word(words), f"M100 to M{MOST_OF_LINUXCNC} are free")
    m.warn(f"{words.code} is a function of the machine's maker: here it moves nothing", first_word(words))

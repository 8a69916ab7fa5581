"""Modes that most blocks only stand under: what F means, exact stops, arc centres, the plane, and modes that move nothing."""

from __future__ import annotations

from mnclab.controls.g43.language.transformations import refuse_transformed
from mnclab.controls.g43.remarks import ISO, remark
from mnclab.controls.g43.state import memory
from mnclab.controls.word_address.functions import FEEDS, PLANES, STOPS, functions
from mnclab.controls.word_address.motion import first_word
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


@FUNCTIONS("G17 G18 G19", PLANES, group="plane", phase="plane", power_on="G17", source="7.1, example")
def plane(m: Machine, words: Words) -> None:
    """The plane of arcs, radius compensation, polar coordinates and rotation."""
    if PLANES[words.code].split()[-1] != m.plane:
        refuse_transformed(m, words, "rotation")
        if memory(m).polar is not None:
            m.alarm("the plane cannot change while polar coordinates are on", first_word(words), hint="write G15 first")
    SHARED[words.code].obey(m, words)


@FUNCTIONS("G93", "Inverse time feed", group="feed mode", phase="plane", source="LinuxCNC, Haas, Fanuc")
def inverse_time(m: Machine, words: Words) -> None:
    """Every move at feed takes 1/F minutes; its block needs F."""
    m.change("feed", None)
    m.change("per_rev", False)
    m.change("per_time", True)


@FUNCTIONS("G94 G95", FEEDS, group="feed mode", phase="plane", power_on="G94", source=ISO)
def feed_mode(m: Machine, words: Words) -> None:
    """What F means, mm/min or mm/rev; a new F must follow."""
    if m.per_time:
        m.change("feed", None)
        m.change("per_time", False)
    SHARED[words.code].obey(m, words)


@FUNCTIONS("G64", STOPS, group="blending", phase="plane", takes="P Q", power_on="G64", source=ISO)
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


@FUNCTIONS("G61 G61.1", STOPS | {"G61.1": STOPS["G61"]}, group="blending", phase="plane", source="ISO 6983, LinuxCNC")
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

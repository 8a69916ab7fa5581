"""What other controls of ISO words have and this one does not: refused by name, with the reason."""

from __future__ import annotations

from dataclasses import replace

from mnclab.controls.word_address.motion import first_word
from mnclab.machine.control import Function, Words
from mnclab.machine.machine import Machine

_LATHE = "it belongs to a lathe: choose control=\"jnc-t01\" or write the program for the mill"
_PROBE = "not built: probing; write the places that it would find as numbers"
_WRITTEN = "not built: write the motion itself"

REFUSED = (
    dict.fromkeys(("G71.1", "G71.2", "G72.1", "G72.2"), _LATHE)
    | dict.fromkeys(("G7", "G96", "G32", "G33", "G34", "G33.1", "G75", "G77", "G78", "G79"), _LATHE)
    | dict.fromkeys(("G31", "G36", "G37", "G38.2", "G38.3", "G38.4", "G38.5"), _PROBE)
    | dict.fromkeys(("G12", "G13", "G47", "G150"), _WRITTEN)
    | dict.fromkeys(("G5.2", "G5.3", "G6.2"), "not built: splines")
    | dict.fromkeys(("G17.1", "G18.1", "G19.1"), "not built: planes of the axes U, V and W")
    | dict.fromkeys(("G43.2", "G43.4", "G43.5", "G53.1", "G68.2", "G68.3", "G234", "G254"),
                    "not built: the kinematics of the machine are not known")
    | dict.fromkeys("UVW", "increments of a lathe, or axes that are not built: write X, Y or Z under G91")
    | {"G101": "the mirror image of Haas: write G51.1 and the axes with 0", "G100": "no mirror image, of Haas: write G50.1"}
    | {"M97": "not built: a subprogram from a block of this program on (Haas); M98 calls programs with O numbers",
       "G66.1": "not built: a macro call in every block"}
    | {"G72": "not built: holes along a line (Haas); on LinuxCNC a lathe roughs with it",
       "G84.2": "not built in this format: write M29 and G84",
       "G84.3": "not built in this format: write M29 and G74"}
    | {"G7.1": "not built: the surface of a cylinder", "G12.1": _LATHE, "G13.1": _LATHE,
       "G45": _WRITTEN, "G46": _WRITTEN, "G48": _WRITTEN, "G62": "not built: slower inside corners",
       "G63": "not built: feed and override locked for tapping", "G11": "there is no data mode: G10 ends with its block",
       "G60": "not built: the approach from one side, whose length is a parameter of the machine"}
)  # fmt: skip
_NO_MIRROR = "write the mirrored motion itself"
_NO_MACRO = "write a subprogram: o<name> sub, and o<name> call with the arguments in brackets"

#: What LinuxCNC does not know (rs274: Unknown g code used, Unknown m code used), and what to write there instead.
NOT_OF_LINUXCNC = (
    {"G68": "G10 L2 with R turns a coordinate system", "G69": "G10 L2 with R0 ends the turning of a coordinate system"}
    | dict.fromkeys(("G50", "G51"), "write the scaled motion itself") | dict.fromkeys(("G50.1", "G51.1"), _NO_MIRROR)
    | dict.fromkeys(("G15", "G16"), "write X and Y, or @ and ^ for a radius and an angle")
    | dict.fromkeys(("G65", "G66", "G66 again", "G67"), _NO_MACRO)
    | {"G9": "write G61.1, and G64 after it", "G27": "", "G29": "write the motion itself", "G40.1": "write G40",
       "G44": "write G43.1 with the length below zero", "G54.1": "write G54 to G59.3", "M13": "write M3 and M8",
       "M14": "write M4 and M8", "M29": ""}
)  # fmt: skip


def unknown_to_linuxcnc(function: Function) -> Function:
    """The function, refused in the dialect linuxcnc."""

    def obey(m: Machine, words: Words) -> None:
        if m.settings["dialect"] == "linuxcnc":
            m.alarm(f"{words.code}: LinuxCNC does not know this code", first_word(words), NOT_OF_LINUXCNC[function.code])
        function.obey(m, words)

    return replace(function, obey=obey)

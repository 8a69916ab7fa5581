"""What other controls of ISO words have and this one does not: refused by name, with the reason."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from mnclab.controls.word_address.motion import first_word, uncompensated
from mnclab.machine.control import Function, Words
from mnclab.machine.machine import Machine

_LATHE = "it belongs to a lathe: choose control=\"jnc-t01\" or write the program for the mill"
_WRITTEN = "not built: write the motion itself"
_SIDES = "write a program for each side, or for the tnc-620, which has"
_TIP = "not built: the tip is led and the tool lies along I J K; write G43.4 and the angles A, B, C"

REFUSED = (
    dict.fromkeys(("G71.1", "G71.2", "G72.1", "G72.2"), _LATHE)
    | dict.fromkeys(("G7", "G96", "G32", "G33", "G34", "G33.1", "G75", "G77", "G78", "G79"), _LATHE)
    | dict.fromkeys(("G36", "G37"), "not built: measuring the tool in the program; write its length into the tool table")
    | dict.fromkeys(("G12", "G13", "G47", "G150"), _WRITTEN)
    | dict.fromkeys(("G5.2", "G5.3", "G6.2"), "not built: splines; write lines or arcs")
    | dict.fromkeys(("G17.1", "G18.1", "G19.1"), "not built: planes of the axes U, V and W; write G17, G18 or G19")
    | {"G43.5": _TIP}
    | {"G43.2": "not built: a length on top of another (LinuxCNC); write their sum into one row of the tool table",
       "G254": "not built: the datum turns with the rotary axes (Haas); write G268 and G253, or G234, which leads the tip"}
    | dict.fromkeys("UVW", "increments of a lathe, or axes that are not built: write X, Y or Z under G91")
    | {"G101": "the mirror image of Haas: write G51.1 and the axes with 0", "G100": "no mirror image, of Haas: write G50.1"}
    | {"M97": "not built: a subprogram from a block of this program on (Haas); write it as a program O… and call it by M98",
       "G66.1": "not built: a macro call in every block; write G65 in the blocks that call it"}
    | {"G72": "not built: holes along a line (Haas), write G81 and their places; on LinuxCNC a lathe roughs with it",
       "G84.2": "not built in this format: write M29 and G84",
       "G84.3": "not built in this format: write M29 and G74"}
    | {"G7.1": "not built: the surface of a cylinder; the tnc-620 has cycle 27 for it", "G12.1": _LATHE, "G13.1": _LATHE,
       "G45": _WRITTEN, "G46": _WRITTEN, "G48": _WRITTEN, "G62": "not built: slower inside corners; write F there",
       "G63": "not built: feed and override locked for tapping; G84 has them locked",
       "G11": "there is no data mode: G10 ends with its block",
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
    | {"G9": "write G61.1, and G64 after it", "G27": "", "G29": "write the motion itself",
       "G31": "G38.2 moves until the probe touches", "G40.1": "write G40",
       "G44": "write G43.1 with the length below zero", "G54.1": "write G54 to G59.3", "M13": "write M3 and M8",
       "M14": "write M4 and M8", "M29": ""}
)  # fmt: skip

#: What LinuxCNC refuses under radius compensation, beside that which no control takes there.
COMPENSATED = "G28.1 G30.1 G41 G42 G61 G61.1 G64 G98 G99 M48 M49 M50 M51 M52 M53 M62 M63 M64 M65 M66 M67 M68".split()


def compensated_on_linuxcnc(function: Function) -> Function:
    """The function, refused under radius compensation in the dialect linuxcnc."""

    def obey(m: Machine, words: Words) -> None:
        if m.settings["dialect"] == "linuxcnc":
            uncompensated(m, words)
        function.obey(m, words)

    return replace(function, obey=obey)


def unknown_to_linuxcnc(function: Function) -> Function:
    """The function, refused in the dialect linuxcnc."""

    def obey(m: Machine, words: Words) -> None:
        if m.settings["dialect"] == "linuxcnc":
            m.alarm(f"{words.code}: LinuxCNC does not know this code", first_word(words), NOT_OF_LINUXCNC[function.code])
        function.obey(m, words)

    return replace(function, obey=obey)


#: Data that the cycles of LinuxCNC do not have (rs274: Q word with no G5, …; P word …; J word …).
NO_DATA_OF_LINUXCNC = {"pause", "tapping_peck", "times_out"}


def at_a_place(m: Machine, code: str, values: Mapping[str, Any], given: Mapping[str, Any]) -> None:
    """On LinuxCNC a block of a cycle has an axis word and no data of other makers, and drills once at least."""
    if m.settings["dialect"] == "linuxcnc":
        for name in NO_DATA_OF_LINUXCNC & given.keys():
            m.alarm(f"{code} does not take {given[name].address} on LinuxCNC", given[name])
        if given.keys().isdisjoint(("x", "y", "bottom")):
            m.alarm(f"{code} needs X, Y or Z in its block", next(iter(given.values()), None), "LinuxCNC drills where one stands")
        if values.get("repeats") == 0:
            m.alarm(f"{code} L (number of holes) must be at least 1 on LinuxCNC", given["repeats"])

"""What the words of functions are."""

from __future__ import annotations

from mnclab.controls.g43.language import macros, o_words, programs

_CENTRES = {f"G{n} {letter}": f"centre along {axis}, from the start or, after G90.1, the origin"
            for n in (2, 3) for letter, axis in zip("IJK", "XYZ")}  # fmt: skip

MEANINGS = {
    **_CENTRES,
    **{f"G51 {letter}": f"factor along {axis}" for letter, axis in zip("IJK", "XYZ")},
    **{f"G51 {axis}": f"{axis} of the fixed point" for axis in "XYZ"},
    **{f"G68 {axis}": f"{axis} of the centre" for axis in "XYZ"},
    **{f"G51.1 {axis}": f"line to mirror about, across {axis}" for axis in "XYZ"},
    **{f"G50.1 {axis}": f"ends the mirror image across {axis}" for axis in "XYZ"},
    **{f"G52 {axis}": f"origin's {axis} from the work offset" for axis in "XYZ"},
    **{f"G92 {axis}": f"new value of {axis} where the tool stands" for axis in "XYZ"},
    **{f"G92.1 {axis}": f"ends the shift along {axis}" for axis in "XYZ"},
    **{f"G10 {axis}": f"{axis} of the row" for axis in "XYZ"},
    **{f"G43.1 {axis}": f"offset along {axis}" for axis in "XYZ"},
    **{axis: f"angle of the rotary axis {axis}, degrees" for axis in "ABC"},
    "R": "radius", "G4 P": "the time, counted as the setting dwell_p says", "G4 X": "seconds",
    "G2 P": "number of turns", "G3 P": "number of turns", "G68 R": "angle, degrees", "G51 P": "factor of all axes",
    "G10 L": "which table", "G10 P": "row of the table", "G10 R": "of L2 the angle of the system, degrees, else the value",
    "G54.1 P": "number of the work offset", "G154 P": "number of the work offset", "G30 P": "number of the reference point",
    "G64 P": "how far a corner may be cut", "G64 Q": "how far short moves may be joined",
    "G41.1 D": "diameter of the tool", "G42.1 D": "diameter of the tool", "M19 R": "angle, degrees", "M19 P": "angle, degrees",
    "M19 Q": "how long the machine waits for it, s", "P": "choice of the function", "Q": "choice of the function",
    "E": "number of the signal", "L": "what to wait for", "G187 E": "how exact corners are",
    **macros.MEANINGS, **programs.MEANINGS, **o_words.MEANINGS,
    **{f"{code} R": "choice of the function" for code in ("G5", "G5.1", "G8", "G103", "G187")},
}  # fmt: skip

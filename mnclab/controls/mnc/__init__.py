"""The MNC milling control (Mechatronics, 2015): the namesake.

`language` holds motion, offsets, feed and corners, tool, spindle and what ISO controls have alike, `transforms` polar
motion, scaling, mirror image, rotation and datums, `cycles` those of drilling and milling (chapters 9 and 10), `probing`
those of chapter 12, `settings` what a machine may need otherwise.
"""

from mnclab.text.dialect import sign

#: Suffixes of its files. These and the signs are read before the control itself is imported.
SUFFIXES = (".mnc",)
#: Signs of MNC programs: its comments, its numbers of cycles, and what other controls of ISO words have and it has not.
SIGNS = (
    sign(r"^[^;(\n]*//", 9, "a comment behind //"),
    sign(
        r"(?<![A-Z])G(?:30[0-79]|32[01]|34[34]|4(?:0[048-9]|1[0-579]|2[0-6]|6[0-2]|[789][0-29]))(?![\d.])",
        6, "a cycle of this control", 2,
    ),
    sign(r"(?<![A-Z])G(?:147|241|247|20[0-48])(?![\d.])(?![^\n]*Q2\d\d)", 4, "a call or a prepared cycle"),
    sign(r"(?<![A-Z])G16[0-2](?![\d.])", 5, "a rule of corners"),
    sign(r"(?<![A-Z])G1[0-3](?![\d.])[^\n]*R-?[\d.][^\n]*A-?[\d.]", 5, "polar motion"),
    sign(r"(?<![A-Z])G3[6-9](?![\d.])[^\n]*[XYZA]", 4, "a scale, a rotation or their end"),
    sign(r"(?<![A-Z])G8[345](?![\d.])(?![^\n]*Q)[^\n]*K", 9, "a peck behind K"),
    sign(r"(?<![A-Z])G[ \t]*0*[0-3](?![\d.])", 1, "motion of ISO words"),
    sign(r"\(", -4, "comments in brackets"),
    sign(r"^[^/\n]*;", -4, "comments behind a semicolon"),
    sign(r"^[ \t]*(?:%|O\d)|#", -4, "heads of programs, variables"),
    sign(
        r"(?<![A-Z])G(?:20|21|28|43|49|52|68|73|81|82)(?![\d.])|(?<![A-Z])M9[78](?!\d)|(?<![A-Z])H\d",
        -3, "words that it does not have",
    ),
    sign(r"'|[*~@][ \t]*$", -6, "marks of other controls"),
)

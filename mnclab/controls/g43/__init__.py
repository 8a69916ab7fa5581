"""A milling control of ISO words with G43, G44 and G49; of its manual there is one chapter.

So it is the ISO mill that its users take it for: `language.tools` holds what that chapter says, the other files of
`language` the functions of its example and what ISO controls mean by the others, `cycles` their drilling cycles.
"""

from mnclab.text.dialect import sign

#: Suffixes of its files. These and the signs are read before the control itself is imported.
SUFFIXES = (".g43", ".iso")
#: Signs of ISO milling programs: what most makers of mills have in common.
SIGNS = (
    sign(
        r"\A(?=[\s\S]*[XIUR][ \t]*[-+.\d#\[])(?=[\s\S]*Y[ \t]*[-+.\d#\[])(?=[\s\S]*(?<![A-Z])[GM][ \t]*\d)",
        2.5, "words G, X and Y",
    ),
    sign(r"(?<![A-Z])G[ \t]*0*[0-3](?![\d.])[ \t]*[A-Z-]", 1, "motion of ISO words"),
    sign(r"(?<![A-Z])G4[34](?![\d.])[^\n]*[HZ]|(?<![A-Z])G49(?![\d.])", 4, "tool length compensation"),
    sign(r"(?<![A-Z])T[ \t]*\d{1,5}[ \t]*M0?6(?!\d)|(?<![A-Z])M0?6[ \t]*T\d", 2, "a tool change"),
    sign(r"(?<![A-Z])G2[01](?![\d.])", 2, "a unit"),
    sign(r"(?<![A-Z])G17(?![\d.])", 1, "the plane of X and Y"),
    sign(r"(?<![A-Z])G5[4-9](?!\d)", 1, "a work offset"),
    sign(r"(?<![A-Z])G(?:28|30)(?![\d.])", 1, "a reference point"),
    sign(r"(?<![A-Z])G(?:7[346]|8[1-9])(?![\d.])[^\n]*R", 2, "a drilling cycle"),
    sign(r"^%[ \t]*$", 1.5, "% alone in a line"),
    sign(r"^[ \t]*[O:][ \t]*\d{1,8}\b", 2, "the number of a program"),
    sign(r"\(", 1, "comments in brackets"),
    sign(r"^[^;\n]*\b[GM]\d[^;\n]*;", 0.5, "comments behind a semicolon"),
    sign(r"#[ \t]*\d+[ \t]*=|\b(?:WHILE|IF)[ \t]*\[", 4, "variables"),
    sign(r"#<[\w ]+>", 8, "a variable with a name"),
    sign(r"(?<![A-Z])G[ \t]*38\.[2-5](?!\d)", 6, "a probing move of LinuxCNC"),
    sign(
        r"^[ \t]*+O[ \t]*+(?:<[\w. -]++>|\d++|[\[#])[^\n(]*(?:sub|endsub|call|if|while|repeat|do|return|endif|endwhile)\b",
        20, "an O word of LinuxCNC",
    ),
    sign(r"(?<![A-Z])M98[ \t]*[PQ]|(?<![A-Z])G65[ \t]*P", 3, "a sub-program"),
    sign(r"(?<![A-Z])M(?:0?2|30|99)(?!\d)", 0.5, "an end of the program"),
    sign(
        r"(?<![A-Z])G50[ \t]*S|(?<![A-Z])G(?:7[0-3][ \t]*[PUW]|28[ \t]*[UW])|(?<![A-Z])T\d{4}(?!\d)(?![ \t]*M)|(?<![A-Z])G96\b",
        -4, "words of lathes",
    ),
    sign(
        r"\A(?![\s\S]*Y[ \t]*[-+.\d#\[])(?=[\s\S]*X[ \t]*[-+.\d])(?=[\s\S]*Z[ \t]*[-+.\d])",
        -1, "positions of X and Z, and no Y",
    ),
    sign(r"'|[~@][ \t]*$|^[^\n/;]*\*[ \t]*$", -6, "marks of other controls"),
)

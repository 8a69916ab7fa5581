"""The lathe control JNC-T01: words with a decimal point, one-shot functions that own their block, turning cycles.

`reader` checks the formats of words, `functions` holds moves and frames, feed, spindle and auxiliary functions, `cycles`
the cycles G73 to G78. X is a radius in programs, by a setting a diameter, and a radius everywhere else.
"""

from mnclab.text.dialect import sign

#: Suffixes of its files. These and the signs are read before the control itself is imported.
SUFFIXES = (".jnc",)
#: Signs of JNC-T01 programs: comments behind an apostrophe, positions without Y, and no numbers of blocks.
SIGNS = (
    sign(r"^[^'\n;(]*'", 8, "a comment behind an apostrophe"),
    sign(
        r"\A(?=[\s\S]*X[ \t]*[-+.\d])(?=[\s\S]*Z[ \t]*[-+.\d])(?=[\s\S]*(?<![A-Z])G[ \t]*\d)(?![\s\S]*Y[ \t]*[-+.\d#\[])",
        2, "positions of X and Z, and no Y",
    ),
    sign(r"(?<![A-Z])G1[24](?![\d.])[^\n]*R", 3, "a fillet or a chamfer"),
    sign(r"(?<![A-Z])G7[78](?![\d.])[^\n]*X", 4, "stock removal"),
    sign(r"(?<![A-Z])G7[345](?![\d.])[^\n]*[XZ]", 1, "a drilling or grooving cycle"),
    sign(r"(?<![A-Z])M6[013](?!\d)", 3, "the way home"),
    sign(r"(?<![A-Z])G32(?![\d.])[^\n]*[XZ]", 1, "a thread"),
    sign(r"^[ \t]*N\d", -3, "numbers of blocks"),
    sign(r"\(|^[^'\n]*;", -3, "comments of others"),
    sign(r"^[ \t]*(?:O\d|%)|#", -2, "heads of programs, variables"),
    sign(
        r"(?<![A-Z])G(?:70|71|72|76|50|28|4[0-39]|5[4-9]|2[01]|8\d)(?![\d.])|(?<![A-Z])T\d{4}(?!\d)|Y[ \t]*[-+.\d]",
        -4, "words that it does not have",
    ),
)

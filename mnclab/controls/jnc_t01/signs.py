"""Signs of JNC-T01 programs: comments behind an apostrophe, positions without Y, and no numbers of blocks."""

from __future__ import annotations

from mnclab.text.dialect import sign

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

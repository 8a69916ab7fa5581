"""The HEIDENHAIN TNC 620 milling control (NC software 81760x-06, 2018), conversational programs and DIN/ISO programs.

`reader` makes blocks of lines, `statements` and `words` say how each is written, `language` obeys statements and M
functions, `cycles` holds the fixed cycles by chapter of the manual, `later` names what is not built yet.
"""

from mnclab.text.dialect import sign

#: Suffixes of its files. These and the signs are read before the control itself is imported.
SUFFIXES = (".h", ".i")
_BLOCK = r"^[ \t/]*(?:\d+[ \t]*)?"
SIGNS = (
    sign(r"\b(?:BEGIN|END)[ \t]+PGM\b", 20, "the head of a Klartext program"),
    sign(_BLOCK + r"BLK[ \t]+FORM\b", 15, "a blank"),
    sign(
        _BLOCK + r"(?:TOOL[ \t]+(?:CALL|DEF)|CYCLE?[ \t]+(?:DEF|CALL)|CALL[ \t]+(?:LBL|PGM)|TCH[ \t]+PROBE|FN[ \t]*\d+[ \t]*:)",
        12, "a statement", 2,
    ),
    sign(
        _BLOCK + r"(?:APPR|DEP)[ \t]+(?:P?L[NT]|P?CT|PLCT)\b|" + _BLOCK + r"(?:FPOL|FL|FC|FLT|FCT|FSELECT)\b",
        10, "a contour",
    ),
    sign(_BLOCK + r"(?:L|LN|LP)[ \t]+(?:I?[XYZABCUVW]|P[RA])[ \t]*[-+]?[\d.Q]", 6, "a line", 2),
    sign(_BLOCK + r"(?:CC|CP|CR|CT)[ \t]+I?[XYZP]", 5, "a circle"),
    sign(_BLOCK + r"LBL[ \t]+[\d\"]", 6, "a label"),
    sign(_BLOCK + r"Q[LRS]?\d+[ \t]*=", 3, "a Q parameter", 2),
    sign(r"\bFMAX\b|\bR[0LR][ \t]+F", 5, "rapid traverse or a compensation"),
    sign(r"^[ \t]*Q\d+=[^;\n]*;", 5, "a parameter of a cycle"),
    sign(r"^[ \t]*%[^\n;*]*[ \t]G7[01]\b", 20, "the head of a DIN/ISO program"),
    sign(
        r"^[ \t]*+N\d++[^\n*;A-Z]*+[A-Z]++[-+\d.]++[ \t]*+[A-Z][^\n*;]*+\*[ \t]*+(?:;[^\n]*)?$",
        7, "a block that ends with *", 2,
    ),
    sign(r"^[ \t]*N?9{5,8}[ \t]+%", 12, "the end of a DIN/ISO program"),
    sign(r"(?<![A-Z])G98[ \t]+L\d|(?<![A-Z])G99[ \t]+T\d+[ \t]+L", 8, "a label or a tool of DIN/ISO"),
    sign(r"(?<![A-Z])G2\d\d[ \t]+Q2\d\d[ \t]*=", 10, "a cycle of DIN/ISO"),
    sign(r"\bD0?\d[ \t]+Q\d+[ \t]+P0?1", 8, "a parameter of DIN/ISO"),
)

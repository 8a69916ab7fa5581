"""The lathe control Elektronika NC-31: frames of one word, integers in discretes, marks.

`reader` makes frames into blocks, `functions` holds the scale of the integers, moves, repetition and words; `cycles`
and `threads` are the cycles. X is a diameter in programs and a
radius everywhere else.
"""

from mnclab.text.dialect import sign

#: Suffixes of its files. These and the signs are read before the control itself is imported.
SUFFIXES = (".nc31",)
_FRAME = r"^[ \t]*+(?:N[ \t]*+\d++[ \t]*+)?"
#: Signs of NC-31 programs: one word a line, whole numbers, marks behind them.
SIGNS = (
    sign(
        _FRAME + r"[GXZFSPMTХМРТСЗ][ \t]*+@?[ \t]*+[-+]?\d++[ \t]*+(?:\*[ \t]*+)?[~@][ \t*~@]*+(?:;[^\n]*)?$",
        7, "a frame with marks", 2,
    ),
    sign(
        _FRAME + r"[GXZFSPM][ \t]*+@?[ \t]*+[-+]?\d++[ \t]*+\*[ \t]*(?:;[^\n]*)?$",
        4, "a frame that the next one belongs to", 2,
    ),
    sign(r"^(?:[ \t]*(?:N\d+[ \t]*)?[GXZFSPMT]-?\d+[ \t]*(?:;[^\n]*)?\n){4}", 3, "one word a line, whole numbers"),
    sign(_FRAME + r"[A-MO-Z][ \t]*+[-+]?[\d.]++[ \t]*+[A-Z][ \t]*[-+]?[\d.]", -6, "two words in a line"),
    sign(r"\b[XZ][ \t]*[-+]?\d*\.", -6, "decimal points"),
)

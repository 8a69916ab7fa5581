"""Signs of NC-31 programs: one word a line, whole numbers, marks behind them."""

from __future__ import annotations

from mnclab.text.dialect import sign

_FRAME = r"^[ \t]*+(?:N[ \t]*+\d++[ \t]*+)?"

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

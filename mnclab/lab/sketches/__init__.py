"""A little picture of what a parameter of a cycle measures, drawn from its declaration.

`kinds` says what a cycle works; `milling`, `touching` and `turning` lead from the meaning of a parameter to a picture.
"""

from __future__ import annotations

import re
from functools import cache
from typing import Any

from mnclab.lab.sketches.ink import Sheet
from mnclab.lab.sketches.kinds import Draw, Kind, kind_of
from mnclab.lab.sketches.milling import MILLS
from mnclab.lab.sketches.touching import TOOLS, TOUCHES
from mnclab.lab.sketches.turning import LATHE

RULES = {"touch": TOUCHES, "tool": TOOLS, "lathe": LATHE}


def sketch(cycle: Any, parameter: Any) -> str:
    """What a parameter of a cycle (its class) measures, as the text of an SVG of 96 by 64; "" where no sketch is known.

    Choices and texts measure nothing.
    """
    if parameter.type in ("text", "choice") or parameter.mark:
        return ""
    side = re.search(" on (diameter|radius)$", parameter.unit)
    return _drawn(kind_of(cycle), parameter.meaning, side[0] if side else "", parameter.address)


def picture(kind: Kind, meaning: str) -> Draw | None:
    """The picture of a meaning in cycles of a kind, by the first rule that fits, or None."""
    for kinds, words, draw in RULES.get(kind.section, MILLS):
        if any(re.fullmatch(kinds, name) for name in kind[:2]) and re.fullmatch(words, meaning):
            return draw
    return None


@cache
def _drawn(kind: Kind, meaning: str, side: str, address: str) -> str:
    sheet, draw = Sheet(address), picture(kind, meaning + side)
    if draw is None:
        return ""
    draw(sheet, kind)
    return sheet.svg(meaning)

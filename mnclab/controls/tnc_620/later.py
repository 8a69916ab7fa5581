"""What the TNC 620 knows and is not built yet: refused by name where a program uses it.

What gets built leaves these tables (a test says so). The names of the cycles are those of the manual's list
(chapter 20).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from mnclab.machine.control import Control, Modal, Remark
from mnclab.machine.cycle import Cycle
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word

STATEMENTS = {
    "TRANS DATUM": "datum shift of a table",
    "FUNCTION PARAXMODE": "parallel axes",
    "FUNCTION PARAXCOMP": "parallel axes", "FUNCTION RESET": "end of a special function",
    "FUNCTION MODE": "milling or turning", "FUNCTION FEED": "recurring dwell", "BLK FORM FILE": "blank from a file",
}  # fmt: skip

M = {
    136: "feed per revolution",
    144: "kinematics in actual positions", 197: "rounding of corners",
}  # fmt: skip

#: Of older controls, whose programs still run here: they change the path, and nobody says exactly how.
OLDER = {
    95: "another approach at a contour", 96: "another departure from a contour", 104: "the datum that was set by hand last",
    112: "arcs put in between lines", 114: "compensation of tilted axes", 124: "points left out",
    132: "smoother acceleration", 133: "end of M132", 142: "erasing modal information", 150: "limit switches not heeded",
}  # fmt: skip

#: What is written instead of what is not built, where there is something.
INSTEAD = {
    "TRANS DATUM": "write CYCL DEF 7 with # and the row of the table",
    "FUNCTION FEED": "write FUNCTION DWELL, which waits once",
    **{f"FUNCTION {form}": "leave it out where those axes stand still" for form in ("PARAXMODE", "PARAXCOMP")},
    "FUNCTION MODE": "leave it out, for milling", "BLK FORM FILE": "write BLK FORM 0.1 and 0.2, or give Setup(stock=…)",
    "M136": "write F in mm/min, feed times speed",
    "M144": "write M128", "M197": "write RND at each corner", "M95": "write APPR", "M96": "write DEP",
    "M104": "write CYCL DEF 247", "M112": "write RND at the corners, or cycle 32", "M114": "write M128",
    "M124": "leave it out, then every point is gone to", "M132": "leave it out, the path is the same",
    "M133": "leave it out with M132", "M142": "write the functions again that are to hold",
}  # fmt: skip

BUILDER = "a cycle of the machine tool builder, whose manual alone describes it: leave it out where it moves nothing"

#: Forms that do not exist, although their neighbours do.
NOT_THERE = {
    f"DEP {form}": f"it names no point that could be polar; write DEP {form[1:]}" for form in ("PLT", "PLN", "PCT")
}

WORDS = {
    **{axis: f"the secondary axis {axis} is built for L alone" for axis in "UVW"},
    **{axis: f"the rotary axis {axis} is built for L alone" for axis in "ABC"},
}  # fmt: skip

WAITING = {
    **STATEMENTS,
    **{f"M{n}": title for n, title in M.items()},
}


def _instead(code: str) -> str:
    return f": {INSTEAD[code]}" if code in INSTEAD else ""


#: Codes and addresses that are not built, with the sentence that says so.
REFUSED = {
    **{code: f"{title}, not built yet{_instead(code)}" for code, title in WAITING.items()},
    **{f"M{n}": f"{title}, a function of older controls that is not built{_instead(f'M{n}')}" for n, title in OLDER.items()},
    **{f"CYCL DEF {n}": BUILDER for n in range(300, 400)},
    **{f"TCH PROBE {n}": BUILDER for n in range(500, 600)},
    **NOT_THERE,
    **WORDS,
}

#: A line `Q1=-9` without a number below a definition is one of its lines (3.1): they carry no numbers of their own.
_BELONGS = "a line Q… without a block number belongs to the definition above it: number it to assign a variable"


def strange_parameters(built: Mapping[str, type[Cycle]]) -> Callable[[Control, Modal, str, list[Word]], list[Remark]]:
    """Refuses parameters that a cycle does not have."""

    def check(control: Control, modal: Modal, code: str, words: list[Word]) -> list[Remark]:
        if code not in built:
            return []
        taken = {address for p in built[code].parameters() for address in (p.address, *p.aliases)}
        for word in words:
            if word.address[0] == "Q" and word.address not in taken:
                raise Alarm(word.untaken(code), word.span, hint=_BELONGS)
        return []

    return check

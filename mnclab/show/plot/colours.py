"""How every line and mark of a figure looks, in one table, on that of `show.looks`, which other media share.

What differs in colour differs in form too (dashes, width, shape), for grey print and colour-blind eyes. All colours
have a contrast of at least 3 to 1 on white, the ground of every figure, in light and dark notebooks.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from matplotlib.path import Path

from mnclab.show import looks
from mnclab.show.looks import BLANK, FAINT, FEED, INK, PAPER, PROBING, PROGRAMMED, RAPID, THREAD, Dashes, LineStyle  # noqa: F401


class Mark(NamedTuple):
    """A place: marker as matplotlib names it, size in points, filled or hollow."""

    name: str
    colour: str
    marker: str | Path
    size: float
    filled: bool
    order: float

    def style(self) -> dict[str, Any]:
        look = {"color": self.colour, "linestyle": "none", "marker": self.marker, "markersize": self.size}
        edge = 1.4 if isinstance(self.marker, str) else 1.0
        look |= {"markerfacecolor": self.colour if self.filled else "none", "markeredgewidth": edge}
        return look | {"zorder": self.order, "label": self.name}


def _quarters() -> Path:
    """The sign of a zero point: a circle in quarters, two opposite ones filled. Arcs there and back enclose nothing."""
    pieces = []
    for begin in (0, 90, 180, 270):
        arc = Path.arc(begin, begin + 90)
        there, how = np.asarray(arc.vertices), np.asarray(arc.codes)
        middle = np.zeros((1, 2))
        if begin % 180:
            pieces.append(Path(np.concatenate([there, there[-2::-1]]), np.append(how, how[1:])))
        else:
            pieces.append(Path(np.concatenate([middle, there, middle]), [Path.MOVETO, Path.LINETO, *how[1:], Path.CLOSEPOLY]))
    cross = Path([(-1.45, 0), (1.45, 0), (0, -1.45), (0, 1.45)], [Path.MOVETO, Path.LINETO] * 2)
    return Path.make_compound_path(*pieces, cross)


QUARTERS = _quarters()

#: What was there before a number was changed, behind all that is there now.
GHOST = LineStyle("_before", looks.GREY, "-", 1.1, 1.9)
GHOST_RAPID = LineStyle("_before, rapid", looks.GREY, (0, (1, 2)), 0.8, 1.9)
BLANK_FACE = "#f6f3ea"  # behind everything
TILTED = LineStyle("tool, tilted", looks.GREEN, "-", 1.1, 2.4)
LEADER = LineStyle("_leader", INK, "-", 1.0, 3.9)  # from a symbol to its place
CENTRE_LINE = LineStyle("", "#6b6b6b", (0, (10, 3, 1.5, 3)), 0.8, 1.5)

PLUNGE = Mark("plunge", looks.BLUE, "+", 7, True, 3.2)
DWELL = Mark("dwell", looks.BROWN, "d", 6, False, 3.4)
TOOL = Mark("tool change", looks.GREEN, "^", 6, False, 3.4)
STOP = Mark("stop", looks.BROWN, "D", 6, False, 3.4)
DATUM = Mark("datum", INK, QUARTERS, 14, True, 3.6)
POLE = Mark("pole", looks.BROWN, "+", 8, True, 3.5)
TOUCH = Mark("touch", looks.VIOLET, "o", 3.5, True, 3.45)
START = Mark("start", INK, "o", 9, False, 4.0)
HOME = Mark("from home", INK, "o", 6, False, 4.0)
END = Mark("end", INK, "s", 4, True, 4.1)
GOUGED = Mark("gouge", looks.WRONG, "*", 8, False, 4.15)  # where a compensated tool cuts into its contour
ALARM = Mark("alarm", looks.WRONG, "x", 9, True, 4.2)

#: Curves of a feed-rate profile: what was programmed, what is reached, and limits.
WANTED = LineStyle("programmed feed", looks.GREY, (0, (4, 1.5)), 1.3, 2.2)
REACHED = LineStyle("reached feed", looks.BLUE, "-", 1.5, 2.8)
LIMIT = LineStyle("limit", looks.WRONG, (0, (1, 1.5)), 1.2, 3.0)  # over what reaches it
AXES = (
    LineStyle("X", looks.BLUE, "-", 1.3, 2.8),
    LineStyle("Y", looks.WRONG, (0, (5, 1.5)), 1.3, 2.7),
    LineStyle("Z", looks.GREEN, (0, (1.5, 1.2)), 1.5, 2.6),
)
STANDS = Mark("stop", INK, "|", 7, True, 3.6)
SLOW_CORNER = Mark("corner", looks.BROWN, "v", 4, False, 3.5)

#: What holds the speed, from dark to light: colour, and the hatching that tells them apart in grey print.
HOLDS = {
    "acceleration": (looks.BLUE, ""),
    "jerk": (looks.VIOLET, "////"),
    "corner": (looks.BROWN, "...."),
    "turning": ("#00897b", "xxxx"),
    "axis speed": ("#e07b39", "\\\\\\\\"),
    "feed": ("#cfd8dc", ""),
    "standing": ("#ffffff", ""),
}
USEFUL, LOST = (looks.BLUE, ""), ("#f2c14e", "////")

#: Radius compensation: the contour, the tool-centre path by the rule that made it, and corners by what was done there.
CONTOUR = LineStyle("programmed", INK, "-", 1.5, 2.3)
LEAD = LineStyle("_programmed lead", looks.GREY, (0, (2, 2)), 0.9, 2.2)
UNCOMPENSATED = LineStyle("not compensated", "#6b6b6b", (0, (6, 2)), 1.0, 2.5)
ALONG = LineStyle("along the side", looks.BLUE, "-", 1.6, 2.8)
ROUND_CORNER = LineStyle("outside corner, arc", "#00796b", (0, (3, 1)), 2.0, 2.9)
STRAIGHT_CORNER = LineStyle("outside corner, straight", looks.BROWN, "-", 1.6, 2.9)
INSIDE_CORNER = LineStyle("inside corner", looks.VIOLET, "-", 1.6, 2.9)
ENTRY = LineStyle("entry", "#2e7d32", (0, (6, 1.5, 1.5, 1.5)), 1.6, 2.9)
EXIT = LineStyle("exit", "#b24700", (0, (6, 1.5, 1.5, 1.5, 1.5, 1.5)), 1.6, 2.9)
CHANGE = LineStyle("change of side", "#ad1457", (0, (4, 1.5)), 1.6, 2.9)
DISC, GOUGE = "#5f7d9c", looks.WRONG

#: What the words of a program mean: centres with their legs, poles with angles, the contour before it was turned.
CENTRE = Mark("arc centre", looks.BROWN, "+", 8, True, 3.5)
TURN_POLE = Mark("pole of a turn", looks.BROWN, "x", 6, True, 3.5)
SPOKE = LineStyle("_spoke", looks.BROWN, (0, (4, 2)), 0.8, 2.4)
LEG = LineStyle("_leg", looks.BROWN, "-", 1.1, 2.45)
ORIGINAL = LineStyle("as written", "#6b6b6b", (0, (2, 1.4)), 1.1, 2.15)
MIRROR = LineStyle("mirror line", "#6a1b9a", (0, (10, 2.5, 1.5, 2.5)), 1.0, 2.1)
#: A hole at its diameter: its circle from above, its walls from the side.
HOLE = LineStyle("hole", "#37474f", (0, (3, 1.6)), 0.9, 2.3)
#: Machine zero and the vectors from it.
MACHINE_ZERO = Mark("machine zero", looks.GREEN, QUARTERS, 14, True, 4.0)

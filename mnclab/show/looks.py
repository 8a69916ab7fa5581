"""How moves, materials and tools look, whatever they are drawn with: one table for pictures, drawings, bodies and the player.

A picture, an SVG in true size, the layers of a DXF, the lines of a glTF, a scene and the style sheet of the player take a
colour from here, so that a rapid is the same red in all of them. What differs in colour differs in form too (dashes, width),
for grey print and colour-blind eyes. All colours of lines have a contrast of at least 3 to 1 on white.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from mnclab.path.toolpath import Array, Kind
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown

PAPER, INK, FAINT = "#ffffff", "#1a1a1a", "#e3e3e3"
BLUE, RED, VIOLET, GREEN, GREY, BROWN, WRONG = "#1259a8", "#c62828", "#7b1fa2", "#00695c", "#8c8c8c", "#8a5a00", "#b3261e"

Dashes = str | tuple[float, tuple[float, ...]]


class LineStyle(NamedTuple):
    """A class of moves: dashes as matplotlib has them, width in points, higher `order` drawn later."""

    name: str
    colour: str
    dashes: Dashes
    width: float
    order: float

    def style(self) -> dict[str, Any]:
        look = {"color": self.colour, "linestyle": self.dashes, "linewidth": self.width, "solid_capstyle": "butt"}
        return look | {"zorder": self.order, "label": self.name}


#: Rapids are thinner than cuts and lie above them: where both run on one line (pecking), both are seen.
RAPID = LineStyle("rapid", RED, (0, (5, 3)), 0.9, 3.0)
FEED = LineStyle("feed", BLUE, "-", 1.9, 2.6)
PROBING = LineStyle("probing", VIOLET, (0, (1, 1.2)), 1.6, 2.8)
#: A thread on a lathe: the tool goes on by the lead in every revolution.
THREAD = LineStyle("thread", GREEN, (0, (7, 1.2, 1.5, 1.2)), 1.9, 2.7)
PROGRAMMED = LineStyle("programmed", GREY, "-", 0.9, 2.2)
BLANK = LineStyle("blank", "#9a8f6e", "-", 0.8, 1.4)


class Move(NamedTuple):
    """How the moves of some kinds look where they are drawn in true size, and on dark ground.

    `width` and `dashes` mm, of an SVG; `number` is that of the colour in AutoCAD, `dark` the colour on dark ground.
    """

    line: LineStyle
    kinds: tuple[Kind, ...]
    width: float
    dashes: tuple[float, ...]
    number: int
    dark: str

    @property
    def name(self) -> str:
        return self.line.name

    @property
    def on_both_grounds(self) -> tuple[str, str]:
        """The colour on white, and on dark ground."""
        return self.line.colour, self.dark

    @property
    def css(self) -> str:
        """The rule of an SVG for paths of this class."""
        dashes = f";stroke-dasharray:{' '.join(f'{length:g}' for length in self.dashes)}" * bool(self.dashes)
        return f".{self.name}{{stroke:{self.line.colour};stroke-width:{self.width:g}{dashes}}}"


#: The colour of a class of moves stands above, on white, and here, where a medium has colours of its own.
MOVES = (
    Move(RAPID, (Kind.RAPID,), 0.15, (2, 1.2), 1, "#ff7d73"),
    Move(FEED, (Kind.LINE, Kind.ARC), 0.25, (), 5, "#6cb2ff"),
    Move(PROBING, (Kind.PROBE,), 0.25, (0.4, 0.6), 6, "#d39bec"),
)
#: The look of a kind of move.
OF_KIND = {kind: move for move in MOVES for kind in move.kinds}

#: Materials: what is raw, what is cut and its edges; a blank under a picture; edges of bodies in space.
RAW, METAL, METAL_EDGE, UNCUT = "#f4f1e8", "#d9d5c8", "#7d7664", "#f3efe2"
#: The holder of a lathe tool and its insert; fixtures and their edges.
STEEL, CARBIDE, FIXTURE, FIXTURE_EDGE = "#c9ccd1", "#e9c46a", "#a9b0b7", "#5c6166"
#: Bodies in space: the tool and the blank.
TOOL_BODY, BLANK_BODY = "#73787f", "#bfb8a6"
BEAM = "#2e7d32"  # of a tool setter


def rgb(colour: str) -> tuple[float, float, float]:
    """Red, green and blue, 0 to 1."""
    red, green, blue = (int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return red, green, blue


#: Variables of the player's style sheet: on white, and on dark ground.
PLAYER = {
    "rapid": OF_KIND[Kind.RAPID].on_both_grounds,
    "cut": OF_KIND[Kind.LINE].on_both_grounds,
    "probing": OF_KIND[Kind.PROBE].on_both_grounds,
    "contour": (PROGRAMMED.colour, "#7d848a"),
    "blank": (BLANK.colour, "#a59a78"),
    "insert": (f"{CARBIDE}99", f"{CARBIDE}99"),
    "holder": (f"{STEEL}66", f"{STEEL}66"),
    "chuck": (FIXTURE, "#4c5359"),
    "beam": (BEAM, "#66bb6a"),
    "turning": (VIOLET, "#d39bec"),
    "plane": (GREEN, "#5fd6a4"),
}


def player_css() -> str:
    """The colours of the player as variables of its style sheet, on white and on dark ground."""
    light, dark = (" ".join(f"--{name}: {pair[k]};" for name, pair in PLAYER.items()) for k in (0, 1))
    return f':root {{ {light} }}\n:root[data-shown="dark"] {{ {dark} }}'


def places_of(collisions: Iterable[Any]) -> Array:
    """Where something collides (n, 3)."""
    try:
        return np.array([each.place for each in collisions], dtype=np.float64).reshape(-1, 3)
    except (TypeError, AttributeError):
        raise Alarm(f"collisions must be those of a run, got {shown(collisions)}", hint="run.collisions()") from None

"""Figures and contours of trial programs: what a transformation moves and what a contour cycle machines. Lengths in mm."""

from __future__ import annotations

#: Cycles that place what comes after them: a figure is cut before and after.
MOVED = tuple(f"CYCL DEF {n}" for n in (7, 8, 10, 11, 19, 26))
SHOWN = ("CALL LBL 1",)
#: No symmetry, so that a mirror image and a rotation can be told apart.
FIGURE = """LBL 1
L X+10 Y+5 R0 FMAX
L Z-2 F200
L X+50
L Y+15
L X+20
L Y+30
L X+10
L Y+5
L Z+50 FMAX
LBL 0""".splitlines()

#: A pocket, an island in it, and a second pocket that overlaps the first.
CONTOURS = """LBL 1
L X+0 Y+30 RR
L Y+60
RND R10
L X+90
RND R10
L Y+0
RND R10
L X+0
RND R10
L Y+30
LBL 0
LBL 2
L X+20 Y+30 RL
CC X+30 Y+30
C X+20 Y+30 DR-
LBL 0
LBL 3
L X+105 Y+30 RR
CC X+90 Y+30
C X+105 Y+30 DR-
LBL 0""".splitlines()


def line(*blocks: str) -> list[str]:
    """The label of one contour."""
    return ["LBL 1", *blocks, "LBL 0"]


TRAIN = ("L X+10 Y+0 RL", "L Y+25", "RND R8", "L X+40", "L X+55 Y+10", "CR X+85 Y+10 R20 DR-", "L Y+40")
WITHOUT_SIDE = ("L X+10 Y+0 R0", *TRAIN[1:])
IN_SPACE = ("L X+10 Y+0 Z+0 RL", "L Y+25 Z-2", "L X+40 Z-6", "L X+55 Y+10 Z-6", "CR X+85 Y+10 R20 DR-", "L Y+40 Z+0")
CENTRE_LINE = ("L X+0 Y+0", "L X+40", "RND R20", "L Y+45", "CR X+85 Y+45 R22.5 DR-", "L Y+20")
ON_CYLINDER = ("L X+0 Y+0 RL", "L X+50", "RND R20", "L Y+45", "L X+90 Y+65")
#: By cycle, the one contour that it machines.
LINES = {
    "CYCL DEF 25": line(*TRAIN), "CYCL DEF 270": line(*WITHOUT_SIDE), "CYCL DEF 276": line(*IN_SPACE),
    "CYCL DEF 275": line(*CENTRE_LINE),
    **{f"CYCL DEF {n}": line(*ON_CYLINDER) for n in (27, 28, 29, 39)},
}  # fmt: skip
#: The program that cycle 12 runs to begin with, by its name.
FILES = {
    "ABC.H": "BEGIN PGM ABC MM\nL Z+2 R0 FMAX\nL Z-5 F200\nL IX+15\nL IY+10\nL IX-15\nL IY-10\nL Z+50 FMAX\nEND PGM ABC MM\n"
}

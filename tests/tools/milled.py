"""Parts that tests mill: one way to cut a block, and the tools they do it with."""

from __future__ import annotations

import numpy as np

from mnclab import Tool
from mnclab.workpiece.milling.milled import Milled
from tools.running import run

MILL = Tool(radius=5, number=1, kind="mill")
BALL = Tool(radius=4, corner=4, number=1, kind="mill")
BULL = Tool(radius=5, corner=1.5, number=1, kind="mill")
DRILL = Tool(radius=3, number=1, kind="drill", angle=118)
BLOCK = ((0, 0, -20), (60, 40, 0))


def part(text: str, tool: Tool = MILL, stock=BLOCK, **given) -> Milled:
    """What is left after moves in MNC that begin 50 mm above the blank; line 5 of the program is their first."""
    setup = {"tools": {1: tool}, "stock": stock}
    return run(f"G17 G90 G54\nT1\nS1000 M3 F500\nG0 Z50\n{text}", **setup).workpiece(**given)


def is_closed(solid):
    """Every edge twice, once in each sense."""
    edges = np.concatenate([solid.triangles[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 0))])
    there, back = edges @ (len(solid.points), 1), edges @ (1, len(solid.points))
    return len(np.unique(there)) == len(there) and np.array_equal(np.sort(there), np.sort(back))

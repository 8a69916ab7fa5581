"""The tools of a machine that was given none, so that a first program needs no table.

Lengths are 0: the tip is the spindle reference. A control says which magazine is its own (`Control.magazine`).
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from mnclab.path.tool import Tool

Magazine = Mapping[int, Tool]


def _end_mill(number: int, radius: float, edges: float, teeth: int) -> Tool:
    return Tool(
        radius, number=number, name=f"end mill {2 * radius:g}", plunge_angle=3, cutting_length=edges, teeth=teeth,
        kind="mill", centre_cutting=True,
    )  # fmt: skip


#: Of a mill.
MILLS: Magazine = MappingProxyType({
    0: Tool(number=0, name="none"),
    1: _end_mill(1, 5, edges=25, teeth=3),
    2: Tool(radius=4, number=2, name="drill 8", angle=118, cutting_length=60, teeth=2, kind="drill"),
    3: _end_mill(3, 3, edges=20, teeth=3),
    4: _end_mill(4, 2, edges=12, teeth=2),
    5: _end_mill(5, 8, edges=40, teeth=4),
    6: Tool(radius=2, number=6, name="probe 4", kind="probe"),
})  # fmt: skip

#: Of a lathe: a tip is the imaginary sharp point, the corner the radius of the nose. Main edges stand square to the axis:
#: the walls that a cycle runs along at rapid are cut then.
LATHES: Magazine = MappingProxyType({
    0: Tool(number=0, name="none"),
    1: Tool(number=1, name="roughing insert 80°", corner=0.8, main_angle=90, auxiliary_angle=10, kind="turning"),
    2: Tool(number=2, name="finishing insert 35°", corner=0.4, main_angle=90, auxiliary_angle=55, kind="turning"),
    3: Tool(number=3, name="grooving blade 3", width=3, kind="grooving"),
    4: Tool(number=4, name="threading insert 60°", main_angle=60, auxiliary_angle=60, cutting_length=2, kind="thread"),
    5: Tool(number=5, name="boring bar", corner=0.4, main_angle=90, auxiliary_angle=30, kind="boring"),
    6: Tool(number=6, name="drill 10", radius=5, angle=118, kind="drill"),
    7: Tool(number=7, name="face grooving blade 3", width=3, kind="face grooving"),
    8: Tool(radius=5, number=8, name="tap M10", pitch=1.5, kind="tap"),
})  # fmt: skip

"""What is on the machine before a program starts: tools, datums, blank, part, limits, and choices of the control."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple

from mnclab.path.limits import Limits
from mnclab.path.tool import Tool


class Datum(NamedTuple):
    """A zero point: machine coordinates in mm, rotary axes and the turn of the plane in degrees."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    a: float = 0.0
    b: float = 0.0
    c: float = 0.0
    rotation: float = 0.0


class Probe(NamedTuple):
    """A touch probe, lengths in mm and feeds in mm/min (TNC 620: columns of the touch probe table).

    The radius of its ball is that of the tool in the spindle.
    """

    clearance: float = 2.0  # SET_UP
    reach: float = 10.0  # DIST
    feed: float = 100.0  # F
    rapid: float = float("inf")  # FMAX


#: A small magazine, so that a first program needs no table. Lengths are 0: the tip is the spindle reference.
MAGAZINE: Mapping[int, Tool] = {
    0: Tool(number=0, name="none"),
    1: Tool(radius=5, number=1, name="end mill 10", plunge_angle=3, cutting_length=25, teeth=3, kind="mill"),
    2: Tool(radius=4, number=2, name="drill 8", angle=118, cutting_length=60, teeth=2, kind="drill"),
    3: Tool(radius=3, number=3, name="end mill 6", plunge_angle=3, cutting_length=20, teeth=3, kind="mill"),
    4: Tool(radius=2, number=4, name="end mill 4", plunge_angle=3, cutting_length=12, teeth=2, kind="mill"),
    5: Tool(radius=8, number=5, name="end mill 16", plunge_angle=3, cutting_length=40, teeth=4, kind="mill"),
    6: Tool(radius=2, number=6, name="probe 4", kind="probe"),
}


@dataclass(frozen=True)
class Setup:
    """Everything a program finds on the machine; never changed by a run.

    ``start`` is the spindle reference in machine coordinates, mm. ``part`` and ``stock`` stand in machine coordinates.
    ``files`` maps names to texts or paths of other programs and tables. ``settings`` overrides the declared choices of
    the control (``mnclab.help("settings", control)``). ``correctors`` are offsets along the axes, mm, of the controls whose
    words D or L name them. Tools given without a number get the one they are listed under.
    ``variables`` have their values before the program begins: what another program left (``run.variables``).
    ``stock`` is the blank: two corners, or a body of revolution (``mnclab.workpiece.blank.cylinder``); pictures show it.
    ``source`` is the file that the setup was read from: an alarm about one of its settings shows its line.
    """

    tools: Mapping[int, Tool] = field(default_factory=lambda: MAGAZINE)
    datums: Mapping[int, Datum | tuple[float, ...]] = field(default_factory=dict)
    presets: Mapping[int, Datum | tuple[float, ...]] = field(default_factory=dict)
    correctors: Mapping[int, Datum | tuple[float, ...]] = field(default_factory=dict)
    stock: Any = None
    part: Any = None
    probe: Probe = Probe()
    limits: Limits = field(default_factory=Limits)
    start: tuple[float, float, float] = (0.0, 0.0, 0.0)
    files: Mapping[str, str | Path] = field(default_factory=dict)
    settings: Mapping[str, Any] = field(default_factory=dict)
    kinematics: Any = None
    true_tools: Mapping[int, Tool] = field(default_factory=dict)
    variables: Mapping[str, float | str] = field(default_factory=dict)
    source: Any = field(default=None, compare=False, repr=False)

    def with_radius(self, radius: float) -> Setup:
        """The same machine with another radius, mm, in all its tools but the probes."""
        tools = {n: t if t.kind == "probe" else replace(t, radius=radius, dr=0.0) for n, t in self.tools.items()}
        return replace(self, tools=tools)

    def with_settings(self, **settings: Any) -> Setup:
        """The same machine with some settings changed."""
        return replace(self, settings={**self.settings, **settings}, source=None)


class Tables:
    """The tables of one run: copies that the program may write to."""

    def __init__(self, setup: Setup) -> None:
        numbered = {number: _numbered(tool, number) for number, tool in setup.tools.items()}
        self.tools: dict[int, Tool] = {0: MAGAZINE[0], **numbered}
        self.datums: dict[int, Datum] = {row: Datum(*datum) for row, datum in setup.datums.items()}
        self.presets: dict[int, Datum] = {row: Datum(*datum) for row, datum in setup.presets.items()}
        self.correctors: dict[int, Datum] = {row: Datum(*datum) for row, datum in setup.correctors.items()}

    def __repr__(self) -> str:
        return f"<Tables: {len(self.tools)} tools, {len(self.datums)} datums, {len(self.presets)} presets>"


def _numbered(tool: Tool, number: int) -> Tool:
    return tool if tool.number == number else replace(tool, number=number)

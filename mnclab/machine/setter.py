"""A tool setter on the machine: a plate that a tool touches, or a laser beam that it breaks."""

from __future__ import annotations

from dataclasses import dataclass, fields

from mnclab.text.alarm import Alarm
from mnclab.text.calls import fitting_class
from mnclab.text.given import check_number, check_point, shown
from mnclab.text.records import written
from mnclab.workpiece.part import Part, cylinder

AXES = ("", "X", "Y")
THICK = 10.0  # mm, of the body of a plate
Place = tuple[float, float, float]


@fitting_class
@dataclass(frozen=True)
class Setter:
    """A tool setter, mm, machine coordinates.

    `x`, `y`, `z` are where the control takes it to be: the middle of the upper side of a round plate of a `diameter`; or,
    where `axis` says "X" or "Y", a point of a beam along that axis. `off` (x, y, z) is how far it truly stands from there,
    which a control finds when it calibrates. `slope` is how much the beam rises for each mm along its axis.
    """

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    diameter: float = 40.0
    axis: str = ""
    slope: float = 0.0
    off: Place = (0.0, 0.0, 0.0)

    __repr__ = written

    def __post_init__(self) -> None:
        if self.axis not in AXES:
            raise Alarm(f'the axis of a tool setter must be "X", "Y", or "" of a plate, got {shown(self.axis)}')
        for each in fields(self):
            if each.name not in ("axis", "off"):
                check_number(getattr(self, each.name), f"the {each.name} of a tool setter")
        check_number(self.diameter, "the diameter of a tool setter", above=0)
        check_point(self.off, "the place off of a tool setter")
        object.__setattr__(self, "off", tuple(map(float, self.off)))

    @property
    def place(self) -> Place:
        """Where it truly is."""
        dx, dy, dz = self.off
        return self.x + dx, self.y + dy, self.z + dz

    @property
    def part(self) -> Part | None:
        """The plate as a body where it truly is, for pictures and among the fixtures; a beam has none."""
        x, y, z = self.place
        return None if self.axis else cylinder((x, y, z - THICK), (x, y, z), self.radius)

    @property
    def radius(self) -> float:
        """Of the plate; a beam has none."""
        return 0.0 if self.axis else self.diameter / 2

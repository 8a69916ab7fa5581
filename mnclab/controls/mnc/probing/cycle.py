"""What all measuring cycles of the MNC share: what refuses them, how the probe approaches (MNC 12: probe table, probe motion).

Coordinates are absolute under G90 and G91; the ball's centre runs on the stated lines, z is the south pole of the ball.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from typing import Any, ClassVar

from mnclab.controls.mnc.probing.datum import set_datum
from mnclab.controls.word_address.holes import out_of_place
from mnclab.machine.cycle import Cycle
from mnclab.machine.machine import Machine
from mnclab.machine.touching import PROBES, unfit
from mnclab.machining.probing.sequences import Approach, from_above
from mnclab.machining.steps import Measure, Step

Moves = Generator[Step, Any, None]
Found = dict[int, tuple[float, float]]  # by axis: its measured coordinate and the one that it gets
SCALES = ("scaling", "mirror")
TURNS = (*SCALES, "rotation")
LIMITS = (("min_size", "max_size"), ("min_size_x", "max_size_x"), ("min_size_y", "max_size_y"))
NEEDED_WITH_F = ("z_probe_x", "z_probe_y", "z_probe_z")

ROWS = 99  # of the datum table, at least (MNC-DATUM-ROWS)


class MeasuringCycle(Cycle):
    """Base of the cycles of chapter 12: who inherits declares the parameters, Q and H among them."""

    does: ClassVar[str] = PROBES
    refused: ClassVar[tuple[str, ...]] = SCALES
    """Frames that must not be active."""
    entered: ClassVar[tuple[str, ...]] = ()
    """The sizes of a figure that the ball must enter."""
    inside: ClassVar[bool] = True
    """Whether a figure is touched from within."""

    x: Any = 0.0  # some cycles can do without these three
    y: Any = 0.0
    width: Any = 0.0
    diameter = length_x = length_y = 0.0
    axis = direction = 1.0
    x_new = y_new = new_coordinate = rotate = 0.0
    clearance = level = height = between = row = apply = probe_z = z_new = protocol = stop_on_error = 0.0
    x2 = y2 = 0.0
    z_probe_x: Any = None
    z_probe_y: Any = None
    z_probe_z: Any = None
    max_size: Any = None
    min_size: Any = None
    max_size_x: Any = None
    min_size_x: Any = None
    max_size_y: Any = None
    min_size_y: Any = None
    tol_center_x: Any = None
    tol_center_y: Any = None

    def contradictions(self) -> Iterator[tuple[str, str]]:
        for name in NEEDED_WITH_F if self.probe_z else ():
            if getattr(self, name) is None:
                yield name, "is missing: F1 needs it"
        for name, other in LIMITS:
            least, most = getattr(self, name), getattr(self, other)
            if least and most and least > most:
                yield name, f"must be at most the greatest permissible size {most:g}, got {least:g}"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from unplaced(m)
        yield from unfit(m, still=True)
        for name in self.refused:
            if name in m.frames:
                yield "", f"cannot run while a {name} is active"
        rows = max(int(m.settings["datum_rows"]), ROWS)
        if self.row > rows and int(self.row) not in m.tables.datums:
            yield "row", f"must be at most {rows}, the rows that the datum table has, got {self.row:g}"
        yield from self.low(self.approach(m))
        yield from self.fits(m, **{name: getattr(self, name) for name in self.entered})

    def about(self, m: Machine) -> tuple[float, float]:
        return 0.0, 0.0

    def approach(self, m: Machine, **other: Any) -> Approach:
        """How the probe of the table moves in this cycle; `other` values of it."""
        probe = m.tables.probe
        found = {
            "ball": m.radius, "gap": probe.clearance + self.clearance, "level": self.level, "height": self.height,
            "reach": probe.reach, "feed": probe.feed, "positioning": probe.positioning_feed, "over": self.between == 1,
            "track": probe.track,
        }  # fmt: skip
        return Approach(**{**found, **other})

    def low(self, a: Approach) -> Iterator[tuple[str, str]]:
        """A safe height below the measuring height, or below where the touch along Z begins."""
        yield from self.below(a, a.pole)
        if self.z_probe_z is not None and self.probe_z:
            yield from self.below(a, self.z_probe_z + a.gap)

    def below(self, a: Approach, z: float) -> Iterator[tuple[str, str]]:
        if a.height < z:
            yield "height", f"must not lie below the ball's lowest point where a touch begins, {z:g}, got {a.height:g}"

    def fits(self, m: Machine, **sizes: float) -> Iterator[tuple[str, str]]:
        """A figure that the ball does not enter."""
        for name, given in sizes.items():
            if given <= 2 * m.radius:
                yield name, f"must be greater than the diameter of the ball, {2 * m.radius:g}, got {given:g}"

    def finish(self, m: Machine, a: Approach, found: Found, turned: float | None = None) -> Moves:
        """With F1 the touch from above, at the safe height before and after; then the datum of the axes that were `found`."""
        if self.probe_z and self.z_probe_x is not None and self.z_probe_y is not None and self.z_probe_z is not None:
            contact = yield from from_above(a, self.z_probe_x, self.z_probe_y, self.z_probe_z, a.height)
            z = contact.point[2] - a.ball
            yield Measure("Z", z, self.z_probe_z, touches=(contact.number,))
            found = {**found, 2: (z, self.z_new)}
        yield from set_datum(m, found, self.row, self.apply == 1, turned)


def unplaced(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault in machine coordinates, under radius compensation, or in another plane."""
    yield from out_of_place(m)
    if m.plane != "XY":
        yield "", f"needs the plane G17, {m.modal.get('plane', m.plane)} is active"

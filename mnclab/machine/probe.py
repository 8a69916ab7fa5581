"""What measures on a machine: the touch probe and the tool setter."""

from __future__ import annotations

from dataclasses import dataclass, fields

from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, check_point, choice, fitting_class, shown
from mnclab.text.tables import written
from mnclab.workpiece.part import Part, cylinder

# The touch probe: its row of the probe table, and what is true of it beside the table.
# The radius and the length that a control knows are those of the tool in the spindle; the true ones are those of
# `Setup(true_tools=…)`, and where nothing is said there, the same.

FEEDS = {"probe": "the feed `rapid` of the probe", "machine": "the rapid traverse of the machine"}
ENDLESS = ("rapid",)
POSITIVE = ("reach", "feed", "rapid", "stem_length")
POINTS = {"offset": 2, "true_offset": 2, "deflection": 3}


@fitting_class
@dataclass(frozen=True)
class Probe:
    """A touch probe, lengths in mm, angles in degrees, feeds in mm/min.

    As the table of the control has it (TNC 620 13.3, MNC 12): `clearance` (SET_UP, PR_CLR), `reach` (DIST, MAX_DIST), `feed`
    (F, F_MEAS), `rapid` (FMAX, F_POS), which of `FEEDS` positions (F_PREPOS), `track` (TRACK), `angle` of the spindle for
    which it was calibrated (CAL_ANG) and the `offset` (x, y) of the ball from the spindle axis (CAL_OF1, CAL_OF2).

    As it is: the `true_offset` (x, y) of the ball (None: as the table has it), the `deflection` (x, y, z) by which it goes on
    until it triggers, the standard deviation `spread` of a trigger with the `seed` of its randomness, and the stem: a
    cylinder of `stem` radius (0: not judged) that goes up from the ball by `stem_length`.

    >>> mnc.Probe(reach=20).clearance
    2.0
    """

    clearance: float = 2.0
    reach: float = 10.0
    feed: float = 100.0
    rapid: float = float("inf")
    positioning: str = "probe"
    track: bool = False
    angle: float = 0.0
    offset: tuple[float, float] = (0.0, 0.0)
    true_offset: tuple[float, float] | None = None
    deflection: tuple[float, float, float] = (0.0, 0.0, 0.0)
    spread: float = 0.0
    seed: int = 0
    stem: float = 0.0
    stem_length: float = 40.0

    __repr__ = written

    def __post_init__(self) -> None:
        for each in fields(self):
            name, value, what = each.name, getattr(self, each.name), f"the {each.name.replace('_', ' ')} of a probe"
            if name == "positioning":
                choice(value, what, FEEDS)
            elif name == "track":
                if not isinstance(value, bool):
                    raise Alarm(f"{what} must be True or False, got {value!r}")
            elif name in POINTS:
                if value is not None:
                    check_point(value, what, flat=POINTS[name] == 2)
                    object.__setattr__(self, name, tuple(map(float, value)))
                if name == "deflection" and min(value) < 0:
                    raise Alarm(f"{what} must be at least 0 along each axis: it goes on by it, got {value}")
            elif name in POSITIVE:
                check_number(value, what, above=0, endless=name in ENDLESS)
            else:
                check_number(value, what, at_least=None if name == "angle" else 0)
        if self.seed != int(self.seed):
            raise Alarm(f"the seed of a probe must be a whole number, got {self.seed:g}")

    @property
    def positioning_feed(self) -> float:
        """Between the touches, mm/min."""
        return self.rapid if self.positioning == "probe" else float("inf")

    @property
    def where(self) -> tuple[float, float]:
        """Where the ball truly is beside the spindle axis, the spindle at the calibration angle."""
        return self.offset if self.true_offset is None else self.true_offset


# A tool setter on the machine: a plate that a tool touches, or a laser beam that it breaks.

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

    >>> mnc.Setter(x=300, y=200, z=50)
    Setter(x=300, y=200, z=50)
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

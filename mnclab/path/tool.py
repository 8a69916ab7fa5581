"""A tool: its dimensions, as a tool table holds them."""

from __future__ import annotations

import math
from dataclasses import InitVar, dataclass, fields, replace
from functools import wraps
from inspect import Parameter, signature
from typing import TYPE_CHECKING, Any

from mnclab.text.alarm import Alarm, hint
from mnclab.text.file import File, as_table, check_names
from mnclab.text.given import check_number, check_point, fitting, fitting_class, of_python, shown
from mnclab.text.tables import svg_of, written

# What a tool table says for measuring a tool: how far it may wear, when it counts as broken, and where it is measured.

MOST_WEAR = 0.9999  # mm, of a tolerance (TNC 620 19.1)
OFFSETS = ("offset_length", "offset_radius")


@fitting_class
@dataclass(frozen=True)
class Wear:
    """Tolerances and offsets in mm, the columns of TOOL.T in TNC 620 19.1; a tolerance of 0 is not watched.

    `length`, `radius` and `corner` are the deviations from which a tool counts as worn (LTOL, RTOL, R2TOL), `break_length`
    and `break_radius` those from which it counts as broken (LBREAK, RBREAK). `offset_radius` is how far the axis of the tool
    stands beside the middle of the setter while its length is measured (R-OFFS; None: the tool radius), `offset_length` how
    much deeper than usual it stands while its radius is measured (L-OFFS).

    >>> mnc.Wear(length=0.1)
    Wear(length=0.1)
    """

    length: float = 0.0
    radius: float = 0.0
    corner: float = 0.0
    break_length: float = 0.0
    break_radius: float = 0.0
    offset_length: float = 0.0
    offset_radius: float | None = None

    __repr__ = written

    def __post_init__(self) -> None:
        for each in fields(self):
            value, what = getattr(self, each.name), f"the {each.name} in the wear of a tool"
            if each.name not in OFFSETS:
                check_number(value, what, at_least=0, at_most=MOST_WEAR)
            elif value is not None:
                check_number(value, what)


# Records from files (TOML): the fields of a tool, of limits, of whatever has fields.

TEXT_FIELDS = ("name", "kind", "hand", "corner_speed", "rapid_motion", "positioning", "axis")  # of a tool; of the limits; …


def record(kind: Any, value: Any, file: File, *keys: str) -> Any:
    """A Tool, Datum, Limits or Probe from a table of its fields; `keys` lead to it in the file."""
    where = ".".join(keys)
    with file.at(*keys):
        names = kind._fields if hasattr(kind, "_fields") else [field.name for field in fields(kind)]
        check_names(as_table(value, where), names, where, file, *keys)
        found = {name: _field(item) for name, item in value.items()}
        if "wear" in found:
            found["wear"] = record(Wear, value["wear"], file, *keys, "wear")
        for name, item in found.items():
            with file.at(*keys, name):
                _check_kind(value[name], f"{where}.{name}", name)
                kind(**{name: item})
        return kind(**found)


def _field(value: Any) -> Any:
    return tuple(map(_field, value)) if isinstance(value, list) else value


def _check_kind(value: Any, where: str, name: str) -> None:
    """An Alarm unless a field is a text where it must be one, else a number or a list of them."""
    if name in TEXT_FIELDS and not isinstance(value, str):
        raise Alarm(f"{where} must be a text, got {shown(value)}")
    for each in value if isinstance(value, list) else [] if isinstance(value, bool) else [value]:
        if name not in (*TEXT_FIELDS, "wear") and not isinstance(each, list):
            check_number(each, where, endless=True)


TEXTS = ("name", "kind", "hand")
HANDS = ("right", "left")
KINDS = (
    "", "mill", "face mill", "thread mill", "chamfer", "drill", "reamer", "countersink", "tap", "probe",
    "turning", "boring", "grooving", "face grooving", "thread",
)  # fmt: skip
LATHE = ("turning", "boring", "grooving", "face grooving", "thread")  # their corner is the nose, whatever the radius
WIDENS = ("reamer", "tap")
MINOR = 5 / 8 * math.sqrt(3) / 2  # of the pitch: how deep an ISO thread is, 5/8 of the height of its sharp triangle (ISO 68-1)
CHAMFER = 3.0  # turns of a tap that lead it into its hole, narrower than its thread (DIN 2197, form C)
POINTED = {"drill": 118.0, "countersink": 90.0, "chamfer": 90.0}  # degrees, the included angle where a tool gives none
MOST = 1e9  # of every number of a tool
BODIES = ("centre_cutting", "shank", "holder", "wear", "locked", "runout", "edges")  # no plain numbers
SIZES = ("radius", "corner", "teeth", "cutting_length", "width", "number", "angle", "plunge_angle")  # never negative


@dataclass(frozen=True)
class Tool:
    """Dimensions in mm, angles in degrees; `diameter=10` may be said for `radius=5`. `kind` is one of `KINDS`, "" where it does
    not matter.

    `angle` is the point angle, `plunge_angle` the steepest plunge, `dl` and `dr` are deltas added to length and
    radius, `corner` is the corner radius, `cutting_length` the length of the edges, `pitch` that of a tap.
    Of a lathe tool `main_angle` and `auxiliary_angle` lie between the cutting edges and the axis (0: not given),
    `width` is that of a grooving tool, whose tip is its left corner (of one for faces the corner nearer to the axis), or of
    the V of a threading insert, whose included `angle` is 60 where none is given; `corner` the nose radius. Turning inserts
    and points of drills have usual angles where none are given (`path.inserts.USUAL`, `POINTED`); a blade without
    a width has no edge, and a part that it cuts says so. The programmed tip of a lathe tool is the imaginary sharp point.
    Its edges count from there, a blade reaches `cutting_length` deep: 0 is 12 mm, of a blade 8 times its width.

    Collisions are judged by `cutting_length`, `centre_cutting` (None: whether it may plunge is not judged), `hand` ("right"
    turns with M3), `shank`, the radius of what is behind the edges and how far above the tip it begins, and `holder`, such
    pairs from the tip up. Of chamfer tools and countersinks `angle` is the included one.

    `wear` are the tolerances and offsets for measuring the tool, a `locked` tool is not to be called again. Of a true tool
    (`Setup.true_tools`) `edges` are the deviations (length, radius) of its single edges and `runout` is how far (x, y) its
    axis stands beside that of the spindle, both as seen at the spindle angle 0.

    An Alarm names a dimension that makes no sense. Negative may be the deltas, and the length against a zero tool; a
    radius below 0 is written as a negative `dr`.

    >>> mnc.Tool(diameter=10, teeth=2)
    Tool(radius=5, teeth=2)
    """

    radius: float = 0.0
    length: float = 0.0
    number: int = 0
    name: str = ""
    corner: float = 0.0
    angle: float = 0.0
    plunge_angle: float = 0.0
    dl: float = 0.0
    dr: float = 0.0
    teeth: int = 0
    cutting_length: float = 0.0
    kind: str = ""
    pitch: float = 0.0
    main_angle: float = 0.0
    auxiliary_angle: float = 0.0
    width: float = 0.0
    centre_cutting: bool | None = None
    hand: str = "right"
    shank: tuple[float, float] | None = None
    holder: tuple[tuple[float, float], ...] = ()
    wear: Wear = Wear()
    locked: bool = False
    runout: tuple[float, float] = (0.0, 0.0)
    edges: tuple[tuple[float, float], ...] = ()
    if TYPE_CHECKING:  # what `_with_diameter` adds
        diameter: InitVar[float | None] = None

    __repr__ = written

    def _repr_svg_(self) -> str | None:
        from mnclab.path.inserts import silhouette

        return svg_of(silhouette(self), sketch=True)

    def __post_init__(self, diameter: float | None = None) -> None:  # `diameter` for type checkers alone
        for each in fields(self):
            object.__setattr__(self, each.name, of_python(getattr(self, each.name)))
        for each in fields(self):
            value, what = getattr(self, each.name), f"the {each.name.replace('_', ' ')} of a tool"
            if each.name in BODIES:
                continue
            if each.name not in TEXTS:
                check_number(value, what, at_least=0 if each.name in SIZES else None, at_most=MOST)
            elif not isinstance(value, str):
                raise Alarm(f"{what} must be a text, got {shown(value)}")
        if self.teeth != int(self.teeth):
            raise Alarm(f"the teeth of a tool must be a whole number, got {shown(self.teeth)}")
        if self.kind not in KINDS:
            near = hint(self.kind[:40].lower(), KINDS[1:], 1) or f"known: {', '.join(KINDS[1:])}"
            raise Alarm(f"a tool cannot be of the kind {shown(self.kind)}", hint=near)
        if self.hand not in HANDS:
            raise Alarm(f"the hand of a tool must be right or left, got {shown(self.hand)}")
        self._check_body()
        self._check_measured()
        if 0 < self.radius < self.corner * (1 - 1e-9) and self.kind not in LATHE:
            found = f"{self.corner:g} and {self.radius:g}"
            raise Alarm(f"the corner radius of a tool must not be greater than its radius, got {found}")
        self._check_insert()

    def _check_insert(self) -> None:
        """An insert lies between its edges."""
        for name, angle in (("main", self.main_angle), ("auxiliary", self.auxiliary_angle)):
            if not 0 <= angle < 180:
                raise Alarm(f"the {name} angle of a tool must be from 0 (not given) to less than 180 degrees, got {angle:g}")
        if self.main_angle + self.auxiliary_angle > 180 + 1e-9:
            found = f"{self.main_angle:g} and {self.auxiliary_angle:g}"
            raise Alarm(f"main and auxiliary angle of a tool are 180 degrees at most, the insert lies between: got {found}")
        if self.kind == "thread" and self.angle >= 180:
            raise Alarm(f"the angle of a thread insert must be less than 180 degrees (0: 60), got {self.angle:g}")

    def _check_body(self) -> None:
        """What is behind the edges, as pairs of numbers; an Alarm where it is none, or grows downwards."""
        if not isinstance(self.centre_cutting, bool | None):
            raise Alarm(f"the centre_cutting of a tool must be True, False or None, got {shown(self.centre_cutting)}")
        if self.shank is not None:
            object.__setattr__(self, "shank", _pair("shank", self.shank))
        if not isinstance(self.holder, tuple | list):
            raise Alarm(f"the holder of a tool must be pairs of a radius and a height, mm, got {shown(self.holder)}")
        object.__setattr__(self, "holder", tuple(_pair("holder", each) for each in self.holder))
        heights = [height for _, height in self.holder]
        if heights != sorted(heights):
            raise Alarm(f"the holder of a tool is given from the tip up, got {shown(self.holder)}")

    def _check_measured(self) -> None:
        """What matters where the tool is measured."""
        for name, kind, be in (("wear", Wear, "a Wear"), ("locked", bool, "True or False"), ("edges", tuple | list, "pairs")):
            if not isinstance(getattr(self, name), kind):
                raise Alarm(f"the {name} of a tool must be {be}, got {shown(getattr(self, name))}")
        check_point(self.runout, "the runout of a tool", flat=True)
        object.__setattr__(self, "runout", tuple(map(float, self.runout)))
        for each in self.edges:
            check_point(each, "an edge of a tool, its deviations of length and radius", flat=True)
        object.__setattr__(self, "edges", tuple((float(length), float(radius)) for length, radius in self.edges))
        if self.edges and self.teeth not in (0, len(self.edges)):
            raise Alarm(f"the edges of a tool must be as many as its teeth, got {len(self.edges)} and {self.teeth:g}")

    @fitting
    def of_radius(self, radius: float, dr: float = 0.0) -> Tool:
        """The same tool with another radius, mm; a corner that this has no room for is as large as it."""
        room = self.kind in LATHE or not 0 < radius < self.corner
        return replace(self, radius=radius, dr=dr, corner=self.corner if room else radius)

    @property
    def effective_radius(self) -> float:
        return self.radius + self.dr

    @property
    def effective_length(self) -> float:
        return self.length + self.dl

    @property
    def opens_holes(self) -> bool:
        """Whether it goes straight down into full material; a reamer and a tap widen a hole, unless the table says otherwise."""
        return self.kind not in WIDENS or self.centre_cutting is True

    @property
    def core(self) -> float:
        """The radius of the hole that a tap needs at least, mm: half the minor diameter of an ISO thread, D - 1.0825 P (ISO 724).

        0 of any other tool, and where the table does not say the pitch.
        """
        return max(self.effective_radius - MINOR * self.pitch, 0.0) if self.kind == "tap" and self.pitch > 0 else 0.0


def _pair(name: str, given: Any) -> tuple[float, float]:
    """A radius and how far above the tip it begins, mm."""
    if not isinstance(given, tuple | list) or len(given) != 2:
        raise Alarm(f"the {name} of a tool is a radius and a height above the tip, mm, got {shown(given)}")
    for each, what in zip(given, ("radius", "height")):
        check_number(each, f"the {what} of the {name} of a tool", at_least=0)
    radius, height = map(float, given)
    return radius, height


def _with_diameter(made: type[Tool]) -> None:
    """A tool takes and has its diameter too: a field beside the radius would be the same fact twice."""
    init: Any = made.__init__

    @wraps(init)
    def __init__(self: Tool, *sizes: Any, diameter: Any = None, **named: Any) -> None:
        if diameter is not None:
            check_number(diameter, "the diameter of a tool", at_least=0, at_most=2 * MOST)
            if sizes or "radius" in named:
                raise Alarm("a tool has a radius or a diameter, not both: they are the same measure")
            named["radius"] = diameter / 2
        init(self, *sizes, **named)

    order = list(signature(init).parameters.values())
    also = Parameter("diameter", Parameter.KEYWORD_ONLY, default=None, annotation="float | None")
    setattr(__init__, "__signature__", signature(init).replace(parameters=[*order, also]))  # noqa: B010
    setattr(made, "__init__", fitting(__init__))  # noqa: B010
    setattr(made, "diameter", property(lambda tool: 2 * tool.radius, doc="Twice the radius, mm."))  # noqa: B010


_with_diameter(Tool)

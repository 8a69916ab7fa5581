"""A tool: its dimensions, as a tool table holds them."""

from __future__ import annotations

from dataclasses import dataclass, fields

from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown

TEXTS = ("name", "kind")
SIZES = ("radius", "corner", "teeth", "cutting_length", "width", "number", "angle", "plunge_angle")  # never negative


@dataclass(frozen=True)
class Tool:
    """Dimensions in mm, angles in degrees.

    ``angle`` is the point angle, ``plunge_angle`` the steepest plunge, ``dl`` and ``dr`` are deltas added to length and
    radius, ``corner`` is the corner radius, ``cutting_length`` the length of the edges, ``pitch`` that of a tap.
    Of a lathe tool ``main_angle`` and ``auxiliary_angle`` lie between the cutting edges and the axis (0: not given),
    ``width`` is that of a grooving tool, whose tip is its left corner, and ``corner`` the nose radius.

    An Alarm names a dimension that makes no sense. Negative may be the deltas, and the length against a zero tool; a
    radius below 0 is written as a negative ``dr``.
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

    def __post_init__(self) -> None:
        for each in fields(self):
            value, what = getattr(self, each.name), f"the {each.name.replace('_', ' ')} of a tool"
            if each.name not in TEXTS:
                check_number(value, what, at_least=0 if each.name in SIZES else None)
            elif not isinstance(value, str):
                raise Alarm(f"{what} must be a text, got {shown(value)}")

    @property
    def effective_radius(self) -> float:
        """Radius with its delta, mm."""
        return self.radius + self.dr

    @property
    def effective_length(self) -> float:
        """Length with its delta, mm."""
        return self.length + self.dl

"""What a drawing says in numbers: dimensions and notes with the points of a view to which they belong.

Points are (x, y) in mm of the view (true size, x to the right, y up), angles in rad. Where a dimension stands on the paper
is nobody's choice here: the layout finds a place, outside the view if it can. Texts are what a reader sees: a number with
its signs (`value` writes one), `⌀`, `R`, `M8`, `4×`, `°`; the signs of ISO 129-1 for depth `↧`, counterbore `⌴` and
countersink `⌵` may stand in any text.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from mnclab.text.given import check_number

Point = tuple[float, float]
Tolerance = float | tuple[float, float] | str | None  # ±, (lower, upper) or a class of ISO 286

MINUS = "\N{MINUS SIGN}"
DIGITS = 3  # decimals of a millimetre


class Value(NamedTuple):
    """The text of a dimension: "40", "⌀12", "4× R5"; `tolerance` is written behind it ("±0.1", "H7"), `limits` are the
    upper and the lower deviation, one above the other. A `reference` stands in brackets.
    """

    text: str
    tolerance: str = ""
    limits: tuple[str, str] | None = None
    reference: bool = False


def number(size: float, digits: int = DIGITS) -> str:
    """A number as drawings have it: no zeros at the end, a true minus sign."""
    text = f"{size + 0.0:.{digits}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return text.replace("-", MINUS) if float(text) else "0"


def value(
    nominal: float, before: str = "", tolerance: Tolerance = None, reference: bool = False, after: str = ""
) -> Value:
    """A number (mm, or degrees with `after="°"`) with its sign before it and its tolerance.

    `tolerance` is a number (±), the pair (lower, upper) of deviations, or a class such as "H7".
    """
    check_number(nominal, "the value of a dimension")
    text = f"{before}{number(nominal)}{after}"
    if tolerance is None or isinstance(tolerance, str):
        return Value(text, tolerance or "", None, reference)
    if isinstance(tolerance, tuple):
        lower, upper = (_deviation(each, after) for each in tolerance)
        return Value(text, "", (upper, lower), reference)
    return Value(text, f"±{number(tolerance)}{after}", None, reference)


def _deviation(size: float, unit: str) -> str:
    text = number(size)
    return text if text == "0" else f"{'+' if size > 0 else ''}{text}{unit}"


@dataclass(frozen=True)
class Linear:
    """The distance of two points: along x or y, or along the line through both (`along="ab"`).

    `side` is where it should stand: "above" or "below" (along x), "left" or "right" (along y; of the way from a to b for
    "ab"); without one the nearer side is taken. Dimensions on one side get rows, 10 mm from the view and 7 mm from each
    other, the shorter nearer; those that fit into one row stand in it as a chain. A diameter across a profile is a Linear
    with the sign ⌀ in its value. `inside` says that edges run from a and from b to where the other one lies, as those of a
    step of a shaft do: then the dimension line may stand between them.
    """

    a: Point
    b: Point
    value: Value
    along: str = "x"
    side: str = ""
    inside: bool = False


@dataclass(frozen=True)
class Diameter:
    """The diameter of a circle in its round view: a leader that points to the centre, or a line across a large circle.

    `more` are further lines of text below ("↧10", "⌴ ⌀11 ↧6.4").
    """

    centre: Point
    radius: float
    value: Value
    more: tuple[str, ...] = ()


@dataclass(frozen=True)
class Radius:
    """The radius of an arc, from the angle `start` over `sweep` (rad, signed): an arrow at the arc, along its radius."""

    centre: Point
    radius: float
    start: float
    sweep: float
    value: Value
    more: tuple[str, ...] = ()


@dataclass(frozen=True)
class Angle:
    """The angle at `vertex` from the leg through `a` counter-clockwise to the leg through `b`.

    `a` and `b` are the far ends of the edges, which begin `near` mm from the vertex: beyond them the legs are continued by
    thin lines.
    """

    vertex: Point
    a: Point
    b: Point
    value: Value
    near: float = 0.0


@dataclass(frozen=True)
class Note:
    """Text with a leader to a point: "1×45°", "M8 ↧12"; each text of `lines` is a line.

    With a `radius` (mm) the arrow ends anywhere on that circle about the point, and points to its centre.
    """

    at: Point
    lines: tuple[str, ...]
    radius: float = 0.0


Dimension = Linear | Diameter | Radius | Angle | Note

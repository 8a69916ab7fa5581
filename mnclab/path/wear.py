"""What a tool table says for measuring a tool: how far it may wear, when it counts as broken, and where it is measured."""

from __future__ import annotations

from dataclasses import dataclass, fields

from mnclab.text.given import check_number, fitting_class
from mnclab.text.tables import written

MOST = 0.9999  # mm, of a tolerance (TNC 620 19.1)
OFFSETS = ("offset_length", "offset_radius")


@fitting_class
@dataclass(frozen=True)
class Wear:
    """Tolerances and offsets in mm, the columns of TOOL.T in TNC 620 19.1; a tolerance of 0 is not watched.

    `length`, `radius` and `corner` are the deviations from which a tool counts as worn (LTOL, RTOL, R2TOL), `break_length`
    and `break_radius` those from which it counts as broken (LBREAK, RBREAK). `offset_radius` is how far the axis of the tool
    stands beside the middle of the setter while its length is measured (R-OFFS; None: the tool radius), `offset_length` how
    much deeper than usual it stands while its radius is measured (L-OFFS).
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
                check_number(value, what, at_least=0, at_most=MOST)
            elif value is not None:
                check_number(value, what)

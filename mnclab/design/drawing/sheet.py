"""The paper: sizes and frame by ISO 5457, scales by ISO 5455, what stands in the title block (ISO 7200) and beside it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from mnclab.text.alarm import Alarm

LEFT, MARGIN = 20.0, 10.0  # mm between the edge of the paper and the frame: on the left, on the other sides
SCALES = (50.0, 20.0, 10.0, 5.0, 2.0, 1.0, 1 / 2, 1 / 5, 1 / 10, 1 / 20, 1 / 50, 1 / 100)


class Size(NamedTuple):
    """A size of paper, mm."""

    name: str
    width: float
    height: float


SIZES = {
    "A4": Size("A4", 210.0, 297.0),
    "A4 landscape": Size("A4", 297.0, 210.0),
    "A3": Size("A3", 420.0, 297.0),
    "A2": Size("A2", 594.0, 420.0),
}


def scale_text(scale: float) -> str:
    """A scale as it is written: 2:1, 1:5."""
    return f"{scale:g}:1" if scale >= 1 else f"1:{1 / scale:g}"


@dataclass(frozen=True)
class Title:
    """What the title block says; an empty text leaves its field out or blank.

    `tolerance` is the general tolerance for dimensions without one.
    """

    title: str
    number: str = ""
    material: str = ""
    tolerance: str = "ISO 2768-m"
    date: str = ""
    drawn: str = ""
    owner: str = ""


@dataclass(frozen=True)
class Table:
    """A table beside the views, of holes for instance: a head and rows of texts, all of one length."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row) != len(self.head):
                raise Alarm(f"a row of the table {self.title!r} must have {len(self.head)} texts, got {len(row)}")

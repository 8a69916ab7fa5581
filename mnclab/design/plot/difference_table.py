"""The table of measures below the picture of a difference."""

from __future__ import annotations

from mnclab.design.difference.difference import Difference
from mnclab.design.difference.table import HEAD, NUMBERS
from mnclab.design.plot.difference_marks import Marked, number_of
from mnclab.show.plot import colours
from mnclab.show.plot.picture import LINE, SMALL, Picture

MOST = 60  # rows that a picture has room for
LETTER, GAP = 0.073, 0.16  # inches
OUT = "#b3261e"


def lines_of(difference: Difference, marks: list[Marked]) -> list[tuple[str, ...]]:
    """The head and the rows of the table, of a very long one those that are out; what is marked has its number before it."""
    every = len(difference.features) <= MOST
    kept = [k for k, row in enumerate(difference.features) if every or not row.ok][:MOST]
    texts = [("", *HEAD), *((number_of(difference, k, marks), *difference.features[k].texts()) for k in kept)]
    keep = [k for k in range(len(texts[0])) if any(row[k] for row in texts[1:])]
    return [tuple(row[k].replace("-", "\N{MINUS SIGN}") if row[k][:1] == "-" else row[k] for k in keep) for row in texts]


def wide_of(rows: list[tuple[str, ...]]) -> float:
    """How wide a picture must be for a table, inches."""
    return 0.2 + sum(_widths(rows[1:])) if rows else 0.0


def _widths(rows: list[tuple[str, ...]]) -> list[float]:
    return [LETTER * max(map(len, column)) + GAP for column in zip(*rows)]


def draw_table(picture: Picture, rows: list[tuple[str, ...]]) -> None:
    """The rows in the room kept for them at the foot, what is out bold."""
    if not rows:
        return
    rows = rows[1:]  # the first keeps room
    width, height = picture.get_size_inches().tolist()
    numbers = {HEAD[k] for k in NUMBERS}
    right = [name in numbers for name in rows[0]]
    wide = _widths(rows)
    starts = [0.1 + sum(wide[:k]) for k in range(len(wide))]
    verdict = rows[0].index("verdict")
    for line, row in enumerate(rows):
        y = (0.07 + LINE * (len(rows) - 1 - line)) / height
        out = line > 0 and row[verdict] in ("out", "not cut")
        for x, room, text, to_right in zip(starts, wide, row, right):
            place = x + room - GAP if to_right else x
            picture.text(
                place / width, y, text, fontsize=SMALL, ha="right" if to_right else "left", va="bottom",
                weight="bold" if out or line == 0 else "normal", color=OUT if out else colours.INK, parse_math=False,
            )  # fmt: skip

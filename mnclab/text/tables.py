"""What prints: tables, records, numbers; as text and as HTML."""

from __future__ import annotations

import csv
import io
import math
import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import MISSING, fields, is_dataclass
from html import escape
from itertools import zip_longest
from pathlib import Path
from typing import Any, ClassVar, Self, TypeVar

import numpy as np

from mnclab.text.columns import filled, parts, spelled
from mnclab.text.file import save_as
from mnclab.text.opening import require

# Tables for people, as HTML and as text: rows of texts under their heads, a line end in a cell begins a new line in it.
# Words stand to the left and numbers to the right, also where a notebook would set all to the right. Numbers of a column that
# have different decimals stand under each other by their points.

NUMBER = re.compile(r"[-+\N{MINUS SIGN}]?\d+(\.\d*)?")


def tail(text: str | None) -> str | None:
    """What a number has from its point on; None of what is no number."""
    found = NUMBER.fullmatch(text or "")
    return None if found is None else found[1] or ""


def html_table(
    head: Sequence[str],
    rows: Iterable[Sequence[str | None]],
    *,
    numbers: Collection[int] = (),
    code: Collection[int] = (),
    bold: Collection[int] = (),
) -> str:
    """A table of HTML; `numbers` are the columns that stand to the right, `code` those of program text, `bold` some rows.

    A cell of None belongs to the one above it, and the last cell of a short row to all columns that follow.
    """
    rows = list(rows)
    columns = len(head) or max(map(len, rows), default=0)
    tall = [1] * columns  # rows of the next cell of each column, counted from below
    longest = {k: max((len(tail(row[k]) or "") for row in rows if k < len(row)), default=0) for k in numbers}
    lines = []
    for number, row in reversed([*enumerate(rows)]):
        cells, weight = [], "; font-weight:bold" * (number in bold)
        for k, text in enumerate(row):
            if text is None:
                tall[k] += 1
                continue
            style = f"text-align:{'right' if k in numbers else 'left'}{'; vertical-align:top' * (tall[k] > 1)}{weight}"
            spans = f' rowspan="{tall[k]}"' if tall[k] > 1 else ""
            spans += f' colspan="{columns - k}"' if k + 1 == len(row) < columns else ""
            said = escape(text).replace("\n", "<br>")
            if k in longest and (end := tail(text)) is not None and len(end) < longest[k]:
                room = longest[k] - len(end) - (0.5 if not end else 0)  # a point is half as wide as a digit
                said = f'<span style="padding-right:{room:g}ch">{said}</span>'
            cells.append(f'<td style="{style}"{spans}>{f"<code>{said}</code>" if k in code and said else said}</td>')
            tall[k] = 1
        lines.append(f"<tr>{''.join(cells)}</tr>")
    sides = ("right" if k in numbers else "left" for k in range(columns))
    heads = (
        f'<th style="text-align:{side}; white-space:normal">{escape(name).replace(chr(10), "<br>")}</th>'
        for side, name in zip(sides, head)
    )
    top = f"<tr>{''.join(heads)}</tr>" if head else ""
    return f"<table>{top}{''.join(reversed(lines))}</table>"


def clock(seconds: float) -> str:
    """A time as people say it: `1:02:03`, `2:03` or `3.21 s`."""
    if seconds < 60:
        return f"{seconds:.2f} s"
    if not seconds < 1e12:  # without an end, such as a feed of almost nothing
        return f"{seconds:g} s"
    whole = round(seconds)
    hours, minutes = divmod(whole // 60, 60)
    return f"{hours}:{minutes:02d}:{whole % 60:02d}" if hours else f"{minutes}:{whole % 60:02d}"


def csv_text(head: Sequence[Any], *rows: Sequence[Any]) -> str:
    """A table as comma-separated values, a line each."""
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows([head, *rows])
    return out.getvalue()


def text_table(head: Sequence[str], rows: Iterable[Sequence[str]], numbers: Collection[int] = ()) -> str:
    """A table of text, with a rule below its heads; the columns `numbers` stand to the right."""
    rows = list(rows)
    longest = {k: max((len(tail(row[k]) or "") for row in rows), default=0) for k in numbers}
    lines = [*zip_longest(*(name.split("\n") for name in head), fillvalue="")]
    below = len(lines)
    for row in rows:
        cells = [
            text + " " * (longest[k] - len(end)) if k in longest and (end := tail(text)) is not None else text
            for k, text in enumerate(row)
        ]
        lines += zip_longest(*(cell.split("\n") for cell in cells), fillvalue="")
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    lines.insert(below, tuple("-" * width for width in widths))
    sides = [str.rjust if k in longest else str.ljust for k in range(len(widths))]
    return "\n".join("  ".join(side(text, width) for side, text, width in zip(sides, line, widths)).rstrip() for line in lines)


# Outlines for a cell: views of a body, of an area or of a tool, side by side at one scale, each with its measures.

ROOM, BESIDE = 220.0, 24.0  # pixels: of the longest side of a view, and between two
LOOK = 'fill-rule="evenodd" stroke="#1f5fa8" stroke-width="1.5" stroke-linejoin="round"'


def svg_of(*views: Sequence[np.ndarray], filled: bool = True, sketch: bool = False) -> str | None:
    """Views of lines (k, 2) in mm, areas with holes inside `filled` ones, as an SVG; a `sketch` has bodies over one another, and
    no measures. None where there is nothing to see."""
    boxes = [np.concatenate(view) for view in views if len(view)]
    size = max((float(np.ptp(box, axis=0).max()) for box in boxes), default=0.0)
    if not 0 < size < math.inf:
        return None
    drawn, left, scale = [], BESIDE / 2, ROOM / size
    tall = scale * max(float(np.ptp(box, axis=0)[1]) for box in boxes) + BESIDE / 2
    for view, box in zip(filter(len, views), boxes):
        low, (wide, high) = box.min(axis=0), np.ptp(box, axis=0)
        places = [((line - low) * scale * (1, -1) + (left, tall)).round(2).tolist() for line in view]
        paths = [f"M{' '.join(f'{x:g},{y:g}' for x, y in line)}{'Z' * filled}" for line in places]
        paths = paths if sketch else ["".join(paths)]
        drawn += [f'<path d="{path}" fill="{"#cfe0f1" if filled else "none"}" {LOOK}/>' for path in paths]
        said = "" if sketch else f"{wide:.5g} × {high:.5g} mm"
        drawn.append(f'<text x="{left:g}" y="{tall + 16:g}" font-size="12" font-family="sans-serif" fill="#777">{said}</text>')
        left += max(scale * wide, 8.0 * len(said)) + BESIDE
    return f'<svg xmlns="http://www.w3.org/2000/svg" width="{left:.0f}" height="{tall + BESIDE:.0f}">{"".join(drawn)}</svg>'


# Records that know their columns: one declaration gives the text, the table of a notebook, the file and the data frame.

def data_frame(columns: Mapping[str, Any]) -> Any:
    """Columns by their names as a data frame of pandas."""
    require("pandas", "data frames", "pandas", instead="columns() needs nothing")
    import pandas

    return pandas.DataFrame(columns)


def _of_text(cell: Any) -> Any:
    """A number that a table shows; nan for a cell without one, and what is no number as it is."""
    if cell in ("", "\N{EN DASH}"):
        return math.nan
    return float(cell.replace("\N{MINUS SIGN}", "-")) if isinstance(cell, str) and NUMBER.fullmatch(cell) else cell


class Listing(ABC):
    """What prints as a table and is saved as one: a class says its heads and the texts of its rows.

    `NUMBERS` are the columns that stand to the right, `CODE` those of program text, `LENGTHS` those whose heads name the unit of
    the program. `NOTHING` stands for a table without rows, and a notebook shows the first `MOST` ones. `reach` is "up to line 12,
    where the run stopped" of what is known only so far, else empty; `notes` are sentences that stand below.
    """

    HEAD: ClassVar[tuple[str, ...]]
    NUMBERS: ClassVar[Collection[int]] = ()
    LENGTHS: ClassVar[Collection[int]] = ()
    CODE: ClassVar[Collection[int]] = ()
    NOTHING: ClassVar[str] = ""
    MOST: ClassVar[int | None] = None
    unit: Any = None
    reach: str = ""
    notes: Sequence[str] = ()

    @property
    def head(self) -> tuple[str, ...]:
        """The heads of the columns, of lengths with their unit."""
        return tuple(f"{name}, {self.unit.short}" if k in self.LENGTHS else name for k, name in enumerate(self.HEAD))

    @abstractmethod
    def texts(self) -> list[tuple[str, ...]]:
        """What the table says, row by row, lengths in the unit of the program."""

    def table(self) -> tuple[tuple[str, ...], list[tuple[str, ...]], Collection[int]]:
        """Heads, rows of texts, and which columns are numbers."""
        return self.head, self.texts(), self.NUMBERS

    @property
    def bold(self) -> list[int]:
        """The rows that must be seen first."""
        return []

    @property
    def above(self) -> str:
        """What is said before the table."""
        return ""

    @property
    def nothing(self) -> str:
        """What is said in place of a table without rows."""
        return f"{self.NOTHING} {self.reach}".strip()

    def __repr__(self) -> str:
        head, rows, numbers = self.table()
        said = [text_table(head, rows, numbers), self.reach] if rows else [self.nothing]
        return "\n".join(filter(None, [self.above, *said, *self.notes]))

    def _repr_html_(self) -> str:
        head, rows, numbers = self.table()
        shown = html_table(head, rows[: self.MOST], numbers=numbers, code=self.CODE, bold=self.bold) if rows else ""
        more = f"… {len(rows) - self.MOST} more" if self.MOST is not None and len(rows) > self.MOST else ""
        said = [more, self.reach] if rows else [self.nothing]
        return paragraphs(self.above) + shown + paragraphs(*said, *self.notes)

    def record(self) -> tuple[Sequence[str], Sequence[Sequence[Any]], Collection[int]]:
        """Heads, each in a line, and rows of the file and of the data frame, and which columns are numbers."""
        head, rows, numbers = self.table()
        return [name.replace("\n", ", ") for name in head], rows, numbers

    def csv(self) -> str:
        """The table as comma-separated values."""
        head, rows, _ = self.record()
        return csv_text(head, *rows)

    def columns(self) -> dict[str, np.ndarray]:
        """The table as arrays, as it is shown."""
        head, rows, _ = self.table()
        return {name: np.array([row[k] for row in rows]) for k, name in enumerate(head)}

    def to_pandas(self) -> Any:
        """The table as a data frame of pandas: the columns of `csv()`, numbers as numbers, nan where there is none."""
        head, rows, numbers = self.record()
        of = [_of_text if k in numbers else str for k in range(len(head))]
        return data_frame({name: [of[k](row[k]) for row in rows] for k, name in enumerate(head)})

    def save(self, path: str | Path, **options: Any) -> Path:
        """Write the table (.csv), which takes no options."""
        return save_as(self, path, {".csv": write_csv}, "tables are saved as .csv, not as {}", **options)


def write_csv(listing: Any, path: Path) -> None:
    """The table of a listing, or of columns, as a file."""
    with path.open("w", encoding="utf-8", newline="") as file:
        file.writelines(listing.csv_parts() if isinstance(listing, Columned) else [listing.csv()])


def write_picture(what: Any, path: Path, **options: Any) -> None:
    """The picture that `plot` draws of something as a file."""
    from mnclab.show.plot.picture import write

    write(what.plot(**options), path)


class Pictured(ABC):
    """What has a picture, and is saved as one: a class says how to `plot` it (needs matplotlib)."""

    plot: Callable[..., Any]

    def save(self, path: str | Path, **options: Any) -> Path:
        """Write the picture (.svg, .pdf, .png), `options` such as `size="column"` are those of `plot`; or a table (.csv)."""
        writers: dict[str, Callable[..., None]] = dict.fromkeys((".svg", ".pdf", ".png"), write_picture)
        writers |= {".csv": write_csv} if hasattr(self, "csv") else {}
        return save_as(self, path, writers, "cannot write a picture as {}", **options)


class Columned(ABC):
    """What has long columns of numbers: an array by each name, all of one length."""

    @abstractmethod
    def columns(self) -> dict[str, np.ndarray]:
        """The columns (n,)."""

    @property
    def names(self) -> dict[str, Sequence[str]]:
        """Of columns whose numbers stand for names, by the name of the column."""
        return {}

    def csv_parts(self) -> Iterator[str]:
        """`csv()` some rows at a time; a label may need quotes."""
        columns = self.columns()
        columns |= {name: column.view(np.uint8) for name, column in columns.items() if column.dtype == np.bool_}
        quoted = {name: [csv_text((text, "")).removesuffix(",\n") for text in texts] for name, texts in self.names.items()}
        yield csv_text([*columns])
        for rows in parts(len(next(iter(columns.values())))):
            some = {name: column[rows] for name, column in columns.items()}
            some |= {name: spelled(texts, some[name]) for name, texts in quoted.items()}
            yield filled(",".join(["%s"] * len(some)) + "\n", some.values())

    def csv(self) -> str:
        """The columns as comma-separated values, numbers with all their digits and names as such."""
        return "".join(self.csv_parts())

    def to_pandas(self) -> Any:
        """The columns as a data frame of pandas: those of `csv()`."""
        columns = self.columns()
        return data_frame(columns | {name: spelled(texts, columns[name]) for name, texts in self.names.items()})


def paragraphs(*sentences: str) -> str:
    """Sentences as HTML, each in a paragraph of its own; empty ones are left out."""
    return "".join(f"<p>{escape(each)}</p>" for each in sentences if each)


Row = TypeVar("Row")


class Rows(Listing, Sequence[Row]):
    """A listing of rows in their order; a slice is a listing too."""

    def __init__(self, rows: Iterable[Row], unit: Any = None, reach: str = "") -> None:
        self._rows, self.unit, self.reach = tuple(rows), unit, reach

    def some(self, rows: Iterable[Row]) -> Self:
        """The same listing with other rows."""
        found = copy(self)
        found._rows = tuple(rows)
        return found

    def __len__(self) -> int:
        return len(self._rows)

    def __getitem__(self, which: Any) -> Any:
        return self.some(self._rows[which]) if isinstance(which, slice) else self._rows[which]


# How records print: as one would write them, or by the shapes of their columns; never their insides.

def written(record: Any) -> str:
    """A record as one would write it, without what is left at its default: `Tool(radius=5, kind='drill')`."""
    return _written(record, _value)


def exactly(record: Any) -> str:
    """The same with all digits of its numbers and of the records in it: read back by Python it is equal."""
    return _written(record, _exact)


def _written(record: Any, value_of: Callable[[Any], str]) -> str:
    said = [f"{name}={value_of(value)}" for name, value, default in _fields(record) if not _same(value, default)]
    return f"{type(record).__name__}({', '.join(said)})"


def shapes(record: Any) -> str:
    """A record of columns by their shapes: `<Pieces: t (9,), s (9,), v (9,)>`."""
    said = [f"{name} {np.shape(value)}" for name, value, _ in _fields(record) if isinstance(value, np.ndarray)]
    return f"<{type(record).__name__}: {', '.join(said)}>"


def _fields(record: Any) -> Iterator[tuple[str, Any, Any]]:
    """Name, value and default (`MISSING` without one) of each field of a dataclass or a named tuple."""
    if is_dataclass(record):
        for each in fields(record):
            default = each.default if each.default_factory is MISSING else each.default_factory()
            yield each.name, getattr(record, each.name), default
    else:
        for name in record._fields:
            yield name, getattr(record, name), record._field_defaults.get(name, MISSING)


def _same(value: Any, default: Any) -> bool:
    plain = type(value) in (int, float, str, bool, tuple, dict)
    return value is default or ((plain or is_dataclass(default) and type(value) is type(default)) and bool(value == default))


def _exact(value: Any) -> str:
    """A value with all its digits, records in it too."""
    if isinstance(value, float) and float(f"{value:.10g}") != value:
        return repr(float(value))
    nested = not isinstance(value, type) and (is_dataclass(value) or hasattr(value, "_fields"))
    return exactly(value) if nested else _value(value, _exact)


def _value(value: Any, inner: Callable[[Any], str] | None = None) -> str:
    """A value in short: whole numbers without a point, a mapping as a dict, a function by its name; `inner` writes parts."""
    inner = inner or _value
    if isinstance(value, float):
        return f"{value:.10g}"
    if isinstance(value, tuple) and not hasattr(value, "_fields"):
        return f"({', '.join(map(inner, value))}{',' * (len(value) == 1)})"
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{inner(key)}: {inner(each)}' for key, each in value.items())}}}"
    return getattr(value, "__name__", None) or repr(value)


# Numbers by their names that print as people read them, and keep all their digits.

DECIMALS = 3  # as the display of a control


class Rounded(dict[Any, float]):
    """A dict of numbers; it prints them with at most three decimals.

    >>> Rounded(cutting=2.911161243192578)
    {'cutting': 2.911}
    """

    def __repr__(self) -> str:
        return repr({key: round(value, DECIMALS) for key, value in self.items()})


# Columns that are given out cannot be written to: what a run says of itself stays true.

Column = TypeVar("Column", bound=np.ndarray)


def fixed(column: Column) -> Column:
    """The same numbers, read-only; the array itself stays as it is, for whoever still fills it."""
    if not column.flags.writeable:
        return column
    seen = column.view()
    seen.flags.writeable = False
    return seen

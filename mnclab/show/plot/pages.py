"""A document on pages of A4, as a PDF whose bytes are the same every time.

What belongs together stays together, long tables and programs go on with their heads.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import singledispatchmethod
from io import BytesIO
from itertools import takewhile
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.backends.backend_pdf import PdfPages

from mnclab.show.plot import colours
from mnclab.show.plot.page_sheet import (
    A4,
    AIR,
    BOTTOM,
    LEFT,
    LINE,
    MONO,
    POINTS,
    QUIET,
    RIGHT,
    TALL,
    TOP,
    WIDE,
    PrintedRow,
    Setting,
    Sheet,
    fitted,
    folded,
    tabled,
    width,
)
from mnclab.show.report.document import (
    BAD,
    QUOTED,
    Alarms,
    Blanks,
    Compared,
    Document,
    Image,
    Listing,
    Piece,
    Section,
    TextTable,
    Words,
    signed,
)
from mnclab.text.alarm import ALARM, WARNING, first_of
from mnclab.text.file import printable


def write(document: Document, path: Path) -> None:
    """Write the pages; the same document gives the same bytes."""
    data = BytesIO()
    undated = {"CreationDate": None, "Title": printable(document.title)}
    with mpl.rc_context({"pdf.fonttype": 42}), PdfPages(data, metadata=undated) as pages:
        for sheet in sheets(document):
            pages.savefig(sheet)
    path.write_bytes(data.getvalue())


TITLE, LONG_TITLE, HEADING, BODY, CAPTION, CODE, FOOT = 19.0, 12.0, 11.5, 9.0, 8.0, 7.8, 8.0  # points
LONG = 70  # letters of a title from which on it is set smaller
TITLE_LINES = 5
GAP, AFTER = 16.0, 7.0  # above a heading and between pieces
TONES = {"": colours.INK, BAD: "#a3221a", "good": "#1b5e20", "doubtful": "#6b4700"}
SHADES = {ALARM: "#f9d9d6", WARNING: "#fbebc4"}
SIGNS = {ALARM: "!", WARNING: "?"}
LISTED = 2000  # lines of the programs
SHARES = 1.0, 0.85, 0.7  # of their size, to which pictures are drawn smaller
LESS = 0.42  # of a page: in so much room a picture is drawn smaller, in less it stands on the next page
SHORT = 12  # rows of a table that stays with the words below it


def sheets(document: Document) -> list[Sheet]:
    """The pages of a document; where one would be less than half full, all pictures but the first are drawn smaller, or the page
    before the last ends earlier, if that helps."""
    tried: list[_Setter] = []
    for share in SHARES:
        tried.append(_Setter(document, share))
        if tried[-1].half_full:
            return tried[-1].pages
    for each in tried:
        end = each.ends[-1] - (TOP + TALL / 2 - each.y) - CODE * LINE  # a line more than what is missing
        if (other := _Setter(document, each.share, len(each.pages) - 1, end)).half_full:
            return other.pages
    return tried[0].pages


class _Setter:
    """Puts one piece after the other below what is there, on a new page where there is no room."""

    def __init__(self, document: Document, share: float = 1.0, short: int = 0, end: float = 0.0) -> None:
        self.document, self.share = document, share  # of the size of pictures
        self.short, self.end = short, end  # a page, by its number, that ends before its foot
        self.pages: list[Sheet] = []
        self.ends: list[float] = []  # how far the pages before the last are filled
        self.figures, self.listed, self.heading, self.y = 0, 0, "", TOP
        self.begin()
        self.title()
        for section in document.sections:
            self.section(section)
        for number, page in enumerate(self.pages, 1):
            self.frame(page, number)

    @property
    def page(self) -> Sheet:
        return self.pages[-1]

    @property
    def fresh(self) -> bool:
        """Whether nothing stands on the page yet."""
        return self.y <= self.top

    @property
    def half_full(self) -> bool:
        return len(self.pages) == 1 or min(*self.ends, self.y) - TOP >= TALL / 2

    @property
    def bottom(self) -> float:
        return self.end if len(self.pages) == self.short else self.page.size[1] - BOTTOM

    def begin(self, size: tuple[float, float] = A4) -> None:
        """A new page; the heading of a section goes on with it."""
        self.ends += [self.y] * bool(self.pages)
        self.pages.append(Sheet(size))
        self.y = TOP
        if self.heading:
            self.head(f"{self.heading}, continued")
        self.top = self.y

    def head(self, said: str) -> None:
        """A heading below what is there."""
        self.y += HEADING
        self.page.write(LEFT, self.y - 2, fitted(_line(said), WIDE, HEADING, True), HEADING, bold=True)
        self.y += AFTER

    def room(self, tall: float) -> None:
        """A new page unless there is room for so much."""
        if self.y + tall > self.bottom and not self.fresh:
            self.begin()

    def line(self, text: str, size: float, **look: Any) -> None:
        """A line of text below what is there."""
        self.y += size * LINE
        self.page.write(LEFT, self.y - 3, text, size, **look)

    def frame(self, page: Sheet, number: int) -> None:
        """Head and foot of a page: the program and the control above, the number of the page below."""
        wide, tall = page.size
        wide -= LEFT + RIGHT
        control = fitted(self.document.subtitle, wide * 0.45, FOOT)
        page.write(LEFT + wide, TOP - 26, control, FOOT, colour=QUIET, side="right")
        room = wide - width(control, FOOT) - 20
        page.write(LEFT, TOP - 26, fitted(_line(self.document.title), room, FOOT), FOOT, colour=QUIET)
        page.rule(LEFT, TOP - 19, wide)
        page.rule(LEFT, tall - BOTTOM + 19, wide)
        page.write(LEFT + wide, tall - BOTTOM + 31, f"{number} of {len(self.pages)}", FOOT, colour=QUIET, side="right")

    def title(self) -> None:
        size = TITLE if len(self.document.title) < LONG else LONG_TITLE
        lines = folded(_line(self.document.title), WIDE, size, True)
        if len(lines) > TITLE_LINES:
            lines = [*lines[: TITLE_LINES - 1], fitted(" ".join(lines[TITLE_LINES - 1 :]), WIDE, size, True)]
        for line in lines:
            self.y += size * 1.2
            self.page.write(LEFT, self.y - size * 0.25, line, size, bold=True)
        self.y += 12
        self.page.write(LEFT, self.y, fitted(self.document.subtitle, WIDE, BODY + 1), BODY + 1, colour=QUIET)
        self.y += 10

    def section(self, section: Section) -> None:
        self.heading = ""
        if section.title:
            self.room(GAP + HEADING + min(self.least(section.pieces), TALL - 40))
            self.y += 0 if self.fresh else GAP
            self.head(section.title)
            self.heading = section.title
        for piece in section.pieces:
            self.put(piece)
            self.y += AFTER

    def least(self, pieces: Sequence[Piece]) -> float:
        """How much of the pieces is to stand below their heading: of a short table all, with the words that explain it."""
        first, *others = pieces or [Words("")]
        if isinstance(first, Compared | Blanks):  # a picture with its table becomes no smaller
            return 2 * BODY * len(first.rows) + AFTER if isinstance(first, Blanks) else TALL
        if isinstance(first, Image):  # on a page that is less than half full it is drawn smaller
            return min(float(first.picture.get_figheight()) * POINTS + 2.2 * CAPTION, LESS * TALL)
        under = list(takewhile(lambda piece: isinstance(piece, Words), others))
        if isinstance(first, TextTable) and under and len(first.rows) <= SHORT:
            made = tabled(first, WIDE)
            lines = sum(len(_folded(each)) for each in under if isinstance(each, Words))
            tall = sum(row.tall for row in (*made.rows, *([made.head] if made.head else [])))
            return tall + 2 * AIR + AFTER * (1 + len(under)) + lines * BODY * LINE
        return 5 * BODY * LINE

    @singledispatchmethod
    def put(self, piece: Piece) -> None:
        raise TypeError(piece)

    @put.register
    def _(self, piece: Words) -> None:
        for text in _folded(piece):
            self.room(BODY * LINE)
            self.line(text, BODY, colour=TONES[piece.tone], bold=bool(piece.tone))

    @put.register
    def _(self, piece: Blanks) -> None:
        left = max(width(name, BODY) for name, _ in piece.rows) + 14
        for name, known in piece.rows:
            self.room(2 * BODY)
            self.y += 2 * BODY
            self.page.write(LEFT, self.y - 3, name, BODY)
            self.page.write(LEFT + left, self.y - 3, fitted(_line(known), WIDE - left, BODY), BODY)
            self.page.rule(LEFT + left, self.y, WIDE * 0.62 - left)

    @put.register
    def _(self, piece: TextTable) -> None:
        if not piece.rows:
            return
        made = tabled(piece._replace(rows=[[signed(printable(cell)) for cell in row] for row in piece.rows]), WIDE)
        head = made.head.tall + AIR if made.head else 0.0
        self.room(head + made.rows[0].tall + (made.rows[1].tall if len(made.rows) > 1 else 0) + 2)
        self._head(made)
        for k, row in enumerate(made.rows):
            following = made.rows[k:] if len(made.rows) - k == 2 else [row]  # the last stands alone on no page
            if self.y + sum(each.tall for each in following) > self.bottom and not self.fresh:
                self._close(made)
                self.begin()
                self._head(made)
            self._row(made, row)
        self._close(made)

    def _head(self, made: Setting) -> None:
        if made.head:
            self.page.rule(LEFT, self.y, made.wide, 0.9, colours.INK)
            self.y += 1
            self._row(made, made.head)
            self.page.rule(LEFT, self.y + 1, made.wide, 0.5, colours.INK)
            self.y += AIR

    def _close(self, made: Setting) -> None:
        if made.head:
            self.page.rule(LEFT, self.y + 2, made.wide, 0.9, colours.INK)
            self.y += 3

    def _row(self, made: Setting, row: PrintedRow) -> None:
        for cell in row.cells:
            for k, (text, x) in enumerate(cell):
                y = self.y + AIR / 2 + made.size * (LINE * k + 1)
                self.page.write(LEFT + x, y, text, made.size, bold=row.bold)
        self.y += row.tall

    @put.register
    def _(self, piece: Image) -> None:
        picture = piece.picture
        if self.share < 1 and self.figures and picture.again:
            picture = picture.again(size=tuple((self.share * picture.get_size_inches()).tolist()))
        wide, tall = (picture.get_size_inches() * POINTS).tolist()
        self.figures += 1
        caption = folded(f"Figure {self.figures}: {printable(piece.caption)}", WIDE, CAPTION)
        under = 6 + CAPTION * LINE * len(caption)
        if wide > WIDE + 1 or tall + under > TALL - HEADING - AFTER:  # of a size that somebody chose: a page as large as it needs
            self.begin((max(A4[0], wide + LEFT + RIGHT), max(A4[1], tall + under + TOP + BOTTOM)))
        if LESS * TALL < (room := self.bottom - self.y - 1) < tall + under and picture.again:
            smaller = picture.again(size=(WIDE / POINTS, (room - under) / POINTS))
            if smaller.get_figheight() * POINTS + under <= room:
                picture, (wide, tall) = smaller, (smaller.get_size_inches() * POINTS).tolist()
        self.room(tall + under)
        self.page.put(picture, LEFT + max(0.0, (WIDE - wide) / 2), self.y)
        self.y += tall + 6
        for text in caption:
            self.line(text, CAPTION, colour=QUIET)

    @put.register
    def _(self, piece: Compared) -> None:
        picture = piece.difference.plot(table=True, size=(WIDE / POINTS, 6.0))  # as wide as the page, else it gets one of its own
        self.put(Image(picture, "where the part is off, in colours, and its measures"))

    @put.register
    def _(self, piece: Alarms) -> None:
        shown, more = first_of(piece.alarms)
        for alarm in shown:
            head, *quoted = alarm.text(QUOTED).split("\n")
            for text in folded(printable(head), WIDE, BODY):
                self.room(BODY * LINE * (1 + len(quoted)))
                self.line(text, BODY, colour=TONES[BAD] if alarm.severity == ALARM else colours.INK)
            for text in quoted:
                self.line(text, CODE, family=MONO)
            self.y += 4
        if more:
            self.put(Words(more))

    @put.register
    def _(self, piece: Listing) -> None:
        marked = {mark for *_, mark in piece.lines}
        if marked - {""}:
            self.put(Words("! an alarm, ? a warning stands in the line"))
            self.y += AFTER / 2
        wide = width("0" * len(str(len(piece.lines))), CODE, family=MONO)
        left = wide + 16
        letters = int((WIDE - left) / width("0", CODE, family=MONO))
        room = LISTED - self.listed
        for number, text, mark in piece.lines[:room]:
            for k, part in enumerate(_parts(printable(text.expandtabs(4)), letters)):
                self.room(CODE * LINE)
                if mark:
                    self.page.band(LEFT + wide + 3, self.y, WIDE - wide - 3, CODE * LINE, SHADES[mark])
                    self.page.write(LEFT + wide + 4.5, self.y + CODE, SIGNS[mark], CODE, bold=True, family=MONO)
                self.page.rule(LEFT + wide + 3, self.y + CODE * LINE / 2, 0.5, CODE * LINE, "#b5b5b5")
                self.y += CODE * LINE
                if not k:
                    self.page.write(LEFT + wide, self.y - 2.6, str(number), CODE, colour=QUIET, family=MONO, side="right")
                self.page.write(LEFT + left, self.y - 2.6, part, CODE, family=MONO)
        self.listed += min(room, len(piece.lines))
        if room < len(piece.lines):
            left_out = f"… {len(piece.lines) - room} of {len(piece.lines)} lines are left out; an .html report has them all"
            self.put(Words(left_out))


def _folded(words: Words) -> list[str]:
    """The lines of a paragraph; with a tone its letters are bold, and wider."""
    return folded(printable(words.text), WIDE, BODY, bool(words.tone))


def _parts(text: str, letters: int) -> Iterator[str]:
    """A line of a program, folded where it is too long: after a blank, if its second half has one."""
    while len(text) > letters:
        end = text.rfind(" ", letters // 2, letters + 1) + 1 or letters
        yield text[:end].rstrip()
        text = text[end:]
    yield text


def _line(text: str) -> str:
    """A text as one line."""
    return " ".join(printable(text).split())

"""What the manual of a control calls its codes, words and tables: read from the file of the control when it is asked for."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from html import escape
from pathlib import Path
from typing import NamedTuple
from unicodedata import combining, normalize

from mnclab.text.file import table_of

BETWEEN = " · "  # a title and what the manual calls it
STEM = 6  # letters: of a word that has so many the last two may be others, as they are in another case


class Term(NamedTuple):
    """A code or a concept of a manual: its title in English, and what the manual itself calls it, first in its own section.

    `kind` is function, cycle, statement, word, table, concept or turning technology.
    """

    code: str
    title: str
    kind: str
    said: tuple[str, ...]

    @property
    def shown(self) -> str:
        """What the manual calls it, empty where that is its code or its title."""
        told = [each for each in self.said if folded(each) not in (folded(self.code), folded(self.title))]
        return "; ".join(told)


@cache
def terms(file: Path | None) -> Mapping[str, Term]:
    """The terms of a file by their codes, as `plain` writes them; none of a control without one."""
    if file is None:
        return {}
    kinds = table_of(file.read_text("utf-8")).items()
    return {
        plain(code): Term(code, title, kind, tuple(filter(None, said)))
        for kind, rows in kinds for code, (title, *said) in rows.items()
    }  # fmt: skip


def plain(code: str) -> str:
    """A code without what may be written in several ways: case, marks of letters, blanks, leading zeros."""
    return re.sub(r"\b([gm])0+(?=\d)", r"\1", folded(" ".join(code.split())))


def folded(text: str) -> str:
    """A text without case and the marks of its letters: ă is a, ş and ș are s, ё is е."""
    return "".join(letter for letter in normalize("NFKD", text.casefold()) if not combining(letter))


def beside(term: str) -> str:
    """A term as HTML, in grey behind a title."""
    return f' <span style="color:#767676; font-weight:normal">{escape(term)}</span>' if term else ""


def having(words: str, texts: Iterable[tuple[str, ...]]) -> Iterator[bool]:
    """Of texts whether they have all these words, or words that begin so; where none has, whether they have them in another
    case or number."""
    asked, known = folded(words).split(), [folded(" ".join(each)) for each in texts]
    stems = [word[:-2] if len(word) >= STEM else word for word in asked]
    found = [[all(re.search(rf"\b{re.escape(word)}", text) for word in each) for text in known] for each in (asked, stems)]
    return iter(found[0] if any(found[0]) else found[1])

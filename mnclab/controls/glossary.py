"""The words of the trade, one English term for a thing: what it means, what the manuals call it, and which words lead to it.

They stand in `glossary.toml`. A picture is a call of mnclab that draws it, or the form of a cycle with what one of its
parameters measures (code, control, address); it is made when it is asked for.
"""

from __future__ import annotations

import sys
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from html import escape
from pathlib import Path
from textwrap import wrap
from typing import Any

from mnclab.machine.terms import beside, folded
from mnclab.text.alarm import Alarm
from mnclab.text.file import table_of
from mnclab.text.opening import opened
from mnclab.text.tables import Rows, paragraphs, text_table

NAMES = {"not": "instead_of"}  # of the file, and of an entry
WIDE = (22, 48, 18, 26, 26)  # letters of the columns of the table as text


@dataclass(frozen=True)
class Entry:
    """A term: its meaning, words that are not used for it, what the manuals call it in Russian and in Romanian."""

    term: str
    means: str
    instead_of: tuple[str, ...] = ()
    ru: tuple[str, ...] = ()
    ro: tuple[str, ...] = ()
    picture: str = ""
    form: tuple[str, str, str] | tuple[()] = ()

    @property
    def words(self) -> tuple[str, ...]:
        """All words that lead to it."""
        return (self.term, *self.instead_of, *self.ru, *self.ro)

    @property
    def manuals(self) -> str:
        """What the manuals call it."""
        return "; ".join(f"{name} {', '.join(said)}" for name, said in (("ru", self.ru), ("ro", self.ro)) if said)

    @property
    def meaning(self) -> str:
        """What it means, and the words that one does not use for it."""
        return f"{self.means}{' Not: ' * bool(self.instead_of)}{', '.join(self.instead_of)}{'.' * bool(self.instead_of)}"

    def __str__(self) -> str:
        drawn = f'\na picture: mnc.help("{self.term}").plot()' * bool(self.picture)
        return f"{self.term}  ({self.manuals})\n{self.meaning}{drawn}"

    def plot(self, **options: Any) -> Any:
        """Its picture, `options` are those of `plot`; an Alarm where it has none of its own."""
        if not self.picture:
            raise Alarm(f"{self.term} has no picture by itself")
        known = {"mnc": sys.modules["mnclab"], "options": {"size": (5.0, 3.4)} | options}
        return eval(self.picture, known)  # a call in a file of this package

    @property
    def drawn(self) -> str:
        """Its picture as HTML; empty where it has none, or where what draws it is not installed."""
        with suppress(Alarm, ImportError):
            if self.form:
                return str(opened("mnclab.lab.forms.cycle_form", "scheme")(*self.form))
            return str(self.plot().html(1.5)) if self.picture else ""
        return ""

    def html(self, drawn: bool = True) -> str:
        """Its words and its meaning, with the picture or without."""
        picture = f'<div style="max-width:510px">{self.drawn}</div>' if drawn else ""
        return f"<h4>{escape(self.term)}{beside(self.manuals)}</h4>{paragraphs(self.meaning)}{picture}"

    def _repr_html_(self) -> str:
        return self.html()


class Glossary(Rows[Entry]):
    """All terms; `entries` shows them with their pictures."""

    HEAD = ("term", "means", "not", "Russian", "Romanian")

    def texts(self) -> list[tuple[str, ...]]:
        return [(e.term, e.means, *(", ".join(said) for said in (e.instead_of, e.ru, e.ro))) for e in self]

    def __repr__(self) -> str:
        rows = [["\n".join(wrap(cell, wide)) for cell, wide in zip(row, WIDE)] for row in self.texts()]
        return text_table(self.HEAD, rows)

    @property
    def entries(self) -> str:
        """All terms as HTML, one below the other, each picture once."""
        first = {entry.picture or entry.term: entry for entry in reversed(self)}
        shown = (entry.html(first[entry.picture or entry.term] is entry) for entry in self)
        return "".join(f'<section style="break-inside:avoid">{each}</section>' for each in shown)


@cache
def _table() -> dict[str, dict[str, Any]]:
    return table_of(Path(__file__).with_name("glossary.toml").read_text("utf-8"))


@cache
def glossary() -> Glossary:
    """The terms in their order."""
    rows, found = _table(), []
    for term, row in rows.items():
        if term != "also":
            said = {NAMES.get(name, name): tuple(words) for name, words in row.items() if isinstance(words, list)}
            found.append(Entry(term, row["means"], picture=rows[row.get("like", term)].get("picture", ""), **said))
    return Glossary(found)


def named(word: str) -> list[Entry]:
    """The terms that a word leads to."""
    asked = folded(word.strip())
    return [entry for entry in glossary() if asked in map(folded, entry.words)]


def instead_of(word: str) -> str:
    """What the manuals call what the trade has another word for."""
    return str(_table()["also"].get(folded(word.strip()), word))

"""The parameters of a cycle as people read them: one row each, for help as text, help as HTML and the boxes of a form."""

from __future__ import annotations

from html import escape
from typing import NamedTuple

from mnclab.machine.cycle import Cycle, Parameter
from mnclab.text.tables import html_table, text_table


class Row(NamedTuple):
    """What is said of one parameter; `default` is what holds where its word is left out."""

    address: str
    meaning: str
    unit: str
    allowed: str
    default: str
    note: str


def row(p: Parameter) -> Row:
    """The row of a parameter; its choices stand one in a line, each with its meaning."""
    allowed = "\n".join(f"{choice:g} {meaning}" for choice, meaning in p.choices.items()) if p.choices else p.allowed
    return Row(p.address, p.meaning, p.unit, allowed, "required" if p.required else left_out(p), p.note)


def left_out(p: Parameter) -> str:
    """What holds where the word is left out, empty where nothing does."""
    default = f"{p.default:g}" if isinstance(p.default, int | float) else p.default or ""
    return p.default_means or default


def _filled(cycle: type[Cycle]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """The heads and rows of the parameters of a cycle, without notes where there is none."""
    rows = [row(p) for p in cycle.parameters()]
    width = len(Row._fields) - (not any(each.note for each in rows))
    return Row._fields[:width], [each[:width] for each in rows]


def help_text(cycle: type[Cycle]) -> str:
    """The title of a cycle, what it does, and its parameters."""
    table = text_table(*_filled(cycle))
    return f"{cycle.code}  {cycle.title}  ({cycle.source})\n{(cycle.__doc__ or '').strip()}\n\n{table}"


def help_html(cycle: type[Cycle]) -> str:
    """The same as HTML."""
    table = html_table(*_filled(cycle), code=(0,))
    about = f"<p>{escape(cycle.__doc__ or '')} ({escape(cycle.source)})</p>"
    return f"<h4><code>{cycle.code}</code> {escape(cycle.title)}</h4>{about}{table}"

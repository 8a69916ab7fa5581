"""Files that a program writes: what it puts out, piece by piece, in the history; whole in `Run.files`."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from mnclab.text.alarm import several
from mnclab.text.tables import html_table, text_table

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

FILE = "file "  # begins the names of files in the history
CHARACTERS = 250  # that count as a block of the limit: a loop that writes for ever must end
HEAD = ("file", "size", "begins with")


@dataclass(frozen=True)
class Piece:
    """What was put out in a step; `anew`: the file begins with it."""

    text: str
    anew: bool

    def __repr__(self) -> str:
        first, _, more = self.text.rstrip().partition("\n")
        return repr(first) + (f" and {several(more.count(chr(10)) + 1, 'more line')}" if more else "")


def put_out(m: Machine, name: str, text: str, anew: bool = False) -> None:
    """Write to a file, behind what it holds or anew; small and capital letters of its name are the same."""
    m.flow.spend(len(text) // CHARACTERS)
    logs = m.logs.by_name
    key = next((known for known in logs if known.lower() == (FILE + name).lower()), FILE + name)
    log = logs.get(key)
    if log is not None and log.steps and log.steps[-1] == m.step and not anew:
        text, anew = log.values[-1].text + text, log.values[-1].anew
    m.log(key, Piece(text, anew or log is None))


class Files(dict[str, str]):
    """Files by name, each a text."""

    def _rows(self) -> list[tuple[str, str, str]]:
        return [(name, several(text.count("\n"), "line"), text.partition("\n")[0][:60]) for name, text in self.items()]

    def __repr__(self) -> str:
        return text_table(HEAD, self._rows()) if self else "no files were written"

    def _repr_html_(self) -> str:
        return html_table(HEAD, self._rows(), code=(0, 2)) if self else "<p>no files were written</p>"


def written(names: Iterable[str], changed: Callable[[str], list[tuple[int, Any]]]) -> Files:
    """The files at the end of a run, of the names of its history and their changes."""
    found = Files()
    for name in names:
        if name.startswith(FILE):
            texts: list[str] = []
            for _, piece in changed(name):
                if piece.anew:
                    texts.clear()
                texts.append(piece.text)
            found[name.removeprefix(FILE)] = "".join(texts)
    return found

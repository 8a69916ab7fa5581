"""Files with tables that a program selects: found by name in ``Setup.files``, or beside the program.

The folders of the control are not those of this computer, so in ``Setup.files`` a name counts without its directory, too.
"""

from __future__ import annotations

from pathlib import Path

from mnclab.machine.machine import Machine
from mnclab.machine.programs import beside
from mnclab.text.program import Word, decode


class Fault(Exception):
    """What is wrong in a line of the file."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(f"line {line}: {message}")


def text_of(m: Machine, word: Word, statement: str, kind: str, suffix: str) -> tuple[str, str]:
    """Name and text of the table that a statement names; an alarm at that word if there is none."""
    name = str(word.value)
    file = name.replace("\\", "/").replace(":", "/").rpartition("/")[2]
    if not file[:1].isalpha():
        m.alarm(f"{statement} {name}: the name of a {kind} must begin with a letter", word)
    if "." not in file:
        name, file = name + suffix, file + suffix
    if not file.upper().endswith(suffix):
        m.alarm(f"{statement} {name}: a {kind} has the type {suffix}", word)
    known = {key.replace("\\", "/").upper(): source for key, source in m.setup.files.items()}
    source = known.get(name.replace("\\", "/").upper(), known.get(file.upper()))
    source = source if source is not None else beside(m.flow.program, file.lower())
    if source is None:
        names = ", ".join(sorted(m.setup.files)[:8])
        m.alarm(f"{statement} {name}: there is no such table", word, hint=f"Setup(files=…) has {names or 'no files'}")
    if isinstance(source, Path):
        try:
            return name, decode(source.read_bytes())[0]
        except OSError as error:
            m.alarm(f"{statement} {name}: {source} cannot be read: {error.strerror}", word)
    return name, source

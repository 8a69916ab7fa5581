"""Machines written in files (TOML): the limits of the axes, and what was assumed to name them.

The named ones lie in `data/machines`. A file has `title`, `assumes` (a list of sentences) and the table
`[limits]`, whose keys are the fields of `Limits`.
"""

from __future__ import annotations

import os
from difflib import get_close_matches
from pathlib import Path
from typing import NamedTuple

from mnclab.machine.setup_file import record
from mnclab.path.limits import Limits
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown
from mnclab.text.toml_file import File, check_names, parse

_PACKAGE = Path(__file__).resolve().parent.parent
PLACES = (_PACKAGE / "data" / "machines", _PACKAGE.parent / "data" / "machines")  # installed; in the sources


class MachineFile(NamedTuple):
    """A machine: its `name`, a `title`, what was assumed, and its limits."""

    name: str
    title: str
    assumes: tuple[str, ...]
    limits: Limits


def names() -> list[str]:
    """The machines that have a name."""
    return sorted({file.stem for place in PLACES for file in place.glob("*.toml")})


def load(machine: str | Path) -> MachineFile:
    """A machine by its name or its file; an Alarm names what is wrong."""
    text = str(machine)
    if isinstance(machine, Path) or text.endswith(".toml"):
        return parse(Path(machine), _machine, "machine")
    for place in PLACES:
        if os.path.isfile(place / f"{text}.toml"):
            return parse(place / f"{text}.toml", _machine, "machine")
    near = get_close_matches(text[:40], names(), 1)
    hint = f"near: {near[0]}" if near else f"known: {', '.join(names())}; or the name of a .toml file"
    raise Alarm(f"no machine has the name {shown(text)}", hint=hint)


def _machine(table: dict[str, object], file: File) -> MachineFile:
    check_names(table, ("title", "assumes", "limits"), "a machine", file)
    path = Path(file.name)
    title, assumes = table.get("title", path.stem), table.get("assumes", [])
    if not isinstance(title, str):
        raise Alarm(f"title must be a text, got {title!r}")
    if not isinstance(assumes, list) or not all(isinstance(line, str) for line in assumes):
        raise Alarm(f"assumes must be a list of texts, got {assumes!r}")
    return MachineFile(path.stem, title, tuple(assumes), record(Limits, table.get("limits", {}), file, "limits"))

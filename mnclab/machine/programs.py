"""Other programs, found by their name: in ``Setup.files``, then in the folder of the calling file, never elsewhere.

Names are compared without regard to case. A type that is not written is that of the control; a directory counts only for
``Setup.files``, where a name may be a whole path of the control, since the folders of the control are not those here.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from mnclab.text.alarm import Alarm, Span
from mnclab.text.program import Program, decode

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


def called(m: Machine, name: str, what: str, span: Span | None = None) -> int:
    """The index in ``flow.programs`` of the program of a name, read when it is first called; an Alarm if there is none.

    ``what`` begins the sentence of the alarm: the statement that calls.
    """
    flow = m.flow
    index = flow.found.get((flow.program.folder, name))
    if index is None:
        key, text, folder = _found(m, name, what, span)
        same = (k for k, known in enumerate(flow.programs) if known.name == key and (k or known.folder))
        index = next(same, None)
        if index is None:
            program = m.control.read(text, key)
            object.__setattr__(program, "folder", folder)
            index = flow.add(program)
        flow.found[flow.program.folder, name] = index
    return index


def _found(m: Machine, name: str, what: str, span: Span | None) -> tuple[str, str, str]:
    """Name, text and folder of a program."""
    if name.lower().endswith(".i"):
        raise Alarm(f"{what} {name}: DIN/ISO programs (.I) are not built yet", span)
    caller, suffixes = m.flow.program, m.control.suffixes
    wanted = _spelt(name, suffixes)
    files = {_spelt(known, suffixes): (known, source) for known, source in m.setup.files.items()}
    for key in (wanted, _last(wanted)):
        if key in files:
            known, source = files[key]
            if isinstance(source, str):
                return known, source, caller.folder
            return str(source), _text(source, what, span), str(source.parent)
    found = beside(caller, _last(wanted))
    if found is None:
        where = f"the folder of {caller.name}" if caller.folder else "a program without a file has no folder"
        names = ", ".join(sorted(m.setup.files)[:8])
        hint = f"Setup(files=…) has {names or 'no programs'}; {where}{' has none' if caller.folder else ''}"
        raise Alarm(f"{what} {name}: there is no program of this name", span, hint=hint)
    return str(found), _text(found, what, span), caller.folder


def beside(caller: Program, wanted: str) -> Path | None:
    """A file in the folder of the calling program."""
    if not caller.folder:
        return None
    try:
        names = sorted(entry.name for entry in os.scandir(caller.folder) if entry.is_file())
    except OSError:
        return None
    return next((Path(caller.folder, name) for name in names if name.lower() == wanted), None)


def _text(path: Path, what: str, span: Span | None) -> str:
    try:
        return decode(path.read_bytes())[0]
    except OSError as error:
        raise Alarm(f"{what}: {path} cannot be read: {error.strerror or error}", span) from None


def _spelt(name: str, suffixes: tuple[str, ...]) -> str:
    """A name as it is compared: small letters, one kind of slash, with the type of the control."""
    name = name.strip().replace("\\", "/").lower()
    return name if "." in _last(name) or not suffixes else name + suffixes[0]


def _last(name: str) -> str:
    """A name without its directory."""
    return name.replace(":", "/").rpartition("/")[2]


def alarms_of(program: Program, index: int) -> Iterator[Alarm]:
    """The alarms that a reader found in a program, at their places in a run."""
    for alarm in program.alarms:
        place = alarm.span._replace(program=index) if alarm.span else None
        yield Alarm(alarm.message, place, alarm.severity, alarm.hint, program)

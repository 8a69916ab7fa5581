"""Other programs and tables, found by their name: in `Setup.files`, then beside the calling file, never elsewhere.

Names are compared without regard to case. A type that is not written is that of the control; a directory counts only for
`Setup.files`, where a name may be a whole path of the control, since the folders of the control are not those here.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from mnclab.running.flow import course
from mnclab.text.alarm import Alarm, Span
from mnclab.text.code_pages import decode
from mnclab.text.file import read
from mnclab.text.program import Program

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


def called(m: Machine, name: str, what: str, span: Span | None = None) -> int:
    """The index in `flow.programs` of the program of a name, read when it is first called; an Alarm if there is none.

    `what` begins the sentence of the alarm: the statement that calls.
    """
    flow = course(m)
    index = flow.found.get((flow.program.folder, name))
    if index is None:
        key, text, folder = found(m, name, what, span)
        same = (k for k, known in enumerate(flow.programs) if known.name == key and (k or known.folder))
        index = next(same, None)
        if index is None:
            program = m.control.read(text, key)
            object.__setattr__(program, "folder", folder)
            index = flow.add(m, program)
        flow.found[flow.program.folder, name] = index
    return index


class Found(NamedTuple):
    """A file: its name, its text, its folder, "" for none."""

    name: str
    text: str
    folder: str


def found(m: Machine, name: str, what: str, span: Span | None, kind: str = "program") -> Found:
    """The file that a statement (`what`) names; an Alarm if there is none. A `kind` other than programs names its type."""
    caller = m.flow.program
    types = sorted(m.control.suffixes, key=lambda suffix: not caller.name.lower().endswith(suffix)) or [""]  # its own first
    for wanted, suffix in ((_spelt(name, suffix), suffix) for suffix in types):
        files = {_spelt(known, suffix): (known, source) for known, source in m.setup.files.items()}
        for key in (wanted, _last(wanted)):
            if key in files:
                known, source = files[key]
                if isinstance(source, str):
                    return Found(known, source, caller.folder)
                return Found(str(source), _text(source, what, span), str(source.parent))
    file = next(filter(None, (_beside(caller, _last(_spelt(name, suffix))) for suffix in (*types, ""))), None)
    if file is not None and not Path(os.path.realpath(file)).is_relative_to(os.path.realpath(caller.folder)):
        elsewhere = "it is a symbolic link to another folder, and files are taken from the folder of the program alone"
        raise Alarm(f"{what} {name}: {elsewhere}", span, hint="Setup(files=…) names files that lie elsewhere")
    if file is None:
        where = f"the folder of {caller.title}" if caller.folder else "a program without a file has no folder"
        names = ", ".join(sorted(m.setup.files)[:8])
        hint = f"Setup(files=…) has {names or 'no files'}; {where}{' has none' if caller.folder else ''}"
        raise Alarm(f"{what} {name}: there is no {kind} of this name", span, hint=hint)
    return Found(str(file), _text(file, what, span), caller.folder)


def _beside(caller: Program, wanted: str) -> Path | None:
    if not caller.folder:
        return None
    try:
        names = sorted(name for name in os.listdir(caller.folder) if name.lower() == wanted)
    except OSError:
        return None
    return next((path for name in names if os.path.isfile(path := Path(caller.folder, name))), None)


def _text(path: Path, what: str, span: Span | None) -> str:
    try:
        return decode(read(path, f"{what}: {path.name}"))[0]
    except Alarm as alarm:
        alarm.span = span
        raise


def _spelt(name: str, suffix: str) -> str:
    """A name as it is compared: small letters, one kind of slash, with a type of the control."""
    name = name.strip().replace("\\", "/").lower()
    return name if "." in _last(name) else name + suffix


def _last(name: str) -> str:
    return name.replace(":", "/").rpartition("/")[2]


def alarms_of(program: Program, index: int) -> Iterator[Alarm]:
    """The alarms that a reader found in a program, at their places in a run."""
    for alarm in program.alarms:
        yield alarm.changed(span=alarm.span and alarm.span._replace(program=index), source=program)

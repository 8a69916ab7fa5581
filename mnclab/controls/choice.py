"""From what a user has (a text, a file, a name) to a control and a program; and help on a code."""

from __future__ import annotations

import re
from html import escape
from pathlib import Path

from mnclab.controls import CONTROLS
from mnclab.machine.control import Control, Function
from mnclab.machine.cycle import Cycle, help_html, help_table
from mnclab.machine.run import Run, run_program
from mnclab.machine.settings import Setting, settings_html, settings_table
from mnclab.machine.setup import Setup
from mnclab.text.alarm import Alarm
from mnclab.text.nearest import hint, nearest
from mnclab.text.notation import Notation
from mnclab.text.program import Program, decode


def run(
    source: str | Path | Program, control: str | None = None, setup: Setup | None = None, *, strict: bool = False
) -> Run:
    """Read and run a part program.

    ``source``: a text, or the path of a file. ``control``: a name of ``mnclab.controls``; None asks the file's suffix, then
    the text, and refuses to guess when two fit. Faults are collected in ``run.alarms``; ``strict`` raises the first.
    """
    program = source if isinstance(source, Program) else read(source, control)
    return run_program(program, CONTROLS[program.control], setup, strict=strict)


def read(source: str | Path, control: str | None = None) -> Program:
    """Read a part program into blocks without running it; see :func:`run` for the arguments."""
    text, name, encoding = _text_of(source)
    chosen = choose(control, name, text)
    program = chosen.read(text, name)
    object.__setattr__(program, "encoding", encoding)
    if encoding != "str":  # from a file
        object.__setattr__(program, "folder", str(Path(name).parent))
    for alarm in program.alarms:
        alarm.source = program
    return program


def modern(source: str | Path | Program | Run, control: str | None = None) -> Notation:
    """A program beside itself in modern notation: one command a line, millimetres, decimal points (NC-31).

    ``source`` and ``control`` are those of :func:`run`, or a run. An Alarm where the control's own notation is modern.
    """
    program = source.program if isinstance(source, Run) else source
    program = program if isinstance(program, Program) else read(program, control)
    chosen = CONTROLS[program.control]
    if chosen.modern is None:
        able = ", ".join(name for name in CONTROLS if CONTROLS[name].modern)
        raise Alarm(f"programs of {chosen.name} have no other notation", hint=f"those of {able} have")
    return chosen.modern(program)


def _text_of(source: str | Path) -> tuple[str, str, str]:
    """Text, name and code page. A text with a line end is a program; one without is a path if such a file exists."""
    if isinstance(source, str):
        if "\n" in source or "\r" in source or len(source) > 4096 or "\0" in source or not _is_file(source):
            return source, "program", "str"
        source = Path(source)
    try:
        text, encoding = decode(source.read_bytes())
    except OSError as error:
        raise Alarm(f"{source} cannot be read: {error.strerror or error}") from None
    return text, str(source), encoding


def _is_file(name: str) -> bool:
    try:
        return bool(name.strip()) and Path(name).is_file()
    except (OSError, ValueError):
        return False


def choose(control: str | None, name: str, text: str) -> Control:
    """The control that was named, or the one that the suffix or the text points to; an Alarm when none or two do."""
    if control is not None:
        if control not in CONTROLS:
            near = nearest(control, CONTROLS, 1)
            raise Alarm(
                f"there is no control {control!r}",
                hint=f"known: {', '.join(CONTROLS)}" + (f"; near: {near[0]}" if near else ""),
            )
        return CONTROLS[control]
    everyone = [CONTROLS[known] for known in CONTROLS]
    suffix = Path(name).suffix.lower()
    by_suffix = [one for one in everyone if suffix and suffix in one.suffixes]
    if len(by_suffix) == 1:
        return by_suffix[0]
    fitting = [one for one in by_suffix or everyone if one.looks_like and one.looks_like(text)]
    if len(fitting) == 1:
        return fitting[0]
    which = (
        "more than one control fits"
        if fitting
        else "nothing in the text or the file's name says which control it is for"
    )
    raise Alarm(f"{which}: name it", hint=f"control= one of {', '.join(CONTROLS)}")


class Help:
    """What a code or a setting means on a control: shown as text or as a table."""

    def __init__(self, entry: Function | type[Cycle] | tuple[Setting, ...], control: Control) -> None:
        self.entry, self.control = entry, control

    def __str__(self) -> str:
        entry = self.entry
        if isinstance(entry, tuple):
            return settings_table(entry)
        if isinstance(entry, Function):
            takes = f"\ntakes {' '.join(entry.takes)}" if entry.takes else ""
            group = f", group {entry.group}" if entry.group else ""
            return f"{entry.code}  {entry.title}  ({self.control.name} {entry.source}{group})\n{entry.doc}{takes}"
        iso = [name for name, code in self.control.names.items() if code == entry.code]
        return help_table(entry) + (f"\n\nDIN/ISO {', '.join(iso)}" if iso else "")

    __repr__ = __str__

    def _repr_html_(self) -> str:
        if isinstance(self.entry, tuple):
            return settings_html(self.entry)
        if isinstance(self.entry, Function):
            return f"<pre>{escape(str(self))}</pre>"
        iso = ", ".join(f"<code>{name}</code>" for name, code in self.control.names.items() if code == self.entry.code)
        return help_html(self.entry) + (f"<p>DIN/ISO {iso}</p>" if iso else "")


def help(code: str, control: str) -> Help:
    """The parameter table of a cycle, the meaning of a function or setting; "settings" is the table of all settings.

    An Alarm with the nearest codes if there is none.
    """
    chosen = choose(control, "", "")
    settings = {setting.name: setting for setting in chosen.settings}
    if code.strip().lower() in ("settings", *settings):
        return Help(tuple(one for name, one in settings.items() if code.strip().lower() in ("settings", name)), chosen)
    wanted = _normal(code, chosen)
    if wanted in chosen.cycles:
        return Help(chosen.cycles[wanted], chosen)
    if wanted in chosen.functions:
        return Help(chosen.functions[wanted], chosen)
    if wanted in chosen.refused:
        raise Alarm(f"{wanted}: {chosen.refused[wanted]}")
    near = hint(wanted, (*chosen.functions, *chosen.cycles, "settings", *settings), 5)
    raise Alarm(f"{chosen.name} has no code {code!r}", hint=near)


def _normal(code: str, control: Control) -> str:
    """A code as the tables spell it: upper case, one blank, no leading zeros; a bare cycle number finds its cycle, and so
    does another name of it."""
    code = " ".join(code.upper().split())
    if re.fullmatch(r"G\d{1,20}", code) and (named := control.names.get(f"G{int(code[1:])}")):
        return named
    if len(code) > 1 and code[0] in control.codes and code[1:].isdigit():
        return f"{code[0]}{int(code[1:])}"
    for known in control.cycles:
        if code.isdigit() and known.split()[-1] == code:
            return known
    return code

"""From what a user has (a text, a file, a name) to a control and a program; and help on a code."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, replace
from html import escape
from itertools import islice
from pathlib import Path, PurePath
from typing import Any

from mnclab.controls import CONTROLS
from mnclab.controls.glossary import Entry, Glossary, glossary, instead_of, named
from mnclab.controls.recognition import looks_like, recognise
from mnclab.machine.control import EVERY, Control, Function, chosen, settings_html, settings_text
from mnclab.machine.cycle import help_html, help_text
from mnclab.machine.setup import Setup
from mnclab.machine.setup_file import load
from mnclab.machine.terms import BETWEEN, Term, having, plain, terms
from mnclab.path.machines import limits_of
from mnclab.path.tool import Tool
from mnclab.runs.run import EXAMPLE, Run, run_program
from mnclab.text.alarm import ALARM, Alarm, hint
from mnclab.text.dialect import Notation, renumbered
from mnclab.text.file import MEGABYTE, MOST_MEGABYTES, decode, encode_like, replaced, save_as
from mnclab.text.file import read as read_file
from mnclab.text.given import LARGEST, fitting, near_option, shown, whole
from mnclab.text.opening import opened
from mnclab.text.program import Program
from mnclab.text.tables import Rows

MOST_FILES = 1000  # of a folder, looked through for a name


@fitting
def run(
    source: str | Path | Program, control: str | None = None, setup: Setup | str | Path | None = None,
    *, strict: bool = False, tools: Mapping[int, Tool] | None = None, stock: Any = None, **parts: Any,
) -> Run:  # fmt: skip
    """Read and run a part program: `run("G0 X5\\n", "mnc", tools={1: mnclab.Tool(diameter=8)}, stock=(80, 60, 20))`.

    `source`: a text, or the path of a file. `control`: a name of `mnclab.controls`; None asks the file's suffix and the
    signs in the text (see `controls.recognition`), and refuses to guess when two fit. Faults are collected in
    `run.alarms`; `strict` raises the first.

    `tools` by their numbers, the `stock` (three sizes in mm have their corner at the datum and their top at Z0) and any other
    part of a `Setup` may be given without one, or beside one, whose parts they replace; `machine="small-mill"` stands for
    its limits. `setup` may be the name of a .toml file, which `mnclab --help` shows.

    >>> mnc.run("S800 M3\\nG1 X30 Y40 F100\\n", "mnc").toolpath.length
    50.0
    """
    if isinstance(setup, str | Path) and PurePath(setup).suffix.lower() == ".toml":
        setup = load(setup)
    if "machine" in parts:
        parts["limits"] = limits_of(parts.get("limits"), parts.pop("machine"))
    given = {name: part for name, part in (("tools", tools), ("stock", stock), *parts.items()) if part is not None}
    if not isinstance(setup, Setup | None):
        raise Alarm(f"setup must be a Setup, got {shown(setup)}", hint=EXAMPLE)
    known = [each.name for each in fields(Setup) if each.name != "source"]
    for name in (name for name in given if name not in known):
        raise Alarm(f"run has no option {name!r}", hint=near_option(name, known))
    setup = replace(setup or Setup(), **given, source=None) if given else setup
    allowed = {"most_megabytes": setup.settings["most_megabytes"]} if setup and "most_megabytes" in setup.settings else {}
    program = source if isinstance(source, Program) else read(source, control, **allowed)
    return run_program(program, CONTROLS[program.control], setup, strict=strict)


@fitting
def read(source: str | Path, control: str | None = None, *, most_megabytes: float | None = None) -> Program:
    """Read a part program into blocks without running it; see `run` for the arguments. A file larger than `most_megabytes`,
    as the setting of this name (100), is refused: a million blocks take some 300 MB of memory while they are read.

    >>> mnc.read("N10 G0 X5 Y2\\nN20 M30\\n", "mnc")[1]
    <Block N20 M30, line 2>
    """
    allowed = chosen(EVERY, {} if most_megabytes is None else {"most_megabytes": most_megabytes}, "every control")
    text, name, encoding = _text_of(source, control, int(allowed["most_megabytes"] * MEGABYTE))
    program = read_text(text, name, control, "" if encoding == "str" else str(Path(name).parent))
    object.__setattr__(program, "encoding", encoding)
    return program


def read_text(text: str, name: str, control: str | None = None, folder: str = "") -> Program:
    """Read the text of a file of some name; other programs that it calls are sought in its folder."""
    program = choose(control, name, text).read(text, name)
    object.__setattr__(program, "folder", folder)
    for alarm in program.alarms:
        alarm.source = program
    _point_out_another(program)
    return program


def _point_out_another(program: Program) -> None:
    """Say at the first alarm that a text which could not be read is plainly a program of another control."""
    first = next((alarm for alarm in program.alarms if alarm.severity == ALARM), None)
    if first is None or len(program.faulty_blocks()) < max(3, len(program) / 4):  # a slip or two
        return
    alike = looks_like(program.text, CONTROLS, program.control)
    if alike and alike != f"a program of {program.control}":
        said = f"this looks like {alike}, and was read as one of {program.control}"
        first.hint = f"{said}; {first.hint}" if first.hint else said


@fitting
def modern(source: str | Path | Program | Run, control: str | None = None) -> Notation:
    """A program beside itself in modern notation: one command a line, millimetres, decimal points (NC-31).

    `source` and `control` are those of `run`, or a run. An Alarm where the control's own notation is modern.

    >>> print(mnc.modern("N1 X1000 ~\\nN2 Z-500\\n", "nc-31"))
    NC-31       modern notation
    ----------  ---------------
                G21 G90 G95 (mm, X on the diameter, feed per revolution)
    N1 X1000 ~  G0 X10.0
    N2 Z-500    G1 Z-5.0
    """
    program = source.program if isinstance(source, Run) else source
    program = program if isinstance(program, Program) else read(program, control)
    chosen = CONTROLS[program.control]
    if chosen.modern is None:
        able = ", ".join(name for name in CONTROLS if CONTROLS[name].modern)
        raise Alarm(f"programs of {chosen.name} have no other notation", hint=f"those of {able} have")
    return chosen.modern(program)


def _text_of(source: str | Path, control: str | None, most: int = MOST_MEGABYTES * MEGABYTE) -> tuple[str, str, str]:
    """Text, name and code page. A text with a line end is a program; one without is a path if there is such a file, or if
    it looks like the name of one."""
    if not isinstance(source, str | os.PathLike):
        raise Alarm(f"a program is a text or a Path, got {shown(source)}", hint='mnclab.run("G0 X5\\n", "mnc")')
    path = Path(source)
    if isinstance(source, str):
        plainly = len(source) > 4096 or not {"\n", "\r", "\0"}.isdisjoint(source)
        if plainly or not (_is_file(source) or _names_a_file(source, control)):
            return source, "program", "str"
    if "\0" not in str(path) and not os.path.lexists(path):
        told = (_files_near(path), "a program ends with a line end" if isinstance(source, str) else "")
        near = "; ".join(filter(None, told))
        raise Alarm(f"{path} cannot be read: there is no such file", hint=near)
    text, encoding = decode(read_file(path, path, most))
    return text, str(path), encoding


def _names_a_file(text: str, control: str | None) -> bool:
    """Whether a line is the name of a file that is not there, and no program.

    One word with the suffix of a control (`part.mnc`) is a name. Words with such a suffix (`CALL PGM part.h`), or one
    word with a path separator (`jobs/part`, `/N10G0X5`), are a name where the control does not read them as blocks;
    a slash that has no two letters beside one another (`X10/2`) divides.
    """
    name = text.strip()
    suffixed = PurePath(name).suffix.lower() in {suffix for one in CONTROLS.signed() for suffix in one.suffixes}
    word = " " not in name and "\t" not in name
    if suffixed and word:
        return True
    if not suffixed and not (word and re.search(r"[/\\]", name) and re.search(r"[^\W\d_]{2}", name)):
        return False
    try:
        return any(alarm.severity == ALARM for alarm in choose(control, name, text).read(text, name).alarms)
    except Alarm:  # no control is named, and nothing says which
        return True


def _files_near(path: Path) -> str:
    """The names in a folder that are nearest to that of a file which is not there."""
    try:
        with os.scandir(path.parent) as entries:
            return hint(path.name, [entry.name for entry in islice(entries, MOST_FILES)])
    except OSError:
        return f"there is no folder {path.parent}"


def _is_file(name: str) -> bool:
    try:
        return bool(name.strip()) and Path(name).is_file()
    except (OSError, ValueError):
        return False


def choose(control: str | None, name: str, text: str) -> Control:
    """The control that was named, or the one that the suffix or the text points to; an Alarm when none or two do."""
    if control is not None:
        if not isinstance(control, str) or control not in CONTROLS:
            if isinstance(control, Setup):
                raise Alarm("the control comes before the setup", hint="run(text, setup=…) where it is known from the program")
            near = hint(str(control)[:40], CONTROLS, 1)
            known = f"known: {', '.join(CONTROLS)}"
            raise Alarm(f"there is no control {shown(control)}", hint=f"{known}; {near}" if near else known)
        return CONTROLS[control]
    return recognise(name, text, CONTROLS)


#: What help says of the files that a user writes: a heading, and the file that reads them.
PAGES = {
    "exercise": (("", "mnclab.learning.exercise_file"),),
    "design": (("a milled part:\n\n", "mnclab.design.model.design_file"),
               ("\na turned part:\n\n", "mnclab.design.model.turned_file")),
}  # fmt: skip


class Found(Rows[tuple[str, str, str, str]]):
    """What has some words in its title or in its term: code, control, title, and what the manual calls it."""

    HEAD = ("code", "control", "title", "in the manual")
    CODE = (0,)

    def texts(self) -> list[tuple[str, ...]]:
        return list(self)


class Help:
    """What a code, a setting or a term means, all codes of a control, or a page for every control: as text or as a table.

    >>> mnc.help("G83", "mnc").term
    'Цикл глубокого сверления'
    """

    def __init__(self, entry: Any, control: Control) -> None:
        self.entry, self.control = entry, control
        known = terms(control.terms).get(plain(getattr(entry, "code", "")))
        self.term = known.shown if known else ""
        self._iso = [name for name, known in control.names.items() if known == getattr(entry, "code", None)]

    def __str__(self) -> str:
        entry = self.entry
        if isinstance(entry, str | Entry | Glossary | Found):
            return str(entry)
        if isinstance(entry, Term):
            return f"{entry.code}  {_titled(entry.title, entry.shown)}\n{entry.kind} in the manual of {self.control.title}"
        if isinstance(entry, Control):
            rows = [(code, one.title) for code, one in entry.listed.items()]
            rows += [(code, cycle.title) for code, cycle in entry.cycles.items()]
            wide = max(len(code) for code, _ in rows)
            lines = [f"{entry.name}  {entry.title}", *(f"{code:{wide}}  {title}" for code, title in rows)]
            return "\n".join([*lines, f'settings: help("settings", "{entry.name}")'])
        if isinstance(entry, tuple):
            return settings_text(entry)
        if isinstance(entry, Function):
            takes = f"\ntakes {' '.join(entry.takes)}" if entry.takes else ""
            group = f", group {entry.group}" if entry.group else ""
            title = _titled(entry.title, self.term)
            return f"{entry.code}  {title}  ({self.control.name} {entry.source}{group})\n{entry.doc}{takes}"
        return help_text(entry, self.term) + (f"\n\nDIN/ISO {', '.join(self._iso)}" if self._iso else "")

    __repr__ = __str__

    def save(self, path: str | Path) -> Path:
        """Write it as a page to print (.html), the glossary with its pictures."""
        return save_as(self, path, {".html": _write_page}, "help is saved as .html, not as {}")

    def plot(self, **options: Any) -> Any:
        """The picture of a term of the glossary."""
        if not isinstance(self.entry, Entry):
            raise Alarm("only a term of the glossary has a picture", hint='mnclab.help("equidistant").plot()')
        return self.entry.plot(**options)

    def _repr_html_(self) -> str:
        if isinstance(self.entry, Control | Entry | Glossary | Found):
            return self.entry._repr_html_()
        if isinstance(self.entry, Function | Term | str):
            return f"<pre>{escape(str(self))}</pre>"
        if isinstance(self.entry, tuple):
            return settings_html(self.entry)
        iso = ", ".join(f"<code>{name}</code>" for name in self._iso)
        return help_html(self.entry, self.term) + (f"<p>DIN/ISO {iso}</p>" if iso else "")


def _write_page(page: Help, path: Path) -> None:
    made = opened("mnclab.show.report.document", "page")
    terms = isinstance(page.entry, Glossary)
    shown = f"<h1>Glossary</h1>{page.entry.entries}" if terms else page._repr_html_()
    path.write_text(made("Glossary" if terms else "mnclab help", shown), "utf-8")


@fitting
def help(code: str | Control = "", control: str | None = None) -> Help:
    """The parameter table of a cycle, the meaning of a function, setting or term; "settings" is the table of all settings,
    "glossary" that of all terms, the name of a control alone the table of its codes. Of "exercise" and "design" it shows such a
    file.

    Without `control` that of the only control which has the code. Words in English or in the language of a manual find what
    has them in its title: one thing is shown, of several a table. An Alarm with the nearest codes if there is none.

    >>> mnc.help("word")
    word  (ru слово; ro cuvânt)
    An address and its number, such as X20: the smallest part of a block that means something. Not: token.
    """
    code = code.name if isinstance(code, Control) else code
    if not isinstance(code, str):
        raise Alarm(f"help is about a code or a setting, got {shown(code)}", hint='mnclab.help("G83", "mnc")')
    if control is None and code in PAGES:
        text = "".join(head + opened(file, "FORMAT") for head, file in PAGES[code])
        text = "".join(f"# {line}\n" for entry in named(code) for line in str(entry).splitlines()) + text
        return Help(text.rstrip(), next(iter(CONTROLS.values())))
    if control is None and code in CONTROLS:
        return Help(CONTROLS[code], CONTROLS[code])
    if control is None and (found := _of_words(code, None)):
        return found
    chosen = choose(control, "", "") if control is not None else _only_one_with(code)
    if code == chosen.name or not code.strip():
        return Help(chosen, chosen)
    wanted = _normal(code, chosen)
    entry = chosen.cycles.get(wanted) or chosen.functions.get(wanted)
    name = code.strip() if entry else code.strip().lower()  # G61 is a code, g61 a setting
    if settings := tuple(one for one in chosen.settings if name in ("settings", one.name)):
        return Help(settings, chosen)
    if entry:
        return Help(entry, chosen)
    if wanted in chosen.refused:
        known = terms(chosen.terms).get(plain(wanted))
        raise Alarm(f"{wanted}{f' ({known.shown})' if known and known.shown else ''}: {chosen.refused[wanted]}")
    if found := _of_words(code, chosen):
        return found
    names = (setting.name for setting in chosen.settings)
    near = hint(wanted, (*chosen.functions, *chosen.cycles, "settings", *names), 5)
    raise Alarm(f"{chosen.name} has no code {code!r}", hint=near)


def _titled(title: str, term: str) -> str:
    """A title with what the manual calls it."""
    return BETWEEN.join(filter(None, (title, term)))


def _of_words(words: str, chosen: Control | None) -> Help | None:
    """What words lead to that are no code: a term of the glossary, a concept of a manual, or all that have them in their
    titles, as a table if it is more than one."""
    asked, wordy = instead_of(words.strip()), not re.search(r"\d", words)
    first = next(iter(CONTROLS.values()))
    if chosen is None and wordy:
        if asked.lower() == "glossary":
            return Help(glossary(), first)
        if entries := named(asked):
            return _found([(entry, first) for entry in entries])
    if not asked or (chosen is None and (asked.lower() == "settings" or _with(asked))):
        return None
    controls = [chosen] if chosen else CONTROLS.values()
    hits = [(term, one) for one in controls if (term := terms(one.terms).get(plain(asked)))]
    if not hits and wordy and len(asked) > 2:
        titles = [each for one in controls for each in _titles(one)]
        titles += [(entry, first, entry.words) for entry in glossary()] if chosen is None else []
        has = having(asked, [texts for _, _, texts in titles])
        hits = [(thing, one) for (thing, one, _), good in zip(titles, has) if good]
    return _found(hits)


def _titles(control: Control) -> Iterator[tuple[Any, Control, tuple[str, ...]]]:
    """All that a control and its manual have, with the words by which it is found."""
    every: list[Any] = [*control.listed.values(), *control.cycles.values()]
    known, manual = {each.code: each for each in every}, terms(control.terms)
    for code, each in known.items():
        yield each, control, (each.title, *(manual[plain(code)].said if plain(code) in manual else ()))
    for term in manual.values():
        if _normal(term.code, control) not in known:
            yield term, control, (term.title, *term.said)


def _found(hits: Sequence[tuple[Any, Control]]) -> Help | None:
    """The help on one thing, the table of several."""
    if len(hits) < 2:
        return Help(*hits[0]) if hits else None
    rows = [
        (each.term, "glossary", each.means, each.manuals) if isinstance(each, Entry)
        else (each.code, one.name, each.title, one.term(each.code)) for each, one in hits
    ]  # fmt: skip
    return Help(Found(rows), hits[0][1])


def _with(code: str) -> list[Control]:
    """The controls that have a code, or refuse it."""
    return [one for one in CONTROLS.values() if _normal(code, one) in {*one.functions, *one.cycles, *one.refused}]


def _only_one_with(code: str) -> Control:
    """The control that has a code; an Alarm where none or several have."""
    if code.strip().lower() == "settings":
        known = f'help("settings", "mnc"); controls: {", ".join(CONTROLS)}'
        raise Alarm("every control has its own settings: name it", hint=known)
    owners = _with(code)
    if code.strip() and len(owners) == 1:
        return owners[0]
    whose = f"a code of {', '.join(one.name for one in owners)}" if owners else "no code of any control and no word of a manual"
    example = f'help("{code.strip()}", "{owners[0].name}")' if owners else 'help("G83", "mnc")'
    near = "" if owners else hint(code.strip().lower(), [word for entry in glossary() for word in entry.words])
    raise Alarm(
        f"{code} is {whose}{': name the control' * bool(owners)}" if code.strip() else "help needs a code and a control",
        hint=f'{near + "; " if near else ""}{example}, or help("mnc") for all its codes; controls: {", ".join(CONTROLS)}',
    )


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


# Block numbers written anew, with the jumps that name them; everything else of a program stays as it is.

@fitting
def renumber(
    source: str | Path | Program, control: str | None = None, *, start: int | None = None, step: int | None = None
) -> str:
    """The text of a program with new block numbers; GOTO, M99 P, G25 P follow them, and the path stays the same.

    `source`, `control`: as in `mnclab.run`. `start`, `step`: the first number and what is added each time, without them
    10 and 10 (Klartext: 0 and 1, NC-31: 1 and 1). Only blocks with a number get a new one; a Klartext program without any
    gets them all. An Alarm where a jump computes its target, or names a block that is not there.

    >>> print(mnc.renumber("N1 G0 X5\\nN2 M30\\n", "mnc", start=100, step=5), end="")
    N100 G0 X5
    N105 M30
    """
    program = source if isinstance(source, Program) else read(source, control)
    chosen = CONTROLS[program.control]
    if chosen.numbers is None:
        raise Alarm(f"blocks of {chosen.name} have no numbers")
    numbers = chosen.numbers(program)
    if not numbers.blocks:
        raise Alarm("no block of the program has a number")
    first = numbers.first if start is None else whole(start, "start")
    more = numbers.step if step is None else whole(step, "step")
    least = min(numbers.first, 1)
    if first < least:
        raise Alarm(f"start must be at least {least}, got {first}")
    if more < 1:
        raise Alarm(f"step must be at least 1, got {more}")
    if (last := first + more * (len(numbers.blocks) - 1)) >= LARGEST:
        raise Alarm(f"the last number would be {shown(last)}: it must be smaller than {LARGEST:g}, as every number")
    return renumbered(program.text, numbers, first, more)


def renumber_file(
    file: Path, control: str | None = None, *, start: int | None = None, step: int | None = None, out: Path | None = None
) -> str:
    """The same of a file, written to `out` in the bytes of the file: code page, marks and line ends stay."""
    program = read(file, control)
    text = renumber(program, start=start, step=step)
    if out is not None:
        content = encode_like(text, program.text, read_file(file, file), program.encoding)
        with replaced(out) as beside:
            beside.write_bytes(content)
    return text

"""A cell of a notebook that is a part program: obeyed, its words completed and explained, those in calls of mnclab too.

    %%mnc --control tnc-620 --tools my_tools --name first
    BEGIN PGM FIRST MM
    …

The run is bound to `run` (or to another name), its card with the alarms and their carets stands under the cell, and
the picture below, if anything moved. What a name such as `my_tools` means is looked up in the notebook; `--setup` also
takes a file. Nothing here knows IPython: a source, a cursor (characters from its beginning) and the names of the notebook
are enough.
"""

from __future__ import annotations

import argparse
import os
import re
import shlex
from collections.abc import Mapping
from dataclasses import replace
from html import escape
from itertools import islice
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple, NoReturn

from mnclab.controls import CONTROLS
from mnclab.controls.choice import choose, help
from mnclab.controls.choice import run as run_text
from mnclab.lab.vocabulary import Choices, completions, meaning_at, rest_of, vocabulary
from mnclab.machine.control import Control
from mnclab.machine.setup import Setup
from mnclab.machine.setup_file import load
from mnclab.path.machines import machines
from mnclab.path.tool import Tool
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm


class _Options(argparse.ArgumentParser):
    """Options whose faults are alarms."""

    def error(self, message: str) -> NoReturn:
        raise Alarm(f"%%mnc: {message}", hint=" ".join(self.format_usage().split()))


def options() -> argparse.ArgumentParser:
    """What may stand beside %%mnc."""
    parser = _Options(prog="%%mnc", add_help=False)
    parser.add_argument("--control", metavar="NAME", help=f"one of {', '.join(CONTROLS)}; default: the text says")
    parser.add_argument("--tools", metavar="NAME", help="a dict of the notebook: number -> Tool")
    parser.add_argument("--setup", metavar="NAME", help="a Setup of the notebook, or a setup file")
    parser.add_argument("--exercise", metavar="ID", help="grade the cell as the answer to this exercise")
    parser.add_argument("--name", default="run", help="what the run is called in the notebook")
    parser.add_argument("--colour", default="kind", help="what the colour of the cuts shows")
    parser.add_argument("--card", action="store_true", help="show the card alone, without the picture")
    parser.add_argument("--quiet", action="store_true", help="show the alarms alone")
    return parser


def chosen_of(line: str) -> argparse.Namespace:
    """The options beside %%mnc; an Alarm for those that make no sense."""
    try:
        words = shlex.split(line)
    except ValueError as fault:
        raise Alarm(f"%%mnc: {fault}") from None
    chosen = options().parse_args(words)
    if not chosen.name.isidentifier():
        raise Alarm(f"%%mnc: --name must be a name of Python, got {chosen.name!r}")
    return chosen


def run_cell(line: str, cell: str, names: Mapping[str, Any]) -> tuple[str, Run, argparse.Namespace]:
    """Run a cell; the name for it, the run, and the options. An Alarm for options that make no sense."""
    chosen = chosen_of(line)
    text = cell if cell.endswith("\n") else cell + "\n"
    return chosen.name, run_text(text, chosen.control, _setup(chosen, names)), chosen


def _setup(chosen: argparse.Namespace, names: Mapping[str, Any]) -> Setup:
    setup = Setup()
    if chosen.setup:
        found = names.get(chosen.setup)
        if isinstance(found, Setup):
            setup = found
        elif chosen.setup.endswith(".toml") or Path(chosen.setup).is_file():
            setup = load(chosen.setup)
        else:
            raise Alarm(f"%%mnc: --setup {chosen.setup} is neither a Setup of this notebook nor a setup file")
    if chosen.tools:
        tools = names.get(chosen.tools)
        if not isinstance(tools, Mapping) or not all(isinstance(tool, Tool) for tool in tools.values()):
            what = f"%%mnc: --tools {chosen.tools} is no dict of tools in this notebook"
            raise Alarm(what, hint="t = {1: Tool(radius=5)}")
        setup = replace(setup, tools=tools)
    return setup


# What may be typed next in a notebook, and what a word there means: in `%%mnc` cells, and in calls of mnclab.

MOST = 500  # files of a folder
#: What the arguments of a function are, in their order.
TAKES = {
    **dict.fromkeys(("run", "read", "modern", "panel"), ("program", "control")),
    "help": ("code", "control"), "form": ("cycle", "control"), "steps": ("cycle", "control"),
    "editor": ("file", "control"), "check": ("file", "control"),
    **dict.fromkeys(("profile", "player", "removal"), ("machine",)),
}  # fmt: skip
BY_KEYWORD = {"control": "control", "limits": "machine", "machine": "machine"}
_CONTROL = re.compile(r"""^\s*,\s*(?:control\s*=\s*)?["']([\w-]+)["']""")
_OPTION = re.compile(r"--(\w+)[ =]+(\S*)$")
_CELL = re.compile(r"%%mnc\b[^\n]*")


class Cursor(NamedTuple):
    """A cursor in the text of a program, and the control that was named, or that its text points to."""

    text: str
    at: int
    control: Control | None


def suggestions(source: str, at: int, names: Mapping[str, Any]) -> tuple[str, Choices] | None:
    """What of a word stands before the cursor already, and what it may be with what that means; None: no idea."""
    head = _CELL.match(source)
    if head and at <= head.end():
        return _of_options(source[:at], names)
    call = None if head else call_at(source, at)
    kind = _kind(call, names) if call else ""
    if (place := _program(source, at, head, call, kind)) and (head or call and call.text and re.search(r"\s", call.text)):
        return _of_program(place)
    if call is None or not kind:
        return None
    if call.text is None:
        return _of_steps(source[:at], call) if kind == "value" else None
    typed = call.text[: call.at]
    if kind == "control":
        return typed, _beginning(typed, {name: one.title for name, one in CONTROLS.items()})
    if kind == "machine":
        return typed, _beginning(typed, {one.name: one.title for one in machines()})
    if kind in ("file", "program"):
        in_folder = typed, [(name, "folder" if name.endswith("/") else "program") for name in files(typed)]
        codes = _of_program(place) if place and not in_folder[1] and not re.search(r"[/\\.]", typed) else None
        return codes or in_folder
    return _of_codes(typed, call, kind)


def explanation(source: str, at: int, names: Mapping[str, Any]) -> dict[str, str]:
    """What the word under a cursor means, as MIME types; empty where it is no word of a program."""
    head = _CELL.match(source)
    call = None if head else call_at(source, at)
    kind = _kind(call, names) if call else ""
    place = _program(source, at, head, call, kind)
    if place is None or (head and at <= head.end()) or place.control is None:
        return {}
    found = meaning_at(place.text, place.at, place.control) or meaning_at(place.text, max(place.at - 1, 0), place.control)
    if found is None:
        return {}
    word, code, says = found
    if word == code and code in {**place.control.cycles, **place.control.functions}:
        page = help(code, place.control.name)
        return {"text/plain": str(page), "text/html": page._repr_html_()}
    of = f" ({code} {vocabulary(place.control).codes[code].title})" if code else ""
    return {"text/plain": f"{word}  {says}{of}", "text/html": f"<p><code>{escape(word)}</code> {escape(says + of)}</p>"}


# --- where the cursor is ------------------------------------------------------------------------------------------------


def _kind(call: Call, names: Mapping[str, Any]) -> str:
    """What the argument at the cursor is: "program", "code", "control" …; empty where the function is none of mnclab's."""
    owner, _, function = call.function.rpartition(".")
    thing = names.get(owner or function)
    module = thing.__name__ if isinstance(thing, ModuleType) else getattr(thing if not owner else type(thing), "__module__", "")
    chained = call.function.startswith(".") and function in ("profile", "player", "removal")  # mnc.run(…).profile("
    if not chained and not str(module).startswith("mnclab"):
        return ""
    if call.keyword:
        return BY_KEYWORD.get(call.keyword, "")
    takes = TAKES.get(function, ())
    if call.position < len(takes):
        return takes[call.position]
    return "value" if function == "steps" else ""


def _program(source: str, at: int, head: re.Match[str] | None, call: Call | None, kind: str) -> Cursor | None:
    """The program that a cursor is in: that of a cell, or a text that is given to a function."""
    if head:
        named = re.search(r"--control[ =]+[\"']?([\w-]+)", head[0])
        text = source[head.end() + 1 :]
        return Cursor(text, at - head.end() - 1, _control(named[1] if named else None, text))
    if call and kind == "program" and call.text is not None:
        named = _CONTROL.search(call.after)
        return Cursor(call.text, call.at, _control(named[1] if named else None, call.text))
    return None


def _control(name: str | None, text: str) -> Control | None:
    try:
        return choose(name, "", text)
    except Alarm:  # not told, or not yet
        return None


# --- what may stand there -----------------------------------------------------------------------------------------------


def _of_program(place: Cursor) -> tuple[str, Choices]:
    """The words of a program; as long as nobody knows the control, those of all of them."""
    controls = [place.control] if place.control else list(CONTROLS.values())
    near = [name for name in files("") if not name.endswith("/")]
    found = [completions(place.text, place.at, control, near) for control in controls]
    begun = max((fragment for fragment, _ in found), key=len)
    said: dict[str, str] = {}
    for fragment, choices in found:
        for word, meaning in choices if fragment == begun else ():
            said.setdefault(word, meaning)
    return begun, list(said.items())


def _of_options(before: str, names: Mapping[str, Any]) -> tuple[str, Choices] | None:
    """The options of %%mnc, and what may follow one."""
    if (option := _OPTION.search(before)) and before[-1:] != "-":
        name, typed = option.groups()
        known = {
            "control": {one: control.title for one, control in CONTROLS.items()},
            "setup": {one: "setup" for one, value in names.items() if isinstance(value, Setup)},
            "tools": {one: "tools" for one, value in names.items() if isinstance(value, dict) and one[:1] != "_"},
        }
        return typed, _beginning(typed, known.get(name, {}))
    typed = re.split(r"\s", before)[-1]
    told = {each.option_strings[0]: each.help or "" for each in options()._actions}
    return (typed, _beginning(typed, told)) if before.startswith("%%mnc ") else None


def _of_codes(typed: str, call: Call, kind: str) -> tuple[str, Choices]:
    """Codes of the control that is named after them, or of all; help knows controls and settings too."""
    named = _CONTROL.search(call.after)
    chosen = _control(named[1], "") if named else None
    titles: dict[str, str] = {}
    for control in [chosen] if chosen else CONTROLS.values():
        known = {code: one.title for code, one in control.functions.items() if kind == "code"}
        known |= {code: one.title for code, one in control.cycles.items()}
        for code, title in known.items():
            titles.setdefault(code, title if chosen else f"{title} ({control.name})")
    if kind == "code":
        known = {n: one.title for n, one in CONTROLS.items()} | {"glossary": "the words of the trade"}
        titles |= {"settings": "the readings of a control"} | ({} if chosen else known)
    return rest_of(typed, titles)


def _of_steps(before: str, call: Call) -> tuple[str, Choices] | None:
    """The values of a cycle by address: `mnc.steps("G83", "mnc", K`."""
    if len(call.texts) < 2 or not (typed := re.search(r"[(,]\s*(\w*)$", before)):
        return None
    control = _control(call.texts[1], "")
    code = vocabulary(control).codes.get(" ".join(call.texts[0].upper().split())) if control else None
    return (typed[1], _beginning(typed[1], {f"{word}=": says for word, says in code.words.items()})) if code else None


def _beginning(typed: str, known: Mapping[str, str]) -> Choices:
    return [(word, meaning) for word, meaning in known.items() if word.lower().startswith(typed.lower())]


def files(typed: str) -> list[str]:
    """Programs and folders whose path begins as typed, a folder with a slash."""
    folder, name = os.path.split(typed)
    suffixes = {suffix for control in CONTROLS.signed() for suffix in control.suffixes} | {".pnt", ".tab", ".d"}
    try:
        with os.scandir(folder or ".") as entries:
            found = [entry.name + "/" * entry.is_dir() for entry in islice(entries, MOST)]
    except (OSError, ValueError):
        return []
    wanted = (each for each in found if each.lower().startswith(name.lower()) and (each[0] != "." or name[:1] == "."))
    return sorted(
        os.path.join(folder, each) for each in wanted if each.endswith("/") or os.path.splitext(each)[1].lower() in suffixes
    )


# Which call of Python a cursor stands in, and in which of its arguments, while the source is being typed.
# Source that is half written cannot be parsed; brackets and texts are followed to the cursor, and no further.

_NAME = re.compile(r"\s*+([\w.]*+)")  # of a function, read from its end
_KEYWORD = re.compile(r"[(,]\s*(\w+)\s*$")


class Call(NamedTuple):
    """The function as written (`mnc.run`), the number or the keyword of the argument; the text that the cursor is in and
    where in it (None outside a text), the texts given before, and the source after."""

    function: str
    position: int
    keyword: str
    text: str | None
    at: int
    texts: tuple[str, ...]
    after: str


class _Frame:
    """A bracket that is open."""

    def __init__(self, function: str) -> None:
        self.function, self.position, self.keyword = function, 0, ""
        self.texts: list[str] = []

    def call(self, text: str | None, at: int, after: str) -> Call:
        return Call(self.function, self.position, self.keyword, text, at, tuple(self.texts), after)


def call_at(source: str, at: int) -> Call | None:
    """The innermost call around a cursor; None outside of calls. A cursor beyond the source stands at its end."""
    frames: list[_Frame] = []
    k, at = 0, min(at, len(source))
    while k < at:
        sign = source[k]
        if sign in "\"'":
            quote = sign * 3 if source.startswith(sign * 3, k) else sign
            begin = k + len(quote)
            end = _end(source, begin, quote)
            if end >= at >= begin and frames:
                return frames[-1].call(source[begin:end], at - begin, source[end + len(quote) :])
            if frames:
                frames[-1].texts.append(source[begin:end])
            k = max(end + len(quote), begin)
            continue
        if sign == "#":
            k = source.find("\n", k) if "\n" in source[k:] else at
        elif sign in "([{":
            found = _NAME.match(source[:k][::-1]) if sign == "(" else None
            frames.append(_Frame(found[1][::-1] if found else ""))
        elif sign in ")]}" and frames:
            frames.pop()
        elif sign == "," and frames:
            frames[-1].position, frames[-1].keyword = frames[-1].position + 1, ""
        elif sign == "=" and frames and (named := _KEYWORD.search(source[:k])):
            frames[-1].keyword = named[1]
        k += 1
    return frames[-1].call(None, 0, source[at:]) if frames and frames[-1].function else None


def _end(source: str, begin: int, quote: str) -> int:
    """Where a text ends: at its quote, a short one with its line at the latest."""
    stop = len(source) if len(quote) == 3 else source.find("\n", begin) % (len(source) + 1)
    k = begin
    while k < stop and not source.startswith(quote, k):
        k += 2 if source[k] == "\\" else 1
    return min(k, stop)

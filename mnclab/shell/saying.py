"""How a command ends and what it says on stderr: statuses, alarms in one line each, wrong command lines."""

from __future__ import annotations

import platform
import sys
from collections.abc import Callable, Iterable
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm
from mnclab.text.file import named, replaced

Result = TypeVar("Result")
CLEAN, ALARMS, USAGE, INTERRUPTED = 0, 1, 2, 130
PACKAGES = ("numpy", "shapely", "matplotlib", "pyvista", "ipywidgets", "jupyterlab", "ezdxf", "pandas")


def environment() -> str:
    """Python, the system and the packages that mnclab runs with, in a line for who reports a fault."""
    found = []
    for name in PACKAGES:
        try:
            found.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            found.append(f"no {name}")
    return f"Python {platform.python_version()} on {platform.system()} {platform.machine()}; {', '.join(found)}"


def say(alarm: Alarm, file: str = "") -> None:
    """One line for an alarm; `file` is what it is about when it stands in no program."""
    line = alarm.headline
    if alarm.source is None and alarm.span is None:
        hint = f" ({alarm.hint})" if alarm.hint else ""
        line = f"{file or 'mnclab'}: {alarm.severity}: {alarm.message.removeprefix(f'{file} ')}{hint}"
    print(" ".join(line.split("\n")), file=sys.stderr)


def describe(alarm: Alarm, file: str) -> dict[str, Any]:
    """An alarm for programs that read JSON."""
    return alarm.as_dict() if alarm.source else alarm.as_dict() | {"file": file}


def write_table(out: str, text: str) -> bool:
    """The comma-separated values of --csv: to stdout, or to a file; whether to a file."""
    if out in ("", "-"):
        print(text, end="")
        return False
    with replaced(named(out, (".csv",), "a table is written as .csv, not as {}")[0]) as beside:
        beside.write_text(text, "utf-8", newline="")
    return True


def program(file: str) -> Path:
    """The path of a program; an Alarm for an empty name, which would be the folder."""
    if not file:
        raise Alarm("the name of the program is empty")
    return Path(file)


def sensible(do: Callable[..., Result], *arguments: Any) -> Result:
    """The result of what a command line asks for beside its programs; a fault in that is a wrong command line."""
    try:
        return do(*arguments)
    except Alarm as alarm:
        say(alarm)
        sys.exit(USAGE)


def refuse(said: str, hint: str = "") -> NoReturn:
    """End with the status of a wrong command line, and say why."""
    say(Alarm(said, hint=hint))
    sys.exit(USAGE)


def nothing_in(places: Iterable[str]) -> NoReturn:
    """Refuse folders without a program: a mistyped one would look like one where all is well."""
    known = "programs are known by their suffix: .mnc, .jnc, .nc31, .h, .i, .nc, …; mnclab check takes --suffixes"
    raise Alarm(f"there is no program in {', '.join(places)}", hint=known)


def with_blank(result: Run) -> Run:
    """The same run; an Alarm if there is no blank to cut."""
    if result.stock is None:
        raise Alarm("there is no blank to cut", hint="give one: a [stock] in the file of --setup (mnclab --help shows one)")
    return result

"""What is opened only when it is asked for: names of mnclab, packages that may be missing, a bar for long work."""

from __future__ import annotations

import re
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from inspect import getdoc, isclass, isfunction
from pathlib import Path
from types import ModuleType
from typing import Any

from mnclab.text.alarm import Alarm, hint
from mnclab.text.given import checked

# Names that are opened when they are first asked for, so that `import mnclab` takes little more than numpy does.
# What is opened is the real thing: its signature, its docstring, its own file.
# The core of the house imports no wing (`design`, `lab`, the controls): it opens by name what a wing offers, and where that
# wing was left out, an alarm says so.

#: What may be left out -> what it holds.
WINGS = {
    "mnclab.design": "parts as drawn, their drawings and differences",
    "mnclab.lab": "forms, panels, the editor and the magics",
    "mnclab.learning": "exercises and their grades",
    "mnclab.controls": "the controls",
}


def opened(module: str, name: str) -> Any:
    """What a module calls by this name, or its file of this name; an Alarm where the wing of the module is not there."""
    try:
        found = import_module(module)
        return getattr(found, name) if hasattr(found, name) else import_module(f"{module}.{name}")
    except ModuleNotFoundError as fault:
        held = next((held for wing, held in WINGS.items() if f"{fault.name}.".startswith(f"{wing}.")), "")
        if not held:
            raise
        raise Alarm(f"{name} is not there: {fault.name} was left out of this mnclab (it holds {held})") from None


_LINES = re.compile(r"^from (mnclab\.\S+) import (\w+) as (\w+)$", re.M)


class Shelf(ModuleType):
    """A module of names that stand in several files: `mnc.part.box(…)`. Printed, it says what each of them is.

    The names are those that a stub (`part.pyi`) imports, a line each: there editors and type checkers read them too. One whose
    stub is that of a folder, as a wing's, is a package besides: `__path__` says where its files are. One that `judges` gives
    out functions that look at what they are given first, which the house, whose files import each other, need not.
    """

    def __init__(self, name: str, stub: str | Path, judges: bool = True) -> None:
        self._left_out = isinstance(stub, Path) and not stub.is_file()
        text = '"""left out of this mnclab"""' if self._left_out else stub.read_text("utf-8") if isinstance(stub, Path) else stub
        super().__init__(name, text.split('"""', 2)[1].removesuffix("."))
        self._judges = judges
        if isinstance(stub, Path) and stub.name == "__init__.pyi" and name.count("."):
            self.__path__ = [str(stub.parent)]
        self._places = {here: (module, there) for module, there, here in _LINES.findall(text)}
        self.__all__ = list(self._places)
        sys.modules.setdefault(name, self)  # for `from mnclab.part import box`

    def __getattr__(self, name: str) -> Any:
        if self._left_out and not name.startswith("_"):
            opened(f"{self.__name__}.{name}", name)  # an alarm that says what was left out
        if name not in self._places:
            near = "" if name.startswith("_") else hint(name, self._places)
            raise AttributeError(f"{self.__name__} has no {name!r}" + (f" ({near})" if near else ""))
        found = opened(*self._places[name])
        if self._judges and isfunction(found):
            found = checked(found)
        elif self._judges and isinstance(found, ModuleType):
            found = _shelf_of(found, f"{self.__name__}.{name}")
        setattr(self, name, found)
        return found

    def __dir__(self) -> list[str]:
        return [*self.__all__, "__all__", "__doc__", "__name__"]

    def __repr__(self) -> str:
        wide = max(map(len, self.__all__), default=0)
        lines = (f"    {name:{wide}}  {_said(getattr(self, name))}".rstrip() for name in self.__all__)
        return "\n".join([f"{self.__name__}: {self.__doc__}", *lines])


def _shelf_of(module: ModuleType, name: str) -> Shelf:
    """A module of functions and classes as a shelf of its own."""
    made = {
        each: getattr(thing, "__module__", "") if isfunction(thing) or isclass(thing) else ""
        for each, thing in vars(module).items()
    }
    own = [each for each, of in made.items() if of == module.__name__ or (not of and each.isupper())]  # a constant is of a class
    public = [each for each in own if not each.startswith("_") and not isinstance(vars(module)[each], ModuleType)]
    lines = (f"from {module.__name__} import {each} as {each}" for each in public)
    return Shelf(name, "\n".join([f'"""{(getdoc(module) or "").partition(chr(10))[0]}"""', *lines]))


def _said(found: Any) -> str:
    """The first line about something; of a table its names, of a value what it is."""
    if isinstance(found, str | int | float):
        return repr(found)
    return ", ".join(map(str, found)) if isinstance(found, Mapping) else (getdoc(found) or "").partition("\n")[0]


# Packages that mnclab can do without: who needs one says so, and an alarm names the extra that brings it.

def require(package: str, what: str, extra: str = "lab", instead: str = "") -> None:
    """An Alarm where a package is not installed, or not whole: `what` needs it."""
    try:
        import_module(package)
    except ImportError:
        hint = f'pip install "mnclab[{extra}]" brings it' + (f"; {instead}" if instead else "")
        raise Alarm(f"{what} need {package}, which is not installed here", hint=hint) from None


# How far long work is: a bar, where tqdm is installed and the work takes more than a moment.
# It is shown from the main thread alone: a form draws in a thread of its own, and a bar there would stand under another cell.

SOON = 1.0  # s of work before a bar appears


@contextmanager
def progress(what: str, total: int, unit: str) -> Iterator[Callable[[int], None]]:
    """`with progress("running", 10_000, "blocks") as at: …; at(300)`, now and then; the bar goes with the end of the block."""
    begin = time.monotonic()
    bar: Any = None
    refused = threading.current_thread() is not threading.main_thread()

    def at(done: int) -> None:
        nonlocal bar, refused
        if refused or (bar is None and time.monotonic() - begin < SOON):
            return
        if bar is None:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                refused = True
                return
            bar = tqdm(total=total, desc=what, unit=f" {unit}", leave=False)
        bar.total = max(bar.total, done)  # a loop in a program runs blocks again
        bar.update(done - bar.n)

    try:
        yield at
    finally:
        if bar is not None:
            bar.close()

"""Names that are opened when they are first asked for, so that `import mnclab` needs numpy only.

What is opened is the real thing: its signature, its docstring, its own file. Where it stands is written as an import
is, a module and its names: `{"mnclab.geometry.shapes": "arc, slot", "mnclab.geometry.svg": "contours as svg"}`.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from inspect import getdoc
from pkgutil import resolve_name
from types import ModuleType
from typing import Any

from mnclab.text.nearest import hint


class Shelf(ModuleType):
    """A module of names that stand in several files: `mnc.part.box(…)`. Printed, it says what each of them is."""

    def __init__(self, name: str, doc: str, imports: Mapping[str, str]) -> None:
        super().__init__(name, doc)
        written = ((module, each.split(" as ")) for module, names in imports.items() for each in names.split(", "))
        self._places = {each[-1]: f"{module}.{each[0]}" for module, each in written}
        self.__all__ = list(self._places)
        sys.modules.setdefault(name, self)  # for `from mnclab.part import box`

    def __getattr__(self, name: str) -> Any:
        if name not in self._places:
            near = "" if name.startswith("_") else hint(name, self._places)
            raise AttributeError(f"{self.__name__} has no {name!r}" + (f" ({near})" if near else ""))
        found = resolve_name(self._places[name])
        setattr(self, name, found)
        return found

    def __dir__(self) -> list[str]:
        return [*self.__all__, "__all__", "__doc__", "__name__"]

    def __repr__(self) -> str:
        wide = max(map(len, self.__all__))
        lines = (f"    {name:{wide}}  {_said(getattr(self, name))}".rstrip() for name in self.__all__)
        return "\n".join([f"{self.__name__}: {self.__doc__}", *lines])


def _said(found: Any) -> str:
    """The first line about something; of a table its names."""
    return ", ".join(map(str, found)) if isinstance(found, Mapping) else (getdoc(found) or "").partition("\n")[0]

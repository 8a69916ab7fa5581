"""Who speaks: a folder a control, each built of functions, cycles and a reader.

May import everything below; a control imports `word_address`, never another control. A new control is a folder whose
`__init__` has its suffixes and signs and whose `control` builds one `Control`, and one line in `MODULES`; third parties
use the entry-point group `mnclab.controls`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from mnclab.text.dialect import Sign
from mnclab.text.tables import html_table

if TYPE_CHECKING:  # what stands at the front door imports no room
    from mnclab.machine.control import Control

#: Name of a control -> the folder that builds it, if it was not left out.
MODULES = {
    name: f"mnclab.controls.{folder}"
    for name, folder in {"mnc": "mnc", "tnc-620": "tnc_620", "nc-31": "nc_31", "g43": "g43", "jnc-t01": "jnc_t01"}.items()
    if (Path(__file__).parent / folder).is_dir()
}

#: Other names that a control answers to.
ALSO = {"iso": "g43"}


class Signed(NamedTuple):
    """By what the programs of a control are told from those of others."""

    name: str
    suffixes: tuple[str, ...]
    signs: tuple[Sign, ...]


class Controls(Mapping[str, "Control"]):
    """All controls by name; a control is imported when it is first asked for.

    >>> mnc.controls["jnc-t01"].title
    'JNC-T01 (lathe)'
    """

    def __init__(self) -> None:
        self._built: dict[str, Control] = {}

    def __getitem__(self, name: str) -> Control:
        name = ALSO.get(name, name)
        if name not in self._built:
            if name in MODULES:
                self._built[name] = import_module(f"{MODULES[name]}.control").CONTROL
            else:
                self._built[name] = self._foreign[name]
        return self._built[name]

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys([*MODULES, *self._built, *self._foreign]))

    def __len__(self) -> int:
        return len(list(iter(self)))

    def signed(self) -> Iterator[Signed]:
        """By what the programs of each are told: read without what obeys them, which takes ten times as long."""
        for name in self:
            light = None if name in self._built or name not in MODULES else import_module(MODULES[name])
            yield Signed(name, light.SUFFIXES, light.SIGNS) if light else Signed(name, self[name].suffixes, self[name].signs)

    def add(self, control: Control) -> None:
        """Make a control known to the running Python."""
        self._built[control.name] = control

    def remove(self, name: str) -> None:
        """Forget a control that was added."""
        self._built.pop(name, None)

    @cached_property
    def _foreign(self) -> dict[str, Control]:
        """Controls of other packages: what is installed is read once, as that takes longer than a short program."""
        from importlib.metadata import entry_points  # its import takes half as long as the rest of the front door

        return {
            point.name: point.load() for point in entry_points(group="mnclab.controls") if point.name not in MODULES
        }

    def __repr__(self) -> str:
        also = {known: f" (also {name})" for name, known in ALSO.items()}
        return "\n".join(f"{name:8s} {self[name].title}{also.get(name, '')}" for name in self)

    def _repr_html_(self) -> str:
        rows = [(name, one.title, str(len(one.functions)), str(len(one.cycles))) for name, one in self.items()]
        return html_table(("control", "title", "functions", "cycles"), rows, numbers=(2, 3), code=(0,))


CONTROLS = Controls()

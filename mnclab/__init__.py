"""mnclab: part programs of real CNC controls, obeyed exactly as their manuals say, and shown.

A part program is text; a control reads it into blocks; a machine obeys the blocks with a dozen verbs; every obeyed verb
is a row in a table of moves; everything one can look at is computed from that table.

The map of the house, floor by floor (a folder imports only from those above its line)::

    text        what a programmer wrote: Alarm, Program, words, expressions
    geometry    frames, arcs, contours, offsets, regions: numbers, no CNC word
    path        what the tool does: Toolpath in columns, passes over it (corners, compensation), and the feed profile
    workpiece   what the tool meets, and what is left: blank, milled and turned part, removal, collisions
    machining   how metal is cut, whatever the control: holes, milling, turning, as steps
    comparison  two paths, or strategies, side by side
    machine     what stands before a program runs: Machine, Setup, what a Control and a Cycle declare
    running     what runs: the interpreter, the handing out of words, the bulk tier, cycles carried out
    runs        what is there after: Run, its history, moments, explanations
    controls    who speaks: a folder a control
    show        what people see and take away: plots, player, files
    shell       what is typed in a terminal

and its wings, which may be left out and which no other room imports::

    controls/…  each control with what it alone needs: mnc, jnc_t01, nc_31, g43, tnc_620
    design      parts as drawn: designs, drawings, differences, recognition
    learning    exercises that grade the part: tasks, hints, classes
    lab         where one types and tries: forms, panels, editor, magics, sketches

This module is the front door, and nothing else: what stands behind it is written in `__init__.pyi`, where editors and type
checkers read it too, and is opened when it is first asked for. `part`, `blank`, `design`, `area`, `strategies`, `schemes`
and `probing` are shelves: print one to see what is on it.
"""

import sys as _sys
from pathlib import Path as _Path
from typing import Any

from mnclab.controls import CONTROLS as controls  # noqa: F401
from mnclab.text.alarm import nearest as _nearest
from mnclab.text.opening import Shelf

__version__ = "0.2.0"

_HERE = _Path(__file__).parent
OPENED = Shelf("mnclab", _HERE / "__init__.pyi", judges=False)
_STUBS = {"design": _HERE / "design" / "__init__.pyi", **{file.stem: file for file in _HERE.glob("[a-z]*.pyi")}}
_SHELVES = {name: Shelf(f"mnclab.{name}", file) for name, file in _STUBS.items()}
globals().update(_SHELVES)

#: Without help, which would shadow the one of Python, and what a user does not call.
__all__ = sorted({"controls", *_SHELVES, *OPENED.__all__} - {"help", "load_ipython_extension"})


def __getattr__(name: str) -> Any:
    if name in OPENED.__all__:
        globals()[name] = found = getattr(OPENED, name)
        return found
    shelves = {each: shelf for shelf in _SHELVES.values() for each in shelf.__all__}
    near = [] if name.startswith("_") else _nearest(name, dict.fromkeys([*__all__, "help", *shelves]))
    said = ", ".join(f"{shelves[each].__name__}.{each}" if each in shelves and each not in __all__ else each for each in near)
    raise AttributeError(f"mnclab has no {name!r}" + (f" (near: {said})" if said else ""))


def __dir__() -> list[str]:
    return sorted({*__all__, "help", "__version__"})


# In a notebook Tab completes the codes of a control from the first import on: who needs that does not know %load_ext mnclab.
if (_shell := getattr(_sys.modules.get("IPython"), "get_ipython", lambda: None)()) is not None:
    OPENED.load_ipython_extension(_shell)

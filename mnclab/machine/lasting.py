"""What a visit must leave as it found it, so that the next one does the same: everything but the place and the rows.

The attributes of the machine are compared as they are, down to the values in them; only those named here are left out. So
what is added to the machine one day is compared without a word here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import is_dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

#: The place, which is moved, with the rows and the history; and what follows from all the rest.
MOVED = frozenset(("tip", "programmed", "recorder", "logs", "_state"))
#: What nothing changes, and what has a rule of its own below.
GIVEN = frozenset(("control", "setup", "settings", "flow"))
#: What grows and is not changed: its length says enough, and a long path is not looked through at every pattern.
GROWING = frozenset(("alarms", "programmed_pieces", "settled", "gouges"))
#: Of the course of the program: the programs, and the log of steps, of which the machine has the last.
OF_FLOW = frozenset(("programs", "obey", "bulk", "switch", "machine", "watched", "loops", "_chunks", "_blocks"))
#: What is another one in each block of a run of holes; what is modal of the cycle is compared.
OF_BLOCK = frozenset(("step", "source_line", "position_cycle"))
OF_PASS = frozenset(("step", "source_line"))


def lasting(m: Machine) -> tuple[Any, ...]:
    """Everything that stays from one visit to the next within a block: equal where the machine is as it was."""
    flow = {name: value for name, value in vars(m.flow).items() if name not in OF_FLOW}
    return _level(m), _attributes(m, frozenset()), frozen(flow)


def lasting_over_blocks(m: Machine) -> tuple[Any, ...]:
    """The same where each visit is a plain block under the same cycle."""
    definition = m.position_cycle
    assert definition is not None
    modal = {p.name: definition.values.get(p.name) for p in definition.cycle.parameters() if p.modal}
    return _level(m), _attributes(m, OF_BLOCK), definition.cycle, frozen(modal), frozen(definition.extra)


def lasting_over_passes(m: Machine) -> tuple[Any, ...]:
    """The same for the passes of a repeat: where it is equal, the next pass does what this one did, elsewhere."""
    return _attributes(m, OF_PASS)


def _level(m: Machine) -> tuple[Any, ...]:
    return m.programmed[2], len(m.recorder.joints)


def _attributes(m: Machine, less: frozenset[str]) -> tuple[Any, ...]:
    return tuple(
        (name, getattr(value, "total", len(value)) if name in GROWING else frozen(value, (m,)))
        for name, value in vars(m).items()
        if not (name in MOVED or name in GIVEN or name in less)
    )


def frozen(value: Any, within: tuple[Any, ...] = ()) -> Any:
    """A value that stays as it is now, to be compared with a later one; `within` are the things that hold it."""
    if isinstance(value, float):
        return value if value == value else "nan"
    if isinstance(value, str | int | None):
        return value
    if any(value is outer for outer in within):
        return "itself"
    if isinstance(value, np.ndarray):
        return value.shape, value.tobytes()
    inner = (*within, value)
    if isinstance(value, Mapping):
        return tuple((key, frozen(one, inner)) for key, one in value.items())
    if isinstance(value, list | tuple | set | frozenset):
        return type(value), tuple(frozen(one, inner) for one in value)
    if callable(value) or (is_dataclass(value) and _hashable(value)):
        return value
    return (type(value), frozen(vars(value), inner)) if hasattr(value, "__dict__") else value


def _hashable(value: Any) -> bool:
    """Whether a value and all that it holds cannot change."""
    try:
        hash(value)
    except TypeError:
        return False
    return True

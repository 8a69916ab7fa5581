"""What a program computes and what probing finds: dictionaries whose changes go to the history."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


class Variables(dict[str, float]):
    """Q parameters and the like; every change is logged."""

    def __init__(self, machine: Machine) -> None:
        super().__init__()
        self._machine = machine

    def __setitem__(self, name: str, value: float) -> None:
        super().__setitem__(name, value)
        self._machine.log(name, value)


class Measured(dict[str, Any]):
    """What probing found; every value is logged."""

    def __init__(self, machine: Machine) -> None:
        super().__init__()
        self._machine = machine

    def __setitem__(self, name: str, value: Any) -> None:
        super().__setitem__(name, value)
        self._machine.log(f"measured {name}", value)

"""What a program computes and what probing finds: dictionaries whose changes go to the history."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Self

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


class Kept(dict[str, Any]):
    """Values by name, of a machine that hears of their changes."""

    def __init__(self, machine: Machine) -> None:
        super().__init__()
        self._machine = machine

    def copy(self) -> Self:
        """The same values, apart from those to come."""
        twin = type(self)(self._machine)
        dict.update(twin, self)
        vars(twin).update(vars(self))
        return twin


class Variables(Kept):
    """Q parameters and the like, numbers and texts; every change is logged.

    What the control itself keeps in a variable (`Control.preassigned`: the radius of the tool, …) is worked out when
    it is asked for.
    """

    def __init__(self, machine: Machine) -> None:
        super().__init__(machine)
        self.state_read = -1
        """The step at which the state of the machine was read last, in a variable that the control keeps or otherwise."""

    def __setitem__(self, name: str, value: Any) -> None:
        super().__setitem__(name, value)
        self._machine.log(name, value)

    def __missing__(self, name: str) -> Any:
        self.state_read = self._machine.step
        preassigned = self._machine.control.preassigned.get(name)
        value = None if preassigned is None else preassigned(self._machine)
        if value is None:
            raise KeyError(name)
        return value

    def forget(self, name: str) -> None:
        if name in self:
            self._machine.log(name, None)
            del self[name]

    @contextmanager
    def own_level(self) -> Iterator[None]:
        """Inside, the variables that are local to a program are others; afterwards those of before."""
        local = self._machine.control.local_variables
        if not local:
            yield
            return
        kept = {name: value for name, value in self.items() if name.startswith(local)}
        for name in kept:
            self.forget(name)
        yield
        for name in [name for name in self if name.startswith(local)]:
            self.forget(name)
        for name, value in kept.items():
            self[name] = value


    @contextmanager
    def own_values(self) -> Iterator[None]:
        """Inside, what is written to variables does not stay: they are a copy. After an alarm they are as they were there."""
        kept = dict(self)
        yield
        for name in [name for name in self if name not in kept]:
            self.forget(name)
        for name, value in kept.items():
            if name not in self or self[name] != value:
                self[name] = value


class Measured(Kept):
    """What probing found; every value is logged."""

    def __setitem__(self, name: str, value: Any) -> None:
        super().__setitem__(name, value)
        self._machine.log(f"measured {name}", value)

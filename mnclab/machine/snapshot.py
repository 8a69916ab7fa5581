"""A snapshot of attributes: a value that stays as it is, whatever becomes of what it was taken from.

`copied` gives what can change objects of its own and leaves what cannot as it is: numbers, texts, frozen dataclasses,
toolpaths. A class whose objects hold more than that has a method `copy`.
"""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from dataclasses import is_dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

from mnclab.path.toolpath import Toolpath

PLAIN = frozenset((str, int, float, bool, type(None)))
FIXED: tuple[type, ...] = (Toolpath, MappingProxyType)
HOLDERS = (list, set, frozenset)


class Snapshot:
    """Attributes by name, as they were; equal where all of them are."""

    __hash__ = None  # type: ignore[assignment]

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = {name: copied(value) for name, value in values.items()}

    def taken_out(self) -> dict[str, Any]:
        """The values once more, in objects that may change."""
        return {name: copied(value) for name, value in self._values.items()}

    def differences(self, other: Snapshot) -> list[str]:
        """The names whose values are not the same in another snapshot."""
        names = dict.fromkeys((*self._values, *other._values))
        both = self._values.keys() & other._values.keys()
        return [name for name in names if name not in both or not same(self._values[name], other._values[name])]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Snapshot) and not self.differences(other)

    def __repr__(self) -> str:
        return f"<Snapshot of {', '.join(self._values)}>"


def copied(value: Any) -> Any:
    """The same value, in objects of its own where it could change."""
    kind = type(value)
    if kind in PLAIN or isinstance(value, FIXED) or callable(value):
        return value
    if kind is dict:
        return {key: copied(one) for key, one in value.items()}
    if kind in HOLDERS:
        return kind(map(copied, value))
    if isinstance(value, tuple):
        if PLAIN.issuperset(map(type, value)):
            return value
        inner = map(copied, value)
        return kind(inner) if kind is tuple else kind(*inner)
    if hasattr(kind, "copy"):
        return value.copy()
    if is_dataclass(value) and kind.__dataclass_params__.frozen:
        return value
    twin = copy(value)
    for name, one in held(value).items():
        object.__setattr__(twin, name, copied(one))
    return twin


def held(value: Any) -> dict[str, Any]:
    """What an object holds by name, in its dictionary or its slots."""
    return {name: getattr(value, name) for name in (*getattr(value, "__dict__", ()), *getattr(value, "__slots__", ()))}


def same(one: Any, other: Any) -> bool:
    """Whether two values are equal down to what they hold; nan is equal to nan."""
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, float):
        return bool(one == other or (one != one and other != other))
    if isinstance(one, np.ndarray):
        return one.shape == other.shape and one.dtype == other.dtype and one.tobytes() == other.tobytes()
    inside = held(one)
    if callable(one) or not (inside or isinstance(one, dict | list | tuple)):
        return bool(one == other)
    if isinstance(one, dict) and not (list(one) == list(other) and all(map(same, one.values(), other.values()))):
        return False
    if isinstance(one, list | tuple) and not (len(one) == len(other) and all(map(same, one, other))):
        return False
    return all(same(value, getattr(other, name)) for name, value in inside.items())

"""How records print: as one would write them, or by the shapes of their columns; never their insides."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass
from typing import Any

import numpy as np


def written(record: Any) -> str:
    """A record as one would write it, without what is left at its default: `Tool(radius=5, kind='drill')`."""
    return _written(record, _value)


def exactly(record: Any) -> str:
    """The same with all digits of its numbers and of the records in it: read back by Python it is equal."""
    return _written(record, _exact)


def _written(record: Any, value_of: Callable[[Any], str]) -> str:
    said = [f"{name}={value_of(value)}" for name, value, default in _fields(record) if not _same(value, default)]
    return f"{type(record).__name__}({', '.join(said)})"


def shapes(record: Any) -> str:
    """A record of columns by their shapes: `<Pieces: t (9,), s (9,), v (9,)>`."""
    said = [f"{name} {np.shape(value)}" for name, value, _ in _fields(record) if isinstance(value, np.ndarray)]
    return f"<{type(record).__name__}: {', '.join(said)}>"


def _fields(record: Any) -> Iterator[tuple[str, Any, Any]]:
    """Name, value and default (`MISSING` without one) of each field of a dataclass or a named tuple."""
    if is_dataclass(record):
        for each in fields(record):
            default = each.default if each.default_factory is MISSING else each.default_factory()
            yield each.name, getattr(record, each.name), default
    else:
        for name in record._fields:
            yield name, getattr(record, name), record._field_defaults.get(name, MISSING)


def _same(value: Any, default: Any) -> bool:
    plain = type(value) in (int, float, str, bool, tuple, dict)
    return value is default or ((plain or is_dataclass(default) and type(value) is type(default)) and bool(value == default))


def _exact(value: Any) -> str:
    """A value with all its digits, records in it too."""
    if isinstance(value, float) and float(f"{value:.10g}") != value:
        return repr(float(value))
    nested = not isinstance(value, type) and (is_dataclass(value) or hasattr(value, "_fields"))
    return exactly(value) if nested else _value(value, _exact)


def _value(value: Any, inner: Callable[[Any], str] | None = None) -> str:
    """A value in short: whole numbers without a point, a mapping as a dict, a function by its name; `inner` writes parts."""
    inner = inner or _value
    if isinstance(value, float):
        return f"{value:.10g}"
    if isinstance(value, tuple) and not hasattr(value, "_fields"):
        return f"({', '.join(map(inner, value))}{',' * (len(value) == 1)})"
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{inner(key)}: {inner(each)}' for key, each in value.items())}}}"
    return getattr(value, "__name__", None) or repr(value)

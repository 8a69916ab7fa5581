"""Values written as TOML, so that they are read back equal: numbers to the last bit."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from numbers import Integral, Real
from typing import Any

BARE = re.compile(r"[A-Za-z0-9_-]+")


def value_text(value: Any) -> str:
    """A number, text, truth value, list or mapping in one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, Real):
        number = float(value)
        return str(int(number)) if number.is_integer() and abs(number) < 1e15 else repr(number)
    if isinstance(value, Mapping):
        pairs = (f"{_key(key)} = {value_text(each)}" for key, each in value.items())
        return f"{{ {', '.join(pairs)} }}" if value else "{}"
    return f"[{', '.join(map(value_text, value))}]"


def lines(table: Mapping[str, Any]) -> Iterator[str]:
    """A line for each key of a table; what is None is left out."""
    return (f"{_key(key)} = {value_text(value)}" for key, value in table.items() if value is not None)


def _key(name: str) -> str:
    return name if BARE.fullmatch(name) else value_text(name)

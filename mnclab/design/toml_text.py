"""Writing TOML: what `tomllib` reads back equal, in the order and the lines that people would write."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Mapping
from typing import Any

BARE = re.compile(r"[A-Za-z0-9_-]+")


def toml(table: Mapping[str, Any], rows: Collection[str] = ()) -> str:
    """A table as the text of a file: values first, then its tables, then its lists of tables, `[[name]]` each.

    The lists named in `rows` have a line for each of their tables instead.
    """
    values, tables, lists = list[str](), list[str](), list[str]()
    for name, value in table.items():
        if isinstance(value, Mapping):
            tables += ["", f"[{key(name)}]", *lines(value)]
        elif name in rows:
            values += [f"{key(name)} = [", *(f"    {of(each)}," for each in value), "]"]
        elif isinstance(value, list | tuple) and value and isinstance(value[0], Mapping):
            for each in value:
                lists += ["", f"[[{key(name)}]]", *lines(each)]
        else:
            values.append(f"{key(name)} = {of(value)}")
    return "\n".join([*values, *tables, *lists]).lstrip("\n") + "\n"


def lines(table: Mapping[str, Any]) -> list[str]:
    """A line for each key of a table; what is None is left out."""
    return [f"{key(name)} = {of(value)}" for name, value in table.items() if value is not None]


def key(name: str) -> str:
    """A key, in quotes where it needs them."""
    return name if BARE.fullmatch(name) else of(name)


def of(value: Any) -> str:
    """A number, a text, a list or a table as it is written in a line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007F")
    if isinstance(value, Mapping):
        return f"{{ {', '.join(lines(value))} }}" if value else "{}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(of, value))}]"
    number = float(value)
    return str(int(number)) if number == int(number) else repr(number)

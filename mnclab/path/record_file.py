"""Records from files (TOML): the fields of a tool, of limits, of whatever has fields."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from mnclab.path.wear import Wear
from mnclab.text.alarm import Alarm
from mnclab.text.file import File, as_table, check_names
from mnclab.text.given import check_number, shown

TEXTS = ("name", "kind", "hand", "corner_speed", "rapid_motion", "positioning", "axis")  # of a tool; of the limits; …


def record(kind: Any, value: Any, file: File, *keys: str) -> Any:
    """A Tool, Datum, Limits or Probe from a table of its fields; `keys` lead to it in the file."""
    where = ".".join(keys)
    with file.at(*keys):
        names = kind._fields if hasattr(kind, "_fields") else [field.name for field in fields(kind)]
        check_names(as_table(value, where), names, where, file, *keys)
        found = {name: _field(item) for name, item in value.items()}
        if "wear" in found:
            found["wear"] = record(Wear, value["wear"], file, *keys, "wear")
        for name, item in found.items():
            with file.at(*keys, name):
                _check_kind(value[name], f"{where}.{name}", name)
                kind(**{name: item})
        return kind(**found)


def _field(value: Any) -> Any:
    return tuple(map(_field, value)) if isinstance(value, list) else value


def _check_kind(value: Any, where: str, name: str) -> None:
    """An Alarm unless a field is a text where it must be one, else a number or a list of them."""
    if name in TEXTS and not isinstance(value, str):
        raise Alarm(f"{where} must be a text, got {shown(value)}")
    for each in value if isinstance(value, list) else [] if isinstance(value, bool) else [value]:
        if name not in (*TEXTS, "wear") and not isinstance(each, list):
            check_number(each, where, endless=True)

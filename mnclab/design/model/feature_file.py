"""Features in a file (TOML): a table each, its keys are those of the feature in Python.

A rectangle, a circle or points stand flat among them (`x`, `y`, `length`, `width`, `corner`, `turned`; `x`, `y`,
`diameter`; `points`, `bulge`, `closed`), or in a table `contour` of their own where a feature has a `width` itself.
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, TypeVar

from mnclab.design.model.design import TEXTS
from mnclab.design.model.shapes import Circle, Outline, Rectangle
from mnclab.text.alarm import Alarm, hint
from mnclab.text.file import File, as_table, as_tables, check_names
from mnclab.text.given import shown

SHAPES: tuple[type[Any], ...] = (Circle, Outline, Rectangle)
RECTANGLE = "{ x = 30, y = 20, length = 40, width = 25 }"
Kind = TypeVar("Kind")


def texts_of(table: Mapping[str, Any], file: File) -> dict[str, str]:
    """What the table of a design says for its title block."""
    for name in TEXTS:
        with file.at(name):
            if not isinstance(table.get(name, ""), str):
                raise Alarm(f"the {name} of a design must be a text, got {shown(table[name])}")
    return {name: table[name] for name in TEXTS if name in table}


def features_of(table: Mapping[str, Any], side: str, kinds: Mapping[str, type[Kind]], file: File) -> tuple[Kind, ...]:
    """The features of a side of a design, of some kinds by their names."""
    with file.at(side):
        tables = as_tables(table.get(side, []), side)
        return tuple(feature_of(each, kinds, file, side, str(k)) for k, each in enumerate(tables))


@contextmanager
def pointing_at_features(table: Mapping[str, Any], file: File) -> Iterator[None]:
    """Alarms that name a feature of a design by its side and number show it, or the key of it that they name first."""
    try:
        yield
    except Alarm as alarm:
        if found := re.search(r"\((\w+)\[(\d+)\]\)", alarm.message):
            side, k = found.groups()
            with pointing(file, {name: None for name in table[side][int(k)] if name != "kind"}, side, k):
                raise
        raise


def feature_of(table: Any, kinds: Mapping[str, type[Kind]], file: File, *keys: str) -> Kind:
    """The feature that a table writes, one of some kinds by their names; `keys` lead to it in the file."""
    where = f"{keys[0]}[{keys[1]}]"
    with file.at(*keys):
        table = dict(as_table(table, where))
        kind = table.pop("kind", None)
        if kind is None:
            raise Alarm(f"{where} has no kind", hint=f"known: {', '.join(kinds)}")
        if not isinstance(kind, str) or kind not in kinds:
            with file.at(*keys, "kind"):
                near = hint(kind[:40], kinds, 1) if isinstance(kind, str) else ""
                raise Alarm(f"the kind of {where} must be one of {', '.join(kinds)}, got {shown(kind)}", hint=near)
        what = kind if not isinstance(table.get("name"), str) else f"{kind} {shown(table['name'])}"
        return record_of(kinds[kind], table, what, file, *keys)


def record_of(kind: type[Kind], table: dict[str, Any], what: str, file: File, *keys: str) -> Kind:
    """A record of a dataclass from a table of its fields; shapes in it are read too."""
    names, flat = names_of(kind), flat_of(kind)
    if flat and "contour" not in table:
        check_names(table, [name for name in names if name != "contour"] + list(flat), f"a {what}", file, *keys)
        shape = {name: table.pop(name) for name in flat if name in table}
        if not shape:
            raise Alarm(f"a {what} has no contour", hint="a circle: x, y, diameter; a rectangle: x, y, length, width; or points")
        if "length" in shape and "width" in names:
            raise Alarm(f"the rectangle of a {what}, which has a width itself, stands in a table", hint=f"contour = {RECTANGLE}")
        table["contour"] = shape_of_table(shape, what, file, *keys)
    check_names(table, names, f"a {what}", file, *keys)
    for name in ("contour", "islands"):
        if name in table and not isinstance(table[name], SHAPES):
            with file.at(*keys, name):
                table[name] = _shapes(table[name], f"the {name} of a {what}", file, *keys, name)
    given = {name: tuples(value) for name, value in table.items()}
    needed = [each.name for each in fields(kind) if each.default is MISSING and each.default_factory is MISSING]  # type: ignore[arg-type]
    if missing := [name for name in needed if name not in given]:
        raise Alarm(f"a {what} has no {missing[0]}", hint=f"it needs {', '.join(needed)}")
    with pointing(file, given, *keys):
        return kind(**given)


def names_of(kind: type[Any]) -> list[str]:
    """The keys that a feature has in a file."""
    return [each.name for each in fields(kind)]


def flat_of(kind: type[Any]) -> list[str]:
    """The keys of its contour that may stand among its own."""
    own = names_of(kind)
    if "contour" not in own:
        return []
    return list(dict.fromkeys(name for shape in SHAPES for name in names_of(shape) if name not in own))


def shape_of_table(table: dict[str, Any], what: str, file: File, *keys: str) -> Any:
    """A circle, where a table has a diameter; an outline, where it has points; else a rectangle."""
    kind = Circle if "diameter" in table else Outline if "points" in table else Rectangle
    return record_of(kind, table, f"{what} as a {kind.__name__.lower()}", file, *keys)


def _shapes(value: Any, where: str, file: File, *keys: str) -> Any:
    """A table, or a list of tables, as shapes."""
    if isinstance(value, list):
        return tuple(_shapes(each, where, file, *keys) for each in value)
    if not isinstance(value, dict):
        raise Alarm(f"{where} must be a table, got {shown(value)}", hint=RECTANGLE)
    return shape_of_table(dict(value), where.removeprefix("the contour of a "), file, *keys)


@contextmanager
def pointing(file: File, table: Mapping[str, Any], *keys: str) -> Iterator[None]:
    """Alarms about a table show the key that they name first, else the table."""
    try:
        yield
    except Alarm as alarm:
        places = {name: re.search(rf"\b{re.escape(name.rstrip('s'))}", alarm.message) for name in table}
        named = sorted((found.start(), name) for name, found in places.items() if found)
        alarm.span = alarm.span or file.place_of(*keys, *(name for _, name in named[:1]))
        raise


def tuples(value: Any) -> Any:
    """Lists as tuples, all the way down."""
    if isinstance(value, list):
        return tuple(map(tuples, value))
    return {name: tuples(each) for name, each in value.items()} if isinstance(value, dict) else value


def table_of_feature(feature: Any) -> dict[str, Any]:
    """What a file writes of a feature: its kind, its name, and what is not left at its default."""
    table = {"kind": feature.kind, "name": feature.name or None}
    for name, value in _said(feature).items():
        if name == "contour" and (shape := _said(value)).keys() <= set(flat_of(type(feature))):
            table |= shape
        else:
            table[name] = _plain(value)
    return table


def _said(record: Any) -> dict[str, Any]:
    """The fields of a record that are not at their defaults."""
    found = {}
    for each in fields(record):
        default = each.default if each.default_factory is MISSING else each.default_factory()
        value = getattr(record, each.name)
        if value is not default and not (type(value) is type(default) and value == default):
            found[each.name] = value
    return found


def _plain(value: Any) -> Any:
    """Shapes as tables, all the way down."""
    if is_dataclass(value):
        return _said(value)
    return tuple(map(_plain, value)) if isinstance(value, tuple | list) else value


# Writing TOML: what `tomllib` reads back equal, in the order and the lines that people would write.

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

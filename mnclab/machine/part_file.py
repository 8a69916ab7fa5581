"""The part that a probe touches, as a setup file says it: a box, the part of a design, or a mesh, put somewhere with errors."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown
from mnclab.text.opening import opened
from mnclab.text.toml_file import File, as_table, check_names
from mnclab.workpiece.blank_file import point_of
from mnclab.workpiece.part import Part, box, mesh

BODIES = ("box", "design", "mesh")
ERRORS = ("taper", "bow", "bowed", "roughness", "grain", "seed", "burr")


def part_of(given: Any, name: str, file: File) -> Any:
    """`"cut"` as it is; a table as a Part: its body, `turned` about Z by degrees, then with its zero point `at` a place, mm."""
    if isinstance(given, str):
        return given
    table = as_table(given, name)
    check_names(table, (*BODIES, "turned", "at", "errors"), name, file, name)
    bodies = [each for each in BODIES if each in table]
    if len(bodies) != 1:
        raise Alarm(f"{name} needs one of {', '.join(BODIES)}, got {' and '.join(bodies) or 'none'}")
    with file.at(name, bodies[0]):
        found = _body(table[bodies[0]], bodies[0], file)
    if "errors" in table:
        found = _with_errors(found, table["errors"], file, name)
    with file.at(name, "turned" if "turned" in table else bodies[0]):
        check_number(table.get("turned", 0.0), f"{name}.turned")
        found = found.turned(table.get("turned", 0.0))
    if "at" in table:
        with file.at(name, "at"):
            found = found.shifted(*point_of(table["at"], f"{name}.at"))
    return found


def _body(given: Any, kind: str, file: File) -> Part:
    if kind == "box":
        if not isinstance(given, list) or len(given) != 2:
            raise Alarm(f"part.box must be two corners, got {shown(given)}", hint="box = [[0, 0, -20], [100, 60, 0]]")
        low, high = (point_of(each, "a corner of part.box") for each in given)
        return box(low, high)
    if not isinstance(given, str):
        raise Alarm(f"part.{kind} must be the name of a file, got {shown(given)}")
    path = Path(file.name).parent / given
    if kind == "mesh":
        return mesh(path)
    return opened("mnclab.design.model", "Design").load(path).part


def _with_errors(part: Part, given: Any, file: File, name: str) -> Part:
    with file.at(name, "errors"):
        errors: Mapping[str, Any] = as_table(given, f"{name}.errors")
        check_names(errors, ERRORS, f"{name}.errors", file, name, "errors")
        return part.with_errors(**{key: tuple(each) if isinstance(each, list) else each for key, each in errors.items()})

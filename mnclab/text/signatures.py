"""What is given to a function, judged by its own signature: each value by the annotation of its parameter.

The annotations are what editors and mypy read, so nothing is said twice. They are texts, as the house writes them: "float",
"int | None", "tuple[float, float]", "ArrayLike", the name of a class. A name that only type checkers know is not judged.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import lru_cache
from inspect import Parameter, isclass, signature, unwrap
from types import UnionType
from typing import Any

import numpy as np

from mnclab.text.alarm import Refused
from mnclab.text.given import LARGEST, SMALLEST, is_number, shown

#: Annotations of numbers in arrays of whatever shape.
ARRAYS = ("ArrayLike", "Array", "Floats", "Vector", "Points", "Matrix")
SEQUENCES = ("Sequence", "Iterable", "tuple", "list")
#: Plain annotations -> what such a value is called.
CALLED = {
    "float": "a number", "int": "a whole number", "bool": "True or False", "str": "a text", "Path": "a path", "None": "None",
    "Callable": "a function", "Mapping": "a mapping", "dict": "a mapping",
}  # fmt: skip


def judge(door: Callable[..., Any], given: tuple[Any, ...], options: Mapping[str, Any]) -> None:
    """An Alarm for the first value that is not what the signature of a function says."""
    what = door.__qualname__.removesuffix(".__init__").rpartition(".")[2]
    takes = signature(door).parameters
    try:
        bound = signature(door).bind(*given, **options).arguments
    except TypeError:  # a call that does not fit, of which Python knows more
        return
    for name, value in bound.items():
        each = takes[name]
        values = [value]
        if each.kind in (Parameter.VAR_POSITIONAL, Parameter.VAR_KEYWORD):
            values = [*value.values()] if each.kind == Parameter.VAR_KEYWORD else list(value)
        if name in ("self", "cls") or not isinstance(each.annotation, str):
            continue
        for one in values:
            if one is not each.default and (fault := _fault(one, each.annotation, door, each.default)):
                raise Refused(f"{what}: {name} must be {fault}, got {shown(one)}")


def _fault(value: Any, annotation: str, door: Callable[..., Any], default: Any) -> str:
    """What a value must be and is not, in words; empty where it is right, or nobody can tell."""
    faults = [_alone(value, each, door, default) for each in parts(annotation, "|")]
    if "" in faults:
        return ""
    return " or ".join(dict.fromkeys(faults))


def _alone(value: Any, annotation: str, door: Callable[..., Any], default: Any) -> str:
    """The same of an annotation without alternatives."""
    head, _, inner = annotation.partition("[")
    if head in ("float", "int"):
        return _number(value, head == "int", default)
    if head in ARRAYS:
        return _array(value)
    if head == "str":
        return "" if isinstance(value, str) else CALLED[head]
    if head == "bool":
        return "" if isinstance(value, bool | np.bool_) else CALLED[head]
    if head == "None":
        return "" if value is None else "None"
    if head in ("Mapping", "dict"):
        return "" if isinstance(value, Mapping) else CALLED[head]
    if head == "Callable":
        return "" if callable(value) else CALLED[head]
    if head in SEQUENCES:
        return _several(value, parts(inner.removesuffix("]"), ","), head, door)
    kind = _class(head, door)
    return "" if kind is None or isinstance(value, kind) else CALLED.get(head, f"of the kind {head}")


def _number(value: Any, whole: bool, default: Any) -> str:
    if not is_number(value):
        return CALLED["int" if whole else "float"]
    try:
        size = abs(float(value))
    except OverflowError:  # a whole number of some hundred digits
        return f"a finite number of at most {LARGEST:g}"
    if whole and size != size // 1:
        return CALLED["int"]
    if size == np.inf and isinstance(default, float) and default == np.inf:
        return ""
    if not size <= LARGEST:
        return f"a finite number of at most {LARGEST:g}"
    return f"0, or a number of at least {SMALLEST:g}" if 0 < size < SMALLEST else ""


def _array(value: Any) -> str:
    try:
        numbers = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        return "numbers"
    if isinstance(value, str | bytes) or value is None:  # of which numpy makes a number
        return "numbers"
    if not (np.abs(numbers) <= LARGEST).all():
        return f"finite numbers, none beyond {LARGEST:g}"
    return f"0, or numbers of at least {SMALLEST:g}" if ((numbers != 0) & (np.abs(numbers) < SMALLEST)).any() else ""


def _several(value: Any, inner: list[str], head: str, door: Callable[..., Any]) -> str:
    """A sequence: of one kind of things, or as many as are named."""
    if isinstance(value, str | Mapping) or not isinstance(value, Iterable):
        return "a sequence"
    if isinstance(value, Iterator) or not inner:
        return ""
    things = list(value)
    if head == "tuple" and inner[-1] != "...":
        if len(things) != len(inner):
            return f"{len(inner)} values"
    else:
        inner = inner[:1] * len(things)
    for thing, annotation in zip(things, inner):
        if fault := _fault(thing, annotation, door, None):
            return f"a sequence whose values are each {fault}"
    return ""


def _class(name: str, door: Callable[..., Any]) -> Any:
    """The class of a name in the file of a function, or several in one name; None where it is none there."""
    found = getattr(sys.modules.get(unwrap(door).__module__), name, None)
    if isinstance(found, UnionType):
        return found if all(map(isclass, found.__args__)) else None
    return found if isclass(found) and found is not Any and not getattr(found, "_is_protocol", False) else None


@lru_cache(1024)
def parts(annotation: str, sign: str) -> list[str]:
    """The parts of an annotation between signs that stand in no bracket."""
    found, depth = [""], 0
    for letter in annotation:
        depth += (letter == "[") - (letter == "]")
        if letter == sign and not depth:
            found.append("")
        else:
            found[-1] += letter
    return [each.strip() for each in found if each.strip()]

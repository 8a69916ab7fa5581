"""What a user gives, in Python or in a file, is checked where it is given: numbers, and how the rest is quoted."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from numbers import Real
from reprlib import Repr
from typing import Any

from mnclab.text.alarm import Alarm
from mnclab.text.nearest import hint

#: No coordinate, feed, speed or other number is as large, whether it is written or worked out.
LARGEST = 1e9
_QUOTED = Repr()
_QUOTED.maxstring = _QUOTED.maxother = 60


def shown(value: Any) -> str:
    """A value as an alarm quotes it: never long, however deep or large it is."""
    return _QUOTED.repr(value)


def check_number(
    value: Any, what: str, *, above: float | None = None, at_least: float | None = None, at_most: float | None = None,
    endless: bool = False,
) -> None:  # fmt: skip
    """An Alarm unless `value` is a number within its limits; infinity is one where it is `endless`."""
    if type(value) is not float and (isinstance(value, bool) or not isinstance(value, Real)):  # Real is asked slowly
        raise Alarm(f"{what} must be a number, got {shown(value)}")
    try:
        size = float(value)
    except OverflowError:  # a whole number of some hundred digits
        size = math.inf
    if math.isnan(size) or (math.isinf(size) and not endless):
        raise Alarm(f"{what} must be a finite number, got {size:g}")
    if above is not None and not size > above:
        raise Alarm(f"{what} must be greater than {above:g}, got {size:g}")
    if at_least is not None and not size >= at_least:
        raise Alarm(f"{what} must be at least {at_least:g}, got {size:g}")
    if at_most is not None and not size <= at_most and not (math.isinf(size) and endless):
        raise Alarm(f"{what} must be at most {at_most:g}, got {size:g}")


def whole(value: Any, what: str) -> int:
    """A number as a whole one; an Alarm unless it is."""
    check_number(value, what)
    if value != int(value):
        raise Alarm(f"{what} must be a whole number, got {shown(value)}")
    return int(value)


def either(one: Any, other: Any, name: str, other_name: str, turned: Callable[[float], float]) -> Any:
    """What is given under one name or, as another measure of the same, under another; an Alarm for both or neither."""
    if (one is None) == (other is None):
        raise Alarm(f"give {name} or {other_name}, {'not both' if one is not None else 'one of them'}")
    if one is not None:
        return one
    check_number(other, f"the {other_name}")
    return turned(other)


def choice(value: Any, what: str, known: Collection[str]) -> str:
    """The one of some names that is meant, in any case of letters; an Alarm names them all."""
    found = {name.lower(): name for name in known}
    if isinstance(value, str) and value.lower() in found:
        return found[value.lower()]
    *others, last = known
    near = hint(value[:40], known, 1) if isinstance(value, str) else ""
    raise Alarm(f"{what} must be {', '.join(others)} or {last}, got {shown(value)}", hint=near)


@contextmanager
def faults_as_alarms() -> Iterator[None]:
    """What a function of numbers refuses by a ValueError is an Alarm to whoever called it through a door."""
    try:
        yield
    except ValueError as error:
        raise Alarm(str(error)) from None


def plain(value: Any) -> Any:
    """A number of another kind (a fraction, one of numpy) as Python's float; lists of numbers as tuples."""
    if isinstance(value, tuple | list):
        return tuple(map(plain, value))
    return float(value) if isinstance(value, Real) and not isinstance(value, int | float) else value


def check_point(value: Any, what: str, *, flat: bool = False) -> None:
    """An Alarm unless `value` is three numbers, or two in a `flat` figure."""
    try:
        right = not isinstance(value, str | Mapping) and len(value) == 3 - flat
    except TypeError:  # of what has no length
        right = False
    if not right:
        raise Alarm(f"{what} must be {'two numbers (x, y)' if flat else 'three numbers (x, y, z)'}, got {shown(value)}")
    for each in value:
        check_number(each, what)

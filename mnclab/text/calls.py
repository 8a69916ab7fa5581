"""A call that does not fit a function (an option it does not have, a value it needs) is an Alarm that says what it takes."""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import wraps
from inspect import Parameter, isfunction, signature
from typing import Any, TypeVar

from mnclab.text.alarm import Alarm
from mnclab.text.nearest import hint

#: What is often typed, and how it is called here.
MEANT = {
    "machine": "limits", "blank": "stock", "chuck": "fixtures", "magazine": "tools", "tol": "tolerance", "dia": "diameter",
    "d": "diameter", "r": "radius", "type": "kind", "z": "teeth", "flutes": "teeth", "figsize": "size", "width": "size_mm",
    "height": "size_mm", "width_mm": "size_mm", "dpi": "size_mm", "color": "colour", "v": "vc", "f": "fz",
}  # fmt: skip
EXAMPLES = {"size_mm": "size_mm=(85, None)", "limits": 'limits="small-mill"'}

Door = TypeVar("Door", bound=Callable[..., Any])
Made = TypeVar("Made", bound=type)


def near_option(name: str, known: Collection[str]) -> str:
    """The option that is meant by one that is not known, as a hint; all of them where none is near."""
    meant = MEANT.get(name.lower(), "")
    return f"write {EXAMPLES.get(meant, meant)}" if meant in known else hint(name, known) or f"it takes {', '.join(known)}"


def fitting(door: Door) -> Door:
    """A function whose wrong calls are Alarms; calls that fit are as fast as before."""

    @wraps(door)
    def called(*given: Any, **options: Any) -> Any:
        try:
            return door(*given, **options)
        except TypeError:
            _check(door, given, options)
            raise

    return called  # type: ignore[return-value]


def fitting_class(made: Made) -> Made:
    """A class that is made, and whose own public methods are called, in this way."""
    for name, door in list(vars(made).items()):
        if isfunction(door) and (name == "__init__" or not name.startswith("_")):
            setattr(made, name, fitting(door))
    return made


def _check(door: Callable[..., Any], given: tuple[Any, ...], options: dict[str, Any]) -> None:
    """An Alarm where a call does not fit; nothing where the fault is another."""
    takes = {name: each for name, each in signature(door).parameters.items() if name != "self"}
    free = any(each.kind == Parameter.VAR_KEYWORD for each in takes.values())
    named = [n for n, each in takes.items() if each.kind in (Parameter.POSITIONAL_OR_KEYWORD, Parameter.KEYWORD_ONLY)]
    what = door.__qualname__.removesuffix(".__init__").rpartition(".")[2]
    for name in options:
        if name not in named and not free:
            raise Alarm(f"{what} has no option {name!r}", hint=near_option(name, named) if named else "it takes none")
    try:
        signature(door).bind(*given, **options)
    except TypeError as error:
        written = ", ".join(name if each.default is Parameter.empty else f"{name}=…" for name, each in takes.items())
        raise Alarm(f"{what}: {error}", hint=f"{what}({written})") from None

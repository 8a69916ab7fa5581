"""What a user gives, in Python or in a file, is checked where it is given: numbers, and how the rest is quoted."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import wraps
from inspect import Parameter, Signature, isfunction, signature
from numbers import Real
from reprlib import Repr
from typing import TYPE_CHECKING, Any, TypedDict, TypeVar

import numpy as np

from mnclab.text.alarm import Absent, Alarm, Refused, hint

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: No coordinate, feed, speed or other number is as large, whether it is written or worked out.
LARGEST = 1e9
#: Nor is one that is not 0 as small: its square would be none any more.
SMALLEST = 1e-150
#: How a call fails whose values are not what the function takes.
FAULTS = (TypeError, ValueError, ArithmeticError, AttributeError, LookupError)
_QUOTED = Repr()
_QUOTED.maxstring = _QUOTED.maxother = 60


def shown(value: Any) -> str:
    """A value as an alarm quotes it: never long, however deep or large it is."""
    return _QUOTED.repr(value)


def is_number(value: Any) -> bool:
    """Whether a value is a number, of Python or of numpy, there as an array without axes too; True and False are none."""
    if isinstance(value, np.ndarray):
        return not value.ndim and value.dtype.kind in "iuf"
    return isinstance(value, Real) and not isinstance(value, bool)


def check_number(
    value: Any, what: str, *, above: float | None = None, at_least: float | None = None, at_most: float | None = None,
    endless: bool = False,
) -> None:  # fmt: skip
    """An Alarm unless `value` is a number within its limits; infinity is one where it is `endless`."""
    if type(value) is not float and not is_number(value):  # which asks slowly
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


def of_python(value: Any) -> Any:
    """An array or a truth value of numpy as Python has it: a number, a list, True or False; all else as it is."""
    return value.tolist() if isinstance(value, np.ndarray | np.bool_) else value


def plain(value: Any) -> Any:
    """A number of another kind (a fraction, one of numpy) as Python's float; lists and arrays of numbers as tuples."""
    value = of_python(value)
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


# The options of pictures, which the doors to them hand on: `run.plot(**options: Unpack[RunOptions])`. Type checkers read them
# here, and so does Tab in a notebook (`fitting` writes them into the signature). The defaults are those of what draws. What is
# of a floor above, such as a path or a part, is Any here.

class FigureOptions(TypedDict, total=False):
    """Of every figure: `size` "a4", "column", "slide" or inches, `size_mm` (85, None), `legend`, `title`."""

    size: str | tuple[float, float] | None
    size_mm: tuple[float, float | None] | None
    legend: bool
    title: str | None


class AxesOptions(FigureOptions, total=False):
    """What can be drawn into axes of one's own, too."""

    ax: Axes | None


class OnlyPathOptions(AxesOptions, total=False):
    """Of a path, with a blank and a part or without; see `show.plot.path.plot_path`."""

    view: str
    colour: str
    arrows: bool
    marks: bool
    frame: str
    programmed: Any
    alarms: Sequence[Alarm]
    places: Sequence[Any]
    tools: Mapping[int, Any]
    insert: bool | int
    home: bool
    felt: Any
    gouged: Any
    rapids: Any
    under: Any
    limits: Any
    overlays: Sequence[Any]
    band: bool | None


class PathOptions(OnlyPathOptions, total=False):
    """Of a path, with the blank and the part as they are."""

    stock: Any
    part: Any


class RunOptions(OnlyPathOptions, total=False):
    """Of a run, which knows its blank and its part; see `show.plot.path.plot_run`."""

    stock: bool
    part: bool
    probed: bool
    centres: bool | None
    original: bool
    holes: bool
    fixtures: bool


class RunFileOptions(RunOptions, total=False):
    """Of a run as a file: an svg in true millimetres, bodies `of` the "part" or the "path"."""

    true_size: bool
    of: str


class SectionOptions(AxesOptions, total=False):
    """Planes of sections, and where they lie, mm."""

    section: str | Sequence[str]
    at: float | Sequence[float] | None


class PartOptions(SectionOptions, total=False):
    """See `show.plot.part.plot_part`."""

    colour: str
    collisions: Iterable[Any]


class DifferenceOptions(SectionOptions, total=False):
    """See `design.difference.plot.plot_difference`."""

    table: bool
    limit: float | None


class ProfileOptions(AxesOptions, total=False):
    """See `show.plot.profile.plot_profile`."""

    over: str
    axes: bool
    limits: bool
    whole: bool
    under: Any
    held: Any


class LostOptions(AxesOptions, total=False):
    """How many lines, and the width in inches."""

    most: int
    width: float


class MeasuredOptions(FigureOptions, total=False):
    """See `show.plot.measured.plot_measured`."""

    line: int | None
    factor: float | None
    part: bool
    width: float
    height: float | None


class CompensationOptions(AxesOptions, total=False):
    """See `show.plot.compensation.compensation`."""

    rules: Sequence[str] | None
    radii: Sequence[float] | None
    discs: bool | float | Sequence[int]
    vectors: bool
    names: bool
    stock: bool
    view: str
    under: Any
    limits: Any


class WidthOptions(FigureOptions, total=False):
    """The width in inches."""

    width: float


class ColumnsOptions(WidthOptions, total=False):
    """How many views stand in a row."""

    columns: int | None


class BodyOptions(TypedDict, total=False):
    """Of a body in three dimensions; `size` in pixels."""

    axes: bool
    size: tuple[int, int]


class PartBodyOptions(BodyOptions, total=False):
    """Of a part."""

    collisions: Iterable[Any]


class SceneOptions(BodyOptions, total=False):
    """Of a run; see `show.scene.scene`."""

    row: int
    tool: bool
    stock: Any
    part: bool
    probed: bool


class PlayerOptions(TypedDict, total=False):
    """Height in pixels; see `show.player.page.Player`."""

    height: int | None
    theme: str
    speed: float


class DrawingOptions(TypedDict, total=False):
    """Of a dimensioned drawing: `size` "A4", "A4 landscape", "A3" or "A2", `scale` 0.5 for 1:2."""

    size: str | None
    scale: float | None
    sheet: int
    title: str | None


class DesignFileOptions(DrawingOptions, total=False):
    """Of a design as a file: `step` mm of the cells of its body."""

    step: float | None


def _written_out(door: Callable[..., Any], kind: str) -> Signature:
    """The signature of a door with the options of a kind, "Unpack[RunOptions]", that it hands on."""
    takes = signature(door)
    *own, _ = takes.parameters.values()
    names = globals()[kind.removeprefix("Unpack[").removesuffix("]")].__annotations__
    options = [Parameter(name, Parameter.KEYWORD_ONLY, default=..., annotation=each.__forward_arg__)
               for name, each in names.items() if name not in takes.parameters]  # fmt: skip
    return takes.replace(parameters=[*own, *options])


# A call that does not fit a function (an option it does not have, a value it needs) is an Alarm that says what it takes.

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
        except Alarm:
            raise
        except FAULTS:  # an Alarm if the call is at fault; what else it was goes on as it is
            _check(door, given, options)
            raise

    if "Unpack" in (kind := str(door.__annotations__.get("options"))):
        called.__signature__ = _written_out(door, kind)  # type: ignore[attr-defined]
    return called  # type: ignore[return-value]


def refusing(door: Door) -> Door:
    """The same of a function of numbers alone: what it refuses by a ValueError, or cannot work out, is an Alarm too."""
    fits = fitting(door)

    @wraps(door)
    def called(*given: Any, **options: Any) -> Any:
        try:
            return fits(*given, **options)
        except Alarm:
            raise
        except FAULTS as error:
            if (told := _told(error, _name(door))) is None:
                raise
            raise told from error

    return called  # type: ignore[return-value]


def checked(door: Door) -> Door:
    """The same of a function that people call and the house does not: what it is given is judged before it works."""
    fits = refusing(door)

    @wraps(door)
    def called(*given: Any, **options: Any) -> Any:
        _judge(door, given, options)
        return fits(*given, **options)

    return called  # type: ignore[return-value]


def fitting_class(made: Made) -> Made:
    """A class that is made, and whose own public methods are called, in this way."""
    return _with_methods(made, fitting)


def refusing_class(made: Made) -> Made:
    """The same of a class of numbers alone."""
    return _with_methods(made, refusing)


def _with_methods(made: Made, way: Callable[[Any], Any]) -> Made:
    for name, door in list(vars(made).items()):
        if name in ("__init__", "__getitem__") or not name.startswith("_"):
            if isfunction(door):
                setattr(made, name, way(door))
            elif isinstance(door, classmethod):
                setattr(made, name, classmethod(way(door.__func__)))
    return made


def _check(door: Callable[..., Any], given: tuple[Any, ...], options: dict[str, Any]) -> None:
    """An Alarm where a call does not fit, or a value is not what the signature says; nothing where the fault is another."""
    takes = {name: each for name, each in signature(door).parameters.items() if name != "self"}
    free = any(each.kind == Parameter.VAR_KEYWORD for each in takes.values())
    named = [n for n, each in takes.items() if each.kind in (Parameter.POSITIONAL_OR_KEYWORD, Parameter.KEYWORD_ONLY)]
    what = _name(door)
    for name in options:
        if name not in named and not free:
            raise Alarm(f"{what} has no option {name!r}", hint=near_option(name, named) if named else "it takes none")
    try:
        signature(door).bind(*given, **options)
    except TypeError as error:
        written = ", ".join(name if each.default is Parameter.empty else f"{name}=…" for name, each in takes.items())
        raise Alarm(f"{what}: {error}", hint=f"{what}({written})") from None
    _judge(door, given, options)


def _judge(door: Callable[..., Any], given: tuple[Any, ...], options: dict[str, Any]) -> None:
    from mnclab.text.signatures import judge  # which quotes values as this file does

    judge(door, given, options)


def _told(error: Exception, what: str) -> Alarm | None:
    """The alarm that a fault of values is; None for one that may be ours."""
    if type(error) in (ValueError, np.linalg.LinAlgError):
        return Refused(str(error))
    if isinstance(error, ArithmeticError):
        return Refused(f"{what}: {error}")
    return Absent(f"{what}: {error}") if type(error) in (IndexError, KeyError, LookupError) else None


def _name(door: Callable[..., Any]) -> str:
    return door.__qualname__.removesuffix(".__init__").removesuffix(".__getitem__").rpartition(".")[2]

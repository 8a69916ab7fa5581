"""Two runs, or two paths, laid over one another.

A run is known here by what is compared of it: its path, its name and its time.
"""

from __future__ import annotations

from typing import Any, Protocol, overload, runtime_checkable

from mnclab.comparison.deviation import Deviation, deviation
from mnclab.comparison.holes import TOLERANCE, HolesCompared, compare_holes
from mnclab.path.holes import Holes, holes
from mnclab.path.limits import Limits
from mnclab.path.profile import Profile
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, choice, fitting, shown


@runtime_checkable
class Ran(Protocol):
    """A run."""

    toolpath: Toolpath
    program: Any
    control: Any
    reach: str
    rapids: Limits

    def holes(self) -> Holes:
        """What is drilled."""

    def profile(self) -> Profile:
        """When the tool is where, under the limits of its setup."""


@overload
def diff(one: Ran | Toolpath, other: Ran | Toolpath, step: float | None = None) -> Deviation: ...


@overload
def diff(
    one: Ran | Toolpath, other: Ran | Toolpath, step: float | None = None, *, what: str, tolerance: float = TOLERANCE
) -> Deviation | HolesCompared: ...


@fitting
def diff(
    one: Ran | Toolpath, other: Ran | Toolpath, step: float | None = None, *, what: str = "path", tolerance: float = TOLERANCE
) -> Deviation | HolesCompared:
    """Two runs, or two paths, laid over one another: the largest deviation (mm) and where; `.plot()` shows both.

    Two programs, two controls, two tool radii, two limits (of their setups: the times differ); `step` mm is how
    closely the paths are looked at. With `what="holes"` their holes (see `path.holes`) are compared instead, whatever the
    order and the heights: places and diameters within `tolerance` mm; `.same` says whether they are the same.
    """
    for each in (one, other):
        if not isinstance(each, Ran | Toolpath):
            raise Alarm(f"two runs or two paths can be compared, got {shown(each)}", hint="diff(run(…), run(…))")
    check_number(tolerance, "the tolerance (mm)", at_least=0)
    if choice(what, "what", ("path", "holes")) == "holes":
        found = [holes(each) if isinstance(each, Toolpath) else each.holes() for each in (one, other)]
        return compare_holes(found[0], found[1], _names(one, other), tolerance)
    times = None
    if not isinstance(one, Toolpath) and not isinstance(other, Toolpath):
        times = one.profile().time, other.profile().time
    paths = [each if isinstance(each, Toolpath) else each.toolpath for each in (one, other)]
    reaches, rapids = (_reach(one), _reach(other)), (_rapids(one), _rapids(other))
    return deviation(paths[0], paths[1], _names(one, other), step, times=times, reaches=reaches, rapids=rapids)


def _rapids(one: Ran | Toolpath) -> Limits | None:
    """How the rapids of a run go; nobody knows it of a path."""
    return None if isinstance(one, Toolpath) else one.rapids


def _reach(one: Ran | Toolpath) -> str:
    """How far a run went that stopped before its end."""
    return "" if isinstance(one, Toolpath) else one.reach


def _names(one: Ran | Toolpath, other: Ran | Toolpath) -> tuple[str, str]:
    """What both are called: their programs, and where these are called alike, their controls or their order too."""
    first, second = ("path" if isinstance(each, Toolpath) else str(each.program.title) for each in (one, other))
    if first != second:
        return first, second
    marks = ["" if isinstance(each, Toolpath) else each.control.name for each in (one, other)]
    marks = ["first", "second"] if marks[0] == marks[1] else marks
    return f"the {marks[0]} {first}", f"the {marks[1]} {second}"

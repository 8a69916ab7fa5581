"""Two runs, or two paths, laid over one another.

A run is known here by what is compared of it: its path, its name and its time.
"""

from __future__ import annotations

from typing import Any, Protocol, runtime_checkable

from mnclab.comparison.deviation import Deviation, deviation
from mnclab.path.profile import Profile
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown


@runtime_checkable
class Ran(Protocol):
    """A run."""

    toolpath: Toolpath
    program: Any
    control: Any

    def profile(self) -> Profile:
        """When the tool is where, under the limits of its setup."""


def diff(one: Ran | Toolpath, other: Ran | Toolpath, step: float | None = None) -> Deviation:
    """Two runs, or two paths, laid over one another: the largest deviation (mm) and where; `.plot()` shows both.

    Two programs, two controls, two tool radii, two limits (of their setups: the times differ); `step` mm is how
    closely the paths are looked at.
    """
    for each in (one, other):
        if not isinstance(each, Ran | Toolpath):
            raise Alarm(f"two runs or two paths can be compared, got {shown(each)}", hint="diff(run(…), run(…))")
    times = None
    if not isinstance(one, Toolpath) and not isinstance(other, Toolpath):
        times = one.profile().time, other.profile().time
    paths = [each if isinstance(each, Toolpath) else each.toolpath for each in (one, other)]
    return deviation(paths[0], paths[1], _names(one, other), step, times=times)


def _names(one: Ran | Toolpath, other: Ran | Toolpath) -> tuple[str, str]:
    """What both are called: their programs, and where these are called alike, their controls or their order too."""
    first, second = ("path" if isinstance(each, Toolpath) else str(each.program.title) for each in (one, other))
    if first != second:
        return first, second
    marks = ["" if isinstance(each, Toolpath) else each.control.name for each in (one, other)]
    marks = ["first", "second"] if marks[0] == marks[1] else marks
    return f"the {marks[0]} {first}", f"the {marks[1]} {second}"

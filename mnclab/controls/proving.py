"""Two programs, of whatever controls, and whether they do the same."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Any, overload

from mnclab.comparison.diff import TOLERANCE, Deviation, HolesCompared, compare_holes, deviation, names_of
from mnclab.comparison.proof import Proof, proof
from mnclab.controls.choice import run
from mnclab.machine.setup import Setup
from mnclab.machine.setup_file import load
from mnclab.path.holes import holes
from mnclab.path.toolpath import Toolpath
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, choice, fitting, shown
from mnclab.text.program import Program


@fitting
def prove(
    a: Run | str | Path | Program, b: Run | str | Path | Program, *, tolerance: float = 0.001, allow: Collection[str] = (),
    setup: Setup | str | Path | None = None,
) -> Proof:  # fmt: skip
    """Whether two programs of any controls make the same motion, or the same part; `a` is the one that is trusted.

    `a` and `b` are runs, or texts or files, which are run with the `setup`. The `verdict` is "same motion": every cut and
    every rapid agrees within the `tolerance` (mm), with feed, speed, coolant, tool, side and dwells. Or "same part": made
    another way, and what is left of the blank agrees (a milled one all along and all round the cuts that differ, of 20,000
    places of each program at most, and in a grid; a turned one in its whole section), and neither a collision nor a lower
    rapid, another side, speed or feed is among the differences. Else "different", as of a program that stops before its end,
    which proves nothing. `first` is the first place where they differ: lines, blocks, places, what each does.

    What is still on at the end, such as the spindle, is told and is no motion, as are a spindle that one of them holds through a
    tool change, and a radius that only one of them compensates. Differences of the kinds in `allow`, of "lifts", "chords" and
    "order", are harmless: the motion is the same in spite of them. Rapids of `b` that go lower than those of `a` ("rapid"), or
    elsewhere and no higher ("aside"), cannot be allowed: a clamp may stand there. With `fixtures` in the setup it is known what
    does, and they are "lifts", unless they come nearer to it than `a` ever does ("nearer"). A blank that only one program has
    serves both.

    >>> iso = mnc.run("G21 G17 G90 G54\\nT1 M6 S900 M3\\nG0 X0 Y0 Z5\\nG1 X40 F300\\nG3 X40 Y20 R10\\nM5\\n", "g43")
    >>> post = "T1 S900 M3\\nG54 G90 G0 X0 Y0 Z5\\nG1 X40 F300\\nG{} X40 Y20 I0 J10\\nM5\\n"
    >>> [mnc.prove(iso, mnc.run(post.format(sense), "mnc")).verdict for sense in (3, 2)]
    ['same motion', 'different']
    """
    return proof(_ran(a, setup), _ran(b, setup), tolerance, allow)


@overload
def diff(one: Run | Toolpath, other: Run | Toolpath, step: float | None = None) -> Deviation: ...


@overload
def diff(
    one: Run | Toolpath, other: Run | Toolpath, step: float | None = None, *, what: str, tolerance: float = TOLERANCE
) -> Deviation | HolesCompared: ...


@fitting
def diff(
    one: Run | Toolpath, other: Run | Toolpath, step: float | None = None, *, what: str = "path", tolerance: float = TOLERANCE
) -> Deviation | HolesCompared:
    """Two runs, or two paths, laid over one another: the largest deviation (mm) and where; `.plot()` shows both.

    Two programs, two controls, two tool radii, two limits (of their setups: the times differ); `step` mm is how
    closely the paths are looked at. With `what="holes"` their holes (see `path.holes`) are compared instead, whatever the
    order and the heights: places and diameters within `tolerance` mm; `.same` says whether they are the same.

    >>> one, other = mnc.run("G1 X10 F100\\n", "mnc"), mnc.run("G1 X10 Y0.5 F100\\n", "mnc")
    >>> mnc.diff(one, other).largest
    0.5
    """
    both = one, other
    for each in both:
        if not isinstance(each, Run | Toolpath):
            raise Alarm(f"two runs or two paths can be compared, got {shown(each)}", hint="diff(run(…), run(…))")
    check_number(tolerance, "the tolerance (mm)", at_least=0)
    if choice(what, "what", ("path", "holes")) == "holes":
        found = [each.holes() if isinstance(each, Run) else holes(each) for each in both]
        return compare_holes(found[0], found[1], names_of(one, other), tolerance)
    paths = [each.toolpath if isinstance(each, Run) else each for each in both]
    times = (one.profile().time, other.profile().time) if isinstance(one, Run) and isinstance(other, Run) else None
    more: Any = {name: tuple(getattr(each, name, none) for each in both) for name, none in (("reach", ""), ("rapids", None))}
    return deviation(
        paths[0], paths[1], names_of(one, other), step, times=times, reaches=more["reach"], rapids=more["rapids"]
    )


def _ran(given: Any, setup: Any) -> Run:
    if isinstance(given, Run):
        return given if setup is None else given.again(setup if isinstance(setup, Setup) else load(setup))
    if not isinstance(given, str | Path | Program):
        raise Alarm(f"a proof needs two runs, texts or files, got {shown(given)}", hint='mnclab.prove("part.nc", "part.h")')
    return run(given, None, setup)

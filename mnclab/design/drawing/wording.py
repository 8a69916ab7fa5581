"""How the measures of features are written on a drawing: signs, tolerances, the lines of a hole."""

from __future__ import annotations

from collections.abc import Sequence

from mnclab.design.drawing.dimensions import Tolerance, Value, value
from mnclab.design.model.features import Hole
from mnclab.design.model.measures import Measure

DIAMETER, DEPTH, BORED, SUNK, TIMES = "⌀", "↧", "⌴", "⌵", "×"
SIGNS = {"diameter": DIAMETER, "radius": "R", "depth": DEPTH}


def tolerance_of(measure: Measure) -> Tolerance:
    """The tolerance as a drawing writes it: a class, ± or two deviations."""
    if measure.fit:
        return measure.fit
    if measure.limits is None:
        return None
    lower, upper = measure.limits
    return upper if abs(upper + lower) < 1e-12 else (lower, upper)


def valued(measure: Measure, before: str = "", nominal: float | None = None, count: int = 1) -> Value:
    """A measure as the value of a dimension; `count` of them are equal, `nominal` where it counts from elsewhere."""
    size = measure.nominal if nominal is None else nominal
    after = "°" if measure.kind == "angle" else ""
    return value(size, times(count) + before, tolerance_of(measure), after=after)


def times(count: int) -> str:
    """What stands before the dimension of several equal features."""
    return f"{count}{TIMES} " if count > 1 else ""


def written(measure: Measure, before: str | None = None) -> str:
    """A measure in the line of a note: deviations one behind the other."""
    sign = SIGNS.get(measure.kind, "") if before is None else before
    if measure.text:
        return sign + measure.text.replace("x", TIMES)
    said = valued(measure, sign)
    if said.limits:
        upper, lower = said.limits
        return f"{said.text} {upper}/{lower}"
    space = "\N{THIN SPACE}" if said.tolerance else ""
    return f"{said.text}{space}{said.tolerance}"


def hole_lines(hole: Hole, count: int = 1) -> tuple[str, ...]:
    """What is written at a hole: "4× M8 ↧12" and "⌀6.8 ↧16", counterbore and countersink on lines of their own."""
    known = {each.name: each for each in hole.measures()}
    lines = []
    bore = written(known["diameter"])
    if "depth" in known:
        bore += " " + written(known["depth"])
    if "thread" in known:
        deep = [written(known["thread depth"])] if "thread depth" in known else []
        lines.append(" ".join([written(known["thread"], ""), *deep]))
    lines.append(bore)
    if "counterbore diameter" in known:
        lines.append(f"{BORED} {written(known['counterbore diameter'])} {written(known['counterbore depth'])}")
    if "countersink diameter" in known:
        lines.append(f"{SUNK} {written(known['countersink diameter'])}{TIMES}{written(known['countersink angle'])}")
    if "point angle" in known:
        lines.append(f"point {written(known['point angle'])}")
    return (times(count) + lines[0], *lines[1:])


def chamfer_text(measures: Sequence[Measure]) -> str:
    """"1×45°"; the angle is that of the face against the plane."""
    known = {each.name: each for each in measures}
    angle = written(known["angle"]) if "angle" in known else "45°"
    return f"{written(known['width'])}{TIMES}{angle}"


def at_place(measure: Measure, datum: float) -> Value:
    """A coordinate as the distance from a datum."""
    return valued(measure, "", abs(measure.nominal - datum))

"""A turned design in a file (TOML): read so that an alarm shows the line that is wrong, written so that it reads back equal."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any

from mnclab.design.model.design import TEXTS
from mnclab.design.model.feature_file import features_of, pointing_at_features, texts_of, tuples
from mnclab.design.model.turned_design import TurnedDesign
from mnclab.design.model.turned_features import TURNED_FEATURES
from mnclab.geometry.contours import Contour
from mnclab.text.alarm import Alarm
from mnclab.text.file import File, as_table, check_names
from mnclab.text.given import check_number, faults_as_alarms, shown
from mnclab.workpiece.blank import blank_of

#: The format, as the help of the command line shows it.
FORMAT = """\
title = "Shaft"                # the title block: also number, material, general (tolerances), author, date
profile = [                    # corners from one end to the other, z and the radius r, mm; also [z, r]
    { z = 0, r = 12, chamfer = 1.5 },         # a width at 45 degrees, or [width along the axis, angle from it]
    { z = -30, r = 12 },
    { z = -30, r = 20, rounding = 1 },        # a radius
    { z = -50, r = 20, arc = 40 },            # to the next point an arc of a radius; negative: turning to the right
    { z = -60, r = 18 },
]
# closed = true                # where the profile is the whole half section; else it is closed to the axis

[blank]                        # the bar, mm; also bore (a radius too)
radius = 22
low = -70
high = 1

[tolerances]                   # of the profile, counted from the front: ±, a class of ISO 286, or lower and upper
"diameter 1" = "h6"
"length 1" = [0, 0.1]

[[features]]                   # one table each, in the order in which they are made
kind = "bore"                  # depth to the shoulder, without one it goes through; point = 118 degrees, 180 is flat
diameter = 10                  # chamfer at its mouth, corner (a radius) of a flat bottom
depth = 20
from_end = "front"             # or "back"
name = "bore A"                # what drawing and tables call it
tolerances = { diameter = "H7" }

[[features]]
kind = "centre hole"           # ISO 6411 form A: the pilot says the rest; also diameter, depth, from_end
pilot = 2.5
from_end = "back"

[[features]]
kind = "ring groove"           # from z backwards, to a depth or to the diameter of its bottom; inside = true: in a bore
z = -34
width = 4
depth = 2
corner = 0.4

[[features]]
kind = "face groove"           # between two diameters in a face; also corner, from_end
inner = 14
outer = 19
depth = 1.5

[[features]]
kind = "undercut"              # DIN 76-1, from the shoulder at z towards the thread; also diameter, width, corner, angle,
thread = "M24x1.5"             # inside, thread_at = "back"
z = -30

[[features]]
kind = "thread"                # from start backwards; inside = true: in a bore
thread = "M24x1.5"
start = 0
end = -27
"""

KNOWN = (*TEXTS, "profile", "closed", "blank", "tolerances", "features")
ROW = ("z", "r", "rounding", "chamfer", "arc", "bulge")
NAMED = re.compile(r"(?:corner|points?) (\d+)")  # what in an alarm says where the fault is


def design_of(table: Mapping[str, Any], file: File) -> TurnedDesign:
    """The design that a table of a file describes."""
    check_names(table, KNOWN, "a turned design", file)
    more: dict[str, Any] = dict(texts_of(table, file))
    profile, corners = _profile(table, file)
    more |= corners
    if "blank" in table:
        with file.at("blank"):
            more["blank"] = blank_of(as_table(table["blank"], "blank"), "blank", file, "blank")
    with file.at("tolerances"):
        more["tolerances"] = tuples(as_table(table.get("tolerances", {}), "tolerances"))
    features = features_of(table, "features", TURNED_FEATURES, file)
    try:
        with pointing_at_features(table, file):
            return TurnedDesign(profile, features, **more)
    except Alarm as fault:
        fault.span = fault.span or _place(fault.message, file)
        raise


# ---- reading ----


def _profile(table: Mapping[str, Any], file: File) -> tuple[Contour, dict[str, Any]]:
    """The outline of the rows of `profile`, and what breaks its corners."""
    closed = table.get("closed", False)
    with file.at("closed"):
        if not isinstance(closed, bool):
            raise Alarm(f"closed must be true or false, got {shown(closed)}")
    given = table.get("profile")
    with file.at("profile"):
        if not isinstance(given, list) or len(given) < 2:
            raise Alarm(f"profile must be a list of at least two points, got {shown(given)}",
                        hint="profile = [[0, 10], [-30, 10]]: z and r")  # fmt: skip
    rows = [_row(each, k, file) for k, each in enumerate(given)]
    points = [(float(row["z"]), float(row["r"])) for row in rows]
    bulge = []
    for k, row in enumerate(rows):
        with file.at("profile", str(k), "arc" if "arc" in row else "bulge"):
            bulge.append(_bulge(row, points[k], points[(k + 1) % len(points)], last=not closed and k == len(rows) - 1))
    corners: dict[str, dict[int, Any]] = {
        f"{name}s": {k: row[name] for k, row in enumerate(rows) if name in row} for name in ("rounding", "chamfer")
    }
    with file.at("profile"), faults_as_alarms():
        return Contour(points, bulge, closed), corners


def _row(given: Any, k: int, file: File) -> Mapping[str, Any]:
    where = f"point {k} of the profile"
    with file.at("profile", str(k)):
        if isinstance(given, list) and len(given) == 2:
            given = {"z": given[0], "r": given[1]}
        if not isinstance(given, dict):
            raise Alarm(f"{where} must be [z, r] or a table, got {shown(given)}", hint="{ z = -30, r = 12, rounding = 2 }")
        check_names(given, ROW, where, file, "profile", str(k))
        for name in ("z", "r"):
            with file.at("profile", str(k), name):
                check_number(given.get(name), f"the {name} of {where}")
        for name in ("rounding", "chamfer"):
            value = given.get(name)
            pair = name == "chamfer" and isinstance(value, list) and len(value) == 2
            sizes: list[Any] = [*value] if pair and value else [value]
            for each in sizes if name in given else ():
                with file.at("profile", str(k), name):
                    check_number(each, f"the {name} of {where}", above=0)
    return given


def _bulge(row: Mapping[str, Any], start: tuple[float, float], end: tuple[float, float], last: bool) -> float:
    """The tangent of a quarter of the angle of an arc to the next point, 0 for a line."""
    if "arc" not in row and "bulge" not in row:
        return 0.0
    if last or ("arc" in row and "bulge" in row):
        told = "the last point has no arc after it" if last else "an arc has either a radius or a bulge"
        raise Alarm(f"{told}, got {shown(dict(row))}")
    if "bulge" in row:
        check_number(row["bulge"], "the bulge of an arc")
        return float(row["bulge"])
    check_number(row["arc"], "the radius of an arc (mm)")
    chord, radius = math.dist(start, end), float(row["arc"])
    if abs(radius) < chord / 2 or not chord:
        raise Alarm(f"the radius of an arc must be at least half its chord, {chord / 2:.6g}, got {radius:g}")
    return math.copysign(math.tan(math.asin(chord / 2 / abs(radius)) / 2), radius)


def _place(message: str, file: File) -> Any:
    """Where a fault stands that the design itself found."""
    found = NAMED.search(message)
    if not found:
        tables = [name for word, name in (("tolera", "tolerances"), ("blank", "blank")) if word in message]
        return file.place_of(*(tables or ["profile"])[:1])
    return file.place_of("profile", found[1])


# ---- writing ----


def table_of_profile(design: TurnedDesign) -> dict[str, Any]:
    """The profile of a design, and whether it is the whole half section, as a file has them."""
    return ({"closed": True} if design.profile.closed else {}) | {"profile": list(_rows(design))}


def _rows(design: TurnedDesign) -> Iterator[dict[str, Any]]:
    outline = design.profile
    for k, (z, r) in enumerate(outline.points):
        row: dict[str, Any] = {"z": z, "r": r}
        if outline.bulge and outline.bulge[k]:
            row["bulge"] = outline.bulge[k]
        for name, given in (("rounding", design.roundings), ("chamfer", design.chamfers)):
            if k in given:
                row[name] = given[k]
        yield row

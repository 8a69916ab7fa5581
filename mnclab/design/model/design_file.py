"""Designs in files: TOML as people write it, drawings (svg, pdf, png, dxf) and bodies (stl, gltf, glb, vtk, csv).

TOML is read with alarms that show the line, and written so that it reads back equal.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mnclab.design.model import turned_file
from mnclab.design.model.design import TEXTS, Design
from mnclab.design.model.feature_file import features_of, pointing_at_features, table_of_feature, texts_of, toml
from mnclab.design.model.features import FEATURES
from mnclab.design.model.turned_design import TurnedDesign
from mnclab.design.model.turned_features import TURNED_FEATURES
from mnclab.text.alarm import Alarm
from mnclab.text.file import File, as_table, check_names, named, parse, replaced
from mnclab.text.given import shown
from mnclab.workpiece.blank import blank_of, table_of

#: The format, as the help of the command line shows it.
FORMAT = """\
title = "Bearing plate"        # the title block: also number, material, general (tolerances), author, date
turn = "x"                     # about which axis, x or y, the part is turned over for [[back]]

[blank]                        # low and high, two corners in the coordinates of the program, mm
low = [0, 0, -20]
high = [100, 60, 0]            # or an upright cylinder: radius, low, high, at = [x, y, 0], bore (a radius too)

[[features]]                   # one table each, in any order
kind = "pocket"                # all within a contour; "stud": all around it
x = 30                         # a rectangle about (x, y): length along X, width along Y, corner a radius,
y = 20                         # turned by degrees
length = 40
width = 25
corner = 5
depth = 8                      # from the top of the blank, or from the height top = …
name = "pocket A"              # what drawing and tables call it
tolerances = { length = 0.1, width = "H9", depth = [0, 0.2] }     # ±, a class of ISO 286, or lower and upper
islands = [{ x = 30, y = 20, diameter = 10 }]                     # what stays of a pocket

[[features]]
kind = "hole"                  # depth to the shoulder, without one it goes through; point = 118 degrees, 180 is flat
x = 80                         # counterbore = [diameter, depth], countersink = [diameter, angle]
y = 20
diameter = 6.6                 # or thread = "M8" with thread_depth
counterbore = [11, 6]

[[features]]
kind = "slot"                  # start and end are the centres of its round ends
start = [60, 45]
end = [90, 45]
width = 8
depth = 5

[[features]]
kind = "chamfer"               # of the edge along a contour, by a width; angle = 90 is that of the tool
width = 1                      # a rectangle stands in a table of its own, since its width is another one
contour = { x = 30, y = 20, length = 40, width = 25, corner = 5 }

[[features]]
kind = "groove"                # what a tool of a width leaves along a contour, open or closed
points = [[10, 40], [40, 40], [50, 50]]
bulge = [0, 0.2, 0]            # tan(angle / 4) of the arc to the next point, 0 a line
closed = false
width = 3
depth = 2

[[features]]
kind = "face"                  # the whole top
depth = 0.5

[[features]]
kind = "slope"                 # a rectangle with a plane floor, from the depth at its end of least X to that at the other
x = 70
y = 10
length = 20
width = 6
start_depth = 1
end_depth = 3

[[back]]                       # a feature of the lower side, as it is seen once the part is turned over
kind = "pocket"
x = 50
y = 30
diameter = 30
depth = 5
"""

SIDES = ("features", "back")
KNOWN = (*TEXTS, "turn", "blank", *SIDES)


def load(path: str | Path) -> Any:
    """The design of a file; an Alarm names what is wrong in it and shows the line."""
    return parse(path, either_of, "design")


def either_of(table: Mapping[str, Any], file: File) -> Any:
    """A turned design has a profile."""
    return turned_file.design_of(table, file) if "profile" in table else design_of(table, file)


def design_of(table: Mapping[str, Any], file: File) -> Design:
    """The design that a table writes."""
    check_names(table, KNOWN, "a design", file)
    if "blank" not in table:
        raise Alarm("a design has no blank", hint="[blank] with low and high, two corners [x, y, z]; a turned one: profile")
    given: dict[str, Any] = dict(texts_of(table, file))
    with file.at("blank"):
        blank = blank_of(as_table(table["blank"], "blank"), "blank", file, "blank")
        Design(blank)
    if "turn" in table:
        with file.at("turn"):
            given["turn"] = Design(blank, turn=table["turn"]).turn
    for side in SIDES:
        given[side] = features_of(table, side, FEATURES, file)
    with pointing_at_features(table, file):  # of a feature that does not fit the others
        return Design(blank, **given)


def text_of(design: Any) -> str:
    """A design as it is written in a file."""
    known: Any = TURNED_FEATURES if isinstance(design, TurnedDesign) else FEATURES
    sides = {side: getattr(design, side, ()) for side in SIDES}
    if wrong := [each for some in sides.values() for each in some if type(each) not in known.values()]:
        raise Alarm(f"a file knows no feature such as {shown(wrong[0])}", hint=f"known: {', '.join(known)}")
    usual = type(design).__dataclass_fields__
    texts = {name: getattr(design, name) for name in (*TEXTS, "turn") if name in usual}
    table: dict[str, Any] = {name: value for name, value in texts.items() if value != usual[name].default}
    if isinstance(design, TurnedDesign):
        table |= turned_file.table_of_profile(design)
    if design.blank is not None:
        table["blank"] = table_of(design.blank)
    table |= {"tolerances": dict(given)} if (given := getattr(design, "tolerances", {})) else {}
    table |= {side: [table_of_feature(each) for each in some] for side, some in sides.items() if some}
    return toml(table, rows=("profile",))


DRAWINGS = (".svg", ".pdf", ".png", ".dxf")
BODIES = (".stl", ".gltf", ".glb", ".vtk", ".csv")


def save(design: Any, path: str | Path, **options: Any) -> Path:
    """Write one file and return its path; drawings take the options of `plot`, bodies those of `workpiece`."""
    path, suffix = named(path, (".toml", *DRAWINGS, *BODIES), "cannot write a design as {}")
    if suffix in DRAWINGS:
        return _drawing(design, path, **options)
    if suffix in BODIES:
        return Path(design.workpiece(**options).save(path))
    if options:
        raise Alarm(f"{suffix} files have no options, got {', '.join(options)}")
    text = text_of(design)
    with replaced(path) as beside:
        try:
            beside.write_text(text, encoding="utf-8", newline="\n")
        except UnicodeEncodeError as error:
            raise Alarm(f"the design cannot be written: {error.object[error.start]!r} is no character") from None
    return path


def _drawing(design: Any, path: Path, **options: Any) -> Path:
    from mnclab.design.drawing import save

    return save(design, path, **options)

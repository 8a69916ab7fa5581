"""What tests of measuring cycles of the MNC share: the machine of the catalogue's checks, parts, and touches worked out by hand.

Places are (x, y) of the program, mm; a wall is a point and its unit normal out of the material, a round one centre and radius.
"""

import json
import math
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Probe, Setup, Tool
from mnclab.workpiece import part as parts

DATUM = (300.0, 200.0, -400.0)  # row 1, machine coordinates ("test set-up")
BEFORE = "N10 T20\nN20 G54 G90 G00 X0 Y0 Z50\n"
DEEP = 80.0  # mm from the upper surface to the bottom of a wall
FAR = 400.0  # mm, half of what a pocket lies in
PROBE = Probe(clearance=2, reach=20, feed=200, rapid=2000)


def measured(program, part, ball=3.0, before=BEFORE, place=None, **more):
    """A program run on the machine of the checks; `part` in coordinates of row 1, or of `place` (4, 4) in the machine."""
    setup = {
        "tools": {1: Tool(radius=5, kind="mill"), 20: Tool(radius=ball, length=150, kind="probe")},
        "datums": {1: DATUM}, "probe": PROBE, "part": part and part.placed(at(DATUM) if place is None else place),
    } | more  # fmt: skip
    return mnclab.run(f"{before}{program}", "mnc", Setup(**setup))


def examples(*codes):
    """The examples of the catalogue with their checks."""
    found = json.loads((Path(__file__).parents[2] / "authorities/catalogue/mnc-probing.json").read_text(encoding="utf-8"))
    return [each for each in found if each["code"] in codes]


def near(number):
    """The checks are rounded to four decimals."""
    return pytest.approx(number, abs=5.001e-5)


def feature(given):
    """A part of a check: its corner is the lower left one before turning."""
    if given["type"] == "plane":
        return parts.plane((0, 0, given["z"]), (0, 0, 1))
    inside, top = given["material"] == "inside", given["top"]
    if given["type"] == "circle":
        return disc(given["center"], given["diameter"], top, inside)
    size, angle = given["size"], given["angle"]
    centre = given.get("center")
    if centre is None:
        centre = (at((*given["corner"], 0), angle) @ (size[0] / 2, size[1] / 2, 0, 1))[:2]
    return box(centre, size, angle, top, inside)


def at(xyz=(0.0, 0.0, 0.0), degrees=0.0):
    """A frame that turns about Z and then shifts."""
    frame = np.eye(4)
    frame[:2, :2] = turn(degrees)
    frame[:3, 3] = xyz
    return frame


def turn(degrees):
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array([(cos, -sin), (sin, cos)])


def box(centre, size, angle=0.0, top=0.0, inside=True):
    """An upright rectangle of material turned about its centre, or a pocket of that shape in a large block."""
    a, b = size[0] / 2, size[1] / 2
    if inside:
        return parts.box((-a, -b, top - DEEP), (a, b, top)).placed(at((*centre, 0.0), angle))
    block = parts.box((-FAR, -FAR, top - 2 * DEEP), (FAR, FAR, top))
    return block - parts.box((-a, -b, top - DEEP), (a, b, top + DEEP)).placed(at((*centre, 0.0), angle))


def disc(centre, diameter, top=0.0, inside=True):
    """An upright cylinder, or a bore in a large block."""
    x, y = centre
    if inside:
        return parts.cylinder((x, y, top - DEEP), (x, y, top), diameter / 2)
    block = parts.box((-FAR, -FAR, top - 2 * DEEP), (FAR, FAR, top))
    return block - parts.cylinder((x, y, top - DEEP), (x, y, top + DEEP), diameter / 2)


def walls(centre, size, angle):
    """The four sides of a rectangle by the direction that they look to: point and normal."""
    ways = {"+X": (1, 0), "-X": (-1, 0), "+Y": (0, 1), "-Y": (0, -1)}
    half = np.array(size) / 2
    return {name: (np.array(centre) + turn(angle) @ (half * way), turn(angle) @ np.array(way)) for name, way in ways.items()}


def to_wall(start, way, wall, ball):
    """Where the centre of a ball stands that met a straight wall: t = ((s - q) n - r) / (-d n)."""
    start, way = np.array(start, float), np.array(way, float)
    point, normal = wall
    return start + way * (((start - point) @ normal - ball) / -(way @ normal))


def to_round(start, way, centre, radius, ball, inside):
    """The same of a round wall, from within a bore or from outside a boss: |s + t d - c| = radius -+ r."""
    start, way = np.array(start, float), np.array(way, float)
    off, reach = start - centre, radius + ball if inside else radius - ball
    along = off @ way
    root = math.sqrt(along**2 - off @ off + reach**2)
    return start + way * (-along - root if inside else -along + root)


def base_of(run):
    """The base rotation in degrees."""
    frame = run.frames["base rotation"]
    return math.degrees(math.atan2(frame[1, 0], frame[0, 0]))


def working(run):
    """The working datum in machine coordinates."""
    return run.frames["datum"][:3, 3]


def rows_of(run, line):
    """The motion of a line."""
    path = run.toolpath.motion
    return path[path.line == line]


def probes(run):
    return run.toolpath[run.toolpath.kind == Kind.PROBE]

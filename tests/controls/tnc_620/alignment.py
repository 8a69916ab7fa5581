"""What tests of the misalignment cycles of the TNC 620 share: the machine of the catalogue's checks, and its moves as points."""

import re

import numpy as np

import mnclab
from mnclab.geometry import frames
from mnclab.workpiece.part import box, cylinder, plane

PRESET = (100, 200, -300)  # active row 1
BALL = 2


def program(blocks, before="L Z+100 R0 FMAX"):
    return f"0 BEGIN PGM P MM\n{'' if 'TOOL CALL' in before else 'TOOL CALL 7 Z'}\n{before}\n{blocks}\nEND PGM P MM\n"


def cycle(number, values):
    """A definition; texts in quotes are those of QS parameters."""
    return "\n".join([f"TCH PROBE {number} NAME", *(f"{q}={v}" for q, v in values.items())])


def setup(part=None, settings=None, presets=None, reach=10, ball=BALL, start=(100, 200, -150), tools=None, **more):
    """The virtual probe of the checks: ball radius 2, SET_UP 2, DIST 10; preset row 1 is active, south pole at Z100."""
    probe = mnclab.Probe(clearance=2, reach=reach, feed=300, rapid=2000)
    return mnclab.Setup(
        tools=tools or dict.fromkeys((7, 69), mnclab.Tool(radius=ball, kind="probe")),
        presets={1: PRESET} if presets is None else presets, settings={"preset": 1} | (settings or {}), part=part, probe=probe,
        start=start, **more,
    )  # fmt: skip


def run(blocks, part=None, before="L Z+100 R0 FMAX", **more):
    return mnclab.run(program(blocks, before), "tnc-620", setup(part, **more))


def placed(part, x=0.0, y=0.0, degrees=0.0, z=0.0, preset=PRESET):
    """A part of program coordinates, turned and shifted there, on the machine."""
    there = frames.shift(*preset) @ frames.shift(x, y, z) @ frames.turn(np.radians(degrees))
    return part.placed(there)


def plate(x=0.4, y=-0.3, degrees=1.5, long=100, wide=60, deep=40):
    """A box whose lower left corner stands at a point, its top at Z0."""
    return placed(box((0, 0, -deep), (long, wide, 0)), x, y, degrees)


def bored(*holes, low=(-300, -300), high=(300, 300), preset=PRESET):
    """A plate with holes (x, y, diameter) from its top at Z0."""
    part = box((*low, -40), (*high, 0))
    for x, y, diameter in holes:
        part = part - cylinder((x, y, -60), (x, y, 30), diameter / 2)
    return placed(part, preset=preset)


def studs(*each, preset=PRESET):
    """Studs (x, y, diameter) up to Z0 on a floor at Z-40."""
    part = plane((0, 0, -40), (0, 0, 1))
    for x, y, diameter in each:
        part = part | cylinder((x, y, -45), (x, y, 0), diameter / 2)
    return placed(part, preset=preset)


def ends(found):
    """Ends of the moves after the first one (n, 3), in coordinates of the first preset; the start of the path belongs to it."""
    return found.toolpath.motion.end[1:]


def points(moves, start=(0, 0, 100)):
    """The moves of a check as places: `X10 Y-4 FMAX`, `probe to X10 Y-2.0493 F`, `arc CCW to X1 Y2 FMAX`, `Z20 FMAX`."""
    here, found = list(start), []
    for move in moves:
        for axis, value in re.findall(r"([XYZ])(-?[\d.]+)", move):
            here["XYZ".index(axis)] = float(value)
        found.append(tuple(here))
    return np.array(found)

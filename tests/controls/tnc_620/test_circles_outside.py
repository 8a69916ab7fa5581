"""Circles outside the working plane: CC, C, CR, CT, CP, CTP and LP in ZX and YZ, with Z as the tool axis.

Angles count from X in XY, from Y in YZ and from Z in ZX, as the pilots of the TNC 310 and TNC 426 say; DR+ is the positive
sense. So a program with its letters changed round, X for Y for Z, draws its path turned in the same way.
"""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mnclab as mnc
from mnclab import Kind
from mnclab.show.plot.datums import places_of

ROUND = {"YZ": {"X": "Y", "Y": "Z", "Z": "X"}, "ZX": {"X": "Z", "Y": "X", "Z": "Y"}}
NORMALS = {"YZ": (1, 0, 0), "ZX": (0, 1, 0)}


def renamed(text: str, plane: str) -> str:
    """Axis letters changed round, so that what lay in XY lies in another plane."""
    return re.sub(r"[XYZ](?=[+-])", lambda found: ROUND[plane][found.group()], text)


def rolled(points: np.ndarray, plane: str) -> np.ndarray:
    """Points of XY where they lie in another plane."""
    to = ["XYZ".index(ROUND[plane][axis]) for axis in "XYZ"]
    turned = np.empty_like(points)
    turned[:, to] = points
    return turned


def arcs(run: mnc.Run) -> mnc.Toolpath:
    assert run.ok, run.alarms
    return run.toolpath[run.toolpath.kind == Kind.ARC]


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("plane", ["YZ", "ZX"])
def test_a_quarter_turn(plane: str, sense: int, inside) -> None:
    """From the second axis of the plane: the positive sense leads to the first one's negative side."""
    first, second = plane
    across = next(axis for axis in "XYZ" if axis not in plane)
    blocks = f"2 L {second}+10 {across}+7 R0 FMAX M3\n3 CC {first}+0 {second}+0\n4 CP IPA{90 * sense:+} DR{'+-'[sense < 0]}"
    (arc,) = arcs(inside(blocks))
    wanted = {first: -10 * sense, second: 0, across: 7}
    assert arc.end == pytest.approx([wanted[axis] for axis in "XYZ"], abs=1e-12)
    assert arc.centre == pytest.approx([7 * (axis == across) for axis in "XYZ"], abs=1e-12)
    assert tuple(arc.axis) == NORMALS[plane] and arc.sweep == pytest.approx(sense * math.pi / 2)


def test_concave_cylinder(inside) -> None:
    """Half a round groove along Y: pole in ZX, from 90 degrees (+X) by 180 (-Z) to 270 (-X), and back one step along Y."""
    run = inside(
        "2 L X+0 Y+0 Z+50 R0 FMAX M3\n3 CC X+0 Z+0\n4 LP PR+25 PA+90 F200\n5 CP PA+270 DR+\n6 L IY+2\n7 CP PA+90 DR-\n"
        "8 LP PR+10 PA+180\n9 CTP PR+10 PA+270"
    )
    ends = run.toolpath.motion.end[1:]
    wanted = [(25, 0, 0), (-25, 0, 0), (-25, 2, 0), (25, 2, 0), (0, 2, -10), (-10, 2, 0)]
    assert run.ok and ends == pytest.approx(np.array(wanted), abs=1e-12)
    down, back, tangent = arcs(run)
    assert [math.degrees(row.sweep) for row in (down, back)] == pytest.approx([180, -180])
    # in (z, x) from (-10, 0) with the direction of the line before, (-10, -25), to (0, -10): the centre lies on the normal
    # of the line, (25, -10) t, and as far from both ends: |(10, -10) - t (25, -10)| = |t (25, -10)|, so t = 200 / 700
    t = 200 / 700
    assert tangent.centre == pytest.approx([-10 * t, 2, -10 + 25 * t], abs=1e-12)


def test_arc_by_its_radius_and_a_tangent_one(inside) -> None:
    """CR in YZ: the greater arc of a quarter chord; CT in ZX goes on from a line upwards."""
    run = inside(
        "2 L X+0 Y+10 Z+0 R0 FMAX M3\n3 CR Y+0 Z+10 R-10 DR-\n4 L X+0 Y+0 Z+20\n5 CT X+5 Z+25\n6 CC IX+3 IZ-4\n7 C DR-"
    )
    greater, tangent, whole = arcs(run)
    assert greater.sweep == pytest.approx(-1.5 * math.pi) and greater.centre == pytest.approx([0, 0, 0])
    assert tangent.centre == pytest.approx([5, 0, 20]) and tangent.sweep == pytest.approx(math.pi / 2)  # from Z to X
    assert whole.centre == pytest.approx([8, 0, 21]) and whole.sweep == pytest.approx(-math.tau)


def test_helix_across_the_plane_of_the_pole(inside) -> None:
    """Two and a half turns about an axis along Y, and 12 mm along it."""
    (arc,) = arcs(inside("2 L X+6 Y+1 Z+8 R0 FMAX M3\n3 CC X+0 Z+0\n4 CP IPA-900 IY+12 DR-"))
    assert arc.end == pytest.approx([-6, 13, -8]) and arc.sweep == pytest.approx(-5 * math.pi)


def test_spatial_arc_under_a_rotation(inside) -> None:
    """Cycle 10 turns the plane ZX about Z: the circle stands on the line at 30 degrees."""
    run = inside("2 CYCL DEF 10.0 ROT\n3 CYCL DEF 10.1 ROT+30\n4 L X+10 Y+0 Z+0 R0 FMAX M3\n5 CC X+0 Z+0\n6 C X-10 Z+0 DR-")
    (arc,) = arcs(run)
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
    assert arc.end == pytest.approx([-10 * c, -10 * s, 0]) and arc.axis == pytest.approx([-s, c, 0])


numbers = st.floats(-50, 50).map(lambda value: round(value, 3))


@settings(max_examples=60)
@given(numbers, numbers, numbers, numbers, numbers, st.integers(1, 800), st.sampled_from("+-"), st.sampled_from(["YZ", "ZX"]))
def test_letters_changed_round_turn_the_path(x, y, z, u, v, angle, sense, plane) -> None:
    """The same blocks in XY, whose arcs other tests work out, and in another plane."""
    if math.hypot(x - u, y - v) < 0.1:
        x += 1.0
    turn = angle if sense == "+" else -angle
    blocks = (
        f"2 L X{x:+} Y{y:+} Z{z:+} R0 FMAX M3\n3 CC X{u:+} Y{v:+}\n4 CP IPA{turn:+} IZ+3 DR{sense}\n5 LP IPA+10 IPR+2\n"
        f"6 CTP PR+70 PA{turn:+}\n7 CC IX+5 IY-2\n8 C DR{sense}\n9 CR IX+3 IY+4 R-30 DR{sense}"
    )
    whole = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n{}\n99 END PGM A MM\n"
    flat, other = (mnc.run(whole.format(text), "tnc-620") for text in (blocks, renamed(blocks, plane)))
    assert other.ok == flat.ok
    assert other.toolpath.end == pytest.approx(rolled(flat.toolpath.end, plane), abs=1e-9)
    assert other.toolpath.sweep == pytest.approx(flat.toolpath.sweep, abs=1e-12, nan_ok=True)


def test_the_cross_of_a_pole_lies_in_its_plane(inside) -> None:
    """The next move is a line, whose own plane is XY."""
    run = inside("2 L X+0 Y+0 Z+50 R0 FMAX M3\n3 CC X+10 Z+5\n4 LP PR+25 PA+90 F200\n5 CP IPA+180 DR+")
    (pole,) = (place for place in places_of(run) if place.name == "pole")
    assert pole.xyz == pytest.approx((10, math.nan, 5), nan_ok=True)

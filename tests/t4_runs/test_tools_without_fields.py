"""Every kind of tool with every field left out: it cuts what the closed form says, or a sentence says why it cuts nothing.

A pass through the whole bar leaves the radius of the tip whatever the shape of the insert; a slot along a whole plate takes
2 R deep, less what a point or a corner leaves; a plunge takes the profile of the tool, turned about the axis of the bar.
"""

from itertools import combinations
from math import cos, pi, radians, sqrt, tan

import numpy as np
import pytest
import shapely
from tools.together import deep_but_one_in

import mnclab
from mnclab import Setup, Tool
from mnclab.path.inserts import as_drawn, cutting_part, edgeless, insert
from mnclab.path.tool import KINDS, LATHE
from mnclab.workpiece.blank import Box, cylinder

BAR, TUBE, PLATE = cylinder(20, -60, 0), cylinder(20, -60, 0, bore=10), Box((0, 0, -20), (60, 40, 0))
BLOCK = Box((24, 14, -20), (36, 26, 0))  # about one hole
INSERTS = {"corner": 0.4, "angle": 55.0, "cutting_length": 3.0, "width": 3.0, "main_angle": 75.0, "auxiliary_angle": 35.0}
TURNING = {"radius": 4.0, "corner": 0.4, "angle": 100.0, "cutting_length": 12.0, "teeth": 2, "length": 50.0}
ROUND = tuple(kind for kind in KINDS if kind and kind not in (*LATHE, "probe"))


def every(fields):
    for many in range(len(fields) + 1):
        for names in combinations(fields, many):
            yield {name: fields[name] for name in names}


def turned(tool, text, stock=BAR, control="jnc-t01"):
    setup = Setup(tools={1: tool}, stock=stock, start=(90, 0, 120), settings={"lint": "off"})
    run = mnclab.run(text.replace("|", "\n") + "\n", control, setup)
    assert run.ok, run.alarms
    return run


@pytest.mark.parametrize("kind", LATHE)
def test_a_lathe_tool_turns_its_radius_or_says_that_it_has_no_edge(kind):
    """Outside from 20 to 18 mm, inside from 10 to 12 mm, along all of 60 mm."""
    bore = kind == "boring"
    text = f"M3|G97 S500 T1|G94 F100|G00 X{12 if bore else 18} Z5|G01 Z-75"
    closed = pi * (12**2 - 10**2) * 60 if bore else pi * (20**2 - 18**2) * 60
    for fields in every(INSERTS):
        run = turned(Tool(kind=kind, **fields), text, TUBE if bore else BAR)
        part, said = run.workpiece(), f"T1 ({kind}) has no width"
        shape = fields.keys() & {"corner", "width", "main_angle", "auxiliary_angle"}
        if "grooving" in kind and not shape:
            assert any(said in note for note in part.notes) and said in repr(run.collisions())
        elif kind == "face grooving" and ("width" not in fields or "main_angle" in fields):
            assert part.removed > 0  # narrower than the cut is deep, or leaning towards the axis
        else:
            assert part.removed == pytest.approx(closed, rel=1e-6) and not part.notes, fields


@pytest.mark.parametrize("control", ["mnc", "jnc-t01"])
@pytest.mark.parametrize("kind", deep_but_one_in(3, ROUND))
def test_what_turns_about_its_own_axis_cuts_its_hole_or_says_that_it_has_no_radius(kind, control):
    """Down to 15 mm: a cylinder, less what the point, 118 or 90 degrees where none is given, or the corner leaves."""
    lathe = control == "jnc-t01"
    usual = {"drill": 118.0, "countersink": 90.0, "chamfer": 90.0}
    for fields in every(TURNING):
        text = "M3|G97 S500 T1|G94 F100|G00 X0 Z5|G01 Z-15" if lathe else "T1 S500 M3|G0 X30 Y20 Z5|G1 Z-15 F100"
        run = turned(Tool(kind=kind, centre_cutting=True, **fields), text, BAR if lathe else BLOCK, control)
        part = run.workpiece(step=0.25) if not lathe else run.workpiece()
        if not fields.get("radius"):
            assert part.removed == 0 and any("cut nothing" in each or "no radius" in each for each in part.notes), fields
            continue
        angle = fields.get("angle") if kind in usual or lathe else None
        angle = angle or usual.get(kind, 180.0)
        r = 4.0
        high = r / tan(radians(angle / 2)) if angle < 180 else 0.0
        closed = pi * r**2 * (15 - high) + pi * r**2 * high / 3
        if not lathe and kind not in usual and fields.get("corner"):  # a ring under the rounded corner
            c = fields["corner"]
            closed -= pi * (r**2 * c - ((r - c) ** 2 * c + (r - c) * pi * c**2 / 2 + 2 * c**3 / 3))
        assert part.removed == pytest.approx(closed, rel=2e-3 if not lathe else 1e-5), (fields, closed)


def groove(width_at, tip=15.0, bar=20.0):
    """The volume of a groove whose width at a height above the tip is known."""
    r = np.linspace(tip, bar, 20_001)
    values = 2 * pi * r * np.array([width_at(each - tip) for each in r])
    return float(((values[:-1] + values[1:]) / 2 * np.diff(r)).sum())


@pytest.mark.parametrize(
    ("tool", "width_at"),
    [
        (Tool(kind="thread"), lambda h: 2 * h * tan(radians(30))),  # ISO 68-1: 60 degrees
        (Tool(kind="thread", angle=55), lambda h: 2 * h * tan(radians(27.5))),
        (Tool(kind="thread", angle=60, width=3), lambda h: min(2 * h * tan(radians(30)), 3)),
        (Tool(kind="thread", angle=60, cutting_length=2), lambda h: min(2 * h * tan(radians(30)), 2)),
        (Tool(kind="thread", main_angle=87), lambda h: h * (tan(radians(3)) + tan(radians(57)))),
        (Tool(kind="grooving", width=3), lambda h: 3),
        (Tool(kind="grooving", corner=1), lambda h: 2 * sqrt(max(1 - (1 - min(h, 1)) ** 2, 0.0))),
        (Tool(kind="turning"), lambda h: min(h / tan(radians(5)), 12 * cos(radians(5)))),  # its tip runs along the other wall
        (Tool(kind="turning", main_angle=90), lambda h: min(h / tan(radians(5)), 12 * cos(radians(5)))),
    ],
)  # fmt: skip
def test_a_plunge_takes_the_profile_of_the_insert(tool, width_at):
    run = turned(tool, "M3|G97 S500 T1|G94 F100|G00 X30 Z-30|G01 X15")
    assert run.workpiece().removed == pytest.approx(groove(width_at), rel=2e-4) and not run.workpiece().notes


@pytest.mark.parametrize("tool", [Tool(kind="grooving"), Tool(kind="face grooving", angle=60), Tool(kind="mill", corner=0.4)])
def test_a_plunge_without_an_edge_is_said(tool):
    run = turned(tool, "M3|G97 S500 T1|G94 F100|G00 X30 Z-30|G01 X15")
    assert "it cuts nothing" in " ".join(run.workpiece().notes) and "it cuts nothing" in repr(run.collisions())


def test_a_lathe_tool_on_a_mill_has_no_radius():
    run = turned(Tool(kind="grooving", width=3), "T1 S500 M3|G0 X30 Y20 Z5|G1 Z-5 F100", PLATE, "mnc")
    assert run.workpiece().removed == 0 and "T1 (grooving) has no radius: it cuts nothing (program:3)" in run.workpiece().notes


@pytest.mark.parametrize("tool", [Tool(kind="thread"), Tool(kind="thread", angle=60), Tool(kind="thread", angle=60, width=3)])
def test_a_thread_is_cut(tool):
    """One V a turn, 0.5 mm deep at radius 20: 29 turns of a pitch of 2 stand wholly in the bar between Z-1 and Z-59."""
    run = turned(tool, "M3|G97 S100 T1|G00 X19.5 Z3|G32 Z-67 F2")
    one = groove(lambda h: 2 * h * tan(radians(30)), 19.5, 20.0)
    assert run.workpiece().removed == pytest.approx(30 * one, rel=1e-3)


@pytest.mark.parametrize("kind", ["", *LATHE])
def test_picture_and_cut_are_one_outline(kind):
    """Up to 0.5 mm above the tip, below every knee, both cover the same of the plane."""
    for fields in every(INSERTS):
        for lead in (0.0, 2.0):
            tool = as_drawn(Tool(kind=kind, **fields), lead)
            near = shapely.box(-0.7, -0.7, 0.7, 0.7)
            outlines = insert(tool, 2.0), cutting_part(tool, 20.0)
            if edgeless(tool, lathe=True):
                assert [len(each.points) for each in outlines] == [2, 2]  # a line
                continue
            drawn, cut = (shapely.intersection(shapely.Polygon(each.points_within(1e-4)).buffer(0), near) for each in outlines)
            assert shapely.symmetric_difference(drawn, cut).area == pytest.approx(0, abs=2e-3), tool


TURN = "M3|G97 S500 T1|G94 F100|G00 X0 Z5|G01 Z-15"


@pytest.mark.parametrize(("control", "lacks"), [("mnc", "radius"), ("jnc-t01", "kind, nor a corner, an angle or a width")])
@pytest.mark.parametrize("fields", [{"length": 50}, {"pitch": 1}, {"teeth": 4, "name": "end mill"}, {"cutting_length": 10}])
def test_what_a_given_tool_lacks_is_named(fields, control, lacks):
    text, stock = ("T1 S500 M3|G0 X30 Y20 Z5|G1 Z-5 F100", PLATE) if control == "mnc" else (TURN, BAR)
    run = turned(Tool(**fields), text, stock, control)
    said = f"T1 has no {lacks}: it cuts nothing (program:{len(text.split('|'))})"
    assert said in run.workpiece().notes and said in run.collisions().notes


@pytest.mark.parametrize("kind", [each for each in KINDS if each != "probe"])
def test_a_tool_of_the_other_kind_of_machine_is_told(kind):
    """Drills, reamers, countersinks and taps work on both; what has an insert turns, what mills needs a spindle of its own.
    Reamers and taps need a hole, which there is none here."""
    mill = turned(Tool(kind=kind, radius=4), "T1 S500 M3|G0 X30 Y20 Z5|G1 Z-5 F100", PLATE, "mnc").collisions()
    said = f"T1 ({kind}) is a tool of a lathe: it cuts as a mill of its radius (program:3)"
    assert (said in mill.notes) == (kind in LATHE) and mill.ok == (kind not in (*LATHE, "reamer", "tap"))
    lathe = turned(Tool(kind=kind, radius=4), TURN).collisions()
    said = f"T1 ({kind}) is a mill, which on a lathe stands still (program:5)"
    assert (said in lathe.notes) == (kind in ("mill", "face mill", "thread mill", "chamfer"))

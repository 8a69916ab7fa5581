"""SL cycles 14, 20, 22: which area the labels describe, its levels, and that clearing it covers it and nothing else."""

import numpy as np
import pytest
from shapely import LineString, MultiPolygon, Point, Polygon, union_all

import mnclab
from mnclab import Kind, Setup, Tool
from mnclab.controls.tnc_620.contours.area import area_of, labelled_shapes
from mnclab.controls.tnc_620.state import memory
from mnclab.running.cycles import perform
from mnclab.running.interpreter import Interpreter

CIRCLE_A = "LBL 1\nL X+{a} Y+50 RR\nCC X+35 Y+50\nC X+{a} Y+50 DR-\nLBL 0\n"
CIRCLE_B = "LBL 2\nL X+{b} Y+50 {side}\nCC X+65 Y+50\nC X+{b} Y+50 DR-\nLBL 0\n"

#: tnc620-contour, overlapping contours: start of A, start of B, side of B -> area and perimeter [text and derived].
OVERLAPPING = {
    "inclusion": (10, 90, "RR", 3367.872, 221.430),
    "exclusion": (10, 40, "RL", 1404.376, 157.080),
    "intersection": (60, 90, "RR", 559.119, 92.730),
}


def machine_after(text):
    """A machine that has obeyed a program."""
    control = mnclab.controls["tnc-620"]
    program = mnclab.read(text, "tnc-620")
    interpreter = Interpreter(control, Setup(), program)
    interpreter.run()
    return interpreter.machine


@pytest.mark.parametrize("name", OVERLAPPING)
def test_overlapping_contours(name):
    a, b, side, area, perimeter = OVERLAPPING[name]
    labels = CIRCLE_A.format(a=a) + CIRCLE_B.format(b=b, side=side)
    machine = machine_after(f"CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 1/2\nM2\n{labels}")
    machine.ended = False
    region = area_of(machine, *perform(machine, "", labelled_shapes(machine, memory(machine).contour)))
    assert region.area == pytest.approx(area, abs=1e-3)
    assert sum(loop.length for loop in region.loops) == pytest.approx(perimeter, abs=1e-3)
    assert machine.tip == (0, 0, 0) and not machine.recorder.rows  # nothing has moved


def data(**changes):
    """Cycle 20 and 22 blocks with some values changed."""
    values = dict(
        Q1=-10, Q2=0.8, Q3=0.5, Q4=0.2, Q5=0, Q6=2, Q7=50, Q8=0, Q9=1, Q10=5, Q11=100, Q12=350, Q19=0, Q208=9999
    )
    values |= changes
    first = "\n".join(f"Q{k}={values[f'Q{k}']:+g}" for k in range(1, 10))
    second = "\n".join(f"{k}={values[k]:+g}" for k in values if int(k[1:]) >= 10)
    return f"CYCL DEF 20 CONTOUR DATA\n{first}\nCYCL DEF 22 ROUGH-OUT\n{second}\n"


#: A pocket 80 x 80 with one rounded corner (R15), an island of radius 15 in its middle.
LABELS = """LBL 1
L X+10 Y+10 RR
L Y+90
RND R15
L X+90
L Y+10
L X+10
LBL 0
LBL 2
L X+35 Y+50 RL
CC X+50 Y+50
C X+35 Y+50 DR-
LBL 0
"""


def pocket(labels="1/2", head="TOOL CALL 1 Z S2000\nL Z+100 R0 FMAX M3\n", between="", **changes):
    contour = f"CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL {labels}\n"
    return f"{head}{contour}{data(**changes)}{between}CYCL CALL\nL Z+100 R0 FMAX M2\n{LABELS}"


def drawn(island=True):
    """The pocket as a fine polygon, from its numbers."""
    corner = [(25 + 15 * np.cos(a), 75 + 15 * np.sin(a)) for a in np.linspace(np.pi, np.pi / 2, 400)]
    area = Polygon([(10, 10), *corner, (90, 90), (90, 10)])
    return area - Point(50, 50).buffer(15, 400) if island else area


def swept(path, level, radius):
    """What the tool covers at a depth."""
    at = (np.abs(path.end[:, 2] - level) < 1e-9) & (np.abs(path.start[:, 2] - level) < 1e-9) & path.is_motion
    discs = []
    for row in np.flatnonzero(at):
        xyz, _ = path[row : row + 1].points(1e-4)
        discs.append(LineString(xyz[:, :2]).buffer(radius, 64))
    return union_all(discs)


def test_pocket_with_an_island_is_cleared_at_every_level():
    run = mnclab.run(pocket(), "tnc-620", Setup(tools={1: Tool(radius=5)}))
    assert run.ok, run.alarms
    path = run.toolpath
    # levels z = Q5 - min(k Q10, |Q1| - Q4): -5 and -9.8
    plunges = path[(path.kind == Kind.LINE) & (path.feed == 100)]
    assert sorted(set(np.round(plunges.end[:, 2], 9))) == [-9.8, -5]
    reachable = drawn().buffer(-5.5, 64).buffer(5, 64)  # the tool, less the allowance for side
    for level in (-5, -9.8):
        cut = swept(path, level, 5)
        assert cut.intersection(reachable).area >= 0.999 * reachable.area
        assert cut.difference(drawn().buffer(-0.5 + 1e-3, 64)).area < 1e-2  # allowance left to a micrometre
        assert cut.hausdorff_distance(reachable) < 5e-3
    heights = path.end[path.is_motion, 2]
    assert heights[-3:].tolist() == [50, 100, 100]  # Q7 at the end, then where the tool stood before
    feeds = set(np.round(path.feed[path.kind == Kind.ARC], 6))
    assert feeds == {350}


def test_walls_are_climbed_or_cut_up():
    """Q9 = +1 climb: along the wall counter-clockwise, round the island clockwise; -1 the reverse."""
    for sense in (1, -1):
        path = mnclab.run(pocket(Q9=sense), "tnc-620", Setup(tools={1: Tool(radius=5)})).toolpath
        arcs = path[(path.kind == Kind.ARC) & (np.hypot(*(path.centre - (50, 50, 0))[:, :2].T) < 1e-6)]
        arcs = arcs[np.abs(np.hypot(*(arcs.end - arcs.centre)[:, :2].T) - 20.5) < 1e-6]
        assert len(arcs) and (np.sign(arcs.sweep) == -sense).all()


def test_a_depth_of_0_is_cleared_at_the_surface():
    """8.4: unlike the trains and slots, the cycles 21 to 24 are executed at depth 0."""
    path = mnclab.run(pocket(Q1=0, Q4=0, Q5=3), "tnc-620", Setup(tools={1: Tool(radius=5)})).toolpath
    assert {3} == set(path.end[path.feed == 350][:, 2]) == set(path.end[path.feed == 100][:, 2])


def test_one_level_where_the_infeed_is_deeper():
    path = mnclab.run(pocket(Q10=20, Q4=0), "tnc-620", Setup(tools={1: Tool(radius=5)})).toolpath
    assert path.end[:, 2].min() == -10 and len(set(path.end[path.feed == 100][:, 2])) == 1


def test_q_parameters_count_at_the_call():
    """Q1 between definition and call: the depth is that of the call."""
    path = mnclab.run(pocket(between="9 Q1 = -4\n", Q4=0), "tnc-620", Setup(tools={1: Tool(radius=5)})).toolpath
    assert path.end[:, 2].min() == -4


def test_a_recorded_contour_may_compute_and_the_tool_does_not_move():
    """Q writes of the label stay; the first row of the cycle starts where the tool stood."""
    labels = LABELS.replace("LBL 1\n", "LBL 1\nQ50 = 7\n")
    text = pocket().replace(LABELS, labels)
    run = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=5)}))
    assert run.variables["Q50"] == 7
    first = run.toolpath[run.toolpath.is_motion][1]
    assert first.start.tolist() == [0, 0, 100] and first.end.tolist() == [0, 0, 50]
    positions = {tuple(p) for p in run.history["position"]}
    assert (10.0, 90.0, 0.0) not in positions


def test_a_modal_call_calls_nothing_within_the_contour():
    """M89: the cycle runs at its two positions, and not in the blocks of its own labels."""
    positions = "L X+0 Y+0 R0 FMAX M89\nL X+5 FMAX M99\n"
    run = mnclab.run(pocket().replace("CYCL CALL\n", positions), "tnc-620", Setup(tools={1: Tool(radius=5)}))
    once = mnclab.run(pocket(), "tnc-620", Setup(tools={1: Tool(radius=5)})).toolpath
    assert run.ok, run.alarms
    assert run.toolpath[run.toolpath.feed == 350].length == pytest.approx(2 * once[once.feed == 350].length)


def test_the_contour_turns_with_the_frame():
    """Cycle 7 and 10 before the call: the same area, shifted and turned."""
    turned = "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+200\nCYCL DEF 10.0 ROT\nCYCL DEF 10.1 ROT+30\n"
    plain, moved = (
        mnclab.run(pocket(between=text), "tnc-620", Setup(tools={1: Tool(radius=5)})).toolpath for text in ("", turned)
    )
    c, s = np.cos(np.radians(30)), np.sin(np.radians(30))
    at = (plain.kind == Kind.LINE) | (plain.kind == Kind.ARC)
    expected = plain.end[at][:, :2] @ np.array([[c, s], [-s, c]]) + (200, 0)
    assert np.allclose(moved.end[at][1:-1, :2], expected[1:-1], atol=1e-9)
    assert np.allclose(plain.sweep[at], moved.sweep[at], atol=1e-9)


REFUSED = [
    (dict(labels="1/9"), "CYCL DEF 14 LBL (label numbers of the contour) names label 9, which does not exist"),
    (dict(Q2=0), "CYCL DEF 20 Q2 (path overlap factor) must be at least 0.0001 and at most 1.9999, got 0"),
    (dict(Q7=1), "CYCL DEF 20 Q7 (clearance height) must not lie below Q5 + Q6 = 2, got 1"),
    (dict(Q9=0), "CYCL DEF 20 Q9 (direction of machining) must be one of -1, 1, got 0"),
    (dict(Q10=0), "CYCL DEF 22 Q10 (infeed per cut) must not be 0"),
    (dict(Q208=100000), "CYCL DEF 22 Q208 (retraction feed rate) must be at most 99999.9999 or FMAX, got 100000"),
    (dict(Q12=0), "CYCL DEF 22 Q12 (feed rate for roughing) must be greater than 0 to mill with, got 0"),
    (dict(labels="2"), "the contour has no pocket"),
]


@pytest.mark.parametrize(("changes", "message"), REFUSED, ids=[m[:40] for _, m in REFUSED])
def test_refused(changes, message):
    run = mnclab.run(pocket(**changes), "tnc-620")
    alarms = [alarm for alarm in run.alarms if alarm.severity == "alarm"]
    assert message in alarms[0].message and alarms[0].span is not None


def test_a_tool_too_large_is_refused():
    run = mnclab.run(pocket(), "tnc-620", Setup(tools={1: Tool(radius=40)}))
    assert "does not fit" in run.alarms[0].message and run.alarms[0].hint == "take a smaller tool"


def test_a_call_without_contour_is_refused():
    run = mnclab.run("TOOL CALL 1 Z S100\nL Z+9 FMAX M3\n" + data() + "CYCL CALL\n", "tnc-620")
    assert "needs a contour: CYCL DEF 14" in run.alarms[0].message


def test_multipolygons_are_two_plunges():
    """A 20 mm neck is too narrow for a tool of radius 15: two pieces, each with its own plunge (PGM C20, coarse tool)."""
    corners = ("X+60", "Y+20", "X+100", "Y+0", "X+160", "Y+60", "X+100", "Y+40", "X+60", "Y+60", "X+0", "Y+0")
    neck = "LBL 1\nL X+0 Y+0 RL\n" + "".join(f"L {corner}\n" for corner in corners) + "LBL 0\n"
    text = pocket(labels="1", Q3=0, Q4=0, Q10=20).replace(LABELS, neck)
    run = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=15)}))
    assert run.ok, run.alarms
    plunges = run.toolpath[(run.toolpath.kind == Kind.LINE) & (run.toolpath.feed == 100)]
    assert len(plunges) == 2 and isinstance(swept(run.toolpath, -10, 15), MultiPolygon | Polygon)
    assert sorted(x < 80 for x in plunges.end[:, 0]) == [False, True]


# --- transformations in the labels (8.2) ----------------------------------------------------------------------------

TURN, SHIFT = "CYCL DEF 10.0 R\nCYCL DEF 10.1 {}\n", "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 {}\n"
OBLONG = "LBL {n}\n{inner}L X{x:+d} Y-10 RR\nL Y+10\nL IX+40\nL Y-10\nL X{x:+d}\nLBL 0\n"


def cleared(outer, *inner):
    """Bounds (x, y), (x, y) of what is cut of oblongs 40 x 20 with a tool of radius 5; the second lies 100 farther along X."""
    labels = "".join(OBLONG.format(n=k + 1, inner=text, x=100 * k - 20) for k, text in enumerate(inner))
    numbers = "/".join(str(k + 1) for k in range(len(inner)))
    contour = f"CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL {numbers}\n{outer}"
    head = "TOOL CALL 1 Z S2000\nL Z+100 R0 FMAX M3\n"
    text = f"{head}{contour}{data(Q3=0, Q4=0)}CYCL CALL\nL Z+100 R0 FMAX\nL X+1 Y+0 FMAX\nM2\n{labels}"
    run = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=5, plunge_angle=90)}))
    assert run.ok, run.alarms
    path = run.toolpath[(run.toolpath.kind == Kind.LINE) & (run.toolpath.end[:, 2] < 0)]
    return path.bounds[:, :2].round(6).tolist(), run.toolpath.end[-1, :2].round(6).tolist()


@pytest.mark.parametrize(
    ("outer", "inner", "centre", "upright", "last"),
    [
        ("", "", (0, 0), False, (1, 0)),
        ("", TURN.format("IROT+90"), (0, 0), True, (1, 0)),
        ("", TURN.format("ROT+90"), (0, 0), True, (1, 0)),
        ("", 2 * TURN.format("IROT+45"), (0, 0), True, (1, 0)),
        (TURN.format("ROT+30"), TURN.format("IROT+60"), (0, 0), True, (0.866025, 0.5)),  # added to what is active
        (TURN.format("ROT+30"), TURN.format("ROT+90"), (0, 0), True, (0.866025, 0.5)),  # in its place
        (TURN.format("IROT+90"), TURN.format("IROT-90"), (0, 0), False, (0, 1)),
        (SHIFT.format("X+5"), SHIFT.format("IX+7"), (12, 0), False, (6, 0)),
        (SHIFT.format("X+5"), SHIFT.format("X+7"), (7, 0), False, (6, 0)),
        (SHIFT.format("Y+5"), TURN.format("IROT+90"), (0, 5), True, (1, 5)),
    ],
)
def test_a_transformation_in_a_label(outer, inner, centre, upright, last):
    """It acts on the contour as it would on a motion; after the call that of before the call is back."""
    (low, high), end = cleared(outer, inner)
    half = np.array([10 - 5, 20 - 5] if upright else [20 - 5, 10 - 5])
    assert low == pytest.approx(centre - half) and high == pytest.approx(centre + half)
    assert end == pytest.approx(last)


def test_a_transformation_in_a_label_acts_in_the_next_one():
    """Turned by 90 degrees, the second oblong lies 100 farther along Y; a further IROT turns it back to X."""
    assert cleared("", TURN.format("IROT+90"), "")[0] == [[-5, -15], [5, 115]]
    assert cleared("", TURN.format("IROT+90"), TURN.format("IROT-90"))[0] == [[-5, -15], [115, 15]]


# --- contours of another program ----------------------------------------------------------------------------------------

HERE = f"CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 1\n{data(Q19=0)}"
SQUARE = "LBL 1\nL X+{0} Y+{0} {1}\nL Y+{2}\nL X+{2}\nL Y+{0}\nL X+{0}\nLBL 0\n"
ROUTE = "BEGIN PGM {0} {1}\n{2}END PGM {0} {1}\n"
START = "TOOL CALL 1 Z S2000\nL Z+100 R0 FMAX M3\n"


def bounds_of_pocket(main, sub, unit="MM"):
    """Of what a tool of radius 5 cuts at feed 350 with 0.5 mm for the side."""
    files = {"SUB": ROUTE.format("SUB", unit, sub)}
    text = ROUTE.format("MAIN", "MM", START + main)
    run = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=5)}, files=files))
    assert run.ok, run.alarms
    cut = run.toolpath[run.toolpath.feed == 350]
    return [cut.end[:, :2].min() - 5.5, cut.end[:, :2].max() + 5.5]


def test_labels_of_a_contour_are_those_of_the_program_that_defines_it():
    """Both programs have a label 1: the pocket 10 to 50 of the main program is cut by the call in the other, and back."""
    ours, theirs = SQUARE.format(10, "RR", 50), SQUARE.format(20, "RR", 90)
    called_there = bounds_of_pocket(
        f"{HERE}CALL PGM SUB\nM2\n{ours}", f"CYCL CALL\nFN 9: IF 0 EQU 0 GOTO LBL 2\n{theirs}LBL 2\n"
    )
    assert called_there == pytest.approx([10, 50])
    defined_there = bounds_of_pocket(
        f"CALL PGM SUB\nCYCL CALL\nM2\n{ours}", f"{HERE}FN 9: IF 0 EQU 0 GOTO LBL 2\n{theirs}LBL 2\n"
    )
    assert defined_there == pytest.approx([20, 90])


def test_lines_of_a_contour_in_another_program_are_told_there():
    text = ROUTE.format("MAIN", "MM", START + "CALL PGM SUB\nCYCL CALL\n")
    sub = ROUTE.format("SUB", "MM", HERE + "FN 9: IF 0 EQU 0 GOTO LBL 2\nLBL 1\nL X+1 Y+1 RR\nL X+Q77\nLBL 0\nLBL 2\n")
    run = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=5)}, files={"SUB": sub}))
    (alarm,) = run.alarms
    line = sub.splitlines().index("L X+Q77") + 1
    assert alarm.message == "no value was given to Q77" and alarm.span[:2] == (line, 5) and alarm.span.program == 1


def test_a_contour_in_inches_for_a_program_in_mm():
    """Its lengths are inches, of parameters too; depths and clearances were given in mm by the program that calls."""
    labels = "LBL 1\nQ50 = 1\nL X+Q50 Y+Q50 RR\nL Y+3\nL X+3\nL Y+1\nL X+1\nLBL 0\nLBL 2\n"
    sub = f"CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 1\nFN 9: IF 0 EQU 0 GOTO LBL 2\n{labels}"
    assert bounds_of_pocket(f"CALL PGM SUB\n{data()}CYCL CALL\n", sub, "INCH") == pytest.approx([25.4, 3 * 25.4])

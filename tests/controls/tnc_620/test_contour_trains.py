"""Cycles 25, 270 and 276: the manual's examples with the catalogue's numbers, and closed forms for all that they say."""

import math

import numpy as np
import pytest
from tools.running import labels

import mnclab
from mnclab import Kind, Setup, Tool

TOOLS = {1: Tool(radius=5, number=1), 2: Tool(radius=12, number=2, name="COARSE"), 3: Tool(radius=10, number=3)}
CORNER = "L X+10 Y+10 RL\nL X+50\nL Y+50"
VALUES = dict(Q1=-10, Q3=0, Q5=0, Q7=50, Q10=10, Q11=100, Q12=350, Q15=1, Q18=0, Q446=0.01, Q447=10, Q448=2)


def program(contour, cycle=25, before="", call="CYCL CALL", tool=1, unit="MM", **changes):
    """A train along the contour of label 1; the program stands at X0 Y0 Z100."""
    values = {address: value for address, value in (VALUES | changes).items() if value is not None}
    if cycle == 276:
        values.pop("Q5", None)
    words = "\n".join(f"  {address}={value}" for address, value in values.items())
    return (
        f"BEGIN PGM A {unit}\nTOOL CALL {tool} Z S2000 F400\nL X+0 Y+0 Z+100 R0 FMAX M3\n{before}"
        f"CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 1\nCYCL DEF {cycle} TRAIN\n{words}\n{call}\n"
        f"L Z+100 R0 FMAX M30\nLBL 1\n{contour}\nLBL 0\nEND PGM A {unit}\n"
    )


def data(approach, side, radius=3, angle=45, distance=2):
    words = f"  Q390={approach}\n  Q391={side}\n  Q392={radius}\n  Q393={angle}\n  Q394={distance}\n"
    return f"CYCL DEF 270 CONTOUR TRAIN DATA\n{words}"


def run(contour, cycle=25, ok=True, tools=TOOLS, settings=(), **changes):
    found = mnclab.run(program(contour, cycle, **changes), "tnc-620", Setup(tools=tools, settings=dict(settings)))
    assert found.ok is ok, found.alarms
    return found


def cut(found):
    """The rows of the cycle at the feed of milling, 350 mm/min."""
    path = found.toolpath
    return path[(path.feed == 350) & [label.startswith("CYCL DEF") for label in labels(path)]]


def ends(found):
    return cut(found).end


def said(found):
    return [alarm.message for alarm in found.alarms]


# --- the examples ----------------------------------------------------------------------------------------------------

C25 = """0 BEGIN PGM C25 MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-40
2 BLK FORM 0.2 X+100 Y+100 Z+0
3 TOOL CALL 3 Z S2000
4 L Z+250 R0 FMAX
5 CYCL DEF 14.0 CONTOUR GEOMETRY
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 CONTOUR TRAIN
  Q1=-20 ;MILLING DEPTH
  Q3=+0 ;ALLOWANCE FOR SIDE
  Q5=+0 ;SURFACE COORDINATE
  Q7=+250 ;CLEARANCE HEIGHT
  Q10=5 ;PLUNGING DEPTH
  Q11=100 ;FEED RATE FOR PLNGNG
  Q12=200 ;FEED RATE F. ROUGHNG
  Q15=+1 ;CLIMB OR UP-CUT
  Q446=0.01 ;RESIDUAL MATERIAL
  Q447=+10 ;CONNECTION DISTANCE
  Q448=+2 ;PATH EXTENSION
8 CYCL CALL M3
9 L Z+250 R0 FMAX M2
10 LBL 1
11 L X+0 Y+15 RL
12 L X+5 Y+20
13 CT X+5 Y+75
14 L Y+95
15 RND R7.5
16 L X+50
17 RND R7.5
18 L X+100 Y+80
19 LBL 0
20 END PGM C25 MM
"""
#: Of the tool centre on each level: end, sweep in degrees [tnc620-contour, C25].
C25_CENTRE = [
    (-2.071, 27.071, 0), (-2.071, 67.929, 90), (-5, 75, -45), (-5, 87.5, 0), (12.5, 105, -90), (48.899, 105, 0),
    (53.928, 104.262, -16.699), (102.873, 89.578, 0),
]  # fmt: skip


def test_contour_train_of_the_manual():
    found = mnclab.run(C25, "tnc-620", Setup(tools=TOOLS))
    assert found.ok and not found.alarms
    path = found.toolpath
    along = path[path.feed == 200]
    assert len(along) == 4 * len(C25_CENTRE)
    for k, z in enumerate((-5, -10, -15, -20)):
        level = along[slice(k * 8, k * 8 + 8)]
        shown = np.column_stack([level.end[:, :2], np.degrees(level.sweep)])
        assert shown == pytest.approx(np.array(C25_CENTRE), abs=1e-3)
        assert level.start[0] == pytest.approx((-7.071, 22.071, z), abs=1e-3)
        assert (level.end[:, 2] == z).all() and level.length == pytest.approx(192.896, abs=1e-3)
    tops = path[path.kind == Kind.RAPID].end[:, 2]
    assert tops.max() == 250 and (tops >= 2).all()  # rapid to the clearance height, and to 2 mm above the surface
    assert path.end[path.feed == 100, 2].tolist() == [-5, -10, -15, -20]


#: The definitions as the manual prints them, with 10 as tool radius: levels below the contour.
DEFINITIONS = [(25, {"Q15": -1}, [-5, -10, -15, -20]), (276, {"Q10": -5, "Q11": 150}, [-5, -10, -15, -20])]


@pytest.mark.parametrize(("cycle", "changes", "levels"), DEFINITIONS)
def test_definitions_of_the_manual(cycle, changes, levels):
    words = {"Q1": -20, "Q10": 5} | changes
    found = run("L X+0 Y+0 Z+0 RL\nL X+40" if cycle == 276 else "L X+0 Y+0 RL\nL X+40", cycle, tool=3, **words)
    assert ends(found)[:, 2].tolist() == levels
    assert ends(found)[:, 0].tolist() == [0 if cycle == 25 else 40] * 4  # up-cut runs RL backwards


@pytest.mark.parametrize(
    ("approach", "to", "off"),
    [
        (1, (10 - 2.121, 15 + 0.879), (45 - 0.879, 50 + 2.121)),  # [tnc620-contour, example of 270: A = S + (-2.121, 0.879)]
        (2, (10 - 2, 15), (45, 50 + 2)),
        (3, (10, 15 + 2), (45 - 2, 50)),
    ],
)
def test_train_data(approach, to, off):
    found = run(CORNER.replace(" RL", ""), before=data(approach, 1))
    path = cut(found)
    assert path.start[0, :2] == pytest.approx(to, abs=1e-3) and path.end[-1, :2] == pytest.approx(off, abs=1e-3)
    assert path.end[0, :2] == pytest.approx((10, 15)) and path.start[-1, :2] == pytest.approx((45, 50))
    if approach == 1:
        assert path.lengths[[0, -1]] == pytest.approx(3 * math.pi / 4) and path.sweep[0] > 0  # 2.356, counter-clockwise


# --- sense and side --------------------------------------------------------------------------------------------------

FORWARD, BACKWARD = [(45, 15), (45, 50)], [(45, 15), (10, 15)]
OUTSIDE = [(50, 5), (55, 10), (55, 50)]


@pytest.mark.parametrize(
    ("side", "sense", "points"),
    [
        ("RL", 1, FORWARD), ("RL", -1, BACKWARD), ("RR", -1, OUTSIDE), ("RR", 1, [(55, 10), (50, 5), (10, 5)]),
        ("R0", 1, [(50, 10), (50, 50)]),
    ],
)  # fmt: skip
def test_sense_follows_from_the_side(side, sense, points):
    assert ends(run(CORNER.replace("RL", side), Q15=sense))[:, :2] == pytest.approx(np.array(points))


def test_mirror_images_keep_the_sense():
    """In a mirror image the left side is the right one, so climb milling runs the contour backwards."""
    mirrored = run(CORNER, before="CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 X\n")
    assert ends(mirrored)[:, :2] == pytest.approx(np.array([(-45, 15), (-10, 15)]))


def test_turned_and_scaled():
    turned = run(CORNER, before="CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+90\n")
    assert ends(turned)[:, :2] == pytest.approx(np.array([(-15, 45), (-50, 45)]))
    scaled = run(CORNER, before="CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 2\n")
    assert ends(scaled)[:, :2] == pytest.approx(np.array([(95, 25), (95, 100)]))  # the tool stays as large as it is


def test_to_and_fro():
    found = run(CORNER, Q10=4, Q15=0)
    there, back = [(45, 15), (45, 50)], [(45, 15), (10, 15)]
    shown = [(*point, z) for points, z in ((there, -4), (back, -8), (there, -10)) for point in points]
    assert ends(found) == pytest.approx(np.array(shown))
    path = found.toolpath
    assert path.end[path.feed == 100].tolist() == [[10, 15, -4], [45, 50, -8], [10, 15, -10]]


def test_to_and_fro_is_left_where_it_ends():
    found = run(CORNER.replace(" RL", ""), Q10=5, Q15=0, before=data(3, 1))
    assert ends(found)[[0, -1]].tolist() == [[10, 15, -5], [10, 17, -10]]


def test_allowance():
    assert ends(run(CORNER, Q3=1.5))[:, :2] == pytest.approx(np.array([(43.5, 16.5), (43.5, 50)]))
    assert ends(run(CORNER, Q3=-1.5))[:, :2] == pytest.approx(np.array([(46.5, 13.5), (46.5, 50)]))
    beyond = ends(run(CORNER, Q3=-8))[:, :2]  # 3 mm beyond the contour, and as RL climbs: the wall is farther to the right
    assert beyond == pytest.approx(np.array([(50, 7), (53, 10), (53, 50)]))


def test_approach_beyond_the_contour_keeps_away_from_the_wall():
    """Where Q3 takes 8 mm off, the tool of radius 5 runs 3 mm beyond: it comes from the left, the wall is on the right."""
    found = cut(run(CORNER.replace(" RL", ""), Q3=-8, before=data(1, 1, angle=90)))
    assert found.start[0, :2] == pytest.approx((7, 10)) and found.end[-1, :2] == pytest.approx((50, 53))
    assert found.end[:, 1].min() == pytest.approx(7) and found.end[:, 0].max() == pytest.approx(53)


def test_an_inside_arc_as_small_as_the_tool_leaves_nothing():
    found = run("L X+10 Y+10 RL\nL X+50\nRND R5\nL Y+50")
    assert said(found) == [] and ends(found)[:, :2] == pytest.approx(np.array([(45, 15), (45, 50)]))


def test_closed_contours():
    square = "L X+10 Y+10 {side}\nL X+50\nL Y+50\nL X+10\nL Y+10"
    inside = cut(run(square.format(side="RL")))
    assert inside.length == pytest.approx(4 * 30) and inside.start[0, :2] == pytest.approx((15, 15))
    outside = cut(run(square.format(side="RR"), Q15=-1))
    assert outside.length == pytest.approx(4 * 40 + 10 * math.pi) and (outside.end[-1] == outside.start[0]).all()


def test_a_full_circle():
    path = cut(run("CC X+50 Y+50\nL X+50 Y+20 RL\nC X+50 Y+20 DR+"))
    assert path.length == pytest.approx(50 * math.pi) and path.start[0, :2] == pytest.approx((50, 25))


def test_feed_at_the_edge():
    """M110: on an inside arc of 10 the centre of a tool of radius 5 runs half as fast; M109: outside, 3/2 as fast."""
    wave = "L X+10 Y+10 RL\nL X+50\nCR X+60 Y+20 R+10 DR+\nCR X+70 Y+30 R+10 DR-\nL X+90"
    for code, feeds in (("M109", [350, 175, 525, 350]), ("M110", [350, 175, 350, 350])):
        path = run(wave, before=f"L X+0 Y+0 F100 {code}\n").toolpath
        assert path.feed[path.end[:, 2] == -10][1:].tolist() == pytest.approx(feeds)


# --- where the tool goes between --------------------------------------------------------------------------------------


@pytest.mark.parametrize(("setting", "last"), [("before", (0, 0, 100)), ("height", (45, 50, 50))])
def test_position_after_the_cycle(setting, last):
    path = run(CORNER, settings={"position_after_contour": setting}).toolpath
    assert path[path.line == 19].end[-1] == pytest.approx(last)


def test_a_depth_of_0_is_not_executed():
    found = run(CORNER, Q1=0)
    assert not len(cut(found)) and said(found) == ["CYCL DEF 25 Q1 makes a depth of 0: the cycle is not executed"]


def test_upwards():
    assert ends(run(CORNER, Q1=8, Q10=4))[:, 2].tolist() == [4, 4, 8, 8]


def test_inches():
    found = run("L X+1 Y+1 RL\nL X+2", unit="INCH", Q1=-0.5, Q10=0.5, Q7=2, Q11=10, Q12=20)
    path = found.toolpath[np.isclose(found.toolpath.feed, 20 * 2.54)]
    assert path.end == pytest.approx(np.array([(50.8, 30.4, -12.7)]))


def test_at_points_of_a_pattern():
    """The contour stands in coordinates of the program: CYCL CALL POS moves there first, M99 after its own move."""
    found = run(CORNER, call="L X+5 Y+5 R0 FMAX M99")
    assert ends(found)[:, :2] == pytest.approx(np.array(FORWARD))
    assert found.toolpath[found.toolpath.line == 20].end[-1] == pytest.approx((5, 5, 100))


def test_called_twice_is_the_same_twice():
    found = run(CORNER, call="CYCL CALL\nCYCL CALL")
    first, second = np.split(ends(found), 2)
    assert (first == second).all()


def test_data_with_q_parameters_as_they_stand():
    found = run(CORNER.replace(" RL", ""), before=data(3, 1) + "FN 0: Q394 = +7\nFN 0: Q391 = +2\n", Q15=-1)
    assert cut(found).start[0, :2] == pytest.approx((10, 5 - 7))


# --- three dimensions -------------------------------------------------------------------------------------------------

SLOPE = "L X+10 Y+10 Z+0 RL\nL X+50 Z-5\nL Y+50"


def test_heights_of_the_contour():
    assert ends(run(SLOPE, 276, Q1=0)).tolist() == [[45, 15, -5], [45, 50, -5]]


def test_infeeds_below_the_contour():
    found = run(SLOPE, 276, Q1=-7, Q10=5)
    assert ends(found)[:, 2].tolist() == [-10, -10, -12, -12]
    both = run(SLOPE, 276, Q1=-7, Q10=5, Q15=0)
    assert ends(both).tolist() == [[45, 15, -10], [45, 50, -10], [45, 15, -12], [10, 15, -7]]


def test_a_helix_in_the_contour_stays_one():
    path = cut(run("L X+30 Y+0 Z+0 RL\nCC X+0 Y+0\nCP IPA+900 DR+ Z-10", 276, Q1=0))
    assert path.sweep.sum() == pytest.approx(5 * math.pi) and set(path.kind.tolist()) == {Kind.ARC}
    assert np.hypot(*path.end[:, :2].T) == pytest.approx(np.full(len(path), 25))
    assert np.diff(path.end[:, 2]) == pytest.approx(-10 * path.sweep[1:] / (5 * math.pi))


def test_a_sloping_arc_and_a_vertical_step():
    path = cut(run("L X+10 Y+0 Z+0 RL\nL X+40\nL Z-3\nCC X+40 Y+20\nCP IPA+90 DR+ Z-6\nL Y+40", 276, Q1=0))
    shown = np.array([(40, 5, 0), (40, 5, -3), (55, 20, -6), (55, 40, -6)])
    assert path.end == pytest.approx(shown) and path.sweep[2] == pytest.approx(math.pi / 2)


def test_rapid_ends_above_the_highest_place():
    """Without infeeds nobody knows where the material begins: the tool comes down at the plunging feed."""
    plunged = run(SLOPE, 276, Q1=0).toolpath
    assert plunged.start[plunged.feed == 100, 2].tolist() == [50]
    stepped = run("L X+10 Y+10 Z-5 RL\nL X+50 Z+4\nL Y+50", 276, Q1=-5, Q10=5).toolpath
    assert stepped.start[stepped.feed == 100, 2].tolist() == [6]


# --- APPR and DEP in the contour --------------------------------------------------------------------------------------

LEADS = "L X-20 Y+30 R0\nAPPR LT X+10 Y+10 LEN8 RL\nL X+50\nL Y+50\nDEP LN LEN+6"


def test_leads_of_the_contour():
    path = cut(run(LEADS))
    assert path.start[0, :2] == pytest.approx((-20, 30))
    assert path.end[:, :2] == pytest.approx(np.array([(2, 15), (10, 15), (45, 15), (45, 50), (39, 50)]))


def test_leads_backwards():
    path = cut(run(LEADS, Q15=-1))
    assert path.start[0, :2] == pytest.approx((39, 50))
    assert path.end[:, :2] == pytest.approx(np.array([(45, 50), (45, 15), (10, 15), (2, 15), (-20, 30)]))


def test_leads_have_heights():
    contour = "L X-20 Y+30 Z+3 R0\nAPPR LT X+10 Y+10 Z-4 LEN8 RL\nL X+50 Z-6\nL Y+50\nDEP LT Z+2 LEN+6"
    path = cut(run(contour, 276, Q1=0))
    shown = np.array([(2, 15, -4), (10, 15, -4), (45, 15, -6), (45, 50, -6), (45, 56, 2)])
    assert path.start[0] == pytest.approx((-20, 30, 3)) and path.end == pytest.approx(shown)


def test_cycle_270_counts_more_than_the_contour():
    found = run(LEADS, before=data(3, 2), Q15=-1)
    assert cut(found).start[0, :2] == pytest.approx((10, 3))
    assert said(found) == [
        "CYCL DEF 25 takes the radius compensation from Q391 of cycle 270: RL or RR of the contour does not count",
        "CYCL DEF 25 takes approach and departure from cycle 270: APPR and DEP of the contour do not count",
    ]


# --- what the tool does not reach, what another one left --------------------------------------------------------------

GROOVE = "L X+0 Y+0 RL\nL X+36\nL Y-3\nL X+44\nL Y+0\nL X+80"


@pytest.mark.parametrize("cycle", [25, 276])
def test_what_has_no_room_is_left_and_told(cycle):
    """A groove 8 wide and 3 deep: a disc of radius 5 sinks 2 into it, and stays hypot(4, 6) - 5 off its corners."""
    found = run(GROOVE if cycle == 25 else GROOVE.replace("RL", "Z+0 RL"), cycle)
    assert ends(found)[:, :2] == pytest.approx(np.array([(36, 5), (40, 3), (44, 5), (80, 5)]))
    (message,) = said(found)
    assert f"leaves material up to {math.hypot(4, 6) - 5:.3f} mm thick" in message


@pytest.mark.parametrize("given", [{"Q18": 2}, {"Q18": None, "QS18": '"coarse"'}])
def test_rest_of_a_coarse_tool(given):
    """The tool of radius 12 leaves more than 0.01 up to 12 - sqrt(2·12·0.01 + 0.01²) from the corner; 2 mm more are run."""
    reach = 12 - math.sqrt(0.24 + 1e-4) + 2
    path = cut(run(CORNER, **given))
    assert path.start[0, :2] == pytest.approx((50 - reach, 15)) and path.end[-1, :2] == pytest.approx((45, 10 + reach))


def test_rests_that_are_far_apart_are_cut_one_by_one():
    zigzag = "L X+0 Y+0 RL\nL X+60\nL Y+60\nL X+0"
    for connected, runs in ((30, 2), (60, 1)):
        path = run(zigzag, Q18=2, Q447=connected).toolpath
        assert (path.feed == 100).sum() == runs
    found = run(zigzag, Q18=2, Q446=9)
    assert not len(cut(found)) and "finds nothing thicker than Q446 = 9" in said(found)[0]


def test_rest_in_three_dimensions():
    """As high as the contour at the same place: 10 - 14 · s / 40 along its first element, s from its beginning."""
    path = cut(run("L X+10 Y+10 Z+10 RL\nL X+50 Z-4\nL Y+50", 276, Q1=0, Q18=2, Q448=0))
    reach = 12 - math.sqrt(0.24 + 1e-4)
    assert path.start[0] == pytest.approx((50 - reach, 15, 10 - 14 * (40 - reach) / 35))


# --- faults inside the contour ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("contour", "changes", "line", "message"),
    [
        ("L X+0 Y+0 RL\nL X+40\nL Y+40\nL X+20\nL Y-20", {}, 26, "the contour crosses itself"),
        ("CC X+30 Y+30\nL X+30 Y+26 RL\nC X+30 Y+26 DR+", {}, 24, "the inside arc of radius 4 is not greater"),
        ("L X+0 Y+0 RL\nL X+40 RR", {}, 23, "the contour of label 1 changes from RL to RR or back in this block"),
        ("L X+0 Y+0 RL", {}, 22, "label 1 describes no contour"),
        ("L X+10 Y+10\nL X+50\nL Y+50\nL X+10", {"before": data(3, 1, distance=36)}, 25, "the approach leads the tool"),
        ("APPR LCT X+10 Y+10 R5 RL\nL X+50", {}, 22, "APPR LCT needs a starting point"),
        ("L X+10 Y+40 R0\nAPPR LN X+10 Y+10 LEN5 RR\nL X+50", {"Q15": -1}, 23, "the approach leads the tool into the contour"),
    ],
)
def test_faults_stand_where_they_are(contour, changes, line, message):
    found = run(contour, ok=False, **changes)
    (fault,) = [alarm for alarm in found.alarms if alarm.severity == "alarm"]
    assert message in fault.message and fault.span.line == line

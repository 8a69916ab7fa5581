"""What an insert covers along a line and an arc, against very many of it laid side by side by shapely; and symmetries."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from t3_workpiece.lathe import BAR, NOSED, SHARP, turned

from mnclab.path.inserts import cutting_part
from mnclab.path.tool import Tool
from mnclab.workpiece.blank import cylinder
from mnclab.workpiece.turning.section import along_arc, along_line, edges

FINE = 1e-6
TOOLS = (
    NOSED,
    SHARP,
    Tool(kind="turning", corner=0.4, main_angle=93, auxiliary_angle=52),
    Tool(kind="turning", corner=2.0),
    Tool(kind="turning", corner=0.8, main_angle=95, auxiliary_angle=5, hand="left"),
    Tool(kind="boring", corner=0.4, main_angle=95, auxiliary_angle=30),
    Tool(kind="grooving", width=3, corner=0.5),
    Tool(kind="grooving", width=4),
    Tool(kind="thread", main_angle=60, auxiliary_angle=60, corner=0.1),
    Tool(kind="drill", radius=4, angle=118),
)
angles = st.floats(-math.pi, math.pi)
lengths = st.floats(0.1, 8)


def area_of(contour):
    return shapely.Polygon(contour.points_within(FINE))


def laid(tool, places, fine=FINE):
    """The hulls of the tool in neighbouring places."""
    shape = cutting_part(tool, 9).points_within(fine)
    corners = np.asarray(places)[:, None] + shape
    return shapely.union_all(shapely.convex_hull(shapely.multipoints(np.hstack([corners[:-1], corners[1:]]))))


@settings(max_examples=30, deadline=None)
@given(st.sampled_from(TOOLS), angles, lengths)
def test_a_line(tool, direction, length):
    end = length * math.cos(direction), length * math.sin(direction)
    found = along_line(edges(cutting_part(tool, 9)), (0.0, 0.0), end)
    wanted = laid(tool, [(0.0, 0.0), end])
    assert found.area > 0 and shapely.symmetric_difference(area_of(found), wanted).area < 1e-4
    assert found.area == pytest.approx(wanted.area, abs=1e-4)


@pytest.mark.deep
@settings(max_examples=40, deadline=None)
@given(st.sampled_from(TOOLS), angles, lengths, st.floats(0.05, 4.5), st.sampled_from((-1, 1)))
def test_an_arc(tool, first, radius, sweep, sense):
    turns = first + sense * np.linspace(0, sweep, 200)
    places = radius * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    body = edges(cutting_part(tool, 9))
    pieces = along_arc(body, tuple(places[0]), tuple(places[-1]), sense * sweep, (0.0, 0.0))
    found = shapely.union_all([shapely.make_valid(area_of(piece)) for piece in pieces])
    chords = radius * (sweep / 199) ** 2 / 8 * 30  # what the chords of the way leave out, along some 30 mm
    assert shapely.symmetric_difference(found, laid(tool, places, 1e-4)).area < 2e-3 + chords


@pytest.mark.parametrize("tool", TOOLS)
def test_a_contour_is_convex_and_touches_its_tip(tool):
    contour = cutting_part(tool, 9)
    points = contour.points_within(FINE)[:-1]
    assert shapely.Polygon(points).area == pytest.approx(shapely.convex_hull(shapely.MultiPoint(points)).area, abs=1e-9)
    low, high = contour.bounds
    assert contour.area > 0 and (high[1] if tool.kind == "boring" else low[1]) == pytest.approx(
        -tool.radius if tool.kind == "drill" else 0, abs=1e-12
    )
    if tool.kind == "turning":
        assert (high[0] if tool.hand == "left" else low[0]) == pytest.approx(0, abs=1e-12)


WAYS = st.lists(st.tuples(st.floats(-50, 4).map(lambda z: round(z, 3)), st.floats(2, 40).map(lambda r: round(r, 3))),
                min_size=2, max_size=8, unique=True)  # fmt: skip


@settings(max_examples=40, deadline=None)
@given(st.sampled_from(TOOLS[:5]), WAYS, st.floats(-100, 100))
def test_a_shift_in_z_and_a_way_backwards_change_nothing(tool, way, shift):
    here = turned(tool, *way)
    there = turned(tool, *((z + shift, r) for z, r in way), stock=BAR.moved((0, 0, shift)))
    back = turned(tool, *way[::-1])
    assert there.volume == pytest.approx(here.volume, rel=1e-7)
    assert back.volume == pytest.approx(here.volume, rel=1e-7)
    assert here.removed_by_row().sum() == pytest.approx(here.removed, rel=1e-9, abs=1e-6)
    assert here.removed_by_row().min() >= 0


@settings(max_examples=40, deadline=None)
@given(st.sampled_from(TOOLS[:4]), WAYS)
def test_the_section_is_that_of_polygons(tool, way):
    """Hulls by shapely with chords of 1e-6, subtracted one after the other; of what is left what hangs on the chuck."""
    shape = cutting_part(tool, 60).points_within(FINE)
    left = shapely.box(-60, 0, 0, 30)
    for start, end in zip(way, way[1:]):
        hull = shapely.convex_hull(shapely.multipoints(np.vstack([shape + start, shape + end])))
        if hull.geom_type == "Polygon":
            left = shapely.difference(left, hull)
    left = max(shapely.get_parts(left), key=lambda piece: (piece.bounds[0] <= -60, piece.area))
    part = turned(tool, *way)
    loops = [shapely.Polygon(loop.points_within(FINE)) for loop in part.section]
    found = shapely.union_all([p for p, loop in zip(loops, part.section) if loop.area > 0])
    for hole in (p for p, loop in zip(loops, part.section) if loop.area < 0):
        found = shapely.difference(found, hole)
    assert shapely.symmetric_difference(found, left).area < 1e-3
    assert found.area == pytest.approx(left.area, abs=2e-4)


def test_mirrored_at_the_axis():
    """Facing past the centre by 2 cuts what facing does that stops there, and what the far side meets."""
    part = turned(NOSED, (-3, 32), (-3, -2), (-3, 5))
    assert [loop.area for loop in part.section] == [pytest.approx(57 * 30)]
    drill = Tool(kind="drill", radius=4, angle=118)
    assert turned(drill, (3, 0), (-20, 0)).volume == pytest.approx(turned(drill, (-20, 0), (3, 0)).volume)


def test_a_main_edge_that_leans_back_takes_a_deep_cut_as_well():
    """117.5 degrees on a bar of 60: the wall leans by 27.5 degrees, and in front of the insert nothing is left."""
    vee = Tool(number=1, kind="turning", main_angle=117.5, auxiliary_angle=27.5)
    part = turned(vee, (2, 20), (-50, 20), stock=cylinder(60, -80, 0))
    lean = math.tan(math.radians(27.5))
    wall = 2 * math.pi * lean * ((60**3 - 20**3) / 3 - 10 * (60**2 - 20**2))  # between Z-50 and the leaning wall
    wanted = math.pi * (20**2 * 80 + (60**2 - 20**2) * 30) + wall
    assert part.volume == pytest.approx(wanted, rel=1e-9)
    assert part.at([-1.0, -20.0]) == pytest.approx([20, 20])


def test_a_boring_bar_takes_the_wedge_under_its_edge_wherever_its_row_begins():
    """Out of a bore of 4 to 12 at 30 degrees: the auxiliary edge, 12 long, leaves a cone from its tip down to the bore."""
    bar = Tool(number=5, kind="boring", main_angle=90, auxiliary_angle=30)
    part = turned(bar, (-20, 3), (-20, 9), stock=cylinder(14, -40, 0, bore=4))
    long = 5 / math.tan(math.radians(30))
    wanted = math.pi / 3 * long * (9**2 + 9 * 4 + 4**2) - math.pi * 4**2 * long
    assert part.removed == pytest.approx(wanted, rel=1e-9)

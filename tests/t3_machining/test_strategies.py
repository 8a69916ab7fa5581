"""Every strategy on many areas, judged by shapely alone: what swept discs cover, and what they must not touch."""

import numpy as np
import pytest
import shapely

from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.machining.milling.clearing import begin, end
from mnclab.machining.milling.entries import Entry, toolpath
from mnclab.machining.milling.strategies import STRATEGIES, clear
from mnclab.path.toolpath import Kind

pytestmark = pytest.mark.deep


def star(seed):
    """A star with 5 to 8 arms, some of its sides bent, from a seed."""
    rng = np.random.default_rng(seed)
    count = 2 * int(rng.integers(5, 9))
    reach = np.where(np.arange(count) % 2, rng.uniform(18, 24, count), rng.uniform(32, 45, count))
    angle = 2 * np.pi * (np.arange(count) + rng.uniform(-0.2, 0.2, count)) / count
    bulge = np.where(rng.random(count) < 0.5, rng.uniform(-0.15, 0.25, count), 0.0)
    return Region.of(Contour(np.stack([reach * np.cos(angle), reach * np.sin(angle)], axis=1), bulge))


ISLANDS = (Contour.circle((25, 25), 9), rectangle(20, 20, centre=(70, 25)), Contour.circle((50, 58), 12))
OUTER = rectangle(100, 80, 6, centre=(50, 40))
NECK = [(0, 0), (30, 0), (30, 15), (45, 15), (45, 0), (75, 0), (75, 40)]  # 10.45 wide: the tool of 5 just passes
NECK += [(45, 40), (45, 25.45), (30, 25.45), (30, 40), (0, 40)]
AREAS = {
    "rectangle": Region.of(rectangle(60, 40)),
    "circle": Region.of(Contour.circle((5, 3), 27)),
    "L": Region.of(Contour([(0, 0), (60, 0), (60, 25), (25, 25), (25, 60), (0, 60)])),
    "one island": Region.of(OUTER, holes=ISLANDS[:1]),
    "two islands": Region.of(OUTER, holes=ISLANDS[:2]),
    "three islands": Region.of(OUTER, holes=ISLANDS),
    "narrow": Region.of(Contour(NECK)),
    "star 1": star(1),
    "star 2": star(2),
    "star 3": star(3),
}
TOOLS = [(5.0, 0.4), (3.0, 0.5), (5.0, 0.25)]  # radius and overlap
CASES = [
    pytest.param(area, name, *tool, id=f"{area}-{name}-{tool[0]:g}-{tool[1]:g}")
    for k, area in enumerate(AREAS)
    for name in STRATEGIES
    for tool in (TOOLS[1:] if area in ("rectangle", "L") else [TOOLS[0 if "islands" in area else k % 3]])
]


def line_of(contour):
    return shapely.LineString(contour.points_within(1e-4))


def swept(lines, radius):
    return shapely.union_all(shapely.buffer(list(lines), radius, quad_segs=64))


def area_of(region):
    pieces = [[loop.points_within(1e-4) for loop in part.loops] for part in region.parts]
    return shapely.union_all([shapely.Polygon(outer, holes) for outer, *holes in pieces])


def links(clearing):
    for piece in clearing.pieces:
        for a, b, linked in zip(piece.passes, piece.passes[1:], piece.linked, strict=False):
            if linked:
                yield shapely.LineString([end(a), begin(b)])


@pytest.mark.parametrize(("area", "name", "radius", "overlap"), CASES)
def test_cleared_to_the_wall_and_no_farther(area, name, radius, overlap):
    """At least 99.9 % of what the tool can reach, with a stepover above the tool radius too; 0.2 stay at the walls."""
    region = AREAS[area]
    clearing = clear(name, region, radius, 2 * radius * (1 - overlap), allowance=0.2)
    wall = area_of(region)
    room = wall.buffer(-(radius + 0.2), quad_segs=100)
    reach = room.buffer(radius, quad_segs=100)
    ways = [line_of(contour) for contour in clearing.passes]
    assert swept(ways, radius).intersection(reach).area >= 0.999 * reach.area
    lines = shapely.union_all([*ways, *links(clearing)])
    assert lines.distance(wall.boundary) >= radius + 0.2 - 1e-3
    assert room.buffer(2e-3).covers(lines)
    assert len(clearing.labels) == len(clearing.passes)


@pytest.mark.parametrize("name", STRATEGIES)
def test_links_stay_where_it_is_cleared(name):
    """Nowhere on a link is the tool centre farther than a stepover from the passes before it."""
    clearing = clear(name, AREAS["three islands"], 4, 4)
    for piece in clearing.pieces:
        lines = np.array([line_of(contour) for contour in piece.passes])
        for k, linked in enumerate(piece.linked):
            if linked:
                a, b = end(piece.passes[k]), begin(piece.passes[k + 1])
                spots = shapely.points(a + np.linspace(0, 1, 9)[:, None] * (b - a))
                assert (shapely.distance(lines[: k + 1, None], spots).min(axis=0) <= 4 + 1e-3).all()


@pytest.mark.parametrize("name", [name for name in STRATEGIES if name not in ("adaptive", "peeling")])  # their walls
def test_climb_and_conventional(name):
    """The last pass along the wall is counter-clockwise in climb milling, about islands clockwise, else the reverse."""
    for climb, sense in ((True, 1), (False, -1)):
        clearing = clear(name, AREAS["one island"], 4, 4, climb=climb)
        faces = [contour for contour in clearing.passes if contour.closed]
        outer = max(faces, key=lambda contour: abs(contour.area))
        gap = [np.ptp(np.hypot(*(contour.points - (25, 25)).T)) < 1e-6 for contour in faces]
        inner = min((c for c, g in zip(faces, gap, strict=True) if g), key=lambda c: c.length)
        assert outer.area * sense > 0 > inner.area * sense


def test_arcs_stay_arcs():
    for name in ("rings", "zigzag", "one way", "trochoidal", "rounded rings", "rounded zigzag"):
        walls = [c for c in clear(name, AREAS["rectangle"], 4, 4).passes if c.closed]
        assert len(walls[-1].points) <= 6  # begun and met at places of its own
        found = clear(name, AREAS["circle"], 4, 4).passes[-1]
        assert len(found.points) <= 3 and found.radii == pytest.approx(23)
    (spiral, last) = clear("spiral", AREAS["circle"], 4, 4).passes
    assert (np.abs(spiral.bulge[:-1]) == 1).all() and last.radii == pytest.approx(23)


def test_lines_run_one_way():
    clearing = clear("one way", AREAS["L"], 3, 3, angle=0.0)
    lines = [c for c, label in zip(clearing.passes, clearing.labels, strict=True) if label.startswith("line")]
    assert len(lines) > 10
    assert all(line.points[1, 0] < line.points[0, 0] for line in lines)
    assert all(
        piece.begins_cleared(k)
        for piece in clearing.pieces
        for k, label in enumerate(piece.labels)
        if label.startswith("line")
    )


def test_lines_at_an_angle():
    clearing = clear("zigzag", AREAS["rectangle"], 3, 3, angle=np.pi / 3)
    lines = [c for c, label in zip(clearing.passes, clearing.labels, strict=True) if label.startswith("line")]
    ways = np.array([line.points[1] - line.points[0] for line in lines])
    assert np.abs(ways[:, 1] / ways[:, 0]) == pytest.approx(np.tan(np.pi / 3))


def test_a_path_down_and_along_on_two_levels():
    clearing = clear("rings", AREAS["rectangle"], 5, 5)
    path = toolpath(clearing, (-2.0, -4.0), entry=Entry("helix", 3), feed=600, plunge_feed=200)
    cut = np.char.startswith(np.array(path.labels)[path.label], "ring")
    assert path.lengths[cut].sum() == pytest.approx(2 * clearing.length)
    assert set(path.end[cut][:, 2]) == {-2.0, -4.0}
    down = np.array(path.labels)[path.label] == "entry helix"
    sloping = down & (path.end[:, 2] < path.start[:, 2]) & (path.kind == Kind.ARC)
    flat = np.abs(path.sweep[sloping]) * np.hypot(*(path.start - path.centre)[sloping, :2].T)
    drop = (path.start - path.end)[sloping, 2]
    assert np.degrees(np.arctan2(drop, flat)).max() <= 3 + 1e-9
    assert set(path.feed[down]) == {200.0}
    assert path.end[-1, 2] == 2.0
    assert (path.start[1:] == path.end[:-1]).all()


def test_unknown_strategy():
    with pytest.raises(ValueError, match="unknown strategy 'moles'; known are rings, spiral"):
        clear("moles", AREAS["L"], 3, 3)
    with pytest.raises(ValueError, match="does not fit"):
        clear("zigzag", AREAS["L"], 30, 3)

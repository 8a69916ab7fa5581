"""A ball touches a design from all sides: distances by plain arithmetic, and against a dense sampling of the surface."""

from math import hypot, radians, sqrt, tan

import numpy as np
import pytest

from mnclab import Design, Setup
from mnclab.design import Chamfer, Circle, Hole, Pocket, Rectangle, Stud
from mnclab.workpiece.part import contact

EXACT = 1e-9
R = 2.0
BLANK = ((0, 0, -20), (100, 60, 0))
PLATE = Design(
    BLANK,
    [
        Pocket.rectangle(30, 30, 30, 20, 8, corner=4), Hole(70, 30, 16, 9), Hole(85, 50, 8, countersink=(16, 90)),
        Chamfer(Rectangle(50, 30, 100, 60), 2.0), Pocket.circle(55, 10, 12, 5), Chamfer(Circle(55, 10, 12), 1.5),
    ],
    back=[Pocket.circle(30, 20, 20, 6)],
)  # fmt: skip
TIP = 8 / tan(radians(59))


@pytest.mark.parametrize(
    ("start", "way", "travel"),
    [
        ((5, 30, 30), (0, 0, -1), 30 - R),  # the top
        ((30, 30, 30), (0, 0, -1), 38 - R),  # the floor of a pocket
        ((30, 30, -4), (1, 0, 0), 15 - R),  # its walls
        ((30, 30, -4), (0, -1, 0), 10 - R),
        ((36, 31, -4), (1, 1, 0), hypot(5, 5) + 4 - R),  # its corner of 4 about (41, 36)
        ((70, 30, -5), (0, 1, 0), 8 - R),  # the wall of a hole
        ((70, 30, 30), (0, 0, -1), 30 + 9 + TIP - R / np.sin(radians(59))),  # a ball in the cone of its bottom
        ((90, 50, -2), (-1, 0, 0), 0.0),  # within the material beside a countersink: it touches already
        ((-9, 30, -10), (1, 0, 0), 9 - R),  # the side of the blank
        ((30, 40, -40), (0, 0, 1), 20 + 6 - R),  # the pocket of the back, at 60 - 20
        ((30, 40, -21), (1, 0, 0), 10 - sqrt(R * R - 1)),  # its rim, 1 mm above the centre of the ball
    ],
)
def test_a_ball_touches(start, way, travel):
    assert contact(PLATE.part, start, way, R, 60) == pytest.approx(travel, abs=EXACT)


def test_a_ball_in_a_countersink():
    """A cone of 90° that is 8 wide at Z 0: its point would be at Z -8, the centre of the ball is √2 radii above it."""
    assert contact(PLATE.part, (85, 50, 30), (0, 0, -1), 6.5, 60) == pytest.approx(38 - 6.5 * sqrt(2), abs=EXACT)


def test_rims_and_edges_have_their_true_distance():
    part = Design(BLANK, [Pocket.circle(30, 30, 20, 8), Stud.circle(30, 30, 6, 8)]).part
    points = [(37, 30, 4), (31, 30, 3), (110, 64, 3), (30, 30, -4), (36.5, 30, -4), (50, 30, -8), (-3, -4, 12)]
    expected = [hypot(3, 4), 3, sqrt(10**2 + 4**2 + 3**2), -3, 3.5, -8, 13]
    assert part(points) == pytest.approx(expected, abs=EXACT)


def test_a_chamfer_is_touched_at_its_face():
    """45°, 2 wide, about the blank: outside in the middle of the face the distance is that from the plane x = -z - … ."""
    part = Design(BLANK, Chamfer(Rectangle(50, 30, 100, 60), 2.0)).part
    mid = np.array([99.0, 30.0, -1.0])
    normal = np.array([1.0, 0.0, 1.0]) / sqrt(2)
    assert part([mid + 3 * normal, mid - 0.3 * normal]) == pytest.approx([3, -0.3], abs=EXACT)
    assert contact(part, mid + 9 * normal, -normal, R, 20) == pytest.approx(9 - R, abs=EXACT)
    assert part([(98.5, 30, 2), (102, 30, -4)]) == pytest.approx([sqrt(0.5**2 + 2**2), 2], abs=EXACT)


def test_distances_are_those_of_the_nearest_of_many_points_of_the_surface():
    """The cells' heights, floors and walls sampled every 0.25 mm: no sample is nearer, and the nearest about as near."""
    design = Design(((0, 0, -6), (24, 18, 0)), [Pocket.rectangle(9, 9, 10, 8, 3, corner=2), Hole(19, 9, 5)])
    step = 0.25
    spots = [np.zeros((0, 3))]
    for z in np.arange(-6 + step / 2, 0, step):
        for loop in design.section(z).loops:
            along = loop.points_within(0.0005)
            way = np.arange(0, loop.length, step)
            places = loop.point_at(way)[0]
            spots.append(np.column_stack([places, np.full(len(places), z)]))
            assert len(along) > 3
    x, y = (each.ravel() for each in np.meshgrid(np.arange(step / 2, 24, step), np.arange(step / 2, 18, step)))
    floor, top = design.faces(x, y)
    for level in (floor, top):
        spots.append(np.column_stack([x, y, level])[np.isfinite(level)])
    surface = np.concatenate(spots)
    rng = np.random.default_rng(3)
    points = rng.uniform((-3, -3, -9), (27, 21, 3), (400, 3))
    nearest = np.sqrt(((points[:, None] - surface) ** 2).sum(axis=2).min(axis=1))
    distance = design.part(points)
    assert (np.abs(distance) <= nearest + EXACT).all()
    assert (nearest <= np.abs(distance) + 0.75 * step).all()
    floor, top = design.faces(points[:, 0], points[:, 1])
    with np.errstate(invalid="ignore"):
        inside = (points[:, 2] > floor) & (points[:, 2] < top)
    assert ((distance < 0) == inside).all()


def test_heights_sections_and_both_sides():
    assert PLATE.faces(np.array([30.0, 70, 85, 5, 99, 0.5]), np.array([30.0, 30, 50, 30, 30, 30]))[1] == pytest.approx(
        [-8, -9 - TIP, np.nan, 0, -1, -1.5], nan_ok=True
    )
    floor, top = PLATE.faces(np.array([30.0]), np.array([42.0]))
    assert (floor[0], top[0]) == pytest.approx((-14, 0))
    over = PLATE.turned_over()
    assert over.faces(np.array([30.0]), np.array([18.0]))[1] == pytest.approx([-6])
    assert over.turned_over() == PLATE
    moved = PLATE.moved((10, 20, 30))
    assert moved.faces(np.array([40.0]), np.array([62.0]))[0] == pytest.approx([16])
    assert moved.moved((-10, -20, -30)).faces(np.array([30.0]), np.array([42.0]))[0] == pytest.approx([-14])
    assert PLATE.section(-4).area == pytest.approx(6000 - (30 * 20 - (4 - np.pi) * 16) - np.pi * (64 + 36 + 16), abs=1e-6)
    assert PLATE.section(5).area == PLATE.section(-21).area == 0


def test_the_map_of_a_design_is_its_faces():
    part = PLATE.workpiece(0.4)
    x, y = np.meshgrid(part.x, part.y)
    floor, top = PLATE.faces(x.ravel(), y.ravel())
    assert part.heights.ravel() == pytest.approx(np.where(np.isnan(top), -20, top), abs=EXACT)
    assert part.floor.ravel() == pytest.approx(np.where(np.isnan(floor), -20, floor), abs=EXACT)
    assert part.volume == PLATE.volume
    assert part.at(30, 30) == pytest.approx(-8)


def test_a_setup_takes_a_design():
    assert Setup(stock=PLATE).stock is PLATE
    assert Setup(part=PLATE).part([(5, 30, 3)]) == pytest.approx([3])
    assert Setup(part=PLATE.part).part([(5, 30, 3)]) == pytest.approx([3])
    assert PLATE._repr_html_().count("<tr>") == 1 + sum(len(each.measures()) for each in (*PLATE.features, *PLATE.back))

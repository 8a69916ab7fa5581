"""The areas of a design that a mill clears: closed forms, and the volume that the design itself takes away."""

import math

import pytest

import mnclab
from mnclab import Alarm, Design, area
from mnclab.area import Region
from mnclab.design import Chamfer, Circle, Face, Groove, Hole, Pocket, Rectangle, Slope, Slot, Stud

BLANK = ((0, 0, -20), (60, 40, 0))
POCKET = Pocket.rectangle(30, 20, 40, 24, 5, corner=5, islands=[Circle(30, 20, 8)])
WHOLE = 40 * 24 - (4 - math.pi) * 25  # within its contour
ISLAND = 16 * math.pi


def test_the_area_of_a_feature():
    assert Region.of(POCKET).area == POCKET.region.area == pytest.approx(WHOLE - ISLAND)
    assert Region.of(POCKET.contour).area == pytest.approx(WHOLE)
    assert Region.of(POCKET.contour, holes=POCKET.islands).area == pytest.approx(WHOLE - ISLAND)
    assert Region.of(Slot((10, 10), (40, 10), 8, 3)).area == pytest.approx(30 * 8 + 16 * math.pi)
    ring = Groove(Circle(30, 20, 20), 4, 2)
    assert Region.of(ring).area == pytest.approx(math.pi * (12**2 - 8**2))
    assert Region.of(Rectangle(0, 0, 4, 5, turned=30)).area == pytest.approx(20)


def test_with_others_and_holes():
    """A slot that leads 18 out of the pocket, to half a disc; two holes, one of which lies within the other."""
    slot = Slot((30, 27), (30, 50), 6, 5)
    assert Region.of(POCKET, slot).area == pytest.approx(WHOLE - ISLAND + 6 * 18 + math.pi * 9 / 2)
    holes = [area.Contour.circle((20, 20), 3), area.Contour.circle((20, 20), 2)]
    assert Region.of(POCKET, holes=holes).area == pytest.approx(WHOLE - ISLAND - 9 * math.pi)
    assert Region.of(area.rectangle(2, 2), POCKET).area == pytest.approx(WHOLE - ISLAND + 4)
    assert Region.of(Region.of(POCKET)).area == pytest.approx(WHOLE - ISLAND)


def test_the_area_of_a_design():
    """A stud of the same depth is an island, as in its volume: area times depth."""
    design = Design(BLANK, [Pocket.rectangle(30, 20, 40, 24, 5, corner=5), Stud.circle(30, 20, 8, 5), Hole(5, 5, 4, 10)])
    assert Region.of(design).area == design.region.area == pytest.approx(WHOLE - ISLAND)
    alone = Design(BLANK, design.features[:2])
    assert 60 * 40 * 20 - alone.volume == pytest.approx(5 * alone.region.area)
    two = Design(BLANK, [POCKET, Slot((8, 4), (50, 4), 4, 3, name="groove")])
    assert list(two.regions) == ["pocket", "groove"] and two.regions["groove"].area == pytest.approx(42 * 4 + 4 * math.pi)
    with pytest.raises(Alarm, match="the design has 2 areas to clear: pocket, groove") as raised:
        Region.of(two)
    assert raised.value.hint == "design.regions['pocket']"


def test_a_pocket_is_cleared_level_by_level():
    """What a comparison leaves of it are the corners of the tool, none here."""
    trial = mnclab.compare(Region.of(POCKET), mnclab.Tool(diameter=8), "rings", depth=(2.5, POCKET.depth))["rings"]
    setup = mnclab.Setup(tools={1: mnclab.Tool(diameter=8, length=60)}, stock=BLANK)
    part = mnclab.run(trial.program("mnc"), "mnc", setup=setup).workpiece()
    assert part.removed == pytest.approx(5 * (WHOLE - ISLAND), rel=1e-3)
    assert part.compare(Design(BLANK, POCKET)).ok


@pytest.mark.parametrize(
    ("drawn", "said"),
    [
        (Hole(1, 2, 3, 4), "a hole is no area to clear"),
        (Face(1), "a face is no area to clear"),
        (Stud.circle(1, 2, 3, 4), "a stud is no area to clear"),
        (Chamfer(Circle(0, 0, 5), 1), "a chamfer is no area to clear"),
        (Slope(0, 0, 10, 5, 1, 2), "a slope is no area to clear"),
        (Design(BLANK, Face(1)), "the design has no pocket, slot or groove"),
        (mnclab.TurnedDesign([(0, 0), (0, 10), (-20, 10)]), "an area is what contours enclose, got TurnedDesign"),
        ([POCKET], "an area is what contours enclose, got"),
    ],
    ids=lambda value: type(value).__name__,
)
def test_what_has_none(drawn, said):
    with pytest.raises(Alarm, match=said):
        Region.of(drawn)
    with pytest.raises(Alarm):
        Region.of(area.rectangle(4, 4), drawn)

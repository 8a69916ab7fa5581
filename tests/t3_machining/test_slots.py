"""Slots exactly as wide as the tool: one stroke along the middle, its length and place by hand."""

import numpy as np
import pytest

from mnclab.geometry.contours import QUARTER, Contour, rectangle, slot
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import strip
from mnclab.machining.milling.entries import Entry, toolpath
from mnclab.machining.milling.rings import rings
from mnclab.machining.milling.slots import strokes
from mnclab.machining.milling.strategies import STRATEGIES, clear

LINE = Contour([(0, 0), (30, 0), (40, 10), (40, 30)], [0, QUARTER, 0, 0], closed=False)
ARC = Contour([(20, 0), (0, 20)], [QUARTER, 0], closed=False)
#: A region, and how long its stroke is for a tool of radius 4.
SLOTS = {
    "straight": (Region.of(rectangle(60, 8)), 52),
    "round ends": (Region.of(rectangle(60, 8, 4)), 52),
    "at an angle": (Region.of(rectangle(60, 8, angle=0.7, centre=(7, -3))), 52),
    "along an arc": (Region.of(slot(ARC, 8)), 10 * np.pi),
    "bent": (strip(LINE, 4), 50 + 5 * np.pi),
    "ring": (Region.of(Contour.circle((0, 0), 24), holes=[Contour.circle((0, 0), 16, start=1.0)]), 40 * np.pi),
    "rounded ring": (Region.of(rectangle(60, 60, 14), holes=[rectangle(44, 44, 6)]), 4 * 32 + 20 * np.pi),
    "hole": (Region.of(Contour.circle((3, 2), 4)), 0),
}
DUMBBELL = [(0, 0), (30, 0), (30, 16), (45, 16), (45, 0), (75, 0), (75, 40), (45, 40), (45, 24), (30, 24), (30, 40), (0, 40)]


@pytest.mark.parametrize("allowance", [0.0, 0.5])
@pytest.mark.parametrize("kind", SLOTS)
def test_one_stroke(kind, allowance):
    """Everywhere 4 from the walls beside it and ahead, to the last digit; the same with 0.5 at the walls and a tool of 3.5."""
    region, length = SLOTS[kind]
    clearing = clear("rings", region, 4 - allowance, 2, allowance=allowance)
    (stroke,) = clearing.passes
    assert clearing.labels == ("slot",) and stroke.length == pytest.approx(length, abs=1e-9)
    assert stroke.closed == ("ring" in kind)
    assert region.distance(stroke.points_within(1e-3)) == pytest.approx(4, abs=1e-9)


@pytest.mark.parametrize("kind", ["vertical", "helix", "ramp"])
@pytest.mark.parametrize("slot_", SLOTS)
def test_down_into_a_slot(slot_, kind):
    """The tool goes down within the slot, however it is wished to, and runs its stroke on each level."""
    region, length = SLOTS[slot_]
    path = toolpath(clear("rings", region, 4, 2), (-1.0, -2.0), entry=Entry(kind, 5))
    named = np.array(path.labels)[path.label] == "slot"
    assert path.lengths[named].sum() == pytest.approx(2 * length, abs=1e-6)
    below = (path.end[:, 2] < 0) & path.is_motion
    assert region.distance(path.end[below, :2]).min() >= 4 - 2e-5


@pytest.mark.parametrize("name", STRATEGIES)
def test_every_strategy_cuts_the_narrow_place_of_a_dumbbell(name):
    """Two rooms of 30 by 40 and between them a slot of 15 by 8: what is done in the rooms, and one stroke of 15."""
    clearing = clear(name, Region.of(Contour(DUMBBELL)), 4, 3)
    *rooms, narrow = clearing.pieces
    assert len(rooms) == 2 and narrow.labels == ("slot",)
    assert sorted(narrow.passes[0].points.tolist()) == [pytest.approx((30, 20)), pytest.approx((45, 20))]
    assert not any("slot" in label for piece in rooms for label in piece.labels)


@pytest.mark.parametrize("width", [8 - 1e-5, 8 - 3e-5, 8 + 3e-5])
def test_as_wide_but_for_a_hair(width):
    region = Region.of(rectangle(60, width))
    if width < 8 - 2e-5:
        with pytest.raises(ValueError, match="does not fit"):
            clear("rings", region, 4, 2)
        return
    labels = clear("rings", region, 4, 2).labels
    assert labels == (("slot",) if width < 8 else ("ring",))


def test_two_slots_that_meet_square_are_two_strokes():
    """Where they meet, the room is wider than the tool: from there strokes of 40 - 8 - 4 go along both."""
    both = strokes(Region.of(Contour([(0, 0), (40, 0), (40, 8), (8, 8), (8, 40), (0, 40)])), 4)
    assert [line.length for line in both] == pytest.approx([28, 28])


def test_no_strokes_where_there_is_room():
    assert strokes(Region.of(rectangle(60, 40)), 4) == [] and strokes(Region.of(rectangle(60, 7)), 4) == []
    with pytest.raises(ValueError, match="exactly as wide as the contour"):
        rings(Region.of(rectangle(60, 8)), 4, 2)
    with pytest.raises(ValueError, match="the stepover must lie above 0"):
        clear("rings", Region.of(rectangle(60, 8)), 4, 0)

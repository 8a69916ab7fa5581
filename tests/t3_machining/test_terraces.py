"""Formulas of parts with depths: which area is cut at which depth. Rectangles, whose areas are products."""

import pytest

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.machining.milling.terraces import DeepArea, Joined, at_depth, levels, parts, terraces


def box(x, y, width, height, depth=0.0):
    corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
    return DeepArea(Region.of(Contour(corners)), depth)


def found(formula, whole):
    return [(t.top, t.bottom, round(t.region.area, 6)) for t in terraces(formula, whole)]


def test_a_pocket_with_an_island_below_the_surface():
    """The depth model of 10.2: 100 x 100, an island 40 x 40 whose top lies at 5, a pocket inside that adds nothing."""
    pockets = Joined("|", box(0, 0, 100, 100), box(80, 80, 10, 10, 7.5))
    cut = found(Joined("\\", pockets, box(20, 20, 40, 40, 5)), 20)
    assert cut == [(0, 5, 10000), (5, 20, 8400)]
    assert sum((bottom - top) * area for top, bottom, area in cut) == 176000


@pytest.mark.parametrize(
    ("operator", "depth", "area"),
    [
        ("|", 3, 300 + 300 - 100), ("|", 7, 300), ("&", 3, 100), ("&", 7, 0), ("^", 3, 400), ("^", 7, 300),
        ("\\", 3, 300), ("\\", 7, 200),
    ],
)  # fmt: skip
def test_each_operator_at_a_depth(operator, depth, area):
    """30 x 10 as deep as the whole, 10 x 30 to a depth of 5, 10 x 10 in common; right of \\ it is an island 5 below."""
    formula = Joined(operator, box(0, 0, 30, 10), box(0, 0, 10, 30, 5))
    assert at_depth(formula, depth, 20).area == pytest.approx(area)


def test_what_is_taken_away_from_an_island_is_a_pocket_again():
    r"""A \ (B \ C): in the island of 20 x 20, whose top lies at 4, there is a pocket of 10 x 10 to a depth of 8."""
    formula = Joined("\\", box(0, 0, 50, 50), Joined("\\", box(10, 10, 20, 20, 4), box(15, 15, 10, 10, 8)))
    assert found(formula, 12) == [(0, 4, 2500), (4, 8, 2500 - 400 + 100), (8, 12, 2500 - 400)]


def test_depths_of_an_intersection():
    """What is common to depths of 10 and 6 ends at 6: below it nothing is cut."""
    assert found(Joined("&", box(0, 0, 20, 20, 10), box(10, 0, 20, 20, 6)), 15) == [(0, 6, 200)]


def test_no_cutter_gets_below_what_is_narrower_above():
    with pytest.raises(ValueError, match="wider below 5 mm than above"):
        terraces(Joined("^", box(0, 0, 20, 20, 10), box(0, 0, 10, 10, 5)), 15)


def test_nothing_at_the_surface():
    with pytest.raises(ValueError, match="encloses nothing"):
        terraces(Joined("\\", box(0, 0, 10, 10), box(0, 0, 10, 10)), 5)


def test_parts_deeper_than_the_whole_end_there():
    assert found(Joined("|", box(0, 0, 10, 10, 50), box(20, 0, 10, 10, 2)), 8) == [(0, 2, 200), (2, 8, 100)]


def test_a_long_formula():
    """128 parts side by side, one after the other and within brackets."""
    formula = nested = box(0, 0, 1, 1)
    for k in range(1, 128):
        formula = Joined("|", formula, box(k, 0, 1, 1))
        nested = Joined("|", box(k, 0, 1, 1), nested)
    for one in (formula, nested):
        assert sum(1 for _ in parts(one)) == 128 and found(one, 1) == [(0, 1, 128)]


def test_a_level_on_each_floor():
    """Infeeds of 3 down to 12, and one on the floor at 5; floors keep an allowance of 0.5."""
    formula = Joined("|", box(0, 0, 30, 10), box(40, 0, 10, 10, 5))
    made = levels(terraces(formula, 12), surface=2, down=-1, infeed=3, allowance=0.5)
    assert [(round(level.height, 9), level.terrace) for level in made] == [
        (-1, 0), (-2.5, 0), (-4, 1), (-7, 1), (-9.5, 1),
    ]  # fmt: skip


def test_formulas_made_of_each_other_are_joined_once(monkeypatch):
    """Forty strips of 10 x 1 taken away one after the other, looked at after each: forty subtractions, not 820."""
    seen = []
    difference = Region.difference
    monkeypatch.setattr(Region, "difference", lambda one, other: seen.append(1) or difference(one, other))
    known: dict = {}
    formula = box(0, 0, 10, 100)
    for k in range(40):
        formula = Joined("\\", formula, box(0, 2 * k, 10, 1))
        assert at_depth(formula, 1, 2, known=known).area == pytest.approx(1000 - 10 * (k + 1))
    assert len(seen) == 40

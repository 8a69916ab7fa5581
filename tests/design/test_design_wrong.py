"""What a design refuses, in its own words; nothing that is given raises anything but an Alarm."""

import numpy as np
import pytest

from mnclab import Alarm, Design
from mnclab.design import Chamfer, Circle, Face, Groove, Hole, Outline, Pocket, Rectangle, Slope, Slot, Stud

BLANK = ((0, 0, -20), (100, 60, 0))
SQUARE = [(20, 20), (40, 20), (40, 40), (20, 40)]
GOOD = {
    Face: {"depth": 1}, Pocket: {"contour": SQUARE, "depth": 5}, Stud: {"contour": SQUARE, "depth": 5},
    Slot: {"start": (20, 20), "end": (50, 20), "width": 8, "depth": 5}, Groove: {"contour": SQUARE, "width": 2, "depth": 2},
    Hole: {"x": 20, "y": 20, "diameter": 8, "depth": 12, "point": 118, "counterbore": (11, 4), "countersink": (12, 90),
           "thread": "M8", "thread_depth": 10},
    Slope: {"x": 30, "y": 30, "length": 20, "width": 10, "start_depth": 2, "end_depth": 6, "turned": 30},
    Chamfer: {"contour": SQUARE, "width": 1, "angle": 90, "inside": True},
    Rectangle: {"x": 0, "y": 0, "length": 10, "width": 8, "corner": 2, "turned": 30}, Circle: {"x": 0, "y": 0, "diameter": 5},
    Outline: {"points": SQUARE, "bulge": (0, 0, 0, 0), "closed": True},
}  # fmt: skip
MORE = {"top": -1, "name": "a", "tolerances": {"depth": 0.1}}
BOW = [(20, 20), (40, 40), (40, 20), (20, 40)]
HOSTILE = [
    np.nan, np.inf, -np.inf, -3.0, 0.0, 1e12, -1e12, 10**400, "abc", "", None, True, [], (), {}, object(), 1j, b"x",
    [1, 2], (1, 2, 3), [(1, 2)], [None, None], [("a", "b")] * 3, np.zeros(3), np.zeros((3, 2)), np.full((4, 2), np.nan),
    BOW, [(0, 0), (0, 0), (1, 1)], {"depth": "H99"}, {"depth": None}, {3: 4}, lambda x: x, 1e-9, float, [[[]]],
]  # fmt: skip


@pytest.mark.parametrize("kind", GOOD, ids=lambda kind: kind.__name__)
def test_nothing_but_alarms(kind):
    """Every field with every hostile value: it is refused, or the design that it makes has a body."""
    made = 0
    for name in (*GOOD[kind], *(MORE if hasattr(kind, "kind") and kind not in (Rectangle, Circle, Outline) else ())):
        for value in HOSTILE:
            given = GOOD[kind] | {name: value}
            try:
                found = kind(**given)
                if kind in (Rectangle, Circle, Outline):
                    continue
                design = Design(BLANK, found)
                assert 0 <= design.volume <= 120_000 * (1 + 1e-9)
                made += 1
            except Alarm as alarm:
                assert len(str(alarm)) < 600
    assert made or kind in (Rectangle, Circle, Outline)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Hole(200, 20, 8), r"hole \(features\[0\]\) takes nothing away: it lies beside the blank"),
        (lambda: Face(1, top=1.5), "face .* takes nothing away"),
        (lambda: Pocket.circle(30, 20, 10, 5, top=-20), "its top -20 is not above the lower side"),
        (lambda: Stud(Rectangle(50, 30, 120, 80), 5), "stud .* takes nothing away"),
        (lambda: Pocket(BOW, 5), "the contour crosses or touches itself near"),
        (lambda: Pocket(Outline(SQUARE, closed=False), 5), "the contour of a pocket must be a closed contour"),
        (lambda: Pocket.circle(30, 20, -10, 5), "the diameter of a circle .* must be greater than 0, got -10"),
        (lambda: Pocket.rectangle(30, 20, 10, 10, 5, corner=6), "corner radius of 6 does not fit into 10 by 10"),
        (lambda: Groove(Circle(30, 20, 20), 1e-9, 4), "the width of a groove .* must be at least 1e-06, got 1e-09"),
        (lambda: Chamfer(SQUARE, 1, angle=5e-324), "the included angle .* must be at least 1, got"),
        (lambda: Hole(20, 20, 8, 5, counterbore=(11, 6)), "a counterbore must be less deep than its hole, 5, got 6"),
        (lambda: Hole(20, 20, 8, counterbore=(7, 6)), "the diameter of a counterbore .* must be greater than 8, got 7"),
        (lambda: Hole(20, 20, None), "the diameter of a hole .* must be a number, got None"),
        (lambda: Hole(20, 20, None, thread="M8.5"), "M8.5 has no coarse pitch"),
        (lambda: Slot((20, 20), (20, 20), 8, 5), "start and the end of a slot are two places"),
        (lambda: Chamfer(SQUARE, 1), "chamfer .* material is on both sides of it"),
        (lambda: Face(1, tolerances={"width": 0.1}), "a face has no 'width' for a tolerance"),
        (lambda: "pocket", r"features\[0\] of a design must be a feature, got 'pocket'"),
        (lambda: 5, "features of a design must be features, got 5"),
    ],
)
def test_what_is_wrong_is_said(make, said):
    with pytest.raises(Alarm, match=said):
        Design(BLANK, found if isinstance(found := make(), int) else [found])


@pytest.mark.parametrize("blank", [None, 5, "box", ((0, 0, 0), (0, 1, 1)), ((0, 0, 0), (1, np.nan, 1)), ((0, 0), (1, 1))])
def test_a_blank_is_a_box_or_a_cylinder(blank):
    with pytest.raises(Alarm, match="the blank of a design"):
        Design(blank)

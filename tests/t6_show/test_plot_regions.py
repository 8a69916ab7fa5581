"""Areas side by side: one view each with its area, at one scale, dashed outlines over them."""

import numpy as np
import pytest

from mnclab import Alarm, area

SQUARE, DISC = area.Region.of(area.rectangle(20, 20)), area.Region.of(area.Contour.circle((10, 0), 10))


def test_each_region_has_a_view_with_its_area():
    picture = area.plot({"A": SQUARE, "A | B": SQUARE.union(DISC), "A - A": SQUARE.difference(SQUARE)}, over=(DISC,))
    first, second, third = picture.axes
    assert [ax.get_title(loc="left") or ax.get_title() for ax in picture.axes] == [
        "A: 400.0 mm²", f"A | B: {400 + np.pi * 50:.1f} mm²", "A - A: 0.0 mm²",
    ]  # fmt: skip
    assert [len(ax.patches) for ax in (first, second, third)] == [3, 3, 1]  # face and edge, and the outline over them
    assert len({(*ax.get_xlim(), *ax.get_ylim()) for ax in picture.axes}) == 1
    (dashed,) = third.patches
    assert dashed.get_linestyle() != "solid" and dashed.get_path().vertices.max() == pytest.approx(20, abs=0.05)


def test_rows_are_filled_evenly():
    many = {str(k): SQUARE for k in range(6)}
    tops = {round(ax.get_position().y1, 6) for ax in area.plot(many).axes}
    assert len(tops) == 2 and len({round(ax.get_position().y1, 6) for ax in area.plot(many, columns=2).axes}) == 3


@pytest.mark.parametrize("wrong", [SQUARE, {"A": 5}, [SQUARE]])
def test_only_regions_by_their_names(wrong):
    with pytest.raises(Alarm, match="regions must be"):
        area.plot(wrong)


def test_nothing_to_draw():
    for empty in ({}, {"A": area.Region(())}):
        with pytest.raises(Alarm, match="nothing to draw"):
            area.plot(empty)

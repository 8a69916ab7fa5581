"""Bodies, areas, contours and tools draw themselves in a cell: their measures, and how many pieces one sees."""

import re

import numpy as np
import pytest

import mnclab as mnc
from mnclab import area, part
from mnclab.path.inserts import silhouette

TEXT = "T1 S1000 M3\nG0 X-10 Y0 Z5\nG0 X10 Z-2\nG1 X20 F100\nG0 Z5\n"
BLOCK = part.box((0, 0, -20), (60, 40, 0)) - part.hole((30, 20, 0), 20, 10)


@pytest.mark.parametrize(
    ("thing", "measures", "pieces"),
    [
        (area.rectangle(60, 40, 5), ["60 × 40 mm"], [1]),
        (area.Contour([(0, 0), (40, 0), (40, 30)], closed=False), ["40 × 30 mm"], [1]),
        (area.Region.of(area.rectangle(60, 40), holes=[area.Contour.circle((10, 0), 8)]), ["60 × 40 mm"], [2]),
        (mnc.box(80, 60, 20), ["80 × 60 mm", "80 × 20 mm"], [1, 1]),
        (mnc.cylinder(20, -60), ["40 × 40 mm", "40 × 60 mm"], [1, 1]),
        (BLOCK, ["60 × 40 mm", "60 × 40 mm"], [2, 1]),  # the hole is seen high up, not low down
    ],
)
def test_a_shape_shows_its_views_with_their_measures(thing, measures, pieces):
    svg = thing._repr_svg_()
    assert re.findall(r">([^<>]+)</text>", svg) == measures
    assert [path.count("M") for path in re.findall(r' d="([^"]*)"', svg)] == pieces
    width, height = map(float, re.search(r'width="(\d+)" height="(\d+)"', svg).groups())
    places = np.array(re.findall(r"(-?[\d.]+),(-?[\d.]+)", svg), dtype=float)
    assert (places >= 0).all() and (places <= (width, height)).all()


def test_what_has_no_end_or_no_size_is_not_drawn():
    for thing in (part.plane((0, 0, 0), (0, 0, 1)), area.Region(()), mnc.Tool(radius=0)):
        assert thing._repr_svg_() is None


def test_a_tool_is_as_wide_and_as_pointed_as_its_table_says():
    """A drill of 8 mm and 118 degrees: 4 / tan 59° = 2.403 mm of point; a ball of R4 is round up to 4 mm."""
    drill = silhouette(mnc.Tool(diameter=8, kind="drill", cutting_length=30))[0]
    assert np.ptp(drill[:, 0]) == 8 and drill[1] == pytest.approx([4, 4 / np.tan(np.radians(59))]) and drill[:, 1].max() == 30
    ball = silhouette(mnc.Tool(radius=4, corner=4, cutting_length=20))[0]
    round_ = ball[ball[:, 1] < 4]
    assert np.hypot(round_[:, 0], round_[:, 1] - 4) == pytest.approx(4)
    body = silhouette(mnc.Tool(radius=5, cutting_length=20, shank=(6, 25), holder=((12, 50), (20, 70))))
    assert [np.ptp(each[:, 0]) for each in body] == [10, 12, 24, 40]
    assert [each[:, 1].min() for each in body] == [0, 25, 50, 70]
    assert "mm" not in mnc.Tool(kind="turning")._repr_svg_()  # how long it is the table does not say


def test_collisions_draw_and_save_the_part_with_a_cross_at_each(tmp_path):
    run = mnc.run(TEXT, "mnc", stock=((0, -20, -10), (40, 20, 0)), tools={1: mnc.Tool(radius=3, cutting_length=20)})
    found = run.collisions()
    assert [each.kind for each in found] == ["rapid"]
    figure = found.plot(title="struck")
    crosses = [line for line in figure.axes[0].lines if line.get_label() == "collision"]
    assert np.allclose(crosses[0].get_xydata(), [found[0].place[:2]])
    assert found.save(tmp_path / "struck.svg", size="column").read_text("utf-8").startswith("<?xml")
    with pytest.raises(mnc.Alarm, match="no option colr"):
        found.save(tmp_path / "struck.png", colr="tool")
    with pytest.raises(mnc.Alarm, match="of no run"):
        type(found)(found).plot()


def test_a_part_shows_itself_as_its_picture():
    run = mnc.run(TEXT, "mnc", stock=((0, -20, -10), (40, 20, 0)))
    assert run.workpiece(step=1.0)._repr_html_().count("data:image/png") == 1

"""Pictures, scenes and files of differences: what they show is what was found, nothing covers another number."""

import functools
import itertools
import json
import math

import numpy as np
import pytest
from tools.milled import part
from tools.running import run

from mnclab import Tool
from mnclab.design.difference.plot import SHADES, marks_of, nice, plot_difference
from mnclab.design.difference.plot_sections import sections_of
from mnclab.design.model import Bore, Design, Hole, Pocket, TurnedDesign
from mnclab.text.alarm import Alarm

TEXT = "G0 X13 Y13\nG0 Z2\nG1 Z-6.08\nG1 X47\nG1 Y27\nG1 X13\nG1 Y13\nG1 Y20\nG1 X47\nG0 Z5"


@pytest.fixture(scope="module")
def found():
    """A pocket 44 x 24 x 6 cut 0.08 too deep with a mill 0.05 too thin, and a hole that was forgotten."""
    hole, pocket = Hole(5, 5, 5, 8, point=180, name="hole"), Pocket.rectangle(30, 20, 44, 24, 6, corner=5, name="pocket")
    design = Design(((0, 0, -20), (60, 40, 0)), [pocket, hole], title="Plate")
    return part(TEXT, Tool(radius=4.95, number=1, kind="mill")).compare(design)


@pytest.fixture(scope="module")
def turned():
    part_ = TurnedDesign([(0, 20.1), (-30, 20.1), (-30, 25), (-50, 25)]).workpiece()
    return part_.compare(TurnedDesign([(0, 20), (-30, 20), (-30, 25), (-50, 25)], [Bore(16, 20)], title="bolt"))


def test_colours_keep_their_order_in_grey():
    """Pale in the middle, darker to both ends, and what is gone darker than what is left."""
    grey = SHADES(np.linspace(0, 1, 9))[:, :3] @ [0.299, 0.587, 0.114]
    assert (np.diff(grey[:5]) > 0).all() and (np.diff(grey[4:]) < 0).all() and grey[0] < grey[-1] - 0.15


def test_every_mark_has_its_number_and_covers_no_other(found):
    picture = found.plot(table=True)
    picture.draw_without_rendering()
    numbers = [text for text in picture.axes[0].texts if text.get_text().isdigit()]
    assert [text.get_text() for text in numbers] == [str(each.number) for each in marks_of(found)]
    boxes = [text.get_window_extent() for text in numbers]
    assert not any(a.overlaps(b) for a, b in itertools.combinations(boxes, 2))
    told = [text.get_text() for text in picture.texts]
    assert any("1  worst gouge \N{MINUS SIGN}0.080 mm, pocket" in text for text in told[0].splitlines() + told)


@pytest.mark.parametrize("which", ["found", "turned"])
def test_no_text_of_the_table_touches_another(which, request):
    difference = request.getfixturevalue(which)
    picture = difference.plot(table=True)
    picture.draw_without_rendering()
    boxes = [text.get_window_extent() for text in picture.texts if text.get_text().strip()]
    assert len(boxes) > 5 * len(difference.features)
    assert not any(a.shrunk(0.98, 0.9).overlaps(b.shrunk(0.98, 0.9)) for a, b in itertools.combinations(boxes, 2))
    wide, high = picture.bbox.size
    assert all(0 <= box.x0 and box.x1 <= wide and 0 <= box.y0 and box.y1 <= high for box in boxes)


def test_a_section_is_magnified_by_the_factor_it_tells(found):
    (cut,) = sections_of(found, "YZ", 30.0)
    floor = (cut.there[:, 1] < -6) & (cut.there[:, 1] > -7)
    assert cut.off.min() == pytest.approx(-0.08) and cut.factor >= 5 and floor.any()
    assert cut.off.max() == pytest.approx(0.05)
    title = found.plot(section="YZ", at=30).axes[1].texts[-1].get_text()
    assert title.endswith(f"deviation × {cut.factor:g}")


def test_a_section_goes_where_something_is_off(found):
    (cut,) = sections_of(found, "XZ", None)
    assert np.abs(cut.true).max() > 0.05


def test_the_scale_has_the_tolerance_and_says_that_there_is_more(found):
    scale = next(ax for ax in found.plot().axes if ax.get_ylabel() == "deviation, mm")
    assert [line.get_xdata()[0] for line in scale.lines] == [-0.05, 0.05]
    names = [tick.get_text() for tick in scale.get_xticklabels()]
    assert names[0] == "≤ \N{MINUS SIGN}0.5" and names[-1] == "≥ +0.5"
    assert [nice(value) for value in (0.03, 0.05, 0.11, 3, 7)] == pytest.approx([0.05, 0.05, 0.2, 5, 10])


def test_a_picture_in_axes_of_ones_own(found, turned):
    from matplotlib.figure import Figure

    for each in (found, turned):
        ax = Figure().add_subplot()
        assert plot_difference(each, ax) is ax.figure and (ax.images or ax.collections)


def test_wrong_options_are_alarms(found, turned):
    for options in ({"section": "AB"}, {"limit": 0}, {"table": 1}, {"at": [1, 2], "section": "XZ"}):
        with pytest.raises(Alarm):
            found.plot(**options)
    with pytest.raises(Alarm):
        turned.plot(section="XZ")


@pytest.mark.parametrize("which", ["found", "turned"])
@pytest.mark.parametrize("suffix", ["svg", "png", "pdf", "csv", "json", "html"])
def test_files(which, suffix, request, tmp_path):
    difference = request.getfixturevalue(which)
    path = difference.save(tmp_path / f"record.{suffix}")
    assert path.stat().st_size > 300
    if suffix == "json":
        data = json.loads(path.read_text("utf-8"))
        assert data["worst_rest"]["value"] == difference.worst_rest.value and len(data["features"]) == len(difference.features)
    if suffix == "csv":
        lines = path.read_text("utf-8").splitlines()
        assert len(lines) == 1 + len(difference.features) and lines[0].startswith("side,feature,measure,nominal")
    if suffix == "html":
        text = path.read_text("utf-8")
        assert "<img" in text and text.count("<tr") >= len(difference.features)


def test_files_that_are_none(found, tmp_path):
    for name, options in (("x.stl", {}), ("x.csv", {"table": True})):
        with pytest.raises(Alarm):
            found.save(tmp_path / name, **options)


def test_the_scene_has_the_deviation_of_every_face(found, turned):
    pytest.importorskip("pyvista")
    for each, least, most in ((found, -0.08, 2.5), (turned, 0.0, 8.0)):
        values = each.scene().actors["part"].mapper.dataset.cell_data["deviation, mm"]
        values = values[np.isfinite(values)]
        assert least - 1e-6 <= values.min() and values.max() <= most + 1e-6
        names = set(each.scene().actors)
        assert ("gouge" in names) == (each.worst_gouge.place is not None) and "rest" in names
    assert math.isclose(found.worst_gouge.value, 0.08, abs_tol=1e-6)


@functools.cache
def pocket_cut():
    """A pocket as it was cut, a little too wide, and as it was drawn."""
    text = f"G17 G90 G54\nT1\nS1000 M3 F500\nG0 Z50\n{TEXT}"
    tools = {1: Tool(radius=5, number=1, kind="mill")}
    cut = run(text, tools=tools, stock=((0, 0, -20), (60, 40, 0)))
    return cut, Design(((0, 0, -20), (60, 40, 0)), [Pocket.rectangle(30, 20, 44, 24, 6, corner=5, name="pocket")])


@pytest.mark.parametrize("suffix", ["html", "pdf"])
def test_a_report_with_a_measuring_record(suffix, tmp_path):
    cut, design = pocket_cut()
    path, plain = cut.report(tmp_path / f"a.{suffix}", design=design), cut.report(tmp_path / f"b.{suffix}")
    assert path.stat().st_size > plain.stat().st_size + 5000
    if suffix == "html":
        page = path.read_text("utf-8")
        assert "Measuring record" in page and "6.0800" in page and "Measuring record" not in plain.read_text("utf-8")

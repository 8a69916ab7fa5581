"""Drawings as DXF are read back by ezdxf: layers, true curves, dimensions with what they measure."""

import math
from dataclasses import replace

import pytest
from design.drawn import plate, shaft

from mnclab.design.drawing.drawing import draw
from mnclab.design.drawing.view import Angle, Axis, Diameter, Kind, Linear, Note, Radius, View, ViewLine, value
from mnclab.geometry.contours import Contour

ezdxf = pytest.importorskip("ezdxf")
SQUARE = Contour([(0, 0), (40, 0), (40, 30), (0, 30)])
DIMENSIONS = (
    Linear((0, 0), (40, 0), value(40, tolerance=0.1)),
    Linear((0, 0), (0, 30), value(30, tolerance=(-0.2, 0.1)), "y"),
    Linear((0, 0), (40, 30), value(50), "ab"),
    Diameter((20, 15), 5, value(10, "⌀", "H7"), ("↧8",)),
    Radius((30, 20), 4, 0, math.pi / 2, value(4, "R")),
    Angle((0, 0), (40, 0), (40, 30), value(math.degrees(math.atan2(3, 4)), after="°")),
    Note((0, 30), ("1×45°",)),
)
VIEW = View(
    "front",
    (
        ViewLine(SQUARE), ViewLine(Contour.circle((20, 15), 5)),
        ViewLine(Contour([(0, 10), (40, 10)], closed=False), Kind.HIDDEN),
        ViewLine(Contour([(34, 20), (30, 24)], [math.tan(math.pi / 8), 0], closed=False)),
    ),
    (), DIMENSIONS, (Axis((0, 15), (40, 15)),),
)  # fmt: skip


def read(drawing, tmp_path):
    document = ezdxf.readfile(drawing.save(tmp_path / "part.dxf"))
    audit = document.audit()
    assert not audit.errors and not audit.fixes
    return document


def measured(dimension):
    size = dimension.get_measurement()
    return float(size)


@pytest.mark.parametrize("scale", [2, 1, 0.5])
def test_dimensions_measure_the_part_at_every_scale(scale, tmp_path):
    model = read(draw([VIEW], "plate", size="A3", scale=scale), tmp_path).modelspace()
    found = {each.dxf.text: each for each in model.query("DIMENSION")}
    expected = {
        "<> %%p0.1": 40, r"<>{\H0.7x;\S+0.1^ -0.2;}": 30, "<>": 50, r"%%c<> H7\P\U+21A78": 10, "R<>": 4,
        "<>%%d": math.degrees(math.atan2(3, 4)),
    }  # fmt: skip
    assert found.keys() == expected.keys()
    for text, size in expected.items():
        assert measured(found[text]) == pytest.approx(size, abs=1e-6)
        assert {each.dxf.layer for each in found[text].get_geometry_block()} == {"DIMENSIONS"}
    (outline,) = model.query("LWPOLYLINE[layer=='OUTLINE']")
    across, up = ({round(row[k], 6) for row in outline.get_points()} for k in (0, 1))
    assert outline.closed and max(across) - min(across) == pytest.approx(40) and max(up) - min(up) == pytest.approx(30)
    (circle,) = model.query("CIRCLE[layer=='OUTLINE']")
    (arc,) = model.query("ARC[layer=='OUTLINE']")
    assert circle.dxf.radius == pytest.approx(5) and arc.dxf.radius == pytest.approx(4)
    assert (arc.dxf.end_angle - arc.dxf.start_angle) % 360 == pytest.approx(90)


def test_layers_have_their_lines_and_widths(tmp_path):
    document = read(draw([VIEW], "plate"), tmp_path)
    layers = {each.dxf.name: (each.dxf.linetype, each.dxf.lineweight) for each in document.layers}
    assert layers["OUTLINE"] == ("Continuous", 50) and layers["HIDDEN"] == ("HIDDEN", 25)
    assert layers["CENTRE"] == ("CENTER", 25) and {"HATCH", "DIMENSIONS", "TEXT", "FRAME"} <= layers.keys()
    kinds = {(each.dxftype(), each.dxf.layer) for each in document.modelspace()}
    assert {("LINE", "HIDDEN"), ("LINE", "CENTRE"), ("LWPOLYLINE", "OUTLINE"), ("TEXT", "TEXT")} <= kinds


def test_a_detail_measures_the_part_too(tmp_path):
    detail = replace(VIEW, enlarged=2.0, title="Z", dimensions=DIMENSIONS[:1])
    (dimension,) = read(draw([detail], "plate", scale=1), tmp_path).modelspace().query("DIMENSION")
    assert dimension.get_measurement() == pytest.approx(80) and dimension.dxf.actual_measurement == pytest.approx(40)
    assert dimension.dxf.text == "<> %%p0.1" and dimension.override().get("dimlfac") == pytest.approx(0.5)


def test_letters_of_all_kinds(tmp_path):
    texts = [each.dxf.text for each in read(draw([VIEW], "Piesă\t½ 50% 😀"), tmp_path).modelspace().query("TEXT")]
    assert "Pies\\U+0103 ½ 50% ?" in texts


@pytest.mark.parametrize("make", [plate, shaft])
def test_random_parts_are_clean_and_have_all_dimensions(make, tmp_path):
    for seed in range(300, 304):
        views = make(seed)
        wanted = sum(not isinstance(each, Note) for view in views for each in view.dimensions)
        assert len(read(draw(views, "part"), tmp_path).modelspace().query("DIMENSION")) == wanted

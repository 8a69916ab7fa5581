"""Contours and areas out of drawings, against closed forms."""

import numpy as np
import pytest

from mnclab import Alarm
from mnclab.geometry import dxf, svg
from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.drawings import area_of, joined

PAGE = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 80" width="{}" height="{}">{}</svg>'


def drawn(inside, size=("100mm", "80mm"), **more):
    return svg.contours(PAGE.format(*size, inside), **more)


def test_figures():
    """A rectangle 30 × 20 with corners of 4, a circle r = 5; Y runs upwards: the top of the page is at 80."""
    (box,) = drawn('<rect x="10" y="10" width="30" height="20" rx="4"/>')
    assert abs(box.area) == pytest.approx(600 - (4 - np.pi) * 16)
    assert box.bounds == pytest.approx(np.array([[10, 50], [40, 70]]))
    assert sorted(set(np.round(box.radii, 6))) == [4, np.inf]
    (ring,) = drawn('<circle cx="20" cy="30" r="5"/>')
    assert abs(ring.area) == pytest.approx(25 * np.pi) and ring.radii == pytest.approx(5)
    (tri,) = drawn('<polygon points="0,0 10,0 0,10"/>')
    assert tri.closed and abs(tri.area) == pytest.approx(50)
    (way,) = drawn('<polyline points="0,0 10,0 10,10"/>')
    assert not way.closed and way.length == pytest.approx(20)


def test_units_of_the_page():
    (line,) = drawn('<line x1="0" y1="80" x2="50" y2="80"/>', size=("20cm", "16cm"))
    assert line.points == pytest.approx(np.array([[0, 0], [100, 0]]))


@pytest.mark.parametrize(
    ("page", "low", "high"),
    [
        ('width="100mm" height="50mm" viewBox="0 0 100 100"', (25, 0), (75, 50)),
        ('width="50mm" height="100mm" viewBox="0 0 100 100"', (0, 25), (50, 75)),
        ('width="100mm" height="50mm" viewBox="10 20 100 100" preserveAspectRatio="xMidYMid"', (20, 10), (70, 60)),
        ('width="210mm" height="297mm" viewBox="0 0 210 297" preserveAspectRatio="none"', (0, 197), (100, 297)),
    ],
)
def test_a_page_of_another_ratio(page, low, high):
    """SVG 2, 8.6: by default the viewBox keeps its ratio, is as great as the page lets it and lies in its middle."""
    (only,) = svg.contours(f'<svg {page}><rect width="100" height="100"/></svg>')
    assert only.bounds == pytest.approx(np.array([low, high]))


def test_a_page_that_stretches_is_an_alarm():
    with pytest.raises(Alarm, match="preserveAspectRatio='none' is not read"):
        svg.contours('<svg width="9mm" height="5mm" viewBox="0 0 1 1" preserveAspectRatio="none"><circle r="1"/></svg>')


@pytest.mark.parametrize("how", ['display="none"', 'style="fill:red; display : none"', 'style="visibility:hidden"'])
def test_what_is_hidden_is_left_out_and_told(how):
    """Inkscape hides a layer by `style="display:none"`."""
    text = f'<svg><circle r="2"/><g {how}><rect width="9" height="9"/></g></svg>'
    with pytest.warns(UserWarning, match="1 hidden element left out, with all in it"):
        (only,) = svg.contours(text)
    assert abs(only.area) == pytest.approx(4 * np.pi)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("<html><p/></html>", "no SVG: its outermost element is <html>"),
        ('<svg><rect width="1" height="1" style="transform:scale(2)"/></svg>', "moved by its style"),
    ],
)
def test_what_would_be_read_wrongly(text, told):
    with pytest.raises(Alarm, match=told):
        svg.contours(text)


def test_all_words_of_a_path():
    (ring,) = drawn('<path d="m10 10h20v10l-5,5H15l-5-5z"/>')
    assert abs(ring.area) == pytest.approx(20 * 15 - 2 * 12.5)
    (two,) = drawn('<path d="M10,10 30,10 30,20 10,20Z"/>')  # further pairs after M are lines
    assert abs(two.area) == pytest.approx(200)
    (half,) = drawn('<path d="M10 40a10 10 0 0120 0z"/>')  # flags need nothing between them
    assert abs(half.area) == pytest.approx(50 * np.pi)
    assert half.bounds[1] == pytest.approx([30, 50])  # 40 from above is 40 from below; the arc rises by 10
    large, small = (drawn(f'<path d="M10 40A10 10 0 {flag} 1 20 50"/>')[0] for flag in (1, 0))
    assert large.length == pytest.approx(15 * np.pi) and small.length == pytest.approx(5 * np.pi)


@pytest.mark.parametrize("tolerance", [0.1, 0.001])
def test_curves_keep_the_tolerance(tolerance):
    """A quarter circle as a Bezier curve, its own formula sampled: no sample is farther off than the tolerance."""
    (way,) = drawn('<path d="M10 10C10 30 40 50 70 20"/>', tolerance=tolerance)
    t = np.linspace(0, 1, 400)[:, None]
    p = np.array([(10, 70), (10, 50), (40, 30), (70, 60)])
    curve = (1 - t) ** 3 * p[0] + 3 * (1 - t) ** 2 * t * p[1] + 3 * (1 - t) * t**2 * p[2] + t**3 * p[3]
    assert way.distance(curve).max() <= tolerance
    assert way.points[[0, -1]] == pytest.approx(p[[0, -1]])
    assert len(way.points) < 30 / np.sqrt(tolerance)
    (bow,) = drawn('<path d="M0 80Q10 60 20 80T40 80"/>', tolerance=tolerance)
    assert bow.bounds == pytest.approx(np.array([[0, -10], [40, 10]]), abs=tolerance)
    (smooth,) = drawn('<path d="M0 80C0 70 10 70 10 80S20 90 20 80"/>', tolerance=tolerance)
    assert smooth.bounds == pytest.approx(np.array([[0, -7.5], [20, 7.5]]), abs=tolerance)


def test_ellipses_are_chords():
    (ring,) = drawn('<ellipse cx="50" cy="40" rx="20" ry="10"/>', tolerance=1e-3)
    assert (ring.bulge == 0).all() and abs(ring.area) == pytest.approx(200 * np.pi, rel=2e-4)
    (turned,) = drawn('<path d="M30 40A20 10 30 1 1 30.1 40"/>', tolerance=1e-3)
    assert turned.length > 90


def test_transformations():
    """Turned by 90° and moved, then twice as large: a circle stays one; under unequal scales it is none."""
    group = '<g transform="translate(20 10) rotate(90)"><g transform="scale(2)">{}</g></g>'
    (ring,) = drawn(group.format('<circle cx="10" cy="5" r="3"/>'))
    assert ring.radii == pytest.approx(6)
    assert ring.bounds.mean(axis=0) == pytest.approx([20 - 10, 80 - 10 - 20])
    (flat,) = drawn('<circle transform="scale(2 1)" cx="10" cy="5" r="3"/>', tolerance=1e-3)
    assert abs(flat.area) == pytest.approx(18 * np.pi, rel=1e-3)
    (mirrored,) = drawn('<path transform="matrix(-1 0 0 1 50 0)" d="M10 40a10 10 0 0 1 20 0z"/>')
    assert mirrored.bounds == pytest.approx(np.array([[20, 40], [40, 50]]))
    (skewed,) = drawn('<rect transform="skewX(45)" width="10" height="10"/>')
    assert abs(skewed.area) == pytest.approx(100)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<svg", "no SVG"),
        (PAGE.format(1, 1, '<path d="M1 2L3"/>'), "number is missing after 'L'"),
        (PAGE.format(1, 1, '<path d="M1 2Z3"/>'), "cannot go on"),
        (PAGE.format(1, 1, '<path d="1 2"/>'), "cannot go on"),
        (PAGE.format(1, 1, '<g transform="twist(3)"/>'), "twist"),
    ],
)
def test_what_is_no_drawing(text, message):
    with pytest.raises(Alarm, match=message):
        svg.contours(text)
    with pytest.raises(Alarm, match="tolerance"):
        svg.contours("<svg/>", tolerance=0)


def test_what_lies_in_what():
    """A pocket with an island, in the island a smaller pocket; a second pocket beside it."""
    boxes = [rectangle(side, side) for side in (60, 30, 10)]
    found = area_of([*boxes[::-1], rectangle(8, 8, centre=(50, 0))])
    assert found.area == pytest.approx(3600 - 900 + 100 + 64)
    assert len(found.parts) == 3
    with pytest.raises(Alarm, match="no closed contour"):
        area_of([Contour([(0, 0), (9, 0)], closed=False)])


def test_pieces_are_joined():
    """Four pieces in any order and sense: a slot 20 long and 10 wide."""
    bent = np.tan(np.pi / 4)
    pieces = [
        Contour([(0, 0), (20, 0)], closed=False),
        Contour([(0, 10), (20, 10.0005)], closed=False),
        Contour([(0, 10), (0, 0)], [bent, 0], closed=False),
        Contour([(20, 10), (20, 0)], [-bent, 0], closed=False),
    ]
    (ring,) = joined(pieces)
    assert ring.closed and abs(ring.area) == pytest.approx(200 + 25 * np.pi, abs=0.01)
    assert len(joined(pieces[:2])) == 2


def test_a_dxf_file(tmp_path):
    """Lines and an arc, a polyline with a bulge, a circle and an ellipse, in inches."""
    ezdxf = pytest.importorskip("ezdxf")
    drawing = ezdxf.new()
    drawing.header["$INSUNITS"] = 1
    space = drawing.modelspace()
    space.add_line((0, 0), (4, 0))
    space.add_line((4, 2), (0, 2))
    space.add_arc((4, 1), 1, -90, 90)
    space.add_arc((0, 1), 1, 90, 270)
    space.add_circle((2, 1), 0.5)
    space.add_lwpolyline(
        [(10, 0, 0), (12, 0, 1), (12, 2, 0), (10, 2, 0)], format="xyb", close=True, dxfattribs={"layer": "B"}
    )
    space.add_ellipse((20, 0), (2, 0), 0.5)
    drawing.saveas(tmp_path / "part.dxf")
    found = dxf.contours(tmp_path / "part.dxf", tolerance=1e-3)
    inch2 = 25.4**2
    (only,) = dxf.contours(tmp_path / "part.dxf", layer="B")
    assert only.area == pytest.approx((4 + np.pi / 2) * inch2)
    slot = 8 + np.pi - np.pi / 4
    assert area_of(found).area == pytest.approx((slot + 4 + np.pi / 2 + 2 * np.pi) * inch2, rel=1e-4)
    (tmp_path / "no.dxf").write_text("nothing")
    with pytest.raises(Alarm, match="no DXF"):
        dxf.contours(tmp_path / "no.dxf")
    with pytest.raises(Alarm, match="cannot be read: No such file"):
        dxf.contours(tmp_path / "gone.dxf")
    for wrong in (None, 5, b"part.dxf"):
        with pytest.raises(Alarm, match="the path of a file"):
            dxf.contours(wrong)


@pytest.mark.parametrize(
    ("unit", "mm"),
    [(None, 1), (0, 1), (1, 25.4), (2, 304.8), (4, 1), (5, 10), (6, 1000), (9, 0.0254), (13, 0.001), (14, 100)],
)
def test_units_of_a_dxf(unit, mm, tmp_path, recwarn):
    """DXF reference, $INSUNITS: 1 inches, 2 feet, 4 mm, 5 cm, 6 m, 9 mils, 13 microns, 14 dm; 0 and none: mm."""
    ezdxf = pytest.importorskip("ezdxf")
    for wide in (60 / mm, 60):
        drawing = ezdxf.new()
        drawing.header["$INSUNITS"] = unit or 0
        if unit is None:
            del drawing.header["$INSUNITS"]
        drawing.modelspace().add_lwpolyline([(0, 0), (wide, 0), (wide, wide / 2), (0, wide / 2)], close=True)
        drawing.saveas(tmp_path / "part.dxf")
        recwarn.clear()
        region = area_of(dxf.contours(tmp_path / "part.dxf"))
        assert region.bounds == pytest.approx(np.array([(0, 0), (wide * mm, wide * mm / 2)]), abs=1e-9)
        named = [str(each.message) for each in recwarn if f"$INSUNITS {unit}" in str(each.message)]
        assert [f"{wide * mm / 1000:g} m long" in each for each in named] == [True] * (wide * mm > 10_000)


def test_a_unit_that_no_part_has(tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    drawing = ezdxf.new()
    drawing.modelspace().add_circle((0, 0), 2)
    for unit in (3, 7, 18, 99):
        drawing.header["$INSUNITS"] = unit
        drawing.saveas(tmp_path / "part.dxf")
        with pytest.raises(Alarm, match=rf"part.dxf: its unit, \$INSUNITS {unit}, is not read"):
            dxf.contours(tmp_path / "part.dxf")
    drawing.header["$INSUNITS"] = 6
    drawing.modelspace().add_circle((0, 0), 2000)
    drawing.saveas(tmp_path / "part.dxf")
    with pytest.raises(Alarm, match=r"drawn in Meters \(\$INSUNITS 6\): CIRCLE on layer '0' reaches farther than 1000 m"):
        dxf.contours(tmp_path / "part.dxf")


def test_a_contour_that_touches_the_one_about_it():
    """An island in the corner of a pocket, 60 × 40 less 20 × 20: whichever point is where they touch."""
    corner = rectangle(20, 20, centre=(20, 10))
    for k in range(4):
        island = Contour(np.roll(corner.points, k, axis=0))
        assert area_of([rectangle(60, 40), island]).area == pytest.approx(2400 - 400)


def test_what_is_drawn_twice_counts_once():
    again = rectangle(60, 40).reversed()
    with pytest.warns(UserWarning, match="1 contour drawn again"):
        assert area_of([rectangle(60, 40), rectangle(10, 10), again]).area == pytest.approx(2300)


def test_islands_in_islands():
    """Squares of 10, 20, … 70 in each other: every other ring between them belongs to the area."""
    squares = [rectangle(10 * k, 10 * k) for k in range(1, 8)]
    found = area_of(squares[::2] + squares[1::2])
    assert found.area == pytest.approx(sum((-1) ** (7 - k) * (10 * k) ** 2 for k in range(1, 8)))


def test_many_contours_that_lie_apart():
    """A plate of 100 rings, each with a pin in it; counted with the pins' own holes: 301 loops in 201 pieces."""
    places = [(10 * i, 10 * j) for i in range(10) for j in range(10)]
    rings = [Contour.circle(place, r, clockwise=r == 3) for place in places for r in (4, 3, 1)]
    plate = Contour([(-10, -10), (100, -10), (100, 100), (-10, 100)])
    area = area_of([*rings[::2], plate, *rings[1::2]])
    assert area.area == pytest.approx(110**2 - 100 * np.pi * (16 - 9 + 1))
    assert len(area.loops) == 301 and len(area.parts) == 101
    assert sorted(round(part.area, 6) for part in area.parts)[:100] == [round(np.pi * 8, 6)] * 100


def test_many_contours_of_which_two_overlap():
    """Sixty circles in a row, each of radius 1; the last two overlap: what both enclose counts once."""
    circles = [Contour.circle((3 * k, 0), 1) for k in range(59)]
    area = area_of([*circles, Contour.circle((3 * 58, 1.9), 1)])
    lens = 2 * np.arccos(0.95) - 0.95 * np.sqrt(4 - 1.9**2)
    assert area.area == pytest.approx(60 * np.pi - lens)


def test_more_contours_than_an_area_has():
    with pytest.raises(Alarm, match="has 1001 closed contours, an area at most 1000"):
        area_of([Contour.circle((3 * k, 0), 1) for k in range(1001)])


def test_thousands_of_pieces_are_strung_together():
    """A circle in 5,000 chords in any order and sense."""
    angles = np.arange(5000) * 2 * np.pi / 5000
    corners = 100 * np.column_stack([np.cos(angles), np.sin(angles)])
    order = np.random.default_rng(1).permutation(5000)
    pieces = [Contour(corners[[k, (k + 1) % 5000]][:: 1 if k % 3 else -1], closed=False) for k in order.tolist()]
    (ring,) = joined(pieces)
    assert ring.closed and len(ring.points) == 5000
    assert abs(ring.area) == pytest.approx(5000 / 2 * 1e4 * np.sin(2 * np.pi / 5000))

"""Drawings that are cut, nested, absurd or mutated: an Alarm in words, soon, and nothing else."""

import io
import random
import re
import time
import warnings

import numpy as np
import pytest

from mnclab import Alarm
from mnclab.geometry import dxf, svg
from mnclab.geometry.drawings import area_of

PAGE = '<svg xmlns="http://www.w3.org/2000/svg">{}</svg>'
WRONG = {
    '<rect width="1e308" height="1e308"/>': "width of a rect: 1e308 is out of range",
    '<rect width="1e9" height="5"/>': "reaches farther than 1000 m: X1e[+]09",
    '<rect width="-1" height="5"/>': "width of a rect must be at least 0, got -1",
    '<rect width="abc" height="5"/>': "width of a rect must be a number, got 'abc'",
    '<rect width="50%" height="5"/>': "width of a rect must be a number, got '50%'",
    '<g transform="scale(0)"><rect width="1" height="5"/></g>': "leaves no area",
    '<g transform="matrix(1 2 2 4 0 0)"/>': "leaves no area",
    '<g transform="scale(2"/>': "a transformation cannot be read",
    '<g transform="scale(a)"/>': "a transformation cannot be read",
    '<path d="L 1 2"/>': "a path begins with M, got 'L 1 2'",
    '<path d="M0 0A1e308 1e308 0 0 1 1 1"/>': "1e308 is out of range",
    '<path d="M0 0A1 1 0 0 1 1e300 1"/>': "1e300 is out of range",
    '<ellipse rx="1e12" ry="1"/>': "reaches farther than 1000 m",
    '<g transform="scale(1e-6)"><path d="M0 0C1e11 0 1e11 1e11 0 1e11"/></g>': None,
    '<use href="#a"/>': "<use> within a drawing is not read",
    '<svg viewBox="0 0 1 1"><rect width="1" height="1"/></svg>': "<svg> within a drawing is not read",
}


@pytest.mark.parametrize("inside", WRONG)
def test_svg_that_no_page_has(inside):
    begin = time.process_time()
    if WRONG[inside] is None:
        assert np.isfinite(svg.contours(PAGE.format(inside))[0].points).all()
    else:
        with pytest.raises(Alarm, match=WRONG[inside]):
            svg.contours(PAGE.format(inside))
    assert time.process_time() - begin < 2


@pytest.mark.parametrize("box", ["", "0 0 0 0", "0 0 10", "a b c d", "0 0 -1 5", "0 0 1e400 1"])
def test_a_view_without_size(box):
    with pytest.raises(Alarm, match="viewBox"):
        svg.contours(f'<svg viewBox="{box}"><rect width="1" height="1"/></svg>')


@pytest.mark.parametrize("text", ["<svg", "<", "<svg>&a;</svg>", "<svg>\x00</svg>"])
def test_text_that_is_no_svg(text):
    with pytest.raises(Alarm, match="this is no SVG"):
        svg.contours(text)


def test_groups_in_groups_without_end():
    depth = 50_000
    (only,) = svg.contours(PAGE.format("<g>" * depth + '<rect width="4" height="5"/>' + "</g>" * depth))
    assert abs(only.area) == pytest.approx(20)


def test_a_long_path_takes_no_longer_than_it_is_long():
    begin = time.process_time()
    points = "".join(f"L{k % 1000} {k // 1000}" for k in range(60_000))
    (only,) = svg.contours(PAGE.format(f'<path d="M0 0{points}"/>'))
    assert len(only.points) == 60_001 and time.process_time() - begin < 4


def test_units_within_a_drawing():
    """A viewBox of 100 on 50 mm: a unit is half a millimetre, 30 mm are 30 mm (SVG 1.1, 7.10)."""
    text = '<svg viewBox="0 0 100 100" width="50mm" height="50mm"><rect width="30mm" height="20"/></svg>'
    assert abs(svg.contours(text)[0].area) == pytest.approx(30 * 10)


def test_what_draws_no_lines_is_named():
    with pytest.warns(UserWarning, match="1 image, 2 text left out"):
        svg.contours(PAGE.format('<text>a</text><image/><text>b</text><rect width="1" height="1"/>'))


SVG = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 80" width="100mm" height="80mm">
<g transform="translate(3,4) rotate(20 5 5)"><path d="M10 10 L20 10 h5 v5 C1 2 3 4 5 6 s1 2 3 4 q1 2 3 4 t5 6
A5 6 20 0 1 30 40 a3 3 0 1 0 2 2 z m1 1 l3 3"/><rect x="1" y="2" width="30mm" height="20" rx="3"/></g>
<ellipse cx="50" cy="40" rx="20" ry="10" transform="scale(2,1) skewX(10)"/><circle cx="5" cy="5" r="3"/>
<polygon points="1,1 2,5 6,2"/><line x1="1" x2="5" y2="4"/><polyline points="1 2 3 4"/></svg>"""
NUMBERS = ("0", "-1", "1e308", "1e-308", "nan", "inf", "1e12", "9" * 30, "1e6", "", "abc", "-0", "1e400", "2,3", "1e-7")


def mutated(text, rng, low=0):
    """The text with some numbers replaced, places overwritten, cut out, repeated, or cut off, from `low` on."""
    for _ in range(rng.choice((1, 1, 1, 2, 3, 5))):
        low = min(low, len(text))
        at, other = (rng.randrange(low, len(text) + 1) for _ in range(2))
        end = min(len(text), at + rng.randrange(1, 50))
        how = rng.random()
        if how < 0.4 and (found := [m for m in re.finditer(r"[-+]?\d+\.?\d*", text) if m.start() >= low]):
            one = rng.choice(found)
            text = text[: one.start()] + rng.choice(NUMBERS) + text[one.end() :]
        elif how < 0.5:
            text = text[:at]
        elif how < 0.7:
            text = text[:at] + rng.choice('MLZAaCc0123456789.- <>/"\n\x00é') + text[at + 1 :]
        elif how < 0.85:
            text = text[:at] + text[end:]
        else:
            text = text[:other] + text[at:end] + text[other:]
    return text


def survives(read, path, text):
    path.write_text(text, encoding="utf-8")
    begin = time.process_time()
    try:
        found = read(path)
        assert all(np.isfinite(each.points).all() for each in found)
        area_of(found)
    except Alarm as alarm:
        assert str(alarm)
    assert time.process_time() - begin < 2


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_mutated_svg(tmp_path):
    rng = random.Random(31)
    for _ in range(300):
        survives(svg.contours, tmp_path / "a.svg", mutated(SVG, rng))


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_mutated_dxf(tmp_path, capfd):
    ezdxf = pytest.importorskip("ezdxf")
    new = ezdxf.new("R2000")
    new.units = 4
    block, space, text = new.blocks.new("B", base_point=(1, 1)), new.modelspace(), io.StringIO()
    block.add_circle((0, 0), 2)
    block.add_lwpolyline([(0, 0, 0), (3, 0, 1), (3, 3, 0)], format="xyb", close=True)
    block.add_arc((1, 1), 2, 10, 200)
    block.add_spline([(0, 0), (1, 2), (3, 1), (4, 4)])
    block.add_ellipse((0, 0), (3, 1), 0.4)
    rows = {"rotation": 30, "xscale": 2, "row_count": 2, "column_count": 2, "row_spacing": 9, "column_spacing": 8}
    space.add_blockref("B", (5, 5), dxfattribs=rows)
    space.add_line((0, 0), (4, 4))
    space.add_polyline2d([(1, 0, 0), (5, 0, 1), (5, 4, 0)], format="xyb", close=True)
    new.write(text)
    rng, good = random.Random(31), text.getvalue()
    (tmp_path / "good.dxf").write_text(good)
    assert dxf.contours(tmp_path / "good.dxf")  # and ezdxf is loaded
    for k in range(60):
        survives(dxf.contours, tmp_path / "a.dxf", mutated(good, rng, 0 if k % 10 == 0 else good.index("BLOCKS")))
    assert capfd.readouterr().err == ""


def test_the_warnings_of_a_damaged_file(tmp_path):
    """A block whose beginning is gone: ezdxf skips what it holds, and that is told."""
    ezdxf = pytest.importorskip("ezdxf")
    new = ezdxf.new("R2000")
    new.blocks.new("B").add_circle((0, 0), 2)
    new.modelspace().add_circle((9, 9), 3)
    new.saveas(tmp_path / "a.dxf")
    text = (tmp_path / "a.dxf").read_text()
    at = text.rindex("  0\nBLOCK\n")
    (tmp_path / "a.dxf").write_text(text[:at] + text[at:].replace("BLOCK\n", "POINT\n", 1))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        dxf.contours(tmp_path / "a.dxf")
    assert any("is damaged: " in str(each.message) for each in said)

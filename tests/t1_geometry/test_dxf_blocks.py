"""Blocks of a DXF drawing, placed by INSERT.

Authority: the DXF reference, group codes of INSERT: a point p of the block comes to
`place + turned(rotation) · (scale · (p - base))`, the extrusion (0, 0, -1) mirrors X; written out here as a matrix. And
ezdxf's own `explode`, which puts the entities into the model space.
"""

import numpy as np
import pytest

from mnclab import Alarm, area
from mnclab.geometry import dxf
from mnclab.geometry.drawings import joined

ezdxf = pytest.importorskip("ezdxf")
ISLAND = np.array([(0, 0), (6, 0), (6, 2), (2, 5)], float)


def drawing(unit=4):
    new = ezdxf.new("R2000")
    new.header["$INSUNITS"] = unit
    block = new.blocks.new("ISLAND", base_point=(1, 2))
    block.add_lwpolyline(ISLAND, close=True)
    block.add_circle((3, 2), 0.5)
    return new, new.modelspace()


def read(new, tmp_path, **options):
    new.saveas(tmp_path / "part.dxf")
    return dxf.contours(tmp_path / "part.dxf", **options)


def matrix(place, turn=0.0, scale=(1.0, 1.0), base=(1.0, 2.0), mirrored=False):
    """3×3, of the block to the drawing."""
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    to = np.array([[c, -s, place[0]], [s, c, place[1]], [0, 0, 1]]) @ np.diag([*scale, 1.0])
    to = to @ np.array([[1, 0, -base[0]], [0, 1, -base[1]], [0, 0, 1]])
    return np.diag([-1.0, 1.0, 1.0]) @ to if mirrored else to


def check(found, matrices, tolerance=1e-9):
    """The island of each placing is there, and its circle as what the matrix makes of it."""
    loops = [loop for loop in joined(found) if loop.closed]
    assert len(loops) == 2 * len(matrices)
    angle = np.linspace(0, 2 * np.pi, 3601)
    round_ = np.stack([3 + 0.5 * np.cos(angle), 2 + 0.5 * np.sin(angle)], axis=1)
    for each in matrices:
        size = abs(np.linalg.det(each))
        for points, inside in ((ISLAND, 19.0), (round_, np.pi / 4)):
            there = points @ each[:2, :2].T + each[:2, 2]
            box = np.array([there.min(axis=0), there.max(axis=0)])
            near = [loop for loop in loops if np.abs(loop.bounds - box).max() < 1e-4 + tolerance]
            assert [abs(loop.area) for loop in near] == [pytest.approx(inside * size, rel=1e-4 + tolerance)]


CASES = {
    "as it is": {},
    "turned": {"rotation": 33.0},
    "scaled": {"xscale": 2.0, "yscale": 2.0},
    "mirrored in X": {"xscale": -1.0},
    "mirrored and turned": {"yscale": -1.5, "xscale": 1.5, "rotation": 120.0},
    "scaled unequally": {"xscale": 3.0, "yscale": 0.5},
    "scaled unequally and turned": {"xscale": 3.0, "yscale": -0.5, "rotation": -70.0},
}


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("behind", [False, True])
def test_a_block_is_placed_as_its_insert_says(tmp_path, name, behind):
    how = CASES[name]
    new, space = drawing()
    space.add_blockref("ISLAND", (20, 10), dxfattribs={**how, **({"extrusion": (0, 0, -1)} if behind else {})})
    scale = how.get("xscale", 1.0), how.get("yscale", 1.0)
    check(read(new, tmp_path, tolerance=1e-5), [matrix((20, 10), how.get("rotation", 0.0), scale, mirrored=behind)])
    for each in list(space.query("INSERT")):
        each.explode()
    new.saveas(tmp_path / "flat.dxf")
    flat = dxf.contours(tmp_path / "flat.dxf", tolerance=1e-5)
    assert area.area_of(flat).area == pytest.approx(area.area_of(dxf.contours(tmp_path / "part.dxf", 1e-5)).area)


def test_blocks_in_blocks_in_rows_and_columns(tmp_path):
    new, space = drawing()
    new.blocks.new("PAIR").add_blockref("ISLAND", (5, 5), dxfattribs={"rotation": 90, "xscale": 2, "yscale": 2})
    rows = {"row_count": 2, "column_count": 3, "row_spacing": 40, "column_spacing": 50, "rotation": 30, "xscale": -1}
    space.add_blockref("PAIR", (100, 0), dxfattribs=rows)
    inner = matrix((5, 5), 90, (2, 2))
    turn = matrix((0, 0), 30, base=(0, 0))
    steps = [turn @ np.array([50 * i, 40 * k, 1.0]) for i in range(3) for k in range(2)]
    outer = [matrix((100 + step[0], step[1]), 30, (-1, 1), base=(0, 0)) for step in steps]
    check(read(new, tmp_path), [each @ inner for each in outer])


def test_the_island_of_a_pocket_comes_out_of_its_block(tmp_path):
    """60 × 40 with an island of radius 8 and a hole of radius 2."""
    new, space = drawing()
    new.blocks.new("ROUND").add_circle((0, 0), 8)
    space.add_lwpolyline([(-30, -20), (30, -20), (30, 20), (-30, 20)], close=True)
    space.add_circle((-20, 0), 2)
    space.add_blockref("ROUND", (5, 0))
    found = read(new, tmp_path)
    assert len(found) == 3 and area.area_of(found).area == pytest.approx(2400 - np.pi * 68)


def test_the_layer_of_a_block(tmp_path):
    """What a block draws on layer 0 is on the layer of its INSERT; on another it stays there."""
    new, space = drawing()
    new.blocks.get("ISLAND").add_circle((20, 20), 1, dxfattribs={"layer": "OTHER"})
    space.add_blockref("ISLAND", (0, 0), dxfattribs={"layer": "CUT"})
    assert len(read(new, tmp_path, layer="CUT")) == 2
    assert len(read(new, tmp_path, layer="OTHER")) == 1
    assert len(read(new, tmp_path, layer="0")) == 0


def test_a_polyline_seen_from_behind(tmp_path):
    """Extrusion (0, 0, -1): X of the plane runs the other way; the old and the new polyline alike."""
    new, space = drawing()
    behind = {"extrusion": (0, 0, -1)}
    space.add_lwpolyline([(1, 0, 0), (5, 0, 1), (5, 4, 0)], format="xyb", close=True, dxfattribs=behind)
    space.add_polyline2d([(11, 0, 0), (15, 0, 1), (15, 4, 0)], format="xyb", close=True, dxfattribs=behind)
    for loop, shift in zip(read(new, tmp_path), (0, 10), strict=True):
        assert loop.bounds == pytest.approx(np.array([(-7 - shift, 0), (-1 - shift, 4)]))


def test_a_polyline_in_space_is_read_from_above(tmp_path):
    new, space = drawing()
    space.add_polyline3d([(0, 0, 1), (4, 0, 2), (4, 3, 3)], close=True)
    (only,) = read(new, tmp_path)
    assert only.closed and only.area == pytest.approx(6)


def test_what_bounds_nothing_is_named(tmp_path):
    new, space = drawing()
    space.add_circle((0, 0), 5)
    space.add_text("40H7")
    space.add_point((1, 1))
    space.add_point((2, 1))
    with pytest.warns(UserWarning, match="2 POINT, 1 TEXT left out"):
        assert len(read(new, tmp_path)) == 1


@pytest.mark.parametrize(
    ("draw", "says"),
    [
        (lambda space: space.add_solid([(0, 0), (1, 0), (0, 1)]), "SOLID on layer '0' is not read"),
        (lambda space: space.add_3dface([(0, 0), (1, 0), (0, 1)]), "3DFACE on layer '0' is not read"),
        (lambda space: space.add_xline((0, 0), (1, 0)), "XLINE on layer '0' is not read"),
        (lambda space: space.add_mline([(0, 0), (1, 0)]), "MLINE on layer '0' is not read"),
        (lambda space: space.add_circle((0, 0), 5, dxfattribs={"extrusion": (0, 1, 1)}), "CIRCLE .* tilted out of the XY plane"),
        (lambda space: space.add_blockref("GONE", (0, 0)), "INSERT .* block 'GONE', which the file does not have"),
        (lambda space: space.add_circle((1e300, 0), 5), "reaches farther than 1000 m"),
        (lambda space: space.add_ellipse((0, 0), (1e12, 0), 0.5), "reaches farther than 1000 m"),
        (lambda space: space.add_circle((0, 0), 0), "radius 0"),
    ],
)
def test_what_is_not_read_is_an_alarm(tmp_path, draw, says):
    new, space = drawing()
    draw(space)
    with pytest.raises(Alarm, match=says):
        read(new, tmp_path)


def test_blocks_without_end(tmp_path):
    new, space = drawing()
    new.blocks.new("SELF").add_blockref("SELF", (1, 0))
    many = {"row_count": 30000, "column_count": 30000, "row_spacing": 1, "column_spacing": 1}
    for name, how, says in (("SELF", {}, "blocks within each other"), ("ISLAND", many, "at most 10000")):
        insert = space.add_blockref(name, (0, 0), dxfattribs=how)
        with pytest.raises(Alarm, match=says):
            read(new, tmp_path)
        space.delete_entity(insert)


def test_a_drawing_that_would_be_waited_for_is_counted(tmp_path):
    """200,000 lines of 12 values each, of which none is read."""
    line = "0\nLINE\n5\n1F\n100\nAcDbEntity\n8\n0\n100\nAcDbLine\n10\n0\n20\n0\n30\n0\n11\n1\n21\n1\n31\n0\n62\n1\n"
    file = tmp_path / "huge.dxf"
    file.write_text("0\nSECTION\n2\nENTITIES\n" + line * 200_000 + "0\nENDSEC\n0\nEOF\n")
    with pytest.raises(Alarm, match="has 2400004 values, as 200000 lines have; at most 200000 are read") as found:
        area.dxf(file)
    assert "a file of its own" in found.value.hint


def test_blocks_that_double_are_counted_before_they_are_read(tmp_path, monkeypatch):
    """29 blocks with two of the one before: 2^29 circles, and not one of them is made."""
    new, space = drawing()
    new.blocks.new("B0").add_circle((0, 0), 1)
    for k in range(1, 30):
        block = new.blocks.new(f"B{k}")
        for x in (0, 3):
            block.add_blockref(f"B{k - 1}", (x, 0))
    space.add_blockref("B29", (0, 0))
    made = []
    monkeypatch.setattr(dxf, "_contours", lambda *given: made.append(given) or ())
    with pytest.raises(Alarm, match="has 1[0-9]{4} entities or more, blocks counted .* at most 10000"):
        read(new, tmp_path)
    assert not made


def test_what_the_drawing_does_not_show_is_left_out_and_named(tmp_path):
    """DXF reference: a layer is off where its colour is negative, frozen by flag 1; group code 60 makes an entity invisible."""
    new, space = drawing()
    new.layers.add("OFF").off()
    new.layers.add("Frozen").freeze()
    space.add_circle((0, 0), 5)
    space.add_circle((20, 0), 4, dxfattribs={"layer": "OFF"})
    space.add_circle((40, 0), 3, dxfattribs={"layer": "FROZEN"})
    space.add_circle((60, 0), 2, dxfattribs={"layer": "Unseen"})
    space.add_blockref("ISLAND", (80, 0), dxfattribs={"layer": "Frozen"})
    path = tmp_path / "part.dxf"
    new.saveas(path)
    text = path.read_text()
    assert text.count("  8\nUnseen\n") == 1
    path.write_text(text.replace("  8\nUnseen\n", "  8\nUnseen\n 60\n1\n"))  # ezdxf 1.1 reads code 60 but does not write it
    with pytest.warns(UserWarning, match="1 on 'FROZEN', 1 on 'Frozen', 1 on 'OFF', 1 on 'Unseen' left out"):
        (only,) = dxf.contours(path)
    assert only.area == pytest.approx(25 * np.pi)
    assert len(dxf.contours(path, layer="OFF")) == 1


def test_what_stays_open_is_named():
    square, line = area.rectangle(10, 10), area.Contour([(20, 0), (30, 0)], closed=False)
    with pytest.warns(UserWarning, match=r"1 open contour, from \(20.000, 0.000\) to \(30.000, 0.000\)"):
        assert area.area_of([square, line]).area == pytest.approx(100)
    with pytest.raises(Alarm, match=r"no closed contour, but 1 open contour, from \(20.000, 0.000\)"):
        area.area_of([line])


@pytest.mark.parametrize("axes", [("xscale",), ("yscale",), ("xscale", "yscale")])
def test_a_block_at_a_scale_of_nothing_is_refused(axes, tmp_path):
    """Its matrix has no inverse: nothing of it bounds an area, and it is not as large as it was drawn."""
    new, space = drawing()
    space.add_blockref("ISLAND", (10, 10), dxfattribs={axis: 7.625 for axis in axes})
    new.saveas(tmp_path / "part.dxf")
    text = (tmp_path / "part.dxf").read_text("cp1252")
    assert text.count("\n7.625\n") == len(axes)
    (tmp_path / "part.dxf").write_text(text.replace("\n7.625\n", "\n0.0\n"), "cp1252")
    with pytest.raises(Alarm, match="INSERT on layer '0' places the block 'ISLAND' at a scale of 0"):
        dxf.contours(tmp_path / "part.dxf")

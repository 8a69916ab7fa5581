"""A milled part against another one, a run, a body of triangles: faults whose numbers are plain arithmetic."""

import math

import numpy as np
import pytest
from tools.milled import DRILL, MILL, part
from tools.running import run

from mnclab import Setup, Tool
from mnclab.design.model import Design, Hole, Pocket, TurnedDesign
from mnclab.text.alarm import Alarm

RING = "G0 X15 Y15\nG1 Z-5\nG1 X45\nG1 Y25\nG1 X15\nG1 Y15\nG0 Z50"
BLOCK = ((0, 0, -20), (60, 40, 0))


def mill(radius):
    return Tool(radius=radius, number=1, kind="mill")


def ring(radius=5.0, text=RING):
    return part(text, mill(radius))


def band(radius, inner=(30, 10), r=5.0):
    """Area of the track of a mill about a rectangle, whose corners it rounds outside."""
    wide, high = inner
    outside = (wide + 2 * radius) * (high + 2 * radius) - (4 - math.pi) * radius**2
    return outside - max(wide - 2 * radius, 0) * max(high - 2 * radius, 0)


def test_the_same_part_has_no_deviation():
    found = ring().compare(ring())
    assert found.ok and found.worst_gouge.value == found.worst_rest.value == found.gouge_volume == found.rest_volume == 0
    assert [row.measure for row in found.features] == ["form"]


@pytest.mark.parametrize(("radius", "sign"), [(4.1, 1), (3.9, -1)])
def test_a_tool_of_another_radius(radius, sign):
    """Walls that are 0.1 off, thinner than a cell: found along sections of the other part."""
    found = ring(radius).compare(ring(4.0))
    worst, none = (found.worst_gouge, found.worst_rest) if sign > 0 else (found.worst_rest, found.worst_gouge)
    assert worst.value == pytest.approx(0.1, abs=2e-5) and none.value == 0 and worst.line in range(6, 11)  # beside a corner
    volume = found.gouge_volume if sign > 0 else found.rest_volume
    assert volume == pytest.approx(5 * abs(band(radius) - band(4.0)), rel=0.03)
    assert not found.ok


def test_too_deep():
    found = ring(text=RING.replace("Z-5", "Z-5.1")).compare(ring())
    assert found.worst_gouge.value == pytest.approx(0.1, abs=1e-6) and found.worst_rest.value == 0
    assert found.gouge_volume == pytest.approx(0.1 * band(5.0), rel=0.01)


def test_a_run_on_another_datum_stands_where_the_machine_has_it():
    """Both programs cut the same place of one blank; the second counts from a zero 3 mm farther along X."""
    text = "G17 G90 {g}\nT1\nS1000 M3 F500\nG0 Z50\nG0 X{x}\nG0 Y15\nG1 Z-5\nG1 X{y}\nG0 Z50"
    given = {"tools": {1: MILL}, "stock": BLOCK}
    here = run(text.format(g="G54", x=15, y=45), datums={1: (0, 0, 0), 2: (3, 0, 0)}, **given)
    there = run(text.format(g="G55", x=12, y=42), datums={1: (0, 0, 0), 2: (3, 0, 0)}, **given)
    assert there.toolpath.origin[0] == 3
    found = here.workpiece().compare(there)
    assert found.worst_gouge.value <= 1e-9 and found.worst_rest.value <= 1e-9
    shifted = run(text.format(g="G55", x=12.2, y=42.2), datums={1: (0, 0, 0), 2: (3, 0, 0)}, **given)
    assert here.workpiece().compare(shifted).worst_gouge.value == pytest.approx(0.2, abs=1e-6)


def test_the_workpiece_of_a_design_is_the_design():
    design = Design(BLOCK, [Hole(30, 20, 6, 8, name="A")])
    found = part("G0 X30 Y20\nG1 Z-9.8025816\nG0 Z50", DRILL).compare(design.workpiece())
    assert "A" in {row.feature for row in found.features} and found.ok


pv = pytest.importorskip("pyvista")


def boxes(depth=6.0, floor=-20.0):
    """A block with a square pocket 30 x 20 in its middle, as 12 + 10 faces of exact corners."""
    outer, inner = (np.array([(0, 0), (60, 0), (60, 40), (0, 40)]), np.array([(15, 10), (45, 10), (45, 30), (15, 30)]))
    levels = [(outer, floor), (outer, 0.0), (inner, 0.0), (inner, -depth)]
    points = np.vstack([np.column_stack([ring_, np.full(4, z)]) for ring_, z in levels])
    quads = [(0, 3, 2, 1), (12, 13, 14, 15)]
    for k in range(4):
        j = (k + 1) % 4
        quads += [(k, j, 4 + j, 4 + k), (4 + k, 4 + j, 8 + j, 8 + k), (8 + k, 8 + j, 12 + j, 12 + k)]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return pv.PolyData.from_regular_faces(points.astype(float), np.array(triangles))


def test_a_body_of_triangles():
    """A sharp pocket 6 deep, cut with r = 5 and 0.1 too deep: 5·(1 - 1/√2) is left in its corners, 0.1 is gone below."""
    text = "G0 X20 Y15\nG1 Z-6.1\nG1 X40\nG1 Y25\nG1 X20\nG1 Y15\nG0 Z50"
    found = part(text).compare(boxes())
    assert found.error == pytest.approx(6e-6) and found.target == "mesh"
    assert found.worst_gouge.value == pytest.approx(0.1, abs=1e-5)
    assert found.worst_rest.value == pytest.approx(5 * (1 - 1 / math.sqrt(2)), abs=1e-4)
    assert found.rest_volume == pytest.approx(6 * (4 - math.pi) * 25, rel=0.02)
    assert found.gouge_volume == pytest.approx(0.1 * (600 - (4 - math.pi) * 25), rel=0.02)


@pytest.mark.parametrize("suffix", ["stl", "glb"])
def test_a_part_that_was_written_to_a_file(tmp_path, suffix):
    """The file has its flat faces exact. Most is gone where the floor meets a wall."""
    path = part("G0 X-10 Y20\nG1 Z-4\nG1 X70\nG0 Z50").save(tmp_path / f"slot.{suffix}")
    found = part("G0 X-10 Y20\nG1 Z-4.2\nG1 X70\nG0 Z50", mill(5.1)).compare(path)
    assert found.target == f"slot.{suffix}" and found.worst_rest.value == 0
    assert found.worst_gouge.value == pytest.approx(math.hypot(0.1, 0.2), abs=1e-4) and found.error < 0.01
    assert found.gouge_volume == pytest.approx(60 * (10.2 * 4.2 - 10 * 4), rel=0.03)


def test_a_turned_part_against_a_body_of_triangles(tmp_path):
    design = TurnedDesign([(0, 10), (-20, 10), (-20, 15), (-40, 15)])
    path = design.workpiece().save(tmp_path / "bolt.stl")
    found = TurnedDesign([(0, 10.1), (-20, 10.1), (-20, 15), (-40, 15)]).workpiece().compare(path)
    assert found.worst_rest.value == pytest.approx(0.1, abs=1e-4) and found.worst_gouge.value < 1e-4
    assert found.rest_volume == pytest.approx(math.pi * (10.1**2 - 100) * 20, rel=1e-3)


def test_open_bodies_and_others_are_refused(tmp_path):
    piece = part("G0 X15 Y15\nG1 Z-5\nG0 Z50")
    (tmp_path / "bad.stl").write_text("nothing")
    wrong = [pv.Plane(), tmp_path / "none.stl", tmp_path / "bad.stl", tmp_path / "x.dxf", 7, None, Setup(), pv.PolyData()]
    for each in [*wrong, TurnedDesign([(0, 10), (-20, 10)])]:
        with pytest.raises(Alarm):
            piece.compare(each)


def test_facets_say_how_far_they_are_off():
    """A cylinder of 24 sides: its facets lie r·(1 - cos 7.5°) inside, the comparison says at least half of that."""
    from mnclab.workpiece.part.mesh import mesh_of

    rise = 10 * (1 - math.cos(math.radians(7.5)))
    found = mesh_of(pv.Cylinder(radius=10, height=20, resolution=24))
    assert rise * 0.5 <= found.error <= rise * 2
    assert mesh_of(pv.Cube()).error == 1e-6


def test_a_pocket_that_is_not_there():
    found = part("G0 Z50\nG0 X100").compare(Design(BLOCK, [Pocket.rectangle(30, 20, 30, 20, 6)]).workpiece())
    assert found.worst_rest.value == pytest.approx(6, abs=1e-6) and not found.ok

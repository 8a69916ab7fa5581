"""Exports read back by other programs' readers: the same points, to the precision of the format."""

import json
import math
import struct
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Alarm, Kind
from mnclab.show import solids
from mnclab.show.export_gcode import lines

AUTHORITIES = Path(__file__).parent.parent / "authorities"
RECORDED = json.loads((AUTHORITIES / "exported.json").read_text("utf-8"))["programs"]
sys.path.insert(0, str(AUTHORITIES))
from exported_programs import PROGRAMS  # noqa: E402
from read_back import blocks_of, same_motion  # noqa: E402

sys.path.pop(0)

PROGRAM = (
    "G90 G54 T1 S1000 M3\nG0 X0.1 Y0 Z5\nG1 Z-2 F100\nG2 X30 Y0.3 R20\nG4 P1.5\nG3 X10 R-20\nG3 I5\n"
    "G18 G2 X40 Z-4 R-17\nG19 G3 Y8 Z-4 R5\nG17 G3 I3 Z-9\n"
)


def moves(path, kinds):
    """Start and end (n, 2, 3) of the moves of some kinds."""
    rows = np.isin(path.kind, kinds)
    return np.stack([path.start[rows], path.end[rows]], axis=1)


# --- plain blocks ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("record", RECORDED, ids=lambda record: record["name"])
def test_linuxcnc_reads_the_plain_blocks_as_the_same_path(record):
    control, text = PROGRAMS[record["name"]]
    run = mnclab.run(text, control)
    assert blocks_of(run) == record["blocks"], "record again: tests/authorities/generate_exported.py"
    same_motion(run, record)


def test_turns_beyond_the_first_are_counted():
    run = mnclab.run("G1 X10 F100\nG3 X-10 I-10 Z-5\n", "mnc")
    run.toolpath = run.toolpath.replace(sweep=run.toolpath.sweep + [0, 4 * math.pi])
    assert "G3 X-10 Z-5 I-10 J0 P3" in list(lines(run))


def test_what_stops_or_waits_is_written():
    blocks = list(lines(mnclab.run("T1 S900 M4\nG4 P2.5\nT2\nG1 X5 F100\nM5\n", "mnc")))
    assert [b for b in blocks if b[0] not in "(%"][1:-1] == [
        "T1 M6", "G43 H1", "S900 M4", "G4 P2.5", "T2 M6", "G43 H2", "S900 M4", "G0 X0 Y0 Z0", "G1 X5 F100", "M5",
    ]  # fmt: skip


def test_comments_hold_no_bracket_and_no_foreign_letter():
    run = mnclab.run("(\n", "mnc")
    for block in lines(run):
        assert block.isascii()
        assert not block.startswith("(") or (block.count("("), block.count(")")) == (1, 1)


# --- drawings --------------------------------------------------------------------------------------------------------


def test_ezdxf_reads_the_drawing(tmp_path):
    """One entity a move, where rapids go straight."""
    ezdxf = pytest.importorskip("ezdxf")
    run = mnclab.run(PROGRAM, "mnc", setup=mnclab.Setup(limits=mnclab.Limits(rapid_motion="line")))
    document = ezdxf.readfile(run.save(tmp_path / "a.dxf"))
    assert not document.audit().errors
    found = list(document.modelspace())
    path = run.toolpath.motion
    assert len(found) == len(path)
    for entity, row in zip(found, path):
        flat = [np.array(p) for p in _flat(entity)]
        ends = [row.start, row.end]
        straight = min(_apart(flat, ends), _apart(flat[::-1], ends))  # DXF turns every arc counter-clockwise
        assert straight < 1e-9
        if row.kind == Kind.ARC:
            spokes = [np.linalg.norm((p - row.centre) * (1 - np.abs(row.axis))) for p in flat]
            assert np.ptp(spokes) < 1e-9
            fine = sum(np.linalg.norm(b - a) for a, b in zip(flat, flat[1:]))
            expected = math.hypot(spokes[0] * row.sweep, float((row.end - row.start) @ row.axis))
            assert fine == pytest.approx(expected, rel=1e-3)
        assert entity.dxf.layer == {Kind.RAPID: "RAPID"}.get(row.kind, "FEED")
    kinds = [entity.dxftype() for entity in found]
    assert kinds.count("ARC") == 4 and kinds.count("CIRCLE") == 1 and kinds.count("POLYLINE") == 1


def _flat(entity):
    match entity.dxftype():
        case "LINE":
            return [entity.dxf.start, entity.dxf.end]
        case "POLYLINE":
            return list(entity.points())
        case _:
            return list(entity.flattening(1e-4))


def _apart(points, ends):
    if np.allclose(ends[0], ends[1]):  # a circle of DXF begins where it likes
        return abs(np.linalg.norm(points[0] - points[-1]))
    return max(np.abs(points[0] - ends[0]).max(), np.abs(points[-1] - ends[1]).max())


def test_svg_in_true_size(run, tmp_path):
    root = ElementTree.parse(run.save(tmp_path / "a.svg", true_size=True)).getroot()
    low, high = run.toolpath.bounds
    assert float(root.get("width").removesuffix("mm")) == pytest.approx(high[0] - low[0] + 4, abs=1e-5)
    x, y, width, height = map(float, root.get("viewBox").split())
    assert (x, y) == pytest.approx((low[0] - 2, -high[1] - 2), abs=1e-5)
    assert root.get("height") == f"{height:g}mm" or float(root.get("height")[:-2]) == height
    paths = root.findall("{http://www.w3.org/2000/svg}path")
    assert [node.get("class") for node in paths] == ["rapid", "feed"]
    commands = paths[1].get("d").split("A")[1].split()
    assert [float(part) for part in commands[:5]] == [20, 20, 0, 0, 1]  # G2: clockwise on paper too
    assert [float(part) for part in commands[5:7]] == pytest.approx([30, -0.3])
    end = [float(part) for part in paths[1].get("d").split()[-2:]]
    assert end == pytest.approx([run.toolpath.end[-1, 0], -run.toolpath.end[-1, 1]], abs=1e-6)


def test_options_that_a_file_does_not_know_are_an_alarm(run, tmp_path):
    with pytest.raises(Alarm, match=r"\.csv files have no options, got view"):
        run.save(tmp_path / "a.csv", view="XY")


# --- bodies ----------------------------------------------------------------------------------------------------------


def test_vtk_has_every_move_with_its_columns(run, tmp_path):
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.read(run.save(tmp_path / "a.vtk", of="path"))
    path = run.toolpath.motion
    assert mesh.n_lines == mesh.n_cells == len(path)
    for k, row in enumerate(path):
        points = mesh.get_cell(k).points
        assert np.array_equal(points[0], row.start) and np.array_equal(points[-1], row.end)
    assert np.array_equal(mesh.cell_data["line"], path.line)
    assert np.array_equal(mesh.cell_data["feed"], path.feed)


def test_stl_is_closed_and_where_the_cuts_are(run, tmp_path):
    pyvista = pytest.importorskip("pyvista")
    data = run.save(tmp_path / "a.stl", of="path").read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count
    mesh = pyvista.read(tmp_path / "a.stl").clean()
    assert mesh.is_manifold and mesh.n_open_edges == 0
    path = run.toolpath
    cuts = path[np.isin(path.kind, (Kind.LINE, Kind.ARC))]
    points = cuts.points(0.01)[0]
    low, high = np.array(mesh.bounds).reshape(3, 2).T
    assert (low <= points.min(axis=0) + 0.01).all() and (high >= points.max(axis=0) - 0.01).all()


@pytest.mark.parametrize("suffix", ["gltf", "glb"])
def test_gltf_has_lines_of_each_kind_and_the_tool(run, tmp_path, suffix):
    file = run.save(tmp_path / f"a.{suffix}", of="path")
    data = file.read_bytes()
    if suffix == "glb":
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data))
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON" and size % 4 == 0
        document = json.loads(data[20 : 20 + size])
    else:
        document = json.loads(data)
    assert [mesh["name"] for mesh in document["meshes"]] == ["rapid", "feed", "tool"]
    box = document["accessors"][1]
    cuts = run.toolpath[np.isin(run.toolpath.kind, (Kind.LINE, Kind.ARC))]
    assert box["min"] == pytest.approx(cuts.points()[0].min(axis=0), abs=0.02)
    library = pytest.importorskip("pygltflib")
    assert len(library.GLTF2().load(str(file)).meshes) == 3


def test_empty_paths_make_whole_files(tmp_path):
    run = mnclab.run("G90\n", "mnc")
    for suffix in ("dxf", "ngc"):
        assert run.save(tmp_path / f"a.{suffix}").stat().st_size > 0
    for suffix in ("gltf", "glb", "vtk", "stl"):
        assert run.save(tmp_path / f"a.{suffix}", of="path").stat().st_size > 0


def test_a_body_is_that_of_the_part_unless_the_path_is_named(run, tmp_path):
    with pytest.raises(Alarm, match="no blank, and so no part") as caught:
        run.save(tmp_path / "a.stl")
    assert 'of="path"' in str(caught.value)
    for options, sentence in (({"of": "tool"}, "of must be part or path"), ({"view": "XY"}, "know the option of, got view")):
        with pytest.raises(Alarm, match=sentence):
            run.save(tmp_path / "a.stl", **options)
    assert list(tmp_path.iterdir()) == []


# --- solids: volumes in closed form ----------------------------------------------------------------------------------


def test_volumes():
    assert solids.box((0, 0, 0), (2, 3, 4)).volume == pytest.approx(24)
    n = 48
    area = n / 2 * math.sin(2 * math.pi / n) * 25
    assert solids.revolved([(5, 0), (5, 10)]).volume == pytest.approx(10 * area)
    assert solids.revolved([(0, 0), (5, 6)]).volume == pytest.approx(6 * area / 3)
    path = mnclab.run("G1 X10 F100\nY5\n", "mnc").toolpath
    hexagon = 6 / 2 * math.sin(math.pi / 3) * 0.1**2
    assert solids.tubes(path, 0.1).volume == pytest.approx(15 * hexagon)


def test_a_drill_has_its_point_and_a_ball_mill_its_ball():
    drill = solids.tool_body(mnclab.Tool(radius=5, angle=90, cutting_length=20))
    assert drill.points[:, 2].min() == 0 and drill.points[48, 2] == pytest.approx(5)  # 5 / tan 45°
    ball = solids.tool_body(mnclab.Tool(radius=5, corner=5, cutting_length=20))
    low = ball.points[ball.points[:, 2] < 5]
    assert np.allclose(np.linalg.norm(low - [0, 0, 5], axis=1)[:-1], 5)

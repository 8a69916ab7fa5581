"""A part as a file, read back by other readers."""

import csv
import json
import struct
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

import mnclab
from mnclab import Alarm, Setup, Tool
from mnclab.workpiece.blank import cylinder

SLOT = "G17 G90 G54\nT1 M6 S2000 M3\nG0 X-10 Y20 Z5\nG1 Z-3 F300\nX70\nG0 Z20\n"  # 60 long, 8 wide, 3 deep
LEFT = 60 * 40 * 20 - 60 * 8 * 3
TURN = "M3\nT1\nS800 G97 G95 F0.25\nG00 X15 Z2\nG01 Z-20\nX25\nG00 X40 Z20\nM5\n"


@pytest.fixture(scope="module")
def run():
    tools = {1: Tool(radius=4, kind="mill")}
    return mnclab.run(SLOT, "g43", Setup(tools=tools, stock=((0, 0, -20), (60, 40, 0)), start=(0, 0, 50)))


@pytest.fixture(scope="module")
def turned():
    return mnclab.run(TURN, "jnc-t01", Setup(stock=cylinder(20, -50, 0), start=(60, 0, 50)))


@pytest.mark.parametrize("suffix", ["stl", "vtk"])
def test_another_reader_finds_it_closed(run, turned, tmp_path, suffix):
    pyvista = pytest.importorskip("pyvista")
    for done, volume in ((run, LEFT), (turned, turned.workpiece().volume)):
        mesh = pyvista.read(done.save(tmp_path / f"a.{suffix}")).clean()
        assert mesh.is_manifold and mesh.n_open_edges == 0
        assert mesh.volume == pytest.approx(volume, rel=0.005)


def test_an_stl_is_binary_and_as_long_as_it_says(run, tmp_path):
    data = run.save(tmp_path / "part.stl").read_bytes()
    assert len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]
    corners = np.frombuffer(data, dtype=[("n", "<f4", 3), ("c", "<f4", (3, 3)), ("x", "<u2")], offset=84)["c"].reshape(-1, 3)
    assert corners.min(axis=0) == pytest.approx((0, 0, -20)) and corners.max(axis=0) == pytest.approx((60, 40, 0))
    assert run.workpiece().save(tmp_path / "same.stl").read_bytes() == data


def test_vtk_tells_what_cut_each_triangle(run, tmp_path):
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.read(run.save(tmp_path / "a.vtk"))
    floor = np.abs(mesh.cell_centers().points[:, 2] + 3) < 1e-9
    assert set(mesh.cell_data["line"][floor].tolist()) <= {4, 5} and set(mesh.cell_data["tool"][floor].tolist()) == {1}
    assert (mesh.cell_data["row"] == -1).any()


def test_gltf_has_one_body_in_metres(run, tmp_path):
    document = json.loads(run.save(tmp_path / "a.gltf").read_bytes())
    assert [mesh["name"] for mesh in document["meshes"]] == ["part"]
    assert document["accessors"][0]["max"] == [60, 40, 0] and document["nodes"][-1]["matrix"][0] == 0.001
    assert run.save(tmp_path / "a.glb").read_bytes()[:4] == b"glTF"


def test_the_table_has_the_heights(run, turned, tmp_path):
    with run.workpiece(step=2.0).save(tmp_path / "a.csv").open(newline="") as file:
        (_, *x), *rows = csv.reader(file)
    assert [float(each) for each in x[:2]] == [1, 3] and [float(row[0]) for row in rows[:2]] == [1, 3]
    heights = {float(y): {float(each) for each in row} for y, *row in rows}
    assert heights[1] == {0} and heights[19] == {-3} and heights[23] == {-3} and heights[25] == {0}
    with turned.workpiece().save(tmp_path / "b.csv").open(newline="") as file:
        rows = [*csv.DictReader(file)]
    assert max(float(row["radius"]) for row in rows) == 20 and min(float(row["z"]) for row in rows) == -50


@pytest.mark.parametrize("suffix", ["svg", "pdf", "png"])
def test_pictures_are_the_same_every_time(run, tmp_path, suffix):
    part = run.workpiece(step=1.0)
    one, other = (part.save(tmp_path / f"{name}.{suffix}", section="XZ") for name in "ab")
    assert one.read_bytes() == other.read_bytes()
    if suffix == "svg":
        texts = {text.text for text in ElementTree.parse(one).iter("{http://www.w3.org/2000/svg}text")}
        assert {"A", "X, mm", "depth, mm"} <= texts


def test_what_cannot_be_written_is_an_alarm(run, tmp_path):
    part = run.workpiece()
    for name, options, sentence in (
        ("a.xyz", {}, "cannot write a part as .xyz"), ("a", {}, "no suffix"),
        ("a.stl", {"of": "part"}, "have no options, got of"),
    ):  # fmt: skip
        with pytest.raises(Alarm, match=sentence):
            part.save(tmp_path / name, **options)
    with pytest.raises(Alarm, match="written to a path, got 3"):
        part.save(3)
    assert list(tmp_path.iterdir()) == []

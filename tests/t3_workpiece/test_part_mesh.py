"""Bodies of triangles as parts: against opencamlib, whose answers are recorded, and against the same shapes without facets."""

import json
import pickle
from pathlib import Path

import numpy as np
import pytest

from mnclab.text.alarm import Alarm
from mnclab.workpiece.part import ball, box, contact, foot, mesh

pyvista = pytest.importorskip("pyvista")

RECORD = json.loads((Path(__file__).parents[1] / "authorities" / "meshes.json").read_text())
WITHIN = 1e-6  # mm


def stl(path, triangles):
    """A file of triangles as text."""
    corners = "\n".join(
        "facet normal 0 0 0\nouter loop\n" + "\n".join(f"vertex {x!r} {y!r} {z!r}" for x, y, z in each) + "\nendloop\nendfacet"
        for each in triangles
    )
    path.write_text(f"solid body\n{corners}\nendsolid body\n")
    return path


@pytest.fixture(scope="module")
def bodies(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bodies")
    return {name: mesh(stl(folder / f"{name}.stl", triangles)) for name, triangles in RECORD["bodies"].items()}


@pytest.mark.parametrize("name", RECORD["bodies"])
def test_balls_that_drop(bodies, name):
    """The height of the middle of a ball that comes down from above."""
    part, met = bodies[name], 0
    for body, radius, x, y, height in RECORD["drops"]:
        if body == name:
            travel = contact(part, (x, y, 60), (0, 0, -1), radius, 90)
            if height is None:
                assert travel is None
            else:
                met += 1
                assert 60 - travel == pytest.approx(height, abs=WITHIN)
    assert met > 15


@pytest.mark.parametrize("name", RECORD["bodies"])
def test_balls_that_are_pushed(bodies, name):
    """The place along X at which a ball stops."""
    part, met = bodies[name], 0
    for body, radius, y, z, start, x in RECORD["pushes"]:
        if body == name:
            travel = contact(part, (start, y, z), (1, 0, 0), radius, 200)
            if x is None:
                assert travel is None
            else:
                met += 1
                assert start + travel == pytest.approx(x, abs=WITHIN)
    assert met > 10


def test_a_box_of_triangles_is_a_box():
    solid = box((-10, -20, -30), (10, 20, 30))
    part = mesh(pyvista.Box((-10, 10, -20, 20, -30, 30)))
    points = np.random.default_rng(1).uniform(-50, 50, (500, 3))
    assert part(points) == pytest.approx(solid(points), abs=1e-9)
    assert part.exact and part.bounds == pytest.approx(solid.bounds)
    again = pickle.loads(pickle.dumps(part))
    assert (again(points) == part(points)).all()
    assert contact(part - ball((0, 0, 30), 5), (0, 0, 60), (0, 0, -1), 2, 90) == pytest.approx(33, abs=1e-6)
    assert foot(part, (-13, 1, 2))[0] == pytest.approx((-10, 1, 2), abs=1e-6)
    assert contact(part.turned(90), (-40, 0, 0), (1, 0, 0), 2, 90) == pytest.approx(18, abs=1e-9)


def test_inside_out_is_turned_round():
    cube = pyvista.Cube()
    cube.flip_faces(inplace=True)
    assert mesh(cube)([(0, 0, 0), (2, 0, 0)]) == pytest.approx([-0.5, 1.5])


def test_broken_files_are_alarms_and_nothing_else(tmp_path, capfd, recwarn):
    """Cut in the middle, absurd numbers, another format: one Alarm that names the file, nothing on stderr."""
    box = pyvista.Box((0, 10, 0, 10, 0, 5)).triangulate()
    for name in ("a.stl", "a.ply", "a.vtp"):
        box.save(tmp_path / name, binary=name != "a.stl")
    text = (tmp_path / "a.stl").read_text()
    files = {
        "cut.stl": text[: len(text) // 2], "words.stl": text.replace("10", "abc"), "large.stl": text.replace("10", "1e308"),
        "cut.ply": (tmp_path / "a.ply").read_bytes()[:200], "cut.vtp": (tmp_path / "a.vtp").read_bytes()[:500],
        "gone.obj": "v 0 0 0\nf 1 2 3\n", "cut.glb": "glTFxxxx", "cut.gltf": "{",
        "much.vtk": "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 99999999999 float\n",
    }  # fmt: skip
    for name, content in files.items():
        (tmp_path / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        with pytest.raises(Alarm, match=rf"{name} (cannot be read as a body|has no triangles|must be a closed body)"):
            mesh(tmp_path / name)
    assert capfd.readouterr().err == "" and not recwarn.list


def test_what_is_no_body(tmp_path):
    (tmp_path / "empty.stl").write_text("")
    (tmp_path / "rubbish.stl").write_bytes(b"\x00\xff" * 99)
    stl(tmp_path / "open.stl", RECORD["bodies"]["pyramid"][:-1])
    said = {"none.stl": "there is no file", "open.stl": "closed body"}
    for name in ("none.stl", "open.stl", "rubbish.stl", "empty.stl"):
        with pytest.raises(Alarm, match=said.get(name, name)):
            mesh(tmp_path / name)
    (tmp_path / "a.doc").write_text("")
    with pytest.raises(Alarm, match="a mesh is a file .stl, .*, got .*a.doc"):
        mesh(str(tmp_path / "a.doc"))
    with pytest.raises(Alarm, match="path of a file or a body of pyvista, got 5"):
        mesh(5)
    with pytest.raises(Alarm, match="closed body"):
        mesh(pyvista.Plane())


def rounds_about(triangles, points):
    """How often triangles go round points: their solid angles together over 4π (van Oosterom and Strackee, 1983)."""
    a, b, c = (np.array(triangles)[:, k] - points[:, None] for k in range(3))
    la, lb, lc = (np.linalg.norm(each, axis=2) for each in (a, b, c))
    whole = (a * np.cross(b, c)).sum(axis=2)
    part = la * lb * lc + (a * b).sum(axis=2) * lc + (b * c).sum(axis=2) * la + (c * a).sum(axis=2) * lb
    return 2 * np.arctan2(whole, part).sum(axis=1) / (4 * np.pi)


@pytest.mark.parametrize("name", RECORD["bodies"])
def test_the_sign_is_right_near_corners(bodies, name):
    """Also beside the corners and the edges, where two faces are equally far; and the distance is no farther than a corner,
    changes by no more than the way, and its foot is on the surface."""
    triangles, rng = RECORD["bodies"][name], np.random.default_rng(3)
    corners = np.array(triangles).reshape(-1, 3)
    middles = (np.array(triangles) + np.roll(triangles, 1, axis=1)).reshape(-1, 3) / 2
    near = np.concatenate([corners, middles])[rng.integers(0, 2 * len(corners), 600)]
    beside = near + rng.normal(size=(600, 3)) * rng.choice([0.01, 0.3, 3], (600, 1))
    points = np.concatenate([beside, rng.uniform(-40, 40, (300, 3))])
    part = bodies[name]
    found = part(points)
    assert ((found < 0) == (np.abs(rounds_about(triangles, points)) > 0.5)).all()
    assert (np.abs(found[:600]) <= np.linalg.norm(points[:600] - near, axis=1) + 1e-9).all()
    others = points + rng.normal(size=points.shape) * rng.choice([0.01, 1, 10], (900, 1))
    assert (np.abs(part(others) - found) <= np.linalg.norm(others - points, axis=1) + 1e-9).all()
    assert sum(not foot(part, each)[1] for each in points[600:700]) <= 3

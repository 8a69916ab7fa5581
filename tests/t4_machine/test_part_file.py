"""The part of a probe in a setup file: where its surface lies, and what cannot be."""

import math

import pytest

from mnclab import Alarm
from mnclab.machine.setup_file import load

HOLE = "[blank]\nlow = [0, 0, -20]\nhigh = [60, 40, 0]\n[[features]]\nkind = 'hole'\nx = 30\ny = 20\ndiameter = 12\ndepth = 10\n"
CUBE = """solid cube
{}endsolid cube
"""
CORNERS = [(x, y, z) for x in (0, 10) for y in (0, 10) for z in (0, 10)]
FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7),
         (1, 7, 3)]  # fmt: skip


def part(folder, text):
    path = folder / "setup.toml"
    path.write_text(text, encoding="utf-8")
    return load(path).part


def test_a_box_turned_and_put_somewhere(tmp_path):
    """A quarter turn about its zero point, then that point at X100 Y50: the long side lies along Y, at X80 to X100."""
    found = part(tmp_path, "[part]\nbox = [[0, 0, -20], [60, 20, 0]]\nturned = 90\nat = [100, 50, 5]\n")
    assert found([(102, 80, 0), (90, 112, 0), (90, 80, 8)]) == pytest.approx([2, 2, 3], abs=1e-12)


def test_the_part_of_a_design(tmp_path):
    """The wall of the hole lies 6 mm about X30 Y20."""
    (tmp_path / "lid.toml").write_text(HOLE)
    found = part(tmp_path, "[part]\ndesign = 'lid.toml'\nat = [0, 0, 7]\n")
    assert found([(33, 20, 2)]) == pytest.approx([3], abs=1e-9)


def test_a_mesh(tmp_path):
    facet = "facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n"
    text = "".join(facet.format("".join("vertex {} {} {}\n".format(*CORNERS[k]) for k in face)) for face in FACES)
    (tmp_path / "cube.stl").write_text(CUBE.format(text))
    found = part(tmp_path, "[part]\nmesh = 'cube.stl'\nturned = 45\n")
    away = 10 * math.sqrt(0.5) + 3  # the corner (10, 0) stands at (7.07, 7.07)
    assert found([(away, away, 5)]) == pytest.approx([3 * math.sqrt(2)], abs=1e-5)


def test_errors(tmp_path):
    """A burr of 0.5 mm on the upper edge stands out over it, 0.3 mm wide; nothing does in the middle."""
    found = part(tmp_path, "[part]\nbox = [[0, 0, -20], [60, 20, 0]]\nerrors = { burr = [0.5, 0.3] }\n")
    assert float(found([(30, 10, 0.4)])[0]) > 0 and float(found([(30, 0.1, 0.2)])[0]) < 0.2


@pytest.mark.parametrize(
    ("text", "place", "sentence"),
    [
        ("part = 'made'\n", "1:1", "part must be a part, or"),
        ("part = 5\n", "1:1", "part must be a table"),
        ("[part]\nturned = 5\n", "1:2", "part needs one of box, design, mesh, got none"),
        ("[part]\nbox = 5\n", "2:1", "part.box must be two corners, got 5"),
        ("[part]\nbox = [[0, 0, 0], [1, 1]]\n", "2:1", "a corner of part.box must be three numbers"),
        ("[part]\nbox = [[0, 0, 0], [1, 1, 1]]\nmesh = 'a.stl'\n", "1:2", "got box and mesh"),
        ("[part]\nbox = [[0, 0, 0], [1, 1, 1]]\nturned = 'a'\n", "3:1", "part.turned must be a number"),
        ("[part]\nbox = [[0, 0, 0], [1, 1, 1]]\nat = [1]\n", "3:1", "part.at must be three numbers"),
        ("[part]\nbox = [[0, 0, 0], [1, 1, 1]]\nerrors = { bend = 1 }\n", "3:", "part.errors has no 'bend'"),
        ("[part]\nbox = [[0, 0, 0], [1, 1, 1]]\nturn = 1\n", "3:1", "part has no 'turn'"),
        ("[part]\nmesh = 5\n", "2:1", "part.mesh must be the name of a file, got 5"),
        ("[part]\nmesh = 'nowhere.stl'\n", "2:1", "nowhere.stl"),
        ("[part]\ndesign = 'nowhere.toml'\n", "2:1", "nowhere.toml"),
    ],
)
def test_what_cannot_be(tmp_path, text, place, sentence):
    with pytest.raises(Alarm) as found:
        part(tmp_path, text)
    assert f"setup.toml:{place}" in str(found.value) and sentence in str(found.value)

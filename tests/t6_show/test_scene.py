"""Scenes: what stands in them, that they draw, and a sentence where nothing can draw."""

import sys

import numpy as np
import pytest

import mnclab
from mnclab import Alarm, Kind
from mnclab.show import scene as module
from mnclab.workpiece.blank import cylinder

pytest.importorskip("pyvista")

PROGRAM = "G90 G54 T1\nG0 X0 Y0 Z5\nG1 Z-2 F100\nG2 X30 Y0 R20 F200\nT2\nG0 Z20\n"
SETUP = mnclab.Setup(stock=((-5, -5, -10), (35, 30, 0)))


def bounds(scene, name):
    return np.array(scene.actors[name].bounds).reshape(3, 2)


def test_a_round_blank_is_round(run):
    scene = run.again(mnclab.Setup(stock=cylinder(20, -10, 0, at=(15, 12, 0)))).scene()
    assert np.allclose(bounds(scene, "blank"), [(-5, 35), (-8, 32), (-10, 0)])
    scene = run.scene(stock=cylinder(3, 0, 9, "X"))
    assert np.allclose(bounds(scene, "blank"), [(0, 9), (-3, 3), (-3, 3)])
    with pytest.raises(Alarm, match="stock must be"):
        run.scene(stock="steel")


def test_path_tool_and_blank_stand_where_they_are(run):
    scene = run.scene()
    path = run.toolpath
    cuts = path[np.isin(path.kind, (Kind.LINE, Kind.ARC))]
    assert np.allclose(bounds(scene, "cuts"), cuts.bounds.T, atol=0.02)
    assert np.allclose(bounds(scene, "blank"), [(-5, 35), (-5, 30), (-10, 0)])
    tool = bounds(scene, "tool")  # tool 2, radius 4, over the end of the path
    assert np.allclose(tool[:, 0], path.end[-1] - [4, 4, 0], atol=0.02) and tool[2, 1] > path.end[-1, 2]
    earlier = bounds(run.scene(row=3), "tool")  # tool 1, radius 5
    assert np.allclose(earlier[:, 0], path.end[3] - [5, 5, 0], atol=0.05)


def test_the_picture_shows_the_colours(run):
    picture = run.scene(stock=False, tool=False).screenshot(None, return_img=True)
    assert picture.shape == (600, 800, 3)
    red, green, blue = picture.astype(int).transpose(2, 0, 1)
    assert (blue > red + 60).sum() > 200 and (red > blue + 60).sum() > 50


@pytest.mark.parametrize("colour", ["feed", "tool", "z", "line"])
def test_colours_come_from_the_columns(run, colour):
    scene = run.scene(colour)
    data = scene.actors["cuts"].mapper.dataset[colour]
    expected = {"feed": (100, 200), "tool": (1, 1), "z": (-2, 5), "line": (3, 4)}[colour]
    assert (data.min(), data.max()) == pytest.approx(expected)
    for wrong in ("depth", None, 5, [1], np.zeros(3)):
        with pytest.raises(Alarm, match="colour must be one of"):
            run.scene(wrong)


def test_jupyter_gets_a_picture_with_a_name(run):
    bundle = run.scene()._repr_mimebundle_()
    assert bundle["text/html"].startswith('<img alt="scene of &lt;Toolpath: ')
    assert bundle["image/png"][:8] == "iVBORw0K"


def test_a_path_without_moves_is_an_empty_scene():
    assert mnclab.run("G90\n", "mnc").scene().png()[:4] == b"\x89PNG"


def test_a_machine_that_cannot_draw_says_so_in_a_sentence(run, monkeypatch):
    monkeypatch.setattr(module.sys, "platform", "linux")
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv(module.WINDOW, raising=False)
    monkeypatch.setattr(module.ctypes.util, "find_library", lambda name: None)
    with pytest.raises(Alarm, match="neither a screen nor libEGL nor libOSMesa"):
        run.scene()
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(Alarm, match="need pyvista"):
        run.scene()


def test_a_lathe_lies_with_z_to_the_right():
    run = mnclab.run("S800\nM3\nF20\nX4000 ~ *\nZ200 ~\nZ-1000\n", "nc-31")
    scene = run.scene()
    right = np.cross(scene.camera.direction, scene.camera.up)
    assert np.allclose(right, (0, 0, 1)) and np.allclose(scene.camera.up, (1, 0, 0))
    assert bounds(scene, "tool")[0, 1] > run.toolpath.end[-1, 0]  # the shank away from the work

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


@pytest.fixture
def written(monkeypatch):
    """The texts that scenes write, with their places: a list that grows."""
    import pyvista

    found = []

    def note(plotter, points, labels, **options):
        found.extend(zip(labels, np.asarray(points).tolist()))

    monkeypatch.setattr(pyvista.Plotter, "add_point_labels", note)
    return found


def pixels(scene, points):
    """Where places (n, 3) are in the picture (n, 2), from its lower left corner."""
    camera, (width, height) = scene.camera, scene.window_size
    right = np.cross(camera.direction, camera.up)
    flat = (np.asarray(points) - camera.focal_point) @ np.stack([right, camera.up], axis=1)
    return flat * height / (2 * camera.parallel_scale) + (width / 2, height / 2)


def filled(scene, points):
    """The shares of the picture's width and height that places take, all of which are in it."""
    found, size = pixels(scene, points), np.array(scene.window_size)
    assert (found > 0).all() and (found < size).all(), found
    return np.ptp(found, axis=0) / size


CORNERS = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]


@pytest.mark.parametrize("mm", [1.0, 0.0005, 250.0])
def test_what_is_shown_fills_the_picture_at_every_size(written, mm):
    """A blank of 20 by 10 by 5 units, from 10 mm to 5 m long: no margin is half the picture."""
    text = f"G17 G90 G54\nG0 X0 Y0 Z{mm}\nG1 Z{-mm} F100\nG1 X{20 * mm} Y{10 * mm}\nG0 Z{mm}\n"
    scene = mnclab.run(text, "mnc").scene(stock=((0, 0, -4 * mm), (20 * mm, 10 * mm, 0)), tool=False)
    corners = np.array(CORNERS) * (20 * mm, 10 * mm, 5 * mm) - (0, 0, 4 * mm)
    assert filled(scene, corners).max() > 0.7
    assert {text for text, _ in written} >= {"X, mm", "Y, mm", "Z, mm"}


def test_numbers_of_the_rulers_are_round_in_the_picture_and_apart(written, run):
    scene = run.scene()
    texts = [text for text, _ in written]
    places = pixels(scene, [at for _, at in written])
    assert (places > 6).all() and (places < np.array(scene.window_size) - 6).all()
    half = np.array([(7 * len(text) / 2, 6) for text in texts])
    for k, (a, b) in enumerate(zip(places, half)):
        apart = np.abs(places[k + 1 :] - a) >= half[k + 1 :] + b
        assert apart.any(axis=1).all(), texts[k]
    along = [(text, at[0]) for text, at in written if text.replace("\N{MINUS SIGN}", "-").lstrip("-").isdigit()]
    assert len(along) >= 8
    assert {"0", "10", "20", "30"} <= {text for text, _ in along}


def test_a_flat_body_has_two_numbers_along_its_short_axis(written):
    text = "G17 G90 G54\nG0 X0 Y0 Z0\nG1 X120 Y90 F100\n"
    mnclab.run(text, "mnc").scene(stock=((0, 0, -20), (120, 90, 0)), tool=False)
    upright = [text for text, at in written if at[0] < 0 and text.startswith("\N{MINUS SIGN}")]
    assert upright == ["\N{MINUS SIGN}20", "\N{MINUS SIGN}10"]


def test_a_program_in_inches_has_rulers_and_scales_in_inches(written):
    run = mnclab.run("G20 G17 G90 G54\nT1 M6\nS1000 M3\nG0 X0 Y0 Z0.5\nG1 Z-1 F10\nX2 F20\nY2\n", "iso")
    scene = run.scene("feed", tool=False)
    assert {"X, in", "Y, in", "Z, in", "2.0", "0.5"} <= {text for text, _ in written}
    assert sorted(set(scene.actors["cuts"].mapper.dataset["feed"])) == pytest.approx([10, 20])
    assert [*scene.scalar_bars.keys()] == ["feed, in/min\n"]


def test_a_lathe_counts_diameters_and_shows_chuck_and_insert(written):
    """The bar of radius 30 in jaws up to 30 + 15: the ruler says 60 where x is 30, and the insert's tip is that of the path."""
    chuck = mnclab.blank.chuck(30, -60, grip=10, jaws=15, body=20)
    setup = mnclab.Setup(stock=cylinder(30, -60, 0), fixtures=(chuck,), start=(50, 0, 20))
    run = mnclab.run("M3 T1\nS500 G97 G95 F0.2\nG00 X28 Z2\nG01 Z-30\n", "jnc-t01", setup)
    scene = run.scene()
    assert "X (diameter), mm" in [text for text, _ in written] and "Y, mm" not in [text for text, _ in written]
    sizes = [(int(text), at[0]) for text, at in written if text.isdigit() and at[2] < -80]  # beside the left edge
    assert len(sizes) > 3 and all(text == pytest.approx(2 * abs(x)) for text, x in sizes)
    assert bounds(scene, "fixture 0")[2] == pytest.approx((-80, -50))
    tip = run.toolpath.end[-1]
    assert bounds(scene, "tool")[[0, 2], 0] == pytest.approx(tip[[0, 2]], abs=0.05)
    assert bounds(scene, "holder")[0, 1] > tip[0] + 5


def test_a_rapid_goes_in_a_scene_as_its_axes_go():
    """X100 and Y40 at equal speed: at Y40 the tool is near X40 and not at X100, for it turns there."""
    run = mnclab.run("G17 G90 G54\nG1 X0 Y0 Z0 F100\nG0 X100 Y40\n", "mnc", mnclab.Setup(start=(0, 0, 0)))
    points = run.scene(tool=False).actors["rapids"].mapper.dataset.points
    near = points[np.abs(points[:, 1] - 40) < 0.01]
    assert 40 <= near[:, 0].min() < 60  # while Y brakes X goes on
    straight = mnclab.Setup(start=(0, 0, 0), limits=mnclab.Limits(rapid_motion="line"))
    points = run.again(straight).scene(tool=False).actors["rapids"].mapper.dataset.points
    assert points[:, 1] == pytest.approx(0.4 * points[:, 0], abs=1e-3)


def test_a_tool_a_thousand_times_larger_than_its_path_is_left_out():
    run = mnclab.run("G17 G90 G54 T1\nG0 X0 Y0 Z0.01\nG1 Z-0.01 F10\nX0.02\n", "mnc")
    assert "tool" not in run.scene().actors


def test_a_scale_has_round_numbers():
    """From 74.9 to 200 in steps of 50, lines as whole numbers."""
    bar, limits = module.bar_of("feed, mm/min", np.array([74.8964, 200.0]))
    assert limits == (50, 200) and bar["n_labels"] == 4 and bar["fmt"] % limits[0] == "50"
    bar, limits = module.bar_of("line", np.array([3.0, 5.0]), whole=True)
    assert limits == (3, 5) and bar["n_labels"] == 3

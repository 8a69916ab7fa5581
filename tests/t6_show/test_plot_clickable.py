"""A picture names the line of a move that is pointed at: where its strokes lie, what they say, when there are none."""

import re
from functools import partial
from html import unescape
from pathlib import Path

import numpy as np
import pytest
from tools import running

import mnclab
from mnclab.show.plot.clickable import MOST

run = partial(running.run, ok=None)
ELL = "G90 G54\nG0 X0 Y0\nG1 X40 F100\nG1 Y30 // up & <on>\n"
DRILL = "G90 G54 T2 S500 M3\nG0 X0 Y0 Z5\nG83 X20 Y10 Z-30 R2 K5 F120\nG80\n"


def strokes(html):
    """(program, line) -> (what is said, polylines of points in inches from the upper left corner).

    The first point stands twice, so that a move along the line of sight is a dot.
    """
    found = {}
    for group in re.findall(r"<g .*?</g>", html):
        line, program = re.search(r'data-line="(\d+)"', group)[1], re.search(r'data-program="(\d+)"', group)
        drawn = re.search(r' d="([^"]*)"', group)[1].split("M")[1:]
        said = unescape(re.search(r"<text[^>]*>(.*)</text>", group)[1])
        points = [np.array(piece.split(), dtype=float).reshape(-1, 2)[1:] / 200 for piece in drawn]
        found[int(program[1]) if program else 0, int(line)] = said, points
    return found


def shown(figure):
    """Where points of the path (mm) lie in the first axes: inches from the upper left corner."""
    ax, high = figure.axes[0], figure.get_figheight()
    return lambda *points: ax.transData.transform(points) / figure.dpi * (1, -1) + (0, high)


def test_a_line_has_its_moves_and_says_its_text():
    figure = run(ELL).plot()
    found, place = strokes(figure.html()), shown(figure)
    assert list(found) == [(0, 3), (0, 4)]  # G0 X0 Y0 goes nowhere and lies under the first: nothing of its own to see
    said, (way,) = found[0, 3]
    assert said == "line 3: G1 X40 F100" and np.allclose(way, place((0, 0), (40, 0)), atol=0.005)
    said, (way,) = found[0, 4]
    assert said == "line 4: G1 Y30 // up & <on>" and np.allclose(way, place((40, 0), (40, 30)), atol=0.005)


def test_an_arc_is_followed_within_a_pixel():
    figure = run("G90 G54\nG0 X50 Y0\nG3 X0 Y50 I-50 J0 F100\n").plot()
    _, (way,) = strokes(figure.html())[0, 3]
    centre, rim = shown(figure)((0, 0), (50, 0))
    assert np.allclose(np.hypot(*(way - centre).T), np.hypot(*(rim - centre)), atol=0.01)
    assert len(way) > 10


def test_both_views_show_the_moves_of_a_line_and_a_plunge_is_a_dot():
    figure = run(DRILL).plot()
    _, ways = strokes(figure.html())[0, 3]
    (dot,) = shown(figure)((20, 10))
    assert len(figure.axes) == 2
    assert any(np.allclose(way[-1], dot, atol=0.005) for way in ways)
    side = figure.axes[1].transData.transform([(20, -30)]) / figure.dpi * (1, -1) + (0, figure.get_figheight())
    assert min(np.abs(way - side).max(axis=1).min() for way in ways) < 0.01


def test_cuts_lie_over_rapids():
    """The last group is on top: the cut along X, over the rapid that comes back along it."""
    found = strokes(run("G90 G54\nG0 X0 Y9\nG0 Y0\nG1 X40 F100\nG0 X0\n").plot().html())
    assert list(found)[-1] == (0, 4) and (0, 5) in found


def test_a_called_program_is_named(tmp_path):
    files = {"SUB.H": "BEGIN PGM SUB MM\nL X+40 FMAX\nEND PGM SUB MM\n"}
    text = "BEGIN PGM A MM\nTOOL CALL 1 Z S100\nL Y+10 FMAX\nCALL PGM SUB\nEND PGM A MM\n"
    found = strokes(mnclab.run(text, "tnc-620", mnclab.Setup(files=files)).plot().html())
    assert found[0, 3][0] == "line 3: L Y+10 FMAX" and re.fullmatch(r"SUB\S* line 2: L X\+40 FMAX", found[1, 2][0])


def test_a_long_line_is_cut_off_within_the_picture():
    figure = run("G90 G54\nG1 X40 F100 // " + "very " * 60 + "\n").plot()
    ((said, _),) = strokes(figure.html()).values()
    assert said.endswith("…") and len(said) * 0.0665 < figure.get_figwidth()  # 0.6 of 22 units, 200 an inch


@pytest.mark.parametrize(("moves", "there"), [(MOST - 10, True), (MOST + 2, False)])
def test_a_long_path_has_none(moves, there):
    text = "G90 G54\nG0 X0 Y0\n" + "".join(f"G1 X{k % 50} Y{k * 7 % 41} F100\n" for k in range(1, moves))
    assert ("<svg" in run(text).plot().html()) is there


def test_what_is_cut_off_at_the_border_is_not_there():
    """Strokes lie within the picture, however far the path goes."""
    figure = run("G90 G54\nG0 X100000.5 Y-20000 Z5\nG1 X100003 F100\nX100000\n").plot()
    found = strokes(figure.html())
    assert set(found) == {(0, 3), (0, 4)}
    size = figure.get_size_inches()
    assert all(((way >= 0) & (way <= size)).all() for _, ways in found.values() for way in ways)


@pytest.mark.parametrize("scale", [0.01, 5000.0])
def test_size_does_not_matter(scale):
    figure = run(f"G90 G54\nG1 X{scale:g} F100\nY{scale:g}\n").plot()
    _, (way,) = strokes(figure.html())[0, 2]
    assert np.allclose(way, shown(figure)((0, 0), (scale, 0)), atol=0.01)


def test_without_a_move_words_stand_in_the_place_of_the_picture():
    figure = run("G90\nG1 X4,5 F100\n").plot()
    assert figure.axes == [] and figure.alt == "tool path: no moves; stopped in line 2"
    first, *rest = [text.get_text() for text in figure.texts]
    assert first == "no moves" and "is no part of a number" in " ".join(rest)
    assert [text.get_text() for text in run("G90\n").plot().texts] == ["no moves"]
    boxes = [text.get_window_extent() for text in figure.texts]
    wide, high = figure.get_size_inches() * figure.dpi
    assert all(0 <= box.x0 and box.x1 <= wide and 0 <= box.y0 and box.y1 <= high for box in boxes)
    assert not any(a.overlaps(b) for k, a in enumerate(boxes) for b in boxes[:k])


def test_a_feed_over_time_names_its_lines():
    """From standing over the programmed feed to standing, as long as the whole takes."""
    profile = run(ELL, limits="small-mill").profile()
    figure = profile.plot()
    found, place = strokes(figure.html()), shown(figure)
    _, (first,) = found[0, 3]
    _, (last,) = found[0, 4]
    (left, stands), (right, feed) = place((0, 0), (profile.time, 100))
    assert np.allclose(first[0], (left, stands), atol=0.005) and np.allclose(last[-1], (right, stands), atol=0.005)
    assert abs(min(first[:, 1]) - feed) < 0.005 and abs(min(last[:, 1]) - feed) < 0.005


def test_a_compensated_contour_and_the_path_of_the_centre_name_their_lines():
    text = "G90 G54 T1 S500 M3\nG0 X-20 Y0\nG41 G1 X0 Y0 F100\nX40\nX80\nG40 Y-20\n"
    figure = run(text, tools={1: mnclab.Tool(radius=5)}).plot_compensation()
    _, ways = strokes(figure.html())[0, 4]
    place = shown(figure)
    assert len(ways) == 2
    for way, y in zip(ways, (5, 0), strict=True):  # to the left of the contour, and the contour
        assert np.allclose(way, place((0, y), (40, y)), atol=0.005)


def test_what_lies_on_a_cylinder_names_its_lines():
    found = mnclab.run(Path(__file__).parents[2] / "data/programs/tnc-620/drum_cam.h").plot(view="unrolled")
    assert any(said.startswith("line ") and ": " in said for said, _ in strokes(found.html()).values())

"""What a picture writes counts in the unit of the program, and a line of it is the way that the tool goes."""

import re

import numpy as np
import pytest

import mnclab as mnc
from mnclab import Limits, Setup, Tool
from mnclab.path.profile.ramps import bent
from mnclab.path.toolpath import Kind

INCH = "G20 G54\nT1 M6\nS900 M3\nG0 X0 Y0 Z1\nG1 Z-.25 F10\nG1 X3{}\nG0 Z1\n"
SETUP = Setup(tools={1: Tool(diameter=25.4)}, stock=((-25.4, -25.4, -25.4), (101.6, 50.8, 0)))


def texts(picture):
    """All that stands in a picture or at its axes."""
    found = [text.get_text() for text in picture.texts]
    for ax in picture.axes:
        found += [ax.get_title(), ax.get_xlabel(), ax.get_ylabel(), *(text.get_text() for text in ax.texts)]
    return " | ".join(found)


def test_a_part_of_an_inch_program_is_told_in_inches():
    """A slot 3 in long with a mill of 1 in, a quarter deep: (3 + pi / 4) / 4 = 0.94635 in³; the middle of the blank is Y0.5."""
    part = mnc.run(INCH.format(""), "g43", SETUP).workpiece(step=0.5)
    said = texts(part.plot(section="XZ", at=12.7))
    assert "X, in" in said and "Y, in" in said and "depth, in" in said and "Y = 0.5 in" in said
    assert "mm" not in said
    (volume,) = re.findall(r"([\d.]+) in³ removed", said)
    assert float(volume) == pytest.approx((3 + np.pi / 4) / 4, rel=1e-4)


def test_two_inch_paths_are_told_in_inches():
    one, other = (mnc.run(INCH.format(words), "g43", SETUP) for words in ("", " Y.1"))
    found = mnc.diff(one, other)
    said = texts(found.plot())
    assert "largest deviation 0.1 in" in said and "X, in" in said and "mm" not in said
    assert "largest deviation 0.1 in" in repr(found) and "X3 Y0 Z" in repr(found) and " mm" not in repr(found)
    metric = mnc.run("G54\nT1 M6\nS900 M3\nG0 X0 Y0 Z25.4\nG1 Z-6.35 F254\nG1 X76.2\nG0 Z25.4\n", "g43", SETUP)
    assert " mm" in repr(mnc.diff(metric, other)) and " in " not in mnc.diff(metric, other).sentence  # of two units it is mm


def test_the_crosses_where_a_tool_has_no_room_are_named():
    """A slot of 4 mm with a mill of radius 5: hatched is what it takes away, crosses stand at the elements without room."""
    begin = "G54 G17 G90 T1 S1000 M3\nG0 X-20 Y-20 Z5\nG1 Z-2 F200\n"
    text = f"{begin}G41 X0 Y0\nY40\nX8\nY20\nX12\nY40\nX40\nY0\nX-10\nG40 X-20 Y-20\n"
    picture = mnc.run(text, "mnc").plot_compensation()
    legends = [(legend.get_texts(), legend.legend_handles) for legend in picture.legends]
    named = {each.get_text(): handle for pairs in legends for each, handle in zip(*pairs)}
    (drawn,) = (line for line in picture.axes[0].lines if line.get_label() == "_gouges")
    assert named["no room for the tool"].get_marker() == drawn.get_marker() == "x"
    assert named["no room for the tool"].get_color() == drawn.get_color()


# Axes that do not wait for each other, 10 m/min and 1 m/s²: X goes 90 mm and Y 30 mm. Both speed up alike and so go at 45
# degrees; at rest after 30 mm, Y has its speed of 166.7 mm/s after 13.9 mm.

BENT = "G54\nT1 S1000 M3\nG0 X0 Y0 Z5\nG1 Z-1 F200\nG1 X{}\nG0 Z5\nG0 X100 Y30\nG1 X110\n"
AXES = Limits(rapid_motion="axes")


def on_its_way(places):
    """Whether places (k, 2) are those of such a rapid: 45 degrees as long as both speed up, then Y30 until the end."""
    begun = places[places[:, 1] < 13.8]
    return len(begun) > 1 and np.allclose(begun[:, 0] - 10, begun[:, 1]) and (places[places[:, 0] > 70][:, 1] > 29.99).all()


@pytest.fixture
def turned():
    return mnc.run(BENT.format(10), "mnc", Setup(limits=AXES))


def test_a_rapid_is_as_bent_in_a_drawing_in_true_size(turned, tmp_path):
    text = turned.save(tmp_path / "a.svg", true_size=True).read_text("utf-8")
    (way,) = re.findall(r'class="rapid" d="M([^"]+)"', text)
    assert on_its_way(np.array([each.split() for each in way.split(" L")], dtype=float) * (1, -1))
    corners = re.findall(r"LINE\n +8\nRAPID\n +10\n(\S+)\n +20\n(\S+)\n", turned.save(tmp_path / "a.dxf").read_text())
    places = np.array(corners, dtype=float)
    assert on_its_way(places[places[:, 0] >= 10])


def test_a_rapid_is_as_bent_where_two_paths_are_compared(turned):
    other = mnc.run(BENT.format(12), "mnc", Setup(limits=AXES))
    (ax,) = mnc.diff(turned, other).plot(view="XY").axes
    dashed = next(line for line in ax.lines if line.get_linestyle() == "--")
    places = np.column_stack(dashed.get_data())
    assert on_its_way(places[np.isfinite(places).all(axis=1) & (places[:, 0] >= 10)])


def test_a_bent_path_has_the_same_ends_and_rows(turned):
    path, found = turned.toolpath, bent(turned.toolpath, turned.rapids, 0.01)
    assert len(found) > len(path) and (found.start[1:] == found.end[:-1]).all()
    last = np.append(found.step[1:] != found.step[:-1], True)
    assert (found.end[last & (found.kind == Kind.RAPID)] == path.end[path.kind == Kind.RAPID]).all()
    assert len(bent(path, Limits(rapid_motion="line"), 0.01)) == len(path)

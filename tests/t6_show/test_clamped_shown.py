"""A part that was cut before, as a blank in pictures, scenes, players and files: its hole is there, where it stands now."""

import functools

import numpy as np
import pytest
from t3_workpiece.lathe import SHARP
from tools.milled import MILL
from tools.running import run

import mnclab
from mnclab.geometry.contours import Contour
from mnclab.show import solids
from mnclab.show.player.part import PARTS, part, section
from mnclab.show.player.payload import Packer

BLOCK = ((100, 50, -220), (160, 90, -200))
SETUP = {"tools": {1: MILL}, "datums": {1: (100, 50, -200)}, "start": (100, 50, -150)}
HOLE = "G17 G90 G54\nT1\nS1000 M3 F500\nG0 Z50\nG0 X15 Y10\nG1 Z-30\nG0 Z50\n"  # radius 5, now at 15 30
SLOT = "G17 G90 G54\nT1\nS1000 M3 F500\nG0 Z50\nG0 X30 Y20\nG1 Z-4\nX50\nG0 Z50\n"
TURN = "T1\nG97 S500 M3\nG94 F20.0\nG90\nG00 X35 Z2\nG00 X20\nG01 Z-20\nG01 X35\nG00 Z5\n"


@functools.cache
def second():
    return run(SLOT, stock=run(HOLE, stock=BLOCK, **SETUP).workpiece().turned_over("x"), **SETUP)


class Kept(Packer):
    """The columns as they were given."""

    def __init__(self):
        super().__init__()
        self.columns = []

    def add(self, values):
        self.columns.append(np.asarray(values))
        return super().add(values)


def test_the_picture_of_the_path_has_the_hole():
    lines = [line.get_xydata() for line in second().plot(view="XY").axes[0].lines]
    rings = [Contour(line[:-1]) for line in lines if len(line) > 50 and np.allclose(line[0], line[-1])]
    middles = [ring.bounds.mean(axis=0) for ring in rings if abs(ring.area) == pytest.approx(25 * np.pi, rel=1e-3)]
    assert middles and middles[0] == pytest.approx((15, 30), abs=1e-3)


def test_body_and_report_and_words():
    body = solids.stock_of(second())
    assert body.volume == pytest.approx(48000 - 25 * np.pi * 20, rel=1e-3)
    assert np.ptp(body.points, axis=0) == pytest.approx((60, 40, 20))
    assert "turned over" in repr(second().setup) and "a part cut before" in second().setup._repr_html_()


def test_the_player_begins_with_the_part_as_it_is():
    """Its maps of heights: 20 thick, nothing in the hole."""
    pack = Kept()
    cutting = second().workpiece().cutting
    found = part(pack, cutting, cutting.path)
    top, floor = (pack.columns[found[name]].reshape(found["shape"]) / PARTS for name in ("top", "floor"))
    middles = (low + found["step"] * (np.arange(n) + 0.5) for low, n in zip(found["low"][::-1], found["shape"]))
    y, x = np.meshgrid(*middles, indexing="ij")
    hole = np.hypot(x - 15, y - 30) < 5
    assert np.array_equal(top - floor == 0, hole) and (floor == -20).all() and (top[~hole] == 0).all()
    assert len(second().stock.edges()) >= 14


def test_a_part_that_nothing_has_cut_yet_has_pictures(tmp_path):
    over = second().workpiece().turned_over("y")
    for colour in ("depth", "tool", "line"):
        assert over.plot(colour=colour).axes
    for suffix in ("stl", "vtk", "csv"):
        assert over.save(tmp_path / f"over.{suffix}").stat().st_size > 1000
    assert (over.solid().row == -1).all() and (over.cut_by == -1).all() and not over.removed_by_row().any()


def test_the_section_of_a_lathe_begins_with_the_part_as_it_is():
    setup = {"tools": {1: SHARP}, "start": (100, 0, 100)}
    first = run(TURN, "jnc-t01", stock=mnclab.blank.cylinder(30, -60, 0), **setup)
    over = run(TURN, "jnc-t01", stock=first.workpiece().turned_over("x"), **setup)
    bar = section(Packer(), over.workpiece().cutting)["bar"]
    assert sorted(set(map(tuple, bar[0]))) == [(-60, 0), (-60, 20), (-40, 20), (-40, 30), (0, 0), (0, 30)]
    assert solids.stock_of(over).volume == pytest.approx(np.pi * (400 * 20 + 900 * 40), rel=1e-3)
    assert over.plot().axes and over.workpiece().plot().axes and over.workpiece().grip == 20


def test_a_lathe_shows_no_part_of_what_was_milled(tmp_path):
    run_ = run(TURN, "jnc-t01", stock=second().workpiece(), tools={1: SHARP}, start=(100, 0, 100))
    assert run_.save(tmp_path / "page.html").exists()
    with pytest.raises(mnclab.Alarm, match="boxes or bodies about Z"):
        run_.workpiece()

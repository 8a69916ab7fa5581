"""A part of very many moves: found by erosion, told so, and its volumes beside closed forms and the exact sweep."""

import numpy as np
import pytest

from mnclab import Kind, Tool, Toolpath
from mnclab.workpiece.blank import Box, cylinder
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling import milled
from mnclab.workpiece.milling.erosion import ERROR
from mnclab.workpiece.milling.milled import EXACT, Milled

FLAT, BALL = Tool(radius=4.0, kind="mill"), Tool(radius=3.0, corner=3.0, kind="mill")
BLANK = Box((0.0, 0.0, -20.0), (80.0, 60.0, 0.0))


def cutting(points, tools=(FLAT,), which=None, stock=BLANK):
    """Lines through points (n + 1, 3)."""
    count = len(points) - 1
    path = Toolpath.chain(np.asarray(points, dtype=np.float64), {"kind": np.full(count, Kind.LINE, np.uint8)})
    which = np.zeros(count, dtype=np.int64) if which is None else which
    return Cutting(path, list(tools), which, stock)


def passes(depth, count, low=-10.0, high=90.0, apart=7.0):
    """Level passes along X over the whole blank, in so many moves."""
    ways = [(x, y) for k, y in enumerate(np.arange(0, 64, apart)) for x in ((low, high) if k % 2 == 0 else (high, low))]
    corners = np.array(ways)
    s = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(corners, axis=0), axis=1))])
    along = np.union1d(np.linspace(0, s[-1], count + 1), s)
    return np.column_stack([np.interp(along, s, corners[:, 0]), np.interp(along, s, corners[:, 1]), np.full(len(along), depth)])


@pytest.mark.deep
def test_a_faced_blank():
    """Every cell lies at one height: what was taken away is a plate."""
    part = Milled(cutting(passes(-3.0, EXACT + 5)))
    assert part.method == "erosion of the height raster" and part.error == pytest.approx(ERROR * part.step)
    assert (part.heights == -3.0).all() and part.at(33.3, 44.4) == -3.0
    assert part.removed == pytest.approx(80 * 60 * 3, rel=1e-12)
    assert part.volume == pytest.approx(80 * 60 * 17, rel=1e-12)
    assert part.removed_by_row().sum() == pytest.approx(part.removed, rel=1e-12)
    assert (part.cut_by >= 0).all()
    y = part.cutting.path.end[part.cut_by[:, 100], 1]
    assert (np.diff(y) >= 0).all() and (np.abs(y - part.y) <= 4).all()  # pass after pass, each by a tool over it


@pytest.mark.deep
def test_layers_and_tools_share_what_they_took():
    """Two layers and then air: each layer of its own tool is a plate, the last took nothing."""
    points = np.concatenate([passes(-2.0, 9000), passes(-5.0, 9000), passes(-4.0, 9000)])
    which = np.zeros(len(points) - 1, dtype=np.int64)
    first = len(passes(-2.0, 9000))
    which[first:] = 1
    which[2 * first :] = 2
    wide = Tool(radius=4.5, kind="mill")
    part = Milled(cutting(points, [FLAT, wide, FLAT], which))
    rows = part.removed_by_row()
    assert rows[:first].sum() == pytest.approx(80 * 60 * 2, rel=1e-9)
    assert rows[first : 2 * first].sum() == pytest.approx(80 * 60 * 3, rel=1e-9)
    assert rows[2 * first + 1 :].sum() == 0
    assert (part.cut_by >= first - 1).all() and (part.cut_by < 2 * first).all()


@pytest.mark.parametrize("stock", [BLANK, Box((0.0, 0.0, -20.0), (80.0, 60.1, 0.0)), cylinder(29, -20, 0, at=(40, 30, 0))])
def test_beside_the_exact_sweep(monkeypatch, stock):
    """The same ball passes both ways: heights within a tenth of a cell on the mean, volume within 0.3 %."""
    rng = np.random.default_rng(1)
    points = passes(-3.0, 600, 4.0, 76.0, 2.0)
    points[:, 2] += np.sin(points[:, 0] / 7) + rng.uniform(-0.1, 0.1, len(points))
    job = cutting(points, [BALL], stock=stock)
    exact = Milled(job, 0.4)
    assert exact.method == "exact sweep"
    monkeypatch.setattr(milled, "EXACT", 100)
    many = Milled(job, 0.4)
    off = many.heights - exact.heights
    assert off.min() >= -1e-9 and off.mean() < 0.02
    assert many.removed == pytest.approx(exact.removed, rel=3e-3)
    assert (many.cut_by < 0).sum() == pytest.approx((exact.cut_by < 0).sum(), rel=0.02, abs=20)
    by_row, expected = many.removed_by_row(), exact.removed_by_row()
    assert by_row.sum() == pytest.approx(many.removed, rel=1e-12)
    quarters = np.arange(len(by_row)) * 4 // len(by_row)
    assert np.bincount(quarters, by_row) == pytest.approx(np.bincount(quarters, expected), rel=0.02)


def test_sections_and_solids_follow_the_map(monkeypatch):
    """A pocket of 40 × 20 with round corners of 4: its walls stand within a cell, and the part says so."""
    monkeypatch.setattr(milled, "EXACT", 100)
    points = passes(-3.0, 600, 4.0, 76.0, 2.0)
    points[:, :2] = np.clip(points[:, :2], (24.0, 24.0), (56.0, 36.0))
    part = Milled(cutting(points), 0.5)
    outline, hole = sorted(part.cut("XY", -1.0), key=lambda each: -each.area)
    round_ = 40 * 20 - (4 - np.pi) * 4**2
    assert outline.area == pytest.approx(80 * 60, rel=1e-6)
    assert -hole.area == pytest.approx(round_, abs=0.5 * 2 * (40 + 20))
    assert part.solid().volume == pytest.approx(80 * 60 * 20 - 3 * round_, abs=3 * 0.5 * 2 * (40 + 20))
    assert part.notes[-1].startswith("level sections, solids and pictures follow the map")

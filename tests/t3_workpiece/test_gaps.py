"""Upright lines through what tilted tools sweep: against points of them seen along the tool, by the heights of upright moves."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mnclab.workpiece.clamped import Placement
from mnclab.workpiece.cutting import frames_along
from mnclab.workpiece.milling import gaps as searched
from mnclab.workpiece.milling.gaps import Gaps
from mnclab.workpiece.milling.moves import CHORD, Moves, joined
from mnclab.workpiece.milling.swept import left_by

BOX = np.array([[-50.0] * 3, [50.0] * 3])
UPRIGHTS = np.linspace(-45, 45, 301)


def one(start, end, cutter, centre=None, sweep=0.0):
    """A move of a cutter (radius, flat, corner, slope)."""
    bent = centre is not None
    columns = (np.array([float(value)]) for value in cutter)
    turn = np.array([bent]), np.array([centre if bent else (0.0, 0.0)]), np.array([sweep])
    return Moves(np.zeros(1, dtype=int), np.array([start]), np.array([end]), *turn, *columns)


def gaps_of(moves, direction, shift=(0.0, 0.0, 0.0)):
    placement = Placement(frames_along(np.array([direction]) / np.linalg.norm(direction))[0], np.array(shift))
    return Gaps(((moves, placement),), BOX), placement


def in_gap(gaps, x, y):
    """Which of the places `UPRIGHTS` over points (m,) are in a gap (z, m)."""
    places = (each.ravel() for each in np.broadcast_arrays(x, y, UPRIGHTS[:, None]))
    return gaps.empty(*places).reshape(len(UPRIGHTS), len(x))


CUTTERS = {"flat": (4, 4, 0, 0), "round": (5, 2, 3, 0), "ball": (3, 0, 3, 0), "point": (4, 0, 0, 0.6)}
WAYS = {"plunge": ((1, 2, 3), (1, 2, -6)), "level": ((-7, 3, 1), (6, -2, 1)), "ramp": ((-7, 3, 4), (6, -2, -3))}


@pytest.mark.parametrize("cutter", CUTTERS)
@pytest.mark.parametrize("way", WAYS)
def test_a_line_has_one_gap_where_points_of_it_are_in_the_tool(cutter, way):
    """A point is in what is swept where it stands above what the move leaves there, seen along the tool."""
    moves = one(*np.array(WAYS[way], dtype=float), CUTTERS[cutter])
    x, y = np.random.default_rng(5).uniform(-14, 14, (2, 100))
    for direction in ((1, 2, 3), (-2, 0.5, 0.1), (0, 0, -1), (1, 0, 0), (0.3, -1, -0.6)):
        gaps, placement = gaps_of(moves, np.array(direction, dtype=float), (2.0, -1.0, 0.5))
        own = placement.back(np.stack(np.broadcast_arrays(x, y, UPRIGHTS[:, None]), axis=-1))
        inside = left_by(moves, own[..., 0].ravel(), own[..., 1].ravel())[0].reshape(own.shape[:2]) < own[..., 2]
        assert inside.any() and (in_gap(gaps, x, y) == inside).all(), direction


def test_of_plunges_at_one_place_the_deepest_says_what_is_left():
    """Three pecks and a hole beside them: what is left is that of the deepest peck, and every row is still told."""
    ends = [(1.0, 2.0, 3.0), (1.0, 2.0, -2.0), (1.0, 2.0, 1.0), (9.0, 2.0, 2.0)]
    pecks = [one((x, y, 20.0), (x, y, z), CUTTERS["point"]) for x, y, z in ends]
    moves = joined([replace(each, row=np.array([k])) for k, each in enumerate(pecks)])
    gaps, placement = gaps_of(moves, np.array((1.0, 0.5, 2.0)))
    deep = gaps_of(joined([pecks[1], pecks[3]]), np.array((1.0, 0.5, 2.0)))[0]
    x, y = np.random.default_rng(8).uniform(-6, 14, (2, 200))
    assert gaps.deepest.tolist() == [1, 3]
    blank = np.full(200, 5.0), np.full(200, -40.0)
    for found, expected in zip(gaps.sides(x, y, *blank), deep.sides(x, y, *blank)):
        assert (found == expected).all()
    at = placement.there(np.array([[1.0, 2.0, 4.0], [1.0, 2.0, -1.0], [9.0, 2.0, 3.0]]))
    assert gaps.rows_at(*at.T).tolist() == [2, 1, 3]


def test_a_search_ends_where_it_is_done(monkeypatch):
    """A line is looked at 20 times at most on the mean, where every one took 9 + 80 or 9 + 68 looks."""
    looks, above = [], searched._above
    monkeypatch.setattr(searched, "_above", lambda *of: (looks.append(len(of[-1])), above(*of))[1])
    gaps, _ = gaps_of(one((1.0, 2.0, 20.0), (1.0, 2.0, -6.0), CUTTERS["point"]), np.array((1.0, 2.0, 3.0)))
    x, y = np.random.default_rng(5).uniform(-14, 14, (2, 1000))
    list(gaps.spans(x, y))
    assert sum(looks) < 20 * looks[1]


def test_an_arc_is_right_within_its_chords():
    moves = one((6.0, 0.0, 1.0), (-6.0, 0.0, 1.0), CUTTERS["flat"], (0.0, 0.0), math.pi)
    gaps, placement = gaps_of(moves, np.array((1.0, 1.0, 1.0)))
    x, y = np.random.default_rng(6).uniform(-14, 14, (2, 150))
    own = placement.back(np.stack(np.broadcast_arrays(x, y, UPRIGHTS[:, None]), axis=-1))
    off = np.abs(np.hypot(own[..., 0], own[..., 1]) - 6) - 4  # of the ring that the tool goes round, above its ends
    beside = (own[..., 1] > 0) & (np.abs(off) > 2 * CHORD) & (np.abs(own[..., 2] - 1) > 2 * CHORD)
    assert beside.sum() > 1000 and (in_gap(gaps, x, y) == ((off < 0) & (own[..., 2] > 1)))[beside].all()


def test_what_stands_in_a_column_between_gaps():
    """A bore of radius 4 along Y at Z-20 and one along X at Z-10: chords 2 √(16 - d²) of the lines beside their axes."""
    bore = one((0.0, 0.0, -100.0), (0.0, 0.0, -100.0), CUTTERS["flat"])
    ways = ((0.0, 1.0, 0.0), (0.0, 0.0, -20.0)), ((1.0, 0.0, 0.0), (0.0, 0.0, -10.0))
    gaps = Gaps(tuple(gaps_of(bore, np.array(way), at)[0].groups[0] for way, at in ways), BOX)
    x, y = np.array([0.0, 2.0, 5.0, 0.0]), np.array([0.0, 1.0, 0.0, 9.0])
    chords = 2 * np.sqrt(np.maximum(16 - x**2, 0)) + 2 * np.sqrt(np.maximum(16 - y**2, 0))
    top, floor = np.full(4, 0.0), np.full(4, -40.0)
    assert np.allclose(gaps.left(x, y, top, floor), 40 - chords, atol=1e-9)
    top, floor = gaps.sides(x, y, np.full(4, -8.0), np.full(4, -22.0))  # both in the bores
    half_x, half_y = (np.sqrt(np.maximum(16 - d**2, 0)) for d in (y, x))
    assert np.allclose(top, np.where(half_x > 2, -10 - half_x, -8), atol=1e-9)
    assert np.allclose(floor, np.where(half_y > 2, -20 + half_y, -22), atol=1e-9)

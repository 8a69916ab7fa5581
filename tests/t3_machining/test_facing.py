"""Lines over a surface against the checks of G320 and G321, and against the covered area."""

import numpy as np
import pytest
import shapely

from mnclab.machining.milling import faces


def ends(clearing):
    return [[tuple(np.round(p, 4).tolist()) for p in line.points] for line in clearing.passes]


def test_rows():
    assert faces.rows(22, 77, 10) == pytest.approx((22, 31.1667, 40.3333, 49.5, 58.6667, 67.8333, 77), abs=1e-4)
    assert faces.rows(5, 5, 3) == (5.0,)
    assert faces.rows(40, 10, 15) == (40, 25, 10)


def test_zigzag():
    """G321 L0: lines at Y 10, 25, 40 between X -13 and 113; on the next level all of it backwards."""
    there = faces.lines((10, 25, 40), -13, 113, 10)
    assert ends(there) == [[(-13, 10), (113, 10)], [(113, 25), (-13, 25)], [(-13, 40), (113, 40)]]
    assert there.pieces[0].linked == (True, True)
    assert ends(there.reversed()) == [[(113, 40), (-13, 40)], [(-13, 25), (113, 25)], [(113, 10), (-13, 10)]]


def test_turning_within_the_surface():
    """G321 L1: the first line from X -13, then 10 to 90."""
    found = ends(faces.lines((10, 25, 40), -13, 113, 10, within=(10, 90)))
    assert found == [[(-13, 10), (90, 10)], [(90, 25), (10, 25)], [(10, 40), (90, 40)]]


def test_one_way():
    """G321 L2: all lines from X -13; the tool lifts between them."""
    clearing = faces.lines((10, 25, 40), -13, 113, 10, one_way=True)
    assert ends(clearing) == [[(-13, y), (113, y)] for y in (10, 25, 40)]
    assert clearing.pieces[0].linked == (False, False)
    assert ends(clearing.reversed())[0] == [(113, 40), (-13, 40)]


def test_along_y_and_turned():
    assert ends(faces.lines((3, 8), 0, 50, 4, axis=1)) == [[(3, 0), (3, 50)], [(8, 50), (8, 0)]]
    assert ends(faces.lines((3,), 0, 50, 4, angle=np.pi / 2, centre=(1, 2))) == [[(-2, 2), (-2, 52)]]
    with pytest.raises(ValueError, match="at least one line"):
        faces.lines((), 0, 50, 4)


@pytest.mark.parametrize("climb", [True, False])
@pytest.mark.parametrize("size", [(100, 60), (60, 100), (80, 80), (100, 21)])
def test_spiral_covers_the_surface(size, climb):
    (way,) = faces.spiral(*size, 10, 14, climb=climb).passes
    line = shapely.LineString(way.points)
    surface = shapely.box(-size[0] / 2, -size[1] / 2, size[0] / 2, size[1] / 2)
    assert surface.difference(line.buffer(10, quad_segs=200)).area < 1e-3 * surface.area
    turning = shapely.LinearRing(way.points[1:5]).is_ccw
    assert turning == (not climb)
    assert shapely.LineString(way.points[:-1]).is_simple  # the last round closes itself

"""Numbers, lists and truth values of numpy, fractions and generators stand for those of Python wherever these may stand."""

from fractions import Fraction

import numpy as np
import pytest

import mnclab
from mnclab import Alarm

FIVES = [np.float32(5), np.int8(5), np.uint8(5), np.array(5.0), np.array(5), Fraction(5)]


@pytest.mark.parametrize("five", FIVES, ids=lambda five: f"{type(five).__name__} {getattr(five, 'dtype', '')}")
def test_a_number_of_any_make(five):
    assert mnclab.Tool(diameter=five, teeth=five) == mnclab.Tool(diameter=5, teeth=5)
    assert hash(mnclab.Tool(radius=five)) == hash(mnclab.Tool(radius=5))
    assert mnclab.Datum(five, z=five) == (5, 0, 5, 0, 0, 0, 0, 0, 0)
    assert mnclab.Limits(rapid=five, acceleration=(five, 5, 5)) == mnclab.Limits(rapid=5, acceleration=(5, 5, 5))
    assert mnclab.design.Hole(five, five, five) == mnclab.design.Hole(5, 5, 5)
    assert mnclab.area.rectangle(five, five).area == pytest.approx(25)
    run = mnclab.run("G0 X1\n\n\n\nG1 X2 F100\n", "g43")
    assert run.at(line=five) == run.at(line=5)
    with pytest.raises(Alarm, match="high > low"):
        mnclab.blank.cylinder(five, five)


def test_lists_and_truth_values():
    bodies = {"shank": np.array([4, 20]), "holder": np.array([[20, 50]])}
    tool = mnclab.Tool(diameter=10, centre_cutting=np.True_, locked=np.False_, **bodies)
    assert tool == mnclab.Tool(diameter=10, shank=(4, 20), holder=((20, 50),), centre_cutting=True)
    travel = np.array([[0, 400], [0, 300], [-200, 0]])
    assert mnclab.Limits(rapid=np.array([3, 2, 1]), travel=travel) == mnclab.Limits(rapid=(3, 2, 1), travel=travel.tolist())
    assert dict(mnclab.Setup(datums={1: np.array([1, 2, 3])}).datums) == {1: (1, 2, 3)}


def test_rows_of_a_path():
    path = mnclab.run("G0 X1\nX2\nX3\n", "g43").toolpath
    assert path[np.array(1)].end[0] == 2
    assert path[(0, 2)].end[:, 0].tolist() == path[[0, 2]].end[:, 0].tolist() == [1, 3]
    assert len(path[()]) == 0


def test_features_and_loops_one_by_one():
    holes = [mnclab.design.Hole(x, 20, 8) for x in (20, 40)]
    assert mnclab.Design((60, 40, 10), iter(holes)).features == mnclab.Design((60, 40, 10), holes).features
    square = mnclab.area.rectangle(10, 10)
    for loops in (square, [square], iter([square])):
        assert mnclab.area.Region(loops).area == pytest.approx(100)
    with pytest.raises(Alarm, match="the loops of a region must be contours"):
        mnclab.area.Region(5)

"""The same contour in the three planes: X Y Z I J become Z X Y K I in G18, and Y Z X J K in G19 (2.4, 3.4)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Setup, Tool

LETTERS = {"G17": "XYZIJ", "G18": "ZXYKI", "G19": "YZXJK"}
AXES = {"G17": (0, 1, 2), "G18": (2, 0, 1), "G19": (1, 2, 0)}  # where X, Y and Z of G17 have gone
SETUP = Setup(tools={1: Tool(radius=5)})

coordinate = st.integers(-40, 40)
point = st.tuples(coordinate, coordinate)
line = point.map(lambda p: f"G1 {{0}}{p[0]} {{1}}{p[1]}")
along = coordinate.map(lambda w: f"G1 {{2}}{w}")
radius = st.tuples(st.sampled_from("23"), point, st.sampled_from([60, 80.5, -57, -100])).map(
    lambda a: f"G{a[0]} {{0}}{a[1][0]} {{1}}{a[1][1]} R{a[2]}"
)
circle = st.tuples(st.sampled_from("23"), coordinate, coordinate).map(lambda a: f"G{a[0]} {{3}}{a[1]} {{4}}{a[2]}")
contour = st.lists(st.one_of(line, line, radius, radius, circle, along), min_size=1, max_size=6)
entry = st.sampled_from(["", "G41 G1 {0}0 {1}0", "G42 G1 {0}0 {1}0"])
dimensions = st.sampled_from(["G90", "G91"])


@pytest.mark.deep
@given(entry, dimensions, contour)
def test_a_contour_turned_with_its_plane(entry, dimensions, contour):
    blocks = ["T1 F100", "G90 G0 {0}-30 {1}-25 {2}5", entry, dimensions, *contour, "G40 G1 {0}70 {1}-35"]
    runs = {
        plane: mnclab.run("\n".join([plane, *blocks]).format(*letters) + "\n", "mnc", SETUP)
        for plane, letters in LETTERS.items()
    }
    flat = runs["G17"]
    for plane, axes in AXES.items():
        turned, axes = runs[plane], list(axes)
        assert [a.span.line for a in turned.alarms] == [a.span.line for a in flat.alarms]
        assert np.array_equal(turned.toolpath.kind, flat.toolpath.kind)
        assert np.allclose(turned.toolpath.end[:, axes], flat.toolpath.end, rtol=0, atol=1e-9)
        assert np.allclose(turned.toolpath.centre[:, axes], flat.toolpath.centre, rtol=0, atol=1e-9, equal_nan=True)
        assert np.allclose(turned.toolpath.axis[:, axes][1:], flat.toolpath.axis[1:], rtol=0, atol=0)
        assert np.allclose(turned.toolpath.sweep, flat.toolpath.sweep, rtol=0, atol=1e-9)

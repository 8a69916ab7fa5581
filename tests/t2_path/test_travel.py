"""How far a path reaches: arcs against points laid densely along them, and the spindle above tools of several lengths."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mnclab.path.limits import extents, first_beyond
from mnclab.path.toolpath import Kind, Toolpath

ANGLE = st.floats(-15, 15).filter(lambda a: abs(a) > 1e-3)
PART = st.floats(-3, 3)


@given(normal=st.tuples(PART, PART, PART).filter(lambda n: np.linalg.norm(n) > 0.1), centre=st.tuples(PART, PART, PART),
       radius=st.floats(0.1, 5), first=ANGLE, sweep=ANGLE, pitch=st.floats(-9, 9))  # fmt: skip
def test_the_extent_of_an_arc_is_that_of_its_points(normal, centre, radius, first, sweep, pitch):
    """Any plane, any number of turns, any pitch: x(a) = c + r cos(a) u + r sin(a) v + n pitch a / sweep."""
    axis = np.array(normal) / np.linalg.norm(normal)
    u = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    u /= np.linalg.norm(u)
    v = np.cross(axis, u)
    share = np.linspace(0, 1, 20_001)[:, None]
    angle = first + share * sweep
    points = np.array(centre) + radius * (np.cos(angle) * u + np.sin(angle) * v) + axis * pitch * share
    column = {"kind": np.array([Kind.ARC], np.uint8), "axis": axis[None], "sweep": np.array([sweep])}
    path = Toolpath.chain(points[[0, -1]], column | {"centre": np.array(centre)[None]})
    low, high = extents(path)
    # 20,000 chords of at most 15 / 20,000 rad miss r (15 / 20,000)² / 8 = 3.5e-7 mm; the start itself is not counted
    assert np.allclose(np.minimum(low, points[0]), points.min(axis=0), rtol=0, atol=1e-6)
    assert np.allclose(np.maximum(high, points[0]), points.max(axis=0), rtol=0, atol=1e-6)


def test_the_reference_stays_where_a_tool_moves_the_tip():
    """Tip at Z0 under a reference at Z100; a tool of 30 puts it at -30; down by 60 the reference is at 40, by 80 at 20."""
    tips = np.array([(0, 0, 0), (0, 0, -30), (0, 0, -90), (0, 0, -110.0)])
    path = Toolpath.chain(tips, {"kind": np.array([Kind.TOOL, Kind.RAPID, Kind.LINE], np.uint8)})
    start, wide = np.array([5.0, 0, 100]), [(-9, 9), (-9, 9)]
    assert first_beyond(path, start, np.array([*wide, (20, 100)])) is None
    assert first_beyond(path, start, np.array([*wide, (30, 100)])) == (2, 2, 20)
    assert first_beyond(path, start, np.array([(-9, 1), wide[0], (0, 100)])) == (1, 0, 5)


def test_a_machine_that_stands_outside_may_return():
    path = Toolpath.chain(np.array([(0, 0, 0), (5, 0, 0), (7, 0, 0.0)]), {"kind": np.array([Kind.LINE] * 2, np.uint8)})
    travel = np.array([(0, 9), (0, 9), (0, 9.0)])
    assert first_beyond(path, np.array([-5.0, 0, 0]), travel) is None
    assert first_beyond(path, np.array([-6.0, 0, 0]), travel) == (0, 0, -1)
    assert first_beyond(path[:0], np.array([-6.0, 0, 0]), travel) is None

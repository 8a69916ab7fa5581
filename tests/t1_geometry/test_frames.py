"""Frames: products of plain matrices, fixed points, and back again."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mnclab.geometry import frames

coordinate = st.floats(-1000, 1000, allow_nan=False)
point = st.tuples(coordinate, coordinate, coordinate)
angle = st.floats(-7, 7)


@given(angle, point, point)
def test_a_turn_about_a_point_keeps_it_and_all_distances(a, about, p):
    matrix = frames.turn(a, "z", about)
    assert np.allclose(frames.apply(matrix, about), about, atol=1e-9)
    moved = frames.apply(matrix, p)
    assert np.isclose(np.linalg.norm(moved - about), np.linalg.norm(np.subtract(p, about)), atol=1e-9)


@given(angle, point)
def test_a_turn_is_the_rotation_matrix(a, p):
    x, y, z = p
    expected = (x * np.cos(a) - y * np.sin(a), x * np.sin(a) + y * np.cos(a), z)
    assert np.allclose(frames.apply(frames.turn(a), p), expected, atol=1e-9)


@given(angle, point, point, st.sampled_from(["x", "y", "xy", "z"]))
def test_inverse_undoes_a_chain(a, offset, p, axes):
    matrix = frames.shift(*offset) @ frames.turn(a, "y") @ frames.mirror(axes)
    assert np.allclose(frames.apply(frames.inverse(matrix), frames.apply(matrix, p)), p, atol=1e-8)


def test_the_order_of_a_chain_matters():
    """Shift X60 Y40 and turn 35 degrees: TNC 620, transformation chain, worked example."""
    first, second = frames.shift(60, 40), frames.turn(np.radians(35))
    chain = frames.FrameChain()
    chain.set("shift", first)
    chain.set("rotation", second)
    assert np.allclose(frames.apply(chain.matrix, [10, 0, 0])[:2], [68.192, 45.736], atol=5e-4)
    chain.set("shift", None)
    chain.set("shift", first)
    assert np.allclose(frames.apply(chain.matrix, [0, 0, 0])[:2], [26.206, 67.181], atol=5e-4)
    chain.set("rotation", frames.turn(0.0))
    assert np.allclose(frames.apply(chain.matrix, [1, 2, 3]), [61, 42, 3])


def test_named_slots_keep_their_place():
    chain = frames.FrameChain(("outer", "inner"))
    chain.set("inner", frames.turn(np.pi / 2))
    chain.set("outer", frames.shift(5))
    assert np.allclose(frames.apply(chain.matrix, [1, 0, 0]), [5, 1, 0])
    assert "outer" in chain and "inner" in chain
    chain.set("outer", None)
    assert "outer" not in chain and np.allclose(frames.apply(chain.matrix, [1, 0, 0]), [0, 1, 0])

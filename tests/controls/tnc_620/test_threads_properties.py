"""Thread milling, cycles 262 to 265 and 267: pitch, distance from the axis, ends and rapids, whatever is programmed."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab as mnc

pytestmark = pytest.mark.deep

ALL = (262, 263, 264, 265, 267)

CASES = st.fixed_dictionaries(
    {
        "Q335": st.integers(7, 60),
        "Q239": st.sampled_from([0.5, 1.5, 4, -1, -2.5]),
        "Q201": st.integers(-30, -1),
        "Q351": st.sampled_from([1, -1, 0]),
        "Q355": st.integers(0, 4),
        "Q356": st.sampled_from([0, -31, -35]),
        "Q358": st.sampled_from([0, -1]),
        "Q359": st.integers(1, 4),
        "Q257": st.sampled_from([0, 3]),
        "Q360": st.sampled_from([0, 1]),
        "Q204": st.sampled_from([0, 20]),
        "Q203": st.sampled_from([0, -7]),
    }
)


@pytest.mark.parametrize("number", ALL)
@given(values=CASES)
def test_properties(called, rows, printed, number, values) -> None:
    """The pitch is exact, the edge cuts the nominal diameter and nothing beyond it, every rapid runs where nothing is."""
    path = rows(called(number, **{address: value for address, value in values.items() if address in printed[number]}))
    pitch, nominal, radius, surface = values["Q239"], values["Q335"], 3, values["Q203"]
    outside = number == 267
    at = nominal / 2 + (radius if outside else -radius)
    turning = path[["helix" in path.labels[k] for k in path.label]]
    rise = turning.end[:, 2] - turning.start[:, 2]
    assert rise / (turning.sweep / math.tau) == pytest.approx(np.full(len(turning), pitch))  # right-hand: positive
    assert np.hypot(*turning.end[:, :2].T) == pytest.approx(np.full(len(turning), at))
    assert turning.centre[:, :2] == pytest.approx(np.zeros((len(turning), 2)), abs=1e-9)
    bottom = surface + values["Q201"]
    ends = np.concatenate([turning.start[:, 2], turning.end[:, 2]])
    assert ends.min() == bottom
    if number == 265 or values["Q355"] and number in (262, 267):
        every = max(values["Q355"], 1) * abs(pitch) if number != 265 else abs(pitch)
        assert surface - ends.max() < every - abs(pitch) + 1e-9  # no thread is left out below the surface

    approach = path[["approach" in path.labels[k] and "rise" not in path.labels[k] for k in path.label]]
    slope = (approach.end[:, 2] - approach.start[:, 2]) / approach.lengths
    assert np.abs(slope) == pytest.approx(  # it joins the helix tangentially in space
        np.full(len(approach), abs(pitch) / math.hypot(pitch, math.tau * at)), rel=1e-6
    )

    arcs = path[path.kind == mnc.Kind.ARC]
    cut = np.hypot(*arcs.centre[:, :2].T), np.hypot(*(arcs.start - arcs.centre)[:, :2].T)
    front = np.array(["countersink" in arcs.labels[k] for k in arcs.label])
    if outside:
        assert (np.abs(cut[0] - cut[1])[~front] >= at - 1e-9).all()
    else:
        assert ((cut[0] + cut[1])[~front] <= at + 1e-9).all()

    top = surface + 2
    rapid = path[path.kind == mnc.Kind.RAPID]
    reached = np.minimum.accumulate(np.where(path.kind == mnc.Kind.RAPID, math.inf, path.end[:, 2]))
    for k in np.flatnonzero(path.kind == mnc.Kind.RAPID):
        move = path[k]
        sideways = math.dist(move.start[:2], move.end[:2]) > 1e-9
        assert not sideways or (outside and move.start[2] == move.end[2] == top)
        assert move.end[2] >= min(top, reached[k])  # down at rapid: to the set-up clearance, or where it was before
    end = (at + 2 * abs(pitch), 0) if outside else (0, 0)
    assert path.end[-1, :2] == pytest.approx(end, abs=1e-9)
    assert rapid.end[0, 2] == top and path.end[-1, 2] == surface + (20 if values["Q204"] else 2)

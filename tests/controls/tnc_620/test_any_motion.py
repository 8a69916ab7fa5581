"""Path functions in any order: nothing but alarms is raised, arcs stay on their circles, and the path is finite."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mnclab as mnc
from mnclab import Kind

pytestmark = pytest.mark.deep

BLOCKS = st.sampled_from([
    "L X+30", "L Y+30", "L X+0 Y+0", "L IX-12 IY+7", "L Z-3", "L Z+2 FMAX", "L X+50 RL", "L Y-20 RR", "L X-40 Y-40 R0",
    "L X+0 Y-30 R0 FMAX", "CC X+10 Y+10", "CC", "CC IX+20", "C X+0 Y+0 DR+", "C IX+0 DR-", "CR IX+8 IY+8 R+9 DR-",
    "CR IX-8 R-6 DR+", "CT IX+15 IY+9", "CT X-20 Y+20", "LP PR+20 PA+45", "LP IPA-70", "LP IPR+5", "CP PA+10 DR+",
    "CP IPA-400 IZ-2 DR-", "CTP PR+25 PA-60", "RND R2", "RND R6 F40", "CHF 2", "CHF 5",
    "APPR LT X+0 Y+0 LEN8 RL", "APPR LN X+40 Y+0 LEN8 RR", "APPR CT X+0 Y+40 CCA120 R+7 RL", "APPR LCT X+40 Y+40 R4 RR",
    "APPR LCT X+0 Y+40 Z-2 R4 R0", "APPR PLCT PR+30 PA+20 R3", "APPR LT X+1 Y+1 LEN2", "DEP LT LEN6", "DEP LN LEN6",
    "DEP CT CCA200 R-4", "DEP LCT X-50 Y+0 R5", "DEP PLCT PR+60 PA+0 Z+9 R5",
    "CYCL DEF 10.0 R\nCYCL DEF 10.1 IROT+25", "CYCL DEF 7.0 S\nCYCL DEF 7.1 IX+3", "TOOL CALL 2 Z",
])  # fmt: skip


@settings(max_examples=400, deadline=None)
@given(st.lists(BLOCKS, min_size=2, max_size=14), st.sampled_from(["refuse", "mark"]))
def test_any_order(blocks: list[str], gouge: str) -> None:
    text = "TOOL CALL 1 Z S1000 F100\nL X-30 Y-30 Z+5\n" + "\n".join(blocks) + "\n"
    setup = mnc.Setup(tools={1: mnc.Tool(radius=2), 2: mnc.Tool(radius=3, length=50)}, settings={"gouge": gouge})
    path = mnc.run(text, "tnc-620", setup).toolpath
    assert np.isfinite(path.end).all() and np.array_equal(path.start[1:], path.end[:-1])
    for arc in path[path.kind == Kind.ARC]:
        if not arc.gouge:
            spokes = [np.hypot(*(p - arc.centre)[:2]) for p in (arc.start, arc.end)]
            assert abs(spokes[0] - spokes[1]) < 0.02 and np.isfinite(arc.feed)

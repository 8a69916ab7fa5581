"""Parts of more moves than are swept exactly: the error says so, and nothing is reported that is not there."""

import math

import numpy as np
import pytest
from tools.milled import part

from mnclab import Tool
from mnclab.design.model import Design, Pocket

BLOCK = ((0, 0, -20), (60, 40, 0))
MANY = 22_000

pytestmark = pytest.mark.deep


def spiral(radius, tool):
    """A round pocket of `radius` about (30, 20) in very many short chords: out in rings, the last one at its wall."""
    text = ["G0 X30 Y20 Z2", "G1 Z-4"]
    rings = np.linspace(0, radius - 5, 8)[1:]
    for q in rings:
        angle = np.linspace(0, 2 * math.pi, MANY // len(rings) + 1)
        text += [f"G1 X{30 + q * math.cos(a):.6f} Y{20 + q * math.sin(a):.6f}" for a in angle]
    return part("\n".join(text), Tool(radius=tool, number=1, kind="mill"), step=0.25)


def test_no_false_alarm():
    workpiece = spiral(12, 5)
    assert workpiece.many
    found = workpiece.compare(Design(BLOCK, (Pocket.circle(30, 20, 24, 4),)))
    assert found.ok and found.error == workpiece.error
    assert found.worst_gouge.value <= 1e-5  # places of six decimals
    assert found.worst_rest.value <= 7 * (1 - math.cos(math.pi / (MANY // 7))) + 1e-5  # the height of a chord


def test_a_fault_is_found_exactly():
    workpiece = spiral(12, 5.1)
    found = workpiece.compare(Design(BLOCK, (Pocket.circle(30, 20, 24, 4),)))
    assert not found.ok
    assert found.worst_gouge.value == pytest.approx(0.1, abs=1e-5)
    assert found.worst_gouge.feature == "pocket" and found.worst_gouge.line > MANY * 6 / 7

"""How long a comparison takes over 1024 x 1024 cells: a part as drawn, and one milled with a tool that is too large.

    python3 tests -m benchmark -s tests/benchmarks/test_difference.py

Prints processor seconds without those of the heights and of the design; the aim is 0.5 s.
"""

import time

import pytest
from tools.milled import part

from mnclab import Tool
from mnclab.design.model import Design, Pocket

pytestmark = pytest.mark.benchmark
BLOCK, STEP = ((0, 0, -20), (102.4, 102.4, 0)), 0.1
PLACES = [(15 + 24 * i, 15 + 24 * j) for i in range(4) for j in range(4)]


@pytest.mark.parametrize("radius", [3.0, 3.05])
def test_sixteen_pockets(radius):
    text = ""
    for x, y in PLACES:
        text += f"G0 X{x} Y{y} Z2\nG1 Z-4\n"
        text += "".join(f"G1 X{x + q}\nG3 X{x + q} Y{y} I{-q} J0\n" for q in (2, 3, 4, 5, 6, 7))
        text += "G0 Z2\n"
    workpiece = part(text, Tool(radius=radius, number=1, kind="mill"), stock=BLOCK, step=STEP)
    design = Design(BLOCK, tuple(Pocket.circle(x, y, 20, 4) for x, y in PLACES))
    assert workpiece.heights.shape == (1024, 1024)
    design.stack  # noqa: B018  made once for a design
    begin = time.process_time()
    found = workpiece.compare(design)
    spent = time.process_time() - begin
    print(f"\n{len(workpiece.moves)} moves, mill of {radius:g}: {spent:.2f} s, worst gouge {found.worst_gouge.value:.4f} mm")
    assert found.worst_gouge.value == pytest.approx(radius - 3, abs=1e-6)

"""Programs written in the manner of shops, schools and CAM posts: they run and go where their arithmetic says.

The first line of a file says whose manner it is. Then stands what the arithmetic needs to be followed, and `at 12: x, y, z`:
where the tool stands when line 12 is done, one point for each time that it is done, with `|` between. `through 12: x, y, z`
is a point where a move of line 12 ends, wherever it goes on from there. Points are mm in coordinates of the workpiece,
closed forms with angles in degrees.

The kinds are those of programs found in public repositories. Of 82 Klartext files looked through in November 2026 (many of one
shop; long ones cut) 75 are read without an alarm; the other seven are no Klartext of a TNC: G blocks or brackets
among it, coordinates `nan`, a misspelt FMAX, blocks that the control itself had marked as errors.
"""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

import mnclab as mnc

FILES = sorted((Path(__file__).parents[2] / "programs_of_shops" / "tnc-620").iterdir())
MARK = re.compile(r"^; (at|through) (\d+): (.+)$", re.M)
NAMES = {
    "pi": math.pi,
    "sqrt": math.sqrt,
    "sin": lambda angle: math.sin(math.radians(angle)),
    "cos": lambda angle: math.cos(math.radians(angle)),
}


def points(text: str) -> np.ndarray:
    """Points (n, 3), mm, of a text `x, y, z | x, y, z`."""
    return np.array([[eval(form, {"__builtins__": {}}, NAMES) for form in point.split(",")] for point in text.split("|")], float)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_the_tool_goes_where_the_arithmetic_says(path: Path) -> None:
    marks = MARK.findall(path.read_text(encoding="utf-8"))
    assert sum(len(points(text)) for _, _, text in marks) >= 5
    run = mnc.run(path, control="tnc-620")
    assert run.ok, [str(alarm) for alarm in run.alarms]
    moves = run.toolpath.motion
    for kind, line, text in marks:
        mine = moves[(moves.line == int(line)) & (moves.program == 0)]
        expected = points(text)
        if kind == "at":
            last = np.flatnonzero(np.diff(mine.step, append=-1))
            assert mine.end[last] == pytest.approx(expected, abs=1e-6), f"line {line}"
        else:
            apart = np.linalg.norm(mine.end[:, None] - expected, axis=2).min(axis=0, initial=np.inf)
            assert apart == pytest.approx(0, abs=1e-6), f"line {line}"


def test_there_are_sixty_in_klartext_and_twenty_in_din_iso() -> None:
    suffixes = [path.suffix for path in FILES]
    assert suffixes.count(".h") >= 60 and suffixes.count(".i") >= 20

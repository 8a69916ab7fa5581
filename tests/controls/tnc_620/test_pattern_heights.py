"""The second set-up clearance of a cycle under CYCL CALL PAT, 220 and 221: one level, for the cycle and for the way.

Levels are those of the catalogue (CYCL CALL PAT, its worked table): S = Q203 + Z, T = Z where Z > Q203, else S, and
H = max(where the tool stood, T + Q204, S + Q200). After a hole the tool only rises, to H and no further.
"""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from tools.together import together

import mnclab as mnc
from mnclab.controls.tnc_620.language.flow import PLACED_BY_DATUM
from mnclab.machine import trial

CYCLES = {
    cycle.code: cycle
    for cycle in mnc.controls["tnc-620"].cycles.values()
    if cycle.runs == "call" and {"Q200", "Q204"} <= {p.address for p in cycle.parameters()}
    and cycle.code not in PLACED_BY_DATUM
}  # fmt: skip
HOLES = [code for code in CYCLES if code[-3:-1] in ("20", "24") or code[-3:] in ("262", "263", "264", "265", "267")]
CALL = "L X+20 Y+10 R0 FMAX M99"

#: Z of the pattern, Q203, Q204, where the tool stands, H of Q200 = 2; the first five are the table of the catalogue
LEVELS = [
    (0, -10, 20, 5, 20), (30, 0, 20, 5, 50), (20, 10, 20, 5, 40), (5, 10, 20, 5, 35), (30, 28, 20, 5, 60),
    (5, 1, 20, 5, 25), (0, 0, 0, 5, 5), (0, 0, 20, 100, 100), (0, 4, 0, 5, 6), (-7, 3, 30, 0, 26),
]  # fmt: skip


def program(code: str, calls: str, **changed: float) -> str:
    """The trial program of a cycle with some Q parameters changed; its surface is Q203, or Q227 and the end with it."""
    cycle = CYCLES[code]
    values = {p.name: trial.first_value(p) for p in cycle.parameters()}
    names = {p.address: p.name for p in cycle.parameters()}
    surface = changed.pop("Q203", 0)
    for address in ("Q203",) if "Q203" in names else ("Q227", "Q386"):
        values[names[address]] += surface
    values |= {names[address]: value for address, value in changed.items()}
    text = trial.program(mnc.controls["tnc-620"], cycle, values)
    assert text is not None and CALL in text
    return text.replace(CALL, calls)


def after_each_hole(run: mnc.Run, way: str) -> list[np.ndarray]:
    """The heights (m,) after each visit, from where it last cut to where the way to the next point ends."""
    assert run.ok, run.alarms
    path = run.toolpath[run.toolpath.is_motion]
    named = np.array([path.labels[k] == way for k in path.label])
    across = np.flatnonzero(named & (path.start[:, :2] != path.end[:, :2]).any(axis=1))
    found = []
    for k, first in enumerate(across):
        last = across[k + 1] + 1 if k + 1 < len(across) else len(path)
        cut = first + np.flatnonzero(path.kind[first + 1 : last] != mnc.Kind.RAPID)[-1] + 1
        found.append(path.end[cut:last, 2])
    return found


@pytest.mark.deep
@together("code levels", product(HOLES, LEVELS), lambda code, levels: code)
def test_after_a_hole_the_tool_rises_to_the_clearance_height(code: str, levels: tuple[float, ...]) -> None:
    z, surface, second, at, high = levels
    points = f"PATTERN DEF POS1 (X+20 Y+10 Z{z:+g}) POS2 (X+60 Y+10 Z{z:+g}) POS3 (X+99 Y+50 Z{z:+g})"
    run = mnc.run(
        program(code, f"{points}\nL Z{at:+g} R0 FMAX\nCYCL CALL PAT FMAX", Q203=surface, Q204=second, Q200=2), "tnc-620"
    )
    visits = after_each_hole(run, "CYCL CALL PAT to the point")
    assert len(visits) == 3
    for heights in visits:
        assert (np.diff(heights) >= 0).all() and heights[-1] == pytest.approx(high)


@pytest.mark.parametrize("code", CYCLES)
def test_points_at_several_heights(code: str) -> None:
    """Surfaces 32, 12, 32 with Q204 = 20: from every point up, across at the higher of two heights, never down first."""
    points = "PATTERN DEF POS1 (X+20 Y+10 Z+30) POS2 (X+200 Y+10 Z+10) POS3 (X+400 Y+50 Z+30)"
    run = mnc.run(program(code, f"{points}\nL Z+40 R0 FMAX\nCYCL CALL PAT FMAX", Q203=2, Q204=20, Q200=2), "tnc-620")
    visits = after_each_hole(run, "CYCL CALL PAT to the point")
    assert [heights[-1] for heights in visits] == pytest.approx([50, 50, 50])  # 50, up from 40 before the way, 50
    assert all((np.diff(heights) >= 0).all() for heights in visits)


@pytest.mark.parametrize("choice", [0, 1])
@pytest.mark.parametrize("code", HOLES)
def test_the_chosen_height(code: str, choice: int) -> None:
    """GLOBAL DEF 125: back to where the tool stood, 8, without a way over 20; or to the second set-up clearance, 20."""
    calls = f"GLOBAL DEF 125 P\nQ345={choice}\nPATTERN DEF POS1 (X+20 Y+10 Z+0) POS2 (X+60 Y+10 Z+0)\nL Z+8 R0 FMAX\n"
    run = mnc.run(program(code, f"{calls}CYCL CALL PAT FMAX", Q204=20, Q200=2), "tnc-620")
    for heights in after_each_hole(run, "CYCL CALL PAT to the point"):
        assert (np.diff(heights) >= 0).all() and heights[-1] == (20 if choice else 8)


@pytest.mark.parametrize("pattern", ["220", "221"])
@pytest.mark.parametrize("move", [0, 1])
@pytest.mark.parametrize("code", [code for code in HOLES if code not in ("CYCL DEF 240", "CYCL DEF 241")])
def test_between_the_points_of_220_and_221(code: str, move: int, pattern: str) -> None:
    """Q301 = 0: the cycle retracts to the set-up clearance, 7, where the tool travels; after the last point to Q204, 25."""
    places = "Q216=50 Q217=40 Q244=60 Q245=0 Q246=360 Q247=0 Q241=9 Q365=0"
    if pattern == "221":
        places = "Q225=1 Q226=2 Q237=30 Q238=20 Q242=3 Q243=3 Q224=0"
    words = f"{places} Q200=2 Q203=5 Q204=20 Q301={move}".replace(" ", "\n")
    run = mnc.run(program(code, f"CYCL DEF {pattern} P\n{words}"), "tnc-620")
    visits = after_each_hole(run, f"CYCL DEF {pattern} to the next point")
    assert len(visits) == 8 and all((np.diff(heights) >= 0).all() for heights in visits)
    assert [heights[-1] for heights in visits] == [25 if move else 7] * 7 + [25]

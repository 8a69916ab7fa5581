"""DIN/ISO programs whose positions are worked out here, in the manner of HEIDENHAIN's manuals "DIN/ISO programming"."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import mnclab as mnc

ROOT_HALF = math.sqrt(0.5)


@pytest.fixture
def din(tnc):
    """Run blocks behind `%A G71` and the call of tool 1 (radius 5); they begin in line 3."""

    def run(blocks: str, **setup: object) -> mnc.Run:
        text = f"%A G71 *\nN10 T1 G17 S1000 F100 *\n{blocks}\nN99999999 %A G71 *\n"
        return tnc(text, mnc.Setup(**setup) if setup else None)

    return run


def ends(run: mnc.Run) -> list[list[float]]:
    assert run.ok, run.alarms
    return run.toolpath.motion.end.tolist()


def test_g90_and_g91_count_from_their_place_in_the_block(din) -> None:
    """`G91 X+5 G90 Y-5` (TNC 407, circular path): the first coordinate by an increment, the second one absolute."""
    run = din("G00 X+10 Y+20 M3*\nG01 G91 X+5 G90 Y-5*\nX+1*\nG91 X+1 Z-2*\nZ-2*")
    assert ends(run) == [[10, 20, 0], [15, -5, 0], [1, -5, 0], [2, -5, -2], [2, -5, -4]]


def test_an_arc_around_a_pole_and_the_last_sense_of_rotation(din) -> None:
    """A quarter of a circle of radius 20 around (25, 25) three times, and once more the other way round."""
    run = din("I+25 J+25*\nG11 R+20 H+0 M3*\nG13 H+90*\nG15 H+180*\nG05 X+25 Y+5*\nG12 H+180*")
    assert np.allclose(ends(run), [[45, 25, 0], [25, 45, 0], [5, 25, 0], [25, 5, 0], [5, 25, 0]], atol=1e-12)
    assert np.allclose(run.toolpath.motion.sweep[1:], np.array([1, 1, 1, -1]) * math.pi / 2, atol=1e-12)


def test_g29_takes_the_last_position_as_the_pole(din) -> None:
    run = din("G00 X+30 Y+10 M3*\nG29*\nG10 R+2 H+45*\nG91 H+90*")
    assert np.allclose(ends(run)[1:], [[30 + 2 * ROOT_HALF, 10 + 2 * ROOT_HALF, 0], [30 - 2 * ROOT_HALF, 10 + 2 * ROOT_HALF, 0]])
    assert not np.isfinite(run.toolpath.motion.feed).any()


def test_a_helix_of_three_turns(din) -> None:
    run = din("I+0 J+0*\nG00 X+15 Y+0 Z+3 M3*\nG12 G91 H-1080 Z-4.5*")
    (turn,) = [move for move in run.toolpath if move.kind == mnc.Kind.ARC]
    assert np.allclose(turn.end, (15, 0, -1.5), atol=1e-12) and math.isclose(turn.sweep, -6 * math.pi)


def test_a_tangential_approach_touches_the_contour_at_its_first_point(din) -> None:
    """From S (-40, 30) to A (0, 30) on Y, the tool of radius 5 on the left, at x = -5, an arc of radius 10.

    The arc ends in Q (-5, 30) and runs with +Y there, so its centre is M (-15, 30): S is 25 mm away from it, and the line
    that touches the circle leaves it at H with MH square to SH: cos = 10 / 25 at M. Behind the contour the same backwards.
    """
    lead = "G00 G40 X-40 Y+30 M3*\nG01 G41 X+0 Y+30 F350*\nG26 R10*\nY+60*\nX+60*\nY+0*\nX+0*\nY+30*\nG27 R10*\n"
    run = din(f"{lead}G00 G40 X-40 Y+30*")
    points = ends(run)
    cosine, sine = 10 / 25, math.sqrt(1 - (10 / 25) ** 2)
    assert np.allclose(points[1], [-15 - 10 * cosine, 30 - 10 * sine, 0])
    assert np.allclose(points[2], [-5, 30, 0])
    assert np.allclose(points[-3:], [[-5, 30, 0], [-15 - 10 * cosine, 30 + 10 * sine, 0], [-40, 30, 0]])
    path = run.toolpath.motion
    assert path.feed[-3:].tolist() == [350, 350, math.inf] and path.kind[-1] == mnc.Kind.RAPID
    slow = din(f"{lead}G01 G40 X-40 Y+30*").toolpath.motion
    assert np.array_equal(slow.end, path.end) and slow.feed[-1] == 350


def test_a_chamfer_and_a_rounding(din) -> None:
    """A corner at (20, 0) cut 4 mm off on both sides, one at (20, 30) rounded with radius 5."""
    run = din("G00 X+0 Y+0 M3*\nG01 X+20*\nG24 R4*\nY+30*\nG25 R5 F40*\nX+0*")
    assert np.allclose(ends(run), [[16, 0, 0], [20, 4, 0], [20, 25, 0], [15, 30, 0], [0, 30, 0]])
    assert run.toolpath.motion.feed.tolist() == [100, 100, 100, 40, 100]


def test_groups_of_holes_by_a_subprogram(din) -> None:
    """The manuals' group of four holes: three of them by increments, the last one ends in absolute dimensions."""
    run = din(
        "G200 Q200=2 Q201=-10 Q206=250 Q202=10 Q210=0 Q203=+0 Q204=10 Q211=0*\nG00 G40 G90 Z+50 M3*\n"
        "X+15 Y+10*\nL1,0*\nX+45 Y+60*\nL1,0*\nG00 Z+250 M2*\n"
        "G98 L1*\nG79*\nG91 X+20 M99*\nY+20 M99*\nX-20 G90 M99*\nG98 L0*"
    )
    drilled = [tuple(move.end[:2]) for move in run.toolpath if move.kind == mnc.Kind.LINE and move.end[2] == -10]
    corners = [(0, 0), (20, 0), (20, 20), (0, 20)]
    assert run.ok and drilled == [(x + a, y + b) for x, y in ((15, 10), (45, 60)) for a, b in corners]
    assert ends(run)[-1] == [45, 80, 250]


def test_a_section_is_repeated(din) -> None:
    """L1,5 runs the section once and five times more: six steps of 3 mm."""
    assert ends(din("G00 X+0 M3*\nG98 L1*\nG91 X+3*\nL1,5*"))[-1] == [18, 0, 0]


def test_an_ellipse_of_lines(din) -> None:
    """Half axes 50 and 30 about (50, 50), 40 lines: the points are those of the ellipse."""
    run = din(
        "D00 Q1 P01 +0*\nD00 Q2 P01 +40*\nD04 Q3 P01 +360 P02 +Q2*\nD00 Q9 P01 +0*\nG00 X+100 Y+50 M3*\nG98 L1*\n"
        "D01 Q9 P01 +Q9 P02 +1*\nD03 Q1 P01 +Q9 P02 +Q3*\nQ11 = 50 + 50 * COS Q1*\nD06 Q12 P01 +Q1*\nD03 Q12 P01 +Q12 P02 +30*\n"
        "D01 Q12 P01 +Q12 P02 +50*\nG01 X+Q11 Y+Q12*\nD12 P01 +Q9 P02 +Q2 P03 1*"
    )
    angle = np.arange(1, 41) * math.tau / 40
    wanted = np.stack([50 + 50 * np.cos(angle), 50 + 30 * np.sin(angle), 0 * angle], axis=1)
    assert np.allclose(ends(run)[1:], wanted, atol=1e-9)


def test_transformations(din) -> None:
    """Shifted by (20, 30), turned by 90 degrees, mirrored in X, half as large: (10, 4) is at (18, 25)."""
    run = din("G54 X+20 Y+30*\nG73 H+90*\nG28 X*\nG72 F0.5*\nG00 X+10 Y+4 M3*\nG28*\nG73 H+0*\nG72 F1*\nG54 X+0 Y+0*\nX+1 Y+1*")
    assert np.allclose(ends(run), [[18, 25, 0], [1, 1, 0]], atol=1e-12)


def test_a_speed_alone_changes_the_speed(din) -> None:
    run = din("G01 X+1 M3*\nS2000*\nX+2*\nX+3 S3000*")
    assert run.toolpath.motion.spindle.tolist() == [1000, 2000, 3000]


def test_a_feed_beside_g00_counts_for_the_blocks_after_it(din) -> None:
    run = din("G00 X+1 F700 M3*\nG01 X+2*\nG01 X+3 F50*\nG00 X+4*\nG01 X+5*")
    assert run.toolpath.motion.feed.tolist() == [math.inf, 700, 50, math.inf, 50]


def test_a_block_that_is_passed_over(din) -> None:
    blocks = "G00 X+1 M3*\n/N30 X+5*\nN40 / X+7*\nY+2*"
    assert ends(din(blocks)) == [[1, 0, 0], [5, 0, 0], [7, 0, 0], [7, 2, 0]]
    assert ends(din(blocks, settings={"block_skip": True})) == [[1, 0, 0], [1, 2, 0]]


def test_stars_inside_a_line_and_structure_blocks(din) -> None:
    run = din('N20 G00 X+1 M3* N30 Y+2 *N40 Z+3*\nN50 * - THE HOLES\nN60 Q1 = 2 * 3 * 4*\nN70 X+Q1* ; X+9\n;N80 X+8*\nN90 *')
    assert ends(run) == [[1, 0, 0], [1, 2, 0], [1, 2, 3], [24, 2, 3]]
    assert [block.number for block in run.program][:7] == ["", "N10", "N20", "N30", "N40", "N50", "N60"]


def test_a_block_over_several_lines(din) -> None:
    run = din("N20 G00 X+1 ~\n  Y+2 ; both ~\n  Z+3 M3*\nN30 X+5*")
    assert ends(run) == [[1, 2, 3], [5, 2, 3]] and run.toolpath.motion.line.tolist() == [3, 6]


def test_a_line_in_which_one_block_ends_and_another_begins(din) -> None:
    run = din("N20 G00 X+1*\nN30 G201\n Q200=2 Q201=-5 Q206=100\n Q211=0 Q208=100 Q203=0 Q204=9* N40 G00 X+5*")
    assert run.at(line=6).line == 6 and run.at(line=5).block.keyword == "CYCL DEF 201"


def test_inches(tnc) -> None:
    run = tnc("%A G70 *\nT1 G17 S1000 F10*\nG01 X+1 Y+0.5 M3*\nG91 X+1*\nN9 %A G70*\n")
    assert run.toolpath.motion.end.tolist() == [[25.4, 12.7, 0], [50.8, 12.7, 0]]
    assert run.toolpath.motion.feed.tolist() == [25.4, 25.4]


# --- other programs, recognition --------------------------------------------------------------------------------------

SUB = "%SUB G71 *\nN10 G91 G00 X+5 *\nN99999999 %SUB G71 *\n"


@pytest.mark.parametrize("call", ["%SUB *", "%SUB.I*", "G39 P01 SUB*\nM99*", "G39 %SUB.I*\nG79*", 'CALL PGM "SUB"*'])
def test_programs_call_one_another(din, call: str) -> None:
    assert ends(din(f"G00 X+1 M3*\n{call}\nG90 Y+2*", files={"SUB.I": SUB})) == [[1, 0, 0], [6, 0, 0], [6, 2, 0]]


def test_both_kinds_of_programs_call_each_other(tnc, tmp_path: Path) -> None:
    """A name without a type is first sought with that of the caller."""
    (tmp_path / "sub.i").write_text(SUB)
    (tmp_path / "SUB.H").write_text("BEGIN PGM SUB MM\nL IX+7 FMAX\nEND PGM SUB MM\n")
    files = {
        "a.i": "%A G71 *\nG00 X+1*\n%SUB*\n%SUB.H*\nN9 %A G71*\n",
        "b.h": "BEGIN PGM B MM\nL X+1 FMAX\nCALL PGM SUB\nCALL PGM SUB.I\nEND PGM B MM\n",
    }
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    assert ends(mnc.run(tmp_path / "a.i")) == [[1, 0, 0], [6, 0, 0], [13, 0, 0]]
    assert ends(mnc.run(tmp_path / "b.h")) == [[1, 0, 0], [8, 0, 0], [13, 0, 0]]


def test_the_first_block_or_the_type_of_the_file_says_which_kind_it_is(tmp_path: Path) -> None:
    for text in ("%A G71 *\nG00 X+1*\n", "\ufeff\n; a part\n  %A  G70*\n", "%1 G71\nN10 T1 G17 S1000\n"):
        program = mnc.read(text)
        assert program.control == "tnc-620" and program[len(program) - 1].keyword in ("L", "BEGIN PGM", "TOOL CALL")
    for name, text in {"a.i": "G00 X+1*\n", "b.txt": "N10 G00 X+1*\n"}.items():
        (tmp_path / name).write_text(text)
        assert mnc.read(tmp_path / name, "tnc-620")[0].keyword == "L"
    (tmp_path / "c.i").write_text("0 BEGIN PGM C MM\n1 L X+1\n2 END PGM C MM\n")
    assert [block.keyword for block in mnc.read(tmp_path / "c.i")] == ["BEGIN PGM", "L", "END PGM"]


def test_the_blank_is_known(din) -> None:
    run = din("G30 G17 X+0 Y+0 Z-20*\nG31 G90 X+100 Y+80 Z+0*\nG00 Z+5 M3*")
    assert str(run.history["stock"][-1]) == "X0 Y0 Z-20 to X100 Y80 Z0" and run.ok


def test_many_lines_are_obeyed_at_once_as_one_by_one(tnc) -> None:
    points = [(round(math.cos(k), 3), round(math.sin(k), 3)) for k in range(200)]
    lines = "\n".join(f"N{10 * k} X{x:+} Y{y:+} *" for k, (x, y) in enumerate(points, 3))
    text = f"%A G71 *\nN10 T1 G17 S1000 *\nN20 G01 G40 G90 X+0 Y+0 F200 M3 *\n{lines}\nN9999 %A G71 *\n"
    fast, slow = tnc(text), tnc(text, bulk=False)
    assert np.array_equal(fast.toolpath.end, slow.toolpath.end)
    assert fast.program.plain.sum() == 200 and np.allclose(fast.toolpath.motion.end[:, :2], points)

"""BLK FORM CYLINDER and ROTATION: bodies whose sizes and volumes are worked out here.

The two examples are in the manner of those that the public manuals of the TNC 620 and 640 print.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import mnclab as mnc

END = "END PGM A MM\n"
STEPPED = "L X+0 Z+1\nL X+50\nL Z-20\nL X+70\nL Z-100\nL X+0\nL Z+1\n"


def program(blank: str, label: str = "", unit: str = "MM") -> str:
    return f"BEGIN PGM A {unit}\n{blank}\nM30\n{label}END PGM A {unit}\n"


def turned(contour: str, dim: str = "R", name: str = "1") -> str:
    return program(f"BLK FORM ROTATION Z DIM_{dim} LBL {name}", f"LBL {name}\n{contour}LBL 0\n")


def body(run: mnc.Run) -> object:
    assert run.ok, run.alarms
    assert run.stock is not None
    return run.stock


@pytest.mark.parametrize(
    ("words", "low", "high", "radius", "bore"),
    [
        ("Z R50 L105 DIST+5 RI10", (-50, -50, -100), (50, 50, 5), 50, 10),
        ("Z D100 L105 DIST-5 DI20", (-50, -50, -110), (50, 50, -5), 50, 10),
        ("Z R50 L100", (-50, -50, -100), (50, 50, 0), 50, 0),
        ("Z R+20 L+30 DIST0 RI0", (-20, -20, -30), (20, 20, 0), 20, 0),
        ("X D80 L60 DIST+2", (-58, -40, -40), (2, 40, 40), 40, 0),
        ("Y R40 L60", (-40, -60, -40), (40, 0, 40), 40, 0),
    ],
)
def test_cylinder(words, low, high, radius, bore, tnc) -> None:
    stock = body(tnc(program(f"BLK FORM CYLINDER {words}")))
    assert np.asarray(stock.bounds) == pytest.approx(np.array([low, high]))
    length = max(np.subtract(high, low) * [axis == words[0] for axis in "XYZ"])
    assert stock.volume == pytest.approx(math.pi * (radius**2 - bore**2) * length)


def test_parameters_and_inches(tnc) -> None:
    """Every length of it is in inches, and may be a Q parameter."""
    stock = body(tnc(program("Q1 = 2\nBLK FORM CYLINDER Z RQ1 L+4 DIST+0.5 DI1", unit="INCH")))
    assert np.asarray(stock.bounds) / 25.4 == pytest.approx(np.array([(-2, -2, -3.5), (2, 2, 0.5)]))
    assert stock.volume / 25.4**3 == pytest.approx(math.pi * (4 - 0.25) * 4)


@pytest.mark.parametrize(("dim", "share"), [("R", 1.0), ("D", 0.5)])
def test_stepped_body(dim, share, tnc) -> None:
    """Two discs on each other; the same numbers as diameters make it half as wide."""
    stock = body(tnc(turned(STEPPED, dim)))
    assert stock.volume == pytest.approx(share**2 * math.pi * (50**2 * 21 + 70**2 * 80))
    bottom, top = stock.faces(np.array([0, 49.9, 50.1, 69.9, 70.1]) * share, np.zeros(5))
    assert top[:4] == pytest.approx([1, 1, -20, -20]) and bottom[:4] == pytest.approx([-100] * 4) and np.isnan(top[4])


def test_arcs_stay_arcs_and_a_bore_may_have_a_step(tnc) -> None:
    """Half a ball of radius 20, and a ring with a stepped bore, whose volume is what each disc lacks."""
    half = body(tnc(turned("L X+0 Z+0\nL Z-20\nCR X+20 Z+0 R+20 DR-\nL X+0\n", name='"BALL"')))
    assert half.volume == pytest.approx(math.pi * 20**3 * 2 / 3, rel=1e-12)
    ring = body(tnc(turned("L X+10 Z-30\nL X+40\nL Z+0\nL X+25\nL Z-10\nL X+10\nL Z-30\n")))
    assert ring.volume == pytest.approx(math.pi * ((40**2 - 10**2) * 20 + (40**2 - 25**2) * 10))


def test_corners_of_its_contour_may_be_rounded_and_counted(tnc) -> None:
    """IX IZ, RND and CHF: a disc of radius 30 without the ring that a chamfer of 5 takes off (Pappus)."""
    stock = body(tnc(turned("L X+0 Z+0\nL IX+30\nCHF 5\nL IZ-10\nL X+0\nL Z+0\n")))
    assert stock.volume == pytest.approx(math.pi * 30**2 * 10 - math.tau * (30 - 5 / 3) * 12.5)


def test_nothing_moves_and_the_program_goes_on(tnc) -> None:
    text = turned(STEPPED).replace("M30\n", "TOOL CALL 1 Z S1000 F100\nL X+1 Y+2 Z+3 R0 FMAX M3\nM30\n", 1)
    run = tnc(text)
    assert run.ok and run.toolpath.motion.end.tolist() == [[1, 2, 3]]
    assert run.history.value("plane", 10) in (None, "XY")


def test_what_is_drilled_out_of_a_cylinder(tnc) -> None:
    """A flat mill of radius 4 plunges 10 mm into the top, which lies at Z5, 20 mm beside the axis."""
    setup = mnc.Setup(tools={1: mnc.Tool(radius=4)})
    move = "TOOL CALL 1 Z S1000 F100\nL X+20 Y+0 R0 FMAX M3\nL Z+10 R0 FMAX\nL Z-5 F100\nL Z+10 R0 FMAX"
    run = tnc(program(f"BLK FORM CYLINDER Z R50 L20 DIST+5\n{move}"), setup)
    left = run.workpiece()
    assert run.stock.volume - left.volume == pytest.approx(math.pi * 4**2 * 10, rel=2e-3)


def test_the_blank_chooses_among_free_contours(tnc) -> None:
    """From (40, 0) a line of 30 along X40 goes up or down: a cuboid leaves one of them, a cylinder about the datum both."""
    free = "TOOL CALL 1 Z S1000 F100\nL X+0 Y+0 R0 FMAX M3\nFL AN+0 LEN40\nFL LEN30 X+40\nL X+0 Y+0\n"
    one = tnc(program(f"BLK FORM 0.1 Z X-50 Y-10 Z-20\nBLK FORM 0.2 X+50 Y+50 Z+0\n{free}"))
    assert one.ok and one.toolpath.motion.end[1].tolist() == pytest.approx([40, 30, 0])
    both = tnc(program(f"BLK FORM CYLINDER Z R50 L20\n{free}"))
    assert [alarm.message for alarm in both.alarms] == ["FL: the free contour has 2 solutions here"]


@pytest.mark.deep
@pytest.mark.parametrize("blank", [program("BLK FORM CYLINDER Z R50 L105 DIST+5 RI10"), turned(STEPPED)])
def test_everything_that_shows_a_blank_shows_it(blank, tnc, tmp_path) -> None:
    move = "TOOL CALL 1 Z S1000 F100\nL X+60 Y+0 Z+50 R0 FMAX M3\nL Z-30 F100\nL X+40\nL Z+50 R0 FMAX\nM30\n"
    run = tnc(blank.replace("M30\n", move, 1), mnc.Setup(tools={1: mnc.Tool(radius=4)}))
    assert run.ok, run.alarms
    assert run.plot().axes and run.workpiece().plot().axes
    assert "stock" in str(run.explain(line=2)) or "blank" in str(run.explain(line=2)).lower()
    run.save(tmp_path / "part.html")
    assert (tmp_path / "part.html").stat().st_size > 1000


def test_the_block_that_gives_a_blank_says_so(tnc) -> None:
    assert "stock: X-70 Y-70 Z-100 to X70 Y70 Z1" in str(tnc(turned(STEPPED)).explain(line=2))

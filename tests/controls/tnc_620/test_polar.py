"""CC, CT, CHF, LP, CP, CTP: positions worked out here."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab as mnc
from mnclab import Kind

S3 = math.sqrt(3)


def ends(run: mnc.Run) -> list[list[float]]:
    assert run.ok, run.alarms
    return [[round(v, 6) + 0.0 for v in end[:2]] for end in run.toolpath.motion.end.tolist()]


def last(run: mnc.Run) -> mnc.Move:
    assert run.ok, run.alarms
    return run.toolpath.motion[-1]


# --- CC ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("block", "pole"),
    [
        ("CC X+5 Y-3", (5, -3)),
        ("CC IX+5 IY-3", (15, 17)),  # from the last programmed position (10, 20)
        ("CC", (10, 20)),
        ("CC X+5", (5, 20)),
        ("CC IY+4", (10, 24)),
        ("CC X+Q1 IY-Q1", (2.5, 17.5)),
    ],
)
def test_centre(block: str, pole: tuple[float, float], inside) -> None:
    run = inside(f"2 Q1 = 2.5\n3 L X+10 Y+20\n4 {block}")
    assert run.ok and run.history.value("pole", 4) == pole


# --- LP ---------------------------------------------------------------------------------------------------------------


def test_hexagon_of_polar_lines(inside) -> None:
    """Radius 30 about (45, 25): a corner every 60 degrees; PR is kept, IPA counts on."""
    run = inside("2 CC X+45 Y+25\n3 LP PR+30 PA+0\n4 LP PA+60\n5 LP IPA+60\n6 LP PA+180\n7 LP IPA+60\n8 LP PA-60")
    h = 15 * S3
    wanted = [(75, 25), (60, 25 + h), (30, 25 + h), (15, 25), (30, 25 - h), (60, 25 - h)]
    assert ends(run) == [pytest.approx(p, abs=1e-6) for p in wanted]


def test_incremental_polar_radius(inside) -> None:
    """From (3, 4), 5 mm from the pole: IPR+5 goes out to (6, 8) on the same angle."""
    run = inside("2 L X+3 Y+4\n3 CC X+0 Y+0\n4 LP IPR+5\n5 LP IPR-7.5 IPA+90\n6 LP PR+0")
    assert ends(run)[1:] == [[6, 8], [-2, 1.5], [0, 0]]


def test_quarters_of_a_turn_are_exact(inside) -> None:
    run = inside("2 CC X+0 Y+0\n3 LP PR+45 PA+90\n4 LP PR+45 PA-180\n5 LP PR+45 PA+810")
    assert run.toolpath.motion.end[:, :2].tolist() == [[0, 45], [-45, 0], [0, 45]]


def test_polar_words_in_inches(tnc) -> None:
    run = tnc("0 BEGIN PGM A INCH\n1 L X+0 F10\n2 CC X+0 Y+0\n3 LP PR+1 PA+90\n")
    assert run.toolpath.end[-1].tolist() == pytest.approx([0, 25.4, 0])


def test_l_with_polar_words_is_read_as_lp(inside) -> None:
    """As the manual prints it: L PR+25 PA+0 R0, with a warning."""
    run = inside("2 CC X+75 Y+50\n3 L PR+25 PA+0 R0")
    assert run.ok and ends(run) == [[100, 50]]
    assert [(a.span.line, a.span.column, a.message) for a in run.alarms] == [
        (4, 5, "L with polar coordinates is read as LP")
    ]


# --- CP ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("block", "sweep", "end"),
    [
        ("CP PA+90 DR+", 90, (0, 20, 5)),
        ("CP PA+90 DR-", -270, (0, 20, 5)),
        ("CP PA-90 DR+", 270, (0, -20, 5)),
        ("CP PA+0 DR+", 360, (20, 0, 5)),
        ("CP PA+360 DR-", -360, (20, 0, 5)),
        ("CP PA+30 Z-5 DR+", 30, (10 * S3, 10, -5)),
        ("CP IPA+360 DR+", 360, (20, 0, 5)),
        ("CP IPA-60 DR-", -60, (10, -10 * S3, 5)),
        ("CP IPA+1080 IZ-12 DR+", 1080, (20, 0, -7)),
        ("CP IPA-810 Z-7.5 DR-", -810, (0, -20, -7.5)),
    ],
)
def test_polar_circle_and_helix(block: str, sweep: float, end: tuple[float, ...], inside) -> None:
    arc = last(inside(f"2 L X+20 Y+0 Z+5\n3 CC X+0 Y+0\n4 {block}"))
    assert arc.kind == Kind.ARC and math.degrees(arc.sweep) == pytest.approx(sweep)
    assert arc.end.tolist() == pytest.approx(end, abs=1e-9) and arc.centre[:2].tolist() == [0, 0]


def test_length_of_a_helix(inside) -> None:
    """Three turns of radius 20 with a depth of 12: the hypotenuse of 3 * 2 pi * 20 and 12."""
    run = inside("2 L X+20 Y+0\n3 CC X+0 Y+0\n4 CP IPA-1080 IZ-12 DR-")
    assert run.toolpath.lengths[-1] == pytest.approx(math.hypot(120 * math.pi, 12))


def test_a_helix_is_compensated_in_its_plane(inside) -> None:
    """Bore of radius 20, RL inside and counter-clockwise, tool of radius 5: a helix of radius 15, square at both ends."""
    run = inside("2 L X+0 Y+0\n3 L X+20 Y+0 RL\n4 CC X+0 Y+0\n5 CP IPA+720 IZ-6 DR+\n6 L X+0 Y+0 R0")
    arc = run.toolpath[run.toolpath.kind == Kind.ARC][0]
    assert run.ok and arc.start.tolist() == pytest.approx([15, 0, 0]) and arc.end.tolist() == pytest.approx([15, 0, -6])
    assert arc.sweep == pytest.approx(4 * math.pi)


def test_polar_circle_in_a_turned_system(inside) -> None:
    """The angle counts in the system turned by 90 degrees: PA 0 there is +Y on the machine."""
    arc = last(inside("1 CYCL DEF 10.0 R\n1 CYCL DEF 10.1 ROT+90\n2 CC X+0 Y+0\n3 LP PR+10 PA+0\n4 CP PA+90 DR+"))
    assert arc.start[:2].tolist() == pytest.approx([0, 10]) and arc.end[:2].tolist() == pytest.approx([-10, 0])


# --- CT and CTP -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("before", "block", "centre", "sweep"),
    [
        # along +X to (10, 0): the centre lies beside (10, 0); a quarter, a half, three quarters of a turn
        ("L X+10", "CT X+15 Y+5", (10, 5), 90),
        ("L X+10", "CT X+15 Y-5", (10, -5), -90),
        ("L X+10", "CT Y+8", (10, 4), 180),
        ("L X+10", "CT X+7 IY+3", (10, 3), 270),
        # chord (0, 0) - (3, 4) with the travel +X: R = |d|² / (2 d_y) = 25 / 8
        ("L X+10", "CT IX+3 IY+4", (10, 3.125), 2 * math.degrees(math.atan2(4, 3))),
        # after a quarter circle about (10, 10) the travel is +Y at (20, 10)
        ("L X+10\nCR X+20 Y+10 R10 DR+", "CT X+30 Y+20", (30, 10), -90),
        ("L X+10\nCC X+10 Y+10\nCP IPA+90 DR+", "CT X+30 Y+20", (30, 10), -90),
        # to (0, 20): chord (-10, 20), R = 500 / 40, and the chord turns away from +X by 180 degrees less atan 2
        ("L X+10\nCC X+0 Y+0", "CTP PR+20 PA+90", (10, 12.5), 2 * (180 - math.degrees(math.atan(2)))),
    ],
)
def test_tangential_arcs(before: str, block: str, centre: tuple[float, float], sweep: float, inside) -> None:
    arc = last(inside(f"{before}\n{block}"))
    assert arc.centre[:2].tolist() == pytest.approx(centre) and math.degrees(arc.sweep) == pytest.approx(sweep)


def test_the_tangential_arc_of_pgm_c25(inside) -> None:
    """From the manual: from (5, 20), travel at 45 degrees, to (5, 75): R = 55 / (2 sin 45), centre (-22.5, 47.5)."""
    arc = last(inside("2 L X+0 Y+15\n3 L X+5 Y+20\n4 CT X+5 Y+75"))
    assert np.hypot(*(arc.start - arc.centre)[:2]) == pytest.approx(55 / math.sqrt(2))
    assert arc.centre[:2].tolist() == pytest.approx([-22.5, 47.5]) and arc.sweep > 0


def test_straight_ahead_is_a_line(inside) -> None:
    move = last(inside("2 L X+10 Y+10\n3 CT X+25 Y+25"))
    assert move.kind == Kind.LINE and move.end[:2].tolist() == [25, 25]


@given(*[st.floats(-40, 40)] * 4, st.floats(-3, 3))
def test_a_tangential_arc_turned(x, y, u, v, spin) -> None:
    """It begins along the line before, lies on its circle, and turns with the program."""
    if math.hypot(x, y) < 1 or math.hypot(u - x, v - y) < 1 or abs(x * (v - y) - y * (u - x)) < 1:
        return
    arcs = []
    for angle in (0.0, spin):
        c, s = math.cos(angle), math.sin(angle)
        a, b = (f"X{c * p - s * q:+.9f} Y{s * p + c * q:+.9f}" for p, q in ((x, y), (u, v)))
        arcs.append(last(mnc.run(f"1 TOOL CALL 1 Z F100\n2 L {a}\n3 CT {b}\n", "tnc-620")))
    one, turned = arcs
    spoke = (one.start - one.centre)[:2]
    size = np.hypot(*spoke)
    assert abs(spoke @ [x, y]) / math.hypot(x, y) < 1e-5 * max(1, size)
    assert np.hypot(*(one.end - one.centre)[:2]) == pytest.approx(size, rel=1e-7)
    assert one.sweep * (spoke[0] * y - spoke[1] * x) > 0
    assert turned.sweep == pytest.approx(one.sweep, abs=1e-5)


def test_a_contour_with_a_tangential_arc_is_compensated(inside) -> None:
    """Along +X to (40, 0), then CT to (40, 20), RR outside: parallel at Y = -5, then radius 15 about (40, 10)."""
    run = inside("2 L X+0 Y-20\n3 L X+0 Y+0 RR\n4 L X+40\n5 CT X+40 Y+20\n6 L X+0\n7 L X+0 Y+50 R0")
    assert run.ok, run.alarms
    arc = run.toolpath[run.toolpath.kind == Kind.ARC][0]
    assert arc.start[:2].tolist() == pytest.approx([40, -5]) and arc.end[:2].tolist() == pytest.approx([40, 25])


# --- CHF --------------------------------------------------------------------------------------------------------------


def test_chamfer(inside) -> None:
    """A right angle at (20, 0), 4 mm along each line, with a feed of its own."""
    run = inside("2 L X+20\n3 CHF 4 F50\n4 L Y+10")
    assert ends(run) == [[16, 0], [20, 4], [20, 10]]
    assert run.toolpath.motion.feed.tolist() == [100, 50, 100]
    assert run.toolpath[2].label == "chamfer" and run.toolpath[2].kind == Kind.LINE


def test_chamfers_and_roundings_share_a_line(inside) -> None:
    """On the line from (20, 0) to (20, 10): 6 mm go to the chamfer, 4 mm to the rounding, nothing is left between."""
    run = inside("2 L X+20\n3 CHF 6\n4 L Y+10\n5 RND R4\n6 L X+0")
    assert ends(run) == [[14, 0], [20, 6], [16, 10], [0, 10]]


def test_roundings_that_use_up_a_line_need_no_stop(inside) -> None:
    """Two quarters of 5 mm share the line of 10 mm: a half circle, which is run through at the feed."""
    run = inside("2 L X+20\n3 RND R5\n4 L Y+10\n5 RND R5\n6 L X+0", mnc.Setup(limits=mnc.Limits(acceleration=1000)))
    assert ends(run) == [[15, 0], [20, 5], [15, 10], [0, 10]]
    profile = run.profile()
    inner = (profile.t > 0.1) & (profile.t < profile.time - 0.1)
    assert profile.v[inner].min() == pytest.approx(100 / 60, rel=1e-6)


def test_a_chamfer_is_compensated_as_an_element(inside) -> None:
    """Outside with RR, tool of radius 5: beside the chamfer's face (16, 0) - (20, 4) at 5 mm, arcs at both its ends."""
    run = inside("2 L X-10 Y+0\n3 L X+0 RR\n4 L X+20\n5 CHF 4\n6 L Y+30\n7 L Y+60 R0")
    assert run.ok, run.alarms
    face = run.toolpath[[run.toolpath.labels[k] == "chamfer" for k in run.toolpath.label]][0]
    d = 5 / math.sqrt(2)
    assert face.start[:2].tolist() == pytest.approx([16 + d, -d]) and face.end[:2].tolist() == pytest.approx(
        [20 + d, 4 - d]
    )


def test_a_corner_between_rapids_takes_its_own_feed(inside) -> None:
    run = inside("2 L X+20 FMAX\n3 RND R4 F50\n4 L Y+10 FMAX")
    assert run.toolpath.motion.feed.tolist() == [math.inf, 50, math.inf]
    run = inside("2 L X+20 F70\n3 RND R4\n4 L Y+10 FMAX")
    assert run.toolpath.motion.feed.tolist() == [70, 70, math.inf]

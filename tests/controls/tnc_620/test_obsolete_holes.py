"""Cycles 1, 2 and 17 against numbers worked out from the manuals of earlier controls (TNC 407, 8.2; TNC 426/430, 8.3).

Pecking: to each infeed at the feed, out to where the tool stood, in again to t above the last depth; t = 0.6 mm to a depth of
30 mm, else a fiftieth of the depth, at most 7 mm. Tapping: to the depth in one go, the spindle reversed there and, with a
floating holder, again at the top.
"""

from __future__ import annotations

import pytest

import mnclab as mnc
from mnclab import Kind

HEAD = "0 BEGIN PGM A MM\n1 TOOL CALL 2 Z S500\n2 L X+20 Y+10 Z{z:+g} R0 FMAX {m}\n"


def pecking(depth: float, infeed: float, clearance: float = 2, dwell: float = 0, z: float = 2) -> str:
    return (
        f"{HEAD.format(z=z, m='M3')}3 CYCL DEF 1.0 PECKING\n4 CYCL DEF 1.1 SET UP {clearance}\n5 CYCL DEF 1.2 DEPTH {depth}\n"
        f"6 CYCL DEF 1.3 PECKG {infeed}\n7 CYCL DEF 1.4 DWELL {dwell}\n8 CYCL DEF 1.5 F80\n9 CYCL CALL\n"
    )


def test_pecking_in_its_example(tnc, rows, drilled) -> None:
    """DEPTH-15, PECKG 7.5 from 2 above the surface: to -7.5, out, in to -7.5 + 0.6, to -15, a second, out."""
    run = tnc(pecking(-15, 7.5, dwell=1))
    assert drilled(run)[-6:] == ["Z-7.5 F80", "Z2 FMAX", "Z-6.9 FMAX", "Z-15 F80", "dwell 1 s", "Z2 FMAX"]
    assert rows(run).end[-1].tolist() == [20, 10, 2]


@pytest.mark.parametrize(("depth", "stop"), [(-30, 0.6), (-40, 0.8), (-350, 7), (-400, 7)])
def test_the_advanced_stop_distance(tnc, rows, depth: float, stop: float) -> None:
    path = rows(tnc(pecking(depth, -depth / 2)))
    back = path.end[[path.labels[k].endswith("return") for k in path.label], 2]
    assert back == pytest.approx([depth / 2 + stop])


def test_it_is_that_of_the_true_depth(tnc, rows) -> None:
    """Twice as deep on the machine, 40: 0.8 mm there."""
    scale = "CYCL DEF 26.0 S\nCYCL DEF 26.1 X1 Y1 Z2\n"
    path = rows(tnc(pecking(-20, 10).replace("2 L X", f"{scale}2 L X")))
    assert path.end[[path.labels[k].endswith("return") for k in path.label], 2] == pytest.approx([-20 + 0.8])


def test_a_peck_deeper_than_the_hole_is_one(drilled, tnc) -> None:
    assert drilled(tnc(pecking(-12, 20)))[-2:] == ["Z-12 F80", "Z2 FMAX"]


@pytest.mark.parametrize(("clearance", "infeed"), [(2, 5), (-2, -5), (2, -5), (-2, 5)])
def test_older_programs_sign_all_lengths(tnc, rows, clearance: float, infeed: float) -> None:
    """Surface 0 below a tool that stands at 2."""
    path = rows(tnc(pecking(-10, infeed, clearance)))
    assert path.end[path.kind == Kind.LINE, 2].tolist() == [-5, -10]


def test_upwards_where_the_machine_allows_it(tnc, rows) -> None:
    """From -20, 2 below a surface at -18, up to -8, and out again downwards."""
    path = rows(tnc(pecking(10, 5, z=-20), depth_error=False))
    assert path.end[:, 2].tolist() == [-13, -20, -13.6, -8, -20]


def test_the_clearance_counts_from_where_the_tool_stands(tnc, rows) -> None:
    """At 50 with a set-up clearance of 2 the surface is at 48."""
    assert rows(tnc(pecking(-10, 10, z=50))).end[:, 2].tolist() == [38, 50]


def test_in_inches(tnc, rows) -> None:
    """SET UP 0.1 and DEPTH -1 in inches, F 10 in tenths: the bottom is (0.5 - 0.1 - 1) inch down."""
    text = pecking(-1, 1, 0.1, z=0.5).replace("A MM", "A INCH").replace("F80", "F10")
    path = rows(tnc(text))
    assert path.end[:, 2] == pytest.approx([-0.6 * 25.4, 0.5 * 25.4]) and path.feed[0] == pytest.approx(25.4)


def tapping(depth: float = -20, dwell: float = 0.4, feed: float = 500, m: str = "M3") -> str:
    return (
        f"{HEAD.format(z=3, m=m)}3 CYCL DEF 2.0 TAPPING\n4 CYCL DEF 2.1 SET UP 3\n5 CYCL DEF 2.2 DEPTH {depth}\n"
        f"6 CYCL DEF 2.3 DWELL {dwell}\n7 CYCL DEF 2.4 F{feed}\n8 CYCL CALL\n"
    )


@pytest.mark.parametrize(("m", "sense"), [("M3", 1), ("M4", -1)])
def test_a_floating_tap(tnc, rows, m: str, sense: int) -> None:
    """Down, reversed, the dwell, up, reversed again."""
    path = rows(tnc(tapping(m=m)))
    moves = path.motion
    assert moves.end[:, 2].tolist() == [-20, 3] and moves.feed.tolist() == [500, 500]
    assert moves.spindle.tolist() == [500 * sense, -500 * sense]
    assert path.time[path.kind == Kind.DWELL].tolist() == [0.4] and path.spindle[-1] == 500 * sense


def rigid(pitch: float, z: float = 2) -> str:
    return (
        f"{HEAD.format(z=z, m='')}3 CYCL DEF 17.0 RIGID TAPPING\n4 CYCL DEF 17.1 SET UP 2\n5 CYCL DEF 17.2 DEPTH -20\n"
        f"6 CYCL DEF 17.3 PITCH {pitch:+g}\n7 CYCL CALL\n"
    )


@pytest.mark.parametrize("pitch", [1.5, -1.5])
def test_a_rigid_tap_stops_its_spindle(tnc, rows, pitch: float) -> None:
    """At 500 rev/min a pitch of 1.5 is 750 mm/min; a left-hand thread turns the other way; at the end the spindle stands."""
    run = tnc(rigid(pitch))
    moves = rows(run).motion
    assert moves.end[:, 2].tolist() == [-20, 2] and moves.synchronous.all()
    assert moves.spindle.tolist() == [500 * pitch / 1.5, -500 * pitch / 1.5] and run.toolpath.spindle[-1] == 0
    assert tnc(rigid(pitch) + "8 L X+40 FMAX M99\n").ok


def test_the_pitch_is_that_of_the_tap(tnc) -> None:
    tools = {2: mnc.Tool(radius=4, pitch=1.25)}
    found = mnc.run(rigid(1.5), "tnc-620", mnc.Setup(tools=tools)).alarms[-1]
    assert "means a pitch of 1.5 mm, the tap of tool 2 has 1.25 mm" in found.message and found.span[:2] == (7, 17)

"""F, FMAX, FAUTO, FU, FZ in blocks and in cycles; feeds that depend on the way (catalogue: F, M103, M110)."""

from __future__ import annotations

import math

import pytest

import mnclab as mnc
from mnclab import Kind

TEETH = mnc.Setup(tools={1: mnc.Tool(radius=5, teeth=4), 2: mnc.Tool(radius=5, teeth=2), 3: mnc.Tool(radius=5)})


def feeds(run: mnc.Run) -> list[float]:
    assert run.ok, run.alarms
    return [round(float(move.feed), 4) for move in run.toolpath if move.kind in (Kind.LINE, Kind.ARC, Kind.RAPID)]


def test_a_feed_per_revolution_and_per_tooth(inside) -> None:
    """FU 0.2 at 1000 rev/min is 200 mm/min; FZ 0.05 of 4 teeth is the same; both hold until another feed is written."""
    run = inside("2 L X+1 FU0.2 M3\n3 L X+2\n4 L X+3 FMAX\n5 L X+4\n6 L X+5 FZ0,05\n7 L X+6 F80\n8 L X+7 FAUTO", TEETH)
    assert feeds(run) == [200, 200, math.inf, 200, 200, 80, 100]
    assert run.toolpath.motion.per_rev.tolist() == pytest.approx(
        [0.2, 0.2, math.nan, 0.2, 0.2, *[math.nan] * 2], nan_ok=True
    )


def test_they_follow_the_speed_and_the_tool(inside) -> None:
    """FU: 0.2 mm at 500 rev/min; FZ: 0.1 mm of 4 teeth, then of 2, at 500 rev/min."""
    run = inside("2 L X+1 FU0.2 M3\n3 TOOL CALL S500\n4 L X+2\n5 L X+3 FZ0.1\n6 TOOL CALL 2 Z\n7 L X+4", TEETH)
    assert feeds(run) == [200, 100, 200, 100]


def test_inches_and_q_parameters(tnc) -> None:
    """0.01 inch per revolution at 100 rev/min are 25.4 mm/min; F0.01 is 0.001 inch a minute."""
    run = tnc(
        "0 BEGIN PGM I INCH\n1 TOOL CALL 1 Z S100 F10\n2 Q1 = 0.01\n3 L X+1 FUQ1 M3\n4 L X+2 FQ1\n5 END PGM I INCH\n"
    )
    assert feeds(run) == [25.4, 0.0254]


@pytest.mark.parametrize(("written", "feed"), [("FAUTO", 100), ("FU0.2", 200), ("FU ,2", 200), ("250", 250)])
def test_in_place_of_a_number_of_a_cycle(inside, written: str, feed: float) -> None:
    """Bound where the cycle is defined: the speed of 3000 rev/min and the feed 999 come later."""
    text = f"2 CYCL DEF 200 D\nQ200=2\nQ201=-5\nQ206={written}\nQ202=5\nQ210=0\nQ203=0\nQ204=20\nQ211=0\n"
    run = inside(text + "3 TOOL CALL S3000 F999\n4 CYCL CALL M3", TEETH)
    assert run.variables["Q206"] == feed and feeds(run).count(feed) == 1


def test_a_feed_per_tooth_of_a_cycle(inside) -> None:
    """Cycle 22: 0.05 mm for each of 4 teeth at 1000 rev/min."""
    text = "2 CYCL DEF 22 R\nQ10=-5\nQ11=FU0.1\nQ12=FZ0,05\nQ18=0\nQ19=150\nQ208=99\nQ401=100\nQ404=0\n"
    run = inside(text, TEETH)
    assert run.ok and (run.variables["Q11"], run.variables["Q12"]) == (100, 200)


def test_plunging_is_slower(inside) -> None:
    """M103 F20 of F500: 100 straight down, 100 * sqrt(2) down at 45 degrees, 500 in the plane and upwards."""
    blocks = "2 L X+20 Y+20 R0 F500 M103 F20\n3 L Y+50\n4 L IZ-2.5\n5 L IY+5 IZ-5\n6 L IX+50\n7 L Z+5\n8 L Z+0 FMAX\n9 L Z-5 M103"
    assert feeds(inside(blocks)) == [500, 500, 100, 141.4214, 500, 500, math.inf, 500]


def test_plunging_acts_on_the_feed_moves_of_a_cycle(inside, drilled) -> None:
    text = "2 CYCL DEF 200 D\nQ200=2\nQ201=-5\nQ206=250\nQ202=5\nQ210=0\nQ203=0\nQ204=20\nQ211=0\n3 L X+0 Y+0 FMAX M3 M103 F50\n"
    assert drilled(inside(text + "4 CYCL CALL")) == ["Z2 FMAX", "Z-5 F125", "Z20 FMAX"]


@pytest.mark.parametrize(
    ("code", "inside_arc", "outside_arc"), [("M109", 75, 125), ("M110", 75, 100), ("M111", 100, 100)]
)
def test_the_feed_counts_at_the_edge_of_arcs(inside, code: str, inside_arc: float, outside_arc: float) -> None:
    """Tool radius 5 on a contour of radius 20: the centre runs on 15 inside and on 25 outside."""
    run = inside(f"2 L X+20 Y+0 RL F100 M3 {code}\n3 CC X+0 Y+0\n4 C X-20 Y+0 DR+\n5 C X+20 Y+0 DR+\n6 L Y-50 R0")
    assert run.ok, run.alarms
    arcs = [move.feed for move in run.toolpath if move.kind == Kind.ARC and move.line in (5, 6)]
    assert arcs == pytest.approx([inside_arc] * len(arcs)) and len(arcs) >= 2
    run = inside(f"2 L X+20 Y+0 RR F100 M3 {code}\n3 CC X+0 Y+0\n4 C X-20 Y+0 DR+\n5 C X+20 Y+0 DR+\n6 L Y+50 R0")
    arcs = [move.feed for move in run.toolpath if move.kind == Kind.ARC and move.line in (5, 6)]
    assert run.ok and arcs == pytest.approx([outside_arc] * len(arcs)) and len(arcs) >= 2


def test_a_corner_has_no_edge_to_count_at(inside) -> None:
    run = inside("2 L X+0 Y+0 RL F100 M109\n3 L X+20\n4 L Y-20\n5 L X+0\n6 L X-20 R0")
    assert run.ok and set(run.toolpath.motion.feed.tolist()) == {100}


def test_the_alarm_of_a_feed_per_tooth_in_inches_tells_what_was_typed() -> None:
    """The number is the one in the block, not its millimetres (0.254)."""
    text = "BEGIN PGM T INCH\nTOOL CALL 3 Z S1000\nL Z+2 R0 FMAX M3\nL X+1 FZ0.01\nEND PGM T INCH\n"
    (alarm,) = mnc.run(text, "tnc-620", TEETH).alarms
    assert alarm.message.startswith("FZ0.01 needs the number of teeth of tool 3")

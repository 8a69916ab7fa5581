"""L, CC, C, CR, RND, feeds and M functions; numbers from the catalogue or worked out here."""

from __future__ import annotations

import math

import pytest

import mnclab as mnc


def ends(run: mnc.Run) -> list[list[float]]:
    return [[round(v, 3) for v in end[:2]] for end in run.toolpath.motion.end.tolist()]


def test_lines_absolute_and_incremental(inside) -> None:
    run = inside("2 L X+10 Y+5\n3 L IX-4 IY+Q1\n4 L Z+3".replace("IY+Q1", "IY+2,5"))
    assert run.toolpath.motion.end.tolist() == [[10, 5, 0], [6, 7.5, 0], [6, 7.5, 3]]


def test_fmax_counts_in_its_block_alone_and_f_is_modal(inside) -> None:
    run = inside("2 L X+1 F300\n3 L X+2 FMAX\n4 L X+3\n5 L X+4 FAUTO\n6 L X+5")
    assert run.toolpath.motion.feed.tolist() == [300, math.inf, 300, 100, 100]


def test_feed_of_tool_call_is_the_feed_until_another(tnc) -> None:
    run = tnc("1 TOOL CALL 1 Z S100 F80\n2 L X+1\n3 TOOL CALL Z S200\n4 L X+2\n")
    assert run.toolpath.motion.feed.tolist() == [80, 80]


def test_circle_by_centre(inside) -> None:
    """Pocket A of section 8.3 without compensation: a full circle, centre (35, 50), radius 25, clockwise."""
    run = inside("2 L X+10 Y+50\n3 CC X+35 Y+50\n4 C X+10 Y+50 DR-")
    arc = run.toolpath[-1]
    assert (arc.kind, arc.centre[:2].tolist(), arc.sweep) == (mnc.Kind.ARC, [35, 50], pytest.approx(-2 * math.pi))
    assert ends(run)[-1] == [10, 50]


def test_axis_not_written_in_c_keeps_its_value(inside) -> None:
    """As the manual prints it: C X+10 DR- after L X+10 Y+50 is a full circle."""
    run = inside("2 L X+10 Y+50\n3 CC X+35 Y+50\n4 C X+10 DR-")
    assert run.toolpath[-1].sweep == pytest.approx(-2 * math.pi)


def test_cc_without_coordinates_takes_the_last_position(inside) -> None:
    run = inside("2 L X+10 Y+50\n3 CC\n4 L X+20 Y+50\n5 C X+10 Y+60 DR+\n6 CC IX+0 IY-10\n7 C X+0 Y+50 DR+")
    assert [move.centre[:2].tolist() for move in run.toolpath if move.kind == mnc.Kind.ARC] == [[10, 50], [10, 50]]


@pytest.mark.parametrize(
    ("block", "centre", "sweep"),
    [
        # chord (0,0)-(10,0), R 10: the centre lies 8.660 = sqrt(100 - 25) beside its middle; 60 or 300 degrees
        ("CR X+10 Y+0 R+10 DR+", [5, 8.660], 60),
        ("CR X+10 Y+0 R+10 DR-", [5, -8.660], -60),
        ("CR X+10 Y+0 R-10 DR+", [5, -8.660], 300),
        ("CR X+10 Y+0 R-10 DR-", [5, 8.660], -300),
        ("CR X+10 Y+0 R5 DR-", [5, 0], -180),
    ],
)
def test_circle_by_radius(block: str, centre: list[float], sweep: float, inside) -> None:
    arc = inside("2 " + block).toolpath[-1]
    assert arc.centre[:2].tolist() == pytest.approx(centre, abs=1e-3)
    assert math.degrees(arc.sweep) == pytest.approx(sweep)


def test_end_of_an_arc_within_16_micrometres(inside) -> None:
    blocks = "2 CC X+10 Y+0\n3 C X+{} Y+0 DR+"
    assert inside(blocks.format("20.016")).ok
    assert not inside(blocks.format("20.017")).ok


def test_rounding(inside) -> None:
    """A right angle at (10, 0), R 4: tangent points 4 mm from the corner, with a feed of its own."""
    run = inside("2 L X+10\n3 RND R4 F50\n4 L Y+10")
    assert ends(run) == [[6, 0], [10, 4], [10, 10]]
    assert run.toolpath.motion.feed.tolist() == [100, 50, 100]
    assert run.toolpath[2].centre[:2].tolist() == [6, 4]


def test_rounding_after_a_long_run_of_plain_lines(inside) -> None:
    """Plain lines are obeyed in bulk; the rounding finds the last of them."""
    blocks = "\n".join(f"L X+{k}" for k in range(1, 101)) + "\nRND R0.5\nL Y+10"
    run = inside(blocks)
    assert run.ok and ends(run)[-3:] == [[99.5, 0], [100, 0.5], [100, 10]]


def test_m_functions_act_before_or_after_the_motion(inside) -> None:
    run = inside("2 L X+1 M3 M8\n3 L X+2 M5 M9\n4 L X+3 M13\n5 L X+4 M14\n6 L X+5 M6\n7 L X+6 M0\n8 STOP")
    kinds = "".join(move.kind.name[0] for move in run.toolpath)
    # tool; spindle coolant line; line spindle coolant; spindle coolant line (M13 and M14);
    # line, M6 spindle; line stop; stop; end: coolant
    assert kinds == "TSCLLSCSCLSCLLSLSSC"
    assert run.toolpath.motion.spindle.tolist() == [1000, 1000, 1000, -1000, -1000, 0]


def test_end_of_program_stops_the_spindle_and_the_run(inside) -> None:
    run = inside("2 L X+1 M3\n3 M2\n4 L X+2")
    assert ends(run) == [[1, 0]] and run.toolpath[-1].spindle == 0


def test_tool_call(tnc) -> None:
    """Number, name, speed alone, deltas: radius 5 - 0.1, length 80 + 0.2."""
    setup = mnc.Setup(tools={1: mnc.Tool(radius=5, length=80), 69: mnc.Tool(radius=2, length=100, name="TCH PROBE")})
    run = tnc(
        '3 TOOL CALL 1 Z S4500 DL+0.2 DR-0.1\n4 TOOL CALL 69 Z\n5 TOOL CALL "tch probe" Z\n6 TOOL CALL Z S200\n', setup
    )
    assert run.ok
    rows = run.toolpath
    assert [(m.tool, round(m.radius, 6), round(m.end[2], 6)) for m in rows] == [
        (1, 4.9, -80.2),
        (69, 2, -100),
        (69, 2, -100),
    ]
    assert [run.history.value("speed", step) for step in range(4)] == [4500, 4500, 4500, 200]


def test_deltas_stay_when_only_the_speed_changes(tnc) -> None:
    run = tnc("1 TOOL CALL 1 Z DR+0.5\n2 TOOL CALL Z S200 DL+0.25\n")
    assert run.history.value("tool", 1).dr == 0.5 and run.history.value("tool", 1).dl == 0.25


def test_preset_is_the_origin(tnc) -> None:
    setup = mnc.Setup(presets={3: (100, 50, -20)}, settings={"preset": 3})
    run = tnc("1 L X+10 Y+0 Z+0 F100\n", setup)
    assert tuple(run.toolpath.origin) == (100, 50, -20) and run.toolpath[0].end.tolist() == [10, 0, 0]


def test_a_preset_that_is_turned_and_tilted(tnc) -> None:
    """Rz(30) Ry(20) Rx(10) of (10, 0, 0): the turn about X leaves it, that about Y takes it to (10 cos 20, 0, -10 sin 20)."""
    preset = mnc.Datum(1, 2, 3, c=5, rotation=30, tilt_x=10, tilt_y=20)
    run = tnc("1 L X+10 Y+0 Z+0 C+10 F100\n", mnc.Setup(presets={0: preset}))
    cos, sin = (lambda angle: math.cos(math.radians(angle))), (lambda angle: math.sin(math.radians(angle)))
    assert tuple(run.toolpath.origin) == (1, 2, 3)
    expected = (10 * cos(20) * cos(30), 10 * cos(20) * sin(30), -10 * sin(20))
    assert run.toolpath[0].end == pytest.approx(expected, abs=1e-12)
    assert math.degrees(run.toolpath.rotary[-1][2]) == pytest.approx(15)  # C counts from 5


def test_blank(tnc) -> None:
    """PGM C200, blocks 1 and 2; and the greatest corner incremental."""
    for second in ("X+100 Y+100 Z+0", "IX+100 Y+100 IZ+20"):
        run = tnc(f"1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n2 BLK FORM 0.2 {second}\n")
        blank = run.history.at(1)["stock"]
        assert run.ok and blank == ("Z", (0, 0, -20), (100, 100, 0))


def test_incremental_corner_counts_from_the_least(tnc) -> None:
    run = tnc("1 BLK FORM 0.1 Z X-10 Y+5 Z-20\n2 BLK FORM 0.2 IX+30 IY+40 IZ+20\n")
    assert run.history.at(1)["stock"].maximum == (20, 45, 0)

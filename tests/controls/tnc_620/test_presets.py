"""TCH PROBE 419 against planes of a virtual part (tnc620-probing-presets, 15.13; the checks' virtual probe)."""

import pytest

import mnclab
from mnclab import Kind, Probe, Setup, Tool
from mnclab.workpiece.part import plane

#: Active preset row 1, ball radius 2, SET_UP 2, DIST 10, south pole at Z100 before the cycle [checks].
PRESET = (100, 200, -300)
VALUES = {
    "Q263": 25,
    "Q264": 25,
    "Q261": 25,
    "Q320": 0,
    "Q260": 50,
    "Q272": 1,
    "Q267": 1,
    "Q305": 0,
    "Q333": 0,
    "Q303": 1,
}


def probing(part, after="", before="L Z+100 R0 FMAX\n", **changes):
    """Run the cycle; `part` is (point, normal) in program coordinates."""
    values = VALUES | changes
    lines = "\n".join(f"{name}={value:+g} ;COMMENT" for name, value in values.items())
    text = f"0 BEGIN PGM P MM\n1 TOOL CALL 7 Z\n{before}3 TCH PROBE 419 PUNCT 0 INTR-O AXA\n{lines}\n{after}9 END PGM P MM\n"
    point = [p + o for p, o in zip(part[0], PRESET, strict=True)]
    setup = Setup(
        tools={7: Tool(radius=2, kind="probe")}, presets={1: PRESET}, settings={"preset": 1}, part=plane(point, part[1]),
        probe=Probe(clearance=2, reach=10),
    )  # fmt: skip
    return mnclab.run(text, "tnc-620", setup)


WALL = ((25.06, 0, 0), (-1, 0, 0))  # material on the + side


def test_example_of_the_manual():
    """Moves and the new row as the catalogue has them, to 1e-9 mm since the part is a plane."""
    run = probing(WALL)
    assert run.ok, run.alarms
    moves = run.toolpath.motion[1:]
    assert [Kind(k).name for k in moves.kind] == ["RAPID", "RAPID", "PROBE", "RAPID", "RAPID"]
    expected = [(21, 25, 100), (21, 25, 23), (23.06, 25, 23), (21, 25, 23), (21, 25, 50)]
    assert moves.end == pytest.approx(mnclab_array(expected), abs=1e-9)
    assert run.tables.presets[0] == pytest.approx((125.06, 200, -300, 0, 0, 0, 0, 0, 0), abs=1e-9)
    assert run.tables.presets[1] == (100, 200, -300, 0, 0, 0, 0, 0, 0)
    assert run.setup.presets[1] == PRESET  # the setup stays as it was


def mnclab_array(rows):
    import numpy as np

    return np.array(rows, dtype=float)


def test_the_result_moves_the_datum_of_the_blocks_that_follow():
    """X 0 of the program is now the wall: 25.06 in the old system, which is the origin of the path. The probe stays off it."""
    run = probing(WALL, after="5 L X-10 Y+0 R0 FMAX\n6 L IX+1 FMAX\n")
    assert run.toolpath.end[-2] == pytest.approx((15.06, 0, 50), abs=1e-9)
    assert run.toolpath.end[-1] == pytest.approx((16.06, 0, 50), abs=1e-9)
    line = next(n for n, text in enumerate(run.program.text.splitlines(), 1) if text.startswith("5 L X-10"))
    assert run.at(line=line).position == pytest.approx((-10, 0, 50), abs=1e-9)


def test_downwards():
    """Q272 = 3, Q267 = -1, surface Z25.07: row 0 Z -274.93, from a start at south pole 27."""
    run = probing(((0, 0, 25.07), (0, 0, 1)), Q272=3, Q267=-1)
    touch = run.toolpath[run.toolpath.kind == Kind.PROBE][0]
    assert touch.start == pytest.approx((25, 25, 27), abs=1e-9) and touch.end == pytest.approx(
        (25, 25, 25.07), abs=1e-9
    )
    assert run.tables.presets[0][:3] == pytest.approx((100, 200, -274.93), abs=1e-9)


def test_a_nominal_value_other_than_zero():
    """Row X = active + measured - Q333: the wall gets the coordinate 10."""
    run = probing(WALL, Q333=10)
    assert run.tables.presets[0].x == pytest.approx(115.06, abs=1e-9)


def test_a_row_that_is_not_active_is_written_and_not_activated():
    run = probing(WALL, Q305=5, after="5 L X+0 Y+0 R0 FMAX\n")
    assert run.tables.presets[5][:3] == pytest.approx((125.06, 0, 0), abs=1e-9)
    assert 0 not in run.tables.presets and run.toolpath.end[-1] == pytest.approx((0, 0, 50), abs=1e-9)


def test_the_datum_table():
    run = probing(WALL, Q305=3, Q303=0)
    assert run.tables.datums[3].x == pytest.approx(25.06, abs=1e-9)


def test_from_below_the_clearance_height_it_rises_first():
    """Positioning logic: z 5 < Q260 20 -> Z20, then X Y, then the measuring position (south pole Q261 - R)."""
    run = probing(((10, 0, 0), (-1, 0, 0)), before="L Z+5 R0 FMAX\n", Q263=10, Q264=-4, Q261=-5, Q260=20)
    ends = run.toolpath.motion.end[1:4]
    assert ends[0, 2] == 20 and ends[1, 2] == 20 and tuple(ends[1, :2]) == (6, -4) and ends[2, 2] == -7


REFUSED = [
    (((40, 0, 0), (-1, 0, 0)), {}, "touch point inaccessible: the probe did not trigger within 10 mm"),
    (WALL, {"Q272": 4}, "TCH PROBE 419 Q272 (measuring axis) must be one of 1, 2, 3, got 4"),
    (WALL, {"Q305": 2, "Q303": -1}, "TCH PROBE 419 Q303 (measured value transfer) -1 does not say where row Q305 is"),
    (
        WALL,
        {"before": "CYCL DEF 7.0 D\nCYCL DEF 7.1 X+5\nL Z+100 FMAX\n"},
        "TCH PROBE 419 cannot run while a shift is active",
    ),
]


@pytest.mark.parametrize(("part", "changes", "message"), REFUSED, ids=[r[2][:30] for r in REFUSED])
def test_refused(part, changes, message):
    run = probing(part, **changes)
    assert message in run.alarms[0].message and run.alarms[0].span is not None
    assert not run.tables.presets.get(0)


def test_without_a_part_there_is_nothing_to_touch():
    text = "1 TOOL CALL 6 Z\n2 TCH PROBE 419 X\n" + "\n".join(f"{k}={v}" for k, v in VALUES.items()) + "\n"
    assert "there is no part to touch" in mnclab.run(text, "tnc-620").alarms[0].message

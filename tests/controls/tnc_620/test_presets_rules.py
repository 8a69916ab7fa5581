"""Presets (TNC 620, chapter 15): other spellings, units, defaults, tables, what stays of a preset, what is told of it."""

import numpy as np
import pytest
from controls.tnc_620.presetting import CASES, PRESET, example, part_of, probing
from tools.probed import gaps

import mnclab as mnc
from mnclab import Kind
from mnclab.workpiece.part import box, cylinder, hole

EXAMPLES = {case["code"]: case for case in reversed(CASES)}
NUMBERS = range(408, 420)


def words(number, **values):
    text = example(EXAMPLES[f"TCH PROBE {number}"], **values)
    return [line.split(";")[0].strip() for line in text.splitlines()[1:]]


def part(number):
    return part_of(EXAMPLES[f"TCH PROBE {number}"])


@pytest.mark.parametrize("number", NUMBERS)
def test_in_a_din_iso_program(number):
    """G408 to G419 make the same path and the same tables."""
    setup = mnc.Setup(
        tools={69: mnc.Tool(radius=2, kind="probe")}, presets={1: PRESET}, settings={"preset": 1},
        part=part(number).shifted(*PRESET), probe=mnc.Probe(clearance=2, reach=10),
    )  # fmt: skip
    cycle = " ".join(words(number))
    din = f"%P G71 *\nN10 T69 G17 *\nN20 G00 G40 G90 Z+100 *\nN30 G{number} {cycle} *\nN40 G00 X+0 Y+0 *\nN99999999 %P G71 *\n"
    first = mnc.run(din, "tnc-620", setup)
    second = probing(example(EXAMPLES[f"TCH PROBE {number}"]) + "\n9 L X+0 Y+0 R0 FMAX\n", part(number))
    assert first.ok and second.ok, first.alarms
    assert first.toolpath.end == pytest.approx(second.toolpath.end, abs=1e-9)
    assert first.tables.presets == second.tables.presets and first.measured == second.measured


@pytest.mark.parametrize("number", NUMBERS)
def test_with_defaults_of_global_def_120(number):
    """PREDEF instead of Q320, Q260 and Q301 is the values of GLOBAL DEF 120 at their places."""
    own = {"Q320": 1, "Q260": 33, "Q301": 1}
    text = example(EXAMPLES[f"TCH PROBE {number}"])
    lines = [line.split("=")[0] + "= PREDEF" if line.split("=")[0] in own else line for line in text.splitlines()]
    defaults = "GLOBAL DEF 120 PROBING\nQ320=+1\nQ260=+33\nQ301=+1\n"
    first = probing("TOOL CALL 69 Z\nL Z+100 R0 FMAX\n" + defaults + "\n".join(lines) + "\n", part(number))
    second = probing(example(EXAMPLES[f"TCH PROBE {number}"], **own) + "\n", part(number))
    assert first.ok and second.ok, first.alarms
    assert first.toolpath.end == pytest.approx(second.toolpath.end, abs=1e-12)
    assert first.toolpath.end[-1][2] == pytest.approx(33, abs=1e-12)


@pytest.mark.parametrize("number", [408, 410, 412, 414, 416, 417, 419])
def test_in_a_program_of_inches(number):
    """Lengths of the words are inches, and so are the results; the tables hold mm."""
    lengths = [line.partition("=") for line in words(number)]
    other = {"Q272", "Q301", "Q303", "Q304", "Q305", "Q381", "Q325", "Q247", "Q423", "Q365", "Q291", "Q292", "Q293", "Q267"}
    inches = [f"{name}={value if name in other else format(float(value) / 25.4, '+.9f')}" for name, _, value in lengths]
    text = f"0 BEGIN PGM P INCH\n1 TOOL CALL 69 Z\n2 L Z+4 R0 FMAX\n5 TCH PROBE {number} X\n" + "\n".join(inches) + "\n"
    first = probing(text.replace("1 TOOL CALL 69 Z", "1  TOOL CALL 69 Z"), part(number))
    second = probing(example(EXAMPLES[f"TCH PROBE {number}"]) + "\n", part(number))
    assert first.ok and second.ok, first.alarms
    for name in EXAMPLES[f"TCH PROBE {number}"]["check"].get("results", {}):
        assert first.variables[name] * 25.4 == pytest.approx(second.variables[name], abs=1e-6)
    for row, preset in second.tables.presets.items():
        assert np.array(first.tables.presets[row]) == pytest.approx(np.array(preset), abs=1e-6)
    assert first.measured == pytest.approx(second.measured, abs=1e-6)


def test_over_the_clearance_height_straight_or_on_an_arc():
    """Q301 = 1: between the touches the south pole goes over Z 20, with Q365 = 0 straight, with 1 on the starting circle."""
    for number in (412, 413):
        for way, kind in ((0, "RAPID"), (1, "ARC")):
            run = probing(example(EXAMPLES[f"TCH PROBE {number}"], Q301=1, Q365=way, Q381=0) + "\n", part(number))
            assert run.ok, run.alarms
            rows = run.toolpath.motion[1:]
            across = [row for row in rows if Kind(row.kind) != Kind.PROBE and np.abs(row.end[:2] - row.start[:2]).max() > 5][1:]
            assert len(across) == 3
            assert all(Kind(row.kind).name == kind and row.start[2] == row.end[2] == 20 for row in across)


@pytest.mark.parametrize("number", [410, 411, 414])
def test_over_the_clearance_height(number):
    """Straight from start to start, at Z 20."""
    run = probing(example(EXAMPLES[f"TCH PROBE {number}"], Q301=1, Q381=0) + "\n", part(number))
    assert run.ok, run.alarms
    assert gaps(run, part(number).shifted(*PRESET), 2)[1:].min() >= -1e-6
    rows = [row for row in run.toolpath.motion[1:] if Kind(row.kind) == Kind.RAPID and row.start[2] == 20 == row.end[2]]
    assert len(rows) == 3


def test_a_pocket_that_is_too_narrow_along_one_axis_begins_there_in_its_centre():
    """Half of 7 is less than SET_UP + R = 4: along Y from the centre, along X as ever, and never up, although Q301 = 1."""
    narrow = box((-60, -60, -30), (220, 220, 0)) - box((20, 46.5, -20), (80, 53.5, 9))
    text = example(EXAMPLES["TCH PROBE 410"], Q324=7, Q301=1, Q381=0) + "\n"
    run = probing(text, narrow)
    assert run.ok, run.alarms
    starts = np.subtract([touch.start for touch in run.touches], PRESET)
    assert starts == pytest.approx(np.array([(76, 50, -5), (50, 50, -5), (24, 50, -5), (50, 50, -5)]), abs=1e-9)
    assert [row.end[2] for row in run.toolpath.motion[2:-1]] == pytest.approx([-7] * (len(run.toolpath.motion) - 3))
    assert run.variables["Q155"] == pytest.approx(7, abs=1e-9)


def test_a_preset_that_is_stored_counts_after_cycle_247():
    """A corner with its basic rotation into row 7, then 247: the axes lie along the edges, the corner has (Q331, Q332)."""
    case = EXAMPLES["TCH PROBE 414"]
    text = example(case, Q304=1, Q331=10, Q332=-5, Q381=0)
    text += "\n7 CYCL DEF 247 PRESET\nQ339=+7\n8 L X+10 Y-5 R0 FMAX\n9 L X+30 FMAX\n"
    run = probing(text, part_of(case))
    assert run.ok, run.alarms
    ends = run.toolpath.end[-2:, :2]
    assert ends[0] == pytest.approx((95.2, 6.8), abs=1e-5)
    assert ends[1] - ends[0] == pytest.approx(20 * np.array([np.cos(np.radians(1.5)), np.sin(np.radians(1.5))]), abs=1e-9)


def test_after_one_preset_the_next_finds_nothing_left():
    """The second time with the same part the corner lies at 0 0 0, and its edge has no angle any more."""
    case = EXAMPLES["TCH PROBE 414"]
    first = example(case, Q304=1, Q305=0, Q381=0)
    again = dict(Q263=-58, Q264=0, Q296=0, Q297=18, Q305=0, Q381=0, Q304=1)
    run = probing(first + "\n" + example(case, **again) + "\n", part_of(case))
    assert run.ok, run.alarms
    assert run.variables["Q151"] == pytest.approx(0, abs=1e-9) and run.variables["Q152"] == pytest.approx(0, abs=1e-9)
    assert run.measurements[-1].what == "angle" and run.measurements[-1].actual == pytest.approx(0, abs=1e-9)
    assert run.tables.presets[0].rotation == pytest.approx(1.5, abs=1e-9)


def test_the_record_names_what_was_measured():
    run = probing(example(EXAMPLES["TCH PROBE 413"]) + "\n", part(413))
    rows = [(row.what, round(row.nominal, 6), round(row.actual, 6), row.touches) for row in run.measurements]
    all_ = (0, 1, 2, 3)
    assert rows == [("X", 50, 50.08, all_), ("Y", 50, 49.93, all_), ("diameter", 75, 74.96, all_), ("Z", 0, 0.03, (4,))]
    assert {row.cycle for row in run.measurements} == {"TCH PROBE 413"}


SHAPES = {408: 2, 409: 2, 410: 4, 411: 4, 412: 2, 413: 2, 414: 3, 415: 3, 416: 2, 418: 5}  # points; a circle is two halves


@pytest.mark.parametrize("number", SHAPES)
def test_a_picture_of_every_figure(number):
    """Nominal and found outline at the measuring height; the found one goes through all that was touched."""
    run = probing(example(EXAMPLES[f"TCH PROBE {number}"], Q381=0) + "\n", part(number))
    (figure,) = run.figures
    assert len(figure.nominal.points) == len(figure.actual.points) == SHAPES[number]
    assert figure.height == -5 and figure.cycle == f"TCH PROBE {number}"
    surfaces = np.array([run.touches[k].surface for k in figure.touches])
    if number < 416:
        near = figure.actual.distance(surfaces[:, :2] - np.array(PRESET[:2]))
        # a touch beside the middle is not along the normal; on a side turned by 1.5° the ball of 2 is 2 sin 1.5° beside it
        assert np.abs(near).max() < (0.0525 if number > 413 else 1e-4)


def test_a_probe_that_stands_beside_the_spindle_axis_measures_right():
    """The ball is 0.3 and -0.2 mm off the axis, as the table says: the same results, the axis beside the places."""
    text = example(EXAMPLES["TCH PROBE 412"]) + "\n9 L X+0 Y+0 R0 FMAX\n"
    run = probing(text, part(412), probe=mnc.Probe(clearance=2, reach=10, offset=(0.3, -0.2)))
    assert run.ok, run.alarms
    for name, value in EXAMPLES["TCH PROBE 412"]["check"]["results"].items():
        assert run.variables[name] == pytest.approx(value, abs=1e-5)
    first = next(row for row in run.toolpath.motion if Kind(row.kind) == Kind.PROBE)
    assert first.start == pytest.approx((83.5 - 0.3, 50 + 0.2, -7), abs=1e-9)


def test_a_ball_that_is_smaller_than_the_table_says():
    """True radius 1.9 of 2: the centre stays, the diameter is measured 0.2 too large from within, too small from outside."""
    true = {69: mnc.Tool(radius=1.9, kind="probe")}
    inside = probing(example(EXAMPLES["TCH PROBE 412"]) + "\n", part(412), true_tools=true)
    outside = probing(example(EXAMPLES["TCH PROBE 413"], Q381=0) + "\n", part(413), true_tools=true)
    assert inside.ok and outside.ok
    assert [inside.variables[q] for q in ("Q151", "Q152", "Q153")] == pytest.approx([50.08, 49.93, 75.25], abs=1e-9)
    assert [outside.variables[q] for q in ("Q151", "Q152", "Q153")] == pytest.approx([50.08, 49.93, 74.76], abs=1e-9)


def test_four_touches_of_an_oval_take_the_least_squares_of_squares():
    """Two bores 0.2 mm apart along X: the ball of radius r lies on the wall at both ends, and on the edge between the bores.

    Ball centres (a, 0), (0, b), (-a, 0), (0, -b): x² + y² = R² with the least squares has R² = (a² + b²) / 2.
    """
    oval = box((-60, -60, -30), (220, 220, 0)) - hole((50.1, 50, 0), 30, 20) - hole((49.9, 50, 0), 30, 20)
    run = probing(example(EXAMPLES["TCH PROBE 412"], Q262=30, Q247=90, Q325=0) + "\n", oval)
    assert run.ok, run.alarms
    a, b = 15 + 0.1 - 2, np.sqrt(15**2 - 0.1**2) - 2
    assert run.variables["Q153"] == pytest.approx(2 * (np.sqrt((a**2 + b**2) / 2) + 2), abs=1e-6)


def test_what_a_program_has_cut_is_measured():
    """A pocket is milled, then probed: its middle and sizes come back as programmed."""
    mill = """0 BEGIN PGM P MM
1 BLK FORM 0.1 Z X-20 Y-20 Z-30
2 BLK FORM 0.2 X+120 Y+80 Z+0
3 TOOL CALL 1 Z S3000 F500
4 CYCL DEF 252 CIRCULAR POCKET
Q215=0
Q223=40
Q368=0
Q207=500
Q351=1
Q201=-12
Q202=6
Q369=0
Q206=200
Q338=0
Q200=2
Q203=+0
Q204=50
Q370=1
Q366=1
Q385=500
Q439=0
5 L X+45 Y+35 R0 FMAX M3 M99
6 L Z+50 FMAX M5
7 TOOL CALL 69 Z
8 L Z+50 FMAX
"""
    probe = example(EXAMPLES["TCH PROBE 412"], Q262=40, Q321=45.2, Q322=34.9, Q305=0) + "\n"
    tools = {1: mnc.Tool(radius=5, kind="mill", plunge_angle=5), 69: mnc.Tool(radius=2, kind="probe")}
    run = mnc.run(mill + probe, "tnc-620", mnc.Setup(tools=tools, part="cut", probe=mnc.Probe(clearance=2, reach=10)))
    assert run.ok, run.alarms
    assert [run.variables[q] for q in ("Q151", "Q152", "Q153")] == pytest.approx([45, 35, 40], abs=2e-3)


def test_a_stud_is_not_crossed_between_its_touches():
    """Q301 = 0 around a stud that is as high as the clearance: the path stays outside it."""
    stud = cylinder((50, 50, -30), (50, 50, 15), 37.5)
    run = probing(example(EXAMPLES["TCH PROBE 413"], Q381=0) + "\n", stud)
    assert run.ok and gaps(run, stud.shifted(*PRESET), 2)[1:].min() >= -1e-6


def test_a_program_in_the_manner_of_a_post():
    """Top, then outside, then a bore: each preset counts at once (Q305 = 0), as posts for CAM write it.

    The part is a disc of 64 with a bore of 22, its axis at (0.4, -0.3) and its top at 0.25 in the preset of before. With Q320 = 8
    and SET_UP = 2 a touch begins 10 mm off, so that DIST has to be longer than that.
    """
    text = """0  BEGIN PGM RONDE_ANTASTEN MM
1  BLK FORM 0.1 Z  X-33  Y-33  Z-30
2  BLK FORM 0.2  X+33  Y+33  Z+0
3  ;-------------------------------------
4  ; T100 D=6 probe
5  ;-------------------------------------
6  * - Oberkante
7  M5
8  TOOL CALL 100 Z S50
9  L M140 MB MAX
10 L  X-24  Y+0 R0 FMAX
11 L  Z+60 R0 FMAX
12 CYCL DEF 32.0 TOLERANCE
13 CYCL DEF 32.1
14 TCH PROBE 417 DATUM IN TS AXIS ~
    Q263=-24   ;1ST POINT 1ST AXIS ~
    Q264=+0    ;1ST POINT 2ND AXIS ~
    Q294=+0    ;1ST POINT 3RD AXIS ~
    Q320=+8    ;SET-UP CLEARANCE ~
    Q260=+15   ;CLEARANCE HEIGHT ~
    Q305=+0    ;NUMBER IN TABLE ~
    Q333=+0    ;DATUM ~
    Q303=+1    ;MEAS. VALUE TRANSFER
15 L  Z+60 FMAX
16 * - Aussen
17 L  X+0  Y+0 R0 FMAX
18 TCH PROBE 413 DATUM OUTSIDE CIRCLE ~
    Q321=+0    ;CENTER IN 1ST AXIS ~
    Q322=+0    ;CENTER IN 2ND AXIS ~
    Q262=+64   ;NOMINAL DIAMETER ~
    Q325=+0    ;STARTING ANGLE ~
    Q247=+90   ;STEPPING ANGLE ~
    Q261=-5    ;MEASURING HEIGHT ~
    Q320=+8    ;SET-UP CLEARANCE ~
    Q260=+15   ;CLEARANCE HEIGHT ~
    Q301=+1    ;MOVE TO CLEARANCE ~
    Q305=+0    ;NUMBER IN TABLE ~
    Q331=+0    ;DATUM ~
    Q332=+0    ;DATUM ~
    Q303=+1    ;MEAS. VALUE TRANSFER ~
    Q381=+0    ;PROBE IN TS AXIS ~
    Q382=+0    ;1ST CO. FOR TS AXIS ~
    Q383=+0    ;2ND CO. FOR TS AXIS ~
    Q384=+0    ;3RD CO. FOR TS AXIS ~
    Q333=+0    ;DATUM ~
    Q423=+4    ;NO. OF MEAS. POINTS ~
    Q365=+1    ;TYPE OF TRAVERSE
19 L  Z+60 FMAX
20 CALL LBL 1
21 M5
22 L M140 MB MAX
23 M30
24 LBL 1
25 TCH PROBE 412 DATUM INSIDE CIRCLE ~
    Q321=+0 ~
    Q322=+0 ~
    Q262=+22 ~
    Q325=+0 ~
    Q247=+90 ~
    Q261=-5 ~
    Q320=+8 ~
    Q260=+15 ~
    Q301=+1 ~
    Q305=+0 ~
    Q331=+5 ~
    Q332=-5 ~
    Q303=+1 ~
    Q381=+0 ~
    Q382=+0 ~
    Q383=+0 ~
    Q384=+0 ~
    Q333=+0
26 L  X+5 Y-5 R0 FMAX
27 LBL 0
28 END PGM RONDE_ANTASTEN MM
"""
    disc = cylinder((0.4, -0.3, -30), (0.4, -0.3, 0.25), 32) - hole((0.4, -0.3, 0.25), 22, 25)
    run = mnc.run(text, "tnc-620", mnc.Setup(
        tools={100: mnc.Tool(radius=3, kind="probe")}, presets={1: PRESET}, settings={"preset": 1},
        part=disc.shifted(*PRESET), probe=mnc.Probe(clearance=2, reach=30),
    ))  # fmt: skip
    assert run.ok, run.alarms
    assert len(run.touches) == 9
    assert np.array(run.tables.presets[0][:3]) - PRESET == pytest.approx((0.4 - 5, -0.3 + 5, 0.25), abs=1e-6)
    found = [(row.what, round(row.actual, 6)) for row in run.measurements]
    assert found == [("Z", 0.25), ("X", 0.4), ("Y", -0.3), ("diameter", 64), ("X", 0), ("Y", 0), ("diameter", 22)]
    line = run.program.text.splitlines().index("26 L  X+5 Y-5 R0 FMAX") + 1
    assert run.at(line=line).position[:2] == pytest.approx((5, -5), abs=1e-9)
    starts = np.subtract([touch.start for touch in run.touches[5:]], PRESET)
    assert starts[:, :2] == pytest.approx(np.tile((0.4, -0.3), (4, 1)), abs=1e-6)  # 11 is less than 3 + 10: from the centre


@pytest.mark.parametrize("transfer", [-1, 0, 1])
def test_row_0_is_the_display_whatever_the_table(transfer):
    """Q305 = 0 (as in 15.14 with Q303 = 0): a copy of the active row, which becomes active; that one stays as it was."""
    run = probing(example(EXAMPLES["TCH PROBE 411"], Q303=transfer) + "\n9 L X+0 Y+0 R0 FMAX\n", part(411))
    assert run.ok, run.alarms
    assert run.tables.presets[0][:3] == pytest.approx((150.12, 249.91, -300), abs=1e-6)
    assert run.tables.presets[1][:3] == PRESET and not run.tables.datums
    assert run.toolpath.end[-1][:2] == pytest.approx((50.12, 49.91), abs=1e-6)

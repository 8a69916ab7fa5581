"""What inspection cycles say of a part (TNC 620, 16.1): status, tolerances, tools, the log; programs BEAMS and BSMEAS.

Rows of numbers, logs and programs are those of the catalogue; the probe is the one of its checks.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import mnclab as mnc
from mnclab import Kind, Probe, Setup, Tool, Wear, part

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-probing-inspection.json"
EXAMPLES = json.loads(FILE.read_text(encoding="utf-8"))
TOP = part.plane((0, 0, 0), (0, 0, 1))
PROBE = Tool(radius=2, length=50, kind="probe")
CLOCK = 1120114504.0  # 30 June 2005, 6:55:04


def example(code, number=0):
    return [each for each in EXAMPLES if each["code"] == code][number]


ROUND = {"Q273": 0, "Q274": 0, "Q262": 30, "Q325": 0, "Q247": 90, "Q261": -5, "Q320": 0, "Q260": 20, "Q301": 0}
BOX = {"Q273": 0, "Q274": 0, "Q282": 75, "Q283": 40, "Q261": -5, "Q320": 0, "Q260": 20, "Q301": 0}
NONE = {"Q279": 0, "Q280": 0, "Q281": 0, "Q309": 0, "Q330": 0}


def words(code, nominal, upper, lower):
    """A definition about (0, 0) with limits of a size."""
    if code in (421, 422):
        limits = {"Q275": upper, "Q276": lower} if code == 421 else {"Q277": upper, "Q278": lower}
        return {**ROUND, "Q262": nominal, **limits, **NONE}
    if code in (423, 424):
        return {**BOX, "Q282": nominal, "Q284": upper, "Q285": lower, "Q286": 0, "Q287": 0, **NONE}
    tail = {"Q311": nominal, "Q288": upper, "Q289": lower, "Q281": 0, "Q309": 0, "Q330": 0}
    if code == 425:
        return {"Q328": 0, "Q329": 0, "Q310": 0, "Q272": 1, "Q261": -5, "Q260": 20, **tail, "Q320": 0, "Q301": 0}
    if code == 426:
        ends = {"Q263": -nominal / 2, "Q264": 0, "Q265": nominal / 2, "Q266": 0}
        return {**ends, "Q272": 1, "Q261": -5, "Q320": 0, "Q260": 20, **tail}
    del tail["Q311"]
    return {"Q263": 0, "Q264": 0, "Q261": 5, "Q320": 0, "Q272": 3, "Q267": -1, "Q260": 20, **tail}


def figure(code, value, other=40.0):
    """A part about (0, 0) whose size is the value."""
    half = value / 2
    match code:
        case 421:
            return TOP - part.hole((0, 0, 0), value, 50)
        case 422:
            return part.cylinder((0, 0, -50), (0, 0, 0), half)
        case 423:
            return TOP - part.pocket((0, 0, 0), value, other, 50)
        case 424:
            return part.box((-half, -other / 2, -50), (half, other / 2, 0))
        case 425:
            return TOP - part.pocket((0, 0, 0), value, 500, 50)
        case 426:
            return part.box((-half, -100, -50), (half, 100, 0))
    return part.plane((0, 0, value), (0, 0, 1))


def probing(code, given, made, before="", after="", tools=None, unit="MM", **setup):
    lines = "\n".join(f"{name}={value if isinstance(value, str) else f'{value:+.12g}'}" for name, value in given.items())
    text = f"BEGIN PGM CHECK1 {unit}\nTOOL CALL 99 Z\n{before}L Z+60 R0 FMAX\nTCH PROBE {code} X\n{lines}\n9 {after}\n"
    kept = {"tools": {99: PROBE} | (tools or {}), "part": made, "probe": Probe(clearance=2, reach=30), "start": (0, -200, 150)}
    return mnc.run(f"{text}END PGM CHECK1 {unit}\n", "tnc-620", Setup(**(kept | setup)))


def status(run):
    return [run.variables[q] for q in ("Q180", "Q181", "Q182")]


@pytest.mark.parametrize("row", example("result classification")["check"]["rows"], ids=str)
def test_classification(row):
    code, upper, lower, value, *expected = row
    nominal = (upper + lower) / 2 or 79.5
    run = probing(code, words(code, nominal, upper, lower), figure(code, value))
    assert run.ok, run.alarms
    assert status(run) == expected
    verdict = ["ok", "rework", "scrap"][expected.index(1)] if upper or lower else ""
    what = {421: "diameter", 422: "diameter", 423: "length", 424: "length", 427: "Z"}.get(code, "width")
    assert [row.verdict for row in run.measurements.of(what)] == [verdict]
    assert run.measured[what] == pytest.approx(value, abs=1e-6)


@pytest.mark.parametrize(("off", "tolerance", "expected"), [
    ((0.05, 0), (0.1, 0.1), [1, 0, 0]), ((0.11, 0), (0.1, 0.1), [0, 0, 1]), ((0, -0.11), (0.1, 0.1), [0, 0, 1]),
    ((0.5, 0.11), (0, 0.2), [1, 0, 0]), ((0.5, 0.5), (0, 0), [1, 0, 0]), ((0.1, 0), (0.1, 0), [1, 0, 0]),
])  # fmt: skip
def test_a_wrong_place_is_scrap(off, tolerance, expected):
    """A tolerance of 0 watches nothing; on its limit it is within."""
    given = words(421, 30, 0, 0) | {"Q279": tolerance[0], "Q280": tolerance[1]}
    run = probing(421, given, figure(421, 30).shifted(*off))
    assert run.ok and status(run) == expected


def test_scrap_comes_before_rework():
    """Too small a hole at a wrong place: one of the markers is 1."""
    run = probing(421, words(421, 30, 30.1, 30) | {"Q279": 0.1}, figure(421, 29.9).shifted(0.5))
    assert status(run) == [0, 0, 1]
    assert [row.verdict for row in run.measurements] == ["scrap", "", "rework"]


@pytest.mark.parametrize("code", [420, 431])
def test_some_cycles_leave_the_status(code):
    two = {"Q263": -10, "Q264": 0, "Q265": 10, "Q266": 0, "Q320": 0, "Q260": 20, "Q281": 1}
    given = {
        420: {**two, "Q272": 3, "Q267": -1, "Q261": 0, "Q301": 0},
        431: {**two, "Q294": 0, "Q295": 0, "Q296": 0, "Q297": 9, "Q298": 0},
    }[code]
    run = probing(code, given, TOP, before="FN 0: Q180 = +7\n")
    assert run.ok and run.variables["Q180"] == 7 and f"TCHPR{code}.TXT" in run.files


# --- tolerance and tool monitoring -----------------------------------------------------------------------------------


def test_a_tolerance_that_stops_the_program():
    """Everything is written before the alarm, which names what is out of tolerance; the next block is not obeyed."""
    given = words(421, 30, 30.02, 29.98) | {"Q279": 0.1, "Q309": 1, "Q281": 1, "Q330": 5}
    run = probing(421, given, figure(421, 30.1).shifted(0.2), after="L X+77 FMAX", tools={5: Tool(radius=6, dr=0.01)})
    (alarm,) = run.alarms
    assert alarm.message == (
        "TCH PROBE 421: tolerance exceeded: X 0.2000, allowed from -0.1000 to 0.1000; "
        "diameter 30.1000, allowed from 29.9800 to 30.0200"
    )
    assert alarm.span.line == 4 and status(run) == [0, 0, 1]
    assert "Diameter: 30.1000" in run.files["TCHPR421.TXT"]
    assert run.tables.tools[5].dr == pytest.approx(0.06, abs=1e-9)
    assert run.toolpath.end[-1][2] == 20 and not (run.toolpath.end[:, 0] == 77).any()


def test_without_a_stop_the_program_goes_on():
    run = probing(421, words(421, 30, 30.02, 29.98), figure(421, 30.1), after="L X+77 FMAX")
    assert run.ok and run.toolpath.end[-1][0] == 77


CHANGES = example("tool monitoring")["check"]


@pytest.mark.parametrize("row", CHANGES["rows"], ids=str)
@pytest.mark.parametrize("name", [5, '"MILL 12"'])
def test_the_tool_is_compensated(row, name):
    """By number or name; what is measured again is added to what is there."""
    code, deviation, change = row
    tools = {5: Tool(radius=6, dr=0.1, name="Mill 12")}
    run = probing(code, words(code, 40, 0, 0) | {"Q330": name}, figure(code, 40 + deviation), tools=tools)
    assert run.ok, run.alarms
    assert run.tables.tools[5].dr == pytest.approx(0.1 + change, abs=1e-9)
    assert run.setup.tools[5].dr == 0.1


@pytest.mark.parametrize("row", CHANGES["rows_423_424"]["rows"], ids=str)
def test_the_tool_of_a_rectangle(row):
    code, first, second, change = row
    made = figure(code, 75 + first, 40 + second)
    run = probing(code, words(code, 75, 0, 0) | {"Q330": 5}, made, tools={5: Tool(radius=6)})
    assert run.ok and run.tables.tools[5].dr == pytest.approx(change, abs=1e-9)


@pytest.mark.parametrize("row", CHANGES["rows_427"]["rows"], ids=str)
def test_the_tool_of_a_coordinate(row):
    axis, sense, upper, lower, value, radius, length = row
    made = part.plane((0, 0, value), (0, 0, 1)) if axis == 3 else part.plane((value, 0, 0), (-sense, 0, 0))
    place = {"Q263": 0, "Q261": 5} if axis == 3 else {"Q263": 50, "Q261": -5}
    given = words(427, 0, upper, lower) | place | {"Q272": axis, "Q267": sense, "Q330": 5}
    begin = (value - sense * 60, 0, 150)
    run = probing(427, given, made, tools={5: Tool(radius=6)}, start=begin)
    assert run.ok, run.alarms
    assert (run.tables.tools[5].dr, run.tables.tools[5].dl) == pytest.approx((radius, length), abs=1e-9)


@pytest.mark.parametrize("row", CHANGES["rows_breakage"]["rows"], ids=str)
def test_a_broken_tool(row):
    """Locked and not compensated; the results, the status and the log are written."""
    code, deviation, limit, broken = row
    tools = {5: Tool(radius=6, wear=Wear(break_radius=limit))}
    if code == 430:
        made, given = TOP, {**BOX, "Q262": 80, "Q291": 0, "Q292": 90, "Q293": 180, **NONE, "Q288": 0, "Q289": 0}
        given = {name: value for name, value in given.items() if name not in ("Q282", "Q283", "Q320", "Q301")}
        for x, y in ((1, 0), (0, 1), (-1, 0)):
            made = made - part.hole(((40 + deviation / 2) * x, (40 + deviation / 2) * y, 0), 12, 50)
    else:
        made, given = figure(code, 40 + deviation), words(code, 40, 0, 0)
    run = probing(code, given | {"Q330": 5, "Q281": 1}, made, tools=tools)
    assert run.tables.tools[5].locked is broken and f"TCHPR{code}.TXT" in run.files and "Q180" in dict(run.variables)
    if broken:
        (alarm,) = run.alarms
        assert alarm.message == (
            f"TCH PROBE {code}: tool 5 is broken: a deviation of {abs(deviation):.4f} is more than its RBREAK {limit:g}"
        )
        assert run.tables.tools[5].dr == 0
    else:
        assert run.ok, run.alarms


def test_a_coordinate_without_limits_monitors_no_tool():
    tools = {5: Tool(radius=6, wear=Wear(break_radius=0.1))}
    run = probing(427, words(427, 0, 0, 0) | {"Q330": 5}, figure(427, 5.5), tools=tools)
    assert run.ok and run.tables.tools[5] == Tool(radius=6, number=5, wear=Wear(break_radius=0.1))


@pytest.mark.parametrize(("name", "said"), [
    (7, "names tool 7, which has no row in the tool table"), ('"NO SUCH"', 'names tool "NO SUCH", which has no row'),
    ('"SEVENTEEN LETTERS"', "must have at most 16 characters, got 17"), (32768, "must be at least 0 and at most 32767.9"),
    (-1, "must be at least 0"),
])  # fmt: skip
def test_a_tool_that_is_not_there(name, said):
    run = probing(421, words(421, 30, 0, 0) | {"Q330": name}, figure(421, 30), tools={5: Tool(radius=6)})
    (alarm,) = run.alarms
    assert alarm.message.startswith("TCH PROBE 421 Q330 (tool that is monitored, number or name)") and said in alarm.message
    assert alarm.span.line == 4 + 1 + len(words(421, 30, 0, 0)) - 1


# --- the log ---------------------------------------------------------------------------------------------------------


def same_log(found, printed, program):
    """The same lines; heading and path of the program apart, of which the number and the name count."""
    ours, theirs = found.strip().splitlines(), printed.strip().splitlines()
    assert len(ours) == len(theirs)
    for k, (mine, other) in enumerate(zip(ours, theirs, strict=True)):
        if k == 0:
            assert re.findall(r"\d+", mine) == re.findall(r"\d+", other) and mine.startswith("Measuring log for Probing Cycle 42")
        elif other.startswith("Measuring program"):
            assert mine == f"Measuring program: {program}"
        elif "<" not in other:
            assert mine.lower() == other.lower()


def test_the_log_of_the_manual():
    """Seed lines 10823 to 10871, in the English of the control; the numbers are those that are printed."""
    printed = example("measuring log")
    given = {**ROUND, "Q273": 50, "Q274": 65, "Q262": 12, "Q275": 12.045, "Q276": 12, **NONE, "Q279": 0.1, "Q280": 0.1, "Q281": 1}
    made = TOP - part.hole((50.081, 64.953, 0), 12.0259, 50)
    run = probing(421, given, made, settings={"clock": CLOCK}, start=(50, 65, 150))
    assert run.ok, run.alarms
    for name, value in printed["check"]["results"].items():
        assert run.variables[name] == pytest.approx(value, abs=1e-9)
    assert list(run.files) == ["TCHPR421.TXT"]
    same_log(run.files["TCHPR421.TXT"], LOG_421, "program")


LOG_421 = """Measuring log for Probing Cycle 421 Hole Measuring
Date: 30-06-2005
Time: 6:55:04
Measuring program: CHECK1.H
Nominal values:
Center in reference axis: 50.0000
Center in minor axis: 65.0000
Diameter: 12.0000
Given limit values:
Maximum limit for center in reference axis: 50.1000
Minimum limit for center in reference axis: 49.9000
Maximum limit for center in minor axis: 65.1000
Minimum limit for center in minor axis: 64.9000
Maximum dimension for hole: 12.0450
Minimum dimension for hole: 12.0000
Actual values:
Center in reference axis: 50.0810
Center in minor axis: 64.9530
Diameter: 12.0259
Deviations:
Center in reference axis: 0.0810
Center in minor axis: -0.0470
Diameter: 0.0259
Further measuring results: Measuring height: -5.0000
End of measuring log
"""


def test_a_log_without_a_clock_says_so():
    run = probing(421, words(421, 30, 0, 0) | {"Q281": 1}, figure(421, 30))
    assert "Date: not known" in run.files["TCHPR421.TXT"] and "Given limit values:" in run.files["TCHPR421.TXT"]


def test_a_log_on_the_screen_waits_for_the_operator():
    run = probing(421, words(421, 30, 0, 0) | {"Q281": 2}, figure(421, 30), after="L X+77 FMAX")
    assert run.ok and list(run.files) == ["SCREEN:"] and run.files["SCREEN:"].startswith("Measuring log for Probing Cycle 421")
    assert [row.kind for row in run.toolpath].count(Kind.STOP) == 1 and run.toolpath.end[-1][0] == 77


def test_the_same_cycle_overwrites_its_log():
    given = words(427, 0, 0, 0) | {"Q281": 1}
    lines = "\n".join(f"{name}={value:+g}" for name, value in (given | {"Q263": 40}).items())
    run = probing(427, given, part.plane((0, 0, 5), (-0.01, 0, 1)), after=f"TCH PROBE 427 X\n{lines}\n10 L Z+70 FMAX")
    assert run.ok, run.alarms
    assert run.files["TCHPR427.TXT"].count("Actual values") == 1
    assert f"{run.variables['Q160']:.4f}" in run.files["TCHPR427.TXT"]


def test_inches():
    """A hole of 2 inches: results and log are in inches."""
    given = {**ROUND, "Q262": 2, "Q261": -0.2, "Q260": 0.8, "Q275": 2.01, "Q276": 1.99, **NONE, "Q279": 0.01, "Q281": 1}
    run = probing(421, given, figure(421, 50.927).shifted(0.127), unit="INCH")
    assert run.ok, run.alarms
    assert [run.variables[q] for q in ("Q151", "Q152", "Q153", "Q161", "Q163")] == pytest.approx([0.005, 0, 2.005, 0.005, 0.005])
    text = run.files["TCHPR421.TXT"]
    assert "Diameter: 2.0050" in text and "Maximum dimension for hole: 2.0100" in text and "Measuring height: -0.2000" in text
    assert run.measured["diameter"] == pytest.approx(50.927)


# --- programs --------------------------------------------------------------------------------------------------------


def test_program_bsmeas():
    """A pocket 90.04 x 70.05 at (50.03, 39.98)."""
    case = example("program BSMEAS")
    made = TOP - part.pocket((50.03, 39.98, 0), 90.04, 70.05, 50)
    setup = Setup(tools={1: PROBE}, part=made, probe=Probe(clearance=2, reach=10), start=(50, 40, 200), settings={"clock": CLOCK})
    run = mnc.run(case["program"], "tnc-620", setup)
    assert run.ok, run.alarms
    for name, value in case["check"]["results"].items():
        assert run.variables[name] == pytest.approx(value, abs=1e-6)
    same_log(run.files["TCHPR423.TXT"], case["check"]["log_english"], "program")


def test_program_beams():
    """Roughed 81.04 x 61.06 where 81 x 61 was programmed: the second pass is 1.04 and 1.06 smaller than the first one.

    The stud is milled from Z10 to Z0 and touched at Z-5: its sides go on below.
    """
    case = example("program BEAMS")
    made = part.box((50 - 40.52, 50 - 30.53, -50), (50 + 40.52, 50 + 30.53, 10))
    tools = {69: Tool(radius=5, length=60), 1: Tool(radius=5, length=60), 99: PROBE}
    setup = Setup(tools=tools, part=made, probe=Probe(clearance=2, reach=10), start=(0, 0, 200))
    run = mnc.run(case["program"], "tnc-620", setup)
    assert not [a for a in run.alarms if a.severity == "alarm"], run.alarms
    for name, value in case["check"]["results"].items():
        assert run.variables[name] == pytest.approx(value, abs=1e-6)
    assert (run.variables["Q1"], run.variables["Q2"]) == pytest.approx((79.96, 59.94), abs=1e-6)
    touches = [row for row in run.toolpath if row.kind == Kind.PROBE]
    expected = [(*touch["ball_center"][:2], -7) for touch in case["check"]["touches"]]
    for row, place in zip(touches, expected, strict=True):
        assert tuple(row.end) == pytest.approx(place, abs=1e-6)

"""SEL CONTOUR, DECLARE CONTOUR, formulas of QC and CONTOUR DEF (chapter 10): the examples of the catalogue and their numbers."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from shapely import LineString, Point, Polygon, unary_union

import mnclab
from mnclab import Setup, Tool
from mnclab.controls.tnc_620.state import memory
from mnclab.machining.milling.terraces import parts, terraces
from mnclab.running.interpreter import Interpreter

FOLDER = Path(__file__).parents[2] / "authorities" / "catalogue"
TOOLS = {1: Tool(radius=6, plunge_angle=90), 2: Tool(radius=4, plunge_angle=90)}


def examples(file: str, code: str) -> list[str]:
    entries = json.loads((FOLDER / f"{file}.json").read_text(encoding="utf-8"))
    found = [entry["program"] for entry in entries if entry["code"] == code]
    assert found
    return found


def programs(text: str) -> dict[str, str]:
    """The programs of a text by the names of their files."""
    return {f"{name}.H": body for body, name in re.findall(r"(\d* ?BEGIN PGM (\w+) MM.*?END PGM \w+ MM\n?)", text, re.DOTALL)}


CIRCLES, DEFINITIONS, WHOLE = examples("tnc620-contour-formula", "overlapping contours with contour formula")
POCKETS = programs(CIRCLES)


def program(name: str, *lines: str) -> str:
    return "\n".join((f"BEGIN PGM {name} MM", *lines, f"END PGM {name} MM", ""))


def box(name: str, x: float, y: float, width: float, height: float) -> str:
    return program(name, f"L X{x:+g} Y{y:+g}", f"L IX{width:+g}", f"L IY{height:+g}", f"L IX{-width:+g}", f"L IY{-height:+g}")


def after(text: str, files: dict[str, str]):
    """The machine after a main program, and the program as it ran."""
    control = mnclab.controls["tnc-620"]
    interpreter = Interpreter(control, Setup(files=files, tools=TOOLS), mnclab.read(text, "tnc-620"))
    interpreter.run()
    assert not interpreter.alarms
    return interpreter.machine


def areas(main: str, files: dict[str, str], whole: float = 20.0) -> list[tuple[float, float, float]]:
    """Top, bottom and area of the terraces of the contour that a program selects."""
    contour = memory(after(program("MAIN", main), files)).contour
    return [(t.top, t.bottom, t.region.area) for t in terraces(contour, whole)]


def defined(*lines: str, **files: str) -> list[tuple[float, float, float]]:
    return areas('SEL CONTOUR "MODEL"', {"MODEL.H": program("MODEL", *lines)} | {f"{k}.H": v for k, v in files.items()})


# --- sets of the circles A and B -------------------------------------------------------------------------------------

COMMON = 1250 * math.acos(0.6) - 600
DISC = 625 * math.pi
#: [text and derived]: inclusion, exclusion, intersection in the order of the manual; then the symmetric difference.
SETS = {
    "|": (2 * DISC - COMMON, 221.430), "\\": (DISC - COMMON, 157.080), "&": (COMMON, 92.730),
    "^": (2 * DISC - 2 * COMMON, 2 * 157.080),
}  # fmt: skip


@pytest.mark.parametrize("operator", SETS)
def test_areas_of_two_circles(operator: str) -> None:
    ours = [part for part in DEFINITIONS.split("\n\n") if f" {operator} " in part]
    ours += [text for text in examples("tnc620-contour-formula", "QC contour formula") if f" {operator} " in text]
    machine = after('SEL CONTOUR "MODEL"\n', POCKETS | {"MODEL.H": program("MODEL", ours[0])})
    (terrace,) = terraces(memory(machine).contour, 20)
    area, length = SETS[operator]
    assert terrace.region.area == pytest.approx(area, abs=1e-6)
    assert sum(loop.length for loop in terrace.region.loops) == pytest.approx(length, abs=2e-3)
    assert len(terrace.region.parts) == (2 if operator == "^" else 1)


def test_the_sign_of_later_versions() -> None:
    ours = 'DECLARE CONTOUR QC1 = "POCKET_A"', 'DECLARE CONTOUR QC2 = "POCKET_B.H"', "QC10 = QC1 |+| QC2"
    ((_, _, area),) = areas('SEL CONTOUR "MODEL"', POCKETS | {"MODEL.H": program("MODEL", *ours)})
    assert area == pytest.approx(2 * DISC - 2 * COMMON, abs=1e-6)


def test_brackets_and_order() -> None:
    """One rank from left to right; three squares of 10, each 5 farther: 50 of each are in common with the next one."""
    declared = tuple(f'DECLARE CONTOUR QC{k} = "S{k}"' for k in (1, 2, 3))
    files = {f"S{k}": box(f"S{k}", 5 * k, 0, 10, 10) for k in (1, 2, 3)}
    for formula, area in {
        "QC1 | QC2 \\ QC3": 150 - 50, "QC1 | ( QC2 \\ QC3 )": 100, "QC1 \\ ( QC2 \\ QC3 )": 50,
        "((QC1)|(QC2))&QC3": 50, "QC1 ^ QC2 ^ QC3": 100, "QC 1 & QC2 | QC3": 50 + 100,
    }.items():  # fmt: skip
        ((_, _, found),) = defined(*declared, f"QC10 = {formula}", **files)
        assert found == pytest.approx(area), formula


def test_hundreds_of_brackets() -> None:
    ((_, _, area),) = defined('DECLARE CONTOUR QC1 = "S"', f"QC10 = {'(' * 450} QC1 {')' * 450}", S=box("S", 0, 0, 10, 10))
    assert area == pytest.approx(100)


def test_results_are_used_again() -> None:
    files = {f"S{k}": box(f"S{k}", 20 * k, 0, 10, 10) for k in (1, 2, 3)}
    declared = tuple(f'DECLARE CONTOUR QC{k} = "S{k}"' for k in (1, 2, 3))
    ((_, _, area),) = defined(*declared, "QC10 = QC1 | QC2", "QC10 = QC10 | QC3", "QC11 = QC10 \\ QC2", **files)
    assert area == pytest.approx(200)


# --- roughing with a formula (10.1) -----------------------------------------------------------------------------------

FILES = programs(WHOLE)
ROUGH = FILES["CONTOUR.H"].partition("9 TOOL CALL 2")[0].replace("Q19=150", "Q19=0") + "14 L Z+250 R0 FMAX M2\n"


def drawn() -> Polygon:
    """The complete contour, as fine polygons from its numbers."""
    circles = [Point(x, 50).buffer(25, 512) for x in (65, 35)]
    islands = [Polygon([(73, 42), (65, 58), (58, 42)]), Polygon([(27, 58), (43, 58), (43, 42), (27, 42)])]
    return unary_union(circles) - unary_union(islands)


def test_the_contour_of_the_example() -> None:
    (terrace,) = terraces(memory(after('SEL CONTOUR "MODEL"\n', FILES)).contour, 20)
    assert terrace.region.area == pytest.approx(3367.872 - 120 - 256, abs=1e-3)
    assert [loop.area > 0 for loop in terrace.region.loops] == [True, False, False]
    assert terrace.bottom * terrace.region.area == pytest.approx(59837.4, abs=0.1)
    corners = terrace.region.loops[0].points
    for corner in ((50, 70), (50, 30)):
        assert np.hypot(*(corners - corner).T).min() < 1e-6
    klartext = examples("tnc620-klartext", "contour formula")[0]
    (same,) = terraces(memory(after('SEL CONTOUR "MODEL"\n', FILES | {"MODEL.H": klartext})).contour, 20)
    assert same.region.area == pytest.approx(terrace.region.area)


def test_the_example_is_roughed() -> None:
    """Its levels, nothing of its walls cut, and what a tool of radius 6 reaches with 0.5 left is covered: 676.55 + sweep."""
    run = mnclab.run(ROUGH, "tnc-620", Setup(tools=TOOLS, files=FILES))
    assert run.ok and not run.alarms, run.alarms
    assert {name: run.variables[name] for name in ("Q1", "Q2", "Q3")} == {"Q1": -20, "Q2": 1, "Q3": 0.5}
    path = run.toolpath
    cut = path[path.feed == 350]
    assert sorted({round(float(z), 9) for z in cut.end[:, 2] if z < 0}) == [-19.5, -15, -10, -5]
    middle = drawn().buffer(-6.5, 128)
    assert middle.area == pytest.approx(676.55, abs=0.02)
    for depth in (-5, -19.5):
        level = cut[(abs(cut.end[:, 2] - depth) < 1e-9) & (abs(cut.start[:, 2] - depth) < 1e-9)]
        swept = unary_union([LineString(row.points(1e-4)[0][:, :2]).buffer(6, 64) for row in rows(level)])
        assert swept.difference(drawn().buffer(-0.5 + 2e-3, 128)).area < 1e-2
        assert middle.buffer(6, 128).difference(swept).area < 1e-3 * middle.area


def rows(path):
    return [path[k : k + 1] for k in range(len(path))]


# --- depths of their own ----------------------------------------------------------------------------------------------

def test_the_skeleton_with_depths() -> None:
    """10.1: ( QC1 | QC3 | QC4 ) \\ QC2 with depths 15, 10 and 5; squares stand for what is not printed."""
    skeleton = programs(examples("tnc620-contour-formula", "complex contour formula")[1])
    files = {
        "MODEL.H": skeleton["MODEL.H"], "CIRCLE1.H": skeleton["CIRCLE1.H"], "CIRCLEXY.H": box("CIRCLEXY", 70, 45, 10, 10),
        "TRIANGLE.H": program("TRIANGLE", "L X+200 Y+0", "L X+220", "L X+200 Y+20"), "SQUARE.H": box("SQUARE", 300, 0, 10, 10),
    }  # fmt: skip
    found = areas('SEL CONTOUR "MODEL"', files)
    disc = 45**2 * math.pi
    for (top, bottom, area), expected in zip(
        found, [(0, 5, disc + 200 + 100), (5, 10, disc + 200), (10, 15, disc), (15, 20, disc - 100)], strict=True
    ):
        assert (top, bottom) == expected[:2] and area == pytest.approx(expected[2], abs=1e-3)
    run = mnclab.run(program("MAIN", 'SEL CONTOUR "MODEL"'), "tnc-620", Setup(files=files))
    assert [(a.severity, a.message.partition(",")[0], a.span.line) for a in run.alarms] == [
        ("warning", "QC1 has no DEPTH", 2),
    ]  # fmt: skip


def test_depth_in_inches_and_in_a_parameter() -> None:
    inches = 'BEGIN PGM MODEL INCH\nQ5 = 0.5\nDECLARE CONTOUR QC1 = "S" DEPTHQ5\nQC10 = QC1\nEND PGM MODEL INCH\n'
    assert areas('SEL CONTOUR "MODEL"', {"MODEL.H": inches, "S.H": box("S", 0, 0, 10, 10)}) == [
        (0, pytest.approx(12.7), pytest.approx(100))
    ]


def test_the_depth_model_of_contour_def() -> None:
    """10.2 [derived]: 10000 mm² down to 5, 8400 down to 20."""
    files = {
        "SQ100.H": box("SQ100", 0, 0, 100, 100), "SQ40.H": box("SQ40", 10, 10, 40, 40), "SQ10.H": box("SQ10", 80, 80, 10, 10),
    }  # fmt: skip
    line = examples("tnc620-contour-formula", "CONTOUR DEF")[1].splitlines()[0]
    found = areas(line, files)
    assert [(top, bottom, round(area, 6)) for top, bottom, area in found] == [(0, 5, 10000), (5, 20, 8400)]
    assert sum((bottom - top) * area for top, bottom, area in found) == pytest.approx(176000)


def test_contour_def_as_printed() -> None:
    """Over three lines, once without =: a pocket and two islands whose tops lie at 5 and 7.5."""
    files = {f"{name}.H": box(name, k, k, 10 - 3 * k, 2) for k, name in enumerate(("POCK1", "ISLE2", "ISLE3"))}
    files["POCK1.H"] = box("POCK1", 0, 0, 20, 20)
    printed = examples("tnc620-klartext", "CONTOUR DEF")[0]
    contour = memory(after(program("MAIN", printed), files)).contour
    assert contour.operator == "\\" and [(part.depth, round(part.region.area, 6)) for part in parts(contour)] == [
        (0, 400), (5, 14), (7.5, 8),
    ]  # fmt: skip
    assert [t.bottom for t in terraces(contour, 20)] == [5, 7.5, 20]


def test_islands_are_taken_away_last() -> None:
    """A pocket that is listed after an island does not cut it away."""
    files = {"A.H": box("A", 0, 0, 50, 50), "B.H": box("B", 10, 10, 10, 10)}
    ((_, _, area),) = areas('CONTOUR DEF P1 = "A" I2 = "B" P3 = "B"', files)
    assert area == pytest.approx(2400)


def test_a_level_on_each_floor_of_the_terraces() -> None:
    """Roughed with infeeds of 6: the island's top at 5 is a floor of its own, over it the tool passes above and not below."""
    files = {"A.H": box("A", 0, 0, 80, 80), "B.H": box("B", 30, 30, 20, 20)}
    text = ROUGH.replace('SEL CONTOUR "MODEL"', 'CONTOUR DEF P1 = "A" I2 = "B" DEPTH5').replace("Q10=5", "Q10=6")
    run = mnclab.run(text.replace("Q3=+0.5", "Q3=0").replace("Q4=+0.5", "Q4=0"), "tnc-620", Setup(tools=TOOLS, files=files))
    assert run.ok and not run.alarms, run.alarms
    cut = run.toolpath[run.toolpath.feed == 350]
    for depth, covered in ((-5, True), (-6, False), (-12, False), (-18, False), (-20, False)):
        level = cut[(abs(cut.end[:, 2] - depth) < 1e-9) & (abs(cut.start[:, 2] - depth) < 1e-9)]
        assert len(level)
        swept = unary_union([LineString(row.points(1e-4)[0][:, :2]).buffer(6, 64) for row in rows(level)])
        island = Polygon([(30, 30), (50, 30), (50, 50), (30, 50)])
        assert swept.intersection(island).area == pytest.approx(400 if covered else 0, abs=1e-3)


# --- what describes a contour ------------------------------------------------------------------------------------------

def one(*lines: str, main: str = 'CONTOUR DEF P1 = "A"', **files: str):
    """The area of one part, and the alarms of the run."""
    every = {"A.H": program("A", *lines)} | {f"{name}.H": text for name, text in files.items()}
    run = mnclab.run(program("MAIN", main), "tnc-620", Setup(files=every, tools=TOOLS))
    assert run.ok, run.alarms
    assert not run.toolpath.is_motion.any()
    ((_, _, area),) = areas(main, every)
    return area, list(run.alarms)


def test_feeds_m_functions_and_heights_say_nothing() -> None:
    lines = (
        "L Z+50 FMAX M3", "L X+0 Y+0 Z-5 F0 M8", "L X+40 FMAX M97", "L Z-20 FAUTO M91", "L Y+30 M30", "L X+0 M140 MB MAX",
        "L Y+0 Z+9",
    )  # fmt: skip
    area, alarms = one(*lines)
    assert area == pytest.approx(1200) and not alarms


def test_an_open_contour_is_closed_by_a_line() -> None:
    assert one("L X+0 Y+0", "L X+40", "L Y+30")[0] == pytest.approx(600)


def test_either_way_round_and_a_side_says_nothing() -> None:
    area, alarms = one("L X+0 Y+0 RL", "L Y+30", "L X+40", "L Y+0")
    assert area == pytest.approx(1200)
    assert [(a.severity, a.message) for a in alarms] == [
        ("warning", "RL and RR say nothing in the contour of A: the formula makes it a pocket or an island")
    ]
    assert alarms[0].span[:2] == (3, 1) and alarms[0].span.program == 1


def test_roundings_chamfers_polar_blocks_and_free_contours() -> None:
    """40 x 30 with a rounding of 5, a chamfer of 4, and a corner found by FL."""
    area, _ = one("L X+0 Y+0", "L X+40", "RND R5", "L Y+30", "CHF 4", "FL AN180 X+0", "FL AN-90 Y+0", "L Y+0")
    assert area == pytest.approx(1200 - (25 - 25 * math.pi / 4) - 8, abs=1e-6)
    assert one("CC X+5 Y+5", "LP PR+10 PA+90", "CP IPA-360 DR-")[0] == pytest.approx(100 * math.pi)


def test_transformations_act_in_the_following_programs_and_end_with_them() -> None:
    """A shift by 100 in the first description counts for the second; the program that calls goes on without it."""
    shifted = program("A", "CYCL DEF 7.0 D", "CYCL DEF 7.1 X+100", "L X+0 Y+0", "L X+10", "L Y+10", "L X+0")
    files = {"A.H": shifted, "B.H": box("B", 0, 50, 10, 10)}
    for main in ('CONTOUR DEF P1 = "A" P2 = "B"', 'SEL CONTOUR "MODEL"'):
        model = program("MODEL", 'DECLARE CONTOUR QC1 = "A"', 'DECLARE CONTOUR QC2 = "B"', "QC3 = QC1 | QC2")
        machine = after(program("MAIN", main, "L X+1 Y+2 R0 FMAX"), files | {"MODEL.H": model})
        (terrace,) = terraces(memory(machine).contour, 5)
        assert terrace.region.bounds == pytest.approx(np.array([[100, 0], [110, 60]]))
        assert machine.tip[:2] == (1, 2)


def test_a_contour_is_told_in_the_coordinates_of_the_program() -> None:
    """It is selected under a shift and cut under another one; a mirror image keeps its size."""
    files = {"A.H": box("A", 0, 0, 30, 20)}
    for cycle, words in ((7, "X+50 Z-3"), (8, "X"), (10, "ROT+30")):
        frame = f"CYCL DEF {cycle}.0 F\nCYCL DEF {cycle}.1 {words}"
        (terrace,) = terraces(memory(after(program("MAIN", frame, 'CONTOUR DEF P1 = "A"'), files)).contour, 5)
        assert terrace.region.bounds == pytest.approx(np.array([[0, 0], [30, 20]]), abs=1e-9)


def test_parameters_are_copies() -> None:
    """What definitions and descriptions write to Q, QL and QS parameters does not stay; one program, two contours."""
    lines = (
        "Q1 = 10", 'QS1 = "A"', "QL1 = 5", "DECLARE CONTOUR QC1 = QS1", "Q1 = 20", 'DECLARE CONTOUR QC2 = "A"', "QC3 = QC1 | QC2",
    )  # fmt: skip
    described = program("A", "L XQ1 Y+0", "Q7 = Q1 + 5", "L XQ7", "L Y+5", "L XQ1", "Q1 = 999")
    main = program("MAIN", "Q1 = -7", "QL1 = 3", 'SEL CONTOUR "MODEL"', "Q30 = QL1")
    run = mnclab.run(main, "tnc-620", Setup(files={"MODEL.H": program("MODEL", *lines), "A.H": described}))
    assert run.ok and not run.alarms, run.alarms
    assert run.variables == {"Q1": -7, "QL1": 3, "Q30": 3}
    steps = run.lines()
    assert {run.history["Q1"][k] for k in np.flatnonzero((run.steps.program == 1) & (steps == 5))} == {10}
    ((_, _, area),) = areas('SEL CONTOUR "MODEL"', {"MODEL.H": program("MODEL", *lines), "A.H": described})
    assert area == pytest.approx(50)


def test_labels_of_the_same_program_and_names_in_text_parameters() -> None:
    text = (
        'BEGIN PGM M MM\nQS4 = "HOLE"\nCONTOUR DEF P1 = LBL 5 I2 = LBL QS4 DEPTH2\nM2\nLBL 5\nL X+0 Y+0\nL X+50\nL Y+50\n'
        'L X+0\nLBL 0\nLBL "HOLE"\nCC X+25 Y+25\nLP PR+10 PA+0\nCP IPA+360 DR+\nLBL 0\nEND PGM M MM\n'
    )
    contour = memory(after(text, {})).contour
    assert [round(t.region.area, 6) for t in terraces(contour, 5)] == [2500, round(2500 - 100 * math.pi, 6)]


def test_in_din_iso_programs() -> None:
    files = {
        "MODEL.I": '%MODEL G71 *\nN10 DECLARE CONTOUR QC1 = "A.I" DEPTH5 *\nN20 DECLARE CONTOUR QC2 = "B" DEPTH0 *\n'
        "N30 QC10 = QC1 | QC2 *\nN99999999 %MODEL G71 *\n",
        "A.I": "%A G71 *\nN10 G00 G40 G90 X+0 Y+0 *\nN20 G01 X+40 *\nN30 Y+40 *\nN40 X+0 *\nN50 Y+0 *\nN99999999 %A G71 *\n",
        "B.H": box("B", 100, 0, 10, 10),
    }  # fmt: skip
    for block in ('SEL CONTOUR "MODEL.I"', 'CONTOUR DEF P1 = "B" P2 = "A.I" DEPTH5', 'SEL CONTOUR "TNC:\\PARTS\\MODEL.I"'):
        run = mnclab.run(f"%MAIN G71 *\nN10 {block} *\nN99999999 %MAIN G71 *\n", "tnc-620", Setup(files=files))
        assert run.ok and not run.alarms, run.alarms
    assert [(top, bottom, round(area)) for top, bottom, area in areas('SEL CONTOUR "MODEL.I"', files)] == [
        (0, 5, 1700), (5, 20, 100),
    ]  # fmt: skip


# --- what comes before and after ----------------------------------------------------------------------------------------

def test_the_last_definition_counts() -> None:
    files = {"A.H": box("A", 0, 0, 10, 10), "B.H": box("B", 0, 0, 20, 20)}
    files["MODEL.H"] = program("MODEL", 'DECLARE CONTOUR QC1 = "B"', "QC10 = QC1")
    cycle = "CYCL DEF 14.0 C\nCYCL DEF 14.1 LABEL1\nFN 9: IF 0 EQU 0 GOTO LBL 2\nLBL 1\nLBL 0\nLBL 2"
    a, model = 'CONTOUR DEF P1 = "A"', 'SEL CONTOUR "MODEL"'
    for blocks, area in (((cycle, a), 100), ((a, model), 400), ((model, a), 100), ((a, cycle), None)):
        contour = memory(after(program("MAIN", *blocks), files)).contour
        assert (contour.names == ("1",)) if area is None else round(terraces(contour, 1)[0].region.area) == area


def test_a_file_next_to_the_program(tmp_path: Path) -> None:
    (tmp_path / "a.h").write_text(box("A", 0, 0, 10, 10), encoding="utf-8")
    (tmp_path / "Model.H").write_text(program("MODEL", 'DECLARE CONTOUR QC1 = "A"', "QC10 = QC1"), encoding="utf-8")
    (tmp_path / "main.h").write_text(program("MAIN", 'SEL CONTOUR "MODEL"'), encoding="utf-8")
    assert mnclab.run(tmp_path / "main.h").ok


def test_a_depth_below_the_milling_depth_is_remarked() -> None:
    files = {"A.H": box("A", 0, 0, 80, 80)}
    text = ROUGH.replace('SEL CONTOUR "MODEL"', 'CONTOUR DEF P1 = "A" DEPTH50')
    run = mnclab.run(text, "tnc-620", Setup(tools=TOOLS, files=files))
    assert [a.message for a in run.alarms] == [
        "DEPTH50 of the contour is deeper than the milling depth Q1 = -20, which counts"
    ]
    assert run.toolpath.end[:, 2].min() == -19.5


@pytest.mark.deep
def test_the_limits_of_contours_and_elements() -> None:
    """128 contours and 16384 elements are allowed, one more is not."""
    many = "QC10 = " + " | ".join(["QC1"] * 128)
    assert len(defined('DECLARE CONTOUR QC1 = "S"', many, S=box("S", 0, 0, 10, 10))) == 1
    files = {"S.H": box("S", 0, 0, 10, 10), "MODEL.H": program("MODEL", 'DECLARE CONTOUR QC1 = "S"', many + " | QC1")}
    (alarm,) = mnclab.run(program("MAIN", 'SEL CONTOUR "MODEL"'), "tnc-620", Setup(files=files)).alarms
    assert alarm.message == "the formula has more than 128 contours" and alarm.span.line == 3
    for count in (16384, 16385):
        angles = np.linspace(0, math.tau, count, endpoint=False)
        lines = [f"L X{x:+.6f} Y{y:+.6f}" for x, y in zip(500 * np.cos(angles), 500 * np.sin(angles))]
        files = {"A.H": program("A", *lines)}
        run = mnclab.run(program("MAIN", 'CONTOUR DEF P1 = "A"'), "tnc-620", Setup(files=files))
        assert run.ok == (count == 16384)
    assert run.alarms[0].message == "the contours of CONTOUR DEF have more than 16384 elements"


@pytest.mark.deep
def test_the_whole_example() -> None:
    """Rough, floor and sides of 10.1 without a remark: levels of 22, the floor of 23, levels of 24; 59837.4 mm³ are cut."""
    run = mnclab.run(FILES["CONTOUR.H"], "tnc-620", Setup(tools=TOOLS, files=FILES))
    assert run.ok and not run.alarms, run.alarms
    path = run.toolpath
    for cycle, feed, heights in ((22, 350, [-19.5, -15, -10, -5]), (23, 200, [-20]), (24, 400, [-20, -15, -10, -5])):
        flat = path[(path.feed == feed) & (abs(path.end[:, 2] - path.start[:, 2]) < 1e-9)]
        assert {row.label.split()[2] for row in flat} == {str(cycle)}
        assert sorted({round(float(z), 9) for z in flat.end[:, 2]}) == heights
    assert run.workpiece().removed == pytest.approx(59837.4, rel=1e-4)
    assert not run.collisions()

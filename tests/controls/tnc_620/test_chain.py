"""Cycles 7, 8, 10, 11, 26, 19 and 247 in the examples of chapter 11, and what a chain of transformations keeps."""

from __future__ import annotations

import json
import math
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tools import running

import mnclab as mnc

EXAMPLES = json.loads(
    (Path(__file__).parents[2] / "authorities/catalogue/tnc620-transformations.json").read_text(encoding="utf-8")
)


def checks(code: str, number: int = 0) -> dict:
    return [e for e in EXAMPLES if e["code"] == code][number]["check"]


def text(code: str, number: int = 0) -> str:
    return [e for e in EXAMPLES if e["code"] == code][number]["program"]

run = partial(running.run, control="tnc-620", before="TOOL CALL 1 Z S1000 F1000\n")


def where(definitions: str, points: list, **setup: object) -> np.ndarray:
    """Machine positions (n, 3) of local points under some definitions; a far point before each, so that it is a move."""
    moves = "".join(f"L X-999 Y-999 Z-999\nL X{p[0]} Y{p[1]} Z{p[2] if len(p) > 2 else 0}\n" for p in points)
    return run(f"{definitions}\n{moves}", **setup).toolpath.motion.end[1::2]


def flat(points: list) -> np.ndarray:
    return np.array([[*p, 0][:3] for p in points], dtype=float)


def shift(x: float, y: float, z: float = 0) -> str:
    return f"CYCL DEF 7.0 S\nCYCL DEF 7.1 X{x:+.9f}\nCYCL DEF 7.2 Y{y:+.9f}\nCYCL DEF 7.3 Z{z:+.9f}\n"


def mirror(axes: str) -> str:
    return f"CYCL DEF 8.0 M\nCYCL DEF 8.1 {axes}\n"


def turn(angle: float) -> str:
    return f"CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT{angle:+.9f}\n"


def scale(factor: float) -> str:
    return f"CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL {factor:.9f}\n"


def tilt(a: float, b: float, c: float, more: str = "") -> str:
    return f"CYCL DEF 19.0 P\nCYCL DEF 19.1 A{a:+.9f} B{b:+.9f} C{c:+.9f} {more}\n"


def test_the_chain_acts_from_the_last_definition_to_the_first() -> None:
    found = checks("transformation chain")
    program = text("transformation chain")
    assert where(program, found["local"]) == pytest.approx(np.array(found["preset"]), abs=6e-4)
    found = checks("transformation chain", 1)
    order = shift(60, 40, -5) + turn(35) + mirror("X") + scale(0.75)
    assert where(order, found["local"]) == pytest.approx(np.array(found["preset"]), abs=6e-4)
    found = checks("transformation chain", 2)
    for order, key in (
        (shift(60, 40) + turn(35), "shift_then_rotation"),
        (turn(35) + shift(60, 40), "rotation_then_shift"),
    ):
        assert where(order, found["local"])[:, :2] == pytest.approx(np.array(found[key]), abs=6e-4)


def test_a_chain_with_a_tilt() -> None:
    found = checks("transformation chain", 3)
    order = shift(60, 40, -5) + tilt(0, 45, 0) + "CYCL DEF 7.0 S\nCYCL DEF 7.1 X+10\n" + turn(30)
    assert where(order, found["local"]) == pytest.approx(np.array(found["preset"]), abs=6e-4)


@pytest.mark.parametrize(
    ("code", "keys"),
    [
        ("CYCL DEF 7", ("preset",)),
        ("CYCL DEF 10", ("run_1", "run_2")),
        ("CYCL DEF 11", ("", "run_2")),
        ("CYCL DEF 26", ("", "run_2")),
    ],
)
def test_examples_as_printed(code: str, keys: tuple[str, ...]) -> None:
    """Subprogram 1 is not printed: it goes to the points of the check."""
    found = checks(code)
    goes = "".join(f"L X-999 Y-999 Z-999\nL X{p[0]} Y{p[1]} Z{[*p, 0][2]}\n" for p in found["local"])
    program = text(code) if "CALL LBL" in text(code) else text(code) + "\nCALL LBL 1"
    path = run(f"{program}\nM30\nLBL 1\n{goes}LBL 0").toolpath.motion.end[1::2].reshape(len(keys), -1, 3)
    for ends, key in zip(path, keys, strict=True):
        assert ends == pytest.approx(flat(found[key] if key else found["local"]), abs=6e-4)


def test_an_incremental_shift() -> None:
    assert where(shift(60, 40, -5) + text("CYCL DEF 7", 1), [(0, 0, 0)])[0].tolist() == checks("CYCL DEF 7", 1)["datum"]


def test_mirror_images() -> None:
    found = checks("CYCL DEF 8", 1)
    for axes, key in (("X", "mirror_x"), ("Y", "mirror_y"), ("X Y", "mirror_xy")):
        assert where(shift(60, 40) + mirror(axes), [found["local"]])[0, :2].tolist() == found[key]


def test_the_printed_mirror_image_needs_no_tool() -> None:
    """Its Z is the tool axis once a tool is called."""
    assert mnc.run(text("CYCL DEF 8"), "tnc-620").ok
    refused = mnc.run("TOOL CALL 1 Z S1\n" + text("CYCL DEF 8"), "tnc-620").alarms[0]
    assert refused.message == "CYCL DEF 8 axes (mirrored axes) cannot be the tool axis Z"
    assert refused.span[:2] == (3, 17)


CONTOUR = "L X+30 Y+0 R0 FMAX\nL X+40 RL F200\nL Y+30\nCR X+20 Y+50 R+20 DR+\nL X+0\nL Y+0\nL X+41\nL X+60 R0\n"


@pytest.mark.parametrize(("axes", "signs", "sense"), [("X", (-1, 1), -1), ("Y", (1, -1), -1), ("X Y", (-1, -1), 1)])
def test_a_mirror_image_turns_arcs_and_the_side_over(axes: str, signs: tuple[int, int], sense: int) -> None:
    """Path, side and arcs of the compensated contour are those of the plain one, mirrored."""
    plain, other = run(CONTOUR).toolpath.motion, run(mirror(axes) + CONTOUR).toolpath.motion
    assert other.end == pytest.approx(plain.end * (*signs, 1))
    assert other.sweep == pytest.approx(plain.sweep * sense)
    assert other.side.tolist() == (plain.side * sense).tolist()


@settings(max_examples=20, deadline=None)
@given(angle=st.floats(-360, 360), x=st.floats(-500, 500), y=st.floats(-500, 500))
def test_turning_the_frame_turns_the_path(angle: float, x: float, y: float) -> None:
    plain, other = run(CONTOUR).toolpath.motion, run(shift(x, y) + turn(angle) + CONTOUR).toolpath.motion
    c, s = math.cos(math.radians(round(angle, 9))), math.sin(math.radians(round(angle, 9)))
    u, v, w = plain.end.T
    assert other.end == pytest.approx(
        np.stack([round(x, 9) + c * u - s * v, round(y, 9) + s * u + c * v, w], 1), abs=1e-6
    )
    assert other.lengths[1:] == pytest.approx(plain.lengths[1:], abs=1e-6) and (other.side == plain.side).all()


@settings(max_examples=15, deadline=None)
@given(x=st.floats(-500, 500), y=st.floats(-500, 500), angle=st.floats(-360, 360), factor=st.floats(0.1, 9))
def test_there_and_back_again(x: float, y: float, angle: float, factor: float) -> None:
    """Each neutral value takes its frame out; two mirror images at right angles are half a turn."""
    point = [(7, 3, -2)]
    there = shift(x, y) + mirror("X") + turn(angle) + scale(factor)
    back = scale(1) + turn(0) + mirror("") + shift(0, 0)
    assert where(there + back, point)[0].tolist() == [7, 3, -2]
    assert where(mirror("X Y"), point) == pytest.approx(where(turn(180), point))


def test_a_scale_leaves_the_tool_alone() -> None:
    """RL beside X+10 at scale 2: the contour lies at X20, the tool of radius 5 at X15; feeds are not scaled."""
    path = run(scale(2) + "L X+10 Y+0 RL F200\nL Y+50\nL X+30").toolpath.motion
    assert path.end[1].tolist() == pytest.approx([15, 100, 0]) and set(path.feed.tolist()) == {200}


def test_a_scale_scales_roundings_and_lengths_of_cycles() -> None:
    """Half of RND R5 is 2.5; half of the depth 20 under Q203+0 from Z2 is 10 from Z1; a thread keeps its pitch."""
    path = run(scale(0.5) + "L X+0 Y+0 F200\nL X+40\nRND R5\nL Y+40").toolpath
    arc = path[path.kind == mnc.Kind.ARC][0]
    assert np.linalg.norm(arc.end - arc.centre) == pytest.approx(2.5)
    hole = "CYCL DEF 200 X\nQ200=2\nQ201=-20\nQ206=150\nQ202=20\nQ210=0\nQ203=0\nQ204=50\nQ211=0\nQ395=0\n"
    hole += "L X+1 Y+1 FMAX M3\nCYCL CALL"
    levels = run(scale(0.5) + hole).toolpath
    assert -10 in levels.end[:, 2].round(9).tolist() and 1 in levels.end[:, 2].round(9).tolist()
    thread = "CYCL DEF 18.0 T\nCYCL DEF 18.1 DEPTH = -20\nCYCL DEF 18.2 PITCH = +2\nCYCL CALL"
    refused = mnc.run(f"TOOL CALL 1 Z S1000\n{scale(0.5)}{thread}\n", "tnc-620")
    assert "CYCL DEF 18 cannot run under a scale of Z other than 1, got 0.5" in refused.alarms[0].message


def test_a_tool_in_a_scaled_surface() -> None:
    """Cycle 232 at scale 2: the lines reach R + Q357 beyond the surface, R as it is and Q357 doubled."""
    face = ("CYCL DEF 232 F\nQ389=0\nQ225=0\nQ226=0\nQ227=0\nQ386=-1\nQ218=50\nQ219=30\nQ202=2\nQ369=0\nQ370=1\nQ207=500\n"
            "Q385=500\nQ253=900\nQ200=2\nQ357=2\nQ204=10\nCYCL CALL\n")  # fmt: skip
    path = run(scale(2) + "L Z+50 FMAX M3\n" + face).toolpath
    cut = path[path.feed == 500]
    assert cut.bounds[:, 0].tolist() == [-9, 109] and cut.bounds[1, 1] == pytest.approx(55)  # 2*30 less R


def test_unequal_scales_refuse_arcs_where_they_stand() -> None:
    blocks = "TOOL CALL 1 Z F100\nCYCL DEF 26.0 S\nCYCL DEF 26.1 X 1.4 Y 0.6\nL X+10 Y+0\nCR X+20 Y+10 R+10 DR+\n"
    refused = mnc.run(blocks, "tnc-620").alarms[0]
    assert refused.message == "an arc under unequal scales of its plane would be an ellipse" and refused.span.line == 5
    run("CYCL DEF 26.0 S\nCYCL DEF 26.1 X 1.4 Y 1.4 Z 2\nL X+10 Y+0\nCR X+20 Y+10 R+10 DR+")


def test_a_preset_replaces_all_but_the_tilt() -> None:
    presets = {4: (100, 50, 10)}
    before = shift(1, 2) + mirror("X") + turn(10) + scale(2)
    found = run(before + text("CYCL DEF 247") + "\nL X+1 Y+2 Z+3", presets=presets)
    assert found.toolpath.end[-1].tolist() == [1, 2, 3] and tuple(found.toolpath.origin) == presets[4]  # chosen before it moves
    assert [name for name, _ in found.frames] == ["secondary axes", "preset"]
    kept = run(tilt(0, 90, 0) + text("CYCL DEF 247") + "\nL X+1 Y+2 Z+3", presets=presets)
    assert [name for name, _ in kept.frames] == ["secondary axes", "preset", "tilt"]


def test_a_rotary_axis_is_shifted_and_mirrored() -> None:
    """C+30 with a shift of 10 stands at 40, with its mirror image at -20."""
    assert np.degrees(run("CYCL DEF 7.0 S\nCYCL DEF 7.1 C+10\nL C+30 FMAX").toolpath.rotary[-1, 2]) == pytest.approx(40)
    both = "CYCL DEF 7.0 S\nCYCL DEF 7.1 C+10\nCYCL DEF 8.0 M\nCYCL DEF 8.1 C\nL C+30 FMAX\nL IC+5 FMAX"
    assert np.degrees(run(both).toolpath.rotary[-2:, 2]) == pytest.approx([-20, -25])




# --- datum tables ------------------------------------------------------------------------------------------------------

ROWS = checks("datum table")["rows"]
TABLE = "NULLTAB.D MM\nD X Y Z A B C DOC\n" + "".join(
    f"{row} {' '.join(f'{value:+g}' for value in ROWS.get(str(row), [0] * 6))} clamp {row}\n" for row in range(20)
) + "[END]\n"  # fmt: skip
FILES = {"NULLTAB.D": TABLE}


def test_the_printed_table() -> None:
    select = 'SEL TABLE "TNC:\\NULLTAB.D"\n'
    for number in (0, 1):
        check = checks("CYCL DEF 7 (datum table)", number)
        expected = [check["shift"][axis] for axis in "XYZ"]
        assert where(select + text("CYCL DEF 7 (datum table)", number), [(0, 0)], files=FILES)[0].tolist() == expected
    by_parameter = select + "Q5 = 3\nCYCL DEF 7.0 S\nCYCL DEF 7.1 #Q5\nCYCL DEF 7.0 S\nCYCL DEF 7.1 IX+1"
    assert where(by_parameter, [(0, 0)], files=FILES)[0].tolist() == [401.994, 50.001, 0]


def test_empty_fields_leave_an_axis_alone() -> None:
    table = "T.D INCH\nD   X    Y    Z   DOC\n0   1         -\n7        2        second\n[END]\n"
    files = {"T.D": table}
    blocks = shift(5, 6, 7) + "SEL TABLE T\nCYCL DEF 7.0 S\nCYCL DEF 7.1 #0\n"
    assert where(blocks, [(0, 0)], files=files)[0].tolist() == pytest.approx([25.4, 6, 7])
    assert where(blocks.replace("#0", "#7"), [(0, 0)], files=files)[0].tolist() == pytest.approx([5, 50.8, 7])


def test_the_datums_of_the_setup_are_a_table() -> None:
    assert where("CYCL DEF 7.0 S\nCYCL DEF 7.1 #3", [(0, 0)], datums={3: (1, 2, 3)})[0].tolist() == [1, 2, 3]


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("T.D\nD X\n[END]", "line 1: the first line must say MM or INCH"),
        ("T.D MM\nX Y\n[END]", "line 2: the column D is missing"),
        ("T.D MM\nD U\n[END]", "line 2: the column U is not built yet"),
        ("T.D MM\nD Q\n[END]", "line 2: Q is no column"),
        ("T.D MM\nD X\n0 1\n0 2\n[END]", "line 4: row 0 is there twice"),
        ("T.D MM\nD X\n1.5 1\n[END]", "line 3: the column D must be a whole number"),
        ("T.D MM\nD X\n1 one\n[END]", "line 3: X must be a number, got one"),
        ("T.D MM\nD X\n1 100000\n[END]", "line 3: X must be at least -99999.9999"),
        ("T.D MM\nD X\n1 2 3\n[END]", "stands under no column of its own"),
        ("T.D MM\nD X\n1 2\n", "line 4: [END] is missing"),
    ],
)
def test_faults_of_a_table(table: str, message: str) -> None:
    alarm = mnc.run("SEL TABLE T\nL X1\n", "tnc-620", mnc.Setup(files={"T.D": table})).alarms[0]
    assert message in alarm.message and alarm.span[:2] == (1, 11)


def test_a_row_that_is_not_there() -> None:
    alarm = mnc.run("SEL TABLE NULLTAB\nCYCL DEF 7.0 S\nCYCL DEF 7.1 #20\n", "tnc-620", mnc.Setup(files=FILES)).alarms[0]
    assert "names row 20, which the datum table" in alarm.message and alarm.span[:2] == (3, 14)

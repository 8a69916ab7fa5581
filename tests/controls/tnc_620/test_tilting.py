"""Cycle 19 (11.9): the examples of the manual, the rotary axes of each pair, and what tilting keeps."""

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
from mnclab.geometry import frames

EXAMPLES = [
    e
    for e in json.loads(
        (Path(__file__).parents[2] / "authorities/catalogue/tnc620-transformations.json").read_text(encoding="utf-8")
    )
    if e["code"] == "CYCL DEF 19"
]
MANUAL, AUTOMATIC, MATRIX, CANCEL = EXAMPLES

PAIRS = ("CA", "CB", "AB", "BA")


def positions(pair: str, tool: np.ndarray, now: float = 0.0) -> list[dict[str, float]]:
    """Both ways to turn the tool there, degrees, by a head of two axes whose first one carries the other."""
    head = mnc.Kinematics(head=(mnc.Axis(pair[0]), mnc.Axis(pair[1])))
    return [dict(zip("ABC", np.degrees(way[0]), strict=True)) for way in head.solutions(tool, (now, now, now))]


run = partial(running.run, control="tnc-620", before="TOOL CALL 1 Z S1000 F1000\n")


def test_positioning_by_the_program() -> None:
    """The example as printed: from tilted (-53.033, 10, 88.388), where block 14 leaves the tip."""
    check, found = MANUAL["check"], run(MANUAL["program"])
    path = found.toolpath.motion
    assert [found.variables["Q120"], found.variables["Q122"]] in [pytest.approx(pair) for pair in check["Q120_Q122"]]
    assert np.degrees(path.rotary[-1]) == pytest.approx([45, 0, 90])
    assert path.end[-3] == pytest.approx([25, 10, 100])
    assert path.end[-2] == pytest.approx(check["after_block_15_untilted"], abs=6e-4)
    assert path.end[-1] == pytest.approx(check["end_untilted"], abs=6e-4)
    turning = path[-3]
    assert turning.feed == pytest.approx(math.radians(1000)) and turning.time == pytest.approx(60 * 90 / 1000)


def test_automatic_positioning() -> None:
    """The point 50 below the tip stands still; 90 degrees of C at 5000 degrees a minute take 1.08 s."""
    check, path = AUTOMATIC["check"], run(AUTOMATIC["program"]).toolpath.motion
    assert path.end[2] == pytest.approx(check["tip_after_tilt_untilted"], abs=6e-4)
    assert np.degrees(path.rotary[2]) == pytest.approx([45, 0, 90])
    assert path.lengths[2] / path[2].feed * 60 == pytest.approx(1.08)
    assert path.end[3] == pytest.approx(check["after_block_14_untilted"], abs=6e-4)
    assert path.end[4] == pytest.approx(check["end_untilted"], abs=6e-4)
    assert path.end[2] - 50 * np.array([math.sqrt(0.5), 0, math.sqrt(0.5)]) == pytest.approx(check["fixed_point"])


def test_a_plane_of_three_angles() -> None:
    """Matrix and positions of every pair of axes; angles are compared within whole turns."""
    check = MATRIX["check"]
    tilted = frames.spatial(*np.radians([10, 20, 30]))
    assert tilted[:3, :3] == pytest.approx(np.array(check["matrix"]), abs=6e-6)
    for pair, names, known in (
        ("CA", "AC", check["AC"]), ("CB", "BC", check["BC"]),
        ("AB", "AB", [check["AB_A_outer"]]), ("BA", "AB", [check["AB_B_outer"]]),
    ):  # fmt: skip
        found = [[way[axis] for axis in names] for way in positions(pair, tilted[:3, 2])]
        for expected in known:
            assert any(
                all(abs(math.remainder(a - b, 360)) < 6e-6 for a, b in zip(one, expected, strict=True)) for one in found
            )
        result = run(MATRIX["program"], rotary_axes=pair)
        near = min(found, key=lambda one: max(map(abs, one)))
        values = {"A": "Q120", "B": "Q121", "C": "Q122"}
        assert [result.variables[values[axis]] for axis in names] == pytest.approx(near)


@settings(max_examples=60, deadline=None)
@given(angles=st.tuples(*[st.floats(-3.1, 3.1)] * 3), pair=st.sampled_from(PAIRS))
def test_the_positions_turn_the_tool_into_the_axis_of_the_plane(angles: tuple[float, ...], pair: str) -> None:
    """The carrier turns what the other one has turned."""
    axis = frames.spatial(*angles)[:3, 2]
    for found in positions(pair, axis, 0.3):
        outer, inner = (frames.turn(math.radians(found[each]), {"A": "x", "B": "y", "C": "z"}[each]) for each in pair)
        assert (outer @ inner)[:3, 2] == pytest.approx(axis, abs=1e-8)


def test_a_free_axis_stays() -> None:
    """The tool along Z does not say where C stands."""
    for way in positions("CA", np.array([0, 0, 1]), 0.5):
        assert way["C"] == pytest.approx(math.degrees(0.5)) and way["A"] == pytest.approx(0)


def test_the_shorter_way_is_taken() -> None:
    """From A-45 C-90 the plane B45 needs no turn at all."""
    found = run("L A-45 C-90 FMAX\nCYCL DEF 19.0 P\nCYCL DEF 19.1 A+0 B+45 C+0")
    assert [found.variables["Q120"], found.variables["Q122"]] == pytest.approx([-45, -90])


def test_cancelled() -> None:
    zeros = "\n".join(CANCEL["program"].splitlines()[:2])
    found = run(zeros)
    assert "tilt" in dict(found.frames) and np.array_equal(dict(found.frames)["tilt"], np.eye(4))
    off = run(CANCEL["program"])
    assert "tilt" not in dict(off.frames)


def test_an_angle_left_out_is_that_of_the_cycle_before() -> None:
    twice = run("CYCL DEF 19.0 P\nCYCL DEF 19.1 A+10 B+20 C+30\nCYCL DEF 19.0 P\nCYCL DEF 19.1 A+40")
    assert dict(twice.frames)["tilt"] == pytest.approx(frames.spatial(*np.radians([40, 20, 30])))


def test_angles_of_the_axes() -> None:
    found = run("CYCL DEF 19.0 P\nCYCL DEF 19.1 A+30 C+90", tilt_angles="axes")
    assert dict(found.frames)["tilt"][:3, 2] == pytest.approx([0.5, 0, math.sqrt(0.75)])  # Rz(90) Rx(30) ez
    assert [found.variables[q] for q in ("Q120", "Q121", "Q122")] == pytest.approx([30, 0, 90])
    setup = mnc.Setup(settings={"tilt_angles": "axes"})
    alarm = mnc.run("CYCL DEF 19.0 P\nCYCL DEF 19.1 B+30\n", "tnc-620", setup).alarms[0]
    assert alarm.message == "CYCL DEF 19 B (tilt angle B) must be 0, got 30: the rotary axes are A and C"
    assert alarm.span[:2] == (2, 15)


def test_not_under_radius_compensation() -> None:
    alarm = mnc.run("TOOL CALL 1 Z F100\nL X+10 RL\nL X+20\nCYCL DEF 19.0 P\nCYCL DEF 19.1 A+5\n", "tnc-620").alarms[0]
    assert "cannot tilt the plane under radius compensation" in alarm.message and alarm.span[:2] == (4, 1)


def test_what_was_defined_behind_the_tilt_outlives_it() -> None:
    """Two shifts add up, with a warning; a new shift stands for both."""

    def blocks(x: float) -> str:
        return f"CYCL DEF 7.0 S\nCYCL DEF 7.1 X+{x}\n"

    tilted = blocks(10) + "CYCL DEF 19.0 P\nCYCL DEF 19.1 B+90\n" + blocks(5) + "CYCL DEF 19.0 P\nCYCL DEF 19.1\n"
    found = run(tilted + "L X+1 Y+0 Z+0")
    assert found.toolpath.end[-1].tolist() == [16, 0, 0]
    assert "shift defined behind it act in the untilted system" in found.alarms[0].message
    assert run(tilted + "CYCL DEF 7.0 S\nCYCL DEF 7.1 IX+1\nL X+0").toolpath.end[-1, 0] == 16
    assert run(tilted + blocks(2) + "L X+0").toolpath.end[-1, 0] == 2


def test_contours_and_cycles_in_the_tilted_plane() -> None:
    """A compensated arc and a hole in the plane B90, whose Z is X and whose X is -Z of the machine."""
    contour = "L X+30 Y+0 R0 FMAX\nL X+40 RL F200\nL Y+30\nCR X+20 Y+50 R+20 DR+\nL X+0\nL Y+0\nL X+60 R0\n"
    hole = "CYCL DEF 200 X\nQ200=2\nQ201=-20\nQ206=150\nQ202=7\nQ210=0\nQ203=0\nQ204=50\nQ211=0\nQ395=0\n"
    hole += "L X+1 Y+1 FMAX M3\nCYCL CALL\n"
    tilted = run("CYCL DEF 19.0 P\nCYCL DEF 19.1 B+90\n" + contour + hole).toolpath.motion
    plain = run(contour + hole).toolpath.motion
    assert tilted.end == pytest.approx(plain.end @ np.array([[0, 0, -1], [0, 1, 0], [1, 0, 0]]), abs=1e-9)
    assert tilted.sweep == pytest.approx(plain.sweep) and tilted.lengths == pytest.approx(plain.lengths)
    assert tilted.axis[-1] == pytest.approx([1, 0, 0])

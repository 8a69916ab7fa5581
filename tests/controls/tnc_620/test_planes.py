"""PLANE in all its forms on three machines with rotary axes: 200 random rotations said in every form and rebuilt, and which of
two ways the axes go. What is expected is worked out here, from rotations alone."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from tools import running

import mnclab as mnc
from mnclab.geometry import frames

MACHINES = ("table-ac", "head-bc", "head-b-table-c")
CHAINS = {"table-ac": "CA", "head-bc": "CB", "head-b-table-c": "CB"}  # the axes from the part to the tool
TOOLS = {1: mnc.Tool(length=80, radius=5)}
run = partial(running.run, control="tnc-620", before="TOOL CALL 1 Z S1000 F1000\n", tools=TOOLS)


def about(axis: str, degrees: float) -> np.ndarray:
    """The turn (3, 3) about X, Y or Z, named as the rotary axis A, B or C."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return {
        "A": np.array([[1, 0, 0], [0, c, -s], [0, s, c]]),
        "B": np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
        "C": np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]]),
    }[axis]


def words(**values: float) -> str:
    return " ".join(f"{address}{value:+.13f}" for address, value in values.items())


def spatial(r: np.ndarray) -> str:
    a, b, c = math.atan2(r[2, 1], r[2, 2]), math.atan2(-r[2, 0], math.hypot(r[0, 0], r[1, 0])), math.atan2(r[1, 0], r[0, 0])
    return "PLANE SPATIAL " + words(**dict(zip(("SPA", "SPB", "SPC"), np.degrees([a, b, c]), strict=True)))


def euler(r: np.ndarray) -> str:
    """Rz Rx Rz: Z of the plane is (sin p sin n, -cos p sin n, cos n), its last row (sin n sin t, sin n cos t, cos n)."""
    angles = math.atan2(r[0, 2], -r[1, 2]), math.acos(r[2, 2]), math.atan2(r[2, 0], r[2, 1]) % math.tau
    return "PLANE EULER " + words(**dict(zip(("EULPR", "EULNU", "EULROT"), np.degrees(angles), strict=True)))


def projected(r: np.ndarray) -> str:
    """The traces are square to Z of the plane: (cos p, 0, -sin p) in ZX, (0, cos m, sin m) in YZ."""
    x, y, z = r[:, 2]
    p, m = math.atan2(x, z), math.atan2(-y, z)
    trace = np.array([math.cos(p), 0, -math.sin(p)])
    rot = math.atan2(np.cross(trace, r[:, 0]) @ r[:, 2], trace @ r[:, 0])
    return "PLANE PROJECTED " + words(**dict(zip(("PROPR", "PROMIN", "ROT"), np.degrees([p, m, rot]), strict=True)))


def vector(r: np.ndarray) -> str:
    """A base vector that is not square to the normal, neither of them of length 1."""
    two = {"B": 3 * r[:, 0] - 1.5 * r[:, 2], "N": 0.7 * r[:, 2]}
    return "PLANE VECTOR " + words(**{f"{which}{a}": v for which in "BN" for a, v in zip("XYZ", two[which], strict=True)})


def points(r: np.ndarray) -> str:
    one = np.array([12.5, -40.0, 7.0])
    three = one, one + 60 * r[:, 0], one - 25 * r[:, 0] + 35 * r[:, 1]
    return "PLANE POINTS " + words(**{f"P{n + 1}{a}": v for n, of in enumerate(three) for a, v in zip("XYZ", of, strict=True)})


def relative(r: np.ndarray) -> str:
    """R = Rx(a) Ry(b) Rz(c), each about an axis of the plane as it lies then."""
    a, b, c = math.atan2(-r[1, 2], r[2, 2]), math.asin(r[0, 2]), math.atan2(-r[0, 1], r[0, 0])
    turns = zip(("SPA", "SPB", "SPC"), np.degrees([a, b, c]), strict=True)
    return " STAY\n".join(["PLANE RESET", *(f"PLANE RELATIV {words(**{address: angle})}" for address, angle in turns)])


FORMS: dict[str, Callable[[np.ndarray], str]] = {
    "SPATIAL": spatial, "EULER": euler, "PROJECTED": projected, "VECTOR": vector, "POINTS": points, "RELATIV": relative,
}  # fmt: skip
RANDOM = np.random.default_rng(620)


def rotation(steepest: float) -> np.ndarray:
    """A random rotation whose Z leans at most so far, degrees."""
    while True:
        q, _ = np.linalg.qr(RANDOM.normal(size=(3, 3)))
        q = q * np.linalg.det(q)
        if q[2, 2] > math.cos(math.radians(steepest)):
            return q


STEEPEST = {"PROJECTED": 80, "RELATIV": 60}  # which leads through other planes
ROTATIONS = {form: [rotation(STEEPEST.get(form, 105)) for _ in range(200)] for form in FORMS}


def last_of_blocks(found: mnc.Run, name: str, lines: list[int]) -> list:
    """The value of a name of the history behind each line."""
    step_of = {found.program[int(block)].span.line: step for step, block in enumerate(found.steps.block)}
    return [found.history.value(name, step_of[line]) for line in lines]


def tool(machine: str, angles: dict[str, float]) -> np.ndarray:
    """The direction of the tool on the part: the axis next to the part turns what the other one has turned."""
    first, last = CHAINS[machine]
    return (about(first, angles[first]) @ about(last, angles[last]))[:, 2]


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("form", FORMS)
def test_a_rotation_said_in_a_form_is_rebuilt(machine: str, form: str) -> None:
    """The frame of the tilt, and the tool at Q120 to Q122, to 1e-9."""
    program, lines = "", []
    for r in ROTATIONS[form]:
        program += FORMS[form](r) + " STAY\n"
        lines.append(1 + program.count("\n"))
    found = run(program, kinematics=machine)
    frames = last_of_blocks(found, "frame tilt", lines)
    angles = [last_of_blocks(found, name, lines) for name in ("Q120", "Q121", "Q122")]
    for k, r in enumerate(ROTATIONS[form]):
        assert np.abs(np.array(frames[k])[:3, :3] - r).max() < 1e-9
        stands = {axis: of[k] for axis, of in zip("ABC", angles, strict=True)}
        assert np.abs(tool(machine, stands) - r[:, 2]).max() < 1e-9


@pytest.mark.parametrize("machine", MACHINES)
def test_positions_of_the_axes_make_the_plane(machine: str) -> None:
    """PLANE AXIAL: X, Y and Z of the plane are those of the tool, C included."""
    outer, inner = CHAINS[machine]
    angles = RANDOM.uniform((-180, -25), (180, 100), (200, 2))
    program = "".join(f"PLANE AXIAL {outer}{a:+.13f} {inner}{b:+.13f} STAY\n" for a, b in angles)
    found = run(program, kinematics=machine)
    for (a, b), frame in zip(angles, last_of_blocks(found, "frame tilt", range(2, 202)), strict=True):
        assert np.abs(np.array(frame)[:3, :3] - about(outer, a) @ about(inner, b)).max() < 1e-9


@pytest.mark.parametrize("machine", MACHINES)
def test_every_form_of_a_plane_leads_to_the_same_positions(machine: str) -> None:
    r = about("C", 20) @ about("B", 35) @ about("A", -15)
    ends = []
    for form in FORMS.values():
        found = run(f"L X+10 Y+20 Z+60 FMAX\n{form(r)} TURN FMAX\nL X+5 Y-7 Z+30 FMAX", kinematics=machine)
        ends.append(np.array(found.axes())[-1])
    assert np.abs(np.array(ends) - ends[0]).max() < 1e-9


def test_forty_five_degrees_about_x_on_a_trunnion() -> None:
    """SPA45 leans Z to -Y: A45, C stays; and 135 is out of the ±120 of the table: A goes there with C half a turn on."""
    found = run("PLANE SPATIAL SPA+45 SPB+0 SPC+0 STAY", kinematics="table-ac")
    assert [found.variables[name] for name in ("Q120", "Q121", "Q122")] == pytest.approx([45, 0, 0])
    assert dict(found.frames)["tilt"][:3, :3] == pytest.approx(about("A", 45))
    beyond = run("\nPLANE SPATIAL SPA+135 SPB+0 SPC+0 STAY", kinematics="table-ac", ok=False).alarms[0]
    assert beyond.span[:2] == (3, 1) and "no position of A and C turns the tool square to this plane" in beyond.message
    assert "A from -120 to 120°" in beyond.hint


EXAMPLES = json.loads((Path(__file__).parents[2] / "authorities/catalogue/tnc620-klartext.json").read_text(encoding="utf-8"))


def test_the_plane_of_the_manual() -> None:
    """PGM C27: the axes of the plane, and the spindle at the end of its travel before the head turns."""
    (example,) = (each for each in EXAMPLES if each["code"] == "PLANE SPATIAL")
    limits = mnc.Limits(travel=((-500, 500), (-500, 500), (-500, 350)))
    found = run(f"L X+10 FMAX\n{example['program']}", kinematics="head-b-table-c", limits=limits)
    assert dict(found.frames)["tilt"][:3, :3].T == pytest.approx(np.array([example["check"][axis] for axis in "xyz"]))
    assert np.array(found.axes())[-1] == pytest.approx([10, 0, 350, 0, 90, 0])


def test_euler_turns_about_z_x_and_z() -> None:
    found = run("PLANE EULER EULPR+45 EULNU+20 EULROT+22 STAY", kinematics="table-ac")
    assert dict(found.frames)["tilt"][:3, :3] == pytest.approx(about("C", 45) @ about("A", 20) @ about("C", 22))


def test_a_projected_plane_has_its_traces() -> None:
    """PROPR+30 lowers X, right-handed about Y; PROMIN+20 raises Y, right-handed about X."""
    found = run("PLANE PROJECTED PROPR+30 PROMIN+20 ROT+0 STAY", kinematics="table-ac")
    frame = dict(found.frames)["tilt"][:3, :3]
    assert frame[:, 0] == pytest.approx([math.cos(math.pi / 6), 0, -0.5])
    assert frame[:, 2] @ (0, math.cos(math.pi / 9), math.sin(math.pi / 9)) == pytest.approx(0)


def stands(found: mnc.Run) -> list[float]:
    return [found.variables[name] for name in ("Q120", "Q121", "Q122")]


CHOICES = {
    # SPB+30 leans the tool to +X; the trunnion from the part: C, A. C90 A30 or C-90 A-30, as long: A ahead
    ("table-ac", "PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY"): (30, 0, 90),
    ("table-ac", "PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY SEQ+"): (30, 0, 90),
    ("table-ac", "PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY SEQ-"): (-30, 0, -90),
    ("table-ac", "PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY SYM+"): (30, 0, 90),
    ("table-ac", "PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY SYM-"): (-30, 0, -90),
    # from C-80 the way to -90 is the shorter one
    ("table-ac", "L A+0 C-80 FMAX\nPLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY"): (-30, 0, -90),
    ("head-bc", "PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY"): (0, 30, 0),
    ("head-bc", "PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY SEQ-"): (0, -30, 180),
    ("head-b-table-c", "PLANE SPATIAL SPA+0 SPB-30 SPC+0 STAY"): (0, -30, 0),
    ("head-b-table-c", "PLANE SPATIAL SPA+0 SPB-30 SPC+0 STAY SEQ+"): (0, 30, 180),
    # C is free: it stays, goes to 0, or turns the table by SPC
    ("table-ac", "L C+40 FMAX\nPLANE SPATIAL SPA+0 SPB+0 SPC+15 STAY"): (0, 0, 40),
    ("table-ac", "L C+40 FMAX\nPLANE SPATIAL SPA+0 SPB+0 SPC+15 STAY COORD ROT"): (0, 0, 0),
    ("table-ac", "L C+40 FMAX\nPLANE SPATIAL SPA+0 SPB+0 SPC+15 STAY TABLE ROT"): (0, 0, 15),
    ("head-b-table-c", "L C+40 FMAX\nPLANE SPATIAL SPA+0 SPB+0 SPC+15 STAY TABLE ROT"): (0, 0, 15),
    # where it is not free neither word does anything
    ("table-ac", "PLANE SPATIAL SPA+30 SPB+0 SPC+0 STAY TABLE ROT"): (30, 0, 0),
    # M138: A alone tilts, and C stays where it is
    ("table-ac", "L C+90 FMAX\nM138 A\nPLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY"): (30, 0, 90),
    # positions: C stays where the tilt before has it
    ("table-ac", "PLANE AXIAL C+25 STAY\nPLANE AXIAL A+10 STAY"): (10, 0, 25),
    ("table-ac", "L A+5 C+7 FMAX\nPLANE AXIAL IA+10 C+25 STAY"): (15, 0, 25),
}  # fmt: skip


@pytest.mark.parametrize(("machine", "program"), CHOICES)
def test_which_way_the_axes_turn(machine: str, program: str) -> None:
    assert stands(run(program, kinematics=machine)) == pytest.approx(CHOICES[machine, program])


@pytest.mark.parametrize("kinematics", [None, "table-ac"])
def test_without_a_kinematics_the_setting_names_the_axes(kinematics: str | None) -> None:
    """The same forms, words and positions on a machine that says no more than that C carries A."""
    program = "PLANE VECTOR BX+1 BY+0 BZ-1 NX+1 NY+0 NZ+1 STAY SEQ-"
    assert stands(run(program, kinematics=kinematics)) == pytest.approx([-45, 0, -90])
    assert stands(run("PLANE AXIAL A+30 C+90 STAY", kinematics=kinematics)) == pytest.approx([30, 0, 90])


def on_the_trunnion(x: float, y: float, z: float, a: float, c: float) -> np.ndarray:
    """Where the tip is on the part of table-ac, the tip at X Y Z of the machine: A about (0, 0, 50), C about Z; each turns the
    part by minus its angle, so that the tip turns by the angle itself as the part sees it."""
    place = about("A", a) @ (x, y, z - 50) + (0, 0, 50)
    return about("C", c) @ place


def test_turn_moves_the_rotary_axes_alone_and_move_keeps_a_point() -> None:
    begin = "L X+10 Y+20 Z+60 FMAX\n"
    plane = "PLANE SPATIAL SPA+30 SPB+0 SPC+0 "
    turned = run(begin + plane + "TURN FMAX", kinematics="table-ac")
    assert np.array(turned.axes())[-1] == pytest.approx([10, 20, 140, 30, 0, 0])
    assert turned.toolpath.end[-1] == pytest.approx(on_the_trunnion(10, 20, 60, 30, 0))
    moved = run(begin + plane + "MOVE DIST40 F900", kinematics="table-ac")
    kept = moved.toolpath.end - 40 * moved.toolpath.directions
    rows = moved.toolpath.line == 3
    assert np.abs(kept[rows] - (10, 20, 20)).max() < 0.011
    assert moved.toolpath.time[rows].sum() == pytest.approx(60 * 30 / 900)
    stays = run(begin + plane + "STAY", kinematics="table-ac")
    assert np.array(stays.axes())[-1] == pytest.approx([10, 20, 140, 0, 0, 0])


def test_the_axes_go_to_datum_programmed_and_length_in_the_tilted_plane() -> None:
    """The place (5, -7, 30) of the plane SPA30 through the preset (11, 13, 17), on the part and on the machine."""
    found = run(
        "PLANE SPATIAL SPA+30 SPB+0 SPC+0 TURN FMAX\nL X+5 Y-7 Z+30 FMAX", kinematics="table-ac", presets={0: (11, 13, 17)}
    )
    place = np.array([11, 13, 17]) + about("A", 30) @ (5, -7, 30)
    assert found.toolpath.end[-1] + found.toolpath.origin == pytest.approx(place)
    x, y, z, a, _, c = np.array(found.axes())[-1]
    assert on_the_trunnion(x, y, z - 80, a, c) == pytest.approx(place)


def test_mb_retracts_along_the_tool_as_it_stands() -> None:
    """Under A30 the tool lies along Z of the machine: MB50 moves Z alone, MB MAX to the end of its travel."""
    begin = "L X+10 Y+20 Z+60 FMAX\nPLANE SPATIAL SPA+30 SPB+0 SPC+0 TURN FMAX\n"
    found = np.array(run(begin + "PLANE RESET TURN MB50 FMAX", kinematics="table-ac").axes())
    assert found[-1] == pytest.approx([10, 20, 190, 0, 0, 0])
    limits = mnc.Limits(travel=((-300, 300), (-300, 300), (-100, 400)))
    far = np.array(run(begin + "M140 MB MAX", kinematics="table-ac", limits=limits).axes())
    assert far[-1] == pytest.approx([10, 20, 400, 30, 0, 0])
    head = "L X+10 Y+20 Z+60 FMAX\nL B+90 FMAX\nM140 MB MAX FMAX"  # the tool along +X
    assert np.array(run(head, kinematics="head-bc", limits=limits).axes())[-1] == pytest.approx([300, 20, 140, 0, 90, 0])
    slanted = "L X+10 Y+20 Z+60 FMAX\nL B+30 FMAX\nM140 MB20 F100"
    assert np.array(run(slanted, kinematics="head-bc").axes())[-1] == pytest.approx(
        [10 + 20 * 0.5, 20, 140 + 20 * math.sqrt(0.75), 0, 30, 0]
    )


def test_reset_counts_again_with_the_axes_at_zero() -> None:
    """With STAY the part stays as it lies; the axes go to datum, programmed and length all the same."""
    found = run(
        "PLANE SPATIAL SPA+30 SPB+0 SPC+0 TURN FMAX\nL Z+50 FMAX\nPLANE RESET STAY\nL X+1 Y+2 Z+90 FMAX", kinematics="table-ac"
    )
    assert np.array(found.axes())[-1] == pytest.approx([1, 2, 170, 30, 0, 0])
    back = run("PLANE SPATIAL SPA+30 SPB+10 SPC+0 TURN FMAX\nPLANE RESET TURN FMAX\nL X+1 FMAX", kinematics="table-ac")
    assert np.array(back.axes())[-1, 3:] == pytest.approx([0, 0, 0]) and back.toolpath.end[-1, 0] == pytest.approx(1)


def test_cycle_19_is_the_same_plane() -> None:
    plane = run("L Z+60 FMAX\nPLANE SPATIAL SPA+10 SPB+20 SPC+30 MOVE DIST25 F500\nL X+5 Y+1 Z+9 FMAX", kinematics="head-bc")
    cycle = run(
        "L Z+60 FMAX\nCYCL DEF 19.0 P\nCYCL DEF 19.1 A+10 B+20 C+30 F500 ABST25\nL X+5 Y+1 Z+9 FMAX", kinematics="head-bc"
    )
    assert np.array(cycle.axes())[-1] == pytest.approx(np.array(plane.axes())[-1])
    assert cycle.toolpath.time[cycle.toolpath.is_motion].tolist() == pytest.approx(
        plane.toolpath.time[plane.toolpath.is_motion].tolist(), nan_ok=True
    )
    axes = run("CYCL DEF 19.0 P\nCYCL DEF 19.1 A+30 C+90", kinematics="table-ac", tilt_angles="axes")
    assert dict(axes.frames)["tilt"][:3, :3] == pytest.approx(about("C", 90) @ about("A", 30)) and stands(axes) == [30, 0, 90]


def test_a_datum_that_leans_leans_the_plane() -> None:
    """SPA and SPC of a preset, and PLANE behind them: the tool lies along Z of both turns together."""
    presets = {0: mnc.Datum(5, 6, 7, tilt_x=8, tilt_y=-6, rotation=25)}
    found = run("PLANE SPATIAL SPA+20 SPB+0 SPC+0 TURN FMAX\nL X+3 Y+4 Z+5 FMAX", kinematics="table-ac", presets=presets)
    both = about("C", 25) @ about("B", -6) @ about("A", 8) @ about("A", 20)
    a, _, c = stands(found)
    assert tool("table-ac", {"A": a, "C": c}) == pytest.approx(both[:, 2])
    assert found.toolpath.end[-1] == pytest.approx(both @ (3, 4, 5))
    level = run("PLANE SPATIAL SPA+0 SPB+0 SPC+0 TURN FMAX\nL X+3 Y+4 Z+5 FMAX", kinematics="table-ac", presets=presets)
    leans = about("C", 25) @ about("B", -6) @ about("A", 8)
    assert level.toolpath.directions[-1] == pytest.approx(leans[:, 2])
    assert level.toolpath.end[-1] == pytest.approx(leans @ (3, 4, 5))


ZERO = "CYCL DEF 19.0 P\nCYCL DEF 19.1 A+0 B+0 C+0"


@pytest.mark.parametrize("kinematics", MACHINES)
@pytest.mark.parametrize("ends", [
    "PLANE SPATIAL SPA+0 SPB+0 SPC+0 TURN FMAX", "PLANE SPATIAL SPA+0 SPB+0 SPC+0 MOVE F900",
    "PLANE SPATIAL SPA+0 SPB+0 SPC+0 STAY\nL {}", f"{ZERO}\nL {{}}", f"{ZERO} F900 ABST50",
    f"{ZERO} F900 ABST50\nCYCL DEF 19.0 P\nCYCL DEF 19.1",
])  # fmt: skip
def test_three_angles_of_zero_are_the_rotary_axes_at_zero(kinematics: str, ends: str) -> None:
    """The plane before left C where Z of the plane leaves it free: on the part X Y Z are those of the program all the same."""
    first, last = ("A", "C") if kinematics == "table-ac" else ("B", "C")
    turned = ends.format(f"{first}+Q{120 + 'ABC'.index(first)} {last}+Q122 FMAX")
    found = run(f"L C+90 FMAX\nPLANE SPATIAL SPA+20 SPB+20 SPC+0 TURN FMAX\nL X+1 Y+1 Z+50 FMAX\n{turned}\n"
                "L X+12 Y-7 Z+9 FMAX", kinematics=kinematics)  # fmt: skip
    assert found.toolpath.end[-1] + found.toolpath.origin == pytest.approx([12, -7, 9])
    assert np.array(found.axes())[-1] == pytest.approx([12, -7, 89, 0, 0, 0])


@pytest.mark.parametrize("leads", ["", "FUNCTION TCPM F TCP AXIS POS\n"])
def test_a_table_that_counts_from_elsewhere(leads: str) -> None:
    """C_OFFS 20: the part was measured with C at 20 of the machine, so the plane lies turned by 20 on the part, and C shows 90
    where it stands at 110; TABLE ROT and the end of the tilt count from there too."""
    presets = {0: mnc.Datum(5, 6, 7, c=20)}
    tilt = f"{leads}PLANE SPATIAL SPA+0 SPB+30 SPC+0 TURN FMAX SEQ+\nL X+3 Y+4 Z+5 FMAX"
    found = run(tilt, kinematics="table-ac", presets=presets)
    assert stands(found) == pytest.approx([30, 0, 90])
    assert np.array(found.axes())[-1, 3:] == pytest.approx([30, 0, 110])
    place = about("C", 20) @ (np.array([5, 6, 7]) + about("B", 30) @ (3, 4, 5))
    assert found.toolpath.end[-1] + found.toolpath.origin == pytest.approx(place)
    back = run(f"{tilt}\nPLANE RESET TURN FMAX\nL X+1 Y+2 Z+3 FMAX", kinematics="table-ac", presets=presets)
    assert np.array(back.axes())[-1] == pytest.approx([6, 8, 90, 0, 0, 20])
    level = "PLANE SPATIAL SPA+0 SPB+0 SPC+15 TURN FMAX TABLE ROT\nL X+3 Y+0 Z+5 FMAX"
    assert np.array(run(level, kinematics="table-ac", presets=presets).axes())[-1, 5] == pytest.approx(35)


@pytest.mark.parametrize(("again", "r"), [
    ("PLANE RELATIV SPB+25 TURN FMAX", about("C", 30) @ about("B", 45)),
    ("PLANE SPATIAL SPA+0 SPB+45 SPC+30 TURN FMAX", about("C", 30) @ about("B", 45)),
])  # fmt: skip
def test_a_shift_within_the_plane_moves_the_new_plane(again: str, r: np.ndarray) -> None:
    """11.9: a shift before the tilt moves the datum that it turns about, one behind it the tilted system; it is told of."""
    shift = "CYCL DEF 7.0 D\nCYCL DEF 7.1 X+5\nCYCL DEF 7.2 Y-3\n"
    first = "CYCL DEF 7.0 D\nCYCL DEF 7.1 X+50\nPLANE SPATIAL SPA+0 SPB+20 SPC+30 TURN FMAX\n"
    goal = f"{again}\nL X+1 Y+2 Z+3 FMAX"
    found = run(f"{first}{shift}{goal}", kinematics="table-ac")
    assert found.toolpath.end[-1] + found.toolpath.origin == pytest.approx(r @ (6, -1, 3) + (50, 0, 0))
    assert "shift defined in that act in the new one" in found.alarms[0].message
    assert not run(f"{first}{goal}", kinematics="table-ac").alarms and not run(f"{first}{shift}L X+1 FMAX").alarms


def test_shift_rotation_and_mirror_behind_the_tilt() -> None:
    found = run(
        "PLANE SPATIAL SPA+0 SPB+40 SPC+0 TURN FMAX\nTRANS DATUM AXIS X+10 Y-5\nCYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+30\n"
        "CYCL DEF 8.0 M\nCYCL DEF 8.1 Y\nL X+3 Y+4 Z+5 FMAX", kinematics="head-b-table-c",
    )  # fmt: skip
    inner = np.array([10, -5, 0]) + about("C", 30) @ (3, -4, 5)
    assert found.toolpath.end[-1] == pytest.approx(about("B", 40) @ inner)


HOLE = (
    "CYCL DEF 200 X\nQ200=2\nQ201=-20\nQ206=150\nQ202=7\nQ210=0\nQ203=0\nQ204=50\nQ211=0\nQ395=0\n"
    "L X+1 Y+1 FMAX M3\nCYCL CALL\n"
)
POCKET = (
    "CYCL DEF 252 X\nQ215=0\nQ223=40\nQ368=0\nQ207=500\nQ351=+1\nQ201=-6\nQ202=3\nQ369=0\nQ206=150\nQ338=0\nQ200=2\nQ203=0\n"
    "Q204=50\nQ370=1\nQ366=0\nQ385=500\nQ439=0\nL X+1 Y+1 FMAX M3\nCYCL CALL\n"
)


@pytest.mark.parametrize("work", [HOLE, POCKET, "L X+20 Y+0 RL F200\nL X+40\nCR X+20 Y+20 R+20 DR+\nL X+0 R0\n"])
@pytest.mark.parametrize("machine", MACHINES)
def test_cycles_and_contours_run_in_the_tilted_plane(machine: str, work: str) -> None:
    """The same moves as in the level plane, turned; on the machine the tool lies along them."""
    tilted = run(f"PLANE SPATIAL SPA+20 SPB+30 SPC+10 TURN FMAX\nL X+0 Y+0 Z+60 FMAX\n{work}", kinematics=machine).toolpath
    level = run(f"\nL X+0 Y+0 Z+60 FMAX\n{work}").toolpath
    r = about("C", 10) @ about("B", 30) @ about("A", 20)
    (one, other) = (path[path.is_motion & (path.line > 3)] for path in (tilted, level))
    assert len(one) == len(other) > 3 and np.abs(one.end - other.end @ r.T).max() < 1e-9
    assert one.directions == pytest.approx(np.broadcast_to(r[:, 2], (len(one), 3)))


LEANS = "needs the tool square to the working plane, and it leans by 30 degrees"
REFUSED = {
    f"PLANE SPATIAL SPA+30 SPB+0 SPC+0 STAY\n{HOLE}": (14, 1, f"CYCL DEF 200 {LEANS}"),
    f"PLANE SPATIAL SPA+30 SPB+0 SPC+0 STAY\n{POCKET}": (22, 1, f"CYCL DEF 252 {LEANS}"),
    f"FUNCTION TCPM F TCP AXIS POS\nL A+30 FMAX\n{HOLE}": (15, 1, f"CYCL DEF 200 {LEANS}"),
    "PLANE SPATIAL SPA+30 SPB+0 SPC+0 STAY\nL X+5 RL F100\n": (3, 7, f"RL {LEANS}"),
    "L X+5 RL F100\nL A+5\n": (3, 3, "A5: rotary axes cannot turn under radius compensation"),
    "L X+5 RL F100\nL X+7 M128\n": (3, 7, "M128 cannot stand under radius compensation"),
    "L B+5 FMAX\n": (2, 3, "the machine has no rotary axis B: A and C in the table, A from -120 to 120°"),
    "L A+121 FMAX\n": (2, 3, "A (rotary axis) must be from -120 to 120 degrees, and would be 121"),
    "M138 B\n": (2, 6, "M138 B: the machine has no such rotary axis: A and C in the table, A from -120 to 120°"),
    "M138 A+5\n": (2, 6, "M138 names an axis without a number, got A5"),
    "L U+5 FMAX\n": (2, 3, "U5: secondary axes on a machine with rotary axes are not built yet"),
    "PLANE VECTOR BX+1 BY+0 BZ+0 NX+2 NY+0 NZ+0 STAY\n": (
        2, 14, "PLANE VECTOR: the base vector lies along the normal, X of the plane has no direction"),
    "PLANE VECTOR BX+1 BY+0 BZ+0 NX+0 NY+0 NZ+0 STAY\n": (2, 29, "PLANE VECTOR: the normal has no length"),
    "PLANE VECTOR BX+1 BY+0 BZ+0 NX+0 NY+0 STAY\n": (2, 1, "PLANE VECTOR needs NZ (Z of the normal)"),
    "PLANE POINTS P1X+0 P1Y+0 P1Z+0 P2X+1 P2Y+1 P2Z+0 P3X+2 P3Y+2 P3Z+0 STAY\n": (
        2, 14, "PLANE POINTS: the three points lie on a line, and make no plane"),
    "PLANE RELATIV STAY\n": (2, 1, "PLANE RELATIV needs SPA, SPB or SPC"),
    "PLANE RELATIV SPA+1 SPB+1 STAY\n": (2, 21, "SPA1 and SPB1 stand in one block: one angle is allowed"),
    "PLANE PROJECTED PROPR+90 PROMIN+0 ROT+0 STAY\n": (
        2, 17, "PLANE PROJECTED PROPR (angle of the trace in ZX) must be from -89.9999 to 89.9999, got 90"),
    "PLANE AXIAL B+5 STAY\n": (2, 13, "PLANE AXIAL B: the rotary axes are A and C"),
    "PLANE AXIAL A+5 STAY SEQ+\n": (2, 22, "PLANE AXIAL SEQ (which of two solutions) has no meaning: the positions are given"),
    "PLANE AXIAL STAY\n": (2, 1, "PLANE AXIAL needs a position of A or C"),
    "PLANE SPATIAL SPA+1 SPB+0 SPC+0 STAY SEQ+ SYM+\n": (2, 43, "SEQ+ and SYM+ stand in one block: one of SEQ, SYM is allowed"),
    "FUNCTION TCPM F TCP AXIS POS REFPNT CENTER-CENTER\n": (2, 30, "FUNCTION TCPM REFPNT CENTER-CENTER is not built yet"),
}  # fmt: skip


@pytest.mark.parametrize("program", REFUSED)
def test_what_is_refused_and_where(program: str) -> None:
    line, column, message = REFUSED[program]
    alarm = next(a for a in run(program, kinematics="table-ac", ok=False).alarms if a.severity == "alarm")
    assert (alarm.span[:2], alarm.message) == ((line, column), message)


def test_a_sequence_that_the_limits_forbid_names_itself() -> None:
    """B of the head goes from -30: SEQ- for 40 degrees has no position."""
    found = run("PLANE SPATIAL SPA+0 SPB+40 SPC+0 STAY SEQ-", kinematics="head-b-table-c", ok=False)
    alarm = found.alarms[0]
    assert alarm.message == "PLANE SPATIAL SEQ-: no position of B and C turns the tool square to this plane"
    assert alarm.span[:2] == (2, 39) and alarm.hint == "without SEQ there is one"


def test_plain_moves_go_on_with_a_tool_that_leans() -> None:
    found = run("PLANE SPATIAL SPA+30 SPB+0 SPC+0 STAY\nL X+5 Y+1 FMAX\nCC X+0 Y+0\nC X+5 Y+1 DR+ F100 M3", kinematics="table-ac")
    assert len(found.toolpath.motion) == 2


def probing(form: str, machine: str) -> mnc.Run:
    """Cycle 421 in the plane A20 B10, square to which a hole of 40.5 lies at (0.3, -0.2)."""
    frame = np.eye(4)
    frame[:3, :3] = about("B", 10) @ about("A", 20)
    made = (mnc.part.plane((0, 0, 0), (0, 0, 1)) - mnc.part.hole((0.3, -0.2, 0), 40.5, 50)).placed(frame)
    words = "Q273=0 Q274=0 Q262=40 Q325=0 Q247=90 Q261=-5 Q320=0 Q260=20 Q301=0 Q275=0 Q276=0 Q279=0 Q280=0 Q281=0 Q309=0 Q330=0"
    tilt = f"L Z+200 R0 FMAX\nPLANE SPATIAL SPA+20 SPB+10 SPC+0 {form}\nL Z+80 R0 FMAX"
    return mnc.run(
        f"TOOL CALL 7 Z\n{tilt}\nTCH PROBE 421 X\n" + words.replace(" ", "\n") + "\n", "tnc-620",
        tools={7: mnc.Tool(radius=2, length=60, kind="probe")}, part=made,
        kinematics=machine, start=(0, 0, 300),
    )  # fmt: skip


@pytest.mark.parametrize("machine", MACHINES)
def test_probing_in_the_tilted_plane(machine: str) -> None:
    found = probing("TURN FMAX", machine)
    assert found.ok and [found.variables[name] for name in ("Q151", "Q152", "Q153")] == pytest.approx([0.3, -0.2, 40.5], abs=1e-6)
    (alarm,) = probing("STAY", machine).alarms
    leans = math.degrees(math.acos(math.cos(math.radians(20)) * math.cos(math.radians(10))))
    assert alarm.message == f"TCH PROBE 421 needs the tool square to the working plane, and it leans by {leans:.4g} degrees"
    assert alarm.span[:2] == (5, 1)


@pytest.mark.parametrize("machine", ["table-ac", "head-b-table-c"])
def test_a_table_that_aligns_the_part_turns_it(machine: str) -> None:
    """Cycle 1410 finds an edge under 2 degrees and turns the table by them: X of the program runs along the edge then."""
    made = mnc.part.box((0, 0, -40), (100, 60, 0)).placed(np.block([[about("C", 2), np.zeros((3, 1))], [0, 0, 0, 1]]))
    words = (
        "Q1100=10 Q1101=0 Q1102=-5 Q1103=90 Q1104=0 Q1105=-5 Q372=2 Q320=0 Q260=100 Q1125=2 Q309=0 Q1126=1 Q1120=1 Q1121=2"
    )
    program = "L Z+100 R0 FMAX\nL X+50 Y-60 FMAX\nTCH PROBE 1410 X\n" + words.replace(" ", "\n") + "\nL X+0 Y+0 FMAX\nL X+50 FMAX"
    found = mnc.run(
        f"TOOL CALL 7 Z\n{program}\n", "tnc-620", tools={7: mnc.Tool(radius=2, length=60, kind="probe")}, part=made,
        kinematics=machine, start=(0, 0, 300),
    )  # fmt: skip
    assert found.ok and float(found.axes().C[-1]) == pytest.approx(2)
    one, other = found.toolpath.end[-2:]
    assert other - one == pytest.approx(about("C", 2) @ (50, 0, 0))
    early = 2 * (1 / math.cos(math.radians(2)) - 1)  # by which the ball meets a slanted edge before its pole does
    assert one[1] == pytest.approx(one[0] * math.tan(math.radians(2)), abs=early + 1e-9)


def test_a_block_explained_names_the_positions() -> None:
    program = "L Z+60 FMAX\nPLANE SPATIAL SPA+30 SPB+0 SPC+0 TURN FMAX\nL X+1 Y+2 Z+3 FMAX\nPLANE RESET STAY"
    found = run(program, kinematics="table-ac")
    assert "tilted plane: A30 C0, tool axis (0, -0.5, 0.866)" in str(found.explain(3))
    place = np.array(found.axes())[found.toolpath.line == 4][-1, :3]
    last = found.explain(4).stages[-1]
    assert last.name == "spindle, machine coordinates" and last.point == pytest.approx(place)


DEPARTURES = [("LT LEN5", (35, -5)), ("LN LEN5", (30, -10)), ("CT CCA90 R5", (35, -10)), ("LCT X+45 Y-20 R3", (45, -20))]


@pytest.mark.parametrize("dep, end", DEPARTURES, ids=[dep for dep, _ in DEPARTURES])
@pytest.mark.parametrize("plane", ["SPA+90 SPB+0 SPC+0", "SPA+30 SPB+0 SPC+0", "SPA+0 SPB+45 SPC+0", "SPA+25 SPB+35 SPC+20"])
@pytest.mark.parametrize("machine", [None, "table-ac"])
def test_departures_in_a_tilted_plane_are_those_of_a_level_one(dep, end, plane, machine):
    """The contour is Y0 of the plane, the tool of radius 5 to its right: along it, square to it, by a quarter circle of R5."""
    text = (
        f"BEGIN PGM T MM\nTOOL CALL 1 Z S1000 F500\nL X+0 Y+0 Z+100 R0 FMAX M3\nPLANE SPATIAL {plane} "
        f"{'TURN FMAX' if machine else 'STAY'}\nL X-20 Y-20 Z+5 FMAX\nAPPR LT X+0 Y+0 LEN10 RR F300\nL X+30\n"
        f"DEP {dep}\nEND PGM T MM\n"
    )
    run = mnc.run(text, "tnc-620", mnc.Setup(kinematics=machine, tools={1: mnc.Tool(radius=5, length=80, kind="mill")}))
    assert run.ok, run.alarms
    a, b, c = (math.radians(float(word[3:])) for word in plane.split())
    turned = frames.spatial(a, b, c)[:3, :3]
    np.testing.assert_allclose(turned.T @ (run.toolpath.end[-1] + run.toolpath.origin), [*end, 5], atol=1e-9)


def test_the_retraction_of_a_plane_is_in_inches_where_the_program_is():
    text = "BEGIN PGM T INCH\nTOOL CALL 1 Z S1000\nL Z+4 FMAX\nPLANE SPATIAL SPA+30 SPB+0 SPC+0 TURN MB2 FMAX\nEND PGM T INCH\n"
    run = mnc.run(text, "tnc-620", mnc.Setup(kinematics="table-ac", tools={1: mnc.Tool(radius=5, length=80, kind="mill")}))
    assert run.ok and run.axes().Z[-1] == pytest.approx(6 * 25.4 + 80, abs=1e-9)


def test_a_cut_before_the_axes_turn_to_the_plane_is_warned_of_once():
    """STAY: X Y Z of the plane count as if A stood at Q120 = 30: X20 Y10 Z5 is (20, 10, 5) + (1 - Rx(-30)) (0, 0, 50) there,
    whose axis lies 50 over the zero. Lines of many blocks are no exception, a tip that is led is one."""
    plane = "PLANE SPATIAL SPA+30 SPB+0 SPC+0 STAY\n"
    lines = "".join(f"L X+{k} F500\n" for k in range(60))
    for text, where in ((f"{plane}L X+20 Y+10 Z+5 F500\nL X+5\n", 3), (f"L F500\n{plane}L Z+5 FMAX\n{lines}", 6)):
        told = run(text, kinematics="table-ac").alarms
        assert [(each.span.line, "by 30 degrees" in each.message, each.severity) for each in told] == [(where, True, "warning")]
    for turned in ("L A+Q120 C+Q122 FMAX", "L X+1 A+Q120 F500", "M128\nL X+1 F500\nM129\nL A+Q120 FMAX"):
        assert run(f"{plane}{turned}\nL X+20 F500\n", kinematics="table-ac").alarms == ()
    for there in ("", "L A+Q120 FMAX\n"):
        found = run(f"{plane}{there}L X+20 Y+10 Z+5 FMAX\n", kinematics="table-ac")
        axes, z = found.axes(), 55 - 50 * math.cos(math.radians(30))
        assert axes.A[-1] == pytest.approx(30 * bool(there))
        assert [axes.X[-1], axes.Y[-1], axes.Z[-1] - axes.lengths[-1]] == pytest.approx([20, 10 - 25, z])

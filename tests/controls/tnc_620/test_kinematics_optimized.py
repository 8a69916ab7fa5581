"""KinematicsOpt finds the rotary axes of random machines: where they are is decided before, and the cycles see a sphere alone."""

import math
from dataclasses import replace

import numpy as np
import pytest
from controls.tnc_620.spheres import BALL, LENGTH, SPHERE, TOOL, cycle, logged, measured, results, sphere_setup

import mnclab as mnc
from mnclab import Axis, Kind, Kinematics
from mnclab.path.machines import kinematics_of

FOUND = 1e-6  # mm
NUTATING = (0, 1, 1)


def machine(name, random):
    """A chain whose axes go through random places."""
    def axis(letter, *direction):
        return Axis(letter, tuple(random.uniform(-100, 100, 3).tolist()), direction or None)

    return {
        "table AC": lambda: Kinematics(table=(axis("A"), axis("C"))),
        "table BC": lambda: Kinematics(table=(axis("B"), axis("C"))),
        "head CB": lambda: Kinematics(head=(axis("C"), axis("B"))),
        "head CA": lambda: Kinematics(head=(axis("C"), axis("A"))),
        "head B, table C": lambda: Kinematics(head=(axis("B"),), table=(axis("C"),)),
        "nutating table": lambda: Kinematics(table=(axis("B", *NUTATING), axis("C"))),
        "nutating head": lambda: Kinematics(head=(axis("C"), axis("B", *NUTATING))),
        "three axes": lambda: Kinematics(head=(axis("A"), axis("B")), table=(axis("C"),)),
        "one axis": lambda: Kinematics(table=(axis("B"),)),
    }[name]()


CHAINS = (
    "table AC", "table BC", "head CB", "head CA", "head B, table C", "nutating table", "nutating head", "three axes", "one axis",
)  # fmt: skip
NAMED = ("table-ac", "head-bc", "head-b-table-c")


def beside(given, random, spread=0.5, askew=0.0):
    """The same machine as it truly is: its centres off by up to a spread (mm), its directions by as many rad."""
    def off(axis):
        direction = np.array(axis.direction) + random.uniform(-askew, askew, 3)
        centre = axis.centre + random.uniform(-spread, spread, 3)
        return replace(axis, centre=tuple(centre.tolist()), direction=tuple(direction.tolist()))

    return replace(given, head=tuple(map(off, given.head)), table=tuple(map(off, given.table)))


def off_line(axis, true):
    """How far the place of an axis is from where it truly runs, mm."""
    return float(np.linalg.norm(np.cross(true.direction, np.subtract(axis.centre, true.centre))))


def around(kinematics, random, ends=(-80, 85)):
    """Positions for every axis, within its limits, and angles of incidence."""
    found = {}
    for axis in kinematics.sequence:
        low, high = max(axis.limits[0], ends[0]), min(axis.limits[1], ends[1])
        found[axis.name] = (low, high, round(random.uniform(max(low, -60), min(high, 60)), 3), int(random.integers(2, 5)))
    return found


def optimize(believed, true, random, mode=1, code=451, **words):
    """A sphere anywhere, a probe of any length."""
    at, length = tuple(random.uniform(-150, 150, 3).tolist()), random.uniform(80, 220)
    tools = {TOOL: mnc.Tool(name="TCH PROBE", kind="probe", length=length, radius=BALL)}
    start = (at[0], at[1], at[2] + 30 + length)
    words |= {"Q406": mode} if code == 451 else {}
    text = cycle(code, around(believed, random), Q380=round(random.uniform(0, 90), 1), Q423=int(random.integers(3, 9)), **words)
    return measured(text, sphere_setup(believed, true, at=at, tools=tools, start=start))


def check_found(run, believed, true, askew):
    after = run.tables.kinematics
    for axis in after.sequence:
        before, is_ = believed.axis(axis.name), true.axis(axis.name)
        assert off_line(axis, is_) < FOUND
        assert abs(np.subtract(axis.centre, before.centre) @ before.direction) < 1e-9  # what is not seen is kept
        assert np.linalg.norm(np.cross(axis.direction, is_.direction)) < (1e-9 if askew else 1e-12)
        letter = "ABC".index(axis.name)
        assert run.variables[f"Q{144 + letter}"] < FOUND < run.variables[f"Q{141 + letter}"]


@pytest.mark.parametrize("name", CHAINS)
def test_random_machines(name):
    random = np.random.default_rng(451 + len(name))
    believed = machine(name, random)
    true = beside(believed, random)
    check_found(optimize(believed, true, random), believed, true, False)
    true = beside(believed, random, askew=1e-3)
    check_found(optimize(believed, true, random, mode=2), believed, true, True)


@pytest.mark.parametrize("name", NAMED)
def test_machines_with_a_name(name):
    random = np.random.default_rng(len(name))
    believed = kinematics_of(name)
    true = beside(believed, random)
    check_found(optimize(believed, true, random), believed, true, False)


DRILL = (
    "TOOL CALL 6 Z S1000\nL Z+100 FMAX M3\nCYCL DEF 200 D\nQ200=2\nQ201=-5\nQ206=100\nQ202=5\nQ210=0\nQ203=0\nQ204=20\nQ211=0\n"
    "L X+0 Y+0 FMAX M99\n"
)


@pytest.mark.parametrize(("name", "back", "leans"), [
    ("table-ac", "L A+0 C+0 FMAX\n", False), ("head-bc", "L B+0 C+0 FMAX\n", False),
    ("head-bc", "PLANE RESET TURN FMAX\nL C+180 FMAX\n", False), ("table-ac", "L A+0.1 C+0 FMAX\n", True),
])  # fmt: skip
def test_what_was_measured_does_not_lean_the_tool(name, back, leans):
    """C is 2e-4 rad off and the tool leans by twice that behind half a turn of it, in 3D-ROT of the cycle or by a head: no
    program has leant it. One that does is told of as before."""
    believed = kinematics_of(name)
    askew = believed.axis("C")
    true = believed.with_axis(replace(askew, direction=(2e-4, 0, 1)))
    tools = {TOOL: mnc.Tool(name="TCH PROBE", kind="probe", length=LENGTH, radius=BALL), 6: mnc.Tool(radius=3, length=100)}
    about = {"C": (-90, 180, 0, 4)}
    for then in (DRILL, cycle(451, about, Q406=0)):
        text = f"TOOL CALL {TOOL} Z\n{cycle(451, about, Q406=2)}{back}{then}"
        run = measured(text, sphere_setup(believed, true, tools=tools), ok=not leans)
        assert any("working plane, and it leans by 0.1" in alarm.message for alarm in run.alarms) == leans


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(12))
def test_a_hundred_machines(seed):
    random = np.random.default_rng(1000 + seed)
    for name in CHAINS:
        believed, mode = machine(name, random), 1 + seed % 2
        true = beside(believed, random, askew=2e-3 * (mode - 1))
        check_found(optimize(believed, true, random, mode), believed, true, mode == 2)


@pytest.mark.parametrize("name", ["table AC", "head CB", "head B, table C"])
def test_preset_compensation(name):
    """Axes and drift: afterwards the sphere is in the preset again, at any angles, and the table of the presets is as it was."""
    random = np.random.default_rng(452)
    believed = machine(name, random)
    drift = (0.31, -0.22, 0.13)
    true = replace(beside(believed, random), shift=drift)
    run = optimize(believed, true, random, code=452)
    after = run.tables.kinematics
    assert all(off_line(axis, true.axis(axis.name)) < FOUND for axis in after.sequence)
    assert np.allclose(results(run)[6:], np.negative(drift), atol=FOUND) and np.allclose(after.shift, drift, atol=FOUND)
    angles = np.zeros((50, 6))
    angles[:, :3] = random.uniform(-200, 200, (50, 3))
    for axis in after.sequence:
        angles[:, 3 + axis.number] = random.uniform(-70, 70, 50)
    one, other = after.forward(angles, 130.0)[0], true.forward(angles, 130.0)[0]
    assert np.abs(one - other).max() < FOUND  # the control knows where the tip is
    assert run.tables.presets[0][:3] == run.setup.presets[0]


def test_the_datum_of_the_machine():
    """Q406=3: the drift that all measurements share, beside places and directions."""
    random = np.random.default_rng(3)
    believed = machine("table AC", random)
    true = replace(beside(believed, random, askew=1e-3), shift=(0.1, 0.2, -0.3))
    run = optimize(believed, true, random, mode=3)
    assert np.allclose(run.tables.kinematics.shift, true.shift, atol=FOUND)
    assert all(off_line(axis, true.axis(axis.name)) < FOUND for axis in run.tables.kinematics.sequence)


def test_later_blocks_go_by_the_corrected_kinematics():
    """A place of the tilted plane is on the part where it should be, whatever the machine was believed to be."""
    believed = Kinematics(table=(Axis("C"),))
    true = Kinematics(table=(Axis("C", centre=(0.3, -0.2, 0)),))
    positions = {"C": (90, 270, 0, 3)}
    run = measured(f"{cycle(451, positions, Q408=100)}L X+10 Y+5 Z+40 R0 FMAX\n", sphere_setup(believed, true))
    axes = np.array(run.axes())[-1:]
    tip, _ = true.forward(axes, LENGTH)
    assert np.allclose(run.toolpath.end[-1] + run.toolpath.origin, tip[0], atol=1e-9)
    x, y, z = SPHERE
    assert np.allclose(tip[0], (x + 5, y - 10, z + 40), atol=1e-6)  # at C270 X of the plane lies along -Y of the part


def test_axes_stand_still_where_the_kinematics_is_corrected():
    believed = kinematics_of("head-bc")
    true = Kinematics(head=tuple(replace(axis, centre=tuple(np.add(axis.centre, 0.4))) for axis in believed.head))
    text = cycle(451, {"B": (-60, 60, 30, 3), "C": (90, 270, 45, 3)}) + "L Z+60 FMAX\n"
    run = measured(text, sphere_setup(believed, true))
    path, axes = run.toolpath, np.array(run.axes())
    (row,) = np.flatnonzero([path.labels[k].endswith("the kinematics is corrected") for k in path.label])
    assert path.kind[row] == Kind.STOP and np.linalg.norm(path.end[row] - path.start[row]) > 0.1  # the tip is elsewhere
    assert np.abs(axes[row] - axes[row - 1]).max() < 1e-9  # and no axis has moved
    assert (path.start[1:] == path.end[:-1]).all()
    assert run.tables.kinematics != run.setup.kinematics == path.kinematics


def test_an_explanation_tells_where_the_spindle_is():
    run = measured(cycle(451, {"C": (90, 270, 0, 3)}), sphere_setup(Kinematics(table=(Axis("C"),))))
    told = next(line for line in str(run.explain(line=2)).splitlines() if "spindle, machine coordinates" in line)
    assert "X0 Y150 Z184.5" in told  # C270 has brought the sphere from X150 to Y150


def test_backlash_is_measured_and_not_compensated():
    believed = Kinematics(table=(Axis("A", centre=(0, 0, -30)), Axis("C")))
    true = replace(believed, table=(replace(believed.table[0], backlash=0.02), replace(believed.table[1], backlash=0.008)))
    positions = {"A": (-60, 60, 20, 4), "C": (60, 300, 30, 4)}
    for words in ({"Q432": 0.5}, {"Q432": -0.5}, {"Q432": 0.5, "Q408": 250}):
        run = measured(cycle(451, positions, Q406=0, **words), sphere_setup(believed, true))
        found = [line.rpartition(" ")[2] for line in run.files["TCHPR451.TXT"].splitlines() if "backlash" in line]
        assert np.allclose([float(each) for each in found], [0.02, 0.008], atol=2e-6)


@pytest.mark.parametrize("name", ["table AC", "head CB", "head B, table C"])
def test_a_ball_beside_the_spindle_axis(name):
    """Its offset, which is known, turns with the head."""
    random = np.random.default_rng(5)
    believed = machine(name, random)
    true = beside(believed, random)
    probe = mnc.Probe(clearance=2, reach=10, offset=(0.4, -0.3))
    run = measured(cycle(451, around(believed, random), Q380=20), sphere_setup(believed, true, probe=probe))
    check_found(run, believed, true, False)


def test_a_probe_whose_length_is_not_known_finds_another_machine():
    """0.1 mm longer than its row of the tool table: a head axis is found where that would explain it."""
    believed = Kinematics(head=(Axis("B", centre=(0, 0, 150)),))
    longer = {TOOL: mnc.Tool(length=LENGTH + 0.1)}
    run = measured(cycle(451, {"B": (-60, 60, 0, 4)}), sphere_setup(believed, true_tools=longer))
    assert np.allclose(run.tables.kinematics.axis("B").centre, (0, 0, 150.1), atol=FOUND)


def test_an_axis_that_is_not_there_is_ignored():
    """Its positions are, and its results are -1."""
    believed = Kinematics(table=(Axis("C"),))
    run = measured(cycle(451, {"A": (-60, 60, 0, 4), "C": (90, 270, 0, 3)}), sphere_setup(believed))
    assert results(run)[:2] == results(run)[3:5] == [-1, -1] and results(run)[2] >= 0
    assert len(run.touches) == 4 * 5 and not run.toolpath.rotary[:, :2].any()


def test_presets_are_set_in_the_sphere():
    """From a place that is only near: before, after, and both; with a basic rotation, too."""
    believed, near = Kinematics(table=(Axis("C"),)), (SPHERE[0] + 0.8, SPHERE[1] - 0.6, SPHERE[2] + 1)
    true = Kinematics(table=(Axis("C", centre=(0.2, -0.1, 0)),))
    for mode in (1, 2, 3):
        datum = (*near, 0, 0, 0, 25.0)
        setup = sphere_setup(believed, true, preset=near, presets={0: datum})
        run = measured(cycle(451, {"C": (90, 270, 0, 3)}, Q431=mode), setup)
        assert np.allclose(run.tables.presets[0][:3], SPHERE, atol=FOUND)
        assert run.tables.presets[0].rotation == 25
        assert len(run.touches) == 5 * (4 + {1: 2, 2: 1, 3: 3}[mode])


def test_the_probe_ends_over_the_sphere_in_a_tilted_plane():
    """3D-ROT is active: Z of the program is the tool, and its datum the middle of the sphere."""
    believed = kinematics_of("table-ac")
    run = measured(cycle(451, {"A": (-60, 60, 0, 3), "C": (90, 270, 30, 2)}) + "L X+0 Y+0 Z+20 R0 FMAX\n", sphere_setup(believed))
    place = run.toolpath.end[-1] + run.toolpath.origin
    direction = believed.orientation(run.toolpath.rotary[-1])[:, 2]
    assert np.degrees(run.toolpath.rotary[-1]).round(9).tolist() == [0, 0, 270]
    assert np.allclose(place, SPHERE + 20 * direction, atol=1e-9)


def test_the_log_tells_what_was_found():
    true = Kinematics(table=(Axis("C", centre=(0.02, -0.01, 0)),))
    text = "BEGIN PGM SPHERE MM\n" + f"TOOL CALL {TOOL} Z\n" + cycle(451, {"C": (90, 270, 0, 3)}) + "END PGM SPHERE MM\n"
    run = measured(text, sphere_setup(Kinematics(table=(Axis("C"),), title="round table"), true, settings={"clock": 1e9}))
    told = {
        "Date": "09-09-2001", "Time": "1:46:40", "Kinematics": "round table", "Radius of the calibration sphere": "12.5000",
        "Mode": "1, optimize the position", "Start angle": "90.0000", "End angle": "270.0000", "Measuring points": "3",
        "Standard deviation": "0.036515", "Maximum error": "0.044721", "Averaged backlash": "not measured",
        "Measuring circle radius": f"{math.hypot(149.98, 0.01):.4f}", "Compensation": "X0.020000 Y-0.010000 Z0.000000",
        "Position before": "X0.000000 Y0.000000 Z0.000000", "Position after": "X0.020000 Y-0.010000 Z0.000000",
    }  # fmt: skip
    assert {what: logged(run, what) for what in told} == told
    sheet = [(each.what, round(each.nominal, 6), round(each.actual, 6)) for each in run.measurements]
    assert sheet == [("C scatter", 0, 0.036515), ("C X", 0, 0.02), ("C Y", 0, -0.01), ("C Z", 0, 0)]


def test_a_program_in_inches():
    """Results in its unit, the log in millimetres."""
    true = Kinematics(table=(Axis("C", centre=(0.0254, -0.0508, 0)),))
    text = cycle(451, {"C": (90, 270, 0, 3)}, Q407=12.5 / 25.4, Q253=100)
    program = f"BEGIN PGM I INCH\nTOOL CALL {TOOL} Z\n{text}END PGM I INCH\n"
    run = measured(program, sphere_setup(Kinematics(table=(Axis("C"),)), true))
    assert np.allclose(results(run)[6:], (0.001, -0.002, 0), atol=1e-9) and results(run)[0] == -1
    assert logged(run, "Compensation") == "X0.025400 Y-0.050800 Z0.000000"

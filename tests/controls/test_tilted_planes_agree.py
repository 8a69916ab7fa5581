"""The same plane, said on the TNC 620 and on the ISO mill, leads to the same positions of the machine; a probe there touches."""

import math

import numpy as np
import pytest

import mnclab
from mnclab import Datum, Setup, Tool

MACHINES = ("table-ac", "head-bc", "head-b-table-c")
TOOLS = {1: Tool(radius=5, length=80, kind="mill", centre_cutting=True), 2: Tool(radius=3, length=120, kind="probe")}
PLACE = Datum(100, 50, -20)
RANDOM = np.random.default_rng(6820)


def setup(machine, **more):
    return Setup(kinematics=machine, tools=TOOLS, datums={1: PLACE}, presets={1: PLACE}, start=(0, 0, 400), **more)


@pytest.mark.parametrize("machine", MACHINES)
def test_plane_euler_is_g68_2(machine):
    """PLANE EULER and G68.2 turn by the same three angles, the one about the preset, the other about X Y Z: said as a shift."""
    for _ in range(8):
        i, j, k = RANDOM.uniform(-180, 180), RANDOM.uniform(-80, 80), RANDOM.uniform(-180, 180)
        x, y, z = RANDOM.uniform(-30, 30, 3)
        klartext = (
            "BEGIN PGM P MM\nTOOL CALL 1 Z S1000\nCYCL DEF 247 DATUM SETTING Q339=1\nL X+0 Y+0 Z+150 R0 FMAX M3\n"
            f"TRANS DATUM AXIS X{x:+.9f} Y{y:+.9f} Z{z:+.9f}\n"
            f"PLANE EULER EULPR{i:+.9f} EULNU{j:+.9f} EULROT{k:+.9f} TURN FMAX\n"
            "L X+12 Y-7 Z+30 FMAX\nL Z+5 F200\nL X+40 Y+9\nEND PGM P MM\n"
        )
        iso = (
            "G21 G90 G54 T1 M6 S1000 M3\nG0 X0 Y0\nG43 H1 Z150\n"
            f"G68.2 X{x:.9f} Y{y:.9f} Z{z:.9f} I{i:.9f} J{j:.9f} K{k:.9f}\nG53.1\n"
            "G0 X12 Y-7 Z30\nG1 Z5 F200\nX40 Y9\nM30\n"
        )
        one, other = (
            mnclab.run(text, control, setup=setup(machine)) for text, control in ((klartext, "tnc-620"), (iso, "g43"))
        )
        assert one.ok and other.ok, (one.alarms, other.alarms)
        for back in (1, 2, 3):
            np.testing.assert_allclose(one.axes()[-back], other.axes()[-back], atol=1e-7)
        path = one.toolpath
        tip, direction = mnclab.machines()[machine].kinematics.forward(one.axes()[1:], 80.0)
        np.testing.assert_allclose(tip[-4:], (path.end + path.origin)[-4:], atol=1e-9)
        np.testing.assert_allclose(direction[-4:], path.directions[-4:], atol=1e-9)


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("led", [False, True])
def test_a_probe_touches_with_the_tool_tilted(machine, led):
    """The floor of a box, touched along the tool that leans by 30 degrees: the ball of radius 3 stands 3 mm above it, and the
    tip, the pole of the ball below on the tool, 3 (1 - cos 30) higher."""
    part = mnclab.part.box((0, 0, -60), (200, 100, -20))  # its top is Z0 of G54
    lean = "G68.2 J30\nG53.1\n"
    begin = "G43.4 H2\n" if led else ""
    text = f"G21 G90 G54 T2 M6\nG0 X20 Y20\nG43 H2 Z150\n{begin}{lean}G69\nG68.3 X0 Y0 Z0\nG0 X0 Y0\nG0 Z40\nG31 Z-90 F100\nM30\n"
    run = mnclab.run(text, "g43", setup=setup(machine, part=part))
    assert run.ok, run.alarms
    direction = run.toolpath.directions[-1]
    np.testing.assert_allclose(direction, [0, -math.sin(math.radians(30)), math.cos(math.radians(30))], atol=1e-9)
    tip = run.toolpath.end[-1]
    assert tip[2] == pytest.approx(3 - 3 * math.cos(math.radians(30)), abs=1e-7)
    np.testing.assert_allclose(tip + 3 * direction, [0, tip[1] - 3 * math.sin(math.radians(30)), 3], atol=1e-7)


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("lean", [0, 30, 45])
def test_the_skip_position_of_a_tilted_plane(machine, lean):
    """The ball of radius 3 touches the plane's own floor: its pole below stands at Z0 of the plane where the plane is that floor,
    and #5063 has the length offset on top (dialect fanuc)."""
    part = mnclab.part.box((0, 0, -60), (200, 100, -20))
    text = f"G21 G90 G54 T2 M6\nG43 H2 G0 X30 Y20 Z50\nG68.2 X30 Y20 Z0 J{lean}\nG53.1\nG0 X0 Y0 Z40\nG31 Z-10 F100\nM30\n"
    run = mnclab.run(text, "g43", setup=setup(machine, part=part))
    assert run.ok, run.alarms
    touched = 3 / math.cos(math.radians(lean)) - 3  # the centre stands 3 above the floor, the pole 3 before it along the tool
    found = [run.variables[f"#{number}"] for number in (5061, 5062, 5063)]
    np.testing.assert_allclose(found, [0, 0, touched + 120], atol=1e-6)

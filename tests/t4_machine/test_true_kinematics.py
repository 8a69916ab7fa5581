"""A machine whose axes are not where the control has them: where it starts, what a probe meets, what it is told."""

import math

import numpy as np
import pytest

import mnclab as mnc
from mnclab import Axis, Kinematics
from mnclab.machine.axes import reference
from mnclab.running.interpreter import Interpreter

LENGTH, BALL = 100.0, 2.0
TOOLS = {5: mnc.Tool(kind="probe", length=LENGTH, radius=BALL, number=5)}
CONTROL = mnc.controls["tnc-620"]


def machine(text, **setup):
    """The machine after a program, with the probe in its spindle."""
    program = mnc.read(f"TOOL CALL 5 Z\n{text}", "tnc-620")
    interpreter = Interpreter(CONTROL, mnc.Setup(**{"tools": TOOLS, "start": (0, 0, 500)} | setup), program)
    interpreter.run()
    return interpreter.machine


def test_the_axes_begin_at_home():
    """The tip is where the table has turned the part below it."""
    table = Kinematics(table=(Axis("A", centre=(0, 0, 50), home=90),))
    run = mnc.run("L Z+200 FMAX\n", "tnc-620", mnc.Setup(kinematics=table, start=(0, 0, 300)))
    assert np.allclose(run.toolpath[0].start, (0, -250, 50))  # 250 above the axis of A, turned onto -Y of the part
    axes = run.axes()
    assert axes.Z.tolist() == [200] and axes.A.tolist() == [90]


CASES = {
    "head": (Kinematics(head=(Axis("B", centre=(0, 0, 150)),)), Kinematics(head=(Axis("B", centre=(0.3, 0.1, 150.4)),))),
    "table": (Kinematics(table=(Axis("C"),)), Kinematics(table=(Axis("C", centre=(0.3, -0.4, 0)),))),
    "askew": (Kinematics(table=(Axis("C"),)), Kinematics(table=(Axis("C", direction=(0.01, -0.02, 1)),))),
    "shifted": (Kinematics(table=(Axis("C"),)), Kinematics(table=(Axis("C"),), shift=(0.1, 0.2, -0.3))),
}


@pytest.mark.parametrize("name", CASES)
def test_a_probe_meets_the_part_where_it_truly_is(name):
    """The ball touches where the true chain leads it from the axes; the control has it where its own chain says."""
    believed, true = CASES[name]
    angles = [0.0, 25.0 if "B" in believed.names else 0.0, 70.0 if "C" in believed.names else 0.0]
    centre = np.array([40.0, 30.0, 10.0])
    x, y, z = (believed.references(centre + (0, 0, 40), np.radians(angles), LENGTH) - (0, 0, LENGTH)).tolist()
    turns = "".join(f"L {letter}{angle:+g} FMAX\n" for letter, angle in zip("ABC", angles) if letter in believed.names)
    text = f"{turns}L X{x:+.6f} Y{y:+.6f} Z{z:+.6f} R0 FMAX\n"
    m = machine(text, kinematics=believed, true_kinematics=true, part=mnc.part.ball(tuple(centre), 25))
    contact = m.touch(z=z - 40, f=100.0)
    axes = np.array([[*reference(m), *angles]])
    (tip,), (up,) = true.forward(axes, LENGTH)
    assert np.linalg.norm(tip + BALL * up - centre) == pytest.approx(25 + BALL, abs=1e-8)
    (touch,) = m.touches
    assert np.allclose(touch.centre, tip + BALL * up, atol=1e-8)
    (tip,), (up,) = believed.forward(axes, LENGTH)
    assert np.allclose(m.tip, tip, atol=1e-9) and np.allclose(contact.machine_point, tip + BALL * up, atol=1e-9)


def test_backlash_stays_behind_on_either_side():
    """Half of it after C came from below, half the other way after it came from above; none while it never moved."""
    true = Kinematics(table=(Axis("C", backlash=0.2),))
    part = mnc.part.plane((100, -20, 0), (0, -1, 0))  # a wall along X
    found = []
    for come in ("", "L C+0.5 FMAX\nL C+0 FMAX\n", "L C-0.5 FMAX\nL C+0 FMAX\n"):
        believed = Kinematics(table=(Axis("C"),))
        m = machine(f"{come}L X+100 Y-30 Z-10 R0 FMAX\n", kinematics=believed, true_kinematics=true, part=part)
        found.append(m.touch(y=0, f=100.0).point[1])
    behind = math.radians(0.1)
    for sense, y in zip((0, 1, -1), found, strict=True):  # from the true place of the ball, (100, y) turned, to the wall
        turn = sense * behind
        assert 100 * math.sin(turn) + y * math.cos(turn) == pytest.approx(-20 - BALL, abs=1e-9)


def test_a_probe_in_a_tilted_head_goes_back_by_its_own_axes():
    """Deflection counts along the axes of the tool: with B at 90 degrees what lay along Z lies along X."""
    head = Kinematics(head=(Axis("B", centre=(0, 0, 150)),))
    probe = mnc.Probe(deflection=(0.0, 0.0, 0.01))
    wall = mnc.part.plane((300, 0, 0), (-1, 0, 0))
    m = machine("L B-90 FMAX\nL X+0 Y+0 Z+100 R0 FMAX\n", kinematics=head, part=wall, probe=probe)
    x = m.programmed[0]
    contact = m.touch(x=x + 200, f=100.0)
    assert contact.machine_point[0] == pytest.approx(300 - BALL + 0.01, abs=1e-9)

"""What a tool table holds for measuring a tool: read, printed, checked; a locked tool is not called."""

import math

import pytest

import mnclab as mnc
from mnclab.machine.setup_file import load

WORN = mnc.Wear(length=0.02, radius=0.03, break_radius=0.1, offset_radius=0, offset_length=5)


def test_a_file_tells_the_same_as_python(tmp_path):
    file = tmp_path / "setup.toml"
    file.write_text(
        "[tools.5]\nlocked = true\nradius = 5\n"
        "wear = { length = 0.02, radius = 0.03, break_radius = 0.1, offset_radius = 0, offset_length = 5 }\n"
        "[true_tools.5]\nrunout = [0.008, -0.005]\nedges = [[0.01, 0], [0, -0.02]]\n",
    )  # fmt: skip
    found = load(file)
    assert found.tools == {5: mnc.Tool(radius=5, locked=True, wear=WORN)}
    assert found.true_tools == {5: mnc.Tool(runout=(0.008, -0.005), edges=((0.01, 0), (0, -0.02)))}


def test_a_tool_and_its_page_tell_wear():
    tool = mnc.Tool(radius=5, wear=WORN, locked=True)
    told = "length=0.02, radius=0.03, break_radius=0.1, offset_length=5, offset_radius=0"
    assert repr(tool) == f"Tool(radius=5, wear=Wear({told}), locked=True)"
    assert "wear length 0.02 mm, wear radius 0.03 mm, wear break radius 0.1 mm" in repr(mnc.Setup(tools={5: tool}))


@pytest.mark.parametrize("wrong", [
    {"wear": 1}, {"locked": 1}, {"runout": 3}, {"edges": 3}, {"edges": (1, 2)}, {"edges": ((0, 0),), "teeth": 2},
])  # fmt: skip
def test_nonsense_of_a_tool_is_an_alarm(wrong):
    with pytest.raises(mnc.Alarm):
        mnc.Tool(radius=5, **wrong)


@pytest.mark.parametrize("name", ["length", "radius", "corner", "break_length", "break_radius"])
def test_a_tolerance_reaches_from_0_to_0_9999(name):
    """TNC 620 19.1."""
    assert mnc.Wear(**{name: 0.9999}) and mnc.Wear(**{name: 0})
    for wrong in (-0.0001, 1):
        with pytest.raises(mnc.Alarm, match=f"the {name} in the wear of a tool must be at "):
            mnc.Wear(**{name: wrong})


def test_a_locked_tool_is_not_called_again():
    """The manual locks it (19.1), and says no more; here a call is refused at its number."""
    tools = {1: mnc.Tool(radius=3, length=80, locked=True), 2: mnc.Tool(radius=3)}
    run = mnc.run("0 BEGIN PGM A MM\n1 TOOL CALL 2 Z S100\n2 TOOL CALL 1 Z\n3 END PGM A MM\n", "tnc-620", mnc.Setup(tools=tools))
    (alarm,) = run.alarms
    assert str(alarm).splitlines()[0].startswith("program:3:13: alarm: TOOL CALL cannot call T1: it is locked in the tool table")


@pytest.mark.parametrize(("true", "lower"), [
    (mnc.Tool(length=80.25), 0.25), (mnc.Tool(radius=1.5), 0.0), (mnc.Tool(radius=1.5, length=79.5), -0.5),
])  # fmt: skip
def test_what_is_not_said_of_a_true_tool_is_as_the_table_has_it(true, lower):
    """A tool that is longer than its row by `lower` cuts so much deeper than the 2 mm of the program."""
    tools = {3: mnc.Tool(radius=2, length=80, kind="mill")}
    setup = mnc.Setup(tools=tools, true_tools={3: true}, stock=((-10, -10, -90), (30, 10, -80)), start=(0, 0, 200))
    run = mnc.run("T3 S900 M3\nG0 X0 Y0 Z5\nG1 Z-82 F100\nG0 Z5\n", "mnc", setup)
    radius = true.radius or 2
    area = math.pi * radius**2
    assert run.workpiece().removed == pytest.approx(area * (2 + lower), rel=1e-3)

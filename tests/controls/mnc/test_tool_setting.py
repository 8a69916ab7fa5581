"""The laser tool setter (MNC 12.27 to 12.32): the examples worked out from its rules, beams and tools at random.

Numbers come from tests/authorities/catalogue/mnc-probing-tool-setting.json (moves of the spindle reference in machine
coordinates) and from arithmetic written here.
"""

import json
import math
import random
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setter, Setup, Tool

EXAMPLES = json.loads(
    (Path(__file__).parents[2] / "authorities" / "catalogue" / "mnc-probing-tool-setting.json").read_text(encoding="utf-8")
)
BEAM = Setter(x=500, y=120, z=-350.35, axis="X")
KNOWN = {"laser_x": 500, "laser_y": 120, "laser_z": -350.35, "laser_axis": 1}
REFERENCE = {1: Tool(radius=5, length=100)}


def run(text, tools=None, true=None, setter=BEAM, start=(0, 0, 0), **settings):
    settings = {"g53_tool_length": False, **settings}
    setup = Setup(tools=tools or REFERENCE, true_tools=true or {}, setter=setter, start=start, settings=settings)
    return mnclab.run(text, "mnc", setup)


def reference(found, tool):
    """The moves of the cycle: rapid or not, and where the spindle reference stands."""
    path = found.toolpath
    mine = (path.label != 0) & np.isin(path.kind, (Kind.RAPID, Kind.PROBE))
    return list(zip(path.kind[mine], (path.end[mine] + (0, 0, tool.effective_length)).tolist(), path.feed[mine]))


def agree(found, tool, moves):
    done = reference(found, tool)
    assert len(done) == len(moves)
    for (kind, place, feed), move in zip(done, moves):
        assert kind == (Kind.PROBE if move["move"] == "measure" else Kind.RAPID)
        assert place == pytest.approx([move["x"], move["y"], move["z"]], abs=1e-6)
        assert kind == Kind.RAPID or feed == 50


def tools_of(check):
    """The tool as the table has it, and as it is."""
    before, actual = check["tool_before"], check["actual"]
    dl, dr = before.get("length_correction", 0), before.get("radius_correction", 0)
    table = Tool(radius=before.get("radius", 6), length=before["length"], dl=dl, dr=dr, number=5)
    return table, Tool(radius=actual.get("radius", 6), length=actual["length"])


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: f"{example['code']} {example['title']}")
def test_examples(example):
    check, code = example["check"], example["code"]
    setter = BEAM
    if code == "G470":  # at X480 the beam is at -300, and rises by the slope
        beam = check["beam"]
        setter = Setter(x=beam["x"], y=beam["y"], z=beam["z_at_x"], axis="X", slope=beam["slope"])
    if "tool_before" in check:
        table, actual = tools_of(check)
        found = run(example["program"], {5: table}, {5: actual}, **check["settings"])
        row = found.tables.tools[5]
        names = {"length": row.length, "length_correction": row.dl, "radius": row.radius, "radius_correction": row.dr}
        for name, value in check["tool_after"].items():
            assert names[name] == pytest.approx(value, abs=1e-9), name
        for name in {"length", "radius"} - check["tool_after"].keys():
            assert names[name] == getattr(table, name)
        assert bool(found.alarms) is check.get("stop", False) and found.ok
        assert (Kind.STOP in found.toolpath.kind) is check.get("stop", False)
        if "deviation" in check:
            assert row.dl + row.dr == pytest.approx(check["deviation"])
        touches = [place for kind, place, _ in reference(found, table) if kind == Kind.PROBE]
        if "z_ref_trigger_machine" in check:
            assert touches[0][2] == pytest.approx(check["z_ref_trigger_machine"])
        if "w_plus_machine" in check:
            assert [place[1] for place in touches[-2:]] == pytest.approx([check["w_plus_machine"], check["w_minus_machine"]])
        speeds = found.toolpath.spindle[found.toolpath.kind == Kind.PROBE]
        assert set(speeds) == {12000} and found.toolpath.spindle[-1] == 0
        tool = table
    else:
        tool = Tool(radius=5, length=100)
        found = run(example["program"], {1: tool}, setter=setter, **check.get("settings", {}))
        told = found.measured
        for name in ("laser_x", "laser_y", "laser_z", "laser_axis", "angle"):
            if name in check:
                assert told[name] == pytest.approx(check[name], abs=5e-5 if name == "angle" else 1e-9)
        assert not found.alarms
    if code == "G470":
        assert found.measured["level"] == pytest.approx(check["deviation"])
        (report,) = found.files.values()
        assert list(found.files) == ["meas_prot/G470_0001.txt"]
        lines = ["z1 = -200.0000", "z2 = -199.9880", "deviation = 0.0120", "angle = 0.0172"]
        assert report.splitlines()[-len(lines) :] == lines and report.startswith("cycle = G470\n")
    if "moves_machine_ref" in check:
        agree(found, tool, check["moves_machine_ref"])


@pytest.mark.parametrize("seed", range(60))
def test_beams_and_tools_at_random(seed):
    """Calibrated by a reference tool, then tools are measured; the next block knows their length and radius."""
    dice = random.Random(seed)
    u = dice.uniform
    axis = "XY"[seed % 2]
    setter = Setter(u(-300, 300), u(-300, 300), u(-400, -200), axis=axis, off=(u(-2, 2), u(-2, 2), u(-2, 2)))
    x, y, z = setter.place
    pin, length = u(3, 20), u(40, 120)
    table = Tool(radius=u(2, 25), length=u(40, 150), dl=u(-0.2, 0.2), dr=u(-0.2, 0.2))
    actual = Tool(radius=table.radius + u(-0.5, 0.5), length=table.length + u(-1, 1))
    edges = tuple((u(-0.1, 0.1), u(-0.1, 0.1)) for _ in range(dice.randint(1, 5)))
    true = {1: Tool(radius=pin / 2, length=length), 5: replace(actual, edges=edges)}
    start = z + 160 + u(0, 50)
    head = f"T0\nG53 G00 X{x + u(-1, 1)} Y{y + u(-1, 1)} Z{start}\nT1\nG471 H{length}\n"
    head += f"G472 H{length} D{pin} Q{u(1, 9)} L{'XY'.index(axis) + 1}\n"
    tools = {1: Tool(radius=pin / 2, length=length + u(-1, 1)), 5: table}
    cycle = ("G480 P3 Q4", "G481 H5", "G482 D5 Q3")[seed % 3]
    found = run(f"{head}T0\nG53 G00 X{x + u(-9, 9)} Y{y + 3} Z{start + 60}\nT5\n{cycle}\nG0 X0 Y0\n", tools, true, setter)
    assert found.ok and not found.alarms, found.alarms
    told = found.measured
    w = "laser_y" if axis == "X" else "laser_x"
    assert told[w] == pytest.approx(y if axis == "X" else x, abs=1e-6)
    assert told["laser_z"] == pytest.approx(z, abs=1e-6)
    assert told["width of the beam"] == pytest.approx(0, abs=1e-6)
    sizes = actual.length + max(e[0] for e in edges), actual.radius + max(e[1] for e in edges)
    row = found.tables.tools[5]
    expected = [
        (sizes[0], 0, sizes[1], 0),
        (table.length, sizes[0] - table.length, table.radius, table.dr),
        (table.length, table.dl, table.radius, sizes[1] - table.radius),
    ][seed % 3]
    assert (row.length, row.dl, row.radius, row.dr) == pytest.approx(expected, abs=1e-6)
    path = found.toolpath
    assert path.radius[-1] == pytest.approx(expected[2] + expected[3], abs=1e-6)
    jump = [(end - begin)[2] for begin, end in zip(path.start[path.kind == Kind.TOOL], path.end[path.kind == Kind.TOOL])][-1]
    if seed % 3 < 2:
        assert jump == pytest.approx(table.effective_length - expected[0] - expected[1], abs=1e-6)
    assert path.end[-1, 2] + expected[0] + expected[1] == pytest.approx(start + 60, abs=1e-6)


@pytest.mark.parametrize("seed", range(20))
def test_levels_at_random(seed):
    """z2 - z1 is what the beam rises on the way; its angle counts along the positive axis."""
    u = random.Random(seed).uniform
    k, sense, distance, slope = seed % 2, seed // 2 % 2 * 2 - 1, u(10, 80), u(-0.01, 0.01)
    setter = Setter(u(-300, 300), u(-300, 300), u(-400, -200), axis="XY"[k], slope=slope)
    x, y, z = setter.place
    pin = {1: Tool(radius=u(2, 9), length=u(40, 120))}
    text = f"T0\nG53 G0 X{x} Y{y} Z{z + 200}\nT1\nG470 L{k + 1} K{sense} P{distance}\nG91 G0 X1\n"
    found = run(text, pin, {1: replace(pin[1], length=pin[1].length + u(-1, 1))}, setter)
    assert found.measured["level"] == pytest.approx(sense * distance * slope, abs=1e-6)
    assert found.measured["angle"] == pytest.approx(math.degrees(math.atan(slope)), abs=1e-7)
    end = np.array([x, y, z + 200 - pin[1].length]) + (1, 0, 0)
    end[k] += sense * distance
    assert found.toolpath.end[-1] == pytest.approx(end, abs=1e-6)


def test_the_level_of_a_beam_along_y_in_the_negative_direction():
    """It rises 0.001 for each mm of Y: from Y120 to Y90 it falls by 0.03; the angle is that along +Y."""
    setter = replace(BEAM, axis="Y", slope=0.001)
    found = run("T0\nG53 G0 X500 Y120 Z-150\nT1\nG470 L2 K-1 P30\n", setter=setter)
    assert found.measured["level"] == pytest.approx(-0.03)
    assert found.measured["angle"] == pytest.approx(math.degrees(math.atan(0.001)))
    assert found.toolpath.end[-1].tolist() == pytest.approx([500, 90, -250])


def test_the_reference_length_counts_and_not_that_of_the_table():
    found = run("T0\nG53 G0 X500 Y120 Z-150\nT1\nG471 H60\n")
    assert found.measured["laser_z"] == pytest.approx(-350.35 + 40)


def test_settings_of_the_laser():
    text = "T0\nG53 G0 X500 Y120 Z-150\nT1\nG480 P3 Q4\n"
    found = run(text, laser_clr=2, laser_feed=30, spindle_max=8000, **KNOWN)
    path = found.toolpath
    assert set(path.feed[path.kind == Kind.PROBE]) == {30} and set(path.spindle[path.kind == Kind.PROBE]) == {8000}
    ups = path.end[:, 2] - path.start[:, 2]
    assert ups[[label == path.labels.index("G480 back") for label in path.label]].max() == pytest.approx(2)
    (alarm,) = run(text, laser_search=50, **KNOWN).alarms
    assert "the tool setter did not trigger within 50 mm" in alarm.message


def test_the_spindle_keeps_its_speed():
    found = run("T0\nG53 G0 X500 Y120 Z-150\nT1 S700\nG481 H1\nM3\nG0 X0\n", **KNOWN)
    assert found.toolpath.spindle[-1] == 700


def test_a_wide_corner_or_a_point_is_measured_where_the_beam_is():
    """A corner of 3 mm, 1 mm below the beam: the radius there is 10 - 3 + sqrt(9 - 4)."""
    mill = {1: Tool(radius=10, corner=3, length=100)}
    text = "T0\nG53 G0 X500 Y120 Z-150\nT1\n"
    assert run(text + "G480 P2 Q1\n", mill, **KNOWN).measured["radius"] == pytest.approx(7 + math.sqrt(5))
    assert run(text + "G480 P2 Q3\n", mill, **KNOWN).measured["radius"] == pytest.approx(10)
    drill = {1: Tool(radius=5, angle=90, kind="drill", length=100)}
    assert run(text + "G480 P2 Q2\n", drill, **KNOWN).measured["radius"] == pytest.approx(2)
    assert run(text + "G480 P1\n", drill, **KNOWN).measured["length"] == pytest.approx(100)


BEFORE = "T0\nG53 G0 X500 Y120 Z-150\nT1\n"
REFUSED = [
    ("G470 L3 K1 P4", {}, (4, 6), "G470 L (axis that the beam lies along) must be one of 1, 2, got 3"),
    ("G470 L1 K2 P4", {}, (4, 9), "G470 K (way to the second point) must be one of -1, 1, got 2"),
    ("G470 L1 K1 P0", {}, (4, 12), "G470 P (distance of the two points) must be greater than 0, got 0"),
    ("G470 L1 K1", {}, (4, 1), "G470 P (distance of the two points) is missing"),
    ("G471 H-1", {}, (4, 6), "G471 H (length of the reference tool) must be at least 0, got -1"),
    ("G471", {}, (4, 1), "G471 H (length of the reference tool) is missing"),
    ("G472 H100 D0 Q5 L1", {}, (4, 11), "G472 D (diameter of the reference tool) must be greater than 0, got 0"),
    ("G472 H100 D10 Q0 L1", {}, (4, 15), "G472 Q (depth below the beam) must be greater than 0, got 0"),
    ("G472 H100 D10 Q5 L1", {}, (4, 1), "G472 needs laser_z of the tool setter: G471 finds it, or the setting says it"),
    ("G480 P4", KNOWN, (4, 6), "G480 P (what is measured) must be one of 1, 2, 3, got 4"),
    ("G480 P2", KNOWN, (4, 1), "G480 Q (depth below the beam for the radius) is missing: P2 needs it"),
    ("G480 P2 Q0", KNOWN, (4, 9), "G480 Q (depth below the beam for the radius) must be greater than 0, got 0"),
    ("G480 P1 L2", KNOWN, (4, 9), "G480 L (axis that the beam lies along) must be 1, the axis that G472 stored, got 2"),
    ("G480 P1", {}, (4, 1), "G480 needs laser_z of the tool setter: G471 finds it, or the setting says it"),
    ("G480 P1", {"laser_z": 0}, (4, 1), "G480 needs laser_x of the tool setter: G472 finds it, or the setting says it"),
    ("G481 H-1", KNOWN, (4, 6), "G481 H (permissible deviation of the length) must be at least 0, got -1"),
    ("G482 D1", KNOWN, (4, 1), "G482 Q (depth below the beam) is missing"),
    ("G482 D-1 Q3", KNOWN, (4, 6), "G482 D (permissible deviation of the radius) must be at least 0, got -1"),
]


@pytest.mark.parametrize(("block", "settings", "place", "sentence"), REFUSED)
def test_what_is_refused(block, settings, place, sentence):
    (alarm,) = run(f"{BEFORE}{block}\n", **settings).alarms
    assert alarm.message == sentence and (alarm.span.line, alarm.span.column) == place


@pytest.mark.parametrize(
    ("before", "sentence"),
    [
        ("G37 X2 Y2", "G471 cannot run while a scaling is active"),
        ("G51 X0", "G471 cannot run while a mirror is active"),
        ("G404 E10", "G471 cannot run while a base rotation is active"),
        ("G18", "G471 needs the plane G17, G18 is active"),
        ("T0", "G471 needs a tool in the spindle"),
        ("T6", "G471 needs a tool in the spindle, T6 is a probe"),
        ("T5 D1", "G471 needs T5 with its own corrector: write T without D before it"),
        ("G41 G1 X600 F100", "G471 cannot run under radius compensation"),
    ],
)
def test_what_the_machine_refuses(before, sentence):
    tools = {**REFERENCE, 5: Tool(radius=2, length=90), 6: Tool(radius=2, length=90, kind="probe")}
    found = run(f"{BEFORE}{before}\nG471 H100\n", tools)
    assert [alarm.message for alarm in found.alarms if alarm.severity == "alarm"] == [sentence]


def test_a_setter_must_be_there():
    for setter in (None, Setter()):
        (alarm,) = run(f"{BEFORE}G471 H100\n", setter=setter).alarms
        assert alarm.message == "G471 needs a tool setter, a laser beam: Setup(setter=mnclab.Setter(…))"
    (alarm,) = run(f"{BEFORE}G482 D1 Q4\n", {1: Tool(length=100)}, **KNOWN).alarms
    assert alarm.message == "G482 needs the radius of T1 in the tool table"


def test_a_tool_at_the_beam_already_and_one_beside_it():
    (alarm,) = run("T0\nG53 G0 X500 Y120 Z-260\nT1\nG471 H100\n").alarms
    assert "the tool has reached the tool setter before it is measured" in alarm.message
    (alarm,) = run("T0\nG53 G0 X500 Y126 Z-150\nT1\nG471 H100\n").alarms
    assert "the tool setter did not trigger within 300 mm" in alarm.message


@pytest.mark.parametrize("cycle", ["G480 P1", "G481 H0.1", "G482 D0.1 Q5"])
def test_a_tool_that_stands_below_the_beam_is_told(cycle):
    """12.30: it is put above the level of the beam by hand. The beam is at -350.35; the tip of 100 mm at -360.35, at -350.25."""
    for z, ok in ((-260.35, False), (-250.25, True)):
        found = run(f"T1\nG53 G0 X100 Y100 Z{z}\n{cycle}\n", **KNOWN)
        assert found.ok == ok, found.alarms
    low = run(f"T1\nG53 G0 X100 Y100 Z-260.35\n{cycle}\n", **KNOWN)
    assert "begins above the beam, which is at Z-350.35 of the machine: the tip is at Z-360.35" in str(low.alarms[0])
    assert str(low.alarms[0]).startswith("program:3:1: ")

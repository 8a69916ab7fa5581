"""Tool measurement (TNC 620, chapter 19): the manual's examples and those worked out from its rules, and tools at random.

Numbers come from tests/authorities/catalogue/tnc620-tool-measurement.json (z of the spindle reference, machine coordinates)
and from arithmetic written here.
"""

import json
import random
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setter, Setup, Tool, Wear
from mnclab.controls.tnc_620.probing.tool_setter import status
from mnclab.machining.steps import Orient

EXAMPLES = json.loads(
    (Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-tool-measurement.json").read_text(encoding="utf-8")
)
TRUE = Setter(x=300, y=200, z=-400, diameter=40, off=(0.12, 0.08, 0.05))  # of the catalogue's calibration
CALIBRATING = Tool(radius=6, length=80)
MODES = {"old": "TCH PROBE {old}.0 X\nTCH PROBE {old}.1 CHECK: {mode} q5\nTCH PROBE {old}.2 HEIGHT: {height}\n"
                "TCH PROBE {old}.3 PROBING THE TEETH: {teeth}\n",
         "new": "TCH PROBE {new} X\nQ340={mode}\nQ260={height}\nQ341={teeth}\n"}  # fmt: skip


def case(code, title):
    (found,) = (each["check"] for each in EXAMPLES if each["code"] == code and each["title"].startswith(title))
    return found


def run(text, tool, true=None, setter=TRUE, number=12, start=(0, 0, 0), inch=False, **settings):
    """A program with the tool, on a TT that was calibrated before."""
    settings = {"tt_calibrated": True, **settings}
    true_tools = {} if true is None else {number: true}
    setup = Setup(tools={number: tool}, true_tools=true_tools, setter=setter, start=start, settings=settings)
    unit = "INCH" if inch else "MM"
    return mnclab.run(f"0 BEGIN PGM P {unit}\nTOOL CALL {number} Z\n{text}END PGM P {unit}\n", "tnc-620", setup)


def measure(code, tool, true, mode, teeth=0, height=-360, **more):
    old = int(code.split()[-1])
    form = MODES["old" if old < 100 else "new"]
    return run(form.format(old=old, new=old, mode=mode, teeth=teeth, height=height), tool, true, **more)


def probes(found, length):
    """The ends of the touches: x, y, and z of the spindle reference."""
    path = found.toolpath
    return path.end[path.kind == Kind.PROBE] + (0, 0, length)


def with_edges(sizes, tool, what):
    """The tool as it is: the sizes of its edges."""
    deviations = [size - getattr(tool, what) for size in sizes]
    return replace(tool, edges=tuple((d, 0.0) if what == "length" else (0.0, d) for d in deviations))


@pytest.mark.parametrize("how", ["ConstantTolerance", "VariableTolerance", "ConstantFeed"])
@pytest.mark.parametrize("row", case("TT spindle speed and probing feed", "speeds")["rows"], ids=lambda row: str(row["r"]))
def test_speed_and_feed_of_a_turning_tool(row, how):
    tool = Tool(radius=row["r"], length=100, wear=Wear(offset_radius=1))  # beside the middle, so that it turns
    path = measure("TCH PROBE 481", tool, None, 2, probing_feed_calc=how).toolpath
    (probe,) = np.flatnonzero(path.kind == Kind.PROBE)
    assert path.spindle[probe] == pytest.approx(-row["n"], abs=6e-5)  # right-hand edges cut with M3: it turns the other way
    assert path.feed[probe] == pytest.approx(row[how]["feed"], abs=6e-5)


def test_a_left_hand_tool_turns_the_other_way_and_a_slow_spindle_limits():
    tool = Tool(radius=10, length=100, hand="left", teeth=2)
    setup = Setup(tools={12: tool}, setter=TRUE, limits=mnclab.Limits(spindle=1000), settings={"tt_calibrated": True})
    path = mnclab.run("TOOL CALL 12 Z\nTCH PROBE 482 X\nQ340=2\nQ260=-360\nQ341=0\n", "tnc-620", setup).toolpath
    (probe,) = np.flatnonzero(path.kind == Kind.PROBE)
    assert (path.spindle[probe], path.feed[probe]) == (1000, pytest.approx(5.0))  # 0.005 mm * 1000 rev/min


def test_a_standing_tool_has_the_probing_feed():
    check = case("TT spindle speed and probing feed", "stationary")
    path = measure("TCH PROBE 481", Tool(radius=4, length=80, wear=Wear(offset_radius=0)), None, 2).toolpath
    (probe,) = np.flatnonzero(path.kind == Kind.PROBE)
    assert (path.spindle[probe], path.feed[probe]) == (check["n"], check["feed"])


@pytest.mark.parametrize("row", case("TT geometry", "height")["rows"], ids=lambda row: str(row["Q260"]))
def test_height_of_the_first_approach(row):
    """The upper side at 100 in the active preset, which lies at Z -500."""
    setter, tool = Setter(x=300, y=200, z=-400), Tool(radius=6, length=80)
    setup = Setup(tools={1: tool}, setter=setter, presets={0: (10, 20, -500)}, settings={"tt_calibrated": True})
    text = f"TOOL CALL 1 Z\nTCH PROBE 481 X\nQ340=2\nQ260={row['Q260']}\nQ341=0\n"
    for before in ("", "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+5\nCYCL DEF 7.2 Z-30\n"):  # a shift does not matter
        path = mnclab.run(before + text, "tnc-620", setup).toolpath
        (above, *_) = np.flatnonzero(path.kind == Kind.RAPID)
        assert path.end[above, 2] == pytest.approx(row["tip"])  # the path counts from the preset


@pytest.mark.parametrize("row", case("TT geometry", "ball")["rows"], ids=lambda row: f"L-OFFS {row['L_OFFS']}")
def test_a_ball_is_measured_where_l_offs_says(row):
    tool = Tool(radius=5, corner=5, length=90, teeth=4, wear=Wear(offset_length=row["L_OFFS"], offset_radius=0))
    found = measure("TCH PROBE 482", tool, None, 2, offset_tool_axis=2)
    assert found.measured["radius"] == pytest.approx(row["measured_radius"], abs=1e-6)
    assert probes(found, 0)[0, 2] == pytest.approx(-399.95 - row["h"])


@pytest.mark.parametrize("row", case("TT geometry", "offset")["rows"], ids=lambda row: row["tool"])
def test_where_the_length_is_measured(row):
    radius = float(row["tool"].split()[-1])
    tool = Tool(radius=radius, length=80, corner=radius * (row["tool"][:4] == "ball"), wear=Wear(offset_radius=row["R_OFFS"]))
    assert probes(measure("TCH PROBE 31", tool, None, 2), 80)[0] == pytest.approx((row["x"], 200.08, -319.95))


@pytest.mark.parametrize("row", case("TT wear and breakage status", "status")["rows"], ids=lambda row: str(row["deviation"]))
def test_status_and_lock(row):
    tool = Tool(radius=4, length=80, wear=Wear(length=0.02, break_length=0.05, offset_radius=0))
    found = measure("TCH PROBE 481", tool, replace(tool, length=80 + row["deviation"]), 1)
    assert found.variables["Q199"] == row["status"]
    assert found.tables.tools[12].locked is row["locked"]
    assert bool(found.alarms) is row["locked"] and found.ok  # a warning says so


def test_nothing_is_watched_without_tolerances():
    check = case("TT wear and breakage status", "no tolerance")
    tool = Tool(radius=4, length=80, wear=Wear(offset_radius=0))
    found = measure("TCH PROBE 481", tool, replace(tool, length=80 + check["deviation"]), 1)
    assert (found.variables["Q199"], found.tables.tools[12].locked) == (check["status"], check["locked"])
    assert status(0.3, 0.0, 0.2) == 2 and status(0.3, 0.2, 0.0) == 1


def calibrated(code):
    """The program of the catalogue's calibration, the tool above the TT."""
    words = {30: "TCH PROBE 30.0 X\nTCH PROBE 30.1 HEIGHT: -360\n", 480: "TCH PROBE 480 X\nQ260=-360\n",
             484: "TCH PROBE 484 X\nQ536=1\n"}[code]  # fmt: skip
    true = replace(CALIBRATING, runout=(0.008, -0.005))
    return run(words, CALIBRATING, true, number=1, start=(300, 200, -280), tt_calibrated=False)


@pytest.mark.parametrize("code", [30, 480, 484])
def test_calibration(code):
    check = case(f"TCH PROBE {code}", "fully" if code == 484 else "calibration")
    found = calibrated(code)
    assert not [alarm for alarm in found.alarms if alarm.severity == "alarm"]
    ends = probes(found, 80)
    assert ends[0] == pytest.approx((300, 200, check["z_nose_at_contact"]))
    assert ends[[1, 3, 2, 4], :2] == pytest.approx(np.array(check["contacts_0"]), abs=1e-6)
    assert ends[[5, 7, 6, 8], :2] == pytest.approx(np.array(check["contacts_180"]), abs=1e-6)
    told = found.measured
    assert (told["TT X"], told["TT Y"]) == pytest.approx(check["center"], abs=1e-6)
    assert (told["TT Z"], told["TT radius"]) == pytest.approx((check["z_top"], check["R_tt"]), abs=1e-6)
    assert (told["runout X"], told["runout Y"]) == pytest.approx(check["misalignment"], abs=1e-6)
    path = found.toolpath
    beside = np.flatnonzero(path.label == path.labels.index(f"TCH PROBE {code} beside the TT"))
    assert path.end[beside[0], 0] - check["nominal_center"][0] == pytest.approx(check["start_distance_in_plane"])
    assert check["start_distance_in_plane"] - check["R_tt"] - check["tool"]["R"] == check["start_gap_to_stylus"]
    assert path.end[-1, :2] == pytest.approx(check["center"], abs=1e-6)
    high = check["z_top"] + check["set_up_clearance"] if code != 484 else -360
    assert path.end[-1, 2] == pytest.approx(high, abs=1e-6)


def test_484_stops_for_the_operator_and_wants_a_thick_tool():
    assert case("TCH PROBE 484", "Example")["stop"] is True
    text = "TCH PROBE 484 CALIBRARE TT\nQ536=+0 ;STOP INAINTE DE EXE.\n"
    found = run(text, CALIBRATING, number=1, tt_calibrated=False)
    assert Kind.STOP in found.toolpath.kind
    assert found.measured["TT X"] == pytest.approx(300.12)
    assert [alarm.message for alarm in found.alarms] == [
        "TCH PROBE 484 wants a calibrating tool thicker than 15 mm: one of 12 mm may bend"
    ]
    assert not run(text, Tool(radius=7.6, length=80), number=1).alarms


def measured(code, check, tool, what):
    true = with_edges(check["true_teeth"], tool, what) if len(check["true_teeth"]) > 1 else None
    true = true or replace(tool, **{what: check["true_teeth"][0]})
    return measure(code, tool, true, check["CHECK"], check["PROBING_THE_TEETH"])


def agrees(found, check, code, what):
    row, delta, parameter = found.tables.tools[12], {"length": "dl", "radius": "dr"}[what], {"length": "Q115", "radius": "Q116"}
    assert found.measured[what] == pytest.approx(check["measured"], abs=1e-6)
    assert getattr(row, what) == pytest.approx(check["stored_after"], abs=1e-6)
    if "delta_after" in check:
        assert getattr(row, delta) == pytest.approx(check["delta_after"], abs=1e-6)
    assert found.variables[parameter[what]] == pytest.approx(check.get("deviation", 0), abs=1e-6)
    assert found.variables["Q5" if code in ("TCH PROBE 31", "TCH PROBE 32") else "Q199"] == check["status"]
    assert row.locked is check.get("locked", False)
    path = found.toolpath
    if "n" in check:
        speeds = path.spindle[path.kind == Kind.PROBE]
        assert abs(speeds[0]) == pytest.approx(check["n"], abs=6e-5)
    if "orientations" in check:
        setup = Setup(tools={1: row, 12: row}, setter=TRUE, settings={"tt_calibrated": True})
        table = mnclab.steps(code, "tnc-620", setup, mode=2, teeth=1)
        assert [step.angle for step in table if isinstance(step, Orient)] == check["orientations"]


@pytest.mark.parametrize("title", ["first", "inspection", "check only", "individual"])
@pytest.mark.parametrize("code", ["TCH PROBE 31", "TCH PROBE 481"])
def test_lengths(code, title):
    """A milling cutter of radius 31.5 with four teeth, and a drill of radius 4 that stands over the middle."""
    check = case(code, title)
    tool = Tool(radius=31.5, length=100, teeth=4) if check["stored"] == 100 or title == "first" else Tool(radius=4, length=80)
    tool = replace(tool, wear=Wear(length=0.02, break_length=0.05, offset_radius=None if tool.teeth else 0))
    found = measured(code, check, tool, "length")
    agrees(found, check, code, "length")
    if "z_nose" in check:
        (end,) = probes(found, tool.length)[:1]
        assert (end[0], end[2]) == pytest.approx((check["x"], check["z_nose"]), abs=1e-6)


@pytest.mark.parametrize("title", ["first", "inspection, in", "inspection, worn", "individual"])
@pytest.mark.parametrize("code", ["TCH PROBE 32", "TCH PROBE 482"])
def test_radii(code, title):
    check = case(code, title)
    tool = Tool(radius=10, length=100, teeth=4, wear=Wear(radius=0.02, break_radius=0.1))
    found = measured(code, check, tool, "radius")
    agrees(found, check, code, "radius")
    if "x" in check:
        assert probes(found, 0)[0] == pytest.approx((check["x"], 200.08, check.get("tip", -404.95)), abs=1e-6)


@pytest.mark.parametrize("code", ["TCH PROBE 33", "TCH PROBE 483"])
def test_length_and_radius(code):
    tool = Tool(radius=10, length=100, teeth=4, wear=Wear(length=0.02, break_length=0.1, radius=0.02, break_radius=0.1))
    name = "Q5" if code == "TCH PROBE 33" else "Q199"
    check = case(code, "inspection of radius")
    found = measure(code, tool, replace(tool, length=100.01, radius=9.95), 1)
    row = found.tables.tools[12]
    assert (row.length, row.radius) == (100, 10)
    assert (row.dl, row.dr) == pytest.approx((check["delta_after"]["DL"], check["delta_after"]["DR"]))
    assert (found.variables["Q115"], found.variables["Q116"]) == pytest.approx((check["Q115"], check["Q116"]))
    assert (found.variables[name], row.locked) == (check["status"], check["locked"])
    radius, length = probes(found, 100)
    assert radius[0] == pytest.approx(check["x_radius"]) and length[2] == pytest.approx(check["z_nose"])
    assert [row.what for row in found.measurements] == check["order"]
    check = case(code, "first")
    row = measure(code, tool, replace(tool, length=99.98, radius=10.004), 0).tables.tools[12]
    assert (row.length, row.radius) == pytest.approx((check["stored_after"]["L"], check["stored_after"]["R"]))
    assert (row.dl, row.dr, row.locked) == (0, 0, False)
    check = case(code, "length broken")
    found = measure(code, tool, replace(tool, length=99.7, radius=10.001), 1)
    assert (found.variables[name], found.tables.tools[12].locked) == (check["status"], check["locked"])


PRINTED = [each for each in EXAMPLES if each["program"] and each["code"] != "TCH PROBE 484"]


@pytest.mark.parametrize("example", PRINTED, ids=lambda each: f"{each['code']} {each['title'][:20]}")
def test_programs_as_they_are_printed(example):
    """They run; with the TT at -40 in the preset, the heights 90 to 120 are those of the tip at first."""
    tool = Tool(radius=25, length=100, teeth=4, wear=Wear(length=0.02, radius=0.02))
    setter = Setter(x=300, y=200, z=-40)
    tools = {1: CALIBRATING, 12: tool}
    setup = Setup(tools=tools, setter=setter, settings={"tt_calibrated": True}, true_tools={12: replace(tool, length=100.01)})
    found = mnclab.run(f"0 BEGIN PGM P MM\n{example['program']}\n99 END PGM P MM\n", "tnc-620", setup)
    assert found.ok, found.alarms
    given = example["check"]["parameters"]
    path = found.toolpath
    rapid = path.end[path.kind == Kind.RAPID]
    assert rapid[0, 2] == pytest.approx(given.get("HEIGHT", given.get("Q260")))
    if "status_parameter" in given:
        assert given["status_parameter"] in found.variables
    assert "Q5" not in found.variables or "status_parameter" in given
    if (mode := given.get("CHECK", given.get("Q340"))) is not None:
        length = "length" in found.measured
        assert found.tables.tools[12].length == pytest.approx(100.01 if mode == 0 and length else 100)
        assert found.tables.tools[12].dl == pytest.approx(0.01 if mode == 1 and length else 0)
        teeth = given.get("PROBING_THE_TEETH", given.get("Q341"))
        assert len(found.measurements) == (2 if example["code"][-1] == "3" else 1) * (5 if teeth else 1)


def random_case(seed):
    """A TT, a tool as its table has it, and as it is."""
    dice = random.Random(seed)
    u = dice.uniform
    setter = Setter(u(-500, 500), u(-500, 500), u(-500, 0), u(15, 60), off=(u(-1, 1), u(-1, 1), u(-1, 1)))
    radius = u(2, 40)
    teeth = dice.randint(2, 6)
    table = Tool(radius=radius, length=u(50, 200), teeth=teeth, dl=u(-0.1, 0.1), dr=u(-0.1, 0.1))
    away = setter.diameter / 2 + radius * 0.7  # one tooth on the TT, its neighbours beside it
    table = replace(table, wear=Wear(offset_radius=away))
    edges = tuple((u(-0.2, 0.2), u(-0.2, 0.2)) for _ in range(teeth))
    true = replace(table, length=table.length + u(-1, 1), radius=radius + u(-0.3, 0.3), dl=0, dr=0, edges=edges)
    return dice, setter, table, true


@pytest.mark.parametrize("code", [31, 32, 33, 481, 482, 483])
@pytest.mark.parametrize("seed", range(20))
def test_tools_at_random(seed, code):
    """Length and radius are those of the longest edge, each tooth has its own; the next block knows the new sizes."""
    dice, setter, table, true = random_case(seed)
    teeth, mode, what = seed % 2, seed % 3, {1: ("length",), 2: ("radius",), 3: ("radius", "length")}[code % 10]
    text = MODES["old" if code < 100 else "new"].format(old=code, new=code, mode=mode, height=setter.z + 150, teeth=teeth)
    found = run(text + "L Z+0 R0 FMAX M91\n", table, true, setter, start=(0, 0, 400))
    edges = {name: [getattr(true, name) + edge[k] for edge in true.edges] for k, name in enumerate(("length", "radius"))}
    assert found.ok, found.alarms
    rows = {row.what: row.actual for row in found.measurements}
    expected = {name: {0: (max(edges[name]), 0.0), 1: (getattr(table, name), max(edges[name]) - getattr(table, name))}.get(mode)
                for name in what}  # fmt: skip
    for name in what:
        assert found.measured[name] == pytest.approx(max(edges[name]), abs=1e-6)
        assert [rows.get(f"{name} of tooth {k + 1}") for k in range(table.teeth)] == (
            pytest.approx(edges[name], abs=1e-6) if teeth else [None] * table.teeth
        )
    row = found.tables.tools[12]
    for name, delta in (("length", "dl"), ("radius", "dr")):
        sizes = expected.get(name) or (getattr(table, name), getattr(table, delta))
        assert (getattr(row, name), getattr(row, delta)) == pytest.approx(sizes, abs=1e-6)
    path = found.toolpath
    assert path.radius[-1] == pytest.approx(row.effective_radius, abs=1e-6)
    assert path.start[1:] == pytest.approx(path.end[:-1], abs=1e-9)
    jumps = (path.end - path.start)[path.kind == Kind.TOOL][1:, 2]  # the first one is the call
    assert jumps.sum() == pytest.approx(table.effective_length - row.effective_length, abs=1e-6)
    assert path.end[-1, 2] == pytest.approx(-row.effective_length, abs=1e-6)  # the spindle reference at 0: by the new length


@pytest.mark.parametrize("code", [30, 480, 484])
@pytest.mark.parametrize("seed", range(20))
def test_calibrations_at_random(seed, code):
    """The TT is found where it is, whatever the tool runs out by, and the next tool is measured there."""
    dice, setter, table, true = random_case(seed)
    pin = Tool(radius=dice.uniform(8, 20), length=dice.uniform(50, 120))
    x, y = dice.uniform(-0.05, 0.05), dice.uniform(-0.05, 0.05)
    start = (setter.x + dice.uniform(-3, 3), setter.y + dice.uniform(-3, 3), setter.z + 150 + pin.length)
    setup = Setup(tools={1: pin, 12: table}, true_tools={1: replace(pin, runout=(x, y)), 12: true}, setter=setter, start=start)
    words = {30: f"30.0 X\nTCH PROBE 30.1 HEIGHT: {setter.z + 150}", 480: f"480 X\nQ260={setter.z + 150}", 484: "484 X\nQ536=1"}
    text = f"TOOL CALL 1 Z\nTCH PROBE {words[code]}\nTOOL CALL 12 Z\n"
    found = mnclab.run(text + MODES["new"].format(new=483, mode=2, height=setter.z + 150, teeth=0), "tnc-620", setup)
    assert found.ok, found.alarms
    told = found.measured
    assert (told["TT X"], told["TT Y"], told["TT Z"]) == pytest.approx(setter.place, abs=1e-6)
    assert (told["TT radius"], told["runout X"], told["runout Y"]) == pytest.approx((setter.diameter / 2, x, y), abs=1e-6)
    assert told["radius"] == pytest.approx(true.radius + max(edge[1] for edge in true.edges), abs=1e-6)
    assert told["length"] == pytest.approx(true.length + max(edge[0] for edge in true.edges), abs=1e-6)


def test_a_tool_that_runs_out_is_wider_while_it_turns():
    tool = Tool(radius=10, length=100, teeth=4)
    found = measure("TCH PROBE 482", tool, replace(tool, runout=(0.03, 0.04)), 2)
    assert found.measured["radius"] == pytest.approx(10.05)
    assert measure("TCH PROBE 482", replace(tool, teeth=0), replace(tool, teeth=0), 2).measured["radius"] == pytest.approx(10)


def test_deltas_of_the_call_stay_beside_those_that_are_measured():
    tool = Tool(radius=10, length=100, wear=Wear(offset_radius=0))
    setup = Setup(tools={12: tool}, true_tools={12: replace(tool, length=100.02)}, setter=TRUE, settings={"tt_calibrated": True})
    text = "TOOL CALL 12 Z DL+0.5 DR+0.1\n" + MODES["new"].format(new=481, mode=1, height=-360, teeth=0)
    found = mnclab.run(text, "tnc-620", setup)
    assert found.tables.tools[12].dl == pytest.approx(0.02)
    jump = found.toolpath[found.toolpath.kind == Kind.TOOL][-1]
    assert (jump.end - jump.start)[2] == pytest.approx(-0.02)
    assert found.toolpath.radius[-1] == pytest.approx(10.1)


def test_an_inch_program_has_inches():
    tool = Tool(radius=10, length=100, wear=Wear(offset_radius=0))
    true = replace(tool, length=100.254)
    for form in MODES.values():
        found = run(form.format(old=31, new=481, mode=1, height=-14, teeth=0), tool, true, inch=True)
        assert found.variables["Q115"] == pytest.approx(0.01)  # 0.254 mm
        path = found.toolpath
        assert path.end[path.kind == Kind.RAPID][0, 2] == pytest.approx(-14 * 25.4)


def test_several_teeth_at_once_are_told():
    tool = Tool(radius=10, length=100, teeth=4)
    found = measure("TCH PROBE 481", tool, with_edges([100, 99.9, 100.1, 100], tool, "length"), 2, teeth=1)
    assert [alarm.message for alarm in found.alarms] == [
        "TCH PROBE 481 lays several teeth on the TT at once: the longest of them counts"
    ]
    assert [row.actual for row in found.measurements] == pytest.approx([100.1] * 5)


MILL = Tool(radius=10, length=100, teeth=4)
ALL = {"mode": 1, "height": -360, "teeth": 0}
REFUSED = [
    (481, {"mode": 3}, {}, "Q340 (what becomes of the measured values) must be one of 0, 1, 2, got 3"),
    (482, {"teeth": 2}, {}, "Q341 (whether each tooth is measured) must be one of 0, 1, got 2"),
    (483, {"height": 100000}, {}, "Q260 (clearance height) must be at least -99999.9999 and at most 99999.9999, got 100000"),
    (481, {"teeth": 1}, {"tool": replace(MILL, teeth=21)}, "needs 1 to 20 teeth in the tool table (CUT), T12 has 21"),
    (482, {"teeth": 1}, {"tool": replace(MILL, teeth=0)}, "needs 1 to 20 teeth in the tool table (CUT), T12 has 0"),
    (481, {}, {"tool": replace(MILL, length=0)}, "needs the length of T12 in the tool table"),
    (481, {}, {"tool": replace(MILL, radius=0)}, "needs the radius of T12 in the tool table"),
    (481, {}, {"tool": replace(MILL, kind="probe")}, "needs a tool in the spindle, T12 is a probe"),
    (481, {}, {"setter": None}, "needs a tool setter, a plate: Setup(setter=mnclab.Setter(…))"),
    (481, {}, {"setter": Setter(axis="X")}, "needs a tool setter, a plate: Setup(setter=mnclab.Setter(…))"),
    (481, {}, {"tt_calibrated": False}, "needs a TT that is calibrated: TCH PROBE 480 before it, or the setting tt_calibrated"),
    (481, {}, {"hide_measure_tt": True}, "is hidden on this machine (setting hide_measure_tt)"),
    (482, {}, {"radius_measured": False}, "measures lengths without single teeth alone on this machine"),
    (481, {"teeth": 1}, {"radius_measured": False}, "measures lengths without single teeth alone on this machine"),
]


@pytest.mark.parametrize(("code", "words", "machine", "sentence"), REFUSED)
def test_what_is_refused(code, words, machine, sentence):
    machine = {"tool": MILL, **machine}
    (alarm,) = run(MODES["new"].format(new=code, **{**ALL, **words}), **machine).alarms
    assert sentence in alarm.message and alarm.message.startswith(f"TCH PROBE {code}")
    assert alarm.span.line >= 3 and alarm.span.column >= 1


@pytest.mark.parametrize(
    ("before", "sentence"),
    [
        ("CYCL DEF 8.0 X\nCYCL DEF 8.1 X\n", "cannot run while a mirror is active"),
        ("CYCL DEF 11.0 X\nCYCL DEF 11.1 SCL 0.5\n", "cannot run while a scale is active"),
        ("CYCL DEF 26.0 X\nCYCL DEF 26.1 X0.5 Y1\n", "cannot run while a axis scales is active"),
    ],
)
def test_mirror_images_and_scales_are_refused(before, sentence):
    (alarm,) = run(before + MODES["new"].format(new=481, **ALL), MILL).alarms
    assert sentence in alarm.message


@pytest.mark.parametrize(
    ("words", "machine", "sentence"),
    [
        ("480 X\nQ260=-360\n", {"tool": Tool(radius=31.1, length=80)}, "needs a calibrating tool of a radius up to 31"),
        ("480 X\nQ260=-360\n", {"tool": Tool(radius=6)}, "needs the length of T12 in the tool table"),
        ("484 X\nQ536=2\n", {"tool": CALIBRATING}, "Q536 (stop before running) must be one of 0, 1, got 2"),
        ("484 X\nQ536=1\n", {"tool": CALIBRATING}, "begins above the TT, the tool stands beside it"),
        ("30.0 X\nTCH PROBE 30.1 HEIGHT: +100000\n", {"tool": CALIBRATING}, "HEIGHT (clearance height) must be at least"),
    ],
)  # fmt: skip
def test_what_calibrating_refuses(words, machine, sentence):
    alarms = [alarm for alarm in run(f"TCH PROBE {words}", **machine).alarms if alarm.severity == "alarm"]
    assert len(alarms) == 1 and sentence in alarms[0].message


@pytest.mark.parametrize(
    ("text", "place", "sentence"),
    [
        ("31.0 X|31.1 CHECK:", (4, 16), "a number is missing: the mode 0, 1 or 2"),
        ("31.0 X|31.1 CHECK: 1 q5 7", (4, 28), "'7' needs an address before it"),
        ("31.0 X|31.1 CHECK: 1|31.2 HEIGHT: x", (5, 16), "a number is missing: the clearance"),
        ("31.0 X|31.1 CHECK: 1|31.2 HEIGHT: 9", (3, 1), "PROBING THE TEETH (whether each tooth"),
        ("30.0 X|30.1", (4, 15), "a number is missing: the clearance height"),
    ],
)
def test_the_old_format_is_read_to_the_letter(text, place, sentence):
    (alarm,) = run("".join(f"TCH PROBE {line}\n" for line in text.split("|")), MILL).alarms
    assert sentence in alarm.message and (alarm.span.line, alarm.span.column) == place


def test_a_broken_tool_does_not_reach_the_tt_and_a_long_one_meets_it_too_early():
    drill = Tool(radius=4, length=80, wear=Wear(offset_radius=0))
    (alarm,) = measure("TCH PROBE 481", drill, replace(drill, length=59), 1).alarms
    assert "the tool setter did not trigger within" in alarm.message
    (alarm,) = measure("TCH PROBE 481", drill, replace(drill, length=121), 1).alarms  # 40 mm above the TT, and 41 longer
    assert "path obstructed: the tool touches the tool setter while positioning" in alarm.message
    (alarm,) = measure("TCH PROBE 482", replace(drill, teeth=4), replace(drill, length=74, teeth=4), 1).alarms  # 5 mm below
    assert "the tool setter did not trigger within" in alarm.message


def test_help_and_names_in_iso():
    for code in (30, 31, 32, 33, 480, 481, 482, 483, 484):
        assert f"TCH PROBE {code}" in str(mnclab.help(f"TCH PROBE {code}", "tnc-620"))


def test_a_tt_calibrated_with_the_wrong_tool_tells_itself():
    """A pin of 10 that the table has as 6: the TT seems 4 larger; a drill of 3 does not touch it 24 off its middle, but at 23."""
    tools = {1: CALIBRATING, 2: Tool(radius=3, length=90, teeth=2)}
    setup = Setup(tools=tools, true_tools={1: replace(CALIBRATING, radius=10)}, setter=TRUE, start=(300, 200, 0))
    text = f"TOOL CALL 1 Z\nTCH PROBE 480 X\nQ260=-360\nTOOL CALL 2 Z\n{MODES['new']}"
    found = mnclab.run(text.format(new=482, mode=0, height=-360, teeth=0), "tnc-620", setup)
    assert found.measured["TT radius"] == pytest.approx(24)
    (alarm,) = found.alarms
    assert "the tool setter did not trigger within 23 mm" in alarm.message and (alarm.span.line, alarm.span.column) == (5, 1)

"""Chapter 4, move by move: every example that the manual prints, and those worked out from its text.

`check` of an example holds the numbers (how they were made: tests/authorities/README.md). Programs that only define
their cycle get a call here; a definition with a diameter needs a tool.
"""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from tools.running import run

import mnclab as mnc
from mnclab import Kind
from mnclab.geometry import frames
from mnclab.machine.machine import Machine
from mnclab.machining.holes import guided
from mnclab.running.cycles import perform
from mnclab.running.flow import Course

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-drilling.json"
EXAMPLES = json.loads(FILE.read_text(encoding="utf-8"))
DRILL = mnc.Tool(radius=2.4, angle=120)


def example(code, begins=""):
    """The first example of an entry whose title begins so."""
    return next(e for e in EXAMPLES if e["code"] == code and e["title"].startswith(begins))


def drilled(text, tool=DRILL, call=""):
    """A program behind a TOOL CALL, with a call after it."""
    found = run(f"{text}\n{call}", "tnc-620", before="TOOL CALL 2 Z S1000\n", tools={2: tool})
    assert found.alarms == ()
    return found


def words(path):
    """The rows as the manual's sequences say them: Z22 FMAX, Z15 F250, dwell 0.1 s, M3 S25, S500, M8."""
    found, turning = [], 0
    for row in path:
        if row.kind == Kind.DWELL:
            found.append(f"dwell {row.time:g} s")
        elif row.kind == Kind.COOLANT:
            found.append(row.label.rpartition(" ")[2])
        elif stop := re.search(r"orient the spindle to (\S+) degrees", row.label):
            found.append(f"spindle stop at {stop[1]} deg")
            turning = 0
        elif row.kind == Kind.SPINDLE:
            sense = math.copysign(1, row.spindle)
            found.append(f"M{3 if sense > 0 else 4} " * (sense != turning) + f"S{abs(row.spindle):g}")
            turning = sense
        else:
            feed = "FMAX" if row.kind == Kind.RAPID else f"F{row.feed:g}"
            axes = ["XYZ"[k] + f"{round(float(row.end[k]), 4):g}" for k in range(3) if row.start[k] != row.end[k]]
            found.append(" ".join([*axes, feed]))
    return found


def holes(found, code):
    """The rows that the cycle made, hole by hole."""
    path = found.toolpath
    mine = [k for k in range(len(path)) if path[k].label.startswith(code)]
    starts = [k for k in mine if path[k].label.endswith("to the set-up clearance")]
    ends = [*starts[1:], mine[-1] + 1]
    return [path[a : max(k for k in mine if k < b) + 1] for a, b in zip(starts, ends, strict=True)]


def places(parts):
    return [[round(float(v), 9) for v in part[0].end[:2]] for part in parts]


def same(words, expected):
    """The manual's figures have at most four decimals."""
    assert words == [re.sub(r"(?<=[XYZ])[-\d.]+", lambda z: f"{float(z[0]):g}", word) for word in expected]


@pytest.mark.parametrize(("angle", "bottom"), [(90, 15.5), (120, 17.4019)])
def test_240_centres_to_a_diameter(angle, bottom):
    data = example("CYCL DEF 240")
    parts = holes(drilled(data["program"], mnc.Tool(radius=6, angle=angle)), "CYCL DEF 240")
    assert places(parts) == data["check"]["holes"]
    for part in parts:
        same(words(part), data["check"][f"moves_T_ANGLE_{angle}"])
        assert part.end[:, 2].min() == pytest.approx(bottom, abs=1e-4)
    assert [float(part[0].start[2]) for part in parts] == [100, 120]


def test_200_as_printed_but_for_q210():
    data = example("CYCL DEF 200", "4.3")
    parts = holes(drilled(data["program"]), "CYCL DEF 200")
    assert places(parts) == data["check"]["holes"]
    for part in parts:
        same(words(part), data["check"]["moves_per_hole"])
        assert part[part.kind == Kind.LINE].end[:, 2].tolist() == data["check"]["peck_bottoms_z"]


def test_the_misprint_of_4_3_is_refused():
    """Q211 stands twice in the print, and Q210 not at all."""
    printed = example("CYCL DEF 200", "4.3")["printed"]
    (alarm,) = (a for a in mnc.run(printed, "tnc-620").alarms if a.severity == "alarm")
    assert (alarm.span.line, alarm.message) == (9, "Q211 is written twice in this block")


def test_200_to_the_cylindrical_part():
    data = example("CYCL DEF 200", "Q395=1")
    (part,) = holes(drilled(data["program"], call="L X+5 Y+5 R0 FMAX M3 M99"), "CYCL DEF 200")
    same(words(part), data["check"]["moves_per_hole"])
    assert -25 - part.end[:, 2].min() == pytest.approx(data["check"]["t"], abs=1e-4)


def test_201_reams_twice_where_the_print_has_m9():
    data = example("CYCL DEF 201")
    parts, printed = (holes(drilled(data[which]), "CYCL DEF 201") for which in ("program", "printed"))
    assert places(parts) == data["check"]["holes_intended"] and places(printed) == data["check"]["holes_as_printed"]
    for part in parts + printed:
        same(words(part), data["check"]["moves_per_hole"])


def test_202_leaves_the_wall_and_turns_again():
    data = example("CYCL DEF 202")
    parts = holes(drilled(data["program"]), "CYCL DEF 202")
    assert places(parts) == data["check"]["holes"]
    same(words(parts[0]), [*data["check"]["moves_hole_1"], "M3 S1000"])
    assert parts[1][parts[1].kind == Kind.RAPID].end[:, 0].tolist() == pytest.approx([80, 79.8, 79.8, 80])


@pytest.mark.parametrize("begins", ["4.6", "decrement"])
def test_203_breaks_chips_and_shrinks(begins):
    data = example("CYCL DEF 203", begins)
    (part,) = holes(drilled(data["program"], call="L X+5 Y+5 R0 FMAX M3 M99"), "CYCL DEF 203")
    same(words(part), data["check"]["moves_per_hole"])
    surface = 20 if begins == "4.6" else 0
    pecks = [surface - row.end[2] for row in part if "peck" in row.label]
    depths = data["check"].get("depths", pecks)
    assert pecks == pytest.approx(depths)
    assert [b - a for a, b in zip([0, *pecks], pecks, strict=False)] == pytest.approx(data["check"]["infeeds"])


def test_204_counterbores_from_below():
    data = example("CYCL DEF 204")
    (part,) = holes(drilled(data["program"], call="L X+0 Y+0 R0 FMAX M3\nCYCL CALL"), "CYCL DEF 204")
    expected = data["check"]["moves_at_X0"]
    both = expected.index("spindle and coolant on")
    second = expected.index("spindle stop at 0 deg", both)
    expected.insert(second + 1, "off")  # the coolant was off before the call
    expected[both : both + 1] = ["M3 S1000", "on"]
    same(words(part), [*expected, "M3 S1000"])
    edges = {row.label.removeprefix("CYCL DEF 204 "): row.end[2] + 15 for row in part}
    assert edges["through the hole"] == edges["leave the counterbore"] == data["check"]["edge_z"]["below"]
    assert edges["counterbore"] == data["check"]["edge_z"]["bottom_of_counterbore"]


def test_204_leaves_the_coolant_on_that_was_on():
    found = drilled(example("CYCL DEF 204")["program"], call="L X+0 Y+0 R0 FMAX M13\nCYCL CALL")
    (part,) = holes(found, "CYCL DEF 204")
    assert not (part.kind == Kind.COOLANT).any() and found.history["coolant"][-1] == "M8"


def test_205_in_a_hole_that_is_there_already():
    data = example("CYCL DEF 205")
    check = data["check"]
    (part,) = holes(drilled(data["program"], call="L X+5 Y+5 R0 FMAX M3 M99"), "CYCL DEF 205")
    same(words(part), check["moves_per_hole"])
    levels = [100 - row.start[2] for row in part if row.label.endswith("clear the chips")]
    assert [*levels, 80] == pytest.approx(check["depths"])
    returns = [row.end[2] for row in part if row.label.endswith("return")]
    stops = [z - (100 - level) for z, level in zip(returns, levels, strict=True)]
    assert stops == pytest.approx(check["advanced_stop_distances"])
    assert sum(row.label.endswith("break the chip") and row.feed == 9999 for row in part) == check["chip_breaks"]
    assert {row.end[2] for row in part if row.label.endswith("clear the chips")} == {check["return_z"]}
    assert part[1].end[2] == check["start_of_drilling_z"]


def test_208_mills_a_bore():
    data = example("CYCL DEF 208")
    check, wanted = data["check"], data["check"]["tool_diameter_16"]
    (part,) = holes(drilled(data["program"], mnc.Tool(radius=8), "L X+40 Y+30 R0 FMAX M3\nCYCL CALL"), "CYCL DEF 208")
    helix = next(row for row in part if row.label.endswith("helix"))
    assert part[0].end[2] == check["set_up_plane_z"] == helix.start[2] and helix.end[2] == check["bottom_z"]
    assert part[-1].end.tolist() == [40, 30, check["end_z"]]
    assert math.dist(helix.start[:2], (40, 30)) == pytest.approx(wanted["path_radius"])
    assert math.degrees(helix.sweep) / 360 == pytest.approx(wanted["turns"], abs=1e-4)  # + is counter-clockwise
    assert wanted["direction"] == "counterclockwise"


def test_208_needs_half_the_diameter():
    data = example("CYCL DEF 208")
    smallest = data["check"]["smallest_tool_diameter"]
    call = "L X+40 Y+30 R0 FMAX M3\nCYCL CALL"
    assert drilled(data["program"], mnc.Tool(radius=smallest / 2), call).ok
    small = mnc.Setup(tools={2: mnc.Tool(radius=smallest / 2 - 0.01)})
    (alarm,) = mnc.run(f"TOOL CALL 2 Z S1000\n{data['program']}\n{call}\n", "tnc-620", small).alarms
    assert "Q335 (diameter of the bore) must be at most twice the tool diameter 12.48" in alarm.message


def test_208_as_wide_as_the_tool_drills():
    data = example("CYCL DEF 208")
    (part,) = holes(drilled(data["program"], mnc.Tool(radius=12.5), "L X+4 Y+3 R0 FMAX M3\nCYCL CALL"), "CYCL DEF 208")
    assert words(part) == ["Z102 FMAX", "Z20 F150", "Z150 FMAX"]


def test_241_turns_slowly_in_and_out():
    data = example("CYCL DEF 241")
    check = data["check"]
    (part,) = holes(drilled(data["program"], call="L X+5 Y+5 R0 FMAX M99"), "CYCL DEF 241")
    same(words(part), check["moves_per_hole"])
    levels = [row.end[2] for row in part if row.kind in (Kind.LINE, Kind.RAPID)]
    wanted = [check[key] for key in ("start_of_drilling_z", "bottom_z", "retraction_position_z", "end_z")]
    assert [level for level in levels if level in wanted] == wanted


def test_pgm_c200():
    data = example("PGM C200")
    check = data["check"]
    found = mnc.run(data["program"], "tnc-620", mnc.Setup(tools={1: mnc.Tool(radius=3)}))
    assert found.alarms == ()
    parts = holes(found, "CYCL DEF 200")
    assert places(parts) == check["holes"]
    for part in parts:
        same(words(part), check["moves_per_hole"])
        cut = part[part.kind == Kind.LINE]
        assert cut.end[:, 2].tolist() == check["peck_bottoms_z"] and cut.length == check["feed_path_per_hole_mm"]
        assert float((cut.lengths / cut.feed).sum() * 60) == pytest.approx(check["cutting_time_per_hole_s"])
    path = found.toolpath
    assert path[path.kind == Kind.DWELL].time.sum() == pytest.approx(check["dwell_total_s"])
    assert dict(zip("XYZ", path.motion[-1].end.tolist(), strict=True)) == check["end_position"]


@pytest.mark.parametrize(("code", "key"), [("240", "centering"), ("200", "drilling")])
def test_the_holes_of_pgm_1(code, key):
    """Its definitions, called at its points one by one; surface 0, end plane at 10."""
    data = example("PGM 1 (4.11)", "PGM 1 as adopted")
    text = data["program"]
    definition = re.search(rf"^\d+ CYCL DEF {code}.*\n(?:Q.*\n)+", text, re.M)[0]
    points = re.findall(r"POS\d\(X\+(\d+) Y\+(\d+) Z\+0\)", text)
    calls = "\n".join(f"L X+{x} Y+{y} R0 FMAX M13 M99" for x, y in points)
    parts = holes(drilled(f"L Z+50 R0 FMAX\n{definition}{calls}"), f"CYCL DEF {code}")
    assert places(parts) == data["check"]["points"]
    for part in parts:
        same(words(part), data["check"][f"{key}_moves_per_hole"])


@pytest.mark.parametrize("which", ["start", "return"])
def test_positioning_with_q379(which):
    """Both tables, 15 rows each; four printed rows of the second contradict its rule and are those of the first."""
    data = example("Q379 positioning behavior", "table: " + which)["check"]
    for clearance, deepened, surface, above, _, level in data["rows"]:
        planes = guided(surface, deepened, clearance)
        assert above == surface + clearance
        assert (planes.start if which == "start" else planes.clear) == pytest.approx(level)
    misprinted = [row for row in data.get("rows_printed", []) if row not in data["rows"]]
    assert [row[:2] for row in misprinted] == ([[20, 2], [20, 5], [20, 10], [20, 25]] if which == "return" else [])


# --- under transformations --------------------------------------------------------------------------------------------


def test_202_disengages_in_turned_coordinates():
    """Q214=1 is -X of the program; turned by 90 degrees that is -Y of the machine."""
    text = "8 CYCL DEF 10.0 R\n9 CYCL DEF 10.1 ROT+90\n" + example("CYCL DEF 202")["program"]
    first, _ = holes(drilled(text), "CYCL DEF 202")
    off = next(row for row in first if row.label.endswith("leave the wall"))
    assert off.end - off.start == pytest.approx([0, -0.2, 0])


@pytest.mark.parametrize("mirrored", [(0,), (1,), (0, 1)])
@pytest.mark.parametrize("turned", [0, 90])
def test_a_mirror_image_turns_neither_the_direction_nor_the_kind_of_milling(mirrored, turned):
    """4.5, 4.7 and 4.9, on a machine with a mirror frame inside a rotation."""
    control = mnc.controls["tnc-620"]
    bore = {"clearance": 2.0, "depth": -5.0, "feed": 100.0, "surface": 0.0, "second_clearance": 9.0}
    boring = {"dwell_bottom": 0.0, "retract_feed": 100.0, "disengage": 1.0, "spindle_angle": 0.0}
    back = {
        "thickness": 20.0,
        "counterbore_depth": 5.0,
        "eccentricity": 3.0,
        "edge_height": 9.0,
        "positioning_feed": 700.0,
    }
    milling = {"pitch": 1.0, "diameter": 14.0, "roughing_diameter": 0.0, "climb": 1.0}
    without = {name: value for name, value in bore.items() if name != "depth"}
    for code, values, moved in (
        (202, bore | boring, 0.2),
        (204, without | back | {"dwell_bottom": 0.0, "disengage": 1.0, "spindle_angle": 0.0}, 3.0),
        (208, bore | milling, 0),
    ):
        machine = Machine(control, mnc.Setup(), Course(control.read("")))
        machine.set_modal("coolant", "M9")
        machine.change_tool(mnc.Tool(radius=5))
        machine.set_frame("rotation", frames.turn(math.radians(turned)))
        sizes = [-1.0 if axis in mirrored else 1.0 for axis in range(3)]
        machine.set_frame("mirror", np.diag([*sizes, 1.0]))
        machine.rapid(20, 10, 50)
        place = machine.tip
        perform(machine, "", control.cycles[f"CYCL DEF {code}"](**values).moves(machine))
        path = machine.recorder.take()
        if moved:
            off = path[path.kind == Kind.RAPID].end - place
            way = {0: (-1, 0), 90: (0, -1)}[turned]
            assert any(np.allclose(row[:2], [moved * step for step in way]) for row in off)
            assert path.end[-1, :2] == pytest.approx(place[:2])
        else:
            assert (path.sweep[path.kind == Kind.ARC] > 0).all()

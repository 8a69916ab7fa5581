"""Calibration of touch probes: MNC G460 to G462 (12.24 to 12.26), TNC 620 cycles 460 to 463 and 441 (17.4 to 17.10).

The checks of the catalogue stand in tests/authorities/catalogue/mnc-probing.json and tnc620-probing-special.json. What a random
probe is stands in its true tool and its true offset: the tables must hold exactly that afterwards.
"""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from controls.mnc.probing_mnc import DATUM, at, examples, measured, probes
from tools.probed import gaps

import mnclab as mnc
from mnclab import Kind, Probe, Setup, Tool
from mnclab.workpiece import part as parts

FILE = Path(__file__).parents[1] / "authorities/catalogue/tnc620-probing-special.json"
TNC = [each for each in json.loads(FILE.read_text(encoding="utf-8")) if each["check"]]
PROBE = Probe(clearance=2, reach=20, feed=200, rapid=2000)


def block(centre, radius, top=0.0, deep=80.0, inside=True):
    """A round stud, or a round hole in a large block."""
    x, y = centre
    if inside:
        return parts.cylinder((x, y, top - deep), (x, y, top), radius)
    return parts.box((x - 200, y - 200, top - deep), (x + 200, y + 200, top)) - parts.hole((x, y, top), 2 * radius, deep)


def true(radius, length):
    return {20: Tool(radius=radius, length=length, kind="probe")}


# --- MNC --------------------------------------------------------------------------------------------------------------


def test_the_length_of_the_example():
    """True length 150.237, table 150: the touch stands at Z 0.237 of the display, the reference at machine -249.763."""
    (example,) = examples("G460")
    check = example["check"]
    plane = parts.plane((0, 0, check["workpiece"][0]["z"]), (0, 0, 1))
    run = measured(example["program"] + "G0 Z5\n", plane, before="", true_tools=true(3, check["true_length"]))
    assert run.ok, run.alarms
    moves = run.toolpath.motion[1:]
    assert [Kind(kind).name for kind in moves.kind] == ["RAPID", "PROBE", "LINE", "RAPID"]
    assert moves.end[:3, 2] == pytest.approx([move["z"] for move in check["moves"]], abs=1e-9)
    reference = moves.end[1, 2] + DATUM[2] + 150
    assert reference == pytest.approx(check["z_ref_trigger_machine"], abs=1e-9)
    tool = run.tables.tools[20]
    assert (tool.length, tool.dl) == (pytest.approx(check["tool"]["length"], abs=1e-9), check["tool"]["length_correction"])
    assert run.measured["length"] == pytest.approx(150.237, abs=1e-9)
    (change,) = run.toolpath[run.toolpath.line == 4][-1:]  # no motion: the tip jumps by the difference, then Z 5 is Z 5
    assert Kind(change.kind) == Kind.TOOL and change.end[2] == pytest.approx(10 - 0.237, abs=1e-9)
    assert run.toolpath.end[-1][2] == pytest.approx(5, abs=1e-9)


@pytest.mark.parametrize("code", ["G461", "G462"])
def test_the_offsets_of_an_example(code):
    """Machine coordinates of the spindle axis at all eight touches, offsets and radius."""
    (example,) = examples(code)
    check, ring = example["check"], code == "G461"
    figure, actual = check["ring" if ring else "boss"], check["actual"]
    centre = figure["x_machine"] - DATUM[0], figure["y_machine"] - DATUM[1]
    part = block(centre, figure["diameter"] / 2, 20 if ring else 0, inside=not ring)
    offset = actual["off_x"], actual["off_y"]
    run = measured(
        example["program"], part, before="", true_tools=true(actual["radius"], 150), probe=replace(PROBE, true_offset=offset)
    )
    assert run.ok, run.alarms
    expected = [[each["x"], each["y"]] for each in check["axis_touches_machine"]]
    assert probes(run).end[:, :2] + DATUM[:2] == pytest.approx(np.array(expected), abs=5.001e-5)
    assert run.tables.probe.offset == pytest.approx((check["off_x"], check["off_y"]), abs=1e-9)
    tool = run.tables.tools[20]
    assert (tool.radius, tool.dr) == (pytest.approx(check["radius"], abs=1e-9), 0)
    start = next(row for row in run.toolpath.motion if row.line == 5).start
    assert run.toolpath.end[-1] == pytest.approx(start, abs=1e-9)
    assert run.history["spindle angle"][-1] == 0


class Draw:
    """A random probe: what its table says, and what is true."""

    def __init__(self, seed):
        self.random = np.random.default_rng(seed)
        self.radius, self.length = self(1.5, 4), 150 + self(-1, 1)
        deltas = {"dl": self(-0.05, 0.05), "dr": self(-0.05, 0.05)}
        self.table = Tool(radius=self.radius + self(-0.1, 0.1), length=150, kind="probe", **deltas)
        self.offset = self(-0.3, 0.3), self(-0.3, 0.3)
        before = (self(-0.2, 0.2), self(-0.2, 0.2)) if seed % 2 else (0.0, 0.0)  # of an earlier calibration
        self.probe = Probe(clearance=self(3, 5), reach=20, rapid=2000, feed=200, offset=before, true_offset=self.offset)

    def __call__(self, least, greatest):
        return round(float(self.random.uniform(least, greatest)), 3)

    def mnc(self, program, part, **more):
        setup = {"tools": {20: self.table}, "true_tools": true(self.radius, self.length), "probe": self.probe} | more
        run = measured(program, part, **setup)
        assert run.ok, run.alarms
        return run


SEEDS = range(20)


@pytest.mark.parametrize("seed", SEEDS)
def test_any_probe_in_a_ring_or_on_a_boss(seed):
    """The tables are what is true, under a base rotation too; a bore that is measured next has its own diameter and place."""
    draw = Draw(seed)
    ring, size, turned = seed % 4 < 2, draw(15, 60), draw(-30, 30) if seed % 3 else 0.0
    x, y = draw(-20, 20), draw(-20, 20)
    stand = x + draw(-1, 1), y + draw(-1, 1)
    part = block((x, y), size / 2, inside=not ring)
    call = f"G0 Z{-draw(5, 20)}\nG461 D{size}" if ring else f"G0 Z{draw(10, 20)}\nG462 D{size} Q{draw(0, 2)} Z{-draw(5, 10)}"
    measure = f"G42{1 if ring else 2} X{x} Y{y} D{size} Z-8 H20 P1"
    program = f"G404 E{turned}\nG0 X{stand[0]} Y{stand[1]}\n{call}\nG0 Z30\n{measure}\n"
    place = at(DATUM, turned)
    run = draw.mnc(program, part, place=place)
    assert run.tables.probe.offset == pytest.approx(draw.offset, abs=1e-9)
    tool = run.tables.tools[20]
    assert (tool.effective_radius, tool.dr) == (pytest.approx(draw.radius, abs=1e-9), 0)
    found = [run.variables[name] for name in ("Q314", "Q315", "Q318")]
    assert found == pytest.approx([x, y, size], abs=1e-6)
    assert [row.what for row in run.measurements[:3]] == ["radius", "offset X", "offset Y"]


@pytest.mark.parametrize("seed", SEEDS)
def test_any_length(seed):
    """The length of the table is the true one, without a correction; the surface then measures at its height."""
    draw = Draw(seed)
    height, start = draw(-20, 20), draw(2, 10)
    program = f"G0 X{draw(-5, 5)} Y{draw(-5, 5)} Z{height + start}\nG460 Z{height}\nG499 Z-1\n"
    run = draw.mnc(program, parts.plane((0, 0, height), (0, 0, 1)))
    tool = run.tables.tools[20]
    assert (tool.length, tool.dl) == (pytest.approx(draw.length, abs=1e-9), 0)
    assert run.variables["Q312"] == pytest.approx(height, abs=1e-6)


# --- TNC 620 ----------------------------------------------------------------------------------------------------------

SPHERE = (0.2, -0.1, -2.5)
OFFSET = (0.03, -0.02)
PARTS = {
    "TCH PROBE 460": lambda: parts.ball(SPHERE, 12.5),
    "TCH PROBE 461": lambda: parts.plane((0, 0, 5), (0, 0, 1)),
    "TCH PROBE 462": lambda: block((0.05, -0.03), 5, 50, 100, inside=False),
    "TCH PROBE 463": lambda: block((0.05, -0.03), 5),
}
STARTS = {"TCH PROBE 460": 12.3, "TCH PROBE 461": 12, "TCH PROBE 462": -5, "TCH PROBE 463": 2}


def klartext(text, part, start, radius=2.0, length=50.0, true_radius=1.985, true_length=50.0, offset=OFFSET, **more):
    """A cycle where the probe stands at (x, y, z); the preset is machine zero."""
    probe = {"clearance": 2, "reach": 10, "true_offset": offset} | more.pop("probe", {})
    setup = {
        "tools": {7: Tool(radius=radius, length=length, kind="probe")}, "part": part, "probe": Probe(**probe),
        "true_tools": {7: Tool(radius=true_radius, length=true_length, kind="probe")},
        "start": (*start[:2], start[2] + length),
    } | more  # fmt: skip
    return mnc.run(f"BEGIN PGM P MM\nTOOL CALL 7 Z\n{text}\nEND PGM P MM\n", "tnc-620", Setup(**setup))


@pytest.mark.parametrize("example", TNC, ids=lambda each: f"{each['code']} {each['title'][:20]}")
def test_an_example_of_the_manual(example):
    """All touches with start and contact, L, R and both offsets; heights are those of the ball's centre by the table.

    The checks let the true ball stand at that height: of a ball that is 0.015 smaller the stylus is as much shorter.
    """
    code, check = example["code"], dict(example["check"])
    if code == "TCH PROBE 441":
        run = klartext(example["program"], None, (0, 0, 50))
        assert run.ok and not len(run.toolpath.motion)
        return
    radius, longer = (1.985, -0.015) if "L" not in check else (2.0, check["L"] - 50)
    run = klartext(example["program"], PARTS[code](), (0, 0, STARTS[code]), true_radius=radius, true_length=50 + longer)
    assert run.ok, run.alarms
    assert gaps(run, PARTS[code](), radius).min() > -0.15  # the ball of the path is that of the table, not the true one
    touches = probes(run)
    runs = ("equator_search", "rough_run", "first_run", "fine_run_0deg", "run_180deg")
    groups = [check.pop(name) for name in runs if name in check]
    expected = [touch for group in groups for touch in (group if isinstance(group, list) else group["touches"])]
    for row, touch in zip(touches, expected):
        lift = np.array((0, 0, 2.0))
        assert row.start + lift == pytest.approx(touch["start"], abs=1.001e-5)
        assert row.end + lift == pytest.approx(touch["contact"], abs=1.001e-5)
        assert np.linalg.norm(row.end - row.start) == pytest.approx(touch["travel"], abs=1.001e-5)
    tool, found = run.tables.tools[7], run.tables.probe
    assert tool.radius == pytest.approx(check.pop("R", radius), abs=1e-9)
    if "CAL_OF1" in check:
        assert found.offset == pytest.approx((check.pop("CAL_OF1"), check.pop("CAL_OF2")), abs=1e-9)
    if "L" in check:
        assert tool.length == pytest.approx(check.pop("L"), abs=1e-9)
    if "z_ind" in check:
        assert touches[-1].end[2] == pytest.approx(check.pop("z_ind"), abs=1e-9)
    if "polar_angles_3d" in check:
        rows = [line.split() for line in run.files["TNC:\\system\\CAL_TS7_0.3DTC"].splitlines()[1:]]
        assert [float(row[1]) for row in rows] == check["polar_angles_3d"] * 4
        assert [float(row[0]) for row in rows] == [azimuth for azimuth in (0, 90, 180, 270) for _ in range(15)]
        assert {abs(float(row[2])) for row in rows} == {0.0}
        assert len(touches) == len(expected) + len(rows)
    assert "TCHPRAUTO.html" in run.files


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("code", [460, 462, 463])
def test_any_probe(code, seed):
    """Radius, offset at the angle CAL_ANG, and of the sphere the length; 3 to 8 points, any reference angle, any tool axis."""
    draw = Draw(seed)
    size, points, angle = draw(10, 20), 3 + seed % 6, draw(0, 360)
    centre = draw(-0.5, 0.5), draw(-0.5, 0.5)
    clearance, calibrated = draw(2, 3), draw(-180, 180) if seed % 2 else 0.0
    words = f"Q407={size}\nQ320={draw(0, 1)}\nQ423={points}\nQ380={angle}\n"
    if code != 462:
        words += f"Q301={seed // 2 % 2}\n"
    if code == 460:
        part, start = parts.ball((*centre, 0), size), size + clearance + 0.5
        words += "Q433=1\nQ434=0\nQ455=0\n"
    else:
        part, start = block(centre, size, 50 if code == 462 else 0, 100, code == 463), -10 if code == 462 else clearance
    run = klartext(
        f"TCH PROBE {code} X\n{words}", part, (0, 0, start), true_radius=draw.radius, radius=draw.radius + 0.05,
        true_length=50 + (seed % 3 - 1) * 0.05, offset=draw.offset,
        probe={"clearance": clearance, "reach": 30, "angle": calibrated},
    )  # fmt: skip
    assert run.ok, run.alarms
    tool = run.tables.tools[7]
    assert tool.radius == pytest.approx(draw.radius, abs=1e-6)
    assert run.tables.probe.offset == pytest.approx(draw.offset, abs=1e-6)
    if code == 460:
        assert tool.length == pytest.approx(50 + (seed % 3 - 1) * 0.05, abs=1e-6)
    assert run.history["spindle angle"][-1] == pytest.approx(calibrated % 360)


def test_a_spindle_that_cannot_be_oriented():
    """Only the radius is found: 8 rough and 8 fine touches, and no turn (17.8)."""
    example = next(each for each in TNC if each["code"] == "TCH PROBE 462")
    run = klartext(example["program"], PARTS["TCH PROBE 462"](), (0, 0, -5), settings={"controlled_spindle": False})
    assert run.ok and len(probes(run)) == 16 and Kind.SPINDLE not in run.toolpath.kind[2:]
    assert run.tables.tools[7].radius == pytest.approx(1.985, abs=1e-9) and run.tables.probe.offset == (0, 0)


def test_the_log_holds_all_calibrations():
    """Old and new values, four decimals, one table for each cycle (17.5)."""
    text = "TCH PROBE 461 L\nQ434=5\nTCH PROBE 461 L\nQ434=5"
    run = klartext(text, PARTS["TCH PROBE 461"](), (0, 0, 12), true_length=49.95, true_radius=2)
    log = run.files["TCHPRAUTO.html"]
    assert log.startswith("<!DOCTYPE html>\n<title>TCHPRAUTO.html</title>\n<h2>TCH PROBE 461</h2>\n<p>Tool 7</p>\n<table>\n")
    assert log.count("<h2>TCH PROBE 461</h2>") == 2
    assert "<tr><th>L</th><td>50.0000</td><td>49.9500</td></tr>\n<tr><th>R</th><td>2.0000</td><td>2.0000</td></tr>" in log
    assert "<tr><th>L</th><td>49.9500</td><td>49.9500</td></tr>" in log


def test_the_deviations_of_a_probe_that_gives():
    """A probe that goes on by 0.01 cos 45° before it triggers from 45° above: it is that much nearer the centre; at the equator,
    where the radius was found, it does not give."""
    text = "TCH PROBE 460 S\nQ407=12.5\nQ320=0\nQ301=1\nQ423=4\nQ380=0\nQ433=0\nQ434=0\nQ455=2"
    gives = {"deflection": (0, 0, 0.01)}
    run = klartext(text, parts.ball((0, 0, 0), 12.5), (0, 0, 14.5), true_radius=2, offset=(0, 0), probe=gives)
    rows = [line.split() for line in run.files["TNC:\\system\\CAL_TS7_0.3DTC"].splitlines()[1:]]
    found = {float(polar): float(off) for _, polar, off in rows}
    assert found[90] == pytest.approx(0, abs=1e-6) and found[45] == pytest.approx(-0.01 / math.sqrt(2), abs=1e-5)


# --- cycle 441 --------------------------------------------------------------------------------------------------------

TOUCH = "TCH PROBE 417 Z\nQ263=0\nQ264=0\nQ294=5\nQ320=0\nQ260=20\nQ305=0\nQ333=0\nQ303=1\n"


def feeds(text, **more):
    run = klartext(text, parts.plane((0, 0, 5), (0, 0, 1)), (3, 3, 12), true_radius=2, offset=(0, 0), **more)
    assert run.ok, run.alarms
    rows = run.toolpath.motion
    return set(rows[rows.kind != Kind.PROBE].feed.tolist()), run


def test_fast_probing_replaces_the_positioning_of_the_table():
    """Q397 = 0: at Q396; Q397 = 1: at the rapid traverse; what is left out stays as the table has it."""
    table = {"probe": {"rapid": 1500.0}}
    assert feeds(TOUCH, **table)[0] == {1500}
    assert feeds("TCH PROBE 441 F\nQ396=3000\nQ397=0\nQ399=1\nQ400=1\n" + TOUCH, **table)[0] == {3000}
    assert feeds("TCH PROBE 441 F\nQ396=3000\nQ397=1\nQ399=0\nQ400=0\n" + TOUCH, **table)[0] == {math.inf}
    assert feeds("TCH PROBE 441 F\nQ396=FMAX\nQ397=0\nQ399=0\nQ400=0\n" + TOUCH, **table)[0] == {math.inf}
    assert feeds("TCH PROBE 441 F\nQ399=1\n" + TOUCH, **table)[0] == {1500}
    assert feeds("TCH PROBE 441 F\nQ396=800\n" + TOUCH, probe={"positioning": "machine"})[0] == {800}


def test_fast_probing_orients_the_probe():
    """Q399 = 1 turns the spindle before each touch in the plane; the table is not changed."""
    cycle = "TCH PROBE 419 X\nQ263=20\nQ264=0\nQ261=0\nQ320=0\nQ260=20\nQ272=1\nQ267=1\nQ305=0\nQ333=0\nQ303=1\n"
    part = parts.plane((20, 0, 0), (-1, 0, 0))
    for first, turns in (("", 0), ("TCH PROBE 441 F\nQ399=1\n", 1), ("TCH PROBE 441 F\nQ399=0\n", 0)):
        run = klartext(first + cycle, part, (0, 0, 30), true_radius=2, offset=(0, 0))
        assert run.ok and run.tables.probe.track is False
        assert (run.toolpath.kind == Kind.SPINDLE).sum() == turns


@pytest.mark.parametrize("log", [0, 1, 2])
@pytest.mark.parametrize("interruption", ["", "Q400=0\n", "Q400=1\n"])
def test_fast_probing_says_whether_results_are_shown(log, interruption):
    """Q400 = 1: with any Q281; Q400 = 0: with none; else with Q281 = 2. The file of Q281 = 1 is written in any case."""
    measure = f"TCH PROBE 427 M\nQ263=0\nQ264=0\nQ261=5\nQ320=0\nQ272=3\nQ267=-1\nQ260=20\nQ281={log}\n"
    measure += "Q288=0\nQ289=0\nQ309=0\nQ330=0\n"
    run = klartext(f"TCH PROBE 441 F\nQ399=0\n{interruption}{measure}", parts.plane((0, 0, 5), (0, 0, 1)), (0, 0, 12))
    shown = interruption == "Q400=1\n" or not interruption and log == 2
    assert run.ok and (Kind.STOP in run.toolpath.kind) == ("SCREEN:" in run.files) == shown
    assert ("TCHPR427.TXT" in run.files) == (log == 1)


def test_the_end_of_a_program_ends_fast_probing():
    """END PGM of a program that was called too (17.10)."""
    called = "BEGIN PGM SUB MM\nTCH PROBE 441 F\nQ396=800\nQ397=0\nQ399=0\nQ400=0\nEND PGM SUB MM\n"
    found, _ = feeds("CALL PGM SUB.H\n" + TOUCH, files={"SUB.H": called}, probe={"rapid": 1500.0})
    assert found == {1500}


@pytest.mark.parametrize(("away", "warned"), [(4.9, 0), (5.1, 1)])
def test_a_probe_more_than_5_mm_off_the_centre_is_told(away, warned):
    """12.25: by hand within 5 mm of the centre."""
    run = measured(f"G0 X{away}\nG0 Z-8\nG461 D30\n", block((0, 0), 15, inside=False), true_tools=true(3, 150))
    assert run.ok and len(run.alarms) == warned, run.alarms
    assert all(f"began {away:.4f} mm off the centre of the figure" in str(alarm) for alarm in run.alarms)


@pytest.mark.parametrize(("diameter", "found"), [(30, None), (30.8, None), (32, 4), (28, 2)])
def test_a_ring_of_another_diameter_is_told(diameter, found):
    """Ring 30, ball of radius 3: the spindle goes 12 to each side, so D32 makes a ball of 16 - 12 = 4, and D28 one of 2."""
    run = measured(f"G0 Z-8\nG461 D{diameter}\n", block((0, 0), 15, inside=False), true_tools=true(3, 150))
    said = [alarm.message for alarm in run.alarms]
    sentence = f"G461 finds a ball of radius {found or 0:.4f}, and its row says 3: is the ring of the diameter {diameter:g}?"
    assert run.ok and said == ([sentence] if found else []), said
    assert all(alarm.severity == "warning" and alarm.span for alarm in run.alarms)

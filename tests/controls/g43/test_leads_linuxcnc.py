"""Entries by an arc and exits of compensated contours against LinuxCNC: the recorded motion, to 1e-7 mm."""

import json
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Setup, Tool

RECORDS = json.loads((Path(__file__).parents[2] / "authorities" / "leads.json").read_text("utf-8"))["records"]


@pytest.mark.parametrize("part", range(4))
def test_motion(part):
    for record in RECORDS[part::4]:
        run = mnclab.run(record["text"], "g43", Setup(settings={"dialect": "linuxcnc", "stopped_spindle": "accept"}))
        assert run.ok, (record["name"], run.alarms)
        rows, expected = list(run.toolpath.motion), [row for row in record["motion"] if row["kind"] != "rapid"]
        assert np.abs(np.array([row.end for row in rows]) - [row["to"] for row in expected]).max() < 1e-7, record[
            "name"
        ]
        for row, other in zip(rows, expected, strict=True):
            assert ("centre" in other) == (row.kind == mnclab.Kind.ARC)
            if "centre" in other:
                assert np.abs(row.centre - other["centre"]).max() < 1e-6 and abs(row.sweep - other["sweep"]) < 1e-6


def test_whose_exit_it_is():
    """The setting compensation_leads says it: Fanuc's rolls about the corner first, LinuxCNC's goes straight on from it."""
    text = "G0 X0 Y0\nG41 D1 G1 X20 Y0 F100\nX50\nY20\nG40\nG1 X80 Y40\n"
    rows = {}
    for leads in ("corners", "linuxcnc"):
        setup = Setup(
            tools={1: Tool(radius=5, number=1)}, settings={"compensation_leads": leads, "stopped_spindle": "accept"}
        )
        rows[leads] = mnclab.run(text, "g43", setup).toolpath.motion
    assert rows["linuxcnc"].end[-2:].tolist() == [[45, 20, 0], [80, 40, 0]]
    assert rows["corners"].kind[-2:].tolist() == [mnclab.Kind.ARC, mnclab.Kind.LINE]
    assert np.hypot(*(rows["corners"].end[-2, :2] - [50, 20])) == pytest.approx(5)


def test_an_entry_by_an_arc_is_refused_elsewhere():
    text = "G0 X0 Y0\nG41 D1\nG3 X20 Y20 I0 J20 F100\nG1 X40\nG40 G1 X60\n"
    tools = {1: Tool(radius=5, number=1)}
    for dialect in ("fanuc", "haas"):
        (alarm,) = [
            a
            for a in mnclab.run(text, "g43", Setup(tools=tools, settings={"dialect": dialect})).alarms
            if a.severity == "alarm"
        ]
        assert alarm.span.line == 3 and alarm.message == "radius compensation begins only in a straight line at feed"
    small = Setup(tools={1: Tool(radius=21, number=1)}, settings={"dialect": "linuxcnc"})
    (alarm,) = [a for a in mnclab.run(text, "g43", small).alarms if a.severity == "alarm"]
    assert alarm.message == "the tool is not smaller than the arc of the entry"


INSIDE = json.loads((Path(__file__).parents[2] / "authorities" / "leads_inside.json").read_text("utf-8"))["records"]


def test_an_inside_corner_shortens_the_arc_of_an_entry():
    """Where the arc would have to turn back, LinuxCNC goes nearly a full turn about a far centre: that is refused here."""
    run_by_both = 0
    for record in INSIDE:
        run = mnclab.run(record["text"], "g43", Setup(settings={"dialect": "linuxcnc", "stopped_spindle": "accept"}))
        expected = [row for row in record["motion"] if row["kind"] != "rapid"]
        if "error" in record or not run.ok:
            (alarm,) = [alarm for alarm in run.alarms if alarm.severity == "alarm"]
            nothing = alarm.message == "the inside corner behind the entry leaves nothing of its arc"
            assert "error" in record or nothing, (record["name"], alarm)
            continue
        run_by_both += 1
        rows = list(run.toolpath.motion)
        assert np.abs(np.array([row.end for row in rows]) - [row["to"] for row in expected]).max() < 1e-7, record["name"]
        for row, other in zip(rows, expected, strict=True):
            assert ("centre" in other) == (row.kind == mnclab.Kind.ARC)
            if "centre" in other:
                assert np.abs(row.centre - other["centre"]).max() < 1e-6 and abs(row.sweep - other["sweep"]) < 1e-6
    assert run_by_both >= 75


LINES = json.loads((Path(__file__).parents[2] / "authorities" / "leads_lines.json").read_text("utf-8"))["records"]


def test_entries_by_a_line_and_exits_along_the_normal():
    """Before an inside corner the line ends where the offsets meet; after G40 any move leads to the programmed place."""
    run_by_both = along_the_normal = 0
    for record in LINES:
        run = mnclab.run(record["text"], "g43", Setup(settings={"dialect": "linuxcnc", "stopped_spindle": "accept"}))
        assert run.ok <= ("error" not in record), record["name"]
        if not run.ok:  # a contour that the tool would cut into is refused here, by LinuxCNC not always
            continue
        run_by_both += 1
        ends = [row.end for row in run.toolpath.motion]  # a rapid to where the tool is is no row
        assert np.abs(np.array(ends) - [row["to"] for row in record["motion"][1:]]).max() < 1e-7, record["name"]
        if "Z" in record["text"]:
            along_the_normal += 1
            (warning,) = [alarm for alarm in run.alarms if "onto the contour, as on LinuxCNC" in alarm.message]
            assert warning.severity == "warning" and "G40" in warning.hint
    assert run_by_both >= 55 and along_the_normal >= 30


def test_an_entry_without_room_for_its_inside_corner():
    text = "G0 X0 Y0\nG41.1 D4\nG1 X-4 Y-9 F100\nX17 Y17\nX-15 Y-11\nM2\n"  # rs274 refuses it
    run = mnclab.run(text, "g43", Setup(settings={"dialect": "linuxcnc"}))
    assert "the inside corner behind the entry leaves nothing of its line" in [alarm.message for alarm in run.alarms]

"""Presets (TNC 620, chapter 15): the examples of the manual against parts, with the numbers of the catalogue.

The numbers are in tests/authorities/catalogue/tnc620-probing-presets.json, rounded there: touches to 5 decimals, moves to 4. The
parts are those of its `expected`, their surfaces at Z 0 where it names none.
"""

import json
import re
from pathlib import Path

import numpy as np
import pytest

import mnclab as mnc
from mnclab import Kind
from mnclab.workpiece.part import box, cylinder, hole, plane, pocket, slot

from tests.probed import gaps

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-probing-presets.json"
CASES = json.loads(FILE.read_text(encoding="utf-8"))
PRESET = (100, 200, -300)
BALL = 2
ROUNDED, SHOWN = 1e-5, 1e-4  # of touches and results; of moves


def block(top):
    return box((-60, -60, -30), (220, 220, top))


def holes(top, diameter, centres):
    part = block(top)
    for x, y in centres:
        part = part - hole((x, y, top), diameter, 20)
    return part


STUD = box((50.12 - 30.02, 49.91 - 10.01, -30), (50.12 + 30.02, 49.91 + 10.01, 0))
PARTS = {
    "TCH PROBE 408": lambda check: block(0.03) - slot((50.12, -20, 0.03), (50.12, 120, 0.03), 25.06, 20),
    "TCH PROBE 409": lambda check: box((50.12 - 12.53, -20, -30), (50.12 + 12.53, 120, 0)),
    "TCH PROBE 410": lambda check: block(0.03) - pocket((50.12, 49.91, 0.03), 60.04, 20.02, 20),
    "TCH PROBE 411": lambda check: STUD,
    "TCH PROBE 412": lambda check: block(0) - hole((50.08, 49.93, 0), 75.05, 20),
    "TCH PROBE 413": lambda check: cylinder((50.08, 49.93, -30), (50.08, 49.93, 0.03), 74.96 / 2),
    "TCH PROBE 414": lambda check: box((-104.8, 6.8, -30), (95.2, 206.8, 0.03)).turned(1.5, (95.2, 6.8)),
    "TCH PROBE 415": lambda check: block(0) - box((36.7, 7.3, -20), (236.7, 207.3, 20)).turned(1.5, (36.7, 7.3)),
    "TCH PROBE 416": lambda check: holes(0.03, 12.02, check["holes"]),
    "TCH PROBE 417": lambda check: plane((0, 0, 25.07), (0, 0, 1)),
    "TCH PROBE 418": lambda check: holes(0.03, 10.03, check["holes"]),
    "TCH PROBE 419": lambda check: box((25.06, -50, -30), (90, 90, 40)),
    "example 15.14": lambda check: cylinder((25.03, 24.98, -30), (25.03, 24.98, 25.04), 15.01),
    "example 15.15": lambda check: holes(25.03, 8.02, check["hole_centers_measured"]),
}
#: Examples that are another one with other values.
VARIED = {
    "narrow slot (arithmetic): Q311=7, other data as above": {"Q311": 7},
    "three points (arithmetic): Q423=3, Q247=+120": {"Q423": 3, "Q247": 120},
    "Q272=3, Q267=-1 (arithmetic), other data as above": {"Q272": 3, "Q267": -1},
}


def example(case, **values):
    """The text of an example, with other values of parameters."""
    text = case["program"] or next(each["program"] for each in CASES if each["code"] == case["code"])
    for name, value in (VARIED.get(case["title"], {}) | values).items():
        text = re.sub(rf"(?m)^{name}=\S+", f"{name}={value:+g}", text)
    return text


def part_of(case):
    made = PARTS[case["code"]](case["check"])
    if case["title"].startswith("narrow"):
        return block(0) - slot((50.12, -20, 0), (50.12, 120, 0), 7.06, 20)
    if case["title"].startswith("Q272=3"):
        return plane((0, 0, 25.07), (0, 0, 1))
    return made


def probing(text, part, active=1, **setup):
    """Run a text; the part is in coordinates of the preset."""
    begin = "" if "TOOL CALL" in text else "TOOL CALL 69 Z\n"
    lines = re.sub(r"(?m)^(1 TOOL CALL 69 Z)$", r"\1\nL Z+100 R0 FMAX", begin + text)
    lines = lines if begin == "" else lines.replace("TOOL CALL 69 Z\n", "TOOL CALL 69 Z\nL Z+100 R0 FMAX\n", 1)
    given = {
        "tools": {69: mnc.Tool(radius=BALL, kind="probe")}, "presets": {active: PRESET}, "settings": {"preset": active},
        "part": part.shifted(*PRESET), "probe": mnc.Probe(clearance=2, reach=10),
        "files": {"35K47.H": "BEGIN PGM 35K47 MM\nL X+0 Y+0 FMAX\nEND PGM 35K47 MM\n",
                  "35KLZ.H": "BEGIN PGM 35KLZ MM\nL X+0 Y+0 FMAX\nEND PGM 35KLZ MM\n"},
    }  # fmt: skip
    return mnc.run(lines, "tnc-620", mnc.Setup(**(given | setup)))


def moves(run, first=1):
    """The rows after the positioning in front of the cycle: kind and end."""
    rows = run.toolpath.motion[first:]
    return [(Kind(kind).name, *end) for kind, end in zip(rows.kind, rows.end.tolist())]


def told(listed, place):
    """The moves of the catalogue in the same form; a coordinate that is not named stays."""
    found, place = [], list(place)
    for line in listed:
        for axis, value in re.findall(r"([XYZ])(-?[\d.]+)", line):
            place["XYZ".index(axis)] = float(value)
        found.append(("PROBE" if line.startswith("probe") else "ARC" if line.startswith("arc") else "RAPID", *place))
    return found


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case['code']} {case['title'][:12]}")
def test_an_example(case):
    check, part = case["check"], part_of(case)
    run = probing(example(case), part, 4 if case["code"] == "example 15.15" else 1)
    assert run.ok, run.alarms
    assert gaps(run, part, BALL).min() >= -1e-6
    touches = [*([check["touch_417"]] if "touch_417" in check else []), *check.get("touches", check.get("touches_hole_1", []))]
    extra = [check["touch_ts_axis"]] if "touch_ts_axis" in check else []
    for found, expected in [*zip(run.touches, touches), *zip(run.touches[len(run.touches) - len(extra) :], extra)]:
        assert found.start == pytest.approx(expected["start"], abs=ROUNDED)
        assert found.centre == pytest.approx(expected["ball_center"], abs=ROUNDED)
        assert found.direction == pytest.approx(expected["direction"], abs=ROUNDED)
        assert np.linalg.norm(np.subtract(found.centre, found.start)) == pytest.approx(expected["travel"], abs=ROUNDED)
    if "touches" in check:
        assert len(run.touches) == len(touches) + len(extra)
    if "starts" in check:
        assert [each.start for each in run.touches[:2]] == [pytest.approx(start, abs=ROUNDED) for start in check["starts"]]
    listed = [*check.get("moves_417", []), *check.get("moves_416_south_pole_at_Z50_before", []), *check.get("moves", [])]
    if listed:
        made = moves(run)
        for (kind, *end), (expected, *place) in zip(made, told(listed, (0, 0, 100)), strict=False):
            assert kind == expected and end == pytest.approx(place, abs=SHOWN)
        after = 1 if "example" in case["code"] else 0  # the called program
        assert len(made) == len(listed) + after
    for name, value in check.get("results", {}).items():
        assert run.variables[name] == pytest.approx(value, abs=ROUNDED)
    for key, row in check.items():
        if found := re.fullmatch(r"preset_row_(\d+)", key):
            for axis, value in row.items():
                assert getattr(run.tables.presets[int(found[1])], axis.lower()) == pytest.approx(value, abs=ROUNDED)
            untouched = {"X", "Y", "Z"} - set(row)  # of a row that is not the active one: stays, as empty as it was
            assert int(found[1]) == 0 or all(getattr(run.tables.presets[int(found[1])], a.lower()) == 0 for a in untouched)
    if "active_row" in check:
        assert run.final.memory.preset == check["active_row"]
    if "example" in case["code"]:
        assert run.toolpath.end[-1][:2] == pytest.approx(check.get("display", (check["results"]["Q151"], check["results"]["Q152"]))
                                                         if "15.15" in case["code"] else (25.03, 14.98), abs=ROUNDED)

"""Base rotation and datums from measurements (MNC 12.1 to 12.12): the catalogue's checks, number by number.

The checks stand in tests/authorities/catalogue/mnc-probing.json: positions are those of the program where the cycle begins, x and
y of the ball's centre, z of its lowest point.
"""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from controls.mnc.probing_mnc import DATUM, at, base_of, box, disc, measured, probes, rows_of, working
from tools.probed import gaps

from mnclab import Datum, Kind
from mnclab.workpiece import part as parts

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "mnc-probing.json"
HERE = ("G400", "G404", *(f"G{n}" for n in range(408, 416)), "G417", "G419")
EXAMPLES = [each for each in json.loads(FILE.read_text(encoding="utf-8")) if each["code"] in HERE]
WAYS = {"+X": (1, 0, 0), "-X": (-1, 0, 0), "+Y": (0, 1, 0), "-Y": (0, -1, 0), "-Z": (0, 0, -1)}
KINDS = {"position": (Kind.LINE, 2000), "measure": (Kind.PROBE, 200)}
#: Numbers of a check, and what the record of the run calls them.
NAMES = {"width": "width", "diameter": "diameter", "angle": "angle", "touch_z": "Z"}
BALL = 3


def near(number):
    return pytest.approx(number, abs=1.0001e-3 / 20)  # the checks are rounded to four decimals


def feature(given):
    """A part of a check: its corner is the lower left one before turning."""
    if given["type"] == "plane":
        return parts.plane((0, 0, given["z"]), (0, 0, 1))
    inside, top = given["material"] == "inside", given["top"]
    if given["type"] == "circle":
        return disc(given["center"], given["diameter"], top, inside)
    size, angle = given["size"], given["angle"]
    centre = given.get("center")
    if centre is None:
        centre = (at((*given["corner"], 0), angle) @ (size[0] / 2, size[1] / 2, 0, 1))[:2]
    return box(centre, size, angle, top, inside)


def example_run(example):
    features = example["check"].get("workpiece")
    return measured(example["program"], features and feature(features[0]), before="")


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda each: f"{each['code']} {each['title']}")
def test_an_example_of_the_catalogue(example):
    check, run = dict(example["check"]), example_run(example)
    assert run.ok, run.alarms
    lines = example["program"].splitlines()
    cycle = next(n for n, text in enumerate(lines, 1) if f" {example['code']} " in text)
    rows, back = rows_of(run, cycle), at((0, 0, 0), 10 if "G404 E10" in example["program"] else 0).T
    places = rows.end @ back[:3, :3].T  # the origin of the path is row 1

    moves = check.pop("moves", [])
    assert len(rows) == len(moves)
    for row, place, move in zip(rows, places, moves):
        assert (row.kind, row.feed) == KINDS[move["move"]]
        assert place == near((move["x"], move["y"], move["z"]))
    touches = check.pop("touches", [])
    assert len(run.touches) == len(touches)
    for row, touch, expected in zip(probes(run), run.touches, touches):
        start, end = back[:3, :3] @ row.start, back[:3, :3] @ row.end
        assert [start["xyz".index(axis)] for axis in expected["from"]] == near([*expected["from"].values()])
        assert (end - start) / np.linalg.norm(end - start) == pytest.approx(WAYS[expected["dir"]], abs=1e-12)
        assert np.linalg.norm(end - start) == near(expected["travel"])
        found = {**dict(zip("xyz", touch.programmed)), "tip": touch.programmed[2] - BALL}
        assert [found[axis] for axis in expected.get("ball", {})] == near([*expected.get("ball", {}).values()])
        assert found["tip"] == near(expected.get("tip", {}).get("z", found["tip"]))

    assert base_of(run) == near(check.pop("base_rotation", 0))
    assert working(run) == near([*check.pop("active", dict(zip("xyz", DATUM))).values()])
    stored = {row.pop("row"): row for row in check.pop("rows")}
    assert set(run.tables.datums) == {1, *stored}
    for number, row in stored.items():
        assert run.tables.datums[number]._asdict() == near(Datum()._asdict() | row)
    for position in check.pop("positions", []):
        place = run.toolpath.end[-1] + run.toolpath.origin
        assert place[:2] == near((position["x_machine"], position["y_machine"]))

    found, axis = run.measured, "Y" if "L2" in example["program"] else "X"
    for name in ("centre", "corner"):
        value = check.pop(name, None)
        for key, number in (value if isinstance(value, dict) else {} if value is None else {axis: value}).items():
            assert found[f"{name} {key.upper()}"] == near(number)
    for key, number in check.pop("size", {}).items():
        assert found[f"length {key.upper()}"] == near(number)
    if "touch" in check:
        assert found[axis] == near(check.pop("touch"))
    for name in [each for each in check if each in NAMES]:
        assert found[NAMES[name]] == near(check.pop(name))
    assert set(check) <= {"workpiece"}
    if run.touches:
        part = feature(example["check"]["workpiece"][0]).placed(at(DATUM))
        assert gaps(run, part, BALL).min() > -1e-6


def test_the_place_after_an_alignment():
    """The first example goes on: program X 100 lies at 300 + 100 cos 2.5, 200 + 100 sin 2.5."""
    example = EXAMPLES[0]
    run = measured(example["program"] + "G0 X100 Y0\n", feature(example["check"]["workpiece"][0]), before="")
    expected = 300 + 100 * math.cos(math.radians(2.5)), 200 + 100 * math.sin(math.radians(2.5)), -380
    assert run.toolpath.end[-1] + run.toolpath.origin == pytest.approx(expected, abs=1e-9)
    assert run.at(line=4).position == pytest.approx((100, 0, 20), abs=1e-9)

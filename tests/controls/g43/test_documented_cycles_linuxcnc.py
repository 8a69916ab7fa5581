"""Situations of LinuxCNC's documentation against its motion (tests/authorities/generate_iso_cycles.py) and closed forms."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup

RECORDS = json.loads((Path(__file__).parents[2] / "authorities" / "iso_cycles.json").read_text("utf-8"))["records"]
TEXTS = {record["name"]: record["text"] for record in RECORDS}
KINDS = {"rapid": Kind.RAPID, "line": Kind.LINE, "arc": Kind.ARC}


def run(text):
    found = mnclab.run(text, "iso", Setup(settings={"dialect": "linuxcnc"}))
    assert found.ok, found.alarms
    return found.toolpath.motion, np.array(found.toolpath.origin)


def one_way(rows):
    """Rows (line, kind, end, feed); two of a kind one after the other along Z, the same way, are one."""
    found = []
    for row in rows:
        if len(found) > 1 and row[1] == found[-1][1] and (row[1] == Kind.RAPID or row[0] == found[-1][0]):
            a, b, c = (np.array(one[2]) for one in (found[-2], found[-1], row))
            if max(abs(a - b)[:2].max(), abs(b - c)[:2].max()) < 1e-9 and (b - a)[2] * (c - b)[2] > 0:
                found.pop()
        found.append(row)
    return found


@pytest.mark.parametrize("record", RECORDS, ids=lambda record: record["name"])
def test_the_motion_of_linuxcnc(record):
    path, origin = run(record["text"])
    ours = one_way((m.line, m.kind, m.end + origin, m.feed) for m in path)
    theirs = one_way((m["line"], KINDS[m["kind"]], np.array(m["to"]), m.get("feed", math.inf)) for m in record["motion"])
    assert [row[:2] for row in ours] == [row[:2] for row in theirs]
    for mine, its in zip(ours, theirs):
        assert np.abs(mine[2] - its[2]).max() < 1e-9, (mine, its)
        assert mine[3] == pytest.approx(its[3])


def turned(x, y):
    """A point of the system that is turned by 30 degrees about its origin, X10 Y-5."""
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
    return 10 + x * c - y * s, -5 + x * s + y * c


FRAME = [(10 * k, 0) for k in (1, 2, 3, 4)] + [(40, 10 * k) for k in (1, 2, 3)] + [(10 * k, 30) for k in (3, 2, 1)]
UP = 0.5 + 0.1 - 0.25  # the numbers of R and Z counted anew under G91, from the initial level
#: Where holes end, in order: x, y, z.
HOLES = {
    "g81 absolute, back to the initial level": [(4, 5, 1.5)],
    "g81 in increments, three times, R above the start": [(1 + 4 * k, 2 + 5 * k, 3 + 1.8 - 0.6) for k in (1, 2, 3)],
    "g81 in increments, four times at level R": [(7 * k, -2 * k, 10 - 8 - 6) for k in (1, 2, 3, 4)],
    "a row of holes and another beside it": [(9 * k, y, 4 - 2 - depth) for y, depth in ((0, 5), (9, 3)) for k in (1, 2, 3, 4)],
    "twelve holes as a frame": [(*place, 9 - 7 - 9) for place in [*FRAME, (10, 20), (10, 10)]],
    "another R in a later block": [(5, 0, -4), (10, 0, -8), (15, 0, -8)],
    "inches": [
        (25.4 * x, 25.4 * y, 25.4 * z) for x, y, z in ((1, 0.5, -0.25), (2, 0.5, -0.25), (2.5, 1, UP), (3, 1.5, UP))
    ],
    "g91 and g90 within a cycle": [(5, 5, -3), (15, 5, 8 + 1 - 3), (25, 7, 8 + 1 - 3), (0, 7, -3)],
    "cycle in a turned system": [
        (*turned(x, y), z) for x, y, z in ((20, 0, -3), (30, 10, -3), *((x, 10, 8 + 1 - 3) for x in (35, 40, 45)))
    ],
    "cycle in a local system": [(15, 20, -5), (20, 20, -5)],
    "cycle after g92": [(15, 15, 0), (20, 15, 0)],  # Z8 is called 5: -3 is 0
    "cycle goes over to another system": [(5, 0, -3), (105, -20, -3), (109, -20, -3), (9, -20, -3)],
}


@pytest.mark.parametrize("name", HOLES)
def test_where_the_holes_end(name):
    path, origin = run(TEXTS[name])
    down = (path.kind == Kind.LINE) & (path.end[:, 2] < path.start[:, 2])
    assert path.end[down] + origin == pytest.approx(np.array(HOLES[name], dtype=float), abs=1e-9)


def test_pecks_go_to_level_r_and_back_to_a_hundredth_of_an_inch_above():
    """From 1: -2, -5, -8, -10; between them at 1 and 0.254 above the last depth."""
    path, _ = run(TEXTS["g83 to level R between pecks"])
    first = path.end[path.line == 4][1:, 2]
    assert first == pytest.approx([1, -2, 1, -1.746, -5, 1, -4.746, -8, 1, -7.746, -10, 1], abs=1e-9)
    path, _ = run(TEXTS["g73 lifts a little"])
    assert path.end[path.line == 4][1:, 2] == pytest.approx([1, -2, -1.746, -5, -4.746, -8, -7.746, -10, 1], abs=1e-9)

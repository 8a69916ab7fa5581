"""Five thousand random programs against LinuxCNC's recorded motion: planes, units, arcs, offsets, turned systems, cycles,
sub-programs, formulas, loops; and five hundred of cycles within which everything changes; see
`tests/authorities/iso_programs.py`."""

import gzip
import json
import sys
from pathlib import Path

import numpy as np
import pytest
from tools.together import together

import mnclab
from mnclab import Kind, Setup

AUTHORITIES = Path(__file__).parents[2] / "authorities"
sys.path.insert(0, str(AUTHORITIES))
import iso_programs  # noqa: E402

RECORDS = json.loads(gzip.decompress((AUTHORITIES / "iso.json.gz").read_bytes()))["records"]
HOLES = json.loads(gzip.decompress((AUTHORITIES / "iso_holes.json.gz").read_bytes()))["records"]
HOLE_PARTS = iso_programs.changing_holes, iso_programs.changing_holes, iso_programs.systems, iso_programs.unit
KINDS = {"r": Kind.RAPID, "f": Kind.LINE, "a": Kind.ARC}
FEW = 25  # programs a test; the first of every such lot are tried each time, all of them in the deep tests


def joined(rows):
    """Rows (line, kind, end, …); two of a kind one after the other along Z, the same way, are one (feeds: of a line)."""
    found = []
    for row in rows:
        if len(found) > 1 and row[1] == found[-1][1] and (row[1] == Kind.RAPID or row[:2] == found[-1][:2]):
            a, b, c = (np.array(one[2]) for one in (found[-2], found[-1], row))
            if max(abs(a - b)[:2].max(), abs(b - c)[:2].max()) < 1e-9 and (b - a)[2] * (c - b)[2] > 0:
                found.pop()
        found.append(row)
    return found


def agree(record, parts=iso_programs.PARTS):
    """Run one and compare every row."""
    run = mnclab.run(iso_programs.program(record["seed"], parts)[0], "iso", Setup(settings={"dialect": "linuxcnc"}))
    assert run.ok, run.alarms
    ours = joined((m.line, m.kind, m.end, m) for m in run.toolpath.motion)
    theirs = joined((row[0], KINDS[row[1]], np.array(row[2:5]) * 1e-9, row[5:]) for row in record["rows"])
    assert [row[:2] for row in ours] == [row[:2] for row in theirs]
    for (line, kind, end, move), (*_, expected, more) in zip(ours, theirs):
        near = 1e-9 * np.maximum(1, np.abs(expected))
        assert (np.abs(end - expected) <= near).all(), (line, end, expected)
        if kind != Kind.RAPID:
            assert move.feed == pytest.approx(more[0], rel=1e-9), line
        if kind == Kind.ARC:
            centre = np.array(more[1:4]) * 1e-9
            assert np.abs(move.centre - centre).max() <= 2e-9 * max(1, np.abs(centre).max()), line
            assert abs(move.sweep) == pytest.approx(abs(more[4]), abs=1e-7), line


def by_hundreds(records):
    return together("record", records, lambda record: f"seeds from {record['seed'] // 500 * 500}", lambda record: record["seed"])


@by_hundreds(RECORDS[::FEW])
def test_some(record):
    agree(record)


@by_hundreds(HOLES[::10])
def test_some_of_changing_holes(record):
    agree(record, HOLE_PARTS)


@pytest.mark.deep
def test_all_of_changing_holes():
    assert len(HOLES) == 500
    for record in HOLES:
        agree(record, HOLE_PARTS)


@pytest.mark.deep
@pytest.mark.parametrize("first", range(0, len(RECORDS), FEW))
def test_all(first):
    for record in RECORDS[first : first + FEW]:
        agree(record)


def test_there_are_five_thousand():
    assert len(RECORDS) == 5000 and len({record["seed"] for record in RECORDS}) == 5000

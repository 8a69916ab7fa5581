"""MNC programs against LinuxCNC's interpreter, where both languages mean the same; see tests/authorities/README.md."""

import json
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup, Tool

AUTHORITIES = Path(__file__).parents[2] / "authorities"
KINDS = {"rapid": Kind.RAPID, "line": Kind.LINE, "arc": Kind.ARC}
EXACT = 1e-9  # mm


def records(name):
    return json.loads((AUTHORITIES / name).read_text(encoding="utf-8"))["records"]


def compare(path, motion, tolerance=EXACT):
    """Every motion row against the recorded one: line, kind, end, centre, sweep."""
    origin, moves = path.origin, path.motion
    assert [(int(k), int(n)) for k, n in zip(moves.kind, moves.line)] == [(KINDS[m["kind"]], m["line"]) for m in motion]
    assert np.abs(moves.end + origin - np.array([m["to"] for m in motion])).max() <= tolerance
    arcs = [i for i, m in enumerate(motion) if m["kind"] == "arc"]
    for i in arcs:
        assert np.abs(moves.centre[i] + origin - motion[i]["centre"]).max() <= tolerance
        assert moves.sweep[i] == pytest.approx(motion[i]["sweep"], abs=1e-9)
        assert np.array_equal(moves.axis[i], motion[i].get("axis", [0, 0, 1]))


@pytest.mark.parametrize("record", records("motion.json"), ids=lambda r: r["name"])
def test_motion(record):
    datums = {int(row): tuple(offset) for row, offset in record.get("datums", {}).items()}
    run = mnclab.run(record["mnc"], "mnc", Setup(datums=datums))
    assert run.ok, run.alarms
    compare(run.toolpath, record["motion"])


@pytest.mark.parametrize(
    "record", [r for r in records("compensation.json") if not r.get("refused")], ids=lambda r: r["name"]
)
def test_compensation(record):
    run = mnclab.run(record["mnc"], "mnc", Setup(tools={1: Tool(radius=record["radius"])}))
    assert run.ok, run.alarms
    compare(run.toolpath, record["motion"])


@pytest.mark.parametrize(
    "record", [r for r in records("compensation.json") if r.get("refused")], ids=lambda r: r["name"]
)
def test_gouging_is_refused_here_too(record):
    run = mnclab.run(record["mnc"], "mnc", Setup(tools={1: Tool(radius=record["radius"])}))
    assert not run.ok

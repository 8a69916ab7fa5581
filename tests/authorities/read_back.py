"""What LinuxCNC made of an export, against the run that was exported; for the tests."""

import math

import numpy as np

from mnclab import Kind
from mnclab.show.export_gcode import DECIMALS, lines, plain

KINDS = {"rapid": (Kind.RAPID,), "feed": (Kind.LINE, Kind.PROBE), "arc": (Kind.ARC,)}
EXACT = 1e-6  # mm: the file has six decimals
DRUMS = {"drum_cam", "drum_window"}  # samples that turn an axis: the machine that is asked has X, Y and Z alone


def blocks_of(run):
    """The blocks of an export, without comments."""
    return [block for block in lines(run) if not block.startswith("(")]


def same_motion(run, record):
    """Every move of the run, and nothing else: its kind, end, feed, and the centre and sense of an arc."""
    path, found = plain(run.toolpath).motion, record["motion"]
    assert record["ok"], record["error"]
    shown = np.abs(np.round(path.end, DECIMALS) - np.round(path.start, DECIMALS)).max(axis=1) > 0
    path = path[shown | (path.kind == Kind.ARC)]  # a line too short for the file is not written
    if path.kind[0] != Kind.RAPID:
        found = found[1:]  # the rapid to where the path begins
    assert len(found) == len(path)
    assert np.abs(np.array([move["to"] for move in found]) - path.end).max() < EXACT
    for move, row in zip(found, path, strict=True):
        assert row.kind in KINDS[move["kind"]]
        assert row.kind == Kind.RAPID or row.synchronous or math.isclose(move["feed"], row.feed, abs_tol=1e-4)
        if row.kind == Kind.ARC:
            spoke = (np.array(move["centre"]) - row.centre) * (1 - np.abs(row.axis))
            assert np.abs(spoke).max() < 2 * EXACT
            assert math.copysign(1, move["turns"]) == math.copysign(1, row.sweep * row.axis.sum())
            assert abs(abs(move["turns"]) - math.ceil(abs(row.sweep) / math.tau - 1e-6)) == 0

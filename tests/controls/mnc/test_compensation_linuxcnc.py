"""1,280 random contours against LinuxCNC: the same path, the same refused; see tests/authorities/README.md.

LinuxCNC looks at an element and its neighbours. Of what it accepts we refuse what meets the contour farther on, and
nothing else; what it refuses we refuse too. The records know by samples which paths keep clear of the contour. A contour
that crosses itself is taken as it is written by both: no tool of any size would keep clear of it.
"""

import gzip
import json
from pathlib import Path

import numpy as np
import pytest
import shapely
from tools.running import run

from mnclab import Kind, Tool

pytestmark = pytest.mark.deep

FILE = Path(__file__).parents[2] / "authorities" / "contours.json.gz"
RECORDS = json.loads(gzip.decompress(FILE.read_bytes()))["records"]
EXACT = 1e-9  # mm: LinuxCNC hands doubles over in inches


def obeyed(record, **settings):
    return run(record["mnc"], ok=None, tools={1: Tool(radius=record["radius"])}, **settings)


def same_path(path, rows):
    """Ends, centres and sweeps from the entry to the exit."""
    first = int(np.argmax(path.side != 0))
    kept = path[first : first + len(rows)]
    assert kept.line.tolist() == [row[0] for row in rows]
    assert np.abs(kept.end[:, :2] - np.array([row[1:3] for row in rows])).max() <= EXACT
    arcs = [k for k, row in enumerate(rows) if len(row) > 3]
    assert np.flatnonzero(kept.kind == Kind.ARC).tolist() == arcs
    if arcs:
        assert np.abs(kept.centre[arcs, :2] - np.array([rows[k][3:5] for k in arcs])).max() <= EXACT
        assert np.abs(kept.sweep[arcs] - np.array([rows[k][5] for k in arcs])).max() <= EXACT


def crosses_itself(path):
    """Whether the programmed contour does."""
    walls = path[np.flatnonzero((path.side != 0) & path.is_motion)[1:]]
    return not shapely.LineString(walls.points(1e-4)[0][:, :2]).is_simple


@pytest.mark.parametrize("family", sorted({record["family"] for record in RECORDS}))
def test_same_path_and_same_refused(family):
    for record in (r for r in RECORDS if r["family"] == family):
        found = obeyed(record)
        if found.ok != record.get("clear", False):
            assert found.ok and "refused" not in record and crosses_itself(found.programmed), record["mnc"]
        if "rows" not in record:
            continue
        if not found.ok:  # cut anyway, the path is the same; where an arc is used up LinuxCNC turns the other way round
            found = obeyed(record, gouge="mark")
            assert found.ok and found.toolpath.gouge.any()
            if {gouge.kind for gouge in found.gouges} & {"arc", "element"}:
                continue
        same_path(found.toolpath, record["rows"])


def test_there_are_enough():
    assert sum("rows" in record for record in RECORDS) > 1000

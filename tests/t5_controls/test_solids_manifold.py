"""What is left of a blank beside solids of `manifold3d`: volumes and heights of 70 programs, recorded once."""

import json
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Setup, Tool
from mnclab.workpiece.milling import milled

FILE = Path(__file__).parents[1] / "authorities" / "solids.json"
RECORDS = json.loads(FILE.read_text())["programs"]
FACETS = 0.008  # mm, by which a facet of the recorded solids misses a round surface

pytestmark = pytest.mark.deep


def cut(record):
    tools = {int(number): Tool(number=int(number), **sizes) for number, sizes in record["tools"].items()}
    run = mnclab.run(record["text"], "g43", Setup(tools=tools, stock=record["stock"]))
    assert not [alarm for alarm in run.alarms if alarm.severity == "alarm"]
    return run


@pytest.mark.parametrize("record", RECORDS, ids=lambda record: record["name"])
def test_volume_and_heights(record):
    """Within 0.1 %, of which a part is the facets' own."""
    part = cut(record).workpiece()
    assert part.method == "exact sweep"
    assert part.removed == pytest.approx(record["removed"], rel=1e-3)
    x, y, z = np.array(record["heights"]).T
    assert np.abs(part.at(x, y) - z).max() < FACETS


@pytest.mark.parametrize("record", RECORDS[::5], ids=lambda record: record["name"])
def test_the_erosion_of_the_same(record, monkeypatch):
    """Walls may stand `error` mm off, so a volume does as far as they are long."""
    monkeypatch.setattr(milled, "EXACT", 0)
    part = cut(record).workpiece(step=0.1)
    assert part.method == "erosion of the height raster"
    assert part.removed == pytest.approx(record["removed"], rel=0.02)

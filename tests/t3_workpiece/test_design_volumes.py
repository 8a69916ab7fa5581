"""Volumes of designs: of 120 random ones what manifold3d says, of features that stand apart closed forms."""

import json
import time
from math import pi, radians, tan
from pathlib import Path

import pytest

from mnclab.text.toml_file import File, table_of
from mnclab.workpiece.design.design_file import design_of, text_of

RECORDS = json.loads((Path(__file__).parents[1] / "authorities" / "designs.json").read_text())["designs"]


@pytest.mark.deep
@pytest.mark.parametrize("record", RECORDS, ids=lambda record: record["name"])
def test_manifold_weighs_the_same(record):
    """A third of what half as many corners change is the error of its facets; 1e-7 is that of six digits."""
    design = design_of(table_of(record["text"]), File("design.toml", record["text"]))
    facets = abs(record["volume"] - record["coarse"])
    assert design.volume == pytest.approx(record["volume"], rel=1e-7, abs=0.6 * facets + 1e-4)
    text = text_of(design)
    assert design_of(table_of(text), File("design.toml", text)) == design

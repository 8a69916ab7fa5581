"""The lowest versions that pyproject.toml declares, each with the call that needs it.

Authority: the release notes of the packages. shapely 2.1: `maximum_inscribed_circle`; matplotlib 3.10:
`Artist.get_figure(root=)`; pyvista 0.47: `extract_surface(algorithm=)`. Tried, as
no note tells it: from pdoc 14 on a page shows the `own_members` of its classes. `tests/floors.py` runs a sample with them.
"""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from floors import ROOT, floors

NEEDS = {
    "shapely": ("2.1", "shapely.maximum_inscribed_circle("),
    "matplotlib": ("3.10", "get_figure(root="),
    "pdoc": ("14", "one.own_members = "),
    "pyvista": ("0.47", "extract_surface(algorithm="),
}


@pytest.mark.parametrize("name", NEEDS)
def test_the_floor_is_where_the_call_came(name):
    low, call = NEEDS[name]
    assert floors()[name] == low
    assert any(call in file.read_text(encoding="utf-8") for file in (ROOT / "mnclab").rglob("*.py"))


def test_every_package_has_a_floor():
    assert set(floors()) == {"numpy", "shapely", "matplotlib", "pyvista", "ipywidgets", "jupyterlab", "ezdxf", "pdoc"}

"""Each sample program that has a design makes it: the comparison says so, and measures what the program says."""

from dataclasses import replace
from pathlib import Path

import pytest

import mnclab as mnc
from mnclab.machine import setup_file

DATA = Path(__file__).resolve().parents[2] / "data"
DESIGNS = {"/".join((path.parent.name, path.stem)): path for path in sorted(DATA.glob("designs/*/*.toml"))}
PROGRAMS = {"/".join((path.parent.name, path.stem)): path for path in sorted(DATA.glob("programs/*/*"))}
BOTH = sorted(DESIGNS.keys() & PROGRAMS.keys())


def run_of(name):
    setup = DATA / "setups" / f"{name}.toml"
    return mnc.run(PROGRAMS[name], setup=setup_file.load(setup) if setup.exists() else None)


def test_mills_and_lathes_have_designs():
    lathes = [name for name in BOTH if name.startswith(("jnc-t01/", "nc-31/"))]
    assert len(lathes) >= 2 and len(BOTH) - len(lathes) >= 3


@pytest.mark.parametrize("name", BOTH)
def test_a_sample_makes_its_design(name):
    found = run_of(name).workpiece().compare(DESIGNS[name])
    assert found.ok, found
    assert not found.features.outside and max(found.worst_gouge.value, found.worst_rest.value) < 0.005


def test_a_mill_that_is_thinner_than_its_table_leaves_as_much_on_every_wall():
    """Radius 4.9 in the cut, 5 in the path: walls 0.1 nearer, lengths and diameters 0.2 less, floors as they are."""
    run = run_of("mnc/milled_plate")
    tools, text = dict(run.setup.tools), PROGRAMS["mnc/milled_plate"].read_text("utf-8").replace("T1 S4000", "T1 D11 S4000")
    thin = replace(run.setup, tools=tools | {1: replace(tools[1], radius=4.9), 11: tools[1]})
    found = mnc.run(text, "mnc", thin).workpiece().compare(DESIGNS["mnc/milled_plate"])
    off = {(row.feature, row.measure): row.deviation for row in found.features if abs(row.deviation) > 1e-6}
    expected = {("pocket A", "length"): -0.2, ("pocket A", "width"): -0.2, ("pocket A", "corner radius"): -0.1,
                ("pocket A", "form"): 0.1, ("pocket B", "diameter"): -0.2, ("pocket B", "form"): 0.1}  # fmt: skip
    assert off == pytest.approx(expected, abs=1e-5)
    assert {row.line for row in found.features.outside} == {8, 10}  # the cycles of the pockets, in their lines
    mended = mnc.run(text, "mnc", replace(thin, tools=thin.tools | {11: replace(tools[1], dr=-0.1)}))
    assert mended.workpiece().compare(DESIGNS["mnc/milled_plate"]).ok

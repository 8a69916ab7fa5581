"""Help, forms and the table itself name the parameters of a cycle in the order of the manual."""

import json
from pathlib import Path

import pytest

import mnclab

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "parameters-mnc.json"
TABLES = {entry["code"]: entry["parameters"] for entry in json.loads(FILE.read_text(encoding="utf-8"))}
CYCLES = mnclab.controls["mnc"].cycles


@pytest.mark.parametrize("code", sorted(TABLES.keys() & CYCLES.keys()))
def test_parameters_stand_in_the_order_of_the_manual(code):
    manual = [row["address"] for row in TABLES[code]]
    assert [parameter.address for parameter in CYCLES[code].parameters()] == manual
    rows = str(mnclab.help(code, "mnc")).partition("\n-")[2].splitlines()[1:]
    assert [row.split()[0] for row in rows if row[0] != " "] == manual


@pytest.mark.parametrize("control", ["mnc", "g43"])
def test_a_base_of_cycles_declares_nothing(control):
    """What a cycle has is written where it stands; a base of them has none, and no base of its own."""
    for cycle in set(mnclab.controls[control].cycles.values()):
        bases = [base for base in cycle.__mro__[1:] if issubclass(base, mnclab.machine.cycle.Cycle)]
        assert len(bases) == 2
        assert not any(base.parameters() for base in bases)

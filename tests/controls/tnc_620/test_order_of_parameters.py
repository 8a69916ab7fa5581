"""Milling cycles name their parameters in the order of the manual, and declare them where they stand."""

import json
from pathlib import Path

import pytest

import mnclab
from mnclab.machine.cycle import Cycle

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "parameters-tnc-620.json"
TABLES = {entry["code"]: entry["parameters"] for entry in json.loads(FILE.read_text(encoding="utf-8"))}
NUMBERS = (225, 232, 233, 251, 252, 253, 254, 256, 257, 258, 262, 263, 264, 265, 267)
CYCLES = {f"CYCL DEF {n}": mnclab.controls["tnc-620"].cycles[f"CYCL DEF {n}"] for n in NUMBERS}


@pytest.mark.parametrize("code", CYCLES)
def test_parameters_stand_in_the_order_of_the_manual(code):
    manual = [row["address"] for row in TABLES[code]]
    assert [parameter.address for parameter in CYCLES[code].parameters()] == manual


@pytest.mark.parametrize("code", CYCLES)
def test_a_base_of_milling_cycles_declares_nothing(code):
    bases = [base for base in CYCLES[code].__mro__[1:] if issubclass(base, Cycle)]
    assert len(bases) <= 3 and not any(base.parameters() for base in bases)

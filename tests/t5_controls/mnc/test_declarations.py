"""Every declared cycle against the parameter tables of the manual, address by address (tests/authorities/README.md)."""

import json
import math
from pathlib import Path

import pytest

import mnclab
from mnclab.machine.cycle import Parameter

CONTROL = mnclab.controls["mnc"]
FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "parameters.json"
TABLES = {
    code: {row["address"]: row for row in entry["parameters"]}
    for entry in json.loads(FILE.read_text(encoding="utf-8"))
    for code in (entry["code"], *entry["aliases"])
}

#: Where a declaration says more than the table of its cycle, and why.
EXCEPTIONS = {
    ("G83", "P", "range"): ">= 0",  # the table has no range; a time is not negative
    ("G83", "F", "range"): "> 0",  # the range of the word F, section 4.1
}

CASES = [
    pytest.param(code, parameter, id=f"{code} {parameter.address}")
    for code, cycle in CONTROL.cycles.items()
    for parameter in cycle.parameters()
]


def limits(parameter: Parameter) -> str:
    """The limits of a parameter as the tables write them."""
    signs = {">": parameter.above, ">=": parameter.at_least, "<": parameter.below, "<=": parameter.at_most}
    return " and ".join(f"{sign} {limit:g}" for sign, limit in signs.items() if limit is not None)


@pytest.mark.parametrize("code", CONTROL.cycles)
def test_a_cycle_declares_the_addresses_of_its_table(code):
    declared = [parameter.address for parameter in CONTROL.cycles[code].parameters()]
    assert sorted(declared) == sorted(TABLES[code])
    assert CONTROL.cycles[code].source.startswith("MNC ")


@pytest.mark.parametrize(("code", "parameter"), CASES)
def test_a_parameter_is_that_of_the_table(code, parameter):
    row = TABLES[code][parameter.address]
    for key in ("unit", "type", "required", "modal", "incremental"):
        assert getattr(parameter, key) == EXCEPTIONS.get((code, parameter.address, key), row[key]), key
    assert {float(k): v for k, v in (parameter.choices or {}).items()}.keys() == {
        float(key) for key in row.get("choices") or {}
    }
    assert limits(parameter) == (EXCEPTIONS.get((code, parameter.address, "range")) or row["range"] or "")
    default = row["default"]
    if isinstance(default, int | float):
        assert parameter.default == default
    else:  # none, or said in words: then in ours too
        assert parameter.default is None
        assert default is None or parameter.default_means


@pytest.mark.parametrize(("code", "parameter"), CASES)
def test_a_limit_refuses_its_neighbour_and_takes_what_is_allowed(code, parameter):
    for limit, itself, direction in (
        (parameter.above, False, 1), (parameter.at_least, True, 1),
        (parameter.below, False, -1), (parameter.at_most, True, -1),
    ):  # fmt: skip
        if limit is not None:
            assert parameter.refuses(limit) != itself
            assert parameter.refuses(math.nextafter(limit, -direction * math.inf))
            assert not parameter.refuses(math.nextafter(limit, direction * math.inf))
    if parameter.default is not None:
        assert not parameter.refuses(parameter.default)


@pytest.mark.parametrize(("code", "parameter"), CASES)
def test_a_parameter_can_be_explained(code, parameter):
    """A meaning short enough for an alarm, and a line in the help table."""
    assert parameter.meaning and parameter.unit and len(parameter.meaning) <= 50
    lines = [line.split()[:1] for line in str(mnclab.help(code, "mnc")).splitlines()]
    assert [parameter.address] in lines
    assert f"<code>{parameter.address}</code>" in mnclab.help(code, "mnc")._repr_html_()


def test_the_exceptions_are_needed():
    for (code, address, key), value in EXCEPTIONS.items():
        assert TABLES[code][address][key] != value

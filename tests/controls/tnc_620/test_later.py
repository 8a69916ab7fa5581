"""What the manual knows and nobody has built: read, its parameters looked at, refused by name."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import mnclab as mnc
from mnclab.controls.tnc_620.control import CONTROL, later
from mnclab.controls.tnc_620.later import PARAMETERS

CATALOGUE = Path(__file__).parents[2] / "authorities" / "catalogue"
TABLE = json.loads((CATALOGUE / "parameters-tnc-620.json").read_text(encoding="utf-8"))
ENTRIES = {entry["code"]: entry["parameters"] for entry in TABLE}


@pytest.mark.parametrize("code", PARAMETERS)
def test_the_parameters_are_those_of_the_manual(code: str) -> None:
    assert PARAMETERS[code] == {part for row in ENTRIES[code] for part in row["address"].split("/")}


CODES = [f"TCH PROBE {n}" for n in later.PROBING]


@pytest.mark.parametrize("code", CODES)
def test_a_cycle_that_is_not_built_is_refused_by_its_name(code: str) -> None:
    """With the parameters of the table, in both formats, and with a parameter that it does not have."""
    rows = [row["address"] for row in ENTRIES.get(code, []) if re.fullmatch(r"Q\d+", row["address"])]
    lines = "".join(f"Q{row[1:]}=+1 ;X\n" for row in rows)
    refusal = f"{code} is refused: {CONTROL.refused[code]}"
    for text in (f"1 {code} NUME\n{lines}", f"1 {code}.0 NUME\n2 {code}.1 X+1 ABST 5\n"):
        assert [(a.span.line, a.span.column, a.message) for a in mnc.run(text, "tnc-620").alarms] == [(1, 1, refusal)]
    if code in PARAMETERS:
        strange = mnc.run(f"1 {code} NUME\n{lines}Q1999=1 ;Y\n", "tnc-620").alarms
        assert [(a.span.line, a.severity, a.message) for a in strange] == [
            (1, "alarm", refusal), (2 + len(rows), "warning", f"{code} has no parameter Q1999"),
        ]  # fmt: skip


def test_every_cycle_of_the_manual_is_built_or_waits() -> None:
    """The 108 cycles of chapter 20, and the 14 obsolete ones besides."""
    manual = {row["code"] for row in json.loads((CATALOGUE / "iso-names-tnc-620.json").read_text(encoding="utf-8"))}
    built = {code for code in CONTROL.cycles if not code.startswith("GLOBAL DEF")}
    assert len(manual) == 108 and manual <= built | set(CODES) and len(built) + len(CODES) == 108 + 14
    assert not {code for code in ENTRIES if code not in {*CONTROL.cycles, *CONTROL.refused} and "(" not in code}


def test_nothing_that_waits_is_built() -> None:
    """What is built has its title and its parameters in its own declaration."""
    assert not {*later.WAITING, *later.NOT_THERE, *PARAMETERS} & {*CONTROL.functions, *CONTROL.cycles}


def test_what_is_written_instead_is_built() -> None:
    built = {*CONTROL.functions, *CONTROL.cycles}
    for code, text in later.INSTEAD.items():
        assert code in CONTROL.refused and code not in built and CONTROL.refused[code].endswith(f": {text}")
        named = re.findall(r"CYCL DEF \d+|PLANE SPATIAL|FUNCTION DWELL|M\d+|RND|APPR|DEP|BLK FORM 0\.1|\bL\b", text)
        said = set(named) - {code} - {"M132"}
        assert text.startswith(("write ", "leave it out"))
        assert all(any(f"{each} ".startswith(f"{one} ") for each in built) for one in said)

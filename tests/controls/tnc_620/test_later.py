"""What the manual knows and nobody has built: read, and refused by name."""

from __future__ import annotations

import json
import re
from pathlib import Path

from mnclab.controls.tnc_620.control import CONTROL, later

CATALOGUE = Path(__file__).parents[2] / "authorities" / "catalogue"
TABLE = json.loads((CATALOGUE / "parameters-tnc-620.json").read_text(encoding="utf-8"))
ENTRIES = {entry["code"]: entry["parameters"] for entry in TABLE}


def test_every_cycle_of_the_manual_is_built() -> None:
    """The 108 cycles of chapter 20, and the 14 obsolete ones besides."""
    manual = {row["code"] for row in json.loads((CATALOGUE / "iso-names-tnc-620.json").read_text(encoding="utf-8"))}
    built = {code for code in CONTROL.cycles if not code.startswith("GLOBAL DEF")}
    assert len(manual) == 108 and manual <= built and len(built) == 108 + 14
    assert not {code for code in ENTRIES if code not in {*CONTROL.cycles, *CONTROL.refused} and "(" not in code}


def test_nothing_that_waits_is_built() -> None:
    """What is built has its title and its parameters in its own declaration."""
    assert not {*later.WAITING, *later.NOT_THERE} & {*CONTROL.functions, *CONTROL.cycles}


def test_what_is_written_instead_is_built() -> None:
    built = {*CONTROL.functions, *CONTROL.cycles}
    for code, text in later.INSTEAD.items():
        assert code in CONTROL.refused and code not in built and CONTROL.refused[code].endswith(f": {text}")
        named = re.findall(r"CYCL DEF \d+|PLANE SPATIAL|FUNCTION DWELL|M\d+|RND|APPR|DEP|BLK FORM 0\.1|\bL\b", text)
        said = set(named) - {code} - {"M132"}
        assert text.startswith(("write ", "leave it out"))
        assert all(any(f"{each} ".startswith(f"{one} ") for each in built) for one in said)

"""Golden listings: tests/programs/CONTROL/NAME beside NAME.expected, which is what `str(run.toolpath)` must be.

The head comments of a program name its origin (`// origin: manual 3.2 ...`, `; origin: worked out from ...`, `' origin:
catalogue ...`) and work its numbers out. `pytest --rewrite` writes the expected listings anew: read every change before
it is kept.
"""

import re
from itertools import takewhile
from pathlib import Path

import pytest

import mnclab
from mnclab import Setup, Tool
from mnclab.machine.setup import MILLS

FOLDER = Path(__file__).parents[1] / "programs"
FILES = sorted(file for file in FOLDER.glob("*/*") if file.suffix != ".expected")
COMMENT = re.compile(r"(?://|;|') ?")

#: What they find on the machine; the tool starts at machine zero.
SETUPS = {
    "g43": Setup(
        tools={2: Tool(radius=4, length=120), 5: Tool(radius=5, length=85)},
        correctors={2: (0, 0, 120), 7: (0, 0, 85)},
    ),
    "mnc": Setup(
        tools={**MILLS, 7: Tool(radius=3, length=50, dl=0.2)},
        datums={1: (100, 50, 20), 2: (110, 40, 20)},
    ),
}

each = pytest.mark.parametrize("file", FILES, ids=lambda file: f"{file.parent.name}-{file.stem}")


@each
def test_listing(file, rewrite):
    run = mnclab.run(file, file.parent.name, SETUPS.get(file.parent.name))
    assert run.ok, run.alarms
    expected = file.with_suffix(".expected")
    if rewrite:
        expected.write_text(f"{run.toolpath}\n", encoding="utf-8")
    assert f"{run.toolpath}\n" == expected.read_text(encoding="utf-8")


@each
def test_a_listing_says_where_its_numbers_come_from(file):
    """An origin with a number, of a section or a cycle, and at least one line of reckoning."""
    head = list(takewhile(COMMENT.match, file.read_text(encoding="utf-8").splitlines()))
    origin, *reckoning = (COMMENT.sub("", line, count=1) for line in head)
    assert re.match(r"origin: (manual|catalogue|worked out from)\b.*\d", origin)
    assert re.search(r"\d", "".join(reckoning))


def test_no_listing_stands_alone():
    assert {file.with_suffix(".expected") for file in FILES} == set(FOLDER.glob("*/*.expected"))
    assert {file.parent.name for file in FILES} == set(mnclab.controls)

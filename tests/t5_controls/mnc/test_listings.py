"""Golden listings: tests/programs/mnc/NAME.mnc beside NAME.expected, which is what `str(run.toolpath)` must be.

The head comments of a program name its origin (`// origin: manual 3.2 ...` or `// origin: worked out from 9.1 ...`)
and work its numbers out. `pytest --rewrite` writes the expected listings anew: read every change before it is kept.
"""

import re
from pathlib import Path

import pytest

import mnclab
from mnclab import Setup, Tool
from mnclab.machine.setup import MAGAZINE

FOLDER = Path(__file__).parents[2] / "programs" / "mnc"
FILES = sorted(FOLDER.glob("*.mnc"))

#: What all of them find on the machine; the tool starts at machine zero.
SETUP = Setup(
    tools={**MAGAZINE, 7: Tool(radius=3, length=50, dl=0.2)},
    datums={1: (100, 50, 20), 2: (110, 40, 20)},
)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_listing(file, rewrite):
    run = mnclab.run(file, "mnc", SETUP)
    assert run.ok, run.alarms
    expected = file.with_suffix(".expected")
    if rewrite:
        expected.write_text(f"{run.toolpath}\n", encoding="utf-8")
    assert f"{run.toolpath}\n" == expected.read_text(encoding="utf-8")


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_listing_says_where_its_numbers_come_from(file):
    """An origin that names a section, and at least one line of reckoning."""
    text = file.read_text(encoding="utf-8")
    head = re.match(r"(?://.*\n)+", text)[0].splitlines()
    assert re.match(r"// origin: (manual|worked out from) \d", head[0])
    assert len(head) > 1 and re.search(r"\d", "".join(head[1:]))


def test_no_listing_stands_alone():
    assert {file.stem for file in FOLDER.glob("*.expected")} == {file.stem for file in FILES}
    assert len(FILES) >= 8

"""The sample programs of the TNC 620 as plain blocks: LinuxCNC makes the same path of them."""

import json
import sys
from pathlib import Path

import pytest

import mnclab

ROOT = Path(__file__).parents[2]
RECORDS = ROOT / "tests" / "authorities" / "exported_samples"
SCRIPT = "run tests/authorities/generate_exported_samples.py, which asks LinuxCNC"
sys.path.insert(0, str(RECORDS.parent))
from read_back import DRUMS, blocks_of, same_motion  # noqa: E402

sys.path.pop(0)
PROGRAMS = sorted(path for path in (ROOT / "data" / "programs" / "tnc-620").iterdir() if path.stem not in DRUMS)


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.name)
def test_linuxcnc_reads_the_same_path(program):
    file = RECORDS / "tnc-620" / f"{program.stem}.json"
    if not file.exists():
        pytest.fail(f"{program.name} has no record: {SCRIPT}")
    record, run = json.loads(file.read_text("utf-8")), mnclab.run(program)
    assert blocks_of(run) == record["blocks"], f"the record of {program.name} is old: {SCRIPT}"
    same_motion(run, record)


def test_every_record_has_its_program():
    stems = {program.stem for program in PROGRAMS}
    assert {file.stem for file in (RECORDS / "tnc-620").iterdir()} <= stems

"""Record what LinuxCNC makes of the sample programs, exported as plain blocks: `exported_samples/CONTROL/NAME.json`.

    python3 tests/authorities/generate_exported_samples.py [NAME …]

NAME is a file of data/programs, such as tnc-620/bracket.h; without one those that have no record, or an old one, are
recorded. Needs mnclab in the Python that runs it, and LinuxCNC for Debian's own Python. Tool changes are left out of what
is asked, because the module crashes on them; tool lengths are 0 in these programs.
"""

import json
import re
import sys
from pathlib import Path

from read_back import DRUMS, blocks_of
from recording import HERE, ask, version

import mnclab

PROGRAMS = HERE.parents[1] / "data" / "programs"
RECORDS = HERE / "exported_samples"
CONTROLS = ("tnc-620",)
TOOL_CHANGE = re.compile(r"T\d+ M6|G43 H\d+|G49")


def record_of(program):
    """The file of a program's record."""
    return RECORDS / program.parent.name / f"{program.stem}.json"


def record(program):
    """Ask about one program and write the answer, a move a line."""
    run = mnclab.run(program)
    assert run.ok, run.alarms
    blocks = blocks_of(run)
    asked = "\n".join("" if TOOL_CHANGE.fullmatch(block) else block for block in blocks) + "\n"
    answer = ask(asked)
    head = json.dumps({"authority": version(), "blocks": blocks, "ok": answer["ok"], "error": answer.get("error")})
    moves = ",\n".join(json.dumps(move, separators=(",", ":")) for move in answer["motion"])
    file = record_of(program)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(f'{head[:-1]}, "motion": [\n{moves}\n]}}\n', "utf-8")
    print(f"{file.relative_to(HERE)}: {len(blocks)} blocks, {len(answer['motion'])} moves")


def old(program):
    """Whether a program has no record, or one of other blocks."""
    file = record_of(program)
    return not file.exists() or json.loads(file.read_text("utf-8"))["blocks"] != blocks_of(mnclab.run(program))


def main(names):
    every = sorted(program for control in CONTROLS for program in (PROGRAMS / control).iterdir() if program.stem not in DRUMS)
    for program in [PROGRAMS / name for name in names] or filter(old, every):
        record(program)


if __name__ == "__main__":
    main([Path(name) for name in sys.argv[1:]])

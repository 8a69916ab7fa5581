"""Record what LinuxCNC makes of our exports: `exported.json`.

    python3 tests/authorities/generate_exported.py

Needs mnclab in the Python that runs it, and LinuxCNC for Debian's own Python. The blocks of tool changes are left out of
what is asked, because the module crashes on them; tool lengths are 0 in these programs.
"""

import json
import re

from exported_programs import PROGRAMS
from read_back import blocks_of
from recording import HERE, ask, version

import mnclab

TOOL_CHANGE = re.compile(r"T\d+ M6|G43 H\d+|G49")


def main():
    """Write the file."""
    records = []
    for name, (control, text) in PROGRAMS.items():
        run = mnclab.run(text, control)
        assert run.ok, run.alarms
        blocks = blocks_of(run)
        asked = "\n".join("" if TOOL_CHANGE.fullmatch(block) else block for block in blocks) + "\n"
        records.append({"name": name, "blocks": blocks, **ask(asked)})
    record = {"authority": version(), "programs": records}
    (HERE / "exported.json").write_text(json.dumps(record, indent=1) + "\n", "utf-8")


main()

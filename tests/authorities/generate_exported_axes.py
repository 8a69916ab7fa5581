"""Record where LinuxCNC sends the axes of a machine that tilts, by our export: `exported_axes.json`.

    python3 tests/authorities/generate_exported_axes.py

Needs mnclab in the Python that runs it, and the `rs274` of LinuxCNC, which says positions with four decimals. It has no tool
table: lengths are those of its G43, which move no axis.
"""

import json
import re
import subprocess
import tempfile
from pathlib import Path

from read_back import blocks_of
from recording import HERE, version

import mnclab

PROGRAM = """BEGIN PGM AXES MM
TOOL CALL 2 Z S3000
L X+20 Y+0 Z+50 R0 FMAX M3
L X+0 A+30 C+60 F500
L Z+5 FMAX
CC X+10 Y+0
C X+20 Y+0 DR- F300
L A+0 F900
END PGM AXES MM
"""
MOVE = re.compile(r"(STRAIGHT_TRAVERSE|STRAIGHT_FEED|ARC_FEED|SET_FEED_RATE)\((.*)\)")


def main():
    """Write the file."""
    setup = mnclab.Setup(tools={2: mnclab.Tool(radius=4, length=90)}, kinematics="table-ac")
    blocks = blocks_of(mnclab.run(PROGRAM, "tnc-620", setup))
    with tempfile.TemporaryDirectory() as home:
        Path(home, "a.ngc").write_text("\n".join(blocks) + "\n")
        more = {"cwd": home, "env": {"HOME": home, "PATH": "/usr/bin:/bin"}}
        done = subprocess.run(["rs274", "-g", "a.ngc"], check=True, capture_output=True, text=True, **more)
    said = [[name, *map(float, numbers.split(", "))] for name, numbers in MOVE.findall(done.stdout)]
    record = {"authority": version(), "program": PROGRAM, "blocks": blocks, "said": said}
    (HERE / "exported_axes.json").write_text(json.dumps(record, indent=1) + "\n", "utf-8")


main()

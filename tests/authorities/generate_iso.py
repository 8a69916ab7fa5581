"""What LinuxCNC makes of the random programs of `iso_programs`: writes iso.json.gz and iso_holes.json.gz.

    python3 tests/authorities/generate_iso.py

The texts are made again wherever they are wanted; recorded are its answers, and the seeds of the few programs that it
refuses (a formula that is too long for it, a root of a number below 0) are left out. A row is its line, the letter of its
kind (r, f, a), x, y, z, the feed of f and a, and of arcs x, y, z of the centre and the sweep in rad; lengths are whole
1e-9 mm. Rows of no length are left out.
"""

import json
import subprocess
import tempfile
from pathlib import Path

from generate_contours import write
from iso_programs import PARTS, changing_holes, program, systems, unit
from recording import DEBIAN_PYTHON, HERE, KINDS, motion

BATCH = 250
FILES = {"iso.json.gz": (5000, PARTS), "iso_holes.json.gz": (500, (changing_holes, changing_holes, systems, unit))}
NANO = 1e9


def answers(seeds, parts):
    """LinuxCNC's answers to programs, in their order."""
    with tempfile.TemporaryDirectory() as home:
        paths = [Path(home, f"{seed}.ngc") for seed in seeds]
        for seed, path in zip(seeds, paths):
            path.write_text(program(seed, parts)[1])
        command = [DEBIAN_PYTHON, str(HERE / "linuxcnc_oracle.py"), *map(str, paths)]
        done = subprocess.run(command, check=True, capture_output=True, text=True, env={"HOME": home, "PATH": "/usr/bin"})
        return [json.loads(line) for line in done.stdout.splitlines()]


def rows(answer):
    """Its rows that move, in whole 1e-9 mm."""
    found, at = [], [0.0, 0.0, 0.0]
    for move in motion(answer, range(10_000)):
        if move["kind"] == "arc" or max(abs(a - b) for a, b in zip(move["to"], at)) > 1e-9:
            row = [move["line"], {kind: word[0] for word, kind in KINDS.items()}[move["kind"]]]
            row += [round(NANO * value) for value in move["to"]]
            if move["kind"] != "rapid":
                row.append(move["feed"])
            if move["kind"] == "arc":
                row += [*(round(NANO * value) for value in move["centre"]), move["sweep"]]
            found.append(row)
        at = move["to"]
    return found


def main():
    for name, (count, parts) in FILES.items():
        records = []
        for first in range(0, 20 * count, BATCH):
            seeds = range(first, first + BATCH)
            records += [{"seed": s, "rows": rows(a)} for s, a in zip(seeds, answers(seeds, parts)) if a["ok"]]
            if len(records) >= count:
                break
        write(name, 0, records[:count])


if __name__ == "__main__":
    main()

"""More than a thousand random contours with LinuxCNC's tool-centre path: writes contours.json.gz.

    python3 tests/authorities/generate_contours.py

The contours are those of generate_compensation.py, but none is chosen by what LinuxCNC says to it. `rows` are the moves
from the entry to the exit: line of the MNC text, end in the plane, and for arcs centre and sweep; of a refused program
`refused` holds LinuxCNC's words instead. `clear` says whether the path from the end of the entry to the start of the
exit keeps the tool out of the whole contour, as far as samples tell: LinuxCNC looks at neighbours only.
"""

import gzip
import json
import random
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

from contours import corner
from generate_compensation import LEAST_CORNER, MOST_CORNER, Program
from recording import HERE, ask, motion, version
from shapes import FAMILIES, NARROW

SEED = 20261121
EACH = {"open": 330, "closed": 330, "smooth": 260, "pocket": 260, "groove": 25, "small_arc": 25, "short": 25, "bay": 25}
RADII = [1, 2, 3, 4, 5, 6, 2.5, 3.175, 4.0125]


def plausible(contour):
    """Whether no corner is nearly tangential (LinuxCNC draws the line elsewhere) or a reversal."""
    turns = [abs(corner(a, b)) for a, b in zip(contour, contour[1:], strict=False)]
    return all(turn == 0 or LEAST_CORNER < turn < MOST_CORNER for turn in turns)


def programs(rng):
    """Random programs, family by family."""
    for family, count in EACH.items():
        while count:
            side, radius = rng.choice([1, -1]), rng.choice(RADII)
            contour = FAMILIES[family](rng, side) if family in FAMILIES else NARROW[family](rng, side, radius)
            if plausible(contour):
                count -= 1
                yield family, Program(rng, contour, radius, side)


def record(named):
    """What LinuxCNC says to a program."""
    family, program = named
    answer = ask(program.texts()["rs274"])
    found = {"family": family, "mnc": program.texts()["mnc"], "radius": program.radius}
    if not answer["ok"]:
        return found | {"refused": answer["error"], "line": program.line_of[answer["line"]]}
    rows = motion(answer, program.line_of)
    kept = [
        [r["line"], *r["to"][:2], *([*r["centre"][:2], r["sweep"]] if r["kind"] == "arc" else [])] for r in rows[2:-1]
    ]
    return found | {"clear": program.clear(rows), "rows": kept}


def main():
    with ThreadPoolExecutor(4) as pool:
        records = list(pool.map(record, programs(random.Random(SEED))))
    tally = Counter(
        (r["family"], r.get("refused", "clear" if r.get("clear") else "meets the contour")) for r in records
    )
    for (family, answer), count in sorted(tally.items()):
        print(f"{count:5} {family:10} {answer}")
    write("contours.json.gz", SEED, records)


def write(name, seed, records):
    """Write a packed file of records beside this one."""
    text = json.dumps({"authority": version(), "seed": seed, "records": records}, separators=(",", ":"))
    file = HERE / name
    with open(file, "wb") as raw, gzip.GzipFile(filename="", mode="wb", fileobj=raw, mtime=0) as packed:
        packed.write(text.encode())
    print(f"{file.name}: {len(records)} records, {len(text)} bytes, {file.stat().st_size} packed")


if __name__ == "__main__":
    main()

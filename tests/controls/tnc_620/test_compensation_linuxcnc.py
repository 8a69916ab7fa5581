"""1,280 random contours written in Klartext against LinuxCNC: the same path beside every element.

The records are those of the MNC (tests/authorities/README.md): lines and arcs under G41 and G42, which are RL and RR. Entry
and exit run tangentially into the contour, where both controls stand at the same place.
"""

import gzip
import json
import re
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup, Tool

pytestmark = pytest.mark.deep

FILE = Path(__file__).parents[2] / "authorities" / "contours.json.gz"
RECORDS = json.loads(gzip.decompress(FILE.read_bytes()))["records"]
EXACT = 1e-9  # mm: LinuxCNC hands doubles over in inches


def klartext(mnc):
    """An MNC program of plain contours as Klartext, and the line there of each of its lines."""
    blocks, line_of, mark, code = ["TOOL CALL 1 Z S1000"], {}, "", 0
    for number, block in enumerate(mnc.splitlines(), 1):
        words = dict(re.findall(r"([A-FH-Z])([-+.\d]+)", block))
        for g in map(int, re.findall(r"G(\d+)", block)):
            code = g if g <= 3 else code
            mark = {90: "", 91: "I"}.get(g, mark)
        side = next((text for g, text in ((41, " RL"), (42, " RR"), (40, " R0")) if re.search(rf"G{g}\b", block)), "")
        ends = "".join(f" {mark}{axis}{words[axis]}" for axis in "XYZ" if axis in words)
        rest = side + (f" F{words['F']}" if "F" in words else "") + (" FMAX" if code == 0 else "")
        if not ends and "I" not in words and "J" not in words:
            continue
        if code < 2:
            blocks.append("L" + ends + rest)
        elif "R" in words:
            blocks.append(f"CR{ends} R{words['R']} DR{'+' if code == 3 else '-'}{rest}")
        else:
            blocks.append(f"CC IX{words.get('I', 0)} IY{words.get('J', 0)}")
            blocks.append(f"C{ends} DR{'+' if code == 3 else '-'}{rest}")
        line_of[len(blocks)] = number
    return "\n".join(blocks) + "\n", line_of


def test_the_translation():
    text, _ = klartext("G17 G90 G54\nG00 X1 Y2 Z5\nG41 G01 X3.5 F200\nG91\nG02 X1 Y1 I1\nX2 R-4 F80\nG90\nG40 G01 X9\n")
    assert text.splitlines()[1:] == [
        "L X1 Y2 Z5 FMAX", "L X3.5 RL F200", "CC IX1 IY0", "C IX1 IY1 DR-", "CR IX2 R-4 DR- F80", "L X9 R0",
    ]  # fmt: skip


@pytest.mark.parametrize("family", sorted({record["family"] for record in RECORDS}))
def test_same_path_beside_every_element(family):
    for record in (r for r in RECORDS if r["family"] == family):
        text, line_of = klartext(record["mnc"])
        found = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=record["radius"])}))
        if found.ok != ("rows" in record):  # an arc is used up: LinuxCNC turns the other way round
            assert "rows" in record and not record["clear"] and "too short" in found.alarms[0].message, text
        if found.ok:
            same_body(found.toolpath, record["rows"][1:], line_of)


def same_body(path, rows, line_of):
    """Ends, centres and sweeps from the end of the entry to the exit."""
    first = int(np.argmax(path.side != 0)) + 1
    kept = path[first : first + len(rows)]
    assert [line_of[line] for line in kept.line.tolist()] == [row[0] for row in rows]
    assert np.abs(kept.start[0, :2] - path.end[first - 1, :2]).max() == 0
    assert np.abs(kept.end[:, :2] - np.array([row[1:3] for row in rows])).max() <= EXACT
    arcs = [k for k, row in enumerate(rows) if len(row) > 3]
    assert np.flatnonzero(kept.kind == Kind.ARC).tolist() == arcs
    if arcs:
        assert np.abs(kept.centre[arcs, :2] - np.array([rows[k][3:5] for k in arcs])).max() <= EXACT
        assert np.abs(kept.sweep[arcs] - np.array([rows[k][5] for k in arcs])).max() <= EXACT

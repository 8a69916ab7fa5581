"""The table of columns: a new one is one line, seen by everything that knows columns."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import mnclab

HOUSE = Path(mnclab.__file__).parent
PROGRAM = "G17 G90 S500 M3\nG0 X5\nG1 X10 F100\nG2 X20 I5\n"
WITH_ONE_MORE = f"""
import json
import mnclab
run = mnclab.run({PROGRAM!r}, "mnc")
path, move = run.toolpath, run.toolpath[-1]
assert path.wear.tolist() == [0.5] * len(path) and path.wear.strides == (0,) and move.wear == 0.5
assert path[1:].wear.tolist() == [0.5] * (len(path) - 1) and "wear" in path.columns()
assert len(run.programmed.wear) == len(run.programmed) > 0
changed = path.replace(wear=path.wear + 1)
assert changed[0].wear == 1.5 and changed.plot()
run.save("run.json"), run.save("run.csv")
told = json.load(open("run.json"))
assert told["meaning"]["wear"] == "how much of the edge is gone, mm" and told["columns"]["wear"] == [0.5] * len(path)
assert "wear" in open("run.csv").readline()
"""


@pytest.mark.parametrize("per", ["", "state"])
def test_a_new_column_is_one_line(tmp_path, per):
    """In a copy of the house: rows, pieces, copies, exports have it, with its default."""
    shutil.copytree(HOUSE, tmp_path / "mnclab", ignore=shutil.ignore_patterns("__pycache__"))
    table = tmp_path / "mnclab" / "path" / "toolpath.py"
    line = f'    wear = column(np.float64, 0.5, "how much of the edge is gone", "mm", per="{per}")\n'
    text = table.read_text("utf-8")
    table.write_text(text.replace("    rotary = column(", f"{line}    rotary = column(", 1), "utf-8")
    there = {**os.environ, "PYTHONPATH": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"}
    told = subprocess.run([sys.executable, "-c", WITH_ONE_MORE], cwd=tmp_path, env=there, capture_output=True, text=True)
    assert told.returncode == 0, told.stderr

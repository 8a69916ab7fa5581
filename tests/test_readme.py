"""What the README shows is so: its program, its alarm, and every call of its table."""

import ast
import re
import shlex
from pathlib import Path

import pytest

import mnclab
from mnclab import area
from mnclab.__main__ import parser

ROOT = Path(__file__).parent.parent
TEXT = (ROOT / "README.md").read_text("utf-8")
ROWS = [re.findall(r"`([^`]+)`", line.split("|")[2]) for line in TEXT.partition("you write |")[2].splitlines()[2:17]]


@pytest.fixture
def names(tmp_path, monkeypatch):
    """The names that the table takes for granted."""
    (tmp_path / "data").symlink_to(ROOT / "data")
    (tmp_path / "part.mnc").write_text("G0 X1\n")
    monkeypatch.chdir(tmp_path)
    run = mnclab.run("data/programs/mnc/first_path.mnc")
    blank = ((0, 0, -20), (100, 60, 0))
    return {
        "mnc": mnclab, "run": run, "other": mnclab.run("data/programs/mnc/compensated.mnc"), "blank": blank,
        "part": run.workpiece(stock=blank), "plate": mnclab.Design(blank, [mnclab.design.Hole(14, 14, 8)]),
        "region": area.Region.of(area.rectangle(30, 20, 5)),
        "profile": area.Contour([(0, 20), (-40, 20), (-50, 30)], closed=False),
    }  # fmt: skip


def test_it_begins_with_a_program_and_an_alarm(names):
    exec(TEXT.partition("```python")[2].partition("```")[0], names)
    assert names["run"].ok
    typed, _, answer = TEXT.partition(">>> ")[2].partition("```")[0].partition("\n")
    assert repr(eval(typed, names)) == answer.rstrip()


def test_every_call_of_the_table_runs(names):
    assert len(ROWS) == 15 and all(ROWS)
    for call in (call for row in ROWS[:-1] for call in row):
        exec(compile(ast.parse(call), call, "exec"), names)


def test_every_command_is_known():
    for call in ROWS[-1][:2]:
        _, *words = shlex.split(call)
        parser().parse_args(words)


def test_the_map_of_the_house_names_what_is_there():
    section = (ROOT / "CONTRIBUTING.md").read_text("utf-8").partition("## One program's way")[2].partition("\n## ")[0]
    named = re.findall(r"`([a-z_0-9/]+(?:\.py|/))`", section)
    assert len(named) > 30 and not [name for name in named if not (ROOT / "mnclab" / name).exists()]

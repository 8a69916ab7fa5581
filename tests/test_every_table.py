"""Every table says the same in a file and in a data frame, and is saved by the same names."""

import csv
import io
import re
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from tools.odd_arguments import ANSWERS, BLANK, REGION, RUN, TURNED

import mnclab as mnc
from mnclab.controls.choice import Found
from mnclab.controls.glossary import Glossary
from mnclab.learning.marking import Mark, Marks
from mnclab.text.alarm import Alarm

DRILLED = "G54\nT1 S1000 M3\nG0 X0 Y0 Z5\nG83 X10 Y0 Z-8 R2 K3 F120\nG80\nG0 Z5\n"
PROBED = "N10 T7\nN20 G0 X50 Y30 Z20\nN40 G421 X50 Y30 D24 Z-5 H20\n"


def drilled():
    return mnc.run(DRILLED, "mnc", stock=((-10, -10, -20), (30, 10, 0)))


def touched():
    part = mnc.part.box((0, 0, -20), (100, 60, 0)) - mnc.part.hole((50.1, 29.9, 0), 24.2, 10)
    return mnc.run(PROBED, "mnc", mnc.Setup(part=part, tools={7: mnc.Tool(radius=2, kind="probe")}))


#: One of every kind of table.
TABLES = {
    "HolesCompared": lambda: mnc.diff(drilled(), RUN, what="holes"),
    "Comparison": lambda: mnc.compare(REGION, 4.0, "rings"),
    "ToolSets": lambda: mnc.tool_sets(REGION, (3, 4), "rings"),
    "TurningComparison": lambda: mnc.compare_turning(TURNED, 20),
    "Found": lambda: Found([("G83", "mnc", "Deep-hole drilling", "")]),
    "CycleSteps": lambda: mnc.steps("G83", "mnc"),
    "Glossary": lambda: Glossary(list(mnc.help("glossary").entry)[:3]),
    "Survey": lambda: mnc.check("data/programs/mnc/first_path.mnc"),
    "Features": lambda: RUN.workpiece().compare(mnc.Design(BLANK, [mnc.design.Hole(0, 0, 5, 5)])).features,
    "Exercises": lambda: mnc.exercises("mnc")[:2],
    "Marks": lambda: Marks([Mark("anna", "mnc-07", 1.0, True)]),
    "Measurements": lambda: touched().measurements,
    "Touches": lambda: touched().touches,
    "Files": lambda: RUN.files,
    "Holes": lambda: drilled().holes(),
    "Machines": mnc.machines,
    "LearnedLimits": lambda: mnc.fit_limits({10.0: 0.3, 100.0: 0.9, 400.0: 2.4}),
    "Moments": lambda: RUN.when("z < 0"),
    "MissedOnes": lambda: RUN.start_at(5).missed,
    "Collisions": lambda: RUN.collisions(),
    "CuttingData": lambda: RUN.cutting_data(),
    "Removal": lambda: RUN.removal(),
    "Proof": lambda: mnc.prove(RUN, drilled()),
}


class Frame:
    """In place of pandas, which need not be here: the columns that a data frame is made of."""

    def __init__(self, columns):
        self.data = {name: list(column) for name, column in columns.items()}


@pytest.fixture(autouse=True)
def pandas(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", SimpleNamespace(DataFrame=Frame))


def written(table):
    head, *rows = csv.reader(io.StringIO(table.csv()))
    return head, rows


def test_there_is_a_table_of_every_kind():
    """What derives from a listing, or from columns, wherever it stands."""
    texts = [file.read_text("utf-8") for file in Path(mnc.__file__).parent.rglob("*.py")]
    found = [name for text in texts for name in re.findall(r"^class (\w+)\(.*\b(?:Listing\b|Rows\[|Table\[)", text, re.M)]
    assert sorted(found) == sorted([*TABLES, "Rows", "Table"])
    columned = sorted(name for text in texts for name in re.findall(r"^class (\w+)\(.*\bColumned\b", text, re.M))
    assert columned == ["AxisPositions", "Profile", "Toolpath"]


@pytest.mark.parametrize("name", TABLES)
def test_a_file_and_a_data_frame_have_the_same_columns_and_values(name):
    table = TABLES[name]()
    assert type(table).__name__ == name
    head, rows = written(table)
    frame = table.to_pandas().data
    assert list(frame) == head and head
    for k, column in enumerate(frame.values()):
        assert len(column) == len(rows)
        for cell, row in zip(column, rows):
            if isinstance(cell, str):
                assert cell == row[k]
            elif cell is None or np.isnan(cell):
                assert row[k] in ("", "\N{EN DASH}")
            else:  # a table of trials writes as many digits as it shows
                assert cell == pytest.approx(float(row[k]), rel=0.01, abs=0.006)


@pytest.mark.parametrize("name", TABLES)
def test_a_table_is_saved_as_csv_and_refuses_options_by_name(name, tmp_path):
    table = TABLES[name]()
    assert table.save(tmp_path / "table.csv").read_text("utf-8") == table.csv()
    with pytest.raises(Alarm, match="got colour"):
        table.save(tmp_path / "table.csv", colour="red")
    with pytest.raises(Alarm, match=r"\.xyz"):
        table.save(tmp_path / "table.xyz")


def test_numbers_of_a_table_are_numbers():
    """The Z of the program; the middle and the diameter of the hole that was given."""
    assert drilled().holes().to_pandas().data["to z, mm"] == [-8.0]
    assert touched().measurements.to_pandas().data["actual"] == pytest.approx([50.1, 29.9, 24.2], abs=1e-6)


@pytest.mark.parametrize("table", [RUN.toolpath, RUN.profile()], ids=["toolpath", "profile"])
def test_columns_are_a_file_and_a_data_frame(table, tmp_path):
    head, rows = written(table)
    frame = table.to_pandas().data
    assert list(frame) == head == list(table.columns()) and {len(column) for column in frame.values()} == {len(rows)}
    assert table.save(tmp_path / "columns.csv").read_text("utf-8") == table.csv()
    with pytest.raises(Alarm, match="got colour"):
        table.save(tmp_path / "columns.csv", colour="red")


def test_kinds_of_rows_are_words_in_both():
    """RUN: tool and spindle, a rapid, a feed down and along, a rapid up."""
    words = ["RAPID", "LINE", "LINE", "RAPID"]
    assert [kind for kind in RUN.toolpath.to_pandas().data["kind"] if kind in words] == words
    assert RUN.toolpath.csv() == RUN.save(ANSWERS / "run.csv").read_text("utf-8")

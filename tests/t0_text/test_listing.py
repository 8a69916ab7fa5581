"""Records that know their columns: text, HTML, csv and data frame from one declaration. Expected texts are written by hand."""

import csv
from typing import NamedTuple

import pytest

from mnclab.path.listing import INCHES, MM
from mnclab.text.alarm import Alarm
from mnclab.text.tables import Rows


class Peg(NamedTuple):
    name: str
    height: float


class Pegs(Rows):
    HEAD, NUMBERS, LENGTHS, CODE = ("peg", "height"), (1,), (1,), (0,)
    NOTHING, MOST = "no pegs", 2

    def texts(self):
        return [(peg.name, self.unit.figure(peg.height)) for peg in self]


PEGS = [Peg("a", 25.4), Peg("b", 2.54), Peg("c < d", 12.7)]


def test_a_listing_counts_in_its_unit():
    assert repr(Pegs(PEGS, MM)) == "peg    height, mm\n-----  ----------\na           25.4\nb            2.54\nc < d       12.7"
    assert Pegs(PEGS, INCHES).csv() == 'peg,"height, in"\na,1\nb,0.1\nc < d,0.5\n'


def test_a_slice_is_a_listing_and_a_row_is_a_row():
    some = Pegs(PEGS, INCHES, "up to line 3")[1:]
    assert isinstance(some, Pegs) and some.unit is INCHES and some.reach == "up to line 3"
    assert some[0] == PEGS[1] and len(some) == 2


def test_what_is_said_around_the_table():
    found = Pegs([], MM, "up to line 3, where the run stopped")
    assert repr(found) == "no pegs up to line 3, where the run stopped" and found._repr_html_() == f"<p>{found!r}</p>"
    found = Pegs(PEGS[:1], MM, "up to line 3")
    found.notes = ("of wood",)
    assert repr(found).endswith("\nup to line 3\nof wood") and found._repr_html_().endswith("<p>up to line 3</p><p>of wood</p>")


def test_a_notebook_shows_the_first_rows_and_how_many_more_there_are():
    html = Pegs(PEGS, MM)._repr_html_()
    assert html.count("<tr>") == 3 and "<p>… 1 more</p>" in html and "<code>a</code>" in html and "c &lt; d" not in html


def test_a_listing_is_saved_as_csv_and_as_nothing_else(tmp_path):
    saved = Pegs(PEGS, MM).save(tmp_path / "pegs.csv")
    assert [*csv.reader(saved.read_text("utf-8").splitlines())][1:] == [["a", "25.4"], ["b", "2.54"], ["c < d", "12.7"]]
    for name, wrong in (("pegs.txt", "saved as .csv, not as .txt"), ("pegs", "no suffix"), (None, "written to a path")):
        with pytest.raises(Alarm, match=wrong):
            Pegs(PEGS, MM).save(name if name is None else tmp_path / name)


def test_a_listing_is_arrays_and_a_data_frame():
    assert Pegs(PEGS, MM).columns()["height, mm"].tolist() == ["25.4", "2.54", "12.7"]
    pandas = pytest.importorskip("pandas")
    frame = Pegs(PEGS, MM).to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame.columns) == ["peg", "height, mm"] and len(frame) == 3

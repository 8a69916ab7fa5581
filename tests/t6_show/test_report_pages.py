"""Pages of reports and sheets: what stands on them, and that none is half empty."""

import functools
import re
from pathlib import Path

import pytest
from tools.together import deep_but_one_in

import mnclab as mnc
from mnclab.show.plot.page_sheet import A4, BOTTOM, LEFT, TOP, WIDE
from mnclab.show.plot.pages import HEADING, _parts, sheets
from mnclab.show.plot.set_up import plot_set_up
from mnclab.show.report import gathering
from mnclab.show.report.document import BAD, Blanks, Compared, Document, Listing, Section, Words

DATA = Path(__file__).parents[2] / "data" / "programs"
SHEET = "T1 M6\nG90 G55\nS2000 M3\nG43 H11 D3 G0 X-10 Y10 Z5\nG1 Z-2 F100\nX90 F300\n"
TOOLS = {1: mnc.Tool(5, 80), 3: mnc.Tool(8), 11: mnc.Tool(5, 81.5, dl=0.25)}
SETUP = mnc.Setup(
    tools=TOOLS, datums={2: (103, 52, -200)}, stock=((100, 50, -221), (180, 90, -201)), start=(0, 0, 100),
    fixtures=(((90, 50, -230), (100, 90, -210)),),
)  # fmt: skip


@functools.cache
def run(name):
    return mnc.run(SHEET, "g43", SETUP) if name == "sheet" else mnc.run(DATA / name)


def document(run):
    picture = run.plot(size=gathering.PICTURE)
    return gathering.document(run, gathering.report(run), picture, profile=run.profile())


def filled(page):
    """The share of a page, between its head and its foot, down to the lowest thing on it."""
    end = page.size[1] - BOTTOM
    low = [text.y for text in page.texts_on_it if text.y <= end]
    low += [y + 72 * picture.get_figheight() for picture, _, y in page.pictures_on_it]
    return (max(low) - TOP) / (end - TOP)


REPORTS = ["jnc-t01/shaft.jnc", "sheet", "tnc-620/lid.h", "tnc-620/pockets.h", "tnc-620/holes.h", "nc-31/shaft.nc31"]


@pytest.mark.parametrize("name", deep_but_one_in(6, REPORTS))
def test_no_page_is_less_than_half_full_or_without_a_heading(name):
    pages = sheets(document(run(name)))
    assert len(pages) > 1 and all(filled(page) > 0.5 for page in pages)
    assert all(page.texts_on_it[0].bold and page.texts_on_it[0].size >= HEADING for page in pages)


def test_a_report_has_the_part_and_the_feed():
    pieces = [piece for section in document(run("sheet")).sections for piece in section.pieces]
    captions = [each.caption for each in pieces if isinstance(each, gathering.Image)]
    assert "what is left of the blank" in captions and "the feed over time" in captions
    bare = document(mnc.run("G0 X5\nG1 X10 F100\n", "mnc"))
    assert "Part" not in [section.title for section in bare.sections]


def test_a_set_up_sheet_says_whose_it_is(tmp_path):
    page = run("sheet").setup_sheet(tmp_path / "a.html", author="M. Ionescu", material="C45", date="3 May").read_text("utf-8")
    words = re.sub(r"\s+", " ", re.sub("<[^>]+>", " ", page))
    assert all(said in words for said in ("author M. Ionescu", "material C45", "date 3 May"))
    assert run("sheet").setup_sheet(tmp_path / "a.pdf").read_bytes()[:4] == b"%PDF"
    with pytest.raises(mnc.Alarm, match="author must be a text, got 5"):
        run("sheet").setup_sheet(tmp_path / "a.pdf", author=5)


def test_correctors_are_those_that_the_program_chooses():
    """H11 holds the length of entry 11, D3 the radius of entry 3."""
    rows = {row[0]: row[1:] for row in gathering.correctors(run("sheet")).rows}
    assert rows["H11"] == ("T1", "length", "81.75", "0.25") and rows["D3"] == ("T1", "radius", "8", "")


def test_nothing_is_hatched_where_names_and_dimensions_stand():
    assert not [patch for ax in plot_set_up(run("sheet")).axes for patch in ax.patches if patch.get_hatch()]


def test_a_long_line_is_folded_between_words():
    said = "0 BEGIN PGM HOLES MM ; Centred, drilled, pecked, reamed and milled holes in a plate of 100 x 60 x 30. Made here."
    for letters in range(16, 120):
        parts = list(_parts(said, letters))
        assert " ".join(parts) == said and all(len(part) <= letters for part in parts)
    assert list(_parts("X" * 25, 10)) == ["X" * 10, "X" * 10, "X" * 5]


@pytest.mark.parametrize("name", ["tnc-620/pockets.h", "tnc-620/holes.h"])
def test_the_first_page_of_a_report_is_full(name):
    assert filled(sheets(document(run(name)))[0]) > 0.9


@pytest.mark.parametrize("above", range(48, 60))
def test_no_row_of_a_table_stands_alone_on_a_page(above):
    """Wherever a table of five rows begins, each page has two of them at least, or none."""
    table = gathering.TextTable(("name", "value"), [(f"row {k}", f"{k}") for k in range(5)], (1,))
    pages = sheets(gathering.Document("a", "b", [gathering.Section("", [*[gathering.Words("x")] * above, table])]))
    counts = [sum(text.text.startswith("row ") for text in page.texts_on_it) for page in pages]
    assert sum(counts) == 5 and 1 not in counts


def test_bold_words_are_folded_where_the_page_ends():
    """As of a collision: bold letters are wider than plain ones."""
    said = Section("Collisions", [Words("rapid motion in material, 3.000 mm deep at X0.468 Y20.000 " * 3, BAD)])
    (page,) = sheets(Document("crash", "mill", [said]))
    assert len([text for text in page.texts_on_it if text.bold]) > 3
    assert all(text.x + text.wide <= LEFT + WIDE for text in page.texts_on_it)


def test_what_a_person_fills_in_stands_on_one_page_below_its_heading():
    fill = Blanks([(name, "") for name in ("program", "part", "date", "measured by")])
    for lines in range(40, 64):
        listings = [Section("Program", [Listing([(1, "G1", "")] * count)]) for count in (lines, 60)]
        pages = sheets(Document("plate", "mill", [listings[0], Section("Measured by the probe", [fill]), listings[1]]))
        assert "Measured by the probe, continued" not in [text.text for page in pages for text in page.texts_on_it]


def test_a_measuring_record_does_not_leave_its_heading_behind():
    """Its picture with the table of all measures needs a page: the heading goes there, too."""
    plate = mnc.Design(((0, 0, -20), (110, 70, 0)), [mnc.design.Pocket.circle(40, 35, 44, 5)])
    difference = plate.workpiece().compare(plate)
    for lines in (10, 40):
        listing = Section("Program", [Listing([(1, "G1", "")] * lines)])
        for page in sheets(Document("plate", "mill", [listing, Section("Measuring record", [Compared(difference)])])):
            assert page.size == A4 and "Measuring record, continued" not in [text.text for text in page.texts_on_it]

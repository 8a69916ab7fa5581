"""Reports: what stands in them, that the page is well formed, and that pages are the same every time."""

import functools
from html.parser import HTMLParser

import pytest

import mnclab
from mnclab import Alarm
from mnclab.show.plot.page_sheet import A4, LEFT, RIGHT, width
from mnclab.show.plot.pages import sheets
from mnclab.show.report.gathering import PICTURE, document, report

PROGRAM = "G90 G54 T1 S1000 M3\nG0 X10 Y0 Z5\nG1 Z-2 F100 // down <here>\nX30\nT2\nG4 P30\nG1 X4,5\n"
SETUP = mnclab.Setup(limits=mnclab.Limits(acceleration=1e9, rapid=1e7))


class Page(HTMLParser):
    """Text, open tags and what is asked from elsewhere."""

    def __init__(self):
        super().__init__()
        self.open, self.text, self.foreign = [], [], []

    def handle_starttag(self, tag, attributes):
        if tag not in ("meta", "img", "br"):
            self.open.append(tag)
        self.foreign += [v for k, v in attributes if k in ("src", "href") and not v.startswith("data:")]

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)


def printed(run, title=None, profile=None):
    """The pages of a report."""
    return sheets(document(run, report(run, title), run.plot(size=PICTURE), profile=profile))


def lines_of(pages):
    """The texts of pages, line by line, from left to right."""
    found = []
    for page in pages:
        rows = {}
        for each in page.texts_on_it:
            rows.setdefault(each.y, []).append(each)
        found += [" ".join(each.text for each in sorted(rows[y])) for y in sorted(rows)]
    return found


def test_the_figures_are_those_of_the_run(run):
    found = report(run, "Part 7")
    facts = dict(found.facts)
    assert found.title == "Part 7" and facts["cutting length"] == "27 mm"  # 7 down, 20 along
    assert facts["time"] == "46.20 s"  # 27 mm at 100 mm/min and 30 s
    assert [(row[0], row[-1]) for row in found.tools.rows] == [("T1", "16.20 s"), ("T2", "30.00 s")]
    assert ("dwell", "30.00 s", "64.9 %") in found.times
    assert [number for number, _, faulty in found.listing if faulty] == [7]


def test_the_page_stands_alone_and_is_well_formed(run, tmp_path):
    page = Page()
    page.feed(run.report(tmp_path / "a.html").read_text("utf-8"))
    assert page.open == [] and page.foreign == []
    text = "".join(page.text)
    for piece in ("end mill 10", "G1 Z-2 F100 // down <here>", "is no part of a number", "27 mm"):
        assert piece in text, piece
    body = (tmp_path / "a.html").read_text("utf-8").split("<body>")[1].split("<h2>Program")[0]
    assert "<figcaption>Figure 1: " in body and 'alt="tool path: 3 moves' in body


def test_the_pages_are_the_same_every_time(run, tmp_path):
    one, other = (run.report(tmp_path / f"{name}.pdf", colour="feed").read_bytes() for name in "ab")
    assert one == other and one.startswith(b"%PDF")
    assert one.count(b"/Type /Page\n") + one.count(b"/Type /Page ") == len(printed(run, profile=run.profile()))


LONG = "G17 G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5\n" + "G1 X9 F100\n" * 200 + "// " + "x" * 300 + "\nG1 X,5\n"


@pytest.mark.parametrize("title", [None, "A very long title of a report " * 7, "Корпус редуктора, вторая установка"])
def test_every_page_has_head_foot_and_number_and_nothing_runs_into_the_margin(title):
    pages = printed(mnclab.run(LONG, "mnc"), title)
    for number, page in enumerate(pages, 1):
        texts = [each.text for each in page.texts_on_it]
        assert texts[-1] == f"{number} of {len(pages)}" and "Mechatronics MNC (2015)" in texts
        for each in page.texts_on_it:
            assert each.x > LEFT - 0.1 and each.x + each.wide < A4[0] - RIGHT + 0.5, each
            assert 0 < each.y < A4[1] - 20


def test_no_two_lines_of_a_page_overlap(run):
    """Texts of one base line stand side by side, and base lines are at least the height of the smaller letters apart."""
    for page in printed(run):
        for a in page.texts_on_it:
            for b in page.texts_on_it:
                beside = a.x + a.wide <= b.x + 0.01 or b.x + b.wide <= a.x + 0.01
                assert a is b or beside or abs(a.y - b.y) >= 0.9 * min(a.size, b.size), (a, b)


@functools.cache
def pockets():
    """The report of a part with pockets, and its pages."""
    run = mnclab.run("data/programs/tnc-620/pockets.h")
    made = document(run, report(run), run.plot(size=PICTURE))
    return made, sheets(made)


def test_words_stand_on_the_page_of_the_short_table_that_they_explain():
    page = next(page for page in pockets()[1] if any(each.text == "Cutting data" for each in page.texts_on_it))
    assert any(each.text.startswith("hm is") for each in page.texts_on_it)


def test_the_extents_along_the_axes_stand_in_one_column():
    first, *_ = pockets()[0].sections
    assert [row[2] for row in first.pieces[1].rows if row[2:]][:3] == ["X from, to", "Y from, to", "Z from, to"]


def test_a_long_program_goes_on_over_pages_with_its_line_numbers():
    """204 lines; the one of 303 letters is folded and has its number once."""
    pages = printed(mnclab.run(LONG, "mnc"))
    numbers = [each.text for page in pages for each in page.texts_on_it if each.size == 7.8 and each.text.isdigit()]
    assert numbers == [str(k) for k in range(1, 205)]
    joined = "".join(each.text for page in pages for each in page.texts_on_it if set(each.text) <= set("x/ "))
    assert joined.count("x") == 300


def test_numbers_of_a_table_stand_under_each_other_by_their_points():
    """The point of 12.25 and the end of 8 stand at one place, and the letters of both are as wide as the font says."""
    from mnclab.show.plot.page_sheet import tabled
    from mnclab.show.report.document import TextTable

    made = tabled(TextTable(("n",), [("12.25",), ("8",), ("-0.5",)], (0,)), 400)
    points = [x + width(text.partition(".")[0], made.size) for row in made.rows for text, x in row.cells[0]]
    assert max(points) - min(points) < 1e-9


def test_a_table_too_wide_for_the_page_is_folded():
    from mnclab.show.plot.page_sheet import tabled
    from mnclab.show.report.document import TextTable

    made = tabled(TextTable(("a", "b"), [("word " * 60, "1"), ("w" * 200, "2")], (1,)), 300)
    assert made.wide <= 300.01
    ends = [x + width(text, made.size) for row in made.rows for text, x in row.cells[0]]
    assert max(ends) <= 300 and "".join(text for text, _ in made.rows[1].cells[0]) == "w" * 200


def test_a_picture_lies_within_its_page_and_its_caption_below_it(run):
    (page, picture, x, y) = next((page, *each) for page in printed(run) for each in page.pictures_on_it)
    wide, tall = picture.get_size_inches() * 72
    (caption,) = (each for each in page.texts_on_it if each.text.startswith("Figure 1: "))
    assert x >= LEFT and x + wide <= A4[0] - RIGHT + 0.5 and caption.y - caption.size > y + tall


def test_a_picture_that_is_drawn_on_a_page_is_as_it_was(run):
    """Its box begins at its own corner again, and its own file has the same bytes before and after."""
    picture = run.plot()
    before, box = picture.png(), picture.bbox_inches.get_points().copy()
    (page, *_) = sheets(document(run, report(run), picture))
    page.canvas.draw()
    assert picture.png() == before and (picture.bbox_inches.get_points() == box).all()


def test_every_place_of_a_warning_is_marked_as_one(tmp_path):
    run = mnclab.run("G17 G90 G54 T4 F200 S800 M3\nG3 Z-1 I10\nG3 Z-2 I10\nX,1\n", "mnc")
    found = report(run)
    assert [mark for _, _, mark in found.listing] == ["", "warning", "warning", "alarm"]
    text = run.report(tmp_path / "a.html").read_text("utf-8")
    assert text.count('<span class="warning">') == 2 and text.count('<span class="alarm">') == 1
    texts = [each.text for page in printed(run) for each in page.texts_on_it]
    assert texts.count("?") == 2 and texts.count("!") == 1


def test_a_flood_of_alarms_has_a_short_report(tmp_path):
    """The first alarms and their number as on the card; the listing of the pages has an end and says so."""
    run = mnclab.run("X,1\n" * 5000, "mnc")
    text = run.report(tmp_path / "a.html").read_text("utf-8")
    assert text.count('role="alert"') == 20 and "4980 more alarms, 5000 in all" in text
    lines = lines_of(printed(run))
    assert "… and 4980 more alarms, 5000 in all" in lines
    assert sum(line.startswith("… 3000 of 5000 lines are left out") for line in lines) == 1


def test_quotes_are_not_folded(tmp_path):
    """The caret stands below its word only where the quoted line is one."""
    run = mnclab.run("G1 " + "X1 " * 100 + "X,1 " + "Y1 " * 100 + "\n", "mnc")
    texts = [each for page in printed(run) for each in page.texts_on_it]
    (caret,) = (k for k, each in enumerate(texts) if set(each.text.strip()) == {"^"})
    quote = texts[caret - 1]
    assert quote.text.startswith("    … ") and quote.text.endswith(" …") and quote.family == texts[caret].family
    assert quote.text[texts[caret].text.index("^") :].startswith("X,1")
    text = run.report(tmp_path / "a.html").read_text("utf-8").split('role="alert"')[1].split("</pre>")[0]
    assert max(map(len, text.split("<pre")[1].partition(">")[2].split("\n"))) <= 88


def test_called_programs_rotary_axes_and_the_blank_are_told(tmp_path):
    main = "BEGIN PGM A MM\nBLK FORM 0.1 Z X-1 Y-2 Z-3\nBLK FORM 0.2 X9 Y8 Z0\nTOOL CALL 2 Z S100\n"
    main += "L X+5 A+30 FMAX M3\nCALL PGM SUB\nEND PGM A MM\n"
    sub = "BEGIN PGM SUB MM\nL X+1 A-90 R0 F100\nL X+2 F-1\nEND PGM SUB MM\n"
    run = mnclab.run(main, "tnc-620", mnclab.Setup(files={"SUB.H": sub}))
    found = report(run)
    facts = dict(found.facts)
    assert facts["blank"] == "10 x 10 x 3 mm" and facts["A from, to"] == "-90, 30 degrees"
    assert [(name, len(lines)) for name, lines in found.programs] == [("Program", 7), ("Program SUB.H", 4)]
    assert [line[0] for line in found.called[0][1] if line[2]] == [3] and not any(line[2] for line in found.listing)
    page = Page()
    page.feed(run.report(tmp_path / "a.html").read_text("utf-8"))
    said = " ".join(page.text)
    assert "\N{MINUS SIGN}90, 30 degrees" in said and "A-90" in said, "a true minus, but not in programs"
    assert page.open == [] and "Program SUB.H" in page.text
    assert run.report(tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")


def test_an_empty_program_has_a_report(tmp_path):
    run = mnclab.run("", "mnc")
    assert run.report(tmp_path / "a.html").stat().st_size > 0 and run.report(tmp_path / "a.pdf").stat().st_size > 0


def test_other_files_are_refused(run, tmp_path):
    with pytest.raises(Alarm, match=r"an \.html or a \.pdf file"):
        run.report(tmp_path / "a.doc")
    with pytest.raises(Alarm, match="cannot be written"):
        run.report(tmp_path / "none" / "a.html")


CUT = "T1 M6\nS1000 M3\nG43 G0 X-10 Y20 Z5\nG0 Z-4\nG0 X-5\nG1 X70 F300\nG0 X30\nG0 Z50\n"
CRASHES = CUT.replace("G0 X-5", "G0 X10")


@pytest.mark.parametrize("text, collided", [(CUT, False), (CRASHES, True)])
def test_removal_and_collisions_stand_in_it(tmp_path, text, collided):
    """A slot of 60 x 10 x 4 mm."""
    run = mnclab.run(text, "g43", mnclab.Setup(stock=((0, 0, -20), (60, 40, 0))))
    found = report(run)
    assert dict(found.facts)["removed"] == "2.4 cm³"
    assert dict(found.facts)["collisions"] == ("1" if collided else "none")
    assert [row[:2] for row in found.removal.rows()] == [("T1 end mill 10", "2.4 cm³")]
    page = run.report(tmp_path / "a.html").read_text("utf-8")
    assert page.count("rapid motion in material") == collided
    assert ("<h2>Collisions</h2><p>none</p>" in page) is not collided
    lines = lines_of(printed(run))
    assert lines[lines.index("Collisions") + 1].startswith("program:5: collision: rapid motion" if collided else "none")


def test_without_a_blank_a_report_is_as_it_was(run, tmp_path):
    found = report(run)
    assert not found.removal and not {"removed", "collisions"} & dict(found.facts).keys()
    assert "Collisions" not in run.report(tmp_path / "a.html").read_text("utf-8")


def test_the_removal_rate_of_a_report_is_that_on_its_machine():
    """A slot of 10 by 2 mm, 40 mm long: between two stops a machine of small acceleration takes it away at a lower mean rate."""
    text = "G21 G17 G90 G94 G54\nT1 M6\nS1000 M3\nG0 X-10 Y20 Z5\nZ-2\nG1 X70 F3000\nG0 Z5\n"
    run = mnclab.run(text, "g43", mnclab.Setup(stock=((0, 0, -20), (60, 40, 0))))
    told = [dict(report(run, machine=machine).facts)["removal rate"].split(",")[0] for machine in ("fast-mill", "hobby-router")]
    rates = [run.removal(machine=machine).mean / 1000 for machine in ("fast-mill", "hobby-router")]
    assert [float(each.removesuffix(" cm³/min")) for each in told] == [float(f"{rate:.3g}") for rate in rates]
    assert rates[0] > 1.01 * rates[1]


def test_a_report_for_a_named_machine(run, tmp_path):
    """Its time is that of the profile on this machine; a machine that nobody knows is refused."""
    page = run.report(tmp_path / "a.html", machine="small-mill").read_text("utf-8")
    assert f"{run.profile(machine='small-mill').time:.2f} s" in page and "46.20 s" not in page.split("<h2>")[0]
    with pytest.raises(Alarm, match="small-mil"):
        run.report(tmp_path / "b.html", machine="small-mil")

"""Reports: what stands in them, that the page is well formed, and that pages are the same every time."""

from html.parser import HTMLParser

import pytest

import mnclab
from mnclab import Alarm
from mnclab.show.plot import report as pages
from mnclab.show.report import report

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


def test_the_figures_are_those_of_the_run(run):
    found = report(run, "Part 7")
    facts = dict(found.facts)
    assert found.title == "Part 7" and facts["cutting length"] == "27 mm"  # 7 down, 20 along
    assert facts["time"] == "46.20 s"  # 27 mm at 100 mm/min and 30 s
    assert [(row[0], row[-1]) for row in found.tools] == [("T1", "16.20 s"), ("T2", "30.00 s")]
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
    assert 'alt="tool path: 3 moves' in body


def test_the_pages_are_the_same_every_time(run, tmp_path):
    one, other = (run.report(tmp_path / f"{name}.pdf", colour="feed").read_bytes() for name in "ab")
    assert one == other and one.startswith(b"%PDF") and one.count(b"/Type /Page\n") + one.count(b"/Type /Page ") == 3


def test_a_long_program_goes_on_over_pages():
    found = report(mnclab.run("G0 X1\n" * 200 + "// " + "x" * 300 + "\n", "mnc"))
    lines = list(pages.listing(found.listing))
    assert len(lines) == 200 + 4 and max(map(len, lines)) <= pages.WIDTH
    assert sum(map(len, pages.chunks([(line, False) for line in lines]))) == 204


def test_every_place_of_a_warning_is_marked_as_one(tmp_path):
    run = mnclab.run("G17 G90 G54 T4 F200 S800 M3\nG3 Z-1 I10\nG3 Z-2 I10\nX,1\n", "mnc")
    found = report(run)
    assert [mark for _, _, mark in found.listing] == ["", "warning", "warning", "alarm"]
    text = run.report(tmp_path / "a.html").read_text("utf-8")
    assert text.count('<span class="warning">') == 2 and text.count('<span class="alarm">') == 1
    assert [line[2] for line in pages.listing(found.listing)] == list(" ??!")


def test_a_flood_of_alarms_has_a_short_report(tmp_path):
    """The first alarms and their number as on the card; the listing of the pages has an end and says so."""
    run = mnclab.run("X,1\n" * 5000, "mnc")
    text = run.report(tmp_path / "a.html").read_text("utf-8")
    assert text.count('role="alert"') == 20 and "4980 more alarms, 5000 in all" in text
    lines = [line for line, _ in (*pages.front(report(run)), *pages.texts(report(run)))]
    assert len(lines) < 2100 and "… and 4980 more alarms, 5000 in all" in lines
    assert lines[-1].startswith("… 3000 of 5000 lines are left out")


def test_quotes_are_not_folded(tmp_path):
    """The caret stands below its word only where the quoted line is one."""
    run = mnclab.run("G1 " + "X1 " * 100 + "X,1 " + "Y1 " * 100 + "\n", "mnc")
    lines = [line for line, _ in pages.front(report(run))]
    (caret,) = (k for k, line in enumerate(lines) if set(line.strip()) == {"^"})
    assert lines[caret - 1].startswith("    … ") and lines[caret - 1].endswith(" …")
    assert lines[caret - 1][lines[caret].index("^") :].startswith("X,1")
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
    assert [row[:2] for row in found.removal] == [("T1 end mill 10", "2.4 cm³")]
    page = run.report(tmp_path / "a.html").read_text("utf-8")
    assert page.count("rapid motion in material") == collided
    assert ("<h2>Collisions</h2><p>none</p>" in page) is not collided
    lines = [line for line, _ in pages.front(found)]
    told = lines[lines.index("Collisions") + 1 :]
    assert told[0].startswith("program:5: collision: rapid motion" if collided else "none")


def test_without_a_blank_a_report_is_as_it_was(run, tmp_path):
    found = report(run)
    assert not found.removal and not {"removed", "collisions"} & dict(found.facts).keys()
    assert "Collisions" not in run.report(tmp_path / "a.html").read_text("utf-8")

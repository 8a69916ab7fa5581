"""The measuring record in a report, on a card and in the shell; touches as a table."""

import json
import re

import numpy as np
import pytest
from tools.toy_probing import toy_run

import mnclab
from mnclab import __main__ as shell
from mnclab.show.plot.pages import sheets
from mnclab.show.report.document import Document, Image
from mnclab.show.report.gathering import measuring
from mnclab.workpiece.part import box, hole

PART = box((0, 0, -20), (100, 60, 0)) - hole((50.1, 29.9, 0), 24.2, 10)
TEXT = "M1 X50 Y30 D24 Z-5\nM4 X0 Y30 Z-5\nM5 X20 Y10 Z0.01"


@pytest.fixture(scope="module")
def measured():
    return toy_run(TEXT, PART)


def test_touches_print_what_they_found_number_one_the_first(measured):
    assert repr(measured.touches).splitlines()[0].split() == "number line what X, mm Y, mm Z, mm ball, mm".split()
    assert measured.touches.texts()[4] == ("5", "4", "M4 touch 1", "0.0000", "30.0000", "-5.0000", "2.0000")
    assert measured.touches._repr_html_().count("<tr>") == 1 + len(measured.touches) == 7
    assert repr(toy_run("", PART).touches) == "nothing was touched"
    assert measured.touches == tuple(measured.touches)


def test_the_verdict_counts_what_has_limits(measured):
    """Of 5 measures the diameter (24.2, limits 23.95 to 24.05) and Z (0 for 0.01, limits -0.02 to 0.02) have limits."""
    assert len(measured.measurements) == 5
    assert measured.measurements.verdict == "within their limits: 1 of 2 measures"
    assert measured.measurements.of("M4").verdict == "1 measure, none with limits"


def test_the_report_has_the_record_its_blanks_and_its_pictures(measured, tmp_path):
    text = measured.report(tmp_path / "a.html", "Plate 7").read_text("utf-8")
    said = re.sub("<[^>]+>", " ", text.partition("<body>")[2])
    for piece in ("Measured by the probe", "date", "measured by", "24.2000", "+0.2000", "1 of 2 measures"):
        assert piece in said, piece
    assert text.count('alt="measured: 3 panels, 6 touched points"') == 1


def test_the_pages_have_the_record_too(measured, tmp_path):
    one, other = (measured.report(tmp_path / f"{name}.pdf").read_bytes() for name in "ab")
    assert one == other and one.startswith(b"%PDF")
    page, *_ = sheets(Document("a", "b", [measuring(measured, "a")]))
    (y,) = (each.y for each in page.texts_on_it if each.text == "diameter")
    row = [each.text for each in sorted(page.texts_on_it) if each.y == y]
    assert row[1:] == ["M1", "diameter", "24.0000", "24.2000", "+0.2000", "23.9500", "24.0500", "out"]


def test_a_long_measuring_has_a_report_of_few_pictures(tmp_path, monkeypatch):
    monkeypatch.setattr("mnclab.show.report.gathering.PANELS", 2)
    monkeypatch.setattr("mnclab.show.report.gathering.MOST_PANELS", 4)
    text = toy_run("M4 X0 Y30 Z-5\n" * 9, PART).report(tmp_path / "a.html").read_text("utf-8")
    assert text.count('alt="measured: 2 panels') == 2 and "cycles without a picture: 5" in text


def test_of_many_cycles_those_beyond_their_limits_have_the_pictures(tmp_path, monkeypatch):
    """The bore of 24.2 in line 8 is out, the wall of the eight lines around it has no limits."""
    monkeypatch.setattr("mnclab.show.report.gathering.MOST_PANELS", 1)
    run = toy_run("M4 X0 Y30 Z-5\n" * 5 + "M1 X50 Y30 D24 Z-5\n" + "M4 X0 Y30 Z-5\n" * 3, PART)
    (picture,) = (piece.picture for piece in measuring(run, "a").pieces if isinstance(piece, Image))
    (title,) = (ax.get_title(loc="left") for ax in picture.axes)
    assert title.startswith(f"line {next(row.line for row in run.measurements.outside)} ") and "M1" in title


def test_a_report_without_measuring_has_no_record(tmp_path):
    text = mnclab.run("G0 X1\n", "mnc").report(tmp_path / "a.html").read_text("utf-8")
    assert "Measured" not in text


def test_the_card_has_the_first_lines(measured):
    assert "24.2000" in measured._repr_html_() and "run.measurements" not in measured._repr_html_()
    assert "8 more: <code>run.measurements" in toy_run("M4 X0 Y30 Z-5\n" * 20, PART)._repr_html_()


PROGRAM = """BEGIN PGM P MM
BLK FORM 0.1 Z X+0 Y+0 Z-20
BLK FORM 0.2 X+60 Y+40 Z+0
TOOL CALL 1 Z S1000
L X-10 Y+20 Z+5 R0 FMAX M3
L Z-6 R0 FMAX
L X+20 R0 F200
L Z+50 R0 FMAX M5
TOOL CALL 7 Z
L Z+50 R0 FMAX
TCH PROBE 419 PRESET
Q263=+24.9
Q264=+20
Q261=-2
Q320=+0
Q260=+50
Q272=+1
Q267=+1
Q305=+0
Q333=+0
Q303=+1
END PGM P MM
"""
SETUP = (
    'part = "cut"\n[tools.1]\nradius = 5\nlength = 60\nkind = "mill"\n[tools.7]\nradius = 2\nlength = 80\nkind = "probe"\n'
    "[presets]\n1 = [100, 200, -300]\n[settings]\npreset = 1\n"
)


def test_the_shell_prints_the_record(tmp_path, monkeypatch, capsys):
    """A 10 mm mill to X20 leaves a wall at X25, measured for 24.9."""
    (tmp_path / "p.h").write_text(PROGRAM)
    (tmp_path / "s.toml").write_text(SETUP)
    monkeypatch.chdir(tmp_path)
    assert shell.main(["run", "p.h", "--setup", "s.toml"]) == 0
    out = capsys.readouterr().out
    assert out.splitlines()[-2].split() == ["p.h:11", "TCH", "PROBE", "419", "X", "24.9000", "25.0000", "+0.1000", "–", "–"]
    assert out.splitlines()[-1] == "1 measure, none with limits"
    assert shell.main(["run", "p.h", "--setup", "s.toml", "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)["measurements"]
    assert row["actual"] == pytest.approx(25) and row["deviation"] == pytest.approx(0.1) and row["lower"] is None
    assert shell.main(["plot", "p.h", "--setup", "s.toml", "--measured", "-o", "m.svg"]) == 0
    assert "TCH PROBE 419" in (tmp_path / "m.svg").read_text("utf-8")


def test_a_plate_with_a_bore_too_large(tmp_path, monkeypatch):
    """The hole of 24.06 is beyond the limit of 24.05. The ball has a radius of 2: on every rapid its middle stays so far away."""
    monkeypatch.chdir(tmp_path)
    plate = mnclab.part.box((0, 0, -20), (100, 60, 0)) - mnclab.part.hole((50.05, 29.98, 0), diameter=24.06, depth=10)
    probe = mnclab.Tool(radius=2, length=80, kind="probe")
    setup = mnclab.Setup(part=plate.turned(0.1), tools={7: probe}, start=(0, 0, 150))  # the spindle stands above the plate
    run = mnclab.run("N10 G54 T7\nN20 G0 X50 Y30 Z20\nN30 G421 X50 Y30 D24 Z-5 H20 R24.05 T23.95\n", "mnc", setup)
    assert run.ok and [row.what for row in run.measurements.outside] == ["diameter"]
    run.report("plate.html")
    assert (tmp_path / "plate.html").exists() and len(run.touches)
    rapids, share = run.toolpath[run.toolpath.kind == mnclab.Kind.RAPID], np.linspace(0, 1, 400)[:, None, None]
    middles = (rapids.start + share * (rapids.end - rapids.start)).reshape(-1, 3) + run.toolpath.origin + (0, 0, 2)
    assert setup.part(middles).min() >= 2 - 1e-9


def test_the_record_is_saved_as_csv_or_json_and_as_nothing_else(measured, tmp_path):
    saved = measured.measurements.save(tmp_path / "record.json")
    assert [row["what"] for row in json.loads(saved.read_text())] == [row.what for row in measured.measurements]
    assert measured.measurements.save(tmp_path / "record.csv").read_text().startswith("line,cycle,what")
    for name, wrong in (("record.html", "as .html; run.report has them"), ("record", "'record' has no suffix")):
        with pytest.raises(mnclab.Alarm, match=wrong):
            measured.measurements.save(tmp_path / name)
    with pytest.raises(mnclab.Alarm, match="cannot be written"):
        measured.measurements.save(tmp_path / "nowhere" / "record.csv")


def test_what_is_beyond_its_limits_is_bold(measured):
    """Rows of the page: one of the two with limits is out; bold is seen in grey too."""
    rows = measured.measurements._repr_html_().split("<tr>")
    bold = [row for row in rows if "font-weight:bold" in row]
    assert len(bold) == 1 and ">out<" in bold[0]


def test_a_measured_datum_says_what_is_not_zero():
    assert str(mnclab.Datum(50.1, 29.9)) == "X50.1 Y29.9" and str(mnclab.Datum(rotation=2)) == "rotation 2"
    assert str(mnclab.Datum()) == "X0 Y0 Z0"


@pytest.mark.parametrize("name", ["record.xlsx", "record", "nowhere/record.csv"])
def test_a_record_is_saved_as_csv_or_refused(measured, tmp_path, name):
    with pytest.raises(mnclab.Alarm):
        measured.measurements.save(tmp_path / name)
    assert list(tmp_path.iterdir()) == []
    measured.measurements.save(tmp_path / "record.csv")
    assert len((tmp_path / "record.csv").read_text(encoding="utf-8").splitlines()) == 1 + 5


def test_with_the_tool_axis_x_pictures_and_touches_name_y_and_z():
    """A hole of 30 along X about Y10 Z-5, in a plate whose face is X0: the touches lie at Y25, Z10, Y-5, Z-20."""
    part = mnclab.part.box((-40, -60, -60), (0, 60, 60)) - mnclab.part.cylinder((-20, 10, -5), (10, 10, -5), 15)
    words = "Q273=+10 Q274=-5 Q262=30 Q325=+0 Q247=+90 Q261=-5 Q320=0 Q260=+20 Q301=0 Q275=0 Q276=0 Q279=0 Q280=0 Q281=1 Q309=0"
    text = f"TOOL CALL 6 X\nL X+100 R0 FMAX\nTCH PROBE 421\n{words} Q330=0 Q423=4 Q365=1\n".replace(" Q", "\nQ")
    run = mnclab.run(text, "tnc-620", mnclab.Setup(part=part))
    (ax,) = run.plot_measured().axes
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("Y, mm", "Z, mm")
    said = {text.get_text().split(maxsplit=1)[1] for text in ax.texts if "   " in text.get_text()}
    assert said == {"Y 25.000", "Z 10.000", "Y \N{MINUS SIGN}5.000", "Z \N{MINUS SIGN}20.000"}
    assert [row[3:6] for row in run.touches.texts()] == [
        ("-5.0000", "25.0000", "-5.0000"), ("-5.0000", "10.0000", "10.0000"),
        ("-5.0000", "-5.0000", "-5.0000"), ("-5.0000", "10.0000", "-20.0000"),
    ]  # fmt: skip
    more = run.files["TCHPR421.TXT"].strip().count("\n")
    assert f"Hole measuring' and {more} more lines" in " ".join(str(run.at(line=3)).split())

"""Designs in a shell: what `compare` prints and when its status is 1, and what `drawing` writes."""

import json
import re

import pytest

import mnclab as mnc
from mnclab import __main__ as shell

SLOT = "T1 M6\nS1000 M3\nG43 G0 X-10 Y20 Z5\nG0 Z{z}\nG1 X70 F300\nG0 Z50\n"
BLANK = "low = [0, 0, -20]\nhigh = [60, 40, 0]\n"
DESIGN = f"""title = "Bar"

[blank]
{BLANK}
[[features]]
kind = "pocket"                # the slot of the mill of 10 mm, out at both ends
name = "slot"
points = [[-20, 15], [80, 15], [80, 25], [-20, 25]]
depth = 4
tolerances = {{ depth = 0.02 }}
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A slot as drawn and one that is 0.03 too deep, their blank and the design, in a folder in which commands run."""
    (tmp_path / "slot.g43").write_text(SLOT.format(z="-4"))
    (tmp_path / "deep.g43").write_text(SLOT.format(z="-4.03"))
    (tmp_path / "blank.toml").write_text(f"[stock]\n{BLANK}")
    (tmp_path / "bar.toml").write_text(DESIGN)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def mnclab(*arguments):
    """The exit status of a command line."""
    try:
        return shell.main(arguments)
    except SystemExit as end:
        return end.code


def compared(file, *more):
    return mnclab("compare", file, "--design", "bar.toml", "--setup", "blank.toml", *more)


def test_a_part_as_drawn_is_status_zero(folder, capsys):
    assert compared("slot.g43") == 0
    out, err = capsys.readouterr()
    assert out.startswith("compared with Bar: as drawn, tolerance 0.05 mm") and err == ""
    assert re.search(r"^top +slot +depth +4\.0000 +4\.0000 +0\.0000 +-0\.0200 +\+0\.0200 +ok$", out, re.M)


def test_a_part_outside_the_tolerance_names_its_worst_place_like_an_alarm(folder, capsys):
    assert compared("deep.g43") == 1
    out, err = capsys.readouterr()
    assert re.fullmatch(r"deep\.g43:5: gouge: 0\.0300 mm at X\S+ Y\S+ Z-4\.030, slot\n", err)
    assert re.search(r"^top +slot +depth +4\.0000 +4\.0300 +\+0\.0300 .* out +deep\.g43:5$", out, re.M)


def test_what_nothing_cut_is_told_of_the_program(folder, capsys):
    (folder / "none.g43").write_text("T1 M6\nG0 Z50\n")
    assert compared("none.g43") == 1
    assert capsys.readouterr().err.startswith("none.g43: rest: 4.0000 mm at ")


def test_the_tolerance_is_that_of_faces_without_one(folder, capsys):
    (folder / "bar.toml").write_text(DESIGN.replace("depth = 0.02", ""))
    assert compared("deep.g43") == 0 and compared("deep.g43", "--tolerance", "0.029") == 1
    assert compared("deep.g43", "--tolerance", "0") == 2
    assert "the tolerance of a comparison (mm) must be greater than 0" in capsys.readouterr().err


def test_a_comparison_as_json(folder, capsys):
    assert compared("deep.g43", "--json") == 1
    out, err = capsys.readouterr()
    found = json.loads(out)
    assert err == "" and found["ok"] is False and found["alarms"] == []
    assert found["worst_gouge"]["value"] == pytest.approx(0.03) and found["worst_gouge"]["line"] == 5
    (depth,) = [row for row in found["features"] if (row["feature"], row["measure"]) == ("slot", "depth")]
    assert depth["deviation"] == pytest.approx(0.03) and depth["verdict"] == "out"


def test_a_comparison_is_saved_as_a_map_or_a_table(folder, capsys):
    assert compared("deep.g43", "-o", "map.svg") == 1 and compared("deep.g43", "-o", "table.csv") == 1
    assert (folder / "map.svg").read_text("utf-8").startswith("<?xml")
    assert "depth" in (folder / "table.csv").read_text("utf-8")
    assert compared("deep.g43", "-o", "map.xyz") == 2


def test_alarms_of_the_program_are_told_beside_the_part_up_to_them(folder, capsys):
    (folder / "fault.g43").write_text(SLOT.format(z="-4").replace("G1 X70", "G1 X70,5"))
    assert compared("fault.g43") == 1
    err = capsys.readouterr().err
    assert "fault.g43: rest: " in err and re.search(r"^fault\.g43:5:\d+: alarm: ", err, re.M)


WRONG = [
    ("compare", "slot.g43", "--setup", "blank.toml"),
    ("compare", "slot.g43", "--design", "none.toml", "--setup", "blank.toml"),
    ("compare", "slot.g43", "--design", "wrong.toml", "--setup", "blank.toml"),
    ("drawing", "bar.toml"),
    ("drawing", "bar.toml", "-o", "bar.xyz"),
    ("drawing", "bar.toml", "-o", "bar.svg", "--size", "A7"),
    ("drawing", "bar.toml", "-o", "again.toml", "--size", "A4"),
]


@pytest.mark.parametrize("arguments", WRONG, ids=" ".join)
def test_a_senseless_command_line_is_status_two(folder, capsys, arguments):
    (folder / "wrong.toml").write_text(DESIGN.replace('"pocket"', '"poket"'))
    before = sorted(folder.iterdir())
    assert mnclab(*arguments) == 2
    out, err = capsys.readouterr()
    assert out == "" and err and "Traceback" not in err and sorted(folder.iterdir()) == before
    assert "wrong.toml" not in arguments or err.startswith("wrong.toml:8:1: alarm: ")


def test_without_a_blank_there_is_nothing_to_compare_or_draw(folder, capsys):
    for command in (("compare", "slot.g43", "--design", "bar.toml"), ("drawing", "slot.g43", "-o", "a.svg")):
        assert mnclab(*command) == 1
        assert "there is no blank to cut" in capsys.readouterr().err


def test_a_drawing_of_a_design(folder, capsys):
    assert mnclab("drawing", "bar.toml", "-o", "bar.pdf", "--size", "A3") == 0
    assert (folder / "bar.pdf").read_bytes().startswith(b"%PDF")
    assert b"/MediaBox [ 0 0 1190" in (folder / "bar.pdf").read_bytes()  # 420 mm in points
    assert capsys.readouterr() == ("", "")


def test_a_design_that_cannot_be_read_has_no_drawing(folder, capsys):
    (folder / "wrong.toml").write_text(DESIGN.replace("depth = 4", "depth = -4"))
    assert mnclab("drawing", "wrong.toml", "-o", "a.pdf") == 1
    assert capsys.readouterr().err.startswith("wrong.toml:11:")
    assert not (folder / "a.pdf").exists()


def test_a_program_is_drawn_by_what_it_makes(folder, capsys):
    assert mnclab("drawing", "slot.g43", "--setup", "blank.toml", "-o", "found.toml") == 0
    (found,) = mnc.Design.load(folder / "found.toml").features
    assert found.depth == 4 and "line 5" in found.name
    assert mnclab("drawing", "slot.g43", "--setup", "blank.toml", "-o", "found.svg") == 0
    assert (folder / "found.svg").read_text("utf-8").startswith("<?xml")
    assert mnclab("compare", "slot.g43", "--setup", "blank.toml", "--design", "found.toml") == 0


def test_what_has_no_name_is_a_note(folder, capsys):
    (folder / "slope.g43").write_text(SLOT.format(z="-4").replace("G1 X70", "G1 X70 Z-8"))
    assert mnclab("drawing", "slope.g43", "--setup", "blank.toml", "-o", "a.svg") == 0
    assert re.match(r"slope\.g43: note: what is cut aslant has no name \(slope\.g43:5\)\n", capsys.readouterr().err)


def test_help_shows_the_file_of_a_design(folder, capsys):
    """What is shown can be read back, both kinds."""
    assert mnclab("help", "design") == 0
    _, milled, turned = re.split(r"^a (?:milled|turned) part:\n", capsys.readouterr().out, flags=re.M)
    for name, text in (("milled", milled), ("turned", turned)):
        (folder / f"{name}.toml").write_text(text, "utf-8")
        assert mnc.Design.load(folder / f"{name}.toml").volume > 0

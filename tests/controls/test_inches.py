"""Programs in inches: the numbers of the program come back wherever its path is told, and the columns stay in mm."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Setup, Tool
from mnclab.show.report import report

ISO = "G20\nT1 M6\nG0 X1.23456 Y-.5 S500 M3\nG1 Z-.1001 F12.5\nG2 X2.23456 I.5 J0\nG81 X.123 Y1 Z-.5 R.1 F5\nG80\n"
TNC = "BEGIN PGM A INCH\nTOOL CALL 1 Z S500\nL X+1.23456 Y-.5 R0 FMAX M3\nL Z-.1001 F12.5\nEND PGM A INCH\n"
BOTH = pytest.mark.parametrize(("control", "text"), [("g43", ISO), ("tnc-620", TNC)])


@pytest.mark.parametrize(("control", "text", "unit"), [("g43", ISO, 25.4), ("tnc-620", TNC, 2.54)])
def test_the_listing_has_the_numbers_of_the_program(control, text, unit):
    """F of the TNC counts tenths of an inch a minute (HEIDENHAIN)."""
    path = mnclab.run(text, control).toolpath
    rows = str(path).splitlines()
    assert rows[2].split() == ["3", "rapid", "X1.23456", "Y-0.5", "Z0"]
    assert rows[3].split() == ["4", "line", "X1.23456", "Y-0.5", "Z-0.1001", "F12.5"]
    assert path.end[3] == pytest.approx([1.23456 * 25.4, -12.7, -0.1001 * 25.4], abs=1e-12) and path.feed[3] == 12.5 * unit
    assert "positions in inches" in path._repr_html_()
    assert str(path[2:4]).splitlines() == rows[2:4]  # of a part of the path, too


def test_arcs_and_cycles_of_the_listing():
    rows = [row.split("  ;")[0].split()[2:] for row in str(mnclab.run(ISO, "g43").toolpath).splitlines()]
    assert rows[4][:3] == ["X2.23456", "Y-0.5", "Z-0.1001"] and rows[4][4:6] == ["X1.73456", "Y-0.5"]
    assert rows[-2] == ["X0.123", "Y1", "Z-0.5", "F5"]


@given(st.integers(-9_999_999, 9_999_999), st.integers(1, 6))
def test_every_number_comes_back(number, decimals):
    written = f"{number / 10**decimals:.{decimals}f}"
    found = str(mnclab.run(f"G20\nG0 X{written}\n", "g43").toolpath)
    assert not number or float(found.split("X")[1].split()[0]) == float(written)


@BOTH
def test_explanations_are_in_inches(control, text):
    said = str(mnclab.run(text, control).explain(4))
    assert "line X1.23456 Y-0.5 Z-0.1001 F12.5" in said and "feed: 12.5" in said
    assert "position: 1.23456 -0.5 0 -> 1.23456 -0.5 -0.1001" in said


def test_words_and_moments_are_in_inches():
    run = mnclab.run(ISO, "g43", Setup(datums={1: (25.4, 50.8, 0)}, tools={1: Tool(radius=12.7)}))
    assert "Feed, in/min" in str(run.explain(4)) and "bottom of the hole, in (G81)" in str(run.explain(6))
    moment = str(run.at(4))
    assert "X1.23456 Y-0.5 Z-0.1001" in moment and "feed 12.5 in/min" in moment
    assert "shift X1 Y2 Z0" in str(run.explain(4))


def test_cards_and_reports_are_in_inches():
    setup = Setup(tools={1: Tool(radius=12.7)}, stock=((0, 0, -25.4), (50.8, 25.4, 0)))
    run = mnclab.run("G20\nT1 M6\nS500 M3\nG1 X3 F10\n", "g43", setup)
    assert "cutting 3.000 in" in repr(run) and "3.000 in" in run._repr_html_()
    page = report(run)
    facts = dict(page.facts)
    assert facts["cutting length"] == "3 in" and facts["X from, to"] == "0, 3 in" and facts["blank"] == "2 x 1 x 1 in"
    (tool,) = (dict(zip(page.tools.head, row)) for row in page.tools.rows)
    assert tool["diameter, in"] == "1"


def test_a_program_in_millimetres_after_all():
    """What the program counts in at its end counts for the whole path."""
    path = mnclab.run("G20\nG0 X1\nG21\nX30\n", "g43").toolpath
    assert str(path).split() == ["2", "rapid", "X25.4", "Y0", "Z0", "4", "rapid", "X30", "Y0", "Z0"]


def test_copies_and_pieces_keep_the_unit():
    import copy

    path = mnclab.run(ISO, "g43").toolpath
    assert all(each.inches for each in (copy.deepcopy(path), path[1:], path.motion, mnclab.run(ISO, "g43").programmed))
    assert np.array_equal(copy.deepcopy(path).end, path.end)


@pytest.mark.parametrize(("unit", "short", "zeros"), [("G21", "mm", "0000"), ("G20", "in", "000000")])
def test_faults_of_arcs_are_told_as_they_are_typed(unit, short, zeros):
    """Radii of 1 and 2, and a chord of 10 for a radius of 3 that needs 5 and lacks 2: the numbers of the program."""
    head = f"{unit}\nT1 M6\nS500 M3\nG0 X0 Y0\n"
    off, near = (mnclab.run(head + block, "g43").alarms[0] for block in ("G2 X3 I1 F9\n", "G2 X10 R3 F9\n"))
    assert f"radius 1.{zeros} at the start, 2.{zeros} at the end, allowed difference" in off.message
    assert off.message.endswith(f" {short}") and near.hint == f"too short by 2 {short}"
    assert f"R3 is too small for the distance 10 {short} between start and end: at least 5 {short} is needed" in near.message


def test_faults_of_arcs_of_klartext_in_inches():
    head = "0 BEGIN PGM A INCH\n1 TOOL CALL 1 Z S500\n2 L X+0 Y+0 Z+1 R0 FMAX M3\n"
    near = mnclab.run(head + "3 CR X+10 R+3 DR+ F9\n4 END PGM A INCH\n", "tnc-620").alarms[0]
    assert "R3 is too small for the distance 10 in between start and end: at least 5 in is needed" in near.message


@pytest.mark.parametrize(
    ("unit", "scale", "removed", "deep"),
    [("G21", 25.4, "16.4 cm³", "12.700 mm deep at X"), ("G20", 1.0, "1 in³", "0.500 in deep at X")],
)
def test_volumes_and_collisions_are_told_in_the_unit_of_the_program(unit, scale, removed, deep, tmp_path):
    """A slot 1 wide, 0.5 deep and 2 long: 1 in³ is 16.387 cm³. The same way at rapid is 0.5 deep in the plate."""
    x, y, z, end, feed = (round(each * scale, 4) for each in (-1, 1, -0.5, 3, 10))
    text = f"{unit}\nT1 M6\nS500 M3\nG0 X{x} Y{y} Z{z}\nG1 X{end} F{feed}\nG0 Z{y}\nM30\n"
    tools = {1: mnclab.Tool(radius=12.7, kind="mill")}
    setup = mnclab.Setup(tools=tools, stock=((0, 0, -25.4), (50.8, 50.8, 0)), start=(-100, 0, 100))
    run = mnclab.run(text, "g43", setup)
    report = run.report(tmp_path / "a.html").read_text("utf-8")
    assert all(removed in each for each in (repr(run.removal()), report, run._repr_html_()))
    assert ("cm³" in report) == (unit == "G21") and ("in³" in report) == (unit == "G20")
    (met,) = mnclab.run(text.replace("G1 X", "G0 X"), "g43", setup).collisions()
    assert met.depth == pytest.approx(12.7) and deep in str(met)

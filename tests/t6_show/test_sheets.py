"""The sheets of a shop: what stands on them, and that they are drawn where the blank and its datum are."""

import re

import pytest

import mnclab
from mnclab import Alarm, Setup, Tool
from mnclab import __main__ as shell
from mnclab.show.plot.colours import QUARTERS
from mnclab.show.plot.set_up import plot_set_up
from mnclab.show.report import gathering
from mnclab.show.report.document import TextTable

PROGRAM = "T1 M6\nG90 G55\nS2000 M3\nG43 H11 D3 G0 X-10 Y10 Z5\nG1 Z-2 F100\nX90 F300\n"
PROGRAM += "T2 M6\nG43 H2 G0 Z5\nG81 X5 Y5 Z-9 R2 F80\n"
MILL = Tool(5, 80, name="end mill 10", kind="mill", teeth=4, centre_cutting=True)
TOOLS = {1: MILL, 2: Tool(3, 95, kind="drill", angle=118, teeth=2)}
SETUP = Setup(
    tools={**TOOLS, 3: Tool(8), 11: Tool(5, 80)}, datums={2: (103, 52, -200)}, stock=((100, 50, -221), (180, 90, -201)),
    fixtures=(((90, 50, -230), (100, 90, -210)),), start=(0, 0, 100),
)  # fmt: skip


@pytest.fixture(scope="module")
def plate():
    return mnclab.run(PROGRAM, "g43", SETUP)


def tables(pieces):
    found = [each for each in pieces if isinstance(each, TextTable)]
    return [dict(zip(each.head, row)) if each.head else tuple(row) for each in found for row in each.rows]


def test_the_set_up_says_where_the_datum_stands(plate):
    """G55 stands at X103 Y52 Z-200: 3 and 2 mm from the sides of the blank and 1 mm above its top, -201."""
    found = tables(gathering.set_up(plate).pieces)
    assert found[0] == {"datum": "G55", "X": "103.000", "Y": "52.000", "Z": "-200.000"}
    said = dict(each for each in found if isinstance(each, tuple))
    assert said["blank"] == "80 x 40 x 20 mm" and said["fixture"] == "X 90 to 100, Y 50 to 90, Z -230 to -210 mm"
    (place,) = (text for name, text in said.items() if name.endswith("stands"))
    assert place == "3 mm from its left side, 2 mm from its front side, 1 mm above its top"


def test_the_drawing_has_the_blank_its_sizes_and_the_datum(plate):
    """G55 is chosen before anything moves: the path counts from there, the blank is 3 and 2 mm before it. Sizes 80, 40, 20."""
    above, side = plot_set_up(plate).axes
    boxes = [patch.get_xy() for patch in above.patches if patch.get_zorder() == 1.0]
    assert boxes[0].min(axis=0) == pytest.approx((-3, -2)) and boxes[0].max(axis=0) == pytest.approx((77, 38))
    texts = [each.get_text() for ax in (above, side) for each in ax.texts]
    assert [text for text in texts if text in ("80", "40", "20")] == ["80", "40", "20"] and "G55" in texts
    spots = [line.get_xydata().tolist() for line in above.lines if line.get_marker() is QUARTERS]
    assert spots == [[[0, 0]]]


@pytest.mark.parametrize("size, unit", [(0.01, "mm"), (5000, "mm")])
def test_tiny_and_huge_blanks(size, unit):
    run = mnclab.run("G54 T1 S500 M3\nG0 X0 Y0 Z1\n", "mnc", Setup(stock=((0, 0, -size), (size, size, 0))))
    picture = plot_set_up(run)
    assert f"{size:g}" in [each.get_text() for ax in picture.axes for each in ax.texts]


def test_the_tools_with_their_sizes_and_correctors(plate):
    """Diameters, not radii: 10 and 6; the numbers H that the program calls."""
    first, second = tables([gathering.tools_table(plate, gathering.used_tools(plate), plate.profile())])
    assert [first[name] for name in ("tool", "diameter, mm", "length, mm", "teeth", "H")] == ["T1", "10", "80", "4", "11"]
    assert (second["diameter, mm"], second["point angle, °"], second["H"]) == ("6", "118", "2")
    assert "corner radius, mm" not in first  # no tool has one


def test_a_lathe_tells_diameters():
    run = mnclab.run("M3 T1\nS500 G97\nG00 X26 Z2\nG01 Z-30 F100\n", "jnc-t01", Setup(stock=mnclab.blank.cylinder(30, -60, 1)))
    said = dict(each for each in tables(gathering.set_up(run).pieces) if isinstance(each, tuple))
    assert said["blank"] == "⌀60 x 61 mm" and said["zero stands"] == "on the axis of the spindle, 1 mm behind its face"
    assert tables(gathering.set_up(run).pieces)[0].keys() == {"datum", "X", "Z"}, "a lathe has no Y"
    assert said["spindle at the start"].startswith("X0 Z0, ")
    assert "⌀60" in [each.get_text() for each in plot_set_up(run).axes[0].texts]


def test_names_of_two_zero_points_do_not_lie_over_one_another():
    picture = plot_set_up(mnclab.run("data/lessons/slope.h", setup="data/lessons/slope.toml"))
    picture.draw_without_rendering()
    for ax in picture.axes:
        preset, shifted = (each.get_window_extent() for each in ax.texts if each.get_text() in ("preset", "datum shift"))
        assert not preset.overlaps(shifted)


def test_the_name_of_a_zero_point_on_the_face_is_clear_of_the_dimension_beside_it():
    run = mnclab.run("data/programs/jnc-t01/shaft.jnc", setup="data/setups/jnc-t01/shaft.toml")
    picture = plot_set_up(run, (6.0, 3.2))
    picture.draw_without_rendering()
    name = next(each for each in picture.axes[0].texts if each.get_text() == "zero").get_window_extent()
    upright = [each for each in picture.axes[0].texts if not each.get_text() and each.xy[0] == each.xyann[0]]
    assert [name.overlaps(each.arrow_patch.get_window_extent()) for each in upright] == [False]


@pytest.mark.parametrize("suffix", ["html", "pdf"])
def test_sheets_are_files_and_the_same_every_time(plate, tmp_path, suffix):
    for write in (plate.setup_sheet, plate.tool_sheet):
        one, other = (write(tmp_path / f"{name}.{suffix}", "Plate 7").read_bytes() for name in "ab")
        assert one == other and (b"Plate 7" in one or suffix == "pdf")
    page = re.sub("<[^>]+>", " ", plate.setup_sheet(tmp_path / "c.html").read_text("utf-8"))
    assert "Set-up sheet" in page and "end mill 10" in page and "80 x 40 x 20 mm" in page


def test_sheets_that_cannot_be_are_refused(plate, tmp_path):
    with pytest.raises(Alarm, match=r"an \.html or a \.pdf file"):
        plate.setup_sheet(tmp_path / "a.txt")
    with pytest.raises(Alarm, match="title of a report must be a text"):
        plate.tool_sheet(tmp_path / "a.pdf", 7)
    with pytest.raises(Alarm, match="nothing was measured"):
        plate.measuring_sheet(tmp_path / "a.pdf")
    assert list(tmp_path.iterdir()) == []


def test_the_shell_writes_a_sheet(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "p.mnc").write_text("G54 T1 S500 M3\nG0 X0 Y0 Z1\n")
    for sheet in ("setup", "tools"):
        assert shell.main(["report", "p.mnc", "-o", f"{sheet}.html", "--sheet", sheet]) == 0
    assert "Tool sheet" in (tmp_path / "tools.html").read_text("utf-8")
    with pytest.raises(SystemExit):
        shell.main(["report", "p.mnc", "-o", "x.html", "--sheet", "measuring"])
    assert "nothing was measured" in capsys.readouterr().err



def test_records_of_a_program_in_inches_say_so(tmp_path):
    """A wall at X = 1 in (25.4 mm), told as 1.00000 in; the numbers of the record stay mm."""
    part = mnclab.part.box((25.4, -50.8, -25.4), (76.2, 50.8, 0))
    text = "BEGIN PGM A INCH\nTOOL CALL 7 Z\nL X+0 Y+0 Z+1 R0 FMAX\nTCH PROBE 419 PRESET\nQ263=+.99\nQ264=+0\nQ261=-.1\n"
    text += "Q320=+0\nQ260=+1\nQ272=+1\nQ267=+1\nQ305=+0\nQ333=+0\nQ303=+1\nEND PGM A INCH\n"
    tools = {7: Tool(2, 50, kind="probe")}
    run = mnclab.run(text, "tnc-620", Setup(part=part, tools=tools, presets={0: (0, 0, 0)}, start=(0, 0, 100)))
    (row,) = run.measurements
    assert row.actual == pytest.approx(25.4) and "1.00000" in repr(run.measurements) and "actual, in" in repr(run.measurements)
    assert "+0.01000" in run.measurements._repr_html_() and "X, in" in repr(run.touches) and "1.00000" in repr(run.touches)
    head, line = run.measurements.save(tmp_path / "a.csv").read_text().splitlines()
    told = dict(zip(head.split(","), line.split(",")))
    assert told["unit"] == "in" and float(told["actual"]) == pytest.approx(1) and float(told["deviation"]) == pytest.approx(0.01)
    (ax,) = run.plot_measured().axes
    assert ax.get_xlabel() == "X, in" and any("X 1.0000" in each.get_text() for each in ax.texts)

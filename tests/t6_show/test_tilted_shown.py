"""A tool that stands tilted on the part is drawn tilted: strokes in the views of a path, body and holder in space."""

from dataclasses import replace

import numpy as np
import pytest
from tools.pages import unpack

import mnclab as mnc
from mnclab.show import solids
from mnclab.show.player.payload import payload
from mnclab.show.plot import colours
from mnclab.show.report.gathering import report

TOOL = mnc.Tool(radius=4, length=90, cutting_length=25, holder=((10, 35), (20, 50)))
SQUARE = "L X+20 Y+0 Z+5 FMAX\nL X-20 F500\nL Y+20\nL Z+50 FMAX"


def made(text, machine="table-ac", tool=TOOL):
    setup = mnc.Setup(tools={2: tool}, kinematics=machine)
    run = mnc.run(f"BEGIN PGM T MM\nTOOL CALL 2 Z S3000\nL X+0 Y+0 Z+50 R0 FMAX M3\n{text}\nEND PGM T MM\n", "tnc-620", setup)
    assert run.ok, run.alarms
    return run


def strokes_of(picture, view):
    """Tips and ends (k, 2, 2) of the strokes along the tool in one view."""
    (line,) = (each for each in picture.axes[view].lines if each.get_label() == colours.TILTED.name)
    return np.array(line.get_xydata()).reshape(-1, 3, 2)[:, :2]


def test_strokes_stand_as_the_tool_does():
    """A at 90 lays the part on its side: the tool comes along -Y. From above the strokes run there, from the front they are dots;
    they are a sixth of the 40 mm that are cut, and every tip lies on the cut."""
    run = made(f"L A+90 FMAX\n{SQUARE}")
    above, front = (strokes_of(run.plot(view=view), 0) for view in ("XY", "XZ"))
    assert np.allclose(above[:, 1] - above[:, 0], (0, -0.16 * 40), atol=1e-9)
    assert np.allclose(front[:, 1], front[:, 0], atol=1e-9)
    x, z = run.toolpath.end[run.toolpath.line == 6][0][[0, 2]]  # where X stands at -20 and Y begins
    assert (np.isclose(front[:, 0, 0], x) | np.isclose(front[:, 0, 1], z)).all()


def test_strokes_are_spread_evenly():
    """24 strokes over 40 and 20 mm: one every 2.5 mm of way."""
    tips = strokes_of(made(f"L A+30 FMAX\n{SQUARE}").plot(), 0)[:, 0]
    along = tips[tips[:, 1] == tips[0, 1]]
    assert len(tips) == 24 and np.allclose(np.diff(along[:, 0]), -2.5)


@pytest.mark.parametrize("machine", ["table-ac", None])
def test_a_tool_that_stands_upright_has_none(machine):
    labels = [line.get_label() for ax in made(SQUARE, machine).plot().axes for line in ax.lines]
    assert colours.TILTED.name not in labels


def test_bodies_stand_on_the_tip_along_the_tool():
    """Head B at 30 leans the tool to (sin 30, 0, cos 30), and C in the table at 90 turns that on the part to Y."""
    run = made(f"L B+30 C+90 FMAX\n{SQUARE}", "head-b-table-c")
    tip, along = run.toolpath.end[-1], (0, 0.5, np.sqrt(3) / 2)
    assert np.allclose(run.toolpath.directions[-1], along)
    for body, low, high, wide in ((solids.tool_of(run), 0, 35, 4), (solids.holder_of(run), 35, 90, 20)):
        heights = (body.points - tip) @ along
        assert heights.min() == pytest.approx(low) and heights.max() == pytest.approx(high)
        assert np.linalg.norm(body.points - tip - heights[:, None] * along, axis=1).max() == pytest.approx(wide)
        assert body.volume > 0
    assert "holder" in run.scene().actors


@pytest.mark.parametrize("kind, shank, at_30", [("", None, 3.6), ("", (3, 28), 3), ("drill", None, 3.6), ("drill", (2, 10), 2)])
def test_the_shank_goes_up_to_the_holder(kind, shank, at_30):
    """It begins above the edges at nine tenths of the tool, or as the table says, and ends where the holder begins, at 35."""
    body = solids.tool_body(replace(TOOL, kind=kind, shank=shank))
    (top,) = np.unique(body.points[body.points[:, 2] > 30, 2])
    assert top == 35 and np.hypot(*body.points[body.points[:, 2] == 35, :2].T).max() == pytest.approx(at_30)
    assert np.hypot(*body.points[body.points[:, 2] == 25, :2].T).max() == pytest.approx(4)


def test_a_tool_without_a_holder_has_none():
    assert solids.holder_of(made("L A+30 FMAX", tool=mnc.Tool(radius=4, length=90))) is None
    assert solids.holder_of(made(SQUARE, None)) is None


DRILLED = (
    "BLK FORM 0.1 Z X-30 Y-30 Z-20\nBLK FORM 0.2 X+30 Y+30 Z+0\nL A+30 FMAX\nL X+0 Y+0 Z+20 FMAX\nL Z-15 F200\nL Z+60 FMAX\n"
    "L A+0 FMAX"
)


def test_a_report_names_the_axes_of_the_machine(tmp_path):
    page = made(SQUARE).report(tmp_path / "r.html").read_text("utf-8")
    assert "Five-axis mill, table A and C: A and C in the table, A from \N{MINUS SIGN}120 to 120°" in page
    assert "kinematics" not in made(SQUARE, None).report(tmp_path / "r.html").read_text("utf-8")


def test_tables_say_what_they_leave_out_of_tilted_tools():
    run = made(DRILLED)
    assert run.holes().nothing == "no holes along Z, what tilted tools cut is left out"
    assert "in threads, or under tilted tools, which are not looked at." in "\n".join(run.cutting_data().notes)
    assert ", the largest rate at least " in dict(run.outcome().facts())["removal rate"]  # as the tables have it
    assert any("rows of a tool not along Z are left out" in each for each in run.design().notes)
    upright = made(DRILLED.replace("A+30", "A+0"))
    assert upright.holes().reach == "" and len(upright.holes()) == 1 and upright.design().notes == ()
    assert "tilted" not in "\n".join(upright.cutting_data().notes)


LED = (
    "BLK FORM 0.1 Z X-40 Y-30 Z-20\nBLK FORM 0.2 X+40 Y+30 Z+0\nL X-60 Z+5 FMAX\nM128 F2000\nL Z-3 F200\nL X+0 A+20\n{more}"
    "L Z+60 F2000\nM129"
)


def test_the_player_says_what_it_does_not_cut():
    """A about X while the tip goes along X: the part is cut, the page leaves those rows out. Where C turns too, neither cuts."""
    for more, left in (("", False), ("L X+40 A-20 C+30\n", True)):
        run = made(LED.format(more=more))
        turn = int((run.toolpath.line == 9).sum())
        header, _ = unpack(payload(run, run.profile(), run.workpiece().cutting))
        assert turn > 4 and any("on which the tool turns are left out" in each for each in run.workpiece().notes) is left
        count, also = header["part"]["note"].split(" moves on which the tool turns: not cut here; ")
        assert (int(count) > turn if left else int(count) == turn) and also == f"run.workpiece() cuts {turn} of them"


def test_what_was_not_judged_is_said_in_the_verdict(tmp_path):
    """Rows on which A and C turn are judged by nothing: the verdict is a doubt and no praise, and so is the section."""
    run = made(LED.format(more="L X+40 A-20 C+30\n"), tool=replace(TOOL, cutting_length=80, holder=()))
    said, tone = report(run).verdict()
    assert "no collisions where judged; " in said and "rows on which the tool turns not judged" in said and tone == "doubtful"
    page = run.report(tmp_path / "r.html").read_text("utf-8")
    assert page.count('<p class="doubtful">') == 3 and "<h2>Collisions</h2><p>none" not in page
    run.report(tmp_path / "r.pdf")


def test_a_report_tells_the_tip_from_the_axes():
    """A at 90 lays the part on its side about the line Y0 Z50: the tip stands at 5 above the table and 90 below the spindle when
    Z stands at 95; a machine without rotary axes has the extents as ever."""
    facts = dict(report(made("L X+20 A+90 FMAX\nL X-20 F500")).facts)
    assert "X from, to" not in facts
    assert facts["axes of the machine"] == "X -20 to 20, Y 0 to 0, Z 0 to 140 mm; A 0 to 90, C 0 to 0 degrees"
    assert facts["tip on the part"].startswith("X -20 to 20, Y ")
    assert "X from, to" in dict(report(made(SQUARE, None)).facts)

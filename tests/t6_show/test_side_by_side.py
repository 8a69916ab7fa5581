"""What is compared: strategies by name, profiles of machines, holes apart from order and heights, the largest radius."""

import csv
import json

import numpy as np
import pytest

import mnclab as mnc
from mnclab.__main__ import main
from mnclab.show.plot.holes import holes_of

AREA = mnc.area.Region.of(mnc.area.rectangle(60, 40, 6))
HOLES_MNC = "N10 G90 G54 T2 S1000 M3\nN20 G0 X{0} Y10 Z5\nN30 G83 X{0} Y10 Z-12 R2 K4 F120\nN40 X{1} Y10\nN50 G80\nN60 G0 Z50\n"
HOLES_TNC = """0 BEGIN PGM A MM
1 TOOL CALL 2 Z S1000
2 L Z+100 R0 FMAX M3
3 CYCL DEF 200 DRILLING Q200=2 Q201=-20 Q206=150 Q202=5 Q210=0 Q203=+7 Q204=20 Q211=0 Q395=0
4 L X+{0} Y+10 R0 FMAX M99
5 L X+{1} Y+10 R0 FMAX M99
6 L Z+100 R0 FMAX M30
7 END PGM A MM
"""


def alarm_of(act):
    with pytest.raises(mnc.Alarm) as raised:
        act()
    return raised.value


@pytest.fixture(scope="module")
def compared():
    return mnc.compare(AREA, mnc.Tool(diameter=8), "rings", "zigzag", machine="small-mill")


def test_strategies_by_their_names(compared):
    assert [trial.name for trial in compared.trials] == ["rings", "zigzag"]
    same = mnc.compare(AREA, 4.0, ["rings", "zigzag"], limits=compared["rings"].limits)
    assert [trial.time for trial in same.trials] == [trial.time for trial in compared.trials]
    assert compared["rings"].limits == mnc.Setup(limits="small-mill").limits
    assert "spiral" in alarm_of(lambda: mnc.compare(AREA, 4.0, "rings", "spirl")).hint


def test_the_best_by_a_column(compared):
    for column in ("time", "length", "most"):
        values = compared.columns()[column]
        assert compared.best(column).row[column] == values.min()
    assert compared.best("covered, %").row["covered"] == compared.columns()["covered"].max()
    assert "time" in alarm_of(lambda: compared.best("tim")).hint


def test_a_comparison_is_saved(compared, tmp_path):
    rows = list(csv.reader(compared.save(tmp_path / "t.csv").open(encoding="utf-8")))
    assert rows[0][:2] == ["strategy", "cutting length, mm"]
    assert [row[0] for row in rows[1:]] == ["rings", "zigzag"]
    assert float(rows[1][1]) == pytest.approx(compared["rings"].length(rapid=False), abs=0.5)
    assert "<svg" in compared.save(tmp_path / "t.svg").read_text(encoding="utf-8")
    assert ".svg" in alarm_of(lambda: compared.save(tmp_path / "t.xls")).hint
    assert "files have no options" in alarm_of(lambda: compared.save(tmp_path / "t.csv", size=(5, 5))).message


def test_one_trial_is_saved_as_a_comparison_is(compared, tmp_path):
    schemes = mnc.compare_turning(mnc.area.Contour([(0, 20), (-40, 20), (-50, 30)], closed=False), 30, schemes=["loop"])
    for trial in (compared[0], schemes[0]):
        png = trial.save(tmp_path / "t.png", size="slide").read_bytes()
        assert int.from_bytes(png[16:20], "big") == pytest.approx(13.33 * 200, abs=1)
        assert "no option of" in alarm_of(lambda trial=trial: trial.save(tmp_path / "t.png", of="part")).message


def test_a_table_without_a_picture_refuses_a_size(tmp_path):
    holes = mnc.run("T1 S500 M3\nG0 X0 Y0 Z5\n", "mnc").holes()
    assert "have no options, got size" in alarm_of(lambda: holes.save(tmp_path / "t.csv", size="slide")).message
    assert ".csv" in alarm_of(lambda: holes.save(tmp_path / "t.png", size="slide")).message


def test_schemes_on_a_machine_by_its_name():
    profile = mnc.area.Contour([(0, 20), (-40, 20), (-50, 30)], closed=False)
    found = mnc.compare_turning(profile, 30, schemes=["loop"], machine="old-lathe")
    assert found.trials[0].limits == mnc.Setup(limits="old-lathe").limits


# --- holes -----------------------------------------------------------------------------------------------------------


def test_the_holes_of_a_run():
    found = mnc.run(HOLES_MNC.format(20, 60), "mnc").holes()
    assert [(row.x, row.y, row.top, row.bottom, row.diameter, row.tool) for row in found] == [
        (20, 10, 2, -12, 8, 2), (60, 10, 2, -12, 8, 2),
    ]  # fmt: skip
    assert [row.lines for row in found] == [(3,), (4,)]
    assert "diameter, mm" in repr(found) and "<table" in found._repr_html_()
    assert found.columns()["x"].tolist() == [20, 60]
    assert len(found.csv().splitlines()) == 3


def test_a_plunge_into_a_pocket_is_no_hole_and_a_second_tool_is_a_second_row():
    text = "G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5\nG1 Z-2 F100\nX40\nG0 Z5\nX60\nG1 Z-3\nG0 Z5\nT2\nG1 Z-9\nG0 Z5\n"
    found = mnc.run(text, "mnc").holes()
    assert [(row.x, row.tool, row.bottom) for row in found] == [(60, 1, -3), (60, 2, -9)]


def test_holes_are_the_same_whatever_their_order_heights_and_control():
    one, other = mnc.run(HOLES_MNC.format(20, 60), "mnc"), mnc.run(HOLES_TNC.format(60, 20), "tnc-620")
    found = mnc.diff(one, other, what="holes")
    assert found.same and len(found.both) == 2
    assert "the same 2 holes" in repr(found)
    assert mnc.diff(one, other).largest > 1


@pytest.mark.parametrize(("shift", "same"), [(0.0, True), (0.0009, True), (0.0011, False), (5.0, False)])
def test_holes_elsewhere_differ(shift, same):
    one, other = (mnc.run(HOLES_MNC.format(20, 60 + by), "mnc") for by in (0, shift))
    found = mnc.diff(one, other, what="holes")
    assert found.same is same
    assert [len(rows) for rows in found.only] == ([0, 0] if same else [1, 1])
    if not same:
        assert found.only[1][0, 0] == pytest.approx(60 + shift)
        assert "only in" in repr(found) and "only in" in found._repr_html_()
    assert found.plot().alt.startswith("holes:")
    assert mnc.diff(one, other, what="holes", tolerance=6).same


def test_diameters_count_and_wrong_words_are_named():
    one, other = (mnc.run(HOLES_MNC.format(20, 60), "mnc", tools={2: mnc.Tool(diameter=d)}) for d in (8, 6.6))
    assert not mnc.diff(one, other, what="holes").same
    assert "path or holes" in alarm_of(lambda: mnc.diff(one, other, what="hole")).message
    assert mnc.diff(mnc.run("G0 X1\n", "mnc"), mnc.run("G0 X1\n", "mnc"), what="holes").sentence == "no holes in either"


def test_as_many_holes_as_a_grid_has_in_any_order():
    random = np.random.default_rng(5)
    spots = [(x, y) for x in range(0, 200, 10) for y in range(0, 100, 10)]
    runs = []
    for _ in range(2):
        random.shuffle(spots)
        drill = "".join(f"G0 X{x} Y{y}\nG1 Z-{random.integers(1, 9)}\nG0 Z5\n" for x, y in spots)
        runs.append(mnc.run(f"G90 G54 T2 S900 M3 F100\nG0 Z5\n{drill}", "mnc"))
    assert len(runs[0].holes()) == 200
    assert mnc.diff(*runs, what="holes").same


# --- the largest radius ----------------------------------------------------------------------------------------------

#: The inside of a box 40 x 30 with corners of radius `r`, entered from the middle of its lower side.
BOX = """G17 G90 G54 T1 S900 M3
G0 X20 Y15 Z5
G1 Z-2 F100
G41 X20 Y0
X{b}
G3 X40 Y{r} R{r}
G1 Y{c}
G3 X{b} Y30 R{r}
G1 X{r}
G3 X0 Y{c} R{r}
G1 Y{r}
G3 X{r} Y0 R{r}
G1 X20
G40 X20 Y15
"""


@pytest.mark.parametrize("radius", [3, 6, 10])
def test_the_largest_radius_is_below_that_of_the_corners(radius):
    text = BOX.format(r=radius, b=40 - radius, c=30 - radius)
    found = mnc.run(text, "mnc", tools={1: mnc.Tool(radius=1)}).largest_radius()
    assert found.radius == pytest.approx(radius, abs=1e-9)
    assert str(found).startswith(f"below {radius} mm") == found.below
    fits = [mnc.run(text, "mnc", tools={1: mnc.Tool(radius=each)}).ok for each in (radius - 1e-6, radius, radius + 1e-6)]
    assert fits == [True, not found.below, False]
    failed = mnc.run(text, "mnc", tools={1: mnc.Tool(radius=14)})
    assert not failed.ok and failed.largest_radius() == found


def test_the_way_to_the_contour_is_as_long_as_the_radius_at_least():
    straight = "G17 G90 G54 T1 S900 M3\nG0 X0 Y-90\nG1 G41 X0 Y0 F100\nY30\nY60\nG40 Y150\n"
    assert str(mnc.run(straight, "mnc").largest_radius()) == "90 mm (lines 3 and 4)"  # MNC manual: the approach is Y-90 to Y0


def test_the_largest_radius_of_an_inch_program_is_told_in_inches():
    """A slot of a quarter of an inch has room for an eighth; the number itself stays mm."""
    text = "G20 G17 G90 G54\nT1 M6\nS800 M3\nG0 X-2 Y-2\nG1 G41 D1 X0 Y0 F20\nY3\nX1\nY2\nX1.25\nY3\nX4\nY0\nX0\nG40 X-2 Y-2\n"
    found = mnc.run(text, "g43", tools={1: mnc.Tool(radius=1)}).largest_radius()
    assert str(found).startswith("0.125 in (lines ") and float(found) == pytest.approx(25.4 / 8)


def test_nothing_is_said_of_what_a_stopped_run_did_not_reach(tmp_path):
    """The contour and the measuring cycle stand below the fault: their verdicts name how far is known."""
    run = mnc.run("T1\nS900 M3\nG0 X\nG41 X0 Y0\nX50\nG40 X60 Y20\n", "mnc", tools={1: mnc.Tool(radius=1)})
    said = alarm_of(run.largest_radius).message
    assert "nothing is compensated up to line 3" in said and "any radius" not in said
    assert "up to line 3, where" in alarm_of(lambda: run.measuring_sheet(tmp_path / "sheet.html")).message
    assert "up to line 3, where" in alarm_of(run.plot_measured).message


def test_where_nothing_is_compensated():
    assert "nothing is compensated" in alarm_of(lambda: mnc.run("G0 X1\n", "mnc").largest_radius()).message
    assert "not known on jnc-t01" in alarm_of(lambda: mnc.run("N1 G0 X1 Z1\n", "jnc-t01").largest_radius()).message


# --- profiles --------------------------------------------------------------------------------------------------------


def test_profiles_of_machines_in_one_figure():
    run = mnc.run(HOLES_MNC.format(20, 60), "mnc")
    slow, fast = run.profile("hobby-router"), run.profile("fast-mill")
    picture = mnc.plot_profiles(slow, fast)
    assert [ax.get_xlim() for ax in picture.axes] == [(0, pytest.approx(max(slow.time, fast.time)))] * 2
    assert len({ax.get_ylim() for ax in picture.axes}) == 1
    texts = [text.get_text() for ax in picture.axes for text in ax.texts]
    assert texts == [f"program on hobby-router: {slow.time:.2f} s", f"program on fast-mill: {fast.time:.2f} s"]
    assert "hobby-router" in picture.alt
    for wrong in (lambda: mnc.plot_profiles(5), lambda: mnc.plot_profiles([]), lambda: mnc.plot_profiles(slow, names=["a", "b"])):
        alarm_of(wrong)
    assert len(mnc.plot_profiles(run, slow, names=["a", "b"], over="path").axes) == len(mnc.plot_profiles([run, slow]).axes) == 2


def test_a_tool_change_is_lost_time():
    profile = mnc.run("G90 G54 S1000 M3\nG0 X0 Z5\nT2\nG1 X40 F100\n", "mnc").profile("small-mill")
    change = mnc.Setup(limits="small-mill").limits.tool_change
    ax = profile.plot_lost().axes[0]
    labels = [label.get_text().split()[-1] for label in ax.get_yticklabels()]
    lost = next(bars for bars in ax.containers if bars.get_label() == "lost")
    assert lost[labels.index("T2")].get_width() == pytest.approx(change)


# --- folders ---------------------------------------------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path):
    jobs = tmp_path / "jobs"
    jobs.mkdir()
    jobs.joinpath("good.mnc").write_text(HOLES_MNC.format(20, 60))
    jobs.joinpath("stopped.mnc").write_text("N10 G0 X10\nN20 G999\nN30 G0 X20\n")
    return jobs


def test_the_times_of_a_folder(folder, capsys):
    out = folder.parent / "out.csv"
    assert main(["time", str(folder), "--machine", "small-mill", "--csv", str(out)]) == 1
    good, stopped = csv.DictReader(out.open(encoding="utf-8"))
    assert (good["complete"], stopped["complete"]) == ("yes", "no")
    expected = mnc.run(folder / "good.mnc").profile("small-mill").time
    assert float(good["time, s"]) == pytest.approx(expected, abs=0.001)
    assert stopped["stopped in line"] == "2" and "G999" in stopped["why"]
    assert "2 programs, 1 complete" in capsys.readouterr().err


def test_the_times_as_a_table_and_as_json(folder, capsys):
    assert main(["time", str(folder), "--limits", "small-mill"]) == 1
    assert "2 programs, 1 complete" in capsys.readouterr().out
    assert main(["time", str(folder / "good.mnc"), str(folder / "good.mnc"), "--json"]) == 0
    assert [row["complete"] for row in json.loads(capsys.readouterr().out)] == [True]


def test_a_program_that_stopped_is_marked(folder, capsys):
    assert main(["time", str(folder / "stopped.mnc")]) == 1
    assert "not complete: the program stopped in line 2" in capsys.readouterr().out
    assert main(["time", str(folder / "stopped.mnc"), "--json"]) == 1
    assert json.loads(capsys.readouterr().out)["complete"] is False


def test_what_a_folder_does_not_take(folder, capsys):
    with pytest.raises(SystemExit):
        main(["time", str(folder), "--start-at", "3"])
    assert "for one program" in capsys.readouterr().err


def test_the_table_and_the_picture_have_the_same_holes():
    """A plunge with an end mill straight down and out again is a hole 10 wide, one that goes on along X is none, and neither is
    a way of a probe; a drilled hole is 8 wide. That is so in the table, in the picture and in what is compared."""
    text = (
        "G90 G54 T1 S1000 M3\nG0 X10 Y10 Z5\nG1 Z-5 F100\nG0 Z5\nX30\nG1 Z-5\nX40\nG0 Z5\n"
        "T2\nX60\nG1 Z-9\nG0 Z5\nT3\nX70\nG1 Z-2\nG0 Z5\n"
    )
    tools = {1: mnc.Tool(diameter=10), 2: mnc.Tool(diameter=8, kind="drill"), 3: mnc.Tool(diameter=4, kind="probe")}
    run = mnc.run(text, "mnc", tools=tools)
    expected = [(10, 10, 10, -5), (60, 10, 8, -9)]
    assert [(row.x, row.y, row.diameter, row.bottom) for row in run.holes()] == expected
    drawn = holes_of(run).holes
    assert [(hole.x, hole.y, 2 * hole.radius, hole.tip) for hole in drawn] == expected
    assert mnc.diff(run, run, what="holes").both.tolist() == [[10, 10, 10], [60, 10, 8]]
    stock = ((0, 0, -20), (80, 20, 0))
    named = [(hole.x, hole.y, hole.diameter) for hole in run.design(stock=stock).features if isinstance(hole, mnc.design.Hole)]
    assert sorted(named) == [(10, 10, 10), (60, 10, 8)]


@pytest.mark.parametrize(("place", "bottom", "cuts"), [
    ((30, 20), -5, True), ((30, 20), 0, False), ((30, 20), 2, False),
    ((-5, 20), -5, False), ((-4, 20), -5, False), ((-3.9, 20), -5, True),  # a mill of 8 mm beside X0
])  # fmt: skip
def test_what_goes_down_above_or_beside_the_blank_is_no_hole(place, bottom, cuts):
    text = f"G90 G54 T1 S1000 M3\nG0 X{place[0]} Y{place[1]} Z5\nG1 Z{bottom} F100\nG0 Z5\n"
    setup = mnc.Setup(tools={1: mnc.Tool(diameter=8, kind="mill")})
    blank = mnc.Setup(tools=setup.tools, stock=((0, 0, -20), (60, 40, 0)))
    assert len(mnc.run(text, "mnc", setup).holes()) == 1
    assert len(mnc.run(text, "mnc", blank).holes()) == cuts


def test_a_point_cuts_where_its_cone_comes_below_the_top():
    """3 mm beside the blank a point of 90 degrees is 3 mm higher than its tip: down to -2.5 it cuts nothing, to -3.5 it does."""
    for bottom, cuts in ((-2.5, 0), (-3.5, 1)):
        text = f"G90 G54 T1 S1000 M3\nG0 X-3 Y20 Z5\nG1 Z{bottom} F100\nG0 Z5\n"
        setup = mnc.Setup(tools={1: mnc.Tool(diameter=8, kind="drill", angle=90)}, stock=((0, 0, -20), (60, 40, 0)))
        assert len(mnc.run(text, "mnc", setup).holes()) == cuts


def test_a_drill_in_the_bore_of_a_tube_makes_no_hole():
    text = "G94 S500 M3 T1\nG0 X0 Z2\nG1 Z-20 F100\nG0 Z2\n"
    tube = mnc.blank.Revolved(((20, -60), (20, 0)), bore=6)
    for diameter, cuts in ((10, 0), (14, 1)):
        setup = mnc.Setup(tools={1: mnc.Tool(diameter=diameter, kind="drill")}, stock=tube, start=(60, 0, 40))
        assert len(mnc.run(text, "jnc-t01", setup).holes()) == cuts


def test_a_bore_of_a_cycle_is_a_hole_of_both():
    """Cycle 208 with a mill of 10 mm bores 16 mm wide: Q335 is the diameter, Q201 the depth."""
    text = (
        "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000\n2 M3\n3 CYCL DEF 208 Q200=2 Q206=200 Q201=-12 Q334=2 Q203=0 Q204=20 Q335=16 "
        "Q342=0 Q351=1\n4 L X+30 Y+20 R0 FMAX M99\n5 END PGM A MM\n"
    )
    run = mnc.run(text, "tnc-620", tools={1: mnc.Tool(diameter=10, length=80)})
    assert run.ok
    (hole,) = run.holes()
    assert (hole.x, hole.y, hole.bottom) == (30, 20, -12) and hole.diameter == pytest.approx(16)
    (drawn,) = holes_of(run).holes
    assert (drawn.x, drawn.y, drawn.tip) == (30, 20, -12) and 2 * drawn.radius == pytest.approx(16)


def test_a_turning_pass_is_no_hole():
    """X is a diameter: the pass at 40 cuts outside, the one on the axis drills."""
    text = "G94 S500 M3\nG0 X40 Z2\nG1 Z-10 F100\nG0 Z2\nX0\nG1 Z-20\nG0 Z2\n"
    run = mnc.run(text, "jnc-t01")
    path = run.toolpath
    assert path.lathe
    assert [(row.x, row.bottom) for row in run.holes()] == [(0, -20)]


# --- two paths in a picture --------------------------------------------------------------------------------------------

ONE = "G90 G54 T1 S1000 M3\nG0 X10 Y10 Z5\nG1 Z-5 F100\nX50\nG0 Z5\nX10 Y30\n"


def test_rapids_are_dashed_where_two_paths_are_laid_over_one_another():
    """By the text: at Z-5 the tool cuts, it comes and leaves at rapid. No line that is drawn through holds a place of a rapid."""
    picture = mnc.diff(mnc.run(ONE, "mnc"), mnc.run(ONE.replace("X50", "X50 Y12"), "mnc")).plot(view="XZ")
    lines = [line for line in picture.axes[0].lines if len(line.get_xdata()) > 2 or line.get_linestyle() == "--"]
    through = [line for line in lines if line.get_linestyle() == "-"]
    dashed = [line for line in lines if line.get_linestyle() == "--"]
    assert len(through) == len(dashed) == 2
    for line in through:
        x, z = (np.asarray(column) for column in line.get_data())
        assert {tuple(each) for each in np.column_stack([x, z])[np.isfinite(x)].tolist()} == {(10, 5), (10, -5), (50, -5)}
    for line in dashed:
        x, z = line.get_data()
        assert {(50, 5), (10, 5)} <= set(zip(np.asarray(x).tolist(), np.asarray(z).tolist()))
    assert "rapid" in [text.get_text() for text in picture.legends[0].get_texts()]


@pytest.mark.parametrize("size", ["column", "a4", None])
def test_no_caption_loses_its_end(size):
    """A caption that does not fit into a line goes on in the next one: it ends with what its sentence ends with, the unit."""
    part = mnc.run(ONE, "mnc", stock=((0, 0, -12), (60, 40, 0))).workpiece()
    found = part.compare(mnc.Design(((0, 0, -12), (60, 40, 0))))
    for picture, end in ((part.plot(size=size), "removed"), (found.plot(size=size), "mm³")):
        said = [text.get_text() for text in picture.texts]
        assert any(text.endswith(end) for text in said) and not any("…" in text for text in said)
        right = picture.get_window_extent().x1
        assert all(text.get_window_extent().x1 <= right for text in picture.texts)


@pytest.mark.parametrize("kind", ["mill", "drill", "tap"])
@pytest.mark.parametrize(
    "tail",
    ["", "G0 Z5", "G0 Z-2", "M30", "T2 S500\nG0 Z5", "T2 S500\nG0 X0 Z5\nG1 X60", "G1 Z-8\nG1 Z-9", "G1 X40\nG0 Z5"],
)
def test_a_plunge_is_one_hole_for_the_table_the_picture_and_the_design(kind, tail):
    """Straight down and nowhere else with this tool leaves a round hole, whether it comes out again or not."""
    text = f"T1 S500 M3\nG0 X30 Y20 Z5\nG1 Z-5 F100\n{tail}\n"
    tools = {n: mnc.Tool(radius=3, kind=kind) for n in (1, 2)}
    run = mnc.run(text, "mnc", mnc.Setup(tools=tools, stock=((0, 0, -20), (60, 40, 0))))
    bottom = {"G1 Z-8\nG1 Z-9": -9.0, "G1 X40\nG0 Z5": None}.get(tail, -5.0)
    wanted = [] if bottom is None else [(30.0, 20.0, 6.0, bottom)]
    assert [(row.x, row.y, row.diameter, row.bottom) for row in run.holes()] == wanted
    drawn = holes_of(run)
    assert [(hole.x, hole.y, 2 * hole.radius, hole.tip) for hole in (drawn.holes if drawn else ())] == wanted
    if kind == "mill":
        made = [each for each in run.design().features if each.kind == "hole"]
        assert [(each.x, each.y, each.diameter, -each.depth) for each in made] == wanted


def test_a_radius_that_a_cycle_refuses_is_no_stop_of_the_run():
    """The slot of the contour is 12 mm wide: radius 6. The pocket of 30 by 20 mm behind it takes no mill of radius 16, 32 …"""
    contour = "G41 X0 Y0\nY40\nX8\nY20\nX20\nY40\nX40\nY0\nX-10\nG40 X-20 Y-20\nG0 Z50\n"
    pocket = "X60 Y60\nG343 Q2 A30 B20 H-5 P2.5 Z0 K1 F200 V100\n"
    run = mnc.run(f"G54 G17 G90 T1 S1000 M3\nG0 X-20 Y-20 Z5\nG1 Z-2 F200\n{contour}{pocket}", "mnc")
    assert run.ok
    found = run.largest_radius()
    assert float(found) == 6 and "where the run stopped" not in str(found)


@pytest.mark.parametrize("begin", ["G0 X0 Y0 Z2", "G0 X0 Y0 Z50\nX5\nX0 Z2"])
def test_the_way_from_home_stays_in_its_frame(begin):
    """It leads to the place where the program begins, 1 mm below the upper edge, or 50 mm above it: the names stay free."""
    text = f"T1 S1000 M3\n{begin}\nG1 Z-2 F100\nX10\nG0 Z50\n"
    one = mnc.run(text, "mnc", mnc.Setup(stock=((-5, -5, -5), (15, 5, 0))))
    picture = mnc.plot_runs({"one": one, "other": one}, view="XZ", legend=False)
    picture.draw(picture.canvas.get_renderer())
    red, green, blue, _ = np.moveaxis(np.asarray(picture.canvas.buffer_rgba()).astype(int), 2, 0)
    rows, _ = np.nonzero((red > 150) & (green < 90) & (blue < 90))
    assert len(rows) and picture.bbox.height - rows.min() < picture.axes[0].bbox.y1 + 1


def test_rapids_on_one_line_are_drawn_once_over_another_program():
    """Down 18 mm at X0 and Y0, a cut, up 23 on the same line at its end; there and back in dashes would be a solid line."""
    text = "G17 G90 G54 T1 S800 M3\nG0 X0 Y0 Z20\nZ2\nG1 Z-3 F200\nX40\nX0\nG0 Z20\nX9\nX0\n"
    one, other = (mnc.run(each, "mnc") for each in (text, text.replace("X40", "X41")))
    *_, side = mnc.diff(one, other).plot(view="XZ").axes
    (line,) = [each for each in side.lines if each.get_label() == "rapid"]
    ends = np.array(line.get_xydata())
    ways = [np.ptp(ends[k : k + 2], axis=0) for k in range(len(ends) - 1) if np.isfinite(ends[k : k + 2]).all()]
    assert np.sum(ways, axis=0) == pytest.approx((9, 23))

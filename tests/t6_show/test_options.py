"""What a stranger gives as an option of a figure: refused by an alarm that names the option, never another error."""

import re

import numpy as np
import pytest

import mnclab as mnc

TEXT = "T1 S1000 M3\nG0 X0 Y0 Z5\nG1 Z-2 F100\nX60\nG0 Z5\n"


@pytest.fixture(scope="module")
def run():
    return mnc.run(TEXT, "mnc", stock=(70, 40, 10))


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"legend": np.array([1.0, 2.0])}, "legend must be True or False"),
        ({"marks": 0.5}, "marks must be True or False, got 0.5"),
        ({"limits": "small-mill"}, "limits must be two corners of a picture, got 'small-mill'"),
        ({"rapids": 5}, "limits must be Limits or the name of a machine, got 5"),
        ({"under": 5}, "under must be a toolpath, got 5"),
        ({"overlays": [5]}, "overlays must be overlays, got [5]"),
        ({"alarms": "none"}, "alarms must be alarms, got 'none'"),
        ({"tools": [mnc.Tool(radius=2)]}, "tools must be a dict"),
        ({"stock": (70, 40, 10)}, "stock must be True or False, got (70, 40, 10)"),
        ({"run": 5}, "this figure has no option run"),
    ],
)
def test_an_option_of_another_kind_is_refused_by_name(run, options, said):
    with pytest.raises(mnc.Alarm, match=re.escape(said)):
        run.plot(**options)


@pytest.mark.parametrize("width", [0, -1, 1e300, "x"])
def test_a_figure_without_a_width_is_refused(run, width):
    with pytest.raises(mnc.Alarm, match="the width of a picture"):
        run.profile().plot_lost(width=width)


@pytest.mark.parametrize("columns", [-1, 1.5, "two"])
def test_columns_are_counted(columns):
    region = mnc.area.Region.of(mnc.area.rectangle(30, 20))
    with pytest.raises(mnc.Alarm, match="columns must be"):
        mnc.compare(region, mnc.Tool(radius=3), "rings").plot(columns=columns)


@pytest.mark.parametrize("discs", [None, "all", [1.5], 1e-9, np.nan])
def test_discs_are_lines_or_a_distance_that_can_be_drawn(run, discs):
    with pytest.raises(mnc.Alarm, match="disc"):
        run.plot_compensation(discs=discs)


def test_discs_of_a_program_without_compensation_are_none(run):
    assert run.plot_compensation(discs=2.5).png()[:4] == b"\x89PNG"


def test_every_figure_that_compares_has_the_sizes_of_a_report(run):
    profile = run.profile("small-mill")
    for draw in (
        lambda **size: mnc.plot_profiles(profile, run, **size),
        lambda **size: mnc.diff(run, run).plot(**size),
        lambda **size: mnc.diff(run, run, what="holes").plot(**size),
    ):
        assert draw(size_mm=(85, None), legend=False).get_figwidth() == pytest.approx(85 / 25.4)
        with pytest.raises(mnc.Alarm, match="this figure has no option widht"):
            draw(widht=3)


def test_a_machine_is_meant_by_its_name_wherever_limits_are(run, tmp_path):
    slow = run.profile("small-mill")
    assert mnc.Profile(run.toolpath, "small-mill").limits == slow.limits == run.profile().again("small-mill").limits
    assert mnc.machines()["small-mill"].limits == slow.limits == run.profile(mnc.machines()["small-mill"]).limits
    page = run.report(tmp_path / "a.html", limits="small-mill").read_text()
    assert page == run.report(tmp_path / "a.html", machine="small-mill").read_text()
    for wrong in (lambda: mnc.Profile(run.toolpath, 5), lambda: mnc.Profile(5), lambda: slow.at("x"), lambda: slow.again("smal")):
        with pytest.raises(mnc.Alarm):
            wrong()


def test_a_letter_that_no_font_has_is_no_error(run, tmp_path):
    assert run.setup_sheet(tmp_path / "a.pdf", title="a\0b\x07\udc80").read_bytes()[:4] == b"%PDF"


def test_options_of_a_drawing_are_those_of_its_plot():
    """Its sizes are those of paper: a column of a page is none of them."""
    drawn = mnc.Design(((0, 0, -10), (40, 30, 0))).plot()
    with pytest.raises(mnc.Alarm, match="no option size") as refused:
        drawn.save("a.pdf", size="column")
    assert ".plot that draws it" in refused.value.hint and "column" not in refused.value.hint

"""Figures in the sizes of a report: what the files measure is read out of them, letters are counted in points."""

import re

import pytest
from matplotlib.text import Text

import mnclab as mnc

PROGRAM = "G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5\nG1 Z-2 F100\nX60\nG41 Y30\nX0\nY0\nG0 Z5\n"
BLANK = mnc.Setup(stock=((-10, -10, -10), (70, 40, 0)))
INCH = 25.4
FIGURES = {
    "run": lambda run, **options: run.plot(**options),
    "profile": lambda run, **options: run.profile().plot(**options),
    "reached": lambda run, **options: run.profile().plot_reached(**options),
    "lost": lambda run, **options: run.profile().plot_lost(**options),
    "compensation": lambda run, **options: run.plot_compensation(**options),
    "part": lambda run, **options: run.workpiece().plot(**options),
    "removal": lambda run, **options: run.removal().plot(**options),
}


@pytest.fixture(scope="module")
def run():
    return mnc.run(PROGRAM, "mnc", BLANK)


def letters(figure):
    return [float(text.get_fontsize()) for text in figure.findobj(Text) if text.get_text().strip()]


@pytest.mark.parametrize("name", FIGURES)
@pytest.mark.parametrize(
    ("size", "wide", "tall", "least"), [("a4", 170, None, 7), ("column", 85, None, 6), ("slide", 13.33 * INCH, 7.5 * INCH, 10)]
)
def test_a_named_size_is_met_exactly_with_readable_letters(run, name, size, wide, tall, least):
    figure = FIGURES[name](run, size=size)
    width, height = figure.get_size_inches() * INCH
    assert width == pytest.approx(wide)
    assert tall is None or height == pytest.approx(tall)
    assert min(letters(figure)) >= least
    for ax in figure.axes:  # and nothing stands outside
        box = ax.get_tightbbox(figure.canvas.get_renderer())
        assert box.x0 >= -1 and box.x1 <= figure.bbox.x1 + 1 and box.y0 >= -1 and box.y1 <= figure.bbox.y1 + 1


@pytest.mark.parametrize("wide", [60, 85, 120.5])
def test_a_file_has_exactly_its_width(run, tmp_path, wide):
    pdf = run.save(tmp_path / "a.pdf", size_mm=(wide, None), legend=False).read_bytes()
    (box,) = re.findall(rb"/MediaBox \[\s*0 0 ([\d.]+) ([\d.]+)\s*\]", pdf)
    assert float(box[0]) == pytest.approx(wide / INCH * 72, abs=0.01)
    svg = run.save(tmp_path / "a.svg", size_mm=(wide, 70)).read_text()
    assert float(re.search(r'width="([\d.]+)pt"', svg)[1]) == pytest.approx(wide / INCH * 72, abs=0.01)
    assert float(re.search(r'height="([\d.]+)pt"', svg)[1]) == pytest.approx(70 / INCH * 72, abs=0.01)


def test_without_a_legend_there_is_none_and_no_room_for_it(run):
    with_it, without = run.plot(size="column"), run.plot(size="column", legend=False)
    assert with_it.legends and not without.legends
    assert without.get_figheight() < with_it.get_figheight() - 0.15


@pytest.mark.parametrize("name", ["run", "compensation", "profile", "part"])
@pytest.mark.parametrize("size", [(3.3, 3.0), (3.3, 2.0), "column"])
def test_a_legend_takes_a_fifth_of_a_small_figure_at_most(run, name, size):
    figure = FIGURES[name](run, size=size)
    figure.canvas.draw()
    boxes = [legend.get_window_extent() for legend in figure.legends]
    tall = max(box.y1 for box in boxes) - min(box.y0 for box in boxes)
    assert tall <= max(0.2 * figure.bbox.height, 0.23 * figure.dpi)  # one row at least


def test_what_the_legend_leaves_out_is_told_in_words(run):
    assert "not in the legend: " in run.plot(size=(3.3, 1.8)).alt


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"sise": "a4"}, "this figure has no option sise (near: size)"),
        ({"size": "colum"}, "size must be a4, column or slide, got 'colum' (near: column)"),
        ({"size": 7}, "size must be a4, column, slide or (width, height) in inches, got 7"),
        ({"size_mm": (85,)}, "size_mm must be (width, height) in mm, got (85,)"),
        ({"size_mm": (85, "x")}, "the height of a figure (mm) must be a number, got 'x'"),
        ({"size_mm": (8, None)}, "the width of a figure (mm) must be at least 40, got 8"),
        ({"size": "a4", "size_mm": (85, None)}, "a figure has size or size_mm, not both"),
        ({"legend": "no"}, "legend must be True or False, got 'no'"),
    ],
)
@pytest.mark.parametrize("name", FIGURES)
def test_an_option_that_is_none_is_refused_by_name(run, name, options, said):
    with pytest.raises(mnc.Alarm, match=re.escape(said)):
        FIGURES[name](run, **options)

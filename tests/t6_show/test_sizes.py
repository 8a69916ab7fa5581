"""Figures in the sizes of a report: what the files measure is read out of them, letters are counted in points."""

import re

import numpy as np
import pytest
from matplotlib.quiver import Quiver
from matplotlib.text import Annotation, Text

import mnclab as mnc
from mnclab.show.plot.picture import broken

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


def width_of(path):
    (box,) = re.findall(rb"/MediaBox \[\s*0 0 ([\d.]+) ([\d.]+)\s*\]", path.read_bytes())
    return float(box[0]) / 72 * INCH


def results(run):
    """What has a picture that is saved, each with another option of its picture."""
    region = mnc.area.Region.of(mnc.area.rectangle(30, 20))
    shoulder = mnc.area.Contour([(0, 20), (-40, 20), (-50, 30)], closed=False)
    yield from ((run, {"view": "XY"}), (run.toolpath, {"view": "XY"}), (run.profile(), {"over": "path"}), (run.removal(), {}))
    yield from ((run.plot_compensation(), {"vectors": False}), (run.plot(), {"arrows": False}), (run.workpiece(), {}))
    yield from ((mnc.compare(region, 3.0, "rings"), {"kind": "engagement"}), (mnc.compare_turning(shoulder, 30), {"columns": 1}))
    yield from ((mnc.tool_sets(region, (2, 3), "rings"), {}), (mnc.diff(run, run), {"view": "XY"}))
    yield from ((mnc.diff(run, run, what="holes"), {}), (run.workpiece().compare(mnc.Design(((-10, -10, -10), (70, 40, 0)))), {}))


def test_whatever_has_a_picture_is_saved_in_the_size_of_a_report(run, tmp_path):
    for what, more in results(run):
        assert width_of(what.save(tmp_path / "a.pdf", size="column", **more)) == pytest.approx(85, abs=0.01), what
        assert what.save(tmp_path / "a.png").stat().st_size > 1000
        with pytest.raises(mnc.Alarm, match="this figure has no option sise"):
            what.save(tmp_path / "a.pdf", sise="column")
        with pytest.raises(mnc.Alarm, match="size must be a4, column or slide, got 'colum'"):
            what.save(tmp_path / "a.pdf", size="colum")
        with pytest.raises(mnc.Alarm):
            what.save(tmp_path / "a.xyz")


def test_a_picture_is_drawn_anew_with_what_it_was_asked_for(run, tmp_path):
    small = run.profile().plot(over="path", size_mm=(60, None), legend=False)
    assert small.again(size="a4").axes[-1].get_xlabel() == "path, mm" and not small.again(size="a4").legends
    assert small.again(legend=True).get_figwidth() * INCH == pytest.approx(60) and small.again(legend=True).legends


def test_what_is_on_a_shelf_takes_a_size_too():
    steps = mnc.area.Contour([(0, 20), (-40, 20), (-50, 30)], closed=False)
    threads = mnc.schemes.plot_threads({"flank": [0.0]}, [1.0], size="column")
    for figure in (mnc.schemes.plot_zones(steps, 30, size="column"), threads):
        assert figure.get_figwidth() * INCH == pytest.approx(85)
    with pytest.raises(mnc.Alarm, match="size must be a4, column or slide, got 'colum'"):
        mnc.schemes.plot_zones(steps, 30, size="colum")
    with pytest.raises(mnc.Alarm, match="this figure has no option sise"):
        mnc.schemes.plot_zones(steps, 30, sise="column")


@pytest.mark.parametrize("wide", [60, 85, 120.5])
def test_a_file_has_exactly_its_width(run, tmp_path, wide):
    assert width_of(run.save(tmp_path / "a.pdf", size_mm=(wide, None), legend=False)) == pytest.approx(wide, abs=0.01)
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


def heads(figure):
    """Sizes of what points: arrows of dimensions (width of the line, of the head), arrows of vectors (width of the shaft)."""
    found = [each.arrow_patch for each in figure.findobj(Annotation) if each.arrow_patch]
    figure.draw_without_rendering()
    return [(each.get_linewidth(), each.get_mutation_scale()) for each in found] + [each.width for each in figure.findobj(Quiver)]


@pytest.mark.parametrize("draw", ["plot_compensation", "plot_lengths", "plot_measured"])
def test_arrows_grow_with_the_letters(run, draw):
    """In any two sizes of one figure heads and lines of arrows are to each other as its letters are."""
    if draw == "plot_lengths":
        run = mnc.run("T1 M6\nS800 M3\nG43 H1 G0 Z30\nG1 Z5 F100\n", "g43", mnc.Setup(tools={1: mnc.Tool(5, 40)}))
    if draw == "plot_measured":
        part = mnc.part.box((0, 0, -20), (100, 60, 0)) - mnc.part.hole((50, 30, 0), 24, 10)
        setup = mnc.Setup(part=part, tools={7: mnc.Tool(radius=2, kind="probe")})
        run = mnc.run("N10 T7\nN20 G0 X50 Y30 Z20\nN40 G421 X50 Y30 D24 Z-5 H20\n", "mnc", setup)
    lines = (3,) if draw == "plot_lengths" else ()
    one, other = (getattr(run, draw)(*lines, size_mm=(wide, None)) for wide in (95, 150))
    factor = max(letters(other)) / max(letters(one))
    assert heads(one) and np.array(heads(other)) == pytest.approx(factor * np.array(heads(one)))


def test_a_number_is_not_parted_from_its_unit():
    said = "exact sweep of the half section, within 0.01 µm; 49619.809 mm³ removed in 3 passes of 2 mm"
    for room in np.arange(1.0, 6.0, 0.1):
        lines = broken(said, float(room))
        assert " ".join(lines) == said and not any(re.match("(mm³?|µm)(?![a-z])", line) for line in lines)


def test_a_title_of_two_lines_is_broken_anew(run, recwarn):
    figure = run.plot(title="First\nSecond")
    assert figure.alt.startswith("First Second: ") and not [each for each in recwarn if "Glyph" in str(each.message)]


@pytest.mark.parametrize("size", [None, "column", (3, 2), (4, 3)])
def test_the_label_of_the_largest_rate_stays_in_the_picture(size):
    """A cut near the end of a long program: what is written of it would run out to the right."""
    text = "G21 G17 G90 G94 G54 T1 M6 S900 M3\nG0 X-10 Y20 Z5\nG1 Z-1 F100\nX5\nG0 Y50\nG1 X40 F50\nZ-4 F600\nX60 F900\nG0 Z5\n"
    run = mnc.run(text, "g43", stock=((0, 0, -20), (100, 60, 0)), tools={1: mnc.Tool(radius=5, number=1)})
    figure = run.removal().plot(**({} if size is None else {"size": size}))
    figure.draw_without_rendering()
    wide = figure.bbox.width
    for text in (each for ax in figure.axes for each in ax.texts if "line" in each.get_text()):
        box = text.get_window_extent()
        assert 0 <= box.x0 and box.x1 <= wide

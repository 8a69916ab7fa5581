"""Every kind of figure in every size of a report: no text is cut, none stands on another."""

import functools
import itertools
import re
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.text import Text
from matplotlib.transforms import Bbox
from tools.together import deep_but_one_in

import mnclab as mnc
from mnclab import area, schemes, strategies

DATA = Path(__file__).parents[2] / "data"
STEPPED = [(0, 12), (-15, 12), (-20, 20), (-30, 20), (-33, 16), (-40, 16), (-42, 24), (-50, 24)]
SIZES = {"a4": 7, "column": 6, "slide": 10}  # points of the smallest letters
PLATE = "G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5\nG1 Z-2 F100\nX60\nG41 Y30\nX0\nY0\nG0 Z5\n"


@functools.cache
def run(name):
    """A program of the samples with its setup, or that of this file."""
    if name == "plate":
        return mnc.run(PLATE, "mnc", mnc.Setup(stock=((-10, -10, -10), (70, 40, 0))))
    return mnc.run(DATA / "programs" / name)


@functools.cache
def bar():
    """A shaft out of a bar."""
    return mnc.run(DATA / "programs" / "nc-31" / "shaft.nc31", setup=mnc.Setup(stock=mnc.blank.cylinder(25, -70, 2)))


@functools.cache
def touched():
    """A bore, a wall and a top that a probe has felt."""
    part = mnc.part.box((0, 0, -20), (100, 60, 0)) - mnc.part.hole((50.1, 29.9, 0), 24.2, 10)
    setup = mnc.Setup(part=part, tools={7: mnc.Tool(radius=2, kind="probe")})
    return mnc.run("N10 T7\nN20 G0 X50 Y30 Z20\nN40 G421 X50 Y30 D24 Z-5 H20\nN50 G499 X1\n", "mnc", setup)


@functools.cache
def pocket():
    return area.Region.of(area.rectangle(60, 40), holes=[area.rectangle(14, 10, centre=(8, 2))])


@functools.cache
def cleared(*names):
    return mnc.compare(pocket(), 4.0, *names, limit=70)


@functools.cache
def crashed():
    """At rapid through a plate."""
    text = "G90 G54 T1 S800 M3\nG0 X-20 Y20 Z5\nZ-3\nX30\nG1 X60 F100\nG0 Z5\n"
    setup = mnc.Setup(stock=((0, 0, -10), (80, 40, 0)), tools={1: mnc.Tool(radius=4, length=30)})
    return mnc.run(text, "mnc", setup)


@functools.cache
def tilted():
    """A slope that two rotary axes of the table turn upwards."""
    blocks = "TOOL CALL 1 Z S2000|L X0 Y0 Z50 R0 FMAX M3|PLANE SPATIAL SPA+0 SPB+30 SPC+0 TURN MB MAX FMAX|L X10 Y0 Z5 FMAX"
    text = "|".join(("BEGIN PGM A MM", blocks, "L Z-2 F200|L X40 Y20 F500|PLANE RESET TURN MB MAX FMAX|END PGM A MM"))
    setup = mnc.Setup(kinematics="table-ac", tools={1: mnc.Tool(radius=5, length=80)})
    return mnc.run(text.replace("|", "\n"), "tnc-620", setup)


@functools.cache
def every_strategy():
    return mnc.compare(pocket(), 4.0)


@functools.cache
def turned():
    shoulder = area.Contour([(0, 20), (-40, 20), (-50, 30)], closed=False)
    return mnc.compare_turning(shoulder, 30, mnc.Tool(number=1, kind="turning", main_angle=95, auxiliary_angle=30), depth=4)


@functools.cache
def grooved():
    grooves = schemes.grooves
    wide = grooves.Groove(right=-5, width=30, bottom=24, rim=30)
    tools = (grooves.CONTOUR_TOOL, mnc.Tool(number=2, kind="grooving", width=4))
    return mnc.compare_turning(wide.profile, 30, tools, {"contour tool, then grooving tool": grooves.scheme_6(wide, 4, depth=2)})


@functools.cache
def threads():
    depths = schemes.threads.even_chips(1.84, 6)
    return {name: schemes.threads.shifts(depths, name) for name in schemes.threads.METHODS}, depths


@functools.cache
def difference():
    """A plate cut by a tool that is 0.2 mm thinner than its table says."""
    wanted = mnc.Design(mnc.design.Box((0, 0, -10), (80, 50, 0)), [mnc.design.Pocket.rectangle(60, 30, 40, 25, 4, 6)])
    text = "T1 S2000 M3\nG0 X40 Y25 Z5\nG1 Z-4 F100\nG1 X20\nY20\nX60\nY30\nX20\nY25\nG0 Z5\n"
    done = mnc.run(text, "mnc", mnc.Setup(stock=((0, 0, -10), (80, 50, 0)), tools={1: mnc.Tool(radius=5.9)}))
    return done.workpiece().compare(wanted)


def shifted():
    """Holes, and the same with one row of them elsewhere."""
    one = run("tnc-620/holes.h")
    return one, mnc.run(one.program.text.replace("Y+15", "Y+15.2"), "tnc-620", one.setup)


def straight():
    """Two ways at rapid from corner to corner: at once, and one axis after the other."""
    text = "G90 G54 T1 S800 M3\nG0 X0 Y0 Z5\nG0 X60 Y20\nG1 Z-2 F100\nX0\nG0 Z5\n"
    return mnc.run(text, "mnc"), mnc.run(text.replace("X60 Y20", "X60\nY20"), "mnc")


FIGURES = {
    "path": lambda **size: run("plate").plot(**size),
    "path by feed": lambda **size: run("tnc-620/pockets.h").plot(colour="feed", **size),
    "path with part": lambda **size: run("tnc-620/plate.h").plot(part=True, **size),
    "path of pockets": lambda **size: run("tnc-620/pockets.h").plot(**size),
    "path of holes": lambda **size: run("tnc-620/holes.h").plot(**size),
    "three planes": lambda **size: run("mnc/three_planes.mnc").plot(**size),
    "turned path": lambda **size: bar().plot(**size),
    "probed path": lambda **size: touched().plot(**size),
    "unrolled": lambda **size: run("tnc-620/drum_cam.h").plot(view="unrolled", **size),
    "depth": lambda **size: run("tnc-620/holes.h").plot_depth(**size),
    "datums": lambda **size: run("tnc-620/holes.h").plot_datums(**size),
    "face": lambda **size: run("nc-31/spiral_groove.nc31").plot_face(**size),
    "lengths": lambda **size: run("g43/two_lengths.g43").plot_lengths(4, **size),
    "speed": lambda **size: run("nc-31/shaft.nc31").plot_speed(**size),
    "measured": lambda **size: touched().plot_measured(**size),
    "compensation": lambda **size: run("plate").plot_compensation(**size),
    "rules": lambda **size: run("mnc/compensated.mnc").plot_compensation(rules=("G160", "G161", "G162"), **size),
    "radii": lambda **size: run("plate").plot_compensation(radii=(2, 5), **size),
    "profile": lambda **size: run("plate").profile("small-mill").plot(**size),
    "long profile": lambda **size: run("tnc-620/pockets.h").profile("small-mill").plot(**size),
    "reached": lambda **size: run("plate").profile("small-mill").plot_reached(**size),
    "lost": lambda **size: run("tnc-620/pockets.h").profile("small-mill").plot_lost(**size),
    "profiles": lambda **size: mnc.plot_profiles(run("plate").profile("small-mill"), run("plate"), **size),
    "removal": lambda **size: run("plate").removal().plot(**size),
    "part": lambda **size: run("tnc-620/pockets.h").workpiece().plot(**size),
    "turned part": lambda **size: bar().workpiece().plot(**size),
    "difference": lambda **size: difference().plot(**size),
    "difference in section": lambda **size: difference().plot(section="XZ", at=25, **size),
    "runs": lambda **size: mnc.plot_runs({name: run(f"mnc/plate_{name}.mnc") for name in ("absolute", "incremental")}, **size),
    "deviation": lambda **size: mnc.diff(*shifted()).plot(**size),
    "deviation at rapid": lambda **size: mnc.diff(*straight()).plot(**size),
    "holes": lambda **size: mnc.diff(*shifted(), what="holes").plot(**size),
    "proof": lambda **size: mnc.prove(*shifted()).plot(**size),
    "proof at rapid": lambda **size: mnc.prove(*straight()).plot(**size),
    "axes": lambda **size: tilted().axes().plot(**size),
    "axes over time": lambda **size: tilted().axes().plot(tilted().profile("small-mill"), **size),
    "tilted path": lambda **size: tilted().plot(**size),
    "collisions": lambda **size: crashed().collisions().plot(**size),
    "regions": lambda **size: area.plot({"pocket": pocket(), "what an 8 mm mill leaves": strategies.rest(pocket(), 4)}, **size),
    "strategies": lambda **size: cleared("rings", "spiral", "zigzag", "adaptive").plot(**size),
    "every strategy": lambda **size: every_strategy().plot(**size),
    "two strategies": lambda **size: cleared("rings", "trochoidal").plot(**size),
    "engagement": lambda **size: cleared("rings", "spiral", "zigzag").plot("engagement", **size),
    "passes": lambda **size: cleared("rings")["rings"].plot("passes", **size),
    "times": lambda **size: strategies.plot_times({(8, 3.2): cleared("rings", "zigzag")}, **size),
    "tool sets": lambda **size: mnc.tool_sets(pocket(), (2, 4), "rings").plot(**size),
    "turning schemes": lambda **size: turned().plot(**size),
    "one turning scheme": lambda **size: grooved().plot(**size),
    "threads": lambda **size: schemes.plot_threads(*threads(), **size),
    "zones": lambda **size: schemes.plot_zones(area.Contour(STEPPED, closed=False), 30, **size),
}


def texts(figure):
    """All texts that are seen, with their boxes in pixels; of the numbers at axes those between their ends."""
    figure.draw_without_rendering()
    hidden = set()
    for ax in figure.findobj(lambda each: hasattr(each, "xaxis")):
        for axis, ends in ((ax.xaxis, ax.get_xlim()), (ax.yaxis, ax.get_ylim())):
            low, high = np.sort(ends) + np.array([-1e-6, 1e-6]) * abs(ends[1] - ends[0])
            ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
            shown = [tick for tick in ticks if ax.axison and low <= tick.get_loc() <= high]
            hidden |= {id(label) for tick in ticks if tick not in shown for label in (tick.label1, tick.label2)}
            hidden |= set() if ax.axison else {id(axis.label)}
    found = (each for each in figure.findobj(Text) if each.get_visible() and each.get_text().strip() and id(each) not in hidden)
    return [(each.get_text(), box_of(each)) for each in found]


def box_of(text):
    """The box of a text in pixels, without a last line that is left free."""
    box, lines = text.get_window_extent(), text.get_text().split("\n")
    return box if lines[-1] else Bbox([(box.x0, box.y0 + box.height / len(lines)), box.max])


def faults(figure):
    found = texts(figure)
    edge = figure.bbox
    out = [(box.min < edge.min - 1).any() or (box.max > edge.max + 1).any() for _, box in found]
    wrong = [f"{said!r} is cut" for (said, _), beyond in zip(found, out) if beyond]
    wrong += [f"{said!r} ends in …" for said, _ in found if said.endswith("…")]
    for (one, a), (other, b) in itertools.combinations(found, 2):
        if a.shrunk(0.98, 0.9).overlaps(b.shrunk(0.98, 0.9)):
            wrong.append(f"{one!r} on {other!r}")
    return wrong


@pytest.mark.parametrize(("name", "size"), deep_but_one_in(10, itertools.product(FIGURES, SIZES)))
def test_all_texts_stand_inside_and_apart_and_are_readable(name, size):
    wrong = faults(figure := FIGURES[name](size=size))
    assert not wrong, "\n".join(wrong)
    assert min(text.get_fontsize() for text in figure.findobj(Text) if text.get_text().strip()) >= SIZES[size]


@pytest.mark.parametrize("name", deep_but_one_in(6, FIGURES))
def test_every_figure_has_its_title_above_all_else(name):
    """Two lines of it in a column; a page is as wide as without, and a slide as high, too."""
    said = "A title that is too long for one line of a column of a page"
    for size in SIZES:
        figure = FIGURES[name](size=size, title=said)
        assert not faults(figure)
        (box,) = [box for text, box in texts(figure) if text.replace("\n", " ") == said]
        assert all(box.y0 >= other.y1 - 1 for text, other in texts(figure) if text.replace("\n", " ") != said)
        assert figure.get_size_inches()[0] * 25.4 == pytest.approx({"a4": 170, "column": 85, "slide": 338.582}[size], abs=0.1)
        assert size != "slide" or figure.get_size_inches()[1] == pytest.approx(7.5)
    figure = FIGURES[name](title="A title")
    assert "A title" in [text for text, _ in texts(figure)] and figure.alt.startswith("A title: ")
    assert figure.get_figheight() == pytest.approx(FIGURES[name]().get_figheight() + 0.08 + 12 / 72, abs=1e-9)


@pytest.mark.parametrize("name", ["strategies", "passes", "threads", "engagement", "turning schemes"])
def test_views_side_by_side_use_the_width_of_a_slide(name):
    boxes = [ax.get_position() for ax in FIGURES[name](size="slide").axes]
    least = 0.7 if name == "passes" else 0.8  # five stand in two rows, larger than in one
    assert max(box.x1 for box in boxes) - min(box.x0 for box in boxes) > least


def test_four_schemes_of_a_groove_fill_a_slide():
    """As two rows of two: in one row of four the views filled 16 % of it."""
    groove = area.Contour([(-10, 30), (-20, 20), (-40, 20), (-50, 30)], closed=False)
    tool = mnc.Tool(number=1, kind="turning", main_angle=95, auxiliary_angle=30)
    boxes = [ax.get_position() for ax in mnc.compare_turning(groove, 30, tool, depth=4).plot(size="slide").axes]
    assert len(boxes) == 4 and sum(box.width * box.height for box in boxes) > 0.28
    assert max(box.y1 for box in boxes) - min(box.y0 for box in boxes) > 0.6


def test_only_above_a_row_that_is_not_full_views_stand_apart():
    """Seven schemes in two columns: between the rows that are full there is no room for numbers."""
    figure = FIGURES["turning schemes"](size="column")
    left = [ax.get_position() for ax in figure.axes[::2]]
    gaps = [(above.y0 - below.y1) * figure.get_figheight() * 25.4 for above, below in itertools.pairwise(left)]
    assert max(gaps[0], gaps[1] - 4) < 11 and gaps[2] > gaps[0] + 4  # mm; the third row has names of two lines


@pytest.mark.parametrize("kind", ["paths", "engagement", "passes"])
def test_every_strategy_fills_a_slide_and_stays_on_a_page(kind):
    names = {word for name in strategies.STRATEGIES for word in name.split()}
    for size in SIZES:
        figure = every_strategy().plot(kind, size=size)
        boxes = [ax.get_position() for ax in figure.axes]
        assert max(box.x1 for box in boxes) - min(box.x0 for box in boxes) > 0.75
        assert figure.get_figheight() * 25.4 <= 257.1 and not faults(figure)
        assert names <= set(re.split(r"[\s:]+", " ".join(ax.get_title(loc="left") for ax in figure.axes)))


@pytest.mark.parametrize("name", ["profile", "removal", "long profile"])
@pytest.mark.parametrize("size", SIZES)
def test_what_is_cut_off_is_told_above_the_fastest_cut(name, size):
    figure = FIGURES[name](size=size)
    (ax,) = [ax for ax in figure.axes if any(text.get_text().startswith("rapids reach") for text in ax.texts)]
    (told,) = [box for said, box in texts(figure) if said.startswith("rapids reach")]
    fastest = {"long profile": 800}.get(name, 100)  # mm/min, as the programs say
    assert told.y0 > ax.transData.transform((0, fastest))[1]


@pytest.mark.parametrize("name", ["difference", "difference in section", "measured"])
def test_words_beside_a_picture_fill_a_slide(name):
    figure = FIGURES[name](size="slide")
    boxes = [box for _, box in texts(figure)]
    assert max(box.x1 for box in boxes) - min(box.x0 for box in boxes) > 0.8 * figure.bbox.width


@pytest.mark.parametrize("name", ["threads", "lost", "engagement", "path", "speed"])
def test_all_frames_are_grey(name):
    shown = [spine for ax in FIGURES[name]().axes if ax.axison for spine in ax.spines.values() if spine.get_visible()]
    assert shown and {to_hex(spine.get_edgecolor()) for spine in shown} == {"#9a9a9a"}


@pytest.mark.parametrize("size", SIZES)
def test_the_numbers_of_a_long_way_stand_apart(size):
    long = mnc.run("G90 G54 S800 M3 T1 F200\nG0 X0 Y0 Z2\n" + "G1 X1000\nX0\n" * 50, "mnc")
    assert not faults(long.plot_speed(size=size)) and not faults(long.profile().plot(over="path", size=size))


def named(figure):
    return {text.get_text() for legend in figure.legends for text in legend.get_texts()}


def test_legends_name_the_part_what_is_cut_and_rapids():
    assert {"part", "cut"} <= named(FIGURES["path with part"]()) and {"feed", "rapid"} <= named(FIGURES["runs"]())
    uncut = mnc.run("T1 S1000 M3\nG0 X0 Y0 Z5\nX60\n", "mnc", mnc.Setup(stock=((-10, -10, -10), (70, 40, 0))))
    assert "cut" not in named(uncut.plot(part=True)) and "part" in named(uncut.plot(part=True))


def test_heights_have_their_unit():
    said = [text.get_text() for ax in FIGURES["lengths"]().axes for text in ax.texts]
    assert "machine Z 30 mm" in said and "program Z 30 mm" in said
    assert all(name.endswith(" mm") for name in named(FIGURES["face"]()))

"""The table that sets strategies side by side, against areas and lengths worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest
from tools.together import deep_but_one_in

from mnclab import Alarm, Limits, Tool
from mnclab.comparison.levels import _at_level, level_moves
from mnclab.comparison.strategies import COLUMNS, compare
from mnclab.comparison.turning_schemes import compare as compare_turning
from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.machining.milling import faces
from mnclab.machining.milling.clearing import joined
from mnclab.machining.milling.engagement import engagement
from mnclab.machining.milling.entries import Entry
from mnclab.machining.milling.strategies import STRATEGIES

BOX = Region.of(rectangle(60, 40))
SHOULDER = Contour([(0, 20), (-40, 20), (-50, 30)], closed=False)


@pytest.fixture(scope="module")
def found():
    return compare(BOX, Tool(radius=4, dr=1), overlap=0.5, depth=2, feed=600, plunge_feed=100, rapid=6000)


def test_every_strategy_is_a_row(found):
    table = found.columns()
    assert list(table) == [name for name in COLUMNS if name != "chip"]  # no teeth, no speed
    assert table["strategy"].tolist() == list(STRATEGIES)
    assert (table["covered"] > 99.9).all()
    assert table["corners"] == pytest.approx((4 - np.pi) * 25, abs=0.05)
    assert table["rest"] == pytest.approx(0, abs=0.05)
    assert "trochoidal" in repr(found) and found._repr_html_().count("<tr>") == 1 + len(STRATEGIES)


def test_rings_by_hand(found):
    """Rings of 80, 120 and 160 and two links of 5, and 4 down from 2 above (2 deep): 374; then at 600 and 100 mm/min."""
    row = found["rings"].row
    assert row["length"] == pytest.approx(80 + 120 + 160 + 10 + 4)
    assert row["time"] == pytest.approx(370 / 600 * 60 + 4 / 100 * 60 + 4 / 6000 * 60)
    assert row["rapid"] == pytest.approx(4) and row["lifts"] == 0


def test_harder_and_gentler(found):
    """Trochoidal work takes the longest way and the least engagement; a slot engages half a turn."""
    table = found.columns()
    k = table["strategy"].tolist().index("trochoidal")
    assert table["mean"][k] == table["mean"].min() and table["length"][k] == table["length"].max()
    assert found["rings"].row["most"] == pytest.approx(180, abs=0.5)
    rate = 10 * 2 * 600 / 1000  # width 10, depth 2, feed 600
    assert found["rings"].row["removal_most"] == pytest.approx(rate, abs=0.05)


def test_the_shares_of_rings_in_a_square():
    """R 3, stepover 2.4: the greatest is that of the first slot, half of the way is cut at arccos(0.2), the corners lie above."""
    trial = compare(Region.of(rectangle(60, 60)), 3.0, "rings", stepover=2.4)["rings"]
    assert np.degrees(trial.engagement.percentile(0.5)) == pytest.approx(78.463, abs=0.001)
    assert 78.463 < trial.row["p95"] == np.degrees(trial.engagement.percentile(0.95)) < 168.463
    later = trial.engagement.chosen(trial.engagement.points.max(axis=1) > 12.6)  # rings from the fifth on
    assert np.degrees(later.most()) == pytest.approx(168.463, abs=0.001)
    assert "95 % of the way below, °" in repr(trial)


def test_what_is_left_is_found():
    """One round along the wall of 60 × 40 with R 5 leaves a core of 40 × 20."""
    once = faces.rectangle(60, 40, 5, 100).passes[-1]
    clearing = faces.rectangle(60, 40, 5, 5)
    piece = replace(clearing.pieces[0], passes=(once,), linked=(), labels=("wall",), place=None)
    trial = compare(BOX, 5.0, {"once": replace(clearing, pieces=(piece,))})["once"]
    assert trial.rest.area == pytest.approx(800, abs=0.5)
    reach = 60 * 40 - (4 - np.pi) * 25
    assert trial.covered == pytest.approx(1 - 800 / reach, abs=1e-4)
    assert trial.rest.loops[0].bounds == pytest.approx(np.array([[-20, -10], [20, 10]]), abs=0.01)


def test_fine_roughing_beside_the_whole_with_one_tool():
    """After a tool of 12 one of 5 has (1 - π/4)·(12² - 5²) left in each corner, and never a whole slot."""
    found = compare(BOX, 5.0, ["rings", "fine"], coarse=Tool(radius=12), overlap=0.6)
    fine = found["fine"]
    assert fine.before.area == pytest.approx(2400 - (4 - np.pi) * 144)
    assert fine.covered > 0.9999 and fine.rest.area == pytest.approx(0, abs=0.05)
    assert fine.row["length"] < found["rings"].row["length"] / 2
    cut = (fine.engagement.width * fine.engagement.step).sum()
    assert cut == pytest.approx((4 - np.pi) * (144 - 25), rel=0.02)
    assert fine.row["most"] < 150 < found["rings"].row["most"]
    assert not len(fine.entries) and len(found["rings"].entries)


def test_fine_roughing_needs_a_coarse_tool_that_leaves_something():
    assert [trial.name for trial in compare(BOX, 5.0, coarse=12).trials][-1] == "fine"
    with pytest.raises(Alarm, match="coarse tool was there before"):
        compare(BOX, 5.0, ["fine"])
    for coarse in (5, 3):
        with pytest.raises(Alarm, match=f"coarse tool of radius {coarse} leaves nothing to one of 5"):
            compare(BOX, 5.0, ["fine"], coarse=coarse)
    for wrong in (np.nan, -1, "12", [1], {}):
        with pytest.raises(Alarm, match="coarse tool"):
            compare(BOX, 5.0, ["fine"], coarse=wrong)


def test_a_stepover_without_an_end_is_an_alarm():
    with pytest.raises(Alarm, match="a stepover of 1e-06 mm is too small for this area"):
        compare(Region.of(rectangle(80, 50)), 4, ["rings"], stepover=1e-6)


def test_own_functions_and_other_names():
    own = compare(BOX, 5.0, {"mine": lambda region, radius, step: faces.rectangle(60, 40, radius, step)})
    assert own["mine"].covered > 0.999
    assert own[0].entries.tolist() == [[0, 0]]
    with pytest.raises(KeyError, match="there are mine"):
        own["rings"]
    with pytest.raises(Alarm, match="overlap"):
        compare(BOX, 5.0, overlap=1.0)
    with pytest.raises(Alarm, match="does not fit"):
        compare(Region.of(Contour.circle((0, 0), 4)), 5.0)


def test_time_under_limits_of_the_axes():
    """With axes that start at once it is length over feed; stops in the corners of rings cost time."""
    free = compare(BOX, 5.0, ["rings"], feed=2000)["rings"].time
    quick, slow = (
        compare(BOX, 5.0, ["rings"], feed=2000, limits=Limits(acceleration=a))["rings"].time for a in (1e7, 200)
    )
    assert quick == pytest.approx(free, rel=1e-3)
    assert slow > 1.05 * free


NUMBERS = ["depth", "feed", "plunge_feed", "rapid", "overlap", "stepover", "allowance", "limit", "entry", "climb"]
NO_NUMBERS = [np.nan, np.inf, "5", ["1"], -5.0, 10**400, {}]


@pytest.mark.parametrize("name", NUMBERS)
@pytest.mark.parametrize("wrong", NO_NUMBERS, ids=lambda value: repr(value)[:9])
def test_what_is_no_sensible_number_is_an_alarm(name, wrong):
    with pytest.raises(Alarm, match=name.split("_")[0]):
        compare(BOX, 5.0, ["rings"], **{name: wrong})


@pytest.mark.parametrize("name", ["depth", "step", "feed", "feeds", "spindle", "surface", "rapid", "lift", "front"])
@pytest.mark.parametrize("wrong", [*NO_NUMBERS[:-1], {"plunge": -1}], ids=lambda value: repr(value)[:9])
def test_so_it_is_for_turning(name, wrong):
    with pytest.raises(Alarm, match=name.rstrip("s")):
        compare_turning(SHOULDER, 30, schemes=["loop"], **{name: wrong})


def test_what_is_turned_needs_names():
    for wrong in ("loop", 5, [5], [None], {"mine": 5}):
        with pytest.raises(Alarm, match="scheme"):
            compare_turning(SHOULDER, 30, schemes=wrong)


def test_numbers_of_numpy_are_numbers():
    given = {name: np.float32(2) for name in ("depth", "feed", "plunge_feed", "rapid", "stepover", "limit")}
    found = compare(BOX, np.int8(5), ["rings"], climb=np.True_, allowance=np.float64(0), **given)
    assert repr(found) == repr(compare(BOX, 5.0, ["rings"], **{name: 2.0 for name in given}))
    turned = compare_turning(SHOULDER, np.int64(30), schemes=["loop"], depth=np.int8(4), feed=np.float64(0.5))
    assert repr(turned) == repr(compare_turning(SHOULDER, 30, schemes=["loop"], depth=4, feed=0.5))


SLOTS = [(rectangle(60, 8), 52), (rectangle(60, 8, 4), 52), (rectangle(60, 8, angle=0.7), 52), (Contour.circle((3, 2), 4), 0)]


@pytest.mark.parametrize("name", STRATEGIES)
@pytest.mark.parametrize(("slot", "length"), SLOTS)
def test_a_slot_exactly_as_wide_as_the_tool(name, slot, length):
    """Geometry: a tool of radius 4 passes through a width of 8 and nowhere else, on one stroke from 4 before its ends."""
    trial = compare(Region.of(slot), Tool(radius=4), name)[name]
    assert trial.clearing.labels == ("slot",) and trial.clearing.length == pytest.approx(length, abs=1e-9)
    assert trial.covered == pytest.approx(1, abs=1e-4) and trial.rest.area == pytest.approx(0, abs=0.05)
    with pytest.raises(Alarm, match="a tool of radius 4.01 does not fit into the contour"):
        compare(Region.of(slot), Tool(radius=4.01), name)
    with pytest.raises(Alarm, match="the area is empty"):
        compare(Region.of(), Tool(radius=4), name)


# --- chips -------------------------------------------------------------------------------------------------------------

MILL = Tool(radius=5, teeth=3)
AT_CHIP = {"chip": 0.05, "spindle": 8000, "feed": 3000, "plunge_feed": 100}


def to_and_fro(region, radius, stepover):
    """A slot, the way back beside it, and once more along the slot."""
    there = Contour([(-20, 0), (20, 0)], closed=False)
    back = Contour([(20, stepover), (-14, stepover)], closed=False)
    return joined((there, back, there), ("slot", "beside", "again"), radius, region.inset(radius))


@pytest.mark.parametrize("stepover", [0.2, 1.5, 2.5])
def test_feeds_of_a_chip_by_hand(stepover):
    """f_z = 0.05 in the slot: 0.05·3·8000 = 1200 mm/min; beside it 1200 / sin φ, cos φ = 1 - a/R; once more: air, 3000."""
    trial = compare(BOX, MILL, {"own": to_and_fro}, stepover=stepover, **AT_CHIP)["own"]
    path, labels = trial.path, np.array(trial.path.labels)[trial.path.label]
    beside = min(1200 / np.sin(np.arccos(1 - stepover / 5)), 3000)
    for label, length, feed in (("slot", 40, 1200), ("beside", 34, beside), ("again", 40, 3000)):
        rows = labels == label
        assert path.lengths[rows].sum() == pytest.approx(length)
        at = np.average(np.isclose(path.feed[rows], feed, rtol=1e-4), weights=path.lengths[rows])
        assert at > 0.8, (label, path.feed[rows])
    assert (path.feed[labels == "entry"] == 100).all() and (path.spindle == 8000).all()
    assert trial.row["chip"] == pytest.approx(0.05)
    assert trial.time == pytest.approx(60 * (path.lengths / np.minimum(path.feed, 10000)).sum())


@pytest.mark.parametrize("entry", deep_but_one_in(3, [Entry(), Entry("helix", 3), Entry("ramp", 5)]))
def test_no_chip_is_thicker(entry):
    """At half of the spacing of the places, too; the rows at the level are the ways that are looked at."""
    found = compare(BOX, MILL, entry=entry, stepover=3, depth=2, **AT_CHIP)
    for trial in found.trials:
        assert 0 < trial.row["chip"] <= 0.05 + 1e-12 and len(trial.chip) == len(trial.feed) == len(trial.engagement.way)
        path = trial.path
        rows = np.flatnonzero(_at_level(path, -2))
        assert path.lengths[rows].sum() == pytest.approx(trial.engagement.step.sum(), abs=1e-6)
        moves, counted = level_moves(trial.clearing, entry, 2, True)
        fine = engagement(moves, 5, spacing=0.125)
        fine = fine.chosen(np.array(counted)[fine.move])
        apart = np.cumsum([move.length for move in moves] * ~np.array(counted))
        upto = np.cumsum(path.lengths[rows])
        feed = path.feed[rows][np.minimum(np.searchsorted(upto, fine.way - apart[fine.move] - 1e-9), len(rows) - 1)]
        chip = fine.thickness * feed / (3 * 8000)
        short = 0.01 if trial.name == "adaptive" else 0.002  # its passes begin within a tenth of the radius
        assert (fine.step[chip > 0.0505]).sum() < short * fine.step.sum() and chip.max() < 0.07, trial.name
        assert np.abs(path.end[:-1] - path.start[1:]).max() < 1e-12


def test_gentle_strategies_gain_from_chips():
    """At one feed the trochoids take their length; at one chip thickness they go faster where they cut thin."""
    even, thin = (compare(BOX, MILL, "rings", "trochoidal", stepover=3, spindle=8000, **more)
                  for more in ({"feed": 1200}, {"feed": 3000, "chip": 0.05}))  # fmt: skip
    ratio = [found["trochoidal"].time / found["rings"].time for found in (even, thin)]
    assert ratio[1] < 0.9 * ratio[0]
    assert even["rings"].row["chip"] == thin["rings"].row["chip"] == pytest.approx(0.05)
    assert even["rings"].removal.max() == pytest.approx(thin["rings"].removal.max())


def test_a_thickness_of_chips_by_hand(found):
    """A slot at 600 mm/min, 3 teeth, 2000 rev/min: 0.1 mm. Nobody knows it without teeth and speed: the table says nothing."""
    trial = compare(BOX, MILL, "rings", feed=600, spindle=2000)["rings"]
    assert trial.row["chip"] == pytest.approx(0.1) and "greatest chip, mm" in repr(trial)
    assert "chip" not in found.columns() and "chip" not in found["rings"].row and np.isnan(found["rings"].chip).all()


@pytest.mark.parametrize(
    ("tool", "more", "says"),
    [
        (5.0, {"spindle": 8000}, "needs a tool with teeth, got 5.0"),
        (Tool(radius=5), {"spindle": 8000}, "needs a tool with teeth"),
        (MILL, {}, "needs the speed of the spindle"),
        (MILL, {"spindle": 0}, "speed of the spindle"),
        (MILL, {"spindle": 8000, "chip": 0}, "greatest chip"),
        (MILL, {"spindle": 8000, "chip": "thin"}, "chip"),
    ],
)
def test_a_chip_that_is_not_known_is_an_alarm(tool, more, says):
    with pytest.raises(Alarm, match=says) as raised:
        compare(BOX, tool, "rings", **{"chip": 0.05} | more)
    if "needs" in says:
        assert "spindle=8000" in raised.value.hint or "mnclab.Tool(radius=5, teeth=3)" in raised.value.hint


def test_names_of_strategies_are_read_in_any_case_of_letters():
    region = Region.of(rectangle(30, 20))
    found = compare(region, 3.0, "Morphed Spiral", "RINGS")
    assert [trial.name for trial in found.trials] == ["morphed spiral", "rings"]


def test_a_contour_of_two_lines_encloses_nothing():
    with pytest.raises(ValueError, match="encloses nothing"):
        Region.of(Contour([(0, 0), (10, 0)]))


def test_a_table_may_have_some_of_its_columns_alone():
    found = compare(Region.of(rectangle(30, 20)), 3.0, "rings")
    few = found.only("strategy", "time")
    assert few.head == ("strategy", "time, s") and [*few.columns()] == ["strategy", "time"] and len(found.head) > 10
    with pytest.raises(Alarm, match="a column must be strategy"):
        found.only("colour")

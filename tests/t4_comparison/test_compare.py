"""The table that sets strategies side by side, against areas and lengths worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest

from mnclab import Alarm, Limits, Tool
from mnclab.comparison.strategies import COLUMNS, compare
from mnclab.comparison.turning_schemes import compare as compare_turning
from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.machining.milling import faces
from mnclab.machining.milling.strategies import STRATEGIES

BOX = Region.of(rectangle(60, 40))
SHOULDER = Contour([(0, 20), (-40, 20), (-50, 30)], closed=False)


@pytest.fixture(scope="module")
def found():
    return compare(BOX, Tool(radius=4, dr=1), overlap=0.5, depth=2, feed=600, plunge_feed=100, rapid=6000)


def test_every_strategy_is_a_row(found):
    table = found.columns()
    assert list(table) == list(COLUMNS)
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
NO_NUMBERS = [np.nan, np.inf, "5", [1], -5.0, 10**400, {}]


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
